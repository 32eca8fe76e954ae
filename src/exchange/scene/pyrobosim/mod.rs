//! pyrobosim worlds (YAML, 4.x and before): rooms and hallways as polygons, locations and objects by category.
//!
//! Metres and radians, x to the right, y up, counter-clockwise. What a category looks like stands in metadata, in files
//! of their own or within the world file. A hallway runs between the middles of two rooms unless told otherwise; here
//! it becomes a room of its own, with an opening at either end; rooms that touch are joined by the opening alone.
//! Where the simulator would draw a place at random, the thing stands in a row with its like on its parent.

mod hallway;
mod record;

use std::collections::BTreeMap;

use serde_json::Value;

use crate::map::{Permeability, Properties};
use crate::outline::contains;
use crate::units::{Bilingual, Cm, Frame, Point, Source, said, word};
use crate::{
    Kind, Level, Opening, OpeningKind, Part, ReadError, Remark, Room, Spot, Survey, Thing,
};

use super::json::{length, list, remark, text};
use super::plane;
use super::shape::rectangle;
use super::stock::state;

use hallway::{Crossing, band, crossing, door, middle_line};
use record::{centroid, colour_of, footprint_outline, frame_at, pose};

const FORMAT: &str = "pyrobosim";
/// Heights where the file gives none, cm: of a table, and of what is taken in hand.
const LOCATION: f64 = 75.0;
const OBJECT: f64 = 10.0;
/// Width and depth of what stands for a shape told by a mesh, until its usual size is known, cm.
const MESH: f64 = 20.0;
/// A hallway with less floor than this between its rooms is but an opening, cm².
const LEAST_FLOOR: f64 = 1000.0;

/// Reads a world. `beside` gives the metadata file of a name; a category that no file describes is left out.
///
/// # Errors
/// [`ReadError::Syntax`]; [`ReadError::NoBuilding`] when no room has a footprint.
pub fn read_pyrobosim(
    source: &Source,
    beside: &mut dyn FnMut(&str) -> Option<Source>,
) -> Result<Survey, ReadError> {
    let world = yaml(source)?;
    let mut reader = Reader::default();
    reader.locations_known = reader.metadata(&world, "locations", beside)?;
    reader.objects_known = reader.metadata(&world, "objects", beside)?;
    let params = world.get("params");
    reader.height = params.and_then(|p| p.get("wall_height")).and_then(length);
    for (n, room) in list(&world, "rooms").iter().enumerate() {
        reader.room(n, room);
    }
    if reader.level.rooms.is_empty() {
        let what = word!("there-is-no-room-with-an").into();
        return Err(ReadError::NoBuilding { format: FORMAT, what });
    }
    for hallway in list(&world, "hallways") {
        reader.hallway(hallway);
    }
    for (n, location) in list(&world, "locations").iter().enumerate() {
        reader.location(n, location);
    }
    reader.objects(list(&world, "objects"));
    for robot in list(&world, "robots") {
        reader.robot(robot);
    }
    Ok(Survey {
        name: params.and_then(|p| text(p, "name")).unwrap_or_default().to_owned(),
        levels: vec![Level { source: "0".to_owned(), ..reader.level }],
        kinds: reader.kinds,
        remarks: reader.remarks,
        ..Survey::default()
    })
}

fn yaml(source: &Source) -> Result<Value, ReadError> {
    crate::yaml::parse(source, FORMAT, word!("of-a-world"))
}

/// What a location or an object of one category looks like.
#[derive(Debug, Clone)]
struct Look {
    outline: Vec<Point>,
    /// Its shape stands in a file of another sort: its size is the usual one of its word.
    is_mesh: bool,
    height: Option<f64>,
    properties: Properties,
}

type Looks = BTreeMap<String, Look>;

/// A place that others can stand on or in.
#[derive(Debug, Clone)]
struct Parent {
    frame: Frame,
    outline: Vec<Point>,
    room: Option<usize>,
}

#[derive(Default)]
struct Reader {
    locations_known: Looks,
    objects_known: Looks,
    height: Option<f64>,
    level: Level,
    kinds: Vec<Kind>,
    parents: BTreeMap<String, Parent>,
    remarks: Vec<Remark>,
}

impl Reader {
    fn note(&mut self, source: &str, text: impl Into<Bilingual>) {
        self.remarks.push(remark(source, text));
    }

    fn metadata(
        &mut self,
        world: &Value,
        field: &str,
        beside: &mut dyn FnMut(&str) -> Option<Source>,
    ) -> Result<Looks, ReadError> {
        let mut looks = Looks::new();
        let told = world.get("metadata").and_then(|m| m.get(field));
        let entries: Vec<&Value> = match told {
            Some(Value::Array(many)) => many.iter().collect(),
            Some(one) => vec![one],
            None => Vec::new(),
        };
        for entry in entries {
            match entry {
                Value::Object(_) => self.looks(entry, &mut looks),
                Value::String(path) => {
                    let name = path.rsplit(['/', '\\']).next().unwrap_or(path);
                    match beside(name) {
                        Some(file) => {
                            let value = yaml(&file)?;
                            self.looks(&value, &mut looks);
                        }
                        None => self.note(path, word!("the-file-with-the-kinds")),
                    }
                }
                _ => {}
            }
        }
        Ok(looks)
    }

    fn looks(&mut self, value: &Value, looks: &mut Looks) {
        for (category, record) in value.as_object().into_iter().flatten() {
            let Some(footprint) = record.get("footprint") else { continue };
            match footprint_outline(footprint) {
                Some(outline) => {
                    let look = Look {
                        outline,
                        is_mesh: false,
                        height: footprint.get("height").and_then(length).filter(|h| *h > 0.0),
                        properties: colour_of(record.get("color")),
                    };
                    looks.insert(category.clone(), look);
                }
                None => {
                    self.note(category, word!("the-outline-is-a-mesh"));
                    let (x, y) = (MESH / 2.0, MESH / 2.0);
                    let look = Look {
                        outline: rectangle(-x, -y, x, y),
                        is_mesh: true,
                        height: None,
                        properties: colour_of(record.get("color")),
                    };
                    looks.insert(category.clone(), look);
                }
            }
        }
    }

    fn room(&mut self, n: usize, record: &Value) {
        let name = text(record, "name").map_or_else(|| format!("room{n}"), str::to_owned);
        let outline = record.get("footprint").and_then(footprint_outline);
        let Some(outline) = outline.filter(|o| plane::area(o) > 1.0) else {
            self.note(&name, word!("the-room-is-left-out-it"));
            return;
        };
        let frame = record.get("pose").and_then(pose).unwrap_or_default();
        let height = record.get("height").and_then(length).or(self.height).filter(|h| *h > 0.0);
        let number = self.level.rooms.len();
        for (i, place) in list(record, "nav_poses").iter().filter_map(pose).enumerate() {
            let source = format!("{name}/nav{i}");
            let at = place.origin();
            self.level.spots.push(Spot {
                source,
                name: String::new(),
                kind: String::new(),
                at,
                heading: Some(place.angle),
                is_start: false,
            });
        }
        let outline: Vec<Point> = outline.into_iter().map(|p| frame.apply(p)).collect();
        // What is told relative to a room is told from its pose, or from its middle.
        let told = record.get("pose").is_some();
        let middle = if told { frame } else { frame_at(centroid(&outline), 0.0, 0.0) };
        let own = outline.iter().map(|&p| middle.invert(p)).collect();
        let whole = Parent { frame: middle, outline: own, room: Some(number) };
        self.parents.insert(name.clone(), whole);
        self.level.rooms.push(Room {
            source: name.clone(),
            kind: name.clone(),
            name,
            outline,
            height: height.map(Cm::of),
            properties: colour_of(record.get("color")),
            ..Room::default()
        });
    }

    fn hallway(&mut self, record: &Value) {
        let ends = ["room_start", "room_end"].map(|f| text(record, f).unwrap_or_default());
        let name = text(record, "name")
            .map_or_else(|| format!("hall_{}_{}", ends[0], ends[1]), str::to_owned);
        let rooms = ends.map(|e| self.level.rooms.iter().position(|r| r.source == e));
        let width = record.get("width").and_then(length).filter(|w| *w > 0.0);
        let ([Some(from), Some(to)], Some(width)) = (rooms, width) else {
            self.note(&name, word!("the-passage-is-left-out-its-rooms"));
            return;
        };
        let outlines = [from, to].map(|r| self.level.rooms[r].outline.clone());
        let way = middle_line(record, &outlines);
        let leave = |outline: &[Point], way: &[Point]| crossing(way, outline);
        let backwards: Vec<Point> = way.iter().rev().copied().collect();
        let (Some(out), Some(into)) = (leave(&outlines[0], &way), leave(&outlines[1], &backwards))
        else {
            self.note(&name, word!("the-passage-is-left-out-it"));
            return;
        };
        let floor = plane::difference(&band(&way, width), &outlines);
        let floor = floor.into_iter().next().filter(|f| plane::area(f) > LEAST_FLOOR);
        let is_door = record.get("is_open").is_some() || record.get("is_locked").is_some();
        let opening = |n: usize, at: &Crossing, rooms: [usize; 2], what: OpeningKind| Opening {
            source: format!("{name}/{n}"),
            name: String::new(),
            what,
            jambs: at.jambs(width),
            rooms: Some(rooms.map(Some)),
            height: None,
            sill: Cm::ZERO,
            properties: Properties::new(),
        };
        let door = if is_door { door(record) } else { OpeningKind::Passage };
        let found = match floor {
            None => vec![opening(0, &out, [from, to], door)],
            Some(outline) => {
                let hall = self.level.rooms.len();
                self.level.rooms.push(Room {
                    source: name.clone(),
                    kind: "hallway".to_owned(),
                    outline,
                    height: self.level.rooms[from].height,
                    properties: colour_of(record.get("color")),
                    ..Room::default()
                });
                vec![
                    opening(0, &out, [from, hall], door),
                    opening(1, &into, [to, hall], OpeningKind::Passage),
                ]
            }
        };
        self.level.openings.extend(found);
    }

    fn location(&mut self, n: usize, record: &Value) {
        let category =
            text(record, "category").or_else(|| text(record, "type")).unwrap_or_default();
        let name = text(record, "name").map_or_else(|| format!("{category}{n}"), str::to_owned);
        let parent = text(record, "parent").or_else(|| text(record, "room")).unwrap_or_default();
        let Some(look) = self.locations_known.get(category).cloned() else {
            self.note(&name, said!("the-place-is-left-out", category));
            return;
        };
        let room = self.parents.get(parent).and_then(|p| p.room);
        let placed = record.get("pose").and_then(|p| Some(self.relative(p).compose(&pose(p)?)));
        let Some(frame) = placed.or_else(|| {
            let room = &self.level.rooms[room?];
            Some(frame_at(centroid(&room.outline), 0.0, 0.0))
        }) else {
            self.note(&name, said!("the-place-is-left-out-neither", parent));
            return;
        };
        if record.get("pose").is_none() {
            self.note(&name, word!("its-pose-is-not-given"));
        }
        let height = look.height.unwrap_or(LOCATION);
        let top = Frame { z: Cm::of(frame.z.get() + height), ..frame };
        let on = Parent { frame: top, outline: look.outline.clone(), room };
        self.parents.insert(name.clone(), on);
        if record.get("is_charger").and_then(Value::as_bool) == Some(true) {
            let source = format!("{name}/charger");
            let spot = Spot {
                source,
                name: String::new(),
                kind: "charger".to_owned(),
                at: frame.origin(),
                heading: Some(frame.angle),
                is_start: false,
            };
            self.level.spots.push(spot);
        }
        let mut properties = Properties::new();
        let flag = |field: &str| record.get(field).and_then(Value::as_bool);
        state(flag("is_open"), None, &mut properties);
        // What is locked while it stands open cannot be shut.
        if flag("is_locked") == Some(true) && flag("is_open") == Some(false) {
            properties.insert("СОСТОЯНИЕ".to_owned(), "Заперто".to_owned());
        }
        self.thing(&name, category, &look, height, &frame, (room, Some(0)), properties);
    }

    fn objects(&mut self, records: &[Value]) {
        let parent_of =
            |record: &Value| match record.get("parent").or_else(|| record.get("location")) {
                Some(Value::String(name)) => name.clone(),
                Some(Value::Array(names)) => {
                    names.first().and_then(Value::as_str).unwrap_or_default().to_owned()
                }
                Some(other) => list(other, "choices")
                    .first()
                    .and_then(Value::as_str)
                    .unwrap_or_default()
                    .to_owned(),
                None => String::new(),
            };
        let mut waiting: BTreeMap<String, (usize, usize)> = BTreeMap::new();
        for record in records.iter().filter(|r| r.get("pose").is_none()) {
            waiting.entry(parent_of(record)).or_default().1 += 1;
        }
        let mut count: BTreeMap<&str, usize> = BTreeMap::new();
        for record in records {
            let category = text(record, "category").unwrap_or_default();
            let n = count.entry(category).or_default();
            let name = text(record, "name").map_or_else(|| format!("{category}{n}"), str::to_owned);
            *n += 1;
            let Some(look) = self.objects_known.get(category).cloned() else {
                self.note(&name, said!("the-thing-is-left-out-the-kind", category));
                continue;
            };
            let parent_name = parent_of(record);
            let parent = self.parent(&parent_name);
            let told = record.get("pose").and_then(|p| Some(self.relative(p).compose(&pose(p)?)));
            let frame = match (told, &parent) {
                // A pose on the plane is a pose on the parent's top.
                (Some(frame), Some(parent)) if frame.z.get() <= 0.0 => {
                    Frame { z: parent.frame.z, ..frame }
                }
                (Some(frame), _) => frame,
                (None, Some(parent)) => {
                    let (done, all) = waiting.entry(parent_name).or_default();
                    let frame = in_row(parent, *done, *all);
                    *done += 1;
                    self.note(&name, word!("its-pose-is-not-given-it"));
                    frame
                }
                (None, None) => {
                    let text = said!("the-thing-is-left-out-neither", parent_name);
                    self.note(&name, text);
                    continue;
                }
            };
            let height = look.height.unwrap_or(OBJECT);
            let room = parent.and_then(|p| p.room);
            self.thing(&name, category, &look, height, &frame, (room, None), Properties::new());
        }
    }

    /// A location, or one of its surfaces: `table0_tabletop` stands for `table0`.
    fn parent(&self, name: &str) -> Option<Parent> {
        let whole = self.parents.get(name);
        let begun = || {
            let known = self.parents.iter().rev();
            known.filter(|(n, _)| name.starts_with(&format!("{n}_"))).map(|(_, p)| p).next()
        };
        whole.or_else(begun).cloned()
    }

    /// The frame that a pose is relative to.
    fn relative(&self, pose: &Value) -> Frame {
        let to = text(pose, "relative_to").and_then(|name| self.parents.get(name));
        to.map(|p| Frame { z: Cm::ZERO, ..p.frame }).unwrap_or_default()
    }

    #[expect(clippy::too_many_arguments, reason = "each is one field of the record")]
    fn thing(
        &mut self,
        name: &str,
        category: &str,
        look: &Look,
        height: f64,
        frame: &Frame,
        (room, move_prob): (Option<usize>, Option<u8>),
        properties: Properties,
    ) {
        let known = self.kinds.iter().position(|k| k.source == category);
        let kind = known.unwrap_or_else(|| {
            let part = Part {
                word: String::new(),
                outline: look.outline.clone(),
                bottom: Cm::ZERO,
                height: Cm::of(height),
                permeability: Permeability::Impermeable,
            };
            self.kinds.push(Kind {
                source: category.to_owned(),
                word: category.to_owned(),
                parts: if look.is_mesh { Vec::new() } else { vec![part] },
                front: None,
                properties: look.properties.clone(),
            });
            self.kinds.len() - 1
        });
        self.level.things.push(Thing {
            source: name.to_owned(),
            name: name.to_owned(),
            kind,
            at: frame.origin(),
            z: frame.z,
            angle: frame.angle,
            room,
            move_prob,
            properties,
        });
    }

    fn robot(&mut self, record: &Value) {
        let name = text(record, "name").unwrap_or("robot").to_owned();
        let room = match record.get("location") {
            Some(Value::String(room)) => self.parents.get(room),
            _ => None,
        };
        let told = record.get("pose").and_then(pose);
        // One whose pose is drawn at random begins where the room has robots stand: its middle may be taken by a table.
        let somewhere = |room: &Parent| {
            let mut spots = self.level.spots.iter();
            let spot = spots.find(|spot| contains(&room.outline, spot.at));
            frame_at(spot.map_or_else(|| centroid(&room.outline), |spot| spot.at), 0.0, 0.0)
        };
        let frame = told.or_else(|| room.map(somewhere));
        if let Some(frame) = frame {
            let spot = Spot {
                source: name.clone(),
                name,
                kind: String::new(),
                at: frame.origin(),
                heading: Some(frame.angle),
                is_start: true,
            };
            self.level.spots.push(spot);
        }
    }
}

/// The `done`-th of `all` things along the longer side of what they stand on.
fn in_row(parent: &Parent, done: usize, all: usize) -> Frame {
    let (low, high) = parent.outline.iter().fold(
        (Point::new(f64::MAX, f64::MAX), Point::new(f64::MIN, f64::MIN)),
        |(l, h), p| {
            (Point::new(l.x.min(p.x), l.y.min(p.y)), Point::new(h.x.max(p.x), h.y.max(p.y)))
        },
    );
    let share = (done as f64 + 0.5) / all.max(1) as f64;
    let span = high - low;
    let mut at = low + span / 2.0;
    if span.x >= span.y {
        at.x = low.x + span.x * share;
    } else {
        at.y = low.y + span.y * share;
    }
    Frame { z: parent.frame.z, ..parent.frame.compose(&frame_at(at, 0.0, 0.0)) }
}
