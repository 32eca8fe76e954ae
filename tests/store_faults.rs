//! A program that writes a store is killed without warning, again and again; what it acknowledged is there.
//!
//! A few rounds run with all tests; `tests/faults/kill9.sh` runs hundreds, `tests/faults/full-disk.sh` lets the
//! disk fill up under the writer.

use std::io::{BufRead, BufReader, Write};
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use orthoframe_store::{Change, Edits, Key, Store, StoreError, Timestamp, records::AreaObjects};

use crate::store_world::Dice;

fn replica(revision: u64, n: u32) -> AreaObjects {
    AreaObjects {
        area_id: n % 5,
        repl_id: n,
        x: revision as f64,
        name: format!("Стул {n} после правки {revision}"),
        ..AreaObjects::default()
    }
}

/// The replicas that a revision writes: another window each time, and every third is too large for one of
/// sled's transactions.
fn batch(revision: u64) -> impl Iterator<Item = AreaObjects> {
    let first = (revision * 13 % 160) as u32;
    let count = if revision.is_multiple_of(3) { 160 } else { 40 };
    (first..first + count).map(move |n| replica(revision, n))
}

/// The writer: says each revision once it is acknowledged, until it is killed or cannot write.
fn write_until_killed(dir: &Path) -> StoreError {
    let (mut store, _) = Store::open(dir).expect("the store opens");
    let say = |text: String| {
        // Past the capture of the test harness, and at once.
        let mut out = std::io::stdout().lock();
        out.write_all(text.as_bytes()).and_then(|()| out.flush()).expect("someone listens");
    };
    say(format!("open {}\n", store.revision()));
    loop {
        let revision = store.revision() + 1;
        let edits = batch(revision).fold(Edits::new(), |edits, r| edits.put(&r));
        let change = Change::new("писатель", Timestamp(revision as i64), "ещё");
        match store.apply(&edits, &change) {
            Ok(report) => say(format!("done {}\n", report.revision)),
            Err(error) => return error,
        }
        if revision.is_multiple_of(37)
            && let Err(error) = store.checkpoint()
        {
            return error;
        }
    }
}

/// No test of its own: the program that is killed.
#[test]
fn writer() {
    if let Some(dir) = std::env::var_os("STORE_WRITER") {
        let error = write_until_killed(Path::new(&dir));
        eprintln!("writer stopped: {error}");
        let _ = std::io::stdout().write_all(format!("stopped {error}\n").as_bytes());
    }
}

fn spawn(dir: &Path) -> Child {
    Command::new(std::env::current_exe().expect("the test binary has a path"))
        .args(["--exact", "store_faults::writer"])
        .env("STORE_WRITER", dir)
        .stdout(Stdio::piped())
        .stderr(Stdio::null())
        .spawn()
        .expect("the test binary runs")
}

/// The last revision that a writer said to be done.
fn acknowledged(child: &mut Child) -> u64 {
    last_done(child.stdout.take().expect("the output is piped"))
}

fn last_done(out: impl std::io::Read) -> u64 {
    let lines = BufReader::new(out).lines().map_while(Result::ok);
    lines.filter_map(|l| l.strip_prefix("done ")?.trim().parse().ok()).last().unwrap_or(0)
}

/// Every record is as the last revision that wrote it left it.
fn check(store: &Store) {
    let revision = store.revision();
    let mut expected = std::collections::BTreeMap::new();
    for r in 1..=revision {
        expected.extend(batch(r).map(|record| (record.repl_id, record)));
    }
    let found = store.reader().records::<AreaObjects>(&Key::new()).expect("every record is whole");
    let found: std::collections::BTreeMap<_, _> =
        found.into_iter().map(|r| (r.repl_id, r)).collect();
    assert_eq!(found, expected, "after revision {revision}");
    assert_eq!(store.revisions().expect("the list is whole").len() as u64, revision);
}

fn rounds(name: &str, usual: u64) -> u64 {
    std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(usual)
}

#[test]
fn what_was_acknowledged_outlives_the_writer() {
    let dir = tempfile::tempdir().unwrap();
    let mut dice = Dice::new(9);
    let (mut known, mut replayed, mut torn) = (0, 0, 0);
    for round in 0..rounds("STORE_KILLS", 4) {
        let mut child = spawn(dir.path());
        // Some are killed while they still recover from the last time, some when sled has begun to follow.
        let most = if dice.roll(6) == 0 { 900 } else { 160 };
        std::thread::sleep(Duration::from_millis(dice.roll(most)));
        child.kill().expect("the writer can be killed");
        known = acknowledged(&mut child).max(known);
        child.wait().expect("the writer ends");
        if dice.roll(3) == 0 {
            continue;
        }
        let (store, report) = Store::open(dir.path()).expect("the store opens after a kill");
        assert!(store.revision() >= known, "round {round}: {known} was acknowledged");
        check(&store);
        known = store.revision();
        replayed += report.replayed;
        torn += u64::from(report.torn_bytes > 0);
    }
    let (store, _) = Store::open(dir.path()).unwrap();
    assert!(store.revision() >= known);
    check(&store);
    eprintln!("{known} transactions, {replayed} replayed, {torn} torn tails");
}

/// Run by `tests/faults/full-disk.sh`, which limits the size of files.
#[test]
fn a_full_disk_stops_the_writer_and_costs_nothing() {
    let Some(dir) = std::env::var_os("STORE_FULL_DISK") else { return };
    let mut child = spawn(Path::new(&dir));
    let known = acknowledged(&mut child);
    child.wait().expect("the writer ends by itself");
    eprintln!("the writer stopped after {known} transactions");
    assert!(known > 0);
    let (store, _) = Store::open_read_only(&dir).expect("the store can be read");
    assert!(store.revision() >= known);
    check(&store);
}

/// No file may grow beyond a limit, as on a disk without room: sled, which takes the most, fails first, and may hang.
/// Whatever it does, the writer ends by itself once its journal is full, and all that it acknowledged is there.
#[cfg(unix)]
#[test]
fn a_writer_without_room_ends_and_loses_nothing() {
    for kib in [100, 400] {
        let dir = tempfile::tempdir().unwrap();
        let limited = format!("trap '' XFSZ; ulimit -f {}; exec \"$0\" \"$@\"", kib * 2);
        let mut child = Command::new("sh")
            .args(["-c", &limited])
            .arg(std::env::current_exe().expect("the test binary has a path"))
            .args(["--exact", "store_faults::writer"])
            .env("STORE_WRITER", dir.path())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .expect("a shell is there");
        let begin = std::time::Instant::now();
        let out = child.stdout.take().expect("the output is piped");
        let listener = std::thread::spawn(move || last_done(out));
        while child.try_wait().expect("a child can be asked").is_none() {
            if begin.elapsed() > Duration::from_secs(100) {
                child.kill().expect("the writer can be killed");
                panic!("{kib} KiB: the writer hangs");
            }
            std::thread::sleep(Duration::from_millis(20));
        }
        let known = listener.join().expect("the listener ends with the writer");
        assert!(known > 0, "{kib} KiB");
        let (store, _) = Store::open_read_only(dir.path()).expect("the store can be read");
        assert!(store.revision() >= known, "{kib} KiB");
        check(&store);
        drop(store);
        let (store, _) = Store::open(dir.path()).expect("there is room again");
        check(&store);
    }
}

/// sled waits for ever while it is opened, for a pipe that stands where a file of its own should be.
#[cfg(unix)]
#[test]
fn a_sled_that_never_opens_is_left_alone() {
    let dir = tempfile::tempdir().unwrap();
    let write = |store: &mut Store| {
        let revision = store.revision() + 1;
        let edits = batch(revision).fold(Edits::new(), |edits, r| edits.put(&r));
        let change = Change::new("писатель", Timestamp(revision as i64), "ещё");
        store.apply(&edits, &change).expect("the journal takes it");
    };
    write(&mut Store::open(dir.path()).unwrap().0);
    let conf = dir.path().join("sled").join("conf");
    std::fs::remove_file(&conf).expect("sled has this file");
    assert!(Command::new("mkfifo").arg(&conf).status().unwrap().success());
    for round in 1..4 {
        let begin = std::time::Instant::now();
        let (mut store, report) = Store::open(dir.path()).expect("the journal is whole");
        check(&store);
        assert_eq!(store.revision(), round);
        assert!(report.tables_off.is_some(), "{report:?}");
        write(&mut store);
        drop(store);
        assert!(begin.elapsed() < Duration::from_secs(60));
    }
    // Another program begins with a new sled.
    let checker = Command::new(std::env::current_exe().unwrap())
        .args(["--exact", "store_faults::checker", "--nocapture"])
        .env("STORE_CHECK", dir.path())
        .env("STORE_KNOWN", "4")
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&checker.stderr);
    assert!(checker.status.success(), "{said}");
    assert!(said.contains("tables_off: None"), "{said}");
}

/// Run by the scripts after a fault: opens the store of `STORE_CHECK`, which must be at `STORE_KNOWN` at least.
#[test]
fn checker() {
    let Some(dir) = std::env::var_os("STORE_CHECK") else { return };
    let known: u64 = std::env::var("STORE_KNOWN").ok().and_then(|n| n.parse().ok()).unwrap_or(0);
    let (store, report) = Store::open(&dir).expect("the store opens");
    eprintln!("at {} of {known} known: {report:?}", store.revision());
    assert!(store.revision() >= known, "{known} was acknowledged");
    check(&store);
}
