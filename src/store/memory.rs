//! The records in memory, sorted: what every reader reads.
//!
//! **Invariant**: no lock is held while a caller's code runs.

use std::collections::BTreeMap;
use std::ops::Bound;
use std::sync::{PoisonError, RwLock, RwLockReadGuard};

use super::error::Result;
use super::frame::{Digest, Digests, Op};
use super::trees::{Pair, Records, State, Trees, Visit};

type Tree = BTreeMap<Vec<u8>, Vec<u8>>;

struct Inner {
    /// By the tree's code.
    trees: Vec<Tree>,
    state: State,
}

/// Some records copied out, one after the other: whoever visits them may ask for others, which with the lock held
/// would wait for a writer that waits for the lock.
#[derive(Default)]
struct Piece {
    bytes: Vec<u8>,
    /// Where each key and its value end.
    ends: Vec<(usize, usize)>,
}

/// Records copied at once: a Fragment's, then as many as make the copying of the first ones forgotten.
const FIRST_PIECE: usize = 32;
const LATER_PIECE: usize = 1024;

impl Piece {
    fn take(&mut self, tree: &Tree, prefix: &[u8], from: Bound<&[u8]>, most: usize) {
        self.bytes.clear();
        self.ends.clear();
        let records = tree.range::<[u8], _>((from, Bound::Unbounded));
        for (key, value) in records.take_while(|(key, _)| key.starts_with(prefix)).take(most) {
            self.bytes.extend_from_slice(key);
            let key_end = self.bytes.len();
            self.bytes.extend_from_slice(value);
            self.ends.push((key_end, self.bytes.len()));
        }
    }

    fn records(&self) -> impl Iterator<Item = (&[u8], &[u8])> + '_ {
        let starts = std::iter::once(0).chain(self.ends.iter().map(|(_, end)| *end));
        starts.zip(&self.ends).map(|(start, &(key_end, end))| {
            (&self.bytes[start..key_end], &self.bytes[key_end..end])
        })
    }
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

impl Records for MemoryTrees {
    fn get(&self, tree: u8, key: &[u8]) -> Result<Option<Vec<u8>>> {
        Ok(self.read().trees[usize::from(tree)].get(key).cloned())
    }

    fn last(&self, tree: u8, prefix: &[u8], limit: &[u8]) -> Result<Option<Pair>> {
        let inner = self.read();
        let range = (Bound::Included(prefix), Bound::Included(limit));
        let last = inner.trees[usize::from(tree)].range::<[u8], _>(range).next_back();
        Ok(last.map(|(key, value)| (key.clone(), value.clone())))
    }
}

impl Trees for MemoryTrees {
    fn scan(&self, tree: u8, prefix: &[u8], visit: &mut Visit) -> Result<()> {
        let mut piece = Piece::default();
        let mut most = FIRST_PIECE;
        let mut after: Option<Vec<u8>> = None;
        loop {
            let from = match &after {
                None => Bound::Included(prefix),
                Some(key) => Bound::Excluded(key.as_slice()),
            };
            piece.take(&self.read().trees[usize::from(tree)], prefix, from, most);
            for (key, value) in piece.records() {
                if !visit(key, value)? {
                    return Ok(());
                }
            }
            if piece.ends.len() < most {
                return Ok(());
            }
            after = piece.records().last().map(|(key, _)| key.to_vec());
            most = LATER_PIECE;
        }
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
