//! A relation whose rows are found when a join asks for them: derived on demand, or computed.

use std::rc::Rc;

use super::program::Expr;
use super::relations::RelationId;
use super::value::column_word;
use super::word::{Word, Words};

/// Rows one after the other.
#[derive(Debug, Default)]
pub(super) struct Flat {
    words: Vec<Word>,
    columns: usize,
    pub(super) len: usize,
}

impl Flat {
    pub(super) fn new(columns: usize) -> Self {
        Self { words: Vec::new(), columns, len: 0 }
    }

    pub(super) fn push(&mut self, row: &[Word]) {
        self.words.extend(&row[..self.columns]);
        self.len += 1;
    }

    pub(super) fn row(&self, at: usize) -> &[Word] {
        &self.words[at * self.columns..(at + 1) * self.columns]
    }

    pub(super) fn iter(&self) -> impl Iterator<Item = &[Word]> {
        (0..self.len).map(|at| self.row(at))
    }
}

/// Columns as bits.
pub(super) type Mask = u32;

/// The first columns.
pub(super) fn first(columns: usize) -> Mask {
    Mask::MAX.checked_shr(Mask::BITS - columns as u32).unwrap_or(0)
}

pub(super) fn columns_of(mask: Mask) -> impl Iterator<Item = usize> + Clone {
    (0..Mask::BITS as usize).filter(move |column| mask >> column & 1 == 1)
}

/// What finds the rows of relations.
pub(super) trait Lookup {
    /// The distinct rows whose columns of the mask, ascending, have the words of the key.
    fn rows(&self, relation: RelationId, mask: Mask, key: &[Word], words: &mut Words) -> Rc<Flat>;

    /// Whether there are such rows.
    fn has_rows(&self, relation: RelationId, mask: Mask, key: &[Word], words: &mut Words) -> bool;
}

/// One relation of a [`Lookup`], as a join reads it.
pub(super) struct Called<'a> {
    pub(super) lookup: &'a dyn Lookup,
    pub(super) relation: RelationId,
    /// None for the first columns, as many as the key has.
    pub(super) mask: Option<Mask>,
    /// What a scan's slots mean; none where they are the relation's columns.
    pub(super) columns: Option<&'a [Expr]>,
}

impl Called<'_> {
    pub(super) fn rows(&self, key: &[Word], words: &mut Words) -> Rc<Flat> {
        let mask = self.mask.unwrap_or_else(|| first(key.len()));
        self.lookup.rows(self.relation, mask, key, words)
    }

    pub(super) fn has_rows(&self, key: &[Word], words: &mut Words) -> bool {
        let mask = self.mask.unwrap_or_else(|| first(key.len()));
        self.lookup.has_rows(self.relation, mask, key, words)
    }

    pub(super) fn word(&self, row: &[Word], column: usize, words: &mut Words) -> Word {
        match self.columns {
            Some(columns) => column_word(&columns[column], row, words),
            None => row[column],
        }
    }
}
