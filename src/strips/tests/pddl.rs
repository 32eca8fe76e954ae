//! PDDL: types, constants, costs, and faults with their places.

use orthoframe_strips::{Scenario, Task};
use orthoframe_units::Source;

const DOMAIN: &str = "(define (domain lift) (:requirements :typing :action-costs)
        (:types floor - object  person bag - (either load thing) load thing)
        (:constants ground - floor)
        (:predicates (at ?f - floor) (waits ?l - (either person bag) ?f - floor) (done ?l))
        (:functions (total-cost) (far ?a ?b - floor))
        (:action move :parameters (?a ?b - floor) :precondition (and (at ?a) (not (= ?a ?b)))
          :effect (and (at ?b) (not (at ?a)) (increase (total-cost) (far ?a ?b))))
        (:action carry :parameters (?l - (either person bag) ?f - floor)
          :precondition (and (at ?f) (waits ?l ?f) (not (done ?l))) :effect (and (done ?l) (increase (total-cost) 2.0))))";

fn task(problem: &str) -> Result<Task, Vec<String>> {
    let domain = Source::new("domain", DOMAIN);
    Scenario::parse_pddl(&domain, &Source::new("problem", problem))
        .and_then(|scenario| scenario.ground())
        .map_err(|faults| faults.0.iter().map(ToString::to_string).collect())
}

#[test]
fn types_constants_and_costs_are_read() {
    let task = task(
        "(define (problem p) (:domain lift) (:objects roof - floor Ann - person)
             (:init (at ground) (WAITS ann roof) (= (far ground roof) 7) (= (total-cost) 0))
             (:goal (and (done ann) (not (at roof)))) (:metric minimize (total-cost)))",
    )
    .unwrap();
    let shown: Vec<String> = task.operators.iter().map(|o| format!("{o} {}", o.cost)).collect();
    assert_eq!(shown, ["move_(ground, roof) 7", "move_(roof, ground) 0", "carry_(Ann, roof) 2"]);
}

#[test]
fn faults_have_places() {
    let faults = task(
        "(define (problem p) (:domain lift) (:objects roof - flor)
             (:init (att ground) (waits ground roof))
             (:goal (and (or (done roof)) (done Bob) (at roof))))",
    )
    .unwrap_err();
    expect_test::expect![[r#"
            problem:1:53: неизвестный тип «flor»
            problem:2:22: неизвестный предикат «att»
            problem:2:41: «waits»: 1-й аргумент должен быть типа «person или bag», а «ground» – типа «floor»
            problem:3:49: неизвестный объект «Bob»"#]].assert_eq(&faults.join("\n"));
}

#[test]
fn rubbish_is_refused_without_panic() {
    for text in [
        "",
        "(",
        ")",
        "(define",
        "(define)",
        "()",
        "(define (:action))",
        "(define (:objects -))",
        "x",
    ] {
        assert!(task(text).is_err(), "{text}");
    }
    assert!(task(&"(".repeat(1 << 20)).is_err());
    let nested = format!("(define (:goal {}{}))", "(not ".repeat(500), ")".repeat(500));
    assert!(task(&nested).is_err());
    let good = "(define (problem p) (:objects r - floor) (:init (at r) (= (far r r) 1)) (:goal (and (at r))))";
    for at in 0..good.len() {
        let _ = task(&good[..at]);
        let _ = task(&good[at..]);
    }
}
