//! Rows that are edited one by one: a large sorted part that edits never touch, and the few rows that came after it.
//!
//! ```text
//!   base    a b c d e f g h      sorted, shared, never moved
//!   gone    . . x . . . x .      one bit for each row of the base
//!   later   d' b'                rows that came later, found through a tree
//! ```
//!
//! **Invariant**: a row keeps its [`Slot`] until it is removed or the rows are consolidated, so that indexes over
//! slots stay true through any number of edits; an edit costs the logarithm of the size.

use std::collections::BTreeMap;
use std::fmt::Debug;
use std::ops::Range;
use std::sync::{Arc, OnceLock};

use datafrog::Relation;

use super::row::Row;
use super::rows::{RowSet, SharedRows, Slot, Starting, Stored, at_width};
use super::sorting::sorted;
use super::word::Word;

#[derive(Clone)]
pub(super) struct StoredRows<const N: usize> {
    base: Arc<Relation<Row<N>>>,
    /// Empty while nothing of the base is gone.
    gone: Vec<u64>,
    gone_count: usize,
    later: Vec<Row<N>>,
    places: BTreeMap<Row<N>, Slot>,
    /// Places in `later` that are free.
    free: Vec<usize>,
    merged: OnceLock<Arc<Relation<Row<N>>>>,
}

impl<const N: usize> Debug for StoredRows<N> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_set().entries(self.merged().iter()).finish()
    }
}

/// An empty set of rows of so many columns.
pub(super) fn stored(columns: usize) -> Box<dyn Stored> {
    at_width!(columns, N => {
        Box::new(StoredRows::<N>::over(Arc::new(Relation { elements: Vec::new() })))
    })
}

impl<const N: usize> StoredRows<N> {
    pub(super) fn over(base: Arc<Relation<Row<N>>>) -> Self {
        Self {
            base,
            gone: Vec::new(),
            gone_count: 0,
            later: Vec::new(),
            places: BTreeMap::new(),
            free: Vec::new(),
            merged: OnceLock::new(),
        }
    }

    fn is_gone(&self, at: usize) -> bool {
        self.gone.get(at / 64).is_some_and(|bits| bits >> (at % 64) & 1 == 1)
    }

    fn in_base(&self, row: &Row<N>) -> Option<usize> {
        self.base.elements.binary_search(row).ok()
    }

    /// How many of a range of the base are gone.
    fn gone_within(&self, range: &Range<usize>) -> usize {
        if self.gone_count == 0 {
            return 0;
        }
        if range.len() == self.base.elements.len() {
            return self.gone_count;
        }
        range.clone().filter(|at| self.is_gone(*at)).count()
    }

    fn merged(&self) -> Arc<Relation<Row<N>>> {
        if self.gone_count == 0 && self.places.is_empty() {
            return Arc::clone(&self.base);
        }
        let merge = || {
            let mut all = Vec::with_capacity(self.len());
            let mut later = self.places.keys().peekable();
            let kept = self.base.iter().enumerate().filter(|(at, _)| !self.is_gone(*at));
            for (_, row) in kept {
                while let Some(before) = later.next_if(|other| *other < row) {
                    all.push(*before);
                }
                all.push(*row);
            }
            all.extend(later);
            Arc::new(Relation { elements: all })
        };
        self.merged.get_or_init(merge).clone()
    }
}

impl<const N: usize> Stored for StoredRows<N> {
    fn len(&self) -> usize {
        self.base.elements.len() - self.gone_count + self.places.len()
    }

    #[inline]
    fn row(&self, slot: Slot) -> &[Word] {
        let slot = slot as usize;
        match self.base.elements.get(slot) {
            Some(row) => &row.0,
            None => &self.later[slot - self.base.elements.len()].0,
        }
    }

    fn find(&self, row: &[Word]) -> Option<Slot> {
        let row = Row::of(row);
        match self.in_base(&row) {
            Some(at) => (!self.is_gone(at)).then_some(at as Slot),
            None => self.places.get(&row).copied(),
        }
    }

    fn insert(&mut self, row: &[Word]) -> Option<Slot> {
        let row = Row::of(row);
        if let Some(at) = self.in_base(&row) {
            if !self.is_gone(at) {
                return None;
            }
            self.merged.take();
            self.gone[at / 64] &= !(1 << (at % 64));
            self.gone_count -= 1;
            return Some(at as Slot);
        }
        if self.places.contains_key(&row) {
            return None;
        }
        self.merged.take();
        let place = self.free.pop().unwrap_or_else(|| {
            self.later.push(row);
            self.later.len() - 1
        });
        self.later[place] = row;
        let slot = (self.base.elements.len() + place) as Slot;
        self.places.insert(row, slot);
        Some(slot)
    }

    fn remove(&mut self, row: &[Word]) -> Option<Slot> {
        let row = Row::of(row);
        if let Some(at) = self.in_base(&row) {
            if self.is_gone(at) {
                return None;
            }
            self.merged.take();
            self.gone.resize(self.base.elements.len().div_ceil(64), 0);
            self.gone[at / 64] |= 1 << (at % 64);
            self.gone_count += 1;
            return Some(at as Slot);
        }
        let slot = self.places.remove(&row)?;
        self.merged.take();
        self.free.push(slot as usize - self.base.elements.len());
        Some(slot)
    }

    fn is_there(&self, slot: Slot) -> bool {
        !self.is_gone(slot as usize)
    }

    fn starting(&self, key: &[Word]) -> Starting {
        let base = self.base.range(key);
        let mut later = Vec::new();
        if !self.places.is_empty() {
            let from = self.places.range(Row::of(key)..);
            later.extend(from.take_while(|(row, _)| row.0.starts_with(key)).map(|(_, slot)| *slot));
            later.reverse();
        }
        let len = base.len() - self.gone_within(&base) + later.len();
        Starting { base: base.start as Slot..base.end as Slot, later, len }
    }

    fn base(&self) -> SharedRows {
        Arc::clone(&self.base) as SharedRows
    }

    fn later(&self) -> Vec<Slot> {
        self.places.values().copied().collect()
    }

    fn rows(&self) -> SharedRows {
        self.merged()
    }

    fn is_fragmented(&self) -> bool {
        self.places.len() > self.base.elements.len() / 2 + 4096
    }

    fn consolidate(&mut self) {
        *self = Self::over(self.merged());
    }

    fn extend(&mut self, words: &[Word], columns: usize) {
        let mut all: Vec<Row<N>> = words.chunks_exact(columns).map(Row::of).collect();
        if self.len() > 0 {
            all.extend(self.merged().iter());
        }
        *self = Self::over(Arc::new(sorted(all)));
    }

    fn clear(&mut self) {
        *self = Self::over(Arc::new(Relation { elements: Vec::new() }));
    }

    fn boxed_clone(&self) -> Box<dyn Stored> {
        Box::new(self.clone())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn all(rows: &dyn Stored, key: &[Word]) -> Vec<Vec<Word>> {
        let mut starting = rows.starting(key);
        let mut found = Vec::new();
        let len = starting.len;
        while let Some(slot) = starting.next(rows) {
            found.push(rows.row(slot).to_vec());
        }
        assert_eq!(found.len(), len);
        found
    }

    #[test]
    fn edits_beside_the_base_read_as_one_sorted_set() {
        let mut rows = StoredRows::<2>::over(Arc::new(Relation { elements: Vec::new() }));
        rows.extend(&[1, 5, 1, 2, 3, 1, 2, 2], 2);
        assert!(rows.insert(&[1, 2]).is_none() && rows.remove(&[9, 9]).is_none());
        let later = rows.insert(&[1, 3]).unwrap();
        assert_eq!(rows.row(later), [1, 3]);
        let gone = rows.remove(&[1, 5]).unwrap();
        assert_eq!(all(&rows, &[1]), [[1, 2], [1, 3]]);
        assert_eq!(rows.insert(&[1, 5]), Some(gone));
        assert_eq!(all(&rows, &[]), [[1, 2], [1, 3], [1, 5], [2, 2], [3, 1]]);
        assert_eq!(rows.remove(&[1, 3]), Some(later));
        assert_eq!(rows.insert(&[0, 7]), Some(later));
        assert_eq!((rows.len(), rows.rows().len()), (5, 5));
        rows.consolidate();
        assert_eq!(all(&rows, &[]), [[0, 7], [1, 2], [1, 5], [2, 2], [3, 1]]);
    }
}
