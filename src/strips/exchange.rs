//! Which facts take each other's place, as the actions have it: a door is open, shut or locked; the robot is here or
//! there; a thing lies, or is held.

use super::domain::{Domain, SchemaAtom};

/// For each predicate the number of the state that it belongs to.
pub(super) fn states(domain: &Domain) -> Vec<usize> {
    let mut states: Vec<usize> = (0..domain.predicates.len()).collect();
    for schema in &domain.schemas {
        for add in &schema.add_effects {
            for del in schema.del_effects.iter().filter(|del| del.args == add.args) {
                let (into, from) = (states[add.predicate.index()], states[del.predicate.index()]);
                states.iter_mut().filter(|state| **state == from).for_each(|state| *state = into);
            }
        }
    }
    states
}

/// For each predicate whether its facts give way to each other, as those of where the robot is.
pub(super) fn moving(domain: &Domain) -> Vec<bool> {
    let mut moving = vec![false; domain.predicates.len()];
    for schema in &domain.schemas {
        for add in &schema.add_effects {
            let moves = |del: &SchemaAtom| del.predicate == add.predicate && del.args != add.args;
            moving[add.predicate.index()] |= schema.del_effects.iter().any(moves);
        }
    }
    moving
}

/// For each place of each predicate a number: two have one where actions exchange facts about the object there, as a
/// thing lies on a table, is held and lies on the floor.
pub(super) fn exchanged(domain: &Domain) -> Vec<Vec<usize>> {
    let mut next = 0..;
    let mut places: Vec<Vec<usize>> = domain
        .predicates
        .iter()
        .map(|predicate| predicate.args.iter().filter_map(|_| next.next()).collect())
        .collect();
    for schema in &domain.schemas {
        for (add, del) in schema
            .add_effects
            .iter()
            .flat_map(|add| schema.del_effects.iter().map(move |del| (add, del)))
            .filter(|(add, del)| add.predicate != del.predicate)
        {
            for (at, to) in
                (0..add.args.len()).flat_map(|a| (0..del.args.len()).map(move |d| (a, d)))
            {
                if add.args[at] == del.args[to] {
                    let into = places[add.predicate.index()][at];
                    let from = places[del.predicate.index()][to];
                    let all = places.iter_mut().flatten().filter(|place| **place == from);
                    all.for_each(|place| *place = into);
                }
            }
        }
    }
    places
}
