//! The records in memory, sorted: what every reader reads.

use std::collections::BTreeMap;
use std::ops::Bound;
use std::sync::{PoisonError, RwLock, RwLockReadGuard};

use super::error::Result;
use super::frame::{Digest, Digests, Op};
use super::trees::{State, Trees, Visit};

type Tree = BTreeMap<Vec<u8>, Vec<u8>>;

struct Inner {
    /// By the tree's code.
    trees: Vec<Tree>,
    state: State,
}

/// Trees in memory.
pub(crate) struct MemoryTrees {
    inner: RwLock<Inner>,
}

impl Default for MemoryTrees {
    fn default() -> Self {
        let trees = std::iter::repeat_with(Tree::new).take(256).collect();
        Self { inner: RwLock::new(Inner { trees, state: State::default() }) }
    }
}

impl MemoryTrees {
    /// All records of other trees, with their count and sum.
    ///
    /// # Errors
    /// When they cannot be read.
    pub(crate) fn copy_of(from: &dyn Trees) -> Result<(Self, Digests)> {
        let mut digests = Digests::new();
        let mut trees: Vec<Tree> = std::iter::repeat_with(Tree::new).take(256).collect();
        for (code, _) in super::trees::tree_names() {
            let mut digest = Digest::default();
            let mut records = Vec::new();
            from.scan(code, &[], &mut |key, value| {
                digest.add(key, value);
                records.push((key.to_vec(), value.to_vec()));
                Ok(true)
            })?;
            if digest != Digest::default() {
                digests.insert(code, digest);
            }
            // They come in order, from which a tree is built without searching.
            trees[usize::from(code)] = records.into_iter().collect();
        }
        let state = from.state()?;
        Ok((Self { inner: RwLock::new(Inner { trees, state }) }, digests))
    }

    fn read(&self) -> RwLockReadGuard<'_, Inner> {
        self.inner.read().unwrap_or_else(PoisonError::into_inner)
    }

    /// The records under these keys as they stand, with the state to which they belong: operations that bring
    /// other trees to it.
    pub(crate) fn current(&self, mut keys: Vec<(u8, Vec<u8>)>) -> (Vec<Op>, State) {
        keys.sort_unstable();
        keys.dedup();
        let inner = self.read();
        let op = |(tree, key): (u8, Vec<u8>)| {
            let value = inner.trees[usize::from(tree)].get(&key).cloned();
            Op { tree, key, value }
        };
        (keys.into_iter().map(op).collect(), inner.state.clone())
    }

    /// Every key there is.
    pub(crate) fn keys(&self) -> Vec<(u8, Vec<u8>)> {
        let inner = self.read();
        let trees = (0..=u8::MAX).zip(&inner.trees);
        trees.flat_map(|(code, tree)| tree.keys().map(move |key| (code, key.clone()))).collect()
    }
}

impl Trees for MemoryTrees {
    fn get(&self, tree: u8, key: &[u8]) -> Result<Option<Vec<u8>>> {
        Ok(self.read().trees[usize::from(tree)].get(key).cloned())
    }

    fn scan(&self, tree: u8, prefix: &[u8], visit: &mut Visit) -> Result<()> {
        let inner = self.read();
        let from = (Bound::Included(prefix), Bound::Unbounded);
        for (key, value) in inner.trees[usize::from(tree)].range::<[u8], _>(from) {
            if !key.starts_with(prefix) || !visit(key, value)? {
                break;
            }
        }
        Ok(())
    }

    fn last(&self, tree: u8, prefix: &[u8], limit: &[u8]) -> Result<Option<(Vec<u8>, Vec<u8>)>> {
        let inner = self.read();
        let range = (Bound::Included(prefix), Bound::Included(limit));
        let last = inner.trees[usize::from(tree)].range::<[u8], _>(range).next_back();
        Ok(last.map(|(key, value)| (key.clone(), value.clone())))
    }

    fn apply(&self, ops: Vec<Op>, state: &State) -> Result<()> {
        let mut inner = self.inner.write().unwrap_or_else(PoisonError::into_inner);
        for Op { tree, key, value } in ops {
            let tree = &mut inner.trees[usize::from(tree)];
            match value {
                Some(value) => tree.insert(key, value),
                None => tree.remove(&key),
            };
        }
        inner.state = state.clone();
        Ok(())
    }

    fn state(&self) -> Result<State> {
        Ok(self.read().state.clone())
    }

    fn flush(&self) -> Result<()> {
        Ok(())
    }
}
