//! A large building, made: rooms of many sizes along corridors, each with things in it. No two are alike, but all walls run one
//! of two ways: half a turn's scan fits nearly as well at many places, so that "several" with the true one is often all there is.

use nalgebra::{Isometry2, Point2, Vector2};
use orthoframe_geometry::Front;
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

/// Thickness of a wall, and of a robot's half, in cm.
const WALL: f64 = 10.0;
const ROBOT: f64 = 25.0;

/// The building, and poses in its rooms and corridors where a robot can stand. Each face is seen from its own room alone, as those of a Map are.
pub(crate) fn building(poses: usize) -> (Chart, Vec<Isometry2<f64>>) {
    let mut random = fastrand::Rng::with_seed(26);
    let (mut lines, mut rooms) = (Vec::new(), Vec::new());
    for corridor in 0..CORRIDORS {
        let y = corridor as f64 * (2.0 * DEPTH + CORRIDOR);
        for side in [0.0, DEPTH + CORRIDOR] {
            let (low, high) = (y + side, y + side + DEPTH);
            let is_below = side == 0.0;
            let mut x = 0.0;
            for _ in 0..ROOMS {
                let wide = 300.0 + 250.0 * random.f64();
                let opens = x + 20.0 + (wide - DOOR - 40.0) * random.f64();
                let (right, left) = (x + wide - WALL, x);
                let (floor, roof) = (low, high - WALL);
                // Counter-clockwise, the room on the left.
                front(&mut lines, &[(left, roof), (left, floor)]);
                front(&mut lines, &[(right, floor), (right, roof)]);
                let (near, far) = ([left, opens, opens + DOOR, right], [left, right]);
                if is_below {
                    front(&mut lines, &far.map(|x| (x, floor)));
                    for part in [[near[3], near[2]], [near[1], near[0]]] {
                        front(&mut lines, &part.map(|x| (x, roof)));
                    }
                    for part in [[near[0], near[1]], [near[2], near[3]]] {
                        front(&mut lines, &part.map(|x| (x, high)));
                    }
                    jambs(&mut lines, opens, (roof, high));
                } else {
                    front(&mut lines, &[far[1], far[0]].map(|x| (x, roof)));
                    for part in [[near[0], near[1]], [near[2], near[3]]] {
                        front(&mut lines, &part.map(|x| (x, floor)));
                    }
                    for part in [[near[3], near[2]], [near[1], near[0]]] {
                        front(&mut lines, &part.map(|x| (x, low - WALL)));
                    }
                    jambs(&mut lines, opens, (low - WALL, floor));
                }
                for _ in 0..THINGS {
                    let (width, depth) = (20.0 + 100.0 * random.f64(), 20.0 + 60.0 * random.f64());
                    let at = Vector2::new(
                        left + 10.0 + (wide - width - 30.0) * random.f64(),
                        floor + 10.0 + (DEPTH - depth - 30.0) * random.f64(),
                    );
                    let (x, y) = (at.x + width, at.y + depth);
                    // Clockwise: what is solid lies on the right.
                    front(&mut lines, &[(at.x, at.y), (at.x, y), (x, y), (x, at.y), (at.x, at.y)]);
                }
                rooms.push((Point2::new(left, floor), Vector2::new(wide, DEPTH)));
                x += wide;
            }
            rooms.push((Point2::new(0.0, y + DEPTH), Vector2::new(x, CORRIDOR)));
        }
    }
    let chart = Chart::new(lines);
    let somewhere = || {
        let (low, size) = rooms[random.usize(..rooms.len())];
        let at = low + Vector2::new(random.f64() * size.x, random.f64() * size.y);
        Isometry2::new(at.coords, random.f64() * std::f64::consts::TAU)
    };
    let is_free = |pose: &Isometry2<f64>| {
        let at = Point2::from(pose.translation.vector);
        // Outside of things, and not in a wall: there the first face that is met has its front the other way.
        let faces = |bearing: f64| {
            chart.cast(pose, bearing, 1e5).1.is_none_or(|line| {
                let Line { start, end, front, .. } = chart.lines()[line as usize];
                front == Front::Both || (end - start).perp(&(at - start)) > 0.0
            })
        };
        let far = chart.nearest(at).map_or(f64::INFINITY, |(_, foot)| (foot - at).norm());
        far >= ROBOT && [0.3, 2.1, 4.2].into_iter().all(faces)
    };
    let poses = std::iter::repeat_with(somewhere).filter(is_free).take(poses).collect();
    (chart, poses)
}

/// Faces along a way, their fronts on its left.
fn front(lines: &mut Vec<Line>, way: &[(f64, f64)]) {
    let at = |(x, y): (f64, f64)| Point2::new(x, y);
    lines.extend(
        way.windows(2)
            .map(|ends| Line { front: Front::Left, ..Line::between(at(ends[0]), at(ends[1])) }),
    );
}

/// The insides of a doorway through a wall.
fn jambs(lines: &mut Vec<Line>, opens: f64, (low, high): (f64, f64)) {
    front(lines, &[(opens, high), (opens, low)]);
    front(lines, &[(opens + DOOR, low), (opens + DOOR, high)]);
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
