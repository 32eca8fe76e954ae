//! `ortho plan`: English words, withdrawn assumptions, limits.

use serde_json::json;

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

/// «Проверь, …» orders nothing but an answer.
#[test]
fn a_task_that_only_asks_is_answered() {
    let place = Place::with_rb2();
    let shut = place.run(&["do", "Проверь, закрыта ли Дверь-ZY"]).is(1).out;
    assert_eq!(shut.trim(), "Нет, Дверь-ZY открыта.");
    let fridge = place.run(&["do", "Please go and check whether the fridge is closed"]).is(0).out;
    assert_eq!(fridge.trim(), "Yes, Refrigerator 1 is closed.");
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
    assert!(help.contains("Помогло бы: ДВЕРЬ_ИЗ_В_ОТКРЫТА_(Дверь-ВZ"), "{help}");
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
