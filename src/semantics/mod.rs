//! What the geometry of a Map means: measurements, relations by rules, positions, initial facts of a plan (paper 1 §5).
//!
//! Rust measures, rules decide. [`Measurements`] holds integers – tenths of a millimetre, hundredths of a degree, per
//! mille – about each thing and each pair of things that are near; they become the input facts of a Datalog program,
//! `rules/relations.dl`, which says what they mean. Every threshold and every relation stands in that text, which is
//! read at run time: a user adds a relation without recompiling.
//!
//! **Invariant:** no threshold stands in code. Rules compare measurements with them; where code must – how far measuring
//! looks, what a way passes – it reads them from the rule text as [`Thresholds`].
//!
//! ```
//! use orthoframe_map::{Format, World};
//! use orthoframe_semantics::{Around, Profile, RelationRules, derive};
//! use orthoframe_units::Source;
//!
//! let map = Source::new("дом.toml", r#"
//! format = 1
//! [orthoframe]
//! floor = { name = "Пол", rect = [400, 300], height = 270 }
//! top = { name = "Плита", rect = [80, 60], height = 75 }
//! cup = { name = "Стакан", rect = [8, 8], height = 10 }
//! [object]
//! table = { name = "Стол", items = [{ id = "A", orthoframe = "top" }] }
//! cup = { name = "Чашка", items = [{ id = "A", orthoframe = "cup" }] }
//! [area.room]
//! name = "Комната"
//! items = [{ id = "A", orthoframe = "floor" }]
//! replicas = [
//!   { name = "Стол-1", object = "table", at = [100, 100] },
//!   { name = "Чашка-1", object = "cup", at = [120, 120, 75] },
//! ]
//! [map.flat]
//! name = "Квартира"
//! items = [{ area = "room" }]
//! "#);
//! let world = World::parse(&map, Format::Toml)?;
//! let relations = derive(&world, &RelationRules::standard(), Profile::Surveyed)?;
//!
//! assert!(relations.holds("ON_TOP_OF", &["Чашка-1", "Стол-1"]));
//! assert!(relations.holds("НАХОДИТСЯ_ВНУТРИ", &["Чашка-1", "Комната"]));
//! let proof = relations.why(&Around::new(&world), "ON_TOP_OF", &["чашка-1", "стол-1"])?.expect("it holds");
//! assert!(proof.steps.iter().any(|step| step.fact.name == "over")); // down to the measurement
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```
//!
//! # Invariants
//!
//! A relation is derived only through the rule text; how far is measured is read from that text too. RESTS_ON
//! gives a thing at most one support; RESTS_ON, ON_TOP_OF and INSIDE are acyclic; two things stand in at most one
//! of INSIDE, ON_TOP_OF, ABOVE, UNDER. Two different subjects never share a symbol. Measurements in facts are
//! integers; no relation depends on the Map's axes. What the store kept of relations is taken up only under the
//! same revision, rule text, profile and version of the crate; pairs are then measured when first asked for.

use orthoframe_facts as facts;
use orthoframe_geometry as geometry;
use orthoframe_map as map;
use orthoframe_units as units;

units::messages!(
    "../../rules/messages",
    "semantics",
    relations::RelationError,
    thresholds::ThresholdFault
);

mod ask;
mod asked;
mod body;
mod cargo;
mod claim;
mod english;
mod facing;
mod feed;
mod grid;
mod lifts;
pub mod load;
mod measure;
mod measured;
mod names;
mod openings;
pub mod planning;
mod position;
pub mod predicate;
mod relations;
mod thresholds;
mod told;

pub use crate::geometry::{OpenSide, Opening, Openings};
pub use crate::map::Profile;
pub use ask::Extent;
pub use asked::{Around, Listed, OnDemand, Rows, length, on_demand};
pub use cargo::{cargo, carried_to, shut_around};
pub use claim::{Claim, claim_bounds, claim_holds};
pub use facing::{Faced, faced};
pub use lifts::{Lift, lifts, storey_name};
pub use measure::{
    Below, Beside, Between, Change, Directed, Into, Located, Measurements, Over, Pair, Reach,
    Single, Within,
};
pub use measured::{MEASURED, Made, Measured, Order, measured_table};
pub use names::{Subject, Symbols};
pub use position::{Spot, Way, Whereabouts, whereabouts};
pub use relations::{
    Followed, Join, RelationCount, RelationError, RelationRules, Relations, STANDARD, derive,
    derive_from,
};
pub use thresholds::{KNOWN as THRESHOLDS, Known as Threshold, ThresholdFault, Thresholds, Unit};
pub use told::{Told, robot_eye, things_in_view};
