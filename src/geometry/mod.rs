//! What can be measured on a Map: prisms, distances, free floor, Passframes, routes, views.
//!
//! A [`Scene`] brings every Orthoframe into its Map's frame. A [`FloorPlan`] makes of it, Fragment by Fragment,
//! the floor on which a given robot can drive ([`FragmentFloor`]), cut into [`Passframe`]s, and finds routes over
//! it. All floors keep to paper 1, sections 7 and 8; each file says where it goes further.
//!
//! ```
//! use orthoframe::geometry::{Polygon, Region};
//! use orthoframe::units::Point;
//!
//! let square = |low: f64, high: f64| {
//!     Polygon::new([(low, low), (high, low), (high, high), (low, high)].map(|(x, y)| Point::new(x, y)).to_vec())
//! };
//! let mut pillar = square(40.0, 60.0);
//! pillar.corners.reverse(); // a hole runs clockwise
//! let floor = Region { outer: square(0.0, 100.0), holes: vec![pillar] };
//! assert_eq!(floor.area(), 100.0 * 100.0 - 20.0 * 20.0);
//! assert!(!floor.contains(Point::new(50.0, 50.0), 0.0));
//! ```

mod blocked;
mod buckets;
mod chain;
pub mod contact;
mod coverage;
mod dead_zone;
mod digest;
mod doors;
mod edging;
mod faces;
mod floor;
mod goals;
mod grid;
mod half_edge;
mod kept;
mod leaf;
mod lift;
mod mesh;
mod mouth;
mod narrows;
mod network;
mod numbers;
mod obstacle;
mod offset;
mod on_demand;
mod passframe;
mod plan;
mod polygon;
mod remedy;
mod replica_index;
mod route;
mod scene;
mod search;
mod seen;
mod storey;
mod strait;
mod taut;
mod view;

pub use blocked::{Barrier, NoRoute};
pub use chain::Passed;
pub use dead_zone::Surroundings;
pub use doors::{Doorway, doorways};
pub use faces::{Face, FaceKind, Faces};
pub use floor::{FragmentFloor, SLACK};
pub use grid::Region;
pub use leaf::{LeafSpace, Leaves, Strike, clear_width, opening_of};
pub use lift::{LIFT_WAIT, Leg, NoWay, Ride, across};
pub use obstacle::{Blocker, Obstacle};
pub use passframe::{Beyond, Border, Passframe, PassframeId, PassframeKind};
pub use plan::{DoorStates, FloorPlan};
pub use polygon::{Bounds, Polygon, convex_hull, nearest_on_segment};
pub use remedy::Remedy;
pub use route::{Method, Moved, Route, Target};
pub use scene::{Owner, PlacedArea, PlacedReplica, Prism, PrismSide, Scene};
pub use seen::{Eye, FaceInView};
pub use view::{Beam, SeenFace, Sight, Visible};
