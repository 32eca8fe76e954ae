//! What a laser sees, held against the Map: where the robot is, and what differs (paper 1, section 9; paper 3).
//!
//! A [`Chart`] is all that a laser can meet at its height: the Map's faces, or walls learned from a log whose poses are
//! known. [`Localiser::locate`] says of one scan, without a guess, where it can have been taken: [`Answer::Unique`] only
//! where no other place fits nearly as well. [`Tracker`] holds the scans of a way against the chart together until they
//! lead to one place, follows that by odometry from scan to scan, and notices when it fits no more.
//!
//! Lengths are centimetres, angles radians counter-clockwise from +x.
//!
//! # Invariants
//!
//! - *Nothing is passed over.* The search (`search`) goes through all poses of the raster by branch and bound: what it
//!   leaves out cannot fit better than what it keeps. A search that was cut off answers [`Unknown::TooMany`].
//! - *What the chart lacks at one place it may lack at another.* The search keeps every place that is worse than the
//!   best by no more than the best itself leaves unexplained. Along a way the likelihood of all beams decides among them;
//!   of one scan it puts them in order, and one is told alone only where it leads by the share explained as well.
//! - *Seen through a wall counts against.* A beam that is shorter than the Map has it may have met what the Map lacks; one
//!   that is longer has gone through what the Map has.

use orthoframe_geometry as geometry;
use orthoframe_map as map;
use orthoframe_units as units;
use orthoframe_vectors as vectors;

mod along;
mod chart;
mod differences;
mod discern;
mod frontier;
mod levels;
mod locate;
mod operative;
mod raster;
mod refine;
mod search;
mod threads;
mod track;

pub use chart::{Chart, Line};
pub use differences::{Differences, DoorSeen, Inspector, ThingLook, ThingSeen, Unmapped};
pub use discern::{Move, telling_move};
pub use locate::{Answer, Fit, Localiser, Options, Unknown};
pub use operative::{Bound, Operative};
pub use raster::{CellState, Raster};
pub use track::{Belief, Event, Tracker};
