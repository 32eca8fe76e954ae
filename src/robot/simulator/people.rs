//! People who walk about in the simulated world: each in one room, from point to point, with rests. Whoever would walk
//! into the robot stands, and after a while goes elsewhere.

use fastrand::Rng;

use crate::geometry::{Scene, nearest_on_segment};
use crate::units::{AreaId, MapId, Point};

use super::Simulator;

/// Of a person as a laser sees it at the height of the shins and the body touches it, cm.
pub(super) const GIRTH: f64 = 22.0;
/// How near to walls and things a person walks, and how near to the robot, cm from the middle of the one to the border of
/// the other.
const KEPT: f64 = 30.0;
const POLITE: f64 = 45.0;
/// cm/s.
const PACE: f64 = 80.0;
/// A person rests for up to so long, and stands for so long before the robot until it goes elsewhere, seconds.
const REST: f64 = 4.0;
const PATIENCE: f64 = 2.0;
/// Steps of a walk are no longer than this, seconds.
const STEP: f64 = 0.1;
/// Points that are tried for a way from where one is.
const TRIES: usize = 40;

#[derive(Debug, Clone)]
pub(super) struct Walker {
    map: MapId,
    area: AreaId,
    pub(super) at: Point,
    goal: Point,
    rests_until: f64,
    stands: f64,
}

impl Walker {
    /// Somebody in a room of the robot's Map, away from the robot; none where there is no room for anybody.
    pub(super) fn appear(body: &Simulator, dice: &mut Rng) -> Option<Self> {
        let scene = Scene::of(&body.truth, body.map);
        let areas: Vec<AreaId> = scene.areas.keys().copied().collect();
        (0..TRIES).find_map(|_| {
            let area = *areas.get(dice.usize(..areas.len().max(1)))?;
            let at = somewhere(&scene, area, dice)?;
            let is_free = (at - body.pose.at).norm() > body.profile.radius.get() + 2.0 * POLITE
                && clearance(body, at, at) > KEPT;
            let (map, goal) = (body.map, at);
            is_free.then_some(Self { map, area, at, goal, rests_until: 0.0, stands: 0.0 })
        })
    }

    /// Whether it is on the robot's Map.
    pub(super) fn is_on(&self, map: MapId) -> bool {
        self.map == map
    }

    /// Walks on from one moment to another, seconds.
    pub(super) fn walk(&mut self, body: &Simulator, from: f64, to: f64, dice: &mut Rng) {
        if !self.is_on(body.map) {
            return;
        }
        let mut now = from;
        while now < to {
            let step = STEP.min(to - now);
            now += step;
            if now < self.rests_until {
                continue;
            }
            let way = self.goal - self.at;
            if way.norm() < 1.0 {
                self.choose(body, now, dice);
                continue;
            }
            let next = self.at + way * (PACE * step / way.norm()).min(1.0);
            let (before, after) = ((self.at - body.pose.at).norm(), (next - body.pose.at).norm());
            if after < body.profile.radius.get() + POLITE && after < before {
                self.stands += step;
                if self.stands > PATIENCE {
                    self.choose(body, now, dice);
                }
                continue;
            }
            self.stands = 0.0;
            self.at = next;
        }
    }

    /// Another point to which a straight way leads, past the robot; else it rests.
    fn choose(&mut self, body: &Simulator, now: f64, dice: &mut Rng) {
        self.stands = 0.0;
        self.rests_until = now + dice.f64() * REST;
        let scene = Scene::of(&body.truth, body.map);
        // Who is nearer to something than people like, by a leaf that was opened, may walk on from there.
        let kept = KEPT.min(clearance(body, self.at, self.at) - 1.0);
        for _ in 0..TRIES {
            let Some(goal) = somewhere(&scene, self.area, dice) else { continue };
            let past = nearest_on_segment(body.pose.at, self.at, goal) - body.pose.at;
            let here = (self.at - body.pose.at).norm();
            let is_away = past.norm() > (body.profile.radius.get() + POLITE).min(here - 1.0);
            if is_away && clearance(body, self.at, goal) > kept {
                self.goal = goal;
                return;
            }
        }
    }
}

/// A point of a room.
fn somewhere(scene: &Scene, area: AreaId, dice: &mut Rng) -> Option<Point> {
    let prism = scene.areas.get(&area)?.prisms.first()?;
    let (low, size) = (prism.bounds.min, prism.bounds.max - prism.bounds.min);
    let at = Point::new(low.x + size.x * dice.f64(), low.y + size.y * dice.f64());
    prism.polygon.contains(at, 0.0).then_some(at)
}

/// How near a straight way comes to what the robot may not touch either, cm.
fn clearance(body: &Simulator, from: Point, to: Point) -> f64 {
    let edges = body.edges.iter().map(|edge| {
        let ends = [
            nearest_on_segment(edge.a, from, to) - edge.a,
            nearest_on_segment(edge.b, from, to) - edge.b,
            nearest_on_segment(from, edge.a, edge.b) - from,
            nearest_on_segment(to, edge.a, edge.b) - to,
        ];
        match crosses((from, to), (edge.a, edge.b)) {
            true => 0.0,
            false => ends.iter().map(|gap| gap.norm()).fold(f64::INFINITY, f64::min),
        }
    });
    edges.fold(f64::INFINITY, f64::min)
}

fn crosses((a, b): (Point, Point), (c, d): (Point, Point)) -> bool {
    let side = |p: Point, q: Point, r: Point| (q - p).perp(&(r - p));
    side(a, b, c) * side(a, b, d) < 0.0 && side(c, d, a) * side(c, d, b) < 0.0
}
