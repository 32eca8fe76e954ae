//! The pairs that a recursive relation holds already, as one bit for each possible pair.
//!
//! A closure over a few thousand things holds a good part of all pairs of them. A bit then tells at once
//! whether a pair is new, so that duplicates are never sorted, old rows never merged, and the finished
//! relation is read off the bits in order. Where pairs are thinner than [`BITS_PER_ROW`] this does not pay.

use std::ops::Range;
use std::sync::atomic::{AtomicU64, Ordering};

use super::row::Row;
use super::shares::{Task, apart};
use super::word::Word;

/// The bits may take so many for each row: twice the space of the row itself.
const BITS_PER_ROW: usize = 128;

#[derive(Debug)]
pub(super) struct Seen {
    least: [Word; 2],
    width: [usize; 2],
    bits: Vec<AtomicU64>,
    pub(super) len: usize,
}

impl Seen {
    /// An empty set over the range of the given rows; none where they are too thin, or are no pairs.
    pub(super) fn over<'a, const N: usize>(
        rows: impl Iterator<Item = &'a Row<N>> + Clone,
    ) -> Option<Self> {
        let mut least = [Word::MAX; 2];
        let mut most = [0; 2];
        let mut len = 0;
        for row in rows {
            len += 1;
            for (n, word) in [row.0[0], row.0[N - 1]].into_iter().enumerate() {
                least[n] = least[n].min(word);
                most[n] = most[n].max(word);
            }
        }
        if N != 2 || len == 0 {
            return None;
        }
        // One column's values are likely to turn up in the other.
        let least = [least[0].min(least[1]); 2];
        let span = (most[0].max(most[1]) - least[0]) as usize + 1;
        let bits = span.checked_mul(span).filter(|bits| *bits <= len * BITS_PER_ROW)?;
        let bits = (0..bits.div_ceil(64)).map(|_| AtomicU64::new(0)).collect();
        Some(Self { least, width: [span; 2], bits, len: 0 })
    }

    /// Memory held.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.bits.as_slice())
    }

    /// Whether the pair is new; none when it lies outside the range.
    #[inline]
    pub(super) fn insert<const N: usize>(&mut self, row: &Row<N>) -> Option<bool> {
        let at = self.place(row)?;
        let (word, bit) = (self.bits[at / 64].get_mut(), 1 << (at % 64));
        let is_new = *word & bit == 0;
        *word |= bit;
        self.len += usize::from(is_new);
        Some(is_new)
    }

    /// A word of bits as it stands while other threads put more there.
    #[inline]
    pub(super) fn look(&self, word: usize) -> u64 {
        self.bits[word].load(Ordering::Relaxed)
    }

    /// Puts bits into a word; those of them that stood there already.
    #[inline]
    pub(super) fn put(&self, word: usize, bits: u64) -> u64 {
        self.bits[word].fetch_or(bits, Ordering::Relaxed) & bits
    }

    #[inline]
    pub(super) fn place<const N: usize>(&self, row: &Row<N>) -> Option<usize> {
        let first = row.0[0].wrapping_sub(self.least[0]) as usize;
        let second = row.0[N - 1].wrapping_sub(self.least[1]) as usize;
        let is_inside = first < self.width[0] && second < self.width[1];
        is_inside.then(|| first * self.width[1] + second)
    }

    /// All pairs in ascending order, read off in so many threads where they are many.
    pub(super) fn rows_among<const N: usize>(&self, threads: usize) -> Vec<Row<N>> {
        const MANY: usize = 1 << 18;
        if threads < 2 || self.len < MANY {
            return self.rows();
        }
        // Zeroes cost nothing until they are written to, each thread's by itself.
        let mut rows = vec![[0; N]; self.len];
        let size = self.bits.len().div_ceil(threads);
        let mut rest = rows.as_mut_slice();
        let tasks = self.bits.chunks(size).enumerate().map(|(n, bits)| {
            let ones = bits.iter().map(|word| word.load(Ordering::Relaxed).count_ones());
            let count: usize = ones.map(|ones| ones as usize).sum();
            let (mine, others) = std::mem::take(&mut rest).split_at_mut(count);
            rest = others;
            Box::new(move || {
                let mut places = mine.iter_mut();
                self.each(n * size, bits, |row: Row<N>| {
                    if let Some(place) = places.next() {
                        *place = row.0;
                    }
                });
            }) as Task<'_>
        });
        apart(tasks.collect());
        rows.into_iter().map(Row).collect()
    }

    /// The range of the first words.
    pub(super) fn firsts(&self) -> Range<u64> {
        let least = u64::from(self.least[0]);
        least..least + self.width[0] as u64
    }

    /// The bits of the pairs whose first word is in a range.
    fn bits_of(&self, firsts: Range<u64>) -> Range<usize> {
        let own = self.firsts();
        let place = |first: u64| (first.clamp(own.start, own.end) - own.start) as usize;
        place(firsts.start) * self.width[1]..place(firsts.end) * self.width[1]
    }

    /// How many pairs have their first word in a range.
    pub(super) fn count(&self, firsts: Range<u64>) -> usize {
        let mut count = 0;
        self.each_word(self.bits_of(firsts), |_, word| count += word.count_ones() as usize);
        count
    }

    /// The second words of the pairs with a first one, ascending.
    pub(super) fn each_second(&self, first: u64, f: &mut impl FnMut(Word)) {
        let bits = self.bits_of(first..first + 1);
        let start = bits.start;
        self.each_word(bits, |at, mut rest| {
            while rest != 0 {
                let bit = at + rest.trailing_zeros() as usize;
                rest &= rest - 1;
                f(self.least[1] + (bit - start) as Word);
            }
        });
    }

    /// The words that a range of bits lies in, each with its first bit's place and without the bits beyond the range.
    fn each_word(&self, bits: Range<usize>, mut f: impl FnMut(usize, u64)) {
        let mut at = bits.start;
        while at < bits.end {
            let (n, skipped) = (at / 64, at % 64);
            let taken = (64 - skipped).min(bits.end - at);
            let mask = (u64::MAX >> (64 - taken)) << skipped;
            f(n * 64, self.bits[n].load(Ordering::Relaxed) & mask);
            at += taken;
        }
    }

    /// All pairs in ascending order.
    pub(super) fn rows<const N: usize>(&self) -> Vec<Row<N>> {
        let mut rows = Vec::with_capacity(self.len);
        self.each(0, &self.bits, |row| rows.push(row));
        rows
    }

    /// The pairs of some of the words, of which so many are before them.
    fn each<const N: usize>(&self, first: usize, bits: &[AtomicU64], mut f: impl FnMut(Row<N>)) {
        for (n, word) in (first..).zip(bits) {
            let mut rest = word.load(Ordering::Relaxed);
            while rest != 0 {
                let at = n * 64 + rest.trailing_zeros() as usize;
                rest &= rest - 1;
                let mut row = [0; N];
                row[0] = self.least[0] + (at / self.width[1]) as Word;
                row[N - 1] = self.least[1] + (at % self.width[1]) as Word;
                f(Row(row));
            }
        }
    }
}
