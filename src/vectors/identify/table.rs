//! The hash table of the index: links by the cell of their invariants.
//!
//! # Invariants
//!
//! `sorted` is ordered by (cell, value), `directory` tells where its buckets begin. What was added since stands in
//! `recent` and is merged when it has grown to half as much, so that adding is cheap in the mean.

use std::collections::HashMap;

use super::{
    answer::Counters,
    link::{Key, Kind},
};

/// One stored link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Posting {
    cell: u32,
    /// The last axis of the key.
    value: f32,
    pub(crate) slot: u32,
    /// Segments of the model, first and second in stored order.
    pub(crate) first: u16,
    pub(crate) second: u16,
}

#[derive(Debug, Clone, Default)]
pub(crate) struct Table {
    sorted: Vec<Posting>,
    directory: Vec<u32>,
    shift: u32,
    recent: HashMap<u32, Vec<Posting>>,
    pending: usize,
    /// Links of each kind.
    kinds: [usize; 6],
}

impl Table {
    pub(crate) fn len(&self) -> usize {
        self.sorted.len() + self.pending
    }

    /// Links of one kind.
    pub(crate) const fn count(&self, kind: Kind) -> usize {
        self.kinds[kind as usize]
    }

    pub(crate) fn reserve(&mut self, links: usize) {
        self.sorted.reserve_exact(links);
    }

    pub(crate) fn insert(&mut self, key: &Key, slot: u32, segments: (u16, u16)) {
        let posting = self.posting(key, slot, segments);
        self.recent.entry(posting.cell).or_default().push(posting);
        self.pending += 1;
        if self.pending > 4096.max(self.sorted.len() / 2) {
            self.merge();
        }
    }

    /// Adds one of many; nothing is found before they are merged.
    pub(crate) fn append(&mut self, key: &Key, slot: u32, segments: (u16, u16)) {
        let posting = self.posting(key, slot, segments);
        self.sorted.push(posting);
    }

    fn posting(&mut self, key: &Key, slot: u32, (first, second): (u16, u16)) -> Posting {
        let (last, hashed) = key.axes().split_last().expect("a key has axes");
        let cell = hash(key.kind, hashed.iter().map(|axis| axis.cell()));
        self.kinds[key.kind as usize] += 1;
        Posting { cell, value: last.value as f32, slot, first, second }
    }

    /// Merges what was added since.
    pub(crate) fn merge(&mut self) {
        self.sorted.extend(std::mem::take(&mut self.recent).into_values().flatten());
        self.pending = 0;
        self.sorted.sort_unstable_by(|a, b| a.cell.cmp(&b.cell).then(a.value.total_cmp(&b.value)));
        let bits = (self.sorted.len().max(1) as u32).ilog2();
        self.shift = 32 - bits;
        self.directory.clear();
        self.directory.resize((1 << bits) + 1, 0);
        for posting in &self.sorted {
            self.directory[(u64::from(posting.cell) >> self.shift) as usize + 1] += 1;
        }
        for k in 1..self.directory.len() {
            self.directory[k] += self.directory[k - 1];
        }
    }

    /// Hands over every link whose cell and last axis lie within the key's tolerances, and, where these reach more cells
    /// than there are links, some others: the caller compares anyway.
    pub(crate) fn find(&self, key: &Key, counters: &mut Counters, mut found: impl FnMut(&Posting)) {
        let (last, hashed) = key.axes().split_last().expect("a key has axes");
        let (low, high) =
            ((last.value - last.tolerance) as f32, (last.value + last.tolerance) as f32);
        let (low, high) = (low - low.abs() * 1e-6 - 1e-6, high + high.abs() * 1e-6 + 1e-6);
        if key.cells() > self.len() as f64 {
            counters.postings += self.len() as u64;
            let all = self.sorted.iter().chain(self.recent.values().flatten());
            all.filter(|p| p.value >= low && p.value <= high).for_each(found);
            return;
        }
        let spans: Vec<(i64, i64)> = hashed.iter().map(super::link::Axis::span).collect();
        let mut at = vec![0; spans.len()];
        'cells: loop {
            let cell = hash(
                key.kind,
                at.iter()
                    .zip(&spans)
                    .zip(hashed)
                    .map(|((&k, span), axis)| axis.wrapped(span.0 + k)),
            );
            counters.lookups += 1;
            let fits = |p: &Posting| p.cell == cell && p.value >= low && p.value <= high;
            if !self.directory.is_empty() {
                let bucket = (u64::from(cell) >> self.shift) as usize;
                let bucket = &self.sorted
                    [self.directory[bucket] as usize..self.directory[bucket + 1] as usize];
                // A bucket holds about one link; a full one is entered by bisection.
                let from = if bucket.len() > 8 {
                    counters.postings += u64::from(bucket.len().ilog2());
                    bucket.partition_point(|p| p.cell < cell || (p.cell == cell && p.value < low))
                } else {
                    0
                };
                for posting in &bucket[from..] {
                    counters.postings += 1;
                    if posting.cell > cell || (posting.cell == cell && posting.value > high) {
                        break;
                    }
                    if fits(posting) {
                        found(posting);
                    }
                }
            }
            if let Some(postings) = self.recent.get(&cell) {
                counters.postings += postings.len() as u64;
                postings.iter().filter(|p| fits(p)).for_each(&mut found);
            }
            for k in 0..at.len() {
                at[k] += 1;
                if at[k] < spans[k].1 {
                    continue 'cells;
                }
                at[k] = 0;
            }
            return;
        }
    }
}

fn hash(kind: Kind, cells: impl Iterator<Item = i64>) -> u32 {
    let start = 0x9e37_79b9_7f4a_7c15_u64 ^ (kind as u64) << 32;
    let stirred = cells
        .fold(start, |h, x| (h ^ x as u64).wrapping_mul(0xff51_afd7_ed55_8ccd).rotate_left(31));
    (stirred.wrapping_mul(0xc4ce_b9fe_1a85_ec53) >> 32) as u32
}
