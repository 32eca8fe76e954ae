//! The one object that a program holds: a store, and the map, relations and free floor kept in step with it.
//!
//! ```
//! use orthoframe::Engine;
//! # let dir = tempfile::tempdir().unwrap();
//! # let dir = dir.path().join("store");
//! # let map = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/rb2.toml");
//! let mut engine = Engine::open(&dir, None)?;
//! engine.import(map.as_ref(), &orthoframe::engine::change_now("operator", "survey"))?;
//! let route = engine.route("Точка-А", "Комната-Y", orthoframe::engine::Method::Shortest)?;
//! println!("{:.0} см", route.route.as_ref().unwrap().length);
//! # Ok::<(), orthoframe::engine::Error>(())
//! ```
//!
//! **Invariant.** Only the engine writes to the store; what it derives belongs to the map that it holds, and is
//! derived anew when that map changes.
//!
//! # Invariants
//!
//! A [`State`] that somebody holds never changes; what an edit leaves as it was is shared by the states before and after.
//!
//! The only writer of the store; what it derives belongs to the map that it holds, and after an edit is what
//! deriving anew would give. What the robot did and saw stands beside the map and never changes it. A way through
//! doors that are only shut is a way, with the doors that must be opened (`engine/opening`). A scenario never
//! makes a room or door exist: only the Map or its «Объекты» does. A rule file that is named and cannot be used
//! is an error, never a silent fallback.

mod advice;
mod after;
mod apart;
mod assumed;
mod barriers;
pub(crate) mod calls;
mod changes;
mod delivery;
mod dialogue;
mod differences;
mod directions;
mod directive_words;
mod doubtful;
mod doubts;
mod drawing;
mod edit;
mod error;
mod export;
pub(crate) mod forms;
mod furniture;
mod given;
mod goals;
mod handed;
mod history;
mod in_turn;
mod journey;
pub mod json;
mod known;
mod lexicon;
mod localisation;
mod located;
mod logged;
mod measured;
mod memory;
mod narration;
mod near;
mod news;
mod observe;
mod obstacles;
mod opening;
mod past;
mod plan;
mod position;
mod query;
mod queue;
mod reading;
#[cfg(feature = "recordings")]
mod recording;
pub(crate) mod rehearsal;
mod round;
mod route;
mod rule_files;
mod rules;
mod scenario;
mod seeing;
mod sight;
mod sighting;
mod stance;
mod state;
mod surprises;
mod talk;
mod task;
mod tidy;
mod tree;
mod truth;
mod upkeep;
mod utterance;
mod words;
mod zones;

use std::path::Path;
use std::sync::Arc;

pub use after::After;
pub(crate) use barriers::no_way_in_words;
pub(crate) use dialogue::queue_in_words;
pub use dialogue::{Dialogue, Event, Heard, Outcome, Reply};
use directive_words::actions_in_words;
pub(crate) use directive_words::{directive_in_words, name_in};
pub use drawing::{Drawing, Lens};
pub use edit::{Edited, Mode};
pub use error::{Error, RequestError};
pub(crate) use forms::uncertain_names;
use given::in_rule_text;
pub use history::When;
pub use journey::Journey;
pub use json::TaskEvents;
pub use localisation::{FoundPose, FoundScan};
pub use located::End;
pub(crate) use narration::{decimal, plan_in_words};
pub use observe::{Believed, Source, Station};
use plan::steps;
pub use plan::{PlanAnswer, PlanStep};
pub(crate) use plan::{check_plan_alone, plan_alone_without};
pub use position::Whereabout;
pub use query::QueryAnswer;
pub use reading::Region;
#[cfg(feature = "recordings")]
pub use recording::Recording;
pub use route::RouteAnswer;
pub(crate) use rule_files::question_beginnings;
pub use rules::Rules;
pub use seeing::{Changes, Sighted, Things, View};
pub(crate) use sight::face_in_words;
pub use state::State;
use surprises::surprise_in_words;
use task::OPERATOR;
pub use task::{Progress, Report, TaskAnswer, TaskEnding};
pub(crate) use truth::Truth;

pub use crate::exchange::{
    Format as ImportFormat, Imported as ImportedFile, Options as ImportOptions,
};
pub use crate::facts::Value;
pub use crate::geometry::Method;
pub use crate::graphplan::Limits;
pub(crate) use crate::language::command::{Waiting, waiting};
pub use crate::language::question::{Answer, Memory, Unanswered};
pub use crate::language::report::Detail;
pub use crate::map::Format;
pub(crate) use crate::map::World;
pub use crate::robot::Wanted;
pub(crate) use crate::robot::{Replanned, Solved};
pub(crate) use crate::semantics::Relations;
pub use crate::store::{Change, Difference, Revision, RevisionKind, Seen, Timestamp};
pub(crate) use crate::store::{Queue, QueuedTask, Severity};
pub use crate::strips::Scenario;

use crate::exchange::Report as ReadingReport;
use crate::map::{MapErrors, read_file};
use crate::store::{ImportReport, OpenReport, Store, StoreError};

/// The store of one building and what is known now: all that a [`State`] tells, an engine tells too.
#[derive(Debug)]
pub struct Engine {
    store: Option<Store>,
    state: Arc<State>,
    /// The tasks that wait, where no store keeps them.
    waiting: Queue,
    /// What the next edit takes up instead of a copy.
    spares: edit::Spares,
    /// What opening the store found and mended.
    pub opened: OpenReport,
}

impl std::ops::Deref for Engine {
    type Target = State;

    fn deref(&self) -> &State {
        &self.state
    }
}

/// What an import did.
#[derive(Debug, Clone)]
pub struct Imported {
    /// What changed in the store.
    pub report: ImportReport,
    /// What was read of the file, mended and left out.
    pub reading: ReadingReport,
    /// Warnings of the map file.
    pub warnings: MapErrors,
}

/// A change made at this moment by this user.
#[must_use]
pub fn change_now(user: &str, reason: &str) -> Change {
    Change::new(user, std::time::SystemTime::now().into(), reason)
}

impl Engine {
    /// Nothing is derived yet.
    fn new(store: Option<Store>, opened: OpenReport, rules: Rules, world: Option<World>) -> Self {
        let state = Arc::new(State::new(store.as_ref(), Arc::new(rules), world));
        let (waiting, spares) = (Queue::default(), edit::Spares::default());
        Self { store, state, waiting, spares, opened }
    }

    /// What is known now, to be asked by any thread for as long as it likes, whatever the engine does meanwhile. It is taken
    /// in no time, but for the first after a change of what the robot knows.
    ///
    /// # Errors
    /// There is no map, or its relations cannot be derived.
    pub fn state(&self) -> Result<Arc<State>, Error> {
        // What was seen and done stands in tables of which only the last state is read.
        if self.state.surveyed.is_some() {
            self.state.around()?;
        }
        Ok(Arc::clone(&self.state))
    }

    /// From now on tasks are planned for the least driven time, however many steps it takes.
    pub fn plan_in_time(&mut self) {
        self.next().plans_in_time = true;
    }

    /// The state that is to follow: this one itself where nobody else has it.
    fn next(&mut self) -> &mut State {
        if Arc::get_mut(&mut self.state).is_none() {
            self.state = Arc::new(self.state.successor());
        }
        Arc::get_mut(&mut self.state).expect("nobody else has it")
    }

    /// Opens the store in a directory, or makes one there. `rules` is a directory of rule files; the texts
    /// built in serve where it has none.
    ///
    /// # Errors
    /// Another program keeps the store for longer than a call takes, it is damaged, or the rules are faulty.
    pub fn open(dir: &Path, rules: Option<&Path>) -> Result<Self, Error> {
        let rules = Rules::read(rules)?;
        let (store, opened) = Store::open(dir)?;
        let world = store.world()?;
        Ok(Self::new(Some(store), opened, rules, world))
    }

    /// Opens a store that is there already, to be asked; other programs may write it meanwhile. What is to be mended is.
    ///
    /// # Errors
    /// There is no store, or as [`Engine::open`].
    pub fn open_to_ask(dir: &Path, rules: Option<&Path>) -> Result<Self, Error> {
        Self::must_be_there(dir)?;
        let rules = Rules::read(rules)?;
        let (store, opened) = Store::open_to_ask(dir)?;
        let world = store.world()?;
        Ok(Self::new(Some(store), opened, rules, world))
    }

    /// Opens a store for reading, without touching it: another program may be writing it meanwhile.
    ///
    /// # Errors
    /// There is no store, or as [`Engine::open`].
    pub fn open_read_only(dir: &Path, rules: Option<&Path>) -> Result<Self, Error> {
        let rules = Rules::read(rules)?;
        let (store, opened) = Store::open_read_only(dir)?;
        let world = store.world()?;
        Ok(Self::new(Some(store), opened, rules, world))
    }

    /// Opens a store that is there already.
    ///
    /// # Errors
    /// There is no store, or as [`Engine::open`].
    pub fn open_existing(dir: &Path, rules: Option<&Path>) -> Result<Self, Error> {
        Self::must_be_there(dir)?;
        Self::open(dir, rules)
    }

    fn must_be_there(dir: &Path) -> Result<(), Error> {
        match dir.is_dir() {
            true => Ok(()),
            false => Err(StoreError::Missing { dir: dir.display().to_string() }.into()),
        }
    }

    /// An engine without a store, on a map that stays in memory.
    ///
    /// # Errors
    /// The rules are faulty.
    pub fn in_memory(world: World, rules: Option<&Path>) -> Result<Self, Error> {
        Ok(Self::new(None, OpenReport::default(), Rules::read(rules)?, Some(world)))
    }

    /// An engine without a store on a state that others share: it hears and drives while the writer goes on. What the
    /// robot does is noted by the writer ([`Engine::remember_after`]), and read here after that.
    #[must_use]
    pub fn beside(state: Arc<State>) -> Self {
        let (waiting, spares) = (Queue::default(), edit::Spares::default());
        Self { store: None, state, waiting, opened: OpenReport::default(), spares }
    }

    /// Reads a building of any format that can be imported, without touching any store.
    ///
    /// # Errors
    /// All faults of the file.
    pub fn read_building(file: &Path, options: &ImportOptions) -> Result<ImportedFile, Error> {
        Ok(crate::exchange::read(file, options)?)
    }

    /// Reads a building of any format that [`crate::exchange`] knows and makes it the store's map, in one transaction
    /// that is on the disk when this returns.
    ///
    /// # Errors
    /// All faults of the file; the store is then as it was.
    pub fn import(&mut self, file: &Path, change: &Change) -> Result<Imported, Error> {
        self.keep(Self::read_building(file, &ImportOptions::default())?, change)
    }

    /// Makes a building that was read the store's map, as [`Engine::import`] does.
    ///
    /// # Errors
    /// The store cannot take it; it is then as it was.
    pub fn keep(&mut self, read: ImportedFile, change: &Change) -> Result<Imported, Error> {
        let ImportedFile { world, report: reading, warnings } = read;
        let report = match &mut self.store {
            Some(store) => {
                let report = store.import(&world, change)?;
                self.reread()?;
                report
            }
            None => {
                self.follow(world)?;
                // Its ids have nothing to do with those of the map before.
                self.next().changes = Arc::default();
                ImportReport::default()
            }
        };
        Ok(Imported { report, reading, warnings })
    }
}

/// Reads a map file, without touching any store. With the world come the warnings.
///
/// # Errors
/// All faults of the file.
pub(crate) fn read_map(file: &Path) -> Result<(World, MapErrors), MapErrors> {
    let reading = read_file(file);
    match reading.world {
        Some(world) => Ok((world, reading.faults)),
        None => Err(reading.faults),
    }
}
