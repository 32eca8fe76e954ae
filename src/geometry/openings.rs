//! All doors and passages of a building, each once (SPEC R1, M7).
//!
//! A side of an Area and a side of another make one opening: linked sides first, then those on which one door is mounted,
//! then sides that face each other through a wall, then sides each of which is met by stepping through the other:
//!
//! ```text
//!        Area 1         | wall |        Area 2
//!          x <----------[ door ]----------> x
//!        inward                         outward
//! ```
//!
//! A side that finds no other is an opening by itself. Which Areas an opening joins is measured here and decided by the
//! rules, which hold what was measured against their thresholds: [`Openings::decide`].
//!
//! **Invariant**: an opening's id is its place; things that stand about and the states of doors change nothing here.

use std::collections::BTreeMap;

use crate::map::{Permeability, SideRef, World};
use crate::units::{AreaId, DoorId, MapId, OpeningId, Point, Vector};

use super::buckets::Buckets;
use super::opening::{OpenSide, Opening};
use super::scene::PlacedArea;
use super::{Bounds, Polygon, Scene};

/// How far a step through a side looks where no rules say it, in cm: a thick wall.
pub const STEP_REACH: f64 = 60.0;

/// A step this long beyond a border stands on the floor behind it, in cm.
const FOOTHOLD: f64 = 0.5;

/// Points this near to a floor's border lie on it, in cm.
const ON_BORDER: f64 = 1e-6;

/// The openings of all Maps, by their ids.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Openings {
    all: Vec<Opening>,
    by_side: BTreeMap<(AreaId, SideRef), OpeningId>,
}

impl std::ops::Deref for Openings {
    type Target = [Opening];

    fn deref(&self) -> &[Opening] {
        &self.all
    }
}

impl Openings {
    /// Measures the openings of all Maps; sides are looked for through walls up to `reach` cm thick. Until rules decide,
    /// each joins the Areas of its two sides.
    #[must_use]
    pub fn of(world: &World, reach: f64) -> Self {
        let mut all = Vec::new();
        for &map in world.maps.keys() {
            all.extend(openings_of(world, map, reach));
        }
        let mut by_side = BTreeMap::new();
        for (place, opening) in all.iter_mut().enumerate() {
            opening.id = OpeningId(place as u32);
            let sides = opening.sides.iter();
            by_side.extend(sides.map(|side| ((side.area, side.side.clone()), opening.id)));
        }
        Self { all, by_side }
    }

    #[must_use]
    pub fn opening(&self, id: OpeningId) -> Option<&Opening> {
        self.all.get(id.0 as usize)
    }

    /// The opening that a side of an Area belongs to.
    #[must_use]
    pub fn of_side(&self, area: AreaId, side: &SideRef) -> Option<&Opening> {
        self.opening(*self.by_side.get(&(area, side.clone()))?)
    }

    /// The openings in an Area's sides, and those that the rules join to it.
    pub fn of_area(&self, area: AreaId) -> impl Iterator<Item = &Opening> + '_ {
        self.all.iter().filter(move |opening| opening.is_of(area))
    }

    /// Gives every opening its name in the facts.
    pub fn name(&mut self, mut name: impl FnMut(&Opening) -> String) {
        for opening in &mut self.all {
            opening.name = name(opening);
        }
    }

    /// Takes over what the rules decide: of each opening, in their order, the pairs of Areas that it joins, the lower id
    /// first.
    pub fn decide(&mut self, decided: Vec<Vec<[AreaId; 2]>>) {
        for (opening, joins) in self.all.iter_mut().zip(decided) {
            opening.joins = joins;
        }
    }
}

/// The openings of a Map, in the order of their first sides.
fn openings_of(world: &World, map: MapId, reach: f64) -> Vec<Opening> {
    let areas = Scene::areas_of(world, map);
    let sides: Vec<OpenSide> = areas.values().flat_map(|area| open_sides(world, area)).collect();
    let mut maker =
        Pairs { world, map, open: sides.into_iter().map(Some).collect(), found: vec![] };
    maker.link(world);
    maker.facing(reach);
    maker.step_off(&areas, reach);
    maker.meeting(reach);
    maker.blind(&areas);
    maker.found.sort_by_key(|(first, _)| *first);
    maker.found.into_iter().map(|(_, opening)| opening).collect()
}

/// Sides that still look for another, and what was made of the others.
struct Pairs<'w> {
    world: &'w World,
    map: MapId,
    open: Vec<Option<OpenSide>>,
    /// Each with the place of its first side.
    found: Vec<(usize, Opening)>,
}

impl Pairs<'_> {
    /// Makes one opening of two sides of two Areas that have a width in common.
    fn pair(&mut self, i: usize, j: usize) {
        let (Some(a), Some(b)) = (self.open[i].as_ref(), self.open[j].as_ref()) else { return };
        if a.area != b.area
            && let Some(opening) = Opening::between(self.world, self.map, a, b)
        {
            self.found.push((i.min(j), opening));
            (self.open[i], self.open[j]) = (None, None);
        }
    }

    /// The sides that the Map links, then those that one door closes.
    fn link(&mut self, world: &World) {
        let mut places: BTreeMap<(AreaId, SideRef), usize> = BTreeMap::new();
        let mut by_door: BTreeMap<DoorId, Vec<usize>> = BTreeMap::new();
        for (i, side) in self.open.iter().enumerate() {
            let Some(side) = side else { continue };
            places.entry((side.area, side.side.clone())).or_insert(i);
            if let Some(mount) = &side.mount {
                by_door.entry(mount.door).or_default().push(i);
            }
        }
        let mut linked = Vec::new();
        for link in world.maps.values().flat_map(|map| &map.links) {
            let place = |area, side: &SideRef| places.get(&(area, side.clone())).copied();
            let ends = [place(link.area, &link.side), place(link.to_area, &link.to_side)];
            for (end, other) in ends.into_iter().zip([link.to_area, link.area]) {
                if let Some(side) = end.and_then(|end| self.open[end].as_mut()) {
                    side.linked = Some(other);
                }
            }
            if let [Some(i), Some(j)] = ends {
                linked.push((i, j));
            }
        }
        linked.into_iter().for_each(|(i, j)| self.pair(i, j));
        for sides in by_door.values() {
            for (k, &i) in sides.iter().enumerate() {
                sides[k + 1..].iter().for_each(|&j| self.pair(i, j));
            }
        }
    }

    fn facing(&mut self, reach: f64) {
        let around = |side: &Option<OpenSide>| {
            side.as_ref()
                .map_or(Bounds::EMPTY, |s| Bounds::of([s.ends.0, s.ends.1]).grown(reach + 1.0))
        };
        let boxes: Vec<Bounds> = self.open.iter().map(around).collect();
        let (buckets, mut near) = (Buckets::of(&boxes), Vec::new());
        for (i, own) in boxes.iter().enumerate() {
            buckets.meeting(own, &mut near);
            for &j in near.iter().filter(|&&j| j as usize > i) {
                let j = j as usize;
                let faces = self.open[i].as_ref().zip(self.open[j].as_ref());
                if faces.is_some_and(|(a, b)| face_each_other(a, b, reach)) {
                    self.pair(i, j);
                }
            }
        }
    }

    /// Steps through every side, of those that are paired too.
    fn step_off(&mut self, areas: &BTreeMap<AreaId, PlacedArea>, reach: f64) {
        let floors = Floors::of(areas);
        let paired = self.found.iter_mut().flat_map(|(_, opening)| &mut opening.sides);
        for side in self.open.iter_mut().flatten().chain(paired) {
            side.inward = floors.met(side, -1.0, reach);
            side.outward = floors.met(side, 1.0, reach);
        }
    }

    /// Sides each of which leads into the other's Area, the nearest first.
    fn meeting(&mut self, reach: f64) {
        let mut by_area: BTreeMap<AreaId, Vec<usize>> = BTreeMap::new();
        for (i, side) in self.open.iter().enumerate() {
            if let Some(side) = side {
                by_area.entry(side.area).or_default().push(i);
            }
        }
        for i in 0..self.open.len() {
            let Some(here) = self.open[i].as_ref() else { continue };
            let others = here.behind().and_then(|area| by_area.get(&area)).into_iter().flatten();
            let way = |j: usize| {
                let there = self.open[j].as_ref()?;
                let way = (there.middle() - here.middle()).norm();
                let meets = there.behind() == Some(here.area) && j != i;
                (meets && way <= reach + here.width() / 2.0).then_some((way, j))
            };
            let nearest = others.filter_map(|&j| way(j)).min_by(|a, b| a.0.total_cmp(&b.0));
            let Some((_, j)) = nearest else { continue };
            if self.open[j].as_ref().is_some_and(|there| is_opposite(here, there)) {
                self.pair(i, j);
            }
            // Nothing in common: one opening all the same, through which no floor leads.
            if let (Some(a), Some(b)) = (self.open[i].take(), self.open[j].take()) {
                self.found.push((i.min(j), Opening::blind(self.world, self.map, vec![a, b])));
            }
        }
    }

    /// What is left, but for sides between two items of one Area.
    fn blind(&mut self, areas: &BTreeMap<AreaId, PlacedArea>) {
        for (i, side) in std::mem::take(&mut self.open).into_iter().enumerate() {
            let Some(side) = side else { continue };
            if side.linked.is_some() || !joins_own_items(&areas[&side.area], side.ends) {
                self.found.push((i, Opening::blind(self.world, self.map, vec![side])));
            }
        }
    }
}

fn open_sides(world: &World, area: &PlacedArea) -> Vec<OpenSide> {
    let model = &world.areas[&area.id];
    let mut sides = Vec::new();
    for (item, prism) in model.items.iter().zip(&area.prisms) {
        for (i, side) in prism.sides.iter().enumerate() {
            if side.permeability == Permeability::Impermeable {
                continue;
            }
            let corners = &prism.polygon.corners;
            let id = world.orthoframe_of(item).base[i].id.clone();
            let reference = SideRef { item: item.id.clone(), side: id };
            let mount =
                model.doors.iter().find(|m| m.item == reference.item && m.side == reference.side);
            sides.push(OpenSide {
                area: area.id,
                ends: (corners[i], corners[(i + 1) % corners.len()]),
                floor: prism.bottom,
                height: prism.top - prism.bottom,
                permeability: side.permeability,
                mount: mount.cloned(),
                side: reference,
                linked: None,
                inward: None,
                outward: None,
            });
        }
    }
    sides
}

/// The ways along two sides run against each other.
fn is_opposite(a: &OpenSide, b: &OpenSide) -> bool {
    let way = |s: &OpenSide| (s.ends.1 - s.ends.0).try_normalize(0.0);
    way(a).zip(way(b)).is_some_and(|(u, v)| u.dot(&v) < -0.999)
}

/// Equal stretches of two parallel lines that look at each other through at most a wall.
fn face_each_other(a: &OpenSide, b: &OpenSide, reach: f64) -> bool {
    let Some(u) = (a.ends.1 - a.ends.0).try_normalize(0.0) else { return false };
    let (near, far) = (b.ends.1 - a.ends.0, b.ends.0 - a.ends.1);
    is_opposite(a, b)
        && near.dot(&u).abs() < 1.0
        && far.dot(&u).abs() < 1.0
        && (-0.1..=reach).contains(&Vector::new(u.y, -u.x).dot(&near))
}

/// A polygon of an Area counter-clockwise has its outside on the right.
#[must_use]
pub fn outward_normal(a: Point, b: Point) -> Option<Vector> {
    let along = (b - a).try_normalize(1e-9)?;
    Some(Vector::new(along.y, -along.x))
}

/// A side between two items of one Area leads nowhere else.
fn joins_own_items(area: &PlacedArea, (a, b): (Point, Point)) -> bool {
    let middle = nalgebra::center(&a, &b);
    outward_normal(a, b).is_none_or(|n| stands_in(area, middle + n * FOOTHOLD))
}

fn stands_in(area: &PlacedArea, p: Point) -> bool {
    let here = |polygon: &Polygon, bounds: &Bounds| {
        bounds.grown(ON_BORDER).contains(p) && polygon.contains(p, ON_BORDER)
    };
    area.prisms.iter().any(|prism| here(&prism.polygon, &prism.bounds))
}

/// The floors of a Map's Areas by place.
struct Floors<'a> {
    by_id: &'a BTreeMap<AreaId, PlacedArea>,
    areas: Vec<&'a PlacedArea>,
    buckets: Buckets,
}

impl<'a> Floors<'a> {
    fn of(by_id: &'a BTreeMap<AreaId, PlacedArea>) -> Self {
        let areas: Vec<&PlacedArea> = by_id.values().collect();
        let bounds = |area: &&PlacedArea| {
            area.prisms.iter().fold(Bounds::EMPTY, |b, prism| b.union(&prism.bounds))
        };
        let boxes: Vec<Bounds> = areas.iter().map(bounds).collect();
        Self { by_id, areas, buckets: Buckets::of(&boxes) }
    }

    /// The first Area met when stepping off a side, out of its Area (`sign` 1) or into it (-1), at its middle or its
    /// quarters, with the way to its floor.
    fn met(&self, side: &OpenSide, sign: f64, reach: f64) -> Option<(AreaId, f64)> {
        let (a, b) = side.ends;
        let way = outward_normal(a, b)? * sign;
        let here = self.by_id.get(&side.area)?;
        let mut near = Vec::new();
        [0.5, 0.25, 0.75].iter().find_map(|share| {
            let start = a + (b - a) * *share;
            let swept = Bounds::of([start, start + way * (reach + FOOTHOLD)]);
            self.buckets.meeting(&swept.grown(1.0), &mut near);
            let others = near
                .iter()
                .map(|&n| self.areas[n as usize])
                .filter(|area| (sign < 0.0 || area.id != side.area) && same_storey(here, area));
            others
                .filter_map(|area| Some((area.id, first_floor(area, start, way, reach)?)))
                .min_by(|x, y| x.1.total_cmp(&y.1).then(x.0.cmp(&y.0)))
        })
    }
}

fn same_storey(a: &PlacedArea, b: &PlacedArea) -> bool {
    a.prisms.iter().any(|p| b.prisms.iter().any(|q| p.bottom < q.top && q.bottom < p.top))
}

/// How far along `way` the floor of an Area begins.
fn first_floor(area: &PlacedArea, start: Point, way: Vector, reach: f64) -> Option<f64> {
    let stands = |t: f64| stands_in(area, start + way * (t + FOOTHOLD));
    let edges = area.prisms.iter().flat_map(|prism| prism.polygon.edges());
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
