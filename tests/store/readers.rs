//! Several programs and threads at one store.

use std::process::Command;

use orthoframe_store::{Edits, Key, OpenReport, Store, StoreError, records};

use super::{change, load, open, scratch};
use crate::store_world::world;

#[test]
fn a_reader_keeps_its_revision_while_the_writer_goes_on() {
    let dir = scratch();
    let mut store = open(dir.path());
    let first = world(21, 10);
    store.import(&first, &change("первая")).unwrap();
    let reader = store.reader();
    let watching = std::thread::spawn(move || {
        (0..30).all(|_| reader.world().unwrap().as_ref() == Some(&first))
    });
    for seed in 22..32 {
        store.import(&world(seed, 10), &change("следующая")).unwrap();
    }
    assert!(watching.join().unwrap());
}

/// Each revision writes all replicas with its own number as their place: a reader that sees two numbers saw half of
/// a transaction.
#[test]
fn many_readers_see_one_revision_each_while_one_writes() {
    const REPLICAS: u32 = 300;
    const REVISIONS: u64 = 120;
    let dir = scratch();
    let mut store = open(dir.path());
    let write = |store: &mut Store| {
        let number = store.revision() + 1;
        let edits = (0..REPLICAS).fold(Edits::new(), |edits, n| {
            let (area_id, x) = (n % 7, number as f64);
            edits.put(&records::AreaObjects { area_id, repl_id: n, x, ..Default::default() })
        });
        store.apply(&edits, &change("ещё")).unwrap();
    };
    write(&mut store);
    let latest = std::sync::Mutex::new(store.reader());
    let is_done = std::sync::atomic::AtomicBool::new(false);
    let look = |reader: &orthoframe_store::Reader| {
        let all: Vec<records::AreaObjects> = reader.records(&Key::new()).unwrap();
        assert_eq!(all.len(), REPLICAS as usize);
        let own = reader.revision() as f64;
        let astray = all.iter().find(|r| (r.x - own).abs() > 0.0);
        assert!(astray.is_none(), "revision {own}: {astray:?}");
    };
    let seen: Vec<u64> = std::thread::scope(|scope| {
        let readers: Vec<_> = (0..4)
            .map(|_| {
                scope.spawn(|| {
                    let mut seen = Vec::new();
                    while !is_done.load(std::sync::atomic::Ordering::Acquire) {
                        let reader = latest.lock().unwrap().clone();
                        look(&reader);
                        // The same one again, when the writer has gone on.
                        std::thread::yield_now();
                        look(&reader);
                        seen.push(reader.revision());
                    }
                    seen
                })
            })
            .collect();
        for _ in 1..REVISIONS {
            write(&mut store);
            *latest.lock().unwrap() = store.reader();
        }
        is_done.store(true, std::sync::atomic::Ordering::Release);
        readers.into_iter().flat_map(|r| r.join().unwrap()).collect()
    });
    let different: std::collections::BTreeSet<u64> = seen.iter().copied().collect();
    assert!(different.len() > 5, "the readers read while the writer wrote: {different:?}");
    assert_eq!(store.revision(), REVISIONS);
}

#[test]
fn a_second_program_is_told_that_the_store_is_taken() {
    let dir = scratch();
    let store = open(dir.path());
    let Err(refused) = Store::open(dir.path()) else { panic!("opened twice") };
    assert!(matches!(refused, StoreError::Locked { .. }));
    assert!(refused.to_string().contains(&dir.path().display().to_string()));
    drop(store);
    open(dir.path());
}

#[test]
fn a_store_can_be_read_while_another_writes_it() {
    let dir = scratch();
    let mut store = open(dir.path());
    let map = world(4, 5);
    store.import(&map, &change("первая")).unwrap();
    let (mut other, _) = Store::open_read_only(dir.path()).unwrap();
    assert_eq!(load(&other), map);
    let refused = other.import(&world(5, 5), &change("вторая")).unwrap_err();
    assert!(matches!(refused, StoreError::ReadOnly { .. }));
    let missing = Store::open_read_only(dir.path().join("нет"));
    assert!(matches!(missing, Err(StoreError::Missing { .. })));
}

#[test]
fn what_is_no_store_is_left_alone() {
    let dir = scratch();
    std::fs::write(dir.path().join("письмо.txt"), "важное").unwrap();
    assert!(matches!(Store::open(dir.path()), Err(StoreError::NotAStore { .. })));
    assert_eq!(std::fs::read_dir(dir.path()).unwrap().count(), 1);

    let dir = scratch();
    drop(open(dir.path()));
    std::fs::write(dir.path().join("FORMAT"), "orthoframe store, format 9\n".repeat(2)).unwrap();
    let Err(refused) = Store::open(dir.path()) else { panic!("an unknown format was opened") };
    assert!(matches!(&refused, StoreError::UnknownFormat { found, known: 1, .. } if found == "9"));
}

/// A child shares its parent's files from its fork until it runs, the lock among them.
#[test]
fn a_closed_store_is_free_while_children_are_started() {
    let dir = scratch();
    let stop = std::sync::atomic::AtomicBool::new(false);
    std::thread::scope(|scope| {
        scope.spawn(|| {
            while !stop.load(std::sync::atomic::Ordering::Relaxed) {
                let _ = Command::new("true").status();
            }
        });
        // Neither refused nor, sled's lock being shared as well, built anew.
        let is_well = |opened: Result<(Store, OpenReport), StoreError>| {
            opened.is_ok_and(|(_, report)| report.tables_rebuilt.is_none())
        };
        let refused = (0..40).filter(|_| !is_well(Store::open(dir.path()))).count();
        stop.store(true, std::sync::atomic::Ordering::Relaxed);
        assert_eq!(refused, 0);
    });
}
