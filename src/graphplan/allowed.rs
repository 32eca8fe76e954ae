//! What a state allows, without a look at every operator.

use crate::bits;
use crate::strips::{FactId, OperatorId, Task};

/// The preconditions of all operators as a tree that forks where they differ, those shared by most at its root: what
/// rests on a fact that does not hold is passed over as a whole (M. Helmert, 2006, successor generators).
pub(crate) struct Allowed {
    /// In preorder.
    nodes: Vec<Node>,
    operators: Vec<OperatorId>,
    /// So many of the operators, the first ones, need nothing.
    always: u32,
    /// Nodes looked at so far.
    pub(crate) looked_at: u64,
}

struct Node {
    fact: FactId,
    /// The number of the node after all that rests on this one.
    after: u32,
    /// Operators before this one belong to this node or to one before it.
    operators_end: u32,
}

impl Allowed {
    pub(crate) fn new(task: &Task) -> Self {
        let mut sharing = vec![0_u32; task.facts.len()];
        for operator in &task.operators {
            operator.preconditions.iter().for_each(|fact| sharing[fact.index()] += 1);
        }
        let rank = |fact: &FactId| (u32::MAX - sharing[fact.index()], *fact);
        let mut rows: Vec<(Vec<(u32, FactId)>, OperatorId)> = (task.operator_ids())
            .map(|id| {
                let mut row: Vec<(u32, FactId)> =
                    task.operator(id).preconditions.iter().map(&rank).collect();
                row.sort_unstable();
                (row, id)
            })
            .collect();
        rows.sort_unstable();
        let mut tree = Self { nodes: Vec::new(), operators: Vec::new(), always: 0, looked_at: 0 };
        // The nodes that lead to the last row.
        let mut path: Vec<(usize, (u32, FactId))> = Vec::new();
        for (row, id) in rows {
            let pairs = path.iter().zip(&row);
            let shared = pairs.take_while(|((_, known), own)| known == *own).count();
            tree.end(path.drain(shared..));
            for &need in &row[shared..] {
                path.push((tree.nodes.len(), need));
                tree.nodes.push(Node {
                    fact: need.1,
                    after: 0,
                    operators_end: tree.operators.len() as u32,
                });
            }
            tree.operators.push(id);
            match path.last() {
                Some(&(node, _)) => tree.nodes[node].operators_end = tree.operators.len() as u32,
                None => tree.always = tree.operators.len() as u32,
            }
        }
        tree.end(path.drain(..));
        tree
    }

    /// Nothing more rests on these nodes.
    fn end(&mut self, nodes: impl Iterator<Item = (usize, (u32, FactId))>) {
        let after = self.nodes.len() as u32;
        nodes.for_each(|(node, _)| self.nodes[node].after = after);
    }

    /// Ascending.
    pub(crate) fn by(&mut self, state: &[u64]) -> Vec<OperatorId> {
        let mut allowed = self.operators[..self.always as usize].to_vec();
        let mut at = 0;
        while let Some(node) = self.nodes.get(at) {
            self.looked_at += 1;
            if !bits::has(state, node.fact.index()) {
                at = node.after as usize;
                continue;
            }
            let begin = if at == 0 { self.always } else { self.nodes[at - 1].operators_end };
            allowed.extend(&self.operators[begin as usize..node.operators_end as usize]);
            at += 1;
        }
        allowed.sort_unstable();
        allowed
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::portfolio::relaxed::{carry_out, holds, initial};
    use crate::samples::random_task;

    #[test]
    fn what_a_state_allows_is_what_a_look_at_every_operator_finds() {
        let mut count = 0;
        for seed in 1..=500 {
            let task = random_task(seed);
            let mut tree = Allowed::new(&task);
            let mut state = initial(&task);
            for step in 0..20 {
                let allows = |id: &OperatorId| {
                    task.operator(*id).preconditions.iter().all(|&fact| holds(&state, fact))
                };
                let expected: Vec<OperatorId> = task.operator_ids().filter(allows).collect();
                let found = tree.by(&state);
                assert_eq!(found, expected, "seed {seed}");
                count += found.len();
                let Some(&id) = found.get((seed as usize + step) % found.len().max(1)) else {
                    break;
                };
                carry_out(&task, &mut state, id);
            }
        }
        assert!(count > 10_000, "{count}");
    }
}
