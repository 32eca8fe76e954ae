//! Segments, models and what changed, generated and from logs, in one program.

mod change;
mod clutter;
mod hostile;
mod identification;
mod logs;
mod scans;
#[path = "../../../benches/vectors/shapes.rs"]
mod shapes;
