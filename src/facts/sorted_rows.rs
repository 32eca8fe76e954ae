//! datafrog's relation as a set of rows.

use std::ops::Range;
use std::sync::Arc;

use datafrog::Relation;

use super::row::Row;
use super::rows::{RowSet, Stored};
use super::stored::StoredRows;
use super::word::Word;

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
