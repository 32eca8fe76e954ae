//! Furnished dwellings that simulators of household robots describe: ProcTHOR, AI2-THOR, VirtualHome, pyrobosim.
//!
//! They have in common that a thing is a box, that metres are their unit, and that a word says what the thing is;
//! [`shape`] makes Orthoframes of such a box. Readers judge nothing: what cannot be read is left out with a remark.

mod colour;
mod json;
mod plane;
mod procthor;
mod pyrobosim;
mod shape;
mod stacking;
mod stock;
mod thor;
mod virtualhome;

pub use procthor::{Assets, read_procthor};
pub use pyrobosim::read_pyrobosim;
pub use thor::read_thor;
pub use virtualhome::read_virtualhome;

use crate::units::Source;

/// The formats of this folder.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SceneFormat {
    ProcThor,
    Thor,
    VirtualHome,
    PyRoboSim,
}

impl SceneFormat {
    /// By the words that only this format has; none when the text has no such words.
    #[must_use]
    pub fn of(source: &Source) -> Option<Self> {
        let text = source.text();
        if text.trim_start_matches(['\u{FEFF}', ' ', '\t', '\r', '\n']).starts_with(['{', '[']) {
            let has = |field: &str| text.contains(&format!("\"{field}\""));
            return match () {
                () if has("floorPolygon") => Some(Self::ProcThor),
                () if has("axisAlignedBoundingBox") => Some(Self::Thor),
                () if has("nodes") && has("class_name") => Some(Self::VirtualHome),
                () => None,
            };
        }
        let has = |field: &str| text.lines().any(|line| line.trim_end() == field);
        let inhabited = ["hallways:", "locations:", "robots:", "metadata:"];
        let is_world =
            has("rooms:") && text.contains("footprint:") && inhabited.iter().any(|f| has(f));
        is_world.then_some(Self::PyRoboSim)
    }
}
