//! What a laser sees of made buildings, held against them.

mod differences;
mod operative;
mod poses;
