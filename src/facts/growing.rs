//! Relations that grow round by round until nothing new is found: datafrog's variables, at a width chosen at run time.

use std::cell::{Ref, RefCell, RefMut};
use std::collections::HashSet;
use std::sync::Arc;

use datafrog::{Iteration, Relation, Variable};

use super::beside::Beside;
use super::row::Row;
use super::rows::{RowSet, SharedRows, at_width};
use super::seen::Seen;
use super::sink::{Branch, Piece, Rename, Sink, Taken};
use super::sorting::{sorted, subtract};
use super::together::{Part, joined};
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
