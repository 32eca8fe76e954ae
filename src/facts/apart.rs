//! A recursive relation of which each thread derives a part by itself, from the first round to the last.
//!
//! Where every recursive rule hands a column on, as `path(x, z) :- path(x, y), edge(y, z).` hands on x, what follows
//! from a tuple has that tuple's word there. Tuples that differ in it never meet: they are dealt out to the threads by
//! it, no thread waits for another between rounds, and none looks at what another has found.

use std::cell::Ref;
use std::sync::atomic::{AtomicUsize, Ordering};

use datafrog::Iteration;

use super::evaluate::{EvaluateError, Evaluation};
use super::finished::Finished;
use super::growing::{self, Growing};
use super::head::Head;
use super::limits::{self, Watch};
use super::plan::{Plan, Request};
use super::program::{Clause, Expr, Literal, Program, Term};
use super::relations::RelationId;
use super::rows::{RowSet, SharedRows};
use super::run::{Plain, Source, run};
use super::shares::shared_out;
use super::sink::Taken;
use super::word::{Word, Words};

/// The column that all recursive rules of a relation hand on, if there is one; each must read the relation once.
pub(super) fn handed_on(
    relation: RelationId,
    columns: usize,
    rounds: &[(&Clause, Plan)],
) -> Option<usize> {
    let is_plain = |plan: &Plan| {
        let growing = plan.requests.iter().filter_map(|request| match request {
            Request::Growing { first, .. } => Some(first),
            _ => None,
        });
        // One atom, gone through from its first row to its last.
        plan.can_spread && growing.clone().count() == 1 && growing.clone().all(Vec::is_empty)
    };
    if rounds.is_empty() || !rounds.iter().all(|(_, plan)| is_plain(plan)) {
        return None;
    }
    let hands_on = |clause: &Clause, column: usize| {
        let Some(Expr::Variable(v)) = clause.args.get(column) else { return false };
        let mut own = clause.body.iter().filter_map(|literal| match literal {
            Literal::Atom(atom) if atom.relation == relation => Some(atom),
            _ => None,
        });
        own.next().is_some_and(|atom| atom.args[column] == Term::Variable(*v))
            && own.next().is_none()
    };
    (0..columns).find(|column| rounds.iter().all(|(clause, _)| hands_on(clause, *column)))
}

impl Evaluation<'_> {
    /// The rest of a recursive relation, each thread a part of it to the end.
    pub(super) fn apart(
        &mut self,
        relation: RelationId,
        column: usize,
        rounds: &[(&Clause, Plan)],
        rows: Box<dyn Growing>,
    ) -> Result<(), EvaluateError> {
        let apart = Apart { program: self.program, relation, column, rounds };
        let limit = self.finished.watch.limits().rows;
        match apart.run(&mut self.finished, rows) {
            Ok(rows) => {
                self.finished.rows[relation.index()] = Some(rows);
                Ok(())
            }
            Err(unfinished) => rounds.first().map_or(Ok(()), |(clause, _)| match unfinished {
                Unfinished::Rows => Err(self.program.too_many(clause, limit)),
                Unfinished::Limit => self.check_limits(clause),
            }),
        }
    }
}

/// Why a relation was not derived to its end.
enum Unfinished {
    /// The watch says which limit was reached.
    Limit,
    /// It outgrew the rows that it may have.
    Rows,
}

struct Apart<'a> {
    program: &'a Program,
    relation: RelationId,
    column: usize,
    rounds: &'a [(&'a Clause, Plan)],
}

impl Apart<'_> {
    /// Derives the rest of a relation that has new rows.
    fn run(
        &self,
        finished: &mut Finished<'_>,
        rows: Box<dyn Growing>,
    ) -> Result<SharedRows, Unfinished> {
        let (limits, threads) = (finished.watch.limits(), finished.watch.threads());
        finished.words.consolidate();
        let words = finished.words.share();
        let sources: Vec<_> = self.rounds.iter().map(|(_, plan)| finished.plain(plan)).collect();
        let base = finished.bytes();
        let known = AtomicUsize::new(rows.len());
        let parts = rows.split(self.column, threads).into_iter();
        let parts = parts.map(|part| (part, finished.watch.branch()));
        let done = shared_out(parts, |(part, branch): (Taken, limits::Branch)| {
            self.part(part, &sources, words.share(), &branch.watch(), base, &known)
        });
        let done: Option<Vec<Taken>> = done.into_iter().collect();
        let total = known.load(Ordering::Relaxed);
        finished.watch.found(total);
        let columns = self.program.info(self.relation).columns.len();
        finished.watch.hold(base + total * columns * size_of::<Word>());
        match done {
            _ if total > limits.rows => Err(Unfinished::Rows),
            _ if finished.watch.is_over() => Err(Unfinished::Limit),
            Some(done) => Ok(rows.put_together(done, threads)),
            None => Err(Unfinished::Limit),
        }
    }

    /// One thread's part, from its own rows to all that follows from them; none where a limit was reached.
    fn part(
        &self,
        part: Taken,
        sources: &[Vec<Option<Plain<'_>>>],
        mut words: Words,
        watch: &Watch,
        base: usize,
        known: &AtomicUsize,
    ) -> Option<Taken> {
        let limits = watch.limits();
        let info = self.program.info(self.relation);
        let mut iteration = Iteration::new();
        let mut rows = growing::growing(&mut iteration, &info.name, info.columns.len());
        rows.seed(part);
        let shared_bytes = words.bytes();
        let mut counted = rows.len();
        loop {
            watch.hold(base + rows.bytes() * limits.threads);
            for ((clause, plan), sources) in self.rounds.iter().zip(sources) {
                let recent = rows.recent(0);
                let sources: Vec<Source<'_>> =
                    sources.iter().map(|plain| source(plain.as_ref(), &recent)).collect();
                let mut registers = vec![0; clause.variables.len()];
                let mut sink = rows.sink();
                let head = Head::new(self.program, clause, usize::MAX, &mut *sink, watch);
                let mut head = head.beside(shared_bytes);
                run(&plan.steps, &sources, &mut registers, &mut words, watch, &mut head);
            }
            rows.flush();
            let is_done = !iteration.changed();
            let len = rows.len();
            let more = len.saturating_sub(counted);
            let total = known.fetch_add(more, Ordering::Relaxed) + more;
            counted = len;
            if watch.is_over() || total > limits.rows {
                return None;
            }
            if is_done {
                return Some(rows.finish());
            }
        }
    }
}

/// What a thread reads: what all share, or the new rows of its own part.
fn source<'a>(plain: Option<&Plain<'a>>, recent: &'a [Ref<'_, dyn RowSet>]) -> Source<'a> {
    let rows = || Source::Rows(recent.iter().map(|rows| &**rows).collect());
    plain.map_or_else(rows, Plain::source)
}
