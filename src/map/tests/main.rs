//! Maps read, written, checked and edited whole.

mod dice;
mod doorway;
mod edits;
mod names;
mod news;
mod notations;
mod walls;
