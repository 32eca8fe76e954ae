//! Free floor and routes on generated floors: building, rebuilding one Fragment, asking the way.

#[path = "../tests/floors.rs"]
#[allow(dead_code, reason = "shared with the tests")]
mod floors;
mod generated;

use std::hint::black_box;
use std::time::Duration;

use criterion::{Criterion, criterion_group, criterion_main};
use generated::{Generated, building, room};
use orthoframe::geometry::{DoorStates, FloorPlan, Method, Target};
use orthoframe::map::World;
use orthoframe::units::{Cm, Frame, MapId, Point};

fn plan(world: &World) -> FloorPlan {
    FloorPlan::build(world, MapId(1), &world.robot, &DoorStates::new())
}

/// Time that this thread has run on a processor: other work on the machine does not count.
fn cpu() -> Duration {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    let nanoseconds = text.split(' ').next().and_then(|n| n.parse().ok()).unwrap_or(0);
    Duration::from_nanos(nanoseconds)
}

fn floors() -> Vec<(&'static str, Generated)> {
    let mut floors = vec![
        ("room-20", room(20)),
        ("flat-80", building(1, 3, 13)),
        ("office-3000", building(4, 25, 15)),
    ];
    if std::env::var_os("FLOOR_LARGE").is_some() {
        floors.push(("hospital-40000", building(20, 50, 20)));
    }
    for (_, floor) in &mut floors {
        floor.builder.world.robot.radius = Cm::of(20.0);
    }
    floors
}

/// Points of the floor where the robot fits, spread over the rooms.
fn spots(plan: &FloorPlan, floor: &Generated) -> Vec<Point> {
    let mut spots = Vec::new();
    for (k, (area, middle)) in floor.rooms.iter().enumerate() {
        let reach = if floor.rooms.len() == 1 { 370.0 } else { 150.0 };
        for i in 0..(if floor.rooms.len() == 1 { 60 } else { 2 }) {
            let angle = (k * 7 + i) as f64 * 2.399_963;
            let far = reach * ((i % 10 + 1) as f64 / 10.0);
            let at = middle + nalgebra::Vector2::new(angle.cos(), angle.sin()) * far;
            if plan.fragment(*area).is_some_and(|f| f.fits(at)) {
                spots.push(at);
            }
        }
    }
    spots
}

fn measure(c: &mut Criterion) {
    for (name, mut floor) in floors() {
        let large = floor.rooms.len() > 50;
        let before = cpu();
        let mut built = plan(&floor.builder.world);
        let once = cpu() - before;
        let frames: usize = built.fragments().map(|f| f.passframes.len()).sum();
        report(&format!("{name}: first build {once:?}, {frames} Passframes"));
        let mut group = c.benchmark_group(name);
        group.sample_size(10);
        if !large {
            group.bench_function("build", |b| b.iter(|| plan(black_box(&floor.builder.world))));
        }
        let spots = spots(&built, &floor);
        let pairs: Vec<(Point, Point)> = (0..spots.len().min(200))
            .map(|i| (spots[i], spots[(i * 37 + 11) % spots.len()]))
            .collect();
        let world = &floor.builder.world;
        let mut times: Vec<f64> = Vec::new();
        for &(from, to) in &pairs {
            let start = cpu();
            let found = built.route(world, from, Target::Point(to), Method::Shortest);
            if black_box(found).is_ok() {
                times.push((cpu() - start).as_secs_f64() * 1e6);
            }
        }
        times.sort_by(f64::total_cmp);
        let mean = times.iter().sum::<f64>() / times.len().max(1) as f64;
        report(&format!(
            "{name}: {} of {} ways found, µs: mean {mean:.1}, median {:.1}, p99 {:.1}",
            times.len(),
            pairs.len(),
            times[times.len() / 2],
            times[times.len() * 99 / 100]
        ));
        let id = *floor.builder.world.replicas.keys().next().unwrap();
        let area = floor.builder.world.replicas[&id].area;
        let mut turn = 0.0;
        group.bench_function("rebuild one Fragment", |b| {
            b.iter(|| {
                turn += 7.0;
                let replica = floor.builder.world.replicas.get_mut(&id).unwrap();
                replica.frame = Frame { angle: orthoframe::units::Deg::of(turn), ..replica.frame };
                built.rebuild(&floor.builder.world, area);
            });
        });
        group.finish();
    }
}

#[allow(clippy::print_stdout, reason = "a bench speaks to its user")]
fn report(line: &str) {
    println!("{line}");
}

criterion_group!(benches, measure);
criterion_main!(benches);
