//! Replicas by place: which things a box may meet, without looking at all of them.

use std::collections::HashMap;

use foldhash::fast::RandomState;

use crate::units::{Point, ReplicaId};

use super::Bounds;
use super::scene::{PlacedReplica, Scene};

/// What has no thickness is given some on the floor, in cm.
const MARGIN: f64 = 0.1;

/// Replicas by place.
#[derive(Debug, Clone, Default)]
pub(super) struct ReplicaIndex {
    cells: HashMap<(i32, i32), Vec<ReplicaId>, RandomState>,
    /// Those that are spread over too many cells to list in each.
    wide: Vec<ReplicaId>,
}

impl ReplicaIndex {
    const CELL: f64 = 300.0;

    pub(super) fn of(scene: &Scene) -> Self {
        let mut index = Self::default();
        scene.replicas.values().for_each(|replica| index.insert(replica));
        index
    }

    /// The cells that a replica is listed in; none for one that is spread over too many.
    fn cells_of(bounds: &Bounds) -> Option<impl Iterator<Item = (i32, i32)> + use<>> {
        let ((left, bottom), (right, top)) = Self::span(bounds);
        let is_wide =
            i64::from(right) - i64::from(left) > 30 || i64::from(top) - i64::from(bottom) > 30;
        (!is_wide).then(|| (left..=right).flat_map(move |x| (bottom..=top).map(move |y| (x, y))))
    }

    pub(super) fn insert(&mut self, replica: &PlacedReplica) {
        match Self::cells_of(&replica.reach().grown(MARGIN)) {
            Some(cells) => {
                cells.for_each(|cell| self.cells.entry(cell).or_default().push(replica.id));
            }
            None => self.wide.push(replica.id),
        }
    }

    pub(super) fn remove(&mut self, replica: &PlacedReplica) {
        let is_other = |id: &ReplicaId| *id != replica.id;
        match Self::cells_of(&replica.reach().grown(MARGIN)) {
            Some(cells) => {
                cells.for_each(|cell| self.cells.entry(cell).or_default().retain(is_other))
            }
            None => self.wide.retain(is_other),
        }
    }

    fn span(bounds: &Bounds) -> ((i32, i32), (i32, i32)) {
        let cell =
            |p: Point| ((p.x / Self::CELL).floor() as i32, (p.y / Self::CELL).floor() as i32);
        (cell(bounds.min), cell(bounds.max))
    }

    /// The replicas of its scene whose boxes come near `bounds`, in the order of their ids.
    pub(super) fn near(&self, scene: &Scene, bounds: &Bounds) -> Vec<ReplicaId> {
        let ((left, bottom), (right, top)) = Self::span(bounds);
        let cells =
            (i64::from(right) - i64::from(left) + 1) * (i64::from(top) - i64::from(bottom) + 1);
        let mut found: Vec<ReplicaId> = if cells > self.cells.len() as i64 {
            scene.replicas.keys().copied().collect()
        } else {
            (left..=right)
                .flat_map(|x| (bottom..=top).map(move |y| (x, y)))
                .filter_map(|cell| self.cells.get(&cell))
                .flatten()
                .chain(&self.wide)
                .copied()
                .collect()
        };
        found.sort_unstable();
        found.dedup();
        let meets = |r: &ReplicaId| {
            scene.replicas.get(r).is_some_and(|r| r.reach().grown(MARGIN).meets(bounds))
        };
        found.retain(meets);
        found
    }
}
