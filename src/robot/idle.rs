//! Places at which a task has nothing to do: before each of three hundred chairs. In a large building they would be
//! most of the problem.
//!
//! Of the places of a room of whose things the map says only that they are there, one stands for all: whatever is done
//! before one chair can be done before another. A place that the goal, the robot or anything else speaks of stays.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use crate::semantics::planning::InitialFact;
use crate::semantics::predicate;

use super::goal::GoalFact;

/// So many such places cost little, and all of them stay.
const FEW: usize = 100;

/// The facts without those of places that others stand for.
pub(super) fn without_idle(facts: Vec<InitialFact>, goal: &[GoalFact]) -> Vec<InitialFact> {
    let only_there =
        |fact: &InitialFact| matches!(fact.predicate, predicate::PLACE_IN | predicate::PLACE_BY);
    let mut spoken_of: HashSet<&str> =
        goal.iter().flat_map(|fact| fact.args.iter().map(String::as_str)).collect();
    let others = facts.iter().filter(|fact| !only_there(fact));
    spoken_of.extend(others.flat_map(|fact| fact.arguments.iter().map(|a| a.name.as_str())));
    let is = |fact: &&InitialFact, predicate: &str| fact.predicate == predicate;
    // The things of each place; one that serves nothing is there for its own sake.
    let mut serves: HashMap<&str, Vec<&str>> = HashMap::new();
    for fact in facts.iter().filter(|fact| is(fact, predicate::PLACE_BY)) {
        serves.entry(&fact.arguments[0].name).or_default().push(&fact.arguments[1].name);
    }
    let mut alike: BTreeMap<(&str, usize), BTreeSet<&str>> = BTreeMap::new();
    for fact in facts.iter().filter(|fact| is(fact, predicate::PLACE_IN)) {
        let (place, room) = (fact.arguments[0].name.as_str(), fact.arguments[1].name.as_str());
        let things = serves.get(place).map_or(&[][..], Vec::as_slice);
        let idle = !things.is_empty() && !spoken_of.contains(place);
        if idle && things.iter().all(|thing| !spoken_of.contains(thing)) {
            alike.entry((room, things.len())).or_default().insert(place);
        }
    }
    if alike.values().map(BTreeSet::len).sum::<usize>() <= FEW {
        return facts;
    }
    let gone: HashSet<String> =
        alike.values().flat_map(|places| places.iter().skip(1)).map(|p| (*p).to_owned()).collect();
    let of_gone = |fact: &InitialFact| only_there(fact) && gone.contains(&fact.arguments[0].name);
    facts.into_iter().filter(|fact| !of_gone(fact)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::semantics::planning::Argument;

    fn fact(predicate: &'static str, names: [&str; 2]) -> InitialFact {
        let argument = |name: &str| Argument { name: name.to_owned(), kind: "объект" };
        InitialFact { predicate, arguments: names.map(argument).into(), assumed: false }
    }

    #[test]
    fn one_chair_stands_for_all_that_nobody_speaks_of() {
        let chairs: Vec<String> = (0..=FEW).map(|n| format!("chair {n:03}")).collect();
        let mut facts: Vec<InitialFact> = Vec::new();
        for chair in &chairs {
            facts.push(fact(predicate::PLACE_IN, [chair, "hall"]));
            facts.push(fact(predicate::PLACE_BY, [chair, chair]));
        }
        facts.push(fact(predicate::THING_ON, ["cup", "chair 007"]));
        let goal =
            [GoalFact { predicate: predicate::THING_ON.into(), args: vec!["chair 009".into()] }];
        let few = without_idle(facts[2..].to_vec(), &goal);
        assert_eq!(few.len(), facts.len() - 2, "few stay");
        facts.push(fact(predicate::PLACE_IN, ["chair a", "hall"]));
        facts.push(fact(predicate::PLACE_BY, ["chair a", "chair a"]));
        facts.push(fact(predicate::PLACE_IN, ["chair b", "hall"]));
        facts.push(fact(predicate::PLACE_BY, ["chair b", "chair b"]));
        let left = without_idle(facts, &goal);
        let places = left.iter().filter(|fact| fact.predicate == predicate::PLACE_IN);
        let places: Vec<&str> = places.map(|fact| fact.arguments[0].name.as_str()).collect();
        assert_eq!(places, ["chair 000", "chair 007", "chair 009"]);
    }
}
