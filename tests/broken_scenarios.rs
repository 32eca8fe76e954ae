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
