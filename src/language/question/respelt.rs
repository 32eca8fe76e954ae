//! A slip of the pen: a word that nothing knows, a single slip away from one word of the map's.
//!
//! Invariant: a word that is a word is never mended, nor one that could be either of two; what was understood is said with
//! the answer.

use super::grammar::{Item, Sentence};
use super::mark::Mark;
use super::{Answer, Asker, Memory, vocabulary};
use crate::sets::Set;
use crate::units::name_key;
use crate::words::{self, Language, word_keys, word_ranges};

/// Shorter words are too like each other.
const SHORTEST: usize = 4;

impl Asker<'_> {
    /// The answer to a question with its mistyped words mended, and what was understood.
    pub(super) fn answer_respelt(
        &self,
        text: &str,
        language: Language,
        memory: &Memory,
    ) -> Option<Answer> {
        let mended = self.respelt(text)?;
        match self.answer(&mended, language, memory) {
            Ok(answer) => Some(answer.understood_as(&mended, language)),
            // What asks of a longer line is told by that.
            Err(_) => self.salvaged(&mended, language, memory).and_then(Result::ok),
        }
    }

    /// A text with what may be slips in it mended, which a person has to confirm: short words too, wherever they stand, and
    /// those of questions ("how mnay"). None where nothing is.
    #[must_use]
    pub fn perhaps_respelt(&self, text: &str) -> Option<String> {
        let unknown = self.unknown_keys(text);
        let words = word_ranges(text).into_iter().zip(word_keys(text)).rev();
        let mut mended = text.to_owned();
        let unknown = words.filter(|(_, key)| unknown.contains(key) && is_mistyped(key));
        for (at, key) in unknown.filter(|(_, key)| key.chars().count() > 2) {
            let named = self.mind.lexicon.nouns.respelt(&key);
            let listed = vocabulary::near(&key);
            let word: &str = match (&named, &listed[..]) {
                (Some(named), []) => named,
                (Some(named), [only]) if *only == name_key(named) => named,
                (None, [only]) => only,
                _ => continue,
            };
            mended.replace_range(at, word);
        }
        (mended != text).then_some(mended)
    }

    /// A text with its mistyped words mended; none where nothing is.
    fn respelt(&self, text: &str) -> Option<String> {
        let (words, keys) = (word_ranges(text), word_keys(text));
        let unknown = self.unknown_keys(text);
        let mut mended = text.to_owned();
        let mut any = false;
        for at in (0..keys.len()).rev() {
            let key = &keys[at];
            if key.chars().count() < SHORTEST || !unknown.contains(key) {
                continue;
            }
            // No dictionary of English is at hand: only where a noun must stand.
            let is_placed =
                Language::of(key) == Language::Russian || at > 0 && precedes_noun(&keys[at - 1]);
            let mistyped = is_placed && is_mistyped(key);
            let word = self.mind.lexicon.nouns.respelt(key).filter(|_| mistyped);
            // «Coke» is no slip of "coe".
            let is_long = |word: &str| word.chars().count() >= SHORTEST;
            if let Some(word) = word.filter(|w| is_long(w) && is_slip(key, &w.to_lowercase())) {
                mended.replace_range(words[at].clone(), &word);
                any = true;
            }
        }
        any.then_some(mended)
    }

    /// The words of a text that nothing knows.
    fn unknown_keys(&self, text: &str) -> Vec<String> {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let items = sentence.items();
        let unknown = items.iter().filter_map(|item| match item {
            Item::Unknown(words) => Some(sentence.keys[words.clone()].to_vec()),
            _ => None,
        });
        unknown.flatten().collect()
    }
}

/// Whether fingers slip so from what was meant. A letter for another in English is so only where its key is beside the
/// other's: "cable" and "plate" are words, and no table and no place.
fn is_slip(typed: &str, meant: &str) -> bool {
    const KEYS: [&str; 3] = ["qwertyuiop", "asdfghjkl", "zxcvbnm"];
    let differ: Vec<(char, char)> =
        typed.chars().zip(meant.chars()).filter(|(typed, meant)| typed != meant).collect();
    let [(typed_key, meant_key)] = differ[..] else { return true };
    if typed.chars().count() != meant.chars().count() || Language::of(typed) == Language::Russian {
        return true;
    }
    let place = |key: char| {
        KEYS.iter()
            .enumerate()
            .find_map(|(row, keys)| Some((row, keys.chars().position(|k| k == key)?)))
    };
    match (place(typed_key), place(meant_key)) {
        (Some((row, at)), Some((other_row, other_at))) => {
            row.abs_diff(other_row) <= 1 && at.abs_diff(other_at) <= 1
        }
        _ => false,
    }
}

/// Whether a word is none that is known to be one: "Are there any left?" has no lift in it.
fn is_mistyped(key: &str) -> bool {
    let is_word = match Language::of(key) {
        Language::Russian => words::is_russian_word(key),
        Language::English => words::everyday::is_in_list(key),
    };
    !is_word && !vocabulary::is_in_a_phrase(key)
}

/// Whether a noun must follow an English word: an article, whose it is, how many, a quality.
fn precedes_noun(key: &str) -> bool {
    static WHOSE: Set = Set::named("PossessiveWord");
    let mark = vocabulary::longest(&[key.to_owned()]).map(|(_, mark)| mark);
    WHOSE.contains(&key)
        || key == "many"
        || matches!(
            mark,
            Some(Mark::The | Mark::A | Mark::All | Mark::Each | Mark::Which | Mark::HowMany)
        )
}

#[cfg(test)]
mod tests {
    use super::is_slip;

    #[test]
    fn a_word_beside_another_on_no_keyboard_is_no_slip() {
        for (typed, meant) in
            [("kichen", "kitchen"), ("tabel", "table"), ("bool", "book"), ("lampp", "lamp")]
        {
            assert!(is_slip(typed, meant), "{typed}");
        }
        for (typed, meant) in
            [("cable", "table"), ("plate", "place"), ("boot", "book"), ("fork", "work")]
        {
            assert!(!is_slip(typed, meant), "{typed}");
        }
        assert!(is_slip("столк", "столб"));
    }
}
