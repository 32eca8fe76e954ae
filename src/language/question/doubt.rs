//! Why a question has no answer.

use super::departed::Departed;
use super::query::{Noun, Thing};
use crate::sets::set;
use crate::words::{Language, word_keys};

/// Why a question has no answer.
#[derive(Debug, Clone, PartialEq, Eq)]
#[non_exhaustive]
pub enum Doubt {
    /// Nothing but blanks, marks or pictures.
    Empty,
    TooLong {
        length: usize,
    },
    /// Words that no question has.
    NotUnderstood {
        words: String,
    },
    /// Understood what about, but not what is asked.
    Incomplete {
        about: String,
    },
    /// A description that several things fit where one is meant.
    Ambiguous {
        reference: String,
        candidates: Vec<Thing>,
    },
    /// Whether something goes into what was spoken of, or onto it.
    InOrOn {
        place: Thing,
    },
    /// Something is asked of what is in a point, as if that were a room.
    PointNoRoom {
        point: Thing,
        room: Thing,
    },
    /// The person has told where it is, in words that come to no place.
    Astray {
        told: String,
    },
    /// What was told beside a question bears upon its answer, and how is not known.
    Unheeded {
        told: String,
    },
    /// Nothing on the map is called so.
    Unknown {
        reference: String,
        near: Vec<String>,
    },
    /// Nothing on the map fits the description, though the map has its words.
    NoneSuch {
        noun: Box<Noun>,
    },
    /// Fewer things fit than are wanted.
    TooFew {
        found: Vec<Thing>,
    },
    /// More things than are looked at one by one.
    TooMany {
        many: usize,
        most: usize,
    },
    /// A pronoun that means nothing yet.
    NoReferent {
        word: String,
    },
    /// What a pronoun would mean left the map since it was spoken of.
    Departed {
        things: Vec<Departed>,
    },
    /// What was before these things were moved, of which only their own places are known.
    Past {
        moved: Vec<Thing>,
    },
    /// «наверху», "downstairs", where there is no such storey.
    NoStorey {
        above: bool,
    },
    /// Windows are neither opened nor shut.
    Windows,
}

impl Doubt {
    pub(super) fn not_understood(words: &str) -> Self {
        let words: String = words.chars().take(80).collect();
        Self::NotUnderstood { words }
    }

    pub(super) fn unheeded(told: &str) -> Self {
        let told = told.trim_matches(|c: char| !c.is_alphanumeric());
        Self::Unheeded { told: told.to_owned() }
    }

    /// Whether a line goes on from the question before and names one thing that the map lacks: «А полотенце?»
    pub(super) fn is_only_named(&self, text: &str) -> bool {
        let Self::Unknown { reference, .. } = self else { return false };
        let named = |key: &String| !set!("Article").contains(&key.as_str());
        let keys = word_keys(text);
        let goes_on = keys.iter().take_while(|key| set!("GoesOn").contains(&key.as_str())).count();
        let rest: Vec<&String> = keys[goes_on..].iter().filter(|key| named(key)).collect();
        let unknown = word_keys(reference);
        goes_on > 0 && rest == unknown.iter().filter(|key| named(key)).collect::<Vec<_>>()
    }

    /// The doubt in the words of who asked: a sentence is put plainly before it is read, and what was put in is not theirs.
    pub(super) fn quoted_from(self, text: &str) -> Self {
        match self {
            Self::NotUnderstood { words } if !says(text, &words) => Self::not_understood(text),
            other => other,
        }
    }

    /// Whether it is not known what was asked.
    pub(super) fn is_unread(&self) -> bool {
        matches!(self, Self::Unknown { .. } | Self::NotUnderstood { .. } | Self::Incomplete { .. })
    }

    /// A stable word for the outcome: the three of SPEC T2, and what was not said.
    #[must_use]
    pub fn kind(&self) -> &'static str {
        match self {
            Self::Empty
            | Self::TooLong { .. }
            | Self::NotUnderstood { .. }
            | Self::Astray { .. }
            | Self::Unheeded { .. }
            | Self::Windows => "not_understood",
            Self::Incomplete { .. } | Self::NoReferent { .. } => "incomplete",
            Self::Ambiguous { .. } | Self::InOrOn { .. } => "ambiguous",
            Self::Unknown { .. }
            | Self::NoneSuch { .. }
            | Self::TooFew { .. }
            | Self::TooMany { .. }
            | Self::Departed { .. }
            | Self::PointNoRoom { .. }
            | Self::Past { .. }
            | Self::NoStorey { .. } => "unknown",
        }
    }
}

/// Whether a text has some words as they stand, one after another.
fn says(text: &str, words: &str) -> bool {
    let (said, quoted) = (word_keys(text), word_keys(words));
    quoted.is_empty() || said.windows(quoted.len()).any(|run| *run == *quoted)
}

/// A doubt with its words.
#[derive(Debug, Clone)]
pub struct Unanswered {
    pub doubt: Doubt,
    pub language: Language,
    pub text: String,
    /// Names of the candidates, or of what is like the name that is not on the map.
    pub names: Box<[String]>,
    /// Questions that come near to what was not understood, and have an answer.
    pub offers: Box<[String]>,
}
