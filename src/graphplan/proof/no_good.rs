//! Sets of goals that are known to fail, with the level up to which they do.
//!
//! A set that cannot be reached by level `t` cannot be reached earlier either, and nor can any superset. The
//! store is a trie and answers "which stored set lies within this one, for this level?".
//!
//! Sets are kept up to the exchange of interchangeable objects ([`super::symmetry`]): a set becomes a sorted list
//! of tokens, one for each fact about no such object and one for each object with all that the set says of it.
//! Tokens of two objects of a class are the same when the set says the same of both.

use std::collections::{BTreeMap, HashMap};

use super::symmetry::Symmetry;
use crate::strips::FactId;

/// A fact, or what a set says of one object beyond a single fact.
type Token = u32;

#[derive(Debug, Default)]
struct Node {
    children: BTreeMap<Token, u32>,
    /// The level of the set that ends here, and the set as it was first met.
    set: Option<(u32, Box<[FactId]>)>,
    /// The highest level at or below this node.
    highest: u32,
}

/// The trie.
#[derive(Debug)]
pub(crate) struct NoGoods {
    nodes: Vec<Node>,
    symmetry: Symmetry,
    /// Tokens of objects of which a set says more than one thing.
    profiles: HashMap<Vec<FactId>, Token>,
    next_profile: Token,
    bytes: usize,
}

/// A token with the facts of the set that it stands for.
type Tokens = Vec<(Token, Vec<FactId>)>;

impl NoGoods {
    pub(crate) fn new(symmetry: Symmetry, fact_count: usize) -> Self {
        Self {
            nodes: vec![Node::default()],
            symmetry,
            profiles: HashMap::new(),
            next_profile: fact_count as Token,
            bytes: 0,
        }
    }

    pub(crate) fn bytes(&self) -> usize {
        self.nodes.len() * (std::mem::size_of::<Node>() + 64) + self.bytes
    }

    fn tokens(&mut self, facts: &[FactId]) -> Tokens {
        let mut tokens = Tokens::new();
        let mut by_object: BTreeMap<u32, Vec<FactId>> = BTreeMap::new();
        for &fact in facts {
            match self.symmetry.role(fact) {
                Some(role) => by_object.entry(role.object).or_default().push(fact),
                None => tokens.push((fact.0, vec![fact])),
            }
        }
        for facts in by_object.into_values() {
            let mut images: Vec<FactId> = facts
                .iter()
                .filter_map(|&fact| self.symmetry.role(fact))
                .map(|role| role.image)
                .collect();
            images.sort_unstable();
            let token = match images.as_slice() {
                [only] => only.0,
                _ => *self.profiles.entry(images).or_insert_with(|| {
                    self.next_profile += 1;
                    self.next_profile
                }),
            };
            tokens.push((token, facts));
        }
        tokens.sort_unstable();
        tokens
    }

    /// Records that `facts` cannot all hold at `level`.
    pub(crate) fn insert(&mut self, facts: &[FactId], level: u32) {
        let mut at = 0;
        for (token, _) in self.tokens(facts) {
            self.nodes[at].highest = self.nodes[at].highest.max(level);
            let next = self.nodes.len() as u32;
            let child = *self.nodes[at].children.entry(token).or_insert(next);
            if child == next {
                self.nodes.push(Node::default());
            }
            at = child as usize;
        }
        let node = &mut self.nodes[at];
        node.highest = node.highest.max(level);
        match &mut node.set {
            Some((known, _)) => *known = level.max(*known),
            None => {
                self.bytes += facts.len() * 4;
                node.set = Some((level, facts.into()));
            }
        }
    }

    /// Facts among `facts` that cannot all hold at `level`, sorted.
    pub(crate) fn subset_of(&mut self, facts: &[FactId], level: u32) -> Option<Vec<FactId>> {
        if self.nodes[0].highest < level {
            return None;
        }
        let tokens = self.tokens(facts);
        let mut found = Vec::new();
        self.find(0, &tokens, level, &mut found).then(|| {
            let mut facts: Vec<FactId> = found.into_iter().flatten().copied().collect();
            facts.sort_unstable();
            facts
        })
    }

    fn find<'t>(
        &self,
        at: usize,
        tokens: &'t [(Token, Vec<FactId>)],
        level: u32,
        found: &mut Vec<&'t [FactId]>,
    ) -> bool {
        let node = &self.nodes[at];
        if node.highest < level {
            return false;
        }
        if node.set.as_ref().is_some_and(|(known, _)| *known >= level) {
            return true;
        }
        let mut last = None;
        for (place, (token, facts)) in tokens.iter().enumerate() {
            // Of equal tokens the first serves as well as any.
            if last.replace(token) == Some(token) {
                continue;
            }
            if let Some(&child) = node.children.get(token) {
                found.push(facts);
                if self.find(child as usize, &tokens[place + 1..], level, found) {
                    return true;
                }
                found.pop();
            }
        }
        false
    }

    /// One of each kind of set that is known to fail, with the highest level at which it does.
    pub(crate) fn all(&self) -> impl Iterator<Item = (Vec<FactId>, u32)> {
        let sets = self.nodes.iter().filter_map(|node| node.set.as_ref());
        sets.map(|(level, facts)| (facts.to_vec(), *level))
    }

    /// One of each kind of set that fails at exactly `level` and, as far as is known, not later.
    pub(crate) fn exactly_at(&self, level: u32) -> Vec<Vec<FactId>> {
        let sets = self.nodes.iter().filter_map(|node| node.set.as_ref());
        sets.filter(|(known, _)| *known == level).map(|(_, facts)| facts.to_vec()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::Limits;
    use crate::strips::{Fact, Task};

    fn facts(ids: &[u32]) -> Vec<FactId> {
        ids.iter().map(|&id| FactId(id)).collect()
    }

    #[test]
    fn a_set_fails_with_any_of_its_subsets_up_to_their_level() {
        let task = Task {
            facts: (0..8)
                .map(|n| Fact {
                    predicate: format!("f{n}").into(),
                    args: Vec::new(),
                    negated: false,
                })
                .collect(),
            ..Task::default()
        };
        let mut no_goods = NoGoods::new(Symmetry::of(&task, &Limits::default()), 8);
        no_goods.insert(&facts(&[1, 4]), 3);
        no_goods.insert(&facts(&[2, 5, 7]), 5);
        assert_eq!(no_goods.subset_of(&facts(&[0, 1, 2, 4]), 3), Some(facts(&[1, 4])));
        assert_eq!(no_goods.subset_of(&facts(&[0, 1, 2, 4]), 4), None);
        assert_eq!(no_goods.subset_of(&facts(&[1, 2, 5, 7]), 4), Some(facts(&[2, 5, 7])));
        assert_eq!(no_goods.exactly_at(3), [facts(&[1, 4])]);
        no_goods.insert(&facts(&[1, 4]), 5);
        assert!(no_goods.exactly_at(3).is_empty());
    }

    #[test]
    fn a_set_fails_with_all_its_images() {
        // Facts 0, 2, 4 say "in the hall" of three balls, facts 1, 3, 5 "in the hand".
        let fact = |place: &str, ball: usize| Fact {
            predicate: place.into(),
            args: vec![format!("ball{ball}").into()],
            negated: false,
        };
        let task = Task {
            facts: (0..3).flat_map(|ball| [fact("hall", ball), fact("hand", ball)]).collect(),
            init: facts(&[0, 2, 4]),
            ..Task::default()
        };
        let mut no_goods = NoGoods::new(Symmetry::of(&task, &Limits::default()), 6);
        no_goods.insert(&facts(&[1, 3]), 2);
        assert_eq!(no_goods.subset_of(&facts(&[3, 5]), 2), Some(facts(&[3, 5])));
        assert_eq!(no_goods.subset_of(&facts(&[0, 3]), 2), None);
        no_goods.insert(&facts(&[0, 1]), 2);
        assert_eq!(no_goods.subset_of(&facts(&[2, 3]), 2), Some(facts(&[2, 3])));
    }
}
