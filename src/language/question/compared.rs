//! What questions compare by: superlatives and comparatives, sizes against a number, numbers of things.
//!
//! Invariant: whatever is compared, more of the measure wins, unless [`Extreme::is_less`] says otherwise.

use crate::sets::{named, of_kind};

/// What a superlative compares.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Extreme {
    Nearest,
    Farthest,
    Biggest,
    Smallest,
    Tallest,
    Lowest,
    Widest,
    Narrowest,
    Longest,
    Shortest,
    /// By how high above the floor it begins, as "higher" and «выше всех висит» mean; of things that begin equally
    /// high, by their height.
    Topmost,
    Bottommost,
    /// By how high they begin, neither the highest nor the lowest: of an odd number the one in the middle.
    Midmost,
    /// By the least of width, depth and height.
    Thickest,
    Thinnest,
    /// By the weight that the map gives.
    Heaviest,
    Lightest,
    LeftMost,
    RightMost,
    /// Having the most of something; the anchor of the superlative tells of what.
    Most,
    Fewest,
}

impl Extreme {
    /// Whether less of the measure wins.
    #[must_use]
    pub fn is_less(self) -> bool {
        matches!(
            self,
            Self::Nearest
                | Self::Smallest
                | Self::Lowest
                | Self::Narrowest
                | Self::Shortest
                | Self::Bottommost
                | Self::Midmost
                | Self::Thinnest
                | Self::Lightest
        )
    }

    /// Whether it tells one of several levels, one above the other.
    #[must_use]
    pub fn is_level(self) -> bool {
        matches!(self, Self::Topmost | Self::Midmost | Self::Bottommost)
    }

    /// What is compared where two things begin equally high.
    #[must_use]
    pub fn of_size(self) -> Self {
        match self {
            Self::Topmost => Self::Tallest,
            Self::Bottommost => Self::Lowest,
            other => other,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Closeness {
    Nearer,
    Farther,
}

/// What a question for a size is after.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Dimension {
    All,
    Height,
    Width,
    Length,
    Area,
    /// How high it begins.
    Elevation,
    /// Width, depth and height, of rooms too.
    Sides,
}

/// How a number is meant: «не меньше трёх», "more than three".
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, PartialOrd, Ord, Hash)]
pub enum Quantity {
    #[default]
    Exactly,
    AtLeast,
    AtMost,
    MoreThan,
    FewerThan,
}

impl Quantity {
    /// Whether so many are as many as `asked` means.
    #[must_use]
    pub fn admits(self, number: u64, asked: u64) -> bool {
        match self {
            Self::Exactly => number == asked,
            Self::AtLeast => number >= asked,
            Self::AtMost => number <= asked,
            Self::MoreThan => number > asked,
            Self::FewerThan => number < asked,
        }
    }
}

named!(Quantity: Exactly AtLeast AtMost MoreThan FewerThan);

/// How the number after these words is meant, with the number of words that say so.
pub(super) fn quantity(words: &[String]) -> Option<(usize, Quantity)> {
    (1..=words.len().min(3)).rev().find_map(|n| {
        let said = words[..n].join(" ");
        let (name, _) = of_kind("Quantity.").find(|(_, phrase)| *phrase == said)?;
        Quantity::named(name).map(|quantity| (n, quantity))
    })
}

/// «выше двух метров», "larger than 20 m²": what a superlative would compare, against a number.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Sized {
    pub extreme: Extreme,
    /// cm; of areas cm²
    pub than: u64,
    pub negated: bool,
}

impl Sized {
    /// Whether a measure is beyond the number, or not where that is denied.
    #[must_use]
    pub fn admits(self, measure: f64) -> bool {
        let less = self.extreme.is_less();
        let than = self.than as f64;
        (if less { measure < than } else { measure > than }) != self.negated
    }
}
