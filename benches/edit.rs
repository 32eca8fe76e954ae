//! One durable edit of a hospital, with the relations and the floor kept in step: at several sizes of the map, while nobody
//! else has the state before it, and while others do.
//!
//! `cargo bench --bench edit [-- WARDS ...]`; a ward holds 20 things.

mod wards;

use std::sync::Arc;
use std::time::Duration;

use cpu_time::ProcessTime;
use orthoframe::Engine;
use orthoframe::engine::{Method, Mode, State, World, change_now};
use orthoframe_map::Format;
use orthoframe_store::{Change, Store};
use orthoframe_units::{Deg, Frame, ReplicaId, Source};

const WARD: &str = include_str!("wards/ward.toml");
/// Edits of each kind.
const EDITS: usize = 60;
/// So many states before the last are still held.
const HELD: usize = 2;

/// Wards side by side and back to back.
fn hospital(wards: usize) -> World {
    wards::hospital(WARD, wards, usize::MAX, |n| {
        Frame::new((n % 45) as f64 * 520.0, (n / 45) as f64 * 420.0, 0.0, Deg::ZERO)
    })
}

/// The chairs of wards all over the hospital.
fn chairs(world: &World, wards: usize) -> Vec<ReplicaId> {
    let name = |n: usize| format!("Стул-{}-{}", n % 8 + 1, n * 7919 % wards);
    let find = |name: &String| world.replicas.values().find(|r| r.name == *name).map(|r| r.id);
    (0..EDITS).filter_map(|n| find(&name(n))).collect()
}

/// Median and worst of some times.
#[expect(clippy::print_stdout, reason = "a bench prints its figures")]
fn tell(what: &str, mut times: Vec<Duration>) {
    times.sort();
    let ms = |time: Duration| time.as_secs_f64() * 1e3;
    let [median, most] = [times[times.len() / 2], times[times.len() * 9 / 10]];
    println!("  {what}: {:.2} ms of processor time, nine of ten below {:.2}", ms(median), ms(most));
}

fn shift(engine: &mut Engine, chair: ReplicaId, by: f64, change: &Change) {
    let shifted = engine.edit_world(change, Mode::Commit, |world| {
        let chair = world.replicas.get_mut(&chair).expect("it is there");
        let at = chair.frame.origin();
        chair.frame = Frame::new(at.x, at.y + by, chair.frame.z.get(), chair.frame.angle);
    });
    assert_eq!(shifted.expect("it may stand there").differences.len(), 1);
}

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
    println!("{} things", world.replicas.len());
    let chairs = chairs(&world, wards);
    let timed = |engine: &mut Engine, chair, by| {
        let clock = ProcessTime::now();
        shift(engine, chair, by, &change);
        clock.elapsed()
    };
    let alone = chairs.iter().map(|&chair| timed(&mut engine, chair, 1.0)).collect();
    tell("nobody has the state before", alone);
    let mut held: Vec<Arc<State>> = Vec::new();
    let mut shared = Vec::new();
    for &chair in &chairs {
        held.push(engine.state().expect("there is a map"));
        held.drain(..held.len().saturating_sub(HELD - 1));
        shared.push(timed(&mut engine, chair, -1.0));
    }
    tell("the last state is asked by others", shared);
    let texts = chairs.iter().take(5).map(|id| {
        let name = &world.replicas[id].name;
        let text = format!("[[edit]]\nmove = \"{name}\"\nby = [0, 1]\n");
        let source = Source::new("edit.toml", text);
        let clock = ProcessTime::now();
        let edited = engine.edit(&source, Format::Toml, &change, Mode::Commit);
        edited.expect("it may stand there");
        clock.elapsed()
    });
    let texts = texts.collect();
    tell("as a text", texts);
}

fn main() {
    let sizes: Vec<usize> = std::env::args().filter_map(|size| size.parse().ok()).collect();
    let sizes = if sizes.is_empty() { vec![100, 500, 2_000] } else { sizes };
    sizes.into_iter().for_each(measure);
}
