//! Floors of whole buildings, followed and made anew, and ways that keep the law.

#[path = "../../map/tests/dice.rs"]
mod dice;
mod edited;
mod lawful;
