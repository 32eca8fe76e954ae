//! Plans, tasks and ways.

use serde_json::Value;

use crate::files::shared;

use super::{AT_THE_DOOR, Place, project, rb2, walk};

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
fn no_plan_is_the_answer_no() {
    let Some(folder) = shared("homebot") else { return };
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

/// A report has no goal, and what is found already needs no words but its place.
#[test]
fn who_asks_where_something_is_is_told() {
    let place = Place::with_rb2();
    let report = place.run(&["do", "Доложи, где ты"]).is(0).out;
    assert!(report.contains("Я нахожусь в середине Комнаты-В."), "{report}");
    let report = place.run(&["do", "Report your position", "--lang", "en"]).is(0).out;
    assert!(report.contains("I am in the middle of Room V."), "{report}");
    let found = place.run(&["do", "Найди Книгу-4"]).is(0).out;
    assert!(found.contains("Книга-4 находится на Столе-1 в Комнате-В."), "{found}");
    assert!(!found.contains("Так уже и есть"), "{found}");
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
    let there = place.json(&["do", "Открой Дверь-КY", "--from", "Комната-Y"], 0);
    let first = there["directives"][0]["ru"].as_str().unwrap();
    assert!(first.starts_with("Я нахожусь в Комнате-Y"), "{first}");
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
fn the_demo_does_the_main_job() {
    let place = Place::empty();
    let told = place.run(&["demo"]).is(0).out;
    for words in ["НАХОДИТСЯ_СВЕРХУ_НА", AT_THE_DOOR, "передать Лекарство", "Сделано", "plan.svg"]
    {
        assert!(told.contains(words), "{words} is missing in {told}");
    }
    let drawing = std::fs::read_to_string(place.path("demo/plan.svg")).unwrap();
    // The picture of the README is what the demo draws; UPDATE_EXPECT=1 draws it anew.
    let shown = project("docs/rb2-plan.svg");
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&shown, &drawing).unwrap();
    }
    let is_same = std::fs::read_to_string(&shown).unwrap() == drawing;
    assert!(is_same, "docs/rb2-plan.svg is not what the demo draws now");
    assert!(place.store().is_none(), "without a directory, no store is kept");
    let kept = place.json(&["demo", "kept"], 0);
    assert_eq!(kept["outcome"], "done");
    assert_eq!(place.json(&["--store", "kept", "where", "--at", "225,395"], 0)["ru"], AT_THE_DOOR);
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
fn corridors_are_told_by_entrances() {
    let place = Place::with_rb2();
    let paper = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/corridor-paper4.toml");
    let way = ["corridor", paper, "--from", "201", "--last", "1,0", "--to", "210"];
    let one = place.json(&way, 0);
    let two = place.json(&[&way[..], &["--variant", "2"]].concat(), 0);
    assert_eq!(one["steps"], two["steps"]);
    // A legend explains codes only where arcs bear them.
    for (variant, has_codes) in [("1", true), ("2", false)] {
        let draw = [&["draw"][..], &way, &["--variant", variant]].concat();
        let legend = place.run(&draw).is(0).out;
        assert_eq!(legend.contains("дуга с кодом"), has_codes);
    }
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
    // Where neither a file nor a map is named, the store is asked.
    let ends = ["--from", "Комната-В", "--to", "Комната-Y"];
    let of_store = [&["corridor"][..], &ends].concat();
    place.run(&of_store).is(0);
    let sheet = place.run(&[&["draw"][..], &of_store].concat()).is(0).out;
    assert!(sheet.contains("Комната-Y"), "{sheet}");
    let drawn = place.run(&["draw", "corridor", paper, "--from", "201", "--to", "210"]).is(0).out;
    assert!(drawn.starts_with("<svg"));
}

/// After a task, an observation and an edit of the map alike, words lead to where the thing is.
#[test]
fn words_lead_to_where_a_thing_is_now() {
    let place = Place::with_rb2();
    let asked = |question: &str| place.run(&["ask", question]).is(0).out;
    let holds = |question: &str, words: &[&str], not: &[&str]| {
        let said = asked(question);
        assert!(words.iter().all(|w| said.contains(w)), "{question}: {said}");
        assert!(not.iter().all(|w| !said.contains(w)), "{question}: {said}");
    };
    holds("Где лекарство?", &["на Тумбочке-2", "в Комнате-Y"], &[]);
    holds("Как проехать из Коридора к лекарству?", &["в Комнату-Y", "до Лекарства"], &[]);
    place.json(&["do", "Положи лекарство на Письменный стол"], 0);
    holds("Где лекарство?", &["на Письменном столе", "в Комнате-В"], &["Комнате-Y"]);
    let way = ["в Комнату-В", "до Лекарства"];
    holds("Как проехать из Коридора к лекарству?", &way, &["Комнату-Y", "Комнату-Z"]);
    holds("Где ты?", &["в Комнате-В"], &[]);
    holds("Что на Письменном столе?", &["Лекарство"], &[]);
    // What was seen elsewhere is believed to be there.
    place.run(&["observe", "Зонт-1", "--area", "Комната-В", "--at", "250,250"]).is(0);
    holds("Где зонт?", &["в Комнате-В"], &["Коридоре"]);
    holds("Как проехать из Коридора к зонту?", &["в Комнату-В", "до Зонта-1"], &[]);
    // And what the map itself says anew.
    holds("Как проехать из Комнаты-В к Стулу-6?", &["в Комнату-Z"], &["Комнату-Y"]);
    place.run(&["edit", "move", "Стул-6", "--area", "Комната-Y", "--to", "200,150"]).is(0);
    holds("Где Стул-6?", &["в Комнате-Y"], &["Комнате-Z"]);
    holds("Как проехать из Комнаты-В к Стулу-6?", &["в Комнату-Y", "до Стула-6"], &[]);
    let gone = place.json(&["do", "Подъедь к Стулу-6", "--from", "Комната-В"], 0);
    assert_eq!(gone["outcome"], "done");
    assert_eq!(place.json(&["where"], 0)["area"], "Комната-Y");
}

/// Nothing ends with an empty line: an order that leaves nothing to do says so, and "Stop" is one.
#[test]
fn every_order_is_answered() {
    let place = Place::with_rb2();
    for (lang, order) in [
        ("ru", "Прибери"),
        ("ru", "Приберись на кухне"),
        ("en", "Tidy up"),
        ("ru", "Стоп"),
        ("ru", "Стой!"),
        ("en", "Stop"),
        ("en", "Halt"),
        ("ru", "Жди"),
        ("ru", "Закрой Дверь-КY"),
    ] {
        let told = place.run(&["do", order, "--lang", lang]).is(0).out;
        let last = told.trim_end().lines().last().unwrap_or_default();
        assert!(told.ends_with(&format!("{last}\n")) && !last.contains(order), "{order}: {told}");
        assert!(last.split_whitespace().count() >= 2, "{order}: {told}");
    }
}

/// Of what does not exist nothing is true: that is said, and not that a measure fails.
#[test]
fn why_of_a_name_that_does_not_exist_says_so() {
    let place = Place::with_rb2();
    for fact in ["ON_TOP_OF(Чашка-99, Стол-1)", "НАХОДИТСЯ_ВНУТРИ(Стол-1, Комната-Ю)"]
    {
        for extra in [&[][..], &["--not"]] {
            let told = place.run(&[&["why", fact], extra].concat()).is(2);
            assert!(told.err.contains("на карте нет имени"), "{fact}: {}", told.err);
        }
    }
    // By its English name a thing is the same thing.
    let russian = place.run(&["why", "ON_TOP_OF(Чашка-1, Стол-1)"]);
    let english = place.run(&["why", "ON_TOP_OF(Cup 1, Стол-1)"]);
    assert_eq!(russian.out, english.out);
}
