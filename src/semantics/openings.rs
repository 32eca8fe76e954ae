//! Doors and passages between Areas: which links bind them, and where one comes out by stepping through (SPEC R1).
//!
//! A link of the Map says which Areas an opening joins. Where there is none, one step off each side of it, along the
//! normal, tells in which Areas one stands:
//!
//! ```text
//!        Area 1         | wall |        Area 2
//!          x <----------[ door ]----------> x
//!        inward                         outward
//! ```

use std::collections::{BTreeMap, BTreeSet};

use crate::geometry::contact::Footprint;
use crate::geometry::{Bounds, clear_width};
use crate::map::{Door, Permeability, SideRef, World};
use crate::units::{AreaId, Cm, DoorId, Point, Vector};

use super::measure::{Measurements, Room};
use super::names::Symbols;

/// A step this long beyond a border stands on the floor behind it, in cm.
const FOOTHOLD: f64 = 0.5;

/// A door or a passage in the side of an Area.
#[derive(Debug, Clone, PartialEq)]
pub struct Opening {
    /// Its name in the facts: the door's, or one made of the Areas that it joins. Both sides of one opening share it.
    pub name: String,
    /// The Area whose side it is.
    pub area: AreaId,
    pub side: SideRef,
    /// Start and end of the side, in the Map's frame.
    pub ends: (Point, Point),
    pub door: Option<DoorId>,
    /// Conditional: a door. Permeable: a passage.
    pub permeability: Permeability,
    pub width: f64,
    pub height: f64,
    /// Width left free by the leaves as they stand.
    pub clear_width: f64,
    /// The other Area of the link, where the Map binds this side.
    pub linked: Option<AreaId>,
    /// The Areas on either side within the reach of a step, with the way to them in cm.
    pub inward: Option<(AreaId, f64)>,
    pub outward: Option<(AreaId, f64)>,
}

impl Opening {
    /// The Area behind it: by the link, else by stepping through.
    #[must_use]
    pub fn leads_to(&self) -> Option<AreaId> {
        self.linked.or(self.outward.map(|(area, _)| area))
    }
}

/// All openings of all Areas, in the order of the open borders that were measured: those of Areas, items and sides.
pub(super) fn openings(
    world: &World,
    measured: &Measurements,
    reach: f64,
    symbols: &Symbols,
) -> Vec<Opening> {
    let mut found = sides(world, measured, reach);
    name(world, &mut found, reach, symbols);
    found
}

/// Every open side of an Area by itself.
fn sides(world: &World, measured: &Measurements, reach: f64) -> Vec<Opening> {
    let links = links(world);
    let mut found = Vec::new();
    for border in &measured.borders.open {
        let area = &world.areas[&border.area];
        let item = &area.items[border.item];
        let orthoframe = world.orthoframe_of(item);
        let vector = &orthoframe.base[border.side];
        let side = SideRef { item: item.id.clone(), side: vector.id.clone() };
        let ends = border.ends;
        let mount = area.doors.iter().find(|m| m.item == side.item && m.side == side.side);
        let door = mount.and_then(|m| world.doors.get(&m.door));
        let width = vector.length().get();
        let step = |sign: f64| step_off(measured, area.id, ends, sign, reach);
        let outward = step(1.0);
        found.push(Opening {
            name: String::new(),
            area: area.id,
            ends,
            door: door.map(|d| d.id),
            permeability: vector.permeability,
            width,
            height: door.map_or(orthoframe.height, |d| d.height).get(),
            clear_width: door.map_or(width, |d| left_free(d, width, outward)),
            linked: links.get(&(area.id, side.clone())).copied(),
            inward: step(-1.0),
            outward,
            side,
        });
    }
    found
}

/// Gives both sides of an opening one name, and the door to the side that does not mount it.
fn name(world: &World, openings: &mut [Opening], reach: f64, symbols: &Symbols) {
    let mut by_area: BTreeMap<AreaId, Vec<usize>> = BTreeMap::new();
    for (i, opening) in openings.iter().enumerate() {
        by_area.entry(opening.area).or_default().push(i);
    }
    let middle = |o: &Opening| nalgebra::center(&o.ends.0, &o.ends.1);
    let mut taken = BTreeSet::new();
    for i in 0..openings.len() {
        let here = &openings[i];
        let behind = here.leads_to().and_then(|area| by_area.get(&area));
        let other_side = behind.into_iter().flatten().copied().filter(|&j| {
            let there = &openings[j];
            j != i
                && there.leads_to() == Some(here.area)
                && (middle(there) - middle(here)).norm() <= reach + here.width / 2.0
        });
        let nearest = other_side.min_by(|&j, &k| {
            let way = |n: usize| (middle(&openings[n]) - middle(here)).norm();
            way(j).total_cmp(&way(k))
        });
        let there = nearest.map(|j| (openings[j].name.clone(), openings[j].door));
        let here = &mut openings[i];
        if here.door.is_none()
            && let Some(door) = there.as_ref().and_then(|t| t.1).and_then(|d| world.doors.get(&d))
        {
            here.door = Some(door.id);
            here.clear_width = left_free(door, here.width, here.outward);
        }
        here.name = match (here.door, there) {
            (Some(door), _) => symbols.door(door).to_string(),
            (None, Some((name, _))) if !name.is_empty() => name,
            _ => new_name(here, symbols, &mut taken),
        };
    }
}

/// «Проход-А-Б», with a number when there are several.
fn new_name(opening: &Opening, symbols: &Symbols, taken: &mut BTreeSet<String>) -> String {
    let kind = if opening.permeability == Permeability::Conditional {
        "Дверь"
    } else {
        "Проход"
    };
    let mut name = format!("{kind}-{}", symbols.area(opening.area));
    if let Some(other) = opening.leads_to() {
        name = format!("{name}-{}", symbols.area(other));
    }
    (1..)
        .map(|n| if n == 1 { name.clone() } else { format!("{name}-{n}") })
        .find(|n| symbols.subject(n).is_none() && taken.insert(n.clone()))
        .expect("the numbers do not end")
}

/// Both ends of every link between permeable sides, each with the Area at the other end.
fn links(world: &World) -> BTreeMap<(AreaId, SideRef), AreaId> {
    let links = world.maps.values().flat_map(|m| &m.links);
    links
        .flat_map(|l| {
            [((l.area, l.side.clone()), l.to_area), ((l.to_area, l.to_side.clone()), l.area)]
        })
        .collect()
}

/// An open side between two items of one Area leads nowhere else.
pub(super) fn joins_own_items(room: &Room, (a, b): (Point, Point)) -> bool {
    let middle = nalgebra::center(&a, &b);
    outward_normal(a, b).is_none_or(|n| {
        let outside = middle + n * FOOTHOLD;
        room.parts.iter().any(|(f, _, _)| f.contains(outside))
    })
}

/// Counter-clockwise round the Area, so the outside is on the right.
pub(super) fn outward_normal(a: Point, b: Point) -> Option<Vector> {
    let along = (b - a).try_normalize(1e-9)?;
    Some(Vector::new(along.y, -along.x))
}

/// The first Area met when stepping off a side, out of the Area (`sign` 1) or into it (-1), at its middle or its quarters.
fn step_off(
    measured: &Measurements,
    from: AreaId,
    (a, b): (Point, Point),
    sign: f64,
    reach: f64,
) -> Option<(AreaId, f64)> {
    let way = outward_normal(a, b)? * sign;
    let here = &measured.rooms[&from];
    let mut near = Vec::new();
    [0.5, 0.25, 0.75].iter().find_map(|share| {
        let start = a + (b - a) * *share;
        let swept = Bounds::of([start, start + way * (reach + FOOTHOLD)]);
        measured.rooms_near(here.map, &swept, &mut near);
        let others = near.iter().map(|id| &measured.rooms[id]).filter(|r| {
            (sign < 0.0 || r.id != from)
                && r.bounds.meets(&swept)
                && same_storey(&here.parts, &r.parts)
        });
        others
            .filter_map(|room| Some((room.id, first_floor(room, start, way, reach)?)))
            .min_by(|x, y| x.1.total_cmp(&y.1))
    })
}

type Parts = [(Footprint, f64, f64)];

fn same_storey(a: &Parts, b: &Parts) -> bool {
    a.iter().any(|(_, low, high)| b.iter().any(|(_, l, h)| low < h && l < high))
}

/// How far along `way` the floor of a room begins.
fn first_floor(room: &Room, start: Point, way: Vector, reach: f64) -> Option<f64> {
    let stands = |t: f64| {
        let p = start + way * (t + FOOTHOLD);
        room.parts.iter().any(|(f, _, _)| f.contains(p))
    };
    let edges = room.parts.iter().flat_map(|(f, _, _)| f.polygon.edges());
    let crossings = edges.filter_map(|(p, q)| {
        let along = q - p;
        let turn = way.perp(&along);
        if turn.abs() < 1e-12 {
            return None;
        }
        let to = p - start;
        let (t, s) = (to.perp(&along) / turn, to.perp(&way) / turn);
        ((0.0..=reach).contains(&t) && (-1e-9..=1.0 + 1e-9).contains(&s)).then_some(t)
    });
    crossings.chain([0.0]).filter(|&t| stands(t)).reduce(f64::min)
}

/// Width that a door's leaves leave free as they stand.
fn left_free(door: &Door, width: f64, outward: Option<(AreaId, f64)>) -> f64 {
    let own = door.width.get();
    let width = if own > 0.0 { width.min(own) } else { width };
    Cm::of(clear_width(door, door.state, width, outward.map_or(0.0, |o| o.1))).get()
}
