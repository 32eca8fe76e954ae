//! What of the goal is wished for.

use orthoframe_strips::{Preference, Scenario, ground};
use orthoframe_units::Source;

const DOMAIN: &str = "(define (domain rounds) (:types room) (:predicates (in ?r - room) (lit ?r - room) (dark ?r - room))
        (:action go :parameters (?a ?b - room) :precondition (in ?a) :effect (and (in ?b) (not (in ?a))))
        (:action light :parameters (?a - room) :precondition (and (in ?a) (dark ?a)) :effect (and (lit ?a) (not (dark ?a)))))";

fn read(rest: &str) -> Result<Scenario, Vec<String>> {
    let problem = format!(
        "(define (problem p) (:domain rounds) (:objects a b - room) (:init (in a) (dark a) (dark b)) {rest})"
    );
    Scenario::parse_pddl(&Source::new("d", DOMAIN), &Source::new("p", &problem))
        .map_err(|faults| faults.0.iter().map(ToString::to_string).collect())
}

fn weights(rest: &str) -> Vec<(String, u64)> {
    let scenario = read(rest).unwrap_or_else(|faults| panic!("{faults:?}"));
    assert!(scenario.warnings.is_empty(), "{:?}", scenario.warnings);
    let told = |own: &Preference| (own.name.clone(), own.weight);
    scenario.problem.preferences().map(told).collect()
}

#[test]
fn weights_come_from_the_metric() {
    let goal =
        "(:goal (and (in b) (preference p (lit a)) (and (preference q (or (dark b) (in a))))))";
    let told = |p, q| vec![("p".to_owned(), p), ("q".to_owned(), q)];
    assert_eq!(weights(goal), told(1000, 1000));
    let metric =
        "(:metric minimize (+ (* 2.5 (is-violated P)) (* (is-violated q) 3) (is-violated q)))";
    assert_eq!(weights(&format!("{goal} {metric}")), told(2500, 4000));
    let metric = "(:metric minimize (+ (total-cost) (is-violated q)))";
    assert_eq!(weights(&format!("{goal} {metric}")), told(0, 1000));
    assert_eq!(weights("(:goal (preference p (lit a)))"), vec![("p".to_owned(), 1000)]);
}

#[test]
fn a_kept_preference_is_a_goal() {
    let scenario = read("(:goal (and (in b) (preference p (lit a)) (preference q (dark a))))");
    let scenario = scenario.unwrap_or_else(|faults| panic!("{faults:?}"));
    let task = |kept: fn(usize) -> bool| {
        let problem = scenario.problem.with_preferences(kept);
        ground(&scenario.domain, &problem).expect("it means something")
    };
    assert_eq!(task(|_| false).goal.len(), 1);
    assert_eq!(task(|number| number == 0).goal.len(), 2);
    assert_eq!(task(|_| true).goal.len(), 3);
}

#[test]
fn what_is_not_read_is_refused_with_its_place() {
    let told = |rest: &str| read(rest).err().unwrap_or_default();
    let unknown = told("(:goal (preference p (lit a))) (:metric minimize (is-violated r))");
    assert_eq!(unknown, ["p:1:155: неизвестное желание «r»"]);
    assert!(!told("(:goal (preference p (lit c)))").is_empty());
    assert!(!told("(:goal (preference p))").is_empty());
    assert!(!told("(:goal (or (preference p (lit a)) (in b)))").is_empty());
    let maximized = read("(:goal (preference p (lit a))) (:metric maximize (is-violated p))");
    assert_eq!(maximized.map(|scenario| scenario.warnings.len()), Ok(1));
}

/// What PDDL says of preferences rule files of either language say as well.
#[test]
fn rule_files_have_wishes() {
    for (heading, or, not) in [("Желательно", "ИЛИ", "НЕ"), ("Preferably", "OR", "NOT")]
    {
        let text = format!(
            "Action: go (Parameters: ?a, ?b) (Precondition: in(?a)) (Effect+: in(?b)) (Effect-: in(?a))
            Action: light (Parameters: ?a) (Precondition: in(?a) dark(?a)) (Effect+: lit(?a)) (Effect-: dark(?a))
            Initial: in(a) dark(b)  Goal: in(b)
            {heading}: light 2.5 (lit(a) {or} dark(b))  home {not} in(a)"
        );
        let scenario = Scenario::parse(&Source::new("rules", &text))
            .unwrap_or_else(|faults| panic!("{faults}"));
        let told = |own: &Preference| (own.name.clone(), own.weight);
        let wishes: Vec<_> = scenario.problem.preferences().map(told).collect();
        assert_eq!(wishes, [("light".to_owned(), 2500), ("home".to_owned(), 1000)]);
        let kept = scenario.problem.with_preferences(|_| true);
        assert!(ground(&scenario.domain, &kept).is_ok());
    }
}
