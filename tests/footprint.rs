//! A robot that is no disc: it passes straits along its own heading, and never touches anything on its way.

use orthoframe_geometry::*;
use orthoframe_map::*;
use orthoframe_robot::{Bump, Refusal, Simulator, Unfinished, Vehicle, Watch};
use orthoframe_store::{Change, Store, Timestamp};
use orthoframe_units::*;

use crate::floor_properties::{Random, random_world};
use crate::floors::{Builder, Opening, p, rectangle, two_rooms};

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

/// Everything solid that the robot meets.
fn solids(plan: &FloorPlan, world: &World) -> Vec<Vec<Point>> {
    let robot = plan.robot();
    plan.scene()
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
        .collect()
}

/// Drives a route and looks at the robot's outline at every step and on every turn, against the scene itself.
fn check_outline(plan: &FloorPlan, world: &World, route: &Route) {
    let robot = plan.robot();
    let solids = solids(plan, world);
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

/// Of random worlds every one with `ORTHOFRAME_LONG`, else every other.
fn step() -> usize {
    if crate::files::long() { 1 } else { 2 }
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
                .unwrap_or_else(|e| panic!("{width} {turned}: {e:?}"));
            check_outline(&plan, &b.world, &route);
            assert!(route.length < 410.0, "{}", route.length);
            let paper = plan.route(&b.world, from, Target::Point(to), Method::Paper).unwrap();
            check_outline(&plan, &b.world, &paper);
        }
    }
}

/// Nothing but a gap is in the way, of this width.
fn assert_gap(no: &NoRoute, wide: f64, robot: f64) {
    let [Barrier::Gap { width, needed, .. }] = no.barriers() else { panic!("{no:?}") };
    assert!((width - wide).abs() < 0.01 && (needed - robot).abs() < 0.01, "{no:?}");
}

#[test]
fn a_gap_narrower_than_the_robot_is_told_with_both_widths() {
    let no = go(&gap(39.0, 0.0), p(100.0, 200.0), p(500.0, 200.0)).unwrap_err();
    assert_gap(&no, 39.0, 40.0);
}

/// An outline whose turning point lies at its back and to the right: 10 cm of it to the right, 25 to the left.
fn aside(b: &mut Builder) {
    b.world.robot.footprint = vec![p(-20., -10.), p(70., -10.), p(70., 25.), p(-20., 25.)];
    b.world.robot.radius = Cm::of(74.34);
}

#[test]
fn a_robot_whose_centre_lies_aside_needs_its_own_width() {
    let (from, to) = (p(100.0, 200.0), p(500.0, 200.0));
    for (turned, width) in [(0.0, 36.0), (0.0, 35.0), (17.3, 35.5), (211.0, 40.0)] {
        let outer = Frame::new(0.0, 0.0, 0.0, Deg::of(turned));
        let mut b = gap(width, turned);
        aside(&mut b);
        assert!((b.world.robot.passing_width() - 35.0).abs() < 1e-9);
        let plan = build(&b);
        // There and back, each on a line of its own.
        let crossings = [(from, to), (to, from)].map(|(from, to)| {
            let (from, to) = (outer.apply(from), outer.apply(to));
            for method in [Method::Shortest, Method::Paper] {
                let route = plan
                    .route(&b.world, from, Target::Point(to), method)
                    .unwrap_or_else(|e| panic!("{width} {turned}: {e:?}"));
                check_outline(&plan, &b.world, &route);
            }
            let route = plan.route(&b.world, from, Target::Point(to), Method::Shortest).unwrap();
            let start = Pose { at: from, heading: Deg::ZERO };
            let mut robot = Simulator::new(b.world.clone(), MapId(1), start);
            robot.follow(&route.points, None, &mut Watch::none()).unwrap();
            assert!((robot.pose().1.at - to).norm() < 1e-6);
            let inverse = |q: Point| outer.invert(q);
            let leg = route.points.windows(2).map(|leg| [inverse(leg[0]), inverse(leg[1])]);
            let mut through = leg.filter(|[a, b]| (a.x - 300.0) * (b.x - 300.0) < 0.0);
            through.next().expect("a leg through the gap")[0].y
        });
        assert!(crossings[0] < 200.0 && crossings[1] > 200.0, "{crossings:?}");
    }
    let mut narrow = gap(34.0, 0.0);
    aside(&mut narrow);
    let no = go(&narrow, from, to).unwrap_err();
    assert_gap(&no, 34.0, 35.0);
}

/// The skin that is taken off for rounding is as thin where the turning point lies close to the outline.
#[test]
fn a_robot_that_turns_about_its_very_edge_is_not_shrunk() {
    let mut b = gap(60.0, 0.0);
    b.world.robot.footprint = vec![p(-0.02, -20.), p(90., -20.), p(90., 20.), p(-0.02, 20.)];
    b.world.robot.radius = Cm::of(92.2);
    let start = Pose { at: p(100.0, 60.0), heading: Deg::ZERO };
    let mut robot = Simulator::new(b.world, MapId(1), start);
    let bump = bumped(robot.follow(&[p(300.0, 60.0)], None, &mut Watch::none()));
    assert!((bump.at.at.x - 190.0).abs() < 0.05, "{:?}", bump.at);
}

/// What stopped a drive.
fn bumped(driven: Result<(), Unfinished<Bump>>) -> Bump {
    match driven {
        Err(Unfinished::Met(bump)) => bump,
        other => panic!("{other:?}"),
    }
}

/// A turn is looked at as a whole: a post that stands between two degrees is met, and told by its angle.
#[test]
fn a_turning_outline_meets_a_post_however_thin() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(600.0, 600.0), Frame::IDENTITY, &[]);
    b.world.robot.footprint = vec![p(-10., -10.), p(100., -10.), p(100., 10.), p(-10., 10.)];
    b.world.robot.radius = Cm::of(100.5);
    // Just within the circle on which the corners turn, at 45°.
    let at = p(300.0, 300.0) + Vector::new(0.5_f64.sqrt(), 0.5_f64.sqrt()) * 100.4;
    b.put(hall, at.x, at.y, 0.2, 0.2, 45.0, 100.0);
    let start = Pose { at: p(300.0, 300.0), heading: Deg::ZERO };
    for (turn, met) in [(90.0, 45.0 - 10.0_f64.atan2(100.0).to_degrees()), (30.0, 90.0)] {
        let mut robot = Simulator::new(b.world.clone(), MapId(1), start);
        let bump = robot.follow(&[], Some(Deg::of(turn)), &mut Watch::none());
        assert_eq!(bump.is_err(), met < turn, "{bump:?}");
        let reached = robot.pose().1.heading.signed();
        assert!((reached - met.min(turn)).abs() < 0.5, "{reached} of {met}");
    }
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
        assert_eq!(plan.passed(&route).doorways, [0]);
        assert_eq!(plan.open_doorways().len(), 1);
        // Shut, the door is what bars the way.
        b.world.doors.values_mut().for_each(|d| d.state = DoorState::CLOSED);
        let no = go(&b, p(100.0, 150.0), p(700.0 + gap, 150.0)).unwrap_err();
        assert!(matches!(no.barriers(), [Barrier::Door { .. }]), "{no:?}");
    }
}

/// Whether some disc of the plan's reach covers a point: one that may turn.
fn disc_covers(plan: &FloorPlan, q: Point, spare: f64) -> bool {
    let near = |r: &Region| {
        r.contains(q, 0.0) || r.contours().any(|c| c.border_distance(q) <= plan.reach() + spare)
    };
    plan.fragments().any(|f| f.centre().iter().any(near))
}

fn is_dead(plan: &FloorPlan, q: Point) -> bool {
    plan.fragments().any(|f| f.dead_zone_at(q).is_some())
}

#[test]
fn floor_that_a_long_robot_passes_lengthwise_is_free() {
    for turned in [0.0, 17.3] {
        let outer = Frame::new(0.0, 0.0, 0.0, Deg::of(turned));
        for (width, outline) in [(60.0, 0), (40.0, 0), (39.0, 0), (45.0, 1), (34.0, 1)] {
            let mut b = gap(width, turned);
            if outline == 1 {
                aside(&mut b);
            }
            let is_passed = width >= [40.0, 35.0][outline];
            let plan = build(&b);
            let floor = plan.fragments().next().unwrap();
            for aside in [0.0, 0.49, -0.49] {
                let q = outer.apply(p(300.0, 200.0 + aside * width));
                assert_eq!(floor.dead_zone_at(q).is_none(), is_passed, "{width} {aside}");
                let kind = floor.passframe_at(q).map(|frame| frame.kind);
                assert_eq!(kind.is_some(), is_passed, "{width} {aside}");
            }
            // A strait parts nothing off: there is a way from Passframe to Passframe.
            let (from, to) = (outer.apply(p(100.0, 200.0)), outer.apply(p(500.0, 200.0)));
            if let Ok(route) = plan.route(&b.world, from, Target::Point(to), Method::Shortest) {
                let chain = plan.passed(&route).chain;
                for pair in chain.windows(2) {
                    let frame = plan.passframe(pair[0].0, pair[0].1).unwrap();
                    let is_next = frame.neighbours().any(|(id, _)| id == pair[1].1);
                    assert!(
                        is_next,
                        "{turned} {width}: {frame:#?} {:?} {:?}",
                        pair[1], route.points
                    );
                }
            }
            let dead: f64 = floor.dead_zones().iter().map(Region::area).sum();
            let free: f64 = floor.free().iter().map(Region::area).sum();
            let all: f64 = floor.raw().iter().map(Region::area).sum();
            assert!((dead + free - all).abs() < 1e-4 * all, "{dead} {free} {all}");
        }
    }
}

#[test]
fn a_doorway_passed_lengthwise_is_no_dead_zone() {
    let (mut b, ..) = two_rooms(12.0, DoorKind::Sliding, DoorState::OPEN);
    long_robot(&mut b, 110.0, 70.0);
    let open = build(&b);
    let line = open.doorways()[0].line();
    let middle = nalgebra::center(&line.0, &line.1);
    for side in [-4.0, 4.0] {
        let q = middle + Vector::new(side, 0.0);
        let held = open.fragments().filter_map(|f| f.passframe_at(q)).next().expect("free");
        assert_eq!(held.kind, PassframeKind::Boundary);
        assert!(!is_dead(&open, q));
    }
    // Shut, it is passed by nobody, and the floor is what a new plan says.
    let shut: DoorStates = b.world.doors.keys().map(|&d| (d, DoorState::CLOSED)).collect();
    let followed = open.with_doors(&b.world, &shut);
    b.world.doors.values_mut().for_each(|d| d.state = DoorState::CLOSED);
    let anew = build(&b);
    for (one, other) in followed.fragments().zip(anew.fragments()) {
        assert!(one == other);
    }
}

/// Whether an outline can stand over a point clear of everything: tried pose by pose. The outline is of one size, in parts
/// of the footprint's, and holds the point so deep, in cm, or deeper; out of it if that is negative.
fn some_pose_covers(
    plan: &FloorPlan,
    solids: &[Vec<Point>],
    q: Point,
    (size, deep): (f64, f64),
    turned_by: f64,
) -> bool {
    const STEP: f64 = 4.0;
    let outline: Vec<Vector> = plan.robot().footprint.iter().map(|c| c.coords * size).collect();
    let corners = Polygon::new(plan.robot().footprint.clone());
    let at = corners.bounds().grown(f64::max(-deep, 0.0));
    let count = |low: f64, high: f64| ((high - low) / STEP).ceil() as usize;
    let near = Bounds::of([q]).grown(2.0 * plan.robot().radius.get() - 2.0 * deep.min(0.0));
    let solids: Vec<&Vec<Point>> =
        solids.iter().filter(|s| Bounds::of(s.iter().copied()).meets(&near)).collect();
    let depth = |held: Point| {
        let border = corners.border_distance(held);
        if corners.contains(held, 0.0) { border } else { -border }
    };
    (0..72).any(|heading| {
        let (sin, cos) = (turned_by + f64::from(heading) * 5.0).to_radians().sin_cos();
        let turned = |v: Vector| Vector::new(v.x * cos - v.y * sin, v.x * sin + v.y * cos);
        let places = (0..=count(at.min.x, at.max.x))
            .flat_map(|i| (0..=count(at.min.y, at.max.y)).map(move |k| (i as f64, k as f64)));
        let mut held = places.map(|(i, k)| at.min + Vector::new(i, k) * STEP);
        held.any(|held| {
            let centre = q - turned(held.coords);
            let stands: Vec<Point> = outline.iter().map(|&v| centre + turned(v)).collect();
            depth(held) >= deep && solids.iter().all(|s| apart(&stands, s, 0.0))
        })
    })
}

/// Against poses tried one by one: what is free though it is dead for the disc is covered by some pose, or lies within a
/// few centimetres of one; what some pose covers by more than the teeth between two headings is not dead. No route passes
/// over a dead zone.
#[test]
fn what_some_pose_covers_is_free_and_nothing_else() {
    let (mut freed, mut driven, mut dead) = (0, 0, 0);
    let mut wrong = [Vec::new(), Vec::new()];
    for seed in (0..6).step_by(step()) {
        let mut random = Random(seed + 900);
        let mut b = random_world(seed + 20);
        shaped(&mut b, seed as usize, &mut random);
        let turned = [0.0, 17.3][seed as usize % 2];
        let outer = Frame::new(0.0, 0.0, 0.0, Deg::of(turned));
        let b = b.moved(0.0, 0.0, turned);
        let plan = build(&b);
        let round = RobotProfile { footprint: Vec::new(), ..b.world.robot.clone() };
        let of_disc = FloorPlan::build(&b.world, MapId(1), &round, &DoorStates::new());
        let solids = solids(&plan, &b.world);
        let (mut tried, mut left) = (0, 0);
        for _ in 0..1500 {
            let q = outer.apply(p(random.between(0.0, 800.0), random.between(0.0, 300.0)));
            if tried < 8
                && is_dead(&of_disc, q)
                && plan.fragments().any(|f| f.passframe_at(q).is_some())
            {
                tried += 1;
                freed += 1;
                if !some_pose_covers(&plan, &solids, q, (0.9, -5.0), turned) {
                    wrong[0].push((seed, q));
                }
            }
            if left < 8 && is_dead(&plan, q) {
                left += 1;
                dead += 1;
                if some_pose_covers(&plan, &solids, q, (1.0, 0.15 * plan.reach()), turned) {
                    wrong[1].push((seed, q));
                }
            }
        }
        for _ in 0..4 {
            let [from, to] = [0, 1]
                .map(|_| outer.apply(p(random.between(0.0, 800.0), random.between(0.0, 300.0))));
            let Ok(route) = plan.route(&b.world, from, Target::Point(to), Method::Shortest) else {
                continue;
            };
            for leg in route.points.windows(2).filter(|leg| (leg[1] - leg[0]).norm() > 1e-6) {
                let (along, length) = ((leg[1] - leg[0]).normalize(), (leg[1] - leg[0]).norm());
                let inner = plan.robot().footprint.iter().map(|c| c.coords * 0.99);
                for v in inner.map(|c| along * c.x + Vector::new(-along.y, along.x) * c.y) {
                    for k in 0..=(length / 3.0) as usize {
                        let q = leg[0] + along * (3.0 * k as f64) + v;
                        let is_strait = !disc_covers(&plan, q, 0.1);
                        assert!(!is_strait || !is_dead(&plan, q), "seed {seed}: {q:?}");
                        driven += usize::from(is_strait);
                    }
                }
            }
        }
    }
    assert!(freed > 15 && dead > 15 && driven > 5, "{freed} {dead} {driven}");
    assert!(wrong.iter().all(Vec::is_empty), "{freed} {dead}: {wrong:?}");
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
    for seed in (0..14).step_by(step()) {
        let mut b = random_world(seed);
        let mut random = Random(seed + 7);
        let (length, width) = (random.between(50.0, 110.0), random.between(20.0, 50.0));
        if seed % 3 == 2 {
            shaped(&mut b, (seed % 6) as usize, &mut random);
        } else {
            long_robot(&mut b, length, width);
        }
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
    assert!(found > 10 && narrow > 1, "{found} {narrow}");
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
    robot.follow(&route.points, Some(Deg::of(90.0)), &mut Watch::none()).unwrap();
    assert!((robot.pose().1.at - to).norm() < 1e-6);
    // Turned within the gap it would touch both boxes; sideways it does not even enter.
    let middle = Pose { at: p(300.0, 200.0), heading: Deg::ZERO };
    let mut robot = Simulator::new(b.world.clone(), MapId(1), middle);
    assert!(robot.follow(&[], Some(Deg::of(90.0)), &mut Watch::none()).is_err());
    let mut wide = b;
    long_robot(&mut wide, 40.0, 90.0);
    let mut robot = Simulator::new(wide.world.clone(), MapId(1), start);
    let bump = bumped(robot.follow(&[to], None, &mut Watch::none()));
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
        robot.set_door(door, DoorState::OPEN, &mut Watch::none()),
        Err(Unfinished::Met(Refusal::DoorJammed { by: None, .. }))
    ));
    for area in doorway.areas {
        let stand = plan.stand_before(&b.world, door, area).unwrap();
        let mut robot = Simulator::new(b.world.clone(), MapId(1), stand);
        robot.set_door(door, DoorState::OPEN, &mut Watch::none()).unwrap();
        robot.set_door(door, DoorState::CLOSED, &mut Watch::none()).unwrap();
    }
}

/// A convex outline about the centre, of the kind that the number asks for.
pub(crate) fn shaped(b: &mut Builder, kind: usize, random: &mut Random) {
    let corners: Vec<(f64, f64)> = match kind {
        0 => vec![(-55., -20.), (55., -20.), (55., 20.), (-55., 20.)],
        1 => vec![(60., 0.), (-30., 22.), (-30., -22.)],
        2 => (0..6)
            .map(|k| {
                let a = std::f64::consts::TAU * f64::from(k) / 6.0;
                (50. * a.cos(), 18. * a.sin())
            })
            .collect(),
        3 => vec![(-20., -45.), (20., -45.), (20., 45.), (-20., 45.)],
        // The centre lies aside.
        4 => vec![(-70., -10.), (20., -10.), (20., 25.), (-70., 25.)],
        _ => {
            let n = 5 + (random.unit() * 4.0) as usize;
            (0..n)
                .map(|k| {
                    let a = std::f64::consts::TAU * k as f64 / n as f64;
                    (random.between(40., 60.) * a.cos(), random.between(14., 22.) * a.sin())
                })
                .collect()
        }
    };
    let hull = convex_hull(corners.into_iter().map(|(x, y)| p(x, y)).collect());
    let radius = hull.iter().map(|c| c.coords.norm()).fold(0.0, f64::max);
    b.world.robot.footprint = hull;
    b.world.robot.radius = Cm::of((radius * 100.0).ceil() / 100.0);
}

/// Places where a robot may turn, each within a piece of centre space that is more than a point.
fn spots(plan: &FloorPlan, random: &mut Random) -> Vec<Point> {
    let regions: Vec<Region> = plan.fragments().flat_map(|f| f.centre()).collect();
    let mut found = Vec::new();
    for region in &regions {
        let middle = region.outer.centroid();
        if region.area() < 25.0 {
            // A few square millimetres are a place, too.
            let is_place = region.area() > 0.03 && region.contains(middle, 0.0);
            found.extend(is_place.then_some(middle));
            continue;
        }
        let at = region.outer.bounds();
        for _ in 0..60 {
            let q = p(random.between(at.min.x, at.max.x), random.between(at.min.y, at.max.y));
            if region.contains(q, 0.0) && region.contours().all(|c| c.border_distance(q) > 1.0) {
                found.push(q);
            }
        }
    }
    found
}

/// Straight ways that the outline can drive between places where it can turn are ways that are found.
#[test]
fn no_straight_strait_is_missed() {
    let mut apart_still = 0;
    for seed in (0..12).step_by(step()) {
        let mut random = Random(seed + 4000);
        let mut b = random_world(seed + 20);
        shaped(&mut b, (seed % 6) as usize, &mut random);
        let plan = build(&b);
        let spots = spots(&plan, &mut random);
        let solids = solids(&plan, &b.world);
        for _ in 0..600.min(spots.len() * spots.len()) {
            let mut spot = || spots[(random.unit() * spots.len() as f64) as usize];
            let (from, to) = (spot(), spot());
            if plan.are_joined(from, to) {
                continue;
            }
            apart_still += 1;
            // There and back, the robot ahead both times, with a little to spare.
            let is_barred = [(from, to), (to, from)].into_iter().any(|(from, to)| {
                let along = to - from;
                let (sin, cos) = along.y.atan2(along.x).sin_cos();
                let sides = plan.robot().footprint.iter().map(|c| c.coords * 1.05);
                let turned =
                    sides.map(|c| Vector::new(c.x * cos - c.y * sin, c.x * sin + c.y * cos));
                let swept = convex_hull(turned.flat_map(|v| [from + v, to + v]).collect());
                solids.iter().any(|solid| !apart(&swept, solid, 0.0))
            });
            assert!(is_barred, "seed {seed}: nothing stands between {from:?} and {to:?}");
        }
    }
    assert!(apart_still > 50, "{apart_still}");
}

/// A closet as deep as a wall between two rooms: the robot passes two doorways on one line.
#[test]
fn a_threshold_area_is_passed_lengthwise() {
    for depth in [15.0, 60.0, 150.0] {
        let mut b = Builder::new();
        let one = b.area(
            "Один",
            &[p(0., 0.), p(400., 0.), p(400., 120.), p(400., 180.), p(400., 300.), p(0., 300.)],
            Frame::IDENTITY,
            &[(2, Opening::Passage)],
        );
        let mid = b.area(
            "Порог",
            &rectangle(depth, 60.0),
            Frame::new(400., 120., 0., Deg::ZERO),
            &[(1, Opening::Passage), (3, Opening::Passage)],
        );
        let two = b.area(
            "Два",
            &[p(0., 0.), p(400., 0.), p(400., 300.), p(0., 300.), p(0., 180.), p(0., 120.)],
            Frame::new(400. + depth, 0., 0., Deg::ZERO),
            &[(4, Opening::Passage)],
        );
        b.link(one, 2, mid, 3);
        b.link(mid, 1, two, 4);
        long_robot(&mut b, 90.0, 50.0);
        let mut plan = build(&b);
        let to = p(600. + depth, 150.);
        let route =
            plan.route(&b.world, p(200., 150.), Target::Point(to), Method::Shortest).unwrap();
        check_outline(&plan, &b.world, &route);
        assert_eq!(plan.passed(&route).doorways, [0, 1]);
        // With something in the closet there is no way any more, and there is one when it is gone.
        let box_in_it = b.put(mid, depth / 2.0 - 1.0, 5.0, 2.0, 20.0, 0.0, 100.0);
        plan.rebuild(&b.world, &[box_in_it]);
        let target = Target::Point(to);
        assert!(plan.route(&b.world, p(200., 150.), target, Method::Shortest).is_err());
        b.world.replicas.remove(&box_in_it);
        plan.rebuild(&b.world, &[box_in_it]);
        let again = plan.route(&b.world, p(200., 150.), target, Method::Shortest).unwrap();
        assert_eq!(again, route);
    }
}
