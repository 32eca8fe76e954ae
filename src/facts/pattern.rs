//! Records and branches in rules: built from their fields, or taken apart into them.
//!
//! `p([a, [b, _]])` reads `p(V)`, `a = V[0]`, `b = V[1][0]`, where a field of `nil` or of another branch has no value.
//! `v = [a, b]` may go either way, and both are put down: the fields where `v` comes first, the record where they do.

use super::clause::{Builder, Scope};
use super::fault::RuleError;
use super::program::{Compare, Expr, Kind, Literal};
use super::syntax::{self, Comparison, Functor, Record, Span};
use super::word::NO_WORD;

impl Builder<'_> {
    /// The number of the branch and the kinds of the fields; a fault where the record is not of the kind.
    fn fields(&mut self, record: &Record<'_>, wanted: Option<Kind>) -> Option<(u32, Vec<Kind>)> {
        let declared = self.declared;
        let known = record.branch.and_then(|name| declared.branch(&name.text)).map(Kind::Record);
        if let (Some(name), None) = (record.branch, known) {
            let what = format!("${}", name.text);
            self.fault(name.at, RuleError::Record { what, at: name.at.into() });
            return None;
        }
        let Some(Kind::Record(shape)) = known.or(wanted) else {
            let what = "[…]".to_owned();
            self.fault(record.at, RuleError::Record { what, at: record.at.into() });
            return None;
        };
        let Some((tag, fields)) = declared.fields(shape, record.branch) else {
            let (expected, found) = (declared.kind_text(Kind::Record(shape)), "[…]".to_owned());
            let what = record.branch.map_or("[…]".into(), |name| format!("${}", name.text));
            self.fault(
                record.at,
                RuleError::Types { what, expected, found: found.into(), at: record.at.into() },
            );
            return None;
        };
        if fields.len() != record.args.len() {
            let name = record.branch.map_or_else(
                || declared.kind_text(Kind::Record(shape)),
                |name| format!("${}", name.text),
            );
            let (expected, found) = (fields.len(), record.args.len());
            self.fault(record.at, RuleError::Arity { name, expected, found, at: record.at.into() });
            return None;
        }
        Some((tag, fields.iter().map(|of| declared.types[*of].kind).collect()))
    }

    /// The record made of its fields.
    pub(super) fn build(
        &mut self,
        record: &Record<'_>,
        wanted: Option<Kind>,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<Expr> {
        let (tag, kinds) = self.fields(record, wanted)?;
        let mut values = Vec::with_capacity(kinds.len() + 1);
        if tag != NO_WORD {
            values.push(Expr::Constant(tag));
        }
        for (arg, kind) in record.args.iter().zip(kinds) {
            self.expect(arg, kind, scope);
            values.push(self.expr(arg, Some(kind), scope, body)?);
        }
        let constants: Option<Vec<u32>> = values
            .iter()
            .map(|value| match value {
                Expr::Constant(word) => Some(*word),
                _ => None,
            })
            .collect();
        Some(match constants {
            Some(row) => Expr::Constant(self.words.record(&row)),
            None => Expr::Call(Functor::Record, values),
        })
    }

    /// Puts down that a value is such a record: what its fields are, and that it is no other.
    pub(super) fn take_apart(
        &mut self,
        value: &Expr,
        record: &Record<'_>,
        wanted: Option<Kind>,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<()> {
        let (tag, kinds) = self.fields(record, wanted)?;
        let at = record.at;
        let first = u32::from(tag != NO_WORD);
        let field = |n: u32, tag: u32| {
            let parts = vec![value.clone(), Expr::Constant(tag), Expr::Constant(n)];
            Expr::Call(Functor::Field, parts)
        };
        let mut is_told = false;
        for ((n, arg), kind) in record.args.iter().enumerate().zip(kinds) {
            let of = field(n as u32 + first, tag);
            match arg {
                syntax::Expr::Any(_) => continue,
                syntax::Expr::Record { .. } => {
                    let inner = Record::of(arg)?;
                    self.take_apart(&of, &inner, Some(kind), scope, body)?;
                }
                _ => {
                    self.expect(arg, kind, scope);
                    let left = self.expr(arg, Some(kind), scope, body)?;
                    let op = Comparison::Equal;
                    body.push(Literal::Compare(Compare { op, left, right: of, kind, at }));
                }
            }
            is_told = true;
        }
        if !is_told {
            // Nothing is asked of the fields, but it is neither `nil` nor another branch.
            let (left, kind, op, right) = match tag {
                NO_WORD => {
                    let nil = Expr::Constant(super::word::NIL);
                    let kind = wanted.unwrap_or(Kind::Record(0));
                    (value.clone(), kind, Comparison::NotEqual, nil)
                }
                tag => (field(0, tag), Kind::Number, Comparison::Equal, Expr::Constant(tag)),
            };
            body.push(Literal::Compare(Compare { op, left, right, kind, at }));
        }
        Some(())
    }

    /// `left = right` where one side is a record at least.
    pub(super) fn equal_records(
        &mut self,
        (left, right): (&syntax::Expr, &syntax::Expr),
        kind: Option<Kind>,
        at: Span,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<()> {
        let (record, other) = match (Record::of(left), Record::of(right)) {
            (Some(one), Some(other)) => {
                return self.equal_fields(&one, &other, kind, at, scope, body);
            }
            (Some(record), None) => (record, right),
            (None, Some(record)) => (record, left),
            (None, None) => return None,
        };
        self.expect_kind(other, kind, scope)?;
        let value = self.expr(other, kind, scope, body)?;
        let has_open = record.args.iter().any(has_wildcard);
        // Where an atom says what the value is, the record need not be built.
        let is_given = matches!(value, Expr::Variable(v) if self.in_atoms.contains(&v));
        if !has_open && !is_given {
            let built = self.build(&record, kind, scope, body)?;
            let kind = kind.unwrap_or(Kind::Record(0));
            let (left, op) = (value.clone(), Comparison::Equal);
            body.push(Literal::Compare(Compare { op, left, right: built, kind, at }));
        }
        self.take_apart(&value, &record, kind, scope, body)
    }

    fn expect_kind(
        &mut self,
        expr: &syntax::Expr,
        kind: Option<Kind>,
        scope: &Scope,
    ) -> Option<()> {
        let is_sound = self.is_sound;
        if let Some(kind) = kind {
            self.expect(expr, kind, scope);
        }
        (self.is_sound || !is_sound).then_some(())
    }

    /// `[a, b] = [c, d]`: field by field.
    fn equal_fields(
        &mut self,
        one: &Record<'_>,
        other: &Record<'_>,
        wanted: Option<Kind>,
        at: Span,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<()> {
        let (tag, kinds) = self.fields(one, wanted)?;
        let (other_tag, _) = self.fields(other, wanted)?;
        if tag != other_tag {
            let (left, right) = (Expr::Constant(tag), Expr::Constant(other_tag));
            let (op, kind) = (Comparison::Equal, Kind::Number);
            body.push(Literal::Compare(Compare { op, left, right, kind, at }));
            return Some(());
        }
        for ((left, right), kind) in one.args.iter().zip(other.args).zip(kinds) {
            if matches!(left, syntax::Expr::Any(_)) || matches!(right, syntax::Expr::Any(_)) {
                continue;
            }
            if Record::of(left).is_some() || Record::of(right).is_some() {
                self.equal_records((left, right), Some(kind), at, scope, body)?;
                continue;
            }
            self.expect(left, kind, scope);
            self.expect(right, kind, scope);
            let left = self.expr(left, Some(kind), scope, body)?;
            let right = self.expr(right, Some(kind), scope, body)?;
            let op = Comparison::Equal;
            body.push(Literal::Compare(Compare { op, left, right, kind, at }));
        }
        Some(())
    }
}

/// Whether an expression leaves something open.
pub(super) fn has_wildcard(expr: &syntax::Expr) -> bool {
    match expr {
        syntax::Expr::Any(_) => true,
        syntax::Expr::Record { args, .. } => args.iter().any(has_wildcard),
        _ => false,
    }
}
