//! From what a text says to what it means: names resolved, types compared, contradictions found.
//!
//! The paper declares neither types nor predicates. A type is then whatever a parameter is said to be,
//! and a predicate takes in each place what the actions put there; two actions that disagree are a fault.

use std::collections::{BTreeMap, HashMap};
use std::sync::Arc;

use miette::SourceSpan;
use petgraph::algo::kosaraju_scc;
use petgraph::graph::{DiGraph, NodeIndex};

use super::domain::{
    ANY_KIND, Domain, Formula, Kind, KindId, KindSet, Predicate, PredicateId, Schema, SchemaAtom,
    SchemaCost, SchemaTerm,
};
use super::error::{Place, RuleError};
use super::fault::RuleFault;
use super::phrase::phrases;
use super::syntax::{
    ActionText, Atom, Condition, CostTerm, Declaration, Document, Name, Parameter, Term,
};
use crate::units::{Bilingual, Language, name_key, nearest_name};

/// The rules of a document. Faults are appended; what could be read is returned all the same.
///
/// Beside them, what of the goal is no plain fact, and what is wanted where it can be had.
pub(super) fn domain(
    document: &Document,
    faults: &mut Vec<RuleFault>,
) -> (Domain, (Vec<Formula>, Vec<Option<Formula>>)) {
    let domain = kinds(document, faults);
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

pub(super) fn hint<'a>(
    wanted: &str,
    known: impl IntoIterator<Item = &'a str>,
) -> Option<Bilingual> {
    nearest_name(wanted, known).map(|near| {
        if looks_the_same(near, wanted) {
            Bilingual::new(
                format!(
                    "может быть, «{near}»? буквы выглядят одинаково, но взяты из разных алфавитов"
                ),
                format!(
                    "perhaps “{near}”? the letters look the same, but are of different alphabets"
                ),
            )
        } else {
            perhaps(near)
        }
    })
}

pub(super) fn perhaps(near: &str) -> Bilingual {
    Bilingual::new(format!("может быть, «{near}»?"), format!("perhaps “{near}”?"))
}

/// Whether two names differ only in the alphabet of letters that look alike, as В and B.
pub(super) fn looks_the_same(a: &str, b: &str) -> bool {
    fn latin(c: char) -> char {
        const CYRILLIC: &str = "авекмнорстухіј";
        const LATIN: &str = "abekmhopctyxij";
        match CYRILLIC.chars().position(|letter| letter == c) {
            Some(at) => LATIN.chars().nth(at).expect("both alphabets are of one length"),
            None => c,
        }
    }
    name_key(a).chars().map(latin).eq(name_key(b).chars().map(latin))
}

/// The type tree. Types named only as parents or in parameters count as declared where nothing else is.
fn kinds(document: &Document, faults: &mut Vec<RuleFault>) -> Domain {
    let mut domain = Domain {
        kinds: vec![Kind { name: "объект".to_owned(), parents: Vec::new() }],
        kind_index: HashMap::from([
            ("объект".to_owned(), ANY_KIND),
            ("object".to_owned(), ANY_KIND),
        ]),
        predicates: Vec::new(),
        predicate_index: HashMap::new(),
        schemas: Vec::new(),
        derived: Vec::new(),
        cost_unit: document.cost_unit(),
        phrases: Arc::default(),
        introduced: HashMap::new(),
    };
    fn introduce(domain: &mut Domain, name: &Name) -> KindId {
        let next = KindId(domain.kinds.len() as u32);
        let id = *domain.kind_index.entry(name.key()).or_insert(next);
        if id == next {
            domain.kinds.push(Kind { name: name.text.clone(), parents: Vec::new() });
        }
        id
    }
    let mut parents: BTreeMap<KindId, Vec<(KindId, Name)>> = BTreeMap::new();
    for Declaration { name, kinds } in document.types.iter().flatten() {
        let id = introduce(&mut domain, name);
        for parent in kinds {
            let parent_id = introduce(&mut domain, parent);
            parents.entry(id).or_default().push((parent_id, parent.clone()));
        }
    }
    if document.types.is_none() {
        let derived = document.derived.iter().flat_map(|rule| &rule.parameters);
        let parameters = document.actions.iter().flat_map(|a| &a.parameters).chain(derived);
        let in_actions = parameters.flat_map(|p| &p.kinds);
        let in_signatures = document.predicates.iter().flat_map(|s| s.args.iter().flatten());
        let in_objects = document.objects.iter().flat_map(|o| &o.kinds);
        for name in in_actions.chain(in_signatures).chain(in_objects) {
            introduce(&mut domain, name);
        }
        let mut of_bound = |_: &Atom, bound: &[&Parameter]| {
            bound.iter().flat_map(|parameter| &parameter.kinds).for_each(|name| {
                introduce(&mut domain, name);
            });
        };
        document.each_atom_of_rules(&mut of_bound);
        for condition in document.wanted() {
            condition.for_each_atom(&mut Vec::new(), &mut |atom, bound| of_bound(atom, bound));
        }
    }
    let node = |kind: KindId| NodeIndex::new(kind.index());
    let edges =
        parents.iter().flat_map(|(kind, above)| above.iter().map(move |(p, _)| (*kind, *p)));
    let mut graph: DiGraph<(), ()> =
        DiGraph::from_edges(edges.map(|(kind, parent)| (node(kind), node(parent))));
    while graph.node_count() < domain.kinds.len() {
        graph.add_node(());
    }
    let mut group = vec![0; domain.kinds.len()];
    for (n, members) in kosaraju_scc(&graph).into_iter().enumerate() {
        members.into_iter().for_each(|member| group[member.index()] = n);
    }
    for (kind, above) in parents {
        for (parent, name) in &above {
            // "object" above itself says nothing new.
            if group[kind.index()] == group[parent.index()] && *parent != ANY_KIND {
                let kind = domain.kinds[parent.index()].name.clone();
                faults.push(name.fault(|at| RuleError::TypeCycle { name: kind, at }));
            }
        }
        let mut above: Vec<KindId> = above.into_iter().map(|(parent, _)| parent).collect();
        above.retain(|parent| *parent != kind);
        domain.kinds[kind.index()].parents = above;
    }
    domain
}

pub(super) struct Checker<'a> {
    pub(super) domain: Domain,
    /// Where every object must be declared: those that are, with their types.
    constants: Option<BTreeMap<String, (String, KindSet)>>,
    /// Declared functions by key, with their numbers of arguments.
    functions: HashMap<String, usize>,
    /// Where each action is, by key.
    actions: HashMap<String, Place>,
    pub(super) faults: &'a mut Vec<RuleFault>,
}

/// The variables of one action.
pub(super) type Scope = HashMap<String, (u32, KindSet)>;

impl Checker<'_> {
    fn kind(&mut self, name: &Name) -> Option<KindId> {
        let found = self.domain.kind(&name.text);
        if found.is_none() {
            let help =
                hint(&name.text, self.domain.kinds.iter().map(|k| k.name.as_str())).or_else(|| {
                    Some(
                        (
                            "объявите тип в разделе «Типы»",
                            "declare the type under “Types:” (PDDL: :types)",
                        )
                            .into(),
                    )
                });
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

    fn add_predicate(&mut self, name: &str, args: Vec<KindSet>) -> PredicateId {
        let id = PredicateId(self.domain.predicates.len() as u32);
        self.domain.predicates.push(Predicate { name: name.to_owned(), args });
        self.domain.predicate_index.insert(name_key(name), id);
        id
    }

    /// Two declarations of one object must agree, or one type inherit from the other; a constant of the domain may be
    /// named in the problem again.
    fn declare_objects(&mut self, document: &Document) {
        let mut declared: BTreeMap<String, (String, KindSet)> = BTreeMap::new();
        let mut first: HashMap<String, (&Name, KindSet)> = HashMap::new();
        for Declaration { name, kinds } in &document.objects {
            let mut kinds: KindSet =
                kinds.iter().filter_map(|kind| self.domain.kind(&kind.text)).collect();
            let is_untyped = kinds.is_empty();
            if is_untyped {
                kinds.push(ANY_KIND);
            }
            declared.entry(name.key()).or_insert_with(|| (name.text.clone(), kinds.clone()));
            let (known, theirs) = first.entry(name.key()).or_insert((name, kinds.clone()));
            let agree = self.domain.fits(&kinds, theirs) || self.domain.fits(theirs, &kinds);
            if !agree {
                let found = self.domain.kind_names(&kinds);
                let earlier = self.domain.kind_names(theirs);
                let (first, elsewhere) = places(&known.at, name);
                self.faults.push(name.fault(|at| RuleError::ObjectTwice {
                    name: name.text.clone(),
                    found,
                    earlier,
                    help: Bilingual::new(
                        format!("оставьте одно из двух{}", elsewhere.say(Language::Russian)),
                        format!("keep one of the two{}", elsewhere.say(Language::English)),
                    ),
                    at,
                    first,
                }));
            }
        }
        self.constants = document.objects_closed.then_some(declared);
    }

    /// What no problem needs to declare is the sum itself.
    fn declare_functions(&mut self, document: &Document) {
        self.functions.insert("total-cost".to_owned(), 0);
        for signature in &document.functions {
            self.functions.insert(signature.name.key(), signature.args.len());
        }
        for (atom, _) in &document.values {
            self.function(atom);
        }
    }

    fn function(&mut self, atom: &Atom) {
        let name = &atom.predicate;
        match self.functions.get(&name.key()) {
            Some(&expected) if expected == atom.args.len() => {}
            Some(&expected) => self.faults.push(name.fault(|at| RuleError::Arity {
                name: name.text.clone(),
                expected,
                found: atom.args.len(),
                help: Bilingual::new(
                    format!("в «:functions» у «{}» аргументов {expected}", name.text),
                    format!("in :functions “{}” has so many: {expected}", name.text),
                ),
                at,
            })),
            None => {
                let help =
                    hint(&name.text, self.functions.keys().map(String::as_str)).or_else(|| {
                        Some(("объявите её в «:functions»", "declare it in :functions").into())
                    });
                self.faults.push(name.fault(|at| RuleError::UnknownFunction {
                    name: name.text.clone(),
                    help,
                    at,
                }));
            }
        }
    }

    fn declare_predicates(&mut self, document: &Document) {
        for signature in &document.predicates {
            if let Some(known) = self.domain.predicate(&signature.name.text) {
                let first = self.domain.introduced.get(&known).cloned();
                self.duplicate(("предикат", "the predicate"), &signature.name, first);
                continue;
            }
            let args = signature.args.iter().map(|kinds| self.kind_set(kinds)).collect();
            let id = self.add_predicate(&signature.name.text, args);
            self.domain.introduced.insert(id, signature.name.at.clone());
        }
    }

    fn duplicate(&mut self, what: (&'static str, &'static str), name: &Name, first: Option<Place>) {
        let (first, elsewhere) =
            first.map_or((None, Bilingual::new("", "")), |first| places(&first, name));
        let help = Bilingual::new(
            format!("переименуйте или уберите одно из двух{}", elsewhere.say(Language::Russian)),
            format!("rename or remove one of the two{}", elsewhere.say(Language::English)),
        );
        let what = what.into();
        let name_text = name.text.clone();
        let error = |at| RuleError::Duplicate { what, name: name_text, help, at, first };
        self.faults.push(name.fault(error));
    }

    /// Signatures of undeclared predicates: in each place the nearest type that all uses inherit from.
    fn infer_predicates(&mut self, document: &Document) {
        let declared = self.domain.predicates.len();
        let arities = arities(document);
        document.each_atom_of_rules(&mut |atom, bound| {
            if arities.get(&atom.predicate.key()) != Some(&atom.args.len()) {
                return;
            }
            let args: Vec<Option<KindSet>> = atom
                .args
                .iter()
                .map(|term| {
                    let by_name = |p: &&&Parameter| p.variable.key() == term.name.key();
                    let names = match bound.iter().rev().find(by_name) {
                        Some(parameter) if term.is_variable => parameter.kinds.as_slice(),
                        _ => term.kind.as_slice(),
                    };
                    let kinds: KindSet =
                        names.iter().filter_map(|name| self.domain.kind(&name.text)).collect();
                    (!kinds.is_empty()).then_some(kinds)
                })
                .collect();
            self.infer_from(atom, &args, declared);
        });
    }

    fn infer_from(&mut self, atom: &Atom, args: &[Option<KindSet>], declared: usize) {
        let Some(id) = self.domain.predicate(&atom.predicate.text) else {
            let args = args.iter().map(|kinds| kinds.clone().unwrap_or_default()).collect();
            let id = self.add_predicate(&atom.predicate.text, args);
            self.domain.introduced.insert(id, atom.predicate.at.clone());
            return;
        };
        // A declaration stands as it is; its uses are compared with it later.
        if id.index() < declared || self.domain.predicates[id.index()].args.len() != args.len() {
            return;
        }
        for (place, kinds) in args.iter().enumerate() {
            let Some(kinds) = kinds else { continue };
            let known = &self.domain.predicates[id.index()].args[place];
            let joined = if known.is_empty() {
                Some(kinds.clone())
            } else if kinds.iter().all(|&kind| self.domain.fits(&[kind], known)) {
                None
            } else {
                self.common_ancestor(known, kinds).map(|kind| vec![kind])
            };
            if let Some(joined) = joined {
                self.domain.predicates[id.index()].args[place] = joined;
            }
        }
    }

    /// The first ancestor of `a` that everything in both inherits from; "any object" is none.
    fn common_ancestor(&self, a: &[KindId], b: &[KindId]) -> Option<KindId> {
        self.domain.lineage(a[0]).find(|&ancestor| {
            ancestor != ANY_KIND
                && a.iter().chain(b).all(|&kind| self.domain.inherits(kind, ancestor))
        })
    }

    fn schema(&mut self, action: &ActionText) {
        let name = &action.name;
        if let Some(first) = self.actions.get(&name.key()).cloned() {
            self.duplicate(("действие", "the action"), name, Some(first));
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
                    ("параметр", "the parameter"),
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
        let Some(predicate) = self.domain.predicate(&name.text) else {
            let help = hint(&name.text, self.domain.predicates.iter().map(|p| p.name.as_str()))
                .or_else(|| {
                    Some(
                        (
                            "объявите его в разделе «Предикаты»",
                            "declare it under “Predicates:” (PDDL: :predicates)",
                        )
                            .into(),
                    )
                });
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
                help: self.signature(predicate),
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
                    name: signature.name.clone(),
                    number: place + 1,
                    expected: self.domain.kind_names(wanted),
                    term: term.name.text.clone(),
                    found: self.domain.kind_names(&have),
                    help: self.signature(predicate),
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
                    .or_else(|| {
                        Some(("добавьте её в «Параметры»", "add it to the parameters").into())
                    });
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
            None => hint(&name.text, known.values().map(|(name, _)| name.as_str())).or_else(|| {
                Some(("объявите его в «:constants»", "declare it in :constants").into())
            }),
        };
        self.faults.push(name.fault(|at| RuleError::UnknownObject {
            name: name.text.clone(),
            help,
            at,
        }));
    }

    fn signature(&self, predicate: PredicateId) -> Bilingual {
        self.domain.signature(predicate)
    }
}

impl Domain {
    /// `ДВЕРЬ_НАХОДИТСЯ-В_(дверь, помещение)`, for messages.
    pub(super) fn signature(&self, predicate: PredicateId) -> Bilingual {
        let Predicate { name, args } = &self.predicates[predicate.index()];
        let told = |language: Language| {
            let args: Vec<String> = args
                .iter()
                .map(|kinds| match kinds.is_empty() {
                    true => language.pick("объект", "object").to_owned(),
                    false => self.kind_names(kinds).say(language).to_owned(),
                })
                .collect();
            let place = self.introduced.get(&predicate).map_or_else(String::new, |place| {
                let (line, column) = place.position();
                let here = language.pick("как здесь", "as here");
                format!(", {here}: {}:{line}:{column}", place.source.name())
            });
            format!("{}: {name}_({}){place}", language.pick("запись", "written"), args.join(", "))
        };
        Bilingual::new(told(Language::Russian), told(Language::English))
    }
}

/// How many arguments each predicate has by most of its uses; by the first of them where no number leads.
fn arities(document: &Document) -> HashMap<String, usize> {
    let mut counts: HashMap<String, Vec<(usize, usize)>> = HashMap::new();
    let mut count = |atom: &Atom| {
        let of_predicate = counts.entry(atom.predicate.key()).or_default();
        match of_predicate.iter_mut().find(|(arity, _)| *arity == atom.args.len()) {
            Some((_, count)) => *count += 1,
            None => of_predicate.push((atom.args.len(), 1)),
        }
    };
    document.each_atom_of_rules(&mut |atom, _| count(atom));
    for condition in document.facts.iter().chain(&document.assumptions).chain(document.wanted()) {
        condition.for_each_atom(&mut Vec::new(), &mut |atom, _| count(atom));
    }
    let most = |counts: Vec<(usize, usize)>| {
        let most = counts.iter().map(|&(_, count)| count).max()?;
        counts.into_iter().find(|&(_, count)| count == most).map(|(arity, _)| arity)
    };
    counts.into_iter().filter_map(|(key, counts)| Some((key, most(counts)?))).collect()
}

/// The first place as a second label; where it stands in another text, in words.
fn places(first: &Place, second: &Name) -> (Option<SourceSpan>, Bilingual) {
    if first.source.name() == second.at.source.name() {
        return (Some(first.span), Bilingual::new("", ""));
    }
    let (line, column) = first.position();
    let at = format!("{}:{line}:{column}", first.source.name());
    (None, Bilingual::new(format!("; первый раз – {at}"), format!("; the first time at {at}")))
}

/// An atom as a person would write it.
pub(super) fn text_of(atom: &Atom) -> String {
    let args: Vec<&str> = atom.args.iter().map(|term| term.name.text.as_str()).collect();
    format!("{}_({})", atom.predicate.text, args.join(", "))
}
