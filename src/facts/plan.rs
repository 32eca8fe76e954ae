//! The order in which a body is joined: small relations and bound columns first, filters as soon as they can run.
//!
//! The order is chosen by estimated sizes: of each way to start, the one whose partial results sum up to least.
//! A comparison of a bound value with a value computed from one atom's row alone becomes part of that
//! atom's index (an equality) or a filter over the index's column (any other).

use std::collections::HashMap;

use super::filter::ColumnFilter;
use super::growing::Version;
use super::program::{
    Aggregate, Atom, Clause, Compare, Expr, Literal, NumberRange, Term, VariableId, used_variables,
};
use super::relations::RelationId;
use super::step::{Scan, Step};
use super::syntax::Comparison;
use super::value;
use super::word::{Word, Words};

/// A source that a plan reads; the evaluation provides it.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Request {
    /// Rows in the relation's own order, searched by their first columns; slots are columns.
    Whole(RelationId),
    /// Slots are the positions in `columns`.
    Index { relation: RelationId, key: Vec<Expr>, columns: Vec<Expr> },
    /// Rows with the columns in the given order first; slots are positions in the turned row.
    Growing { relation: RelationId, version: Version, first: Vec<usize> },
}

#[derive(Debug, Clone, Default)]
pub(super) struct Plan {
    pub(super) steps: Vec<Step>,
    pub(super) requests: Vec<Request>,
    /// Whether its first rows may be divided among threads.
    pub(super) can_spread: bool,
}

impl Plan {
    /// Makes every solution count, also those that differ only in what the goal does not read.
    pub(super) fn count_all(&mut self) {
        for step in &mut self.steps {
            if let Step::Scan(scan) = step {
                scan.once = false;
                scan.counts = true;
            }
        }
    }
}

/// Sizes as far as they are known.
pub(super) trait Statistics {
    fn size(&self, relation: RelationId) -> f64;
    /// Different words in a column.
    fn distinct(&self, relation: RelationId, column: usize) -> f64;
    /// The share of rows whose column's word passes.
    fn share(&self, _: RelationId, _: usize, _: &dyn Fn(Word, &Words) -> bool) -> f64 {
        UNKNOWN_SHARE
    }
    /// Whether indexes may be ordered by what is computed from rows.
    fn computes_keys(&self) -> bool {
        true
    }
    /// Rows for one look-up with these columns known, where that is not a matter of sizes; infinite where the relation
    /// cannot be asked so.
    fn fan_out(&self, _: RelationId, _: &[usize]) -> Option<f64> {
        None
    }
}

/// What is taken for the share of rows that pass a comparison of which nothing is known.
pub(super) const UNKNOWN_SHARE: f64 = 0.5;

/// What is taken for the length of a range.
const UNKNOWN_RANGE: f64 = 30.0;

/// What a plan is to be made for.
pub(super) struct Task<'a> {
    pub(super) clause: &'a Clause,
    /// For each literal of the body; ignored for those that are no atoms.
    pub(super) versions: &'a [Version],
    /// The atom to start with.
    pub(super) first: Option<usize>,
    /// Variables that have a value before the run.
    pub(super) bound: &'a [VariableId],
    /// Variables whose values the goal reads.
    pub(super) wanted: &'a [VariableId],
}

/// The plan for a task whose relations can all be asked as it comes.
pub(super) fn plan(task: &Task<'_>, statistics: &dyn Statistics) -> Plan {
    plan_with_cost(task, statistics).0
}

/// With it how many partial results there will be, roughly; infinite where some relation cannot be asked in any order.
pub(super) fn plan_with_cost(task: &Task<'_>, statistics: &dyn Statistics) -> (Plan, f64) {
    let body = &task.clause.body;
    let atoms: Vec<usize> =
        (0..body.len()).filter(|n| matches!(body[*n], Literal::Atom(_))).collect();
    let is_wanted = wanted(task, body, None);
    let starts: Vec<Option<usize>> = match task.first {
        Some(first) => vec![Some(first)],
        // Trying every start costs the cube of the atoms.
        None if (2..=12).contains(&atoms.len()) => atoms.iter().copied().map(Some).collect(),
        None => vec![None],
    };
    let plans = starts.into_iter().map(|first| {
        let mut draft = Draft::new(task, statistics, is_wanted.clone());
        draft.lay(body, task.versions, first);
        draft
    });
    let best = plans.min_by(|a, b| a.cost.total_cmp(&b.cost));
    let Draft { mut plan, cost, .. } = best.expect("there is at least one way to start");
    plan.steps.push(Step::Reached);
    mark_once(&mut plan.steps, task.wanted);
    (plan, cost)
}

/// How often each variable is read: by the goal, and by each literal.
fn wanted(task: &Task<'_>, body: &[Literal], value: Option<&Expr>) -> HashMap<VariableId, usize> {
    let mut uses = HashMap::new();
    task.wanted.iter().for_each(|v| *uses.entry(*v).or_insert(0) += 1);
    used_variables(body, value, &mut |v| *uses.entry(v).or_insert(0) += 1);
    uses
}

/// A scan may stop at its first success when nothing that it or a later step sets is read by the goal.
fn mark_once(steps: &mut [Step], wanted: &[VariableId]) {
    let mut sets_wanted = false;
    let mut n = steps.len();
    while n > 0 {
        n -= 1;
        match &mut steps[n] {
            Step::Scan(scan) => {
                sets_wanted |= scan.loads.iter().any(|(_, v)| wanted.contains(v));
                scan.once = !sets_wanted;
            }
            Step::Let { register, .. } | Step::Each { register, .. } => {
                sets_wanted |= wanted.contains(register);
            }
            Step::Aggregate { register, .. } => sets_wanted |= wanted.contains(register),
            _ => {}
        }
    }
    // Within an aggregate every solution counts.
    let mut n = 0;
    while n < steps.len() {
        if let Step::Aggregate { end, .. } = steps[n] {
            for step in &mut steps[n + 1..end] {
                if let Step::Scan(scan) = step {
                    scan.once = false;
                    scan.counts = true;
                }
            }
        }
        n += 1;
    }
}

/// A plan under construction.
struct Draft<'a> {
    task: &'a Task<'a>,
    statistics: &'a dyn Statistics,
    plan: Plan,
    bound: Vec<bool>,
    /// Uses of each variable that are still to come.
    uses: HashMap<VariableId, usize>,
    /// Estimated solutions so far, and the sum of those of all steps.
    solutions: f64,
    cost: f64,
}

/// A way to scan an atom next.
struct Access<'a> {
    /// Columns, or expressions over columns, with the value that each must have.
    key: Vec<(Expr, Expr)>,
    /// Equalities that the key takes care of.
    taken: Vec<usize>,
    atom: &'a Atom,
    /// Estimated rows for one solution so far.
    fan_out: f64,
}

impl<'a> Draft<'a> {
    fn new(
        task: &'a Task<'a>,
        statistics: &'a dyn Statistics,
        uses: HashMap<VariableId, usize>,
    ) -> Self {
        let mut bound = vec![false; task.clause.variables.len()];
        task.bound.iter().for_each(|v| bound[*v as usize] = true);
        Self { task, statistics, plan: Plan::default(), bound, uses, solutions: 1.0, cost: 0.0 }
    }

    fn is_known(&self, expr: &Expr) -> bool {
        expr.all_variables(|v| self.bound[v as usize])
    }

    /// Places all literals of a body.
    fn lay(&mut self, body: &'a [Literal], versions: &[Version], first: Option<usize>) {
        let mut open: Vec<usize> = (0..body.len()).collect();
        let mut first = first;
        while !open.is_empty() {
            self.lay_ready(body, &mut open);
            if open.is_empty() {
                break;
            }
            if self.lay_needed_aggregate(body, &mut open) {
                continue;
            }
            let next = first.take().or_else(|| {
                let fan_out = |n: usize| match &body[n] {
                    Literal::Atom(_) => Some(
                        self.access(body, n, versions[n], &open).map_or(f64::MAX, |a| a.fan_out),
                    ),
                    Literal::Range(range) => self.range_fan_out(range),
                    _ => None,
                };
                let ways = open.iter().filter_map(|n| Some((*n, fan_out(*n)?)));
                ways.min_by(|a, b| a.1.total_cmp(&b.1)).map(|(n, _)| n)
            });
            match next {
                Some(n) if matches!(body[n], Literal::Range(_)) => {
                    self.lay_range(&body[n]);
                    open.retain(|other| *other != n);
                }
                Some(n) => self.lay_atom(body, n, versions[n], &mut open),
                None => {
                    let before = open.len();
                    self.lay_any_aggregate(body, &mut open);
                    assert!(open.len() < before, "a checked clause binds every variable");
                }
            }
        }
    }

    /// Places every comparison and negation whose variables have values, again until nothing changes.
    fn lay_ready(&mut self, body: &'a [Literal], open: &mut Vec<usize>) {
        let mut n = 0;
        while n < open.len() {
            let literal = &body[open[n]];
            let laid = match literal {
                Literal::Compare(compare) => self.lay_compare(compare),
                Literal::Not(atom) => self.lay_absent(atom),
                Literal::Range(range) => self.lay_known_range(range),
                Literal::Atom(_) | Literal::Aggregate(_) => false,
            };
            if laid {
                open.remove(n);
                self.spend(literal);
                n = 0;
            } else {
                n += 1;
            }
        }
    }

    fn lay_compare(&mut self, compare: &Compare) -> bool {
        let step = match (self.is_known(&compare.left), self.is_known(&compare.right)) {
            (true, true) => {
                self.solutions *= if compare.op == Comparison::Equal { 0.1 } else { 0.5 };
                Step::Filter(compare.clone())
            }
            (false, true) => match (&compare.left, compare.op) {
                (Expr::Variable(v), Comparison::Equal) => {
                    Step::Let { register: *v, value: compare.right.clone() }
                }
                _ => return false,
            },
            (true, false) => match (&compare.right, compare.op) {
                (Expr::Variable(v), Comparison::Equal) => {
                    Step::Let { register: *v, value: compare.left.clone() }
                }
                _ => return false,
            },
            (false, false) => return false,
        };
        if let Step::Let { register, .. } = &step {
            self.bound[*register as usize] = true;
        }
        self.plan.steps.push(step);
        true
    }

    /// A range whose variable has its value already.
    fn lay_known_range(&mut self, range: &NumberRange) -> bool {
        let is_known = self.bound[range.target as usize]
            && range.bounds.exprs().all(|expr| self.is_known(expr));
        if is_known {
            let (register, bounds) = (range.target, range.bounds.clone());
            self.plan.steps.push(Step::Each { register, bounds, is_known });
            self.solutions *= 0.5;
        }
        is_known
    }

    /// Numbers for one solution so far, roughly; none while a bound is unknown.
    fn range_fan_out(&self, range: &NumberRange) -> Option<f64> {
        let is_ready = range.bounds.exprs().all(|expr| self.is_known(expr));
        is_ready.then_some(UNKNOWN_RANGE)
    }

    fn lay_range(&mut self, literal: &Literal) {
        let Literal::Range(range) = literal else { return };
        let (register, bounds) = (range.target, range.bounds.clone());
        self.plan.steps.push(Step::Each { register, bounds, is_known: false });
        self.bound[register as usize] = true;
        self.solutions *= UNKNOWN_RANGE;
        self.cost += self.solutions;
        self.spend(literal);
    }

    fn lay_absent(&mut self, atom: &Atom) -> bool {
        let known = |term: &Term| !matches!(term, Term::Variable(v) if !self.bound[*v as usize]);
        if !atom.args.iter().all(known) {
            return false;
        }
        let mut key = Vec::new();
        let mut values = Vec::new();
        for (column, term) in atom.args.iter().enumerate() {
            if let Some(value) = term_value(*term) {
                key.push(Expr::Variable(column as u32));
                values.push(value);
            }
        }
        let columns: Vec<usize> = key.iter().filter_map(plain_column).collect();
        if let Some(known) = self.statistics.fan_out(atom.relation, &columns) {
            self.cost += if known.is_finite() { 0.0 } else { f64::INFINITY };
        }
        let source = self.request_index(atom.relation, key, Vec::new()).0;
        self.plan.steps.push(Step::Absent { source, key: values });
        self.solutions *= 0.5;
        true
    }

    /// An aggregate that is ready and whose value an atom can be looked up with.
    fn lay_needed_aggregate(&mut self, body: &'a [Literal], open: &mut Vec<usize>) -> bool {
        let in_atom = |v: VariableId| {
            let mut atoms = open.iter().map(|n| &body[*n]);
            atoms
                .any(|l| matches!(l, Literal::Atom(atom) if atom.args.contains(&Term::Variable(v))))
        };
        // N = count : { … }, r(N) reads T = count : { … }, N = T, r(N).
        let is_needed = |aggregate: &Aggregate| {
            let target = Expr::Variable(aggregate.target);
            open.iter().any(|n| match &body[*n] {
                Literal::Compare(Compare { op: Comparison::Equal, left, right, .. }) => {
                    match (left, right) {
                        (Expr::Variable(v), other) | (other, Expr::Variable(v))
                            if *other == target =>
                        {
                            !self.bound[*v as usize] && in_atom(*v)
                        }
                        _ => false,
                    }
                }
                _ => false,
            })
        };
        let ready = open.iter().position(|n| match &body[*n] {
            Literal::Aggregate(aggregate) => self.is_ready(aggregate) && is_needed(aggregate),
            _ => false,
        });
        ready.map(|at| self.lay_aggregate(body, open, at)).is_some()
    }

    fn lay_any_aggregate(&mut self, body: &'a [Literal], open: &mut Vec<usize>) {
        let ready = open.iter().position(|n| match &body[*n] {
            Literal::Aggregate(aggregate) => self.is_ready(aggregate),
            _ => false,
        });
        if let Some(at) = ready {
            self.lay_aggregate(body, open, at);
        }
    }

    fn is_ready(&self, aggregate: &Aggregate) -> bool {
        aggregate.shared.iter().all(|v| self.bound[*v as usize])
    }

    fn lay_aggregate(&mut self, body: &'a [Literal], open: &mut Vec<usize>, at: usize) {
        let literal = &body[open.remove(at)];
        let Literal::Aggregate(aggregate) = literal else { return };
        self.spend(literal);
        let start = self.plan.steps.len();
        let (function, value) = (aggregate.function, aggregate.value.clone());
        let target = aggregate.target;
        self.plan.steps.push(Step::Aggregate {
            function,
            kind: aggregate.kind,
            value: value.clone(),
            register: target,
            is_known: self.bound[target as usize],
            end: 0,
        });
        let outer = (self.solutions, self.bound.clone(), self.uses.clone());
        let versions = vec![Version::Finished; aggregate.body.len()];
        self.uses = wanted(self.task, &aggregate.body, value.as_ref());
        self.lay(&aggregate.body, &versions, None);
        (self.solutions, self.bound, self.uses) = outer;
        self.plan.steps.push(Step::Reached);
        let behind = self.plan.steps.len();
        if let Step::Aggregate { end, .. } = &mut self.plan.steps[start] {
            *end = behind;
        }
        self.bound[target as usize] = true;
    }

    /// The literal's own uses of variables are over.
    fn spend(&mut self, literal: &Literal) {
        let uses = &mut self.uses;
        used_variables(std::slice::from_ref(literal), None, &mut |v| {
            if let Some(uses) = uses.get_mut(&v) {
                *uses = uses.saturating_sub(1);
            }
        });
    }

    fn access(
        &self,
        body: &'a [Literal],
        n: usize,
        version: Version,
        open: &[usize],
    ) -> Option<Access<'a>> {
        let Literal::Atom(atom) = &body[n] else { return None };
        let mut key = Vec::new();
        let mut taken = Vec::new();
        for (column, term) in atom.args.iter().enumerate() {
            let is_bound = |v: VariableId| self.bound[v as usize];
            match term {
                Term::Variable(v) if !is_bound(*v) => {}
                _ => key
                    .extend(term_value(*term).map(|value| (Expr::Variable(column as u32), value))),
            }
        }
        if version == Version::Finished && self.statistics.computes_keys() {
            for other in open {
                let Literal::Compare(compare) = &body[*other] else { continue };
                if compare.op == Comparison::Equal
                    && let Some((column, _, value)) = self.separate(compare, atom)
                    && key.len() < super::declared::MAX_COLUMNS
                {
                    key.push((column, value));
                    taken.push(*other);
                }
            }
        }
        let mut fan_out = self.statistics.size(atom.relation);
        for (column, _) in &key {
            fan_out /= match column {
                Expr::Variable(column) => self.statistics.distinct(atom.relation, *column as usize),
                _ => 10.0,
            };
        }
        if key.len() == atom.args.len() {
            fan_out = fan_out.min(1.0);
        }
        if version == Version::Recent {
            fan_out /= 10.0;
        }
        let columns: Vec<usize> =
            key.iter().filter_map(|(column, _)| plain_column(column)).collect();
        if let Some(known) = self.statistics.fan_out(atom.relation, &columns) {
            fan_out = known;
        }
        Some(Access { key, taken, atom, fan_out })
    }

    /// A comparison as `expression over the atom's columns, op, known value`, where it is one.
    fn separate(&self, compare: &Compare, atom: &Atom) -> Option<(Expr, Comparison, Expr)> {
        let of_atom = |expr: &Expr| {
            let is_own = |v| !self.bound[v as usize] && atom.args.contains(&Term::Variable(v));
            (expr.has_variables() && expr.all_variables(is_own)).then(|| over_columns(expr, atom))
        };
        if self.is_known(&compare.right)
            && let Some(column) = of_atom(&compare.left)
        {
            return Some((column, compare.op, compare.right.clone()));
        }
        if self.is_known(&compare.left)
            && let Some(column) = of_atom(&compare.right)
        {
            return Some((column, compare.op.mirrored()?, compare.left.clone()));
        }
        None
    }

    fn lay_atom(&mut self, body: &'a [Literal], n: usize, version: Version, open: &mut Vec<usize>) {
        let Some(Access { key, taken, atom, fan_out }) = self.access(body, n, version, open) else {
            return;
        };
        open.retain(|other| *other != n && !taken.contains(other));
        self.spend(&body[n]);
        taken.iter().for_each(|other| self.spend(&body[*other]));
        let probes = self.solutions;
        self.solutions *= fan_out.max(1e-6);
        self.cost += self.solutions;
        // Filters over computed columns pay off where a key brings many rows at once; without one, the column would
        // be computed for rows of which each is looked at once.
        let mut filters = Vec::new();
        if version == Version::Finished {
            open.retain(|other| {
                let Literal::Compare(compare) = &body[*other] else { return true };
                let Some(filter) = self.separate(compare, atom) else { return true };
                if key.is_empty() && plain_column(&filter.0).is_none() {
                    return true;
                }
                filters.push((*other, filter, compare.kind.is_number()));
                false
            });
        }
        for (other, (column, op, value), is_number) in &filters {
            self.spend(&body[*other]);
            self.solutions *= match (plain_column(column), value) {
                (Some(column), Expr::Constant(word)) => {
                    let holds = |known: Word, words: &Words| {
                        value::holds(*op, *is_number, known, *word, words)
                    };
                    self.statistics.share(atom.relation, column, &holds)
                }
                _ => UNKNOWN_SHARE,
            };
        }
        let (columns, values): (Vec<Expr>, Vec<Expr>) = key.into_iter().unzip();
        let mut scan = Scan { key: values, ..Scan::default() };
        let mut slots: Vec<Expr> = Vec::new();
        let mut slot = |column: Expr| {
            slots.iter().position(|known| *known == column).unwrap_or_else(|| {
                slots.push(column);
                slots.len() - 1
            })
        };
        for (_, (column, op, value), is_number) in filters {
            scan.filters.push(ColumnFilter { column: slot(column), op, value, is_number });
        }
        for (column, term) in atom.args.iter().enumerate() {
            let Term::Variable(v) = *term else { continue };
            if self.bound[v as usize] && !scan.loads.iter().any(|(_, loaded)| *loaded == v) {
                continue;
            }
            let is_repeated = atom.args[column + 1..].contains(term);
            if scan.loads.iter().any(|(_, loaded)| *loaded == v) {
                scan.same.push((slot(Expr::Variable(column as u32)), v));
            } else if is_repeated || self.uses.get(&v).is_some_and(|uses| *uses > 0) {
                scan.loads.push((slot(Expr::Variable(column as u32)), v));
                self.bound[v as usize] = true;
            }
        }
        self.request(atom.relation, version, columns, slots, &mut scan, probes);
        self.plan.steps.push(Step::Scan(scan));
    }

    /// Finds the scan its source and turns its slots into the source's.
    fn request(
        &mut self,
        relation: RelationId,
        version: Version,
        key: Vec<Expr>,
        slots: Vec<Expr>,
        scan: &mut Scan,
        probes: f64,
    ) {
        let is_natural = key.iter().enumerate().all(|(n, c)| *c == Expr::Variable(n as u32));
        // A few searches in the relation's own order cost less than an index.
        let few = probes * 32.0 < self.statistics.size(relation);
        let is_plain =
            scan.filters.iter().all(|filter| plain_column(&slots[filter.column]).is_some());
        let place: Vec<usize> = match version {
            Version::Finished if is_plain && (key.is_empty() || is_natural && few) => {
                scan.source = self.source(Request::Whole(relation));
                slots.iter().filter_map(plain_column).collect()
            }
            Version::Finished => {
                let (source, place) = self.request_index(relation, key, slots);
                scan.source = source;
                place
            }
            _ => {
                let first: Vec<usize> = key.iter().filter_map(plain_column).collect();
                let turned = |column: usize| match first.iter().position(|c| *c == column) {
                    Some(at) => at,
                    None => first.len() + (0..column).filter(|c| !first.contains(c)).count(),
                };
                let place = slots.iter().filter_map(plain_column).map(turned).collect();
                scan.source = self.source(Request::Growing { relation, version, first });
                place
            }
        };
        scan.filters.iter_mut().for_each(|filter| filter.column = place[filter.column]);
        scan.loads.iter_mut().for_each(|(slot, _)| *slot = place[*slot]);
        scan.same.iter_mut().for_each(|(slot, _)| *slot = place[*slot]);
    }

    /// The number of the index and the places of the wanted columns among its columns.
    fn request_index(
        &mut self,
        relation: RelationId,
        key: Vec<Expr>,
        wanted: Vec<Expr>,
    ) -> (usize, Vec<usize>) {
        let known = self.plan.requests.iter().position(|request| match request {
            Request::Index { relation: r, key: k, .. } => *r == relation && *k == key,
            _ => false,
        });
        let source = known.unwrap_or_else(|| {
            self.plan.requests.push(Request::Index { relation, key, columns: Vec::new() });
            self.plan.requests.len() - 1
        });
        let Request::Index { columns, .. } = &mut self.plan.requests[source] else {
            return (source, Vec::new());
        };
        let mut place = Vec::with_capacity(wanted.len());
        for column in wanted {
            place.push(columns.iter().position(|known| *known == column).unwrap_or_else(|| {
                columns.push(column);
                columns.len() - 1
            }));
        }
        (source, place)
    }

    fn source(&mut self, request: Request) -> usize {
        let known = self.plan.requests.iter().position(|known| *known == request);
        known.unwrap_or_else(|| {
            self.plan.requests.push(request);
            self.plan.requests.len() - 1
        })
    }
}

fn plain_column(expr: &Expr) -> Option<usize> {
    match expr {
        Expr::Variable(column) => Some(*column as usize),
        _ => None,
    }
}

fn term_value(term: Term) -> Option<Expr> {
    match term {
        Term::Any => None,
        Term::Variable(v) => Some(Expr::Variable(v)),
        Term::Constant(word) => Some(Expr::Constant(word)),
    }
}

/// The expression with each variable replaced by the column of the atom that it stands in.
fn over_columns(expr: &Expr, atom: &Atom) -> Expr {
    match expr {
        Expr::Variable(v) => {
            let column = atom.args.iter().position(|term| *term == Term::Variable(*v));
            Expr::Variable(column.expect("the caller has found every variable in the atom") as u32)
        }
        Expr::Constant(word) => Expr::Constant(*word),
        Expr::Call(functor, args) => {
            Expr::Call(*functor, args.iter().map(|arg| over_columns(arg, atom)).collect())
        }
    }
}
