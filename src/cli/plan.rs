//! `ortho plan`: a plan for a scenario or a PDDL problem, or a given plan checked step by step.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use clap::{Args, ValueEnum};
use serde_json::Value;

use crate::engine::{
    Engine, PlanAnswer, RequestError, Solved, check_plan_alone, name_in, plan_alone_without,
    read_map,
};
use crate::graphplan::{Limit, Limits, Outcome, Plan};
use crate::language::Language;
use crate::robot::Wanted;
use crate::strips::{PlanText, RuleFault, RuleFaults, Scenario, Wording};
use crate::units::{English, told, write_file};

use super::args::{Common, Lang, parse_seconds};
use super::fault::{Failure, drawn};
use super::notes::note;
use super::opened::{DEFAULT_STORE, open, rules_dir};
use super::signals::stopped_by_signals;
use super::{Answer, json, say, text};

#[derive(Debug, Args)]
pub(super) struct PlanArgs {
    /// Scenario file (.strips)
    #[arg(required_unless_present_any = ["problem", "facts"])]
    pub scenario: Option<PathBuf>,
    /// Print the facts that the map gives to planning, in the language of rule files
    #[arg(long, conflicts_with_all = ["scenario", "problem", "domain", "out", "check", "any", "without"])]
    pub facts: bool,
    /// Only facts of this predicate
    #[arg(long, requires = "facts", value_name = "PREDICATE")]
    pub name: Option<String>,
    /// PDDL domain file
    #[arg(long, requires = "problem", value_name = "FILE")]
    pub domain: Option<PathBuf>,
    /// PDDL problem file
    #[arg(long, requires = "domain", conflicts_with = "scenario", value_name = "FILE")]
    pub problem: Option<PathBuf>,
    /// Write the plan here, in the format that plan validators read
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Check this plan step by step instead of making one
    #[arg(long, value_name = "PLAN", conflicts_with_all = ["out", "any", "time_limit", "memory_limit"])]
    pub check: Option<PathBuf>,
    /// A plan soon, not proven to be the shortest
    #[arg(long)]
    pub any: bool,
    /// A plan at once, better ones as they come, and what is proven of the fewest steps, until the two meet
    #[arg(long, conflicts_with_all = ["any", "check", "facts"])]
    pub anytime: bool,
    /// The shortest plan by GraphPlan as published, and nothing else
    #[arg(long, conflicts_with_all = ["any", "anytime", "check", "facts"])]
    pub plain: bool,
    /// Tell why no plan has fewer steps: what every plan goes through, and what each goal takes alone
    #[arg(long, conflicts_with_all = ["check", "facts"])]
    pub why: bool,
    /// What the plan has least of: steps, or, on the map's floor, the time to drive it
    #[arg(long, value_enum, value_name = "METRIC", conflicts_with_all = ["any", "anytime", "plain", "why", "check", "facts", "without", "domain"])]
    pub metric: Option<Metric>,
    /// With --anytime: end after so much effort, in millions of variables set by the solver and what takes as long
    #[arg(long, value_name = "MILLIONS", requires = "anytime")]
    pub effort: Option<u64>,
    /// Withdraw an assumption and plan anew; ?x stands for any object; may be given several times
    #[arg(long, value_name = "FACT")]
    pub without: Vec<String>,
    /// Give up after this many seconds
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    pub time_limit: Option<Duration>,
    /// Give up when planning takes more memory than this, MiB; 1024 when left out
    #[arg(long, value_name = "MIB")]
    pub memory_limit: Option<usize>,
}

/// What a plan has least of.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Metric {
    /// Parallel steps
    Steps,
    /// Seconds, by the map's floor: ways and turns, doors, lifts and their waits, what the hand does
    Time,
}

impl PlanArgs {
    pub(super) fn wanted(&self) -> Wanted {
        match self {
            Self { any: true, .. } => Wanted::Any,
            Self { anytime: true, .. } => Wanted::Anytime,
            Self { plain: true, .. } => Wanted::Plain,
            _ => Wanted::Shortest,
        }
    }

    pub(super) fn limits(&self) -> Limits {
        let deadline = self.time_limit.and_then(|limit| Instant::now().checked_add(limit));
        let all = Limits::default();
        let memory_bytes =
            self.memory_limit.map_or(all.memory_bytes, |mib| mib.saturating_mul(1 << 20));
        let effort = self.effort.map(|millions| millions.saturating_mul(1_000_000));
        // Who gives it time wants it used.
        let shorten_effort = deadline.map_or(all.shorten_effort, |_| u64::MAX);
        Limits { deadline, memory_bytes, effort, shorten_effort, ..all }
    }
}

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
                None => PlanAnswer::without_map(scenario, &limits, args.wanted())?,
            },
        };
        let told = match common.json {
            true => {
                let view = json::plan(&solved, world);
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
                let view = json::replanned(&replanned, world);
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

fn with_help(view: Value, solved: &Solved, args: &PlanArgs) -> Value {
    match solved.outcome {
        Outcome::LimitReached(_) => json::with_remedies(view, &remedies(solved, args)),
        _ => view,
    }
}

/// With `--why`, why no plan has fewer steps.
fn reasons(solved: &Solved, limits: &Limits, args: &PlanArgs, wording: &Wording<'_>) -> String {
    let why = args.why.then(|| solved.why_not_shorter(limits)).flatten();
    why.map_or_else(String::new, |why| format!("\n{}", why.in_words(wording)))
}

fn with_reasons(
    view: Value,
    solved: &Solved,
    limits: &Limits,
    args: &PlanArgs,
    english: &dyn Fn(&str) -> String,
) -> Value {
    let why = args.why.then(|| solved.why_not_shorter(limits)).flatten();
    match why {
        Some(why) => json::with_shortness(view, &why, &solved.wording(Language::English, english)),
        None => view,
    }
}

fn help(solved: &Solved, args: &PlanArgs, language: Language) -> String {
    let told: Vec<String> = remedies(solved, args)
        .into_iter()
        .map(|remedy| match remedy {
            "--any" => told!(language, "remedy-any"),
            "--effort" => told!(language, "remedy-effort"),
            "--time-limit" => {
                told!(language, "remedy-time")
            }
            _ => told!(language, "remedy-memory"),
        })
        .collect();
    if told.is_empty() {
        return String::new();
    }
    let (head, or) = (told!(language, "it-would-help"), told!(language, "or"));
    format!("\n{head}{}", told.join(&or))
}

/// A plan found soon is told of at once, and so is every shorter one made of it; the last is the answer.
fn interim(lang: Lang) -> fn(&Plan) {
    fn tell(plan: &Plan, language: Language) {
        let (steps, actions) = (plan.steps.len(), plan.action_count());
        note(&told!(language, "plan-found", steps, actions));
    }
    match lang {
        Lang::Ru => |plan| tell(plan, Language::Russian),
        Lang::En => |plan| tell(plan, Language::English),
    }
}

/// With `--anytime`, every higher bound is told of.
fn bound(lang: Lang) -> fn(usize) {
    match lang {
        Lang::Ru => |least| note(&told!(Language::Russian, "plan-bound", least)),
        Lang::En => |least| note(&told!(Language::English, "plan-bound", least)),
    }
}

/// With `--anytime --json`, a line for every plan with fewer steps and every higher bound; the answer is the last line.
/// Who no longer listens is told nothing; that is found when the answer is to be told.
fn stream_plan(plan: &Plan) {
    let _ = say(&json::better_plan(plan).to_string());
}

fn stream_bound(at_least: usize) {
    let _ = say(&json::higher_bound(at_least).to_string());
}

/// Who knows the map of a scenario: the store that was named; else the map that the scenario names; else the default
/// store, opened as it is to be used.
pub(super) fn engine_for(
    common: &Common,
    map: Option<&Path>,
    open: impl FnOnce(&Common) -> Result<Engine, Failure>,
) -> Result<Engine, Failure> {
    match map {
        Some(map) if common.store.is_none() => {
            let (world, _) = read_map(map)?;
            Ok(Engine::in_memory(world, rules_dir(common).as_deref())?)
        }
        _ => open(common),
    }
}

/// What the map gives to planning, in the language of rule files.
fn facts(common: &Common, predicate: Option<&str>) -> Result<Answer, Failure> {
    let engine = open(common)?;
    if common.json {
        return say(&json::given_facts(&engine.facts_given(predicate)?).to_string());
    }
    let facts = engine.facts_in_rule_text(predicate, common.lang.language())?;
    if facts.is_empty() {
        return say(&told!(common.lang.language(), "no-such-facts"));
    }
    say(facts.trim_end())
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
        is_any.then(|| engine_for(common, scenario.map.as_deref(), open)).transpose()
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
        say(&json::replayed(&replayed).to_string())?;
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
