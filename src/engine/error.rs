//! Everything that can go wrong, gathered from the folders below, and what a person asked that has no answer.

use miette::Diagnostic;
use thiserror::Error;

use crate::corridor::{CorridorError, CorridorFileError};
use crate::exchange::ImportError;
use crate::facts::{AskError, FilesError};
use crate::language::Language;
use crate::language::command::Misheard;
use crate::language::names::named;
use crate::map::{Entity, MapErrors, World};
use crate::meaning::LangFaults;
use crate::robot::MissionError;
use crate::semantics::RelationError;
use crate::store::StoreError;
use crate::strips::RuleFaults;
use crate::units::{Bilingual, English, capitalized, is_input};
use crate::vectors::picture::PictureError;
use crate::vectors::read::LogError;

/// Why the engine could not do what it was asked.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum Error {
    #[error(transparent)]
    #[diagnostic(transparent)]
    Map(#[from] MapErrors),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Import(#[from] Box<ImportError>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Rules(#[from] RuleFaults),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Relations(#[from] RelationError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Language(#[from] Box<LangFaults>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Store(#[from] StoreError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Misheard(#[from] Misheard),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Corridor(#[from] CorridorError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    CorridorFile(#[from] CorridorFileError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Datalog(#[from] Box<FilesError>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Query(#[from] Box<AskError>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Log(#[from] Box<LogError>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Picture(#[from] PictureError),
    #[cfg(feature = "pictures")]
    #[error(transparent)]
    #[diagnostic(transparent)]
    Png(#[from] crate::draw::PngError),
    #[cfg(feature = "sqlite")]
    #[error(transparent)]
    #[diagnostic(transparent)]
    Sqlite(#[from] crate::exchange::SqliteError),
    #[cfg(feature = "recordings")]
    #[error(transparent)]
    #[diagnostic(transparent)]
    Recording(#[from] crate::recording::RecordingError),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Vehicle(#[from] Box<crate::robot::Failure>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Mission(Box<MissionError>),
    #[error(transparent)]
    #[diagnostic(transparent)]
    Request(#[from] RequestError),
}

impl From<ImportError> for Error {
    fn from(error: ImportError) -> Self {
        match error {
            ImportError::Map(faults) => Self::Map(faults),
            error => Self::Import(Box::new(error)),
        }
    }
}

impl From<MissionError> for Error {
    fn from(error: MissionError) -> Self {
        match error {
            MissionError::Rules(faults) => Self::Rules(faults),
            MissionError::Relations(error) => Self::Relations(error),
            error => Self::Mission(Box::new(error)),
        }
    }
}

/// A request that speaks of what is not there, or not clearly enough.
#[derive(Debug, crate::units::Fault)]
#[fault(engine)]
#[non_exhaustive]
pub enum RequestError {
    /// A number that a drawing cannot take.
    #[fault(code = "draw::out_of_range")]
    OutOfRange { what: &'static str, value: f64, low: f64, high: f64 },

    /// A scan that the log does not have.
    #[fault(code = "see::no_scan")]
    NoScan { scan: usize, count: usize },

    /// A picture, where scans are needed.
    #[fault(code = "locate::no_log")]
    NoLog,

    /// A scan that tells no odometry cannot be followed.
    #[fault(code = "locate::no_odometry")]
    NoOdometry { line: usize },

    /// A scan whose pose is to be taken from the log has none there.
    #[fault(code = "locate::no_pose")]
    NoPose { line: usize },

    /// Scans cannot be laid beside one another.
    #[fault(code = "see::no_poses")]
    NoPoses { count: usize },

    /// Built without pictures.
    #[fault(code = "draw::no_png")]
    NoPng,

    /// Several storeys, and one place to draw them.
    #[fault(code = "draw::many_sheets")]
    ManySheets { count: usize },

    /// A file that no drawing can become.
    #[fault(code = "draw::format")]
    DrawingFormat { ending: String },

    /// There is nothing of which a plan could be drawn.
    NoMaps,

    /// The store holds no map yet.
    NoMap { store: String },

    /// The history begins later.
    BeforeTheMap,

    /// A fact that does not read as one.
    Fact { text: String },

    /// A name that nothing bears.
    UnknownName { name: String, help: Option<Bilingual> },

    /// A name that several things bear, or that could be read in several ways.
    AmbiguousName { name: String, candidates: Bilingual },

    /// A relation that the rules do not declare.
    UnknownRelation { name: String, help: Option<Bilingual> },

    /// A thing is not where an order says that it is.
    NotThere { thing: Bilingual, place: Bilingual },

    /// Something that is no place to go to, or from.
    NotAPlace { name: Bilingual },

    /// Two places on different maps.
    OtherMap { from: String, to: String },

    /// A pose outside of every Area.
    Nowhere { at: String, map: Bilingual, extent: String },

    /// Coordinates that are none.
    BadPose { text: String, reason: Bilingual },

    /// A text that is no report of a position.
    NoReport { text: String, word: String },

    /// A report of a position that the map does not bear out.
    NoSuchPlace { reason: Bilingual },

    /// Which of several maps is meant.
    WhichMap { candidates: Bilingual },

    /// A side of a thing on which the robot has no place to stand.
    NoFloorThere { name: Bilingual },

    /// A point that was told by its coordinates, where the robot does not fit.
    NoFloorAt { at: String },

    /// A point that was told by its coordinates, where more than to go there was ordered.
    OnlyGoneTo { at: String },

    /// Something that is to be put where nothing is put: under a bed.
    NotPutThere { name: Bilingual },

    /// The time of a way is asked for, and the map does not tell where it leads.
    #[fault(code = "plan::untimed")]
    Untimed { names: Bilingual },

    /// A map that tells of no place where the robot charges.
    NoCharger,

    /// A map that does not tell where the robot begins.
    NoStart,

    /// A lift was called where there is none.
    NoLift,

    /// Something that is to be carried and is too large or stands fast.
    NotPortable { name: Bilingual },

    /// Something of which the map knows no inside: a table, or a bowl that it draws as a solid block.
    NotHollow { name: Bilingual },

    /// Something whose inside is behind doors that are shut.
    Shut { name: Bilingual },

    /// A thing that is behind doors that are shut.
    ShutIn { thing: Bilingual, container: Bilingual },

    /// Nothing in a room can take a thing.
    NoSpace { thing: Bilingual, area: Bilingual },

    /// Something that is to be opened and is locked, as furniture is without a key of the robot's.
    Locked { name: Bilingual },

    /// A task that waits was meant, and it is not said which.
    WhichQueued { waiting: usize },

    /// Something is to be thrown away, and nothing is there for that.
    NoBin { thing: Bilingual },

    /// Something that is to be opened or shut and is no door between rooms.
    NotADoor { name: Bilingual },

    /// A door that joins no two rooms of the map.
    LeadsOutside { name: Bilingual },

    /// A thing that is to be clean: rooms, and what bears things, are tidied.
    NotCleaned { name: Bilingual },

    /// A thing is to be cleared of what is kept on it.
    KeptThere { things: Vec<Bilingual>, name: Bilingual },

    /// Things are to be put away that lie where they are kept, each with that.
    AtHome { told: Bilingual },

    /// Several things that are to be taken, and put nowhere.
    OneHand { things: Vec<Bilingual> },

    /// Something that is to be switched and has no switch.
    NotADevice { name: Bilingual },

    /// Nobody knows where some things belong.
    Homeless { things: Vec<Bilingual>, count: usize },

    /// The place where a thing is kept is not on the map.
    NoHome { thing: Bilingual, home: String },

    /// A change of the map as it was.
    #[fault(code = "engine::past")]
    PastIsPast,

    /// Something that is asked after as a thing and is none.
    NotAThing { name: Bilingual },

    /// Something that is asked after as a room and is none.
    NotAnArea { name: Bilingual },

    /// A thing at a moment when the map did not have it.
    NotYet { name: Bilingual },

    /// A thing of which nothing else is believed than the map says.
    NothingProposed { name: Bilingual },

    /// The Map does not say where the robot is.
    RobotNowhere,

    /// A truth that stands something on the robot.
    TruthOnRobot { thing: Bilingual },

    /// A directory of rule files that was named and is not there.
    NoRules { dir: String },

    /// Rule files where others are to be written.
    RulesThere { files: String },

    /// A floor too large for a picture.
    GridTooLarge { map: Bilingual, limit: usize },

    /// A file that cannot be read or written.
    File {
        path: String,
        reason: Bilingual,
        /// What was named is at fault, not the disk.
        is_input: bool,
    },
}

impl Error {
    /// Whether all that an order lacks is whither something goes.
    pub(super) fn asks_whither(&self) -> bool {
        match self {
            Self::Misheard(misheard) => misheard.asks_whither(),
            Self::Request(request) => matches!(
                request,
                RequestError::KeptThere { .. }
                    | RequestError::AtHome { .. }
                    | RequestError::OneHand { .. }
            ),
            _ => false,
        }
    }

    /// The fault as English tells it, with its places and remedies.
    #[must_use]
    pub fn in_english(&self) -> Box<dyn Diagnostic + '_> {
        match self {
            Self::Map(faults) => Box::new(faults.in_english()),
            Self::Import(error) => match error.as_ref() {
                ImportError::Map(faults) => Box::new(faults.in_english()),
                error => Box::new(English(error)),
            },
            Self::Rules(faults) => Box::new(faults.in_english()),
            Self::Relations(error) => error.in_english(),
            Self::Language(faults) => Box::new(faults.in_english()),
            Self::Store(error) => Box::new(English(error)),
            Self::Misheard(error) => Box::new(English(error)),
            Self::Corridor(error) => Box::new(English(error)),
            Self::CorridorFile(error) => Box::new(error.in_english()),
            Self::Datalog(error) => error.in_english(),
            Self::Query(error) => error.in_english(),
            Self::Log(error) => Box::new(error.in_english()),
            Self::Picture(error) => Box::new(English(error)),
            #[cfg(feature = "pictures")]
            Self::Png(error) => Box::new(English(error)),
            #[cfg(feature = "sqlite")]
            Self::Sqlite(error) => Box::new(English(error)),
            #[cfg(feature = "recordings")]
            Self::Recording(error) => Box::new(English(error)),
            Self::Vehicle(error) => Box::new(English(error.as_ref())),
            Self::Mission(error) => error.in_english(),
            Self::Request(error) => Box::new(English(error)),
        }
    }

    /// The fault as a sentence of a language.
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        match (language, self) {
            (_, Self::Misheard(misheard)) => misheard.say(language),
            (Language::Russian, _) => capitalized(&self.to_string()),
            (Language::English, _) => sentence(&self.in_english().to_string()),
        }
    }

    /// The input is at fault, not the program or the disk.
    #[must_use]
    pub fn is_input(&self) -> bool {
        match self {
            Self::Map(_)
            | Self::Import(_)
            | Self::Rules(_)
            | Self::Relations(_)
            | Self::Language(_)
            | Self::Query(_)
            | Self::Misheard(_)
            | Self::Mission(_)
            | Self::Corridor(_)
            | Self::CorridorFile(_)
            | Self::Log(_)
            | Self::Picture(_) => true,
            Self::Datalog(error) => match error.as_ref() {
                FilesError::File { cause, .. } => is_input(cause.kind()),
                _ => true,
            },
            Self::Request(RequestError::File { is_input, .. }) => *is_input,
            Self::Request(_) => true,
            #[cfg(feature = "pictures")]
            Self::Png(_) => true,
            #[cfg(feature = "sqlite")]
            Self::Sqlite(error) => error.is_input(),
            Self::Store(error) => error.is_input(),
            #[cfg(feature = "recordings")]
            Self::Recording(error) => error.is_input(),
            Self::Vehicle(_) => false,
        }
    }
}

/// The names of what is on the map.
pub(super) fn both(world: &World, entity: Entity) -> Bilingual {
    Bilingual::new(world.name(entity).to_owned(), named(world, entity).english())
}

/// What the map calls so, in both languages; what it does not know goes by the same name in both.
pub(super) fn in_both(world: &World, name: &str) -> Bilingual {
    match world.find(name).first() {
        Some(entity) => both(world, *entity),
        None => name.to_owned().into(),
    }
}

impl RequestError {
    /// Each thing with the place where it is kept, and lies.
    pub(super) fn at_home(things: &[(Bilingual, Bilingual)]) -> Self {
        let told = Bilingual::both(|language| {
            let each = things.iter().map(|(thing, home)| {
                crate::units::told!(language, "engine-lies-at-home", thing, home)
            });
            each.collect::<Vec<_>>().join("; ")
        });
        Self::AtHome { told }
    }

    pub(super) fn homeless(things: Vec<Bilingual>) -> Self {
        Self::Homeless { count: things.len(), things }
    }
}

fn sentence(told: &str) -> String {
    let stop = if told.ends_with(['.', '?', '!']) { "" } else { "." };
    format!("{}{stop}", capitalized(told))
}
