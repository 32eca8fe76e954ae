//! ProcTHOR houses: rooms, walls, doors, windows and things with children, sizes in a database of assets.
//!
//! The house file (schema 1.0.0 of `procthor` for AI2-THOR) names an asset for each thing; its box stands in
//! `asset-database.json`, a dictionary from the asset's word to a list of assets. Unity's frame is left-handed: x right,
//! y up, z forward, rotation about y clockwise from above; here that is x right, y up the page, counter-clockwise.
//! The place of a thing is the middle of its box. A hole in a wall is measured from the first point of the polygon of
//! `wall0`, along its lower edge.

use std::collections::{BTreeMap, HashMap};
use std::ops::RangeInclusive;

use serde_json::Value;

use crate::map::{DoorKind, DoorLeaf, DoorStatus, HingeSide, Properties};
use crate::units::{Cm, Deg, Gather as _, Point, Source, said, word};
use crate::{Level, Opening, OpeningKind, ReadError, Remark, Room, Spot, Survey};

use super::colour;
use super::json::{angles, list, parse, plan, remark, text, triple};
use super::shape::{self, Bay, Build};
use super::stock::{Facing, Piece, Shelf, shelve, state};

const FORMAT: &str = "ProcTHOR";
/// Rotations about x and z smaller than this leave a thing upright, in degrees.
const UPRIGHT: f64 = 0.5;
/// How far some assets hang above what they lie on, in cm: they are dropped from 5 cm when a house is run, and a box is
/// not quite as exact as its asset.
const DROP: RangeInclusive<f64> = 2.5..=6.5;
/// Thickness of a leaf, cm; the file does not tell it.
const LEAF: f64 = 4.0;

/// Sizes and words of assets.
#[derive(Debug, Clone, Default)]
pub struct Assets {
    known: HashMap<String, Asset>,
}

#[derive(Debug, Clone)]
struct Asset {
    word: String,
    /// Half of the box along x, y, z, in cm.
    half: [f64; 3],
    opens: bool,
    switches: bool,
    material: Option<&'static str>,
    colour: Option<&'static str>,
}

impl Assets {
    /// Reads an asset database. An asset without a box is left out.
    ///
    /// # Errors
    /// [`ReadError::Syntax`]; [`ReadError::NoBuilding`] when there is no asset in it.
    pub fn read(source: &Source) -> Result<Self, ReadError> {
        let value = parse("AI2-THOR asset database", source)?;
        let mut known = HashMap::new();
        for (word, assets) in value.as_object().into_iter().flatten() {
            for asset in assets.as_array().into_iter().flatten() {
                let (Some(id), Some(size)) =
                    (text(asset, "assetId"), triple(asset.get("boundingBox")))
                else {
                    continue;
                };
                let can = |what: &str| {
                    list(asset, "secondaryProperties").iter().any(|p| p.as_str() == Some(what))
                };
                let materials = list(asset, "materials").iter().flat_map(|m| match m {
                    Value::Array(names) => names.first().and_then(Value::as_str),
                    other => other.as_str(),
                });
                let names: Vec<&str> = list(asset, "materials")
                    .iter()
                    .filter_map(|m| m.as_array()?.get(1)?.as_str())
                    .collect();
                let asset = Asset {
                    // The database calls all that hangs in frames paintings; the asset's name tells photographs.
                    word: match id.starts_with("Wall_Decor_Photo") {
                        true => "Photograph".to_owned(),
                        false => text(asset, "objectType").unwrap_or(word).to_owned(),
                    },
                    half: size.map(|s| s.abs() / 2.0),
                    opens: can("CanOpen"),
                    switches: can("CanToggleOnOff"),
                    material: materials.into_iter().find_map(colour::material),
                    // What is made of several materials has no one colour.
                    colour: match names[..] {
                        [only] => colour::of_name(only),
                        _ => None,
                    },
                };
                known.insert(id.to_owned(), asset);
            }
        }
        if known.is_empty() {
            let what = word!("the-database-has-no-thing").into();
            return Err(ReadError::NoBuilding { format: "AI2-THOR asset database", what });
        }
        Ok(Self { known })
    }

    #[must_use]
    pub fn len(&self) -> usize {
        self.known.len()
    }

    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.known.is_empty()
    }
}

/// Reads a house. A thing of which `assets` do not know the size is left out.
///
/// # Errors
/// [`ReadError::Syntax`]; [`ReadError::NoBuilding`] when it has no room; [`ReadError::NoSizes`] when there are things and
/// `assets` know none of them: a furnished house must not come out empty.
pub fn read_procthor(source: &Source, assets: &Assets) -> Result<Survey, ReadError> {
    let house = parse(FORMAT, source)?;
    let mut reader = Reader { assets, remarks: Vec::new() };
    let walls: BTreeMap<&str, Wall> = list(&house, "walls").iter().filter_map(Wall::of).gather();
    let rooms = reader.rooms(&house, &walls);
    if rooms.is_empty() {
        let what = word!("there-is-no-room-with-a").into();
        return Err(ReadError::NoBuilding { format: FORMAT, what });
    }
    let mut openings = Vec::new();
    for (field, is_window) in [("doors", false), ("windows", true)] {
        for record in list(&house, field) {
            openings.extend(reader.opening(record, is_window, &walls, &rooms));
        }
    }
    openings.extend(open_sides(&walls, &rooms));
    let mut pieces = Vec::new();
    for record in list(&house, "objects") {
        let piece = reader.piece(record);
        reader.thing(record, piece, &[], &mut pieces);
    }
    let count = list(&house, "objects").len();
    if pieces.is_empty() && count > 0 {
        let what = if assets.is_empty() {
            word!("the-database-of-them-is")
        } else {
            word!("the-database-is-of-other")
        };
        return Err(ReadError::NoSizes { format: FORMAT, what: what.into(), count });
    }
    let Shelf { kinds, things, feet } = shelve(pieces);
    let level = Level {
        source: "0".to_owned(),
        name: String::new(),
        elevation: Cm::ZERO,
        rooms,
        openings,
        things,
        spots: agent(&house).into_iter().collect(),
        lanes: Vec::new(),
    };
    Ok(Survey {
        name: String::new(),
        levels: vec![level],
        kinds,
        feet,
        remarks: reader.remarks,
        ..Survey::default()
    })
}

/// Where the file puts the robot.
fn agent(house: &Value) -> Option<Spot> {
    let agent = house.get("metadata")?.get("agent")?;
    let at = plan(triple(agent.get("position"))?);
    let [_, turn, _] = angles(agent.get("rotation"));
    Some(Spot {
        source: "agent".to_owned(),
        name: String::new(),
        kind: String::new(),
        at,
        heading: Some(Deg::of(90.0 - turn)),
        is_start: true,
    })
}

/// A wall: its lower edge, how high it is and what it looks like.
struct Wall {
    from: Point,
    to: Point,
    height: f64,
    room: String,
    /// Nothing stands here: two rooms are open to each other.
    is_empty: bool,
    material: Properties,
}

impl Wall {
    fn of(record: &Value) -> Option<(&str, Self)> {
        let corners: Vec<[f64; 3]> =
            list(record, "polygon").iter().filter_map(|p| triple(Some(p))).collect();
        let &[first, second, ..] = corners.as_slice() else { return None };
        let top = corners.iter().map(|c| c[1]).fold(0.0, f64::max);
        let wall = Self {
            from: plan(first),
            to: plan(second),
            height: top - first[1],
            room: text(record, "roomId").unwrap_or_default().to_owned(),
            is_empty: record.get("empty").and_then(Value::as_bool) == Some(true),
            material: surface(record.get("material"), ""),
        };
        Some((text(record, "id")?, wall))
    }
}

/// Where two rooms meet without a wall: both have an empty one there, from end to end. Each is told once.
fn open_sides(walls: &BTreeMap<&str, Wall>, rooms: &[Room]) -> Vec<Opening> {
    /// Ends of one wall as the file rounds them, cm.
    const SAME: f64 = 1.0;
    let empty: Vec<(&str, usize, &Wall)> = walls
        .iter()
        .filter(|(_, wall)| wall.is_empty)
        .filter_map(|(id, wall)| {
            Some((*id, rooms.iter().position(|r| r.source == wall.room)?, wall))
        })
        .collect();
    let meets = |a: &Wall, b: &Wall| (a.from - b.to).norm() < SAME && (a.to - b.from).norm() < SAME;
    let mut found = Vec::new();
    for (n, &(id, one, wall)) in empty.iter().enumerate() {
        let other = empty[n + 1..].iter().find(|(_, room, w)| *room != one && meets(wall, w));
        let Some(&(_, other, _)) = other else { continue };
        let mut jambs = [wall.from, wall.to];
        if lies_left(&rooms[one].outline, jambs) == Some(false) {
            jambs.swap(0, 1);
        }
        found.push(Opening {
            source: id.to_owned(),
            name: String::new(),
            what: OpeningKind::Passage,
            jambs,
            rooms: Some([Some(one), Some(other)]),
            height: Some(Cm::of(wall.height)).filter(|height| *height > Cm::ZERO),
            sill: Cm::ZERO,
            properties: Properties::new(),
        });
    }
    found
}

/// ЦВЕТ and МАТЕРИАЛ of a floor or wall.
fn surface(material: Option<&Value>, suffix: &str) -> Properties {
    let mut found = Properties::new();
    let Some(material) = material else { return found };
    if let Some(word) = text(material, "name").and_then(colour::material) {
        found.insert(format!("МАТЕРИАЛ{suffix}"), word.to_owned());
    }
    let channel = |c: &str| material.get("color")?.get(c)?.as_f64();
    if let (Some(r), Some(g), Some(b)) = (channel("r"), channel("g"), channel("b")) {
        found.insert(format!("ЦВЕТ{suffix}"), colour::of_rgb([r, g, b]).to_owned());
    } else if let Some(colour) = text(material, "name").and_then(colour::of_name) {
        found.insert(format!("ЦВЕТ{suffix}"), colour.to_owned());
    }
    found
}

struct Reader<'a> {
    assets: &'a Assets,
    remarks: Vec<Remark>,
}

impl Reader<'_> {
    fn rooms(&mut self, house: &Value, walls: &BTreeMap<&str, Wall>) -> Vec<Room> {
        let mut heights: HashMap<&str, f64> = HashMap::new();
        let mut looks: HashMap<&str, &Properties> = HashMap::new();
        for wall in walls.values() {
            let height = heights.entry(&wall.room).or_default();
            *height = height.max(wall.height);
            looks.insert(&wall.room, &wall.material);
        }
        let mut rooms = Vec::new();
        for record in list(house, "rooms") {
            let id = text(record, "id").unwrap_or_default();
            let outline: Vec<Point> = list(record, "floorPolygon")
                .iter()
                .filter_map(|p| triple(Some(p)))
                .map(plan)
                .collect();
            if outline.len() < 3 {
                self.remarks.push(remark(id, word!("the-room-is-left-out")));
                continue;
            }
            let mut properties = surface(record.get("floorMaterial"), " ПОЛА");
            for (name, value) in looks.get(id).into_iter().flat_map(|p| p.iter()) {
                properties.insert(format!("{name} СТЕН"), value.clone());
            }
            rooms.push(Room {
                source: id.to_owned(),
                name: String::new(),
                kind: text(record, "roomType").unwrap_or_default().to_owned(),
                called: String::new(),
                outline,
                holes: Vec::new(),
                height: heights.get(id).filter(|h| **h > 0.0).map(|&h| Cm::of(h)),
                properties,
            });
        }
        rooms
    }

    fn opening(
        &mut self,
        record: &Value,
        is_window: bool,
        walls: &BTreeMap<&str, Wall>,
        rooms: &[Room],
    ) -> Option<Opening> {
        let id = text(record, "id").unwrap_or_default();
        let hole: Vec<[f64; 3]> =
            list(record, "holePolygon").iter().filter_map(|p| triple(Some(p))).collect();
        let wall = ["wall0", "wall1"].iter().find_map(|w| walls.get(text(record, w)?));
        let (Some(wall), &[low, high, ..]) = (wall, hole.as_slice()) else {
            self.remarks.push(remark(id, word!("the-opening-is-left-out-its")));
            return None;
        };
        let along = wall.to - wall.from;
        let length = along.norm();
        if length < 1.0 {
            self.remarks.push(remark(id, word!("the-opening-is-left-out-its-wall")));
            return None;
        }
        let jamb = |x: f64| wall.from + along * (x / length);
        let mut jambs = [jamb(low[0].min(high[0])), jamb(low[0].max(high[0]))];
        let room = |field: &str| {
            let id = text(record, field)?;
            rooms.iter().position(|r| r.source == id)
        };
        let (one, other) = (room("room0"), room("room1"));
        let sides = if one == other { [one, None] } else { [one, other] };
        // Seen from within, the right jamb comes first: the room lies to the left of the way from it.
        if let Some(first) = one.map(|r| &rooms[r].outline)
            && lies_left(first, jambs) == Some(false)
        {
            jambs.swap(0, 1);
        }
        let asset = text(record, "assetId").unwrap_or_default();
        let what = if is_window {
            OpeningKind::Window
        } else if asset.starts_with("Doorframe") {
            OpeningKind::Passage
        } else {
            door(record, asset)
        };
        let mut properties = Properties::new();
        if let Some(material) = colour::material(asset) {
            properties.insert("МАТЕРИАЛ".to_owned(), material.to_owned());
        }
        Some(Opening {
            source: id.to_owned(),
            name: String::new(),
            what,
            jambs,
            rooms: Some(sides),
            height: Some(Cm::of((high[1] - low[1]).abs())),
            sill: Cm::of(low[1].min(high[1])),
            properties,
        })
    }

    /// A thing, if its size is known, and what lies on it; `surfaces` are heights on which it may stand itself, in cm.
    fn thing(
        &mut self,
        record: &Value,
        piece: Option<Piece>,
        surfaces: &[f64],
        pieces: &mut Vec<Piece>,
    ) {
        let children: Vec<(&Value, Option<Piece>)> =
            list(record, "children").iter().map(|child| (child, self.piece(child))).collect();
        // On top of it, or where something else in it stands: on the seat of a sofa, in a drawer.
        let mut inside: Vec<f64> = Vec::new();
        let mut seat = None;
        if let Some(mut piece) = piece {
            let under = surfaces.iter().filter(|&at| DROP.contains(&(piece.bottom - at)));
            piece.bottom = under.copied().reduce(f64::min).unwrap_or(piece.bottom);
            inside.extend(children.iter().filter_map(|(_, child)| Some(child.as_ref()?.bottom)));
            let top = piece.bottom + piece.height;
            if shape::build(&piece.word) == Build::Seat {
                let mut levels: Vec<f64> = inside.iter().map(|at| at - piece.bottom).collect();
                levels.sort_by(f64::total_cmp);
                seat = Some((top, piece.bottom + shape::seat_level(piece.height, &levels)));
            }
            inside.push(top);
            let lies_there = |bay: &Bay| {
                children
                    .iter()
                    .any(|(_, c)| c.as_ref().is_some_and(|c| bay.contains(piece.own(c.at))))
            };
            if piece.bay.as_ref().is_some_and(lies_there) {
                // The file shows that something is there, whatever the asset's name says.
                piece.bay = None;
                piece.kind.push_str("@whole");
            }
            pieces.push(piece);
        }
        // Nesting is limited by the parser.
        for (child, mut piece) in children {
            // A pillow at the height of the headboard falls onto the bed.
            if let (Some(piece), Some((top, seat))) = (&mut piece, seat)
                && (piece.bottom - top).abs() < *DROP.start()
            {
                piece.bottom = seat;
            }
            self.thing(child, piece, &inside, pieces);
        }
    }

    fn piece(&mut self, record: &Value) -> Option<Piece> {
        let id = text(record, "id").unwrap_or_default();
        let asset_id = text(record, "assetId").unwrap_or_default();
        let Some(asset) = self.assets.known.get(asset_id) else {
            let text = said!("the-thing-is-left-out-the", asset_id);
            self.remarks.push(remark(id, text));
            return None;
        };
        let Some(at) = triple(record.get("position")) else {
            self.remarks.push(remark(id, word!("the-thing-is-left-out-it")));
            return None;
        };
        let turn = angles(record.get("rotation"));
        let half = tilted(asset.half, turn);
        let upright = is_upright(turn);
        let mut properties = Properties::new();
        let openness = record.get("openness").and_then(Value::as_f64);
        let open = openness.map(|o| o > 0.0).or_else(|| asset.opens.then_some(false));
        let on = record.get("isOn").and_then(Value::as_bool);
        state(open, on.or_else(|| asset.switches.then_some(false)), &mut properties);
        if let Some(dirty) = record.get("isDirty").and_then(Value::as_bool) {
            let word = if dirty { "Грязное" } else { "Чистое" };
            properties.insert("ЧИСТОТА".to_owned(), word.to_owned());
        }
        let mut kind_properties = Properties::new();
        if let Some(material) = asset.material {
            kind_properties.insert("МАТЕРИАЛ".to_owned(), material.to_owned());
        }
        if let Some(colour) = asset.colour {
            kind_properties.insert("ЦВЕТ".to_owned(), colour.to_owned());
        }
        let kind = if upright {
            asset_id.to_owned()
        } else {
            format!("{asset_id}@{:.0}x{:.0}x{:.0}", half[0] * 2.0, half[2] * 2.0, half[1] * 2.0)
        };
        Some(Piece {
            source: id.to_owned(),
            kind,
            word: asset.word.clone(),
            at: plan(at),
            bottom: at[1] - half[1],
            angle: -turn[1],
            half: [half[0], half[2]],
            bay: bay(asset_id, [half[0], half[2]]).filter(|_| upright),
            height: half[1] * 2.0,
            facing: if upright { Facing::Own } else { Facing::Unknown },
            move_prob: (record.get("kinematic").and_then(Value::as_bool) == Some(true))
                .then_some(0),
            kind_properties,
            properties,
        })
    }
}

/// Where the box of a counter is empty, by the name of its asset: `Countertop_L_8x10` is a row along the back and one
/// along the right side, `Countertop_C_8x6` has one along both sides. All are as deep as the straight ones are.
fn bay(asset: &str, [w, d]: [f64; 2]) -> Option<Bay> {
    /// Depth of the straight counters of the database, cm.
    const ROW: f64 = 61.1;
    let form = asset.strip_prefix("Countertop_")?.split('_').next()?;
    let left = match form {
        "L" => -w,
        "C" => ROW - w,
        _ => return None,
    };
    let bay = Bay { low: Point::new(left, ROW - d), high: Point::new(w - ROW, d) };
    (bay.high - bay.low).iter().all(|side| *side > shape::SAME_LEVEL).then_some(bay)
}

/// A hinged door with the leaves that its asset's name tells of.
fn door(record: &Value, asset: &str) -> OpeningKind {
    let openness = record.get("openness").and_then(Value::as_f64).unwrap_or(0.0).clamp(0.0, 1.0);
    let can_open = record.get("openable").and_then(Value::as_bool) != Some(false);
    let leaf = |hinge, share| DoorLeaf { hinge, share, thickness: Cm::of(LEAF), max_open: 90.0 };
    let leaves = if asset.contains("Double") {
        vec![leaf(HingeSide::Right, 0.5), leaf(HingeSide::Left, 0.5)]
    } else {
        vec![leaf(HingeSide::Right, 1.0)]
    };
    let status = match (openness > 0.0, can_open) {
        (true, _) => DoorStatus::Open,
        (false, true) => DoorStatus::Closed,
        (false, false) => DoorStatus::Locked,
    };
    OpeningKind::Door {
        kind: DoorKind::Hinged,
        leaves,
        opens: None,
        status,
        opening: openness * 100.0,
    }
}

/// Whether the inside of an outline lies to the left of the way from one jamb to the other.
fn lies_left(outline: &[Point], [from, to]: [Point; 2]) -> Option<bool> {
    let along = (to - from).try_normalize(1e-6)?;
    let left = nalgebra::Vector2::new(-along.y, along.x) * 2.0;
    let middle = nalgebra::center(&from, &to);
    match (contains(outline, middle + left), contains(outline, middle - left)) {
        (true, false) => Some(true),
        (false, true) => Some(false),
        _ => None,
    }
}

/// Ray to the right; points on the border fall to one side or the other.
pub(super) fn contains(outline: &[Point], p: Point) -> bool {
    let ends = outline.iter().zip(outline.iter().cycle().skip(1));
    let crossings = ends.filter(|(a, b)| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (b.x - a.x) * (p.y - a.y) / (b.y - a.y)
    });
    crossings.count() % 2 == 1
}

fn is_upright([x, _, z]: [f64; 3]) -> bool {
    let flat = |a: f64| a.rem_euclid(360.0).min(360.0 - a.rem_euclid(360.0)) < UPRIGHT;
    flat(x) && flat(z)
}

/// Half extents of a box after its rotation about z and then x, along its own axes before it is turned about y.
fn tilted(half: [f64; 3], turn: [f64; 3]) -> [f64; 3] {
    if is_upright(turn) {
        return half;
    }
    let ((sx, cx), (sz, cz)) = (turn[0].to_radians().sin_cos(), turn[2].to_radians().sin_cos());
    let rows = [[cz, -sz, 0.0], [cx * sz, cx * cz, -sx], [sx * sz, sx * cz, cx]];
    rows.map(|row| row.iter().zip(half).map(|(r, h)| (r * h).abs()).sum())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_bottle_that_lies_is_as_long_as_it_was_high() {
        let half = tilted([4.0, 15.0, 4.0], [90.0, 30.0, 0.0]);
        assert!((half[1] - 4.0).abs() < 1e-9 && (half[2] - 15.0).abs() < 1e-9);
        let upright = tilted([4.0, 15.0, 4.0], [0.1, 30.0, 359.9]);
        assert!((upright[1] - 15.0).abs() < 1e-9);
    }

    #[test]
    fn the_right_jamb_is_on_the_right_of_who_looks_out() {
        let room =
            [(0.0, 0.0), (400.0, 0.0), (400.0, 300.0), (0.0, 300.0)].map(|(x, y)| Point::new(x, y));
        let lower = [Point::new(100.0, 0.0), Point::new(200.0, 0.0)];
        assert_eq!(lies_left(&room, lower), Some(true));
        assert_eq!(lies_left(&room, [lower[1], lower[0]]), Some(false));
    }
}
