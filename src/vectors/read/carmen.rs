//! CARMEN logs: `FLASER n r1 … rn x y theta odom_x odom_y odom_theta time host time`, metres and radians.
//!
//! The older lines tell no angles: where no parameter gives the resolution, the field is half a turn, to which an odd
//! number of beams includes both borders (361 beams are 0.5° apart, as 360 are); a number of beams that would be no
//! quarters of a degree apart then has another field (541 and 1081 mostly three quarters of a turn), which is not guessed.
//! `ROBOTLASER1` and `RAWLASER1` tell all of their sensor. Other messages are passed over; what is the end or the beginning
//! of a line that was cut is told.

use std::f64::consts::{FRAC_PI_2, PI};

use super::words::{Word, lines, words};
use super::{Book, LogFault, Scan, pose};
use crate::scan::Noise;

/// Farthest range where no parameter tells it, in m.
const FARTHEST: f64 = 50.0;
/// The messages that are read.
const SCANS: [&str; 3] = ["FLASER", "ROBOTLASER1", "RAWLASER1"];
/// Quarters of a degree in half a turn.
const QUARTERS: usize = 720;

/// Whether a line is of this format.
pub(crate) fn is_head(line: &str) -> bool {
    const HEADS: [&str; 8] = [
        "# message formats",
        "PARAM",
        "SYNC",
        "ODOM",
        "FLASER",
        "RLASER",
        "ROBOTLASER",
        "RAWLASER",
    ];
    let line = line.trim_start();
    HEADS.iter().any(|head| line.starts_with(head)) || line.starts_with("TRUEPOS")
}

/// What is left of a line that was cut before or after this word: a number or the end of one, or a piece of a message's name.
fn is_torn(head: &Word<'_>) -> bool {
    let is_end = |number: &str| number.ends_with(&head.text.to_ascii_lowercase());
    let exponent = head.text.strip_prefix(['e', 'E']).and_then(|rest| rest.parse::<i32>().ok());
    head.number().or(exponent.map(f64::from)).is_some()
        || ["nan", "inf", "infinity"].into_iter().any(is_end)
        || SCANS.iter().any(|name| name.starts_with(head.text) || name.ends_with(head.text))
}

pub(crate) fn read(text: &str, book: &mut Book) {
    let (mut farthest, mut resolution) = (FARTHEST, None);
    for (number, at, line) in lines(text) {
        let mut rest = words(line, at);
        let Some(head) = rest.next() else { continue };
        let read = match head.text {
            "PARAM" => {
                let (name, value) = (rest.next(), rest.next().and_then(|word| word.number()));
                match (name.map(|word| word.text), value) {
                    (Some("robot_front_laser_max"), Some(value)) if value > 0.0 => farthest = value,
                    (Some("laser_front_laser_resolution"), Some(value)) if value > 0.0 => {
                        resolution = Some(value.to_radians());
                    }
                    _ => {}
                }
                continue;
            }
            "FLASER" => {
                let all: Vec<Word<'_>> = rest.collect();
                front(&all, (at, line.len()), farthest, resolution, book)
            }
            "ROBOTLASER1" | "RAWLASER1" => {
                let all: Vec<Word<'_>> = rest.collect();
                whole(&all, (at, line.len()), head.text == "ROBOTLASER1", book)
            }
            _ if is_torn(&head) => {
                Err(LogFault::NoMessage { found: head.shown(), at: head.span() })
            }
            _ => continue,
        };
        match read {
            Ok(scan) => book.log.scans.push(Scan { line: number, ..scan }),
            Err(fault) => book.fault(fault),
        }
    }
}

type Place = (usize, usize);

/// Counts the beams and takes their ranges, and asks for `after` more words.
fn ranges(
    all: &[Word<'_>],
    place: Place,
    count_at: usize,
    after: usize,
) -> Result<Vec<f64>, LogFault> {
    let (at, length) = place;
    let cut = |needed: usize| LogFault::CutOff {
        found: all.len() + 1,
        needed,
        at: (at + length, 0).into(),
    };
    let word = all.get(count_at).ok_or_else(|| cut(count_at + 2))?;
    let count: usize = match word.text.parse() {
        Ok(count) if count <= 1 << 16 => count,
        _ => return Err(LogFault::Beams { found: word.shown(), at: word.span() }),
    };
    let needed = count_at + 1 + count + after;
    if all.len() < needed {
        return Err(cut(needed + 1));
    }
    all[count_at + 1..=count_at + count]
        .iter()
        .map(|word| {
            let metres = word
                .number()
                .ok_or_else(|| LogFault::NotNumber { found: word.shown(), at: word.span() })?;
            Ok(metres * 100.0)
        })
        .collect()
}

/// Sensors of more beams than nothing, or one that sees nothing.
fn sensor(
    first: f64,
    step: f64,
    count: usize,
    farthest: f64,
    place: Place,
    book: &mut Book,
) -> Result<usize, LogFault> {
    let reach = (1.0, (farthest * 100.0).min(100_000.0));
    book.sensor((first, step, count), reach, Noise::default(), place.into())
}

/// The times of a message, `time host time`: numbers, unless there are more ranges before them than were counted.
fn time(words: &[Word<'_>]) -> Result<Option<f64>, LogFault> {
    let number = |word: &Word<'_>| {
        word.number().ok_or_else(|| LogFault::NotNumber { found: word.shown(), at: word.span() })
    };
    let time = number(&words[0])?;
    number(&words[2])?;
    Ok(Some(time).filter(|time| time.is_finite()))
}

fn front(
    all: &[Word<'_>],
    place: Place,
    farthest: f64,
    resolution: Option<f64>,
    book: &mut Book,
) -> Result<Scan, LogFault> {
    let ranges = ranges(all, place, 0, 9)?;
    let count = ranges.len();
    let (first, step) = match resolution {
        Some(step) => (-0.5 * step * count.saturating_sub(1) as f64, step),
        None => {
            let steps = if count % 2 == 1 { count - 1 } else { count }.max(1);
            if !QUARTERS.is_multiple_of(steps) {
                return Err(LogFault::Field { count, at: place.into() });
            }
            (-FRAC_PI_2, PI / steps as f64)
        }
    };
    let rest = &all[count + 1..];
    let seen = pose([&rest[0], &rest[1], &rest[2]])?;
    let wheels = pose([&rest[3], &rest[4], &rest[5]])?;
    let time = time(&rest[6..])?;
    let sensor = sensor(first, step, count, farthest, place, book)?;
    Ok(Scan { sensor, ranges, pose: Some(seen), odometry: Some(wheels), time, line: 0 })
}

/// `type start field resolution farthest accuracy remission n r1 … rn m …`, then, of `ROBOTLASER1`, the poses of laser and
/// robot and five more numbers, then the times.
fn whole(all: &[Word<'_>], place: Place, posed: bool, book: &mut Book) -> Result<Scan, LogFault> {
    let ranges = ranges(all, place, 7, 1)?;
    let number = |word: &Word<'_>| {
        word.number().ok_or_else(|| LogFault::NotNumber { found: word.shown(), at: word.span() })
    };
    let (first, step, farthest) = (number(&all[1])?, number(&all[3])?, number(&all[4])?);
    let remissions = &all[8 + ranges.len()];
    let count: usize = remissions.text.parse().map_err(|_not_a_count| LogFault::NotNumber {
        found: remissions.shown(),
        at: remissions.span(),
    })?;
    let rest = all.get(9 + ranges.len()..).and_then(|rest| rest.get(count..)).unwrap_or_default();
    let needed = if posed { 14 } else { 3 };
    if rest.len() < needed {
        let needed = ranges.len().saturating_add(count).saturating_add(10 + needed);
        let at = (place.0 + place.1, 0).into();
        return Err(LogFault::CutOff { found: all.len() + 1, needed, at });
    }
    let sensor = sensor(first, step, ranges.len(), farthest, place, book)?;
    if !posed {
        let time = time(rest)?;
        return Ok(Scan { sensor, ranges, pose: None, odometry: None, time, line: 0 });
    }
    let (seen, robot) =
        (pose([&rest[0], &rest[1], &rest[2]])?, pose([&rest[3], &rest[4], &rest[5]])?);
    let time = time(&rest[11..])?;
    Ok(Scan { sensor, ranges, pose: Some(seen), odometry: Some(robot), time, line: 0 })
}
