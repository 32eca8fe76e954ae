//! Questions over a generated hospital: reading the nouns of the map, the first question, and questions after it.
//!
//! `cargo bench -p benches --bench talk`; 2 000 rooms with 20 things each, names of the sort «Стул-2-1704».

mod wards;

use std::time::Instant;

use cpu_time::ProcessTime;
use criterion::{Criterion, criterion_group, criterion_main};
use orthoframe::engine::{Memory, change_now};
use orthoframe::{Engine, World};
use orthoframe_language::question::Lexicon;
use orthoframe_store::Store;
use orthoframe_units::{Deg, Frame};

const WARD: &str = include_str!("wards/ward.toml");

/// Wards side by side and back to back.
fn hospital(wards: usize) -> World {
    wards::hospital(WARD, wards, usize::MAX, |n| {
        Frame::new((n % 45) as f64 * 520.0, (n / 45) as f64 * 420.0, 0.0, Deg::ZERO)
    })
}

const QUESTIONS: [&str; 6] = [
    "Где Чашка-3-1234?",
    "Что стоит на Столе-1-700?",
    "Сколько стульев в Палате-1500?",
    "Есть ли в Палате-99 красная чашка?",
    "What is next to Кровать-1-42?",
    "Какой стул ближе всего к Кровати-2-1999?",
];

/// Processor and wall time of some work, in milliseconds.
#[expect(clippy::print_stdout, reason = "a bench prints its figures")]
fn timed<T>(what: &str, work: impl FnOnce() -> T) -> T {
    let (processor, clock) = (ProcessTime::now(), Instant::now());
    let result = work();
    let (processor, clock) = (processor.elapsed(), clock.elapsed());
    println!(
        "{what}: {:.1} ms of processor time, {:.1} ms on the clock",
        processor.as_secs_f64() * 1e3,
        clock.as_secs_f64() * 1e3
    );
    result
}

/// The hospital in a store: from opening it to the first answer.
fn first_question(world: &World) {
    let dir = tempfile::tempdir().expect("a directory for the store");
    let dir = dir.path().join("store");
    let change = change_now("bench", "a hospital");
    let (mut store, _) = Store::open(&dir).expect("a new store");
    store.import(world, &change).expect("the store takes it");
    drop(store);
    let engine = Engine::open(&dir, None).expect("the store is sound");
    timed("relations derived and kept", || engine.relations().map(|_| ())).expect("they end");
    drop(engine);
    for round in 0..3 {
        let engine = timed(&format!("store opened, round {round}"), || {
            Engine::open_read_only(&dir, None).expect("the store is sound")
        });
        timed("  relations taken up", || engine.relations().map(|_| ())).expect("they are kept");
        for question in [QUESTIONS[0], QUESTIONS[3]] {
            let ask = || engine.ask(question, &mut Memory::default()).expect("there is a map");
            let answer = timed(&format!("  {question}"), ask);
            assert!(answer.is_ok(), "{question}: {answer:?}");
        }
    }
}

fn talk(c: &mut Criterion) {
    let world = hospital(2_000);
    first_question(&world);
    c.bench_function("talk/nouns of 40 000 things", |b| b.iter(|| Lexicon::of(&world)));
    let engine = Engine::in_memory(world, None).expect("the rules are sound");
    engine.relations().expect("they end");
    for question in QUESTIONS {
        let mut ask = || {
            let answer = engine.ask(question, &mut Memory::default()).expect("there is a map");
            answer.unwrap_or_else(|doubt| panic!("{question}: {}", doubt.text))
        };
        ask();
        c.bench_function(&format!("talk/{question}"), |b| b.iter(&mut ask));
    }
}

criterion_group! {
    name = benches;
    config = Criterion::default().sample_size(10);
    targets = talk
}
criterion_main!(benches);
