//! Dead zones: floor that the robot covers from no place where it fits, what stands around it, and how narrow it is.

use std::borrow::Cow;

use crate::map::Permeability;
use crate::units::AreaId;

use super::buckets::Buckets;
use super::doors::distance_within;
use super::grid::{Grid, Shapes};
use super::obstacle::{Blocker, Obstacle};
use super::storey::Side;
use super::{Bounds, Polygon, Region};

/// Floor that the robot cannot cover from any place where it fits.
#[derive(Debug, Clone, PartialEq)]
pub struct DeadZone {
    pub region: Region,
    /// What stands around it.
    pub owners: Vec<Blocker>,
    /// The narrowest gap between two of them that is too narrow for the robot, in cm.
    pub gap: Option<f64>,
}

/// The dead zones among pieces of floor that the robot does not cover.
pub(super) fn dead_zones(
    grid: &Grid,
    dead: &Shapes,
    area: AreaId,
    obstacles: &[Obstacle],
    sides: &[Side],
    reach: f64,
) -> Vec<DeadZone> {
    let walls = sides.iter().filter(|s| s.permeability != Permeability::Permeable).map(|s| {
        let blocker = Blocker::Wall { area, item: s.item, side: s.side };
        (blocker, Cow::Owned(Polygon::new(vec![s.start, s.end])))
    });
    let things: Vec<(Blocker, Cow<'_, Polygon>)> =
        obstacles.iter().map(|o| (o.blocker, Cow::Borrowed(&o.polygon))).chain(walls).collect();
    let boxes: Vec<Bounds> = things.iter().map(|(_, p)| p.bounds().grown(TOUCH)).collect();
    let buckets = Buckets::of(&boxes);
    let zone = |region: Region| {
        let at = region.outer.bounds();
        let mut found = Vec::new();
        buckets.meeting(&at, &mut found);
        found.retain(|&i| {
            boxes[i as usize].meets(&at)
                && distance_within(&things[i as usize].1, &region.outer, TOUCH).is_some()
        });
        let mut gap: Option<f64> = None;
        for (k, &i) in found.iter().enumerate() {
            let (a, p) = &things[i as usize];
            for &j in &found[k + 1..] {
                let (b, q) = &things[j as usize];
                let widest = gap.unwrap_or(2.0 * reach);
                if a == b || !boxes[i as usize].grown(widest).meets(&boxes[j as usize]) {
                    continue;
                }
                if let Some(d) = distance_within(p, q, widest)
                    && d > TOUCH
                    && d < widest
                {
                    gap = Some(d);
                }
            }
        }
        let mut owners: Vec<Blocker> = found.iter().map(|&i| things[i as usize].0).collect();
        owners.sort_unstable();
        owners.dedup();
        DeadZone { region, owners, gap }
    };
    // What rounding leaves along the walls is no zone.
    let rim = |r: &Region| {
        r.contours().flat_map(Polygon::edges).map(|(a, b)| (b - a).norm()).sum::<f64>()
    };
    let is_zone = |r: &Region| r.area() > 0.01 * rim(r).max(1.0);
    grid.regions(dead).into_iter().filter(is_zone).map(zone).collect()
}

/// Things within this distance of a zone stand around it, in cm.
const TOUCH: f64 = 0.05;
