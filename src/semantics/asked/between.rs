//! What lies between two things, and between a thing and a wall.

use crate::facts::Value;
use crate::geometry::contact::{Footprint, gap, length_within, overlap_area};
use crate::geometry::{Polygon, convex_hull};
use crate::measure::{per_mille, tenths};
use crate::units::{Point, ReplicaId, Vector};

use super::{Asked, Placed};
use crate::body::Body;

/// What covers less of a strip only touches it, cm².
const TOUCHED: f64 = 1.0;
/// A strip shorter than this lies before no wall, cm.
const SHORTEST: f64 = 1.0;

impl Asked<'_, '_> {
    fn thing(&self, value: Option<&Value>) -> Option<&Body> {
        match self.placed(value)? {
            Placed::Thing(id) => self.body(id),
            Placed::Area(_) | Placed::Opening(_) => None,
        }
    }

    pub(super) fn body(&self, id: ReplicaId) -> Option<&Body> {
        self.relations.measurements().bodies.get(&id)
    }

    pub(super) fn bodies(&self) -> impl Iterator<Item = &Body> {
        self.relations.measurements().bodies.values()
    }
}

/// `amid(x, +a, +b, how, v)`: what lies in the plan between two things of one Map, and how: "way", what it takes of the
/// shortest way from one to the other; "aside", how far beside that way it is; "share", which share of it lies where both
/// are in sight.
pub(super) fn amid(
    asked: &Asked<'_, '_>,
    known: &[Option<Value>],
    tell: &mut dyn FnMut(&[Value]),
) -> Option<()> {
    let [a, b] = [known[1].clone()?, known[2].clone()?];
    let (first, second) = (asked.thing(Some(&a))?, asked.thing(Some(&b))?);
    if first.map != second.map || first.id == second.id {
        return None;
    }
    let (from, to) = way_between(first, second);
    let along = (to - from).try_normalize(1e-6)?;
    let corners = [&first.hull, &second.hull].map(|h| h.polygon.corners.clone()).concat();
    let amid = Footprint::new(Polygon::new(convex_hull(corners)));
    let reach = asked.relations.thresholds().between_aside;
    let near = amid.bounds.grown(reach);
    let others = asked.bodies().filter(|x| x.id != first.id && x.id != second.id);
    for x in others.filter(|x| x.map == first.map && x.bounds.meets(&near)) {
        let Some(symbol) = asked.symbol(x.id) else { continue };
        let mut row = |how: &str, v: i64| {
            tell(&[symbol.clone(), a.clone(), b.clone(), Value::from(how), Value::Number(v)]);
        };
        let way = tenths(length_within(from, to, &x.hull));
        if way > 0 {
            row("way", way);
        }
        if let Some(aside) = aside(&x.hull, from, along, (to - from).norm()) {
            row("aside", tenths(aside));
        }
        let own = overlap_area(&x.hull, &amid)
            - overlap_area(&x.hull, &first.hull)
            - overlap_area(&x.hull, &second.hull);
        let share = per_mille(own / x.hull.area);
        if share > 0 {
            row("share", share);
        }
    }
    Some(())
}

/// The shortest way from one thing to another in the plan; between their middles where one lies over the other.
pub(crate) fn way_between(first: &Body, second: &Body) -> (Point, Point) {
    let way = gap(&first.hull, &second.hull);
    if way.distance > 0.0 { (way.from, way.to) } else { (first.centre, second.centre) }
}

/// How far beside a way a convex outline lies; none where none of it is alongside.
fn aside(hull: &Footprint, from: Point, along: Vector, length: f64) -> Option<f64> {
    let place = |p: Point| ((p - from).dot(&along), along.perp(&(p - from)));
    let (mut near, mut far) = (f64::INFINITY, f64::NEG_INFINITY);
    let (mut first, mut last) = (f64::INFINITY, f64::NEG_INFINITY);
    for (p, q) in hull.polygon.edges() {
        let ((s, a), (t, b)) = (place(p), place(q));
        let (low, high) = (s.min(t).max(0.0), s.max(t).min(length));
        if low > high {
            continue;
        }
        let at = |along: f64| a + (b - a) * (along - s) / (t - s);
        let is_across = (t - s).abs() < 1e-9;
        for off in if is_across { [a, b] } else { [at(low), at(high)] } {
            (near, far) = (near.min(off), far.max(off));
        }
        (first, last) = (first.min(low), last.max(high));
    }
    // What only reaches to the end of the way is not alongside.
    (last - first > 1e-6)
        .then(|| if near <= 0.0 && far >= 0.0 { 0.0 } else { near.abs().min(far.abs()) })
}

/// `before_wall(x, +a, r, wall, d)`: what covers some of the strip between the whole side of a thing and a wall of its
/// Area, and how far the thing is from that wall.
pub(super) fn before_wall(
    asked: &Asked<'_, '_>,
    known: &[Option<Value>],
    tell: &mut dyn FnMut(&[Value]),
) -> Option<()> {
    let a = known[1].clone()?;
    let body = asked.thing(Some(&a))?;
    let area = asked.relations.area_of(body.id)?;
    let room = Value::Symbol(asked.relations.symbols().area(area).clone());
    for (n, wall) in asked.relations.measurements().walls(area).enumerate() {
        let Some(away) = asked.relations.distance_to_segment(body.id, wall) else { continue };
        let Some(strip) = strip(body, wall, away) else { continue };
        let others = asked.bodies().filter(|x| x.id != body.id && x.map == body.map);
        for x in others.filter(|x| x.bounds.meets(&strip.bounds)) {
            if overlap_area(&x.hull, &strip) >= TOUCHED
                && let Some(symbol) = asked.symbol(x.id)
            {
                let numbers = [n as i64, tenths(away)].map(Value::Number);
                let [n, away] = numbers;
                tell(&[symbol, a.clone(), room.clone(), n, away]);
            }
        }
    }
    Some(())
}

/// What lies between the whole side of a thing and a wall; none where the thing is beside the wall's ends.
fn strip(body: &Body, wall: (Point, Point), away: f64) -> Option<Footprint> {
    let along = (wall.1 - wall.0).try_normalize(1e-9)?;
    let inwards = Vector::new(-along.y, along.x);
    let places = body.hull.polygon.corners.iter().map(|p| (p - wall.0).dot(&along));
    let (from, to) = places
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), at| (low.min(at), high.max(at)));
    let (from, to) = (from.max(0.0), to.min((wall.1 - wall.0).norm()));
    if to - from < SHORTEST {
        return None;
    }
    let corner = |at: f64, off: f64| wall.0 + along * at + inwards * off;
    let corners = vec![corner(from, 0.0), corner(to, 0.0), corner(to, away), corner(from, away)];
    Some(Footprint::new(Polygon::new(corners)))
}
