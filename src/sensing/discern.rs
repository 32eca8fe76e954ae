//! A move that would tell poses apart which one scan cannot (SPEC L3): the same for all of them, since the robot does not
//! know at which it is.

use nalgebra::{Isometry2, Point2, Vector2};

use super::chart::Chart;
use super::locate::Fit;

/// Turn on the spot, then drive ahead.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Move {
    /// Radians, counter-clockwise.
    pub turn: f64,
    /// In cm.
    pub ahead: f64,
    /// How many of the pairs of poses it tells apart, as a share.
    pub tells: f64,
}

/// Turns and ways that are tried, in degrees and cm.
const TURNS: [f64; 8] = [0.0, 90.0, -90.0, 180.0, 45.0, -45.0, 135.0, -135.0];
const AHEAD: [f64; 6] = [0.0, 50.0, 100.0, 200.0, 300.0, 500.0];
/// Beams of the look that is foreseen, over the half turn ahead, and how far they reach, in cm.
const BEAMS: usize = 61;
const REACH: f64 = 1000.0;
/// Two looks differ by which so many of the beams do, each by more than this, in cm and as a share of the range.
const DIFFER: f64 = 0.2;
const APART: (f64, f64) = (20.0, 0.05);
/// Poses that are told apart: of more, the best ones.
const MOST: usize = 16;

/// The shortest move that tells most of the poses apart, for a robot of a radius in cm; none where no move does, or where
/// none could be made from all of them.
#[must_use]
pub fn telling_move(chart: &Chart, fits: &[Fit], radius: f64) -> Option<Move> {
    let poses: Vec<Isometry2<f64>> = fits.iter().take(MOST).map(|fit| fit.pose).collect();
    let pairs = poses.len() * poses.len().saturating_sub(1) / 2;
    if pairs == 0 {
        return None;
    }
    let mut best: Option<(f64, Move)> = None;
    for turn in TURNS {
        let turn = turn.to_radians();
        for ahead in AHEAD {
            if turn == 0.0 && ahead == 0.0 {
                continue;
            }
            if !poses.iter().all(|pose| is_free(chart, pose, turn, ahead, radius)) {
                break;
            }
            let looks: Vec<Vec<f64>> = poses
                .iter()
                .map(|pose| {
                    let by =
                        Isometry2::new(Vector2::zeros(), turn) * Isometry2::translation(ahead, 0.0);
                    look(chart, &(pose * by))
                })
                .collect();
            let told = (0..looks.len())
                .flat_map(|a| (a + 1..looks.len()).map(move |b| (a, b)))
                .filter(|&(a, b)| differ(&looks[a], &looks[b]))
                .count();
            let tells = told as f64 / pairs as f64;
            // A quarter turn costs about what half a metre does.
            let cost = ahead + turn.abs() * 32.0;
            let is_better = best.is_none_or(|(known, other)| {
                tells > other.tells + 1e-9 || (tells >= other.tells && cost < known)
            });
            if told > 0 && is_better {
                best = Some((cost, Move { turn, ahead, tells }));
            }
        }
    }
    best.map(|(_, found)| found)
}

/// Whether nothing that the chart has stands on the way.
fn is_free(chart: &Chart, pose: &Isometry2<f64>, turn: f64, ahead: f64, radius: f64) -> bool {
    if ahead == 0.0 {
        return true;
    }
    let along = pose.rotation * Vector2::new(turn.cos(), turn.sin());
    let from = Point2::from(pose.translation.vector);
    let steps = (ahead / 10.0).ceil() as usize;
    (0..=steps).all(|step| {
        let at = from + along * (ahead * step as f64 / steps as f64);
        chart.is_clear(at, radius)
    })
}

/// The ranges over the half turn ahead.
fn look(chart: &Chart, pose: &Isometry2<f64>) -> Vec<f64> {
    let half = std::f64::consts::FRAC_PI_2;
    let bearing = |beam: usize| 2.0 * half * beam as f64 / (BEAMS - 1) as f64 - half;
    (0..BEAMS).map(|beam| chart.cast(pose, bearing(beam), REACH).0).collect()
}

fn differ(one: &[f64], other: &[f64]) -> bool {
    let apart = |(a, b): &(&f64, &f64)| (*a - *b).abs() > APART.1.mul_add(a.min(**b), APART.0);
    let count = one.iter().zip(other).filter(apart).count();
    count as f64 >= DIFFER * one.len() as f64
}
