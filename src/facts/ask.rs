//! Questions answered on demand, over a result or over input facts alone.
//!
//! ```
//! use orthoframe_facts::Program;
//! use orthoframe_units::Source;
//!
//! let rules = Source::new("ways.dl", r#"
//!     .decl edge(a: symbol, b: symbol) .decl path(a: symbol, b: symbol) .output path
//!     edge("a", "b"). edge("b", "c"). edge("x", "y").
//!     path(A, B) :- edge(A, B).
//!     path(A, C) :- path(A, B), edge(B, C)."#);
//! let program = Program::parse(&rules)?;
//! let answers = program.ask(&program.database(), &Source::new("?", r#"?- path("a", X).order X desc"#))?;
//! assert_eq!(answers.rows(), [["c".into()], ["b".into()]]);
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! A relation that somebody computes when asked is a [`Computed`]: it stands among the premises of a question and of the
//! question's rules like any other. Where the program declares it as `.input`, the program's own rules read it too: what
//! they derive from it is then derived for the question.

use std::cmp::Ordering;
use std::ops::Deref;
use std::rc::Rc;
use std::sync::Arc;

use super::called::Lookup;
use super::computed::{AskError, Computed};
use super::database::Database;
use super::demand::Demand;
use super::derived::{Derived, values};
use super::evaluate::given;
use super::kept::Kept;
use super::limits::{Limits, Watch};
use super::program::{Clause, Program};
use super::proof::{Explainer, Proof};
use super::question::{FirstName, Question};
use super::relations::{Column, RelationId};
use super::rows::{Stored, heap};
use super::strata::reads;
use super::word::{Value, Word, Words};
use crate::units::Source;

/// The answers to a question: distinct rows in the order asked for.
pub struct Answers<'a> {
    question: Question,
    kept: Held<'a>,
    is_stored: Vec<bool>,
    computed: Vec<(RelationId, &'a dyn Computed)>,
    given: Vec<Option<Box<dyn Stored>>>,
    words: Words,
    limits: Limits,
    unknown: Vec<Arc<str>>,
    rows: Vec<Vec<Value>>,
    found: Vec<Box<[Word]>>,
}

/// Rows that a result lends, or that questions share.
enum Held<'a> {
    Lent(&'a Kept),
    Shared(Arc<Kept>),
}

/// Rows that are kept, what of each relation was told, and which relations are there as a whole.
type Told<'a> = (Held<'a>, Vec<Option<Box<dyn Stored>>>, Vec<bool>);

impl Deref for Held<'_> {
    type Target = Kept;

    fn deref(&self) -> &Kept {
        match self {
            Self::Lent(kept) => kept,
            Self::Shared(kept) => kept,
        }
    }
}

impl std::fmt::Debug for Answers<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_list().entries(&self.rows).finish()
    }
}

impl Derived {
    /// Answers a question about this result: `?- on(X, "стол"), weight(X, W).order W desc.limit 3`.
    ///
    /// # Errors
    /// [`AskError`].
    pub fn ask(&self, question: &Source) -> Result<Answers<'_>, AskError> {
        self.ask_with(question, &[], Limits::default())
    }

    /// As [`Self::ask`], with relations that are computed, within limits.
    ///
    /// # Errors
    /// [`AskError`].
    pub fn ask_with<'a>(
        &'a self,
        question: &Source,
        computed: &[&'a dyn Computed],
        limits: Limits,
    ) -> Result<Answers<'a>, AskError> {
        self.ask_calling(question, computed, &|_| None, limits)
    }

    /// As [`Self::ask_with`], where a text in the question that no fact holds may be what something else is called.
    ///
    /// # Errors
    /// [`AskError`].
    pub fn ask_calling<'a>(
        &'a self,
        question: &Source,
        computed: &[&'a dyn Computed],
        called: FirstName<'_>,
        limits: Limits,
    ) -> Result<Answers<'a>, AskError> {
        let kept = Held::Lent(&self.kept);
        let is_stored = vec![true; self.program.relations.len()];
        let told = (kept, self.given.clone(), is_stored);
        let mut answers = Answers::new(&self.program, told, (question, called), computed, limits)?;
        answers.answer()?;
        Ok(answers)
    }
}

impl Program {
    /// Answers a question about a database, deriving only what it needs.
    ///
    /// The indexes that a question makes stay with the database until it is edited, so that later questions find them.
    ///
    /// # Errors
    /// [`AskError`].
    pub fn ask(
        &self,
        database: &Database,
        question: &Source,
    ) -> Result<Answers<'static>, AskError> {
        self.ask_with(database, question, &[], Limits::default())
    }

    /// As [`Self::ask`], with relations that are computed, within limits.
    ///
    /// # Errors
    /// [`AskError`].
    pub fn ask_with<'a>(
        &self,
        database: &Database,
        question: &Source,
        computed: &[&'a dyn Computed],
        limits: Limits,
    ) -> Result<Answers<'a>, AskError> {
        if self.depends_on_order() {
            let derived = self.evaluate_within(database, limits.clone()).map_err(AskError::from)?;
            let is_stored = vec![true; self.relations.len()];
            let kept = Held::Shared(Arc::new(derived.kept));
            let told = (kept, derived.given, is_stored);
            let mut answers = Answers::new(self, told, (question, &|_| None), computed, limits)?;
            answers.answer()?;
            return Ok(answers);
        }
        let all: Vec<RelationId> = self.relations().map(|(relation, _)| relation).collect();
        let columns: Vec<usize> = self.relations().map(|(_, info)| info.columns.len()).collect();
        let kept = database.asked.ready(&self.facts, || {
            Kept::new(database.words.share(), given(self, database, &all), &columns)
        });
        let mut is_stored = vec![true; columns.len()];
        self.clauses.iter().for_each(|clause| is_stored[clause.head.index()] = false);
        let given = all.iter().map(|of| Some(kept.rows(*of).boxed_clone())).collect();
        let told = (Held::Shared(kept), given, is_stored);
        let mut answers = Answers::new(self, told, (question, &|_| None), computed, limits)?;
        answers.answer()?;
        Ok(answers)
    }
}

impl Program {
    /// These relations alone, deriving only what they need of others; all others stay as they are told.
    pub(super) fn evaluate_on_demand(
        &self,
        database: &Database,
        relations: &[RelationId],
        limits: Limits,
    ) -> Result<Derived, AskError> {
        let limits = limits.within(self.limits);
        if self.depends_on_order() {
            return Ok(self.evaluate_within(database, limits)?);
        }
        let all: Vec<RelationId> = self.relations().map(|(relation, _)| relation).collect();
        let columns: Vec<usize> = self.relations().map(|(_, info)| info.columns.len()).collect();
        let told = given(self, database, &all);
        let mut rows = told.clone();
        let kept = Kept::new(database.words.share(), told.clone(), &columns);
        let mut is_derived = vec![false; columns.len()];
        self.clauses.iter().for_each(|clause| is_derived[clause.head.index()] = true);
        let is_stored = |relation: RelationId| !is_derived[relation.index()];
        let watch = Rc::new(Watch::new(limits));
        let demand = Demand::new(self, &kept, columns.len(), &is_stored, &[], watch);
        let mut words = database.words.share();
        for relation in relations.iter().filter(|of| is_derived[of.index()]) {
            let found = demand.rows(*relation, 0, &[], &mut words);
            if let Some(error) = failure(&demand, *relation) {
                return Err(error);
            }
            let mut sorted = heap(columns[relation.index()]);
            found.iter().for_each(|row| sorted.push(row));
            rows[relation.index()] = sorted.sort();
        }
        drop(demand);
        words.consolidate();
        Ok(Derived::new(self, words, rows, told))
    }
}

impl Program {
    /// The relations that rules derive from some others, by whatever way.
    #[must_use]
    pub fn depend_on(&self, relations: impl Iterator<Item = RelationId>) -> Vec<RelationId> {
        let mut is_reached = vec![false; self.relations.len()];
        relations.for_each(|relation| is_reached[relation.index()] = true);
        let mut reached = Vec::new();
        // Each stratum after those it reads.
        for stratum in self.strata.iter() {
            let clauses = stratum.clauses.iter().map(|n| &*self.clauses[*n]);
            let subsumed = stratum.subsumptions.iter().map(|n| &self.subsumptions[*n].clause);
            if clauses.chain(subsumed).any(|clause| clause.reads_any(&is_reached)) {
                let new = stratum.relations.iter().filter(|of| !is_reached[of.index()]);
                reached.extend(new);
                stratum.relations.iter().for_each(|of| is_reached[of.index()] = true);
            }
        }
        reached
    }
}

impl Clause {
    /// Whether it reads any of the relations that are marked.
    fn reads_any(&self, is_marked: &[bool]) -> bool {
        let mut any = false;
        reads(&self.body, false, &mut |of, _, _| {
            any |= is_marked.get(of.index()).is_some_and(|marked| *marked);
        });
        any
    }
}

impl<'a> Answers<'a> {
    fn new(
        program: &Program,
        (kept, given, is_stored): Told<'a>,
        (source, called): (&Source, FirstName<'_>),
        computed: &[&'a dyn Computed],
        limits: Limits,
    ) -> Result<Self, AskError> {
        let mut words = kept.words.share();
        let own = |by: &&'a dyn Computed| {
            let name = names(by.declaration().text()).next()?;
            program.relation(name).filter(|id| !program.info(*id).inputs.is_empty())
        };
        let (inputs, others): (Vec<&'a dyn Computed>, Vec<_>) =
            computed.iter().partition(|by| own(by).is_some());
        let inputs = inputs.into_iter().filter_map(|by| Some((own(&by)?, by)));
        let mut computed: Vec<(RelationId, &'a dyn Computed)> = inputs.collect();
        // What the question does not name need not be declared.
        let named = |by: &&&'a dyn Computed| {
            names(by.declaration().text()).any(|name| source.text().contains(name))
        };
        let others: Vec<&'a dyn Computed> = others.iter().filter(named).copied().collect();
        let more: Vec<&Source> = others.iter().map(|by| by.declaration()).collect();
        let question = program.question(source, &more, called, &mut words)?;
        let limits = limits.within(question.program.limits);
        let unknown = words.symbols().skip(kept.words.symbols().count()).cloned().collect();
        let relation = |n: usize| RelationId((question.known + n) as u32);
        let (mut kept, mut is_stored) = (kept, is_stored);
        let anew = program.depend_on(computed.iter().map(|(relation, _)| *relation));
        let mut is_anew = vec![false; is_stored.len()];
        anew.iter().for_each(|relation| is_anew[relation.index()] = true);
        let mut of_question = question.program.clauses[program.clauses.len()..].iter();
        if of_question.any(|clause| clause.reads_any(&is_anew)) {
            let mut own = Kept::clone(&kept);
            for relation in anew {
                is_stored[relation.index()] = false;
                own.put_back(relation, given[relation.index()].as_deref());
            }
            kept = Held::Shared(Arc::new(own));
        }
        computed.extend(others.iter().enumerate().map(|(n, by)| (relation(n), *by)));
        Ok(Self {
            question,
            kept,
            is_stored,
            computed,
            given,
            words,
            limits,
            unknown,
            rows: Vec::new(),
            found: Vec::new(),
        })
    }

    fn demand(&self) -> Demand<'_> {
        let is_stored = |relation: RelationId| self.is_stored[relation.index()];
        let watch = Rc::new(Watch::new(self.limits.clone()));
        let (program, known) = (&self.question.program, self.question.known);
        Demand::new(program, &self.kept, known, &is_stored, &self.computed, watch)
    }

    fn answer(&mut self) -> Result<(), AskError> {
        let mut words = std::mem::take(&mut self.words);
        let answer = self.question.answer;
        let (found, error) = {
            let demand = self.demand();
            let found = demand.rows(answer, 0, &[], &mut words);
            (found, failure(&demand, answer))
        };
        self.words = words;
        if let Some(error) = error {
            return Err(error);
        }
        let info = self.question.program.info(answer);
        let mut rows: Vec<(Vec<Value>, Box<[Word]>)> =
            found.iter().map(|row| (values(&self.words, info, row), row.into())).collect();
        let order = &self.question.order;
        let compare = |a: &[Value], b: &[Value]| {
            let asked = order.iter().map(|(column, descends)| {
                let order = a[*column].cmp(&b[*column]);
                if *descends { order.reverse() } else { order }
            });
            asked.fold(Ordering::Equal, Ordering::then).then_with(|| a.cmp(b))
        };
        rows.sort_unstable_by(|a, b| compare(&a.0, &b.0));
        rows.truncate(self.question.limit.unwrap_or(usize::MAX));
        (self.rows, self.found) = rows.into_iter().unzip();
        Ok(())
    }

    /// The columns of the answer: the question's variables, or what its head says.
    #[must_use]
    pub fn columns(&self) -> &[Column] {
        &self.question.program.info(self.question.answer).columns
    }

    /// The answers. A question without variables has one, without columns, where it holds, and none where it does not.
    #[must_use]
    pub fn rows(&self) -> &[Vec<Value>] {
        &self.rows
    }

    /// Texts in the question, its own facts included, that stand in no other fact.
    pub fn unknown(&self) -> impl Iterator<Item = &str> {
        self.unknown.iter().map(|text| &**text)
    }

    /// Why an answer is one: a proof of least height, whose first step is the question itself. None for no such answer.
    ///
    /// # Errors
    /// [`AskError`] when a limit is reached.
    pub fn why(&self, answer: usize) -> Result<Option<Proof>, AskError> {
        let Some(row) = self.found.get(answer) else { return Ok(None) };
        let mut kept = Kept::clone(&self.kept);
        kept.words = self.words.clone();
        let demand = self.demand();
        let mut given = self.given.clone();
        given.resize_with(self.question.program.relations.len(), || None);
        let mut explainer = Explainer::over(&self.question.program, kept, given);
        let proof = explainer.prove_on(&demand, self.question.answer, row.clone());
        match failure(&demand, self.question.answer) {
            Some(error) => Err(error),
            None => Ok(Some(proof)),
        }
    }
}

/// Why a call is not complete, if it is not.
fn failure(demand: &Demand<'_>, relation: RelationId) -> Option<AskError> {
    let fault = || {
        let number = demand.clauses_of(relation).first()?;
        let clause = &demand.program.clauses[*number];
        demand.program.check_limits(clause, &demand.watch).err().map(AskError::from)
    };
    demand.error().or_else(fault)
}

/// The names that declarations declare: behind `.decl`, and behind the equals sign of a second name.
fn names(declarations: &str) -> impl Iterator<Item = &str> {
    let is_of_name = |c: char| c.is_alphanumeric() || c == '_';
    let behind = declarations.split(".decl").skip(1).chain(declarations.split('=').skip(1));
    behind.filter_map(move |text| text.trim_start().split(|c| !is_of_name(c)).next())
}
