//! What can be measured on a Map: prisms, distances, free floor, Passframes, routes, views.

pub mod contact;
mod polygon;
mod scene;

pub use polygon::{Bounds, Polygon, nearest_on_segment};
pub use scene::{Owner, PlacedArea, PlacedReplica, Prism, PrismSide, Scene};
