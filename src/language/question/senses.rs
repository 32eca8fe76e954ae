//! What the map alone cannot know, as a robot tells it.

use crate::map::DoorState;
use crate::report::Detail;
use crate::units::{AreaId, DoorId, MapId, Pose, ReplicaId};
use crate::words::Language;

use super::query::Thing;

/// What the map alone cannot know: where the robot is, ways over the floor, what was seen when.
pub trait Senses {
    /// Where the robot stands.
    fn robot(&self) -> Option<(MapId, Pose)>;
    /// The report of its position.
    fn position(&self, language: Language, detail: Detail) -> Option<String>;
    /// A way for the robot; from where it stands when no start is given.
    ///
    /// # Errors
    /// Why there is none, in the language of the question.
    fn way(
        &self,
        from: Option<Thing>,
        to: Thing,
        language: Language,
        detail: Detail,
    ) -> Result<Way, String>;
    /// The same without entering some rooms, passing some doors or taking some lifts; a lift is any of its stops. Where one
    /// begins, and the room to which one wants, is entered all the same.
    ///
    /// # Errors
    /// As [`Senses::way`].
    fn way_without(
        &self,
        from: Option<Thing>,
        to: Thing,
        avoided: &[Thing],
        language: Language,
    ) -> Result<Way, String>;

    /// Things in the order in which the robot's way through them is the shortest.
    fn round(&self, things: &[Thing]) -> Vec<Thing> {
        things.to_vec()
    }
    /// How much farther than its arm reaches a thing is from the nearest place at which the robot can stand, cm.
    fn beyond_arm(&self, thing: ReplicaId) -> Option<f64>;
    /// What the robot sees, the nearest first.
    fn visible(&self) -> Vec<ReplicaId>;
    /// Who has a thing that was taken off the map; an empty name for the robot itself.
    fn holder(&self, thing: ReplicaId) -> Option<String>;
    /// On or in which thing a thing lies that was taken off the map together with it.
    fn carrier(&self, thing: ReplicaId) -> Option<ReplicaId>;
    /// How sure it is where a thing is, 0..=1, where that is too little to be told as a fact.
    fn doubted(&self, thing: ReplicaId) -> Option<f64>;
    /// What the robot carries.
    fn held(&self) -> Vec<ReplicaId>;
    /// What was observed of a thing, the oldest first.
    fn sightings(&self, thing: ReplicaId) -> Vec<Sighting>;
    /// Where a thing was before, the oldest first; the present place is not among them.
    fn past(&self, thing: ReplicaId) -> Vec<Past>;
    /// What is not as the map has it, as far as the robot saw or did it.
    fn changed(&self) -> Vec<News>;
    /// Things of the map that the robot has never seen, and how many it has.
    fn unseen(&self) -> (Vec<ReplicaId>, usize);
    /// How well the robot knows where it is, in words; none where it is nowhere.
    fn sureness(&self, language: Language) -> Option<String>;
}

/// Something that is not as the map has it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum News {
    /// A thing is elsewhere: in this room.
    Moved(ReplicaId, AreaId),
    /// A thing is not where the map has it, and was not seen elsewhere.
    Missed(ReplicaId),
    /// A door stands so.
    Door(DoorId, DoorState),
    /// A thing that the map does not have.
    New(ReplicaId),
    Switched(ReplicaId, bool),
    /// In the robot's hand, or given away.
    Taken(ReplicaId),
}

/// A way over the floor.
#[derive(Debug, Clone, PartialEq)]
pub struct Way {
    /// cm
    pub length: f64,
    /// How long lifts are waited for and ridden on it, in seconds.
    pub riding: f64,
    pub sentences: Vec<String>,
    /// The same by its rooms and doors.
    pub rooms: RoomPath,
}

/// A step from one room to the next: by a door or passage, or by a lift.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Crossing {
    pub by: Thing,
    pub into: AreaId,
}

/// The room in which a way begins, and its crossings in order.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct RoomPath {
    pub start: AreaId,
    pub crossings: Vec<Crossing>,
}

/// One look at a thing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Sighting {
    /// When, as people write it.
    pub at: String,
    /// None when it was not where it was expected.
    pub place: Option<AreaId>,
}

/// A former place of a thing.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Past {
    /// When it left, as people write it; none where nobody noted that.
    pub until: Option<String>,
    pub area: Option<AreaId>,
    pub support: Option<ReplicaId>,
    /// Whether it was in its support, and not on it.
    pub inside: bool,
}
