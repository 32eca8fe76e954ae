//! Sets of goals that are known to fail, with the level up to which they do.
//!
//! A set that cannot be reached by level `t` cannot be reached earlier either, and nor can any superset. The
//! store is a trie and answers "which stored set lies within this one, for this level?".
//!
//! Sets are kept up to the exchange of interchangeable objects ([`super::symmetry`]): a set becomes a sorted list
//! of tokens, one for each fact about no such object and one for each object with all that the set says of it.
//! Tokens of two objects of a class are the same when the set says the same of both.

use std::collections::HashMap;
use std::ops::Range;

use super::symmetry::Symmetry;
use crate::strips::FactId;

/// A fact, or what a set says of one object beyond a single fact.
type Token = u32;

#[derive(Debug, Default)]
struct Node {
    /// By their tokens, in order.
    children: Vec<(Token, u32)>,
    /// The level of the set that ends here, and the set as it was first met.
    set: Option<(u32, Box<[FactId]>)>,
    /// The highest level at or below this node.
    highest: u32,
}

impl Node {
    fn child(&self, token: Token) -> Result<usize, usize> {
        self.children.binary_search_by_key(&token, |&(known, _)| known)
    }
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

/// A set as tokens in order, each with the facts that it stands for.
#[derive(Debug, Default)]
struct Tokens {
    tokens: Vec<(Token, Range<usize>)>,
    facts: Vec<FactId>,
}

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
        let object = |fact: &FactId| self.symmetry.role(*fact).map(|role| role.object);
        let mut facts = facts.to_vec();
        if facts.iter().any(|fact| object(fact).is_some()) {
            facts.sort_by_key(object);
        }
        let mut tokens = Vec::with_capacity(facts.len());
        let mut images: Vec<FactId> = Vec::new();
        let mut from = 0;
        while from < facts.len() {
            let about = object(&facts[from]);
            let same = facts[from..].iter().take_while(|fact| object(fact) == about).count();
            let to = if about.is_some() { from + same } else { from + 1 };
            images.clear();
            images.extend(
                facts[from..to]
                    .iter()
                    .map(|&fact| self.symmetry.role(fact).map_or(fact, |role| role.image)),
            );
            images.sort_unstable();
            let token = match images.as_slice() {
                [only] => only.0,
                several => match self.profiles.get(several) {
                    Some(&known) => known,
                    None => {
                        self.next_profile += 1;
                        self.profiles.insert(images.clone(), self.next_profile);
                        self.next_profile
                    }
                },
            };
            tokens.push((token, from..to));
            from = to;
        }
        tokens.sort_unstable_by(|(a, of_a), (b, of_b)| {
            a.cmp(b).then_with(|| facts[of_a.clone()].cmp(&facts[of_b.clone()]))
        });
        Tokens { tokens, facts }
    }

    /// Records that `facts` cannot all hold at `level`.
    pub(crate) fn insert(&mut self, facts: &[FactId], level: u32) {
        let mut at = 0;
        for (token, _) in self.tokens(facts).tokens {
            let next = self.nodes.len() as u32;
            let node = &mut self.nodes[at];
            node.highest = node.highest.max(level);
            at = match node.child(token) {
                Ok(place) => node.children[place].1 as usize,
                Err(place) => {
                    node.children.insert(place, (token, next));
                    self.nodes.push(Node::default());
                    next as usize
                }
            };
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
        let Tokens { tokens, facts } = self.tokens(facts);
        let mut found = Vec::new();
        self.find(0, &tokens, level, &mut found).then(|| {
            let mut facts: Vec<FactId> =
                found.into_iter().flat_map(|of: Range<usize>| &facts[of]).copied().collect();
            facts.sort_unstable();
            facts
        })
    }

    fn find(
        &self,
        at: usize,
        tokens: &[(Token, Range<usize>)],
        level: u32,
        found: &mut Vec<Range<usize>>,
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
            if let Ok(child) = node.child(*token) {
                found.push(facts.clone());
                let (_, child) = node.children[child];
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
