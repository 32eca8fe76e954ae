//! What holds, what is wanted, and the objects of it all: from a scenario, from a map, or from both.
//!
//! A [`Problem`] collects statements; names are resolved against the rules when it is grounded, so that
//! a scenario may speak of objects that only the map knows. The world is closed: what is not stated is false.

use std::collections::HashSet;
use std::sync::Arc;

use super::check::text_of;
use super::domain::{Domain, Formula, PredicateId};
use super::error::RuleError;
use super::fault::{RuleFault, RuleFaults};
use super::hint::hint;
use super::other_names::OtherNames;
use super::phrase::{Said, SaidArgument};
use super::rule_text::{PLAIN_FACT, conditions};
use super::syntax::{Amount, Atom, Condition, Declaration, Document, Name};
use crate::units::{OwnText, Source, name_key, word};

/// How a fact is known (SPEC P2).
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Standing {
    Fact,
    /// Holds until observation contradicts it.
    Assumption,
}

#[derive(Debug, Clone)]
pub(super) struct Statement {
    pub(super) predicate: String,
    pub(super) args: Vec<String>,
    pub(super) negated: bool,
    pub(super) standing: Standing,
    /// None for what came from outside a text.
    pub(super) text: Option<Atom>,
}

#[derive(Debug, Clone)]
pub(super) struct ObjectStatement {
    pub(super) name: String,
    pub(super) kinds: Vec<String>,
    pub(super) text: Option<Declaration>,
}

/// What holds and what is wanted.
#[derive(Debug, Clone, Default)]
pub struct Problem {
    pub(super) objects: Vec<ObjectStatement>,
    pub(super) facts: Vec<Statement>,
    pub(super) goal: Vec<Statement>,
    /// What of the goal is no plain fact, and the objects that it names.
    pub(super) goal_formulas: Vec<Formula>,
    pub(super) goal_objects: Vec<Name>,
    pub(super) values: Vec<(Atom, u32)>,
    pub(super) objects_closed: bool,
    pub(super) compared: Vec<(Name, Name, bool)>,
    /// The goal was stated and asks for nothing.
    pub(super) goal_is_empty: bool,
    /// What is wanted where it can be had.
    preferences: Vec<(Preference, Formula)>,
    /// Assumptions that were made, and made no longer.
    pub(super) withdrawn: Vec<Statement>,
    /// What a map calls the objects in another language.
    pub(super) called: OtherNames,
}

/// What is wanted where it can be had, and what it costs if it is not met, in thousandths.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Preference {
    pub name: String,
    pub weight: u64,
}

impl Problem {
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// Makes an object known, with its types from the most special to the most general; those that the
    /// rules do not know are passed over.
    pub fn add_object(&mut self, name: &str, kinds: &[&str]) {
        let kinds = kinds.iter().map(|&kind| kind.to_owned()).collect();
        self.objects.push(ObjectStatement { name: name.to_owned(), kinds, text: None });
    }

    /// States a fact. One whose predicate the rules do not mention is passed over.
    pub fn add_fact(&mut self, predicate: &str, args: &[&str]) {
        self.facts.push(Statement::outside(predicate, args, false, Standing::Fact));
    }

    /// States a fact that holds until observation contradicts it.
    pub fn add_assumption(&mut self, predicate: &str, args: &[&str]) {
        self.facts.push(Statement::outside(predicate, args, false, Standing::Assumption));
    }

    /// What else objects are called, each pair their name and another: by it a text, and the rules, may speak of them.
    /// For blanks hyphens do as well. What several objects are called, or an object is named, means none of the others.
    pub fn call<'n>(&mut self, pairs: impl IntoIterator<Item = (&'n str, &'n str)>) {
        self.called = OtherNames::of(pairs);
        let called = &self.called;
        let stated = self.facts.iter_mut().chain(&mut self.goal).chain(&mut self.withdrawn);
        let args = stated.flat_map(|statement| &mut statement.args);
        for name in args.chain(self.objects.iter_mut().map(|object| &mut object.name)) {
            if let Some(first) = called.first(name) {
                *name = first.to_owned();
            }
        }
    }

    /// Withdraws a fact or an assumption; whether it had been stated.
    pub fn withdraw(&mut self, predicate: &str, args: &[&str]) -> bool {
        let predicate = name_key(predicate);
        let args: Vec<String> = args.iter().map(|arg| name_key(arg)).collect();
        let before = self.facts.len();
        self.facts.retain(|fact| {
            name_key(&fact.predicate) != predicate
                || !fact.args.iter().map(|arg| name_key(arg)).eq(args.iter().cloned())
        });
        self.facts.len() < before
    }

    /// Withdraws assumptions given as a rule file writes them, several if need be; a variable stands for any object:
    /// `ДВЕРЬ_ИЗ_В_ОТКРЫТА_(Дверь-ZY, ?x, ?z)`. Returns those withdrawn.
    ///
    /// # Errors
    /// What is no fact, unknown to the rules, or assumed by nobody.
    pub fn withdraw_assumptions(
        &mut self,
        domain: &Domain,
        text: &str,
    ) -> Result<Vec<Said>, RuleFaults> {
        let source = Source::own(OwnText::Assumption, text);
        let mut faults = Vec::new();
        let mut withdrawn = Vec::new();
        for mut condition in conditions(&source)? {
            if let Condition::Holds { atom, .. } = &mut condition {
                self.settle(domain, atom);
            }
            let (name, atom) = match &condition {
                Condition::Holds { atom, negated: false } => (&atom.predicate, atom),
                Condition::Holds { atom, .. } => {
                    faults.push(atom.predicate.fault(no_plain_fact));
                    continue;
                }
                Condition::Equal { pair, .. } => {
                    faults.push(pair.0.name.fault(no_plain_fact));
                    continue;
                }
                compound => {
                    faults.extend(compound.first_name().map(|name| name.fault(no_plain_fact)));
                    continue;
                }
            };
            if let Err(fault) = Statement::of(atom, false, Standing::Assumption).predicate(domain) {
                faults.push(fault);
                continue;
            }
            let matched = self.withdraw_matching(atom);
            if matched.is_empty() {
                let is_fact = self.facts.iter().any(|fact| fact.is_matched_by(atom));
                let assumed = self.facts.iter().filter(|f| f.standing == Standing::Assumption);
                let assumed: Vec<String> = assumed.map(Statement::shown).collect();
                let fact = text_of(atom);
                let help = hint(&fact, assumed.iter().map(String::as_str));
                let error = |at| RuleError::NotAssumed { fact, is_fact, help, at };
                faults.push(name.fault(error));
            }
            withdrawn.extend(matched);
        }
        if faults.is_empty() { Ok(withdrawn) } else { Err(RuleFaults(faults)) }
    }

    /// Settles what an atom given from outside means.
    fn settle(&self, domain: &Domain, atom: &mut Atom) {
        domain.second.settle_atom(atom);
        for term in &mut atom.args {
            term.name.second_of = self.called.first(&term.name.text).map(Arc::from);
        }
    }

    /// What is also known for a fact stays.
    fn withdraw_matching(&mut self, atom: &Atom) -> Vec<Said> {
        let facts = self.facts.iter().filter(|fact| fact.standing == Standing::Fact);
        let known: HashSet<String> = facts.map(Statement::key).collect();
        let goes = |fact: &mut Statement| {
            fact.standing == Standing::Assumption
                && !known.contains(&fact.key())
                && fact.is_matched_by(atom)
        };
        let gone: Vec<Statement> = self.facts.extract_if(.., goes).collect();
        let withdrawn = gone.iter().map(Statement::said).collect();
        self.withdrawn.extend(gone);
        withdrawn
    }

    /// Asks for a fact to hold in the end.
    pub fn add_goal(&mut self, predicate: &str, args: &[&str]) {
        self.goal.push(Statement::outside(predicate, args, false, Standing::Fact));
    }

    #[must_use]
    pub fn has_goal(&self) -> bool {
        !self.goal.is_empty()
            || !self.goal_formulas.is_empty()
            || !self.compared.is_empty()
            || self.goal_is_empty
            || !self.preferences.is_empty()
    }

    /// Holds the objects of some types to be those that came from outside or were declared: a text that
    /// speaks of a room must not make it so.
    ///
    /// # Errors
    /// Each place where the text names another.
    pub fn check_supplied(&self, domain: &Domain, kinds: &[&str]) -> Result<(), RuleFaults> {
        let kinds: Vec<_> = kinds.iter().filter_map(|kind| domain.kind(kind)).collect();
        let known: HashSet<String> = self.objects.iter().map(|o| name_key(&o.name)).collect();
        let mut faults = Vec::new();
        for statement in self.facts.iter().chain(&self.goal).filter(|s| s.text.is_some()) {
            let Some(predicate) = domain.predicate(&statement.predicate) else { continue };
            let signature = &domain.predicates[predicate.index()].args;
            for (place, (name, wanted)) in statement.args.iter().zip(signature).enumerate() {
                let is_theirs = wanted.iter().any(|kind| kinds.contains(kind));
                if !is_theirs || known.contains(&name_key(name)) {
                    continue;
                }
                let objects = self.objects.iter().map(|object| object.name.as_str());
                let help = hint(name, objects.chain(self.called.spelt())).or_else(|| {
                    let known = word!("the-map-knows-no-such-name-name");
                    Some(known.into())
                });
                let name = name.clone();
                let error = |at| RuleError::UnknownObject { name, help, at };
                faults.push(statement.argument_fault(place, error));
            }
        }
        if faults.is_empty() { Ok(()) } else { Err(RuleFaults(faults)) }
    }

    /// The facts and assumptions that a text states.
    pub fn stated_facts(&self) -> impl Iterator<Item = Stated<'_>> {
        self.facts.iter().filter(|fact| fact.text.is_some()).map(Stated)
    }

    /// What is wanted where it can be had.
    pub fn preferences(&self) -> impl Iterator<Item = &Preference> {
        self.preferences.iter().map(|(preference, _)| preference)
    }

    /// The problem in which the preferences of these numbers are goals, and no others are left.
    #[must_use]
    pub fn with_preferences(&self, kept: impl Fn(usize) -> bool) -> Self {
        let mut problem = self.clone();
        let all = std::mem::take(&mut problem.preferences).into_iter().enumerate();
        let wanted = all.filter(|(number, _)| kept(*number)).map(|(_, (_, formula))| formula);
        problem.goal_formulas.extend(wanted);
        problem.goal_is_empty |= !problem.has_goal();
        problem
    }

    /// The problem in which of all goals one is left; none where that is not stated as it stands.
    #[must_use]
    pub fn for_goal(&self, goal: &Said) -> Option<Self> {
        let is_it = |stated: &&Statement| {
            let said = goal.args.iter().map(|argument| match argument {
                SaidArgument::Object(name) => name_key(name),
                SaidArgument::Any(_) => String::new(),
            });
            stated.negated == goal.negated
                && name_key(&stated.predicate) == name_key(&goal.name)
                && stated.args.iter().map(|arg| name_key(arg)).eq(said)
        };
        let goal = vec![self.goal.iter().find(is_it)?.clone()];
        let (goal_formulas, preferences) = (Vec::new(), Vec::new());
        Some(Self { goal, goal_formulas, preferences, ..self.clone() })
    }

    /// What a text wants to hold in the end, comparisons left aside.
    pub fn stated_goals(&self) -> impl Iterator<Item = Stated<'_>> {
        self.goal.iter().filter(|fact| fact.text.is_some()).map(Stated)
    }

    /// The statements of a document.
    pub(super) fn of(
        document: &Document,
        (goal_formulas, wishes): (Vec<Formula>, Vec<Option<Formula>>),
        faults: &mut Vec<RuleFault>,
    ) -> Self {
        let mut goal_objects = Vec::new();
        let is_compound = |condition: &&Condition| {
            matches!(condition, Condition::Any(..) | Condition::Quantified { .. })
        };
        for condition in document.wanted().filter(is_compound) {
            condition.for_each_atom(&mut Vec::new(), &mut |atom, _| {
                let objects = atom.args.iter().filter(|term| !term.is_variable);
                goal_objects.extend(objects.map(|term| term.name.clone()));
            });
        }
        let preferences = weighed(document, faults).into_iter().zip(wishes);
        let mut problem = Self {
            preferences: preferences.filter_map(|(own, wish)| Some((own, wish?))).collect(),
            goal_formulas,
            goal_objects,
            values: document
                .values
                .iter()
                .map(|(atom, amount)| (atom.clone(), amount.in_units(document.cost_unit())))
                .collect(),
            objects_closed: document.objects_closed,
            goal_is_empty: document.goal_is_empty,
            ..Self::default()
        };
        for declaration in &document.objects {
            problem.objects.push(ObjectStatement {
                name: declaration.name.text.clone(),
                kinds: declaration.kinds.iter().map(|kind| kind.first().to_owned()).collect(),
                text: Some(declaration.clone()),
            });
        }
        for condition in document.facts.iter().chain(&document.assumptions) {
            if let (Condition::Any(..) | Condition::Quantified { .. }, Some(name)) =
                (condition, condition.first_name())
            {
                faults.push(name.fault(no_plain_fact));
            }
        }
        let mut state = |conditions: &[Condition], standing, into: &mut Vec<Statement>| {
            for condition in conditions {
                match condition {
                    Condition::Holds { atom, negated } => {
                        into.push(Statement::of(atom, *negated, standing));
                    }
                    Condition::Equal { pair, negated } => {
                        let (left, right) = &**pair;
                        problem.compared.push((left.name.clone(), right.name.clone(), *negated));
                    }
                    // In a goal a formula; nothing else states it.
                    Condition::Any(..) | Condition::Quantified { .. } => {}
                }
                check_ground(condition, faults);
            }
        };
        let (mut facts, mut goal) = (Vec::new(), Vec::new());
        state(&document.facts, Standing::Fact, &mut facts);
        state(&document.assumptions, Standing::Assumption, &mut facts);
        state(&document.goal, Standing::Fact, &mut goal);
        problem.facts = facts;
        problem.goal = goal;
        problem
    }

    /// Predicates and numbers of arguments can be checked before a map supplies its objects, and all
    /// else where every object must be declared.
    pub(super) fn check(&self, domain: &Domain, faults: &mut Vec<RuleFault>) {
        if self.objects_closed {
            faults.extend(self.resolve(domain).err().into_iter().flat_map(|faults| faults.0));
            return;
        }
        let stated = self.facts.iter().chain(&self.goal).filter(|s| s.text.is_some());
        faults.extend(stated.filter_map(|statement| statement.predicate(domain).err()));
    }
}

/// A fact of a text: as it is, as it is assumed, or as it is wanted.
#[derive(Debug, Clone, Copy)]
pub struct Stated<'p>(&'p Statement);

impl<'p> Stated<'p> {
    #[must_use]
    pub fn predicate(self) -> &'p str {
        &self.0.predicate
    }

    #[must_use]
    pub fn args(self) -> &'p [String] {
        &self.0.args
    }

    /// Whether it is not to hold.
    #[must_use]
    pub fn is_negated(self) -> bool {
        self.0.negated
    }

    /// As the rule language writes it.
    #[must_use]
    pub fn shown(self) -> String {
        self.0.shown()
    }

    /// A fault of it, at its place in the text.
    #[must_use]
    pub fn fault(self, error: impl FnOnce(miette::SourceSpan) -> RuleError) -> RuleFault {
        self.0.fault(error)
    }

    /// A fault of one of its arguments.
    ///
    /// # Panics
    /// When it has no such argument.
    #[must_use]
    pub fn argument_fault(
        self,
        place: usize,
        error: impl FnOnce(miette::SourceSpan) -> RuleError,
    ) -> RuleFault {
        self.0.argument_fault(place, error)
    }
}

/// The preferences with what the metric makes of each; without a metric each counts as much.
fn weighed(document: &Document, faults: &mut Vec<RuleFault>) -> Vec<Preference> {
    let known = || document.preferences.iter().map(|preference| preference.name.text.as_str());
    for (name, _) in document.violations.iter().flatten() {
        if !known().any(|own| name_key(own) == name.key()) {
            let help = hint(&name.text, known());
            let unknown = name.text.clone();
            faults.push(name.fault(|at| RuleError::UnknownPreference { name: unknown, help, at }));
        }
    }
    let weight = |name: &Name| match &document.violations {
        Some(all) => {
            let own = all.iter().filter(|(of, _)| of.key() == name.key());
            own.map(|(_, weight)| weight.thousandths()).sum()
        }
        None => Amount::ONE.thousandths(),
    };
    let preferences = document.preferences.iter();
    let weighed = preferences
        .map(|own| Preference { name: own.name.text.clone(), weight: weight(&own.name) });
    weighed.collect()
}

fn no_plain_fact(at: miette::SourceSpan) -> RuleError {
    let found = word!("a-negation-a-comparison-or-a-condition");
    RuleError::Syntax { expected: PLAIN_FACT.into(), found: found.into(), at }
}

fn check_ground(condition: &Condition, faults: &mut Vec<RuleFault>) {
    let terms = match condition {
        Condition::Holds { atom, .. } => atom.args.iter().collect::<Vec<_>>(),
        Condition::Equal { pair, .. } => vec![&pair.0, &pair.1],
        Condition::Any(..) | Condition::Quantified { .. } => Vec::new(),
    };
    for term in terms.into_iter().filter(|term| term.is_variable) {
        faults.push(
            term.name
                .fault(|at| RuleError::VariableInFact { variable: term.name.text.clone(), at }),
        );
    }
}

impl Statement {
    fn outside(predicate: &str, args: &[&str], negated: bool, standing: Standing) -> Self {
        let args = args.iter().map(|&arg| arg.to_owned()).collect();
        Self { predicate: predicate.to_owned(), args, negated, standing, text: None }
    }

    fn of(atom: &Atom, negated: bool, standing: Standing) -> Self {
        Self {
            predicate: atom.predicate.first().to_owned(),
            args: atom.args.iter().map(|term| term.name.text.clone()).collect(),
            negated,
            standing,
            text: Some(atom.clone()),
        }
    }

    /// By which name the predicate was written.
    pub(super) fn written(&self) -> &str {
        self.text.as_ref().map_or(&self.predicate, |atom| &atom.predicate.text)
    }

    pub(super) fn predicate(&self, domain: &Domain) -> Result<PredicateId, RuleFault> {
        let name = &self.predicate;
        let Some(predicate) = domain.predicate(name) else {
            let help = hint(name, domain.names_of_predicates())
                .or_else(|| Some(word!("the-rules-have-no-such-predicate").into()));
            return Err(self.fault(|at| RuleError::UnknownPredicate {
                name: name.clone(),
                help,
                at,
            }));
        };
        let expected = domain.predicates[predicate.index()].args.len();
        if expected == self.args.len() {
            return Ok(predicate);
        }
        let written = self.written();
        Err(self.fault(|at| RuleError::Arity {
            name: written.to_owned(),
            expected,
            found: self.args.len(),
            help: domain.signature(predicate, written),
            at,
        }))
    }

    /// Equal for statements that say the same.
    fn key(&self) -> String {
        let args: Vec<String> = self.args.iter().map(|arg| name_key(arg)).collect();
        format!("{}({})", name_key(&self.predicate), args.join(","))
    }

    /// Whether an atom, in which variables stand for any object, says this.
    fn is_matched_by(&self, atom: &Atom) -> bool {
        let mut objects = atom.args.iter().zip(&self.args);
        atom.predicate.key() == name_key(&self.predicate)
            && atom.args.len() == self.args.len()
            && !self.negated
            && objects.all(|(term, arg)| term.is_variable || term.name.key() == name_key(arg))
    }

    fn said(&self) -> Said {
        let args = self.args.iter().map(|arg| SaidArgument::Object(arg.clone())).collect();
        Said { name: self.predicate.clone(), args, negated: self.negated }
    }

    pub(super) fn shown(&self) -> String {
        match &self.text {
            Some(atom) => text_of(atom),
            None => format!("{}_({})", self.predicate, self.args.join(", ")),
        }
    }

    /// A fault at the predicate, or without a place when no text stated this.
    pub(super) fn fault(&self, error: impl FnOnce(miette::SourceSpan) -> RuleError) -> RuleFault {
        match &self.text {
            Some(atom) => atom.predicate.fault(error),
            None => RuleFault::placeless(error((0, 0).into())),
        }
    }

    pub(super) fn argument_fault(
        &self,
        place: usize,
        error: impl FnOnce(miette::SourceSpan) -> RuleError,
    ) -> RuleFault {
        match &self.text {
            Some(atom) => atom.args[place].name.fault(error),
            None => RuleFault::placeless(error((0, 0).into())),
        }
    }
}
