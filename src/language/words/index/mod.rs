//! From a form back to the names that it may be a form of: «в Комнату-Y» finds Комната-Y.
//!
//! Every form of every name of the map stands in the index under a key that forgets what people forget: case, ё,
//! hyphens and blanks, and which alphabet a look-alike letter was typed in (В and B, А and A). What is spelled exactly
//! still wins over what merely looks alike, so that Комната-В and Комната-B may both be on one map.
//!
//! Invariant: every form that [`NounPhrase::all_forms`] gives is found again.
//!
//! ```
//! use orthoframe_language::{FormIndex, NounPhrase, WordHints};
//! let mut index = FormIndex::default();
//! for (id, name) in ["Комната-В", "Комната-Z", "Кресло у окна"].into_iter().enumerate() {
//!     index.insert(&NounPhrase::parse(name, &WordHints::default()), id);
//! }
//! let found = |text| index.find(text).iter().map(|hit| hit.name).collect::<Vec<_>>();
//! assert_eq!(found("комнату b"), ["Комната-В"]);
//! assert_eq!(found("креслом у окна"), ["Кресло у окна"]);
//! assert_eq!(index.near("Комнту-Z", 1), ["Комната-Z"]);
//! ```

mod near;
mod spelled;

use super::english;
use super::grammar::{Case, Number, WordHints};
use super::identifier;
use super::list::Language;
use super::phrase::NounPhrase;
use crate::units::InOrder as _;
use spelled::Spelled;
use spelled::split_tag;
use std::collections::{HashMap, HashSet};
use std::hash::Hash;
use std::ops::Range;
use unicode_normalization::UnicodeNormalization;

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
    /// A part of the name only: «стол» for «Письменный стол».
    Part,
}

/// A name that a form was found to belong to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Hit<'i, T> {
    pub id: &'i T,
    /// The name that it is a form of.
    pub name: &'i str,
    /// The first name of this id: how the map calls it.
    pub title: &'i str,
    pub readings: Readings,
    pub spelling: Spelling,
}

/// The index of forms over ids of the caller's: any form, however it was typed, gives its names back.
///
/// Names that differ in their tag alone («Стул-1» … «Стул-900») share a stem, which is declined once: 40 000 names of a
/// hospital are some dozens of stems.
#[derive(Debug, Clone)]
pub struct FormIndex<T> {
    names: Vec<Name<T>>,
    /// The first name of each id.
    titles: HashMap<T, u32>,
    stems: Vec<Stem>,
    /// Stems by how they are written, so that the next name finds its own.
    known: HashMap<(bool, Box<str>), u32>,
    /// Forms of stems.
    forms: HashMap<Box<str>, Vec<Posting>>,
    /// The first words of forms of several.
    first_words: HashSet<Box<str>>,
    longest_key: usize,
}

#[derive(Debug, Clone)]
struct Name<T> {
    text: Box<str>,
    /// What follows the stem, blank or hyphen included; empty for most names.
    tag: Box<str>,
    id: T,
}

/// What names of one kind share, and the names by the keys of their tags.
#[derive(Debug, Clone, Default)]
struct Stem {
    members: HashMap<Box<str>, Vec<u32>>,
    all: Vec<u32>,
}

#[derive(Debug, Clone)]
struct Posting {
    stem: u32,
    readings: Readings,
    form: Box<str>,
    /// A form of a part of the stem only.
    part: bool,
}

/// How a text matched a posting.
struct Match {
    name: u32,
    readings: Readings,
    spelling: Spelling,
}

impl<T> Default for FormIndex<T> {
    fn default() -> Self {
        Self {
            names: Vec::new(),
            titles: HashMap::new(),
            stems: Vec::new(),
            known: HashMap::new(),
            forms: HashMap::new(),
            first_words: HashSet::new(),
            longest_key: 0,
        }
    }
}

impl<T: Clone + Eq + Hash> FormIndex<T> {
    /// Adds all forms of a Russian name, and of its parts that people call it by: «стол» for «Письменный стол».
    /// An id may have several names; the first is its title.
    pub fn insert(&mut self, phrase: &NounPhrase, id: T) {
        let stem = self.new_stem();
        self.decline(phrase, stem);
        self.add_name(phrase.name(), "", stem, id);
    }

    /// Adds a Russian name as [`Self::insert`] does, declining only what no name before it had.
    pub fn insert_name(&mut self, name: &str, hints: &WordHints, id: T) {
        let name: String = name.nfc().collect();
        let (text, tag) = if hints.forms.is_empty() { split_tag(&name) } else { (&*name, "") };
        if tag.is_empty() && !hints.forms.is_empty() {
            return self.insert(&NounPhrase::parse(&name, hints), id);
        }
        let stem = match self.known.get(&(true, text.into())) {
            Some(stem) => *stem,
            None => {
                let stem = self.new_stem();
                self.known.insert((true, text.into()), stem);
                self.decline(&NounPhrase::parse(text, hints), stem);
                stem
            }
        };
        self.add_name(&name, tag, stem, id);
    }

    /// Adds an English name: as it is, its plural, its possessive, the word that names its kind, and what is said for an
    /// identifier.
    pub fn insert_english(&mut self, english_name: &str, id: T) {
        let (text, tag) = split_tag(english_name);
        let stem = match self.known.get(&(false, text.into())) {
            Some(stem) => *stem,
            None => {
                let stem = self.new_stem();
                self.known.insert((false, text.into()), stem);
                self.add_english(text, stem, false);
                if let Some(short) = english::kind(text) {
                    self.add_english(short, stem, true);
                }
                for said in identifier::spoken(text) {
                    match Language::of(&said) {
                        Language::English => self.add_english(&said, stem, true),
                        Language::Russian => {
                            let phrase = NounPhrase::parse(&said, &WordHints::default());
                            self.add_forms(&phrase, stem, true);
                        }
                    }
                }
                stem
            }
        };
        self.add_name(english_name, tag, stem, id);
    }

    /// Adds the name of a kind to all things of that kind.
    pub fn insert_kind(&mut self, phrase: &NounPhrase, ids: &[T]) {
        let stem = self.new_stem();
        self.decline(phrase, stem);
        for id in ids {
            self.add_name(phrase.name(), "", stem, id.clone());
        }
    }

    /// Adds the English name of a kind to all things of that kind.
    pub fn insert_english_kind(&mut self, name: &str, ids: &[T]) {
        let stem = self.new_stem();
        self.add_english(name, stem, false);
        if let Some(short) = english::kind(name) {
            self.add_english(short, stem, true);
        }
        for id in ids {
            self.add_name(name, "", stem, id.clone());
        }
    }

    fn new_stem(&mut self) -> u32 {
        self.stems.push(Stem::default());
        u32::try_from(self.stems.len() - 1).expect("fewer than four thousand million names")
    }

    fn decline(&mut self, phrase: &NounPhrase, stem: u32) {
        self.add_forms(phrase, stem, false);
        for short in phrase.shorter() {
            self.add_forms(&short, stem, true);
        }
    }

    fn add_forms(&mut self, phrase: &NounPhrase, stem: u32, part: bool) {
        let mut forms: Vec<(String, Readings)> = Vec::new();
        let own = (phrase.number(), Case::Nominative, phrase.name().to_owned());
        for (number, case, form) in phrase.all_forms().into_iter().chain([own]) {
            let reading = Readings::one(number, case);
            match forms.iter_mut().find(|(other, _)| *other == form) {
                Some((_, readings)) => readings.add(reading),
                None => forms.push((form, reading)),
            }
        }
        for (form, readings) in forms {
            self.add_form(&form, stem, readings, part);
        }
    }

    fn add_english(&mut self, english_name: &str, stem: u32, part: bool) {
        let of = |number: Number| {
            Case::ALL.iter().fold(Readings::default(), |mut all, case| {
                all.add(Readings::one(number, *case));
                all
            })
        };
        self.add_form(english_name, stem, of(Number::Singular), part);
        self.add_form(&english::plural(english_name), stem, of(Number::Plural), part);
        let genitive = Readings::one(Number::Singular, Case::Genitive);
        self.add_form(&english::possessive(english_name), stem, genitive, part);
    }

    fn add_name(&mut self, text: &str, tag: &str, stem: u32, id: T) {
        let number = u32::try_from(self.names.len())
            .expect("a map has fewer than four thousand million names");
        self.titles.entry(id.clone()).or_insert(number);
        self.names.push(Name { text: text.into(), tag: tag.into(), id });
        let stem = &mut self.stems[stem as usize];
        let key = Spelled::of(tag).key;
        self.longest_key = self.longest_key.max(Spelled::of(text).key.len() + 8);
        stem.members.entry(key.into()).or_default().push(number);
        stem.all.push(number);
    }

    fn add_form(&mut self, form: &str, stem: u32, readings: Readings, part: bool) {
        let key = Spelled::of(form).key;
        if key.is_empty() {
            return;
        }
        self.longest_key = self.longest_key.max(key.len());
        if let Some((first, _)) = key.split_once(' ')
            && !self.first_words.contains(first)
        {
            self.first_words.insert(first.into());
        }
        let postings = self.forms.entry(key.into()).or_default();
        // The forms of one stem come one after the other, so that its postings are the last ones.
        let mut own = postings.iter_mut().rev().take_while(|posting| posting.stem == stem);
        match own.find(|posting| *posting.form == *form && posting.part == part) {
            Some(posting) => posting.readings.add(readings),
            None => postings.push(Posting { stem, readings, form: form.into(), part }),
        }
    }

    /// Every way to cut a key into the form of a stem and a tag.
    fn cuts(key: &str) -> impl Iterator<Item = (&str, &str)> {
        let blanks = key.match_indices(' ').map(|(at, _)| (&key[..at], &key[at + 1..]));
        std::iter::once((key, "")).chain(blanks)
    }

    /// Whether some name is called so, in whole or in part.
    fn is_known(&self, key: &str) -> bool {
        Self::cuts(key).any(|(form, tag)| {
            self.forms.get(form).is_some_and(|postings| {
                tag.is_empty()
                    || postings
                        .iter()
                        .any(|p| self.stems[p.stem as usize].members.contains_key(tag))
            })
        })
    }

    /// The names that a text matches as a whole; with `loose`, also those of which it is a part.
    fn matches(&self, text: &str, spelled: &Spelled) -> Vec<Match> {
        let mut found = Vec::new();
        for (form, tag) in Self::cuts(&spelled.key) {
            for posting in self.forms.get(form).into_iter().flatten() {
                let Some(members) = self.stems[posting.stem as usize].members.get(tag) else {
                    continue;
                };
                // All of one tag key are spelled by the same letters, nearly always by the very same tag.
                let mut judged: Option<(&str, Spelling)> = None;
                for &name in members {
                    let own = &*self.names[name as usize].tag;
                    let spelling = match judged {
                        Some((tag, spelling)) if tag == own => spelling,
                        _ => spelled.likeness_to(text, &posting.form, own, posting.part),
                    };
                    judged = Some((own, spelling));
                    found.push(Match { name, readings: posting.readings, spelling });
                }
            }
        }
        found
    }

    /// Names of which a text is the stem without its tag, or a part of it: «комнату» for «Комната-В».
    fn parts(&self, key: &str) -> Vec<Match> {
        let postings = self.forms.get(key).into_iter().flatten();
        postings
            .flat_map(|posting| {
                let all = self.stems[posting.stem as usize].all.iter();
                all.map(|&name| Match {
                    name,
                    readings: posting.readings,
                    spelling: Spelling::Part,
                })
            })
            .collect()
    }

    /// The names that the text is a form of; of several spellings, the most faithful only. An id occurs once.
    #[must_use]
    pub fn find(&self, text: &str) -> Vec<Hit<'_, T>> {
        let spelled = Spelled::of(text);
        let mut found = self.matches(text, &spelled);
        if found.iter().all(|m| m.spelling == Spelling::Part) {
            found.extend(self.parts(&spelled.key));
        }
        let Some(best) = found.iter().map(|m| m.spelling).min() else { return Vec::new() };
        let mut hits: Vec<Hit<'_, T>> = Vec::new();
        let mut place: HashMap<&T, usize> = HashMap::new();
        found.retain(|m| m.spelling == best);
        found.order_by_key(|m| m.name);
        for Match { name, readings, spelling } in found {
            let Name { text, id, .. } = &self.names[name as usize];
            let at = *place.entry(id).or_insert(hits.len());
            match hits.get_mut(at) {
                Some(hit) => hit.readings.add(readings),
                None => {
                    let title = &self.names[self.titles[id] as usize].text;
                    hits.push(Hit { id, name: text, title, readings, spelling });
                }
            }
        }
        hits
    }

    /// Whether some form of several words begins as a text does.
    #[must_use]
    pub(crate) fn begins_longer(&self, text: &str) -> bool {
        let key = Spelled::of(text).key;
        self.first_words.contains(key.split(' ').next().unwrap_or_default())
    }

    /// How many words from `from` on the longest form of some name takes; 0 when none begins there.
    ///
    /// `words` are the byte ranges of the words of `text`, as [`word_ranges`](super::word_ranges) gives them.
    #[must_use]
    pub fn length_at(&self, text: &str, words: &[Range<usize>], from: usize) -> usize {
        let mut key = String::new();
        let mut best = 0;
        for (taken, word) in words[from.min(words.len())..].iter().enumerate() {
            if !key.is_empty() {
                key.push(' ');
            }
            key.push_str(&Spelled::of(&text[word.clone()]).key);
            if key.len() > self.longest_key {
                break;
            }
            if self.is_known(&key) {
                best = taken + 1;
            }
        }
        best
    }

    /// The longest form of some name that begins at a word, with the number of words it takes.
    #[must_use]
    pub fn longest_at(
        &self,
        text: &str,
        words: &[Range<usize>],
        from: usize,
    ) -> Option<(usize, Vec<Hit<'_, T>>)> {
        match self.length_at(text, words, from) {
            0 => None,
            taken => {
                Some((taken, self.find(&text[words[from].start..words[from + taken - 1].end])))
            }
        }
    }

    /// The title of a name's id, in the language of that name.
    fn shown(&self, name: u32) -> &str {
        let Name { text: own, id, .. } = &self.names[name as usize];
        let title = &self.names[self.titles[id] as usize].text;
        if Language::of(own) == Language::of(title) { title } else { own }
    }

    /// The title of every id, in the order in which they were first inserted: for completion of what is typed.
    pub fn titles(&self) -> impl Iterator<Item = &str> {
        let is_title = |(n, name): &(usize, &Name<T>)| self.titles[&name.id] as usize == *n;
        self.names.iter().enumerate().filter(is_title).map(|(_, name)| &*name.text)
    }

    /// How many names and how many different forms of their stems it holds.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        (self.names.len(), self.forms.len())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn index(names: &[&'static str]) -> FormIndex<&'static str> {
        let mut index = FormIndex::default();
        for name in names {
            index.insert_name(name, &WordHints::default(), *name);
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
        check(&rooms, "дверь-вZ", &["Дверь-ВZ"]);
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
        let words = super::super::word_ranges(text);
        let (taken, hits) = things.longest_at(text, &words, 1).unwrap();
        assert_eq!((taken, *hits[0].id), (3, "Стол у окна"));
        assert!(things.longest_at(text, &words, 0).is_none());
    }

    #[test]
    fn a_part_names_the_thing_when_nothing_is_called_so() {
        let things = index(&["Письменный стол директора", "Окно", "Комната-В", "Комната-У"]);
        check(&things, "столом", &["Письменный стол директора"]);
        check(&things, "письменному столу", &["Письменный стол директора"]);
        check(&things, "комнату", &["Комната-В", "Комната-У"]);
        let more = index(&["Письменный стол", "Стол"]);
        check(&more, "стола", &["Стол"]);
    }

    #[test]
    fn near_names_are_offered() {
        let rooms = index(&["Комната-В", "Комната-Z", "Письменный стол"]);
        assert_eq!(rooms.near("Конмату-Z", 1), ["Комната-Z"]);
        assert_eq!(rooms.near("столл", 3), ["Письменный стол"]);
        assert!(rooms.near("подводная лодка", 3).is_empty());
        assert!(rooms.near(&"я".repeat(100_000), 3).is_empty());
    }
}
