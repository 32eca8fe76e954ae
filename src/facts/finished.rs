//! The relations that are derived already, their indexes, and what plans ask of their sizes.

use std::cell::{Ref, RefCell};
use std::collections::HashMap;
use std::rc::Rc;
use std::sync::Arc;

use super::index::Index;
use super::limits::Watch;
use super::plan::{Plan, Request, Statistics, UNKNOWN_SHARE};
use super::program::Expr;
use super::relations::RelationId;
use super::rows::{RowSet, SharedRows, distinct};
use super::run::{Goal, Plain, Source, run};
use super::slots::KeptIndex;
use super::step::Step;
use super::word::{Word, Words};

/// Relations that an evaluation reads and does not hold.
pub(super) trait Outside: Statistics {
    fn has(&self, relation: RelationId) -> bool;
    fn index(&self, request: &Request) -> Option<Arc<KeptIndex>>;
    fn source<'s>(&'s self, request: &'s Request, index: Option<&'s Arc<KeptIndex>>) -> Source<'s>;
}

/// Indexes by relation and key.
pub(super) type Indexes = HashMap<(RelationId, Vec<Expr>), Arc<Index>>;

/// Finished relations, and what is known and built about them.
pub(super) struct Finished<'a> {
    /// Where relations are read that are not held here.
    pub(super) outside: Option<&'a dyn Outside>,
    pub(super) words: Words,
    pub(super) rows: Vec<Option<SharedRows>>,
    pub(super) indexes: Indexes,
    pub(super) watch: Rc<Watch>,
    distinct: RefCell<HashMap<(RelationId, usize), f64>>,
}

impl Finished<'_> {
    pub(super) fn new(words: Words, rows: Vec<Option<SharedRows>>, watch: Rc<Watch>) -> Self {
        let indexes = HashMap::new();
        Self { outside: None, words, rows, indexes, watch, distinct: RefCell::default() }
    }

    /// Where a relation is read that is not held here.
    fn outside(&self, relation: RelationId) -> Option<&'_ dyn Outside> {
        self.outside.filter(|outside| outside.has(relation))
    }

    /// Memory held by relations and indexes, near enough.
    pub(super) fn bytes(&self) -> usize {
        let rows: usize = self.rows.iter().flatten().map(|rows| rows.bytes()).sum();
        rows + self.indexes.values().map(|index| index.bytes()).sum::<usize>()
    }

    pub(super) fn relation(&self, relation: RelationId) -> &dyn RowSet {
        self.rows[relation.index()].as_deref().expect("strata come after those they read")
    }

    /// What a provided plan reads of the relations held here, for other threads; none for what is still growing.
    pub(super) fn plain(&self, plan: &Plan) -> Vec<Option<Plain<'_>>> {
        let of = |request: &Request| match request {
            Request::Growing { .. } => None,
            Request::Whole(relation) => Some(Plain::Rows(vec![self.relation(*relation)])),
            Request::Index { relation, key, .. } => {
                let index = self.indexes.get(&(*relation, key.clone()));
                Some(Plain::Index(index.expect("a provided plan has its indexes")))
            }
        };
        plan.requests.iter().map(of).collect()
    }

    /// Builds the indexes that a plan asks for, and points the plan's scans to their columns.
    pub(super) fn provide(&mut self, plan: &mut Plan) {
        let threads = self.watch.threads();
        let mut places: Vec<Option<Vec<usize>>> = Vec::with_capacity(plan.requests.len());
        for request in &plan.requests {
            let Request::Index { relation, key, columns } = request else {
                places.push(None);
                continue;
            };
            if self.outside(*relation).is_some() {
                places.push(None);
                continue;
            }
            let rows =
                self.rows[relation.index()].as_deref().expect("strata come after those they read");
            let entry = self.indexes.entry((*relation, key.clone()));
            let words = &mut self.words;
            let index = entry.or_insert_with(|| Arc::new(Index::new(rows, key, words, threads)));
            if index.places(columns).is_none() {
                // What other threads read as well is copied.
                Arc::make_mut(index).add(rows, columns, words, threads);
            }
            places.push(index.places(columns));
        }
        for step in &mut plan.steps {
            let Step::Scan(scan) = step else { continue };
            let Some(place) = &places[scan.source] else { continue };
            scan.loads.iter_mut().for_each(|(column, _)| *column = place[*column]);
            scan.same.iter_mut().for_each(|(column, _)| *column = place[*column]);
            scan.filters.iter_mut().for_each(|filter| filter.column = place[filter.column]);
        }
    }

    /// Runs a provided plan from the given registers.
    pub(super) fn run(
        &mut self,
        plan: &Plan,
        growing: &[Vec<Ref<'_, dyn RowSet>>],
        registers: &mut [Word],
        goal: &mut dyn Goal,
    ) -> bool {
        self.with_sources(plan, growing, |sources, words, watch| {
            run(&plan.steps, sources, registers, words, watch, goal)
        })
    }

    /// Does something with what a provided plan reads.
    pub(super) fn with_sources<R>(
        &mut self,
        plan: &Plan,
        growing: &[Vec<Ref<'_, dyn RowSet>>],
        f: impl FnOnce(&[Source<'_>], &mut Words, &Watch) -> R,
    ) -> R {
        let outside = |request: &Request| match request {
            Request::Whole(relation) | Request::Index { relation, .. } => {
                self.outside.filter(|outside| outside.has(*relation))
            }
            Request::Growing { .. } => None,
        };
        let indexes: Vec<_> = plan
            .requests
            .iter()
            .map(|request| outside(request).and_then(|outside| outside.index(request)))
            .collect();
        let mut sources = Vec::with_capacity(plan.requests.len());
        for ((request, parts), index) in plan.requests.iter().zip(growing).zip(&indexes) {
            if let Some(outside) = outside(request) {
                sources.push(outside.source(request, index.as_ref()));
                continue;
            }
            sources.push(match request {
                Request::Whole(relation) => {
                    let rows = self.rows[relation.index()].as_deref();
                    let rows: &dyn RowSet = rows.expect("strata come after those they read");
                    Source::Rows(vec![rows])
                }
                Request::Index { relation, key, .. } => {
                    let index = self.indexes.get(&(*relation, key.clone()));
                    Source::Index(index.expect("a provided plan has its indexes"))
                }
                Request::Growing { .. } => Source::Rows(parts.iter().map(|part| &**part).collect()),
            });
        }
        f(&sources, &mut self.words, &self.watch)
    }
}

impl Statistics for Finished<'_> {
    fn computes_keys(&self) -> bool {
        self.outside.is_none()
    }

    fn fan_out(&self, relation: RelationId, columns: &[usize]) -> Option<f64> {
        self.outside(relation).and_then(|outside| outside.fan_out(relation, columns))
    }

    fn size(&self, relation: RelationId) -> f64 {
        if let Some(outside) = self.outside(relation) {
            return outside.size(relation);
        }
        // A relation that is still growing may become large.
        self.rows[relation.index()].as_ref().map_or(1e6, |rows| rows.len().max(1) as f64)
    }

    fn distinct(&self, relation: RelationId, column: usize) -> f64 {
        if let Some(outside) = self.outside(relation) {
            return outside.distinct(relation, column);
        }
        if self.rows[relation.index()].is_none() {
            return 1e3;
        }
        let mut known = self.distinct.borrow_mut();
        *known
            .entry((relation, column))
            .or_insert_with(|| distinct(self.relation(relation), column))
    }

    fn share(
        &self,
        relation: RelationId,
        column: usize,
        holds: &dyn Fn(Word, &Words) -> bool,
    ) -> f64 {
        if let Some(outside) = self.outside(relation) {
            return outside.share(relation, column, holds);
        }
        let Some(rows) = self.rows[relation.index()].as_deref() else { return UNKNOWN_SHARE };
        share(rows, column, &|word| holds(word, &self.words))
    }
}

/// The share of rows whose column's word holds, estimated from a sample.
pub(super) fn share(rows: &dyn RowSet, column: usize, holds: &dyn Fn(Word) -> bool) -> f64 {
    const SAMPLE: usize = 512;
    let step = rows.len().div_ceil(SAMPLE).max(1);
    let (mut all, mut held) = (0, 0);
    for at in (0..rows.len()).step_by(step) {
        all += 1;
        held += usize::from(holds(rows.row(at)[column]));
    }
    // A sample that misses the few that hold does not show that there are none.
    (held as f64 + 0.5) / (f64::from(all) + 1.0)
}
