//! From a [`World`] to the text of its map file: a header per record, a line per part, replica and link.

use super::corners::{lettered, letters};
use super::schema::{
    AreaFile, At, DomainFile, DomainMapFile, DoorFile, DoorStateFile, FORMAT, FormsFile, ItemFile,
    ItemLinkFile, LeafFile, LiftFile, MapFile, MountFile, Number, ObjectFile, OrthoframeFile,
    PermeabilityFile, PlaceFile, PlanFile, PlanItemFile, PlanLinkFile, ReplicaFile, RobotFile,
    SideFile, SideTraitsFile, Table, TypeFile, TypesFile, ZoneFile, ZoneWord,
};
use super::text::{Lines, key};
use crate::units::{AreaId, Cm, Deg, Frame, InOrder as _, Point, TypeId};
use crate::{
    Area, BaseVector, DomainMap, Door, DoorMount, DoorState, DoorStatus, Extent, Face, Item,
    ItemLink, Map, MapLink, Object, Orthoframe, Place, Replica, SideRef, TypeEntry, TypeKind,
    World, Zone, ZoneKind,
};

/// The types of the file, from which any notation can be written.
pub(super) fn to_file(world: &World) -> MapFile {
    Writer { world }.file()
}

pub(super) fn to_toml(world: &World) -> String {
    as_toml(&to_file(world))
}

/// A zone as a map file tells of it.
pub(super) fn zone_file(world: &World, zone: &Zone) -> ZoneFile {
    Writer { world }.zone(zone, Some(zone.id.0))
}

fn as_toml(file: &MapFile) -> String {
    let mut text = format!("format = {}\n", file.format);
    table(&mut text, "domain", &file.domain);
    table(&mut text, "robot", &file.robot);
    table(&mut text, "type", &file.r#type);
    tables(&mut text, "orthoframe", &file.orthoframe);
    tables(&mut text, "door", &file.door);
    tables(&mut text, "object", &file.object);
    tables(&mut text, "area", &file.area);
    tables(&mut text, "map", &file.map);
    tables(&mut text, "zone", &file.zone);
    text
}

fn tables<T: Lines>(text: &mut String, section: &str, records: &Table<T>) {
    for (name, record) in &records.0 {
        table(text, &format!("{section}.{}", key(name)), record);
    }
}

fn table(text: &mut String, header: &str, record: &impl Lines) {
    let lines = record.lines();
    if !lines.is_empty() {
        text.push_str(&format!("\n[{header}]\n{lines}"));
    }
}

fn default_name(name: &str, key: &str) -> String {
    if name == key { String::new() } else { name.to_owned() }
}

fn number(value: f64) -> Number {
    Number(value)
}

fn cm(value: Cm) -> Number {
    Number(value.get())
}

fn point(p: Point) -> [Number; 2] {
    [number(p.x), number(p.y)]
}

fn angle(angle: Deg) -> Option<Number> {
    (angle != Deg::ZERO).then(|| number(angle.get()))
}

/// `z` only where there is any.
fn at(x: Cm, y: Cm, z: Cm) -> At {
    if z == Cm::ZERO { At(vec![cm(x), cm(y)]) } else { At(vec![cm(x), cm(y), cm(z)]) }
}

/// Nothing for the origin.
fn offset(x: Cm, y: Cm, z: Cm) -> At {
    if [x, y, z] == [Cm::ZERO; 3] { At::default() } else { at(x, y, z) }
}

fn frame_offset(frame: &Frame) -> At {
    offset(frame.x, frame.y, frame.z)
}

/// Whether each is the base, when reading would not take it so: the first one is by default.
fn base_marks(marks: &[bool]) -> Vec<bool> {
    let first_alone =
        marks.iter().position(|&m| m) == Some(0) && marks.iter().filter(|&&m| m).count() == 1;
    if first_alone { vec![false; marks.len()] } else { marks.to_vec() }
}

struct Writer<'w> {
    world: &'w World,
}

impl Writer<'_> {
    /// Ids to be written: those that reading would not give by itself. See `read::number`.
    fn ids<I: IntoIterator<Item = u32>>(
        &self,
        ids: I,
    ) -> impl Iterator<Item = Option<u32>> + use<'_, I> {
        let mut last = 0;
        ids.into_iter().map(move |id| {
            let follows = id == last + 1;
            last = id;
            (!follows).then_some(id)
        })
    }

    fn file(&self) -> MapFile {
        let w = self.world;
        macro_rules! section {
            ($records:expr, $write:ident) => {
                $records
                    .values()
                    .zip(self.ids($records.keys().map(|id| id.0)))
                    .map(|(record, id)| (record.key.clone(), self.$write(record, id)))
                    .collect()
            };
        }
        MapFile {
            format: FORMAT,
            domain: self.domain(),
            robot: self.robot(),
            r#type: self.types(),
            orthoframe: section!(w.orthoframes, orthoframe),
            door: section!(w.doors, door),
            object: section!(w.objects, object),
            area: self.areas(),
            map: section!(w.maps, plan),
            zone: section!(w.zones, zone),
        }
    }

    fn domain(&self) -> DomainFile {
        let domain = &self.world.domain;
        let only = [DomainMap {
            map: self.world.maps.keys().next().copied().unwrap_or(crate::units::MapId(1)),
            frame: Frame::IDENTITY,
            is_base: true,
        }];
        let implied = self.world.maps.len() == 1 && domain.maps == only;
        let marks = base_marks(&domain.maps.iter().map(|m| m.is_base).collect::<Vec<_>>());
        let place = |(m, base): (&DomainMap, bool)| DomainMapFile {
            map: self.world.maps[&m.map].key.clone(),
            at: frame_offset(&m.frame),
            angle: angle(m.frame.angle),
            base,
        };
        DomainFile {
            key: if domain.key == "domain" { String::new() } else { domain.key.clone() },
            id: (domain.id.0 != 1).then_some(domain.id.0),
            name: default_name(&domain.name, &domain.key),
            name_en: domain.name_en.clone(),
            description: domain.description.clone(),
            profile: domain.profile.into(),
            maps: if implied {
                Vec::new()
            } else {
                domain.maps.iter().zip(marks).map(place).collect()
            },
            lifts: domain
                .lifts
                .iter()
                .map(|(name, stops)| LiftFile {
                    name: name.clone(),
                    stops: stops.iter().map(|s| self.area_key(s.area)).collect(),
                })
                .collect(),
        }
    }

    fn robot(&self) -> RobotFile {
        let robot = &self.world.robot;
        RobotFile {
            radius: Some(cm(robot.radius)),
            footprint: robot.footprint.iter().map(|p| [number(p.x), number(p.y)]).collect(),
            height: Some(cm(robot.height)),
            step: Some(cm(robot.step)),
            clearance: Some(cm(robot.clearance)),
            speed: Some(number(robot.speed)),
            turn_rate: Some(number(robot.turn_rate)),
            start: robot.start.map(|place| self.world.places[&place].name.clone()),
            opens: robot.opens.then_some(true),
        }
    }

    fn types(&self) -> TypesFile {
        let list = |kind| {
            let entries = &self.world.types.list(kind).entries;
            let ids = self.ids(entries.keys().map(|id| id.0));
            entries.values().zip(ids).map(|(e, id)| type_file(e, id)).collect()
        };
        TypesFile {
            orthoframe: list(TypeKind::Orthoframe),
            shape: list(TypeKind::Shape),
            side: list(TypeKind::Side),
            object: list(TypeKind::Object),
            area: list(TypeKind::Area),
            map: list(TypeKind::Map),
            door: list(TypeKind::Door),
        }
    }

    fn type_name(&self, kind: TypeKind, id: Option<TypeId>) -> Option<String> {
        self.world.types.list(kind).get(id).map(|entry| entry.name.clone())
    }

    fn area_key(&self, area: AreaId) -> String {
        self.world.areas[&area].key.clone()
    }

    fn orthoframe(&self, frame: &Orthoframe, id: Option<u32>) -> OrthoframeFile {
        let corners: Vec<_> = frame.corners().collect();
        // A base whose sides bear letters in order is fully told by its corners.
        let is_lettered = !corners.is_empty()
            && lettered(&corners).iter().zip(&frame.base).enumerate().all(|(i, (plain, v))| {
                v.id == letters(i) && (v.start, v.end) == (plain.start, plain.end)
            });
        let rect = if is_lettered { as_rect(&corners) } else { None };
        let traits = |v: &BaseVector| SideTraitsFile {
            r#type: self.type_name(TypeKind::Side, v.side_type),
            permeability: v.permeability.into(),
            names: v.names.clone(),
            properties: v.properties.clone(),
        };
        let side_file = |v: &BaseVector| {
            let traits = traits(v);
            SideFile {
                id: v.id.clone(),
                from: point(v.start),
                to: point(v.end),
                r#type: traits.r#type,
                permeability: traits.permeability,
                names: traits.names,
                properties: traits.properties,
            }
        };
        let plain = SideTraitsFile {
            r#type: None,
            permeability: PermeabilityFile::default(),
            names: Vec::new(),
            properties: Default::default(),
        };
        let side = |v: &BaseVector| (v.id.clone(), traits(v));
        let all_points = || corners.iter().map(|&p| point(p)).collect();
        OrthoframeFile {
            id,
            name: default_name(&frame.name, &frame.key),
            name_en: frame.name_en.clone(),
            description: frame.description.clone(),
            r#type: self.type_name(TypeKind::Orthoframe, frame.frame_type),
            shape: self.type_name(TypeKind::Shape, frame.shape),
            rect,
            regular: None,
            points: if is_lettered && rect.is_none() { all_points() } else { Vec::new() },
            sides: if is_lettered {
                Vec::new()
            } else {
                frame.base.iter().map(side_file).collect()
            },
            reverse: false,
            height: (frame.height != Cm::ZERO).then(|| cm(frame.height)),
            base: frame.base_permeability.into(),
            roof: frame.roof_permeability.into(),
            roof_scale: frame.is_uniframe().then(|| number(frame.roof_scale)),
            properties: frame.properties.clone(),
            side: if is_lettered {
                frame.base.iter().map(side).filter(|(_, traits)| *traits != plain).collect()
            } else {
                Table::default()
            },
        }
    }

    fn door(&self, door: &Door, id: Option<u32>) -> DoorFile {
        let (state, opening) = state_file(&door.state);
        let leaves = door.leaves.iter().map(|leaf| LeafFile {
            hinge: leaf.hinge.into(),
            share: Some(number(leaf.share)),
            thickness: Some(cm(leaf.thickness)),
            max_open: Some(number(leaf.max_open)),
        });
        DoorFile {
            kind: door.kind.into(),
            width: cm(door.width),
            height: cm(door.height),
            id,
            name: default_name(&door.name, &door.key),
            name_en: door.name_en.clone(),
            r#type: self.type_name(TypeKind::Door, door.door_type),
            leaves: leaves.collect(),
            state,
            opening,
            properties: door.properties.clone(),
            forms: door.forms.clone(),
        }
    }

    fn items(&self, items: &[Item]) -> Vec<ItemFile> {
        let marks = base_marks(&items.iter().map(|i| i.is_base).collect::<Vec<_>>());
        let item = |(item, base): (&Item, bool)| ItemFile {
            id: item.id.clone(),
            orthoframe: self.world.orthoframes[&item.orthoframe].key.clone(),
            at: frame_offset(&item.frame),
            angle: angle(item.frame.angle),
            base,
        };
        items.iter().zip(marks).map(item).collect()
    }

    fn mounts(&self, mounts: &[DoorMount], items: &[Item]) -> Vec<MountFile> {
        let mount = |mount: &DoorMount| MountFile {
            side: side_text(&mount.item, &mount.side, items),
            door: self.world.doors[&mount.door].key.clone(),
            opens: mount.opens.into(),
        };
        mounts.iter().map(mount).collect()
    }

    fn object(&self, object: &Object, id: Option<u32>) -> ObjectFile {
        let side = |side: &SideRef| side_text(&side.item, &side.side, &object.items);
        ObjectFile {
            items: self.items(&object.items),
            id,
            name: default_name(&object.name, &object.key),
            name_en: object.name_en.clone(),
            description: object.description.clone(),
            r#type: self.type_name(TypeKind::Object, object.object_type),
            links: object.links.iter().map(link_file).collect(),
            front: object.front.as_ref().map(side),
            back: object.back.as_ref().map(side),
            doors: self.mounts(&object.doors, &object.items),
            properties: object.properties.clone(),
        }
    }

    /// Replicas and places are numbered through the file, Area after Area.
    fn areas(&self) -> Table<AreaFile> {
        let w = self.world;
        let mut replicas: Vec<_> = w.replicas.values().collect();
        replicas.sort_by_key(|r| (r.area, r.id));
        let replica_ids = self.ids(replicas.iter().map(|r| r.id.0));
        let replicas: Vec<_> = replicas.iter().zip(replica_ids).collect();
        let mut places: Vec<_> = w.places.values().collect();
        places.order_by_key(|p| (p.area, p.id));
        let place_ids = self.ids(places.iter().map(|p| p.id.0));
        let places: Vec<_> = places.iter().zip(place_ids).collect();
        let area = |(area, id): (&Area, Option<u32>)| {
            let within = replicas.iter().filter(|(r, _)| r.area == area.id);
            let of_area = places.iter().filter(|(p, _)| p.area == area.id);
            let file = AreaFile {
                items: self.items(&area.items),
                id,
                name: default_name(&area.name, &area.key),
                name_en: area.name_en.clone(),
                description: area.description.clone(),
                r#type: self.type_name(TypeKind::Area, area.area_type),
                links: area.links.iter().map(link_file).collect(),
                doors: self.mounts(&area.doors, &area.items),
                properties: area.properties.clone(),
                forms: area.forms.clone(),
                places: of_area.map(|(p, id)| self.place(p, *id)).collect(),
                replicas: within.map(|(r, id)| self.replica(r, *id)).collect(),
            };
            (area.key.clone(), file)
        };
        w.areas.values().zip(self.ids(w.areas.keys().map(|id| id.0))).map(area).collect()
    }

    fn place(&self, place: &Place, id: Option<u32>) -> PlaceFile {
        PlaceFile {
            name: place.name.clone(),
            at: point(place.at),
            id,
            name_en: place.name_en.clone(),
            heading: place.heading.map(|h| number(h.get())),
            serves: place.serves.map(|r| self.world.replicas[&r].name.clone()),
            forms: place.forms.clone(),
        }
    }

    fn replica(&self, replica: &Replica, id: Option<u32>) -> ReplicaFile {
        let door = |(door, state): (_, &DoorState)| {
            let (state, opening) = state_file(state);
            let key = self.world.doors[door].key.clone();
            (key, DoorStateFile { state, opening })
        };
        ReplicaFile {
            name: replica.name.clone(),
            object: self.world.objects[&replica.object].key.clone(),
            at: at(replica.frame.x, replica.frame.y, replica.frame.z),
            id,
            name_en: replica.name_en.clone(),
            angle: angle(replica.frame.angle),
            move_prob: u32::from(replica.move_prob),
            properties: replica.properties.clone(),
            doors: replica.door_states.iter().map(door).collect(),
            forms: replica.forms.clone(),
        }
    }

    fn plan(&self, map: &Map, id: Option<u32>) -> PlanFile {
        let marks = base_marks(&map.items.iter().map(|i| i.is_base).collect::<Vec<_>>());
        let item = |(item, base): (&crate::MapItem, bool)| PlanItemFile {
            area: self.area_key(item.area),
            at: frame_offset(&item.frame),
            angle: angle(item.frame.angle),
            base,
        };
        let side = |area: AreaId, side: &SideRef| {
            let area = &self.world.areas[&area];
            format!("{}.{}", area.key, side_text(&side.item, &side.side, &area.items))
        };
        let link = |link: &MapLink| PlanLinkFile {
            from: side(link.area, &link.side),
            to: side(link.to_area, &link.to_side),
            rel: offset(link.rel_x, link.rel_y, link.rel_z),
            angle: angle(link.rel_a),
        };
        PlanFile {
            items: map.items.iter().zip(marks).map(item).collect(),
            id,
            name: default_name(&map.name, &map.key),
            name_en: map.name_en.clone(),
            description: map.description.clone(),
            r#type: self.type_name(TypeKind::Map, map.map_type),
            frame: map.frame.clone(),
            links: map.links.iter().map(|own| link(own)).collect(),
        }
    }
}

impl Writer<'_> {
    fn zone(&self, zone: &Zone, id: Option<u32>) -> ZoneFile {
        let (kind, speed, heading) = match zone.kind {
            ZoneKind::KeepOut => (ZoneWord::KeepOut, None, None),
            ZoneKind::Closed => (ZoneWord::Closed, None, None),
            ZoneKind::Slow { speed } => (ZoneWord::Slow, Some(number(speed)), None),
            ZoneKind::OneWay { heading } => (ZoneWord::OneWay, None, Some(number(heading.get()))),
        };
        let (rooms, map, points) = match &zone.extent {
            Extent::Areas(areas) => {
                (areas.iter().map(|a| self.area_key(*a)).collect(), None, Vec::new())
            }
            Extent::Polygon { map, corners } => {
                let is_told = self.world.maps.len() != 1;
                let map = is_told.then(|| self.world.maps[map].key.clone());
                (Vec::new(), map, corners.iter().map(|p| point(*p)).collect())
            }
        };
        ZoneFile {
            kind,
            id,
            name: default_name(&zone.name, &zone.key),
            name_en: zone.name_en.clone(),
            rooms,
            map,
            points,
            speed,
            heading,
            reason: zone.reason.clone(),
            reason_en: zone.reason_en.clone(),
            from: zone.from.map(|t| t.to_string()),
            until: zone.until.map(|t| t.to_string()),
            forms: zone.forms.clone(),
        }
    }
}

fn type_file(entry: &TypeEntry, id: Option<u32>) -> TypeFile {
    TypeFile {
        name: entry.name.clone(),
        id,
        name_en: entry.name_en.clone(),
        description: entry.description.clone(),
        gender: entry.gender,
        animate: entry.animate,
        synonyms: entry.synonyms.clone(),
        traits: entry.traits.clone(),
        forms: FormsFile::clone(&entry.forms),
    }
}

fn state_file(state: &DoorState) -> (super::schema::StatusFile, Option<Number>) {
    let full = if state.status == DoorStatus::Open { 100.0 } else { 0.0 };
    let is_usual = (state.opening - full).abs() <= 0.0;
    (state.status.into(), (!is_usual).then(|| number(state.opening)))
}

fn link_file(link: &ItemLink) -> ItemLinkFile {
    let face = |item: &str, face: &Face| match face {
        Face::Base => format!("{item}.base"),
        Face::Roof => format!("{item}.roof"),
        Face::Side(side) => format!("{item}.{side}"),
    };
    ItemLinkFile {
        from: face(&link.item, &link.face),
        to: face(&link.to_item, &link.to_face),
        rel: offset(link.rel_x, link.rel_y, link.rel_z),
        angle: angle(link.rel_a),
    }
}

fn side_text(item: &str, side: &str, items: &[Item]) -> String {
    match items {
        [only] if only.id == item => side.to_owned(),
        _ => format!("{item}.{side}"),
    }
}

/// `[width, depth]` when the corners are those that `rect` gives.
fn as_rect(corners: &[Point]) -> Option<[Number; 2]> {
    let &[_, _, opposite, _] = corners else { return None };
    let [w, d] = [opposite.x, opposite.y];
    let rect = [(0.0, 0.0), (w, 0.0), (w, d), (0.0, d)].map(|(x, y)| Point::new(x, y));
    (corners == rect).then_some([number(w), number(d)])
}
