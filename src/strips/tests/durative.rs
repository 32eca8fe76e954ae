//! Actions that take their time.

use orthoframe_strips::{FactId, Operator, RuleFault, Scenario, Task};
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

/// The same action in PDDL and in a rule file of either language.
#[test]
fn rule_files_say_of_actions_that_last_what_pddl_says() {
    const PDDL: &str = "(define (domain d) (:requirements :durative-actions) (:predicates (p ?x) (q ?x) (busy) (done ?x))
        (:durative-action work :parameters (?x) :duration (= ?duration 2.5)
          :condition (and (at start (p ?x)) (at start (not (busy))) (over all (q ?x)) (at end (busy)))
          :effect (and (at start (busy)) (at start (not (p ?x))) (at end (not (busy))) (at end (done ?x)))))";
    const PROBLEM: &str =
        "(define (problem e) (:domain d) (:objects a b) (:init (p a) (q a)) (:goal (done a)))";
    let rules = [
        "Действие: work (Параметры: ?x) (Длительность: 2.5) (Предусловие: p(?x) НЕ busy())
         (Всё-время: q(?x)) (Под-конец: busy()) (Начало+: busy()) (Начало-: p(?x))
         (Эффект+: done(?x)) (Эффект-: busy())
         Объекты: a, b  Исходная позиция: p(a) q(a)  Цель: done(a)",
        "Action: work (Parameters: ?x) (Duration: 2.5) (Precondition: p(?x) NOT busy())
         (Throughout: q(?x)) (At-end: busy()) (Start+: busy()) (Start-: p(?x))
         (Effect+: done(?x)) (Effect-: busy())
         Objects: a, b  Initial: p(a) q(a)  Goal: done(a)",
    ];
    let pddl = Scenario::parse_pddl(&Source::new("d", PDDL), &Source::new("p", PROBLEM))
        .unwrap_or_else(|faults| panic!("{faults}"));
    let given = |scenario: &Scenario| {
        let task = scenario.ground().unwrap_or_else(|faults| panic!("{faults}"));
        let facts = |ids: &[FactId]| -> Vec<String> {
            ids.iter().map(|&id| task.fact(id).to_string()).collect()
        };
        let operator = |o: &Operator| {
            (
                o.to_string(),
                o.cost,
                facts(&o.preconditions),
                facts(&o.add_effects),
                facts(&o.del_effects),
            )
        };
        task.operators.iter().map(operator).collect::<Vec<_>>()
    };
    assert_eq!(given(&pddl).len(), 1);
    for text in rules {
        let scenario = Scenario::parse(&Source::new("rules", text))
            .unwrap_or_else(|faults| panic!("{faults}"));
        assert_eq!(given(&scenario), given(&pddl), "{text}");
        assert!(scenario.warnings.iter().any(RuleFault::is_warning));
    }
}

#[test]
fn what_a_start_may_touch_is_asked_in_plain_facts() {
    let text = "Action: work (Parameters: ?x) (Duration: 1) (Precondition: p(?x))
        (Throughout: (p(?x) OR q(?x))) (Start-: p(?x)) (Effect+: done(?x))";
    let told = Scenario::parse(&Source::new("rules", text)).err().map(|faults| faults.to_string());
    assert!(told.is_some_and(|told| told.contains("простые факты")), "it is refused");
}
