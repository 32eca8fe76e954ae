//! Rooms that a goal speaks of and to which no door, passage or lift leads at all: then the rules need not be read to
//! see why there is no plan.

use std::collections::BTreeSet;

use crate::language::words::russian::{self, Preposition};
use crate::language::{Case, Language};
use crate::map::Entity;
use crate::semantics::predicate;
use crate::units::{AreaId, capitalized};

use super::lexicon::named;
use super::{Engine, TaskAnswer};

impl Engine {
    /// The rooms of a task's goal that nothing joins to the one in which the robot began, open or shut.
    #[must_use]
    pub fn unconnected(&self, answer: &TaskAnswer) -> Vec<AreaId> {
        let (Ok(world), Ok(relations)) = (self.world(), self.relations()) else {
            return Vec::new();
        };
        let Some(start) = self.floor(answer.map).ok().and_then(|f| f.locate(answer.start.at))
        else {
            return Vec::new();
        };
        let mut near = BTreeSet::from([start.0]);
        let mut open = vec![start.0];
        let joins = relations.joins();
        while let Some(area) = open.pop() {
            let beside = joins.iter().filter(|j| j.from == area).map(|j| j.to);
            let stops = world
                .domain
                .lifts
                .iter()
                .filter(|(_, stops)| stops.iter().any(|stop| stop.area == area))
                .flat_map(|(_, stops)| stops.iter().map(|stop| stop.area));
            open.extend(beside.chain(stops).filter(|next| near.insert(*next)));
        }
        let area_of = |entity: Entity| match entity {
            Entity::Area(id) => Some(id),
            Entity::Replica(id) => relations.area_of(id),
            Entity::Place(id) => world.places.get(&id).map(|place| place.area),
            Entity::Door(_) | Entity::Map(_) => None,
        };
        let told = answer.goal.iter().filter(|g| g.predicate != predicate::FOUND);
        let mut apart: Vec<AreaId> = told
            .flat_map(|goal| &goal.args)
            .filter_map(|name| world.find(name).into_iter().find_map(area_of))
            .filter(|area| !near.contains(area))
            .collect();
        apart.sort_unstable();
        apart.dedup();
        apart
    }

    /// «В Гостиную не ведёт ни одна дверь.»
    #[must_use]
    pub fn unconnected_in_words(&self, answer: &TaskAnswer, language: Language) -> Vec<String> {
        let Ok(world) = self.world() else { return Vec::new() };
        let told = |area: &AreaId| {
            let room = named(world, Entity::Area(*area));
            match language {
                Language::Russian => {
                    let into = russian::with(Preposition::V, Case::Accusative, room.phrase());
                    format!("{} не ведёт ни дверь, ни проход.", capitalized(&into))
                }
                Language::English => {
                    format!("Neither door nor passage leads to {}.", room.english())
                }
            }
        };
        self.unconnected(answer).iter().map(told).collect()
    }
}
