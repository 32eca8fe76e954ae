//! Ends of fitted lines, and the segments between them, with their covariance.

use nalgebra::{Matrix2, Vector2};

use crate::line::Line;
use crate::segment::{Covariance, End, Segment};

/// One end of a line on its way to be the end of a segment: its errors are `lever` times the line's error across itself
/// at `place`, and what has covariance `own` besides.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Tip {
    pub(crate) end: End,
    pub(crate) point: Vector2<f64>,
    pub(crate) place: f64,
    pub(crate) lever: Vector2<f64>,
    pub(crate) own: Matrix2<f64>,
}

impl Tip {
    /// Its covariance, as an end of the line.
    fn covariance(&self, line: &Line) -> Matrix2<f64> {
        self.own + self.lever * self.lever.transpose() * line.across(self.place, self.place)
    }

    /// Variance of its place along the line, in cm².
    pub(crate) fn along(&self, line: &Line) -> f64 {
        line.direction.dot(&(self.covariance(line) * line.direction))
    }
}

/// The segment of a line between two of its ends.
pub(crate) fn tip_segment(line: &Line, start: &Tip, end: &Tip) -> Segment<2> {
    let cross = start.lever * end.lever.transpose() * line.across(start.place, end.place);
    let covariance = Covariance { start: start.covariance(line), end: end.covariance(line), cross };
    Segment { start: start.point, end: end.point, ends: [start.end, end.end], covariance }
}

/// Where two lines meet.
pub(crate) struct Meeting {
    pub(crate) point: Vector2<f64>,
    /// Places on the one and on the other.
    pub(crate) places: [f64; 2],
    /// How far the point moves for an error of one cm across the one, and across the other. N x = d with N of both
    /// normals: an error of the first line moves the corner along the second, and conversely.
    slides: [Vector2<f64>; 2],
}

impl Meeting {
    /// None of lines whose angle has a sine less than `least`.
    pub(crate) fn of(one: &Line, two: &Line, least: f64) -> Option<Self> {
        let sine = one.direction.perp(&two.direction);
        if sine.abs() < least {
            return None;
        }
        let apart = two.centre - one.centre;
        let place = apart.perp(&two.direction) / sine;
        let places = [place, apart.perp(&one.direction) / sine];
        let slides = [-two.direction / sine, one.direction / sine];
        Some(Self { point: one.at(place), places, slides })
    }

    /// As the end of the one and the start of the other.
    pub(crate) fn tips(&self, one: &Line, two: &Line, end: End) -> (Tip, Tip) {
        let (point, [place, other], [slide, across]) = (self.point, self.places, self.slides);
        let own = |line: &Line, place: f64, slide: Vector2<f64>| {
            slide * slide.transpose() * line.across(place, place)
        };
        (
            Tip { end, point, place, lever: slide, own: own(two, other, across) },
            Tip { end, point, place: other, lever: across, own: own(one, place, slide) },
        )
    }
}
