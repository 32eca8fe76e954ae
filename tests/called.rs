//! Rooms that a site's file names by their doors alone, names behind the word for what bears them, rooms told with their
//! storey, and the next of a row of rooms.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe::engine::Memory;
use orthoframe_language::question::{Said, Thing};
use orthoframe_map::{Entity, World};
use orthoframe_units::AreaId;

use crate::files::shared;
use crate::talk::engine;

const CLINIC: &str = "rmf/clinic.building.yaml";

/// By the file's own text: names of doors that are equal but for the side of the room.
fn rooms_by_doors(text: &str) -> BTreeMap<String, BTreeSet<String>> {
    let mut rooms: BTreeMap<String, BTreeSet<String>> = BTreeMap::new();
    for name in text.split("name: [1, ").skip(1).filter_map(|rest| rest.split(']').next()) {
        for side in ["_inner", "_outer"] {
            if let Some(stem) = name.strip_suffix(side) {
                rooms.entry(stem.to_owned()).or_default().insert(name.to_owned());
            }
        }
    }
    rooms.retain(|_, doors| doors.len() == 2);
    rooms
}

fn area_called<'w>(world: &'w World, name: &str) -> Option<&'w orthoframe_map::Area> {
    world.areas.values().find(|area| area.name_en == name)
}

#[test]
fn rooms_are_called_as_all_their_doors_are() {
    let Some(clinic) = engine(&format!("../shared/data/{CLINIC}")) else { return };
    let world = clinic.world().unwrap();
    let text = std::fs::read_to_string(shared(CLINIC).expect("it was read")).unwrap();
    let rooms = rooms_by_doors(&text);
    assert!(rooms.len() > 40, "{}", rooms.len());
    for (stem, doors) in &rooms {
        let name = stem.replace("_rm_", "_room_").replace('_', " ");
        let area = area_called(world, &name).unwrap_or_else(|| panic!("no {name}"));
        let of_room: BTreeSet<String> = world
            .doors
            .values()
            .filter(|door| world.door_areas(door.id).contains(&area.id))
            .map(|door| door.name_en.clone())
            .collect();
        assert_eq!(&of_room, doors, "{name}");
    }
    // Nothing else is called after doors but by a vertex within, or because its one door says that it is a room's.
    for area in world.areas.values().filter(|area| area.name_en.ends_with(" room")) {
        let own = area.name_en.trim_end_matches(" room").replace(' ', "_");
        let place = world.places.values().any(|p| p.area == area.id && p.name_en.contains(&own));
        let is_kind = !area.name_en.starts_with('L');
        assert!(place || is_kind, "{}", area.name_en);
    }
}

/// A room that is called as a point in it is asked of like any other.
#[test]
fn who_is_in_a_room_is_told_by_its_name() {
    let Some(clinic) = engine(&format!("../shared/data/{CLINIC}")) else { return };
    let world = clinic.world().unwrap();
    let called = world.areas.values().filter(|area| area.name_en.starts_with(['L', 'l']));
    for area in called.filter(|area| area.name_en.ends_with(" room")) {
        let (_, short) = area.name_en.split_once(' ').expect("a storey, and the room");
        let inside = world.replicas.values().filter(|replica| replica.area == area.id);
        let peopled = inside.clone().any(|replica| world.has_trait(replica.id, "person"));
        for line in [
            format!("Who is in {}?", area.name_en),
            format!("Who is in the {short}?"),
            format!("What is in the {short}?"),
        ] {
            if line.starts_with("Who") && !peopled {
                continue;
            }
            let answer = clinic.ask(&line, &mut Memory::default()).expect("a map");
            let answer = answer.unwrap_or_else(|refused| panic!("{line}: {}", refused.text));
            let named = inside.clone().filter(|r| answer.text.contains(&r.name_en)).count();
            assert!(named > 0, "{line} {}", answer.text);
        }
    }
}

/// "The door L1_wc_2" is L1_wc_2, in whatever question.
#[test]
fn a_name_behind_its_kind_is_the_name() {
    let Some(clinic) = engine(&format!("../shared/data/{CLINIC}")) else { return };
    let world = clinic.world().unwrap();
    let answer = |line: &str| {
        clinic.ask(line, &mut Memory::default()).expect("a map").map_err(|refused| refused.text)
    };
    let mut same = 0;
    let doors = world.doors.values().map(|door| ("door", door.name_en.as_str()));
    let rooms = world.areas.values().map(|area| ("room", area.name_en.as_str()));
    // What is called as its kind is has no name of its own.
    let named = doors.chain(rooms).filter(|(_, name)| name.starts_with(['L', 'l']));
    for (kind, name) in named.step_by(9) {
        for frame in ["How wide is {}?", "Where is {}?", "What is near {}?", "How far is it to {}?"]
        {
            let bare = answer(&frame.replace("{}", name));
            let Ok(bare) = bare else { continue };
            let line = frame.replace("{}", &format!("the {kind} {name}"));
            let told = answer(&line).unwrap_or_else(|refused| panic!("{line}: {refused}"));
            assert_eq!(told.text, bare.text, "{line}");
            same += 1;
        }
    }
    assert!(same > 30, "{same}");
}

/// What is in a room and on a storey is in the room of that storey, however the storey is told.
#[test]
fn a_room_told_with_its_storey_is_that_room() {
    let Some(clinic) = engine(&format!("../shared/data/{CLINIC}")) else { return };
    let world = clinic.world().unwrap();
    let answer = |line: &str| {
        clinic.ask(line, &mut Memory::default()).expect("a map").map_err(|refused| refused.text)
    };
    let mut compared = 0;
    for area in world.areas.values().filter(|area| area.name_en.contains("consult room")).step_by(5)
    {
        let Some((storey, short)) = area.name_en.split_once(' ') else { continue };
        let ordinal = if storey == "L1" { "first" } else { "second" };
        for (whole, told) in [
            (format!("How many nurses are in {}?", area.name_en), "How many nurses are in the {}?"),
            (format!("Is there a patient in {}?", area.name_en), "Is there a patient in the {}?"),
        ] {
            let whole = answer(&whole).expect("a plain question");
            for place in [format!("{short} on {storey}"), format!("{short} on the {ordinal} floor")]
            {
                let line = told.replace("{}", &place);
                let told = answer(&line).unwrap_or_else(|refused| panic!("{line}: {refused}"));
                assert_eq!(
                    (told.said, told.number),
                    (whole.said, whole.number),
                    "{line} {}",
                    told.text
                );
                compared += 1;
            }
        }
        // In Russian it is the same room, and bears a number.
        let numbered = answer(&format!("Сколько медсестёр в {}?", area.name_en));
        assert!(numbered.is_ok_and(|answer| answer.said != Said::Unknown), "{}", area.name_en);
    }
    assert!(compared > 20, "{compared}");
}

/// "What about room 4?" after "left consult room 3": not another room 4 alone.
#[test]
fn the_next_of_a_row_is_not_denied_for_a_namesake() {
    let Some(clinic) = engine(&format!("../shared/data/{CLINIC}")) else { return };
    let world = clinic.world().unwrap();
    let has_patient = |name: &str| {
        let area = area_called(world, name)?;
        Some(world.replicas.values().any(|replica| {
            let kind = &world.objects[&replica.object].name_en;
            replica.area == area.id && kind.to_lowercase().contains("patient")
        }))
    };
    let mut denied = 0;
    for number in 1..14 {
        let Some(true) = has_patient(&format!("L1 left consult room {number}")) else { continue };
        let mut memory = Memory::default();
        let first = clinic.ask("Is there a patient in the left consult room 3 on L1?", &mut memory);
        assert!(first.expect("a map").is_ok());
        if let Ok(answer) =
            clinic.ask(&format!("What about room {number}?"), &mut memory).expect("a map")
        {
            assert_ne!(answer.said, Said::No, "room {number}: {}", answer.text);
        }
        denied += 1;
    }
    assert!(denied > 2, "{denied}");
}

/// Where one room is called "Bedroom" and another "Bedroom 2", the biggest bedroom is the biggest of both, wherever it stands in
/// a question or an order.
#[test]
fn the_biggest_of_a_kind_is_not_the_one_that_bears_its_name() {
    for map in [
        "../shared/data/virtualhome/TestScene3_graph.json",
        "../shared/data/procthor/house_7.json",
        "../shared/data/procthor/house_9.json",
    ] {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let mut kinds: BTreeMap<_, Vec<AreaId>> = BTreeMap::new();
        for area in world.areas.values() {
            kinds.entry(area.area_type).or_default().push(area.id);
        }
        for (kind, rooms) in kinds {
            let Some(kind) = world.types.area.get(kind).filter(|_| rooms.len() > 1) else {
                continue;
            };
            let noun = kind.name_en.to_lowercase();
            let ask = |line: &str| engine.ask(line, &mut Memory::default()).unwrap().ok();
            for word in ["biggest", "smallest"] {
                let Some(plain) = ask(&format!("What is the {word} {noun}?")) else { continue };
                let [Thing::Entity(Entity::Area(room))] = plain.things[..] else { continue };
                assert!(rooms.contains(&room), "{noun}: {}", plain.text);
                let order = format!("Go to the {word} {noun}");
                let there = format!("{:?}", engine.understand(&order).unwrap());
                assert!(there.contains(&format!("{room:?}")), "{order}: {there}");
            }
        }
    }
}
