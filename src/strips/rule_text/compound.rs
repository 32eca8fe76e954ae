//! Conditions of a rule file beyond a fact and its negation, and effects that hang on a condition.

use super::{PLAIN_FACT, Parsed, Parser, is_if, is_or, is_then};
use crate::syntax::{Atom, Condition, ConditionalText, DerivedText, Parameter, none_of};
use crate::token::TokenKind;
use crate::units::{name_key, word};

/// Plain effects, and those that hang on a condition or range over objects.
type Effects = (Vec<Atom>, Vec<ConditionalText>);

/// No person nests deeper.
const MAX_DEPTH: usize = 50;

impl Parser<'_> {
    /// A group, a quantifier or an implication, if one stands here.
    pub(super) fn compound(&mut self) -> Parsed<Option<Condition>> {
        if self.kind() == Some(TokenKind::Open) && !self.opens_part() {
            let mut group = self.group()?;
            return Ok(Some(match group.len() {
                1 => group.swap_remove(0),
                _ => Condition::Any(vec![group]),
            }));
        }
        if let Some(every) = self.quantifier() {
            self.deeper()?;
            self.advance();
            let variables = self.bound_variables()?;
            let body = self.one()?;
            self.depth -= 1;
            return Ok(Some(Condition::Quantified { every, variables, body }));
        }
        match self.kind() {
            Some(TokenKind::Word(word))
                if is_if(word) && self.kind_after(1) == Some(TokenKind::Open) =>
            {
                self.advance();
                let if_so = self.one()?;
                self.then()?;
                let then = self.one()?;
                Ok(Some(Condition::Any(vec![vec![none_of(if_so)], then])))
            }
            _ => Ok(None),
        }
    }

    /// `(A, B ИЛИ C)`: what stands in it holds together; with «or», one of the parts.
    pub(super) fn group(&mut self) -> Parsed<Vec<Condition>> {
        self.deeper()?;
        let open = self.advance();
        let mut cases = vec![self.conditions()?];
        while matches!(self.kind(), Some(TokenKind::Word(word)) if is_or(word)) {
            self.advance();
            cases.push(self.conditions()?);
        }
        self.depth -= 1;
        match self.kind() {
            Some(TokenKind::Close) if cases.iter().all(|case| !case.is_empty()) => {
                self.advance();
            }
            None => return Err(self.missing(open)),
            _ if self.heading_ahead().is_some() || self.opens_part() => {
                return Err(self.missing(open));
            }
            _ => return Err(self.expected(PLAIN_FACT)),
        }
        Ok(match cases.len() {
            1 => cases.swap_remove(0),
            _ => vec![Condition::Any(cases)],
        })
    }

    fn deeper(&mut self) -> Parsed<()> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            let what = word!("no-more-than-fifty-brackets-within-each");
            return Err(self.expected(what));
        }
        Ok(())
    }

    /// Whether «for all» or «there is» stands here, with its bracket.
    fn quantifier(&self) -> Option<bool> {
        let Some(TokenKind::Word(word)) = self.kind() else { return None };
        let every = match name_key(word).as_str() {
            "для-всех" | "forall" => true,
            "существует" | "exists" => false,
            _ => return None,
        };
        (self.kind_after(1) == Some(TokenKind::Open)).then_some(every)
    }

    /// `(тип ?x, ?y)`
    fn bound_variables(&mut self) -> Parsed<Vec<Parameter>> {
        let open = self.advance();
        let variables = self.parameters()?;
        match self.kind() {
            Some(TokenKind::Close) => {
                self.advance();
                Ok(variables)
            }
            None => Err(self.missing(open)),
            _ => Err(self.expected(word!("a-variable-such-as-x-or"))),
        }
    }

    /// One condition, or a group as its parts.
    pub(super) fn one(&mut self) -> Parsed<Vec<Condition>> {
        match self.kind() {
            Some(TokenKind::Open) => self.group(),
            _ => Ok(vec![self.condition()?]),
        }
    }

    fn then(&mut self) -> Parsed<()> {
        match self.kind() {
            Some(TokenKind::Word(word)) if is_then(word) => {
                self.advance();
                Ok(())
            }
            _ => Err(self.expected(word!("then"))),
        }
    }

    /// `Выводится: ВЫШЕ_(блок ?x, блок ?y) ЕСЛИ (…)`
    pub(super) fn derived(&mut self) -> Parsed<()> {
        let atom = self.atom_here()?;
        let parameter = |term: &crate::syntax::Term| Parameter {
            kinds: term.kind.clone().into_iter().collect(),
            variable: term.name.clone(),
        };
        if let Some(term) = atom.args.iter().find(|term| !term.is_variable) {
            let what = word!("a-variable-such-as-x");
            return Err(self.expected_at(what, term.name.at.span));
        }
        let parameters = atom.args.iter().map(parameter).collect();
        let condition = match self.kind() {
            Some(TokenKind::Word(word)) if is_if(word) => {
                self.advance();
                self.one()?
            }
            _ => return Err(self.expected(word!("if-and-a-condition"))),
        };
        self.text.document.derived.push(DerivedText { parameters, atom, condition });
        Ok(())
    }

    fn atom_here(&mut self) -> Parsed<Atom> {
        match (self.kind(), self.kind_after(1)) {
            (Some(TokenKind::Word(_)), Some(TokenKind::Open)) => self.atom(),
            _ => Err(self.expected(PLAIN_FACT)),
        }
    }

    /// Effects up to a closing bracket, a heading or the end.
    pub(super) fn effects(&mut self, adds: bool) -> Parsed<Effects> {
        let mut effects = Effects::default();
        let nothing = ConditionalText {
            variables: Vec::new(),
            condition: Vec::new(),
            add: Vec::new(),
            del: Vec::new(),
        };
        loop {
            match self.kind() {
                Some(TokenKind::Comma) => {
                    self.advance();
                }
                None | Some(TokenKind::Close) => return Ok(effects),
                Some(TokenKind::Word(_)) if self.heading_ahead().is_some() => return Ok(effects),
                Some(TokenKind::Open) if self.opens_part() => return Ok(effects),
                _ => self.effect(adds, &nothing, &mut effects)?,
            }
        }
    }

    fn effect(&mut self, adds: bool, around: &ConditionalText, into: &mut Effects) -> Parsed<()> {
        let is_plain = around.variables.is_empty() && around.condition.is_empty();
        if self.quantifier() == Some(true) {
            self.advance();
            let mut around = around.clone();
            around.variables.extend(self.bound_variables()?);
            return self.nested(adds, &around, into);
        }
        match self.kind() {
            Some(TokenKind::Word(word))
                if is_if(word) && self.kind_after(1) == Some(TokenKind::Open) =>
            {
                self.advance();
                let mut around = around.clone();
                around.condition.extend(self.one()?);
                self.then()?;
                self.nested(adds, &around, into)
            }
            Some(TokenKind::Word(word))
                if self.kind_after(1) == Some(TokenKind::Open) && !super::is_not(word) =>
            {
                let atom = self.atom()?;
                if is_plain {
                    into.0.push(atom);
                } else {
                    let mut one = around.clone();
                    if adds {
                        one.add.push(atom)
                    } else {
                        one.del.push(atom)
                    }
                    into.1.push(one);
                }
                Ok(())
            }
            _ => Err(self.expected(word!("a-fact-without-not-what-ceases-to"))),
        }
    }

    /// What hangs on a condition: one effect, or several in brackets.
    fn nested(&mut self, adds: bool, around: &ConditionalText, into: &mut Effects) -> Parsed<()> {
        if self.kind() != Some(TokenKind::Open) {
            return self.effect(adds, around, into);
        }
        self.deeper()?;
        let open = self.advance();
        loop {
            match self.kind() {
                Some(TokenKind::Comma) => {
                    self.advance();
                }
                Some(TokenKind::Close) => {
                    self.advance();
                    self.depth -= 1;
                    return Ok(());
                }
                None => return Err(self.missing(open)),
                _ => self.effect(adds, around, into)?,
            }
        }
    }
}
