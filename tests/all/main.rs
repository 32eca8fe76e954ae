//! Capabilities of the whole crate, one module each.

mod relations;
mod facts;
mod facts_naive;
