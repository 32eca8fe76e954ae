mod facts;
mod facts_naive;
//! One binary for the tests of whole capabilities.

mod store;
mod store_world;
