//! A name under the key that forgets how it was typed, with marks that still tell spellings apart.
//!
//! Invariant: two spellings of one name have one key.

use super::Spelling;
use crate::words::letters::{OPAQUE, cyrillic_twin};
use unicode_normalization::UnicodeNormalization;

/// «Стул-17» is «Стул» and «-17», «Палата-3-б» is «Палата» and «-3-б»: the tag holds digits, capitals and single
/// letters, which no case changes. A name without a word of small letters before its tag has none.
pub(super) fn split_tag(name: &str) -> (&str, &str) {
    let runs = crate::words::letters::runs(name);
    let is_tag = |run: &crate::words::letters::Run<'_>| {
        let letters = run.text.chars().count();
        let digits = run.text.starts_with(|c: char| c.is_ascii_digit());
        let capitals = letters <= 3 && run.text.chars().all(|c| c.is_uppercase() || c.is_numeric());
        !run.is_word || digits || capitals
    };
    let cut = runs.iter().rposition(|run| !is_tag(run)).map_or(0, |last| last + 1);
    // A tag after a hyphen or blank only: «2-й» is a word, «к305» is spelled as one.
    let is_joint = runs.get(cut).is_some_and(|run| run.is_hyphen() || run.text == " ");
    let whole = runs[..cut].last().is_none_or(|run| run.text.chars().count() < 3);
    if cut == 0 || cut + 1 >= runs.len() || !is_joint || whole {
        return (name, "");
    }
    let at = runs[cut].at;
    // An odd word before the tag may decline only together with it, as «5-й этаж» does.
    let odd = runs[..cut].iter().any(|run| run.text.chars().any(|c| c.is_ascii_digit()));
    if odd { (name, "") } else { name.split_at(at) }
}

/// A text under its three equalities, found in one pass.
pub(super) struct Spelled {
    /// What all spellings share: words of small letters with a blank between them, ё as е, Latin twins as Cyrillic.
    ///
    /// A digit beside a letter begins a word, and so does a tag of capitals at the end: «К305», «КомнатаВ». Other
    /// joints matter: without them «комнату» would be «Комнат-У».
    pub(super) key: String,
    /// Mark of the spelling up to case and ё, as [`crate::units::name_key`] has it.
    pub(super) exact: u32,
    /// Mark of the same words in the alphabet they are typed in.
    pub(super) spaced: u32,
}

impl Spelled {
    /// How faithfully a text is spelled that has the key of a form with a tag.
    pub(super) fn likeness_to(&self, text: &str, form: &str, tag: &str, part: bool) -> Spelling {
        if part {
            return Spelling::Part;
        }
        // Mostly the name is written as the map has it.
        if text.strip_prefix(form) == Some(tag) {
            return Spelling::Exact;
        }
        let own = Self::of(&format!("{form}{tag}"));
        match () {
            () if self.exact == own.exact => Spelling::Exact,
            () if self.spaced == own.spaced => Spelling::Spaced,
            () => Spelling::LookAlike,
        }
    }

    pub(super) fn of(text: &str) -> Self {
        // A text without combining marks and compatibility letters is in NFC already.
        if text.chars().all(|c| (c as u32) < 0x300 || ('\u{400}'..='\u{4ff}').contains(&c)) {
            Self::of_nfc(text)
        } else {
            Self::of_nfc(&text.nfc().filter(|c| *c != OPAQUE).collect::<String>())
        }
    }

    fn of_nfc(text: &str) -> Self {
        let mut key = String::with_capacity(text.len());
        let (mut exact, mut spaced) = (Mark::new(), Mark::new());
        let (mut blank, mut joint) = (false, false);
        let (mut before, mut small_before) = (' ', 0_usize);
        for (at, c) in text.char_indices() {
            if c.is_whitespace() {
                (blank, joint) = (!key.is_empty(), true);
                continue;
            }
            if std::mem::take(&mut blank) {
                exact.add(' ');
            }
            joint |= !c.is_alphanumeric() || is_joint(before, small_before, &text[at..]);
            before = c;
            small_before = if c.is_lowercase() { small_before + 1 } else { 0 };
            for small in c.to_lowercase().map(without_yo) {
                exact.add(small);
                if !c.is_alphanumeric() {
                    continue;
                }
                if std::mem::take(&mut joint) && !key.is_empty() {
                    key.push(' ');
                    spaced.add(' ');
                }
                spaced.add(small);
                let twin = cyrillic_twin(small.to_ascii_uppercase()).filter(|_| small.is_ascii());
                key.extend(
                    twin.map_or(small, |twin| twin.to_lowercase().next().unwrap_or(twin))
                        .to_lowercase(),
                );
            }
        }
        Self { key, exact: exact.0, spaced: spaced.0 }
    }
}

fn without_yo(c: char) -> char {
    if c == 'ё' { 'е' } else { c }
}

/// Whether a word ends between two letters that nothing separates.
fn is_joint(before: char, small_before: usize, rest: &str) -> bool {
    let Some(next) = rest.chars().next() else { return false };
    if before.is_numeric() != next.is_numeric()
        && before.is_alphanumeric()
        && next.is_alphanumeric()
    {
        return true;
    }
    // «КомнатаВ», not «вZ»: three capitals at most after a word, and nothing small after them.
    small_before > 2 && next.is_uppercase() && {
        let tag = rest.chars().take_while(|c| c.is_alphanumeric()).take(4);
        tag.clone().count() < 4 && tag.clone().all(|c| !c.is_lowercase())
    }
}

/// FNV-1a over characters: a mark by which two spellings of one key are told apart.
struct Mark(u32);

impl Mark {
    pub(super) fn new() -> Self {
        Self(0x811c_9dc5)
    }

    fn add(&mut self, c: char) {
        self.0 = (self.0 ^ c as u32).wrapping_mul(0x0100_0193);
    }
}
