//! Where the scans of a way were taken, held against the chart together (SPEC L3).
//!
//! What one scan leaves open, several along a way decide: what each sees must fit, and odometry holds them together. How well a
//! place fits is told by the likelihood of all beams, as Monte-Carlo localisation has it (S. Thrun, W. Burgard, D. Fox,
//! 2005, section 6.3): what ends short of a wall may be a thing that the chart lacks, what goes through one hardly anything.
//! A plan without furniture, whose walls stand off by a hand, leaves the right place the likeliest that way, where the share
//! of what it explains does not.

use nalgebra::{Isometry2, Matrix3, Vector2};

use super::locate::{
    APART, Answer, Fit, LEAST_RETURNS, Localiser, Sums, Unknown, loosely, thinned,
};
use super::refine::{WIDE, refine};
use super::search::{Mark, is_near};
use crate::vectors::scan::Sensor;

/// A scan, made ready to be held against the chart from many places.
#[derive(Debug, Clone)]
pub(crate) struct Look {
    /// Where odometry had it.
    pub(crate) at: Isometry2<f64>,
    marks: Vec<Mark>,
    returns: Vec<Vector2<f64>>,
}

/// Returns of a look that are weighed, and for a first judgement.
const WEIGHED: usize = 40;
const FIRST: usize = 12;
/// Returns of all looks that are searched by.
const SEARCHED: usize = 150;
/// Share of them that must lie on lines, and how much less than the best another place may have: a plan lacks furniture.
const LEAST: f64 = 0.3;
const WORSE: f64 = 0.25;
const MOST_PLACES: usize = 400;
/// By so much the likelihood of the one place must exceed all others', as a logarithm over [`WEIGHED`] beams of each look. On the
/// plan of Freiburg 79 a wrong place led the right one by up to 27 over 5 m (24 starts).
const LEADS: f64 = 40.0;
/// Before places are made exact.
const LEADS_ROUGHLY: f64 = 120.0;
/// Share of the beams that the one place must explain: the robot may be where the chart shows nothing, and the best of what it shows
/// is not less likely than others for that.
const SURE: f64 = 0.5;

impl Localiser<'_> {
    /// None where too little returned.
    pub(crate) fn look(&self, sensor: &Sensor, ranges: &[f64], at: Isometry2<f64>) -> Option<Look> {
        let returns = self.returns(sensor, ranges);
        let marks = self.marks(sensor, ranges, &returns);
        (returns.len() >= LEAST_RETURNS).then_some(Look { at, marks, returns })
    }

    /// Where the last of some looks was taken.
    pub(crate) fn along(&self, looks: &[Look]) -> Answer {
        let Some(last) = looks.last() else { return Answer::Unknown(Unknown::TooLittle) };
        let from: Vec<Isometry2<f64>> = looks.iter().map(|l| last.at.inv_mul(&l.at)).collect();
        let all = || from.iter().zip(looks);
        let count: usize = looks.iter().map(|look| look.marks.len()).sum();
        let every = count.div_ceil(SEARCHED).max(1);
        let marks: Vec<Mark> = all()
            .flat_map(|(by, look)| look.marks.iter().map(|mark| mark.moved(by)))
            .step_by(every)
            .collect();
        let found = self.pyramid().search(&marks, LEAST, |_| WORSE, APART, MOST_PLACES);
        let weighed: Vec<Vec<Vector2<f64>>> =
            looks.iter().map(|look| thinned(&look.returns, WEIGHED)).collect();
        let whole: usize = weighed.iter().map(Vec::len).sum();
        // Beams of one look are no independent witnesses: each look counts as much as another.
        let scale = (WEIGHED * looks.len()) as f64;
        let evidence = |pose: &Isometry2<f64>, every: usize| {
            let (mut sum, mut count) = (0.0, 0.0);
            for (by, beams) in from.iter().zip(&weighed) {
                let pose = pose * by;
                for beam in beams.iter().step_by(every) {
                    sum += self.evidence(&pose, *beam);
                    count += 1.0;
                }
            }
            sum / f64::max(count, 1.0) * scale
        };
        let fit = |pose: Isometry2<f64>, covariance: Matrix3<f64>| {
            let mut sums = Sums::default();
            for (by, beams) in from.iter().zip(&weighed) {
                let pose = pose * by;
                beams.iter().for_each(|beam| self.weigh(&mut sums, &pose, *beam));
            }
            sums.fit(pose, covariance)
        };
        let judged = |pose: Isometry2<f64>| (evidence(&pose, WEIGHED / FIRST), pose);
        let rough: Vec<(f64, Isometry2<f64>)> = found.places.into_iter().map(judged).collect();
        let best = rough.iter().map(|(evidence, _)| *evidence).fold(f64::NEG_INFINITY, f64::max);
        let every = (whole / SEARCHED).max(1);
        let held: Vec<Vector2<f64>> = from
            .iter()
            .zip(&weighed)
            .flat_map(|(by, beams)| {
                beams.iter().map(move |beam| (by * nalgebra::Point2::from(*beam)).coords)
            })
            .step_by(every)
            .collect();
        let mut fits: Vec<(f64, Fit)> = Vec::new();
        let mut is_loose = false;
        let exactly = |pose| {
            refine(self.chart(), &held, self.options().sigma, pose, WIDE)
                .filter(|exact| is_near(&exact.pose, &pose, APART))
        };
        let (likely, others): (Vec<_>, Vec<_>) =
            rough.into_iter().partition(|(evidence, _)| *evidence >= best - LEADS_ROUGHLY);
        for (_, pose) in likely {
            let exact = exactly(pose);
            is_loose |= exact.is_none();
            let (pose, covariance) = exact.map_or((pose, loosely()), |e| (e.pose, e.covariance));
            let (evidence, fit) = (evidence(&pose, 1), fit(pose, covariance));
            match fits.iter_mut().find(|(_, known)| is_near(&known.pose, &pose, APART)) {
                Some(known) if known.0 < evidence => *known = (evidence, fit),
                Some(_) => {}
                None => fits.push((evidence, fit)),
            }
        }
        fits.sort_by(|a, b| b.0.total_cmp(&a.0));
        let Some(best) = fits.first().map(|(evidence, _)| *evidence) else {
            return Answer::Unknown(Unknown::Nowhere);
        };
        // What the chart has and is not there any more bars the right place from all looks that went through it, so that another is
        // the likelier by far: then that explains less.
        let worth = fits[0].1.worth();
        fits.retain(|(evidence, fit)| *evidence >= best - LEADS || fit.worth() > worth);
        let mut fits: Vec<Fit> = fits.into_iter().map(|(_, fit)| fit).collect();
        if fits.len() == 1 {
            let better = |(_, pose): (f64, Isometry2<f64>)| {
                let near = fit(pose, loosely()).worth() > worth - self.options().margin;
                let exact = exactly(pose).filter(|_| near)?;
                Some(fit(exact.pose, exact.covariance)).filter(|fit| fit.worth() > worth)
            };
            fits.extend(others.into_iter().filter_map(better));
        }
        match &fits[..] {
            _ if !found.is_all => Answer::Unknown(Unknown::TooMany(fits)),
            [only] if only.explained < SURE => Answer::Unknown(Unknown::Unsure),
            [_] if is_loose => Answer::Unknown(Unknown::TooMany(fits)),
            [_] => Answer::Unique(fits.swap_remove(0)),
            _ => Answer::Ambiguous(fits),
        }
    }
}
