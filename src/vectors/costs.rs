//! What comparing costs without an index, as the paper counts it (SPEC V21, V22; paper 3, section 4).
//!
//! The formulas, and beside them the procedures that they count, run literally. What the index does is counted by
//! [`Counters`](crate::Counters).

/// Two segments of a model, by their places in it, the lower first.
pub type SegmentPair = (usize, usize);

/// Characteristics of a model of M segments: M lengths, 2M inclinations, M(M − 1) angles between them.
#[must_use]
pub const fn characteristics(m: u64) -> u64 {
    m * m + 2 * m
}

/// Pairs of M segments.
#[must_use]
pub const fn pairs(m: u64) -> u128 {
    m as u128 * m.saturating_sub(1) as u128 / 2
}

/// Comparisons of an observation of M segments with a tree of T, each pair with each: T(T − 1)/2 · M(M − 1)/2.
#[must_use]
pub const fn search(t: u64, m: u64) -> u128 {
    pairs(t) * pairs(m)
}

/// Comparisons of two observations in the differential mode: M'(M' − 1)/2 · M''(M'' − 1)/2.
#[must_use]
pub const fn differential(m1: u64, m2: u64) -> u128 {
    pairs(m1) * pairs(m2)
}

/// The paper's approximation of [`differential`] for M' ≈ M'' ≈ M: M⁴ / 4, 15.625·10⁹ for 500.
#[must_use]
pub const fn approximate(m: u64) -> u128 {
    (m as u128).pow(4) / 4
}

/// Compares each pair of the first model with each of the second; equal pairs take no further part.
///
/// Returns the comparisons done and the pairs found equal. `equal` is given pairs (i, j), i < j, of either model.
pub fn removing(
    m1: usize,
    m2: usize,
    mut equal: impl FnMut(SegmentPair, SegmentPair) -> bool,
) -> (u64, Vec<(SegmentPair, SegmentPair)>) {
    let list = |m: usize| (0..m).flat_map(move |i| (i + 1..m).map(move |j| (i, j)));
    let mut left: Vec<_> = list(m2).collect();
    let (mut comparisons, mut found) = (0, Vec::new());
    for first in list(m1) {
        let hit = left.iter().position(|&second| {
            comparisons += 1;
            equal(first, second)
        });
        if let Some(k) = hit {
            found.push((first, left.remove(k)));
        }
    }
    (comparisons, found)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The numbers of the paper's section 4.
    #[test]
    fn the_papers_counts() {
        assert_eq!(differential(500, 500), 15_562_562_500);
        assert_eq!(approximate(500), 15_625_000_000);
        assert_eq!(differential(3, 4), 18);
        assert_eq!(characteristics(30), 960);
        assert_eq!(search(10_000, 30), 49_995_000 * 435);
    }

    /// 3 and 4 segments, only the first comparison positive: 11 instead of 18, 38.89 % less.
    #[test]
    fn the_papers_example_of_removal() {
        let (all, none) = removing(3, 4, |_, _| false);
        assert_eq!((all, none.len()), (18, 0));
        let (done, found) = removing(3, 4, |first, second| first == (0, 1) && second == (0, 1));
        assert_eq!((done, found.len()), (11, 1));
        let saved = 100.0 * (1.0 - done as f64 / all as f64);
        assert!((saved - 38.89).abs() < 0.005);
    }
}
