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
