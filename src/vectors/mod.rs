//! What a robot sees, as vectors: segments, models of things, and what of them does not depend on the observer (paper 3).
//!
//! A [`Segment`] is the paper's 1-simplex σ(p1, p2) with what is known of its two ends. Segments come of scans ([`scan`],
//! whose logs [`read`] reads), of pictures ([`picture`]) and of any [`polyline`]. Lengths are centimetres, angles radians
//! counter-clockwise from +x; nothing here knows a map.
//!
//! ```
//! use orthoframe_vectors::scan::{Extractor, Noise, Sensor};
//!
//! // Half a turn of a sensor that stands 2 m before a wall.
//! let sensor = Sensor::new(-1.5, 3.0 / 180.0, 181, (1.0, 1000.0), Noise::default())?;
//! let ranges: Vec<f64> = (0..181).map(|beam| 200.0 / sensor.bearing(beam).cos()).collect();
//! let mut extractor = Extractor::new();
//! let segments = extractor.segments(&sensor, &ranges);
//! assert_eq!(segments.len(), 1);
//! assert!(!segments[0].is_whole()); // both ends are out of reach
//! # Ok::<(), orthoframe_vectors::scan::SensorError>(())
//! ```
//!
//! # Invariants
//!
//! All coordinates and covariances are finite. A segment's ends are never exchanged silently: [`Segment::reversed`]
//! exchanges points, ends and covariances together.

orthoframe_units::messages!(
    "../../rules/messages",
    "vectors",
    picture::PictureError,
    read::LogFault,
    scan::SensorError
);

pub mod change;
mod contour;
pub mod costs;
mod equality;
pub mod identify;
mod invariants;
mod line;
mod locate;
mod model;
mod motion;
mod observe;
pub mod picture;
mod polyline;
pub mod read;
pub mod scan;
mod scene;
mod segment;
mod survey;
mod synthesis;
mod tip;

pub use change::{Difference, Differential, RigidPart, difference, rigid_parts};
pub use equality::{Equality, Match, Measure, Residual, radius, within};
pub use identify::{
    Counters, Identification, Index, Library, Options, Placement, Scale, Search, ThingId,
    exhaustive,
};
pub use invariants::{Pair, Ratio, Triple, Turn};
pub use model::{Membership, Model};
pub use motion::{Euclid, Motion, Space, Transition};
pub use observe::{Image, Loss, Observation, Observer, project};
pub use polyline::{Course, polyline};
pub use scene::{
    Body, Change, Leaf, Node, Odometry, Owner, Part, Report, Scene, Thing, TreeNode, Writes,
};
pub use segment::{Covariance, Cut, End, Segment, Truth};
pub use survey::{PoseNoise, Survey, survey};
