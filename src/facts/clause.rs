//! A rule of the text to clauses: one for each head and each choice of its disjunctions,
//! over numbered variables with known kinds, each bound by something.

use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};

use super::declared::Declared;
use super::fault::{Found, RuleError};
use super::program::{
    Aggregate, Atom, Clause, Compare, Expr, Kind, Literal, Term, Variable, VariableId,
    used_variables,
};
use super::relations::{Column, RelationId, RelationInfo};
use super::syntax::{self, Aggregation, Body, Comparison, Record, Rule, Span};
use super::word::Words;
use crate::units::{said, word};

/// Choices of a rule's disjunctions, multiplied out.
const MAX_CHOICES: usize = 256;
const MAX_PREMISES: usize = 256;

pub(super) fn clauses(
    rule: &Rule,
    declared: &Declared,
    words: &mut Words,
    made: &mut Made,
    faults: &mut Found,
) -> Vec<Clause> {
    let Some(choices) = choices(&rule.body, true) else {
        let (what, limit, at) = (word!("choices-of-a-rule"), MAX_CHOICES, rule.at.into());
        faults.push(rule.at, RuleError::TooLarge { what, limit, at });
        return Vec::new();
    };
    let mut clauses = Vec::new();
    for head in &rule.heads {
        for choice in &choices {
            if choice.len() > MAX_PREMISES {
                let (what, limit, at) = (word!("premises-of-a-rule"), MAX_PREMISES, rule.at.into());
                faults.push(rule.at, RuleError::TooLarge { what, limit, at });
                continue;
            }
            let mut builder = Builder {
                declared,
                words,
                faults,
                made,
                variables: Vec::new(),
                is_sound: true,
                excused: Vec::new(),
                in_atoms: HashSet::new(),
            };
            clauses.extend(builder.clause(head, choice, rule.at));
        }
    }
    clauses
}

/// The clauses of a question, one for each choice of its disjunctions, and the kinds of what is asked for. Without
/// `exprs` it asks for all variables of the body's own level whose names do not start with `_`.
pub(super) fn asking(
    question: &syntax::Question,
    declared: &Declared,
    words: &mut Words,
    made: &mut Made,
    faults: &mut Found,
) -> (Vec<Clause>, Vec<(String, Kind)>) {
    let Some(choices) = choices(&question.body, true) else {
        let (what, limit, at) = (word!("choices-of-a-question"), MAX_CHOICES, question.at.into());
        faults.push(question.at, RuleError::TooLarge { what, limit, at });
        return (Vec::new(), Vec::new());
    };
    let exprs = question.exprs.clone().unwrap_or_else(|| {
        let mut names = Vec::new();
        choices.iter().flatten().for_each(|premise| names_in(premise, &mut names));
        let mut asked: Vec<syntax::Expr> = Vec::new();
        for name in names {
            let is_known = |expr: &syntax::Expr| {
                matches!(expr, syntax::Expr::Variable(known) if known.text == name.text)
            };
            if !name.text.starts_with('_') && !asked.iter().any(is_known) {
                asked.push(syntax::Expr::Variable(name.clone()));
            }
        }
        asked
    });
    let is_too_wide = exprs.len() > super::declared::MAX_COLUMNS;
    if is_too_wide || choices.iter().any(|choice| choice.len() > MAX_PREMISES) {
        let (what, limit) = match is_too_wide {
            true => (word!("columns-of-the-answer"), super::declared::MAX_COLUMNS),
            false => (word!("premises-of-a-question"), MAX_PREMISES),
        };
        faults.push(question.at, RuleError::TooLarge { what, limit, at: question.at.into() });
        return (Vec::new(), Vec::new());
    }
    // Numbered behind all relations that parts of the rules and of the question become.
    let head = RelationId(u32::MAX);
    let (mut clauses, mut kinds) = (Vec::new(), None::<Vec<Kind>>);
    for choice in &choices {
        let mut builder = Builder {
            declared,
            words,
            faults,
            made,
            variables: Vec::new(),
            is_sound: true,
            excused: Vec::new(),
            in_atoms: HashSet::new(),
        };
        let Some((clause, found)) = builder.asking(head, &exprs, choice, question.at) else {
            continue;
        };
        let known = kinds.get_or_insert_with(|| found.clone());
        for ((expr, one), other) in exprs.iter().zip(known.iter()).zip(&found) {
            if one != other {
                let (expected, found) = (declared.kind_text(*one), declared.kind_text(*other));
                let (what, at) = (expr_name(expr, &question.text), expr.at());
                faults.push(
                    at,
                    RuleError::Types { what, expected, found: found.into(), at: at.into() },
                );
            }
        }
        clauses.push(clause);
    }
    let kinds = kinds.unwrap_or_else(|| vec![Kind::Symbol; exprs.len()]);
    let named = exprs.iter().map(|expr| expr_name(expr, &question.text)).zip(kinds);
    (clauses, named.collect())
}

/// A variable's name, else the expression as it is written.
fn expr_name(expr: &syntax::Expr, text: &str) -> String {
    match expr {
        syntax::Expr::Variable(name) => name.text.clone(),
        other => text.get(other.at().range()).unwrap_or_default().trim().to_owned(),
    }
}

/// Relations, with their places, and clauses that stand for parts of rules; numbered behind the declared ones.
#[derive(Debug, Default)]
pub(super) struct Made {
    pub(super) relations: Vec<(RelationInfo, Span)>,
    pub(super) clauses: Vec<Clause>,
}

/// A premise without disjunction.
#[derive(Debug, Clone)]
pub(super) enum Premise<'a> {
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
pub(super) type Scope = HashMap<String, VariableId>;

pub(super) struct VariableType {
    pub(super) name: String,
    pub(super) at: Span,
    /// The declared type of the column that binds it; none until one does.
    pub(super) of: Option<usize>,
    /// What it is computed as; none until that is known.
    pub(super) kind: Option<Kind>,
}

pub(super) struct Builder<'a> {
    pub(super) declared: &'a Declared,
    pub(super) words: &'a mut Words,
    pub(super) faults: &'a mut Found,
    made: &'a mut Made,
    pub(super) variables: Vec<VariableType>,
    pub(super) is_sound: bool,
    /// Variables of premises that are themselves at fault: what would bind them is told already.
    pub(super) excused: Vec<VariableId>,
    /// Variables that stand in positive atoms.
    pub(super) in_atoms: HashSet<VariableId>,
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
        self.find_kinds(premises, relation.map(|relation| (head, relation)), &scope);
        let mut body = self.literals(premises, &scope);
        let mut args = Vec::with_capacity(head.args.len());
        for (n, arg) in head.args.iter().enumerate() {
            let column = relation.and_then(|of| self.declared.relations[of.index()].columns.get(n));
            let wanted = column.map(|column| column.kind);
            args.push(self.expr(arg, wanted, &scope, &mut body)?);
        }
        let relation = relation.filter(|relation| self.head_fits(head, *relation, &args, &scope));
        self.check_bound(&body, &args);
        let relation = relation.filter(|_| self.is_sound)?;
        let variables = self.variables.iter().map(|variable| Variable {
            name: variable.name.clone(),
            kind: variable.kind.unwrap_or(Kind::Symbol),
        });
        Some(Clause { head: relation, args, body, variables: variables.collect(), at })
    }

    /// The clause of a question: what is asked for are its arguments.
    fn asking(
        &mut self,
        head: RelationId,
        exprs: &[syntax::Expr],
        premises: &[Premise<'_>],
        at: Span,
    ) -> Option<(Clause, Vec<Kind>)> {
        let mut scope = Scope::new();
        self.enter(premises, exprs, None, &mut scope);
        self.find_kinds(premises, None, &scope);
        let mut body = self.literals(premises, &scope);
        let (mut args, mut kinds) = (Vec::new(), Vec::new());
        for expr in exprs {
            let kind = self.kind_of(expr, &scope);
            args.push(self.expr(expr, kind, &scope, &mut body)?);
            kinds.push(kind.unwrap_or(Kind::Symbol));
        }
        self.check_bound(&body, &args);
        let variables = self.variables.iter().map(|variable| Variable {
            name: variable.name.clone(),
            kind: variable.kind.unwrap_or(Kind::Symbol),
        });
        let variables = variables.collect();
        self.is_sound.then_some((Clause { head, args, body, variables, at }, kinds))
    }

    pub(super) fn fault(&mut self, at: Span, fault: RuleError) {
        self.is_sound = false;
        self.faults.push(at, fault);
    }

    pub(super) fn fresh(&mut self, name: &str, at: Span) -> VariableId {
        self.variables.push(VariableType { name: name.into(), at, of: None, kind: None });
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
        premises.iter().for_each(|premise| names_in(premise, &mut names));
        for name in names {
            if !scope.contains_key(&name.text) {
                let id = self.fresh(&name.text, name.at);
                scope.insert(name.text.clone(), id);
            }
        }
    }

    fn literals(&mut self, premises: &[Premise<'_>], scope: &Scope) -> Vec<Literal> {
        let mut body = Vec::with_capacity(premises.len());
        for premise in premises {
            if let Premise::Atom(atom) = premise {
                let variable = |arg: &syntax::Expr| match arg {
                    syntax::Expr::Variable(name) => scope.get(&name.text).copied(),
                    _ => None,
                };
                self.in_atoms.extend(atom.args.iter().filter_map(variable));
            }
        }
        for premise in premises {
            match premise {
                Premise::Atom(atom) => match self.atom(atom, true, scope, &mut body) {
                    Some(atom) => body.push(Literal::Atom(atom)),
                    None => self.excuse(premise, scope),
                },
                Premise::Not(atom) => {
                    if let Some(atom) = self.atom(atom, false, scope, &mut body) {
                        body.push(Literal::Not(atom));
                    }
                }
                Premise::Compare { op, left, right, at } => {
                    if self.compare(*op, left, right, *at, scope, &mut body).is_none() {
                        self.excuse(premise, scope);
                    }
                }
            }
        }
        body
    }

    fn atom(
        &mut self,
        atom: &syntax::Atom,
        is_positive: bool,
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
                syntax::Expr::Record { .. } if is_positive && !is_closed(arg) => {
                    let variable = self.fresh("", arg.at());
                    self.variables[variable as usize].kind = Some(column.kind);
                    let (value, record) = (Expr::Variable(variable), Record::of(arg)?);
                    self.take_apart(&value, &record, Some(column.kind), scope, body)?;
                    Term::Variable(variable)
                }
                _ => match self.expr(arg, Some(column.kind), scope, body)? {
                    Expr::Constant(word) => {
                        self.expect(arg, column.kind, scope);
                        Term::Constant(word)
                    }
                    // r(X + 1) reads r(V), V = X + 1.
                    value => {
                        self.expect(arg, column.kind, scope);
                        let variable = self.fresh("", arg.at());
                        let kind = column.kind;
                        self.variables[variable as usize].kind = Some(kind);
                        let (left, op) = (Expr::Variable(variable), Comparison::Equal);
                        let compare = Compare { op, left, right: value, kind, at: arg.at() };
                        body.push(Literal::Compare(compare));
                        Term::Variable(variable)
                    }
                },
            });
        }
        Some(Atom { relation, args, at: atom.at })
    }

    pub(super) fn has_arity(&mut self, atom: &syntax::Atom, expected: usize) -> bool {
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
    ) -> Option<()> {
        use Comparison::{Contains, Equal, Matches, NotContains, NotEqual, NotMatches};
        let is_of_texts = matches!(op, Contains | NotContains | Matches | NotMatches);
        let kind = match is_of_texts {
            true => Some(Kind::Symbol),
            false => self.common_kind(left, right, scope),
        };
        let wanted = kind;
        let is_ordered = !is_of_texts && !matches!(op, Equal | NotEqual);
        if let (Some(kind @ Kind::Record(_)), true) = (kind, is_ordered) {
            let what = said!(
                "between-values-of-the-type",
                sign = op.sign(),
                kind = self.declared.kind_text(kind)
            );
            let help = word!("records-are-compared-for-equality-only");
            self.fault(at, RuleError::Unsupported { what, help, at: at.into() });
            return None;
        }
        let has_record = [left, right].into_iter().any(|side| Record::of(side).is_some());
        if op == Equal && has_record {
            return self.equal_records((left, right), kind, at, scope, body);
        }
        if matches!(op, Matches | NotMatches) {
            self.check_pattern(left);
        }
        let is_nil = |side: &syntax::Expr| matches!(side, syntax::Expr::Nil(_));
        if kind.is_none() && (is_nil(left) || is_nil(right)) {
            self.fault(at, RuleError::Record { what: "nil".into(), at: at.into() });
            return None;
        }
        if let Some(wanted) = wanted {
            let wrong = [left, right].into_iter().find(|side| !self.fits(side, wanted, scope));
            if let Some(wrong) = wrong {
                self.wrong_kind(wrong, wanted, scope);
                return None;
            }
        }
        let left = self.expr(left, wanted, scope, body);
        let (left, right) = left.zip(self.expr(right, wanted, scope, body))?;
        let kind = kind.unwrap_or(Kind::Symbol);
        body.push(Literal::Compare(Compare { op, left, right, kind, at }));
        Some(())
    }

    fn excuse(&mut self, premise: &Premise<'_>, scope: &Scope) {
        let mut names = Vec::new();
        names_in(premise, &mut names);
        self.excused.extend(names.iter().filter_map(|name| scope.get(&name.text)));
    }

    /// The variable that holds the aggregate's value.
    pub(super) fn aggregate(
        &mut self,
        function: Aggregation,
        value: Option<&syntax::Expr>,
        inner: &Body,
        at: Span,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<VariableId> {
        let Some(mut choices) = choices(inner, true) else {
            let (what, limit, at) = (word!("choices-of-an-aggregate"), MAX_CHOICES, at);
            self.fault(at, RuleError::TooLarge { what, limit, at: at.into() });
            return None;
        };
        let outer = self.variables.len() as VariableId;
        let mut within = scope.clone();
        let mut literals = match choices.len() {
            1 => {
                let premises = choices.swap_remove(0);
                self.enter(&premises, &[], value, &mut within);
                self.find_kinds(&premises, None, &within);
                self.literals(&premises, &within)
            }
            _ => vec![self.either(&choices, value, at, &mut within)?],
        };
        let mut kind = Kind::Number;
        let value = match value {
            Some(value) => {
                kind = self
                    .kind_of(value, &within)
                    .filter(|kind| kind.is_number())
                    .unwrap_or(Kind::Number);
                self.expect(value, kind, &within);
                Some(self.expr(value, Some(kind), &within, &mut literals)?)
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
        self.variables[target as usize].kind = Some(kind);
        body.push(Literal::Aggregate(Aggregate {
            target,
            kind,
            function,
            value,
            body: literals,
            shared,
            at,
        }));
        Some(target)
    }

    /// An atom that holds for what any of the choices finds. The choices become rules of a relation of their own,
    /// over the variables that all of them name; what two of them find counts once, as in Soufflé.
    fn either(
        &mut self,
        choices: &[Vec<Premise<'_>>],
        value: Option<&syntax::Expr>,
        at: Span,
        within: &mut Scope,
    ) -> Option<Literal> {
        let mut common: Option<Vec<String>> = None;
        for premises in choices {
            let mut names = Vec::new();
            for premise in premises {
                names_in(premise, &mut names);
            }
            let names: Vec<String> = names.into_iter().map(|name| name.text.clone()).collect();
            common = Some(match common {
                None => names,
                Some(known) => known.into_iter().filter(|name| names.contains(name)).collect(),
            });
        }
        let mut names: Vec<String> = Vec::new();
        for name in common.unwrap_or_default() {
            if !names.contains(&name) {
                names.push(name);
            }
        }
        let place = self.made.relations.len();
        let relation = RelationId((self.declared.relations.len() + place) as u32);
        let info =
            RelationInfo { name: format!("выбор_{}", place + 1), ..RelationInfo::default() };
        self.made.relations.push((info, at));
        let mut kinds: Vec<Kind> = Vec::new();
        let mut clauses = Vec::new();
        for premises in choices {
            let (variables, is_sound) = (std::mem::take(&mut self.variables), self.is_sound);
            let excused = std::mem::take(&mut self.excused);
            let mut scope = Scope::new();
            self.enter(premises, &[], None, &mut scope);
            self.find_kinds(premises, None, &scope);
            let body = self.literals(premises, &scope);
            let args: Vec<Expr> = names.iter().map(|name| Expr::Variable(scope[name])).collect();
            self.check_bound(&body, &args);
            kinds = names
                .iter()
                .map(|name| self.variables[scope[name] as usize].kind.unwrap_or(Kind::Symbol))
                .collect();
            let own = std::mem::replace(&mut self.variables, variables);
            self.is_sound &= is_sound;
            self.excused = excused;
            let kind = |variable: VariableType| Variable {
                name: variable.name,
                kind: variable.kind.unwrap_or(Kind::Symbol),
            };
            let variables = own.into_iter().map(kind).collect();
            clauses.push(Clause { head: relation, args, body, variables, at });
        }
        let columns = names.iter().zip(&kinds).map(|(name, kind)| Column {
            name: name.clone(),
            kind: *kind,
            type_name: self.declared.kind_text(*kind),
        });
        self.made.relations[place].0.columns = columns.collect();
        self.made.clauses.extend(clauses);
        let mut in_value = Vec::new();
        value.iter().for_each(|value| names_of(value, &mut in_value));
        for name in names.iter().cloned().chain(in_value.iter().map(|name| name.text.clone())) {
            if let Entry::Vacant(free) = within.entry(name) {
                let id = self.fresh(free.key(), at);
                free.insert(id);
            }
        }
        for (name, kind) in names.iter().zip(kinds) {
            self.variables[within[name] as usize].kind.get_or_insert(kind);
        }
        let args = names.iter().map(|name| Term::Variable(within[name])).collect();
        self.is_sound.then_some(Literal::Atom(Atom { relation, args, at }))
    }
}

/// Whether an expression holds no variable and leaves nothing open.
fn is_closed(expr: &syntax::Expr) -> bool {
    match expr {
        syntax::Expr::Record { args, .. } => args.iter().all(is_closed),
        syntax::Expr::Number(..)
        | syntax::Expr::Unsigned(..)
        | syntax::Expr::Decimal(..)
        | syntax::Expr::Text(..)
        | syntax::Expr::Nil(_) => true,
        _ => false,
    }
}

/// The names of a premise at its own level.
fn names_in<'a>(premise: &Premise<'a>, names: &mut Vec<&'a syntax::Name>) {
    match *premise {
        Premise::Atom(atom) | Premise::Not(atom) => {
            atom.args.iter().for_each(|arg| names_of(arg, names));
        }
        Premise::Compare { left, right, .. } => {
            names_of(left, names);
            names_of(right, names);
        }
    }
}

pub(super) fn names_of<'a>(expr: &'a syntax::Expr, names: &mut Vec<&'a syntax::Name>) {
    match expr {
        syntax::Expr::Variable(name) => names.push(name),
        syntax::Expr::Call { args, .. } | syntax::Expr::Record { args, .. } => {
            args.iter().for_each(|arg| names_of(arg, names));
        }
        syntax::Expr::As { value, .. } => names_of(value, names),
        _ => {}
    }
}
