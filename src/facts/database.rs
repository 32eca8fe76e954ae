//! The input facts of a program: tuples by relation, inserted and removed one by one.

use std::sync::{Arc, Mutex, PoisonError};

use super::decimal::Decimal;
use super::kept::Kept;
use super::program::{Fact, Kind, Program};
use super::record::{self, Making};
use super::relations::{Names, RelationId, RelationInfo};
use super::rows::{SharedRows, Stored};
use super::stored::stored;
use super::word::{NO_WORD, Value, Word, Words};
use crate::units::nearest_name;

/// A tuple or a relation that does not fit the program.
#[derive(Debug, Clone, PartialEq, Eq, crate::units::Fault)]
#[fault(facts)]
#[non_exhaustive]
pub enum FactError {
    /// No declaration has this name.
    #[fault(message = "facts-fact-unknown-relation")]
    UnknownRelation { name: String, nearest: Option<String> },

    /// A tuple that is too long or too short.
    #[fault(message = "facts-fact-arity")]
    Arity { relation: String, expected: usize, found: usize },

    /// A number for a symbol or a symbol for a number.
    #[fault(message = "facts-fact-types")]
    Types { relation: String, column: String, expected: String, found: String },
}

/// A relation by its id or by one of its names.
pub trait RelationKey: Copy {
    #[doc(hidden)]
    fn find(&self, schema: &Schema) -> Result<RelationId, FactError>;
}

impl RelationKey for RelationId {
    fn find(&self, schema: &Schema) -> Result<RelationId, FactError> {
        let known = self.index() < schema.relations.len();
        let unknown =
            || FactError::UnknownRelation { name: format!("№ {}", self.0), nearest: None };
        known.then_some(*self).ok_or_else(unknown)
    }
}

impl RelationKey for &str {
    fn find(&self, schema: &Schema) -> Result<RelationId, FactError> {
        schema.names.find(self).ok_or_else(|| FactError::UnknownRelation {
            name: (*self).to_owned(),
            nearest: nearest_name(self, schema.names.all()).map(str::to_owned),
        })
    }
}

/// The relations of a program, shared by its databases and results.
#[derive(Debug, Clone)]
pub struct Schema {
    pub(super) relations: Arc<Vec<Arc<RelationInfo>>>,
    pub(super) names: Arc<Names>,
}

impl Schema {
    pub(super) fn of(program: &Program) -> Self {
        Self { relations: Arc::clone(&program.relations), names: Arc::clone(&program.names) }
    }

    pub(super) fn info(&self, relation: RelationId) -> &RelationInfo {
        &self.relations[relation.index()]
    }

    /// The words of a tuple; [`NO_WORD`] for values that no word stands for yet, when `words` may not grow.
    pub(super) fn encode(
        &self,
        relation: RelationId,
        tuple: &[Value],
        mut word: impl FnMut(&Value, Kind) -> Word,
    ) -> Result<Vec<Word>, FactError> {
        let info = self.info(relation);
        if tuple.len() != info.columns.len() {
            let relation = info.name.clone();
            return Err(FactError::Arity {
                relation,
                expected: info.columns.len(),
                found: tuple.len(),
            });
        }
        for (value, column) in tuple.iter().zip(&info.columns) {
            let fits = match value {
                Value::Number(number) => {
                    column.kind == Kind::Number
                        || column.kind == Kind::Unsigned && u32::try_from(*number).is_ok()
                }
                Value::Record(_) => matches!(column.kind, Kind::Record(_)),
                Value::Decimal(_) => column.kind == Kind::Float,
                Value::Symbol(_) => column.kind == Kind::Symbol,
            };
            if !fits {
                return Err(FactError::Types {
                    relation: info.name.clone(),
                    column: column.name.clone(),
                    expected: column.type_name.clone(),
                    found: value.to_string(),
                });
            }
        }
        let kinds = info.columns.iter().map(|column| column.kind);
        Ok(tuple.iter().zip(kinds).map(|(value, kind)| word(value, kind)).collect())
    }
}

impl Schema {
    /// That each text of a record is one of its column's type.
    fn check_records(
        &self,
        relation: RelationId,
        tuple: &[Value],
        row: &[Word],
    ) -> Result<(), FactError> {
        let info = self.info(relation);
        match row.iter().position(|word| *word == NO_WORD) {
            None => Ok(()),
            Some(n) => Err(FactError::Types {
                relation: info.name.clone(),
                column: info.columns[n].name.clone(),
                expected: info.columns[n].type_name.clone(),
                found: tuple[n].to_string(),
            }),
        }
    }
}

/// The input facts of one program.
///
/// Relations that rules derive may have input facts too; both count.
#[derive(Debug, Clone)]
pub struct Database {
    pub(super) schema: Schema,
    pub(super) words: Words,
    tables: Vec<Box<dyn Stored>>,
    pub(super) asked: Asked,
}

/// What the questions asked of a database so far have made ready: its rows beside a program's facts, with their indexes.
/// An edit of the database empties it.
#[derive(Debug, Default)]
pub(super) struct Asked(Mutex<Option<Ready>>);

#[derive(Debug, Clone)]
struct Ready {
    facts: Arc<[Fact]>,
    kept: Arc<Kept>,
}

impl Asked {
    /// What stands ready for a program with these facts, made where there is none.
    pub(super) fn ready(&self, facts: &Arc<[Fact]>, make: impl FnOnce() -> Kept) -> Arc<Kept> {
        // A thread that ended amid a question has put nothing half done here.
        let mut known = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        if let Some(ready) = known.as_ref().filter(|ready| Arc::ptr_eq(&ready.facts, facts)) {
            return Arc::clone(&ready.kept);
        }
        let kept = Arc::new(make());
        *known = Some(Ready { facts: Arc::clone(facts), kept: Arc::clone(&kept) });
        kept
    }
}

impl Clone for Asked {
    fn clone(&self) -> Self {
        Self(Mutex::new(self.0.lock().unwrap_or_else(PoisonError::into_inner).clone()))
    }
}

impl Program {
    /// An empty database for this program.
    #[must_use]
    pub fn database(&self) -> Database {
        let tables = self.relations.iter().map(|info| stored(info.columns.len())).collect();
        Database {
            schema: Schema::of(self),
            words: self.words.share(),
            tables,
            asked: Asked::default(),
        }
    }
}

impl Database {
    /// Adds a tuple; false when it was there.
    ///
    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn insert(
        &mut self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<bool, FactError> {
        let (relation, row) = self.encode(relation, tuple)?;
        Ok(self.insert_row(relation, &row))
    }

    /// The words of a tuple, made where there are none yet.
    pub(super) fn encode(
        &mut self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<(RelationId, Vec<Word>), FactError> {
        let relation = relation.find(&self.schema)?;
        let words = &mut self.words;
        let row = self
            .schema
            .encode(relation, tuple, |value, kind| words.of(value, kind).unwrap_or(NO_WORD))?;
        self.schema.check_records(relation, tuple, &row)?;
        words.consolidate();
        Ok((relation, row))
    }

    /// A relation's rows, to be edited.
    fn table(&mut self, relation: RelationId) -> &mut dyn Stored {
        self.asked = Asked::default();
        &mut *self.tables[relation.index()]
    }

    pub(super) fn insert_row(&mut self, relation: RelationId, row: &[Word]) -> bool {
        self.table(relation).insert(row).is_some()
    }

    pub(super) fn remove_row(&mut self, relation: RelationId, row: &[Word]) -> bool {
        self.table(relation).remove(row).is_some()
    }

    pub(super) fn contains_row(&self, relation: RelationId, row: &[Word]) -> bool {
        self.tables[relation.index()].find(row).is_some()
    }

    /// Adds many tuples at once: [`Loader::push`] takes them, [`Loader::finish`] puts them in.
    pub fn load(&mut self) -> Loader<'_> {
        Loader { rows: self.tables.iter().map(|_| Vec::new()).collect(), database: self }
    }

    pub(super) fn from_tables(program: &Program, tables: Vec<Box<dyn Stored>>) -> Self {
        Self {
            schema: Schema::of(program),
            words: program.words.share(),
            tables,
            asked: Asked::default(),
        }
    }

    /// Puts the tuples of each relation together, so that evaluations share them.
    pub(super) fn consolidate(&mut self) {
        self.tables.iter_mut().for_each(|table| table.consolidate());
    }

    /// Takes a tuple out; false when it was not there.
    ///
    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn remove(
        &mut self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<bool, FactError> {
        let (relation, row) = self.find_row(relation, tuple)?;
        Ok(self.remove_row(relation, &row))
    }

    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn contains(&self, relation: impl RelationKey, tuple: &[Value]) -> Result<bool, FactError> {
        let (relation, row) = self.find_row(relation, tuple)?;
        Ok(self.contains_row(relation, &row))
    }

    /// Takes all tuples of a relation out.
    ///
    /// # Errors
    /// [`FactError::UnknownRelation`].
    pub fn clear(&mut self, relation: impl RelationKey) -> Result<(), FactError> {
        let relation = relation.find(&self.schema)?;
        self.table(relation).clear();
        Ok(())
    }

    /// Number of input tuples of a relation.
    ///
    /// # Errors
    /// [`FactError::UnknownRelation`].
    pub fn len(&self, relation: impl RelationKey) -> Result<usize, FactError> {
        let relation = relation.find(&self.schema)?;
        Ok(self.tables[relation.index()].len())
    }

    /// Whether there is no input tuple at all.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.tables.iter().all(|table| table.len() == 0)
    }

    /// The words of a tuple, [`NO_WORD`] for values that it has never seen.
    pub(super) fn find_row(
        &self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<(RelationId, Vec<Word>), FactError> {
        let relation = relation.find(&self.schema)?;
        let row = self
            .schema
            .encode(relation, tuple, |value, kind| find_word(&self.words, value, kind))?;
        Ok((relation, row))
    }

    pub(super) fn rows(&self, relation: RelationId) -> SharedRows {
        self.tables[relation.index()].rows()
    }
}

/// A value that a database knows already: to say it again costs no look-up.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Known {
    word: Word,
    kind: Kind,
}

/// Takes tuples for a database, many at once.
#[derive(Debug)]
pub struct Loader<'a> {
    database: &'a mut Database,
    /// By relation, one row after the other.
    rows: Vec<Vec<Word>>,
}

impl Loader<'_> {
    pub fn number(&mut self, number: i64) -> Known {
        Known { word: self.database.words.number(number), kind: Kind::Number }
    }

    pub fn decimal(&mut self, decimal: Decimal) -> Known {
        Known { word: self.database.words.number(decimal.millionths()), kind: Kind::Float }
    }

    pub fn symbol(&mut self, text: &str) -> Known {
        Known { word: self.database.words.symbol(text), kind: Kind::Symbol }
    }

    /// A record from its text; none where the text is not of the column's type.
    pub fn record(&mut self, text: &str, kind: Kind) -> Option<Known> {
        let word = record::read(text, kind, &mut Making(&mut self.database.words))?;
        Some(Known { word, kind })
    }

    /// # Errors
    /// [`FactError`] when the tuple does not fit the relation.
    pub fn push(&mut self, relation: RelationId, tuple: &[Known]) -> Result<(), FactError> {
        let info = self.database.schema.info(relation);
        let fits = tuple.len() == info.columns.len()
            && tuple.iter().zip(&info.columns).all(|(value, column)| {
                value.kind == column.kind
                    || value.kind == Kind::Number
                        && column.kind == Kind::Unsigned
                        && u32::try_from(self.database.words.to_number(value.word)).is_ok()
            });
        if !fits {
            let words = &self.database.words;
            let value = |known: &Known| words.value(known.word, known.kind);
            let values: Vec<Value> = tuple.iter().map(value).collect();
            return self.database.find_row(relation, &values).map(|_| ());
        }
        if tuple.is_empty() {
            self.database.insert_row(relation, &[]);
        }
        self.rows[relation.index()].extend(tuple.iter().map(|known| known.word));
        Ok(())
    }

    pub fn finish(self) {
        let Self { database, rows, .. } = self;
        database.words.consolidate();
        database.asked = Asked::default();
        for ((rows, table), info) in
            rows.into_iter().zip(&mut database.tables).zip(database.schema.relations.iter())
        {
            if !rows.is_empty() {
                table.extend(&rows, info.columns.len());
            }
        }
    }
}

/// The word of a value, [`NO_WORD`] when the table has never seen it.
pub(super) fn find_word(words: &Words, value: &Value, kind: Kind) -> Word {
    words.find(value, kind).unwrap_or(NO_WORD)
}
