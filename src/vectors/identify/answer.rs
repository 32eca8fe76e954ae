//! What identification answers, and what the answer cost (SPEC V20, V21).

use nalgebra::SMatrix;

use crate::Motion;

/// A thing of a library.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ThingId(pub u32);

/// A view as a part of a stored thing.
#[derive(Debug, Clone, PartialEq)]
pub struct Placement<const D: usize> {
    pub thing: ThingId,
    /// From the view's frame to the thing's own: applied to the origin, where the observer stands.
    pub motion: Motion<D>,
    /// Which segment of the view is which of the model, and whether it runs the other way.
    pub pairs: Vec<(usize, usize, bool)>,
    /// Λ of (turning about three axes, shift, ln scale) about the middle of what was matched; what does not exist in
    /// the plane or was not asked has one on the diagonal.
    pub information: SMatrix<f64, 7, 7>,
    /// Share of the view's segments that are explained.
    pub explained: f64,
    /// ln of how much more likely the view is as this placement than as something never seen.
    pub evidence: f64,
    /// Probability among all placements that fit and the unknown.
    pub probability: f64,
}

/// Whether a view is known (V20).
#[derive(Debug, Clone, PartialEq)]
#[expect(
    clippy::large_enum_variant,
    reason = "there is one answer a view, and the one placement is what is wanted of it"
)]
pub enum Identification<const D: usize> {
    /// One thing, one place.
    Unique(Placement<D>),
    /// It fits these, most probable first, and nothing tells them apart; one alone: too little was seen to be sure.
    Ambiguous(Vec<Placement<D>>),
    /// It fits nothing.
    Unknown,
}

impl<const D: usize> Identification<D> {
    /// All placements of the answer, most probable first.
    #[must_use]
    pub fn placements(&self) -> &[Placement<D>] {
        match self {
            Self::Unique(one) => std::slice::from_ref(one),
            Self::Ambiguous(all) => all,
            Self::Unknown => &[],
        }
    }

    /// The one answer, if there is one.
    #[must_use]
    pub const fn unique(&self) -> Option<&Placement<D>> {
        match self {
            Self::Unique(one) => Some(one),
            _ => None,
        }
    }
}

/// An answer and how it was found.
#[derive(Debug, Clone, PartialEq)]
pub struct Search<const D: usize> {
    pub answer: Identification<D>,
    pub counters: Counters,
    /// Every placement that fits is in the answer: the view had links enough, and no stored thing has cut ends.
    /// Of a few segments that stand apart from one another some placement may be missed.
    pub complete: bool,
}

/// What was compared on the way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Counters {
    /// Cells of the hash that were looked into.
    pub lookups: u64,
    /// Stored invariants that were compared with those of the view.
    pub postings: u64,
    /// Segments that were compared with segments.
    pub segments: u64,
}

impl Counters {
    /// Comparisons of every sort, lookups among them: beside the paper's T(T − 1)/2 · M(M − 1)/2.
    #[must_use]
    pub const fn comparisons(&self) -> u64 {
        self.lookups + self.postings + self.segments
    }
}

impl Counters {
    /// With another's.
    #[must_use]
    pub const fn with(self, other: Self) -> Self {
        Self {
            lookups: self.lookups + other.lookups,
            postings: self.postings + other.postings,
            segments: self.segments + other.segments,
        }
    }
}
