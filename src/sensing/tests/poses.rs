//! Poses in made buildings: what is said to be unique is right, what repeats itself is told as several, and nothing that a
//! sensor may bring ends the program.

use nalgebra::{Isometry2, Point2};

use orthoframe_sensing::{
    Answer, Belief, Chart, Event, Line, Localiser, Options, Tracker, Unknown,
};
use orthoframe_vectors::scan::{Noise, Sensor};

fn sensor() -> Sensor {
    let half = std::f64::consts::FRAC_PI_2;
    Sensor::new(-half, std::f64::consts::PI / 360.0, 361, (1.0, 3000.0), Noise::default())
        .expect("a sensor")
}

fn rectangle(x: f64, y: f64, width: f64, height: f64) -> Vec<Line> {
    let corners = [(x, y), (x + width, y), (x + width, y + height), (x, y + height)];
    let corners = corners.map(|(x, y)| Point2::new(x, y));
    (0..4).map(|n| Line::between(corners[n], corners[(n + 1) % 4])).collect()
}

/// A hall with boxes of all sizes in it.
fn hall(random: &mut fastrand::Rng) -> Chart {
    let mut lines = rectangle(0.0, 0.0, 1500.0, 1000.0);
    for _ in 0..12 {
        let (x, y) = (random.f64() * 1300.0 + 50.0, random.f64() * 800.0 + 50.0);
        lines.extend(rectangle(x, y, 20.0 + random.f64() * 120.0, 20.0 + random.f64() * 120.0));
    }
    Chart::new(lines)
}

fn scan(
    chart: &Chart,
    sensor: &Sensor,
    pose: &Isometry2<f64>,
    random: &mut fastrand::Rng,
) -> Vec<f64> {
    (0..sensor.count())
        .map(|beam| chart.cast(pose, sensor.bearing(beam), 3000.0).0 + (random.f64() - 0.5) * 4.0)
        .collect()
}

fn somewhere(random: &mut fastrand::Rng) -> Isometry2<f64> {
    let (x, y) = (random.f64() * 1400.0 + 50.0, random.f64() * 900.0 + 50.0);
    Isometry2::new(nalgebra::Vector2::new(x, y), random.f64() * std::f64::consts::TAU)
}

fn is_right(found: &Isometry2<f64>, pose: &Isometry2<f64>) -> bool {
    (found.translation.vector - pose.translation.vector).norm() <= 20.0
        && found.rotation.angle_to(&pose.rotation).abs().to_degrees() <= 3.0
}

#[test]
fn what_is_unique_is_right() {
    let (mut unique, mut several) = (0, 0);
    for seed in 0..8 {
        let mut random = fastrand::Rng::with_seed(seed);
        let chart = hall(&mut random);
        let localiser = Localiser::new(&chart, Options::default());
        for _ in 0..5 {
            let pose = somewhere(&mut random);
            let ranges = scan(&chart, &sensor(), &pose, &mut random);
            match localiser.locate(&sensor(), &ranges) {
                Answer::Unique(fit) => {
                    assert!(is_right(&fit.pose, &pose), "seed {seed}: {} for {pose}", fit.pose);
                    unique += 1;
                }
                Answer::Ambiguous(fits) => {
                    assert!(
                        fits.iter().any(|fit| is_right(&fit.pose, &pose)),
                        "seed {seed}: {pose}"
                    );
                    several += 1;
                }
                Answer::Unknown(_) => {}
            }
        }
    }
    assert!(unique >= 25 && unique + several <= 40, "{unique} {several}");
}

/// What the chart lacks ends beams at places of no account: the rest of the scan tells the place all the same, and no other is
/// told for certain.
#[test]
fn what_is_unique_is_right_though_the_chart_lacks_things() {
    let (mut unique, mut count) = (0, 0);
    for seed in 20..26 {
        let mut random = fastrand::Rng::with_seed(seed);
        let seen = hall(&mut random);
        // The walls, and of the boxes all but three.
        let known = seen.lines().iter().take(seen.lines().len() - 12).copied().collect();
        let chart = Chart::new(known);
        let localiser = Localiser::new(&chart, Options::default());
        for _ in 0..5 {
            let pose = somewhere(&mut random);
            let ranges = scan(&seen, &sensor(), &pose, &mut random);
            // From within a box nothing is seen but what the chart may lack.
            if ranges.iter().all(|range| *range < 250.0) {
                continue;
            }
            count += 1;
            if let Answer::Unique(fit) = localiser.locate(&sensor(), &ranges) {
                assert!(is_right(&fit.pose, &pose), "seed {seed}: {} for {pose}", fit.pose);
                unique += 1;
            }
        }
    }
    assert!(2 * unique >= count, "{unique} of {count}");
}

#[test]
fn a_building_that_repeats_itself_is_told_as_several_places() {
    let mut random = fastrand::Rng::with_seed(7);
    // Two rooms alike, and nothing else.
    let mut lines = rectangle(0.0, 0.0, 400.0, 300.0);
    lines.extend(rectangle(50.0, 50.0, 80.0, 30.0));
    lines.extend(rectangle(2000.0, 0.0, 400.0, 300.0));
    lines.extend(rectangle(2050.0, 50.0, 80.0, 30.0));
    let chart = Chart::new(lines);
    let localiser = Localiser::new(&chart, Options::default());
    let pose = Isometry2::new(nalgebra::Vector2::new(300.0, 200.0), 3.5);
    let ranges = scan(&chart, &sensor(), &pose, &mut random);
    let Answer::Ambiguous(fits) = localiser.locate(&sensor(), &ranges) else { panic!("two rooms") };
    let other = Isometry2::new(nalgebra::Vector2::new(2300.0, 200.0), 3.5);
    assert!(fits.iter().any(|fit| is_right(&fit.pose, &pose)));
    assert!(fits.iter().any(|fit| is_right(&fit.pose, &other)));
}

#[test]
fn along_a_corridor_without_an_end_in_sight_no_place_is_told() {
    let mut random = fastrand::Rng::with_seed(3);
    let walls = [(0.0, 0.0), (0.0, 200.0)];
    let line =
        |&(x, y): &(f64, f64)| Line::between(Point2::new(x, y), Point2::new(x + 20_000.0, y));
    let chart = Chart::new(walls.iter().map(line).collect());
    let localiser = Localiser::new(&chart, Options::default());
    for x in [3000.0, 9000.0, 15_000.0] {
        let pose = Isometry2::new(nalgebra::Vector2::new(x, 90.0), 0.1);
        let ranges = scan(&chart, &sensor(), &pose, &mut random);
        assert!(!matches!(localiser.locate(&sensor(), &ranges), Answer::Unique(_)), "at {x}");
    }
}

#[test]
fn a_robot_that_was_carried_off_is_lost_and_found_again() {
    let mut random = fastrand::Rng::with_seed(11);
    let chart = hall(&mut random);
    let localiser = Localiser::new(&chart, Options::default());
    let mut tracker = Tracker::new(&localiser);
    let (start, other) = (somewhere(&mut random), somewhere(&mut random));
    let mut odometry = Isometry2::identity();
    let (mut pose, by) = (start, Isometry2::new(nalgebra::Vector2::new(3.0, 0.0), 0.02));
    let mut was_moved = false;
    for step in 0..40 {
        (pose, odometry) = (pose * by, odometry * by);
        if step == 15 {
            pose = other;
        }
        let ranges = scan(&chart, &sensor(), &pose, &mut random);
        was_moved |= tracker.scan(&sensor(), &ranges, odometry) == Event::GivenUp;
        let belief = tracker.belief().clone();
        // Between the move and the notice it may be wrong; never before, and never later.
        if let (Belief::At(fit), false) = (&belief, (15..19).contains(&step)) {
            assert!(is_right(&fit.pose, &pose), "step {step}");
        }
    }
    assert!(was_moved);
    assert!(matches!(tracker.belief(), Belief::At(_)));
}

#[test]
fn whatever_a_sensor_brings_ends_in_an_answer() {
    let chart = hall(&mut fastrand::Rng::with_seed(1));
    let localiser = Localiser::new(&chart, Options::default());
    let count = sensor().count();
    for value in [f64::NAN, f64::INFINITY, -1.0, 0.0, 1e300, 3000.0, 50.0] {
        let answer = localiser.locate(&sensor(), &vec![value; count]);
        assert!(!matches!(answer, Answer::Unique(_)), "{value}");
    }
    let nothing = localiser.locate(&sensor(), &[]);
    assert!(matches!(nothing, Answer::Unknown(Unknown::TooLittle)));
    let nothing = Chart::new(Vec::new());
    let localiser = Localiser::new(&nothing, Options::default());
    let answer = localiser.locate(&sensor(), &vec![100.0; count]);
    assert!(matches!(answer, Answer::Unknown(Unknown::Nowhere)));
}

/// Rooms all alike, too many to be looked through: a scan in one of them fits too many places, and one of a round room, which
/// the chart has not, fits nowhere.
#[test]
fn what_fits_too_many_places_is_told_apart_from_what_fits_nowhere() {
    let mut random = fastrand::Rng::with_seed(5);
    let rooms = (0..256).map(|n| (f64::from(n % 16) * 330.0, f64::from(n / 16) * 230.0));
    let lines: Vec<Line> = rooms.flat_map(|(x, y)| rectangle(x, y, 300.0, 200.0)).collect();
    let chart = Chart::new(lines);
    let localiser = Localiser::new(&chart, Options::default());
    let pose = Isometry2::new(nalgebra::Vector2::new(3.0 * 330.0 + 90.0, 5.0 * 230.0 + 70.0), 0.4);
    let ranges = scan(&chart, &sensor(), &pose, &mut random);
    let answer = localiser.locate(&sensor(), &ranges);
    let Answer::Unknown(Unknown::TooMany(fits)) = &answer else { panic!("{answer:?}") };
    assert!(fits.len() >= 10 && fits.iter().all(|fit| fit.explained > 0.9), "{answer:?}");
    let round: Vec<f64> = vec![240.0; sensor().count()];
    let answer = localiser.locate(&sensor(), &round);
    assert!(matches!(answer, Answer::Unknown(Unknown::Nowhere)), "{answer:?}");
}

/// Two rooms alike in one half. In the right one the chart has screens that are not there any more: every look goes through
/// them, so that the other room is the likelier by all looks together, by far. It is never told all the same, and the right
/// one is in the end, when the scans see the other half.
#[test]
fn screens_that_are_gone_make_no_other_room_the_only_one() {
    let mut random = fastrand::Rng::with_seed(9);
    let room = |x: f64, things: &[(f64, f64, f64, f64)]| -> Vec<Line> {
        let inside = things.iter().flat_map(|&(dx, y, w, h)| rectangle(x + dx, y, w, h));
        rectangle(x, 0.0, 600.0, 400.0).into_iter().chain(inside).collect()
    };
    let alike = [(480.0, 40.0, 60.0, 40.0), (520.0, 220.0, 40.0, 90.0)];
    let own = [(60.0, 50.0, 70.0, 50.0), (40.0, 250.0, 50.0, 80.0)];
    let others = [(120.0, 130.0, 40.0, 40.0), (30.0, 20.0, 40.0, 90.0)];
    let mut seen = room(0.0, &[alike, own].concat());
    seen.extend(room(2000.0, &[alike, others].concat()));
    let truth = Chart::new(seen.clone());
    for x in [250.0, 350.0] {
        let ends = [20.0, 380.0].map(|y| Point2::new(x, y));
        seen.push(Line::between(ends[0], ends[1]));
    }
    let chart = Chart::new(seen);
    let localiser = Localiser::new(&chart, Options::default());
    let mut tracker = Tracker::new(&localiser);
    let place = |turn: f64| Isometry2::new(nalgebra::Vector2::new(300.0, 200.0), turn);
    let mut was_unsure = false;
    for step in 0..8 {
        let pose = place(f64::from(step) * 0.55);
        let ranges = scan(&truth, &sensor(), &pose, &mut random);
        let odometry = place(0.0).inv_mul(&pose);
        tracker.scan(&sensor(), &ranges, odometry);
        match tracker.belief() {
            Belief::At(fit) => assert!(is_right(&fit.pose, &pose), "step {step}: {}", fit.pose),
            _ => was_unsure = true,
        }
    }
    assert!(was_unsure && matches!(tracker.belief(), Belief::At(_)), "{:?}", tracker.belief());
}
