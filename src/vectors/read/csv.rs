//! Rows of ranges under a heading that names the columns, as tools that export `LaserScan` messages write them:
//! `angle_min`, `angle_increment`, `range_min`, `range_max`, `ranges0`, `ranges1`, …; also `ranges[0]`, `ranges_0`, a
//! leading `field.`, and, where they are there, `x`, `y`, `theta` and `time`. Metres and radians, cells between commas or
//! semicolons.

use super::words::{Word, cells, lines};
use super::{Book, LogFault, Scan, pose};
use crate::scan::{Noise, Sensor};

/// Where each column stands.
#[derive(Default)]
struct Heading {
    first: Option<usize>,
    step: Option<usize>,
    nearest: Option<usize>,
    farthest: Option<usize>,
    pose: [Option<usize>; 3],
    time: Option<usize>,
    ranges: Vec<usize>,
    width: usize,
}

pub(crate) fn read(text: &str, book: &mut Book) {
    let mut heading = None;
    for (number, at, line) in lines(text) {
        if line.trim().is_empty() || (heading.is_some() && line.starts_with('#')) {
            continue;
        }
        let all: Vec<Word<'_>> = cells(line, at).collect();
        let Some(columns) = &heading else {
            match head(&all, (at, line.len())) {
                Ok(columns) => heading = Some(columns),
                Err(faults) => {
                    faults.into_iter().for_each(|fault| book.fault(fault));
                    return;
                }
            }
            continue;
        };
        match row(columns, &all, (at, line.len()), book) {
            Ok(scan) => book.log.scans.push(Scan { line: number, ..scan }),
            Err(fault) => book.fault(fault),
        }
    }
}

fn head(all: &[Word<'_>], place: (usize, usize)) -> Result<Heading, Vec<LogFault>> {
    let mut heading = Heading { width: all.len(), ..Heading::default() };
    let mut ranges = Vec::new();
    for (column, word) in all.iter().enumerate() {
        let name = word.text.trim_start_matches(['#', '%', ' ']).to_ascii_lowercase();
        let name = name.strip_prefix("field.").unwrap_or(&name);
        match name {
            "angle_min" => heading.first = Some(column),
            "angle_increment" => heading.step = Some(column),
            "range_min" => heading.nearest = Some(column),
            "range_max" => heading.farthest = Some(column),
            "x" => heading.pose[0] = Some(column),
            "y" => heading.pose[1] = Some(column),
            "theta" => heading.pose[2] = Some(column),
            "time" => heading.time = Some(column),
            _ => {
                let beam = name
                    .strip_prefix("ranges")
                    .map(|rest| rest.trim_matches(['[', ']', '_', '.']))
                    .and_then(|rest| rest.parse::<usize>().ok());
                ranges.extend(beam.map(|beam| (beam, column)));
            }
        }
    }
    ranges.sort_unstable();
    heading.ranges = ranges.into_iter().map(|(_, column)| column).collect();
    let known = [
        ("angle_min", heading.first.is_some()),
        ("angle_increment", heading.step.is_some()),
        ("range_min", heading.nearest.is_some()),
        ("range_max", heading.farthest.is_some()),
        ("ranges0", !heading.ranges.is_empty()),
    ];
    let faults: Vec<LogFault> = known
        .into_iter()
        .filter(|(_, known)| !known)
        .map(|(column, _)| LogFault::NoColumn { column, at: place.into() })
        .collect();
    if faults.is_empty() { Ok(heading) } else { Err(faults) }
}

fn row(
    heading: &Heading,
    all: &[Word<'_>],
    (at, length): (usize, usize),
    book: &mut Book,
) -> Result<Scan, LogFault> {
    if all.len() < heading.width {
        let at = (at + length, 0).into();
        return Err(LogFault::CutOff { found: all.len(), needed: heading.width, at });
    }
    let number = |column: usize| {
        let word = &all[column];
        word.number().ok_or_else(|| LogFault::NotNumber { found: word.shown(), at: word.span() })
    };
    let asked = |column: Option<usize>| number(column.expect("the heading was asked for it"));
    let (first, step) = (asked(heading.first)?, asked(heading.step)?);
    let (nearest, farthest) = (asked(heading.nearest)? * 100.0, asked(heading.farthest)? * 100.0);
    let mut ranges = heading
        .ranges
        .iter()
        .map(|column| Ok(number(*column)? * 100.0))
        .collect::<Result<Vec<f64>, LogFault>>()?;
    // A sensor that turns clockwise is told the other way round.
    let (first, step) = if step < 0.0 {
        ranges.reverse();
        (step.mul_add(ranges.len().saturating_sub(1) as f64, first), -step)
    } else {
        (first, step)
    };
    let reach = (nearest, farthest.min(100_000.0));
    let sensor = Sensor::new(first, step, ranges.len(), reach, Noise::default())
        .map_err(|fault| LogFault::Sensor { fault, at: (at, length).into() })?;
    let seen = match heading.pose {
        [Some(x), Some(y), Some(heading)] => Some(pose([&all[x], &all[y], &all[heading]])?),
        _ => None,
    };
    let time = heading.time.map(number).transpose()?.filter(|time| time.is_finite());
    let sensor = book.log.sensor_like(sensor);
    Ok(Scan { sensor, ranges, pose: seen, odometry: None, time, line: 0 })
}
