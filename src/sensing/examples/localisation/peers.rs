//! What others do, plainly: a point-to-line ICP from a lattice of starts (Y. Chen, G. Medioni, 1991), and Monte-Carlo
//! localisation with a likelihood field (F. Dellaert, D. Fox, W. Burgard, S. Thrun, 1999).

use nalgebra::{Isometry2, Matrix3, Point2, Vector2, Vector3};
use orthoframe_sensing::Chart;
use orthoframe_vectors::read::{Log, Scan};
use orthoframe_vectors::scan::Sensor;

/// Side of a cell of the field, in cm.
const CELL: f64 = 10.0;
/// What is farther from every line is as far, in cm.
const FAR: f64 = 40.0;
/// Starts of the ICP are so far apart, in cm, and so many turns are tried at each.
const LATTICE: f64 = 100.0;
const TURNS: usize = 12;
const STEPS: usize = 10;
/// Returns that take part.
const POINTS: usize = 45;
const PARTICLES: usize = 10_000;
/// A beam's error on the field, in cm, and the share of beams that tell nothing.
const SPREAD: f64 = 20.0;
const NOTHING: f64 = 0.2;
/// The place is known where so much of the weight lies within a metre of the best particle.
const KNOWN: f64 = 0.9;

/// How far the nearest line is, cell by cell.
pub(crate) struct Field {
    low: Point2<f64>,
    columns: usize,
    rows: usize,
    far: Vec<f32>,
}

impl Field {
    pub(crate) fn of(chart: &Chart) -> Self {
        let ends = || chart.lines().iter().flat_map(|line| [line.start, line.end]);
        let first = ends().next().unwrap_or_default();
        let low = ends().fold(first, |a, b| a.inf(&b));
        let size = (ends().fold(first, |a, b| a.sup(&b)) - low) / CELL;
        let (columns, rows) = (size.x as usize + 1, size.y as usize + 1);
        let at = |n: usize| {
            low + Vector2::new((n % columns) as f64 + 0.5, (n / columns) as f64 + 0.5) * CELL
        };
        let far = |p| chart.nearest(p).map_or(FAR, |(_, foot)| (foot - p).norm()) as f32;
        Self { low, columns, rows, far: (0..columns * rows).map(|n| far(at(n))).collect() }
    }

    fn at(&self, p: Point2<f64>) -> f64 {
        let at = (p - self.low) / CELL;
        if at.x < 0.0 || at.y < 0.0 || at.x as usize >= self.columns || at.y as usize >= self.rows {
            return FAR;
        }
        f64::from(self.far[at.y as usize * self.columns + at.x as usize])
    }

    fn span(&self) -> Vector2<f64> {
        Vector2::new(self.columns as f64, self.rows as f64) * CELL
    }
}

/// Some of the returns, evenly by angle.
fn returns(sensor: &Sensor, ranges: &[f64]) -> Vec<Vector2<f64>> {
    let all = ranges.iter().zip(sensor.directions()).filter(|(range, _)| sensor.returned(**range));
    let all: Vec<Vector2<f64>> = all.map(|(range, u)| u * *range).collect();
    let every = all.len().div_ceil(POINTS).max(1);
    all.into_iter().step_by(every).collect()
}

/// The start from which the returns come to lie nearest to lines.
pub(crate) fn icp(
    chart: &Chart,
    field: &Field,
    sensor: &Sensor,
    ranges: &[f64],
) -> Option<Isometry2<f64>> {
    let points = returns(sensor, ranges);
    let (mut best, mut least) = (None, f64::INFINITY);
    let span = field.span();
    for n in 0..(span.x / LATTICE) as usize * (span.y / LATTICE) as usize {
        let columns = (span.x / LATTICE) as usize;
        let at = Vector2::new((n % columns) as f64 + 0.5, (n / columns) as f64 + 0.5) * LATTICE;
        for turn in 0..TURNS {
            let angle = std::f64::consts::TAU * turn as f64 / TURNS as f64;
            let start = Isometry2::new(field.low.coords + at, angle);
            let Some(found) = descend(chart, &points, start) else { continue };
            let off: f64 = points.iter().map(|p| field.at(found * Point2::from(*p))).sum();
            if off < least {
                (best, least) = (Some(found), off);
            }
        }
    }
    best
}

fn descend(
    chart: &Chart,
    points: &[Vector2<f64>],
    start: Isometry2<f64>,
) -> Option<Isometry2<f64>> {
    let mut pose = start;
    for _ in 0..STEPS {
        let (mut normal, mut right, mut count) = (Matrix3::zeros(), Vector3::zeros(), 0);
        for p in points {
            let at = pose * Point2::from(*p);
            let Some((line, foot)) = chart.nearest(at) else { continue };
            let line = &chart.lines()[line as usize];
            let along = (line.end - line.start).normalize();
            let n = Vector2::new(-along.y, along.x);
            let arm = at.coords - pose.translation.vector;
            let row = Vector3::new(n.x, n.y, -n.perp(&arm));
            normal += row * row.transpose();
            right += row * n.dot(&(foot - at));
            count += 1;
        }
        if count < points.len() / 4 {
            return None;
        }
        let by = normal.try_inverse()? * right;
        pose = Isometry2::new(pose.translation.vector + by.xy(), pose.rotation.angle() + by.z);
        if by.xy().norm() < 0.5 && by.z.abs() < 1e-3 {
            break;
        }
    }
    pose.translation.vector.iter().all(|x| x.is_finite()).then_some(pose)
}

/// Where the particles gathered at the end of a way, where most did.
pub(crate) fn monte_carlo(field: &Field, log: &Log, way: &[&Scan]) -> Option<Isometry2<f64>> {
    let mut random = fastrand::Rng::with_seed(1);
    let span = field.span();
    let mut particles: Vec<Isometry2<f64>> = (0..PARTICLES)
        .map(|_| {
            let at = Vector2::new(random.f64() * span.x, random.f64() * span.y);
            Isometry2::new(field.low.coords + at, random.f64() * std::f64::consts::TAU)
        })
        .collect();
    let mut weights = vec![1.0 / PARTICLES as f64; PARTICLES];
    let mut last: Option<Isometry2<f64>> = None;
    for scan in way {
        let odometry = scan.odometry?;
        if let Some(last) = last {
            let by = last.inverse() * odometry;
            let (far, turned) = (by.translation.vector.norm(), by.rotation.angle().abs());
            for particle in &mut particles {
                let mut noise =
                    |spread: f64| (0..4).map(|_| random.f64() - 0.5).sum::<f64>() * 1.7 * spread;
                let shift = 0.1 * far + 1.0;
                let turn = 0.1 * turned + 0.0005 * far + 0.003;
                let off = Isometry2::new(Vector2::new(noise(shift), noise(shift)), noise(turn));
                *particle = *particle * by * off;
            }
        }
        last = Some(odometry);
        let points = returns(log.sensor(scan), &scan.ranges);
        for (particle, weight) in particles.iter().zip(&mut weights) {
            let told = points.iter().map(|p| {
                let far = field.at(particle * Point2::from(*p)) / SPREAD;
                ((1.0 - NOTHING) * (-0.5 * far * far).exp() + NOTHING).ln()
            });
            // Neighbouring beams err together: half of what they tell counts.
            *weight *= (0.5 * told.sum::<f64>()).exp();
        }
        let sum: f64 = weights.iter().sum();
        weights.iter_mut().for_each(|weight| *weight /= sum);
        let effective = 1.0 / weights.iter().map(|weight| weight * weight).sum::<f64>();
        if effective < 0.5 * PARTICLES as f64 {
            particles = resampled(&particles, &weights, &mut random);
            weights.fill(1.0 / PARTICLES as f64);
        }
    }
    let best = (0..PARTICLES).max_by(|a, b| weights[*a].total_cmp(&weights[*b]))?;
    let middle = particles[best];
    let near = |particle: &Isometry2<f64>| {
        (particle.translation.vector - middle.translation.vector).norm() <= 100.0
            && particle.rotation.angle_to(&middle.rotation).abs() <= 0.35
    };
    let (mut sum, mut at) = (0.0, Vector2::zeros());
    for (particle, weight) in particles.iter().zip(&weights).filter(|(p, _)| near(p)) {
        sum += weight;
        at += particle.translation.vector * *weight;
    }
    (sum >= KNOWN).then(|| Isometry2::new(at / sum, middle.rotation.angle()))
}

/// As many particles again, each kind as often as it weighs.
fn resampled(
    particles: &[Isometry2<f64>],
    weights: &[f64],
    random: &mut fastrand::Rng,
) -> Vec<Isometry2<f64>> {
    let step = 1.0 / particles.len() as f64;
    let (mut at, mut sum, mut from) = (0, weights[0], random.f64() * step);
    let mut kept = Vec::with_capacity(particles.len());
    for _ in 0..particles.len() {
        while from > sum && at + 1 < particles.len() {
            at += 1;
            sum += weights[at];
        }
        kept.push(particles[at]);
        from += step;
    }
    kept
}
