//! Free floor and ways in ugly worlds: rooms of several crooked pieces, slivers, boards, frustums, duplicates, rings,
//! things across walls and far from the origin. Nothing here is square, whole or apart by design.

use orthoframe_geometry::*;
use orthoframe_map::*;
use orthoframe_units::*;

use crate::files::long;
use crate::floor_properties::{Random, by_visibility_graph};
use crate::floors::{Builder, Opening, Part, p, rectangle};
use crate::routes::check_invariants;

/// A polygon with its corners at random distances in every direction about a centre, counter-clockwise.
fn star(random: &mut Random, centre: Point, corners: usize, near: f64, far: f64) -> Vec<Point> {
    let turn = random.between(0.0, std::f64::consts::TAU);
    let step = std::f64::consts::TAU / corners as f64;
    (0..corners)
        .map(|k| {
            let angle = turn + step * (k as f64 + random.between(-0.35, 0.35));
            centre + Vector::new(angle.cos(), angle.sin()) * random.between(near, far)
        })
        .collect()
}

/// A crooked room with an alcove on one of its sides, full of ugly things.
pub(crate) fn ugly(seed: u64) -> (Builder, AreaId) {
    let mut random = Random(seed.wrapping_mul(977) + 13);
    let mut b = Builder::new();
    let corners = 5 + (random.unit() * 8.0) as usize;
    let room = star(&mut random, p(0.0, 0.0), corners, 220.0, 420.0);
    // The alcove hangs on a side and is open towards it.
    let side = (random.unit() * corners as f64) as usize;
    let (a, c) = (room[side], room[(side + 1) % corners]);
    let out = Vector::new(c.y - a.y, a.x - c.x).normalize() * random.between(60.0, 200.0);
    let squeeze = random.between(0.0, 0.3);
    let alcove = vec![a, a + out + (c - a) * squeeze, c + out - (c - a) * squeeze, c];
    let parts: [Part<'_>; 2] = [
        (&room, Frame::IDENTITY, &[(side, Opening::Passage)]),
        (&alcove, Frame::IDENTITY, &[(3, Opening::Passage)]),
    ];
    let area = b.area_of("Зал", &parts, Frame::IDENTITY);
    let mut last: Option<(ObjectId, Frame)> = None;
    for _ in 0..(4 + (random.unit() * 9.0) as usize) {
        let at = p(random.between(-380.0, 380.0), random.between(-380.0, 380.0));
        let turn = Deg::of(random.between(0.0, 360.0));
        let mut frame = Frame::new(at.x, at.y, 0.0, turn);
        let object = match (random.unit() * 10.0) as u32 {
            0 => {
                let count = 3 + (random.unit() * 9.0) as usize;
                let base = star(&mut random, p(0.0, 0.0), count, 8.0, 70.0);
                b.object(&[(&base, 0.0, 90.0)])
            }
            1 => b.object(&[(&rectangle(random.between(30.0, 220.0), 0.03), 0.0, 200.0)]),
            2 => b.object(&[(&rectangle(random.between(20.0, 120.0), 0.0), 0.0, 60.0)]),
            // A board of no height at some height.
            3 => b.object(&[(&rectangle(80.0, 50.0), random.between(1.0, 160.0), 0.0)]),
            // A frustum, narrow or wide above.
            4 => {
                let object = b.object(&[(&rectangle(60.0, 60.0), 0.0, 150.0)]);
                let base = b.world.objects[&object].items[0].orthoframe;
                let scale = random.between(0.0, 2.2);
                b.world.orthoframes.get_mut(&base).expect("just made").roof_scale = scale;
                object
            }
            // The same again in the same place.
            5 => match last {
                Some((object, same)) => {
                    frame = same;
                    object
                }
                None => b.object(&[(&rectangle(40.0, 40.0), 0.0, 80.0)]),
            },
            // Two that share a side, and one within another.
            6 => {
                let next: Vec<Point> =
                    rectangle(30.0, 40.0).iter().map(|c| c + Vector::new(50.0, 0.0)).collect();
                b.object(&[
                    (&rectangle(50.0, 40.0), 0.0, 80.0),
                    (&next, 0.0, 80.0),
                    (&rectangle(20.0, 10.0), 0.0, 40.0),
                ])
            }
            // A ring of blocks with floor within.
            7 => {
                let (outer, inner) = (random.between(60.0, 110.0), random.between(20.0, 55.0));
                let at = |k: usize, r: f64| {
                    let angle = k as f64 * std::f64::consts::TAU / 7.0;
                    p(r * angle.cos(), r * angle.sin())
                };
                let blocks: Vec<Vec<Point>> = (0..7)
                    .map(|k| vec![at(k, inner), at(k, outer), at(k + 1, outer), at(k + 1, inner)])
                    .collect();
                let parts: Vec<(&[Point], f64, f64)> =
                    blocks.iter().map(|block| (&block[..], 0.0, 70.0)).collect();
                b.object(&parts)
            }
            // A table: four legs and a top.
            8 => {
                let leg = |x: f64, y: f64| -> Vec<Point> {
                    rectangle(4.0, 4.0).iter().map(|c| c + Vector::new(x, y)).collect()
                };
                let legs = [leg(0.0, 0.0), leg(96.0, 0.0), leg(96.0, 56.0), leg(0.0, 56.0)];
                let mut parts: Vec<(&[Point], f64, f64)> =
                    legs.iter().map(|l| (&l[..], 0.0, 71.0)).collect();
                let top = rectangle(100.0, 60.0);
                parts.push((&top, 71.0, 3.0));
                b.object(&parts)
            }
            _ => b.object(&[(&rectangle(random.between(5.0, 150.0), 35.0), 0.0, 100.0)]),
        };
        last = Some((object, frame));
        b.place_object(area, object, frame);
    }
    b.world.robot.radius = Cm::of(random.between(6.0, 32.0));
    b.world.robot.clearance =
        Cm::of(if random.unit() < 0.5 { 0.0 } else { random.between(0.0, 6.0) });
    b.world.robot.height = Cm::of(random.between(20.0, 160.0));
    (b, area)
}

fn build(b: &Builder) -> FloorPlan {
    FloorPlan::build(&b.world, MapId(1), &b.world.robot, &DoorStates::new())
}

/// What a robot can meet of every prism, looked at anew: its widest section within the robot's height.
fn solids(plan: &FloorPlan) -> Vec<Polygon> {
    let (step, height) = (plan.robot().step.get(), plan.robot().height.get());
    let prisms = plan.scene().replicas.values().flat_map(|r| &r.prisms);
    let met = prisms.filter_map(|prism| {
        let (low, high) = (prism.bottom.max(step), prism.top.min(height));
        let is_met = if prism.top > prism.bottom {
            prism.top > step && prism.bottom < height
        } else {
            prism.bottom > step && prism.bottom < height
        };
        let scale = |z: f64| {
            let share = if prism.top > prism.bottom {
                (z - prism.bottom) / (prism.top - prism.bottom)
            } else {
                0.0
            };
            1.0 + (prism.roof_scale - 1.0) * share.clamp(0.0, 1.0)
        };
        let widest = scale(low).max(scale(high));
        let centre = prism.polygon.centroid();
        let corners = prism.polygon.corners.iter().map(|c| centre + (c - centre) * widest);
        is_met.then(|| Polygon::new(corners.collect()))
    });
    met.collect()
}

/// How far a point is from everything solid.
fn clear(plan: &FloorPlan, solids: &[Polygon], q: Point) -> f64 {
    let things = solids.iter().map(|s| {
        let inside = s.signed_area().abs() > 1e-9 && s.contains(q, 0.0);
        if inside { 0.0 } else { s.border_distance(q) }
    });
    let walls = plan.fragments().flat_map(|f| &f.walls);
    let walls = walls.map(|&(a, b)| (nearest_on_segment(q, a, b) - q).norm());
    things.chain(walls).fold(f64::INFINITY, f64::min)
}

fn overlap(a: &Polygon, b: &Polygon) -> f64 {
    // Sutherland and Hodgman: both are convex.
    let mut rest = a.corners.clone();
    for (u, v) in b.edges() {
        let height = |q: &Point| (v - u).perp(&(q - u));
        let n = rest.len();
        let mut kept = Vec::new();
        for i in 0..n {
            let (s, t) = (rest[i], rest[(i + 1) % n]);
            let (hs, ht) = (height(&s), height(&t));
            if hs >= 0.0 {
                kept.push(s);
            }
            if hs * ht < 0.0 {
                kept.push(s + (t - s) * (hs / (hs - ht)));
            }
        }
        rest = kept;
        if rest.len() < 3 {
            return 0.0;
        }
    }
    Polygon::new(rest).signed_area().abs()
}

#[test]
fn the_partition_is_the_free_floor_and_nothing_twice() {
    let mut frames = 0;
    for seed in 0..40 {
        let (b, area) = ugly(seed);
        let plan = build(&b);
        check_invariants(&plan);
        let floor = plan.fragment(area).expect("the only room");
        frames += floor.passframes().len();
        for (i, one) in floor.passframes().iter().enumerate() {
            for other in &floor.passframes()[i + 1..] {
                let twice = overlap(&one.polygon, &other.polygon);
                assert!(twice < 0.02, "seed {seed}: {} and {} share {twice}", one.id, other.id);
            }
        }
        let (solids, free) = (solids(&plan), floor.free());
        let mut random = Random(seed + 5000);
        let radius = plan.robot().radius.get() + plan.robot().clearance.get();
        for _ in 0..200 {
            let q = p(random.between(-600.0, 600.0), random.between(-600.0, 600.0));
            let is_free = free.iter().any(|r| r.contains(q, 0.0));
            let room = clear(&plan, &solids, q);
            let on_floor = plan.scene().area_at(q).is_some();
            if is_free {
                assert!(on_floor && room > -1e-3, "seed {seed}: {q:?} is free within {room}");
                let inside = solids.iter().any(|s| {
                    s.signed_area().abs() > 1.0 && s.contains(q, 0.0) && s.border_distance(q) > 0.01
                });
                assert!(!inside, "seed {seed}: {q:?} is free within a thing");
            }
            if on_floor && room > radius * 1.0125 + 0.01 {
                assert!(is_free, "seed {seed}: {q:?} is {room} from everything and not free");
            }
        }
    }
    assert!(frames > 300, "{frames}");
}

#[test]
fn ways_keep_clear_and_none_is_shorter() {
    let (mut ways, mut none) = (0, 0);
    for seed in 40..if long() { 80 } else { 56 } {
        let (b, area) = ugly(seed);
        let plan = build(&b);
        let floor = plan.fragment(area).expect("the only room");
        let centre = floor.centre();
        let regions: Vec<&Region> = centre.iter().collect();
        let corners: usize =
            regions.iter().flat_map(|r| r.contours()).map(|c| c.corners.len()).sum();
        let solids = solids(&plan);
        let reach = plan.robot().radius.get() + plan.robot().clearance.get();
        let mut random = Random(seed + 6000);
        for _ in 0..12 {
            let mut spot = || p(random.between(-420.0, 420.0), random.between(-420.0, 420.0));
            let (from, to) = (spot(), spot());
            if !floor.fits(from) || !floor.fits(to) {
                continue;
            }
            let target = Target::Point(to);
            let short = plan.route(&b.world, from, target, Method::Shortest);
            let paper = plan.route(&b.world, from, target, Method::Paper);
            let (Ok(short), Ok(paper)) = (&short, &paper) else {
                assert!(short.is_err() && paper.is_err(), "seed {seed}: {from:?} {to:?}");
                if corners < 110 {
                    assert_eq!(by_visibility_graph(&regions, from, to), None, "seed {seed}");
                }
                none += 1;
                continue;
            };
            ways += 1;
            for route in [short, paper] {
                for leg in route.points.windows(2) {
                    let steps = ((leg[1] - leg[0]).norm() / 3.0).ceil().max(1.0) as usize;
                    for k in 0..=steps {
                        let q = leg[0] + (leg[1] - leg[0]) * (k as f64 / steps as f64);
                        let room = clear(&plan, &solids, q);
                        assert!(room > reach - 0.01, "seed {seed}: {q:?} has {room} of {reach}");
                    }
                }
            }
            assert!(paper.length > short.length - 1e-6);
            if corners < 110 {
                let least = by_visibility_graph(&regions, from, to).expect("there is a way");
                assert!(
                    (least - short.length).abs() < 0.02,
                    "seed {seed}: {least} {}",
                    short.length
                );
            }
        }
    }
    assert!(ways > if long() { 60 } else { 20 }, "{ways} ways, {none} pairs without one");
}

#[test]
fn a_world_turned_and_moved_far_away_has_the_same_floor_and_ways() {
    for seed in 80..100 {
        let (b, area) = ugly(seed);
        let (near, turn) = (build(&b), 17.3 + seed as f64);
        let outer = Frame::new(1.0e6, -7.0e5, 0.0, Deg::of(turn));
        let moved = ugly(seed).0.moved(1.0e6, -7.0e5, turn);
        let far = build(&moved);
        let free = |plan: &FloorPlan| -> f64 {
            plan.fragment(area).expect("the only room").free().iter().map(Region::area).sum()
        };
        let (one, other) = (free(&near), free(&far));
        assert!((one - other).abs() < 1.0 + 1e-4 * one, "seed {seed}: {one} {other}");
        let mut random = Random(seed + 7000);
        for _ in 0..4 {
            let mut spot = || p(random.between(-400.0, 400.0), random.between(-400.0, 400.0));
            let (from, to) = (spot(), spot());
            let floor = near.fragment(area).expect("the only room");
            if !floor.fits(from) || !floor.fits(to) {
                continue;
            }
            let way = |plan: &FloorPlan, world: &World, from, to| {
                plan.route(world, from, Target::Point(to), Method::Shortest).ok().map(|r| r.length)
            };
            let here = way(&near, &b.world, from, to);
            let there = way(&far, &moved.world, outer.apply(from), outer.apply(to));
            match (here, there) {
                (Some(a), Some(b)) => assert!((a - b).abs() < 0.1, "seed {seed}: {a} {b}"),
                (None, None) => {}
                other => panic!("seed {seed}: {from:?} {to:?} {other:?}"),
            }
        }
    }
}

#[test]
fn taking_ugly_things_away_and_putting_them_back_equals_building_anew() {
    for seed in 100..112 {
        let (mut b, _) = ugly(seed);
        let mut plan = build(&b);
        let mut random = Random(seed + 8000);
        let ids: Vec<ReplicaId> = b.world.replicas.keys().copied().collect();
        for _ in 0..4 {
            let id = ids[(random.unit() * ids.len() as f64) as usize];
            let there = b.world.replicas.remove(&id);
            if there.is_none() || random.unit() < 0.6 {
                let mut thing = there.unwrap_or_else(|| {
                    b.world.replicas.values().next().expect("not all are gone").clone()
                });
                thing.id = id;
                let (x, y) = (random.between(-420.0, 420.0), random.between(-420.0, 420.0));
                thing.frame = Frame::new(x, y, 0.0, Deg::of(random.between(0.0, 360.0)));
                b.world.replicas.insert(id, thing);
            }
            plan.rebuild(&b.world, &[id]);
            let fresh = build(&b);
            for (old, new) in plan.fragments().zip(fresh.fragments()) {
                assert!(old == new, "seed {seed}");
            }
        }
    }
}

#[test]
fn one_stands_before_ugly_things_as_near_as_it_goes() {
    let mut reached = 0;
    for seed in 120..150 {
        let (b, area) = ugly(seed);
        let plan = build(&b);
        let floor = plan.fragment(area).expect("the only room");
        let Some(from) = plan.rest_in(area) else { continue };
        let solids = solids(&plan);
        let reach = plan.robot().radius.get() + plan.robot().clearance.get();
        assert!(floor.fits(from), "seed {seed}");
        for &id in b.world.replicas.keys() {
            let Ok(route) = plan.route(&b.world, from, Target::Replica(id), Method::Shortest)
            else {
                continue;
            };
            let end = *route.points.last().expect("two points at least");
            assert!(clear(&plan, &solids, end) > reach - 0.01, "seed {seed}");
            let placed = &plan.scene().replicas[&id];
            let away = placed.prisms.iter().map(|f| f.polygon.border_distance(end));
            let away = away.fold(f64::INFINITY, f64::min);
            // It looks towards the thing: its middle, or where it is nearest, which for a ring may be behind the middle.
            let Some(heading) = route.heading else { continue };
            let (sin, cos) = heading.sin_cos();
            let ahead = |at: Point| (at - end).dot(&Vector::new(cos, sin)) > 0.0;
            let centre = nalgebra::center(&placed.bounds.min, &placed.bounds.max);
            let sides = placed.prisms.iter().flat_map(|f| f.polygon.edges());
            let nearest = sides
                .map(|(a, b)| nearest_on_segment(end, a, b))
                .min_by(|u, v| (u - end).norm().total_cmp(&(v - end).norm()))
                .expect("a thing has sides");
            if away < 100.0 && route.moved_goal.is_none() {
                reached += 1;
                assert!(ahead(centre) || ahead(nearest), "seed {seed}: {end:?} from {centre:?}");
            }
        }
    }
    assert!(reached > 40, "{reached}");
}
