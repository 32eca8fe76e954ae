//! World → records (paper 2 §§2-7).

use std::collections::BTreeSet;
use std::sync::Arc;

use crate::map::{
    Area, Door, DoorMount, DoorState, Extent, Forms, HingeSide, Item, ItemLink, Map, MapItem,
    MapLink, Object, OpensTo, Orthoframe, Place, Profile, Properties, Replica, TypeList, World,
    Zone, ZoneKind,
};
use crate::units::{AreaId, Frame, Gather as _, MapId, OrFrId, Timestamp, TypeId};

use super::error::Result;
use super::sheet::Sheet;
use super::tables::{self as t, Table};
use super::words::{
    CASES, CLOSED, DOOR_KINDS, GENDERS, KEEP_OUT, ONE_WAY, SLOW, STATUSES, SYNONYM, TRAIT,
    face_text,
};

fn word<T: PartialEq + Copy>(words: &[(T, &'static str)], value: T) -> String {
    let found = words.iter().find(|(v, _)| *v == value);
    found.map(|(_, word)| (*word).to_owned()).expect("every value has its word")
}

/// Items, links and doors of an Object or Area: the same columns in tables of two names.
macro_rules! put_items {
    ($sheet:ident, $group:ident, $items:ident, $links:ident, $doors:ident, $id:ident) => {{
        let orthoframe = |item: &str| $group.item(item).map_or(0, |i| i.orthoframe.0);
        for (no, item) in (0..).zip(&$group.items) {
            let Frame { x, y, z, angle } = item.frame;
            $sheet.put(&t::$items {
                $id: $group.id.0,
                item_id: item.id.clone(),
                or_fr_id: item.orthoframe.0,
                pos_x: x.get(),
                pos_y: y.get(),
                pos_z: z.get(),
                pos_a: angle.get(),
                base: item.is_base,
                no,
            })?;
        }
        for (no, link) in (0..).zip(&$group.links) {
            let ItemLink { item, face, to_item, to_face, rel_x, rel_y, rel_z, rel_a } = link;
            $sheet.put(&t::$links {
                $id: $group.id.0,
                item_id: item.clone(),
                item_id2: to_item.clone(),
                or_fr_id: orthoframe(item),
                side_id: face_text(face),
                or_fr_id2: orthoframe(to_item),
                side_id2: face_text(to_face),
                rel_x: rel_x.get(),
                rel_y: rel_y.get(),
                rel_a: rel_a.get(),
                rel_xy: rel_x.get().hypot(rel_y.get()),
                rel_z: rel_z.get(),
                no,
            })?;
        }
        for (no, mount) in (0..).zip(&$group.doors) {
            let DoorMount { item, side, door, opens } = mount;
            $sheet.put(&t::$doors {
                $id: $group.id.0,
                or_fr_id: orthoframe(item),
                side_id: side.clone(),
                door_id: door.0,
                set_inside: match opens {
                    OpensTo::Inside => 1,
                    OpensTo::Outside => -1,
                },
                item_id: item.clone(),
                no,
            })?;
        }
    }};
}

impl Sheet {
    /// The records of a world.
    ///
    /// # Errors
    /// [`StoreError::Duplicate`](crate::StoreError::Duplicate) when two parts of the world have one key.
    pub fn of(world: &World) -> Result<Self> {
        let mut sheet = Self::default();
        type_lists(&mut sheet, world)?;
        for orthoframe in world.orthoframes.values() {
            put_orthoframe(&mut sheet, orthoframe)?;
        }
        for door in world.doors.values() {
            put_door(&mut sheet, door)?;
        }
        for object in world.objects.values() {
            put_object(&mut sheet, world, object)?;
        }
        for area in world.areas.values() {
            put_area(&mut sheet, world, area)?;
        }
        for replica in world.replicas.values() {
            put_replica(&mut sheet, replica)?;
        }
        for place in world.places.values() {
            put_place(&mut sheet, place)?;
        }
        for zone in world.zones.values() {
            put_zone(&mut sheet, zone)?;
        }
        for map in world.maps.values() {
            put_map(&mut sheet, world, map, None)?;
        }
        put_domain(&mut sheet, world)?;
        Ok(sheet)
    }

    /// The records in which two worlds may differ, of the one and of the other: rows that are in neither are the same in both.
    /// Where most of a world is shared with the one that it was made from, few are.
    pub(crate) fn of_change(before: &World, after: &World) -> Result<[Self; 2]> {
        let mut sheets = [Self::default(), Self::default()];
        let [old, new] = &mut sheets;
        macro_rules! put {
            ($things:ident, |$sheet:ident, $world:ident, $thing:ident| $put:expr) => {
                for (_, was, is) in before.$things.changes(&after.$things) {
                    for ($sheet, $world, $thing) in
                        [(&mut *old, before, was), (&mut *new, after, is)]
                    {
                        if let Some($thing) = $thing {
                            let _ = $world;
                            $put?;
                        }
                    }
                }
            };
        }
        put!(orthoframes, |sheet, world, orthoframe| put_orthoframe(sheet, orthoframe));
        put!(doors, |sheet, world, door| put_door(sheet, door));
        put!(objects, |sheet, world, object| put_object(sheet, world, object));
        put!(areas, |sheet, world, area| put_area(sheet, world, area));
        put!(replicas, |sheet, world, replica| put_replica(sheet, replica));
        put!(places, |sheet, world, place| put_place(sheet, place));
        put!(zones, |sheet, world, zone| put_zone(sheet, zone));
        // Sizes of Objects, Areas and Maps are made of those of Orthoframes.
        let parts = before.orthoframes.changes(&after.orthoframes).into_iter();
        let parts: BTreeSet<OrFrId> = parts.map(|(id, ..)| id).gather();
        let mut others = BTreeSet::new();
        macro_rules! put_users {
            ($groups:ident, $made_of:ident, $put:ident) => {{
                let using = [before, after].into_iter().flat_map(|world| {
                    world.$made_of(|part| parts.contains(&part)).map(|group| group.id)
                });
                let all: BTreeSet<_> = using.gather();
                for id in &all {
                    let [was, is] = [before.$groups.get(id), after.$groups.get(id)];
                    if let (Some(was), true) = (was, was == is) {
                        $put(old, before, was)?;
                        $put(new, after, was)?;
                    }
                }
                all
            }};
        }
        if !parts.is_empty() {
            put_users!(objects, objects_made_of, put_object);
            others.extend(put_users!(areas, areas_made_of, put_area));
        }
        // A Map tells of an Area's items alone.
        let areas = before.areas.changes(&after.areas).into_iter();
        let made = |was: &Area, is: &Area| was.items == is.items;
        let areas =
            areas.filter(|(_, was, is)| !was.zip(*is).is_some_and(|(was, is)| made(was, is)));
        others.extend(areas.map(|(id, ..)| id));
        let mut ids: BTreeSet<MapId> =
            before.maps.changes(&after.maps).into_iter().map(|(id, ..)| id).gather();
        if !others.is_empty() {
            ids.extend(before.maps.keys().chain(after.maps.keys()));
        }
        for id in ids {
            let [was, is] = [before.maps.get(&id), after.maps.get(&id)];
            let mut beside = [None, None];
            if let (Some(was), Some(is)) = (was, is) {
                let now = Beside::of(is, was, &others, after);
                beside = [Some(Beside { other: is, ..now }), Some(now)];
            }
            let [by_now, by_then] = &beside;
            for (sheet, world, own, beside) in
                [(&mut *old, before, was, by_now), (&mut *new, after, is, by_then)]
            {
                if let Some(map) = own {
                    put_map(sheet, world, map, beside.as_ref())?;
                }
            }
        }
        for (sheet, world) in [(old, before), (new, after)] {
            if before.types != after.types {
                type_lists(sheet, world)?;
            }
            put_domain(sheet, world)?;
        }
        Ok(sheets)
    }
}

fn type_lists(sheet: &mut Sheet, world: &World) -> Result<()> {
    macro_rules! list {
        ($list:expr, $record:ident) => {{
            for e in $list.entries.values() {
                sheet.put(&t::$record {
                    id: e.id.0,
                    name: e.name.clone(),
                    desc: e.description.clone(),
                    name_en: e.name_en.clone(),
                    gender: e.gender.map_or_else(String::new, |g| word(GENDERS, g)),
                    animate: e.animate,
                })?;
            }
            type_words(sheet, &$list, Table::$record)?;
        }};
    }
    let types = &world.types;
    list!(types.orthoframe, OrtFrmTypeList);
    list!(types.shape, OrtFrmShapeList);
    list!(types.side, OrtFrmSideTypeList);
    list!(types.object, ObjectTypeList);
    list!(types.area, AreaTypeList);
    list!(types.map, MapTypeList);
    list!(types.door, DoorTypeList);
    Ok(())
}

fn type_words(sheet: &mut Sheet, list: &TypeList, table: Table) -> Result<()> {
    for entry in list.entries.values() {
        for (role, words) in [(SYNONYM, &entry.synonyms), (TRAIT, &entry.traits)] {
            for (no, word) in (0..).zip(words) {
                sheet.put(&t::TypeWords {
                    list: table.name().into(),
                    type_id: entry.id.0,
                    role: role.into(),
                    no,
                    word: word.clone(),
                })?;
            }
        }
        put_forms(sheet, table, entry.id.0, &entry.forms)?;
    }
    Ok(())
}

fn put_forms(sheet: &mut Sheet, table: Table, id: u32, forms: &Forms) -> Result<()> {
    forms.iter().try_for_each(|(case, form)| {
        sheet.put(&t::NameForms {
            kind: table.name().into(),
            id,
            case: word(CASES, *case),
            form: form.clone(),
        })
    })
}

fn type_id(id: Option<TypeId>) -> Option<u32> {
    id.map(|id| id.0)
}

fn put_orthoframe(sheet: &mut Sheet, o: &Orthoframe) -> Result<()> {
    let (size_x, size_y) = o.size();
    sheet.put(&t::OrFr {
        id: o.id.0,
        name: o.name.clone(),
        desc: o.description.clone(),
        type_id: type_id(o.frame_type),
        shape_id: type_id(o.shape),
        side_count: o.base.len() as u32,
        base_pntr: u32::from(o.base_permeability.code()),
        roof: o.height.get(),
        roof_pntr: u32::from(o.roof_permeability.code()),
        size_x: size_x.get(),
        size_y: size_y.get(),
        key: o.key.clone(),
        name_en: o.name_en.clone(),
        roof_scale: o.roof_scale,
    })?;
    for (prop, value) in &o.properties {
        sheet.put(&t::OrtFrmProperties {
            or_fr_id: o.id.0,
            prop: prop.clone(),
            prop_val: value.clone(),
        })?;
    }
    for (no, side) in (0..).zip(&o.base) {
        sheet.put(&t::OrtFrmSides {
            or_fr_id: o.id.0,
            side_id: side.id.clone(),
            side_type_id: type_id(side.side_type),
            side_pntr: u32::from(side.permeability.code()),
            x1: side.start.x,
            y1: side.start.y,
            x2: side.end.x,
            y2: side.end.y,
            len: side.length().get(),
            ang: side.angle().get(),
            no,
        })?;
        for (prop, value) in &side.properties {
            sheet.put(&t::OrtFrmSideProperties {
                or_fr_id: o.id.0,
                side_id: side.id.clone(),
                prop: prop.clone(),
                prop_val: value.clone(),
            })?;
        }
        for (no, name) in (0..).zip(&side.names) {
            sheet.put(&t::SideNames {
                or_fr_id: o.id.0,
                side_id: side.id.clone(),
                no,
                name: name.clone(),
            })?;
        }
    }
    Ok(())
}

fn put_door(sheet: &mut Sheet, door: &Door) -> Result<()> {
    sheet.put(&t::Door {
        id: door.id.0,
        type_id: type_id(door.door_type),
        side_count: door.leaves.len() as u32,
        width: door.width.get(),
        height: door.height.get(),
        key: door.key.clone(),
        name: door.name.clone(),
        name_en: door.name_en.clone(),
        kind: word(DOOR_KINDS, door.kind),
        status: status(&door.state),
        opening: door.state.opening,
    })?;
    for (side_id, leaf) in (1..).zip(&door.leaves) {
        sheet.put(&t::DoorSides {
            door_id: door.id.0,
            side_id,
            joint_side: match leaf.hinge {
                HingeSide::Right => 0,
                HingeSide::Left => 1,
            },
            side_part: leaf.share,
            thick: leaf.thickness.get(),
            max_open: leaf.max_open,
        })?;
    }
    properties(sheet, &door.properties, |prop, prop_val| t::DoorProperties {
        door_id: door.id.0,
        prop,
        prop_val,
    })?;
    put_forms(sheet, Table::Door, door.id.0, &door.forms)
}

fn status(state: &DoorState) -> String {
    word(STATUSES, state.status)
}

fn properties<T: super::Record>(
    sheet: &mut Sheet,
    properties: &Properties,
    record: impl Fn(String, String) -> T,
) -> Result<()> {
    properties.iter().try_for_each(|(prop, value)| sheet.put(&record(prop.clone(), value.clone())))
}

/// The box around Orthoframes, along the axes of what they are part of.
#[derive(Clone, Copy)]
struct Around {
    low: [f64; 3],
    high: [f64; 3],
}

impl Around {
    const NOTHING: Self = Self { low: [f64::INFINITY; 3], high: [f64::NEG_INFINITY; 3] };

    fn take(&mut self, world: &World, orthoframe: OrFrId, frame: &Frame) {
        let Some(orthoframe) = world.orthoframes.get(&orthoframe) else { return };
        let bottom = frame.z.get();
        for corner in orthoframe.corners() {
            let p = frame.apply(corner);
            for (axis, value) in [(0, p.x), (1, p.y), (2, bottom)] {
                self.low[axis] = self.low[axis].min(value);
                self.high[axis] = self.high[axis].max(value);
            }
        }
        self.high[2] = self.high[2].max(bottom + orthoframe.height.get());
    }

    /// Takes an Area that stands on a Map.
    fn take_area(&mut self, world: &World, placed: &MapItem) {
        for item in world.areas.get(&placed.area).map_or(&[][..], |area| &area.items) {
            self.take(world, item.orthoframe, &placed.frame.compose(&item.frame));
        }
    }

    /// Length, breadth, height.
    fn size(&self) -> (f64, f64, f64) {
        let extent = |axis: usize| match self.low[axis] <= self.high[axis] {
            true => self.high[axis] - self.low[axis],
            false => 0.0,
        };
        (extent(0), extent(1), extent(2))
    }
}

/// Overall sizes of a group of items along its own axes, and its height.
pub(super) fn group_size(world: &World, items: &[Item]) -> (f64, f64, f64) {
    let mut around = Around::NOTHING;
    items.iter().for_each(|item| around.take(world, item.orthoframe, &item.frame));
    around.size()
}

fn put_object(sheet: &mut Sheet, world: &World, object: &Object) -> Result<()> {
    let (size_x, size_y, height) = group_size(world, &object.items);
    let item_of = |side: &Option<crate::map::SideRef>| side.as_ref().map(|s| s.item.clone());
    let side_of = |side: &Option<crate::map::SideRef>| side.as_ref().map(|s| s.side.clone());
    sheet.put(&t::Object {
        id: object.id.0,
        name: object.name.clone(),
        desc: object.description.clone(),
        type_id: type_id(object.object_type),
        size_x,
        size_y,
        height,
        key: object.key.clone(),
        name_en: object.name_en.clone(),
        front_item: item_of(&object.front),
        front_side: side_of(&object.front),
        back_item: item_of(&object.back),
        back_side: side_of(&object.back),
    })?;
    put_items!(sheet, object, ObjectItems, ObjectItemLinks, ObjectDoors, object_id);
    properties(sheet, &object.properties, |prop, prop_val| t::ObjectProperties {
        object_id: object.id.0,
        prop,
        prop_val,
    })
}

fn put_area(sheet: &mut Sheet, world: &World, area: &Area) -> Result<()> {
    let (size_x, size_y, height) = group_size(world, &area.items);
    sheet.put(&t::Area {
        id: area.id.0,
        name: area.name.clone(),
        desc: area.description.clone(),
        type_id: type_id(area.area_type),
        size_x,
        size_y,
        height,
        key: area.key.clone(),
        name_en: area.name_en.clone(),
    })?;
    put_items!(sheet, area, AreaItems, AreaItemLinks, AreaDoors, area_id);
    properties(sheet, &area.properties, |prop, prop_val| t::AreaProperties {
        area_id: area.id.0,
        prop,
        prop_val,
    })?;
    put_forms(sheet, Table::Area, area.id.0, &area.forms)
}

fn put_replica(sheet: &mut Sheet, r: &Replica) -> Result<()> {
    sheet.put(&replica_record(r))?;
    properties(sheet, &r.properties, |prop, prop_val| t::ReplicaProperties {
        repl_id: r.id.0,
        prop,
        prop_val,
    })?;
    for (door, state) in &r.door_states {
        sheet.put(&t::ReplicaDoors {
            repl_id: r.id.0,
            door_id: door.0,
            status: status(state),
            opening: state.opening,
        })?;
    }
    put_forms(sheet, Table::AreaObjects, r.id.0, &r.forms)
}

pub(super) fn replica_record(r: &Replica) -> t::AreaObjects {
    t::AreaObjects {
        area_id: r.area.0,
        object_id: r.object.0,
        repl_id: r.id.0,
        x: r.frame.x.get(),
        y: r.frame.y.get(),
        z: r.frame.z.get(),
        ang: r.frame.angle.get(),
        move_prob: u32::from(r.move_prob),
        name: r.name.clone(),
        name_en: r.name_en.clone(),
    }
}

fn put_place(sheet: &mut Sheet, place: &Place) -> Result<()> {
    sheet.put(&t::Places {
        area_id: place.area.0,
        place_id: place.id.0,
        name: place.name.clone(),
        name_en: place.name_en.clone(),
        x: place.at.x,
        y: place.at.y,
        ang: place.heading.map(crate::units::Deg::get),
        serves: place.serves.map(|r| r.0),
    })?;
    put_forms(sheet, Table::Places, place.id.0, &place.forms)
}

fn moment(at: Option<Timestamp>) -> String {
    at.map_or_else(String::new, |at| at.to_string())
}

fn put_zone(sheet: &mut Sheet, zone: &Zone) -> Result<()> {
    let (kind, measure) = match zone.kind {
        ZoneKind::KeepOut => (KEEP_OUT, 0.0),
        ZoneKind::Closed => (CLOSED, 0.0),
        ZoneKind::Slow { speed } => (SLOW, speed),
        ZoneKind::OneWay { heading } => (ONE_WAY, heading.get()),
    };
    let (map, corners, areas) = match &zone.extent {
        Extent::Polygon { map, corners } => (Some(map.0), &corners[..], &[][..]),
        Extent::Areas(areas) => (None, &[][..], &areas[..]),
    };
    let points: Vec<String> = corners.iter().map(|p| format!("{},{}", p.x, p.y)).collect();
    sheet.put(&t::Zones {
        zone_id: zone.id.0,
        key: zone.key.clone(),
        name: zone.name.clone(),
        name_en: zone.name_en.clone(),
        kind: kind.to_owned(),
        measure,
        map_id: map,
        points: points.join(" "),
        reason: zone.reason.clone(),
        reason_en: zone.reason_en.clone(),
        starts: moment(zone.from),
        ends: moment(zone.until),
    })?;
    for (no, area) in (0..).zip(areas) {
        sheet.put(&t::ZoneAreas { zone_id: zone.id.0, no, area_id: area.0 })?;
    }
    put_forms(sheet, Table::Zones, zone.id.0, &zone.forms)
}

/// The Orthoframe of an Area's base item, or of its only one.
fn base_orthoframe(world: &World, area: crate::units::AreaId) -> u32 {
    let items = world.areas.get(&area).map_or(&[][..], |a| &a.items);
    items.iter().find(|i| i.is_base).or(items.first()).map_or(0, |i| i.orthoframe.0)
}

fn item_orthoframe(world: &World, area: crate::units::AreaId, item: &str) -> u32 {
    world.areas.get(&area).and_then(|a| a.item(item)).map_or(0, |i| i.orthoframe.0)
}

/// Another state of a Map, beside which only what differs is told.
struct Beside<'w> {
    other: &'w Map,
    /// Areas that differ though they stand alike.
    but: &'w BTreeSet<AreaId>,
    /// What stands alike on both.
    common: Around,
}

impl<'w> Beside<'w> {
    fn of(map: &Map, other: &'w Map, but: &'w BTreeSet<AreaId>, world: &World) -> Self {
        let mut beside = Self { other, but, common: Around::NOTHING };
        let mut common = Around::NOTHING;
        let items = map.items.iter().enumerate().filter(|(no, item)| beside.has(*no, item));
        items.for_each(|(_, item)| common.take_area(world, item));
        beside.common = common;
        beside
    }

    fn has(&self, no: usize, item: &MapItem) -> bool {
        self.other.items.get(no) == Some(item) && !self.but.contains(&item.area)
    }

    fn has_link(&self, no: usize, link: &Arc<MapLink>) -> bool {
        let same = |other: &Arc<MapLink>| Arc::ptr_eq(other, link) || other == link;
        let is_other = |area| self.but.contains(area);
        self.other.links.get(no).is_some_and(same)
            && !is_other(&link.area)
            && !is_other(&link.to_area)
    }
}

/// The records of a Map. Beside another one, those of its items and links are left out that it has in common with that.
fn put_map(sheet: &mut Sheet, world: &World, map: &Map, beside: Option<&Beside<'_>>) -> Result<()> {
    let is_common = |no: usize, item: &MapItem| beside.is_some_and(|beside| beside.has(no, item));
    let is_common_link =
        |no: usize, link: &Arc<MapLink>| beside.is_some_and(|beside| beside.has_link(no, link));
    let mut around = beside.map_or(Around::NOTHING, |beside| beside.common);
    let own = map.items.iter().enumerate().filter(|(no, item)| !is_common(*no, item));
    own.for_each(|(_, item)| around.take_area(world, item));
    let (size_x, size_y, height) = around.size();
    sheet.put(&t::Map {
        id: map.id.0,
        name: map.name.clone(),
        desc: map.description.clone(),
        type_id: type_id(map.map_type),
        size_x,
        size_y,
        height,
        key: map.key.clone(),
        name_en: map.name_en.clone(),
        frame: map.frame.clone(),
    })?;
    let items = map.items.iter().enumerate().filter(|(no, item)| !is_common(*no, item));
    for (no, item) in items {
        let Frame { x, y, z, angle } = item.frame;
        sheet.put(&t::MapItems {
            map_id: map.id.0,
            item_id: item.area.0,
            area_id: item.area.0,
            or_fr_id: base_orthoframe(world, item.area),
            pos_x: x.get(),
            pos_y: y.get(),
            pos_z: z.get(),
            pos_a: angle.get(),
            base: item.is_base,
            no: no as u32,
        })?;
    }
    let links = map.links.iter().enumerate().filter(|(no, link)| !is_common_link(*no, link));
    for (no, link) in links {
        sheet.put(&t::MapItemLinks {
            map_id: map.id.0,
            item_id: link.area.0,
            item_id2: link.to_area.0,
            area_id: link.area.0,
            or_fr_id: item_orthoframe(world, link.area, &link.side.item),
            side_id: link.side.side.clone(),
            area_id2: link.to_area.0,
            or_fr_id2: item_orthoframe(world, link.to_area, &link.to_side.item),
            side_id2: link.to_side.side.clone(),
            rel_x: link.rel_x.get(),
            rel_y: link.rel_y.get(),
            rel_a: link.rel_a.get(),
            rel_z: link.rel_z.get(),
            area_item_id: link.side.item.clone(),
            area_item_id2: link.to_side.item.clone(),
            no: no as u32,
        })?;
    }
    Ok(())
}

fn put_domain(sheet: &mut Sheet, world: &World) -> Result<()> {
    let domain = &world.domain;
    let domain_id = domain.id.0;
    sheet.put(&t::Domain {
        id: domain_id,
        name: domain.name.clone(),
        desc: domain.description.clone(),
        key: domain.key.clone(),
        name_en: domain.name_en.clone(),
        // As a record of before there were profiles reads, so that importing the same map again changes nothing.
        profile: match domain.profile {
            Profile::Surveyed => String::new(),
            other => other.name().to_owned(),
        },
    })?;
    for (no, placed) in (0..).zip(&domain.maps) {
        let Frame { x, y, z, angle } = placed.frame;
        sheet.put(&t::DomainMaps {
            domain_id,
            map_id: placed.map.0,
            pos_x: x.get(),
            pos_y: y.get(),
            pos_z: z.get(),
            pos_a: angle.get(),
            base: placed.is_base,
            no,
        })?;
    }
    for (lift_no, (name, stops)) in (0..).zip(&domain.lifts) {
        sheet.put(&t::Lifts { domain_id, lift_no, name: name.clone() })?;
        for (stop_no, stop) in (0..).zip(stops) {
            sheet.put(&t::LiftStops { domain_id, lift_no, stop_no, area_id: stop.area.0 })?;
        }
    }
    let robot = &world.robot;
    let corners: Vec<String> = robot.footprint.iter().map(|p| format!("{},{}", p.x, p.y)).collect();
    sheet.put(&t::Robot {
        domain_id,
        radius: robot.radius.get(),
        height: robot.height.get(),
        step: robot.step.get(),
        clearance: robot.clearance.get(),
        speed: robot.speed,
        turn_rate: robot.turn_rate,
        start: robot.start.map(|p| p.0),
        footprint: corners.join(" "),
        opens: robot.opens,
    })
}
