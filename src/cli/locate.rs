//! `ortho locate`: where the scans of a log can have been taken.

use clap::Args;

use crate::engine::{FoundPose, FoundScan, Sighted, json};
use crate::language::report::Detail;
use crate::units::told;

use super::args::{Common, LogOnMap};
use super::fault::Failure;
use super::notes::warn_of_lines;
use super::opened::open;
use super::{Answer, say};

#[derive(Debug, Args)]
pub(super) struct LocateArgs {
    #[command(flatten)]
    of: LogOnMap,
    /// Which scan of the log, from 1; all when left out
    #[arg(long, value_name = "N")]
    scan: Option<usize>,
    /// Carry what is possible along by odometry, from scan to scan
    #[arg(long)]
    follow: bool,
}

pub(super) fn run(common: &Common, args: &LocateArgs) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let log = Sighted::read(&args.of.log)?;
    let map = engine.map_named(args.of.map.as_deref())?;
    let found = engine.find_scans(map, &log, args.scan, args.of.height, args.follow)?;
    if common.json {
        let value = json::found_scans(engine.world()?, &found);
        say(&json::of_log(value, None, log.faults()).to_string())?;
    } else {
        let lines: Vec<String> = found.iter().map(|scan| tell(common, scan)).collect();
        say(&lines.join("\n"))?;
        warn_of_lines(&log, common.lang);
    }
    Ok(match log.faults() {
        Some(_) => Answer::Wrong,
        None if found.iter().any(|scan| scan.is_unique()) => Answer::Yes,
        None => Answer::No,
    })
}

fn tell(common: &Common, found: &FoundScan) -> String {
    let lang = common.lang;
    let scan = format!("{} {}", told!(lang.language(), "scan"), found.scan);
    let event = found.event_in_words(lang.language());
    let event = event.map_or_else(String::new, |event| format!(" ({event})"));
    let telling = found.telling_in_words(lang.language()).map_or_else(String::new, |told| {
        format!(" {}: {told}.", told!(lang.language(), "what-would-tell"))
    });
    if let Some(why) = found.unknown_in_words(lang.language()) {
        let unknown = told!(lang.language(), "place-unknown");
        return format!("{scan}{event}: {unknown}: {why}.{telling}");
    }
    let poses: Vec<String> = found.poses.iter().map(|pose| tell_pose(common, pose)).collect();
    match &poses[..] {
        [only] => format!("{scan}{event}: {only}"),
        several => {
            let head = told!(lang.language(), "one-of-places", several = several.len());
            format!("{scan}{event}: {head}: {}{telling}", several.join(" "))
        }
    }
}

fn tell_pose(common: &Common, found: &FoundPose) -> String {
    let (lang, lengths) = (common.lang, common.units);
    let place = found.place.as_ref().map_or_else(
        || told!(lang.language(), "outside-of-rooms"),
        |place| place.position.say_in(lang.language(), Detail::Region),
    );
    let (at, heading) = (found.pose.at, found.pose.heading.get());
    let (cm, degrees) = found.deviation;
    let (at, unit) = (lengths.point(at.x, at.y, 0), lengths.word(lang.language()));
    let off = lengths.number(cm.max(1.0), 0);
    format!("{at}, {heading:.0}°, ± {off} {unit} {degrees:.1}°. {place}")
}
