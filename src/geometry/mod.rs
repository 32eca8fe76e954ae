//! What can be measured on a Map: prisms, distances, free floor, Passframes, routes, views.
//!
//! A [`Scene`] brings every Orthoframe into its Map's frame. A [`FloorPlan`] makes of it, Fragment by Fragment,
//! the floor on which a given robot can drive ([`FragmentFloor`]), cut into [`Passframe`]s, and finds routes over
//! it. All floors keep to paper 1, sections 7 and 8; each file says where it goes further.
//!
//! ```
//! use orthoframe_geometry::{Polygon, Region};
//! use orthoframe_units::Point;
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
//!
//! # Invariants
//!
//! - *Floor.* Passframes are convex, do not overlap, and are exactly the free floor; free floor and dead zones
//!   together are the floor. Fragments meet on their doorways' lines. Booleans, triangulation and convexity are
//!   decided on an integer grid, turned as the room's walls are, so that a room at an odd angle is cut into as
//!   few Passframes as a straight one; floating point only measures and searches. Nothing solid is lost where a
//!   Fragment's floor meets the mouths of its doorways: along a wall without thickness a slit is cut
//!   (`geometry/mouth.rs`). An id of a Passframe is a hash of its own place; those that meet all take further
//!   hashes of their places, so that no order decides.
//! - *What is kept.* A Fragment keeps its cells and the outlines of dead zones and bare floor, all on its grid;
//!   its obstacles are kept as bytes. What borders a Passframe, what stands around a dead zone, and the
//!   outlines of free floor and centre space are found when they are asked for. What the store keeps of floors
//!   is taken up Fragment by Fragment, under a digest of all that each was made from.
//! - *Changes.* A change rebuilds only the Fragments that it can touch, with the same result as building anew.
//!   An obstacle lies, by its box, on the Fragment's floor or in the mouth of an open doorway: a change behind
//!   a wall rebuilds nothing. Fragments are built by several threads, with the same result as by one.
//! - *Routes.* Every point of a route is centre space: radius and clearance from everything; where a gap is
//!   narrowest, centre space is exactly as wide as the gap leaves it. The default route is found by Polyanya
//!   over a convex partition of centre space, in two levels: Fragments, and doorways between them; no root
//!   looks twice through the same stretch of an edge, so every search ends; ways bend where the border turns
//!   inwards, and at the ends of doorways' lines, beyond which it may. That there is none is asked of the cells
//!   alone, not of sight lines (`geometry/taut.rs`). A way to an Area ends in that Area or is none. A third
//!   level leads from Map to Map by lift, whose doors open where it is called. What a route passes is asked for
//!   beside the route (`FloorPlan::passed`).
//! - *Doors.* How a door opens is known in `geometry/leaf.rs` alone: leaf poses, what they pass over, the width
//!   they leave, what they strike.
//! - *No way.* What parts two pieces of centre space is measured (`geometry/narrows.rs`): the shortest lines
//!   between solids cut the floor into basins, and the gap that is told is the narrowest on the widest way,
//!   over pockets too. What is said to open a way has been tried, and no shorter push of any one thing opens
//!   it.
//! - *Views.* What is seen in space is exact: from each face the shadows of all that lies before it are taken
//!   by one boolean operation (`geometry/seen.rs`); a scan (`geometry/view.rs`) is at one height.
//! - *Robots with a convex footprint* turn only where the disc fits that the footprint sweeps about its turning
//!   point; between two such pieces of floor they pass *straits*, single straight legs along their own heading
//!   (`geometry/strait.rs`), each checked against the things themselves; through several doorways, where the
//!   Fragment between them has no place to turn. The footprint is taken as it lies about its turning point, so
//!   there and back a strait has a line of its own, and it is none where one of them is missing. Deliberately
//!   absent: turning, bending or backing within a strait, so a corner too narrow for the covering disc is no
//!   way; goals and starts in a strait are moved to where the robot may turn.
//! - *Their free floor* is larger than the disc's: dead is what the footprint, with its clearance, covers at no
//!   place and no heading, whether it can drive there or not (`geometry/coverage.rs`: for each of many headings
//!   the floor's morphological opening by the turned footprint, only about the disc's dead zones). What is
//!   covered is evened by 4 % of the radius, and the mouths of gaps, up to 14 % deep, count as dead. It is made
//!   when it is asked for, and has Passframes (`FragmentFloor::with_footprint`), which the paper's method and
//!   the search do not use: they go by those of the disc, and by straits.

use orthoframe_map as map;
use orthoframe_units as units;

mod anchor;
mod apart;
mod blocked;
mod blocker;
mod borders;
mod buckets;
mod cells;
mod chain;
pub mod contact;
mod coverage;
mod dead_zone;
mod digest;
mod doorways;
mod edging;
mod edited;
mod eye;
mod faces;
mod floor;
mod goals;
mod grid;
mod half_edge;
mod kept;
mod kept_value;
mod lasting;
mod lawful;
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
mod opening;
mod openings;
mod passframe;
mod plan;
mod polygon;
mod remedy;
mod reopened;
mod replica_index;
mod route;
mod scene;
mod search;
mod seen;
mod site;
mod storey;
mod strait;
mod surroundings;
mod taut;
mod view;
mod walkable;
mod zone;

pub use anchor::Moved;
pub use blocked::{Barrier, NoRoute};
pub use blocker::{Blocker, Obstacle};
pub use chain::Passed;
pub use eye::Eye;
pub use faces::{Face, FaceKind, Faces};
pub use floor::FragmentFloor;
pub use grid::Region;
pub use lasting::{Foothold, LastingFloor};
pub use leaf::{LeafSpace, Leaves, Strike, clear_width, opening_of};
pub use lift::{LIFT_WAIT, Leg, NoWay, Ride, across};
pub use opening::{OpenSide, Opening};
pub use openings::{Openings, STEP_REACH, outward_normal};
pub use passframe::{Beyond, Border, Passframe, PassframeId, PassframeKind};
pub use plan::FloorPlan;
pub use polygon::{Bounds, Polygon, convex_hull, nearest_on_segment};
pub use remedy::Remedy;
pub use route::{Method, Route, Target};
pub use scene::{Owner, PlacedArea, PlacedReplica, Prism, PrismSide, Scene};
pub use seen::FaceInView;
pub use site::{DoorStates, SLACK};
pub use surroundings::Surroundings;
pub use view::{Beam, Front, SeenFace, Sight, Stretch, Visible, is_solid};
pub use zone::PlacedZone;
