//! The schemas of messages: Foxglove's as they are published (`schemas/`, MIT), and one of this program's own.

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
        match self {
            Self::FrameTransforms => include_str!("schemas/FrameTransforms.json"),
            Self::Grid => include_str!("schemas/Grid.json"),
            Self::LaserScan => include_str!("schemas/LaserScan.json"),
            Self::Log => include_str!("schemas/Log.json"),
            Self::PoseInFrame => include_str!("schemas/PoseInFrame.json"),
            Self::PosesInFrame => include_str!("schemas/PosesInFrame.json"),
            Self::SceneUpdate => include_str!("schemas/SceneUpdate.json"),
            Self::Event => include_str!("schemas/Event.json"),
        }
    }
}
