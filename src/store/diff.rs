//! What changed between two revisions, as data and in words.

use std::collections::BTreeMap;
use std::fmt;

use crate::map::World;
use crate::units::{
    AreaId, Bilingual, DoorId, Language, Lengths, MapId, ObjectId, OrFrId, Piece, PlaceId,
    ReplicaId, TypeId, ZoneId, said, told, word,
};

use super::cell::{Cell, Key, Row};
use super::changes::Changes;
use super::error::Result;
use super::keep::Store;
use super::reader::Reader;
use super::tables::{self as t, Record, Table};

/// What became of a record.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Fate {
    Created,
    Changed,
    Deleted,
}

/// One column of a record before and after.
#[derive(Debug, Clone, PartialEq)]
pub struct FieldChange {
    pub column: &'static str,
    pub old: Cell,
    pub new: Cell,
}

/// One record that two revisions do not share. Its `Display` is what it [says](Self::say) in Russian.
#[derive(Debug, Clone, PartialEq)]
pub struct Difference {
    pub table: Table,
    pub fate: Fate,
    /// What the record speaks of: «стул «Стул-1»».
    pub subject: Bilingual,
    /// The columns that differ; all of them for what was created or deleted.
    pub fields: Vec<FieldChange>,
    /// The same in words, where there are better ones than the columns' names.
    words: Option<Bilingual>,
}

impl Difference {
    /// The difference in a sentence.
    #[must_use]
    pub fn say(&self, language: Language) -> String {
        let subject = self.subject.say(language);
        let told = match (&self.words, self.fate) {
            (Some(words), _) => words.say(language).to_owned(),
            (None, Fate::Created) => told!(language, "record-added"),
            (None, Fate::Deleted) => told!(language, "record-removed"),
            (None, Fate::Changed) => {
                let change = |field: &FieldChange| {
                    let word = word(field.column);
                    let [old, new] =
                        [&field.old, &field.new].map(|cell| told(field.column, cell, language));
                    format!("{} {old} → {new}", word.say(language))
                };
                self.fields.iter().map(change).collect::<Vec<_>>().join(", ")
            }
        };
        format!("{subject}: {told}")
    }
}

impl fmt::Display for Difference {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.say(Language::Russian))
    }
}

/// Columns of numbers that are no lengths: angles, shares, speeds, what a zone asks.
const NO_LENGTHS: [&str; 14] = [
    "Ang",
    "PosA",
    "RelA",
    "OffAng",
    "TurnRate",
    "MaxOpen",
    "RoofScale",
    "SidePart",
    "Opening",
    "Sure",
    "Confidence",
    "Explained",
    "Speed",
    "Measure",
];

/// What stands in a column, its lengths as they are told.
fn told(column: &str, cell: &Cell, language: Language) -> String {
    let length = |cm: f64| Lengths::said().short(cm, 2);
    match cell {
        Cell::Real(cm) if !NO_LENGTHS.contains(&column) => length(*cm),
        Cell::Text(corners) if column == "Points" => {
            let number = |text: &str| text.parse().map_or_else(|_| text.to_owned(), length);
            let corner = |text: &str| text.split(',').map(number).collect::<Vec<_>>().join(",");
            let corners: Vec<String> = corners.split_whitespace().map(corner).collect();
            Cell::Text(corners.join(" ")).say(language)
        }
        other => other.say(language),
    }
}

/// How people call a column.
fn word(column: &'static str) -> Bilingual {
    let phrase = match column {
        "Name" => word!("name"),
        "NameEn" => word!("english-name"),
        "X" => word!("column-x"),
        "Y" => word!("column-y"),
        "Desc" => word!("description"),
        "PosX" => word!("shift-x"),
        "PosY" => word!("shift-y"),
        "PosZ" => word!("shift-z"),
        "PosA" => word!("turn"),
        "Ang" => word!("heading"),
        "Kind" => word!("kind"),
        "Measure" => word!("speed-or-direction"),
        "Points" => word!("corners"),
        "Reason" => word!("reason"),
        "ReasonEn" => word!("english-reason"),
        "StartsAt" => word!("beginning"),
        "EndsAt" => word!("end"),
        "Width" => word!("width"),
        "Height" | "Hieght" | "Roof" => word!("height"),
        "SizeX" => word!("size-x"),
        "SizeY" => word!("size-y"),
        "SidePntr" | "BasePntr" | "RoofPntr" => word!("permeability"),
        other => return other.into(),
    };
    phrase.into()
}

/// How people call a record of a table, and the column by which its owner is found: none for what has a name
/// of its own.
fn noun(table: Table) -> (Bilingual, Option<Table>) {
    use Table as T;
    let (noun, owner) = match table {
        T::OrFr => (word!("orthoframe"), None),
        T::Object => (word!("object"), None),
        T::Area => (word!("room"), None),
        T::AreaObjects => (word!("replica"), None),
        T::Map => (word!("map"), None),
        T::Domain => (word!("domain"), None),
        T::Door => (word!("door"), None),
        T::Places => (word!("place"), None),
        T::Zones => (word!("zone"), None),
        T::ZoneAreas => (word!("room-of-the-zone"), Some(T::Zones)),
        T::OrtFrmSides | T::SideNames => (word!("side-of-the-orthoframe"), Some(T::OrFr)),
        T::OrtFrmProperties => (word!("property-of-the-orthoframe"), Some(T::OrFr)),
        T::OrtFrmSideProperties => (word!("property-of-a-side-of-the-orthoframe"), Some(T::OrFr)),
        T::ObjectItems => (word!("part-of-the-object"), Some(T::Object)),
        T::ObjectItemLinks => (word!("link-of-parts-of-the-object"), Some(T::Object)),
        T::ObjectDoors => (word!("door-of-the-object"), Some(T::Object)),
        T::ObjectProperties => (word!("property-of-the-object"), Some(T::Object)),
        T::AreaItems => (word!("part-of-the-room"), Some(T::Area)),
        T::AreaItemLinks => (word!("link-of-parts-of-the-room"), Some(T::Area)),
        T::AreaDoors => (word!("door-of-the-room"), Some(T::Area)),
        T::AreaProperties => (word!("property-of-the-room"), Some(T::Area)),
        T::ReplicaProperties => (word!("property-of-the-replica"), Some(T::AreaObjects)),
        T::ReplicaDoors => (word!("door-of-the-replica"), Some(T::AreaObjects)),
        T::DoorSides => (word!("side-of-the-door"), Some(T::Door)),
        T::DoorProperties => (word!("property-of-the-door"), Some(T::Door)),
        T::MapItems => (word!("room-of-the-map"), Some(T::Map)),
        T::MapItemLinks => (word!("link-of-rooms-of-the-map"), Some(T::Map)),
        T::DomainMaps => (word!("map-of-the-domain"), Some(T::Domain)),
        T::Lifts | T::LiftStops => (word!("lift-of-the-domain"), Some(T::Domain)),
        T::Robot => (word!("robot-of-the-domain"), Some(T::Domain)),
        T::OrtFrmTypeList => (word!("type-of-orthoframes"), None),
        T::OrtFrmShapeList => (word!("shape-of-orthoframes"), None),
        T::OrtFrmSideTypeList => (word!("type-of-sides"), None),
        T::ObjectTypeList => (word!("type-of-objects"), None),
        T::AreaTypeList => (word!("type-of-rooms"), None),
        T::MapTypeList => (word!("type-of-maps"), None),
        T::DoorTypeList => (word!("type-of-doors"), None),
        T::TypeWords => (word!("word-of-the-type"), None),
        T::NameForms => (word!("form-of-the-name"), None),
        other => return (other.name().into(), None),
    };
    (noun.into(), owner)
}

/// Names of what bears an id, at two revisions: a thing that is gone still has its old name.
enum Names<'a> {
    Read(BTreeMap<(Table, u32), String>),
    /// Looked up where they stand: before and after.
    Of([&'a World; 2]),
}

impl Names<'_> {
    fn of(from: &Reader, to: &Reader) -> Result<Self> {
        let mut names = BTreeMap::new();
        for reader in [from, to] {
            for table in super::ids::tables() {
                for (_, version) in reader.versions(table, &Key::new())? {
                    if let Some((id, name)) = display_name(table, &version.row) {
                        names.insert((table, id), name);
                    }
                }
            }
        }
        Ok(Self::Read(names))
    }

    fn get(&self, table: Table, id: u32) -> Bilingual {
        let name = match self {
            Self::Read(names) => names.get(&(table, id)).map(String::as_str),
            Self::Of([before, after]) => {
                name_in(after, table, id).or_else(|| name_in(before, table, id))
            }
        };
        match name {
            Some(name) => Bilingual::quoted(name),
            None => Bilingual::new(format!("№ {id}"), format!("no. {id}")),
        }
    }
}

/// The display name of a world's record: as [`display_name`] of its row.
fn name_in(world: &World, table: Table, id: u32) -> Option<&str> {
    macro_rules! keyed {
        ($things:expr, $id:ident) => {
            $things.get(&$id(id)).map(|thing| [thing.name.as_str(), thing.key.as_str()])
        };
    }
    macro_rules! named {
        ($things:expr, $id:ident) => {
            $things.get(&$id(id)).map(|thing| [thing.name.as_str(), ""])
        };
    }
    let types = &world.types;
    let names = match table {
        Table::OrFr => keyed!(world.orthoframes, OrFrId),
        Table::Object => keyed!(world.objects, ObjectId),
        Table::Area => keyed!(world.areas, AreaId),
        Table::Map => keyed!(world.maps, MapId),
        Table::Door => keyed!(world.doors, DoorId),
        Table::AreaObjects => named!(world.replicas, ReplicaId),
        Table::Places => named!(world.places, PlaceId),
        Table::Zones => named!(world.zones, ZoneId),
        Table::Domain => {
            let domain = &world.domain;
            (domain.id.0 == id).then_some([domain.name.as_str(), domain.key.as_str()])
        }
        Table::OrtFrmTypeList => named!(types.orthoframe.entries, TypeId),
        Table::OrtFrmShapeList => named!(types.shape.entries, TypeId),
        Table::OrtFrmSideTypeList => named!(types.side.entries, TypeId),
        Table::ObjectTypeList => named!(types.object.entries, TypeId),
        Table::AreaTypeList => named!(types.area.entries, TypeId),
        Table::MapTypeList => named!(types.map.entries, TypeId),
        Table::DoorTypeList => named!(types.door.entries, TypeId),
        _ => None,
    }?;
    names.into_iter().find(|name| !name.is_empty())
}

fn display_name(table: Table, row: &Row) -> Option<(u32, String)> {
    let (id, _) = super::ids::identity(table, row)?;
    let text = |name: &str| {
        let at = table.columns().iter().position(|c| c.name == name)?;
        match row.get(at)? {
            Cell::Text(text) if !text.is_empty() => Some(text.clone()),
            _ => None,
        }
    };
    Some((id, text("Name").or_else(|| text("Key"))?))
}

impl Store {
    /// What differs between two revisions, in the order of tables and keys.
    ///
    /// A replica that went to another Area counts as changed, though its record has another key.
    ///
    /// # Errors
    /// [`UnknownRevision`](super::StoreError::UnknownRevision), [`BadRecord`](super::StoreError::BadRecord).
    pub fn diff(&self, from: u64, to: u64) -> Result<Vec<Difference>> {
        let (old, new) = (self.reader_at(from)?, self.reader_at(to)?);
        let names = Names::of(&old, &new)?;
        let mut keys = std::collections::BTreeSet::new();
        for revision in from.min(to) + 1..=from.max(to) {
            keys.extend(self.reader().touched(revision)?);
        }
        let mut pairs = Pairs::default();
        for (table, key) in keys {
            let live = |reader: &Reader| -> Result<Option<Row>> {
                Ok(reader.version(table, &key)?.filter(|v| !v.stamp.deleted).map(|v| v.row))
            };
            pairs.add(table, &key, [live(&old)?, live(&new)?]);
        }
        Ok(pairs.differences(&names))
    }
}

impl Changes<'_> {
    /// In the words of a person.
    #[must_use]
    pub fn told(&self) -> Vec<Difference> {
        let mut pairs = Pairs::default();
        for ((table, key), rows) in &self.rows {
            pairs.add(*table, key, rows.clone());
        }
        pairs.differences(&Names::Of(self.worlds()))
    }
}

/// Rows before and after, by what they speak of.
#[derive(Default)]
struct Pairs(BTreeMap<(Table, Key), [Option<Row>; 2]>);

impl Pairs {
    fn add(&mut self, table: Table, key: &Key, rows: [Option<Row>; 2]) {
        let [was, is] = self.0.entry((table, same_thing(table, key, &rows))).or_default();
        let [before, after] = rows;
        *was = was.take().or(before);
        *is = is.take().or(after);
    }

    fn differences(self, names: &Names<'_>) -> Vec<Difference> {
        let differing = self.0.into_iter().filter(|(_, [was, is])| was != is);
        differing.map(|((table, _), rows)| difference(table, &rows, names)).collect()
    }
}

/// A replica is one thing wherever it stands; all else is known by its key.
fn same_thing(table: Table, key: &Key, rows: &[Option<Row>; 2]) -> Key {
    let row = rows.iter().flatten().next();
    match row.and_then(|row| super::ids::id_of(table, row)) {
        Some(id) => Key::new().id(id),
        None => key.clone(),
    }
}

fn difference(table: Table, rows: &[Option<Row>; 2], names: &Names<'_>) -> Difference {
    let [was, is] = rows;
    let fate = match (was, is) {
        (None, _) => Fate::Created,
        (_, None) => Fate::Deleted,
        _ => Fate::Changed,
    };
    let row = is.as_ref().or(was.as_ref()).expect("a difference has a row");
    let cell = |row: &Option<Row>, n: usize| {
        row.as_ref().and_then(|r| r.get(n)).cloned().unwrap_or(Cell::Null)
    };
    let fields = table
        .columns()
        .iter()
        .enumerate()
        .map(|(n, c)| FieldChange { column: c.name, old: cell(was, n), new: cell(is, n) })
        .filter(|field| field.old != field.new)
        .collect();
    Difference {
        table,
        fate,
        subject: subject(table, row, names),
        words: words(table, was.as_ref(), is.as_ref(), names),
        fields,
    }
}

fn subject(table: Table, row: &Row, names: &Names<'_>) -> Bilingual {
    let (noun, owner) = noun(table);
    let id = |cell: Option<&Cell>| match cell {
        Some(Cell::Int(id)) => u32::try_from(*id).unwrap_or(0),
        _ => 0,
    };
    if let Some(owner) = owner {
        let keys = table.columns().iter().zip(row).skip(1).filter(|(c, _)| c.is_key);
        let rest: Vec<&Cell> = keys.map(|(_, cell)| cell).collect();
        let owner = names.get(owner, id(row.first()));
        return Bilingual::both(|language| {
            let (noun, owner) = (noun.say(language), owner.say(language));
            let rest: Vec<String> = rest.iter().map(|cell| cell.say(language)).collect();
            format!("{noun} {owner} {}", rest.join(" ")).trim_end().to_owned()
        });
    }
    let named = match super::ids::identity(table, row) {
        Some((id, _)) => names.get(table, id),
        None => super::sheet::describe_key(table, row).into(),
    };
    Bilingual::both(|language| format!("{} {}", noun.say(language), named.say(language)))
}

/// Movements and door states have words of their own.
fn words(
    table: Table,
    was: Option<&Row>,
    is: Option<&Row>,
    names: &Names<'_>,
) -> Option<Bilingual> {
    match table {
        Table::AreaObjects => {
            let old = was.and_then(|row| t::AreaObjects::from_row(row));
            let new = is.and_then(|row| t::AreaObjects::from_row(row));
            replica_words(old.as_ref(), new.as_ref(), names)
        }
        Table::Door => {
            let (old, new) = (t::Door::from_row(was?)?, t::Door::from_row(is?)?);
            let only_state =
                t::Door { status: new.status.clone(), opening: new.opening, ..old.clone() };
            (only_state == new).then(|| change(&door_words(&old), &door_words(&new)))
        }
        Table::ReplicaDoors => {
            let state = |row: &Row| t::ReplicaDoors::from_row(row);
            let (old, new) = (state(was?)?, state(is?)?);
            let door = |r: &t::ReplicaDoors| t::Door {
                status: r.status.clone(),
                opening: r.opening,
                ..t::Door::default()
            };
            Some(change(&door_words(&door(&old)), &door_words(&door(&new))))
        }
        Table::ObjectProperties
        | Table::AreaProperties
        | Table::DoorProperties
        | Table::ReplicaProperties
        | Table::OrtFrmProperties
        | Table::OrtFrmSideProperties => match (was.and_then(|r| r.last()), is?.last()?) {
            (None, new) => Some(Bilingual::both(|language| new.say(language))),
            (Some(old), new) => Some(Bilingual::both(|language| {
                format!("{} → {}", old.say(language), new.say(language))
            })),
        },
        _ => None,
    }
}

fn door_words(door: &t::Door) -> Bilingual {
    match door.status.as_str() {
        "open" if door.opening < 100.0 => said!("open-by", opening = door.opening),
        "open" => said!("open"),
        "closed" => said!("closed"),
        "locked" => said!("locked"),
        other => other.to_owned().into(),
    }
}

fn change(old: &Bilingual, new: &Bilingual) -> Bilingual {
    Bilingual::both(|language| format!("{} → {}", old.say(language), new.say(language)))
}

fn replica_words(
    old: Option<&t::AreaObjects>,
    new: Option<&t::AreaObjects>,
    names: &Names<'_>,
) -> Option<Bilingual> {
    let area = |r: &t::AreaObjects| names.get(Table::Area, r.area_id);
    let of_area = |words: Piece, area: &Bilingual| said!("done-of-a-room", words, area);
    let (old, new) = match (old, new) {
        (Some(old), Some(new)) => (old, new),
        (None, Some(new)) => return Some(of_area(word!("added"), &area(new))),
        (Some(old), None) => return Some(of_area(word!("removed"), &area(old))),
        (None, None) => return None,
    };
    let from_to = |what: Piece, old: &Bilingual, new: &Bilingual| {
        Bilingual::both(|language| {
            format!("{} {} → {}", what.say(language), old.say(language), new.say(language))
        })
    };
    let mut said = Vec::new();
    if old.area_id != new.area_id {
        said.push(from_to(word!("room"), &area(old), &area(new)));
    } else {
        let moved = (new.x - old.x).hypot(new.y - old.y).hypot(new.z - old.z);
        if moved > 0.0 {
            said.push(said!("moved-by", moved));
        }
    }
    let turn = (new.ang - old.ang).rem_euclid(360.0);
    let turn = if turn > 180.0 { turn - 360.0 } else { turn };
    if turn.abs() > 0.0 {
        let way = if turn > 0.0 { word!("counter-clockwise") } else { word!("clockwise") };
        said.push(said!("turned-by", by = hundredths(turn.abs()), way));
    }
    if old.object_id != new.object_id {
        let object = |r: &t::AreaObjects| names.get(Table::Object, r.object_id);
        said.push(from_to(word!("object"), &object(old), &object(new)));
    }
    if old.move_prob != new.move_prob {
        let [old, new] = [old, new].map(|r| r.move_prob.to_string().into());
        said.push(from_to(word!("mobility"), &old, &new));
    }
    if (&old.name, &old.name_en) != (&new.name, &new.name_en) {
        let [old, new] = [old, new].map(|r| Bilingual::quoted(&r.name));
        said.push(from_to(word!("name"), &old, &new));
    }
    Some(Bilingual::list(&said))
}

fn hundredths(value: f64) -> f64 {
    (value * 100.0).round() / 100.0
}
