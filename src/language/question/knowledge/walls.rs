//! What stands at the walls of a room, in its corners, and what hangs on them.
//!
//! Invariant: walls are the impermeable sides of the room's own Orthoframes; what is said of them is measured.

use super::Knowledge;
use crate::language::question::Doubt;
use crate::language::question::lexicon::Extension;
use crate::language::question::query::{Noun, Rel, Thing};
use crate::map::Entity;
use crate::semantics::walls;
use crate::units::{AreaId, Point, ReplicaId};
use std::collections::{BTreeSet, HashSet};

/// Furniture this near to a wall stands at it, cm.
const AT_WALL: f64 = 30.0;
/// Both walls of a corner are this near to what stands in it, cm.
const IN_CORNER: f64 = 50.0;
/// What hangs on a wall is this near to it, cm.
const HANGING: f64 = 8.0;

/// How a room holds a thing.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::language::question) enum Held {
    OnWall,
    /// On the floor, and there near two walls that meet.
    InCorner,
    /// On the floor at a wall.
    AtWall,
    OnFloor,
}

impl Knowledge<'_> {
    /// Whether a noun means walls or corners, which have no names of their own.
    pub(in crate::language::question) fn is_walls(&self, noun: &Noun) -> bool {
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
        let corners =
            noun.head.kinds.iter().any(|k| self.lexicon().kind(*k).extension == Extension::Corners);
        let mut rooms: BTreeSet<AreaId> = self.world.areas.keys().copied().collect();
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
        let on_floor: HashSet<ReplicaId> = self.on_floor().iter().copied().collect();
        let mut found = HashSet::new();
        for room in rooms {
            let sides = walls(self.world, self.relations.measurements(), room);
            let all = self.related(Rel::In, Thing::Entity(Entity::Area(room)));
            for thing in all {
                let Some(id) = thing.replica() else { continue };
                let near: Vec<(Point, Point)> = sides
                    .iter()
                    .copied()
                    .filter(|side| {
                        let reach = match (corners, rel) {
                            (true, _) => IN_CORNER,
                            (false, Rel::On) => HANGING,
                            _ => AT_WALL,
                        };
                        self.relations.distance_to_segment(id, *side).is_some_and(|d| d <= reach)
                    })
                    .collect();
                let fits = match (corners, rel) {
                    (true, _) => on_floor.contains(&id) && meet(&near),
                    (false, Rel::On) => {
                        !near.is_empty()
                            && !on_floor.contains(&id)
                            && self.relations.support_of(id).is_none()
                    }
                    _ => on_floor.contains(&id) && !near.is_empty(),
                };
                if fits {
                    found.insert(thing);
                }
            }
        }
        Ok(Some(found))
    }
}

/// How far from a wall a thing may stand so that people speak of what is between them, cm.
const BEFORE_WALL: f64 = 150.0;

impl Knowledge<'_> {
    fn walls_about(&self, thing: Thing) -> Vec<(Point, Point)> {
        let area = self.area_of(thing);
        area.map(|area| walls(self.world, self.relations.measurements(), area)).unwrap_or_default()
    }

    /// What stands between a thing and the walls near to it.
    pub(super) fn between_walls(&self, thing: Thing) -> HashSet<Thing> {
        let Some(id) = thing.replica() else { return HashSet::new() };
        let all = self.walls_about(thing).into_iter();
        let near = all.filter_map(|wall| self.relations.before_wall(id, wall));
        let near = near.filter(|(away, _)| *away <= BEFORE_WALL);
        near.flat_map(|(_, found)| found).map(|id| Thing::Entity(Entity::Replica(id))).collect()
    }

    /// How a thing that nothing bears is held by its room: on the floor, on a wall, or in no way that is known.
    pub(in crate::language::question) fn held_by_room(&self, thing: Thing) -> Option<Held> {
        let id = thing.replica().filter(|id| self.relations.support_of(*id).is_none())?;
        let near = |reach: f64| {
            let sides = self.walls_about(thing).into_iter();
            let within = |side: &_| {
                self.relations.distance_to_segment(id, *side).is_some_and(|d| d <= reach)
            };
            sides.filter(within).collect::<Vec<_>>()
        };
        if !self.on_floor().contains(&id) {
            return (!near(HANGING).is_empty()).then_some(Held::OnWall);
        }
        Some(match (meet(&near(IN_CORNER)), near(AT_WALL).is_empty()) {
            (true, _) => Held::InCorner,
            (false, false) => Held::AtWall,
            (false, true) => Held::OnFloor,
        })
    }

    /// The walls at which a thing stands, each by what opens in it: doors, passages and windows. None where it stands
    /// at no wall.
    pub(in crate::language::question) fn own_walls(&self, thing: Thing) -> Option<Vec<Thing>> {
        let (id, area) = (thing.replica()?, self.area_of(thing)?);
        let at = |wall: &(Point, Point)| {
            self.relations.distance_to_segment(id, *wall).is_some_and(|d| d <= AT_WALL)
        };
        let near: Vec<(Point, Point)> = self.walls_about(thing).into_iter().filter(at).collect();
        if near.is_empty() {
            return None;
        }
        let gates = self.gates().iter().filter(|g| g.areas.contains(&area));
        let windows = self.lexicon().windows.iter().enumerate().filter(|(_, w)| w.area == area);
        let windows = windows.map(|(n, w)| (Thing::Window(n as u32), w.ends));
        let openings = gates.map(|g| (g.thing, g.ends)).chain(windows);
        let along = openings.filter(|(_, ends)| near.iter().any(|wall| in_line(*wall, *ends)));
        Some(along.map(|(thing, _)| thing).collect())
    }
}

/// Whether a segment lies in the line of a wall.
fn in_line(wall: (Point, Point), ends: (Point, Point)) -> bool {
    // As thick as walls are, cm.
    const OFF: f64 = 30.0;
    let Some(along) = (wall.1 - wall.0).try_normalize(1e-9) else { return false };
    [ends.0, ends.1].iter().all(|p| along.perp(&(p - wall.0)).abs() <= OFF)
}

/// Whether two of these walls, which go counter-clockwise about the room, meet in an inner corner.
fn meet(sides: &[(Point, Point)]) -> bool {
    // Turned by more than 30°; ends of neighbouring sides may lie a grid step apart.
    const TURN: f64 = 0.5;
    const GAP: f64 = 2.0;
    sides.iter().any(|(a, b)| {
        sides.iter().any(|(c, d)| {
            let (Some(u), Some(v)) = ((b - a).try_normalize(1e-9), (d - c).try_normalize(1e-9))
            else {
                return false;
            };
            (c - b).norm() <= GAP && u.perp(&v) > TURN
        })
    })
}
