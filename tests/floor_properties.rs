//! Promises of the free floor and of routes, on many random worlds, against the obvious slow versions.

use std::collections::BinaryHeap;

use orthoframe_geometry::*;
use orthoframe_map::*;
use orthoframe_units::*;

use crate::floors::{Builder, p, rectangle, two_rooms};
use crate::routes::{check_invariants, check_route};

/// A small generator of random numbers, the same on every machine.
pub(crate) struct Random(pub(crate) u64);

impl Random {
    pub(crate) fn unit(&mut self) -> f64 {
        // SplitMix64
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub(crate) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * self.unit()
    }
}

/// Two rooms with things thrown in, some on the centimetre and straight, some at any place and angle.
pub(crate) fn random_world(seed: u64) -> Builder {
    let mut random = Random(seed);
    let gap = if seed.is_multiple_of(3) { 0.0 } else { 12.0 };
    let kind = if seed.is_multiple_of(2) { DoorKind::Hinged } else { DoorKind::Sliding };
    let (mut b, one, two, _) = two_rooms(gap, kind, DoorState::OPEN);
    for area in [one, two] {
        for _ in 0..(random.between(1.0, 9.0) as usize) {
            let (x, y) = (random.between(0.0, 380.0), random.between(0.0, 280.0));
            let (w, d) = (random.between(5.0, 90.0), random.between(5.0, 60.0));
            if random.unit() < 0.5 {
                b.put(area, x.round(), y.round(), w.round(), d.round(), 0.0, 100.0);
            } else {
                b.put(area, x, y, w, d, random.between(0.0, 360.0), 100.0);
            }
        }
    }
    b.world.robot.radius = Cm::of(random.between(12.0, 30.0).round());
    b
}

fn build(b: &Builder) -> FloorPlan {
    FloorPlan::build(&b.world, MapId(1), &b.world.robot, &DoorStates::new())
}

fn solid_distance(plan: &FloorPlan, q: Point) -> f64 {
    let mut least = f64::INFINITY;
    for floor in plan.fragments() {
        for &(a, b) in &floor.walls {
            least = least.min((q - nearest_on_segment(q, a, b)).norm());
        }
        for obstacle in floor.obstacles() {
            let inside = obstacle.polygon.contains(q, 0.0);
            least = least.min(if inside { 0.0 } else { obstacle.polygon.border_distance(q) });
        }
    }
    least
}

#[test]
fn the_centre_space_is_where_the_disc_fits() {
    for seed in 0..25 {
        let b = random_world(seed);
        let plan = build(&b);
        check_invariants(&plan);
        let radius = plan.reach();
        let mut random = Random(seed + 1000);
        for _ in 0..150 {
            let q = p(random.between(-20.0, 830.0), random.between(-20.0, 320.0));
            let on_floor = plan.scene().area_at(q).is_some();
            let room = solid_distance(&plan, q);
            let fits = plan.fragments().any(|f| f.fits(q));
            if on_floor && room > radius * 1.0125 + 0.001 {
                assert!(fits, "seed {seed}: {q:?} has {room} of {radius}");
            }
            if room < radius - 0.005 {
                assert!(!fits, "seed {seed}: {q:?} has {room} of {radius}");
            }
        }
    }
}

#[test]
fn dead_zones_are_what_no_position_covers() {
    for seed in 0..25 {
        let b = random_world(seed);
        let plan = build(&b);
        let radius = plan.reach();
        let mut random = Random(seed + 2000);
        for floor in plan.fragments() {
            let (centre, free) = (floor.centre(), floor.free());
            let centre_distance = |q: Point| {
                let inside = centre.iter().any(|r| r.contains(q, 1e-6));
                let rim = centre
                    .iter()
                    .flat_map(|r| r.contours().map(|c| c.border_distance(q)).collect::<Vec<_>>());
                if inside { 0.0 } else { rim.fold(f64::INFINITY, f64::min) }
            };
            for _ in 0..100 {
                let at = floor.bounds;
                let q = p(random.between(at.min.x, at.max.x), random.between(at.min.y, at.max.y));
                if floor.dead_zone_at(q).is_some() && !near_doorway(&plan, q) {
                    // The line that closes a gap lies inside the disc that touches both sides.
                    assert!(
                        centre_distance(q) > radius * 0.86,
                        "seed {seed}: {q:?} {}",
                        centre_distance(q)
                    );
                }
                if free.iter().any(|r| r.contains(q, 0.0)) && !near_doorway(&plan, q) {
                    let far = centre_distance(q);
                    assert!(far < radius * 2.1, "seed {seed}: {q:?} {far}");
                }
            }
        }
    }
}

fn near_doorway(plan: &FloorPlan, q: Point) -> bool {
    plan.doorways().iter().any(|d| (d.middle() - q).norm() < d.width() / 2.0 + 2.0 * plan.reach())
}

/// Shortest way over a visibility graph of the centre space's corners, by brute force.
pub(crate) fn by_visibility_graph(regions: &[&Region], from: Point, to: Point) -> Option<f64> {
    let edges: Vec<(Point, Point)> = regions
        .iter()
        .flat_map(|r| r.contours())
        .flat_map(|c| c.edges().collect::<Vec<_>>())
        .collect();
    let mut nodes = vec![from, to];
    nodes.extend(edges.iter().map(|e| e.0));
    let sees = |a: Point, b: Point| {
        let crosses = |(u, v): &(Point, Point)| {
            let side = |p: Point, q: Point, r: Point| {
                let (along, to) = (q - p, r - p);
                along.perp(&to) / along.norm().max(1e-12)
            };
            let (su, sv) = (side(a, b, *u), side(a, b, *v));
            let (sa, sb) = (side(*u, *v, a), side(*u, *v, b));
            const TOUCH: f64 = 1e-4;
            su.abs() > TOUCH
                && sv.abs() > TOUCH
                && su * sv < 0.0
                && sa.abs() > TOUCH
                && sb.abs() > TOUCH
                && sa * sb < 0.0
        };
        let inside = |t: f64| {
            let q = a + (b - a) * t;
            regions.iter().any(|r| r.contains(q, 2e-4))
        };
        !edges.iter().any(crosses) && (1..40).all(|k| inside(f64::from(k) / 40.0))
    };
    let mut least = vec![f64::INFINITY; nodes.len()];
    least[0] = 0.0;
    let mut open = BinaryHeap::from([(std::cmp::Reverse(0_u64), 0_usize)]);
    let mut done = vec![false; nodes.len()];
    while let Some((_, at)) = open.pop() {
        if std::mem::replace(&mut done[at], true) {
            continue;
        }
        if at == 1 {
            return Some(least[1]);
        }
        for next in 0..nodes.len() {
            let price = least[at] + (nodes[next] - nodes[at]).norm();
            if !done[next] && price < least[next] && sees(nodes[at], nodes[next]) {
                least[next] = price;
                open.push((std::cmp::Reverse(price.to_bits()), next));
            }
        }
    }
    None
}

#[test]
fn no_way_is_shorter_than_the_one_found() {
    let mut found = 0;
    for seed in 24..40 {
        let mut b = random_world(seed);
        // One room: the visibility graph is drawn inside one Fragment.
        b.world.doors.values_mut().for_each(|d| d.state = DoorState::CLOSED);
        let plan = build(&b);
        let floor = plan.fragments().next().unwrap();
        let centre = floor.centre();
        let regions: Vec<&Region> = centre.iter().collect();
        let mut random = Random(seed + 3000);
        for _ in 0..3 {
            let mut spot = || p(random.between(0.0, 400.0), random.between(0.0, 300.0));
            let (from, to) = (spot(), spot());
            if !floor.fits(from) || !floor.fits(to) {
                continue;
            }
            let slow = by_visibility_graph(&regions, from, to);
            let fast = plan.route(&b.world, from, Target::Point(to), Method::Shortest);
            match (slow, fast) {
                (Some(slow), Ok(fast)) => {
                    found += 1;
                    check_route(&plan, &b.world, &fast);
                    assert!(
                        (slow - fast.length).abs() < 0.01,
                        "seed {seed}: {slow} {}",
                        fast.length
                    );
                }
                (None, Err(_)) => {}
                (slow, fast) => panic!("seed {seed}: {from:?} {to:?} {slow:?} {fast:?}"),
            }
        }
    }
    assert!(found > 12, "{found}");
}

#[test]
fn random_routes_keep_clear_by_both_methods() {
    let mut found = 0;
    for seed in 100..115 {
        let b = random_world(seed);
        let plan = build(&b);
        let mut random = Random(seed);
        for _ in 0..4 {
            let from = p(random.between(0.0, 400.0), random.between(0.0, 300.0));
            let to = p(random.between(420.0, 800.0), random.between(0.0, 300.0));
            for method in [Method::Shortest, Method::Paper] {
                match plan.route(&b.world, from, Target::Point(to), method) {
                    Ok(route) => {
                        found += 1;
                        check_route(&plan, &b.world, &route);
                    }
                    Err(no) => assert!(!matches!(no, NoRoute::OtherMap { .. }), "{no:?}"),
                }
            }
        }
    }
    assert!(found > 40, "{found}");
}

#[test]
fn a_mirrored_world_has_mirrored_ways() {
    for seed in 200..220 {
        let mut random = Random(seed);
        let things: Vec<[f64; 4]> = (0..6)
            .map(|_| {
                [
                    random.between(40.0, 340.0),
                    random.between(40.0, 240.0),
                    random.between(10.0, 60.0),
                    random.between(10.0, 60.0),
                ]
            })
            .collect();
        let world = |mirror: bool| {
            let mut b = Builder::new();
            let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
            for &[x, y, w, d] in &things {
                b.put(hall, if mirror { 400.0 - x - w } else { x }, y, w, d, 0.0, 100.0);
            }
            b
        };
        let (plain, mirrored) = (world(false), world(true));
        let length = |b: &Builder, from: Point, to: Point| {
            let found = build(b).route(&b.world, from, Target::Point(to), Method::Shortest);
            found
                .ok()
                .filter(|r| r.moved_start.is_none() && r.moved_goal.is_none())
                .map(|r| r.length)
        };
        let a = length(&plain, p(30.0, 30.0), p(370.0, 270.0));
        let b = length(&mirrored, p(370.0, 30.0), p(30.0, 270.0));
        match (a, b) {
            (Some(a), Some(b)) => assert!((a - b).abs() < 1e-3, "{a} {b}"),
            (None, None) => {}
            other => panic!("{other:?}"),
        }
    }
}

#[test]
fn rebuilding_after_any_move_equals_building_anew() {
    for seed in 300..308 {
        let mut b = random_world(seed);
        let mut plan = build(&b);
        let mut random = Random(seed);
        let ids: Vec<ReplicaId> = b.world.replicas.keys().copied().collect();
        for _ in 0..3 {
            let id = ids[(random.unit() * ids.len() as f64) as usize];
            let replica = b.world.replicas.get_mut(&id).unwrap();
            replica.frame = Frame::new(
                random.between(0.0, 390.0),
                random.between(0.0, 290.0),
                0.0,
                Deg::of(random.between(0.0, 360.0)),
            );
            plan.rebuild(&b.world, &[id]);
            let fresh = build(&b);
            for (old, new) in plan.fragments().zip(fresh.fragments()) {
                assert!(old == new, "seed {seed}: Area {:?}", old.area);
            }
        }
    }
}
