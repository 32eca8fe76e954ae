//! What an update runs: each clause once for each premise that may change, and once backwards.
//!
//! A clause is turned so that it starts with the changed rows of one premise. A positive premise is simply joined
//! first. A negated one, and one inside an aggregate, is put before the whole clause as one more atom that binds what
//! the clause shares with it: it says which solutions may have come or gone, and the clause itself still decides.
//!
//! ```text
//!   on(A, B) :- over(A, B, G), !held(A, B).        changed held:   held(A, B), over(A, B, G), !held(A, B)
//!   low(A, G) :- thing(A), G = min g : over(A, _, g).   changed over:   over(A, _, _), thing(A), G = min g : …
//! ```

use std::collections::HashMap;
use std::sync::Arc;

use super::growing::Version;
use super::head::head_variables;
use super::kept::Kept;
use super::plan::{Plan, Request, Task, plan};
use super::program::{Atom, Clause, Literal, Program, Term, VariableId};
use super::relations::RelationId;
use super::rows::{SharedRows, heap};
use super::turned::turned;
use super::word::Word;

/// How a premise's changes touch a clause.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub(super) enum Touch {
    /// More rows, more solutions.
    Positive,
    /// More rows, fewer solutions.
    Negated,
    /// Either, whatever happens to the rows: a premise inside an aggregate.
    Counted,
}

/// A clause that starts with the changed rows of one premise.
#[derive(Debug)]
pub(super) struct Trigger {
    /// Position in [`Program::clauses`].
    pub(super) number: usize,
    pub(super) touch: Touch,
    pub(super) relation: RelationId,
    clause: Clause,
    first: usize,
}

/// A clause with a plan for it.
#[derive(Debug)]
pub(super) struct Planned {
    pub(super) clause: Clause,
    pub(super) plan: Plan,
    /// For a clause turned backwards: for each column of the head, the variable that takes its word.
    pub(super) head: Vec<VariableId>,
}

/// Everything that the updates of one program run; plans are made when first needed.
#[derive(Debug, Clone)]
pub(super) struct Deltas {
    triggers: Arc<[Trigger]>,
    /// By the relation that changed.
    by_relation: Arc<HashMap<RelationId, Vec<usize>>>,
    planned: HashMap<usize, Arc<Planned>>,
    backwards: HashMap<usize, Arc<Planned>>,
}

impl Deltas {
    pub(super) fn new(program: &Program) -> Self {
        let mut triggers = Vec::new();
        for (number, clause) in program.clauses.iter().enumerate() {
            for (first, literal) in clause.body.iter().enumerate() {
                let mut put_before = |atom: &Atom, touch: Touch, shared: Option<&[VariableId]>| {
                    let mut clause = Clause::clone(clause);
                    clause.body.push(Literal::Atom(shared_part(atom, shared)));
                    let first = clause.body.len() - 1;
                    triggers.push(Trigger {
                        number,
                        touch,
                        relation: atom.relation,
                        clause,
                        first,
                    });
                };
                match literal {
                    Literal::Atom(atom) => triggers.push(Trigger {
                        number,
                        touch: Touch::Positive,
                        relation: atom.relation,
                        clause: Clause::clone(clause),
                        first,
                    }),
                    Literal::Not(atom) => put_before(atom, Touch::Negated, None),
                    Literal::Aggregate(aggregate) => atoms(&aggregate.body, &mut |atom| {
                        put_before(atom, Touch::Counted, Some(&aggregate.shared));
                    }),
                    Literal::Compare(_) | Literal::Range(_) => {}
                }
            }
        }
        let mut by_relation: HashMap<RelationId, Vec<usize>> = HashMap::new();
        for (n, trigger) in triggers.iter().enumerate() {
            by_relation.entry(trigger.relation).or_default().push(n);
        }
        Self {
            triggers: triggers.into(),
            by_relation: Arc::new(by_relation),
            planned: HashMap::new(),
            backwards: HashMap::new(),
        }
    }

    /// Forgets the plans: sizes have changed.
    pub(super) fn plan_anew(&mut self) {
        self.planned.clear();
        self.backwards.clear();
    }

    pub(super) fn triggers(&self) -> Arc<[Trigger]> {
        Arc::clone(&self.triggers)
    }

    /// The triggers that a relation's changes pull.
    pub(super) fn of(&self, relation: RelationId) -> Vec<usize> {
        self.by_relation.get(&relation).cloned().unwrap_or_default()
    }

    pub(super) fn trigger(&mut self, number: usize, kept: &mut Kept) -> Arc<Planned> {
        if let Some(known) = self.planned.get(&number) {
            return Arc::clone(known);
        }
        let trigger = &self.triggers[number];
        let clause = &trigger.clause;
        let mut versions = vec![Version::Finished; clause.body.len()];
        versions[trigger.first] = Version::Recent;
        let wanted = head_variables(clause);
        let task = Task {
            clause,
            versions: &versions,
            first: Some(trigger.first),
            bound: &[],
            wanted: &wanted,
        };
        let plan = plan(&task, kept);
        kept.provide(&plan);
        let planned = Arc::new(Planned { clause: clause.clone(), plan, head: Vec::new() });
        self.planned.insert(number, Arc::clone(&planned));
        planned
    }

    /// The clause with its head known: whether it derives a tuple.
    pub(super) fn backwards(
        &mut self,
        program: &Program,
        number: usize,
        kept: &mut Kept,
    ) -> Arc<Planned> {
        if let Some(known) = self.backwards.get(&number) {
            return Arc::clone(known);
        }
        let (clause, head, _) =
            turned(&program.clauses[number], &program.info(program.clauses[number].head).columns);
        let versions = vec![Version::Finished; clause.body.len()];
        let task =
            Task { clause: &clause, versions: &versions, first: None, bound: &head, wanted: &[] };
        let plan = plan(&task, kept);
        kept.provide(&plan);
        let planned = Arc::new(Planned { clause, plan, head });
        self.backwards.insert(number, Arc::clone(&planned));
        planned
    }
}

/// All atoms of an aggregate's body, also within further aggregates and negated.
fn atoms(body: &[Literal], f: &mut dyn FnMut(&Atom)) {
    for literal in body {
        match literal {
            Literal::Atom(atom) | Literal::Not(atom) => f(atom),
            Literal::Aggregate(aggregate) => atoms(&aggregate.body, f),
            Literal::Compare(_) | Literal::Range(_) => {}
        }
    }
}

/// The atom with `_` for variables that the clause around it does not know.
fn shared_part(atom: &Atom, shared: Option<&[VariableId]>) -> Atom {
    let mut part = atom.clone();
    for arg in &mut part.args {
        if let (Term::Variable(v), Some(shared)) = (&arg, shared)
            && !shared.contains(v)
        {
            *arg = Term::Any;
        }
    }
    part
}

/// Rows as the growing source of a plan reads them; none for its other sources.
pub(super) fn turned_rows(
    plan: &Plan,
    rows: &[Box<[Word]>],
    columns: usize,
) -> Vec<Option<SharedRows>> {
    let sources = plan.requests.iter().map(|request| {
        let Request::Growing { first, .. } = request else { return None };
        let mut order = first.clone();
        order.extend((0..columns).filter(|column| !first.contains(column)));
        let mut turned = heap(columns);
        let mut row = vec![0; columns];
        for from in rows {
            for (to, column) in order.iter().enumerate() {
                row[to] = from[*column];
            }
            turned.push(&row);
        }
        Some(turned.sort())
    });
    sources.collect()
}
