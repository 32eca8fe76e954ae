//! Rooms and storeys that a goal speaks of and to which no door, passage or lift leads at all: then the rules need not
//! be read to see why there is no plan.

use std::collections::BTreeSet;

use crate::language::Language;
use crate::language::words::russian;
use crate::map::Entity;
use crate::semantics::{predicate, storey_name};
use crate::units::{AreaId, InOrder as _, capitalized, told};

use super::lexicon::named;
use super::{State, TaskAnswer};

/// A room or storey where the robot cannot come, however doors stand.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Apart {
    /// An Area, or a Map as a storey.
    place: Entity,
    /// Stairs lead there, which a robot on wheels does not climb.
    by_stairs: bool,
}

impl State {
    /// The rooms and storeys of a task's goal that nothing joins to the one in which the robot began, open or shut.
    fn unconnected(&self, answer: &TaskAnswer) -> Vec<Apart> {
        let (Ok(world), Ok(relations)) = (self.world(), self.relations()) else {
            return Vec::new();
        };
        let Some(start) = self.floor(answer.map).ok().and_then(|f| f.locate(answer.start.at))
        else {
            return Vec::new();
        };
        let (near, by_foot) = (self.joined_to(start.0, false), self.joined_to(start.0, true));
        let area_of = |entity: Entity| match entity {
            Entity::Area(id) => Some(id),
            Entity::Replica(id) => relations.area_of(id),
            Entity::Place(id) => world.places.get(&id).map(|place| place.area),
            Entity::Door(_) | Entity::Map(_) | Entity::Zone(_) => None,
        };
        let storey_of = |name: &str| {
            let map = world.maps.keys().find(|map| storey_name(world, **map) == name)?;
            let areas = || world.maps[map].items.iter().map(|item| item.area);
            let is_apart = areas().all(|area| !near.contains(&area));
            let by_stairs = areas().any(|area| by_foot.contains(&area));
            is_apart.then_some(Apart { place: Entity::Map(*map), by_stairs })
        };
        let mut apart = Vec::new();
        for goal in answer.goal.iter().filter(|g| g.predicate != predicate::FOUND) {
            for name in &goal.args {
                if goal.predicate == predicate::ROBOT_ON_STOREY {
                    apart.extend(storey_of(name));
                } else if let Some(area) = world.find(name).into_iter().find_map(area_of)
                    && !near.contains(&area)
                {
                    let by_stairs = by_foot.contains(&area);
                    apart.push(Apart { place: Entity::Area(area), by_stairs });
                }
            }
        }
        apart.order();
        apart.dedup();
        apart
    }

    /// The rooms to which doors, passages and lifts lead from this one; stairs too for one who climbs them.
    fn joined_to(&self, start: AreaId, climbs: bool) -> BTreeSet<AreaId> {
        let mut near = BTreeSet::from([start]);
        let (Ok(world), Ok(relations)) = (self.world(), self.relations()) else { return near };
        let joins = relations.joins();
        let mut open = vec![start];
        while let Some(area) = open.pop() {
            let beside = joins.iter().filter(|j| j.from == area).map(|j| j.to);
            let stops = world
                .domain
                .lifts
                .iter()
                .filter(|(_, stops)| stops.iter().any(|stop| stop.area == area))
                .filter(|(_, stops)| {
                    climbs || !stops.iter().any(|s| world.area_has_trait(s.area, "stairs"))
                })
                .flat_map(|(_, stops)| stops.iter().map(|stop| stop.area));
            open.extend(beside.chain(stops).filter(|next| near.insert(*next)));
        }
        near
    }

    /// «В Гостиную не ведёт ни дверь, ни проход.»
    #[must_use]
    pub fn unconnected_in_words(&self, answer: &TaskAnswer, language: Language) -> Vec<String> {
        let Ok(world) = self.world() else { return Vec::new() };
        let told = |apart: &Apart| {
            let to = named(world, apart.place);
            let map = match apart.place {
                Entity::Map(map) => Some(map),
                Entity::Area(area) => world.placement(area).map(|(map, _)| map),
                _ => None,
            };
            let elsewhere = map.is_some_and(|map| map != answer.map);
            let to = match (apart.place, language) {
                (Entity::Map(_), _) => to.whither_storey(language),
                (_, Language::Russian) => russian::whither(to.phrase()),
                (_, Language::English) => told!(language, "to-room", room = to.english()),
            };
            capitalized(&match (apart.by_stairs, elsewhere) {
                (true, _) => told!(language, "only-stairs-lead", to),
                (false, true) => told!(language, "neither-door-nor-lift-leads", to),
                (false, false) => told!(language, "neither-door-nor-passage-leads", to),
            })
        };
        self.unconnected(answer).iter().map(told).collect()
    }
}
