//! Free floor and routes on generated floors, beside Recast and polyanya in the same run.
//!
//! `cargo bench -p benches --bench floor [-- NAME]` prints four tables: building, memory, asking the way, rebuilding after a move.
//! Every program does its part of a floor in a process of its own, so that memory is told apart. Builds are medians,
//! of the processor's time of all threads together and on the clock; a query is the least of five on the clock.
//! With `DETOUR` set to a command (`floor/detour.cpp` or `floor/detour.mjs`, which say how they are run), Recast and
//! Detour themselves take part; `-- --write NAME FILE` writes what they are given.
//! `-- --build NAME` (also `flat-80-long`, for a robot of 80 by 36 cm) builds one floor of ours over and over, `-- --ask NAME` asks the way on it, for a profiler.
#![allow(clippy::print_stdout, reason = "a benchmark's product is its table")]

#[path = "../tests/floors.rs"]
#[allow(dead_code, reason = "shared with the tests")]
mod floors;
#[path = "floor/generated.rs"]
mod generated;
#[path = "floor/optimum.rs"]
mod optimum;
#[path = "floor/peers.rs"]
mod peers;

use std::collections::BTreeMap;
use std::fmt::Write;
use std::hint::black_box;
use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use cpu_time::ProcessTime;
use generated::{Generated, building, room};
use orthoframe_geometry::{DoorStates, FloorPlan, Method, Target};
use orthoframe_map::World;
use orthoframe_units::{Cm, Deg, Frame, MapId, Point, ReplicaId};

const FLOORS: [&str; 4] = ["room-20", "flat-80", "office-3000", "hospital-40000"];
const RADIUS: f64 = 20.0;
const QUERIES: usize = 200;

fn floor(name: &str) -> Generated {
    let mut floor = match name {
        "room-20" => room(20),
        "flat-80" | "flat-80-long" => building(1, 3, 13),
        "office-3000" => building(4, 25, 15),
        _ => building(20, 50, 20),
    };
    let world = &mut floor.builder.world;
    world.robot.radius = Cm::of(RADIUS);
    if name.ends_with("-long") {
        let corners = [(-40.0, -18.0), (40.0, -18.0), (40.0, 18.0), (-40.0, 18.0)];
        world.robot.footprint = corners.map(|(x, y)| Point::new(x, y)).to_vec();
        world.robot.radius = Cm::of(43.87);
    }
    // Filled at once, as when they are read from a store, maps have no gaps.
    world.objects = std::mem::take(&mut world.objects).into_iter().collect();
    world.orthoframes = std::mem::take(&mut world.orthoframes).into_iter().collect();
    world.replicas = std::mem::take(&mut world.replicas).into_iter().collect();
    floor
}

fn plan(world: &World) -> FloorPlan {
    FloorPlan::build(world, MapId(1), &world.robot, &DoorStates::new())
}

fn main() {
    let arguments: Vec<String> = std::env::args().skip(1).filter(|a| a != "--bench").collect();
    let arguments: Vec<&str> = arguments.iter().map(String::as_str).collect();
    match arguments[..] {
        ["--alone", program, name] => alone(program, name),
        ["--write", name, file] => write(name, Path::new(file)).expect("the file can be written"),
        ["--build", name] => {
            let floor = floor(name);
            (0..10).for_each(|_| drop(black_box(plan(&floor.builder.world))));
        }
        ["--ask", name] => {
            let floor = floor(name);
            let (plan, pairs) = (plan(&floor.builder.world), floor.pairs(QUERIES, RADIUS));
            let joined = |(from, to): &&(Point, Point)| plan.are_joined(*from, *to);
            for (from, to) in (0..400).flat_map(|_| pairs.iter().filter(joined)) {
                let to = Target::Point(*to);
                let _ = black_box(plan.route(&floor.builder.world, *from, to, Method::Shortest));
            }
        }
        _ => tables(arguments.first().copied().unwrap_or_default()),
    }
}

/// What a child told of one program on one floor.
#[derive(Default)]
struct Told {
    numbers: BTreeMap<String, f64>,
    /// By query: µs and cm.
    ways: BTreeMap<usize, (f64, f64)>,
}

impl Told {
    fn by(program: &str, name: &str) -> Self {
        let own = std::env::current_exe().expect("a program knows its place");
        Self::of(Command::new(own).args(["--alone", program, name]))
    }

    /// What Recast and Detour themselves tell, if there is a command to run them.
    fn by_detour(name: &str) -> Self {
        let Ok(command) = std::env::var("DETOUR") else { return Self::default() };
        let file = tempfile::NamedTempFile::new().expect("a file can be made");
        write(name, file.path()).expect("the file can be written");
        Self::of(Command::new("sh").args(["-c", &format!("{command} \"$0\"")]).arg(file.path()))
    }

    fn of(command: &mut Command) -> Self {
        let run = command.output().expect("it runs");
        let mut told = Self::default();
        for line in String::from_utf8_lossy(&run.stdout).lines() {
            let fields: Vec<&str> = line.split('\t').collect();
            let number = |k: usize| fields.get(k).and_then(|f: &&str| f.parse::<f64>().ok());
            match (fields[0], number(1), number(2), number(3)) {
                ("way", Some(i), Some(time), Some(length)) => {
                    told.ways.insert(i as usize, (time, length));
                }
                (key, Some(value), ..) => {
                    told.numbers.insert(key.to_owned(), value);
                }
                _ => {}
            }
        }
        told
    }

    fn shown(&self, key: &str, digits: usize) -> String {
        self.numbers.get(key).map_or("–".to_owned(), |v| format!("{v:.digits$}"))
    }

    fn times(&self) -> Vec<f64> {
        let mut times: Vec<f64> = self.ways.values().map(|w| w.0).collect();
        times.sort_by(f64::total_cmp);
        times
    }
}

fn ratio(above: Option<&f64>, below: Option<&f64>) -> String {
    above.zip(below).map_or("–".to_owned(), |(a, b)| format!("{:.1}", a / b))
}

fn tables(wanted: &str) {
    let mut build = String::from(
        "| floor | build, ms (on the clock) | Recast, ms (on the clock; without detail mesh) | times faster | on the clock | Recast itself, ms (on the clock) | times faster | polyanya, ms | Passframes | Recast's polygons |\n|---|---|---|---|---|---|---|---|---|---|\n",
    );
    let mut memory = String::from(
        "| floor | before building, MB | peak | after | a second floor adds | Recast: before | peak | after | a second adds | Recast itself: before | peak | after | a second adds |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    let mut query = String::from(
        "| floor | ways | median, µs | p99 | polyanya, median | p99 | Detour, median | p99 | our median of it | over the optimum: mean | worst | polyanya's mean | Detour's mean |\n|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
    );
    let mut rebuild = String::from("| floor | rebuild, ms: median | worst |\n|---|---|---|\n");
    for name in FLOORS.into_iter().filter(|n| n.contains(wanted)) {
        let [ours, recast, polyanya, least] =
            ["ours", "recast", "polyanya", "optimum"].map(|program| Told::by(program, name));
        let detour = Told::by_detour(name);
        let faster = |peer: &Told, key: &str| ratio(peer.numbers.get(key), ours.numbers.get(key));
        let _ = writeln!(
            build,
            "| {name} | {} ({}) | {} ({}; {}) | {} | {} | {} ({}) | {} | {} | {} | {} |",
            ours.shown("build", 2),
            ours.shown("clock", 2),
            recast.shown("build", 1),
            recast.shown("clock", 1),
            recast.shown("bare", 1),
            faster(&recast, "build"),
            faster(&recast, "clock"),
            detour.shown("build", 1),
            detour.shown("clock", 1),
            faster(&detour, "build"),
            polyanya.shown("build", 1),
            ours.shown("cells", 0),
            recast.shown("cells", 0),
        );
        let held = |told: &Told| {
            ["before", "peak", "after", "kept"].map(|key| told.shown(key, 0)).join(" | ")
        };
        let _ = writeln!(
            memory,
            "| {name} | {} | {} | {} |",
            held(&ours),
            held(&recast),
            held(&detour)
        );
        let [own, other, theirs] = [&ours, &polyanya, &detour].map(Told::times);
        let at =
            |times: &[f64], share: f64| times.get((times.len() as f64 * share) as usize).copied();
        let shown = |value: Option<f64>| value.map_or("–".to_owned(), |v| format!("{v:.1}"));
        let over = |told: &Told| {
            let shares: Vec<f64> = least
                .ways
                .iter()
                .filter_map(|(i, (_, least))| Some(told.ways.get(i)?.1 / least))
                .collect();
            let mean = shares.iter().sum::<f64>() / shares.len().max(1) as f64;
            (mean, shares.into_iter().fold(0.0, f64::max))
        };
        let _ = writeln!(
            query,
            "| {name} | {} | {} | {} | {} | {} | {} | {} | {} | {:.5} | {:.5} | {:.5} | {:.5} |",
            own.len(),
            shown(at(&own, 0.5)),
            shown(at(&own, 0.99)),
            shown(at(&other, 0.5)),
            shown(at(&other, 0.99)),
            shown(at(&theirs, 0.5)),
            shown(at(&theirs, 0.99)),
            at(&own, 0.5)
                .zip(at(&theirs, 0.5))
                .map_or("–".to_owned(), |(ours, theirs)| format!("{:.2}", ours / theirs)),
            over(&ours).0,
            over(&ours).1,
            over(&polyanya).0,
            over(&detour).0,
        );
        let _ = writeln!(
            rebuild,
            "| {name} | {} | {} |",
            ours.shown("rebuild", 2),
            ours.shown("rebuild worst", 2)
        );
    }
    println!("{build}\n{memory}\n{query}\n{rebuild}");
}

/// One program on one floor; tells what it found in lines of numbers.
fn alone(program: &str, name: &str) {
    let mut floor = floor(name);
    let pairs = floor.pairs(QUERIES, RADIUS);
    // Small floors are built often, so that the clock can tell.
    let times = match name {
        "room-20" | "flat-80" => 41,
        "office-3000" => 7,
        _ => 3,
    };
    match program {
        "ours" => {
            let world = &floor.builder.world;
            let plan = kept(|| plan(world));
            median(times, "build", "clock", || self::plan(world));
            println!("cells\t{}", plan.fragments().map(|f| f.passframes().len()).sum::<usize>());
            ask(&pairs, |from, to| {
                let found = plan.route(world, from, Target::Point(to), Method::Shortest).ok()?;
                let at_ends = found.moved_start.is_none() && found.moved_goal.is_none();
                at_ends.then_some(found.length)
            });
            rebuild(plan, &mut floor);
        }
        "recast" => {
            let mesh = peers::triangles(&floor);
            let tiles = kept(|| peers::recast(&mesh, RADIUS, true));
            let cells: usize = tiles.iter().map(|(polygons, _)| polygons.polygon_count()).sum();
            println!("cells\t{cells}");
            median(times, "build", "clock", || peers::recast(&mesh, RADIUS, true));
            median(times, "bare", "bare clock", || peers::recast(&mesh, RADIUS, false));
        }
        "polyanya" => {
            let outlines = peers::outlines(&plan(&floor.builder.world));
            let meshes = peers::polyanya(&outlines);
            median(1, "build", "clock", || peers::polyanya(&outlines));
            ask(&pairs, |from, to| meshes.iter().find_map(|mesh| peers::way(mesh, from, to)));
        }
        _ => {
            let plan = plan(&floor.builder.world);
            let sight = optimum::Sight::of(&floor, RADIUS);
            let length = |(from, to): (Point, Point)| {
                let to = Target::Point(to);
                let found = plan.route(&floor.builder.world, from, to, Method::Shortest);
                Some(found.ok()?.length)
            };
            let lengths = pairs.iter().map(|&pair| length(pair));
            let mut known: Vec<(usize, f64)> =
                lengths.enumerate().filter_map(|(i, length)| Some((i, length?))).collect();
            // The slow way is slower the longer the way.
            let sample = match name {
                "office-3000" => 40,
                "hospital-40000" => {
                    known.sort_by(|a, b| a.1.total_cmp(&b.1));
                    20
                }
                _ => QUERIES,
            };
            for (i, length) in known.into_iter().take(sample) {
                let (from, to) = pairs[i];
                if let Some(length) = sight.shortest(from, to, length) {
                    println!("way\t{i}\t0\t{length}");
                }
            }
        }
    }
}

/// Tells the median times of several runs under two names, in ms: of the processor, and on the clock.
fn median<T>(times: usize, processor: &str, clock: &str, mut work: impl FnMut() -> T) {
    let run = || {
        let (start, began) = (ProcessTime::now(), Instant::now());
        let made = black_box(work());
        let spent = [start.elapsed(), began.elapsed()].map(|t| t.as_secs_f64() * 1e3);
        drop(made);
        spent
    };
    let runs: Vec<[f64; 2]> = std::iter::repeat_with(run).take(times).collect();
    for (k, name) in [processor, clock].into_iter().enumerate() {
        let mut spent: Vec<f64> = runs.iter().map(|r| r[k]).collect();
        spent.sort_by(f64::total_cmp);
        println!("{name}\t{}", spent[times / 2]);
    }
}

/// Makes something and tells the memory that the process holds around it. What has been freed before is used again
/// unseen, so what a second one beside the first adds is told too.
fn kept<T>(mut make: impl FnMut() -> T) -> T {
    println!("before\t{}", held("VmRSS:"));
    let made = black_box(make());
    let after = held("VmRSS:");
    println!("after\t{after}\npeak\t{}", held("VmHWM:"));
    let second = black_box(make());
    println!("kept\t{}", held("VmRSS:") - after);
    drop(second);
    made
}

fn ask(pairs: &[(Point, Point)], way: impl Fn(Point, Point) -> Option<f64>) {
    for (i, &(from, to)) in pairs.iter().enumerate() {
        let mut best = Duration::MAX;
        let mut length = None;
        for _ in 0..5 {
            let start = Instant::now();
            length = black_box(way(from, to));
            best = best.min(start.elapsed());
        }
        if let Some(length) = length {
            println!("way\t{i}\t{}\t{length}", best.as_secs_f64() * 1e6);
        }
    }
}

/// A floor's triangles and ways for another program, numbers of 32 bits, little-endian: how many triangles, the
/// corners of each, how many ways, the ends of each; in metres, y upwards.
fn write(name: &str, file: &Path) -> std::io::Result<()> {
    let floor = floor(name);
    let (triangles, pairs) = (peers::triangles(&floor), floor.pairs(QUERIES, RADIUS));
    let mut bytes = Vec::new();
    let mut put = |count: usize, points: &mut dyn Iterator<Item = [f32; 3]>| {
        bytes.extend((count as u32).to_le_bytes());
        bytes.extend(points.flatten().flat_map(f32::to_le_bytes));
    };
    put(triangles.len(), &mut triangles.iter().flatten().copied());
    put(pairs.len(), &mut pairs.iter().flat_map(|w| [w.0, w.1]).map(|p| peers::metres(p, 0.0)));
    std::fs::write(file, bytes)
}

/// One thing after another turns, all over the floor.
fn rebuild(mut plan: FloorPlan, floor: &mut Generated) {
    let world = &mut floor.builder.world;
    let ids: Vec<ReplicaId> = world.replicas.keys().copied().collect();
    let mut times: Vec<f64> = Vec::new();
    for k in 0..40 {
        let id = ids[k * 7919 % ids.len()];
        let replica = world.replicas.get_mut(&id).expect("one of its own");
        replica.frame = Frame { angle: Deg::of(7.0 * (k + 1) as f64), ..replica.frame };
        let start = ProcessTime::now();
        plan.rebuild(world, &[id]);
        times.push(start.elapsed().as_secs_f64() * 1e3);
    }
    times.sort_by(f64::total_cmp);
    println!("rebuild\t{}\nrebuild worst\t{}", times[times.len() / 2], times[times.len() - 1]);
}

/// A size that the system tells of this process, in MB: `VmHWM:` is the most memory it has held, `VmRSS:` what it
/// holds now.
fn held(key: &str) -> f64 {
    let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
    let line = status.lines().find_map(|l| l.strip_prefix(key)).unwrap_or_default();
    let kilobytes = line.split_whitespace().next().and_then(|n| n.parse::<f64>().ok());
    kilobytes.unwrap_or(f64::NAN) / 1024.0
}
