//! `ortho differences`, `map-from`, `draw sight`: what scans of a world that differs say against the map, and what is kept of it.

use std::fmt::Write as _;

use orthoframe_geometry::{DoorStates, FloorPlan};
use orthoframe_map::{DoorState, DoorStatus, World};
use orthoframe_units::{Deg, Frame, Point, Pose, ReplicaId};

use super::Place;
use crate::files::project;

fn rb2() -> World {
    World::load(project("maps/rb2.toml")).expect("the sample map")
}

/// What a laser at 30 cm brings of a world from poses all over its floor, on a way whose odometry is exact and began elsewhere.
fn log(truth: &World, seed: u64, scans: usize) -> String {
    let map = *truth.maps.keys().next().expect("it has a map");
    let plan = FloorPlan::build(truth, map, &truth.robot, &DoorStates::new());
    let sight = plan.sight(truth, 30.0);
    let mut random = fastrand::Rng::with_seed(seed);
    let (mut text, mut count) = (String::new(), 0);
    while count < scans {
        let at = Point::new(random.f64() * 1000.0, random.f64() * 900.0);
        if !plan.fragments().any(|floor| floor.fits(at)) {
            continue;
        }
        count += 1;
        let degrees = random.f64() * 360.0;
        let heading = Deg::new(degrees).expect("a number");
        let beams = sight.scan(Pose { at, heading }, 180.0, 361, 8000.0);
        text.push_str("FLASER 361");
        for beam in beams {
            let noise = (random.f64() + random.f64() - 1.0) * 1.5;
            let _ = write!(text, " {:.3}", (beam.distance + noise) / 100.0);
        }
        let turn = degrees.to_radians();
        let (x, y) = (at.x / 100.0, at.y / 100.0);
        let _ = writeln!(text, " {x} {y} {turn} {} {} {turn} 1 host 1", x + 7.0, y - 3.0);
    }
    text
}

#[test]
fn what_differs_is_told_kept_and_proposed_and_the_map_stays() {
    let place = Place::with_rb2();
    let map = rb2();
    let mut truth = map.clone();
    let gone = map.replicas.values().find(|thing| thing.name == "Стул-5").expect("a chair");
    truth.replicas.remove(&gone.id);
    // Where Room V is empty stands what the map does not have: of another kind than what is gone.
    let kind = map.replicas.values().find(|thing| thing.name.starts_with("Тумбочка"));
    let room = map.areas.values().find(|area| area.name == "Комната-В").expect("a room");
    let mut new = kind.expect("a cabinet").clone();
    (new.id, new.name, new.area) = (ReplicaId(90_000), "Нечто".to_owned(), room.id);
    new.frame = Frame::new(250.0, 200.0, 0.0, Deg::of(20.0));
    truth.replicas.insert(new.id, new);
    let door = map.doors.values().find(|door| door.name == "Дверь-ВZ").expect("a door");
    truth.doors.get_mut(&door.id).expect("the same").state =
        if door.state.status == DoorStatus::Open { DoorState::CLOSED } else { DoorState::OPEN };
    place.write("drive.log", log(&truth, 3, 40));

    let before = place.json(&["export", "before.toml"], 0);
    assert_eq!(before["outcome"], "exported");
    let seen = place.json(&["differences", "drive.log", "--posed", "--keep"], 0);
    assert!(seen["held"].as_u64() >= Some(30), "{seen}");
    let things = seen["things"].as_array().unwrap();
    let differs: Vec<_> = things.iter().filter(|thing| thing["seen"] != "there").collect();
    assert_eq!(differs.len(), 1, "{differs:?}");
    assert_eq!((&differs[0]["thing"], &differs[0]["seen"]), (&"Стул-5".into(), &"missed".into()));
    let doors = seen["doors"].as_array().unwrap();
    let changed: Vec<_> = doors.iter().filter(|door| door["as_mapped"] == false).collect();
    assert_eq!(changed.len(), 1, "{changed:?}");
    assert_eq!(changed[0]["door"], "Дверь-ВZ");
    assert!(!seen["obstacles"].as_array().unwrap().is_empty(), "{seen}");

    let told = place.run(&["ask", "Что изменилось?"]).is(0).out;
    assert!(told.contains("Стула-5 на месте нет"), "{told}");
    assert!(told.contains("Дверь-ВZ закрыта") || told.contains("Дверь-ВZ открыта"), "{told}");
    assert!(told.contains("Препятствие-1"), "{told}");
    let told = place.run(&["ask", "What has changed?"]).is(0).out;
    assert!(told.contains("Door VZ") && told.contains("Obstacle 1"), "{told}");
    let told = place.run(&["ask", "How sure are you where you are?"]).is(0).out;
    assert!(told.contains("within") && told.contains("cm"), "{told}");
    let told = place.run(&["ask", "Что ты ещё не видел?"]).is(0).out;
    assert!(told.contains("Я ещё не видел"), "{told}");

    // The map is as it was.
    place.json(&["export", "after.toml"], 0);
    let file = |name| std::fs::read(place.path(name)).unwrap();
    assert_eq!(file("before.toml"), file("after.toml"));
    // Seen again as the map has it, all of that is forgotten.
    place.write("again.log", log(&map, 4, 40));
    place.json(&["differences", "again.log", "--posed", "--keep"], 0);
    let told = place.run(&["ask", "Что изменилось?"]).is(1).out;
    assert!(told.contains("всё так, как на карте"), "{told}");
}

#[test]
fn a_map_is_made_of_a_log_and_passes_the_check() {
    let place = Place::with_rb2();
    place.write("drive.log", log(&rb2(), 5, 60));
    let made = place.json(&["map-from", "drive.log", "--out", "made.toml"], 0);
    assert!(made["rooms"].as_u64() >= Some(3), "{made}");
    place.run(&["check", "made.toml"]).is(0);
    let plain = place.run(&["map-from", "drive.log"]).is(0).out;
    assert!(plain.contains("format"), "{plain:.200}");
    // Without poses there is no map.
    place.write("loose.log", "FLASER 3 1.0 1.0 1.0\n");
    place.run(&["map-from", "loose.log"]).is(2);
}

#[test]
fn the_seen_floor_is_drawn_beside_the_map() {
    let place = Place::with_rb2();
    place.write("drive.log", log(&rb2(), 6, 3));
    let drawn = place.run(&["draw", "sight", "drive.log", "--posed"]).is(0).out;
    assert!(drawn.starts_with("<svg") && drawn.matches("<svg").count() == 3, "{drawn:.300}");
    assert!(drawn.contains("Оперативная модель") && drawn.contains("Граница видимости"));
    place.run(&["draw", "sight", "drive.log", "--scan", "9"]).is(2);
}
