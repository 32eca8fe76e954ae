//! Where records stand on the disk by table and key: sled's trees.
//!
//! Readers read memory (see `memory`); sled keeps the same records for the next opening, and follows the journal
//! (see `behind`). What it forgets or breaks comes back from journal and snapshot. Its `flush` does not reach the disk
//! on Linux (0.34.7 asks for `sync_file_range`), it panics on broken pages, it hangs on a full disk, and it notices few
//! flipped bits; so every call goes through a [`Wall`], every record bears a checksum of its own, and the whole is
//! compared with the journal's digests when the store is opened.
//!
//! **Invariant**: no other file names sled.

use std::collections::{BTreeMap, BTreeSet};
use std::io;
use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicU64, Ordering};
use std::sync::{Mutex, MutexGuard, PoisonError};
use std::time::Duration;

use super::cell::Bytes;
use super::error::{Result, StoreError};
use super::frame::{Digest, Digests, Op, decode_digests, encode_digests};
use super::tables::Table;
use super::wall::{Fault, Pulse, Wall};
use crate::units::{said, word};

/// Old versions of records, by table, key and revision.
pub(crate) const HISTORY: u8 = 200;
/// The keys that each revision touched.
pub(crate) const CHANGES: u8 = 201;

/// Every key under which a replica ever stood, by its id: a replica that goes to another Area gets another key.
pub(crate) const REPLICAS: u8 = 202;

/// The runs in which the past is kept, by their order; see `past`.
pub(crate) const RUNS: u8 = 203;

/// All trees of a store by their codes, with their names.
pub(crate) fn tree_names() -> impl Iterator<Item = (u8, &'static str)> {
    let tables = Table::ALL.iter().filter(|t| t.is_stored()).map(|t| (t.code(), t.name()));
    tables.chain([
        (HISTORY, "~history"),
        (CHANGES, "~changes"),
        (REPLICAS, "~replicas"),
        (RUNS, "~runs"),
    ])
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

/// Key and value.
pub(crate) type Pair = (Vec<u8>, Vec<u8>);

/// Called with each key and value; returns whether to go on.
pub(crate) type Visit<'a> = dyn FnMut(&[u8], &[u8]) -> Result<bool> + 'a;

/// Sorted records in several trees.
pub(crate) trait Trees: Send + Sync {
    /// Visits the records whose keys begin with `prefix`, in the order of their keys.
    fn scan(&self, tree: u8, prefix: &[u8], visit: &mut Visit) -> Result<()>;
    /// Applies the operations and notes the state, all or nothing.
    fn apply(&self, ops: Vec<Op>, state: &State) -> Result<()>;
    fn state(&self) -> Result<State>;
    fn flush(&self) -> Result<()>;
}

/// Trees that readers read. sled is none: it is never asked for one record, and its way from the end backwards alone
/// holds a mebibyte of 0xFF in the program (0.34.7).
pub(crate) trait Records: Trees {
    fn get(&self, tree: u8, key: &[u8]) -> Result<Option<Vec<u8>>>;
    /// The last record of a tree whose key begins with `prefix` and is not beyond `limit`.
    fn last(&self, tree: u8, prefix: &[u8], limit: &[u8]) -> Result<Option<Pair>>;
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

/// sled's trees in a directory, behind a [`Wall`]: whatever sled does, a call ends.
pub(crate) struct SledTrees {
    dir: PathBuf,
    wall: Wall<Open>,
    /// Goes after sled.
    _scratch: Option<Scratch>,
}

struct Open {
    trees: BTreeMap<u8, sled::Tree>,
    state: sled::Tree,
    db: sled::Db,
}

const STATE_KEY: &[u8] = b"state";
/// Beyond so many operations a transaction's own bookkeeping costs more than the work, and it writes in the
/// order of a hash table, which suits no B-tree.
const TRANSACTION_OPS: usize = 256;
/// How long sled may show no progress: opening and closing, which show none, take some hundredths of a second.
const PATIENCE: Duration = Duration::from_secs(5);
/// Records that a scan hands over at once.
const PIECE: usize = 1024;

/// Directories in which a sled of this program was left behind, its lock held and perhaps still writing: none is
/// opened there again before the program ends.
static LEFT_BEHIND: Mutex<BTreeSet<PathBuf>> = Mutex::new(BTreeSet::new());

fn left_behind() -> MutexGuard<'static, BTreeSet<PathBuf>> {
    LEFT_BEHIND.lock().unwrap_or_else(PoisonError::into_inner)
}

impl From<sled::Error> for Fault {
    fn from(error: sled::Error) -> Self {
        // After a failed write sled's closing waits for a flush that never comes.
        let is_final = matches!(error, sled::Error::Io(_));
        Self { what: error.to_string().into(), is_final }
    }
}

impl From<Fault> for StoreError {
    fn from(fault: Fault) -> Self {
        Self::Tables { what: fault.what }
    }
}

/// Waits for sled's lock a moment: the store's own is held, so whoever has sled's yet is a child of another thread
/// that shares the file from its fork until it runs.
fn open_patiently(config: &sled::Config, pulse: &Pulse) -> sled::Result<sled::Db> {
    const TRIES: u32 = 200;
    const PAUSE: Duration = Duration::from_millis(10);
    for _ in 0..TRIES {
        match config.open() {
            Err(sled::Error::Io(e)) if e.to_string().contains("could not acquire lock") => {
                std::thread::sleep(PAUSE);
                pulse.beat();
            }
            opened => return opened,
        }
    }
    config.open()
}

impl SledTrees {
    /// # Errors
    /// [`StoreError::Tables`]: sled refused, panicked, or did not come back in time.
    pub(crate) fn open(dir: &Path) -> Result<Self> {
        Self::open_with(dir, None)
    }

    /// Opens a copy in the directory for temporary files, so that the trees themselves are not touched.
    ///
    /// # Errors
    /// As [`SledTrees::open`]; when there are no trees, or no room for the copy.
    pub(crate) fn open_copy(dir: &Path) -> Result<Self> {
        let failed = |e: io::Error| StoreError::Tables { what: e.to_string().into() };
        let scratch = Scratch::of(dir).map_err(failed)?;
        let copied = scratch.0.clone();
        Self::open_with(&copied, Some(scratch))
    }

    fn open_with(dir: &Path, scratch: Option<Scratch>) -> Result<Self> {
        // Before sled makes it, the directory has no canonical name.
        let _ = std::fs::create_dir_all(dir);
        let name = dir.canonicalize().unwrap_or_else(|_| dir.to_owned());
        if left_behind().contains(&name) {
            return Err(StoreError::Tables {
                what: word!("sled-is-left-alone-until-the-program").into(),
            });
        }
        let path = dir.to_owned();
        let raised = Wall::raise(PATIENCE, move |pulse| {
            // No flushing in the background: the journal keeps what sled has yet in memory.
            let config =
                sled::Config::new().path(path).cache_capacity(64 << 20).flush_every_ms(None);
            let db = open_patiently(&config, pulse)?;
            let mut trees = BTreeMap::new();
            for (code, name) in tree_names() {
                trees.insert(code, db.open_tree(name)?);
                pulse.beat();
            }
            Ok(Open { trees, state: db.open_tree("~state")?, db })
        });
        match raised {
            Ok(wall) => Ok(Self { dir: name, wall, _scratch: scratch }),
            Err(fault) => {
                if fault.is_final {
                    left_behind().insert(name);
                }
                Err(fault.into())
            }
        }
    }
}

impl Drop for SledTrees {
    fn drop(&mut self) {
        self.wall.close();
        if self.wall.is_abandoned() {
            left_behind().insert(self.dir.clone());
        }
    }
}

/// A copy of a directory, gone with this value.
struct Scratch(PathBuf);

impl Scratch {
    fn of(dir: &Path) -> io::Result<Self> {
        static NUMBER: AtomicU64 = AtomicU64::new(0);
        let number = NUMBER.fetch_add(1, Ordering::Relaxed);
        let name = format!("orthoframe-{}-{number}", std::process::id());
        let scratch = Self(std::env::temp_dir().join(name));
        std::fs::create_dir(&scratch.0)?;
        copy_dir(dir, &scratch.0)?;
        Ok(scratch)
    }
}

impl Drop for Scratch {
    fn drop(&mut self) {
        // What cannot be removed is the system's to clear away.
        let _ = std::fs::remove_dir_all(&self.0);
    }
}

/// Files and folders; sled has no others, and what is no file might never end.
fn copy_dir(from: &Path, to: &Path) -> io::Result<()> {
    for entry in std::fs::read_dir(from)? {
        let entry = entry?;
        let (kind, to) = (entry.file_type()?, to.join(entry.file_name()));
        if kind.is_dir() {
            std::fs::create_dir(&to)?;
            copy_dir(&entry.path(), &to)?;
        } else if kind.is_file() {
            std::fs::copy(entry.path(), to)?;
        }
    }
    Ok(())
}

impl Open {
    fn tree(&self, tree: u8) -> std::result::Result<&sled::Tree, Fault> {
        self.trees
            .get(&tree)
            .ok_or_else(|| Fault::new(said!("there-is-no-table-of-the-number", tree)))
    }

    /// Many operations one after the other, the history first and the state last.
    ///
    /// A reader of an older revision finds in the history what it misses in the tables, as after a transaction;
    /// a crash midway leaves the old state, and opening applies the whole frame again.
    fn apply_in_order(
        &self,
        batches: &[(&sled::Tree, Vec<&Op>)],
        state: &[u8],
        pulse: &Pulse,
    ) -> sled::Result<()> {
        for (tree, ops) in batches.iter().rev() {
            for op in ops {
                match &op.value {
                    Some(value) => tree.insert(op.key.as_slice(), value.as_slice())?,
                    None => tree.remove(op.key.as_slice())?,
                };
                pulse.beat();
            }
        }
        self.state.insert(STATE_KEY, state)?;
        Ok(())
    }

    fn apply(&self, ops: &[Op], state: &[u8], pulse: &Pulse) -> std::result::Result<(), Fault> {
        use sled::transaction::{TransactionError, Transactional};

        let mut touched = BTreeMap::<u8, Vec<&Op>>::new();
        for op in ops {
            touched.entry(op.tree).or_default().push(op);
        }
        let mut trees =
            touched.keys().map(|t| self.tree(*t)).collect::<std::result::Result<Vec<_>, _>>()?;
        if ops.len() > TRANSACTION_OPS {
            let batches: Vec<_> = trees.into_iter().zip(touched.into_values()).collect();
            return Ok(self.apply_in_order(&batches, state, pulse)?);
        }
        trees.push(&self.state);
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
            last.insert(STATE_KEY, state)?;
            Ok(())
        });
        match done {
            Ok(()) | Err(TransactionError::Abort(())) => Ok(()),
            Err(TransactionError::Storage(error)) => Err(error.into()),
        }
    }
}

pub(super) fn encode_state(state: &State) -> Vec<u8> {
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
    fn scan(&self, tree: u8, prefix: &[u8], visit: &mut Visit) -> Result<()> {
        let prefix = prefix.to_vec();
        let pieces = move |open: &Open, give: &mut dyn FnMut(Vec<Pair>) -> bool| {
            let mut piece = Vec::new();
            for record in open.tree(tree)?.scan_prefix(prefix) {
                let (key, value) = record?;
                piece.push((key.to_vec(), value.to_vec()));
                if piece.len() == PIECE && !give(std::mem::take(&mut piece)) {
                    return Ok(());
                }
            }
            give(piece);
            Ok(())
        };
        let mut visit_all = |piece: Vec<Pair>| {
            for (key, value) in &piece {
                if !visit(key, value)? {
                    return Ok(false);
                }
            }
            Ok(true)
        };
        self.wall.each(pieces, &mut visit_all)?
    }

    fn apply(&self, ops: Vec<Op>, state: &State) -> Result<()> {
        let state = encode_state(state);
        Ok(self.wall.ask(move |open, pulse| open.apply(&ops, &state, pulse))?)
    }

    fn state(&self) -> Result<State> {
        match self.wall.ask(|open, _| Ok(open.state.get(STATE_KEY)?))? {
            None => Ok(State::default()),
            Some(bytes) => decode_state(&bytes).ok_or_else(|| StoreError::Tables {
                what: said!("the-mark-of-the-state-is-broken"),
            }),
        }
    }

    fn flush(&self) -> Result<()> {
        Ok(self.wall.ask(|open, _| Ok(open.db.flush().map(|_| ())?))?)
    }
}
