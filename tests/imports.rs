//! Buildings of others: what arrives of them, against the files themselves.
//!
//! The files stand in ../shared/data and are no part of the project; a test whose file is absent says so and passes.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use orthoframe::engine::Engine;
use orthoframe::exchange::{Deed, ImportError, Imported, Options, What, read};
use orthoframe::map::{DoorState, World, check};
use orthoframe::units::{AreaId, Cm};

#[expect(clippy::print_stdout, reason = "a skipped test says so")]
fn data(name: &str) -> Option<PathBuf> {
    let path = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(name);
    if !path.exists() {
        println!("пропущено: нет {}", path.display());
    }
    path.exists().then_some(path)
}

/// Reads a building twice: it passes the checks, and both readings are the same world, ids included.
fn imported(name: &str) -> Option<Imported> {
    let path = data(name)?;
    let one = read(&path, &Options::default()).unwrap_or_else(|e| panic!("{name}: {e}"));
    let other = read(&path, &Options::default()).unwrap_or_else(|e| panic!("{name}: {e}"));
    assert_eq!(one.world, other.world, "{name}: two imports of one file");
    let faults: Vec<_> = check(&one.world).into_iter().filter(|f| !f.is_warning()).collect();
    assert!(faults.is_empty(), "{name}: {faults:?}");
    Some(one)
}

fn taken(imported: &Imported, what: What) -> (usize, usize) {
    imported.report.counts.get(&what).map_or((0, 0), |c| (c.taken, c.found))
}

/// Groups of Areas that doors, passages and lifts join; each Area's group by its least id.
fn groups(world: &World) -> BTreeMap<AreaId, AreaId> {
    let mut group: BTreeMap<AreaId, AreaId> = world.areas.keys().map(|&a| (a, a)).collect();
    let mut pairs: Vec<Vec<AreaId>> = world.doors.keys().map(|&d| world.door_areas(d)).collect();
    pairs
        .extend(world.domain.lifts.iter().map(|(_, stops)| stops.iter().map(|s| s.area).collect()));
    let mut is_changed = true;
    while is_changed {
        is_changed = false;
        for areas in &pairs {
            let Some(&least) = areas.iter().map(|a| &group[a]).min() else { continue };
            for area in areas {
                if group[area] != least {
                    group.insert(*area, least);
                    is_changed = true;
                }
            }
        }
    }
    group
}

fn source(properties: &orthoframe::map::Properties) -> &str {
    properties.get("ИСТОЧНИК").map_or("", String::as_str)
}

/// From the first room of each group to each other room of it on the same map, there is a way on the floor.
fn routes(world: World) -> Vec<String> {
    let group = groups(&world);
    let engine = Engine::in_memory(world, None).expect("rules are sound");
    let world = engine.world().expect("a map");
    let mut firsts: BTreeMap<(AreaId, orthoframe::units::MapId), AreaId> = BTreeMap::new();
    let mut missing = Vec::new();
    for (&area, &root) in &group {
        let (map, _) = world.placement(area).expect("every room stands on a map");
        let first = *firsts.entry((root, map)).or_insert(area);
        if first == area {
            continue;
        }
        let (from, to) = (&world.areas[&first].name, &world.areas[&area].name);
        match engine.route(from, to, orthoframe::engine::Method::Shortest) {
            Ok(answer) if answer.route.is_ok() => {}
            Ok(answer) => missing.push(format!("{from} → {to}: {:?}", answer.route.err())),
            Err(e) => missing.push(format!("{from} → {to}: {e}")),
        }
    }
    missing
}

#[test]
fn the_office_arrives_with_its_doors() {
    let Some(office) = imported("rmf/office.building.yaml") else { return };
    assert_eq!(taken(&office, What::Door), (3, 3), "{}", office.report);
    assert_eq!(
        taken(&office, What::Thing).1,
        79 + office.world.objects.values().filter(|o| o.name == "Перегородка").count()
    );
}

#[test]
fn the_clinic_arrives_with_its_doors_and_lifts() {
    let Some(clinic) = imported("rmf/clinic.building.yaml") else { return };
    let world = &clinic.world;
    assert_eq!(world.maps.len(), 2);
    assert_eq!(world.domain.maps[1].frame.z, Cm::of(1000.0));
    assert_eq!(world.domain.lifts.len(), 4);
    let (doors, of) = taken(&clinic, What::Door);
    // 132 in the walls, and four cabins with one door on each of two floors.
    assert_eq!((doors, of), (140, 140), "{}", clinic.report);
}

#[expect(clippy::print_stdout, reason = "the count is worth seeing")]
#[test]
fn passages_of_osmag_join_the_areas_that_they_name() {
    let Some(school) = imported("osmag/SIST_1.osm") else { return };
    let path = data("osmag/SIST_1.osm").expect("just read");
    let text = std::fs::read_to_string(path).expect("readable");
    let document = roxmltree::Document::parse(&text).expect("XML");
    let ways: Vec<(&str, BTreeMap<&str, &str>)> = document
        .root_element()
        .children()
        .filter(|n| n.has_tag_name("way"))
        .map(|way| {
            let tags = way.children().filter(|n| n.has_tag_name("tag"));
            let tags = tags.filter_map(|t| Some((t.attribute("k")?, t.attribute("v")?))).collect();
            (way.attribute("id").expect("an id"), tags)
        })
        .collect();
    let rooms: Vec<_> =
        ways.iter().filter(|(_, t)| t.get("osmAG:areaType") == Some(&"room")).collect();
    let passages: Vec<_> =
        ways.iter().filter(|(_, t)| t.get("osmAG:type") == Some(&"passage")).collect();
    assert_eq!((rooms.len(), passages.len()), (177, 200));
    assert_eq!(taken(&school, What::Room), (177, 177), "{}", school.report);
    assert_eq!(school.report.count(Deed::Skipped), 0, "{}", school.report);
    // «E1c-F2-COR-01» has two nodes and no passage on its level: a strip stands for it, and the report says so.
    let told: Vec<_> = school.report.notes.iter().filter(|n| n.source == "-175029").collect();
    assert!(told.iter().any(|n| n.why.to_string().contains("полоса")), "{}", school.report);

    let world = &school.world;
    for area in world.areas.values() {
        assert_eq!(world.find(&area.name).len(), 1, "{}: one room bears the name", area.name);
    }
    let joined: BTreeMap<&str, BTreeSet<&str>> = world
        .doors
        .values()
        .map(|door| {
            let areas = world.door_areas(door.id);
            let ids = areas.iter().map(|a| source(&world.areas[a].properties)).collect();
            (source(&door.properties), ids)
        })
        .collect();
    // Sound: both areas are rooms of the file, each found by name or id, both on one level.
    let level = |id: &str| ways.iter().find(|w| w.0 == id).and_then(|w| w.1.get("level")).copied();
    let found = |word: &str, on: Option<&str>| -> Vec<&str> {
        let bears = |(id, tags): &&&(&str, BTreeMap<&str, &str>)| {
            (*id == word || tags.get("name") == Some(&word)) && level(id) == on
        };
        rooms.iter().filter(bears).map(|r| r.0).collect()
    };
    let (mut sound, mut exact, mut wrong) = (0, 0, Vec::new());
    for (id, tags) in &passages {
        let on = tags.get("level").copied();
        let (Some(from), Some(to)) = (tags.get("osmAG:from"), tags.get("osmAG:to")) else {
            continue;
        };
        let ([from], [to]) = (&found(from, on)[..], &found(to, on)[..]) else { continue };
        if from == to {
            continue;
        }
        sound += 1;
        let wanted = BTreeSet::from([*from, *to]);
        if joined.get(id) == Some(&wanted) {
            exact += 1;
        } else {
            wrong.push(format!("{id}: {wanted:?}, {:?}", joined.get(id)));
        }
    }
    println!("проходов исправных {sound}, связывают свои два помещения {exact}");
    assert!(exact * 100 >= sound * 97, "{exact} of {sound}: {wrong:#?}\n{}", school.report);
}

#[test]
fn every_room_that_the_source_connects_can_be_driven_to() {
    for name in ["rmf/office.building.yaml", "rmf/triple_H.building.yaml"] {
        let Some(building) = imported(name) else { continue };
        let missing = routes(building.world);
        assert!(missing.is_empty(), "{name}: {missing:#?}");
    }
}

/// Into how many parts the doors of a ProcTHOR house leave its rooms, by the file alone.
fn parts_of_house(path: &std::path::Path) -> usize {
    let text = std::fs::read_to_string(path).expect("a file");
    let house: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let list = |name: &str| house[name].as_array().cloned().unwrap_or_default();
    let mut part: BTreeMap<String, String> = list("rooms")
        .iter()
        .filter_map(|r| r["id"].as_str())
        .map(|r| (r.into(), r.into()))
        .collect();
    for door in list("doors") {
        let end = |name: &str| door[name].as_str().and_then(|r| part.get(r)).cloned();
        let (Some(one), Some(other)) = (end("room0"), end("room1")) else { continue };
        part.values_mut().filter(|p| **p == one).for_each(|p| p.clone_from(&other));
    }
    part.into_values().collect::<BTreeSet<_>>().len()
}

/// Furniture may bar a way in a house of a simulator; the rooms themselves must hang together.
#[test]
fn rooms_of_houses_hang_together_when_they_stand_empty() {
    let houses = (0..10).map(|n| format!("procthor/house_{n}.json"));
    let scenes = (1..4).map(|n| format!("virtualhome/TestScene{n}_graph.json"));
    for name in houses.chain(scenes) {
        let Some(path) = data(&name) else { continue };
        let mut world = read(&path, &Options::default()).expect("a building").world;
        world.replicas.clear();
        world.places.values_mut().for_each(|place| place.serves = None);
        world.doors.values_mut().for_each(|door| door.state = DoorState::OPEN);
        if name.starts_with("procthor") {
            let joined = groups(&world).into_values().collect::<BTreeSet<_>>().len();
            assert_eq!(joined, parts_of_house(&path), "{name}");
        }
        let missing = routes(world);
        assert!(missing.is_empty(), "{name}: {missing:#?}");
    }
}

#[test]
fn a_strict_import_refuses_what_had_to_be_mended() {
    let dir = tempfile::tempdir().expect("a folder");
    let path = dir.path().join("yard.building.yaml");
    let walls = |corners: usize| -> String {
        (0..corners).map(|i| format!("      - [{i}, {}, {{}}]\n", (i + 1) % corners)).collect()
    };
    let text = format!(
        "coordinate_system: cartesian_meters\nname: yard\nlevels:\n  L1:\n    elevation: 0\n    vertices:\n      \
         - [0, 0, 0, \"\"]\n      - [6, 0, 0, \"\"]\n      - [6, 4, 0, \"\"]\n      - [0, 4, 0, \"\"]\n    walls:\n{}",
        walls(4)
    );
    std::fs::write(&path, &text).expect("written");
    let strict = Options { strict: true, ..Options::default() };
    let clean = read(&path, &strict).expect("nothing to mend");
    assert_eq!(clean.world.areas.len(), 1);
    std::fs::write(&path, text + "      - [1, 77, {}]\n").expect("written");
    let loose = read(&path, &Options::default()).expect("it goes through");
    assert_eq!(loose.report.count(Deed::Mended), 1);
    assert!(matches!(read(&path, &strict), Err(ImportError::Strict { .. })));
}
