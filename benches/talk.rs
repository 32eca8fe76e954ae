//! Questions over a generated hospital: reading the nouns of the map, the first question, and questions after it.
//!
//! `cargo bench --bench talk`; 2 000 rooms with 20 things each, names of the sort «Стул-2-1704».

use criterion::{Criterion, criterion_group, criterion_main};
use orthoframe::Engine;
use orthoframe::engine::{Memory, World};
use orthoframe::language::question::Lexicon;
use orthoframe::map::{Area, Format, MapItem, Replica};
use orthoframe::units::{AreaId, Deg, Frame, ReplicaId, Source};

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
fn hospital(wards: u32) -> World {
    let text = Source::new("палата.toml", WARD);
    let mut world = World::parse(&text, Format::Toml).expect("the ward is sound");
    let ward = world.areas.values().next().expect("one ward").clone();
    let furniture: Vec<Replica> = world.replicas.values().cloned().collect();
    let map = world.maps.values_mut().next().expect("one floor");
    map.items.clear();
    world.areas.clear();
    world.replicas.clear();
    for n in 0..wards {
        let id = AreaId(n + 1);
        let frame =
            Frame::new(f64::from(n % 45) * 520.0, f64::from(n / 45) * 420.0, 0.0, Deg::ZERO);
        let name = format!("Палата-{n}");
        world.areas.insert(id, Area { id, name, key: format!("ward-{n}"), ..ward.clone() });
        map.items.push(MapItem { area: id, frame, is_base: n == 0 });
        for (k, thing) in furniture.iter().enumerate() {
            let replica = ReplicaId(n * furniture.len() as u32 + k as u32 + 1);
            let name = format!("{}-{n}", thing.name);
            world
                .replicas
                .insert(replica, Replica { id: replica, area: id, name, ..thing.clone() });
        }
    }
    world
}

const QUESTIONS: [&str; 6] = [
    "Где Чашка-3-1234?",
    "Что стоит на Столе-1-700?",
    "Сколько стульев в Палате-1500?",
    "Есть ли в Палате-99 красная чашка?",
    "What is next to Кровать-1-42?",
    "Какой стул ближе всего к Кровати-2-1999?",
];

fn talk(c: &mut Criterion) {
    let world = hospital(2_000);
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
