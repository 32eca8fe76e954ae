//! A line that takes back what it has ordered: "Bring the red cup. No, the white one", «Принеси чашку, не надо».
//!
//! Invariant: what is taken back is found by words alone, and is never done; what it becomes is for who knows the map.

use super::said::Said;
use super::verbs;
use super::vocabulary::{CORRECTIONS, HESITATIONS, Meaning, Verb};
use crate::sets::set;

/// A text in two: what it has ordered, and what corrects that.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Correction<'t> {
    pub(crate) before: &'t str,
    /// Behind "no", "I mean"; nothing where all is taken back.
    pub(crate) behind: &'t str,
    /// Whether it can be nothing else: "wait, …" may also be an order of its own.
    pub(crate) is_sure: bool,
}

/// The last correction of a text that orders before it; none where it asks.
pub(crate) fn correction(text: &str) -> Option<Correction<'_>> {
    let asks = text.trim_end().ends_with('?');
    (!asks).then(|| last(text, verbs::has_verb)).flatten()
}

/// The last correction within a question, which can be nothing else: "Where is the cup, no, the mug?"
pub(crate) fn correction_of_question(text: &str) -> Option<Correction<'_>> {
    last(text, |before| !before.trim().is_empty()).filter(|found| found.is_sure)
}

/// The last correction of a text behind a part like this.
fn last(text: &str, is_corrected: impl Fn(&str) -> bool) -> Option<Correction<'_>> {
    if super::is_too_long(text) {
        return None;
    }
    let said = Said::new(text.to_owned());
    (1..said.keys.len()).rev().filter(|&at| said.parted(at)).find_map(|at| {
        let before = &text[..said.words[at - 1].end];
        let (is_sure, behind) = takes_back(&said, at)?;
        let behind = &text[said.words.get(behind).map_or(text.len(), |word| word.start)..];
        // A run of such words is one correction, from its first.
        let goes_on = (1..at)
            .rev()
            .find(|&n| said.parted(n))
            .is_some_and(|n| takes_back(&said, n).is_some_and(|(_, end)| end >= at));
        (is_corrected(before) && !goes_on).then_some(Correction { before, behind, is_sure })
    })
}

/// Whether words from here on correct what is before them: for sure or perhaps, and where what they put instead begins,
/// which is the end where all is taken back.
fn takes_back(said: &Said, at: usize) -> Option<(bool, usize)> {
    if is_cancelled(said, at) {
        return Some((true, said.keys.len()));
    }
    let (mut end, mut is_sure) = (at, false);
    loop {
        match (said.phrase(end, &CORRECTIONS), said.phrase(end, &HESITATIONS)) {
            (Some(taken), _) => (end, is_sure) = (end + taken, true),
            (None, Some(taken)) => end += taken,
            (None, None) => break,
        }
    }
    if end == at || end >= said.keys.len() {
        return None;
    }
    // "Tea, no sugar" takes nothing back.
    let is_link = || matches!(said.meaning(end), Some((_, Meaning::Link(_) | Meaning::Not)));
    (said.parted(end) || is_link() || !said.is(end - 1, set!("NoOrPardon")))
        .then_some((is_sure, end))
}

/// Whether the rest of a text only says that nothing is to be done: "never mind", «нет, не надо», "no, wait".
fn is_cancelled(said: &Said, mut at: usize) -> bool {
    let mut is_said = false;
    while at < said.keys.len() {
        at += match (said.meaning(at), said.phrase(at, &CORRECTIONS)) {
            (Some((taken, Meaning::Verb(Verb::Stop | Verb::Needless) | Meaning::Not)), _) => {
                is_said = true;
                taken
            }
            (_, Some(taken)) => {
                is_said |= said.is(at, set!("No"));
                taken
            }
            (Some((taken, Meaning::Verb(Verb::Wait))), _) if is_said => taken,
            (Some((taken, Meaning::Filler | Meaning::Pronoun | Meaning::And)), _) => taken,
            _ => return false,
        };
    }
    is_said
}

/// A text with these words in the place of the pronoun that its one verb is done to.
pub(crate) fn with_object(text: &str, object: &str) -> Option<String> {
    let said = Said::new(text.to_owned());
    let pronouns: Vec<usize> = (0..said.keys.len())
        .filter(|&n| matches!(said.meaning(n), Some((1, Meaning::Pronoun))))
        .collect();
    match pronouns[..] {
        [] => Some(text.to_owned()),
        [at] => Some(said.with(&(at..at + 1), object)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_taken_back_is_parted_from_what_is_put_instead() {
        for (text, expected) in [
            (
                "Bring the red cup. No, the white one.",
                Some(("Bring the red cup", "the white one.")),
            ),
            ("Go to the hall, no, wait, to the lab", Some(("Go to the hall", "to the lab"))),
            ("Принеси чашку, не надо", Some(("Принеси чашку", ""))),
            ("Bring the cup. Cancel that.", Some(("Bring the cup", ""))),
            ("Принеси чашку. Хотя нет, не надо.", Some(("Принеси чашку", ""))),
            ("Поезжай в зал, точнее на кухню", Some(("Поезжай в зал", "на кухню"))),
            ("Bring the cup. Actually, the mug.", Some(("Bring the cup", "the mug."))),
            ("Поезжай на кухню, ой, в зал", Some(("Поезжай на кухню", "в зал"))),
            ("Принеси чашку, ой, то есть кружку", Some(("Принеси чашку", "кружку"))),
            ("Go to the kitchen, sorry, the hall", Some(("Go to the kitchen", "the hall"))),
            ("Bring the tea, no sugar", None),
            ("Bring the cup, please", None),
            ("Where is the cup? No, the mug", None),
            ("Go to the lab and stop", None),
            ("Принеси чашки, а в гостиной не надо", None),
        ] {
            let found = correction(text).map(|found| (found.before, found.behind));
            assert_eq!(found, expected, "{text}");
        }
    }
}
