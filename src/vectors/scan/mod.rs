//! A scan of a range sensor as segments (SPEC V2).

mod adjust;
mod cast;
mod ends;
mod extract;
mod optimal;
mod refine;
mod run;
mod sensor;

pub use cast::{Struck, cast};
pub use extract::Extractor;
pub use sensor::{Noise, Sensor, SensorError};
