//! Open-RMF building maps, `*.building.yaml`, as the traffic editor writes them.
//!
//! Walls and doors are edges between numbered vertices; rooms are the faces of that graph, and what the drawn floors
//! cover beyond them. In the coordinate system `reference_image` vertices are pixels with y down, and measurements
//! tell how long a pixel is; levels are laid over one another by their fiducials. In `cartesian_meters` they are
//! metres with y up, in `wgs84` degrees of longitude and latitude, in `web_mercator` parts of a square of 256; both are
//! laid flat about the first vertex. Angles are counter-clockwise in all.
//!
//! Lanes are hints for the robots of another system. A face through which one runs is floor, whatever the drawn floors
//! cover; else they are only held against the rooms. Named vertices, chargers and parking spots become places.

mod document;
mod faces;
mod rooms;

use std::collections::HashMap;

use serde_json::Value;

use crate::map::{DoorKind, DoorLeaf, DoorStatus, HingeSide, OpensTo, Permeability, Properties};
use crate::units::{Bilingual, Cm, Deg, Point, Source, Vector, said, word};

use super::{
    Kind, Lane, Level, Lift, Opening, OpeningKind, Part, ReadError, Remark, Room, Spot, Survey,
    Thing, zero_of,
};
use document::{Fit, System, entries, length, list, number, param, points, text};
use faces::Edge;

const FORMAT: &str = "Open-RMF";
const METRE: f64 = 100.0;
/// Height of walls in the traffic editor, cm.
const WALL: f64 = 250.0;
/// Thickness of walls in the traffic editor, cm.
const WALL_THICKNESS: f64 = 10.0;
/// Metres of a pixel where a level has no measurement.
const PIXEL: f64 = 0.05;
/// Vertices, edges and models of one level.
const MOST: usize = 500_000;

/// Lanes of one level that are looked at: hints, held against every room near them.
const MOST_LANES: usize = 20_000;

/// Whether a text is a building of the traffic editor.
#[must_use]
pub(super) fn recognises(text: &str) -> bool {
    let has = |word: &str| text.lines().any(|line| line.trim_end() == word);
    has("levels:") && text.contains("vertices:") && text.contains("elevation:")
}

/// Reads a building.
///
/// # Errors
/// [`ReadError::Syntax`]; [`ReadError::NoBuilding`] when no level has a room; [`ReadError::TooMany`].
pub fn read(source: &Source) -> Result<Survey, ReadError> {
    let building = document::parse(source)?;
    let word = text(&building, "coordinate_system");
    let Some(system) = System::named(word) else {
        let word = word.unwrap_or_default();
        let what = said!("the-coordinate-system-is-not", word);
        return Err(ReadError::NoBuilding { format: FORMAT, what });
    };
    let mut reader = Reader::default();
    let levels: Vec<(&str, &Value)> = entries(&building, "levels");
    reader.fits = match system {
        System::Image => {
            let fits = reader.lay_levels(&levels, text(&building, "reference_level_name"));
            reader.survey.frame = "метры RMF: точки рисунка × масштаб, y вверх".to_owned();
            fits
        }
        System::Metres => vec![Fit::metres(); levels.len()],
        System::Degrees | System::Mercator => {
            let fit = Reader::laid_flat(system, &levels)?;
            let (lat, lon) = fit.zero(system);
            reader.survey.frame = zero_of(lat, lon);
            vec![fit; levels.len()]
        }
    };
    for (i, (name, level)) in levels.iter().enumerate() {
        reader.level(i, name, level)?;
    }
    let names: Vec<&str> = levels.iter().map(|(name, _)| *name).collect();
    for (name, lift) in entries(&building, "lifts") {
        reader.lift(name, lift, &names);
    }
    if reader.survey.levels.iter().all(|level| level.rooms.is_empty()) {
        let what = word!("walls-and-floors-make-no").into();
        return Err(ReadError::NoBuilding { format: FORMAT, what });
    }
    text(&building, "name").unwrap_or_default().clone_into(&mut reader.survey.name);
    Ok(reader.survey)
}

#[derive(Default)]
struct Reader {
    /// Of each level into the frame of the first.
    fits: Vec<Fit>,
    survey: Survey,
    kinds: HashMap<String, usize>,
}

impl Reader {
    fn remark(&mut self, source: &str, text: impl Into<Bilingual>) {
        self.survey.remarks.push(Remark { source: source.to_owned(), text: text.into() });
    }

    /// Metres of a unit of each level, and how it lies on the reference level.
    fn lay_levels(&mut self, levels: &[(&str, &Value)], reference: Option<&str>) -> Vec<Fit> {
        let mut fits = Vec::with_capacity(levels.len());
        for (name, level) in levels {
            let scale = document::scale(level).unwrap_or_else(|| {
                self.remark(name, said!("storey-unmeasured", pixel = PIXEL * METRE));
                PIXEL
            });
            fits.push(Fit::pixels(scale));
        }
        let base = reference
            .and_then(|wanted| levels.iter().position(|(name, _)| *name == wanted))
            .unwrap_or(0);
        let Some((_, on)) = levels.get(base) else { return fits };
        let base_marks = document::fiducials(on, &fits[base]);
        for (i, (name, level)) in levels.iter().enumerate() {
            if i == base {
                continue;
            }
            match document::lay(&document::fiducials(level, &fits[i]), &base_marks) {
                Some(motion) => fits[i] = fits[i].then(motion),
                None => self.remark(name, word!("there-are-no-common-marks")),
            }
        }
        fits
    }

    /// The plane about the first vertex of a building on the globe.
    fn laid_flat(system: System, levels: &[(&str, &Value)]) -> Result<Fit, ReadError> {
        let place = |v: &Value| Some((number(v.get(0))?, number(v.get(1))?));
        let is_sound = |&(x, y): &(f64, f64)| match system {
            System::Mercator => (0.0..=256.0).contains(&x) && (0.0..=256.0).contains(&y),
            _ => x.abs() <= 180.0 && y.abs() <= 89.0,
        };
        let mut all = levels.iter().flat_map(|(_, level)| list(level, "vertices"));
        let first = all.find_map(|v| place(v).filter(is_sound));
        let Some((x, y)) = first else {
            let what = said!("no-vertex-lies-on-the");
            return Err(ReadError::NoBuilding { format: FORMAT, what });
        };
        Ok(match system {
            System::Mercator => Fit::mercator(x, y),
            _ => Fit::degrees(x, y),
        })
    }

    fn level(&mut self, index: usize, name: &str, level: &Value) -> Result<(), ReadError> {
        for what in ["vertices", "walls", "doors", "models"] {
            if list(level, what).len() > MOST {
                let what = said!("records-of-a-storey");
                return Err(ReadError::TooMany { format: FORMAT, what, limit: MOST });
            }
        }
        let fit = self.fits[index];
        let mut made = Level {
            source: name.to_owned(),
            name: name.to_owned(),
            elevation: length(level.get("elevation"), METRE).unwrap_or(Cm::ZERO),
            ..Level::default()
        };
        let vertices: Vec<Option<Point>> = points(level, "vertices", &fit);
        let walls = self.edges(&format!("{name}/walls"), list(level, "walls"), &vertices);
        let doors = self.edges(&format!("{name}/doors"), list(level, "doors"), &vertices);
        let graph: Vec<Edge> = walls
            .iter()
            .map(|w| Edge { ends: w.ends, tag: 0 })
            // A door's tag is its number among the doors that are sound, from 1.
            .chain(doors.iter().enumerate().map(|(i, d)| Edge { ends: d.ends, tag: i + 1 }))
            .collect();
        let plan = faces::faces(&graph);
        let polygons = |what: &str| -> Vec<Vec<Point>> {
            let corner =
                |v: &Value| vertices.get(usize::try_from(v.as_u64()?).ok()?)?.as_ref().copied();
            let records = list(level, what).iter();
            records.map(|p| list(p, "vertices").iter().filter_map(corner).collect()).collect()
        };
        made.spots = self.spots(name, list(level, "vertices"), &vertices);
        let lanes = list(level, "lanes");
        let lanes = &lanes[..lanes.len().min(MOST_LANES)];
        let lanes = self.edges(&format!("{name}/lanes"), lanes, &vertices);
        let driven: Vec<(Point, Point)> = lanes.iter().map(|lane| lane.ends).collect();
        let lane = |l: Drawn<'_>| Lane { source: l.source, ends: [l.ends.0, l.ends.1] };
        made.lanes = lanes.into_iter().map(lane).collect();
        let drawn = rooms::Drawn { floors: &polygons("floors"), holes: &polygons("holes") };
        let found = rooms::rooms(name, &plan, &drawn, &driven);
        let (rooms, faces): (Vec<Room>, Vec<Option<usize>>) = found.rooms.into_iter().unzip();
        made.rooms = rooms;
        for (source, hole) in found.left_out {
            let place = rooms::place(&hole);
            self.survey.notes.push(Remark { source, text: said!("no-floor-drawn", place) });
        }
        self.gaps(name, &plan);
        let door_names: Vec<String> = doors
            .iter()
            .map(|d| param(d.record, "name").and_then(Value::as_str).unwrap_or_default().to_owned())
            .collect();
        let named =
            rooms::Named { faces: &faces, plan: &plan, spots: &made.spots, doors: &door_names };
        named.tell(&mut made.rooms);
        for door in &doors {
            if let Some(opening) = self.door(door) {
                made.openings.push(opening);
            }
        }
        made.openings.extend(plan.open.iter().enumerate().map(|(i, &(a, b))| Opening {
            source: format!("{name}/open/{i}"),
            name: String::new(),
            what: OpeningKind::Passage,
            jambs: [a, b],
            rooms: None,
            height: None,
            sill: Cm::ZERO,
            properties: Properties::new(),
        }));
        for (i, model) in list(level, "models").iter().enumerate() {
            self.model(name, i, model, &fit, &mut made.things);
        }
        for (i, wall) in plan.loose.iter().filter(|edge| edge.tag == 0).enumerate() {
            self.partition(name, i, wall.ends, &mut made.things);
        }
        self.survey.levels.push(made);
        Ok(())
    }

    /// Doorways that nobody drew.
    fn gaps(&mut self, level: &str, plan: &faces::Plan) {
        let told = [
            (&plan.gaps, "gap", word!("an-opening-without-a-door")),
            (&plan.wide, "wide", word!("the-wall-is-broken-off")),
        ];
        for (gaps, sort, what) in told {
            for (i, (a, b)) in gaps.iter().enumerate() {
                let middle = nalgebra::center(a, b);
                let [x, y] = [middle.x, middle.y].map(|at| format!("{:.2}", at / METRE));
                let text = said!("gap", what, wide = (b - a).norm(), x, y);
                self.survey.notes.push(Remark { source: format!("{level}/{sort}/{i}"), text });
            }
        }
    }

    /// Edges whose two vertices exist.
    fn edges<'v>(
        &mut self,
        of: &str,
        records: &'v [Value],
        vertices: &[Option<Point>],
    ) -> Vec<Drawn<'v>> {
        let mut drawn = Vec::with_capacity(records.len());
        for (i, record) in records.iter().enumerate() {
            let source = format!("{of}/{i}");
            let end = |k: usize| {
                let index = usize::try_from(record.get(k)?.as_u64()?).ok()?;
                vertices.get(index).copied().flatten()
            };
            match (end(0), end(1)) {
                (Some(a), Some(b)) => drawn.push(Drawn { source, ends: (a, b), record }),
                _ => self.remark(&source, word!("left-out-the-vertex-to")),
            }
        }
        drawn
    }

    fn door(&mut self, door: &Drawn<'_>) -> Option<Opening> {
        let text_of = |name: &str| param(door.record, name).and_then(Value::as_str);
        let number_of = |name: &str| param(door.record, name).and_then(Value::as_f64);
        let word = text_of("type").unwrap_or("hinged");
        let is_double = word.starts_with("double");
        let kind = match word.trim_start_matches("double_") {
            "hinged" => DoorKind::Hinged,
            "sliding" | "telescope" => DoorKind::Sliding,
            _ => {
                self.remark(&door.source, said!("unknown-kind-of-door-a", word));
                DoorKind::Hinged
            }
        };
        let degrees = number_of("motion_degrees").map_or(90.0, f64::abs).clamp(1.0, 180.0);
        let leaf = |hinge, share| DoorLeaf {
            hinge,
            share,
            thickness: Cm::of(4.0),
            max_open: if kind == DoorKind::Hinged { degrees } else { 100.0 },
        };
        let is_at_end = text_of("motion_axis") == Some("end");
        let leaves = if is_double {
            // Right over left: the right section hangs at the first vertex.
            let ratio =
                number_of("right_left_ratio").filter(|r| *r > 0.01 && *r < 100.0).unwrap_or(1.0);
            let right = ratio / (1.0 + ratio);
            vec![leaf(HingeSide::Right, right), leaf(HingeSide::Left, 1.0 - right)]
        } else if is_at_end {
            vec![leaf(HingeSide::Left, 1.0)]
        } else {
            vec![leaf(HingeSide::Right, 1.0)]
        };
        // The editor turns a leaf clockwise from its closed place for direction 1.
        let is_clockwise = number_of("motion_direction").unwrap_or(1.0) >= 0.0;
        let opens_right = is_clockwise != (is_at_end && !is_double);
        Some(Opening {
            source: door.source.clone(),
            name: text_of("name").unwrap_or_default().to_owned(),
            what: OpeningKind::Door {
                kind,
                leaves,
                opens: Some(if opens_right { OpensTo::Outside } else { OpensTo::Inside }),
                status: DoorStatus::Open,
                opening: 100.0,
            },
            jambs: [door.ends.0, door.ends.1],
            rooms: None,
            height: None,
            sill: Cm::ZERO,
            properties: Properties::new(),
        })
    }

    fn spots(&mut self, level: &str, records: &[Value], vertices: &[Option<Point>]) -> Vec<Spot> {
        let mut spots = Vec::new();
        for (i, (record, at)) in records.iter().zip(vertices).enumerate() {
            let Some(at) = at else { continue };
            let name = record.get(3).and_then(Value::as_str).unwrap_or_default();
            let is = |what: &str| {
                let flag = record.get(4).and_then(|p| p.get(what)).and_then(|p| p.get(1));
                flag.and_then(Value::as_bool).unwrap_or(false)
            };
            let kind = match () {
                () if is("is_charger") => "charger",
                () if is("is_parking_spot") => "parking spot",
                () => "",
            };
            let dock = record.get(4).and_then(|p| p.get("dock_name")).and_then(|p| p.get(1));
            let name = match name {
                "" => dock.and_then(Value::as_str).unwrap_or_default(),
                name => name,
            };
            let spawned = record.get(4).and_then(|p| p.get("spawn_robot_name"));
            if let Some(robot) = spawned.and_then(|robot| robot.get(1)).and_then(Value::as_str) {
                let text = said!("the-robot-is-not-taken", robot);
                self.survey.notes.push(Remark { source: format!("{level}/vertices/{i}"), text });
            }
            if !name.is_empty() || !kind.is_empty() || spawned.is_some() {
                spots.push(Spot {
                    source: format!("{level}/vertices/{i}"),
                    name: name.to_owned(),
                    kind: kind.to_owned(),
                    at: *at,
                    heading: None,
                    is_start: spawned.is_some(),
                });
            }
        }
        spots
    }

    fn model(&mut self, level: &str, i: usize, model: &Value, fit: &Fit, things: &mut Vec<Thing>) {
        let source = format!("{level}/models/{i}");
        let Some(at) = document::point(model.get("x"), model.get("y"), fit) else {
            self.remark(&source, word!("left-out-bad-place"));
            return;
        };
        let word = text(model, "model_name").unwrap_or("model");
        let kind = self.kind(word);
        let is_static = model.get("static").and_then(Value::as_bool).unwrap_or(true);
        things.push(Thing {
            source,
            name: String::new(),
            kind,
            at,
            z: length(model.get("z"), METRE).unwrap_or(Cm::ZERO),
            angle: Deg::from_radians(number(model.get("yaw")).unwrap_or(0.0) + fit.turn()),
            room: None,
            move_prob: (!is_static).then_some(80),
            properties: Properties::new(),
        });
    }

    fn kind(&mut self, model: &str) -> usize {
        if let Some(&kind) = self.kinds.get(model) {
            return kind;
        }
        let word = model.rsplit('/').next().unwrap_or(model).to_owned();
        self.survey.kinds.push(Kind { source: model.to_owned(), word, ..Kind::default() });
        self.kinds.insert(model.to_owned(), self.survey.kinds.len() - 1);
        self.survey.kinds.len() - 1
    }

    /// A wall that bounds no room stands in one, as a screen does.
    fn partition(
        &mut self,
        level: &str,
        i: usize,
        (a, b): (Point, Point),
        things: &mut Vec<Thing>,
    ) {
        let length = (b - a).norm();
        if length < 2.0 * WALL_THICKNESS {
            return;
        }
        let half = WALL_THICKNESS / 2.0;
        let outline = [(0.0, -half), (length, -half), (length, half), (0.0, half)];
        let source = format!("{level}/partition/{i}");
        self.survey.kinds.push(Kind {
            source: source.clone(),
            word: "partition".to_owned(),
            parts: vec![Part {
                word: String::new(),
                outline: outline.map(|(x, y)| Point::new(x, y)).to_vec(),
                bottom: Cm::ZERO,
                height: Cm::of(WALL),
                permeability: Permeability::Impermeable,
            }],
            ..Kind::default()
        });
        let along = b - a;
        things.push(Thing {
            source,
            name: String::new(),
            kind: self.survey.kinds.len() - 1,
            at: a,
            z: Cm::ZERO,
            angle: Deg::from_radians(along.y.atan2(along.x)),
            room: None,
            move_prob: Some(0),
            properties: Properties::new(),
        });
    }

    /// A cabin is a room on each level that it serves; its doors are openings there.
    fn lift(&mut self, name: &str, lift: &Value, levels: &[&str]) {
        let reference = text(lift, "reference_floor_name")
            .and_then(|wanted| levels.iter().position(|level| *level == wanted))
            .unwrap_or(0);
        let Some(fit) = self.fits.get(reference).copied() else { return };
        let sizes = (length(lift.get("width"), METRE), length(lift.get("depth"), METRE));
        let (Some(at), (Some(width), Some(depth))) =
            (document::point(lift.get("x"), lift.get("y"), &fit), sizes)
        else {
            self.remark(name, word!("the-lift-is-left-out"));
            return;
        };
        let yaw = number(lift.get("yaw")).unwrap_or(0.0) + fit.turn();
        let frame = |x: f64, y: f64| {
            let (sin, cos) = yaw.sin_cos();
            at + Vector::new(x * cos - y * sin, x * sin + y * cos)
        };
        let (x, y) = (width.get().abs() / 2.0, depth.get().abs() / 2.0);
        let outline: Vec<Point> =
            [(-x, -y), (x, -y), (x, y), (-x, y)].map(|(x, y)| frame(x, y)).to_vec();
        let mut stops = Vec::new();
        for (level_name, doors) in entries(lift, "level_doors") {
            let Some(index) = levels.iter().position(|level| *level == level_name) else {
                self.remark(name, said!("the-storey-that-the-lift", level_name));
                continue;
            };
            let level = &mut self.survey.levels[index];
            stops.push((index, level.rooms.len()));
            level.rooms.push(Room {
                source: format!("{name}@{level_name}"),
                name: String::new(),
                kind: "lift".to_owned(),
                called: String::new(),
                outline: outline.clone(),
                holes: Vec::new(),
                height: Some(Cm::of(WALL)),
                properties: Properties::from([("ЛИФТ".to_owned(), name.to_owned())]),
            });
            for door_name in doors.as_array().into_iter().flatten().filter_map(Value::as_str) {
                let door = lift.get("doors").and_then(|all| all.get(door_name));
                match door.and_then(|door| cabin_door(door, &frame, (x, y))) {
                    Some((jambs, leaves)) => level.openings.push(Opening {
                        source: format!("{name}/{door_name}@{level_name}"),
                        name: String::new(),
                        what: OpeningKind::Door {
                            kind: DoorKind::Sliding,
                            leaves,
                            opens: None,
                            status: DoorStatus::Open,
                            opening: 100.0,
                        },
                        jambs,
                        rooms: None,
                        height: None,
                        sill: Cm::ZERO,
                        properties: Properties::new(),
                    }),
                    None => {
                        let text = said!("the-door-that-the-lift", door_name);
                        self.survey.remarks.push(Remark { source: name.to_owned(), text });
                    }
                }
            }
        }
        let (source, name) = (name.to_owned(), name.to_owned());
        self.survey.lifts.push(Lift { source, name, stops, is_told: true });
    }
}

/// An edge with its vertices.
struct Drawn<'v> {
    source: String,
    ends: (Point, Point),
    record: &'v Value,
}

/// The jambs of a cabin's door, in the wall of the cabin that is nearest to it, and its leaves.
fn cabin_door(
    door: &Value,
    frame: &dyn Fn(f64, f64) -> Point,
    (half_x, half_y): (f64, f64),
) -> Option<([Point; 2], Vec<DoorLeaf>)> {
    let x = length(door.get("x"), METRE)?.get();
    let y = length(door.get("y"), METRE)?.get();
    let half = length(door.get("width"), METRE)?.get() / 2.0;
    let axis = number(door.get("motion_axis_orientation")).unwrap_or(0.0);
    let (sin, cos) = axis.sin_cos();
    // The editor sets the door a little before the cabin; the opening stands in the cabin's own face.
    let (x, y) = if cos.abs() > sin.abs() {
        (x, y.clamp(-half_y, half_y))
    } else {
        (x.clamp(-half_x, half_x), y)
    };
    let jambs = [frame(x - cos * half, y - sin * half), frame(x + cos * half, y + sin * half)];
    let leaf = |hinge, share| DoorLeaf { hinge, share, thickness: Cm::of(4.0), max_open: 100.0 };
    let is_single = door.get("door_type").and_then(Value::as_u64) == Some(1);
    let leaves = if is_single {
        vec![leaf(HingeSide::Right, 1.0)]
    } else {
        vec![leaf(HingeSide::Right, 0.5), leaf(HingeSide::Left, 0.5)]
    };
    Some((jambs, leaves))
}
