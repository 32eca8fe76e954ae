//! The vault between two calls of its program: put down, so that other programs may write, and taken up again with what
//! those wrote.
//!
//! What was acknowledged elsewhere is read from the journal, frame by frame, as at an opening, and compared with the
//! digests; where the journal does not lead there, the store has to be opened anew. sled is closed when the vault is put
//! down for the first time, and stays so: opening and closing it takes longer than most calls. Before a snapshot makes
//! journal superfluous that sled lacks, it follows.
//!
//! **Invariant**: a vault that is put down holds no file that another program may need, and writes nothing.

use crate::units::said;
use std::collections::BTreeMap;
use std::path::PathBuf;

use super::super::error::{Result, StoreError, doing};
use super::super::frame::Op;
use super::super::head::{Head, Known, Mark, read_head};
use super::super::journal::{Journal, Log, journal_dir, keep_journal, numbered_files};
use super::super::trees::{RUNS, Records as _, Trees};
use super::{Shelf, Vault};

/// Where the journal ended when the vault was put down.
#[derive(Debug, Clone)]
pub(super) struct Left {
    path: PathBuf,
    length: u64,
}

/// What others wrote meanwhile.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Found {
    Nothing,
    /// It is known now.
    Frames,
    /// The journal does not lead there: the store has to be opened anew.
    Apart,
}

type Key = (u8, Vec<u8>);

impl Vault {
    /// Lets go of all that other programs need to write. Takes the snapshot that is due.
    pub(crate) fn put_down(&mut self, shelf: &mut dyn Shelf) {
        // In step with memory, and closed.
        let was_followed = self.behind.take().is_some();
        if self.read_only.is_some() {
            // Nothing more is written until the store is opened again.
            self.journal = None;
            return;
        }
        if !was_followed && self.journal_bytes >= self.checkpoint_at {
            self.bring_trees(shelf);
            self.checkpoint_if_due();
        }
        if let Some(Err(error)) = self.head.take().map(|head| head.sync()) {
            tracing::debug!(%error, "head is not on the disk yet");
        }
        if let Some(Journal { path, length, .. }) = self.journal.take() {
            self.left = Some(Left { path, length });
        }
    }

    /// As [`Vault::checkpoint`], also where sled was closed.
    pub(crate) fn checkpoint_with(&mut self, shelf: &mut dyn Shelf) -> Result<()> {
        self.check_writable()?;
        if self.behind.is_none() {
            self.bring_trees(shelf);
        }
        self.checkpoint()
    }

    fn bring_trees(&self, shelf: &mut dyn Shelf) {
        if let Err(error) = self.trees_follow(shelf) {
            tracing::warn!(%error, "sled misses what goes into a snapshot");
        }
    }

    /// Sled takes what was written while it was closed.
    fn trees_follow(&self, shelf: &mut dyn Shelf) -> Result<()> {
        let trees = shelf.open()?;
        let seen = trees.state()?.lsn;
        let log = Log::read_from(&*self.disk, &self.dir, seen + 1)?;
        if !log.reaches(seen, self.state.lsn) {
            let what = said!("the-tables-are-behind-the-journal");
            return Err(StoreError::Tables { what });
        }
        let frames = (seen + 1..=self.state.lsn).filter_map(|lsn| log.payload(lsn));
        let keys = frames.flat_map(|frame| frame.ops).map(|op| (op.tree, op.key));
        let (ops, state) = self.memory.current(keys.collect());
        trees.apply(ops, &state)?;
        trees.flush()
    }

    /// Whether others may write.
    pub(crate) fn is_put_down(&self) -> bool {
        self.left.is_some()
    }

    /// Takes over what others have acknowledged meanwhile, and leaves the store to them.
    pub(crate) fn follow(&mut self) -> Result<Found> {
        let known = read_head(&*self.disk, &self.dir)?;
        match known.mark() {
            None => Ok(Found::Nothing),
            Some(mark) if *mark == Mark::of(&self.state) => Ok(Found::Nothing),
            Some(mark) if mark.lsn <= self.state.lsn => Ok(Found::Apart),
            Some(mark) => {
                let log = Log::read_from(&*self.disk, &self.dir, self.state.lsn + 1)?;
                Ok(if self.replay(&log, mark.lsn, &known)? { Found::Frames } else { Found::Apart })
            }
        }
    }

    /// Goes on writing where the journal ends. The store must be this program's alone.
    pub(crate) fn take_up(&mut self) -> Result<Found> {
        let Some(left) = self.left.clone() else { return Ok(Found::Nothing) };
        let known = read_head(&*self.disk, &self.dir)?;
        let files = numbered_files(&*self.disk, &journal_dir(&self.dir), "journal")?;
        let Some((_, path)) = files.last() else { return Ok(Found::Apart) };
        let length = self.disk.reading(path).and_then(|file| file.length());
        let length = length.map_err(StoreError::io(doing::READ, path))?;
        let is_ours = *path == left.path && known.mark() == Some(&Mark::of(&self.state));
        if is_ours && length == left.length {
            self.go_on(&known, left)?;
            return Ok(Found::Nothing);
        }
        let log = Log::read_from(&*self.disk, &self.dir, self.state.lsn + 1)?;
        // What is not whole, a file without its head for one, is mended by an opening.
        let is_whole = log.end > 0 && log.end == length && log.fault.is_none();
        let last = log.last().max(known.lsn());
        if !is_whole || known.mark().is_none() || last < self.state.lsn {
            return Ok(Found::Apart);
        }
        keep_journal(&*self.disk, path)?;
        if !self.replay(&log, last, &known)? {
            return Ok(Found::Apart);
        }
        // A new file begins with a snapshot.
        let more = if *path == left.path { length.saturating_sub(left.length) } else { length };
        let before = if *path == left.path { self.journal_bytes } else { 0 };
        self.journal_bytes = before + more;
        self.go_on(&known, Left { path: path.clone(), length })?;
        Ok(Found::Frames)
    }

    fn go_on(&mut self, known: &Known, at: Left) -> Result<()> {
        let Left { path, length } = at;
        let file = self.disk.appender(&path).map_err(StoreError::io(doing::OPEN, &path))?;
        let head = Head::open(&*self.disk, &self.dir, known, &Mark::of(&self.state));
        self.head = head.inspect_err(|error| tracing::warn!(%error, "head is not written")).ok();
        self.journal = Some(Journal { file, path, length });
        self.left = None;
        Ok(())
    }

    /// Applies the frames up to `last`, all or none; whether they lead there from what is known here.
    fn replay(&mut self, log: &Log, last: u64, known: &Known) -> Result<bool> {
        if !log.reaches(self.state.lsn, last) {
            return Ok(false);
        }
        let mut state = self.state.clone();
        let mut counted = self.state.digests.clone();
        let mut after = BTreeMap::<Key, Option<Vec<u8>>>::new();
        for lsn in self.state.lsn + 1..=last {
            let Some(frame) = log.payload(lsn) else { return Ok(false) };
            state.advance(lsn, frame.digests);
            if known.mark().is_some_and(|mark| mark.lsn == lsn && *mark != Mark::of(&state)) {
                return Ok(false);
            }
            for op in frame.ops {
                // Which runs there are is found out by an opening.
                if op.tree == RUNS {
                    return Ok(false);
                }
                let key = (op.tree, op.key);
                let digest = counted.entry(key.0).or_default();
                let old = match after.get(&key) {
                    Some(old) => old.clone(),
                    None => self.memory.get(key.0, &key.1)?,
                };
                if let Some(old) = old {
                    digest.remove(&key.1, &old);
                }
                if let Some(new) = &op.value {
                    digest.add(&key.1, new);
                }
                after.insert(key, op.value);
            }
        }
        counted.retain(|_, digest| *digest != Default::default());
        if counted != state.digests {
            return Ok(false);
        }
        let ops = after.into_iter().map(|((tree, key), value)| Op { tree, key, value });
        self.memory.apply(ops.collect(), &state)?;
        self.state = state;
        Ok(true)
    }

    /// What was read of a store anew, in the place of what was put down.
    pub(crate) fn in_place_of(mut self, before: &Self) -> Self {
        self.left.clone_from(&before.left);
        self.read_only.clone_from(&before.read_only);
        self.checkpoint_at = before.checkpoint_at;
        self.journal_bytes = before.journal_bytes;
        self
    }
}
