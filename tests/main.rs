//! Integration tests: one binary, one file a capability.

mod architecture;
mod floors;
mod maps;
mod planning;
mod routes;
mod words;
mod worlds;
