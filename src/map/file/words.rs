//! Words of the map file that stand for values of the model.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use super::decode::word;
use crate::fault::MapError;
use crate::{DoorKind, DoorStatus, HingeSide, OpensTo, Permeability, Profile};

/// Words that stand for a value of the model, English first, Russian as well.
macro_rules! words {
    ($( $(#[$doc:meta])* $name:ident = $model:ident { $( $variant:ident: $word:literal | $russian:literal ),+ } )+) => {$(
        $(#[$doc])*
        #[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
        pub enum $name { $( #[serde(rename = $word, alias = $russian)] $variant ),+ }

        impl From<$name> for $model {
            fn from(word: $name) -> Self {
                match word { $( $name::$variant => Self::$variant ),+ }
            }
        }

        impl From<$model> for $name {
            fn from(value: $model) -> Self {
                match value { $( $model::$variant => Self::$variant ),+ }
            }
        }

        impl std::str::FromStr for $name {
            type Err = Box<MapError>;

            fn from_str(text: &str) -> Result<Self, Box<MapError>> {
                word(text)
            }
        }
    )+};
}

/// What the robot is to do in a zone.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
pub enum ZoneWord {
    #[serde(rename = "keep-out", alias = "запретная")]
    KeepOut,
    #[serde(rename = "closed", alias = "закрыта")]
    Closed,
    #[serde(rename = "slow", alias = "медленная")]
    Slow,
    #[serde(rename = "one-way", alias = "односторонняя")]
    OneWay,
}

impl std::str::FromStr for ZoneWord {
    type Err = Box<MapError>;

    fn from_str(text: &str) -> Result<Self, Box<MapError>> {
        word(text)
    }
}

words! {
    /// Whether a face lets things through.
    PermeabilityFile = Permeability {
        Impermeable: "impermeable" | "непроницаемая",
        Permeable: "permeable" | "проницаемая",
        Conditional: "conditional" | "условная"
    }
    /// How the leaves of a door move.
    DoorKindFile = DoorKind {
        Hinged: "hinged" | "распашная",
        Sliding: "sliding" | "раздвижная",
        Passage: "passage" | "проход"
    }
    /// How a door stands.
    StatusFile = DoorStatus {
        Open: "open" | "открыта",
        Closed: "closed" | "закрыта",
        Locked: "locked" | "заперта"
    }
    /// Surveyed by people, or detected: boxes that are off by some centimetres.
    ProfileFile = Profile { Surveyed: "surveyed" | "обмерено", Detected: "detected" | "увидено" }
    /// Where the hinges are.
    HingeFile = HingeSide { Right: "right" | "справа", Left: "left" | "слева" }
    /// Whether leaves swing into the Area.
    OpensFile = OpensTo { Inside: "inside" | "внутрь", Outside: "outside" | "наружу" }
}

macro_rules! defaults {
    ($($name:ident::$variant:ident),+) => {$(
        impl Default for $name { fn default() -> Self { Self::$variant } }
    )+};
}
defaults!(
    PermeabilityFile::Impermeable,
    StatusFile::Open,
    OpensFile::Inside,
    ProfileFile::Surveyed
);
