//! The openings of a Map by which its floor leads on, and those of each Area.

use std::cmp::Ordering;
use std::sync::Arc;

use crate::units::{AreaId, InOrder as _, MapId};

use super::opening::Opening;
use super::openings::Openings;

/// The openings of a Map.
#[derive(Debug)]
pub(super) struct Doorways {
    /// Those that a floor leads through, in the order of their places.
    pub(super) ways: Vec<Arc<Opening>>,
    /// The others.
    pub(super) blind: Vec<Arc<Opening>>,
    /// For each Area its doorways, and which of their two sides it is.
    pub(super) by_area: ByArea,
}

impl Doorways {
    pub(super) fn of(openings: &Openings, map: MapId) -> Self {
        let own = openings.placed().map(|(_, opening)| opening).filter(|o| o.map == map).cloned();
        let (mut ways, blind): (Vec<_>, Vec<_>) = own.partition(|opening| opening.is_way());
        ways.order_by(|one, other| by_place(one, other));
        let by_area = ByArea::of_ways(&ways);
        Self { ways, blind, by_area }
    }

    /// For each of these doorways the number of that between the same sides among others. Both lists are in the order of
    /// their places, and one that both share is met in both at once.
    pub(super) fn places_in(&self, others: &Self) -> Vec<Option<usize>> {
        if std::ptr::eq(self, others) {
            return (0..self.ways.len()).map(Some).collect();
        }
        let mut rest = others.ways.iter().enumerate().peekable();
        let place = |doorway: &Arc<Opening>| loop {
            let (number, other) = rest.peek()?;
            let order = if Arc::ptr_eq(other, doorway) {
                Ordering::Equal
            } else {
                by_place(other, doorway)
            };
            match order {
                Ordering::Less => drop(rest.next()),
                Ordering::Equal => return Some(*number),
                Ordering::Greater => return None,
            }
        };
        self.ways.iter().map(place).collect()
    }
}

fn by_place(one: &Opening, other: &Opening) -> Ordering {
    let areas = one.areas.cmp(&other.areas);
    areas.then_with(|| {
        let sides = other.sides.iter().map(|side| &side.side);
        one.sides.iter().map(|side| &side.side).cmp(sides)
    })
}

/// The doorways of every Area, by their numbers, each with which of the two sides the Area is.
#[derive(Debug)]
pub(super) struct ByArea {
    /// Sorted; one for each of `ends`.
    areas: Vec<AreaId>,
    ends: Vec<(usize, usize)>,
}

impl ByArea {
    fn of_ways(ways: &[Arc<Opening>]) -> Self {
        let ends = ways
            .iter()
            .enumerate()
            .flat_map(|(number, doorway)| [0, 1].map(|side| (doorway.areas[side], (number, side))));
        let mut ends: Vec<_> = ends.collect();
        ends.sort_unstable();
        let (areas, ends) = ends.into_iter().unzip();
        Self { areas, ends }
    }

    /// The doorways of an Area.
    pub(super) fn of(&self, area: AreaId) -> &[(usize, usize)] {
        let from = self.areas.partition_point(|own| *own < area);
        let count = self.areas[from..].iter().take_while(|own| **own == area).count();
        &self.ends[from..from + count]
    }
}
