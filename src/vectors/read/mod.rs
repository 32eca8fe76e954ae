//! Logs of range sensors: CARMEN, rows of ranges with a heading, and the format of BreezySLAM's examples.
//!
//! A log is read as far as it can be: what is wrong with a line is told with its place, and the others stand.

mod breezy;
mod carmen;
mod csv;
mod english;
mod fault;
mod words;

use std::io::Read;
use std::path::Path;

use flate2::read::MultiGzDecoder;
use miette::SourceSpan;
use nalgebra::{Isometry2, Vector2};
use orthoframe_units::{FileFault, Source, read_file};

pub use fault::{LogError, LogFault};

use crate::scan::Sensor;
use words::Word;

/// Longest log, packed or not, in bytes.
pub const LONGEST: u64 = 256 << 20;
/// Faults that are told; of the others the number.
const MOST_FAULTS: usize = 100;

/// One turn of a sensor.
#[derive(Debug, Clone, PartialEq)]
pub struct Scan {
    /// Its place among [`Log::sensors`].
    pub sensor: usize,
    /// In cm, one a beam; what is not a number or out of reach is no return.
    pub ranges: Vec<f64>,
    /// Of the sensor, where the log tells it: in cm and rad.
    pub pose: Option<Isometry2<f64>>,
    /// Of the robot, by its wheels.
    pub odometry: Option<Isometry2<f64>>,
    /// In s, of the log's own clock.
    pub time: Option<f64>,
    /// The line of the log, from 1.
    pub line: usize,
}

/// What a log holds.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Log {
    pub sensors: Vec<Sensor>,
    pub scans: Vec<Scan>,
}

impl Log {
    /// The sensor of a scan.
    ///
    /// # Panics
    /// With a scan of another log.
    #[must_use]
    pub fn sensor(&self, scan: &Scan) -> &Sensor {
        &self.sensors[scan.sensor]
    }

    fn sensor_like(&mut self, sensor: Sensor) -> usize {
        self.sensors.iter().position(|known| *known == sensor).unwrap_or_else(|| {
            self.sensors.push(sensor);
            self.sensors.len() - 1
        })
    }
}

/// A log as far as it could be read, and what was wrong with the rest.
#[derive(Debug, Clone)]
pub struct Reading {
    pub log: Log,
    pub error: Option<LogError>,
}

/// The text of a log file, unpacked where it is gzipped.
///
/// # Errors
/// [`FileFault`].
pub fn read_source(path: &Path) -> Result<Source, FileFault> {
    unpacked(&path.to_string_lossy(), read_file(path, LONGEST)?)
}

/// The text of a log whose file's bytes are given, unpacked where they are gzipped.
///
/// # Errors
/// [`FileFault::TooLarge`], [`FileFault::NotText`], or what unpacking meets.
pub fn unpacked(name: &str, mut bytes: Vec<u8>) -> Result<Source, FileFault> {
    if bytes.starts_with(&[0x1f, 0x8b]) {
        let mut unpacked = Vec::new();
        MultiGzDecoder::new(bytes.as_slice())
            .take(LONGEST + 1)
            .read_to_end(&mut unpacked)
            .map_err(FileFault::Io)?;
        if unpacked.len() as u64 > LONGEST {
            return Err(FileFault::TooLarge { bytes: unpacked.len() as u64, limit: LONGEST });
        }
        bytes = unpacked;
    }
    let text = String::from_utf8(bytes)
        .map_err(|error| FileFault::NotText { at: error.utf8_error().valid_up_to() })?;
    Ok(Source::new(name, text))
}

/// The scans of a log; its format is seen from its first line that says something.
#[must_use]
pub fn read_log(source: &Source) -> Reading {
    let mut book = Book { log: Log::default(), faults: Vec::new(), more: 0 };
    let text = source.text();
    match Format::of(text) {
        Some(Format::Carmen) => carmen::read(text, &mut book),
        Some(Format::Breezy) => breezy::read(text, &mut book),
        Some(Format::Rows) => csv::read(text, &mut book),
        None => book.fault(LogFault::Unknown { at: first_line(text) }),
    }
    if book.faults.is_empty() && book.log.scans.is_empty() {
        book.fault(LogFault::Empty { at: first_line(text) });
    }
    let error = (!book.faults.is_empty()).then(|| LogError {
        source_text: source.clone(),
        faults: book.faults,
        more: book.more,
    });
    Reading { log: book.log, error }
}

fn first_line(text: &str) -> SourceSpan {
    (0, text.find('\n').unwrap_or(text.len())).into()
}

#[derive(Debug, Clone, Copy)]
enum Format {
    Carmen,
    Breezy,
    Rows,
}

impl Format {
    fn of(text: &str) -> Option<Self> {
        let mut lines = text.lines().filter(|line| !line.trim().is_empty());
        let first = lines.find(|line| !line.starts_with('#') || carmen::is_head(line))?;
        if carmen::is_head(first) {
            return Some(Self::Carmen);
        }
        if first.contains([',', ';']) {
            return Some(Self::Rows);
        }
        let numbers = words::words(first, 0).filter(|word| word.number().is_some()).count();
        (numbers > breezy::BEFORE && words::words(first, 0).count() == numbers)
            .then_some(Self::Breezy)
    }
}

/// A log while it is being read.
struct Book {
    log: Log,
    faults: Vec<LogFault>,
    more: usize,
}

impl Book {
    fn fault(&mut self, fault: LogFault) {
        if self.faults.len() < MOST_FAULTS {
            self.faults.push(fault);
        } else {
            self.more += 1;
        }
    }
}

/// A pose of metres and radians, in cm; a fault where it is none.
fn pose(words: [&Word<'_>; 3]) -> Result<Isometry2<f64>, LogFault> {
    let number = |word: &Word<'_>| match word.number() {
        Some(value) if value.abs() < 1e7 => Ok(value),
        Some(_) => Err(LogFault::NoPlace { found: word.shown(), at: word.span() }),
        None => Err(LogFault::NotNumber { found: word.shown(), at: word.span() }),
    };
    let [x, y, heading] = words;
    Ok(Isometry2::new(Vector2::new(number(x)? * 100.0, number(y)? * 100.0), number(heading)?))
}
