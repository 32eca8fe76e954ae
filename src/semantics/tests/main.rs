//! Relations of whole maps, and what plans and positions make of them.

mod building;
#[path = "../../map/tests/dice.rs"]
mod dice;
mod planning;
mod position;
