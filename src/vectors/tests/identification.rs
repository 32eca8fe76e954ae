//! Knowing things again: against looking at everything, and how often it is right.

#[path = "../../../benches/vectors/shapes.rs"]
mod shapes;

use fastrand::Rng;
use orthoframe_vectors::{
    Identification, Index, Model, Motion, Options, Placement, Scale, Search, ThingId, exhaustive,
};
use shapes::{Hiding, Kind, stored, thing, view};

type Answer = (ThingId, Vec<(usize, usize, bool)>);

/// Thing and matched segments of every placement.
fn answers<const D: usize>(found: &Identification<D>) -> Vec<Answer> {
    found.placements().iter().map(|p| (p.thing, p.pairs.clone())).collect()
}

/// Whether each placement of `some` is one of `all`; a segment between two faces may lie on either.
fn among(some: &[Answer], all: &[Answer]) -> bool {
    some.iter().all(|(thing, pairs)| {
        all.iter().any(|(other, theirs)| {
            let shared = pairs.iter().filter(|pair| theirs.contains(pair)).count();
            thing == other && 2 * shared > pairs.len().max(theirs.len())
        })
    })
}

#[test]
fn the_index_answers_what_looking_at_everything_answers() {
    let rounds = std::env::var("VECTORS_ROUNDS").ok().and_then(|n| n.parse().ok()).unwrap_or(6);
    let mut rng = Rng::with_seed(rounds);
    let (mut views, mut ambiguous, mut missed) = (0, 0, 0);
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
                let fast = index.identify(&models[..], &seen);
                let slow = exhaustive(&models, &seen, &options).answer;
                let (found, all) = (answers(&fast.answer), answers(&slow));
                let case = format!("{kind:?} {scale:?} {hiding:?} thing {number} hidden {hidden}");
                assert!(among(&found, &all), "{case}: {found:?} not in {all:?}");
                assert!(!fast.complete || among(&all, &found), "{case}: {found:?} is not {all:?}");
                assert!(
                    fast.complete || hiding == Hiding::Scattered,
                    "{case}: one run is always searched whole"
                );
                missed += u64::from(!among(&all, &found));
                let fast = fast.answer;
                views += 1;
                ambiguous += u64::from(fast.unique().is_none() && !fast.placements().is_empty());
            }
        }
    }
    println!("{views} views, {ambiguous} ambiguous, {missed} times less than all");
    assert!(missed * 50 <= views, "{missed} of {views}");
}

/// Shares of views that were known, known as something else, and what it cost.
fn measure(
    kind: Kind,
    things: u64,
    hidden: f64,
    hiding: Hiding,
    rounds: u64,
    strangers: bool,
) -> (f64, f64, f64, f64) {
    let models: Vec<Model<2>> = (0..things).map(|k| stored(kind, k, 30, 0.3)).collect();
    let index = Index::of(&models, Options::default());
    let mut rng = Rng::with_seed(things ^ (hidden * 100.0) as u64);
    let (mut right, mut wrong, mut first, mut cost) = (0, 0, 0, 0);
    for _ in 0..rounds {
        let number = rng.u64(..things);
        let shown = if strangers { things + number } else { number };
        let (seen, truth) = view(&thing(kind, shown, 30), hidden, hiding, 1.0, &mut rng);
        let Search { answer: found, counters, .. } = index.identify(&models[..], &seen);
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
    let share = |n: u64| n as f64 / rounds as f64;
    (share(right), share(wrong), share(first), share(cost))
}

#[test]
fn things_are_known_again_and_nothing_is_taken_for_another() {
    let read =
        |name: &str, or: u64| std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(or);
    let (things, rounds) = (read("VECTORS_THINGS", 300), read("VECTORS_VIEWS", 100));
    for kind in [Kind::Generic, Kind::Rectangular] {
        for hiding in [Hiding::Side, Hiding::Scattered] {
            for hidden in [0.0, 0.3, 0.5, 0.7, 0.8, 0.9] {
                let (right, wrong, first, cost) =
                    measure(kind, things, hidden, hiding, rounds, false);
                println!(
                    "{kind:?} {hiding:?} {hidden}: right {right} wrong {wrong} first {first} comparisons {cost}"
                );
            }
        }
        let (_, wrong, _, cost) = measure(kind, things, 0.5, Hiding::Side, rounds, true);
        println!("{kind:?} strangers: wrong {wrong} comparisons {cost}");
    }
}
