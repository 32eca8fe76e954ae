//! From the types of the file to a [`World`]: numbers ids in the order of the file and turns names into ids.

use std::collections::{BTreeMap, BTreeSet, HashMap, HashSet};

use serde::Deserialize;

use super::decode::{LONGEST_WORD, decode, likely, shortened};
use super::node::{Misprint, Node, Span, Value};
use super::schema::{
    AreaFile, DoorFile, FORMAT, ObjectFile, OrthoframeFile, PlaceFile, PlanFile, ReplicaFile,
    TypeFile, ZoneFile,
};
use crate::fault::{Fault, MapError, Record, Spot};
use crate::units::{
    AreaId, DoorId, Gather as _, MapId, ObjectId, OrFrId, Piece, PlaceId, ReplicaId, TypeId,
    ZoneId, name_key, nearest_name, said, word,
};
use crate::{TypeEntry, TypeKind, TypeLists, World};

const SECTIONS: [&str; 10] =
    ["format", "domain", "robot", "type", "orthoframe", "door", "object", "area", "map", "zone"];

/// Looking for the likeliest of forty thousand names takes its time; a file with more slips has another trouble.
pub(super) const MOST_GUESSES: usize = 30;

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
    let mut reader = Reader::of(root);
    let world = reader.world();
    let Reader { faults, origins, broken, left_out, .. } = reader;
    Draft { world, faults, origins, broken, left_out }
}

/// Where a record stands in a text.
pub(super) type Elsewhere<'n> = Box<dyn Fn(Record) -> Option<Origin<'n>> + 'n>;

pub(super) struct Reader<'n> {
    pub(super) root: &'n Node,
    faults: Vec<Fault>,
    pub(super) origins: BTreeMap<Record, Origin<'n>>,
    /// Where records stand that are told of elsewhere.
    elsewhere: Option<Elsewhere<'n>>,
    pub(super) broken: BTreeSet<Record>,
    left_out: HashSet<Span>,
    /// Names for which a likely one is still looked for among all there are.
    guesses_left: usize,
    pub(super) names: Names<'n>,
}

/// What references may name.
#[derive(Default)]
pub(super) struct Names<'n> {
    pub(super) types: HashMap<TypeKind, Index<'n, TypeId>>,
    pub(super) orthoframes: Index<'n, OrFrId>,
    pub(super) doors: Index<'n, DoorId>,
    pub(super) objects: Index<'n, ObjectId>,
    pub(super) areas: Index<'n, AreaId>,
    pub(super) maps: Index<'n, MapId>,
    pub(super) replicas: Index<'n, ReplicaId>,
    pub(super) places: Index<'n, PlaceId>,
}

/// The records of one kind by key and by name.
pub(super) struct Index<'n, Id> {
    keys: HashMap<String, Id>,
    folded: HashMap<String, Id>,
    spellings: Vec<String>,
    /// Names of records with faults of their own: a reference to one is no second fault.
    broken: HashSet<String>,
    /// Records that do not stand in the text.
    behind: Option<Behind<'n, Id>>,
}

/// What a name leads to.
type ByName<'n, T> = Box<dyn Fn(&str) -> Option<T> + 'n>;

/// Records of a world to which a text refers.
pub(super) struct Behind<'n, Id> {
    pub(super) find: ByName<'n, Id>,
    pub(super) nearest: ByName<'n, String>,
    /// The record where there is but one.
    pub(super) only: Option<Id>,
}

impl<'n, Id> From<Behind<'n, Id>> for Index<'n, Id> {
    fn from(behind: Behind<'n, Id>) -> Self {
        Self { behind: Some(behind), ..Self::default() }
    }
}

impl<Id> Default for Index<'_, Id> {
    fn default() -> Self {
        Self {
            keys: HashMap::new(),
            folded: HashMap::new(),
            spellings: Vec::new(),
            broken: HashSet::new(),
            behind: None,
        }
    }
}

impl<Id: Copy> Index<'_, Id> {
    fn add(&mut self, id: Id, key: &str, names: &[&str]) {
        self.keys.entry(key.to_owned()).or_insert(id);
        for name in std::iter::once(&key).chain(names).filter(|name| !name.is_empty()) {
            self.folded.entry(name_key(name)).or_insert(id);
            self.spellings.push((*name).to_owned());
        }
    }

    /// The record where there is but one.
    pub(super) fn only(&self) -> Option<Id> {
        if let Some(behind) = &self.behind {
            return behind.only;
        }
        let mut ids = self.keys.values().copied();
        ids.next().filter(|_| ids.next().is_none())
    }

    fn get(&self, name: &str) -> Option<Id> {
        if let Some(behind) = &self.behind {
            return (behind.find)(name);
        }
        self.keys.get(name).or_else(|| self.folded.get(&name_key(name))).copied()
    }

    /// The likeliest name.
    fn nearest(&self, name: &str) -> Option<String> {
        match &self.behind {
            Some(behind) => (behind.nearest)(name),
            None => {
                let spellings = self.spellings.iter().map(String::as_str);
                nearest_name(name, spellings).map(str::to_owned)
            }
        }
    }
}

/// A record of the file before its references are followed.
pub(super) struct Raw<Id, T> {
    pub(super) id: Id,
    pub(super) key: String,
    pub(super) file: T,
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
keyed!(
    OrthoframeFile,
    DoorFile,
    ObjectFile,
    AreaFile,
    PlanFile,
    PlaceFile,
    ReplicaFile,
    TypeFile,
    ZoneFile
);

/// Ids for records in file order: the given one, else the one after its predecessor's, else a new highest one.
fn number(given: &[Option<u32>]) -> Vec<u32> {
    let mut used: HashSet<u32> = given.iter().flatten().copied().collect();
    let mut highest = used.iter().copied().max().unwrap_or(0);
    let mut last = 0;
    let next = |given: &Option<u32>| {
        last = given.unwrap_or_else(|| {
            let follows = u32::saturating_add(last, 1);
            // Saturation ends in a duplicate, which is reported.
            if used.contains(&follows) { highest.saturating_add(1) } else { follows }
        });
        used.insert(last);
        highest = highest.max(last);
        last
    };
    given.iter().map(next).collect()
}

impl<'n> Reader<'n> {
    fn of(root: &'n Node) -> Self {
        Reader {
            root,
            faults: Vec::new(),
            origins: BTreeMap::new(),
            elsewhere: None,
            broken: BTreeSet::new(),
            left_out: HashSet::new(),
            guesses_left: MOST_GUESSES,
            names: Names::default(),
        }
    }

    /// For single records, of which it is told elsewhere what they may name and where they stand.
    pub(super) fn among(
        names: Names<'n>,
        elsewhere: Elsewhere<'n>,
        left_out: HashSet<Span>,
        broken: BTreeSet<Record>,
    ) -> Self {
        const NO_TEXT: &Node = &Node { span: 0..0, value: Value::Nothing };
        Reader { names, elsewhere: Some(elsewhere), left_out, broken, ..Self::of(NO_TEXT) }
    }

    /// What was wrong with the records, and with which.
    pub(super) fn finish(self) -> (Vec<Fault>, BTreeSet<Record>) {
        (self.faults, self.broken)
    }

    fn world(&mut self) -> World {
        self.top_level();
        let types = self.types();
        let orthoframes =
            self.section("orthoframe", word!("orthoframe"), OrFrId, Record::Orthoframe);
        self.names.orthoframes = self.index("orthoframe", &orthoframes);
        let doors = self.section("door", word!("door"), DoorId, Record::Door);
        self.names.doors = self.index("door", &doors);
        let objects = self.section("object", word!("object-title"), ObjectId, Record::Object);
        self.names.objects = self.index("object", &objects);
        let mut areas = self.section("area", word!("area-title"), AreaId, Record::Area);
        self.names.areas = self.index("area", &areas);
        let maps = self.section("map", word!("map"), MapId, Record::Map);
        self.names.maps = self.index("map", &maps);
        let zones = self.section("zone", word!("zone-title"), ZoneId, Record::Zone);
        let replicas = self.replicas(&mut areas);
        let places = self.places(&mut areas);

        let mut world =
            World { domain: self.domain(&maps), types, robot: self.robot(), ..World::empty() };
        world.orthoframes = self.records(orthoframes, Self::orthoframe).into();
        world.doors = self.records(doors, Self::door).into();
        world.objects = self.records(objects, Self::object).into();
        world.areas = self.records(areas, Self::area).into();
        world.replicas = replicas.into_iter().filter_map(|r| self.replica(r)).collect();
        world.places = places.into_iter().map(|p| self.place(p)).collect();
        let zones = zones.into_iter().filter_map(|raw| self.zone(raw));
        world.zones = zones.map(|zone| (zone.id, zone)).collect();
        world.maps = self.records(maps, |reader, raw| reader.plan(raw, &world.areas)).into();
        world
    }

    fn records<Id: Ord + Copy, F, T>(
        &mut self,
        raw: Vec<Raw<Id, F>>,
        mut convert: impl FnMut(&mut Self, Raw<Id, F>) -> T,
    ) -> BTreeMap<Id, T> {
        raw.into_iter().map(|raw| (raw.id, convert(self, raw))).gather()
    }

    /// A fault of a record, which is checked no further.
    pub(super) fn fault(&mut self, error: MapError, spot: Spot) {
        self.broken.insert(spot.record);
        let mut fault = Fault::new(error, vec![spot]);
        let elsewhere = |record| self.elsewhere.as_ref().and_then(|find| find(record));
        let origin = |record| self.origins.get(&record).cloned().or_else(|| elsewhere(record));
        fault.locate(origin, &self.left_out);
        self.faults.push(fault);
    }

    fn misprints(&mut self, misprints: Vec<Misprint>) {
        self.faults.extend(misprints.into_iter().map(Fault::from));
    }

    pub(super) fn decode<T: Deserialize<'n>>(&mut self, node: &'n Node, name: &Span) -> Option<T> {
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
        what: Piece,
        id: impl Fn(u32) -> Id,
        record: impl Fn(Id) -> Record,
    ) -> Vec<Raw<Id, T>> {
        let entries = self.root.entry(section).map_or(&[][..], |entry| entry.node.entries());
        if let Some(entry) = self.root.entry(section)
            && !matches!(entry.node.value, Value::Table(_))
        {
            self.misprints(vec![Misprint {
                error: MapError::WrongKind {
                    found: said!("a-value"),
                    expected: said!("tables-key-2", section),
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
                records.push(Raw { id, key: entry.key.clone(), file });
            } else {
                let span = Some(entry.key_span.clone());
                let error = MapError::DuplicateId { what: what.into(), id: number };
                self.misprints(vec![Misprint { error, span }]);
            }
        }
        records
    }

    fn index<Id: Copy, T: Keyed>(&self, section: &str, records: &[Raw<Id, T>]) -> Index<'n, Id> {
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
    pub(super) fn follow<Id: Copy>(
        &mut self,
        index: impl for<'i> Fn(&'i Names<'n>) -> &'i Index<'n, Id>,
        what: Piece,
        name: &str,
        spot: Spot,
    ) -> Option<Id> {
        let index = index(&self.names);
        let found = index.get(name);
        if found.is_none() && !index.broken.contains(&name_key(name)) {
            let may_guess = self.guesses_left > 0 && name.len() <= 2 * LONGEST_WORD;
            let nearest = may_guess.then(|| index.nearest(name)).flatten();
            self.guesses_left = self.guesses_left.saturating_sub(1);
            let (what, name) = (what.into(), shortened(name));
            self.fault(MapError::UnknownReference { what, name, nearest }, spot);
        }
        found
    }

    pub(super) fn type_of(
        &mut self,
        kind: TypeKind,
        name: Option<&str>,
        spot: Spot,
    ) -> Option<TypeId> {
        let name = name?;
        if self.names.types.contains_key(&kind) {
            self.follow(|names| &names.types[&kind], word!("type-title"), name, spot)
        } else {
            self.follow(
                |names| names.types.values().next().expect("all kinds are indexed"),
                word!("type-title"),
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
                    let error = MapError::DuplicateId { what: said!("type-title"), id: number };
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
        areas: &mut [Raw<AreaId, AreaFile>],
    ) -> Vec<(AreaId, ReplicaId, ReplicaFile)> {
        let lists: Vec<_> =
            areas.iter_mut().map(|a| (a.id, std::mem::take(&mut a.file.replicas))).collect();
        let (lines, index) =
            self.lines(lists, "replicas", word!("replica-title"), ReplicaId, Record::Replica);
        self.names.replicas = index;
        lines
    }

    fn places(&mut self, areas: &mut [Raw<AreaId, AreaFile>]) -> Vec<(AreaId, PlaceId, PlaceFile)> {
        let lists: Vec<_> =
            areas.iter_mut().map(|a| (a.id, std::mem::take(&mut a.file.places))).collect();
        let (lines, index) =
            self.lines(lists, "places", word!("place-title"), PlaceId, Record::Place);
        self.names.places = index;
        lines
    }

    /// Lines of all Areas in file order, numbered.
    fn lines<Id: Copy, T: Keyed>(
        &mut self,
        lists: Vec<(AreaId, Vec<T>)>,
        field: &str,
        what: Piece,
        id: impl Fn(u32) -> Id,
        record: impl Fn(Id) -> Record,
    ) -> (Vec<(AreaId, Id, T)>, Index<'n, Id>) {
        let given: Vec<_> = lists.iter().flat_map(|l| l.1.iter().map(Keyed::id)).collect();
        let mut ids = number(&given).into_iter();
        let mut seen = HashSet::new();
        let mut index = Index::default();
        let mut lines = Vec::new();
        for (area, list) in lists {
            let of_area = self.origins[&Record::Area(area)].node;
            let nodes = of_area.entry(field).map_or(&[][..], |e| e.node.elements());
            let name_of =
                |node: &Node| node.entry("name").and_then(|n| n.node.text()).map(name_key);
            index.broken.extend(nodes.iter().filter_map(name_of));
            // Lines that could not be read have no place in `list`.
            let read: Vec<_> =
                nodes.iter().filter(|node| !self.left_out.contains(&node.span)).collect();
            for (line, node) in list.into_iter().zip(read) {
                let number = ids.next().expect("every line was numbered");
                if !seen.insert(number) {
                    let error = MapError::DuplicateId { what: what.into(), id: number };
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
}

pub(super) fn type_entry(id: TypeId, file: TypeFile) -> TypeEntry {
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

impl From<Misprint> for Fault {
    fn from(misprint: Misprint) -> Self {
        let spans = misprint.span.map(|span| span.into()).into_iter().collect();
        Self { error: misprint.error, spots: Vec::new(), spans }
    }
}
