//! What is said to open a way opens it (W5): the change is made as it was said, and the floor built anew.

use orthoframe::geometry::*;
use orthoframe::map::*;
use orthoframe::units::*;

use crate::floor_properties::{Random, random_world};
use crate::floors::{Builder, p, two_rooms};

fn build(world: &World) -> FloorPlan {
    FloorPlan::build(world, MapId(1), &world.robot, &DoorStates::new())
}

/// Two rooms with much in them, the door shut in some, a row of things barring the way in others.
fn barred(seed: u64) -> Builder {
    let mut b = random_world(seed);
    let mut random = Random(seed + 77);
    let area = *b.world.areas.keys().next().expect("the first room");
    if random.unit() < 0.7 {
        // From wall to wall, with gaps too narrow.
        let x = random.between(120.0, 260.0);
        let mut y = random.between(0.0, 20.0);
        while y < 270.0 {
            let depth = random.between(40.0, 90.0);
            b.put(area, x, y, 30.0, depth.min(298.0 - y), 0.0, 100.0);
            y += depth + random.between(8.0, 2.0 * b.world.robot.radius.get() - 2.0);
        }
    }
    if random.unit() < 0.5 {
        b.world.doors.values_mut().for_each(|d| d.state = DoorState::CLOSED);
    }
    for replica in b.world.replicas.values_mut() {
        replica.move_prob = if random.unit() < 0.8 { 60 } else { 0 };
    }
    b
}

fn make(world: &mut World, remedy: &Remedy) {
    let (Remedy::Open(doors)
    | Remedy::Move { open: doors, .. }
    | Remedy::Shut { open: doors, .. }
    | Remedy::Remove { open: doors, .. }) = remedy;
    for door in doors {
        world.doors.get_mut(door).expect("a door of this world").state = DoorState::OPEN;
    }
    match remedy {
        Remedy::Open(_) => {}
        Remedy::Move { replica, by, .. } => {
            let replica = world.replicas.get_mut(replica).expect("a thing of this world");
            assert!(replica.move_prob > 0, "what never moves is not to be pushed");
            let frame = replica.frame;
            // The rooms of these worlds are not turned, so a push is the same in each frame.
            replica.frame =
                Frame::new(frame.x.get() + by.x, frame.y.get() + by.y, frame.z.get(), frame.angle);
        }
        Remedy::Shut { door, of: None, .. } => {
            world.doors.get_mut(door).expect("a door of this world").state = DoorState::CLOSED;
        }
        Remedy::Shut { door, of: Some(replica), .. } => {
            let thing = world.replicas.get_mut(replica).expect("a thing of this world");
            thing.door_states.insert(*door, DoorState::CLOSED);
        }
        Remedy::Remove { replicas, .. } => {
            for id in replicas {
                let gone = world.replicas.remove(id).expect("a thing of this world");
                assert!(gone.move_prob > 0, "what never moves is not to be taken away");
            }
        }
    }
}

#[test]
fn every_change_that_is_named_opens_the_way() {
    let (mut opened, mut pushed, mut both, mut cleared) = (0, 0, 0, 0);
    for seed in 0..14 {
        let b = barred(seed);
        let plan = build(&b.world);
        let (from, target) = (p(40.0, 150.0), Target::Point(p(770.0, 150.0)));
        let Err(no) = plan.route(&b.world, from, target, Method::Shortest) else { continue };
        let Some(remedy) = plan.remedy(&b.world, from, target, &no) else { continue };
        match &remedy {
            Remedy::Open(_) => opened += 1,
            Remedy::Move { open, .. } if open.is_empty() => pushed += 1,
            Remedy::Move { .. } => both += 1,
            Remedy::Shut { .. } | Remedy::Remove { .. } => cleared += 1,
        }
        let mut changed = b.world.clone();
        make(&mut changed, &remedy);
        let way = build(&changed).route(&changed, from, target, Method::Shortest);
        assert!(way.is_ok(), "seed {seed}: {remedy:?} of {no}: {}", way.unwrap_err());
        // Nor does less do: half of the push, or all doors but one.
        if let Remedy::Open(doors) = &remedy {
            for k in 0..doors.len() {
                let mut fewer = doors.clone();
                fewer.remove(k);
                let mut changed = b.world.clone();
                make(&mut changed, &Remedy::Open(fewer));
                let way = build(&changed).route(&changed, from, target, Method::Shortest);
                assert!(way.is_err(), "seed {seed}: not all of {doors:?} are needed");
            }
        }
    }
    eprintln!("{opened} doors, {pushed} pushes, {both} both, {cleared} cleared");
    assert!(opened + pushed + both > 2, "{opened} {pushed} {both}");
}

/// A chest stands where the leaf swings: told to open the door, the robot got it no further than the chest. What opens
/// the way is the door and the chest out of its way.
#[test]
fn a_door_that_strikes_a_thing_is_not_all_that_is_asked_for() {
    let (mut b, one, _, door) = two_rooms(10.0, DoorKind::Hinged, DoorState::CLOSED);
    b.put(one, 320.0, 130.0, 50.0, 50.0, 0.0, 90.0);
    b.world.replicas.values_mut().for_each(|r| r.move_prob = 60);
    let plan = build(&b.world);
    let (from, target) = (p(40.0, 250.0), Target::Point(p(600.0, 150.0)));
    let no = plan.route(&b.world, from, target, Method::Shortest).expect_err("it is shut");
    let remedy = plan.remedy(&b.world, from, target, &no).expect("the chest moves");
    let (open, chest) = match &remedy {
        Remedy::Move { open, replica, .. } => (open, *replica),
        Remedy::Remove { open, replicas } => (open, replicas[0]),
        other => panic!("{other:?}"),
    };
    assert_eq!((open, chest), (&vec![door], *b.world.replicas.keys().next().expect("the chest")));
    let mut changed = b.world.clone();
    let after = plan.remedied(&mut changed, &remedy);
    assert!(after.route(&changed, from, target, Method::Shortest).is_ok(), "{remedy:?}");
}
