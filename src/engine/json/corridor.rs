//! Directions by counting entrances, as data.

use serde_json::{Value, json};

use crate::corridor::Directions;

/// A way through corridors, vertex by vertex and in words.
#[must_use]
pub(crate) fn directions(way: &Directions) -> Value {
    let steps: Vec<_> = way
        .steps
        .iter()
        .map(|s| json!({"command": s.command.key(), "ru": s.ru, "en": s.en}))
        .collect();
    json!({
        "outcome": "directions",
        "variant": way.variant.number(),
        "from": {"room": way.from_room, "vertex": way.from_vertex, "last": way.last.map(|(a, b)| [a, b])},
        "to": {"room": way.to_room, "vertex": way.to_vertex},
        "path": way.path,
        "cost": way.cost,
        "steps": steps,
        "ru": way.ru,
        "en": way.en,
        "arrived_by": way.arrived_by.map(|(a, b)| [a, b]),
    })
}
