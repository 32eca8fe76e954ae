//! The main job and its parts on the rb2 map: import, derive, ground, plan, free floor, route, and the whole.
//!
//! `cargo bench -p benches --bench demo`

use std::hint::black_box;
use std::path::Path;

use criterion::{Criterion, criterion_group, criterion_main};
use orthoframe::engine::{Change, Method, Timestamp};
use orthoframe::{Engine, World};
use orthoframe_geometry::{DoorStates, FloorPlan, Target};
use orthoframe_graphplan::{Limits, solve};
use orthoframe_robot::{facts_of_map, state};
use orthoframe_semantics::{Profile, RelationRules, derive};
use orthoframe_strips::{Scenario, ground};

const MAP: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../maps/rb2.toml");
const SCENARIO: &str =
    concat!(env!("CARGO_MANIFEST_DIR"), "/../rules/scenarios/medicine-walk.strips");

fn demo(c: &mut Criterion) {
    let world = World::load(MAP).expect("the map of the papers is sound");
    let map = *world.maps.keys().next().expect("it has a map");
    let rules = RelationRules::standard();
    let relations = derive(&world, &rules, Profile::Surveyed).expect("the standard rules end");
    let scenario = Scenario::read(Path::new(SCENARIO)).expect("the scenario is sound");
    let mut problem = scenario.problem.clone();
    for fact in facts_of_map(&world, &relations) {
        state(&mut problem, &fact);
    }
    let task = ground(&scenario.domain, &problem).expect("the scenario grounds");
    let floor = FloorPlan::build(&world, map, &world.robot, &DoorStates::new());
    let engine = Engine::in_memory(world.clone(), None).expect("the built-in rules are sound");
    let (from, to) = (engine.locate_name("Точка-А"), engine.locate_name("Точка-К"));
    let (from, to) = (from.expect("a place").at, to.expect("a place").at);

    let mut group = c.benchmark_group("rb2");
    group.sample_size(20);
    group.bench_function("read the map file", |b| b.iter(|| World::load(black_box(MAP))));
    group.bench_function("import into a new store, durable", |b| {
        b.iter_with_large_drop(|| {
            let dir = tempfile::tempdir().expect("a temporary directory");
            let mut engine = Engine::open(&dir.path().join("store"), None).expect("a new store");
            engine
                .import(Path::new(MAP), &Change::new("bench", Timestamp(0), "bench"))
                .expect("a sound map");
            (engine, dir)
        });
    });
    group.bench_function("read the relation rules", |b| b.iter(RelationRules::standard));
    group.bench_function("measure and derive", |b| {
        b.iter(|| derive(black_box(&world), &rules, Profile::Surveyed))
    });
    group.bench_function("ground", |b| b.iter(|| ground(&scenario.domain, black_box(&problem))));
    group.bench_function("plan", |b| b.iter(|| solve(black_box(&task), &Limits::default())));
    group.bench_function("free floor and Passframes", |b| {
        b.iter(|| FloorPlan::build(black_box(&world), map, &world.robot, &DoorStates::new()));
    });
    group.bench_function("route", |b| {
        b.iter(|| floor.route(&world, black_box(from), Target::Point(to), Method::Shortest));
    });
    group.bench_function("the whole way", |b| {
        b.iter_with_large_drop(|| {
            let dir = tempfile::tempdir().expect("a temporary directory");
            let mut engine = Engine::open(&dir.path().join("store"), None).expect("a new store");
            engine
                .import(Path::new(MAP), &Change::new("bench", Timestamp(0), "bench"))
                .expect("a sound map");
            engine.relations().expect("relations");
            engine.perform("Принеси лекарство", &mut |_| {}).expect("the medicine is fetched");
            (engine, dir)
        });
    });
    group.finish();
}

criterion_group!(benches, demo);
criterion_main!(benches);
