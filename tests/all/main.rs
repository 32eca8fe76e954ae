//! Capabilities of the whole crate, one module each.

mod facts;
mod facts_naive;
mod relations;
