//! [`Drive`]: all that a mission asks of a vehicle (X3).

use crate::geometry::Ride;
use crate::map::{DoorState, Entity, Replica};
use crate::units::{AreaId, Deg, DoorId, Frame, MapId, Point, Pose, ReplicaId};

/// What stands in the way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Obstruction {
    Wall(AreaId),
    Door(DoorId),
    Replica(ReplicaId),
}

impl Obstruction {
    /// What it is on the Map; of a wall, the room.
    #[must_use]
    pub fn entity(self) -> Entity {
        match self {
            Self::Wall(area) => Entity::Area(area),
            Self::Door(door) => Entity::Door(door),
            Self::Replica(replica) => Entity::Replica(replica),
        }
    }
}

/// A motion that ended early, with the robot stopped just before the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Bump {
    pub at: Pose,
    pub against: Obstruction,
}

/// A thing that the vehicle would not or could not do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Refusal {
    /// The door is locked.
    Locked(DoorId),
    /// A leaf strikes something on its way; none is the vehicle itself. `opening` is how far the door stands open then,
    /// in per cent.
    DoorJammed { door: DoorId, by: Option<Obstruction>, opening: u8 },
    /// Farther than the arm reaches.
    OutOfReach(ReplicaId),
    /// The thing is not where it was expected.
    NotThere(ReplicaId),
    /// The hand holds another thing.
    HandFull(ReplicaId),
    /// The hand does not hold it.
    NotHeld(ReplicaId),
    /// The support has no free place for it.
    NoRoom(ReplicaId),
    /// It is in something that is shut.
    Shut(ReplicaId),
}

impl Refusal {
    /// What to look at for the reason.
    #[must_use]
    pub fn about(self) -> Option<Obstruction> {
        match self {
            Self::DoorJammed { by: Some(thing), .. } => Some(thing),
            Self::Locked(door) | Self::DoorJammed { door, by: None, .. } => {
                Some(Obstruction::Door(door))
            }
            Self::OutOfReach(thing) | Self::NotThere(thing) => Some(Obstruction::Replica(thing)),
            Self::HandFull(_) | Self::NotHeld(_) | Self::NoRoom(_) | Self::Shut(_) => None,
        }
    }
}

/// What the vehicle's senses say of one thing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Sighting {
    Door {
        door: DoorId,
        state: DoorState,
    },
    /// A replica seen at a frame of an Area.
    Replica {
        replica: ReplicaId,
        area: AreaId,
        frame: Frame,
    },
}

/// A vehicle with a hand. All positions are of its Map's frame, cm; times are seconds since it was switched on.
pub trait Drive {
    /// Where the vehicle knows itself to be.
    fn pose(&self) -> (MapId, Pose);

    fn time(&self) -> f64;

    /// Drives along a polyline from where it stands, turning on the spot at each corner, and ends facing
    /// `heading` when one is given.
    ///
    /// # Errors
    /// [`Bump`] when something that the path did not reckon with stands in the way.
    fn follow(&mut self, path: &[Point], heading: Option<Deg>) -> Result<(), Bump>;

    /// Opens, shuts, locks or unlocks a door next to the vehicle.
    ///
    /// # Errors
    /// [`Refusal`]; the door is then as it was.
    fn set_door(&mut self, door: DoorId, state: DoorState) -> Result<(), Refusal>;

    /// Calls a lift to the door at which the vehicle stands, and waits until it is open; without a door, to a passage.
    ///
    /// # Errors
    /// [`Refusal`]; the cabin is not there.
    fn call_lift(&mut self, door: Option<DoorId>) -> Result<(), Refusal>;

    /// Rides a lift in whose cabin it stands, until this door of it is open where it stops. `arrival` is where the
    /// vehicle then is, on the Map of that storey.
    ///
    /// # Errors
    /// [`Refusal`]; the door stays shut. The vehicle is where it rode to all the same.
    fn ride(
        &mut self,
        ride: &Ride,
        door: Option<DoorId>,
        arrival: (MapId, Pose),
    ) -> Result<(), Refusal>;

    /// Takes a thing into the hand, with what lies on it and in it.
    ///
    /// # Errors
    /// [`Refusal`]; the hand is then as it was.
    fn take(&mut self, thing: ReplicaId) -> Result<(), Refusal>;

    /// Puts the thing in the hand down at a frame of an Area.
    ///
    /// # Errors
    /// [`Refusal`]; the hand is then as it was.
    fn put(&mut self, thing: ReplicaId, area: AreaId, frame: Frame) -> Result<(), Refusal>;

    /// Gives the thing in the hand to a person who stands by.
    ///
    /// # Errors
    /// [`Refusal`]; the hand is then as it was.
    fn hand_over(&mut self, thing: ReplicaId) -> Result<(), Refusal>;

    /// Takes back what a person who stands by was given, with what went along.
    ///
    /// # Errors
    /// [`Refusal`]; the hand is then as it was.
    fn take_back(&mut self, thing: Replica, with: Vec<Replica>) -> Result<(), Refusal>;

    /// Switches a device on or off.
    ///
    /// # Errors
    /// [`Refusal`]; the device is then as it was.
    fn switch(&mut self, device: ReplicaId, on: bool) -> Result<(), Refusal>;

    /// Calls a person; whether anybody comes is another matter.
    fn call(&mut self, person: &str);

    /// Turns round once, so that everything about has been looked at.
    fn look_round(&mut self);

    /// Where a thing is that stands in view of here, whichever way the vehicle faces; `None` when it is hidden.
    fn sees(&self, thing: ReplicaId) -> Option<Sighting>;

    /// What there is to see of a thing from here; `None` when it is out of sight.
    fn look_at(&self, what: Obstruction) -> Option<Sighting>;
}
