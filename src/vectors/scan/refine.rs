//! A scan in no more than so many vertices, as well as they can tell it: slower than [`Extractor::segments`], and nearer to
//! what was measured.
//!
//! Which returns are vertices is decided for all of them together ([`optimal`](super::optimal)), then the vertices are
//! moved to where the beams are most likely ([`adjust`](super::adjust)).

use nalgebra::{Matrix2, Vector2};

use super::adjust::{Adjusted, adjust};
use super::ends::{bends, tip};
use super::extract::{Extractor, FEW, is_one};
use super::optimal::{Hops, LOST, count};
use super::run::{Hit, Run};
use super::sensor::Sensor;
use crate::line::ROUGHNESS;
use crate::segment::{Covariance, Cut, End, Segment, Truth};

/// How far from one another, in cm, neighbours lie at most that one edge may pass over: what is nearer than that may be
/// one thing, told coarsely.
const STEP: f64 = 20.0;

/// Times that vertices which were no bend are spent elsewhere.
const ROUNDS: usize = 4;

impl Extractor {
    /// The segments of a scan that tell it best in at most `vertices` vertices, a corner counted once, as
    /// [`segments`](Self::segments) tells it otherwise; each point that [`thin`](Self::thin) tells is one of them.
    ///
    /// A beam that went past what is on either side of it by more than half a metre is a gap here.
    pub fn refined(&mut self, sensor: &Sensor, ranges: &[f64], vertices: usize) -> Vec<Segment<2>> {
        self.segments(sensor, ranges);
        let mut found: Vec<Segment<2>> = Vec::new();
        let left = vertices.saturating_sub(self.thin(sensor, ranges).count());
        let torn = self.tears();
        let hops = Hops::of(&self.hits, sensor, self.joined(sensor, ranges, &torn));
        for chain in self.polylines(sensor, &hops, left) {
            self.tell(sensor, ranges, &chain, &torn, &mut found);
        }
        found
    }

    /// Hits before which no face was seen to go on from the hit before, ascending.
    fn tears(&self) -> Vec<usize> {
        let inside = |at: usize| self.runs.iter().any(|run| run.from < at && at < run.to);
        let mut torn: Vec<usize> =
            self.clusters.iter().copied().filter(|at| !inside(*at)).collect();
        torn.extend(self.spikes.iter().filter(|s| !self.bridged.contains(&s.beam)).map(|s| s.at));
        torn.sort_unstable();
        torn.dedup();
        torn
    }

    /// Runs of hits `from..to` over which edges may go.
    fn joined(&self, sensor: &Sensor, ranges: &[f64], torn: &[usize]) -> Vec<(usize, usize)> {
        let hits = &self.hits;
        let is_far = |at: usize| {
            let (a, b) = (&hits[at - 1], &hits[at]);
            let next = sensor.steps(a.beam, b.beam) <= 2;
            !next || (a.p - b.p).norm() > STEP
        };
        let past = self.spikes.iter().filter(|s| 0 < s.at && s.at < hits.len());
        let past = past.filter(|s| {
            let is_past = ranges[s.beam as usize] > hits[s.at - 1].r.max(hits[s.at].r) + LOST;
            is_past || !self.bridged.contains(&s.beam)
        });
        let mut borders: Vec<usize> = past.map(|s| s.at).collect();
        borders
            .extend(torn.iter().copied().filter(|at| *at > 0 && *at < hits.len() && is_far(*at)));
        borders.extend([0, hits.len()]);
        borders.sort_unstable();
        borders.dedup();
        borders.windows(2).map(|pair| (pair[0], pair[1])).collect()
    }

    /// Polylines of at most `most` vertices, each of them a bend or an end.
    fn polylines(&self, sensor: &Sensor, hops: &Hops<'_>, most: usize) -> Vec<Vec<usize>> {
        let mut asked = most;
        let mut best = Vec::new();
        for _ in 0..ROUNDS {
            let mut chains = hops.best(asked);
            let all = count(&chains);
            chains.iter_mut().for_each(|chain| self.straighten(sensor, chain));
            let left = count(&chains);
            if left > most {
                break;
            }
            best = chains;
            // What is not spent may be asked for; where less was found than asked for, nothing more is worth a vertex.
            if left == most || all < asked {
                break;
            }
            asked += most - left;
        }
        best
    }

    /// Takes inner vertices away that are no bend, since an edge from return to return takes on the errors of both: where one
    /// line explains two edges as well, and where a corner was cut by an edge of a few returns.
    fn straighten(&self, sensor: &Sensor, chain: &mut Vec<usize>) {
        let mut k = 1;
        while k + 1 < chain.len() {
            let (from, at, to) = (chain[k - 1], chain[k], chain[k + 1] + 1);
            let [one, other, joint] =
                [(from, at), (at, to), (from, to)].map(|(from, to)| self.run(from, to, sensor));
            if is_one(&one, &other, &joint) {
                chain.remove(k);
                k = k.max(2) - 1;
            } else {
                k += 1;
            }
        }
        let mut k = 1;
        while k + 2 < chain.len() {
            let [before, from, to, after] = [chain[k - 1], chain[k], chain[k + 1], chain[k + 2]];
            let is_cut = to - from < FEW && from - before > FEW && after - to > FEW;
            let sides = [(before, from), (to + 1, after + 1)];
            let [one, other] = sides.map(|(from, to)| self.run(from, to, sensor).line);
            match self.border(&one, &other, from, to + 1).filter(|_| is_cut) {
                Some(border) => {
                    chain.remove(k + 1);
                    chain[k] = border.min(to);
                }
                None => k += 1,
            }
        }
    }

    /// The segments of one polyline.
    fn tell(
        &self,
        sensor: &Sensor,
        ranges: &[f64],
        chain: &[usize],
        torn: &[usize],
        into: &mut Vec<Segment<2>>,
    ) {
        let (first, last) = (chain[0], chain[chain.len() - 1]);
        let hits = &self.hits[first..=last];
        let points: Vec<Vector2<f64>> = chain.iter().map(|at| self.hits[*at].p).collect();
        let known = adjust(sensor, hits, &points);
        let edges: Vec<Option<Run>> = chain
            .windows(2)
            .map(|pair| {
                // Between two neighbours across a tear nothing was seen.
                let is_gap = pair[1] == pair[0] + 1 && torn.binary_search(&pair[1]).is_ok();
                (!is_gap).then(|| self.run(pair[0], pair[1] + 1, sensor))
            })
            .collect();
        let met = |before: &Option<Run>, after: &Option<Run>| match (before, after) {
            (Some(one), Some(two)) if bends(&one.line, &two.line) => Some(End::True(Truth::Corner)),
            (Some(_), Some(_)) => Some(End::Cut(Cut::Unclear)),
            _ => None,
        };
        for (k, edge) in edges.iter().enumerate() {
            let Some(run) = edge else { continue };
            let start = k.checked_sub(1).and_then(|before| met(&edges[before], edge));
            let end = edges.get(k + 1).and_then(|after| met(edge, after));
            let start = start.unwrap_or_else(|| tip(sensor, ranges, &self.hits, run, false).end);
            let end = end.unwrap_or_else(|| tip(sensor, ranges, &self.hits, run, true).end);
            let own = [&self.hits[chain[k]], &self.hits[chain[k + 1]]];
            let (points, covariance) = known.as_ref().map_or_else(
                || guessed(sensor, own),
                |known| told(sensor, known, k, own, [k == 0, k + 2 == chain.len()]),
            );
            let [from, to] = points;
            into.push(Segment { start: from, end: to, ends: [start, end], covariance });
        }
    }
}

/// An edge of an adjusted polyline; where the polyline itself ends, the vertex errs across its beam too.
fn told(
    sensor: &Sensor,
    known: &Adjusted,
    k: usize,
    hits: [&Hit; 2],
    ends: [bool; 2],
) -> ([Vector2<f64>; 2], Covariance<2>) {
    let mut covariance =
        Covariance { start: known.own[k], end: known.own[k + 1], cross: known.beside[k] };
    for ((hit, is_end), block) in
        hits.into_iter().zip(ends).zip([&mut covariance.start, &mut covariance.end])
    {
        if is_end {
            *block += across(sensor, hit);
        }
    }
    ([known.vertices[k], known.vertices[k + 1]], covariance)
}

/// An edge whose vertices stayed where the returns are.
fn guessed(sensor: &Sensor, hits: [&Hit; 2]) -> ([Vector2<f64>; 2], Covariance<2>) {
    let [start, end] = hits.map(|hit| {
        let u = sensor.directions[hit.beam as usize];
        u * u.transpose() * (sensor.noise.along(hit.r) + ROUGHNESS * ROUGHNESS)
            + across(sensor, hit)
    });
    (hits.map(|hit| hit.p), Covariance { start, end, cross: Matrix2::zeros() })
}

/// What a return errs across its beam: the beam's direction, and between which two beams a face ends.
fn across(sensor: &Sensor, hit: &Hit) -> Matrix2<f64> {
    let u = sensor.directions[hit.beam as usize];
    let error = sensor.noise.bearing * hit.r;
    (Matrix2::identity() - u * u.transpose()) * (error * error + ROUGHNESS * ROUGHNESS)
}
