//! From a scenario file to a plan, and from a faulty file to its faults.

use std::path::{Path, PathBuf};
use std::time::Instant;

use miette::Diagnostic;
use orthoframe::engine::PlanAnswer;
use orthoframe_graphplan::{Limit, Limits, NoPlanReason, Outcome, solve, validate};
use orthoframe_robot::Wanted;
use orthoframe_strips::{PlanText, RuleFaults, Scenario, Task, explain_unreachable};
use orthoframe_units::{English, Source};

use crate::files::project;
use crate::planning_judge::{Texts, stands, whole};

fn directives(task: &Task) -> Vec<String> {
    let Outcome::Plan(plan) = solve(task, &Limits::default()) else { panic!("a plan exists") };
    assert_eq!(validate(task, &plan), Ok(()));
    plan.operators().map(|id| task.operator(id).to_string()).collect()
}

#[test]
fn the_papers_scenario_gives_the_papers_directives() {
    let scenario = Scenario::read(&project("rules/scenarios/medicine-walk.strips")).unwrap();
    assert_eq!(
        scenario.map.as_deref(),
        Some(project("rules/scenarios/../../maps/rb2.toml").as_path())
    );
    assert_eq!(
        directives(&scenario.ground().unwrap()),
        [
            "Движение-в_от-места_до-двери_(Комната-В, Точка-А, Дверь-ВZ)",
            "Движение-из_в_через-дверь_(Комната-В, Комната-Z, Дверь-ВZ)",
            "Движение-в_от-двери_до-двери_(Комната-Z, Дверь-ВZ, Дверь-ZY)",
            "Движение-из_в_через-дверь_(Комната-Z, Комната-Y, Дверь-ZY)",
            "Движение-в_от-двери_до-места_(Комната-Y, Дверь-ZY, Точка-К)",
        ]
    );
}

/// `tests/golden/planning/<case>/scenario.strips`, or `domain.pddl` and `problem.pddl`, and what comes of it.
#[test]
fn golden_cases() {
    let folder = project("tests/golden/planning");
    let mut cases: Vec<PathBuf> =
        std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    cases.sort();
    let mut judged = 0;
    for case in cases {
        let expected = case.join("expected.txt");
        if !expected.exists() {
            std::fs::write(&expected, "").unwrap();
        }
        expect_test::expect_file![&expected].assert_eq(&outcome(&case, &mut judged));
    }
    assert!(judged >= 15, "{judged} plans stood before the judge");
}

#[test]
fn scenarios_of_the_rules_folder() {
    let folder = project("rules/scenarios");
    let (mut shown, mut judged) = (String::new(), 0);
    let mut files: Vec<PathBuf> =
        std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path()).collect();
    files.sort();
    for file in files {
        let name = file.file_name().unwrap().to_string_lossy().into_owned();
        let told = told(Scenario::read(&file), || Texts::Rules(whole(&file)), &mut judged);
        shown.push_str(&format!("── {name}\n{told}\n"));
    }
    expect_test::expect_file![project("tests/golden/scenarios.txt")].assert_eq(&shown);
    let plans = shown.matches("── ").count() - shown.matches("плана нет").count();
    assert_eq!(judged, plans, "every plan stood before the judge");
}

#[test]
fn every_action_of_the_rules_is_carried_out_in_some_scenario() {
    let plans = std::fs::read_to_string(project("tests/golden/scenarios.txt")).unwrap();
    let rules = Scenario::read(&project("rules/service-robot.strips")).unwrap();
    let schemas = rules.domain.schemas().iter();
    let unused: Vec<&str> = schemas
        .map(|schema| schema.name.as_str())
        .filter(|name| !plans.contains(&format!("({name} ")))
        .collect();
    assert_eq!(unused, [""; 0], "an action without a scenario");
}

fn outcome(case: &Path, judged: &mut usize) -> String {
    let (domain, problem) = (case.join("domain.pddl"), case.join("problem.pddl"));
    let read = |path: &Path| std::fs::read_to_string(path).unwrap();
    let told = if domain.exists() {
        let texts = || Texts::Pddl { domain: read(&domain), problem: read(&problem) };
        told(Scenario::read_pddl(&domain, &problem), texts, judged)
    } else {
        let file = case.join("scenario.strips");
        told(Scenario::read(&file), || Texts::Rules(whole(&file)), judged)
    };
    // Faults name the file by the path that it was asked for by; a golden text must not.
    told.replace(&format!("{}/", case.display()), "")
}

/// Each fault in English, with its remedy.
fn in_english(faults: &RuleFaults) -> String {
    let told = faults.0.iter().map(English).map(|fault| {
        let help = fault.help().map_or_else(String::new, |help| format!(" – {help}"));
        format!("{fault}{help}")
    });
    told.collect::<Vec<_>>().join("\n")
}

/// What comes of a scenario; how many plans the judge read the texts of is counted.
fn told(
    scenario: Result<Scenario, RuleFaults>,
    texts: impl FnOnce() -> Texts,
    judged: &mut usize,
) -> String {
    let read = scenario.and_then(|scenario| scenario.ground().map(|task| (scenario, task)));
    let (scenario, task) = match read {
        Ok(read) => read,
        Err(faults) => return format!("{faults}\n\n{}\n", in_english(&faults)),
    };
    match solve(&task, &Limits::default()) {
        Outcome::Plan(plan) => {
            assert_eq!(validate(&task, &plan), Ok(()));
            *judged += usize::from(stands(&texts(), &task, &plan));
            let text = PlanText::write(&task, &plan.steps);
            let again = PlanText::parse(&Source::new("план", &text)).unwrap();
            assert_eq!(
                again.check(&scenario.domain, &scenario.problem).map_err(|f| f.to_string()),
                Ok(())
            );
            let assumed: String = plan
                .assumptions(&task)
                .into_iter()
                .map(|fact| format!("; опирается на предположение {}\n", task.fact(fact)))
                .collect();
            text + &assumed
        }
        Outcome::NoPlan { reason, .. } => match reason {
            NoPlanReason::Unreachable(goals) => {
                let goals = goals.iter().map(|&goal| task.fact(goal));
                let obstacles =
                    explain_unreachable(&scenario.domain, &scenario.problem, goals).unwrap();
                obstacles.iter().map(|obstacle| format!("плана нет: {obstacle}\n")).collect()
            }
            NoPlanReason::Exclusive(pairs) => pairs
                .iter()
                .map(|&(a, b)| {
                    format!("плана нет: исключают друг друга {} и {}\n", task.fact(a), task.fact(b))
                })
                .collect(),
            NoPlanReason::Together(goals) => {
                let goals: Vec<String> = goals.iter().map(|&g| task.fact(g).to_string()).collect();
                format!("плана нет: вместе недостижимы {}\n", goals.join(", "))
            }
        },
        Outcome::LimitReached(known) => format!("предел: {:?}\n", known.limit),
    }
}

/// The golden cases without a plan: with what is said to help there is one.
#[test]
fn what_is_said_to_help_helps() {
    let folder = project("tests/golden/planning");
    let cases = std::fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().path());
    let (mut helped, mut helpless) = (0, String::new());
    for case in
        cases.filter(|case| case.file_name().unwrap().to_string_lossy().contains("no_plan_"))
    {
        let file = case.join("scenario.strips");
        let scenario = Scenario::read(&file).unwrap();
        let task = scenario.ground().unwrap();
        let Outcome::NoPlan { reason: NoPlanReason::Unreachable(goals), .. } =
            solve(&task, &Limits::default())
        else {
            panic!("{}: there is a plan", case.display());
        };
        let goals = goals.iter().map(|&goal| task.fact(goal));
        let obstacles = explain_unreachable(&scenario.domain, &scenario.problem, goals).unwrap();
        let text = std::fs::read_to_string(&file)
            .unwrap()
            .replace("../../../../rules", &project("rules").display().to_string());
        for help in obstacles.iter().flat_map(|obstacle| &obstacle.help) {
            let facts: Vec<String> = help.iter().map(ToString::to_string).collect();
            let text = with_help(&text, &facts);
            let again = Scenario::parse(&Source::new("помощь", &text)).unwrap();
            let outcome = solve(&again.ground().unwrap(), &Limits::default());
            if matches!(outcome, Outcome::Plan(_)) {
                helped += 1;
            } else {
                helpless += &format!("{}: {}\n", case.display(), facts.join(", "));
            }
        }
    }
    assert!(helped >= 8 && helpless.is_empty(), "{helped} helped, but not\n{helpless}");
}

/// The scenario with facts that are said to help; what is left open is one new object of each type, which, where it
/// is to be carried, lies where the robot can reach it.
fn with_help(scenario: &str, help: &[String]) -> String {
    let mut facts = String::new();
    let mut objects = String::new();
    for fact in help {
        let (predicate, args) = fact.split_once("_(").unwrap();
        let args: Vec<String> = args
            .trim_end_matches(')')
            .split(", ")
            .map(|arg| match arg.strip_suffix(" ?") {
                Some("помещение") => "Комната-В".to_owned(),
                Some(kind) => {
                    objects += &format!("Новый-{kind} — {kind}\n");
                    format!("Новый-{kind}")
                }
                None => arg.to_owned(),
            })
            .collect();
        facts += &format!("{predicate}_({})\n", args.join(", "));
        // A door that is open is open both ways.
        if let ("ДВЕРЬ_ИЗ_В_ОТКРЫТА", [door, from, to]) = (predicate, args.as_slice())
        {
            facts += &format!("{predicate}_({door}, {to}, {from})\n");
        }
    }
    // A new door is one of the room that the robot is in, and a new thing stands beside it.
    for (object, fact) in [
        ("Новый-дверь", "ДВЕРЬ_НАХОДИТСЯ-В_(Новый-дверь, Комната-В)"),
        ("Новый-предмет", "ПРЕДМЕТ_НАХОДИТСЯ-НА_(Новый-предмет, Стол)"),
        ("Новый-объект", "ПОЗИЦИЯ_НАХОДИТСЯ-У_(Точка-С, Новый-объект)"),
    ] {
        if facts.contains(object) {
            facts += &format!("{fact}\n");
        }
    }
    format!("{scenario}\nОбъекты:\n{objects}\nПредположения:\n{facts}")
}

#[test]
fn a_plan_text_breaks_where_it_is_wrong() {
    let scenario = Scenario::read(&project("rules/scenarios/medicine-walk.strips")).unwrap();
    let check = |text: &str| {
        PlanText::parse(&Source::new("план", text))
            .and_then(|plan| plan.check(&scenario.domain, &scenario.problem))
            .map_err(|faults| faults.codes())
    };
    assert_eq!(check("0: (Ехать)"), Err(vec!["strips::unknown_action".into()]));
    assert_eq!(check("(Движение-из_в_через-дверь Комната-В)"), Err(vec!["strips::arity".into()]));
    let early = "(Движение-из_в_через-дверь Комната-В Комната-Z Дверь-ВZ)";
    assert_eq!(
        check(early),
        Err(vec!["strips::plan_precondition".into(), "strips::plan_precondition".into()])
    );
    assert_eq!(
        check("(Движение-в_от-места_до-двери Комната-В Точка-А Дверь-ВZ)"),
        Err(vec!["strips::plan_misses_goal".into()])
    );
    assert_eq!(check("0: 0: )"), Err(vec!["strips::syntax".into()]));
}

#[test]
fn things_that_no_plan_needs_leave_the_task() {
    let problem = |things: usize, held: &str| {
        let things: Vec<String> =
            (0..things).map(|n| format!("НА(Вещь-{n}, Стол) НА(Вещь-{n}, Пол)")).collect();
        let text = format!(
            "Действие: Взять (Параметры: вещь ?t, опора ?s)
             (Предусловие: НА(?t, ?s) РУКА-СВОБОДНА()) (Эффект+: ДЕРЖИТ(?t)) (Эффект-: НА(?t, ?s) РУКА-СВОБОДНА())
             Действие: Положить (Параметры: вещь ?t, опора ?s)
             (Предусловие: ДЕРЖИТ(?t) ЕСТЬ(?s)) (Эффект+: НА(?t, ?s) РУКА-СВОБОДНА()) (Эффект-: ДЕРЖИТ(?t))
             Факты: НА(Чашка, Стол) ЕСТЬ(Стол) ЕСТЬ(Пол) {held} {}
             Цель: НА(Чашка, Пол)",
            things.join(" ")
        );
        Scenario::parse(&Source::new("вещи", text)).unwrap().ground().unwrap()
    };
    let free = "РУКА-СВОБОДНА()";
    assert_eq!(problem(40, free).operators.len(), problem(0, free).operators.len());
    // What the robot holds at first it must put down: that one thing is no bystander, the others are.
    let held = problem(3, "ДЕРЖИТ(Вещь-0)");
    assert_eq!(directives(&held).len(), 3);
    assert!(held.operators.iter().all(|operator| !operator.args.contains(&"Вещь-1".into())));
}

#[test]
fn grounding_keeps_to_the_limits() {
    // Thirteen million actions, were they all made.
    let objects: Vec<String> = (0..60).map(|n| format!("o{n}")).collect();
    let domain = "(define (domain d) (:predicates (p ?a ?b) (q ?a ?b))
        (:action a :parameters (?a ?b ?c ?d) :precondition (and (p ?a ?b) (p ?c ?d)) :effect (p ?a ?d)))";
    let problem = format!(
        "(define (problem p) (:domain d) (:objects {}) (:init {}) (:goal (q o0 o1)))",
        objects.join(" "),
        objects.iter().map(|o| format!("(p {o} {o})")).collect::<String>()
    );
    let scenario = Scenario::parse_pddl(&Source::new("d", domain), &Source::new("p", problem));
    let scenario = scenario.unwrap();
    let outcome = |limits: Limits| {
        PlanAnswer::without_map(scenario.clone(), &limits, Wanted::Shortest).unwrap().solved.outcome
    };
    let small = Limits { memory_bytes: 1 << 20, ..Limits::default() };
    assert_eq!(outcome(small).limit(), Some(Limit::Memory));
    let now = Limits { deadline: Some(Instant::now()), ..Limits::default() };
    assert_eq!(outcome(now).limit(), Some(Limit::Time));
}

#[test]
fn files_that_are_no_texts_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let code = |name: &str, bytes: &[u8]| {
        let path = folder.path().join(name);
        std::fs::write(&path, bytes).unwrap();
        let rules = Scenario::read(&path).err().map(|faults| faults.codes().remove(0));
        assert!(Scenario::read_pddl(&path, &path).is_err(), "{name}");
        rules.unwrap_or_default()
    };
    assert_eq!(code("пусто.strips", b""), "strips::empty");
    assert_eq!(code("двоичный.strips", &[0xff, 0xfe, 0, 1, 2]), "strips::not_text");
    assert_eq!(code("строка.strips", &vec![b'x'; 100 << 20]), "strips::too_large");
    assert_eq!(code("круг.strips", "Включить: круг.strips".as_bytes()), "strips::include_cycle");
    let long =
        code("длинное-слово.strips", "Факты: ".to_owned().into_bytes().repeat(1000).as_slice());
    assert_eq!(long, "", "a file of headings says nothing, and says it well");
    let missing = Scenario::read(&folder.path().join("нет.strips")).unwrap_err();
    assert_eq!(missing.codes(), ["strips::unreadable"]);
}
