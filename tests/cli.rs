//! The program as it is run: answers, exit codes, and what wrong input comes to.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};

use orthoframe::map::World;
use orthoframe::store::Store;
use serde_json::Value;
use tempfile::TempDir;

const AT_THE_DOOR: &str = "Я нахожусь в Комнате-В у двери, ведущей из Комнаты-В в Комнату-Z.";

fn project(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// A working directory of its own, with a store in it.
struct Place {
    dir: TempDir,
}

/// What a run came to.
struct Run {
    code: i32,
    out: String,
    err: String,
}

impl Place {
    fn empty() -> Self {
        Self { dir: tempfile::tempdir().unwrap() }
    }

    fn with_rb2() -> Self {
        let place = Self::empty();
        place.run(&["import", &rb2()]).is(0);
        place
    }

    fn path(&self, name: &str) -> PathBuf {
        self.dir.path().join(name)
    }

    fn write(&self, name: &str, text: impl AsRef<[u8]>) -> String {
        let path = self.path(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
        path.display().to_string()
    }

    fn command(&self, args: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ortho"));
        command.current_dir(self.dir.path()).args(args).stdin(Stdio::null());
        for name in ["ORTHO_STORE", "ORTHO_RULES", "ORTHO_USER"] {
            command.env_remove(name);
        }
        command
    }

    fn run(&self, args: &[&str]) -> Run {
        let output = self.command(args).output().unwrap();
        let text = |bytes: Vec<u8>| String::from_utf8(bytes).expect("ortho writes UTF-8");
        let code = output.status.code().expect("ortho ends by itself");
        let run = Run { code, out: text(output.stdout), err: text(output.stderr) };
        assert!(!run.err.contains("panicked"), "{args:?}: {}", run.err);
        run
    }

    fn json(&self, args: &[&str], code: i32) -> Value {
        let args: Vec<&str> = args.iter().copied().chain(["--json"]).collect();
        let run = self.run(&args).is(code);
        assert_eq!(run.out.lines().count(), 1, "{args:?}: {}", run.out);
        serde_json::from_str(&run.out).expect("one JSON value a line")
    }

    /// What the store holds: its revision and its world.
    fn store(&self) -> Option<(u64, Option<World>)> {
        let dir = self.path("ortho-store");
        let (store, _) = dir.is_dir().then(|| Store::open_read_only(dir).unwrap())?;
        Some((store.revision(), store.world().unwrap()))
    }
}

impl Run {
    #[track_caller]
    fn is(self, code: i32) -> Self {
        assert_eq!(self.code, code, "{}{}", self.out, self.err);
        self
    }
}

fn rb2() -> String {
    project("maps/rb2.toml").display().to_string()
}

fn walk() -> String {
    project("rules/scenarios/medicine-walk.strips").display().to_string()
}

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
fn relations_answer_to_both_names() {
    let place = Place::with_rb2();
    let counts = place.json(&["relations"], 0);
    assert!(counts["relations"].as_array().unwrap().len() > 20);
    let facts = |args: &[&str]| place.json(args, 0)["facts"].clone();
    let russian = facts(&["relations", "--name", "НАХОДИТСЯ_СВЕРХУ_НА"]);
    assert_eq!(russian, facts(&["relations", "--name", "ON_TOP_OF"]));
    let medicine = serde_json::json!(
        {"relation": "НАХОДИТСЯ_СВЕРХУ_НА", "args": ["Лекарство", "Тумбочка-2"]}
    );
    assert!(russian.as_array().unwrap().contains(&medicine), "{russian}");
    let of_medicine = facts(&["relations", "--of", "Лекарство"]);
    assert!(of_medicine.as_array().unwrap().contains(&medicine), "{of_medicine}");
    // Another case, another alphabet, other letters.
    for name in ["лекарства", "Medicine", "ЛЕКАРСТВОМ"] {
        assert_eq!(facts(&["relations", "--of", name]), of_medicine, "{name}");
    }
    let both = facts(&["relations", "--name", "ON_TOP_OF", "--of", "Лекарство"]);
    assert_eq!(both, serde_json::json!([medicine]));
}

#[test]
fn the_papers_walk_is_planned() {
    let place = Place::with_rb2();
    let action =
        |action: &str, args: &[&str]| serde_json::json!([{"action": action, "args": args}]);
    let steps = serde_json::json!([
        action("Движение-в_от-места_до-двери", &["Комната-В", "Точка-А", "Дверь-ВZ"]),
        action("Движение-из_в_через-дверь", &["Комната-В", "Комната-Z", "Дверь-ВZ"]),
        action("Движение-в_от-двери_до-двери", &["Комната-Z", "Дверь-ВZ", "Дверь-ZY"]),
        action("Движение-из_в_через-дверь", &["Комната-Z", "Комната-Y", "Дверь-ZY"]),
        action("Движение-в_от-двери_до-места", &["Комната-Y", "Дверь-ZY", "Точка-К"]),
    ]);
    let stored = ["--store", "ortho-store"];
    let walk = walk();
    for extra in [&stored[..], &[]] {
        let args = [&["plan", walk.as_str()], extra].concat();
        let plan = place.json(&args, 0);
        assert_eq!(plan["outcome"], "plan");
        assert_eq!(plan["parallel_steps"], 5);
        assert_eq!(plan["steps"], steps);
    }
    let text = place.run(&["plan", &walk, "--out", "plan.txt"]).is(0).out;
    assert!(
        text.contains("5. Движение-в_от-двери_до-места_(Комната-Y, Дверь-ZY, Точка-К)"),
        "{text}"
    );
    let written = std::fs::read_to_string(place.path("plan.txt")).unwrap();
    assert_eq!(written.matches("Движение").count(), 5, "{written}");
}

#[test]
fn a_given_plan_is_checked_step_by_step() {
    let place = Place::with_rb2();
    let walk = walk();
    place.run(&["plan", &walk, "--out", "plan.txt"]).is(0);
    let sound = place.run(&["plan", &walk, "--check", "plan.txt"]).is(0).out;
    assert!(sound.contains("План верен: шагов 5, действий 5, стоимость 5."), "{sound}");
    let written = std::fs::read_to_string(place.path("plan.txt")).unwrap();
    // Without its third step the plan breaks at what was the fourth; without the last it misses the goal.
    let without = |step: &str| -> String {
        written
            .lines()
            .filter(|line| !line.starts_with(step))
            .fold(String::new(), |text, line| text + line + "\n")
    };
    place.write("gap.txt", without("2:"));
    let broken = place.run(&["plan", &walk, "--check", "gap.txt"]).is(1).out;
    assert!(broken.contains("План обрывается на шаге 3:"), "{broken}");
    assert!(broken.contains("gap.txt:3:4: действие невыполнимо: не выполнено"), "{broken}");
    let view = place.json(&["plan", &walk, "--check", "gap.txt"], 1);
    assert_eq!((&view["outcome"], &view["broken"]["step"]), (&"broken".into(), &3.into()));
    assert_eq!(view["broken"]["faults"][0]["code"], "strips::plan_precondition");
    assert_eq!(view["steps"].as_array().unwrap().len(), 2);
    place.write("short.txt", without("4:"));
    let missed = place.run(&["plan", &walk, "--check", "short.txt"]).is(1).out;
    assert!(missed.contains("цели не достигает"), "{missed}");
    place.write("no-plan.txt", "0: (Движение");
    place.run(&["plan", &walk, "--check", "no-plan.txt"]).is(2);
}

#[test]
fn a_plan_of_another_planner_is_checked_on_pddl() {
    let place = Place::empty();
    let case = |name: &str| {
        project(&format!("tests/golden/planning/pddl_gripper/{name}")).display().to_string()
    };
    let (domain, problem) = (case("domain.pddl"), case("problem.pddl"));
    let given = ["plan", "--domain", &domain, "--problem", &problem];
    place.run(&[&given[..], &["--out", "plan.txt"]].concat()).is(0);
    let sound = place.json(&[&given[..], &["--check", "plan.txt"]].concat(), 0);
    assert_eq!((&sound["outcome"], &sound["broken"]), (&"sound".into(), &Value::Null));
    // As sequential planners write: without numbers, in capitals.
    let written = std::fs::read_to_string(place.path("plan.txt")).unwrap();
    let alone = |line: &str| line.split_once(": ").map(|(_, action)| action.to_uppercase() + "\n");
    place.write("serial.txt", written.lines().filter_map(alone).collect::<String>());
    place.run(&[&given[..], &["--check", "serial.txt"]].concat()).is(0);
}

#[test]
#[expect(clippy::print_stdout, reason = "a skipped test says so")]
fn no_plan_is_the_answer_no() {
    let folder = project("../shared/data/homebot");
    if !folder.is_dir() {
        println!("skipped: there is no {}", folder.display());
        return;
    }
    let place = Place::empty();
    let domain = folder.join("domain.pddl").display().to_string();
    for name in ["u1", "u2", "u3"] {
        let problem = folder.join(format!("{name}.pddl")).display().to_string();
        let plan = place.json(&["plan", "--domain", &domain, "--problem", &problem], 1);
        assert_eq!((&plan["outcome"], &plan["parallel_steps"]), (&"no_plan".into(), &0.into()));
        assert!(plan["explanation"].as_str().is_some_and(|why| !why.is_empty()), "{name}");
    }
}

#[test]
fn a_goal_behind_a_locked_door_is_the_answer_no() {
    let place = Place::empty();
    let map = std::fs::read_to_string(rb2()).unwrap();
    let locked = map.replace(r#"state = "open""#, r#"state = "locked""#);
    let locked = locked.replace(
        "width = 100\nheight = 205\nleaves = [{ hinge = \"left\", share = 1, thickness = 4, max_open = 100 }]\nstate = \"closed\"",
        "width = 100\nheight = 205\nleaves = [{ hinge = \"left\", share = 1, thickness = 4, max_open = 100 }]\nstate = \"locked\"",
    );
    assert_ne!(locked, map);
    place.run(&["import", &place.write("locked.toml", locked)]).is(0);
    let done = place.json(&["do", "Принеси лекарство"], 1);
    assert_eq!(done["outcome"], "no_plan");
    assert!(done["plan"]["explanation"].as_str().unwrap().contains("Дверь"), "{done}");
    let route = place.json(&["route", "--from", "Точка-А", "--to", "Точка-К"], 1);
    assert_eq!(route["outcome"], "no_route");
    let why = route["explanation"].as_str().unwrap();
    assert!(why.to_lowercase().contains("двер"), "{why}");
    place.run(&["draw", "route", "--from", "Точка-А", "--to", "Точка-К"]).is(1);
}

#[test]
fn a_task_is_carried_out() {
    let place = Place::with_rb2();
    let done = place.json(&["do", "Принеси лекарство", "--draw", "way/plan.svg"], 0);
    assert_eq!((&done["outcome"], &done["replans"]), (&"done".into(), &0.into()));
    let directives = done["directives"].as_array().unwrap();
    assert!(directives.iter().any(|d| d["ru"] == AT_THE_DOOR), "{done}");
    assert!(directives.iter().all(|d| d["en"].is_string()));
    assert!(std::fs::read_to_string(place.path("way/plan.svg")).unwrap().contains("<svg"));
    let text = place.run(&["do", "Bring the medicine", "--lang", "en", "--reset"]).is(0).out;
    assert!(text.contains("Done:"), "{text}");
    assert!(text.contains("I am in Room V at the door leading from Room V to Room Z."), "{text}");
    let misheard = place.json(&["do", "Станцуй вальс"], 2);
    assert_eq!(misheard["outcome"], "error");
}

#[test]
fn the_robot_goes_on_from_where_its_last_task_left_it() {
    let place = Place::with_rb2();
    let start = place.json(&["where"], 0);
    assert_eq!(start["area"], "Комната-В");
    let gone = place.json(&["do", "Поезжай в Комнату-Y"], 0);
    let stands = place.json(&["where"], 0);
    assert_eq!((&stands["area"], &stands["pose"]), (&"Комната-Y".into(), &gone["end"]));
    // What it takes is off the map's places for it, and stays in its hand until it puts it down.
    place.json(&["do", "Возьми лекарство"], 0);
    assert_eq!(place.json(&["find", "Лекарство"], 0)["carried"], "");
    assert_eq!(place.json(&["do", "Возьми лекарство"], 0)["outcome"], "already_true");
    let put = place.json(&["do", "Положи лекарство на Тумбочку-1"], 0);
    assert_eq!(put["end"], place.json(&["do", "Возьми лекарство", "--read-only"], 0)["start"]);
    assert_eq!(place.json(&["find", "Лекарство"], 0)["carried"], Value::Null);
    // The survey knows nothing of all that.
    assert_eq!(place.json(&["history"], 0)["revisions"].as_array().unwrap().len(), 1);
    let again = place.json(&["do", "Поезжай в Комнату-Y", "--reset"], 0);
    assert_eq!(again["start"], start["pose"]);
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
        &orthoframe::units::Source::new("past", place.run(&["as-of", "1"]).is(0).out),
        orthoframe::map::Format::Toml,
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
fn ways_are_found_between_names_in_any_case() {
    let place = Place::with_rb2();
    let length = |from: &str, to: &str| {
        let route = place.json(&["route", "--from", from, "--to", to], 0);
        assert_eq!(route["outcome"], "route");
        assert!(route["points"].as_array().unwrap().len() >= 2);
        route["length_cm"].as_f64().unwrap()
    };
    let plain = length("Точка-А", "Точка-К");
    assert!((600.0..1500.0).contains(&plain));
    // Another case, small letters, a Latin A; and the numbers that the name stands for.
    for from in ["Точки-А", "точка-а", "Точка-A", "Point A", "330,150"] {
        assert!((length(from, "Точку-К") - plain).abs() < 0.01, "{from}");
    }
    assert!(length("Комнаты-В", "Комнату-Y") > 300.0);
    let text = place.run(&["route", "--from", "Точка-А", "--to", "Комната-Y"]).is(0).out;
    assert!(text.contains("Комната-В → Дверь-ВZ → Комната-Z → Дверь-ZY → Комната-Y"), "{text}");
    let fault = |args: &[&str]| place.json(args, 2)["errors"][0].clone();
    let near = fault(&["route", "--from", "Точка-Ы", "--to", "Точка-К"]);
    assert_eq!(near["code"], "engine::unknown_name");
    assert!(near["help"].as_str().unwrap().contains("Точка-"), "{near}");
    for pose in ["NaN,1", "1e300,5", "-inf,2"] {
        let bad = fault(&["route", "--from", pose, "--to", "Точка-К"]);
        assert_eq!(bad["code"], "engine::bad_pose", "{pose}");
    }
    assert_eq!(fault(&["route", "--from", "", "--to", "Точка-К"])["code"], "engine::unknown_name");
    assert_eq!(
        fault(&["route", "--from", "-500,-500", "--to", "Точка-К"])["code"],
        "engine::nowhere"
    );
}

#[test]
fn a_name_is_declined_and_its_sources_are_told() {
    let place = Place::empty();
    let form = |view: &Value, case: &str, number: &str| {
        let forms = view["forms"].as_array().unwrap();
        let found = forms.iter().find(|f| f["case"] == case && f["number"] == number).unwrap();
        (found["form"].as_str().unwrap().to_owned(), found["source"].as_str().unwrap().to_owned())
    };
    let room = place.json(&["words", "Комната-В"], 0);
    assert_eq!(form(&room, "genitive", "singular"), ("Комнаты-В".into(), "list".into()));
    assert_eq!(form(&room, "instrumental", "plural").0, "Комнатами-В");
    assert_eq!((&room["gender"], &room["certain"]), (&"feminine".into(), &true.into()));
    assert_eq!(room["prepositions"]["where"], "в Комнате-В");
    assert_eq!(room["prepositions"]["about"], "о Комнате-В");
    let gate = place.json(&["words", "ворота"], 0);
    assert_eq!((&gate["number"], gate["forms"].as_array().unwrap().len()), (&"plural".into(), 6));
    let closet = place.json(&["words", "шкаф"], 0);
    assert_eq!(closet["prepositions"]["where"], "в шкафу");
    assert_eq!(closet["prepositions"]["about"], "о шкафе");
    let made_up = place.json(&["words", "шмурдяга"], 0);
    assert_eq!(
        (&made_up["certain"], &made_up["sources"][0]["source"]),
        (&false.into(), &"guess".into())
    );
    assert!(place.run(&["words", "шмурдяга"]).is(0).out.contains("шмурдягой"));
    for bad in ["", " ", "—", "\u{1f916}"] {
        assert_eq!(place.json(&["words", bad], 2)["errors"][0]["code"], "engine::unknown_name");
    }
    place.run(&["words", &"Ё-".repeat(10_000)]).is(0);
    // With a store the forms of its map come first.
    let place = Place::with_rb2();
    let door = place.json(&["words", "Входная дверь"], 0);
    assert_eq!(form(&door, "instrumental", "singular"), ("Входной дверью".into(), "map".into()));
}

#[test]
fn names_with_guessed_forms_are_listed() {
    let place = Place::empty();
    let map = std::fs::read_to_string(rb2()).unwrap();
    let before = place.json(&["check", &rb2()], 0)["uncertain_names"].as_array().unwrap().len();
    let named = map.replacen("name = \"Комната-В\"", "name = \"Шмурдяга\"", 1);
    assert_ne!(named, map);
    let file = place.write("odd.toml", &named);
    let after = place.json(&["check", &file], 0);
    let names = after["uncertain_names"].as_array().unwrap();
    assert_eq!(names.len(), before + 1);
    assert!(names.iter().any(|n| n["name"] == "Шмурдяга" && n["genitive"] == "Шмурдяги"));
    assert!(place.run(&["check", &file]).is(0).out.contains("Шмурдяга (нет Шмурдяги)"));
}

#[test]
fn a_pose_is_told_in_words() {
    let place = Place::with_rb2();
    let says = |args: &[&str]| place.run(args).is(0).out.trim().to_owned();
    assert_eq!(says(&["where", "--map", "Квартира РБ-2", "--at", "225,395"]), AT_THE_DOOR);
    assert_eq!(
        says(&["where", "--at", "225,395", "--lang", "en"]),
        "I am in Room V at the door leading from Room V to Room Z."
    );
    let read = place.json(&["where", "--read", AT_THE_DOOR, "--at", "225,395"], 0);
    assert_eq!((&read["claim"], &read["area"]), (&"at_door".into(), &"Комната-В".into()));
    assert_eq!(read["contains"], true);
    assert!(read["square_m2"].as_f64().unwrap() > 0.5);
    place.run(&["where", "--read", AT_THE_DOOR, "--at", "60,60"]).is(1);
    for (text, code) in [
        ("", "engine::no_report"),
        ("Я нахожусь на Луне.", "engine::no_report"),
        ("Я нахожусь вне карты.", "engine::no_such_place"),
        ("Я в Комнате-Z рядом с Лекарством", "engine::no_such_place"),
    ] {
        let fault = place.json(&["where", "--read", text], 2);
        assert_eq!(fault["errors"][0]["code"], code, "{text}");
    }
    let whereabout = place.json(&["where", "--at", "225,395,90"], 0);
    assert_eq!(whereabout["area"], "Комната-В");
    assert_eq!(whereabout["spot"]["kind"], "at_door");
    assert_eq!(whereabout["spot"]["way"]["door"], "Дверь-ВZ");
    for (at, code) in [
        ("", "engine::bad_pose"),
        ("1", "engine::bad_pose"),
        ("1,2,3,4", "engine::bad_pose"),
        ("NaN,1", "engine::bad_pose"),
        ("1e999,1", "engine::bad_pose"),
        ("-100000,1", "engine::nowhere"),
    ] {
        let fault = place.json(&["where", "--at", at], 2);
        assert_eq!(fault["errors"][0]["code"], code, "{at}");
        assert!(fault["errors"][0]["help"].is_string(), "{at}");
    }
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

#[test]
fn the_demo_does_the_main_job() {
    let place = Place::empty();
    let told = place.run(&["demo"]).is(0).out;
    for words in ["НАХОДИТСЯ_СВЕРХУ_НА", AT_THE_DOOR, "Передать_(Лекарство", "Сделано", "plan.svg"]
    {
        assert!(told.contains(words), "{words} is missing in {told}");
    }
    let drawing = std::fs::read_to_string(place.path("demo/plan.svg")).unwrap();
    assert!(drawing.contains("<svg"));
    assert!(place.store().is_none(), "without a directory, no store is kept");
    let kept = place.json(&["demo", "kept"], 0);
    assert_eq!(kept["outcome"], "done");
    assert_eq!(place.json(&["--store", "kept", "where", "--at", "225,395"], 0)["ru"], AT_THE_DOOR);
}

/// Wrong input: exit code 2, a remedy, the store untouched; gives the first fault.
fn refused(place: &Place, args: &[&str]) -> Value {
    let before = place.store();
    let text = place.run(args).is(2);
    assert!(text.err.contains("help:"), "{args:?} offers no remedy: {}", text.err);
    let fault = place.json(args, 2);
    assert_eq!(fault["outcome"], "error");
    let first = fault["errors"][0].clone();
    assert!(first["help"].as_str().is_some_and(|h| !h.is_empty()), "{args:?}: {fault}");
    assert!(place.store() == before, "{args:?} changed the store");
    first
}

/// A fault with a place in the text.
fn refused_at_place(place: &Place, args: &[&str]) -> Value {
    let fault = refused(place, args);
    assert!(fault["line"].as_u64().is_some_and(|n| n > 0), "{args:?}: {fault}");
    assert!(fault["column"].as_u64().is_some_and(|n| n > 0), "{args:?}: {fault}");
    assert!(fault["file"].is_string(), "{args:?}: {fault}");
    fault
}

#[test]
fn broken_maps_leave_the_store_as_it_was() {
    let place = Place::with_rb2();
    let map = std::fs::read_to_string(rb2()).unwrap();
    let broken = |name: &str, from: &str, to: &str, code: &str| {
        let text = map.replacen(from, to, 1);
        assert_ne!(text, map, "{name}: rb2 has no such text");
        let file = place.write(name, text);
        for command in ["import", "check"] {
            refused_at_place(&place, &[command, &file]);
            let all = place.json(&[command, &file], 2)["errors"].clone();
            let all = all.as_array().unwrap();
            let ours = all.iter().find(|fault| fault["code"] == code);
            let ours = ours.unwrap_or_else(|| panic!("{name}: {all:#?}"));
            assert!(ours["line"].is_u64() && ours["column"].is_u64(), "{name}: {ours}");
        }
    };
    broken(
        "unclosed.toml",
        "rect = [90, 30]\nheight = 10",
        r#"sides = [
  { id = "A", from = [0, 0], to = [90, 0] },
  { id = "B", from = [90, 0], to = [90, 30] },
  { id = "C", from = [90, 30], to = [0, 30] },
  { id = "D", from = [0, 30], to = [0, 5] },
]
height = 10"#,
        "map::base_not_closed",
    );
    // The passage of the corridor, narrower than that of the room.
    broken("lengths.toml", "[0, 170], [0, 60]]", "[0, 160], [0, 60]]", "map::link_length");
    // A table top sunk into the cabinet below it; a room on a room.
    broken(
        "sunk.toml",
        r#""counter-top", at = [0, 0, 87]"#,
        r#""counter-top", at = [0, 0, 80]"#,
        "map::items_overlap",
    );
    broken(
        "rooms.toml",
        r#""corridor", at = [560, 0]"#,
        r#""corridor", at = [500, 0]"#,
        "map::areas_overlap",
    );
}

#[test]
fn rubbish_is_refused_wherever_it_stands() {
    let place = Place::with_rb2();
    let rubbish: Vec<u8> =
        (0..4000_u32).map(|i| (i.wrapping_mul(2_654_435_761) >> 24) as u8).collect();
    let long = format!("format = 1 # {}\n", "а".repeat(50_000_000));
    std::fs::create_dir(place.path("folder")).unwrap();
    let files = [
        place.write("rubbish", rubbish),
        place.write("empty", ""),
        place.write("long", long),
        place.path("folder").display().to_string(),
    ];
    for file in &files {
        refused(&place, &["import", file]);
        refused(&place, &["plan", file]);
        refused(&place, &["demo", "--map", file]);
        let rules = place.path("rules-of-mine");
        for name in ["relations.dl", "service-robot.strips"] {
            let _ = std::fs::remove_dir_all(&rules);
            std::fs::create_dir(&rules).unwrap();
            if Path::new(file).is_dir() {
                std::fs::create_dir(rules.join(name)).unwrap();
            } else {
                std::fs::hard_link(file, rules.join(name)).unwrap();
            }
            refused(&place, &["--rules", "rules-of-mine", "do", "Принеси лекарство"]);
        }
        std::fs::remove_dir_all(&rules).unwrap();
    }
    for args in [
        &["import", "missing"][..],
        &["check", "missing"],
        &["plan", "missing"],
        &["--rules", "missing", "relations"],
        &["--store", "missing", "relations"],
        &["--store", "rubbish", "relations"],
        &["--store", "folder/..", "relations"],
    ] {
        refused(&place, args);
    }
    assert!(!place.path("missing").exists());
}

#[test]
fn scenarios_and_rules_are_refused_at_their_place() {
    let place = Place::with_rb2();
    let scenario = std::fs::read_to_string(walk()).unwrap();
    let scenario = scenario
        .replace(
            "../service-robot.strips",
            &project("rules/service-robot.strips").display().to_string(),
        )
        .replace("../../maps/rb2.toml", &rb2());
    let unknown = place.write("unknown.strips", scenario.replace("Комната-Y", "Комната-Ъ"));
    let goal = place
        .write("goal.strips", scenario.replacen("(Точка-К, Комната-Y)", "(Точка-К, Комната-Ъ)", 1));
    for file in [&unknown, &goal] {
        for args in [&["plan", file][..], &["--store", "ortho-store", "plan", file]] {
            let fault = refused_at_place(&place, args);
            assert_eq!(fault["code"], "strips::unknown_object", "{fault}");
            assert!(fault["message"].as_str().unwrap().contains("Комната-Ъ"), "{fault}");
        }
    }
    let rules = std::fs::read_to_string(project("rules/service-robot.strips")).unwrap();
    let undeclared = rules.replacen(
        "(Эффект+: РОБОТ-НАХОДИТСЯ-У-ДВЕРИ_(дверь ?y)",
        "(Эффект+: РОБОТ-НАХОДИТСЯ-У-ДВЕРИ_(дверь ?q)",
        1,
    );
    assert_ne!(rules, undeclared);
    place.write("mine/service-robot.strips", undeclared);
    let fault = refused_at_place(&place, &["--rules", "mine", "do", "Принеси лекарство"]);
    assert_eq!(fault["code"], "strips::undeclared_variable");
    let relations = std::fs::read_to_string(project("rules/relations.dl")).unwrap();
    place.write(
        "other/relations.dl",
        relations + "\n.decl ДАЛЬ(x: symbol)\nДАЛЬ(y) :- profile(_).\n",
    );
    let fault = refused_at_place(&place, &["--rules", "other", "relations"]);
    assert_eq!(fault["code"], "facts::ungrounded");
}

#[test]
fn a_store_in_use_is_left_alone() {
    let place = Place::with_rb2();
    let (held, _) = Store::open(place.path("ortho-store")).unwrap();
    for args in [&["relations"][..], &["import", &rb2()], &["where", "--at", "225,395"]] {
        let run = place.run(args).is(2);
        assert!(
            run.err.contains("открыто другой программой") && run.err.contains("help:"),
            "{}",
            run.err
        );
        assert_eq!(place.json(args, 2)["errors"][0]["code"], "store::locked");
    }
    drop(held);
    place.run(&["relations"]).is(0);
}

#[test]
fn wrong_arguments_are_wrong_input() {
    let place = Place::with_rb2();
    for args in [
        &[][..],
        &["fly"],
        &["route", "--from", "Точка-А"],
        &["plan"],
        &["plan", "a.strips", "--time-limit", "-1"],
        &["relations", "--lang", "fr"],
        &["draw"],
    ] {
        place.run(args).is(2);
    }
    place.run(&["--help"]).is(0);
    for args in [
        &["relations", "--name", "НАХОДИТСЯ_СВЕРХУ"][..],
        &["relations", "--name", ""],
        &["relations", "--of", "Лекарствво"],
        &["relations", "--of", ""],
        &["do", ""],
        &["where", "--map", "Дача", "--at", "1,1"],
        &["route", "--from", "Точка-А", "--to", "Квартира РБ-2"],
    ] {
        refused(&place, args);
    }
}

#[test]
fn a_reader_that_leaves_early_is_no_fault() {
    let place = Place::with_rb2();
    for args in [&["relations"][..], &["draw", "map"], &["do", "Принеси лекарство"], &["schema"]]
    {
        let mut child =
            place.command(args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
        drop(child.stdout.take());
        let output = child.wait_with_output().unwrap();
        let err = String::from_utf8_lossy(&output.stderr);
        assert!(!err.contains("panicked"), "{args:?}: {err}");
        assert_eq!(output.status.code(), Some(0), "{args:?}: {err}");
    }
}

#[test]
fn corridors_are_told_by_entrances() {
    let place = Place::with_rb2();
    let paper = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/corridor-paper4.toml");
    let way = ["corridor", paper, "--from", "201", "--last", "1,0", "--to", "210"];
    let one = place.json(&way, 0);
    let two = place.json(&[&way[..], &["--variant", "2"]].concat(), 0);
    assert_eq!(one["steps"], two["steps"]);
    let told: Vec<&str> =
        one["steps"].as_array().unwrap().iter().map(|s| s["ru"].as_str().unwrap()).collect();
    assert_eq!(
        told[..4],
        [
            "разворот",
            "движение до двери справа",
            "движение до соединения коридоров",
            "поворот направо"
        ]
    );
    let english = place.run(&[&way[..], &["--lang", "en"]].concat()).is(0).out;
    assert!(english.contains("U-turn") || english.contains("turn"), "{english}");
    let unknown = place.json(&["corridor", paper, "--from", "201", "--to", "999"], 2);
    assert!(unknown["errors"][0]["code"].as_str().unwrap().starts_with("corridor::"), "{unknown}");
    place.run(&["corridor", "--map", "flat", "--from", "Комната-В", "--to", "Комната-Y"]).is(0);
    let drawn = place.run(&["draw", "corridor", paper, "--from", "201", "--to", "210"]).is(0).out;
    assert!(drawn.starts_with("<svg"));
}

#[test]
fn a_datalog_program_runs_on_files() {
    let place = Place::empty();
    let program = place.write(
        "reach.dl",
        ".decl door(a: symbol, b: symbol)\n.input door\n.decl reach(a: symbol, b: symbol)\n.output reach\n\
         reach(a, b) :- door(a, b).\nreach(a, c) :- reach(a, b), door(b, c).\n"
            ,
    );
    place.write("door.facts", "кухня\tзал\nзал\tспальня\n");
    place.run(&["datalog", &program, "-F", ".", "-D", "."]).is(0);
    let reached = std::fs::read_to_string(place.path("reach.csv")).unwrap();
    assert!(reached.contains("кухня\tспальня"), "{reached}");
    let faulty = place.write("faulty.dl", ".decl p(a: symbol)\np(X) :- q(X).\n");
    let faults = place.json(&["datalog", &faulty], 2)["errors"].clone();
    let at = |f: &Value| (f["line"].as_u64(), f["column"].as_u64());
    assert!(faults.as_array().unwrap().iter().any(|f| at(f) == (Some(2), Some(9))), "{faults}");
}

#[test]
fn why_and_why_not_go_down_to_the_measurements() {
    let place = Place::with_rb2();
    let facts = place.run(&["relations", "--name", "ON_TOP_OF", "--json"]).is(0);
    let facts: Value = serde_json::from_str(&facts.out).unwrap();
    let one = &facts["facts"][0]["args"];
    let (upper, lower) = (one[0].as_str().unwrap(), one[1].as_str().unwrap());
    let why = place.run(&["why", &format!("НАХОДИТСЯ_СВЕРХУ_НА({upper}, {lower})")]).is(0);
    assert!(why.out.starts_with("НАХОДИТСЯ_СВЕРХУ_НА("), "{}", why.out);
    assert!(why.out.contains("over(") && why.out.contains("Gap <= Up: "), "{}", why.out);

    let english =
        place.run(&["why", "--lang", "en", &format!("on_top_of({upper}, \"{lower}\")")]).is(0);
    assert!(
        english.out.starts_with("ON_TOP_OF(") && english.out.contains("RESTS_ON("),
        "{}",
        english.out
    );

    // The other way round it does not hold: the nearest rule, and below it what failed.
    let swapped = format!("ON_TOP_OF({lower}, {upper})");
    let why_not = place.run(&["why", "--not", &swapped]).is(0);
    assert!(why_not.out.contains("- bears(") && why_not.out.contains("- over("), "{}", why_not.out);
    let json = place.run(&["why", "--not", "--json", &swapped]);
    let json: Value = serde_json::from_str(&json.out).unwrap();
    assert_eq!(json["holds"], false);
    let failed = &json["nearest"]["premises"][0];
    assert!(failed["holds"] == false && failed["nearest"]["premises"].is_array(), "{json}");

    place.run(&["why", &swapped]).is(1);
    place.run(&["why", "--not", &format!("ON_TOP_OF({upper}, {lower})")]).is(1);
    let wrong = place.run(&["why", "Чашка на столе"]).is(2);
    assert!(wrong.err.contains("не читается как факт"), "{}", wrong.err);
}

#[test]
fn relations_are_kept_in_the_store_for_its_map_and_rules() {
    let place = Place::with_rb2();
    let derived = place.run(&["relations", "--name", "NEXT_TO"]).is(0).out;
    let kept = place.path("ortho-store").join("derived/relations");
    let bytes = std::fs::read(&kept).unwrap_or_else(|_| panic!("{} is there", kept.display()));
    assert_eq!(place.run(&["relations", "--name", "NEXT_TO"]).is(0).out, derived);
    assert_eq!(std::fs::read(&kept).unwrap(), bytes);

    // Other rules: what was kept does not count.
    let rules = std::fs::read_to_string(project("rules/relations.dl")).unwrap();
    place.write(
        "rules/relations.dl",
        rules.replace(
            "limit(\"common\",   \"next most\",         6000)",
            "limit(\"common\",   \"next most\",         0)",
        ),
    );
    assert_ne!(place.run(&["relations", "--name", "NEXT_TO"]).is(0).out, derived);
    assert_ne!(std::fs::read(&kept).unwrap(), bytes);
    // Broken bytes: derived anew.
    std::fs::write(&kept, b"broken").unwrap();
    std::fs::remove_file(place.path("rules/relations.dl")).unwrap();
    assert_eq!(place.run(&["relations", "--name", "NEXT_TO"]).is(0).out, derived);
    assert_eq!(std::fs::read(&kept).unwrap(), bytes);
}

#[test]
fn a_question_is_answered_with_its_rule_and_proof() {
    let place = Place::with_rb2();
    let run = place.run(&["ask", "Что на Столе-1?", "--explain"]);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.out.starts_with("На Столе-1 находятся Книга-4 и Чашка-1.\n"), "{}", run.out);
    assert!(
        run.out.contains("ответ(X) :- ") && run.out.contains("НАХОДИТСЯ_СВЕРХУ_НА"),
        "{}",
        run.out
    );
    let run = place.run(&["--json", "ask", "How many chairs are in Room Z?"]);
    let view: Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!((&view["outcome"], &view["number"]), (&Value::from("found"), &Value::from(4.0)));
    assert_eq!(view["bindings"].as_array().unwrap().len(), 4);
    let codes = ["Стул-1 белый?", "Где чашка?"].map(|question| place.run(&["ask", question]).code);
    assert_eq!(codes, [1, 2]);
}

#[test]
fn a_dialogue_from_a_pipe_keeps_what_was_said() {
    use std::io::Write as _;
    let place = Place::with_rb2();
    let mut child =
        place.command(&["talk"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let lines = "Где чашка?\nкрасная\nКакого она цвета?\nОткрой Дверь-ВZ\nвыход\n";
    child.stdin.take().unwrap().write_all(lines.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{text}");
    for said in [
        "это Чашка-1 (белая) или Чашка-2 (красная)?",
        "Чашка-2 находится на Тумбе-3 в Комнате-Z.",
        "Чашка-2 красная.",
    ] {
        assert!(text.contains(said), "{text}");
    }
    assert!(text.lines().count() > 3, "the command was answered too: {text}");
}
