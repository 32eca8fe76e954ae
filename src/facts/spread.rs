//! A join divided among threads: each takes some of the rows that it starts with.
//!
//! A rule's first scan runs over rows one after the other, and what one of them leads to asks nothing of the others. So
//! the first rows are joined as ever; when what is left would take long, it is cut into pieces, and each thread takes the
//! next piece until none is left.
//!
//! Result and order are those of one thread. Relations are sets that are sorted when a rule, or a round, is over. New
//! words are what an order could show in: large numbers are named by each thread for itself and named anew at the end,
//! piece by piece in the order of the rows, as one thread would have met them. A rule that makes texts or records, counts
//! with `autoinc()`, chooses or subsumes runs in one thread.

use std::cell::Ref;
use std::ops::Range;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::{Duration, Instant};

use super::finished::Finished;
use super::head::Head;
use super::limits::Watch;
use super::plan::{Plan, Request};
use super::program::{Clause, Expr, Literal, Program};
use super::rows::RowSet;
use super::run::{Plain, Source, extent, run, run_window};
use super::shares::shared_out;
use super::sink::{Branch, Rename, Sink, Taken};
use super::step::Step;
use super::syntax::Functor;
use super::word::{LARGE, Note, Word, Words};

/// What words a rule may make that were not there.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Makes {
    Nothing,
    Numbers,
    /// Texts, records, or what follows from the order of words.
    Any,
}

impl Makes {
    pub(super) fn of(clause: &Clause) -> Self {
        let args = clause.args.iter().map(Self::of_expr).max().unwrap_or(Self::Nothing);
        args.max(Self::of_body(&clause.body))
    }

    fn of_body(body: &[Literal]) -> Self {
        let of_literal = |literal: &Literal| match literal {
            Literal::Atom(_) | Literal::Not(_) => Self::Nothing,
            Literal::Compare(compare) => {
                Self::of_expr(&compare.left).max(Self::of_expr(&compare.right))
            }
            Literal::Range(range) => {
                range.bounds.exprs().map(Self::of_expr).fold(Self::Numbers, Self::max)
            }
            Literal::Aggregate(aggregate) => {
                let value = aggregate.value.as_ref().map_or(Self::Nothing, Self::of_expr);
                Self::Numbers.max(value).max(Self::of_body(&aggregate.body))
            }
        };
        body.iter().map(of_literal).max().unwrap_or(Self::Nothing)
    }

    fn of_expr(expr: &Expr) -> Self {
        let Expr::Call(functor, args) = expr else { return Self::Nothing };
        let own = match functor {
            Functor::Counter | Functor::Ordinal | Functor::Record => Self::Any,
            Functor::Field => Self::Nothing,
            other if other.result().is_number() => Self::Numbers,
            _ => Self::Any,
        };
        args.iter().map(Self::of_expr).fold(own, Self::max)
    }
}

/// What is to be joined.
pub(super) struct Join<'a> {
    pub(super) program: &'a Program,
    pub(super) clause: &'a Clause,
    pub(super) plan: &'a Plan,
    /// No rule of the stratum makes words, so that the order of new rows within a round shows in nothing.
    pub(super) is_any_order: bool,
    /// Solutions at most.
    pub(super) limit: usize,
}

/// Fewer rows are not worth a look at the clock: in rounds of some hundred rows the looks were a tenth of the time.
const MIN_ROWS: usize = 512;
/// Rows that are joined before it is asked whether the rest is worth a thread.
const FIRST_ROWS: usize = 256;
/// Fewer rows are looked at in fewer parts: a part more costs about half a microsecond.
const MANY: usize = 1 << 13;
const FEW_PIECES: usize = 4;
/// Pieces for each thread: rows may differ much in what they lead to.
const PIECES: usize = 16;

impl Join<'_> {
    /// Joins, in several threads where that pays.
    pub(super) fn run(
        &self,
        finished: &mut Finished<'_>,
        parts: &[Vec<Ref<'_, dyn RowSet>>],
        sink: &mut dyn Sink,
    ) {
        let mut registers = vec![0; self.clause.variables.len()];
        finished.with_sources(self.plan, parts, |sources, words, watch| {
            let window = extent(&self.plan.steps, sources, &mut registers, words, watch);
            let is_worth = |window: &Range<usize>| {
                window.len() >= least_rows(self.plan) || watch.limits().spread_from.is_zero()
            };
            let Some(Range { start, end }) = window.filter(is_worth) else {
                let mut head = Head::new(self.program, self.clause, self.limit, sink, watch);
                run(&self.plan.steps, sources, &mut registers, words, watch, &mut head);
                return;
            };
            let (begun, all) = (Instant::now(), end - start);
            let mut done = 0;
            while done < all && !watch.is_over() {
                if let Some(wave) = wave_of(watch, begun.elapsed(), done, all) {
                    let to = all.min(done + wave);
                    let rows = start + done..start + to;
                    if self.spread(sources, words, watch, &registers, rows, sink) {
                        done = to;
                        continue;
                    }
                }
                // A part at a time: another thread may come free.
                let most = all.div_ceil(if all < MANY { FEW_PIECES } else { PIECES });
                let more = done.clamp(FIRST_ROWS, most.max(FIRST_ROWS));
                let to = all.min(done + more);
                let mut head = Head::new(self.program, self.clause, self.limit, sink, watch);
                let steps = &self.plan.steps;
                run_window(
                    steps,
                    sources,
                    &mut registers,
                    words,
                    watch,
                    &mut head,
                    start + done..start + to,
                );
                if all >= MANY && done < all / PIECES && to >= all / PIECES {
                    // A little more than it seems: room that is never written to costs nothing.
                    sink.expect(sink.len().saturating_mul(all - to) / to * 5 / 4);
                }
                done = to;
            }
        });
    }

    /// False where the sink has no branches.
    fn spread(
        &self,
        sources: &[Source<'_>],
        words: &mut Words,
        watch: &Watch,
        registers: &[Word],
        rows: Range<usize>,
        sink: &mut dyn Sink,
    ) -> bool {
        let threads = watch.threads().min(rows.len());
        let branches: Option<Vec<_>> =
            (0..threads).map(|_| sink.branch(self.is_any_order)).collect();
        let plain: Option<Vec<_>> = sources.iter().map(Plain::of).collect();
        let (Some(branches), Some(plain)) = (branches, plain) else { return false };
        words.consolidate();
        let known = words.share();
        let pieces = Pieces::new(rows, threads * PIECES);
        let shares = branches.into_iter().map(|branch| (branch, watch.branch()));
        let done: Vec<Done> = shared_out(shares, |(branch, watch)| {
            let (words, registers) = (known.share(), registers.to_vec());
            self.work(&plain, words, registers, &watch.watch(), &pieces, branch)
        });
        self.gather(done, words, pieces.count, sink);
        true
    }

    /// One thread's part.
    fn work(
        &self,
        sources: &[Plain<'_>],
        mut words: Words,
        mut registers: Vec<Word>,
        watch: &Watch,
        pieces: &Pieces,
        mut branch: Box<dyn Branch + '_>,
    ) -> Done {
        let sources: Vec<Source<'_>> = sources.iter().map(Plain::source).collect();
        let shared_bytes = words.bytes();
        let mut taken = Vec::new();
        let mut before = 0;
        while let Some((number, window)) = pieces.next().filter(|_| !watch.is_over()) {
            let head = Head::new(self.program, self.clause, self.limit, &mut *branch, watch);
            let (steps, mut head) = (&self.plan.steps, head.beside(shared_bytes));
            run_window(steps, &sources, &mut registers, &mut words, watch, &mut head, window);
            let (numbers, note) = (words.own_numbers().len(), words.take_note());
            taken.push(PieceDone { number, rows: before..branch.len(), numbers, note });
            before = branch.len();
        }
        Done { rows: branch.taken(), words, pieces: taken }
    }

    /// Brings the threads' rows together, and names what they have named.
    fn gather(&self, done: Vec<Done>, words: &mut Words, pieces: usize, sink: &mut dyn Sink) {
        let mut by_number: Vec<Option<(usize, usize)>> = vec![None; pieces];
        for (thread, done) in done.iter().enumerate() {
            for (n, piece) in done.pieces.iter().enumerate() {
                by_number[piece.number] = Some((thread, n));
            }
        }
        let mut names: Vec<Vec<Word>> = vec![Vec::new(); done.len()];
        let mut in_order = Vec::with_capacity(pieces);
        for (thread, n) in by_number.into_iter().flatten() {
            let (of, names) = (&done[thread], &mut names[thread]);
            let piece = &of.pieces[n];
            in_order.push((thread, piece.rows.clone()));
            let new = &of.words.own_numbers()[names.len()..piece.numbers];
            names.extend(new.iter().map(|number| words.number(*number)));
            piece.note.into_iter().for_each(|note| words.note(note));
        }
        let columns = &self.program.info(self.clause.head).columns;
        let is_number: Vec<bool> = columns.iter().map(|column| column.kind.is_number()).collect();
        let first: Vec<usize> =
            done.iter().map(|done| LARGE as usize + done.words.shared_numbers()).collect();
        let rename = |thread: usize, row: &mut [Word]| {
            for (word, _) in row.iter_mut().zip(&is_number).filter(|(_, is_number)| **is_number) {
                let at = (*word as usize).checked_sub(first[thread]);
                let named = at.and_then(|at| names[thread].get(at));
                *word = named.copied().unwrap_or(*word);
            }
        };
        let rename: &Rename<'_> = &rename;
        let has_names = names.iter().any(|names| !names.is_empty());
        let rows = done.into_iter().map(|done| done.rows).collect();
        sink.absorb(rows, &in_order, has_names.then_some(rename));
    }
}

/// Rows to be joined at once in several threads, to judge by what is done; none while the rest is not worth it. What a
/// wave finds is copied, so no wave is more than a small part of a long join; and the first rows may be slower than the rest.
fn wave_of(watch: &Watch, spent: Duration, done: usize, all: usize) -> Option<usize> {
    const MAX_WAVES: usize = 8;
    let from = watch.limits().spread_from;
    if watch.threads() < 2 {
        return None;
    }
    let left = all - done;
    let rest = spent.mul_f64(left as f64 / done.max(1) as f64);
    if !from.is_zero() && (done == 0 || rest < from) {
        return None;
    }
    let short = rest < 8 * from && done >= all / MAX_WAVES;
    Some(if short { left } else { left.min(all.div_ceil(MAX_WAVES)) })
}

/// What a thread leaves.
struct Done {
    rows: Taken,
    words: Words,
    pieces: Vec<PieceDone>,
}

struct PieceDone {
    number: usize,
    /// In the order in which the thread found them.
    rows: Range<usize>,
    /// Large numbers that the thread had named when the piece was done.
    numbers: usize,
    note: Option<Note>,
}

/// Rows in pieces, to be taken one by one.
struct Pieces {
    rows: Range<usize>,
    size: usize,
    count: usize,
    next: AtomicUsize,
}

impl Pieces {
    fn new(rows: Range<usize>, pieces: usize) -> Self {
        let size = rows.len().div_ceil(pieces.max(1)).max(1);
        Self { count: rows.len().div_ceil(size), rows, size, next: AtomicUsize::new(0) }
    }

    fn next(&self) -> Option<(usize, Range<usize>)> {
        let number = self.next.fetch_add(1, Ordering::Relaxed);
        let from = self.rows.start + number.checked_mul(self.size)?;
        let to = self.rows.end.min(from + self.size);
        (number < self.count).then_some((number, from..to))
    }
}

/// Whether a plan's join may begin with so many rows that a look at the clock is worth it, by all rows of what it scans first.
pub(super) fn may_be_long(
    plan: &Plan,
    finished: &Finished<'_>,
    parts: &[Vec<Ref<'_, dyn RowSet>>],
) -> bool {
    let Some(Step::Scan(scan)) = plan.steps.first() else { return false };
    let rows = match &plan.requests[scan.source] {
        Request::Growing { .. } => parts[scan.source].iter().map(|rows| rows.len()).sum(),
        Request::Whole(relation) | Request::Index { relation, .. } => {
            finished.rows[relation.index()].as_ref().map_or(usize::MAX, |rows| rows.len())
        }
    };
    rows >= least_rows(plan) || finished.watch.limits().spread_from.is_zero()
}

/// Fewer rows are not worth a look at the clock: more where a row leads to no others.
fn least_rows(plan: &Plan) -> usize {
    let leads_on = |step: &Step| matches!(step, Step::Scan(_) | Step::Each { .. });
    if plan.steps.iter().skip(1).any(leads_on) { MIN_ROWS } else { MANY }
}

/// Whether a plan's join can be divided at all.
pub(super) fn can_spread(plan: &Plan) -> bool {
    matches!(plan.steps.first(), Some(Step::Scan(scan)) if !scan.once)
}
