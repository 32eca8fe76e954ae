//! What an edit may have made faulty: the records that differ, and those whose faults tell of them.
//!
//! The robot's numbers, the names of types and how the Maps make a Domain are looked at in any case: that costs less than to
//! find out.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use super::Checker;
use crate::fault::Record;
use crate::units::{AreaId, DoorId, Gather as _, MapId, OrFrId, ReplicaId};
use crate::{Door, Entity, Extent, Map, MapLink, NameIndex, Place, Records, TypeKind, World};

/// The part of a map that is to be checked, in the map before an edit and in that after it.
#[derive(Default)]
pub(super) struct Scope<'w> {
    pub(super) records: BTreeSet<Record>,
    pub(super) replicas: BTreeSet<ReplicaId>,
    /// What may have no name.
    pub(super) entities: BTreeSet<Entity>,
    /// Areas with other borders, or that stand elsewhere.
    pub(super) moved: BTreeSet<AreaId>,
    /// Areas that differ in whatever they do.
    areas: BTreeSet<AreaId>,
    /// Handles that a record got or lost, by the kind of records.
    keys: BTreeMap<&'static str, BTreeSet<&'w str>>,
    /// Of Maps how many links at the beginning and at the end are as they were.
    links: BTreeMap<MapId, (usize, usize)>,
    /// Of Maps that got Areas and links and lost none, and whose other Areas are as they were: the Areas that came.
    came: BTreeMap<MapId, BTreeSet<AreaId>>,
    /// Names that something bore or bears now, and who bears them; none where no name changed.
    pub(super) names: Option<(BTreeSet<&'w str>, NameIndex)>,
}

impl<'w> Scope<'w> {
    /// None where all is to be checked.
    pub(super) fn between(before: &'w World, after: &'w World) -> Option<Self> {
        for kind in TypeKind::ALL {
            let [was, is] = [before, after].map(|world| &world.types.list(kind).entries);
            if was.keys().any(|id| !is.contains_key(id)) {
                return None;
            }
        }
        let mut scope = Self::default();
        scope.add_keys(before, after);
        let parts: BTreeSet<OrFrId> =
            before.orthoframes.changes(&after.orthoframes).into_iter().map(|(id, ..)| id).gather();
        scope.records.extend(parts.iter().map(|id| Record::Orthoframe(*id)));
        let doors = before.doors.changes(&after.doors);
        // A door that stands otherwise is no other door.
        let is_other = |was: Option<&Door>, is: Option<&Door>| {
            was.zip(is).is_none_or(|(was, is)| *is != Door { state: is.state, ..was.clone() })
        };
        let hung: BTreeSet<_> =
            doors.iter().filter(|(_, was, is)| is_other(*was, *is)).map(|(id, ..)| *id).gather();
        for (id, ..) in doors {
            scope.records.insert(Record::Door(id));
            scope.entities.insert(Entity::Door(id));
        }
        scope.add_objects(before, after, &parts, &hung);
        scope.add_areas(before, after, &parts, &hung);
        scope.add_maps(before, after);
        for (id, was, is) in before.zones.changes(&after.zones) {
            let _ = (was, is);
            scope.records.insert(Record::Zone(id));
            scope.entities.insert(Entity::Zone(id));
        }
        for zone in before.zones.values().chain(after.zones.values()) {
            let is_met = match &zone.extent {
                Extent::Areas(areas) => areas.iter().any(|area| scope.areas.contains(area)),
                Extent::Polygon { map, .. } => scope.records.contains(&Record::Map(*map)),
            };
            if is_met {
                scope.records.insert(Record::Zone(zone.id));
            }
        }
        for (id, ..) in before.places.changes(&after.places) {
            scope.records.insert(Record::Place(id));
            scope.entities.insert(Entity::Place(id));
        }
        for (id, ..) in before.replicas.changes(&after.replicas) {
            scope.replicas.insert(id);
            scope.entities.insert(Entity::Replica(id));
        }
        scope.add_standing(before, after);
        Some(scope)
    }

    fn add_keys(&mut self, before: &'w World, after: &'w World) {
        macro_rules! note {
            ($($records:ident)*) => {$(
                for (_, was, is) in before.$records.changes(&after.$records) {
                    let [was, is] = [was, is].map(|record| record.map(|r| r.key.as_str()));
                    if was != is {
                        self.keys.entry(stringify!($records)).or_default().extend(was.into_iter().chain(is));
                    }
                }
            )*};
        }
        note!(orthoframes doors objects areas zones);
    }

    /// Objects that differ, and those that tell of such parts and doors.
    fn add_objects(
        &mut self,
        before: &World,
        after: &World,
        parts: &BTreeSet<OrFrId>,
        hung: &BTreeSet<DoorId>,
    ) {
        let changed = before.objects.changes(&after.objects).into_iter();
        let mut all: BTreeSet<_> = changed.map(|(id, ..)| id).gather();
        for world in [before, after] {
            if !parts.is_empty() {
                all.extend(world.objects_made_of(|id| parts.contains(&id)).map(|o| o.id));
            }
            if !hung.is_empty() {
                all.extend(world.objects_hung_with(|id| hung.contains(&id)).map(|o| o.id));
            }
        }
        for id in all {
            self.records.insert(Record::Object(id));
            let both = [before, after].into_iter().filter_map(|world| world.objects.get(&id));
            let doors = both.flat_map(|object| &object.doors).map(|mount| mount.door);
            self.records.extend(doors.map(Record::Door));
        }
    }

    /// The same of Areas.
    fn add_areas(
        &mut self,
        before: &World,
        after: &World,
        parts: &BTreeSet<OrFrId>,
        hung: &BTreeSet<DoorId>,
    ) {
        for (id, ..) in before.areas.changes(&after.areas) {
            self.areas.insert(id);
            self.entities.insert(Entity::Area(id));
        }
        for world in [before, after] {
            if !parts.is_empty() {
                self.areas.extend(world.areas_made_of(|id| parts.contains(&id)).map(|a| a.id));
            }
            if !hung.is_empty() {
                self.areas.extend(world.areas_hung_with(|id| hung.contains(&id)).map(|a| a.id));
            }
        }
        self.moved.extend(&self.areas);
        for (_, items) in before.items_changed(after) {
            self.moved.extend(items.into_iter().flatten().map(|item| item.area));
        }
        self.records.extend(self.areas.iter().map(|id| Record::Area(*id)));
        for id in &self.moved {
            for area in [before, after].into_iter().filter_map(|world| world.areas.get(id)) {
                self.records.extend(area.doors.iter().map(|mount| Record::Door(mount.door)));
            }
        }
    }

    fn add_maps(&mut self, before: &World, after: &World) {
        for (id, was, is) in before.maps.changes(&after.maps) {
            self.records.insert(Record::Map(id));
            self.entities.insert(Entity::Map(id));
            if let Some((was, is)) = was.zip(is) {
                let same = |(a, b): &(&Arc<MapLink>, &Arc<MapLink>)| Arc::ptr_eq(a, b) || a == b;
                let first = was.links.iter().zip(&is.links).take_while(same).count();
                let (was, is) = (&was.links[first..], &is.links[first..]);
                let last = was.iter().rev().zip(is.iter().rev()).take_while(same).count();
                self.links.insert(id, (first, last));
                let are_as_they_were =
                    self.areas.iter().all(|area| !before.areas.contains_key(area));
                if last == was.len() && are_as_they_were {
                    self.note_what_came(id, before, after);
                }
            }
        }
        if self.moved.is_empty() {
            return;
        }
        for map in before.maps.values().chain(after.maps.values()) {
            if map.items.iter().any(|item| self.moved.contains(&item.area)) {
                self.records.insert(Record::Map(map.id));
                self.links.entry(map.id).or_insert((map.links.len(), 0));
            }
        }
    }

    fn note_what_came(&mut self, id: MapId, before: &World, after: &World) {
        let items = [before, after].map(|world| &world.maps[&id].items);
        let Some(came) = items[1].strip_prefix(items[0].as_slice()) else { return };
        let areas = came.iter().filter_map(|item| after.areas.get(&item.area));
        // A third room at a door of two takes it from them.
        let mut doors = areas.flat_map(|area| &area.doors).map(|mount| mount.door);
        if doors.all(|door| !before.doors.contains_key(&door)) {
            self.came.insert(id, came.iter().map(|item| item.area).gather());
        }
    }

    /// Whether all that came to a Map is linked to what was there, which lacked nothing.
    pub(super) fn came_linked(&self, map: &Map) -> bool {
        let Some(came) = self.came.get(&map.id) else { return false };
        let (first, last) = self.links.get(&map.id).copied().unwrap_or_default();
        let new = &map.links[first..map.links.len() - last];
        let mut apart = came.clone();
        while !apart.is_empty() {
            let size = apart.len();
            for link in new {
                if apart.contains(&link.area) != apart.contains(&link.to_area) {
                    apart.remove(&link.area);
                    apart.remove(&link.to_area);
                }
            }
            if apart.len() == size {
                return false;
            }
        }
        true
    }

    /// What stands in Areas of the scope, is of a kind of it, or is served from a place of it.
    fn add_standing(&mut self, before: &World, after: &World) {
        let has_kind = self.records.iter().any(|record| matches!(record, Record::Object(_)));
        if !has_kind && self.areas.is_empty() {
            return;
        }
        for world in [before, after] {
            let standing = world.replicas_within(|area| self.areas.contains(&area));
            self.replicas.extend(standing.map(|replica| replica.id));
            if has_kind {
                let made = world.replicas_of(|kind| self.records.contains(&Record::Object(kind)));
                self.replicas.extend(made.map(|replica| replica.id));
            }
        }
    }

    /// The names, Russian and English, of all that is called otherwise than it was.
    pub(super) fn renamed(before: &'w World, after: &'w World) -> BTreeSet<&'w str> {
        let mut spoken = BTreeSet::new();
        macro_rules! note {
            ($($records:ident)*) => {$(
                for (_, was, is) in before.$records.changes(&after.$records) {
                    let [old, new] = [was, is].map(|r| r.map(|r| [r.name.as_str(), r.name_en.as_str()]));
                    if old != new {
                        spoken.extend(old.into_iter().chain(new).flatten());
                    }
                }
            )*};
        }
        note!(maps areas doors replicas places zones);
        spoken
    }

    /// Adds the things that bore one of these names.
    pub(super) fn add_twins(
        &mut self,
        before: &World,
        names: &BTreeSet<&str>,
        bearers: &NameIndex,
    ) {
        for name in names {
            for entity in bearers.find(before, name) {
                match entity {
                    Entity::Replica(id) if before.replicas[&id].name == *name => {
                        self.replicas.insert(id);
                    }
                    _ => {}
                }
            }
        }
    }

    /// Whether any Area may stand elsewhere, or on no Map, or on several.
    pub(super) fn has_standing(&self) -> bool {
        !self.moved.is_empty() || self.records.iter().any(|r| matches!(r, Record::Map(_)))
    }

    pub(super) fn has_place(&self, place: &Place) -> bool {
        self.records.contains(&Record::Place(place.id))
            || self.areas.contains(&place.area)
            || place.serves.is_some_and(|id| self.replicas.contains(&id))
    }

    pub(super) fn has_link(&self, map: &Map, at: usize, link: &MapLink) -> bool {
        let (first, last) = self.links.get(&map.id).copied().unwrap_or_default();
        let is_new = at >= first && at + last < map.links.len();
        is_new || self.moved.contains(&link.area) || self.moved.contains(&link.to_area)
    }
}

impl<'w> Checker<'w> {
    /// The records of a kind that are to be looked at, in their order: all; or those of the scope, with all that bear a handle
    /// which one of them got or lost.
    pub(super) fn asked<K: Copy + Ord, V>(
        &self,
        (kind, records): (&'static str, &'w Records<K, V>),
        id: impl Fn(&Record) -> Option<K>,
        key: impl Fn(&V) -> &str,
    ) -> Vec<&'w V> {
        let Some(scope) = self.scope else { return records.values().collect() };
        let ids = scope.records.iter().filter_map(id);
        let mut found: BTreeMap<K, &V> =
            ids.filter_map(|id| Some((id, records.get(&id)?))).gather();
        if let Some(keys) = scope.keys.get(kind) {
            // Few are looked for: texts of other lengths differ at once.
            let is_asked = |own: &str| match keys.len() {
                0..=8 => keys.iter().any(|key| *key == own),
                _ => keys.contains(own),
            };
            let bearing = records.iter().filter(|(_, record)| is_asked(key(record)));
            found.extend(bearing.map(|(id, record)| (*id, record)));
        }
        found.into_values().collect()
    }
}
