//! Two descriptions of one building: which records of the one are which of the other, and where they contradict.
//!
//! Records are the same where their keys are, else where their names are; numbers say nothing, since each file counts
//! for itself. Rooms, maps, lifts, doors between rooms and the robot must be alike; what stands in the rooms, which
//! doors are open and what is on may differ.
//!
//! **Invariant.** The translated world bears the ids of the first for what both have, and ids that the first does not
//! have for the rest.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::hash::Hash;

use crate::units::{
    AreaId, Bilingual, DoorId, Frame, Gather as _, InOrder as _, MapId, ObjectId, OrFrId,
    ReplicaId, TypeId, name_key, said, word,
};

use super::fault::{Fault, MapError, Record, Spot};
use super::{
    Area, BaseVector, Door, DoorMount, Item, Map, NextIds, Object, Orthoframe, Place, Replica,
    RobotProfile, SideRef, TypeKind, World,
};

/// What the records of one world are called in another.
#[derive(Debug, Default)]
pub(super) struct Counterparts {
    types: BTreeMap<(TypeKind, TypeId), TypeId>,
    orthoframes: BTreeMap<OrFrId, OrFrId>,
    objects: BTreeMap<ObjectId, ObjectId>,
    doors: BTreeMap<DoorId, DoorId>,
    areas: BTreeMap<AreaId, AreaId>,
    maps: BTreeMap<MapId, MapId>,
    replicas: BTreeMap<ReplicaId, ReplicaId>,
}

/// A record as it is found again: its id, its key (empty where it has none) and its name.
type Named<'w, Id> = (Id, &'w str, &'w str);

/// Each of `others` with its like among `known`: by keys first, then by names.
fn matched<'w, Id: Copy + Ord + Hash>(
    known: impl Iterator<Item = Named<'w, Id>>,
    others: impl Iterator<Item = Named<'w, Id>>,
) -> BTreeMap<Id, Id> {
    let (known, others): (Vec<_>, Vec<_>) = (known.collect(), others.collect());
    let (mut found, mut taken) = (BTreeMap::new(), BTreeSet::new());
    let mut pair = |index: HashMap<String, Id>, name: &dyn Fn(&Named<'w, Id>) -> String| {
        for other in &others {
            let like = index.get(&name(other)).filter(|id| !taken.contains(*id)).copied();
            if let (Some(like), false) = (like, found.contains_key(&other.0)) {
                found.insert(other.0, like);
                taken.insert(like);
            }
        }
    };
    let keyed = known.iter().filter(|(_, key, _)| !key.is_empty());
    pair(keyed.map(|(id, key, _)| ((*key).to_owned(), *id)).collect(), &|n| n.1.to_owned());
    pair(known.iter().map(|(id, _, name)| (name_key(name), *id)).collect(), &|n| name_key(n.2));
    found
}

macro_rules! by_key {
    ($known:expr, $other:expr, $table:ident) => {
        matched(
            $known.$table.values().map(|r| (r.id, r.key.as_str(), r.name.as_str())),
            $other.$table.values().map(|r| (r.id, r.key.as_str(), r.name.as_str())),
        )
    };
}

impl Counterparts {
    pub(super) fn of(known: &World, other: &World) -> Self {
        let mut types = BTreeMap::new();
        for kind in TypeKind::ALL {
            for entry in other.types.list(kind).entries.values() {
                if let Some(like) = known.types.list(kind).named(&entry.name) {
                    types.insert((kind, entry.id), like.id);
                }
            }
        }
        Self {
            types,
            orthoframes: by_key!(known, other, orthoframes),
            objects: by_key!(known, other, objects),
            doors: by_key!(known, other, doors),
            areas: by_key!(known, other, areas),
            maps: by_key!(known, other, maps),
            replicas: matched(
                known.replicas.values().map(|r| (r.id, "", r.name.as_str())),
                other.replicas.values().map(|r| (r.id, "", r.name.as_str())),
            ),
        }
    }

    /// Where `other` is another building, or has another robot, than `known`.
    pub(super) fn contradictions(&self, known: &World, other: &World) -> Vec<Fault> {
        let mut faults = Vec::new();
        let mut fault = |what: Bilingual, how: Bilingual, record: Option<Record>| {
            let spots = record.into_iter().map(Spot::of).collect();
            faults.push(Fault::new(MapError::OtherBuilding { what, how }, spots));
        };
        let lacks = || said!("missing-here-and-known-to-the-robot");
        let knows_not = || said!("unknown-to-the-robot");
        let room = |area: &Area| Bilingual::named(word!("room"), &area.name);
        let likes: BTreeMap<AreaId, AreaId> = self.areas.iter().map(|(o, k)| (*k, *o)).gather();
        for area in known.areas.values() {
            let Some(like) = likes.get(&area.id) else {
                fault(room(area), lacks(), None);
                continue;
            };
            let like = &other.areas[like];
            if !self.is_same_shape(known, other, area, like) {
                let how = word!("its-walls-or-openings-are-not-those");
                fault(room(area), how.into(), Some(Record::Area(like.id)));
            }
        }
        for area in other.areas.values().filter(|area| !self.areas.contains_key(&area.id)) {
            fault(room(area), knows_not(), Some(Record::Area(area.id)));
        }
        let between: BTreeSet<DoorId> = mounted(other);
        for door in other.doors.values().filter(|door| between.contains(&door.id)) {
            let named = Bilingual::named(word!("door"), &door.name);
            match self.doors.get(&door.id).map(|id| &known.doors[id]) {
                None => fault(named, knows_not(), Some(Record::Door(door.id))),
                Some(like) if !is_same_door(like, door) => {
                    let how = word!("its-kind-size-or-leaves-are-not");
                    fault(named, how.into(), Some(Record::Door(door.id)));
                }
                Some(_) => {}
            }
        }
        let floor = |map: &Map| Bilingual::named(word!("map"), &map.name);
        for map in known.maps.values() {
            let like = self.maps.iter().find(|(_, like)| **like == map.id).map(|(id, _)| id);
            match like.map(|id| &other.maps[id]) {
                None => fault(floor(map), lacks(), None),
                Some(like) if !self.is_same_map(map, like) => {
                    let how = word!("its-rooms-stand-or-are-joined-otherwise");
                    fault(floor(map), how.into(), Some(Record::Map(like.id)));
                }
                Some(_) => {}
            }
        }
        for map in other.maps.values().filter(|map| !self.maps.contains_key(&map.id)) {
            fault(floor(map), knows_not(), Some(Record::Map(map.id)));
        }
        if !self.has_same_storeys(known, other) {
            let what = word!("storeys-and-lifts");
            let how = word!("are-not-those-that-the-robot-knows");
            fault(what.into(), how.into(), Some(Record::Domain));
        }
        if (&known.robot.start, &other.robot.start) != (&None, &None)
            && !self.is_same_place(start_of(known), start_of(other))
        {
            let what = word!("the-robot-s-place");
            let how = word!("it-begins-elsewhere-than-the-robot-knows");
            let record = start_of(other).map_or(Record::Robot, |place| Record::Place(place.id));
            fault(what.into(), how.into(), Some(record));
        }
        if (RobotProfile { start: None, ..known.robot.clone() })
            != (RobotProfile { start: None, ..other.robot.clone() })
        {
            let what = word!("the-robot");
            let how = word!("its-size-or-speed-are-not-those");
            fault(what.into(), how.into(), Some(Record::Robot));
        }
        faults
    }

    fn is_same_place(&self, known: Option<&Place>, other: Option<&Place>) -> bool {
        known.zip(other).is_some_and(|(known, other)| {
            name_key(&known.name) == name_key(&other.name)
                && self.areas.get(&other.area) == Some(&known.area)
                && (known.at, known.heading) == (other.at, other.heading)
        })
    }

    fn is_same_shape(&self, known: &World, other: &World, a: &Area, b: &Area) -> bool {
        let part = |item: &Item| (item.frame, item.is_base);
        let parts = a.items.len() == b.items.len()
            && a.items.iter().all(|item| {
                b.item(&item.id).is_some_and(|like| {
                    part(item) == part(like)
                        && is_same_figure(known.orthoframe_of(item), other.orthoframe_of(like))
                })
            });
        let mount =
            |m: &DoorMount, door: Option<DoorId>| (m.item.clone(), m.side.clone(), door, m.opens);
        let mut mounts: Vec<_> = a.doors.iter().map(|m| mount(m, Some(m.door))).collect();
        for like in b.doors.iter().map(|m| mount(m, self.doors.get(&m.door).copied())) {
            match mounts.iter().position(|m| *m == like) {
                Some(at) => drop(mounts.swap_remove(at)),
                None => return false,
            }
        }
        parts && mounts.is_empty()
    }

    fn is_same_map(&self, a: &Map, b: &Map) -> bool {
        let area = |id: AreaId| self.areas.get(&id).copied();
        let standing = |map: &Map, area: &dyn Fn(AreaId) -> Option<AreaId>| {
            let mut all: Vec<(Option<AreaId>, Frame)> =
                map.items.iter().map(|item| (area(item.area), item.frame)).collect();
            all.order_by_key(|(area, _)| *area);
            all
        };
        type Joined = (Option<AreaId>, SideRef, Option<AreaId>, SideRef);
        let joined = |map: &Map, area: &dyn Fn(AreaId) -> Option<AreaId>| {
            let link = |l: &super::MapLink| {
                (area(l.area), l.side.clone(), area(l.to_area), l.to_side.clone())
            };
            map.links.iter().map(|own| link(own)).gather::<BTreeSet<Joined>>()
        };
        standing(a, &Some) == standing(b, &area) && joined(a, &Some) == joined(b, &area)
    }

    fn has_same_storeys(&self, known: &World, other: &World) -> bool {
        let storey = |map: Option<MapId>, frame: Frame| (map, frame);
        let mut here: Vec<_> =
            known.domain.maps.iter().map(|m| storey(Some(m.map), m.frame)).collect();
        let mut there: Vec<_> = other
            .domain
            .maps
            .iter()
            .map(|m| storey(self.maps.get(&m.map).copied(), m.frame))
            .collect();
        here.order_by_key(|(map, _)| *map);
        there.order_by_key(|(map, _)| *map);
        let lifts = |world: &World, area: &dyn Fn(AreaId) -> Option<AreaId>| {
            let lift = |(name, stops): &(String, Vec<super::LiftStop>)| {
                let stops: BTreeSet<Option<AreaId>> =
                    stops.iter().map(|stop| area(stop.area)).gather();
                (name_key(name), stops)
            };
            world.domain.lifts.iter().map(lift).gather::<BTreeSet<_>>()
        };
        let area = |id: AreaId| self.areas.get(&id).copied();
        here == there && lifts(known, &Some) == lifts(other, &area)
    }

    /// `other` in the ids of `known`: its things, kinds and states of doors in the building of `known`.
    pub(super) fn translated(mut self, known: &World, other: &World) -> World {
        let mut next = NextIds::after(known);
        let mut world = known.clone();
        self.name_the_new(other, &mut next);
        for kind in TypeKind::ALL {
            for entry in other.types.list(kind).entries.values() {
                let id = self.types[&(kind, entry.id)];
                world
                    .types
                    .list_mut(kind)
                    .entries
                    .entry(id)
                    .or_insert_with(|| super::TypeEntry { id, ..entry.clone() });
            }
        }
        for frame in other.orthoframes.values() {
            let id = self.orthoframes[&frame.id];
            world.orthoframes.insert(id, self.orthoframe(frame, id));
        }
        for door in other.doors.values() {
            let id = self.doors[&door.id];
            let door_type = self.kind(TypeKind::Door, door.door_type);
            world.doors.insert(id, Door { id, door_type, ..door.clone() });
        }
        for object in other.objects.values() {
            let id = self.objects[&object.id];
            world.objects.insert(id, self.object(object, id));
        }
        for area in other.areas.values() {
            if let Some(like) = self.areas.get(&area.id).and_then(|id| world.areas.get_mut(id)) {
                like.properties.clone_from(&area.properties);
            }
        }
        let things = other.replicas.values().filter_map(|thing| {
            let door = |(door, state): (&DoorId, &super::DoorState)| {
                Some((*self.doors.get(door)?, *state))
            };
            let id = self.replicas[&thing.id];
            Some((
                id,
                Replica {
                    id,
                    area: *self.areas.get(&thing.area)?,
                    object: self.objects[&thing.object],
                    door_states: thing.door_states.iter().filter_map(door).gather(),
                    ..thing.clone()
                },
            ))
        });
        world.replicas = things.collect();
        world
    }

    /// Ids for what `known` does not have.
    fn name_the_new(&mut self, other: &World, next: &mut NextIds) {
        fn give<Id: Ord + Copy>(
            found: &mut BTreeMap<Id, Id>,
            all: impl Iterator<Item = Id>,
            next: &mut u32,
            id: fn(u32) -> Id,
        ) {
            for other in all {
                found.entry(other).or_insert_with(|| {
                    let new = id(*next);
                    *next = next.saturating_add(1);
                    new
                });
            }
        }
        for kind in TypeKind::ALL {
            let new = next.types.entry(kind).or_insert(1);
            for id in other.types.list(kind).entries.keys() {
                self.types.entry((kind, *id)).or_insert_with(|| {
                    let id = TypeId(*new);
                    *new = new.saturating_add(1);
                    id
                });
            }
        }
        give(
            &mut self.orthoframes,
            other.orthoframes.keys().copied(),
            &mut next.orthoframe,
            OrFrId,
        );
        give(&mut self.objects, other.objects.keys().copied(), &mut next.object, ObjectId);
        give(&mut self.doors, other.doors.keys().copied(), &mut next.door, DoorId);
        give(&mut self.replicas, other.replicas.keys().copied(), &mut next.replica, ReplicaId);
    }

    fn kind(&self, kind: TypeKind, id: Option<TypeId>) -> Option<TypeId> {
        self.types.get(&(kind, id?)).copied()
    }

    fn orthoframe(&self, frame: &Orthoframe, id: OrFrId) -> Orthoframe {
        let side = |v: &BaseVector| BaseVector {
            side_type: self.kind(TypeKind::Side, v.side_type),
            ..v.clone()
        };
        Orthoframe {
            id,
            frame_type: self.kind(TypeKind::Orthoframe, frame.frame_type),
            shape: self.kind(TypeKind::Shape, frame.shape),
            base: frame.base.iter().map(side).collect(),
            ..frame.clone()
        }
    }

    fn object(&self, object: &Object, id: ObjectId) -> Object {
        let item =
            |item: &Item| Item { orthoframe: self.orthoframes[&item.orthoframe], ..item.clone() };
        let mount =
            |mount: &DoorMount| DoorMount { door: self.doors[&mount.door], ..mount.clone() };
        Object {
            id,
            object_type: self.kind(TypeKind::Object, object.object_type),
            items: object.items.iter().map(item).collect(),
            doors: object.doors.iter().map(mount).collect(),
            ..object.clone()
        }
    }
}

/// The doors of rooms; those of furniture are its own.
fn mounted(world: &World) -> BTreeSet<DoorId> {
    world.areas.values().flat_map(|area| &area.doors).map(|mount| mount.door).gather()
}

fn start_of(world: &World) -> Option<&Place> {
    world.places.get(&world.robot.start?)
}

fn is_same_door(a: &Door, b: &Door) -> bool {
    (a.kind, a.width, a.height) == (b.kind, b.width, b.height) && a.leaves == b.leaves
}

/// Whether two Orthoframes bound the same space in the same way.
fn is_same_figure(a: &Orthoframe, b: &Orthoframe) -> bool {
    let side = |v: &BaseVector| (v.id.clone(), v.start, v.end, v.permeability);
    let measures =
        |o: &Orthoframe| (o.height, o.base_permeability, o.roof_permeability, o.roof_scale);
    measures(a) == measures(b) && a.base.iter().map(side).eq(b.base.iter().map(side))
}
