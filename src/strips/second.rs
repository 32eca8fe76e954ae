//! Second names of predicates and types: `РОБОТ-НАХОДИТСЯ-В_(?x) = ROBOT-IN = «the robot is in ?x»` lets every text that
//! includes these rules call the predicate ROBOT-IN.
//!
//! **Invariant.** What a name means is settled once, before anything is checked: all that follows compares first names.

use std::collections::HashMap;
use std::sync::Arc;

use super::error::RuleError;
use super::fault::RuleFault;
use super::syntax::{ActionText, Atom, Condition, Document, Name, Parameter};
use crate::units::{Language, name_key, said};

/// What second names stand for, by their keys.
#[derive(Debug, Clone, Default)]
pub(super) struct SecondNames {
    pub(super) predicates: HashMap<String, Second>,
    pub(super) kinds: HashMap<String, Second>,
}

/// A second name as it was given, and the first.
#[derive(Debug, Clone)]
pub(super) struct Second {
    pub(super) text: String,
    pub(super) language: Language,
    pub(super) of: Arc<str>,
}

impl SecondNames {
    /// Those that the document gives. One that is given twice stays with what it was first given to.
    fn of(document: &Document, faults: &mut Vec<RuleFault>) -> Self {
        let mut names = Self::default();
        let is_action = |name: &Name| document.actions.iter().any(|a| a.name.key() == name.key());
        let given = document.phrases.iter().filter_map(|text| Some((text, text.second.as_ref()?)));
        for (text, second) in given {
            let table = match text.parameters {
                Some(_) if is_action(&text.name) => {
                    let name = text.name.text.clone();
                    faults.push(second.fault(|at| RuleError::SecondNameOfAction { name, at }));
                    continue;
                }
                Some(_) => &mut names.predicates,
                None => &mut names.kinds,
            };
            let (own, of) = (second.text.clone(), Arc::from(text.name.text.as_str()));
            let new = Second { text: own, language: text.language, of };
            let known = table.entry(name_key(&second.text)).or_insert_with(|| new.clone());
            if name_key(&known.of) != name_key(&new.of) {
                let help = said!("is-called-so-already", known = known.of);
                let (what, name) = (said!("the-second-name"), new.text);
                let error = |at| RuleError::Duplicate { what, name, help, at, first: None };
                faults.push(second.fault(error));
            }
        }
        names
    }

    /// The second name of a first one in a language.
    pub(super) fn in_language<'a>(
        table: &'a HashMap<String, Second>,
        first: &str,
        language: Language,
    ) -> Option<&'a str> {
        let key = name_key(first);
        let is_it = |second: &&Second| second.language == language && name_key(&second.of) == key;
        table.values().filter(is_it).map(|second| second.text.as_str()).min()
    }

    pub(super) fn settle_atom(&self, atom: &mut Atom) {
        settle(&self.predicates, &mut atom.predicate);
        self.kinds_of(atom.args.iter_mut().filter_map(|term| term.kind.as_mut()));
    }

    fn kinds_of<'n>(&self, names: impl IntoIterator<Item = &'n mut Name>) {
        names.into_iter().for_each(|name| settle(&self.kinds, name));
    }

    fn variables(&self, variables: &mut [Parameter]) {
        self.kinds_of(variables.iter_mut().flat_map(|variable| &mut variable.kinds));
    }

    fn conditions(&self, conditions: &mut [Condition]) {
        for condition in conditions {
            match condition {
                Condition::Holds { atom, .. } => self.settle_atom(atom),
                Condition::Equal { pair, .. } => {
                    let terms = [&mut pair.0, &mut pair.1];
                    self.kinds_of(terms.into_iter().filter_map(|term| term.kind.as_mut()));
                }
                Condition::Any(cases) => cases.iter_mut().for_each(|case| self.conditions(case)),
                Condition::Quantified { variables, body, .. } => {
                    self.variables(variables);
                    self.conditions(body);
                }
            }
        }
    }

    fn action(&self, action: &mut ActionText) {
        self.variables(&mut action.parameters);
        self.conditions(&mut action.precondition);
        let effects = action.add.iter_mut().chain(&mut action.del).chain(&mut action.renewed);
        effects.for_each(|atom| self.settle_atom(atom));
        for part in &mut action.conditional {
            self.variables(&mut part.variables);
            self.conditions(&mut part.condition);
            part.add.iter_mut().chain(&mut part.del).for_each(|atom| self.settle_atom(atom));
        }
    }
}

fn settle(table: &HashMap<String, Second>, name: &mut Name) {
    if let Some(second) = table.get(&name.key()) {
        name.second_of = Some(second.of.clone());
    }
}

/// Settles every name of the document, and returns the second names that it gives.
pub(super) fn settle_names(document: &mut Document, faults: &mut Vec<RuleFault>) -> SecondNames {
    let names = SecondNames::of(document, faults);
    if names.predicates.is_empty() && names.kinds.is_empty() {
        return names;
    }
    for declaration in document.types.iter_mut().flatten() {
        names.kinds_of(std::iter::once(&mut declaration.name).chain(&mut declaration.kinds));
    }
    names.kinds_of(document.objects.iter_mut().flat_map(|object| &mut object.kinds));
    for signature in &mut document.predicates {
        settle(&names.predicates, &mut signature.name);
        names.kinds_of(signature.args.iter_mut().flatten());
    }
    document.actions.iter_mut().for_each(|action| names.action(action));
    for rule in &mut document.derived {
        names.variables(&mut rule.parameters);
        names.settle_atom(&mut rule.atom);
        names.conditions(&mut rule.condition);
    }
    for stated in [&mut document.facts, &mut document.assumptions, &mut document.goal] {
        names.conditions(stated);
    }
    for wish in &mut document.preferences {
        names.conditions(std::slice::from_mut(&mut wish.condition));
    }
    for text in &mut document.phrases {
        let table = if text.parameters.is_some() { &names.predicates } else { &names.kinds };
        settle(table, &mut text.name);
    }
    names
}
