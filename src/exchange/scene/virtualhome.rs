//! VirtualHome environment graphs: nodes with boxes along the axes, states and properties; edges with relations.
//!
//! The frame is Unity's, as in ProcTHOR. A node's box is all that the file tells of its build, so a box in which others
//! stand is taken for what surrounds a body of unknown build. The box of a room reaches over what hangs outside of
//! it, a shutter or a lamp; its floor is made of its tiles, which the INSIDE edges give to it; a room without tiles keeps
//! its box. What the edges say of things is not read: relations are derived from the geometry.

use std::collections::BTreeMap;

use serde_json::Value;

use crate::map::{DoorKind, DoorLeaf, DoorStatus, HingeSide, Properties};
use crate::units::{Cm, Gather as _, Point, Source, said, word};
use crate::{Level, Opening, OpeningKind, ReadError, Remark, Room, Spot, Survey};

use super::colour;
use super::json::{length, list, parse, remark, text};
use super::plane;
use super::procthor::contains;
use super::shape::rectangle;
use super::stock::{Facing, Piece, Shelf, shelve, state};

const FORMAT: &str = "VirtualHome";
/// A door leaf and its frame stand in the same place, nearer than this, cm.
const SAME_PLACE: f64 = 30.0;
/// A box that reaches deeper than this below the floor is cut off there, cm: more than a box is off by.
const SUNK: f64 = 5.0;
/// So far from a door one stands in the room behind it, cm.
const STEP: f64 = 40.0;
/// Thickness of a leaf, cm; the file does not tell it.
const LEAF: f64 = 4.0;

/// What the simulator lets an avatar do with a thing, as a property.
const ABILITIES: [(&str, &str); 12] = [
    ("GRABBABLE", "МОЖНО ВЗЯТЬ"),
    ("MOVABLE", "МОЖНО ПОДВИНУТЬ"),
    ("CAN_OPEN", "ОТКРЫВАЕТСЯ"),
    ("CONTAINERS", "ВМЕЩАЕТ"),
    ("SURFACES", "ПОВЕРХНОСТЬ"),
    ("SITTABLE", "МОЖНО СЕСТЬ"),
    ("LIEABLE", "МОЖНО ЛЕЧЬ"),
    ("HAS_SWITCH", "ЕСТЬ ВЫКЛЮЧАТЕЛЬ"),
    ("HAS_PLUG", "ЕСТЬ ВИЛКА"),
    ("READABLE", "МОЖНО ЧИТАТЬ"),
    ("EATABLE", "СЪЕДОБНО"),
    ("DRINKABLE", "МОЖНО ПИТЬ"),
];

/// Reads an environment graph.
///
/// # Errors
/// [`ReadError::Syntax`]; [`ReadError::NoBuilding`] when no room has a box.
pub fn read_virtualhome(source: &Source) -> Result<Survey, ReadError> {
    let graph = parse(FORMAT, source)?;
    let mut remarks = Vec::new();
    let nodes: Vec<Node> =
        list(&graph, "nodes").iter().filter_map(|n| Node::of(n, &mut remarks)).collect();
    let rooms = rooms(&nodes, &floors(&graph, &nodes));
    if rooms.is_empty() {
        let what = word!("there-is-no-room-with").into();
        return Err(ReadError::NoBuilding { format: FORMAT, what });
    }
    let mut openings = doors(&nodes, &rooms, &mut remarks);
    openings.extend(nodes.iter().filter(|n| n.category == "Windows").map(window));
    let mut pieces: Vec<Piece> = Vec::new();
    let (mut spots, mut notes) = (Vec::new(), Vec::new());
    for node in &nodes {
        match node.category {
            "Characters" => {
                let text = word!("the-character-is-not-taken");
                notes.push(remark(&node.id, text));
                spots.push(Spot {
                    source: node.id.clone(),
                    name: String::new(),
                    kind: String::new(),
                    at: node.middle(),
                    heading: None,
                    is_start: true,
                });
            }
            "Rooms" | "Floor" | "Floors" | "Walls" | "Ceiling" | "Doors" | "Windows" => {}
            _ => match twin(node, &pieces) {
                Some(first) => {
                    let text = said!("the-thing-is-left-out", first);
                    remarks.push(remark(&node.id, text));
                }
                None => pieces.push(node.piece()),
            },
        }
    }
    let Shelf { kinds, things, feet } = shelve(pieces);
    let level =
        Level { source: "0".to_owned(), rooms, openings, things, spots, ..Level::default() };
    Ok(Survey { levels: vec![level], kinds, feet, remarks, notes, ..Survey::default() })
}

struct Node<'v> {
    id: String,
    class: &'v str,
    prefab: &'v str,
    category: &'v str,
    low: [f64; 3],
    high: [f64; 3],
    states: Vec<&'v str>,
    properties: Vec<&'v str>,
}

impl<'v> Node<'v> {
    fn of(record: &'v Value, remarks: &mut Vec<Remark>) -> Option<Self> {
        let id = record.get("id").map(id_text).unwrap_or_default();
        let class = text(record, "class_name").unwrap_or_default();
        let category = text(record, "category").unwrap_or_default();
        let triple = |field: &str| -> Option<[f64; 3]> {
            let numbers = record.get("bounding_box")?.get(field)?.as_array()?;
            let [x, y, z] = numbers.as_slice() else { return None };
            Some([length(x)?, length(y)?, length(z)?])
        };
        let (Some(centre), Some(size)) = (triple("center"), triple("size")) else {
            remarks.push(remark(id, said!("is-left-out-its-place", class)));
            return None;
        };
        let words = |field: &str| -> Vec<&'v str> {
            list(record, field).iter().filter_map(Value::as_str).collect()
        };
        let mut low: [f64; 3] = std::array::from_fn(|i| centre[i] - size[i].abs() / 2.0);
        let high: [f64; 3] = std::array::from_fn(|i| centre[i] + size[i].abs() / 2.0);
        // The drain of a bath reaches through the floor, which lies at height 0: the bath stands on it.
        if low[1] < -SUNK && high[1] > 0.0 {
            low[1] = 0.0;
        }
        Some(Self {
            id,
            class,
            prefab: text(record, "prefab_name").unwrap_or(class),
            category,
            low,
            high,
            states: words("states"),
            properties: words("properties"),
        })
    }

    fn middle(&self) -> Point {
        Point::new(self.low[0].midpoint(self.high[0]), self.low[2].midpoint(self.high[2]))
    }

    fn half(&self) -> [f64; 2] {
        [(self.high[0] - self.low[0]) / 2.0, (self.high[2] - self.low[2]) / 2.0]
    }

    fn outline(&self) -> Vec<Point> {
        rectangle(self.low[0], self.low[2], self.high[0], self.high[2])
    }

    fn can(&self, what: &str) -> bool {
        self.properties.contains(&what)
    }

    /// Of two opposite states the one that is set.
    fn either(&self, yes: &str, no: &str) -> Option<bool> {
        match (self.states.contains(&yes), self.states.contains(&no)) {
            (true, _) => Some(true),
            (false, true) => Some(false),
            (false, false) => None,
        }
    }

    fn piece(&self) -> Piece {
        let half = self.half();
        let height = self.high[1] - self.low[1];
        let mut properties = Properties::new();
        state(self.either("OPEN", "CLOSED"), self.either("ON", "OFF"), &mut properties);
        if let Some(dirty) = self.either("DIRTY", "CLEAN") {
            let word = if dirty { "Грязное" } else { "Чистое" };
            properties.insert("ЧИСТОТА".to_owned(), word.to_owned());
        }
        let known = ABILITIES.iter().filter(|(word, _)| self.can(word));
        let mut kind_properties: Properties =
            known.map(|(_, name)| ((*name).to_owned(), "Да".to_owned())).collect();
        if let Some(material) = colour::material(self.prefab) {
            kind_properties.insert("МАТЕРИАЛ".to_owned(), material.to_owned());
        }
        let sizes = [half[0], half[1], height / 2.0].map(|h| (h * 200.0).round() / 100.0);
        Piece {
            source: self.id.clone(),
            kind: format!("{}@{}x{}x{}", self.prefab, sizes[0], sizes[1], sizes[2]),
            word: self.class.to_owned(),
            at: self.middle(),
            bottom: self.low[1],
            angle: 0.0,
            half,
            bay: None,
            height,
            facing: Facing::Unknown,
            move_prob: match () {
                () if self.can("GRABBABLE") => Some(70),
                () if self.can("MOVABLE") => Some(40),
                () => None,
            },
            kind_properties,
            properties,
        }
    }
}

/// Ids are numbers; other programs write them as texts.
fn id_text(value: &Value) -> String {
    value.as_str().map_or_else(|| value.to_string(), str::to_owned)
}

/// The thing of the same word that fills the same box: a prefab and the prefab within it are listed both.
fn twin<'p>(node: &Node<'_>, pieces: &'p [Piece]) -> Option<&'p str> {
    /// The rounding of single precision, cm.
    const ROUNDING: f64 = 0.05;
    // A prefab stands next to its part in the list.
    let twin = pieces.iter().rev().take(8).find(|p| {
        let half = node.half();
        p.word == node.class
            && (p.at - node.middle()).norm() < ROUNDING
            && (p.bottom - node.low[1]).abs() < ROUNDING
            && (p.bottom + p.height - node.high[1]).abs() < ROUNDING
            && (p.half[0] - half[0]).abs() < ROUNDING
            && (p.half[1] - half[1]).abs() < ROUNDING
    });
    twin.map(|p| p.source.as_str())
}

/// The floor tiles of each room, by the room's id.
fn floors(graph: &Value, nodes: &[Node<'_>]) -> BTreeMap<String, Vec<Vec<Point>>> {
    let tiles: BTreeMap<&str, &Node<'_>> = nodes
        .iter()
        .filter(|n| matches!(n.category, "Floor" | "Floors"))
        .map(|n| (n.id.as_str(), n))
        .gather();
    let id = |edge: &Value, field: &str| edge.get(field).map(id_text);
    let mut floors: BTreeMap<String, Vec<Vec<Point>>> = BTreeMap::new();
    for edge in list(graph, "edges").iter().filter(|e| text(e, "relation_type") == Some("INSIDE")) {
        if let (Some(from), Some(to)) = (id(edge, "from_id"), id(edge, "to_id"))
            && let Some(tile) = tiles.get(from.as_str())
        {
            floors.entry(to).or_default().push(tile.outline());
        }
    }
    flush(&mut floors);
    floors
}

/// Makes the edges of tiles meet that miss each other by the rounding of their places, or by the thickness of a panel.
fn flush(floors: &mut BTreeMap<String, Vec<Vec<Point>>>) {
    /// Edges nearer than this are one edge, cm.
    const JOINT: f64 = 3.0;
    let edges = |along: fn(&Point) -> f64| {
        let mut all: Vec<f64> = floors.values().flatten().flatten().map(along).collect();
        all.sort_by(f64::total_cmp);
        all.dedup_by(|next, kept| *next - *kept < JOINT);
        all
    };
    let (x, y) = (edges(|p| p.x), edges(|p| p.y));
    let edge = |all: &[f64], v: f64| {
        all.get(all.partition_point(|kept| *kept <= v).wrapping_sub(1)).copied().unwrap_or(v)
    };
    for p in floors.values_mut().flatten().flatten() {
        *p = Point::new(edge(&x, p.x), edge(&y, p.y));
    }
}

fn rooms(nodes: &[Node<'_>], floors: &BTreeMap<String, Vec<Vec<Point>>>) -> Vec<Room> {
    let rooms = nodes.iter().filter(|n| n.category == "Rooms");
    rooms
        .flat_map(|room| {
            let floor = floors.get(&room.id).map(|tiles| plane::union(tiles)).unwrap_or_default();
            // Tiles that lie apart, with another room between them, are floor all the same.
            let pieces = if floor.is_empty() { vec![room.outline()] } else { floor };
            pieces.into_iter().map(|outline| Room {
                source: room.id.clone(),
                kind: room.class.to_owned(),
                outline,
                height: Some(Cm::of(room.high[1] - room.low[1])).filter(|h| h.get() > 100.0),
                ..Room::default()
            })
        })
        .filter(|room| plane::area(&room.outline) > 1.0)
        .collect()
}

/// Doors with their frames, and frames without a door: passages.
fn doors(nodes: &[Node<'_>], rooms: &[Room], remarks: &mut Vec<Remark>) -> Vec<Opening> {
    let of = |class: &'static str| {
        nodes.iter().filter(move |n| n.category == "Doors" && n.class == class)
    };
    let near = |a: &Node<'_>, b: &Node<'_>| (a.middle() - b.middle()).norm() < SAME_PLACE;
    let mut found = Vec::new();
    for door in of("door") {
        let frame = of("doorjamb").find(|f| near(door, f));
        let along = frame.map_or_else(|| wall_across(door, rooms), |f| long_side(f));
        let Some(along) = along else {
            remarks.push(remark(&door.id, word!("the-door-is-left-out")));
            continue;
        };
        let open = door.either("OPEN", "CLOSED").unwrap_or(false);
        let leaf = DoorLeaf {
            hinge: HingeSide::Right,
            share: 1.0,
            thickness: Cm::of(LEAF),
            max_open: 90.0,
        };
        let what = OpeningKind::Door {
            kind: DoorKind::Hinged,
            leaves: vec![leaf],
            opens: None,
            status: if open { DoorStatus::Open } else { DoorStatus::Closed },
            opening: if open { 100.0 } else { 0.0 },
        };
        // The box of a door is the square that its leaf sweeps, a metre high; its frame tells the height.
        let height = frame.map(|f| f.high[1] - f.low[1]);
        found.push(opening(door, along, what, height));
    }
    for frame in of("doorjamb").filter(|f| !of("door").any(|d| near(d, f))) {
        match long_side(frame) {
            Some(along) => {
                let height = frame.high[1] - frame.low[1];
                found.push(opening(frame, along, OpeningKind::Passage, Some(height)));
            }
            None => remarks.push(remark(&frame.id, word!("the-opening-is-left-out"))),
        }
    }
    found
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Axis {
    X,
    Y,
}

fn long_side(node: &Node<'_>) -> Option<Axis> {
    let [x, y] = node.half();
    match () {
        () if x > 2.0 * y => Some(Axis::X),
        () if y > 2.0 * x => Some(Axis::Y),
        () => None,
    }
}

/// The way of the wall in which a door without a frame stands: the rooms lie on both sides of it.
fn wall_across(door: &Node<'_>, rooms: &[Room]) -> Option<Axis> {
    let room = |dx: f64, dy: f64| {
        let p = door.middle() + nalgebra::Vector2::new(dx, dy) * STEP;
        rooms.iter().position(|r| contains(&r.outline, p))
    };
    let differ = |a: Option<usize>, b: Option<usize>| a != b;
    match (differ(room(0., 1.), room(0., -1.)), differ(room(1., 0.), room(-1., 0.))) {
        (true, false) => Some(Axis::X),
        (false, true) => Some(Axis::Y),
        _ => None,
    }
}

fn opening(node: &Node<'_>, along: Axis, what: OpeningKind, height: Option<f64>) -> Opening {
    let (middle, half) = (node.middle(), node.half());
    let way = match along {
        Axis::X => nalgebra::Vector2::new(half[0], 0.0),
        Axis::Y => nalgebra::Vector2::new(0.0, half[1]),
    };
    Opening {
        source: node.id.clone(),
        name: String::new(),
        what,
        jambs: [middle - way, middle + way],
        rooms: None,
        height: height.filter(|h| *h > 50.0).map(Cm::of),
        sill: Cm::ZERO,
        properties: Properties::new(),
    }
}

fn window(node: &Node<'_>) -> Opening {
    let [x, y] = node.half();
    let along = if x >= y { Axis::X } else { Axis::Y };
    let height = node.high[1] - node.low[1];
    Opening {
        sill: Cm::of(node.low[1].max(0.0)),
        ..opening(node, along, OpeningKind::Window, Some(height))
    }
}
