//! Which names of an aggregate are the rule's, which its own, and which tell who reached the extreme.
//!
//! As in Soufflé: a name that other premises of the rule bind means the same within the aggregate. `Y = min Z + Y : {
//! … }` has a `Y` of its own within. And in `m = max n : { mark(who, n) }` a `who` that the rule reads and nothing else
//! binds is a witness: each `who` with the mark `m`. The rule then reads `m = max n : { mark(w, n) }, mark(who, m)`.

use std::collections::{HashMap, HashSet};

use super::clause::names_of;
use super::inline::{Copy, map_body, map_expr};
use super::syntax::{Aggregation, Body, Comparison, Expr, Name, Rule};
use super::unify::{names_of_body, names_of_expr};

/// What the names of brought out aggregates' values begin with; no name of a text does.
const RESULT: &str = "итог′";

/// The names around an aggregate.
#[derive(Clone, Copy)]
struct Scope<'a> {
    /// What other premises bind.
    bound: &'a HashSet<String>,
    /// What the rule reads outside of aggregates.
    outer: &'a HashSet<String>,
    /// What the aggregate's value is given to.
    target: Option<&'a str>,
}

/// The rule with its aggregates' own names made their own, and with the premises that find the witnesses.
pub(super) fn brought_out(rule: &Rule) -> Rule {
    let has_some = match &rule.body {
        Body::All(parts) => parts.iter().any(has_aggregate),
        part => has_aggregate(part),
    };
    if !has_some {
        return rule.clone();
    }
    let parts = match &rule.body {
        Body::All(parts) => parts.clone(),
        part => vec![part.clone()],
    };
    let mut heads = HashSet::new();
    for arg in rule.heads.iter().flat_map(|head| &head.args) {
        own_names(arg, &mut heads);
    }
    let mut out = Vec::with_capacity(parts.len());
    let mut number = 0;
    for n in 0..parts.len() {
        if !has_aggregate(&parts[n]) {
            out.push(parts[n].clone());
            continue;
        }
        let others = || parts.iter().enumerate().filter(|(at, _)| *at != n).map(|(_, part)| part);
        let bound = bound_by(&mut others());
        let mut outer = heads.clone();
        others().for_each(|part| outer_names(part, &mut outer));
        outer_names(&parts[n], &mut outer);
        let Body::Compare { op, left, right, at } = &parts[n] else {
            out.push(parts[n].clone());
            continue;
        };
        // What the aggregate's value is given to is not known before.
        let target = match (op, left, right) {
            (Comparison::Equal, Expr::Variable(name), _)
            | (Comparison::Equal, _, Expr::Variable(name)) => Some(name.text.clone()),
            _ => None,
        };
        let mut more = Vec::new();
        let mut bring = |expr: &Expr| {
            map_expr(expr, &mut |inner| {
                let Expr::Aggregate { .. } = inner else { return None };
                let scope = Scope { bound: &bound, outer: &outer, target: target.as_deref() };
                let inner = within(inner, scope, &HashSet::new(), &mut number, &mut more);
                number += 1;
                Some(aggregate(&inner, scope, number, &mut more))
            })
        };
        let (left, right) = (bring(left), bring(right));
        out.push(Body::Compare { op: *op, left, right, at: *at });
        out.extend(more);
    }
    Rule { body: Body::All(out), ..rule.clone() }
}

fn has_aggregate(part: &Body) -> bool {
    fn within(expr: &Expr) -> bool {
        match expr {
            Expr::Aggregate { .. } => true,
            Expr::Call { args, .. } | Expr::Record { args, .. } => args.iter().any(within),
            Expr::As { value, .. } => within(value),
            _ => false,
        }
    }
    matches!(part, Body::Compare { left, right, .. } if within(left) || within(right))
}

/// The aggregate with the extremes within its body brought out of which the rule reads a witness: that witness is the
/// rule's, whatever the aggregate around it makes of the extreme.
///
/// In `n = count : { b(x), x > min y : { d(y, who) } }` each `who` of the least `y` is one.
///
/// An extreme that the aggregate around it makes another for each of its own names has no witness of the rule's.
fn within(
    expr: &Expr,
    scope: Scope<'_>,
    around: &HashSet<String>,
    number: &mut usize,
    more: &mut Vec<Body>,
) -> Expr {
    let Expr::Aggregate { function, value, body, at } = expr else { return expr.clone() };
    let mut around = around.clone();
    around.extend(bound_by(&mut std::iter::once(&**body)));
    around.retain(|name| !scope.bound.contains(name));
    let body = map_body(body, &mut |part| {
        map_expr(part, &mut |inner| {
            let Expr::Aggregate { function, value, body, .. } = inner else { return None };
            let mut names = Vec::new();
            names_of_body(body, &mut names);
            value.iter().for_each(|value| names_of_expr(value, &mut names));
            let is_extreme = matches!(function, Aggregation::Min | Aggregation::Max);
            let inner = within(inner, scope, &around, number, more);
            if !is_extreme || names.iter().any(|name| around.contains(name)) {
                return Some(inner);
            }
            *number += 1;
            Some(aggregate(&inner, scope, *number, more))
        })
    });
    Expr::Aggregate { function: *function, value: value.clone(), body: Box::new(body), at: *at }
}

/// The aggregate with its own names made its own; the premises that find witnesses go to `more`.
fn aggregate(expr: &Expr, scope: Scope<'_>, number: usize, more: &mut Vec<Body>) -> Expr {
    let Scope { bound, outer, target } = scope;
    let Expr::Aggregate { function, value, body, at } = expr else { return expr.clone() };
    let mut names = Vec::new();
    names_of_body(body, &mut names);
    value.iter().for_each(|value| names_of_expr(value, &mut names));
    let is_extreme = matches!(function, Aggregation::Min | Aggregation::Max);
    let free = |name: &String| outer.contains(name) && !bound.contains(name);
    let own: HashSet<String> = names
        .iter()
        .filter(|name| free(name) && (is_extreme || target == Some(name.as_str())))
        .cloned()
        .collect();
    if own.is_empty() {
        return expr.clone();
    }
    let witnesses: Vec<&String> = own.iter().filter(|name| target != Some(name.as_str())).collect();
    let variable = |text: String| Expr::Variable(Name { text, at: *at });
    let copy = |rename: &dyn Fn(&String) -> Option<String>| Copy {
        values: names
            .iter()
            .map(|name| {
                let text = rename(name).unwrap_or_else(|| name.clone());
                (name.clone(), variable(text))
            })
            .collect::<HashMap<_, _>>(),
        number,
        has_own: false,
    };
    let mut inside = copy(&|name| own.contains(name).then(|| format!("{name}′{number}")));
    let inner = Expr::Aggregate {
        function: *function,
        value: value.as_deref().map(|value| Box::new(inside.expr(value))),
        body: Box::new(inside.body(body)),
        at: *at,
    };
    if witnesses.is_empty() {
        return inner;
    }
    // T = max n : { … }, and the body once more with T for its value.
    let mut again = copy(&|name| {
        let is_rules = bound.contains(name) && outer.contains(name)
            || witnesses.contains(&name)
            || name.starts_with(RESULT);
        (!is_rules).then(|| format!("{name}″{number}"))
    });
    let result = variable(format!("{RESULT}{number}"));
    let equal =
        |left: Expr, right: Expr| Body::Compare { op: Comparison::Equal, left, right, at: *at };
    more.push(equal(result.clone(), inner));
    more.push(again.body(body));
    if let Some(value) = value {
        more.push(equal(again.expr(value), result.clone()));
    }
    result
}

/// Names of an expression outside of aggregates.
fn own_names(expr: &Expr, names: &mut HashSet<String>) {
    let mut found = Vec::new();
    names_of(expr, &mut found);
    names.extend(found.into_iter().map(|name| name.text.clone()));
}

/// Names of a premise outside of aggregates.
fn outer_names(body: &Body, names: &mut HashSet<String>) {
    match body {
        Body::All(parts) | Body::Any(parts) => {
            parts.iter().for_each(|part| outer_names(part, names));
        }
        Body::Not(part) => outer_names(part, names),
        Body::Atom(atom) => atom.args.iter().for_each(|arg| own_names(arg, names)),
        Body::Compare { left, right, .. } => {
            own_names(left, names);
            own_names(right, names);
        }
    }
}

/// Names that premises bind, one by another.
fn bound_by(parts: &mut dyn Iterator<Item = &Body>) -> HashSet<String> {
    let mut bound = HashSet::new();
    let mut equalities = Vec::new();
    for part in parts {
        atoms(part, &mut bound, &mut equalities);
    }
    loop {
        let before = bound.len();
        for (left, right) in &equalities {
            for (one, other) in [(left, right), (right, left)] {
                let mut names = HashSet::new();
                own_names(other, &mut names);
                if names.iter().all(|name| bound.contains(name)) {
                    match one {
                        Expr::Variable(name) => {
                            bound.insert(name.text.clone());
                        }
                        Expr::Record { .. } => own_names(one, &mut bound),
                        _ => {}
                    }
                }
            }
        }
        if bound.len() == before {
            return bound;
        }
    }
}

fn atoms<'a>(
    part: &'a Body,
    bound: &mut HashSet<String>,
    equalities: &mut Vec<(&'a Expr, &'a Expr)>,
) {
    match part {
        Body::All(parts) => parts.iter().for_each(|part| atoms(part, bound, equalities)),
        Body::Any(parts) => {
            // Bound is what every choice binds.
            let mut common: Option<HashSet<String>> = None;
            for part in parts {
                let own = bound_by(&mut std::iter::once(part));
                common = Some(match common {
                    None => own,
                    Some(known) => known.intersection(&own).cloned().collect(),
                });
            }
            bound.extend(common.unwrap_or_default());
        }
        Body::Not(_) => {}
        Body::Atom(atom) => {
            for arg in &atom.args {
                match arg {
                    Expr::Variable(name) => {
                        bound.insert(name.text.clone());
                    }
                    Expr::Record { .. } => patterns(arg, bound),
                    _ => {}
                }
            }
        }
        Body::Compare { op: Comparison::Equal, left, right, .. } => equalities.push((left, right)),
        Body::Compare { .. } => {}
    }
}

/// Names that a record's pattern binds.
fn patterns(expr: &Expr, bound: &mut HashSet<String>) {
    match expr {
        Expr::Variable(name) => {
            bound.insert(name.text.clone());
        }
        Expr::Record { args, .. } => args.iter().for_each(|arg| patterns(arg, bound)),
        _ => {}
    }
}
