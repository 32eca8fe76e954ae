//! Items to a [`Program`]: names resolved, kinds inferred, groundedness and strata checked. Reports everything it finds.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::sync::Arc;

use super::declare::{declare, direct, type_named};
use super::declared::Declared;
use super::fault::{Found, RuleError};
use super::limits::Ceilings;
use super::program::{Clause, Fact, Program, Subsumption};
use super::relations::RelationId;
use super::strata::{reads, strata};
use super::syntax::{Atom, Body, Expr, Item, Name, Role, Rule, Span};
use super::word::Words;
use super::{clause, idle, misuse, product, subsume, unify, witness};
use crate::units::{Source, said};

pub(super) fn program(sources: &[Source], items: &[Item], faults: &mut Found) -> Program {
    let mut declared = declare(items, faults);
    direct(items, &mut declared, faults);
    foreign(items, &declared, faults);
    let mut words = Words::default();
    words.set_shapes(declared.shapes());
    let mut dominated: HashMap<RelationId, RelationId> = HashMap::new();
    let subsuming: Vec<Rule> = items
        .iter()
        .filter_map(|item| subsume::rule(item, &mut declared, &mut dominated, faults))
        .collect();
    let (mut clauses, mut facts) = (Vec::new(), Vec::new());
    let mut made = clause::Made::default();
    let closed: Vec<Rule> = items.iter().flat_map(|item| equivalence(item, faults)).collect();
    let rule = |item: &Item| if let Item::Rule(rule) = item { Some(rule.clone()) } else { None };
    let rules: Vec<Rule> = items.iter().filter_map(rule).chain(closed).chain(subsuming).collect();
    for rule in &rules {
        single_variables(rule, faults);
        misuse::counting_fact(rule, faults);
    }
    misuse::inline(items, &declared, faults);
    let (rules, gone) = super::inline::unfold(rules, items, &declared, faults);
    let mut subsumptions = Vec::new();
    for rule in &rules {
        let rule = &witness::brought_out(&unify::unified(rule));
        for clause in clause::clauses(rule, &declared, &mut words, &mut made, faults) {
            if let Some(relation) = dominated.get(&clause.head) {
                subsumptions.push(Subsumption { relation: *relation, clause });
                continue;
            }
            match constant_words(&clause) {
                Some(words) => facts.push(Fact { relation: clause.head, words, at: clause.at }),
                None => clauses.push(clause),
            }
        }
    }
    for (info, at) in made.relations {
        declared
            .columns
            .push(info.columns.iter().map(|column| declared.type_of(column.kind)).collect());
        declared.relations.push(info);
        declared.places.push(at);
    }
    clauses.extend(made.clauses);
    let clauses: Vec<Arc<Clause>> = clauses.into_iter().map(Arc::new).collect();
    let strata = strata(&declared, &clauses, &subsumptions, faults);
    misuse::plans(items, &declared, &strata, faults);
    let hidden = gone.iter().copied().chain(dominated.into_keys()).collect();
    unused(&declared, &clauses, &subsumptions, &facts, &hidden, faults);
    hints(items, faults);
    idle::warn(&declared, &clauses, &facts, &words, faults);
    product::warn(&declared, &clauses, &facts, faults);
    declared.unfolded = gone;
    Program {
        sources: sources.into(),
        relations: Arc::new(declared.relations.iter().cloned().map(Arc::new).collect()),
        names: Arc::new(declared.names.clone()),
        declared: Arc::new(declared),
        clauses: clauses.into(),
        facts: facts.into(),
        strata: strata.into(),
        subsumptions: subsumptions.into(),
        limits: limits(items, faults),
        words,
        warnings: [].into(),
    }
}

/// The rules that close a relation declared `eqrel` under equivalence.
pub(super) fn equivalence(item: &Item, faults: &mut Found) -> Vec<Rule> {
    let Item::Relation { names, columns, roles, .. } = item else { return Vec::new() };
    if !roles.contains(&Role::Equivalence) {
        return Vec::new();
    }
    let mut rules = Vec::new();
    for name in names {
        let at = name.at;
        if columns.len() != 2 {
            let (expected, found) = (2, columns.len());
            let fault =
                RuleError::Arity { name: name.text.clone(), expected, found, at: at.into() };
            faults.push(at, fault);
            continue;
        }
        let variable = |text: &str| Expr::Variable(Name { text: text.into(), at });
        let pair = |x: &str, y: &str| Atom {
            relation: name.clone(),
            args: vec![variable(x), variable(y)],
            at,
        };
        let all = |atoms: Vec<Atom>| Body::All(atoms.into_iter().map(Body::Atom).collect());
        let rule = |head: Atom, body| Rule { heads: vec![head], body, at };
        rules.push(rule(pair("x", "y"), all(vec![pair("y", "x")])));
        rules.push(rule(pair("x", "z"), all(vec![pair("x", "y"), pair("y", "z")])));
    }
    rules
}

/// A fact's words; none for a proper rule.
fn constant_words(clause: &Clause) -> Option<Box<[u32]>> {
    use super::program::Expr;
    let constants = clause.args.iter().map(|arg| match arg {
        Expr::Constant(word) => Some(*word),
        _ => None,
    });
    clause.body.is_empty().then(|| constants.collect()).flatten()
}

/// The pragmas that say how much an evaluation may take.
pub(super) fn limits(items: &[Item], faults: &mut Found) -> Ceilings {
    let mut limits = Ceilings::default();
    for item in items {
        let Item::Pragma { name, value, at } = item else { continue };
        limits.on_demand |= name == "magic-transform";
        let Ok(number) = value.trim().parse::<u64>() else {
            if is_limit(name) {
                let (expected, found) =
                    (said!("an-integer-in-quotation-marks"), format!("«{value}»"));
                faults.push(
                    *at,
                    RuleError::Syntax { expected, found: found.into(), at: (*at).into() },
                );
            }
            continue;
        };
        match name.as_str() {
            "time-limit" => limits.seconds = Some(number),
            "memory-limit" => limits.megabytes = Some(number),
            "row-limit" => limits.rows = Some(number),
            _ => {}
        }
    }
    limits
}

fn is_limit(name: &str) -> bool {
    matches!(name, "time-limit" | "memory-limit" | "row-limit")
}

/// That foreign functors are declared once, of types that there are; to call one is refused where it is called.
fn foreign(items: &[Item], declared: &Declared, faults: &mut Found) {
    let mut known = BTreeSet::new();
    for item in items {
        let Item::Foreign { name, types } = item else { continue };
        if !known.insert(&name.text) {
            let fault = RuleError::Duplicate { name: name.text.clone(), at: name.at.into() };
            faults.push(name.at, fault);
        }
        for of in types {
            type_named(of, declared, faults);
        }
    }
}

/// Says what is read and has no effect.
fn hints(items: &[Item], faults: &mut Found) {
    for item in items {
        let (what, at) = match item {
            Item::Plan { at, .. } => (".plan".to_owned(), *at),
            Item::Foreign { name, .. } => (format!(".functor «{}»", name.text), name.at),
            Item::Pragma { name, at, .. }
                if !is_limit(name) && !matches!(name.as_str(), "magic-transform" | "once") =>
            {
                (format!(".pragma «{name}»"), *at)
            }
            _ => continue,
        };
        faults.push(at, RuleError::Hint { what, at: at.into() });
    }
}

fn unused(
    declared: &Declared,
    clauses: &[Arc<Clause>],
    subsumptions: &[Subsumption],
    facts: &[Fact],
    unfolded: &BTreeSet<RelationId>,
    faults: &mut Found,
) {
    let mut read = vec![false; declared.relations.len()];
    let mut filled = vec![false; declared.relations.len()];
    for clause in clauses {
        filled[clause.head.index()] = true;
        reads(&clause.body, false, &mut |relation, _, _| read[relation.index()] = true);
    }
    for of in subsumptions {
        reads(&of.clause.body, false, &mut |relation, _, _| {
            read[relation.index()] |= relation != of.relation;
        });
    }
    facts.iter().for_each(|fact| filled[fact.relation.index()] = true);
    let is_seen = |n: usize| {
        let info = &declared.relations[n];
        read[n] || !info.outputs.is_empty() || info.print_size
    };
    // What a component declares is used where one of its instances is asked for it.
    let key = |at: Span| (at.file, at.start, at.end);
    let mut used: BTreeMap<(u32, u32, u32), bool> = BTreeMap::new();
    for (n, at) in declared.places.iter().enumerate() {
        *used.entry(key(*at)).or_insert(false) |= is_seen(n);
    }
    for (n, info) in declared.relations.iter().enumerate() {
        let (name, at) = (info.name.clone(), declared.places[n]);
        if unfolded.contains(&RelationId(n as u32)) {
            continue;
        }
        if read[n] && !filled[n] && info.inputs.is_empty() {
            faults.push(at, RuleError::NeverDerived { name, at: at.into() });
        } else if used.insert(key(at), true) == Some(false) {
            faults.push(at, RuleError::NeverUsed { name, at: at.into() });
        }
    }
}

fn single_variables(rule: &Rule, faults: &mut Found) {
    let mut seen: BTreeMap<&str, (Span, usize)> = BTreeMap::new();
    for head in &rule.heads {
        head.args.iter().for_each(|arg| count_in_expr(arg, &mut seen));
    }
    count_in_body(&rule.body, &mut seen);
    for (name, (at, count)) in seen {
        // A variable of a bodiless rule is reported as ungrounded.
        if count == 1 && !name.starts_with('_') && rule.body != Body::All(Vec::new()) {
            faults.push(at, RuleError::SingleVariable { variable: name.into(), at: at.into() });
        }
    }
}

fn count_in_body<'a>(body: &'a Body, seen: &mut BTreeMap<&'a str, (Span, usize)>) {
    match body {
        Body::All(parts) | Body::Any(parts) => {
            parts.iter().for_each(|part| count_in_body(part, seen))
        }
        Body::Not(part) => count_in_body(part, seen),
        Body::Atom(atom) => atom.args.iter().for_each(|arg| count_in_expr(arg, seen)),
        Body::Compare { left, right, .. } => {
            count_in_expr(left, seen);
            count_in_expr(right, seen);
        }
    }
}

fn count_in_expr<'a>(expr: &'a Expr, seen: &mut BTreeMap<&'a str, (Span, usize)>) {
    match expr {
        Expr::Variable(name) => seen.entry(&name.text).or_insert((name.at, 0)).1 += 1,
        Expr::Call { args, .. } | Expr::Record { args, .. } => {
            args.iter().for_each(|arg| count_in_expr(arg, seen));
        }
        Expr::Aggregate { value, body, .. } => {
            value.iter().for_each(|value| count_in_expr(value, seen));
            count_in_body(body, seen);
        }
        Expr::As { value, .. } => count_in_expr(value, seen),
        Expr::Any(_)
        | Expr::Nil(_)
        | Expr::Number(..)
        | Expr::Unsigned(..)
        | Expr::Decimal(..)
        | Expr::Text(..) => {}
    }
}
