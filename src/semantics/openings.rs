//! What doors and passages are called in the facts, and how what the rules decide of them comes back to them (SPEC R1).
//!
//! [`Openings`] are measured by geometry; the facts tell which links bind them and where one comes out by stepping
//! through; the relation JOINS of the rules decides which Areas they join.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::geometry::{Opening, Openings};
use crate::map::{Permeability, World};
use crate::units::{AreaId, DoorId, OpeningId};

use super::names::Symbols;

/// The openings of a world with their names; sides are looked for through walls up to `reach` cm thick.
pub(super) fn openings(world: &World, reach: f64, symbols: &Symbols) -> Openings {
    let mut openings = Openings::of(world, reach);
    call(&mut openings, world, symbols, |_| true);
    openings
}

/// Gives openings the names of the doors and Areas of a world; of those that bear the name of a door, where that door may be
/// called otherwise.
pub(super) fn call(
    openings: &mut Openings,
    world: &World,
    symbols: &Symbols,
    is_renamed: impl Fn(DoorId) -> bool,
) {
    let mut taken = BTreeSet::new();
    openings.name(|opening| match opening.door {
        Some(door)
            if !opening.name.is_empty() && !is_renamed(door) && world.doors.contains_key(&door) =>
        {
            None
        }
        door => match door.filter(|door| world.doors.contains_key(door)) {
            Some(door) => Some(symbols.door(door))
                .filter(|name| ***name != *opening.name)
                .map(ToString::to_string),
            None => Some(new_name(opening, symbols, &mut taken)),
        },
    });
}

/// «Проход-А-Б», with a number when there are several.
fn new_name(opening: &Opening, symbols: &Symbols, taken: &mut BTreeSet<String>) -> String {
    let kind = if opening.permeability == Permeability::Conditional {
        "Дверь"
    } else {
        "Проход"
    };
    // As a reader of the map comes upon it.
    let side = opening.sides.iter().min_by_key(|side| side.area).expect("an opening has a side");
    let mut name = format!("{kind}-{}", symbols.area(side.area));
    let across = opening.areas.into_iter().find(|area| *area != side.area);
    if let Some(other) = across.or_else(|| side.behind()) {
        name = format!("{name}-{}", symbols.area(other));
    }
    (1..)
        .map(|n| if n == 1 { name.clone() } else { format!("{name}-{n}") })
        .find(|n| symbols.subject(n).is_none() && taken.insert(n.clone()))
        .expect("the numbers do not end")
}

/// Openings by their names in the facts.
pub(super) fn by_name(openings: &Openings) -> BTreeMap<&str, Vec<OpeningId>> {
    let mut found: BTreeMap<&str, Vec<OpeningId>> = BTreeMap::new();
    for opening in openings.iter() {
        found.entry(&opening.name).or_default().push(opening.id);
    }
    found
}

/// Gives openings, those of the wanted names, what the rules decided: pairs of Areas by the opening's name.
pub(super) fn decide(
    openings: &mut Arc<Openings>,
    is_wanted: impl Fn(&str) -> bool,
    joins: &BTreeMap<String, BTreeSet<[AreaId; 2]>>,
) {
    let wanted: Vec<&Opening> = openings.iter().filter(|o| is_wanted(&o.name)).collect();
    let mut namesakes: BTreeMap<&str, usize> = BTreeMap::new();
    for opening in &wanted {
        *namesakes.entry(&opening.name).or_default() += 1;
    }
    let decided = wanted.iter().map(|opening| {
        let own = joins.get(&opening.name).into_iter().flatten().copied();
        // One door may hang in several places.
        let is_only = namesakes.get(&*opening.name) == Some(&1);
        let here =
            |pair: &[AreaId; 2]| is_only || pair.iter().any(|a| opening.side_in(*a).is_some());
        (opening, own.filter(here).collect::<Vec<_>>())
    });
    let news = decided.filter(|(opening, joins)| opening.joins != *joins);
    let news: Vec<_> = news.map(|(opening, joins)| (opening.id, joins)).collect();
    if !news.is_empty() {
        let openings = Arc::make_mut(openings);
        news.into_iter().for_each(|(id, joins)| openings.decide(id, joins));
    }
}
