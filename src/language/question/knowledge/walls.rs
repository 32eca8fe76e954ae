//! What stands at the walls of a room, in its corners, and what hangs on them.
//!
//! Invariant: walls are the impermeable sides of the room's own Orthoframes; what stands at them the rules say.

use super::Knowledge;
use crate::map::Entity;
use crate::question::Doubt;
use crate::question::lexicon::Extension;
use crate::question::query::{Noun, Rel, Restriction, Thing};
use crate::question::values::{Property, ValueId};
use crate::units::{AreaId, Gather as _, Point};
use crate::words::Language;
use std::collections::{BTreeSet, HashSet};

/// How a room holds a thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::question) enum Held {
    OnWall,
    /// On the floor, and there near two walls that meet.
    InCorner,
    /// On the floor at a wall.
    AtWall,
    OnFloor,
}

impl Knowledge<'_> {
    /// Whether a noun means walls or corners, which have no names of their own.
    pub(in crate::question) fn is_walls(&self, noun: &Noun) -> bool {
        let is_wall = |e: &Extension| matches!(e, Extension::Walls | Extension::Corners);
        noun.head.named.is_empty()
            && !noun.head.kinds.is_empty()
            && noun.head.kinds.iter().all(|k| is_wall(&self.lexicon().kind(*k).extension))
    }

    /// What stands at walls or in corners, or hangs on a wall; none where the noun means neither.
    pub(super) fn at_walls(&self, rel: Rel, noun: &Noun) -> Result<Option<HashSet<Thing>>, Doubt> {
        if !self.is_walls(noun) {
            return Ok(None);
        }
        let mut rooms: BTreeSet<AreaId> = self.world.areas.keys().copied().gather();
        for restriction in &noun.restrictions {
            for anchor in &restriction.anchors {
                let meant: HashSet<AreaId> =
                    self.find(anchor, true)?.into_iter().filter_map(Thing::area).collect();
                // «у стены напротив телевизора»: walls are told by their rooms alone.
                if meant.is_empty() {
                    return Err(Doubt::NotUnderstood { words: noun.text.clone() });
                }
                rooms.retain(|room| meant.contains(room));
            }
        }
        let relation = self.wall_relation(rel, noun);
        let mut found = HashSet::new();
        if let Some(pairs) = self.pairs(relation) {
            for room in rooms {
                let here = pairs.backward.get(&Thing::Entity(Entity::Area(room)));
                found.extend(here.into_iter().flatten());
            }
        }
        Ok(Some(found))
    }
}

/// A value, if it is one that is known, and its words.
pub(in crate::question) type Kept = (Option<ValueId>, String);

impl Knowledge<'_> {
    /// What the map keeps of the floor or the walls of a room, which have no names of their own.
    pub(in crate::question) fn kept_of_surface(
        &self,
        room: Thing,
        property: &Property,
        surface: &Noun,
    ) -> Option<Kept> {
        let surface = if self.is_floor(surface) { "ПОЛА" } else { "СТЕН" };
        let key = Property::of(&format!("{} {surface}", property.noun(Language::Russian)));
        let own = self.values(room).into_iter().find(|(property, _, _)| *property == key);
        own.map(|(_, value, text)| (value, text))
    }

    /// "Rooms with a wooden floor", «комнаты с белыми стенами»: those of some rooms of which the map keeps it. None where no
    /// surface is described.
    ///
    /// # Errors
    /// The map tells it of none of them.
    pub(super) fn with_surface(
        &self,
        restriction: &Restriction,
        rooms: &[Thing],
    ) -> Result<Option<Vec<Thing>>, Doubt> {
        let [surface] = &restriction.anchors[..] else { return Ok(None) };
        let is_surface = self.is_floor(surface) || self.is_walls(surface);
        let of_rooms = !rooms.is_empty() && rooms.iter().all(|room| room.area().is_some());
        let described = !surface.filters.is_empty() && restriction.rel == Rel::Has;
        if !(is_surface && of_rooms && described) {
            return Ok(None);
        }
        let values = &self.lexicon().values;
        let mut fitting = rooms.to_vec();
        for filter in &surface.filters {
            let property = &values.entry(filter.value).property;
            let kept = |room: &Thing| self.kept_of_surface(*room, property, surface)?.0;
            let denied = filter.negated || restriction.negated;
            let is = |own| filter.values().any(|wanted| values.is(own, wanted)) != denied;
            fitting.retain(|room| kept(room).is_some_and(is));
            // Of some it is not known.
            if fitting.is_empty() && rooms.iter().any(|room| kept(room).is_none()) {
                return Err(Doubt::NotUnderstood { words: surface.text.clone() });
            }
        }
        Ok(Some(fitting))
    }

    /// What stands between a thing and the walls near to it.
    pub(super) fn between_walls(&self, thing: Thing) -> HashSet<Thing> {
        let Some(id) = thing.replica() else { return HashSet::new() };
        let found = self.relations.before_walls(&self.around(), id).into_iter();
        found.map(|id| Thing::Entity(Entity::Replica(id))).collect()
    }

    /// The relation of the rules that says what is at walls, on them or in corners.
    fn wall_relation(&self, rel: Rel, noun: &Noun) -> &'static str {
        let corner = |k: &_| self.lexicon().kind(*k).extension == Extension::Corners;
        match (noun.head.kinds.iter().any(corner), rel) {
            (true, _) => "IN_CORNER",
            (false, Rel::On) => "ON_WALL",
            _ => "AT_WALL",
        }
    }

    /// The relation and the room that make a thing stand at walls or on the floor, where a noun means these.
    pub(in crate::question) fn stands_in(
        &self,
        rel: Rel,
        thing: Thing,
        noun: &Noun,
    ) -> Option<(&'static str, Thing)> {
        let relation = match (self.is_walls(noun), self.is_floor(noun)) {
            (true, _) => self.wall_relation(rel, noun),
            (false, true) => "STANDS_ON_FLOOR",
            (false, false) => return None,
        };
        let room = *self.pairs(relation)?.forward.get(&thing)?.first()?;
        Some((relation, room))
    }

    /// Whether a thing stands so in some room, by a relation of the rules.
    pub(in crate::question) fn stands_so(&self, relation: &str, thing: Thing) -> bool {
        self.pairs(relation).is_some_and(|pairs| pairs.forward.contains_key(&thing))
    }

    /// How a thing that nothing bears is held by its room: on the floor, on a wall, or in no way that is known.
    pub(in crate::question) fn held_by_room(&self, thing: Thing) -> Option<Held> {
        thing.replica().filter(|id| self.relations.support_of(*id).is_none())?;
        let held = [
            ("ON_WALL", Held::OnWall),
            ("IN_CORNER", Held::InCorner),
            ("AT_WALL", Held::AtWall),
            ("STANDS_ON_FLOOR", Held::OnFloor),
        ];
        held.into_iter().find(|(relation, _)| self.stands_so(relation, thing)).map(|(_, held)| held)
    }

    /// The walls at which a thing stands, each by what opens in it: doors, passages and windows. None where it stands
    /// at no wall.
    pub(in crate::question) fn own_walls(&self, thing: Thing) -> Option<Vec<Thing>> {
        let area = self.area_of(thing).filter(|_| self.stands_so("AT_WALL", thing))?;
        let (measured, near) = (self.relations.measurements(), self.relations.thresholds());
        let walls: Vec<(Point, Point)> = measured.walls(area).collect();
        let own = &measured.of_thing(thing.replica()?)?.walls;
        let own = own.iter().filter(|(_, away)| *away as f64 / 100.0 <= near.wall_gap);
        let own: Vec<(Point, Point)> = own.filter_map(|(n, _)| walls.get(*n).copied()).collect();
        let gates = self.openings().iter().filter(|g| g.areas.contains(&area));
        let windows = self.lexicon().windows.iter().enumerate().filter(|(_, w)| w.area == area);
        let windows = windows.map(|(n, w)| (Thing::Window(n as u32), w.ends));
        let openings = gates.filter_map(|g| Some((g.thing, self.ends_of(g)?))).chain(windows);
        let in_own = |ends| own.iter().any(|wall| in_line(*wall, ends, near.wall_line));
        Some(openings.filter(|(_, ends)| in_own(*ends)).map(|(thing, _)| thing).collect())
    }
}

/// Whether a segment lies in the line of a wall, so far off it at most.
fn in_line(wall: (Point, Point), ends: (Point, Point), off: f64) -> bool {
    let Some(along) = (wall.1 - wall.0).try_normalize(1e-9) else { return false };
    [ends.0, ends.1].iter().all(|p| along.perp(&(p - wall.0)).abs() <= off)
}
