//! Knowing things again: against looking at everything, and how often it is right.

#[path = "../../../benches/vectors/shapes.rs"]
mod shapes;

use fastrand::Rng;
use nalgebra::Vector2;
use orthoframe_vectors::{
    Counters, Cut, End, Identification, Index, Model, Options, Scale, Segment, ThingId, exhaustive,
};
use shapes::{Hiding, Kind, chain, stored, thing, view, view_of_chain};

/// Thing and matched segments of every placement, in any order.
fn answers<const D: usize>(found: &Identification<D>) -> Vec<(ThingId, Vec<(usize, usize, bool)>)> {
    let mut all: Vec<_> = found.placements().iter().map(|p| (p.thing, p.pairs.clone())).collect();
    all.sort();
    all
}

#[test]
fn the_index_answers_what_looking_at_everything_answers() {
    let rounds = std::env::var("VECTORS_ROUNDS").ok().and_then(|n| n.parse().ok()).unwrap_or(6);
    let mut rng = Rng::with_seed(rounds);
    let (mut views, mut ambiguous) = (0, 0);
    for kind in [Kind::Generic, Kind::Rectangular] {
        let models: Vec<Model<2>> = (0..8).map(|k| stored(kind, k, 12, 0.5)).collect();
        for scale in [Scale::Known, Scale::Free] {
            let options = Options { scale, ..Options::default() };
            let index = Index::of(&models, options);
            for round in 0..rounds {
                let hiding = if round % 2 == 0 { Hiding::Side } else { Hiding::Scattered };
                let number = rng.u64(..10); // two of them are not stored
                let hidden = 0.14 * (round % 6) as f64;
                let (seen, _) = view(&thing(kind, number, 12), hidden, hiding, 1.0, &mut rng);
                let (fast, _) = index.identify(&models[..], &seen);
                let (slow, _) = exhaustive(&models, &seen, &options);
                assert_eq!(
                    answers(&fast),
                    answers(&slow),
                    "{kind:?} {scale:?} {hiding:?} thing {number} hidden {hidden}"
                );
                views += 1;
                ambiguous += u32::from(fast.unique().is_none() && !fast.placements().is_empty());
                assert_eq!(fast.unique().is_some(), slow.unique().is_some());
            }
        }
    }
    println!("{views} views, {ambiguous} ambiguous: the same answers");
}

/// Shares of views that were known, known as something else, and what it cost.
fn measure(
    kind: Kind,
    things: u64,
    hidden: f64,
    hiding: Hiding,
    rounds: u64,
    strangers: bool,
) -> (f64, f64, f64) {
    let models: Vec<Model<2>> = (0..things).map(|k| stored(kind, k, 30, 0.3)).collect();
    let index = Index::of(&models, Options::default());
    let mut rng = Rng::with_seed(things ^ (hidden * 100.0) as u64);
    let (mut right, mut wrong, mut cost) = (0, 0, 0);
    for _ in 0..rounds {
        let number = rng.u64(..things);
        let shown = if strangers { things + number } else { number };
        let (seen, truth) = view(&thing(kind, shown, 30), hidden, hiding, 1.0, &mut rng);
        let (found, counters) = index.identify(&models[..], &seen);
        cost += counters.comparisons();
        if let Some(place) = found.unique() {
            let at = place.motion.transform_point(&seen.segments()[0].at(0.5).into()).coords;
            let off =
                (at - truth.transform_point(&seen.segments()[0].at(0.5).into()).coords).norm();
            if place.thing == ThingId(number as u32) && !strangers && off < 10.0 {
                right += 1;
            } else {
                wrong += 1;
            }
        }
    }
    (right as f64 / rounds as f64, wrong as f64 / rounds as f64, cost as f64 / rounds as f64)
}

#[test]
fn things_are_known_again_and_nothing_is_taken_for_another() {
    let read =
        |name: &str, or: u64| std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(or);
    let (things, rounds) = (read("VECTORS_THINGS", 300), read("VECTORS_VIEWS", 100));
    for kind in [Kind::Generic, Kind::Rectangular] {
        for hiding in [Hiding::Side, Hiding::Scattered] {
            for hidden in [0.0, 0.3, 0.5, 0.7, 0.8, 0.9] {
                let (right, wrong, cost) = measure(kind, things, hidden, hiding, rounds, false);
                println!(
                    "{kind:?} {hiding:?} {hidden}: right {right} wrong {wrong} comparisons {cost}"
                );
            }
        }
        let (_, wrong, cost) = measure(kind, things, 0.5, Hiding::Side, rounds, true);
        println!("{kind:?} strangers: wrong {wrong} comparisons {cost}");
    }
}
