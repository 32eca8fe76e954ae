//! Free floor, Passframes and routes on small worlds, against slow independent checks.

use std::collections::BTreeMap;

use orthoframe_geometry::*;
use orthoframe_map::*;
use orthoframe_units::*;

use crate::floors::{Builder, Opening, p, rectangle, two_rooms};

fn plan(b: &Builder) -> FloorPlan {
    FloorPlan::build(&b.world, MapId(1), &b.world.robot, &DoorStates::new())
}

fn area_of(regions: &[Region]) -> f64 {
    regions.iter().map(Region::area).sum()
}

/// Everything that must hold of any plan.
pub(crate) fn check_invariants(plan: &FloorPlan) {
    for floor in plan.fragments() {
        let frames: f64 = floor.passframes().iter().map(|f| f.polygon.signed_area()).sum();
        let free = area_of(&floor.free());
        assert!((frames - free).abs() <= 1e-6 * free.max(1.0), "partition {frames} of {free}");
        let dead: f64 = floor.dead_zones().iter().map(|z| z.area()).sum();
        assert!(free + dead <= area_of(&floor.raw()) + 1.0);
        for (i, frame) in floor.passframes().iter().enumerate() {
            assert!(frame.polygon.is_convex(1e-6), "{:?}", frame.polygon);
            let c = frame.polygon.centroid();
            for other in &floor.passframes()[i + 1..] {
                assert_ne!(frame.id, other.id);
                let inside =
                    other.polygon.contains(c, 0.0) && other.polygon.border_distance(c) > 1e-3;
                assert!(!inside, "overlap");
            }
        }
    }
}

/// Every point of a route keeps the robot's radius from every wall and prism of the scene, measured anew.
pub(crate) fn check_route(plan: &FloorPlan, world: &World, route: &Route) {
    let radius = plan.robot().radius.get();
    let (step, height) = (plan.robot().step.get(), plan.robot().height.get());
    for leg in route.points.windows(2) {
        let count = ((leg[1] - leg[0]).norm() / 2.0).ceil().max(1.0) as usize;
        for k in 0..=count {
            let q = leg[0] + (leg[1] - leg[0]) * (k as f64 / count as f64);
            for replica in plan.scene().replicas.values() {
                for prism in &replica.prisms {
                    if prism.top > step && prism.bottom < height {
                        let gap = prism.polygon.border_distance(q);
                        let inside = prism.polygon.contains(q, 0.0);
                        assert!(
                            !inside && gap > radius - 0.006,
                            "{q:?} is {gap} from {:?}",
                            prism.owner
                        );
                    }
                }
            }
            for doorway in plan.doorways() {
                if let Some(door) = doorway.door.map(|d| &world.doors[&d]) {
                    for leaf in doorway.leaves(door).at(plan.door_state(world, door.id)) {
                        if door.kind == DoorKind::Hinged {
                            assert!(leaf.border_distance(q) > radius - 0.006, "leaf at {q:?}");
                        }
                    }
                }
            }
            for floor in plan.fragments() {
                for &(a, b) in &floor.walls {
                    let gap = (q - nearest_on_segment(q, a, b)).norm();
                    assert!(gap > radius - 0.006, "{q:?} is {gap} from the wall {a:?} {b:?}");
                }
            }
        }
    }
    assert!(plan.clearance(&route.points) > radius - 0.006);
    let sum: f64 = route.points.windows(2).map(|l| (l[1] - l[0]).norm()).sum();
    assert!((sum - route.length).abs() < 1e-6);
    assert!(!plan.passed(route).chain.is_empty());
}

fn both_ways(b: &Builder, from: Point, to: Point) -> (Route, Route) {
    let plan = plan(b);
    check_invariants(&plan);
    let go = |method| {
        plan.route(&b.world, from, Target::Point(to), method).unwrap_or_else(|e| panic!("{e:?}"))
    };
    let (short, paper) = (go(Method::Shortest), go(Method::Paper));
    check_route(&plan, &b.world, &short);
    check_route(&plan, &b.world, &paper);
    assert!(short.length <= paper.length + 1e-6);
    assert!(short.length >= (to - from).norm() - 1e-6 || short.moved_goal.is_some());
    (short, paper)
}

#[test]
fn an_empty_room_is_crossed_straight() {
    let mut b = Builder::new();
    b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    let (short, _) = both_ways(&b, p(50.0, 50.0), p(350.0, 250.0));
    assert_eq!(short.points.len(), 2);
    assert_eq!(plan(&b).passframes(AreaId(2)).len(), 1);
}

#[test]
fn the_way_bends_round_a_pillar() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    b.put(hall, 180.0, 130.0, 40.0, 40.0, 0.0, 100.0);
    let (short, _) = both_ways(&b, p(50.0, 150.0), p(350.0, 150.0));
    // Two tangents of 45 high corners and the arcs between: the exact way with a disc of 25.
    let exact = exact_round_box(150.0, 20.0, 20.0, 25.0);
    assert!(
        short.length >= exact - 0.02 && short.length < exact * 1.0005,
        "{} {exact}",
        short.length
    );
}

/// Length of the tightest string from (-d, 0) to (d, 0) over a box of half sizes w, h, at distance r.
fn exact_round_box(d: f64, w: f64, h: f64, r: f64) -> f64 {
    // Tangent from (-d, 0) to the circle of radius r about (-w, h).
    let (dx, dy): (f64, f64) = (d - w, h);
    let c = dx.hypot(dy);
    let tangent = (c * c - r * r).sqrt();
    let angle = dy.atan2(dx) + (r / c).asin();
    2.0 * (tangent + r * angle + w)
}

#[test]
fn an_open_door_is_passed_with_and_without_a_wall() {
    for gap in [0.0, 12.0] {
        for kind in [DoorKind::Hinged, DoorKind::Sliding] {
            let (b, ..) = two_rooms(gap, kind, DoorState::OPEN);
            let (short, paper) = both_ways(&b, p(60.0, 250.0), p(750.0, 50.0));
            let plan = plan(&b);
            assert!([short, paper].iter().all(|way| plan.passed(way).doorways.len() == 1));
        }
    }
}

#[test]
fn a_closed_door_is_named() {
    let (b, _, _, door) = two_rooms(12.0, DoorKind::Hinged, DoorState::LOCKED);
    let plan = plan(&b);
    let no = plan
        .route(&b.world, p(60.0, 250.0), Target::Point(p(750.0, 50.0)), Method::Shortest)
        .unwrap_err();
    assert_eq!(no.barriers(), [Barrier::Door { door, status: DoorStatus::Locked }]);
    // Opened in thought only, the way is there.
    let opened = plan.with_doors(&b.world, &BTreeMap::from([(door, DoorState::OPEN)]));
    assert!(
        opened
            .route(&b.world, p(60.0, 250.0), Target::Point(p(750.0, 50.0)), Method::Shortest)
            .is_ok()
    );
}

#[test]
fn a_robot_wider_than_its_door_is_told_both_widths() {
    let (mut b, ..) = two_rooms(0.0, DoorKind::Sliding, DoorState::OPEN);
    b.world.robot.radius = Cm::of(45.05);
    let no = plan(&b)
        .route(&b.world, p(100.0, 150.0), Target::Point(p(700.0, 150.0)), Method::Shortest)
        .unwrap_err();
    match no.barriers() {
        [Barrier::Narrow { width, needed, .. }] => {
            assert!((width - 90.0).abs() < 1e-9 && (needed - 90.1).abs() < 1e-9);
        }
        other => panic!("{other:?}"),
    }
    b.world.robot.radius = Cm::of(45.0);
    assert!(
        plan(&b)
            .route(&b.world, p(100.0, 150.0), Target::Point(p(700.0, 150.0)), Method::Shortest)
            .is_ok()
    );
}

#[test]
fn a_gap_too_narrow_is_a_dead_zone_with_its_width_and_owners() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    let one = b.put(hall, 180.0, 0.0, 40.0, 126.0, 0.0, 100.0);
    let two = b.put(hall, 180.0, 174.0, 40.0, 126.0, 0.0, 100.0);
    let plan = plan(&b);
    check_invariants(&plan);
    let floor = plan.fragment(hall).unwrap();
    let zone = floor.dead_zone_at(p(200.0, 150.0)).expect("a dead zone");
    let around = plan.around(floor, zone);
    assert!((around.gap.unwrap() - 48.0).abs() < 1e-3);
    let owner = |replica| Blocker::Replica { replica, item: 0 };
    assert_eq!(around.owners, [owner(one), owner(two)]);
    let no = plan
        .route(&b.world, p(60.0, 150.0), Target::Point(p(350.0, 150.0)), Method::Shortest)
        .unwrap_err();
    match no.barriers() {
        [Barrier::Gap { width, needed, between, .. }] => {
            assert!((width - 48.0).abs() < 1e-3 && (needed - 50.0).abs() < 1e-9);
            for id in [one, two] {
                assert!(between.contains(&Blocker::Replica { replica: id, item: 0 }));
            }
        }
        other => panic!("{other:?}"),
    }
}

#[test]
fn heights_decide_what_stands_in_the_way() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(600.0, 300.0), Frame::IDENTITY, &[]);
    let top = rectangle(100.0, 60.0);
    let slab = |b: &mut Builder, x: f64, bottom: f64, height: f64| {
        let object = b.object(&[(&top, bottom, height)]);
        b.place_object(hall, object, Frame::new(x, 100.0, 0.0, Deg::ZERO))
    };
    let table = slab(&mut b, 50.0, 74.0, 4.0);
    slab(&mut b, 200.0, 125.0, 4.0); // above the robot
    slab(&mut b, 350.0, 0.0, 1.5); // a rug
    let shelf = slab(&mut b, 480.0, 60.0, 0.0); // no thickness
    let plan = plan(&b);
    check_invariants(&plan);
    let floor = plan.fragment(hall).unwrap();
    let who = |x: f64| floor.obstacle_at(p(x, 130.0)).map(|o| o.blocker);
    assert_eq!(who(100.0), Some(Blocker::Replica { replica: table, item: 0 }));
    assert_eq!(who(250.0), None);
    assert_eq!(who(400.0), None);
    assert_eq!(who(530.0), Some(Blocker::Replica { replica: shelf, item: 0 }));
    assert!((area_of(&floor.raw()) - (600.0 * 300.0 - 2.0 * 6000.0)).abs() < 1e-3);
}

#[test]
fn rooms_at_any_angle_and_far_away_behave_alike() {
    let build = || {
        let (mut b, one, two, _) = two_rooms(10.0, DoorKind::Hinged, DoorState::OPEN);
        b.put(one, 150.0, 80.0, 60.0, 140.0, 0.0, 100.0);
        b.put(two, 100.0, 60.0, 90.0, 50.0, 30.0, 100.0);
        b
    };
    let (from, to) = (p(60.0, 150.0), p(700.0, 60.0));
    let straight = both_ways(&build(), from, to).0.length;
    for (x, y, turn) in [(0.0, 0.0, 17.3), (1e6, -1e6, 0.0), (-1e6, 1e6, 217.3), (5.0, 5.0, 90.0)] {
        let outer = Frame::new(x, y, 0.0, Deg::of(turn));
        let moved = build().moved(x, y, turn);
        let (short, _) = both_ways(&moved, outer.apply(from), outer.apply(to));
        assert!((short.length - straight).abs() < 2e-2, "{turn}: {} {straight}", short.length);
    }
}

#[test]
fn one_stands_before_a_door_clear_of_its_leaf() {
    let (b, one, two, door) = two_rooms(10.0, DoorKind::Hinged, DoorState::CLOSED);
    let plan = plan(&b);
    for (area, ahead) in [(one, 0.0), (two, 180.0)] {
        let pose = plan.stand_before(&b.world, door, area).unwrap();
        assert!((pose.heading - Deg::of(ahead)).signed().abs() < 40.0, "{pose:?}");
        let doorway = plan.doorways_of(door).next().unwrap();
        for swept in doorway.leaves(&b.world.doors[&door]).swept((0.0, 100.0)) {
            assert!(!swept.contains(pose.at, 0.0) && swept.border_distance(pose.at) > 24.99);
        }
        assert!(plan.fragment(area).unwrap().fits(pose.at));
    }
}

#[test]
fn through_the_door_from_stand_to_stand() {
    let (b, one, two, door) = two_rooms(10.0, DoorKind::Hinged, DoorState::CLOSED);
    let opened = plan(&b).with_doors(&b.world, &BTreeMap::from([(door, DoorState::OPEN)]));
    let from = opened.stand_before(&b.world, door, one).unwrap().at;
    let route = opened
        .route_within(
            &b.world,
            from,
            Target::Door { door, area: two },
            Method::Shortest,
            Some(&[one, two]),
        )
        .unwrap();
    check_route(&opened, &b.world, &route);
    assert_eq!(opened.passed(&route).doorways.len(), 1);
}

#[test]
fn a_start_in_a_dead_place_is_moved_and_said_so() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    let sofa = b.put(hall, 0.0, 0.0, 100.0, 60.0, 0.0, 80.0);
    let plan = plan(&b);
    let route = plan
        .route(&b.world, p(50.0, 30.0), Target::Point(p(350.0, 10.0)), Method::Shortest)
        .unwrap();
    let moved = route.moved_start.unwrap();
    assert_eq!(moved.blocker, Some(Blocker::Replica { replica: sofa, item: 0 }));
    assert!((moved.to - p(50.0, 85.0)).norm() < 0.02, "{moved:?}");
    assert!((route.moved_goal.unwrap().to - p(350.0, 25.0)).norm() < 0.02);
}

#[test]
fn one_stands_in_front_of_a_thing_and_faces_it() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(400.0, 300.0), Frame::IDENTITY, &[]);
    let case = b.put(hall, 150.0, 270.0, 100.0, 30.0, 0.0, 180.0);
    let object = b.world.replicas[&case].object;
    b.world.objects.get_mut(&object).unwrap().front =
        Some(SideRef { item: "I0".into(), side: "S0".into() });
    let route =
        plan(&b).route(&b.world, p(50.0, 50.0), Target::Replica(case), Method::Shortest).unwrap();
    let at = *route.points.last().unwrap();
    assert!((at - p(200.0, 242.0)).norm() < 0.1, "{at:?}");
    assert_eq!(route.heading, Some(Deg::of(90.0)));
}

#[test]
fn a_door_behind_what_fills_its_room_from_wall_to_wall_is_not_reached() {
    let to_door = |x: f64, depth: f64| {
        let (mut b, one, _, door) = two_rooms(10.0, DoorKind::Hinged, DoorState::CLOSED);
        let rack = b.put(one, x, 0.0, 40.0, depth, 0.0, 200.0);
        let before = Target::Door { door, area: one };
        (plan(&b).route(&b.world, p(50.0, 150.0), before, Method::Shortest), rack)
    };
    for x in [120.0, 200.0, 300.0] {
        let (barred, rack) = to_door(x, 300.0);
        let barred = barred.unwrap_err();
        let by_rack = Blocker::Replica { replica: rack, item: 0 };
        let names_it =
            |b: &Barrier| matches!(b, Barrier::Enclosed { by, .. } if by.contains(&by_rack));
        assert!(barred.barriers().iter().any(names_it), "{x}: {barred:?}");
        // With a way round it one stands behind it.
        let way = to_door(x, 200.0).0;
        let way = way.unwrap_or_else(|e| panic!("{x}: {e:?}"));
        assert!(way.points.last().unwrap().x > x + 40.0, "{x}: {way:?}");
    }
    // No robot fits between this one and the door.
    assert!(to_door(355.0, 300.0).0.is_err());
}

/// A chest close to a door on the far side of its wall, with its front to the wall; the room before and behind it.
fn a_chest_behind_a_door(y: f64, state: DoorState) -> (Builder, [AreaId; 2], DoorId, ReplicaId) {
    let (mut b, one, two, door) = two_rooms(0.0, DoorKind::Hinged, state);
    let chest = b.put(two, 10.0, y, 30.0, 60.0, 0.0, 60.0);
    let object = b.world.replicas[&chest].object;
    b.world.objects.get_mut(&object).unwrap().front =
        Some(SideRef { item: "I0".into(), side: "S3".into() });
    (b, [one, two], door, chest)
}

#[test]
fn through_a_shut_door_one_stands_before_nothing() {
    for y in [50.0, 100.0, 130.0, 180.0] {
        for state in [DoorState::CLOSED, DoorState::LOCKED] {
            let (b, _, door, chest) = a_chest_behind_a_door(y, state);
            let way =
                plan(&b).route(&b.world, p(50.0, 150.0), Target::Replica(chest), Method::Shortest);
            let barred = way.expect_err("a shut leaf is a wall");
            let is_it = |b: &Barrier| matches!(b, Barrier::Door { door: own, .. } if *own == door);
            assert!(barred.barriers().iter().any(is_it), "{y}: {barred:?}");
        }
    }
}

#[test]
fn one_goes_round_to_another_side_of_a_thing_that_only_a_doorway_has_its_front_before() {
    for y in [50.0, 180.0] {
        let (b, [_, two], _, chest) = a_chest_behind_a_door(y, DoorState::OPEN);
        let plan = plan(&b);
        let to_chest = Target::Replica(chest);
        for (from, within) in [(50.0, None), (600.0, None), (600.0, Some(&[two][..]))] {
            let from = p(from, 150.0);
            let way = plan.route_within(&b.world, from, to_chest, Method::Shortest, within);
            let way = way.unwrap_or_else(|e| panic!("{y}: {e:?}"));
            check_route(&plan, &b.world, &way);
            assert!(way.points.last().unwrap().x > 400.0, "{y}: {way:?}");
        }
    }
}

#[test]
fn items_of_one_area_make_one_floor() {
    let mut b = Builder::new();
    let inner: &[(usize, Opening)] = &[(1, Opening::Passage)];
    let outer: &[(usize, Opening)] = &[(3, Opening::Passage)];
    let (left, right) = (rectangle(200.0, 300.0), rectangle(200.0, 300.0));
    let shift = Frame::new(200.0, 0.0, 0.0, Deg::ZERO);
    let room = b.area_of(
        "Зал",
        &[(&left, Frame::IDENTITY, inner), (&right, shift, outer)],
        Frame::IDENTITY,
    );
    both_ways(&b, p(50.0, 150.0), p(350.0, 150.0));
    assert_eq!(plan(&b).passframes(room).len(), 1);
}

#[test]
fn a_moved_thing_rebuilds_to_what_building_anew_gives() {
    let (mut b, one, ..) = two_rooms(0.0, DoorKind::Hinged, DoorState::OPEN);
    let chair = b.put(one, 330.0, 120.0, 45.0, 45.0, 10.0, 90.0);
    let mut plan_before = plan(&b);
    b.world.replicas.get_mut(&chair).unwrap().frame = Frame::new(100.0, 100.0, 0.0, Deg::of(40.0));
    plan_before.rebuild(&b.world, &[chair]);
    let fresh = plan(&b);
    for (a, b) in plan_before.fragments().zip(fresh.fragments()) {
        assert_eq!(a, b);
    }
}

/// The papers' flat, as people wrote it down.
#[test]
fn every_room_of_the_flat_is_reached_from_every_other() {
    let world =
        World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/maps/rb2.toml")).expect("a good map");
    let map = *world.maps.keys().next().unwrap();
    let open: DoorStates = world.doors.keys().map(|&d| (d, DoorState::OPEN)).collect();
    let plan = FloorPlan::build(&world, map, &world.robot, &open);
    check_invariants(&plan);
    let spots: Vec<(AreaId, Point)> = world
        .places
        .values()
        .filter_map(|place| {
            let (at, frame) = world.placement(place.area)?;
            (at == map).then(|| (place.area, frame.apply(place.at)))
        })
        .collect();
    for &(_, from) in &spots {
        for &(_, to) in &spots {
            for method in [Method::Shortest, Method::Paper] {
                let route = plan
                    .route(&world, from, Target::Point(to), method)
                    .unwrap_or_else(|e| panic!("{e:?}"));
                check_route(&plan, &world, &route);
            }
        }
        for &area in world.areas.keys() {
            plan.route(&world, from, Target::Area(area), Method::Shortest)
                .unwrap_or_else(|e| panic!("{e:?}"));
        }
        for &id in world.replicas.keys() {
            if let Err(e) = plan.route(&world, from, Target::Replica(id), Method::Shortest) {
                panic!("{}: {e:?}", world.replicas[&id].name);
            }
        }
    }
    for floor in plan.fragments() {
        eprintln!(
            "{}: {} Passframes, {} dead zones",
            world.areas[&floor.area].name,
            floor.passframes().len(),
            floor.dead_zones().len()
        );
    }
}
