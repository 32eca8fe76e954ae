//! Plans of problems of others before two judges: one of this folder, which reads rules and plans by itself, and
//! `unified-planning` (Python), where it is there. `python3 -m pip install --target target/judges unified-planning` puts
//! it there; where `CI` is set, both it and the problems must be.

#![allow(clippy::print_stdout, reason = "a test that was not made should say so")]

mod judge;

use std::path::{Path, PathBuf};
use std::process::Command;

use judge::{Texts, Verdict, judge, left_open};
use orthoframe_graphplan::{Limits, Outcome, solve, solve_any, solve_anytime};
use orthoframe_strips::{PlanText, Scenario, ground};
use orthoframe_units::Source;

fn root() -> PathBuf {
    PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("../..")
}

/// Domain and problem files; none, with a word, where the data is not there.
fn problems() -> Vec<(PathBuf, PathBuf)> {
    let data = root().join("../shared/data");
    if !data.exists() {
        assert!(std::env::var_os("CI").is_none(), "{} is missing", data.display());
        println!("skipped: {} is not there", data.display());
        return Vec::new();
    }
    let home = data.join("homebot");
    let task = data.join("taskography");
    let homes =
        ["h2", "h3"].map(|name| (home.join("domain.pddl"), home.join(format!("{name}.pddl"))));
    let scans = ["tiny1"]
        .map(|set| (task.join(set).join("domain.pddl"), task.join(set).join("problem0.pddl")));
    homes.into_iter().chain(scans).collect()
}

/// Problems of this folder with conditions beyond literals.
fn with_conditions() -> Vec<(PathBuf, PathBuf)> {
    let folder = root().join("src/graphplan/judges/adl");
    let file = |name: &str, what: &str| folder.join(format!("{name}-{what}.pddl"));
    ["briefcase", "rounds", "towers"]
        .map(|name| (file(name, "domain"), file(name, "problem")))
        .to_vec()
}

/// The plans of all ways to plan, within little effort.
fn plans(domain: &Path, problem: &Path) -> Vec<String> {
    let scenario = Scenario::read_pddl(domain, problem).unwrap_or_else(|faults| panic!("{faults}"));
    let task = scenario.ground().unwrap_or_else(|faults| panic!("{faults}"));
    let limits = Limits { effort: Some(0), fewer_actions: 0, ..Limits::default() };
    let mut outcomes = vec![solve_any(&task, &limits), solve_anytime(&task, &limits)];
    if task.operators.len() < 400 {
        outcomes.push(solve(&task, &Limits { effort: None, ..limits }));
    }
    let plans: Vec<String> = outcomes
        .iter()
        .filter_map(Outcome::plan)
        .map(|plan| {
            let (mut chosen, mut steps) = (task.clone(), plan.steps.clone());
            chosen.choose_disjunct(&mut steps);
            PlanText::write(&chosen, &steps)
        })
        .collect();
    for plan in &plans {
        PlanText::parse(&Source::new("plan", plan.as_str()))
            .and_then(|text| text.check(&scenario.domain, &scenario.problem))
            .unwrap_or_else(|faults| panic!("{}: {faults}\n{plan}", problem.display()));
    }
    assert!(!plans.is_empty(), "{} has a plan", problem.display());
    plans
}

#[test]
fn plans_stand_before_two_judges() {
    let (mut judged, mut files) = (0, Vec::new());
    let folder = root().join("target/judges/plans");
    let ours = with_conditions();
    for (domain, problem) in problems().iter().chain(&ours) {
        let text = |path: &Path| std::fs::read_to_string(path).expect("the data can be read");
        for plan in plans(domain, problem) {
            let texts = Texts::Pddl { domain: text(domain), problem: text(problem) };
            assert_eq!(judge(&texts, &plan), Verdict::Works, "{}:\n{plan}", problem.display());
            if domain.ends_with("towers-domain.pddl") {
                // The foreign validator knows nothing of what is derived.
                continue;
            }
            std::fs::create_dir_all(&folder).expect("target can be written to");
            let file = folder.join(format!("{judged}.plan"));
            std::fs::write(&file, &plan).expect("target can be written to");
            files.extend([domain.clone(), problem.clone(), file]);
            judged += 1;
        }
    }
    if files.is_empty() {
        return;
    }
    let script = root().join("src/graphplan/judges/unified.py");
    let foreign = Command::new("python3")
        .arg(script)
        .args(files)
        .env("PYTHONPATH", root().join("target/judges"))
        .output();
    match foreign {
        Ok(done) if done.status.code() != Some(77) => {
            let told = String::from_utf8_lossy(&done.stdout);
            let faults = String::from_utf8_lossy(&done.stderr);
            assert!(done.status.success(), "{told}{faults}");
            assert_eq!(
                told.lines().filter(|line| line.ends_with(": valid")).count(),
                judged,
                "{told}"
            );
        }
        _ => {
            assert!(std::env::var_os("CI").is_none(), "unified-planning is missing");
            println!("skipped: unified-planning is not there");
        }
    }
}

const DOMAIN: &str = "(define (domain d) (:types t) (:predicates (p ?x - t) (q ?x - t))
 (:action give :parameters (?x - t) :precondition (p ?x) :effect (and (q ?x) (not (p ?x))))
 (:action use :parameters (?x - t) :precondition (p ?x) :effect (q ?x))
 (:action bare :parameters (?x ?y - t) :precondition (and (not (p ?x)) (not (= ?x ?y))) :effect (p ?x)))";
const PROBLEM: &str =
    "(define (problem x) (:domain d) (:objects a b - t) (:init (p a)) (:goal (and (q a) (p b))))";

#[test]
fn the_judge_refuses_what_does_not_work() {
    let texts = Texts::Pddl { domain: DOMAIN.to_owned(), problem: PROBLEM.to_owned() };
    let verdict = |plan: &str| match judge(&texts, plan) {
        Verdict::Works => String::new(),
        Verdict::Fails(why) | Verdict::Unread(why) => why,
    };
    assert_eq!(verdict("0: (give a)\n0: (bare b a)\n"), "");
    assert_eq!(verdict("0: (bare b a)\n1: (use a)\n"), "");
    assert_eq!(verdict("0: (give a)\n"), "the goal is missed");
    assert_eq!(verdict("0: (give a)\n1: (use a)\n"), "cannot be carried out: 1: (use a)");
    assert!(verdict("0: (give a)\n0: (use a)\n").starts_with("not in one step"));
    assert!(verdict("0: (bare b b)\n").starts_with("cannot be carried out"));
    assert!(verdict("0: (take a)\n").starts_with("no such action"));
    assert!(verdict("0: (give c)\n").starts_with("c is no"));
    assert!(verdict("0: (give a b)\n").starts_with("not so many arguments"));
}

/// Conditions that hang on others, what is derived and quantifiers, in PDDL and in a rule file.
const LAMPS: &str = "(define (domain d) (:types lamp) (:predicates (on ?l - lamp) (bright) (key) (up ?l - lamp))
 (:derived (bright) (forall (?l - lamp) (on ?l)))
 (:action press :parameters () :precondition (or (key) (exists (?l - lamp) (on ?l)))
  :effect (forall (?l - lamp) (when (not (up ?l)) (on ?l))))
 (:action climb :parameters (?l - lamp) :precondition (imply (bright) (key)) :effect (and (on ?l) (not (key)))))";
const LIT: &str =
    "(define (problem x) (:domain d) (:objects a b - lamp) (:init (key) (up b)) (:goal (bright)))";
const IN_RULES: &str = "
Типы: лампа
Объекты: a, b — лампа  ; две
Выводится: bright() ЕСЛИ ДЛЯ-ВСЕХ(лампа ?l) on_(?l)
Действие: press
(Предусловие: (key() ИЛИ СУЩЕСТВУЕТ(лампа ?l) on(?l)))
(Эффект+: ДЛЯ-ВСЕХ(лампа ?l) ЕСЛИ (НЕ up(?l)) ТО on(?l))
Действие: climb (Параметры: лампа ?l)
(Предусловие: ЕСЛИ (bright()) ТО key())
(Эффект+: on(?l)) (Эффект-: key())
Исходная позиция: key() up(b)
Цель: bright()";

#[test]
fn the_judge_knows_conditions_as_they_are_given() {
    let pddl = |domain: &str| Texts::Pddl { domain: domain.to_owned(), problem: LIT.to_owned() };
    for texts in [pddl(LAMPS), Texts::Rules(IN_RULES.to_owned())] {
        let verdict = |plan: &str| judge(&texts, plan);
        let fails = |plan: &str| matches!(verdict(plan), Verdict::Fails(_));
        assert_eq!(verdict("0: (press)\n1: (climb b)\n"), Verdict::Works);
        assert_eq!(verdict("0: (climb b)\n1: (press)\n"), Verdict::Works);
        // What is up is not lit by the switch; and the key is gone once the room is bright.
        assert!(fails("0: (press)\n"));
        assert!(fails("0: (press)\n1: (climb b)\n2: (climb b)\n"));
        assert!(fails("0: (climb c)\n"));
        // One takes the key that the other may need.
        assert!(fails("0: (climb a)\n0: (climb b)\n1: (press)\n1: (climb a)\n"));
    }
    let bounded = pddl("(define (domain d) (:constraints (always (key))))");
    assert!(matches!(judge(&bounded, ""), Verdict::Unread(_)));
}

/// A kettle that is one's own while it boils, in PDDL and in rule files of either language.
const KETTLE: &str = "(define (domain d) (:predicates (free ?k) (lit) (hot ?k) (served ?g) (poor ?g))
 (:durative-action boil :parameters (?k) :duration (= ?duration 3)
  :condition (and (at start (free ?k)) (over all (lit)) (at end (not (free ?k))))
  :effect (and (at start (not (free ?k))) (at end (free ?k)) (at end (hot ?k))))
 (:durative-action serve :parameters (?k ?g) :duration (= ?duration 1)
  :condition (and (at start (hot ?k)) (over all (free ?k)) (at end (poor ?g)))
  :effect (and (at start (not (hot ?k))) (at start (poor ?g)) (at end (served ?g)) (at end (not (poor ?g)))))
 (:action darken :parameters () :effect (not (lit))))";
const TEA: &str = "(define (problem x) (:domain d) (:objects k a b) (:init (free k) (lit))
 (:goal (and (served a) (preference other (served b)) (and (preference dark (not (lit)))))))";
const KETTLES: [&str; 2] = [
    "Действие: boil (Параметры: ?k) (Длительность: 3) (Предусловие: free(?k)) (Всё-время: lit())
     (Под-конец: НЕ free(?k)) (Начало-: free(?k)) (Эффект+: free(?k) hot(?k))
     Действие: serve (Параметры: ?k ?g) (Длительность: 1) (Предусловие: hot(?k)) (Всё-время: free(?k))
     (Под-конец: poor(?g)) (Начало-: hot(?k)) (Начало+: poor(?g)) (Эффект+: served(?g)) (Эффект-: poor(?g))
     Действие: darken (Эффект-: lit())
     Объекты: k a b Исходная позиция: free(k) lit() Цель: served(a)
     Желательно: other 2.5 served(b) dark НЕ lit()",
    "Action: boil (Parameters: ?k) (Duration: 3) (Precondition: free(?k)) (Throughout: lit())
     (At-end: NOT free(?k)) (Start-: free(?k)) (Effect+: free(?k) hot(?k))
     Action: serve (Parameters: ?k ?g) (Duration: 1) (Precondition: hot(?k)) (Throughout: free(?k))
     (At-end: poor(?g)) (Start-: hot(?k)) (Start+: poor(?g)) (Effect+: served(?g)) (Effect-: poor(?g))
     Action: darken (Effect-: lit())
     Objects: k a b Initial: free(k) lit() Goal: served(a)
     Preferably: other 2.5 served(b) dark NOT lit()",
];

#[test]
fn the_judge_knows_what_lasts_and_what_is_wished_for() {
    let pddl = Texts::Pddl { domain: KETTLE.to_owned(), problem: TEA.to_owned() };
    for texts in KETTLES.map(|text| Texts::Rules(text.to_owned())).into_iter().chain([pddl]) {
        let open = |plan: &str| match left_open(&texts, plan) {
            Ok(open) => open.join(", "),
            Err(Verdict::Fails(why)) => why,
            Err(other) => panic!("{other:?}"),
        };
        let one = "0: (boil k)\n1: (serve k a)\n";
        assert_eq!(open(one), "other, dark");
        assert_eq!(open(&format!("{one}2: (boil k)\n3: (serve k b)\n4: (darken)\n")), "");
        // The light is on throughout; the kettle is hot once; and it is the cook's own while it boils.
        assert!(open("0: (darken)\n1: (boil k)\n").starts_with("cannot be carried out: 1"));
        assert!(open(&format!("{one}2: (serve k b)\n")).starts_with("cannot be carried out: 2"));
        assert!(open("0: (boil k)\n0: (darken)\n").starts_with("not in one step"));
        assert!(open("0: (boil k)\n1: (boil k)\n1: (serve k a)\n").starts_with("not in one step"));
    }
}

/// Plans of what lasts, by those who plan; and as many wishes are left open as any way of carrying on leaves.
#[test]
fn plans_of_what_lasts_stand_before_the_judge() {
    let scenario = Scenario::parse_pddl(&Source::new("kettle", KETTLE), &Source::new("tea", TEA))
        .unwrap_or_else(|faults| panic!("{faults}"));
    let rules = KETTLES.map(|text| {
        let read = Scenario::parse(&Source::new("kettle", text));
        (read.unwrap_or_else(|faults| panic!("{faults}")), Texts::Rules(text.to_owned()))
    });
    let pddl = Texts::Pddl { domain: KETTLE.to_owned(), problem: TEA.to_owned() };
    for (scenario, texts) in rules.into_iter().chain([(scenario, pddl)]) {
        for (kept, open) in [(0, "other, dark"), (1, "dark"), (2, "other"), (3, "")] {
            let problem = scenario.problem.with_preferences(|wish| kept & (1 << wish) != 0);
            let task = ground(&scenario.domain, &problem).unwrap_or_else(|f| panic!("{f}"));
            for outcome in [solve(&task, &Limits::default()), solve_any(&task, &Limits::default())]
            {
                let plan = outcome.plan().expect("there is tea");
                let (mut task, mut steps) = (task.clone(), plan.steps.clone());
                task.choose_disjunct(&mut steps);
                let plan = PlanText::write(&task, &steps);
                assert_eq!(
                    left_open(&texts, &plan).map(|open| open.join(", ")),
                    Ok(open.to_owned()),
                    "{plan}"
                );
            }
        }
    }
}
