//! Rows of ranges under a heading that names the columns, as tools that export `LaserScan` messages write them:
//! `angle_min`, `angle_increment`, `range_min`, `range_max`, `ranges0`, `ranges1`, …; also `ranges[0]`, `ranges_0`, a
//! leading `field.`, and, where they are there, `x`, `y`, `theta` and `time`.
//!
//! Metres, radians and seconds, or the unit that a column's name has in brackets. Cells stand between semicolons or
//! tabulators, where a comma may begin the fraction, or else between commas, as the heading has them. Lines with `#` before
//! the heading, and between the rows, are remarks.

use std::collections::BTreeMap;

use super::words::{Word, cells, lines};
use super::{Book, LogFault, Scan, place};
use crate::scan::Noise;

/// What a column tells, besides ranges.
const NAMES: [(&str, Of); 8] = [
    ("angle_min", Of::Angle),
    ("angle_increment", Of::Angle),
    ("range_min", Of::Length),
    ("range_max", Of::Length),
    ("x", Of::Length),
    ("y", Of::Length),
    ("theta", Of::Angle),
    ("time", Of::Time),
];
/// How many of the names a log must have.
const NEEDED: usize = 4;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Of {
    Angle,
    Length,
    Time,
}

impl Of {
    /// What a unit is in radians, centimetres or seconds.
    fn unit(self, name: &str) -> Option<f64> {
        Some(match (self, name) {
            (Self::Angle, "" | "rad" | "radian" | "radians") => 1.0,
            (Self::Angle, "deg" | "degree" | "degrees" | "°") => 1.0_f64.to_radians(),
            (Self::Length, "" | "m" | "metre" | "metres" | "meter" | "meters") => 100.0,
            (Self::Length, "cm") => 1.0,
            (Self::Length, "mm") => 0.1,
            (Self::Time, "" | "s" | "sec" | "second" | "seconds") => 1.0,
            (Self::Time, "ms") => 1e-3,
            (Self::Time, "us" | "µs") => 1e-6,
            (Self::Time, "ns") => 1e-9,
            _ => return None,
        })
    }
}

/// Where a column stands, and its unit.
type Column = (usize, f64);

/// The columns, those of [`NAMES`] in their order.
#[derive(Default)]
struct Heading {
    named: [Option<Column>; NAMES.len()],
    ranges: Vec<Column>,
    width: usize,
    separator: char,
}

/// Whether a line names columns of this format.
pub(crate) fn is_heading(line: &str) -> bool {
    line.to_ascii_lowercase().contains("angle_min")
}

/// Whether a line says nothing to a reader of columns.
pub(crate) fn is_remark(line: &str) -> bool {
    line.starts_with('#') && !is_heading(line)
}

pub(crate) fn read(text: &str, book: &mut Book) {
    let mut heading = None;
    for (number, at, line) in lines(text) {
        if line.trim().is_empty() || line.starts_with('#') && (heading.is_some() || is_remark(line))
        {
            continue;
        }
        let Some(columns) = &heading else {
            match head(line, at) {
                Ok(columns) => heading = Some(columns),
                Err(faults) => {
                    faults.into_iter().for_each(|fault| book.fault(fault));
                    return;
                }
            }
            continue;
        };
        let all: Vec<Word<'_>> = cells(line, at, columns.separator).collect();
        match row(columns, &all, (at, line.len()), book) {
            Ok(scan) => book.log.scans.push(Scan { line: number, ..scan }),
            Err(fault) => book.fault(fault),
        }
    }
}

fn head(line: &str, at: usize) -> Result<Heading, Vec<LogFault>> {
    let separator = [';', '\t'].into_iter().find(|c| line.contains(*c)).unwrap_or(',');
    let mut heading = Heading { separator, ..Heading::default() };
    let mut faults = Vec::new();
    let mut ranges: BTreeMap<usize, Column> = BTreeMap::new();
    for (column, word) in cells(line, at, separator).enumerate() {
        let name = word.text.trim_start_matches(['#', '%', ' ']).to_ascii_lowercase();
        let name = name.strip_prefix("field.").unwrap_or(&name);
        let (name, unit) = parted(name);
        let of = NAMES.iter().position(|(known, _)| *known == name);
        let beam = name
            .strip_prefix("ranges")
            .and_then(|rest| rest.trim_matches(['[', ']', '_', '.']).parse::<usize>().ok());
        heading.width = column + 1;
        let what = match (of, beam) {
            (Some(of), _) => NAMES[of].1,
            (None, Some(_)) => Of::Length,
            (None, None) => continue,
        };
        // A tool that writes messages tells their time as `%time`, in ns.
        let unit = if unit.is_empty() && word.text.starts_with("%time") { "ns" } else { unit };
        let Some(factor) = what.unit(unit) else {
            faults.push(LogFault::Unit { found: word.shown(), at: word.span() });
            continue;
        };
        let before = match (of, beam) {
            (Some(of), _) => heading.named[of].replace((column, factor)),
            (None, beam) => beam.and_then(|beam| ranges.insert(beam, (column, factor))),
        };
        if before.is_some() {
            faults.push(LogFault::Twice { column: word.shown(), at: word.span() });
        }
    }
    let missing = |column: String| LogFault::NoColumn { column, at: (at, line.len()).into() };
    let named = NAMES.iter().zip(&heading.named).take(NEEDED);
    let unnamed = named.filter(|(_, column)| column.is_none()).map(|((name, _), _)| *name);
    faults.extend(unnamed.map(|name| missing(name.to_owned())));
    // Beams are counted from 0 or from 1, with none left out.
    let first = ranges.keys().next().map_or(0, |first| usize::from(*first == 1));
    let gap = ranges.keys().zip(first..).find(|(beam, k)| *beam != k).map(|(_, k)| k);
    let gap = gap.or_else(|| ranges.is_empty().then_some(0));
    faults.extend(gap.map(|beam| missing(format!("ranges{beam}"))));
    heading.ranges = ranges.into_values().collect();
    if faults.is_empty() { Ok(heading) } else { Err(faults) }
}

/// A name and the unit in the brackets behind it: `range_max [m]`; a number there belongs to the name.
fn parted(name: &str) -> (&str, &str) {
    let inner = name.strip_suffix([']', ')']);
    let parts = inner.and_then(|inner| inner.rsplit_once(['[', '(']));
    match parts {
        Some((name, unit)) if unit.trim().parse::<usize>().is_err() => (name.trim(), unit.trim()),
        _ => (name, ""),
    }
}

fn row(
    heading: &Heading,
    all: &[Word<'_>],
    (at, length): (usize, usize),
    book: &mut Book,
) -> Result<Scan, LogFault> {
    let (found, needed) = (all.len(), heading.width);
    if found < needed {
        return Err(LogFault::CutOff { found, needed, at: (at + length, 0).into() });
    }
    if let Some(word) = all[needed..].iter().find(|word| !word.text.is_empty()) {
        return Err(LogFault::TooLong { found, needed, at: word.span() });
    }
    let number = |(column, unit): Column| {
        let word = &all[column];
        let number =
            if heading.separator == ',' { word.number() } else { word.number_with_comma() };
        let number = number.map(|number| number * unit);
        number.ok_or_else(|| LogFault::NotNumber { found: word.shown(), at: word.span() })
    };
    let [first, step, nearest, farthest, x, y, theta, time] = heading.named;
    let asked = |column: Option<Column>| number(column.expect("the heading was asked for it"));
    let (first, step) = (asked(first)?, asked(step)?);
    let (nearest, farthest) = (asked(nearest)?, asked(farthest)?);
    let mut ranges =
        heading.ranges.iter().map(|column| number(*column)).collect::<Result<Vec<f64>, _>>()?;
    // A sensor that turns clockwise is told the other way round.
    let (first, step) = if step < 0.0 {
        ranges.reverse();
        (step.mul_add(ranges.len().saturating_sub(1) as f64, first), -step)
    } else {
        (first, step)
    };
    let reach = (nearest, farthest.min(100_000.0));
    let beams = (first, step, ranges.len());
    let pose = match (x, y, theta) {
        (Some(x), Some(y), Some(theta)) => {
            let at = [x, y, theta].map(|column| &all[column.0]);
            Some(place(at, [number(x)?, number(y)?, number(theta)?])?)
        }
        _ => None,
    };
    let time = time.map(number).transpose()?.filter(|time| time.is_finite());
    let sensor = book.sensor(beams, reach, Noise::default(), (at, length).into())?;
    Ok(Scan { sensor, ranges, pose, odometry: None, time, line: 0 })
}
