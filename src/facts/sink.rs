//! What takes new rows, in one thread or in several.

use std::any::Any;
use std::ops::Range;

use super::row::Row;
use super::together::gathered;
use super::word::Word;

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
