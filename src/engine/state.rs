//! What is known at a moment: the map at a revision, and all that follows from it.
//!
//! A [`State`] never changes once it is shared: any number of threads ask it, while the engine prepares the next. The map as
//! surveyed and the world as it is now are each a [`Known`]; what was not derived yet is derived when first asked for, by
//! whoever asks first, and what an edit leaves as it was is shared by the states before and after it.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};

use crate::facts::{Proof, WhyNot};
use crate::geometry::{FloorPlan, Openings};
use crate::language::FormIndex;
use crate::map::{Entity, World, Zone};
use crate::semantics::{Around, Followed, Relations, Told, robot_eye, things_in_view};
use crate::store::{Derived, Reader, RobotMemory, Store};
use crate::units::{
    AreaId, Bilingual, Gather as _, MapId, Point, Pose, ReplicaId, Stop, Timestamp, nearest_name,
    said, told, word,
};

use super::changes::Changes;
use super::error::{both, in_both};
use super::known::Known;
use super::{Error, RequestError, Rules, Value};

/// The knowledge of one building at a moment, and what follows from it: see the head of this file.
#[derive(Debug, Clone)]
pub struct State {
    pub(super) rules: Arc<Rules>,
    /// The map as surveyed.
    pub(super) surveyed: Option<Arc<Known>>,
    /// Of the store's other tables, which know what was seen and done; none for a map in memory.
    pub(super) reader: Option<Reader>,
    pub(super) derived: Option<Derived>,
    /// The store's directory, for what is said where there is no map.
    place: String,
    /// What the robot did and where it stands.
    pub(super) memory: OnceLock<RobotMemory>,
    /// The world as it is believed to be now, where that differs from the map.
    pub(super) now: OnceLock<Option<Arc<Known>>>,
    /// Where the robot stands; by the word of the vehicle where that was asked.
    pub(super) robot: OnceLock<(MapId, Pose)>,
    /// Where the person stands who gives the orders; none, where the robot does.
    pub(super) person: Option<(MapId, Point)>,
    /// Whether tasks are planned for the least driven time.
    pub(super) plans_in_time: bool,
    /// The moment at which the next zone begins or ends after `now` was found; none where none will.
    stands_until: OnceLock<Option<Timestamp>>,
    /// What the map and the robot's knowledge went through, for dialogues that began before.
    pub(super) changes: Arc<Changes>,
    /// Raised when nobody waits any more for what is asked.
    pub(super) stop: Stop,
}

impl State {
    /// Nothing is derived yet.
    pub(super) fn new(store: Option<&Store>, rules: Arc<Rules>, world: Option<World>) -> Self {
        let derived = store.map(Store::derived);
        let surveyed = world.map(|world| {
            Arc::new(Known::surveyed(Arc::clone(&rules), Arc::new(world), derived.clone()))
        });
        Self {
            rules,
            surveyed,
            reader: store.map(Store::reader),
            derived,
            place: store.map(|s| s.dir().display().to_string()).unwrap_or_default(),
            memory: OnceLock::new(),
            now: OnceLock::new(),
            robot: OnceLock::new(),
            person: None,
            plans_in_time: false,
            stands_until: OnceLock::new(),
            changes: Arc::default(),
            stop: Stop::new(),
        }
    }

    /// The same, to be asked by whoever may raise a flag when the answer is not waited for any more.
    #[cfg(feature = "serve")]
    pub(crate) fn heeding(&self, stop: &Stop) -> Self {
        // What it finds of the present serves those who ask after it, too.
        let _ = self.around();
        Self { stop: stop.clone(), ..self.clone() }
    }

    /// The same map and what follows from it, to be changed: what the robot knows besides is asked for anew.
    pub(super) fn successor(&self) -> Self {
        Self {
            rules: Arc::clone(&self.rules),
            surveyed: self.surveyed.clone(),
            reader: self.reader.clone(),
            derived: self.derived.clone(),
            place: self.place.clone(),
            memory: OnceLock::new(),
            now: OnceLock::new(),
            robot: OnceLock::new(),
            person: None,
            plans_in_time: self.plans_in_time,
            stands_until: OnceLock::new(),
            changes: Arc::clone(&self.changes),
            stop: Stop::new(),
        }
    }

    /// What the store says now of the map's revision, and of what was seen and done.
    pub(super) fn stand_on(&mut self, store: Option<&Store>) {
        self.reader = store.map(Store::reader);
        self.derived = store.map(Store::derived);
        if let Some(surveyed) = &mut self.surveyed {
            Arc::make_mut(surveyed).derived.clone_from(&self.derived);
        }
        self.forget_present();
    }

    /// The map as surveyed.
    ///
    /// # Errors
    /// [`RequestError::NoMap`].
    pub(super) fn surveyed(&self) -> Result<&Arc<Known>, Error> {
        self.surveyed
            .as_ref()
            .ok_or_else(|| RequestError::NoMap { store: self.place.clone() }.into())
    }

    /// The world as it is believed to be now: the map, with what the robot did and what was seen. Where nothing of that
    /// differs from the map, the map itself, of which nothing is derived anew. It is made at the moment when it is first
    /// asked for after a change.
    ///
    /// # Errors
    /// There is no map, or its relations cannot be derived.
    pub(super) fn around(&self) -> Result<&Known, Error> {
        let surveyed = self.surveyed()?;
        if let Some(now) = self.now.get() {
            return Ok(now.as_ref().unwrap_or(surveyed));
        }
        let moment = std::time::SystemTime::now().into();
        let edges = |zone: &Zone| [zone.from, zone.until];
        let coming = surveyed.world.zones.values().flat_map(edges).flatten();
        // Whoever asked at the same time may have noted it; either does.
        let _ = self.stands_until.set(coming.filter(|edge| *edge > moment).min());
        let found = self.find_now(surveyed, moment)?.map(Arc::new);
        Ok(self.now.get_or_init(|| found).as_ref().unwrap_or(surveyed))
    }

    /// The same, made anew for this moment.
    ///
    /// # Errors
    /// As [`Self::around`].
    pub(super) fn known_at(&self, moment: Timestamp) -> Result<Arc<Known>, Error> {
        let surveyed = self.surveyed()?;
        let found = self.find_now(surveyed, moment)?;
        Ok(found.map_or_else(|| Arc::clone(surveyed), Arc::new))
    }

    fn find_now(&self, surveyed: &Arc<Known>, moment: Timestamp) -> Result<Option<Known>, Error> {
        let timed = |zone: &Zone| !zone.is_standing() && zone.is_in_force(moment);
        let in_time = surveyed.world.zones.values().any(timed);
        let memory = self.memory()?;
        let unmoved = !in_time
            && memory.doors.is_empty()
            && memory.devices.is_empty()
            && memory.opened.is_empty()
            && memory.carried.is_empty()
            && memory.obstacles.is_empty()
            && self
                .reader
                .as_ref()
                .map_or(Ok(true), |reader| Ok::<_, Error>(reader.observed()?.is_empty()))?;
        let asked = self.rules.relations.asks_the_robot();
        if unmoved && !asked {
            return Ok(None);
        }
        let world = self.believed(memory, moment)?;
        let holders: BTreeMap<_, _> = memory
            .carried
            .iter()
            .filter(|(id, _)| world.replicas.contains_key(id))
            .map(|(id, holder)| (*id, holder.clone()))
            .gather();
        if holders.is_empty() && !in_time && world == *surveyed.world && !asked {
            return Ok(None);
        }
        let carriers = self.carriers(&world, &memory.carried)?;
        let now = Known::now(surveyed, world, holders, carriers, moment)?;
        if asked { self.tell(now, moment).map(Some) } else { Ok(Some(now)) }
    }

    /// Tells the rules what the robot knows beside the world.
    fn tell(&self, now: Known, at: Timestamp) -> Result<Known, Error> {
        let told = self.told(&now, at, self.rules.relations.asks_for_view())?;
        now.told(&told)
    }

    /// What the robot knows beside the world; what it has in view where that is asked.
    pub(super) fn told(&self, now: &Known, at: Timestamp, with_view: bool) -> Result<Told, Error> {
        let world = now.world();
        let stands = |(map, _): &(MapId, Pose)| world.maps.contains_key(map);
        let robot = self.robot_pose().filter(stands);
        let in_view = match robot {
            Some((map, pose)) if with_view => {
                let floor = now.floor(map)?;
                let near = now.relations()?.thresholds();
                things_in_view(world, floor, &robot_eye(world, floor, pose, near), near)
            }
            _ => Vec::new(),
        };
        let carried = now.holders.iter().map(|(id, holder)| (*id, holder.clone())).collect();
        Ok(Told { robot, in_view, believed: self.whereabouts_believed(at)?, carried })
    }

    /// Where what was looked at is believed to be, and how surely.
    pub(super) fn whereabouts_believed(
        &self,
        at: Timestamp,
    ) -> Result<Vec<(ReplicaId, AreaId, f64)>, Error> {
        let Some(reader) = &self.reader else { return Ok(Vec::new()) };
        let mut believed = Vec::new();
        for id in reader.observed()? {
            let Some(surveyed) = self.world()?.replicas.get(&id) else { continue };
            let belief = reader.belief(surveyed, at)?;
            believed.push((id, belief.place.area, belief.confidence));
        }
        Ok(believed)
    }

    /// The world as it is believed to be now: the map, with what the robot did and what was seen.
    ///
    /// # Errors
    /// There is no map.
    pub fn world_now(&self) -> Result<&World, Error> {
        Ok(self.around()?.world())
    }

    /// The relations of a world that differs from the map in what a robot can do or see: those of the map, followed
    /// where they can be, else derived anew.
    pub(super) fn followed(&self, world: &World) -> Result<Followed, Error> {
        self.surveyed()?.followed(world)
    }

    /// Whether a zone has begun or ended since it was found how the world is now.
    pub(super) fn is_outlived(&self, at: Timestamp) -> bool {
        self.stands_until.get().copied().flatten().is_some_and(|until| until <= at)
    }

    pub(super) fn forget_present(&mut self) {
        self.memory.take();
        self.now.take();
        self.robot.take();
        self.stands_until.take();
        Arc::make_mut(&mut self.changes).note_action();
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
        Ok(self.surveyed()?.world())
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
        self.surveyed()?.relations()
    }

    /// Facts with their relations: those of one relation, those about one thing, or both.
    ///
    /// # Errors
    /// The relation or the thing is unknown, or between what it is asked has to be said ([`State::query`]).
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
        let tuples = match relations.asked_by(name) {
            Some(question) => {
                let ask = |error| Error::Query(Box::new(error));
                relations.ask(&self.place()?, &question).map_err(ask)?
            }
            None => relations.tuples(name)?,
        };
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
        self.surveyed()?.openings()
    }

    /// The free floor of every map, which leads through what the rules let join, computed when first asked for.
    ///
    /// # Errors
    /// As [`State::relations`].
    pub fn floors(&self) -> Result<&BTreeMap<MapId, FloorPlan>, Error> {
        self.surveyed()?.floors()
    }

    /// Every name in every form, indexed when first asked for.
    pub(super) fn forms(&self) -> Result<&FormIndex<Entity>, Error> {
        Ok(self.surveyed()?.forms())
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
                    let names = world.maps.values().map(|map| in_both(world, &map.name));
                    let candidates = Bilingual::list(&names.collect::<Vec<_>>());
                    Err(RequestError::WhichMap { candidates }.into())
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
        let known = self.surveyed()?;
        let (world, mut found) = (known.world(), known.names().find(known.world(), name));
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
                let names = several.iter().map(|&e| both(world, e));
                let candidates = Bilingual::list(&names.collect::<Vec<_>>());
                Err(RequestError::AmbiguousName { name: name.to_owned(), candidates }.into())
            }
        }
    }

    /// Why a relation holds on the map as surveyed, or what it lacks.
    ///
    /// # Errors
    /// There is no map, or it knows no such relation, or nothing of such a name.
    pub(crate) fn why(&self, relation: &str, of: &[&str]) -> Result<Result<Proof, WhyNot>, Error> {
        let (relations, around) = (self.relations()?, self.place()?);
        let of = &self.arguments(of)?;
        Ok(match relations.why(&around, relation, of)? {
            Some(proof) => Ok(proof),
            None => Err(relations.why_not(&around, relation, of)?),
        })
    }

    /// From what is measured when the relations of the surveyed map are asked.
    pub(super) fn place(&self) -> Result<Around<'_>, Error> {
        Ok(Around::new(self.world()?).with_robot(self.robot_pose()))
    }

    /// What the arguments of a fact are called in the facts: a number, or a word that some fact has, is that; anything
    /// else is the name of a thing, in either language and any form. Of what does not exist nothing is true or false.
    ///
    /// # Errors
    /// As [`Self::find`].
    pub(crate) fn arguments<'a>(&'a self, of: &[&'a str]) -> Result<Vec<&'a str>, Error> {
        let relations = self.relations()?;
        let argument = |&name: &&'a str| match name.parse::<f64>().is_ok() || relations.knows(name)
        {
            true => Ok(name),
            false => Ok(self.world()?.name(self.find(name)?)),
        };
        of.iter().map(argument).collect()
    }
}

/// How many names are offered for one that nothing bears.
const NEAR_MISSES: usize = 3;

/// «может быть, «Точка-А» или «Точка-К»?»
fn offer(names: &[String]) -> Option<Bilingual> {
    if names.is_empty() {
        return Some(said!("names-of-things"));
    }
    Some(Bilingual::both(|language| {
        let quoted = names.iter().map(|name| Bilingual::quoted(name).say(language).to_owned());
        let quoted: Vec<String> = quoted.collect();
        let either = quoted.join(&word!("or").say(language));
        told!(language, "perhaps-one-of", either)
    }))
}

fn unknown_name<'a>(name: &str, names: impl Iterator<Item = &'a str>) -> RequestError {
    let names: Vec<&str> = names.collect();
    let help = match nearest_name(name, names.iter().copied()) {
        Some(near) => said!("perhaps-near", near),
        None => said!("there-are-names", names = names.join(", ")),
    };
    let help = Some(help);
    RequestError::UnknownName { name: name.to_owned(), help }
}
