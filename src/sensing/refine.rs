//! A pose made exact: returns against the lines that they lie on, by least squares (point to line: Y. Chen, G. Medioni,
//! 1991), with the covariance that this gives.

use nalgebra::{Isometry2, Matrix3, Point2, Vector2, Vector3};

use super::chart::Chart;

/// Steps of the least squares at most, and by how many of them the gate has become narrow.
const STEPS: usize = 12;
const NARROW: usize = 5;
/// A step by less than this is the last, in cm and rad.
const CONVERGED: (f64, f64) = (0.05, 1e-4);
/// Returns farther from every line than this take no part, in cm: at first where the pose is only roughly known, and in the
/// end.
pub(crate) const WIDE: f64 = 40.0;
pub(crate) const CLOSE: f64 = 12.0;

/// A pose and its covariance over x, y (cm) and the turn (rad).
pub(crate) struct Refined {
    pub(crate) pose: Isometry2<f64>,
    pub(crate) covariance: Matrix3<f64>,
}

/// None where the returns do not hold the pose in all directions, as in a corridor without an end in sight.
pub(crate) fn refine(
    chart: &Chart,
    returns: &[Vector2<f64>],
    sigma: f64,
    start: Isometry2<f64>,
    first_gate: f64,
) -> Option<Refined> {
    let mut pose = start;
    let mut covariance = None;
    for step in 0..STEPS {
        let share = (step as f64 / NARROW as f64).min(1.0);
        let gate = first_gate + (CLOSE - first_gate) * share;
        let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
        let (mut squares, mut count) = (0.0, 0);
        for p in returns {
            let at = pose * Point2::from(*p);
            let Some((line, foot)) = chart.nearest(at) else { continue };
            let line = &chart.lines()[line as usize];
            if (foot - at).norm() > gate {
                continue;
            }
            let along = line.direction();
            let n = Vector2::new(-along.y, along.x);
            let residual = n.dot(&(foot - at));
            let arm = at.coords - pose.translation.vector;
            let row = Vector3::new(n.x, n.y, n.y * arm.x - n.x * arm.y);
            // Huber: what is far off pulls no harder than what is near.
            let weight = (5.0 / residual.abs().max(5.0)).min(1.0);
            normal += weight * row * row.transpose();
            right += weight * row * residual;
            squares += weight * residual * residual;
            count += 1;
        }
        if count < 10 {
            return None;
        }
        let inverse = normal.try_inverse()?;
        let by = inverse * right;
        if !by.iter().all(|x| x.is_finite()) || by.xy().norm() > 60.0 || by.z.abs() > 0.3 {
            return None;
        }
        pose = Isometry2::new(pose.translation.vector + by.xy(), pose.rotation.angle() + by.z);
        let spread = (squares / f64::from(count)).sqrt().max(sigma);
        covariance = Some(inverse * (spread * spread));
        if step > NARROW && by.xy().norm() < CONVERGED.0 && by.z.abs() < CONVERGED.1 {
            break;
        }
    }
    let covariance = covariance?;
    let is_held = covariance[(0, 0)].max(covariance[(1, 1)]) < 30.0 * 30.0;
    is_held.then_some(Refined { pose, covariance })
}
