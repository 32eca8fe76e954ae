//! From what a text says to what it means: names resolved, types compared, contradictions found.
//!
//! The paper declares neither types nor predicates. A type is then whatever a parameter is said to be,
//! and a predicate takes in each place what the actions put there; two actions that disagree are a fault.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use miette::SourceSpan;

use super::domain::{
    ANY_KIND, Domain, Formula, KindId, KindSet, Schema, SchemaAtom, SchemaCost, SchemaTerm,
};
use super::error::{Place, RuleError};
use super::fault::RuleFault;
use super::hint::{hint, perhaps};
use super::phrases::phrases;
use super::second::SecondNames;
use super::syntax::{ActionText, Atom, Condition, CostTerm, Document, Name, Parameter, Term};
use crate::units::{Bilingual, Piece, name_key, said, word};

/// The rules of a document. Faults are appended; what could be read is returned all the same.
///
/// Beside them, what of the goal is no plain fact, and what is wanted where it can be had.
pub(super) fn domain(
    document: &Document,
    second: SecondNames,
    faults: &mut Vec<RuleFault>,
) -> (Domain, (Vec<Formula>, Vec<Option<Formula>>)) {
    let domain = Domain { second: Arc::new(second), ..Checker::kinds(document, faults) };
    let (functions, actions) = (HashMap::new(), HashMap::new());
    let mut checker = Checker { domain, constants: None, functions, actions, faults };
    checker.declare_objects(document);
    if document.objects_closed {
        checker.declare_functions(document);
    }
    checker.declare_predicates(document);
    if !document.predicates_closed {
        checker.infer_predicates(document);
    }
    for action in &document.actions {
        checker.schema(action);
    }
    for rule in &document.derived {
        checker.derived(rule);
    }
    checker.derived_is_sound(document);
    let wanted = (checker.goal(document), checker.preferences(document));
    let mut domain = checker.domain;
    domain.phrases = Arc::new(phrases(document, &domain, faults));
    (domain, wanted)
}

pub(super) struct Checker<'a> {
    pub(super) domain: Domain,
    /// Where every object must be declared: those that are, with their types.
    pub(super) constants: Option<BTreeMap<String, (String, KindSet)>>,
    /// Declared functions by key, with their numbers of arguments.
    pub(super) functions: HashMap<String, usize>,
    /// Where each action is, by key.
    actions: HashMap<String, Place>,
    pub(super) faults: &'a mut Vec<RuleFault>,
}

/// The variables of one action.
pub(super) type Scope = HashMap<String, (u32, KindSet)>;

impl Checker<'_> {
    fn kind(&mut self, name: &Name) -> Option<KindId> {
        let found = self.domain.kind(name.first());
        if found.is_none() {
            let help = hint(&name.text, self.domain.names_of_kinds())
                .or_else(|| Some(word!("declare-the-type-under-types-pddl-types").into()));
            self.faults.push(name.fault(|at| RuleError::UnknownType {
                name: name.text.clone(),
                help,
                at,
            }));
        }
        found
    }

    /// An empty list, or one whose every name is unknown, is any object.
    pub(super) fn kind_set(&mut self, names: &[Name]) -> KindSet {
        let kinds: KindSet = names.iter().filter_map(|name| self.kind(name)).collect();
        if kinds.is_empty() { vec![ANY_KIND] } else { kinds }
    }

    pub(super) fn duplicate(&mut self, what: Piece, name: &Name, first: Option<Place>) {
        let (first, elsewhere) =
            first.map_or((None, Bilingual::new("", "")), |first| places(&first, name));
        let help = said!("rename-one", elsewhere);
        let what = what.into();
        let name_text = name.text.clone();
        let error = |at| RuleError::Duplicate { what, name: name_text, help, at, first };
        self.faults.push(name.fault(error));
    }

    fn schema(&mut self, action: &ActionText) {
        let name = &action.name;
        if let Some(first) = self.actions.get(&name.key()).cloned() {
            self.duplicate(word!("the-action"), name, Some(first));
            return;
        }
        self.actions.insert(name.key(), name.at.clone());
        let mut schema = Schema::new(&name.text);
        let scope = self.parameters(&action.parameters, &mut schema);
        self.precondition(action, &scope, &mut schema);
        self.effects(action, &scope, &mut schema);
        for part in &action.conditional {
            if let Some(effect) = self.conditional(action, &scope, part) {
                schema.conditional.push(effect);
            }
        }
        for cost in &action.cost {
            if let (CostTerm::Function(atom), true) = (cost, self.constants.is_some()) {
                self.function(atom);
            }
            schema.cost.push(match cost {
                CostTerm::Number(amount) => {
                    SchemaCost::Number(amount.in_units(self.domain.cost_unit))
                }
                CostTerm::Function(atom) => SchemaCost::Function {
                    name: atom.predicate.key(),
                    args: atom.args.iter().filter_map(|t| self.term(action, &scope, t)).collect(),
                },
            });
        }
        self.domain.schemas.push(schema);
    }

    /// The variables of a rule, numbered.
    pub(super) fn parameters(&mut self, parameters: &[Parameter], schema: &mut Schema) -> Scope {
        let mut scope = Scope::new();
        for parameter in parameters {
            let kinds = self.kind_set(&parameter.kinds);
            let variable = &parameter.variable;
            let number = schema.parameters.len() as u32;
            if scope.insert(variable.key(), (number, kinds.clone())).is_some() {
                let known = parameters.iter().find(|p| p.variable.key() == variable.key());
                self.duplicate(
                    word!("the-parameter"),
                    variable,
                    known.map(|p| p.variable.at.clone()),
                );
            }
            schema.parameters.push(kinds);
            schema.parameter_names.push(variable.text.clone());
        }
        scope
    }

    pub(super) fn precondition(&mut self, action: &ActionText, scope: &Scope, schema: &mut Schema) {
        for condition in &action.precondition {
            match condition {
                Condition::Holds { atom, negated } => {
                    let Some(meaning) = self.atom(action, scope, atom) else { continue };
                    let (here, there) = if *negated {
                        (&mut schema.negative_preconditions, &schema.preconditions)
                    } else {
                        (&mut schema.preconditions, &schema.negative_preconditions)
                    };
                    if there.contains(&meaning) {
                        self.faults.push(atom.predicate.fault(|at| {
                            RuleError::ContradictoryPrecondition {
                                action: action.name.text.clone(),
                                atom: text_of(atom),
                                at,
                            }
                        }));
                    } else if !here.contains(&meaning) {
                        here.push(meaning);
                    }
                }
                Condition::Equal { pair, negated } => {
                    let (left, right) = &**pair;
                    let left = self.term(action, scope, left);
                    let right = self.term(action, scope, right);
                    if let (Some(left), Some(right)) = (left, right) {
                        let pairs =
                            if *negated { &mut schema.different } else { &mut schema.equal };
                        pairs.push((left, right));
                    }
                }
                compound => schema.formulas.extend(self.formula(action, scope, compound)),
            }
        }
    }

    fn effects(&mut self, action: &ActionText, scope: &Scope, schema: &mut Schema) {
        for atom in &action.add {
            if let Some(meaning) = self.atom(action, scope, atom)
                && !schema.add_effects.contains(&meaning)
            {
                schema.add_effects.push(meaning);
            }
        }
        let renewed = action.renewed.iter().filter_map(|atom| self.atom(action, scope, atom));
        schema.renewed = renewed.collect();
        for atom in &action.del {
            let Some(meaning) = self.atom(action, scope, atom) else { continue };
            if schema.add_effects.contains(&meaning) {
                self.faults.push(atom.predicate.fault(|at| RuleError::ContradictoryEffect {
                    action: action.name.text.clone(),
                    atom: text_of(atom),
                    at,
                }));
            } else if !schema.del_effects.contains(&meaning) {
                schema.del_effects.push(meaning);
            }
        }
    }

    pub(super) fn atom(
        &mut self,
        action: &ActionText,
        scope: &Scope,
        atom: &Atom,
    ) -> Option<SchemaAtom> {
        let name = &atom.predicate;
        let Some(predicate) = self.domain.predicate(name.first()) else {
            let help = hint(&name.text, self.domain.names_of_predicates())
                .or_else(|| Some(word!("declare-it-under-predicates-pddl-predicates").into()));
            let error = |at| RuleError::UnknownPredicate { name: name.text.clone(), help, at };
            self.faults.push(name.fault(error));
            let _ = self.terms(action, scope, atom);
            return None;
        };
        let signature = self.domain.predicates[predicate.index()].clone();
        if signature.args.len() != atom.args.len() {
            self.faults.push(name.fault(|at| RuleError::Arity {
                name: name.text.clone(),
                expected: signature.args.len(),
                found: atom.args.len(),
                help: self.domain.signature(predicate, &name.text),
                at,
            }));
            let _ = self.terms(action, scope, atom);
            return None;
        }
        let args = self.terms(action, scope, atom)?;
        for (place, (term, wanted)) in atom.args.iter().zip(&signature.args).enumerate() {
            let have = match &args[place] {
                SchemaTerm::Parameter(_) => scope[&term.name.key()].1.clone(),
                SchemaTerm::Constant(name) => self.constant_kinds(name),
            };
            // A parameter of a wider type is let through: what facts there are narrows it.
            let may_fit = have.is_empty()
                || wanted.is_empty()
                || self.domain.fits(&have, wanted)
                || self.domain.fits(wanted, &have);
            if !may_fit {
                self.faults.push(term.name.fault(|at| RuleError::ArgumentType {
                    name: name.text.clone(),
                    number: place + 1,
                    expected: self.domain.kind_names(wanted),
                    term: term.name.text.clone(),
                    found: self.domain.kind_names(&have),
                    help: self.domain.signature(predicate, &name.text),
                    at,
                }));
            }
        }
        Some(SchemaAtom { predicate, args })
    }

    /// All terms, or the faults of each that means nothing.
    fn terms(
        &mut self,
        action: &ActionText,
        scope: &Scope,
        atom: &Atom,
    ) -> Option<Vec<SchemaTerm>> {
        let terms: Vec<Option<SchemaTerm>> =
            atom.args.iter().map(|term| self.term(action, scope, term)).collect();
        terms.into_iter().collect()
    }

    pub(super) fn term(
        &mut self,
        action: &ActionText,
        scope: &Scope,
        term: &Term,
    ) -> Option<SchemaTerm> {
        if !term.is_variable {
            if let Some(kind) = &term.kind {
                self.kind(kind);
            }
            self.check_constant(action, &term.name);
            return Some(SchemaTerm::Constant(term.name.text.clone()));
        }
        let Some((index, declared)) = scope.get(&term.name.key()) else {
            let help =
                hint(&term.name.text, action.parameters.iter().map(|p| p.variable.text.as_str()))
                    .or_else(|| Some(said!("add-it-to-the-parameters")));
            self.faults.push(term.name.fault(|at| RuleError::UndeclaredVariable {
                action: action.name.text.clone(),
                variable: term.name.text.clone(),
                help,
                at,
            }));
            return None;
        };
        if let Some(said) = &term.kind
            && let Some(kind) = self.kind(said)
            && !self.domain.fits(declared, &[kind])
            && !self.domain.fits(&[kind], declared)
        {
            self.faults.push(said.fault(|at| RuleError::VariableType {
                variable: term.name.text.clone(),
                declared: self.domain.kind_names(declared),
                found: said.text.clone(),
                at,
            }));
        }
        Some(SchemaTerm::Parameter(*index))
    }

    /// None where objects need not be declared.
    fn constant_kinds(&self, name: &str) -> KindSet {
        let declared = self.constants.as_ref().and_then(|known| known.get(&name_key(name)));
        declared.map(|(_, kinds)| kinds.clone()).unwrap_or_default()
    }

    /// A name in a rule that is neither a parameter nor declared is most often a variable without its mark.
    fn check_constant(&mut self, action: &ActionText, name: &Name) {
        let Some(known) = &self.constants else { return };
        if known.contains_key(&name.key()) {
            return;
        }
        let marked = format!("?{}", name.key());
        let help = match action.parameters.iter().find(|p| p.variable.key() == marked) {
            Some(parameter) => Some(perhaps(&parameter.variable.text)),
            None => hint(&name.text, known.values().map(|(name, _)| name.as_str()))
                .or_else(|| Some(said!("declare-it-in-constants"))),
        };
        self.faults.push(name.fault(|at| RuleError::UnknownObject {
            name: name.text.clone(),
            help,
            at,
        }));
    }
}

/// The first place as a second label; where it stands in another text, in words.
pub(super) fn places(first: &Place, second: &Name) -> (Option<SourceSpan>, Bilingual) {
    if first.source.name() == second.at.source.name() {
        return (Some(first.span), Bilingual::new("", ""));
    }
    let (line, column) = first.position();
    let at = format!("{}:{line}:{column}", first.source.name());
    (None, said!("the-first-time-at", at))
}

/// An atom as a person would write it.
pub(super) fn text_of(atom: &Atom) -> String {
    let args: Vec<&str> = atom.args.iter().map(|term| term.name.text.as_str()).collect();
    format!("{}_({})", atom.predicate.text, args.join(", "))
}
