//! Zones from the map file to the drive: stored and undone, respected by ways and missions, answered in both languages.

use std::fmt::Write as _;
use std::path::Path;

use expect_test::expect_file;
use orthoframe::engine::{Change, Dialogue, Engine, Format, Method, Mode, Timestamp};
use orthoframe_map::{Edits, World};
use orthoframe_units::{Language, Source};

use crate::files::project;

fn change(reason: &str) -> Change {
    Change::new("Мастер", Timestamp(1_790_000_000_000), reason)
}

fn rb2(dir: &Path, zones: &str) -> Engine {
    let mut engine = Engine::open(dir, None).expect("a new store");
    engine.import(&project("maps/rb2.toml"), &change("съёмка")).expect("rb2 is sound");
    if !zones.is_empty() {
        lay(&mut engine, zones);
    }
    engine
}

fn lay(engine: &mut Engine, zones: &str) {
    let zones = Edits::read(&Source::new("zones.toml", zones), Format::Toml);
    let done = engine.edit(&zones, &change(""), Mode::Commit);
    done.expect("good zones");
}

const ZONES: &str = r#"
[zone.wet]
name = "Мокрый пол"
name_en = "Wet floor"
kind = "closed"
rooms = ["corridor"]
reason = "моют пол"
reason_en = "the floor is being washed"
until = "2199-01-01T12:00Z"

[zone.z1]
name = "Зона-1"
name_en = "Zone 1"
kind = "keep-out"
points = [[20, 20], [60, 20], [60, 60], [20, 60]]

[zone.z2]
name = "Зона-2"
name_en = "Zone 2"
kind = "slow"
speed = 20
rooms = ["room-z"]
reason = "здесь дети"
reason_en = "children play there"

[zone.z3]
name = "Зона-3"
name_en = "Zone 3"
kind = "closed"
rooms = ["room-y"]
from = "2190-01-01T12:00Z"
"#;

/// The store gives back what it was given, and a map file what the store has.
#[test]
fn zones_are_stored_written_and_read() {
    let dir = tempfile::tempdir().unwrap();
    let engine = rb2(dir.path(), ZONES);
    let world = engine.world().unwrap().clone();
    assert_eq!(world.zones.len(), 4);
    assert_eq!(engine.store().unwrap().world().unwrap().as_ref(), Some(&world));
    let again = World::parse(&Source::new("copy", world.to_toml()), orthoframe_map::Format::Toml);
    assert_eq!(again.expect("what is written reads"), world);
    drop(engine);
    let engine = Engine::open(dir.path(), None).unwrap();
    assert_eq!(engine.world().unwrap(), &world);
}

/// Each question of the golden file, in its order, in one dialogue.
#[test]
fn zones_are_answered_in_both_languages() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = rb2(dir.path(), ZONES);
    let mut told = String::new();
    let questions = std::fs::read_to_string(project("tests/golden/zones/questions.txt")).unwrap();
    for question in questions.lines() {
        let heard = Dialogue::default().hear(&mut engine, question, &mut |_, _| {}).unwrap();
        let _ = writeln!(told, "> {question}");
        let _ = writeln!(told, "{}", heard.text());
    }
    expect_file![project("tests/golden/zones/answers.txt")].assert_eq(&told);
}

/// A closed room is no goal, and the reason names the zone; when its time is over it is one again.
#[test]
fn a_closed_room_is_told_with_its_zone_and_opens_in_time() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = rb2(dir.path(), ZONES);
    let no = engine.route("Точка-А", "Коридор", Method::Shortest).unwrap();
    let told = no.no_way_in_words(engine.world().unwrap(), Language::Russian);
    assert_eq!(told.as_deref(), Some("Мокрый пол закрыт до 2199-01-01 12:00 UTC: моют пол"));
    assert!(engine.route("Точка-А", "Комната-Y", Method::Shortest).unwrap().route.is_ok());
    lay(&mut engine, "[[edit]]\nzone = \"Мокрый пол\"\nuntil = \"2020-01-01\"\n");
    assert!(engine.route("Точка-А", "Коридор", Method::Shortest).unwrap().route.is_ok());
    engine.undo(None, &change("назад")).unwrap();
    assert!(engine.route("Точка-А", "Коридор", Method::Shortest).unwrap().route.is_err());
}

/// A mission goes round what is closed, and does not begin where there is no other way.
#[test]
fn a_mission_goes_round_zones_or_says_which_bars_it() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = rb2(dir.path(), "");
    let drive = |engine: &mut Engine, order: &str| {
        let mut told = Vec::new();
        let mut dialogue = Dialogue::default();
        let heard = dialogue.hear(engine, order, &mut |_, event| told.extend(event.in_words()));
        let heard = heard.map(|heard| heard.text());
        match heard {
            Ok(replies) => told.push(replies),
            Err(error) => told.push(error.to_string()),
        }
        told.join("\n")
    };
    lay(
        &mut engine,
        "[zone.wet]\nname = \"Мокрый пол\"\nkind = \"closed\"\nrooms = [\"room-z\"]\n",
    );
    let told = drive(&mut engine, "Иди в Комнату-Y");
    assert!(!told.contains("Комната-Z,"), "{told}");
    let told = drive(&mut engine, "Иди в Комнату-Z");
    assert!(told.contains("Мокрый пол закрыт"), "{told}");
    // One that is in force for a time bars the way as one does that always is, and no longer than it is.
    lay(
        &mut engine,
        "[[edit]]\nzone = \"Мокрый пол\"\nfrom = \"2020-01-01\"\nuntil = \"2400-01-01\"\n",
    );
    let told = drive(&mut engine, "Иди в Комнату-Z");
    assert!(told.contains("Мокрый пол закрыт"), "{told}");
    let told = drive(&mut engine, "Иди в Комнату-В");
    assert!(!told.contains("Комната-Z,"), "{told}");
    lay(&mut engine, "[[edit]]\nzone = \"Мокрый пол\"\nuntil = \"2020-01-02\"\n");
    let told = drive(&mut engine, "Иди в Комнату-Z");
    assert!(told.contains("Сделано"), "{told}");
}

/// Shut as a whole, doors and all, the room in which the robot stands is left; within it nothing is a goal.
#[test]
fn of_a_room_that_is_shut_as_a_whole_the_robot_gets_out() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = rb2(dir.path(), "");
    lay(&mut engine, "[zone.here]\nname = \"Учения\"\nkind = \"keep-out\"\nrooms = [\"room-v\"]\n");
    let mut hear = |order: &str| match Dialogue::default().hear(&mut engine, order, &mut |_, _| {})
    {
        Ok(heard) => heard.text(),
        Err(error) => error.to_string(),
    };
    let told = hear("Подъедь к столу-1");
    assert!(told.contains("Учения"), "{told}");
    let told = hear("Поезжай в Комнату-Z");
    assert!(told.contains("Сделано"), "{told}");
    let told = hear("Поезжай в Комнату-В");
    assert!(told.contains("Учения"), "{told}");
}
