//! Sets of goals that are known to fail, with the level up to which they do.
//!
//! A set that cannot be reached by level `t` cannot be reached earlier either, and nor can any superset. The
//! store is a trie over sorted facts and answers "which stored set lies within this one, for this level?".

use std::collections::BTreeMap;

use crate::strips::FactId;

#[derive(Debug, Default)]
struct Node {
    children: BTreeMap<FactId, u32>,
    /// The level of the set that ends here; none ends here when zero levels are known to fail.
    level: Option<u32>,
    /// The highest level at or below this node.
    highest: u32,
}

/// The trie.
#[derive(Debug)]
pub(super) struct NoGoods {
    nodes: Vec<Node>,
}

impl NoGoods {
    pub(super) fn new() -> Self {
        Self { nodes: vec![Node::default()] }
    }

    pub(super) fn bytes(&self) -> usize {
        self.nodes.len() * (std::mem::size_of::<Node>() + 48)
    }

    /// Records that `facts`, sorted, cannot all hold at `level`.
    pub(super) fn insert(&mut self, facts: &[FactId], level: u32) {
        let mut at = 0;
        for &fact in facts {
            self.nodes[at].highest = self.nodes[at].highest.max(level);
            let next = self.nodes.len() as u32;
            let child = *self.nodes[at].children.entry(fact).or_insert(next);
            if child == next {
                self.nodes.push(Node::default());
            }
            at = child as usize;
        }
        let node = &mut self.nodes[at];
        node.highest = node.highest.max(level);
        node.level = node.level.max(Some(level));
    }

    /// A stored set within `facts`, sorted, that fails at `level`.
    pub(super) fn subset_of(&self, facts: &[FactId], level: u32) -> Option<Vec<FactId>> {
        let mut found = Vec::new();
        self.find(0, facts, level, &mut found).then_some(found)
    }

    fn find(&self, at: usize, facts: &[FactId], level: u32, found: &mut Vec<FactId>) -> bool {
        let node = &self.nodes[at];
        if node.highest < level {
            return false;
        }
        if node.level.is_some_and(|known| known >= level) {
            return true;
        }
        for (place, fact) in facts.iter().enumerate() {
            if let Some(&child) = node.children.get(fact) {
                found.push(*fact);
                if self.find(child as usize, &facts[place + 1..], level, found) {
                    return true;
                }
                found.pop();
            }
        }
        false
    }

    /// All sets that fail at exactly `level` and, as far as is known, not later.
    pub(super) fn exactly_at(&self, level: u32) -> Vec<Vec<FactId>> {
        let mut sets = Vec::new();
        self.collect(0, level, &mut Vec::new(), &mut sets);
        sets
    }

    fn collect(&self, at: usize, level: u32, path: &mut Vec<FactId>, sets: &mut Vec<Vec<FactId>>) {
        let node = &self.nodes[at];
        if node.highest < level {
            return;
        }
        if node.level == Some(level) {
            sets.push(path.clone());
        }
        for (&fact, &child) in &node.children {
            path.push(fact);
            self.collect(child as usize, level, path, sets);
            path.pop();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn facts(ids: &[u32]) -> Vec<FactId> {
        ids.iter().map(|&id| FactId(id)).collect()
    }

    #[test]
    fn a_set_fails_with_any_of_its_subsets_up_to_their_level() {
        let mut no_goods = NoGoods::new();
        no_goods.insert(&facts(&[1, 4]), 3);
        no_goods.insert(&facts(&[2, 5, 7]), 5);
        assert_eq!(no_goods.subset_of(&facts(&[0, 1, 2, 4]), 3), Some(facts(&[1, 4])));
        assert_eq!(no_goods.subset_of(&facts(&[0, 1, 2, 4]), 4), None);
        assert_eq!(no_goods.subset_of(&facts(&[1, 2, 5, 7]), 4), Some(facts(&[2, 5, 7])));
        assert_eq!(no_goods.exactly_at(3), [facts(&[1, 4])]);
        no_goods.insert(&facts(&[1, 4]), 5);
        assert_eq!(no_goods.exactly_at(3), Vec::<Vec<FactId>>::new());
    }
}
