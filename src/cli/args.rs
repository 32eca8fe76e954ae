//! The arguments of `ortho`.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::{Duration, Instant};

use clap::{ArgAction, Args, Parser, Subcommand, ValueEnum};

use crate::engine::{ImportFormat, Sighted, When};
use crate::graphplan::Limits;
use crate::map::Profile;
use crate::robot::Wanted;
use crate::units::{Bilingual, Language, Timestamp};

use super::differences::DifferencesArgs;
use super::draw::DrawArgs;
use super::edit::EditArgs;
use super::lengths::Lengths;
use super::locate::LocateArgs;
use super::map_from::MapFromArgs;
use super::observe::ObserveCommand;
use super::see::SeeArgs;
use super::store::StoreCommand;
use super::vehicle::{SimulateArgs, VehicleArgs};

/// Embedded knowledge base and logic engine for robots that work inside buildings.
#[derive(Debug, Parser)]
#[command(name = "ortho", version, propagate_version = true)]
#[command(
    after_help = "Exit codes: 0 done, 1 the answer is no (no plan, no route), 2 the input is wrong, 3 the disk, the vehicle or the program is at fault, 130 a task was stopped by Ctrl-C."
)]
pub(super) struct Arguments {
    #[command(flatten)]
    pub common: Common,
    #[command(subcommand)]
    pub command: Command,
}

/// What every command takes.
#[derive(Debug, Clone, Args)]
pub(super) struct Common {
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
    /// Of lengths in arguments and of points in what is told; in JSON and in files they are cm. A number may bear its own: 2.5m
    #[arg(
        long,
        global = true,
        value_enum,
        default_value = "cm",
        hide_default_value = true,
        value_name = "UNIT"
    )]
    pub units: Lengths,
    /// Tell on standard error what is done inside and how long it takes; -vv and -vvv tell more
    #[arg(short, long, global = true, action = ArgAction::Count)]
    pub verbose: u8,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Color {
    Auto,
    Always,
    Never,
}

/// A laser's log, taken on a map.
#[derive(Debug, Args)]
pub(super) struct LogOnMap {
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
pub(super) enum Lang {
    Ru,
    En,
}

impl Lang {
    /// By the first of `LC_ALL`, `LC_MESSAGES` and `LANG` that is set, as POSIX has it; `C` names no language.
    pub(super) fn of_locale() -> Option<Self> {
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
pub(super) fn moment(text: &str) -> Result<Timestamp, String> {
    text.parse().map_err(|_no_time| "a time is written 2026-11-21T09:30:00.000Z".to_owned())
}

/// A point of the history.
pub(super) fn when(text: &str) -> Result<When, String> {
    text.parse().map_err(|why: Bilingual| why.say(Language::English).to_owned())
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
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
    /// Import a building into the store: a map file, or a foreign format (docs/import.md)
    Import(ImportArgs),
    /// Write the map in other programs' formats (docs/export.md)
    Export(ExportArgs),
    /// Check a map file; all faults at once, with line and column, and what reads well and cannot be
    Check {
        file: PathBuf,
        /// Warnings are errors
        #[arg(long)]
        strict: bool,
    },
    /// Edit the map: one step, or a file of steps; checked as a whole, one transaction, can be undone
    Edit(EditArgs),
    /// JSON Schema of the map file, for editors
    Schema {
        /// That of the vehicle protocol instead (docs/vehicle.md)
        #[arg(long)]
        vehicle: bool,
    },
    /// The relations derived from the map
    Relations {
        /// Only this relation, by its Russian or English name
        #[arg(long, value_name = "NAME")]
        name: Option<String>,
        /// Only facts about this thing, room or door
        #[arg(long, value_name = "NAME")]
        of: Option<String>,
    },
    /// Why a relation holds, down to what was measured: ortho why "ON_TOP_OF(Чашка-1, Стол-1)"
    Why {
        /// RELATION(name, name)
        fact: String,
        /// Ask why it does not hold: the nearest rule and the premise that failed, with its numbers
        #[arg(long)]
        not: bool,
    },
    /// Ask in the rules' language: ortho query '?- ON_TOP_OF(X, Y), CONTAINS("Комната-А", Y)' (docs/rules.md)
    Query(QueryArgs),
    /// Plan a scenario of a rule file, or a PDDL problem; or the facts that the map gives to planning
    Plan(PlanArgs),
    /// Write the built-in rule files into a directory, to be edited and read with --rules; or put rule files into one form
    Rules {
        #[arg(long, value_name = "DIR", required_unless_present = "format")]
        export: Option<PathBuf>,
        /// Overwrite files that are there
        #[arg(long, requires = "export")]
        force: bool,
        /// Datalog files (.dl) to be put into the usual form: blanks, indents, empty lines; the words stay
        #[arg(long, value_name = "FILE", num_args = 1.., conflicts_with = "export")]
        format: Vec<PathBuf>,
    },
    /// Carry out a task given in words, or a scenario, in the simulator or with a robot: ortho do "Принеси лекарство"
    Do(DoArgs),
    /// Offer the simulated robot, in the world of a map file, by the vehicle protocol (docs/vehicle.md)
    Simulate(SimulateArgs),
    /// Answer a question in words: ortho ask "Где лекарство?"
    Ask(AskArgs),
    /// Check a map file and draw it again whenever it, or a rule file, has changed
    Watch {
        map: PathBuf,
        /// The drawing, as PNG where its name ends so, else as SVG; beside the map when absent
        #[arg(short, long, value_name = "FILE")]
        out: Option<PathBuf>,
    },
    /// What completes commands in a shell, on standard output: ortho completions bash > /etc/bash_completion.d/ortho
    Completions { shell: clap_complete::Shell },
    /// Write the manual pages of all commands into a folder
    Man { dir: PathBuf },
    /// A dialogue: questions and commands, a line each, with what was said before kept in mind
    Talk(RecordArgs),
    /// Tell a recording of "do --record" again: what was said, or with --json what happened
    Replay(ReplayArgs),
    /// Rule files under an editor: the Language Server Protocol over standard streams, for .dl and .strips
    LanguageServer,
    /// All forms of a name, Russian and English, and where they come from: ortho words "Письменный стол"
    Words { name: String },
    /// The shortest drivable way between two places, rooms, doors or things
    Route {
        #[arg(long, value_name = "PLACE", allow_hyphen_values = true)]
        from: String,
        #[arg(long, value_name = "PLACE", allow_hyphen_values = true)]
        to: String,
        /// How the way is found
        #[arg(long, value_enum, default_value_t = RouteMethod::Shortest)]
        method: RouteMethod,
        /// Say the way in sentences: rooms alone, doors and turns, or every stretch
        #[arg(long, value_enum, value_name = "DETAIL", num_args = 0..=1, default_missing_value = "normal")]
        words: Option<Detail>,
    },
    /// Directions through corridors by counting entrances (paper 4)
    Corridor(CorridorArgs),
    /// What a robot saw: segments of a scan or a picture, things of a log, what changed (paper 3)
    See(SeeArgs),
    /// Where the scans of a log can have been taken, by what the map has at the laser's height
    Locate(LocateArgs),
    /// What the scans of a log see that the map has otherwise: things, doors, obstacles
    Differences(DifferencesArgs),
    /// A map file of the walls that a log with known poses saw
    MapFrom(MapFromArgs),
    /// Run a Datalog program in Soufflé's dialect
    Datalog {
        program: PathBuf,
        /// Directory of the .facts files
        #[arg(short = 'F', long, default_value = ".", value_name = "DIR")]
        facts: PathBuf,
        /// Directory for the .csv files
        #[arg(short = 'D', long, default_value = ".", value_name = "DIR")]
        output: PathBuf,
        /// Give up after this many seconds; 600 when left out
        #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
        time_limit: Option<Duration>,
        /// Give up when what is derived takes more memory than this, MiB; 2048 when left out
        #[arg(long, value_name = "MIB")]
        memory_limit: Option<usize>,
        /// Give up when a relation has more rows than this; 134217728 when left out
        #[arg(long, value_name = "ROWS")]
        row_limit: Option<usize>,
        /// Divide large joins among so many threads, with the same result; all cores when left out
        #[arg(long, value_name = "N")]
        threads: Option<NonZeroUsize>,
        /// Show for each rule the joins chosen, the sizes met and the time taken, the longest first
        #[arg(long)]
        explain: bool,
    },
    /// Where the robot stands, or where a pose is, in words
    Where {
        /// The map; may be left out when the store has only one
        #[arg(long, value_name = "NAME")]
        map: Option<String>,
        /// Pose on the map, cm and degrees; the robot's when left out
        #[arg(long, value_name = "X,Y[,HEADING]", allow_hyphen_values = true)]
        at: Option<String>,
        /// How much to say: the room, the spot, the heading too
        #[arg(long, value_enum)]
        detail: Option<Detail>,
        /// Read a report back: the region of which it is true, and whether the pose lies in it
        #[arg(long, value_name = "TEXT")]
        read: Option<String>,
    },
    #[command(flatten)]
    Observe(ObserveCommand),
    #[command(flatten)]
    Store(StoreCommand),
    /// The operator's console in the browser: the map, the robot on it live, talk, tasks, history and editing
    #[cfg(feature = "serve")]
    Serve(super::serve::ServeArgs),
    /// The map and the robot for an assistant, by the Model Context Protocol on the standard streams (docs/assistants.md)
    #[cfg(feature = "serve")]
    Mcp(super::serve::McpArgs),
    /// Draw as SVG or PNG: a map or room, its floor, an Object, a route, the view from a pose
    Draw(DrawArgs),
}

impl Command {
    /// What a person said to the robot with this command.
    pub(super) fn words(&self) -> Option<&str> {
        match self {
            Self::Ask(args) => Some(&args.question),
            Self::Do(args) => args.task.as_deref(),
            _ => None,
        }
    }

    /// It speaks only when it is done, which may take a while.
    pub(super) fn may_be_silent(&self) -> bool {
        #[cfg(feature = "serve")]
        let serves = matches!(self, Self::Serve(_) | Self::Mcp(_));
        #[cfg(not(feature = "serve"))]
        let serves = false;
        !serves
            && !matches!(
                self,
                Self::Simulate(_)
                    | Self::Watch { .. }
                    | Self::Talk(_)
                    | Self::Replay(_)
                    | Self::LanguageServer
            )
    }
}

/// How much is said of a place or a way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum Detail {
    Brief,
    Normal,
    Full,
}

impl Detail {
    pub(super) fn level(self) -> crate::language::report::Detail {
        use crate::language::report::Detail as Level;
        match self {
            Self::Brief => Level::Region,
            Self::Normal => Level::Spot,
            Self::Full => Level::Heading,
        }
    }
}

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

/// Who else is told of a drive.
#[derive(Debug, Clone, Args)]
pub(super) struct RecordArgs {
    /// Record all that happens in this MCAP file, in place of what is there: for Foxglove, Lichtblick and ortho replay
    #[arg(long, value_name = "FILE.mcap")]
    pub record: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub(super) struct ReplayArgs {
    /// A recording of "do --record"
    pub file: PathBuf,
    /// So many times as fast as it happened; at once when left out
    #[arg(long, value_name = "TIMES", value_parser = super::vehicle::pace)]
    pub pace: Option<f64>,
}

#[derive(Debug, Args)]
pub(super) struct AskArgs {
    /// The question, in Russian or English
    pub question: String,
    /// Show the query as a Datalog rule, and the proof of what the answer rests on
    #[arg(long)]
    pub explain: bool,
}

#[derive(Debug, Args)]
pub(super) struct QueryArgs {
    /// `?- premises`, or `name(X, …) :- premises`; declarations and rules of its own may stand before it
    pub question: String,
    /// Why each answer is one, down to what was measured
    #[arg(long)]
    pub explain: bool,
    /// Give up after this many seconds; 600 when left out
    #[arg(long, value_name = "SECONDS", value_parser = parse_seconds)]
    pub time_limit: Option<Duration>,
    /// Give up when what is derived takes more memory than this, MiB; 2048 when left out
    #[arg(long, value_name = "MIB")]
    pub memory_limit: Option<usize>,
    /// Give up when a relation has more rows than this; 134217728 when left out
    #[arg(long, value_name = "ROWS")]
    pub row_limit: Option<usize>,
}

#[derive(Debug, Args)]
pub(super) struct CorridorArgs {
    /// Corridor file (TOML), e.g. maps/corridor-paper4.toml; the store's maps when it and --map are left out
    pub file: Option<PathBuf>,
    /// A map of the store, or a map file
    #[arg(long, conflicts_with = "file", value_name = "MAP")]
    pub map: Option<String>,
    /// Room where the robot stands, or #N for a vertex
    #[arg(long, value_name = "ROOM")]
    pub from: String,
    /// The arc driven last, by its vertices; without it the heading is unknown
    #[arg(long, value_name = "N,N", value_parser = parse_arc)]
    pub last: Option<(u32, u32)>,
    /// Room to go to
    #[arg(long, value_name = "ROOM")]
    pub to: String,
    /// The paper's first or second road graph
    #[arg(long, default_value_t = 1, value_parser = clap::value_parser!(u8).range(1..=2))]
    pub variant: u8,
    /// Count metres instead of arcs, where the map knows them
    #[arg(long)]
    pub metres: bool,
}

fn parse_arc(text: &str) -> Result<(u32, u32), String> {
    let numbers: Vec<u32> = text
        .split(',')
        .map(|n| n.trim().parse::<u32>().map_err(|e| format!("{n}: {e}")))
        .collect::<Result<_, _>>()?;
    match numbers[..] {
        [from, to] => Ok((from, to)),
        _ => Err("two vertex numbers are wanted, such as 1,0".to_owned()),
    }
}

#[derive(Debug, Args)]
pub(super) struct ExportArgs {
    /// The whole map as a map file: TOML, YAML or JSON by its ending
    #[arg(required_unless_present_any = EXPORTS)]
    pub file: Option<PathBuf>,
    /// All floors as GeoJSON in metres: rooms, openings, furniture, places
    #[arg(long, value_name = "FILE")]
    pub geojson: Option<PathBuf>,
    /// Floors for ROS map_server: a PGM picture and a YAML file each
    #[arg(long, value_name = "DIR")]
    pub ros: Option<PathBuf>,
    /// The route graph for Nav2's route server, GeoJSON: of all storeys, or of --floor
    #[arg(long, value_name = "FILE")]
    pub nav2: Option<PathBuf>,
    /// Passframes as triangles, Wavefront OBJ: of all storeys, or of --floor
    #[arg(long, value_name = "FILE")]
    pub mesh: Option<PathBuf>,
    /// Zones that are in force now, as keep-out and speed masks for Nav2: a PGM picture and YAML files each
    #[arg(long, value_name = "DIR")]
    pub masks: Option<PathBuf>,
    /// Beside each picture of --ros one of what a laser meets at this height above the map's zero
    #[arg(long, value_name = "CM", requires = "ros", value_parser = parse_height)]
    pub laser: Option<f64>,
    /// All tables of the store with all that ever stood in them, JSON
    #[arg(long, value_name = "FILE")]
    pub records: Option<PathBuf>,
    /// The tables of the store in a new SQLite file
    #[cfg(feature = "sqlite")]
    #[arg(long, value_name = "FILE")]
    pub sqlite: Option<PathBuf>,
    /// Only this map
    #[arg(long, value_name = "NAME")]
    pub floor: Option<String>,
    /// Size of a cell of --ros and --masks, cm
    #[arg(long, value_name = "CM", default_value_t = 5.0, value_parser = parse_cell)]
    pub cell: f64,
}

#[cfg(feature = "sqlite")]
const EXPORTS: [&str; 7] = ["geojson", "ros", "nav2", "mesh", "masks", "records", "sqlite"];
#[cfg(not(feature = "sqlite"))]
const EXPORTS: [&str; 6] = ["geojson", "ros", "nav2", "mesh", "masks", "records"];

fn parse_cell(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(cell) if (0.5..=100.0).contains(&cell) => Ok(cell),
        _ => Err("a size from 0.5 to 100 cm is wanted".to_owned()),
    }
}

fn parse_height(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(height) if (0.0..=10_000.0).contains(&height) => Ok(height),
        _ => Err("a height from 0 to 10000 cm is wanted".to_owned()),
    }
}

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

fn parse_seconds(text: &str) -> Result<Duration, String> {
    let seconds: Result<f64, _> = text.trim().parse();
    let duration = seconds.ok().and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    duration.ok_or_else(|| "a number of seconds is wanted, such as 30 or 0.5".to_owned())
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
        Limits { deadline, memory_bytes, effort, ..all }
    }
}

#[derive(Debug, Clone, Args)]
pub(super) struct ImportArgs {
    pub file: PathBuf,
    /// Refuse the file when anything in it has to be mended or left out
    #[arg(long)]
    pub strict: bool,
    /// The file's format; recognised by its name and content when absent
    #[arg(long, value_name = "FORMAT", value_parser = import_format)]
    pub format: Option<ImportFormat>,
    /// Sizes of models, for formats that keep them in a second file; looked for beside the file when absent
    #[arg(long, value_name = "FILE")]
    pub assets: Option<PathBuf>,
    /// Synonym table laid over the built-in one; `import-synonyms.toml` of the rules directory when absent
    #[arg(long, value_name = "FILE")]
    pub synonyms: Option<PathBuf>,
    /// How exactly the things were measured, "surveyed" or "detected"; by what the file shows when absent
    #[arg(long, value_name = "PROFILE", value_parser = profile)]
    pub profile: Option<Profile>,
    /// The file is a picture of a floor plan (PNG, PGM), dark walls on white, and a pixel of it so many cm
    #[arg(long, value_name = "CM", value_parser = pixel, conflicts_with_all = ["format", "assets"])]
    pub pixel: Option<f64>,
    /// The file is an SQLite base of the store's tables, as `ortho export --sqlite` writes it
    #[cfg(feature = "sqlite")]
    #[arg(long, conflicts_with_all = ["strict", "format", "assets", "synonyms", "profile", "pixel"])]
    pub sqlite: bool,
}

fn profile(name: &str) -> Result<Profile, String> {
    Profile::named(name)
        .ok_or_else(|| format!("one of: {}", Profile::ALL.map(Profile::name).join(", ")))
}

fn pixel(text: &str) -> Result<f64, String> {
    let pixel = text.parse::<f64>().ok().filter(|pixel| (0.1..=1000.0).contains(pixel));
    pixel.ok_or_else(|| "a number of centimetres from 0.1 to 1000 is wanted, such as 2".to_owned())
}

fn import_format(key: &str) -> Result<ImportFormat, String> {
    ImportFormat::named(key).ok_or_else(|| format!("one of: {}", ImportFormat::keys().join(", ")))
}

#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub(super) enum RouteMethod {
    /// The shortest way that keeps the robot's clearance
    Shortest,
    /// Depth-first over Passframes, midpoints of their borders (paper 1 §8)
    Paper,
}
