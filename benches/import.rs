//! Import of a campus: an osmAG text of many rooms into a checked World, and on into a store.
//!
//! `cargo bench -p benches --bench import`. The text is generated, the same each time. For the memory of one import:
//! `cargo bench -p benches --bench import -- --profile-time 1 "10000 rooms"` under `/usr/bin/time -v`.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::time::Duration;

use criterion::{BenchmarkId, Criterion, Throughput, criterion_group, criterion_main};
use orthoframe::Engine;
use orthoframe::engine::{Change, Timestamp};
use orthoframe_exchange::{Options, read};

/// Mean radius of the earth, m, as the reader takes it.
const EARTH: f64 = 6_371_008.8;
/// Rooms along each side of a corridor.
const ALONG: usize = 25;

/// An osmAG text: corridors of 100 m with 25 rooms on either side, each room with a passage; 10 corridors a building.
struct Campus {
    nodes: String,
    ways: String,
    count: usize,
}

impl Campus {
    fn of(rooms: usize) -> String {
        let mut campus = Self { nodes: String::new(), ways: String::new(), count: 0 };
        let columns = ((rooms / (2 * ALONG + 1)) as f64).sqrt() as usize + 1;
        let (mut made, mut block) = (0, 0);
        while made < rooms {
            let (x, y) = ((block % columns) as f64 * 102.0, (block / columns) as f64 * 12.0);
            let corridor = format!("COR-{block}");
            campus.area(&corridor, [x, y + 5.0, 100.0, 2.0]);
            made += 1;
            for side in 0..2 {
                for i in 0..ALONG.min(rooms - made) {
                    let name = format!("R-{block}-{side}-{i}");
                    let x = x + i as f64 * 4.0;
                    let wall = if side == 0 { y + 5.0 } else { y + 7.0 };
                    campus.area(&name, [x, if side == 0 { y } else { wall }, 4.0, 5.0]);
                    campus.passage(&corridor, &name, (x + 1.0, x + 2.0), wall);
                    made += 1;
                }
            }
            block += 1;
        }
        format!(
            "<?xml version=\"1.0\"?>\n<osm version=\"0.6\">\n{}{}</osm>\n",
            campus.nodes, campus.ways
        )
    }

    fn node(&mut self, x: f64, y: f64) -> usize {
        self.count += 1;
        let lat = 31.0 + (y / EARTH).to_degrees();
        let lon = 121.0 + (x / (EARTH * 31.0_f64.to_radians().cos())).to_degrees();
        writeln!(self.nodes, "<node id='{}' lat='{lat:.11}' lon='{lon:.11}'/>", self.count)
            .expect("a String takes all");
        self.count
    }

    fn way(&mut self, nodes: &[usize], tags: &[(&str, &str)]) {
        self.count += 1;
        let refs: String = nodes.iter().map(|n| format!("<nd ref='{n}'/>")).collect();
        let tags: String = tags.iter().map(|(k, v)| format!("<tag k='{k}' v='{v}'/>")).collect();
        writeln!(self.ways, "<way id='{}'>{refs}{tags}</way>", self.count)
            .expect("a String takes all");
    }

    fn area(&mut self, name: &str, [x, y, w, h]: [f64; 4]) {
        let corners = [(x, y), (x + w, y), (x + w, y + h), (x, y + h)];
        let nodes = corners.map(|(x, y)| self.node(x, y));
        let tags =
            [("osmAG:type", "area"), ("osmAG:areaType", "room"), ("level", "1"), ("name", name)];
        self.way(&nodes, &tags);
    }

    fn passage(&mut self, from: &str, to: &str, (x0, x1): (f64, f64), y: f64) {
        let nodes = [self.node(x0, y), self.node(x1, y)];
        let tags =
            [("osmAG:type", "passage"), ("osmAG:from", from), ("osmAG:to", to), ("level", "1")];
        self.way(&nodes, &tags);
    }
}

fn campus_file(dir: &Path, rooms: usize) -> PathBuf {
    let path = dir.join(format!("campus-{rooms}.osm"));
    std::fs::write(&path, Campus::of(rooms)).expect("a file in a temporary directory");
    path
}

fn import(c: &mut Criterion) {
    let dir = tempfile::tempdir().expect("a temporary directory");
    let mut group = c.benchmark_group("import");
    group.sample_size(10).measurement_time(Duration::from_secs(20));
    for rooms in [1_000, 10_000] {
        let path = campus_file(dir.path(), rooms);
        let world = read(&path, &Options::default()).expect("a sound campus").world;
        assert_eq!(world.areas.len(), rooms);
        group.throughput(Throughput::Elements(rooms as u64));
        group.bench_function(BenchmarkId::new("read and check", format!("{rooms} rooms")), |b| {
            b.iter_with_large_drop(|| read(&path, &Options::default()));
        });
        group.bench_function(BenchmarkId::new("into a new store", format!("{rooms} rooms")), |b| {
            b.iter_with_large_drop(|| {
                let store = tempfile::tempdir().expect("a temporary directory");
                let mut engine = Engine::open(&store.path().join("s"), None).expect("a new store");
                let change = Change::new("bench", Timestamp(0), "bench");
                engine.import(&path, &change).expect("a sound campus");
                (engine, store)
            });
        });
    }
    group.finish();
}

criterion_group!(benches, import);
criterion_main!(benches);
