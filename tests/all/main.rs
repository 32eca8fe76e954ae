//! Capabilities of the whole crate, one module each.

mod relations;
