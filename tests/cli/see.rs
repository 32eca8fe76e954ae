//! `ortho see`: scans, things, changes, drawings, and logs that are not whole.

use std::fmt::Write as _;

use super::Place;
use crate::files::shared;

/// A laser 2 m before a wall, half a turn; a box of 60 cm stands `aside` m to its left, 1.2 m away.
fn scan(aside: f64) -> String {
    let mut line = String::from("FLASER 181");
    for beam in 0..181 {
        let angle = f64::from(beam - 90).to_radians();
        let wall = 2.0 / angle.cos().max(1e-3);
        let side = 1.2 * angle.tan();
        let on_box = angle.cos() > 0.1 && side > aside && side < aside + 0.6;
        let range = if on_box { 1.2 / angle.cos() } else { wall };
        let _ = write!(line, " {:.3}", range.min(81.91));
    }
    line + " 0 0 0 0 0 0 1 host 1\n"
}

#[test]
fn a_scan_is_told_drawn_and_given_as_json() {
    let place = Place::empty();
    place.write("room.log", scan(0.2));
    let run = place.run(&["see", "room.log", "--draw", "room.svg"]).is(0);
    assert!(run.out.starts_with("Скан 1 из 1, строка 1: лучей 181"), "{}", run.out);
    assert!(run.out.contains("край – край"), "the front of the box: {}", run.out);
    let svg = std::fs::read_to_string(place.path("room.svg")).unwrap();
    assert!(svg.contains("конец самой вещи") && svg.contains("дальше не видно"));
    let value = place.json(&["see", "room.log"], 0);
    assert_eq!(value["outcome"], "segments");
    let segments = value["segments"].as_array().unwrap();
    let front = segments.iter().find(|s| s["ends"] == serde_json::json!(["free", "free"])).unwrap();
    let length = front["length"].as_f64().unwrap();
    assert!((length - 60.0).abs() < 6.0, "{length}");
    assert_eq!(
        segments
            .iter()
            .filter(|s| s["ends"][0] == "occluded" || s["ends"][1] == "occluded")
            .count(),
        2
    );
    place.run(&["see", "room.log", "--draw", "room.bmp"]).is(2);
    let run = place.run(&["see", "room.log", "--scan", "2"]).is(2);
    assert!(run.err.contains("скана 2 нет"), "{}", run.err);
}

#[test]
fn things_and_what_moved() {
    let place = Place::empty();
    place.write("two.log", scan(0.2) + &scan(0.35));
    let value = place.json(&["see", "two.log", "--models", "--scan", "1"], 0);
    assert_eq!((value["outcome"].as_str(), value["scans"].as_u64()), (Some("things"), Some(2)));
    assert_eq!(value["things"].as_array().unwrap().len(), 3, "{value}");
    place.run(&["see", "two.log", "--models", "--tree", "--draw", "tree.png"]).is(0);
    assert!(std::fs::read(place.path("tree.png")).unwrap().starts_with(b"\x89PNG"));
    // The font that PNG files are drawn with has no Greek.
    place.run(&["see", "two.log", "--models", "--tree", "--draw", "tree.svg"]).is(0);
    let tree = std::fs::read_to_string(place.path("tree.svg")).unwrap();
    assert!(tree.contains("отрезок 0") && !tree.contains('σ'), "{tree}");
    let value = place.json(&["see", "two.log", "--against", "2", "--draw", "moved.svg"], 0);
    let parts = value["parts"].as_array().unwrap();
    // The wall may have slid along itself: nothing says whether it did. The box moved.
    let moved = parts.iter().find(|part| part["pairs"] == serde_json::json!([1]));
    let moved = moved.unwrap_or_else(|| panic!("the box moved: {value}"));
    let shift = moved["shift"][1].as_f64().unwrap();
    assert!((shift - 15.0).abs() < 6.0, "{shift}");
    let svg = std::fs::read_to_string(place.path("moved.svg")).unwrap();
    assert!(svg.contains("сдвинулось само"));
}

#[test]
fn a_log_that_breaks_off_is_shown_as_far_as_it_goes() {
    let place = Place::empty();
    let whole = scan(0.2);
    place.write("cut.log", format!("{whole}{}", &whole[..400]));
    let run = place.run(&["see", "cut.log"]).is(2);
    assert!(run.out.starts_with("Скан 1 из 1"), "{}", run.out);
    assert!(run.err.contains("cut.log:2:"), "{}", run.err);
    let value = place.json(&["see", "cut.log"], 2);
    assert_eq!(
        (value["faults"][0]["line"].as_u64(), value["faults"][0]["column"].as_u64()),
        (Some(2), Some(401))
    );
    // What a line is passed over for is told in the language of the rest.
    let run = place.run(&["see", "cut.log", "--lang", "en"]).is(2);
    assert!(run.err.contains("the line breaks off") && !run.err.contains("строка"), "{}", run.err);
    let told = value["faults"][0]["message_en"].as_str().unwrap();
    assert!(told.contains("the line breaks off"), "{told}");
    place.write("no.log", "12 обезьян\n");
    let value = place.json(&["see", "no.log"], 2);
    assert_eq!(value["errors"][0]["code"], "vectors::log_unknown");
    assert_eq!(value["errors"][0]["line"], 1);
    place.run(&["see", "absent.log"]).is(2);
}

#[test]
fn a_picture_is_contours() {
    let Some(plan) = shared("lidar/plans/Freiburg101_scan.png") else { return };
    let place = Place::empty();
    let value = place.json(&["see", plan.to_str().unwrap()], 0);
    assert_eq!(value["unit"], "px");
    assert!(value["segments"].as_array().unwrap().len() > 20);
}

#[test]
fn logs_of_others_become_segments() {
    let place = Place::empty();
    for (name, beams) in [("intel-corrected.log.gz", 180), ("exp1.dat.gz", 683)] {
        let Some(log) = shared(&format!("lidar/{name}")) else { return };
        let value = place.json(&["see", log.to_str().unwrap(), "--scan", "100"], 0);
        assert_eq!(value["beams"], beams);
        assert!(value["segments"].as_array().unwrap().len() > 3, "{value}");
    }
    // The wheels of Breezy are counts, no pose: things of all its scans are not to be had.
    let log = shared("lidar/exp1.dat.gz").expect("it was there");
    let value = place.json(&["see", log.to_str().unwrap(), "--models"], 2);
    assert_eq!(value["errors"][0]["code"], "see::no_poses");
}
