//! One durable edit of a hospital, of every kind, with the relations and the floor kept in step: at several sizes of the
//! map, while nobody else has the state before it and while others do; as a value and as a text.
//!
//! `cargo bench -p benches --bench edit [-- WARDS ...]`; a ward holds 20 things and a door to the next one.

mod wards;

use std::sync::Arc;
use std::time::Duration;

use cpu_time::ProcessTime;
use orthoframe::engine::{Method, Mode, State, change_now};
use orthoframe::{Engine, World};
use orthoframe_map::{Area, Edits, Format, Forms, MapItem, MapLink, Place, Replica, SideRef};
use orthoframe_store::Store;
use orthoframe_units::{
    AreaId, Cm, Deg, DoorId, Frame, ObjectId, OrFrId, PlaceId, Point, ReplicaId, Source,
};

const WARD: &str = include_str!("wards/ward.toml");
/// The ward's floor, and the same with a door in one wall and a hole before the neighbour's door in the other.
const FLOOR: &str = r#"rect = [500, 400], height = 270 }"#;
const FLOOR_WITH_DOORS: &str = r#"points = [[0, 0], [500, 0], [500, 100], [500, 200], [500, 400], [0, 400], [0, 200], [0, 100]], height = 270, side = { C = { permeability = "conditional" }, G = { permeability = "permeable" } } }"#;
const ITEMS: &str = r#"items = [{ id = "A", orthoframe = "floor" }]"#;
const DOOR: &str = r#"
[door.door]
name = "Дверь"
kind = "hinged"
width = 100
height = 200
state = "open"
leaves = [{ hinge = "right" }]
[map.floor]"#;
/// Edits of each kind.
const EDITS: usize = 40;
/// So many states before the last are still held.
const HELD: usize = 2;

/// Wards side by side and back to back, each with a door to the next.
fn hospital(wards: usize) -> World {
    let items =
        format!("{ITEMS}\ndoors = [{{ door = \"door\", side = \"A.C\", opens = \"inside\" }}]");
    let text = WARD.replace(FLOOR, FLOOR_WITH_DOORS).replace(ITEMS, &items);
    let text = text.replace("\n[map.floor]", DOOR);
    let mut world = wards::hospital(&text, wards, usize::MAX, |n| {
        Frame::new((n % 45) as f64 * 520.0, (n / 45) as f64 * 420.0, 0.0, Deg::ZERO)
    });
    let door = world.doors.values().next().expect("the ward has a door").clone();
    for area in world.areas.values_mut() {
        let id = DoorId(area.id.0);
        area.doors.iter_mut().for_each(|mount| mount.door = id);
        let (name, key) = (format!("Дверь-{}", id.0), format!("door-{}", id.0));
        world.doors.insert(id, orthoframe_map::Door { id, name, key, ..door.clone() });
    }
    let map = world.maps.values_mut().next().expect("the hospital is one");
    let links = map.items.windows(2).map(|two| linked(&two[1], &two[0]));
    map.links = links.map(Arc::new).collect();
    world
}

/// How a ward lies to the one before it.
fn linked(ward: &MapItem, before: &MapItem) -> MapLink {
    let side = || SideRef { item: "A".to_owned(), side: "A".to_owned() };
    MapLink {
        area: ward.area,
        side: side(),
        to_area: before.area,
        to_side: side(),
        rel_x: Cm::of(before.frame.x.get() - ward.frame.x.get()),
        rel_y: Cm::of(before.frame.y.get() - ward.frame.y.get()),
        rel_z: Cm::ZERO,
        rel_a: Deg::ZERO,
    }
}

/// The chairs of wards all over the hospital.
fn chairs(world: &World, wards: usize) -> Vec<ReplicaId> {
    let name = |n: usize| format!("Стул-{}-{}", n % 8 + 1, n * 7919 % wards);
    let find = |name: &String| world.replicas.values().find(|r| r.name == *name).map(|r| r.id);
    (0..EDITS).filter_map(|n| find(&name(n))).collect()
}

/// Median and nine of ten of some times.
#[expect(clippy::print_stdout, reason = "a bench prints its figures")]
fn tell(what: &str, mut times: Vec<Duration>) {
    times.sort();
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    let [median, most] = [times[times.len() / 2], times[times.len() * 9 / 10]];
    println!("| {what} | {:.2} | {:.2} |", ms(median), ms(most));
}

/// A kind of edit: its name, how it alters a chair of a world, and the same as a step of a text.
type Kind = (&'static str, fn(&mut World, ReplicaId, usize), Option<fn(&Replica, usize) -> String>);

/// A place at the corner of a chair's room.
fn add_place(world: &mut World, chair: ReplicaId, n: usize) {
    let area = world.replicas[&chair].area;
    let id = PlaceId(world.places.keys().next_back().map_or(1, |last| last.0 + 1));
    let (name, name_en, forms) = (format!("Пост-{n}-{}", id.0), String::new(), Forms::new());
    let at = Point::new(30.0, 30.0);
    let place = Place { id, area, name, name_en, at, heading: None, serves: None, forms };
    world.places.insert(id, place);
}

/// A chair of another height, as a kind of its own; the chair is one of them now.
fn add_kind(world: &mut World, chair: ReplicaId, n: usize) {
    let mut object = world.objects[&world.replicas[&chair].object].clone();
    object.id = ObjectId(world.objects.keys().next_back().expect("some").0 + 1);
    (object.key, object.name) = (format!("kind-{n}"), format!("Стул вида {n}"));
    for item in &mut object.items {
        let mut part = world.orthoframes[&item.orthoframe].clone();
        part.id = OrFrId(world.orthoframes.keys().next_back().expect("some").0 + 1);
        (part.key, part.height) = (format!("part-{}", part.id.0), Cm::of(part.height.get() + 1.0));
        item.orthoframe = part.id;
        world.orthoframes.insert(part.id, part);
    }
    world.replicas.get_mut(&chair).expect("it is there").object = object.id;
    world.objects.insert(object.id, object);
}

fn rename_room(world: &mut World, chair: ReplicaId, n: usize) {
    let area = world.replicas[&chair].area;
    world.areas.get_mut(&area).expect("it is there").name = format!("Зал-{n}-{}", area.0);
}

/// One more ward after the last, linked with it, with a door of its own.
fn add_room(world: &mut World, _: ReplicaId, _: usize) {
    let (last, area) = world.areas.iter().next_back().expect("some");
    let (number, id) = (last.0 as usize, AreaId(last.0 + 1));
    let mut area = Area { id, key: format!("new-{}", id.0), ..area.clone() };
    (area.name, area.name_en) = (format!("Новая палата {}", id.0), String::new());
    let door = DoorId(world.doors.keys().next_back().expect("some").0 + 1);
    let twin = world.doors[&area.doors[0].door].clone();
    let (name, key) = (format!("Новая дверь {}", door.0), format!("new-door-{}", door.0));
    world.doors.insert(door, orthoframe_map::Door { id: door, name, key, ..twin });
    area.doors[0].door = door;
    world.areas.insert(id, area);
    let map = world.maps.values_mut().next().expect("the hospital is one");
    let (x, y) = ((number % 45) as f64 * 520.0, (number / 45) as f64 * 420.0);
    let frame = Frame::new(x, y, 0.0, Deg::ZERO);
    let ward = MapItem { area: id, frame, is_base: false };
    let link = linked(&ward, map.items.last().expect("there are wards"));
    map.links.push(Arc::new(link));
    map.items.push(ward);
}

/// The last room, with its things and its door.
fn remove_room(world: &mut World, _: ReplicaId, _: usize) {
    let id = *world.areas.keys().next_back().expect("some");
    let area = world.areas.remove(&id).expect("it was there");
    area.doors.iter().for_each(|mount| drop(world.doors.remove(&mount.door)));
    let things: Vec<ReplicaId> = world.replicas_in(id).map(|replica| replica.id).collect();
    things.iter().for_each(|thing| drop(world.replicas.remove(thing)));
    let map = world.maps.values_mut().next().expect("the hospital is one");
    map.items.retain(|item| item.area != id);
    map.links.retain(|link| link.area != id);
}

fn shifted(frame: &Frame, by: f64, turn: f64) -> Frame {
    Frame::new(frame.x.get(), frame.y.get() + by, frame.z.get(), frame.angle + Deg::of(turn))
}

const KINDS: [Kind; 12] = [
    ("new place", add_place, None),
    ("new kind of things, and one of them", add_kind, None),
    ("room called otherwise", rename_room, None),
    ("new room with a door", add_room, None),
    ("room taken away", remove_room, None),
    (
        "move",
        |world, id, _| {
            let chair = world.replicas.get_mut(&id).expect("it is there");
            chair.frame = shifted(&chair.frame, 1.0, 0.0);
        },
        Some(|chair, _| format!("move = \"{}\"\nby = [0, -1]\n", chair.name)),
    ),
    (
        "turn",
        |world, id, _| {
            let chair = world.replicas.get_mut(&id).expect("it is there");
            chair.frame = shifted(&chair.frame, 0.0, 5.0);
        },
        Some(|chair, _| format!("turn = \"{}\"\nby = -5\n", chair.name)),
    ),
    (
        "property",
        |world, id, n| {
            let chair = world.replicas.get_mut(&id).expect("it is there");
            chair.properties.insert("ЦВЕТ".to_owned(), format!("Цвет-{n}"));
        },
        Some(|chair, n| {
            format!("set = \"{}\"\nproperty = \"ЦВЕТ\"\nvalue = \"Другой-{n}\"\n", chair.name)
        }),
    ),
    (
        "rename",
        |world, id, n| {
            let chair = world.replicas.get_mut(&id).expect("it is there");
            chair.name = format!("Кресло-{n}-{}", id.0);
        },
        Some(|chair, n| {
            format!("rename = \"{}\"\nto = \"Табурет-{n}-{}\"\n", chair.name, chair.id.0)
        }),
    ),
    (
        "door",
        |world, id, _| {
            let area = world.replicas[&id].area;
            let door = world.doors.get_mut(&DoorId(area.0)).expect("each ward has its own");
            door.state = orthoframe_map::DoorState::CLOSED;
        },
        Some(|chair, _| format!("state = \"Дверь-{}\"\nis = \"open\"\n", chair.area.0)),
    ),
    (
        "add",
        |world, id, n| {
            let last = *world.replicas.keys().next_back().expect("there are some");
            let (new, name) = (ReplicaId(last.0 + 1), format!("Скамья-{n}-{}", id.0));
            let chair = world.replicas[&id].clone();
            let frame = shifted(&chair.frame, 3.0, 0.0);
            world.replicas.insert(new, Replica { id: new, name, frame, ..chair });
        },
        Some(|chair, n| {
            let (area, at) = (chair.area.0 - 1, chair.frame.origin());
            let place = format!("object = \"chair\"\narea = \"ward-{area}\"\n");
            format!("place = \"Пуф-{n}-{}\"\n{place}at = [{}, {}]\n", chair.id.0, at.x, at.y - 3.0)
        }),
    ),
    (
        "remove",
        |world, id, _| drop(world.replicas.remove(&id)),
        Some(|chair, _| format!("remove = \"{}\"\n", chair.name)),
    ),
];

#[expect(clippy::print_stdout, reason = "a bench prints its figures")]
fn measure(wards: usize) {
    let world = hospital(wards);
    let change = change_now("bench", "a hospital");
    let dir = tempfile::tempdir_in(env!("CARGO_TARGET_TMPDIR")).expect("a directory");
    let dir = dir.path().join("store");
    let (mut store, _) = Store::open(&dir).expect("a new store");
    store.import(&world, &change).expect("the store takes it");
    drop(store);
    let mut engine = Engine::open(&dir, None).expect("the store is sound");
    engine.relations().expect("they end");
    let _ = engine.route("Палата-0", "Стул-1-0", Method::Shortest).expect("the floors are built");
    println!("\n{} things, {} doors\n", world.replicas.len(), world.doors.len());
    println!("| edit | median, ms | nine of ten below |\n|---|---|---|");
    let all = chairs(&world, wards);
    for (what, alter, text) in KINDS {
        let edit = |engine: &mut Engine, chair: ReplicaId, n: usize| {
            let clock = ProcessTime::now();
            let edited = engine.edit_world(&change, Mode::Commit, |world| alter(world, chair, n));
            // What was not followed is derived and built anew here.
            engine.relations().expect("they end");
            engine.floors().expect("they are built");
            let spent = clock.elapsed();
            assert!(!edited.expect("it is sound").differences.is_empty());
            spent
        };
        let (alone, others) = all.split_at(all.len() / 2);
        let times = alone.iter().enumerate().map(|(n, &chair)| edit(&mut engine, chair, n));
        let times = times.collect();
        tell(what, times);
        let mut held: Vec<Arc<State>> = Vec::new();
        let mut times = Vec::new();
        for (n, &chair) in others.iter().enumerate() {
            held.push(engine.state().expect("there is a map"));
            held.drain(..held.len().saturating_sub(HELD - 1));
            times.push(edit(&mut engine, chair, n + all.len()));
        }
        drop(held);
        tell(&format!("{what}, while the state before is asked"), times);
        let Some(text) = text else { continue };
        let left: Vec<Replica> =
            all.iter().filter_map(|id| engine.world().ok()?.replicas.get(id).cloned()).collect();
        let texts = left.iter().take(8).enumerate().map(|(n, chair)| {
            let source = Source::new("edit.toml", format!("[[edit]]\n{}", text(chair, n)));
            let clock = ProcessTime::now();
            let edits = Edits::read(&source, Format::Toml);
            let edited = engine.edit(&edits, &change, Mode::Commit);
            engine.relations().expect("they end");
            engine.floors().expect("they are built");
            let spent = clock.elapsed();
            assert!(!edited.expect("it is sound").differences.is_empty());
            spent
        });
        let times: Vec<Duration> = texts.collect();
        if !times.is_empty() {
            tell(&format!("{what}, as a text"), times);
        }
    }
}

fn main() {
    let sizes: Vec<usize> = std::env::args().filter_map(|size| size.parse().ok()).collect();
    let sizes = if sizes.is_empty() { vec![100, 500, 2_000] } else { sizes };
    sizes.into_iter().for_each(measure);
}
