//! What the geometry of a Map means (paper 1 §5).

mod body;
mod feed;
mod grid;
mod measure;
mod names;
mod openings;
pub mod planning;
mod position;
pub mod predicate;
mod relations;

pub use measure::{
    Below, Beside, Between, Change, Directed, Located, Measurements, Over, Pair, Reach, Single,
    Within,
};
pub use names::{Subject, Symbols};
pub use openings::{Opening, clear_width};
pub use position::{Nearness, Spot, Way, Whereabouts, whereabouts};
pub use relations::{
    Join, Profile, RelationCount, RelationError, RelationRules, Relations, STANDARD, derive,
    derive_from,
};
