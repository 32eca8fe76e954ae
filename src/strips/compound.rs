//! Conditions beyond literals, checked: disjunctions, quantifiers, effects under conditions, and what is derived.

use std::collections::{BTreeMap, BTreeSet};

use super::check::{Checker, Scope};
use super::domain::{
    ConditionalEffect, Domain, Formula, PredicateId, Schema, SchemaAtom, SchemaTerm,
};
use super::error::RuleError;
use super::syntax::{
    ActionText, Atom, Condition, ConditionalText, DerivedText, Document, Name, Parameter,
};
use crate::units::Gather as _;

impl Checker<'_> {
    /// None where something of it means nothing; the faults are told.
    pub(super) fn formula(
        &mut self,
        action: &ActionText,
        scope: &Scope,
        condition: &Condition,
    ) -> Option<Formula> {
        match condition {
            Condition::Holds { atom, negated } => {
                let atom = self.atom(action, scope, atom)?;
                Some(Formula::Literal { atom, negated: *negated })
            }
            Condition::Equal { pair, negated } => {
                let left = self.term(action, scope, &pair.0);
                let right = self.term(action, scope, &pair.1);
                Some(Formula::Equal { pair: (left?, right?), negated: *negated })
            }
            Condition::Any(cases) => {
                let cases: Vec<Option<Vec<Formula>>> =
                    cases.iter().map(|case| self.formulas(action, scope, case)).collect();
                cases.into_iter().collect::<Option<_>>().map(Formula::Any)
            }
            Condition::Quantified { every, variables, body } => {
                let (scope, variables) = self.bound(scope, variables);
                let body = self.formulas(action, &scope, body)?;
                Some(Formula::Quantified { every: *every, variables, body })
            }
        }
    }

    fn formulas(
        &mut self,
        action: &ActionText,
        scope: &Scope,
        conditions: &[Condition],
    ) -> Option<Vec<Formula>> {
        let formulas: Vec<Option<Formula>> =
            conditions.iter().map(|condition| self.formula(action, scope, condition)).collect();
        formulas.into_iter().collect()
    }

    /// The scope with the variables of a quantifier in it: numbered after all that are bound around it.
    fn bound(
        &mut self,
        scope: &Scope,
        variables: &[Parameter],
    ) -> (Scope, Vec<super::domain::KindSet>) {
        let mut inner = scope.clone();
        let first = scope.values().map(|(number, _)| number + 1).max().unwrap_or(0);
        let mut kinds = Vec::new();
        for (variable, number) in variables.iter().zip(first..) {
            let set = self.kind_set(&variable.kinds);
            inner.insert(variable.variable.key(), (number, set.clone()));
            kinds.push(set);
        }
        (inner, kinds)
    }

    pub(super) fn conditional(
        &mut self,
        action: &ActionText,
        scope: &Scope,
        part: &ConditionalText,
    ) -> Option<ConditionalEffect> {
        let (scope, variables) = self.bound(scope, &part.variables);
        let condition = self.formulas(action, &scope, &part.condition);
        let mut atoms = |atoms: &[Atom]| -> Vec<SchemaAtom> {
            atoms.iter().filter_map(|atom| self.atom(action, &scope, atom)).collect()
        };
        let (add_effects, del_effects) = (atoms(&part.add), atoms(&part.del));
        Some(ConditionalEffect { variables, condition: condition?, add_effects, del_effects })
    }

    /// One rule of what is derived, or several: each case of a disjunction is a rule, and what is there for some object
    /// is there for a parameter more.
    pub(super) fn derived(&mut self, rule: &DerivedText) {
        let action = ActionText {
            parameters: rule.parameters.clone(),
            ..ActionText::new(rule.atom.predicate.clone())
        };
        let mut schema = Schema::new(rule.atom.predicate.first());
        let scope = self.parameters(&rule.parameters, &mut schema);
        let Some(atom) = self.atom(&action, &scope, &rule.atom) else { return };
        for (variables, conditions) in cases(&rule.parameters, &rule.condition) {
            let hidden: Vec<Parameter> =
                rule.parameters.iter().chain(&variables).cloned().collect();
            let mut schema = Schema::new(rule.atom.predicate.first());
            let scope = self.parameters(&hidden, &mut schema);
            let action =
                ActionText { parameters: hidden, precondition: conditions, ..action.clone() };
            self.precondition(&action, &scope, &mut schema);
            schema.add_effects.push(atom.clone());
            self.domain.derived.push(schema);
        }
    }

    /// What is derived is nothing that is stated or that actions change, and does not rest on its own absence.
    pub(super) fn derived_is_sound(&mut self, document: &Document) {
        if document.derived.is_empty() {
            return;
        }
        let mut told: BTreeSet<String> = BTreeSet::new();
        let mut changed: Vec<&Name> = Vec::new();
        for action in &document.actions {
            let conditional = action.conditional.iter().flat_map(|p| p.add.iter().chain(&p.del));
            changed.extend(
                action.add.iter().chain(&action.del).chain(conditional).map(|a| &a.predicate),
            );
        }
        let stated = document.facts.iter().chain(&document.assumptions);
        changed.extend(stated.filter_map(Condition::first_name));
        for name in changed {
            let Some(predicate) = self.domain.predicate(name.first()) else { continue };
            if self.domain.is_derived(predicate) && told.insert(name.key()) {
                let of = name.text.clone();
                self.faults.push(name.fault(|at| RuleError::DerivedStated { name: of, at }));
            }
        }
        let needs = self.domain.needs();
        for rule in &document.derived {
            let name = &rule.atom.predicate;
            let Some(own) = self.domain.predicate(name.first()) else { continue };
            let absent = needs.get(&own).into_iter().flatten().filter(|(_, negated)| *negated);
            if absent.into_iter().any(|(of, _)| reaches(&needs, *of, own))
                && told.insert(format!("not {}", name.key()))
            {
                let of = name.text.clone();
                self.faults.push(name.fault(|at| RuleError::DerivedByAbsence { name: of, at }));
            }
        }
    }

    /// What of the goal is no plain fact.
    pub(super) fn goal(&mut self, document: &Document) -> Vec<Formula> {
        let beyond = |condition: &&Condition| {
            matches!(condition, Condition::Any(..) | Condition::Quantified { .. })
        };
        let mut formulas = Vec::new();
        for condition in document.goal.iter().filter(beyond) {
            formulas.extend(self.wanted(condition));
        }
        formulas
    }

    /// What is wanted where it can be had, one formula for each preference; none where the faults are told.
    pub(super) fn preferences(&mut self, document: &Document) -> Vec<Option<Formula>> {
        let wishes = document.preferences.iter();
        wishes.map(|preference| self.wanted(&preference.condition)).collect()
    }

    fn wanted(&mut self, condition: &Condition) -> Option<Formula> {
        let Some(name) = condition.first_name() else {
            // An empty conjunction holds, an empty disjunction does not.
            return self.formula_without_names(condition);
        };
        let action = ActionText::new(name.clone());
        self.formula(&action, &Scope::new(), condition)
    }

    fn formula_without_names(&mut self, condition: &Condition) -> Option<Formula> {
        match condition {
            Condition::Any(cases) => Some(Formula::Any(vec![Vec::new(); cases.len()])),
            _ => None,
        }
    }
}

/// Which predicates the rules of each derived one ask for, and whether to be absent.
type Needs = BTreeMap<PredicateId, BTreeSet<(PredicateId, bool)>>;

fn reaches(needs: &Needs, from: PredicateId, to: PredicateId) -> bool {
    let (mut open, mut seen) = (vec![from], BTreeSet::new());
    while let Some(predicate) = open.pop() {
        if predicate == to {
            return true;
        }
        if seen.insert(predicate) {
            open.extend(needs.get(&predicate).into_iter().flatten().map(|(next, _)| *next));
        }
    }
    false
}

impl Domain {
    fn needs(&self) -> Needs {
        let mut needs = Needs::new();
        for rule in &self.derived {
            let of = needs.entry(rule.add_effects[0].predicate).or_default();
            of.extend(rule.preconditions.iter().map(|atom| (atom.predicate, false)));
            of.extend(rule.negative_preconditions.iter().map(|atom| (atom.predicate, true)));
            for formula in &rule.formulas {
                formula.for_each_literal(&mut |atom, negated| {
                    of.insert((atom.predicate, negated));
                });
            }
        }
        needs
    }

    /// The rules of what is derived, so that each asks for the absence of nothing that a later layer gives.
    pub(super) fn layers(&self) -> Vec<Vec<&Schema>> {
        let needs = self.needs();
        let mut height: BTreeMap<PredicateId, usize> = needs.keys().map(|&p| (p, 0)).gather();
        // Checked to be free of circles through a negation, so no height passes the number of predicates.
        for _ in 0..needs.len() {
            for (of, asked) in &needs {
                let above = |(p, negated): &(PredicateId, bool)| {
                    height.get(p).map(|height| height + usize::from(*negated))
                };
                let least = asked.iter().filter_map(above).max().unwrap_or(0);
                height.entry(*of).and_modify(|own| *own = least.max(*own));
            }
        }
        let highest = height.values().max().copied().unwrap_or(0);
        let of = |layer: usize| {
            let is_there = |rule: &&Schema| height[&rule.add_effects[0].predicate] == layer;
            self.derived.iter().filter(is_there).collect()
        };
        (0..=highest).map(of).collect()
    }
}

/// A condition as a disjunction of conjunctions, as far as that costs no more than writing it down, each with the variables
/// that it says there are objects for.
fn cases(named: &[Parameter], conditions: &[Condition]) -> Vec<(Vec<Parameter>, Vec<Condition>)> {
    if let [Condition::Any(parts)] = conditions {
        return parts.iter().flat_map(|part| cases(named, part)).collect();
    }
    for (at, condition) in conditions.iter().enumerate() {
        let Condition::Quantified { every: false, variables, body } = condition else { continue };
        if variables.iter().any(|variable| is_named(variable, named)) {
            continue;
        }
        let named: Vec<Parameter> = named.iter().chain(variables).cloned().collect();
        let parts = [&conditions[..at], body, &conditions[at + 1..]].concat();
        let with = |(inner, conditions): (Vec<Parameter>, Vec<Condition>)| {
            (variables.iter().cloned().chain(inner).collect(), conditions)
        };
        return cases(&named, &parts).into_iter().map(with).collect();
    }
    vec![(Vec::new(), conditions.to_vec())]
}

fn is_named(one: &Parameter, others: &[Parameter]) -> bool {
    others.iter().any(|other| other.variable.key() == one.variable.key())
}

impl Formula {
    pub(super) fn for_each_literal<'a>(&'a self, f: &mut dyn FnMut(&'a SchemaAtom, bool)) {
        match self {
            Self::Literal { atom, negated } => f(atom, *negated),
            Self::Equal { .. } => {}
            Self::Any(cases) => cases.iter().flatten().for_each(|part| part.for_each_literal(f)),
            Self::Quantified { body, .. } => body.iter().for_each(|part| part.for_each_literal(f)),
        }
    }

    /// Every term in it.
    pub(super) fn for_each_term(&self, f: &mut dyn FnMut(&SchemaTerm)) {
        match self {
            Self::Literal { atom, .. } => atom.args.iter().for_each(f),
            Self::Equal { pair: (left, right), .. } => {
                f(left);
                f(right);
            }
            Self::Any(cases) => cases.iter().flatten().for_each(|part| part.for_each_term(f)),
            Self::Quantified { body, .. } => body.iter().for_each(|part| part.for_each_term(f)),
        }
    }
}
