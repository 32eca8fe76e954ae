//! From the types of the file to a [`World`]: numbers ids in the order of the file and turns names into ids.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use serde::Deserialize;

use super::decode::{LONGEST_WORD, decode, likely, shortened};
use super::node::{Entry, Misprint, Node, Span};
use super::schema::{
    AreaFile, At, DomainFile, DoorFile, DoorStateFile, FORMAT, ItemFile, ItemLinkFile, MountFile,
    Number, ObjectFile, OrthoframeFile, PlaceFile, PlanFile, ReplicaFile, RobotFile,
    SideTraitsFile, StatusFile, TypeFile,
};
use crate::map::fault::{Fault, MapError, Record, Spot};
use crate::map::{
    Area, BaseVector, Domain, DomainMap, Door, DoorKind, DoorLeaf, DoorMount, DoorState,
    DoorStatus, Face, Item, ItemLink, LiftStop, Map, MapItem, MapLink, Object, Orthoframe,
    Permeability, Place, Replica, RobotProfile, SideRef, TypeEntry, TypeKind, TypeLists, World,
};
use crate::units::{
    AreaId, Cm, Deg, DomainId, DoorId, Frame, MapId, ObjectId, OrFrId, PlaceId, Point, ReplicaId,
    TypeId, name_key, nearest_name,
};

const SECTIONS: [&str; 9] =
    ["format", "domain", "robot", "type", "orthoframe", "door", "object", "area", "map"];

/// Looking for the likeliest of forty thousand names takes its time; a file with more slips has another trouble.
const MOST_GUESSES: usize = 30;

/// A world as far as it could be read, its faults, and where its records stand in the tree.
pub(super) struct Draft<'n> {
    pub(super) world: World,
    pub(super) faults: Vec<Fault>,
    pub(super) origins: BTreeMap<Record, Origin<'n>>,
    /// Records of which something could not be read: what they lack is no second fault.
    pub(super) broken: BTreeSet<Record>,
    /// Entries and lines that could not be read.
    pub(super) left_out: HashSet<Span>,
}

/// Where a record stands in the text.
#[derive(Clone)]
pub(super) struct Origin<'n> {
    pub(super) node: &'n Node,
    /// What to show for the record as a whole: its key, or its line.
    pub(super) name: Span,
}

/// Builds the world that a tree describes.
pub(super) fn build(root: &Node) -> Draft<'_> {
    let mut reader = Reader {
        root,
        faults: Vec::new(),
        origins: BTreeMap::new(),
        broken: BTreeSet::new(),
        left_out: HashSet::new(),
        guesses_left: MOST_GUESSES,
        names: Names::default(),
    };
    let world = reader.world();
    let Reader { faults, origins, broken, left_out, .. } = reader;
    Draft { world, faults, origins, broken, left_out }
}

struct Reader<'n> {
    root: &'n Node,
    faults: Vec<Fault>,
    origins: BTreeMap<Record, Origin<'n>>,
    broken: BTreeSet<Record>,
    left_out: HashSet<Span>,
    /// Names for which a likely one is still looked for among all there are.
    guesses_left: usize,
    names: Names,
}

/// What references may name.
#[derive(Default)]
struct Names {
    types: HashMap<TypeKind, Index<TypeId>>,
    orthoframes: Index<OrFrId>,
    doors: Index<DoorId>,
    objects: Index<ObjectId>,
    areas: Index<AreaId>,
    maps: Index<MapId>,
    replicas: Index<ReplicaId>,
    places: Index<PlaceId>,
}

/// The records of one kind by key and by name.
struct Index<Id> {
    keys: HashMap<String, Id>,
    folded: HashMap<String, Id>,
    spellings: Vec<String>,
    /// Names of records with faults of their own: a reference to one is no second fault.
    broken: HashSet<String>,
}

impl<Id> Default for Index<Id> {
    fn default() -> Self {
        Self {
            keys: HashMap::new(),
            folded: HashMap::new(),
            spellings: Vec::new(),
            broken: HashSet::new(),
        }
    }
}

impl<Id: Copy> Index<Id> {
    fn add(&mut self, id: Id, key: &str, names: &[&str]) {
        self.keys.entry(key.to_owned()).or_insert(id);
        for name in std::iter::once(&key).chain(names).filter(|name| !name.is_empty()) {
            self.folded.entry(name_key(name)).or_insert(id);
            self.spellings.push((*name).to_owned());
        }
    }

    fn get(&self, name: &str) -> Option<Id> {
        self.keys.get(name).or_else(|| self.folded.get(&name_key(name))).copied()
    }
}

/// A record of the file before its references are followed.
struct Raw<'n, Id, T> {
    id: Id,
    key: String,
    file: T,
    entry: &'n Entry,
}

/// Kinds of records that a section holds.
trait Keyed {
    fn id(&self) -> Option<u32>;
    fn names(&self) -> [&str; 2];
}

macro_rules! keyed {
    ($($file:ty),+) => {$(
        impl Keyed for $file {
            fn id(&self) -> Option<u32> {
                self.id
            }
            fn names(&self) -> [&str; 2] {
                [&self.name, &self.name_en]
            }
        }
    )+};
}
keyed!(OrthoframeFile, DoorFile, ObjectFile, AreaFile, PlanFile, PlaceFile, ReplicaFile, TypeFile);

/// Ids for records in file order: the given one, else the one after its predecessor's, else a new highest one.
fn number(given: &[Option<u32>]) -> Vec<u32> {
    let mut used: HashSet<u32> = given.iter().flatten().copied().collect();
    let mut highest = used.iter().copied().max().unwrap_or(0);
    let mut last = 0;
    let mut next = |given: &Option<u32>| {
        last = given.unwrap_or_else(|| {
            let follows = u32::saturating_add(last, 1);
            // Saturation ends in a duplicate, which is reported.
            if used.contains(&follows) { highest.saturating_add(1) } else { follows }
        });
        used.insert(last);
        highest = highest.max(last);
        last
    };
    given.iter().map(|given| next(given)).collect()
}

impl<'n> Reader<'n> {
    fn world(&mut self) -> World {
        self.top_level();
        let types = self.types();
        let orthoframes = self.section("orthoframe", "Ортофрейм", OrFrId, Record::Orthoframe);
        self.names.orthoframes = self.index("orthoframe", &orthoframes);
        let doors = self.section("door", "Дверь", DoorId, Record::Door);
        self.names.doors = self.index("door", &doors);
        let objects = self.section("object", "Объект", ObjectId, Record::Object);
        self.names.objects = self.index("object", &objects);
        let mut areas = self.section("area", "Помещение", AreaId, Record::Area);
        self.names.areas = self.index("area", &areas);
        let maps = self.section("map", "Карта", MapId, Record::Map);
        self.names.maps = self.index("map", &maps);
        let replicas = self.replicas(&mut areas);
        let places = self.places(&mut areas);

        let mut world = World {
            domain: self.domain(&maps),
            maps: BTreeMap::new(),
            areas: BTreeMap::new(),
            objects: BTreeMap::new(),
            orthoframes: BTreeMap::new(),
            doors: BTreeMap::new(),
            replicas: BTreeMap::new(),
            places: BTreeMap::new(),
            types,
            robot: self.robot(),
        };
        world.orthoframes = self.records(orthoframes, Self::orthoframe);
        world.doors = self.records(doors, Self::door);
        world.objects = self.records(objects, Self::object);
        world.areas = self.records(areas, Self::area);
        world.replicas = replicas.into_iter().filter_map(|r| self.replica(r)).collect();
        world.places = places.into_iter().map(|p| self.place(p)).collect();
        world.maps = self.records(maps, |reader, raw| reader.plan(raw, &world.areas));
        world
    }

    fn records<Id: Ord + Copy, F, T>(
        &mut self,
        raw: Vec<Raw<'n, Id, F>>,
        mut convert: impl FnMut(&mut Self, Raw<'n, Id, F>) -> T,
    ) -> BTreeMap<Id, T> {
        raw.into_iter().map(|raw| (raw.id, convert(self, raw))).collect()
    }

    /// A fault of a record, which is checked no further.
    fn fault(&mut self, error: MapError, spot: Spot) {
        self.broken.insert(spot.record);
        let mut fault = Fault::new(error, vec![spot]);
        fault.locate(&self.origins, &self.left_out);
        self.faults.push(fault);
    }

    fn misprints(&mut self, misprints: Vec<Misprint>) {
        self.faults.extend(misprints.into_iter().map(Fault::from));
    }

    fn decode<T: Deserialize<'n>>(&mut self, node: &'n Node, name: &Span) -> Option<T> {
        let mut misprints = Vec::new();
        let value = decode(node, name, &mut self.left_out, &mut misprints);
        self.misprints(misprints);
        value
    }

    /// The version, and keys that no version has.
    fn top_level(&mut self) {
        let mut misprints = Vec::new();
        for entry in self.root.entries() {
            if !SECTIONS.contains(&entry.key.as_str()) {
                misprints.push(Misprint {
                    error: MapError::UnknownField {
                        field: shortened(&entry.key),
                        nearest: likely(&entry.key, &SECTIONS),
                        expected: SECTIONS.join(", "),
                    },
                    span: Some(entry.key_span.clone()),
                });
            }
        }
        match self.root.entry("format") {
            None => misprints.push(Misprint {
                error: MapError::MissingField { field: "format" },
                span: Some(0..0),
            }),
            Some(entry) => {
                if let Some(format) =
                    decode::<u32>(&entry.node, &entry.key_span, &mut self.left_out, &mut misprints)
                    && format != FORMAT
                {
                    misprints.push(Misprint {
                        error: MapError::Format { found: format.to_string() },
                        span: Some(entry.node.span.clone()),
                    });
                }
            }
        }
        self.misprints(misprints);
    }

    /// Decodes the records of a section and numbers them.
    fn section<Id: Copy, T: Deserialize<'n> + Keyed>(
        &mut self,
        section: &str,
        what: &'static str,
        id: impl Fn(u32) -> Id,
        record: impl Fn(Id) -> Record,
    ) -> Vec<Raw<'n, Id, T>> {
        let entries = self.root.entry(section).map_or(&[][..], |entry| entry.node.entries());
        if let Some(entry) = self.root.entry(section)
            && !matches!(entry.node.value, super::node::Value::Table(_))
        {
            self.misprints(vec![Misprint {
                error: MapError::WrongKind {
                    found: "значение".to_owned(),
                    expected: format!("таблицы [{section}.КЛЮЧ]"),
                },
                span: Some(entry.key_span.clone()),
            }]);
        }
        let mut read = Vec::new();
        for entry in entries {
            let faults_before = self.faults.len();
            if let Some(file) = self.decode::<T>(&entry.node, &entry.key_span) {
                read.push((entry, file, self.faults.len() > faults_before));
            }
        }
        let ids = number(&read.iter().map(|(_, file, _)| file.id()).collect::<Vec<_>>());
        let mut seen = HashSet::new();
        let mut records = Vec::new();
        for ((entry, file, is_broken), number) in read.into_iter().zip(ids) {
            let id = id(number);
            if is_broken {
                self.broken.insert(record(id));
            }
            if seen.insert(number) {
                let origin = Origin { node: &entry.node, name: entry.key_span.clone() };
                self.origins.insert(record(id), origin);
                records.push(Raw { id, key: entry.key.clone(), file, entry });
            } else {
                let span = Some(entry.key_span.clone());
                let error = MapError::DuplicateId { what, id: number };
                self.misprints(vec![Misprint { error, span }]);
            }
        }
        records
    }

    fn index<Id: Copy, T: Keyed>(&self, section: &str, records: &[Raw<'_, Id, T>]) -> Index<Id> {
        let mut index = Index::default();
        for raw in records {
            index.add(raw.id, &raw.key, &raw.file.names());
        }
        let entries = self.root.entry(section).map_or(&[][..], |entry| entry.node.entries());
        index.broken = entries
            .iter()
            .flat_map(|e| [Some(e.key.as_str()), e.node.entry("name").and_then(|n| n.node.text())])
            .flatten()
            .map(name_key)
            .collect();
        index
    }

    /// Follows a reference; a fault when it leads nowhere.
    fn follow<Id: Copy>(
        &mut self,
        index: impl Fn(&Names) -> &Index<Id>,
        what: &'static str,
        name: &str,
        spot: Spot,
    ) -> Option<Id> {
        let index = index(&self.names);
        let found = index.get(name);
        if found.is_none() && !index.broken.contains(&name_key(name)) {
            let may_guess = self.guesses_left > 0 && name.len() <= 2 * LONGEST_WORD;
            let nearest = may_guess
                .then(|| nearest_name(name, index.spellings.iter().map(String::as_str)))
                .flatten()
                .map(str::to_owned);
            self.guesses_left = self.guesses_left.saturating_sub(1);
            self.fault(MapError::UnknownReference { what, name: shortened(name), nearest }, spot);
        }
        found
    }

    fn type_of(&mut self, kind: TypeKind, name: Option<&str>, spot: Spot) -> Option<TypeId> {
        let name = name?;
        if self.names.types.contains_key(&kind) {
            self.follow(|names| &names.types[&kind], "Тип", name, spot)
        } else {
            self.follow(
                |names| names.types.values().next().expect("all kinds are indexed"),
                "Тип",
                name,
                spot,
            )
        }
    }

    fn types(&mut self) -> TypeLists {
        let mut types = TypeLists::default();
        let Some(section) = self.root.entry("type") else {
            self.names.types = TypeKind::ALL.map(|kind| (kind, Index::default())).into();
            return types;
        };
        for entry in section.node.entries() {
            if TypeKind::ALL.iter().all(|kind| kind.field() != entry.key) {
                let fields = TypeKind::ALL.map(TypeKind::field);
                self.misprints(vec![Misprint {
                    error: MapError::UnknownField {
                        field: shortened(&entry.key),
                        nearest: likely(&entry.key, &fields),
                        expected: fields.join(", "),
                    },
                    span: Some(entry.key_span.clone()),
                }]);
            }
        }
        for kind in TypeKind::ALL {
            let mut index = Index::default();
            let nodes = section.node.entry(kind.field()).map_or(&[][..], |e| e.node.elements());
            let mut read = Vec::new();
            for node in nodes {
                index.broken.extend(node.entry("name").and_then(|n| n.node.text()).map(name_key));
                if let Some(file) = self.decode::<TypeFile>(node, &node.span) {
                    read.push((node, file));
                }
            }
            let ids = number(&read.iter().map(|(_, file)| file.id).collect::<Vec<_>>());
            for ((node, file), number) in read.into_iter().zip(ids) {
                let id = TypeId(number);
                index.add(id, &file.name, &[&file.name_en]);
                let origin = Origin { node, name: node.span.clone() };
                self.origins.insert(Record::Type(kind, id), origin);
                let entries = &mut types.list_mut(kind).entries;
                if entries.insert(id, type_entry(id, file)).is_some() {
                    let error = MapError::DuplicateId { what: "Тип", id: number };
                    self.misprints(vec![Misprint { error, span: Some(node.span.clone()) }]);
                }
            }
            self.names.types.insert(kind, index);
        }
        types
    }

    /// Takes the replicas out of their Areas and numbers them through the whole file.
    fn replicas(
        &mut self,
        areas: &mut [Raw<'n, AreaId, AreaFile>],
    ) -> Vec<(AreaId, ReplicaId, ReplicaFile)> {
        let lists: Vec<_> = areas
            .iter_mut()
            .map(|a| (a.id, a.entry, std::mem::take(&mut a.file.replicas)))
            .collect();
        let (lines, index) = self.lines(lists, "replicas", "Экземпляр", ReplicaId, Record::Replica);
        self.names.replicas = index;
        lines
    }

    fn places(
        &mut self,
        areas: &mut [Raw<'n, AreaId, AreaFile>],
    ) -> Vec<(AreaId, PlaceId, PlaceFile)> {
        let lists: Vec<_> =
            areas.iter_mut().map(|a| (a.id, a.entry, std::mem::take(&mut a.file.places))).collect();
        let (lines, index) = self.lines(lists, "places", "Место", PlaceId, Record::Place);
        self.names.places = index;
        lines
    }

    /// Lines of all Areas in file order, numbered.
    fn lines<Id: Copy, T: Keyed>(
        &mut self,
        lists: Vec<(AreaId, &'n Entry, Vec<T>)>,
        field: &str,
        what: &'static str,
        id: impl Fn(u32) -> Id,
        record: impl Fn(Id) -> Record,
    ) -> (Vec<(AreaId, Id, T)>, Index<Id>) {
        let given: Vec<_> = lists.iter().flat_map(|l| l.2.iter().map(Keyed::id)).collect();
        let mut ids = number(&given).into_iter();
        let mut seen = HashSet::new();
        let mut index = Index::default();
        let mut lines = Vec::new();
        for (area, entry, list) in lists {
            let nodes = entry.node.entry(field).map_or(&[][..], |e| e.node.elements());
            let name_of =
                |node: &Node| node.entry("name").and_then(|n| n.node.text()).map(name_key);
            index.broken.extend(nodes.iter().filter_map(name_of));
            // Lines that could not be read have no place in `list`.
            let read: Vec<_> =
                nodes.iter().filter(|node| !self.left_out.contains(&node.span)).collect();
            for (line, node) in list.into_iter().zip(read) {
                let number = ids.next().expect("every line was numbered");
                if !seen.insert(number) {
                    let error = MapError::DuplicateId { what, id: number };
                    self.misprints(vec![Misprint { error, span: Some(node.span.clone()) }]);
                    continue;
                }
                self.origins.insert(record(id(number)), Origin { node, name: node.span.clone() });
                let [name, name_en] = line.names();
                index.add(id(number), name, &[name_en]);
                lines.push((area, id(number), line));
            }
        }
        (lines, index)
    }

    fn domain(&mut self, maps: &[Raw<'_, MapId, PlanFile>]) -> Domain {
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
            let map = self.follow(|n| &n.maps, "Карта", &item.map, spot("maps", i).field("map"));
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
                let area = self.follow(|n| &n.areas, "Помещение", stop, at);
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
            maps: domain_maps,
            lifts,
        }
    }

    fn robot(&mut self) -> RobotProfile {
        let mut robot = RobotProfile::default();
        let Some(entry) = self.root.entry("robot") else { return robot };
        let origin = Origin { node: &entry.node, name: entry.key_span.clone() };
        self.origins.insert(Record::Robot, origin);
        let Some(file) = self.decode::<RobotFile>(&entry.node, &entry.key_span) else {
            return robot;
        };
        let or = |given: Option<Number>, default: Cm| given.map_or(default, |n| Cm::of(n.0));
        robot.radius = or(file.radius, robot.radius);
        robot.height = or(file.height, robot.height);
        robot.step = or(file.step, robot.step);
        robot.clearance = or(file.clearance, robot.clearance);
        robot.speed = file.speed.map_or(robot.speed, |n| n.0);
        robot.turn_rate = file.turn_rate.map_or(robot.turn_rate, |n| n.0);
        if let Some(start) = file.start {
            let spot = Spot::of(Record::Robot).field("start");
            robot.start = self.follow(|n| &n.places, "Место", &start, spot);
        }
        robot
    }

    /// A frame from `at` and `angle`.
    fn frame(&mut self, at: &At, angle: Option<Number>, spot: &Spot) -> Frame {
        let angle = angle.map_or(Deg::ZERO, |n| Deg::of(n.0));
        match at.0[..] {
            [] => Frame { angle, ..Frame::IDENTITY },
            [x, y] => Frame::new(x.0, y.0, 0.0, angle),
            [x, y, z] => Frame::new(x.0, y.0, z.0, angle),
            _ => {
                let error = MapError::WrongKind {
                    found: format!("список из {} значений", at.0.len()),
                    expected: "два или три числа [x, y, z]".to_owned(),
                };
                self.fault(error, spot.clone().field("at"));
                Frame::IDENTITY
            }
        }
    }

    fn orthoframe(&mut self, raw: Raw<'_, OrFrId, OrthoframeFile>) -> Orthoframe {
        let Raw { id, key, file, .. } = raw;
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
                        MapError::UnknownReference { what: "Сторона", name: side, nearest };
                    self.fault(error, at);
                }
            }
        }
        if file.reverse && area(&base) < 0.0 {
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
    fn base(&mut self, key: &str, file: &OrthoframeFile, spot: &Spot) -> Vec<BaseVector> {
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
                let (value, range) = (f64::from(corners), "от 3 до 360");
                self.fault(MapError::OutOfRange { what: "corners", value, range }, at("corners"));
                return Vec::new();
            }
            if radius <= 0.0 {
                let (value, range) = (radius, "больше 0");
                self.fault(MapError::OutOfRange { what: "radius", value, range }, at("radius"));
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

    fn apply_traits(&mut self, vector: &mut BaseVector, traits: SideTraitsFile, spot: Spot) {
        vector.side_type =
            self.type_of(TypeKind::Side, traits.r#type.as_deref(), spot.field("type"));
        vector.permeability = traits.permeability.into();
        vector.names = traits.names;
        vector.properties = traits.properties;
    }

    fn door(&mut self, raw: Raw<'_, DoorId, DoorFile>) -> Door {
        let Raw { id, key, file, .. } = raw;
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
            state: door_state(file.state, file.opening),
            properties: file.properties,
            forms: file.forms,
        }
    }

    fn object(&mut self, raw: Raw<'_, ObjectId, ObjectFile>) -> Object {
        let Raw { id, key, file, .. } = raw;
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

    fn area(&mut self, raw: Raw<'_, AreaId, AreaFile>) -> Area {
        let Raw { id, key, file, .. } = raw;
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

    fn items(&mut self, files: &[ItemFile], spot: &Spot) -> Vec<Item> {
        let none_is_base = files.iter().all(|item| !item.base);
        let mut items = Vec::new();
        for (i, file) in files.iter().enumerate() {
            let at = spot.clone().field("items").index(i);
            let frame = self.frame(&file.at, file.angle, &at);
            let orthoframe = self.follow(
                |n| &n.orthoframes,
                "Ортофрейм",
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

    fn item_links(&mut self, files: &[ItemLinkFile], spot: &Spot) -> Vec<ItemLink> {
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

    fn face(&mut self, text: &str, spot: Spot) -> Option<(String, Face)> {
        let Some((item, face)) = text.rsplit_once('.') else {
            let wanted = "«часть.roof», «часть.base» или «часть.сторона»";
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

    fn side(&mut self, text: &str, items: &[Item], spot: Spot) -> Option<SideRef> {
        let side_ref =
            |item: &str, side: &str| SideRef { item: item.to_owned(), side: side.to_owned() };
        match (text.rsplit_once('.'), items) {
            (Some((item, side)), _) => Some(side_ref(item, side)),
            (None, [only]) => Some(side_ref(&only.id, text)),
            // Without items the group has a fault of its own.
            (None, []) => None,
            (None, _) => {
                let wanted = "«часть.сторона»";
                self.fault(MapError::BadReference { text: text.to_owned(), wanted }, spot);
                None
            }
        }
    }

    fn mounts(&mut self, files: &[MountFile], items: &[Item], spot: &Spot) -> Vec<DoorMount> {
        let mut mounts = Vec::new();
        for (i, file) in files.iter().enumerate() {
            let at = spot.clone().field("doors").index(i);
            let side = self.side(&file.side, items, at.clone().field("side"));
            let door = self.follow(|n| &n.doors, "Дверь", &file.door, at.field("door"));
            if let (Some(SideRef { item, side }), Some(door)) = (side, door) {
                mounts.push(DoorMount { item, side, door, opens: file.opens.into() });
            }
        }
        mounts
    }

    fn replica(&mut self, line: (AreaId, ReplicaId, ReplicaFile)) -> Option<(ReplicaId, Replica)> {
        let (area, id, file) = line;
        let spot = Spot::of(Record::Replica(id));
        let frame = self.frame(&file.at, file.angle, &spot);
        if file.move_prob > 100 {
            let error = MapError::OutOfRange {
                what: "move_prob",
                value: f64::from(file.move_prob),
                range: "от 0 до 100",
            };
            self.fault(error, spot.clone().field("move_prob"));
        }
        let mut door_states = BTreeMap::new();
        for (door, state) in file.doors.0 {
            let at = spot.clone().field("doors").key(&door);
            let door = self.follow(|n| &n.doors, "Дверь", &door, at);
            let DoorStateFile { state, opening } = state;
            door_states.extend(door.map(|door| (door, door_state(state, opening))));
        }
        let object = self.follow(|n| &n.objects, "Объект", &file.object, spot.field("object"))?;
        let replica = Replica {
            id,
            area,
            object,
            name: file.name,
            name_en: file.name_en,
            frame,
            move_prob: file.move_prob.min(100) as u8,
            properties: file.properties,
            door_states,
            forms: file.forms,
        };
        Some((id, replica))
    }

    fn place(&mut self, line: (AreaId, PlaceId, PlaceFile)) -> (PlaceId, Place) {
        let (area, id, file) = line;
        let serves = file.serves.and_then(|name| {
            let spot = Spot::of(Record::Place(id)).field("serves");
            self.follow(|n| &n.replicas, "Экземпляр", &name, spot)
        });
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

    fn plan(&mut self, raw: Raw<'_, MapId, PlanFile>, areas: &BTreeMap<AreaId, Area>) -> Map {
        let Raw { id, key, file, .. } = raw;
        let spot = Spot::of(Record::Map(id));
        let none_is_base = file.items.iter().all(|item| !item.base);
        let mut items = Vec::new();
        for (i, item) in file.items.iter().enumerate() {
            let at = spot.clone().field("items").index(i);
            let frame = self.frame(&item.at, item.angle, &at);
            let area = self.follow(|n| &n.areas, "Помещение", &item.area, at.field("area"));
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
                links.push(MapLink {
                    area,
                    side,
                    to_area,
                    to_side,
                    rel_x: offset.x,
                    rel_y: offset.y,
                    rel_z: offset.z,
                    rel_a: offset.angle,
                });
            }
        }
        Map {
            id,
            name: or_key(file.name, &key),
            key,
            name_en: file.name_en,
            description: file.description,
            map_type: self.type_of(TypeKind::Map, file.r#type.as_deref(), spot.field("type")),
            items,
            links,
        }
    }

    /// "area.side" or "area.item.side".
    fn area_side(
        &mut self,
        text: &str,
        areas: &BTreeMap<AreaId, Area>,
        spot: Spot,
    ) -> Option<(AreaId, SideRef)> {
        let Some((name, side)) = text.split_once('.') else {
            let wanted = "«помещение.сторона» или «помещение.часть.сторона»";
            self.fault(MapError::BadReference { text: text.to_owned(), wanted }, spot);
            return None;
        };
        let area = self.follow(|n| &n.areas, "Помещение", name, spot.clone())?;
        let items = areas.get(&area).map_or(&[][..], |area| &area.items);
        Some((area, self.side(side, items, spot)?))
    }
}

impl From<Misprint> for Fault {
    fn from(misprint: Misprint) -> Self {
        let spans = misprint.span.map(|span| span.into()).into_iter().collect();
        Self { error: misprint.error, spots: Vec::new(), spans }
    }
}

fn or_key(name: String, key: &str) -> String {
    if name.is_empty() { key.to_owned() } else { name }
}

fn type_entry(id: TypeId, file: TypeFile) -> TypeEntry {
    TypeEntry {
        id,
        name: file.name,
        name_en: file.name_en,
        description: file.description,
        gender: file.gender,
        animate: file.animate,
        synonyms: file.synonyms,
        forms: file.forms,
        traits: file.traits,
    }
}

fn door_state(status: StatusFile, opening: Option<Number>) -> DoorState {
    let status: DoorStatus = status.into();
    let full = if status == DoorStatus::Open { 100.0 } else { 0.0 };
    DoorState { status, opening: opening.map_or(full, |n| n.0) }
}

/// A, B … Z, AA, AB …
pub(super) fn letters(index: usize) -> String {
    let last = char::from(b'A' + (index % 26) as u8);
    if index < 26 { last.to_string() } else { format!("{}{last}", letters(index / 26 - 1)) }
}

/// Sides A, B, C … through the given corners.
pub(super) fn lettered(corners: &[Point]) -> Vec<BaseVector> {
    let end = |i| corners[(i + 1) % corners.len()];
    corners
        .iter()
        .enumerate()
        .map(|(i, &start)| BaseVector {
            id: letters(i),
            start,
            end: end(i),
            side_type: None,
            permeability: Permeability::Impermeable,
            names: Vec::new(),
            properties: BTreeMap::new(),
        })
        .collect()
}

/// Corners of a regular polygon, counter-clockwise, the first at the origin and the second on +x.
fn regular_corners(count: u32, radius: f64) -> Vec<Point> {
    let step = std::f64::consts::TAU / f64::from(count);
    let (half_side, inner) = (radius * (step / 2.0).sin(), radius * (step / 2.0).cos());
    // Rounded to a micrometre, so that the file and its copies read the same.
    let round = |x: f64| (x * 1e4).round() / 1e4 + 0.0;
    (0..count)
        .map(|i| {
            let turn = step * (f64::from(i) - 0.5) - std::f64::consts::FRAC_PI_2;
            let (x, y) = (half_side + radius * turn.cos(), inner + radius * turn.sin());
            Point::new(round(x), round(y))
        })
        .collect()
}

/// Twice the signed area of a base, positive when counter-clockwise.
fn area(base: &[BaseVector]) -> f64 {
    let Some(first) = base.first() else { return 0.0 };
    base.iter().map(|v| (v.start - first.start).perp(&(v.end - first.start))).sum()
}
