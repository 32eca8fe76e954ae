//! Landmarks of several facts, one of which must hold (S. Richter, M. Helmert, M. Westphal, 2008): a parcel is in one of
//! the trucks before it is elsewhere.

use std::collections::BTreeMap;

use super::sets::{Sets, Ways, common};
use super::{Landmarks, State, holds, leads_to};
use crate::strips::{FactId, Operator, Task};
use crate::units::Gather as _;

/// Of more facts than these, one will hold anyway.
const MOST: usize = 4;

/// Where each first way to a landmark needs some fact of a kind, but not all ways the same, one of these facts must hold
/// before the landmark; of these, too, and of their own.
pub(super) fn add(all: &mut Landmarks, task: &Task, sets: &Sets, state: &State) {
    let number: BTreeMap<FactId, u32> =
        all.facts.iter().enumerate().map(|(n, &fact)| (fact, n as u32)).gather();
    let mut known: BTreeMap<FactId, u32> = BTreeMap::new();
    let mut landmark = 0;
    while landmark < all.before.len() {
        let facts = all.alternatives(landmark).to_vec();
        let first =
            if all.held(landmark, state) { Vec::new() } else { sets.first_of(task, &facts) };
        let again = sets.all_of(task, &facts);
        for kind in kinds(task, &first) {
            let attained = |fact: &FactId| holds(state, *fact) || number.contains_key(fact);
            if kind.len() > MOST || kind.iter().any(attained) {
                continue;
            }
            let needs_again = again.iter().all(|operator| needs_some(operator, &kind));
            let own: Option<u32> = match known.get(&kind[0]) {
                Some(&same) if *all.alternatives(same as usize) == *kind => Some(same),
                // Two that share a fact would be counted twice for it.
                _ if kind.iter().any(|fact| known.contains_key(fact)) => None,
                _ => {
                    let own = all.before.len() as u32;
                    kind.iter().for_each(|&fact| _ = known.insert(fact, own));
                    push(all, task, sets, state, &number, kind);
                    Some(own)
                }
            };
            let Some(own) = own.filter(|&own| !leads_to(&all.before, own, landmark as u32)) else {
                continue;
            };
            if !all.before[landmark].contains(&own) {
                all.before[landmark].push(own);
                all.needs[landmark].push(own);
                if needs_again {
                    all.needs_again[landmark].push(own);
                }
            }
        }
        landmark += 1;
    }
}

fn push(
    all: &mut Landmarks,
    task: &Task,
    sets: &Sets,
    state: &State,
    number: &BTreeMap<FactId, u32>,
    kind: Vec<FactId>,
) {
    let shared = |operators: Vec<&Operator>| -> Vec<u32> {
        let needs = Ways::of(operators.into_iter()).needs;
        needs.iter().filter_map(|need| number.get(need).copied()).collect()
    };
    let needs = shared(sets.first_of(task, &kind));
    let not_yet = |need: &&u32| !holds(state, all.facts[**need as usize]);
    let before = needs.iter().filter(not_yet).copied().collect();
    all.before.push(before);
    all.needs.push(needs);
    all.needs_again.push(shared(sets.all_of(task, &kind)));
    all.is_goal.push(false);
    all.disjunctions.push(kind.into());
}

fn needs_some(operator: &Operator, facts: &[FactId]) -> bool {
    facts.iter().any(|fact| operator.preconditions.binary_search(fact).is_ok())
}

/// Facts that operators need, kind by kind, where each operator needs one of the kind, none of them needed by all.
fn kinds(task: &Task, operators: &[&Operator]) -> Vec<Vec<FactId>> {
    let shared = common(operators.iter().map(|operator| operator.preconditions.as_slice()));
    let mut kinds: BTreeMap<(&str, bool), (usize, Vec<FactId>)> = BTreeMap::new();
    for (at, operator) in operators.iter().enumerate() {
        for &need in
            operator.preconditions.iter().filter(|need| shared.binary_search(need).is_err())
        {
            let fact = task.fact(need);
            let (served, facts) = kinds.entry((&fact.predicate, fact.negated)).or_default();
            // Served by all operators so far, and by this one.
            if *served == at {
                *served = at + 1;
            }
            facts.push(need);
        }
    }
    let whole = kinds.into_values().filter(|(served, _)| *served == operators.len());
    whole
        .map(|(_, mut facts)| {
            facts.sort_unstable();
            facts.dedup();
            facts
        })
        .collect()
}

#[cfg(test)]
mod tests {
    use crate::portfolio::landmarks::Landmarks;
    use crate::portfolio::relaxed::{carry_out, initial};
    use crate::samples::{Named, Random, random_task};
    use crate::strips::Task;
    use crate::{Limits, Outcome, solve_any};

    /// Trucks that bring parcels over roads from place to place.
    fn parcels(seed: u64) -> Task {
        let mut random = Random(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1);
        let (trucks, places, parcels) = (2 + random.below(3), 3 + random.below(2), 2);
        let mut named = Named::default();
        let roads: Vec<(usize, usize)> =
            (0..2 * places).map(|_| (random.below(places), random.below(places))).collect();
        let (mut init, mut goal) = (Vec::new(), Vec::new());
        for truck in 0..trucks {
            for &(from, to) in roads.iter().filter(|(from, to)| from != to) {
                let [here, there] = [from, to].map(|at| named.fact(&format!("truck {truck} {at}")));
                named.operator(&[here], &[there], &[here]);
            }
            init.push(named.fact(&format!("truck {truck} {}", random.below(places))));
        }
        for parcel in 0..parcels {
            for (truck, place) in (0..trucks).flat_map(|t| (0..places).map(move |at| (t, at))) {
                let here = named.fact(&format!("truck {truck} {place}"));
                let [lies, rides] =
                    [format!("lies {parcel} {place}"), format!("rides {parcel} {truck}")]
                        .map(|name| named.fact(&name));
                named.operator(&[here, lies], &[rides], &[lies]);
                named.operator(&[here, rides], &[lies], &[rides]);
            }
            init.push(named.fact(&format!("lies {parcel} {}", random.below(places))));
            goal.push(named.fact(&format!("lies {parcel} {}", random.below(places))));
        }
        named.task_in_words(&init, &goal)
    }

    #[test]
    fn every_plan_makes_each_landmark_true() {
        let (mut facts, mut disjunctions) = (0, 0);
        let tasks = (1..=1000).flat_map(|seed| [random_task(seed), parcels(seed)]);
        for (number, task) in tasks.enumerate() {
            let Some(landmarks) = Landmarks::of(&task) else { continue };
            let Outcome::Plan(plan) = solve_any(&task, &Limits::default()) else { continue };
            let mut state = initial(&task);
            let mut met = vec![false; landmarks.before.len()];
            let mut look = |state: &_| {
                (0..met.len())
                    .for_each(|landmark| met[landmark] |= landmarks.held(landmark, state));
            };
            look(&state);
            for &id in plan.steps.iter().flatten() {
                carry_out(&task, &mut state, id);
                look(&state);
            }
            assert!(met.iter().all(|&met| met), "task {number}: {met:?}");
            facts += landmarks.facts.len();
            disjunctions += landmarks.disjunctions.len();
        }
        assert!(facts > 1000 && disjunctions > 500, "{facts} {disjunctions}");
    }
}
