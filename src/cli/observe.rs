//! What was seen, what is believed, and corrections of the map (D5, M8).

use crate::engine::{Believed, Engine, Source, Timestamp, change_now};
use crate::store::Seen;
use crate::units::{Deg, Frame, Lengths, told};
use clap::{Args, Subcommand};

use super::args::{Common, Lang, moment};
use super::edit::Numbers;
use super::fault::Failure;
use super::number::finite;
use super::opened::{open, open_to_write};
use super::text::spoken;
use super::{Answer, json, say};

#[derive(Debug, Subcommand)]
pub(super) enum ObserveCommand {
    /// Where a thing is believed to be, how surely, and since when
    Find {
        name: String,
        /// At this moment, by what was known then
        #[arg(long, value_name = "MOMENT", value_parser = moment)]
        at: Option<Timestamp>,
        /// All that is known of where it stood
        #[arg(long)]
        story: bool,
    },
    /// Note that a thing was seen somewhere, or was not where it was expected
    Observe(ObserveArgs),
    /// Things that are believed to stand elsewhere than the map says, and those that it lacks
    Proposals,
    /// Correct the map: the thing does stand where it is believed to, or is one that the map lacks
    Confirm {
        name: String,
        #[arg(long, value_name = "TEXT")]
        reason: Option<String>,
    },
    /// The map is right: what was seen of the thing until now counts no more
    Reject {
        name: String,
        #[arg(long, value_name = "TEXT")]
        reason: Option<String>,
    },
}

#[derive(Debug, Args)]
pub(super) struct ObserveArgs {
    name: String,
    /// Where it was seen, in the frame of the Area, cm
    #[arg(
        long,
        value_name = "X,Y[,Z]",
        allow_hyphen_values = true,
        value_parser = coordinates,
        required_unless_present_any = ["missing", "pose"]
    )]
    at: Option<Numbers>,
    /// Where it was seen, in the frame of the Map: that of `where` and `route`, and of the file of an imported map, cm
    #[arg(long, value_name = "X,Y[,Z]", allow_hyphen_values = true, value_parser = coordinates, conflicts_with_all = ["at", "area", "missing"])]
    pose: Option<Numbers>,
    /// The Map of --pose; the one on which the map has the thing when left out
    #[arg(long, value_name = "NAME", requires = "pose")]
    map: Option<String>,
    /// The Area; the one in which the map has the thing when left out
    #[arg(long, value_name = "NAME")]
    area: Option<String>,
    /// Degrees counter-clockwise; as the map has it when left out
    #[arg(long, value_name = "DEG", allow_hyphen_values = true, value_parser = finite)]
    angle: Option<f64>,
    /// It was not where it was expected
    #[arg(long, conflicts_with = "at")]
    missing: bool,
    /// How sure, 0 to 1
    #[arg(long, default_value_t = 0.9, value_name = "0..1", value_parser = share)]
    sure: f64,
    /// When; now when left out
    #[arg(long, value_name = "MOMENT", value_parser = moment)]
    when: Option<Timestamp>,
}

/// Two numbers of the plane, and the height where it is known.
fn coordinates(text: &str) -> Result<Numbers, String> {
    let numbers: Numbers = text.parse()?;
    let is_place = matches!(numbers.0.len(), 2 | 3);
    if is_place { Ok(numbers) } else { Err("X,Y or X,Y,Z is wanted".to_owned()) }
}

fn share(text: &str) -> Result<f64, String> {
    let share: f64 = text.parse().map_err(|e| format!("{e}"))?;
    if (0.0..=1.0).contains(&share) { Ok(share) } else { Err("0 … 1".to_owned()) }
}

fn now() -> Timestamp {
    std::time::SystemTime::now().into()
}

pub(super) fn run(common: &Common, command: &ObserveCommand) -> Result<Answer, Failure> {
    match command {
        ObserveCommand::Find { name, story: true, .. } => story(common, name),
        ObserveCommand::Find { name, at, .. } => {
            let engine = open(common)?;
            let found = engine.where_is(name, at.unwrap_or_else(now))?;
            if common.json {
                say(&json::believed(&engine, &found)?.to_string())
            } else {
                say(&told(&engine, &found, common.lang)?)
            }
        }
        ObserveCommand::Observe(args) => observe(common, args),
        ObserveCommand::Proposals => proposals(common),
        ObserveCommand::Confirm { name, reason } => {
            let change = change_now(&common.user, reason.as_deref().unwrap_or("confirm"));
            let mut engine = open_to_write(common)?;
            let report = engine.confirm(name, &change)?;
            if common.json {
                return say(&json::changed("confirmed", &report).to_string());
            }
            let written = told!(common.lang.language(), "map-corrected");
            say(&format!("{written} {}.", report.revision))
        }
        ObserveCommand::Reject { name, reason } => {
            let change = change_now(&common.user, reason.as_deref().unwrap_or("reject"));
            let mut engine = open_to_write(common)?;
            engine.reject(name, &change)?;
            if common.json {
                return say(&json::rejected(engine.revision()).to_string());
            }
            say(&told!(common.lang.language(), "proposal-rejected"))
        }
    }
}

fn observe(common: &Common, args: &ObserveArgs) -> Result<Answer, Failure> {
    let mut engine = open_to_write(common)?;
    let thing = engine.thing(&args.name)?;
    let (surveyed, area) = (thing.frame, thing.area);
    let seen = args.at.as_ref().map(|Numbers(at)| {
        let number = |i: usize, default: f64| at.get(i).copied().unwrap_or(default);
        let angle = args.angle.map_or(surveyed.angle, Deg::of);
        let z = number(2, surveyed.z.get());
        (args.area.as_deref(), Frame::new(number(0, 0.0), number(1, 0.0), z, angle))
    });
    let at = args.when.unwrap_or_else(now);
    match &args.pose {
        Some(Numbers(pose)) => {
            let number = |i: usize, default: f64| pose.get(i).copied().unwrap_or(default);
            let on_map = engine.on_map(&Seen { area, frame: surveyed })?;
            let before = on_map.map_or(surveyed, |(_, frame)| frame);
            let angle = args.angle.map_or(before.angle, Deg::of);
            let frame =
                Frame::new(number(0, 0.0), number(1, 0.0), number(2, before.z.get()), angle);
            let place = (args.map.as_deref(), frame);
            engine.observe_on_map(&args.name, place, args.sure, &common.user, at)?;
        }
        None => engine.observe(&args.name, seen, args.sure, &common.user, at)?,
    }
    let found = engine.where_is(&args.name, at)?;
    if common.json {
        say(&json::believed(&engine, &found)?.to_string())
    } else {
        say(&told(&engine, &found, common.lang)?)
    }
}

fn proposals(common: &Common) -> Result<Answer, Failure> {
    let engine = open(common)?;
    let all = engine.proposals(now())?;
    if common.json {
        return say(&json::proposals(&engine, &all)?.to_string());
    }
    if all.is_empty() {
        return say(&told!(common.lang.language(), "no-proposals"));
    }
    let lines = all.iter().map(|p| told(&engine, p, common.lang)).collect::<Result<Vec<_>, _>>()?;
    say(&lines.join("\n"))
}

fn place(engine: &Engine, seen: &Seen, lang: Lang) -> Result<String, Failure> {
    let area = engine.world()?.areas.get(&seen.area);
    let area = area.map_or("?", |a| spoken(&a.name, &a.name_en, lang));
    let [x, y] = [seen.frame.x, seen.frame.y].map(|at| Lengths::said().number(at.get(), 0));
    Ok(format!("{area} ({x}; {y})"))
}

fn told(engine: &Engine, found: &Believed, lang: Lang) -> Result<String, Failure> {
    let b = &found.belief;
    let replica = engine.uncarried()?.replicas.get(&found.replica);
    let replica = replica.or(engine.world()?.replicas.get(&found.replica));
    let name = replica.map_or(found.name.as_str(), |r| spoken(&r.name, &r.name_en, lang));
    match found.carried.as_deref() {
        Some("") => return Ok(told!(lang.language(), "in-the-robots-hand", name)),
        Some(who) => return Ok(told!(lang.language(), "handed-to", name, who)),
        None => {}
    }
    let sure = (b.confidence * 100.0).round();
    let here = place(engine, &b.place, lang)?;
    let since = b.since.in_words();
    let missed = b.missed.map(|at| told!(lang.language(), "missed", at = at.in_words()));
    let missed = missed.unwrap_or_default();
    let map = match &found.surveyed {
        _ if b.is_surveyed => told!(lang.language(), "as-on-the-map"),
        Some(surveyed) => {
            format!("{} {}", told!(lang.language(), "on-the-map"), place(engine, surveyed, lang)?)
        }
        None => told!(lang.language(), "not-on-the-map"),
    };
    Ok(told!(lang.language(), "believed-at", name, here, since, sure, map, missed))
}

fn story(common: &Common, name: &str) -> Result<Answer, Failure> {
    let engine = open(common)?;
    if common.json {
        return say(&json::story(&engine, name)?.to_string());
    }
    let stations = engine.story_of(name)?;
    let mut lines = Vec::new();
    for station in &stations {
        let here = match &station.place {
            Some(seen) => place(&engine, seen, common.lang)?,
            None => told!(common.lang.language(), "not-there"),
        };
        let source = match &station.source {
            Source::Map { revision, user } => {
                told!(common.lang.language(), "source-map", revision, user)
            }
            Source::Seen { observer, sure } => {
                let sure = format!("{:.0}", sure * 100.0);
                told!(common.lang.language(), "source-seen", observer, sure)
            }
        };
        lines.push(format!("{}  {here} – {source}", station.at.in_words()));
    }
    say(&lines.join("\n"))
}
