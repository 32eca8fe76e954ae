//! Scenarios that are driven: a rule file's goal, planned by the file's own rules and carried out as a task in words is.
//!
//! **Invariant.** What a scenario states is what the robot believes, or it is refused at its place: a plan on facts that
//! the map does not have would be driven into nothing.

use std::collections::{BTreeMap, BTreeSet};

use crate::map::{Entity, World};
use crate::robot::{Belief, GoalFact, Station, Vehicle};
use crate::semantics::planning::InitialFact;
use crate::semantics::predicate;
use crate::strips::{RuleError, RuleFault, RuleFaults, Scenario};
use crate::units::{Bilingual, ReplicaId, Stop, name_key, said};

use super::task::{Errand, Progress, TaskAnswer};
use super::{Error, State};

/// The predicates of which a primitive of the robot, or where it stands after one, makes a fact true.
const DRIVEN: [&str; 20] = [
    predicate::STANDS_OPEN,
    predicate::STANDS_SHUT,
    predicate::ROBOT_IN,
    predicate::ROBOT_AT_DOOR,
    predicate::ROBOT_AT_PLACE,
    predicate::ROBOT_ON_STOREY,
    predicate::ROBOT_HOLDS,
    predicate::HAND_FREE,
    predicate::DOOR_OPEN,
    predicate::DOOR_CLOSED,
    predicate::DOOR_LOCKED,
    predicate::THING_ON,
    predicate::THING_AT_PLACE,
    predicate::HANDED_OVER,
    predicate::DEVICE_ON,
    predicate::DEVICE_OFF,
    predicate::ROOM_LIT,
    predicate::ROOM_INSPECTED,
    predicate::FOUND,
    predicate::CALLED,
];

impl State {
    /// Plans a scenario from what the robot believes, and has a vehicle drive it, as [`State::carry_out_with`] does.
    ///
    /// # Errors
    /// What of the scenario cannot be driven, all of it at once: facts that the map does not give, goals that no primitive of
    /// the robot brings about. That there is no plan, and that the vehicle fails, is an answer.
    pub fn drive_scenario(
        &self,
        scenario: &Scenario,
        vehicle: &mut dyn Vehicle,
        tell: &mut dyn FnMut(&Progress<'_>),
        stop: &Stop,
    ) -> Result<TaskAnswer, Error> {
        let begun = self.at(std::time::SystemTime::now().into())?;
        begun.piloted(vehicle, |vehicle| match vehicle {
            Ok(vehicle) => match begun.stood_by(vehicle) {
                Ok(begun) => begun.drive_scenario_placed(scenario, vehicle, tell, stop),
                Err(failure) => begun.not_begun(failure),
            },
            Err(failure) => begun.not_begun(failure),
        })?
    }

    fn drive_scenario_placed(
        &self,
        scenario: &Scenario,
        vehicle: &mut dyn Vehicle,
        tell: &mut dyn FnMut(&Progress<'_>),
        stop: &Stop,
    ) -> Result<TaskAnswer, Error> {
        let (mut belief, _) = self.belief_of()?;
        let followed = self.followed_with(&belief)?;
        let relations = followed.relations();
        let wanted = scenario.problem.stated_goals().filter_map(|wanted| {
            let is_search = name_key(wanted.predicate()) == name_key(predicate::FOUND);
            thing(self.world().ok()?, wanted.args().first().filter(|_| is_search)?)
        });
        if let Err(failure) = self.seek(wanted, relations, &mut belief, vehicle)? {
            return self.not_begun(failure);
        }
        keep_homes(scenario, &mut belief);
        let believed = belief.facts(relations);
        let mut scenario = scenario.clone();
        self.surveyed()?.call_in_english(&mut scenario.problem, &believed);
        let known = Known::of(believed);
        let mut faults: Vec<RuleFault> = scenario
            .problem
            .stated_facts()
            .filter(|fact| known.has(fact.predicate(), fact.args()) == fact.is_negated())
            .map(|fact| {
                let help = known.instead_of(fact.predicate(), fact.args(), &belief);
                fact.fault(|at| RuleError::NotBelieved { fact: fact.shown(), help, at })
            })
            .collect();
        let mut goal = Vec::new();
        for wanted in scenario.problem.stated_goals() {
            let driven = DRIVEN.iter().any(|p| name_key(p) == name_key(wanted.predicate()))
                && !wanted.is_negated();
            let holds = known.has(wanted.predicate(), wanted.args()) != wanted.is_negated();
            let lasts = scenario
                .domain
                .predicate(wanted.predicate())
                .is_some_and(|predicate| !scenario.domain.is_changed_by_actions(predicate));
            match (driven, lasts && holds) {
                // What no action changes, and is so, is no work.
                (_, true) => continue,
                (true, false) => {}
                (false, false) => {
                    faults.push(wanted.fault(|at| RuleError::NotDriven {
                        fact: wanted.shown(),
                        help: not_driven(),
                        at,
                    }));
                    continue;
                }
            }
            for (place, name) in wanted.args().iter().enumerate() {
                if !known.knows(name) {
                    let (name, help) = (name.clone(), Some(not_on_map()));
                    faults.push(wanted.argument_fault(place, |at| RuleError::UnknownObject {
                        name,
                        help,
                        at,
                    }));
                }
            }
            let args = wanted.args().to_vec();
            goal.push(GoalFact { predicate: wanted.predicate().to_owned(), args });
        }
        if !scenario.problem.has_goal() {
            faults.push(RuleFault::placeless(RuleError::NoGoal));
        }
        if !faults.is_empty() {
            return Err(RuleFaults(faults).into());
        }
        let goals = if goal.is_empty() { Vec::new() } else { vec![goal] };
        let domain = &scenario.domain;
        let errand =
            Errand { domain, belief, relations: followed, goals, tidies: false, each: false };
        self.drive(errand, vehicle, tell, stop)
    }
}

/// Where things belong is the scenario's to say.
fn keep_homes(scenario: &Scenario, belief: &mut Belief) {
    for fact in scenario.problem.stated_facts().filter(|fact| !fact.is_negated()) {
        let [what, home] = fact.args() else { continue };
        if name_key(fact.predicate()) != name_key(predicate::STORED_ON) {
            continue;
        }
        if let (Some(what), Some(home)) = (thing(&belief.world, what), thing(&belief.world, home)) {
            let name = |id| belief.world.name(Entity::Replica(id)).to_owned();
            let kept = (name(what), name(home));
            belief.homes.push(kept);
        }
    }
}

fn thing(world: &World, name: &str) -> Option<ReplicaId> {
    world.find(name).into_iter().find_map(|entity| match entity {
        Entity::Replica(id) => Some(id),
        _ => None,
    })
}

/// The facts that a plan of the robot would begin with.
struct Known {
    facts: Vec<InitialFact>,
    /// By what makes names equal.
    keys: BTreeSet<(String, Vec<String>)>,
    objects: BTreeSet<String>,
    by_predicate: BTreeMap<String, Vec<usize>>,
}

impl Known {
    fn of(facts: Vec<InitialFact>) -> Self {
        let names = |fact: &InitialFact| -> Vec<String> {
            fact.arguments.iter().map(|a| name_key(&a.name)).collect()
        };
        let keys = facts.iter().map(|fact| (name_key(fact.predicate), names(fact))).collect();
        let objects = facts.iter().flat_map(&names).collect();
        let mut by_predicate: BTreeMap<String, Vec<usize>> = BTreeMap::new();
        for (n, fact) in facts.iter().enumerate() {
            by_predicate.entry(name_key(fact.predicate)).or_default().push(n);
        }
        Self { facts, keys, objects, by_predicate }
    }

    fn has(&self, predicate: &str, args: &[String]) -> bool {
        let args = args.iter().map(|arg| name_key(arg)).collect();
        self.keys.contains(&(name_key(predicate), args))
    }

    fn knows(&self, name: &str) -> bool {
        self.objects.contains(&name_key(name))
    }

    /// What is believed in place of a fact: of the same things, or of its kind about one of them.
    fn instead_of(&self, predicate: &str, args: &[String], belief: &Belief) -> Option<Bilingual> {
        if name_key(predicate) == name_key(predicate::ROBOT_AT_PLACE)
            && let Station::Place(here) = &belief.station
        {
            let place = args.first().map_or_else(|| said!("a-place"), |place| place.clone().into());
            return Some(said!("robot-stands-at", here, place));
        }
        if let Some(unknown) = args.iter().find(|arg| !self.knows(arg)) {
            return Some(said!("map-has-not", unknown));
        }
        let names: Vec<String> = args.iter().map(|arg| name_key(arg)).collect();
        let of_same = self.facts.iter().find(|fact| {
            !names.is_empty()
                && fact.arguments.len() == names.len()
                && fact.arguments.iter().zip(&names).all(|(a, name)| name_key(&a.name) == *name)
        });
        let alike = || {
            let all = self.by_predicate.get(&name_key(predicate))?;
            all.iter().map(|&n| &self.facts[n]).find(|fact| {
                fact.arguments
                    .first()
                    .zip(names.first())
                    .is_none_or(|(a, b)| name_key(&a.name) == *b)
            })
        };
        let told = of_same.or_else(alike).map(written);
        Some(match told {
            Some(fact) => said!("the-robot-believes", fact),
            None => said!("leave-it-out"),
        })
    }
}

fn written(fact: &InitialFact) -> String {
    let args: Vec<&str> = fact.arguments.iter().map(|a| a.name.as_str()).collect();
    format!("{}_({})", fact.predicate, args.join(", "))
}

fn not_driven() -> Bilingual {
    said!("what-a-goal-may-be")
}

fn not_on_map() -> Bilingual {
    said!("no-such-name")
}
