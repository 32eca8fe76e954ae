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
use std::hash::Hash;
use std::ops::Range;

use unicode_normalization::UnicodeNormalization;

use super::english;
use super::grammar::{Case, Number, WordHints};
use super::letters::cyrillic_twin;
use super::list::Language;
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

    /// Adds an English name: as it is, its plural, its possessive, and the word that names its kind.
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
        found.sort_by_key(|m| m.name);
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

    /// Names like `text`, the nearest first: a slip of the pen in any form, or a name that holds all its words.
    #[must_use]
    pub fn near(&self, text: &str, limit: usize) -> Vec<&str> {
        let wanted = Letters::of(Spelled::of(text).key);
        let mut best: Vec<(f64, u32)> = Vec::new();
        if wanted.length == 0 || wanted.length > 4 * self.longest_key.max(8) || limit == 0 {
            return Vec::new();
        }
        // With very many names only those are compared whose stem is like the beginning of the text.
        let many = self.names.len() > MANY_NAMES;
        let mut joined = String::new();
        for (key, postings) in &self.forms {
            let stem_is_like = || {
                let head: String = wanted.key.chars().take(key.chars().count() + 1).collect();
                Letters::of(head).likeness(key, 0.7).is_some()
            };
            if many && !stem_is_like() {
                continue;
            }
            for posting in postings {
                let stem = &self.stems[posting.stem as usize];
                if posting.part {
                    let needed = if best.len() == limit { best[limit - 1].0 } else { 0.6 };
                    let Some(likeness) = wanted.likeness(key, needed) else { continue };
                    for &name in stem.all.iter().take(limit) {
                        self.keep(&mut best, limit, likeness, name);
                    }
                    continue;
                }
                for (tag, members) in &stem.members {
                    let needed = if best.len() == limit { best[limit - 1].0 } else { 0.6 };
                    joined.clear();
                    joined.push_str(key);
                    if !tag.is_empty() {
                        joined.push(' ');
                        joined.push_str(tag);
                    }
                    let Some(likeness) = wanted.likeness(&joined, needed) else { continue };
                    for &name in members {
                        self.keep(&mut best, limit, likeness, name);
                    }
                }
            }
        }
        best.into_iter().map(|(_, name)| self.shown(name)).collect()
    }

    /// The title of a name's id, in the language of that name.
    fn shown(&self, name: u32) -> &str {
        let Name { text: own, id, .. } = &self.names[name as usize];
        let title = &self.names[self.titles[id] as usize].text;
        if Language::of(own) == Language::of(title) { title } else { own }
    }

    /// Keeps the best names, each id once, in order; equal ones by the order of insertion.
    fn keep(&self, best: &mut Vec<(f64, u32)>, limit: usize, likeness: f64, name: u32) {
        let id = &self.names[name as usize].id;
        match best.iter().position(|(_, other)| self.names[*other as usize].id == *id) {
            Some(at) if best[at].0 >= likeness => return,
            Some(at) => drop(best.remove(at)),
            None => {}
        }
        best.push((likeness, name));
        best.sort_by(|(a, x), (b, y)| b.total_cmp(a).then(x.cmp(y)));
        best.truncate(limit);
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

/// From so many names on, near misses are sought among those of a like stem only.
const MANY_NAMES: usize = 5_000;

/// «Стул-17» is «Стул» and «-17», «Палата-3-б» is «Палата» and «-3-б»: the tag holds digits, capitals and single
/// letters, which no case changes. A name without a word of small letters before its tag has none.
fn split_tag(name: &str) -> (&str, &str) {
    let runs = super::letters::runs(name);
    let is_tag = |run: &super::letters::Run<'_>| {
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
struct Spelled {
    /// What all spellings share: words of small letters with a blank between them, ё as е, Latin twins as Cyrillic.
    ///
    /// A digit beside a letter begins a word, and so does a tag of capitals at the end: «К305», «КомнатаВ». Other
    /// joints matter: without them «комнату» would be «Комнат-У».
    key: String,
    /// Mark of the spelling up to case and ё, as [`crate::units::name_key`] has it.
    exact: u32,
    /// Mark of the same words in the alphabet they are typed in.
    spaced: u32,
}

impl Spelled {
    /// How faithfully a text is spelled that has the key of a form with a tag.
    fn likeness_to(&self, text: &str, form: &str, tag: &str, part: bool) -> Spelling {
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

    fn of(text: &str) -> Self {
        // A text without combining marks and compatibility letters is in NFC already.
        if text.chars().all(|c| (c as u32) < 0x300 || ('\u{400}'..='\u{4ff}').contains(&c)) {
            Self::of_nfc(text)
        } else {
            Self::of_nfc(&text.nfc().collect::<String>())
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
