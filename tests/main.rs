//! Integration tests: one binary, one file a capability.

mod architecture;
mod floor_properties;
mod floors;
mod planning;
mod routes;
mod words;
