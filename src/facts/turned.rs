//! A clause as it is asked for a row of its head: every column of the head has a variable that the body knows.

use super::program::{Clause, Compare, Expr, Kind, Literal, Term, Variable, VariableId};
use super::relations::Column;
use super::syntax::Comparison;

/// The clause with a variable for every column of its head and every `_` of its atoms.
pub(super) fn turned(clause: &Clause, columns: &[Column]) -> (Clause, Vec<VariableId>, usize) {
    let mut turned = clause.clone();
    let own = turned.body.len();
    let fresh = |variables: &mut Vec<Variable>| {
        variables.push(Variable { name: String::new(), kind: Kind::Symbol });
        (variables.len() - 1) as VariableId
    };
    for literal in &mut turned.body {
        if let Literal::Atom(atom) = literal {
            for arg in atom.args.iter_mut().filter(|arg| **arg == Term::Any) {
                *arg = Term::Variable(fresh(&mut turned.variables));
            }
        }
    }
    let mut head = Vec::new();
    for (arg, column) in clause.args.iter().zip(columns) {
        match arg {
            Expr::Variable(v) if !head.contains(v) => head.push(*v),
            _ => {
                let v = fresh(&mut turned.variables);
                let (op, left) = (Comparison::Equal, Expr::Variable(v));
                let (right, at) = (arg.clone(), clause.at);
                turned.body.push(Literal::Compare(Compare {
                    op,
                    left,
                    right,
                    kind: column.kind,
                    at,
                }));
                head.push(v);
            }
        }
    }
    (turned, head, own)
}
