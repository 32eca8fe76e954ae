//! `ortho locate`: scans that the map's own faces give are found where they were taken, in words and as data.

use std::fmt::Write as _;

use orthoframe_geometry::{DoorStates, FloorPlan};
use orthoframe_map::World;
use orthoframe_units::{Deg, Point, Pose};

use super::Place;
use crate::files::project;

/// What a laser at 30 cm would bring of rb2 from these poses, with odometry that began elsewhere.
fn log(poses: &[(f64, f64, f64)]) -> String {
    let world = World::load(project("maps/rb2.toml")).expect("the sample map");
    let map = *world.maps.keys().next().expect("it has a map");
    let plan = FloorPlan::build(&world, map, &world.robot, &DoorStates::new());
    let sight = plan.sight(&world, 30.0);
    let mut text = String::new();
    for &(x, y, degrees) in poses {
        let heading = Deg::new(degrees).expect("a number");
        let beams = sight.scan(Pose { at: Point::new(x, y), heading }, 180.0, 361, 8000.0);
        text.push_str("FLASER 361");
        for beam in beams {
            let _ = write!(text, " {:.3}", beam.distance / 100.0);
        }
        let (at_x, at_y, turn) = (x / 100.0 + 7.0, y / 100.0 - 3.0, degrees.to_radians());
        let _ = writeln!(text, " 0 0 0 {at_x} {at_y} {turn} 1 host 1");
    }
    text
}

#[test]
fn scans_are_found_where_they_were_taken() {
    let place = Place::with_rb2();
    let poses = [(250.0, 200.0, 30.0), (260.0, 210.0, 40.0), (270.0, 220.0, 50.0)];
    place.write("drive.log", log(&poses));
    for arguments in [&["locate", "drive.log"][..], &["locate", "drive.log", "--follow"]] {
        let value = place.json(arguments, 0);
        let found = value["found"].as_array().unwrap();
        assert_eq!(found.len(), poses.len());
        for (found, (x, y, degrees)) in found.iter().zip(poses) {
            let fits = found["poses"].as_array().unwrap();
            let near = |fit: &serde_json::Value| {
                let number = |key: &str| fit["pose"][key].as_f64().unwrap();
                let turn = (number("heading_deg") - degrees + 180.0).rem_euclid(360.0) - 180.0;
                (number("x") - x).hypot(number("y") - y) < 5.0 && turn.abs() < 1.0
            };
            assert!(fits.iter().any(near), "{arguments:?}: {found}");
            assert!(found["found"] != "unique" || near(&fits[0]), "{arguments:?}: {found}");
        }
    }
    let told = place.run(&["locate", "drive.log", "--scan", "1"]).is(0);
    assert!(told.out.contains("Я нахожусь в "), "{}", told.out);
    place.run(&["locate", "drive.log", "--scan", "9"]).is(2);
}

/// Half a turn of so many beams, each as long as told, in cm.
fn half_turn(range: impl Fn(f64) -> f64) -> String {
    let mut text = String::from("FLASER 181");
    for beam in 0..181 {
        let _ = write!(text, " {:.3}", range(f64::from(beam - 90).to_radians()) / 100.0);
    }
    text + " 0 0 0 0 0 0 1 host 1\n"
}

/// A short piece of a wall straight ahead fits wherever there is one: too many places. A round room is nowhere on the map. A laser in fog sees
/// too little.
#[test]
fn a_scan_that_fits_too_many_places_is_told_apart_from_one_that_fits_nowhere() {
    let place = Place::with_rb2();
    let is_wall = |bearing: f64| bearing.abs() < 40_f64.to_radians();
    let wall = half_turn(|bearing| if is_wall(bearing) { 40.0 / bearing.cos() } else { 8190.0 });
    place.write("odd.log", wall + &half_turn(|_| 170.0) + &half_turn(|_| 8190.0));
    let found = place.json(&["locate", "odd.log"], 1)["found"].clone();
    let of = |scan: usize, key: &str| found[scan][key].clone();
    let kinds: Vec<_> = (0..3).map(|scan| of(scan, "found")).collect();
    assert_eq!(kinds, ["too_many", "nowhere", "too_little"], "{found}");
    assert!(of(0, "at_least").as_u64() > Some(1) && of(1, "at_least").is_null(), "{found}");
    let told = place.run(&["locate", "odd.log"]).is(1).out;
    for said in ["слишком многим местам (не меньше ", "ни к чему не подходит", "слишком мало"]
    {
        assert!(told.contains(said), "{told}");
    }
    let told = place.run(&["locate", "odd.log", "--lang", "en"]).is(1).out;
    for said in ["too many places (at least ", "fits nowhere on the map", "too little is seen"] {
        assert!(told.contains(said), "{told}");
    }
}
