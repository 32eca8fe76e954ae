//! The vehicle protocol, version 1: what a mission and a vehicle write to each other, one JSON object a line.
//!
//! docs/vehicle.md says the same for people. Lengths are cm, angles degrees counter-clockwise from +x, times seconds since
//! the vehicle was switched on. Poses and paths are of the frame of their Map, places of things of the frame of their Area.
//! Everything is called by its name on the map.
//!
//! **Invariant**: fields may be added; who reads passes over those that it does not know.

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::map::{DoorState, DoorStatus};
use crate::units::{Cm, Deg, Frame, Point, Pose};

/// The version that is spoken here.
pub const VERSION: u32 = 1;

/// The longest line that is read, bytes.
pub const LONGEST_LINE: usize = 1 << 20;

/// One line to the vehicle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Order {
    /// Counts from 1; what the vehicle says to it bears the same number.
    pub id: u64,
    #[serde(flatten)]
    pub what: Wish,
}

/// What a vehicle is asked to do.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "do", rename_all = "snake_case")]
pub enum Wish {
    /// The first line; answered by `ready`.
    Hello {
        #[schemars(range(max = u32::MAX))]
        protocol: u32,
        /// The name of the building.
        domain: String,
    },
    /// Drive along a polyline from where it stands, turning on the spot at each corner; done, `bumped` or `stopped`.
    Follow {
        path: Vec<[f64; 2]>,
        /// Face this way in the end.
        heading: Option<f64>,
        /// Not faster than so many cm/s, where a zone asks for it; left out elsewhere.
        #[serde(skip_serializing_if = "Option::is_none")]
        speed: Option<f64>,
    },
    /// Open, shut, lock or unlock a door next to the vehicle.
    SetDoor {
        door: String,
        status: Status,
        /// How far it is to stand open, per cent; 0 unless it is.
        opening: f64,
    },
    /// Call a lift to the door at which the vehicle stands and wait until it is open; without a door, to a passage.
    CallLift { door: Option<String> },
    /// Ride a lift in whose cabin it stands until this door is open at the other stop.
    Ride {
        lift: String,
        /// The cabin on the Map where it stands, and that on the Map to which it rides.
        from: String,
        to: String,
        /// How much higher it then is; negative downwards.
        rise: f64,
        door: Option<String>,
        /// Where it is then held to be.
        arrival: Stand,
    },
    /// Open or shut the doors, lid or drawer of a thing. Asked only of a robot that the map says `opens`.
    SetOpen { thing: String, open: bool },
    /// Push a thing over the floor to there. Asked only of what the map says is `movable`.
    Push { thing: String, place: Place },
    /// Take a thing into the hand, with what lies on it and in it.
    Take { thing: String },
    /// Put the thing in the hand down.
    Put { thing: String, place: Place },
    /// Give the thing in the hand to a person who stands by.
    HandOver { thing: String },
    /// Take back what a person who stands by was given.
    TakeBack { thing: String },
    /// Switch a device.
    Switch { device: String, on: bool },
    /// Call a person.
    Call { person: String },
    /// Turn round once, looking.
    LookRound,
    /// Where a thing is, if it is in view of here, whichever way the vehicle faces; answered by `seen`.
    Sees { thing: String },
    /// What there is to see of something from here; answered by `seen`.
    LookAt { what: Thing },
    /// Say where it is; answered by `done`.
    Report,
    /// Stop what this order asked for, at once. Not answered itself: the order is, by `stopped`, or by what it came to.
    Cancel { order: u64 },
}

/// One line from the vehicle.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Message {
    /// Of the order that it belongs to.
    pub id: u64,
    /// Never less than before.
    pub time: f64,
    /// Where the vehicle now is.
    pub at: Stand,
    #[serde(flatten)]
    pub what: Saying,
}

/// What a vehicle says. `going`, `saw` and `scan` may come any number of times while an order is under way; every other
/// ends it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(tag = "say", rename_all = "snake_case")]
pub enum Saying {
    /// To `hello`.
    Ready {
        #[schemars(range(max = u32::MAX))]
        protocol: u32,
        /// What the vehicle is called, for people.
        name: String,
        /// What it tells of where it stands is what its wheels count, and the paths that it follows are of that frame.
        #[serde(default, skip_serializing_if = "is_false")]
        odometry: bool,
    },
    /// It is at work.
    Going,
    /// It saw something on its way.
    Saw { sighting: Sight },
    /// Its range finder turned once.
    Scan(Scan),
    /// It is done.
    Done,
    /// To `follow`: something stands in the way, and it stopped just before.
    Bumped { against: Thing },
    /// It would not or could not; all is as before, but for a ride, which ends at its other stop.
    Refused { why: No },
    /// It was told to stop and did.
    Stopped,
    /// To `sees` and `look_at`.
    Seen { sighting: Option<Sight> },
    /// It can do no more, now or ever.
    Failed { text: String },
}

#[expect(clippy::trivially_copy_pass_by_ref, reason = "serde asks for a reference")]
fn is_false(told: &bool) -> bool {
    !told
}

/// Where a vehicle stands.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Stand {
    pub map: String,
    pub x: f64,
    pub y: f64,
    pub heading: f64,
}

impl Stand {
    pub(super) fn new(map: &str, pose: Pose) -> Self {
        let Pose { at, heading } = pose;
        Self { map: map.to_owned(), x: at.x, y: at.y, heading: heading.get() }
    }

    /// None where a number is none, or no building is so large.
    pub(super) fn pose(&self) -> Option<Pose> {
        Some(Pose { at: point([self.x, self.y])?, heading: Deg::new(self.heading).ok()? })
    }
}

/// None where a coordinate is none, or no building is so large.
pub(super) fn point([x, y]: [f64; 2]) -> Option<Point> {
    Some(Point::new(Cm::new(x).ok()?.get(), Cm::new(y).ok()?.get()))
}

/// Where a thing stands: the frame of its Object in that of an Area.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Place {
    pub area: String,
    pub x: f64,
    pub y: f64,
    pub z: f64,
    pub angle: f64,
}

impl Place {
    pub(super) fn new(area: &str, frame: Frame) -> Self {
        let Frame { x, y, z, angle } = frame;
        Self { area: area.to_owned(), x: x.get(), y: y.get(), z: z.get(), angle: angle.get() }
    }

    /// None where a coordinate is none.
    pub(super) fn frame(&self) -> Option<Frame> {
        let length = |value| Cm::new(value).ok();
        let (x, y, z) = (length(self.x)?, length(self.y)?, length(self.z)?);
        Some(Frame { x, y, z, angle: Deg::new(self.angle).ok()? })
    }
}

/// How a door stands.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Status {
    Open,
    Closed,
    Locked,
}

impl From<DoorStatus> for Status {
    fn from(status: DoorStatus) -> Self {
        match status {
            DoorStatus::Open => Self::Open,
            DoorStatus::Closed => Self::Closed,
            DoorStatus::Locked => Self::Locked,
        }
    }
}

impl From<Status> for DoorStatus {
    fn from(status: Status) -> Self {
        match status {
            Status::Open => Self::Open,
            Status::Closed => Self::Closed,
            Status::Locked => Self::Locked,
        }
    }
}

/// None where a door cannot stand so.
pub(super) fn door_state(status: Status, opening: f64) -> Option<DoorState> {
    let most = if status == Status::Open { 100.0 } else { 0.0 };
    (0.0..=most).contains(&opening).then(|| DoorState { status: status.into(), opening })
}

/// Something that stands somewhere: `{"door": NAME}`, `{"thing": NAME}`, `{"wall": AREA}` or `"unknown"`.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Thing {
    /// A wall of this Area.
    Wall(String),
    Door(String),
    Thing(String),
    /// What the map does not have.
    Unknown,
}

/// What was seen.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Sight {
    Door { door: String, status: Status, opening: f64 },
    Thing { thing: String, place: Place },
}

/// Why not.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum No {
    /// The door is locked.
    Locked { door: String },
    /// Its leaf strikes something on its way; nothing named, the vehicle itself. `opening` is how far it stands open then, per cent.
    Jammed { door: String, by: Option<Thing>, opening: u8 },
    /// Farther than the arm reaches.
    OutOfReach { thing: String },
    /// It is not where it was expected.
    NotThere { thing: String },
    /// The hand holds this.
    HandFull { thing: String },
    /// The hand does not hold it.
    NotHeld { thing: String },
    /// There is no free place on it.
    NoRoom { thing: String },
    /// What one wants is in it, and it is shut.
    Shut { thing: String },
    /// It is not to be pushed, or not to there.
    Stays { thing: String },
}

/// One turn of a range finder, as it was at the pose of its message.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct Scan {
    /// Above the floor, cm.
    pub height: f64,
    /// Of the first ray, against the vehicle's heading; and from each ray to the next. Degrees.
    pub from: f64,
    pub step: f64,
    /// How far each ray went, cm; null where it met nothing.
    pub ranges: Vec<Option<f64>>,
}

/// Both sides of the protocol.
#[derive(JsonSchema)]
#[expect(dead_code, reason = "only its schema is wanted")]
struct Protocol {
    order: Order,
    message: Message,
}

/// The JSON Schema of both sides.
#[must_use]
pub fn json_schema() -> String {
    format!("{:#}", schemars::schema_for!(Protocol).as_value())
}
