//! What the geometry of a Map means (paper 1 §5).

mod body;
mod grid;
mod measure;
mod names;
mod openings;
