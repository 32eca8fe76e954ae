//! Every capability's tests, in one binary.

mod corridor;
mod corridor_lattice;
