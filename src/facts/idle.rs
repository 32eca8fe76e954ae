//! Warnings about rules that do nothing, or more than was meant: premises that never hold, products without a join.

use std::sync::Arc;

use super::declare::Declared;
use super::fault::{RuleError, Told};
use super::ground::used_variables;
use super::program::{Clause, Expr, Fact, Found, Literal, Term};
use super::syntax::{Comparison, Span};
use crate::units::bilingual;

pub(super) fn warn(
    declared: &Declared,
    clauses: &[Arc<Clause>],
    facts: &[Fact],
    faults: &mut Found,
) {
    let may_hold = may_hold(declared, clauses, facts);
    for clause in clauses {
        never_fires(clause, declared, &may_hold, faults);
        product(clause, declared, faults);
    }
}

/// Relations that may have a tuple: told ones, and those of rules all of whose premises may hold. One that nothing fills
/// is told of by itself.
fn may_hold(declared: &Declared, clauses: &[Arc<Clause>], facts: &[Fact]) -> Vec<bool> {
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
        for clause in clauses {
            let holds = |literal: &Literal| match literal {
                Literal::Atom(atom) => may[atom.relation.index()],
                other => never(other).is_none(),
            };
            if !may[clause.head.index()] && clause.body.iter().all(holds) {
                may[clause.head.index()] = true;
                changed = true;
            }
        }
    }
    may
}

/// Why a comparison never holds.
fn never(literal: &Literal) -> Option<(Told, Span)> {
    let Literal::Compare(compare) = literal else { return None };
    use Comparison::{Equal, Greater, Less, NotEqual};
    let is_same =
        matches!((&compare.left, &compare.right), (Expr::Variable(a), Expr::Variable(b)) if a == b);
    let differ = match (&compare.left, &compare.right) {
        (Expr::Constant(a), Expr::Constant(b)) => Some(a != b),
        _ => None,
    };
    let never = match compare.op {
        Equal => differ == Some(true),
        NotEqual | Less | Greater => is_same || differ == Some(false),
        _ => false,
    };
    never.then_some((("сравнение всегда ложно", "the comparison is always false"), compare.at))
}

fn never_fires(clause: &Clause, declared: &Declared, may_hold: &[bool], faults: &mut Found) {
    for literal in &clause.body {
        let found = match literal {
            Literal::Atom(atom) if !may_hold[atom.relation.index()] => {
                let name = &declared.relations[atom.relation.index()].name;
                Some((bilingual!("«{name}» всегда пусто", "“{name}” is always empty"), atom.at))
            }
            other => never(other).map(|(why, at)| (why.into(), at)),
        };
        if let Some((why, at)) = found {
            faults.push(at, RuleError::NeverFires { why, at: at.into() });
        }
    }
}

/// Premises in groups that share variables, by whatever premise; the first two that are of different groups are told.
fn product(clause: &Clause, declared: &Declared, faults: &mut Found) {
    let mut group: Vec<usize> = (0..clause.variables.len()).collect();
    let find = |group: &[usize], mut v: usize| {
        while group[v] != v {
            v = group[v];
        }
        v
    };
    for literal in &clause.body {
        let mut first = None;
        used_variables(std::slice::from_ref(literal), None, &mut |v| {
            let root = find(&group, v as usize);
            let to = *first.get_or_insert(root);
            group[root] = to;
        });
    }
    let mut uses = vec![0_usize; clause.variables.len()];
    used_variables(&clause.body, None, &mut |v| uses[v as usize] += 1);
    clause.args.iter().for_each(|arg| arg.for_each_variable(&mut |v| uses[v as usize] += 1));
    let mut open: Option<(usize, usize)> = None;
    for literal in &clause.body {
        let Literal::Atom(atom) = literal else { continue };
        // An atom of which nothing is asked but that there is one makes no pairs: one that another branch of the rule asks
        // more of; a variable that the whole rule names once is told of by itself.
        let asked = atom.args.iter().find_map(|term| match term {
            Term::Variable(v) => (uses[*v as usize] > 1).then_some(*v as usize),
            _ => None,
        });
        let Some(v) = asked else { continue };
        let (root, relation) = (find(&group, v), atom.relation.index());
        match open {
            None => open = Some((root, relation)),
            Some((known, before)) if known != root => {
                let name = |n: usize| declared.relations[n].name.clone();
                let (one, other) = (name(before), name(relation));
                faults.push(atom.at, RuleError::Product { one, other, at: atom.at.into() });
                return;
            }
            Some(_) => {}
        }
    }
}
