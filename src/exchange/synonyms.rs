//! Foreign words for rooms, things and places, and what they are called here: `rules/import-synonyms.toml`.
//!
//! A word is looked up by its parts: `OfficeChair_Black-3` is *office chair black 3*. Letters are compared without case,
//! numbers are left aside. Of a room the longest run of parts that the table knows wins, the last of equally long ones:
//! *Anna's bedroom* is a bedroom. A thing is never told by a part of its word, for a *shower glass* is no glass, a *coat
//! rack* no rack and a *cup holder* no cup: the whole word stands in the table, or it is a *head* (a noun of which every
//! compound is one: any *… chair* is a chair) with words before it or a maker's name behind a hyphen (`Chair-Breuer`), or words of the
//! table's `plain`, `colour` and `material` lists are beside it, which say how a thing looks and never what it is.
//!
//! **Invariant.** Names of one list are distinct; a user's table is laid over the built-in one: entries of the same
//! name are replaced field by field, words of both stay, and of one word the later meaning holds.

use std::collections::{BTreeMap, HashMap, HashSet};
use std::ops::Range;
use std::path::Path;

use serde::Deserialize;

use crate::map::Gender;
use crate::units::{Bilingual, Carried, Cm, Source, carried, name_key, said};

use super::ImportError;

/// The table that the crate brings along.
pub static SYNONYMS: Carried = carried!("../../rules/import-synonyms.toml");

/// What a foreign word means.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Meaning {
    /// «Стул»
    pub name: String,
    /// "chair"
    pub name_en: String,
    pub gender: Option<Gender>,
    pub traits: Vec<String>,
    /// Words in Russian and English by which people may ask for it.
    pub synonyms: Vec<String>,
    /// Width, depth and height of the usual one, cm.
    pub size: Option<[f64; 3]>,
    /// 0..=100, how likely it is moved; by its traits when absent.
    pub move_prob: Option<u8>,
}

/// Which list a word is looked up in.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Vocabulary {
    Area,
    Object,
    /// Parts of Objects: shelf, drawer.
    Part,
    Place,
    Map,
    Door,
}

#[derive(Debug, Clone, Default)]
struct List {
    meanings: Vec<Meaning>,
    by_name: HashMap<String, usize>,
    /// The parts of a phrase run together (`bed room` is `bedroom`) → meaning, and a size of its own.
    by_phrase: HashMap<String, (usize, Option<[f64; 3]>)>,
    longest: usize,
    /// Phrases of which every compound that ends in one is such a thing.
    heads: HashSet<String>,
}

/// The synonym table in force.
#[derive(Debug, Clone)]
pub struct Synonyms {
    lists: BTreeMap<Vocabulary, List>,
    codes: Vec<Code>,
    /// Words for how a thing looks.
    plain: HashSet<String>,
    /// Those of them that tell the value of a property, by its name in maps.
    looks: HashMap<String, &'static str>,
    /// The words of makers' models, in which such a word is no part of a name.
    models: HashSet<Vec<String>>,
}

/// A found meaning, with the size of this very model where the table has one.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Found<'a> {
    pub meaning: &'a Meaning,
    pub size: Option<[f64; 3]>,
    /// The word says nothing beyond the meaning: `Bedroom 2` is a bedroom, `Anna's bedroom` more than that.
    pub is_whole: bool,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct TableFile {
    #[serde(default)]
    area: Vec<Record>,
    #[serde(default)]
    object: Vec<Record>,
    #[serde(default)]
    part: Vec<Record>,
    #[serde(default)]
    place: Vec<Record>,
    #[serde(default)]
    map: Vec<Record>,
    #[serde(default)]
    door: Vec<Record>,
    #[serde(default)]
    model: Vec<Model>,
    #[serde(default)]
    code: Vec<Code>,
    #[serde(default)]
    plain: Vec<String>,
    #[serde(default)]
    colour: Vec<String>,
    #[serde(default)]
    material: Vec<String>,
}

#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Record {
    name: String,
    name_en: Option<String>,
    gender: Option<Gender>,
    traits: Option<Vec<String>>,
    #[serde(default)]
    synonyms: Vec<String>,
    /// Foreign words beyond the names and synonyms.
    #[serde(default)]
    words: Vec<String>,
    /// Those of its words of which every compound is such a thing.
    #[serde(default)]
    heads: Vec<String>,
    size: Option<[f64; 3]>,
    move_prob: Option<u8>,
}

/// One model of a maker: `OfficeChairBlack` is a chair of this size.
#[derive(Debug, Deserialize)]
#[serde(deny_unknown_fields)]
struct Model {
    word: String,
    /// The name of an object type.
    #[serde(rename = "is")]
    object: String,
    size: Option<[f64; 3]>,
}

/// A short word for a room that means this in the files of one format only.
#[derive(Debug, Clone, Deserialize)]
#[serde(deny_unknown_fields)]
struct Code {
    /// As the command line names it: `osmag`.
    format: String,
    word: String,
    /// The name of an area type.
    #[serde(rename = "is")]
    area: String,
}

impl Synonyms {
    /// The table built in.
    ///
    /// # Panics
    /// When the built-in text is broken, which a test excludes.
    #[must_use]
    pub fn built_in() -> Self {
        let mut table = Self {
            lists: BTreeMap::new(),
            codes: Vec::new(),
            plain: HashSet::new(),
            looks: HashMap::new(),
            models: HashSet::new(),
        };
        table
            .lay_over(&Source::new("rules/import-synonyms.toml", *SYNONYMS))
            .expect("the built-in table is sound");
        table
    }

    /// The built-in table with a user's file over it.
    ///
    /// # Errors
    /// The file cannot be read, or is no synonym table.
    pub fn load(path: &Path) -> Result<Self, ImportError> {
        let text = super::input::file_text(path)?;
        let mut table = Self::built_in();
        table.lay_over(&text)?;
        Ok(table)
    }

    fn lay_over(&mut self, text: &Source) -> Result<(), ImportError> {
        let fault = |message: Bilingual, at: Option<std::ops::Range<usize>>| {
            ImportError::Synonyms { message, text: text.clone(), at: at.map(Into::into) }
        };
        let file: TableFile = toml::from_str(text.text())
            .map_err(|e| fault(e.message().to_owned().into(), e.span()))?;
        for (vocabulary, records) in [
            (Vocabulary::Area, file.area),
            (Vocabulary::Object, file.object),
            (Vocabulary::Part, file.part),
            (Vocabulary::Place, file.place),
            (Vocabulary::Map, file.map),
            (Vocabulary::Door, file.door),
        ] {
            let list = self.lists.entry(vocabulary).or_default();
            for record in records {
                if record.name.trim().is_empty() {
                    return Err(fault(said!("empty-name"), None));
                }
                if !is_good_size(record.size) {
                    return Err(fault(said!("bad-size", record = record.name), None));
                }
                list.add(record);
            }
        }
        self.plain.extend(file.plain.iter().flat_map(|word| parts(word)));
        for (property, words) in [("ЦВЕТ", file.colour), ("МАТЕРИАЛ", file.material)] {
            for part in words.iter().flat_map(|word| parts(word)) {
                self.plain.insert(part.clone());
                self.looks.insert(part, property);
            }
        }
        let objects = self.lists.entry(Vocabulary::Object).or_default();
        for model in file.model {
            let Some(&meaning) = objects.by_name.get(&name_key(&model.object)) else {
                return Err(fault(
                    said!("there-is-no-type", word = model.word, object = model.object),
                    None,
                ));
            };
            if !is_good_size(model.size) {
                return Err(fault(said!("bad-size-word", word = model.word), None));
            }
            objects.add_phrase(&model.word, meaning, model.size);
            self.models.insert(parts(&model.word));
        }
        let areas = self.lists.entry(Vocabulary::Area).or_default();
        for code in file.code {
            if !areas.by_name.contains_key(&name_key(&code.area)) {
                return Err(fault(
                    said!("there-is-no-type-word", word = code.word, area = code.area),
                    None,
                ));
            }
            self.codes.push(code);
        }
        Ok(())
    }

    /// The table with the short words of one format.
    #[must_use]
    pub fn of_format(mut self, format: &str) -> Self {
        let areas = self.lists.entry(Vocabulary::Area).or_default();
        for code in self.codes.iter().filter(|code| code.format == format) {
            if let Some(&meaning) = areas.by_name.get(&name_key(&code.area)) {
                areas.add_phrase(&code.word, meaning, None);
            }
        }
        self
    }

    /// What a foreign word means.
    #[must_use]
    pub fn find(&self, vocabulary: Vocabulary, word: &str) -> Option<Found<'_>> {
        let list = self.lists.get(&vocabulary)?;
        let parts = parts(word);
        let letters: Vec<&str> = parts.iter().map(String::as_str).collect();
        if vocabulary == Vocabulary::Object {
            let thing = |letters: &[&str]| self.thing(list, letters);
            return thing(&letters).or_else(|| thing(&[family(list, word)?.as_str()]));
        }
        for length in (1..=letters.len().min(list.longest)).rev() {
            for run in letters.windows(length).rev() {
                if let Some(&(index, size)) = list.lookup(run) {
                    return Some(Found {
                        meaning: &list.meanings[index],
                        size: size.or(list.meanings[index].size),
                        is_whole: length == letters.len(),
                    });
                }
            }
        }
        None
    }

    /// What a thing's word tells of its colour and material beside its name, as properties of maps: an `OfficeChairBlack` is
    /// black, a whiteboard is not said to be white.
    #[must_use]
    pub fn looks(&self, word: &str) -> Vec<(&'static str, String)> {
        let parts = parts(word);
        let letters: Vec<&str> = parts.iter().map(String::as_str).collect();
        let Some(list) = self.lists.get(&Vocabulary::Object) else { return Vec::new() };
        let core = self.core(&letters);
        // The longest name wins: the board is white in "white board, black" by its name alone.
        let runs =
            (0..=core.start).flat_map(|from| (core.end..=letters.len()).map(move |to| from..to));
        let named = runs.filter(|run| list.lookup(&letters[run.clone()]).is_some());
        let Some(named) = named.max_by_key(Range::len) else { return Vec::new() };
        let is_model = self.models.contains(&parts[named.clone()]);
        let name = if is_model { core } else { named };
        let beside = letters[..name.start].iter().chain(&letters[name.end..]);
        let mut told: Vec<(&'static str, String)> =
            beside.filter_map(|part| Some((*self.looks.get(*part)?, (*part).to_owned()))).collect();
        let all = told.clone();
        told.retain(|(property, _)| all.iter().filter(|(other, _)| other == property).count() == 1);
        told
    }

    /// What is plain stands before the name or behind it; within it, it is part of the name.
    fn core(&self, letters: &[&str]) -> Range<usize> {
        let is_plain = |part: &&str| self.plain.contains(*part);
        let from = letters.iter().take_while(|p| is_plain(p)).count();
        from..letters.len() - letters[from..].iter().rev().take_while(|p| is_plain(p)).count()
    }

    /// What a thing's word means: as a whole, without words for its looks, or by the head of a compound.
    fn thing(&self, list: &List, letters: &[&str]) -> Option<Found<'_>> {
        let found = |run: &[&str], is_whole| {
            let &(index, size) = list.lookup(run)?;
            let meaning = &self.lists[&Vocabulary::Object].meanings[index];
            Some(Found { meaning, size: size.or(meaning.size), is_whole })
        };
        if let Some(found) = found(letters, true) {
            return Some(found);
        }
        let core = &letters[self.core(letters)];
        if let Some(found) = found(core, false) {
            return Some(found);
        }
        if core.iter().any(|part| BETWEEN.contains(part)) {
            return None;
        }
        let tails = (1..core.len()).map(|cut| &core[cut..]);
        tails.filter(|tail| list.is_head(tail)).find_map(|tail| found(tail, false))
    }
}

impl List {
    fn add(&mut self, record: Record) {
        let key = name_key(&record.name);
        let index = *self.by_name.entry(key).or_insert_with(|| {
            self.meanings.push(Meaning { name: record.name.clone(), ..Meaning::default() });
            self.meanings.len() - 1
        });
        let meaning = &mut self.meanings[index];
        if let Some(name_en) = record.name_en {
            meaning.name_en = name_en;
        }
        meaning.gender = record.gender.or(meaning.gender);
        if let Some(traits) = record.traits {
            meaning.traits = traits;
        }
        meaning.size = record.size.or(meaning.size);
        meaning.move_prob = record.move_prob.or(meaning.move_prob);
        for synonym in record.synonyms {
            if !meaning.synonyms.contains(&synonym) {
                meaning.synonyms.push(synonym);
            }
        }
        let own = [meaning.name.clone(), meaning.name_en.clone()];
        let words: Vec<String> =
            own.into_iter().chain(meaning.synonyms.clone()).chain(record.words).collect();
        for word in words {
            self.add_phrase(&word, index, None);
        }
        for word in record.heads {
            self.add_phrase(&word, index, None);
            self.heads.insert(parts(&word).concat());
        }
    }

    /// In the singular: a *table w chairs* is no chair.
    fn is_head(&self, run: &[&str]) -> bool {
        self.heads.contains(&run.concat())
    }

    fn add_phrase(&mut self, word: &str, meaning: usize, size: Option<[f64; 3]>) {
        let parts = parts(word);
        if !parts.is_empty() {
            self.longest = self.longest.max(parts.len());
            self.by_phrase.insert(parts.concat(), (meaning, size));
        }
    }

    fn lookup(&self, run: &[&str]) -> Option<&(usize, Option<[f64; 3]>)> {
        forms(run).iter().find_map(|form| self.by_phrase.get(form))
    }
}

/// Words that join two nouns, of which the last is then no head: a *desk with lamp* is no lamp.
const BETWEEN: [&str; 18] = [
    "with", "w", "without", "for", "of", "on", "in", "under", "and", "or", "to", "from", "с", "со",
    "без", "для", "на", "и",
];

/// The head before the hyphen where makers of building models name a family by it: `Chair-Breuer`.
fn family(list: &List, word: &str) -> Option<String> {
    let (head, rest) = word.split_once('-')?;
    let head = parts(head).concat();
    let is_name = rest.chars().next().is_some_and(char::is_uppercase);
    (is_name && list.heads.contains(&head)).then_some(head)
}

/// A phrase run together, and without the ending of an English plural: chairs, boxes.
fn forms(run: &[&str]) -> Vec<String> {
    let phrase = run.concat();
    let singular = ["s", "es"].map(|ending| phrase.strip_suffix(ending).map(str::to_owned));
    let mut forms = vec![phrase];
    forms.extend(singular.into_iter().flatten());
    forms
}

fn is_good_size(size: Option<[f64; 3]>) -> bool {
    size.is_none_or(|size| {
        size[0] > 0.0
            && size[1] > 0.0
            && size[2] >= 0.0
            && size.iter().all(|&cm| Cm::new(cm).is_ok() && cm <= 10_000.0)
    })
}

/// The parts of a compound word, lower case, without numbers: `OfficeChair_2` → office, chair.
pub(super) fn parts(word: &str) -> Vec<String> {
    let mut parts = Vec::new();
    let mut part = String::new();
    let letters: Vec<char> = word.chars().collect();
    for (i, &c) in letters.iter().enumerate() {
        let before = i.checked_sub(1).map(|j| letters[j]);
        let after = letters.get(i + 1).copied();
        // OfficeChair, TVStand: a capital after a small letter, or before one.
        let is_start = c.is_uppercase()
            && (before.is_some_and(char::is_lowercase)
                || (before.is_some_and(char::is_uppercase)
                    && after.is_some_and(char::is_lowercase)));
        if !c.is_alphabetic() && c != '\'' || is_start {
            parts.push(std::mem::take(&mut part));
        }
        if c.is_alphabetic() {
            part.push(c);
        }
    }
    parts.push(part);
    parts.into_iter().filter(|p| !p.is_empty()).map(|p| name_key(&p)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_come_apart_where_people_join_them() {
        assert_eq!(parts("OfficeChairBlack"), ["office", "chair", "black"]);
        assert_eq!(parts("TVStand_206_1"), ["tv", "stand"]);
        assert_eq!(parts("consult-rm 13"), ["consult", "rm"]);
        assert!(parts("12-3").is_empty());
    }

    #[test]
    fn a_colour_beside_a_name_is_told_and_one_within_it_is_not() {
        let table = Synonyms::built_in();
        let told = |word: &str| -> Vec<String> {
            table
                .looks(word)
                .into_iter()
                .map(|(property, value)| format!("{property}={value}"))
                .collect()
        };
        assert_eq!(told("OfficeChairBlack"), ["ЦВЕТ=black"]);
        assert_eq!(told("MetalCabinetYellow"), ["МАТЕРИАЛ=metal", "ЦВЕТ=yellow"]);
        assert_eq!(told("White sofa 3"), ["ЦВЕТ=white"]);
        for word in [
            "White board",
            "Whiteboard",
            "Red Room chair",
            "BlackWhiteChair",
            "Black",
            "Blorb black",
        ] {
            assert!(told(word).is_empty(), "{word} {:?}", told(word));
        }
    }
}
