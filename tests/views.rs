//! What is seen from a pose (M12): scans and visible stretches against the obvious slow way.

use orthoframe::geometry::*;
use orthoframe::map::*;
use orthoframe::units::*;

use crate::floor_cases::{build, room};
use crate::floors::{p, two_rooms};
use crate::ugly_floors::ugly;

/// Every solid edge at a height: of walls, and of what stands there, a frustum as wide as it is at that height.
fn edges_at(plan: &FloorPlan, height: f64) -> Vec<(Point, Point)> {
    let mut edges = Vec::new();
    for area in plan.scene().areas.values() {
        for prism in &area.prisms {
            let solid = prism.polygon.edges().zip(&prism.sides);
            let solid = solid.filter(|(_, s)| s.permeability == Permeability::Impermeable);
            edges.extend(solid.map(|(edge, _)| edge));
        }
    }
    for prism in plan.scene().replicas.values().flat_map(|r| &r.prisms) {
        if prism.bottom <= height && height < prism.top {
            let share = (height - prism.bottom) / (prism.top - prism.bottom);
            let scale = 1.0 + (prism.roof_scale - 1.0) * share;
            let centre = prism.polygon.centroid();
            let place = |q: Point| centre + (q - centre) * scale;
            edges.extend(prism.polygon.edges().map(|(a, b)| (place(a), place(b))));
        }
    }
    edges
}

/// How far a beam goes: the nearest crossing with any edge.
fn slow_beam(edges: &[(Point, Point)], from: Point, direction: f64, range: f64) -> f64 {
    let way = Vector::new(direction.cos(), direction.sin());
    let hits = edges.iter().filter_map(|&(a, b)| {
        let edge = b - a;
        let turn = way.perp(&edge);
        let (t, s) = ((a - from).perp(&edge) / turn, (a - from).perp(&way) / turn);
        (turn.abs() > 1e-12 && t >= 0.0 && (0.0..=1.0).contains(&s)).then_some(t)
    });
    hits.fold(range, f64::min)
}

#[test]
fn scans_meet_what_the_slow_way_meets_at_every_height() {
    let mut short = 0;
    for seed in 0..12 {
        let (b, area) = ugly(seed);
        let plan = build(&b);
        let Some(at) = plan.rest_in(area) else { continue };
        let pose = Pose { at, heading: Deg::of(seed as f64 * 31.0) };
        for height in [5.0, 40.0, 72.5, 110.0, 180.0] {
            let sight = plan.sight(&b.world, height);
            let edges = edges_at(&plan, height);
            let beams = sight.scan(pose, 240.0, 333, 300.0);
            assert_eq!(beams.len(), 333);
            for beam in &beams {
                let slow = slow_beam(&edges, at, beam.direction, 300.0);
                // A beam along an edge, or past a corner, may meet it or not.
                let aside = [-1e-6, 1e-6].map(|d| slow_beam(&edges, at, beam.direction + d, 300.0));
                let sharp = aside.iter().all(|a| (a - slow).abs() < 1e-2);
                if sharp {
                    let off = (beam.distance - slow).abs();
                    assert!(off < 1e-3, "seed {seed} at {height}: {beam:?} {slow}");
                }
                assert_eq!(beam.face.is_none(), beam.distance >= 300.0);
                short += usize::from(beam.distance < 300.0);
            }
            // Every stretch that is called visible is seen in its middle; every beam's end lies on one.
            let seen = sight.visible(pose, 240.0, 300.0);
            for v in &seen {
                let middle = nalgebra::center(&v.right, &v.left);
                let to = middle - at;
                let slow = slow_beam(&edges, at, to.y.atan2(to.x), 1e4);
                assert!(slow > to.norm() - 0.05, "seed {seed} at {height}: {v:?} behind {slow}");
            }
            for beam in beams.iter().filter(|beam| beam.face.is_some()) {
                let end =
                    at + Vector::new(beam.direction.cos(), beam.direction.sin()) * beam.distance;
                let on =
                    |v: &Visible| (nearest_on_segment(end, v.right, v.left) - end).norm() < 0.2;
                assert!(seen.iter().any(on), "seed {seed} at {height}: {beam:?}");
            }
        }
    }
    assert!(short > 5_000, "{short}");
}

#[test]
fn one_looks_through_an_open_door_but_not_through_a_shut_one_nor_over_it() {
    for (kind, gap) in
        [(DoorKind::Hinged, 0.0), (DoorKind::Sliding, 12.0), (DoorKind::Passage, 12.0)]
    {
        let ahead = |state: DoorState, height: f64| {
            let (b, ..) = two_rooms(gap, kind, state);
            let pose = Pose { at: p(100.0, 145.0), heading: Deg::ZERO };
            build(&b).sight(&b.world, height).scan(pose, 0.0, 1, 5000.0)[0]
        };
        let far_wall = 700.0 + gap;
        let near = |beam: Beam| (290.0..=300.0 + gap).contains(&beam.distance);
        assert!((ahead(DoorState::OPEN, 100.0).distance - far_wall).abs() < 1e-6, "{kind:?}");
        if kind != DoorKind::Passage {
            assert!(near(ahead(DoorState::CLOSED, 100.0)), "{kind:?}");
        }
        // Over the door, which is 200 high, there is wall.
        for state in [DoorState::OPEN, DoorState::CLOSED] {
            let beam = ahead(state, 230.0);
            assert!((beam.distance - 300.0).abs() < 1e-6, "{kind:?}: {beam:?}");
            assert!(matches!(beam.face, Some(SeenFace { blocker: Blocker::Wall { .. }, .. })));
        }
    }
}

#[test]
fn a_wardrobes_front_is_seen_while_it_is_shut_and_its_back_when_it_is_open() {
    let (mut b, hall) = room(&[]);
    let wardrobe = b.put(hall, 150., 200., 100., 60., 0.0, 200.0);
    let door = b.door(DoorKind::Hinged, 100.0, DoorState::CLOSED);
    let object = b.world.replicas[&wardrobe].object;
    let front = b.world.objects[&object].items[0].orthoframe;
    b.world.orthoframes.get_mut(&front).expect("its block").base[0].permeability =
        Permeability::Conditional;
    let mount = DoorMount { item: "I0".into(), side: "S0".into(), door, opens: OpensTo::Outside };
    b.world.objects.get_mut(&object).expect("just made").doors.push(mount);
    let ahead = |world: &World| {
        let plan = FloorPlan::build(world, MapId(1), &world.robot, &DoorStates::new());
        let pose = Pose { at: p(200.0, 50.0), heading: Deg::of(90.0) };
        plan.sight(world, 100.0).scan(pose, 0.0, 1, 1000.0)[0]
    };
    assert!((ahead(&b.world).distance - 150.0).abs() < 1e-6);
    let replica = b.world.replicas.get_mut(&wardrobe).expect("just put");
    replica.door_states.insert(door, DoorState::OPEN);
    let beam = ahead(&b.world);
    assert!((beam.distance - 210.0).abs() < 1e-6, "{beam:?}");
}

#[test]
fn a_box_hides_what_stands_behind_it() {
    let (b, _) = room(&[[150., 120., 40., 60., 0.], [250., 140., 20., 20., 0.]]);
    let plan = build(&b);
    let (front, back) = {
        let mut ids = b.world.replicas.keys().copied();
        (ids.next().unwrap(), ids.next().unwrap())
    };
    let sight = plan.sight(&b.world, 50.0);
    let pose = Pose { at: p(50., 150.), heading: Deg::ZERO };
    let seen = sight.visible(pose, 120.0, 1000.0);
    let sees = |id: ReplicaId| {
        seen.iter()
            .any(|v| matches!(v.face.blocker, Blocker::Replica { replica, .. } if replica == id))
    };
    assert!(sees(front) && !sees(back));
    let scan = sight.scan(pose, 0.0, 1, 1000.0);
    assert!((scan[0].distance - 100.0).abs() < 1e-6);
    // Above both, only the walls are left.
    assert!(
        (plan.sight(&b.world, 150.0).scan(pose, 0.0, 1, 1000.0)[0].distance - 350.0).abs() < 1e-6
    );
    assert!(sight.scan(pose, 0.0, 1, 70.0)[0].face.is_none());
}

#[test]
fn visible_stretches_are_seen_by_a_dense_scan_too() {
    let (b, _) =
        room(&[[150., 120., 40., 60., 20.], [250., 40., 60., 60., 50.], [60., 200., 50., 20., 0.]]);
    let plan = build(&b);
    let sight = plan.sight(&b.world, 50.0);
    let pose = Pose { at: p(100., 100.), heading: Deg::of(30.0) };
    let seen = sight.visible(pose, 360.0, 1000.0);
    for beam in sight.scan(pose, 359.0, 721, 1000.0) {
        let at = pose.at + nalgebra_vector(beam.direction) * beam.distance;
        let on = seen.iter().any(|v| {
            Some(v.face) == beam.face && (at - nearest_on_segment(at, v.right, v.left)).norm() < 0.1
        });
        assert!(on, "{beam:?}");
    }
}

fn nalgebra_vector(direction: f64) -> Vector {
    Vector::new(direction.cos(), direction.sin())
}
