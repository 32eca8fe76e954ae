//! What lies to a thing as a preposition says, by the relations and, where no relation tells, by measuring.
//!
//! Invariant: what the relations tell is not measured again.

use super::Frame;
use super::Knowledge;
use super::bases;
use crate::facts::{Value, quoted};
use crate::map::{Entity, Mark};
use crate::question::lexicon::Extension;
use crate::question::query::{Rel, Thing};
use crate::units::{AreaId, Gather as _, InOrder as _, MapId, ReplicaId};
use std::collections::{BTreeSet, HashSet};

impl Knowledge<'_> {
    /// What lies to a thing as a preposition says.
    pub(in crate::question) fn related(&self, rel: Rel, anchor: Thing) -> Vec<Thing> {
        let near = self.relations.thresholds();
        match (rel, anchor) {
            (Rel::In | Rel::On | Rel::Of | Rel::At, Thing::Entity(Entity::Map(map))) => {
                self.on_map(map)
            }
            // The lifts that stop at a storey, wherever one enters them.
            (Rel::To, Thing::Entity(Entity::Map(map))) => {
                let stops = self.world.domain.lifts.iter().map(|(_, stops)| stops);
                let there = |stop: &crate::map::LiftStop| {
                    self.world.placement(stop.area).is_some_and(|(own, _)| own == map)
                };
                let stops = stops.filter(|stops| stops.iter().any(there)).flatten();
                stops.map(|stop| Thing::Entity(Entity::Area(stop.area))).collect()
            }
            // The ways out of a storey, or of the building.
            (Rel::From, Thing::Entity(Entity::Map(map))) => {
                let mut found = self.on_map(map);
                found.retain(|t| self.opening(*t).is_some());
                found
            }
            // "Which door leads to the lounge?", a place in a hall: those of the hall.
            (Rel::From | Rel::To | Rel::Through, Thing::Entity(Entity::Place(id))) => {
                let area = self.world.places.get(&id).map(|place| Entity::Area(place.area));
                let mut found = area.map_or(vec![], |area| self.related(rel, Thing::Entity(area)));
                found.retain(|t| self.opening(*t).is_some());
                found
            }
            (Rel::In | Rel::On | Rel::At, Thing::Entity(Entity::Area(area))) => self.in_area(area),
            (Rel::Of | Rel::From | Rel::To | Rel::Through, Thing::Entity(Entity::Area(area))) => {
                let mut found = self.in_area(area);
                if rel != Rel::Of {
                    found.retain(|t| self.opening(*t).is_some());
                }
                // "Which rooms lead to the corridor?"
                // "Which rooms can I get to from the kitchen?"
                if matches!(rel, Rel::To | Rel::From) {
                    found.extend(self.related(Rel::Near, anchor));
                }
                found
            }
            // Rooms of other storeys: what stands over a thing in its own room the relations tell.
            (Rel::Above | Rel::Under, Thing::Entity(Entity::Area(area))) => {
                let is_over = rel == Rel::Above;
                let found = self.relations.on_other_storeys(self.world, area, is_over);
                found.into_iter().map(|id| Thing::Entity(Entity::Area(id))).collect()
            }
            (Rel::Above | Rel::Under, Thing::Entity(Entity::Map(map))) => {
                self.of_other_storeys(map, rel == Rel::Above)
            }
            (Rel::Outside, Thing::Entity(Entity::Area(area))) => {
                let inside: HashSet<Thing> = self.in_area(area).into_iter().collect();
                let all = self.members(&Extension::Things).into_iter();
                all.filter(|t| !inside.contains(t)).collect()
            }
            // "eggs outside the fridge"
            (Rel::Outside, Thing::Entity(Entity::Replica(_))) => {
                let inside: HashSet<Thing> =
                    self.by_relation(Rel::In, anchor).into_iter().collect();
                let all = self.members(&Extension::Things).into_iter();
                all.filter(|t| *t != anchor && !inside.contains(t)).collect()
            }
            (Rel::Near | Rel::NextTo, Thing::Entity(Entity::Area(area))) => {
                let rooms: BTreeSet<AreaId> =
                    self.openings().iter().flat_map(|g| g.beyond(area)).gather();
                rooms.into_iter().map(|a| Thing::Entity(Entity::Area(a))).collect()
            }
            (
                Rel::Near | Rel::NextTo | Rel::At,
                Thing::Entity(Entity::Door(_)) | Thing::Opening(_),
            ) => {
                let Some(ends) = self.opening(anchor).and_then(|o| self.ends_of(o)) else {
                    return Vec::new();
                };
                let all = self.pairs("AT_DOOR").and_then(|pairs| pairs.backward.get(&anchor));
                let away = |id| self.relations.distance_to_segment(id, ends);
                nearest_first(all.into_iter().flatten().copied(), away)
            }
            (Rel::Near | Rel::NextTo | Rel::At | Rel::Under, Thing::Window(n)) => {
                let window = &self.lexicon().windows[n as usize];
                self.within_reach(near.door_gap, &[window.area], |id| {
                    self.relations.distance_to_segment(id, window.ends)
                })
            }
            (Rel::Near | Rel::NextTo | Rel::At, Thing::Entity(Entity::Place(_)) | Thing::Robot) => {
                let Some((map, at)) = self.point(anchor) else { return Vec::new() };
                let area = self.relations.measurements().area_at(map, at);
                let areas: Vec<AreaId> = area.into_iter().collect();
                self.within_reach(near.door_gap, &areas, |id| {
                    self.relations.distance_to_point(id, map, at)
                })
            }
            (Rel::Within(reach), _) => {
                let areas = match self.opening(anchor) {
                    Some(gate) => gate.areas.clone(),
                    None => self.area_of(anchor).into_iter().collect(),
                };
                let mut found = self.within_reach(f64::from(reach), &areas, |id| {
                    self.distance(Thing::Entity(Entity::Replica(id)), anchor)
                });
                found.retain(|t| *t != anchor);
                found
            }
            (Rel::Middle, _) => self.in_middle(anchor),
            (Rel::There, Thing::Entity(Entity::Replica(_))) => {
                // A chest has things in it and on it.
                let mut found = self.by_relation(Rel::In, anchor);
                found.extend(self.by_relation(Rel::On, anchor));
                found.order();
                found.dedup();
                found
            }
            (Rel::There, _) => self.related(self.there(anchor), anchor),
            (Rel::Has, _) => self.holders(anchor),
            (Rel::Opens, _) => self.keys_of(anchor),
            (Rel::LeftOf | Rel::RightOf | Rel::Behind | Rel::InFrontOf, Thing::Robot) => {
                self.beside_robot(rel)
            }
            (Rel::LeftOf | Rel::RightOf | Rel::Behind | Rel::InFrontOf, _) => {
                match self.frame(anchor) {
                    Frame::Own => self.by_relation(rel, anchor),
                    Frame::Viewer => self.for_viewer(rel, anchor),
                }
            }
            // What is behind a wall is not near.
            (Rel::Near, Thing::Entity(Entity::Replica(_))) => {
                let room = self.area_of(anchor);
                let mut found = self.by_relation(rel, anchor);
                found
                    .retain(|t| room.is_none() || self.area_of(*t).is_none_or(|r| Some(r) == room));
                found
            }
            _ => self.by_relation(rel, anchor),
        }
    }

    /// Whether both are furniture of one room and stand so near that one is at the other.
    pub(in crate::question) fn stands_at(&self, x: Thing, y: Thing) -> bool {
        let at = self.pairs("STANDS_AT").and_then(|pairs| pairs.forward.get(&x));
        at.is_some_and(|others| others.contains(&y))
    }

    /// How things lie to what «там» means: on what bears them, else in it.
    pub(in crate::question) fn there(&self, anchor: Thing) -> Rel {
        let on = |id: ReplicaId| {
            !self.by_relation(Rel::On, Thing::Entity(Entity::Replica(id))).is_empty()
        };
        let inside = !self.by_relation(Rel::In, anchor).is_empty();
        if !inside && anchor.replica().is_some_and(on) { Rel::On } else { Rel::In }
    }

    /// What stands in the middle of a room, or on a thing in its middle.
    fn in_middle(&self, anchor: Thing) -> Vec<Thing> {
        let all = self.pairs("IN_MIDDLE_OF").and_then(|pairs| pairs.backward.get(&anchor));
        let mut found = all.cloned().unwrap_or_default();
        found.order();
        found
    }

    /// Keys of a door, or of the doors of a room.
    fn keys_of(&self, anchor: Thing) -> Vec<Thing> {
        let all = self.world.replicas.values();
        let all = all.map(|r| Thing::Entity(Entity::Replica(r.id)));
        let fits = |key: &Thing| {
            let door = self.opened_by(*key);
            door == Some(anchor)
                || anchor.area().is_some_and(|area| {
                    door.and_then(|door| self.opening(door))
                        .is_some_and(|g| g.areas.contains(&area))
                })
        };
        all.filter(fits).collect()
    }

    /// The door that a key opens.
    pub(in crate::question) fn opened_by(&self, key: Thing) -> Option<Thing> {
        let (_, door) = Mark::KeyOf.of(&self.world.replicas.get(&key.replica()?)?.properties)?;
        let is_door = |entity: &Entity| matches!(entity, Entity::Door(_));
        self.world.find(door).into_iter().find(is_door).map(Thing::Entity)
    }

    pub(super) fn by_relation(&self, rel: Rel, anchor: Thing) -> Vec<Thing> {
        let mut found: Vec<Thing> = Vec::new();
        for basis in bases(rel) {
            if basis.of_support
                && anchor.replica().is_none_or(|id| !self.world.has_trait(id, "shelves"))
            {
                continue;
            }
            let Some(pairs) = self.pairs(basis.relation) else { continue };
            let side = if basis.swapped { &pairs.forward } else { &pairs.backward };
            for thing in side.get(&anchor).into_iter().flatten() {
                if !found.contains(thing) {
                    found.push(*thing);
                }
            }
        }
        if matches!(rel, Rel::On | Rel::In) {
            found.extend(self.aboard(anchor));
        }
        found.order();
        found
    }

    /// What lies on or in a thing that is carried: it stands in no relation to anything else.
    fn aboard(&self, carrier: Thing) -> Vec<Thing> {
        let Some(carrier) = carrier.replica().filter(|id| self.senses.holder(*id).is_some()) else {
            return Vec::new();
        };
        let all = self.world.replicas.keys();
        let own = all.filter(|id| self.senses.carrier(**id) == Some(carrier));
        own.map(|id| Thing::Entity(Entity::Replica(*id))).collect()
    }

    /// The tuple that makes a relation hold: its name in the rule text and its arguments in order.
    pub(in crate::question) fn tuple(
        &self,
        rel: Rel,
        x: Thing,
        y: Thing,
    ) -> Option<(&'static str, Thing, Thing)> {
        if let (Rel::Has, _) = (rel, y) {
            return self.tuple(Rel::In, y, x);
        }
        let own = match rel {
            Rel::Near | Rel::NextTo | Rel::At if self.opening(y).is_some() => Some("AT_DOOR"),
            Rel::Middle => Some("IN_MIDDLE_OF"),
            _ => None,
        };
        let holds = |relation: &str| {
            self.pairs(relation)
                .and_then(|pairs| pairs.forward.get(&x))
                .is_some_and(|all| all.contains(&y))
        };
        if let Some(relation) = own {
            return holds(relation).then_some((relation, x, y));
        }
        bases(rel).iter().find_map(|basis| {
            let (a, b) = if basis.swapped { (y, x) } else { (x, y) };
            let pairs = self.pairs(basis.relation)?;
            pairs.forward.get(&a)?.contains(&b).then_some((basis.relation, a, b))
        })
    }

    /// Rooms and things that hold a thing.
    fn holders(&self, thing: Thing) -> Vec<Thing> {
        match thing {
            Thing::Window(n) => {
                vec![Thing::Entity(Entity::Area(self.lexicon().windows[n as usize].area))]
            }
            Thing::Entity(Entity::Place(id)) => self
                .world
                .places
                .get(&id)
                .map(|p| Thing::Entity(Entity::Area(p.area)))
                .into_iter()
                .collect(),
            // "the floor with the storeroom"
            Thing::Entity(Entity::Area(id)) => {
                let placed = self.world.placement(id);
                placed.map(|(map, _)| Thing::Entity(Entity::Map(map))).into_iter().collect()
            }
            _ => match self.opening(thing) {
                Some(gate) => gate.areas.iter().map(|a| Thing::Entity(Entity::Area(*a))).collect(),
                None => self.by_relation(Rel::Has, thing),
            },
        }
    }

    fn in_area(&self, area: AreaId) -> Vec<Thing> {
        let here = Thing::Entity(Entity::Area(area));
        let mut found = self.by_relation(Rel::In, here);
        found.extend(self.openings().iter().filter(|g| g.areas.contains(&area)).map(|g| g.thing));
        let windows = self.lexicon().windows.iter().enumerate();
        found.extend(windows.filter(|(_, w)| w.area == area).map(|(n, _)| Thing::Window(n as u32)));
        let places = self.world.places.values().filter(|p| p.area == area);
        found.extend(places.map(|p| Thing::Entity(Entity::Place(p.id))));
        found
    }

    fn on_map(&self, map: MapId) -> Vec<Thing> {
        let Some(map) = self.world.maps.get(&map) else { return Vec::new() };
        let mut found: Vec<Thing> = Vec::new();
        for item in &map.items {
            found.push(Thing::Entity(Entity::Area(item.area)));
            found.extend(self.in_area(item.area));
        }
        found.order();
        found.dedup();
        found
    }

    /// The storeys above one, or below it, and their rooms.
    fn of_other_storeys(&self, map: MapId, is_above: bool) -> Vec<Thing> {
        let is_there = |other: &MapId| {
            let rise = self.relations.rise(self.world, map, *other);
            rise.is_some_and(|rise| (rise > 0.0) == is_above)
        };
        let mut found = Vec::new();
        for other in self.world.maps.values().filter(|other| is_there(&other.id)) {
            found.push(Thing::Entity(Entity::Map(other.id)));
            found.extend(other.items.iter().map(|item| Thing::Entity(Entity::Area(item.area))));
        }
        found
    }

    fn within_reach(
        &self,
        reach: f64,
        areas: &[AreaId],
        distance: impl Fn(ReplicaId) -> Option<f64>,
    ) -> Vec<Thing> {
        let rooms = areas.iter().map(|a| Thing::Entity(Entity::Area(*a)));
        let inside = rooms.flat_map(|room| self.by_relation(Rel::In, room));
        nearest_first(inside, |id| distance(id).filter(|away| *away <= reach))
    }

    /// From whose side left and right of a thing are told.
    pub(in crate::question) fn frame(&self, anchor: Thing) -> Frame {
        match anchor.replica() {
            Some(id) if self.relations.has_front(id) => Frame::Own,
            _ => Frame::Viewer,
        }
    }

    fn for_viewer(&self, rel: Rel, anchor: Thing) -> Vec<Thing> {
        let relation = match rel {
            Rel::LeftOf => "LEFT_FOR_VIEWER",
            Rel::RightOf => "RIGHT_FOR_VIEWER",
            Rel::Behind => "BEHIND_FOR_VIEWER",
            _ => "IN_FRONT_FOR_VIEWER",
        };
        let of = quoted(&self.symbol(anchor));
        self.things_asked(&format!("?- {relation}(X, {of})"))
    }

    /// What is ahead of the robot, behind it or at its sides, in its room, nearest first.
    fn beside_robot(&self, rel: Rel) -> Vec<Thing> {
        let Some((map, pose)) = self.senses.robot() else { return Vec::new() };
        let relation = match rel {
            Rel::InFrontOf => "AHEAD_OF_ROBOT",
            Rel::Behind => "BEHIND_ROBOT",
            Rel::LeftOf => "LEFT_OF_ROBOT",
            _ => "RIGHT_OF_ROBOT",
        };
        let found = self.things_asked(&format!("?- {relation}(X)"));
        nearest_first(found.into_iter(), |id| self.relations.distance_to_point(id, map, pose.at))
    }

    /// The things of the first column of a question's answers.
    pub(super) fn things_asked(&self, question: &str) -> Vec<Thing> {
        let rows = self.relations.found(&self.around(), question);
        let thing = |row: &Vec<Value>| match row.first() {
            Some(Value::Symbol(symbol)) => self.thing(symbol),
            _ => None,
        };
        rows.iter().filter_map(thing).collect()
    }

    /// Whether a relation holds of two things; being on and in is passed on by what stands between.
    pub(in crate::question) fn holds(&self, rel: Rel, x: Thing, y: Thing) -> bool {
        if self.related(rel, y).contains(&x) {
            return true;
        }
        if !matches!(rel, Rel::On | Rel::In) {
            return false;
        }
        let chain = self.support_chain(x);
        let Some(at) = chain.iter().position(|under| *under == y) else { return false };
        let last = at.checked_sub(1).map_or(x, |before| chain[before]);
        let has = |wanted| y.replica().is_some_and(|id| self.world.has_trait(id, wanted));
        // What is in a dresser is not on it, and what stands on a fridge is not in it; whoever says "in the bed" means on it.
        match self.on_or_in(last, y) {
            Rel::In => rel == Rel::In || has("shelves"),
            _ => rel == Rel::On || !has("container"),
        }
    }

    /// What a thing lies on or in itself, and on what it lies by that, the nearest first.
    pub(in crate::question) fn borne_by(&self, thing: Thing) -> Vec<Thing> {
        let mut chain = self.support_chain(thing);
        let mut is_first = true;
        chain.retain(|under| {
            std::mem::take(&mut is_first) || self.tuple(Rel::On, thing, *under).is_some()
        });
        chain
    }

    /// What a thing stands on or lies in, what that stands on, and so on.
    pub(in crate::question) fn support_chain(&self, thing: Thing) -> Vec<Thing> {
        let mut chain = Vec::new();
        let mut at = thing.replica();
        while let Some(id) = at.and_then(|id| self.relations.support_of(id)) {
            let support = Thing::Entity(Entity::Replica(id));
            if chain.contains(&support) {
                break;
            }
            chain.push(support);
            at = Some(id);
        }
        chain
    }
}

/// Things that have a distance, the nearest first, each once.
fn nearest_first(
    things: impl Iterator<Item = Thing>,
    distance: impl Fn(ReplicaId) -> Option<f64>,
) -> Vec<Thing> {
    let away = things.filter_map(|t| Some((distance(t.replica()?)?, t)));
    let mut near: Vec<(f64, Thing)> = away.collect();
    near.order_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    near.dedup_by_key(|(_, t)| *t);
    near.into_iter().map(|(_, t)| t).collect()
}
