//! Passframes by their definitions: types, ids that last, what lies beyond each border.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe_geometry::*;
use orthoframe_map::*;
use orthoframe_units::*;

use crate::floor_properties::{Random, random_world};
use crate::floors::{Builder, Opening, p, rectangle, two_rooms};

fn build(world: &World) -> FloorPlan {
    FloorPlan::build(world, MapId(1), &world.robot, &DoorStates::new())
}

/// The types by their definitions, each looked at by itself.
#[test]
fn types_are_what_their_definitions_say() {
    let mut seen = BTreeMap::<PassframeKind, usize>::new();
    for seed in 0..30 {
        let plan = build(&random_world(seed).world);
        for floor in plan.fragments() {
            let frames: BTreeMap<PassframeId, &Passframe> =
                floor.passframes().iter().map(|f| (f.id, f)).collect();
            assert_eq!(frames.len(), floor.passframes().len(), "ids are unique");
            let at_door = |f: &Passframe| {
                f.borders.iter().any(|b| matches!(b.beyond, Beyond::Doorway { .. }))
            };
            let reaches_a_door = |start: PassframeId| {
                let (mut seen, mut open) = (BTreeSet::from([start]), vec![start]);
                while let Some(id) = open.pop() {
                    if at_door(frames[&id]) {
                        return true;
                    }
                    let next = frames[&id].neighbours().map(|n| n.0).filter(|n| seen.insert(*n));
                    open.extend(next.collect::<Vec<_>>());
                }
                false
            };
            for frame in floor.passframes() {
                let wanted = if !reaches_a_door(frame.id) {
                    PassframeKind::Closed
                } else if at_door(frame) {
                    PassframeKind::Boundary
                } else if frame.neighbours().count() <= 1 {
                    PassframeKind::DeadEnd
                } else {
                    PassframeKind::Passage
                };
                assert_eq!(frame.kind, wanted, "seed {seed}: {}", frame.id);
                *seen.entry(frame.kind).or_default() += 1;
            }
        }
    }
    assert!(seen.len() == 4 && seen.values().all(|&n| n > 10), "{seen:?}");
}

#[test]
fn ids_last_where_nothing_changed() {
    let (mut kept, mut all) = (0, 0);
    for seed in 0..40 {
        let mut b = random_world(seed);
        let before = build(&b.world);
        let mut random = Random(seed + 5);
        let ids: Vec<ReplicaId> = b.world.replicas.keys().copied().collect();
        let id = ids[(random.unit() * ids.len() as f64) as usize];
        let replica = b.world.replicas.get_mut(&id).unwrap();
        let (frame, area) = (replica.frame, replica.area);
        replica.frame = Frame::new(frame.x.get() + 6.0, frame.y.get() + 3.0, 0.0, frame.angle);
        let after = build(&b.world);
        let places: Vec<Bounds> =
            [&before, &after].iter().map(|plan| plan.scene().replicas[&id].bounds).collect();
        let later: BTreeMap<PassframeId, &Passframe> =
            after.passframes(area).iter().map(|f| (f.id, f)).collect();
        for frame in before.passframes(area) {
            let same = after.passframes(area).iter().find(|f| f.polygon == frame.polygon);
            if let Some(same) = same {
                assert_eq!(same.id, frame.id, "seed {seed}: what lasts keeps its id");
            }
            // A Passframe that does not come near the thing has no reason to change.
            let bounds = frame.polygon.bounds().grown(2.0 * before.reach());
            if !places.iter().any(|p| p.meets(&bounds)) {
                all += 1;
                kept +=
                    usize::from(later.get(&frame.id).is_some_and(|f| f.polygon == frame.polygon));
            }
        }
    }
    eprintln!("{kept} of {all} Passframes away from what moved kept their ids");
    assert!(all > 50 && kept * 10 >= all * 9, "{kept} of {all}");
}

/// Among hundreds of Passframes short ids would meet, and one that comes would take another's.
#[test]
fn ids_last_in_a_crowded_hall() {
    let mut b = Builder::new();
    let hall = b.area("Зал", &rectangle(4000.0, 3000.0), Frame::IDENTITY, &[]);
    let mut random = Random(3);
    for _ in 0..300 {
        let (x, y) = (random.between(50.0, 3900.0), random.between(50.0, 2900.0));
        b.put(hall, x, y, 30.0, 30.0, random.between(0.0, 90.0), 80.0);
    }
    let mut plan = build(&b.world);
    let ids: Vec<ReplicaId> = b.world.replicas.keys().copied().collect();
    let (mut ever, mut lasted) = (BTreeMap::<Vec<[u64; 2]>, PassframeId>::new(), 0);
    for step in 0..40 {
        for frame in plan.passframes(hall) {
            let place = frame.polygon.corners.iter().map(|c| [c.x.to_bits(), c.y.to_bits()]);
            let first = *ever.entry(place.collect()).or_insert(frame.id);
            assert_eq!(first, frame.id, "step {step}");
        }
        lasted = ever.len();
        let moved = ids[(random.unit() * ids.len() as f64) as usize];
        let replica = b.world.replicas.get_mut(&moved).unwrap();
        let (x, y) = (random.between(50.0, 3900.0), random.between(50.0, 2900.0));
        replica.frame = Frame::new(x, y, 0.0, replica.frame.angle);
        plan.rebuild(&b.world, &[moved]);
    }
    let distinct: BTreeSet<PassframeId> = ever.values().copied().collect();
    assert!(lasted > 900 && distinct.len() == lasted, "{} ids of {lasted}", distinct.len());
}

/// Everything about a floor that can be asked, for two that must be the same.
fn assert_same(one: &FloorPlan, other: &FloorPlan, what: &str) {
    assert_eq!(one.fragments().len(), other.fragments().len());
    for (a, b) in one.fragments().zip(other.fragments()) {
        assert!(a == b, "{what}: Area {:?}", a.area);
        assert_eq!(a.passframes(), b.passframes(), "{what}: Area {:?}", a.area);
    }
    assert_eq!(one.open_doorways(), other.open_doorways());
}

#[test]
fn kept_floors_are_those_that_building_anew_gives() {
    let (mut reused, mut built) = (0, 0);
    for seed in 0..21 {
        let mut b = random_world(seed);
        let states = DoorStates::new();
        let bytes = build(&b.world).save(&b.world);
        let restore = |world: &World, bytes: &[u8]| {
            FloorPlan::restore(
                world,
                &Openings::of(world, STEP_REACH),
                MapId(1),
                &world.robot,
                &states,
                bytes,
            )
        };
        let (same, fresh) = restore(&b.world, &bytes);
        assert_eq!(fresh, 0, "nothing changed");
        assert_same(&same, &build(&b.world), "untouched");
        assert_eq!(same.save(&b.world), bytes);
        // One thing or another of all that a floor is made from.
        let mut random = Random(seed + 9);
        let ids: Vec<ReplicaId> = b.world.replicas.keys().copied().collect();
        let id = ids[(random.unit() * ids.len() as f64) as usize];
        match seed % 7 {
            0 => {
                let replica = b.world.replicas.get_mut(&id).unwrap();
                let x = replica.frame.x.get() + random.between(-60.0, 60.0);
                replica.frame = Frame::new(x, replica.frame.y.get(), 0.0, Deg::of(20.0));
            }
            1 => b.world.doors.values_mut().for_each(|d| d.state = DoorState::CLOSED),
            2 => b.world.robot.radius = Cm::of(17.5),
            3 => drop(b.world.replicas.remove(&id)),
            4 => {
                let object = b.world.replicas[&id].object;
                let item = b.world.objects[&object].items[0].orthoframe;
                b.world.orthoframes.get_mut(&item).unwrap().base[0].names.push("ручка".into());
            }
            5 => b.world.doors.values_mut().for_each(|d| d.height = Cm::of(90.0)),
            _ => {
                let object = b.world.replicas[&id].object;
                let item = b.world.objects[&object].items[0].orthoframe;
                b.world.orthoframes.get_mut(&item).unwrap().height = Cm::of(1.0);
            }
        }
        let (after, fresh) = restore(&b.world, &bytes);
        assert_same(&after, &build(&b.world), &format!("seed {seed}"));
        built += fresh;
        reused += after.fragments().len() - fresh;
    }
    assert!(built > 15 && reused > 5, "{built} built, {reused} reused");
}

#[test]
fn bytes_that_are_no_floor_are_not_taken_for_one() {
    let world = random_world(3).world;
    let bytes = build(&world).save(&world);
    let states = DoorStates::new();
    let mut random = Random(1);
    for k in 0..60 {
        let mut spoiled = bytes.clone();
        match k % 3 {
            0 => spoiled.truncate((random.unit() * bytes.len() as f64) as usize),
            1 => {
                let at = (random.unit() * bytes.len() as f64) as usize;
                spoiled[at] ^= 1 << (k % 8);
            }
            _ => {
                let at = (random.unit() * (bytes.len() - 8) as f64) as usize;
                spoiled[at..at + 8].fill(0xff);
            }
        }
        // It may be read or not; it does not end the program, nor take all memory.
        let (plan, _) = FloorPlan::restore(
            &world,
            &Openings::of(&world, STEP_REACH),
            MapId(1),
            &world.robot,
            &states,
            &spoiled,
        );
        assert_eq!(plan.fragments().len(), 2);
    }
}

/// Behind a leaf that stands ajar the robot can poke its nose in and no more: that is no way into the room.
#[test]
fn a_wedge_behind_a_leaf_that_stands_ajar_opens_no_doorway() {
    let mut wedges = 0;
    for (gap, opening) in [0.0, 12.0, 30.0]
        .into_iter()
        .flat_map(|gap| (0..=10).map(move |tenth| (gap, f64::from(tenth) * 10.0)))
    {
        let state = DoorState { status: DoorStatus::Open, opening };
        let (b, one, _, door) = two_rooms(gap, DoorKind::Hinged, state);
        let plan = build(&b.world);
        let door = b.world.doors.get(&door);
        let is_open = plan.doorways()[0].clear_width(door, state) >= 50.0;
        assert_eq!(plan.open_doorways().len(), usize::from(is_open), "{gap} cm, {opening} %");
        assert_eq!(plan.are_joined(p(100., 150.), p(700., 150.)), is_open);
        let room = plan.fragment(one).unwrap();
        let on_line = |y: i32| room.fits(p(400.0 + gap / 2.0, f64::from(y)));
        wedges += usize::from(!is_open && (100..190).any(on_line));
    }
    assert!(wedges > 3, "{wedges}");
}

/// A threshold that is less deep than the robot leads through all the same.
#[test]
fn a_threshold_less_deep_than_the_robot_is_an_open_doorway_on_both_sides() {
    for depth in [5.0, 20.0, 60.0] {
        let mut b = Builder::new();
        let side = |x: f64| [p(0., 0.), p(x, 0.), p(x, 300.), p(0., 300.)];
        let one = b.area("Один", &side(300.), Frame::IDENTITY, &[(1, Opening::Passage)]);
        let at = |x: f64| Frame::new(x, 0., 0., Deg::ZERO);
        let both = [(1, Opening::Passage), (3, Opening::Passage)];
        let mid = b.area("Порог", &side(depth), at(300.), &both);
        let two = b.area("Два", &side(300.), at(300. + depth), &[(3, Opening::Passage)]);
        b.link(one, 1, mid, 3);
        b.link(mid, 1, two, 3);
        assert_eq!(build(&b.world).open_doorways().len(), 2, "{depth}");
    }
}
