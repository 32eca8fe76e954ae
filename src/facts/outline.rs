//! Where a rule text names what: for editors.

use std::ops::Range;

use super::parse;
use super::syntax::{Atom, Body, Component, Expr, Item, Name, Span};
use crate::units::{InOrder as _, Source};

/// What a name is one of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Meaning {
    Relation,
    Type,
    Component,
    /// A branch of a type.
    Branch,
}

/// A place of a text that names something.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mark {
    /// Bytes of the name.
    pub range: Range<usize>,
    pub name: String,
    pub means: Meaning,
    /// Of a declaration: its text, with the comment above it. None where the name is only used.
    pub declared: Option<String>,
}

/// Every place of a text that names a relation, a type, a component or a branch, in the order of the text. What cannot
/// be read is left out.
#[must_use]
pub fn outline(source: &Source) -> Vec<Mark> {
    let items = parse::items(source, 0, &mut Vec::new());
    let mut marks = Marks { text: source.text(), found: Vec::new() };
    items.iter().for_each(|item| marks.item(item));
    marks.found.order_by_key(|mark| (mark.range.start, mark.range.end));
    marks.found.dedup();
    marks.found
}

struct Marks<'a> {
    text: &'a str,
    found: Vec<Mark>,
}

impl Marks<'_> {
    fn used(&mut self, name: &Name, means: Meaning) {
        self.push(name, means, None);
    }

    fn declared(&mut self, name: &Name, means: Meaning) {
        let text = self.declaration(name.at);
        self.push(name, means, Some(text));
    }

    fn push(&mut self, name: &Name, means: Meaning, declared: Option<String>) {
        let range = name.at.range();
        self.found.push(Mark { range, name: name.text.clone(), means, declared });
    }

    /// The line or lines of a declaration, and the comment lines right above it.
    fn declaration(&self, at: Span) -> String {
        let start = self.text[..at.range().start].rfind('\n').map_or(0, |end| end + 1);
        let rest = &self.text[start..];
        let (mut end, mut open) = (rest.len(), 0_usize);
        for (n, letter) in rest.char_indices() {
            match letter {
                '(' | '[' => open += 1,
                ')' | ']' => open = open.saturating_sub(1),
                '\n' if open == 0 => {
                    end = n;
                    break;
                }
                _ => {}
            }
        }
        let above: Vec<&str> = self.text[..start]
            .lines()
            .rev()
            .take_while(|line| line.trim_start().starts_with("//"))
            .collect();
        let mut lines: Vec<&str> = above.into_iter().rev().map(str::trim).collect();
        lines.push(rest[..end].trim());
        lines.join("\n")
    }

    fn item(&mut self, item: &Item) {
        match item {
            Item::Type { name, bases, .. } => {
                self.declared(name, Meaning::Type);
                bases.iter().for_each(|base| self.used(base, Meaning::Type));
            }
            Item::Structure { name, branches, is_record } => {
                self.declared(name, Meaning::Type);
                for branch in branches {
                    if !is_record {
                        self.declared(&branch.name, Meaning::Branch);
                    }
                    branch.fields.iter().for_each(|(_, of)| self.used(of, Meaning::Type));
                }
            }
            Item::Relation { names, columns, second, .. } => {
                for name in names.iter().chain(second) {
                    self.declared(name, Meaning::Relation);
                }
                columns.iter().for_each(|(_, of)| self.used(of, Meaning::Type));
            }
            Item::Directive { relations, .. } => {
                relations.iter().for_each(|name| self.used(name, Meaning::Relation));
            }
            Item::Component(Component { head, bases, items }) => {
                self.declared(&head.name, Meaning::Component);
                bases.iter().for_each(|base| self.used(&base.name, Meaning::Component));
                items.iter().for_each(|item| self.item(item));
            }
            Item::Instance { of, .. } => self.used(&of.name, Meaning::Component),
            Item::Override(name) => self.used(name, Meaning::Relation),
            Item::Rule(rule) => {
                rule.heads.iter().for_each(|head| self.atom(head));
                self.body(&rule.body);
            }
            Item::Subsumption { dominated, dominating, body, .. } => {
                self.atom(dominated);
                self.atom(dominating);
                self.body(body);
            }
            Item::Include { .. }
            | Item::Plan { .. }
            | Item::Pragma { .. }
            | Item::Foreign { .. } => {}
        }
    }

    fn atom(&mut self, atom: &Atom) {
        self.used(&atom.relation, Meaning::Relation);
        atom.args.iter().for_each(|arg| self.expr(arg));
    }

    fn body(&mut self, body: &Body) {
        match body {
            Body::All(parts) | Body::Any(parts) => parts.iter().for_each(|part| self.body(part)),
            Body::Not(part) => self.body(part),
            Body::Atom(atom) => self.atom(atom),
            Body::Compare { left, right, .. } => {
                self.expr(left);
                self.expr(right);
            }
        }
    }

    fn expr(&mut self, expr: &Expr) {
        match expr {
            Expr::Record { branch, args, .. } => {
                branch.iter().for_each(|name| self.used(name, Meaning::Branch));
                args.iter().for_each(|arg| self.expr(arg));
            }
            Expr::Call { args, .. } => args.iter().for_each(|arg| self.expr(arg)),
            Expr::As { value, type_name, .. } => {
                self.expr(value);
                self.used(type_name, Meaning::Type);
            }
            Expr::Aggregate { value, body, .. } => {
                value.iter().for_each(|value| self.expr(value));
                self.body(body);
            }
            _ => {}
        }
    }
}
