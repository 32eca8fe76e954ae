//! Strata that read nothing of each other, evaluated at the same time: each thread takes the next one.
//!
//! Result, order and names are those of one thread. A stratum names large numbers for itself, and they are named anew
//! at the end, stratum by stratum, as one thread would have met them; where it goes through rows in an order that
//! such names make, it is evaluated once more instead. Strata whose rules make texts or records are evaluated alone.
//! What the strata read is shared: their indexes are made before, each in a thread of its own. A join goes on in more
//! threads once others have nothing left to do.

use std::collections::HashMap;
use std::ops::Range;
use std::rc::Rc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::{Arc, Mutex};

use super::evaluate::{EvaluateError, Evaluation, own_atoms};
use super::finished::{Finished, Indexes};
use super::fixpoint::versions;
use super::growing::Version;
use super::index::Index;
use super::limits;
use super::plan::{Plan, Request};
use super::program::{Clause, Expr, Program, Stratum};
use super::relations::RelationId;
use super::rows::{SharedRows, heap};
use super::shares::shared_out;
use super::spread::Makes;
use super::strata::reads;
use super::syntax::Span;
use super::word::{LARGE, Note, Word, Words};
use crate::units::InOrder as _;

/// Fewer rows read are not worth a thread.
const MANY: usize = 1 << 14;

impl Program {
    /// Runs of strata that read nothing of each other.
    pub(super) fn waves(&self) -> Vec<Range<usize>> {
        let mut waves: Vec<Range<usize>> = Vec::new();
        // The wave that each relation is derived in.
        let mut wave_of = vec![usize::MAX; self.relations.len()];
        for (n, stratum) in self.strata.iter().enumerate() {
            let now = waves.len().wrapping_sub(1);
            let mut is_beside = !waves.is_empty();
            self.each_read(stratum, &mut |relation| {
                let is_own = stratum.relations.contains(&relation);
                is_beside &= is_own || wave_of[relation.index()] != now;
            });
            match waves.last_mut().filter(|_| is_beside) {
                Some(wave) => wave.end = n + 1,
                None => waves.push(n..n + 1),
            }
            let now = waves.len() - 1;
            stratum.relations.iter().for_each(|relation| wave_of[relation.index()] = now);
        }
        waves
    }

    fn each_read(&self, stratum: &Stratum, f: &mut impl FnMut(RelationId)) {
        let clauses = stratum.clauses.iter().map(|n| &*self.clauses[*n]);
        let subsuming = stratum.subsumptions.iter().map(|n| &self.subsumptions[*n].clause);
        for clause in clauses.chain(subsuming) {
            reads(&clause.body, false, &mut |relation, _, _| f(relation));
        }
    }

    /// Whether a stratum makes no words but numbers.
    fn is_plain(&self, stratum: &Stratum) -> bool {
        let clauses = stratum.clauses.iter().map(|n| &*self.clauses[*n]);
        let subsuming = stratum.subsumptions.iter().map(|n| &self.subsumptions[*n].clause);
        clauses.chain(subsuming).all(|clause| Makes::of(clause) != Makes::Any)
    }
}

impl Evaluation<'_> {
    /// Evaluates strata that read nothing of each other.
    pub(super) fn wave(&mut self, strata: &[Stratum]) -> Result<(), EvaluateError> {
        let mut rest = strata;
        while !rest.is_empty() {
            let plain = rest.iter().take_while(|stratum| self.program.is_plain(stratum)).count();
            let (near, far) = rest.split_at(plain.max(1));
            rest = far;
            match self.pays(near) {
                true => self.abreast(near)?,
                false => near.iter().try_for_each(|stratum| self.stratum(stratum))?,
            }
        }
        Ok(())
    }

    /// Whether several threads are sooner done with the strata.
    fn pays(&self, strata: &[Stratum]) -> bool {
        let limits = self.finished.watch.limits();
        let derive = strata.iter().filter(|stratum| !stratum.clauses.is_empty()).count();
        if limits.threads < 2 || derive < 2 || self.traced.is_some() {
            return false;
        }
        let all = self.finished.rows.iter().flatten().map(|rows| rows.len()).sum::<usize>();
        if all < MANY && !limits.spread_from.is_zero() {
            return false;
        }
        let mut read: Vec<RelationId> = Vec::new();
        for stratum in strata {
            self.program.each_read(stratum, &mut |relation| read.push(relation));
        }
        read.sort_unstable();
        read.dedup();
        let rows = read.iter().filter_map(|relation| self.finished.rows[relation.index()].as_ref());
        limits.spread_from.is_zero() || rows.map(|rows| rows.len()).sum::<usize>() >= MANY
    }

    fn abreast(&mut self, strata: &[Stratum]) -> Result<(), EvaluateError> {
        let plans: Vec<Vec<Plan>> = strata.iter().map(|stratum| self.plans(stratum)).collect();
        self.make_indexes(&plans);
        self.finished.words.consolidate();
        let shared = Shared {
            program: self.program,
            words: self.finished.words.share(),
            rows: self.finished.rows.clone(),
            indexes: self.finished.indexes.clone(),
            given: self.given.clone(),
        };
        let (next, has_failed) = (AtomicUsize::new(0), AtomicBool::new(false));
        let watch = &self.finished.watch;
        let threads = watch.limits().threads.min(strata.len());
        let branches = (0..threads).map(|_| watch.branch());
        let done: Vec<Vec<Done>> =
            shared_out(branches, |branch| shared.work(strata, &next, &has_failed, branch));
        drop(shared);
        self.finished.watch.kept_is_held();
        let mut done: Vec<Done> = done.into_iter().flatten().collect();
        done.order_by_key(|done| done.stratum);
        done.into_iter().try_for_each(|done| {
            let n = done.stratum;
            self.take(&strata[n], done, goes_by_given_order(&plans[n]))
        })
    }

    /// Takes what a stratum derived, its numbers named as one thread would have named them.
    fn take(
        &mut self,
        stratum: &Stratum,
        done: Done,
        keeps_order: bool,
    ) -> Result<(), EvaluateError> {
        let Done { rows, numbers, first, notes, .. } = done;
        let rows = rows?;
        let is_first = LARGE + self.finished.words.large_numbers() as Word == first;
        if !numbers.is_empty() && !is_first && !keeps_order {
            return self.stratum(stratum);
        }
        let names: Vec<Word> =
            numbers.iter().map(|number| self.finished.words.number(*number)).collect();
        let is_renamed = (first..).zip(&names).any(|(own, name)| own != *name);
        for (relation, rows) in rows {
            let rows = if is_renamed { self.renamed(relation, &rows, first, &names) } else { rows };
            self.finished.rows[relation.index()] = Some(rows);
        }
        notes.into_iter().for_each(|(at, note)| self.note(at, note));
        Ok(())
    }

    fn renamed(
        &self,
        relation: RelationId,
        rows: &SharedRows,
        first: Word,
        names: &[Word],
    ) -> SharedRows {
        let columns = &self.program.info(relation).columns;
        let mut renamed = heap(columns.len());
        let mut row = vec![0; columns.len()];
        for at in 0..rows.len() {
            row.copy_from_slice(&rows.row(at)[..columns.len()]);
            for (word, _) in row.iter_mut().zip(columns).filter(|(_, of)| of.kind.is_number()) {
                let place = word.checked_sub(first).map(|place| place as usize);
                *word = place.and_then(|place| names.get(place)).copied().unwrap_or(*word);
            }
            renamed.push(&row);
        }
        renamed.sort_among(self.finished.watch.limits().threads)
    }

    /// Makes the indexes that the strata's plans ask for, where that names no number.
    fn make_indexes(&mut self, plans: &[Vec<Plan>]) {
        let mut wanted: HashMap<(RelationId, Vec<Expr>), Vec<Expr>> = HashMap::new();
        for request in plans.iter().flatten().flat_map(|plan| &plan.requests) {
            if let Request::Index { relation, key, columns } = request {
                wanted.entry((*relation, key.clone())).or_default().extend(columns.iter().cloned());
            }
        }
        let Finished { indexes, rows, words, watch, .. } = &mut self.finished;
        wanted.retain(|of, columns| {
            indexes.get(of).is_none_or(|index: &Arc<Index>| index.places(columns).is_none())
        });
        words.consolidate();
        let (known, threads) = (words.share(), watch.limits().threads);
        let tasks = wanted.into_iter().map(|(of, columns)| {
            let index = indexes.remove(&of).map(Arc::unwrap_or_clone);
            (of, columns, index)
        });
        let tasks = Mutex::new(tasks.collect::<Vec<_>>());
        let rows = &*rows;
        let next = || tasks.lock().ok().and_then(|mut tasks| tasks.pop());
        let work = |_: usize| {
            let mut made = Vec::new();
            while let Some((of, columns, index)) = next() {
                let Some(rows) = rows[of.0.index()].as_deref() else { continue };
                let mut words = known.share();
                let before = index.as_ref().map_or(0, Index::columns);
                let mut index = match index {
                    Some(index) => index,
                    None => Index::new(rows, &of.1, &mut words, threads),
                };
                let has_key = is_quiet(&known, &mut words);
                index.add(rows, &columns, &mut words, threads);
                if !is_quiet(&known, &mut words) {
                    index.leave(before);
                }
                made.extend(has_key.then_some((of, index)));
            }
            made
        };
        let made = shared_out(0..threads, work).into_iter().flatten();
        indexes.extend(made.map(|(of, index)| (of, Arc::new(index))));
    }

    /// All plans that a stratum's rules run by.
    fn plans(&self, stratum: &Stratum) -> Vec<Plan> {
        let is_own = |relation: RelationId| stratum.relations.contains(&relation);
        let mut plans = Vec::new();
        for clause in stratum.clauses.iter().map(|n| &*self.program.clauses[*n]) {
            let clause: &Clause = clause;
            let own: Vec<usize> = own_atoms(clause, &is_own).collect();
            if own.is_empty() {
                plans.push(self.plan(clause, &vec![Version::Finished; clause.body.len()], None));
            }
            let rounds = own
                .iter()
                .map(|recent| self.plan(clause, &versions(clause, &own, *recent), Some(*recent)));
            plans.extend(rounds);
        }
        plans
    }
}

/// Whether no plan goes through rows in an order that new numbers' names make: those of the stratum itself, or those
/// of an index by a computed key.
fn goes_by_given_order(plans: &[Plan]) -> bool {
    let is_given = |request: &Request| match request {
        Request::Whole(_) => true,
        Request::Index { key, .. } => key.iter().all(|part| matches!(part, Expr::Variable(_))),
        Request::Growing { .. } => false,
    };
    plans.iter().flat_map(|plan| &plan.requests).all(is_given)
}

/// Whether nothing was named, and nothing is to be told.
fn is_quiet(known: &Words, words: &mut Words) -> bool {
    words.large_numbers() == known.large_numbers() && words.take_note().is_none()
}

/// What all threads read.
struct Shared<'a> {
    program: &'a Program,
    words: Words,
    rows: Vec<Option<SharedRows>>,
    indexes: Indexes,
    given: Vec<SharedRows>,
}

/// What a stratum leaves.
struct Done {
    stratum: usize,
    rows: Result<Vec<(RelationId, SharedRows)>, EvaluateError>,
    /// Large numbers that it named, and the word of the first.
    numbers: Vec<i64>,
    first: Word,
    notes: Vec<(Span, Note)>,
}

impl Shared<'_> {
    /// One thread's strata.
    fn work(
        &self,
        strata: &[Stratum],
        next: &AtomicUsize,
        has_failed: &AtomicBool,
        branch: limits::Branch,
    ) -> Vec<Done> {
        let watch = Rc::new(branch.watch());
        let _busy = watch.busy();
        let known = self.words.large_numbers();
        let finished = Finished::new(self.words.share(), self.rows.clone(), Rc::clone(&watch));
        let mut own = Evaluation::over(self.program, finished, self.given.clone());
        let mut done = Vec::new();
        while !has_failed.load(Ordering::Relaxed) {
            let stratum = next.fetch_add(1, Ordering::Relaxed);
            let Some(of) = strata.get(stratum) else { break };
            own.finished.words = self.words.share();
            own.finished.indexes = self.indexes.clone();
            let result = own.stratum(of);
            has_failed.fetch_or(result.is_err(), Ordering::Relaxed);
            own.finished.indexes = HashMap::new();
            let rows: Vec<(RelationId, SharedRows)> = of
                .relations
                .iter()
                .filter_map(|of| Some((*of, own.finished.rows[of.index()].take()?)))
                .collect();
            watch.keep(rows.iter().map(|(_, rows)| rows.bytes()).sum());
            watch.hold(own.finished.bytes());
            done.push(Done {
                stratum,
                rows: result.map(|()| rows),
                numbers: own.finished.words.numbers().skip(known).copied().collect(),
                first: LARGE + known as Word,
                notes: own.take_notes(),
            });
        }
        done
    }
}
