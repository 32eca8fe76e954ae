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
//! The only writer of the store; what it derives belongs to the map that it holds, and after an edit is what
//! deriving anew would give. What the robot did and saw stands beside the map and never changes it. A way through
//! doors that are only shut is a way, with the doors that must be opened (`engine/opening`). A scenario never
//! makes a room or door exist: only the Map or its «Объекты» does. A rule file that is named and cannot be used
//! is an error, never a silent fallback.

mod advice;
mod apart;
mod barriers;
mod deeds;
mod delivery;
mod directions;
mod doubtful;
mod doubts;
mod drawing;
mod edit;
mod error;
mod export;
mod forms;
mod goals;
mod history;
mod journey;
mod lexicon;
mod load;
mod memory;
mod observe;
mod opening;
mod plan;
mod position;
mod present;
mod reading;
mod route;
mod rules;
mod sight;
mod stance;
mod surprises;
mod surroundings;
mod talk;
mod task;
mod tidy;
mod upkeep;
mod utterance;
mod words;

use std::cell::OnceCell;
use std::collections::BTreeMap;
use std::path::Path;

pub use advice::Advice;
pub use barriers::no_way_in_words;
pub use deeds::{deeds_in_words, directive_in_words, name_in, task_in_words};
pub use doubts::check_map_closely;
pub use drawing::{Drawing, Lens};
pub use edit::{Edited, Mode};
pub use error::{Error, RequestError};
pub use forms::uncertain_names;
pub use history::When;
pub use journey::{Journey, ride_in_words};
pub use memory::{After, Now, ROBOT};
pub use observe::{Believed, Proposal, Source, Station};
pub use opening::opens_in_words;
pub use plan::{PlanAnswer, PlanStep, check_plan_alone, plan_alone, plan_alone_without, steps};
pub use position::Whereabout;
pub use reading::Region;
pub use route::{End, Located, RouteAnswer, Stage, parse_pose};
pub use rules::Rules;
pub use sight::face_in_words;
pub use surprises::surprise_in_words;
pub use task::{OPERATOR, Progress, Report, TaskAnswer, TaskEnding};
pub use upkeep::{check_store, restore_store};

pub use crate::exchange::GridFiles;
pub use crate::exchange::{
    Format as ImportFormat, Imported as ImportedFile, Options as ImportOptions,
    Report as ReadingReport, read as read_building,
};
pub use crate::facts::Value;
pub use crate::geometry::Method;
pub use crate::language::question::{Answer, Memory, Unanswered};
pub use crate::map::{Format, World};
pub use crate::robot::{Replanned, Solved};
pub use crate::semantics::Relations;
pub use crate::store::{
    Change, Difference, FsckReport, Revision, RevisionKind, Severity, Timestamp,
};

use crate::geometry::{DoorStates, FloorPlan};
use crate::language::FormIndex;
use crate::language::question::Mind;
use crate::map::{Entity, MapErrors, read_file};
use crate::semantics::derive;
use crate::store::{ImportReport, OpenReport, Store, StoreError};
use crate::units::{MapId, nearest_name};

use lexicon::form_index;
use present::Present;

/// The knowledge of one building, and what follows from it.
#[derive(Debug)]
pub struct Engine {
    store: Option<Store>,
    rules: Rules,
    world: Option<World>,
    relations: OnceCell<Relations>,
    floors: OnceCell<BTreeMap<MapId, FloorPlan>>,
    /// The nouns of the map, for questions.
    mind: OnceCell<Mind>,
    /// The names of the map in all their forms, for commands.
    forms: OnceCell<FormIndex<Entity>>,
    /// The world as it is believed to be now, where that differs from the map.
    present: OnceCell<Option<Box<Present>>>,
    /// What opening the store found and mended.
    pub opened: OpenReport,
}

/// Under this name the store keeps the relations.
const RELATIONS: &str = "relations";

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
        Self {
            store,
            rules,
            world,
            relations: OnceCell::new(),
            floors: OnceCell::new(),
            mind: OnceCell::new(),
            forms: OnceCell::new(),
            present: OnceCell::new(),
            opened,
        }
    }

    /// Opens the store in a directory, or makes one there. `rules` is a directory of rule files; the texts
    /// built in serve where it has none.
    ///
    /// # Errors
    /// The store is held by another process or damaged, or the rules are faulty.
    pub fn open(dir: &Path, rules: Option<&Path>) -> Result<Self, Error> {
        let rules = Rules::read(rules)?;
        let (store, opened) = Store::open(dir)?;
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
        if !dir.is_dir() {
            return Err(StoreError::Missing { dir: dir.display().to_string() }.into());
        }
        Self::open(dir, rules)
    }

    /// An engine without a store, on a map that stays in memory.
    ///
    /// # Errors
    /// The rules are faulty.
    pub fn in_memory(world: World, rules: Option<&Path>) -> Result<Self, Error> {
        Ok(Self::new(None, OpenReport::default(), Rules::read(rules)?, Some(world)))
    }

    /// Reads a building of any format that [`crate::exchange`] knows and makes it the store's map, in one transaction
    /// that is on the disk when this returns.
    ///
    /// # Errors
    /// All faults of the file; the store is then as it was.
    pub fn import(&mut self, file: &Path, change: &Change) -> Result<Imported, Error> {
        self.keep(crate::exchange::read(file, &ImportOptions::default())?, change)
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
                ImportReport::default()
            }
        };
        Ok(Imported { report, reading, warnings })
    }

    /// The map.
    ///
    /// # Errors
    /// [`RequestError::NoMap`].
    pub fn world(&self) -> Result<&World, Error> {
        self.world.as_ref().ok_or_else(|| {
            let store =
                self.store.as_ref().map(|s| s.dir().display().to_string()).unwrap_or_default();
            RequestError::NoMap { store }.into()
        })
    }

    #[must_use]
    pub fn rules(&self) -> &Rules {
        &self.rules
    }

    /// The relations that hold on the map, derived when first asked for.
    ///
    /// # Errors
    /// There is no map, or a rule of the user's own outgrows the memory.
    pub fn relations(&self) -> Result<&Relations, Error> {
        let world = self.world()?;
        if let Some(relations) = self.relations.get() {
            return Ok(relations);
        }
        let relations = match self.kept_relations(world) {
            Some(relations) => relations,
            None => {
                let relations = derive(world, &self.rules.relations, world.domain.profile)?;
                self.keep_relations(&relations);
                relations
            }
        };
        Ok(self.relations.get_or_init(|| relations))
    }

    /// The relations that the store keeps for its map as it stands, under these rules.
    fn kept_relations(&self, world: &World) -> Option<Relations> {
        let bytes = self.store.as_ref()?.get_derived(RELATIONS)?;
        Relations::restore(world, &self.rules.relations, world.domain.profile, &bytes)
    }

    /// Keeps relations for the next start. They can be derived again, so that a store that cannot take them does no
    /// harm.
    fn keep_relations(&self, relations: &Relations) {
        let Some(store) = &self.store else { return };
        let Some(bytes) = relations.save() else { return };
        if let Err(error) = store.put_derived(RELATIONS, store.revision(), &bytes) {
            tracing::debug!(%error, "relations are not kept");
        }
    }

    /// Facts with their relations: those of one relation, those about one thing, or both.
    ///
    /// # Errors
    /// The relation or the thing is unknown.
    pub fn facts(
        &self,
        name: Option<&str>,
        of: Option<&str>,
    ) -> Result<Vec<(String, Vec<Value>)>, Error> {
        let relations = self.relations()?;
        let of = of
            .map(|of| Ok::<_, Error>((of, self.world()?.name(self.find(of)?).to_owned())))
            .transpose()?;
        let Some(name) = name else {
            return Ok(of.map(|(_, of)| relations.of(&of)).unwrap_or_default());
        };
        let tuples = relations.tuples(name)?;
        let wanted = |t: &Vec<Value>| {
            of.as_ref().is_none_or(|(_, of)| {
                t.iter().any(|v| matches!(v, Value::Symbol(s) if **s == **of))
            })
        };
        let label = relations.display_name(name, crate::units::Language::Russian);
        Ok(tuples.into_iter().filter(wanted).map(|t| (label.clone(), t)).collect())
    }

    /// The free floor of every map, computed when first asked for.
    ///
    /// # Errors
    /// [`RequestError::NoMap`].
    pub fn floors(&self) -> Result<&BTreeMap<MapId, FloorPlan>, Error> {
        let world = self.world()?;
        Ok(self.floors.get_or_init(|| {
            world.maps.keys().map(|&map| (map, self.floor_of(world, map))).collect()
        }))
    }

    /// The floor of a map, with what the store keeps of it; what had to be built is kept for the next start.
    fn floor_of(&self, world: &World, map: MapId) -> FloorPlan {
        let kind = format!("floor-{}", map.0);
        let kept = self.store.as_ref().and_then(|store| store.get_derived_earlier(&kind));
        let kept = kept.unwrap_or_default();
        let states = DoorStates::new();
        let (plan, built) = FloorPlan::restore(world, map, &world.robot, &states, &kept);
        if let (Some(store), true) = (&self.store, built > 0)
            && let Err(error) = store.put_derived(&kind, store.revision(), &plan.save(world))
        {
            tracing::debug!(%error, "floors are not kept");
        }
        plan
    }

    /// Every name in every form, indexed when first asked for.
    fn forms(&self) -> Result<&FormIndex<Entity>, Error> {
        let world = self.world()?;
        Ok(self.forms.get_or_init(|| form_index(world)))
    }

    pub(crate) fn floor(&self, map: MapId) -> Result<&FloorPlan, Error> {
        Ok(self.floors()?.get(&map).expect("every map of the world has a floor"))
    }

    /// The map of this name; without a name, the only one.
    ///
    /// # Errors
    /// There is none of this name, or a name is needed.
    pub fn map_named(&self, name: Option<&str>) -> Result<MapId, Error> {
        let world = self.world()?;
        let Some(name) = name else {
            let mut maps = world.maps.values();
            return match (maps.next(), maps.next()) {
                (Some(only), None) => Ok(only.id),
                (None, _) => Err(RequestError::NoMaps.into()),
                _ => {
                    let candidates: Vec<&str> =
                        world.maps.values().map(|m| m.name.as_str()).collect();
                    Err(RequestError::WhichMap { candidates: candidates.join(", ") }.into())
                }
            };
        };
        let by_key = world.maps.values().find(|m| m.key == name).map(|m| m.id);
        let by_name = || {
            world
                .find(name)
                .into_iter()
                .find_map(|e| if let Entity::Map(id) = e { Some(id) } else { None })
        };
        by_key.or_else(by_name).ok_or_else(|| {
            let names = world.maps.values().flat_map(|m| [m.name.as_str(), m.key.as_str()]);
            unknown_name(name, names).into()
        })
    }

    /// What a name means: as the map spells it, else in any of its forms, however it was typed.
    ///
    /// # Errors
    /// Nothing bears the name, or several things do.
    pub fn find(&self, name: &str) -> Result<Entity, Error> {
        let world = self.world()?;
        let mut found = world.find(name);
        let mut near = Vec::new();
        if found.is_empty() {
            let index = self.forms()?;
            found = index.find(name).into_iter().map(|hit| *hit.id).collect();
            near = index.near(name, NEAR_MISSES).into_iter().map(str::to_owned).collect();
        }
        match found[..] {
            [only] => Ok(only),
            [] => {
                Err(RequestError::UnknownName { name: name.to_owned(), help: offer(&near) }.into())
            }
            ref several => {
                let candidates: Vec<&str> = several.iter().map(|&e| world.name(e)).collect();
                Err(RequestError::AmbiguousName {
                    name: name.to_owned(),
                    candidates: candidates.join(", "),
                }
                .into())
            }
        }
    }
}

/// How many names are offered for one that nothing bears.
const NEAR_MISSES: usize = 3;

/// «может быть, «Точка-А» или «Точка-К»?»
fn offer(names: &[String]) -> Option<String> {
    let quoted: Vec<String> = names.iter().map(|name| format!("«{name}»")).collect();
    let names = "имена: ortho relations --name СОДЕРЖИТ";
    Some(if quoted.is_empty() {
        names.to_owned()
    } else {
        format!("может быть, {}?", quoted.join(" или "))
    })
}

/// Reads a map file, without touching any store. With the world come the warnings.
///
/// # Errors
/// All faults of the file.
pub fn check_map(file: &Path) -> Result<(World, MapErrors), MapErrors> {
    let reading = read_file(file);
    match reading.world {
        Some(world) => Ok((world, reading.faults)),
        None => Err(reading.faults),
    }
}

fn unknown_name<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> RequestError {
    let names: Vec<&str> = names.collect();
    let help = match nearest_name(name, names.iter().copied()) {
        Some(near) => format!("может быть, «{near}»?"),
        None => format!("есть имена: {}", names.join(", ")),
    };
    let help = Some(help);
    RequestError::UnknownName { name: name.to_owned(), help }
}
