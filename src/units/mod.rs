//! Lengths, angles, frames, ids, names, places in a text and the order of a few things: the words that every other folder
//! speaks.
//!
//! Lengths are centimetres, angles degrees counter-clockwise from +x (SPEC M1). Outside numbers are
//! checked once, where they become a [`Cm`] or a [`Deg`]; past that edge they are finite.
//!
//! ```
//! use orthoframe_units::{Deg, Frame, Point};
//!
//! let door = Frame::new(300.0, 0.0, 0.0, Deg::new(90.0).unwrap());
//! assert_eq!(door.apply(Point::new(10.0, 0.0)), Point::new(300.0, 10.0)); // exact, no 1e-15 left over
//! ```
//!
//! # Invariants
//!
//! A `Cm` and a `Deg` are finite. Rotations by multiples of 90° are exact. A line and column shown to a person
//! count characters.

extern crate self as orthoframe_units;

mod bilingual;
mod carried;
mod english;
mod file;
mod frame;
mod id;
mod language;
mod lengths;
mod name;
mod order;
mod quantity;
mod source;
mod stop;
mod time;
mod told;
mod words;

pub use bilingual::Bilingual;
#[cfg(feature = "packed")]
pub use carried::unpacked;
pub use carried::{Carried, carried};
pub use english::{English, EnglishGroup, InEnglish};
pub use file::{FileFault, is_input, read_file, read_text, write_file, write_file_with};
pub use frame::{Frame, Point, Pose, Vector};
pub use id::{
    AreaId, DomainId, DoorId, MapId, ObjectId, OpeningId, OrFrId, PlaceId, ReplicaId, TypeId,
    ZoneId,
};
pub use language::Language;
pub use lengths::Lengths;
pub use name::{capitalized, name_key, nearest_name};
pub use order::{Gather, InOrder};
pub use quantity::{Cm, Deg, QuantityError};
pub use source::{OwnText, Source};
pub use stop::Stop;
pub use time::{Timestamp, TimestampError};
pub use told::check::amiss_in;
pub use told::{Argument, Fault, Kind, Listed, Messages, Piece, Value, by_lines, here};

/// A fault of which the words stand in message files, see the trait.
pub use orthoframe_units_fault::Fault;

messages!("../../rules/messages", "units");
