//! Missions in worlds that differ from the map, in one program.

mod carried_off;
mod furniture;
mod leaves;
mod lifts;
mod missions;
mod push;
mod remembered;
mod search;
mod senses;
mod setting;
