//! Components to plain items: `.init g = Graph<Place>` stands for the component's declarations and rules, with `g.`
//! before the names that it declares.
//!
//! As in Soufflé: a component has what its bases have; `.override r` leaves out the bases' rules for `r`, which must be
//! `overridable`; a parameter stands for a type or for a component; a name that a component does not declare means
//! what it means where the component is made.
//!
//! **Invariant**: what comes out holds no component, no instance and no override.

use std::collections::{HashMap, HashSet};

use super::fault::{Found, RuleError};
use super::syntax::{Atom, Body, Branch, Component, Expr, Item, Name, Role, Rule, Span, Type};
use crate::units::{nearest_name, said, word};

/// Components that make components: more is one that makes itself.
const MAX_DEPTH: usize = 32;
/// Items that components may come to.
const MAX_ITEMS: usize = 1 << 18;

/// Parameters of a component and what stands for them.
type Binding = HashMap<String, Name>;

/// The items with all components made.
pub(super) fn expand(items: Vec<Item>, faults: &mut Found) -> Vec<Item> {
    let has_some = items
        .iter()
        .any(|item| matches!(item, Item::Component(_) | Item::Instance { .. } | Item::Override(_)));
    if !has_some {
        return items;
    }
    let mut making = Making { faults, items: 0 };
    let scope = Scope { known: components(&items), outer: None };
    let mut out = Vec::new();
    for item in &items {
        match item {
            Item::Component(component) => making.check(component, &scope),
            Item::Instance { name, of, at } => {
                out.extend(making.instance(name, of, *at, &Binding::new(), &scope, 0));
            }
            other => out.push(other.clone()),
        }
    }
    out
}

fn components(items: &[Item]) -> Vec<&Component> {
    let mut found = Vec::new();
    for item in items {
        if let Item::Component(component) = item {
            found.push(component);
        }
    }
    found
}

/// The components that a place may name: its own, then those around it.
struct Scope<'a> {
    known: Vec<&'a Component>,
    outer: Option<&'a Self>,
}

impl<'a> Scope<'a> {
    fn find(&self, name: &str) -> Option<&'a Component> {
        let own = self.known.iter().find(|component| component.head.name.text == name);
        own.copied().or_else(|| self.outer?.find(name))
    }

    fn names(&self) -> Vec<&'a str> {
        let mut names: Vec<&str> =
            self.known.iter().map(|component| component.head.name.text.as_str()).collect();
        names.extend(self.outer.map(Scope::names).unwrap_or_default());
        names
    }
}

struct Making<'a> {
    faults: &'a mut Found,
    items: usize,
}

impl Making<'_> {
    /// What is wrong with a component whether it is made or not.
    fn check<'a>(&mut self, component: &'a Component, scope: &Scope<'a>) {
        let mut parameters = HashSet::new();
        for name in &component.head.args {
            if !parameters.insert(name.text.as_str()) {
                let fault = RuleError::Duplicate { name: name.text.clone(), at: name.at.into() };
                self.faults.push(name.at, fault);
            }
        }
        let scope = Scope { known: components(&component.items), outer: Some(scope) };
        let made = component.items.iter().filter_map(|item| match item {
            Item::Instance { of, .. } => Some(of),
            _ => None,
        });
        for of in component.bases.iter().chain(made) {
            if parameters.contains(of.name.text.as_str()) {
                continue;
            }
            if let Some(other) = self.named(of, &scope) {
                let (expected, found) = (other.head.args.len(), of.args.len());
                if expected != found {
                    let (name, at) = (of.name.text.clone(), of.name.at);
                    self.faults.push(at, RuleError::Arity { name, expected, found, at: at.into() });
                }
                if returns(other, component, &scope, &mut Vec::new()) {
                    let what =
                        said!("the-component-within-itself", text = component.head.name.text);
                    let help = word!("break-the-circle-a-component-neither-inherits");
                    let at = of.name.at;
                    self.faults.push(at, RuleError::Unsupported { what, help, at: at.into() });
                }
            }
        }
        if let Some(inherited) = inherited(component, &scope, &mut Vec::new()) {
            for item in &component.items {
                if let Item::Override(name) = item {
                    self.check_override(name, inherited.iter().copied());
                }
            }
        }
        for inner in components(&component.items) {
            self.check(inner, &scope);
        }
    }

    /// The component of a name; a fault where there is none.
    fn named<'a>(&mut self, of: &Type, scope: &Scope<'a>) -> Option<&'a Component> {
        let found = scope.find(&of.name.text);
        if found.is_none() {
            let (name, at) = (of.name.text.clone(), of.name.at);
            let nearest = nearest_name(&name, scope.names()).map(str::to_owned);
            self.faults.push(at, RuleError::UnknownComponent { name, nearest, at: at.into() });
        }
        found
    }

    /// The items of a component, with the instance's name before the names that it declares.
    fn instance<'a>(
        &mut self,
        name: &Name,
        of: &Type,
        at: Span,
        binding: &Binding,
        scope: &Scope<'a>,
        depth: usize,
    ) -> Vec<Item> {
        if depth > MAX_DEPTH || self.items > MAX_ITEMS {
            let (what, limit) = (word!("components-within-one-another"), MAX_DEPTH);
            self.faults.push(at, RuleError::TooLarge { what, limit, at: at.into() });
            return Vec::new();
        }
        let mut content = Vec::new();
        self.collect(of, binding, scope, &HashSet::new(), depth, &mut content);
        self.items += 1 + content.len();
        // A relation and a type may have one name.
        let mut own: HashSet<(Means, String)> = HashSet::new();
        for item in &content {
            match item {
                Item::Relation { names, second, .. } => {
                    let names = names.iter().chain(second);
                    own.extend(names.map(|name| (Means::Relation, name.text.clone())));
                }
                Item::Type { name, .. } | Item::Structure { name, .. } => {
                    own.insert((Means::Type, name.text.clone()));
                }
                _ => {}
            }
            if let Item::Structure { branches, is_record: false, .. } = item {
                let names = branches.iter().map(|branch| branch.name.text.clone());
                own.extend(names.map(|name| (Means::Branch, name)));
            }
        }
        let prefixed = |means: Means, known: &Name| match own.contains(&(means, known.text.clone()))
        {
            true => Name { text: format!("{}.{}", name.text, known.text), at: known.at },
            false => known.clone(),
        };
        content.iter().map(|item| renamed(item, &prefixed)).collect()
    }

    /// Puts the items of a component and of its bases, its instances made; rules of overridden relations left out.
    fn collect<'a>(
        &mut self,
        of: &Type,
        binding: &Binding,
        scope: &Scope<'a>,
        overridden: &HashSet<String>,
        depth: usize,
        out: &mut Vec<Item>,
    ) {
        let bound =
            |name: &Name| binding.get(&name.text).map_or_else(|| name.clone(), Clone::clone);
        let named = bound(&of.name);
        let at = of.name.at;
        let Some(component) = scope.find(&named.text) else {
            let nearest = nearest_name(&named.text, scope.names()).map(str::to_owned);
            let fault = RuleError::UnknownComponent { name: named.text, nearest, at: at.into() };
            self.faults.push(at, fault);
            return;
        };
        if depth > MAX_DEPTH {
            let (what, limit) = (word!("components-within-one-another"), MAX_DEPTH);
            self.faults.push(at, RuleError::TooLarge { what, limit, at: at.into() });
            return;
        }
        let (expected, found) = (component.head.args.len(), of.args.len());
        if expected != found {
            let name = named.text;
            self.faults.push(at, RuleError::Arity { name, expected, found, at: at.into() });
            return;
        }
        let parameters = component.head.args.iter().map(|name| name.text.clone());
        let binding: Binding = parameters.zip(of.args.iter().map(bound)).collect();
        let overrides: HashSet<String> = component
            .items
            .iter()
            .filter_map(|item| match item {
                Item::Override(name) => Some(name.text.clone()),
                _ => None,
            })
            .collect();
        let above: HashSet<String> = overridden.union(&overrides).cloned().collect();
        let scope = Scope { known: components(&component.items), outer: Some(scope) };
        let start = out.len();
        for base in &component.bases {
            self.collect(base, &binding, &scope, &above, depth + 1, out);
        }
        for item in &component.items {
            if let Item::Override(name) = item {
                self.check_override(name, out[start..].iter());
            }
        }
        for item in &component.items {
            let item = with_types(item, &binding);
            match item {
                Item::Component(_) | Item::Override(_) => {}
                Item::Instance { name, of, at } => {
                    out.extend(self.instance(&name, &of, at, &binding, &scope, depth + 1));
                }
                Item::Rule(mut rule) => {
                    rule.heads.retain(|head| !overridden.contains(&head.relation.text));
                    if !rule.heads.is_empty() {
                        out.push(Item::Rule(rule));
                    }
                }
                Item::Subsumption { ref dominated, .. }
                    if overridden.contains(&dominated.relation.text) => {}
                other => out.push(other),
            }
        }
    }

    fn check_override<'a>(&mut self, name: &Name, mut inherited: impl Iterator<Item = &'a Item>) {
        let declared = inherited.find_map(|item| match item {
            Item::Relation { names, roles, .. } => {
                let is_it = names.iter().any(|known| known.text == name.text);
                is_it.then(|| roles.contains(&Role::Overridable))
            }
            _ => None,
        });
        if declared != Some(true) {
            let what = match declared {
                None => said!("override-the-components-inherited-from-have-no", text = name.text),
                Some(_) => {
                    said!("override-the-relation-is-not-declared-overridable", text = name.text)
                }
            };
            let help = word!("relations-of-the-components-inherited-from-are");
            self.faults.push(name.at, RuleError::Unsupported { what, help, at: name.at.into() });
        }
    }
}

/// The items of all that a component inherits from; none where that is only known of its instances.
fn inherited<'a>(
    component: &'a Component,
    scope: &Scope<'a>,
    seen: &mut Vec<&'a Component>,
) -> Option<Vec<&'a Item>> {
    let mut items = Vec::new();
    for base in &component.bases {
        let is_parameter =
            component.head.args.iter().any(|parameter| parameter.text == base.name.text);
        let base = scope.find(&base.name.text).filter(|_| !is_parameter)?;
        if seen.iter().any(|known| std::ptr::eq(*known, base)) {
            continue;
        }
        seen.push(base);
        items.extend(&base.items);
        items.extend(inherited(base, scope, seen)?);
    }
    Some(items)
}

/// Whether a component leads to another by what it inherits or makes.
fn returns<'a>(
    from: &'a Component,
    to: &Component,
    scope: &Scope<'a>,
    seen: &mut Vec<&'a Component>,
) -> bool {
    if std::ptr::eq(from, to) {
        return true;
    }
    if seen.iter().any(|known| std::ptr::eq(*known, from)) {
        return false;
    }
    seen.push(from);
    let made = from.items.iter().filter_map(|item| match item {
        Item::Instance { of, .. } => Some(of),
        _ => None,
    });
    let mut next = from.bases.iter().chain(made).filter_map(|of| scope.find(&of.name.text));
    next.any(|next| returns(next, to, scope, seen))
}

/// What a name is one of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
enum Means {
    Relation,
    Type,
    Branch,
}

type Rename<'a> = &'a dyn Fn(Means, &Name) -> Name;

/// The item with types and components for its parameters.
fn with_types(item: &Item, binding: &Binding) -> Item {
    if binding.is_empty() {
        return item.clone();
    }
    let put = |_: Means, name: &Name| match binding.get(&name.text) {
        Some(bound) => Name { text: bound.text.clone(), at: name.at },
        None => match name.text.split_once('.') {
            // A parameter may stand for what holds relations or types.
            Some((first, rest)) if binding.contains_key(first) => {
                Name { text: format!("{}.{rest}", binding[first].text), at: name.at }
            }
            _ => name.clone(),
        },
    };
    match item {
        // The collector itself looks an instance's component up.
        Item::Instance { .. } | Item::Component(_) | Item::Override(_) => item.clone(),
        other => renamed(other, &put),
    }
}

/// The item with each name of a relation, type or branch replaced.
fn renamed(item: &Item, to: Rename<'_>) -> Item {
    let of_type = |name: &Name| to(Means::Type, name);
    let of_relation = |name: &Name| to(Means::Relation, name);
    let fields = |fields: &[(Name, Name)]| {
        fields.iter().map(|(name, of)| (name.clone(), of_type(of))).collect::<Vec<_>>()
    };
    match item {
        Item::Type { name, bases, is_union } => Item::Type {
            name: of_type(name),
            bases: bases.iter().map(of_type).collect(),
            is_union: *is_union,
        },
        Item::Structure { name, branches, is_record } => Item::Structure {
            name: of_type(name),
            branches: branches
                .iter()
                .map(|branch| Branch {
                    name: to(Means::Branch, &branch.name),
                    fields: fields(&branch.fields),
                })
                .collect(),
            is_record: *is_record,
        },
        Item::Relation { names, columns, second, roles, domains } => Item::Relation {
            names: names.iter().map(of_relation).collect(),
            columns: fields(columns),
            second: second.as_ref().map(of_relation),
            roles: roles.clone(),
            domains: domains.clone(),
        },
        Item::Directive { role, relations, parameters } => Item::Directive {
            role: *role,
            relations: relations.iter().map(of_relation).collect(),
            parameters: parameters.clone(),
        },
        Item::Rule(rule) => Item::Rule(Rule {
            heads: rule.heads.iter().map(|head| renamed_atom(head, to)).collect(),
            body: renamed_body(&rule.body, to),
            at: rule.at,
        }),
        Item::Subsumption { dominated, dominating, body, at } => Item::Subsumption {
            dominated: renamed_atom(dominated, to),
            dominating: renamed_atom(dominating, to),
            body: renamed_body(body, to),
            at: *at,
        },
        other => other.clone(),
    }
}

fn renamed_atom(atom: &Atom, to: Rename<'_>) -> Atom {
    let args = atom.args.iter().map(|arg| renamed_expr(arg, to)).collect();
    Atom { relation: to(Means::Relation, &atom.relation), args, at: atom.at }
}

fn renamed_body(body: &Body, to: Rename<'_>) -> Body {
    let all = |parts: &[Body]| parts.iter().map(|part| renamed_body(part, to)).collect();
    match body {
        Body::All(parts) => Body::All(all(parts)),
        Body::Any(parts) => Body::Any(all(parts)),
        Body::Not(part) => Body::Not(Box::new(renamed_body(part, to))),
        Body::Atom(atom) => Body::Atom(renamed_atom(atom, to)),
        Body::Compare { op, left, right, at } => Body::Compare {
            op: *op,
            left: renamed_expr(left, to),
            right: renamed_expr(right, to),
            at: *at,
        },
    }
}

fn renamed_expr(expr: &Expr, to: Rename<'_>) -> Expr {
    let all = |args: &[Expr]| args.iter().map(|arg| renamed_expr(arg, to)).collect();
    match expr {
        Expr::Call { functor, args, at } => {
            Expr::Call { functor: *functor, args: all(args), at: *at }
        }
        Expr::Record { branch, args, at } => Expr::Record {
            branch: branch.as_ref().map(|name| Box::new(to(Means::Branch, name))),
            args: all(args),
            at: *at,
        },
        Expr::As { value, type_name, at } => Expr::As {
            value: Box::new(renamed_expr(value, to)),
            type_name: Box::new(to(Means::Type, type_name)),
            at: *at,
        },
        Expr::Aggregate { function, value, body, at } => Expr::Aggregate {
            function: *function,
            value: value.as_deref().map(|value| Box::new(renamed_expr(value, to))),
            body: Box::new(renamed_body(body, to)),
            at: *at,
        },
        other => other.clone(),
    }
}
