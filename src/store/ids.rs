//! Ids over time: what keeps its name keeps its id, and no id is ever given twice.
//!
//! A map file knows names, not ids; the ids of a world that was read from one are provisional. Before it is
//! compared with the store, everything in it takes the id that its name has, or ever had, in the store.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use crate::map::{Area, DoorMount, Extent, Item, NextIds, Object, TypeKind, World};
use crate::units::{
    AreaId, DomainId, DoorId, Gather as _, MapId, ObjectId, OrFrId, PlaceId, ReplicaId, TypeId,
    ZoneId, name_key,
};

use super::cell::{Cell, Row};
use super::error::{Result, StoreError};
use super::tables::Table;

/// The tables whose records bear an id of their own, and its column.
pub fn numbered() -> impl Iterator<Item = (Table, &'static str)> {
    NAMED.iter().map(|(table, id, _)| (*table, *id))
}

/// The ids for new records of a world: none is ever given twice, not even that of something gone. Of a table it is asked
/// which id was never given.
///
/// # Errors
/// What is said of a table.
pub fn next_ids<E>(
    world: &World,
    free: impl Fn(Table) -> std::result::Result<u32, E>,
) -> std::result::Result<NextIds, E> {
    let mut ids = NextIds::after(world);
    for (id, table) in [
        (&mut ids.orthoframe, Table::OrFr),
        (&mut ids.object, Table::Object),
        (&mut ids.area, Table::Area),
        (&mut ids.map, Table::Map),
        (&mut ids.door, Table::Door),
        (&mut ids.replica, Table::AreaObjects),
        (&mut ids.place, Table::Places),
        (&mut ids.zone, Table::Zones),
    ] {
        *id = (*id).max(free(table)?);
    }
    for (kind, id) in &mut ids.types {
        let table = match kind {
            TypeKind::Orthoframe => Table::OrtFrmTypeList,
            TypeKind::Shape => Table::OrtFrmShapeList,
            TypeKind::Side => Table::OrtFrmSideTypeList,
            TypeKind::Object => Table::ObjectTypeList,
            TypeKind::Area => Table::AreaTypeList,
            TypeKind::Map => Table::MapTypeList,
            TypeKind::Door => Table::DoorTypeList,
        };
        *id = (*id).max(free(table)?);
    }
    Ok(ids)
}

/// The tables whose records bear an id of their own, with the columns of id and name: the first name that is
/// not empty counts.
const NAMED: &[(Table, &str, &[&str])] = &[
    (Table::OrFr, "ID", &["Key", "Name"]),
    (Table::Object, "ID", &["Key", "Name"]),
    (Table::Area, "ID", &["Key", "Name"]),
    (Table::Map, "ID", &["Key", "Name"]),
    (Table::Domain, "ID", &["Key", "Name"]),
    (Table::Door, "ID", &["Key", "Name"]),
    (Table::AreaObjects, "ReplID", &["Name"]),
    (Table::Places, "PlaceID", &["Name"]),
    (Table::Zones, "ZoneID", &["Key", "Name"]),
    (Table::OrtFrmTypeList, "ID", &["Name"]),
    (Table::OrtFrmShapeList, "ID", &["Name"]),
    (Table::OrtFrmSideTypeList, "ID", &["Name"]),
    (Table::ObjectTypeList, "ID", &["Name"]),
    (Table::AreaTypeList, "ID", &["Name"]),
    (Table::MapTypeList, "ID", &["Name"]),
    (Table::DoorTypeList, "ID", &["Name"]),
];

/// The tables whose records bear an id of their own.
pub(crate) fn tables() -> impl Iterator<Item = Table> {
    NAMED.iter().map(|(table, ..)| *table)
}

fn cell<'a>(table: Table, row: &'a Row, column: &str) -> Option<&'a Cell> {
    row.get(table.columns().iter().position(|c| c.name == column)?)
}

/// The id that a record bears; none in a table without ids.
pub(crate) fn id_of(table: Table, row: &Row) -> Option<u32> {
    let (_, id, _) = NAMED.iter().find(|(t, ..)| *t == table)?;
    let Cell::Int(id) = cell(table, row, id)? else { return None };
    u32::try_from(*id).ok()
}

/// The id that a record bears and the name by which it is known again; none in a table without ids.
pub(crate) fn identity(table: Table, row: &Row) -> Option<(u32, String)> {
    let (_, _, names) = NAMED.iter().find(|(t, ..)| *t == table)?;
    let name = names.iter().find_map(|name| match cell(table, row, name)? {
        Cell::Text(text) if !text.is_empty() => Some(name_key(text)),
        _ => None,
    });
    Some((id_of(table, row)?, name.unwrap_or_default()))
}

/// The names that a store knows, with their ids.
#[derive(Debug, Default)]
pub(crate) struct Known {
    ids: BTreeMap<(Table, String), (bool, u32)>,
    last: BTreeMap<Table, u32>,
}

impl Known {
    /// A living record's name counts more than a dead one's, a later id more than an earlier.
    pub(crate) fn add(&mut self, table: Table, row: &Row, alive: bool) {
        let Some((id, name)) = identity(table, row) else { return };
        let place = self.ids.entry((table, name)).or_insert((alive, id));
        *place = (*place).max((alive, id));
        self.raise(table, id);
    }

    pub(crate) fn raise(&mut self, table: Table, id: u32) {
        let last = self.last.entry(table).or_default();
        *last = (*last).max(id);
    }

    /// The new id of everything in one table.
    fn assign<'a>(
        &mut self,
        table: Table,
        named: impl Iterator<Item = (u32, [&'a str; 2])>,
    ) -> Result<BTreeMap<u32, u32>> {
        let named: Vec<(u32, &str)> = named
            .map(|(id, names)| (id, names.into_iter().find(|n| !n.is_empty()).unwrap_or_default()))
            .collect();
        let mut seen = BTreeSet::new();
        let mut ids = BTreeMap::new();
        for (id, name) in named {
            let key = name_key(name);
            if !seen.insert(key.clone()) {
                let (table, name) = (table.name(), name.to_owned());
                return Err(StoreError::DuplicateName { table, name });
            }
            let known = self.ids.get(&(table, key)).map(|(_, id)| *id);
            let new = known.unwrap_or_else(|| {
                let last = self.last.entry(table).or_default();
                *last = last.saturating_add(1);
                *last
            });
            ids.insert(id, new);
        }
        Ok(ids)
    }
}

/// The same world under the ids that its names have in the store.
pub(crate) fn renumbered(world: &World, known: &mut Known) -> Result<World> {
    macro_rules! assign {
        ($table:ident, $things:expr, $first:ident, $second:ident) => {
            known.assign(
                Table::$table,
                $things.values().map(|t| (t.id.0, [t.$first.as_str(), t.$second.as_str()])),
            )?
        };
    }
    let types = &world.types;
    let map = Renumbering {
        orthoframes: assign!(OrFr, world.orthoframes, key, name),
        objects: assign!(Object, world.objects, key, name),
        areas: assign!(Area, world.areas, key, name),
        maps: assign!(Map, world.maps, key, name),
        doors: assign!(Door, world.doors, key, name),
        replicas: assign!(AreaObjects, world.replicas, name, name),
        places: assign!(Places, world.places, name, name),
        zones: assign!(Zones, world.zones, key, name),
        domain: known.assign(
            Table::Domain,
            [(world.domain.id.0, [world.domain.key.as_str(), world.domain.name.as_str()])]
                .into_iter(),
        )?,
        frame_types: assign!(OrtFrmTypeList, types.orthoframe.entries, name, name),
        shapes: assign!(OrtFrmShapeList, types.shape.entries, name, name),
        side_types: assign!(OrtFrmSideTypeList, types.side.entries, name, name),
        object_types: assign!(ObjectTypeList, types.object.entries, name, name),
        area_types: assign!(AreaTypeList, types.area.entries, name, name),
        map_types: assign!(MapTypeList, types.map.entries, name, name),
        door_types: assign!(DoorTypeList, types.door.entries, name, name),
    };
    Ok(map.apply(world.clone()))
}

type Ids = BTreeMap<u32, u32>;

struct Renumbering {
    orthoframes: Ids,
    objects: Ids,
    areas: Ids,
    maps: Ids,
    doors: Ids,
    replicas: Ids,
    places: Ids,
    zones: Ids,
    domain: Ids,
    frame_types: Ids,
    shapes: Ids,
    side_types: Ids,
    object_types: Ids,
    area_types: Ids,
    map_types: Ids,
    door_types: Ids,
}

/// A reference to nothing stays what it is: the check of the map speaks of it, not the store.
fn new(ids: &Ids, id: u32) -> u32 {
    ids.get(&id).copied().unwrap_or(id)
}

fn new_type(ids: &Ids, id: Option<TypeId>) -> Option<TypeId> {
    id.map(|id| TypeId(new(ids, id.0)))
}

macro_rules! rekey {
    ($things:expr, $ids:expr, $id:ident, |$thing:ident| $change:block) => {
        $things = std::mem::take(&mut $things)
            .into_values()
            .map(|mut $thing| {
                $thing.id = $id(new(&$ids, $thing.id.0));
                $change($thing.id, $thing)
            })
            .gather()
    };
}

impl Renumbering {
    fn apply(&self, mut world: World) -> World {
        self.types(&mut world);
        rekey!(world.orthoframes, self.orthoframes, OrFrId, |o| {
            o.frame_type = new_type(&self.frame_types, o.frame_type);
            o.shape = new_type(&self.shapes, o.shape);
            for side in &mut o.base {
                side.side_type = new_type(&self.side_types, side.side_type);
            }
        });
        rekey!(world.doors, self.doors, DoorId, |d| {
            d.door_type = new_type(&self.door_types, d.door_type);
        });
        rekey!(world.objects, self.objects, ObjectId, |o| {
            let Object { object_type, items, doors, .. } = &mut o;
            *object_type = new_type(&self.object_types, *object_type);
            self.items(items, doors);
        });
        rekey!(world.areas, self.areas, AreaId, |a| {
            let Area { area_type, items, doors, .. } = &mut a;
            *area_type = new_type(&self.area_types, *area_type);
            self.items(items, doors);
        });
        rekey!(world.replicas, self.replicas, ReplicaId, |r| {
            r.area = self.area(r.area);
            r.object = ObjectId(new(&self.objects, r.object.0));
            r.door_states =
                r.door_states.iter().map(|(door, state)| (self.door(*door), *state)).gather();
        });
        rekey!(world.places, self.places, PlaceId, |p| {
            p.area = self.area(p.area);
            p.serves = p.serves.map(|r| ReplicaId(new(&self.replicas, r.0)));
        });
        rekey!(world.zones, self.zones, ZoneId, |z| {
            match &mut z.extent {
                Extent::Polygon { map, .. } => *map = MapId(new(&self.maps, map.0)),
                Extent::Areas(areas) => areas.iter_mut().for_each(|area| *area = self.area(*area)),
            }
        });
        rekey!(world.maps, self.maps, MapId, |m| {
            m.map_type = new_type(&self.map_types, m.map_type);
            for item in &mut m.items {
                item.area = self.area(item.area);
            }
            for link in &mut m.links {
                let link = Arc::make_mut(link);
                link.area = self.area(link.area);
                link.to_area = self.area(link.to_area);
            }
        });
        self.domain(&mut world);
        world
    }

    fn area(&self, id: AreaId) -> AreaId {
        AreaId(new(&self.areas, id.0))
    }

    fn door(&self, id: DoorId) -> DoorId {
        DoorId(new(&self.doors, id.0))
    }

    fn items(&self, items: &mut [Item], doors: &mut [DoorMount]) {
        for item in items {
            item.orthoframe = OrFrId(new(&self.orthoframes, item.orthoframe.0));
        }
        for mount in doors {
            mount.door = self.door(mount.door);
        }
    }

    fn types(&self, world: &mut World) {
        let types = &mut world.types;
        rekey!(types.orthoframe.entries, self.frame_types, TypeId, |_e| {});
        rekey!(types.shape.entries, self.shapes, TypeId, |_e| {});
        rekey!(types.side.entries, self.side_types, TypeId, |_e| {});
        rekey!(types.object.entries, self.object_types, TypeId, |_e| {});
        rekey!(types.area.entries, self.area_types, TypeId, |_e| {});
        rekey!(types.map.entries, self.map_types, TypeId, |_e| {});
        rekey!(types.door.entries, self.door_types, TypeId, |_e| {});
    }

    fn domain(&self, world: &mut World) {
        let domain = &mut world.domain;
        domain.id = DomainId(new(&self.domain, domain.id.0));
        for placed in &mut domain.maps {
            placed.map = MapId(new(&self.maps, placed.map.0));
        }
        for (_, stops) in &mut domain.lifts {
            for stop in stops {
                stop.area = self.area(stop.area);
            }
        }
        world.robot.start = world.robot.start.map(|p| PlaceId(new(&self.places, p.0)));
    }
}
