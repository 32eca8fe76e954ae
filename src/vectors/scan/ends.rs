//! Where a run of points ends, and why (SPEC V2): corners, free ends, and ends at which only the view ends.
//!
//! ```text
//!        behind ····x                 x: the beam beside the run's last point, and where it went
//!    ______     ···/                  beyond the line  → the face ends here: free
//!   /      \===o  /                   short of it      → something hides the rest: occluded
//! run      the ends                   no return        → nobody knows: out of range
//! ```

use nalgebra::Vector2;

use super::run::{Hit, Run};
use super::sensor::Sensor;
use crate::line::{Line, ROUGHNESS};
use crate::segment::{Cut, End, Segment, Truth};
use crate::tip::{Meeting, Tip, tip_segment};

/// Sine of the least angle between two faces that make a corner.
const FLAT: f64 = 0.12;
/// Deviations that tell "beyond the line" and "short of it" from "on it".
const CLEAR: f64 = 4.0;

/// The segments of the runs, in their order.
pub(crate) fn segments(
    sensor: &Sensor,
    ranges: &[f64],
    hits: &[Hit],
    runs: &[Run],
    into: &mut Vec<Segment<2>>,
) {
    let closing = match (runs.first(), runs.last()) {
        (Some(first), Some(last)) if sensor.is_closed() && runs.len() > 2 => {
            corner(sensor, ranges, hits, last, first)
        }
        _ => None,
    };
    let count = runs.len();
    // After each run; after the last one that before the first.
    let mut corners: Vec<Option<(Tip, Tip)>> =
        runs.windows(2).map(|pair| corner(sensor, ranges, hits, &pair[0], &pair[1])).collect();
    corners.resize(count, closing);
    for (index, run) in runs.iter().enumerate() {
        let before = (index + count - 1) % count;
        if let (Some((_, start)), Some((end, _))) = (&corners[before], &corners[index]) {
            // A face no longer than its corners err is none, and they are no corners.
            let extent = end.place - start.place;
            let error = CLEAR * (start.along(&run.line) + end.along(&run.line)).sqrt();
            if extent <= error {
                (corners[before], corners[index]) = (None, None);
            }
        }
    }
    for (index, run) in runs.iter().enumerate() {
        let start = corners[(index + count - 1) % count].map(|(_, second)| second);
        let end = corners[index].map(|(first, _)| first);
        let start = start.unwrap_or_else(|| tip(sensor, ranges, hits, run, false));
        let end = end.unwrap_or_else(|| tip(sensor, ranges, hits, run, true));
        into.push(tip_segment(&run.line, &start, &end));
    }
}

/// Where two runs that follow each other meet, as the end of the first and the start of the second.
fn corner(sensor: &Sensor, ranges: &[f64], hits: &[Hit], a: &Run, b: &Run) -> Option<(Tip, Tip)> {
    let (last, first) = (&hits[a.to - 1], &hits[b.from]);
    if sensor.steps(last.beam, first.beam) > 2 {
        return None;
    }
    let count = sensor.count() as u32;
    let (one, two) = (&a.line, &b.line);
    let meeting = Meeting::of(one, two, FLAT)?;
    let (point, [place, second_place]) = (meeting.point, meeting.places);
    // Between the beams beside the border, one beam of tolerance on each side.
    let low = sensor.directions[((last.beam + count - 1) % count) as usize];
    let high = sensor.directions[((first.beam + 1) % count) as usize];
    let open = !sensor.is_closed();
    let inner = (open && last.beam == 0) || low.perp(&point) >= 0.0;
    let outer = (open && first.beam + 1 == count) || point.perp(&high) >= 0.0;
    // Where lines meet at a small angle, noise moves their meeting along both.
    let sine = one.direction.perp(&two.direction).abs();
    let room = CLEAR * one.expected.max(two.expected).sqrt() / sine + (first.p - last.p).norm();
    let near = sine < 0.5
        && (place - one.place(last.p)).abs() < room
        && (second_place - two.place(first.p)).abs() < room;
    let ahead = point.dot(&(last.p + first.p)) > 0.0;
    let order = place > one.place(hits[a.from].p) && second_place < two.place(hits[b.to - 1].p);
    if !((inner && outer || near) && ahead && order) {
        return None;
    }
    let covers = |line: &Line, from: u32, forth: bool| {
        let (step, side) = if forth { (1, 1.0) } else { (count - 1, -1.0) };
        let beams = (1..count).map(|k| ((from + k * step) % count) as usize);
        beams
            .take_while(|beam| side * sensor.directions[*beam].perp(&point) > 0.0)
            .filter_map(|beam| ranges.get(beam).map(|range| (beam, *range)))
            .filter(|(_, range)| sensor.returned(*range))
            .all(|(beam, range)| line.admits(sensor.directions[beam] * range, CLEAR))
    };
    if !(covers(one, last.beam, true) && covers(two, first.beam, false)) {
        return None;
    }
    let end = if bends(one, two) { End::True(Truth::Corner) } else { End::Cut(Cut::Unclear) };
    Some(meeting.tips(one, two, end))
}

/// Whether two lines that meet are two faces, and not one told twice. Two points make a line, but not a face: where it
/// meets another is a vertex of the contour and no more.
pub(super) fn bends(one: &Line, two: &Line) -> bool {
    let sine = one.direction.perp(&two.direction);
    let noise = CLEAR * CLEAR * (one.turning() + two.turning());
    one.count > 2.0 && two.count > 2.0 && sine * sine > noise
}

/// The end of a run that meets no other: of its last point, or of its first.
pub(super) fn tip(sensor: &Sensor, ranges: &[f64], hits: &[Hit], run: &Run, after: bool) -> Tip {
    let line = &run.line;
    let (hit, beside_it) = if after {
        (&hits[run.to - 1], &hits[run.to - 2])
    } else {
        (&hits[run.from], &hits[run.from + 1])
    };
    let beam = hit.beam as usize;
    let count = sensor.count().min(ranges.len());
    let place = likeliest(sensor, line, hit);
    let u = sensor.directions[beam];
    let (forth, side) = (u.dot(&line.direction), u.perp(&line.direction));
    let bearing = sensor.noise.bearing * hit.r;
    let mut along = sensor.noise.along(hit.r) * forth * forth + bearing * bearing * side * side;
    // Nothing was seen farther than half a beam beside the last one.
    let half = if after { 0.5 * sensor.step } else { -0.5 * sensor.step };
    let border = Vector2::new(u.x - u.y * half, u.x * half + u.y);
    let farthest = line.range(border);
    // Along a line that is seen nearly end on, the breadth of a beam is as long as one likes: no end is moved by more than
    // what lies between the last two hits.
    let room = (line.place(hit.p) - line.place(beside_it.p)).abs();
    let limit = line.place(border * farthest);
    let place = match limit {
        _ if farthest <= 0.0 || (limit - place).abs() > room => place,
        _ if after => place.min(limit),
        _ => place.max(limit),
    };
    let mut place_of_end = place;
    let beside = |steps: usize| match (after, sensor.is_closed() && count == sensor.count()) {
        (true, true) => Some((beam + steps) % count),
        (false, true) => Some((beam + count - steps) % count),
        (true, false) => Some(beam + steps).filter(|beam| *beam < count),
        (false, false) => beam.checked_sub(steps),
    };
    // One beam farther than the line is a spike; two are a view past it.
    let back = |beam: usize| {
        let (found, on_line) = (ranges[beam], line.range(sensor.directions[beam]));
        (found - on_line).abs() < CLEAR * sensor.noise.along(found).sqrt()
    };
    let end = match beside(1) {
        None => End::Cut(Cut::Field),
        // A single lost return says nothing: the next one is asked.
        Some(next) => {
            let next = if sensor.returned(ranges[next]) { Some(next) } else { beside(2) };
            match next.filter(|next| sensor.returned(ranges[*next])) {
                None => End::Cut(Cut::Range),
                Some(next) => {
                    let (found, on_line) = (ranges[next], line.range(sensor.directions[next]));
                    let noise = CLEAR * sensor.noise.along(found).sqrt();
                    let reach = line.place(sensor.directions[next] * on_line);
                    let gap = if after { reach - place } else { place - reach };
                    let between = (u + sensor.directions[next]).normalize();
                    let midway = line.place(between * line.range(between));
                    let (next_beam, gone) = (next as u32, sensor.directions[next] * found);
                    let beams = if after {
                        sensor.steps(hit.beam, next_beam)
                    } else {
                        sensor.steps(next_beam, hit.beam)
                    };
                    let face = sensor.oblique[beams.min(2) as usize] * hit.r.min(found)
                        + 3.0 * sensor.noise.along(found).sqrt();
                    // What goes on without a jump is no end of it and hides none.
                    if (gone - hit.p).norm_squared() <= face * face {
                        End::Cut(Cut::Unclear)
                    } else if found < hit.r.min(if on_line > 0.0 { on_line } else { hit.r }) - noise
                    {
                        End::Cut(Cut::Occluded)
                    } else if on_line > 0.0
                        && gap > 0.0
                        && found > on_line + noise
                        && !beside(2).is_some_and(back)
                    {
                        // The face ends somewhere between two beams.
                        place_of_end = midway.clamp(place - room, place + room);
                        along += gap * gap / 12.0 + (place_of_end - 0.5 * (place + reach)).powi(2);
                        End::True(Truth::Free)
                    } else {
                        End::Cut(Cut::Unclear)
                    }
                }
            }
        }
    };
    let t = line.direction;
    let own = t * t.transpose() * along;
    Tip { end, point: line.at(place_of_end), place: place_of_end, lever: line.normal(), own }
}

/// Where on the line a hit most likely was: along its beam it errs more than across it.
fn likeliest(sensor: &Sensor, line: &Line, hit: &Hit) -> f64 {
    let u = sensor.directions[hit.beam as usize];
    let (n, t) = (line.normal(), line.direction);
    let bearing = sensor.noise.bearing * hit.r;
    let (along, across) = (sensor.noise.along(hit.r), bearing * bearing);
    // C n of the hit's covariance C = along·u uᵀ + across·(1 − u uᵀ) + roughness, over nᵀ C n.
    let (un, ut) = (u.dot(&n), u.dot(&t));
    let own = (along - across) * un * un + across + ROUGHNESS * ROUGHNESS;
    let slide = (along - across) * un * ut / own;
    line.place(hit.p) - slide * n.dot(&(hit.p - line.centre))
}
