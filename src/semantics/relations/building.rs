//! From the relations of one building to those of an edited one: rooms and doors built, rebuilt and taken away, kinds of
//! things and their parts, links, names.
//!
//! **Invariant**: afterwards the derived relations are those that [`derive()`](super::derive) gives of the edited world.
//! What was measured of an Area or an Object that changed, and of every thing near it, is measured anew, and of them alone;
//! so are openings that its sides may make.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::facts::Value;
use crate::feed::{Cell, Feed};
use crate::geometry::{OpenSide, Opening, Openings};
use crate::map::{Area, Entity, Object, Orthoframe, World};
use crate::measure::{Change, Room, asks_of_all};
use crate::names::Subject;
use crate::openings::call;
use crate::units::{AreaId, DoorId, Frame, Gather as _, MapId, ObjectId, OrFrId, ReplicaId};

use super::follow::Difference;
use super::rows::tuple;
use super::{RelationError, Relations};

/// Beyond so many things that are to be measured anew, measuring all costs less.
const MOST_MEASURED: usize = 500;

/// What differs between two buildings.
#[derive(Default)]
struct Touched {
    parts: BTreeSet<OrFrId>,
    objects: BTreeSet<ObjectId>,
    areas: BTreeSet<AreaId>,
    doors: BTreeSet<DoorId>,
    /// Of the Objects those of which every thing is another now.
    remade: BTreeSet<ObjectId>,
    /// Of the Areas those that are bounded otherwise or stand elsewhere.
    reshaped: BTreeSet<AreaId>,
    /// The same, and those that bear another name.
    rebuilt: BTreeSet<AreaId>,
    /// Where those stand that are asked for, as far as it is known.
    places: RefCell<BTreeMap<AreaId, Option<(MapId, Frame)>>>,
    /// Whether openings may be others.
    opens: bool,
    /// Whether they may be called otherwise.
    calls: bool,
}

impl Touched {
    fn between(before: &World, after: &World) -> Self {
        let mut touched = Self::default();
        let mut remade_parts = BTreeSet::new();
        for (id, was, is) in before.orthoframes.changes(&after.orthoframes) {
            touched.parts.insert(id);
            let same = |(was, is): (&Orthoframe, &Orthoframe)| {
                let (name_en, description) = (was.name_en.clone(), was.description.clone());
                let properties = was.properties.clone();
                *was == Orthoframe { name_en, description, properties, ..is.clone() }
            };
            if !was.zip(is).is_some_and(same) {
                remade_parts.insert(id);
            }
        }
        touched.objects(before, after, &remade_parts);
        touched.areas(before, after, &remade_parts);
        for (id, was, is) in before.doors.changes(&after.doors) {
            touched.doors.insert(id);
            touched.opens |= was.zip(is).is_none_or(|(was, is)| {
                (was.width, was.height, was.kind, &was.leaves)
                    != (is.width, is.height, is.kind, &is.leaves)
            });
            touched.calls |=
                was.zip(is).is_none_or(|(was, is)| (&was.name, &was.key) != (&is.name, &is.key));
        }
        touched.opens |= before.maps != after.maps;
        touched.calls |= !touched.rebuilt.is_empty();
        touched
    }

    /// Where an Area stands now: the last of its places, as in [`World::placements`].
    fn place(&self, after: &World, area: AreaId) -> Option<(MapId, Frame)> {
        *self.places.borrow_mut().entry(area).or_insert_with(|| {
            let mut maps = after.maps.values().rev();
            maps.find_map(|map| {
                let item = map.items.iter().rev().find(|item| item.area == area)?;
                Some((map.id, item.frame))
            })
        })
    }

    fn objects(&mut self, before: &World, after: &World, parts: &BTreeSet<OrFrId>) {
        let changed = before.objects.changes(&after.objects).into_iter();
        self.objects = changed.map(|(id, ..)| id).collect();
        for world in [before, after].into_iter().filter(|_| !parts.is_empty()) {
            let made = world.objects_made_of(|part| parts.contains(&part));
            self.remade.extend(made.map(|object| object.id));
        }
        let types = [&before.types.object, &after.types.object];
        if types[0] != types[1] {
            let is_other = |o: &&Object| types[0].get(o.object_type) != types[1].get(o.object_type);
            self.remade.extend(after.objects.values().filter(is_other).map(|o| o.id));
        }
        for id in &self.objects {
            let same = |(was, is): (&Object, &Object)| {
                let (name_en, description) = (was.name_en.clone(), was.description.clone());
                let (properties, links) = (was.properties.clone(), was.links.clone());
                *was == Object { name_en, description, properties, links, ..is.clone() }
            };
            if !before.objects.get(id).zip(after.objects.get(id)).is_some_and(same) {
                self.remade.insert(*id);
            }
        }
        self.objects.extend(&self.remade);
    }

    fn areas(&mut self, before: &World, after: &World, parts: &BTreeSet<OrFrId>) {
        let changed = before.areas.changes(&after.areas).into_iter();
        self.areas = changed.map(|(id, ..)| id).collect();
        let items = before.items_changed(after);
        let placed = |at: usize| -> BTreeMap<AreaId, (MapId, Frame)> {
            let items =
                items.iter().flat_map(|(map, items)| items[at].iter().map(move |i| (map, i)));
            items.map(|(map, item)| (item.area, (*map, item.frame))).gather()
        };
        let (old, new) = (placed(0), placed(1));
        let all = old.keys().chain(new.keys());
        self.reshaped.extend(all.filter(|id| old.get(id) != new.get(id)));
        for world in [before, after].into_iter().filter(|_| !parts.is_empty()) {
            let made = world.areas_made_of(|part| parts.contains(&part));
            self.reshaped.extend(made.map(|area| area.id));
        }
        for id in &self.areas {
            let both = before.areas.get(id).zip(after.areas.get(id));
            let made = |(was, is): (&Area, &Area)| was.items == is.items && was.doors == is.doors;
            let called = |(was, is): (&Area, &Area)| was.name == is.name && was.key == is.key;
            if !both.is_some_and(made) {
                self.reshaped.insert(*id);
            } else if !both.is_some_and(called) {
                self.rebuilt.insert(*id);
            }
        }
        self.opens |= !self.reshaped.is_empty();
        self.rebuilt.extend(&self.reshaped);
        self.areas.extend(&self.rebuilt);
    }

    /// All that may have another symbol, but for the replicas that stay.
    fn subjects(&self, before: &World, after: &World) -> Vec<Subject> {
        let entity = Subject::Entity;
        let areas = self.areas.iter().map(|id| entity(Entity::Area(*id)));
        let doors = self.doors.iter().map(|id| entity(Entity::Door(*id)));
        let places = before.places.changes(&after.places).into_iter();
        let places = places.map(|(id, ..)| entity(Entity::Place(id)));
        let zones = before.zones.changes(&after.zones).into_iter();
        let zones = zones.map(|(id, ..)| entity(Entity::Zone(id)));
        let maps = before.maps.changes(&after.maps).into_iter();
        let maps = maps.map(|(id, ..)| entity(Entity::Map(id)));
        let objects = self.objects.iter().map(|id| Subject::Object(*id));
        let parts = self.parts.iter().map(|id| Subject::Part(*id));
        let things = before.replicas.changes(&after.replicas).into_iter();
        let gone = things.filter(|(.., is)| is.is_none());
        let gone = gone.map(|(id, ..)| entity(Entity::Replica(id)));
        let all = areas.chain(doors).chain(places).chain(zones).chain(maps);
        all.chain(objects).chain(parts).chain(gone).collect()
    }
}

/// How many Areas stand somewhere.
fn count_placed(world: &World) -> usize {
    let items = world.maps.values().flat_map(|map| &map.items);
    let mut areas: Vec<AreaId> = items.map(|item| item.area).collect();
    areas.sort_unstable();
    areas.dedup();
    areas.len()
}

impl Relations {
    /// Follows to an edited building; `false` where deriving anew is cheaper or safer: these relations are then of neither
    /// world.
    pub(super) fn follow_building(
        &mut self,
        before: &World,
        after: &World,
    ) -> Result<bool, RelationError> {
        let renamed_maps = before.maps.changes(&after.maps).into_iter().any(|(_, was, is)| {
            was.zip(is).is_some_and(|(was, is)| (&was.name, &was.key) != (&is.name, &is.key))
        });
        let touched = Touched::between(before, after);
        let rooms = if touched.rebuilt.is_empty() {
            self.measured.rooms.len()
        } else {
            count_placed(after)
        };
        if before.domain.profile != after.domain.profile
            || renamed_maps
            || !self.told.is_empty()
            || self.measured.asks_of_all() != asks_of_all(after.replicas.len(), rooms)
        {
            return Ok(false);
        }
        let subjects = touched.subjects(before, after).into_iter();
        let Some(mut old) = self.symbols.rename(before, after, subjects) else { return Ok(false) };
        let changed: Vec<ReplicaId> =
            before.replicas.changes(&after.replicas).into_iter().map(|(id, ..)| id).collect();
        let Some(named) = self.named(before, after, &changed) else { return Ok(false) };
        // An opening without a name of its own is called as nothing else is.
        let is_like_opening = |symbol: &Arc<str>| {
            let like = |own: &str| {
                let rest = own.strip_prefix(&**symbol);
                rest.is_some_and(|rest| rest.is_empty() || rest.starts_with('-'))
            };
            self.openings.iter().any(|o| o.door.is_none() && like(&o.name))
        };
        if old.iter().filter_map(|(_, was)| was.as_ref()).any(is_like_opening) {
            return Ok(false);
        }
        let mut new = old.iter().filter_map(|(subject, _)| self.symbols.known(*subject));
        let calls = touched.calls || new.any(is_like_opening);
        let is_renamed = |door: DoorId| touched.doors.contains(&door);
        let new = if touched.opens {
            let (reach, Touched { reshaped, doors, .. }) = (self.rules.step_reach(), &touched);
            let followed = self.openings.follow(before, after, reach, reshaped, doors);
            let mut new = followed.unwrap_or_else(|| Openings::of(after, reach));
            call(&mut new, after, &self.symbols, is_renamed);
            Arc::new(new)
        } else if calls {
            let mut same = Openings::clone(&self.openings);
            call(&mut same, after, &self.symbols, is_renamed);
            Arc::new(same)
        } else {
            Arc::clone(&self.openings)
        };
        let (names, mouths, fresh) = differing(&self.openings, &new, &touched);
        let replicas = self.near_changes(before, after, &touched, &mouths, changed);
        if replicas.len() > MOST_MEASURED {
            return Ok(false);
        }

        // What was: under the symbols of before.
        self.symbols.swap(&mut old);
        let mut rows = Difference::default();
        self.building_rows(before, &touched, &names, &replicas, |rel, row| {
            rows.out.insert((rel, row));
        });
        let mut loose = BTreeSet::new();
        for &id in &replicas {
            if let Some(map) = self.measured.map_of(id) {
                rows.out.insert(self.asked(id, map));
            }
            let mut change = Change::default();
            self.measured.take_away(id, &mut change);
            let feed = self.feed(before);
            let mut put = |rel: &'static str, cells: &[Cell<'_>]| {
                rows.out.insert((rel, tuple(cells)));
            };
            change.single_before.iter().for_each(|s| feed.single(id, s, &mut put));
            change.removed.iter().for_each(|(&key, pair)| feed.pair(key, pair, &mut put));
            loose.extend(change.added);
        }

        // What is.
        self.symbols.swap(&mut old);
        let gone = self.symbols.of_replicas(named.keys());
        named.iter().for_each(|(id, name)| self.symbols.give(*id, name));
        self.openings = new;
        touched.remade.iter().for_each(|&id| self.measured.enter_kind(after, id));
        for &id in &touched.rebuilt {
            match touched.place(after, id) {
                Some(place) => self.measured.enter_room(after, id, place),
                None => self.measured.forget_room(id),
            }
        }
        for &id in &replicas {
            let mut change = Change::default();
            self.measured.put_in_place(after, id, &mut change);
            let feed = self.feed(after);
            let mut put = |rel: &'static str, cells: &[Cell<'_>]| {
                rows.out.insert((rel, tuple(cells)));
            };
            change.removed.iter().for_each(|(&key, pair)| feed.pair(key, pair, &mut put));
            loose.extend(change.added);
        }
        let feed = self.feed(after);
        let mut into: Vec<(&'static str, Vec<Value>)> = Vec::new();
        let mut put = |rel: &'static str, cells: &[Cell<'_>]| into.push((rel, tuple(cells)));
        for id in &replicas {
            self.measured.of_thing(*id).into_iter().for_each(|s| feed.single(*id, s, &mut put));
        }
        for key in loose {
            if let Some(pair) = self.measured.pairs().get(&key) {
                feed.pair(key, pair, &mut put);
            }
        }
        rows.into.extend(into);
        if self.measured.asks_of_all() {
            let mapped = |id: &ReplicaId| Some(self.asked(*id, self.measured.map_of(*id)?));
            rows.into.extend(replicas.iter().filter_map(mapped));
        }
        self.building_rows(after, &touched, &names, &replicas, |rel, row| {
            rows.into.insert((rel, row));
        });
        self.apply(&mut rows)?;
        self.live.update()?;
        self.follow(fresh);
        self.symbols.retire(&gone, |_| false);
        let old: Vec<_> = old.into_iter().filter_map(|(of, was)| Some((of, was?))).collect();
        self.symbols.retire(&old, |subject| match subject {
            Subject::Entity(Entity::Area(id)) => !after.areas.contains_key(&id),
            Subject::Entity(Entity::Door(id)) => !after.doors.contains_key(&id),
            Subject::Entity(Entity::Place(id)) => !after.places.contains_key(&id),
            Subject::Entity(Entity::Zone(id)) => !after.zones.contains_key(&id),
            Subject::Entity(Entity::Map(id)) => !after.maps.contains_key(&id),
            Subject::Entity(Entity::Replica(id)) => !after.replicas.contains_key(&id),
            Subject::Object(id) => !after.objects.contains_key(&id),
            Subject::Part(id) => !after.orthoframes.contains_key(&id),
        });
        Ok(true)
    }

    /// The things of which something is measured otherwise: what changed itself, is of a kind that did, stands in or near
    /// an Area that did, or near an opening that is called otherwise; what goes first.
    fn near_changes(
        &self,
        before: &World,
        after: &World,
        touched: &Touched,
        mouths: &BTreeSet<AreaId>,
        changed: Vec<ReplicaId>,
    ) -> Vec<ReplicaId> {
        let mut replicas: BTreeSet<ReplicaId> = changed.into_iter().gather();
        if !touched.remade.is_empty() || !touched.rebuilt.is_empty() {
            for world in [before, after] {
                let made = world.replicas_of(|kind| touched.remade.contains(&kind));
                let standing = world.replicas_within(|area| touched.rebuilt.contains(&area));
                replicas.extend(made.chain(standing).map(|r| r.id));
            }
        }
        for area in touched.rebuilt.union(mouths) {
            let place = touched.place(after, *area);
            let new = place.and_then(|place| Room::of(after, *area, place));
            for room in self.measured.rooms.get(area).into_iter().chain(&new) {
                replicas.extend(self.measured.things_near(room));
            }
        }
        replicas.into_iter().collect()
    }

    fn feed<'a>(&'a self, world: &'a World) -> Feed<'a> {
        Feed { world, symbols: &self.symbols, measured: &self.measured, openings: &self.openings }
    }

    /// The rows of all that is touched, but for what is measured of things.
    fn building_rows(
        &self,
        world: &World,
        touched: &Touched,
        openings: &BTreeSet<String>,
        replicas: &[ReplicaId],
        mut put: impl FnMut(&'static str, Vec<Value>),
    ) {
        let doors: Vec<DoorId> = touched.doors.iter().copied().collect();
        self.openings_and_properties(world, openings, replicas, &doors, &mut put);
        let mut sink = |rel: &'static str, cells: &[Cell<'_>]| put(rel, tuple(cells));
        let feed = self.feed(world);
        feed.robot(&mut sink);
        touched.areas.iter().for_each(|&id| feed.area(id, &mut sink));
        touched.objects.iter().for_each(|&id| feed.object(id, &mut sink));
        touched.parts.iter().for_each(|&id| feed.part(id, &mut sink));
    }
}

/// The names of openings that are others than they were, or are told of with a rebuilt Area or a changed door; the Areas in
/// whose sides one is another; and the names of those that were measured or called anew.
fn differing(
    before: &Openings,
    after: &Openings,
    touched: &Touched,
) -> (BTreeSet<String>, BTreeSet<AreaId>, BTreeSet<String>) {
    let (mut names, mut areas) = (BTreeSet::new(), BTreeSet::new());
    let own = before.not_shared(after);
    let fresh = own[1].iter().map(|opening| opening.name.clone()).collect();
    for (own, others) in own.into_iter().zip([after, before]) {
        for opening in own {
            let first = opening.sides.first();
            let other = first.and_then(|side| others.of_side(side.area, &side.side));
            if other.is_none_or(|other| !other.is_measured_as(opening)) {
                names.insert(opening.name.clone());
                areas.extend(opening.sides.iter().map(|side| side.area));
            }
        }
    }
    let with = |side: &OpenSide| {
        let met = [side.inward, side.outward].into_iter().flatten().map(|(area, _)| area);
        met.chain(side.linked).chain([side.area]).any(|area| touched.rebuilt.contains(&area))
    };
    let is_told = |opening: &&Opening| {
        opening.door.is_some_and(|door| touched.doors.contains(&door))
            || opening.sides.iter().any(with)
    };
    for openings in [before, after] {
        let is_asked = !touched.rebuilt.is_empty() || !touched.doors.is_empty();
        let told = openings.iter().filter(|_| is_asked).filter(is_told);
        names.extend(told.map(|opening| opening.name.clone()));
    }
    (names, areas, fresh)
}
