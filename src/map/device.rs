//! Whether a device is switched on and a thing stands open: what its properties and doors say of it, and how they change.

use super::{DoorState, DoorStatus, Mark, Object, Properties, Replica, World};

/// Of the two properties the first that is there counts: a thing that opens and is switched has its power apart.
const STATES: [Mark; 2] = [Mark::Power, Mark::State];

/// `None` when the properties say nothing of it.
#[must_use]
pub fn is_on(properties: &Properties) -> Option<bool> {
    STATES.iter().find_map(|mark| says(mark.of(properties)?.1))
}

/// Whether a thing that opens is open. `None` when the properties say nothing of it.
#[must_use]
pub fn is_open(properties: &Properties) -> Option<bool> {
    let state = Mark::State.of(properties)?.1.to_lowercase();
    match state.as_str() {
        "open" => Some(true),
        "closed" | "shut" | "locked" => Some(false),
        word if word.starts_with("откры") => Some(true),
        word if word.starts_with("закры") || word.starts_with("запер") => Some(false),
        _ => None,
    }
}

/// Opens or shuts a thing that opens: its state where that stood, in the language in which it stood, and its doors.
pub fn set_open(replica: &mut Replica, object: &Object, open: bool) {
    if is_open(&replica.properties).is_some()
        && let Some((name, value)) = Mark::State.of(&replica.properties)
    {
        let word = match (open, value.is_ascii()) {
            (true, false) => "Открыто",
            (false, false) => "Закрыто",
            (true, true) => "open",
            (false, true) => "closed",
        };
        let name = name.to_owned();
        replica.properties.insert(name, word.to_owned());
    }
    let state = if open { DoorState::OPEN } else { DoorState::CLOSED };
    for mount in &object.doors {
        replica.door_states.insert(mount.door, state);
    }
}

/// How a thing that opens stands: as its properties tell, else as the widest open of its doors does. `None` for what has no
/// doors and of which nothing of the kind is told.
#[must_use]
pub fn stands(world: &World, replica: &Replica) -> Option<DoorStatus> {
    if let (Some(open), Some((_, state))) =
        (is_open(&replica.properties), Mark::State.of(&replica.properties))
    {
        let state = state.to_lowercase();
        return Some(match open {
            true => DoorStatus::Open,
            false if state == "locked" || state.starts_with("запер") => DoorStatus::Locked,
            false => DoorStatus::Closed,
        });
    }
    let states = world.objects.get(&replica.object)?.doors.iter().filter_map(|mount| {
        let own = replica.door_states.get(&mount.door).copied();
        own.or_else(|| world.doors.get(&mount.door).map(|door| door.state))
    });
    states.max_by(|a, b| a.opening.total_cmp(&b.opening)).map(|state| state.status)
}

/// Whether a room is dark by itself: without the lamps in it.
#[must_use]
pub fn is_dark(room: &Properties) -> bool {
    Mark::Light.of(room).and_then(|(_, value)| says(value)) == Some(false)
}

/// «Включено», "on"; «выключена», "switched off".
fn says(value: &str) -> Option<bool> {
    let value = value.to_lowercase();
    let word = value.rsplit(' ').next().unwrap_or_default();
    match word {
        "on" => Some(true),
        "off" => Some(false),
        word if word.starts_with("включ") => Some(true),
        word if word.starts_with("выключ") => Some(false),
        _ => None,
    }
}

/// Writes the state where it stood, in the language in which it stood; in СОСТОЯНИЕ when none was known and that is
/// free, else in ПИТАНИЕ.
pub fn switch(properties: &mut Properties, on: bool) {
    let found = STATES.iter().find_map(|mark| {
        let (name, value) = mark.of(properties)?;
        says(value).map(|_| (name.to_owned(), value.is_ascii()))
    });
    let (key, is_english) = found.unwrap_or_else(|| {
        let mark = if Mark::State.of(properties).is_some() { Mark::Power } else { Mark::State };
        (mark.names()[0].to_owned(), false)
    });
    let word = match (on, is_english) {
        (true, false) => "Включено",
        (false, false) => "Выключено",
        (true, true) => "on",
        (false, true) => "off",
    };
    properties.insert(key, word.to_owned());
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of(pairs: &[(&str, &str)]) -> Properties {
        pairs.iter().map(|(k, v)| ((*k).to_owned(), (*v).to_owned())).collect()
    }

    #[test]
    fn an_english_state_stays_english() {
        let mut lamp = of(&[("State", "switched off")]);
        assert_eq!(is_on(&lamp), Some(false));
        switch(&mut lamp, true);
        assert_eq!(lamp, of(&[("State", "on")]));
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
