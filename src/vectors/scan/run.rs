//! The returns of a scan, and the runs of them that are one straight line.

use nalgebra::Vector2;

use crate::line::Line;

/// One return.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Hit {
    pub(crate) p: Vector2<f64>,
    pub(crate) r: f64,
    pub(crate) beam: u32,
}

/// The points `from..to`, seen as one straight line.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Run {
    pub(crate) from: usize,
    pub(crate) to: usize,
    pub(crate) line: Line,
}
