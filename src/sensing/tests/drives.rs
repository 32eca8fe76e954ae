//! Drives through simulated floors: what is open narrows, a lie and a kidnapping are noticed, what differs is told.

use nalgebra::{Isometry2, Vector2};
use orthoframe_sensing::{Answer, Event, Face, Locator, Tracker};
use orthoframe_vectors::scan::{Noise, Sensor};

fn sensor() -> Sensor {
    Sensor::new(-1.57, 0.0174, 181, (1.0, 800.0), Noise::default())
        .expect("a sensor that reaches 8 m")
}

fn p(x: f64, y: f64) -> Vector2<f64> {
    Vector2::new(x, y)
}

fn outline(corners: &[(f64, f64)]) -> Vec<Face> {
    let at = |k: usize| p(corners[k % corners.len()].0, corners[k % corners.len()].1);
    (0..corners.len()).map(|k| Face::plain(at(k), at(k + 1))).collect()
}

fn block(x: f64, y: f64, w: f64, h: f64) -> Vec<Face> {
    outline(&[(x, y), (x + w, y), (x + w, y + h), (x, y + h)])
}

/// Two halls that are alike but for what stands at the far end of the second.
fn twins() -> Locator {
    let hall =
        [(0.0, 0.0), (1600.0, 0.0), (1600.0, 400.0), (300.0, 400.0), (300.0, 500.0), (0.0, 500.0)];
    let other = hall.map(|(x, y)| (x, y + 1000.0));
    let mut faces = outline(&hall);
    faces.extend(outline(&other));
    faces.extend(block(1450.0, 1100.0, 80.0, 150.0));
    Locator::new(faces)
}

#[test]
fn what_is_ambiguous_narrows_on_the_way() {
    let (locator, sensor) = (twins(), sensor());
    let mut tracker = Tracker::new(&locator);
    let mut truth = Isometry2::new(p(400.0, 1150.0), 0.0);
    let motion = Isometry2::new(p(30.0, 0.0), 0.0);
    tracker.step(&Isometry2::identity(), &sensor, &locator.expected(&sensor, &truth));
    assert!(!matches!(tracker.answer(), Answer::Unique(_)), "{:?}", tracker.answer());
    for _ in 0..30 {
        truth *= motion;
        // Odometry is 3 % short.
        let told = Isometry2::new(p(29.1, 0.0), 0.0);
        tracker.step(&told, &sensor, &locator.expected(&sensor, &truth));
        if let Answer::Unique(fix) = tracker.answer() {
            assert!(fix.is_near(&truth), "{fix:?} is not {truth:?}");
        }
    }
    assert!(matches!(tracker.answer(), Answer::Unique(_)), "{:?}", tracker.answer());
}

/// An L-shaped room that is the only one.
fn room() -> Locator {
    Locator::new(outline(&[
        (0.0, 0.0),
        (700.0, 0.0),
        (700.0, 300.0),
        (420.0, 300.0),
        (420.0, 520.0),
        (0.0, 520.0),
    ]))
}

#[test]
fn a_kidnapping_is_noticed() {
    let (locator, sensor) = (room(), sensor());
    let mut tracker = Tracker::new(&locator);
    let before = Isometry2::new(p(150.0, 200.0), 0.4);
    let after = Isometry2::new(p(600.0, 90.0), 2.6);
    tracker.step(&Isometry2::identity(), &sensor, &locator.expected(&sensor, &before));
    let events: Vec<Event> = (0..5)
        .map(|_| tracker.step(&Isometry2::identity(), &sensor, &locator.expected(&sensor, &after)))
        .collect();
    assert!(events.contains(&Event::Kidnapped), "{events:?}");
    let answer = tracker.answer();
    assert!(answer.fixes().iter().any(|f| f.is_near(&after)), "{answer:?}");
}

#[test]
fn odometry_that_lies_is_noticed() {
    let (locator, sensor) = (room(), sensor());
    let mut tracker = Tracker::new(&locator);
    let mut truth = Isometry2::new(p(100.0, 150.0), 0.1);
    tracker.step(&Isometry2::identity(), &sensor, &locator.expected(&sensor, &truth));
    let events: Vec<Event> = (0..12)
        .map(|_| {
            truth *= Isometry2::new(p(15.0, 0.0), 0.0);
            // The wheels tell of nothing.
            tracker.step(&Isometry2::identity(), &sensor, &locator.expected(&sensor, &truth))
        })
        .collect();
    let told = events.iter().any(|e| matches!(e, Event::OdometryLies | Event::Kidnapped));
    assert!(told, "{events:?}");
}

#[test]
fn honest_odometry_raises_no_alarm() {
    let (locator, sensor) = (room(), sensor());
    let mut tracker = Tracker::new(&locator);
    let mut truth = Isometry2::new(p(100.0, 150.0), 0.1);
    let motion = Isometry2::new(p(15.0, 0.0), 0.02);
    tracker.step(&Isometry2::identity(), &sensor, &locator.expected(&sensor, &truth));
    for _ in 0..15 {
        truth *= motion;
        let event = tracker.step(&motion, &sensor, &locator.expected(&sensor, &truth));
        assert!(matches!(event, Event::Steady | Event::Narrowed), "{event:?} at {truth:?}");
        assert!(tracker.answer().fixes().iter().any(|f| f.is_near(&truth)));
    }
}

#[test]
fn a_box_that_is_not_mapped_is_seen() {
    let (locator, sensor) = (room(), sensor());
    let truth = Isometry2::new(p(100.0, 150.0), 0.0);
    let mut there = locator.faces().to_vec();
    there.extend(block(300.0, 130.0, 60.0, 60.0));
    let ranges = Locator::new(there).expected(&sensor, &truth);
    let found = locator.differences(&sensor, &ranges, &truth);
    let [line] = found.unmapped.as_slice() else { panic!("{found:?}") };
    let middle = (line.start + line.end) * 0.5;
    assert!((middle - p(300.0, 160.0)).norm() < 5.0, "{line:?}");
    assert!(
        locator
            .differences(&sensor, &locator.expected(&sensor, &truth), &truth)
            .unmapped
            .is_empty()
    );
}
