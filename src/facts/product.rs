//! Warnings about products: premises that nothing ties, of which all pairs are tried.

use std::collections::BTreeSet;
use std::sync::Arc;

use super::declared::Declared;
use super::fault::{Found, RuleError};
use super::program::{Clause, Compare, Expr, Fact, Literal, Term, VariableId, used_variables};
use super::syntax::{Aggregation, Comparison};

pub(super) fn warn(
    declared: &Declared,
    clauses: &[Arc<Clause>],
    facts: &[Fact],
    faults: &mut Found,
) {
    let is_one = &at_most_one(declared, clauses, facts);
    for clause in clauses {
        let mut told = Vec::new();
        clause.args.iter().for_each(|arg| arg.for_each_variable(&mut |v| told.push(v)));
        let variables = clause.variables.len();
        Products { declared, is_one, variables, faults }.of(&clause.body, &told, &[]);
    }
}

/// Where premises are tried in all pairs.
struct Products<'a> {
    declared: &'a Declared,
    is_one: &'a [bool],
    variables: usize,
    faults: &'a mut Found,
}

impl Products<'_> {
    /// Premises in groups that share variables, by whatever premise. What is told of one group is told with all that is
    /// told of another: the first two groups of which anything is told are warned of. `fixed` come from outside.
    fn of(&mut self, body: &[Literal], told: &[VariableId], fixed: &[VariableId]) {
        let made = made(body, self.variables);
        let mut groups = Groups((0..self.variables).collect());
        let tie = |groups: &mut Groups, first: &mut Option<VariableId>, v| {
            made.origins(v, &mut |v| groups.join(*first.get_or_insert(v), v));
        };
        for literal in body.iter().filter(|literal| !is_making(literal, &made)) {
            let mut first = None;
            let one = std::slice::from_ref(literal);
            used_variables(one, None, &mut |v| tie(&mut groups, &mut first, v));
        }
        let mut first = None;
        fixed.iter().for_each(|v| tie(&mut groups, &mut first, *v));
        let mut asked = BTreeSet::new();
        // What is a single value makes no pairs.
        let is_fixed = |v| body.iter().any(|literal| fixes(literal, v));
        for v in told {
            made.origins(*v, &mut |v| {
                if !is_fixed(v) {
                    asked.insert(groups.find(v));
                }
            });
        }
        let mut open: Option<(usize, usize)> = None;
        for literal in body {
            let Literal::Atom(atom) = literal else { continue };
            let relation = atom.relation.index();
            let group = atom.args.iter().find_map(|term| match term {
                Term::Variable(v) => Some(groups.find(*v)),
                _ => None,
            });
            // Of a group of which nothing is told, it is enough that there is one; a single tuple makes no pairs.
            let group = group.filter(|group| asked.contains(group) && !self.is_one[relation]);
            match (group, open) {
                (Some(group), None) => open = Some((group, relation)),
                (Some(group), Some((known, before))) if known != group => {
                    let name = |n: usize| self.declared.relations[n].name.clone();
                    let (one, other) = (name(before), name(relation));
                    self.faults
                        .push(atom.at, RuleError::Product { one, other, at: atom.at.into() });
                    break;
                }
                _ => {}
            }
        }
        for literal in body {
            if let Literal::Aggregate(aggregate) = literal {
                let mut told = Vec::new();
                let value = aggregate.value.as_ref();
                match aggregate.function {
                    // The least of all pairs is asked of what it is the least of.
                    Aggregation::Min | Aggregation::Max => {
                        value
                            .iter()
                            .for_each(|value| value.for_each_variable(&mut |v| told.push(v)));
                    }
                    _ => used_variables(&aggregate.body, value, &mut |v| told.push(v)),
                }
                self.of(&aggregate.body, &told, &aggregate.shared);
            }
        }
    }
}

/// Variables in groups.
struct Groups(Vec<usize>);

impl Groups {
    fn find(&self, v: VariableId) -> usize {
        let mut v = v as usize;
        while self.0[v] != v {
            v = self.0[v];
        }
        v
    }

    fn join(&mut self, one: VariableId, other: VariableId) {
        let (one, other) = (self.find(one), self.find(other));
        self.0[other] = one;
    }
}

/// The variables that an equality makes of others, each with what it is made of: they tie nothing by themselves.
struct Made(Vec<Option<Vec<VariableId>>>);

impl Made {
    /// The variables that a variable comes of: itself, unless it is made.
    fn origins(&self, v: VariableId, f: &mut dyn FnMut(VariableId)) {
        match &self.0[v as usize] {
            Some(of) => of.iter().for_each(|v| self.origins(*v, f)),
            None => f(v),
        }
    }
}

fn made(body: &[Literal], variables: usize) -> Made {
    let mut is_bound = vec![false; variables];
    for literal in body {
        match literal {
            Literal::Atom(atom) => atom.args.iter().for_each(|term| {
                if let Term::Variable(v) = term {
                    is_bound[*v as usize] = true;
                }
            }),
            Literal::Range(range) => is_bound[range.target as usize] = true,
            Literal::Aggregate(aggregate) => is_bound[aggregate.target as usize] = true,
            Literal::Not(_) | Literal::Compare(_) => {}
        }
    }
    let mut made = vec![None; variables];
    // One after another, so that nothing is made of itself.
    while let Some((v, of)) = body.iter().find_map(|literal| making(literal, &is_bound)) {
        is_bound[v as usize] = true;
        made[v as usize] = Some(of);
    }
    Made(made)
}

/// What an equality makes of bound variables.
fn making(literal: &Literal, is_bound: &[bool]) -> Option<(VariableId, Vec<VariableId>)> {
    let Literal::Compare(Compare { op: Comparison::Equal, left, right, .. }) = literal else {
        return None;
    };
    [(left, right), (right, left)].into_iter().find_map(|(target, value)| {
        let Expr::Variable(v) = target else { return None };
        let is_made = !is_bound[*v as usize] && value.all_variables(|v| is_bound[v as usize]);
        let mut of = Vec::new();
        value.for_each_variable(&mut |v| of.push(v));
        is_made.then_some((*v, of))
    })
}

/// Whether a comparison is what makes a variable, and no condition.
fn is_making(literal: &Literal, made: &Made) -> bool {
    let Literal::Compare(Compare { op: Comparison::Equal, left, right, .. }) = literal else {
        return false;
    };
    [(left, right), (right, left)].into_iter().any(|(target, value)| {
        let Expr::Variable(v) = target else { return false };
        let mut of = Vec::new();
        value.for_each_variable(&mut |v| of.push(v));
        made.0[*v as usize].as_ref() == Some(&of)
    })
}

/// Whether an equality gives a variable a constant.
fn fixes(literal: &Literal, v: VariableId) -> bool {
    let Literal::Compare(Compare { op: Comparison::Equal, left, right, .. }) = literal else {
        return false;
    };
    let sides = [(left, right), (right, left)];
    sides.into_iter().any(|(to, value)| *to == Expr::Variable(v) && !value.has_variables())
}

/// Relations that hold one tuple at most: a single fact of the text, or one rule of nothing but such and aggregates.
fn at_most_one(declared: &Declared, clauses: &[Arc<Clause>], facts: &[Fact]) -> Vec<bool> {
    let mut told = vec![0_usize; declared.relations.len()];
    facts.iter().for_each(|fact| told[fact.relation.index()] += 1);
    clauses.iter().for_each(|clause| told[clause.head.index()] += 1);
    let may_be = |n: usize| told[n] == 1 && declared.relations[n].inputs.is_empty();
    let mut is_one = vec![false; told.len()];
    facts.iter().for_each(|fact| is_one[fact.relation.index()] = may_be(fact.relation.index()));
    loop {
        let is_single = |literal: &Literal| match literal {
            Literal::Atom(atom) => is_one[atom.relation.index()],
            Literal::Range(_) => false,
            _ => true,
        };
        let more = clauses.iter().find(|clause| {
            let head = clause.head.index();
            !is_one[head] && may_be(head) && clause.body.iter().all(is_single)
        });
        let Some(clause) = more else { return is_one };
        is_one[clause.head.index()] = true;
    }
}
