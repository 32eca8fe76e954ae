//! Where a rule file names what: for editors.

use std::collections::HashMap;
use std::ops::Range;

use crate::rule_text;
use crate::syntax::{Atom, Condition, Declaration, Name, Parameter, Term};
use crate::units::{InOrder as _, Language, Source};

/// What a name is one of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Meaning {
    Type,
    Predicate,
    Action,
    Object,
}

/// A place of a text that names something.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Mark {
    /// Bytes of the name.
    pub range: Range<usize>,
    /// As names are compared: case, ё and the like do not matter.
    pub key: String,
    pub name: String,
    pub means: Meaning,
    /// Where it is declared: what is said of it, in both languages. None where the name is only used.
    pub declared: Option<String>,
    /// No section declares it: this is where it is first named.
    pub is_first_mention: bool,
}

/// Every place of a rule file or scenario that names a type, a predicate, an action or an object, in the order of the
/// text. A predicate that no section declares is declared where it is first named.
#[must_use]
pub fn outline(source: &Source) -> Vec<Mark> {
    let document = rule_text::parse(source).document;
    let english: HashMap<String, String> = document
        .phrases
        .iter()
        .filter(|phrase| phrase.language == Language::English && !phrase.negated)
        .map(|phrase| (phrase.name.key(), phrase.phrase.text.clone()))
        .collect();
    let mut marks = Marks { source, english, found: Vec::new() };
    for declaration in document.types.iter().flatten() {
        marks.declaration(declaration, Meaning::Type);
    }
    for declaration in &document.objects {
        marks.declaration(declaration, Meaning::Object);
    }
    for signature in &document.predicates {
        let args: Vec<String> = signature
            .args
            .iter()
            .map(|kinds| kinds.iter().map(|kind| kind.text.as_str()).collect::<Vec<_>>().join("|"))
            .collect();
        let told = format!("{}({})", signature.name.text, args.join(", "));
        marks.declared(&signature.name, Meaning::Predicate, &told);
        signature.args.iter().flatten().for_each(|kind| marks.used(kind, Meaning::Type));
    }
    for phrase in &document.phrases {
        let means = if phrase.parameters.is_some() { Meaning::Predicate } else { Meaning::Type };
        marks.used(&phrase.name, means);
        if let Some(second) = &phrase.second {
            let told = format!("{} = {}", second.text, phrase.name.text);
            marks.push(second, means, Some(format!("{told}\n«{}»", phrase.phrase.text)));
        }
    }
    for action in &document.actions {
        let parameters: Vec<String> = action
            .parameters
            .iter()
            .map(|parameter| {
                let kinds: Vec<&str> =
                    parameter.kinds.iter().map(|kind| kind.text.as_str()).collect();
                format!("{} {}", kinds.join("|"), parameter.variable.text).trim().to_owned()
            })
            .collect();
        let told = format!("{}({})", action.name.text, parameters.join(", "));
        marks.declared(&action.name, Meaning::Action, &told);
        marks.variables(&action.parameters);
        action.precondition.iter().for_each(|condition| marks.condition(condition));
        let conditional = action.conditional.iter();
        let effects = conditional.clone().flat_map(|part| part.add.iter().chain(&part.del));
        for atom in action.add.iter().chain(&action.del).chain(&action.renewed).chain(effects) {
            marks.atom(atom);
        }
        for part in conditional {
            marks.variables(&part.variables);
            part.condition.iter().for_each(|condition| marks.condition(condition));
        }
    }
    for rule in &document.derived {
        marks.atom(&rule.atom);
        marks.variables(&rule.parameters);
        rule.condition.iter().for_each(|condition| marks.condition(condition));
    }
    let stated = document.facts.iter().chain(&document.assumptions).chain(document.wanted());
    stated.for_each(|condition| marks.condition(condition));
    let (mut found, english) = (marks.found, marks.english);
    found.order_by_key(|mark| (mark.range.start, mark.range.end));
    // What is said of an action as of a predicate is the action's.
    let actions: Vec<String> = found
        .iter()
        .filter(|mark| mark.means == Meaning::Action)
        .map(|mark| mark.key.clone())
        .collect();
    for mark in &mut found {
        if mark.means == Meaning::Predicate && actions.contains(&mark.key) {
            mark.means = Meaning::Action;
        }
    }
    found.dedup();
    declare_first(&mut found, &english);
    found
}

/// A predicate that no section declares is what its first place says.
fn declare_first(found: &mut [Mark], english: &HashMap<String, String>) {
    let mut known: Vec<String> = found
        .iter()
        .filter(|mark| mark.means == Meaning::Predicate && mark.declared.is_some())
        .map(|mark| mark.key.clone())
        .collect();
    for mark in found.iter_mut().filter(|mark| mark.means == Meaning::Predicate) {
        if !known.contains(&mark.key) {
            known.push(mark.key.clone());
            mark.is_first_mention = true;
            mark.declared = Some(match english.get(&mark.key) {
                Some(english) => format!("{}\n«{english}»", mark.name),
                None => mark.name.clone(),
            });
        }
    }
}

struct Marks<'a> {
    source: &'a Source,
    /// By key, what the file calls it in English.
    english: HashMap<String, String>,
    found: Vec<Mark>,
}

impl Marks<'_> {
    fn push(&mut self, name: &Name, means: Meaning, declared: Option<String>) {
        let span = name.at.span;
        let range = span.offset()..span.offset() + span.len();
        // Names of other files, and those that were made, are none of this text.
        if name.at.source.name() == self.source.name()
            && self.source.text().get(range.clone()).is_some()
        {
            let (key, name) = (name.key(), name.text.clone());
            let is_first_mention = false;
            self.found.push(Mark { range, key, name, means, declared, is_first_mention });
        }
    }

    fn used(&mut self, name: &Name, means: Meaning) {
        self.push(name, means, None);
    }

    fn declared(&mut self, name: &Name, means: Meaning, told: &str) {
        let told = match self.english.get(&name.key()) {
            Some(english) => format!("{told}\n«{english}»"),
            None => told.to_owned(),
        };
        self.push(name, means, Some(told));
    }

    fn declaration(&mut self, declaration: &Declaration, means: Meaning) {
        let kinds: Vec<&str> = declaration.kinds.iter().map(|kind| kind.text.as_str()).collect();
        let told = match kinds.is_empty() {
            true => declaration.name.text.clone(),
            false => format!("{} – {}", declaration.name.text, kinds.join(", ")),
        };
        self.declared(&declaration.name, means, &told);
        declaration.kinds.iter().for_each(|kind| self.used(kind, Meaning::Type));
    }

    fn condition(&mut self, condition: &Condition) {
        match condition {
            Condition::Holds { atom, .. } => self.atom(atom),
            Condition::Equal { pair, .. } => {
                self.term(&pair.0);
                self.term(&pair.1);
            }
            Condition::Any(cases) => cases.iter().flatten().for_each(|part| self.condition(part)),
            Condition::Quantified { variables, body, .. } => {
                self.variables(variables);
                body.iter().for_each(|part| self.condition(part));
            }
        }
    }

    fn variables(&mut self, variables: &[Parameter]) {
        variables.iter().flat_map(|v| &v.kinds).for_each(|kind| self.used(kind, Meaning::Type));
    }

    fn atom(&mut self, atom: &Atom) {
        self.used(&atom.predicate, Meaning::Predicate);
        atom.args.iter().for_each(|term| self.term(term));
    }

    fn term(&mut self, term: &Term) {
        term.kind.iter().for_each(|kind| self.used(kind, Meaning::Type));
        if !term.is_variable {
            self.used(&term.name, Meaning::Object);
        }
    }
}
