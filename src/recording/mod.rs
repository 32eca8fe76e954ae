//! What a mission does, as messages that the field's viewers draw by themselves: written to a file, read back from it.
//!
//! A [`Scribe`] makes [`Message`]s of what happens, in the schemas that Foxglove publishes and Lichtblick shares; a
//! [`Sink`] takes them: a [`Tape`] writes an MCAP file. [`Played`] is what such a file tells.
//!
//! # Invariants
//!
//! Lengths in messages are metres, angles radians or quaternions, as the schemas ask; times never go back. Each storey has
//! a frame of its own, called by its key, in the frame `building`; the robot is the frame `robot`. A message of what
//! stands about is whole, so that who begins to read anywhere needs only the last of each topic. A file that was cut off
//! is readable up to the last piece that was flushed, and a reader is told that it was cut.

use orthoframe_exchange as exchange;
use orthoframe_geometry as geometry;
use orthoframe_map as map;
use orthoframe_units as units;

orthoframe_units::messages!("../../rules/messages", "recording", RecordingError);

mod container;
mod error;
mod follower;
mod played;
mod scene;
mod schema;
mod scribe;
mod shapes;
mod tape;

pub use error::RecordingError;
pub use follower::{Followed, Follower};
pub use played::{Played, Told};
pub use schema::Schema;
pub use scribe::{Level, Scribe, Turn};
pub use tape::Tape;

/// Something that was told at a moment.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Message {
    pub topic: String,
    pub schema: Schema,
    /// Nanoseconds since 1970.
    pub time: u64,
    /// JSON of the schema.
    pub data: Vec<u8>,
}

/// Who takes messages.
pub trait Sink: std::fmt::Debug + Send {
    /// Takes messages, in order. `urgent` ones are to be out of the program when this returns.
    ///
    /// # Errors
    /// They cannot be kept.
    fn take(&mut self, messages: &[Message], urgent: bool) -> Result<(), RecordingError>;

    /// Takes no more.
    ///
    /// # Errors
    /// What was taken cannot be brought to its end.
    fn end(&mut self) -> Result<(), RecordingError>;
}
