//! Operands of a clause: expressions of the text over its variables, each functor as the kinds of its arguments ask.

use super::clause::{Builder, Scope};
use super::decimal;
use super::fault::RuleError;
use super::kinds::is_whole;
use super::program::{Bounds, Compare, Expr, Kind, Literal, NumberRange};
use super::regular::{self, NoPattern};
use super::syntax::{self, Comparison, Functor, Record, Span};
use super::word::NIL;
use crate::units::{nearest_name, said, word};

impl Builder<'_> {
    /// Says what a pattern that stands in the text cannot do.
    pub(super) fn check_pattern(&mut self, pattern: &syntax::Expr) {
        let syntax::Expr::Text(pattern, at) = pattern else { return };
        match regular::compile(pattern) {
            Ok(_) => {}
            Err(NoPattern::Backtracking) => {
                let what = said!("a-search-that-goes-back", pattern);
                let help = word!("do-without-1-and-they-cannot-be");
                self.fault(*at, RuleError::Unsupported { what, help, at: (*at).into() });
            }
            Err(NoPattern::Broken(why)) => {
                let (pattern, at) = (pattern.clone(), *at);
                self.faults.push(at, RuleError::Pattern { pattern, why, at: at.into() });
            }
        }
    }

    /// The expression over variables; `wanted` tells a whole number whether it stands for a decimal.
    pub(super) fn expr(
        &mut self,
        expr: &syntax::Expr,
        wanted: Option<Kind>,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<Expr> {
        Some(match expr {
            syntax::Expr::Any(at) => {
                self.fault(*at, RuleError::Wildcard { at: (*at).into() });
                return None;
            }
            syntax::Expr::Variable(name) => Expr::Variable(scope[&name.text]),
            syntax::Expr::Number(number, at) if wanted == Some(Kind::Float) => {
                let Some(number) = number.checked_mul(decimal::ONE) else {
                    let text = number.to_string();
                    self.fault(*at, RuleError::Number { text, at: (*at).into() });
                    return None;
                };
                Expr::Constant(self.words.number(number))
            }
            syntax::Expr::Number(number, at) | syntax::Expr::Unsigned(number, at) => {
                let is_unsigned =
                    wanted == Some(Kind::Unsigned) || matches!(expr, syntax::Expr::Unsigned(..));
                let is_narrow = match is_unsigned {
                    true => u32::try_from(*number).is_ok(),
                    false => i32::try_from(*number).is_ok(),
                };
                if is_unsigned && !is_narrow {
                    let text = number.to_string();
                    self.fault(*at, RuleError::Unsigned { text, at: (*at).into() });
                    return None;
                }
                if !is_narrow {
                    let number = *number;
                    self.faults.push(*at, RuleError::Wide { number, at: (*at).into() });
                }
                Expr::Constant(self.words.number(*number))
            }
            syntax::Expr::Decimal(number, _) => Expr::Constant(self.words.number(*number)),
            syntax::Expr::Nil(_) => Expr::Constant(NIL),
            syntax::Expr::Record { .. } => {
                return self.build(&Record::of(expr)?, wanted, scope, body);
            }
            syntax::Expr::Text(text, _) => Expr::Constant(self.words.symbol(text)),
            syntax::Expr::As { value, type_name, at } => {
                self.cast(value, type_name, *at, scope, body)?
            }
            syntax::Expr::Call { functor, args, at } => {
                let is_open = is_whole(expr)
                    && matches!(wanted, Some(Kind::Float | Kind::Unsigned | Kind::Number));
                let first = match functor.is_arithmetic() {
                    true if is_open => wanted,
                    true => self.kind_of(expr, scope).or(wanted),
                    false => args.first().and_then(|arg| self.kind_of(arg, scope)),
                };
                self.call(functor.for_kind(first), args, *at, scope, body)?
            }
            syntax::Expr::Aggregate { function, value, body: inner, at } => {
                let target =
                    self.aggregate(*function, value.as_deref(), inner, *at, scope, body)?;
                Expr::Variable(target)
            }
        })
    }

    /// `as(value, type)` between types that are computed alike; a symbol as a number is its ordinal.
    fn cast(
        &mut self,
        value: &syntax::Expr,
        type_name: &syntax::Name,
        at: Span,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<Expr> {
        let Some(of) = self.declared.type_named(&type_name.text) else {
            let nearest = self.declared.types.iter().map(|known| known.name.as_str());
            let nearest = nearest_name(&type_name.text, nearest).map(str::to_owned);
            let (name, at) = (type_name.text.clone(), type_name.at);
            self.fault(at, RuleError::UnknownType { name, nearest, at: at.into() });
            return None;
        };
        let (from, to) = (self.kind_of(value, scope), self.declared.types[of].kind);
        let from = if is_whole(value) && to.is_number() { Some(to) } else { from };
        let value = self.expr(value, Some(to), scope, body)?;
        match (from, to) {
            (Some(Kind::Symbol), Kind::Number) => Some(Expr::Call(Functor::Ordinal, vec![value])),
            (Some(Kind::Number), Kind::Unsigned) => {
                Some(Expr::Call(Functor::NumberToUnsigned, vec![value]))
            }
            (Some(Kind::Unsigned), Kind::Number) => {
                Some(Expr::Call(Functor::UnsignedToNumber, vec![value]))
            }
            (Some(from), to) if from != to => {
                let (from, to) = (self.declared.kind_text(from), self.declared.kind_text(to));
                let what = said!("as-from-to", from, to);
                let help = word!("there-are-to-number-to-float-and");
                self.fault(at, RuleError::Unsupported { what, help, at: at.into() });
                None
            }
            _ => {
                // X = as(Y, T) reads V = Y, X = V: the new variable has none of Y's types.
                let variable = self.fresh("", at);
                let made = &mut self.variables[variable as usize];
                (made.kind, made.of) = (Some(to), Some(of));
                let (left, op) = (Expr::Variable(variable), Comparison::Equal);
                body.push(Literal::Compare(Compare { op, left, right: value, kind: to, at }));
                Some(Expr::Variable(variable))
            }
        }
    }

    fn call(
        &mut self,
        functor: Functor,
        args: &[syntax::Expr],
        at: Span,
        scope: &Scope,
        body: &mut Vec<Literal>,
    ) -> Option<Expr> {
        let mut values = Vec::with_capacity(args.len());
        for (arg, kind) in args.iter().zip(functor.takes()) {
            if let syntax::Expr::Variable(name) = arg {
                self.variables[scope[&name.text] as usize].kind.get_or_insert(*kind);
            }
            // Soufflé takes anything there; the ordinal of a number is the number.
            if functor != Functor::Ordinal {
                self.expect(arg, *kind, scope);
            }
            values.push(self.expr(arg, Some(*kind), scope, body)?);
        }
        if functor == Functor::Ordinal && self.kind_of(&args[0], scope) == Some(Kind::Number) {
            return values.pop();
        }
        if functor.is_range() {
            return Some(self.range(functor, values, at, body));
        }
        if functor == Functor::Counter {
            return Some(Expr::Call(functor, values));
        }
        let call = Expr::Call(functor, values);
        // What is computed from constants alone is computed here, where they are of the kinds that they should be.
        if call.has_variables() || call.counts_on() || !self.is_sound {
            return Some(call);
        }
        let word = super::value::compute(&call, &|_| 0, self.words);
        if let Some(note) = self.words.take_note() {
            self.faults.push(at, note.told(at));
        }
        Some(word.map_or(call, Expr::Constant))
    }

    /// The variable that stands for the range's numbers, one after the other.
    fn range(
        &mut self,
        functor: Functor,
        mut values: Vec<Expr>,
        at: Span,
        body: &mut Vec<Literal>,
    ) -> Expr {
        let target = self.fresh("", at);
        let kind = functor.result();
        self.variables[target as usize].kind = Some(kind);
        let step = if values.len() > 2 { values.pop() } else { None };
        let (to, from) = (values.pop(), values.pop());
        let (from, to) = from.zip(to).expect("the reader counts the arguments");
        let unit = if kind == Kind::Float { decimal::ONE } else { 1 };
        let bounds = Bounds { from, to, step, unit };
        body.push(Literal::Range(NumberRange { target, kind, bounds, at }));
        Expr::Variable(target)
    }
}
