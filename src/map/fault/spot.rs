//! A place in the model: a record, and what lies within it, in the words of the map file.

use std::fmt;

use crate::TypeKind;
use crate::units::{AreaId, DoorId, MapId, ObjectId, OrFrId, PlaceId, ReplicaId, TypeId, ZoneId};

/// A record of a [`World`](crate::World).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Record {
    Domain,
    Robot,
    Type(TypeKind, TypeId),
    Orthoframe(OrFrId),
    Object(ObjectId),
    Door(DoorId),
    Area(AreaId),
    Replica(ReplicaId),
    Place(PlaceId),
    Map(MapId),
    Zone(ZoneId),
}

/// One step from a record to what lies within it, in the words of the map file.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Step {
    Field(&'static str),
    /// Of a table whose keys the map chooses: the id of a side, the key of a door.
    Key(String),
    Index(usize),
}

/// A place in the model.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct Spot {
    pub record: Record,
    pub steps: Vec<Step>,
}

impl Spot {
    #[must_use]
    pub fn of(record: Record) -> Self {
        Self { record, steps: Vec::new() }
    }

    #[must_use]
    pub fn field(mut self, name: &'static str) -> Self {
        self.steps.push(Step::Field(name));
        self
    }

    #[must_use]
    pub fn key(mut self, key: &str) -> Self {
        self.steps.push(Step::Key(key.to_owned()));
        self
    }

    #[must_use]
    pub fn index(mut self, index: usize) -> Self {
        self.steps.push(Step::Index(index));
        self
    }
}

impl fmt::Display for Spot {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self.record {
            Record::Domain => write!(f, "domain")?,
            Record::Robot => write!(f, "robot")?,
            Record::Type(kind, id) => write!(f, "type.{}[{}]", kind.field(), id.0)?,
            Record::Orthoframe(id) => write!(f, "orthoframe[{}]", id.0)?,
            Record::Object(id) => write!(f, "object[{}]", id.0)?,
            Record::Door(id) => write!(f, "door[{}]", id.0)?,
            Record::Area(id) => write!(f, "area[{}]", id.0)?,
            Record::Replica(id) => write!(f, "replica[{}]", id.0)?,
            Record::Place(id) => write!(f, "place[{}]", id.0)?,
            Record::Map(id) => write!(f, "map[{}]", id.0)?,
            Record::Zone(id) => write!(f, "zone[{}]", id.0)?,
        }
        self.steps.iter().try_for_each(|step| match step {
            Step::Field(name) => write!(f, ".{name}"),
            Step::Key(key) => write!(f, ".{key}"),
            Step::Index(index) => write!(f, "[{index}]"),
        })
    }
}
