//! What a program derived from a database: the tuples of every relation.

use std::fmt;

use super::database::{FactError, RelationKey, Schema, find_word};
use super::fault::FileFaults;
use super::kept::Kept;
use super::program::{Kind, Program};
use super::record::{self, Texts};
use super::relations::{RelationId, RelationInfo};
use super::rows::{SharedRows, Starting, Stored};
use super::syntax::Span;
use super::word::{Note, Value, Word, Words};

/// All relations of a program after evaluation, input facts included.
#[derive(Clone)]
pub struct Derived {
    pub(super) program: Program,
    pub(super) schema: Schema,
    pub(super) kept: Kept,
    /// What was told rather than derived, facts of the text and the database; none where everything was told.
    pub(super) given: Vec<Option<Box<dyn Stored>>>,
    /// Where numbers came out otherwise than Soufflé's would.
    pub(super) notes: Vec<(Span, Note)>,
}

impl fmt::Debug for Derived {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let sizes = self.relations().map(|(id, info)| (&info.name, self.kept.rows(id).len()));
        f.debug_map().entries(sizes).finish()
    }
}

impl Derived {
    pub(super) fn new(
        program: &Program,
        words: Words,
        rows: Vec<SharedRows>,
        given: Vec<SharedRows>,
    ) -> Self {
        let columns: Vec<usize> = program.relations.iter().map(|info| info.columns.len()).collect();
        let mut is_derived = vec![false; columns.len()];
        program.clauses.iter().for_each(|clause| is_derived[clause.head.index()] = true);
        let given = given.into_iter().zip(is_derived);
        let given = given.map(|(given, is_derived)| is_derived.then(|| given.stored())).collect();
        let schema = Schema::of(program);
        Self {
            program: program.clone(),
            schema,
            kept: Kept::new(words, rows, &columns),
            given,
            notes: Vec::new(),
        }
    }

    /// Warnings about rules in which a value came out otherwise than with Soufflé: a number beyond 32 bits or rounded to
    /// millionths, a text too long to be kept. At most one for each rule.
    #[must_use]
    pub fn notes(&self) -> Vec<FileFaults> {
        let fault = |(at, note): &(Span, Note)| (at.file, note.told(*at));
        super::fault::by_file(&self.program.sources, self.notes.iter().map(fault).collect())
    }

    /// Whether a tuple was told, by the text or the database.
    pub(super) fn is_told(&self, relation: RelationId, row: &[Word]) -> bool {
        match &self.given[relation.index()] {
            Some(given) => given.find(row).is_some(),
            None => self.kept.rows(relation).find(row).is_some(),
        }
    }

    pub(super) fn tuple<'a>(&'a self, relation: RelationId, row: &'a [Word]) -> Tuple<'a> {
        let info = self.schema.info(relation);
        Tuple { words: &self.kept.words, info, row: &row[..info.columns.len()] }
    }

    /// Number of tuples.
    ///
    /// # Errors
    /// [`FactError::UnknownRelation`].
    pub fn len(&self, relation: impl RelationKey) -> Result<usize, FactError> {
        Ok(self.kept.rows(relation.find(&self.schema)?).len())
    }

    /// Distinct tuples: numbers ascending, symbols in the order in which they were first seen.
    ///
    /// # Errors
    /// [`FactError::UnknownRelation`].
    pub fn tuples(&self, relation: impl RelationKey) -> Result<Tuples<'_>, FactError> {
        let id = relation.find(&self.schema)?;
        Ok(Tuples { derived: self, id, rest: self.kept.rows(id).starting(&[]) })
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
        let kinds = info.columns.iter().map(|column| column.kind);
        let key: Vec<Word> = first
            .iter()
            .zip(kinds)
            .map(|(value, kind)| find_word(&self.kept.words, value, kind))
            .collect();
        Ok(Tuples { derived: self, id, rest: self.kept.rows(id).starting(&key) })
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

    /// Visits the tuples of a relation of this program in the order of [`Self::sorted`], until a visit fails.
    pub(super) fn each_sorted<E>(
        &self,
        relation: RelationId,
        visit: &mut dyn FnMut(Tuple<'_>) -> Result<(), E>,
    ) -> Result<(), E> {
        let rows = self.kept.rows(relation).rows();
        let columns = &self.schema.info(relation).columns;
        if columns.iter().any(|column| matches!(column.kind, Kind::Record(_))) {
            let mut order: Vec<usize> = (0..rows.len()).collect();
            order.sort_by_cached_key(|at| self.tuple(relation, rows.row(*at)).values());
            return order.into_iter().try_for_each(|at| visit(self.tuple(relation, rows.row(at))));
        }
        let has_symbols = columns.iter().any(|column| !column.kind.is_number());
        let in_place = |word: &Word| super::word::is_in_place(*word);
        if !has_symbols && (0..rows.len()).all(|at| rows.row(at).iter().all(in_place)) {
            return (0..rows.len()).try_for_each(|at| visit(self.tuple(relation, rows.row(at))));
        }
        let words = &self.kept.words;
        let rank = if has_symbols { words.symbol_ranks() } else { Vec::new() };
        let key = |at: u32| {
            let row = rows.row(at as usize);
            row.iter().zip(columns).map(|(word, column)| match column.kind.is_number() {
                true => words.to_number(*word),
                false => i64::from(rank[*word as usize]),
            })
        };
        let mut order: Vec<u32> = (0..rows.len() as u32).collect();
        order.sort_unstable_by(|a, b| key(*a).cmp(key(*b)));
        order.into_iter().try_for_each(|at| visit(self.tuple(relation, rows.row(at as usize))))
    }

    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn contains(&self, relation: impl RelationKey, tuple: &[Value]) -> Result<bool, FactError> {
        let id = relation.find(&self.schema)?;
        let row = self
            .schema
            .encode(id, tuple, |value, kind| find_word(&self.kept.words, value, kind))?;
        Ok(!row.contains(&super::word::NO_WORD) && self.kept.rows(id).find(&row).is_some())
    }

    /// All relations with their ids, in the order of their declarations.
    pub fn relations(&self) -> impl Iterator<Item = (RelationId, &RelationInfo)> {
        self.schema.relations.iter().enumerate().map(|(n, info)| (RelationId(n as u32), &**info))
    }
}

/// The tuples of one relation.
#[derive(Debug, Clone)]
pub struct Tuples<'a> {
    derived: &'a Derived,
    id: RelationId,
    rest: Starting,
}

impl<'a> Iterator for Tuples<'a> {
    type Item = Tuple<'a>;

    fn next(&mut self) -> Option<Tuple<'a>> {
        let rows = self.derived.kept.rows(self.id);
        let slot = self.rest.next(rows)?;
        Some(self.derived.tuple(self.id, rows.row(slot)))
    }

    fn size_hint(&self) -> (usize, Option<usize>) {
        (self.rest.len, Some(self.rest.len))
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
        let holds_number =
            matches!(self.info.columns.get(column)?.kind, Kind::Number | Kind::Unsigned);
        holds_number.then(|| self.words.to_number(self.row[column]))
    }

    /// The symbol in a column; none when the column holds numbers or is not there.
    #[must_use]
    pub fn symbol(&self, column: usize) -> Option<&'a str> {
        let holds_symbol = self.info.columns.get(column)?.kind == Kind::Symbol;
        holds_symbol.then(|| self.words.text(self.row[column]).as_ref())
    }

    /// Appends the text of the value in a column; texts within records in quotes, where that is asked for.
    pub(super) fn write(&self, column: usize, is_quoted: bool, text: &mut String) {
        use fmt::Write;
        let (word, kind) = (self.row[column], self.info.columns[column].kind);
        match kind {
            Kind::Symbol => text.push_str(self.words.text(word)),
            Kind::Record(_) => {
                let texts = if is_quoted { Texts::Quoted } else { Texts::Plain };
                record::write(self.words, word, kind, texts, text);
            }
            _ => {
                let _ = write!(text, "{}", self.words.value(word, kind));
            }
        }
    }

    #[must_use]
    pub fn values(&self) -> Vec<Value> {
        values(self.words, self.info, self.row)
    }
}

pub(super) fn values(words: &Words, info: &RelationInfo, row: &[Word]) -> Vec<Value> {
    let value = |(word, column): (&Word, &super::Column)| words.value(*word, column.kind);
    row.iter().zip(&info.columns).map(value).collect()
}
