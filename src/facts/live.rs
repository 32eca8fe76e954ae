//! A result that is kept in step with its input facts.
//!
//! A change of input facts evaluates anew only the strata that read, directly or through others, a relation
//! that changed; a stratum that comes out as it was stops the change there. Within a stratum evaluation starts
//! from nothing, so deletions under recursion, negation and aggregates need no rule of their own.
//!
//! **Invariant**: after every update the result equals an evaluation of the same database from scratch.

use std::collections::HashSet;

use super::check::reads;
use super::database::{Database, FactError, RelationKey};
use super::derived::Derived;
use super::evaluate::{EvaluateError, Evaluation};
use super::program::{Program, RelationId, Stratum};
use super::word::Value;

/// A program, its input facts and what follows from them.
#[derive(Debug, Clone)]
pub struct Live {
    program: Program,
    database: Database,
    derived: Derived,
    /// Relations whose input facts changed since the last update.
    touched: HashSet<RelationId>,
}

impl Live {
    /// # Errors
    /// [`EvaluateError`] as from [`Program::evaluate`].
    pub fn new(program: Program, mut database: Database) -> Result<Self, EvaluateError> {
        let derived = program.evaluate(&database)?;
        // The database goes on from the result's words, so that kept rows keep their meaning.
        database.words = derived.words.share();
        Ok(Self { program, database, derived, touched: HashSet::new() })
    }

    /// Adds an input tuple; false when it was there. Takes effect at the next [`Self::update`].
    ///
    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn insert(
        &mut self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<bool, FactError> {
        let changed = self.database.insert(relation, tuple)?;
        self.touch(relation, changed)
    }

    /// Takes an input tuple out; false when it was not there. Takes effect at the next [`Self::update`].
    ///
    /// # Errors
    /// [`FactError`] when the relation is unknown or the tuple does not fit it.
    pub fn remove(
        &mut self,
        relation: impl RelationKey,
        tuple: &[Value],
    ) -> Result<bool, FactError> {
        let changed = self.database.remove(relation, tuple)?;
        self.touch(relation, changed)
    }

    fn touch(&mut self, relation: impl RelationKey, changed: bool) -> Result<bool, FactError> {
        if changed {
            self.touched.insert(relation.find(&self.database.schema)?);
        }
        Ok(changed)
    }

    /// Brings the result up to the input facts, and tells which relations changed.
    ///
    /// # Errors
    /// [`EvaluateError`]; the result then still stands for the input before the update, which may be tried again.
    pub fn update(&mut self) -> Result<Vec<RelationId>, EvaluateError> {
        if self.touched.is_empty() {
            return Ok(Vec::new());
        }
        let mut changed: HashSet<RelationId> = HashSet::new();
        let mut evaluation = Evaluation::new(&self.program, &self.database);
        for stratum in self.program.strata.iter() {
            if !self.is_affected(stratum, &changed) {
                evaluation.keep(stratum, &self.derived);
                continue;
            }
            evaluation.stratum(stratum)?;
            for relation in &stratum.relations {
                if !evaluation.is_same(*relation, &self.derived) {
                    changed.insert(*relation);
                }
            }
        }
        self.derived = evaluation.derived();
        self.database.words = self.derived.words.share();
        self.touched.clear();
        let mut changed: Vec<RelationId> = changed.into_iter().collect();
        changed.sort_unstable();
        Ok(changed)
    }

    fn is_affected(&self, stratum: &Stratum, changed: &HashSet<RelationId>) -> bool {
        let mut affected = stratum.relations.iter().any(|relation| self.touched.contains(relation));
        for clause in &stratum.clauses {
            let body = &self.program.clauses[*clause].body;
            reads(body, false, &mut |relation, _, _| affected |= changed.contains(&relation));
        }
        affected
    }

    /// What followed at the last update.
    #[must_use]
    pub fn derived(&self) -> &Derived {
        &self.derived
    }

    /// The input facts, changes since the last update included.
    #[must_use]
    pub fn database(&self) -> &Database {
        &self.database
    }

    #[must_use]
    pub fn program(&self) -> &Program {
        &self.program
    }
}
