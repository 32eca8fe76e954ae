//! What a broken store comes to; check, backup, restoration.

use std::path::Path;
use std::process::Command;

use orthoframe_store::{Severity, Store, StoreError, fsck};
use orthoframe_units::Cm;

use super::{change, load, open, scratch};
use crate::store_world::{Dice, world};

/// The journal alone brings everything back: sled is an index.
#[test]
fn the_tables_are_built_anew_from_the_journal() {
    let dir = scratch();
    let map = world(17, 9);
    open(dir.path()).import(&map, &change("первая")).unwrap();
    std::fs::remove_dir_all(dir.path().join("sled")).unwrap();
    let (store, report) = Store::open(dir.path()).unwrap();
    assert_eq!((report.replayed, load(&store)), (1, map.clone()));
    drop(store);
    for entry in std::fs::read_dir(dir.path().join("sled")).unwrap() {
        let path = entry.unwrap().path();
        if path.is_file() {
            std::fs::write(path, [0x5A; 5000]).unwrap();
        }
    }
    let (store, report) = Store::open(dir.path()).unwrap();
    assert!(report.tables_rebuilt.is_some());
    assert_eq!(load(&store), map);
}

#[test]
fn a_torn_tail_is_cut_and_said() {
    let dir = scratch();
    let map = world(19, 6);
    open(dir.path()).import(&map, &change("первая")).unwrap();
    let journal =
        std::fs::read_dir(dir.path().join("journal")).unwrap().next().unwrap().unwrap().path();
    let mut bytes = std::fs::read(&journal).unwrap();
    bytes.extend_from_slice(b"OFJ\x01half of a fra");
    std::fs::write(&journal, &bytes).unwrap();
    let (mut store, report) = Store::open(dir.path()).unwrap();
    assert_eq!((report.torn_bytes, load(&store)), (17, map));
    store.import(&world(20, 6), &change("дальше")).unwrap();
    drop(store);
    let (store, report) = Store::open(dir.path()).unwrap();
    assert_eq!((report.torn_bytes, store.revision()), (0, 2));
}

#[test]
fn a_broken_frame_before_a_good_one_is_corruption() {
    let dir = scratch();
    let mut store = open(dir.path());
    for seed in 0..3 {
        store.import(&world(seed, 5), &change("ещё")).unwrap();
    }
    let map = load(&store);
    drop(store);
    let journal =
        std::fs::read_dir(dir.path().join("journal")).unwrap().next().unwrap().unwrap().path();
    let mut bytes = std::fs::read(&journal).unwrap();
    bytes[300] ^= 4;
    std::fs::write(&journal, &bytes).unwrap();
    // The tables are whole: they give a new snapshot and journal.
    let (store, report) = Store::open(dir.path()).unwrap();
    assert!(report.journal_renewed.is_some());
    assert_eq!(load(&store), map);
    drop(store);
    assert_eq!(load(&open(dir.path())), map);
    // Now both are broken.
    let broken = scratch();
    let status = Command::new("cp").arg("-r").arg(dir.path()).arg(broken.path().join("s")).status();
    assert!(status.unwrap().success());
    let broken = broken.path().join("s");
    std::fs::remove_dir_all(broken.join("sled")).unwrap();
    std::fs::remove_dir_all(broken.join("snapshots")).unwrap();
    let Err(refused) = Store::open(&broken) else { panic!("a store beyond repair was opened") };
    assert!(matches!(refused, StoreError::BothCorrupt { .. }), "{refused}");
}

#[test]
fn what_could_not_be_read_is_not_written() {
    let dir = scratch();
    let mut store = open(dir.path());
    let mut map = world(1, 3);
    map.robot.speed = f64::NAN;
    let refused = store.import(&map, &change("первая")).unwrap_err();
    assert!(matches!(refused, StoreError::NotFinite { table: "Robot", column: "Speed", .. }));
    map.robot.speed = 1e300;
    map.robot.radius = Cm::of(1e12);
    store.import(&map, &change("первая")).unwrap();
    assert_eq!(load(&store), map);
}

#[test]
fn a_backup_is_the_whole_store_in_one_file() {
    let (dir, copies) = (scratch(), scratch());
    let mut store = open(dir.path());
    let (first, second) = (world(51, 10), world(52, 10));
    store.import(&first, &change("первая")).unwrap();
    store.import(&second, &change("вторая")).unwrap();
    let second = load(&store);
    let copy = copies.path().join("копия");
    store.backup(&copy).unwrap();
    store.import(&world(53, 10), &change("третья")).unwrap();

    let place = copies.path().join("новое");
    let restored = Store::restore(&copy, &place).unwrap();
    assert_eq!((restored.revision(), load(&restored)), (2, second));
    assert_eq!(restored.world_as_of(1).unwrap().unwrap(), first);
    drop(restored);
    assert!(fsck(&place).unwrap().is_sound());
    assert!(matches!(Store::restore(&copy, &place), Err(StoreError::NotEmpty { .. })));

    let mut bytes = std::fs::read(&copy).unwrap();
    for _ in 0..40 {
        let bit = Dice::new(bytes.len() as u64).roll(bytes.len() as u64 * 8) as usize;
        bytes[bit / 8] ^= 1 << (bit % 8);
        std::fs::write(&copy, &bytes).unwrap();
        let refused = Store::restore(&copy, copies.path().join("другое"));
        assert!(matches!(refused, Err(StoreError::BadFile { .. })));
        bytes[bit / 8] ^= 1 << (bit % 8);
    }
    for rubbish in [&b""[..], b"SQLite format 3\0", &[0xFF; 100_000]] {
        std::fs::write(&copy, rubbish).unwrap();
        let refused = Store::restore(&copy, copies.path().join("другое"));
        assert!(matches!(refused, Err(StoreError::BadFile { .. })));
    }
}

#[test]
fn a_deep_check_finds_what_is_broken_and_opening_mends_it() {
    let dir = scratch();
    let mut store = open(dir.path());
    for seed in 0..4 {
        store.import(&world(seed, 5), &change("ещё")).unwrap();
        store.checkpoint().unwrap();
    }
    let map = load(&store);
    // While it is open, all but sled can be checked.
    assert!(fsck(dir.path()).unwrap().is_sound());
    drop(store);
    let report = fsck(dir.path()).unwrap();
    assert_eq!((report.is_sound(), report.revision, report.snapshots), (true, 4, 3));

    let snapshots = dir.path().join("snapshots");
    let newest = std::fs::read_dir(&snapshots).unwrap().map(|e| e.unwrap().path()).max().unwrap();
    let mut bytes = std::fs::read(&newest).unwrap();
    let middle = bytes.len() / 2;
    bytes[middle] ^= 1;
    std::fs::write(&newest, &bytes).unwrap();
    std::fs::remove_dir_all(dir.path().join("sled")).unwrap();
    let report = fsck(dir.path()).unwrap();
    let mendable = report.findings.iter().filter(|f| f.severity == Severity::Mendable).count();
    assert_eq!(mendable, 2, "{:#?}", report.findings);
    assert!(report.findings.iter().all(|f| f.severity < Severity::Broken));
    // The snapshot before it and the journal since then are enough.
    let (store, opened) = Store::open(dir.path()).unwrap();
    assert!(opened.tables_rebuilt.is_some());
    assert_eq!(load(&store), map);
}

#[test]
fn a_deep_check_says_what_the_next_opening_will_mend() {
    let dir = scratch();
    let mut store = open(dir.path());
    for seed in 0..3 {
        store.import(&world(seed, 5), &change("ещё")).unwrap();
    }
    store.derived().put("relations", b"computed").unwrap();
    let map = load(&store);
    drop(store);
    let journal =
        std::fs::read_dir(dir.path().join("journal")).unwrap().next().unwrap().unwrap().path();
    let derived = dir.path().join("derived").join("relations");
    let flip = |path: &Path, at: usize| {
        let mut bytes = std::fs::read(path).unwrap();
        bytes[at] ^= 1;
        std::fs::write(path, bytes).unwrap();
    };
    // The first frame is broken, whole ones follow, there is no snapshot: sled alone has it all.
    flip(&journal, 300);
    flip(&derived, 25);
    let report = fsck(dir.path()).unwrap();
    // What the random map itself is warned of is a note.
    let texts: Vec<_> = report
        .findings
        .iter()
        .filter(|f| f.severity > Severity::Note)
        .map(|f| (f.severity, f.text.to_string()))
        .collect();
    assert!(texts.iter().all(|(severity, _)| *severity == Severity::Mendable), "{texts:#?}");
    assert_eq!((report.revision, texts.len()), (3, 2), "{texts:#?}");
    assert!(texts[0].1.contains("испорчен"), "{texts:#?}");
    assert!(texts[1].1.contains("relations"), "{texts:#?}");
    let (store, opened) = Store::open(dir.path()).unwrap();
    assert!(opened.journal_renewed.is_some());
    assert_eq!(load(&store), map);
    assert_eq!(store.derived().get("relations"), None);
    drop(store);

    // With sled gone as well, nothing is left to mend with.
    let journal =
        std::fs::read_dir(dir.path().join("snapshots")).unwrap().next().unwrap().unwrap().path();
    flip(&journal, 300);
    std::fs::remove_dir_all(dir.path().join("sled")).unwrap();
    let report = fsck(dir.path()).unwrap();
    assert!(report.findings.iter().any(|f| f.severity == Severity::Broken), "{report:#?}");
    assert!(matches!(Store::open(dir.path()), Err(StoreError::BothCorrupt { .. })));
}

/// One bit of any file, sled's included: everything is there all the same.
/// `STORE_FLIPS=1000` flips as many.
#[test]
fn a_flipped_bit_in_any_file_costs_nothing() {
    let flips = std::env::var("STORE_FLIPS").ok().and_then(|n| n.parse().ok()).unwrap_or(60);
    let original = scratch();
    let mut store = open(original.path());
    for seed in 0..3 {
        store.import(&world(seed, 6), &change("ещё")).unwrap();
        if seed == 1 {
            store.checkpoint().unwrap();
        }
    }
    let map = load(&store);
    drop(store);
    let mut files = Vec::new();
    collect_files(original.path(), &mut files);
    let mut dice = Dice::new(2026);
    for _ in 0..flips {
        let copy = scratch();
        for (path, bytes) in &files {
            let to = copy.path().join(path.strip_prefix(original.path()).unwrap());
            std::fs::create_dir_all(to.parent().unwrap()).unwrap();
            std::fs::write(to, bytes).unwrap();
        }
        let filled: Vec<_> = files.iter().filter(|(_, bytes)| !bytes.is_empty()).collect();
        let (path, bytes) = filled[dice.roll(filled.len() as u64) as usize];
        let mut bytes = bytes.clone();
        let bit = dice.roll(bytes.len() as u64 * 8) as usize;
        bytes[bit / 8] ^= 1 << (bit % 8);
        std::fs::write(copy.path().join(path.strip_prefix(original.path()).unwrap()), bytes)
            .unwrap();
        let opened = Store::open(copy.path());
        let (store, _) = opened.unwrap_or_else(|e| panic!("{path:?} bit {bit}: {e}"));
        assert_eq!((store.revision(), load(&store)), (3, map.clone()), "{path:?} bit {bit}");
    }
}

fn collect_files(dir: &Path, files: &mut Vec<(std::path::PathBuf, Vec<u8>)>) {
    for entry in std::fs::read_dir(dir).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            collect_files(&path, files);
        } else {
            let bytes = std::fs::read(&path).unwrap();
            files.push((path, bytes));
        }
    }
}
