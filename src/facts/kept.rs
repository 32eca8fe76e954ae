//! Derived relations that stay: rows that are edited, and indexes that follow the edits.
//!
//! An update looks up a few rows in large relations. So indexes are built once, over the part of a relation that
//! edits never touch, and what comes later is found through a table beside it. While an update runs a relation
//! holds the rows of before and after together; [`View`] says which of the two a plan reads.

use std::collections::HashSet;
use std::sync::{Arc, Mutex, MutexGuard, OnceLock, PoisonError};

use super::limits::Watch;
use super::plan::{Plan, Request, Statistics};
use super::program::Expr;
use super::relations::RelationId;
use super::rows::{RowSet, SharedRows, Slot, Stored, distinct};
use super::run::{Goal, Kept as KeptSource, Source, run};
use super::slots::KeptIndex;
use super::word::{Word, Words};

/// What an update has changed in a relation so far.
#[derive(Debug, Clone, Default)]
pub(super) struct Edit {
    pub(super) added: HashSet<Slot>,
    pub(super) removed: HashSet<Slot>,
}

impl Edit {
    pub(super) fn is_empty(&self) -> bool {
        self.added.is_empty() && self.removed.is_empty()
    }
}

/// Which rows of a relation under edit are seen.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum View {
    Before,
    After,
}

/// All relations of a result, with the indexes that were asked for.
#[derive(Debug, Clone)]
pub(super) struct Kept {
    pub(super) words: Words,
    rows: Vec<Box<dyn Stored>>,
    indexes: Vec<Vec<Arc<KeptIndex>>>,
    /// Indexes that questions asked for; the next update takes them over.
    shelf: Shelf,
    edits: Vec<Edit>,
    distinct: Vec<Vec<OnceLock<f64>>>,
}

/// Indexes by relation, made while others read.
#[derive(Debug, Default)]
struct Shelf(Mutex<Vec<(RelationId, Arc<KeptIndex>)>>);

impl Shelf {
    /// A thread that ended amid a question has put nothing half done here.
    fn all(&self) -> MutexGuard<'_, Vec<(RelationId, Arc<KeptIndex>)>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

impl Clone for Shelf {
    fn clone(&self) -> Self {
        Self(Mutex::new(self.all().clone()))
    }
}

impl Clone for Box<dyn Stored> {
    fn clone(&self) -> Self {
        self.boxed_clone()
    }
}

impl Kept {
    pub(super) fn new(words: Words, rows: Vec<SharedRows>, columns: &[usize]) -> Self {
        Self {
            words,
            shelf: Shelf::default(),
            indexes: rows.iter().map(|_| Vec::new()).collect(),
            edits: rows.iter().map(|_| Edit::default()).collect(),
            distinct: columns.iter().map(|columns| vec![OnceLock::new(); *columns]).collect(),
            rows: rows.into_iter().map(|rows| rows.stored()).collect(),
        }
    }

    /// Number of relations.
    pub(super) fn len(&self) -> usize {
        self.rows.len()
    }

    pub(super) fn rows(&self, relation: RelationId) -> &dyn Stored {
        &*self.rows[relation.index()]
    }

    pub(super) fn edit(&self, relation: RelationId) -> &Edit {
        &self.edits[relation.index()]
    }

    /// Builds the indexes that a plan asks for.
    pub(super) fn provide(&mut self, plan: &Plan) {
        for request in &plan.requests {
            if let Request::Index { relation, key, .. } = request {
                self.index(*relation, key);
            }
        }
    }

    /// The number of an index; none where rows stand in the order of the key.
    fn index(&mut self, relation: RelationId, key: &[Expr]) -> Option<usize> {
        if is_natural(key) {
            return None;
        }
        let indexes = &mut self.indexes[relation.index()];
        Some(indexes.iter().position(|known| known.key == key).unwrap_or_else(|| {
            let rows = &*self.rows[relation.index()];
            indexes.push(Arc::new(KeptIndex::new(rows, key, &mut self.words)));
            indexes.len() - 1
        }))
    }

    /// The index by these columns, made where there is none yet; none where rows stand in the order of the key.
    pub(super) fn shared_index(
        &self,
        relation: RelationId,
        key: &[Expr],
    ) -> Option<Arc<KeptIndex>> {
        if is_natural(key) {
            return None;
        }
        if let Some(known) = self.indexes[relation.index()].iter().find(|known| known.key == key) {
            return Some(Arc::clone(known));
        }
        let mut shelf = self.shelf.all();
        let known = shelf.iter().find(|(of, known)| *of == relation && known.key == key);
        if let Some((_, known)) = known {
            return Some(Arc::clone(known));
        }
        // Columns are not computed, so that no new word comes about.
        debug_assert!(key.iter().all(|part| matches!(part, Expr::Variable(_))));
        let rows = &*self.rows[relation.index()];
        let index = Arc::new(KeptIndex::new(rows, key, &mut Words::default()));
        shelf.push((relation, Arc::clone(&index)));
        Some(index)
    }

    /// Puts other rows in the place of a relation's, none where none are given.
    pub(super) fn put_back(&mut self, relation: RelationId, rows: Option<&dyn Stored>) {
        let at = relation.index();
        match rows {
            Some(rows) => self.rows[at] = rows.boxed_clone(),
            None => self.rows[at].clear(),
        }
        self.indexes[at].clear();
        self.shelf.all().retain(|(of, _)| *of != relation);
        self.distinct[at].iter_mut().for_each(|known| *known = OnceLock::new());
    }

    /// Before an update: what questions asked for follows the edits from now on.
    pub(super) fn take_shelf(&mut self) {
        let shelf = std::mem::take(&mut *self.shelf.all());
        for (relation, index) in shelf {
            let indexes = &mut self.indexes[relation.index()];
            if indexes.iter().all(|known| known.key != index.key) {
                indexes.push(index);
            }
        }
    }

    /// The first rows whose key columns have these words.
    pub(super) fn find(
        &mut self,
        relation: RelationId,
        key: &[Expr],
        word: &[Word],
        limit: usize,
    ) -> Vec<Vec<Word>> {
        let index = self.index(relation, key).map(|n| &self.indexes[relation.index()][n]);
        let source = self.source(relation, index, None, View::After);
        let mut slots = Vec::new();
        source.collect(word, &mut slots);
        slots.into_iter().take(limit).map(|slot| source.rows.row(slot).to_vec()).collect()
    }

    pub(super) fn source<'a>(
        &'a self,
        relation: RelationId,
        index: Option<&'a Arc<KeptIndex>>,
        columns: Option<&'a [Expr]>,
        view: View,
    ) -> KeptSource<'a> {
        let edit = &self.edits[relation.index()];
        let hidden = match view {
            View::Before => &edit.added,
            View::After => &edit.removed,
        };
        let hidden = (!hidden.is_empty()).then_some(hidden);
        KeptSource { rows: &*self.rows[relation.index()], index, columns, hidden }
    }

    /// Runs a provided plan from the given registers; `delta` holds the rows of each growing source, turned as the
    /// plan asks for.
    pub(super) fn run(
        &mut self,
        plan: &Plan,
        view: View,
        delta: &[Option<SharedRows>],
        registers: &mut [Word],
        goal: &mut dyn Goal,
    ) -> bool {
        let mut words = std::mem::take(&mut self.words);
        let mut sources = Vec::with_capacity(plan.requests.len());
        for (n, request) in plan.requests.iter().enumerate() {
            sources.push(match request {
                Request::Whole(relation) => Source::Kept(self.source(*relation, None, None, view)),
                Request::Index { relation, key, columns } => {
                    let known = self.indexes[relation.index()].iter().find(|k| k.key == *key);
                    debug_assert!(known.is_some() || is_natural(key));
                    Source::Kept(self.source(*relation, known, Some(columns), view))
                }
                Request::Growing { .. } => {
                    let rows = delta.get(n).and_then(Option::as_ref);
                    Source::Rows(rows.map(|rows| &**rows as &dyn RowSet).into_iter().collect())
                }
            });
        }
        let found = run(&plan.steps, &sources, registers, &mut words, &Watch::unlimited(), goal);
        drop(sources);
        self.words = words;
        found
    }

    /// Whether a row holds in a view.
    pub(super) fn holds(&self, relation: RelationId, row: &[Word], view: View) -> bool {
        let edit = &self.edits[relation.index()];
        let hidden = match view {
            View::Before => &edit.added,
            View::After => &edit.removed,
        };
        self.rows[relation.index()].find(row).is_some_and(|slot| !hidden.contains(&slot))
    }

    /// Puts a row into the view after; false when it was there.
    pub(super) fn add(&mut self, relation: RelationId, row: &[Word]) -> bool {
        let at = relation.index();
        if let Some(slot) = self.rows[at].find(row) {
            return self.edits[at].removed.remove(&slot);
        }
        let slot = self.rows[at].insert(row).expect("it was not found");
        self.edits[at].added.insert(slot);
        if slot as usize >= self.rows[at].base().len() {
            self.indexes[at]
                .iter_mut()
                .for_each(|i| Arc::make_mut(i).insert(row, slot, &mut self.words));
        }
        true
    }

    /// Takes a row out of the view after; false when it was not there.
    pub(super) fn take(&mut self, relation: RelationId, row: &[Word]) -> bool {
        let at = relation.index();
        let Some(slot) = self.rows[at].find(row) else { return false };
        if self.edits[at].added.remove(&slot) {
            self.purge(relation, slot);
            return true;
        }
        self.edits[at].removed.insert(slot)
    }

    fn purge(&mut self, relation: RelationId, slot: Slot) {
        let at = relation.index();
        let row = self.rows[at].row(slot).to_vec();
        self.rows[at].remove(&row);
        if slot as usize >= self.rows[at].base().len() {
            self.indexes[at]
                .iter_mut()
                .for_each(|i| Arc::make_mut(i).remove(&row, slot, &mut self.words));
        }
    }

    /// Ends the update: the view after is what is there. True when indexes were dropped, so that plans must ask for
    /// them again.
    pub(super) fn commit(&mut self) -> bool {
        let mut dropped = false;
        for n in 0..self.rows.len() {
            let edit = std::mem::take(&mut self.edits[n]);
            edit.removed.into_iter().for_each(|slot| self.purge(RelationId(n as u32), slot));
            if self.rows[n].is_fragmented() {
                self.rows[n].consolidate();
                self.indexes[n].clear();
                dropped = true;
                self.distinct[n].iter_mut().for_each(|known| *known = OnceLock::new());
            }
        }
        dropped
    }

    /// Ends the update: the view before is what is there.
    pub(super) fn roll_back(&mut self) {
        for n in 0..self.rows.len() {
            let edit = std::mem::take(&mut self.edits[n]);
            edit.added.into_iter().for_each(|slot| self.purge(RelationId(n as u32), slot));
        }
    }

    /// All rows of the view after.
    pub(super) fn shared(&self, relation: RelationId) -> SharedRows {
        let (rows, edit) = (&self.rows[relation.index()], &self.edits[relation.index()]);
        if edit.removed.is_empty() {
            return rows.rows();
        }
        let mut without = rows.clone();
        for slot in &edit.removed {
            without.remove(rows.row(*slot));
        }
        without.rows()
    }
}

impl Statistics for Kept {
    fn size(&self, relation: RelationId) -> f64 {
        self.rows[relation.index()].len().max(1) as f64
    }

    fn distinct(&self, relation: RelationId, column: usize) -> f64 {
        let known = &self.distinct[relation.index()][column];
        *known.get_or_init(|| distinct(&*self.rows[relation.index()].base(), column))
    }
}

fn is_natural(key: &[Expr]) -> bool {
    key.iter().enumerate().all(|(n, part)| *part == Expr::Variable(n as u32))
}
