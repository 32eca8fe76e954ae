//! Where a thing stands that is not where it is mapped: its outline laid over what is seen and not mapped.

use std::collections::HashMap;

use nalgebra::{Isometry2, Point2, Vector2};

use super::unmapped::Cells;
use super::{Taken, slack};
use crate::chart::{Chart, Line};
use crate::geometry::{Polygon, convex_hull};
use crate::units::{Deg, Frame, Point};

/// A thing is looked for no farther than this from where it is mapped, in cm.
const REACH: f64 = 600.0;
/// Turns that are tried, in degrees.
const TURN: usize = 10;
/// A point this near the outline lies on it, in cm.
const ON: f64 = 6.0;
/// Share of the beams to the outline that must end at it.
const LEAST: f64 = 0.75;
/// Beams that must.
const FEWEST: usize = 6;
/// Two places nearer than this are one, in cm.
const ONE_PLACE: f64 = 20.0;
/// How much more another place may explain and leave this one the only one.
const AHEAD: f64 = 0.8;

pub(super) struct Found {
    pub(super) frame: Frame,
    pub(super) sure: f64,
}

/// The frame at which an outline, given in the thing's own frame, fits; none where none does, or several do.
pub(super) fn place(
    outline: &[Line],
    mapped: &Frame,
    cells: &Cells,
    taken: &[Taken],
    chart: &Chart,
) -> Option<Found> {
    let points: Vec<Point2<f64>> =
        cells.points().into_iter().filter(|p| (p - mapped.origin()).norm() <= REACH).collect();
    if outline.is_empty() || points.len() < 3 {
        return None;
    }
    let places = candidates(outline, mapped, &points);
    let mut tried: Vec<(f64, Frame, f64)> = places
        .into_iter()
        .map(|frame| aligned(outline, &points, frame))
        .filter_map(|frame| {
            if explained(outline, &points, &frame) < LEAST {
                return None;
            }
            let (struck, through) = beams(outline, &frame, taken, chart);
            let share = struck as f64 / (struck + through).max(1) as f64;
            let worth = struck as f64 * share;
            (struck >= FEWEST && share >= LEAST).then_some((worth, frame, share))
        })
        .collect();
    tried.sort_by(|a, b| b.0.total_cmp(&a.0));
    let &(worth, best, share) = tried.first()?;
    // The same outline may be had by several frames; of those the least turned is meant.
    let centre = |frame: &Frame| {
        let sum: Vector2<f64> = outline.iter().map(|l| l.start.coords + l.end.coords).sum();
        frame.apply(Point::from(sum / (2.0 * outline.len() as f64)))
    };
    let is_elsewhere = |frame: &Frame| (centre(frame) - centre(&best)).norm() > ONE_PLACE;
    if tried.iter().any(|(other, frame, _)| *other >= AHEAD * worth && is_elsewhere(frame)) {
        return None;
    }
    let turned = |frame: &Frame| (frame.angle - mapped.angle).signed().abs();
    let (_, frame, _) = tried
        .iter()
        .filter(|(other, ..)| *other >= 0.95 * worth)
        .min_by(|a, b| turned(&a.1).total_cmp(&turned(&b.1)))?;
    let sure = share * (1.0 - 0.5_f64.powf(worth / 6.0));
    Some(Found { frame: *frame, sure })
}

/// Frames by which most points lie on the outline.
fn candidates(outline: &[Line], mapped: &Frame, points: &[Point2<f64>]) -> Vec<Frame> {
    let samples: Vec<Point2<f64>> = outline
        .iter()
        .flat_map(|line| {
            let count = ((line.end - line.start).norm() / 8.0).ceil().max(1.0) as usize;
            (0..count)
                .map(move |n| line.start + (line.end - line.start) * (n as f64 / count as f64))
        })
        .collect();
    // Votes for the origin of the frame, by turn: each point may be each sample of the outline.
    let mut best: Vec<(usize, Frame)> = Vec::new();
    for turn in (0..360).step_by(TURN) {
        let angle = mapped.angle + Deg::of(turn as f64);
        let turned = Frame::new(0.0, 0.0, 0.0, angle);
        let mut votes: HashMap<(i32, i32), (usize, usize)> = HashMap::new();
        for (number, p) in points.iter().enumerate() {
            for sample in &samples {
                let at = (p - turned.apply(*sample)) / ON;
                let vote = votes.entry((at.x.round() as i32, at.y.round() as i32)).or_default();
                // Each point once.
                if vote.1 != number + 1 {
                    *vote = (vote.0 + 1, number + 1);
                }
            }
        }
        let mut votes: Vec<_> = votes.into_iter().map(|(at, (count, _))| (count, at)).collect();
        votes.sort_unstable_by(|a, b| b.cmp(a));
        for (count, (x, y)) in votes.into_iter().take(6) {
            let frame = Frame::new(f64::from(x) * ON, f64::from(y) * ON, mapped.z.get(), angle);
            best.push((count, frame));
        }
    }
    best.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
    let least = best.first().map_or(0, |(count, _)| count / 2);
    let fit = best.into_iter().take_while(|(count, _)| *count >= least.max(3));
    fit.take(60).map(|(_, frame)| frame).collect()
}

/// A frame made exact: points that lie near the outline, against it, by least squares.
fn aligned(outline: &[Line], points: &[Point2<f64>], start: Frame) -> Frame {
    let mut pose = Isometry2::new(start.origin().coords, start.angle.radians());
    for _ in 0..8 {
        let mut normal = nalgebra::Matrix3::identity() * 1e-3;
        let mut right = nalgebra::Vector3::zeros();
        for p in points {
            let own = pose.inverse_transform_point(p);
            let foot = outline
                .iter()
                .map(|line| line.nearest(own))
                .min_by(|a, b| (a - own).norm_squared().total_cmp(&(b - own).norm_squared()));
            let Some(foot) = foot.filter(|foot| (foot - own).norm() <= 2.0 * ON) else { continue };
            let off = pose.rotation * (own - foot);
            let length = off.norm();
            if length < 1e-6 {
                continue;
            }
            let n = off / length;
            let arm = p.coords - pose.translation.vector;
            let row = nalgebra::Vector3::new(n.x, n.y, n.y * arm.x - n.x * arm.y);
            normal += row * row.transpose();
            right += row * length;
        }
        let Some(by) = normal.try_inverse().map(|inverse| inverse * right) else { break };
        if by.xy().norm() > 20.0 || by.z.abs() > 0.3 {
            break;
        }
        pose = Isometry2::new(pose.translation.vector + by.xy(), pose.rotation.angle() + by.z);
    }
    let at = pose.translation.vector;
    Frame::new(at.x, at.y, start.z.get(), Deg::from_radians(pose.rotation.angle()))
}

/// Of what is seen where a thing would stand, the share that lies on its outline: between the legs of a chair nothing is seen.
fn explained(outline: &[Line], points: &[Point2<f64>], frame: &Frame) -> f64 {
    let hull = convex_hull(outline.iter().flat_map(|line| [line.start, line.end]).collect());
    let hull = Polygon::new(hull);
    let (mut on, mut off) = (0_usize, 0_usize);
    for p in points {
        let own = frame.invert(*p);
        let is_on = outline.iter().any(|line| (line.nearest(own) - own).norm() <= ON);
        if is_on {
            on += 1;
        } else if hull.contains(own, ON) {
            off += 1;
        }
    }
    on as f64 / (on + off).max(1) as f64
}

/// Of the beams that should meet a thing placed so, those that end at it and those that go through.
pub(super) fn beams(
    outline: &[Line],
    frame: &Frame,
    taken: &[Taken],
    chart: &Chart,
) -> (usize, usize) {
    let placed: Vec<Line> = outline
        .iter()
        .map(|line| Line { start: frame.apply(line.start), end: frame.apply(line.end), ..*line })
        .collect();
    let Some(first) = placed.first().map(|line| line.start) else { return (0, 0) };
    let radius = placed.iter().map(|line| (line.end - first).norm()).fold(0.0, f64::max);
    let own = Chart::new(placed);
    let (mut struck, mut through) = (0, 0);
    for scan in taken {
        let at = Point2::from(scan.pose.translation.vector);
        let reach = (first - at).norm() + radius;
        if reach - 2.0 * radius > scan.sensor.reach().1 {
            continue;
        }
        for (beam, &range) in scan.ranges.iter().enumerate().take(scan.sensor.count()) {
            if !scan.sensor.returned(range) {
                continue;
            }
            let bearing = scan.sensor.bearing(beam);
            let (distance, Some(_)) = own.cast(&scan.pose, bearing, reach) else { continue };
            let slack = slack(distance);
            if (range - distance).abs() <= slack {
                struck += 1;
            } else if range > distance && chart.cast(&scan.pose, bearing, distance).1.is_none() {
                through += 1;
            }
        }
    }
    (struck, through)
}
