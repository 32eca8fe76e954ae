//! Logs of range sensors: CARMEN, rows of ranges with a heading, and the format of BreezySLAM's examples.
//!
//! A log is read as far as it can be: what is wrong with a line is told with its place, and the others stand.

mod breezy;
mod carmen;
mod csv;
mod fault;
mod noise;
mod words;

use std::collections::HashMap;
use std::io::Read;
use std::path::Path;

use flate2::read::MultiGzDecoder;
use miette::SourceSpan;
use nalgebra::{Isometry2, Vector2};
use orthoframe_units::{FileFault, Source, read_file};

pub use fault::{LogError, LogFault};

use crate::scan::{Noise, Sensor};
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
    // A stray byte is told where it stands; what has zeros is no text at all.
    if let Some(at) = bytes.iter().position(|byte| *byte == 0) {
        return Err(FileFault::NotText { at });
    }
    let text = String::from_utf8(bytes)
        .unwrap_or_else(|error| String::from_utf8_lossy(error.as_bytes()).into_owned());
    Ok(Source::new(name, text.trim_start_matches('\u{feff}')))
}

/// The scans of a log; its format is seen from its first line that says something, or where that may be the end
/// of one, from any.
#[must_use]
pub fn read_log(source: &Source) -> Reading {
    let mut book = Book::default();
    let text = source.text();
    let format = Format::of(text);
    match format {
        Some(Format::Carmen) => carmen::read(text, &mut book),
        Some(Format::Breezy) => breezy::read(text, &mut book),
        Some(Format::Rows) => csv::read(text, &mut book),
        None => book.fault(LogFault::Unknown { at: first_line(text) }),
    }
    // The sensor of Breezy's logs is known.
    if !matches!(format, Some(Format::Breezy)) {
        noise::measure(&mut book.log);
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
        let mut lines = words::lines(text).map(|(.., line)| line);
        if text.lines().any(carmen::is_head) {
            return Some(Self::Carmen);
        }
        let first = lines.find(|line| !line.trim().is_empty() && !csv::is_remark(line))?;
        if csv::is_heading(first) || first.contains([',', ';']) {
            return Some(Self::Rows);
        }
        text.lines().any(breezy::is_row).then_some(Self::Breezy)
    }
}

/// A log while it is being read.
#[derive(Default)]
struct Book {
    log: Log,
    /// By what the sensors were made of.
    sensors: HashMap<[u64; 8], usize>,
    faults: Vec<LogFault>,
    more: usize,
}

impl Book {
    /// The place of a sensor among those of the log.
    fn sensor(
        &mut self,
        (first, step, count): (f64, f64, usize),
        reach: (f64, f64),
        noise: Noise,
        line: SourceSpan,
    ) -> Result<usize, LogFault> {
        let bits = [first, step, reach.0, reach.1, noise.range, noise.share, noise.bearing];
        let mut key = [count as u64; 8];
        key[1..].copy_from_slice(&bits.map(f64::to_bits));
        if let Some(known) = self.sensors.get(&key) {
            return Ok(*known);
        }
        let sensor = Sensor::new(first, step, count, reach, noise)
            .map_err(|fault| LogFault::Sensor { fault, at: line })?;
        self.log.sensors.push(sensor);
        self.sensors.insert(key, self.log.sensors.len() - 1);
        Ok(self.log.sensors.len() - 1)
    }

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
    let number = |word: &Word<'_>| {
        word.number().ok_or_else(|| LogFault::NotNumber { found: word.shown(), at: word.span() })
    };
    let [x, y, heading] = words;
    place(words, [number(x)? * 100.0, number(y)? * 100.0, number(heading)?])
}

/// The pose of which the words tell x, y and heading, in cm and rad; a fault where it is no place.
fn place(words: [&Word<'_>; 3], pose: [f64; 3]) -> Result<Isometry2<f64>, LogFault> {
    for (word, (value, most)) in words.into_iter().zip(pose.into_iter().zip([1e9, 1e9, 1e7])) {
        if value.is_nan() || value.abs() >= most {
            return Err(LogFault::NoPlace { found: word.shown(), at: word.span() });
        }
    }
    let [x, y, heading] = pose;
    Ok(Isometry2::new(Vector2::new(x, y), heading))
}
