//! Where one scan can have been taken, without a guess (SPEC L2, L3).

use std::f64::consts::TAU;

use nalgebra::{Isometry2, Matrix3, Vector2, Vector3};

use super::chart::Chart;
use super::refine::{CLOSE, WIDE, refine};
use super::search::{Course, Mark, Pyramid, is_near};
use crate::vectors::scan::{Extractor, Sensor};

/// A pose that a scan fits.
#[derive(Debug, Clone)]
pub struct Fit {
    /// Of the sensor.
    pub pose: Isometry2<f64>,
    /// Over x, y (cm) and the turn (rad).
    pub covariance: Matrix3<f64>,
    /// Share of the beams that end where the chart says.
    pub explained: f64,
    /// Share of the beams that go through what the chart has.
    pub through: f64,
    /// The same share as `explained`, each beam by how near to what the chart says it ends.
    pub likeness: f64,
}

impl Fit {
    /// Greatest deviation of the position, in cm, and that of the heading, in rad.
    #[must_use]
    pub fn deviations(&self) -> (f64, f64) {
        let position = self.covariance.fixed_view::<2, 2>(0, 0).into_owned();
        let worst = position.symmetric_eigenvalues().max();
        (worst.max(0.0).sqrt(), self.covariance[(2, 2)].max(0.0).sqrt())
    }

    /// How well it fits: what goes through a wall counts against it.
    #[must_use]
    pub fn worth(&self) -> f64 {
        self.explained - self.through
    }

    /// How well it fits beside other poses of the same scan: where the chart is full of lines, many a beam ends near one by
    /// chance, and few end on one.
    #[must_use]
    pub fn rank(&self) -> f64 {
        self.likeness - self.through
    }
}

/// What a scan says of where it was taken.
#[derive(Debug, Clone)]
pub enum Answer {
    /// Here; nowhere else does it fit nearly as well.
    Unique(Fit),
    /// At one of these, the best first.
    Ambiguous(Vec<Fit>),
    /// No place is told.
    Unknown(Unknown),
}

/// Why no place is told.
#[derive(Debug, Clone)]
pub enum Unknown {
    /// Too little returned to say anything.
    TooLittle,
    /// At no place does what the chart has explain enough of what is seen: the chart is another, or the place is off it.
    Nowhere,
    /// One place is left, and it fits too little to be told, or the next scan has yet to lead there again.
    Unsure,
    /// At one of these, the best first, or at others, of which there are too many to be looked through, or one wherever it slides
    /// along a corridor. A robot that moves on sees more.
    TooMany(Vec<Fit>),
}

/// When a pose counts.
#[derive(Debug, Clone, Copy)]
pub struct Options {
    /// Share of the returns that must lie on lines.
    pub least: f64,
    /// How much worse than the best another place fits and is still possible.
    pub margin: f64,
    /// The laser's noise, in cm.
    pub sigma: f64,
    /// Returns farther than this are left aside, in cm: at a distance a turn of half a degree is a wall's thickness.
    pub farthest: f64,
}

impl Default for Options {
    fn default() -> Self {
        Self { least: 0.55, margin: 0.15, sigma: 3.0, farthest: 1500.0 }
    }
}

/// Finds poses on a chart.
pub struct Localiser<'c> {
    chart: &'c Chart,
    pyramid: Pyramid,
    options: Options,
}

/// Beams that are looked at.
const SEARCHED: usize = 90;
const VERIFIED: usize = 120;
/// Places nearer than this are one, in cm.
pub(crate) const APART: f64 = 60.0;
/// Share of the margin by which the search's sums may be less than the best: on the logs they tell the right place from others
/// better than ranks do.
const SUMMED: f64 = 2.0 / 3.0;
/// Places of which more are no answer.
const MOST_PLACES: usize = 200;
/// Of more than these so many are looked at, and told of.
const SOME: usize = 16;
/// How far a beam ends from what it strikes, in cm and as a share of its range: the chart's errors, and the pose's.
const NEAR: (f64, f64) = (4.0, 0.005);
/// A place that is alone in fitting is the one only where it fits so well: where a map lacks furniture or is drawn otherwise, the
/// true place fits worse, and a wrong one may fit best.
const SURE: f64 = 0.65;
/// Shorter lines, in cm, have no sure course.
const LEAST_LINE: f64 = 40.0;
/// What becomes of a beam, as shares: it ends at what the chart has, before it at what the chart lacks, or anywhere.
const HIT: f64 = 0.3;
const SHORT: f64 = 0.4;
const STRAY: f64 = 0.3;
/// How far off a wall may be drawn, in cm and as a share of the range, where a beam's likelihood is asked for.
const WALLS: (f64, f64) = (15.0, 0.01);
/// Of a scan with fewer returns nothing can be said.
pub(crate) const LEAST_RETURNS: usize = 25;

/// What beams say for a pose, summed.
#[derive(Debug, Default)]
pub(crate) struct Sums {
    count: f64,
    explained: f64,
    through: f64,
    likeness: f64,
    evidence: f64,
}

impl Sums {
    pub(crate) fn fit(&self, pose: Isometry2<f64>, covariance: Matrix3<f64>) -> Fit {
        let share = |n: f64| n / self.count.max(1.0);
        let [explained, through, likeness] =
            [self.explained, self.through, self.likeness].map(share);
        Fit { pose, covariance, explained, through, likeness }
    }
}

/// So far from where it should end, in cm, a beam of this range still ends there.
fn slack(range: f64) -> f64 {
    10.0 + 0.02 * range
}

/// How sure a place is that odometry alone holds: 30 cm, .1 rad.
pub(crate) fn loosely() -> Matrix3<f64> {
    Matrix3::from_diagonal(&Vector3::new(900.0, 900.0, 0.01))
}

impl<'c> Localiser<'c> {
    #[must_use]
    pub fn new(chart: &'c Chart, options: Options) -> Self {
        Self { chart, pyramid: Pyramid::of(chart), options }
    }

    #[must_use]
    pub fn chart(&self) -> &'c Chart {
        self.chart
    }

    pub(crate) fn pyramid(&self) -> &Pyramid {
        &self.pyramid
    }

    #[must_use]
    pub fn options(&self) -> &Options {
        &self.options
    }

    /// Where the scan can have been taken. `ranges` are in cm, one a beam of the sensor.
    #[must_use]
    pub fn locate(&self, sensor: &Sensor, ranges: &[f64]) -> Answer {
        let returns = self.returns(sensor, ranges);
        if returns.len() < LEAST_RETURNS {
            return Answer::Unknown(Unknown::TooLittle);
        }
        let marks = self.marks(sensor, ranges, &returns);
        let Options { least, margin, .. } = self.options;
        // What the best leaves unexplained the chart lacks there: it may lack as much again where the scan was truly taken.
        let worse = |best: f64| f64::max(SUMMED * margin, 1.0 - best);
        let found = self.pyramid.search(&marks, 0.8 * least, worse, APART, MOST_PLACES);
        if !found.is_all {
            return self.among_many(sensor, ranges, found.places);
        }
        let some: Vec<Vector2<f64>> = marks.iter().map(|mark| mark.at).collect();
        let roughly = |candidate| self.fit(sensor, ranges, &some, candidate, WIDE);
        // What holds a pose, and where what could slide along a corridor was found.
        let (mut rough, mut loose): (Vec<Fit>, Vec<Isometry2<f64>>) = Default::default();
        for place in found.places {
            match roughly(place) {
                Some(fit) => rough.push(fit),
                None => loose.push(place),
            }
        }
        let best = rough.iter().map(Fit::rank).fold(-1.0, f64::max);
        let mut judged: Vec<(f64, Fit)> = Vec::new();
        for fit in rough.iter().filter(|fit| fit.rank() >= best - 1.5 * margin) {
            let refined = refine(self.chart, &returns, self.options.sigma, fit.pose, WIDE);
            let Some(refined) = refined else {
                loose.push(fit.pose);
                continue;
            };
            let sums = self.sums(sensor, ranges, &refined.pose);
            let evidence = sums.evidence / sums.count.max(1.0);
            let fit = sums.fit(refined.pose, refined.covariance);
            match judged.iter_mut().find(|(_, known)| is_near(&known.pose, &fit.pose, APART)) {
                Some(known) if known.1.rank() < fit.rank() => *known = (evidence, fit),
                Some(_) => {}
                None => judged.push((evidence, fit)),
            }
        }
        let first = judged.iter().map(|(_, fit)| fit.rank()).fold(-1.0, f64::max);
        judged.sort_by(|(a, _), (b, _)| b.total_cmp(a));
        // The likeliest is told first; the only one it is where none fits nearly as well by what is explained either: on a plan
        // that is not exact a wrong place may be the likeliest by far.
        let mut fits: Vec<Fit> = judged.into_iter().map(|(_, fit)| fit).collect();
        if let Some(likeliest) = fits.first().map(|fit| fit.pose) {
            fits.retain(|fit| fit.pose == likeliest || fit.rank() >= first - margin);
        }
        // What could slide along a corridor or a wall may be anywhere on it; beside several places that hold it where it fits there
        // as well.
        let worth = fits.iter().map(Fit::worth).fold(-1.0, f64::max);
        let slides = |place: &Isometry2<f64>| {
            self.fit_at(sensor, ranges, *place, loosely()).worth() >= worth - margin
        };
        if !loose.is_empty() && (fits.len() <= 1 || loose.iter().any(slides)) {
            let held = fits.into_iter().map(|fit| fit.pose);
            return self.among_many(sensor, ranges, held.chain(loose));
        }
        match &fits[..] {
            [] => Answer::Unknown(Unknown::Nowhere),
            [best, ..] if !self.explains(best) => Answer::Unknown(Unknown::Nowhere),
            [only] if only.worth() < SURE => Answer::Unknown(Unknown::Unsure),
            [_] => Answer::Unique(fits.swap_remove(0)),
            _ => Answer::Ambiguous(fits),
        }
    }

    /// What fits at more places than are looked through, or all along a corridor: some of these, the best first.
    fn among_many(
        &self,
        sensor: &Sensor,
        ranges: &[f64],
        places: impl IntoIterator<Item = Isometry2<f64>>,
    ) -> Answer {
        let some = thinned(&self.returns(sensor, ranges), SEARCHED);
        let mut fits: Vec<Fit> = Vec::new();
        for place in places {
            let fit = self
                .fit(sensor, ranges, &some, place, WIDE)
                .unwrap_or_else(|| self.fit_at(sensor, ranges, place, loosely()));
            let is_known = fits.iter().any(|known| is_near(&known.pose, &fit.pose, APART));
            if self.explains(&fit) && !is_known {
                fits.push(fit);
            }
            if fits.len() == SOME {
                break;
            }
        }
        fits.sort_by(|a, b| b.rank().total_cmp(&a.rank()));
        let why = if fits.is_empty() { Unknown::Nowhere } else { Unknown::TooMany(fits) };
        Answer::Unknown(why)
    }

    /// Whether a place explains enough to be one.
    fn explains(&self, fit: &Fit) -> bool {
        let Options { least, margin, .. } = self.options;
        fit.explained >= least && fit.worth() >= least - margin
    }

    /// Some of the returns, each with the course of the line that it is seen to lie on, if on any.
    pub(crate) fn marks(
        &self,
        sensor: &Sensor,
        ranges: &[f64],
        returns: &[Vector2<f64>],
    ) -> Vec<Mark> {
        let mut extractor = Extractor::new();
        let segments: Vec<_> = extractor.segments(sensor, ranges).iter().collect();
        let long = || segments.iter().filter(|segment| segment.length() >= LEAST_LINE);
        let mark = |at: Vector2<f64>| {
            let on = long().find(|segment| {
                let v = segment.vector();
                let share = (at - segment.start).dot(&v) / v.norm_squared();
                (0.0..=1.0).contains(&share)
                    && (v.perp(&(at - segment.start)) / v.norm()).abs() <= 4.0
            });
            let course = on.map(|segment| Course::of(segment.vector()));
            Mark { at, course }
        };
        thinned(returns, SEARCHED).into_iter().map(mark).collect()
    }

    /// How a scan fits when it was taken near a pose; none where it holds none there.
    #[must_use]
    pub fn near(&self, sensor: &Sensor, ranges: &[f64], pose: Isometry2<f64>) -> Option<Fit> {
        self.fit(sensor, ranges, &self.returns(sensor, ranges), pose, WIDE)
    }

    /// The same where the pose is known so well that only what ends close to what the chart has is of that. A thing whose
    /// face stands a hand before the one that is drawn pulls the pose no more; where the robot is quite elsewhere, what is
    /// farther off tells so by much.
    #[must_use]
    pub fn close_to(&self, sensor: &Sensor, ranges: &[f64], pose: Isometry2<f64>) -> Option<Fit> {
        let returns = self.returns(sensor, ranges);
        let [close, wide] =
            [CLOSE, WIDE].map(|gate| self.fit(sensor, ranges, &returns, pose, gate));
        match (close, wide) {
            (Some(close), Some(wide)) if wide.rank() > close.rank() + self.options.margin => {
                Some(wide)
            }
            (close, wide) => close.or(wide),
        }
    }

    fn fit(
        &self,
        sensor: &Sensor,
        ranges: &[f64],
        returns: &[Vector2<f64>],
        pose: Isometry2<f64>,
        gate: f64,
    ) -> Option<Fit> {
        let refined = refine(self.chart, returns, self.options.sigma, pose, gate)?;
        Some(self.fit_at(sensor, ranges, refined.pose, refined.covariance))
    }

    /// How a scan fits a pose, as it is.
    pub(crate) fn fit_at(
        &self,
        sensor: &Sensor,
        ranges: &[f64],
        pose: Isometry2<f64>,
        covariance: Matrix3<f64>,
    ) -> Fit {
        self.sums(sensor, ranges, &pose).fit(pose, covariance)
    }

    /// What the scan says for a pose.
    fn sums(&self, sensor: &Sensor, ranges: &[f64], pose: &Isometry2<f64>) -> Sums {
        let every = (sensor.count() / VERIFIED).max(1);
        let mut sums = Sums::default();
        for (range, direction) in ranges.iter().zip(sensor.directions()).step_by(every) {
            if sensor.returned(*range) && *range <= self.options.farthest {
                self.weigh(&mut sums, pose, direction * *range);
            }
        }
        sums
    }

    /// Adds what a return says for a pose.
    pub(crate) fn weigh(&self, sums: &mut Sums, pose: &Isometry2<f64>, at: Vector2<f64>) {
        let range = at.norm();
        let slack = slack(range);
        let (expected, _) = self.chart.cast(pose, at.y.atan2(at.x), range + 4.0 * slack);
        let end = pose * nalgebra::Point2::from(at);
        let nearest =
            self.chart.nearest(end).map_or(f64::INFINITY, |(_, foot)| (foot - end).norm());
        let ahead = expected - range;
        // Past a corner by a hair is not through it.
        let off = if ahead < -slack { nearest } else { ahead.abs() };
        let is_through = ahead < -slack && off > slack;
        sums.through += f64::from(u8::from(is_through));
        sums.count += 1.0;
        let sigma = NEAR.1.mul_add(range, NEAR.0);
        let like = |off: f64| (-0.5 * (off / sigma).powi(2)).exp();
        if off <= slack {
            sums.explained += 1.0;
            sums.likeness += like(off);
        }
        // A wall that is grazed ends beams far before and behind of where it is met, and all of them near it.
        let hit = HIT * like(ahead.abs().min(nearest)) / (sigma * TAU.sqrt());
        let other = if is_through { STRAY } else { SHORT + STRAY };
        sums.evidence += hit.mul_add(self.options.farthest, other).ln();
    }

    /// The logarithm of a return's likelihood for a pose, over that of a range that may be any.
    pub(crate) fn evidence(&self, pose: &Isometry2<f64>, at: Vector2<f64>) -> f64 {
        let range = at.norm();
        let reach = self.options.farthest + 4.0 * slack(range);
        let (expected, line) = self.chart.cast(pose, at.y.atan2(at.x), reach);
        if line.is_none() {
            return 0.0;
        }
        let sigma = WALLS.1.mul_add(expected, WALLS.0);
        let deviations = (range - expected) / sigma;
        let hit = (-0.5 * deviations * deviations).exp() / (sigma * TAU.sqrt());
        let short = if range < expected { 1.0 / expected } else { 0.0 };
        (HIT * hit + SHORT * short).mul_add(self.options.farthest, STRAY).ln()
    }

    /// Where the beams end, in the sensor's frame.
    pub(crate) fn returns(&self, sensor: &Sensor, ranges: &[f64]) -> Vec<Vector2<f64>> {
        let ends = ranges.iter().zip(sensor.directions());
        ends.filter(|(range, _)| sensor.returned(**range) && **range <= self.options.farthest)
            .map(|(range, direction)| direction * *range)
            .collect()
    }
}

/// So many of them, evenly chosen along their course rather than by angle: a near wall takes many beams.
pub(crate) fn thinned(returns: &[Vector2<f64>], most: usize) -> Vec<Vector2<f64>> {
    let steps = returns.windows(2).map(|pair| (pair[1] - pair[0]).norm().min(30.0));
    let length: f64 = steps.sum();
    let every = (length / most as f64).max(2.0);
    let mut kept: Vec<Vector2<f64>> = Vec::new();
    let mut since = every;
    for (number, p) in returns.iter().enumerate() {
        if number > 0 {
            since += (p - returns[number - 1]).norm().min(30.0);
        }
        if since >= every {
            kept.push(*p);
            since = 0.0;
        }
    }
    kept
}
