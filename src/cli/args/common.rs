//! What every command takes, and what several do.

use std::path::PathBuf;
use std::time::Duration;

use clap::builder::{PossibleValuesParser, TypedValueParser as _};
use clap::{ArgAction, Args, ValueEnum};

use crate::engine::{Sighted, When};
use crate::units::{Bilingual, Language, Lengths, Timestamp};

/// What every command takes.
#[derive(Debug, Clone, Args)]
pub(in crate::cli) struct Common {
    /// Store directory
    #[arg(long, global = true, env = "ORTHO_STORE", value_name = "DIR")]
    pub store: Option<PathBuf>,
    /// Directory of rule files; `./rules` when there is one, else the rules built in
    #[arg(long, global = true, env = "ORTHO_RULES", value_name = "DIR")]
    pub rules: Option<PathBuf>,
    /// Print the value behind the words as JSON (see docs/cli.md)
    #[arg(long, global = true)]
    pub json: bool,
    /// Language of all that is told; that of the locale when left out, then that of the order or question, then Russian
    #[arg(
        long,
        global = true,
        value_enum,
        env = "ORTHO_LANG",
        default_value_t = Lang::of_locale().unwrap_or(Lang::Ru),
        hide_default_value = true
    )]
    pub lang: Lang,
    /// Open the store for reading only, without touching it; another program may be writing it
    #[arg(long, global = true)]
    pub read_only: bool,
    /// Answer from the map as it stood then: a revision or a moment (3, 2026-11-21, 2026-11-21T09:30)
    #[arg(long, global = true, value_name = "WHEN", value_parser = when)]
    pub as_of: Option<When>,
    /// Who makes the change, for the history
    #[arg(
        long,
        global = true,
        env = "ORTHO_USER",
        default_value = "operator",
        value_name = "NAME"
    )]
    pub user: String,
    /// Settings; ./ortho.toml when there is one, else ortho/ortho.toml in the folder for settings ($XDG_CONFIG_HOME, ~/.config)
    #[arg(long, global = true, env = "ORTHO_CONFIG", value_name = "FILE")]
    pub config: Option<PathBuf>,
    /// Colours of faults: on a terminal where NO_COLOR is not set, always, or never
    #[arg(
        long,
        global = true,
        value_enum,
        default_value = "auto",
        hide_default_value = true,
        value_name = "WHEN"
    )]
    pub color: Color,
    /// Of lengths in arguments and in what is told; in JSON and in files they are cm. A number may bear its own: 2.5m
    #[arg(
        long,
        global = true,
        default_value = "cm",
        hide_default_value = true,
        value_name = "UNIT",
        value_parser = PossibleValuesParser::new(["cm", "m"]).map(|unit| if unit == "m" { Lengths::M } else { Lengths::Cm })
    )]
    pub units: Lengths,
    /// Tell on standard error what is done inside and how long it takes; -vv and -vvv tell more
    #[arg(short, long, global = true, action = ArgAction::Count)]
    pub verbose: u8,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Color {
    Auto,
    Always,
    Never,
}

/// A laser's log, taken on a map.
#[derive(Debug, Args)]
pub(in crate::cli) struct LogOnMap {
    /// A log (CARMEN, rows of ranges, Breezy; also gzipped)
    pub log: PathBuf,
    /// The map; may be left out when the store has only one
    #[arg(long, value_name = "NAME")]
    pub map: Option<String>,
    /// Of the laser above the map's zero
    #[arg(long, value_name = "CM", default_value_t = Sighted::LASER_HEIGHT)]
    pub height: f64,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Lang {
    Ru,
    En,
}

impl Lang {
    /// By the first of `LC_ALL`, `LC_MESSAGES` and `LANG` that is set, as POSIX has it; `C` names no language.
    pub(in crate::cli) fn of_locale() -> Option<Self> {
        let set = |name| std::env::var(name).ok().filter(|value| !value.is_empty());
        let locale = ["LC_ALL", "LC_MESSAGES", "LANG"].into_iter().find_map(set)?;
        match locale.split(['_', '.', '@', '-']).next() {
            Some("en") => Some(Self::En),
            Some("ru") => Some(Self::Ru),
            _ => None,
        }
    }
}

/// A moment.
pub(in crate::cli) fn moment(text: &str) -> Result<Timestamp, String> {
    text.parse().map_err(|_no_time| "a time is written 2026-11-21T09:30:00.000Z".to_owned())
}

/// A point of the history.
pub(in crate::cli) fn when(text: &str) -> Result<When, String> {
    text.parse().map_err(|why: Bilingual| why.say(Language::English).to_owned())
}

/// How much is said of a place or a way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum Detail {
    Brief,
    Normal,
    Full,
}

impl Detail {
    pub(in crate::cli) fn level(self) -> crate::language::report::Detail {
        use crate::language::report::Detail as Level;
        match self {
            Self::Brief => Level::Region,
            Self::Normal => Level::Spot,
            Self::Full => Level::Heading,
        }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(in crate::cli) enum RouteMethod {
    /// The shortest way that keeps the robot's clearance
    Shortest,
    /// Depth-first over Passframes, midpoints of their borders (paper 1 §8)
    Paper,
}

pub(in crate::cli) fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds: Result<f64, _> = text.trim().parse();
    let duration = seconds.ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    duration.ok_or_else(|| "a number of seconds is wanted, such as 30 or 0.5".to_owned())
}
