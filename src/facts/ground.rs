//! Whether every variable of a rule is bound by something, and which variables a body reads.

use super::clause::{Builder, VariableType};
use super::fault::RuleError;
use super::program::{Aggregate, Compare, Expr, Literal, Term, VariableId, used_variables};
use super::syntax::Comparison;

impl Builder<'_> {
    pub(super) fn check_bound(&mut self, body: &[Literal], args: &[Expr]) {
        let mut bound = vec![false; self.variables.len()];
        self.excused.iter().for_each(|v| bound[*v as usize] = true);
        let mut loose = Vec::new();
        find_unbound(body, None, &mut bound, &mut loose);
        for arg in args {
            arg.for_each_variable(&mut |v| {
                if !bound[v as usize] {
                    loose.push(v);
                }
            });
        }
        loose.sort_unstable();
        loose.dedup();
        for v in loose {
            let VariableType { name, at, .. } = &self.variables[v as usize];
            let (variable, at) = (name.clone(), *at);
            // An unnamed variable stands for an expression whose own variables are reported.
            if variable.is_empty() {
                self.is_sound = false;
            } else {
                self.fault(at, RuleError::Ungrounded { variable, at: at.into() });
            }
        }
    }
}

/// Marks what a body binds, and lists the variables that it uses without binding them.
fn find_unbound(
    body: &[Literal],
    value: Option<&Expr>,
    bound: &mut [bool],
    loose: &mut Vec<VariableId>,
) {
    for literal in body {
        if let Literal::Atom(atom) = literal {
            for term in &atom.args {
                if let Term::Variable(v) = term {
                    bound[*v as usize] = true;
                }
            }
        }
    }
    let mut changed = true;
    while changed {
        changed = false;
        for literal in body {
            changed |= match literal {
                Literal::Compare(Compare { op: Comparison::Equal, left, right, .. }) => {
                    bind(left, right, bound) || bind(right, left, bound)
                }
                Literal::Range(range) => {
                    let is_known = |expr: &Expr| expr.all_variables(|v| bound[v as usize]);
                    let ready = range.bounds.exprs().all(is_known);
                    ready && !std::mem::replace(&mut bound[range.target as usize], true)
                }
                Literal::Aggregate(aggregate) => {
                    let ready = aggregate.shared.iter().all(|v| bound[*v as usize]);
                    ready && !std::mem::replace(&mut bound[aggregate.target as usize], true)
                }
                _ => false,
            };
        }
    }
    let mut used = Vec::new();
    used_variables(body, value, &mut |v| used.push(v));
    for literal in body {
        if let Literal::Aggregate(aggregate) = literal {
            used.retain(|v| !is_local(aggregate, *v));
            let mut within = bound.to_vec();
            find_unbound(&aggregate.body, aggregate.value.as_ref(), &mut within, loose);
        }
    }
    loose.extend(used.into_iter().filter(|v| !bound[*v as usize]));
}

/// Whether a variable belongs to the aggregate alone: those are numbered between its outer ones and its target.
fn is_local(aggregate: &Aggregate, v: VariableId) -> bool {
    let mut inside = false;
    used_variables(&aggregate.body, aggregate.value.as_ref(), &mut |used| inside |= used == v);
    inside && !aggregate.shared.contains(&v)
}

fn bind(variable: &Expr, value: &Expr, bound: &mut [bool]) -> bool {
    match variable {
        Expr::Variable(v) if !bound[*v as usize] && value.all_variables(|v| bound[v as usize]) => {
            bound[*v as usize] = true;
            true
        }
        _ => false,
    }
}
