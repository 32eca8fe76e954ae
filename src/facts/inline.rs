//! Relations declared `inline` whose rules mean nothing by themselves: `apart(x, y) inline`, `apart(x, y) :- x != y.`
//!
//! Such a relation has no tuples of its own: where a rule reads it, the bodies of its rules are put instead, with the
//! arguments for the head's variables. An `inline` relation whose rules do bind their variables is evaluated like
//! any other, which derives the same and is derived once.
//!
//! **Invariant**: what is unfolded here stands in no clause of the program.

use std::collections::{BTreeSet, HashMap};

use super::clause::{self, Made};
use super::declared::Declared;
use super::fault::{Found, RuleError};
use super::relations::RelationId;
use super::syntax::{Atom, Body, Comparison, Expr, Item, Name, Role, Rule, Span};
use super::word::Words;
use crate::units::{Gather as _, said, word};

/// Rules put into rules put into rules: more is a relation that reads itself.
const MAX_DEPTH: usize = 16;

/// The rules of the program with what must be unfolded put in, and the relations that are gone.
pub(super) fn unfold(
    rules: Vec<Rule>,
    items: &[Item],
    declared: &Declared,
    faults: &mut Found,
) -> (Vec<Rule>, BTreeSet<RelationId>) {
    let inline = inline_relations(items, declared);
    if inline.is_empty() {
        return (rules, BTreeSet::new());
    }
    let mut unfolding =
        Unfolding { declared, bodies: HashMap::new(), fresh: 0, faults: Vec::new() };
    loop {
        let mut needs = inline.clone();
        needs.retain(|relation| {
            let mut own = rules.iter().filter(|rule| is_of(rule, *relation, declared));
            !unfolding.bodies.contains_key(relation) && own.any(|rule| unfolding.is_loose(rule))
        });
        if needs.is_empty() {
            break;
        }
        for relation in needs {
            let own = rules.iter().filter(|rule| is_of(rule, relation, declared));
            let meant = own.flat_map(|rule| {
                let heads = rule.heads.iter();
                let heads = heads.filter(|head| named(&head.relation, declared) == Some(relation));
                heads.map(|head| (head.args.clone(), rule.body.clone()))
            });
            let meant = meant.collect();
            unfolding.bodies.insert(relation, meant);
        }
    }
    let gone: BTreeSet<RelationId> = unfolding.bodies.keys().copied().gather();
    let mut left = Vec::with_capacity(rules.len());
    for mut rule in rules {
        rule.heads
            .retain(|head| named(&head.relation, declared).is_none_or(|of| !gone.contains(&of)));
        if !rule.heads.is_empty() {
            left.push(unfolding.rule(&rule));
        }
    }
    for (at, fault) in unfolding.faults {
        faults.push(at, fault);
    }
    (left, gone)
}

/// Those that no file is read into or written from.
fn inline_relations(items: &[Item], declared: &Declared) -> BTreeSet<RelationId> {
    let mut inline = BTreeSet::new();
    for item in items {
        if let Item::Relation { names, roles, .. } = item
            && roles.contains(&Role::Inline)
        {
            inline.extend(names.iter().filter_map(|name| named(name, declared)));
        }
    }
    inline.retain(|relation| {
        let info = &declared.relations[relation.index()];
        info.inputs.is_empty() && info.outputs.is_empty() && !info.print_size
    });
    inline
}

fn named(name: &Name, declared: &Declared) -> Option<RelationId> {
    declared.names.find(&name.text)
}

fn is_of(rule: &Rule, relation: RelationId, declared: &Declared) -> bool {
    rule.heads.iter().any(|head| named(&head.relation, declared) == Some(relation))
}

struct Unfolding<'a> {
    declared: &'a Declared,
    /// Heads' arguments and bodies of the rules of each relation that is unfolded.
    bodies: HashMap<RelationId, Vec<(Vec<Expr>, Body)>>,
    /// Copies made so far; each has names of its own.
    fresh: usize,
    faults: Vec<(Span, RuleError)>,
}

impl Unfolding<'_> {
    /// Whether the rule leaves a variable without a value.
    fn is_loose(&mut self, rule: &Rule) -> bool {
        let rule = self.rule(rule);
        let mut found = Found::default();
        let (mut words, mut made) = (Words::default(), Made::default());
        clause::clauses(&rule, self.declared, &mut words, &mut made, &mut found);
        found.all.iter().any(|(_, fault)| matches!(fault, RuleError::Ungrounded { .. }))
    }

    fn rule(&mut self, rule: &Rule) -> Rule {
        let head = |head: &Atom, this: &mut Self| Atom {
            args: head.args.iter().map(|arg| this.expr(arg, 0)).collect(),
            ..head.clone()
        };
        let heads = rule.heads.iter().map(|of| head(of, self)).collect();
        Rule { heads, body: self.body(&rule.body, 0, false), at: rule.at }
    }

    fn body(&mut self, body: &Body, depth: usize, is_negated: bool) -> Body {
        let all = |this: &mut Self, parts: &[Body]| {
            parts.iter().map(|part| this.body(part, depth, is_negated)).collect()
        };
        match body {
            Body::All(parts) => Body::All(all(self, parts)),
            Body::Any(parts) => Body::Any(all(self, parts)),
            Body::Not(part) => Body::Not(Box::new(self.body(part, depth, !is_negated))),
            Body::Compare { op, left, right, at } => Body::Compare {
                op: *op,
                left: self.expr(left, depth),
                right: self.expr(right, depth),
                at: *at,
            },
            Body::Atom(atom) => {
                let args: Vec<Expr> = atom.args.iter().map(|arg| self.expr(arg, depth)).collect();
                let atom = Atom { args, ..atom.clone() };
                let meant = named(&atom.relation, self.declared)
                    .and_then(|relation| self.bodies.get(&relation))
                    .filter(|rules| rules.iter().all(|(head, _)| head.len() == atom.args.len()));
                match meant.cloned() {
                    Some(rules) => self.meant(&atom, &rules, depth, is_negated),
                    None => Body::Atom(atom),
                }
            }
        }
    }

    /// What stands for an atom: one of its relation's bodies.
    fn meant(
        &mut self,
        atom: &Atom,
        rules: &[(Vec<Expr>, Body)],
        depth: usize,
        is_negated: bool,
    ) -> Body {
        let name = &atom.relation.text;
        if depth >= MAX_DEPTH {
            let what = said!("the-inline-relation-that-reads-itself", name);
            let help = word!("remove-inline-and-bind-the-variables-of");
            self.faults.push((atom.at, RuleError::Unsupported { what, help, at: atom.at.into() }));
            return Body::Any(Vec::new());
        }
        let mut ways = Vec::with_capacity(rules.len());
        for (head, body) in rules {
            self.fresh += 1;
            let mut copy = Copy { values: HashMap::new(), number: self.fresh, has_own: false };
            let mut parts = Vec::new();
            for (arg, of) in head.iter().zip(&atom.args) {
                match (arg, of) {
                    (_, Expr::Any(_)) => {}
                    (Expr::Variable(name), _) if !copy.values.contains_key(&name.text) => {
                        copy.values.insert(name.text.clone(), of.clone());
                    }
                    _ => {
                        let (left, right) = (of.clone(), copy.expr(arg));
                        parts.push(Body::Compare {
                            op: Comparison::Equal,
                            left,
                            right,
                            at: atom.at,
                        });
                    }
                }
            }
            parts.push(copy.body(body));
            // Not for any value of z: that is no conjunction of premises.
            if is_negated && copy.has_own {
                let what = said!("the-negation-of-the-inline-relation-with", name);
                let help = word!("remove-inline-and-bind-the-variables-of");
                self.faults
                    .push((atom.at, RuleError::Unsupported { what, help, at: atom.at.into() }));
            }
            ways.push(self.body(&Body::All(parts), depth + 1, is_negated));
        }
        Body::Any(ways)
    }

    fn expr(&mut self, expr: &Expr, depth: usize) -> Expr {
        map_expr(expr, &mut |inner| match inner {
            Expr::Aggregate { function, value, body, at } => Some(Expr::Aggregate {
                function: *function,
                value: value.clone(),
                body: Box::new(self.body(body, depth, false)),
                at: *at,
            }),
            _ => None,
        })
    }
}

/// A body with other names: the head's variables are the arguments, all others the copy's own.
pub(super) struct Copy {
    pub(super) values: HashMap<String, Expr>,
    pub(super) number: usize,
    pub(super) has_own: bool,
}

impl Copy {
    pub(super) fn body(&mut self, body: &Body) -> Body {
        map_body(body, &mut |expr| self.expr(expr))
    }

    pub(super) fn expr(&mut self, expr: &Expr) -> Expr {
        map_expr(expr, &mut |inner| match inner {
            Expr::Variable(name) => {
                let value = self.values.get(&name.text).cloned();
                Some(value.unwrap_or_else(|| {
                    self.has_own = true;
                    let text = format!("{}′{}", name.text, self.number);
                    let own = Expr::Variable(Name { text, at: name.at });
                    self.values.insert(name.text.clone(), own.clone());
                    own
                }))
            }
            Expr::Aggregate { function, value, body, at } => {
                let value = value.as_deref().map(|value| Box::new(self.expr(value)));
                let body = Box::new(self.body(body));
                Some(Expr::Aggregate { function: *function, value, body, at: *at })
            }
            _ => None,
        })
    }
}

/// The body with its expressions replaced.
pub(super) fn map_body(body: &Body, f: &mut dyn FnMut(&Expr) -> Expr) -> Body {
    match body {
        Body::All(parts) => Body::All(parts.iter().map(|part| map_body(part, f)).collect()),
        Body::Any(parts) => Body::Any(parts.iter().map(|part| map_body(part, f)).collect()),
        Body::Not(part) => Body::Not(Box::new(map_body(part, f))),
        Body::Compare { op, left, right, at } => {
            Body::Compare { op: *op, left: f(left), right: f(right), at: *at }
        }
        Body::Atom(atom) => {
            Body::Atom(Atom { args: atom.args.iter().map(f).collect(), ..atom.clone() })
        }
    }
}

/// The expression with each part that `f` replaces replaced, from the outside in.
pub(super) fn map_expr(expr: &Expr, f: &mut dyn FnMut(&Expr) -> Option<Expr>) -> Expr {
    if let Some(other) = f(expr) {
        return other;
    }
    match expr {
        Expr::Call { functor, args, at } => {
            let args = args.iter().map(|arg| map_expr(arg, f)).collect();
            Expr::Call { functor: *functor, args, at: *at }
        }
        Expr::Record { branch, args, at } => {
            let args = args.iter().map(|arg| map_expr(arg, f)).collect();
            Expr::Record { branch: branch.clone(), args, at: *at }
        }
        Expr::As { value, type_name, at } => {
            Expr::As { value: Box::new(map_expr(value, f)), type_name: type_name.clone(), at: *at }
        }
        other => other.clone(),
    }
}
