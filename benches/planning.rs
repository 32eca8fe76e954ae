//! How long the planner takes, on the families that planners are measured on and on a home robot's tasks.
//!
//! `cargo bench --bench planning [-- NAME]` prints a line an instance: size, grounding, planning (processor time is
//! what counts on a busy machine; these are seconds of the clock), the answer, and the same for a plan soon.
//! Home-robot instances are read from the folder named by `HOMEBOT`, if it is set. `SECONDS` limits each instance.
#![allow(clippy::print_stdout, reason = "a benchmark's product is its table")]

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use orthoframe::graphplan::{Limits, Outcome, solve, solve_any, validate};
use orthoframe::strips::{RuleFaults, Scenario, Task};
use orthoframe::units::Source;

#[path = "planning/families.rs"]
mod families;

fn main() {
    let wanted = std::env::args().skip(1).find(|arg| !arg.starts_with('-')).unwrap_or_default();
    println!(
        "{:24} {:>6} {:>7} {:>7} {:>8}  answer; soon",
        "instance", "facts", "actions", "ground", "plan"
    );
    for instance in families::all().into_iter().filter(|instance| instance.name.contains(&wanted)) {
        let domain = Source::new("domain", &instance.domain);
        let problem = Source::new("problem", &instance.problem);
        measure(&instance.name, || Scenario::parse_pddl(&domain, &problem));
    }
    for problem in home_robot().into_iter().filter(|path| path.to_string_lossy().contains(&wanted))
    {
        let name = problem.file_stem().unwrap_or_default().to_string_lossy().into_owned();
        let domain = problem.with_file_name("domain.pddl");
        measure(&name, || Scenario::read_pddl(&domain, &problem));
    }
    let walk = Path::new(env!("CARGO_MANIFEST_DIR")).join("rules/scenarios/medicine-walk.strips");
    if "medicine-walk".contains(&wanted) {
        measure("medicine-walk", || Scenario::read(&walk));
    }
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

fn measure(name: &str, read: impl Fn() -> Result<Scenario, RuleFaults>) {
    let started = Instant::now();
    let task = match read().and_then(|scenario| scenario.ground()) {
        Ok(task) => task,
        Err(faults) => return println!("{name:24} {faults}"),
    };
    let ground = started.elapsed();
    let seconds = std::env::var("SECONDS").ok().and_then(|text| text.parse().ok()).unwrap_or(60);
    let timed = |solver: fn(&Task, &Limits) -> Outcome| {
        let started = Instant::now();
        let deadline = Some(started + Duration::from_secs(seconds));
        let outcome = solver(&task, &Limits { deadline, ..Limits::default() });
        (started.elapsed().as_secs_f64(), answer(&task, &outcome))
    };
    let (best, best_answer) = timed(solve);
    let (soon, soon_answer) = timed(solve_any);
    println!(
        "{name:24} {:6} {:7} {:7.3} {best:8.3}  {best_answer}; {soon:.3} {soon_answer}",
        task.facts.len(),
        task.operators.len(),
        ground.as_secs_f64(),
    );
}

fn answer(task: &Task, outcome: &Outcome) -> String {
    match outcome {
        Outcome::Plan(plan) => {
            assert_eq!(validate(task, plan), Ok(()), "a plan is replayed before it is counted");
            format!("{} steps, {} actions", plan.steps.len(), plan.action_count())
        }
        Outcome::NoPlan { leveled_off_at, .. } => format!("no plan (level {leveled_off_at})"),
        Outcome::LimitReached(limit) => format!("limit {limit:?}"),
    }
}
