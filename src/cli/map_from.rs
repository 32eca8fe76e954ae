//! `ortho map-from`: a map of the walls that a log saw.

use std::path::PathBuf;

use crate::engine::{Engine, Sighted, json};
use crate::map::Format;
use crate::units::{told, write_file};
use clap::Args;

use super::args::Common;
use super::fault::Failure;
use super::notes::warn_of_lines;
use super::{Answer, say};

#[derive(Debug, Args)]
pub(super) struct MapFromArgs {
    /// A log whose scans tell their poses (CARMEN, rows of ranges; also gzipped)
    log: PathBuf,
    /// Map file to write, as TOML, YAML or JSON by its name; standard output when left out
    #[arg(short, long, value_name = "FILE")]
    out: Option<PathBuf>,
    /// To what size walls are told apart
    #[arg(long, value_name = "CM", default_value_t = 5.0, value_parser = cell)]
    cell: f64,
}

fn cell(text: &str) -> Result<f64, String> {
    let size: f64 = text.parse().map_err(|error: std::num::ParseFloatError| error.to_string())?;
    if (1.0..=100.0).contains(&size) { Ok(size) } else { Err("from 1 to 100 cm".to_owned()) }
}

pub(super) fn run(common: &Common, args: &MapFromArgs) -> Result<Answer, Failure> {
    let log = Sighted::read(&args.log)?;
    let built = log.to_map(args.cell)?.world;
    let format = args.out.as_deref().map_or(Format::Toml, Format::of);
    let (rooms, doors, things) = (built.areas.len(), built.doors.len(), built.replicas.len());
    let text = Engine::in_memory(built, None)?.export_map(format)?;
    let outcome = if log.faults().is_some() { Answer::Wrong } else { Answer::Yes };
    let Some(path) = &args.out else {
        say(text.trim_end())?;
        warn_of_lines(&log, common.lang);
        return Ok(outcome);
    };
    write_file(path, text.as_bytes()).map_err(|e| Failure::file(path, &e))?;
    if common.json {
        let value = json::map_of_log(path, [rooms, doors, things], log.faults());
        say(&value.to_string())?;
    } else {
        let path = path.display().to_string();
        let told = told!(common.lang.language(), "rooms-of-log", path, rooms, doors, things);
        say(&told)?;
        warn_of_lines(&log, common.lang);
    }
    Ok(outcome)
}
