//! What a program derived from a database: the tuples of every relation.

use std::fmt;

use super::database::{FactError, RelationKey, Schema, find_word};
use super::program::{Program, RelationId, RelationInfo};
use super::rows::SharedRows;
use super::word::{Value, Word, Words};

/// All relations of a program after evaluation, input facts included.
#[derive(Clone)]
pub struct Derived {
    pub(super) program: Program,
    pub(super) schema: Schema,
    pub(super) words: Words,
    pub(super) rows: Vec<SharedRows>,
    /// What was told rather than derived: facts of the text and the database.
    pub(super) given: Vec<SharedRows>,
}

impl fmt::Debug for Derived {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sizes = self.schema.relations.iter().zip(&self.rows);
        f.debug_map().entries(sizes.map(|(info, rows)| (&info.name, rows.len()))).finish()
    }
}

impl Derived {
    /// Number of tuples.
    ///
    /// # Errors
    /// [`FactError::UnknownRelation`].
    pub fn len(&self, relation: impl RelationKey) -> Result<usize, FactError> {
        Ok(self.rows[relation.find(&self.schema)?.index()].len())
    }

    /// Distinct tuples: numbers ascending, symbols in the order in which they were first seen.
    ///
    /// # Errors
    /// [`FactError::UnknownRelation`].
    pub fn tuples(&self, relation: impl RelationKey) -> Result<Tuples<'_>, FactError> {
        let id = relation.find(&self.schema)?;
        Ok(Tuples { derived: self, id, at: 0..self.rows[id.index()].len() })
    }

    /// The tuples whose first values are these; found without looking at the others.
    ///
    /// # Errors
    /// [`FactError`] when the relation is unknown or has fewer columns.
    pub fn tuples_with(
        &self,
        relation: impl RelationKey,
        first: &[Value],
    ) -> Result<Tuples<'_>, FactError> {
        let id = relation.find(&self.schema)?;
        let info = self.schema.info(id);
        if first.len() > info.columns.len() {
            let (relation, expected) = (info.name.clone(), info.columns.len());
            return Err(FactError::Arity { relation, expected, found: first.len() });
        }
        let key: Vec<Word> = first.iter().map(|value| find_word(&self.words, value)).collect();
        Ok(Tuples { derived: self, id, at: self.rows[id.index()].range(&key) })
    }

    /// Distinct tuples as values, sorted: numbers ascending, symbols alphabetically.
    ///
    /// # Errors
    /// [`FactError::UnknownRelation`].
    pub fn sorted(&self, relation: impl RelationKey) -> Result<Vec<Vec<Value>>, FactError> {
        let mut tuples: Vec<Vec<Value>> =
            self.tuples(relation)?.map(|tuple| tuple.values()).collect();
        tuples.sort_unstable();
        Ok(tuples)
    }

    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn contains(&self, relation: impl RelationKey, tuple: &[Value]) -> Result<bool, FactError> {
        let id = relation.find(&self.schema)?;
        let row = self.schema.encode(id, tuple, |value| find_word(&self.words, value))?;
        Ok(!row.contains(&super::word::NO_WORD) && self.rows[id.index()].contains(&row))
    }

    /// All relations with their ids, in the order of their declarations.
    pub fn relations(&self) -> impl Iterator<Item = (RelationId, &RelationInfo)> {
        self.schema.relations.iter().enumerate().map(|(n, info)| (RelationId(n as u32), info))
    }
}

/// The tuples of one relation.
#[derive(Debug, Clone)]
pub struct Tuples<'a> {
    derived: &'a Derived,
    id: RelationId,
    at: std::ops::Range<usize>,
}

impl<'a> Iterator for Tuples<'a> {
    type Item = Tuple<'a>;

    fn next(&mut self) -> Option<Tuple<'a>> {
        let info = self.derived.schema.info(self.id);
        let row = self.derived.rows[self.id.index()].row(self.at.next()?);
        Some(Tuple { words: &self.derived.words, info, row: &row[..info.columns.len()] })
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        self.at.size_hint()
    }
}

impl ExactSizeIterator for Tuples<'_> {}

/// One tuple of a relation.
#[derive(Debug, Clone, Copy)]
pub struct Tuple<'a> {
    words: &'a Words,
    info: &'a RelationInfo,
    row: &'a [Word],
}

impl<'a> Tuple<'a> {
    /// Number of columns.
    #[must_use]
    pub fn arity(&self) -> usize {
        self.row.len()
    }

    /// The number in a column; none when the column holds symbols or is not there.
    #[must_use]
    pub fn number(&self, column: usize) -> Option<i64> {
        let holds_number = self.info.columns.get(column)?.kind.is_number();
        holds_number.then(|| self.words.to_number(self.row[column]))
    }

    /// The symbol in a column; none when the column holds numbers or is not there.
    #[must_use]
    pub fn symbol(&self, column: usize) -> Option<&'a str> {
        let holds_number = self.info.columns.get(column)?.kind.is_number();
        (!holds_number).then(|| self.words.text(self.row[column]).as_ref())
    }

    #[must_use]
    pub fn values(&self) -> Vec<Value> {
        values(self.words, self.info, self.row)
    }
}

pub(super) fn values(words: &Words, info: &RelationInfo, row: &[Word]) -> Vec<Value> {
    let value = |(word, column): (&Word, &super::Column)| {
        if column.kind.is_number() {
            Value::Number(words.to_number(*word))
        } else {
            Value::Symbol(words.text(*word).clone())
        }
    };
    row.iter().zip(&info.columns).map(value).collect()
}
