//! Tests of whole capabilities, one module each.

mod floors;
mod routes;
