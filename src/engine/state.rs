//! What is known at a moment: the map at a revision, and all that follows from it.
//!
//! A [`State`] never changes once it is shared: any number of threads ask it, while the engine prepares the next. What was
//! not derived yet is derived when first asked for, by whoever asks first, and what an edit leaves as it was is shared by the
//! states before and after it.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use crate::geometry::{DoorStates, FloorPlan, Openings};
use crate::language::FormIndex;
use crate::language::question::Mind;
use crate::map::{Entity, World};
use crate::semantics::{Relations, derive};
use crate::store::{Derived, Reader, RobotMemory, Store};
use crate::units::{MapId, nearest_name};

use super::changes::Changes;
use super::lexicon::form_index;
use super::present::Present;
use super::{Error, RequestError, Rules, Value};

/// Under this name the store keeps the relations.
const RELATIONS: &str = "relations";

/// The knowledge of one building at a moment, and what follows from it: see the head of this file.
#[derive(Debug)]
pub struct State {
    pub(super) rules: Arc<Rules>,
    pub(super) world: Option<Arc<World>>,
    /// Of the store's other tables, which know what was seen and done; none for a map in memory.
    pub(super) reader: Option<Reader>,
    derived: Option<Derived>,
    /// The store's directory, for what is said where there is no map.
    place: String,
    pub(super) relations: OnceLock<Arc<Relations>>,
    pub(super) floors: OnceLock<Arc<BTreeMap<MapId, FloorPlan>>>,
    /// The nouns of the map, for questions.
    pub(super) mind: OnceLock<Arc<Mind>>,
    /// The names of the map in all their forms, for commands.
    pub(super) forms: OnceLock<Arc<FormIndex<Entity>>>,
    /// What the robot did and where it stands.
    pub(super) memory: OnceLock<RobotMemory>,
    /// The world as it is believed to be now, where that differs from the map.
    pub(super) present: OnceLock<Option<Box<Present>>>,
    /// What the map and the robot's knowledge went through, for dialogues that began before.
    pub(super) changes: Arc<Changes>,
}

impl State {
    /// Nothing is derived yet.
    pub(super) fn new(store: Option<&Store>, rules: Arc<Rules>, world: Option<World>) -> Self {
        Self {
            rules,
            world: world.map(Arc::new),
            reader: store.map(Store::reader),
            derived: store.map(Store::derived),
            place: store.map(|s| s.dir().display().to_string()).unwrap_or_default(),
            relations: OnceLock::new(),
            floors: OnceLock::new(),
            mind: OnceLock::new(),
            forms: OnceLock::new(),
            memory: OnceLock::new(),
            present: OnceLock::new(),
            changes: Arc::default(),
        }
    }

    /// The same map and what follows from it, to be changed: what the robot knows besides is asked for anew.
    pub(super) fn successor(&self) -> Self {
        Self {
            rules: Arc::clone(&self.rules),
            world: self.world.clone(),
            reader: self.reader.clone(),
            derived: self.derived.clone(),
            place: self.place.clone(),
            relations: self.relations.clone(),
            floors: self.floors.clone(),
            mind: self.mind.clone(),
            forms: self.forms.clone(),
            memory: OnceLock::new(),
            present: OnceLock::new(),
            changes: Arc::clone(&self.changes),
        }
    }

    /// What the store says now of the map's revision, and of what was seen and done.
    pub(super) fn stand_on(&mut self, store: Option<&Store>) {
        self.reader = store.map(Store::reader);
        self.derived = store.map(Store::derived);
        self.forget_present();
    }

    pub(super) fn forget_present(&mut self) {
        self.memory.take();
        self.present.take();
        Arc::make_mut(&mut self.changes).note_deed();
    }

    pub(super) fn forget_derived(&mut self) {
        self.relations.take();
        self.floors.take();
        self.mind.take();
        self.forms.take();
        self.forget_present();
    }

    /// The number of the last change of the map; 0 for a map in memory.
    #[must_use]
    pub fn revision(&self) -> u64 {
        self.reader.as_ref().map_or(0, Reader::revision)
    }

    /// The map.
    ///
    /// # Errors
    /// [`RequestError::NoMap`].
    pub fn world(&self) -> Result<&World, Error> {
        self.shared_world().map(|world| &**world)
    }

    pub(super) fn shared_world(&self) -> Result<&Arc<World>, Error> {
        self.world.as_ref().ok_or_else(|| RequestError::NoMap { store: self.place.clone() }.into())
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
        self.shared_relations().map(|relations| &**relations)
    }

    pub(super) fn shared_relations(&self) -> Result<&Arc<Relations>, Error> {
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
        Ok(self.relations.get_or_init(|| Arc::new(relations)))
    }

    /// The relations that the store keeps for its map as it stands, under these rules.
    fn kept_relations(&self, world: &World) -> Option<Relations> {
        let bytes = self.derived.as_ref()?.get(RELATIONS)?;
        Relations::restore(world, &self.rules.relations, world.domain.profile, &bytes)
    }

    /// Keeps relations for the next start. They can be derived again, so that a store that cannot take them does no
    /// harm.
    fn keep_relations(&self, relations: &Relations) {
        let Some(derived) = &self.derived else { return };
        let Some(bytes) = relations.save() else { return };
        if let Err(error) = derived.put(RELATIONS, &bytes) {
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

    /// All doors and passages, each once, with what the rules let them join.
    ///
    /// # Errors
    /// As [`State::relations`].
    pub fn openings(&self) -> Result<&Openings, Error> {
        Ok(self.relations()?.openings())
    }

    /// The free floor of every map, which leads through what the rules let join, computed when first asked for.
    ///
    /// # Errors
    /// As [`State::relations`].
    pub fn floors(&self) -> Result<&BTreeMap<MapId, FloorPlan>, Error> {
        let world = self.world()?;
        if let Some(floors) = self.floors.get() {
            return Ok(floors);
        }
        let openings = self.openings()?;
        Ok(self.floors.get_or_init(|| {
            let floors = world.maps.keys().map(|&map| (map, self.floor_of(world, openings, map)));
            Arc::new(floors.collect())
        }))
    }

    /// The floor of a map, with what the store keeps of it; what had to be built is kept for the next start.
    fn floor_of(&self, world: &World, openings: &Openings, map: MapId) -> FloorPlan {
        let kind = format!("floor-{}", map.0);
        let kept = self.derived.as_ref().and_then(|derived| derived.get_of_any(&kind));
        let kept = kept.unwrap_or_default();
        let states = DoorStates::new();
        let (plan, built) = FloorPlan::restore(world, openings, map, &world.robot, &states, &kept);
        if let (Some(derived), true) = (&self.derived, built > 0)
            && let Err(error) = derived.put(&kind, &plan.save(world))
        {
            tracing::debug!(%error, "floors are not kept");
        }
        plan
    }

    /// Every name in every form, indexed when first asked for.
    pub(super) fn forms(&self) -> Result<&FormIndex<Entity>, Error> {
        let world = self.world()?;
        Ok(self.forms.get_or_init(|| Arc::new(form_index(world))))
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

fn unknown_name<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> RequestError {
    let names: Vec<&str> = names.collect();
    let help = match nearest_name(name, names.iter().copied()) {
        Some(near) => format!("может быть, «{near}»?"),
        None => format!("есть имена: {}", names.join(", ")),
    };
    let help = Some(help);
    RequestError::UnknownName { name: name.to_owned(), help }
}
