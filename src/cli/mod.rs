//! The command line: arguments in, engine, text or JSON out.
//!
//! Results go to standard output, faults and progress to standard error. Exit codes: 0 done, 1 the answer is
//! no, 2 the input is wrong, 3 the disk, the vehicle or the program is at fault, 130 a signal stopped a task in good order.

mod args;
mod ask;
mod commands;
mod config;
mod config_error;
mod corridor;
mod demo;
mod differences;
mod draw;
mod edit;
mod export;
mod fault;
mod import;
mod inside;
mod language_server;
mod lengths;
mod locate;
mod manual;
mod map_from;
mod notes;
mod number;
mod observe;
mod opened;
mod plan;
mod query;
mod read;
mod replay;
mod see;
#[cfg(feature = "serve")]
mod serve;
mod signals;
mod store;
mod talk;
mod teller;
mod text;
mod vehicle;
mod waiting;
mod watch;
mod why;
mod words;

use std::io::Write;
use std::process::ExitCode;

use crate::engine::{Outcome, TaskAnswer, TaskEnding, json};
use crate::language::question::Said;

use args::{Arguments, Command};
pub(crate) use config_error::ConfigError;
use fault::Failure;

/// What a command came to.
enum Answer {
    Yes,
    No,
    /// What was asked was not understood, is ambiguous, or unknown to the map.
    Wrong,
    /// A signal stopped what was under way; all is in order.
    Stopped,
    /// The vehicle failed, which is told already.
    Failed,
}

/// Runs the program.
#[must_use]
pub fn run() -> ExitCode {
    let (arguments, fault) = config::arguments();
    let common = &arguments.common;
    fault::colour(common.color);
    if let Some(fault) = fault {
        return Failure::Config(fault).show(common.json, common.lang);
    }
    inside::tell(common.verbose);
    if !arguments.command.serves() {
        common.units.say();
    }
    if !common.json && arguments.command.may_be_silent() {
        waiting::begin(common.lang.language());
    }
    // A pipe that is closed early (`ortho relations | head`) ends the output, not the program's good name.
    let outcome = std::panic::catch_unwind(|| dispatch(&arguments));
    waiting::over();
    match outcome {
        Ok(Ok(Answer::Yes)) => ExitCode::SUCCESS,
        Ok(Ok(Answer::No)) => ExitCode::from(1),
        Ok(Ok(Answer::Wrong)) => ExitCode::from(2),
        Ok(Ok(Answer::Stopped)) => ExitCode::from(130),
        Ok(Ok(Answer::Failed)) => ExitCode::from(3),
        Ok(Err(failure)) => failure.show(arguments.common.json, arguments.common.lang),
        Err(_) => ExitCode::from(3),
    }
}

fn dispatch(arguments: &Arguments) -> Result<Answer, Failure> {
    let common = &arguments.common;
    match &arguments.command {
        Command::Demo { dir, map, task, out } => {
            demo::run(common, dir.as_deref(), map.as_deref(), task.as_deref(), out)
        }
        Command::Import(args) => import::run(common, args),
        Command::Export(args) => export::run(common, args),
        Command::Check { file, strict } => commands::check(common, file, *strict),
        Command::Edit(edit) => edit::run(common, edit),
        Command::Schema { vehicle: false } => say(&crate::map::json_schema()),
        Command::Schema { vehicle: true } => say(&crate::robot::protocol::json_schema()),
        Command::Relations { name, of } => {
            commands::relations(common, name.as_deref(), of.as_deref())
        }
        Command::Plan(plan) => plan::run(common, plan),
        Command::Query(args) => query::run(common, args),
        Command::Ask(ask) => ask::run(common, ask),
        Command::Do(args) => commands::perform(common, args),
        Command::Simulate(args) => vehicle::simulate(common, args),
        Command::Rules { export: Some(export), force, .. } => {
            commands::export_rules(common, export, *force)
        }
        Command::Rules { format, .. } => commands::format_rules(common, format),
        Command::Why { fact, not } => why::run(common, fact, *not),
        Command::Words { name } => words::run(common, name),
        Command::Watch { map, out } => watch::run(common, map, out.as_deref()),
        Command::Completions { shell } => manual::completions(*shell),
        Command::Man { dir } => manual::man(common, dir),
        Command::Talk(record) => talk::run(common, record),
        Command::Replay(args) => replay::run(common, args),
        Command::LanguageServer => language_server::run(),
        Command::Route { from, to, method, words } => {
            commands::route(common, from, to, *method, *words)
        }
        Command::Corridor(corridor) => corridor::run(common, corridor),
        Command::See(args) => see::run(common, args),
        Command::Locate(args) => locate::run(common, args),
        Command::Differences(args) => differences::run(common, args),
        Command::MapFrom(args) => map_from::run(common, args),
        Command::Datalog {
            program,
            facts,
            output,
            time_limit,
            memory_limit,
            row_limit,
            threads,
            explain,
        } => {
            let all = crate::facts::Limits::default();
            let limits = crate::facts::Limits {
                time: time_limit.unwrap_or(all.time),
                memory_bytes: memory_limit
                    .map_or(all.memory_bytes, |mib| mib.saturating_mul(1 << 20)),
                rows: row_limit.unwrap_or(all.rows),
                threads: threads.map_or(all.threads, usize::from),
                ..all
            };
            commands::datalog(common, program, facts, output, limits, *explain)
        }
        Command::Where { map, at, detail, read: None } => {
            commands::locate(common, map.as_deref(), at.as_deref(), *detail)
        }
        Command::Where { at, read: Some(text), .. } => read::run(common, text, at.as_deref()),
        Command::Observe(command) => observe::run(common, command),
        Command::Store(command) => store::run(common, command),
        #[cfg(feature = "serve")]
        Command::Serve(args) => serve::run(common, args),
        #[cfg(feature = "serve")]
        Command::Mcp(args) => serve::assist(common, args),
        Command::Draw(args) => draw::run(common, args),
    }
}

/// The exit code of what a dialogue replied.
fn heeded(outcome: &Outcome) -> Answer {
    match outcome {
        Outcome::Answered(answer) => match answer.said {
            Said::No | Said::Nothing | Said::Unknown => Answer::No,
            Said::Yes | Said::Found => Answer::Yes,
        },
        Outcome::Unanswered(_) => Answer::Wrong,
        Outcome::Task(task) => came_to(task),
        _ => Answer::Yes,
    }
}

/// The exit code of a task.
fn came_to(task: &TaskAnswer) -> Answer {
    match &task.ending {
        TaskEnding::Done | TaskEnding::AlreadyTrue if task.left.is_empty() => Answer::Yes,
        TaskEnding::Done
        | TaskEnding::AlreadyTrue
        | TaskEnding::NoPlan(_)
        | TaskEnding::Stuck(_) => Answer::No,
        TaskEnding::Stopped => Answer::Stopped,
        TaskEnding::Failed(_) => Answer::Failed,
    }
}

/// Prints a text with a line end.
fn say(text: &str) -> Result<Answer, Failure> {
    waiting::over();
    let mut out = std::io::stdout().lock();
    match writeln!(out, "{text}").and_then(|()| out.flush()) {
        Err(e) if e.kind() != std::io::ErrorKind::BrokenPipe => Err(Failure::output(&e)),
        _ => Ok(Answer::Yes),
    }
}
