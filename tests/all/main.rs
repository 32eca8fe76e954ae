//! One binary for the tests of whole capabilities.

mod store;
mod store_faults;
mod store_world;
