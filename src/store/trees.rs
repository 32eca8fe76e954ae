//! Where records stand on the disk by table and key: sled's trees.
//!
//! Readers read memory (see `memory`); sled keeps the same records for the next opening, and follows the journal
//! (see `behind`). What it forgets or breaks comes back from journal and snapshot. Its `flush` does not reach the disk on Linux (0.34.7 asks for `sync_file_range`), it panics on
//! broken pages, and it notices few flipped bits; so every call is guarded, every record bears a checksum of
//! its own, and the whole is compared with the journal's digests when the store is opened.
//!
//! **Invariant**: no other file names sled.

use std::collections::BTreeMap;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::time::Duration;

use super::cell::Bytes;
use super::error::{Result, StoreError};
use super::frame::{Digest, Digests, Op, decode_digests, encode_digests};
use super::tables::Table;

/// Old versions of records, by table, key and revision.
pub(crate) const HISTORY: u8 = 200;
/// The keys that each revision touched.
pub(crate) const CHANGES: u8 = 201;

/// Every key under which a replica ever stood, by its id: a replica that goes to another Area gets another key.
pub(crate) const REPLICAS: u8 = 202;

/// All trees of a store by their codes, with their names.
pub(crate) fn tree_names() -> impl Iterator<Item = (u8, &'static str)> {
    let tables = Table::ALL.iter().filter(|t| t.is_stored()).map(|t| (t.code(), t.name()));
    tables.chain([(HISTORY, "~history"), (CHANGES, "~changes"), (REPLICAS, "~replicas")])
}

/// The sequence number up to which frames were applied, and what the trees then hold.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub(crate) struct State {
    pub(crate) lsn: u64,
    pub(crate) digests: Digests,
}

impl State {
    /// The state after one more frame. An empty tree has no digest.
    pub(crate) fn advance(&mut self, lsn: u64, touched: Digests) {
        self.lsn = lsn;
        self.digests.extend(touched);
        self.digests.retain(|_, digest| *digest != Digest::default());
    }
}

/// Called with each key and value; returns whether to go on.
pub(crate) type Visit<'a> = dyn FnMut(&[u8], &[u8]) -> Result<bool> + 'a;

/// Sorted records in several trees.
pub(crate) trait Trees: Send + Sync {
    fn get(&self, tree: u8, key: &[u8]) -> Result<Option<Vec<u8>>>;
    /// Visits the records whose keys begin with `prefix`, in the order of their keys.
    fn scan(&self, tree: u8, prefix: &[u8], visit: &mut Visit) -> Result<()>;
    /// The last record of a tree whose key begins with `prefix` and is not beyond `limit`.
    fn last(&self, tree: u8, prefix: &[u8], limit: &[u8]) -> Result<Option<(Vec<u8>, Vec<u8>)>>;
    /// Applies the operations and notes the state, all or nothing.
    fn apply(&self, ops: Vec<Op>, state: &State) -> Result<()>;
    fn state(&self) -> Result<State>;
    fn flush(&self) -> Result<()>;
}

/// Counts and sums all records anew.
pub(crate) fn digests(trees: &dyn Trees) -> Result<Digests> {
    let mut all = Digests::new();
    for (tree, _) in tree_names() {
        let mut digest = Digest::default();
        trees.scan(tree, &[], &mut |key, value| {
            digest.add(key, value);
            Ok(true)
        })?;
        if digest != Digest::default() {
            all.insert(tree, digest);
        }
    }
    Ok(all)
}

/// sled's trees in a directory.
pub(crate) struct SledTrees {
    open: Option<Open>,
}

struct Open {
    trees: BTreeMap<u8, sled::Tree>,
    state: sled::Tree,
    db: sled::Db,
}

impl Drop for SledTrees {
    fn drop(&mut self) {
        // The last handle flushes, and flushing broken pages panics.
        let open = self.open.take();
        let _ = guarded(|| {
            drop(open);
            Ok(())
        });
    }
}

const STATE_KEY: &[u8] = b"state";
/// Beyond so many operations a transaction's own bookkeeping costs more than the work, and it writes in the
/// order of a hash table, which suits no B-tree.
const TRANSACTION_OPS: usize = 256;

/// Runs a call into sled, turning its panics into errors.
fn guarded<T>(call: impl FnOnce() -> std::result::Result<T, sled::Error>) -> Result<T> {
    match catch_unwind(AssertUnwindSafe(call)) {
        Ok(Ok(value)) => Ok(value),
        Ok(Err(error)) => Err(StoreError::Tables { what: error.to_string() }),
        Err(panic) => {
            let text = panic
                .downcast_ref::<String>()
                .map(String::as_str)
                .or_else(|| panic.downcast_ref::<&str>().copied());
            Err(StoreError::Tables { what: text.unwrap_or("сбой sled").to_owned() })
        }
    }
}

/// Waits for sled's lock a moment: the store's own is held, so whoever has sled's yet is a child of another thread
/// that shares the file from its fork until it runs.
fn open_patiently(config: &sled::Config) -> sled::Result<sled::Db> {
    const TRIES: u32 = 200;
    const PAUSE: Duration = Duration::from_millis(10);
    for _ in 0..TRIES {
        match config.open() {
            Err(sled::Error::Io(e)) if e.to_string().contains("could not acquire lock") => {
                std::thread::sleep(PAUSE);
            }
            opened => return opened,
        }
    }
    config.open()
}

impl SledTrees {
    pub(crate) fn open(dir: &Path) -> Result<Self> {
        guarded(|| {
            // No flushing in the background: the journal keeps what sled has yet in memory.
            let config =
                sled::Config::new().path(dir).cache_capacity(64 << 20).flush_every_ms(None);
            let db = open_patiently(&config)?;
            let trees = tree_names()
                .map(|(code, name)| Ok((code, db.open_tree(name)?)))
                .collect::<sled::Result<_>>()?;
            Ok(Self { open: Some(Open { trees, state: db.open_tree("~state")?, db }) })
        })
    }

    fn open_trees(&self) -> &Open {
        self.open.as_ref().expect("only dropping closes the trees")
    }

    fn tree(&self, tree: u8) -> Result<&sled::Tree> {
        self.open_trees().trees.get(&tree).ok_or_else(|| StoreError::Tables {
            what: format!("нет таблицы с номером {tree}"),
        })
    }
}

impl SledTrees {
    /// Many operations one after the other, the history first and the state last.
    ///
    /// A reader of an older revision finds in the history what it misses in the tables, as after a transaction;
    /// a crash midway leaves the old state, and opening applies the whole frame again.
    fn apply_in_order(&self, batches: &[(&sled::Tree, Vec<&Op>)], state: &[u8]) -> Result<()> {
        guarded(|| {
            for (tree, ops) in batches.iter().rev() {
                for op in ops {
                    match &op.value {
                        Some(value) => tree.insert(op.key.as_slice(), value.as_slice())?,
                        None => tree.remove(op.key.as_slice())?,
                    };
                }
            }
            self.open_trees().state.insert(STATE_KEY, state)?;
            Ok(())
        })
    }
}

fn encode_state(state: &State) -> Vec<u8> {
    let mut out = state.lsn.to_be_bytes().to_vec();
    encode_digests(&mut out, &state.digests);
    let crc = crc32fast::hash(&out);
    out.extend(crc.to_be_bytes());
    out
}

fn decode_state(bytes: &[u8]) -> Option<State> {
    let (body, crc) = bytes.split_last_chunk::<4>()?;
    if crc32fast::hash(body) != u32::from_be_bytes(*crc) {
        return None;
    }
    let mut bytes = Bytes(body);
    let lsn = u64::from_be_bytes(bytes.fixed()?);
    Some(State { lsn, digests: decode_digests(&mut bytes)? })
}

impl Trees for SledTrees {
    fn get(&self, tree: u8, key: &[u8]) -> Result<Option<Vec<u8>>> {
        let tree = self.tree(tree)?;
        guarded(|| Ok(tree.get(key)?.map(|value| value.to_vec())))
    }

    fn scan(&self, tree: u8, prefix: &[u8], visit: &mut Visit) -> Result<()> {
        let tree = self.tree(tree)?;
        guarded(|| {
            for record in tree.scan_prefix(prefix) {
                let (key, value) = record?;
                match visit(&key, &value) {
                    Ok(true) => {}
                    Ok(false) => break,
                    Err(error) => return Ok(Err(error)),
                }
            }
            Ok(Ok(()))
        })?
    }

    fn last(&self, tree: u8, prefix: &[u8], limit: &[u8]) -> Result<Option<(Vec<u8>, Vec<u8>)>> {
        let tree = self.tree(tree)?;
        guarded(|| match tree.range(prefix..=limit).next_back() {
            Some(record) => {
                let (key, value) = record?;
                Ok(Some((key.to_vec(), value.to_vec())))
            }
            None => Ok(None),
        })
    }

    fn apply(&self, ops: Vec<Op>, state: &State) -> Result<()> {
        use sled::transaction::{TransactionError, Transactional};

        let mut touched = BTreeMap::<u8, Vec<&Op>>::new();
        for op in &ops {
            touched.entry(op.tree).or_default().push(op);
        }
        let mut trees = touched.keys().map(|t| self.tree(*t)).collect::<Result<Vec<_>>>()?;
        let state = encode_state(state);
        if ops.len() > TRANSACTION_OPS {
            let batches: Vec<_> = trees.into_iter().zip(touched.into_values()).collect();
            return self.apply_in_order(&batches, &state);
        }
        trees.push(&self.open_trees().state);
        guarded(|| {
            let done = trees.as_slice().transaction(|trees| {
                let (last, trees) = trees.split_last().expect("the state's tree is always there");
                for (tree, ops) in trees.iter().zip(touched.values()) {
                    for op in ops {
                        match &op.value {
                            Some(value) => tree.insert(op.key.as_slice(), value.as_slice())?,
                            None => tree.remove(op.key.as_slice())?,
                        };
                    }
                }
                last.insert(STATE_KEY, state.as_slice())?;
                Ok(())
            });
            match done {
                Ok(()) => Ok(()),
                Err(TransactionError::Storage(error)) => Err(error),
                Err(TransactionError::Abort(())) => Ok(()),
            }
        })
    }

    fn state(&self) -> Result<State> {
        match guarded(|| self.open_trees().state.get(STATE_KEY))? {
            None => Ok(State::default()),
            Some(bytes) => decode_state(&bytes).ok_or_else(|| StoreError::Tables {
                what: "испорчена отметка о состоянии".into(),
            }),
        }
    }

    fn flush(&self) -> Result<()> {
        guarded(|| self.open_trees().db.flush().map(|_| ()))
    }
}
