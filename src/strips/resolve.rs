//! Names of a problem resolved against the rules: objects with their types, atoms of numbers, or all that is wrong.

use std::collections::{BTreeSet, HashMap};

use super::domain::{
    ANY_KIND, Domain, Formula, KindId, KindSet, PredicateId, SchemaAtom, SchemaTerm,
};
use super::error::RuleError;
use super::fault::{RuleFault, RuleFaults};
use super::hint::hint;
use super::other_names::OtherNames;
use super::problem::{Problem, Standing, Statement};
use super::syntax::Atom;
use crate::units::{Gather as _, name_key, said, word};

/// An object of a problem.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub(super) struct ThingId(pub(super) u32);

impl ThingId {
    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

/// An object and the types it has.
#[derive(Debug, Clone)]
pub(super) struct Thing {
    pub(super) name: String,
    pub(super) kinds: KindSet,
}

/// An atom over objects.
#[derive(Debug, Clone, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub(super) struct GroundAtom {
    pub(super) predicate: PredicateId,
    pub(super) args: Vec<ThingId>,
}

/// A problem whose names all mean something.
#[derive(Debug)]
pub(super) struct Resolved {
    pub(super) things: Vec<Thing>,
    pub(super) index: HashMap<String, ThingId>,
    pub(super) facts: Vec<(GroundAtom, Standing)>,
    pub(super) goal: Vec<(GroundAtom, bool)>,
    /// What else is wanted.
    pub(super) goal_formulas: Vec<Formula>,
    pub(super) values: HashMap<(String, Vec<ThingId>), u32>,
    /// The goal compares two names, and the comparison is false.
    pub(super) impossible: bool,
    /// What was assumed until it was withdrawn.
    pub(super) withdrawn: BTreeSet<GroundAtom>,
}

impl Problem {
    /// Every name resolved against the rules.
    pub(super) fn resolve(&self, domain: &Domain) -> Result<Resolved, RuleFaults> {
        let mut resolver = Resolver {
            domain,
            things: Vec::new(),
            index: HashMap::new(),
            faults: Vec::new(),
            closed: self.objects_closed,
            called: &self.called,
        };
        resolver.objects(self);
        let goal_formulas = resolver.formulas(self);
        let facts = resolver.facts(&self.facts);
        let goal = resolver.goal(&self.goal);
        let impossible = resolver.comparisons(self);
        let values = resolver.values(&self.values);
        let withdrawn = resolver.known(&self.withdrawn);
        if resolver.faults.is_empty() {
            Ok(Resolved {
                things: resolver.things,
                index: resolver.index,
                facts,
                goal,
                goal_formulas,
                values,
                impossible,
                withdrawn,
            })
        } else {
            Err(RuleFaults(resolver.faults))
        }
    }
}

struct Resolver<'a> {
    domain: &'a Domain,
    things: Vec<Thing>,
    index: HashMap<String, ThingId>,
    faults: Vec<RuleFault>,
    closed: bool,
    called: &'a OtherNames,
}

impl Resolver<'_> {
    fn introduce(&mut self, name: &str) -> ThingId {
        let next = ThingId(self.things.len() as u32);
        let name = self.called.first(name).unwrap_or(name);
        let id = *self.index.entry(name_key(name)).or_insert(next);
        if id == next {
            self.things.push(Thing { name: name.to_owned(), kinds: KindSet::new() });
        }
        id
    }

    /// Declared objects first, then those that a fact is enough to make known; a goal makes none.
    fn objects(&mut self, problem: &Problem) {
        for object in &problem.objects {
            let id = self.introduce(&object.name);
            for (place, name) in object.kinds.iter().enumerate() {
                match self.domain.kind(name) {
                    Some(kind) => {
                        let kinds = &mut self.things[id.index()].kinds;
                        if !kinds.contains(&kind) {
                            kinds.push(kind);
                        }
                    }
                    None => {
                        if let Some(declaration) = &object.text {
                            let kinds = self.domain.names_of_kinds();
                            let (name, help) = (name.clone(), hint(name, kinds));
                            self.faults.push(
                                declaration.kinds[place].fault(|at| RuleError::UnknownType {
                                    name,
                                    help,
                                    at,
                                }),
                            );
                        }
                    }
                }
            }
            if object.text.is_some() && self.closed && object.kinds.is_empty() {
                self.things[id.index()].kinds.push(ANY_KIND);
            }
        }
        if !self.closed {
            // What was withdrawn is assumed no longer, but the objects that it spoke of are there still.
            let stated = problem.facts.iter().chain(&problem.withdrawn);
            for fact in stated.filter(|fact| !fact.negated) {
                for arg in &fact.args {
                    self.introduce(arg);
                }
            }
        }
        self.constants_of_rules();
        for (other, name) in self.called.keys() {
            if let Some(&id) = self.index.get(&name_key(name)) {
                self.index.insert(other.to_owned(), id);
            }
        }
        self.infer_kinds(problem);
    }

    /// An undeclared object has the most special of the types that its places in facts and goals ask for.
    fn infer_kinds(&mut self, problem: &Problem) {
        let untyped: Vec<bool> = self.things.iter().map(|thing| thing.kinds.is_empty()).collect();
        let stated = problem.facts.iter().chain(&problem.withdrawn).chain(&problem.goal);
        for statement in stated {
            let Some(predicate) = self.domain.predicate(&statement.predicate) else { continue };
            let signature = &self.domain.predicates[predicate.index()].args;
            for (place, (arg, wanted)) in statement.args.iter().zip(signature).enumerate() {
                let Some(&id) = self.index.get(&name_key(arg)) else { continue };
                let ([wanted], true) = (wanted.as_slice(), untyped[id.index()]) else { continue };
                let have = self.things[id.index()].kinds.first().copied();
                match have {
                    None => self.things[id.index()].kinds.push(*wanted),
                    Some(have) if self.domain.inherits(have, *wanted) => {}
                    Some(have) if self.domain.inherits(*wanted, have) => {
                        self.things[id.index()].kinds[0] = *wanted;
                    }
                    Some(have) => {
                        let error = |at| RuleError::ObjectType {
                            name: arg.clone(),
                            found: self.domain.kind_names(&[*wanted]),
                            earlier: self.domain.kind_names(&[have]),
                            at,
                        };
                        self.faults.push(statement.argument_fault(place, error));
                    }
                }
            }
        }
        for thing in &mut self.things {
            if thing.kinds.is_empty() {
                thing.kinds.push(ANY_KIND);
            }
        }
    }

    fn facts(&mut self, statements: &[Statement]) -> Vec<(GroundAtom, Standing)> {
        let mut facts = Vec::new();
        let mut known: HashMap<GroundAtom, usize> = HashMap::new();
        let mut denied: Vec<(GroundAtom, &Statement)> = Vec::new();
        for statement in statements {
            let outside = statement.text.is_none();
            if outside && self.domain.predicate(&statement.predicate).is_none() {
                continue;
            }
            let Some(atom) = self.atom(statement) else { continue };
            if statement.negated {
                denied.push((atom, statement));
                continue;
            }
            match known.get(&atom) {
                // What is both known and assumed is known.
                Some(&at) => {
                    let (_, standing): &mut (GroundAtom, Standing) = &mut facts[at];
                    if statement.standing == Standing::Fact {
                        *standing = Standing::Fact;
                    }
                }
                None => {
                    known.insert(atom.clone(), facts.len());
                    facts.push((atom, statement.standing));
                }
            }
        }
        for (atom, statement) in denied {
            if known.contains_key(&atom) {
                let atom = statement.shown();
                self.faults.push(statement.fault(|at| RuleError::ContradictoryFact { atom, at }));
            }
        }
        facts
    }

    /// Those of the statements whose names all mean something.
    fn known(&self, statements: &[Statement]) -> BTreeSet<GroundAtom> {
        let atom = |statement: &Statement| {
            let predicate = statement.predicate(self.domain).ok()?;
            let thing = |arg: &String| self.index.get(&name_key(arg)).copied();
            let args = statement.args.iter().map(thing).collect::<Option<_>>()?;
            Some(GroundAtom { predicate, args })
        };
        statements.iter().filter_map(atom).gather()
    }

    fn goal(&mut self, statements: &[Statement]) -> Vec<(GroundAtom, bool)> {
        let mut goal: Vec<(GroundAtom, bool)> = Vec::new();
        for statement in statements {
            let Some(atom) = self.atom(statement) else { continue };
            if goal.contains(&(atom.clone(), !statement.negated)) {
                let shown = statement.shown();
                self.faults
                    .push(statement.fault(|at| RuleError::ContradictoryFact { atom: shown, at }));
            }
            let wanted = (atom, statement.negated);
            if !goal.contains(&wanted) {
                goal.push(wanted);
            }
        }
        goal
    }

    /// The objects that a condition of the goal names are there, or are told of.
    fn formulas(&mut self, problem: &Problem) -> Vec<Formula> {
        let mut told: BTreeSet<String> = BTreeSet::new();
        for name in &problem.goal_objects {
            if !self.index.contains_key(&name.key()) && told.insert(name.key()) {
                let error = self.unknown_object(&name.text);
                self.faults.push(name.fault(error));
            }
        }
        for formula in &problem.goal_formulas {
            formula.for_each_term(&mut |term| {
                if let SchemaTerm::Constant(name) = term
                    && !self.index.contains_key(&name_key(name))
                    && told.insert(name_key(name))
                {
                    let error = self.unknown_object(name);
                    self.faults.push(RuleFault::placeless(error((0, 0).into())));
                }
            });
        }
        problem.goal_formulas.clone()
    }

    fn comparisons(&mut self, problem: &Problem) -> bool {
        let mut impossible = false;
        for (left, right, negated) in &problem.compared {
            for name in [left, right] {
                if !self.index.contains_key(&name.key()) {
                    let fault = self.unknown_object(&name.text);
                    self.faults.push(name.fault(fault));
                }
            }
            impossible |= (left.key() == right.key()) == *negated;
        }
        impossible
    }

    fn atom(&mut self, statement: &Statement) -> Option<GroundAtom> {
        let predicate =
            statement.predicate(self.domain).map_err(|fault| self.faults.push(fault)).ok()?;
        let signature = &self.domain.predicates[predicate.index()].args;
        let mut args = Vec::new();
        for (place, (arg, wanted)) in statement.args.iter().zip(signature).enumerate() {
            let Some(&id) = self.index.get(&name_key(arg)) else {
                let error = self.unknown_object(arg);
                self.faults.push(statement.argument_fault(place, error));
                continue;
            };
            self.check_kind(statement, predicate, place, id, wanted);
            self.check_said(statement, place, id);
            args.push(id);
        }
        (args.len() == signature.len()).then_some(GroundAtom { predicate, args })
    }

    fn unknown_object(&self, name: &str) -> impl FnOnce(miette::SourceSpan) -> RuleError + use<> {
        let known = self.things.iter().map(|thing| thing.name.as_str());
        let help = hint(name, known.chain(self.called.spelt())).or_else(|| {
            let nobody = word!("neither-the-facts-nor-objects-pddl-objects");
            Some(nobody.into())
        });
        let name = name.to_owned();
        move |at| RuleError::UnknownObject { name, help, at }
    }

    /// The type that a fact gives an object in its place is one, and the object's own.
    fn check_said(&mut self, statement: &Statement, place: usize, id: ThingId) {
        let Some(term) = statement.text.as_ref().and_then(|atom| atom.args.get(place)) else {
            return;
        };
        let Some(said) = &term.kind else { return };
        let kinds = &self.things[id.index()].kinds;
        match self.domain.kind(said.first()) {
            Some(kind) if self.domain.fits(kinds, &[kind]) || self.domain.fits(&[kind], kinds) => {}
            Some(kind) => {
                let error = |at| RuleError::ObjectType {
                    name: term.name.text.clone(),
                    found: self.domain.kind_names(&[kind]),
                    earlier: self.domain.kind_names(kinds),
                    at,
                };
                self.faults.push(said.fault(error));
            }
            None => {
                let (word, name) = (&said.text, &term.name.text);
                let known = self.domain.names_of_kinds();
                let help = hint(word, known)
                    .unwrap_or_else(|| said!("a-name-of-several-words-stands-in", word, name));
                let (name, help) = (word.clone(), Some(help));
                self.faults.push(said.fault(|at| RuleError::UnknownType { name, help, at }));
            }
        }
    }

    fn check_kind(
        &mut self,
        statement: &Statement,
        predicate: PredicateId,
        place: usize,
        id: ThingId,
        wanted: &[KindId],
    ) {
        let thing = &self.things[id.index()];
        // What is known by name alone stands anywhere; what is more general than asked is let be.
        if wanted.is_empty()
            || self.domain.fits(&thing.kinds, wanted)
            || (!self.closed && self.domain.fits(wanted, &thing.kinds))
        {
            return;
        }
        let error = |at| RuleError::ArgumentType {
            name: statement.written().to_owned(),
            number: place + 1,
            expected: self.domain.kind_names(wanted),
            term: thing.name.clone(),
            found: self.domain.kind_names(&thing.kinds),
            help: self.domain.signature(predicate, statement.written()),
            at,
        };
        // Two conflicting uses of an undeclared object have been told already.
        if !self.faults.iter().any(|fault| {
            matches!(&*fault.error, RuleError::ObjectType { name, .. } if *name == thing.name)
        }) {
            self.faults.push(statement.argument_fault(place, error));
        }
    }

    /// Objects that the rules name exist as well, of the types that their places there ask for.
    fn constants_of_rules(&mut self) {
        let domain = self.domain;
        for schema in domain.rules() {
            let needs = schema.preconditions.iter().chain(&schema.negative_preconditions);
            let mut atoms: Vec<&SchemaAtom> = needs.chain(schema.changes()).collect();
            let conditions = schema.conditional.iter().flat_map(|effect| &effect.condition);
            for formula in schema.formulas.iter().chain(conditions) {
                formula.for_each_literal(&mut |atom, _| atoms.push(atom));
                formula.for_each_term(&mut |term| {
                    if let SchemaTerm::Constant(name) = term {
                        self.introduce(name);
                    }
                });
            }
            for atom in atoms {
                let signature = &domain.predicates[atom.predicate.index()].args;
                for (term, wanted) in atom.args.iter().zip(signature) {
                    let SchemaTerm::Constant(name) = term else { continue };
                    let id = self.introduce(name);
                    if self.things[id.index()].kinds.is_empty() {
                        self.things[id.index()].kinds.clone_from(wanted);
                    }
                }
            }
            for (left, right) in schema.equal.iter().chain(&schema.different) {
                for term in [left, right] {
                    if let SchemaTerm::Constant(name) = term {
                        self.introduce(name);
                    }
                }
            }
        }
    }

    fn values(&mut self, values: &[(Atom, u32)]) -> HashMap<(String, Vec<ThingId>), u32> {
        let mut found = HashMap::new();
        for (atom, value) in values {
            let mut args = Vec::new();
            for term in &atom.args {
                match self.index.get(&term.name.key()) {
                    Some(&id) => args.push(id),
                    None => {
                        let error = self.unknown_object(&term.name.text);
                        self.faults.push(term.name.fault(error));
                    }
                }
            }
            found.insert((atom.predicate.key(), args), *value);
        }
        found
    }
}
