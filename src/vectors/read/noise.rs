//! How much the ranges of a log err, seen from the log itself: most formats do not tell.
//!
//! The inverse of the range of a straight face, 1/r = α cos θ + β sin θ, is annihilated by three beams in a row:
//! 1/r₋ + 1/r₊ − 2 cos Δθ / r = 0. What is left of it, times r², is noise of variance 6 σ², wherever the three lie on one face.
//! Most do; those over an edge are far off, and quantiles do not mind them.

use super::Log;
use crate::scan::Noise;

/// Quantiles of |x| of the normal law, in σ; of both the lesser is taken, since clutter makes either greater.
const QUANTILES: [(f64, f64); 2] = [(0.25, 0.318_64), (0.5, 0.674_49)];
/// Fewest triples of beams that tell anything, and how many are looked at.
const TRIPLES: (usize, usize) = (100, 200_000);
/// Of what is assumed, so much is no other sensor.
const SURE: f64 = 1.5;
/// What is greater, in cm, is no noise.
const MOST: f64 = 10.0;

/// Gives the sensors of a log the noise that its ranges have, where that is clearly more than was assumed.
pub(super) fn measure(log: &mut Log) {
    let Some(found) = deviation(log) else { return };
    for sensor in &mut log.sensors {
        let assumed = sensor.noise();
        if found > SURE * assumed.range {
            let noise = Noise { range: found, ..assumed };
            *sensor = sensor.clone().with_noise(noise).expect("a deviation of some centimetres");
        }
    }
}

/// Deviation of one range, in cm.
fn deviation(log: &Log) -> Option<f64> {
    let beams: usize = log.scans.iter().map(|scan| scan.ranges.len()).sum();
    let every = (beams / TRIPLES.1).max(1);
    let mut off = Vec::new();
    for scan in log.scans.iter().step_by(every) {
        let sensor = log.sensor(scan);
        let turn = 2.0 * sensor.step().cos();
        let triples = scan.ranges.windows(3).filter(|t| t.iter().all(|r| sensor.returned(*r)));
        off.extend(triples.map(|t| {
            let inverse = 1.0 / t[0] + 1.0 / t[2] - turn / t[1];
            (inverse * t[1] * t[1]).abs() / 6.0_f64.sqrt()
        }));
    }
    if off.len() < TRIPLES.0 {
        return None;
    }
    off.sort_unstable_by(f64::total_cmp);
    let told = QUANTILES.map(|(share, law)| off[(share * off.len() as f64) as usize] / law);
    Some(told[0].min(told[1])).filter(|found| *found <= MOST)
}
