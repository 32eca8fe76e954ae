//! Passframes as a surface of triangles: Wavefront OBJ, in metres in the Domain's frame, z upwards, faces upwards.
//!
//! A room is an object (`o`), a Passframe a group (`g`), called `STOREY/ROOM` and by its id. Passframes are convex, so
//! each is a fan of triangles about its middle (corners may lie on a straight border, where a neighbour's corner is); none
//! overlaps another, and together they are the free floor.

use std::fmt::Write as _;

use crate::geometry::FloorPlan;
use crate::map::World;
use crate::units::Frame;

use super::metre;

/// The Passframes of all floors that are given.
///
/// # Panics
/// When a plan is not of this world.
#[must_use]
pub fn to_passframe_mesh<'a>(world: &World, floors: impl Iterator<Item = &'a FloorPlan>) -> String {
    let mut text =
        String::from("# Passframes: the floor on which the robot can be. Metres, z upwards.\n");
    let mut corners = 0;
    for plan in floors {
        let map = &world.maps[&plan.map()];
        let placed = world.domain.maps.iter().find(|placed| placed.map == map.id);
        let frame = placed.map_or(Frame::IDENTITY, |placed| placed.frame);
        for fragment in plan.fragments() {
            let area = &world.areas[&fragment.area];
            // A floor lies where the Area stands in its Map.
            let raised = plan.scene().areas.get(&fragment.area).map_or(0.0, |a| a.frame.z.get());
            let z = metre(frame.z.get() + raised);
            put(&mut text, format_args!("o {}/{}\n", word(&map.key), word(&area.name)));
            for passframe in plan.passframes(fragment.area) {
                let ring = &passframe.polygon.corners;
                put(&mut text, format_args!("g {}\n", passframe.id));
                for corner in ring {
                    let at = frame.apply(*corner);
                    put(&mut text, format_args!("v {} {} {z}\n", metre(at.x), metre(at.y)));
                }
                let middle = frame.apply(passframe.polygon.centroid());
                put(&mut text, format_args!("v {} {} {z}\n", metre(middle.x), metre(middle.y)));
                let hub = corners + ring.len() + 1;
                for k in 0..ring.len() {
                    let [a, b] = [k, (k + 1) % ring.len()].map(|corner| corners + corner + 1);
                    put(&mut text, format_args!("f {hub} {a} {b}\n"));
                }
                corners += ring.len() + 1;
            }
        }
    }
    text
}

fn put(text: &mut String, line: std::fmt::Arguments<'_>) {
    text.write_fmt(line).expect("a string takes all");
}

/// A name without blanks, at which readers would end it.
fn word(name: &str) -> String {
    name.split_whitespace().collect::<Vec<_>>().join("_")
}
