//! Boundaries between spaces where no wall stands: open passages.
//!
//! A boundary that is VIRTUAL, or that an IfcVirtualElement makes, parts two spaces by agreement only. Where its
//! surface stands upright on the floor, as high as a person, its foot is walked along and the room on the other side
//! looked for, step by step: a long boundary may run along several rooms. A boundary without a surface lies where the
//! two spaces that share its element run side by side.

use std::collections::{BTreeMap, BTreeSet};

use crate::map::Properties;
use crate::units::{Cm, Point, Vector, said};
use crate::{Opening, OpeningKind, Treatment, What, outline};

use super::body::Body;
use super::building::{Reader, source};
use super::classes::Becomes;
use super::doors::PASSAGE;
use super::shape::Else;
use super::step::Instance;

/// Between places at which the rooms beside a boundary are looked for, in cm.
const STRIDE: f64 = 10.0;
/// Of one boundary no more places than this.
const MOST_STRIDES: f64 = 400.0;
/// How far beside a boundary, in cm, its rooms are looked for.
const ASIDE: [f64; 4] = [1.5, 5.0, 15.0, 30.0];
/// A surface that reaches farther across its foot than this, in cm, is no upright one.
const UPRIGHT: f64 = 10.0;
/// A boundary may begin so much above the floor, in cm.
const SILL: f64 = 30.0;
/// Ends of stretches nearer than this, in cm, are one.
const NEAR: f64 = 30.0;
/// Stretches between two rooms.
const MOST_STRETCHES: usize = 100;
/// Boundaries of one file.
const MOST: usize = 200_000;

/// A stretch of boundary between two rooms of a level.
struct Stretch {
    ends: [Point; 2],
    height: Option<f64>,
    source: String,
}

impl Reader<'_> {
    /// Space, the element that makes the boundary, the relation.
    pub(super) fn space_boundaries(&self) -> Vec<(u32, Option<u32>, (u32, &Instance))> {
        let kinds =
            ["IFCRELSPACEBOUNDARY", "IFCRELSPACEBOUNDARY1STLEVEL", "IFCRELSPACEBOUNDARY2NDLEVEL"];
        let relations = kinds.iter().flat_map(|kind| self.all.all(kind));
        relations
            .filter_map(|(id, r)| Some((r.at(4).reference()?, r.at(5).reference(), (id, r))))
            .collect()
    }

    pub(super) fn passages(&mut self) {
        let all = self.all;
        let is_virtual = |element: Option<u32>, relation: &Instance| {
            let made_by = element.and_then(|id| all.get(id)).map(|e| e.kind);
            relation.at(7).word() == Some("VIRTUAL") || made_by == Some("IFCVIRTUALELEMENT")
        };
        let mut boundaries: Vec<_> = self
            .space_boundaries()
            .into_iter()
            .filter(|(_, element, (_, relation))| is_virtual(*element, relation))
            .map(|(space, element, (id, relation))| (space, element, id, relation.clone()))
            .collect();
        boundaries.truncate(MOST);
        // The spaces that an element parts, for boundaries that tell no surface.
        let mut parted = BTreeMap::<u32, BTreeSet<u32>>::new();
        for (space, element, ..) in &boundaries {
            parted.entry(element.unwrap_or(0)).or_default().insert(*space);
        }
        let mut found = BTreeMap::<(usize, usize, usize), Vec<Stretch>>::new();
        let mut placeless = 0_usize;
        for (space, element, id, relation) in &boundaries {
            let Some(&(level, room)) = self.rooms.get(space) else { continue };
            let feet = match self.foot(*space, *element, relation, level) {
                Foot::At(ends, height) => vec![(ends, height)],
                Foot::Elsewhere => continue,
                Foot::Untold => {
                    let others = element.and_then(|e| parted.get(&e));
                    if others.is_none_or(|o| o.len() < 2) {
                        placeless += 1;
                        continue;
                    }
                    let ring = &self.survey.levels[level].rooms[room].outline;
                    outline::edges(ring).map(|(a, b)| ([a, b], None)).collect()
                }
            };
            let is_told = feet.len() == 1;
            for (ends, height) in feet {
                for (other, ends) in self.beside(level, room, ends) {
                    let is_parted = is_told
                        || element.and_then(|e| parted.get(&e)).is_some_and(|spaces| {
                            spaces.iter().any(|s| self.rooms.get(s) == Some(&(level, other)))
                        });
                    if is_parted {
                        let source = source(relation, *id);
                        let pair = (level, room.min(other), room.max(other));
                        let stretches = found.entry(pair).or_default();
                        add(stretches, Stretch { ends, height, source });
                    }
                }
            }
        }
        if placeless > 0 {
            let text = said!("virtual-boundaries-without-a-surface", placeless);
            self.tell((Treatment::Noted, What::Record), (0, 0), "IFCRELSPACEBOUNDARY", text);
        }
        for ((level, one, other), stretches) in found {
            for stretch in stretches {
                self.open(level, [one, other], stretch);
            }
        }
        let elements = self.elements(Becomes::Virtual).len();
        if elements > 0 {
            let text = said!("they-are-no-bodies-themselves", elements);
            self.tell((Treatment::Noted, What::Record), (elements, 0), "IFCVIRTUALELEMENT", text);
        }
    }

    /// Where a boundary stands on the floor.
    fn foot(
        &mut self,
        space: u32,
        element: Option<u32>,
        relation: &Instance,
        level: usize,
    ) -> Foot {
        let all = self.all;
        let of = |id: Option<u32>| all.get(id?);
        let mut bodies: Vec<Body> = Vec::new();
        let surface = of(relation.at(6).reference())
            .filter(|c| c.kind == "IFCCONNECTIONSURFACEGEOMETRY")
            .and_then(|c| of(c.at(0).reference()));
        if let (Some(surface), Some(space)) = (surface, all.get(space)) {
            let place = self.place_of(space);
            self.shapes.solid(surface, &place, 0, &mut bodies);
        }
        let made_by = of(element).filter(|e| e.kind == "IFCVIRTUALELEMENT");
        if let (true, Some(made_by)) = (bodies.is_empty(), made_by) {
            let place = self.place_of(made_by);
            bodies = self.shapes.of_product(made_by.at(6), &place, Else::Box).0;
        }
        let corners: Vec<_> = bodies.iter().flat_map(Body::corners).collect();
        let heights = bodies.iter().filter_map(Body::heights);
        let Some((low, high)) = heights.reduce(|a, b| (a.0.min(b.0), a.1.max(b.1))) else {
            return Foot::Untold;
        };
        let flat: Vec<Point> = corners.iter().map(|p| Point::new(p.x, p.y)).collect();
        let farthest = |from: Point| {
            let away = |p: &&Point| (**p - from).norm_squared();
            flat.iter().max_by(|p, q| away(p).total_cmp(&away(q))).copied().unwrap_or(from)
        };
        let a = farthest(flat[0]);
        let b = farthest(a);
        let Some(along) = (b - a).try_normalize(1e-6) else { return Foot::Elsewhere };
        let across = |p: &Point| (p - a).perp(&along).abs();
        let wide = flat.iter().map(across).fold(0.0, f64::max);
        let floor = self.survey.levels[level].elevation.get();
        let (least_height, least_width, _) = PASSAGE;
        let is_passage = wide <= UPRIGHT
            && (b - a).norm() >= least_width
            && high - low >= least_height
            && (low - floor).abs() <= SILL;
        let sound = [a, b].iter().all(|p| Cm::new(p.x).is_ok() && Cm::new(p.y).is_ok());
        if is_passage && sound { Foot::At([a, b], Some(high - low)) } else { Foot::Elsewhere }
    }

    /// The other rooms along a line beside a room, each with its stretch.
    fn beside(
        &mut self,
        level: usize,
        room: usize,
        [a, b]: [Point; 2],
    ) -> Vec<(usize, [Point; 2])> {
        let length = (b - a).norm();
        let Some(along) = (b - a).try_normalize(1e-6) else { return Vec::new() };
        let across = Vector::new(-along.y, along.x);
        let steps = (length / STRIDE).ceil().clamp(1.0, MOST_STRIDES) as usize;
        let stride = length / steps as f64;
        let mut runs: Vec<(usize, f64, f64)> = Vec::new();
        for k in 0..steps {
            let at = a + along * (stride * (k as f64 + 0.5));
            let other = ASIDE.iter().find_map(|by| {
                [1.0, -1.0].iter().find_map(|side| {
                    let rooms = self.rooms_at(level, at + across * (by * side));
                    rooms.into_iter().find(|r| *r != room)
                })
            });
            let Some(other) = other else { continue };
            let (from, to) = (stride * k as f64, stride * (k + 1) as f64);
            match runs.last_mut() {
                Some(run) if run.0 == other && from - run.2 < 1e-6 => run.2 = to,
                _ => runs.push((other, from, to)),
            }
        }
        runs.retain(|(_, from, to)| to - from >= PASSAGE.1);
        runs.into_iter().map(|(r, from, to)| (r, [a + along * from, a + along * to])).collect()
    }

    fn open(&mut self, level: usize, rooms: [usize; 2], stretch: Stretch) {
        // A door or opening that the file has in this very place says more.
        let [a, b] = stretch.ends;
        let openings = &self.survey.levels[level].openings;
        let is_there = openings.iter().any(|o| {
            let middle = o.jambs[0] + (o.jambs[1] - o.jambs[0]) / 2.0;
            let width = (o.jambs[1] - o.jambs[0]).norm();
            let same = o.rooms.is_some_and(|r| rooms.iter().all(|room| r.contains(&Some(*room))));
            same && (b - a).norm() < 1.5 * width && distance(middle, [a, b]) < NEAR
        });
        if is_there {
            return;
        }
        self.survey.levels[level].openings.push(Opening {
            source: stretch.source,
            name: String::new(),
            what: OpeningKind::Passage,
            jambs: stretch.ends,
            rooms: Some(rooms.map(Some)),
            height: stretch.height.and_then(|h| Cm::new(h).ok()),
            sill: Cm::ZERO,
            properties: Properties::new(),
        });
    }
}

enum Foot {
    At([Point; 2], Option<f64>),
    /// Upright nowhere: a ceiling, a hatch, a parapet.
    Elsewhere,
    /// The file tells no surface.
    Untold,
}

fn distance(p: Point, [a, b]: [Point; 2]) -> f64 {
    (crate::geometry::nearest_on_segment(p, a, b) - p).norm()
}

/// Adds a stretch to those of its rooms; both rooms tell of the same one, and long ones come in pieces.
fn add(stretches: &mut Vec<Stretch>, mut new: Stretch) {
    let joins = |one: &Stretch, other: &Stretch| {
        let [a, b] = one.ends;
        let Some(along) = (b - a).try_normalize(1e-6) else { return false };
        let beside = other.ends.iter().all(|p| (p - a).perp(&along).abs() <= NEAR);
        let (from, to) = ((other.ends[0] - a).dot(&along), (other.ends[1] - a).dot(&along));
        let is_parallel = (to - from).abs() >= 0.9 * (other.ends[1] - other.ends[0]).norm();
        beside && is_parallel && from.max(to) >= -1.0 && from.min(to) <= (b - a).norm() + 1.0
    };
    while let Some(at) = stretches.iter().position(|old| joins(old, &new)) {
        // The line of the one that was told first, as long as both.
        let old = stretches.swap_remove(at);
        let [a, b] = old.ends;
        let Some(along) = (b - a).try_normalize(1e-6) else { continue };
        let all = old.ends.iter().chain(&new.ends).map(|p| (p - a).dot(&along));
        let (low, high) =
            all.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), x| (l.min(x), h.max(x)));
        new = Stretch { ends: [a + along * low, a + along * high], ..old };
    }
    if stretches.len() < MOST_STRETCHES {
        stretches.push(new);
    }
}
