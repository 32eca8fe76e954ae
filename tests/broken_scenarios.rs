//! Scenarios that were broken on purpose, in rule files of one's own: each is told its true reason, and what is said to help
//! helps.
//!
//! `tests/golden/broken/DOMAIN.txt` holds the rules, or names those of the robot, and after `=== NAME` each scenario with, after `---`, what is told.

use std::fmt::Write as _;

use orthoframe_graphplan::Limits;
use orthoframe_robot::{Reason, Wanted, solve};
use orthoframe_strips::{Scenario, Wording};
use orthoframe_units::{Language, Source};

use crate::files::project;

/// Rules, and each scenario with its name and what is told of it.
fn read(text: &str) -> (String, Vec<(String, String, String)>) {
    let mut parts = text.split("=== ");
    let rules = parts.next().unwrap_or_default().to_owned();
    let case = |part: &str| {
        let (name, rest) = part.split_once('\n').expect("a name ends its line");
        let (scenario, told) = rest.split_once("---\n").expect("a scenario ends at ---");
        (name.to_owned(), scenario.to_owned(), told.to_owned())
    };
    (rules, parts.map(case).collect())
}

#[test]
fn broken_scenarios_are_told_their_true_reasons() {
    let mut wrong = String::new();
    let mut count = 0;
    let domains = [
        "blocks",
        "freight",
        "garden",
        "guard",
        "household",
        "kitchen",
        "lab",
        "lift",
        "store",
        "water",
    ];
    for domain in domains {
        let path = project(&format!("tests/golden/broken/{domain}.txt"));
        let text = std::fs::read_to_string(&path).unwrap();
        let (head, cases) = read(&text);
        let mut now = head.clone();
        // A comment alone names the rules that are the robot's own.
        let rules = match head.strip_prefix("; rules/") {
            Some(file) => std::fs::read_to_string(project(&format!("rules/{}", file.trim()))),
            None => Ok(head.clone()),
        };
        let rules = rules.unwrap();
        for (name, scenario, told) in cases {
            count += 1;
            let read = |text: &str| {
                Scenario::parse(&Source::new(&*name, format!("{rules}{text}")))
                    .unwrap_or_else(|e| panic!("{domain}, {name}: {:?}", miette::Report::new(e)))
            };
            let parsed = read(&scenario);
            let solved =
                solve(&parsed.domain, &parsed.problem, &Limits::default(), Wanted::Shortest)
                    .unwrap();
            let reason =
                solved.reason.as_ref().unwrap_or_else(|| panic!("{name}: there is a plan"));
            let is_russian = rules.contains("Действие");
            let language = if is_russian { Language::Russian } else { Language::English };
            let as_it_is = |name: &str| name.to_owned();
            let phrases = parsed.domain.phrases();
            let wording = Wording { language, phrases, name: &as_it_is };
            let words = format!("{}\n", reason.in_words(&wording));
            let _ = write!(now, "=== {name}\n{scenario}---\n{words}");
            if told != words {
                let _ = write!(wrong, "{domain}, {name}:\n{words}");
            }
            // What is said to help helps, or what is told then is not that again.
            let Reason::Unreachable(obstacles) = reason else { continue };
            for help in obstacles.iter().flat_map(|obstacle| &obstacle.help) {
                let facts: Vec<String> = help.iter().map(ToString::to_string).collect();
                if facts.iter().any(|fact| fact.contains('?') || fact.starts_with("НЕ ")) {
                    continue;
                }
                let heading = if is_russian {
                    "Исходная позиция:\n"
                } else {
                    "Initial position:\n"
                };
                let helped = scenario.replace(heading, &format!("{heading}{}\n", facts.join("\n")));
                let parsed = read(&helped);
                let again =
                    solve(&parsed.domain, &parsed.problem, &Limits::default(), Wanted::Shortest)
                        .unwrap();
                assert!(again.outcome.plan().is_some(), "{domain}, {name}: {facts:?} do not help");
            }
        }
        if std::env::var_os("UPDATE_EXPECT").is_some() {
            std::fs::write(&path, now).unwrap();
        }
    }
    assert_eq!(count, 81);
    assert!(std::env::var_os("UPDATE_EXPECT").is_some() || wrong.is_empty(), "{wrong}");
}

/// Rooms, keys and water: who takes a key, or unlocks with it, wets the floor, and nobody drives through water.
const WET: &str = "(define (domain wet) (:requirements :typing :negative-preconditions) (:types room key)
 (:predicates (at ?r - room) (next ?a ?b - room) (wet ?r - room) (open ?r - room) (has ?k - key)
   (fits ?k - key ?r - room) (lies ?k - key ?r - room))
 (:action go :parameters (?a ?b - room)
   :precondition (and (at ?a) (next ?a ?b) (not (wet ?b)) (open ?b)) :effect (and (at ?b) (not (at ?a))))
 (:action take :parameters (?k - key ?r - room)
   :precondition (and (at ?r) (lies ?k ?r)) :effect (and (has ?k) (not (lies ?k ?r)) (wet ?r)))
 (:action unlock :parameters (?k - key ?a ?b - room)
   :precondition (and (at ?a) (next ?a ?b) (has ?k) (fits ?k ?b)) :effect (and (open ?b) (wet ?b))))";

/// Boxes that are taken with an alarm, which bars the way to whoever holds none.
const ALARM: &str =
    "(define (domain alarm) (:requirements :adl) (:types room box) (:constants c - room)
 (:predicates (at ?r - room) (next ?a ?b - room) (heavy ?x - box) (in ?x - box ?r - room)
   (held ?x - box) (alarm) (done))
 (:action go :parameters (?a ?b - room)
   :precondition (and (at ?a) (next ?a ?b) (or (not (alarm)) (exists (?x - box) (held ?x))))
   :effect (and (at ?b) (not (at ?a))))
 (:action take :parameters (?x - box ?r - room)
   :precondition (and (at ?r) (in ?x ?r) (not (heavy ?x)) (forall (?y - box) (not (held ?y))))
   :effect (and (held ?x) (not (in ?x ?r)) (alarm)))
 (:action finish :parameters () :precondition (forall (?x - box) (in ?x c)) :effect (done)))";

/// Of negative preconditions and conditions beyond literals: where the fact that is lacking would not be enough, nothing is
/// said to help; where it would, it is.
#[test]
fn only_what_brings_a_plan_is_said_to_help() {
    let rooms = "(:objects a b c - room k - key)";
    let boxes = "(:objects a b - room x y - box)";
    let cases = [
        // Dry or not, who unlocks the last room has wet it.
        (
            WET,
            rooms,
            "(next a b) (next b a) (next b c) (open b) (wet b) (lies k b) (fits k c)",
            "(at c)",
            &[][..],
        ),
        (WET, rooms, "(next a b) (next b c) (open b) (open c) (wet b)", "(at c)", &["НЕ wet(b)"]),
        (
            ALARM,
            boxes,
            "(next a b) (next b c) (in x a) (in y c) (alarm) (heavy x)",
            "(at c)",
            &["НЕ alarm()"],
        ),
        (ALARM, boxes, "(next a b) (in x a) (in y c) (heavy x)", "(done)", &["in(x, c)"]),
    ];
    for (domain, objects, init, goal, expected) in cases {
        let problem = format!(
            "(define (problem p) (:domain {}) {objects} (:init (at a) {init}) (:goal (and {goal})))",
            if domain == WET { "wet" } else { "alarm" }
        );
        let texts = [Source::new("domain", domain), Source::new("problem", &problem)];
        let parsed = Scenario::parse_pddl(&texts[0], &texts[1])
            .unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)));
        let limits = Limits::default();
        let solved = solve(&parsed.domain, &parsed.problem, &limits, Wanted::Shortest).unwrap();
        let Some(Reason::Unreachable(obstacles)) = &solved.reason else {
            panic!("{init}: {:?}", solved.reason)
        };
        let help: Vec<String> = obstacles
            .iter()
            .flat_map(|obstacle| &obstacle.help)
            .map(|facts| facts.iter().map(ToString::to_string).collect::<Vec<_>>().join(" "))
            .map(|facts| facts.replace('_', ""))
            .collect();
        assert_eq!(help, expected, "{init}");
    }
}
