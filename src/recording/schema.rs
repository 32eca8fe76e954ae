//! The schemas of messages: Foxglove's as they are published (`schemas/`, MIT), and one of this program's own.

use crate::units::{Carried, carried};

/// What a message says, and how.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Schema {
    FrameTransforms,
    Grid,
    LaserScan,
    Log,
    PoseInFrame,
    PosesInFrame,
    SceneUpdate,
    /// An object with its name in `event`: see docs/cli.md.
    Event,
}

impl Schema {
    /// As viewers know it.
    #[must_use]
    pub fn name(self) -> &'static str {
        match self {
            Self::FrameTransforms => "foxglove.FrameTransforms",
            Self::Grid => "foxglove.Grid",
            Self::LaserScan => "foxglove.LaserScan",
            Self::Log => "foxglove.Log",
            Self::PoseInFrame => "foxglove.PoseInFrame",
            Self::PosesInFrame => "foxglove.PosesInFrame",
            Self::SceneUpdate => "foxglove.SceneUpdate",
            Self::Event => "ortho.Event",
        }
    }

    /// JSON Schema.
    #[must_use]
    pub fn text(self) -> &'static str {
        macro_rules! text {
            ($path:literal) => {{
                static TEXT: Carried = carried!($path);
                *TEXT
            }};
        }
        match self {
            Self::FrameTransforms => text!("schemas/FrameTransforms.json"),
            Self::Grid => text!("schemas/Grid.json"),
            Self::LaserScan => text!("schemas/LaserScan.json"),
            Self::Log => text!("schemas/Log.json"),
            Self::PoseInFrame => text!("schemas/PoseInFrame.json"),
            Self::PosesInFrame => text!("schemas/PosesInFrame.json"),
            Self::SceneUpdate => text!("schemas/SceneUpdate.json"),
            Self::Event => text!("schemas/Event.json"),
        }
    }
}
