//! Integration tests: one binary, one file a capability.

mod architecture;
mod planning;
mod words;
