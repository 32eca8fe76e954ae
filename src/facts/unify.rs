//! Records that only the rule itself names: `r = [x, y], s = r, s = [v, w]` tells that `v` is `x` and `w` is `y`.
//!
//! No column gives such a record a type, and none is needed: the variable is replaced by the record, and two records
//! that are equal by their fields' equality.

use std::collections::HashMap;

use super::inline::Copy;
use super::syntax::{Atom, Body, Comparison, Expr, Rule};

/// Replacements in one rule; a record that holds itself would go on without end.
const MAX_STEPS: usize = 64;

/// The rule without variables that nothing but a record stands for.
pub(super) fn unified(rule: &Rule) -> Rule {
    let mut rule = rule.clone();
    let Body::All(parts) = &mut rule.body else { return rule };
    for _ in 0..MAX_STEPS {
        split(parts);
        let Some((at, name, value)) = next(&rule.heads, parts) else { break };
        parts.remove(at);
        let mut names = Vec::new();
        parts.iter().for_each(|part| names_of_body(part, &mut names));
        let mut copy = Copy {
            values: names
                .into_iter()
                .map(|known| {
                    let value =
                        if known == name { value.clone() } else { variable(&known, &value) };
                    (known, value)
                })
                .collect(),
            number: 0,
            has_own: false,
        };
        *parts = parts.iter().map(|part| copy.body(part)).collect();
    }
    rule
}

fn variable(name: &str, at: &Expr) -> Expr {
    Expr::Variable(super::syntax::Name { text: name.to_owned(), at: at.at() })
}

/// `[a, b] = [c, d]` to `a = c, b = d`.
fn split(parts: &mut Vec<Body>) {
    let mut n = 0;
    while n < parts.len() {
        if let Body::Compare { op: Comparison::Equal, left, right, at } = &parts[n]
            && let (
                Expr::Record { branch: None, args: one, .. },
                Expr::Record { branch: None, args: other, .. },
            ) = (left, right)
            && one.len() == other.len()
        {
            let at = *at;
            let pairs = one.iter().cloned().zip(other.iter().cloned());
            let pairs = pairs
                .filter(|(a, b)| !matches!(a, Expr::Any(_)) && !matches!(b, Expr::Any(_)))
                .map(|(left, right)| Body::Compare { op: Comparison::Equal, left, right, at })
                .collect::<Vec<_>>();
            parts.splice(n..=n, pairs);
        } else {
            n += 1;
        }
    }
}

/// An equality of a variable that stands in no atom with a record or with another such variable.
fn next(heads: &[Atom], parts: &[Body]) -> Option<(usize, String, Expr)> {
    let mut direct: HashMap<&str, bool> = HashMap::new();
    heads.iter().for_each(|head| direct_names(head, &mut direct));
    let mut has_record = false;
    for part in parts {
        match part {
            Body::Atom(atom) => direct_names(atom, &mut direct),
            Body::Compare { op: Comparison::Equal, left, right, .. } => {
                has_record |= [left, right].into_iter().any(is_anonymous);
                for side in [left, right] {
                    if !matches!(side, Expr::Variable(_) | Expr::Record { .. }) {
                        other_names(side, &mut direct);
                    }
                }
            }
            other => names_within(other, &mut direct),
        }
    }
    if !has_record {
        return None;
    }
    let is_free = |name: &str| !direct.contains_key(name);
    parts.iter().enumerate().find_map(|(n, part)| {
        let Body::Compare { op: Comparison::Equal, left, right, .. } = part else { return None };
        for (one, other) in [(left, right), (right, left)] {
            let Expr::Variable(name) = one else { continue };
            let fits = match other {
                Expr::Record { branch: None, .. } => !holds(other, &name.text),
                Expr::Variable(known) => {
                    // Both sides may be records: one of them is, or becomes one by this.
                    is_free(&known.text)
                        && known.text != name.text
                        && equals_record(parts, &name.text)
                }
                _ => false,
            };
            if fits
                && is_free(&name.text)
                && (is_anonymous(other) || matches!(other, Expr::Variable(_)))
            {
                return Some((n, name.text.clone(), other.clone()));
            }
        }
        None
    })
}

fn is_anonymous(expr: &Expr) -> bool {
    matches!(expr, Expr::Record { branch: None, .. })
}

/// Whether a variable stands beside a record in some equality.
fn equals_record(parts: &[Body], name: &str) -> bool {
    parts.iter().any(|part| match part {
        Body::Compare { op: Comparison::Equal, left, right, .. } => {
            [(left, right), (right, left)].into_iter().any(|(one, other)| {
                matches!(one, Expr::Variable(known) if known.text == name) && is_anonymous(other)
            })
        }
        _ => false,
    })
}

fn holds(expr: &Expr, name: &str) -> bool {
    match expr {
        Expr::Variable(known) => known.text == name,
        Expr::Record { args, .. } | Expr::Call { args, .. } => {
            args.iter().any(|arg| holds(arg, name))
        }
        Expr::As { value, .. } => holds(value, name),
        _ => false,
    }
}

/// Variables that are an atom's arguments themselves: the column gives them a type.
fn direct_names<'a>(atom: &'a Atom, direct: &mut HashMap<&'a str, bool>) {
    for arg in &atom.args {
        if !matches!(arg, Expr::Record { .. }) {
            other_names(arg, direct);
        }
    }
}

fn other_names<'a>(expr: &'a Expr, direct: &mut HashMap<&'a str, bool>) {
    match expr {
        Expr::Variable(name) => {
            direct.insert(&name.text, true);
        }
        Expr::Call { args, .. } | Expr::Record { args, .. } => {
            args.iter().for_each(|arg| other_names(arg, direct));
        }
        Expr::As { value, .. } => other_names(value, direct),
        Expr::Aggregate { value, body, .. } => {
            value.iter().for_each(|value| other_names(value, direct));
            names_within(body, direct);
        }
        _ => {}
    }
}

fn names_within<'a>(body: &'a Body, direct: &mut HashMap<&'a str, bool>) {
    match body {
        Body::All(parts) | Body::Any(parts) => {
            parts.iter().for_each(|part| names_within(part, direct));
        }
        Body::Not(part) => names_within(part, direct),
        Body::Atom(atom) => atom.args.iter().for_each(|arg| other_names(arg, direct)),
        Body::Compare { left, right, .. } => {
            other_names(left, direct);
            other_names(right, direct);
        }
    }
}

/// Every name of a body, those within aggregates too.
pub(super) fn names_of_body(body: &Body, names: &mut Vec<String>) {
    let mut found = HashMap::new();
    names_within(body, &mut found);
    names.extend(found.into_keys().map(str::to_owned));
}

/// Every name of an expression, those within aggregates too.
pub(super) fn names_of_expr(expr: &Expr, names: &mut Vec<String>) {
    let mut found = HashMap::new();
    other_names(expr, &mut found);
    names.extend(found.into_keys().map(str::to_owned));
}
