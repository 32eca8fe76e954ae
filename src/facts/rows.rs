//! Rows of words, their sets, and the variables that grow by them: datafrog's, at a width chosen at run time.
//!
//! datafrog's relations are generic over the tuple; here the tuple is a [`Row`] of one of a few widths,
//! and [`RowSet`] and [`Growing`] are what the rest of the engine sees of any width.

use std::any::Any;
use std::cell::{Ref, RefCell, RefMut};
use std::collections::HashSet;
use std::ops::Range;
use std::sync::Arc;

use datafrog::{Iteration, Relation, Variable};

use super::beside::Beside;
use super::row::Row;
use super::seen::Seen;
use super::sorting::{sort_runs, sorted, subtract};
use super::stored::{Stored, StoredRows};
use super::together::{Part, gathered, joined};
use super::word::Word;

/// What an atom of the body ranges over.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Version {
    /// A finished relation.
    Finished,
    /// A relation of the stratum under evaluation: rows of the last round.
    Recent,
    /// Rows from before the last round.
    Stable,
    /// Both.
    All,
}

/// Runs an expression with the constant `$n` set to the width that holds `$columns` columns.
macro_rules! at_width {
    ($columns:expr, $n:ident => $body:expr) => {
        at_width!(@arms $columns, $n, $body, 0..=1 => 1, 2 => 2, 3 => 3, 4 => 4, 5 => 5, 6 => 6, 7..=8 => 8,
            9..=16 => 16, _ => 32)
    };
    (@arms $columns:expr, $n:ident, $body:expr, $($columns_of:pat => $width:literal),+) => {
        match $columns {
            $($columns_of => { const $n: usize = $width; $body })+
        }
    };
}

pub(super) use at_width;

/// Distinct rows in ascending order.
pub(super) trait RowSet: Send + Sync {
    fn len(&self) -> usize;
    fn row(&self, at: usize) -> &[Word];
    /// Memory held.
    fn bytes(&self) -> usize;
    /// One column of all rows.
    fn column(&self, column: usize) -> Vec<Word>;
    /// The rows that start with the key.
    fn range(&self, key: &[Word]) -> Range<usize>;
    /// The first place in a range whose column holds at least the word; within the range the column ascends.
    fn bound(&self, range: Range<usize>, column: usize, word: Word) -> usize;

    /// The same rows, to be edited.
    fn stored(self: Arc<Self>) -> Box<dyn Stored>;
}

/// A set of rows that evaluations share.
pub(super) type SharedRows = Arc<dyn RowSet + Send + Sync>;

impl<const N: usize> RowSet for Relation<Row<N>> {
    fn len(&self) -> usize {
        self.elements.len()
    }

    fn row(&self, at: usize) -> &[Word] {
        &self.elements[at].0
    }

    fn bytes(&self) -> usize {
        size_of_val(self.elements.as_slice())
    }

    fn column(&self, column: usize) -> Vec<Word> {
        self.elements.iter().map(|row| row.0[column]).collect()
    }

    fn range(&self, key: &[Word]) -> Range<usize> {
        let start = self.elements.partition_point(|row| row.0[..key.len()] < *key);
        let rest = &self.elements[start..];
        // Most keys have few rows, so the end is near the start.
        let mut step = 1;
        while step < rest.len() && rest[step].0[..key.len()] == *key {
            step *= 2;
        }
        let near = &rest[..rest.len().min(step)];
        start..start + near.partition_point(|row| row.0[..key.len()] == *key)
    }

    fn bound(&self, range: Range<usize>, column: usize, word: Word) -> usize {
        range.start + self.elements[range].partition_point(|row| row.0[column] < word)
    }

    fn stored(self: Arc<Self>) -> Box<dyn Stored> {
        Box::new(StoredRows::over(self))
    }
}

/// What takes new rows.
pub(super) trait Sink {
    fn push(&mut self, row: &[Word]);
    /// Rows pushed so far.
    fn len(&self) -> usize;
    /// Memory that they take, now and when they are sorted.
    fn bytes(&self) -> usize;

    /// So many more rows are likely to come: room for them in one piece is not moved while they do.
    fn expect(&mut self, _: usize) {}

    /// A sink for another thread, whose rows go on into this one; none where it matters which row comes first. Rows may
    /// come in any order at all where `is_any_order`.
    fn branch(&self, is_any_order: bool) -> Option<Box<dyn Branch + '_>> {
        let _ = is_any_order;
        None
    }

    /// Takes what its branches took, in the order of the pieces.
    fn absorb(&mut self, _: Vec<Taken>, _: &[Piece], _: Option<&Rename<'_>>) {}
}

/// Rows of one branch, from one place to another.
pub(super) type Piece = (usize, Range<usize>);

/// Names the words anew that a branch has named.
pub(super) type Rename<'a> = dyn Fn(usize, &mut [Word]) + 'a;

/// A sink that a thread of its own fills.
pub(super) trait Branch: Sink + Send {
    fn taken(self: Box<Self>) -> Taken;
}

/// Rows of a [`Branch`], for [`Sink::absorb`] of the sink that it is of.
pub(super) type Taken = Box<dyn Any + Send>;

impl<const N: usize> Branch for Vec<Row<N>> {
    fn taken(self: Box<Self>) -> Taken {
        self
    }
}

/// Rows in any order, to become a [`RowSet`].
pub(super) trait Heap: Sink {
    fn as_sink(&mut self) -> &mut (dyn Sink + 'static);
    /// Takes these columns of all rows.
    fn project(&mut self, rows: &dyn RowSet, columns: &[usize]);
    fn sort(self: Box<Self>) -> SharedRows;
    /// The same in several threads where there are many.
    fn sort_among(self: Box<Self>, threads: usize) -> SharedRows;
}

impl<const N: usize> Sink for Vec<Row<N>> {
    fn push(&mut self, row: &[Word]) {
        let row = Row::of(row);
        // Projections give the same row many times in succession.
        if self.last() != Some(&row) {
            self.push(row);
        }
    }

    fn len(&self) -> usize {
        self.len()
    }

    fn bytes(&self) -> usize {
        (self.capacity() + self.len()) * size_of::<Row<N>>()
    }

    fn expect(&mut self, rows: usize) {
        self.reserve(rows);
    }

    fn branch(&self, _: bool) -> Option<Box<dyn Branch + '_>> {
        Some(Box::new(Self::new()))
    }

    fn absorb(&mut self, taken: Vec<Taken>, pieces: &[Piece], rename: Option<&Rename<'_>>) {
        let taken: Vec<&Self> = taken.iter().filter_map(|rows| rows.downcast_ref()).collect();
        let found = pieces.iter().map(|(branch, range)| &taken[*branch][range.clone()]);
        let mut from = self.len();
        append(self, &found.collect::<Vec<_>>(), taken.len());
        for (branch, range) in pieces {
            let to = from + range.len();
            if let Some(rename) = rename {
                self[from..to].iter_mut().for_each(|row| rename(*branch, &mut row.0));
            }
            from = to;
        }
    }
}

/// Puts what so many threads have found behind the rows.
fn append<const N: usize>(rows: &mut Vec<Row<N>>, found: &[&[Row<N>]], threads: usize) {
    if rows.is_empty() {
        *rows = gathered(found, threads);
        return;
    }
    rows.reserve(found.iter().map(|found| found.len()).sum());
    found.iter().for_each(|found| rows.extend_from_slice(found));
}

impl<const N: usize> Heap for Vec<Row<N>> {
    fn as_sink(&mut self) -> &mut (dyn Sink + 'static) {
        self
    }

    fn project(&mut self, rows: &dyn RowSet, columns: &[usize]) {
        let mut projected = Row([0; N]);
        for at in 0..rows.len() {
            let row = rows.row(at);
            projected.0.iter_mut().zip(columns).for_each(|(word, column)| *word = row[*column]);
            if self.last() != Some(&projected) {
                self.push(projected);
            }
        }
    }

    fn sort(self: Box<Self>) -> SharedRows {
        Arc::new(sorted(*self))
    }

    fn sort_among(mut self: Box<Self>, threads: usize) -> SharedRows {
        sort_runs(&mut self, threads);
        Arc::new(sorted(*self))
    }
}

/// An empty heap for rows of so many columns.
pub(super) fn heap(columns: usize) -> Box<dyn Heap> {
    at_width!(columns, N => Box::new(Vec::<Row<N>>::new()))
}

/// A relation under semi-naive evaluation: datafrog's variable, and one more for each other order of its columns.
pub(super) trait Growing {
    /// Takes new rows, also while the old ones are read.
    fn sink(&self) -> RefMut<'_, dyn Sink>;
    /// Hands the rows pushed since to the variable.
    fn flush(&mut self);
    /// After a step of the iteration: brings the other orders up to it.
    fn follow(&mut self);
    /// The number of the order that starts with these columns.
    fn order(&mut self, iteration: &mut Iteration, columns: &[usize], version: Version) -> usize;
    fn recent(&self, order: usize) -> Vec<Ref<'_, dyn RowSet>>;
    fn stable(&self, order: usize) -> Vec<Ref<'_, dyn RowSet>>;
    fn len(&self) -> usize;
    /// Memory held, what was pushed since included.
    fn bytes(&self) -> usize;
    /// All rows, put together in several threads where they are many.
    fn complete(self: Box<Self>, threads: usize) -> SharedRows;
    /// All rows dealt out by a column's word, for [`Self::seed`] of as many others.
    fn split(&self, _: usize, _: usize) -> Vec<Taken> {
        Vec::new()
    }
    /// Begins with these rows, of which the last round's are the new ones.
    fn seed(&mut self, _: Taken) {}
    /// What was derived, for [`Self::put_together`].
    fn finish(self: Box<Self>) -> Taken {
        Box::new(())
    }
    /// All rows of what others have finished.
    fn put_together(self: Box<Self>, _: Vec<Taken>, threads: usize) -> SharedRows {
        self.complete(threads)
    }
    /// Takes rows out, where they can be taken out.
    fn prune(&mut self, _: &HashSet<Box<[Word]>>) {}
    /// Whether the last round found something.
    fn has_recent(&self) -> bool {
        true
    }
}

struct GrowingRows<const N: usize> {
    columns: usize,
    rows: Variable<Row<N>>,
    /// Rows of the last round that stay as the threads found them.
    beside: RefCell<Vec<Relation<Row<N>>>>,
    orders: Vec<(Vec<usize>, Variable<Row<N>>)>,
    pushed: RefCell<Pushed<N>>,
    /// Some rule reads rows from before the last round.
    needs_stable: bool,
    /// Some rule looks rows of the last round up by key.
    needs_sorted: bool,
    /// Rows from which on it is worth trying [`Seen`] again.
    try_seen_at: usize,
}

/// Fewer rows are copied.
const MANY: usize = 1 << 10;

/// Rows since the last flush.
#[derive(Debug)]
struct Pushed<const N: usize> {
    rows: Vec<Row<N>>,
    /// What threads have found and nothing has moved.
    beside: Vec<Vec<Row<N>>>,
    /// With it, `rows` are new and distinct.
    seen: Option<Seen>,
    /// Rows beyond the range of `seen`.
    outside: Vec<Row<N>>,
}

impl<const N: usize> Sink for Pushed<N> {
    #[inline]
    fn push(&mut self, row: &[Word]) {
        let row = Row::of(row);
        match &mut self.seen {
            None if self.rows.last() == Some(&row) => {}
            None => self.rows.push(row),
            Some(seen) => match seen.insert(&row) {
                Some(true) => self.rows.push(row),
                Some(false) => {}
                None => self.outside.push(row),
            },
        }
    }

    fn len(&self) -> usize {
        self.rows.len() + self.outside.len() + total(&self.beside)
    }

    fn bytes(&self) -> usize {
        let seen = self.seen.as_ref().map_or(0, Seen::bytes);
        let beside: usize = self.beside.iter().map(Vec::capacity).sum();
        Sink::bytes(&self.rows) + Sink::bytes(&self.outside) + beside * size_of::<Row<N>>() + seen
    }

    fn branch(&self, is_any_order: bool) -> Option<Box<dyn Branch + '_>> {
        match &self.seen {
            None => Some(Box::new(Vec::<Row<N>>::new())),
            // Which thread finds a pair first is chance, and so is then the order of the new rows.
            Some(seen) if is_any_order => Some(Box::new(Beside::<N>::new(seen))),
            Some(_) => None,
        }
    }

    fn absorb(&mut self, taken: Vec<Taken>, pieces: &[Piece], rename: Option<&Rename<'_>>) {
        let Some(seen) = &mut self.seen else { return self.rows.absorb(taken, pieces, rename) };
        let taken: Vec<Box<(Vec<Row<N>>, Vec<Row<N>>)>> =
            taken.into_iter().filter_map(|taken| taken.downcast().ok()).collect();
        for taken in taken {
            let (new, outside) = *taken;
            seen.len += new.len();
            self.outside.extend_from_slice(&outside);
            // Many rows stay where they are: to bring them together would be one thread's work.
            match new.len() < MANY {
                true => self.rows.extend_from_slice(&new),
                false => self.beside.push(new),
            }
        }
    }
}

fn total<const N: usize>(batches: &[Vec<Row<N>>]) -> usize {
    batches.iter().map(Vec::len).sum()
}

/// A growing relation of so many columns.
pub(super) fn growing(iteration: &mut Iteration, name: &str, columns: usize) -> Box<dyn Growing> {
    at_width!(columns, N => Box::new(GrowingRows::<N> {
        columns,
        // Rows are told apart here, before they are handed over.
        rows: iteration.variable_indistinct(name),
        beside: RefCell::new(Vec::new()),
        orders: Vec::new(),
        pushed: RefCell::new(Pushed {
            rows: Vec::new(),
            beside: Vec::new(),
            seen: None,
            outside: Vec::new(),
        }),
        needs_stable: false,
        needs_sorted: false,
        try_seen_at: 16,
    }))
}

impl<const N: usize> GrowingRows<N> {
    fn variable(&self, order: usize) -> &Variable<Row<N>> {
        if order == 0 { &self.rows } else { &self.orders[order - 1].1 }
    }

    /// Gives the bits up: a row lies beyond their range.
    fn leave_seen(&self, seen: &Seen, new: &[Row<N>]) {
        if !self.needs_stable {
            let mut old = Relation { elements: seen.rows::<N>() };
            let new = sorted(new.to_vec());
            subtract(&mut old.elements, &new);
            *self.rows.stable.borrow_mut() = vec![old];
            self.forget_recent();
        }
    }

    fn forget_recent(&self) {
        *self.rows.recent.borrow_mut() = Relation { elements: Vec::new() };
        self.beside.borrow_mut().clear();
    }

    /// Goes over to bits where the relation is dense enough.
    fn try_seen(&mut self, new: &[Row<N>]) {
        let len = self.len() + new.len();
        if len < self.try_seen_at || self.columns != 2 {
            return;
        }
        self.try_seen_at = len * 2;
        let (stable, recent) = (self.rows.stable.borrow(), self.rows.recent.borrow());
        let all = stable.iter().flat_map(|batch| batch.iter()).chain(recent.iter()).chain(new);
        let Some(mut seen) = Seen::over(all.clone()) else { return };
        all.for_each(|row| {
            seen.insert(row);
        });
        drop((stable, recent));
        if !self.needs_stable {
            self.rows.stable.borrow_mut().clear();
            self.forget_recent();
        }
        self.pushed.get_mut().seen = Some(seen);
    }
}

impl<const N: usize> Growing for GrowingRows<N> {
    fn sink(&self) -> RefMut<'_, dyn Sink> {
        RefMut::map(self.pushed.borrow_mut(), |pushed| pushed as &mut dyn Sink)
    }

    fn flush(&mut self) {
        let pushed = self.pushed.get_mut();
        let mut rows = std::mem::take(&mut pushed.rows);
        let mut beside = std::mem::take(&mut pushed.beside);
        let is_read_through = !self.needs_stable && !self.needs_sorted && self.orders.is_empty();
        if !is_read_through || !pushed.outside.is_empty() {
            rows.reserve(total(&beside));
            beside.drain(..).for_each(|found| rows.extend_from_slice(&found));
        } else if rows.is_empty() {
            rows = beside.pop().unwrap_or_default();
        }
        if !pushed.outside.is_empty() {
            let outside = std::mem::take(&mut pushed.outside);
            if let Some(seen) = pushed.seen.take() {
                self.leave_seen(&seen, &rows);
            }
            rows.extend(outside);
        }
        if self.pushed.get_mut().seen.is_some() {
            if !self.needs_stable {
                self.forget_recent();
            }
            if self.needs_stable || self.needs_sorted {
                rows = sorted(rows).elements;
            }
        } else {
            rows = sorted(rows).elements;
            self.rows.stable.borrow().iter().for_each(|batch| subtract(&mut rows, batch));
            subtract(&mut rows, &self.rows.recent.borrow());
            self.try_seen(&rows);
        }
        self.rows.insert(Relation { elements: rows });
        let beside = beside.into_iter().map(|elements| Relation { elements });
        self.beside.borrow_mut().extend(beside);
    }

    fn follow(&mut self) {
        for (columns, variable) in &self.orders {
            let turn = |row: &Row<N>| {
                let mut turned = [0; N];
                for (to, from) in columns.iter().enumerate() {
                    turned[to] = row.0[*from];
                }
                Row(turned)
            };
            let turned = self.rows.recent.borrow().iter().map(turn).collect();
            variable.insert(sorted(turned));
        }
    }

    fn order(&mut self, iteration: &mut Iteration, columns: &[usize], version: Version) -> usize {
        let mut order = columns.to_vec();
        order.extend((0..self.columns).filter(|column| !columns.contains(column)));
        if order.iter().copied().eq(0..self.columns) {
            self.needs_stable |= version != Version::Recent;
            self.needs_sorted |= !columns.is_empty();
            return 0;
        }
        if let Some(known) = self.orders.iter().position(|(known, _)| *known == order) {
            return known + 1;
        }
        self.orders.push((order, iteration.variable_indistinct("order")));
        self.orders.len()
    }

    fn recent(&self, order: usize) -> Vec<Ref<'_, dyn RowSet>> {
        let rows = Ref::map(self.variable(order).recent.borrow(), |rows| rows as &dyn RowSet);
        let beside = self.beside.borrow();
        let batch = |at: usize| {
            let beside = Ref::clone(&beside);
            Ref::map(beside, |rows| &rows[at] as &dyn RowSet)
        };
        std::iter::once(rows).chain((0..beside.len()).map(batch)).collect()
    }

    fn stable(&self, order: usize) -> Vec<Ref<'_, dyn RowSet>> {
        let stable = self.variable(order).stable.borrow();
        let batch = |at: usize| {
            let stable = Ref::clone(&stable);
            Ref::map(stable, |batches| &batches[at] as &dyn RowSet)
        };
        (0..stable.len()).map(batch).collect()
    }

    fn len(&self) -> usize {
        let pushed = self.pushed.borrow();
        if let Some(seen) = &pushed.seen {
            return seen.len - pushed.rows.len() - total(&pushed.beside);
        }
        let stable: usize = self.rows.stable.borrow().iter().map(|batch| batch.len()).sum();
        stable + self.rows.recent.borrow().len()
    }

    fn bytes(&self) -> usize {
        let batches = |rows: &Variable<Row<N>>| {
            let stable: usize = rows.stable.borrow().iter().map(|batch| batch.len()).sum();
            stable + rows.recent.borrow().len()
        };
        let own = std::iter::once(&self.rows).chain(self.orders.iter().map(|(_, rows)| rows));
        let beside: usize = self.beside.borrow().iter().map(|rows| rows.elements.capacity()).sum();
        let rows = own.map(batches).sum::<usize>() + beside;
        rows * size_of::<Row<N>>() + self.pushed.borrow().bytes()
    }

    fn split(&self, column: usize, parts: usize) -> Vec<Taken> {
        let mut dealt: Vec<(Vec<Row<N>>, Vec<Row<N>>)> = vec![(Vec::new(), Vec::new()); parts];
        // Mixed, so that words that are counted up do not all go the same way.
        let of =
            |row: &Row<N>| (row.0[column].wrapping_mul(0x9E37_79B1) >> 16) as usize % parts.max(1);
        let recent = self.rows.recent.borrow();
        let mut new = recent.elements.clone();
        self.beside.borrow().iter().for_each(|rows| new.extend_from_slice(&rows.elements));
        new.sort_unstable();
        new.iter().for_each(|row| dealt[of(row)].1.push(*row));
        let pushed = self.pushed.borrow();
        let mut old = match &pushed.seen {
            Some(seen) if !self.needs_stable => seen.rows(),
            _ => {
                let stable = self.rows.stable.borrow();
                let mut old: Vec<Row<N>> =
                    stable.iter().flat_map(|batch| batch.iter().copied()).collect();
                old.sort_unstable();
                old
            }
        };
        subtract(&mut old, &new);
        old.iter().for_each(|row| dealt[of(row)].0.push(*row));
        dealt.into_iter().map(|rows| Box::new(rows) as Taken).collect()
    }

    fn seed(&mut self, rows: Taken) {
        if let Ok(rows) = rows.downcast::<(Vec<Row<N>>, Vec<Row<N>>)>() {
            let (old, new) = *rows;
            self.rows.stable.borrow_mut().push(Relation { elements: old });
            *self.rows.recent.borrow_mut() = Relation { elements: new };
        }
    }

    fn finish(self: Box<Self>) -> Taken {
        let Self { rows, pushed, needs_stable, .. } = *self;
        Box::new(match pushed.into_inner().seen {
            Some(seen) if !needs_stable => Part::<N>::Bits(seen),
            _ => Part::Run(rows.complete().elements),
        })
    }

    fn put_together(self: Box<Self>, parts: Vec<Taken>, threads: usize) -> SharedRows {
        drop(self);
        let parts = parts.into_iter().filter_map(|part| part.downcast::<Part<N>>().ok());
        Arc::new(joined(parts.map(|part| *part).collect(), threads))
    }

    fn complete(self: Box<Self>, threads: usize) -> SharedRows {
        let Self { rows, pushed, needs_stable, .. } = *self;
        match pushed.into_inner().seen {
            Some(seen) if !needs_stable => {
                Arc::new(Relation { elements: seen.rows_among::<N>(threads) })
            }
            _ => Arc::new(rows.complete()),
        }
    }
}

/// Different words in a column, estimated from a sample where the relation is large.
pub(super) fn distinct(rows: &dyn RowSet, column: usize) -> f64 {
    const SAMPLE: usize = 1024;
    let step = rows.len().div_ceil(SAMPLE).max(1);
    let mut words: Vec<Word> =
        (0..rows.len()).step_by(step).map(|at| rows.row(at)[column]).collect();
    let sampled = words.len().max(1);
    words.sort_unstable();
    let unique = words.chunk_by(|a, b| a == b).filter(|same| same.len() == 1).count();
    words.dedup();
    // Words seen once in the sample stand for others that were not seen.
    let unseen = unique as f64 * (rows.len() as f64 / sampled as f64 - 1.0);
    (words.len() as f64 + unseen).max(1.0)
}
