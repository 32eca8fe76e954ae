//! Weights of arcs as whole numbers, so that sums do not depend on their order and ties are true ties.

use super::CorridorError;
use super::system::{CorridorSystem, Measure};

/// Ten-thousandths of an arc or of a metre.
pub type Cost = u64;

const UNITS: f64 = 10_000.0;

/// The cost of each arc, by its index.
///
/// No arc is free: two doors face to face still are two vertices, and a free arc could be driven for ever.
pub(super) fn arc_costs(system: &CorridorSystem) -> Result<Vec<Cost>, CorridorError> {
    let cost = |stretch: &super::system::Stretch| match (system.weights.measure, stretch.length) {
        (Measure::Arcs, _) => Ok(units(1.0)),
        (Measure::Metres, Some(length)) => Ok(units(length.get() / 100.0)),
        (Measure::Metres, None) => Err(CorridorError::NoLength {
            from: system.vertex(stretch.ends[0].vertex).number,
            to: system.vertex(stretch.ends[1].vertex).number,
        }),
    };
    let costs: Result<Vec<_>, _> = system.stretches().iter().map(cost).collect();
    Ok(costs?.into_iter().flat_map(|c| [c, c]).collect())
}

pub(super) fn u_turn_cost(system: &CorridorSystem) -> Cost {
    units(system.weights.u_turn)
}

/// A cost in arcs or metres again.
pub(super) fn in_people_units(cost: Cost) -> f64 {
    cost as f64 / UNITS
}

/// At least one unit; the cast saturates, and NaN becomes the least cost.
fn units(value: f64) -> Cost {
    ((value.min(1e9) * UNITS).round() as Cost).max(1)
}
