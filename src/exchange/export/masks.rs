//! Zones as masks of Nav2's costmap filters: where the robot may not go, and how fast it may.
//!
//! Each mask is a picture with its YAML file for a map_server, in mode `raw`: a cell's grey is its value, 0..=100, which
//! no threshold bends; and a file of parameters for the servers of the mask and of its `CostmapFilterInfo`. In the
//! keep-out mask (filter type 0) 100 is forbidden. In the speed mask (type 2, absolute) the limit is value × `multiplier`
//! in m/s and 0 is no limit; limits are rounded down. A zone that is one way says nothing that a mask could.

use crate::geometry::FloorPlan;
use crate::map::{World, Zone, ZoneKind};
use crate::units::InOrder as _;

use super::grid::Grid;
use super::{GridFiles, metre};

/// The highest value of a cell.
const MOST: u8 = 100;

/// One mask of a floor.
#[derive(Debug, Clone, PartialEq)]
pub struct Mask {
    pub grid: GridFiles,
    /// Parameters of nav2_map_server's map server and costmap filter info server, YAML.
    pub params: String,
}

/// The keep-out mask and the speed mask of a floor, of the zones that are wanted; each only where there is such a zone.
/// None when they would have more than
/// [`MOST_CELLS`](super::MOST_CELLS) cells.
///
/// # Panics
/// When the plan is not of this world.
#[must_use]
pub fn to_masks(
    world: &World,
    plan: &FloorPlan,
    cell: f64,
    is_wanted: impl Fn(&Zone) -> bool,
) -> Option<Vec<Mask>> {
    let plan = plan.with_zones(world, is_wanted);
    let key = &world.maps[&plan.map()].key;
    let mut masks = Vec::new();
    let is_shut = |kind: ZoneKind| matches!(kind, ZoneKind::KeepOut | ZoneKind::Closed);
    if plan.zones().iter().any(|zone| is_shut(zone.kind)) {
        let mut grid = Grid::blank(&plan, cell, 0)?;
        for zone in plan.zones().iter().filter(|zone| is_shut(zone.kind)) {
            zone.polygons.iter().for_each(|polygon| grid.fill(polygon, MOST));
        }
        let name = format!("{key}-keepout");
        let params = params("keepout", &name, 0, 1.0);
        masks.push(Mask { grid: files(&grid, name), params });
    }
    let speed = |kind: ZoneKind| match kind {
        ZoneKind::Slow { speed } => Some(speed),
        _ => None,
    };
    let highest = plan.zones().iter().filter_map(|zone| speed(zone.kind)).reduce(f64::max);
    if let Some(highest) = highest {
        // cm/s that a step of value means: a whole number of them, so that common limits are exact.
        let step = (highest / f64::from(MOST)).ceil().max(1.0);
        let mut grid = Grid::blank(&plan, cell, 0)?;
        // The slowest counts where zones overlap.
        let mut zones: Vec<_> =
            plan.zones().iter().filter_map(|zone| Some((speed(zone.kind)?, zone))).collect();
        zones.order_by(|(a, _), (b, _)| b.total_cmp(a));
        for (speed, zone) in zones {
            let value = (speed / step).floor().clamp(1.0, f64::from(MOST)) as u8;
            zone.polygons.iter().for_each(|polygon| grid.fill(polygon, value));
        }
        let name = format!("{key}-speed");
        let params = params("speed", &name, 2, metre(step));
        masks.push(Mask { grid: files(&grid, name), params });
    }
    Some(masks)
}

fn files(grid: &Grid<u8>, name: String) -> GridFiles {
    GridFiles { yaml: grid.yaml(&name, "raw"), pgm: grid.to_pgm(|value| value), name }
}

fn params(kind: &str, name: &str, filter: u8, multiplier: f64) -> String {
    format!(
        "{kind}_filter_mask_server:
  ros__parameters:
    yaml_filename: \"{name}.yaml\"
    topic_name: \"/{kind}_filter_mask\"
    frame_id: \"map\"
{kind}_costmap_filter_info_server:
  ros__parameters:
    type: {filter}
    filter_info_topic: \"/{kind}_costmap_filter_info\"
    mask_topic: \"/{kind}_filter_mask\"
    base: 0.0
    multiplier: {multiplier:?}
"
    )
}
