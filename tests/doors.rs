//! Doors (M7): what leaves occupy, what they pass over, how wide they leave the way, at any opening.

use std::collections::BTreeMap;

use orthoframe_geometry::*;
use orthoframe_map::*;
use orthoframe_units::*;

use crate::floor_cases::{build, room, way};
use crate::floors::{p, two_rooms};

/// Whether its hinge is on the right, its share of the width, how far it opens.
type Leaf = (bool, f64, f64);
type Leaves = (DoorKind, &'static [Leaf]);

const DOORS: [Leaves; 10] = [
    (DoorKind::Hinged, &[(true, 1.0, 90.0)]),
    (DoorKind::Hinged, &[(false, 1.0, 90.0)]),
    (DoorKind::Hinged, &[(true, 1.0, 135.0)]),
    (DoorKind::Hinged, &[(false, 1.0, 60.0)]),
    (DoorKind::Hinged, &[(true, 0.5, 90.0), (false, 0.5, 90.0)]),
    (DoorKind::Hinged, &[(true, 0.3, 90.0), (false, 0.7, 100.0)]),
    (DoorKind::Sliding, &[(true, 1.0, 100.0)]),
    (DoorKind::Sliding, &[(false, 1.0, 80.0)]),
    (DoorKind::Sliding, &[(true, 0.5, 100.0), (false, 0.5, 100.0)]),
    (DoorKind::Sliding, &[(true, 0.7, 90.0), (false, 0.3, 100.0)]),
];

fn of_kind((kind, leaves): Leaves, gap: f64, opening: f64) -> (crate::floors::Builder, DoorId) {
    let state = DoorState { status: DoorStatus::Open, opening };
    let (mut b, _, _, door) = two_rooms(gap, kind, state);
    let leaf = |&(right, share, max_open): &Leaf| DoorLeaf {
        hinge: if right { HingeSide::Right } else { HingeSide::Left },
        share,
        thickness: Cm::of(4.0),
        max_open,
    };
    b.world.doors.get_mut(&door).expect("just made").leaves = leaves.iter().map(leaf).collect();
    (b, door)
}

/// The clear width is the diameter of the widest disc that passes: a little wider it does not.
#[test]
fn a_disc_as_wide_as_the_clear_width_passes_and_a_wider_one_does_not() {
    let mut tried = 0;
    for leaves in DOORS {
        for (gap, opening) in
            [(0.0, 100.0), (0.0, 35.0), (12.0, 100.0), (12.0, 60.0), (25.0, 20.0), (25.0, 85.0)]
        {
            let (mut b, door) = of_kind(leaves, gap, opening);
            let doorway = build(&b).doorways_of(door).next().expect("it joins the rooms").clone();
            let model = &b.world.doors[&door];
            let width = doorway.clear_width(Some(model), model.state);
            if width < 10.0 {
                continue;
            }
            tried += 1;
            // Round corners are cut by chords from outside, which takes up to 1.3 % of the radius.
            b.world.robot.radius = Cm::of(width / 2.0 / 1.0125 - 0.02);
            let passes = way(&b, (60., 150.), (760. + gap, 150.));
            assert!(passes.is_some(), "{leaves:?} {gap} {opening}: {width}");
            b.world.robot.radius = Cm::of(width / 2.0 + 0.02);
            let passes = way(&b, (60., 150.), (760. + gap, 150.));
            assert!(passes.is_none(), "{leaves:?} {gap} {opening}: {width}");
        }
    }
    assert!(tried > 45, "{tried}");
}

/// At every opening a leaf lies within what it sweeps, and every point that it sweeps is met at some opening.
#[test]
fn what_a_leaf_sweeps_is_where_it_is_at_some_opening() {
    for leaves in DOORS {
        for gap in [0.0, 14.0] {
            let (b, door) = of_kind(leaves, gap, 100.0);
            let plan = build(&b);
            let doorway = plan.doorways_of(door).next().expect("it joins the rooms");
            let model = &b.world.doors[&door];
            let at = |opening: f64| {
                doorway.leaves(model).obstacles(DoorState { status: DoorStatus::Open, opening })
            };
            for (from, to) in [(0.0, 100.0), (30.0, 70.0), (55.0, 10.0)] {
                let swept = doorway.leaves(model).swept((from, to));
                let steps: Vec<Vec<Polygon>> =
                    (0..=240).map(|k| at(from + (to - from) * f64::from(k) / 240.0)).collect();
                let is_swept = |q: Point| swept.iter().any(|s| s.contains(q, 0.05));
                // A shut leaf lies in the wall, and one that turns has its back about its hinge, within its thickness.
                let (t0, t1) = doorway.span();
                let hinges = [(t0, 0.0), (t0, doorway.gap), (t1, 0.0), (t1, doorway.gap)]
                    .map(|(t, s)| doorway.at(t, s));
                let at_hinge = |q: Point| hinges.iter().any(|h| (h - q).norm() < 4.0 + 1e-6);
                let in_wall = |q: Point| {
                    let s = (q - doorway.at(0.0, 0.0)).dot(&doorway.out());
                    model.kind == DoorKind::Hinged && s > -1e-6 && s < doorway.gap + 4.0 + 1e-6
                };
                for leaf in steps.iter().flatten() {
                    for &corner in &leaf.corners {
                        let seen = is_swept(corner) || in_wall(corner) || at_hinge(corner);
                        assert!(seen, "{leaves:?} {from}..{to}: {corner:?}");
                    }
                }
                for one in &swept {
                    let box_of = one.bounds();
                    for (i, j) in (0..12).flat_map(|i| (0..12).map(move |j| (i, j))) {
                        let share = Vector::new(f64::from(i) / 11.0, f64::from(j) / 11.0);
                        let q = box_of.min + (box_of.max - box_of.min).component_mul(&share);
                        if !one.contains(q, 0.0) {
                            continue;
                        }
                        let far = steps.iter().flatten().map(|leaf| {
                            if leaf.contains(q, 0.0) { 0.0 } else { leaf.border_distance(q) }
                        });
                        let far = far.fold(f64::INFINITY, f64::min);
                        assert!(far < 1.5, "{leaves:?} {from}..{to}: {q:?} {far}");
                    }
                }
            }
        }
    }
}

#[test]
fn leaves_of_a_double_door_leave_the_sum_of_their_ways() {
    let leaf = |hinge| DoorLeaf { hinge, share: 0.5, thickness: Cm::of(4.0), max_open: 90.0 };
    let (mut b, _, _, door) = two_rooms(0.0, DoorKind::Hinged, DoorState::OPEN);
    b.world.doors.get_mut(&door).unwrap().leaves =
        vec![leaf(HingeSide::Right), leaf(HingeSide::Left)];
    let plan = build(&b);
    let doorway = plan.doorways_of(door).next().unwrap();
    let width = |opening: f64| {
        doorway
            .clear_width(b.world.doors.get(&door), DoorState { status: DoorStatus::Open, opening })
    };
    assert!((width(100.0) - 82.0).abs() < 1e-9, "{}", width(100.0));
    assert!(width(50.0) < 82.0 && width(50.0) > 20.0, "{}", width(50.0));
    assert!(width(0.0) < 1e-9);
}

#[test]
fn a_sliding_leaf_leaves_what_it_withdraws_from() {
    let (b, _, _, door) = two_rooms(10.0, DoorKind::Sliding, DoorState::OPEN);
    let plan = build(&b);
    let doorway = plan.doorways_of(door).next().unwrap();
    for opening in [0.0, 30.0, 60.0, 100.0] {
        let width = doorway
            .clear_width(b.world.doors.get(&door), DoorState { status: DoorStatus::Open, opening });
        assert!((width - 0.9 * opening).abs() < 1e-9, "{opening}: {width}");
    }
}

#[test]
fn a_hinged_leaf_keeps_its_size_and_stays_within_its_sweep() {
    let (b, _, _, door) = two_rooms(10.0, DoorKind::Hinged, DoorState::OPEN);
    let plan = build(&b);
    let (doorway, model) = (plan.doorways_of(door).next().unwrap(), &b.world.doors[&door]);
    for opening in [10.0, 45.0, 80.0, 100.0] {
        for (leaf, sweep) in doorway
            .leaves(model)
            .at(DoorState { status: DoorStatus::Open, opening })
            .iter()
            .zip(doorway.leaves(model).swept((0.0, 100.0)))
        {
            assert!((leaf.signed_area() - 90.0 * 4.0).abs() < 1e-6);
            let tip = leaf.corners.iter().filter(|&&c| sweep.contains(c, 1e-6)).count();
            assert!(tip >= 2, "{opening}: {leaf:?}");
        }
    }
}

#[test]
fn a_door_half_open_is_judged_by_its_leaf() {
    for (opening, passes) in [(100.0, true), (20.0, false)] {
        let (b, ..) =
            two_rooms(10.0, DoorKind::Hinged, DoorState { status: DoorStatus::Open, opening });
        assert_eq!(way(&b, (60., 250.), (750., 50.)).is_some(), passes, "{opening}");
    }
}

#[test]
fn the_wardrobes_open_door_stands_in_the_way() {
    let (mut b, hall) = room(&[]);
    let wardrobe = b.put(hall, 150., 240., 100., 60., 0.0, 200.0);
    let door = b.door(DoorKind::Hinged, 100.0, DoorState::CLOSED);
    let object = b.world.replicas[&wardrobe].object;
    b.world.objects.get_mut(&object).unwrap().doors.push(DoorMount {
        item: "I0".into(),
        side: "S0".into(),
        door,
        opens: OpensTo::Outside,
    });
    assert!(build(&b).fragment(hall).unwrap().obstacle_at(p(152., 200.)).is_none());
    b.world.replicas.get_mut(&wardrobe).unwrap().door_states =
        BTreeMap::from([(door, DoorState::OPEN)]);
    let plan = build(&b);
    let leaf = plan.fragment(hall).unwrap().obstacle_at(p(152., 200.)).map(|o| o.blocker);
    assert_eq!(leaf, Some(Blocker::ReplicaLeaf { replica: wardrobe, door, leaf: 0 }));
}

/// What a leaf strikes is found by trying every leaf pose between: it stops at the first that meets a thing. The
/// ordinary run puts the thing at one place of five.
#[test]
fn a_leaf_stops_where_the_first_of_many_poses_meets_a_thing() {
    let step = if crate::files::long() { 1 } else { 5 };
    let mut struck = 0;
    for leaves in DOORS {
        let (b, door) = of_kind(leaves, 14.0, 100.0);
        let plan = build(&b);
        let doorway = plan.doorways_of(door).next().expect("it joins the rooms");
        let hung = doorway.leaves(&b.world.doors[&door]);
        let (t0, t1) = doorway.span();
        for k in (0..60).step_by(step) {
            let (i, j) = (f64::from(k % 12), f64::from(k / 12));
            // From the depth of the wall well into the room towards which it opens.
            let s = [-110.0 + 25.0 * j, doorway.gap + 110.0 - 25.0 * j][doorway.opens_to];
            let at = doorway.at(t0 - 10.0 + (t1 - t0 + 20.0) * i / 11.0, s);
            let thing = Polygon::new(
                [(-3.0, -2.0), (3.0, -2.0), (0.0, 4.0)].map(|(x, y)| at + Vector::new(x, y)).into(),
            );
            let strike = hung.strikes((0.0, 100.0), [((), &thing)]);
            let meets = |opening: f64| {
                let poses = hung.obstacles(DoorState { status: DoorStatus::Open, opening });
                let near = |p: &Polygon, q: &Polygon| p.corners.iter().any(|&c| q.contains(c, 0.0));
                let crosses = |p: &Polygon| {
                    let steps = (0..=40).map(|n| f64::from(n) / 40.0);
                    p.edges()
                        .any(|(u, v)| steps.clone().any(|t| thing.contains(u + (v - u) * t, 0.0)))
                };
                poses.iter().any(|p| near(&thing, p) || crosses(p))
            };
            let first = (1..=400).map(|k| f64::from(k) / 4.0).find(|&o| meets(o));
            match (strike, first) {
                (Some(strike), Some(first)) => {
                    struck += 1;
                    assert!(
                        (strike.opening - first).abs() < 1.5,
                        "{leaves:?} {k}: {strike:?} {first}"
                    );
                }
                (None, None) => {}
                // Only a thing that is grazed may be told either way.
                (strike, first) => {
                    let swept = hung.swept((0.0, 100.0));
                    let off = swept.iter().map(|s| s.border_distance(at)).fold(9.0, f64::min);
                    assert!(off < 6.0, "{leaves:?} {k}: {strike:?} {first:?}");
                }
            }
        }
    }
    assert!(struck > 80 / step, "{struck}");
}

#[test]
fn a_door_does_not_open_through_a_thing_and_the_thing_is_named() {
    for (kind, height, stops) in [
        (DoorKind::Hinged, 80.0, true),
        (DoorKind::Hinged, 1.0, false),
        (DoorKind::Sliding, 80.0, false),
    ] {
        let (mut b, one, two, door) = two_rooms(10.0, kind, DoorState::CLOSED);
        let doorway = build(&b).doorways_of(door).next().expect("it joins the rooms").clone();
        let into = [one, two][doorway.opens_to];
        let at = doorway.before(doorway.opens_to, 40.0);
        let frame = build(&b).scene().areas[&into].frame;
        let local = frame.invert(at);
        let chair = b.put(into, local.x - 10.0, local.y - 10.0, 20.0, 20.0, 0.0, height);
        let stand = Pose { at: doorway.before(1 - doorway.opens_to, 80.0), heading: Deg::ZERO };
        let mut robot = orthoframe_robot::Simulator::new(b.world.clone(), MapId(1), stand);
        use orthoframe_robot::{Obstruction, Refusal, Unfinished, Vehicle, Watch};
        let opened = robot.set_door(door, DoorState::OPEN, &mut Watch::none());
        if stops {
            let by = Some(Obstruction::Replica(chair));
            let is_jam = matches!(opened, Err(Unfinished::Met(Refusal::DoorJammed { by: b, opening: 1..=60, .. })) if b == by);
            assert!(is_jam, "{opened:?}");
            assert_eq!(robot.truth().doors[&door].state, DoorState::CLOSED);
        } else {
            assert_eq!(opened, Ok(()));
        }
    }
}
