//! Integration tests: one binary, one file a capability.

mod architecture;
mod floors;
mod planning;
mod routes;
mod words;
