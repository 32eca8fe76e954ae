//! Tests of whole capabilities, one module each.

mod floor_properties;
mod floors;
mod routes;
