//! The map: checked, imported, edited, drawn, written out; its store.

use orthoframe_map::World;
use serde_json::Value;

use super::{Place, project, rb2};

#[test]
fn a_map_is_checked_and_imported() {
    let place = Place::empty();
    assert!(place.run(&["check", &rb2()]).is(0).out.contains("Карта исправна"));
    assert!(place.store().is_none(), "a check leaves no store behind");
    let first = place.json(&["import", &rb2()], 0);
    assert_eq!((&first["outcome"], &first["revision"]), (&"imported".into(), &1.into()));
    assert_eq!(first["world"]["areas"], 4);
    assert!(first["world"]["replicas"].as_u64().unwrap() >= 40);
    let again = place.json(&["import", &rb2()], 0);
    assert_eq!((&again["created"], &again["changed"]), (&0.into(), &0.into()));
    let schema: Value = serde_json::from_str(&place.run(&["schema"]).is(0).out).unwrap();
    assert!(schema["properties"]["format"].is_object());
}

#[test]
fn an_impossible_map_is_told_and_strictly_refused() {
    let place = Place::empty();
    let text = std::fs::read_to_string(rb2()).unwrap();
    let fast = place.write("fast.toml", text.replace("speed = 60", "speed = 0.6"));
    let told = place.run(&["check", &fast]).is(0);
    assert!(
        told.out.contains("Карта исправна") && told.err.contains("map::metres"),
        "{}",
        told.err
    );
    let view = place.json(&["check", &fast], 0);
    assert_eq!((&view["outcome"], &view["warnings"]), (&"sound".into(), &1.into()));
    assert_eq!(view["told"][0]["code"], "map::metres");
    let line = text.lines().position(|line| line.starts_with("speed")).unwrap() + 1;
    assert_eq!(view["told"][0]["line"], line);
    let refused = place.json(&["check", &fast, "--strict"], 2);
    assert_eq!(refused["errors"][0]["code"], "map::metres");
    place.run(&["check", &rb2(), "--strict"]).is(0);
}

#[test]
fn the_map_is_edited_told_and_taken_back() {
    let place = Place::with_rb2();
    let tried = place.json(&["edit", "move", "стула-1", "--by", "10,0", "--dry-run"], 0);
    assert_eq!((&tried["outcome"], &tried["revision"]), (&"tried".into(), &Value::Null));
    assert_eq!(tried["differences"][0]["ru"], "экземпляр «Стул-1»: передвинут на 10 см");
    let done = place
        .json(&["edit", "move", "Стул-1", "--by", "10,0", "--user", "Анна", "--reason", "обед"], 0);
    assert_eq!((&done["outcome"], &done["revision"]), (&"edited".into(), &2.into()));
    let last = place.json(&["history", "--last", "1"], 0)["revisions"][0].clone();
    assert_eq!((&last["user"], &last["reason"]), (&"Анна".into(), &"обед".into()));
    let refused = place.json(&["edit", "move", "Стул-1", "--to", "9000,0"], 2);
    assert_eq!(refused["errors"][0]["code"], "map::replica_outside");
    assert_eq!(refused["errors"][0]["line"], 3);
    // Every step that makes something, told in arguments.
    for args in [
        &["orthoframe", "slab", "--rect", "40,30", "--height", "5", "--property", "ЦВЕТ=Серый"][..],
        &["orthoframe", "rod", "--regular", "6,3", "--height", "20"],
        &[
            "object",
            "stand",
            "--name",
            "Подставка",
            "--item",
            "A=slab",
            "--item",
            "B=rod@0,0,5",
            "--link",
            "A.roof=B.base",
        ],
        &[
            "place",
            "Подставка-1",
            "--object",
            "Подставка",
            "--area",
            "Комнату-Z",
            "--at",
            "100,200",
            "--move-prob",
            "70",
        ],
        &["turn", "Подставка-1", "--by", "30"],
        &["set", "Подставка-1", "МАТЕРИАЛ", "Дерево"],
        &["move-prob", "Подставка-1", "90"],
        &[
            "point",
            "Точка-П",
            "--area",
            "Комната-Z",
            "--at",
            "60,200",
            "--heading",
            "0",
            "--serves",
            "Подставка-1",
        ],
        &["state", "Дверь-ВZ", "open", "--opening", "80"],
        &[
            "orthoframe",
            "attic",
            "--points",
            "0,0 300,0 300,300 0,300",
            "--height",
            "240",
            "--side",
            "B=permeable,Проход",
        ],
        &["area", "attic", "--name", "Чердак", "--item", "A=attic"],
        &["rename", "Чердак", "Мансарда", "--en", "Attic"],
    ] {
        let all: Vec<&str> = ["edit"].iter().chain(args).copied().collect();
        place.run(&all).is(0);
    }
    // A Map and its place in the Domain belong together: a file is one transaction.
    let file = place.write(
        "edits.toml",
        "[map.second]\nname = \"Этаж-2\"\nitems = [{ area = \"attic\" }]\n[[edit]]\ninclude = \"second\"\nat = [0, 0, 300]\n",
    );
    place.run(&["edit", "--file", &file]).is(0);
    place.run(&["edit", "lift", "Лестница", "--stops", "Коридор,Мансарда"]).is(0);
    let revisions = place.json(&["history"], 0)["revisions"].as_array().unwrap().len();
    for _ in 1..revisions {
        place.run(&["undo"]).is(0);
    }
    assert_eq!(place.run(&["diff", "1"]).is(0).out.trim(), "Различий нет.");
    place.run(&["undo"]).is(0);
    place.run(&["undo"]).is(2);
    place.run(&["redo"]).is(0);
    place.run(&["edit", "--as-of", "1", "remove", "Стул-1"]).is(2);
    place.run(&["edit", "--read-only", "remove", "Стул-1"]).is(2);
}

#[test]
fn a_store_is_checked_copied_restored_and_asked_of_its_past() {
    let place = Place::with_rb2();
    place.run(&["edit", "move", "Стул-1", "--by", "10,0"]).is(0);
    let chair = |args: &[&str]| {
        let found = place.json(&[&["find", "Стул-1"], args].concat(), 0);
        found["place"]["at"][0].as_f64().unwrap()
    };
    let now = chair(&[]);
    assert_eq!(place.json(&["fsck"], 0)["outcome"], "sound");
    place.run(&["backup", "copy"]).is(0);
    place.run(&["--store", "second", "restore", "copy"]).is(0);
    assert_eq!(place.json(&["--store", "second", "history"], 0), place.json(&["history"], 0));
    place.run(&["restore", "copy"]).is(2);
    let past = World::parse(
        &orthoframe_units::Source::new("past", place.run(&["as-of", "1"]).is(0).out),
        orthoframe_map::Format::Toml,
    );
    let past = past.unwrap().replicas.values().find(|r| r.name == "Стул-1").unwrap().frame.x.get();
    assert!((now - past - 10.0).abs() < 1e-9);
    place.run(&["as-of", "1", "--restore"]).is(0);
    assert!((chair(&[]) - past).abs() < 1e-9);
    // Observations, corrections, and the story of a thing.
    place.json(&["observe", "Стул-1", "--at", "300,300", "--sure", "0.8"], 0);
    assert_eq!(place.json(&["proposals"], 0)["proposals"][0]["name"], "Стул-1");
    place.run(&["reject", "Стул-1"]).is(0);
    assert_eq!(place.json(&["proposals"], 0)["proposals"], serde_json::json!([]));
    place.json(&["observe", "Стул-1", "--at", "310,300"], 0);
    assert_eq!(place.json(&["confirm", "Стул-1"], 0)["revision"], 4);
    assert!((chair(&[]) - 310.0).abs() < 1e-9);
    let story = place.json(&["find", "Стул-1", "--story"], 0)["story"].as_array().unwrap().clone();
    let sources: Vec<&str> = story.iter().map(|s| s["source"].as_str().unwrap()).collect();
    assert_eq!(sources, ["map", "map", "map", "seen", "seen", "map"]);
    place.run(&["gc", "--before", "3"]).is(0);
    place.run(&["diff", "1", "4"]).is(2);
    assert_eq!(place.json(&["fsck", "--read-only"], 0)["outcome"], "sound");
}

#[test]
fn drawings_are_svg() {
    let place = Place::with_rb2();
    for args in [
        &["draw", "map"][..],
        &["draw", "floor"],
        &["draw", "route", "--from", "Точка-А", "--to", "Точка-К"],
    ] {
        let printed = place.run(args).is(0).out;
        assert!(printed.starts_with("<svg") && printed.contains("Комната-В"), "{args:?}");
        place.run(&[args, &["--out", "drawn.svg"]].concat()).is(0);
        let written = std::fs::read_to_string(place.path("drawn.svg")).unwrap();
        assert_eq!(written.trim(), printed.trim());
    }
    let nowhere = place.json(&["draw", "map", "--out", "no/such/folder/x.svg"], 2);
    assert_eq!(nowhere["errors"][0]["code"], "engine::file");
}

/// Each storey of a way has its sheet, headed with its name, and what is done is numbered through.
#[test]
fn a_way_over_storeys_is_drawn_on_a_sheet_for_each() {
    let place = Place::empty();
    let text = std::fs::read_to_string(project("maps/two-storeys.toml")).unwrap();
    let open = text.replace("thickness = 4 }], state = \"closed\"", "thickness = 4 }]");
    assert_ne!(text, open);
    let map = place.write("open.toml", open);
    place.run(&["import", &map]).is(0);
    let way = ["draw", "route", "--from", "Стойка охраны", "--to", "Окно"];
    let refused = place.json(&way, 2);
    assert_eq!(refused["errors"][0]["code"], "draw::many_sheets");
    place.run(&[&way[..], &["-o", "way.svg"]].concat()).is(0);
    let task = ["draw", "route", "--task", "Поезжай на второй этаж", "-o", "task.svg"];
    place.run(&task).is(0);
    for name in ["way", "task"] {
        let sheet = |file: String| std::fs::read_to_string(place.path(&file)).unwrap();
        let (first, second) = (sheet(format!("{name}.svg")), sheet(format!("{name}-2.svg")));
        assert!(first.contains("Первый этаж") && second.contains("Второй этаж"), "{name}");
        // A room's name stands by itself; the list of what is done names rooms of both storeys.
        let shows = |sheet: &str, room: &str| sheet.lines().any(|line| line.trim() == room);
        assert!(shows(&first, "Холл-1") && !shows(&first, "Холл-2"), "{name}");
        assert!(shows(&second, "Холл-2") && !shows(&second, "Холл-1"), "{name}");
        assert!(shows(&first, "Склад") && !second.contains("Склад"), "{name}");
    }
    let way = std::fs::read_to_string(place.path("way-2.svg")).unwrap();
    assert!(way.contains("2. Поднимитесь на лифте"), "{way}");
}

/// What was done is told in words, and not as the rule file names it.
#[test]
fn what_was_done_is_listed_in_the_language_of_the_sheet() {
    let place = Place::with_rb2();
    let task = ["draw", "route", "--task", "Принеси лекарство"];
    let russian = place.run(&task).is(0).out;
    assert!(russian.contains("1. подъехать к "), "{russian}");
    let english = place.run(&[&task[..], &["--lang", "en"]].concat()).is(0).out;
    assert!(english.contains("1. drive to "), "{english}");
}

#[test]
fn what_cannot_be_drawn_is_refused_by_name() {
    let place = Place::with_rb2();
    let code = |args: &[&str]| place.json(args, 2)["errors"][0]["code"].clone();
    for (args, wanted) in [
        (&["draw", "map", "-o", "plan.jpg"][..], "draw::format"),
        (&["draw", "map", "Чердак"], "engine::unknown_name"),
        (&["draw", "floor", "Диван-1"], "engine::unknown_name"),
        (&["draw", "object", "Комната-В"], "engine::unknown_name"),
        (&["draw", "object", ""], "engine::unknown_name"),
        (&["draw", "view", "--at", "-900,0,0"], "engine::nowhere"),
        (&["draw", "view", "--at", "nan,0,0"], "engine::bad_pose"),
        (&["draw", "view", "--at", "300,150,0", "--height", "nan"], "draw::out_of_range"),
        (&["draw", "view", "--at", "300,150,0", "--field", "0"], "draw::out_of_range"),
        (&["draw", "view", "--at", "300,150,0", "--map", "Дача"], "engine::unknown_name"),
        (&["draw", "map", "-o", "."], "engine::file"),
    ] {
        assert_eq!(code(args), wanted, "{args:?}");
    }
    let empty = Place::empty();
    empty.run(&["import", project("maps/box.toml").to_str().unwrap()]).is(0);
    assert_eq!(empty.json(&["draw", "map"], 2)["errors"][0]["code"], "engine::no_maps");
}

/// The faces in view are listed by name, tops among them, and what hides behind a wall is not.
#[test]
fn faces_in_view_are_listed() {
    let place = Place::with_rb2();
    let told = place.run(&["draw", "view", "--at", "300,150,90", "--faces"]).is(0).out;
    assert!(told.contains("Письменный стол") && told.contains("верх"), "{told}");
    assert!(!told.contains("Кровать-1"), "{told}");
    let faces = place.json(&["draw", "view", "--at", "300,150,90", "--faces", "--lang", "en"], 0);
    let faces = faces.as_array().unwrap();
    assert!(faces.iter().any(|f| f["face"].as_str().unwrap().contains("top")), "{faces:?}");
    for face in faces {
        let share = face["area_cm2"].as_f64().unwrap() / face["whole_cm2"].as_f64().unwrap();
        assert!(share > 0.0 && share < 1.0001, "{face}");
    }
}

#[test]
fn the_map_is_written_for_other_programs() {
    let place = Place::with_rb2();
    place.run(&["edit", "move", "Стул-1", "--by", "10,0", "--user", "Анна"]).is(0);
    let told = place.json(
        &[
            &["export", "map.toml", "--geojson", "floors.geojson", "--ros", "ros"][..],
            &["--nav2", "graph.geojson", "--records", "records.json"],
        ]
        .concat(),
        0,
    );
    assert_eq!(told["outcome"], "exported");
    let files: Vec<&str> =
        told["files"].as_array().unwrap().iter().map(|f| f.as_str().unwrap()).collect();
    assert_eq!(files.len(), 6, "{files:?}");
    assert!(files.iter().all(|f| place.path(f).exists()), "{files:?}");

    // The map file is the map: read into a store of its own, and back where it came from.
    place.run(&["--store", "second", "import", "map.toml"]).is(0);
    place.run(&["--store", "second", "export", "again.toml"]).is(0);
    let [first, second] =
        ["map.toml", "again.toml"].map(|f| std::fs::read_to_string(place.path(f)).unwrap());
    assert_eq!(first, second);
    let known = place.json(&["import", "map.toml"], 0);
    assert_eq!((&known["revision"], &known["changed"]), (&2.into(), &0.into()));

    let text = std::fs::read_to_string(place.path("records.json")).unwrap();
    let records: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(records["revision"], 2);
    let tables = &records["tables"];
    let chair: Vec<&Value> = tables["AreaObjects"]
        .as_array()
        .unwrap()
        .iter()
        .filter(|r| r["Name"] == "Стул-1")
        .collect();
    let [before, after] = chair[..] else { panic!("{chair:?}") };
    assert_eq!((&before["Revision"], &after["Revision"]), (&1.into(), &2.into()));
    let [from, to] = [before, after].map(|r| r["X"].as_f64().unwrap());
    assert!((to - from - 10.0).abs() < 1e-9, "{from} {to}");
    assert_eq!(after["RecUser"], "Анна");
    assert_eq!(tables["Revisions"].as_array().unwrap().len(), 2);
    let sides = tables["AreaItemSides"].as_array().unwrap();
    assert!(!sides.is_empty() && sides[0].get("RecDate").is_none(), "{sides:?}");

    let nowhere = place.json(&["export", "--records", "no/such/folder/x.json"], 2);
    assert_eq!(nowhere["errors"][0]["code"], "engine::file");
}
