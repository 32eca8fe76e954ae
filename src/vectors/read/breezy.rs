//! The logs of BreezySLAM's examples: rows of numbers, the first 24 of them time (µs), wheels and what the robot tells
//! of itself, then one range a beam in mm over 240° (Hokuyo URG-04LX). Ranges below 20 mm are the sensor's error codes.

use std::collections::HashMap;

use super::words::{Word, lines, words};
use super::{Book, LogFault, Scan};
use crate::scan::Noise;

/// Numbers before the ranges.
const BEFORE: usize = 24;
/// Field of view, in degrees, and reach, in cm.
const FIELD: f64 = 240.0;
const REACH: (f64, f64) = (2.0, 560.0);
/// 1 cm to a metre, 1 % beyond: the data sheet's accuracy, taken as two deviations.
const NOISE: Noise = Noise { range: 0.5, share: 0.005, bearing: 0.002 };

/// Whether a line is of this format.
pub(crate) fn is_row(line: &str) -> bool {
    let all = words(line, 0);
    all.clone().count() > BEFORE && all.clone().all(|word| word.number().is_some())
}

pub(crate) fn read(text: &str, book: &mut Book) {
    let needed = usual(text);
    for (number, at, line) in lines(text) {
        let all: Vec<Word<'_>> = words(line, at).collect();
        if all.is_empty() {
            continue;
        }
        match row(&all, needed, (at, line.len()), book) {
            Ok(scan) => book.log.scans.push(Scan { line: number, ..scan }),
            Err(fault) => book.fault(fault),
        }
    }
}

/// Words of most rows: the first may be the end of one. Of two as frequent the greater.
fn usual(text: &str) -> usize {
    let mut rows: HashMap<usize, usize> = HashMap::new();
    for (_, at, line) in lines(text) {
        *rows.entry(words(line, at).count()).or_default() += 1;
    }
    rows.remove(&0);
    rows.into_iter().map(|(words, rows)| (rows, words)).max().map_or(0, |(_, words)| words)
}

fn row(
    all: &[Word<'_>],
    needed: usize,
    (at, length): (usize, usize),
    book: &mut Book,
) -> Result<Scan, LogFault> {
    let number = |word: &Word<'_>| {
        word.number().ok_or_else(|| LogFault::NotNumber { found: word.shown(), at: word.span() })
    };
    if all.len() < needed || all.len() <= BEFORE {
        let needed = needed.max(BEFORE + 1);
        return Err(LogFault::CutOff { found: all.len(), needed, at: (at + length, 0).into() });
    }
    if all.len() > needed {
        return Err(LogFault::TooLong { found: all.len(), needed, at: all[needed].span() });
    }
    let time = number(&all[0])? / 1e6;
    let ranges = all[BEFORE..]
        .iter()
        .map(|word| number(word).map(|millimetres| millimetres * 0.1))
        .collect::<Result<Vec<f64>, _>>()?;
    let step = FIELD / (ranges.len() - 1).max(1) as f64;
    let first = (-0.5 * FIELD).to_radians();
    let beams = (first, step.to_radians(), ranges.len());
    let sensor = book.sensor(beams, REACH, NOISE, (at, length).into())?;
    let time = Some(time).filter(|time| time.is_finite());
    Ok(Scan { sensor, ranges, pose: None, odometry: None, time, line: 0 })
}
