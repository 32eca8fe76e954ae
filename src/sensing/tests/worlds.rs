//! Generated floors and simulated scans: what is called unique is right, what repeats itself is ambiguous, nothing panics.

use nalgebra::{Isometry2, Vector2};
use orthoframe_sensing::{Answer, Face, Locator};
use orthoframe_vectors::scan::{Noise, Sensor};
use proptest::prelude::*;

fn sensor() -> Sensor {
    let step = std::f64::consts::PI / 180.0;
    Sensor::new(-std::f64::consts::FRAC_PI_2, step, 181, (1.0, 2500.0), Noise::default())
        .expect("a sensor of half a turn")
}

fn outline(corners: &[(f64, f64)]) -> impl Iterator<Item = Face> + '_ {
    let at = |k: usize| {
        let (x, y) = corners[k % corners.len()];
        Vector2::new(x, y)
    };
    (0..corners.len()).map(move |k| Face::plain(at(k), at(k + 1)))
}

fn block(x: f64, y: f64, w: f64, h: f64) -> Vec<Face> {
    outline(&[(x, y), (x + w, y), (x + w, y + h), (x, y + h)]).collect()
}

/// Noise of the sensor, without a generator of normal numbers: the sum of twelve even ones.
fn noisy(ranges: &[f64], noise: f64, seed: u64) -> Vec<f64> {
    let mut random = fastrand::Rng::with_seed(seed);
    let mut normal = move || (0..12).map(|_| random.f64()).sum::<f64>() - 6.0;
    ranges.iter().map(|r| r + noise * normal()).collect()
}

fn is_right(fix: &Isometry2<f64>, truth: &Isometry2<f64>) -> bool {
    let apart = (fix.translation.vector - truth.translation.vector).norm();
    apart < 25.0 && fix.rotation.angle_to(&truth.rotation).abs() < 0.1
}

/// A floor of rooms of different sizes along a corridor, each with blocks in it, and a place to stand.
#[derive(Debug, Clone)]
struct Floor {
    faces: Vec<Face>,
    at: Isometry2<f64>,
}

/// Width, height, and where and how large the block in it is.
type Room = (f64, f64, f64, f64, f64, f64);

fn floors() -> impl Strategy<Value = Floor> {
    let room = (250.0..600.0, 300.0..600.0, 0.1..0.6, 0.1..0.6, 40.0..120.0, 40.0..120.0);
    (prop::collection::vec(room, 2..7), 0.1..0.9, 0.1..0.9, -3.1..3.1, any::<prop::sample::Index>())
        .prop_map(|(rooms, u, v, turn, which): (Vec<Room>, f64, f64, f64, prop::sample::Index)| {
            let (mut faces, mut x, mut places) = (Vec::new(), 0.0, Vec::new());
            for (w, h, a, b, c, d) in rooms {
                // A doorway of 90 cm at a place of its own.
                let door = x + 30.0 + a * (w - 150.0);
                let p = Vector2::new;
                faces.extend([
                    Face::plain(p(x, 0.0), p(door, 0.0)),
                    Face::plain(p(door + 90.0, 0.0), p(x + w, 0.0)),
                    Face::plain(p(x, 0.0), p(x, h)),
                    Face::plain(p(x, h), p(x + w, h)),
                    Face::plain(p(x + w, h), p(x + w, 0.0)),
                ]);
                faces.extend(block(x + a * (w - c), 40.0 + b * (h - d - 40.0), c, d));
                places.push((x, w, h));
                x += w + 10.0;
            }
            faces.extend(outline(&[(0.0, -10.0), (0.0, -190.0), (x, -190.0), (x, -10.0)]).take(3));
            let (left, w, h) = *which.get(&places);
            let at = Isometry2::new(Vector2::new(left + u * w, v * h), turn);
            Floor { faces, at }
        })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 96, ..ProptestConfig::default() })]

    /// What is called unique is right; the truth is never called unknown where it fits.
    #[test]
    fn unique_is_right(floor in floors(), seed in any::<u64>()) {
        let locator = Locator::new(floor.faces.clone());
        let exact = locator.expected(&sensor(), &floor.at);
        prop_assume!(exact.iter().all(|r| *r > 15.0));
        let ranges = noisy(&exact, 1.0, seed);
        if let Answer::Unique(fix) = locator.locate(&sensor(), &ranges) {
            prop_assert!(is_right(&fix.pose, &floor.at), "{:?} is not {:?}", fix, floor.at);
        }
    }

    /// A floor that is twice there leaves two poses, whatever stands in it.
    #[test]
    fn what_is_twice_there_is_never_unique(floor in floors(), seed in any::<u64>()) {
        let shift = Vector2::new(0.0, 3000.0);
        let twin = floor.faces.iter().map(|f| Face::plain(f.start + shift, f.end + shift));
        let locator = Locator::new(floor.faces.iter().copied().chain(twin).collect());
        let exact = Locator::new(floor.faces.clone()).expected(&sensor(), &floor.at);
        prop_assume!(exact.iter().all(|r| *r > 15.0));
        let answer = locator.locate(&sensor(), &noisy(&exact, 1.0, seed));
        prop_assert!(!matches!(answer, Answer::Unique(_)), "{answer:?}");
    }

    /// In a long corridor with doors at even distances one is never sure, wherever one stands.
    #[test]
    fn a_corridor_that_repeats_itself_is_never_unique(
        period in 200.0..500.0_f64, width in 150.0..300.0_f64, jamb in 5.0..30.0_f64, doors in 16_u32..24,
        x in 0.4..0.6, y in 0.3..0.7, turn in -3.1..3.1, seed in any::<u64>(),
    ) {
        let p = Vector2::new;
        let mut faces = Vec::new();
        for k in 0..doors {
            let from = f64::from(k) * period;
            for (wall, out) in [(0.0_f64, -jamb), (width, width + jamb)] {
                // A niche with a shut door in it.
                let (a, b) = (from + 50.0, from + 140.0);
                faces.extend([
                    Face::plain(p(from, wall), p(a, wall)),
                    Face::plain(p(a, wall), p(a, out)),
                    Face::plain(p(a, out), p(b, out)),
                    Face::plain(p(b, out), p(b, wall)),
                    Face::plain(p(b, wall), p(from + period, wall)),
                ]);
            }
        }
        let locator = Locator::new(faces);
        let truth = Isometry2::new(p(x * f64::from(doors) * period, y * width), turn);
        // So short-sighted that neither end of the corridor is seen.
        let near = Sensor::new(-1.57, 0.0174, 181, (1.0, 800.0), Noise::default()).expect("it reaches 8 m");
        let answer = locator.locate(&near, &noisy(&locator.expected(&near, &truth), 1.0, seed));
        prop_assert!(!matches!(answer, Answer::Unique(_)), "{answer:?}");
    }

    /// Any scan, of any sensor, among any faces, has an answer.
    #[test]
    fn no_scan_panics(
        ranges in prop::collection::vec(prop_oneof![any::<f64>(), 0.0..3000.0], 0..200),
        ends in prop::collection::vec((any::<f64>(), -1e3..1e3, -1e3..1e3, -1e3..1e3), 0..10),
    ) {
        let faces = ends.iter().map(|e| Face::plain(Vector2::new(e.0, e.1), Vector2::new(e.2, e.3)));
        let _ = Locator::new(faces.collect()).locate(&sensor(), &ranges);
    }
}

/// A square room looks the same after every quarter of a turn: four poses, all told.
#[test]
fn a_square_room_has_four_poses() {
    let locator = Locator::new(block(0.0, 0.0, 400.0, 400.0));
    let truth = Isometry2::new(Vector2::new(150.0, 120.0), 0.3);
    let around =
        Sensor::new(-3.1, 0.0174, 357, (1.0, 1000.0), Noise::default()).expect("all round");
    let answer = locator.locate(&around, &locator.expected(&around, &truth));
    let Answer::Ambiguous(fixes) = answer else { panic!("{answer:?}") };
    assert_eq!(fixes.len(), 4, "{fixes:?}");
    assert!(fixes.iter().any(|f| is_right(&f.pose, &truth)));
}

/// Two walls alone fix a pose, and yet say nothing of which two they are.
#[test]
fn two_walls_are_never_unique() {
    let p = Vector2::new;
    let faces =
        vec![Face::plain(p(0.0, 0.0), p(500.0, 0.0)), Face::plain(p(0.0, 0.0), p(0.0, 500.0))];
    let locator = Locator::new(faces);
    let truth = Isometry2::new(p(150.0, 150.0), -2.3);
    let answer = locator.locate(&sensor(), &locator.expected(&sensor(), &truth));
    assert!(matches!(answer, Answer::Ambiguous(_)), "{answer:?}");
}
