//! What could ever apply: every action over every choice of objects that relaxed reachability comes to.
//!
//! Delete effects are forgotten. It runs semi-naively: each new fact is joined with what was known before it, so that no
//! ground action is found twice. Conditions beyond literals are asked for when the literals are met, again and again until
//! they hold. What is derived is reached as by actions.

use std::collections::HashMap;

use super::cases::Objects;
use super::domain::{
    ConditionalEffect, Domain, KindSet, PredicateId, Schema, SchemaAtom, SchemaTerm,
};
use super::error::RuleError;
use super::fault::{RuleFault, RuleFaults};
use super::resolve::{GroundAtom, Resolved, ThingId};
use crate::units::name_key;

/// What grounding may hold where nobody else sets a limit: some two million ground actions.
const MOST_BYTES: usize = 1 << 30;

pub(super) fn is_bounded(bytes: usize) -> bool {
    bytes <= MOST_BYTES
}

pub(super) fn too_many() -> RuleFaults {
    RuleFault::placeless(RuleError::TooManyOperators { megabytes: MOST_BYTES >> 20 }).into()
}

/// Instances of one schema's parameters.
pub(super) struct Instance {
    pub(super) schema: usize,
    pub(super) args: Vec<ThingId>,
}

/// The tuples of one predicate that hold in the relaxed problem so far.
#[derive(Default)]
struct Relation {
    tuples: Vec<Vec<ThingId>>,
    /// Per argument place, the tuples that have an object there.
    by_arg: Vec<HashMap<ThingId, Vec<u32>>>,
    numbers: HashMap<Vec<ThingId>, u32>,
}

impl Relation {
    fn insert(&mut self, tuple: &[ThingId]) {
        let number = self.tuples.len() as u32;
        self.by_arg.resize_with(tuple.len(), HashMap::new);
        for (index, &thing) in self.by_arg.iter_mut().zip(tuple) {
            index.entry(thing).or_default().push(number);
        }
        self.numbers.insert(tuple.to_vec(), number);
        self.tuples.push(tuple.to_vec());
    }
}

/// A choice of objects for some parameters of a schema.
pub(super) type Binding = Vec<Option<ThingId>>;

pub(super) struct Reachability<'a> {
    domain: &'a Domain,
    resolved: &'a Resolved,
    pub(super) changing: Vec<bool>,
    relations: Vec<Relation>,
    /// Objects that may stand for each parameter of each schema.
    candidates: Vec<Vec<Vec<ThingId>>>,
    may_stand: Vec<Vec<Vec<bool>>>,
    pub(super) instances: Vec<Instance>,
    pub(super) atoms: Vec<GroundAtom>,
    pub(super) numbers: HashMap<GroundAtom, usize>,
    may_go_on: &'a dyn Fn(usize) -> bool,
    /// Joins tried so far.
    joins: usize,
    pub(super) objects: Objects<'a>,
    /// Choices of objects whose literals are met, and whose other conditions are not yet.
    waiting: Vec<Instance>,
    /// Actions and those of their effects under conditions that may come about still.
    quiet: Vec<(usize, usize)>,
    /// Whether saturation was told to end before its end.
    stopped: bool,
}

impl<'a> Reachability<'a> {
    /// All that is reachable.
    pub(super) fn run(domain: &'a Domain, resolved: &'a Resolved) -> Result<Self, RuleFaults> {
        Self::new(domain, resolved, &is_bounded).saturated().ok_or_else(too_many)
    }

    pub(super) fn new(
        domain: &'a Domain,
        resolved: &'a Resolved,
        may_go_on: &'a dyn Fn(usize) -> bool,
    ) -> Self {
        let mut changing = vec![false; domain.predicates.len()];
        for atom in domain.rules().flat_map(Schema::changes) {
            changing[atom.predicate.index()] = true;
        }
        let stands = |kinds: &KindSet, thing: usize| {
            kinds.is_empty() || domain.fits(&resolved.things[thing].kinds, kinds)
        };
        let may_stand: Vec<Vec<Vec<bool>>> = domain
            .rules()
            .map(|schema| {
                let one = |kinds| (0..resolved.things.len()).map(|t| stands(kinds, t)).collect();
                schema.parameters.iter().map(one).collect()
            })
            .collect();
        let candidates = may_stand
            .iter()
            .map(|parameters| {
                let chosen = |stands: &Vec<bool>| {
                    (0..stands.len() as u32).map(ThingId).filter(|t| stands[t.index()]).collect()
                };
                parameters.iter().map(chosen).collect()
            })
            .collect();
        let mut relations = Vec::new();
        relations.resize_with(domain.predicates.len(), Relation::default);
        Self {
            domain,
            resolved,
            changing,
            relations,
            candidates,
            may_stand,
            instances: Vec::new(),
            atoms: Vec::new(),
            numbers: HashMap::new(),
            may_go_on,
            joins: 0,
            objects: Objects::new(domain, resolved),
            waiting: Vec::new(),
            quiet: Vec::new(),
            stopped: false,
        }
    }

    /// None when it was told to stop.
    pub(super) fn saturated(mut self) -> Option<Self> {
        self.saturate();
        (!self.stopped && (self.may_go_on)(self.bytes())).then_some(self)
    }

    /// Memory that the task will take, near enough: an operator and its draft, an atom and its indexes.
    pub(super) fn bytes(&self) -> usize {
        self.instances.len() * 600 + self.atoms.len() * 400
    }

    fn saturate(&mut self) {
        for (atom, _) in &self.resolved.facts {
            self.reach(atom.clone());
        }
        // What never changes is known whole before the first join.
        for number in 0..self.atoms.len() {
            let atom = &self.atoms[number];
            if !self.changing[atom.predicate.index()] {
                self.relations[atom.predicate.index()].insert(&atom.args);
            }
        }
        let domain = self.domain;
        for (number, schema) in domain.rules().enumerate() {
            if !schema.preconditions.iter().any(|a| self.changing[a.predicate.index()]) {
                let binding = vec![None; schema.parameters.len()];
                let open: Vec<usize> = (0..schema.preconditions.len()).collect();
                self.join(number, binding, &open, None);
            }
        }
        let mut next = 0;
        loop {
            while next < self.atoms.len() && !self.stopped {
                self.ask(next);
                let atom = self.atoms[next].clone();
                next += 1;
                if self.changing[atom.predicate.index()] {
                    self.relations[atom.predicate.index()].insert(&atom.args);
                    self.trigger(&atom);
                }
            }
            self.retry();
            if self.stopped || next == self.atoms.len() {
                return;
            }
        }
    }

    /// Whether a literal may hold once: what does not change is known, what changes may be absent.
    fn may_hold(&self, atom: &GroundAtom, negated: bool) -> bool {
        match negated {
            true => self.changing[atom.predicate.index()] || !self.numbers.contains_key(atom),
            false => self.numbers.contains_key(atom),
        }
    }

    /// Asks again for the conditions that did not hold when the literals beside them were met.
    fn retry(&mut self) {
        let domain = self.domain;
        let mut grown = true;
        while grown && !self.stopped {
            self.joins += 1;
            self.ask(self.joins);
            let before = (self.atoms.len(), self.instances.len());
            for instance in std::mem::take(&mut self.waiting) {
                self.enter(instance);
            }
            for (number, effect) in std::mem::take(&mut self.quiet) {
                let Instance { schema, args } = &self.instances[number];
                let part = &domain.rule(*schema).conditional[effect];
                let added = self.may_come(part, args);
                added.into_iter().for_each(|atom| self.reach(atom));
                self.quiet.push((number, effect));
            }
            grown = before != (self.atoms.len(), self.instances.len());
        }
    }

    /// What an effect under a condition may add by now.
    fn may_come(&self, part: &ConditionalEffect, args: &[ThingId]) -> Vec<GroundAtom> {
        let holds = |atom: &GroundAtom, negated: bool| self.may_hold(atom, negated);
        let (mut added, mut binding) = (Vec::new(), args.to_vec());
        self.objects.each_choice(&part.variables, &mut binding, &mut |binding| {
            if self.objects.all_hold(&part.condition, binding, &holds) {
                added.extend(part.add_effects.iter().map(|a| self.objects.ground(a, binding)));
            }
            false
        });
        added
    }

    /// Now and then, whether to go on.
    fn ask(&mut self, count: usize) {
        if count.is_multiple_of(256) && !(self.may_go_on)(self.bytes()) {
            self.stopped = true;
        }
    }

    fn reach(&mut self, atom: GroundAtom) {
        if !self.numbers.contains_key(&atom) {
            self.numbers.insert(atom.clone(), self.atoms.len());
            self.atoms.push(atom);
        }
    }

    /// Joins a new fact with every precondition that it may satisfy.
    fn trigger(&mut self, atom: &GroundAtom) {
        let domain = self.domain;
        for (number, schema) in domain.rules().enumerate() {
            for (place, precondition) in schema.preconditions.iter().enumerate() {
                if precondition.predicate != atom.predicate {
                    continue;
                }
                let mut binding = vec![None; schema.parameters.len()];
                if !self.unify(number, &mut binding, precondition, &atom.args) {
                    continue;
                }
                let open: Vec<usize> =
                    (0..schema.preconditions.len()).filter(|&other| other != place).collect();
                self.join(number, binding, &open, Some((place, atom)));
            }
        }
    }

    pub(super) fn unify(
        &self,
        schema: usize,
        binding: &mut Binding,
        atom: &SchemaAtom,
        tuple: &[ThingId],
    ) -> bool {
        atom.args.iter().zip(tuple).all(|(term, &thing)| match term {
            SchemaTerm::Constant(name) => self.resolved.index[&name_key(name)] == thing,
            SchemaTerm::Parameter(parameter) => {
                let parameter = *parameter as usize;
                match binding[parameter] {
                    Some(bound) => bound == thing,
                    None => {
                        binding[parameter] = Some(thing);
                        self.may_stand[schema][parameter][thing.index()]
                    }
                }
            }
        })
    }

    pub(super) fn may_stand(&self, schema: usize, parameter: usize, thing: ThingId) -> bool {
        self.may_stand[schema][parameter][thing.index()]
    }

    /// Reached tuples of a predicate that have the given objects in their places.
    pub(super) fn matching<'b>(
        &'b self,
        predicate: PredicateId,
        args: &'b [Option<ThingId>],
    ) -> impl Iterator<Item = &'b [ThingId]> {
        let relation = &self.relations[predicate.index()];
        let with = |(place, arg): (usize, &Option<ThingId>)| {
            let thing = (*arg)?;
            Some(relation.by_arg.get(place)?.get(&thing).map_or(&[][..], Vec::as_slice))
        };
        let fewest = args.iter().enumerate().filter_map(with).min_by_key(|numbers| numbers.len());
        let numbers: Box<dyn Iterator<Item = u32> + 'b> = match fewest {
            Some(numbers) => Box::new(numbers.iter().copied()),
            None => Box::new(0..relation.tuples.len() as u32),
        };
        numbers.map(|number| relation.tuples[number as usize].as_slice()).filter(move |tuple| {
            tuple.iter().zip(args).all(|(have, want)| want.is_none_or(|want| want == *have))
        })
    }

    pub(super) fn value(&self, binding: &Binding, term: &SchemaTerm) -> Option<ThingId> {
        match term {
            SchemaTerm::Constant(name) => Some(self.resolved.index[&name_key(name)]),
            SchemaTerm::Parameter(parameter) => binding[*parameter as usize],
        }
    }

    /// Satisfies the open preconditions one by one, the most constrained first.
    fn join(
        &mut self,
        schema: usize,
        binding: Binding,
        open: &[usize],
        trigger: Option<(usize, &GroundAtom)>,
    ) {
        let domain = self.domain;
        let rule: &Schema = domain.rule(schema);
        self.joins += 1;
        self.ask(self.joins);
        if self.stopped || !self.comparisons_hold(rule, &binding) {
            return;
        }
        let Some((at, tuples)) = self.most_constrained(rule, &binding, open) else {
            self.choose_rest(schema, binding);
            return;
        };
        let rest: Vec<usize> = open.iter().copied().filter(|&other| other != at).collect();
        let precondition = &rule.preconditions[at];
        for tuple in tuples {
            let tuple =
                self.relations[precondition.predicate.index()].tuples[tuple as usize].clone();
            // The new fact itself serves only the first place that it can: no instance comes twice.
            if let Some((place, atom)) = trigger
                && at < place
                && atom.predicate == precondition.predicate
                && atom.args == tuple
            {
                continue;
            }
            let mut binding = binding.clone();
            if self.unify(schema, &mut binding, precondition, &tuple) {
                self.join(schema, binding, &rest, trigger);
            }
        }
    }

    fn most_constrained(
        &self,
        rule: &Schema,
        binding: &Binding,
        open: &[usize],
    ) -> Option<(usize, Vec<u32>)> {
        let mut best: Option<(usize, usize, Option<&[u32]>)> = None;
        for &at in open {
            let atom = &rule.preconditions[at];
            let relation = &self.relations[atom.predicate.index()];
            let values: Vec<Option<ThingId>> =
                atom.args.iter().map(|term| self.value(binding, term)).collect();
            if values.iter().all(Option::is_some) {
                let tuple: Vec<ThingId> = values.into_iter().flatten().collect();
                return Some((at, relation.numbers.get(&tuple).copied().into_iter().collect()));
            }
            let mut fewest = (relation.tuples.len(), None);
            for (place, value) in values.iter().enumerate() {
                let Some(thing) = value else { continue };
                let numbers: &[u32] = relation
                    .by_arg
                    .get(place)
                    .and_then(|i| i.get(thing))
                    .map_or(&[], Vec::as_slice);
                if numbers.len() < fewest.0 {
                    fewest = (numbers.len(), Some(numbers));
                }
            }
            if best.is_none_or(|(_, count, _)| fewest.0 < count) {
                best = Some((at, fewest.0, fewest.1));
            }
        }
        best.map(|(at, count, numbers)| {
            (at, numbers.map_or_else(|| (0..count as u32).collect(), <[u32]>::to_vec))
        })
    }

    /// Parameters that no precondition binds range over the objects of their types.
    fn choose_rest(&mut self, schema: usize, binding: Binding) {
        let domain = self.domain;
        let Some(free) = binding.iter().position(Option::is_none) else {
            let args: Vec<ThingId> = binding.into_iter().flatten().collect();
            self.emit(schema, args);
            return;
        };
        for choice in 0..self.candidates[schema][free].len() {
            let mut binding = binding.clone();
            binding[free] = Some(self.candidates[schema][free][choice]);
            if !self.stopped && self.comparisons_hold(domain.rule(schema), &binding) {
                self.choose_rest(schema, binding);
            }
        }
    }

    pub(super) fn comparisons_hold(&self, rule: &Schema, binding: &Binding) -> bool {
        let compare = |pairs: &[(SchemaTerm, SchemaTerm)], equal: bool| {
            pairs.iter().all(|(left, right)| {
                match (self.value(binding, left), self.value(binding, right)) {
                    (Some(left), Some(right)) => (left == right) == equal,
                    _ => true,
                }
            })
        };
        compare(&rule.equal, true) && compare(&rule.different, false)
    }

    fn emit(&mut self, schema: usize, args: Vec<ThingId>) {
        let domain = self.domain;
        let rule = domain.rule(schema);
        let denied = rule.negative_preconditions.iter().any(|atom| {
            !self.changing[atom.predicate.index()]
                && self.numbers.contains_key(&self.instantiate(atom, &args))
        });
        if denied {
            return;
        }
        self.ask(self.instances.len());
        self.enter(Instance { schema, args });
    }

    /// An instance whose literals are met: as one more action, or to be asked for again.
    fn enter(&mut self, instance: Instance) {
        let rule = self.domain.rule(instance.schema);
        let holds = |atom: &GroundAtom, negated: bool| self.may_hold(atom, negated);
        if !self.objects.all_hold(&rule.formulas, &mut instance.args.clone(), &holds) {
            self.waiting.push(instance);
            return;
        }
        for atom in &rule.add_effects {
            let atom = self.instantiate(atom, &instance.args);
            self.reach(atom);
        }
        let effects = 0..rule.conditional.len();
        self.quiet.extend(effects.map(|effect| (self.instances.len(), effect)));
        self.instances.push(instance);
    }

    pub(super) fn instantiate(&self, atom: &SchemaAtom, args: &[ThingId]) -> GroundAtom {
        self.objects.ground(atom, args)
    }
}
