//! Road graphs of corridors (paper 4): from one entrance to another by what the robot sees, without coordinates.
//!
//! A [`CorridorSystem`] comes from a hand-written file or from a Map. Both of the paper's graphs are built from
//! it: [`SingleGraph`] has one vertex per entrance and junction, [`DoubleGraph`] two per entrance. They give the
//! same commands.
//!
//! ```
//! use orthoframe_corridor::{CorridorSystem, Variant, directions};
//! use orthoframe_units::Source;
//!
//! let text = include_str!("../../maps/corridor-paper4.toml");
//! let corridors = CorridorSystem::from_toml(&Source::new("corridor-paper4.toml", text)).unwrap();
//! // The robot stands at 202 (vertex 1), it came from 201 (vertex 0) and is to go to 208.
//! let way = directions(&corridors, "202", Some((0, 1)), "208", Variant::Single).unwrap();
//! let words: Vec<&str> = way.steps.iter().map(|s| s.ru.as_str()).collect();
//! assert_eq!(words, ["движение до соединения коридоров", "поворот направо", "движение до двери справа"]);
//! ```
//!
//! # Invariants
//!
//! Commands contain nothing that the robot cannot see; both variants give the same command stream, ties included.
//! A corridor file with any fault gives no system.

use orthoframe_geometry as geometry;
use orthoframe_map as map;
use orthoframe_units as units;

units::messages!("../../rules/messages", "corridor", CorridorError, CorridorFault);

mod arms;
mod command;
mod directions;
mod double;
mod error;
mod fault;
mod figure;
mod file;
mod floor;
mod lanes;
mod plan;
mod schema;
mod single;
mod system;
mod way;
mod weight;
mod words;

pub use command::Command;
pub use directions::{Directions, Step, Variant, directions};
pub use double::{Bearing, DoubleArc, DoubleArcKind, DoubleGraph};
pub use error::CorridorError;
pub use fault::{CorridorFault, CorridorFileError};
pub use figure::{Figure, FigureArc, FigureVertex, figure};
pub use lanes::Shape;
pub use schema::Place;
pub use single::{SingleArc, SingleGraph, TurnRow};
pub use system::{
    ArcCode, ArcIx, CorridorSystem, Entrance, Junction, JunctionKind, Measure, Port, Side, Stretch,
    Turn, Vertex, VertexIx, VertexKind, Weights,
};
pub use way::{Position, Way};
pub use weight::Cost;
