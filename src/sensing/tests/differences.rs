//! Worlds that differ from the Map: what scans in them say is judged by the truth.

use nalgebra::{Isometry2, Vector2};

use orthoframe_geometry::{DoorStates, FloorPlan, Sight};
use orthoframe_map::{DoorKind, DoorState, DoorStatus, World};
use orthoframe_sensing::{Differences, Inspector, ThingSeen};
use orthoframe_units::{DoorId, MapId, Point, ReplicaId};
use orthoframe_vectors::scan::{Noise, Sensor};

/// Of the laser above the floor, in cm.
const HEIGHT: f64 = 30.0;

fn sensor() -> Sensor {
    let step = std::f64::consts::PI / 360.0;
    Sensor::new(-std::f64::consts::PI, step, 720, (2.0, 1000.0), Noise::default())
        .expect("a sensor")
}

fn sample(name: &str) -> World {
    World::load(format!("{}/../../maps/{name}", env!("CARGO_MANIFEST_DIR"))).expect("a sample map")
}

fn plan(world: &World, map: MapId) -> FloorPlan {
    FloorPlan::build(world, map, &world.robot, &DoorStates::new())
}

/// What the laser brings, with noise of 1 cm, one beam in fifty lost and one in three hundred cut short.
fn scan(sight: &Sight, pose: &Isometry2<f64>, random: &mut fastrand::Rng) -> Vec<f64> {
    let sensor = sensor();
    let at = Point::from(pose.translation.vector);
    (0..sensor.count())
        .map(|beam| {
            let direction = pose.rotation.angle() + sensor.bearing(beam);
            let range = sight.beam(at, direction, 1000.0).distance;
            // Of three evenly spread errors the sum is near enough to a normal one.
            let noise = (0..3).map(|_| random.f64() - 0.5).sum::<f64>() * 2.0;
            match random.u32(0..1000) {
                0..20 => 1000.0,
                20..23 => range * random.f64(),
                _ => range + noise,
            }
        })
        .collect()
}

/// Poses where the robot fits in the true world.
fn poses(truth: &FloorPlan, count: usize, random: &mut fastrand::Rng) -> Vec<Isometry2<f64>> {
    let bounds = truth.fragments().fold(None, |all: Option<orthoframe_geometry::Bounds>, floor| {
        Some(all.map_or(floor.bounds, |all| all.union(&floor.bounds)))
    });
    let Some(bounds) = bounds else { return Vec::new() };
    let size = bounds.max - bounds.min;
    let mut found = Vec::new();
    for _ in 0..20_000 {
        let at = bounds.min + Vector2::new(random.f64() * size.x, random.f64() * size.y);
        if truth.fragments().any(|floor| floor.fits(at)) {
            found.push(Isometry2::new(at.coords, random.f64() * std::f64::consts::TAU));
            if found.len() == count {
                break;
            }
        }
    }
    found
}

/// What a robot that drove about in the true world says against the Map, its pose known to a centimetre or two.
fn inspected(map: &World, truth: &World, id: MapId, scans: usize, seed: u64) -> Differences {
    let mut random = fastrand::Rng::with_seed(seed);
    let (mapped, real) = (plan(map, id), plan(truth, id));
    let sight = real.sight(truth, HEIGHT);
    let mut inspector = Inspector::new(map, &mapped, HEIGHT);
    for pose in poses(&real, scans, &mut random) {
        let ranges = scan(&sight, &pose, &mut random);
        let off = Vector2::new(random.f64() - 0.5, random.f64() - 0.5) * 3.0;
        let told = Isometry2::new(
            pose.translation.vector + off,
            pose.rotation.angle() + (random.f64() - 0.5) * 0.008,
        );
        inspector.take_in(&sensor(), &ranges, &told);
    }
    inspector.differences()
}

fn stands_on_floor(world: &World, id: ReplicaId) -> bool {
    let replica = &world.replicas[&id];
    let object = &world.objects[&replica.object];
    let reaches = object.items.iter().any(|item| {
        let height = world.orthoframe_of(item).height.get();
        let bottom = replica.frame.z.get() + item.frame.z.get();
        bottom <= HEIGHT - 5.0 && bottom + height >= HEIGHT + 5.0
    });
    reaches && replica.frame.z.get() < 5.0
}

#[test]
fn in_a_world_as_mapped_nothing_differs() {
    for name in ["rb2.toml", "lab.toml"] {
        let world = sample(name);
        let id = *world.maps.keys().next().expect("a map");
        for seed in 0..4 {
            let seen = inspected(&world, &world, id, 30, seed);
            let wrong: Vec<_> = seen
                .things
                .iter()
                .filter(|look| look.seen != ThingSeen::There)
                .map(|look| (&world.replicas[&look.thing].name, look))
                .collect();
            assert!(wrong.is_empty(), "{name} {seed}: {wrong:?}");
            // Beams that were cut short lie about, each by itself.
            assert!(seen.unmapped.is_empty(), "{name} {seed}: {:?}", seen.unmapped);
            for (door, state) in &seen.doors {
                let mapped = world.doors[door].state;
                let told = state.state(mapped);
                assert_eq!(
                    told,
                    Some(mapped),
                    "{name} {seed}: {} {state:?}",
                    world.doors[door].name
                );
            }
            let least = if name == "rb2.toml" { 8 } else { 4 };
            assert!(seen.things.len() >= least, "{name} {seed}: {}", seen.things.len());
        }
    }
}

#[test]
fn things_taken_away_are_missed_and_nothing_else_is() {
    let (mut missed, mut unseen) = (0, 0);
    for name in ["rb2.toml", "lab.toml"] {
        let map = sample(name);
        let id = *map.maps.keys().next().expect("a map");
        for seed in 0..12 {
            let mut random = fastrand::Rng::with_seed(seed);
            let all: Vec<ReplicaId> =
                map.replicas.keys().copied().filter(|id| stands_on_floor(&map, *id)).collect();
            let gone = all[random.usize(0..all.len())];
            let mut truth = map.clone();
            truth.replicas.remove(&gone);
            let seen = inspected(&map, &truth, id, 30, seed);
            for look in &seen.things {
                if look.thing != gone {
                    assert_eq!(
                        look.seen,
                        ThingSeen::There,
                        "{name} {seed}: {:?}",
                        map.replicas[&look.thing].name
                    );
                }
            }
            match seen.things.iter().find(|look| look.thing == gone) {
                Some(look) if look.seen == ThingSeen::Missed => missed += 1,
                Some(look) => panic!("{name} {seed}: {} {look:?}", map.replicas[&gone].name),
                None => unseen += 1,
            }
        }
    }
    assert!(missed >= 5 * unseen, "{missed} missed, {unseen} of which nothing is said");
}

/// Whether a thing stands free of all others and of the walls.
fn stands_free(world: &World, id: MapId, thing: ReplicaId) -> bool {
    let floor = plan(world, id);
    let scene = floor.scene();
    let own = &scene.replicas[&thing];
    let mut others = scene.replicas.values().filter(|other| other.id != thing);
    let apart = others.all(|other| {
        !other.bounds.grown(10.0).meets(&own.bounds) || other.prisms.iter().all(|p| p.bottom > 60.0)
    });
    let corners: Vec<Point> = own.prisms.iter().flat_map(|p| p.polygon.corners.clone()).collect();
    let mut walls = floor.fragments().flat_map(|f| f.walls.clone());
    let clear = walls.all(|(a, b)| {
        corners
            .iter()
            .all(|c| (orthoframe_geometry::nearest_on_segment(*c, a, b) - c).norm() > 12.0)
    });
    let area = scene.area_at(own.bounds.min);
    apart && clear && area.is_some() && area == scene.area_at(own.bounds.max)
}

#[test]
fn things_that_were_moved_are_found_where_they_are_or_only_missed() {
    let (mut found, mut only_missed) = (0, 0);
    for name in ["rb2.toml", "lab.toml"] {
        let map = sample(name);
        let id = *map.maps.keys().next().expect("a map");
        for seed in 0..14 {
            let mut random = fastrand::Rng::with_seed(seed);
            let all: Vec<ReplicaId> =
                map.replicas.keys().copied().filter(|id| stands_on_floor(&map, *id)).collect();
            let thing = all[random.usize(0..all.len())];
            let mut truth = map.clone();
            let before = truth.replicas[&thing].frame;
            let placed = (0..300).any(|_| {
                let at = Vector2::new(random.f64() - 0.5, random.f64() - 0.5) * 400.0;
                let moved = orthoframe_units::Frame::new(
                    before.x.get() + at.x,
                    before.y.get() + at.y,
                    before.z.get(),
                    before.angle + orthoframe_units::Deg::of(random.f64() * 360.0),
                );
                truth.replicas.get_mut(&thing).expect("it is one").frame = moved;
                at.norm() > 60.0 && stands_free(&truth, id, thing)
            });
            if !placed {
                continue;
            }
            let seen = inspected(&map, &truth, id, 40, seed);
            let real = plan(&truth, id);
            let bounds = real.scene().replicas[&thing].bounds;
            for look in &seen.things {
                let name = &map.replicas[&look.thing].name;
                if look.thing == thing {
                    match look.seen {
                        ThingSeen::Moved(frame) => {
                            let mut told = map.clone();
                            let replica = told.replicas.get_mut(&thing).expect("it is one");
                            let (_, area) = map.placement(replica.area).expect("placed");
                            let at = area.invert(frame.origin());
                            replica.frame = orthoframe_units::Frame::new(
                                at.x,
                                at.y,
                                before.z.get(),
                                frame.angle - area.angle,
                            );
                            let drawn = plan(&told, id).scene().replicas[&thing].bounds;
                            let off = (drawn.min - bounds.min)
                                .norm()
                                .max((drawn.max - bounds.max).norm());
                            assert!(off <= 15.0, "{name} {seed}: off by {off:.0} cm");
                            found += 1;
                        }
                        ThingSeen::Missed => only_missed += 1,
                        ThingSeen::There => panic!("{name} {seed}: {look:?}"),
                    }
                } else {
                    assert_eq!(look.seen, ThingSeen::There, "{seed}: {name}");
                }
            }
        }
    }
    assert!(found >= 2 * only_missed, "{found} found, {only_missed} only missed");
}

#[test]
fn what_was_put_there_is_seen_where_it_is_and_a_person_who_walks_on_is_not() {
    let map = sample("rb2.toml");
    let id = *map.maps.keys().next().expect("a map");
    let (mut seen_there, mut all) = (0, 0);
    for seed in 0..10 {
        let mut random = fastrand::Rng::with_seed(seed);
        let things: Vec<ReplicaId> =
            map.replicas.keys().copied().filter(|id| stands_on_floor(&map, *id)).collect();
        let like = things[random.usize(0..things.len())];
        let mut truth = map.clone();
        let new = ReplicaId(90_000);
        let placed = (0..300).any(|_| {
            let mut copy = map.replicas[&like].clone();
            copy.id = new;
            copy.name = "Нечто".to_owned();
            let at = Vector2::new(random.f64() - 0.5, random.f64() - 0.5) * 600.0;
            copy.frame = orthoframe_units::Frame::new(
                copy.frame.x.get() + at.x,
                copy.frame.y.get() + at.y,
                copy.frame.z.get(),
                orthoframe_units::Deg::of(random.f64() * 360.0),
            );
            truth.replicas.insert(new, copy);
            stands_free(&truth, id, new)
        });
        if !placed {
            continue;
        }
        all += 1;
        let seen = inspected(&map, &truth, id, 30, seed);
        let real = plan(&truth, id);
        let bounds = real.scene().replicas[&new].bounds.grown(12.0);
        for thing in &seen.unmapped {
            let mut corners = thing.pieces.iter().flat_map(|piece| piece.corners.iter());
            assert!(corners.all(|c| bounds.contains(*c)), "{seed}: {thing:?} {bounds:?}");
        }
        seen_there += usize::from(!seen.unmapped.is_empty());
        // It is taken away again before the robot's eyes.
        let mapped = plan(&map, id);
        let mut inspector = Inspector::new(&map, &mapped, HEIGHT);
        let mut look = |world: &World, count: usize| {
            let real = plan(world, id);
            let sight = real.sight(world, HEIGHT);
            for pose in poses(&real, count, &mut random) {
                inspector.take_in(&sensor(), &scan(&sight, &pose, &mut random), &pose);
            }
        };
        look(&truth, 10);
        look(&map, 40);
        let left = inspector.differences().unmapped;
        assert!(left.is_empty(), "{seed}: {left:?}");
    }
    assert!(seen_there >= 9 * all / 10, "{seen_there} of {all}");
}

#[test]
fn how_doors_stand_is_seen_and_never_told_wrong() {
    let (mut told, mut open, mut unclear) = (0, 0, 0);
    for name in ["rb2.toml", "lab.toml"] {
        let map = sample(name);
        let id = *map.maps.keys().next().expect("a map");
        let hung: Vec<DoorId> = plan(&map, id)
            .doorways()
            .iter()
            .filter_map(|doorway| map.doors.get(&doorway.door?))
            .filter(|door| door.kind != DoorKind::Passage && !door.leaves.is_empty())
            .map(|door| door.id)
            .collect();
        for seed in 0..12 {
            let mut random = fastrand::Rng::with_seed(seed);
            let mut truth = map.clone();
            for door in &hung {
                let state = match random.u32(0..3) {
                    0 => DoorState::CLOSED,
                    1 => DoorState::OPEN,
                    _ => {
                        let opening = 20.0 + random.f64() * 60.0;
                        DoorState { status: DoorStatus::Open, opening }
                    }
                };
                truth.doors.get_mut(door).expect("it is one").state = state;
            }
            let seen = inspected(&map, &truth, id, 25, seed);
            for (door, told_state) in &seen.doors {
                let real = truth.doors[door].state;
                let opening = if real.status == DoorStatus::Open { real.opening } else { 0.0 };
                let name = &truth.doors[door].name;
                assert!(
                    (told_state.least - 8.0..=told_state.most + 8.0).contains(&opening),
                    "{name} {seed}: {opening:.0} % told as {told_state:?}"
                );
                told += 1;
                open += usize::from(opening > 0.0);
            }
            unclear += hung.iter().filter(|door| !seen.doors.contains_key(door)).count();
        }
    }
    assert!(told >= 2 * unclear && open > 20, "{told} told ({open} open), {unclear} unclear");
}

#[test]
fn whatever_a_sensor_brings_is_taken_in() {
    let map = sample("rb2.toml");
    let id = *map.maps.keys().next().expect("a map");
    let mapped = plan(&map, id);
    let mut inspector = Inspector::new(&map, &mapped, HEIGHT);
    let pose = Isometry2::new(Vector2::new(250.0, 200.0), 0.3);
    for value in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300, 1000.0, 3.0] {
        inspector.take_in(&sensor(), &vec![value; 720], &pose);
    }
    inspector.take_in(&sensor(), &[], &pose);
    inspector.take_in(&sensor(), &[100.0; 2000], &pose);
    let far = Isometry2::new(Vector2::new(1e9, -1e9), 0.0);
    inspector.take_in(&sensor(), &[300.0; 720], &far);
    let _ = inspector.differences();
}
