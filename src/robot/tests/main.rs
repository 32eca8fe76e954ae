//! Missions in worlds that differ from the map, in one program.

mod carried_off;
mod furniture;
mod leaves;
mod missions;
mod search;
mod senses;
mod setting;
