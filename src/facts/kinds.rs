//! What the values of a rule are computed as: found from columns and comparisons, checked where they are used.

use crate::units::said;
use std::collections::HashMap;

use super::clause::{Builder, Premise, Scope};
use super::decimal::Decimal;
use super::declared::is_declared;
use super::fault::RuleError;
use super::program::{Expr, Kind, VariableId};
use super::relations::RelationId;
use super::syntax::{self, Aggregation, Body, Span};

impl Builder<'_> {
    /// Kinds by the columns that variables stand in, then by what they are compared to.
    pub(super) fn find_kinds(
        &mut self,
        premises: &[Premise<'_>],
        head: Option<(&syntax::Atom, RelationId)>,
        scope: &Scope,
    ) {
        for premise in premises {
            if let Premise::Atom(atom) | Premise::Not(atom) = premise {
                let Some(relation) = self.declared.names.find(&atom.relation.text) else {
                    continue;
                };
                let declared = self.declared;
                for (arg, of) in atom.args.iter().zip(&declared.columns[relation.index()]) {
                    self.give(arg, *of, matches!(premise, Premise::Atom(_)), scope);
                }
            }
        }
        // A number that only the head tells apart is of the head's column.
        if let Some((head, relation)) = head {
            let declared = self.declared;
            for (arg, of) in head.args.iter().zip(&declared.columns[relation.index()]) {
                let kind = declared.types[*of].kind;
                match arg {
                    syntax::Expr::Variable(name) => {
                        self.variables[scope[&name.text] as usize].kind.get_or_insert(kind);
                    }
                    syntax::Expr::Record { .. } => {
                        self.give_fields(arg, kind, scope);
                    }
                    _ => {}
                }
            }
        }
        // Each round finds the kind of at least one variable, or nothing changes any more.
        // A whole number alone may be of any kind of number: it decides what nothing else does.
        let compares = || {
            premises.iter().filter_map(|premise| match premise {
                Premise::Compare { left, right, .. } => Some((*left, *right)),
                _ => None,
            })
        };
        loop {
            let mut changed = false;
            for (left, right) in compares() {
                if !self.is_weak(left, right, scope) {
                    changed |= self.compare_kinds(left, right, scope);
                }
            }
            let mut weak = compares();
            if !changed && !weak.any(|(left, right)| self.compare_kinds(left, right, scope)) {
                break;
            }
        }
    }

    /// Whether all that a comparison tells of kinds is that of a whole number.
    fn is_weak(&self, left: &syntax::Expr, right: &syntax::Expr, scope: &Scope) -> bool {
        is_whole(left) && self.kind_of(right, scope).is_none()
            || is_whole(right) && self.kind_of(left, scope).is_none()
    }

    /// What stands in a column of a type, or in a record's field.
    fn give(&mut self, expr: &syntax::Expr, of: usize, is_positive: bool, scope: &Scope) {
        match expr {
            syntax::Expr::Variable(name) => {
                self.give_type(scope[&name.text], of, is_positive, name.at);
            }
            syntax::Expr::Record { args, branch, .. } => {
                let declared = self.declared;
                let Kind::Record(shape) = declared.types[of].kind else { return };
                let Some((_, fields)) = declared.fields(shape, branch.as_deref()) else { return };
                for (arg, field) in args.iter().zip(fields) {
                    self.give(arg, *field, is_positive, scope);
                }
            }
            _ => {}
        }
    }

    /// Infers what one side of a comparison tells of the other; true when something was new.
    fn compare_kinds(&mut self, left: &syntax::Expr, right: &syntax::Expr, scope: &Scope) -> bool {
        let Some(kind) = self.common_kind(left, right, scope) else { return false };
        let mut changed = false;
        for side in [left, right] {
            match side {
                syntax::Expr::Variable(name) => {
                    let known = &mut self.variables[scope[&name.text] as usize].kind;
                    changed |= known.is_none();
                    known.get_or_insert(kind);
                }
                syntax::Expr::Record { .. } => changed |= self.give_fields(side, kind, scope),
                // z + 1 = x tells of z as well.
                syntax::Expr::Call { functor, args, .. } if functor.is_arithmetic() => {
                    for arg in args {
                        if let syntax::Expr::Variable(name) = arg {
                            let known = &mut self.variables[scope[&name.text] as usize].kind;
                            changed |= known.is_none();
                            known.get_or_insert(kind);
                        }
                    }
                }
                _ => {}
            }
        }
        changed
    }

    /// The fields of a record that is compared with a value of a known type.
    fn give_fields(&mut self, record: &syntax::Expr, kind: Kind, scope: &Scope) -> bool {
        let (syntax::Expr::Record { args, branch, .. }, Kind::Record(shape)) = (record, kind)
        else {
            return false;
        };
        let declared = self.declared;
        let Some((_, fields)) = declared.fields(shape, branch.as_deref()) else { return false };
        let mut changed = false;
        for (arg, field) in args.iter().zip(fields) {
            let kind = declared.types[*field].kind;
            match arg {
                syntax::Expr::Variable(name) => {
                    let known = &mut self.variables[scope[&name.text] as usize];
                    if known.kind.is_none() {
                        (known.kind, known.of) = (Some(kind), Some(*field));
                        changed = true;
                    }
                }
                syntax::Expr::Record { .. } => changed |= self.give_fields(arg, kind, scope),
                _ => {}
            }
        }
        changed
    }

    /// What an expression is computed as, as far as its variables are known.
    pub(super) fn kind_of(&self, expr: &syntax::Expr, scope: &Scope) -> Option<Kind> {
        self.kind_in(expr, &|name| self.variables[*scope.get(name)? as usize].kind)
    }

    /// The same, whoever knows the variables.
    fn kind_in(&self, expr: &syntax::Expr, known: &dyn Fn(&str) -> Option<Kind>) -> Option<Kind> {
        match expr {
            syntax::Expr::Variable(name) => known(&name.text),
            syntax::Expr::Number(..) => Some(Kind::Number),
            syntax::Expr::Unsigned(..) => Some(Kind::Unsigned),
            syntax::Expr::Decimal(..) => Some(Kind::Float),
            syntax::Expr::Text(..) => Some(Kind::Symbol),
            syntax::Expr::Record { branch, .. } => {
                let of = self.declared.branch(&branch.as_ref()?.text)?;
                Some(Kind::Record(of))
            }
            syntax::Expr::As { type_name, .. } => {
                let of = self.declared.type_named(&type_name.text)?;
                Some(self.declared.types[of].kind)
            }
            syntax::Expr::Call { functor, args, .. } if functor.is_arithmetic() => {
                let mut own = args.iter().filter(|arg| !is_whole(arg)).peekable();
                if own.peek().is_none() {
                    return Some(Kind::Number);
                }
                own.find_map(|arg| self.kind_in(arg, known))
            }
            syntax::Expr::Call { functor, .. } => Some(functor.result()),
            syntax::Expr::Aggregate { function: Aggregation::Count, .. } => Some(Kind::Number),
            syntax::Expr::Aggregate { value, body, .. } => {
                let value = value.as_deref()?;
                let within = self.kinds_within(body, known);
                let both = |name: &str| known(name).or_else(|| within.get(name).copied());
                Some(self.kind_in(value, &both).unwrap_or(Kind::Number))
            }
            syntax::Expr::Any(_) | syntax::Expr::Nil(_) => None,
        }
    }

    /// What the names of an aggregate's body are computed as.
    fn kinds_within(
        &self,
        body: &Body,
        outer: &dyn Fn(&str) -> Option<Kind>,
    ) -> HashMap<String, Kind> {
        let mut within = HashMap::new();
        let (mut atoms, mut compares) = (Vec::new(), Vec::new());
        premises_of(body, &mut atoms, &mut compares);
        for atom in atoms {
            let Some(relation) = self.declared.names.find(&atom.relation.text) else { continue };
            for (arg, of) in atom.args.iter().zip(&self.declared.columns[relation.index()]) {
                self.note_kinds(arg, self.declared.types[*of].kind, &mut within);
            }
        }
        let mut takes_weak = false;
        loop {
            let before = within.len();
            for (left, right) in &compares {
                let both = |name: &str| outer(name).or_else(|| within.get(name).copied());
                let (of_left, of_right) = (self.kind_in(left, &both), self.kind_in(right, &both));
                let kind = match is_whole(left) {
                    true => of_right.or(of_left),
                    false => of_left.or(of_right),
                };
                let is_weak =
                    is_whole(left) && of_right.is_none() || is_whole(right) && of_left.is_none();
                let Some(kind) = kind.filter(|_| takes_weak || !is_weak) else { continue };
                self.note_kinds(left, kind, &mut within);
                self.note_kinds(right, kind, &mut within);
                if takes_weak && within.len() > before {
                    break;
                }
            }
            match within.len() == before {
                true if takes_weak => return within,
                done => takes_weak = done,
            }
        }
    }

    /// Notes what an expression of a kind tells of its names.
    fn note_kinds(&self, expr: &syntax::Expr, kind: Kind, within: &mut HashMap<String, Kind>) {
        match expr {
            syntax::Expr::Variable(name) => {
                within.entry(name.text.clone()).or_insert(kind);
            }
            syntax::Expr::Call { functor, args, .. } if functor.is_arithmetic() => {
                args.iter().for_each(|arg| self.note_kinds(arg, kind, within));
            }
            syntax::Expr::Record { args, branch, .. } => {
                let Kind::Record(shape) = kind else { return };
                let fields = self.declared.fields(shape, branch.as_deref());
                for (arg, field) in args.iter().zip(fields.map_or(&[][..], |(_, fields)| fields)) {
                    self.note_kinds(arg, self.declared.types[*field].kind, within);
                }
            }
            _ => {}
        }
    }

    /// The kind that both sides of a comparison have; a whole number is of the other side's.
    pub(super) fn common_kind(
        &self,
        left: &syntax::Expr,
        right: &syntax::Expr,
        scope: &Scope,
    ) -> Option<Kind> {
        let (of_left, of_right) = (self.kind_of(left, scope), self.kind_of(right, scope));
        if is_whole(left) { of_right.or(of_left) } else { of_left.or(of_right) }
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
            (Some(known), _) if known != kind => false,
            // What is asked to be absent need only be comparable, as in Soufflé.
            _ if !is_positive => true,
            (_, Some(before)) if !kind.is_number() || is_declared(before) || is_declared(of) => {
                self.declared.is_subtype(before, of) || self.declared.is_subtype(of, before)
            }
            _ => true,
        };
        if !fits {
            let expected = self.declared.types[of].name.clone();
            let found = before.map_or_else(
                || self.declared.kind_text(known.kind.unwrap_or(Kind::Symbol)),
                |before| self.declared.types[before].name.clone(),
            );
            self.fault(
                at,
                RuleError::Types { what: name, expected, found: found.into(), at: at.into() },
            );
            return;
        }
        known.kind = Some(kind);
        if is_positive && before.is_none_or(|before| self.declared.is_subtype(of, before)) {
            self.variables[variable as usize].of = Some(of);
        }
    }

    /// Whether an expression may stand where values of a kind are wanted.
    pub(super) fn fits(&self, expr: &syntax::Expr, kind: Kind, scope: &Scope) -> bool {
        if matches!(expr, syntax::Expr::Nil(_)) {
            return matches!(kind, Kind::Record(of) if self.declared.fields(of, None).is_some());
        }
        self.kind_of(expr, scope).is_none_or(|known| known == kind)
            || matches!(kind, Kind::Float | Kind::Unsigned) && is_whole(expr)
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
            syntax::Expr::Number(number, _) | syntax::Expr::Unsigned(number, _) => {
                number.to_string()
            }
            syntax::Expr::Record { branch: Some(branch), .. } => format!("${}", branch.text),
            syntax::Expr::Record { .. } => "[…]".into(),
            syntax::Expr::Nil(_) => "nil".into(),
            syntax::Expr::Decimal(number, _) => Decimal::from_millionths(*number).to_string(),
            syntax::Expr::Text(text, _) => text.clone(),
            syntax::Expr::As { .. } => "as".into(),
            syntax::Expr::Call { functor, .. } => functor.word().into(),
            syntax::Expr::Aggregate { function, .. } => function.word().into(),
            syntax::Expr::Any(_) => "_".into(),
        };
        let found = match expr {
            syntax::Expr::Nil(_) => said!("a-record"),
            _ => {
                let kind = self.kind_of(expr, scope).unwrap_or(Kind::Symbol);
                self.declared.kind_text(kind).into()
            }
        };
        let expected = self.declared.kind_text(expected);
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
            if !matches!(arg, syntax::Expr::Variable(_)) && !self.fits(arg, column.kind, scope) {
                self.wrong_kind(arg, column.kind, scope);
                continue;
            }
            let variable = &self.variables[id as usize];
            let kind = variable.kind.unwrap_or(column.kind);
            let narrower = variable
                .of
                .is_none_or(|of| !is_declared(wanted) || declared.is_subtype(of, wanted));
            if kind != column.kind || !narrower {
                let found = match variable.of {
                    Some(of) => declared.types[of].name.clone(),
                    None => declared.kind_text(kind),
                };
                let (what, at) = (variable.name.clone(), arg.at());
                let expected = column.type_name.clone();
                self.fault(
                    at,
                    RuleError::Types { what, expected, found: found.into(), at: at.into() },
                );
            }
            self.variables[id as usize].kind.get_or_insert(column.kind);
        }
        true
    }
}

/// The atoms and comparisons of a body at its own level.
fn premises_of<'a>(
    body: &'a Body,
    atoms: &mut Vec<&'a syntax::Atom>,
    compares: &mut Vec<(&'a syntax::Expr, &'a syntax::Expr)>,
) {
    match body {
        Body::All(parts) | Body::Any(parts) => {
            parts.iter().for_each(|part| premises_of(part, atoms, compares));
        }
        Body::Not(part) => premises_of(part, atoms, compares),
        Body::Atom(atom) => atoms.push(atom),
        Body::Compare { op, left, right, .. } => {
            use syntax::Comparison::{Contains, Matches, NotContains, NotMatches};
            if !matches!(op, Contains | NotContains | Matches | NotMatches) {
                compares.push((left, right));
            }
        }
    }
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
