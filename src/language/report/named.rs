//! Names and doorways as a report and a way in words tell them: the values, without sentences.

use crate::sets::set;
use crate::words::{Case, Language, NounPhrase, PlaceSense, WordHints, english, russian};

/// A name of the map in both languages.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Named {
    /// Boxed, since a doorway holds three names and a report several doorways.
    pub(super) russian: Box<NounPhrase>,
    pub(super) english: String,
    /// A person's name, which has no article.
    is_proper: bool,
}

impl Named {
    /// A name with what the map knows of it. Without an English name one is made where every word is known, and else
    /// the Russian one is kept.
    #[must_use]
    pub fn new(name: &str, hints: &WordHints, english_name: Option<&str>) -> Self {
        let english = english_name
            .map(Into::into)
            .or_else(|| english::name_of(name))
            .unwrap_or_else(|| name.to_owned());
        Self { russian: Box::new(NounPhrase::parse(name, hints)), english, is_proper: false }
    }

    /// The same, called by name as a person is.
    #[must_use]
    pub fn proper(self) -> Self {
        Self { is_proper: true, ..self }
    }

    /// A name of which nothing more is known.
    #[must_use]
    pub fn plain(name: &str) -> Self {
        Self::new(name, &WordHints::default(), None)
    }

    #[must_use]
    pub fn phrase(&self) -> &NounPhrase {
        &self.russian
    }

    /// The English name as it is.
    #[must_use]
    pub fn english_name(&self) -> &str {
        &self.english
    }

    /// The English name within a sentence, with its article.
    #[must_use]
    pub fn english(&self) -> String {
        match self.is_proper {
            true => self.english.clone(),
            false => english::with_article(&self.english),
        }
    }

    /// The English name of a door or passage: "the gate", "Door 2", but "the door L1_office" where its name does not
    /// say what it is.
    #[must_use]
    pub fn english_door(&self, opening: OpeningKind) -> String {
        const OPENINGS: [&str; 10] = [
            "door", "doors", "gate", "gates", "passage", "doorway", "opening", "hatch", "arch",
            "entrance",
        ];
        let lower = self.english.to_lowercase();
        let mut words = lower.split(|c: char| !c.is_alphabetic());
        match words.any(|word| OPENINGS.contains(&word)) {
            true => self.english(),
            false => format!("{} {}", opening.english(), self.english),
        }
    }

    /// The way to a storey: «на Второй этаж», «на этаж «L2»»; "to the second floor", "to the floor “L2”".
    #[must_use]
    pub fn whither_storey(&self, language: Language) -> String {
        let lower = self.english.to_lowercase();
        let is_storey = set!("StoreyNoun").iter().any(|word| lower.contains(word));
        match language {
            Language::Russian if self.russian.place() == PlaceSense::Upon => {
                russian::whither(&self.russian)
            }
            Language::Russian => format!("на этаж «{}»", self.russian.name()),
            Language::English if is_storey => format!("to {}", self.english()),
            Language::English => format!("to the floor “{}”", self.english),
        }
    }

    /// The way into a room, in Russian: «в Комнату-Z», «на Кухню».
    #[must_use]
    pub fn whither(&self) -> String {
        russian::whither(&self.russian)
    }

    /// The name within a sentence: in a case, or with its article.
    #[must_use]
    pub fn form(&self, case: Case, language: Language) -> String {
        match language {
            Language::Russian => self.russian.case(case),
            Language::English => self.english(),
        }
    }
}

/// What leads from one Area to another.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OpeningKind {
    Door,
    /// An opening without a leaf.
    Passage,
}

impl OpeningKind {
    #[must_use]
    pub(crate) fn english(self) -> &'static str {
        match self {
            Self::Door => "the door",
            Self::Passage => "the passage",
        }
    }
}

/// A door or passage, told by the Areas on its two sides.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ToldOpening {
    pub opening: OpeningKind,
    /// Its own name, where the two Areas do not tell it from another.
    pub name: Option<Named>,
    pub from: Named,
    /// None for a door that leads out of the map.
    pub to: Option<Named>,
}

impl ToldOpening {
    /// The only door from one Area to another.
    #[must_use]
    pub fn door(from: Named, to: Named) -> Self {
        Self { opening: OpeningKind::Door, name: None, from, to: Some(to) }
    }

    /// The only passage from one Area to another.
    #[must_use]
    pub fn passage(from: Named, to: Named) -> Self {
        Self { opening: OpeningKind::Passage, ..Self::door(from, to) }
    }
}
