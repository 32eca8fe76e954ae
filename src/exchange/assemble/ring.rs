//! Outlines as files give them, made into simple polygons; regions with holes, cut into pieces without.
//!
//! **Invariant.** The rings of a [`Region`] are simple, are nowhere nearer to each other than [`NEAR`], and have no two
//! neighbouring corners nearer than that; the floor lies to the left of each: the outer ring runs counter-clockwise, holes
//! clockwise.

use std::ops::ControlFlow;

use i_overlay::core::fill_rule::FillRule;
use i_overlay::core::overlay_rule::OverlayRule;
use i_overlay::core::solver::Solver;
use i_overlay::float::overlay::{FloatOverlay, OverlayOptions};
use i_overlay::float::slice::FloatSlice;

use crate::map::plane::{bounds, doubled_area, edges, meeting, near_pairs, segment_distance};
use crate::units::{InOrder as _, Point, Vector};

/// A closed chain of corners, without the closing one.
pub(crate) type Ring = Vec<Point>;

/// Corners nearer than this are one, cm; twice what the map's checks call the same place.
pub(crate) const NEAR: f64 = 0.1;
/// Sides of one ring nearer than this meet, cm: more than what is lost when a place is told from another corner, and twice what
/// [`pieces`] takes for the same place.
const TOUCHING: f64 = 2e-3;
/// A corner that stands out from the line between its neighbours by less is none, cm.
const STRAIGHT: f64 = 1e-4;
/// Floor smaller than this is none, cm².
pub(crate) const LEAST_AREA: f64 = 400.0;

/// A connected piece of floor.
#[derive(Debug, Clone, PartialEq, Default)]
pub(crate) struct Region {
    pub(crate) outer: Ring,
    pub(crate) holes: Vec<Ring>,
}

impl Region {
    pub(crate) fn rings(&self) -> impl Iterator<Item = &Ring> {
        std::iter::once(&self.outer).chain(&self.holes)
    }

    pub(crate) fn area(&self) -> f64 {
        self.rings().map(|ring| doubled_area(ring)).sum::<f64>() / 2.0
    }

    pub(crate) fn contains(&self, p: Point) -> bool {
        // Even-odd over all rings: a point in a hole is within two of them.
        self.rings().filter(|ring| crate::map::plane::contains(ring, p)).count() % 2 == 1
    }

    pub(crate) fn border_distance(&self, p: Point) -> f64 {
        self.rings()
            .flat_map(|ring| edges(ring))
            .map(|edge| segment_distance(p, edge))
            .fold(f64::INFINITY, f64::min)
    }
}

/// A cleaned outline and whether anything but points without meaning had to go.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Cleaned {
    pub(crate) region: Region,
    pub(crate) was_crossed: bool,
    pub(crate) bad_holes: usize,
}

/// Makes a region of an outline of any rotation with any dirt; None when nothing of it is floor.
pub(crate) fn clean(outline: &[Point], holes: &[Vec<Point>]) -> Option<Cleaned> {
    let outer = tidy(outline);
    let mut rings = Vec::with_capacity(holes.len());
    let mut bad_holes = 0;
    for hole in holes {
        match tidy(hole) {
            ring if ring.len() >= 3 && doubled_area(&ring).abs() >= 2.0 * NEAR => rings.push(ring),
            _ => bad_holes += 1,
        }
    }
    if outer.len() < 3 {
        return None;
    }
    let is_simple = is_simple(&outer);
    if is_simple && rings.is_empty() {
        let region = Region { outer: counter_clockwise(outer), holes: Vec::new() };
        return (region.area() >= LEAST_AREA).then_some(Cleaned {
            region,
            was_crossed: false,
            bad_holes,
        });
    }
    let shapes = overlay(&[outer], &rings, OverlayRule::Difference, FillRule::NonZero);
    let kept = rings.len();
    let region = largest(shapes)?;
    let was_crossed = !is_simple;
    bad_holes += kept.saturating_sub(region.holes.len());
    Some(Cleaned { region, was_crossed, bad_holes })
}

/// The outline of a part of a thing: simple, counter-clockwise, of any size that is one.
pub(crate) fn clean_part(outline: &[Point]) -> Option<Ring> {
    let ring = tidy(outline);
    let ring = if is_simple(&ring) {
        ring
    } else {
        overlay(&[ring], &[], OverlayRule::Subject, FillRule::NonZero)
            .into_iter()
            .filter(|r| is_simple(&r.outer))
            .max_by(|a, b| a.area().total_cmp(&b.area()))?
            .outer
    };
    (ring.len() >= 3 && doubled_area(&ring).abs() > 0.02).then(|| counter_clockwise(ring))
}

/// Without the closing point, repeated corners, corners on a straight line, and spikes.
pub(crate) fn tidy(points: &[Point]) -> Ring {
    let mut ring: Ring = points.to_vec();
    loop {
        let before = ring.len();
        let mut kept: Ring = Vec::with_capacity(ring.len());
        for &p in &ring {
            if kept.last().is_none_or(|&q: &Point| (p - q).norm() > NEAR) {
                kept.push(p);
            }
        }
        while kept.len() > 1 && (kept[0] - kept[kept.len() - 1]).norm() <= NEAR {
            kept.pop();
        }
        ring = without_straight(&kept);
        if ring.len() == before || ring.len() < 3 {
            return ring;
        }
    }
}

/// Drops corners that do not turn, each judged by the corners that stay.
fn without_straight(ring: &[Point]) -> Ring {
    let mut kept: Ring = Vec::with_capacity(ring.len());
    let n = ring.len();
    for i in 0..n {
        let before = kept.last().copied().unwrap_or(ring[n - 1]);
        if !is_straight(before, ring[i], ring[(i + 1) % n]) {
            kept.push(ring[i]);
        }
    }
    kept
}

/// Whether `p` lies on the line from `a` to `b`, or sticks out from it without width.
fn is_straight(a: Point, p: Point, b: Point) -> bool {
    let (u, v) = (p - a, b - p);
    let longest = u.norm().max(v.norm());
    longest <= 0.0 || u.perp(&v).abs() / longest < STRAIGHT
}

pub(crate) fn counter_clockwise(mut ring: Ring) -> Ring {
    if doubled_area(&ring) < 0.0 {
        ring.reverse();
    }
    ring
}

/// Whether no two sides meet but neighbours in their common corner.
pub(crate) fn is_simple(ring: &[Point]) -> bool {
    let sides: Vec<_> = edges(ring).collect();
    let boxes: Vec<_> = sides.iter().map(|&(a, b)| bounds([a, b])).collect();
    let n = sides.len();
    let mut is_simple = n >= 3;
    near_pairs(&boxes, TOUCHING, |i, j| {
        if is_simple && crosses(&sides, n, i, j) {
            is_simple = false;
        }
        if is_simple { ControlFlow::Continue(()) } else { ControlFlow::Break(()) }
    });
    is_simple
}

fn crosses(sides: &[(Point, Point)], n: usize, i: usize, j: usize) -> bool {
    let follows = |a: usize, b: usize| (a + 1) % n == b;
    if follows(i, j) || follows(j, i) {
        let (first, second) = if follows(i, j) { (i, j) } else { (j, i) };
        let (u, v) = (sides[first].1 - sides[first].0, sides[second].1 - sides[second].0);
        return u.perp(&v).abs() <= 1e-9 * u.norm() * v.norm() && u.dot(&v) < 0.0;
    }
    meet(sides[i], sides[j], TOUCHING)
}

/// Whether two sides meet or come nearer than that.
fn meet(one: (Point, Point), other: (Point, Point), touching: f64) -> bool {
    let touches = |p: Point, side| segment_distance(p, side) < touching;
    meeting(one, other).is_some()
        || touches(one.0, other)
        || touches(one.1, other)
        || touches(other.0, one)
        || touches(other.1, one)
}

/// Whether no ring of a region meets another.
pub(crate) fn is_sound(region: &Region) -> bool {
    if !region.rings().all(|ring| is_simple(ring)) || doubled_area(&region.outer) <= 0.0 {
        return false;
    }
    let sides: Vec<(usize, (Point, Point))> = region
        .rings()
        .enumerate()
        .flat_map(|(k, ring)| edges(ring).map(move |edge| (k, edge)))
        .collect();
    if region.holes.is_empty() {
        return true;
    }
    let boxes: Vec<_> = sides.iter().map(|&(_, (a, b))| bounds([a, b])).collect();
    let mut is_sound = true;
    near_pairs(&boxes, NEAR, |i, j| {
        if sides[i].0 != sides[j].0 && meet(sides[i].1, sides[j].1, NEAR) {
            is_sound = false;
            return ControlFlow::Break(());
        }
        ControlFlow::Continue(())
    });
    is_sound
}

type Contour = Vec<[f64; 2]>;

fn contour(ring: &[Point]) -> Contour {
    ring.iter().map(|p| [p.x, p.y]).collect()
}

fn points(contour: &[[f64; 2]]) -> Ring {
    contour.iter().map(|&[x, y]| Point::new(x, y)).collect()
}

/// A boolean operation; no ring of the result touches itself or another in more than points.
pub(crate) fn overlay(
    subject: &[Ring],
    clip: &[Ring],
    rule: OverlayRule,
    fill: FillRule,
) -> Vec<Region> {
    shapes(subject, clip, rule, fill).iter().filter_map(|shape| region(shape)).collect()
}

/// The shapes of a boolean operation as i_overlay gives them: slivers, which are no floor, among them.
fn shapes(subject: &[Ring], clip: &[Ring], rule: OverlayRule, fill: FillRule) -> Vec<Vec<Contour>> {
    let subject: Vec<Contour> = subject.iter().map(|r| contour(r)).collect();
    let clip: Vec<Contour> = clip.iter().map(|r| contour(r)).collect();
    FloatOverlay::<[f64; 2], i64>::from_subj_and_clip_custom(
        &subject,
        &clip,
        OverlayOptions::ogc(),
        Solver::default(),
    )
    .overlay(rule, fill)
}

/// A shape of i_overlay as a region; rings without area are left out.
fn region(shape: &[Contour]) -> Option<Region> {
    let mut rings = shape.iter().map(|c| tidy(&points(c)));
    let outer = counter_clockwise(rings.next().filter(|ring| ring.len() >= 3)?);
    let holes = rings
        .filter(|ring| ring.len() >= 3 && doubled_area(ring).abs() >= 2.0 * NEAR)
        .map(|ring| {
            let mut hole = counter_clockwise(ring);
            hole.reverse();
            hole
        })
        .collect();
    Some(Region { outer, holes })
}

/// The largest sound region, when it is floor at all.
pub(crate) fn largest(regions: Vec<Region>) -> Option<Region> {
    floors(regions).into_iter().next()
}

/// The sound regions that are floor at all, the largest first.
pub(super) fn floors(regions: Vec<Region>) -> Vec<Region> {
    let sound = regions.into_iter().flat_map(unpinched);
    let mut floors: Vec<Region> = sound.filter(|r| r.area() >= LEAST_AREA).collect();
    floors.order_by(|a, b| b.area().total_cmp(&a.area()));
    floors
}

/// A region whose rings touch themselves or each other loses a hair of floor there, which parts them.
fn unpinched(region: Region) -> Vec<Region> {
    if is_sound(&region) {
        return vec![region];
    }
    // Touching places are cut out of the floor; i_overlay then finds sound rings.
    let rings: Vec<Ring> = region.rings().cloned().collect();
    let cuts = pinches(&rings);
    if cuts.is_empty() {
        return Vec::new();
    }
    overlay(&rings, &cuts, OverlayRule::Difference, FillRule::NonZero)
        .into_iter()
        .filter(is_sound)
        .collect()
}

/// What lies within `margin` of a line, its ends squared; counter-clockwise.
pub(crate) fn band((a, b): (Point, Point), margin: f64) -> Ring {
    let along = (b - a).try_normalize(NEAR).unwrap_or(Vector::x()) * margin;
    let left = Vector::new(-along.y, along.x);
    let (a, b) = (a - along, b + along);
    vec![a - left, b - left, b + left, a + left]
}

/// The places at which rings meet that should not, a hair wider: squares round points, bands along lines.
fn pinches(rings: &[Ring]) -> Vec<Ring> {
    let mut sides = Vec::new();
    for (k, ring) in rings.iter().enumerate() {
        for (i, edge) in edges(ring).enumerate() {
            sides.push((k, i, edge));
        }
    }
    let boxes: Vec<_> = sides.iter().map(|&(.., (a, b))| bounds([a, b])).collect();
    let mut found = Vec::new();
    near_pairs(&boxes, NEAR, |i, j| {
        let ((k, a, one), (l, b, other)) = (sides[i], sides[j]);
        let n = rings[k].len();
        let are_neighbours = k == l && ((a + 1) % n == b || (b + 1) % n == a);
        if are_neighbours {
            return ControlFlow::Continue(());
        }
        let touching = if k == l { TOUCHING } else { NEAR };
        let near = |p: &Point, side| segment_distance(*p, side) < touching;
        let mut places: Vec<Point> =
            [one.0, one.1].into_iter().filter(|p| near(p, other)).collect();
        places.extend([other.0, other.1].into_iter().filter(|p| near(p, one)));
        places.extend(meeting(one, other));
        if let Some(&first) = places.first() {
            let far = |p: &Point| (*p - first).norm();
            let last = places.into_iter().max_by(|p, q| far(p).total_cmp(&far(q)));
            found.push(band((first, last.unwrap_or(first)), 2.0 * NEAR));
        }
        ControlFlow::Continue(())
    });
    found
}

/// The floor of `region` outside of `others`.
pub(crate) fn subtract(region: &Region, others: &[Ring]) -> Vec<Region> {
    let rings: Vec<Ring> = region.rings().cloned().collect();
    let both: Vec<Region> = overlay(&rings, others, OverlayRule::Difference, FillRule::NonZero);
    both
}

/// The common floor of two regions, cm², and the length of its border, cm. Two walls that cross at a hair's breadth
/// have a sliver in common that is no floor and yet counts.
pub(crate) fn common(one: &Region, other: &Region) -> (f64, f64) {
    let rings = |r: &Region| r.rings().cloned().collect::<Vec<_>>();
    let shapes = shapes(&rings(one), &rings(other), OverlayRule::Intersect, FillRule::NonZero);
    let (mut area, mut around) = (0.0, 0.0);
    for shape in &shapes {
        for (k, contour) in shape.iter().enumerate() {
            let ring = points(contour);
            let within = doubled_area(&ring).abs() / 2.0;
            area += if k == 0 { within } else { -within };
            around += edges(&ring).map(|(a, b)| (b - a).norm()).sum::<f64>();
        }
    }
    (area, around)
}

/// A region with holes as pieces without, cut by upright slits from its holes to the next ring above and below.
/// Pieces share their cuts exactly. `is_closed` tells of sides that no slit may end on: doors.
pub(crate) fn pieces(region: &Region, is_closed: impl Fn(Point, Point) -> bool) -> Vec<Ring> {
    if region.holes.is_empty() {
        return vec![region.outer.clone()];
    }
    let sides: Vec<(Point, Point)> = region.rings().flat_map(|ring| edges(ring)).collect();
    let slits: Vec<Contour> =
        region.holes.iter().flat_map(|hole| slits(hole, &sides, &is_closed)).collect();
    let rings: Vec<Contour> = region.rings().map(|r| contour(r)).collect();
    let corners: Vec<Point> = region.rings().flatten().copied().collect();
    rings
        .slice_by_as::<i64>(&slits, FillRule::NonZero)
        .iter()
        .filter(|shape| shape.len() == 1)
        .map(|shape| with_corners(&counter_clockwise(points(&shape[0])), &corners))
        .filter(|ring| ring.len() >= 3 && doubled_area(ring) > 2.0)
        .collect()
}

/// Slicing drops corners that do not turn, such as jambs: puts those back that lie on a ring's sides.
fn with_corners(ring: &[Point], corners: &[Point]) -> Ring {
    let mut full = Vec::with_capacity(ring.len());
    for (p, q) in edges(ring) {
        let is_corner = |end: Point| corners.iter().copied().find(|c| (c - end).norm() < 1e-3);
        // The file's own point, where rounding moved it by a hair.
        full.push(is_corner(p).unwrap_or(p));
        let mut on: Vec<(f64, Point)> = corners
            .iter()
            .copied()
            .filter(|&c| (c - p).norm() > 1e-3 && (c - q).norm() > 1e-3)
            .filter(|&c| segment_distance(c, (p, q)) < 1e-3)
            .map(|c| ((c - p).norm(), c))
            .collect();
        on.order_by(|a, b| a.0.total_cmp(&b.0));
        full.extend(on.into_iter().map(|(_, c)| c));
    }
    full
}

/// How many places of a hole are tried for its slits.
const TRIES: usize = 16;

/// The slits of a hole, where its upper and its lower side are far from all corners.
fn slits(
    hole: &[Point],
    sides: &[(Point, Point)],
    is_closed: &impl Fn(Point, Point) -> bool,
) -> Vec<Contour> {
    let (low, high) = bounds(hole.iter().copied());
    let mut xs: Vec<f64> = sides
        .iter()
        .map(|side| side.0.x)
        .filter(|&x| x > low.x && x < high.x)
        .chain([low.x, high.x])
        .collect();
    xs.sort_by(f64::total_cmp);
    let mut gaps: Vec<(f64, f64)> = xs.windows(2).map(|w| (w[0], w[1])).collect();
    gaps.order_by(|a, b| (b.1 - b.0).total_cmp(&(a.1 - a.0)));
    let cut = |(from, to): (f64, f64)| {
        let is_wide = to - from > 2.0 * NEAR;
        let x = f64::midpoint(from, to);
        let mut hits: Vec<(f64, (Point, Point))> = sides
            .iter()
            .filter(|(a, b)| (a.x > x) != (b.x > x))
            .map(|&(a, b)| (a.y + (x - a.x) / (b.x - a.x) * (b.y - a.y), (a, b)))
            .collect();
        hits.order_by(|a, b| a.0.total_cmp(&b.0));
        let own = |hit: &(f64, (Point, Point))| edges(hole).any(|edge| edge == hit.1);
        let first = hits.iter().position(own)?;
        let last = hits.iter().rposition(own)?;
        let below = hits.get(first.checked_sub(1)?)?;
        let above = hits.get(last + 1)?;
        let is_free =
            [below, above, &hits[first], &hits[last]].iter().all(|(_, (a, b))| !is_closed(*a, *b));
        let slit = |from: f64, to: f64| vec![[x, from - 0.01], [x, to + 0.01]];
        Some((is_free && is_wide, [slit(below.0, hits[first].0), slit(hits[last].0, above.0)]))
    };
    let mut tried = gaps.into_iter().take(TRIES).filter_map(cut);
    let Some(first) = tried.next() else { return Vec::new() };
    let best = if first.0 { first } else { tried.find(|t| t.0).unwrap_or(first) };
    best.1.into()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn ring(points: &[(f64, f64)]) -> Ring {
        points.iter().map(|&(x, y)| Point::new(x, y)).collect()
    }

    fn rect(x: f64, y: f64, w: f64, h: f64) -> Ring {
        ring(&[(x, y), (x + w, y), (x + w, y + h), (x, y + h)])
    }

    #[test]
    fn dirt_goes_and_the_floor_stays() {
        let dirty = ring(&[
            (0.0, 0.0),
            (0.0, 300.0),
            (0.0, 300.01),
            (200.0, 300.0),
            (400.0, 300.0),
            (450.0, 300.0),
            (400.0, 300.0),
            (400.0, 0.0),
            (0.0, 0.0),
        ]);
        let cleaned = clean(&dirty, &[]).expect("a room");
        assert!(!cleaned.was_crossed);
        assert_eq!(cleaned.region.outer.len(), 4);
        assert!((cleaned.region.area() - 120_000.0).abs() < 10.0);
    }

    #[test]
    fn a_bow_tie_keeps_its_larger_half() {
        let bow = ring(&[(0.0, 0.0), (400.0, 300.0), (400.0, 0.0), (0.0, 100.0)]);
        let cleaned = clean(&bow, &[]).expect("half a room");
        assert!(cleaned.was_crossed && is_sound(&cleaned.region));
        assert!(clean(&ring(&[(0.0, 0.0), (500.0, 0.0), (900.0, 0.0)]), &[]).is_none());
        assert!(clean(&rect(0.0, 0.0, 500.0, 0.5), &[]).is_none());
    }

    #[test]
    fn a_court_keeps_its_holes() {
        let holes = vec![rect(100.0, 100.0, 50.0, 50.0), rect(300.0, 200.0, 50.0, 50.0)];
        let cleaned = clean(&rect(0.0, 0.0, 600.0, 400.0), &holes).expect("a room");
        assert_eq!(cleaned.region.holes.len(), 2);
        assert!((cleaned.region.area() - 235_000.0).abs() < 1.0);
    }

    #[test]
    fn rings_that_touch_in_a_point_are_parted() {
        // Two squares that share a corner: the larger one is kept.
        let pinched = ring(&[
            (0.0, 0.0),
            (100.0, 0.0),
            (100.0, 100.0),
            (300.0, 100.0),
            (300.0, 300.0),
            (100.0, 300.0),
            (100.0, 100.0),
            (0.0, 100.0),
        ]);
        let cleaned = clean(&pinched, &[]).expect("a room");
        assert!(is_sound(&cleaned.region));
        assert!((cleaned.region.area() - 40_000.0).abs() < 50.0);
    }
}
