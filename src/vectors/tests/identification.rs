//! Knowing things again: against looking at everything, and how often it is right.

#![expect(clippy::print_stdout, reason = "a table of what was measured")]

use super::shapes::{Hiding, Kind, chain, stored, thing, view, view_of_chain};
use fastrand::Rng;
use nalgebra::Vector2;
use orthoframe_vectors::{
    Covariance, Cut, End, Identification, Index, Model, Motion, Options, Placement, Scale, Segment,
    ThingId, exhaustive,
};

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

/// A library and its index.
struct Known {
    kind: Kind,
    models: Vec<Model<2>>,
    index: Index<2>,
}

impl Known {
    fn new(kind: Kind, things: u64) -> Self {
        let models: Vec<Model<2>> = (0..things).map(|k| stored(kind, k, 30, 0.3)).collect();
        let index = Index::of(&models, Options::default());
        Self { kind, models, index }
    }

    /// Shares of views that were known, that were taken for something else, whose first answer was right, and
    /// comparisons per view; of things that are not stored, where `strangers`.
    fn measure(&self, hidden: f64, hiding: Hiding, rounds: u64, strangers: bool) -> [f64; 4] {
        let things = self.models.len() as u64;
        let mut rng = Rng::with_seed(things ^ (hidden * 100.0) as u64);
        let (mut right, mut wrong, mut first, mut cost) = (0, 0, 0, 0);
        for _ in 0..rounds {
            let number = rng.u64(..things);
            let shown = if strangers { things + number } else { number };
            let (seen, truth) = view(&thing(self.kind, shown, 30), hidden, hiding, 1.0, &mut rng);
            let found = self.index.identify(&self.models[..], &seen);
            cost += found.counters.comparisons();
            let is_true = |place: &Placement<2>| {
                let at =
                    |motion: &Motion<2>| motion.transform_point(&seen.segments()[0].at(0.5).into());
                !strangers
                    && u64::from(place.thing.0) == number
                    && (at(&place.motion) - at(&truth)).norm() < 10.0
            };
            first += u64::from(found.answer.placements().first().is_some_and(is_true));
            match found.answer.unique().map(is_true) {
                Some(true) => right += 1,
                Some(false) => wrong += 1,
                None => {}
            }
        }
        [right, wrong, first, cost].map(|n| n as f64 / rounds as f64)
    }
}

#[test]
fn things_are_known_again_and_nothing_is_taken_for_another() {
    let read =
        |name: &str, or: u64| std::env::var(name).ok().and_then(|n| n.parse().ok()).unwrap_or(or);
    let (things, rounds) = (read("VECTORS_THINGS", 200), read("VECTORS_VIEWS", 60));
    // Share of a thing that is hidden, and of the views the least share known, of generic and of rectangular things.
    let goals = [
        (0.0, 0.98, 0.95),
        (0.3, 0.98, 0.95),
        (0.5, 0.98, 0.95),
        (0.7, 0.98, 0.6),
        (0.8, 0.95, 0.0),
        (0.9, 0.0, 0.0),
    ];
    for kind in [Kind::Generic, Kind::Rectangular] {
        let known = Known::new(kind, things);
        for hiding in [Hiding::Side, Hiding::Scattered] {
            for (hidden, generic, rectangular) in goals {
                let least = if kind == Kind::Generic { generic } else { rectangular };
                let [right, wrong, first, cost] = known.measure(hidden, hiding, rounds, false);
                println!(
                    "{kind:?} {hiding:?} {hidden}: right {right} wrong {wrong} first {first} comparisons {cost}"
                );
                assert!(right >= least, "{kind:?} {hiding:?} {hidden}: {right}");
                assert!(wrong <= 0.01, "{kind:?} {hiding:?} {hidden}: {wrong}");
            }
        }
        for hidden in [0.0, 0.5, 0.7, 0.8] {
            let [_, wrong, _, cost] = known.measure(hidden, Hiding::Side, rounds, true);
            println!("{kind:?} strangers {hidden}: wrong {wrong} comparisons {cost}");
            assert!(wrong <= 0.01, "{kind:?} strangers {hidden}: {wrong}");
        }
    }
}

/// A stub of a wall, its direction hardly known, is one line more and takes no other away: what is seen besides counts.
#[test]
fn a_stub_is_no_line_on_which_all_others_lie() {
    let models: Vec<Model<2>> = (0..50).map(|k| stored(Kind::Generic, k, 30, 0.3)).collect();
    let index = Index::of(&models, Options::default());
    for number in 0..50_u32 {
        let mut seen = thing(Kind::Generic, u64::from(number), 30)[3..12].to_vec();
        for s in &mut seen {
            s.covariance = Covariance::isotropic(1.0);
        }
        let stub = seen[0].vector().normalize() * 4.0;
        seen[0].start = seen[0].end - stub;
        seen[0].ends[0] = End::Cut(Cut::Occluded);
        let found = index.identify(&models[..], &Model::of_contour(seen)).answer;
        assert_eq!(found.unique().map(|place| place.thing), Some(ThingId(number)), "{found:?}");
    }
}

/// SPEC V20: two walls fit wherever two walls meet as they do, also where only one such place is stored.
#[test]
fn a_view_of_two_walls_is_never_unique() {
    let mut rng = Rng::with_seed(4);
    for things in [1, 20] {
        let models: Vec<Model<2>> =
            (0..things).map(|k| stored(Kind::Generic, k, 12, 0.3)).collect();
        let index = Index::of(&models, Options::default());
        for round in 0..20 {
            let (seen, _) =
                view(&thing(Kind::Generic, round % things, 12), 0.8, Hiding::Side, 1.0, &mut rng);
            assert_eq!(seen.len(), 2);
            let found = index.identify(&models[..], &seen).answer;
            assert!(found.unique().is_none());
            assert!(found.placements().iter().any(|p| p.thing.0 == (round % things) as u32));
            // Also when both walls are seen from end to end.
            let whole = Model::of_contour(thing(Kind::Generic, round % things, 12)[3..5].to_vec());
            let found = index.identify(&models[..], &whole).answer;
            assert!(found.unique().is_none() && !found.placements().is_empty());
        }
    }
}

/// A square looks the same from four sides: all four are told.
#[test]
fn what_looks_alike_from_several_sides_is_told_as_such() {
    let corners = [[0.0, 0.0], [100.0, 0.0], [100.0, 100.0], [0.0, 100.0]].map(Vector2::from);
    let square: Vec<Segment<2>> =
        (0..4).map(|k| Segment::given(corners[k], corners[(k + 1) % 4], 1.0)).collect();
    let models = vec![Model::of_contour(square.clone())];
    let index = Index::of(&models, Options::default());
    let Identification::Ambiguous(places) =
        index.identify(&models[..], &Model::of_contour(square)).answer
    else {
        panic!("four places")
    };
    assert_eq!(places.len(), 4);
    assert!(places.iter().all(|p| (p.probability - 0.25).abs() < 0.05));
}

#[test]
fn things_are_known_again_in_space() {
    let mut rng = Rng::with_seed(6);
    let models: Vec<Model<3>> = (0..60).map(|k| chain(k, 14, 0.5)).collect();
    for scale in [Scale::Known, Scale::Free] {
        let options = Options { scale, ..Options::default() };
        let index = Index::of(&models, options);
        let mut right = 0;
        for round in 0..30 {
            let number = rng.usize(..models.len());
            let (seen, truth) = view_of_chain(&models[number], 7, 1.0, &mut rng);
            // Of unknown size: the view is as if seen from twice as far.
            let grown = if scale == Scale::Free {
                Motion::<3>::from_scaling(2.0)
            } else {
                Motion::identity()
            };
            let seen = seen.moved(&grown);
            let found = index.identify(&models[..], &seen);
            if round < 3 {
                let near: Vec<Model<3>> = models[..12].to_vec();
                let few = Index::of(&near, options).identify(&near[..], &seen);
                let all = exhaustive(&near, &seen, &options).answer;
                assert!(
                    among(&answers(&few.answer), &answers(&all))
                        && among(&answers(&all), &answers(&few.answer))
                );
            }
            if let Some(place) = found.answer.unique() {
                assert_eq!(place.thing, ThingId(number as u32));
                let truth = truth * grown.inverse();
                assert!((place.motion.scaling() - truth.scaling()).abs() < 0.05);
                let at = seen.segments()[3].start;
                let off =
                    place.motion.transform_point(&at.into()) - truth.transform_point(&at.into());
                assert!(off.norm() < 5.0, "{off:?}");
                right += 1;
            }
        }
        assert!(right >= 29, "{scale:?}: {right} of 30");
    }
}

/// The index follows a library that changes.
#[test]
fn things_come_and_go() {
    let mut models: Vec<Model<2>> = (0..30).map(|k| stored(Kind::Generic, k, 14, 0.3)).collect();
    let mut index = Index::of(&models, Options::default());
    let mut rng = Rng::with_seed(8);
    let (seen, _) = view(&thing(Kind::Generic, 7, 14), 0.3, Hiding::Side, 1.0, &mut rng);
    let known = |index: &Index<2>, models: &[Model<2>]| {
        index.identify(models, &seen).answer.unique().map(|p| p.thing.0)
    };
    assert_eq!(known(&index, &models), Some(7));
    index.remove(ThingId(7));
    assert_eq!((known(&index, &models), index.len()), (None, 29));
    models[7] = stored(Kind::Generic, 99, 14, 0.3);
    index.insert(ThingId(7), &models[7]);
    assert_eq!(known(&index, &models), None);
    models[2] = stored(Kind::Generic, 7, 14, 0.3);
    index.insert(ThingId(2), &models[2]);
    assert_eq!((known(&index, &models), index.len()), (Some(2), 30));
}
