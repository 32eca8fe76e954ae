//! `ortho plan`: English words, withdrawn assumptions, limits.

use serde_json::{Value, json};

use super::{Place, project};

fn scenario(name: &str) -> String {
    project(&format!("rules/scenarios/{name}.strips")).display().to_string()
}

/// Steps, assumptions and explanations of the service robot are English with --lang en, and Russian without.
#[test]
fn plans_and_explanations_are_english_where_english_is_asked_for() {
    let place = Place::empty();
    let english = |name: &str, code| {
        let told = place.run(&["--lang", "en", "plan", &scenario(name)]).is(code).out;
        // Names of objects are the scenario's own; of the rules' words none is left.
        assert!(!told.contains("_("), "{told}");
        told
    };
    let plan = english("medicine-closed-door", 0);
    for words in ["open Дверь-ZY", "take Лекарство from Тумба", "     Дверь-ВZ is open\n"]
    {
        assert!(plan.contains(words), "{words}: {plan}");
    }
    assert_eq!(plan.matches("Дверь-ВZ is open").count(), 1, "once, not for either side: {plan}");
    let lift = english("another-floor", 0);
    assert!(lift.contains("ride Лифт") && lift.contains("Лифт works"), "{lift}");
    let none = english("two-goals-exclude", 1);
    assert!(none.contains("that the robot holds Книга and that the robot holds Чашка"), "{none}");
    let russian = place.run(&["plan", &scenario("medicine-closed-door")]).is(0).out;
    assert!(russian.contains("Открыть-дверь_(Комната-Z, Комната-Y, Дверь-ZY)"), "{russian}");
    let json = place.json(&["plan", &scenario("two-goals-exclude")], 1);
    assert!(json["explanation_en"].as_str().unwrap().contains("the robot holds"), "{json}");
    assert!(json["explanation"].as_str().unwrap().contains("РОБОТ-ДЕРЖИТ_("), "{json}");
}

/// A match burns while it is struck, and only then the fuse can be mended: within that action, which is planned as one.
#[test]
fn that_no_plan_of_whole_actions_is_there_proves_no_more() {
    let place = Place::empty();
    let rules = "(define (domain d) (:requirements :durative-actions) (:predicates (light) (mended) (unused))
 (:durative-action strike :parameters () :duration (= ?duration 8) :condition (at start (unused))
  :effect (and (at start (not (unused))) (at start (light)) (at end (not (light)))))
 (:durative-action mend :parameters () :duration (= ?duration 5) :condition (over all (light))
  :effect (at end (mended))))";
    let task = "(define (problem p) (:domain d) (:init (unused)) (:goal (mended)))";
    let (domain, problem) = (place.write("domain.pddl", rules), place.write("problem.pddl", task));
    let plan = ["plan", "--domain", &domain, "--problem", &problem];
    let json = place.json(&plan, 1);
    assert_eq!((&json["outcome"], &json["whole_actions"]), (&json!("no_plan"), &json!(true)));
    for (lang, words) in [("en", "no plan of whole actions"), ("ru", "Плана из целых действий")]
    {
        let told = place.run(&[&["--lang", lang], &plan[..]].concat()).is(1).out;
        assert!(told.contains(words) && !told.contains("There is no plan;"), "{told}");
    }
}

/// Of a goal that falls into cases, of which none can come about, no inner fact is named.
#[test]
fn a_goal_without_a_case_is_told_in_words() {
    let place = Place::empty();
    let rules = "(define (domain d) (:predicates (room ?r) (warm ?r) (stove ?r))
 (:action heat :parameters (?r) :precondition (stove ?r) :effect (warm ?r)))";
    for goal in [
        "(forall (?r) (warm ?r))",
        "(exists (?r) (and (warm ?r) (not (room ?r))))",
        "(or (warm b) (and (warm b) (stove b)))",
        "(imply (room b) (warm b))",
    ] {
        let task = format!(
            "(define (problem p) (:domain d) (:objects a b) (:init (room a) (room b) (stove a)) (:goal {goal}))"
        );
        let (domain, problem) =
            (place.write("domain.pddl", rules), place.write("problem.pddl", task));
        for lang in ["en", "ru"] {
            let plan = ["--lang", lang, "plan", "--domain", &domain, "--problem", &problem];
            let told = place.run(&plan).is(1).out;
            assert!(!told.contains('≠') && told.trim().len() > 60, "{goal}: {told}");
        }
    }
}

/// A scenario of a house of its own declares its rooms and doors, and is planned whatever map the store holds.
#[test]
fn every_scenario_of_the_rules_is_planned_on_a_map() {
    let place = Place::with_rb2();
    for file in std::fs::read_dir(project("rules/scenarios")).unwrap() {
        let file = file.unwrap().path();
        let code = i32::from(file.ends_with("two-goals-exclude.strips"));
        place.run(&["plan", "--any", &file.display().to_string()]).is(code);
    }
}

/// The time that a plan is told to take is that of the drive, but for where the robot turns to at first.
#[test]
fn the_quickest_plan_takes_as_long_as_its_drive() {
    let place = Place::empty();
    let walk = scenario("medicine-walk");
    let json = place.json(&["plan", "--metric", "time", &walk], 0);
    assert_eq!((&json["quickest"], &json["outcome"]), (&json!(true), &json!("plan")), "{json}");
    let told = json["seconds"].as_f64().unwrap();
    assert_eq!(json["at_least_seconds"].as_f64(), Some(told), "{json}");
    let driven = place.run(&["do", "--json", "--scenario", &walk]).is(0).out;
    let planned: Value = serde_json::from_str(driven.lines().next().unwrap()).unwrap();
    let steps = json!(planned["steps"].as_array().unwrap().len());
    assert_eq!((&planned["at_least_steps"], &planned["at_most_steps"]), (&steps, &steps));
    let end: Value = serde_json::from_str(driven.lines().last().unwrap()).unwrap();
    let driven = end["seconds"].as_f64().unwrap();
    assert!((told - driven).abs() < 0.15 * driven, "{told} told, {driven} driven");
    // A robot that is to plan for time drives that plan, and tells its time beforehand.
    let driven = place.run(&["do", "--json", "--metric", "time", "--scenario", &walk]).is(0).out;
    let planned: Value = serde_json::from_str(driven.lines().next().unwrap()).unwrap();
    assert_eq!((&planned["event"], &planned["outcome"]), (&json!("planned"), &json!("plan")));
    let (seconds, least) = (&planned["seconds"], &planned["at_least_seconds"]);
    assert_eq!(seconds, least, "{planned}");
    assert!((seconds.as_f64().unwrap() - told).abs() < 0.15 * told, "{told} told: {planned}");
    let words = place.run(&["--lang", "en", "do", "--metric", "time", "--scenario", &walk]).is(0);
    assert!(words.out.contains("a quicker one is proven impossible"), "{}", words.out);
    let words = place.run(&["--lang", "en", "plan", "--metric", "time", &walk]).is(0).out;
    assert!(words.contains("a quicker one is proven impossible"), "{words}");
    // A lift opens its own doors, which takes as long as with others.
    let storeys = project("maps/two-storeys.toml").display().to_string();
    place.run(&["import", &storeys]).is(0);
    let rules = project("rules/service-robot.strips").display().to_string();
    let above = place.path("above.strips");
    let text = format!(
        "Включить: {rules}\nИсходная позиция:\nРОБОТ-НАХОДИТСЯ-В_(Холл-1)\nРОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(«Стойка охраны»)\n\
         РУКА-СВОБОДНА_()\nЦелевая позиция:\nРОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ_(Окно)\n"
    );
    std::fs::write(&above, text).unwrap();
    let above = above.display().to_string();
    let told = place.json(&["plan", "--metric", "time", &above], 0)["seconds"].as_f64().unwrap();
    let driven = place.run(&["do", "--json", "--scenario", &above]).is(0).out;
    let end: Value = serde_json::from_str(driven.lines().last().unwrap()).unwrap();
    let driven = end["seconds"].as_f64().unwrap();
    assert!((told - driven).abs() < 2.0, "{told} told, {driven} driven");
    // Without a map there is no time.
    let place = Place::empty();
    place.run(&["plan", "--metric", "time", &scenario("another-floor")]).is(2);
}

/// What a task assumes is told in the map's English names, and why it cannot be done as well.
#[test]
fn a_task_tells_its_assumptions_in_english() {
    let place = Place::with_rb2();
    let done = place.run(&["--lang", "en", "do", "Bring the medicine"]).is(0).out;
    assert!(done.contains("It rests on the assumptions:\n     Door"), "{done}");
    assert!(done.contains("Door ZY is open") && !done.contains("ДВЕРЬ"), "{done}");
    let locked = place.run(&["--lang", "en", "do", "Lock Door KY"]).is(1).out;
    assert!(locked.contains("the goal that Door KY is locked is out of reach"), "{locked}");
    assert!(locked.contains("It would help if a thing is a key to Door KY"), "{locked}");
    assert_eq!(locked.matches("out of reach").count(), 1, "either side is one door: {locked}");
    let json = place.json(&["do", "Lock Door KY"], 1);
    let why = json["plan"]["explanation_en"].as_str().unwrap();
    assert!(why.contains("Door KY is locked"), "{why}");
}

/// «Проверь, …» orders nothing but an answer; "go and check" goes there before it.
#[test]
fn a_task_that_only_asks_is_answered() {
    let place = Place::with_rb2();
    let shut = place.run(&["do", "Проверь, закрыта ли Дверь-ZY"]).is(1).out;
    assert_eq!(shut.trim(), "Нет, Дверь-ZY открыта.");
    let fridge = place.run(&["do", "Please go and check whether the fridge is closed"]).is(0).out;
    assert!(fridge.trim_end().ends_with("\nYes, Refrigerator 1 is closed."), "{fridge}");
    assert!(fridge.contains("подъехать к Холодильнику-1"), "{fridge}");
}

#[test]
fn an_assumption_is_withdrawn_and_the_plan_made_anew() {
    let place = Place::empty();
    let file = scenario("medicine-locked-door");
    let without = |fact: &str, code| place.json(&["plan", &file, "--without", fact], code);
    // The other side of a door that is passed from this side alone: nothing rests on it on the way there.
    let gone = without("ДВЕРЬ_ИЗ_В_ОТКРЫТА_(Дверь-ВZ, ?x, ?z)", 1);
    assert_eq!((&gone["outcome"], &gone["before"]["outcome"]), (&json!("no_plan"), &json!("plan")));
    assert_eq!(gone["before"]["rested_on_it"], true);
    assert_eq!(gone["withdrawn"].as_array().unwrap().len(), 2);
    let help = gone["explanation"].as_str().unwrap();
    // Through a door that is open on one side the robot would not come back.
    assert!(!help.contains("Помогло бы"), "{help}");
    let text = place
        .run(&["plan", &file, "--lang", "en", "--without", "дверь_из_в_открыта(Дверь-ВZ, ?x, ?z)"])
        .is(1);
    assert!(text.out.starts_with("Withdrawn: Дверь-ВZ is open – the plan before rested on this."));
    for wrong in ["РУКА-СВОБОДНА_()", "ДВЕРЬ_ИЗ_В_ОТКРЫТА_(Дверь-ВЫ, ?x, ?z)"]
    {
        let fault = &without(wrong, 2)["errors"][0];
        assert_eq!(fault["code"], "strips::not_assumed", "{fault}");
    }
    // A plan that rests on what was withdrawn is no plan any more.
    place.run(&["plan", &file, "--out", "plan.txt"]).is(0);
    place.run(&["plan", &file, "--check", "plan.txt"]).is(0);
    let gone = "ДВЕРЬ_ИЗ_В_ОТКРЫТА_(Дверь-ВZ, ?x, ?z)";
    let check = ["plan", &file, "--check", "plan.txt", "--without", gone];
    let broken = place.json(&check, 1);
    assert_eq!(broken["broken"]["step"], 1, "{broken}");
    let text = place.run(&[&check[..], &["--lang", "en"]].concat());
    let text = text.is(1).out;
    assert!(
        text.contains("plan.txt:2:4: the action cannot be carried out: it takes ДВЕРЬ"),
        "{text}"
    );
}

#[test]
fn limits_of_time_and_memory_are_an_outcome() {
    let place = Place::empty();
    let file = scenario("tidy-up");
    for (limit, value, name) in [
        ("--time-limit", "0", "time"),
        ("--time-limit", "0.000001", "time"),
        ("--memory-limit", "0", "memory"),
    ] {
        for any in [&[][..], &["--any"]] {
            let limited = place.json(&[&["plan", &file, limit, value], any].concat(), 1);
            assert_eq!((&limited["outcome"], &limited["limit"]), (&json!("limit"), &json!(name)));
            assert_eq!(
                (&limited["parallel_steps"], &limited["optimal"]),
                (&json!(0), &json!(false))
            );
        }
    }
    let told = place.run(&["plan", &file, "--time-limit", "0", "--lang", "en"]).is(1).out;
    assert!(told.contains("No plan was found: the time was up"), "{told}");
    place.run(&["plan", &file, "--time-limit", "60", "--memory-limit", "512"]).is(0);
    for wrong in ["-1", "soon", "1e400", "NaN"] {
        place.run(&["plan", &file, &format!("--time-limit={wrong}")]).is(2);
    }
}

/// Balls that two grippers carry from one room to the other.
fn gripper(place: &Place, balls: usize) -> [String; 2] {
    let domain = place.write(
        "gripper.pddl",
        "(define (domain g) (:predicates (room ?r) (ball ?b) (gripper ?g) (robby ?r) (at ?b ?r) (free ?g) (carry ?b ?g))
         (:action move :parameters (?a ?b) :precondition (and (room ?a) (room ?b) (robby ?a)) :effect (and (robby ?b) (not (robby ?a))))
         (:action pick :parameters (?b ?r ?g) :precondition (and (ball ?b) (gripper ?g) (at ?b ?r) (robby ?r) (free ?g))
          :effect (and (carry ?b ?g) (not (at ?b ?r)) (not (free ?g))))
         (:action drop :parameters (?b ?r ?g) :precondition (and (carry ?b ?g) (robby ?r) (gripper ?g))
          :effect (and (at ?b ?r) (free ?g) (not (carry ?b ?g)))))",
    );
    let each =
        |text: &str| -> String { (0..balls).map(|n| text.replace('#', &n.to_string())).collect() };
    let problem = place.write(
        "balls.pddl",
        format!(
            "(define (problem p) (:domain g) (:objects a b l r {}) (:init (room a) (room b) (gripper l) (gripper r) (robby a) (free l) (free r) {}) (:goal (and {})))",
            each("b# "), each("(ball b#) (at b# a) "), each("(at b# b) "),
        ),
    );
    [domain, problem]
}

/// Fifteen tiles in a frame, in the opposite order: too far for a proof.
fn tiles(place: &Place) -> [String; 2] {
    let domain = place.write(
        "tiles.pddl",
        "(define (domain t) (:predicates (next ?a ?b) (on ?t ?p) (hole ?p))
         (:action slide :parameters (?t ?a ?b) :precondition (and (next ?a ?b) (on ?t ?a) (hole ?b))
          :effect (and (on ?t ?b) (hole ?a) (not (on ?t ?a)) (not (hole ?b)))))",
    );
    let places = 0..16_usize;
    let next: String = places
        .clone()
        .flat_map(|p| {
            let right = (p % 4 < 3).then_some(p + 1);
            let below = (p < 12).then_some(p + 4);
            right
                .into_iter()
                .chain(below)
                .map(move |q| format!("(next p{p} p{q}) (next p{q} p{p}) "))
        })
        .collect();
    let on = |order: &dyn Fn(usize) -> usize| -> String {
        (0..15).map(|t| format!("(on t{t} p{}) ", order(t))).collect()
    };
    let objects: String = places.map(|p| format!("p{p} t{p} ")).collect();
    let problem = place.write(
        "frame.pddl",
        format!(
            "(define (problem p) (:domain t) (:objects {objects}) (:init {next}(hole p15) {}) (:goal (and {})))",
            on(&|t| t), on(&|t| 14 - t),
        ),
    );
    [domain, problem]
}

#[test]
fn a_search_given_up_tells_what_is_known_and_what_would_help() {
    let place = Place::empty();
    let [domain, problem] = tiles(&place);
    let args = ["plan", "--domain", &domain, "--problem", &problem, "--time-limit", "3"];
    let limited = place.json(&args, 1);
    assert_eq!((&limited["outcome"], &limited["limit"]), (&json!("limit"), &json!("time")));
    // The farthest tiles have six places to go.
    assert!(limited["at_least_steps"].as_u64().is_some_and(|least| least > 3), "{limited}");
    assert_eq!(limited["help"], json!(["--any", "--time-limit"]));
    let told = place.run(&args).is(1).out;
    assert!(told.contains("не меньше") && told.contains("Помогло бы: --any"), "{told}");
    let told = place.run(&[&args[..], &["--lang", "en"]].concat()).is(1).out;
    assert!(told.contains("at least") && told.contains("It would help: --any"), "{told}");
}

/// What `--anytime --json` tells, line by line: lower bounds only rise, plans only get shorter, neither passes the other,
/// and the last line is the answer, one of the four kinds.
#[test]
fn the_stream_of_an_anytime_plan_comes_to_its_answer() {
    let place = Place::empty();
    let unsolvable = place.write("none.pddl", "(define (problem p) (:domain g) (:objects a b) (:init (room a) (robby a)) (:goal (robby b)))");
    let none = |place: &Place| {
        let [domain, _] = gripper(place, 1);
        [domain, unsolvable.clone()]
    };
    // Proven, none, open with a plan, and nothing known.
    type Files<'f> = &'f dyn Fn(&Place) -> [String; 2];
    let cases: [(Files<'_>, &[&str], &str); 4] = [
        (&|place| gripper(place, 6), &[], "plan"),
        (&none, &[], "no_plan"),
        (&|place| gripper(place, 30), &["--effort", "1"], "bounds"),
        (&tiles, &["--time-limit", "0"], "nothing"),
    ];
    for (files, limits, kind) in cases {
        let [domain, problem] = &files(&place);
        let files = ["plan", "--domain", domain, "--problem", problem];
        let args = [&files[..], &["--anytime", "--json"], limits].concat();
        let (mut at_least, mut at_most) = (0, u64::MAX);
        let told = place.run(&args).is(i32::from(kind != "plan")).out;
        let lines: Vec<Value> =
            told.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
        let (end, stream) = lines.split_last().unwrap();
        for line in stream {
            match line["event"].as_str().unwrap() {
                "bound" => {
                    let bound = line["at_least_steps"].as_u64().unwrap();
                    assert!(bound > at_least, "{told}");
                    at_least = bound;
                }
                "plan" => {
                    let steps = line["parallel_steps"].as_u64().unwrap();
                    assert!(steps < at_most && line["actions"].as_u64() >= Some(steps), "{told}");
                    at_most = steps;
                }
                other => panic!("{other}: {told}"),
            }
            assert!(at_least <= at_most, "{told}");
        }
        assert!(end.get("event").is_none(), "{end}");
        let steps = end["parallel_steps"].as_u64().unwrap();
        match kind {
            "plan" => {
                assert_eq!((&end["outcome"], &end["optimal"]), (&json!("plan"), &json!(true)));
                // 11 trips, of which 6 with balls: all that the stream told led here.
                assert_eq!((at_least, at_most), (steps, steps), "bounds meet: {told}");
            }
            "no_plan" => {
                assert_eq!(end["outcome"], json!("no_plan"), "{told}");
                assert_eq!(at_most, u64::MAX, "{told}");
            }
            "bounds" => {
                assert_eq!((&end["outcome"], &end["limit"]), (&json!("limit"), &json!("effort")));
                assert_eq!(end["at_least_steps"], json!(at_least), "{told}");
                assert_eq!((&end["at_most_steps"], steps), (&json!(at_most), at_most), "{told}");
                assert!(at_least < at_most, "{told}");
            }
            _ => {
                assert_eq!((&end["outcome"], &end["limit"]), (&json!("limit"), &json!("time")));
                assert_eq!((&end["at_most_steps"], steps), (&json!(null), 0), "{told}");
            }
        }
        // Where effort alone ends it the answer is the same without the stream.
        if kind != "nothing" {
            let plain = [&files[..], &["--anytime"], limits].concat();
            let words = place.run(&[&["--lang", "en"], &plain[..]].concat());
            let words = words.is(i32::from(kind != "plan"));
            match kind {
                "plan" => assert!(words.out.contains("proven impossible"), "{}", words.out),
                "no_plan" => assert!(words.out.contains("There is no plan"), "{}", words.out),
                _ => {
                    let bounds = format!("it takes {at_least} to {at_most} steps");
                    assert!(words.out.contains(&bounds), "{bounds}: {}", words.out);
                    assert!(words.out.contains("It would help: more effort"), "{}", words.out);
                    assert!(words.err.contains("Proven: at least"), "{}", words.err);
                }
            }
        }
    }
    // Effort is that of --anytime alone.
    let [domain, balls] = gripper(&place, 1);
    let files = ["plan", "--domain", &domain, "--problem", &balls];
    place.run(&[&files[..], &["--effort", "1"]].concat()).is(2);
    place.run(&[&files[..], &["--anytime", "--any"]].concat()).is(2);
}

/// The paper's own algorithm answers as all of them together do.
#[test]
fn the_plain_algorithm_answers_the_same() {
    let place = Place::empty();
    for (balls, code) in [(1, 0), (3, 0)] {
        let [domain, problem] = gripper(&place, balls);
        let args = ["plan", "--domain", &domain, "--problem", &problem];
        let best = place.json(&args, code);
        let plain = place.json(&[&args[..], &["--plain"]].concat(), code);
        for field in ["outcome", "parallel_steps", "optimal"] {
            assert_eq!(plain[field], best[field], "{field}");
        }
    }
    let exclusive = scenario("two-goals-exclude");
    let none = place.json(&["plan", &exclusive, "--plain"], 1);
    assert_eq!(none["outcome"], json!("no_plan"), "{none}");
}

/// What was tried before a search is given up, and how far it came, is told in both languages and as data.
#[test]
fn a_search_given_up_tells_what_it_tried() {
    let place = Place::empty();
    let [domain, problem] = tiles(&place);
    let args = ["plan", "--domain", &domain, "--problem", &problem, "--time-limit", "2"];
    for (option, way, russian, english) in [
        (
            &[][..],
            "proof",
            "доказательство кратчайшего (уровней",
            "the proof of the fewest steps (",
        ),
        (&["--plain"], "graph", "граф планирования (уровней", "the planning graph (levels: "),
    ] {
        let args = [&args[..], option].concat();
        let limited = place.json(&args, 1);
        let tried = limited["tried"].as_array().unwrap();
        let found = tried.iter().find(|one| one["way"] == way).expect(way);
        for (field, least) in [("times", 1), ("levels", 6), ("nodes", 1), ("effort", 1)] {
            assert!(found[field].as_u64() >= Some(least), "{field}: {limited}");
        }
        if limited["at_most_steps"].is_null() {
            let told = |language| place.run(&[&["--lang", language], &args[..]].concat()).is(1).out;
            let (told, english_told) = (told("ru"), told("en"));
            assert!(told.contains("; испробовано: ") && told.contains(russian), "{told}");
            let told = english_told;
            assert!(told.contains("; tried: ") && told.contains(english), "{told}");
        }
    }
    let none = place.json(&["plan", &scenario("tidy-up"), "--time-limit", "0"], 1);
    assert_eq!(none["tried"][0]["way"], json!("grounding"), "{none}");
    let told = place.run(&["plan", &scenario("tidy-up"), "--time-limit", "0"]).is(1).out;
    assert!(told.contains("испробовано: составление действий"), "{told}");
}

/// A child whose handlers of signals stand.
#[cfg(target_os = "linux")]
fn started(place: &Place, args: &[&str]) -> std::process::Child {
    use std::process::Stdio;
    let mut child =
        place.command(args).stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let status = format!("/proc/{}/status", child.id());
    let handles = |status: String| {
        let caught = status.lines().find_map(|line| line.strip_prefix("SigCgt:"));
        let caught = caught.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok());
        caught.is_some_and(|mask| mask >> 14 & 1 == 1 && mask >> 1 & 1 == 1)
    };
    while !std::fs::read_to_string(&status).is_ok_and(handles) {
        assert!(child.try_wait().unwrap().is_none(), "it ended by itself");
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    child
}

#[cfg(target_os = "linux")]
fn send(signal: &str, to: &std::process::Child) {
    let sent = std::process::Command::new("kill").args([signal, &to.id().to_string()]).status();
    assert!(sent.unwrap().success());
}

#[cfg(target_os = "linux")]
#[test]
fn a_signal_ends_the_search_with_what_it_has() {
    use std::io::{BufRead, BufReader, Read};
    let place = Place::empty();
    for signal in ["-INT", "-TERM"] {
        let [domain, problem] = tiles(&place);
        let child =
            started(&place, &["plan", "--domain", &domain, "--problem", &problem, "--json"]);
        send(signal, &child);
        let output = child.wait_with_output().unwrap();
        let told: Value = serde_json::from_slice(&output.stdout).unwrap();
        assert_eq!((&told["outcome"], &told["limit"]), (&json!("limit"), &json!("stopped")));
        assert_eq!((output.status.code(), &told["help"]), (Some(1), &json!(["--any"])));

        let [domain, problem] = gripper(&place, 30);
        let out = place.path("plan.txt").display().to_string();
        let args = ["plan", "--domain", &domain, "--problem", &problem, "--any", "--out", &out];
        let mut child = started(&place, &args);
        let mut notes = BufReader::new(child.stderr.take().unwrap()).lines();
        let first = notes.next().unwrap().unwrap();
        assert!(first.contains("Найден план"), "{first}");
        send(signal, &child);
        let mut told = String::new();
        child.stdout.take().unwrap().read_to_string(&mut told).unwrap();
        assert_eq!(child.wait().unwrap().code(), Some(0), "{told}");
        assert!(told.starts_with("План: шагов"), "{told}");
        let checked = ["plan", "--domain", &domain, "--problem", &problem, "--check", &out];
        place.run(&checked).is(0);
    }
}
