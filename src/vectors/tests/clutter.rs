//! Scans of cluttered rooms: no face stands where beams went past it, ends lie where something was seen, and a fit within so
//! many vertices is a good one.

use nalgebra::{Isometry2, Matrix4, Rotation2, Vector2, Vector4};
use orthoframe_vectors::scan::{Extractor, Noise, Sensor, cast};
use orthoframe_vectors::{End, Segment, Truth};
use proptest::prelude::*;

use super::shapes::normal;

const NOISE: Noise = Noise { range: 1.0, share: 0.0, bearing: 0.0 };

fn sensor(beams: usize, field: f64) -> Sensor {
    let step = field / beams as f64;
    Sensor::new(-0.5 * field, step, beams, (1.0, 5000.0), NOISE).expect("a sensor")
}

/// A long room with things of a few cm to a metre in it, some of them no wider than a beam.
fn clutter(things: usize, rng: &mut fastrand::Rng) -> Vec<Segment<2>> {
    let (wide, tall) = (300.0 + 2500.0 * rng.f64(), 200.0 + 600.0 * rng.f64());
    let at = |x: f64, y: f64| Vector2::new(x, y);
    let room = [at(-200.0, -tall), at(wide, -tall), at(wide, tall), at(-200.0, tall)];
    let wall = |k: usize| Segment::given(room[k], room[(k + 1) % 4], 0.0);
    let mut all: Vec<Segment<2>> = (0..4).map(wall).collect();
    for _ in 0..things {
        let turn = Rotation2::new(rng.f64() * std::f64::consts::TAU);
        let middle = at(60.0 + rng.f64() * (wide - 60.0), (2.0 * rng.f64() - 1.0) * tall);
        let half = 0.5 * 10.0_f64.powf(0.3 + 1.7 * rng.f64());
        let side = turn * at(half, 0.0);
        all.push(Segment::given(middle - side, middle + side, 0.0));
        if rng.bool() {
            let depth = turn * at(0.0, 10.0 + 40.0 * rng.f64());
            all.push(Segment::given(middle + side, middle + side + depth, 0.0));
        }
    }
    all
}

/// What the sensor measures; where a beam is half on an edge it may tell a range between that of the edge and that behind.
fn measured(sensor: &Sensor, scene: &[Segment<2>], rng: &mut fastrand::Rng) -> Vec<f64> {
    let struck = cast(sensor, &Isometry2::identity(), scene, 0.0);
    let mut ranges: Vec<f64> =
        struck.into_iter().map(|s| s.map_or(f64::NAN, |s| s.range + normal(rng))).collect();
    for k in 1..ranges.len() {
        let jump = ranges[k] - ranges[k - 1];
        if jump.abs() > 20.0 && rng.f64() < 0.3 {
            ranges[k] -= jump * rng.f64();
        }
    }
    ranges
}

/// How far beams are off the segments that they strike first, in cm across the segment, and of which beam and segment.
fn missed(sensor: &Sensor, ranges: &[f64], segments: &[Segment<2>]) -> Vec<(f64, usize, usize)> {
    let struck = cast(sensor, &Isometry2::identity(), segments, 0.0);
    let beams = ranges.iter().zip(struck).enumerate().filter(|(_, (r, _))| sensor.returned(**r));
    beams
        .filter_map(|(beam, (range, struck))| {
            let struck = struck?;
            let along = segments[struck.segment].vector().try_normalize(1e-9)?;
            let facing = along.perp(&sensor.directions()[beam]).abs();
            Some(((range - struck.range) * facing, beam, struck.segment))
        })
        .collect()
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    /// Where a beam went past it or stopped before it there is no face, but for a single spike that a line goes on over.
    #[test]
    fn no_face_stands_where_beams_went_past(
        things in 5..60_usize, beams in 120..500_usize, seed in any::<u64>(),
    ) {
        let mut rng = fastrand::Rng::with_seed(seed);
        let sensor = sensor(beams, 4.0);
        let ranges = measured(&sensor, &clutter(things, &mut rng), &mut rng);
        let mut extractor = Extractor::new();
        let segments = extractor.segments(&sensor, &ranges).to_vec();
        for (off, beam, segment) in missed(&sensor, &ranges, &segments) {
            let bridged = extractor.bridged().contains(&(beam as u32));
            let excused = bridged || off.abs() <= 12.0;
            prop_assert!(excused, "beam {beam} is {off} cm off {:?}", segments[segment]);
        }
    }

    /// An end that is no corner lies where something came back: no farther than the next beam on the same face.
    #[test]
    fn ends_lie_where_something_came_back(
        things in 5..60_usize, beams in 120..500_usize, seed in any::<u64>(),
    ) {
        let mut rng = fastrand::Rng::with_seed(seed);
        let sensor = sensor(beams, 4.0);
        let ranges = measured(&sensor, &clutter(things, &mut rng), &mut rng);
        let hits: Vec<Vector2<f64>> = sensor.directions().iter().zip(&ranges)
            .filter(|(_, r)| sensor.returned(**r)).map(|(u, r)| u * *r).collect();
        for segment in Extractor::new().segments(&sensor, &ranges) {
            for (end, kind) in [segment.start, segment.end].into_iter().zip(segment.ends) {
                if kind == End::True(Truth::Corner) {
                    continue;
                }
                let near = hits.iter().map(|p| (p - end).norm()).fold(f64::INFINITY, f64::min);
                let room = 25.0 + 6.0 * sensor.step() * end.norm();
                prop_assert!(near <= room, "{near} cm from any return: {segment:?}");
            }
        }
    }

    /// Within a number of vertices, and each within errors of what the beams measured, on the whole.
    #[test]
    fn a_refined_fit_keeps_to_its_number_of_vertices(
        things in 0..60_usize, beams in 2..500_usize, seed in any::<u64>(), most in 0..80_usize,
    ) {
        let mut rng = fastrand::Rng::with_seed(seed);
        let sensor = sensor(beams, 4.0);
        let ranges = measured(&sensor, &clutter(things, &mut rng), &mut rng);
        let mut extractor = Extractor::new();
        let found = extractor.refined(&sensor, &ranges, most);
        let shared = found.windows(2).filter(|w| (w[0].end - w[1].start).norm() < 1e-9).count();
        let points = extractor.thin(&sensor, &ranges).count();
        prop_assert!(found.is_empty() || 2 * found.len() - shared + points <= most, "{found:?}");
        for s in &found {
            let c = &s.covariance;
            prop_assert!(c.start.iter().chain(&c.end).chain(&c.cross).all(|x| x.is_finite()), "{s:?}");
            prop_assert!(c.start.determinant() > 0.0 && c.end.determinant() > 0.0, "{s:?}");
        }
        // More vertices never explain much less.
        let explained = |found: &[Segment<2>]| {
            let missed = missed(&sensor, &ranges, found);
            missed.iter().filter(|m| m.0.abs() < 50.0).count()
        };
        let more = extractor.refined(&sensor, &ranges, most + 10);
        prop_assert!(explained(&more) + 3 + beams / 50 >= explained(&found), "{most}");
    }
}

/// Of many noisy scans of one room the squared whitened errors of a refined fit follow the χ² law with four degrees of
/// freedom, as those of the quick one do.
#[test]
fn a_refined_fit_tells_its_errors() {
    let at = |x: f64, y: f64| Vector2::new(x, y);
    let corners = [at(-230.0, -170.0), at(310.0, -120.0), at(280.0, 260.0), at(-190.0, 240.0)];
    let room: Vec<Segment<2>> =
        (0..4).map(|k| Segment::given(corners[k], corners[(k + 1) % 4], 0.0)).collect();
    let sensor = sensor(360, std::f64::consts::TAU);
    let mut rng = fastrand::Rng::with_seed(11);
    let mut extractor = Extractor::new();
    let (mut sum, mut count) = (0.0, 0.0);
    for _ in 0..300 {
        let ranges = measured(&sensor, &room, &mut rng);
        let found = extractor.refined(&sensor, &ranges, 50);
        assert!((4..=5).contains(&found.len()), "{found:?}");
        for segment in found.iter().filter(|s| s.ends == [End::True(Truth::Corner); 2]) {
            let c = &segment.covariance;
            let mut r = Matrix4::zeros();
            r.fixed_view_mut::<2, 2>(0, 0).copy_from(&c.start);
            r.fixed_view_mut::<2, 2>(2, 2).copy_from(&c.end);
            r.fixed_view_mut::<2, 2>(0, 2).copy_from(&c.cross);
            r.fixed_view_mut::<2, 2>(2, 0).copy_from(&c.cross.transpose());
            let off = |wall: &Segment<2>| {
                let (a, b) = (segment.start - wall.start, segment.end - wall.end);
                Vector4::new(a.x, a.y, b.x, b.y)
            };
            let errors = room.iter().map(off);
            let error = errors.min_by(|a, b| a.norm().total_cmp(&b.norm())).expect("walls");
            let white = r.cholesky().expect("a covariance is positive").l();

            sum += white.solve_lower_triangular(&error).expect("it is regular").norm_squared();
            count += 1.0;
        }
    }
    let mean: f64 = sum / count;
    assert!(count > 500.0 && (2.0..5.0).contains(&mean), "{count}, mean {mean}");
}

/// The leg of a chair before a wall is a point, the wall goes on behind it.
#[test]
fn what_one_beam_strikes_before_a_line_is_a_point() {
    let at = |x: f64, y: f64| Vector2::new(x, y);
    let wall = Segment::given(at(300.0, -300.0), at(300.0, 300.0), 0.0);
    let sensor = sensor(181, 1.2);
    let mut ranges = measured(&sensor, &[wall], &mut fastrand::Rng::with_seed(4));
    (ranges[60], ranges[120]) = (180.0, 700.0);
    let mut extractor = Extractor::new();
    assert_eq!(extractor.segments(&sensor, &ranges).len(), 1);
    let thin: Vec<Segment<2>> = extractor.thin(&sensor, &ranges).collect();
    assert_eq!(thin.len(), 1, "beyond a line a spike is nothing");
    assert!(thin[0].length() < 1e-12 && (thin[0].start.norm() - 180.0).abs() < 1e-9);
    // A beam that went through tears what is fitted to the beams.
    assert_eq!(extractor.refined(&sensor, &ranges, 50).len(), 2);
    assert_eq!(extractor.thin(&sensor, &ranges).count(), 1);
}
