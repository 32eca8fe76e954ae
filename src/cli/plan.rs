//! `ortho plan`: a plan for a scenario or a PDDL problem, or a given plan checked step by step.

use std::path::Path;

use serde_json::{Value, json};

use crate::engine::{
    Engine, PlanAnswer, RequestError, Solved, check_map, check_plan_alone, facts_in_rule_text,
    in_rule_text, name_in, plan_alone, plan_alone_without,
};
use crate::graphplan::{Limit, Limits, Outcome, Plan};
use crate::language::Language;
use crate::semantics::planning::InitialFact;
use crate::strips::{PlanText, RuleFault, RuleFaults, Scenario, Wording};
use crate::units::{English, write_file};

use super::args::{Common, Lang, Metric, PlanArgs};
use super::commands::{DEFAULT_STORE, note, open, rules_dir};
use super::fault::{Failure, drawn};
use super::signals::stopped_by_signals;
use super::{Answer, json as views, say, text};

pub(super) fn run(common: &Common, args: &PlanArgs) -> Result<Answer, Failure> {
    if args.facts {
        return facts(common, args.name.as_deref());
    }
    let (mut scenario, engine) = read(common, args)?;
    if let Some(plan) = &args.check {
        for text in &args.without {
            scenario.problem.withdraw_assumptions(&scenario.domain, text)?;
        }
        return check(common, &scenario, plan);
    }
    let world = engine.as_ref().and_then(|engine| engine.world().ok());
    let names = |name: &str, language| match world {
        Some(world) => name_in(world, name, language),
        None => name.to_owned(),
    };
    let (language, limits) = (common.lang.language(), args.limits());
    let limits =
        Limits { tell: Some(interim(common.lang)), stop: Some(stopped_by_signals()), ..limits };
    let limits = match (args.anytime, common.json) {
        (false, _) => limits,
        (true, false) => Limits { tell_bound: Some(bound(common.lang)), ..limits },
        (true, true) => {
            Limits { tell: Some(stream_plan), tell_bound: Some(stream_bound), ..limits }
        }
    };
    let english = |name: &str| names(name, Language::English);
    let name = |name: &str| names(name, language);
    let (solved, warnings, told) = if args.without.is_empty() {
        let PlanAnswer { solved, warnings } = match args.metric {
            Some(Metric::Time) => quickest(engine.as_ref(), scenario, limits.clone())?,
            _ => match &engine {
                Some(engine) => engine.plan_supplied(scenario, &limits, args.wanted())?,
                None => plan_alone(scenario, &limits, args.wanted())?,
            },
        };
        let told = match common.json {
            true => {
                let view = views::plan(&solved, &english);
                let view = with_reasons(view, &solved, &limits, args, &english);
                with_help(view, &solved, args).to_string()
            }
            false => {
                let wording = solved.wording(language, &name);
                let told = text::plan(&solved, &wording) + &help(&solved, args, language);
                told + &reasons(&solved, &limits, args, &wording)
            }
        };
        (solved, warnings, told)
    } else {
        let (without, wanted) = (&args.without, args.wanted());
        let (replanned, warnings) = match &engine {
            Some(engine) => engine.plan_supplied_without(scenario, without, &limits, wanted)?,
            None => plan_alone_without(scenario, without, &limits, wanted)?,
        };
        let after = &replanned.after;
        let told = match common.json {
            true => {
                let view = views::replanned(&replanned, &english);
                let view = with_reasons(view, after, &limits, args, &english);
                with_help(view, after, args).to_string()
            }
            false => {
                let wording = after.wording(language, &name);
                let told = text::replanned(&replanned, &wording) + &help(after, args, language);
                told + &reasons(after, &limits, args, &wording)
            }
        };
        (replanned.after, warnings, told)
    };
    warn(&warnings, common.lang);
    if let (Some(path), Some(plan)) = (&args.out, solved.outcome.plan()) {
        let text = PlanText::write(&solved.task, &plan.steps);
        write_file(path, text.as_bytes()).map_err(|e| Failure::file(path, &e))?;
    }
    say(&told)?;
    Ok(if matches!(solved.outcome, Outcome::Plan(_)) { Answer::Yes } else { Answer::No })
}

/// The plan that takes the least time on the map's floor. Of steps, which are told of on the way, nothing is sought.
fn quickest(
    engine: Option<&Engine>,
    scenario: Scenario,
    limits: Limits,
) -> Result<PlanAnswer, Failure> {
    let no_map = || RequestError::NoMap { store: DEFAULT_STORE.to_owned() };
    let engine = engine.ok_or_else(no_map)?;
    Ok(engine.plan_quickest(scenario, &Limits { tell: None, ..limits })?)
}

/// What would help where the search was given up.
fn remedies(solved: &Solved, args: &PlanArgs) -> Vec<&'static str> {
    let Outcome::LimitReached(known) = &solved.outcome else { return Vec::new() };
    let more = match known.limit {
        Limit::Time => Some("--time-limit"),
        Limit::Memory => Some("--memory-limit"),
        Limit::Effort => Some("--effort"),
        Limit::Steps | Limit::Stopped => None,
    };
    let is_proof = !args.any && !args.anytime && args.metric != Some(Metric::Time);
    is_proof.then_some("--any").into_iter().chain(more).collect()
}

fn with_help(mut view: Value, solved: &Solved, args: &PlanArgs) -> Value {
    if matches!(solved.outcome, Outcome::LimitReached(_)) {
        view["help"] = json!(remedies(solved, args));
    }
    view
}

/// With `--why`, why no plan has fewer steps.
fn reasons(solved: &Solved, limits: &Limits, args: &PlanArgs, wording: &Wording<'_>) -> String {
    let why = args.why.then(|| solved.why_not_shorter(limits)).flatten();
    why.map_or_else(String::new, |why| format!("\n{}", why.in_words(wording)))
}

fn with_reasons(
    mut view: Value,
    solved: &Solved,
    limits: &Limits,
    args: &PlanArgs,
    english: &dyn Fn(&str) -> String,
) -> Value {
    if let Some(why) = args.why.then(|| solved.why_not_shorter(limits)).flatten() {
        view["why_not_shorter"] =
            views::shortness(&why, &solved.wording(Language::English, english));
    }
    view
}

fn help(solved: &Solved, args: &PlanArgs, language: Language) -> String {
    let told: Vec<&str> = remedies(solved, args)
        .into_iter()
        .map(|remedy| match remedy {
            "--any" => language.pick(
                "--any (план скоро, без доказательства, что он кратчайший)",
                "--any (a plan soon, not proven to be the shortest)",
            ),
            "--effort" => language.pick("больше усилий (--effort)", "more effort (--effort)"),
            "--time-limit" => {
                language.pick("больше времени (--time-limit)", "more time (--time-limit)")
            }
            _ => language.pick("больше памяти (--memory-limit)", "more memory (--memory-limit)"),
        })
        .collect();
    if told.is_empty() {
        return String::new();
    }
    let (head, or) =
        (language.pick("Помогло бы: ", "It would help: "), language.pick(" или ", " or "));
    format!("\n{head}{}", told.join(or))
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

/// With `--anytime`, every higher bound is told of.
fn bound(lang: Lang) -> fn(usize) {
    match lang {
        Lang::Ru => |least| note(&format!("Доказано: шагов нужно не меньше {least}.")),
        Lang::En => |least| note(&format!("Proven: at least {least} steps are needed.")),
    }
}

/// With `--anytime --json`, a line for every plan with fewer steps and every higher bound; the answer is the last line.
/// Who no longer listens is told nothing; that is found when the answer is to be told.
fn stream_plan(plan: &Plan) {
    let (steps, actions) = (plan.steps.len(), plan.action_count());
    let _ = say(&json!({"event": "plan", "parallel_steps": steps, "actions": actions}).to_string());
}

fn stream_bound(at_least: usize) {
    let _ = say(&json!({"event": "bound", "at_least_steps": at_least}).to_string());
}

/// Who knows the map of a scenario: the store that was named; else the map that the scenario names; else the default
/// store.
pub(super) fn engine_for(common: &Common, map: Option<&Path>) -> Result<Engine, Failure> {
    match map {
        Some(map) if common.store.is_none() => {
            let (world, _) = check_map(map)?;
            Ok(Engine::in_memory(world, rules_dir(common).as_deref())?)
        }
        _ => open(common),
    }
}

/// What the map gives to planning, in the language of rule files.
fn facts(common: &Common, predicate: Option<&str>) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let facts = engine.facts_given(predicate)?;
    if common.json {
        let fact = |fact: &InitialFact| {
            let args: Vec<&str> = fact.arguments.iter().map(|a| a.name.as_str()).collect();
            let kinds: Vec<&str> = fact.arguments.iter().map(|a| a.kind).collect();
            let text = in_rule_text(fact);
            json!({"predicate": fact.predicate, "args": args, "types": kinds, "assumed": fact.assumed, "text": text})
        };
        return say(&json!({"facts": facts.iter().map(fact).collect::<Vec<_>>()}).to_string());
    }
    if facts.is_empty() {
        return say(common.lang.pick("Таких фактов нет.", "There are no such facts."));
    }
    say(facts_in_rule_text(&facts).trim_end())
}

/// The scenario with what its map knows, and who knows that map: the store that was named; else the map that the
/// scenario names; else the default store, if there is one; else nobody, and the scenario's own facts are all there is.
fn read(common: &Common, args: &PlanArgs) -> Result<(Scenario, Option<Engine>), Failure> {
    let path = match (&args.scenario, &args.domain, &args.problem) {
        (None, Some(domain), Some(problem)) => {
            return Ok((Scenario::read_pddl(domain, problem)?, None));
        }
        (Some(scenario), _, _) => scenario,
        _ => unreachable!("clap asks for a scenario or for both PDDL files"),
    };
    let (mut scenario, faults) = Scenario::read_whole(path)?;
    let engine = || -> Result<Option<Engine>, Failure> {
        let is_any =
            common.store.is_some() || scenario.map.is_some() || Path::new(DEFAULT_STORE).is_dir();
        is_any.then(|| engine_for(common, scenario.map.as_deref())).transpose()
    };
    if faults.is_empty() {
        let engine = engine()?;
        let scenario = match &engine {
            Some(engine) => engine.supplemented(scenario)?,
            None => scenario,
        };
        return Ok((scenario, engine));
    }
    // Beside the faults of the text those of the names that the map would have to know; where there is no map to ask,
    // the text's own.
    match engine() {
        Ok(Some(engine)) if engine.supply(&mut scenario).is_err() => Err(RuleFaults(faults).into()),
        Ok(_) => Err(scenario.with_faults_of_names(faults).into()),
        Err(_) => Err(RuleFaults(faults).into()),
    }
}

fn check(common: &Common, scenario: &Scenario, plan: &Path) -> Result<Answer, Failure> {
    let plan = PlanText::read(plan)?;
    warn(&scenario.warnings, common.lang);
    let replayed = check_plan_alone(scenario, &plan)?;
    if common.json {
        say(&views::replayed(&replayed).to_string())?;
    } else {
        say(&text::replayed(&replayed, common.lang))?;
    }
    Ok(if replayed.broken.is_none() { Answer::Yes } else { Answer::No })
}

/// Harmless faults of rule files go to standard error.
pub(super) fn warn(warnings: &[RuleFault], lang: Lang) {
    for warning in warnings {
        note(
            match lang {
                Lang::Ru => drawn(warning, Lang::Ru),
                Lang::En => drawn(&English(warning), Lang::En),
            }
            .trim_end(),
        );
    }
}
