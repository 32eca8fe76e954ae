//! Segments of a log's scans, and what was wrong with its lines, as data.

use serde_json::{Value, json};

use super::values::{point, round};
use crate::units::InEnglish as _;
use crate::vectors::read::{LogError, LogFault};
use crate::vectors::{Cut, End, Segment, Truth};

/// What was wrong with lines of a log.
pub(super) fn log_faults(error: Option<&LogError>) -> Vec<Value> {
    let told = |error: &LogError| -> Vec<Value> {
        let fault = |fault: &LogFault| {
            let (line, column) = error.source_text.position(fault.offset());
            let code = miette::Diagnostic::code(fault).map(|code| code.to_string());
            json!({
                "code": code, "message": fault.to_string(), "message_en": fault.english(),
                "line": line, "column": column,
            })
        };
        error.faults.iter().map(fault).collect()
    };
    error.map(told).unwrap_or_default()
}

/// What was made of a log, with how many scans it has, where that is to be told, and what was wrong with its lines.
#[must_use]
pub(crate) fn of_log(mut view: Value, scans: Option<usize>, faults: Option<&LogError>) -> Value {
    if let Some(scans) = scans {
        view["scans"] = json!(scans);
    }
    view["faults"] = json!(log_faults(faults));
    view
}

/// `deviation`: of the two ends across and along, the greatest.
pub(super) fn segment(segment: &Segment<2>) -> Value {
    json!({
        "from": point(segment.start.into()),
        "to": point(segment.end.into()),
        "length": round(segment.length()),
        "ends": ends(segment),
        "deviation": round(segment.covariance.deviation()),
    })
}

/// Words for what the ends of a segment are.
#[must_use]
pub(crate) fn ends(segment: &Segment<2>) -> [&'static str; 2] {
    segment.ends.map(end)
}

const fn end(end: End) -> &'static str {
    match end {
        End::True(Truth::Corner) => "corner",
        End::True(Truth::Free) => "free",
        End::True(Truth::Given) => "given",
        End::Cut(Cut::Occluded) => "occluded",
        End::Cut(Cut::Range) => "range",
        End::Cut(Cut::Field) => "field",
        End::Cut(Cut::Unclear) => "unclear",
    }
}
