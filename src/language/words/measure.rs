//! Lengths and areas as people say them: two digits after the point at most, none below a metre.
//!
//! Invariant: what is said is the value rounded, in the decimal mark of the language.

use super::list::Language;

/// «40 см», «1,5 м», "1.5 m"
pub(crate) fn length(cm: f64, language: Language) -> String {
    let metres = cm >= 100.0;
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

fn trimmed(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    if text.contains('.') {
        text.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        text
    }
}
