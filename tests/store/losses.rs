//! What was acknowledged is never answered with less: whichever file of a store is cut short, emptied or gone, it
//! opens with everything, or not at all. The whole family, not a list of cases.

use std::path::{Path, PathBuf};

use orthoframe_map::World;
use orthoframe_store::{OpenReport, Severity, Store, StoreError, fsck};

use super::{change, load, open, scratch};
use crate::store_world::{Dice, world};

const REVISIONS: u64 = 5;

/// A store with a snapshot, a journal before it, three transactions after it, and what it holds.
fn kept(dir: &Path) -> World {
    let mut store = open(dir);
    for seed in 0..REVISIONS {
        store.import(&world(seed, 4), &change("ещё")).unwrap();
        if seed == 1 {
            store.checkpoint().unwrap();
        }
    }
    load(&store)
}

fn files(dir: &Path, found: &mut Vec<PathBuf>) {
    let mut entries: Vec<_> = std::fs::read_dir(dir).unwrap().map(|e| e.unwrap().path()).collect();
    entries.sort();
    for path in entries {
        if path.is_dir() { files(&path, found) } else { found.push(path) }
    }
}

fn copy(from: &Path, to: &Path) {
    let mut all = Vec::new();
    files(from, &mut all);
    for path in all {
        let to = to.join(path.strip_prefix(from).unwrap());
        std::fs::create_dir_all(to.parent().unwrap()).unwrap();
        std::fs::copy(&path, to).unwrap();
    }
}

/// Where the frames of a journal begin, its head and its end among them.
fn boundaries(journal: &[u8]) -> Vec<usize> {
    let mut at = vec![0, 24];
    while let Some(length) = journal.get(at[at.len() - 1] + 4..).and_then(|b| b.first_chunk::<4>())
    {
        at.push(at[at.len() - 1] + 20 + u32::from_be_bytes(*length) as usize);
    }
    assert_eq!(at.pop(), Some(journal.len()), "the journal ends with a whole frame");
    at
}

/// What happened to a file: cut to a length, or gone.
#[derive(Debug, Clone, Copy)]
enum Loss {
    Cut(usize),
    Gone,
}

struct Tally {
    opened: usize,
    refused: usize,
}

/// What else a store has lost.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Also {
    Nothing,
    Sled,
    /// How far the journal must reach is then known from sled alone.
    Head,
    /// It is there and tells nothing.
    HeadEmptied,
}

/// One loss, and perhaps another: everything or nothing, read-only too, and `fsck` says the same.
fn suffer(original: &Path, file: &Path, loss: Loss, also: Also, map: &World) -> Tally {
    let what = format!("{} {loss:?}, also: {also:?}", file.display());
    let dir = scratch();
    copy(original, dir.path());
    let lost = dir.path().join(file);
    match loss {
        Loss::Gone => std::fs::remove_file(&lost).unwrap(),
        Loss::Cut(length) => {
            std::fs::OpenOptions::new()
                .write(true)
                .open(&lost)
                .unwrap()
                .set_len(length as u64)
                .unwrap();
        }
    }
    match also {
        Also::Nothing => (),
        Also::Sled => std::fs::remove_dir_all(dir.path().join("sled")).unwrap(),
        Also::Head => std::fs::remove_file(dir.path().join("head")).unwrap(),
        Also::HeadEmptied => std::fs::write(dir.path().join("head"), b"").unwrap(),
    }
    let mut before = Vec::new();
    files(dir.path(), &mut before);
    let whole = |opened: Result<(Store, OpenReport), StoreError>, how: &str| match opened {
        Ok((store, report)) => {
            assert_eq!(store.revision(), REVISIONS, "{what}, {how}: an older map, {report:?}");
            assert_eq!(&load(&store), map, "{what}, {how}");
            true
        }
        Err(
            StoreError::BothCorrupt { .. }
            | StoreError::Missing { .. }
            | StoreError::NotAStore { .. },
        ) => false,
        Err(other) => panic!("{what}, {how}: {other}"),
    };
    let read = whole(Store::open_read_only(dir.path()), "read-only");
    let mut after = Vec::new();
    files(dir.path(), &mut after);
    assert_eq!(before, after, "{what}: reading changes nothing");
    let checked = fsck(dir.path());
    let written = whole(Store::open(dir.path()), "to write");
    assert_eq!(read, written, "{what}");
    match checked {
        Ok(report) => {
            let is_broken = report.findings.iter().any(|f| f.severity == Severity::Broken);
            assert_eq!(is_broken, !written, "{what}: {:#?}", report.findings);
        }
        Err(error) => assert!(!written, "{what}: {error}"),
    }
    if written {
        // What was mended stays mended.
        let (_, report) = Store::open(dir.path()).unwrap();
        let calm = OpenReport { lsn: report.lsn, records: report.records, ..OpenReport::default() };
        assert_eq!(report, calm, "{what}");
    } else {
        assert_eq!(also, Also::Sled, "{what}: what sled still has is mended");
    }
    Tally { opened: usize::from(written), refused: usize::from(!written) }
}

/// `STORE_LOSSES=1000` cuts the journal at as many places.
#[test]
fn no_loss_of_a_file_gives_an_older_map() {
    let places = std::env::var("STORE_LOSSES").ok().and_then(|n| n.parse().ok()).unwrap_or(3);
    let original = scratch();
    let map = kept(original.path());
    let mut all = Vec::new();
    files(original.path(), &mut all);
    let relative = |path: &PathBuf| path.strip_prefix(original.path()).unwrap().to_owned();
    let journals: Vec<PathBuf> =
        all.iter().filter(|p| p.extension().is_some_and(|e| e == "journal")).cloned().collect();
    let newest = journals.last().unwrap();
    let bytes = std::fs::read(newest).unwrap();
    let mut cuts = boundaries(&bytes);
    assert!(cuts.len() as u64 > REVISIONS - 2, "{cuts:?}");
    let mut dice = Dice::new(7);
    cuts.extend((0..places).map(|_| dice.roll(bytes.len() as u64) as usize));

    let mut losses: Vec<(PathBuf, Loss)> =
        cuts.into_iter().map(|at| (relative(newest), Loss::Cut(at))).collect();
    for file in all.iter().map(relative) {
        losses.push((file.clone(), Loss::Gone));
        losses.push((file, Loss::Cut(0)));
    }
    let mut total = Tally { opened: 0, refused: 0 };
    for (file, loss) in losses {
        let beside = match file.starts_with("sled") {
            true => &[Also::Nothing, Also::Head, Also::HeadEmptied][..],
            false if file == Path::new("head") => &[Also::Nothing, Also::Sled],
            false => &[Also::Nothing, Also::Sled, Also::Head, Also::HeadEmptied],
        };
        for also in beside {
            let tally = suffer(original.path(), &file, loss, *also, &map);
            total.opened += tally.opened;
            total.refused += tally.refused;
        }
    }
    assert!(total.opened > 20 && total.refused > 5, "{} {}", total.opened, total.refused);
}

/// The journal emptied, sled broken: a loss of everything, and told so by all who look.
#[test]
fn an_emptied_journal_is_no_empty_store() {
    let dir = scratch();
    open(dir.path()).import(&world(3, 6), &change("первая")).unwrap();
    let mut all = Vec::new();
    files(&dir.path().join("journal"), &mut all);
    std::fs::write(&all[0], b"").unwrap();
    let mut all = Vec::new();
    files(&dir.path().join("sled"), &mut all);
    for file in &all {
        std::fs::write(file, b"rubbish").unwrap();
    }
    for head_too in [false, true] {
        if head_too {
            std::fs::remove_file(dir.path().join("head")).unwrap();
        }
        let report = fsck(dir.path()).unwrap();
        assert!(report.findings.iter().any(|f| f.severity == Severity::Broken), "{report:#?}");
        let refused = Store::open_read_only(dir.path()).err();
        assert!(matches!(refused, Some(StoreError::BothCorrupt { .. })), "{refused:?}");
        let refused = Store::open(dir.path()).err();
        assert!(matches!(refused, Some(StoreError::BothCorrupt { .. })), "{refused:?}");
    }
}

/// A store of an earlier version has no `head`; it opens, and has one from then on.
#[test]
fn a_lost_mark_is_made_anew_and_said_where_it_was_broken() {
    let dir = scratch();
    let map = kept(dir.path());
    for (file, said) in [("FORMAT", true), ("head", false)] {
        std::fs::remove_file(dir.path().join(file)).unwrap();
        let (store, report) = Store::open(dir.path()).unwrap();
        assert_eq!((load(&store), report.marks_renewed.contains(&file)), (map.clone(), said));
        drop(store);
        std::fs::write(dir.path().join(file), b"").unwrap();
        let (store, report) = Store::open(dir.path()).unwrap();
        assert_eq!((load(&store), &report.marks_renewed[..]), (map.clone(), &[file][..]));
    }
    // What says another format is no store of ours, FORMAT or no.
    std::fs::remove_file(dir.path().join("FORMAT")).unwrap();
    let head = std::fs::read(dir.path().join("head")).unwrap();
    let mut other = head;
    for at in [0, 512] {
        if other[at..].starts_with(b"ORTHOHED") {
            other[at + 11] = 9;
            let crc = crc32fast::hash(&other[at..at + 32]);
            other[at + 32..at + 36].copy_from_slice(&crc.to_be_bytes());
        }
    }
    std::fs::write(dir.path().join("head"), other).unwrap();
    assert!(matches!(Store::open(dir.path()), Err(StoreError::UnknownFormat { .. })));
}

/// No room for the snapshot that follows: what was forgotten is forgotten, and told so.
#[test]
fn forgetting_without_a_snapshot_is_done_all_the_same() {
    let dir = scratch();
    let map = kept(dir.path());
    let mut store = open(dir.path());
    let snapshots = dir.path().join("snapshots");
    let elsewhere = dir.path().join("elsewhere");
    std::fs::rename(&snapshots, &elsewhere).unwrap();
    std::fs::write(&snapshots, b"in the way").unwrap();
    let forgotten = store.forget_before(REVISIONS, &change("место нужно")).unwrap();
    assert!(forgotten.versions > 0 && forgotten.not_freed.is_some(), "{forgotten:?}");
    assert!(store.world_as_of(1).is_err());
    std::fs::remove_file(&snapshots).unwrap();
    std::fs::rename(&elsewhere, &snapshots).unwrap();
    drop(store);
    let store = open(dir.path());
    assert_eq!(load(&store), map);
    assert!(store.world_as_of(1).is_err());
}
