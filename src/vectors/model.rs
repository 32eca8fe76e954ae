//! A model of a thing: its segments in a frame of its own, in the order of the contour (SPEC V1, V3, V5, V9; paper 3,
//! sections 1 and 4).
//!
//! # Invariants
//!
//! A model does not change; what is derived from its segments (joints, places) is derived once. Counts of sightings
//! alone are updated.

use crate::{Equality, Euclid, Motion, Pair, Segment, Space, Triple, locate::Locator};

/// How often a segment was seen, and how often it should have been (V9).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub struct Membership {
    pub seen: u32,
    pub expected: u32,
}

impl Membership {
    /// The paper's P^μ(h): probability that an observation contains the segment; by the rule of succession, so that
    /// one sighting is no certainty.
    #[must_use]
    pub fn probability(self) -> f64 {
        (f64::from(self.seen) + 1.0) / (f64::from(self.expected) + 2.0)
    }

    /// With another's counts.
    #[must_use]
    pub const fn with(self, other: Self) -> Self {
        Self { seen: self.seen + other.seen, expected: self.expected + other.expected }
    }
}

/// A set of segments in contour order, with what follows from it.
#[derive(Debug, Clone, PartialEq)]
pub struct Model<const D: usize> {
    segments: Vec<Segment<D>>,
    membership: Vec<Membership>,
    /// The segment after each on its contour: of a ring the first again, of an open contour the next contour's first.
    next: Vec<Option<u32>>,
    previous: Vec<Option<u32>>,
    /// Whether a segment ends where the next one begins: one corner, nothing hidden between.
    joined: Vec<bool>,
    places: Locator<D>,
    /// The greatest deviation of a coordinate, in cm.
    deviation: f64,
    /// All ends are true.
    whole: bool,
}

impl<const D: usize> Model<D> {
    /// Of segments that come in the order of their contours, as a scan or a polyline gives them.
    #[must_use]
    pub fn of_contour(segments: Vec<Segment<D>>) -> Self {
        let membership = vec![Membership { seen: 1, expected: 1 }; segments.len()];
        Self::with_membership(segments, membership)
    }

    /// Of a set of segments: brought into order, nearest end next (V5).
    #[must_use]
    pub fn of_set(segments: &[Segment<D>]) -> Self {
        Self::of_contour(
            crate::contour::order(segments).into_iter().map(|(_, segment)| segment).collect(),
        )
    }

    /// Of segments in contour order, with their counts.
    pub(crate) fn with_membership(segments: Vec<Segment<D>>, membership: Vec<Membership>) -> Self {
        let (next, joined) = chain(&segments);
        let mut previous = vec![None; segments.len()];
        for (k, after) in next.iter().enumerate() {
            if let Some(after) = after {
                previous[*after as usize] = Some(k as u32);
            }
        }
        let places = Locator::new(&segments);
        let deviation = segments.iter().map(|s| s.covariance.deviation()).fold(0.0, f64::max);
        let whole = segments.iter().all(Segment::is_whole);
        Self { segments, membership, next, previous, joined, places, deviation, whole }
    }

    #[must_use]
    pub fn segments(&self) -> &[Segment<D>] {
        &self.segments
    }

    #[must_use]
    pub fn len(&self) -> usize {
        self.segments.len()
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.segments.is_empty()
    }

    /// Counts of a segment.
    #[must_use]
    pub fn membership(&self, segment: usize) -> Membership {
        self.membership[segment]
    }

    /// The segment after `k` on its contour.
    #[must_use]
    pub fn next(&self, k: usize) -> Option<usize> {
        self.next[k].map(|k| k as usize)
    }

    /// The segment before `k`.
    #[must_use]
    pub fn previous(&self, k: usize) -> Option<usize> {
        self.previous[k].map(|k| k as usize)
    }

    /// Whether segment `k` and the next one share a corner.
    #[must_use]
    pub fn is_joined(&self, k: usize) -> bool {
        self.joined[k]
    }

    /// Counts a further observation: which segments should have been in it, and were.
    pub fn witness(
        &mut self,
        seen: impl IntoIterator<Item = usize>,
        expected: impl IntoIterator<Item = usize>,
    ) {
        for k in expected {
            self.membership[k].expected += 1;
        }
        for k in seen {
            let membership = &mut self.membership[k];
            membership.seen += 1;
            // What was seen was to be seen, whatever was thought.
            membership.expected = membership.expected.max(membership.seen);
        }
    }

    /// Segments that pass within `reach` cm of a point, and perhaps some others; ascending.
    #[must_use]
    pub fn near(&self, point: &nalgebra::SVector<f64, D>, reach: f64) -> Vec<u32> {
        let mut found = Vec::new();
        self.places.near(point, reach, &mut found);
        found
    }

    pub(crate) const fn places(&self) -> &Locator<D> {
        &self.places
    }

    /// The greatest deviation of a coordinate of an end, in cm.
    #[must_use]
    pub const fn deviation(&self) -> f64 {
        self.deviation
    }

    /// Whether every end is true.
    #[must_use]
    pub const fn is_whole(&self) -> bool {
        self.whole
    }

    /// The model after a motion.
    #[must_use]
    pub fn moved(&self, motion: &Motion<D>) -> Self {
        let segments = self.segments.iter().map(|s| s.moved(motion)).collect();
        Self::with_membership(segments, self.membership.clone())
    }

    /// The model of some of its segments, in its order.
    #[must_use]
    pub fn part(&self, members: &[usize]) -> Self {
        let mut members = members.to_vec();
        members.sort_unstable();
        let segments = members.iter().map(|&k| self.segments[k]).collect();
        Self::with_membership(segments, members.iter().map(|&k| self.membership[k]).collect())
    }

    /// Greatest distance of two ends along one axis, in cm.
    #[must_use]
    pub fn extent(&self) -> f64 {
        (0..D)
            .map(|axis| {
                let ends = self.segments.iter().flat_map(|s| [s.start[axis], s.end[axis]]);
                let (low, high) =
                    ends.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
                (high - low).max(0.0)
            })
            .fold(0.0, f64::max)
    }

    /// V3: equal as sets of undirected segments, in one frame. Each finds its own match, none is left.
    #[must_use]
    pub fn equals(&self, other: &Self, equality: &Equality) -> bool {
        if self.len() != other.len() {
            return false;
        }
        let fits: Vec<Vec<usize>> = self
            .segments
            .iter()
            .map(|s| {
                (0..other.len())
                    .filter(|&k| equality.equal(s, &other.segments[k]).is_some())
                    .collect()
            })
            .collect();
        let mut taken = vec![None; other.len()];
        (0..self.len()).all(|k| place(k, &fits, &mut taken, &mut vec![false; other.len()]))
    }
}

impl<const D: usize> Model<D>
where
    Euclid<D>: Space<D>,
{
    /// Invariants of each segment and the next one: the paper's pairs {(j − 1), j}.
    #[must_use]
    pub fn pairs(&self) -> Vec<(usize, usize, Option<Pair>)> {
        (0..self.len())
            .filter_map(|a| self.next(a).map(|b| (a, b)))
            .map(|(a, b)| (a, b, Pair::of(&self.segments[a], &self.segments[b])))
            .collect()
    }

    /// Invariants of three in a row, by the first of them.
    #[must_use]
    pub fn triples(&self) -> Vec<(usize, Option<Triple>)> {
        let row = |a: usize| {
            let b = self.next(a)?;
            let c = self.next(b).filter(|&c| c != a)?;
            Some((a, Triple::of(&self.segments[a], &self.segments[b], &self.segments[c])))
        };
        (0..self.len()).filter_map(row).collect()
    }
}

/// Successors along contours, and which are joined.
fn chain<const D: usize>(segments: &[Segment<D>]) -> (Vec<Option<u32>>, Vec<bool>) {
    let count = segments.len();
    let mut next: Vec<Option<u32>> =
        (0..count).map(|k| (k + 1 < count).then_some(k as u32 + 1)).collect();
    let mut joined: Vec<bool> =
        (0..count).map(|k| k + 1 < count && meet(&segments[k], &segments[k + 1])).collect();
    let mut first = 0;
    for k in 0..count {
        if joined[k] {
            continue;
        }
        // A run of joined segments ends here: closed, if it ends where it began.
        if k > first + 1 && meet(&segments[k], &segments[first]) {
            next[k] = Some(first as u32);
            joined[k] = true;
        }
        first = k + 1;
    }
    (next, joined)
}

/// Whether `a` ends, truly, where `b` truly begins.
fn meet<const D: usize>(a: &Segment<D>, b: &Segment<D>) -> bool {
    if !a.ends[1].is_true() || !b.ends[0].is_true() {
        return false;
    }
    let gap = b.start - a.end;
    let trace = a.covariance.end.trace() + b.covariance.start.trace();
    // 3.7 σ of one coordinate: wide enough for one corner seen twice.
    gap.norm_squared() <= 14.0 * trace / D as f64 + 1e-6
}

/// One step of Kuhn's matching: finds segment `k` a partner, moving others where needed.
fn place(k: usize, fits: &[Vec<usize>], taken: &mut [Option<usize>], tried: &mut [bool]) -> bool {
    for &partner in &fits[k] {
        if std::mem::replace(&mut tried[partner], true) {
            continue;
        }
        if taken[partner].is_none_or(|other| place(other, fits, taken, tried)) {
            taken[partner] = Some(k);
            return true;
        }
    }
    false
}
