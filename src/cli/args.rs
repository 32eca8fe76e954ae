//! The arguments of `ortho`.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::{Args, Parser, Subcommand, ValueEnum};

use crate::graphplan::Limits;

/// Embedded knowledge base and logic engine for robots that work inside buildings.
#[derive(Debug, Parser)]
#[command(name = "ortho", version, propagate_version = true)]
#[command(
    after_help = "Exit codes: 0 done, 1 the answer is no (no plan, no route), 2 the input is wrong, 3 internal error."
)]
pub struct Arguments {
    #[command(flatten)]
    pub common: Common,
    #[command(subcommand)]
    pub command: Command,
}

/// What every command takes.
#[derive(Debug, Clone, Args)]
pub struct Common {
    /// Store directory
    #[arg(long, global = true, env = "ORTHO_STORE", value_name = "DIR")]
    pub store: Option<PathBuf>,
    /// Directory of rule files; `./rules` when there is one, else the rules built in
    #[arg(long, global = true, env = "ORTHO_RULES", value_name = "DIR")]
    pub rules: Option<PathBuf>,
    /// Print the value behind the words as JSON (see docs/cli.md)
    #[arg(long, global = true)]
    pub json: bool,
    /// Language of reports and headings
    #[arg(long, global = true, value_enum, default_value_t = Lang::Ru)]
    pub lang: Lang,
    /// Who makes the change, for the history
    #[arg(
        long,
        global = true,
        env = "ORTHO_USER",
        default_value = "operator",
        value_name = "NAME"
    )]
    pub user: String,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Lang {
    Ru,
    En,
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// The whole way once: import the rb2 map, derive, plan "Принеси лекарство", drive, report, draw
    Demo {
        /// Store directory to use and keep; a temporary one when absent
        dir: Option<PathBuf>,
        /// Map file
        #[arg(long, value_name = "FILE")]
        map: Option<PathBuf>,
        /// What the robot is told to do
        #[arg(long, default_value = "Принеси лекарство", value_name = "TEXT")]
        task: String,
        /// Directory for the drawing
        #[arg(long, default_value = "demo", value_name = "DIR")]
        out: PathBuf,
    },
    /// Check a map file and import it into the store
    Import { file: PathBuf },
    /// Check a map file; all faults at once, with line and column
    Check { file: PathBuf },
    /// JSON Schema of the map file, for editors
    Schema,
    /// The relations derived from the map
    Relations {
        /// Only this relation, by its Russian or English name
        #[arg(long, value_name = "NAME")]
        name: Option<String>,
        /// Only facts about this thing, room or door
        #[arg(long, value_name = "NAME")]
        of: Option<String>,
    },
    /// Plan a scenario of a rule file, or a PDDL problem
    Plan(PlanArgs),
    /// Carry out a task given in words, in the simulator: ortho do "Принеси лекарство"
    Do {
        task: String,
        /// Write the plan drawing here
        #[arg(long, value_name = "FILE")]
        draw: Option<PathBuf>,
    },
    /// The shortest drivable way between two places, rooms, doors or things
    Route {
        #[arg(long, value_name = "PLACE", allow_hyphen_values = true)]
        from: String,
        #[arg(long, value_name = "PLACE", allow_hyphen_values = true)]
        to: String,
        /// How the way is found
        #[arg(long, value_enum, default_value_t = RouteMethod::Shortest)]
        method: RouteMethod,
    },
    /// Where a pose is, in words
    Where {
        /// The map; may be left out when the store has only one
        #[arg(long, value_name = "NAME")]
        map: Option<String>,
        /// Pose on the map, cm and degrees
        #[arg(long, value_name = "X,Y[,HEADING]", allow_hyphen_values = true)]
        at: String,
    },
    /// Draw as SVG
    Draw {
        #[command(subcommand)]
        what: Drawing,
        /// File to write; standard output when absent
        #[arg(short, long, global = true, value_name = "FILE")]
        out: Option<PathBuf>,
    },
}

#[derive(Debug, Args)]
pub struct PlanArgs {
    /// Scenario file (.strips)
    #[arg(required_unless_present = "problem")]
    pub scenario: Option<PathBuf>,
    /// PDDL domain file
    #[arg(long, requires = "problem", value_name = "FILE")]
    pub domain: Option<PathBuf>,
    /// PDDL problem file
    #[arg(long, requires = "domain", conflicts_with = "scenario", value_name = "FILE")]
    pub problem: Option<PathBuf>,
    /// Write the plan here, in the format that plan validators read
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
    /// Give up after this many seconds
    #[arg(long, value_name = "SECONDS")]
    pub time_limit: Option<u64>,
}

impl PlanArgs {
    pub fn limits(&self) -> Limits {
        let deadline =
            self.time_limit.and_then(|s| Instant::now().checked_add(Duration::from_secs(s)));
        Limits { deadline, ..Limits::default() }
    }
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum RouteMethod {
    /// The shortest way that keeps the robot's clearance
    Shortest,
    /// Depth-first over Passframes, midpoints of their borders (paper 1 §8)
    Paper,
}

#[derive(Debug, Subcommand)]
pub enum Drawing {
    /// Rooms, doors, furniture
    Map {
        /// The map; may be left out when there is only one
        name: Option<String>,
    },
    /// The map with free floor, dead zones and Passframes
    Floor { name: Option<String> },
    /// The map with a route
    Route {
        #[arg(long, value_name = "PLACE", allow_hyphen_values = true)]
        from: String,
        #[arg(long, value_name = "PLACE", allow_hyphen_values = true)]
        to: String,
    },
}
