//! `ortho plan`: a plan for a scenario or a PDDL problem, or a given plan checked step by step.

use std::path::Path;

use crate::engine::{Engine, PlanAnswer, check_map, check_plan_alone, plan_alone};
use crate::graphplan::{Limits, Outcome, Plan};
use crate::strips::{PlanText, RuleFault, Scenario};

use super::args::{Common, Lang, PlanArgs};
use super::commands::{DEFAULT_STORE, note, open, rules_dir};
use super::fault::{Failure, drawn};
use super::{Answer, json, say, text};

pub(super) fn run(common: &Common, args: &PlanArgs) -> Result<Answer, Failure> {
    let (scenario, engine) = read(common, args)?;
    if let Some(plan) = &args.check {
        return check(common, scenario, engine.as_ref(), plan);
    }
    let wanted = args.wanted();
    let limits = Limits { tell: Some(interim(common.lang)), ..args.limits() };
    let PlanAnswer { solved, warnings } = match &engine {
        Some(engine) => engine.plan(scenario, &limits, wanted)?,
        None => plan_alone(scenario, &limits, wanted)?,
    };
    warn(&warnings);
    if let (Some(path), Outcome::Plan(plan)) = (&args.out, &solved.outcome) {
        let text = PlanText::write(&solved.task, &plan.steps);
        std::fs::write(path, text).map_err(|e| Failure::file(path, &e))?;
    }
    if common.json {
        say(&json::plan(&solved).to_string())?;
    } else {
        say(&text::plan(&solved, common.lang))?;
    }
    Ok(if matches!(solved.outcome, Outcome::Plan(_)) { Answer::Yes } else { Answer::No })
}

/// A plan found soon is told of at once, and so is every shorter one made of it; the last is the answer.
fn interim(lang: Lang) -> fn(&Plan) {
    match lang {
        Lang::Ru => |plan| {
            let (steps, actions) = (plan.steps.len(), plan.action_count());
            note(&format!("Найден план: шагов {steps}, действий {actions}; ищется короче."));
        },
        Lang::En => |plan| {
            let size = text::english_size(plan.steps.len(), plan.action_count());
            note(&format!("A plan is found: {size}; a shorter one is sought."));
        },
    }
}

/// The scenario, and who knows its map: the store that was named; else the map that the scenario names; else the
/// default store, if there is one; else nobody, and the scenario's own facts are all there is.
fn read(common: &Common, args: &PlanArgs) -> Result<(Scenario, Option<Engine>), Failure> {
    let path = match (&args.scenario, &args.domain, &args.problem) {
        (None, Some(domain), Some(problem)) => {
            return Ok((Scenario::read_pddl(domain, problem)?, None));
        }
        (Some(scenario), _, _) => scenario,
        _ => unreachable!("clap asks for a scenario or for both PDDL files"),
    };
    let scenario = Scenario::read(path)?;
    let engine = match &scenario.map {
        _ if common.store.is_some() => Some(open(common)?),
        Some(map) => {
            let (world, _) = check_map(map)?;
            Some(Engine::in_memory(world, rules_dir(common).as_deref())?)
        }
        None if Path::new(DEFAULT_STORE).is_dir() => Some(open(common)?),
        None => None,
    };
    Ok((scenario, engine))
}

fn check(
    common: &Common,
    scenario: Scenario,
    engine: Option<&Engine>,
    plan: &Path,
) -> Result<Answer, Failure> {
    let plan = PlanText::read(plan)?;
    warn(&scenario.warnings);
    let replayed = match engine {
        Some(engine) => engine.check_plan(scenario, &plan)?,
        None => check_plan_alone(&scenario, &plan)?,
    };
    if common.json {
        say(&json::replayed(&replayed).to_string())?;
    } else {
        say(&text::replayed(&replayed, common.lang))?;
    }
    Ok(if replayed.broken.is_none() { Answer::Yes } else { Answer::No })
}

/// Harmless faults of rule files go to standard error.
pub(super) fn warn(warnings: &[RuleFault]) {
    for warning in warnings {
        note(drawn(warning).trim_end());
    }
}
