//! A robot that is no disc: it passes straits along its own heading, and never touches anything on its way.

use orthoframe::geometry::*;
use orthoframe::map::*;
use orthoframe::robot::{Drive, Refusal, Simulator};
use orthoframe::store::{Change, Store, Timestamp};
use orthoframe::units::*;

use crate::floor_properties::{Random, random_world};
use crate::floors::{Builder, p, rectangle, two_rooms};

/// `length` ahead and behind together, `width` across, its centre in the middle.
fn long_robot(b: &mut Builder, length: f64, width: f64) {
    let (x, y) = (length / 2.0, width / 2.0);
    b.world.robot.footprint = vec![p(-x, -y), p(x, -y), p(x, y), p(-x, y)];
    b.world.robot.radius = Cm::of((x.hypot(y) * 100.0).ceil() / 100.0);
}

fn build(b: &Builder) -> FloorPlan {
    FloorPlan::build(&b.world, MapId(1), &b.world.robot, &DoorStates::new())
}

fn go(b: &Builder, from: Point, to: Point) -> Result<Route, NoRoute> {
    build(b).route(&b.world, from, Target::Point(to), Method::Shortest)
}

/// Whether two convex polygons lie apart, or overlap by less than `slack`: by their separating axes.
fn apart(a: &[Point], b: &[Point], slack: f64) -> bool {
    let separates = |p: &[Point], q: &[Point]| {
        (0..p.len()).any(|i| {
            let Some(along) = (p[(i + 1) % p.len()] - p[i]).try_normalize(1e-9) else {
                return false;
            };
            let out = Vector::new(along.y, -along.x);
            let high = p.iter().map(|c| c.coords.dot(&out)).fold(f64::NEG_INFINITY, f64::max);
            q.iter().all(|c| c.coords.dot(&out) >= high - slack)
        })
    };
    let flipped: Vec<Point> = a.iter().rev().copied().collect();
    separates(a, b)
        || separates(b, a)
        || (a.len() == 2 && separates(&flipped, b))
        || (b.len() == 2 && separates(&b.iter().rev().copied().collect::<Vec<_>>(), a))
}

/// Drives a route and looks at the robot's outline at every step and on every turn, against the scene itself.
fn check_outline(plan: &FloorPlan, world: &World, route: &Route) {
    let robot = plan.robot();
    let solids: Vec<Vec<Point>> = plan
        .scene()
        .replicas
        .values()
        .flat_map(|r| &r.prisms)
        .filter(|f| f.top > robot.step.get() && f.bottom < robot.height.get())
        .map(|f| f.polygon.clone().counter_clockwise().corners)
        .chain(plan.fragments().flat_map(|f| f.walls.iter().map(|&(a, b)| vec![a, b])))
        .chain(plan.doorways().iter().flat_map(|d| {
            let door = d.door.map(|id| &world.doors[&id]);
            let leaves = door.map_or(vec![], |door| d.leaves(door).obstacles(door.state));
            leaves.into_iter().map(|leaf| leaf.counter_clockwise().corners)
        }))
        .collect();
    let clear_at = |at: Point, heading: f64| {
        let (sin, cos) = heading.sin_cos();
        let corner = |c: &Point| at + Vector::new(c.x * cos - c.y * sin, c.x * sin + c.y * cos);
        let outline: Vec<Point> = robot.footprint.iter().map(corner).collect();
        for solid in &solids {
            assert!(apart(&outline, solid, 0.006), "{at:?} heading {heading}: {solid:?}");
        }
    };
    let mut heading: Option<f64> = None;
    for leg in route.points.windows(2) {
        let along = leg[1] - leg[0];
        if along.norm() < 1e-6 {
            continue;
        }
        let ahead = along.y.atan2(along.x);
        if let Some(before) = heading {
            let turn = (ahead - before + 3.0 * std::f64::consts::PI)
                .rem_euclid(std::f64::consts::TAU)
                - std::f64::consts::PI;
            (0..=60).for_each(|k| clear_at(leg[0], before + turn * f64::from(k) / 60.0));
        }
        let steps = (along.norm() / 2.0).ceil();
        (0..=steps as usize).for_each(|k| clear_at(leg[0] + along * (k as f64 / steps), ahead));
        heading = Some(ahead);
    }
}

/// A hall parted by two boxes with a gap between them.
fn gap(width: f64, turned: f64) -> Builder {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(600.0, 400.0), Frame::IDENTITY, &[]);
    let low = (400.0 - width) / 2.0;
    b.put(hall, 280.0, 0.0, 40.0, low, 0.0, 100.0);
    b.put(hall, 280.0, low + width, 40.0, low, 0.0, 100.0);
    long_robot(&mut b, 90.0, 40.0);
    b.moved(0.0, 0.0, turned)
}

#[test]
fn a_long_robot_passes_a_gap_lengthwise() {
    for turned in [0.0, 17.3, 90.0, 211.0] {
        let outer = Frame::new(0.0, 0.0, 0.0, Deg::of(turned));
        for width in [60.0, 41.0, 40.0] {
            let b = gap(width, turned);
            let (from, to) = (outer.apply(p(100.0, 200.0)), outer.apply(p(500.0, 200.0)));
            let plan = build(&b);
            let route = plan
                .route(&b.world, from, Target::Point(to), Method::Shortest)
                .unwrap_or_else(|e| panic!("{width} {turned}: {e}"));
            check_outline(&plan, &b.world, &route);
            assert!(route.length < 410.0, "{}", route.length);
            let paper = plan.route(&b.world, from, Target::Point(to), Method::Paper).unwrap();
            check_outline(&plan, &b.world, &paper);
        }
    }
}

#[test]
fn a_gap_narrower_than_the_robot_is_told_with_both_widths() {
    let no = go(&gap(39.0, 0.0), p(100.0, 200.0), p(500.0, 200.0)).unwrap_err();
    assert!(no.to_string().contains("39 см, роботу нужно 40 см"), "{no}");
}

#[test]
fn a_long_robot_passes_a_door_that_its_disc_does_not() {
    for gap in [0.0, 12.0] {
        let (mut b, ..) = two_rooms(gap, DoorKind::Sliding, DoorState::OPEN);
        long_robot(&mut b, 110.0, 70.0);
        let plan = build(&b);
        let target = Target::Point(p(700.0 + gap, 150.0));
        let route = plan.route(&b.world, p(100.0, 150.0), target, Method::Shortest).unwrap();
        check_outline(&plan, &b.world, &route);
        assert_eq!(route.doorways, [0]);
        assert_eq!(plan.open_doorways().len(), 1);
        // Shut, the door is what bars the way.
        b.world.doors.values_mut().for_each(|d| d.state = DoorState::CLOSED);
        let no = go(&b, p(100.0, 150.0), p(700.0 + gap, 150.0)).unwrap_err();
        assert!(matches!(no.barriers(), [Barrier::Door { .. }]), "{no}");
    }
}

#[test]
fn a_strait_comes_and_goes_with_what_makes_it() {
    let mut b = gap(60.0, 0.0);
    let mut plan = build(&b);
    let (from, target) = (p(100.0, 200.0), Target::Point(p(500.0, 200.0)));
    let ids: Vec<ReplicaId> = b.world.replicas.keys().copied().collect();
    let home = b.world.replicas[&ids[0]].frame;
    b.world.replicas.get_mut(&ids[0]).unwrap().frame = Frame::new(280.0, 30.0, 0.0, Deg::ZERO);
    plan.rebuild(&b.world, &ids[..1]);
    assert!(plan.route(&b.world, from, target, Method::Shortest).is_err());
    b.world.replicas.get_mut(&ids[0]).unwrap().frame = home;
    plan.rebuild(&b.world, &ids[..1]);
    let route = plan.route(&b.world, from, target, Method::Shortest).unwrap();
    check_outline(&plan, &b.world, &route);
}

#[test]
fn no_route_of_a_long_robot_touches_anything() {
    let (mut found, mut narrow) = (0, 0);
    for seed in 0..14 {
        let mut b = random_world(seed);
        let mut random = Random(seed + 7);
        let (length, width) = (random.between(50.0, 110.0), random.between(20.0, 50.0));
        long_robot(&mut b, length, width);
        let plan = build(&b);
        for _ in 0..4 {
            let from = p(random.between(0.0, 400.0), random.between(0.0, 300.0));
            let to = p(random.between(0.0, 800.0), random.between(0.0, 300.0));
            for method in [Method::Shortest, Method::Paper] {
                if let Ok(route) = plan.route(&b.world, from, Target::Point(to), method) {
                    check_outline(&plan, &b.world, &route);
                    found += 1;
                    narrow += usize::from(
                        plan.clearance(&route.points) < plan.robot().radius.get() - 1.0,
                    );
                }
            }
        }
    }
    assert!(found > 20 && narrow > 3, "{found} {narrow}");
}

const STUDY: &str = r#"
format = 1
[robot]
footprint = FOOTPRINT
[orthoframe.floor]
rect = [400, 300]
height = 270
[area.study]
name = "Кабинет"
items = [{ id = "A", orthoframe = "floor" }]
[map.flat]
items = [{ area = "study" }]
"#;

fn study(footprint: &str) -> Result<World, MapErrors> {
    World::parse(&Source::new("study.toml", STUDY.replace("FOOTPRINT", footprint)), Format::Toml)
}

#[test]
fn a_footprint_is_written_and_read_again() {
    let world = study("[[-45, -20], [45, -20], [45, 20], [-45, 20]]").unwrap();
    // Corners lie 49.244 from the centre.
    assert_eq!(world.robot.radius, Cm::of(49.25));
    assert!((world.robot.passing_width() - 44.0).abs() < 1e-9);
    let again = World::parse(&Source::new("again.toml", world.to_toml()), Format::Toml).unwrap();
    assert_eq!(again.robot, world.robot);
    let dir = tempfile::tempdir().unwrap();
    let change = Change::new("Мастер", Timestamp(0), "проба");
    let (mut store, _) = Store::open(dir.path()).unwrap();
    store.import(&world, &change).unwrap();
    drop(store);
    let (store, _) = Store::open(dir.path()).unwrap();
    assert_eq!(store.world().unwrap().unwrap().robot, world.robot);
}

#[test]
fn a_footprint_that_is_none_is_refused_with_the_reason() {
    for (footprint, reason) in [
        ("[[-45, -20], [45, -20]]", "углов 2"),
        ("[[-45, -20], [-45, 20], [45, 20], [45, -20]]", "не поворачивает влево"),
        ("[[10, -20], [45, -20], [45, 20], [10, 20]]", "не внутри"),
        ("[[-45, -20], [45, -20], [45, 20], [-45, 20]]\nradius = 30", "не покрывает"),
    ] {
        let errors = study(footprint).unwrap_err();
        let text = errors.faults[0].to_string();
        assert!(text.contains(reason), "{footprint}: {text}");
    }
}

#[test]
fn the_simulated_robot_drives_what_was_planned_for_its_outline() {
    let b = gap(45.0, 0.0);
    let (from, to) = (p(100.0, 200.0), p(500.0, 200.0));
    let route = go(&b, from, to).unwrap();
    let start = Pose { at: from, heading: Deg::ZERO };
    let mut robot = Simulator::new(b.world.clone(), MapId(1), start);
    robot.follow(&route.points, Some(Deg::of(90.0))).unwrap();
    assert!((robot.pose().1.at - to).norm() < 1e-6);
    // Turned within the gap it would touch both boxes; sideways it does not even enter.
    let middle = Pose { at: p(300.0, 200.0), heading: Deg::ZERO };
    let mut robot = Simulator::new(b.world.clone(), MapId(1), middle);
    assert!(robot.follow(&[], Some(Deg::of(90.0))).is_err());
    let mut wide = b;
    long_robot(&mut wide, 40.0, 90.0);
    let mut robot = Simulator::new(wide.world.clone(), MapId(1), start);
    let bump = robot.follow(&[to], None).unwrap_err();
    assert!((bump.at.at.x - 260.0).abs() < 0.1, "{:?}", bump.at);
}

#[test]
fn a_leaf_stops_against_a_robot_in_its_way() {
    let (b, _, _, door) = two_rooms(0.0, DoorKind::Hinged, DoorState::CLOSED);
    let plan = build(&b);
    let doorway = plan.doorways_of(door).next().unwrap();
    let swept = doorway.leaves(&b.world.doors[&door]).swept((0.0, 100.0))[0].centroid();
    let mut robot =
        Simulator::new(b.world.clone(), MapId(1), Pose { at: swept, heading: Deg::ZERO });
    assert!(matches!(
        robot.set_door(door, DoorState::OPEN),
        Err(Refusal::DoorJammed { by: None, .. })
    ));
    for area in doorway.areas {
        let stand = plan.stand_before(&b.world, door, area).unwrap();
        let mut robot = Simulator::new(b.world.clone(), MapId(1), stand);
        robot.set_door(door, DoorState::OPEN).unwrap();
        robot.set_door(door, DoorState::CLOSED).unwrap();
    }
}
