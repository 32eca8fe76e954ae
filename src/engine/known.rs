//! A world with all that follows from it: the map as surveyed, or what is believed to be so now.
//!
//! Questions, ways and places are asked of one [`Known`], whichever it is. What follows is derived when first asked for, by
//! whoever asks first; what a world has in common with the one on which it rests is followed from there.
//!
//! **Invariant**: what is carried stands in no relation to anything and on no floor, and can be spoken of all the same.

use std::collections::BTreeMap;
use std::sync::{Arc, OnceLock};
use std::time::Instant;

use crate::geometry::{DoorStates, FloorPlan, Openings};
use crate::language::FormIndex;
use crate::language::question::Mind;
use crate::map::{Entity, NameIndex, Replica, World, Zone};
use crate::meaning::MapWords;
use crate::semantics::{Followed, Relations, Told, derive};
use crate::store::Derived;
use crate::units::{Gather as _, MapId, ReplicaId, Timestamp};

use super::lexicon::form_index;
use super::{Error, Rules};

/// The free floor of every Map.
pub(super) type Floors = BTreeMap<MapId, FloorPlan>;

/// Under this name the store keeps the relations.
const RELATIONS: &str = "relations";

/// A world and what follows from it: see the head of this file.
#[derive(Debug, Clone)]
pub(super) struct Known {
    pub(super) rules: Arc<Rules>,
    /// With what is carried.
    pub(super) world: Arc<World>,
    /// The same without.
    pub(super) uncarried: Arc<World>,
    /// Who has what was taken off the map; an empty name for the robot itself.
    pub(super) holders: BTreeMap<ReplicaId, String>,
    /// Of what was taken off the map, what lies on or in another such thing, with that thing.
    pub(super) carriers: BTreeMap<ReplicaId, ReplicaId>,
    /// The map as surveyed, of what differs from it.
    basis: Option<Arc<Self>>,
    /// The moment whose zones are in force; of a map as surveyed none, where those are that have no time.
    moment: Option<Timestamp>,
    /// Where what follows from the map is kept for the next start.
    pub(super) derived: Option<Derived>,
    pub(super) relations: OnceLock<Arc<Relations>>,
    pub(super) floors: OnceLock<Arc<Floors>>,
    /// The nouns, for questions.
    pub(super) mind: OnceLock<Arc<Mind>>,
    /// The words of its values, for the grammar.
    pub(super) words: OnceLock<Arc<MapWords>>,
    /// The names in all their forms, for commands.
    pub(super) forms: OnceLock<Arc<FormIndex<Entity>>>,
    /// The names as the world spells them.
    pub(super) names: OnceLock<NameIndex>,
}

impl Known {
    /// A map; nothing is derived yet.
    pub(super) fn surveyed(rules: Arc<Rules>, world: Arc<World>, derived: Option<Derived>) -> Self {
        Self {
            rules,
            uncarried: Arc::clone(&world),
            world,
            holders: BTreeMap::new(),
            carriers: BTreeMap::new(),
            basis: None,
            moment: None,
            derived,
            relations: OnceLock::new(),
            floors: OnceLock::new(),
            mind: OnceLock::new(),
            words: OnceLock::new(),
            forms: OnceLock::new(),
            names: OnceLock::new(),
        }
    }

    /// The same map with what a robot did and saw; of `world` those in `holders` are carried.
    ///
    /// # Errors
    /// A rule of the user's own outgrows the memory.
    pub(super) fn now(
        basis: &Arc<Self>,
        mut world: World,
        holders: BTreeMap<ReplicaId, String>,
        carriers: BTreeMap<ReplicaId, ReplicaId>,
        moment: Timestamp,
    ) -> Result<Self, Error> {
        let gone: Vec<_> = holders.keys().filter_map(|id| world.replicas.remove(id)).collect();
        let uncarried = Arc::new(world.clone());
        let relations = basis.followed(&uncarried)?.shared();
        world.replicas.extend(gone.into_iter().map(|replica| (replica.id, replica)));
        let known = Self::surveyed(Arc::clone(&basis.rules), Arc::new(world), None);
        Ok(Self {
            uncarried,
            holders,
            carriers,
            basis: Some(Arc::clone(basis)),
            moment: Some(moment),
            relations: relations.into(),
            ..known
        })
    }

    /// The same with what the robot knows beside the world. Floors that were made stay where the same openings join.
    ///
    /// # Errors
    /// As [`Self::relations`].
    pub(super) fn told(mut self, told: &Told) -> Result<Self, Error> {
        let mut relations = Relations::clone(self.relations()?);
        relations.tell(&self.world, told)?;
        if **relations.openings() != *self.openings()? {
            self.floors.take();
        }
        self.relations = Arc::new(relations).into();
        Ok(self)
    }

    /// The same, where doors and zones are others for the one who drives.
    pub(super) fn driven_otherwise(&self, world: World, floors: Floors) -> Self {
        let floors = OnceLock::from(Arc::new(floors));
        Self { world: Arc::new(world), floors, ..self.clone() }
    }

    pub(super) fn world(&self) -> &World {
        &self.world
    }

    /// The world without what is carried.
    pub(super) fn uncarried(&self) -> &World {
        &self.uncarried
    }

    /// What is carried by itself, with who has it; an empty name for the robot.
    fn carried(&self) -> impl Iterator<Item = (&Replica, &String)> {
        let alone = self.holders.iter().filter(|(thing, _)| !self.carriers.contains_key(thing));
        alone.filter_map(|(thing, holder)| Some((self.world.replicas.get(thing)?, holder)))
    }

    /// What the robot holds.
    pub(super) fn held(&self) -> Option<&Replica> {
        self.carried().find(|(_, holder)| holder.is_empty()).map(|(thing, _)| thing)
    }

    /// What was handed over, with the people's names.
    pub(super) fn handed_over(&self) -> Vec<(Replica, String)> {
        let given = self.carried().filter(|(_, holder)| !holder.is_empty());
        given.map(|(thing, holder)| (thing.clone(), holder.clone())).collect()
    }

    /// What lies on or in what is carried, each with the thing with which it goes.
    pub(super) fn aboard(&self) -> Vec<(Replica, ReplicaId)> {
        let laid = self.carriers.iter();
        laid.filter_map(|(thing, on)| Some((self.world.replicas.get(thing)?.clone(), *on)))
            .collect()
    }

    /// The moment of which it is known; this one where nothing depends on it.
    pub(super) fn moment(&self) -> Timestamp {
        self.moment.unwrap_or_else(|| std::time::SystemTime::now().into())
    }

    /// Whether a zone is in force: at its moment, or on the map as surveyed.
    pub(super) fn is_in_force(&self, zone: &Zone) -> bool {
        self.moment.map_or(zone.is_standing(), |moment| zone.is_in_force(moment))
    }

    /// The relations that hold, derived when first asked for.
    ///
    /// # Errors
    /// A rule of the user's own outgrows the memory.
    pub(super) fn relations(&self) -> Result<&Relations, Error> {
        self.shared_relations().map(|relations| &**relations)
    }

    pub(super) fn shared_relations(&self) -> Result<&Arc<Relations>, Error> {
        if let Some(relations) = self.relations.get() {
            return Ok(relations);
        }
        let begun = Instant::now();
        let kept = self.kept_relations(&self.world);
        let is_kept = kept.is_some();
        let relations = match kept {
            Some(relations) => relations,
            None => {
                let profile = self.world.domain.profile;
                let relations = derive(&self.world, &self.rules.relations, profile)?;
                self.keep_relations(&relations);
                relations
            }
        };
        tracing::info!(is_kept, ms = begun.elapsed().as_millis() as u64, "relations");
        Ok(self.relations.get_or_init(|| Arc::new(relations)))
    }

    /// The relations of a world that differs from this in what a robot can do or see: followed where they can be, else
    /// derived anew.
    ///
    /// # Errors
    /// As [`Self::relations`].
    pub(super) fn followed(&self, world: &World) -> Result<Followed, Error> {
        let mut followed = self.to_follow()?;
        followed.of(world)?;
        Ok(followed)
    }

    /// The relations that hold, to be followed from here.
    ///
    /// # Errors
    /// As [`Self::relations`].
    pub(super) fn to_follow(&self) -> Result<Followed, Error> {
        let relations = Arc::clone(self.shared_relations()?);
        Ok(Followed::new(Arc::clone(&self.uncarried), relations))
    }

    /// The free floor of a Map, and of those to which lifts lead.
    ///
    /// # Errors
    /// As [`Self::relations`].
    pub(super) fn floors_from(&self, map: MapId) -> Result<Floors, Error> {
        let leads = |other: &MapId| *other == map || !self.world.domain.lifts.is_empty();
        let floors = self.floors()?.iter().filter(|(other, _)| leads(other));
        Ok(floors.map(|(map, floor)| (*map, floor.clone())).gather())
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

    /// All doors and passages, each once, with what the rules let them join.
    ///
    /// # Errors
    /// As [`Self::relations`].
    pub(super) fn openings(&self) -> Result<&Openings, Error> {
        Ok(self.relations()?.openings())
    }

    /// The free floor of every map, which leads through what the rules let join.
    ///
    /// # Errors
    /// As [`Self::relations`].
    pub(super) fn floors(&self) -> Result<&Floors, Error> {
        if let Some(floors) = self.floors.get() {
            return Ok(floors);
        }
        let (openings, world) = (self.openings()?, &self.world);
        let begun = Instant::now();
        // Rules of the user's own may let doors join by what stands about.
        let basis = self
            .basis
            .as_ref()
            .filter(|basis| basis.openings().is_ok_and(|surveyed| surveyed == openings));
        let mut floors = match basis {
            Some(basis) => {
                let mut floors = basis.floors()?.clone();
                floors.values_mut().for_each(|floor| floor.follow(&basis.world, &self.uncarried));
                floors
            }
            None => {
                world.maps.keys().map(|&map| (map, self.floor_of(world, openings, map))).collect()
            }
        };
        if let Some(moment) = self.moment
            && world.zones.values().any(|zone| !zone.is_standing())
        {
            for floor in floors.values_mut() {
                *floor = floor.with_zones(world, |zone| zone.is_in_force(moment));
            }
        }
        tracing::info!(maps = floors.len(), ms = begun.elapsed().as_millis() as u64, "floors");
        Ok(self.floors.get_or_init(|| Arc::new(floors)))
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

    /// The nouns, read when first asked for.
    pub(super) fn mind(&self) -> &Mind {
        self.mind.get_or_init(|| Arc::new(Mind::of(&self.world, self.rules.paraphrases())))
    }

    /// The words of the map's values, declined when first asked for.
    pub(super) fn words(&self) -> &MapWords {
        self.words.get_or_init(|| Arc::new(MapWords::of(&self.mind().lexicon)))
    }

    /// Every name in every form, indexed when first asked for.
    pub(super) fn forms(&self) -> &FormIndex<Entity> {
        self.forms.get_or_init(|| Arc::new(form_index(&self.world)))
    }

    /// Who bears which name, looked up when first asked for.
    pub(super) fn names(&self) -> &NameIndex {
        self.names.get_or_init(|| NameIndex::of(&self.world))
    }

    pub(super) fn floor(&self, map: MapId) -> Result<&FloorPlan, Error> {
        Ok(self.floors()?.get(&map).expect("every map of the world has a floor"))
    }
}
