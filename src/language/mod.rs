//! Talk.
pub mod words;
pub use words::*;
