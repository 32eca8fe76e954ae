//! Reading the dwellings of household simulators: ProcTHOR, AI2-THOR, VirtualHome, pyrobosim.

use std::path::{Path, PathBuf};

use orthoframe::exchange::{
    Assets, OpeningKind, ReadError, SceneFormat, Survey, file_text, read_procthor, read_pyrobosim,
    read_thor, read_virtualhome,
};
use orthoframe::map::DoorStatus;
use orthoframe::units::{Deg, Source};

/// The folder of the data that others made; none, with a word, where it is not there.
#[expect(clippy::print_stdout, reason = "a test that was not made should say so")]
pub(crate) fn shared(folder: &str) -> Option<PathBuf> {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/data").join(folder);
    if path.is_dir() {
        return Some(path);
    }
    println!("skipped: {} is not there", path.display());
    None
}

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
fn a_house_without_sizes_still_has_its_rooms() {
    let Some(folder) = shared("procthor") else { return };
    let text = file_text(&folder.join("house_0.json")).unwrap();
    let survey = read_procthor(&text, &Assets::default()).unwrap();
    assert_eq!(counts(&survey), (4, 5, 2, 0));
    assert_eq!(survey.remarks.len(), 1);
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
            assert!(survey.remarks.iter().all(|r| r.text.contains("на том же месте")));
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
