//! What a robot sees, as vectors: segments, models of things, and what of them does not depend on the observer (paper 3).
//!
//! A [`Segment`] is the paper's 1-simplex σ(p1, p2) with what is known of its two ends. Lengths are centimetres,
//! angles radians counter-clockwise from +x; nothing here knows a map.
//!
//! # Invariants
//!
//! All coordinates and covariances are finite. A segment's ends are never exchanged silently: [`Segment::reversed`]
//! exchanges points, ends and covariances together.

pub mod change;
mod contour;
pub mod costs;
mod equality;
pub mod identify;
mod invariants;
mod locate;
mod model;
mod motion;
mod observe;
pub mod read;
pub mod scan;
mod scene;
mod segment;
mod synthesis;

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
pub use scene::{
    Body, Change, Leaf, Node, Odometry, Owner, Part, Report, Scene, Thing, TreeNode, Writes,
};
pub use segment::{Covariance, Cut, End, Segment, Truth};
