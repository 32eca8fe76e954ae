//! Logical forms: what a sentence means, before anything is looked up.
//!
//! A [`Desc`] is a conjunctive query in the shape of a tree; a [`Form`] says what is wanted of it. Both are typed: what
//! may be said of a thing is decided by its [`Sorts`] when a phrase is built, so that no chair leads "to the kitchen".

use std::ops::{BitAnd, BitOr};

use crate::language::question::{KindId, Property, ValueId};
use crate::map::Entity;

/// Sorts of what a map has, as a set: each bit is one.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Sorts(u8);

impl Sorts {
    pub const NONE: Self = Self(0);
    pub const THING: Self = Self(1);
    pub const AREA: Self = Self(2);
    pub const OPENING: Self = Self(4);
    pub const POINT: Self = Self(8);
    pub const STOREY: Self = Self(16);
    pub const ANY: Self = Self(31);

    /// Each of them by itself.
    pub(crate) fn each(self) -> impl Iterator<Item = Self> {
        let all = [Self::THING, Self::AREA, Self::OPENING, Self::POINT, Self::STOREY];
        all.into_iter().filter(move |one| self.meets(*one))
    }

    /// By the name that the grammar files give it.
    pub(crate) fn named(name: &str) -> Option<Self> {
        Some(match name {
            "Thing" => Self::THING,
            "Area" => Self::AREA,
            "Opening" => Self::OPENING,
            "Point" => Self::POINT,
            "Storey" => Self::STOREY,
            "Any" => Self::ANY,
            _ => return None,
        })
    }

    #[must_use]
    pub fn is_empty(self) -> bool {
        self.0 == 0
    }

    pub(crate) const fn or(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }

    #[must_use]
    pub fn meets(self, other: Self) -> bool {
        self.0 & other.0 != 0
    }
}

impl BitOr for Sorts {
    type Output = Self;
    fn bitor(self, other: Self) -> Self {
        Self(self.0 | other.0)
    }
}

impl BitAnd for Sorts {
    type Output = Self;
    fn bitand(self, other: Self) -> Self {
        Self(self.0 & other.0)
    }
}

/// A relation of the grammar files, by its place among the names of roles.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct RoleId(pub(crate) u16);

/// What a description begins with.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Head {
    /// One of these, by name.
    Entities(Vec<Entity>),
    /// Of one of these kinds.
    Kinds(Vec<KindId>),
    /// Anything of these sorts.
    Any,
}

/// Whether one is meant, or some, or all.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Quant {
    /// As the number of the noun says: one in the singular.
    Bare,
    Some,
    All,
    None,
    Exactly(u64),
}

/// A description of things: «белая чашка на столе».
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Desc {
    pub head: Head,
    pub sorts: Sorts,
    pub quant: Quant,
    pub plural: bool,
    pub mods: Vec<Mod>,
}

/// What is said of a thing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Mod {
    Value(ValueId),
    /// Stands in a role to each of none, one or more others.
    Role {
        role: RoleId,
        to: Vec<Desc>,
    },
    /// As many of the others stand in the role to it: the inverse.
    Having {
        role: RoleId,
        what: Desc,
    },
    Not(Box<Self>),
    /// One of these at least.
    Either(Vec<Vec<Self>>),
    Except(Desc),
    /// Foremost by a measure, or so many places after that.
    Best(Measure, Option<Desc>, u64),
    /// The most of the others stand in the role to it, or the fewest.
    MostOf {
        role: RoleId,
        what: Desc,
        most: bool,
    },
    /// More of a measure than so much, or less: tenths of a millimetre; cm² of an Area's size.
    Beyond(Measure, u64),
    /// More of a measure than another has, or less.
    Exceeds(Measure, Desc),
    /// Not farther from another than so many tenths of a millimetre.
    Within(u64, Desc),
    /// With the same value of a property as another thing.
    Same(Property, Desc),
}

impl Mod {
    /// Whether it tells foremost ones of what all else leaves.
    pub(crate) fn is_superlative(&self) -> bool {
        matches!(self, Self::Best(..) | Self::MostOf { .. })
    }
}

/// By what things are compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub struct Measure {
    pub of: Dimension,
    /// The most of it, or the least.
    pub most: bool,
}

/// What is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Dimension {
    Height,
    /// To another thing.
    Distance,
    /// The volume of a thing, the floor of an Area, the width of an opening.
    Size,
    /// The least of the three sizes.
    Thickness,
    /// The longer side in the plan.
    Length,
    /// From left to right.
    Width,
    /// How high it begins; of what begins equally high, its height.
    Level,
}

impl Dimension {
    pub(crate) const NAMES: [(&'static str, Self); 7] = [
        ("height", Self::Height),
        ("distance", Self::Distance),
        ("size", Self::Size),
        ("thickness", Self::Thickness),
        ("length", Self::Length),
        ("width", Self::Width),
        ("level", Self::Level),
    ];

    pub(crate) fn named(name: &str) -> Option<Self> {
        Self::NAMES.iter().find(|(own, _)| *own == name).map(|(_, of)| *of)
    }

    /// Of what it is a measure.
    pub(crate) fn sorts(self) -> Sorts {
        match self {
            Self::Height | Self::Distance | Self::Thickness | Self::Level => Sorts::THING,
            Self::Size => Sorts::THING | Sorts::AREA,
            Self::Length | Self::Width => Sorts::THING | Sorts::OPENING,
        }
    }
}

/// What a sentence asks.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Form {
    List(Desc),
    Count(Desc),
    /// Whether there is one.
    Some(Desc),
    /// Whether there is none.
    None(Desc),
    Whether(Desc, Vec<Mod>),
    Choice(Desc, Vec<Vec<Mod>>),
    Place(Desc),
    /// In which room.
    Room(Desc),
    /// To what it stands in a role.
    By(Desc, RoleId),
    Value(Desc, Property),
    /// Which rooms an opening joins.
    Joins(Desc),
    /// How far one is from the other.
    Distance(Desc, Desc),
    /// Whether the first has more of it than the second.
    Compare(Desc, Desc, Measure),
    /// Whether the first is nearer to the second than to the third.
    Nearer(Desc, Desc, Desc),
    /// Which of these is foremost.
    Which(Vec<Desc>, Mod),
    /// Whether the first is one of the second.
    Is(Desc, Desc),
    /// How much of a measure it has.
    Size(Desc, Dimension),
    /// Whether there are so many; at least so many, and not more than so many.
    Number(Desc, u64, u64),
    /// Whether there are more of the first than of the second.
    More(Desc, Desc),
    /// By how many there are more of the first.
    Extra(Desc, Desc),
    /// Whether both are so.
    Both(Box<Self>, Box<Self>),
    /// Whether one of them is so.
    OneOf(Box<Self>, Box<Self>),
}

impl Form {
    /// A stable word for programs.
    #[must_use]
    pub fn word(&self) -> &'static str {
        match self {
            Self::List(_) => "list",
            Self::Count(_) => "count",
            Self::Some(_) | Self::None(_) | Self::Whether(..) | Self::Choice(..) => "whether",
            Self::Is(..) | Self::Number(..) | Self::Both(..) | Self::OneOf(..) => "whether",
            Self::Place(_) | Self::Room(_) | Self::By(..) => "place",
            Self::Joins(_) => "joins",
            Self::Value(..) | Self::Distance(..) | Self::Size(..) => "value",
            Self::Compare(..) | Self::Nearer(..) | Self::Which(..) => "compare",
            Self::More(..) | Self::Extra(..) => "compare",
        }
    }
}

impl Desc {
    /// Anything of these sorts.
    #[must_use]
    pub fn any(sorts: Sorts) -> Self {
        Self { head: Head::Any, sorts, quant: Quant::Bare, plural: true, mods: Vec::new() }
    }

    /// Whether exactly one thing is meant.
    #[must_use]
    pub fn is_definite(&self) -> bool {
        self.quant == Quant::Bare && !self.plural && self.head != Head::Any
    }
}
