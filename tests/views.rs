//! What is seen from a pose (M12): scans and visible stretches against the obvious slow way.

use orthoframe_geometry::{Face, *};
use orthoframe_map::*;
use orthoframe_units::*;

use crate::floor_cases::{build, room};
use crate::floors::{p, two_rooms};
use crate::ugly_floors::ugly;

/// Every solid edge at a height: of walls, and of what stands there, a frustum as wide as it is at that height.
fn edges_at(plan: &FloorPlan, height: f64) -> Vec<(Point, Point)> {
    let mut edges = Vec::new();
    for area in plan.scene().areas.values() {
        for prism in &area.prisms {
            let solid = prism.polygon.edges().zip(prism.sides.iter());
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

/// From where the robot stands nothing is met from behind: a localiser takes it that no scan shows the back of a stretch.
#[test]
fn beams_meet_stretches_from_their_fronts() {
    let maps = ["rb2", "lab", "two-storeys", "room"].map(|name| format!("maps/{name}.toml"));
    let mut worlds: Vec<World> = (0..12).map(|seed| ugly(seed).0.world).collect();
    worlds.extend(maps.iter().map(|path| World::load(path).expect(path)));
    let (mut one_sided, mut met) = (0, 0);
    for (number, world) in worlds.iter().enumerate() {
        for map in world.maps.keys() {
            let plan = FloorPlan::build(world, *map, &world.robot, &DoorStates::new());
            let height = 0.6 * world.robot.height.get();
            let sight = plan.sight(world, height);
            let stretches: Vec<Stretch> = sight.faces().collect();
            one_sided += stretches.iter().filter(|stretch| stretch.front != Front::Both).count();
            for area in plan.scene().areas.keys() {
                let Some(at) = plan.rest_in(*area) else { continue };
                for beam in sight.scan(Pose { at, heading: Deg::ZERO }, 360.0, 720, 1e4) {
                    if beam.face.is_none() {
                        continue;
                    }
                    let way = Vector::new(beam.direction.cos(), beam.direction.sin());
                    let end = at + way * beam.distance;
                    // What has no thickness is a stretch with a front on either side.
                    let is_met = |stretch: &Stretch| {
                        let foot = nearest_on_segment(end, stretch.start, stretch.end);
                        let aside = (stretch.end - stretch.start).perp(&(at - stretch.start));
                        let behind = if aside > 0.0 { Front::Right } else { Front::Left };
                        (foot - end).norm() < 1e-4 && stretch.front != behind
                    };
                    assert!(stretches.iter().any(is_met), "world {number}: {beam:?} from {at}");
                    met += 1;
                }
            }
        }
    }
    assert!(one_sided > 500 && met > 10_000, "{one_sided} {met}");
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

/// A flat piece that can stop a ray, and whose it is; its corners counter-clockwise as seen from where it is seen.
struct Pane {
    face: Face,
    corners: [[f64; 3]; 3],
}

/// Every solid face in triangles: walls, floors, sides, roofs and bases of what stands there.
fn panes(plan: &FloorPlan) -> Vec<Pane> {
    let mut panes = Vec::new();
    let mut quad = |face: Face, q: [[f64; 3]; 4]| {
        panes.push(Pane { face, corners: [q[0], q[1], q[2]] });
        panes.push(Pane { face, corners: [q[0], q[2], q[3]] });
    };
    let at = |p: Point, z: f64| [p.x, p.y, z];
    let mut levels = Vec::new();
    for (id, area) in &plan.scene().areas {
        for (item, prism) in area.prisms.iter().enumerate() {
            for (side, ((a, b), s)) in prism.polygon.edges().zip(prism.sides.iter()).enumerate() {
                if s.permeability == Permeability::Impermeable {
                    let blocker = Blocker::Wall { area: *id, item, side };
                    let face = Face { blocker, kind: FaceKind::Side(side) };
                    let (z, top) = (prism.bottom, prism.top);
                    quad(face, [at(b, z), at(a, z), at(a, top), at(b, top)]);
                }
            }
            let blocker = Blocker::Floor { area: *id, item };
            let face = Face { blocker, kind: FaceKind::Base };
            levels.push((face, prism.polygon.clone(), prism.bottom, true));
        }
    }
    for (id, replica) in &plan.scene().replicas {
        for prism in &replica.prisms {
            let blocker = Blocker::Replica { replica: *id, item: prism.item };
            let centre = prism.polygon.centroid();
            let roof = |p: Point| centre + (p - centre) * prism.roof_scale;
            for (side, (a, b)) in prism.polygon.edges().enumerate() {
                let face = Face { blocker, kind: FaceKind::Side(side) };
                let (z, top) = (prism.bottom, prism.top);
                quad(face, [at(a, z), at(b, z), at(roof(b), top), at(roof(a), top)]);
            }
            let top = Polygon::new(prism.polygon.corners.iter().map(|&p| roof(p)).collect());
            let base = Face { blocker, kind: FaceKind::Base };
            levels.push((base, prism.polygon.clone(), prism.bottom, false));
            levels.push((Face { blocker, kind: FaceKind::Roof }, top, prism.top, true));
        }
    }
    // A level face as a fan about a corner is good enough where it is star-shaped; else it is cut small.
    for (face, polygon, z, up) in levels {
        for [a, b, c] in triangles(&polygon) {
            let (b, c) = if up { (b, c) } else { (c, b) };
            panes.push(Pane { face, corners: [at(a, z), at(b, z), at(c, z)] });
        }
    }
    panes
}

/// Ears cut from a polygon, the slow way.
fn triangles(polygon: &Polygon) -> Vec<[Point; 3]> {
    let mut rest = polygon.clone().counter_clockwise().corners;
    let turn = |a: Point, b: Point, c: Point| (b - a).perp(&(c - a));
    let mut ears = Vec::new();
    while rest.len() >= 3 {
        let n = rest.len();
        let ear = (0..n).find(|&i| {
            let [a, b, c] = [rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]];
            let holds =
                |p: &Point| turn(a, b, *p) > 1e-9 && turn(b, c, *p) > 1e-9 && turn(c, a, *p) > 1e-9;
            turn(a, b, c) >= 0.0 && !rest.iter().any(holds)
        });
        let i = ear.unwrap_or(0);
        ears.push([rest[(i + n - 1) % n], rest[i], rest[(i + 1) % n]]);
        rest.remove(i);
    }
    ears
}

/// What a ray meets first, and how far off; after Möller and Trumbore. Of the two sides of what has no thickness it meets
/// the one that looks back at it.
fn slow_ray(panes: &[Pane], from: [f64; 3], way: [f64; 3]) -> Option<(f64, Face)> {
    let sub = |a: [f64; 3], b: [f64; 3]| [a[0] - b[0], a[1] - b[1], a[2] - b[2]];
    let dot = |a: [f64; 3], b: [f64; 3]| a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    let cross = |a: [f64; 3], b: [f64; 3]| {
        [a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]]
    };
    let hits = panes.iter().filter_map(|pane| {
        let [a, b, c] = pane.corners;
        let (u, v) = (sub(b, a), sub(c, a));
        let p = cross(way, v);
        let det = dot(u, p);
        if det.abs() < 1e-12 {
            return None;
        }
        let t = sub(from, a);
        let q = cross(t, u);
        let (s, r) = (dot(t, p) / det, dot(way, q) / det);
        let far = dot(v, q) / det;
        (s >= 0.0 && r >= 0.0 && s + r <= 1.0 && far > 1e-9).then_some((far, det > 0.0, pane.face))
    });
    let nearer = |a: &(f64, bool, Face), b: &(f64, bool, Face)| {
        if (a.0 - b.0).abs() < 1e-6 { b.1.cmp(&a.1) } else { a.0.total_cmp(&b.0) }
    };
    hits.min_by(nearer).map(|(far, _, face)| (far, face))
}

fn direction(azimuth: f64, rise: f64) -> [f64; 3] {
    [azimuth.cos() * rise.cos(), azimuth.sin() * rise.cos(), rise.sin()]
}

/// Rays in all directions of the field of view meet what is said to be seen, and nothing that is said to be seen is hidden.
#[test]
fn faces_in_view_are_those_that_dense_rays_meet() {
    let (mut met, mut seen_middles) = (0, 0);
    for seed in 0..10 {
        let (b, area) = ugly(seed);
        let plan = build(&b);
        let Some(at) = plan.rest_in(area) else { continue };
        let panes = panes(&plan);
        let (field, range) = [(360.0, 2000.0), (90.0, 2000.0), (240.0, 300.0)][seed as usize % 3];
        let pose = Pose { at, heading: Deg::of(seed as f64 * 31.0) };
        let eye = Eye { pose, height: [45.0, 120.0, 170.0][seed as usize % 3], field, range };
        let from = [at.x, at.y, eye.height];
        let seen = plan.faces(&b.world, &eye).in_view(&eye);
        for (i, j) in (0..150).flat_map(|i| (0..24).map(move |j| (i, j))) {
            let share = (f64::from(i) + 0.5) / 150.0 - 0.5;
            let azimuth = pose.heading.radians() + share * field.to_radians() * 0.999;
            let rise = (f64::from(j) - 11.3) * 0.12;
            let way = direction(azimuth, rise);
            let Some((far, face)) = slow_ray(&panes, from, way) else { continue };
            // Next to an edge it is a matter of rounding which face is met.
            let about = [(1e-3, 0.0), (-1e-3, 0.0), (0.0, 1e-3), (0.0, -1e-3)];
            let mut near =
                about.iter().map(|(x, y)| slow_ray(&panes, from, direction(azimuth + x, rise + y)));
            let is_sharp =
                near.all(|n| n.is_some_and(|(f, g)| g == face && (f - far).abs() < 0.05 * far));
            if !is_sharp || (far / range - 1.0).abs() < 2e-3 {
                continue;
            }
            let p = nalgebra::Point3::new(
                from[0] + way[0] * far,
                from[1] + way[1] * far,
                from[2] + way[2] * far,
            );
            // Faces of one plane may both be called seen; none may be called hidden that is met first.
            let found = seen.iter().any(|f| f.face == face && f.contains(p, 0.02));
            assert_eq!(found, far < range, "seed {seed}: {face:?} at {p:?}, {far} cm off");
            met += usize::from(found);
        }
        for view in &seen {
            assert!(view.area <= view.whole * (1.0 + 1e-6), "{view:?}");
            for outline in view.outlines() {
                let sum: nalgebra::Vector3<f64> = outline.iter().map(|p| p.coords).sum();
                let middle = nalgebra::Point3::from(sum / outline.len() as f64);
                if !view.contains(middle, 0.0) {
                    continue;
                }
                let to = middle - nalgebra::Point3::new(from[0], from[1], from[2]);
                let far =
                    slow_ray(&panes, from, (to / to.norm()).into()).map_or(f64::INFINITY, |h| h.0);
                assert!(far > to.norm() - 0.1, "seed {seed}: {:?} is behind {far}", view.face);
                seen_middles += 1;
            }
        }
    }
    assert!(met > 12_000 && seen_middles > 150, "{met} {seen_middles}");
}

#[test]
fn in_space_tops_are_seen_from_above_and_what_is_low_hides_behind_what_is_high() {
    // A high box, a low one behind it, a low one before it, and a cup on the low one before.
    let (mut b, _) = room(&[
        [200., 120., 20., 60., 0.],
        [300., 140., 20., 20., 0.],
        [120., 130., 40., 40., 0.],
        [135., 145., 8., 8., 0.],
    ]);
    let ids: Vec<ReplicaId> = b.world.replicas.keys().copied().collect();
    let heights = [150.0, 40.0, 50.0, 10.0];
    for (id, height) in ids.iter().zip(heights) {
        let object = b.world.replicas[id].object;
        let block = b.world.objects[&object].items[0].orthoframe;
        b.world.orthoframes.get_mut(&block).expect("its block").height = Cm::of(height);
    }
    let cup = b.world.replicas.get_mut(&ids[3]).expect("just put");
    cup.frame.z = Cm::of(50.0);
    let plan = build(&b);
    let kinds = |eye: &Eye, id: ReplicaId| -> Vec<FaceKind> {
        let views = plan.faces(&b.world, eye).in_view(eye);
        let of = |v: &&FaceInView| matches!(v.face.blocker, Blocker::Replica { replica, .. } if replica == id);
        views.iter().filter(of).map(|v| v.face.kind).collect()
    };
    let pose = Pose { at: p(50., 150.), heading: Deg::ZERO };
    let eye = |height: f64| Eye { pose, height, field: 120.0, range: 1000.0 };
    let has = |eye: &Eye, id, kind| kinds(eye, id).contains(&kind);
    assert!(has(&eye(120.0), ids[2], FaceKind::Roof), "from above one sees the top");
    assert!(!has(&eye(30.0), ids[2], FaceKind::Roof), "from below one does not");
    assert!(!kinds(&eye(120.0), ids[3]).is_empty(), "the cup stands on it");
    assert!(!has(&eye(120.0), ids[3], FaceKind::Base));
    assert!(kinds(&eye(120.0), ids[1]).is_empty(), "the high box hides the low one");
    assert!(!kinds(&eye(200.0), ids[0]).is_empty());
    let turned = Eye { pose: Pose { heading: Deg::of(180.0), ..pose }, ..eye(120.0) };
    assert!(ids.iter().all(|&id| kinds(&turned, id).is_empty()), "all of it is behind");
    // Aslant, 99 cm lie between the eye and the low top, and 150 between the eye and the high box.
    let short = Eye { range: 110.0, ..eye(120.0) };
    assert!(kinds(&short, ids[0]).is_empty() && !kinds(&short, ids[2]).is_empty());
}

#[test]
fn from_within_a_thing_or_outside_of_the_building_there_is_an_answer_too() {
    let (b, _) = room(&[[150., 120., 60., 60., 0.]]);
    let plan = build(&b);
    let id = *b.world.replicas.keys().next().expect("it has a box");
    let within = Pose { at: p(180., 150.), heading: Deg::ZERO };
    for field in [0.0, 1.0, 180.0, 359.9, 360.0, 1e9, -5.0] {
        let eye = Eye { pose: within, height: 20.0, field, range: 1000.0 };
        let seen = plan.faces(&b.world, &eye).in_view(&eye);
        let own = |f: &FaceInView| matches!(f.face.blocker, Blocker::Replica { replica, .. } if replica == id);
        assert!(seen.iter().all(own), "from within a box one sees the box alone: {field}");
        assert_eq!(seen.is_empty(), field <= 0.0, "{field}");
        assert_eq!(plan.sight(&b.world, 20.0).scan(within, field, 0, 500.0).len(), 0);
        for beam in plan.sight(&b.world, 20.0).scan(within, field, 9, 500.0) {
            assert!(beam.distance <= 43.0, "{beam:?}");
        }
    }
    // Within the part that leans out over its base, too.
    let (mut b, _) = room(&[[150., 120., 60., 60., 0.]]);
    let id = *b.world.replicas.keys().next().expect("it has a box");
    let block = b.world.objects[&b.world.replicas[&id].object].items[0].orthoframe;
    let block = b.world.orthoframes.get_mut(&block).expect("its block");
    (block.roof_scale, block.height) = (3.0, Cm::of(100.0));
    let pose = Pose { at: p(230., 150.), heading: Deg::ZERO };
    let eye = Eye { pose, height: 90.0, field: 360.0, range: 1000.0 };
    let leaning = build(&b);
    let seen = leaning.faces(&b.world, &eye).in_view(&eye);
    let own = |f: &FaceInView| matches!(f.face.blocker, Blocker::Replica { replica, .. } if replica == id);
    assert!(!seen.is_empty() && seen.iter().all(own), "{seen:?}");
    for at in [p(-5000.0, 3.0), p(0.0, 0.0), p(400.0, 300.0), p(1e7, -1e7)] {
        let pose = Pose { at, heading: Deg::of(45.0) };
        for range in [0.0, 1.0, 1e6] {
            let eye = Eye { pose, height: 100.0, field: 360.0, range };
            let seen = plan.faces(&b.world, &eye).in_view(&eye);
            assert!(
                seen.iter().all(|f| f.area > 0.0 && f.distance <= range + 1e-6),
                "{at} {range}"
            );
            assert_eq!(plan.sight(&b.world, 100.0).scan(pose, 360.0, 721, range).len(), 721);
            let _ = plan.sight(&b.world, 100.0).visible(pose, 360.0, range);
        }
    }
}
