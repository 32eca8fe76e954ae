//! A large building, made: rooms of many sizes along corridors, each with things in it. No two are alike, but all walls run one
//! of two ways: half a turn's scan fits nearly as well at many places, so that "several" with the true one is often all there is.

use nalgebra::{Isometry2, Point2, Vector2};
use orthoframe_sensing::{Chart, Line};
use orthoframe_vectors::scan::{Noise, Sensor};

/// Corridors, rooms along each on either side, and things in a room: some 40 000 lines.
const CORRIDORS: usize = 13;
const ROOMS: usize = 40;
const THINGS: usize = 8;
/// Depth of a room, width of a corridor and of a door, in cm.
const DEPTH: f64 = 500.0;
const CORRIDOR: f64 = 220.0;
const DOOR: f64 = 90.0;

/// The building, and poses in its rooms and corridors.
pub(crate) fn building(poses: usize) -> (Chart, Vec<Isometry2<f64>>) {
    let mut random = fastrand::Rng::with_seed(26);
    let (mut lines, mut rooms) = (Vec::new(), Vec::new());
    for corridor in 0..CORRIDORS {
        let y = corridor as f64 * (2.0 * DEPTH + CORRIDOR);
        for side in [0.0, DEPTH + CORRIDOR] {
            let (low, high) = (y + side, y + side + DEPTH);
            let (door, back) = if side == 0.0 { (high, low) } else { (low, high) };
            let mut x = 0.0;
            for _ in 0..ROOMS {
                let wide = 300.0 + 250.0 * random.f64();
                let opens = x + 20.0 + (wide - DOOR - 40.0) * random.f64();
                wall(&mut lines, (x, back), (x + wide, back));
                wall(&mut lines, (x, low), (x, high));
                wall(&mut lines, (x, door), (opens, door));
                wall(&mut lines, (opens + DOOR, door), (x + wide, door));
                for _ in 0..THINGS {
                    let (width, depth) = (20.0 + 100.0 * random.f64(), 20.0 + 60.0 * random.f64());
                    let at = Vector2::new(
                        x + 10.0 + (wide - width - 20.0) * random.f64(),
                        low + 10.0 + (DEPTH - depth - 20.0) * random.f64(),
                    );
                    let corner = |dx: f64, dy: f64| (at.x + dx, at.y + dy);
                    let corners = [(0.0, 0.0), (width, 0.0), (width, depth), (0.0, depth)];
                    for k in 0..4 {
                        let (a, b) = (corners[k], corners[(k + 1) % 4]);
                        wall(&mut lines, corner(a.0, a.1), corner(b.0, b.1));
                    }
                }
                rooms.push((Point2::new(x, low), Vector2::new(wide, DEPTH)));
                x += wide;
            }
            rooms.push((Point2::new(0.0, y + DEPTH), Vector2::new(x, CORRIDOR)));
        }
    }
    let poses = (0..poses).map(|_| {
        let (low, size) = rooms[random.usize(..rooms.len())];
        let at = low + Vector2::new(random.f64() * size.x, random.f64() * size.y);
        Isometry2::new(at.coords, random.f64() * std::f64::consts::TAU)
    });
    let poses = poses.collect();
    (Chart::new(lines), poses)
}

fn wall(lines: &mut Vec<Line>, a: (f64, f64), b: (f64, f64)) {
    lines.push(Line { start: Point2::new(a.0, a.1), end: Point2::new(b.0, b.1), face: None });
}

/// Half a turn, 361 beams of 30 m.
pub(crate) fn sensor() -> Sensor {
    let half = std::f64::consts::FRAC_PI_2;
    Sensor::new(-half, std::f64::consts::PI / 360.0, 361, (1.0, 3000.0), Noise::default())
        .expect("a sensor")
}

/// What it measures from a pose, to 2 cm.
pub(crate) fn scan(chart: &Chart, sensor: &Sensor, pose: &Isometry2<f64>) -> Vec<f64> {
    let mut random = fastrand::Rng::with_seed(pose.translation.x.to_bits());
    let range = |beam: usize| chart.cast(pose, sensor.bearing(beam), 3000.0).0;
    (0..sensor.count()).map(|beam| range(beam) + 4.0 * (random.f64() - 0.5)).collect()
}
