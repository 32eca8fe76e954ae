//! Warnings about rules that never fire: premises that are always empty, or that exclude each other.

use std::sync::Arc;

use super::declared::Declared;
use super::fault::{Found, RuleError};
use super::program::{Atom, Clause, Compare, Expr, Fact, Kind, Literal, Term};
use super::syntax::{Comparison, Span};
use super::value;
use super::word::Words;
use crate::units::{Bilingual, said, word};

pub(super) fn warn(
    declared: &Declared,
    clauses: &[Arc<Clause>],
    facts: &[Fact],
    words: &Words,
    faults: &mut Found,
) {
    let excluded: Vec<Option<Excluded>> =
        clauses.iter().map(|clause| excluded(&clause.body, words)).collect();
    let may_hold = may_hold(declared, clauses, facts, &excluded);
    for (clause, excluded) in clauses.iter().zip(excluded) {
        let empty = clause.body.iter().filter_map(|literal| match literal {
            Literal::Atom(atom) if !may_hold[atom.relation.index()] => {
                let name = &declared.relations[atom.relation.index()].name;
                let why = said!("is-always-empty", name);
                Some((why, atom.at))
            }
            _ => None,
        });
        for (why, at) in empty.chain(excluded) {
            faults.push(at, RuleError::NeverFires { why, at: at.into() });
        }
    }
}

/// Relations that may have a tuple: told ones, and those of rules all of whose premises may hold. One that nothing fills
/// is told of by itself.
fn may_hold(
    declared: &Declared,
    clauses: &[Arc<Clause>],
    facts: &[Fact],
    excluded: &[Option<Excluded>],
) -> Vec<bool> {
    let mut may: Vec<bool> =
        declared.relations.iter().map(|info| !info.inputs.is_empty()).collect();
    facts.iter().for_each(|fact| may[fact.relation.index()] = true);
    let mut is_derived = vec![false; may.len()];
    clauses.iter().for_each(|clause| is_derived[clause.head.index()] = true);
    // What neither rules nor the text fill may be filled from outside.
    may.iter_mut().zip(&is_derived).for_each(|(may, is_derived)| *may |= !is_derived);
    let mut changed = true;
    while changed {
        changed = false;
        for (clause, excluded) in clauses.iter().zip(excluded) {
            let holds = |literal: &Literal| match literal {
                Literal::Atom(atom) => may[atom.relation.index()],
                _ => true,
            };
            let may_fire = excluded.is_none() && clause.body.iter().all(holds);
            if !may[clause.head.index()] && may_fire {
                may[clause.head.index()] = true;
                changed = true;
            }
        }
    }
    may
}

/// Why some premise never holds, and which.
type Excluded = (Bilingual, Span);

fn excluded(body: &[Literal], words: &Words) -> Option<Excluded> {
    let compares: Vec<&Compare> = body
        .iter()
        .filter_map(|literal| match literal {
            Literal::Compare(compare) => Some(compare),
            _ => None,
        })
        .filter(|compare| !compare.left.counts_on() && !compare.right.counts_on())
        .collect();
    if let Some(compare) = compares.iter().find(|compare| is_false(compare, words)) {
        let why = word!("the-comparison-is-always-false");
        return Some((why.into(), compare.at));
    }
    let mut order = Order::default();
    for compare in compares {
        if !order.takes(compare, words) {
            let why = word!("the-comparisons-exclude-each-other");
            return Some((why.into(), compare.at));
        }
    }
    let denied = body.iter().find_map(|literal| match literal {
        Literal::Not(not) => body.iter().any(|other| is_denied(other, not)).then_some(not.at),
        _ => None,
    })?;
    let why = word!("another-premise-states-the-same");
    Some((why.into(), denied))
}

/// Whether a comparison holds for no values.
fn is_false(compare: &Compare, words: &Words) -> bool {
    if let (Expr::Constant(left), Expr::Constant(right)) = (&compare.left, &compare.right) {
        return !value::holds(compare.op, compare.kind.is_number(), *left, *right, words);
    }
    compare.left == compare.right && orders(compare.op).is_some_and(|orders| !orders[1])
}

/// Expressions that are compared at most: what a rule compares beyond them is not looked at.
const MAX_COMPARED: usize = 64;

/// What comparisons say of the order of expressions, all that follows from them included.
#[derive(Default)]
struct Order<'a> {
    of: Vec<(Kind, &'a Expr)>,
    /// For each two whether the first stands before the second, and whether it may not be equal to it.
    before: Vec<Vec<Option<bool>>>,
    unequal: Vec<(usize, usize)>,
}

impl<'a> Order<'a> {
    /// Takes a comparison in; false where it cannot hold together with those before.
    fn takes(&mut self, compare: &'a Compare, words: &Words) -> bool {
        let Some([less, equal, greater]) = orders(compare.op) else { return true };
        let (Some(left), Some(right)) = (
            self.place(compare.kind, &compare.left, words),
            self.place(compare.kind, &compare.right, words),
        ) else {
            return true;
        };
        match (less, greater) {
            (true, true) => self.unequal.push((left, right)),
            (true, false) => self.put_before(left, right, !equal),
            (false, true) => self.put_before(right, left, !equal),
            (false, false) => {
                self.put_before(left, right, false);
                self.put_before(right, left, false);
            }
        }
        let is_equal = |(a, b): &(usize, usize)| {
            self.before[*a][*b].is_some() && self.before[*b][*a].is_some()
        };
        (0..self.of.len()).all(|at| self.before[at][at] == Some(false))
            && !self.unequal.iter().any(is_equal)
    }

    fn place(&mut self, kind: Kind, expr: &'a Expr, words: &Words) -> Option<usize> {
        if let Some(known) = self.of.iter().position(|known| *known == (kind, expr)) {
            return Some(known);
        }
        let at = self.of.len();
        if at == MAX_COMPARED {
            return None;
        }
        self.of.push((kind, expr));
        self.before.iter_mut().for_each(|row| row.push(None));
        self.before.push(vec![None; at + 1]);
        self.before[at][at] = Some(false);
        for other in 0..at {
            let (Expr::Constant(one), (of, Expr::Constant(two))) = (expr, self.of[other]) else {
                continue;
            };
            if of != kind {
                continue;
            }
            let is = |op| value::holds(op, kind.is_number(), *one, *two, words);
            match kind {
                Kind::Record(_) => self.unequal.push((at, other)),
                _ if is(Comparison::Less) => self.put_before(at, other, true),
                _ => self.put_before(other, at, true),
            }
        }
        Some(at)
    }

    fn put_before(&mut self, one: usize, other: usize, is_strict: bool) {
        for a in 0..self.of.len() {
            let Some(to_one) = self.before[a][one] else { continue };
            for b in 0..self.of.len() {
                let Some(from_other) = self.before[other][b] else { continue };
                let is_strict = is_strict || to_one || from_other;
                self.before[a][b] = self.before[a][b].max(Some(is_strict));
            }
        }
    }
}

/// Whether a comparison allows less, equal and greater; none where it is about no order.
fn orders(op: Comparison) -> Option<[bool; 3]> {
    Some(match op {
        Comparison::Equal => [false, true, false],
        Comparison::NotEqual => [true, false, true],
        Comparison::Less => [true, false, false],
        Comparison::LessOrEqual => [true, true, false],
        Comparison::Greater => [false, false, true],
        Comparison::GreaterOrEqual => [false, true, true],
        Comparison::Contains
        | Comparison::NotContains
        | Comparison::Matches
        | Comparison::NotMatches => return None,
    })
}

/// Whether a negation denies what a premise states.
fn is_denied(premise: &Literal, not: &Atom) -> bool {
    let Literal::Atom(atom) = premise else { return false };
    let same = |(stated, denied): (&Term, &Term)| {
        *denied == Term::Any || (stated == denied && *stated != Term::Any)
    };
    atom.relation == not.relation && atom.args.iter().zip(&not.args).all(same)
}
