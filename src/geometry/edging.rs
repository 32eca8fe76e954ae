//! What can stand along the borders of a Fragment's Passframes: doorways, faces of things, walls.
//!
//! The things and walls are the floor's own. Kept besides is what only the world knows: where the doorways are, and
//! which faces are not plain, that is, have names or let something through.

use crate::map::{BaseVector, Permeability};
use crate::units::{AreaId, InOrder as _, Point};

use super::blocker::{Blocker, Obstacle};
use super::passframe::Beyond;
use super::site::Site;
use super::storey::Side;

/// Something that can stand along a border.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Face {
    pub(super) start: Point,
    pub(super) end: Point,
    pub(super) beyond: Beyond,
    pub(super) permeability: Permeability,
    pub(super) names: Vec<String>,
}

/// A face that has names or lets something through.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Mark {
    pub(super) blocker: Blocker,
    pub(super) side: usize,
    pub(super) permeability: Permeability,
    pub(super) names: Vec<String>,
}

/// What the faces along a Fragment's borders are told from, besides its things and walls.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Edging {
    pub(super) doorways: Vec<Face>,
    pub(super) sides: Vec<Side>,
    /// Sorted by what they belong to.
    pub(super) marks: Vec<Mark>,
}

impl Edging {
    pub(super) fn of(
        site: &Site<'_>,
        area: AreaId,
        obstacles: &[Obstacle],
        sides: Vec<Side>,
    ) -> Self {
        let mut marks: Vec<Mark> = Vec::new();
        let mut mark = |blocker: Blocker, side: usize, vector: &BaseVector| {
            // What leads nowhere is a wall.
            let permeability = match blocker {
                Blocker::Wall { .. } => Permeability::Impermeable,
                _ => vector.permeability,
            };
            if permeability != Permeability::Impermeable || !vector.names.is_empty() {
                let names = vector.names.clone();
                marks.push(Mark { blocker, side, permeability, names });
            }
        };
        for obstacle in obstacles {
            let base = base_of(site, obstacle.blocker).unwrap_or_default();
            for (side, vector) in base.iter().enumerate() {
                mark(obstacle.blocker, side, vector);
            }
        }
        for Side { item, side, .. } in &sides {
            let (item, side) = (*item, *side);
            if let Some(vector) = side_of(site, area, item, side) {
                mark(Blocker::Wall { area, item, side }, side, vector);
            }
        }
        let place = |m: &Mark| (m.blocker, m.side);
        marks.order_by_key(place);
        // A thing without thickness takes floor as several strips.
        marks.dedup_by_key(|m| place(m));
        marks.shrink_to_fit();
        Self { doorways: doorway_faces(site, area, &sides), sides, marks }
    }
}

fn doorway_faces(site: &Site<'_>, area: AreaId, sides: &[Side]) -> Vec<Face> {
    let items = &site.world.areas[&area].items;
    let mut faces = Vec::new();
    for (index, doorway, at) in site.doorways_of(area) {
        let beyond =
            Beyond::Doorway { doorway: index, door: doorway.door, area: doorway.areas[1 - at] };
        let reference = &doorway.sides[at].side;
        let own = sides.iter().filter(|s| items[s.item].id == reference.item);
        let names = own
            .filter_map(|s| side_of(site, area, s.item, s.side))
            .find(|vector| vector.id == reference.side)
            .map_or_else(Vec::new, |vector| vector.names.clone());
        let face = if at == 0 { 0.0 } else { doorway.gap };
        let (t0, t1) = doorway.span();
        // Open, the Fragment ends on the line; closed, on its side of the wall.
        for s in [doorway.gap / 2.0, face] {
            faces.push(Face {
                start: doorway.at(t0, s),
                end: doorway.at(t1, s),
                beyond,
                permeability: doorway.permeability,
                names: names.clone(),
            });
        }
    }
    faces.shrink_to_fit();
    faces
}

/// The vector of an Area's side.
fn side_of<'a>(site: &Site<'a>, area: AreaId, item: usize, side: usize) -> Option<&'a BaseVector> {
    let item = site.world.areas[&area].items.get(item)?;
    site.world.orthoframe_of(item).base.get(side)
}

/// The base vectors of the Orthoframe that a thing's part is; none of a plain one.
fn base_of<'a>(site: &Site<'a>, blocker: Blocker) -> Option<&'a [BaseVector]> {
    let Blocker::Replica { replica, item } = blocker else { return None };
    if site.scene.replicas.get(&replica)?.prisms.get(item)?.is_plain {
        return None;
    }
    let object = site.world.objects.get(&site.world.replicas.get(&replica)?.object)?;
    Some(&site.world.orthoframe_of(object.items.get(item)?).base)
}
