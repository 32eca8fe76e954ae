//! Questions over a generated hospital: reading the nouns of the map, the first question, and questions after it.
//!
//! `cargo bench --bench talk`; 2 000 rooms with 20 things each, names of the sort «Стул-2-1704».

mod wards;

use std::time::Instant;

use cpu_time::ProcessTime;
use criterion::{Criterion, criterion_group, criterion_main};
use orthoframe::Engine;
use orthoframe::engine::{Memory, World, change_now};
use orthoframe_language::question::Lexicon;
use orthoframe_store::Store;
use orthoframe_units::{Deg, Frame};

const WARD: &str = r#"
format = 1
[type]
area = [{ name = "Палата", name_en = "ward", traits = ["room"] }]
object = [
  { name = "Стол", name_en = "table", traits = ["support"] }, { name = "Кровать", name_en = "bed", traits = ["bed"] },
  { name = "Тумбочка", name_en = "bedside table", traits = ["support", "container"] }, { name = "Стул", name_en = "chair", traits = ["seat"] },
  { name = "Чашка", name_en = "cup", traits = ["portable"] } ]
[orthoframe]
floor = { name = "Пол", rect = [500, 400], height = 270 }
top = { name = "Стол", rect = [120, 60], height = 75 }
frame = { name = "Кровать", rect = [90, 200], height = 50 }
box = { name = "Тумбочка", rect = [45, 40], height = 50 }
seat = { name = "Стул", rect = [40, 40], height = 45 }
cup = { name = "Чашка", rect = [8, 8], height = 9 }
[object]
desk = { name = "Стол", type = "Стол", front = "A", items = [{ id = "A", orthoframe = "top" }] }
bed = { name = "Кровать", type = "Кровать", front = "A", items = [{ id = "A", orthoframe = "frame" }] }
bedside = { name = "Тумбочка", type = "Тумбочка", front = "A", items = [{ id = "A", orthoframe = "box" }] }
chair = { name = "Стул", type = "Стул", front = "A", items = [{ id = "A", orthoframe = "seat" }] }
cup = { name = "Чашка", type = "Чашка", items = [{ id = "A", orthoframe = "cup" }] }
[area.ward]
name = "Палата"
type = "Палата"
items = [{ id = "A", orthoframe = "floor" }]
replicas = [
  { name = "Стол-1", object = "desk", at = [350, 330] }, { name = "Стол-2", object = "desk", at = [350, 10] },
  { name = "Кровать-1", object = "bed", at = [10, 190] }, { name = "Кровать-2", object = "bed", at = [180, 190] },
  { name = "Тумбочка-1", object = "bedside", at = [105, 350] }, { name = "Тумбочка-2", object = "bedside", at = [275, 350] },
  { name = "Стул-1", object = "chair", at = [390, 280] }, { name = "Стул-2", object = "chair", at = [440, 220] },
  { name = "Стул-3", object = "chair", at = [110, 120] }, { name = "Стул-4", object = "chair", at = [300, 120] },
  { name = "Стул-5", object = "chair", at = [10, 60] }, { name = "Стул-6", object = "chair", at = [60, 60] },
  { name = "Стул-7", object = "chair", at = [110, 60] }, { name = "Стул-8", object = "chair", at = [160, 60] },
  { name = "Чашка-1", object = "cup", at = [370, 350, 75], properties = { "ЦВЕТ" = "Красный" } }, { name = "Чашка-2", object = "cup", at = [385, 350, 75] },
  { name = "Чашка-3", object = "cup", at = [130, 375, 50] }, { name = "Чашка-4", object = "cup", at = [290, 375, 50] },
  { name = "Чашка-5", object = "cup", at = [370, 30, 75] }, { name = "Чашка-6", object = "cup", at = [410, 30, 75] },
]
[map.floor]
name = "Этаж"
items = [{ area = "ward" }]
"#;

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
