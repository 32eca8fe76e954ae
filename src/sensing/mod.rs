//! Scans against the Map: where the robot is, and what there differs (SPEC L; paper 1, section 9; paper 3).
//!
//! [`faces_at`] tells what should stand at the height of a sensor; a [`Locator`] of such faces answers where a scan was
//! taken: [`Answer::Unique`], [`Answer::Ambiguous`] with every pose that fits, or [`Answer::Unknown`]. Lengths are
//! centimetres, angles radians counter-clockwise from +x; poses lead from the sensor's frame into the Map's.
//!
//! ```
//! use nalgebra::{Isometry2, Vector2};
//! use orthoframe_sensing::{Answer, Face, Locator};
//! use orthoframe_vectors::scan::{Noise, Sensor};
//!
//! // A room of six corners, no two of which look the same.
//! let corners = [(0.0, 0.0), (500.0, 0.0), (500.0, 300.0), (320.0, 300.0), (320.0, 420.0), (0.0, 420.0)];
//! let corner = |k: usize| Vector2::new(corners[k % 6].0, corners[k % 6].1);
//! let locator = Locator::new((0..6).map(|k| Face::plain(corner(k), corner(k + 1))).collect());
//!
//! let sensor = Sensor::new(-3.1, 0.0174, 357, (1.0, 3000.0), Noise::default())?;
//! let truth = Isometry2::new(Vector2::new(140.0, 180.0), 0.7);
//! let ranges = locator.expected(&sensor, &truth);
//! let Answer::Unique(fix) = locator.locate(&sensor, &ranges) else { panic!("it is the only such room") };
//! assert!((fix.pose.translation.vector - truth.translation.vector).norm() < 1.0);
//! # Ok::<(), orthoframe_vectors::scan::SensorError>(())
//! ```
//!
//! # Invariants
//!
//! Nothing is guessed: a pose is called unique only where no other that was found fits nearly as well. Nothing here
//! writes a Map or knows of words; what differs is a value, and what becomes of it is decided elsewhere.

mod corners;
mod differences;
mod expected;
mod faces;
mod field;
mod fit;
mod locate;
mod track;
mod view;
mod walls;

pub use differences::{Differences, DoorSeen, Seen, Unmapped};
pub use expected::Expected;
pub use faces::{Face, faces_at};
pub use fit::Fit;
pub use locate::{Answer, Fix, Locator};
pub use track::{Event, Tracker};
pub use walls::Walls;
