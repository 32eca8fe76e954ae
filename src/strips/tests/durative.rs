//! Actions that take their time.

use orthoframe_strips::{Scenario, Task};
use orthoframe_units::Source;

fn task(conditions: &str, effects: &str) -> Task {
    let domain = format!(
        "(define (domain d) (:requirements :durative-actions) (:predicates (p ?x) (q ?x) (busy) (done ?x))
             (:functions (long ?x))
             (:durative-action work :parameters (?x ?y) :duration (= ?duration (long ?x))
               :condition (and {conditions}) :effect (and {effects})))"
    );
    let problem = "(define (problem e) (:domain d) (:objects a b)
             (:init (p a) (p b) (= (long a) 1.5) (= (long b) 2)) (:goal (done a)))";
    let scenario = Scenario::parse_pddl(&Source::new("d", domain), &Source::new("p", problem))
        .unwrap_or_else(|faults| panic!("{faults}"));
    assert_eq!(scenario.warnings.iter().filter(|w| w.is_warning()).count(), 1);
    assert_eq!(scenario.domain.cost_unit(), 1000);
    scenario.ground().unwrap_or_else(|faults| panic!("{faults}"))
}

fn shown(task: &Task) -> Vec<String> {
    task.operators.iter().map(|operator| format!("{operator} {}", operator.cost)).collect()
}

#[test]
fn what_is_taken_for_a_while_is_nobody_elses() {
    let task = task(
        "(at start (p ?x)) (at start (not (busy))) (over all (busy)) (over all (= ?x ?y))",
        "(at start (busy)) (at end (not (busy))) (at end (done ?x))",
    );
    assert_eq!(shown(&task), ["work_(a, a) 1500"]);
}

#[test]
fn what_the_start_may_take_away_is_not_asked_for_later() {
    let over = "(at start (p ?y)) (over all (p ?x))";
    let task = task(over, "(at start (not (p ?y))) (at end (p ?y)) (at end (done ?x))");
    assert_eq!(shown(&task), ["work_(a, b) 1500"]);
}

#[test]
fn what_the_end_may_delete_does_not_stay_by_the_start() {
    let task = task("(at start (p ?x))", "(at start (done ?x)) (at end (not (done ?y)))");
    assert_eq!(shown(&task), ["work_(a, b) 1500"]);
}
