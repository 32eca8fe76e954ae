//! Reading the dwellings of household simulators: ProcTHOR, AI2-THOR, VirtualHome, pyrobosim.

use std::collections::BTreeSet;
use std::path::Path;

use orthoframe::engine::{Engine, change_now};
use orthoframe_exchange::{
    Assets, Imported, Level, OpeningKind, Options, ReadError, Report, Room, SceneFormat, Survey,
    Synonyms, Vocabulary, What, assemble, file_text, read, read_procthor, read_pyrobosim,
    read_thor, read_virtualhome,
};
use orthoframe_facts::Value;
use orthoframe_map::{DoorStatus, Format, Orthoframe, Profile, World};
use orthoframe_semantics::{RelationRules, derive};
use orthoframe_units::{Deg, Point, Source};

use crate::files::shared;

fn counts(survey: &Survey) -> (usize, usize, usize, usize) {
    let level = &survey.levels[0];
    let windows = level.openings.iter().filter(|o| o.what == OpeningKind::Window).count();
    (level.rooms.len(), level.openings.len() - windows, windows, level.things.len())
}

/// What every `Survey` promises.
fn check_invariants(survey: &Survey) {
    for level in &survey.levels {
        for thing in &level.things {
            assert!(thing.kind < survey.kinds.len(), "{}", thing.source);
            assert!(thing.room.is_none_or(|r| r < level.rooms.len()), "{}", thing.source);
        }
        let rooms = level.openings.iter().flat_map(|o| o.rooms).flatten().flatten();
        assert!(rooms.into_iter().all(|r| r < level.rooms.len()));
    }
}

#[test]
fn every_room_door_and_thing_of_the_procthor_houses_is_read() {
    let Some(folder) = shared("procthor") else { return };
    let assets = Assets::read(&file_text(&folder.join("asset-database.json")).unwrap()).unwrap();
    let found: Vec<_> = (0..10)
        .map(|n| {
            let text = file_text(&folder.join(format!("house_{n}.json"))).unwrap();
            let survey = read_procthor(&text, &assets).unwrap();
            assert_eq!(survey.remarks, [], "house {n}");
            assert!(survey.kinds.iter().all(|k| !k.parts.is_empty()), "house {n}");
            check_invariants(&survey);
            assert!(survey == read_procthor(&text, &assets).unwrap(), "house {n} read twice");
            counts(&survey)
        })
        .collect();
    let expected = [
        (4, 5, 2, 52),
        (4, 4, 3, 88),
        (4, 4, 4, 89),
        (4, 4, 4, 74),
        (4, 7, 3, 75),
        (4, 5, 1, 70),
        (4, 4, 4, 102),
        (4, 4, 2, 71),
        (4, 4, 4, 87),
        (4, 4, 2, 65),
    ];
    assert_eq!(found, expected);
}

#[test]
fn a_house_without_sizes_is_refused_and_not_imported_empty() {
    let Some(folder) = shared("procthor") else { return };
    let text = file_text(&folder.join("house_0.json")).unwrap();
    let others = r#"{"Chair": [{"assetId": "x", "boundingBox": {"x": 1, "y": 1, "z": 1}}]}"#;
    let others = Assets::read(&Source::new("others.json", others)).unwrap();
    for assets in [Assets::default(), others] {
        let refused = read_procthor(&text, &assets).unwrap_err();
        assert!(matches!(refused, ReadError::NoSizes { count: 1.., .. }), "{refused}");
    }
    // A house in which nothing stands needs no sizes.
    let bare = text.text().replacen("\"objects\":", "\"left out\":", 1);
    assert_ne!(bare, text.text());
    let survey = read_procthor(&Source::new("bare.json", bare), &Assets::default()).unwrap();
    assert_eq!(counts(&survey), (4, 5, 2, 0));
}

#[test]
fn every_room_door_and_thing_of_the_virtualhome_flats_is_read() {
    let Some(folder) = shared("virtualhome") else { return };
    let found: Vec<_> = (1..=3)
        .map(|n| {
            let text = file_text(&folder.join(format!("TestScene{n}_graph.json"))).unwrap();
            let survey = read_virtualhome(&text).unwrap();
            check_invariants(&survey);
            // Curtains are listed twice, as the whole and as its part.
            assert!(survey.remarks.iter().all(|r| r.text.to_string().contains("на том же месте")));
            assert!(survey == read_virtualhome(&text).unwrap(), "scene {n} read twice");
            (counts(&survey), survey.remarks.len())
        })
        .collect();
    let expected = [((4, 4, 3, 327), 3), ((4, 4, 2, 200), 2), ((5, 5, 4, 257), 4)];
    assert_eq!(found, expected);
}

fn flat() -> Survey {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/pyrobosim");
    let world = file_text(&folder.join("flat.yaml")).unwrap();
    read_pyrobosim(&world, &mut |name| file_text(&folder.join(name)).ok()).unwrap()
}

#[test]
fn a_pyrobosim_world_is_read_with_its_hallways() {
    let survey = flat();
    check_invariants(&survey);
    let level = &survey.levels[0];
    let rooms: Vec<&str> = level.rooms.iter().map(|r| r.source.as_str()).collect();
    // The store touches the kitchen: no floor lies between them.
    assert_eq!(rooms, ["kitchen", "bedroom", "store", "hall_kitchen_bedroom"]);
    let openings: Vec<_> = level
        .openings
        .iter()
        .map(|o| {
            let [a, b] = o.jambs.map(|p| (p.x.round(), p.y.round()));
            (o.rooms.unwrap().map(Option::unwrap), a, b)
        })
        .collect();
    assert_eq!(
        openings,
        [
            ([0, 3], (300.0, 100.0), (300.0, 200.0)),
            ([1, 3], (500.0, 200.0), (500.0, 100.0)),
            ([0, 2], (190.0, 300.0), (110.0, 300.0)),
        ]
    );
    assert!(matches!(level.openings[0].what, OpeningKind::Door { status: DoorStatus::Locked, .. }));
    let things: Vec<_> = level
        .things
        .iter()
        .map(|t| (t.source.as_str(), t.at.x.round(), t.at.y.round(), t.z.get()))
        .collect();
    assert_eq!(
        things,
        [
            ("table0", 200.0, 200.0, 0.0),
            ("pantry", 50.0, 450.0, 0.0),
            ("charger", 650.0, 150.0, 0.0),
            ("ghost", 650.0, 150.0, 0.0),
            ("apple0", 210.0, 200.0, 70.0),
            ("gala", 200.0, 200.0, 70.0),
            ("water0", 50.0, 450.0, 180.0),
        ]
    );
    let left_out: Vec<&str> = survey.remarks.iter().map(|r| r.source.as_str()).collect();
    assert_eq!(
        left_out,
        ["hologram", "nowhere", "hall_kitchen_attic", "charger", "ghost", "gala", "water0", "ufo0"]
    );
    assert_eq!(survey.kinds[0].properties["ЦВЕТ"], "Коричневый");
    let ghost = survey.kinds.iter().find(|k| k.source == "hologram").unwrap();
    assert!(ghost.parts.is_empty(), "a mesh tells no size: the table of words does");
}

#[test]
fn scene_metadata_of_ai2thor_is_one_room() {
    let text = r#"{"metadata": {"sceneName": "FloorPlan301", "objects": [
        {"objectId": "Floor|0", "objectType": "Floor",
         "axisAlignedBoundingBox": {"center": {"x": 1, "y": 0, "z": 2}, "size": {"x": 4, "y": 0, "z": 6}}},
        {"objectId": "Bed|1", "objectType": "Bed", "pickupable": false, "moveable": false,
         "axisAlignedBoundingBox": {"center": {"x": 1, "y": 0.4, "z": 2}, "size": {"x": 2, "y": 0.8, "z": 1}}},
        {"objectId": "Broken|1", "objectType": "Mug", "axisAlignedBoundingBox": {"center": {"x": 1}}}
    ], "agent": {"position": {"x": 0, "y": 0.9, "z": 0}, "rotation": {"x": 0, "y": 90, "z": 0}}}}"#;
    let survey = read_thor(&Source::new("scene.json", text)).unwrap();
    check_invariants(&survey);
    let level = &survey.levels[0];
    assert_eq!((level.rooms[0].kind.as_str(), level.things.len()), ("Bedroom", 1));
    assert_eq!(level.spots[0].heading, Some(Deg::ZERO));
    assert_eq!(survey.remarks.len(), 1);
}

#[test]
fn what_is_no_dwelling_is_refused_with_a_reason() {
    let refused = |result: Result<Survey, ReadError>| match result {
        Err(ReadError::Syntax { .. }) => "syntax",
        Err(ReadError::NoBuilding { .. }) => "no building",
        Err(_) => "other",
        Ok(_) => "read",
    };
    let deep = format!("{}{}", "{\"children\": [".repeat(5000), "]}".repeat(5000));
    for (text, expected) in [
        ("", "syntax"),
        ("{\"rooms\": [", "syntax"),
        (deep.as_str(), "syntax"),
        ("[1e999]", "syntax"),
        ("[]", "no building"),
        ("{\"rooms\": [{\"floorPolygon\": [{\"x\": 1e300, \"y\": 0, \"z\": 1}]}]}", "no building"),
        ("{\"rooms\": 7, \"objects\": \"x\", \"nodes\": null}", "no building"),
    ] {
        let source = Source::new("файл.json", text);
        assert_eq!(refused(read_procthor(&source, &Assets::default())), expected, "{text:.40}");
        assert_eq!(refused(read_virtualhome(&source)), expected, "{text:.40}");
        assert_eq!(refused(read_thor(&source)), expected, "{text:.40}");
    }
    for text in ["rooms: [", "rooms:\n  - name: x\n", "a: &a [1]\nb: [*a, *a]\n"] {
        let world = Source::new("мир.yaml", text);
        assert_ne!(refused(read_pyrobosim(&world, &mut |_| None)), "read", "{text}");
    }
}

#[test]
fn each_format_is_known_by_its_words() {
    let of = |text: &str| SceneFormat::of(&Source::new("", text));
    assert_eq!(of("  {\"rooms\": [{\"floorPolygon\": []}]}"), Some(SceneFormat::ProcThor));
    assert_eq!(of("{\"nodes\": [{\"class_name\": 1}]}"), Some(SceneFormat::VirtualHome));
    assert_eq!(of("{\"a\": {\"axisAlignedBoundingBox\": 1}}"), Some(SceneFormat::Thor));
    assert_eq!(of("robots:\n\nrooms:\n - footprint: 1\n"), Some(SceneFormat::PyRoboSim));
    assert_eq!(of("levels:\n  L1:\n    rooms:\n"), None);
    assert_eq!(of(""), None);
}

/// The class names of AI2-THOR and VirtualHome whose words are not what their parts are, with what they are here.
#[test]
fn no_thing_is_named_by_a_part_of_its_word() {
    let table = Synonyms::built_in();
    let name = |word: &str| table.find(Vocabulary::Object, word).map(|f| f.meaning.name.as_str());
    for (word, wants) in [
        ("glasses", Some("Очки")),
        ("wine glasses", Some("Бокал")),
        ("drinking glasses", Some("Стакан")),
        ("beer glasses", None),
        ("waterglass", Some("Стакан")),
        ("ShowerGlass", None),
        ("ShowerDoor", None),
        ("coatrack", Some("Стойка для одежды")),
        ("hanger", Some("Вешалка")),
        ("dish rack", None),
        ("StoveKnob", None),
        ("StoveBurner", Some("Конфорка")),
        ("SinkBasin", None),
        ("LaundryHamperLid", None),
        ("Boots", Some("Сапоги")),
        ("condimentshaker", Some("Баночка для приправ")),
        ("hairproduct", Some("Средство для волос")),
        ("wallphone", Some("Настенный телефон")),
        ("flower pot", None),
        ("table cloth", None),
        ("book end", None),
        ("bed sheet", None),
    ] {
        assert_eq!(name(word), wants, "{word}");
    }
    // Of every word of the table that is joined of two others, the whole is meant.
    for found in ["towel", "glass", "rack", "pot", "board"] {
        for before in ["zig", "coat", "shower"] {
            let word = format!("{before} {found} zag");
            assert_eq!(name(&word), None, "{word}");
        }
    }
}

/// AI2-THOR metadata of a room of 8 x 8 m with upright boxes: word, state, middle x and y, half width, bottom, height, cm.
fn scene(boxes: &[(&str, Option<bool>, [f64; 5])]) -> Source {
    let things = boxes.iter().enumerate().map(|(n, (word, open, [x, y, half, bottom, height]))| {
        let metres = |v: f64| v / 100.0;
        let state = open.map_or(String::new(), |o| format!(r#""openable": true, "isOpen": {o},"#));
        let (x, y, z) = (metres(*x), metres(*y), metres(bottom + height / 2.0));
        let (wide, high) = (metres(2.0 * half), metres(*height));
        format!(
            r#"{{"objectId": "{word}|{n}", "objectType": "{word}", {state} "axisAlignedBoundingBox":
               {{"center": {{"x": {x}, "y": {z}, "z": {y}}}, "size": {{"x": {wide}, "y": {high}, "z": {wide}}}}}}}"#
        )
    });
    let things = things.collect::<Vec<_>>().join(",\n");
    let text = format!(
        r#"{{"sceneName": "FloorPlan1", "objects": [{{"objectId": "Floor", "objectType": "Floor", "axisAlignedBoundingBox":
           {{"center": {{"x": 4, "y": 0, "z": 4}}, "size": {{"x": 8, "y": 0, "z": 8}}}}}},
           {things}]}}"#
    );
    Source::new("scene.json", text)
}

/// The pairs of a relation by the ids of the file, in a world as it was imported.
fn pairs(world: &World, relation: &str) -> BTreeSet<(String, String)> {
    let relations = derive(world, &RelationRules::standard(), world.domain.profile).unwrap();
    let source = |value: &Value| {
        let Value::Symbol(name) = value else { panic!("{value:?}") };
        let thing = world.replicas.values().find(|r| r.name == **name);
        thing.map_or(name.to_string(), |r| r.properties["ИСТОЧНИК"].clone())
    };
    let tuples = relations.tuples(relation).unwrap();
    tuples.into_iter().map(|t| (source(&t[0]), source(&t[1]))).collect()
}

/// A scene through the whole import.
fn imported(source: &Source) -> Imported {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("scene.json");
    std::fs::write(&path, source.text()).unwrap();
    read(&path, &Options::default()).unwrap()
}

/// Numbers that look drawn by lot, the same in every run: 0 up to 1.
fn lots(seed: u64) -> impl FnMut() -> f64 {
    let mut state = seed.wrapping_mul(0x9E37_79B9_7F4A_7C15) | 1;
    move || {
        state ^= state << 13;
        state ^= state >> 7;
        state ^= state << 17;
        (state >> 11) as f64 / (1_u64 << 53) as f64
    }
}

/// Boxes that a person's measuring might have given are surveyed ones, whatever the format; others are detected.
#[test]
fn the_importer_measures_how_loose_the_boxes_are() {
    for seed in 1..=10 {
        for (off, wants) in
            [(0.0, Profile::Surveyed), (1.5, Profile::Surveyed), (7.0, Profile::Detected)]
        {
            let mut lot = lots(seed);
            let mut boxes = Vec::new();
            for n in 0..12 {
                let at = [100.0 + 60.0 * f64::from(n), 100.0 + 50.0 * f64::from(n)];
                boxes.push(("DiningTable", None, [at[0], at[1], 25.0, 0.0, 75.0]));
                let foot = 75.0 + (2.0 * lot() - 1.0) * off;
                boxes.push(("Mug", None, [at[0], at[1], 4.0, foot, 10.0]));
            }
            let made = imported(&scene(&boxes));
            assert_eq!(made.world.domain.profile, wants, "seed {seed}, off by {off}");
            let is_told = made.report.notes.iter().any(|n| n.why.code() == "import::loose_boxes");
            assert_eq!(is_told, wants == Profile::Detected);
        }
    }
}

#[test]
fn scenes_of_others_get_the_profile_of_their_boxes() {
    if let Some(folder) = shared("virtualhome") {
        for n in 1..=3 {
            let path = folder.join(format!("TestScene{n}_graph.json"));
            let made = read(&path, &Options::default()).unwrap();
            assert_eq!(made.world.domain.profile, Profile::Detected, "scene {n}");
            let said = Options { profile: Some(Profile::Surveyed), ..Options::default() };
            assert_eq!(read(&path, &said).unwrap().world.domain.profile, Profile::Surveyed);
        }
    }
    if let Some(folder) = shared("procthor") {
        for n in 0..10 {
            let path = folder.join(format!("house_{n}.json"));
            let made = read(&path, &Options::default()).unwrap();
            assert_eq!(made.world.domain.profile, Profile::Surveyed, "house {n}");
        }
    }
}

/// What the import chose holds in every later command, and in the map file.
#[test]
fn the_store_and_the_map_file_keep_the_profile() {
    let table = ("DiningTable", None, [200.0, 200.0, 40.0, 0.0, 75.0]);
    let mug = ("Mug", None, [200.0, 200.0, 4.0, 81.0, 10.0]);
    let made = imported(&scene(&[table, mug]));
    assert_eq!(made.world.domain.profile, Profile::Detected);
    let text = made.world.to_toml();
    let again = World::parse(&Source::new("again.toml", text.as_str()), Format::Toml).unwrap();
    assert_eq!(again, made.world);
    let wrong = text.replace("\"detected\"", "\"dete\"");
    let refused = World::parse(&Source::new("wrong.toml", wrong), Format::Toml).unwrap_err();
    assert!(!refused.faults.is_empty());

    let dir = tempfile::tempdir().unwrap();
    let change = || change_now("test", "import");
    let mut engine = Engine::open(dir.path(), None).unwrap();
    engine.keep(made, &change()).unwrap();
    drop(engine);
    let engine = Engine::open(dir.path(), None).unwrap();
    assert_eq!(engine.world().unwrap().domain.profile, Profile::Detected);
    assert_eq!(engine.relations().unwrap().profile(), Profile::Detected);
    drop(engine);
    // Relations that were kept under one profile are not those of another.
    let mut engine = Engine::open(dir.path(), None).unwrap();
    let file = dir.path().join("map.toml");
    std::fs::write(&file, text.replace("profile = \"detected\"\n", "")).unwrap();
    engine.import(&file, &change()).unwrap();
    assert_eq!(engine.relations().unwrap().profile(), Profile::Surveyed);
}

/// A foot that is off by anything up to what boxes are off by stands on its table, however the fractions of a millimetre fall.
#[test]
fn a_support_does_not_hang_on_fractions_of_a_millimetre() {
    for step in -48..=197 {
        let foot = 75.0 + f64::from(step) * 0.04;
        let table = ("DiningTable", None, [200.0, 200.0, 40.0, 0.0, 75.0]);
        let pot = ("Pot", None, [200.0, 200.0, 10.0, foot, 20.0]);
        let world = imported(&scene(&[table, pot])).world;
        let found = pairs(&world, "RESTS_ON");
        let wants = BTreeSet::from([("Pot|1".to_owned(), "DiningTable|0".to_owned())]);
        assert_eq!(found, wants, "foot at {foot}");
    }
}

/// Numbers of a flat moved by up to half a millimetre: everything still stands where it stood.
#[test]
fn a_flat_measured_again_has_the_same_supports() {
    let Some(folder) = shared("virtualhome") else { return };
    let all = crate::files::long();
    for n in if all { 1..=3 } else { 2..=2 } {
        let text = file_text(&folder.join(format!("TestScene{n}_graph.json"))).unwrap();
        let graph: serde_json::Value = serde_json::from_str(text.text()).unwrap();
        let before = pairs(&imported(&text).world, "RESTS_ON");
        for seed in 1..=if all { 20 } else { 3 } {
            let (mut moved, mut lot) = (graph.clone(), lots(seed));
            for node in moved["nodes"].as_array_mut().unwrap() {
                if ["Furniture", "Props", "Food", "Decor", "Appliances", "Electronics"]
                    .contains(&node["category"].as_str().unwrap())
                {
                    for axis in 0..3 {
                        let at = &mut node["bounding_box"]["center"][axis];
                        *at = (at.as_f64().unwrap() + (lot() - 0.5) * 0.001).into();
                    }
                }
            }
            let after = imported(&Source::new("moved.json", moved.to_string())).world;
            let after = pairs(&after, "RESTS_ON");
            let flipped: Vec<_> = before.symmetric_difference(&after).collect();
            assert!(flipped.is_empty(), "scene {n}, seed {seed}: {flipped:?}");
        }
    }
}

/// A box that is shut, or that something stands on, bears what is stacked on it and holds what is in it.
#[test]
fn what_is_stacked_on_a_closed_box_stands_on_it() {
    for (state, has_stack) in [(Some(false), true), (None, true), (Some(true), false)] {
        let mut things = vec![
            ("Box", state, [200.0, 200.0, 30.0, 0.0, 40.0]),
            ("Mug", None, [190.0, 200.0, 4.0, 1.0, 10.0]),
        ];
        if has_stack {
            things.push(("Book", None, [200.0, 200.0, 10.0, 40.0, 3.0]));
            things.push(("Book", None, [200.0, 200.0, 10.0, 43.0, 3.0]));
        }
        let world = imported(&scene(&things)).world;
        let on = pairs(&world, "RESTS_ON");
        let is_on = |a: &str, b: &str| on.contains(&(a.to_owned(), b.to_owned()));
        assert!(!has_stack || is_on("Book|2", "Box|0") && is_on("Book|3", "Book|2"), "{on:?}");
        let inside = pairs(&world, "INSIDE");
        assert!(inside.contains(&("Mug|1".to_owned(), "Box|0".to_owned())), "{inside:?}");
        assert!(!inside.contains(&("Book|2".to_owned(), "Box|0".to_owned())), "{inside:?}");
    }
}

/// Rooms drawn over one another: whatever is floor in the file is floor of some room, and of one only.
#[test]
fn no_floor_is_lost_where_rooms_cut_one_another() {
    const CELL: f64 = 50.0;
    for seed in 1..=200 {
        let mut lot = lots(seed);
        let mut below = |n: usize| (lot() * n as f64) as usize;
        let count = 2 + below(4);
        let rooms: Vec<[usize; 4]> =
            (0..count).map(|_| [below(10), below(10), 1 + below(10), 1 + below(10)]).collect();
        let floor = |x: usize, y: usize| {
            rooms.iter().any(|[a, b, w, h]| (*a..a + w).contains(&x) && (*b..b + h).contains(&y))
        };
        let cells = (0..20).flat_map(|x| (0..20).map(move |y| (x, y)));
        let wants = cells.filter(|&(x, y)| floor(x, y)).count() as f64 * CELL * CELL;
        let outline = |[x, y, w, h]: [usize; 4]| {
            let at = |x: usize, y: usize| Point::new(x as f64 * CELL, y as f64 * CELL);
            vec![at(x, y), at(x + w, y), at(x + w, y + h), at(x, y + h)]
        };
        let room = |(n, place): (usize, &[usize; 4])| Room {
            source: format!("{n}"),
            kind: "office".to_owned(),
            outline: outline(*place),
            ..Room::default()
        };
        let level =
            Level { rooms: rooms.iter().enumerate().map(room).collect(), ..Level::default() };
        let survey = Survey { levels: vec![level], ..Survey::default() };
        let mut report = Report::default();
        let world = assemble(&survey, &Synonyms::built_in(), &mut report).unwrap();
        let area = |frame: &Orthoframe| {
            let corners: Vec<Point> = frame.corners().collect();
            let next = corners.iter().cycle().skip(1);
            corners.iter().zip(next).map(|(a, b)| a.x * b.y - b.x * a.y).sum::<f64>() / 2.0
        };
        let items = world.areas.values().flat_map(|a| &a.items);
        let found: f64 = items.map(|item| area(world.orthoframe_of(item))).sum();
        assert!((found - wants).abs() < 0.005 * wants, "seed {seed}: {found} of {wants}\n{report}");
        let taken = report.counts[&What::Room];
        assert!(taken.taken <= taken.found, "{report}");
    }
}
