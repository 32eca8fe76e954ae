//! [`Vehicle`]: all that a mission asks of what drives (X3); the simulator is one, what speaks the protocol another.
//!
//! Motions are begun, tell of their way, end, fail, and are stopped at any moment by the [`Stop`] of their [`Watch`].

mod client;
mod failure;
mod link;
mod names;
pub mod protocol;
mod server;

pub use client::{Patience, RemoteVehicle};
pub use failure::Failure;
pub use link::Address;
pub use server::{Served, serve};

use std::ops::ControlFlow;

use crate::geometry::{Polygon, Ride};
use crate::map::{DoorState, Entity};
use crate::units::{AreaId, Deg, DoorId, Frame, MapId, Point, Pose, ReplicaId, Stop};

use self::protocol::Scan;

/// One moment of a run; between two the vehicle moves evenly.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Moment {
    /// Seconds since the start.
    pub time: f64,
    pub map: MapId,
    pub pose: Pose,
}

/// What stands in the way.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Obstruction {
    Wall(AreaId),
    Door(DoorId),
    Replica(ReplicaId),
    /// What the Map does not know.
    Something,
}

impl Obstruction {
    /// What it is on the Map; of a wall, the room; none where the Map does not know it.
    #[must_use]
    pub fn entity(self) -> Option<Entity> {
        match self {
            Self::Wall(area) => Some(Entity::Area(area)),
            Self::Door(door) => Some(Entity::Door(door)),
            Self::Replica(replica) => Some(Entity::Replica(replica)),
            Self::Something => None,
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
    /// It is not to be pushed, or not to where it was to go.
    Stays(ReplicaId),
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
            Self::HandFull(_)
            | Self::NotHeld(_)
            | Self::NoRoom(_)
            | Self::Shut(_)
            | Self::Stays(_) => None,
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

/// Things that were met and that nobody knows.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Outlines {
    /// Of each that was seen convex pieces, counter-clockwise, in the Map's frame.
    pub things: Vec<Vec<Polygon>>,
    /// Of each that was touched and not seen there: nobody who walks is like that.
    pub felt: Vec<Vec<Polygon>>,
    /// They stand up to here at least, cm above the Map's zero.
    pub top: f64,
}

/// What a vehicle's senses have found on the floor where it is to differ from the world that it was told.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Gathered {
    /// Things that stand elsewhere.
    pub moved: Vec<Sighting>,
    /// Things that are not where they were to be seen.
    pub missed: Vec<ReplicaId>,
    /// What stands where nobody knows of anything.
    pub new: Outlines,
}

impl Sighting {
    /// What was seen.
    #[must_use]
    pub fn entity(self) -> Entity {
        match self {
            Self::Door { door, .. } => Entity::Door(door),
            Self::Replica { replica, .. } => Entity::Replica(replica),
        }
    }
}

/// Why something was not done to its end.
#[derive(Debug, Clone, PartialEq)]
pub enum Unfinished<Why> {
    /// Something in the world, which the vehicle tells; it is as well as before.
    Met(Why),
    /// It was told to stop.
    Stopped,
    /// The vehicle is of no more use.
    Failed(Failure),
}

impl<Why> Unfinished<Why> {
    /// The same with another reason.
    pub fn map<Other>(self, other: impl FnOnce(Why) -> Other) -> Unfinished<Other> {
        match self {
            Self::Met(why) => Unfinished::Met(other(why)),
            Self::Stopped => Unfinished::Stopped,
            Self::Failed(failure) => Unfinished::Failed(failure),
        }
    }
}

impl<Why> From<Why> for Unfinished<Why> {
    fn from(why: Why) -> Self {
        Self::Met(why)
    }
}

/// What a vehicle tells while it is at work.
#[derive(Debug, Clone, PartialEq)]
pub enum Notice {
    /// It is on its way.
    Moved(Moment),
    /// It saw something.
    Saw(Sighting),
    /// Its range finder turned once.
    Scanned(Scan),
    /// It had lost itself and finds itself here, wherever it was held to be.
    Found(Moment),
}

/// Who is told of the way, and may break it off.
type Hearer<'w> = &'w mut dyn FnMut(&Notice) -> ControlFlow<()>;

/// Who may stop a vehicle at work, and who is told of its way.
pub struct Watch<'w> {
    stop: Stop,
    tell: Option<Hearer<'w>>,
    is_broken: bool,
}

impl std::fmt::Debug for Watch<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.debug_struct("Watch").field("is_stopped", &self.is_stopped()).finish_non_exhaustive()
    }
}

impl<'w> Watch<'w> {
    /// Who is told may stop it too, by breaking off.
    pub fn new(stop: Stop, tell: &'w mut dyn FnMut(&Notice) -> ControlFlow<()>) -> Self {
        Self { stop, tell: Some(tell), is_broken: false }
    }

    /// Nobody looks on; it may be stopped.
    #[must_use]
    pub fn of(stop: &Stop) -> Self {
        Self { stop: stop.clone(), tell: None, is_broken: false }
    }

    /// Nobody looks on, and nobody stops it.
    #[must_use]
    pub fn none() -> Self {
        Self::of(&Stop::new())
    }

    /// What stops the vehicle.
    #[must_use]
    pub fn stop(&self) -> &Stop {
        &self.stop
    }

    /// Whether the vehicle is to stop at once.
    #[must_use]
    pub fn is_stopped(&self) -> bool {
        self.is_broken || self.stop.is_raised()
    }

    /// Tells of the way.
    pub fn notice(&mut self, notice: &Notice) {
        if let Some(tell) = &mut self.tell
            && tell(notice).is_break()
        {
            self.is_broken = true;
        }
    }

    /// # Errors
    /// [`Unfinished::Stopped`] once it is to stop.
    pub fn check<Why>(&self) -> Result<(), Unfinished<Why>> {
        if self.is_stopped() { Err(Unfinished::Stopped) } else { Ok(()) }
    }
}

/// What an order to the hand, to a door or a lift comes to.
pub type Done = Result<(), Unfinished<Refusal>>;

/// A vehicle with a hand. All positions are of its Map's frame, cm; times are seconds since it was switched on.
///
/// A drive that is stopped ends where it then is. Any other order is carried out wholly or not at all: one that is told to stop
/// while it is under way may be done to its end, and then it says that it is done.
pub trait Vehicle {
    /// Where the vehicle knows itself to be.
    fn pose(&self) -> (MapId, Pose);

    fn time(&self) -> f64;

    /// Whether its pose is what its wheels tell since they began to count, in a frame of their own, and paths are of that
    /// frame. A mission then finds it by its scans ([`crate::Pilot`]).
    fn tells_odometry(&self) -> bool {
        false
    }

    /// What it saw since it was asked last, besides what it told on its way.
    fn news(&mut self) -> Vec<Sighting> {
        Vec::new()
    }

    /// What it sees about it that the Map has not.
    fn outlines(&self) -> Outlines {
        Outlines::default()
    }

    /// All that its senses have found to differ so far; what it told before is among it.
    fn gathered(&self) -> Gathered {
        Gathered::default()
    }

    /// Whether its senses have found nothing where these convex pieces are, in the Map's frame.
    fn sees_through(&self, _pieces: &[Polygon]) -> bool {
        false
    }

    /// Drives along a polyline from where it stands, turning on the spot at each corner, and ends facing
    /// `heading` when one is given.
    ///
    /// # Errors
    /// [`Bump`] when something that the path did not reckon with stands in the way.
    fn follow(
        &mut self,
        path: &[Point],
        heading: Option<Deg>,
        watch: &mut Watch<'_>,
    ) -> Result<(), Unfinished<Bump>>;

    /// Drives no faster than so many cm/s from now on; as fast as it likes without a number. What cannot keep to a pace
    /// drives on as before.
    fn keep_to(&mut self, _pace: Option<f64>) {}

    /// Opens, shuts, locks or unlocks a door next to the vehicle.
    ///
    /// # Errors
    /// [`Refusal`]; the door is then as it was.
    fn set_door(&mut self, door: DoorId, state: DoorState, watch: &mut Watch<'_>) -> Done;

    /// Calls a lift to the door at which the vehicle stands, and waits until it is open; without a door, to a passage.
    ///
    /// # Errors
    /// [`Refusal`]; the cabin is not there.
    fn call_lift(&mut self, door: Option<DoorId>, watch: &mut Watch<'_>) -> Done;

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
        watch: &mut Watch<'_>,
    ) -> Done;

    /// Opens or shuts the doors, lid or drawer of a thing. A vehicle that cannot refuses.
    ///
    /// # Errors
    /// [`Refusal`]; the thing is then as it was.
    fn set_open(&mut self, thing: ReplicaId, open: bool, watch: &mut Watch<'_>) -> Done {
        let _cannot = open;
        watch.check()?;
        Err(Refusal::Shut(thing).into())
    }

    /// Pushes a thing on the floor to a frame of an Area, with what lies on it and in it. A vehicle that cannot refuses.
    ///
    /// # Errors
    /// [`Refusal`]; the thing is then as it was.
    fn push(
        &mut self,
        thing: ReplicaId,
        area: AreaId,
        frame: Frame,
        watch: &mut Watch<'_>,
    ) -> Done {
        let _cannot = (area, frame);
        watch.check()?;
        Err(Refusal::Stays(thing).into())
    }

    /// Takes a thing into the hand, with what lies on it and in it.
    ///
    /// # Errors
    /// [`Refusal`]; the hand is then as it was.
    fn take(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done;

    /// Puts the thing in the hand down at a frame of an Area.
    ///
    /// # Errors
    /// [`Refusal`]; the hand is then as it was.
    fn put(&mut self, thing: ReplicaId, area: AreaId, frame: Frame, watch: &mut Watch<'_>) -> Done;

    /// Gives the thing in the hand to a person who stands by.
    ///
    /// # Errors
    /// [`Refusal`]; the hand is then as it was.
    fn hand_over(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done;

    /// Takes back what a person who stands by was given, with what went along.
    ///
    /// # Errors
    /// [`Refusal`]; the hand is then as it was.
    fn take_back(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done;

    /// Switches a device on or off.
    ///
    /// # Errors
    /// [`Refusal`]; the device is then as it was.
    fn switch(&mut self, device: ReplicaId, on: bool, watch: &mut Watch<'_>) -> Done;

    /// Calls a person; whether anybody comes is another matter.
    ///
    /// # Errors
    /// It was told to stop, or failed.
    fn call(&mut self, person: &str, watch: &mut Watch<'_>) -> Done;

    /// Turns round once, so that everything about has been looked at.
    ///
    /// # Errors
    /// It was told to stop, or failed.
    fn look_round(&mut self, watch: &mut Watch<'_>) -> Done;

    /// Where a thing is that stands in view of here, whichever way the vehicle faces; `None` when it is hidden.
    ///
    /// # Errors
    /// The vehicle failed.
    fn sees(&mut self, thing: ReplicaId) -> Result<Option<Sighting>, Failure>;

    /// What there is to see of a thing from here; `None` when it is out of sight.
    ///
    /// # Errors
    /// The vehicle failed.
    fn look_at(&mut self, what: Obstruction) -> Result<Option<Sighting>, Failure>;
}
