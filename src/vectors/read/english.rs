//! What can be wrong with a log, in English.

use super::fault::{LogError, LogFault};
use crate::scan::SensorError;
use orthoframe_units::{English, EnglishGroup, InEnglish, Language, Lengths};

impl InEnglish for LogFault {
    fn english(&self) -> String {
        match self {
            Self::Unknown { .. } => "the log is of no known format".to_owned(),
            Self::Empty { .. } => "the log has no scan".to_owned(),
            Self::NotNumber { found, .. } => format!("“{found}” is no number"),
            Self::NoPlace { found, .. } => format!("“{found}” is no place"),
            Self::Beams { found, .. } => format!("“{found}” beams cannot be"),
            Self::Field { count, .. } => {
                format!("{count} beams: the log does not say how wide they look")
            }
            Self::CutOff { found, needed, .. } => {
                format!("the line breaks off: it has {found} words, {needed} are needed")
            }
            Self::TooLong { found, needed, .. } => {
                format!("the line has {found} words, {needed} are due")
            }
            Self::NoMessage { found, .. } => format!("“{found}” is no message of a log"),
            Self::Twice { column, .. } => format!("the column “{column}” is named twice"),
            Self::Unit { found, .. } => format!("the unit of the column “{found}” is unknown"),
            Self::NoColumn { column, .. } => format!("the heading has no column “{column}”"),
            Self::Sensor { fault, .. } => format!("the sensor cannot be: {}", fault.english()),
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Unknown { .. } => {
                "a CARMEN log (FLASER, ROBOTLASER1), a table of ranges with a heading, or BreezySLAM’s rows of numbers are read"
            }
            Self::Empty { .. } => "scans are lines FLASER, ROBOTLASER1 or RAWLASER1",
            Self::NotNumber { .. } => "a number stands here, its fraction after a point",
            Self::NoPlace { .. } => {
                "a coordinate of a pose is a finite number, less than 10⁷ m or rad"
            }
            Self::Beams { .. } => "an integer from 0 to 65536",
            Self::Field { .. } => {
                "give the step in degrees by a line “PARAM laser_front_laser_resolution 0.25”"
            }
            Self::CutOff { .. } => "complete the line, or remove it",
            Self::TooLong { .. } => "remove what is too much; part two lines that ran together",
            Self::NoMessage { .. } => {
                "a line of a CARMEN log begins with the name of its message; remove a torn piece"
            }
            Self::Twice { .. } => "keep one of the two",
            Self::Unit { .. } => {
                "lengths in m, cm or mm, angles in rad or deg, time in s, ms, us or ns"
            }
            Self::NoColumn { .. } => {
                "a heading: angle_min, angle_increment, range_min, range_max, then ranges0, ranges1, …; angles in rad, lengths in m"
            }
            Self::Sensor { .. } => "correct the angles and ranges of this line",
        };
        Some(help.to_owned())
    }

    fn english_labels(&self) -> [&'static str; 2] {
        let label = match self {
            Self::Unknown { .. } => "the first line",
            Self::Empty { .. } => "the log begins here",
            Self::NotNumber { .. } => "this word",
            Self::NoPlace { .. } => "this number",
            Self::Beams { .. } => "the number of beams",
            Self::Field { .. } | Self::Sensor { .. } => "this line",
            Self::CutOff { .. } => "here the line ends",
            Self::TooLong { .. } => "too much from here on",
            Self::NoMessage { .. } => "the line begins so",
            Self::Twice { .. } => "the second time",
            Self::Unit { .. } => "this column",
            Self::NoColumn { .. } => "the heading",
        };
        [label, ""]
    }
}

impl InEnglish for SensorError {
    fn english(&self) -> String {
        match self {
            Self::Field { first, step, count } => {
                format!("{count} beams, each {step} rad on from {first} rad, are no field of view")
            }
            Self::Reach { nearest, farthest } => {
                let told = |cm| Lengths::said().told(cm, 2, Language::English);
                format!("a range from {} to {} cannot be", told(*nearest), told(*farthest))
            }
            Self::Noise(value) => format!("an error of {value} cannot be"),
        }
    }

    fn english_help(&self) -> Option<String> {
        let help = match self {
            Self::Field { .. } => {
                "a step above zero, 0 to 65536 beams, no more than a full turn together"
            }
            Self::Reach { .. } => "0 ≤ nearest < farthest ≤ 100 000 cm",
            Self::Noise(_) => "range: above 0 cm; share and angle: from 0",
        };
        Some(help.to_owned())
    }
}

impl LogError {
    /// The faults as English tells them.
    #[must_use]
    pub fn in_english(&self) -> EnglishGroup<'_, LogFault> {
        let mut title =
            format!("not all of the log is read, faults: {}", self.faults.len() + self.more);
        for fault in &self.faults {
            let (line, column) = self.source_text.position(fault.offset());
            let name = self.source_text.name();
            title.push_str(&format!("\n{name}:{line}:{column}: {}", fault.english()));
        }
        EnglishGroup {
            all: self,
            title,
            help: Some("the other lines are read".to_owned()),
            faults: self.faults.iter().map(English).collect(),
        }
    }
}
