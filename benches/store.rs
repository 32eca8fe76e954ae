//! The store: 100 000 records in durable batches, one durable edit, opening with full verification, a Fragment.
//!
//! `benches/store-sqlite.py` does the same with SQLite (WAL, synchronous=FULL) on the same disk; the directory
//! is taken from `ORTHO_BENCH_DIR`, or the target directory, since /tmp may be in memory.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use criterion::{BatchSize, Criterion, criterion_group, criterion_main};
use orthoframe::store::{Change, Edits, Store, Timestamp, records::AreaObjects};
use orthoframe::units::AreaId;

const RECORDS: u32 = 100_000;
const BATCH: u32 = 1000;
/// Replicas of one Fragment.
const FRAGMENT: u32 = 20;

fn scratch() -> tempfile::TempDir {
    let base = std::env::var_os("ORTHO_BENCH_DIR")
        .map_or_else(|| PathBuf::from(env!("CARGO_TARGET_TMPDIR")), PathBuf::from);
    tempfile::tempdir_in(base).expect("a temporary directory")
}

/// About 200 bytes, as in the measurement of peers.
fn replica(n: u32) -> AreaObjects {
    AreaObjects {
        area_id: n / FRAGMENT,
        object_id: n % 7,
        repl_id: n,
        x: f64::from(n) * 0.37,
        y: f64::from(n) * 0.11,
        ang: f64::from(n % 4) * 90.0,
        move_prob: n % 101,
        name: format!("Стул номер {n} у окна в комнате для совещаний"),
        name_en: format!("Chair number {n} at the window of the meeting room"),
        ..AreaObjects::default()
    }
}

fn change() -> Change {
    Change::new("Мастер", Timestamp(1_790_000_000_000), "замер")
}

/// Writes records that are there already, as the work of SQLite is measured too.
fn fill(store: &mut Store, records: &[AreaObjects]) {
    for batch in records.chunks(BATCH as usize) {
        let edits = batch.iter().fold(Edits::new(), Edits::put);
        store.apply(&edits, &change()).expect("the disk has room");
    }
}

fn store(c: &mut Criterion) {
    let records: Vec<AreaObjects> = (0..RECORDS).map(replica).collect();
    let mut group = c.benchmark_group("store");
    group.sample_size(10).measurement_time(Duration::from_secs(15));
    group.bench_function("100 000 records in 100 durable batches", |b| {
        b.iter_batched(
            || {
                let dir = scratch();
                let store = Store::open(dir.path()).expect("a new store").0;
                (dir, store)
            },
            |(dir, mut store)| {
                fill(&mut store, &records);
                (dir, store)
            },
            BatchSize::PerIteration,
        );
    });

    let dir = scratch();
    let mut store = Store::open(dir.path()).expect("a new store").0;
    fill(&mut store, &records);
    let mut n = 0;
    group.bench_function("one durable edit", |b| {
        b.iter(|| {
            n = (n + 7919) % RECORDS;
            let moved = AreaObjects { x: f64::from(n) + 0.5, y: 1.0 + f64::from(n), ..replica(n) };
            store.apply(&Edits::new().put(&moved), &change()).expect("the disk has room")
        });
    });
    group.bench_function("a Fragment of 20 replicas", |b| {
        b.iter(|| {
            n = (n + 7919) % RECORDS;
            store.fragment(AreaId(n / FRAGMENT)).expect("the records are whole").len()
        });
    });
    group.bench_function("its records alone", |b| {
        b.iter(|| {
            n = (n + 7919) % RECORDS;
            let prefix = orthoframe::store::Key::new().id(n / FRAGMENT);
            let found = store.reader().records::<AreaObjects>(&prefix);
            found.expect("the records are whole").len()
        });
    });
    drop(store);
    group.bench_function("open 100 000 records, all verified", |b| {
        b.iter_custom(|times| {
            let mut spent = Duration::ZERO;
            for _ in 0..times {
                let start = Instant::now();
                let (store, report) = Store::open(dir.path()).expect("the store is whole");
                spent += start.elapsed();
                assert!(report.records > u64::from(RECORDS) && report.tables_rebuilt.is_none());
                drop(store);
            }
            spent
        });
    });
    group.finish();
}

criterion_group!(benches, store);
criterion_main!(benches);
