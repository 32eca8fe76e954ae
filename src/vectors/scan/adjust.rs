//! Vertices of a polyline moved to where the beams are most likely (Gauss and Newton, damped as by Levenberg and
//! Marquardt).
//!
//! A beam along u meets the edge from a to b at range f = a×b / u×(b − a). Inner vertices move freely between the beams of
//! their neighbours, the two ends along their own beams. The normal equations couple neighbours alone: they are a band of
//! 2 × 2 blocks, solved from one end to the other.

use nalgebra::{Matrix2, Vector2};

use super::run::Hit;
use super::sensor::Sensor;
use crate::line::ROUGHNESS;

/// Steps at most.
const STEPS: usize = 8;
/// A step that saves less of the sum than this share is the last.
const CONVERGED: f64 = 1e-3;

/// A polyline where its beams are most likely.
pub(super) struct Adjusted {
    pub(super) vertices: Vec<Vector2<f64>>,
    /// Covariance of each vertex, in cm².
    pub(super) own: Vec<Matrix2<f64>>,
    /// Of each with the next.
    pub(super) beside: Vec<Matrix2<f64>>,
}

/// The normal equations of a polyline: blocks on the diagonal, blocks to the next vertex, and the gradient.
struct Normal {
    diagonal: Vec<Matrix2<f64>>,
    beside: Vec<Matrix2<f64>>,
    gradient: Vec<Vector2<f64>>,
    /// Squared deviations of the beams.
    sum: f64,
}

/// The polyline from `vertices`, its first and last one on the beams of the first and the last of `hits`, over all of them.
///
/// `None` where the vertices do not follow one another as the beams do.
pub(super) fn adjust(sensor: &Sensor, hits: &[Hit], vertices: &[Vector2<f64>]) -> Option<Adjusted> {
    let mut vertices = vertices.to_vec();
    let mut now = normal(sensor, hits, &vertices)?;
    let mut damping = 1e-3;
    for _ in 0..STEPS {
        let Some(step) = solve(&now, damping) else { break };
        let moved: Vec<Vector2<f64>> = vertices.iter().zip(&step).map(|(v, s)| v - s).collect();
        let Some(next) = normal(sensor, hits, &moved).filter(|next| next.sum < now.sum) else {
            damping *= 10.0;
            continue;
        };
        let saved = now.sum - next.sum;
        vertices = moved;
        let has_converged = saved < CONVERGED * now.sum;
        now = next;
        damping *= 0.1;
        if has_converged {
            break;
        }
    }
    // What is found to err more than it is said to errs more.
    let freedom = hits.len() as f64 - 2.0 * (vertices.len() as f64 - 1.0);
    let excess = if freedom > 0.0 { (now.sum / freedom).max(1.0) } else { 1.0 };
    // Where a bend is slight, its place along the edges is known no better than that it is on them.
    for (k, block) in now.diagonal.iter_mut().enumerate() {
        let from = k.saturating_sub(1);
        let edges = vertices[from..(k + 2).min(vertices.len())].windows(2);
        let longest = edges.map(|e| (e[1] - e[0]).norm_squared()).fold(0.0, f64::max);
        *block += Matrix2::identity() * (excess / longest);
    }
    let [own, beside] = inverse(&now, excess)?;
    Some(Adjusted { vertices, own, beside })
}

fn normal(sensor: &Sensor, hits: &[Hit], vertices: &[Vector2<f64>]) -> Option<Normal> {
    let count = vertices.len();
    if vertices.windows(2).any(|pair| pair[0].perp(&pair[1]) <= 0.0) {
        return None;
    }
    let mut all = Normal {
        diagonal: vec![Matrix2::zeros(); count],
        beside: vec![Matrix2::zeros(); count - 1],
        gradient: vec![Vector2::zeros(); count],
        sum: 0.0,
    };
    let mut edge = 0;
    for hit in hits {
        let u = sensor.directions[hit.beam as usize];
        while edge + 2 < count && vertices[edge + 1].perp(&u) >= 0.0 {
            edge += 1;
        }
        let (a, b) = (vertices[edge], vertices[edge + 1]);
        let under = u.perp(&(b - a));
        let range = a.perp(&b) / under;
        if !range.is_finite() || range <= 0.0 {
            return None;
        }
        // ∂f/∂a and ∂f/∂b.
        let turned = Vector2::new(u.y, -u.x) * range;
        let of_a = (Vector2::new(b.y, -b.x) - turned) / under;
        let of_b = (Vector2::new(-a.y, a.x) + turned) / under;
        let weight = 1.0 / (sensor.noise.along(hit.r) + ROUGHNESS * ROUGHNESS);
        let off = range - hit.r;
        all.sum += weight * off * off;
        all.diagonal[edge] += of_a * of_a.transpose() * weight;
        all.diagonal[edge + 1] += of_b * of_b.transpose() * weight;
        all.beside[edge] += of_a * of_b.transpose() * weight;
        all.gradient[edge] += of_a * (weight * off);
        all.gradient[edge + 1] += of_b * (weight * off);
    }
    hold(&mut all, 0, sensor.directions[hits.first()?.beam as usize]);
    hold(&mut all, count - 1, sensor.directions[hits.last()?.beam as usize]);
    Some(all)
}

/// Lets a vertex move along `u` alone.
fn hold(all: &mut Normal, vertex: usize, u: Vector2<f64>) {
    let along = u * u.transpose();
    let across = Matrix2::identity() - along;
    let block = &mut all.diagonal[vertex];
    // Across it is as sure as can be; what it errs there is told apart.
    *block = along * *block * along + across * (1e6 * block.trace().max(1.0));
    all.gradient[vertex] = along * all.gradient[vertex];
    if vertex > 0 {
        all.beside[vertex - 1] *= along;
    }
    if let Some(beside) = all.beside.get_mut(vertex) {
        *beside = along * *beside;
    }
}

/// What is left of each diagonal block when the vertices before are solved for, inverted.
fn pivots(all: &Normal, damping: f64) -> Option<Vec<Matrix2<f64>>> {
    let damped =
        |block: &Matrix2<f64>| block + Matrix2::identity() * (damping * block.trace() + 1e-9);
    let mut pivots = vec![damped(&all.diagonal[0]).try_inverse()?];
    for (k, beside) in all.beside.iter().enumerate() {
        let left = damped(&all.diagonal[k + 1]) - beside.transpose() * pivots[k] * beside;
        pivots.push(left.try_inverse()?);
    }
    Some(pivots)
}

/// The step by which the damped equations reduce the sum.
fn solve(all: &Normal, damping: f64) -> Option<Vec<Vector2<f64>>> {
    let pivots = pivots(all, damping)?;
    let mut step = all.gradient.clone();
    for (k, beside) in all.beside.iter().enumerate() {
        let before = pivots[k] * step[k];
        step[k + 1] -= beside.transpose() * before;
    }
    let last = step.len() - 1;
    step[last] = pivots[last] * step[last];
    for k in (0..last).rev() {
        step[k] = pivots[k] * (step[k] - all.beside[k] * step[k + 1]);
    }
    step.iter().all(|v| v.iter().all(|x| x.is_finite())).then_some(step)
}

/// The blocks of the inverse on the diagonal and beside it, times `excess`.
fn inverse(all: &Normal, excess: f64) -> Option<[Vec<Matrix2<f64>>; 2]> {
    let pivots = pivots(all, 0.0)?;
    let last = pivots.len() - 1;
    let mut own = vec![pivots[last]; pivots.len()];
    let mut beside = vec![Matrix2::zeros(); last];
    for k in (0..last).rev() {
        let gain = pivots[k] * all.beside[k];
        beside[k] = -gain * own[k + 1];
        own[k] = pivots[k] + gain * own[k + 1] * gain.transpose();
    }
    let is_finite = |m: &Matrix2<f64>| m.iter().all(|x| x.is_finite());
    if !own.iter().chain(&beside).all(is_finite) {
        return None;
    }
    let symmetric = |m: &Matrix2<f64>| (m + m.transpose()) * (0.5 * excess);
    Some([own.iter().map(symmetric).collect(), beside.iter().map(|m| m * excess).collect()])
}
