//! orthoframe: an embedded knowledge base and logic engine for robots that work inside buildings.
//!
//! A building's rooms, doors and furniture, described once as a 2.5D map of *Orthoframes*, answer from then
//! on where things are, how to get there, and what to do to bring them; offline, in one process.
//! [`Engine`] is the front door:
//!
//! ```no_run
#![doc = include_str!("../examples/fetch.rs")]
//! ```
//!
//! What a program needs of it is told in full by this crate: [`engine`] does the work, and the values that it takes and
//! gives are named here; what only stands within one of them is read from it without a name. The folders below, each a
//! crate of the workspace, may change from one version to the next; the surface does not change unseen, for it stands in
//! `tests/golden/surface.txt`. `ARCHITECTURE.md` draws the folders.

#[cfg(feature = "cli")]
#[doc(hidden)]
pub mod cli;
#[cfg_attr(
    not(feature = "serve"),
    expect(dead_code, unused_imports, reason = "what only the faces use lies idle without them")
)]
pub mod engine;
#[cfg(feature = "serve")]
#[doc(hidden)]
pub mod serve;

pub use engine::{Dialogue, Engine, Error, State};

/// Lengths, angles, places, and the ids of all that an [`Entity`] is.
pub use orthoframe_units::{
    AreaId, Cm, Deg, DoorId, Frame, Language, MapId, PlaceId, Point, Pose, ReplicaId,
    Source as SourceText, Stop, ZoneId,
};

/// The map: what stands in a [`World`], and edits of it.
pub use orthoframe_map::{
    Area, Door, DoorKind, DoorState, DoorStatus, Edit, Edits, Entity, MapErrors, Place, Profile,
    Replica, World,
};

/// The pieces of the free floor, outlines and ways.
pub use orthoframe_geometry::{Passframe, Polygon, Route};

/// Relations, and the robot that a task is given to.
pub use orthoframe_robot::{Simulator, Vehicle};
pub use orthoframe_semantics::Relations;

/// What moves the robot: a simulator, what speaks the protocol of docs/vehicle.md, or a type of one's own.
///
/// ```no_run
/// use orthoframe::vehicle::{Address, Patience};
/// use orthoframe::{Engine, Stop};
///
/// let engine = Engine::open("store".as_ref(), None)?;
/// let address: Address = "tcp:127.0.0.1:4242".parse().expect("it is an address");
/// let mut robot = address.connect(engine.world()?, Patience::default())?;
/// let order = engine.understand("Bring the medicine")?;
/// let answer = engine.carry_out_with(&order, &mut robot, &mut |_| {}, &Stop::default())?;
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
pub mod vehicle {
    pub use orthoframe_geometry::Ride;
    pub use orthoframe_robot::protocol::Scan;
    pub use orthoframe_robot::{
        Address, Bump, Failure, Gathered, Moment, Notice, Obstruction, Outlines, Patience, Refusal,
        RemoteVehicle, Sighting, Unfinished, Watch,
    };
}

/// What a robot sees: the segments of [`engine::View`].
pub use orthoframe_vectors::Segment;

use orthoframe_corridor as corridor;
use orthoframe_draw as draw;
use orthoframe_exchange as exchange;
use orthoframe_facts as facts;
use orthoframe_geometry as geometry;
use orthoframe_graphplan as graphplan;
use orthoframe_language as language;
use orthoframe_map as map;
use orthoframe_meaning as meaning;
#[cfg(feature = "recordings")]
use orthoframe_recording as recording;
use orthoframe_robot as robot;
use orthoframe_semantics as semantics;
use orthoframe_sensing as sensing;
use orthoframe_store as store;
use orthoframe_strips as strips;
use orthoframe_units as units;
use orthoframe_vectors as vectors;

units::messages!(
    "../rules/messages",
    "engine" | "cli" | "serve",
    engine::RequestError,
    #[cfg(feature = "cli")]
    cli::ConfigError
);
