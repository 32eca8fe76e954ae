//! A row of words, at a width known when compiled.

use super::word::Word;

/// A tuple, filled up with zeros to its width.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) struct Row<const N: usize>(pub(super) [Word; N]);

impl<const N: usize> Row<N> {
    #[inline]
    pub(super) fn of(words: &[Word]) -> Self {
        // Most rows fill their width; then nothing is looked up to copy them.
        if let Ok(row) = <[Word; N]>::try_from(words) {
            return Self(row);
        }
        let mut row = [0; N];
        row[..words.len()].copy_from_slice(words);
        Self(row)
    }

    /// Two words compare faster as one number than one after the other.
    #[inline]
    pub(super) fn pair(&self) -> u64 {
        (u64::from(self.0[0]) << 32) | u64::from(self.0[N - 1])
    }
}

impl<const N: usize> PartialOrd for Row<N> {
    #[inline]
    fn partial_cmp(&self, other: &Self) -> Option<std::cmp::Ordering> {
        Some(self.cmp(other))
    }

    #[inline]
    fn lt(&self, other: &Self) -> bool {
        if N == 2 { self.pair() < other.pair() } else { self.0 < other.0 }
    }
}

impl<const N: usize> Ord for Row<N> {
    #[inline]
    fn cmp(&self, other: &Self) -> std::cmp::Ordering {
        if N == 2 { self.pair().cmp(&other.pair()) } else { self.0.cmp(&other.0) }
    }
}
