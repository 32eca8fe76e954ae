//! A disk that fails as disks do, a sled that forgets as sled does, and ten thousand runs of the vault over them.
//!
//! The disk keeps what was synced and what was only written apart. A crash keeps of the latter what the dice say:
//! any sectors of a file in any order, any beginning of the list of creations, renames and removals. Besides, any
//! call may fail, a write after half of its bytes; a sync may lie; a bit may flip. The trees come back from a
//! crash as they were at any earlier transaction, or broken, or not at all.
//!
//! What must hold, whatever happens: a store that opens holds exactly what it held after some transaction; that
//! is at least the last acknowledged one, unless a sync lied; and it opens, unless two things broke at once.

use std::collections::BTreeMap;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::{Arc, Mutex, MutexGuard};

use crate::disk::{Appender, Disk, Placed, Reading};
use crate::error::{Result, StoreError};
use crate::frame::Op;
use crate::memory::MemoryTrees;
use crate::trees::{HISTORY, State, Trees, Visit, digests};
use crate::vault::{Change, OpenReport, Shelf, Vault};

mod failing;
mod in_turn;

/// splitmix64: the same seed, the same run.
#[derive(Clone)]
struct Dice(u64);

impl Dice {
    fn roll(&mut self, sides: usize) -> usize {
        self.0 = self.0.wrapping_add(0x9E37_79B9_7F4A_7C15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94D0_49BB_1331_11EB);
        ((z ^ (z >> 31)) % sides as u64) as usize
    }
}

#[derive(Clone, Default)]
struct Inode {
    now: Vec<u8>,
    synced: Vec<u8>,
}

#[derive(Clone)]
enum Entry {
    Create(PathBuf, usize),
    Rename(PathBuf, PathBuf),
    Remove(PathBuf),
}

#[derive(Clone)]
struct Inner {
    dice: Dice,
    inodes: Vec<Inode>,
    names: BTreeMap<PathBuf, usize>,
    synced_names: BTreeMap<PathBuf, usize>,
    pending: Vec<Entry>,
    /// Calls until one fails; none when all succeed.
    fails_in: Option<usize>,
    /// Whether after that everything fails.
    stays_broken: bool,
    lies: bool,
    calls: usize,
}

/// See the module.
#[derive(Clone)]
struct SimDisk(Arc<Mutex<Inner>>);

fn rename(names: &mut BTreeMap<PathBuf, usize>, entry: &Entry) {
    match entry {
        Entry::Create(path, inode) => {
            names.insert(path.clone(), *inode);
        }
        Entry::Rename(from, to) => {
            if let Some(inode) = names.remove(from) {
                names.insert(to.clone(), inode);
            }
        }
        Entry::Remove(path) => {
            names.remove(path);
        }
    }
}

const SECTOR: usize = 64;

impl Inner {
    fn call(&mut self) -> io::Result<()> {
        self.calls += 1;
        match &mut self.fails_in {
            Some(0) => {
                if !self.stays_broken {
                    self.fails_in = None;
                }
                Err(io::Error::other("сбой диска"))
            }
            Some(n) => {
                *n -= 1;
                Ok(())
            }
            None => Ok(()),
        }
    }

    fn enter(&mut self, entry: Entry) {
        rename(&mut self.names, &entry);
        self.pending.push(entry);
    }

    /// The power goes.
    fn crash(&mut self) {
        let kept = self.dice.roll(self.pending.len() + 1);
        for entry in std::mem::take(&mut self.pending).into_iter().take(kept) {
            rename(&mut self.synced_names, &entry);
        }
        self.names = self.synced_names.clone();
        for inode in &mut self.inodes {
            let (old, new) = (&inode.synced, &inode.now);
            if old == new {
                continue;
            }
            let (short, long) = (old.len().min(new.len()), old.len().max(new.len()));
            let length = short + self.dice.roll(long - short + 1);
            let mut left = Vec::with_capacity(length);
            for start in (0..length).step_by(SECTOR) {
                let from = if self.dice.roll(2) == 0 { old } else { new };
                left.extend(
                    (start..length.min(start + SECTOR))
                        .map(|at| from.get(at).copied().unwrap_or(0)),
                );
            }
            inode.now.clone_from(&left);
            inode.synced = left;
        }
        self.fails_in = None;
        self.lies = false;
    }
}

impl SimDisk {
    fn new(seed: u64) -> Self {
        Self(Arc::new(Mutex::new(Inner {
            dice: Dice(seed),
            inodes: Vec::new(),
            names: BTreeMap::new(),
            synced_names: BTreeMap::new(),
            pending: Vec::new(),
            fails_in: None,
            stays_broken: false,
            lies: false,
            calls: 0,
        })))
    }

    fn inner(&self) -> MutexGuard<'_, Inner> {
        self.0.lock().expect("the tests do not panic with the lock held")
    }

    /// Flips a bit of a file at rest.
    fn flip(&self, dice: &mut Dice) -> Option<PathBuf> {
        let mut inner = self.inner();
        let whole: Vec<_> = inner.names.clone().into_iter().collect();
        let (path, inode) = whole.get(dice.roll(whole.len().max(1)))?.clone();
        let length = inner.inodes[inode].now.len();
        if length == 0 {
            return None;
        }
        let bit = dice.roll(length * 8);
        inner.inodes[inode].now[bit / 8] ^= 1 << (bit % 8);
        inner.inodes[inode].synced = inner.inodes[inode].now.clone();
        Some(path)
    }
}

struct SimFile {
    disk: SimDisk,
    inode: usize,
}

impl Appender for SimFile {
    fn append(&mut self, bytes: &[u8]) -> io::Result<()> {
        let mut inner = self.disk.inner();
        let done = inner.call();
        let written = if done.is_ok() { bytes.len() } else { bytes.len() / 2 };
        inner.inodes[self.inode].now.extend(&bytes[..written]);
        done
    }

    fn sync(&mut self) -> io::Result<()> {
        let mut inner = self.disk.inner();
        inner.call()?;
        if !inner.lies {
            let inode = &mut inner.inodes[self.inode];
            inode.synced.clone_from(&inode.now);
        }
        Ok(())
    }

    fn cut(&mut self, length: u64) -> io::Result<()> {
        let mut inner = self.disk.inner();
        inner.call()?;
        let inode = &mut inner.inodes[self.inode];
        inode.now.truncate(length as usize);
        inode.synced.clone_from(&inode.now);
        Ok(())
    }
}

impl Placed for SimFile {
    fn write_at(&self, place: u64, bytes: &[u8]) -> io::Result<()> {
        let mut inner = self.disk.inner();
        let done = inner.call();
        let written = if done.is_ok() { bytes.len() } else { bytes.len() / 2 };
        let now = &mut inner.inodes[self.inode].now;
        now[place as usize..place as usize + written].copy_from_slice(&bytes[..written]);
        done
    }

    fn sync(&self) -> io::Result<()> {
        let mut inner = self.disk.inner();
        inner.call()?;
        if !inner.lies {
            let inode = &mut inner.inodes[self.inode];
            inode.synced.clone_from(&inode.now);
        }
        Ok(())
    }
}

impl Reading for SimFile {
    fn length(&self) -> io::Result<u64> {
        let mut inner = self.disk.inner();
        inner.call()?;
        Ok(inner.inodes[self.inode].now.len() as u64)
    }

    fn read_at(&self, place: u64, length: usize) -> io::Result<Vec<u8>> {
        let mut inner = self.disk.inner();
        inner.call()?;
        let piece = inner.inodes[self.inode].now.get(place as usize..place as usize + length);
        piece.map(<[u8]>::to_vec).ok_or_else(|| io::ErrorKind::UnexpectedEof.into())
    }
}

impl Disk for SimDisk {
    fn create_dir(&self, _: &Path) -> io::Result<()> {
        self.inner().call()
    }

    fn list(&self, dir: &Path) -> io::Result<Vec<String>> {
        let mut inner = self.inner();
        inner.call()?;
        let within = inner.names.keys().filter(|p| p.parent() == Some(dir));
        Ok(within.filter_map(|p| Some(p.file_name()?.to_string_lossy().into_owned())).collect())
    }

    fn read(&self, path: &Path) -> io::Result<Vec<u8>> {
        let mut inner = self.inner();
        inner.call()?;
        let inode = inner.names.get(path).ok_or(io::ErrorKind::NotFound)?;
        Ok(inner.inodes[*inode].now.clone())
    }

    fn appender(&self, path: &Path) -> io::Result<Box<dyn Appender>> {
        let mut inner = self.inner();
        inner.call()?;
        let inode = match inner.names.get(path) {
            Some(inode) => *inode,
            None => {
                inner.inodes.push(Inode::default());
                let inode = inner.inodes.len() - 1;
                inner.enter(Entry::Create(path.to_owned(), inode));
                inode
            }
        };
        Ok(Box::new(SimFile { disk: self.clone(), inode }))
    }

    fn placed(&self, path: &Path) -> io::Result<Box<dyn Placed>> {
        let mut inner = self.inner();
        inner.call()?;
        let inode = *inner.names.get(path).ok_or(io::ErrorKind::NotFound)?;
        Ok(Box::new(SimFile { disk: self.clone(), inode }))
    }

    fn reading(&self, path: &Path) -> io::Result<Box<dyn Reading>> {
        let mut inner = self.inner();
        inner.call()?;
        let inode = *inner.names.get(path).ok_or(io::ErrorKind::NotFound)?;
        Ok(Box::new(SimFile { disk: self.clone(), inode }))
    }

    fn rename(&self, from: &Path, to: &Path) -> io::Result<()> {
        let mut inner = self.inner();
        inner.call()?;
        inner.enter(Entry::Rename(from.to_owned(), to.to_owned()));
        Ok(())
    }

    fn remove(&self, path: &Path) -> io::Result<()> {
        let mut inner = self.inner();
        inner.call()?;
        if !inner.names.contains_key(path) {
            return Err(io::ErrorKind::NotFound.into());
        }
        inner.enter(Entry::Remove(path.to_owned()));
        Ok(())
    }

    fn sync_dir(&self, _: &Path) -> io::Result<()> {
        let mut inner = self.inner();
        inner.call()?;
        // As with a journalling file system, what was entered before is then safe too.
        for entry in std::mem::take(&mut inner.pending) {
            rename(&mut inner.synced_names, &entry);
        }
        Ok(())
    }
}

/// Trees that remember every transaction, so that a crash can take them back to any.
#[derive(Default)]
struct SimTrees {
    now: MemoryTrees,
    log: Mutex<Vec<(Vec<Op>, State)>>,
    broken: bool,
}

impl Trees for SimTrees {
    fn scan(&self, tree: u8, prefix: &[u8], visit: &mut Visit) -> Result<()> {
        self.now.scan(tree, prefix, visit)
    }
    fn apply(&self, ops: Vec<Op>, state: &State) -> Result<()> {
        self.log.lock().expect("no panic with the lock held").push((ops.clone(), state.clone()));
        self.now.apply(ops, state)
    }
    fn state(&self) -> Result<State> {
        if self.broken {
            return Err(StoreError::Tables { what: ("сломаны", "broken").into() });
        }
        self.now.state()
    }
    fn flush(&self) -> Result<()> {
        Ok(())
    }
}

struct SimShelf {
    trees: Arc<SimTrees>,
    opened: bool,
}

impl Shelf for SimShelf {
    fn open(&mut self) -> Result<Arc<dyn Trees>> {
        self.opened = true;
        Ok(Arc::clone(&self.trees) as Arc<dyn Trees>)
    }
    /// The dice say when sled follows, so that a seed is a run.
    fn has_thread(&self) -> bool {
        false
    }
    fn exists(&self) -> bool {
        self.opened
    }
    fn set_aside(&mut self) -> Result<()> {
        self.trees = Arc::default();
        Ok(())
    }
    fn look(&self) -> Result<Arc<dyn Trees>> {
        Ok(Arc::clone(&self.trees) as Arc<dyn Trees>)
    }
}

impl SimShelf {
    /// What sled may make of a power cut.
    fn crash(&mut self, dice: &mut Dice) {
        if !self.opened {
            return;
        }
        let log = self.trees.log.lock().expect("no panic with the lock held").clone();
        let kept = match dice.roll(4) {
            0 => 0,
            1 => dice.roll(log.len() + 1),
            _ => log.len(),
        };
        let mut trees = SimTrees::default();
        for (ops, state) in log.into_iter().take(kept) {
            trees.apply(ops, &state).expect("memory does not fail");
        }
        match dice.roll(8) {
            0 => trees.broken = true,
            1 => {
                // A record went missing, or changed, behind the back of its state.
                let state = trees.state().expect("these are whole");
                let key = vec![dice.roll(6) as u8];
                let value = (dice.roll(2) == 0).then(|| vec![0xEE]);
                let stray = Op { tree: TREES[dice.roll(3)], key, value };
                trees.apply(vec![stray], &state).expect("memory does not fail");
            }
            _ => {}
        }
        self.trees = Arc::new(trees);
    }
}

const TREES: [u8; 3] = [18, 25, HISTORY];

type Content = BTreeMap<(u8, Vec<u8>), Vec<u8>>;

fn content(vault: &Vault) -> Result<Content> {
    let mut all = Content::new();
    for tree in TREES {
        vault.trees().scan(tree, &[], &mut |key, value| {
            all.insert((tree, key.to_vec()), value.to_vec());
            Ok(true)
        })?;
    }
    // Asked for one by one, and from behind, it is the same.
    for tree in TREES {
        for key in 0..6 {
            let known = all.get(&(tree, vec![key])).cloned();
            assert_eq!(vault.trees().get(tree, &[key])?, known);
            let mut upto = all.range((tree, Vec::new())..=(tree, vec![key]));
            let last = upto.next_back().map(|((_, key), value)| (key.clone(), value.clone()));
            assert_eq!(vault.trees().last(tree, &[], &[key])?, last);
        }
    }
    Ok(all)
}

/// The store under test, with what it must hold.
struct Run {
    dice: Dice,
    disk: SimDisk,
    shelf: SimShelf,
    /// Content after each transaction that may be there: index is the sequence number.
    past: Vec<Content>,
    acknowledged: u64,
}

fn dir() -> &'static Path {
    Path::new("/store")
}

impl Run {
    fn new(seed: u64) -> Self {
        Self {
            dice: Dice(seed),
            disk: SimDisk::new(seed ^ 0xD15C),
            shelf: SimShelf { trees: Arc::default(), opened: false },
            past: vec![Content::new()],
            acknowledged: 0,
        }
    }

    fn open(&mut self) -> Result<(Vault, OpenReport)> {
        Vault::open(Arc::new(self.disk.clone()), dir(), &mut self.shelf)
    }

    /// Commits a few transactions, and takes a snapshot now and then.
    fn work(&mut self, vault: &mut Vault, count: usize) {
        for _ in 0..count {
            if self.dice.roll(6) == 0 {
                // What becomes past is taken up by transactions of the vault's own, which change nothing to look at.
                self.past.truncate(vault.lsn() as usize + 1);
                let now = self.past[vault.lsn() as usize].clone();
                self.past.extend([now.clone(), now]);
                let _ = vault.checkpoint();
                self.acknowledged = vault.lsn();
                if vault.read_only().is_some() {
                    return;
                }
                continue;
            }
            let mut after = self.past[vault.lsn() as usize].clone();
            let changes: Vec<Change> = (0..1 + self.dice.roll(4))
                .map(|_| (TREES[self.dice.roll(3)], vec![self.dice.roll(6) as u8]))
                .collect::<std::collections::BTreeSet<_>>()
                .into_iter()
                .map(|(tree, key)| {
                    let value = (self.dice.roll(4) > 0)
                        .then(|| vec![self.dice.roll(256) as u8; 1 + self.dice.roll(89)]);
                    let place = (tree, key.clone());
                    let old = match &value {
                        Some(value) => after.insert(place, value.clone()),
                        None => after.remove(&place),
                    };
                    Change { op: Op { tree, key, value }, old }
                })
                .collect();
            self.past.truncate(vault.lsn() as usize + 1);
            self.past.push(after);
            match vault.commit(changes.clone()) {
                Ok(()) => {
                    self.acknowledged = vault.lsn();
                    if self.dice.roll(2) == 0 {
                        vault.catch_up().expect("memory does not fail");
                    }
                }
                Err(_) => {
                    assert!(vault.read_only().is_some(), "after a failed write nothing is written");
                    assert!(vault.commit(changes).is_err());
                    return;
                }
            }
        }
    }

    fn crash(&mut self) {
        self.disk.inner().crash();
        self.shelf.crash(&mut self.dice);
    }

    /// What an opened store holds, against what it must hold.
    fn check(&mut self, vault: &Vault, at_least: u64) {
        let lsn = vault.lsn();
        assert!(lsn >= at_least, "{at_least} was acknowledged, {lsn} is there");
        let expected = self.past.get(lsn as usize).expect("only what was written can be there");
        let content = match content(vault) {
            Ok(content) => content,
            // What is past is on a disk that does not answer.
            Err(_) if self.disk.inner().fails_in.is_some() => return,
            Err(error) => panic!("{error}"),
        };
        assert_eq!(&content, expected, "the content after transaction {lsn}");
        let counted = digests(&**vault.memory()).expect("memory does not fail");
        assert_eq!(counted, vault.trees().state().expect("these are whole").digests);
        // What has been seen once must not vanish.
        self.acknowledged = lsn;
    }
}

/// `STORE_SEEDS=100` runs a hundred times as many.
fn seeds(count: u64, run: impl Fn(u64)) {
    let times = std::env::var("STORE_SEEDS").ok().and_then(|n| n.parse().ok()).unwrap_or(1);
    for seed in 0..count * times {
        let outcome = std::panic::catch_unwind(std::panic::AssertUnwindSafe(|| run(seed)));
        assert!(outcome.is_ok(), "seed {seed}");
    }
}

#[test]
fn nothing_acknowledged_is_lost_when_the_power_goes() {
    seeds(4000, |seed| {
        let mut run = Run::new(seed);
        for _ in 0..3 {
            let (mut vault, _) = run.open().expect("one fault at a time is mended");
            run.check(&vault, run.acknowledged);
            let count = run.dice.roll(8);
            run.work(&mut vault, count);
            drop(vault);
            run.crash();
        }
        let (vault, _) = run.open().expect("one fault at a time is mended");
        run.check(&vault, run.acknowledged);
    });
}

#[test]
fn nothing_acknowledged_is_lost_when_any_call_fails_and_then_the_power() {
    seeds(4000, |seed| {
        let mut run = Run::new(seed);
        for _ in 0..3 {
            {
                let mut inner = run.disk.inner();
                inner.fails_in = Some(run.dice.roll(60));
                inner.stays_broken = run.dice.roll(2) == 0;
            }
            // Recovery itself may be what the fault hits.
            if let Ok((mut vault, _)) = run.open() {
                run.check(&vault, run.acknowledged);
                let count = run.dice.roll(12);
                run.work(&mut vault, count);
            }
            if run.dice.roll(3) > 0 {
                run.crash();
            }
            run.disk.inner().fails_in = None;
            let (vault, _) = run.open().expect("the disk works again");
            run.check(&vault, run.acknowledged);
        }
    });
}

/// Every call of a fixed run fails once, for itself: no place is left out by the dice.
#[test]
fn the_nth_call_may_fail_for_every_n() {
    for stays_broken in [false, true] {
        for n in 0.. {
            let mut run = Run::new(99);
            {
                let mut inner = run.disk.inner();
                inner.fails_in = Some(n);
                inner.stays_broken = stays_broken;
            }
            if let Ok((mut vault, _)) = run.open() {
                run.work(&mut vault, 25);
            }
            let reached = run.disk.inner().calls > n;
            run.crash();
            let (vault, _) = run.open().expect("the disk works again");
            run.check(&vault, run.acknowledged);
            if !reached {
                assert!(n > 50, "the run has {n} calls");
                break;
            }
        }
    }
}

#[test]
fn a_flipped_bit_is_mended_or_refused_but_never_read() {
    let refused = std::cell::Cell::new(0);
    seeds(2000, |seed| {
        let mut run = Run::new(seed);
        let (mut vault, _) = run.open().unwrap();
        let count = 3 + run.dice.roll(8);
        run.work(&mut vault, count);
        // Closed in good order, as a program does that is not killed.
        vault.catch_up().expect("memory does not fail");
        drop(vault);
        let mut dice = run.dice.clone();
        let Some(_) = run.disk.flip(&mut dice) else { return };
        // Trees and disk are whole but for this bit: everything must be there.
        let (vault, _) = run.open().expect("one flipped bit is mended");
        run.check(&vault, run.acknowledged);
        vault.catch_up().expect("memory does not fail");
        drop(vault);
        // Now the trees are gone too: all of it, or an error. That the last frame was no torn one is known from the
        // mark beside the journal.
        run.disk.flip(&mut dice);
        run.shelf.trees = Arc::default();
        match run.open() {
            // Both files of one run were hit: what stood there is refused, and nothing else is told.
            Ok((vault, _)) if matches!(content(&vault), Err(StoreError::BadFile { .. })) => {}
            Ok((vault, _)) => run.check(&vault, run.acknowledged),
            Err(StoreError::BothCorrupt { .. } | StoreError::UnknownFormat { .. }) => {
                refused.set(refused.get() + 1);
            }
            Err(other) => panic!("{other}"),
        }
    });
    assert!(refused.get() > 0, "the test would not notice if nothing were refused");
}

#[test]
fn a_disk_that_lies_about_its_syncs_costs_the_end_but_not_the_sense() {
    seeds(1000, |seed| {
        let mut run = Run::new(seed);
        let (mut vault, _) = run.open().unwrap();
        run.work(&mut vault, 4);
        run.disk.inner().lies = true;
        run.work(&mut vault, 6);
        drop(vault);
        run.crash();
        match run.open() {
            // What was written out as past is lost, and is refused.
            Ok((vault, _)) if matches!(content(&vault), Err(StoreError::BadFile { .. })) => {}
            Ok((vault, _)) => run.check(&vault, 0),
            Err(StoreError::BothCorrupt { .. }) => {}
            Err(other) => panic!("{other}"),
        }
    });
}

/// A file that could not be put in place leaves nothing beside it, whichever call failed.
#[test]
fn a_file_that_is_not_put_in_place_leaves_nothing() {
    let parts = [b"first part".to_vec(), b"second part".to_vec()];
    let path = dir().join("copy");
    for n in 0.. {
        let disk = SimDisk::new(1);
        disk.inner().fails_in = Some(n);
        let done = disk.replace(&path, &parts);
        let names: Vec<_> = disk.inner().names.keys().cloned().collect();
        let reached = disk.inner().calls > n;
        match done {
            // The folder's own sync may fail when the file is there already.
            Ok(()) => assert_eq!(names, std::slice::from_ref(&path)),
            Err(_) => assert!(names.is_empty() || names == [path.clone()], "call {n}: {names:?}"),
        }
        if !reached {
            assert!(n >= 5, "the file takes {n} calls");
            break;
        }
    }
}
