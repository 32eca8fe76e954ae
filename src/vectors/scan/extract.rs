//! From the ranges of one scan to runs of points, each of them one straight line.
//!
//! 1. Returns become points; a single spike or a single lost return tears no line.
//! 2. Breakpoints adapt to the range (Borges and Aldon 2004): from a point at range r the next may lie as far as a face
//!    seen under at least λ would have it, r·sin Δφ / sin(λ − Δφ), and three deviations of noise.
//! 3. Between breakpoints, iterative end-point fit: the point farthest from the chord splits, where its distance is
//!    more than noise explains.
//! 4. A point at a border goes to the line that it lies nearer to; neighbours that one line explains as well are one,
//!    over a breakpoint too (a wall seen at a grazing angle is torn by its own perspective).

use nalgebra::{Matrix2, Vector2};

use super::ends;
use super::run::{Hit, Run};
use super::sensor::Sensor;
use crate::line::{Line, ROUGHNESS, Sums};
use crate::segment::{Covariance, End, Segment, Truth};

/// A point this many deviations off its chord splits it.
const SPLIT: f64 = 4.0;
/// What joining two lines may cost, in squared deviations.
const JOIN: f64 = 25.0;
/// A border is moved by this many points at most.
const NEAR: usize = 8;
/// A last point this many deviations off its line is none of it.
const TRIM: f64 = 2.0;
/// Points on either side of a spike that make it one line.
const LINE: usize = 3;
/// Points that may be the rest of two lines' corner.
pub(super) const FEW: usize = 3;
/// Fewest points whose halves say anything.
const HALVED: usize = 8;
/// Fewest points of a segment.
const FEWEST: usize = 2;

/// A return far from both its neighbours.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spike {
    pub(super) beam: u32,
    /// Of the hit that follows.
    pub(super) at: usize,
}

/// Finds segments in scans; keeps its buffers from scan to scan.
#[derive(Debug, Default, Clone)]
pub struct Extractor {
    pub(super) hits: Vec<Hit>,
    pub(super) sums: Vec<Sums>,
    pub(super) clusters: Vec<usize>,
    chords: Vec<(usize, usize)>,
    pub(super) runs: Vec<Run>,
    pub(super) spikes: Vec<Spike>,
    pub(super) bridged: Vec<u32>,
    segments: Vec<Segment<2>>,
}

impl Extractor {
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// The segments of a scan, counter-clockwise, in the sensor's frame. `ranges` are cm, one a beam; one that is not a
    /// number or outside the sensor's reach is no return. Beams without a range, or ranges without a beam, are passed
    /// over.
    pub fn segments(&mut self, sensor: &Sensor, ranges: &[f64]) -> &[Segment<2>] {
        let closed = sensor.is_closed() && ranges.len() >= sensor.count();
        self.find(sensor, ranges, if closed { seam(sensor, ranges) } else { 0 });
        if closed && self.runs.len() > 1 && self.seam_cuts() {
            let start = self.surest_border();
            self.find(sensor, ranges, start);
        }
        self.bridge(sensor);
        self.trim(sensor);
        self.runs.retain(|run| run.to - run.from >= FEWEST);
        for Run { from, to, line } in self.runs.iter_mut().filter(|run| run.to - run.from >= HALVED)
        {
            line.halve(&self.sums, *from, *to);
        }
        self.segments.clear();
        ends::segments(sensor, ranges, &self.hits, &self.runs, &mut self.segments);
        &self.segments
    }

    /// Steps 1 to 4, beginning at a beam.
    fn find(&mut self, sensor: &Sensor, ranges: &[f64], start: usize) {
        self.gather(sensor, ranges, start);
        self.split(sensor);
        self.place_borders(sensor);
        self.merge(sensor);
        self.share_out(sensor);
    }

    /// The first and the last line may be one: what begins and ends at the seam is near, or lies on one line.
    fn seam_cuts(&self) -> bool {
        let (first, last) = (&self.runs[0], &self.runs[self.runs.len() - 1]);
        let gap = (self.hits[first.from].p - self.hits[last.to - 1].p).norm();
        let facing = first.line.direction.dot(&last.line.direction) > 0.9;
        let off = last.line.direction.perp(&(first.line.centre - last.line.centre)).abs();
        gap < 0.2 * self.hits[first.from].r + 10.0 || (facing && off < 20.0)
    }

    /// The beam at which the line begins whose direction differs most from the line before it, both long: a border that
    /// was found, not one that the seam made.
    fn surest_border(&self) -> usize {
        let long = |run: &Run| if run.to - run.from > 3 { 1.0 } else { 0.1 };
        let turn = |at: &usize| {
            let (a, b) = (&self.runs[*at - 1], &self.runs[*at]);
            a.line.direction.perp(&b.line.direction).abs() * long(a) * long(b)
        };
        let at = (1..self.runs.len()).max_by(|a, b| turn(a).total_cmp(&turn(b))).unwrap_or(0);
        self.hits[self.runs[at].from].beam as usize
    }

    /// Beams of the last scan whose returns lie off the line that goes on over them: single spikes.
    #[must_use]
    pub fn bridged(&self) -> &[u32] {
        &self.bridged
    }

    /// What stands before a line of the last scan and was struck by one beam alone (the leg of a chair): a point, as wide as
    /// a beam at most. A spike beyond a line is a false return or a gap, and nothing.
    pub fn thin(&self, sensor: &Sensor, ranges: &[f64]) -> impl Iterator<Item = Segment<2>> {
        let of = |beam: u32| {
            let at = self.spikes.iter().find(|spike| spike.beam == beam)?.at;
            Some((sensor.directions[beam as usize], ranges[beam as usize], self.hits.get(at)?.r))
        };
        let before = self
            .bridged
            .iter()
            .filter_map(move |beam| of(*beam))
            .filter(|(_, own, behind)| own < behind);
        before.map(|(u, range, _)| {
            let half = (0.5 * sensor.step).max(sensor.noise.bearing) * range;
            let along = u * u.transpose();
            let covariance =
                along * sensor.noise.along(range) + (Matrix2::identity() - along) * (half * half);
            let covariance = Covariance { start: covariance, end: covariance, cross: covariance };
            Segment {
                start: u * range,
                end: u * range,
                ends: [End::True(Truth::Free); 2],
                covariance,
            }
        })
    }

    /// A line goes on over a spike where it is a line on both sides of it; elsewhere the spike tears it.
    fn bridge(&mut self, sensor: &Sensor) {
        self.bridged.clear();
        for index in 0..self.spikes.len() {
            let Spike { beam, at } = self.spikes[index];
            let next = self.runs.partition_point(|run| run.to <= at);
            let Some(run) = self.runs.get(next).copied().filter(|run| run.from < at) else {
                continue;
            };
            if (at - run.from).min(run.to - at) >= LINE {
                self.bridged.push(beam);
                continue;
            }
            let parts = [(run.from, at), (at, run.to)].map(|(from, to)| self.run(from, to, sensor));
            self.runs.splice(next..=next, parts);
        }
    }

    /// Steps 1 and 2: hits, their sums, and where the clusters begin.
    fn gather(&mut self, sensor: &Sensor, ranges: &[f64], start: usize) {
        self.hits.clear();
        self.sums.clear();
        self.clusters.clear();
        self.spikes.clear();
        self.sums.push(Sums::default());
        let count = sensor.count().min(ranges.len());
        let range = |beam: usize| ranges[if beam >= count { beam - count } else { beam }];
        for place in start..start + count {
            let beam = if place >= count { place - count } else { place };
            let r = range(beam);
            if !sensor.returned(r) {
                continue;
            }
            if place > start && place + 1 < start + count {
                let (before, after) = (range(place - 1), range(place + 1));
                if is_spike(sensor, before, r, after) {
                    self.spikes.push(Spike { beam: beam as u32, at: self.hits.len() });
                    continue;
                }
            }
            let p = sensor.directions[beam] * r;
            let torn = self.hits.last().is_none_or(|last| {
                let before = if last.beam as usize > beam {
                    last.beam as usize
                } else {
                    last.beam as usize + count
                };
                let gap = (beam + count - before) % count;
                let gap = if gap == 0 { count } else { gap };
                if gap > 2 {
                    return true;
                }
                let far = last.r.min(r) * sensor.oblique[gap] + 3.0 * sensor.noise.along(r).sqrt();
                (p - last.p).norm_squared() > far * far
            });
            if torn {
                self.clusters.push(self.hits.len());
            }
            let sums = self.sums[self.hits.len()].and(p, r * r);
            self.sums.push(sums);
            self.hits.push(Hit { p, r, beam: beam as u32 });
        }
        self.clusters.push(self.hits.len());
    }

    /// Step 3.
    fn split(&mut self, sensor: &Sensor) {
        self.runs.clear();
        for pair in 0..self.clusters.len() - 1 {
            let (from, to) = (self.clusters[pair], self.clusters[pair + 1]);
            self.chords.clear();
            self.chords.push((from, to));
            while let Some((from, to)) = self.chords.pop() {
                match farthest(&self.hits[from..to], sensor) {
                    Some(at) => {
                        // The vertex goes to what follows; step 4 may give it back.
                        self.chords.push((from + at, to));
                        self.chords.push((from, from + at));
                    }
                    None => self.runs.push(self.run(from, to, sensor)),
                }
            }
        }
    }

    pub(super) fn run(&self, from: usize, to: usize, sensor: &Sensor) -> Run {
        let mut line = Line::seen(&self.sums, from, to, &sensor.noise);
        if (self.hits[to - 1].p - self.hits[from].p).dot(&line.direction) < 0.0 {
            line.direction = -line.direction;
        }
        Run { from, to, line }
    }

    /// Step 4, first half: points at the borders.
    fn place_borders(&mut self, sensor: &Sensor) {
        for left in 0..self.runs.len().saturating_sub(1) {
            let (a, b) = (self.runs[left], self.runs[left + 1]);
            if a.to != b.from || a.to - a.from < 3 || b.to - b.from < 3 {
                continue;
            }
            // What the fit loses when the point goes from the second line to the first.
            let gain = |at: usize| {
                let p = self.hits[at].p;
                let off = |line: &Line| line.direction.perp(&(p - line.centre));
                let (one, two) = (off(&a.line), off(&b.line));
                one * one - two * two
            };
            let (mut border, mut best, mut sum) = (a.to, 0.0, 0.0);
            for at in a.to..(a.to + NEAR).min(b.to - 2) {
                sum += gain(at);
                if sum < best {
                    (border, best) = (at + 1, sum);
                }
            }
            sum = 0.0;
            for at in (a.to.saturating_sub(NEAR).max(a.from + 2)..a.to).rev() {
                sum -= gain(at);
                if sum < best {
                    (border, best) = (at, sum);
                }
            }
            if border != a.to {
                self.runs[left] = self.run(a.from, border, sensor);
                self.runs[left + 1] = self.run(border, b.to, sensor);
            }
        }
    }

    /// Where the points `from..to` part, so that those before lie on the one line and the others on the other.
    pub(super) fn border(&self, one: &Line, other: &Line, from: usize, to: usize) -> Option<usize> {
        let on = |line: &Line, at: usize| {
            let off = line.direction.perp(&(self.hits[at].p - line.centre));
            off * off < SPLIT * SPLIT * line.expected
        };
        let border = from + (from..to).take_while(|at| on(one, *at)).count();
        (border..to).all(|at| on(other, at)).then_some(border)
    }

    /// A few points between two longer lines, each of which lies on one of the two, are no line of their own: the
    /// border was found some points beside the corner.
    fn share_out(&mut self, sensor: &Sensor) {
        let mut kept = 0;
        let mut next = 0;
        while next < self.runs.len() {
            let run = self.runs[next];
            let (from, to) = (run.from, run.to);
            let sides = (kept > 0 && next + 1 < self.runs.len() && to - from <= FEW)
                .then(|| (self.runs[kept - 1], self.runs[next + 1]))
                .filter(|(a, b)| a.to - a.from > FEW && b.to - b.from > FEW)
                .filter(|(a, _)| !self.is_torn(a, &run))
                .filter(|(_, b)| !self.is_torn(&run, b));
            let border = sides.and_then(|(a, b)| self.border(&a.line, &b.line, from, to));
            match (border, sides) {
                (Some(border), Some((a, b))) => {
                    self.runs[kept - 1] = self.run(a.from, border, sensor);
                    self.runs[next + 1] = self.run(border, b.to, sensor);
                }
                _ => {
                    self.runs[kept] = run;
                    kept += 1;
                }
            }
            next += 1;
        }
        self.runs.truncate(kept);
    }

    /// Points at the ends that lie off the line by more than noise belong to no line: half a beam on each of two faces.
    fn trim(&mut self, sensor: &Sensor) {
        for index in 0..self.runs.len() {
            let Run { mut from, mut to, line } = self.runs[index];
            let limit = TRIM * TRIM * line.variance();
            let off = |p: Vector2<f64>| {
                let across = line.direction.perp(&(p - line.centre));
                across * across > limit
            };
            while to - from > FEWEST && off(self.hits[from].p) {
                from += 1;
            }
            while to - from > FEWEST && off(self.hits[to - 1].p) {
                to -= 1;
            }
            if to - from < self.runs[index].to - self.runs[index].from {
                self.runs[index] = self.run(from, to, sensor);
            }
        }
    }

    /// Too little on either side of a breakpoint to say that a line goes on over it: the greater of the two must be
    /// longer than the gap. Three points beside a far fourth lie on some line always.
    fn is_torn(&self, a: &Run, b: &Run) -> bool {
        if self.clusters.binary_search(&b.from).is_err() {
            return false;
        }
        let length = |run: &Run| {
            let count = run.to - run.from;
            if count < 4 { 0.0 } else { (self.hits[run.to - 1].p - self.hits[run.from].p).norm() }
        };
        let gap = (self.hits[b.from].p - self.hits[a.to - 1].p).norm();
        gap > length(a).max(length(b))
    }

    /// Step 4, second half: neighbours that are one line.
    fn merge(&mut self, sensor: &Sensor) {
        let mut kept: usize = 0;
        for next in 0..self.runs.len() {
            let mut run = self.runs[next];
            while kept > 0 {
                let before = self.runs[kept - 1];
                let (last, first) = (&self.hits[before.to - 1], &self.hits[run.from]);
                let beams = sensor.steps(last.beam, first.beam);
                if run.to - before.from < 4 || beams > 2 {
                    break;
                }
                if self.is_torn(&before, &run) {
                    break;
                }
                let joint = self.run(before.from, run.to, sensor);
                if !is_one(&before, &run, &joint) {
                    break;
                }
                run = joint;
                kept -= 1;
            }
            self.runs[kept] = run;
            kept += 1;
        }
        self.runs.truncate(kept);
    }
}

/// Whether one line explains two runs as well as one line each does.
pub(super) fn is_one(one: &Run, other: &Run, joint: &Run) -> bool {
    let cost = |run: &Run| run.line.sse / run.line.expected;
    cost(joint) - cost(one) - cost(other) <= JOIN
}

/// Where to begin a closed scan: at its greatest jump, so that the beginning cuts no line.
fn seam(sensor: &Sensor, ranges: &[f64]) -> usize {
    let value = |beam: usize| {
        let r = ranges[beam];
        if sensor.returned(r) { r } else { sensor.farthest * 2.0 }
    };
    let count = sensor.count();
    let jump = |beam: &usize| {
        let before = if *beam == 0 { count - 1 } else { *beam - 1 };
        (value(*beam) - value(before)).abs()
    };
    (0..count).max_by(|a, b| jump(a).total_cmp(&jump(b))).unwrap_or(0)
}

/// A return far from both its neighbours, which lie near each other.
fn is_spike(sensor: &Sensor, before: f64, r: f64, after: f64) -> bool {
    let (down, up) = (r - before, r - after);
    if down * up <= 0.0 || !sensor.returned(before) || !sensor.returned(after) {
        return false;
    }
    let apart = (before - after).abs();
    let noise = 3.0 * sensor.noise.along(r).sqrt();
    let least = down.abs().min(up.abs());
    least > 4.0 * (apart + noise) && apart < 2.0 * sensor.step * before + noise
}

/// The point farthest from the chord between the ends, if it is farther off than noise explains.
fn farthest(hits: &[Hit], sensor: &Sensor) -> Option<usize> {
    if hits.len() < 3 {
        return None;
    }
    let (first, last) = (hits[0].p, hits[hits.len() - 1].p);
    let chord = last - first;
    let (mut best, mut off) = (0, 0.0);
    for (at, hit) in hits.iter().enumerate().skip(1).take(hits.len() - 2) {
        let across = chord.perp(&(hit.p - first)).abs();
        if across > off {
            (best, off) = (at, across);
        }
    }
    if off == 0.0 {
        return None;
    }
    // All three points err: the two ends together by at most as much again.
    let (hit, square) = (hits[best], chord.norm_squared());
    let noise = &sensor.noise;
    let facing = if square > 0.0 {
        let turn = chord.perp(&sensor.directions[hit.beam as usize]);
        turn * turn / square
    } else {
        1.0
    };
    let bearing = noise.bearing * hit.r;
    let variance =
        noise.along(hit.r) * facing + bearing * bearing * (1.0 - facing) + ROUGHNESS * ROUGHNESS;
    (off * off > SPLIT * SPLIT * 1.5 * variance * square).then_some(best)
}
