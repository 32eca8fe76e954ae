//! The calls that have been answered, and what is known of others by them.

use std::cell::OnceCell;
use std::collections::HashMap;
use std::rc::Rc;

use foldhash::fast::RandomState;

use super::called::{Flat, Mask, columns_of};
use super::relations::RelationId;
use super::rows::SharedRows;
use super::word::Word;

pub(super) type Key = Box<[Word]>;

/// A relation and the columns by which it is called.
pub(super) type Way = (RelationId, Mask);

/// Answered calls by their way.
#[derive(Default)]
pub(super) struct Tables(HashMap<Way, Table, RandomState>);

#[derive(Default)]
struct Table {
    answered: HashMap<Key, Rc<Flat>, RandomState>,
    /// Calls of which only this was asked: whether they have rows.
    tested: HashMap<Key, bool, RandomState>,
    /// Every call that is not there has no rows.
    is_whole: bool,
    /// What magic sets found besides the call that they were made for.
    besides: Vec<Besides>,
}

impl Tables {
    /// A call's rows, so many columns each, where it has been answered.
    pub(super) fn rows(&self, way: Way, key: &[Word], columns: usize) -> Option<Rc<Flat>> {
        let table = self.0.get(&way)?;
        let known = table.answered.get(key).map(Rc::clone);
        known.or_else(|| table.is_whole.then(|| Rc::new(Flat::new(columns))))
    }

    /// Whether a call has rows, where that is known.
    pub(super) fn has_rows(&self, way: Way, key: &[Word]) -> Option<bool> {
        let table = self.0.get(&way)?;
        let known = table.answered.get(key).map(|rows| rows.len > 0);
        known.or_else(|| table.tested.get(key).copied()).or_else(|| table.is_whole.then_some(false))
    }

    /// How many calls have come up.
    pub(super) fn calls(&self, way: Way) -> usize {
        self.0.get(&way).map_or(0, |table| table.answered.len() + table.tested.len())
    }

    pub(super) fn keep(&mut self, way: Way, key: &[Word], rows: Rc<Flat>) {
        self.0.entry(way).or_default().answered.insert(key.into(), rows);
    }

    pub(super) fn keep_tested(&mut self, way: Way, key: &[Word], has_rows: bool) {
        self.0.entry(way).or_default().tested.insert(key.into(), has_rows);
    }

    /// All rows of a relation, which answer every call.
    pub(super) fn keep_all(&mut self, way: Way, all: &Flat, columns: usize) {
        let mut by_key: HashMap<Key, Flat, RandomState> = HashMap::default();
        for row in all.iter() {
            let key: Key = columns_of(way.1).map(|column| row[column]).collect();
            by_key.entry(key).or_insert_with(|| Flat::new(columns)).push(row);
        }
        let table = self.0.entry(way).or_default();
        table.answered = by_key.into_iter().map(|(key, rows)| (key, Rc::new(rows))).collect();
        table.is_whole = true;
    }

    pub(super) fn keep_besides(&mut self, way: Way, besides: Besides) {
        self.0.entry(way).or_default().besides.push(besides);
    }

    /// The rows of a call that came up on the way to another.
    pub(super) fn beside(&self, way: Way, key: &[Word], columns: usize) -> Option<Rc<Flat>> {
        self.0.get(&way)?.besides.iter().find_map(|one| one.find(way.1, key, columns))
    }
}

/// Calls that came up on the way to another call, and the rows that fit any of them.
pub(super) struct Besides {
    pub(super) calls: SharedRows,
    pub(super) rows: SharedRows,
    /// Made at the first look.
    by_key: OnceCell<HashMap<Key, Vec<u32>, RandomState>>,
}

impl Besides {
    pub(super) fn new(calls: SharedRows, rows: SharedRows) -> Self {
        Self { calls, rows, by_key: OnceCell::new() }
    }

    /// None where the call did not come up.
    fn find(&self, mask: Mask, key: &[Word], columns: usize) -> Option<Rc<Flat>> {
        if self.calls.range(key).is_empty() {
            return None;
        }
        let by_key = self.by_key.get_or_init(|| {
            let mut by_key: HashMap<Key, Vec<u32>, RandomState> = HashMap::default();
            let mut key = Vec::new();
            for at in 0..self.rows.len() {
                let row = self.rows.row(at);
                key.clear();
                key.extend(columns_of(mask).map(|column| row[column]));
                match by_key.get_mut(key.as_slice()) {
                    Some(places) => places.push(at as u32),
                    None => drop(by_key.insert(key.as_slice().into(), vec![at as u32])),
                }
            }
            by_key
        });
        let mut flat = Flat::new(columns);
        for at in by_key.get(key).into_iter().flatten() {
            flat.push(self.rows.row(*at as usize));
        }
        Some(Rc::new(flat))
    }
}
