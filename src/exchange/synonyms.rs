//! Foreign words for rooms, things and places, and what they are called here: `rules/import-synonyms.toml`.
//!
//! A word is looked up by its parts: `OfficeChair_Black-3` is *office chair black 3*, and the longest run of parts
//! that the table knows wins, the last of equally long ones (*office chair* before *chair*, the head of an English
//! compound stands last). Letters are compared without case, numbers are left aside.
//!
//! **Invariant.** Names of one list are distinct; a user's table is laid over the built-in one: entries of the same
//! name are replaced field by field, words of both stay, and of one word the later meaning holds.

use std::collections::{BTreeMap, HashMap};
use std::path::Path;

use serde::Deserialize;

use crate::map::Gender;
use crate::units::{Cm, Source, name_key};

use super::ImportError;

const BUILT_IN: &str = include_str!("../../rules/import-synonyms.toml");

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
}

/// The synonym table in force.
#[derive(Debug, Clone)]
pub struct Synonyms {
    lists: BTreeMap<Vocabulary, List>,
    codes: Vec<Code>,
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
    /// When the built-in text is broken, which a test of this file excludes.
    #[must_use]
    pub fn built_in() -> Self {
        let mut table = Self { lists: BTreeMap::new(), codes: Vec::new() };
        table
            .lay_over(&Source::new("rules/import-synonyms.toml", BUILT_IN))
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
        let fault = |message: String, at: Option<std::ops::Range<usize>>| ImportError::Synonyms {
            message,
            text: text.clone(),
            at: at.map(Into::into),
        };
        let file: TableFile =
            toml::from_str(text.text()).map_err(|e| fault(e.message().to_owned(), e.span()))?;
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
                    return Err(fault("пустое имя (name)".to_owned(), None));
                }
                if !is_good_size(record.size) {
                    return Err(fault(format!("«{}»: негодные размеры (size)", record.name), None));
                }
                list.add(record);
            }
        }
        let objects = self.lists.entry(Vocabulary::Object).or_default();
        for model in file.model {
            let Some(&meaning) = objects.by_name.get(&name_key(&model.object)) else {
                return Err(fault(format!("«{}»: нет типа «{}»", model.word, model.object), None));
            };
            if !is_good_size(model.size) {
                return Err(fault(format!("«{}»: негодные размеры (size)", model.word), None));
            }
            objects.add_phrase(&model.word, meaning, model.size);
        }
        let areas = self.lists.entry(Vocabulary::Area).or_default();
        for code in file.code {
            if !areas.by_name.contains_key(&name_key(&code.area)) {
                return Err(fault(format!("«{}»: нет типа «{}»", code.word, code.area), None));
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

    /// The first of several words that means something.
    #[must_use]
    pub fn find_any<'w>(
        &self,
        vocabulary: Vocabulary,
        words: impl IntoIterator<Item = &'w str>,
    ) -> Option<Found<'_>> {
        words.into_iter().find_map(|word| self.find(vocabulary, word))
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
    }

    fn add_phrase(&mut self, word: &str, meaning: usize, size: Option<[f64; 3]>) {
        let parts = parts(word);
        if !parts.is_empty() {
            self.longest = self.longest.max(parts.len());
            self.by_phrase.insert(parts.concat(), (meaning, size));
        }
    }

    fn lookup(&self, run: &[&str]) -> Option<&(usize, Option<[f64; 3]>)> {
        let phrase = run.concat();
        // English plurals: chairs, boxes.
        let singular = || phrase.strip_suffix('s').and_then(|one| self.by_phrase.get(one));
        let of_es = || phrase.strip_suffix("es").and_then(|one| self.by_phrase.get(one));
        self.by_phrase.get(&phrase).or_else(singular).or_else(of_es)
    }
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
    fn the_longest_and_last_meaning_wins() {
        let table = Synonyms::built_in();
        let name = |word| table.find(Vocabulary::Object, word).map(|f| f.meaning.name.clone());
        assert_eq!(name("Dining_Table_3").as_deref(), Some("Обеденный стол"));
        assert_eq!(name("chairs").as_deref(), Some("Стул"));
        assert_eq!(name("стул").as_deref(), Some("Стул"));
        assert_eq!(name("flux capacitor"), None);
        let room = table.find(Vocabulary::Area, "Bedroom 2").expect("a bedroom");
        assert!(room.is_whole);
        assert!(!table.find(Vocabulary::Area, "Anna bedroom").expect("a bedroom").is_whole);
    }

    #[test]
    fn codes_hold_in_their_own_format_only() {
        let table = Synonyms::built_in();
        assert!(table.find(Vocabulary::Area, "E1-F2-MR").is_none());
        let table = table.of_format("osmag");
        let found = table.find(Vocabulary::Area, "E1-F2-MR").expect("a code");
        assert_eq!((found.meaning.name.as_str(), found.is_whole), ("Мужской туалет", false));
    }

    #[test]
    fn a_user_s_table_lies_over_the_built_in_one() {
        let mut table = Synonyms::built_in();
        let text = r#"
            [[object]]
            name = "Стул"
            words = ["sitzding"]
            [[object]]
            name = "Каталка"
            name_en = "gurney"
            size = [60, 200, 90]
            [[model]]
            word = "AcmeGurney"
            is = "Каталка"
            size = [70, 190, 80]
        "#;
        table.lay_over(&Source::new("my.toml", text)).expect("sound");
        let find = |word| table.find(Vocabulary::Object, word).expect("known");
        assert_eq!(find("SitzDing").meaning.name, find("chair").meaning.name);
        assert!(find("chair").meaning.traits.contains(&"seat".to_owned()));
        assert_eq!(find("gurney").size, Some([60.0, 200.0, 90.0]));
        assert_eq!(find("AcmeGurney").size, Some([70.0, 190.0, 80.0]));

        for (spoilt, wants) in [
            ("[[object]]\nnam = \"Стул\"", "unknown field"),
            ("[[object]]\nname = \"Стул\"\nsize = [1, -2, 3]", "размеры"),
            ("[[model]]\nword = \"x\"\nis = \"Нечто\"", "нет типа"),
            ("[[code]]\nformat = \"osmag\"\nword = \"x\"\nis = \"Нечто\"", "нет типа"),
        ] {
            let error = table.clone().lay_over(&Source::new("my.toml", spoilt)).expect_err(spoilt);
            assert!(error.to_string().contains(wants), "{error}");
        }
    }
}
