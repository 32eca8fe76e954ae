//! The records of a world, one by one, from the tables of the file.

use std::collections::BTreeMap;
use std::sync::Arc;

use super::corners::{lettered, regular_corners, twice_area};
use super::decode::{TWO_OR_THREE, list_of};
use super::read::{Origin, Raw, Reader};
use super::schema::{
    AreaFile, At, DomainFile, DoorFile, DoorStateFile, ItemFile, ItemLinkFile, MountFile, Number,
    ObjectFile, OrthoframeFile, PlaceFile, PlanFile, ReplicaFile, RobotFile, SideTraitsFile,
    ZoneFile, ZoneWord,
};
use crate::fault::{MORE_THAN_0, MapError, Record, Spot};
use crate::units::{
    AreaId, Cm, Deg, DomainId, DoorId, Frame, MapId, ObjectId, OrFrId, PlaceId, Point, ReplicaId,
    Timestamp, ZoneId, nearest_name, said, word,
};
use crate::{
    Area, BaseVector, Domain, DomainMap, Door, DoorKind, DoorLeaf, DoorMount, DoorState,
    DoorStatus, Extent, Face, Item, ItemLink, LiftStop, Map, MapItem, MapLink, Object, Orthoframe,
    Permeability, Place, Records, Replica, RobotProfile, SideRef, TypeKind, Zone, ZoneKind,
};

impl Reader<'_> {
    pub(super) fn domain(&mut self, maps: &[Raw<MapId, PlanFile>]) -> Domain {
        let entry = self.root.entry("domain");
        if let Some(entry) = entry {
            let origin = Origin { node: &entry.node, name: entry.key_span.clone() };
            self.origins.insert(Record::Domain, origin);
        }
        let file: DomainFile =
            entry.and_then(|entry| self.decode(&entry.node, &entry.key_span)).unwrap_or_default();
        let spot = |field, i| Spot::of(Record::Domain).field(field).index(i);
        let mut domain_maps = Vec::new();
        let none_is_base = file.maps.iter().all(|m| !m.base);
        for (i, item) in file.maps.iter().enumerate() {
            let frame = self.frame(&item.at, item.angle, &spot("maps", i));
            let map =
                self.follow(|n| &n.maps, word!("map"), &item.map, spot("maps", i).field("map"));
            let is_base = item.base || (none_is_base && i == 0);
            domain_maps.extend(map.map(|map| DomainMap { map, frame, is_base }));
        }
        if let ([], [only]) = (&file.maps[..], maps) {
            domain_maps.push(DomainMap { map: only.id, frame: Frame::IDENTITY, is_base: true });
        }
        let mut lifts = Vec::new();
        for (i, lift) in file.lifts.iter().enumerate() {
            let mut stops = Vec::new();
            for (j, stop) in lift.stops.iter().enumerate() {
                let at = spot("lifts", i).field("stops").index(j);
                let area = self.follow(|n| &n.areas, word!("area-title"), stop, at);
                stops.extend(area.map(|area| LiftStop { area }));
            }
            lifts.push((lift.name.clone(), stops));
        }
        let key = if file.key.is_empty() { "domain".to_owned() } else { file.key };
        Domain {
            id: DomainId(file.id.unwrap_or(1)),
            name: or_key(file.name, &key),
            key,
            name_en: file.name_en,
            description: file.description,
            profile: file.profile.into(),
            maps: domain_maps,
            lifts,
        }
    }

    pub(super) fn robot(&mut self) -> RobotProfile {
        let mut robot = RobotProfile::default();
        let Some(entry) = self.root.entry("robot") else { return robot };
        let origin = Origin { node: &entry.node, name: entry.key_span.clone() };
        self.origins.insert(Record::Robot, origin);
        let Some(file) = self.decode::<RobotFile>(&entry.node, &entry.key_span) else {
            return robot;
        };
        let or = |given: Option<Number>, default: Cm| given.map_or(default, |n| Cm::of(n.0));
        robot.footprint = file.footprint.iter().map(|[x, y]| Point::new(x.0, y.0)).collect();
        let reach = robot.footprint.iter().map(|p| p.coords.norm()).reduce(f64::max);
        // Rounded up, so that the disc covers the corners.
        let covering = reach.map(|r| Cm::of((r * 100.0).ceil() / 100.0));
        robot.radius = or(file.radius, covering.unwrap_or(robot.radius));
        robot.height = or(file.height, robot.height);
        robot.step = or(file.step, robot.step);
        robot.clearance = or(file.clearance, robot.clearance);
        robot.speed = file.speed.map_or(robot.speed, |n| n.0);
        robot.turn_rate = file.turn_rate.map_or(robot.turn_rate, |n| n.0);
        robot.opens = file.opens.unwrap_or(false);
        robot.start = file.start.and_then(|start| self.start(&start));
        robot
    }

    /// Where the robot stands when nothing else is known.
    pub(super) fn start(&mut self, name: &str) -> Option<PlaceId> {
        let spot = Spot::of(Record::Robot).field("start");
        self.follow(|n| &n.places, word!("place-title"), name, spot)
    }

    /// A frame from `at` and `angle`.
    pub(super) fn frame(&mut self, at: &At, angle: Option<Number>, spot: &Spot) -> Frame {
        let angle = angle.map_or(Deg::ZERO, |n| Deg::of(n.0));
        match at.0[..] {
            [] => Frame { angle, ..Frame::IDENTITY },
            [x, y] => Frame::new(x.0, y.0, 0.0, angle),
            [x, y, z] => Frame::new(x.0, y.0, z.0, angle),
            _ => {
                let error = MapError::WrongKind {
                    found: list_of(at.0.len()),
                    expected: TWO_OR_THREE.into(),
                };
                self.fault(error, spot.clone().field("at"));
                Frame::IDENTITY
            }
        }
    }

    pub(super) fn orthoframe(&mut self, raw: Raw<OrFrId, OrthoframeFile>) -> Orthoframe {
        let Raw { id, key, file } = raw;
        let spot = Spot::of(Record::Orthoframe(id));
        let mut base = self.base(&key, &file, &spot);
        // A base that could not be read has no sides to speak of.
        let sides = if base.is_empty() { Vec::new() } else { file.side.0 };
        for (side, traits) in sides {
            let at = spot.clone().field("side").key(&side);
            match base.iter_mut().find(|v| v.id == side) {
                Some(vector) => self.apply_traits(vector, traits, at),
                None => {
                    let nearest = nearest_name(&side, base.iter().map(|v| v.id.as_str()));
                    let nearest = nearest.map(str::to_owned);
                    let error =
                        MapError::UnknownReference { what: said!("side"), name: side, nearest };
                    self.fault(error, at);
                }
            }
        }
        if file.reverse && twice_area(&base) < 0.0 {
            base.reverse();
            base.iter_mut().for_each(|v| std::mem::swap(&mut v.start, &mut v.end));
        }
        Orthoframe {
            id,
            name: or_key(file.name, &key),
            key,
            name_en: file.name_en,
            description: file.description,
            frame_type: self.type_of(
                TypeKind::Orthoframe,
                file.r#type.as_deref(),
                spot.clone().field("type"),
            ),
            shape: self.type_of(TypeKind::Shape, file.shape.as_deref(), spot.field("shape")),
            base,
            height: Cm::of(file.height.map_or(0.0, |n| n.0)),
            base_permeability: file.base.into(),
            roof_permeability: file.roof.into(),
            roof_scale: file.roof_scale.map_or(1.0, |n| n.0),
            properties: file.properties,
        }
    }

    /// The base vectors, whichever way they are given.
    pub(super) fn base(
        &mut self,
        key: &str,
        file: &OrthoframeFile,
        spot: &Spot,
    ) -> Vec<BaseVector> {
        let ways = usize::from(file.rect.is_some())
            + usize::from(file.regular.is_some())
            + usize::from(!file.points.is_empty())
            + usize::from(!file.sides.is_empty());
        if ways != 1 {
            // A base that could not be read is one already.
            if ways > 1 || !self.broken.contains(&spot.record) {
                let error = MapError::BaseForm { name: key.to_owned(), count: ways };
                self.fault(error, spot.clone());
            }
            return Vec::new();
        }
        if let Some([w, d]) = file.rect {
            let corners = [(0.0, 0.0), (w.0, 0.0), (w.0, d.0), (0.0, d.0)];
            return lettered(&corners.map(|(x, y)| Point::new(x, y)));
        }
        if let Some(regular) = &file.regular {
            let (corners, radius) = (regular.corners, regular.radius.0);
            let at = |field| spot.clone().field("regular").field(field);
            if !(3..=360).contains(&corners) {
                let (value, range) = (f64::from(corners), said!("from-3-to-360"));
                let error = MapError::OutOfRange { what: "corners".into(), value, range };
                self.fault(error, at("corners"));
                return Vec::new();
            }
            if radius <= 0.0 {
                let (value, range) = (radius, MORE_THAN_0.into());
                let error = MapError::OutOfRange { what: "radius".into(), value, range };
                self.fault(error, at("radius"));
                return Vec::new();
            }
            return lettered(&regular_corners(corners, radius));
        }
        if !file.points.is_empty() {
            let corners: Vec<_> = file.points.iter().map(|p| Point::new(p[0].0, p[1].0)).collect();
            return lettered(&corners);
        }
        let mut vectors = Vec::new();
        for (i, side) in file.sides.iter().enumerate() {
            let mut vector = BaseVector {
                id: side.id.clone(),
                start: Point::new(side.from[0].0, side.from[1].0),
                end: Point::new(side.to[0].0, side.to[1].0),
                side_type: None,
                permeability: Permeability::Impermeable,
                names: Vec::new(),
                properties: BTreeMap::new(),
            };
            let traits = SideTraitsFile {
                r#type: side.r#type.clone(),
                permeability: side.permeability,
                names: side.names.clone(),
                properties: side.properties.clone(),
            };
            self.apply_traits(&mut vector, traits, spot.clone().field("sides").index(i));
            vectors.push(vector);
        }
        vectors
    }

    pub(super) fn apply_traits(
        &mut self,
        vector: &mut BaseVector,
        traits: SideTraitsFile,
        spot: Spot,
    ) {
        vector.side_type =
            self.type_of(TypeKind::Side, traits.r#type.as_deref(), spot.field("type"));
        vector.permeability = traits.permeability.into();
        vector.names = traits.names;
        vector.properties = traits.properties;
    }

    pub(super) fn door(&mut self, raw: Raw<DoorId, DoorFile>) -> Door {
        let Raw { id, key, file } = raw;
        let kind: DoorKind = file.kind.into();
        let equal_share = 1.0 / file.leaves.len().max(1) as f64;
        let full = if kind == DoorKind::Hinged { 90.0 } else { 100.0 };
        let leaves = file.leaves.iter().map(|leaf| DoorLeaf {
            hinge: leaf.hinge.into(),
            share: leaf.share.map_or(equal_share, |n| n.0),
            thickness: Cm::of(leaf.thickness.map_or(4.0, |n| n.0)),
            max_open: leaf.max_open.map_or(full, |n| n.0),
        });
        let spot = Spot::of(Record::Door(id)).field("type");
        Door {
            id,
            name: or_key(file.name, &key),
            key,
            name_en: file.name_en,
            door_type: self.type_of(TypeKind::Door, file.r#type.as_deref(), spot),
            kind,
            width: Cm::of(file.width.0),
            height: Cm::of(file.height.0),
            leaves: leaves.collect(),
            state: door_state(file.state.into(), file.opening),
            properties: file.properties,
            forms: file.forms,
        }
    }

    pub(super) fn object(&mut self, raw: Raw<ObjectId, ObjectFile>) -> Object {
        let Raw { id, key, file } = raw;
        let spot = Spot::of(Record::Object(id));
        let items = self.items(&file.items, &spot);
        Object {
            id,
            name: or_key(file.name, &key),
            key,
            name_en: file.name_en,
            description: file.description,
            object_type: self.type_of(
                TypeKind::Object,
                file.r#type.as_deref(),
                spot.clone().field("type"),
            ),
            links: self.item_links(&file.links, &spot),
            front: file.front.and_then(|f| self.side(&f, &items, spot.clone().field("front"))),
            back: file.back.and_then(|b| self.side(&b, &items, spot.clone().field("back"))),
            doors: self.mounts(&file.doors, &items, &spot),
            items,
            properties: file.properties,
        }
    }

    pub(super) fn area(&mut self, raw: Raw<AreaId, AreaFile>) -> Area {
        let Raw { id, key, file } = raw;
        let spot = Spot::of(Record::Area(id));
        let items = self.items(&file.items, &spot);
        Area {
            id,
            name: or_key(file.name, &key),
            key,
            name_en: file.name_en,
            description: file.description,
            area_type: self.type_of(
                TypeKind::Area,
                file.r#type.as_deref(),
                spot.clone().field("type"),
            ),
            links: self.item_links(&file.links, &spot),
            doors: self.mounts(&file.doors, &items, &spot),
            items,
            properties: file.properties,
            forms: file.forms,
        }
    }

    pub(super) fn items(&mut self, files: &[ItemFile], spot: &Spot) -> Vec<Item> {
        let none_is_base = files.iter().all(|item| !item.base);
        let mut items = Vec::new();
        for (i, file) in files.iter().enumerate() {
            let at = spot.clone().field("items").index(i);
            let frame = self.frame(&file.at, file.angle, &at);
            let orthoframe = self.follow(
                |n| &n.orthoframes,
                word!("orthoframe"),
                &file.orthoframe,
                at.field("orthoframe"),
            );
            items.extend(orthoframe.map(|orthoframe| Item {
                id: file.id.clone(),
                orthoframe,
                frame,
                is_base: file.base || (none_is_base && i == 0),
            }));
        }
        items
    }

    pub(super) fn item_links(&mut self, files: &[ItemLinkFile], spot: &Spot) -> Vec<ItemLink> {
        let mut links = Vec::new();
        for (i, file) in files.iter().enumerate() {
            let at = spot.clone().field("links").index(i);
            let offset = self.frame(&file.rel, file.angle, &at);
            let from = self.face(&file.from, at.clone().field("from"));
            let to = self.face(&file.to, at.field("to"));
            if let (Some((item, face)), Some((to_item, to_face))) = (from, to) {
                links.push(ItemLink {
                    item,
                    face,
                    to_item,
                    to_face,
                    rel_x: offset.x,
                    rel_y: offset.y,
                    rel_z: offset.z,
                    rel_a: offset.angle,
                });
            }
        }
        links
    }

    pub(super) fn face(&mut self, text: &str, spot: Spot) -> Option<(String, Face)> {
        let Some((item, face)) = text.rsplit_once('.') else {
            let wanted = word!("part-roof-part-base-or-part-side").into();
            self.fault(MapError::BadReference { text: text.to_owned(), wanted }, spot);
            return None;
        };
        let face = match face {
            "base" | "база" => Face::Base,
            "roof" | "потолок" => Face::Roof,
            side => Face::Side(side.to_owned()),
        };
        Some((item.to_owned(), face))
    }

    pub(super) fn side(&mut self, text: &str, items: &[Item], spot: Spot) -> Option<SideRef> {
        let side_ref =
            |item: &str, side: &str| SideRef { item: item.to_owned(), side: side.to_owned() };
        match (text.rsplit_once('.'), items) {
            (Some((item, side)), _) => Some(side_ref(item, side)),
            (None, [only]) => Some(side_ref(&only.id, text)),
            // Without items the group has a fault of its own.
            (None, []) => None,
            (None, _) => {
                let wanted = said!("part-side");
                self.fault(MapError::BadReference { text: text.to_owned(), wanted }, spot);
                None
            }
        }
    }

    pub(super) fn mounts(
        &mut self,
        files: &[MountFile],
        items: &[Item],
        spot: &Spot,
    ) -> Vec<DoorMount> {
        let mut mounts = Vec::new();
        for (i, file) in files.iter().enumerate() {
            let at = spot.clone().field("doors").index(i);
            let side = self.side(&file.side, items, at.clone().field("side"));
            let door = self.follow(|n| &n.doors, word!("door"), &file.door, at.field("door"));
            if let (Some(SideRef { item, side }), Some(door)) = (side, door) {
                mounts.push(DoorMount { item, side, door, opens: file.opens.into() });
            }
        }
        mounts
    }

    pub(super) fn replica(
        &mut self,
        line: (AreaId, ReplicaId, ReplicaFile),
    ) -> Option<(ReplicaId, Replica)> {
        let (area, id, file) = line;
        let spot = Spot::of(Record::Replica(id));
        let frame = self.frame(&file.at, file.angle, &spot);
        let move_prob = self.move_prob(id, file.move_prob);
        let mut door_states = BTreeMap::new();
        for (door, state) in file.doors.0 {
            let at = spot.clone().field("doors").key(&door);
            let door = self.follow(|n| &n.doors, word!("door"), &door, at);
            let DoorStateFile { state, opening } = state;
            door_states.extend(door.map(|door| (door, door_state(state.into(), opening))));
        }
        let object =
            self.follow(|n| &n.objects, word!("object-title"), &file.object, spot.field("object"))?;
        let replica = Replica {
            id,
            area,
            object,
            name: file.name,
            name_en: file.name_en,
            frame,
            move_prob,
            properties: file.properties,
            door_states,
            forms: file.forms,
        };
        Some((id, replica))
    }

    /// How likely a replica is to be moved, in percent.
    pub(super) fn move_prob(&mut self, id: ReplicaId, percent: u32) -> u8 {
        if percent > 100 {
            let error = MapError::OutOfRange {
                what: "move_prob".into(),
                value: f64::from(percent),
                range: said!("from-0-to-100"),
            };
            self.fault(error, Spot::of(Record::Replica(id)).field("move_prob"));
        }
        percent.min(100) as u8
    }

    /// The replica that is served from a place.
    pub(super) fn served(&mut self, from: PlaceId, name: &str) -> Option<ReplicaId> {
        let spot = Spot::of(Record::Place(from)).field("serves");
        self.follow(|n| &n.replicas, word!("replica-title"), name, spot)
    }

    pub(super) fn place(&mut self, line: (AreaId, PlaceId, PlaceFile)) -> (PlaceId, Place) {
        let (area, id, file) = line;
        let serves = file.serves.and_then(|name| self.served(id, &name));
        let place = Place {
            id,
            area,
            name: file.name,
            name_en: file.name_en,
            at: Point::new(file.at[0].0, file.at[1].0),
            heading: file.heading.map(|n| Deg::of(n.0)),
            serves,
            forms: file.forms,
        };
        (id, place)
    }

    /// None where it does not say where it is or what is to be done there.
    pub(super) fn zone(&mut self, raw: Raw<ZoneId, ZoneFile>) -> Option<Zone> {
        let Raw { id, key, file } = raw;
        let spot = Spot::of(Record::Zone(id));
        let extent = self.extent(&file, &spot);
        let kind = match (file.kind, file.speed, file.heading) {
            (ZoneWord::KeepOut, None, None) => Some(ZoneKind::KeepOut),
            (ZoneWord::Closed, None, None) => Some(ZoneKind::Closed),
            (ZoneWord::Slow, Some(speed), None) => Some(ZoneKind::Slow { speed: speed.0 }),
            (ZoneWord::OneWay, None, Some(heading)) => {
                Some(ZoneKind::OneWay { heading: Deg::of(heading.0) })
            }
            (ZoneWord::Slow, None, _) => {
                self.fault(MapError::MissingField { field: "speed" }, spot.clone());
                None
            }
            (ZoneWord::OneWay, _, None) => {
                self.fault(MapError::MissingField { field: "heading" }, spot.clone());
                None
            }
            (_, speed, _) => {
                let (field, message) = match (file.kind, speed) {
                    (ZoneWord::OneWay, _) | (ZoneWord::KeepOut | ZoneWord::Closed, Some(_)) => {
                        let words = word!("only-a-slow-zone-has-a-speed");
                        ("speed", words)
                    }
                    _ => {
                        let words = word!("only-a-one-way-zone-has-a");
                        ("heading", words)
                    }
                };
                let error = MapError::BadValue { message: message.into() };
                self.fault(error, spot.clone().field(field));
                None
            }
        };
        let from = self.moment(file.from.as_deref(), spot.clone().field("from"));
        let until = self.moment(file.until.as_deref(), spot.field("until"));
        Some(Zone {
            id,
            name: or_key(file.name, &key),
            key,
            name_en: file.name_en,
            kind: kind?,
            extent: extent?,
            reason: file.reason,
            reason_en: file.reason_en,
            from,
            until,
            forms: file.forms,
        })
    }

    fn extent(&mut self, file: &ZoneFile, spot: &Spot) -> Option<Extent> {
        let both = word!("give-either-rooms-or-points");
        match (file.rooms.is_empty(), file.points.is_empty()) {
            (true, true) => {
                self.fault(MapError::BadValue { message: both.into() }, spot.clone());
                None
            }
            (false, true) if file.map.is_none() => {
                let mut areas = Vec::new();
                for (i, room) in file.rooms.iter().enumerate() {
                    let at = spot.clone().field("rooms").index(i);
                    areas.extend(self.follow(|n| &n.areas, word!("area-title"), room, at));
                }
                (areas.len() == file.rooms.len()).then_some(Extent::Areas(areas))
            }
            (true, false) => {
                let map = match &file.map {
                    Some(map) => {
                        let at = spot.clone().field("map");
                        self.follow(|n| &n.maps, word!("map"), map, at)
                    }
                    None => {
                        let only = self.names.maps.only();
                        if only.is_none() {
                            let error = MapError::MissingField { field: "map" };
                            self.fault(error, spot.clone());
                        }
                        only
                    }
                };
                let corners = file.points.iter().map(|[x, y]| Point::new(x.0, y.0)).collect();
                Some(Extent::Polygon { map: map?, corners })
            }
            _ => {
                let field = if file.points.is_empty() { "map" } else { "points" };
                let error = MapError::BadValue { message: both.into() };
                self.fault(error, spot.clone().field(field));
                None
            }
        }
    }

    fn moment(&mut self, text: Option<&str>, spot: Spot) -> Option<Timestamp> {
        let moment = text?.parse::<Timestamp>();
        if moment.is_err() {
            let message = word!("a-moment-is-written-like-this-2026");
            self.fault(MapError::BadValue { message: message.into() }, spot);
        }
        moment.ok()
    }

    pub(super) fn plan(&mut self, raw: Raw<MapId, PlanFile>, areas: &Records<AreaId, Area>) -> Map {
        let Raw { id, key, file } = raw;
        let spot = Spot::of(Record::Map(id));
        let none_is_base = file.items.iter().all(|item| !item.base);
        let mut items = Vec::new();
        for (i, item) in file.items.iter().enumerate() {
            let at = spot.clone().field("items").index(i);
            let frame = self.frame(&item.at, item.angle, &at);
            let area = self.follow(|n| &n.areas, word!("area-title"), &item.area, at.field("area"));
            let is_base = item.base || (none_is_base && i == 0);
            items.extend(area.map(|area| MapItem { area, frame, is_base }));
        }
        let mut links = Vec::new();
        for (i, link) in file.links.iter().enumerate() {
            let at = spot.clone().field("links").index(i);
            let offset = self.frame(&link.rel, link.angle, &at);
            let from = self.area_side(&link.from, areas, at.clone().field("from"));
            let to = self.area_side(&link.to, areas, at.field("to"));
            if let (Some((area, side)), Some((to_area, to_side))) = (from, to) {
                let Frame { x: rel_x, y: rel_y, z: rel_z, angle: rel_a } = offset;
                let link = MapLink { area, side, to_area, to_side, rel_x, rel_y, rel_z, rel_a };
                links.push(Arc::new(link));
            }
        }
        Map {
            id,
            name: or_key(file.name, &key),
            key,
            name_en: file.name_en,
            description: file.description,
            map_type: self.type_of(TypeKind::Map, file.r#type.as_deref(), spot.field("type")),
            frame: file.frame,
            items,
            links,
        }
    }

    /// "area.side" or "area.item.side".
    pub(super) fn area_side(
        &mut self,
        text: &str,
        areas: &Records<AreaId, Area>,
        spot: Spot,
    ) -> Option<(AreaId, SideRef)> {
        let Some((name, side)) = text.split_once('.') else {
            let wanted = word!("area-side-or-area-part-side").into();
            self.fault(MapError::BadReference { text: text.to_owned(), wanted }, spot);
            return None;
        };
        let area = self.follow(|n| &n.areas, word!("area-title"), name, spot.clone())?;
        let items = areas.get(&area).map_or(&[][..], |area| &area.items);
        Some((area, self.side(side, items, spot)?))
    }
}

fn or_key(name: String, key: &str) -> String {
    if name.is_empty() { key.to_owned() } else { name }
}

pub(super) fn door_state(status: DoorStatus, opening: Option<Number>) -> DoorState {
    let full = if status == DoorStatus::Open { 100.0 } else { 0.0 };
    DoorState { status, opening: opening.map_or(full, |n| n.0) }
}
