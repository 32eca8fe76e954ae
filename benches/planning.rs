//! How long the planner takes, on the families that planners are measured on and on a home robot's tasks.
//!
//! `cargo bench -p benches --bench planning [-- NAME]` prints a row of a table an instance, each measured in a process of its
//! own: processor time from the texts to the answer, and the most memory held. `SECONDS` limits each (60).
//! `-- --replan NAME …` withdraws one initial fact after the other and compares planning anew with planning with
//! what was learned. `-- --soon` measures first plans where no proof is in reach. `-- --ground` measures grounding alone, on tasks of a hundred thousand actions. Home-robot instances are read from the folder named by `HOMEBOT`, if it is set.
#![allow(clippy::print_stdout, reason = "a benchmark's product is its table")]

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use orthoframe_graphplan::{Limits, Outcome, solve, solve_any, solve_learning, validate};
use orthoframe_strips::{PlanText, RuleFaults, Scenario, Task};
use orthoframe_units::Source;

#[path = "planning/families.rs"]
mod families;
#[path = "../src/graphplan/judges/judge.rs"]
mod judge;

use judge::{Texts, Verdict};

/// Least seconds in which a peer proves the fewest steps of a home robot's task.
const HOME_ROBOT: [(&str, f64); 3] = [("h2", 0.007), ("h3", 0.029), ("h4", 1.39)];

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|arg| arg != "--bench").collect();
    match arguments.as_slice() {
        [flag, name] if flag == "--alone" => alone(name),
        [flag, name] if flag == "--alone-large" => ground_alone(name),
        [flag] if flag == "--ground" => table_of_large(families::large()),
        [flag] if flag == "--soon" => table_of_large(families::soon()),
        [flag, names @ ..] if flag == "--replan" => names.iter().for_each(|name| replan(name)),
        _ => table(arguments.first().map_or("", String::as_str)),
    }
}

/// The texts of what is measured by name.
fn texts(name: &str) -> Texts {
    let drawn = families::all().into_iter().map(|measured| measured.instance);
    let mut drawn = drawn.chain(families::large()).chain(families::soon());
    if let Some(instance) = drawn.find(|instance| instance.name == name) {
        return Texts::Pddl { domain: instance.domain, problem: instance.problem };
    }
    let read = |path: &Path| std::fs::read_to_string(path).unwrap_or_default();
    let rules = read(&rules().join("service-robot.strips"));
    if let Some(building) = families::buildings().into_iter().find(|found| found.name == name) {
        return Texts::Rules(rules + &building.scenario);
    }
    match home_robot().into_iter().find(|path| path.file_stem().is_some_and(|stem| stem == name)) {
        Some(problem) => {
            let domain = read(&problem.with_file_name("domain.pddl"));
            Texts::Pddl { domain, problem: read(&problem) }
        }
        None => {
            let walk = read(&self::rules().join("scenarios/medicine-walk.strips"));
            let own = walk.lines().filter(|line| !line.starts_with("Включить:"));
            Texts::Rules(own.fold(rules, |text, line| text + "\n" + line))
        }
    }
}

/// What is measured by name: an instance of the families, a home robot's task, or the paper's walk.
fn scenario(name: &str) -> Result<Scenario, RuleFaults> {
    let drawn = families::all().into_iter().map(|measured| measured.instance);
    if let Some(instance) = drawn.into_iter().find(|instance| instance.name == name) {
        let domain = Source::new("domain", &instance.domain);
        return Scenario::parse_pddl(&domain, &Source::new("problem", &instance.problem));
    }
    if let Some(building) = families::buildings().into_iter().find(|found| found.name == name) {
        let rules = std::fs::read_to_string(rules().join("service-robot.strips"))
            .expect("the rules stand beside the benches");
        return Scenario::parse(&Source::new(name, &(rules + &building.scenario)));
    }
    match home_robot().into_iter().find(|path| path.file_stem().is_some_and(|stem| stem == name)) {
        Some(problem) => Scenario::read_pddl(&problem.with_file_name("domain.pddl"), &problem),
        None => Scenario::read(&rules().join("scenarios/medicine-walk.strips")),
    }
}

fn rules() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../rules")
}

fn home_robot() -> Vec<PathBuf> {
    let Some(folder) = std::env::var_os("HOMEBOT") else { return Vec::new() };
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut problems: Vec<PathBuf> =
        entries.map(|entry| entry.path()).filter(|path| !path.ends_with("domain.pddl")).collect();
    problems.retain(|path| path.extension().is_some_and(|extension| extension == "pddl"));
    problems.sort();
    problems
}

fn table(wanted: &str) {
    println!(
        "| instance | facts | operators | steps | actions | seconds | MB | best peer, s | any: seconds | steps, actions |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|");
    let mut names: Vec<(String, Option<f64>)> = families::all()
        .into_iter()
        .map(|measured| (measured.instance.name, measured.best_peer))
        .collect();
    for problem in home_robot() {
        let name = problem.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let peer = HOME_ROBOT.iter().find(|(peer, _)| *peer == name).map(|(_, seconds)| *seconds);
        names.push((name, peer));
    }
    names.extend(families::buildings().into_iter().map(|building| (building.name, None)));
    names.push(("medicine-walk".to_owned(), None));
    let (mut ours, mut theirs) = (0.0, 0.0);
    for (name, peer) in names.into_iter().filter(|(name, _)| name.contains(wanted)) {
        let program = std::env::current_exe().expect("a program knows its place");
        let told = run_of(std::process::Command::new(program).args(["--alone", &name]));
        let mut cells: Vec<&str> = told.trim().split('\t').collect();
        let shown = peer.map_or("–".to_owned(), |seconds| seconds.to_string());
        if let (Some(peer), Some(Ok(seconds))) =
            (peer, cells.get(4).map(|cell| cell.parse::<f64>()))
        {
            ours += seconds;
            theirs += peer;
        }
        cells.insert(cells.len().min(6), &shown);
        println!("| {name} | {} |", cells.join(" | "));
    }
    println!("\nWhere a peer solves the size: {ours:.2} s against {theirs:.2} s.");
}

/// One instance measured; cells of its row, with tabs between them.
fn alone(name: &str) {
    let start = ProcessTime::now();
    let task = match scenario(name).and_then(|scenario| scenario.ground()) {
        Ok(task) => task,
        Err(faults) => return println!("{faults}"),
    };
    let ground = start.elapsed();
    let seconds = std::env::var("SECONDS").ok().and_then(|text| text.parse().ok()).unwrap_or(60);
    let limits = || Limits {
        deadline: Some(Instant::now() + Duration::from_secs(seconds)),
        ..Limits::default()
    };
    let best = solve(&task, &limits());
    let (spent, peak) = (start.elapsed(), peak_megabytes());
    let start = ProcessTime::now();
    let soon = solve_any(&task, &Limits { shorten: 0, ..limits() });
    let spent_soon = ground + start.elapsed();
    let texts = texts(name);
    let (steps, actions) = answer(&task, &best, Some(&texts));
    let (soon_steps, soon_actions) = answer(&task, &soon, Some(&texts));
    println!(
        "{}\t{}\t{steps}\t{actions}\t{:.3}\t{peak}\t{:.3}\t{soon_steps}, {soon_actions}",
        task.facts.len(),
        task.operators.len(),
        spent.as_secs_f64(),
        spent_soon.as_secs_f64(),
    );
}

/// Tasks larger than any plan is proven for: what grounding them takes, and how soon there is some plan.
fn table_of_large(instances: Vec<families::Instance>) {
    println!("| instance | facts | operators | grounding, s | MB | any: seconds | actions |");
    println!("|---|---|---|---|---|---|---|");
    for instance in instances {
        let program = std::env::current_exe().expect("a program knows its place");
        let told =
            run_of(std::process::Command::new(program).args(["--alone-large", &instance.name]));
        println!("| {} | {} |", instance.name, told.trim());
    }
}

fn ground_alone(name: &str) {
    let all = families::large().into_iter().chain(families::soon());
    let Some(instance) = all.into_iter().find(|instance| instance.name == name) else {
        return println!("no such instance");
    };
    let start = ProcessTime::now();
    let domain = Source::new("domain", &instance.domain);
    let problem = Source::new("problem", &instance.problem);
    let task = match Scenario::parse_pddl(&domain, &problem).and_then(|read| read.ground()) {
        Ok(task) => task,
        Err(faults) => return println!("{faults}"),
    };
    let (ground, peak) = (start.elapsed().as_secs_f64(), peak_megabytes());
    let limits = Limits {
        deadline: Some(Instant::now() + Duration::from_secs(60)),
        shorten: 0,
        ..Limits::default()
    };
    let start = ProcessTime::now();
    let soon = solve_any(&task, &limits);
    let spent = start.elapsed();
    let (_, actions) = answer(&task, &soon, Some(&texts(name)));
    println!(
        "{} | {} | {ground:.2} | {peak} | {:.2} | {actions}",
        task.facts.len(),
        task.operators.len(),
        spent.as_secs_f64(),
    );
}

fn run_of(command: &mut std::process::Command) -> String {
    String::from_utf8(command.output().expect("it runs once more").stdout).unwrap_or_default()
}

/// Each initial fact withdrawn in its turn: processor time of planning anew, and with what was learned.
fn replan(name: &str) {
    let task = match scenario(name).and_then(|scenario| scenario.ground()) {
        Ok(task) => task,
        Err(faults) => return println!("{faults}"),
    };
    // What is measured is the proof of the fewest steps, not the polish after it.
    let limits = Limits { fewer_actions: 0, ..Limits::default() };
    let (_, learned) = solve_learning(&task, None, &limits);
    let (mut anew, mut again, mut plans) = (0.0, 0.0, 0);
    for lost in &task.init {
        let mut rest = task.clone();
        rest.init.retain(|fact| fact != lost);
        let start = ProcessTime::now();
        let first = solve(&rest, &limits);
        let spent = start.elapsed().as_secs_f64();
        let start = ProcessTime::now();
        let (second, _) = solve_learning(&rest, learned.as_ref(), &limits);
        let steps = |outcome| answer(&rest, outcome, None).0;
        assert_eq!(steps(&first), steps(&second), "the same number of steps");
        if matches!(first, Outcome::Plan(_)) {
            anew += spent;
            again += start.elapsed().as_secs_f64();
            plans += 1;
        }
    }
    println!("{name}: {plans} withdrawals, {anew:.3} s anew, {again:.3} s with what was learned");
}

/// Steps and actions of a plan that was replayed and, where there are texts of its rules, stood before a judge that shares
/// no code with the planner.
fn answer(task: &Task, outcome: &Outcome, texts: Option<&Texts>) -> (String, String) {
    match outcome {
        Outcome::Plan(plan) => {
            assert_eq!(validate(task, plan), Ok(()), "a plan is replayed before it is counted");
            if let Some(texts) = texts {
                let (mut task, mut steps) = (task.clone(), plan.steps.clone());
                task.choose_disjunct(&mut steps);
                let text = PlanText::write(&task, &steps);
                assert_eq!(judge::judge(texts, &text), Verdict::Works, "{text}");
            }
            (plan.steps.len().to_string(), plan.action_count().to_string())
        }
        Outcome::NoPlan { leveled_off_at, .. } => {
            ("no plan".to_owned(), format!("level {leveled_off_at}"))
        }
        Outcome::LimitReached(known) => (format!("limit {:?}", known.limit), "–".to_owned()),
    }
}

/// The most memory that this process has held, as the system counts it.
fn peak_megabytes() -> String {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kilobytes = peak.and_then(|text| text.trim().split(' ').next()?.parse::<u64>().ok());
    kilobytes.map_or("?".to_owned(), |kilobytes| (kilobytes / 1024).to_string())
}
