//! A scan of a range sensor as segments (SPEC V2).

mod cast;
mod ends;
mod extract;
mod line;
mod sensor;

pub use cast::{Struck, cast};
pub use extract::Extractor;
pub use sensor::{Noise, Sensor, SensorError};
