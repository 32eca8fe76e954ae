//! One function a command.

use std::path::{Path, PathBuf};

use clap::Args;

use crate::engine::{
    Dialogue, Engine, Method, Outcome, Reply, Rules, State, Truth, World, change_now,
    uncertain_names,
};
use crate::facts::Value;
use crate::language::report::Detail as Level;
use crate::language::{Case, Language, NounPhrase};
use crate::robot::{SensingRobot, Vehicle};
use crate::strips::Scenario;
use crate::units::told;

use super::args::{Common, Detail, Lang, RouteMethod};
use super::fault::{Failure, drawn};
use super::notes::{note, warn};
use super::opened::{open, open_held, rules_dir};
use super::plan::Metric;
use super::teller::{RecordArgs, Teller};
use super::vehicle::VehicleArgs;
use super::{Answer, came_to, heeded, json, say, text};

#[derive(Debug, Args)]
pub(super) struct DoArgs {
    #[arg(required_unless_present_any = ["scenario", "resume"])]
    pub task: Option<String>,
    /// Have the task wait, for "resume" or --resume, instead of beginning it
    #[arg(long, requires = "task")]
    pub later: bool,
    /// Do what waits, in the order of the shortest way; what was under way when a process ended comes first
    #[arg(long, conflicts_with_all = ["task", "scenario", "later"])]
    pub resume: bool,
    /// Drive a scenario of a rule file (.strips) instead of a task in words
    #[arg(long, value_name = "FILE", conflicts_with = "task")]
    pub scenario: Option<PathBuf>,
    /// The world in which is driven, where it is not as the robot believes: a map file, or a file of edits
    #[arg(long, value_name = "FILE")]
    pub truth: Option<PathBuf>,
    /// Write the plan drawing here, as SVG or PNG by the name's ending
    #[arg(long, value_name = "FILE")]
    pub draw: Option<PathBuf>,
    /// Write the plan here as a behaviour tree, XML of BehaviorTree.CPP 4
    #[arg(long, value_name = "FILE.xml")]
    pub tree: Option<PathBuf>,
    /// Begin at the map's start, in a map as it was surveyed; what the robot did and saw before counts no more
    #[arg(long)]
    pub reset: bool,
    /// The robot stands here: a name, or X,Y[,HEADING]; else where the last task left it, or at the map's start
    #[arg(long, value_name = "PLACE", allow_hyphen_values = true)]
    pub from: Option<String>,
    /// What its plans have least of: steps, or the time to drive them
    #[arg(long, value_enum, value_name = "METRIC")]
    pub metric: Option<Metric>,
    /// Where something bars the only way, ask on standard input whether it is clear, instead of ending
    #[arg(long)]
    pub attended: bool,
    #[command(flatten)]
    pub vehicle: VehicleArgs,
    #[command(flatten)]
    pub record: RecordArgs,
}

pub(super) fn check(common: &Common, file: &Path, strict: bool) -> Result<Answer, Failure> {
    let (world, warnings) = Engine::check_map(file, rules_dir(common).as_deref())?;
    if strict && !warnings.faults.is_empty() {
        return Err(warnings.into());
    }
    warn(&warnings, common.lang);
    if common.json {
        return say(&json::sound_map(&world, &warnings, common.lang.language()).to_string());
    }
    let uncertain = uncertain_names(&world);
    let sound = told!(common.lang.language(), "the-map-is-sound");
    let mut lines = vec![format!("{sound} {}", text::described(&world, common.lang))];
    if !uncertain.is_empty() {
        lines.push(guessed(&uncertain, common.lang));
    }
    say(&lines.join("\n"))
}

/// How many names of uncertain forms are listed; the JSON has all.
const UNCERTAIN_SHOWN: usize = 20;

/// «Формы 2 имён угаданы …», each with its genitive, where a wrong guess shows.
fn guessed(uncertain: &[NounPhrase], lang: Lang) -> String {
    let shown: Vec<String> = uncertain
        .iter()
        .take(UNCERTAIN_SHOWN)
        .map(|phrase| {
            let of = told!(lang.language(), "genitive");
            format!("{} ({of} {})", phrase.name(), phrase.case(Case::Genitive))
        })
        .collect();
    let more = match uncertain.len().saturating_sub(UNCERTAIN_SHOWN) {
        0 => String::new(),
        more => format!(" {} {more}", told!(lang.language(), "and-more")),
    };
    let head = told!(lang.language(), "guessed-forms");
    format!("{head}: {}{more}.", shown.join(", "))
}

pub(super) fn relations(
    common: &Common,
    name: Option<&str>,
    of: Option<&str>,
) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let relations = engine.relations()?;
    if name.is_none() && of.is_none() {
        return if common.json {
            say(&json::counts(relations).to_string())
        } else {
            say(&text::counts(relations, common.lang))
        };
    }
    if common.json {
        return say(&json::facts(&engine, name, of, Language::Russian)?.to_string());
    }
    let rows = engine.facts(name, of)?;
    if rows.is_empty() {
        return say(&told!(common.lang.language(), "no-such-facts"));
    }
    let language = common.lang.language();
    let told = |(relation, values): &(String, Vec<Value>)| {
        let values: Vec<String> =
            values.iter().map(|value| engine.value_in_words(value, language)).collect();
        text::fact(&relations.display_name(relation, language), &values)
    };
    say(&rows.iter().map(told).collect::<Vec<_>>().join("\n"))
}

pub(super) fn perform(common: &Common, args: &DoArgs) -> Result<Answer, Failure> {
    let scenario = args.scenario.as_deref().map(Scenario::read).transpose()?;
    let mut engine = match scenario.as_ref().map(|scenario| &scenario.map) {
        Some(map) => super::plan::engine_for(common, map.as_deref(), open_held)?,
        None => open_held(common)?,
    };
    if args.reset {
        engine.reset_robot(&change_now(&common.user, "do --reset"))?;
    }
    if let Some(from) = &args.from {
        engine.place_robot(from, &change_now(&common.user, "do --from"))?;
    }
    if args.metric == Some(Metric::Time) {
        engine.plan_in_time();
    }
    super::plan::warn(&engine.rules().warnings, common.lang);
    if let Some(scenario) = &scenario {
        super::plan::warn(&scenario.warnings, common.lang);
    }
    let truth = args.truth.as_deref().map(|file| truth(common, &engine, file)).transpose()?;
    if let Some(scenario) = &scenario {
        let mut robot: Box<dyn Vehicle> =
            match args.vehicle.connect(engine.world()?, args.truth.as_deref())? {
                Some(robot) => Box::new(robot),
                None => match args.vehicle.senses() {
                    Some(senses) => Box::new(SensingRobot::new(engine.simulator(truth)?, senses)),
                    None => Box::new(engine.simulator(truth)?),
                },
            };
        let teller = teller(common, args, &engine)?;
        let answer =
            super::demo::perform_scenario(common, &mut engine, scenario, &mut *robot, teller)?;
        if let Some(path) = &args.draw {
            super::draw::put_driven(common, &engine, &answer, path)?;
        }
        return Ok(came_to(&answer));
    }
    let task = args.task.as_deref().unwrap_or_default();
    let mut dialogue = Dialogue::new(common.lang.language());
    if let Some(senses) = args.vehicle.senses() {
        dialogue = dialogue.driving(Box::new(SensingRobot::new(engine.simulator(truth)?, senses)));
    } else if let Some(truth) = truth {
        dialogue = dialogue.in_truth(truth);
    }
    if let Some(robot) = args.vehicle.connect(engine.world()?, args.truth.as_deref())? {
        dialogue = dialogue.driving(Box::new(robot));
    }
    let order = match (args.resume, args.later) {
        (true, _) => super::demo::Order::GoOn,
        (_, true) => super::demo::Order::Later(task),
        _ => super::demo::Order::Now(task),
    };
    let teller = teller(common, args, &engine)?;
    let heard = super::demo::perform(common, &mut engine, &order, dialogue, teller)?;
    if let (Some(path), Some(answer)) = (&args.draw, heard.tasks().last()) {
        super::draw::put_driven(common, &engine, answer, path)?;
    }
    let is_task = |reply: &&Reply| matches!(reply.outcome, Outcome::Task(_));
    let last = heard.replies.iter().rfind(is_task).or(heard.replies.last());
    Ok(last.map_or(Answer::Yes, |reply| heeded(&reply.outcome)))
}

fn teller(common: &Common, args: &DoArgs, engine: &Engine) -> Result<Teller, Failure> {
    let onlookers = args.record.begin(engine)?.writing(args.tree.as_deref());
    Ok(Teller::of_task(common, onlookers).attended(args.attended))
}

/// The world of `--truth`; what stayed behind in it is told beside.
fn truth(common: &Common, engine: &Engine, file: &Path) -> Result<World, Failure> {
    let Truth { world, left_behind } = engine.read_truth(file)?;
    if !left_behind.is_empty() {
        let names = left_behind.join(", ");
        note(&told!(common.lang.language(), "truth-left-behind", names));
    }
    Ok(world)
}

pub(super) fn export_rules(common: &Common, dir: &Path, force: bool) -> Result<Answer, Failure> {
    let written: Vec<String> =
        Rules::export(dir, force)?.into_iter().map(|path| path.display().to_string()).collect();
    if common.json {
        return say(&json::written(&written).to_string());
    }
    say(&written.join("\n"))
}

/// Puts rule files into the usual form and names those that changed.
pub(super) fn format_rules(common: &Common, files: &[PathBuf]) -> Result<Answer, Failure> {
    const MAX_BYTES: u64 = 16 << 20;
    let fault = |path: &Path, cause: std::io::Error| {
        let error = crate::facts::FilesError::File { path: path.to_owned(), cause };
        Failure::from(crate::engine::Error::from(Box::new(error)))
    };
    let mut changed = Vec::new();
    for path in files {
        let text = crate::units::read_text(path, MAX_BYTES)
            .map_err(|error| fault(path, error.into_io()))?;
        let formatted = crate::facts::format_rules(&text);
        if formatted != text {
            crate::units::write_file(path, formatted.as_bytes())
                .map_err(|cause| fault(path, cause))?;
            changed.push(path.display().to_string());
        }
    }
    if common.json {
        return say(&json::formatted(&changed).to_string());
    }
    say(&changed.join("\n"))
}

pub(super) fn route(
    common: &Common,
    from: &str,
    to: &str,
    method: RouteMethod,
    words: Option<Detail>,
) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let method = match method {
        RouteMethod::Shortest => Method::Shortest,
        RouteMethod::Paper => Method::Paper,
    };
    let journey = engine.journey(from, to, method)?;
    let world = engine.world_now()?;
    let found = journey.legs.iter().all(|leg| leg.route.is_ok());
    let language = common.lang.language();
    if common.json {
        let mut view = json::journey(world, &journey, language);
        if let Some(detail) = words.filter(|_| found) {
            let words = engine.journey_in_words(&journey, None, language, detail.level())?;
            view = json::with_words(view, &words);
        }
        say(&view.to_string())?;
    } else if let Some(detail) = words.filter(|_| found) {
        say(&engine.journey_in_words(&journey, None, language, detail.level())?.join("\n"))?;
    } else {
        let mut parts = Vec::new();
        for (k, leg) in journey.legs.iter().enumerate() {
            parts.push(text::route(world, engine.floor(leg.map)?, leg, common));
            if let Some(ride) = journey.rides.get(k) {
                parts.push(engine.ride_in_words(ride, language)?);
            }
        }
        let opens = journey.opens_in_words(world, language);
        parts.extend(Some(opens).filter(|told| !told.is_empty()));
        let head = told!(common.lang.language(), "to-open-a-way");
        let advice = journey.advice.as_ref().map(|a| a.in_words(world, language));
        parts.extend(advice.map(|a| format!("{head} {a}.")));
        say(&parts.join("\n"))?;
    }
    Ok(if found { Answer::Yes } else { Answer::No })
}

pub(super) fn locate(
    common: &Common,
    map: Option<&str>,
    at: Option<&str>,
    detail: Option<Detail>,
) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let (map, pose, facing) = match at {
        Some(at) => (engine.map_named(map)?, State::parse_pose(at)?, at.split(',').count() == 3),
        None => {
            let (map, pose) = engine.robot()?;
            (map, pose, true)
        }
    };
    let level = detail.map(Detail::level);
    let facing = level.map_or(facing, |level| level == Level::Heading);
    let found = engine.locate(map, pose, facing)?;
    if common.json {
        return say(&json::whereabout(engine.world()?, &found).to_string());
    }
    let language = common.lang.language();
    say(&match level {
        Some(level) => found.position.say_in(language, level),
        None => found.position.say(language),
    })
}

pub(super) fn datalog(
    common: &Common,
    program: &Path,
    facts: &Path,
    output: &Path,
    limits: crate::facts::Limits,
    explain: bool,
) -> Result<Answer, Failure> {
    let run = if explain { crate::facts::run_files_traced } else { crate::facts::run_files };
    let report =
        run(program, facts, output, limits).map_err(|e| crate::engine::Error::from(Box::new(e)))?;
    for warning in &report.warnings {
        note(
            match common.lang {
                Lang::Ru => drawn(warning, Lang::Ru),
                Lang::En => drawn(&warning.in_english(), Lang::En),
            }
            .trim_end(),
        );
    }
    for line in &report.traced {
        note(&line.say(common.lang.language()));
    }
    if common.json {
        let view = json::program_run(&report, explain, common.lang.language());
        return say(&view.to_string());
    }
    let printed = report.printed.trim_end();
    let lines: Vec<String> = (!printed.is_empty())
        .then(|| printed.to_owned())
        .into_iter()
        .chain(report.sizes.iter().map(|(name, n)| format!("{name}\t{n}")))
        .chain(report.written.iter().map(|path| path.display().to_string()))
        .collect();
    say(&lines.join("\n"))
}
