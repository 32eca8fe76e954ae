//! The store: 100 000 records in durable batches, one durable edit, opening with full verification, a Fragment.
//!
//! `cargo bench -p benches --bench store` measures the store's own work with criterion;
//! `cargo bench -p benches --bench store -- --quick-table` prints the table of `docs/reliability.md`, in which
//! SQLite (WAL, synchronous=FULL) does the same work in the same run, turn by turn, on the same disk. The directory is
//! taken from `ORTHO_BENCH_DIR`, or the target directory, since /tmp may be in memory.
//!
//! `cargo bench -p benches --bench store -- --years [OBSERVATIONS EDITS]` makes a store of ten years of a robot (10 000 000 and 100 000,
//! of a hospital of 40 000 things) and opens it, each time in a process of its own.

#[path = "store/sqlite.rs"]
mod sqlite;

use std::path::PathBuf;
use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use criterion::Criterion;
use orthoframe_store::{
    Change, Edits, Key, Observation, Seen, Store, Timestamp, records::AreaObjects,
};
use orthoframe_units::{AreaId, Deg, Frame, ReplicaId};

const RECORDS: u32 = 100_000;
const BATCH: usize = 1000;
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

fn moved(n: u32) -> AreaObjects {
    AreaObjects { x: f64::from(n) + 0.5, y: 1.0 + f64::from(n), ..replica(n) }
}

fn change() -> Change {
    Change::new("Мастер", Timestamp(1_790_000_000_000), "замер")
}

/// Writes records that are there already, as the work of SQLite is measured too.
fn fill(store: &mut Store, records: &[AreaObjects]) {
    for batch in records.chunks(BATCH) {
        let edits = batch.iter().fold(Edits::new(), Edits::put);
        store.apply(&edits, &change()).expect("the disk has room");
    }
}

fn edit(store: &mut Store, n: u32) {
    store.apply(&Edits::new().put(&moved(n)), &change()).expect("the disk has room");
}

/// Replicas in no order that a cache would like.
fn leaps() -> impl Iterator<Item = u32> {
    (1..).map(|turn: u64| u32::try_from(turn * 7919 % u64::from(RECORDS)).expect("below RECORDS"))
}

fn store(c: &mut Criterion) {
    let records: Vec<AreaObjects> = (0..RECORDS).map(replica).collect();
    let mut group = c.benchmark_group("store");
    group.sample_size(10).measurement_time(Duration::from_secs(5));
    let dir = scratch();
    let mut store = Store::open(dir.path()).expect("a new store").0;
    fill(&mut store, &records);
    let mut leaps = leaps();
    let mut next = || leaps.next().expect("without end");
    group.bench_function("one durable edit", |b| b.iter(|| edit(&mut store, next())));
    group.bench_function("a Fragment of 20 replicas", |b| {
        b.iter(|| store.fragment(AreaId(next() / FRAGMENT)).expect("whole records").len())
    });
    group.bench_function("its records alone", |b| {
        b.iter(|| {
            let prefix = Key::new().id(next() / FRAGMENT);
            let found = store.reader().records::<AreaObjects>(&prefix);
            found.expect("whole records").len()
        });
    });
    drop(store);
    group.bench_function("open 100 000 records, all verified", |b| {
        b.iter_custom(|times| (0..times).map(|_| open(dir.path()).0).sum());
    });
    group.finish();
}

/// Time on the clock and of the processor of one opening.
fn open(path: &std::path::Path) -> (Duration, Duration) {
    let (clock, cpu) = (Instant::now(), ProcessTime::now());
    let (store, report) = Store::open(path).expect("the store is whole");
    let spent = (clock.elapsed(), cpu.elapsed());
    assert!(report.records > u64::from(RECORDS) && report.tables_rebuilt.is_none());
    drop(store);
    spent
}

fn timed(work: impl FnOnce()) -> (Duration, Duration) {
    let (clock, cpu) = (Instant::now(), ProcessTime::now());
    work();
    (clock.elapsed(), cpu.elapsed())
}

/// Least and middle of times on the clock, and the middle of the processor's.
fn summary(times: &mut [(Duration, Duration)]) -> [Duration; 3] {
    times.sort();
    let [least, middle] = [times[0].0, times[times.len() / 2].0];
    times.sort_by_key(|&(_, cpu)| cpu);
    [least, middle, times[times.len() / 2].1]
}

#[expect(clippy::print_stdout, reason = "a table on the terminal")]
fn row(work: &str, ours: &mut [(Duration, Duration)], theirs: &mut [(Duration, Duration)]) {
    let shown = |[least, middle, cpu]: [Duration; 3]| {
        let ms = |time: Duration| time.as_secs_f64() * 1e3;
        format!("{:.3} / {:.3} | {:.3}", ms(least), ms(middle), ms(cpu))
    };
    let ours = summary(ours);
    if theirs.is_empty() {
        return println!("| {work} | {} | – | – | – |", shown(ours));
    }
    let theirs = summary(theirs);
    let ratio = ours[1].as_secs_f64() / theirs[1].as_secs_f64();
    println!("| {work} | {} | {} | {ratio:.2} |", shown(ours), shown(theirs));
}

/// Both stores do each piece of work in turn, so that what else the machine does falls on both.
#[expect(clippy::print_stdout, reason = "a table on the terminal")]
fn table() {
    const ROUNDS: usize = 7;
    const EDITS: usize = 400;
    let records: Vec<AreaObjects> = (0..RECORDS).map(replica).collect();
    println!(
        "| work | store: ms, least / median | CPU | SQLite: ms, least / median | CPU | ratio of medians |"
    );
    println!("|---|---|---|---|---|---|");

    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for _ in 0..ROUNDS {
        {
            let dir = scratch();
            let db = sqlite::open(dir.path());
            theirs.push(timed(|| sqlite::fill(&db, &records)));
        }
        let dir = scratch();
        let mut store = Store::open(dir.path()).expect("a new store").0;
        ours.push(timed(|| fill(&mut store, &records)));
    }
    row("100 000 records of 200 B in 100 durable batches", &mut ours, &mut theirs);

    let dir = scratch();
    let mut store = Store::open(dir.path()).expect("a new store").0;
    fill(&mut store, &records);
    let peer_dir = scratch();
    let db = sqlite::open(peer_dir.path());
    sqlite::fill(&db, &records);
    let (mut their_edit, mut their_fragment) = (sqlite::edit(&db), sqlite::fragment(&db));
    // What follows the import, in sled and in SQLite's journal, is not this edit's.
    std::thread::sleep(Duration::from_secs(5));
    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for n in leaps().take(EDITS) {
        theirs.push(timed(|| their_edit(&moved(n))));
        ours.push(timed(|| edit(&mut store, n)));
    }
    row("one durable edit", &mut ours, &mut theirs);

    let (mut ours, mut theirs) = (Vec::new(), Vec::new());
    for n in leaps().take(20 * EDITS) {
        theirs.push(timed(|| assert_eq!(their_fragment(n / FRAGMENT), FRAGMENT as usize)));
        ours.push(timed(|| {
            let prefix = Key::new().id(n / FRAGMENT);
            let found = store.reader().records::<AreaObjects>(&prefix).expect("whole records");
            assert_eq!(found.len(), FRAGMENT as usize);
        }));
    }
    row("20 records of a Fragment", &mut ours, &mut theirs);
    drop(store);
    let mut ours: Vec<_> = (0..ROUNDS).map(|_| open(dir.path())).collect();
    row("opening 100 000 records, all verified", &mut ours, &mut []);
}

/// Things of the building in which a robot worked for years.
const THINGS: u32 = 40_000;

/// What the robot saw next: things one after the other, a little off where they were.
fn look(n: u32) -> Observation {
    let thing = replica(n.wrapping_mul(7919) % THINGS);
    let frame = Frame::new(thing.x + f64::from(n % 5), thing.y, 0.0, Deg::of(thing.ang));
    Observation {
        replica: ReplicaId(thing.repl_id),
        at: Timestamp(1_790_000_000_000 + i64::from(n) * 31_000),
        seen: Some(Seen { area: AreaId(thing.area_id), frame }),
        sure: 0.9,
        observer: "робот".to_owned(),
    }
}

/// Makes the store of years, or goes on with it where a run before ended.
#[expect(clippy::print_stdout, reason = "a table on the terminal")]
fn live(dir: &std::path::Path, observations: u32, edits: u32) {
    const AT_ONCE: u32 = 5_000;
    let clock = (Instant::now(), ProcessTime::now());
    let mut store = Store::open(dir).expect("a new store").0;
    let records: Vec<AreaObjects> = (0..THINGS).map(replica).collect();
    fill(&mut store, &records);
    let share = edits.div_ceil(observations.div_ceil(AT_ONCE));
    let (mut seen, mut edited) = (0, 0);
    while seen < observations {
        let next: Vec<_> = (seen..observations.min(seen + AT_ONCE)).map(look).collect();
        store.observe(&next).expect("the disk has room");
        seen += AT_ONCE;
        for _ in 0..share.min(edits - edited) {
            let n = edited.wrapping_mul(104_729) % THINGS;
            let place = AreaObjects { x: f64::from(edited), ..replica(n) };
            store.apply(&Edits::new().put(&place), &change()).expect("the disk has room");
            edited += 1;
        }
    }
    let spent = (clock.0.elapsed().as_secs_f64(), clock.1.elapsed().as_secs_f64());
    println!(
        "{seen} observations and {edited} edits of {THINGS} things noted in {:.0} s, {:.0} s of processor time",
        spent.0, spent.1
    );
}

/// The most memory that this process held, in MB.
fn most_memory() -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
    let kb = line.and_then(|line| line.split_whitespace().next()?.parse::<f64>().ok());
    kb.unwrap_or(f64::NAN) / 1024.0
}

/// Opens a store and asks it something of long ago; tells what that took.
#[expect(clippy::print_stdout, reason = "a table on the terminal")]
fn look_back(dir: &std::path::Path) {
    let clock = (Instant::now(), ProcessTime::now());
    let (store, report) = Store::open(dir).expect("the store is whole");
    let opened = (clock.0.elapsed(), clock.1.elapsed(), most_memory());
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    println!(
        "opened in {:.0} ms, {:.0} ms of processor time, {:.0} MB; {} frames replayed",
        ms(opened.0),
        ms(opened.1),
        opened.2,
        report.replayed
    );
    let of = ReplicaId(replica(7919 % THINGS).repl_id);
    let clock = Instant::now();
    let seen = store.reader().observations(of).expect("whole records").len();
    println!("all {seen} observations of one thing: {:.2} ms", ms(clock.elapsed()));
    let clock = Instant::now();
    let story = store.reader().replica_history(of).expect("whole records").len();
    println!("its {story} places on the map: {:.2} ms", ms(clock.elapsed()));
    let clock = Instant::now();
    let revisions = store.revisions().expect("whole records").len();
    println!("the list of {revisions} revisions: {:.0} ms", ms(clock.elapsed()));
    let clock = Instant::now();
    let known = store.reader().observed().expect("whole records").len();
    println!(
        "the {known} things that were seen: {:.0} ms; {:.0} MB",
        ms(clock.elapsed()),
        most_memory()
    );
}

/// Ten years of a robot.
#[expect(clippy::print_stdout, reason = "a table on the terminal")]
fn years(numbers: &[u32]) {
    let (observations, edits) = match numbers {
        [observations, edits, ..] => (*observations, *edits),
        _ => (10_000_000, 100_000),
    };
    let dir = scratch();
    let own = std::env::current_exe().expect("this program has a file");
    let run = |what: &str| {
        let mut child = std::process::Command::new(&own);
        child.args([what, &dir.path().display().to_string()]);
        child.args([observations.to_string(), edits.to_string()]);
        assert!(child.status().expect("it starts").success());
    };
    run("--live");
    let size = |dir: PathBuf| -> u64 {
        let entries = std::fs::read_dir(dir).into_iter().flatten().flatten();
        entries.filter_map(|entry| Some(entry.metadata().ok()?.len())).sum()
    };
    for part in ["journal", "snapshots", "past", "sled"] {
        println!("{part}: {} MB", size(dir.path().join(part)) >> 20);
    }
    (0..3).for_each(|_| run("--look-back"));
}

fn main() {
    let args: Vec<String> = std::env::args().collect();
    let numbers: Vec<u32> = args.iter().filter_map(|arg| arg.parse().ok()).collect();
    let dir = || PathBuf::from(args.get(2).expect("a directory"));
    match args.get(1).map(String::as_str) {
        Some("--live") => return live(&dir(), numbers[0], numbers[1]),
        Some("--look-back") => return look_back(&dir()),
        _ if args.iter().any(|arg| arg == "--years") => return years(&numbers),
        _ => {}
    }
    if std::env::args().any(|arg| arg == "--quick-table") {
        return table();
    }
    let mut criterion = Criterion::default().configure_from_args();
    store(&mut criterion);
    criterion.final_summary();
}
