//! What serves for an activity, by the part of it that is asked for: for whoever reads sentences in another way.

use super::lexicon::{KindId, Lexicon};
use super::purposes::{self, Role};
use super::uses;
use crate::words::things::things;

/// Words that say what is done.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Doing {
    /// How many words say it.
    pub words: usize,
    /// Whether what it is done to may follow: «порезать хлеб».
    pub takes_object: bool,
    activity: u16,
}

/// Which part in an activity is asked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Part {
    /// «чем», "with"
    With,
    /// «из чего», "from"
    From,
    /// «где», "where"
    At,
    /// "how", "use for"
    By,
    /// «что», "what"
    To,
    /// «что-нибудь», "something to …"
    Any,
}

impl Part {
    /// The roles that will do, the likeliest first.
    fn roles(self) -> &'static [Role] {
        use Role::{Instrument, Location, Patient, Source, Theme};
        match self {
            Self::With => &[Instrument, Location, Source, Patient],
            Self::From => &[Source, Instrument, Location],
            Self::At => &[Location, Instrument, Source, Patient, Theme],
            Self::By => &[Instrument, Location, Source],
            Self::To => &[Patient, Theme],
            Self::Any => &[Patient, Theme, Instrument, Location, Source],
        }
    }
}

impl Doing {
    /// What words, in [`name_key`](crate::units::name_key) form, begin with.
    #[must_use]
    pub fn of(words: &[String]) -> Option<Self> {
        let (taken, activity) = uses::longest(words)?;
        Some(Self { words: taken, takes_object: uses::takes_object(activity), activity })
    }

    /// Whether a word may stand before what an activity is done to, and says nothing.
    #[must_use]
    pub fn passes(word: &str) -> bool {
        things().between.iter().any(|own| own == word)
    }
}

impl Lexicon {
    /// The kinds of a map that serve for an activity, the sort's own first; none where the part is none of it.
    #[must_use]
    pub fn serving(&self, doing: Doing, part: Part) -> Option<Vec<KindId>> {
        let sorts: Vec<u16> = uses::sorts(doing.activity).collect();
        let of_role = |role: &Role| sorts.iter().find(|sort| purposes::role(**sort) == *role);
        part.roles().iter().find_map(of_role).map(|sort| self.kinds_of_sort(*sort))
    }
}
