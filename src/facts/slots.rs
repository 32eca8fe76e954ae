//! An index of rows that come and go: over those that were there, and over those that came later.

use std::collections::HashMap;
use std::sync::Arc;

use super::index::Index;
use super::program::Expr;
use super::rows::{Slot, Stored};
use super::value;
use super::word::{Word, Words};

/// Slots by key.
#[derive(Debug, Clone)]
pub(super) struct KeptIndex {
    pub(super) key: Vec<Expr>,
    /// Over the base.
    base: Arc<Index>,
    later: HashMap<Box<[Word]>, Vec<Slot>>,
}

impl KeptIndex {
    pub(super) fn new(rows: &dyn Stored, key: &[Expr], words: &mut Words) -> Self {
        let base = Arc::new(Index::new(&*rows.base(), key, words, 1));
        let mut index = Self { key: key.to_vec(), base, later: HashMap::new() };
        for slot in rows.later() {
            index.insert(rows.row(slot), slot, words);
        }
        index
    }

    fn key_of(&self, row: &[Word], words: &mut Words) -> Option<Box<[Word]>> {
        self.key.iter().map(|part| value::compute(part, &|c| row[c as usize], words)).collect()
    }

    pub(super) fn insert(&mut self, row: &[Word], slot: Slot, words: &mut Words) {
        if let Some(key) = self.key_of(row, words) {
            self.later.entry(key).or_default().push(slot);
        }
    }

    pub(super) fn remove(&mut self, row: &[Word], slot: Slot, words: &mut Words) {
        let Some(key) = self.key_of(row, words) else { return };
        if let Some(slots) = self.later.get_mut(&key) {
            slots.retain(|known| *known != slot);
            if slots.is_empty() {
                self.later.remove(&key);
            }
        }
    }

    /// Slots with the key; those of the base may be gone.
    pub(super) fn collect(&self, key: &[Word], found: &mut Vec<Slot>) {
        found.extend(self.base.range(key).map(|at| self.base.row(at) as Slot));
        if !self.later.is_empty()
            && let Some(slots) = self.later.get(key)
        {
            found.extend(slots);
        }
    }
}
