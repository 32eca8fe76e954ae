//! Floors on the edge: passages and doors exactly as wide as the robot, a millimetre wider and narrower, at odd angles
//! and a thousand kilometres away, and what is said of a door's clear width against the ways that there are.

use orthoframe_geometry::*;
use orthoframe_map::*;
use orthoframe_units::*;

use crate::floors::{Builder, Opening, p, rectangle};
use crate::remedies::FARTHEST;

fn build(b: &Builder) -> FloorPlan {
    FloorPlan::build(&b.world, MapId(1), &b.world.robot, &DoorStates::new())
}

/// Two chambers and what parts them, but for a gap `wide` at (400, 150), in as many ways as a gap can be made.
const GAPS: [&str; 7] = [
    "corridor",
    "boxes",
    "corners",
    "corner and wall",
    "slanting corners",
    "tub and wall",
    "screens",
];

fn gap(kind: &str, wide: f64) -> Builder {
    let mut b = Builder::new();
    let half = wide / 2.0;
    if kind == "corridor" {
        let (low, high) = (150.0 - half, 150.0 + half);
        let corners = [
            (0., 0.),
            (300., 0.),
            (300., low),
            (500., low),
            (500., 0.),
            (800., 0.),
            (800., 300.),
            (500., 300.),
            (500., high),
            (300., high),
            (300., 300.),
            (0., 300.),
        ];
        b.area("Зал", &corners.map(|(x, y)| p(x, y)), Frame::IDENTITY, &[]);
        return b;
    }
    let hall = b.area("Зал", &rectangle(800.0, 300.0), Frame::IDENTITY, &[]);
    let mut solid = |corners: &[(f64, f64)]| {
        let corners: Vec<Point> = corners.iter().map(|&(x, y)| p(x, y)).collect();
        let object = b.object(&[(&corners, 0.0, 100.0)]);
        b.place_object(hall, object, Frame::IDENTITY);
    };
    match kind {
        "boxes" => {
            solid(&[(350., 0.), (450., 0.), (450., 150. - half), (350., 150. - half)]);
            solid(&[(350., 150. + half), (450., 150. + half), (450., 300.), (350., 300.)]);
        }
        "corners" => {
            solid(&[(300., 0.), (500., 0.), (400., 150. - half)]);
            solid(&[(400., 150. + half), (500., 300.), (300., 300.)]);
        }
        "corner and wall" => solid(&[(400., wide), (600., 299.), (200., 299.)]),
        "slanting corners" => {
            let (sin, cos) = 0.46_f64.sin_cos();
            let (x, y) = (half * cos, half * sin);
            solid(&[(300., 0.), (400. - x, 0.), (400. - x, 150. - y), (300., 150. - y)]);
            solid(&[(400. + x, 150. + y), (520., 150. + y), (520., 300.), (400. + x, 300.)]);
            solid(&[(300., 150. - y), (300., 0.), (0., 0.5), (0., 1.)]);
        }
        "tub and wall" => {
            // Twenty-four corners: the lowest stands `wide` above the wall.
            let round = |k: usize| {
                let angle = std::f64::consts::TAU * k as f64 / 24.0;
                (400. + 120. * angle.sin(), wide + 120. - 120. * angle.cos())
            };
            solid(&(0..24).map(round).collect::<Vec<_>>());
            solid(&[(390., wide + 200.), (410., wide + 200.), (410., 300.), (390., 300.)]);
        }
        _ => {
            solid(&[(400., 0.), (400., 150. - half), (400.0, 75.0)]);
            solid(&[(400., 150. + half), (400., 300.), (400.0, 240.0)]);
        }
    }
    b
}

#[test]
fn a_gap_is_passed_to_the_millimetre_whatever_makes_it_and_wherever_it_is() {
    let mut tried = 0;
    for kind in GAPS {
        for (k, turn) in [0.0, 17.3, 45.0, 90.0, 133.7, 211.1, 359.9].into_iter().enumerate() {
            let radius = [20.0, 25.3, 31.7][k % 3];
            let (x, y) = [(0.0, 0.0), (1.0e6, -1.0e6), (-123_456.7, 9.9e5)][(k + tried) % 3];
            for (more, passes) in [(0.0, true), (0.1, true), (-0.1, false)] {
                let mut b = gap(kind, 2.0 * radius + more).moved(x, y, turn);
                b.world.robot.radius = Cm::of(radius);
                let outer = Frame::new(x, y, 0.0, Deg::of(turn));
                let (from, to) = (outer.apply(p(100., 150.)), outer.apply(p(700., 150.)));
                let plan = build(&b);
                for method in [Method::Shortest, Method::Paper] {
                    let way = plan.route(&b.world, from, Target::Point(to), method);
                    let what = format!("{kind}, {turn}°, at {x} {y}, {radius} cm {more:+}");
                    match way {
                        Ok(route) => {
                            assert!(passes, "{what}: passed");
                            let room = plan.clearance(&route.points);
                            assert!(room > radius - 0.006, "{what}: {room}");
                        }
                        Err(no) => {
                            assert!(!passes, "{what}: {no:?}");
                            let is_gap = |b: &Barrier| matches!(b, Barrier::Gap { .. });
                            assert!(no.barriers().iter().any(is_gap), "{what}: {no:?}");
                        }
                    }
                }
                tried += 1;
            }
        }
    }
}

/// Two rooms with a door of any kind in a wall of any depth.
fn doorway(
    leaves: usize,
    kind: DoorKind,
    share: f64,
    width: f64,
    wall: f64,
    state: DoorState,
) -> Builder {
    let mut b = Builder::new();
    let max_open = if kind == DoorKind::Hinged { 90.0 } else { 100.0 };
    let leaf = |hinge, share| DoorLeaf { hinge, share, thickness: Cm::of(4.0), max_open };
    let leaves = match leaves {
        1 => vec![leaf(HingeSide::Right, 1.0)],
        _ => vec![leaf(HingeSide::Right, share), leaf(HingeSide::Left, 1.0 - share)],
    };
    let door = b.door_with(kind, width, state, leaves);
    let (low, high) = (150.0 - width / 2.0, 150.0 + width / 2.0);
    let one = b.area(
        "Комната-1",
        &[p(0., 0.), p(400., 0.), p(400., low), p(400., high), p(400., 300.), p(0., 300.)],
        Frame::IDENTITY,
        &[(2, Opening::Door(door))],
    );
    let two = b.area(
        "Комната-2",
        &[p(0., 0.), p(400., 0.), p(400., 300.), p(0., 300.), p(0., high), p(0., low)],
        Frame::new(400.0 + wall, 0.0, 0.0, Deg::ZERO),
        &[(4, Opening::Door(door))],
    );
    b.world.areas.get_mut(&two).unwrap().doors[0].opens = OpensTo::Outside;
    b.link(one, 2, two, 4);
    b
}

/// What is said of a door's clear width is what the floor gives: a disc so wide passes, one a millimetre wider does not.
#[test]
fn a_door_is_passed_by_what_its_clear_width_admits() {
    let (mut passed, mut barred) = (0, 0);
    for (k, kind) in [DoorKind::Hinged, DoorKind::Sliding].into_iter().enumerate() {
        for (leaves, share) in [(1, 1.0), (2, 0.5), (2, 0.35)] {
            for wall in [0.0, 12.0, 40.0] {
                for opening in [12.0, 35.0, 50.0, 70.0, 85.0, 100.0] {
                    let width = 90.0 + 7.0 * k as f64;
                    let state = DoorState { status: DoorStatus::Open, opening };
                    let mut b = doorway(leaves, kind, share, width, wall, state);
                    let door = b.world.doors.values().next().cloned();
                    b.world.robot.radius = Cm::of(10.0);
                    let clear = build(&b).doorways()[0].clear_width(door.as_ref(), state);
                    for (more, passes) in [(0.0, true), (0.1, false)] {
                        let radius = (clear + more) / 2.0;
                        if radius < 3.0 {
                            continue;
                        }
                        b.world.robot.radius = Cm::of(radius);
                        let plan = build(&b);
                        let what = format!(
                            "{kind:?} of {leaves} ({share}), wall {wall}, {opening} %: {clear} {more}"
                        );
                        let to = Target::Point(p(600.0 + wall, 150.0));
                        let way = plan.route(&b.world, p(200., 150.), to, Method::Shortest);
                        match way {
                            Ok(route) => {
                                passed += 1;
                                assert!(passes, "{what}");
                                let room = plan.clearance(&route.points);
                                assert!(room > radius - 0.006, "{what}: {room}");
                            }
                            Err(no) => {
                                barred += 1;
                                assert!(!passes, "{what}: {no:?}");
                                let told = match no.barriers() {
                                    [
                                        Barrier::Narrow { width, .. } | Barrier::Gap { width, .. },
                                    ] => *width,
                                    _ => panic!("{what}: {no:?}"),
                                };
                                assert!((told - clear).abs() < 0.02, "{what}: {no:?}");
                                let full = DoorState::OPEN;
                                let doors = plan.doorways()[0].clear_width(door.as_ref(), full);
                                if opening < 100.0 && doors > 2.0 * radius {
                                    let remedy =
                                        plan.remedy(&b.world, p(200., 150.), to, &no, FARTHEST);
                                    assert!(
                                        matches!(remedy, Some(Remedy::Open(_))),
                                        "{what}: {no:?} {remedy:?}"
                                    );
                                }
                            }
                        }
                    }
                }
            }
        }
    }
    assert!(passed > 80 && barred > 80, "{passed} {barred}");
}
