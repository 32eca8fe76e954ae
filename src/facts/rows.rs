//! Sets of rows of words, and heaps that become them: datafrog's relations, at a width chosen at run time.
//!
//! datafrog's relations are generic over the tuple; here the tuple is a [`Row`] of one of a few widths,
//! and [`RowSet`], [`Stored`] and [`Growing`](super::growing::Growing) are what the rest of the engine sees of any width.

use std::fmt::Debug;
use std::ops::Range;
use std::sync::Arc;

use super::row::Row;
use super::sink::Sink;
use super::sorting::{sort_runs, sorted};
use super::word::Word;

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

/// The place of a row.
pub(super) type Slot = u32;

/// A set of rows that is edited one by one.
pub(super) trait Stored: Send + Sync + Debug {
    fn len(&self) -> usize;
    fn row(&self, slot: Slot) -> &[Word];
    fn find(&self, row: &[Word]) -> Option<Slot>;
    /// None when it was there.
    fn insert(&mut self, row: &[Word]) -> Option<Slot>;
    /// None when it was not there.
    fn remove(&mut self, row: &[Word]) -> Option<Slot>;
    /// Whether a slot of the base still has its row.
    fn is_there(&self, slot: Slot) -> bool;
    /// The rows that start with the key.
    fn starting(&self, key: &[Word]) -> Starting;
    /// The sorted part; slots below its length are its positions.
    fn base(&self) -> SharedRows;
    /// Slots of the rows that came later.
    fn later(&self) -> Vec<Slot>;
    /// All rows, sorted; put together once after an edit.
    fn rows(&self) -> SharedRows;
    /// So much came later that the base should take it in.
    fn is_fragmented(&self) -> bool;
    /// Takes everything into the base; slots change.
    fn consolidate(&mut self);
    /// Adds many rows at once, one after the other; slots change.
    fn extend(&mut self, words: &[Word], columns: usize);
    fn clear(&mut self);
    fn boxed_clone(&self) -> Box<dyn Stored>;
}

/// Slots in the order of their rows.
#[derive(Debug, Clone, Default)]
pub(super) struct Starting {
    pub(super) base: Range<Slot>,
    /// Ascending by row, the next one last.
    pub(super) later: Vec<Slot>,
    /// Rows still to come.
    pub(super) len: usize,
}

impl Starting {
    pub(super) fn next(&mut self, rows: &dyn Stored) -> Option<Slot> {
        while self.base.start < self.base.end && !rows.is_there(self.base.start) {
            self.base.start += 1;
        }
        let in_base = (self.base.start < self.base.end).then_some(self.base.start);
        let slot = match (in_base, self.later.last()) {
            (Some(one), Some(&other)) if rows.row(other) < rows.row(one) => other,
            (Some(one), _) => one,
            (None, other) => *other?,
        };
        if in_base == Some(slot) {
            self.base.start += 1;
        } else {
            self.later.pop();
        }
        self.len -= 1;
        Some(slot)
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
