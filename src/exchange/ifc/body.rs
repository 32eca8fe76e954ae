//! Bodies of faces, and what they take up of the floor.
//!
//! A body is a heap of flat faces, closed or not, whichever way they look. Its *footprint* is what they cover together,
//! seen from above; its *floor*, as a room, what its lowest faces make. Lengths are cm.
//!
//! Faces that look up or down cover; upright ones add nothing to that. All are turned counter-clockwise and laid over
//! one another; sides along which two faces meet cancel out first, so that what is left for the boolean operation is
//! the outline of the body and its folds, not its thousand triangles.

use std::collections::HashMap;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use nalgebra::{Point3, Vector3};

use crate::assemble::ring::{Region, Ring, overlay};
use crate::geometry::convex_hull;
use crate::outline;
use crate::units::{Point, Vector};

/// Outlines with more sides than this are not joined; their hull stands for them.
const MOST_SIDES: usize = 3000;
/// Crossings that all joinings of one file may have at most: sides times sides.
const MOST_CROSSINGS: usize = 400_000_000;
/// Faces whose corners lie within this of the lowest one are the floor, in cm.
const LEVEL: f64 = 1.0;
/// The floor of a body covers at least so much of its footprint, or it is not its floor.
const LEAST_FLOOR: f64 = 0.3;
/// A sheet without thickness gets this, in cm.
const SHEET: f64 = 1.0;

/// Points of a shape's space, in order along a line.
pub(super) type Line = Vec<Point3<f64>>;
/// A face or the outline of a profile: its outer ring, then its holes.
pub(super) type Rings = Vec<Line>;

/// A body of faces; each face its outer ring, then its holes.
#[derive(Debug, Clone, PartialEq, Default)]
pub(super) struct Body {
    pub faces: Vec<Rings>,
    /// Bodies taken out of it.
    pub less: Vec<Self>,
    /// Its faces are curved: their corners tell how far it reaches, not what it covers.
    pub is_round: bool,
}

/// What boolean operations may still cost in this file.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(super) struct Effort {
    crossings: usize,
    /// How many outlines became hulls for want of it.
    pub hulls: usize,
}

impl Effort {
    pub(super) fn allows(&mut self, sides: usize) -> bool {
        let cost = sides.saturating_mul(sides);
        let is_fine = sides <= MOST_SIDES && self.crossings.saturating_add(cost) <= MOST_CROSSINGS;
        self.crossings += if is_fine { cost } else { 0 };
        self.hulls += usize::from(!is_fine);
        is_fine
    }
}

impl Body {
    pub(super) fn of(faces: Vec<Rings>) -> Self {
        Self { faces, ..Self::default() }
    }

    /// Rings of a profile swept along a vector.
    pub(super) fn swept(rings: &Rings, along: Vector3<f64>) -> Self {
        let moved: Rings =
            rings.iter().map(|ring| ring.iter().map(|p| p + along).collect()).collect();
        let mut faces = between(rings, &moved);
        faces.push(rings.clone());
        faces.push(moved);
        Self::of(faces)
    }

    pub(super) fn corners(&self) -> impl Iterator<Item = &Point3<f64>> {
        self.faces.iter().flatten().flatten()
    }

    /// Lowest and highest, in cm; None of a body without corners.
    pub(super) fn heights(&self) -> Option<(f64, f64)> {
        let (low, high) = self
            .corners()
            .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), p| (l.min(p.z), h.max(p.z)));
        (low <= high).then_some((low, high))
    }

    /// Cuts away what lies beyond a plane, on the side to which `away` points. The cut stays open.
    pub(super) fn clip(&mut self, at: Point3<f64>, away: Vector3<f64>) {
        for face in &mut self.faces {
            for ring in face.iter_mut() {
                *ring = clipped(ring, at, away);
            }
            // Without its outer ring a face is none.
            if face.first().is_none_or(|outer| outer.len() < 3) {
                face.clear();
            }
        }
        self.faces.retain(|face| !face.is_empty());
        self.less.iter_mut().for_each(|body| body.clip(at, away));
    }

    /// What the body takes up of the floor, seen from above.
    pub(super) fn footprint(&self, effort: &mut Effort) -> Vec<Region> {
        let Some((low, high)) = self.heights() else { return Vec::new() };
        let whole = self.covered(|_| true, effort);
        // What is taken out of part of its height leaves the rest standing.
        self.without(whole, |l, h| l <= low + LEVEL && h >= high - LEVEL, effort)
    }

    /// The floor of the body as a room: its lowest faces, else all that it covers.
    pub(super) fn floor(&self, effort: &mut Effort) -> Vec<Region> {
        let Some((low, _)) = self.heights() else { return Vec::new() };
        let whole = self.covered(|_| true, effort);
        let lowest = |face: &Rings| face.iter().flatten().all(|p| p.z <= low + LEVEL);
        let floor = if self.is_round { Vec::new() } else { self.covered(lowest, effort) };
        let floor = if area(&floor) >= LEAST_FLOOR * area(&whole) { floor } else { whole };
        self.without(floor, |l, h| l <= low + LEVEL && h > low + LEVEL, effort)
    }

    fn without(
        &self,
        from: Vec<Region>,
        is_gone: impl Fn(f64, f64) -> bool,
        effort: &mut Effort,
    ) -> Vec<Region> {
        let mut taken: Vec<Ring> = Vec::new();
        for body in &self.less {
            if body.heights().is_some_and(|(l, h)| is_gone(l, h)) {
                taken.extend(rings(&body.footprint(effort)));
            }
        }
        let own = rings(&from);
        let sides: usize = taken.iter().chain(&own).map(Vec::len).sum();
        if taken.is_empty() || own.is_empty() || !effort.allows(sides) {
            return from;
        }
        overlay(&own, &taken, OverlayRule::Difference, FillRule::NonZero)
    }

    /// What some of its faces cover together.
    fn covered(&self, which: impl Fn(&Rings) -> bool, effort: &mut Effort) -> Vec<Region> {
        let faces = || self.faces.iter().filter(|face| which(face));
        if !self.is_round {
            let found = joined(faces(), effort);
            if !found.is_empty() {
                return found;
            }
        }
        hull(&faces().flatten().flatten().map(|p| Point::new(p.x, p.y)).collect::<Vec<_>>())
    }
}

pub(super) fn area(regions: &[Region]) -> f64 {
    regions.iter().map(Region::area).sum()
}

pub(super) fn rings(regions: &[Region]) -> Vec<Ring> {
    regions.iter().flat_map(|r| r.rings().cloned()).collect()
}

/// What several heaps of regions cover together.
pub(super) fn together(regions: &[Region], effort: &mut Effort) -> Vec<Region> {
    let all = rings(regions);
    if regions.len() < 2 {
        return regions.to_vec();
    }
    if !effort.allows(all.iter().map(Vec::len).sum()) {
        return hull(&all.concat());
    }
    // Each region's rings have their own sense: floor is what is wound round more often than not at all.
    overlay(&all, &[], OverlayRule::Subject, FillRule::NonZero)
}

/// Faces between rings and where they are moved to.
pub(super) fn between(from: &Rings, to: &Rings) -> Vec<Rings> {
    let mut faces = Vec::new();
    for (one, other) in from.iter().zip(to) {
        for i in 0..one.len().min(other.len()) {
            let j = (i + 1) % one.len().min(other.len());
            faces.push(vec![vec![one[i], one[j], other[j], other[i]]]);
        }
    }
    faces
}

/// The convex hull of some points; of a sheet seen edge-on, a strip.
pub(super) fn hull(points: &[Point]) -> Vec<Region> {
    let outer = convex_hull(points.to_vec());
    if outer.len() >= 3 && outline::area(&outer) > SHEET {
        return vec![Region { outer, holes: Vec::new() }];
    }
    let Some(&first) = points.first() else { return Vec::new() };
    let far = |p: &&Point| (**p - first).norm_squared();
    let Some(&last) = points.iter().max_by(|p, q| far(p).total_cmp(&far(q))) else {
        return Vec::new();
    };
    let from = |p: &&Point| (**p - last).norm_squared();
    let first = points.iter().max_by(|p, q| from(p).total_cmp(&from(q))).copied().unwrap_or(first);
    let Some(along) = (last - first).try_normalize(SHEET) else { return Vec::new() };
    let half = Vector::new(-along.y, along.x) * (SHEET / 2.0);
    let outer = vec![first - half, last - half, last + half, first + half];
    vec![Region { outer, holes: Vec::new() }]
}

/// Faces laid over one another.
fn joined<'f>(faces: impl Iterator<Item = &'f Rings>, effort: &mut Effort) -> Vec<Region> {
    let mut border = Border::default();
    for face in faces {
        let doubled: f64 = face.first().map_or(0.0, doubled_area);
        for (k, ring) in face.iter().enumerate() {
            let own = doubled_area(ring);
            // The outer ring runs counter-clockwise, holes clockwise, whatever the file says.
            let is_turned = if k == 0 { doubled < 0.0 } else { own > 0.0 };
            border.add(ring, is_turned);
        }
    }
    let chains = border.chains();
    let sides: usize = chains.iter().map(Vec::len).sum();
    if chains.is_empty() {
        return Vec::new();
    }
    if !effort.allows(sides) {
        return hull(&chains.concat());
    }
    let found = overlay(&chains, &[], OverlayRule::Subject, FillRule::NonZero);
    found.into_iter().filter(|r| r.area() > SHEET).collect()
}

fn doubled_area(ring: &Line) -> f64 {
    ring.iter().zip(ring.iter().cycle().skip(1)).map(|(a, b)| a.x * b.y - b.x * a.y).sum()
}

/// Sides of faces; two that run against each other are none.
#[derive(Default)]
struct Border {
    /// How often a side is run through from its lesser end to its greater one, less how often back.
    sides: HashMap<(Corner, Corner), i32>,
    order: Vec<(Corner, Corner)>,
}

/// The bits of x and y.
type Corner = (u64, u64);

impl Border {
    fn add(&mut self, ring: &Line, is_turned: bool) {
        // Adding 0 makes one zero of two.
        let key = |p: &Point3<f64>| ((p.x + 0.0).to_bits(), (p.y + 0.0).to_bits());
        for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
            let (from, to) = if is_turned { (key(b), key(a)) } else { (key(a), key(b)) };
            if from == to {
                continue;
            }
            let (side, by) = if from < to { ((from, to), 1) } else { ((to, from), -1) };
            let times = self.sides.entry(side).or_insert_with(|| {
                self.order.push(side);
                0
            });
            *times += by;
        }
    }

    /// What is left, as closed chains: the borders of what the faces cover, with how often they cover it.
    fn chains(self) -> Vec<Ring> {
        let mut next = HashMap::<Corner, Vec<Corner>>::new();
        let mut order = Vec::new();
        for side in self.order {
            let times = self.sides[&side];
            let (from, to) = if times > 0 { side } else { (side.1, side.0) };
            for _ in 0..times.abs() {
                next.entry(from).or_default().push(to);
                order.push(from);
            }
        }
        let place = |c: Corner| Point::new(f64::from_bits(c.0), f64::from_bits(c.1));
        let mut chains = Vec::new();
        for start in order {
            let mut chain = Vec::new();
            let mut here = start;
            while let Some(to) = next.get_mut(&here).and_then(Vec::pop) {
                chain.push(place(here));
                here = to;
            }
            if chain.len() >= 3 {
                chains.push(chain);
            }
        }
        chains
    }
}

/// The part of a ring on the near side of a plane (Sutherland and Hodgman).
fn clipped(ring: &Line, at: Point3<f64>, away: Vector3<f64>) -> Line {
    let beyond = |p: &Point3<f64>| (p - at).dot(&away);
    let mut kept = Vec::with_capacity(ring.len() + 2);
    for (a, b) in ring.iter().zip(ring.iter().cycle().skip(1)) {
        let (u, v) = (beyond(a), beyond(b));
        if u <= 0.0 {
            kept.push(*a);
        }
        if (u < 0.0 && v > 0.0) || (u > 0.0 && v < 0.0) {
            kept.push(a + (b - a) * (u / (u - v)));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    fn p(x: f64, y: f64, z: f64) -> Point3<f64> {
        Point3::new(x, y, z)
    }

    fn block(x: f64, y: f64, w: f64, d: f64, low: f64, high: f64) -> Body {
        let ring = vec![p(x, y, low), p(x + w, y, low), p(x + w, y + d, low), p(x, y + d, low)];
        Body::swept(&vec![ring], Vector3::new(0.0, 0.0, high - low))
    }

    fn measured(regions: &[Region]) -> (f64, usize) {
        (area(regions).round(), regions.iter().map(|r| r.outer.len()).sum())
    }

    #[test]
    fn a_body_covers_what_its_faces_cover_whichever_way_they_look() {
        let effort = &mut Effort::default();
        let mut body = block(0.0, 0.0, 400.0, 200.0, 0.0, 270.0);
        assert_eq!(measured(&body.footprint(effort)), (80_000.0, 4));
        for (k, face) in body.faces.iter_mut().enumerate() {
            if k % 2 == 0 {
                face[0].reverse();
            }
        }
        assert_eq!(measured(&body.footprint(effort)), (80_000.0, 4));
        // An L of two boxes in one heap of faces.
        body.faces.extend(block(0.0, 0.0, 100.0, 500.0, 50.0, 300.0).faces);
        assert_eq!(measured(&body.footprint(effort)), (110_000.0, 6));
        assert_eq!(measured(&body.floor(effort)), (80_000.0, 4));
        // Upright faces alone: what they stand round.
        body.faces.retain(|f| f[0][0].z.to_bits() != f[0][2].z.to_bits());
        assert_eq!(measured(&body.footprint(effort)), (155_000.0, 5));
    }

    #[test]
    fn what_is_cut_away_is_no_floor() {
        let effort = &mut Effort::default();
        let mut body = block(0.0, 0.0, 400.0, 200.0, 0.0, 270.0);
        body.clip(p(300.0, 0.0, 0.0), Vector3::x());
        assert_eq!(measured(&body.footprint(effort)), (60_000.0, 4));
        // A sloping roof leaves the floor, and lowers the top.
        body.clip(p(0.0, 0.0, 100.0), Vector3::new(-1.0, 0.0, 1.0));
        assert_eq!(measured(&body.floor(effort)), (60_000.0, 4));
        assert_eq!(body.heights(), Some((0.0, 270.0)));
        body.less.push(block(0.0, 0.0, 100.0, 100.0, -10.0, 60.0));
        assert_eq!(measured(&body.floor(effort)), (50_000.0, 6));
        assert_eq!(measured(&body.footprint(effort)), (60_000.0, 4));
    }
}
