//! Warnings about rules that never fire: premises that are always empty, or that exclude each other.

use std::cmp::Ordering;
use std::sync::Arc;

use super::declare::Declared;
use super::fault::RuleError;
use super::program::{Atom, Clause, Compare, Expr, Fact, Found, Literal, Term};
use super::syntax::{Comparison, Span};
use super::value;
use super::word::Words;
use crate::units::Bilingual;

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
                let why = Bilingual::new(
                    format!("«{name}» всегда пусто"),
                    format!("“{name}” is always empty"),
                );
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
        let why = ("сравнение всегда ложно", "the comparison is always false");
        return Some((why.into(), compare.at));
    }
    for (n, compare) in compares.iter().enumerate() {
        if compares[..n].iter().any(|earlier| exclude(earlier, compare, words)) {
            let why = ("сравнения исключают друг друга", "the comparisons exclude each other");
            return Some((why.into(), compare.at));
        }
    }
    let denied = body.iter().find_map(|literal| match literal {
        Literal::Not(not) => body.iter().any(|other| is_denied(other, not)).then_some(not.at),
        _ => None,
    })?;
    let why = ("то же утверждает другая посылка", "another premise states the same");
    Some((why.into(), denied))
}

/// Whether a comparison holds for no values.
fn is_false(compare: &Compare, words: &Words) -> bool {
    if let (Expr::Constant(left), Expr::Constant(right)) = (&compare.left, &compare.right) {
        return !value::holds(compare.op, compare.kind.is_number(), *left, *right, words);
    }
    compare.left == compare.right && orders(compare.op).is_some_and(|orders| !orders[1])
}

/// Whether two comparisons of the same hold for no values together.
fn exclude(one: &Compare, other: &Compare, words: &Words) -> bool {
    let turned = |compare: &Compare, left: &Expr| {
        let Compare { op, .. } = compare;
        if compare.left == *left {
            return Some((orders(*op)?, compare.right.clone()));
        }
        (compare.right == *left)
            .then(|| Some((orders(op.mirrored()?)?, compare.left.clone())))
            .flatten()
    };
    [&one.left, &one.right].into_iter().filter(|left| left.has_variables()).any(|left| {
        let (Some((one_may, one_to)), Some((other_may, other_to))) =
            (turned(one, left), turned(other, left))
        else {
            return false;
        };
        // How the one's other side stands to the other's.
        let stand = match (&one_to, &other_to) {
            (one, other) if one == other => Ordering::Equal,
            (Expr::Constant(a), Expr::Constant(b)) => {
                let is = |op| value::holds(op, one.kind.is_number(), *a, *b, words);
                match () {
                    () if is(Comparison::Less) => Ordering::Less,
                    () if is(Comparison::Greater) => Ordering::Greater,
                    () => Ordering::Equal,
                }
            }
            _ => return false,
        };
        // Below the lesser, at it, between, at the greater, above it.
        let places = |[less, equal, greater]: [bool; 3], is_lesser: bool| match is_lesser {
            true => [less, equal, greater, greater, greater],
            false => [less, less, less, equal, greater],
        };
        let (a, b) = match stand {
            Ordering::Equal => (places(one_may, true), places(other_may, true)),
            Ordering::Less => (places(one_may, true), places(other_may, false)),
            Ordering::Greater => (places(one_may, false), places(other_may, true)),
        };
        !a.iter().zip(b).any(|(a, b)| *a && b)
    })
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
