//! Magic sets (Bancilhon, Maier, Sagiv, Ullman 1986; Beeri, Ramakrishnan 1991) for one group of recursive relations.
//!
//! A relation called by some columns gets a twin that holds only what calls need, and a relation of its calls:
//!
//! ```text
//!   path(a, c) :- path(a, b), edge(b, c).                      called with a known:
//!   path'(a, c) :- call'(a), path'(a, b), edge(b, c).          call'(a) :- call'(a).
//! ```
//!
//! What comes before an atom in the order of [`Walk`] says how it is called. The order in which the clauses are then
//! joined is the planner's: the guard is one more atom, and every solution of a guarded clause has its calls.
//!
//! Negations and aggregates of the clauses read lower strata, which are called as wholes outside ([`Outside`](super::finished::Outside)).

use std::collections::VecDeque;
use std::rc::Rc;
use std::sync::Arc;

use super::called::{Mask, columns_of};
use super::demand::Demand;
use super::evaluate::{EvaluateError, Evaluation};
use super::finished::Finished;
use super::plan::Statistics;
use super::program::{Atom, Clause, Expr, Literal, Program, Stratum, Term, used_variables};
use super::relations::{RelationId, RelationInfo};
use super::rows::heap;
use super::syntax::Comparison;
use super::tables::{Besides, Way};
use super::turned::turned;
use super::word::{Word, Words};

/// Ways of calling one group; more are called for all rows.
const MAX_WAYS: usize = 24;

/// One call's program.
pub(super) struct Magic {
    program: Program,
    stratum: Stratum,
    /// Each way with its twin and the relation of its calls.
    ways: Vec<(Way, RelationId, RelationId)>,
    /// Rows that are given, under a number of their own.
    given: Vec<(RelationId, RelationId)>,
}

type Answers = Vec<(Way, Besides)>;

struct Builder<'a, 'd> {
    demand: &'a Demand<'d>,
    group: &'a [RelationId],
    infos: Vec<Arc<RelationInfo>>,
    clauses: Vec<Clause>,
    ways: Vec<(Way, RelationId, RelationId)>,
    open: VecDeque<usize>,
    given: Vec<(RelationId, RelationId)>,
}

impl Magic {
    pub(super) fn new(
        demand: &Demand<'_>,
        group: &[RelationId],
        relation: RelationId,
        mask: Mask,
    ) -> Self {
        let of = demand.program;
        let mut builder = Builder {
            demand,
            group,
            infos: Vec::clone(&of.relations),
            clauses: Vec::new(),
            ways: Vec::new(),
            open: VecDeque::new(),
            given: Vec::new(),
        };
        builder.way((relation, mask));
        while let Some(next) = builder.open.pop_front() {
            builder.guard(next);
        }
        let Builder { infos, clauses, ways, given, .. } = builder;
        let stratum = Stratum {
            relations: ways.iter().flat_map(|(_, twin, calls)| [*twin, *calls]).collect(),
            clauses: (0..clauses.len()).collect(),
            subsumptions: Vec::new(),
        };
        let program = Program {
            sources: Arc::clone(&of.sources),
            relations: Arc::new(infos),
            names: Arc::clone(&of.names),
            clauses: clauses.into_iter().map(Arc::new).collect(),
            facts: [].into(),
            strata: [].into(),
            subsumptions: [].into(),
            limits: of.limits,
            words: Words::default(),
            warnings: [].into(),
            declared: Arc::clone(&of.declared),
        };
        Self { program, stratum, ways, given }
    }

    /// The rows of the call, and of every call that came up on the way.
    pub(super) fn evaluate(
        &self,
        demand: &Demand<'_>,
        key: &[Word],
        words: &mut Words,
    ) -> Result<Answers, EvaluateError> {
        let none = heap(1).sort();
        let mut given = vec![none; self.program.relations.len()];
        let mut seed = heap(key.len());
        seed.push(key);
        given[self.ways[0].2.index()] = seed.sort();
        let mut finished =
            Finished::new(std::mem::take(words), vec![None; given.len()], Rc::clone(&demand.watch));
        finished.outside = Some(demand);
        for (of, number) in &self.given {
            finished.rows[number.index()] = Some(demand.kept.shared(*of));
        }
        let mut evaluation = Evaluation::over(&self.program, finished, given);
        let done = evaluation.stratum(&self.stratum);
        *words = std::mem::take(&mut evaluation.finished.words);
        if let Err(error) = done {
            // How far the relation came that the rule is of: its twins overlap, and calls are no rows.
            let of_rule = |of: RelationId| error.is_of(&self.program.info(of).name);
            let twins = self.ways.iter().filter(|((of, _), ..)| of_rule(*of));
            let rows = twins.filter_map(|(_, twin, _)| {
                evaluation.reached.iter().find(|(of, _)| of == twin).map(|(_, rows)| *rows)
            });
            return Err(match rows.max() {
                Some(rows) => error.with_rows(rows),
                None => error,
            });
        }
        let mut answers = Vec::new();
        for ((of, mask), twin, calls) in &self.ways {
            let mut rows_of = |id: &RelationId| {
                let rows = evaluation.finished.rows[id.index()].take();
                rows.expect("the stratum is evaluated")
            };
            let (rows, calls) = (rows_of(twin), rows_of(calls));
            answers.push(((*of, *mask), Besides::new(calls, rows)));
        }
        Ok(answers)
    }
}

impl Builder<'_, '_> {
    /// The number of a way, made where there is none yet.
    fn way(&mut self, way: Way) -> usize {
        let known = |way: Way, ways: &[(Way, RelationId, RelationId)]| {
            ways.iter().position(|(known, ..)| *known == way)
        };
        if let Some(known) = known(way, &self.ways) {
            return known;
        }
        let way = if self.ways.len() < MAX_WAYS { way } else { (way.0, 0) };
        if let Some(known) = known(way, &self.ways) {
            return known;
        }
        let (relation, mask) = way;
        let info = self.infos[relation.index()].clone();
        let twin = RelationId(self.infos.len() as u32);
        self.infos.push(Arc::clone(&info));
        let calls = RelationId(self.infos.len() as u32);
        let columns = columns_of(mask).map(|column| info.columns[column].clone()).collect();
        let name = info.name.clone();
        self.infos.push(Arc::new(RelationInfo { name, columns, ..RelationInfo::default() }));
        self.ways.push((way, twin, calls));
        self.open.push_back(self.ways.len() - 1);
        self.ways.len() - 1
    }

    /// The clauses of a way.
    fn guard(&mut self, number: usize) {
        let ((relation, mask), twin, calls) = self.ways[number];
        if self.demand.has_given(relation) {
            self.guard_given(relation, mask, twin, calls);
        }
        for clause in self.demand.clauses_of(relation) {
            let clause = &self.demand.program.clauses[*clause];
            let (mut clause, head, _) = turned(clause, &self.infos[relation.index()].columns);
            clause.args = head.iter().map(|v| Expr::Variable(*v)).collect();
            let known: Vec<Term> =
                columns_of(mask).map(|column| Term::Variable(head[column])).collect();
            let guard = Literal::Atom(Atom { relation: calls, args: known, at: clause.at });
            let mut walk = Walk::new(&clause, self.demand, self.group);
            columns_of(mask).for_each(|column| walk.bound[head[column] as usize] = true);
            let order = walk.order();
            let mut before = vec![guard.clone()];
            let mut body = vec![guard];
            for (at, mask) in order {
                let mut literal = clause.body[at].clone();
                if let (Literal::Atom(atom), Some(mask)) = (&mut literal, mask) {
                    let way = self.way((atom.relation, mask));
                    let ((_, mask), twin, calls) = self.ways[way];
                    self.call(&clause, atom, mask, calls, &before);
                    atom.relation = twin;
                }
                before.push(literal.clone());
                body.push(literal);
            }
            self.clauses.push(Clause { head: twin, body, ..clause });
        }
    }

    fn guard_given(
        &mut self,
        relation: RelationId,
        mask: Mask,
        twin: RelationId,
        calls: RelationId,
    ) {
        let info = self.infos[relation.index()].clone();
        let known = self.given.iter().find(|(of, _)| *of == relation).map(|(_, number)| *number);
        let number = known.unwrap_or_else(|| {
            let number = RelationId(self.infos.len() as u32);
            self.infos.push(Arc::clone(&info));
            self.given.push((relation, number));
            number
        });
        let variables = info
            .columns
            .iter()
            .map(|column| super::program::Variable { name: String::new(), kind: column.kind });
        let at = self.demand.program.clauses[self.demand.clauses_of(relation)[0]].at;
        let all = 0..info.columns.len() as u32;
        let known = columns_of(mask).map(|column| Term::Variable(column as u32)).collect();
        let of = all.clone().map(Term::Variable).collect();
        self.clauses.push(Clause {
            head: twin,
            args: all.map(Expr::Variable).collect(),
            body: vec![
                Literal::Atom(Atom { relation: calls, args: known, at }),
                Literal::Atom(Atom { relation: number, args: of, at }),
            ],
            variables: variables.collect(),
            at,
        });
    }

    /// How the atom is called by what comes before it.
    fn call(
        &mut self,
        clause: &Clause,
        atom: &Atom,
        mask: Mask,
        calls: RelationId,
        before: &[Literal],
    ) {
        let value = |column: usize| match atom.args[column] {
            Term::Constant(word) => Some(Expr::Constant(word)),
            Term::Variable(v) => Some(Expr::Variable(v)),
            Term::Any => None,
        };
        // What is known has a value.
        let args: Vec<Expr> = columns_of(mask).filter_map(value).collect();
        // call(x) :- call(x).
        let says_nothing = matches!(before, [Literal::Atom(guard)] if guard.relation == calls
            && guard.args.iter().zip(&args).all(|pair| matches!(pair, (Term::Variable(a), Expr::Variable(b)) if a == b)));
        if !says_nothing {
            let (body, variables, at) = (before.to_vec(), clause.variables.clone(), clause.at);
            self.clauses.push(Clause { head: calls, args, body, variables, at });
        }
    }
}

/// The order in which a body's literals are thought to be met: what needs nothing more first, then what is reached by
/// known values, recursive atoms behind others.
struct Walk<'a, 'd> {
    clause: &'a Clause,
    demand: &'a Demand<'d>,
    group: &'a [RelationId],
    bound: Vec<bool>,
    /// Computed from values of the call: such a value may not make a further call, for that could go on without end
    /// where evaluation ends.
    made: Vec<bool>,
}

impl<'a, 'd> Walk<'a, 'd> {
    fn new(clause: &'a Clause, demand: &'a Demand<'d>, group: &'a [RelationId]) -> Self {
        let none = vec![false; clause.variables.len()];
        Self { clause, demand, group, bound: none.clone(), made: none }
    }

    fn known(&self, atom: &Atom) -> Mask {
        let is_known = |term: &Term| match term {
            Term::Any => false,
            Term::Constant(_) => true,
            Term::Variable(v) => {
                let is_own = self.group.contains(&atom.relation);
                self.bound[*v as usize] && !(is_own && self.made[*v as usize])
            }
        };
        let columns = atom.args.iter().enumerate().filter(|(_, term)| is_known(term));
        columns.fold(0, |mask, (column, _)| mask | 1 << column)
    }

    /// Positions in the body; recursive atoms with their known columns.
    fn order(mut self) -> Vec<(usize, Option<Mask>)> {
        let body = &self.clause.body;
        let mut open: Vec<usize> = (0..body.len()).collect();
        let mut order = Vec::with_capacity(open.len());
        while !open.is_empty() {
            let ready = open.iter().position(|n| self.is_ready(&body[*n]));
            let next = ready.or_else(|| {
                let ways = open.iter().enumerate().filter_map(|(at, n)| {
                    let Literal::Atom(atom) = &body[*n] else { return None };
                    let mask = self.known(atom);
                    let columns: Vec<usize> = columns_of(mask).collect();
                    let is_own = self.group.contains(&atom.relation);
                    let is_free = mask == 0 && !atom.args.is_empty();
                    let fan_out = self.demand.fan_out(atom.relation, &columns).unwrap_or(0.0);
                    fan_out.is_finite().then_some((at, is_free, is_own))
                });
                ways.min_by_key(|(_, is_free, is_own)| (*is_free, *is_own)).map(|(at, ..)| at)
            });
            // A computed relation that cannot be asked so: the planner says so.
            let is_atom = |n: &usize| matches!(body[*n], Literal::Atom(_));
            let at = next.or_else(|| open.iter().position(is_atom)).unwrap_or(0);
            let n = open.remove(at);
            let mask = match &body[n] {
                Literal::Atom(atom) if self.group.contains(&atom.relation) => {
                    Some(self.known(atom))
                }
                _ => None,
            };
            self.trace(&body[n]);
            let bound = &mut self.bound;
            match &body[n] {
                Literal::Aggregate(aggregate) => bound[aggregate.target as usize] = true,
                Literal::Not(_) => {}
                literal => used_variables(std::slice::from_ref(literal), None, &mut |v| {
                    bound[v as usize] = true;
                }),
            }
            order.push((n, mask));
        }
        order
    }

    /// Which variables a literal is about to make, and which it finds among finitely many.
    fn trace(&mut self, literal: &Literal) {
        match literal {
            Literal::Atom(atom) => {
                let is_finite =
                    self.group.contains(&atom.relation) || self.demand.is_finite(atom.relation);
                for term in &atom.args {
                    if let Term::Variable(v) = term {
                        let at = *v as usize;
                        self.made[at] = !is_finite && (self.made[at] || !self.bound[at]);
                    }
                }
            }
            Literal::Compare(compare) => {
                for (one, other) in
                    [(&compare.left, &compare.right), (&compare.right, &compare.left)]
                {
                    let Expr::Variable(v) = one else { continue };
                    if self.bound[*v as usize] || compare.op != Comparison::Equal {
                        continue;
                    }
                    self.made[*v as usize] = match other {
                        Expr::Variable(from) => self.made[*from as usize],
                        Expr::Constant(_) => false,
                        Expr::Call(..) => true,
                    };
                }
            }
            Literal::Range(range) => {
                let at = range.target as usize;
                self.made[at] |= !self.bound[at];
            }
            Literal::Aggregate(aggregate) => {
                let at = aggregate.target as usize;
                self.made[at] |= !self.bound[at];
            }
            Literal::Not(_) => {}
        }
    }

    fn is_ready(&self, literal: &Literal) -> bool {
        let is_known = |expr: &Expr| expr.all_variables(|v| self.bound[v as usize]);
        match literal {
            Literal::Atom(_) => false,
            Literal::Not(atom) => atom.args.iter().all(|term| match term {
                Term::Variable(v) => self.bound[*v as usize],
                _ => true,
            }),
            Literal::Compare(compare) => {
                match (is_known(&compare.left), is_known(&compare.right)) {
                    (true, true) => true,
                    (true, false) => {
                        compare.op == Comparison::Equal
                            && matches!(compare.right, Expr::Variable(_))
                    }
                    (false, true) => {
                        compare.op == Comparison::Equal && matches!(compare.left, Expr::Variable(_))
                    }
                    (false, false) => false,
                }
            }
            Literal::Range(range) => range.bounds.exprs().all(is_known),
            Literal::Aggregate(aggregate) => {
                aggregate.shared.iter().all(|v| self.bound[*v as usize])
            }
        }
    }
}
