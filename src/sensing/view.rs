//! One scan, made ready to be held against faces: its returns as points, the corners of its lines.

use nalgebra::Vector2;
use orthoframe_vectors::Segment;
use orthoframe_vectors::scan::{Extractor, Sensor};

use crate::corners::Corner;

/// Beams of a scan that are held against the faces.
const BEAMS: usize = 180;
/// Points by which a pose is tried first.
const PROBES: usize = 40;
/// Corners of a scan by which poses are looked for.
const CORNERS: usize = 14;
/// Corners that one line may make.
const SHARES: usize = 4;
/// Shortest line that makes a corner, in cm.
const SHORTEST: f64 = 25.0;

/// A scan in the frame of its sensor.
#[derive(Debug, Clone)]
pub(crate) struct View {
    pub(crate) beams: Vec<Return>,
    pub(crate) corners: Vec<Corner>,
    /// Points on lines, well spread: any first few of them are all around.
    pub(crate) probes: Vec<Vector2<f64>>,
}

/// A beam that came back.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Return {
    pub(crate) u: Vector2<f64>,
    pub(crate) range: f64,
    /// Deviation of the range, in cm.
    pub(crate) noise: f64,
}

impl Return {
    pub(crate) fn point(&self) -> Vector2<f64> {
        self.u * self.range
    }
}

impl View {
    /// With corners of lines that end within `reach` cm of their meeting.
    pub(crate) fn new(sensor: &Sensor, ranges: &[f64], reach: f64) -> Self {
        let mut extractor = Extractor::new();
        let segments = extractor.segments(sensor, ranges).to_vec();
        let all = sensor.directions().iter().zip(ranges);
        let returned = all.filter(|(_, range)| sensor.returned(**range));
        let beams: Vec<Return> = returned
            .map(|(u, &range)| {
                let noise = sensor.noise().along(range).sqrt();
                Return { u: *u, range, noise }
            })
            .collect();
        let stride = beams.len().div_ceil(BEAMS).max(1);
        let beams: Vec<Return> = beams.into_iter().step_by(stride).collect();
        let corners = corners(&segments, reach);
        let probes = probes(&segments);
        Self { beams, corners, probes }
    }
}

/// The corners that say most: of long lines, and not of the same ones again and again.
fn corners(segments: &[Segment<2>], reach: f64) -> Vec<Corner> {
    let mut pairs = Vec::new();
    for (i, a) in segments.iter().enumerate() {
        for (j, b) in segments.iter().enumerate().skip(i + 1) {
            let least = a.length().min(b.length());
            if least < SHORTEST {
                continue;
            }
            if let Some(corner) = Corner::of((a.start, a.end), (b.start, b.end), reach) {
                pairs.push((least.min(150.0), i, j, corner));
            }
        }
    }
    pairs.sort_by(|a, b| b.0.total_cmp(&a.0).then((a.1, a.2).cmp(&(b.1, b.2))));
    let mut shares = vec![0; segments.len()];
    let mut chosen = Vec::new();
    for (_, i, j, corner) in pairs {
        if shares[i] < SHARES && shares[j] < SHARES && chosen.len() < CORNERS {
            shares[i] += 1;
            shares[j] += 1;
            chosen.push(corner);
        }
    }
    chosen
}

/// Points at even distances along all lines, in an order that jumps about.
fn probes(segments: &[Segment<2>]) -> Vec<Vector2<f64>> {
    let total: f64 = segments.iter().map(Segment::length).sum();
    let step = (total / PROBES as f64).max(1.0);
    let (mut points, mut next) = (Vec::new(), 0.5 * step);
    for segment in segments {
        let length = segment.length();
        while next < length {
            points.push(segment.start + segment.vector() * (next / length));
            next += step;
        }
        next -= length;
    }
    let count = points.len();
    // A stride near the golden section that shares no factor with the number visits each once.
    let golden = (count as f64 * 0.618) as usize;
    let stride = (golden..=count).find(|s| gcd(*s, count) == 1).unwrap_or(1);
    (0..count).map(|k| points[k * stride % count]).collect()
}

const fn gcd(a: usize, b: usize) -> usize {
    if b == 0 { a } else { gcd(b, a % b) }
}
