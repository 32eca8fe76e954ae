mod facts;
mod facts_naive;
//! One binary for the tests of whole capabilities.

mod floor_properties;
mod floors;
mod routes;
mod store;
mod store_world;
//! Capabilities of the whole crate, one module each.

mod relations;
