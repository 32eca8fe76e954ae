//! A program over a database, stratum by stratum, to the least fixpoint; recursive strata as `fixpoint` says.

use std::cell::Ref;
use std::collections::HashMap;
use std::rc::Rc;
use std::time::Instant;

use super::database::Database;
use super::derived::Derived;
use super::finished::Finished;
use super::growing::Version;
use super::head::{Head, head_variables};
use super::limits::{Limits, MAX_ROWS, Reached, Watch};
use super::plan::{Plan, Request, Task, plan};
use super::program::{Clause, Expr, Kind, Literal, Program, Stratum};
use super::relations::RelationId;
use super::rows::{RowSet, SharedRows, heap};
use super::sink::Sink;
use super::spread::{Join, Makes, can_spread, may_be_long};
use super::step::Step;
use super::strata::reads;
use super::subsume::{Chosen, choosing};
use super::syntax::Span;
use super::trace::RuleTrace;
use super::word::{Note, Word};

/// Why a program has no result.
#[derive(Debug, Clone, PartialEq, crate::units::Fault)]
#[fault(facts)]
#[non_exhaustive]
pub enum EvaluateError {
    /// A rule that always finds something new, or more than memory should hold.
    TooMany { relation: String, rule: String, limit: usize },

    /// It takes longer than it may.
    Time { relation: String, rule: String, seconds: f64, rows: usize },

    /// It takes more memory than it may.
    Memory { relation: String, rule: String, megabytes: usize, rows: usize },

    /// Whoever asked waits no more.
    Stopped { relation: String, rule: String },
}

impl EvaluateError {
    /// Whether it was a rule of this relation.
    pub(super) fn is_of(&self, name: &str) -> bool {
        let (Self::TooMany { relation, .. }
        | Self::Time { relation, .. }
        | Self::Memory { relation, .. }
        | Self::Stopped { relation, .. }) = self;
        relation == name
    }

    /// The same with the rows that a relation had by then.
    pub(super) fn with_rows(mut self, so_far: usize) -> Self {
        if let Self::Time { rows, .. } | Self::Memory { rows, .. } = &mut self {
            *rows = so_far;
        }
        self
    }
}

impl Program {
    /// Derives everything that follows from the database.
    ///
    /// # Errors
    /// [`EvaluateError`] when a relation outgrows the limit, or the whole those of [`Limits`].
    pub fn evaluate(&self, database: &Database) -> Result<Derived, EvaluateError> {
        self.evaluate_within(database, Limits::default())
    }

    /// As [`Self::evaluate`], within other limits.
    ///
    /// # Errors
    /// As [`Self::evaluate`].
    pub fn evaluate_within(
        &self,
        database: &Database,
        limits: Limits,
    ) -> Result<Derived, EvaluateError> {
        Ok(self.run(database, limits, false)?.0)
    }

    /// With what each rule did, where that is asked for.
    pub(super) fn run(
        &self,
        database: &Database,
        limits: Limits,
        is_traced: bool,
    ) -> Result<(Derived, Vec<RuleTrace>), EvaluateError> {
        let mut evaluation = Evaluation::new(self, database, limits.within(self.limits));
        evaluation.traced = is_traced.then(Vec::new);
        let last_readers = self.last_readers();
        for wave in self.waves() {
            evaluation.wave(&self.strata[wave.clone()])?;
            // What nobody will read again need not be held in any other order.
            let is_read = |read: &RelationId| last_readers[read.index()] >= wave.end;
            evaluation.finished.indexes.retain(|(read, _), _| is_read(read));
        }
        let traced = evaluation.traced.take().unwrap_or_default();
        Ok((evaluation.derived(), traced))
    }
}

impl Program {
    /// That a limit was reached while a clause ran, if one was.
    pub(super) fn check_limits(&self, clause: &Clause, watch: &Watch) -> Result<(), EvaluateError> {
        let Some(reached) = watch.reached() else { return Ok(()) };
        let relation = self.info(clause.head).name.clone();
        let rule = self.place(clause.at);
        let (limits, rows) = (watch.limits(), watch.rows());
        Err(match reached {
            Reached::Time => {
                EvaluateError::Time { relation, rule, seconds: limits.time.as_secs_f64(), rows }
            }
            Reached::Memory => {
                let megabytes = limits.memory_bytes >> 20;
                EvaluateError::Memory { relation, rule, megabytes, rows }
            }
            Reached::Stop => EvaluateError::Stopped { relation, rule },
        })
    }

    pub(super) fn too_many(&self, clause: &Clause, limit: usize) -> EvaluateError {
        let (relation, rule) = (self.info(clause.head).name.clone(), self.place(clause.at));
        EvaluateError::TooMany { relation, rule, limit }
    }

    /// For each relation the number of the last stratum that reads it.
    fn last_readers(&self) -> Vec<usize> {
        let mut last = vec![0; self.relations.len()];
        for (n, stratum) in self.strata.iter().enumerate() {
            for clause in &stratum.clauses {
                reads(&self.clauses[*clause].body, false, &mut |relation, _, _| {
                    last[relation.index()] = n;
                });
            }
        }
        last
    }
}

/// A program under way.
pub(super) struct Evaluation<'a> {
    pub(super) program: &'a Program,
    pub(super) finished: Finished<'a>,
    /// Facts of the text and the database, by relation.
    pub(super) given: Vec<SharedRows>,
    /// Where numbers came out otherwise than Soufflé's would, the first for each rule.
    notes: Vec<(Span, Note)>,
    /// What each rule did, where that is asked for.
    pub(super) traced: Option<Vec<RuleTrace>>,
    /// Rows of the recursive relations among which a limit was reached.
    pub(super) reached: Vec<(RelationId, usize)>,
}

impl<'a> Evaluation<'a> {
    fn new(program: &'a Program, database: &Database, limits: Limits) -> Self {
        let all: Vec<RelationId> = program.relations().map(|(relation, _)| relation).collect();
        Self::of(program, database, &all, limits)
    }

    /// To evaluate some relations only.
    pub(super) fn of(
        program: &'a Program,
        database: &Database,
        relations: &[RelationId],
        limits: Limits,
    ) -> Self {
        let given = given(program, database, relations);
        let watch = Rc::new(Watch::new(limits));
        let finished = Finished::new(database.words.share(), vec![None; given.len()], watch);
        Self { program, finished, given, notes: Vec::new(), traced: None, reached: Vec::new() }
    }

    /// To evaluate strata over what is finished.
    pub(super) fn over(
        program: &'a Program,
        finished: Finished<'a>,
        given: Vec<SharedRows>,
    ) -> Self {
        Self { program, finished, given, notes: Vec::new(), traced: None, reached: Vec::new() }
    }

    fn derived(self) -> Derived {
        let rows = self.finished.rows.into_iter().zip(&self.given);
        let rows = rows.map(|(rows, given)| rows.unwrap_or_else(|| given.clone())).collect();
        let mut words = self.finished.words;
        words.consolidate();
        let mut derived = Derived::new(self.program, words, rows, self.given);
        derived.notes = self.notes;
        derived
    }

    pub(super) fn limit(&self, relation: RelationId) -> usize {
        self.program.info(relation).limit_size.unwrap_or(MAX_ROWS)
    }

    /// The clause is the one that was the last to find something for the relation.
    pub(super) fn check_size(&self, last: &Clause, size: usize) -> Result<(), EvaluateError> {
        match self.finished.watch.limits().rows {
            limit if size > limit => Err(self.program.too_many(last, limit)),
            _ => Ok(()),
        }
    }

    pub(super) fn check_limits(&self, clause: &Clause) -> Result<(), EvaluateError> {
        self.program.check_limits(clause, &self.finished.watch)
    }

    pub(super) fn stratum(&mut self, stratum: &Stratum) -> Result<(), EvaluateError> {
        let program = self.program;
        let clauses: Vec<&Clause> = stratum.clauses.iter().map(|n| &*program.clauses[*n]).collect();
        let is_own = |relation: RelationId| stratum.relations.contains(&relation);
        let is_recursive = clauses.iter().any(|clause| own_atoms(clause, &is_own).next().is_some());
        if is_recursive || !stratum.subsumptions.is_empty() {
            self.fixpoint(stratum, &clauses)
        } else {
            self.once(stratum, &clauses)
        }
    }

    /// A stratum without recursion is one relation, and one run of each of its clauses.
    fn once(&mut self, stratum: &Stratum, clauses: &[&Clause]) -> Result<(), EvaluateError> {
        for relation in &stratum.relations {
            let given = &self.given[relation.index()];
            let mut chosen = self.chosen(*relation);
            let rows = if clauses.is_empty() && chosen.is_none() {
                SharedRows::clone(given)
            } else {
                let mut new = heap(self.program.info(*relation).columns.len());
                let columns = self.program.info(*relation).columns.len();
                for at in 0..given.len() {
                    choosing(new.as_sink(), chosen.as_mut())
                        .as_sink()
                        .push(&given.row(at)[..columns]);
                }
                for clause in clauses {
                    self.finished.watch.hold(self.finished.bytes());
                    let limit = self.limit(*relation);
                    let versions = vec![Version::Finished; clause.body.len()];
                    let mut plan = self.plan(clause, &versions, None);
                    let copied = self.projection(clause, &plan).filter(|_| self.traced.is_none());
                    if let (Some((read, columns)), None) = (copied, &chosen) {
                        new.project(self.finished.relation(read), &columns);
                        continue;
                    }
                    self.finished.provide(&mut plan);
                    let mut sink = choosing(new.as_sink(), chosen.as_mut());
                    self.emit(clause, &plan, &no_parts(&plan), limit, true, sink.as_sink());
                    self.check_limits(clause)?;
                }
                let rows = new.sort_among(self.finished.watch.threads());
                if let Some(last) = clauses.last() {
                    self.check_size(last, rows.len())?;
                }
                rows
            };
            self.finished.rows[relation.index()] = Some(rows);
        }
        Ok(())
    }

    pub(super) fn chosen(&self, relation: RelationId) -> Option<Chosen> {
        let info = self.program.info(relation);
        (!info.choices.is_empty()).then(|| Chosen::of(info))
    }

    /// The relation and the columns that a clause does nothing but copy.
    fn projection(&self, clause: &Clause, plan: &Plan) -> Option<(RelationId, Vec<usize>)> {
        let ([Step::Scan(scan), Step::Reached], [Request::Whole(read)]) =
            (plan.steps.as_slice(), plan.requests.as_slice())
        else {
            return None;
        };
        let info = self.program.info(clause.head);
        let is_plain = scan.key.is_empty() && scan.filters.is_empty() && scan.same.is_empty();
        let takes_all = info.limit_size.is_none()
            && info.columns.iter().all(|column| column.kind != Kind::Unsigned);
        if !is_plain || !takes_all || clause.args.is_empty() {
            return None;
        }
        let column = |arg: &Expr| match arg {
            Expr::Variable(v) => {
                scan.loads.iter().find(|(_, loaded)| loaded == v).map(|(at, _)| *at)
            }
            _ => None,
        };
        let columns: Option<Vec<usize>> = clause.args.iter().map(column).collect();
        Some((*read, columns?))
    }

    pub(super) fn plan(&self, clause: &Clause, versions: &[Version], first: Option<usize>) -> Plan {
        let wanted = head_variables(clause);
        let task = Task { clause, versions, first, bound: &[], wanted: &wanted };
        let mut plan = plan(&task, &self.finished);
        // A trace counts what one thread finds.
        plan.can_spread = self.finished.watch.limits().threads > 1
            && self.traced.is_none()
            && self.limit(clause.head) == MAX_ROWS
            && can_spread(&plan)
            && Makes::of(clause) != Makes::Any;
        plan
    }

    pub(super) fn emit(
        &mut self,
        clause: &Clause,
        plan: &Plan,
        parts: &[Vec<Ref<'_, dyn RowSet>>],
        limit: usize,
        is_any_order: bool,
        sink: &mut dyn Sink,
    ) {
        let watch = Rc::clone(&self.finished.watch);
        let started = self.traced.is_some().then(|| (Instant::now(), sink.len()));
        if plan.can_spread && may_be_long(plan, &self.finished, parts) {
            let program = self.program;
            let join = Join { program, clause, plan, is_any_order, limit };
            join.run(&mut self.finished, parts, sink);
        } else {
            let mut head = Head::new(self.program, clause, limit, sink, &watch);
            let mut registers = vec![0; clause.variables.len()];
            self.finished.run(plan, parts, &mut registers, &mut head);
        }
        watch.found(sink.len());
        if let Some((started, before)) = started {
            let found = sink.len().saturating_sub(before);
            self.trace(clause, plan, found, started.elapsed());
        }
        if let Some(note) = self.finished.words.take_note() {
            self.note(clause.at, note);
        }
    }

    /// Keeps the first note of each rule.
    pub(super) fn note(&mut self, at: Span, note: Note) {
        const MAX_NOTES: usize = 32;
        let is_known = self.notes.iter().any(|(known, _)| *known == at);
        if !is_known && self.notes.len() < MAX_NOTES {
            self.notes.push((at, note));
        }
    }

    pub(super) fn take_notes(&mut self) -> Vec<(Span, Note)> {
        std::mem::take(&mut self.notes)
    }
}

/// The facts of the text and the database; none of relations that are not asked for.
pub(super) fn given(program: &Program, database: &Database, of: &[RelationId]) -> Vec<SharedRows> {
    let mut by_relation: HashMap<RelationId, Vec<&[Word]>> = HashMap::new();
    for fact in program.facts.iter() {
        by_relation.entry(fact.relation).or_default().push(&fact.words);
    }
    let mut is_asked = vec![false; program.relations.len()];
    of.iter().for_each(|relation| is_asked[relation.index()] = true);
    let rows = program.relations().map(|(relation, info)| {
        if !is_asked[relation.index()] {
            return heap(info.columns.len()).sort();
        }
        let given = database.rows(relation);
        let Some(facts) = by_relation.get(&relation) else { return given };
        let mut all = heap(info.columns.len());
        (0..given.len()).for_each(|at| all.push(given.row(at)));
        facts.iter().for_each(|fact| all.push(fact));
        all.sort()
    });
    rows.collect()
}

/// Positions of the atoms over relations of the stratum itself.
pub(super) fn own_atoms<'a>(
    clause: &'a Clause,
    is_own: &'a impl Fn(RelationId) -> bool,
) -> impl Iterator<Item = usize> + 'a {
    let is_own_atom =
        move |literal: &Literal| matches!(literal, Literal::Atom(atom) if is_own(atom.relation));
    clause.body.iter().enumerate().filter(move |(_, literal)| is_own_atom(literal)).map(|(n, _)| n)
}

pub(super) fn no_parts(plan: &Plan) -> Vec<Vec<Ref<'static, dyn RowSet>>> {
    plan.requests.iter().map(|_| Vec::new()).collect()
}
