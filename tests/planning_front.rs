//! What strangers write and ask: phrases of the rules, withdrawn assumptions, plans of others, spoilt rule files and PDDL.

use std::path::Path;

use miette::Diagnostic;
use orthoframe_graphplan::{Limits, Outcome, solve};
use orthoframe_robot::{Solved, Wanted, solve as solve_problem, solve_without};
use orthoframe_strips::{PlanText, RuleFaults, Scenario};
use orthoframe_units::{English, Language, Source};

use crate::planning_properties::Drawn;
use crate::planning_properties::random::Random;

fn read(text: &str) -> Result<Scenario, RuleFaults> {
    Scenario::parse(&Source::new("правила", text))
}

fn pddl(domain: &str, problem: &str) -> Result<Scenario, RuleFaults> {
    Scenario::parse_pddl(&Source::new("domain", domain), &Source::new("problem", problem))
}

fn solved(scenario: &Scenario) -> Solved {
    let limits = Limits::default();
    solve_problem(&scenario.domain, &scenario.problem, &limits, Wanted::Shortest).unwrap()
}

/// Every fault with its place, a line each.
fn told(read: Result<Scenario, RuleFaults>) -> String {
    match read.and_then(|scenario| scenario.ground().map(|_| ())) {
        Ok(()) => String::new(),
        Err(faults) => faults.0.iter().map(|fault| format!("{fault}\n")).collect(),
    }
}

// ─── Phrases ───

const DOOR: &str = "
    Действие: Открыть (Параметры: дверь ?y, человек ?h)
    (Предусловие: ЗАКРЫТА_(?y) СТОИТ-У_(?h, ?y) НЕ ЗАСОВ_(?y))
    (Эффект+: ОТКРЫТА_(?y)) (Эффект-: ЗАКРЫТА_(?y))
    Предположения: ЗАКРЫТА_(Дверь-1)
    Цель: ОТКРЫТА_(Дверь-1)
    По-английски:
      дверь = «door»
      человек = «person»
      ОТКРЫТА_(?y) = «?y is open»
      СТОИТ-У_(?h, ?y) = «?h stands at ?y»
      ЗАСОВ_(?y) = «?y is barred»
      Открыть_(?y, ?h) = «have ?h open ?y»";

#[test]
fn phrases_of_the_rules_speak_english() {
    let scenario = read(&format!("{DOOR}\nФакты: СТОИТ-У_(Анна, Дверь-1)")).unwrap();
    let found = solved(&scenario);
    let name = |name: &str| name.replace("Дверь-1", "Door 1").replace("Анна", "Anna");
    let wording = found.wording(Language::English, &name);
    let Outcome::Plan(plan) = &found.outcome else { panic!("the door opens") };
    let action = found.task.operator(plan.steps[0][0]).into();
    assert_eq!(wording.action(&action), "have Anna open Door 1");
    // What has no phrase is told as the rules write it.
    assert_eq!(found.assumptions_with(&wording), ["ЗАКРЫТА_(Дверь-1)"]);

    let why = solved(&read(DOOR).unwrap()).explanation(Language::English).unwrap();
    expect_test::expect![[r#"
        the goal that Дверь-1 is open is out of reach
          for this (have a person open Дверь-1) it must be that a person stands at Дверь-1; it is not so, and no action brings it about
        It would help if a person stands at Дверь-1"#]]
    .assert_eq(&why);
    let barred = format!("{DOOR}\nФакты: СТОИТ-У_(Анна, Дверь-1) ЗАСОВ_(Дверь-1)");
    let why = solved(&read(&barred).unwrap()).explanation(Language::English).unwrap();
    assert!(why.contains("it is not so that Дверь-1 is barred"), "{why}");
    // In Russian nothing changes.
    let why = solved(&read(&barred).unwrap()).explanation(Language::Russian).unwrap();
    assert!(why.contains("(Открыть) нужно НЕ ЗАСОВ_(Дверь-1)"), "{why}");
}

#[test]
fn faults_of_phrases_are_told_with_their_places() {
    let text = format!(
        "{DOOR}
ОТКРЫТ_(?y) = «?y is open»
СТОИТ-У_(?h) = «?h stands»
ЗАКРЫТА_(?y) = «?z is closed»
двери = «doors»"
    );
    expect_test::expect![[r#"
        правила:14:1: неизвестный предикат «ОТКРЫТ»
        правила:15:1: «СТОИТ-У»: аргументов 2, а дано 1
        правила:16:16: в словах стоит «?z», а среди аргументов её нет
        правила:17:1: неизвестный тип «двери»
    "#]]
    .assert_eq(&told(read(&text)));
    let cut = told(read(&format!("{DOOR}\nЗАКРЫТА_(?y) «closed»\n")));
    assert!(cut.contains("«=» и слова в кавычках"), "{cut}");
}

/// Every predicate, action and type of the service robot can be said in English.
#[test]
fn the_service_robots_rules_have_english_words_for_everything() {
    let rules = Path::new(env!("CARGO_MANIFEST_DIR")).join("rules/service-robot.strips");
    let domain = Scenario::read(&rules).unwrap().domain;
    let text = std::fs::read_to_string(rules).unwrap();
    let section = text.split("По-английски:").nth(1).unwrap().split("═══").next().unwrap();
    let has = |name: &str, mark: char| {
        section.lines().any(|line| {
            let line = line.trim_start();
            line.strip_prefix(name).is_some_and(|rest| {
                rest.trim_start_matches('_').trim_start().starts_with(mark) && rest.contains('«')
            })
        })
    };
    let predicates = domain.predicates().iter().map(|p| p.name.as_str());
    let actions = domain.schemas().iter().map(|s| s.name.as_str());
    let silent: Vec<&str> = predicates.chain(actions).filter(|name| !has(name, '(')).collect();
    assert_eq!(silent, [""; 0], "no English words");
    let kinds = domain.kinds().iter().map(|k| k.name.as_str());
    assert_eq!(kinds.filter(|name| !has(name, '=')).collect::<Vec<_>>(), [""; 0]);
}

// ─── Assumptions withdrawn ───

#[test]
fn what_was_withdrawn_is_what_would_help() {
    let text = "
        Действие: Идти (Параметры: место ?a, место ?b)
        (Предусловие: РОБОТ-В_(?a) ДОРОГА_(?a, ?b)) (Эффект+: РОБОТ-В_(?b)) (Эффект-: РОБОТ-В_(?a))
        Действие: Проложить (Параметры: место ?a, место ?b)
        (Предусловие: МОСТ_(?a, ?b)) (Эффект+: ДОРОГА_(?a, ?b))
        Факты: РОБОТ-В_(А)
        Предположения: ДОРОГА_(А, Б) ДОРОГА_(Б, В) ДОРОГА_(А, Г) ДОРОГА_(Г, Д) ДОРОГА_(Д, В)
        Цель: РОБОТ-В_(В)";
    let scenario = read(text).unwrap();
    let without = |facts: &[&str]| {
        let facts: Vec<String> = facts.iter().map(|&fact| fact.to_owned()).collect();
        let mut problem = scenario.problem.clone();
        let limits = Limits::default();
        solve_without(None, &scenario.domain, &mut problem, &facts, &limits, Wanted::Shortest)
    };
    let other = without(&["ДОРОГА_(Б, В)"]).unwrap();
    assert!(other.rested_on() && other.learned_before);
    let steps = |solved: &Solved| match &solved.outcome {
        Outcome::Plan(plan) => Some(plan.steps.len()),
        _ => None,
    };
    assert_eq!((steps(&other.before), steps(&other.after)), (Some(2), Some(3)));
    let same = without(&["дорога(г, д)"]).unwrap();
    assert!(!same.rested_on());
    assert_eq!(steps(&same.after), Some(2));
    // A variable stands for any object.
    let none = without(&["ДОРОГА_(?x, В)"]).unwrap();
    assert_eq!((none.withdrawn.len(), steps(&none.after)), (2, None));
    let why = none.after.explanation(Language::Russian).unwrap();
    assert!(why.contains("Помогло бы: ДОРОГА_(Б, В)"), "{why}");

    let codes = |facts: &[&str]| without(facts).map(|_| ()).unwrap_err().codes();
    assert_eq!(codes(&["РОБОТ-В_(А)"]), ["strips::not_assumed"]);
    assert_eq!(
        codes(&["ДОРОГА_(А, Ы)", "ДОРОГ_(А, Б)", "ДОРОГА_(А)", "НЕ ДОРОГА_(А, Б)", "ДОРОГА"]),
        [
            "strips::not_assumed",
            "strips::unknown_predicate",
            "strips::arity",
            "strips::syntax",
            "strips::syntax"
        ]
    );
}

/// Rules drawn at random, some of whose facts are assumptions: planning with what was learned comes to the same as
/// planning anew.
#[test]
fn planning_without_an_assumption_comes_to_what_planning_anew_comes_to() {
    let (mut learned, mut rested, mut lost) = (0, 0, 0);
    for seed in 1..=700 {
        let drawn = Drawn::new(2 * seed + 1);
        if drawn.goal.is_empty() {
            continue;
        }
        let text = drawn.as_rules().replace("Факты: ", "Предположения: ");
        let scenario = read(&text).unwrap();
        let assumed = text.split("Предположения: ").nth(1).unwrap().split('\n').next().unwrap();
        for fact in assumed.split_inclusive(')').map(str::trim).filter(|fact| !fact.is_empty()) {
            let (mut problem, limits) = (scenario.problem.clone(), Limits::default());
            let facts = [fact.to_owned()];
            let replanned = solve_without(
                None,
                &scenario.domain,
                &mut problem,
                &facts,
                &limits,
                Wanted::Shortest,
            );
            let replanned = replanned.unwrap_or_else(|faults| panic!("seed {seed}: {faults}"));
            let anew = solve_problem(&scenario.domain, &problem, &limits, Wanted::Shortest);
            let steps = |outcome: &Outcome| match outcome {
                Outcome::Plan(plan) => Some(plan.steps.len()),
                Outcome::NoPlan { .. } => None,
                Outcome::LimitReached(limit) => panic!("seed {seed}: {limit:?}"),
            };
            let now = steps(&replanned.after.outcome);
            assert_eq!(now, steps(&anew.unwrap().outcome), "seed {seed}: {fact}\n{text}");
            if let Outcome::Plan(plan) = &replanned.after.outcome {
                let written = PlanText::write(&replanned.after.task, &plan.steps);
                let written = PlanText::parse(&Source::new("план", written)).unwrap();
                let check = written.check(&scenario.domain, &problem);
                check.unwrap_or_else(|faults| panic!("seed {seed}: {fact}: {faults}"));
            }
            learned += usize::from(replanned.learned_before);
            rested += usize::from(replanned.rested_on());
            lost += usize::from(steps(&replanned.before.outcome).is_some() && now.is_none());
        }
    }
    assert!(
        learned > 200 && rested > 20 && lost > 8,
        "{learned} learned, {rested} rested, {lost} lost"
    );
}

// ─── Declarations ───

#[test]
fn an_object_of_two_unrelated_types_is_a_fault_with_both_places() {
    let rules = |objects: &str| {
        let text = format!(
            "Типы: место\n кухня — место\n человек\nДействие: Идти (Параметры: место ?a)
(Предусловие: ЕСТЬ_(?a)) (Эффект+: БЫЛ_(?a))\nОбъекты: {objects}\nФакты: ЕСТЬ_(А)\nЦель: БЫЛ_(А)"
        );
        read(&text)
    };
    let twice = rules("А — место\n А — человек").unwrap_err();
    assert_eq!(twice.codes(), ["strips::object_twice"]);
    let labels: Vec<usize> = twice.0[0].labels().unwrap().map(|label| label.offset()).collect();
    assert_eq!(labels.len(), 2, "both places");
    assert!(labels[1] < labels[0]);
    // The same again, and a special case of it, are no contradiction.
    assert_eq!(told(rules("А — место\n А — место")), "");
    assert_eq!(told(rules("А — место\n А — кухня")), "");

    let domain = "(define (domain d) (:types truck plane - vehicle city) (:constants x - truck)
        (:predicates (at ?v - vehicle ?c - city))
        (:action go :parameters (?v - vehicle ?a ?b - city) :precondition (at ?v ?a)
         :effect (and (at ?v ?b) (not (at ?v ?a)))))";
    let problem = |objects: &str| {
        format!(
            "(define (problem p) (:domain d) (:objects a b - city {objects}) (:init (at x a)) (:goal (at x b)))"
        )
    };
    assert_eq!(told(pddl(domain, &problem("x - truck"))), "");
    assert_eq!(told(pddl(domain, &problem("x - vehicle"))), "");
    let twice = pddl(domain, &problem("x - plane")).unwrap_err();
    let help = twice.0[0].help().unwrap().to_string();
    assert_eq!(twice.codes(), ["strips::object_twice"]);
    assert!(help.contains("первый раз – domain:1:68"), "{help}");
}

/// The first use alone had a bracket at the wrong place, and every later use was blamed.
#[test]
fn of_two_arities_the_rarer_is_blamed() {
    let text = "Действие: Идти (Параметры: комната ?a, комната ?b)
(Предусловие: В_(?a, ?b) ПУТЬ_(?a, ?b)) (Эффект+: В_(?b)) (Эффект-: В_(?a))
Факты: В_(К1) ПУТЬ_(К1, К2)  Цель: В_(К2)";
    let faults = read(text).unwrap_err();
    let told: Vec<String> =
        faults.0.iter().map(|fault| format!("{fault} – {}", fault.help().unwrap())).collect();
    assert_eq!(
        told,
        [
            "правила:2:15: «В»: аргументов 1, а дано 2 – запись: В_(комната), как здесь: правила:2:51"
        ]
    );
}

/// Decided: an action may pass a parameter of a wider type than the predicate takes; what facts there are narrows it.
#[test]
fn an_action_may_pass_a_wider_type_and_facts_narrow_it() {
    let domain = "(define (domain d) (:types truck plane - vehicle crate)
        (:predicates (wheels ?t - truck) (moved ?v - vehicle) (full ?c - crate))
        (:action roll :parameters (?v - vehicle) :precondition (wheels ?v) :effect (moved ?v)))";
    let problem = "(define (problem p) (:domain d) (:objects t - truck a - plane)
        (:init (wheels t)) (:goal (moved t)))";
    let task = pddl(domain, problem).unwrap().ground().unwrap();
    assert_eq!(task.operators.len(), 1);
    // A type that can never fit is a fault, and so is a fact of the wrong type.
    let never = domain.replace("(wheels ?v)", "(full ?v)");
    assert_eq!(pddl(&never, problem).unwrap_err().codes(), ["strips::argument_type"]);
    let wrong = problem.replace("(wheels t)", "(wheels a)");
    assert_eq!(pddl(domain, &wrong).unwrap_err().codes(), ["strips::argument_type"]);
}

/// A file of rules that is wrong in many ways tells of objects that nobody knows as well.
#[test]
fn unknown_objects_of_the_goal_are_told_beside_faults_of_the_rules() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.strips");
    let text = "Типы: место\nДействие: Идти (Параметры: место ?a, мест ?b) (Предусловие: В_(?a))
(Эффект+: В_(?b)) (Стоимость: -3)\nФакты: В_(Кухня)\nЦель: В_(Кухн)";
    std::fs::write(&path, text).unwrap();
    let (scenario, faults) = Scenario::read_whole(&path).unwrap();
    let all = scenario.with_faults_of_names(faults).codes();
    assert_eq!(all, ["strips::unknown_type", "strips::cost", "strips::unknown_object"]);
}

/// Several objects of one declaration share their type, and its fault.
#[test]
fn a_fault_of_one_place_is_told_once() {
    let problem = GRIPPER.1.replace("ra rb - room", "ra rb - rom");
    assert!(
        told(pddl(GRIPPER.0, &problem)).lines().filter(|line| line.contains("rom")).count() == 1
    );
}

// ─── Plans as text ───

#[test]
fn plans_with_odd_names_come_back() {
    let text = "
Типы: вещь
 ящик — вещь
Действие: «Сложить в (ящик)»
(Параметры: вещь ?a, ящик ?b)
(Предусловие: СВОБОДНА_(?a) НЕ ПОЛОН_(?b) ?a ≠ ?b) (Эффект+: ЛЕЖИТ-В_(?a, ?b)) (Эффект-: СВОБОДНА_(?a)) (Стоимость: 7)
Действие: Свистнуть (Параметры: ) (Предусловие: ) (Эффект+: СВИСТ_())
Объекты: «Стол \"Вега\"», «чашка; №5», Ёж-1, «a\u{a0}b» — вещь
 Ящик, «Ящик (2)» — ящик
Факты: СВОБОДНА_(«Стол \"Вега\"») СВОБОДНА_(«чашка; №5») СВОБОДНА_(Ёж-1) СВОБОДНА_(«a\u{a0}b»)
Цель: ЛЕЖИТ-В_(«Стол \"Вега\"», Ящик) ЛЕЖИТ-В_(«чашка; №5», «Ящик (2)») ЛЕЖИТ-В_(Ёж-1, Ящик) ЛЕЖИТ-В_(«a\u{a0}b», Ящик)
 СВИСТ_() НЕ СВОБОДНА_(Ёж-1)";
    let scenario = read(text).unwrap();
    let task = scenario.ground().unwrap();
    let Outcome::Plan(plan) = solve(&task, &Limits::default()) else { panic!("all can be stowed") };
    assert_eq!((plan.steps.len(), plan.action_count()), (1, 5));
    let written = PlanText::write(&task, &plan.steps);
    let again = PlanText::parse(&Source::new("план", &written)).unwrap();
    let replayed = again.replay(&scenario.domain, &scenario.problem).unwrap();
    assert!(replayed.broken.is_none(), "{written}{:?}", replayed.broken);
    assert_eq!(replayed.cost, plan.cost(&task));
    assert!(written.ends_with(&format!("; cost = {}\n", plan.cost(&task))), "{written}");
}

const GRIPPER: (&str, &str) = (
    "(define (domain g) (:types room ball gripper)
      (:predicates (at-robby ?r - room) (at ?b - ball ?r - room) (free ?g - gripper) (carry ?b - ball ?g - gripper))
      (:action move :parameters (?f ?t - room) :precondition (at-robby ?f) :effect (and (at-robby ?t) (not (at-robby ?f))))
      (:action pick :parameters (?b - ball ?r - room ?g - gripper) :precondition (and (at ?b ?r) (at-robby ?r) (free ?g))
        :effect (and (carry ?b ?g) (not (at ?b ?r)) (not (free ?g))))
      (:action drop :parameters (?b - ball ?r - room ?g - gripper) :precondition (and (carry ?b ?g) (at-robby ?r))
        :effect (and (at ?b ?r) (free ?g) (not (carry ?b ?g)))))",
    "(define (problem p) (:domain g) (:objects ra rb - room b1 b2 - ball l r - gripper)
      (:init (at-robby ra) (at b1 ra) (at b2 ra) (free l) (free r)) (:goal (and (at b1 rb) (at b2 rb))))",
);

fn check(plan: &str) -> Result<String, String> {
    let scenario = pddl(GRIPPER.0, GRIPPER.1).unwrap();
    let plan = PlanText::parse(&Source::new("plan", plan)).map_err(|faults| faults.to_string())?;
    let replayed = plan.replay(&scenario.domain, &scenario.problem).unwrap();
    Ok(match replayed.broken {
        None => format!("{} steps", replayed.steps.len()),
        Some(broken) => {
            broken.faults.0.iter().map(|fault| format!("{fault}\n")).collect::<String>()
        }
    })
}

/// VAL's own layout, Fast Downward's `sas_plan`, LPG's and YAHSP's times and durations.
#[test]
fn plans_as_others_write_them_are_read() {
    let layouts = [
        "0: (pick b1 ra l)\n0: (pick b2 ra r)\n1: (move ra rb)\n2: (drop b1 rb l)\n2: (drop b2 rb r)\n",
        "0.000: (PICK B1 RA L) [1]\n0.000: (PICK B2 RA R) [1]\n1.000: (MOVE RA RB) [1.000]\n2.000: (DROP B1 RB L) [1]\n2.000: (DROP B2 RB R) [1]\n",
        "; Time 0.00\n;MakeSpan 3\n   0.0003:   (pick b1 ra l) [1.0000]\n   0.0003:   (pick b2 ra r) [1.0000]\n   1.0005:   (move ra rb) [1.0000]\n   2.0008: (drop b1 rb l)[1]\n   2.0008:   (drop b2 rb r) [1.0000]\r\n",
    ];
    for layout in layouts {
        assert_eq!(check(layout), Ok("3 steps".to_owned()), "{layout}");
    }
    let sas = "(pick b1 ra l)\n(pick b2 ra r)\n(move ra rb)\n(drop b1 rb l)\n(drop b2 rb r)\n; cost = 5 (unit cost)\n";
    assert_eq!(check(sas), Ok("5 steps".to_owned()));
}

#[test]
fn broken_plans_are_told_with_all_that_means_nothing() {
    let faults = check(
        "(pick b1 ra l)\n(pick b1 ra r)\n(mov ra rb)\n(drop b1 rb)\n(drop b9 rb l)\n(drop rb b1 l)\n",
    );
    expect_test::expect![[r#"
        plan:2:1: действие невыполнимо: не выполнено at_(b1, ra)
        plan:3:1: неизвестное действие «mov»
        plan:4:1: «drop»: аргументов 3, а дано 2
        plan:5:7: неизвестный объект «b9»
        plan:6:7: «rb» не подходит: здесь должен стоять объект типа «ball»
        plan:6:10: «b1» не подходит: здесь должен стоять объект типа «room»
    "#]]
    .assert_eq(&faults.unwrap());
    let together = check("0: (pick b1 ra l)\n0: (move ra rb)\n").unwrap();
    assert!(together.contains("мешают друг другу"), "{together}");
    let short = check("0: (pick b1 ra l)\n").unwrap();
    assert!(short.contains("не выполнена цель at_(b1, rb)"), "{short}");
    let unreadable = check("0: (pick b1 ra l\nmove ra rb\n(()\n").unwrap_err();
    assert!(unreadable.contains("plan:1:4"), "{unreadable}");
}

// ─── PDDL of strangers ───

/// A domain and a problem in Latin letters, words of which were dropped, doubled, exchanged or misspelt: what is told
/// of them in English has no other letters, and a place wherever it has one in Russian.
#[test]
fn faults_of_spoilt_pddl_are_english_where_english_is_asked_for() {
    let mut random = Random::new(7);
    let mut codes = std::collections::BTreeSet::new();
    let spoil = |text: &str, random: &mut Random| {
        let text = text.replace('(', " ( ").replace(')', " ) ");
        let mut words: Vec<String> = text.split_whitespace().map(str::to_owned).collect();
        for _ in 0..=random.below(3) {
            let (at, other) = (random.below(words.len()), random.below(words.len()));
            match random.below(6) {
                0 => drop(words.remove(at)),
                1 => words.insert(at, words[other].clone()),
                2 => words.swap(at, other),
                3 => words[at].push('x'),
                4 => words.insert(at, [")", "(", "or", "-7", "(when", "?u", "$"][other % 7].into()),
                _ => words[at] = words[other].clone(),
            }
        }
        words.join(" ")
    };
    for _ in 0..2000 {
        let (domain, problem) = (spoil(GRIPPER.0, &mut random), spoil(GRIPPER.1, &mut random));
        let Err(faults) = pddl(&domain, &problem) else { continue };
        for fault in &faults.0 {
            let english = English(fault);
            let labels = english.labels().into_iter().flatten();
            let labels: Vec<String> = labels.filter_map(|l| l.label().map(str::to_owned)).collect();
            let help = english.help().map(|help| help.to_string());
            let told = format!("{english} {help:?} {labels:?}");
            assert!(!told.chars().any(|c| matches!(c, 'а'..='я' | 'А'..='Я')), "{told}");
            assert_eq!(help.is_some(), fault.help().is_some(), "{told}");
            let places = fault.labels().into_iter().flatten().count();
            assert_eq!(labels.len(), places, "{told}");
        }
        codes.extend(faults.codes());
    }
    assert!(codes.len() >= 15, "{codes:?}");
}

#[test]
fn an_empty_goal_holds_and_a_missing_one_is_a_fault() {
    let goal = |goal: &str| {
        pddl(GRIPPER.0, &GRIPPER.1.replace("(:goal (and (at b1 rb) (at b2 rb)))", goal))
    };
    for empty in ["(:goal (and))", "(:goal ())", "(:goal (and (and)))"] {
        let found = solved(&goal(empty).unwrap());
        assert!(matches!(&found.outcome, Outcome::Plan(plan) if plan.steps.is_empty()), "{empty}");
    }
    assert_eq!(told(goal("")), "у сценария нет цели\n");
}

/// A requirement beyond what is read harms nobody who makes no use of it; what does is refused with a way round.
#[test]
fn what_is_beyond_is_refused_by_name_and_place_with_a_way_round() {
    let adl = GRIPPER.0.replace("(:types", "(:requirements :strips :ADL :fluents)\n(:types");
    let read = pddl(&adl, GRIPPER.1).unwrap();
    let warnings: Vec<String> = read.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(warnings, ["domain:1:48: требование «:fluents» шире того, что читается"]);
    let refused = |from: &str, to: &str| {
        let domain = GRIPPER.0.replace(from, to);
        assert_ne!(domain, GRIPPER.0);
        let faults = pddl(&domain, GRIPPER.1).unwrap_err();
        let fault = &faults.0[0];
        let help = fault.help().unwrap().to_string();
        assert_eq!(faults.codes(), ["strips::unsupported"], "{faults}");
        (fault.error.to_string(), help)
    };
    let need = ":precondition (at-robby ?f)";
    let (what, help) = refused(need, ":precondition (>= (fuel) 3)");
    assert!(what.contains("«>=»") && help.contains("стоимость"), "{what} {help}");
    let (what, help) = refused(need, ":precondition (preference p (at-robby ?f))");
    assert!(what.contains("«preference»") && help.contains("желания читаются"), "{what} {help}");
    let (what, _) = refused("(:action move", "(:constraints (always (at-robby ?f))) (:action move");
    assert!(what.contains("«:constraints»"), "{what}");
    let (what, _) = refused(
        "(:action move",
        "(:durative-action fly :parameters (?f - room) :duration (= ?duration 5)
           :effect (forall (?r - room) (at end (at-robby ?r))))\n (:action move",
    );
    assert!(what.contains("«forall»"), "{what}");
    let derived =
        GRIPPER.0.replace("(:action move", "(:derived (at-robby ?f) (at-robby ?f)) (:action move");
    let faults = pddl(&derived, GRIPPER.1).unwrap_err();
    assert_eq!(faults.codes(), ["strips::derived_stated"], "{faults}");
}

#[test]
fn one_wrong_bracket_is_one_fault() {
    let open = GRIPPER.0.replace(
        "(and (at ?b ?r) (at-robby ?r) (free ?g))",
        "(and (at ?b ?r (at-robby ?r) (free ?g))",
    );
    assert_eq!(told(pddl(&open, GRIPPER.1)), "domain:4:7: скобка не закрыта\n");
    let surplus = GRIPPER.0.replace("(not (at-robby ?f))))", "(not (at-robby ?f)))))");
    let told_of = told(pddl(&surplus, GRIPPER.1));
    assert!(told_of.contains("«(define …)» здесь закрыто, а дальше стоит «(:action»"), "{told_of}");
    assert_eq!(told_of.lines().count(), 1, "{told_of}");
    // Both files at once.
    let both = told(pddl(&open, &GRIPPER.1.replace("(at b2 ra)", "(att b2 ra) (at b2)")));
    assert_eq!(both.lines().count(), 3, "{both}");
}

/// Texts cut, doubled and stirred at random: faults, or another problem, but never a panic.
#[test]
fn stirred_texts_are_read_without_panic() {
    let russian = DOOR.to_owned() + "\nФакты: СТОИТ-У_(Анна, Дверь-1)";
    let mut random = Random::new(7);
    let mut stir = |text: &str| -> String {
        let mut letters: Vec<char> = text.chars().collect();
        for _ in 0..=random.below(3) {
            if letters.len() < 2 {
                break;
            }
            let (at, to) = (random.below(letters.len()), random.below(letters.len()));
            match random.below(5) {
                0 => drop(letters.remove(at)),
                1 => letters.swap(at, to),
                2 => letters.insert(at, "()?:-«»\"=;".chars().nth(random.below(10)).unwrap()),
                3 => drop(letters.drain(at.min(to)..at.max(to).min(at.min(to) + 40))),
                _ => letters.truncate(at.max(1)),
            }
        }
        letters.into_iter().collect()
    };
    let (mut good, mut bad) = (0, 0);
    for _ in 0..500 {
        let results = [
            told(read(&stir(&russian))),
            told(pddl(&stir(GRIPPER.0), GRIPPER.1)),
            told(pddl(GRIPPER.0, &stir(GRIPPER.1))),
        ];
        for result in results {
            *(if result.is_empty() { &mut good } else { &mut bad }) += 1;
        }
        let _ = check(&stir("0: (pick b1 ra l)\n1: (move ra rb)\n2: (drop b1 rb l)\n"));
    }
    assert!(good > 15 && bad > 330, "{good} good, {bad} bad");
}

#[test]
fn pddl_names_that_differ_in_an_underscore_are_two() {
    let domain = "(define (domain d) (:types place place_ - object) (:predicates (at ?p - place) (at_ ?p - place) (seen_ ?p - place_))
        (:action move :parameters (?a - place) :precondition (at ?a) :effect (and (not (at ?a)) (at_ ?a)))
        (:action move_ :parameters (?a - place ?b - place_) :precondition (at_ ?a) :effect (seen_ ?b)))";
    let problem = "(define (problem p) (:domain d) (:objects x x__ - place x_ - place_) (:init (at x)) (:goal (seen_ x_)))";
    let scenario = pddl(domain, problem).unwrap();
    let task = scenario.ground().unwrap();
    let Outcome::Plan(plan) = solve(&task, &Limits::default()) else { panic!("there is a plan") };
    let text = PlanText::write(&task, &plan.steps);
    assert!(text.contains("0: (move x)\n1: (move_ x x_)"), "{text}");
    let read = PlanText::parse(&Source::new("план", &text)).unwrap();
    assert!(read.check(&scenario.domain, &scenario.problem).is_ok());
    // What nobody declared is not taken for its neighbour.
    let faults =
        pddl(&domain.replace("(at_ ?a) :effect", "(at__ ?a) :effect"), problem).unwrap_err();
    assert_eq!(faults.codes(), ["strips::unknown_predicate"]);
}

/// A van stands in the yard, but only a lorry could take the goods: that no vehicle is there would be untrue.
#[test]
fn an_explanation_names_the_type_that_the_action_asks_for() {
    let domain = "(define (domain d) (:types vehicle goods place - object van lorry - vehicle)
        (:predicates (at ?v - vehicle ?p - place) (lies ?g - goods ?p - place) (gone ?g - goods))
        (:action load :parameters (?l - lorry ?g - goods ?p - place) :precondition (and (lies ?g ?p) (at ?l ?p)) :effect (gone ?g)))";
    let problem = "(define (problem p) (:domain d) (:objects v - van g - goods yard - place) (:init (at v yard) (lies g yard)) (:goal (gone g)))";
    let told = solved(&pddl(domain, problem).unwrap()).explanation(Language::Russian).unwrap();
    assert!(told.contains("lorry") && !told.contains("vehicle"), "{told}");
}

/// Types in chains as long as one likes, told from either end, with a second parent or without: each is looked at once.
#[test]
fn long_chains_of_types_end() {
    const LENGTH: usize = 20_000;
    let problem = "(define (problem p) (:domain d) (:objects o - t0) (:init) (:goal (p o)))";
    let link =
        |n: usize, other: &str| format!("t{n} - {}\n", other.replace('#', &format!("t{}", n + 1)));
    let chains = [
        (0..LENGTH).map(|n| link(n, "#")).collect::<String>(),
        (0..LENGTH).rev().map(|n| link(n, "#")).collect(),
        (0..LENGTH).map(|n| link(n, "(either # u)")).collect(),
    ];
    for chain in chains {
        let domain = format!(
            "(define (domain d) (:requirements :typing) (:types {chain} t{LENGTH} u - object)
             (:predicates (p ?x - t{LENGTH}))
             (:action a :parameters (?x - t{LENGTH}) :precondition () :effect (p ?x)))"
        );
        let scenario = pddl(&domain, problem).unwrap();
        assert!(matches!(solved(&scenario).outcome, Outcome::Plan(_)));
    }
    // A circle is told at each of its places, one type or many.
    for circle in ["a - a", "a - b b - a", "a - b b - c c - (either d a) d - object"] {
        let domain = format!("(define (domain d) (:requirements :typing) (:types {circle}))");
        let problem = "(define (problem p) (:domain d) (:init) (:goal (and)))";
        let faults = told(pddl(&domain, problem));
        assert!(faults.contains("наследует сам себе"), "{circle}: {faults}");
    }
}
