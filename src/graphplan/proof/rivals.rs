//! Which actions exclude each other, as rows of bits that are found when first asked for.
//!
//! The backward search asks of every action that it tries whether one chosen before excludes it. Whoever needs, adds
//! or deletes a fact (if only for a moment) is kept as a row of bits; an action's rivals are the union of a few of them.

use super::graph::{ActionId, PlanningGraph};
use crate::bits;

/// More than this is not kept, and found anew each time.
const MOST_BYTES: usize = 1 << 26;

#[derive(Default)]
pub(crate) struct Rivals {
    words: usize,
    /// Per fact, the actions that need it, add it and delete it.
    needing: Vec<u64>,
    adding: Vec<u64>,
    deleting: Vec<u64>,
    /// Per level whose mutexes differ from those before, and per action.
    rows: Vec<Vec<Option<Box<[u64]>>>>,
    bytes: usize,
}

impl Rivals {
    pub(crate) fn bytes(&self) -> usize {
        self.bytes
    }

    /// The first of the others that excludes an action in the step that starts at `level`.
    pub(crate) fn first_of(
        &mut self,
        graph: &PlanningGraph,
        level: usize,
        action: ActionId,
        mut others: impl Iterator<Item = ActionId>,
    ) -> Option<usize> {
        match self.row(graph, level, action) {
            Some(row) => others.position(|other| bits::has(row, other.index())),
            None => others.position(|other| graph.is_mutex(level, action, other)),
        }
    }

    /// None where it would take too much memory.
    fn row(&mut self, graph: &PlanningGraph, level: usize, action: ActionId) -> Option<&[u64]> {
        let count = graph.actions.len();
        let level = level.min(graph.levels_of_mutexes() - 1);
        if self.words == 0 {
            self.words = bits::words(count);
            self.bytes = 3 * self.words * 8 * graph.fact_count();
            if self.bytes <= MOST_BYTES {
                self.note_users(graph);
            }
        }
        while self.rows.len() <= level {
            self.rows.push(vec![None; count]);
            self.bytes += count * size_of::<Option<Box<[u64]>>>();
        }
        if self.rows[level][action.index()].is_none() {
            if self.bytes > MOST_BYTES {
                return None;
            }
            self.bytes += self.words * 8;
            let row = self.found(graph, level, action);
            self.rows[level][action.index()] = Some(row);
        }
        self.rows[level][action.index()].as_deref()
    }

    fn note_users(&mut self, graph: &PlanningGraph) {
        let rows = || vec![0; self.words * graph.fact_count()];
        (self.needing, self.adding, self.deleting) = (rows(), rows(), rows());
        for (number, action) in graph.actions.iter().enumerate() {
            for (rows, facts) in [
                (&mut self.needing, &action.preconditions),
                (&mut self.adding, &action.add_effects),
                (&mut self.deleting, &action.takes),
            ] {
                for fact in facts {
                    bits::put(&mut rows[fact.index() * self.words..][..self.words], number);
                }
            }
        }
    }

    fn found(&self, graph: &PlanningGraph, level: usize, action: ActionId) -> Box<[u64]> {
        let mut row = vec![0; self.words].into_boxed_slice();
        let mut unite = |rows: &[u64], fact: usize| {
            bits::unite(&mut row, &rows[fact * self.words..][..self.words]);
        };
        let action = graph.action(action);
        // Competing needs.
        let mut excluded = vec![0; bits::words(graph.fact_count())];
        for &fact in &action.preconditions {
            graph.exclusive_with(level, fact).for_each(|f| bits::put(&mut excluded, f.index()));
        }
        // Interference and inconsistent effects, by the one and by the other.
        for fact in &action.takes {
            bits::put(&mut excluded, fact.index());
            unite(&self.adding, fact.index());
        }
        bits::members(&excluded).for_each(|fact| unite(&self.needing, fact));
        for fact in action.preconditions.iter().chain(&action.add_effects) {
            unite(&self.deleting, fact.index());
        }
        row
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Limits;
    use crate::samples::random_task;

    #[test]
    fn rows_say_the_same_as_the_graph() {
        for seed in 1..300 {
            let task = random_task(seed);
            let mut graph = PlanningGraph::new(&task);
            while graph.leveled_off_at().is_none() {
                graph.expand(None, &Limits::default()).unwrap();
            }
            let mut rivals = Rivals::default();
            let actions = || (0..graph.actions.len() as u32).map(ActionId);
            for level in 0..=graph.top() {
                for (a, b) in actions().flat_map(|a| actions().map(move |b| (a, b))) {
                    let said = rivals.first_of(&graph, level, a, [b].into_iter()).is_some();
                    assert_eq!(said, graph.is_mutex(level, a, b), "seed {seed}: {a:?}, {b:?}");
                }
            }
        }
    }
}
