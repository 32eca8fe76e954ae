//! The search for what is lacking: from a goal that is out of reach backward to facts that nobody stated.
//!
//! An action that would give what is missing misses preconditions of its own; so a graph arises of facts that are
//! missing and of actions between them. Objects are chosen as far as something ties them to those already chosen: the
//! door that stands between these two rooms, locked, the thing that bars it, rather than any door and any thing.
//! Where nothing does, the place stays open: no key at all fits this door.
//!
//! Every fact of the graph could be stated instead of brought about, at a price that says how far-fetched that is.
//! The cheapest way to the goal is found after D. E. Knuth (1977); the price of a way counts every statement once,
//! as E. Keyder and H. Geffner (2008) count actions.

use std::cmp::Reverse;
use std::collections::{BTreeSet, BinaryHeap, HashMap};

use super::attain::Attainable;
use super::domain::{Domain, KindId, KindSet, PredicateId, Schema, SchemaAtom, SchemaTerm};
use super::exchange::{exchanged, moving, states};
use super::reachability::{Binding, Reachability};
use super::resolve::{GroundAtom, Resolved, ThingId};
use super::wanted::Wanted;
use crate::units::Gather as _;

/// An action, with the types that its parameters are to have.
struct Rule<'a> {
    number: usize,
    schema: &'a Schema,
    kinds: Vec<KindSet>,
    /// The fact that it is to give.
    gives: usize,
}

/// An action that would give `gives`, were it not for what it misses.
#[derive(Debug)]
pub(super) struct Way {
    pub(super) schema: usize,
    pub(super) gives: usize,
    pub(super) missing: Vec<usize>,
    /// Whether the robot would have to stand where nobody stated that there is a place.
    pub(super) is_far_fetched: bool,
}

/// The cheapest way to have a fact: what must be stated, and the actions on the way.
#[derive(Debug, Clone, Default)]
struct Label {
    stated: BTreeSet<usize>,
    ways: BTreeSet<usize>,
}

type Labels = Vec<Option<(Label, By)>>;

/// How a missing fact would come about.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum By {
    Statement,
    Way(usize),
}

/// Nobody reads an explanation that took longer to find.
const MOST_FACTS: usize = 3_000;
const MOST_WAYS: usize = 300;
/// What a far-fetched way costs beside its statements.
const FAR_FETCHED: u32 = 100;
/// An action that lacks more than this is not what is meant.
const MOST_MISSING: usize = 5;
/// Objects that nothing ties are chosen where so few would do.
const MOST_FREE: usize = 3;
/// So many ways are gone through once more to find a statement that serves several of them.
const MOST_TRIED: usize = 200_000;

pub(super) struct Lacks<'a> {
    pub(super) domain: &'a Domain,
    pub(super) resolved: &'a Resolved,
    pub(super) reached: &'a Reachability<'a>,
    pub(super) attainable: &'a Attainable<'a>,
    /// What holds at first, by predicate.
    initial: Vec<Vec<&'a GroundAtom>>,
    /// Predicates that actions exchange for each other over the same objects, as a door's being open and shut.
    states: Vec<usize>,
    /// For each place of each predicate a number: two have one where actions exchange facts about the object there,
    /// as a thing lies on a table, is held and lies on the floor.
    exchanged: Vec<Vec<usize>>,
    /// Predicates whose facts give way to each other, as those of where the robot is.
    moving: Vec<bool>,
    pub(super) facts: Vec<Wanted>,
    index: HashMap<Wanted, usize>,
    pub(super) ways: Vec<Way>,
    labels: Labels,
}

impl<'a> Lacks<'a> {
    pub(super) fn new(
        domain: &'a Domain,
        resolved: &'a Resolved,
        reached: &'a Reachability<'a>,
        attainable: &'a Attainable<'a>,
        goal: Wanted,
    ) -> Self {
        let states = states(domain);
        let mut initial: Vec<Vec<&GroundAtom>> = vec![Vec::new(); domain.predicates.len()];
        for (atom, _) in &resolved.facts {
            initial[atom.predicate.index()].push(atom);
        }
        let mut lacks = Self {
            domain,
            resolved,
            reached,
            attainable,
            initial,
            states,
            exchanged: exchanged(domain),
            moving: moving(domain),
            facts: vec![goal.clone()],
            index: HashMap::from([(goal, 0)]),
            ways: Vec::new(),
            labels: Vec::new(),
        };
        let mut next = 0;
        while next < lacks.facts.len() && lacks.facts.len() < MOST_FACTS {
            lacks.expand(next);
            next += 1;
        }
        lacks.weigh();
        lacks
    }

    /// How the fact would best come about; none when it cannot.
    pub(super) fn best(&self, fact: usize) -> Option<By> {
        self.labels[fact].as_ref().map(|&(_, by)| by)
    }

    /// What must be stated for the fact to come about.
    pub(super) fn stated(&self, fact: usize) -> impl Iterator<Item = usize> {
        self.labels[fact].iter().flat_map(|(label, _)| label.stated.iter().copied())
    }

    /// Whether the best way to `fact` leads through `other`.
    pub(super) fn leads_through(&self, fact: usize, other: usize) -> bool {
        self.labels[fact]
            .as_ref()
            .is_some_and(|(label, _)| label.ways.iter().any(|&way| self.ways[way].gives == other))
    }

    /// Whether it is one of those of which another gives way to it, as where the robot is: from where else it came says nothing.
    pub(super) fn is_moving(&self, fact: usize) -> bool {
        let wanted = &self.facts[fact];
        !wanted.negated && self.moving[wanted.predicate.index()]
    }

    pub(super) fn ways_to(&self, fact: usize) -> impl Iterator<Item = usize> {
        (0..self.ways.len()).filter(move |&way| self.ways[way].gives == fact)
    }

    // The graph.

    fn expand(&mut self, fact: usize) {
        let wanted = self.facts[fact].clone();
        let domain = self.domain;
        for (number, schema) in domain.schemas.iter().enumerate() {
            let effects = if wanted.negated { &schema.del_effects } else { &schema.add_effects };
            for effect in effects.iter().filter(|effect| effect.predicate == wanted.predicate) {
                let Some(binding) = self.bound(number, &effect.args, &wanted.args) else {
                    continue;
                };
                let Some(kinds) = self.narrowed(schema, effect, &wanted) else { continue };
                let rule = Rule { number, schema, kinds, gives: fact };
                let open: Vec<usize> = (0..schema.preconditions.len()).collect();
                let mut found = Vec::new();
                self.complete(&rule, &binding, &open, Vec::new(), &mut found);
                for (missing, is_far_fetched) in found {
                    let missing = missing.into_iter().map(|wanted| self.number(wanted)).collect();
                    let way = Way { schema: number, gives: fact, missing, is_far_fetched };
                    if !way.missing.contains(&fact) {
                        self.ways.push(way);
                    }
                }
            }
        }
    }

    fn number(&mut self, wanted: Wanted) -> usize {
        let next = self.facts.len();
        let number = *self.index.entry(wanted.clone()).or_insert(next);
        if number == next {
            self.facts.push(wanted);
        }
        number
    }

    /// The action's parameters where its effect is what is wanted.
    pub(super) fn bound(
        &self,
        schema: usize,
        terms: &[SchemaTerm],
        args: &[Option<ThingId>],
    ) -> Option<Binding> {
        let mut binding: Binding = vec![None; self.domain.schemas[schema].parameters.len()];
        for (term, arg) in terms.iter().zip(args) {
            let Some(thing) = *arg else { continue };
            match term {
                SchemaTerm::Constant(_) if self.reached.value(&binding, term) == Some(thing) => {}
                SchemaTerm::Constant(_) => return None,
                SchemaTerm::Parameter(parameter) => {
                    let place = &mut binding[*parameter as usize];
                    let fits = place.is_none_or(|bound| bound == thing);
                    if !fits || !self.reached.may_stand(schema, *parameter as usize, thing) {
                        return None;
                    }
                    *place = Some(thing);
                }
            }
        }
        Some(binding)
    }

    /// The types of an action's parameters where its effect is what is wanted; none where no object is of the types
    /// that both ask for.
    fn narrowed(
        &self,
        schema: &Schema,
        effect: &SchemaAtom,
        wanted: &Wanted,
    ) -> Option<Vec<KindSet>> {
        let mut kinds = schema.parameters.clone();
        let open = effect.args.iter().zip(&wanted.kinds).filter(|(_, asked)| !asked.is_empty());
        for (term, asked) in open {
            match term {
                SchemaTerm::Constant(_) => {
                    let constant = self.reached.value(&Vec::new(), term)?;
                    let have = &self.resolved.things[constant.index()].kinds;
                    self.domain.fits(have, asked).then_some(())?;
                }
                SchemaTerm::Parameter(parameter) => {
                    let own = &mut kinds[*parameter as usize];
                    *own = self.common(own, asked)?;
                }
            }
        }
        Some(kinds)
    }

    /// The types that both sets ask for; an empty one asks for nothing.
    fn common(&self, a: &KindSet, b: &KindSet) -> Option<KindSet> {
        if a.is_empty() || b.is_empty() {
            return Some(if a.is_empty() { b.clone() } else { a.clone() });
        }
        let within = |kind: &KindId, of: &KindSet| self.domain.fits(&[*kind], of);
        let mut both: KindSet = a.iter().copied().filter(|kind| within(kind, b)).collect();
        both.extend(b.iter().copied().filter(|kind| within(kind, a)));
        both.sort_unstable();
        both.dedup();
        (!both.is_empty()).then_some(both)
    }

    /// Chooses the objects that are still open, precondition by precondition, the most closely tied first; what no
    /// object satisfies is missing.
    fn complete(
        &self,
        of: &Rule<'_>,
        binding: &Binding,
        open: &[usize],
        missing: Vec<Wanted>,
        found: &mut Vec<(Vec<Wanted>, bool)>,
    ) {
        let rule = of.schema;
        let too_many = found.len() >= MOST_WAYS || missing.len() > MOST_MISSING;
        if too_many || !self.reached.comparisons_hold(rule, binding) {
            return;
        }
        let tied = open.iter().copied().filter_map(|at| {
            let wanted = self.wanted(of, &rule.preconditions[at], binding);
            let bound = wanted.args.iter().flatten().count();
            if bound == wanted.args.len() {
                return Some((0, at, wanted));
            }
            // What changes may be otherwise by then; the world's make is as it is.
            let changes = self.reached.changing[wanted.predicate.index()];
            let count = self.holding(&wanted).take(MOST_WAYS).count();
            // Of few the right one is among them, though nothing ties it: the only tap.
            let is_free = bound == 0;
            if is_free && (changes || count == 0 || count > MOST_FREE) {
                return None;
            }
            let last = usize::from(changes) + 2 * usize::from(is_free);
            Some((1 + count + last * MOST_WAYS, at, wanted))
        });
        let Some((_, at, wanted)) = tied.min_by_key(|&(count, at, _)| (count, at)) else {
            found.extend(self.finished(of, binding, open, missing));
            return;
        };
        let rest: Vec<usize> = open.iter().copied().filter(|&other| other != at).collect();
        let atom = &rule.preconditions[at];
        let chosen = |tuple: &[ThingId]| {
            let mut chosen = binding.clone();
            let is_new = |(at, thing): (usize, &Option<ThingId>)| match (binding[at], thing) {
                (None, Some(thing)) => self.is_of(*thing, &of.kinds[at]),
                _ => true,
            };
            let unifies = self.reached.unify(of.number, &mut chosen, atom, tuple);
            (unifies && chosen.iter().enumerate().all(is_new)).then_some(chosen)
        };
        let mut is_chosen = false;
        for binding in self.holding(&wanted).filter_map(chosen) {
            is_chosen = true;
            self.complete(of, &binding, &rest, missing.clone(), found);
        }
        for binding in self.otherwise(&wanted).filter_map(|atom| chosen(&atom.args)) {
            let now_wanted = self.wanted(of, atom, &binding);
            if now_wanted.closed().is_some_and(|atom| !self.attainable.holds(&atom)) {
                is_chosen = true;
                let missing = with(missing.clone(), now_wanted);
                self.complete(of, &binding, &rest, missing, found);
            }
        }
        // What was withdrawn would be true but for that.
        let gone = self.resolved.withdrawn.iter().filter(|gone| gone.predicate == wanted.predicate);
        for binding in
            gone.filter(|gone| fits(&gone.args, &wanted.args)).filter_map(|gone| chosen(&gone.args))
        {
            is_chosen = true;
            let missing = with(missing.clone(), self.wanted(of, atom, &binding));
            self.complete(of, &binding, &rest, missing, found);
        }
        for args in self.elsewhere(&wanted) {
            if let Some(binding) = chosen(&args) {
                let missing = with(missing.clone(), self.wanted(of, atom, &binding));
                self.complete(of, &binding, &rest, missing, found);
            }
        }
        if !is_chosen {
            let missing = with(missing, wanted);
            self.complete(of, binding, &rest, missing, found);
        }
    }

    /// What is missing once nothing ties further objects, and whether it is far-fetched: preconditions of which
    /// nothing is chosen count only where no object at all satisfies them and nothing else that is missing is open.
    fn finished(
        &self,
        of: &Rule<'_>,
        binding: &Binding,
        open: &[usize],
        mut missing: Vec<Wanted>,
    ) -> Option<(Vec<Wanted>, bool)> {
        let rule = of.schema;
        let is_open = |wanted: &Wanted| wanted.args.iter().any(Option::is_none);
        let mut is_far_fetched = false;
        if missing.iter().any(is_open) {
            let is_static = |atom: &&SchemaAtom| !self.reached.changing[atom.predicate.index()];
            let lacking = (0..rule.preconditions.len()).filter(|at| !open.contains(at));
            let lacking = lacking.map(|at| &rule.preconditions[at]).filter(is_static);
            let places: Vec<&SchemaTerm> = lacking
                .flat_map(|atom| &atom.args)
                .filter(|term| self.reached.value(binding, term).is_none())
                .collect();
            is_far_fetched = open.iter().map(|&at| &rule.preconditions[at]).any(|atom| {
                self.moving[atom.predicate.index()]
                    && atom.args.iter().any(|term| places.contains(&term))
            });
            // A thing put back frees the hand that was to be free to take it.
            let round = open.iter().map(|&at| self.wanted(of, &rule.preconditions[at], binding));
            missing.extend(round.filter(|wanted| self.comes_round(wanted, of.gives)));
        } else {
            for &at in open {
                let wanted = self.wanted(of, &rule.preconditions[at], binding);
                if self.holding(&wanted).next().is_none() {
                    missing.push(wanted);
                }
            }
        }
        for atom in &rule.negative_preconditions {
            let wanted = Wanted { negated: true, ..self.wanted(of, atom, binding) };
            if wanted.closed().is_some_and(|atom| !self.attainable.may_be_absent(&atom)) {
                missing.push(wanted);
            }
        }
        (!missing.is_empty()).then_some((missing, is_far_fetched))
    }

    /// Whether no object is known of which something holds, and every action that would bring it about for one needs `fact`
    /// first.
    fn comes_round(&self, wanted: &Wanted, fact: usize) -> bool {
        let needed = &self.facts[fact];
        if needed.closed().is_none() || needed.negated || self.holding(wanted).next().is_some() {
            return false;
        }
        let schemas = self.domain.schemas.iter().enumerate();
        let givers = schemas.flat_map(|(number, schema)| {
            let adds = schema.add_effects.iter().filter(|add| add.predicate == wanted.predicate);
            let bindings = adds.filter_map(move |add| self.bound(number, &add.args, &wanted.args));
            bindings.map(move |binding| (schema, binding))
        });
        let mut needs_it = givers.map(|(schema, binding)| {
            let mut needs = schema.preconditions.iter().map(|atom| self.under(atom, &binding));
            needs.any(|need| need.predicate == needed.predicate && need.args == needed.args)
        });
        needs_it.next().is_some_and(|first| first && needs_it.all(|needs| needs))
    }

    fn under(&self, atom: &SchemaAtom, binding: &Binding) -> Wanted {
        let args: Vec<Option<ThingId>> =
            atom.args.iter().map(|term| self.reached.value(binding, term)).collect();
        Wanted::of(atom.predicate, args)
    }

    /// As [`Self::under`], with the types of what is still open.
    fn wanted(&self, of: &Rule<'_>, atom: &SchemaAtom, binding: &Binding) -> Wanted {
        let mut wanted = self.under(atom, binding);
        let signature = &self.domain.predicates[atom.predicate.index()].args;
        for (place, term) in atom.args.iter().enumerate() {
            let SchemaTerm::Parameter(parameter) = term else { continue };
            if wanted.args[place].is_some() {
                continue;
            }
            let (own, taken) = (&of.kinds[*parameter as usize], &signature[place]);
            let is_wider = own.is_empty()
                || !taken.is_empty() && taken.iter().all(|&kind| self.domain.fits(&[kind], own));
            if !is_wider {
                wanted.kinds[place].clone_from(own);
            }
        }
        wanted
    }

    fn is_of(&self, thing: ThingId, kinds: &KindSet) -> bool {
        kinds.is_empty() || self.domain.fits(&self.resolved.things[thing.index()].kinds, kinds)
    }

    /// Whether things stand in the places that are open and of the types that are asked for there.
    fn are_of(&self, things: &[ThingId], wanted: &Wanted) -> bool {
        things.iter().zip(&wanted.kinds).all(|(&thing, kinds)| self.is_of(thing, kinds))
    }

    fn holding<'b>(&'b self, wanted: &'b Wanted) -> impl Iterator<Item = &'b [ThingId]> {
        self.reached.matching(wanted.predicate, &wanted.args).filter(|tuple| {
            let atom = GroundAtom { predicate: wanted.predicate, args: tuple.to_vec() };
            self.are_of(tuple, wanted) && self.attainable.holds(&atom)
        })
    }

    /// Initial facts that say of such objects what excludes the wanted: the door is locked.
    fn otherwise(&self, wanted: &Wanted) -> impl Iterator<Item = &'a GroundAtom> {
        let own = wanted.predicate.index();
        let others = (0..self.states.len())
            .filter(move |&other| other != own && self.states[other] == self.states[own]);
        let facts = others.flat_map(move |other| self.initial[other].iter().copied());
        facts.filter(move |atom| fits(&atom.args, &wanted.args))
    }

    /// Where else what moves could be, as far as the world's make tells: the lift stands at one door and could stand at
    /// each of its doors.
    fn elsewhere(&self, wanted: &Wanted) -> Vec<Vec<ThingId>> {
        let is_partly_open = wanted.args.iter().any(Option::is_none);
        if !self.moving[wanted.predicate.index()] || !is_partly_open {
            return Vec::new();
        }
        let mut found: Vec<Vec<ThingId>> = Vec::new();
        for (number, schema) in self.domain.schemas.iter().enumerate() {
            for add in schema.add_effects.iter().filter(|add| add.predicate == wanted.predicate) {
                let Some(binding) = self.bound(number, &add.args, &wanted.args) else { continue };
                let of_add = |atom: &&SchemaAtom| {
                    !self.reached.changing[atom.predicate.index()]
                        && atom.args.iter().all(|term| add.args.contains(term))
                };
                for fixed in schema.preconditions.iter().filter(of_add) {
                    let within = self.under(fixed, &binding);
                    for tuple in self.holding(&within).take(MOST_WAYS) {
                        let mut binding = binding.clone();
                        let fits = self.reached.unify(number, &mut binding, fixed, tuple);
                        let args: Option<Vec<ThingId>> =
                            self.under(add, &binding).args.into_iter().collect();
                        found.extend(args.filter(|args| {
                            let atom =
                                GroundAtom { predicate: wanted.predicate, args: args.clone() };
                            fits && !found.contains(args) && !self.attainable.holds(&atom)
                        }));
                    }
                }
            }
        }
        found
    }

    // The prices.

    /// The cheapest way to each fact. A way that one statement serves twice over may cost less than the cheapest of its
    /// parts: so each statement is tried as if it had been made already.
    fn weigh(&mut self) {
        let prices: Vec<Option<u32>> = (0..self.facts.len()).map(|fact| self.price(fact)).collect();
        let mut best = self.weighed(&prices);
        let several = |(_, labels): &(u32, Labels)| {
            labels[0].as_ref().is_some_and(|(label, _)| label.stated.len() > 1)
        };
        if several(&best) {
            let tried: Vec<usize> = (0..prices.len()).filter(|&f| prices[f].is_some()).collect();
            for &stated in tried.iter().take(MOST_TRIED / self.ways.len().max(1)) {
                let mut prices = prices.clone();
                let own = prices[stated].replace(0).unwrap_or_default();
                let (cost, labels) = self.weighed(&prices);
                if cost.saturating_add(own) < best.0 {
                    best = (cost + own, labels);
                }
            }
        }
        self.labels = best.1;
    }

    /// What the goal costs at these prices, and the cheapest way to each fact.
    fn weighed(&self, prices: &[Option<u32>]) -> (u32, Labels) {
        let mut users: Vec<Vec<usize>> = vec![Vec::new(); self.facts.len()];
        let mut open: Vec<usize> = Vec::new();
        for (number, way) in self.ways.iter().enumerate() {
            let distinct: BTreeSet<usize> = way.missing.iter().copied().gather();
            open.push(distinct.len());
            distinct.into_iter().for_each(|fact| users[fact].push(number));
        }
        let mut labels: Labels = vec![None; self.facts.len()];
        let cost = |label: &Label| {
            let stated: u32 = label.stated.iter().filter_map(|&fact| prices[fact]).sum();
            let far = label.ways.iter().filter(|&&way| self.ways[way].is_far_fetched).count();
            stated + label.ways.len() as u32 + FAR_FETCHED * far as u32
        };
        // What was met first is preferred among equals: the order of the rule file.
        let mut queue = BinaryHeap::new();
        for (fact, price) in prices.iter().enumerate() {
            queue.extend(price.map(|price| Reverse((price, fact, None))));
        }
        while let Some(Reverse((_, fact, way))) = queue.pop() {
            if labels[fact].is_some() {
                continue;
            }
            let label = match way {
                None => Label { stated: BTreeSet::from([fact]), ways: BTreeSet::new() },
                Some(way) => self.label(&labels, way),
            };
            labels[fact] = Some((label, way.map_or(By::Statement, By::Way)));
            for &user in &users[fact] {
                open[user] -= 1;
                if open[user] == 0 {
                    queue.push(Reverse((
                        cost(&self.label(&labels, user)),
                        self.ways[user].gives,
                        Some(user),
                    )));
                }
            }
        }
        let whole = labels[0].as_ref().map_or(u32::MAX, |(label, _)| cost(label));
        (whole, labels)
    }

    fn label(&self, labels: &Labels, way: usize) -> Label {
        let mut label = Label { stated: BTreeSet::new(), ways: BTreeSet::from([way]) };
        for &fact in &self.ways[way].missing {
            let (below, _) = labels[fact].as_ref().expect("a way is weighed after its facts");
            label.stated.extend(&below.stated);
            label.ways.extend(&below.ways);
        }
        label
    }

    /// How far-fetched it is that the fact should simply have been stated; none where it is absurd.
    ///
    /// The world's make is stated and never brought about. Of what actions change, that is likely stated of which
    /// nothing is known, as of doors that lead to a room; what is now otherwise, stands elsewhere or is only ever
    /// attained is not. A fact that speaks of known objects is nearer than one of any object.
    fn price(&self, number: usize) -> Option<u32> {
        let wanted = &self.facts[number];
        // What was just withdrawn is the first thing to come to mind.
        if number != 0
            && wanted.closed().is_some_and(|atom| self.resolved.withdrawn.contains(&atom))
        {
            return Some(1);
        }
        let open = wanted.args.iter().filter(|arg| arg.is_none()).count();
        let is_unspoken = !wanted.negated && self.initial[wanted.predicate.index()].is_empty();
        let makes = match (self.reached.changing[wanted.predicate.index()], wanted.negated) {
            _ if number == 0 => return None,
            // Of these very objects the world's make is known: this lift has other doors.
            (false, false) if !is_unspoken && (open == 0 || self.is_known_of_all(wanted)) => 150,
            (false, false) => 10,
            (false, true) => 140,
            (true, true) => 160,
            (true, false) if self.is_otherwise(wanted) => return None,
            (true, false) if open == wanted.args.len() && open > 0 => 300,
            (true, false) if self.is_only_attained(wanted.predicate) => 200,
            (true, false) if open == 0 && self.ways_to(number).next().is_some() => {
                let place = wanted.predicate;
                let is_unknown = wanted.args.is_empty()
                    || self.moving[place.index()] && !self.is_attained_of_any(place);
                if is_unknown { 30 } else { 170 }
            }
            (true, false) => 30,
        };
        Some(makes + 10 * open as u32 + 80 * u32::from(is_unspoken))
    }

    /// Whether of every object that could stand in an open place such facts are stated: each lift has its doors.
    fn is_known_of_all(&self, wanted: &Wanted) -> bool {
        let taken = &self.domain.predicates[wanted.predicate.index()].args;
        let facts = &self.initial[wanted.predicate.index()];
        let is_known = |place: usize| {
            let asked = &wanted.kinds[place];
            let kinds = if asked.is_empty() { &taken[place] } else { asked };
            let all = (0..self.resolved.things.len() as u32).map(ThingId);
            let mut fitting = all.filter(|&thing| !kinds.is_empty() && self.is_of(thing, kinds));
            let is_stated = |thing| facts.iter().any(|atom| atom.args[place] == thing);
            fitting.next().is_some_and(|first| is_stated(first) && fitting.all(is_stated))
        };
        (0..wanted.args.len()).any(|place| wanted.args[place].is_none() && is_known(place))
    }

    fn is_attained_of_any(&self, predicate: PredicateId) -> bool {
        let args = vec![None; self.domain.predicates[predicate.index()].args.len()];
        self.holding(&Wanted::of(predicate, args)).next().is_some()
    }

    /// Whether the initial facts say something that excludes the wanted.
    fn is_otherwise(&self, wanted: &Wanted) -> bool {
        let stands_elsewhere = || {
            self.domain.schemas.iter().enumerate().any(|(number, schema)| {
                let adds = schema.add_effects.iter().filter(|a| a.predicate == wanted.predicate);
                adds.filter_map(|add| self.bound(number, &add.args, &wanted.args)).any(|binding| {
                    let gone = schema.del_effects.iter().map(|atom| self.under(atom, &binding));
                    gone.into_iter().any(|gone| {
                        let is_moved = gone.predicate == wanted.predicate;
                        let is_about = gone.args.iter().any(Option::is_some);
                        let is_so = |predicate: PredicateId, args: &[Option<ThingId>]| {
                            self.initial[predicate.index()].iter().any(|a| fits(&a.args, args))
                        };
                        (is_moved || is_about) && is_so(gone.predicate, &gone.args)
                    })
                })
            })
        };
        self.otherwise(wanted).next().is_some() || self.is_exchanged(wanted) || stands_elsewhere()
    }

    /// Whether an initial fact holds of one of the objects until the wanted takes its place.
    fn is_exchanged(&self, wanted: &Wanted) -> bool {
        let places = &self.exchanged[wanted.predicate.index()];
        let said = |(&object, state): (&Option<ThingId>, &usize)| {
            let others = (0..self.exchanged.len()).filter(|&other| {
                other != wanted.predicate.index() && self.exchanged[other].contains(state)
            });
            let mut facts = others.flat_map(|other| &self.initial[other]);
            facts.any(|atom| {
                let places = &self.exchanged[atom.predicate.index()];
                atom.args.iter().zip(places).any(|(&arg, own)| own == state && Some(arg) == object)
            })
        };
        wanted.args.iter().zip(places).any(said)
    }

    /// Whether the facts of a predicate are neither stated nor ever taken away: what was searched, who was called.
    fn is_only_attained(&self, predicate: PredicateId) -> bool {
        let schemas = &self.domain.schemas;
        let deleted = schemas.iter().flat_map(|schema| &schema.del_effects);
        !deleted.into_iter().any(|atom| atom.predicate == predicate)
            && self.initial[predicate.index()].is_empty()
    }
}

fn with(mut missing: Vec<Wanted>, wanted: Wanted) -> Vec<Wanted> {
    if !missing.contains(&wanted) {
        missing.push(wanted);
    }
    missing
}

pub(super) fn fits(have: &[ThingId], wanted: &[Option<ThingId>]) -> bool {
    have.iter().zip(wanted).all(|(have, want)| want.is_none_or(|want| want == *have))
}
