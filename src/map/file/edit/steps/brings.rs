//! What an edit brings: records of a section, lines of an Area, types, each under an id never given before.

use super::super::edits::Told;
use super::super::verbs::{Edit, NewRecord};
use super::{Done, Draft, Kind, MapError, Record, Span, Steps, misprint};
use crate::file::decode::shortened;
use crate::file::node::Node;
use crate::file::read::Raw;
use crate::file::read::type_entry;
use crate::file::schema::{
    AreaFile, DoorFile, ObjectFile, OrthoframeFile, PlaceFile, PlanFile, ReplicaFile, TypeFile,
};
use crate::units::{
    AreaId, DoorId, Frame, MapId, ObjectId, OrFrId, PlaceId, ReplicaId, TypeId, ZoneId, said,
};
use crate::{DomainMap, TypeKind};

/// What was brought and has its ids, before its references are followed.
#[derive(Default)]
struct Brought {
    orthoframes: Vec<Raw<OrFrId, OrthoframeFile>>,
    doors: Vec<Raw<DoorId, DoorFile>>,
    objects: Vec<Raw<ObjectId, ObjectFile>>,
    areas: Vec<Raw<AreaId, AreaFile>>,
    replicas: Vec<(AreaId, ReplicaId, ReplicaFile)>,
    places: Vec<(AreaId, PlaceId, PlaceFile)>,
    maps: Vec<Raw<MapId, PlanFile>>,
}

impl Steps<'_> {
    pub(super) fn fresh_id(&mut self, kind: Kind) -> u32 {
        let next = self.ids.of(kind);
        let id = *next;
        *next = next.saturating_add(1);
        id
    }

    /// Takes in all that is new: names may lead from any of it to any other.
    pub(super) fn bring(&mut self, all: &[Told]) {
        let mut brought = Brought::default();
        for told in all {
            let done = match &told.edit {
                Edit::New(new) => self.number(new, told, &mut brought),
                Edit::Robot(said) => {
                    self.late.robot.push(said.clone());
                    self.said.new_record(Record::Robot, &told.key_span, told.node.clone());
                    Ok(())
                }
                _ => Ok(()),
            };
            self.misprints.extend(done.err().map(|fault| *fault));
        }
        self.follow_references(brought);
    }

    /// Gives a record its id and makes its names known.
    fn number(&mut self, new: &NewRecord, told: &Told, brought: &mut Brought) -> Done {
        macro_rules! keyed {
            ($kind:ident, $id:ident, $key:expr, $file:expr) => {{
                let names = [&$file.name, &$file.name_en];
                let id = self.announce(Kind::$kind, told, $key, names, $file.id)?;
                Raw { id: $id(id), key: $key.clone(), file: $file.clone() }
            }};
        }
        match new {
            NewRecord::Type(kind, file) => self.new_type(*kind, file, told)?,
            NewRecord::Orthoframe(key, file) => {
                brought.orthoframes.push(keyed!(Orthoframe, OrFrId, key, file));
            }
            NewRecord::Door(key, file) => brought.doors.push(keyed!(Door, DoorId, key, file)),
            NewRecord::Object(key, file) => {
                brought.objects.push(keyed!(Object, ObjectId, key, file));
            }
            NewRecord::Area(key, file) => {
                let mut area = keyed!(Area, AreaId, key, file);
                self.number_lines(&mut area, told, brought);
                brought.areas.push(area);
            }
            NewRecord::Map(key, file) => brought.maps.push(keyed!(Map, MapId, key, file)),
            NewRecord::Zone(key, file) => {
                let Raw { id, key, file } = keyed!(Zone, ZoneId, key, file);
                self.coming.remove(&Record::Zone(id));
                self.zones.insert(id, Draft { key, file });
            }
        }
        Ok(())
    }

    /// A record under a key that none of its kind has.
    fn announce(
        &mut self,
        kind: Kind,
        told: &Told,
        key: &String,
        names: [&String; 2],
        given: Option<u32>,
    ) -> super::Outcome<u32> {
        if self.keyed(key, kind).is_some() {
            let (what, name) = (kind.title().into(), key.clone());
            return Err(misprint(MapError::AlreadyThere { what, name }, &told.key_span));
        }
        let record = self.number_record(kind, given, &told.key_span)?;
        let of = record_of(kind, record);
        self.said.new_record(of, &told.key_span, told.node.clone());
        self.coming.insert(of, key.clone());
        self.coming_keys.insert((kind, key.clone()), of);
        [key].into_iter().chain(names).for_each(|name| self.note(name, of));
        if told.is_broken {
            self.broken.insert(of);
        }
        Ok(record)
    }

    /// The id that a record gives itself, if no other has it, or else the next one.
    fn number_record(&mut self, kind: Kind, given: Option<u32>, at: &Span) -> super::Outcome<u32> {
        let Some(id) = given else { return Ok(self.fresh_id(kind)) };
        let record = record_of(kind, id);
        let is_coming = self.coming.contains_key(&record);
        if is_coming || super::super::kind::names_of(&self.world, record).is_some() {
            let what = kind.title().into();
            return Err(misprint(MapError::DuplicateId { what, id }, at));
        }
        let next = self.ids.of(kind);
        *next = (*next).max(id.saturating_add(1));
        Ok(id)
    }

    /// Takes replicas and places out of an Area that is brought.
    fn number_lines(
        &mut self,
        area: &mut Raw<AreaId, AreaFile>,
        told: &Told,
        brought: &mut Brought,
    ) {
        macro_rules! lines {
            ($field:literal, $list:ident, $kind:ident, $id:ident) => {{
                // Lines that could not be read have no place in the list.
                let nodes = told.node.entry($field).map_or(&[][..], |e| e.node.elements());
                let is_read = |node: &&Node| !self.left_out.contains(&node.span);
                let nodes: Vec<Node> = nodes.iter().filter(is_read).cloned().collect();
                for (line, node) in std::mem::take(&mut area.file.$list).into_iter().zip(nodes) {
                    match self.number_record(Kind::$kind, line.id, &node.span) {
                        Ok(id) => {
                            let record = Record::$kind($id(id));
                            let span = node.span.clone();
                            self.said.new_record(record, &span, node);
                            self.coming.insert(record, line.name.clone());
                            [&line.name, &line.name_en]
                                .into_iter()
                                .for_each(|n| self.note(n, record));
                            brought.$list.push((area.id, $id(id), line));
                        }
                        Err(fault) => self.misprints.push(*fault),
                    }
                }
            }};
        }
        lines!("replicas", replicas, Replica, ReplicaId);
        lines!("places", places, Place, PlaceId);
    }

    fn new_type(&mut self, kind: TypeKind, file: &TypeFile, told: &Told) -> Done {
        if self.world.types.list(kind).named(&file.name).is_some() {
            let (what, name) = (said!("type-title"), shortened(&file.name));
            return Err(misprint(MapError::AlreadyThere { what, name }, &told.key_span));
        }
        let next = self.ids.types.entry(kind).or_insert(1);
        let id = TypeId(*next);
        *next = next.saturating_add(1);
        self.said.new_record(Record::Type(kind, id), &told.key_span, told.node.clone());
        let entries = &mut self.world.types.list_mut(kind).entries;
        entries.insert(id, type_entry(id, file.clone()));
        Ok(())
    }

    /// Takes what was brought into the world, each kind after those to which it refers.
    fn follow_references(&mut self, brought: Brought) {
        macro_rules! take {
            ($records:ident, $record:ident, $read:ident) => {
                for raw in brought.$records {
                    let id = raw.id;
                    let read = self.reading(|reader| reader.$read(raw));
                    self.world.$records.insert(id, read);
                    self.coming.remove(&Record::$record(id));
                }
            };
        }
        take!(orthoframes, Orthoframe, orthoframe);
        take!(doors, Door, door);
        take!(objects, Object, object);
        take!(areas, Area, area);
        for line in brought.replicas {
            self.coming.remove(&Record::Replica(line.1));
            let read = self.reading(|reader| reader.replica(line));
            self.world.replicas.extend(read);
        }
        for (area, id, mut line) in brought.places {
            // What is served may be put there by a step.
            self.late.serves.extend(line.serves.take().map(|served| (id, served)));
            let read = self.reading(|reader| reader.place((area, id, line)));
            self.world.places.extend([read]);
            self.coming.remove(&Record::Place(id));
        }
        for raw in brought.maps {
            let (id, areas) = (raw.id, self.world.areas.clone());
            let read = self.reading(|reader| reader.plan(raw, &areas));
            self.spell_out_domain();
            self.world.maps.insert(id, read);
            self.coming.remove(&Record::Map(id));
        }
    }

    /// A building of one Map need not say where it stands; one of several must.
    pub(super) fn spell_out_domain(&mut self) {
        let mut maps = self.world.maps.keys();
        if let (Some(&map), None, true) =
            (maps.next(), maps.next(), self.world.domain.maps.is_empty())
        {
            self.world.domain.maps.push(DomainMap { map, frame: Frame::IDENTITY, is_base: true });
        }
    }
}

fn record_of(kind: Kind, id: u32) -> Record {
    match kind {
        Kind::Replica => Record::Replica(ReplicaId(id)),
        Kind::Area => Record::Area(AreaId(id)),
        Kind::Door => Record::Door(DoorId(id)),
        Kind::Place => Record::Place(PlaceId(id)),
        Kind::Map => Record::Map(MapId(id)),
        Kind::Zone => Record::Zone(ZoneId(id)),
        Kind::Object => Record::Object(ObjectId(id)),
        Kind::Orthoframe => Record::Orthoframe(OrFrId(id)),
    }
}
