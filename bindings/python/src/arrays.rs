//! Relations and floors as arrays: bytes with a shape, which numpy takes without copying (`orthoframe.arrays`).

use std::collections::HashMap;

use orthoframe::engine::Value;
use orthoframe::{MapId, Passframe, State};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::desk::Failure;

/// Numbers in little-endian order.
#[derive(Debug)]
pub(crate) struct Numbers {
    /// As numpy writes it.
    kind: &'static str,
    shape: Vec<usize>,
    bytes: Vec<u8>,
}

impl Numbers {
    fn whole(shape: Vec<usize>, all: &[i64]) -> Self {
        let bytes = all.iter().flat_map(|n| n.to_le_bytes()).collect();
        Self { kind: "<i8", shape, bytes }
    }

    fn real(shape: Vec<usize>, all: &[f64]) -> Self {
        let bytes = all.iter().flat_map(|n| n.to_le_bytes()).collect();
        Self { kind: "<f8", shape, bytes }
    }

    pub(crate) fn into_python<'py>(self, py: Python<'py>) -> PyResult<Bound<'py, PyAny>> {
        let array = py.import("orthoframe.arrays")?.getattr("Array")?;
        array.call1((PyBytes::new(py, &self.bytes), self.kind, self.shape))
    }
}

/// A relation: a row a fact. In a column of symbols a number is the place in `names`.
#[derive(Debug)]
pub(crate) struct Table {
    pub(crate) name: String,
    pub(crate) columns: Vec<String>,
    pub(crate) is_symbol: Vec<bool>,
    pub(crate) names: Vec<String>,
    pub(crate) rows: Numbers,
}

pub(crate) fn relation(
    state: &State,
    name: &str,
    language: orthoframe::Language,
) -> Result<Table, Failure> {
    let relations = state.relations()?;
    let tuples = relations.tuples(name)?;
    let called = relations.display_name(name, orthoframe::Language::Russian);
    let mut all = relations.derived().relations();
    let columns = all.find(|(_, info)| info.name == called);
    let columns: Vec<String> = columns
        .map(|(_, info)| info.columns.iter().map(|column| column.name.clone()).collect())
        .unwrap_or_default();
    let mut is_symbol = vec![false; columns.len()];
    let (mut names, mut places) = (Vec::new(), HashMap::new());
    let mut rows = Vec::with_capacity(tuples.len() * columns.len());
    for tuple in &tuples {
        for (value, is_symbol) in tuple.iter().zip(&mut is_symbol) {
            rows.push(match value {
                Value::Number(number) => *number,
                other => {
                    *is_symbol = true;
                    let text = match other {
                        Value::Symbol(symbol) => symbol.to_string(),
                        other => other.to_string(),
                    };
                    *places.entry(text).or_insert_with_key(|text| {
                        names.push(text.clone());
                        names.len() as i64 - 1
                    })
                }
            });
        }
    }
    let rows = Numbers::whole(vec![tuples.len(), columns.len()], &rows);
    Ok(Table { name: relations.display_name(name, language), columns, is_symbol, names, rows })
}

/// The free floor of a map, cut into convex Passframes.
#[derive(Debug)]
pub(crate) struct Floor {
    pub(crate) map: String,
    pub(crate) rooms: Vec<String>,
    /// Of each Passframe the place of its room in `rooms`.
    pub(crate) room: Numbers,
    /// The corners of Passframe `i` are `corners[offsets[i]:offsets[i + 1]]`, counter-clockwise, cm.
    pub(crate) offsets: Numbers,
    pub(crate) corners: Numbers,
    /// Pairs of Passframes of a room, from the one of which the robot can drive into the other.
    pub(crate) links: Numbers,
}

pub(crate) fn floor(state: &State, map: MapId) -> Result<Floor, Failure> {
    let world = state.world()?;
    let plan = state.floors()?.get(&map).ok_or_else(|| Failure::Value("no such map".into()))?;
    let (mut rooms, mut room) = (Vec::new(), Vec::new());
    let (mut offsets, mut corners, mut links) = (vec![0], Vec::new(), Vec::new());
    for fragment in plan.fragments() {
        let passframes = plan.passframes(fragment.area);
        let first = room.len() as i64;
        let place = |id| passframes.iter().position(|one: &Passframe| one.id == id);
        for (n, passframe) in passframes.iter().enumerate() {
            room.push(rooms.len() as i64);
            corners.extend(passframe.polygon.corners.iter().flat_map(|p| [p.x, p.y]));
            offsets.push(corners.len() as i64 / 2);
            let mut beyond: Vec<_> =
                passframe.neighbours().filter_map(|(id, _)| place(id)).collect();
            beyond.sort_unstable();
            beyond.dedup();
            links.extend(beyond.into_iter().flat_map(|m| [first + n as i64, first + m as i64]));
        }
        rooms.push(world.areas[&fragment.area].name.clone());
    }
    Ok(Floor {
        map: world.maps[&map].name.clone(),
        rooms,
        room: Numbers::whole(vec![room.len()], &room),
        offsets: Numbers::whole(vec![offsets.len()], &offsets),
        corners: Numbers::real(vec![corners.len() / 2, 2], &corners),
        links: Numbers::whole(vec![links.len() / 2, 2], &links),
    })
}
