//! Edits of the map (M11): checked as a whole, one transaction each, with the relations and the free floor in step.
//!
//! **Invariant.** After an edit, relations and floors are those that deriving anew from the edited map would give.

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::geometry::Openings;
use crate::map::{self, EditReading, Edits, MapErrors, NameIndex, Naming, NextIds, Replica, World};
use crate::semantics::load;
use crate::store::{self, Change, Changes, Difference, ImportReport, Store};
use crate::units::{DoorId, ReplicaId, Timestamp};

use super::known::{Floors, Known};
use super::{Engine, Error, Relations, State};

/// Whether an edit is made or only tried.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mode {
    Commit,
    /// Everything is checked and the differences are told; nothing is written.
    DryRun,
}

/// What an edit did, or would do.
#[derive(Debug, Clone)]
pub struct Edited {
    /// In the words of a person: `Display` of each is a Russian sentence.
    pub differences: Vec<Difference>,
    /// Warnings that the map did not have before.
    pub warnings: MapErrors,
    /// What stood on a thing that was moved without its load, and so stayed.
    pub left_behind: Vec<String>,
    /// The transaction; none for a trial, and without a store.
    pub report: Option<ImportReport>,
}

/// Beyond so many changed records, deriving all relations anew costs less than following each change.
const MOST_FOLLOWED: usize = 100;

impl State {
    /// The faults that a map did not have before.
    fn check_news(&self, before: &World, after: &World) -> MapErrors {
        let known = || match &self.surveyed {
            Some(known) => known.names().clone(),
            None => NameIndex::of(before),
        };
        MapErrors { source: None, faults: map::news(before, after, known) }
    }
}

impl Engine {
    /// Works edits into the map, or into an empty one: values, or what a text tells of them ([`Edits::read`]). A reason in the
    /// text counts where `change` has none.
    ///
    /// # Errors
    /// All faults of the text and of the map that it would make; the map is then as it was.
    pub fn edit(&mut self, edits: &Edits, change: &Change, mode: Mode) -> Result<Edited, Error> {
        let nothing = (World::empty(), NameIndex::default());
        let known = self.surveyed.as_ref().map(|known| (known.world(), known.names()));
        let (world, exact) = known.unwrap_or((&nothing.0, &nothing.1));
        let ids = self.next_ids(world)?;
        let in_other_words = |name: &str| {
            let hits = self.surveyed.as_ref().map(|known| known.forms().find(name));
            hits.into_iter().flatten().map(|hit| *hit.id).collect()
        };
        let naming = Naming { exact, in_other_words: &in_other_words };
        let EditReading { world: edited, faults, reason, carriers } =
            map::edit(world, edits, &ids, naming);
        let Some(edited) = edited else { return Err(faults.into()) };
        let reason = reason.filter(|_| change.reason.is_empty());
        let change =
            Change { reason: reason.unwrap_or_else(|| change.reason.clone()), ..change.clone() };
        let (after, faults, left_behind) = self.with_loads(edited, faults, &carriers)?;
        let edited = self.become_world(after, faults, &change, mode)?;
        let name =
            |id: &ReplicaId| self.surveyed.as_ref()?.world.replicas.get(id).map(|r| r.name.clone());
        let left_behind = left_behind.iter().filter_map(name).collect();
        Ok(Edited { left_behind, ..edited })
    }

    /// Loads of what an edit moved follow where it says so; the map that they make is checked like any.
    fn with_loads(
        &self,
        mut after: World,
        warnings: MapErrors,
        carriers: &BTreeSet<ReplicaId>,
    ) -> Result<(World, MapErrors, Vec<ReplicaId>), Error> {
        let Some(before) = self
            .surveyed
            .as_ref()
            .map(|known| known.world())
            .filter(|before| before.replicas != after.replicas)
        else {
            return Ok((after, warnings, Vec::new()));
        };
        let left_behind = load::carry(before, self.relations()?, carriers, &mut after);
        if carriers.is_empty() {
            return Ok((after, warnings, left_behind));
        }
        let faults = self.check_news(before, &after);
        if faults.has_errors() {
            return Err(faults.into());
        }
        Ok((after, faults, left_behind))
    }

    /// Edits the map as a value: `alter` changes a copy, which is then checked as a whole. New records take their
    /// ids from [`Engine::next_ids`].
    ///
    /// # Errors
    /// All faults of the map that the edit would make; the map is then as it was.
    pub fn edit_world(
        &mut self,
        change: &Change,
        mode: Mode,
        alter: impl FnOnce(&mut World),
    ) -> Result<Edited, Error> {
        let nothing = World::empty();
        let before = self.surveyed.as_ref().map(|known| known.world()).unwrap_or(&nothing);
        let mut after = before.clone();
        alter(&mut after);
        let faults = self.check_news(before, &after);
        if faults.has_errors() {
            return Err(faults.into());
        }
        self.become_world(after, faults, change, mode)
    }

    /// The ids for new records: none is ever given twice, not even that of something gone.
    ///
    /// # Errors
    /// The store cannot be read.
    pub fn next_ids(&self, world: &World) -> Result<NextIds, Error> {
        let Some(store) = &self.store else { return Ok(NextIds::after(world)) };
        Ok(store::next_ids(world, |table| store.next_id(table))?)
    }

    fn become_world(
        &mut self,
        after: World,
        warnings: MapErrors,
        change: &Change,
        mode: Mode,
    ) -> Result<Edited, Error> {
        let known = self.surveyed.as_ref().map(|known| Arc::clone(&known.world));
        let had_map = known.is_some();
        let before = known.unwrap_or_else(|| Arc::new(World::empty()));
        let changes = Changes::between(&before, &after)?;
        let differences = changes.told();
        if mode == Mode::DryRun {
            return Ok(Edited { differences, warnings, left_behind: Vec::new(), report: None });
        }
        let report = match &mut self.store {
            Some(store) if had_map => Some(store.commit_changes(&changes, change)?),
            // What a map has in common with the empty one is new to the store all the same.
            Some(store) => Some(store.commit(&after, change)?),
            None => None,
        };
        self.follow(after)?;
        Ok(Edited { differences, warnings, left_behind: Vec::new(), report })
    }

    /// Takes over a new state of the map. What was derived follows what changed; where too much did, it is derived anew when
    /// it is asked for.
    pub(super) fn follow(&mut self, after: World) -> Result<(), Error> {
        self.next();
        let state = Arc::get_mut(&mut self.state).expect("made so by the line before");
        state.follow(after, &mut self.spares);
        state.stand_on(self.store.as_ref());
        Ok(())
    }

    /// Lets zones begin and end: what is asked from now on is asked of the world as it is at this moment.
    pub fn pass_time(&mut self, at: Timestamp) {
        if self.state.is_outlived(at) {
            self.next();
            let state = Arc::get_mut(&mut self.state).expect("made so by the line before");
            state.forget_present();
        }
    }

    /// The state that is to follow, and the store.
    pub(super) fn next_with_store(&mut self) -> (&mut State, Option<&Store>) {
        self.next();
        let state = Arc::get_mut(&mut self.state).expect("made so by the line before");
        (state, self.store.as_ref())
    }
}

/// What followed the map before, and was left to those who still ask it: the next edit takes it up when they are done,
/// brings it to the map as it then is, and need not copy what others have.
#[derive(Debug, Default)]
pub(super) struct Spares {
    relations: Option<Spare<Relations>>,
    floors: Option<Spare<Floors>>,
    /// Through which the spare floors lead.
    openings: Option<Arc<Openings>>,
}

/// What followed from a map.
#[derive(Debug)]
struct Spare<T> {
    of: Arc<World>,
    what: Arc<T>,
}

impl<T: Clone> Spare<T> {
    /// Makes what follows from `before`, and others may have, one's own: the spare one, if nobody has that any more and
    /// it can follow to `after`; else a copy. Returns the map of which it is.
    fn own(
        spare: &mut Option<Self>,
        shared: &mut Arc<T>,
        before: &Arc<World>,
        after: &World,
    ) -> Arc<World> {
        if Arc::get_mut(shared).is_some() {
            return Arc::clone(before);
        }
        let is_near = |of: &World| of.count_changes(after) <= MOST_FOLLOWED;
        let fits = |spare: &Self| Arc::strong_count(&spare.what) == 1 && is_near(&spare.of);
        let own = spare.take().filter(fits);
        let Self { of, what } = own
            .unwrap_or_else(|| Self { of: Arc::clone(before), what: Arc::new(T::clone(shared)) });
        *spare = Some(Self { of: Arc::clone(before), what: std::mem::replace(shared, what) });
        of
    }
}

impl State {
    /// Takes over another map; what other states share with this one stays as it is for them.
    fn follow(&mut self, after: World, spares: &mut Spares) {
        let after = Arc::new(after);
        // What rests on the map as it was would make a copy of what follows it.
        self.forget_present();
        let Some(surveyed) = &mut self.surveyed else {
            self.changes = Arc::default();
            let (rules, derived) = (Arc::clone(&self.rules), self.derived.clone());
            self.surveyed = Some(Arc::new(Known::surveyed(rules, after, derived)));
            return;
        };
        let before = Arc::clone(&surveyed.world);
        let changed = only_things(&before, &after);
        let ids_are_unique = self.reader.is_some();
        // A door that stands otherwise may be spoken of in other words.
        let things = changed.as_ref().filter(|(_, doors)| doors.is_empty()).map(|(ids, _)| &**ids);
        Arc::make_mut(&mut self.changes).note(&before, &after, things, ids_are_unique);
        let things = changed.as_ref().map(|(ids, _)| &**ids);
        Arc::make_mut(surveyed).follow(&before, &after, things, spares);
    }
}

impl Known {
    /// Takes over an edited map; `things` are the replicas that differ, where nothing else does but the states of doors.
    fn follow(
        &mut self,
        before: &Arc<World>,
        after: &Arc<World>,
        things: Option<&[ReplicaId]>,
        spares: &mut Spares,
    ) {
        let told_alike = before.doors == after.doors
            && things.is_some_and(|ids| {
                ids.iter().all(|id| is_told_alike(before.replicas.get(id), after.replicas.get(id)))
            });
        if let Some(mind) = self.mind.take().filter(|_| told_alike) {
            self.mind = Arc::new(mind.renewed()).into();
        }
        if !told_alike {
            self.forms.take();
        }
        if things.is_none() {
            self.words.take();
        }
        if let Some(names) = self.names.get_mut() {
            names.follow(before, after);
        }
        (self.world, self.uncarried) = (Arc::clone(after), Arc::clone(after));
        let mut followed = before.count_changes(after) <= MOST_FOLLOWED;
        let mut led = None;
        if let Some(relations) = self.relations.get_mut().filter(|_| followed) {
            led = Some(Arc::clone(relations.openings()));
            let of = Spare::own(&mut spares.relations, relations, before, after);
            let relations = Arc::get_mut(relations).expect("made one's own by the line before");
            // A rule that fails now fails again, and is told, when they are derived anew.
            followed = relations.follow_world(&of, after).unwrap_or(false);
        }
        if !followed {
            self.relations.take();
        }
        if !self.follow_floors(before, after, led, spares) {
            self.floors.take();
        }
    }

    /// Brings the floors, which were `led` through these openings, to an edited map; not where they are to be built anew.
    fn follow_floors(
        &mut self,
        before: &Arc<World>,
        after: &Arc<World>,
        led: Option<Arc<Openings>>,
        spares: &mut Spares,
    ) -> bool {
        let Some(floors) = self.floors.get_mut() else { return true };
        if !before.maps.keys().eq(after.maps.keys()) {
            return false;
        }
        let is_shared = Arc::get_mut(floors).is_none();
        let of = Spare::own(&mut spares.floors, floors, before, after);
        // What the spare floors lead through changes hands when they do.
        let was_led = match is_shared {
            true => std::mem::replace(&mut spares.openings, led.clone()),
            false => None,
        };
        let through = if Arc::ptr_eq(&of, before) { led } else { was_led };
        let now = self.relations.get().map(|relations| relations.openings());
        let mut floors =
            Arc::get_mut(floors).expect("made one's own by the line before").values_mut();
        let leads_as_before = match (&through, now) {
            (Some(through), Some(now)) => Arc::ptr_eq(through, now) || through == now,
            (_, now) => now.is_none(),
        };
        if leads_as_before && of.is_same_building(after) {
            floors.for_each(|floor| floor.follow(&of, after));
            return true;
        }
        let Some(now) = now else { return false };
        let now = (!leads_as_before).then_some(&**now);
        floors.all(|floor| floor.follow_building(&of, after, now))
    }
}

/// The replicas and the doors that differ between two worlds of one building; none when more does.
fn only_things(before: &World, after: &World) -> Option<(Vec<ReplicaId>, Vec<DoorId>)> {
    before.is_same_building(after).then(|| {
        let replicas = before.replicas.changes(&after.replicas).into_iter();
        let doors = before.doors.changes(&after.doors).into_iter();
        (replicas.map(|(id, ..)| id).collect(), doors.map(|(id, ..)| id).collect())
    })
}

/// Whether two states of a thing are spoken of in the same words: it was put elsewhere at the most.
fn is_told_alike(was: Option<&Replica>, is: Option<&Replica>) -> bool {
    let (Some(was), Some(is)) = (was, is) else { return false };
    let (area, frame, move_prob) = (is.area, is.frame, is.move_prob);
    *is == Replica { area, frame, move_prob, ..was.clone() }
}
