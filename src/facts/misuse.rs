//! What reads well, item by item, and cannot be meant: one name for two things, a plan that does not fit its rule, a
//! fact that counts, `inline` where Soufflé puts nothing in.

use std::collections::{BTreeMap, BTreeSet, HashMap};

use super::declared::Declared;
use super::fault::{Found, RuleError, Told};
use super::program::Stratum;
use super::relations::RelationId;
use super::syntax::{Atom, Body, Expr, Functor, Item, Name, Role, Rule, Span};
use super::unify::{names_of_body, names_of_expr};
use crate::units::{Bilingual, said, word};

fn misuse(what: Bilingual, help: Told, at: Span, faults: &mut Found) {
    faults.push(at, RuleError::Misuse { what, help, at: at.into() });
}

/// Components and instances share their names with nothing else of the program.
pub(super) fn names(items: &[Item], faults: &mut Found) {
    let mut known: BTreeSet<&str> = BTreeSet::new();
    for item in items {
        match item {
            Item::Type { name, .. } | Item::Structure { name, .. } => {
                known.insert(&name.text);
            }
            Item::Relation { names, .. } => known.extend(names.iter().map(|name| &*name.text)),
            _ => {}
        }
    }
    for item in items {
        let name = match item {
            Item::Component(component) => &component.head.name,
            Item::Instance { name, .. } => name,
            _ => continue,
        };
        if !known.insert(&name.text) {
            let fault = RuleError::Duplicate { name: name.text.clone(), at: name.at.into() };
            faults.push(name.at, fault);
        }
    }
}

/// A fact holds constants, and `autoinc()` is none.
pub(super) fn counting_fact(rule: &Rule, faults: &mut Found) {
    if rule.body != Body::All(Vec::new()) {
        return;
    }
    for at in rule.heads.iter().flat_map(|head| &head.args).filter_map(counter) {
        let help = word!("what-a-rule-derives-can-be-counted");
        misuse(said!("autoinc-in-a-fact"), help, at, faults);
    }
}

/// `.plan` behind a recursive rule: each order names all atoms, and there are as many versions as recursive atoms.
pub(super) fn plans(items: &[Item], declared: &Declared, strata: &[Stratum], faults: &mut Found) {
    let mut stratum_of: HashMap<RelationId, usize> = HashMap::new();
    for (n, stratum) in strata.iter().enumerate() {
        stratum_of.extend(stratum.relations.iter().map(|relation| (*relation, n)));
    }
    let stratum = |name: &Name| stratum_of.get(&declared.names.find(&name.text)?).copied();
    for pair in items.windows(2) {
        let [Item::Rule(rule), Item::Plan { orders, at }] = pair else { continue };
        let mut atoms = Vec::new();
        if !conjunction(&rule.body, &mut atoms) {
            continue;
        }
        for head in &rule.heads {
            let Some(own) = stratum(&head.relation) else { continue };
            let is_own = |atom: &&&Atom| stratum(&atom.relation) == Some(own);
            let versions = atoms.iter().filter(is_own).count() as i64;
            if versions == 0 {
                continue;
            }
            let all: Vec<i64> = (1..=atoms.len() as i64).collect();
            for (version, order) in orders {
                let mut sorted = order.clone();
                sorted.sort_unstable();
                if sorted != all {
                    let what = said!("plan-the-order-does-not-name-every", version);
                    misuse(what, word!("list-the-numbers-of-all-relations-of"), *at, faults);
                } else if *version >= versions {
                    let what = said!("plan-the-rule-has-recursive-premises", version, versions);
                    misuse(what, word!("versions-are-numbered-from-0-one-a"), *at, faults);
                }
            }
        }
    }
}

/// The positive atoms of a body; false where it has several choices.
fn conjunction<'a>(body: &'a Body, atoms: &mut Vec<&'a Atom>) -> bool {
    match body {
        Body::All(parts) => parts.iter().all(|part| conjunction(part, atoms)),
        Body::Any(parts) => parts.len() == 1 && conjunction(&parts[0], atoms),
        Body::Atom(atom) => {
            atoms.push(atom);
            true
        }
        Body::Not(part) => matches!(&**part, Body::Atom(_)),
        Body::Compare { .. } => true,
    }
}

/// What Soufflé refuses of relations declared `inline`: files, circles, counters, counting them, and negations that
/// would name something new.
pub(super) fn inline(items: &[Item], declared: &Declared, faults: &mut Found) {
    let mut own: BTreeMap<RelationId, &Name> = BTreeMap::new();
    let mut rules: Vec<&Rule> = Vec::new();
    for item in items {
        match item {
            Item::Relation { names, roles, .. } if roles.contains(&Role::Inline) => {
                let found =
                    names.iter().filter_map(|name| Some((declared.names.find(&name.text)?, name)));
                own.extend(found);
            }
            Item::Rule(rule) => rules.push(rule),
            _ => {}
        }
    }
    if own.is_empty() {
        return;
    }
    let mut check =
        Inline { declared, own: &own, newly: BTreeSet::new(), reads: BTreeMap::new(), faults };
    check.relations(&rules);
    for rule in rules {
        check.rule(rule);
    }
}

struct Inline<'a> {
    declared: &'a Declared,
    own: &'a BTreeMap<RelationId, &'a Name>,
    /// Those whose bodies name what their heads do not.
    newly: BTreeSet<RelationId>,
    /// The inline relations that each reads.
    reads: BTreeMap<RelationId, BTreeSet<RelationId>>,
    faults: &'a mut Found,
}

const EVALUATED: Told = word!("remove-inline-the-relation-will-be-derived");

impl Inline<'_> {
    fn inlined(&self, atom: &Atom) -> Option<RelationId> {
        let relation = self.declared.names.find(&atom.relation.text)?;
        self.own.contains_key(&relation).then_some(relation)
    }

    fn relations(&mut self, rules: &[&Rule]) {
        for (relation, name) in self.own {
            let info = &self.declared.relations[relation.index()];
            if !info.inputs.is_empty() || !info.outputs.is_empty() || info.print_size {
                let what = said!("the-inline-relation-is-read-from-a", text = name.text);
                misuse(what, EVALUATED, name.at, self.faults);
            }
        }
        for rule in rules {
            let mut atoms = Vec::new();
            each_atom(&rule.body, &mut |atom, _, _| atoms.push(atom));
            let reads: Vec<RelationId> =
                atoms.iter().filter_map(|atom| self.inlined(atom)).collect();
            let mut body = Vec::new();
            names_of_body(&rule.body, &mut body);
            for head in &rule.heads {
                let Some(relation) = self.inlined(head) else { continue };
                self.reads.entry(relation).or_default().extend(&reads);
                let mut known = Vec::new();
                head.args.iter().for_each(|arg| names_of_expr(arg, &mut known));
                if body.iter().any(|name| !known.contains(name)) {
                    self.newly.insert(relation);
                }
            }
        }
        for (relation, name) in self.own {
            if self.leads_back(*relation) {
                let what = said!("the-inline-relation-reads-itself", text = name.text);
                misuse(what, EVALUATED, name.at, self.faults);
            }
        }
    }

    fn leads_back(&self, relation: RelationId) -> bool {
        let mut seen = BTreeSet::new();
        let mut open = vec![relation];
        while let Some(next) = open.pop() {
            for read in self.reads.get(&next).into_iter().flatten() {
                if *read == relation {
                    return true;
                }
                if seen.insert(*read) {
                    open.push(*read);
                }
            }
        }
        false
    }

    fn rule(&mut self, rule: &Rule) {
        let is_inline = rule.heads.iter().any(|head| self.inlined(head).is_some());
        let mut found: Vec<(Bilingual, Span)> = Vec::new();
        let mut counted = Vec::new();
        rule.heads.iter().flat_map(|head| &head.args).for_each(|arg| counted.extend(counter(arg)));
        each_compare(&rule.body, &mut |expr| counted.extend(counter(expr)));
        if is_inline {
            found.extend(counted.iter().map(|at| (said!("autoinc-in-an-inline-relation"), *at)));
        }
        let mut visit = |atom: &Atom, is_negated: bool, is_counted: bool| {
            let Some(relation) = self.inlined(atom) else { return };
            let name = &atom.relation.text;
            if is_counted {
                found.push((said!("an-aggregate-over-the-inline-relation", name), atom.at));
            }
            if let Some(at) = atom.args.iter().find_map(counter) {
                found.push((said!("autoinc-among-the-arguments-of-the-inline", name), at));
            }
            if is_negated && self.newly.contains(&relation) {
                found.push((said!("the-negation-of-the-inline-relation-with", name), atom.at));
            }
            if is_negated && atom.args.iter().any(has_any) {
                found.push((said!("in-the-negation-of-the-inline-relation", name), atom.at));
            }
        };
        each_atom(&rule.body, &mut visit);
        for arg in rule.heads.iter().flat_map(|head| &head.args) {
            each_counted(arg, &mut visit);
        }
        for (what, at) in found {
            misuse(what, EVALUATED, at, self.faults);
        }
    }
}

/// Each atom of a body, whether it is negated and whether it stands within an aggregate.
fn each_atom<'a>(body: &'a Body, f: &mut dyn FnMut(&'a Atom, bool, bool)) {
    fn walk<'a>(
        body: &'a Body,
        is_negated: bool,
        is_counted: bool,
        f: &mut dyn FnMut(&'a Atom, bool, bool),
    ) {
        match body {
            Body::All(parts) | Body::Any(parts) => {
                parts.iter().for_each(|part| walk(part, is_negated, is_counted, f));
            }
            Body::Not(part) => walk(part, !is_negated, is_counted, f),
            Body::Atom(atom) => {
                f(atom, is_negated, is_counted);
                atom.args.iter().for_each(|arg| each_counted(arg, f));
            }
            Body::Compare { left, right, .. } => {
                each_counted(left, f);
                each_counted(right, f);
            }
        }
    }
    walk(body, false, false, f);
}

/// The atoms of the aggregates within an expression.
fn each_counted<'a>(expr: &'a Expr, f: &mut dyn FnMut(&'a Atom, bool, bool)) {
    match expr {
        Expr::Call { args, .. } | Expr::Record { args, .. } => {
            args.iter().for_each(|arg| each_counted(arg, f));
        }
        Expr::As { value, .. } => each_counted(value, f),
        Expr::Aggregate { value, body, .. } => {
            value.iter().for_each(|value| each_counted(value, f));
            each_atom(body, &mut |atom, is_negated, _| f(atom, is_negated, true));
        }
        _ => {}
    }
}

/// The sides of a body's comparisons.
fn each_compare<'a>(body: &'a Body, f: &mut dyn FnMut(&'a Expr)) {
    match body {
        Body::All(parts) | Body::Any(parts) => parts.iter().for_each(|part| each_compare(part, f)),
        Body::Not(part) => each_compare(part, f),
        Body::Atom(atom) => atom.args.iter().for_each(f),
        Body::Compare { left, right, .. } => {
            f(left);
            f(right);
        }
    }
}

/// Where `autoinc()` stands in an expression.
fn counter(expr: &Expr) -> Option<Span> {
    match expr {
        Expr::Call { functor: Functor::Counter, at, .. } => Some(*at),
        Expr::Call { args, .. } | Expr::Record { args, .. } => args.iter().find_map(counter),
        Expr::As { value, .. } => counter(value),
        _ => None,
    }
}

/// Whether `_` stands in an argument, not within an aggregate.
fn has_any(expr: &Expr) -> bool {
    match expr {
        Expr::Any(_) => true,
        Expr::Call { args, .. } | Expr::Record { args, .. } => args.iter().any(has_any),
        Expr::As { value, .. } => has_any(value),
        _ => false,
    }
}
