//! What the values of a rule are computed as: found from columns and comparisons, checked where they are used.

use super::check::kind_name;
use super::clause::{Builder, Premise, Scope, names_of};
use super::decimal::Decimal;
use super::fault::RuleError;
use super::program::{Expr, Kind, RelationId, VariableId};
use super::syntax::{self, Aggregation, Body, Span};

impl Builder<'_> {
    /// Kinds by the columns that variables stand in, then by what they are compared to.
    pub(super) fn find_kinds(&mut self, premises: &[Premise<'_>], scope: &Scope) {
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
                    let Some(kind) = self.common_kind(left, right, scope) else { continue };
                    for side in [left, right] {
                        if let syntax::Expr::Variable(name) = side {
                            let known = &mut self.variables[scope[&name.text] as usize].kind;
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

    /// What an expression is computed as, as far as its variables are known.
    pub(super) fn kind_of(&self, expr: &syntax::Expr, scope: &Scope) -> Option<Kind> {
        match expr {
            syntax::Expr::Variable(name) => self.variables[*scope.get(&name.text)? as usize].kind,
            syntax::Expr::Number(..) => Some(Kind::Number),
            syntax::Expr::Decimal(..) => Some(Kind::Float),
            syntax::Expr::Text(..) => Some(Kind::Symbol),
            syntax::Expr::As { type_name, .. } => {
                let of = self.declared.type_named(&type_name.text)?;
                Some(self.declared.types[of].kind.plain())
            }
            syntax::Expr::Call { functor, args, .. } if functor.is_arithmetic() => {
                let is_float = args.iter().any(|arg| self.kind_of(arg, scope) == Some(Kind::Float));
                Some(if is_float { Kind::Float } else { Kind::Number })
            }
            syntax::Expr::Call { functor, .. } => Some(functor.result()),
            syntax::Expr::Aggregate { function: Aggregation::Count, .. } => Some(Kind::Number),
            syntax::Expr::Aggregate { value, body, .. } => {
                let value = value.as_deref()?;
                Some(self.kind_of(value, scope).filter(|kind| *kind == Kind::Float).unwrap_or_else(
                    || if self.sums_decimals(value, body) { Kind::Float } else { Kind::Number },
                ))
            }
            syntax::Expr::Any(_) => None,
        }
    }

    /// Whether an aggregate's value reads a variable that its body finds in a column of decimals.
    pub(super) fn sums_decimals(&self, value: &syntax::Expr, body: &Body) -> bool {
        let mut names = Vec::new();
        names_of(value, &mut names);
        match body {
            Body::All(parts) | Body::Any(parts) => {
                parts.iter().any(|part| self.sums_decimals(value, part))
            }
            Body::Atom(atom) => {
                let relation = self.declared.names.find(&atom.relation.text);
                let columns = relation.map(|of| &self.declared.relations[of.index()].columns);
                atom.args.iter().zip(columns.into_iter().flatten()).any(|(arg, column)| {
                    column.kind == Kind::Float
                        && matches!(arg, syntax::Expr::Variable(name)
                            if names.iter().any(|known| known.text == name.text))
                })
            }
            Body::Not(_) | Body::Compare { .. } => false,
        }
    }

    /// The kind that both sides of a comparison have; a whole number beside a decimal is a decimal.
    pub(super) fn common_kind(
        &self,
        left: &syntax::Expr,
        right: &syntax::Expr,
        scope: &Scope,
    ) -> Option<Kind> {
        let (of_left, of_right) = (self.kind_of(left, scope), self.kind_of(right, scope));
        if of_right == Some(Kind::Float) && is_whole(left) {
            of_right
        } else {
            of_left.or(of_right)
        }
    }

    /// A variable may stand in columns of several types when one of them is part of the others.
    pub(super) fn give_type(
        &mut self,
        variable: VariableId,
        of: usize,
        is_positive: bool,
        at: Span,
    ) {
        let kind = self.declared.types[of].kind;
        let known = &mut self.variables[variable as usize];
        let name = known.name.clone();
        let before = known.of;
        let fits = match (known.kind, before) {
            (Some(known), _) if known != kind.plain() => false,
            (_, Some(before)) if !kind.is_number() || is_user_type(before) || is_user_type(of) => {
                self.declared.is_subtype(before, of) || self.declared.is_subtype(of, before)
            }
            _ => true,
        };
        if !fits {
            let expected = self.declared.types[of].name.clone();
            let found = before.map_or_else(
                || kind_name(known.kind.unwrap_or(Kind::Symbol)).to_owned(),
                |before| self.declared.types[before].name.clone(),
            );
            self.fault(at, RuleError::Types { what: name, expected, found, at: at.into() });
            return;
        }
        known.kind = Some(kind.plain());
        if is_positive && before.is_none_or(|before| self.declared.is_subtype(of, before)) {
            self.variables[variable as usize].of = Some(of);
        }
    }

    /// Whether an expression may stand where values of a kind are wanted.
    pub(super) fn fits(&self, expr: &syntax::Expr, kind: Kind, scope: &Scope) -> bool {
        self.kind_of(expr, scope).is_none_or(|known| known == kind.plain())
            || kind == Kind::Float && is_whole(expr)
    }

    pub(super) fn expect(&mut self, expr: &syntax::Expr, kind: Kind, scope: &Scope) {
        let negative = matches!(expr, syntax::Expr::Number(number, _) if *number < 0);
        if !self.fits(expr, kind, scope) || negative && kind == Kind::Unsigned {
            self.wrong_kind(expr, kind, scope);
        }
    }

    pub(super) fn wrong_kind(&mut self, expr: &syntax::Expr, expected: Kind, scope: &Scope) {
        let at = expr.at();
        let what = match expr {
            syntax::Expr::Variable(name) => name.text.clone(),
            syntax::Expr::Number(number, _) => number.to_string(),
            syntax::Expr::Decimal(number, _) => Decimal::from_millionths(*number).to_string(),
            syntax::Expr::Text(text, _) => text.clone(),
            syntax::Expr::As { .. } => "as".into(),
            syntax::Expr::Call { functor, .. } => functor.word().into(),
            syntax::Expr::Aggregate { function, .. } => function.word().into(),
            syntax::Expr::Any(_) => "_".into(),
        };
        let found = kind_name(self.kind_of(expr, scope).unwrap_or(Kind::Symbol)).into();
        let expected = kind_name(expected).into();
        self.fault(at, RuleError::Types { what, expected, found, at: at.into() });
    }

    pub(super) fn head_fits(
        &mut self,
        head: &syntax::Atom,
        relation: RelationId,
        args: &[Expr],
        scope: &Scope,
    ) -> bool {
        let declared = self.declared;
        let columns = &declared.relations[relation.index()].columns;
        if !self.has_arity(head, columns.len()) {
            return false;
        }
        for (n, (arg, column)) in head.args.iter().zip(columns).enumerate() {
            let wanted = declared.columns[relation.index()][n];
            let Expr::Variable(id) = args[n] else {
                self.expect(arg, column.kind, scope);
                continue;
            };
            let variable = &self.variables[id as usize];
            let kind = variable.kind.unwrap_or(column.kind.plain());
            let narrower = variable
                .of
                .is_none_or(|of| !is_user_type(wanted) || declared.is_subtype(of, wanted));
            if kind != column.kind.plain() || !narrower {
                let found = match variable.of {
                    Some(of) => declared.types[of].name.clone(),
                    None => kind_name(kind).into(),
                };
                let (what, at) = (variable.name.clone(), arg.at());
                let expected = column.type_name.clone();
                self.fault(at, RuleError::Types { what, expected, found, at: at.into() });
            }
            self.variables[id as usize].kind.get_or_insert(column.kind.plain());
        }
        true
    }
}

fn is_user_type(id: usize) -> bool {
    id > 3
}

/// Made of whole numbers alone, so that it may stand for a decimal as well.
pub(super) fn is_whole(expr: &syntax::Expr) -> bool {
    match expr {
        syntax::Expr::Number(..) => true,
        syntax::Expr::Call { functor, args, .. } => {
            functor.is_arithmetic() && args.iter().all(is_whole)
        }
        _ => false,
    }
}
