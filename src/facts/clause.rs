//! A rule of the text to clauses: one for each head and each choice of its disjunctions,
//! over numbered variables with known kinds, each bound by something.

use std::collections::HashMap;

use super::check::{Declared, kind_name};
use super::fault::RuleError;
use super::program::{
    Aggregate, Atom, Clause, Compare, Expr, Found, Kind, Literal, Term, Variable, VariableId,
};
use super::syntax::{self, Aggregation, Body, Comparison, Functor, Rule, Span};
use super::word::Words;

/// Choices of a rule's disjunctions, multiplied out.
const MAX_CHOICES: usize = 256;
const MAX_PREMISES: usize = 256;

pub(super) fn clauses(
    rule: &Rule,
    declared: &Declared,
    words: &mut Words,
    faults: &mut Found,
) -> Vec<Clause> {
    let Some(choices) = choices(&rule.body, true) else {
        let (what, limit, at) = ("вариантов у правила", MAX_CHOICES, rule.at.into());
        faults.push(rule.at, RuleError::TooLarge { what, limit, at });
        return Vec::new();
    };
    let mut clauses = Vec::new();
    for head in &rule.heads {
        for choice in &choices {
            if choice.len() > MAX_PREMISES {
                let (what, limit, at) = ("посылок у правила", MAX_PREMISES, rule.at.into());
                faults.push(rule.at, RuleError::TooLarge { what, limit, at });
                continue;
            }
            let mut builder =
                Builder { declared, words, faults, variables: Vec::new(), is_sound: true };
            clauses.extend(builder.clause(head, choice, rule.at));
        }
    }
    clauses
}

/// A premise without disjunction.
#[derive(Debug, Clone)]
enum Premise<'a> {
    Atom(&'a syntax::Atom),
    Not(&'a syntax::Atom),
    Compare { op: Comparison, left: &'a syntax::Expr, right: &'a syntax::Expr, at: Span },
}

/// The disjunctive form of a body, or of its negation; none when it is too large.
fn choices(body: &Body, is_positive: bool) -> Option<Vec<Vec<Premise<'_>>>> {
    Some(match body {
        Body::Not(part) => choices(part, !is_positive)?,
        Body::Atom(atom) => {
            vec![vec![if is_positive { Premise::Atom(atom) } else { Premise::Not(atom) }]]
        }
        Body::Compare { op, left, right, at } => {
            let op = if is_positive { *op } else { op.negated() };
            vec![vec![Premise::Compare { op, left, right, at: *at }]]
        }
        Body::Any(parts) if is_positive => either(parts, is_positive)?,
        Body::All(parts) if !is_positive => either(parts, is_positive)?,
        Body::All(parts) | Body::Any(parts) => {
            let mut all = vec![Vec::new()];
            for part in parts {
                let part = choices(part, is_positive)?;
                if all.len() * part.len() > MAX_CHOICES {
                    return None;
                }
                let joined = all
                    .iter()
                    .flat_map(|left| part.iter().map(move |right| [&left[..], right].concat()));
                all = joined.collect();
            }
            all
        }
    })
}

fn either(parts: &[Body], is_positive: bool) -> Option<Vec<Vec<Premise<'_>>>> {
    let mut all = Vec::new();
    for part in parts {
        all.extend(choices(part, is_positive)?);
    }
    (all.len() <= MAX_CHOICES).then_some(all)
}

/// Variables by name; a name that an enclosing scope has means that scope's variable.
type Scope = HashMap<String, VariableId>;

struct VariableType {
    name: String,
    at: Span,
    /// The declared type of the column that binds it; none until one does.
    of: Option<usize>,
    is_number: Option<bool>,
}

struct Builder<'a> {
    declared: &'a Declared,
    words: &'a mut Words,
    faults: &'a mut Found,
    variables: Vec<VariableType>,
    is_sound: bool,
}

impl Builder<'_> {
    fn clause(
        &mut self,
        head: &syntax::Atom,
        premises: &[Premise<'_>],
        at: Span,
    ) -> Option<Clause> {
        let mut scope = Scope::new();
        self.enter(premises, &head.args, None, &mut scope);
        let relation = self.declared.relation(&head.relation, self.faults);
        self.find_kinds(premises, &scope);
        let mut body = self.literals(premises, &scope);
        let mut args = Vec::with_capacity(head.args.len());
        for arg in &head.args {
            args.push(self.expr(arg, &scope, &mut body)?);
        }
        let relation = relation.filter(|relation| self.head_fits(head, *relation, &args));
        self.check_bound(&body, &args);
        let relation = relation.filter(|_| self.is_sound)?;
        let variables = self.variables.iter().map(|variable| Variable {
            name: variable.name.clone(),
            is_number: variable.is_number == Some(true),
        });
        Some(Clause { head: relation, args, body, variables: variables.collect(), at })
    }

    fn fault(&mut self, at: Span, fault: RuleError) {
        self.is_sound = false;
        self.faults.push(at, fault);
    }

    fn fresh(&mut self, name: &str, at: Span) -> VariableId {
        self.variables.push(VariableType { name: name.into(), at, of: None, is_number: None });
        (self.variables.len() - 1) as VariableId
    }

    /// Gives a number to every name at this level, not within aggregates, that no outer scope has.
    fn enter(
        &mut self,
        premises: &[Premise<'_>],
        exprs: &[syntax::Expr],
        value: Option<&syntax::Expr>,
        scope: &mut Scope,
    ) {
        let mut names = Vec::new();
        exprs.iter().chain(value).for_each(|expr| names_of(expr, &mut names));
        for premise in premises {
            match premise {
                Premise::Atom(atom) | Premise::Not(atom) => {
                    atom.args.iter().for_each(|arg| names_of(arg, &mut names));
                }
                Premise::Compare { left, right, .. } => {
                    names_of(left, &mut names);
                    names_of(right, &mut names);
                }
            }
        }
        for name in names {
            if !scope.contains_key(&name.text) {
                let id = self.fresh(&name.text, name.at);
                scope.insert(name.text.clone(), id);
            }
        }
    }

    /// Kinds by the columns that variables stand in, then by what they are compared to.
    fn find_kinds(&mut self, premises: &[Premise<'_>], scope: &Scope) {
        for premise in premises {
            if let Premise::Atom(atom) | Premise::Not(atom) = premise {
                let Some(relation) = self.declared.names.find(&atom.relation.text) else {
                    continue;
                };
                let declared = self.declared;
                for (arg, of) in atom.args.iter().zip(&declared.columns[relation.index()]) {
                    if let syntax::Expr::Variable(name) = arg {
                        let is_positive = matches!(premise, Premise::Atom(_));
                        self.give_type(scope[&name.text], *of, is_positive, name.at);
                    }
                }
            }
        }
        // Each round settles at least one variable, or nothing changes any more.
        for _ in 0..premises.len() {
            let mut changed = false;
            for premise in premises {
                if let Premise::Compare { left, right, .. } = premise {
                    let kind = self.kind_of(left, scope).or_else(|| self.kind_of(right, scope));
                    let Some(kind) = kind else { continue };
                    for side in [left, right] {
                        if let syntax::Expr::Variable(name) = side {
                            let known = &mut self.variables[scope[&name.text] as usize].is_number;
                            changed |= known.is_none();
                            known.get_or_insert(kind);
                        }
                    }
                }
            }
            if !changed {
                break;
            }
        }
    }

    fn kind_of(&self, expr: &syntax::Expr, scope: &Scope) -> Option<bool> {
        match expr {
            syntax::Expr::Variable(name) => self.variables[scope[&name.text] as usize].is_number,
            syntax::Expr::Number(..) | syntax::Expr::Aggregate { .. } => Some(true),
            syntax::Expr::Text(..) => Some(false),
            syntax::Expr::Call { functor, .. } => Some(functor.is_number()),
            syntax::Expr::Any(_) => None,
        }
    }

    /// A variable may stand in columns of several types when one of them is part of the others.
    fn give_type(&mut self, variable: VariableId, of: usize, is_positive: bool, at: Span) {
        let kind = self.declared.types[of].kind;
        let known = &mut self.variables[variable as usize];
        let name = known.name.clone();
        let before = known.of;
        let fits = match (known.is_number, before) {
            (Some(is_number), _) if is_number != kind.is_number() => false,
            (_, Some(before)) if !kind.is_number() || is_user_type(before) || is_user_type(of) => {
                self.declared.is_subtype(before, of) || self.declared.is_subtype(of, before)
            }
            _ => true,
        };
        if !fits {
            let expected = self.declared.types[of].name.clone();
            let found = before.map_or_else(
                || if kind.is_number() { "symbol" } else { "number" }.to_owned(),
                |before| self.declared.types[before].name.clone(),
            );
            self.fault(at, RuleError::Types { what: name, expected, found, at: at.into() });
            return;
        }
        known.is_number = Some(kind.is_number());
        if is_positive && before.is_none_or(|before| self.declared.is_subtype(of, before)) {
            self.variables[variable as usize].of = Some(of);
        }
    }

    fn literals(&mut self, premises: &[Premise<'_>], scope: &Scope) -> Vec<Literal> {
        let mut body = Vec::with_capacity(premises.len());
        for premise in premises {
            match premise {
                Premise::Atom(atom) => {
                    if let Some(atom) = self.atom(atom, scope, &mut body) {
                        body.push(Literal::Atom(atom));
                    }
                }
                Premise::Not(atom) => {
                    if let Some(atom) = self.atom(atom, scope, &mut body) {
                        body.push(Literal::Not(atom));
                    }
                }
                Premise::Compare { op, left, right, at } => {
                    self.compare(*op, left, right, *at, scope, &mut body);
                }
            }
        }
        body
    }

    fn atom(
        &mut self,
        atom: &syntax::Atom,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<Atom> {
        let Some(relation) = self.declared.relation(&atom.relation, self.faults) else {
            self.is_sound = false;
            return None;
        };
        let declared = self.declared;
        let columns = &declared.relations[relation.index()].columns;
        if !self.has_arity(atom, columns.len()) {
            return None;
        }
        let mut args = Vec::with_capacity(columns.len());
        for (arg, column) in atom.args.iter().zip(columns) {
            args.push(match arg {
                syntax::Expr::Any(_) => Term::Any,
                syntax::Expr::Variable(name) => Term::Variable(scope[&name.text]),
                _ => match self.expr(arg, scope, body)? {
                    Expr::Constant(word) => {
                        self.expect(arg, column.kind, scope);
                        Term::Constant(word)
                    }
                    // r(X + 1) reads r(V), V = X + 1.
                    value => {
                        self.expect(arg, column.kind, scope);
                        let variable = self.fresh("", arg.at());
                        let is_number = column.kind.is_number();
                        self.variables[variable as usize].is_number = Some(is_number);
                        let (left, op) = (Expr::Variable(variable), Comparison::Equal);
                        let compare = Compare { op, left, right: value, is_number, at: arg.at() };
                        body.push(Literal::Compare(compare));
                        Term::Variable(variable)
                    }
                },
            });
        }
        Some(Atom { relation, args, at: atom.at })
    }

    fn has_arity(&mut self, atom: &syntax::Atom, expected: usize) -> bool {
        let found = atom.args.len();
        if found != expected {
            let (name, at) = (atom.relation.text.clone(), atom.at.into());
            self.fault(atom.at, RuleError::Arity { name, expected, found, at });
        }
        found == expected
    }

    fn compare(
        &mut self,
        op: Comparison,
        left: &syntax::Expr,
        right: &syntax::Expr,
        at: Span,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) {
        let kinds = (self.kind_of(left, scope), self.kind_of(right, scope));
        let is_contains = matches!(op, Comparison::Contains | Comparison::NotContains);
        if let (Some(of_left), Some(of_right)) = kinds
            && (of_left != of_right || is_contains && of_left)
        {
            let wanted = if is_contains { false } else { of_left };
            let wrong = if of_right == wanted { left } else { right };
            self.wrong_kind(wrong, if wanted { Kind::Number } else { Kind::Symbol });
            return;
        }
        let (Some(left), Some(right)) =
            (self.expr(left, scope, body), self.expr(right, scope, body))
        else {
            return;
        };
        let is_number = kinds.0.or(kinds.1).unwrap_or(false);
        body.push(Literal::Compare(Compare { op, left, right, is_number, at }));
    }

    fn expect(&mut self, expr: &syntax::Expr, kind: Kind, scope: &Scope) {
        let negative = matches!(expr, syntax::Expr::Number(number, _) if *number < 0);
        let fits = self.kind_of(expr, scope).is_none_or(|is_number| is_number == kind.is_number());
        if !fits || negative && kind == Kind::Unsigned {
            self.wrong_kind(expr, kind);
        }
    }

    fn wrong_kind(&mut self, expr: &syntax::Expr, expected: Kind) {
        let at = expr.at();
        let what = match expr {
            syntax::Expr::Variable(name) => name.text.clone(),
            syntax::Expr::Number(number, _) => number.to_string(),
            syntax::Expr::Text(text, _) => text.clone(),
            syntax::Expr::Call { functor, .. } => functor.word().into(),
            syntax::Expr::Aggregate { function, .. } => function.word().into(),
            syntax::Expr::Any(_) => "_".into(),
        };
        let found = if expected.is_number() { "symbol" } else { "number" };
        let found =
            if expected == Kind::Unsigned && what.starts_with('-') { "number" } else { found }
                .into();
        let fault =
            RuleError::Types { what, expected: kind_name(expected).into(), found, at: at.into() };
        self.fault(at, fault);
    }

    fn expr(
        &mut self,
        expr: &syntax::Expr,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<Expr> {
        Some(match expr {
            syntax::Expr::Any(at) => {
                self.fault(*at, RuleError::Wildcard { at: (*at).into() });
                return None;
            }
            syntax::Expr::Variable(name) => Expr::Variable(scope[&name.text]),
            syntax::Expr::Number(number, _) => Expr::Constant(self.words.number(*number)),
            syntax::Expr::Text(text, _) => Expr::Constant(self.words.symbol(text)),
            syntax::Expr::Call { functor, args, .. } => self.call(*functor, args, scope, body)?,
            syntax::Expr::Aggregate { function, value, body: inner, at } => {
                let target =
                    self.aggregate(*function, value.as_deref(), inner, *at, scope, body)?;
                Expr::Variable(target)
            }
        })
    }

    fn call(
        &mut self,
        functor: Functor,
        args: &[syntax::Expr],
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<Expr> {
        let mut values = Vec::with_capacity(args.len());
        for (arg, is_number) in args.iter().zip(functor.takes_numbers()) {
            if let syntax::Expr::Variable(name) = arg {
                self.variables[scope[&name.text] as usize].is_number.get_or_insert(*is_number);
            }
            self.expect(arg, if *is_number { Kind::Number } else { Kind::Symbol }, scope);
            values.push(self.expr(arg, scope, body)?);
        }
        let call = Expr::Call(functor, values);
        // What is computed from constants alone is computed here.
        if call.has_variables() {
            return Some(call);
        }
        let word = super::value::compute(&call, &|_| 0, self.words);
        Some(word.map_or(call, Expr::Constant))
    }

    /// The variable that holds the aggregate's value.
    fn aggregate(
        &mut self,
        function: Aggregation,
        value: Option<&syntax::Expr>,
        inner: &Body,
        at: Span,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<VariableId> {
        let mut choices = choices(inner, true).unwrap_or_default();
        if choices.len() != 1 {
            let (what, help) = ("«;» внутри счёта".into(), "вынесите выбор в отдельное отношение");
            self.fault(at, RuleError::Unsupported { what, help, at: at.into() });
            return None;
        }
        let premises = choices.swap_remove(0);
        let mut within = scope.clone();
        let outer = self.variables.len() as VariableId;
        self.enter(&premises, &[], value, &mut within);
        self.find_kinds(&premises, &within);
        let mut literals = self.literals(&premises, &within);
        let value = match value {
            Some(value) => {
                self.expect(value, Kind::Number, &within);
                Some(self.expr(value, &within, &mut literals)?)
            }
            None => None,
        };
        let mut shared = Vec::new();
        used_variables(&literals, value.as_ref(), &mut |v| {
            if v < outer && !shared.contains(&v) {
                shared.push(v);
            }
        });
        let target = self.fresh("", at);
        self.variables[target as usize].is_number = Some(true);
        body.push(Literal::Aggregate(Aggregate {
            target,
            function,
            value,
            body: literals,
            shared,
            at,
        }));
        Some(target)
    }

    fn head_fits(
        &mut self,
        head: &syntax::Atom,
        relation: super::RelationId,
        args: &[Expr],
    ) -> bool {
        let declared = self.declared;
        let columns = &declared.relations[relation.index()].columns;
        if !self.has_arity(head, columns.len()) {
            return false;
        }
        for (n, (arg, column)) in head.args.iter().zip(columns).enumerate() {
            let wanted = declared.columns[relation.index()][n];
            let Expr::Variable(id) = args[n] else {
                self.expect(arg, column.kind, &Scope::new());
                continue;
            };
            let variable = &self.variables[id as usize];
            let is_number = variable.is_number.unwrap_or(column.kind.is_number());
            let narrower = variable
                .of
                .is_none_or(|of| !is_user_type(wanted) || declared.is_subtype(of, wanted));
            if is_number != column.kind.is_number() || !narrower {
                let found = match variable.of {
                    Some(of) => declared.types[of].name.clone(),
                    None => if is_number { "number" } else { "symbol" }.into(),
                };
                let (what, at) = (variable.name.clone(), arg.at());
                let expected = column.type_name.clone();
                self.fault(at, RuleError::Types { what, expected, found, at: at.into() });
            }
            self.variables[id as usize].is_number.get_or_insert(column.kind.is_number());
        }
        true
    }

    fn check_bound(&mut self, body: &[Literal], args: &[Expr]) {
        let mut bound = vec![false; self.variables.len()];
        let mut loose = Vec::new();
        find_unbound(body, None, &mut bound, &mut loose);
        for arg in args {
            arg.for_each_variable(&mut |v| {
                if !bound[v as usize] {
                    loose.push(v);
                }
            });
        }
        loose.sort_unstable();
        loose.dedup();
        for v in loose {
            let VariableType { name, at, .. } = &self.variables[v as usize];
            let (variable, at) = (name.clone(), *at);
            // An unnamed variable stands for an expression whose own variables are reported.
            if variable.is_empty() {
                self.is_sound = false;
            } else {
                self.fault(at, RuleError::Ungrounded { variable, at: at.into() });
            }
        }
    }
}

fn is_user_type(id: usize) -> bool {
    id > 2
}

fn names_of<'a>(expr: &'a syntax::Expr, names: &mut Vec<&'a syntax::Name>) {
    match expr {
        syntax::Expr::Variable(name) => names.push(name),
        syntax::Expr::Call { args, .. } => args.iter().for_each(|arg| names_of(arg, names)),
        _ => {}
    }
}

/// Marks what a body binds, and lists the variables that it uses without binding them.
fn find_unbound(
    body: &[Literal],
    value: Option<&Expr>,
    bound: &mut [bool],
    loose: &mut Vec<VariableId>,
) {
    for literal in body {
        if let Literal::Atom(atom) = literal {
            for term in &atom.args {
                if let Term::Variable(v) = term {
                    bound[*v as usize] = true;
                }
            }
        }
    }
    let mut changed = true;
    while changed {
        changed = false;
        for literal in body {
            changed |= match literal {
                Literal::Compare(Compare { op: Comparison::Equal, left, right, .. }) => {
                    bind(left, right, bound) || bind(right, left, bound)
                }
                Literal::Aggregate(aggregate) => {
                    let ready = aggregate.shared.iter().all(|v| bound[*v as usize]);
                    ready && !std::mem::replace(&mut bound[aggregate.target as usize], true)
                }
                _ => false,
            };
        }
    }
    let mut used = Vec::new();
    used_variables(body, value, &mut |v| used.push(v));
    for literal in body {
        if let Literal::Aggregate(aggregate) = literal {
            used.retain(|v| !is_local(aggregate, *v));
            let mut within = bound.to_vec();
            find_unbound(&aggregate.body, aggregate.value.as_ref(), &mut within, loose);
        }
    }
    loose.extend(used.into_iter().filter(|v| !bound[*v as usize]));
}

/// Whether a variable belongs to the aggregate alone: those are numbered between its outer ones and its target.
fn is_local(aggregate: &Aggregate, v: VariableId) -> bool {
    let mut inside = false;
    used_variables(&aggregate.body, aggregate.value.as_ref(), &mut |used| inside |= used == v);
    inside && !aggregate.shared.contains(&v)
}

fn bind(variable: &Expr, value: &Expr, bound: &mut [bool]) -> bool {
    match variable {
        Expr::Variable(v) if !bound[*v as usize] && value.all_variables(|v| bound[v as usize]) => {
            bound[*v as usize] = true;
            true
        }
        _ => false,
    }
}

/// Every variable of a body, those within aggregates included.
pub(super) fn used_variables(
    body: &[Literal],
    value: Option<&Expr>,
    f: &mut dyn FnMut(VariableId),
) {
    if let Some(value) = value {
        value.for_each_variable(f);
    }
    for literal in body {
        match literal {
            Literal::Atom(atom) | Literal::Not(atom) => {
                for term in &atom.args {
                    if let Term::Variable(v) = term {
                        f(*v);
                    }
                }
            }
            Literal::Compare(compare) => {
                compare.left.for_each_variable(f);
                compare.right.for_each_variable(f);
            }
            Literal::Aggregate(aggregate) => {
                f(aggregate.target);
                used_variables(&aggregate.body, aggregate.value.as_ref(), f);
            }
        }
    }
}
