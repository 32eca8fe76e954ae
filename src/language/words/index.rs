//! From a form back to the names that it may be a form of: «в Комнату-Y» finds Комната-Y.
//!
//! Every form of every name of the map stands in the index under a key that forgets what people forget: case, ё,
//! hyphens and blanks, and which alphabet a look-alike letter was typed in (В and B, А and A). What is spelled exactly
//! still wins over what merely looks alike, so that Комната-В and Комната-B may both be on one map.
//!
//! Invariant: every form that [`NounPhrase::all_forms`] gives is found again.
//!
//! ```
//! use orthoframe::language::{FormIndex, NounPhrase, WordHints};
//! let mut index = FormIndex::default();
//! for (id, name) in ["Комната-В", "Комната-Z", "Кресло у окна"].into_iter().enumerate() {
//!     index.insert(&NounPhrase::parse(name, &WordHints::default()), id);
//! }
//! let found = |text| index.find(text).iter().map(|hit| hit.name).collect::<Vec<_>>();
//! assert_eq!(found("комнату b"), ["Комната-В"]);
//! assert_eq!(found("креслом у окна"), ["Кресло у окна"]);
//! assert_eq!(index.near("Комнту-Z", 1), ["Комната-Z"]);
//! ```

use std::collections::HashMap;

use unicode_normalization::UnicodeNormalization;

use super::english;
use super::grammar::{Case, Number};
use super::letters::cyrillic_twin;
use super::phrase::NounPhrase;

/// Which cases and numbers a form may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Hash)]
pub struct Readings(u16);

impl Readings {
    /// Every case and number at once: a name that does not decline.
    pub const ANY: Self = Self((1 << 14) - 1);

    #[must_use]
    pub fn one(number: Number, case: Case) -> Self {
        Self(1 << (number.index() * 7 + case.index()))
    }

    #[must_use]
    pub fn has(self, number: Number, case: Case) -> bool {
        self.0 & Self::one(number, case).0 != 0
    }

    /// Whether it may stand in this case, in either number.
    #[must_use]
    pub fn has_case(self, case: Case) -> bool {
        Number::BOTH.iter().any(|number| self.has(*number, case))
    }

    /// Whether it may be a singular.
    #[must_use]
    pub fn is_singular(self) -> bool {
        Case::ALL.iter().any(|case| self.has(Number::Singular, *case))
    }

    fn add(&mut self, other: Self) {
        self.0 |= other.0;
    }
}

/// How faithfully a form was spelled, best first.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Spelling {
    /// Up to case and ё.
    Exact,
    /// Other hyphens or blanks.
    Spaced,
    /// Letters of the other alphabet that look alike.
    LookAlike,
}

/// A name that a form was found to belong to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hit<'i, T> {
    pub id: &'i T,
    /// The name as the map writes it.
    pub name: &'i str,
    pub readings: Readings,
    pub spelling: Spelling,
}

/// The index of forms over ids of the caller's. See the [module](self).
#[derive(Debug, Clone)]
pub struct FormIndex<T> {
    names: Vec<(Box<str>, T)>,
    forms: HashMap<Box<str>, Vec<Posting>>,
    longest_key: usize,
}

#[derive(Debug, Clone, Copy)]
struct Posting {
    name: u32,
    readings: Readings,
    exact: u32,
    spaced: u32,
}

impl<T> Default for FormIndex<T> {
    fn default() -> Self {
        Self { names: Vec::new(), forms: HashMap::new(), longest_key: 0 }
    }
}

impl<T: PartialEq> FormIndex<T> {
    /// Adds all forms of a Russian name. An id may have several names.
    pub fn insert(&mut self, phrase: &NounPhrase, id: T) {
        let name = self.add_name(phrase.name(), id);
        let mut forms: Vec<(String, Readings)> = Vec::new();
        for (number, case, form) in phrase.all_forms() {
            let reading = Readings::one(number, case);
            match forms.iter_mut().find(|(other, _)| *other == form) {
                Some((_, readings)) => readings.add(reading),
                None => forms.push((form, reading)),
            }
        }
        forms.push((phrase.name().into(), Readings::one(phrase.number(), Case::Nominative)));
        for (form, readings) in forms {
            self.add_form(&form, name, readings);
        }
    }

    /// Adds an English name: as it is, its plural, its possessive.
    pub fn insert_english(&mut self, english_name: &str, id: T) {
        let name = self.add_name(english_name, id);
        let of = |number: Number| {
            Case::ALL.iter().fold(Readings::default(), |mut all, case| {
                all.add(Readings::one(number, *case));
                all
            })
        };
        self.add_form(english_name, name, of(Number::Singular));
        self.add_form(&english::plural(english_name), name, of(Number::Plural));
        self.add_form(
            &english::possessive(english_name),
            name,
            Readings::one(Number::Singular, Case::Genitive),
        );
    }

    fn add_name(&mut self, name: &str, id: T) -> u32 {
        self.names.push((name.into(), id));
        u32::try_from(self.names.len() - 1)
            .expect("a map has fewer than four thousand million names")
    }

    fn add_form(&mut self, form: &str, name: u32, readings: Readings) {
        let Spelled { key, exact, spaced } = Spelled::of(form);
        if key.is_empty() {
            return;
        }
        self.longest_key = self.longest_key.max(key.chars().count());
        let postings = self.forms.entry(key.into()).or_default();
        match postings.iter_mut().find(|p| p.name == name && p.exact == exact) {
            Some(posting) => posting.readings.add(readings),
            None => postings.push(Posting { name, readings, exact, spaced }),
        }
    }

    /// The names that the text is a form of; of several spellings, the most faithful only. An id occurs once.
    #[must_use]
    pub fn find(&self, text: &str) -> Vec<Hit<'_, T>> {
        let Spelled { key, exact, spaced } = Spelled::of(text);
        let Some(postings) = self.forms.get(key.as_str()) else { return Vec::new() };
        let spelling = |posting: &Posting| match () {
            () if posting.exact == exact => Spelling::Exact,
            () if posting.spaced == spaced => Spelling::Spaced,
            () => Spelling::LookAlike,
        };
        let best = postings.iter().map(spelling).min();
        let mut hits: Vec<Hit<'_, T>> = Vec::new();
        for posting in postings.iter().filter(|posting| Some(spelling(posting)) == best) {
            let (name, id) = &self.names[posting.name as usize];
            match hits.iter_mut().find(|hit| hit.id == id) {
                Some(hit) => hit.readings.add(posting.readings),
                None => hits.push(Hit {
                    id,
                    name,
                    readings: posting.readings,
                    spelling: spelling(posting),
                }),
            }
        }
        hits
    }

    /// The longest run of words from `from` on that is a form of some name, with the number of words it takes.
    ///
    /// `text` is the whole sentence and `words` the byte ranges of its words, in order.
    #[must_use]
    pub fn longest_at(
        &self,
        text: &str,
        words: &[std::ops::Range<usize>],
        from: usize,
    ) -> Option<(usize, Vec<Hit<'_, T>>)> {
        let start = words.get(from)?.start;
        let mut key = String::new();
        let mut best = None;
        for (taken, word) in words[from..].iter().enumerate() {
            key.push_str(&Spelled::of(&text[word.clone()]).key);
            if key.chars().count() > self.longest_key {
                break;
            }
            if self.forms.contains_key(key.as_str()) {
                best = Some((taken + 1, word.end));
            }
        }
        best.map(|(taken, end)| (taken, self.find(&text[start..end])))
    }

    /// Names like `text`, the nearest first: a slip of the pen in any form, or a name that holds all its words.
    #[must_use]
    pub fn near(&self, text: &str, limit: usize) -> Vec<&str> {
        let wanted = Letters::of(Spelled::of(text).key);
        let mut best: Vec<(f64, u32)> = Vec::new();
        if wanted.length == 0 || wanted.length > 4 * self.longest_key.max(8) || limit == 0 {
            return Vec::new();
        }
        for (key, postings) in &self.forms {
            let needed = if best.len() == limit { best[limit - 1].0 } else { 0.6 };
            let Some(likeness) = wanted.likeness(key, needed) else { continue };
            for posting in postings {
                self.keep(&mut best, limit, likeness, posting.name);
            }
        }
        best.into_iter().map(|(_, name)| self.names[name as usize].0.as_ref()).collect()
    }

    /// Keeps the best names, each once, in order; equal ones by the order of insertion.
    fn keep(&self, best: &mut Vec<(f64, u32)>, limit: usize, likeness: f64, name: u32) {
        let same =
            |other: &(f64, u32)| self.names[other.1 as usize].0 == self.names[name as usize].0;
        match best.iter().position(same) {
            Some(at) if best[at].0 >= likeness => return,
            Some(at) => drop(best.remove(at)),
            None => {}
        }
        best.push((likeness, name));
        best.sort_by(|(a, x), (b, y)| b.total_cmp(a).then(x.cmp(y)));
        best.truncate(limit);
    }

    /// How many names and how many different forms it holds.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.names.len(), self.forms.len())
    }
}

/// A text under its three equalities, found in one pass.
struct Spelled {
    /// What all spellings share: letters and digits only, small, ё as е, Latin twins as Cyrillic.
    key: String,
    /// Mark of the spelling up to case and ё, as [`crate::units::name_key`] has it.
    exact: u32,
    /// Mark of the spelling without hyphens and blanks.
    spaced: u32,
}

impl Spelled {
    fn of(text: &str) -> Self {
        // A text without combining marks and compatibility letters is in NFC already.
        if text.chars().all(|c| (c as u32) < 0x300 || ('\u{400}'..='\u{4ff}').contains(&c)) {
            Self::of_letters(text.chars(), text.len())
        } else {
            Self::of_letters(text.nfc(), text.len())
        }
    }

    fn of_letters(text: impl Iterator<Item = char>, length: usize) -> Self {
        let mut key = String::with_capacity(length);
        let (mut exact, mut spaced) = (Mark::new(), Mark::new());
        let mut blank = false;
        for c in text.flat_map(char::to_lowercase) {
            let c = if c == 'ё' { 'е' } else { c };
            if c.is_whitespace() {
                blank = !key.is_empty();
                continue;
            }
            if std::mem::take(&mut blank) {
                exact.add(' ');
            }
            exact.add(c);
            if c.is_alphanumeric() {
                spaced.add(c);
                key.push(if c.is_ascii() {
                    cyrillic_twin(c.to_ascii_uppercase()).map_or(c, small)
                } else {
                    c
                });
            }
        }
        Self { key, exact: exact.0, spaced: spaced.0 }
    }
}

fn small(c: char) -> char {
    c.to_lowercase().next().unwrap_or(c)
}

/// FNV-1a over characters: a mark by which two spellings of one key are told apart.
struct Mark(u32);

impl Mark {
    fn new() -> Self {
        Self(0x811c_9dc5)
    }

    fn add(&mut self, c: char) {
        self.0 = (self.0 ^ c as u32).wrapping_mul(0x0100_0193);
    }
}

/// A key with its letters counted, so that most others are seen to be far without comparing.
struct Letters {
    key: String,
    length: usize,
    counts: [u8; 64],
}

impl Letters {
    fn of(key: String) -> Self {
        let (counts, length) = Self::count(&key);
        Self { key, length, counts }
    }

    fn count(key: &str) -> ([u8; 64], usize) {
        let mut counts = [0_u8; 64];
        let mut length = 0;
        for c in key.chars() {
            let slot = &mut counts[c as usize % 64];
            *slot = slot.saturating_add(1);
            length += 1;
        }
        (counts, length)
    }

    /// How alike two keys are, from 0 to 1; none when surely not more than `needed`.
    fn likeness(&self, other: &str, needed: f64) -> Option<f64> {
        let (counts, length) = Self::count(other);
        let longest = self.length.max(length) as f64;
        let holds = self.length >= 3
            && (other.contains(&self.key) || (length >= 4 && self.key.contains(other)));
        if holds {
            let likeness = 0.75 + 0.2 * self.length.min(length) as f64 / longest;
            return (likeness >= needed).then_some(likeness);
        }
        let missing: u32 =
            self.counts.iter().zip(&counts).map(|(a, b)| u32::from(a.abs_diff(*b))).sum();
        // An edit mends two of these differences at most.
        if 1.0 - f64::from(missing.div_ceil(2)) / longest < needed {
            return None;
        }
        let likeness = strsim::normalized_damerau_levenshtein(&self.key, other);
        (likeness >= needed).then_some(likeness)
    }
}

#[cfg(test)]
mod tests {
    use super::super::grammar::WordHints;
    use super::*;

    fn index(names: &[&'static str]) -> FormIndex<&'static str> {
        let mut index = FormIndex::default();
        for name in names {
            index.insert(&NounPhrase::parse(name, &WordHints::default()), *name);
        }
        index
    }

    fn check(index: &FormIndex<&'static str>, text: &str, expected: &[&str]) {
        assert_eq!(
            index.find(text).iter().map(|hit| *hit.id).collect::<Vec<_>>(),
            expected,
            "{text}"
        );
    }

    #[test]
    fn forms_find_their_names_however_they_are_typed() {
        let rooms = index(&["Комната-В", "Дверь-ВZ", "Тумбочка-1", "Ковёр"]);
        for text in ["комнаты-в", "КОМНАТУ В", "Комнате–B", "КомнатаВ", "комнатою-В"]
        {
            check(&rooms, text, &["Комната-В"]);
        }
        check(&rooms, "дверь bz", &["Дверь-ВZ"]);
        check(&rooms, "тумбочке 1", &["Тумбочка-1"]);
        check(&rooms, "ковер", &["Ковёр"]);
        check(&rooms, "Комнату-Z", &[]);
        check(&rooms, "", &[]);
    }

    #[test]
    fn exact_spelling_wins_over_look_alike_letters() {
        let rooms = index(&["Комната-В", "Комната-B"]);
        check(&rooms, "Комнату-В", &["Комната-В"]);
        check(&rooms, "Комнату-B", &["Комната-B"]);
        check(&rooms, "Комнату В", &["Комната-В"]);
    }

    #[test]
    fn a_form_of_several_names_gives_them_all() {
        let things = index(&["Стул", "Стулья"]);
        check(&things, "стульями", &["Стул", "Стулья"]);
        let hit = &things.find("стула")[0];
        assert!(
            hit.readings.has(Number::Singular, Case::Genitive)
                && !hit.readings.has_case(Case::Dative)
        );
    }

    #[test]
    fn the_longest_name_is_taken_from_a_sentence() {
        let things = index(&["Стол", "Стол у окна", "окно"]);
        let text = "на стол у окна справа";
        let words: Vec<_> = super::super::letters::runs(text)
            .iter()
            .filter(|run| run.is_word)
            .map(|run| run.at..run.at + run.text.len())
            .collect();
        let (taken, hits) = things.longest_at(text, &words, 1).unwrap();
        assert_eq!((taken, *hits[0].id), (3, "Стол у окна"));
        assert!(things.longest_at(text, &words, 0).is_none());
    }

    #[test]
    fn near_names_are_offered() {
        let rooms = index(&["Комната-В", "Комната-Z", "Письменный стол"]);
        assert_eq!(rooms.near("Конмату-Z", 1), ["Комната-Z"]);
        assert_eq!(rooms.near("стол", 3), ["Письменный стол"]);
        assert!(rooms.near("подводная лодка", 3).is_empty());
        assert!(rooms.near(&"я".repeat(100_000), 3).is_empty());
    }
}
