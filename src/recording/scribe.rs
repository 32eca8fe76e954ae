//! Makes messages of what a mission does.

use std::collections::BTreeMap;

use base64::Engine as _;
use serde_json::{Value, json};

use crate::exchange::{Cell, Grid};
use crate::geometry::{FloorPlan, Scene};
use crate::map::World;
use crate::units::{Deg, Frame, MapId, Point, Pose};

use super::scene::{Entity, rooms, things, update};
use super::shapes::{metre, pose, quaternion, timestamp, vector};
use super::{Message, Schema};

/// The frame in which the storeys stand.
const BUILDING: &str = "building";
/// The robot's own.
const ROBOT: &str = "robot";
/// A storey's picture has no more cells than this: they are made larger, by halves.
const MOST_CELLS: usize = 250_000;
/// cm
const CELL: f64 = 5.0;

/// How much it matters to who reads the log.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Level {
    Info,
    Warning,
    Error,
}

/// One turn of a range finder, at the robot's last pose.
#[derive(Debug, Clone, Copy)]
pub struct Turn<'s> {
    /// Above the floor, cm.
    pub height: f64,
    /// Of the first ray against the robot's heading, and from each to the next; degrees.
    pub from: f64,
    pub step: f64,
    /// cm; none where a ray met nothing.
    pub ranges: &'s [Option<f64>],
}

/// See the head of this file.
#[derive(Debug, Default)]
pub struct Scribe {
    /// Of the last message, nanoseconds since 1970.
    now: u64,
    /// Storeys with their frames.
    storeys: BTreeMap<MapId, Storey>,
    /// What was last told of what stands about, by topic.
    told: BTreeMap<String, Vec<u8>>,
}

#[derive(Debug)]
struct Storey {
    key: String,
    /// In the building.
    frame: Frame,
}

impl Scribe {
    /// Begins at a moment: nanoseconds since 1970.
    #[must_use]
    pub fn new(now: u64) -> Self {
        Self { now, ..Self::default() }
    }

    /// The moment of the last message.
    #[must_use]
    pub fn now(&self) -> u64 {
        self.now
    }

    /// Time passes up to a moment; it never goes back.
    pub fn reach(&mut self, moment: u64) {
        self.now = self.now.max(moment);
    }

    fn message(&self, topic: impl Into<String>, schema: Schema, value: &Value) -> Message {
        let data = value.to_string().into_bytes();
        Message { topic: topic.into(), schema, time: self.now, data }
    }

    /// The building as it stands: frames, pictures, rooms. What is as it was told last is not told again.
    pub fn building<'f>(
        &mut self,
        world: &World,
        floors: impl Iterator<Item = &'f FloorPlan> + Clone,
    ) -> Vec<Message> {
        let mut messages = Vec::new();
        self.storeys =
            floors.clone().map(|plan| (plan.map(), Storey::of(world, plan.map()))).collect();
        let transforms: Vec<Value> = self.storeys.values().map(|s| self.transform_of(s)).collect();
        let frames = json!({ "transforms": transforms });
        messages.push(self.message("/frames", Schema::FrameTransforms, &frames));
        for plan in floors {
            let key = self.storeys[&plan.map()].key.clone();
            if let Some(grid) = picture(plan) {
                let told = self.grid(&key, &grid);
                messages.push(self.message(format!("/map/{key}"), Schema::Grid, &told));
            }
            let entities = rooms(world, plan.scene(), plan.map());
            messages.push(self.scene(format!("/rooms/{key}"), &key, entities));
        }
        self.news(messages)
    }

    /// What stands about and how doors stand, where that is not as it was told last. `floors` are those of the survey,
    /// which the building was told by.
    pub fn things<'f>(
        &mut self,
        world: &World,
        floors: impl Iterator<Item = &'f FloorPlan>,
    ) -> Vec<Message> {
        let mut messages = Vec::new();
        for plan in floors {
            let Some(storey) = self.storeys.get(&plan.map()) else { continue };
            if !world.maps.contains_key(&plan.map()) {
                continue;
            }
            let (topic, key) = (format!("/things/{}", storey.key), storey.key.clone());
            let scene = Scene::of(world, plan.map());
            messages.push(self.scene(topic, &key, things(world, plan, &scene)));
        }
        self.news(messages)
    }

    /// Leaves out what says, but for its time, what was said last.
    fn news(&mut self, messages: Vec<Message>) -> Vec<Message> {
        let is_new = |message: &Message| {
            let text = String::from_utf8_lossy(&message.data)
                .replace(&timestamp(message.time).to_string(), "");
            let before = self.told.insert(message.topic.clone(), text.clone().into_bytes());
            before.is_none_or(|before| before != text.as_bytes())
        };
        messages.into_iter().filter(is_new).collect()
    }

    fn scene(&self, topic: String, key: &str, entities: Vec<Entity>) -> Message {
        self.message(topic, Schema::SceneUpdate, &update(key, self.now, entities))
    }

    fn transform_of(&self, storey: &Storey) -> Value {
        let frame = storey.frame;
        json!({
            "timestamp": timestamp(self.now), "parent_frame_id": BUILDING, "child_frame_id": storey.key,
            "translation": vector(Point::new(frame.x.get(), frame.y.get()), frame.z.get()),
            "rotation": quaternion(frame.angle),
        })
    }

    fn grid(&self, key: &str, grid: &Grid) -> Value {
        let field =
            |(offset, name): (usize, &&str)| json!({ "name": name, "offset": offset, "type": 1 });
        let fields: Vec<Value> =
            ["red", "green", "blue", "alpha"].iter().enumerate().map(field).collect();
        let rgba = |cell: &Cell| match cell {
            Cell::Free => [245, 245, 240, 255],
            Cell::Occupied => [70, 70, 80, 255],
            Cell::Unknown => [0, 0, 0, 0],
        };
        let bytes: Vec<u8> = grid.cells.iter().flat_map(rgba).collect();
        let size = metre(grid.cell);
        // A little below the floor, so that what is drawn on the floor is seen.
        let corner = json!({ "position": vector(grid.low, -1.0), "orientation": { "x": 0, "y": 0, "z": 0, "w": 1 } });
        json!({
            "timestamp": timestamp(self.now), "frame_id": key, "pose": corner,
            "column_count": grid.width, "cell_size": { "x": size, "y": size },
            "row_stride": grid.width * 4, "cell_stride": 4, "fields": fields,
            "data": base64::engine::general_purpose::STANDARD.encode(bytes),
        })
    }

    fn key(&self, map: MapId) -> &str {
        self.storeys.get(&map).map_or(BUILDING, |storey| &storey.key)
    }

    /// Where the robot is.
    #[must_use]
    pub fn pose(&self, map: MapId, at: Pose) -> Vec<Message> {
        let (time, key) = (timestamp(self.now), self.key(map));
        let told = json!({ "timestamp": time, "frame_id": key, "pose": pose(at, 0.0) });
        let transform = json!({
            "timestamp": time, "parent_frame_id": key, "child_frame_id": ROBOT,
            "translation": vector(at.at, 0.0), "rotation": quaternion(at.heading),
        });
        vec![
            self.message("/tf", Schema::FrameTransforms, &json!({ "transforms": [transform] })),
            self.message("/pose", Schema::PoseInFrame, &told),
        ]
    }

    /// What the range finder saw. A ray that met nothing has range and intensity 0: the schema has no other word for it.
    #[must_use]
    pub fn scan(&self, turn: &Turn<'_>) -> Message {
        let rays = turn.ranges.len().saturating_sub(1) as f64;
        let ranges: Vec<f64> =
            turn.ranges.iter().map(|range| metre(range.unwrap_or(0.0))).collect();
        let met: Vec<u8> = turn.ranges.iter().map(|range| u8::from(range.is_some())).collect();
        let above = json!({
            "position": vector(Point::new(0.0, 0.0), turn.height),
            "orientation": { "x": 0, "y": 0, "z": 0, "w": 1 },
        });
        let value = json!({
            "timestamp": timestamp(self.now), "frame_id": ROBOT, "pose": above,
            "start_angle": turn.from.to_radians(),
            "end_angle": (turn.from + turn.step * rays).to_radians(),
            "ranges": ranges, "intensities": met,
        });
        self.message("/scan", Schema::LaserScan, &value)
    }

    /// The way along which the robot is sent. Each point looks along the leg that leads on from it.
    #[must_use]
    pub fn path(&self, map: MapId, way: &[Point]) -> Message {
        let mut poses = Vec::new();
        let mut heading = Deg::ZERO;
        for (no, point) in way.iter().enumerate() {
            if let Some(on) = way.get(no + 1).map(|next| next - point).filter(|on| on.norm() > 0.0)
            {
                heading = Deg::from_radians(on.y.atan2(on.x));
            }
            poses.push(pose(Pose { at: *point, heading }, 2.0));
        }
        let value =
            json!({ "timestamp": timestamp(self.now), "frame_id": self.key(map), "poses": poses });
        self.message("/path", Schema::PosesInFrame, &value)
    }

    /// Words, from whoever says them.
    #[must_use]
    pub fn words(&self, level: Level, from: &str, text: &str) -> Message {
        let level = match level {
            Level::Info => 2,
            Level::Warning => 3,
            Level::Error => 4,
        };
        let value = json!({
            "timestamp": timestamp(self.now), "level": level, "message": text, "name": from,
            "file": "", "line": 0,
        });
        self.message("/words", Schema::Log, &value)
    }

    /// An event: an object that has its name in `event`.
    #[must_use]
    pub fn event(&self, topic: &str, event: &Value) -> Message {
        self.message(topic, Schema::Event, event)
    }
}

impl Storey {
    fn of(world: &World, map: MapId) -> Self {
        let placed = world.domain.maps.iter().find(|placed| placed.map == map);
        let frame = placed.map_or(Frame::IDENTITY, |placed| placed.frame);
        Self { key: world.maps[&map].key.clone(), frame }
    }
}

/// The storey's picture, of cells as small as there may be.
fn picture(plan: &FloorPlan) -> Option<Grid> {
    // 5 cm doubled forty times is more than any building.
    let sizes = (0..40).map(|power| CELL * f64::from(1 << power.min(30)));
    sizes.filter_map(|cell| Grid::of_floor(plan, cell)).find(|grid| grid.cells.len() <= MOST_CELLS)
}
