//! The arguments of `ortho`.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, Subcommand};

use crate::engine::ImportFormat;
use crate::map::Profile;

mod common;

pub(super) use common::{
    Color, Common, Detail, Lang, LogOnMap, RouteMethod, moment, parse_seconds, when,
};

use super::commands::DoArgs;
use super::corridor::CorridorArgs;
use super::differences::DifferencesArgs;
use super::draw::DrawArgs;
use super::edit::EditArgs;
use super::locate::LocateArgs;
use super::map_from::MapFromArgs;
use super::observe::ObserveCommand;
use super::plan::PlanArgs;
use super::see::SeeArgs;
use super::store::StoreCommand;
use super::teller::RecordArgs;
use super::vehicle::SimulateArgs;

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

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// The whole way once: import the rb2 map, derive, plan "Bring the medicine", drive, report, draw
    Demo {
        /// Store directory to use and keep; a temporary one when absent
        dir: Option<PathBuf>,
        /// Map file
        #[arg(long, value_name = "FILE")]
        map: Option<PathBuf>,
        /// What the robot is told to do; to bring the medicine when left out
        #[arg(long, value_name = "TEXT")]
        task: Option<String>,
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
    /// Why a relation holds, down to what was measured: ortho why "ON_TOP_OF(Cup 1, Table 1)"
    Why {
        /// RELATION(name, name)
        fact: String,
        /// Ask why it does not hold: the nearest rule and the premise that failed, with its numbers
        #[arg(long)]
        not: bool,
    },
    /// Ask in the rules' language: ortho query '?- ON_TOP_OF(X, Y), CONTAINS("Room V", Y)' (docs/rules.md)
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
    /// Carry out a task given in words, or a scenario, in the simulator or with a robot: ortho do "Bring the medicine"
    Do(DoArgs),
    /// Offer the simulated robot, in the world of a map file, by the vehicle protocol (docs/vehicle.md)
    Simulate(SimulateArgs),
    /// Answer a question in words: ortho ask "Where is the medicine?"
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
    /// All forms of a name, Russian and English, and where they come from: ortho words "Desk"
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

    /// Who asks may be a program or sit elsewhere, and is told lengths in cm, as the page and the tools say.
    pub(super) fn serves(&self) -> bool {
        #[cfg(feature = "serve")]
        let serves = matches!(self, Self::Serve(_) | Self::Mcp(_));
        #[cfg(not(feature = "serve"))]
        let serves = false;
        serves
    }

    /// It speaks only when it is done, which may take a while.
    pub(super) fn may_be_silent(&self) -> bool {
        !self.serves()
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
