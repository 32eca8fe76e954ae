//! Relations of a generated hospital: how measuring, rules and one move grow with the number of things.
//!
//! `cargo bench -p benches --bench relations` prints a table; `-- 1000 50000` chooses the numbers of replicas.

mod wards;

use std::time::{Duration, Instant};

use orthoframe_map::World;
use orthoframe_semantics::{Measurements, Profile, RelationRules, derive, derive_from};
use orthoframe_units::{Deg, Frame, ReplicaId};

const WARD: &str = r#"
format = 1
[type]
object = [{ name = "Мебель" }, { name = "Ёмкость", traits = ["container"] }, { name = "Ноша", traits = ["portable"] }]
[orthoframe]
floor = { name = "Пол", height = 270, points = [[0, 0], [200, 0], [300, 0], [500, 0], [500, 400], [0, 400]], side.B = { permeability = "permeable" } }
top = { name = "Столешница", rect = [120, 60], height = 3 }
leg = { name = "Ножка", rect = [5, 5], height = 72 }
frame = { name = "Рама", rect = [90, 200], height = 40 }
mattress = { name = "Матрас", rect = [88, 196], height = 20 }
head = { name = "Изголовье", rect = [90, 4], height = 100 }
case = { name = "Корпус", rect = [80, 30], height = 180, side = { A = { permeability = "permeable" } } }
shelf = { name = "Полка", rect = [78, 28], height = 0 }
box = { name = "Тумба", rect = [45, 40], height = 50 }
seat = { name = "Сиденье", rect = [40, 40], height = 45 }
back = { name = "Спинка", rect = [40, 4], height = 45 }
foot = { name = "Подставка", regular = { corners = 8, radius = 8 }, height = 2 }
pole = { name = "Стойка", rect = [2, 2], height = 25 }
shade = { name = "Абажур", regular = { corners = 8, radius = 12 }, height = 12 }
cup = { name = "Чашка", regular = { corners = 8, radius = 4 }, height = 9, roof = "permeable" }
book = { name = "Книга", rect = [4, 18], height = 24 }
tray = { name = "Поднос", rect = [40, 30], height = 2 }
[object]
desk = { name = "Стол", type = "Мебель", front = "T.A", back = "T.C", items = [
  { id = "A", orthoframe = "leg" }, { id = "B", orthoframe = "leg", at = [115, 0] }, { id = "C", orthoframe = "leg", at = [115, 55] },
  { id = "D", orthoframe = "leg", at = [0, 55] }, { id = "T", orthoframe = "top", at = [0, 0, 72] } ] }
bed = { name = "Кровать", type = "Мебель", front = "A.A", back = "A.C", items = [
  { id = "A", orthoframe = "frame" }, { id = "B", orthoframe = "mattress", at = [1, 2, 40] }, { id = "C", orthoframe = "head", at = [0, 200] } ] }
bookcase = { name = "Стеллаж", type = "Ёмкость", front = "A.A", back = "A.C", items = [
  { id = "A", orthoframe = "case" }, { id = "B", orthoframe = "shelf", at = [1, 1, 50] }, { id = "C", orthoframe = "shelf", at = [1, 1, 100] }, { id = "D", orthoframe = "shelf", at = [1, 1, 140] } ] }
bedside = { name = "Тумбочка", type = "Ёмкость", front = "A", back = "C", items = [{ id = "A", orthoframe = "box" }] }
chair = { name = "Стул", type = "Мебель", front = "A.A", back = "A.C", items = [{ id = "A", orthoframe = "seat" }, { id = "B", orthoframe = "back", at = [0, 36, 45] }] }
lamp = { name = "Лампа", type = "Мебель", items = [
  { id = "A", orthoframe = "foot" }, { id = "B", orthoframe = "pole", at = [1, 7, 2] }, { id = "C", orthoframe = "shade", at = [-1, -4, 27] } ] }
cup = { name = "Чашка", type = "Ноша", items = [{ id = "A", orthoframe = "cup" }] }
book = { name = "Книга", type = "Ноша", items = [{ id = "A", orthoframe = "book" }] }
tray = { name = "Поднос", type = "Ноша", items = [{ id = "A", orthoframe = "tray" }] }
[area.ward]
name = "Палата"
items = [{ id = "A", orthoframe = "floor" }]
replicas = [
  { name = "Стол", object = "desk", at = [350, 330] },
  { name = "Кровать-1", object = "bed", at = [10, 190], move_prob = 5 },
  { name = "Кровать-2", object = "bed", at = [180, 190], move_prob = 5 },
  { name = "Тумбочка-1", object = "bedside", at = [105, 350] },
  { name = "Тумбочка-2", object = "bedside", at = [275, 350] },
  { name = "Стеллаж", object = "bookcase", at = [80, 30], angle = 180 },
  { name = "Стеллаж-2", object = "bookcase", at = [495, 100], angle = 90 },
  { name = "Стул-1", object = "chair", at = [390, 280], angle = 180, move_prob = 80 },
  { name = "Стул-2", object = "chair", at = [440, 282], angle = 170, move_prob = 80 },
  { name = "Стул-3", object = "chair", at = [110, 120], angle = 33, move_prob = 80 },
  { name = "Стул-4", object = "chair", at = [330, 120], move_prob = 80 },
  { name = "Лампа-1", object = "lamp", at = [120, 360, 50] },
  { name = "Лампа-2", object = "lamp", at = [290, 360, 50] },
  { name = "Лампа-3", object = "lamp", at = [440, 350, 75] },
  { name = "Поднос", object = "tray", at = [360, 340, 75], angle = 5, move_prob = 90 },
  { name = "Чашка-1", object = "cup", at = [370, 350, 77], move_prob = 90 },
  { name = "Чашка-2", object = "cup", at = [385, 350, 77], move_prob = 90 },
  { name = "Чашка-3", object = "cup", at = [130, 375, 50], move_prob = 90 },
  { name = "Книга-1", object = "book", at = [60, 20, 50], angle = 180, move_prob = 90 },
  { name = "Книга-2", object = "book", at = [55, 20, 50], angle = 180, move_prob = 90 },
  { name = "Книга-3", object = "book", at = [50, 20, 100], angle = 180, move_prob = 90 },
  { name = "Книга-4", object = "book", at = [480, 120, 50], angle = 90, move_prob = 90 },
  { name = "Книга-5", object = "book", at = [480, 126, 50], angle = 90, move_prob = 90 },
  { name = "Книга-6", object = "book", at = [410, 345, 75], move_prob = 90 },
  { name = "Книга-7", object = "book", at = [280, 380, 50], move_prob = 90 },
]
[map.floor]
name = "Этаж"
items = [{ area = "ward" }]
"#;

/// Wards side by side and back to back, until there are so many replicas; every seventh ward is turned round.
fn hospital(replicas: usize) -> World {
    let wards = replicas.div_ceil(wards::things(WARD));
    let columns = (wards as f64).sqrt().ceil() as usize;
    wards::hospital(WARD, wards, replicas, |n| {
        let (x, y) = ((n % columns) as f64 * 520.0, (n / columns) as f64 * 420.0);
        match n % 7 {
            0 => Frame::new(x + 500.0, y + 400.0, 0.0, Deg::of(180.0)),
            _ => Frame::new(x, y, 0.0, Deg::ZERO),
        }
    })
}

/// Processor time of the whole process in seconds, in the system's ticks; none where it is not told.
fn processor_time() -> Option<f64> {
    let told = std::fs::read_to_string("/proc/self/stat").ok()?;
    let fields: Vec<&str> = told.rsplit_once(')')?.1.split_whitespace().collect();
    let ticks: f64 = fields.get(11)?.parse::<f64>().ok()? + fields.get(12)?.parse::<f64>().ok()?;
    Some(ticks / 100.0)
}

/// The result of some work, the time it took, and the processor time, in milliseconds.
fn time<T>(work: impl FnOnce() -> T) -> (T, String) {
    let (start, began) = (Instant::now(), processor_time());
    let result = work();
    let wall = start.elapsed().as_secs_f64() * 1e3;
    let spent =
        began.zip(processor_time()).map(|(from, to)| format!(" ({:.0})", (to - from) * 1e3));
    (result, format!("{wall:.0}{}", spent.unwrap_or_default()))
}

/// Wall time, for what is shorter than the system's ticks.
fn wall<T>(work: impl FnOnce() -> T) -> (T, Duration) {
    let start = Instant::now();
    let result = work();
    (result, start.elapsed())
}

/// The most memory that this process has held, in MiB; none where the system does not tell.
fn peak_memory() -> Option<usize> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    Some(line.split_whitespace().nth(1)?.parse::<usize>().ok()? / 1024)
}

/// Moves of cups, chairs and beds all over the hospital: where to, and back again.
fn moves(world: &World, count: usize) -> Vec<(ReplicaId, Frame)> {
    let wards = world.areas.len();
    let mut moves = Vec::new();
    for n in 0..count / 2 {
        let ward = n * 7919 % wards;
        // The cup goes from the tray to the desk's edge, the chair across the room, the bed a little aside.
        let (thing, to) = [
            (16, Frame::new(420.0, 350.0, 75.0, Deg::ZERO)),
            (8, Frame::new(240.0, 60.0, 0.0, Deg::of(45.0))),
            (2, Frame::new(14.0, 180.0, 0.0, Deg::of(3.0))),
        ][n % 3];
        let id = ReplicaId((ward * 25 + thing) as u32);
        let Some(replica) = world.replicas.get(&id) else { continue };
        moves.extend([(id, to), (id, replica.frame)]);
    }
    moves
}

#[expect(clippy::print_stdout, reason = "a benchmark prints its table")]
fn main() {
    let wanted: Vec<usize> = std::env::args().filter_map(|a| a.parse().ok()).collect();
    let sizes = if wanted.is_empty() { vec![1_000, 5_000, 20_000, 50_000] } else { wanted };
    let rules = RelationRules::standard();
    println!(
        "| replicas | near pairs | measure, ms (of processor) | rows and rules | of it rules | relations | one move: first, ms | median of 300 | 9 of 10 below | of it measuring | peak, MiB |"
    );
    println!("|---|---|---|---|---|---|---|---|---|---|---|");
    for size in sizes {
        let mut world = hospital(size);
        let _warm = (size < 10_000).then(|| derive(&world, &rules, Profile::Surveyed));
        let (measured, measuring) = time(|| Measurements::of(&world, rules.reach()));
        let pairs = measured.pair_count();
        let (relations, deriving) =
            time(|| derive_from(&world, &rules, Profile::Surveyed, measured));
        let mut relations = relations.expect("standard rules end");
        let tuples: usize = relations.counts().iter().map(|c| c.count).sum();
        let (evaluated, ruling) = time(|| rules.program().evaluate(relations.database()));
        drop(evaluated);
        let mut alone = relations.measurements().clone();
        let (mut measuring_moves, mut updating) = (Vec::new(), Vec::new());
        for (id, to) in moves(&world, 300) {
            world.replicas.get_mut(&id).expect("within the hospital").frame = to;
            measuring_moves.push(wall(|| alone.update(&world, id)).1);
            let (moved, spent) = wall(|| relations.update(&world, id));
            assert!(moved.expect("standard rules end"));
            updating.push(spent);
        }
        let ms = |d: Duration| d.as_secs_f64() * 1e3;
        let first = updating[0];
        measuring_moves.sort_unstable();
        updating.sort_unstable();
        println!(
            "| {size} | {pairs} | {measuring} | {deriving} | {ruling} | {tuples} | {:.2} | {:.2} | {:.2} | {:.2} | {} |",
            ms(first),
            ms(updating[updating.len() / 2]),
            ms(updating[updating.len() * 9 / 10]),
            ms(measuring_moves[measuring_moves.len() / 2]),
            peak_memory().map_or_else(|| "–".to_owned(), |mib| mib.to_string()),
        );
    }
}
