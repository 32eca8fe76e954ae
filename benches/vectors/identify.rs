//! Identification: how often it is right, what it compares, how long it takes.

use std::{borrow::Cow, hint::black_box, time::Instant};

use fastrand::Rng;
use orthoframe_vectors::{Index, Library, Model, Motion, Options, Placement, ThingId, costs};

use super::shapes::{Hiding, Kind, stored, thing, view};

const SEGMENTS: usize = 30;

/// Things made when they are asked for: a library larger than memory.
struct Made {
    kind: Kind,
}

impl Library<2> for Made {
    fn model(&self, thing: ThingId) -> Option<Cow<'_, Model<2>>> {
        Some(Cow::Owned(stored(self.kind, u64::from(thing.0), SEGMENTS, 0.3)))
    }
}

#[derive(Default)]
struct Row {
    right: u64,
    wrong: u64,
    first: u64,
    comparisons: u64,
    micros: Vec<f64>,
}

fn measure<L: Library<2> + ?Sized>(
    (index, library): (&Index<2>, &L),
    kind: Kind,
    things: u64,
    (hidden, hiding): (f64, Hiding),
    views: u64,
    strangers: bool,
) -> Row {
    let mut rng = Rng::with_seed(things + (hidden * 1000.0) as u64);
    let mut row = Row::default();
    for _ in 0..views {
        let number = rng.u64(..things);
        let shown = if strangers { number + things } else { number };
        let (seen, truth) = view(&thing(kind, shown, SEGMENTS), hidden, hiding, 1.0, &mut rng);
        let start = Instant::now();
        let found = black_box(index.identify(library, &seen));
        row.micros.push(start.elapsed().as_secs_f64() * 1e6);
        row.comparisons += found.counters.comparisons();
        let is_true = |place: &Placement<2>| {
            let at = |m: &Motion<2>| m.transform_point(&seen.segments()[0].at(0.5).into());
            !strangers
                && u64::from(place.thing.0) == number
                && (at(&place.motion) - at(&truth)).norm() < 10.0
        };
        row.first += u64::from(found.answer.placements().first().is_some_and(is_true));
        match found.answer.unique().map(is_true) {
            Some(true) => row.right += 1,
            Some(false) => row.wrong += 1,
            None => {}
        }
    }
    row
}

fn print(name: &str, mut row: Row, views: u64, segments: u64, seen: u64) -> f64 {
    let share = |n: u64| n as f64 / views as f64;
    row.micros.sort_by(f64::total_cmp);
    let comparisons = share(row.comparisons);
    let fewer = costs::search(segments, seen) as f64 / comparisons.max(1.0);
    println!(
        "| {name} | {:.3} | {:.3} | {:.3} | {comparisons:.0} | {fewer:.1e} | {:.0} |",
        share(row.right),
        share(row.wrong),
        share(row.first),
        row.micros[row.micros.len() / 2],
    );
    comparisons
}

fn head(title: &str) {
    println!("\n{title}\n");
    println!(
        "| view | unique, right | unique, wrong | first is right | comparisons | times fewer | µs |"
    );
    println!("|---|---|---|---|---|---|---|");
}

pub(crate) fn run() {
    let things = 10_000;
    let views = 400;
    for kind in [Kind::Generic, Kind::Rectangular] {
        let models: Vec<Model<2>> = (0..things).map(|k| stored(kind, k, SEGMENTS, 0.3)).collect();
        let start = Instant::now();
        let index = Index::of(&models, Options::default());
        let built = start.elapsed();
        let title = format!(
            "{kind:?}: {things} things of {SEGMENTS} segments, σ = 1 cm, indexed in {:.2} s. Times fewer than the paper's T(T − 1)/2 · M(M − 1)/2 with T = {things} segments in the tree, which has {SEGMENTS} times as many.",
            built.as_secs_f64()
        );
        head(&title);
        for hiding in [Hiding::Side, Hiding::Scattered] {
            for hidden in [0.0, 0.3, 0.5, 0.7, 0.8, 0.9] {
                let row =
                    measure((&index, &models[..]), kind, things, (hidden, hiding), views, false);
                let seen = ((1.0 - hidden) * SEGMENTS as f64).round() as u64;
                print(&format!("{hiding:?}, {hidden} hidden"), row, views, things, seen);
            }
        }
        for hidden in [0.0, 0.5, 0.8] {
            let row =
                measure((&index, &models[..]), kind, things, (hidden, Hiding::Side), views, true);
            print(&format!("not stored, {hidden} hidden"), row, views, things, SEGMENTS as u64);
        }
    }
}

/// Comparisons for 10³ to 10⁶ things.
pub(crate) fn million() {
    head(
        "Generic shapes, half hidden on one side, by the number of things (links of three in a row alone).",
    );
    let library = Made { kind: Kind::Generic };
    let views = 200;
    let mut first = None;
    for things in [1_000_u64, 10_000, 100_000, 1_000_000] {
        // What is seen of one side has no cut ends within: the keys of whole links suffice.
        let mut index = Index::new(Options { reach: 2, cut_ends: false, ..Options::default() });
        index.reserve(things as usize * SEGMENTS * 2);
        for k in 0..things {
            index.insert(ThingId(k as u32), &stored(Kind::Generic, k, SEGMENTS, 0.3));
        }
        index.merge();
        let row =
            measure((&index, &library), Kind::Generic, things, (0.5, Hiding::Side), views, false);
        let comparisons =
            print(&format!("{things} things"), row, views, things, SEGMENTS as u64 / 2);
        let base = *first.get_or_insert(comparisons);
        println!("| of which times those of 1000 | | | | {:.2} | | |", comparisons / base);
    }
}
