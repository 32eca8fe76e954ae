//! Own motion, the differential mode, rigid parts.

use std::hint::black_box;

use fastrand::Rng;
use nalgebra::{Rotation2, Rotation3, Vector2, Vector3};
use orthoframe_vectors::{Equality, Model, Motion, Scene, Segment, Transition, costs, difference};

use super::{
    least, median,
    shapes::{Kind, chain, normal, stored, thing},
};

pub(crate) fn run() {
    own_motion();
    differential();
}

fn own_motion() {
    let mut plane = Scene::<2>::new(Equality::at(0.99));
    let mut space = Scene::<3>::new(Equality::at(0.99));
    for k in 0..10_000 {
        plane.add(&stored(Kind::Generic, k, 10, 0.3));
        space.add(&chain(k, 4, 0.3));
    }
    let before = (plane.writes(), space.writes());
    let step2 = Transition::<2>::from_parts(Vector2::new(3.0, 1.0).into(), Rotation2::new(0.02));
    let step3 = Transition::<3>::from_parts(
        Vector3::new(3.0, 1.0, 0.1).into(),
        Rotation3::new(Vector3::new(0.0, 0.01, 0.02)),
    );
    let flat = median(501, || plane.robot_moved(black_box(&step2)));
    let deep = median(501, || space.robot_moved(black_box(&step3)));
    println!(
        "\n10 000 things, own motion: {:.3} ms in the plane, {:.3} ms in space;",
        flat.as_secs_f64() * 1e3,
        deep.as_secs_f64() * 1e3
    );
    let written =
        (plane.writes().segments - before.0.segments, space.writes().segments - before.1.segments);
    println!("segments written: {} and {}.", written.0, written.1);
}

/// Two observations of 500 segments: the second from elsewhere, some things moved.
fn differential() {
    let mut rng = Rng::with_seed(1);
    let noisy = |segments: &[Segment<2>], rng: &mut Rng| -> Vec<Segment<2>> {
        let mut noise = |s: &Segment<2>| {
            let mut error = || Vector2::new(normal(rng), normal(rng));
            Segment::given(s.start + error(), s.end + error(), 1.0)
        };
        segments.iter().map(&mut noise).collect()
    };
    let shift = |x: f64, y: f64, turn: f64| {
        Motion::<2>::from_parts(Vector2::new(x, y).into(), Rotation2::new(turn), 1.0)
    };
    let mut segments: Vec<Segment<2>> = Vec::new();
    for k in 0..25 {
        let (x, y) = (f64::from(k % 5) * 900.0, f64::from(k / 5) * 900.0);
        segments
            .extend(thing(Kind::Generic, k as u64, 20).iter().map(|s| s.moved(&shift(x, y, 0.0))));
    }
    println!(
        "\nDifferential mode, two models of {} segments ({} comparisons as the paper counts):",
        segments.len(),
        costs::differential(500, 500)
    );
    println!("\n| what changed | ms, models built | ms, compared | comparisons | parts |");
    println!("|---|---|---|---|---|");
    let equality = Equality::at(0.999);
    let show = |name: &str, things: &[usize], guess: Option<Motion<2>>, rng: &mut Rng| {
        let mut after = segments.clone();
        for &t in things {
            for s in &mut after[20 * t..20 * t + 20] {
                *s = s.moved(&shift(9.0, 6.0, 0.003));
            }
        }
        let (before, after) = (noisy(&segments, rng), noisy(&after, rng));
        let build = least(51, || {
            black_box(Model::of_contour(after.clone()));
        });
        let (before, after) = (Model::of_contour(before), Model::of_contour(after));
        let found = difference(&before, &after, guess.as_ref(), &equality);
        let time = least(51, || {
            black_box(difference(&before, &after, guess.as_ref(), &equality));
        });
        let sizes: Vec<usize> = found.parts.iter().map(|p| p.members.len()).collect();
        let ms = |t: std::time::Duration| t.as_secs_f64() * 1e3;
        println!(
            "| {name} | {:.3} | {:.3} | {} | {sizes:?} |",
            ms(build),
            ms(time),
            found.counters.comparisons()
        );
    };
    show("nothing", &[], Some(Motion::identity()), &mut rng);
    show("one thing", &[7], Some(Motion::identity()), &mut rng);
    show("three things alike", &[7, 12, 20], Some(Motion::identity()), &mut rng);
    show("nothing, place unknown", &[], None, &mut rng);
}
