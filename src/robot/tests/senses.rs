//! A robot that knows its world by its senses alone: what they tell, and where it believes itself to be (X4).

#![allow(clippy::print_stdout, reason = "figures for benches/README.md")]

use std::io::{BufRead, BufReader, Write, pipe};
use std::ops::ControlFlow;
use std::thread;

use orthoframe_geometry::{FloorPlan, Method, Target};
use orthoframe_map::{DoorState, Entity, Format, World};
use orthoframe_robot::*;
use orthoframe_units::{Deg, Language, MapId, Point, Pose, Source, Stop};

use super::setting::{Setting, example, fact, floors};

/// A robot in a truth, at the start of its Map.
fn robot(truth: &World, senses: Senses) -> SensingRobot {
    let (map, pose) = starting_pose(truth).expect("the map says where it starts");
    SensingRobot::new(Simulator::new(truth.clone(), map, pose), senses)
}

/// How far a pilot's word is from the truth: cm and degrees.
fn off(pilot: (MapId, Pose), truly: (MapId, Pose)) -> (f64, f64) {
    assert_eq!(pilot.0, truly.0, "on another storey");
    ((pilot.1.at - truly.1.at).norm(), (pilot.1.heading - truly.1.heading).signed().abs())
}

/// Drives along the shortest way between named places.
fn way(world: &World, floor: &FloorPlan, from: Point, to: &str) -> (Vec<Point>, Option<Deg>) {
    let place = world.find(to).into_iter().find_map(|entity| match entity {
        Entity::Place(id) => Some(id),
        _ => None,
    });
    let target = Target::Place(place.expect("the map has this place"));
    let route = floor.route(world, from, target, Method::Shortest).expect("there is a way");
    (route.points, route.heading)
}

#[test]
fn a_laser_sees_what_is_there_and_errs_as_told() {
    let world = example("rb2");
    let exact = Senses { noise: 0.0, dropouts: 0.0, slip: 0.0, ..Senses::of_seed(1) };
    let look = |senses: Senses| {
        let mut robot = robot(&world, senses);
        let mut scans = Vec::new();
        let mut hear = |notice: &Notice| {
            if let Notice::Scanned(scan) = notice {
                scans.push(scan.clone());
            }
            ControlFlow::Continue(())
        };
        robot.look_round(&mut Watch::new(Stop::new(), &mut hear)).unwrap();
        scans
    };
    let truth = look(exact);
    assert!(truth.len() >= 4 && truth.windows(2).all(|pair| pair[0] == pair[1]), "it stands still");
    // The same eye by geometry's own views, made of the free floor and its faces.
    let (map, pose) = starting_pose(&world).unwrap();
    let sight = floors(&world)[&map].sight(&world, exact.height);
    let mut differing = 0;
    for (beam, range) in truth[0].ranges.iter().enumerate() {
        let bearing = (pose.heading + Deg::of(beam as f64)).radians();
        let other = sight.beam(pose.at, bearing, exact.reach);
        let met = other.face.map(|_| other.distance);
        let same = match (range, met) {
            (Some(a), Some(b)) => (a - b).abs() < 1.0,
            (None, None) => true,
            _ => false,
        };
        differing += usize::from(!same);
    }
    assert!(differing <= 3, "{differing} of 360 beams see otherwise than the views do");
    let noisy = look(Senses { noise: 2.0, dropouts: 0.05, ..exact });
    let (mut squares, mut count, mut lost) = (0.0, 0, 0);
    for scan in &noisy {
        for (range, exact) in scan.ranges.iter().zip(&truth[0].ranges) {
            match (range, exact) {
                (Some(range), Some(exact)) => {
                    squares += (range - exact).powi(2);
                    count += 1;
                }
                (None, Some(_)) => lost += 1,
                _ => {}
            }
        }
    }
    let deviation = (squares / f64::from(count)).sqrt();
    assert!((1.8..2.2).contains(&deviation), "{deviation}");
    let share = f64::from(lost) / f64::from(lost + count);
    assert!((0.035..0.065).contains(&share), "{share}");
    assert_eq!(look(Senses::of_seed(3)), look(Senses::of_seed(3)));
    assert_ne!(look(Senses::of_seed(3)), look(Senses::of_seed(4)));
}

/// Ways between the places of the flat: by its wheels alone the robot is lost, by its laser it is where it believes.
#[test]
fn a_pilot_knows_where_it_is_though_its_wheels_slip() {
    let world = example("rb2");
    let floors = floors(&world);
    let places: Vec<String> = world.places.values().map(|place| place.name.clone()).collect();
    let seeds = if std::env::var_os("ORTHOFRAME_LONG").is_some() { 40 } else { 3 };
    let (mut worst, mut wheels, mut contacts, mut ways): (f64, f64, usize, usize) =
        (0.0, 0.0, 0, 0);
    for seed in 0..seeds {
        let mut body = robot(&world, Senses::of_seed(seed));
        let start = starting_pose(&world).unwrap();
        let ground = Ground::of(&world, &floors, 20.0);
        let finders = ground.finders();
        {
            let mut pilot = Pilot::new(&ground, &finders, &mut body, start).unwrap();
            for round in 0..2 {
                for to in places.iter().skip(round).step_by(2) {
                    let (map, pose) = pilot.pose();
                    let (path, heading) = way(&world, &floors[&map], pose.at, to);
                    let driven = pilot.follow(&path, heading, &mut Watch::none());
                    assert!(driven.is_ok(), "seed {seed} to {to}: {driven:?}");
                    ways += 1;
                    let goal = path[path.len() - 1];
                    assert!((pilot.pose().1.at - goal).norm() < 6.0, "seed {seed} to {to}");
                }
            }
            let said = pilot.pose();
            drop(pilot);
            let (place, turn) = off(said, body.body().pose());
            assert!(place < 5.0 && turn < 3.0, "seed {seed}: {place} cm, {turn}°");
            worst = worst.max(place);
        }
        // Where its wheels hold it to be.
        let odometry = body.pose().1;
        let (sin, cos) = start.1.heading.radians().sin_cos();
        let by = odometry.at;
        let at =
            start.1.at + nalgebra::Vector2::new(by.x * cos - by.y * sin, by.x * sin + by.y * cos);
        wheels = wheels.max((at - body.body().pose().1.at).norm());
        contacts += body.touched().len();
    }
    println!(
        "{ways} ways: off by {worst:.1} cm at most, wheels by {wheels:.0} cm, {contacts} contacts"
    );
    assert!(wheels > 15.0, "the wheels are to slip: {wheels}");
}

/// A vehicle may tell of its way by scans alone: each counts where its own line says that it was taken.
#[test]
fn scans_alone_tell_of_the_way() {
    let world = example("rb2");
    let (orders, to_vehicle) = pipe().unwrap();
    let (said, says) = pipe().unwrap();
    let (heard, mut to_mission) = pipe().unwrap();
    let truth = world.clone();
    let vehicle = thread::spawn(move || {
        let mut body = robot(&truth, Senses::of_seed(5));
        serve(&mut body, "test", &truth, orders, says, &mut |_| {});
        body.body().pose()
    });
    thread::spawn(move || {
        let lines = BufReader::new(said).lines().map_while(Result::ok);
        for line in lines.filter(|line| !line.contains(r#""say":"going""#)) {
            if to_mission.write_all((line + "\n").as_bytes()).is_err() {
                return;
            }
        }
    });
    let floors = floors(&world);
    let ground = Ground::of(&world, &floors, 20.0);
    let finders = ground.finders();
    let said = {
        let mut remote =
            RemoteVehicle::over(heard, to_vehicle, &world, Patience::default()).unwrap();
        let start = starting_pose(&world).unwrap();
        let mut pilot = Pilot::new(&ground, &finders, &mut remote, start).unwrap();
        let (path, heading) = way(&world, &floors[&start.0], pilot.pose().1.at, "Точка-К");
        let driven = pilot.follow(&path, heading, &mut Watch::none());
        assert!(driven.is_ok(), "{driven:?}");
        pilot.pose()
    };
    let (place, turn) = off(said, vehicle.join().unwrap());
    assert!(place < 5.0 && turn < 3.0, "{place} cm, {turn}°");
}

/// Who tries a locked door knows that it is locked, though there is only to see that it is shut.
#[test]
fn a_lock_that_nobody_sees_leads_another_way() {
    let setting = Setting::of(example("rb2"));
    let mut truth = setting.world.clone();
    let door = truth.doors.values_mut().find(|door| door.name == "Дверь-ВZ").unwrap();
    door.state = DoorState::LOCKED;
    let (orders, to_vehicle) = pipe().unwrap();
    let (said, says) = pipe().unwrap();
    let (heard, mut to_mission) = pipe().unwrap();
    let (map, pose) = (setting.map, setting.pose);
    thread::spawn(move || {
        let mut body = Simulator::new(truth.clone(), map, pose);
        serve(&mut body, "test", &truth, orders, says, &mut |_| {});
    });
    thread::spawn(move || {
        for line in BufReader::new(said).lines().map_while(Result::ok) {
            let is_look = line.contains(r#""say":"seen""#);
            let line = if is_look { line.replace("locked", "closed") } else { line };
            if to_mission.write_all((line + "\n").as_bytes()).is_err() {
                return;
            }
        }
    });
    let mut remote =
        RemoteVehicle::over(heard, to_vehicle, &setting.world, Patience::default()).unwrap();
    let mut mission = setting.mission(setting.belief().unwrap());
    let goal = [fact("РОБОТ-НАХОДИТСЯ-В", "Комната-Z")];
    let ending = mission.run(&goal, &mut remote, &Stop::new(), &mut |_| {}).unwrap();
    assert!(matches!(ending, Ending::Done), "{ending:?}");
}

/// Somebody carries it off while it stands: it finds itself again, and says so.
#[test]
fn who_is_carried_off_finds_itself_again() {
    let world = example("rb2");
    let floors = floors(&world);
    let ground = Ground::of(&world, &floors, 20.0);
    let finders = ground.finders();
    let start = starting_pose(&world).unwrap();
    // It is believed to be at its start, and was set down elsewhere.
    let mut found = 0;
    let places: Vec<_> = world.places.values().collect();
    for place in &places {
        let (map, frame) = world.placement(place.area).unwrap();
        let truly = Pose { at: frame.apply(place.at), heading: Deg::of(35.0) };
        let mut body =
            SensingRobot::new(Simulator::new(world.clone(), map, truly), Senses::of_seed(9));
        let pilot = Pilot::new(&ground, &finders, &mut body, start);
        match pilot.map(|pilot| pilot.pose()) {
            Ok(said) => {
                let (off, turn) = off(said, body.body().pose());
                assert!(off < 10.0 && turn < 5.0, "{}: {off} cm, {turn}°", place.name);
                found += 1;
            }
            // That it does not know is no lie.
            Err(Failure::Nowhere { .. }) => {}
            Err(other) => panic!("{other}"),
        }
    }
    assert!(found * 2 > places.len(), "{found} of {}", places.len());
}

/// A bare hall, so long and so wide, with a robot in it at a place, cm.
fn hall(long: f64, wide: f64, at: [f64; 2]) -> World {
    let text = format!(
        r#"
format = 1
[robot]
radius = 25
height = 120
start = "Точка-А"
[type]
orthoframe = [{{ name = "Часть помещения", name_en = "part of a room" }}]
side = [{{ name = "Стена", name_en = "wall" }}]
area = [{{ name = "Зал", name_en = "hall" }}]
[orthoframe.hall]
name = "Зал"
type = "Часть помещения"
height = 300
sides = [
  {{ id = "A", from = [0, 0], to = [{long}, 0], type = "Стена" }},
  {{ id = "B", from = [{long}, 0], to = [{long}, {wide}], type = "Стена" }},
  {{ id = "C", from = [{long}, {wide}], to = [0, {wide}], type = "Стена" }},
  {{ id = "D", from = [0, {wide}], to = [0, 0], type = "Стена" }},
]
[area.hall]
name = "Зал"
type = "Зал"
items = [{{ id = "A", orthoframe = "hall" }}]
places = [{{ name = "Точка-А", at = {at:?}, heading = 20 }}]
[map.hall]
name = "Карта зала"
items = [{{ area = "hall" }}]
"#
    );
    World::parse(&Source::new("hall", &text), Format::Toml).expect("a hall is a sound map")
}

/// A robot that cannot know where it is says why it cannot.
#[test]
fn why_it_is_lost_is_told_truly() {
    let square = hall(400.0, 400.0, [130.0, 110.0]);
    let (corridor, its_end) =
        (hall(60_000.0, 300.0, [30_000.0, 110.0]), hall(6_000.0, 300.0, [130.0, 110.0]));
    let (large, house) = (hall(4_000.0, 3_000.0, [2_000.0, 1_500.0]), example("rb2"));
    let far = Senses::of_seed(4);
    for (map, truth, senses, said) in [
        (&square, &square, &far, "fits several places"),
        (&its_end, &its_end, &far, "fits several places"),
        (&corridor, &corridor, &far, "fits too many places"),
        (&large, &large, &far, "sees too little"),
        (&square, &house, &far, "fits nowhere"),
        (&house, &corridor, &far, "fits nowhere"),
    ] {
        let floors = floors(map);
        let ground = Ground::of(map, &floors, 20.0);
        let finders = ground.finders();
        let (storey, place) = starting_pose(map).unwrap();
        // It is not where it is believed to be.
        let believed = Pose { heading: place.heading + Deg::of(140.0), ..place };
        let mut body = robot(truth, senses.clone());
        let pilot = Pilot::new(&ground, &finders, &mut body, (storey, believed));
        let Some(Failure::Nowhere { why }) = pilot.err() else { panic!("{said}") };
        let told = why.say(Language::English);
        assert!(told.contains(said), "{told}, and not: {said}");
    }
}
