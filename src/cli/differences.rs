//! `ortho differences`: what the scans of a log see that the map has otherwise.

use std::time::SystemTime;

use clap::Args;

use crate::engine::{Sighted, json};

use super::args::{Common, LogOnMap};
use super::fault::Failure;
use super::notes::warn_of_lines;
use super::opened::{open, open_held};
use super::{Answer, say};

#[derive(Debug, Args)]
pub(super) struct DifferencesArgs {
    #[command(flatten)]
    of: LogOnMap,
    /// Which scan of the log, from 1; all when left out
    #[arg(long, value_name = "N")]
    scan: Option<usize>,
    /// The log tells the poses, in the map's frame; else they are found
    #[arg(long)]
    posed: bool,
    /// Keep it as seen: things as observations, doors and obstacles as the world is now. The map stays as it was
    #[arg(long)]
    keep: bool,
}

pub(super) fn run(common: &Common, args: &DifferencesArgs) -> Result<Answer, Failure> {
    let mut engine = if args.keep { open_held(common)? } else { open(common)? };
    let log = Sighted::read(&args.of.log)?;
    let map = engine.map_named(args.of.map.as_deref())?;
    let now = SystemTime::now().into();
    let seen = engine.differences(map, &log, args.scan, args.of.height, args.posed, now)?;
    if args.keep {
        engine.keep_differences(&seen, now)?;
    }
    if common.json {
        let value = json::differing(engine.world()?, &seen);
        say(&json::of_log(value, None, log.faults()).to_string())?;
    } else {
        say(&seen.in_words(engine.world()?, common.lang.language()).join("\n"))?;
        warn_of_lines(&log, common.lang);
    }
    Ok(match log.faults() {
        Some(_) => Answer::Wrong,
        None if seen.held == 0 => Answer::No,
        None => Answer::Yes,
    })
}
