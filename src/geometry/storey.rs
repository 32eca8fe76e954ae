//! An Area's items by what they mean to the robot: floor that hangs together, steps, walls between them.
//!
//! **Invariant**: `floor` hangs together without a step that the robot cannot take; what does not is an obstacle.

use crate::map::{DoorStatus, Permeability};
use crate::units::{AreaId, Point, Vector};

use super::Polygon;
use super::apart::distance;
use super::blocker::{Blocker, Obstacle};
use super::scene::{PlacedArea, Prism};
use super::site::Site;

/// What has no thickness is given this to either side, in cm, so that it has a place on the floor.
pub(super) const THIN: f64 = 0.01;

/// An Area's side as a wall or an opening.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Side {
    pub(super) item: usize,
    pub(super) side: usize,
    pub(super) start: Point,
    pub(super) end: Point,
    pub(super) permeability: Permeability,
}

/// The Area's items by what they mean to the robot.
pub(super) struct Storey {
    pub(super) level: f64,
    /// Bases that hang together without a step that the robot cannot take, and thin strips that weld them.
    pub(super) floor: Vec<Polygon>,
    pub(super) closed_floor: Vec<Obstacle>,
    /// Walls between the items.
    pub(super) inner_walls: Vec<Polygon>,
    pub(super) sides: Vec<Side>,
}

impl Storey {
    pub(super) fn of(site: &Site<'_>, placed: &PlacedArea) -> Self {
        let model = &site.world.areas[&placed.id];
        let step = site.robot.step.get().max(0.0) + 1e-9;
        let height = site.robot.height.get();
        let base = model.items.iter().position(|i| i.is_base).unwrap_or(0);
        let level = placed.prisms.get(base).map_or(0.0, |p| p.bottom);
        let low_ceiling = |p: &Prism| {
            p.top > p.bottom
                && p.top - p.bottom < height
                && p.roof_permeability == Permeability::Impermeable
        };
        // The base is floor, whatever is above it; other items are floor if they have one.
        let is_floor = |i: usize, p: &Prism| {
            i == base
                || (p.bottom - level < height && p.base_permeability == Permeability::Impermeable)
        };
        let candidates: Vec<usize> = placed
            .prisms
            .iter()
            .enumerate()
            .filter(|(i, p)| is_floor(*i, p))
            .map(|(i, _)| i)
            .collect();
        let mut reached: Vec<usize> = candidates
            .iter()
            .copied()
            .filter(|&i| i == base && !low_ceiling(&placed.prisms[i]))
            .collect();
        let mut frontier = reached.clone();
        while let Some(i) = frontier.pop() {
            for &j in &candidates {
                let (p, q) = (&placed.prisms[i], &placed.prisms[j]);
                if !reached.contains(&j)
                    && !low_ceiling(q)
                    && (p.bottom - q.bottom).abs() <= step
                    && p.bounds.grown(0.05).meets(&q.bounds)
                    && distance(&p.polygon, &q.polygon) <= 0.05
                {
                    reached.push(j);
                    frontier.push(j);
                }
            }
        }
        let closed_floor = candidates
            .iter()
            .filter(|i| !reached.contains(i))
            .map(|&i| Obstacle {
                blocker: Blocker::Floor { area: placed.id, item: i },
                polygon: placed.prisms[i].polygon.clone(),
                side: None,
                bottom: placed.prisms[i].bottom - level,
                top: placed.prisms[i].top - level,
            })
            .collect();
        reached.sort_unstable();
        let mut storey = Self {
            level,
            floor: reached.iter().map(|&i| placed.prisms[i].polygon.clone()).collect(),
            closed_floor,
            inner_walls: Vec::new(),
            sides: sides(placed, &candidates),
        };
        storey.weld(site, placed, &reached);
        storey
    }

    /// Joins items along shared open sides, and parts them along shared walls.
    fn weld(&mut self, site: &Site<'_>, placed: &PlacedArea, reached: &[usize]) {
        if reached.len() < 2 {
            return;
        }
        let step = site.robot.step.get().max(0.0) + 1e-9;
        let sides: Vec<&Side> = self.sides.iter().filter(|s| reached.contains(&s.item)).collect();
        let (mut floor, mut walls) = (Vec::new(), Vec::new());
        for (k, a) in sides.iter().enumerate() {
            for b in &sides[k + 1..] {
                let Some((from, to)) = (a.item != b.item).then(|| shared(a, b)).flatten() else {
                    continue;
                };
                let level = |s: &Side| placed.prisms[s.item].bottom;
                let open = self.is_open(site, placed.id, a)
                    && self.is_open(site, placed.id, b)
                    && (level(a) - level(b)).abs() <= step;
                if open {
                    floor.push(strip(from, to));
                } else {
                    walls.push(strip(from, to));
                }
            }
        }
        self.floor.extend(floor);
        self.inner_walls = walls;
    }

    fn is_open(&self, site: &Site<'_>, area: AreaId, side: &Side) -> bool {
        match side.permeability {
            Permeability::Permeable => true,
            Permeability::Impermeable => false,
            Permeability::Conditional => {
                let model = &site.world.areas[&area];
                let item = &model.items[side.item];
                let id = &site.world.orthoframe_of(item).base[side.side].id;
                let mount = model.doors.iter().find(|m| m.item == item.id && m.side == *id);
                mount.is_some_and(|m| site.state(m.door).status == DoorStatus::Open)
            }
        }
    }

    /// The height of the floor under a point, above the Area's level.
    pub(super) fn floor_under(&self, placed: &PlacedArea, p: Point) -> f64 {
        placed
            .prisms
            .iter()
            .filter(|f| f.bounds.contains(p) && f.polygon.contains(p, 1e-6))
            .map(|f| f.bottom - self.level)
            .filter(|z| self.floor.len() > 1 && z.abs() < 30.0)
            .fold(0.0, f64::min)
    }
}

pub(super) fn sides(placed: &PlacedArea, items: &[usize]) -> Vec<Side> {
    let mut found = Vec::new();
    for &item in items {
        let prism = &placed.prisms[item];
        for (side, (start, end)) in prism.polygon.edges().enumerate() {
            let permeability = prism.sides[side].permeability;
            found.push(Side { item, side, start, end, permeability });
        }
    }
    found
}

/// The stretch that two sides standing back to back share.
fn shared(a: &Side, b: &Side) -> Option<(Point, Point)> {
    const TOUCH: f64 = 0.05;
    let along = (a.end - a.start).try_normalize(0.0)?;
    let offset = |p: Point| along.perp(&(p - a.start)).abs();
    let place = |p: Point| (p - a.start).dot(&along);
    if offset(b.start) > TOUCH || offset(b.end) > TOUCH {
        return None;
    }
    let (low, high) = (place(b.start).min(place(b.end)), place(b.start).max(place(b.end)));
    let (from, to) = (low.max(0.0), high.min((a.end - a.start).norm()));
    (to - from > TOUCH).then(|| (a.start + along * from, a.start + along * to))
}

/// A segment with the least thickness that the floor can show; its first edge lies to the right of it.
pub(super) fn strip(a: Point, b: Point) -> Polygon {
    let across = match (b - a).try_normalize(0.0) {
        Some(v) => Vector::new(-v.y, v.x) * THIN,
        None => Vector::new(0.0, THIN),
    };
    Polygon::new(vec![a - across, b - across, b + across, a + across])
}
