//! Relations of whole maps, and what plans and positions make of them.

mod building;
mod planning;
mod position;
