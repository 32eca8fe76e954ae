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
use std::sync::Arc;

use crate::map::{Permeability, SideRef, THICKEST_WALL, World};
use crate::units::{AreaId, DoorId, Frame, InOrder as _, MapId, OpeningId, Point, Vector};

use super::buckets::Buckets;
use super::opening::{OpenSide, Opening};
use super::scene::PlacedArea;
use super::{Bounds, Polygon, Scene};

/// How far a step through a side looks where no rules say it, in cm.
pub const STEP_REACH: f64 = THICKEST_WALL;

/// A step this long beyond a border stands on the floor behind it, in cm.
pub(super) const FOOTHOLD: f64 = 0.5;

/// Points this near to a floor's border lie on it, in cm.
const ON_BORDER: f64 = 1e-6;

/// The openings of all Maps, by their ids. A copy shares what it has in common with another.
#[derive(Debug, Clone, Default)]
pub struct Openings {
    all: Vec<Arc<Opening>>,
    /// Of each its first side.
    firsts: Vec<Place>,
    /// Which Areas have a side in which; sorted.
    by_area: Vec<(AreaId, OpeningId)>,
    /// Where the Areas stand, in the order of these.
    pub(super) stands: Vec<Stand>,
    /// The thickest wall through which sides were looked for, in cm.
    reach: f64,
}

/// An Area as it stands in its Map.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Stand {
    pub(super) area: AreaId,
    pub(super) map: MapId,
    pub(super) frame: Frame,
    pub(super) bounds: Bounds,
    /// The length of its longest side that lets something through, in cm.
    pub(super) widest: f64,
}

impl Stand {
    pub(super) fn of(map: MapId, area: &PlacedArea) -> Self {
        let sides = area.prisms.iter().flat_map(|prism| prism.polygon.edges().zip(&*prism.sides));
        let open = sides.filter(|(_, side)| side.permeability != Permeability::Impermeable);
        let widest = open.map(|((a, b), _)| (b - a).norm()).fold(0.0, f64::max);
        Self { area: area.id, map, frame: area.frame, bounds: bounds_of(area), widest }
    }
}

/// Where a side stands among all: its Map and Area, which of the Area's items it is of, and which of its sides.
pub(super) type Place = (MapId, AreaId, usize, usize);

impl PartialEq for Openings {
    fn eq(&self, other: &Self) -> bool {
        let is_same = |(a, b): (&Arc<Opening>, &Arc<Opening>)| Arc::ptr_eq(a, b) || a == b;
        self.all.len() == other.all.len() && self.all.iter().zip(&other.all).all(is_same)
    }
}

impl Openings {
    /// Measures the openings of all Maps; sides are looked for through walls up to `reach` cm thick. Until rules decide,
    /// each joins the Areas of its two sides.
    #[must_use]
    pub fn of(world: &World, reach: f64) -> Self {
        let (mut found, mut stands) = (Vec::new(), Vec::new());
        for &map in world.maps.keys() {
            let areas = Scene::areas_of(world, map);
            stands.extend(areas.values().map(|area| Stand::of(map, area)));
            let mut sides: Vec<_> =
                areas.values().flat_map(|area| open_sides(world, map, area)).collect();
            let floors = Floors::of(&areas);
            sides.iter_mut().for_each(|(_, side)| floors.step_off(side, reach));
            found.extend(paired(world, map, sides, &areas, reach));
        }
        stands.order_by_key(|stand| (stand.area, stand.map));
        let found = found.into_iter().map(|(first, opening)| (first, Arc::new(opening)));
        Self::numbered(found, stands, reach)
    }

    /// These openings, in the order of their first sides, under their numbers.
    pub(super) fn numbered(
        found: impl Iterator<Item = (Place, Arc<Opening>)>,
        stands: Vec<Stand>,
        reach: f64,
    ) -> Self {
        let (mut firsts, mut all, mut by_area) = (Vec::new(), Vec::new(), Vec::new());
        for (first, mut opening) in found {
            let id = OpeningId(all.len() as u32);
            if opening.id != id {
                Arc::make_mut(&mut opening).id = id;
            }
            by_area.extend(opening.sides.iter().map(|side| (side.area, id)));
            firsts.push(first);
            all.push(opening);
        }
        by_area.sort_unstable();
        Self { all, firsts, by_area, stands, reach }
    }

    /// The thickest wall through which sides were looked for, in cm.
    #[must_use]
    pub fn reach(&self) -> f64 {
        self.reach
    }

    /// In the order of their ids.
    pub fn iter(&self) -> impl ExactSizeIterator<Item = &Opening> + Clone {
        self.all.iter().map(Arc::as_ref)
    }

    #[must_use]
    pub fn opening(&self, id: OpeningId) -> Option<&Opening> {
        self.all.get(id.0 as usize).map(Arc::as_ref)
    }

    /// The opening that a side of an Area belongs to.
    #[must_use]
    pub fn of_side(&self, area: AreaId, side: &SideRef) -> Option<&Opening> {
        let is_it = |own: &OpenSide| own.area == area && own.side == *side;
        self.in_sides_of(area).find(|opening| opening.sides.iter().any(is_it))
    }

    /// The openings in an Area's sides.
    fn in_sides_of(&self, area: AreaId) -> impl Iterator<Item = &Opening> + '_ {
        let from = self.by_area.partition_point(|(other, _)| *other < area);
        let own = self.by_area[from..].iter().take_while(move |(other, _)| *other == area);
        own.map(|(_, id)| &*self.all[id.0 as usize])
    }

    /// Each opening with the place of its first side.
    pub(super) fn placed(&self) -> impl Iterator<Item = (Place, &Arc<Opening>)> + '_ {
        self.firsts.iter().copied().zip(&self.all)
    }

    /// Those that two have not in common: of these, and of the others. Of openings and a copy of them that was changed these
    /// are the changed ones; more where the copy was made otherwise.
    #[must_use]
    pub fn not_shared<'a>(&'a self, others: &'a Self) -> [Vec<&'a Opening>; 2] {
        let (mut own, mut other) = (self.placed().peekable(), others.placed().peekable());
        let [mut ours, mut theirs] = [Vec::new(), Vec::new()];
        loop {
            match (own.peek(), other.peek()) {
                (Some((a, one)), Some((b, two))) if a == b => {
                    if !Arc::ptr_eq(one, two) {
                        ours.push(&***one);
                        theirs.push(&***two);
                    }
                    own.next();
                    other.next();
                }
                (Some((a, one)), other) if other.is_none_or(|(b, _)| a < b) => {
                    ours.push(&***one);
                    own.next();
                }
                (_, Some((_, two))) => {
                    theirs.push(&***two);
                    other.next();
                }
                (_, None) => return [ours, theirs],
            }
        }
    }

    /// The openings in an Area's sides, and those that the rules join to it.
    pub fn of_area(&self, area: AreaId) -> impl Iterator<Item = &Opening> + '_ {
        self.iter().filter(move |opening| opening.is_of(area))
    }

    /// Gives every opening its name in the facts; none leaves it the one that it has.
    pub fn name(&mut self, mut name: impl FnMut(&Opening) -> Option<String>) {
        for opening in &mut self.all {
            if let Some(name) = name(opening).filter(|name| *name != opening.name) {
                Arc::make_mut(opening).name = name;
            }
        }
    }

    /// Takes over what the rules decide of an opening: the pairs of Areas that it joins, the lower id first.
    pub fn decide(&mut self, id: OpeningId, joins: Vec<[AreaId; 2]>) {
        if let Some(opening) = self.all.get_mut(id.0 as usize).filter(|o| o.joins != joins) {
            Arc::make_mut(opening).joins = joins;
        }
    }
}

/// The openings that sides of a Map make, whose order is that of their places, in the order of their first sides.
pub(super) fn paired(
    world: &World,
    map: MapId,
    sides: Vec<(Place, OpenSide)>,
    areas: &BTreeMap<AreaId, PlacedArea>,
    reach: f64,
) -> Vec<(Place, Opening)> {
    let (places, open): (Vec<_>, Vec<_>) =
        sides.into_iter().map(|(place, side)| (place, Some(side))).unzip();
    let mut maker = Pairs { world, map, open, found: vec![] };
    maker.link(world);
    maker.facing(reach);
    maker.meeting(reach);
    maker.blind(areas);
    maker.found.order_by_key(|(first, _)| *first);
    maker.found.into_iter().map(|(first, opening)| (places[first], opening)).collect()
}

fn bounds_of(area: &PlacedArea) -> Bounds {
    area.prisms.iter().fold(Bounds::EMPTY, |bounds, prism| bounds.union(&prism.bounds))
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
        let mut places: BTreeMap<(AreaId, &SideRef), usize> = BTreeMap::new();
        let mut by_door: BTreeMap<DoorId, Vec<usize>> = BTreeMap::new();
        for (i, side) in self.open.iter().enumerate() {
            let Some(side) = side else { continue };
            places.entry((side.area, &side.side)).or_insert(i);
            if let Some(mount) = &side.mount {
                by_door.entry(mount.door).or_default().push(i);
            }
        }
        let (mut ends, mut linked) = (Vec::new(), Vec::new());
        for link in world.maps.values().flat_map(|map| &map.links) {
            let one = places.get(&(link.area, &link.side)).copied();
            let other = places.get(&(link.to_area, &link.to_side)).copied();
            ends.extend(one.map(|end| (end, link.to_area)));
            ends.extend(other.map(|end| (end, link.area)));
            linked.extend(one.zip(other));
        }
        for (end, other) in ends {
            if let Some(side) = &mut self.open[end] {
                side.linked = Some(other);
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

/// The sides of an Area that let something through, in their order; nobody has stepped through them yet.
pub(super) fn open_sides(world: &World, map: MapId, area: &PlacedArea) -> Vec<(Place, OpenSide)> {
    let model = &world.areas[&area.id];
    let mut sides = Vec::new();
    for (number, (item, prism)) in model.items.iter().zip(&area.prisms).enumerate() {
        for (i, side) in prism.sides.iter().enumerate() {
            if side.permeability == Permeability::Impermeable {
                continue;
            }
            let corners = &prism.polygon.corners;
            let id = world.orthoframe_of(item).base[i].id.clone();
            let reference = SideRef { item: item.id.clone(), side: id };
            let mount =
                model.doors.iter().find(|m| m.item == reference.item && m.side == reference.side);
            let side = OpenSide {
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
            };
            sides.push(((map, area.id, number, i), side));
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
pub(super) fn face_each_other(a: &OpenSide, b: &OpenSide, reach: f64) -> bool {
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
pub(super) struct Floors<'a> {
    by_id: &'a BTreeMap<AreaId, PlacedArea>,
    areas: Vec<&'a PlacedArea>,
    buckets: Buckets,
}

impl<'a> Floors<'a> {
    pub(super) fn of(by_id: &'a BTreeMap<AreaId, PlacedArea>) -> Self {
        let areas: Vec<&PlacedArea> = by_id.values().collect();
        let boxes: Vec<Bounds> = areas.iter().map(|area| bounds_of(area)).collect();
        Self { by_id, areas, buckets: Buckets::of(&boxes) }
    }

    /// Steps through a side, out of its Area and into it.
    pub(super) fn step_off(&self, side: &mut OpenSide, reach: f64) {
        side.inward = self.met(side, -1.0, reach);
        side.outward = self.met(side, 1.0, reach);
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
