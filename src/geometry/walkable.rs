//! The cells of a plan as a search walks over them, without the branches that do not lead to its goal.

use super::cells::{CellKey, Cells, Edge};
use super::mesh::{NONE, Passage};
use super::network::Portal;
use super::plan::FloorPlan;

/// The cells of a plan as a search for one goal may use them.
pub(super) struct Walkable<'a> {
    plan: &'a FloorPlan,
    /// Fragments to stay in, sorted.
    within: &'a [u32],
    marks: &'a Marks,
}

/// A cell of a branch that leads to the goal or to a Fragment that may be passed: a way never enters the other
/// branches, since it would have to come back over the same border.
const LEADS: u32 = 1;
/// A cell that such a branch hangs on, or with a doorway that may be passed.
const FORKS: u32 = 2;

/// What a search is to know of cells, by their numbers in the whole plan. What one search has marked means nothing to
/// the next, so that nothing need be wiped.
#[derive(Debug, Default)]
pub(super) struct Marks {
    /// With each cell's marks the number of the search that they are of.
    cells: Vec<u32>,
    search: u32,
}

impl Marks {
    /// Forgets all marks, for a plan of so many cells.
    fn clear(&mut self, cells: u32) {
        self.search += 1;
        if self.search >= u32::MAX >> 2 {
            *self = Self { cells: Vec::new(), search: 1 };
        }
        if self.cells.len() < cells as usize {
            self.cells.resize(cells as usize, 0);
        }
    }

    fn of(&self, cell: u32) -> u32 {
        let found = self.cells[cell as usize];
        if found >> 2 == self.search { found & 3 } else { 0 }
    }

    /// Adds marks to a cell, and tells what it had.
    fn add(&mut self, cell: u32, marks: u32) -> u32 {
        let had = self.of(cell);
        self.cells[cell as usize] = self.search << 2 | had | marks;
        had
    }
}

impl<'a> Walkable<'a> {
    pub(super) fn toward(
        plan: &'a FloorPlan,
        within: &'a [u32],
        goal: CellKey,
        marks: &'a mut Marks,
    ) -> Self {
        let network = &plan.network;
        marks.clear(network.size());
        let mut lead_to = |(number, mut cell): CellKey, mut own: u32| {
            let cells = &plan.floor(number).cells;
            loop {
                let on = cells.trunk(cell);
                let is_branch = on != NONE;
                let had = marks
                    .add(network.number((number, cell)), own | if is_branch { LEADS } else { 0 });
                if !is_branch || had & LEADS != 0 {
                    return;
                }
                (cell, own) = (on, FORKS);
            }
        };
        lead_to(goal, 0);
        for portal in within.iter().flat_map(|&n| &network.portals[n as usize]) {
            if within.binary_search(&portal.to.0).is_ok() {
                lead_to(portal.from, FORKS);
            }
        }
        Self { plan, within, marks }
    }
}

/// A passage of a Fragment's cell as an edge.
fn over(fragment: u32, passage: &Passage) -> Edge {
    let &Passage { right, left, right_bends, left_bends, to } = passage;
    Edge { right, left, right_bends, left_bends, to: (fragment, to) }
}

impl Cells for Walkable<'_> {
    #[inline(always)]
    fn only_edge(&self, cell: CellKey, from: CellKey) -> Option<Edge> {
        let network = &self.plan.network;
        let [one, other] = self.plan.floor(cell.0).cells.passages(cell.1).0 else { return None };
        let is_back = |passage: &Passage| (cell.0, passage.to) == from;
        let on = match (is_back(one), is_back(other)) {
            (true, false) => other,
            (false, true) => one,
            _ => return None,
        };
        let forks = self.marks.of(network.number(cell)) & FORKS != 0;
        (!forks).then(|| over(cell.0, on))
    }

    #[inline(always)]
    fn edges(&self, cell: CellKey, from: Option<CellKey>, found: &mut Vec<Edge>) {
        let back = from.filter(|f| f.0 == cell.0).map_or(NONE, |f| f.1);
        let over = |passage: &Passage| over(cell.0, passage);
        let (through, branches) = self.plan.floor(cell.0).cells.passages(cell.1);
        for passage in through {
            if passage.to != back {
                found.push(over(passage));
            }
        }
        let network = &self.plan.network;
        if self.marks.of(network.number(cell)) & FORKS == 0 {
            return;
        }
        let leads = |to: u32| self.marks.of(network.number((cell.0, to))) & LEADS != 0;
        for passage in branches {
            if passage.to != back && leads(passage.to) {
                found.push(over(passage));
            }
        }
        for portal in network.portals_of(cell) {
            let Portal { right, left, to, .. } = *portal;
            if from != Some(to) && self.within.binary_search(&to.0).is_ok() {
                found.push(Edge { right, left, right_bends: true, left_bends: true, to });
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn marks_are_of_one_search_alone() {
        let mut marks = Marks::default();
        for search in [1, 2, (u32::MAX >> 2) - 1, 1] {
            marks.clear(8);
            assert_eq!(marks.search, search);
            assert!((0..8).all(|cell| marks.of(cell) == 0));
            assert_eq!(
                [marks.add(3, LEADS), marks.add(3, FORKS), marks.add(5, FORKS)],
                [0, LEADS, 0]
            );
            assert_eq!([3, 4, 5].map(|cell| marks.of(cell)), [LEADS | FORKS, 0, FORKS]);
            // As if many searches had gone by.
            marks.search = if search == 2 { (u32::MAX >> 2) - 2 } else { marks.search };
        }
    }
}
