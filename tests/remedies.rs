//! What is said to open a way opens it (W5): the change is made as it was said, and the floor built anew.

use orthoframe_geometry::*;
use orthoframe_map::*;
use orthoframe_units::*;

use crate::floor_properties::{Random, random_world};
use crate::floors::{Builder, Opening, p, rectangle, two_rooms};

/// As far as the program's own rules let a thing be pushed, cm.
pub(crate) const FARTHEST: f64 = 120.0;

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
        let Some(remedy) = plan.remedy(&b.world, from, target, &no, FARTHEST) else { continue };
        match &remedy {
            Remedy::Open(_) => opened += 1,
            Remedy::Move { open, .. } if open.is_empty() => pushed += 1,
            Remedy::Move { .. } => both += 1,
            Remedy::Shut { .. } | Remedy::Remove { .. } => cleared += 1,
        }
        let mut changed = b.world.clone();
        make(&mut changed, &remedy);
        let way = build(&changed).route(&changed, from, target, Method::Shortest);
        assert!(way.is_ok(), "seed {seed}: {remedy:?} of {no:?}: {:?}", way.unwrap_err());
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
    let remedy = plan.remedy(&b.world, from, target, &no, FARTHEST).expect("the chest moves");
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

/// Whether a thing stands on the floor of its room and in nothing else, looked at anew.
fn has_room(b: &Builder, id: ReplicaId) -> bool {
    let scene = Scene::of(&b.world, MapId(1));
    let own = &scene.replicas[&id];
    let base = &scene.areas[&own.area].prisms;
    let apart = |p: &Polygon, q: &Polygon| {
        let separates = |p: &Polygon, q: &Polygon| {
            p.edges().any(|(u, v)| {
                let out = Vector::new(v.y - u.y, u.x - v.x);
                q.corners.iter().all(|c| (c - u).dot(&out) > 1e-9)
            })
        };
        separates(p, q) || separates(q, p)
    };
    own.prisms.iter().all(|prism| {
        prism.polygon.corners.iter().all(|&c| base.iter().any(|f| f.polygon.contains(c, 1e-6)))
            && scene
                .replicas
                .values()
                .filter(|r| r.id != id && r.area == own.area)
                .all(|other| other.prisms.iter().all(|q| apart(&prism.polygon, &q.polygon)))
    })
}

/// The least push in centimetres, of any thing that may move, that lets the robot from one place to the other: all
/// are tried, as far as `most`.
fn least_push(b: &Builder, from: Point, to: Point, most: f64) -> Option<(ReplicaId, Vector)> {
    let mut trial = Builder::new();
    trial.world = b.world.clone();
    let mut plan = build(&b.world);
    let mut stopped = std::collections::BTreeSet::new();
    for step in 1..=(most as usize) {
        for (&id, replica) in &b.world.replicas {
            if replica.move_prob == 0 {
                continue;
            }
            for turn in 0..16 {
                let (sin, cos) = (std::f64::consts::PI * f64::from(turn) / 8.0).sin_cos();
                let by = Vector::new(cos, sin) * step as f64;
                let home = replica.frame;
                trial.world.replicas.get_mut(&id).unwrap().frame =
                    Frame::new(home.x.get() + by.x, home.y.get() + by.y, 0.0, home.angle);
                if !has_room(&trial, id) {
                    stopped.insert((id, turn));
                } else if !stopped.contains(&(id, turn)) {
                    plan.rebuild(&trial.world, &[id]);
                    if plan.are_joined(from, to) {
                        return Some((id, by));
                    }
                }
                trial.world.replicas.get_mut(&id).unwrap().frame = home;
            }
            plan.rebuild(&trial.world, &[id]);
        }
    }
    None
}

/// Two rooms joined by two open passages, things in and before them, all movable.
fn cluttered(seed: u64) -> Builder {
    let mut b = Builder::new();
    let mut random = Random(seed + 900);
    let side = |x: f64| {
        [(x, 0.), (x, 60.), (x, 150.), (x, 250.), (x, 340.), (x, 400.)]
            .map(|(x, y)| p(x, y))
            .to_vec()
    };
    let mut left = vec![p(0., 0.)];
    left.extend(side(300.));
    left.push(p(0., 400.));
    let mut right = vec![p(300., 400.)];
    right.extend(side(0.).into_iter().rev());
    right.push(p(300., 0.));
    let one =
        b.area("Один", &left, Frame::IDENTITY, &[(2, Opening::Passage), (4, Opening::Passage)]);
    let frame = Frame::new(310., 0., 0., Deg::ZERO);
    let two = b.area("Два", &right, frame, &[(2, Opening::Passage), (4, Opening::Passage)]);
    b.link(one, 2, two, 4);
    b.link(one, 4, two, 2);
    let radius = 22.0;
    b.world.robot.radius = Cm::of(radius);
    for y in [105.0, 295.0] {
        let free = random.between(10.0, 40.0);
        let d = 80.0 - free;
        let x = random.between(255.0, 290.0);
        let low = y - 45.0 + random.between(0.0, free / 2.0);
        let id = b.put(one, x.min(300.0 - 15.0), low, 12.0, d, 0.0, 100.0);
        b.world.replicas.get_mut(&id).unwrap().move_prob = 60;
        if random.unit() < 0.5 {
            let (x, y) = (random.between(20., 80.), y - random.between(0.0, 40.0));
            let id = b.put(
                two,
                x,
                y,
                random.between(10.0, 40.0),
                random.between(10.0, 60.0),
                0.0,
                100.0,
            );
            b.world.replicas.get_mut(&id).unwrap().move_prob = 60;
        }
    }
    b
}

/// A row of things from wall to wall with gaps of many widths.
fn row(seed: u64) -> Builder {
    let mut b = Builder::new();
    let mut random = Random(seed + 300);
    let hall = b.area("Зал", &rectangle(500.0, 400.0), Frame::IDENTITY, &[]);
    b.world.robot.radius = Cm::of(22.0);
    let mut y = random.between(0.0, 30.0);
    while y < 380.0 {
        let depth = random.between(25.0, 80.0).min(399.0 - y);
        let x = 230.0 + random.between(-30.0, 30.0);
        let turn = if random.unit() < 0.3 { random.between(-20.0, 20.0) } else { 0.0 };
        let id = b.put(hall, x, y, 40.0, depth, turn, 100.0);
        b.world.replicas.get_mut(&id).unwrap().move_prob = if random.unit() < 0.8 { 60 } else { 0 };
        y += depth + random.between(6.0, 43.0);
    }
    b
}

#[test]
fn no_push_is_shorter_than_the_one_named() {
    let mut tried = 0;
    for seed in 0..14 {
        let (b, to) =
            if seed < 8 { (cluttered(seed), p(560., 200.)) } else { (row(seed), p(440., 200.)) };
        let plan = build(&b.world);
        let (from, target) = (p(60., 200.), Target::Point(to));
        let Err(no) = plan.route(&b.world, from, target, Method::Shortest) else { continue };
        let remedy = plan.remedy(&b.world, from, target, &no, FARTHEST);
        let Some(Remedy::Move { by, .. }) = &remedy else {
            panic!("seed {seed}: {remedy:?} {no:?}")
        };
        // The longer the push, the longer all shorter ones take.
        if by.norm() < 9.5 {
            tried += 1;
            let less = least_push(&b, from, to, by.norm() - 0.5);
            assert_eq!(less, None, "seed {seed}: {remedy:?} of {no:?}");
        }
    }
    assert!(tried > 5, "{tried}");
}

/// What is told of a gap is what would let the robot through were it so much thinner: the widest of all gaps.
#[test]
fn the_gap_that_is_told_is_the_widest() {
    let mut told = 0;
    // The latter ones have a wider way over a pocket, or over several.
    for seed in (0..30).chain([131, 165, 254, 296, 386, 584]) {
        let (mut b, from, to) = match seed % 3 {
            0 => (cluttered(seed), p(60., 200.), p(560., 200.)),
            1 => (row(seed), p(60., 200.), p(440., 200.)),
            _ => (barred(seed), p(40., 150.), p(770., 150.)),
        };
        b.world.doors.values_mut().for_each(|d| d.state = DoorState::OPEN);
        b.world.replicas.values_mut().for_each(|r| r.move_prob = 60);
        let plan = build(&b.world);
        let (Some(from), Some(to)) = (plan.standing_at(from), plan.standing_at(to)) else {
            continue;
        };
        let target = Target::Point(to);
        let Err(no) = plan.route(&b.world, from, target, Method::Shortest) else { continue };
        let gap = |barrier: &Barrier| match barrier {
            Barrier::Gap { width, needed, .. } => {
                assert!((needed - plan.robot().passing_width()).abs() < 1e-9);
                Some(*width)
            }
            _ => None,
        };
        let Some(gaps) = no.barriers().iter().map(gap).collect::<Option<Vec<f64>>>() else {
            continue;
        };
        let width = gaps.into_iter().fold(f64::INFINITY, f64::min);
        let (mut low, mut high) = (0.5, b.world.robot.radius.get());
        while high - low > 0.02 {
            let radius = f64::midpoint(low, high);
            b.world.robot.radius = Cm::of(radius);
            *(if build(&b.world).are_joined(from, to) { &mut low } else { &mut high }) = radius;
        }
        told += 1;
        assert!((width - 2.0 * low).abs() < 0.1, "seed {seed}: {no:?}, and {} passes", 2.0 * low);
    }
    assert!(told > 24, "{told}");
}
