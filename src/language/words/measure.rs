//! Lengths, areas and times as people say them: two digits after the point at most, none below a metre.
//!
//! Invariant: what is said is the value rounded, in the decimal mark of the language.

use super::list::Language;
use crate::units::Lengths;

/// «40 см», «1,5 м», "1.5 m"
pub(crate) fn length(cm: f64, language: Language) -> String {
    let metres = cm >= 100.0 || Lengths::said() == Lengths::M;
    let (value, unit) = match (metres, language) {
        (true, Language::Russian) => (cm / 100.0, "м"),
        (true, Language::English) => (cm / 100.0, "m"),
        (false, Language::Russian) => (cm, "см"),
        (false, Language::English) => (cm, "cm"),
    };
    let text = if metres { trimmed(value, 2) } else { trimmed(value, 0) };
    let text = if language == Language::Russian { text.replace('.', ",") } else { text };
    format!("{text} {unit}")
}

/// «12,3 м²»
pub(crate) fn area(cm2: f64, language: Language) -> String {
    let text = trimmed(cm2 / 10_000.0, 2);
    match language {
        Language::Russian => format!("{} м²", text.replace('.', ",")),
        Language::English => format!("{text} m²"),
    }
}

/// «40 с», «2 мин 5 с», "2 min 5 s": whole seconds.
pub(crate) fn duration(seconds: f64, language: Language) -> String {
    let (second, minute) = match language {
        Language::Russian => ("с", "мин"),
        Language::English => ("s", "min"),
    };
    let whole = seconds.max(1.0).round();
    let (minutes, rest) = ((whole / 60.0).floor(), whole % 60.0);
    match (minutes > 0.0, rest > 0.0) {
        (false, _) => format!("{whole:.0} {second}"),
        (true, false) => format!("{minutes:.0} {minute}"),
        (true, true) => format!("{minutes:.0} {minute} {rest:.0} {second}"),
    }
}

fn trimmed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_told_in_minutes_and_seconds() {
        assert_eq!(duration(0.2, Language::English), "1 s");
        assert_eq!(duration(59.4, Language::Russian), "59 с");
        assert_eq!(duration(59.6, Language::English), "1 min");
        assert_eq!(duration(125.0, Language::Russian), "2 мин 5 с");
    }
}
