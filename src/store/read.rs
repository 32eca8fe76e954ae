//! Records → World: the inverse of [`super::write`].
//!
//! Codes, words and numbers are checked once more on the way in, since an import from SQL ends here too.

use std::collections::BTreeMap;
use std::sync::Arc;

use crate::map::{
    Area, BaseVector, Domain, DomainMap, Door, DoorLeaf, DoorMount, DoorState, Extent, Forms,
    HingeSide, Item, ItemLink, LiftStop, Map, MapItem, MapLink, Object, OpensTo, Orthoframe,
    Permeability, Place, Profile, Properties, Replica, RobotProfile, SideRef, TypeEntry, TypeList,
    TypeLists, World, Zone, ZoneKind,
};
use crate::units::{
    AreaId, Cm, Deg, DomainId, DoorId, Frame, InOrder as _, MapId, ObjectId, OrFrId, PlaceId,
    Point, ReplicaId, Timestamp, TypeId, ZoneId,
};

use super::error::{Result, StoreError};
use super::sheet::{Sheet, describe_key};
use super::tables::{self as t, Record, Table};
use super::words::{
    CASES, CLOSED, DOOR_KINDS, GENDERS, KEEP_OUT, ONE_WAY, SLOW, STATUSES, SYNONYM, TRAIT, face,
};

impl Sheet {
    /// The world of the records; none when there is no Domain.
    ///
    /// # Errors
    /// [`StoreError::BadRecord`] or [`StoreError::BrokenReference`] when the records make no world.
    pub fn world(&self) -> Result<Option<World>> {
        let Some(domain) = self.all::<t::Domain>()?.into_iter().next() else { return Ok(None) };
        let mut reader = Reader { sheet: self, forms: forms(self)? };
        Ok(Some(World {
            types: reader.types()?,
            orthoframes: reader.orthoframes()?.into(),
            doors: reader.doors()?.into(),
            objects: reader.objects()?.into(),
            areas: reader.areas()?.into(),
            replicas: reader.replicas()?.into(),
            places: reader.places()?.into(),
            zones: reader.zones()?.into(),
            maps: reader.maps()?.into(),
            robot: reader.robot()?,
            domain: reader.domain(domain)?,
        }))
    }
}

/// A value that its column allows, but the model does not.
fn bad<T: Record>(record: &T) -> StoreError {
    StoreError::BadRecord { table: T::TABLE.name(), key: describe_key(T::TABLE, &record.to_row()) }
}

/// Turns "this makes no sense" into an error that names the record.
trait OrBad<V> {
    fn or_bad<T: Record>(self, record: &T) -> Result<V>;
}

impl<V> OrBad<V> for Option<V> {
    fn or_bad<T: Record>(self, record: &T) -> Result<V> {
        self.ok_or_else(|| bad(record))
    }
}

/// Any finite number: what was computed may exceed the limit for what a person types, and must come back.
fn cm(value: f64) -> Option<Cm> {
    value.is_finite().then(|| Cm::of(value))
}

fn deg(value: f64) -> Option<Deg> {
    Deg::new(value).ok()
}

fn frame(x: f64, y: f64, z: f64, angle: f64) -> Option<Frame> {
    Some(Frame { x: cm(x)?, y: cm(y)?, z: cm(z)?, angle: deg(angle)? })
}

fn permeability(code: u32) -> Option<Permeability> {
    Permeability::from_code(u8::try_from(code).ok()?)
}

fn meaning<T: Copy>(words: &[(T, &str)], word: &str) -> Option<T> {
    words.iter().find(|(_, w)| *w == word).map(|(value, _)| *value)
}

fn door_state(status: &str, opening: f64) -> Option<DoorState> {
    Some(DoorState { status: meaning(STATUSES, status)?, opening })
}

fn side_ref(item: Option<&String>, side: Option<&String>) -> Option<SideRef> {
    Some(SideRef { item: item?.clone(), side: side?.clone() })
}

/// The records of a table under the id of the record that they belong to, in the order of `No`.
fn grouped<T: Record>(
    sheet: &Sheet,
    parent: impl Fn(&T) -> u32,
    no: impl Fn(&T) -> u32,
) -> Result<BTreeMap<u32, Vec<T>>> {
    let mut groups = BTreeMap::<u32, Vec<T>>::new();
    for record in sheet.all::<T>()? {
        groups.entry(parent(&record)).or_default().push(record);
    }
    groups.values_mut().for_each(|group| group.order_by_key(&no));
    Ok(groups)
}

fn property_map<T: Record>(
    sheet: &Sheet,
    parts: impl Fn(T) -> (u32, String, String),
) -> Result<BTreeMap<u32, Properties>> {
    let mut all = BTreeMap::<u32, Properties>::new();
    for (id, prop, value) in sheet.all::<T>()?.into_iter().map(parts) {
        all.entry(id).or_default().insert(prop, value);
    }
    Ok(all)
}

type AllForms = BTreeMap<(String, u32), Forms>;

fn forms(sheet: &Sheet) -> Result<AllForms> {
    let mut all = AllForms::new();
    for r in sheet.all::<t::NameForms>()? {
        let case = meaning(CASES, &r.case).or_bad(&r)?;
        all.entry((r.kind, r.id)).or_default().insert(case, r.form);
    }
    Ok(all)
}

/// Items, links and doors of Objects or of Areas.
struct Parts {
    items: BTreeMap<u32, Vec<Item>>,
    links: BTreeMap<u32, Vec<ItemLink>>,
    doors: BTreeMap<u32, Vec<DoorMount>>,
}

macro_rules! parts {
    ($sheet:expr, $items:ident, $links:ident, $doors:ident, $id:ident) => {{
        let mut parts =
            Parts { items: BTreeMap::new(), links: BTreeMap::new(), doors: BTreeMap::new() };
        for (id, group) in grouped($sheet, |r: &t::$items| r.$id, |r| r.no)? {
            let item = |r: t::$items| {
                Ok(Item {
                    orthoframe: OrFrId(r.or_fr_id),
                    frame: frame(r.pos_x, r.pos_y, r.pos_z, r.pos_a).or_bad(&r)?,
                    is_base: r.base,
                    id: r.item_id,
                })
            };
            parts.items.insert(id, group.into_iter().map(item).collect::<Result<_>>()?);
        }
        for (id, group) in grouped($sheet, |r: &t::$links| r.$id, |r| r.no)? {
            let link = |r: t::$links| {
                Ok(ItemLink {
                    face: face(&r.side_id).or_bad(&r)?,
                    to_face: face(&r.side_id2).or_bad(&r)?,
                    rel_x: cm(r.rel_x).or_bad(&r)?,
                    rel_y: cm(r.rel_y).or_bad(&r)?,
                    rel_z: cm(r.rel_z).or_bad(&r)?,
                    rel_a: deg(r.rel_a).or_bad(&r)?,
                    item: r.item_id,
                    to_item: r.item_id2,
                })
            };
            parts.links.insert(id, group.into_iter().map(link).collect::<Result<_>>()?);
        }
        for (id, group) in grouped($sheet, |r: &t::$doors| r.$id, |r| r.no)? {
            let mount = |r: t::$doors| {
                let opens = match r.set_inside {
                    1 => Some(OpensTo::Inside),
                    -1 => Some(OpensTo::Outside),
                    _ => None,
                };
                Ok(DoorMount {
                    opens: opens.or_bad(&r)?,
                    door: DoorId(r.door_id),
                    item: r.item_id,
                    side: r.side_id,
                })
            };
            parts.doors.insert(id, group.into_iter().map(mount).collect::<Result<_>>()?);
        }
        parts
    }};
}

struct Reader<'a> {
    sheet: &'a Sheet,
    forms: AllForms,
}

impl Reader<'_> {
    fn take_forms(&mut self, table: Table, id: u32) -> Forms {
        self.forms.remove(&(table.name().to_owned(), id)).unwrap_or_default()
    }

    fn types(&mut self) -> Result<TypeLists> {
        let mut words = BTreeMap::<(String, u32), (Vec<String>, Vec<String>)>::new();
        for r in self.sheet.all::<t::TypeWords>()? {
            let (synonyms, traits) = words.entry((r.list.clone(), r.type_id)).or_default();
            match r.role.as_str() {
                SYNONYM => synonyms.push(r.word),
                TRAIT => traits.push(r.word),
                _ => return Err(bad(&r)),
            }
        }
        macro_rules! list {
            ($record:ident) => {{
                let mut list = TypeList::default();
                for r in self.sheet.all::<t::$record>()? {
                    let table = Table::$record.name().to_owned();
                    let (synonyms, traits) = words.remove(&(table, r.id)).unwrap_or_default();
                    let gender = match r.gender.as_str() {
                        "" => None,
                        word => Some(meaning(GENDERS, word).or_bad(&r)?),
                    };
                    let entry = TypeEntry {
                        id: TypeId(r.id),
                        name: r.name,
                        name_en: r.name_en,
                        description: r.desc,
                        gender,
                        animate: r.animate,
                        synonyms,
                        forms: self.take_forms(Table::$record, r.id),
                        traits,
                    };
                    list.entries.insert(entry.id, entry);
                }
                list
            }};
        }
        Ok(TypeLists {
            orthoframe: list!(OrtFrmTypeList),
            shape: list!(OrtFrmShapeList),
            side: list!(OrtFrmSideTypeList),
            object: list!(ObjectTypeList),
            area: list!(AreaTypeList),
            map: list!(MapTypeList),
            door: list!(DoorTypeList),
        })
    }

    fn orthoframes(&self) -> Result<BTreeMap<OrFrId, Orthoframe>> {
        let mut bases = self.bases()?;
        let mut properties =
            property_map(self.sheet, |r: t::OrtFrmProperties| (r.or_fr_id, r.prop, r.prop_val))?;
        let orthoframe = |r: t::OrFr| {
            Ok(Orthoframe {
                id: OrFrId(r.id),
                frame_type: r.type_id.map(TypeId),
                shape: r.shape_id.map(TypeId),
                base: bases.remove(&r.id).unwrap_or_default(),
                height: cm(r.roof).or_bad(&r)?,
                base_permeability: permeability(r.base_pntr).or_bad(&r)?,
                roof_permeability: permeability(r.roof_pntr).or_bad(&r)?,
                roof_scale: r.roof_scale,
                properties: properties.remove(&r.id).unwrap_or_default(),
                key: r.key,
                name: r.name,
                name_en: r.name_en,
                description: r.desc,
            })
        };
        keyed(self.sheet.all()?, orthoframe, |o| o.id)
    }

    fn bases(&self) -> Result<BTreeMap<u32, Vec<BaseVector>>> {
        let mut properties = BTreeMap::<(u32, String), Properties>::new();
        for r in self.sheet.all::<t::OrtFrmSideProperties>()? {
            properties.entry((r.or_fr_id, r.side_id)).or_default().insert(r.prop, r.prop_val);
        }
        let mut names = BTreeMap::<(u32, String), Vec<String>>::new();
        for r in self.sheet.all::<t::SideNames>()? {
            names.entry((r.or_fr_id, r.side_id)).or_default().push(r.name);
        }
        let side = |r: t::OrtFrmSides| {
            let permeability = permeability(r.side_pntr).or_bad(&r)?;
            let key = (r.or_fr_id, r.side_id);
            Ok(BaseVector {
                start: Point::new(r.x1, r.y1),
                end: Point::new(r.x2, r.y2),
                side_type: r.side_type_id.map(TypeId),
                permeability,
                names: names.remove(&key).unwrap_or_default(),
                properties: properties.remove(&key).unwrap_or_default(),
                id: key.1,
            })
        };
        let mut side = side;
        grouped(self.sheet, |r: &t::OrtFrmSides| r.or_fr_id, |r| r.no)?
            .into_iter()
            .map(|(id, group)| Ok((id, group.into_iter().map(&mut side).collect::<Result<_>>()?)))
            .collect()
    }

    fn doors(&mut self) -> Result<BTreeMap<DoorId, Door>> {
        let records = self.sheet.all()?;
        let mut leaves = grouped(self.sheet, |r: &t::DoorSides| r.door_id, |r| r.side_id)?;
        let mut properties =
            property_map(self.sheet, |r: t::DoorProperties| (r.door_id, r.prop, r.prop_val))?;
        let leaf = |r: t::DoorSides| {
            let hinge = match r.joint_side {
                0 => HingeSide::Right,
                1 => HingeSide::Left,
                _ => return Err(bad(&r)),
            };
            let thickness = cm(r.thick).or_bad(&r)?;
            Ok(DoorLeaf { hinge, share: r.side_part, thickness, max_open: r.max_open })
        };
        let door = |r: t::Door| {
            Ok(Door {
                id: DoorId(r.id),
                door_type: r.type_id.map(TypeId),
                kind: meaning(DOOR_KINDS, &r.kind).or_bad(&r)?,
                width: cm(r.width).or_bad(&r)?,
                height: cm(r.height).or_bad(&r)?,
                leaves: leaves
                    .remove(&r.id)
                    .unwrap_or_default()
                    .into_iter()
                    .map(leaf)
                    .collect::<Result<_>>()?,
                state: door_state(&r.status, r.opening).or_bad(&r)?,
                properties: properties.remove(&r.id).unwrap_or_default(),
                forms: self.take_forms(Table::Door, r.id),
                key: r.key,
                name: r.name,
                name_en: r.name_en,
            })
        };
        keyed(records, door, |d| d.id)
    }

    fn objects(&self) -> Result<BTreeMap<ObjectId, Object>> {
        let mut parts = parts!(self.sheet, ObjectItems, ObjectItemLinks, ObjectDoors, object_id);
        let mut properties =
            property_map(self.sheet, |r: t::ObjectProperties| (r.object_id, r.prop, r.prop_val))?;
        let object = |r: t::Object| {
            Ok(Object {
                id: ObjectId(r.id),
                object_type: r.type_id.map(TypeId),
                items: parts.items.remove(&r.id).unwrap_or_default(),
                links: parts.links.remove(&r.id).unwrap_or_default(),
                front: side_ref(r.front_item.as_ref(), r.front_side.as_ref()),
                back: side_ref(r.back_item.as_ref(), r.back_side.as_ref()),
                doors: parts.doors.remove(&r.id).unwrap_or_default(),
                properties: properties.remove(&r.id).unwrap_or_default(),
                key: r.key,
                name: r.name,
                name_en: r.name_en,
                description: r.desc,
            })
        };
        keyed(self.sheet.all()?, object, |o| o.id)
    }

    fn areas(&mut self) -> Result<BTreeMap<AreaId, Area>> {
        let records = self.sheet.all()?;
        let mut parts = parts!(self.sheet, AreaItems, AreaItemLinks, AreaDoors, area_id);
        let mut properties =
            property_map(self.sheet, |r: t::AreaProperties| (r.area_id, r.prop, r.prop_val))?;
        let area = |r: t::Area| {
            Ok(Area {
                id: AreaId(r.id),
                area_type: r.type_id.map(TypeId),
                items: parts.items.remove(&r.id).unwrap_or_default(),
                links: parts.links.remove(&r.id).unwrap_or_default(),
                doors: parts.doors.remove(&r.id).unwrap_or_default(),
                properties: properties.remove(&r.id).unwrap_or_default(),
                forms: self.take_forms(Table::Area, r.id),
                key: r.key,
                name: r.name,
                name_en: r.name_en,
                description: r.desc,
            })
        };
        keyed(records, area, |a| a.id)
    }

    fn replicas(&mut self) -> Result<BTreeMap<ReplicaId, Replica>> {
        let records = self.sheet.all()?;
        let mut properties =
            property_map(self.sheet, |r: t::ReplicaProperties| (r.repl_id, r.prop, r.prop_val))?;
        let mut states = BTreeMap::<u32, BTreeMap<DoorId, DoorState>>::new();
        for r in self.sheet.all::<t::ReplicaDoors>()? {
            let state = door_state(&r.status, r.opening).or_bad(&r)?;
            states.entry(r.repl_id).or_default().insert(DoorId(r.door_id), state);
        }
        let replica = |r: t::AreaObjects| {
            Ok(Replica {
                id: ReplicaId(r.repl_id),
                area: AreaId(r.area_id),
                object: ObjectId(r.object_id),
                frame: frame(r.x, r.y, r.z, r.ang).or_bad(&r)?,
                move_prob: u8::try_from(r.move_prob).ok().or_bad(&r)?,
                properties: properties.remove(&r.repl_id).unwrap_or_default(),
                door_states: states.remove(&r.repl_id).unwrap_or_default(),
                forms: self.take_forms(Table::AreaObjects, r.repl_id),
                name: r.name,
                name_en: r.name_en,
            })
        };
        keyed(records, replica, |r| r.id)
    }

    fn places(&mut self) -> Result<BTreeMap<PlaceId, Place>> {
        let records = self.sheet.all()?;
        let place = |r: t::Places| {
            Ok(Place {
                id: PlaceId(r.place_id),
                area: AreaId(r.area_id),
                at: Point::new(r.x, r.y),
                heading: r.ang.map(|a| deg(a).or_bad(&r)).transpose()?,
                serves: r.serves.map(ReplicaId),
                forms: self.take_forms(Table::Places, r.place_id),
                name: r.name,
                name_en: r.name_en,
            })
        };
        keyed(records, place, |p| p.id)
    }

    fn zones(&mut self) -> Result<BTreeMap<ZoneId, Zone>> {
        let mut areas = grouped(self.sheet, |r: &t::ZoneAreas| r.zone_id, |r| r.no)?;
        let records = self.sheet.all()?;
        let zone = |r: t::Zones| {
            let kind = match r.kind.as_str() {
                KEEP_OUT => ZoneKind::KeepOut,
                CLOSED => ZoneKind::Closed,
                SLOW => ZoneKind::Slow { speed: cm(r.measure).or_bad(&r)?.get() },
                ONE_WAY => ZoneKind::OneWay { heading: deg(r.measure).or_bad(&r)? },
                _ => return Err(bad(&r)),
            };
            let areas = areas.remove(&r.zone_id).unwrap_or_default();
            let extent = match r.map_id {
                Some(map) => {
                    let corners = corners(&r.points).or_bad(&r)?;
                    Extent::Polygon { map: MapId(map), corners }
                }
                None => Extent::Areas(areas.iter().map(|a| AreaId(a.area_id)).collect()),
            };
            Ok(Zone {
                id: ZoneId(r.zone_id),
                kind,
                extent,
                from: moment(&r.starts).or_bad(&r)?,
                until: moment(&r.ends).or_bad(&r)?,
                forms: self.take_forms(Table::Zones, r.zone_id),
                key: r.key,
                name: r.name,
                name_en: r.name_en,
                reason: r.reason,
                reason_en: r.reason_en,
            })
        };
        keyed(records, zone, |z| z.id)
    }

    fn maps(&self) -> Result<BTreeMap<MapId, Map>> {
        let mut items = grouped(self.sheet, |r: &t::MapItems| r.map_id, |r| r.no)?;
        let mut links = grouped(self.sheet, |r: &t::MapItemLinks| r.map_id, |r| r.no)?;
        let item = |r: t::MapItems| {
            Ok(MapItem {
                area: AreaId(r.area_id),
                frame: frame(r.pos_x, r.pos_y, r.pos_z, r.pos_a).or_bad(&r)?,
                is_base: r.base,
            })
        };
        let link = |r: t::MapItemLinks| {
            Ok(Arc::new(MapLink {
                area: AreaId(r.area_id),
                to_area: AreaId(r.area_id2),
                rel_x: cm(r.rel_x).or_bad(&r)?,
                rel_y: cm(r.rel_y).or_bad(&r)?,
                rel_z: cm(r.rel_z).or_bad(&r)?,
                rel_a: deg(r.rel_a).or_bad(&r)?,
                side: SideRef { item: r.area_item_id, side: r.side_id },
                to_side: SideRef { item: r.area_item_id2, side: r.side_id2 },
            }))
        };
        let map = |r: t::Map| {
            let items = items.remove(&r.id).unwrap_or_default();
            let links = links.remove(&r.id).unwrap_or_default();
            Ok(Map {
                id: MapId(r.id),
                key: r.key,
                name: r.name,
                name_en: r.name_en,
                description: r.desc,
                map_type: r.type_id.map(TypeId),
                frame: r.frame,
                items: items.into_iter().map(item).collect::<Result<_>>()?,
                links: links.into_iter().map(link).collect::<Result<_>>()?,
            })
        };
        keyed(self.sheet.all()?, map, |m| m.id)
    }

    fn domain(&self, r: t::Domain) -> Result<Domain> {
        let placed = |r: t::DomainMaps| {
            Ok(DomainMap {
                map: MapId(r.map_id),
                frame: frame(r.pos_x, r.pos_y, r.pos_z, r.pos_a).or_bad(&r)?,
                is_base: r.base,
            })
        };
        let mut maps = grouped(self.sheet, |r: &t::DomainMaps| r.domain_id, |r| r.no)?;
        let mut stops = BTreeMap::<u32, Vec<LiftStop>>::new();
        for r in self.sheet.all::<t::LiftStops>()? {
            stops.entry(r.lift_no).or_default().push(LiftStop { area: AreaId(r.area_id) });
        }
        let lift = |r: t::Lifts| (r.name, stops.remove(&r.lift_no).unwrap_or_default());
        let maps = maps.remove(&r.id).unwrap_or_default();
        let profile = match r.profile.as_str() {
            "" => Profile::Surveyed,
            name => Profile::named(name).or_bad(&r)?,
        };
        Ok(Domain {
            profile,
            id: DomainId(r.id),
            maps: maps.into_iter().map(placed).collect::<Result<_>>()?,
            lifts: self.sheet.all()?.into_iter().map(lift).collect(),
            key: r.key,
            name: r.name,
            name_en: r.name_en,
            description: r.desc,
        })
    }

    fn robot(&self) -> Result<RobotProfile> {
        let Some(r) = self.sheet.all::<t::Robot>()?.into_iter().next() else {
            return Ok(RobotProfile::default());
        };
        Ok(RobotProfile {
            radius: cm(r.radius).or_bad(&r)?,
            height: cm(r.height).or_bad(&r)?,
            step: cm(r.step).or_bad(&r)?,
            clearance: cm(r.clearance).or_bad(&r)?,
            speed: r.speed,
            turn_rate: r.turn_rate,
            start: r.start.map(PlaceId),
            footprint: corners(&r.footprint).or_bad(&r)?,
            opens: r.opens,
        })
    }
}

/// A moment; an empty text is none.
fn moment(text: &str) -> Option<Option<Timestamp>> {
    if text.is_empty() { Some(None) } else { text.parse().ok().map(Some) }
}

/// Corners as `x,y x,y …`.
fn corners(text: &str) -> Option<Vec<Point>> {
    let corner = |pair: &str| {
        let (x, y) = pair.split_once(',')?;
        let number = |n: &str| Cm::new(n.parse().ok()?).ok().map(Cm::get);
        Some(Point::new(number(x)?, number(y)?))
    };
    text.split_whitespace().map(corner).collect()
}

fn keyed<R, V, K: Ord>(
    records: Vec<R>,
    mut value: impl FnMut(R) -> Result<V>,
    key: impl Fn(&V) -> K,
) -> Result<BTreeMap<K, V>> {
    let mut all = BTreeMap::new();
    for record in records {
        let value = value(record)?;
        all.insert(key(&value), value);
    }
    Ok(all)
}

/// The replicas of a sheet that holds nothing else.
pub(super) fn replicas(sheet: &Sheet) -> Result<Vec<Replica>> {
    let mut reader = Reader { sheet, forms: forms(sheet)? };
    Ok(reader.replicas()?.into_values().collect())
}
