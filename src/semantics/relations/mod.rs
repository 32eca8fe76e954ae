//! Relations of a world, derived by the rule text from what was measured (SPEC R).

mod building;
mod follow;
mod lookup;
mod questions;
mod rows;
mod rules;
mod tell;

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::facts::{Live, Value};
use crate::map::{Entity, Profile, World};
use crate::units::{AreaId, DoorId, OpeningId, ReplicaId};

use super::feed::{Cell, Feed, Sink};
use super::measure::Measurements;
use super::names::{Subject, Symbols};
use super::openings::openings;
use super::thresholds::Thresholds;
use crate::geometry::Openings;

pub use follow::Followed;
use rows::{Load, note, tuple};
pub use rules::{RelationError, RelationRules, STANDARD};

/// With more pairs than this, what updates need is prepared beforehand: deriving takes longer than that anyway.
const MANY_PAIRS: usize = 5_000;

/// How often a relation holds.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RelationCount {
    pub name: String,
    pub name_en: String,
    pub count: usize,
}

/// A door or passage with the Areas that it joins, once for each direction.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub struct Join {
    /// Its name in the facts: the door's, or one made for a passage without a name.
    pub opening: String,
    /// The first of this name; none for one that only rules speak of.
    pub id: Option<OpeningId>,
    pub door: Option<DoorId>,
    pub from: AreaId,
    pub to: AreaId,
}

/// Everything derived from one state of a world.
#[derive(Debug, Clone)]
pub struct Relations {
    rules: RelationRules,
    profile: Profile,
    symbols: Symbols,
    measured: Measurements,
    openings: Arc<Openings>,
    live: Live,
    thresholds: Thresholds,
    /// What a robot told, as it stands among the rows.
    told: BTreeSet<(&'static str, Vec<Value>)>,
    /// Each thing with the Areas in which it is.
    areas: BTreeSet<(ReplicaId, AreaId)>,
    supports: BTreeMap<ReplicaId, ReplicaId>,
    /// The same from below: what bears, and what it bears.
    loads: BTreeSet<(ReplicaId, ReplicaId)>,
    /// What has something on top of it, and what that is.
    bearing: BTreeSet<(ReplicaId, ReplicaId)>,
    /// Each Area with what stands on its floor.
    on_floor: BTreeSet<(AreaId, ReplicaId)>,
}

/// Measures a world and derives its relations.
///
/// # Errors
/// [`RelationError::Schema`] when the rule text changed a measured relation, [`RelationError::Evaluate`] when a rule of
/// the user's own outgrows the memory.
pub fn derive(
    world: &World,
    rules: &RelationRules,
    profile: Profile,
) -> Result<Relations, RelationError> {
    let measured = Measurements::of(world, rules.reach());
    derive_from(world, rules, profile, measured)
}

/// Derives the relations of a world that was measured before.
///
/// # Errors
/// As [`derive()`].
pub fn derive_from(
    world: &World,
    rules: &RelationRules,
    profile: Profile,
    measured: Measurements,
) -> Result<Relations, RelationError> {
    let symbols = Symbols::of(world);
    let openings = openings(world, rules.step_reach(), &symbols);
    let feed = Feed { world, symbols: &symbols, measured: &measured, openings: &openings };
    let mut database = rules.program().database();
    let mut rows = Load::new(rules.program(), &mut database);
    rows.row("profile", &[Cell::Word(profile.name())]);
    feed.ground(&mut rows);
    feed.things(&mut rows);
    if measured.asks_of_all() {
        for body in measured.bodies.values() {
            let map = symbols.symbol(Subject::Entity(Entity::Map(body.map)));
            rows.row("asked", &[Cell::Name(symbols.replica(body.id)), Cell::Name(map)]);
        }
    }
    rows.finish().map_err(|fault| RelationError::Schema { fault })?;
    let mut live = Live::new(rules.program().clone(), database)?;
    if measured.pair_count() > MANY_PAIRS {
        live.prepare();
    }
    Ok(Relations::new(rules, profile, symbols, measured, openings, live))
}

impl Relations {
    /// What was derived as bytes, for [`Relations::restore`].
    #[must_use]
    pub fn save(&self) -> Option<Vec<u8>> {
        let mut bytes = saved_head(self.profile);
        bytes.extend(self.live.save()?);
        Some(bytes)
    }

    /// What [`Relations::save`] saved of the same world under the same rules, derived no more; none where the bytes are
    /// of other rules, or broken. Whoever keeps the bytes knows of which state of the world they are.
    #[must_use]
    pub fn restore(
        world: &World,
        rules: &RelationRules,
        profile: Profile,
        bytes: &[u8],
    ) -> Option<Self> {
        let live = Live::restore(rules.program(), bytes.strip_prefix(&*saved_head(profile))?)?;
        let symbols = Symbols::of(world);
        let measured = Measurements::of_things(world, rules.reach());
        let openings = openings(world, rules.step_reach(), &symbols);
        Some(Self::new(rules, profile, symbols, measured, openings, live))
    }

    fn new(
        rules: &RelationRules,
        profile: Profile,
        symbols: Symbols,
        measured: Measurements,
        openings: Openings,
        live: Live,
    ) -> Self {
        let told = live.derived().tuples("threshold").into_iter().flatten();
        let told = told.filter_map(|t| Some((t.symbol(0)?.to_owned(), t.number(1)?)));
        let thresholds = Thresholds::of(told);
        let mut relations = Self {
            thresholds,
            rules: rules.clone(),
            profile,
            symbols,
            measured,
            openings: Arc::new(openings),
            live,
            told: BTreeSet::new(),
            areas: BTreeSet::new(),
            supports: BTreeMap::new(),
            loads: BTreeSet::new(),
            bearing: BTreeSet::new(),
            on_floor: BTreeSet::new(),
        };
        relations.index();
        relations.decide_openings(None);
        relations
    }
}

/// What stands before saved relations: another version of this crate may measure otherwise.
fn saved_head(profile: Profile) -> Vec<u8> {
    format!("{} {}\n", env!("CARGO_PKG_VERSION"), profile.name()).into_bytes()
}

impl Relations {
    /// Follows a move of one replica: measures it anew and derives what follows, with the same result as [`derive()`].
    ///
    /// A replica that was added, removed, renamed or made of another Object needs [`derive()`]; `false` says so, and
    /// nothing is changed.
    ///
    /// # Errors
    /// As [`derive()`].
    pub fn update(&mut self, world: &World, moved: ReplicaId) -> Result<bool, RelationError> {
        let known = self.measured.of_thing(moved).map(|s| s.object);
        let now = world.replicas.get(&moved);
        let same_name =
            now.is_some_and(|r| r.name.as_str() == self.symbols.replica(moved).as_ref());
        if known.is_none() || known != now.map(|r| r.object) || !same_name {
            return Ok(false);
        }
        let change = self.measured.update(world, moved);
        let feed = Feed {
            world,
            symbols: &self.symbols,
            measured: &self.measured,
            openings: &self.openings,
        };
        let (live, mut fault) = (&mut self.live, None);
        let mut take = |relation: &'static str, cells: &[Cell<'_>]| {
            if let Err(e) = live.remove(relation, &tuple(cells)) {
                note(&mut fault, e);
            }
        };
        change.single_before.iter().for_each(|s| feed.single(moved, s, &mut take));
        change.removed.iter().for_each(|(&key, pair)| feed.pair(key, pair, &mut take));
        let mut put = |relation: &'static str, cells: &[Cell<'_>]| {
            if let Err(e) = live.insert(relation, &tuple(cells)) {
                note(&mut fault, e);
            }
        };
        change.single_after.iter().for_each(|s| feed.single(moved, s, &mut put));
        for key in &change.added {
            if let Some(pair) = self.measured.pairs().get(key) {
                feed.pair(*key, pair, &mut put);
            }
        }
        if let Some(fault) = fault {
            return Err(RelationError::Schema { fault });
        }
        self.live.update()?;
        self.follow(BTreeSet::new());
        Ok(true)
    }
}
