//! Whether a device is switched on: what its properties say of it, and how they change.

use super::Properties;

/// Of the two properties the first that is there counts: a thing that opens and is switched has its power apart.
const STATES: [&str; 2] = ["ПИТАНИЕ", "СОСТОЯНИЕ"];

/// `None` when the properties say nothing of it.
#[must_use]
pub fn is_on(properties: &Properties) -> Option<bool> {
    STATES.iter().find_map(|key| {
        let value = properties.get(*key)?.to_lowercase();
        if value.starts_with("включ") {
            Some(true)
        } else if value.starts_with("выключ") {
            Some(false)
        } else {
            None
        }
    })
}

/// Writes the state where it stood; in СОСТОЯНИЕ when none was known and that is free, else in ПИТАНИЕ.
pub fn switch(properties: &mut Properties, on: bool) {
    let says = |key: &str| properties.get(key).map(|v| v.to_lowercase());
    let is_power = |v: String| v.starts_with("включ") || v.starts_with("выключ");
    let key = STATES
        .into_iter()
        .find(|key| says(key).is_some_and(is_power))
        .unwrap_or(if properties.contains_key(STATES[1]) { STATES[0] } else { STATES[1] });
    let word = if on { "Включено" } else { "Выключено" };
    properties.insert(key.to_owned(), word.to_owned());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(pairs: &[(&str, &str)]) -> Properties {
        pairs.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect()
    }

    #[test]
    fn what_is_switched_keeps_its_other_state() {
        let open = [("СОСТОЯНИЕ", "Открыто")];
        for (before, known, key) in [
            (of(&[]), None, "СОСТОЯНИЕ"),
            (of(&[("СОСТОЯНИЕ", "выключена")]), Some(false), "СОСТОЯНИЕ"),
            (of(&open), None, "ПИТАНИЕ"),
            (of(&[open[0], ("ПИТАНИЕ", "Включено")]), Some(true), "ПИТАНИЕ"),
        ] {
            assert_eq!(is_on(&before), known);
            for on in [true, false] {
                let mut after = before.clone();
                switch(&mut after, on);
                assert_eq!(is_on(&after), Some(on));
                after.remove(key);
                let rest = before.iter().filter(|(k, _)| *k != key).count();
                assert_eq!(after.len(), rest, "{before:?}");
            }
        }
    }
}
