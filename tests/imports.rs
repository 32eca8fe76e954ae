//! Buildings of others: what arrives of them, against the files themselves.

use std::collections::{BTreeMap, BTreeSet};
use std::path::PathBuf;

use orthoframe::engine::{Change, Engine, Memory, Method, Timestamp};
use orthoframe_exchange::{
    ImportError, Imported, Options, Room, Synonyms, Treatment, Vocabulary, What, file_text, read,
    read_rmf, read_virtualhome,
};
use orthoframe_language::Language;
use orthoframe_map::{DoorState, Replica, World, check};
use orthoframe_units::{AreaId, Cm, MapId, Point};

use crate::files::{project, shared};

/// Reads a building twice: it passes the checks, and both readings are the same world, ids included.
fn imported(name: &str) -> Option<Imported> {
    let path = shared(name)?;
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

/// Groups of whatever is joined in pairs.
struct Groups<K: Ord + Clone>(BTreeMap<K, K>);

impl<K: Ord + Clone> Groups<K> {
    fn root(&self, of: &K) -> K {
        let mut at = of;
        while let Some(next) = self.0.get(at).filter(|next| *next != at) {
            at = next;
        }
        at.clone()
    }

    fn join(&mut self, one: &K, other: &K) {
        let (one, other) = (self.root(one), self.root(other));
        self.0.insert(other, one);
    }
}

/// Rooms that doors, passages and lifts join.
fn by_doors(world: &World) -> Groups<AreaId> {
    let mut groups = Groups(BTreeMap::new());
    for &door in world.doors.keys() {
        world.door_areas(door).windows(2).for_each(|pair| groups.join(&pair[0], &pair[1]));
    }
    for (_, stops) in &world.domain.lifts {
        stops.windows(2).for_each(|pair| groups.join(&pair[0].area, &pair[1].area));
    }
    groups
}

pub(crate) fn source(properties: &orthoframe_map::Properties) -> &str {
    properties.get("ИСТОЧНИК").map_or("", String::as_str)
}

/// Rooms of one group, on one map, between which the robot cannot drive, each with the first of its group.
fn parted(world: World, group: &dyn Fn(AreaId) -> Option<String>) -> Vec<(String, String)> {
    let engine = Engine::in_memory(world, None).expect("rules are sound");
    let (world, floors) = (engine.world().expect("a map"), engine.floors().expect("floors"));
    let mut firsts: BTreeMap<(String, MapId), Vec<AreaId>> = BTreeMap::new();
    for &area in world.areas.keys() {
        let (map, _) = world.placement(area).expect("every room stands on a map");
        if let Some(group) = group(area) {
            firsts.entry((group, map)).or_default().push(area);
        }
    }
    let mut parted = Vec::new();
    for ((_, map), areas) in firsts {
        let floor = &floors[&map];
        let name = |area: AreaId| world.areas[&area].name.clone();
        let Some(first) = areas.iter().copied().find(|&a| floor.rest_in(a).is_some()) else {
            continue;
        };
        let from = floor.rest_in(first).expect("just seen");
        for &area in areas.iter().filter(|&&area| area != first) {
            let is_joined = floor.rest_in(area).is_some_and(|to| floor.are_joined(from, to));
            if !is_joined {
                parted.push((name(first), name(area)));
            }
        }
    }
    parted
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

/// "OfficeChairBlack", "MetalCabinetYellow": as many things have a colour as the file has models whose names end in it, but
/// for what stands outside.
#[test]
fn colours_in_the_names_of_models_arrive() {
    for name in ["rmf/office.building.yaml", "rmf/clinic.building.yaml"] {
        let Some(imported) = imported(name) else { return };
        let text = std::fs::read_to_string(shared(name).expect("it was read")).unwrap();
        let models = || text.split("model_name: ").skip(1);
        let (taken, found) = taken(&imported, What::Thing);
        for colour in ["Black", "Blue", "Grey", "Yellow"] {
            let called =
                |model: &&str| model.split([',', '}']).next().is_some_and(|n| n.ends_with(colour));
            let called = models().filter(called).count();
            let is = |replica: &&Replica| {
                let object = &imported.world.objects[&replica.object];
                object.properties.get("ЦВЕТ").is_some_and(|is| *is == colour.to_lowercase())
            };
            let coloured = imported.world.replicas.values().filter(is).count();
            assert!(coloured <= called, "{name} {colour}: {coloured} of {called}");
            assert!(coloured + found - taken >= called, "{name} {colour}: {coloured} of {called}");
        }
    }
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
    let path = shared("osmag/SIST_1.osm").expect("just read");
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
    // Three pairs of rooms of one name lie over one another, and nothing in the file says lift or stairs.
    let skipped = school.report.notes.iter().filter(|n| n.treatment == Treatment::Skipped);
    let skipped: Vec<_> = skipped.map(|n| (n.what, n.source.as_str())).collect();
    let shafts = ["E1-P1", "E1-P2", "E1-S1"].map(|name| (What::Lift, name));
    assert_eq!(skipped, shafts, "{}", school.report);
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

/// The rooms that the lanes of a building of Open-RMF join, by the ids of the file.
fn by_lanes(path: &std::path::Path) -> Groups<String> {
    let text = file_text(path).expect("a text");
    let survey = read_rmf(&text).expect("a building");
    let mut groups = Groups(BTreeMap::new());
    for (n, level) in survey.levels.iter().enumerate() {
        let node = |p: Point| {
            let key = format!("{n}: {:.0} {:.0}", p.x, p.y);
            let within = |room: &&Room| {
                let rings = std::iter::once(&room.outline).chain(&room.holes);
                rings.filter(|ring| contains(ring, p)).count() % 2 == 1
            };
            // The cabin of a lift is drawn into another room.
            let room = level.rooms.iter().rfind(within);
            room.map_or(key, |room| room.source.clone())
        };
        for lane in &level.lanes {
            groups.join(&node(lane.ends[0]), &node(lane.ends[1]));
        }
    }
    groups
}

pub(crate) fn contains(ring: &[Point], p: Point) -> bool {
    let sides = ring.iter().zip(ring.iter().cycle().skip(1));
    let cut = sides.filter(|(a, b)| (a.y > p.y) != (b.y > p.y));
    cut.filter(|(a, b)| p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)).count() % 2 == 1
}

/// The rooms that the passages of an osmAG file join, by the ids of the file; on one level, by the words of the file.
fn by_passages(path: &std::path::Path) -> Groups<String> {
    let text = std::fs::read_to_string(path).expect("readable");
    let document = roxmltree::Document::parse(&text).expect("XML");
    let mut rooms: BTreeMap<(String, String), Vec<String>> = BTreeMap::new();
    let mut passages = Vec::new();
    for way in document.root_element().children().filter(|n| n.has_tag_name("way")) {
        let tags = way.children().filter(|n| n.has_tag_name("tag"));
        let tags: BTreeMap<&str, &str> =
            tags.filter_map(|t| Some((t.attribute("k")?, t.attribute("v")?))).collect();
        let of = |key: &str| tags.get(key).copied().unwrap_or_default().to_owned();
        let id = way.attribute("id").expect("an id").to_owned();
        if tags.get("osmAG:areaType") == Some(&"room") {
            rooms.entry((of("name"), of("level"))).or_default().push(id);
        } else if tags.get("osmAG:type") == Some(&"passage") {
            passages.push([(of("osmAG:from"), of("level")), (of("osmAG:to"), of("level"))]);
        }
    }
    let mut groups = Groups(BTreeMap::new());
    for [from, to] in passages {
        if let (Some([one]), Some([other])) =
            (rooms.get(&from).map(Vec::as_slice), rooms.get(&to).map(Vec::as_slice))
        {
            groups.join(one, other);
        }
    }
    groups
}

/// A way exists between any two rooms of one storey that the source's own graph joins: lanes of robots, passages.
#[test]
fn rooms_that_the_source_joins_can_be_driven_between() {
    type Graph = fn(&std::path::Path) -> Groups<String>;
    let buildings: [(&str, Graph); 4] = [
        ("rmf/office.building.yaml", by_lanes),
        ("rmf/triple_H.building.yaml", by_lanes),
        ("rmf/clinic.building.yaml", by_lanes),
        ("osmag/SIST_1.osm", by_passages),
    ];
    for (name, graph) in buildings {
        let Some(path) = shared(name) else { continue };
        let groups = graph(&path);
        assert!(!groups.0.is_empty(), "{name} has a graph");
        let building = read(&path, &Options::default()).expect("a building");
        // Lifts and stairs lead from storey to storey; a way within one must not need them.
        let of: BTreeMap<AreaId, String> = building
            .world
            .areas
            .iter()
            .map(|(&id, area)| (id, groups.root(&source(&area.properties).to_owned())))
            .collect();
        let parted = parted(building.world, &|area| of.get(&area).cloned());
        assert_eq!(parted, [], "{name}");
    }
}

/// No thing of usual size bars a lane: where the office's own robots wait, ours comes from every other such place.
#[test]
fn places_that_lanes_join_can_be_driven_between() {
    let Some(building) = imported("rmf/office.building.yaml") else { return };
    let engine = Engine::in_memory(building.world, None).expect("rules are sound");
    let world = engine.world().expect("a map");
    let places: Vec<&str> = world.places.values().map(|place| place.name.as_str()).collect();
    assert!(places.len() > 10);
    for pair in places.windows(2) {
        let way = engine.route(pair[0], pair[1], Method::Shortest).expect("both are on the map");
        assert!(way.route.is_ok(), "{pair:?}: {:?}", way.no_way_in_words(world, Language::English));
    }
}

/// Into how many parts the doors and empty walls of a ProcTHOR house leave its rooms, by the file alone.
fn parts_of_house(path: &std::path::Path) -> usize {
    let text = std::fs::read_to_string(path).expect("a file");
    let house: serde_json::Value = serde_json::from_str(&text).expect("JSON");
    let list = |name: &str| house[name].as_array().cloned().unwrap_or_default();
    let mut part: BTreeMap<String, String> = list("rooms")
        .iter()
        .filter_map(|r| r["id"].as_str())
        .map(|r| (r.into(), r.into()))
        .collect();
    let doors = list("doors");
    let sides = |door: &serde_json::Value| {
        ["room0", "room1"].map(|end| door[end].as_str().map(str::to_owned))
    };
    let mut joined: Vec<[Option<String>; 2]> = doors.iter().map(sides).collect();
    // "wall|6|1.74|5.22|3.48|5.22": a room and the ends of the wall.
    let mut empty: BTreeMap<String, String> = BTreeMap::new();
    for wall in list("walls").iter().filter(|w| w["empty"] == true) {
        let (id, room) =
            (wall["id"].as_str().expect("an id"), wall["roomId"].as_str().expect("a room"));
        let ends = id.splitn(3, '|').nth(2).expect("its ends").to_owned();
        if let Some(other) = empty.insert(ends, room.to_owned()) {
            joined.push([Some(other), Some(room.to_owned())]);
        }
    }
    for [one, other] in joined {
        let end = |room: Option<String>| room.and_then(|r| part.get(&r)).cloned();
        let (Some(one), Some(other)) = (end(one), end(other)) else { continue };
        part.values_mut().filter(|p| **p == one).for_each(|p| p.clone_from(&other));
    }
    part.into_values().collect::<BTreeSet<_>>().len()
}

/// Two imports of one file are one map, ids included, whatever the format.
#[test]
fn every_format_gives_its_ids_again() {
    let scratch = tempfile::tempdir().unwrap();
    let rb2 = World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/maps/rb2.toml")).unwrap();
    let engine = Engine::in_memory(rb2, None).unwrap();
    let map = *engine.world().unwrap().maps.keys().next().unwrap();
    let grid = engine.export_grid(map, 5.0).unwrap();
    let drawn = scratch.path().join(format!("{}.yaml", grid.name));
    std::fs::write(&drawn, &grid.yaml).unwrap();
    std::fs::write(scratch.path().join(format!("{}.pgm", grid.name)), &grid.pgm).unwrap();
    let plan = scratch.path().join("floors.geojson");
    std::fs::write(&plan, engine.export_geojson().unwrap()).unwrap();

    let golden = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("tests/golden");
    let mut files = vec![drawn, plan];
    files.extend(
        ["ifc2x3_flat/input.ifc", "ifc4_two_storeys/input.ifc", "imdf_station"]
            .map(|case| golden.join("formats").join(case)),
    );
    files.push(golden.join("pyrobosim/flat.yaml"));
    files.extend(shared("procthor/house_0.json"));
    files.extend(shared("virtualhome/TestScene2_graph.json"));
    for path in files {
        let world = || read(&path, &Options::default()).map(|building| building.world);
        let (one, other) = (world(), world());
        let one = one.unwrap_or_else(|e| panic!("{}: {e}", path.display()));
        assert!(!one.areas.is_empty(), "{}", path.display());
        assert_eq!(one, other.unwrap(), "{}", path.display());
    }
}

/// A file that says where its robot is, or where robots charge, gives the map a start.
#[test]
fn a_robot_begins_where_the_file_has_it() {
    let scenes = ["rmf/clinic.building.yaml", "procthor/house_3.json"];
    for name in scenes.into_iter().chain(["virtualhome/TestScene1_graph.json"]) {
        let Some(building) = imported(name) else { continue };
        let start = building.world.robot.start.unwrap_or_else(|| panic!("{name}: no start"));
        let (map, pose) =
            orthoframe_robot::starting_pose(&building.world).expect("it stands on a map");
        let engine = Engine::in_memory(building.world, None).expect("rules are sound");
        let floor = &engine.floors().expect("the map has floors")[&map];
        assert!(floor.locate(pose.at).is_some(), "{name}: {start:?}");
    }
}

/// Whatever a format calls its things, people have a word for it, in both languages.
#[test]
fn every_class_of_the_formats_has_a_name_in_both_languages() {
    let table = Synonyms::built_in();
    let text = |path: PathBuf| file_text(&path).expect("readable");
    let mut classes: BTreeSet<String> = BTreeSet::new();
    for name in ["clinic", "office", "triple_H"] {
        let Some(path) = shared(&format!("rmf/{name}.building.yaml")) else { return };
        classes.extend(read_rmf(&text(path)).expect("sound").kinds.into_iter().map(|k| k.word));
    }
    for n in 1..4 {
        let Some(path) = shared(&format!("virtualhome/TestScene{n}_graph.json")) else { return };
        let survey = read_virtualhome(&text(path)).expect("sound");
        classes.extend(survey.kinds.into_iter().map(|k| k.word));
    }
    let Some(path) = shared("procthor/asset-database.json") else { return };
    let assets: serde_json::Value = serde_json::from_str(text(path).text()).expect("JSON");
    classes.extend(assets.as_object().expect("by class").keys().cloned());
    // Parts of a wall that the reader makes doors and passages of.
    classes.retain(|class| !["Doorframe", "Doorway"].contains(&class.as_str()));
    let is_named = |class: &String| {
        let found = table.find(Vocabulary::Object, class);
        found.is_some_and(|f| !f.meaning.name.is_ascii() && !f.meaning.name_en.is_empty())
    };
    let unnamed: Vec<&String> = classes.iter().filter(|class| !is_named(class)).collect();
    assert!(classes.len() > 200 && unnamed.is_empty(), "{unnamed:?}");
}

/// The people of a scene and the robots of a site stand on no map, and that is told.
#[test]
fn who_is_left_out_is_told() {
    for (name, sort, many) in [
        ("rmf/clinic.building.yaml", "роботов площадки", 4),
        ("virtualhome/TestScene3_graph.json", "людей карта не хранит", 1),
    ] {
        let Some(building) = imported(name) else { continue };
        let told = building.report.notes.iter().filter(|note| note.why.to_string().contains(sort));
        assert_eq!(told.count(), many, "{name}");
    }
}

/// Pairs of rooms of the dwellings that their doors join and furniture parts, for a robot so much narrower, cm.
fn barred(keeps_furniture: bool, slimmer: f64) -> Vec<(String, Vec<(String, String)>)> {
    let houses = (0..10).map(|n| format!("procthor/house_{n}.json"));
    let scenes = (1..4).map(|n| format!("virtualhome/TestScene{n}_graph.json"));
    let mut barred = Vec::new();
    for name in houses.chain(scenes) {
        let Some(path) = shared(&name) else { continue };
        let mut world = read(&path, &Options::default()).expect("a building").world;
        if !keeps_furniture {
            world.replicas.clear();
            world.places.values_mut().for_each(|place| place.serves = None);
        }
        world.doors.values_mut().for_each(|door| door.state = DoorState::OPEN);
        world.robot.radius = Cm::of(world.robot.radius.get() - slimmer / 2.0);
        let groups = by_doors(&world);
        if name.starts_with("procthor") {
            let parts: BTreeSet<AreaId> = world.areas.keys().map(|a| groups.root(a)).collect();
            assert_eq!(parts.len(), parts_of_house(&path), "{name}");
        }
        let parted = parted(world, &|area| Some(groups.root(&area).0.to_string()));
        if !parted.is_empty() {
            barred.push((name, parted));
        }
    }
    barred
}

#[test]
fn rooms_of_houses_hang_together_when_they_stand_empty() {
    assert_eq!(barred(false, 0.0), []);
}

/// Where the furniture of the simulators leaves less than the 54 cm that the robot needs, and nowhere else: beds and a
/// door's leaf bar a bedroom, a table and a chair the way to a bath. A robot of 20 cm gets everywhere.
#[test]
fn furniture_bars_the_ways_that_it_narrows() {
    if shared("procthor").is_none() || shared("virtualhome").is_none() {
        return;
    }
    let pair = |to: &str| ("Спальня".to_owned(), to.to_owned());
    let bedroom = ["Ванная", "Кухня", "Гостиная"].map(pair).to_vec();
    let bedroom = ("procthor/house_1.json".to_owned(), bedroom);
    let bath = ("procthor/house_8.json".to_owned(), vec![pair("Ванная")]);
    assert_eq!(barred(true, 0.0), [bedroom, bath]);
    assert_eq!(barred(true, 34.0), []);
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
    assert_eq!(loose.report.count(Treatment::Mended), 1);
    assert!(matches!(read(&path, &strict), Err(ImportError::Strict { .. })));
}

/// Juice, crackers and whipped cream were no food: whatever the table of imports has under food and drink is asked for as one
/// of them, in both languages.
#[test]
fn what_is_imported_as_food_is_food_or_drink() {
    let table = std::fs::read_to_string(project("rules/import-synonyms.toml")).unwrap();
    let (_, foods) = table.split_once("# Еда и питьё").expect("a heading");
    let (foods, _) = foods.split_once("  # ").expect("the next heading");
    let english = |line: &str| {
        Some(line.split_once("name_en = \"")?.1.split_once('"').expect("a string").0.to_owned())
    };
    let foods: Vec<String> = foods.lines().filter_map(english).collect();
    assert!(foods.len() > 25, "{foods:?}");
    let node = |id: usize, category: &str, class: &str, at: [f64; 3], size: [f64; 3]| {
        let (center, class) = (at, class.replace(' ', ""));
        serde_json::json!({
            "id": id, "category": category, "class_name": class, "prefab_name": class,
            "bounding_box": { "center": center, "size": size }, "properties": [], "states": [],
        })
    };
    let mut nodes = vec![node(1, "Rooms", "kitchen", [10.0, 1.25, 10.0], [20.0, 2.5, 20.0])];
    let mut edges = Vec::new();
    for (n, food) in foods.iter().enumerate() {
        let at = [1.0 + 2.0 * (n % 9) as f64, 0.05, 1.0 + 2.0 * (n / 9) as f64];
        nodes.push(node(n + 2, "Food", food, at, [0.1, 0.1, 0.1]));
        edges.push(serde_json::json!({ "from_id": n + 2, "relation_type": "INSIDE", "to_id": 1 }));
    }
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("foods_graph.json");
    let graph = serde_json::json!({ "nodes": nodes, "edges": edges });
    std::fs::write(&path, graph.to_string()).unwrap();
    let mut engine = Engine::open(&dir.path().join("store"), None).expect("a new store");
    let change = Change::new("Мастер", Timestamp(1_790_000_000_000), "");
    engine.import(&path, &change).expect("the scene is sound");
    for [food, drink] in [
        ["What food is there?", "What drinks are there?"],
        ["Какая есть еда?", "Какие есть напитки?"],
    ] {
        let things = |line: &str| {
            let answer = engine.ask(line, &mut Memory::default()).expect("there is a map");
            answer.unwrap_or_else(|doubt| panic!("{line}: {doubt:?}")).things
        };
        let found: BTreeSet<_> = things(food).into_iter().chain(things(drink)).collect();
        assert_eq!(found.len(), foods.len(), "{food}");
    }
}
