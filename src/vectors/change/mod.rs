//! What changed between two observations (SPEC V15-V18; paper 3, section 4, the differential mode).
//!
//! [`difference`] finds which segment is which, [`rigid_parts`] which of them moved as one, [`Differential`] keeps the
//! queue of the last N + 1 models and composes steps.

mod difference;
mod parts;

pub(crate) use difference::aligned;
pub use difference::{Difference, Differential, difference};
pub use parts::{RigidPart, rigid_parts};
