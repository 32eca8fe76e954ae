//! Lifts and storeys as the rules of a robot speak of them: a lift has a cabin on each storey, and doors to them (M6).
//!
//! **Invariant:** no name of a lift or storey is that of anything else on the map; a name has one type in a rule file.

use crate::map::{DoorStatus, World};
use crate::units::{AreaId, MapId};

use super::relations::{Join, Relations};

/// A lift that a robot can ride.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Lift {
    /// Index in [`crate::map::Domain::lifts`].
    pub number: usize,
    pub name: String,
    /// In the order of its stops.
    pub cabins: Vec<AreaId>,
    /// From each cabin to a room, in the order of the cabins.
    pub doors: Vec<Join>,
}

impl Lift {
    /// The door at which the cabin is believed to stand when nobody has seen it: where the robot itself is in it, else
    /// on another storey than the robot's, so that it is called in any case; never behind a locked door if there is
    /// another.
    #[must_use]
    pub fn cabin_unseen(&self, world: &World, robot: AreaId) -> Option<&Join> {
        let storey = |area| world.placement(area).map(|(map, _)| map);
        let here = storey(robot);
        let is_locked = |join: &Join| {
            let door = join.door.and_then(|door| world.doors.get(&door));
            door.is_some_and(|door| door.state.status == DoorStatus::Locked)
        };
        let rank = |join: &&Join| (join.from != robot, storey(join.from) == here, is_locked(join));
        self.doors.iter().min_by_key(rank)
    }
}

/// The lifts of the domain that have a door; stairs, which a robot on wheels does not climb, are none.
#[must_use]
pub fn lifts(world: &World, relations: &Relations) -> Vec<Lift> {
    let all = &world.domain.lifts;
    let joins = if all.is_empty() { Vec::new() } else { relations.joins() };
    let is_cabin = |area: AreaId| all.iter().any(|(_, stops)| stops.iter().any(|s| s.area == area));
    let mut lifts: Vec<Lift> = Vec::new();
    for (number, (name, stops)) in all.iter().enumerate() {
        if stops.iter().any(|stop| world.area_has_trait(stop.area, "stairs")) {
            continue;
        }
        let cabins: Vec<AreaId> = stops.iter().map(|stop| stop.area).collect();
        let leaves = |cabin: &AreaId| {
            let cabin = *cabin;
            joins.iter().filter(move |join| join.from == cabin && !is_cabin(join.to)).cloned()
        };
        let doors: Vec<Join> = cabins.iter().flat_map(leaves).collect();
        if doors.is_empty() {
            continue;
        }
        let name = free_name(world, name, "Лифт", |n| lifts.iter().any(|lift| lift.name == n));
        lifts.push(Lift { number, name, cabins, doors });
    }
    lifts
}

/// What a storey, which is a Map, is called in plans.
#[must_use]
pub fn storey_name(world: &World, map: MapId) -> String {
    let name = &world.maps[&map].name;
    let is_other = |e: &crate::map::Entity| !matches!(e, crate::map::Entity::Map(id) if *id == map);
    let namesake = world.find(name).iter().any(is_other);
    if namesake { free_name(world, name, "Этаж", |_| false) } else { name.clone() }
}

/// The name itself, or one made of it that nothing has.
fn free_name(world: &World, name: &str, kind: &str, taken: impl Fn(&str) -> bool) -> String {
    let is_free = |n: &String| world.find(n).is_empty() && !taken(n);
    let names = (1..).map(|k| match k {
        1 => name.to_owned(),
        2 => format!("{kind}-{name}"),
        k => format!("{kind}-{name}-{}", k - 1),
    });
    names.into_iter().find(is_free).expect("the numbers do not end")
}
