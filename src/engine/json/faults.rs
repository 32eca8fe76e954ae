//! Faults with their places, for programs.

use miette::{Diagnostic, LabeledSpan, SourceCode};
use serde::Serialize;
use serde_json::{Value, json};

use crate::language::Language;
use crate::map::MapErrors;
use crate::units::OwnText;

/// One fault.
#[derive(Debug, Serialize)]
struct FaultView {
    code: Option<String>,
    message: String,
    help: Option<String>,
    file: Option<String>,
    line: Option<usize>,
    column: Option<usize>,
    /// All places, where there are several; the first is that above.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    places: Vec<PlaceView>,
}

#[derive(Debug, Clone, Serialize)]
struct PlaceView {
    label: Option<String>,
    file: Option<String>,
    line: usize,
    column: usize,
}

/// Every leaf of a tree of faults, in order, each with its place: file, line, and column counted in characters.
#[must_use]
pub fn faults(error: &dyn Diagnostic) -> Vec<Value> {
    let mut leaves = Vec::new();
    gather(error, None, &mut leaves);
    leaves.iter().map(|leaf| json!(leaf)).collect()
}

/// Each warning with its place and remedy.
pub(super) fn warnings(warnings: &MapErrors, language: Language) -> Vec<Value> {
    match language {
        _ if warnings.faults.is_empty() => Vec::new(),
        Language::Russian => faults(warnings),
        Language::English => faults(&warnings.in_english()),
    }
}

fn gather(error: &dyn Diagnostic, source: Option<&dyn SourceCode>, into: &mut Vec<FaultView>) {
    let source = error.source_code().or(source);
    let before = into.len();
    for inner in error.related().into_iter().flatten() {
        gather(inner, source, into);
    }
    if into.len() == before {
        into.push(view(error, source));
    }
}

fn view(fault: &dyn Diagnostic, source: Option<&dyn SourceCode>) -> FaultView {
    let place = |label: LabeledSpan| {
        let contents = source?.read_span(label.inner(), 0, 0).ok()?;
        Some(PlaceView {
            label: label.label().map(str::to_owned),
            // What a person said is no file.
            file: contents.name().filter(|n| OwnText::named(n).is_none()).map(str::to_owned),
            line: contents.line() + 1,
            column: contents.column() + 1,
        })
    };
    let places: Vec<PlaceView> = fault.labels().into_iter().flatten().filter_map(place).collect();
    let first = places.first().cloned();
    FaultView {
        code: fault.code().map(|code| code.to_string()),
        message: fault.to_string(),
        help: fault.help().map(|help| help.to_string()),
        file: first.as_ref().and_then(|place| place.file.clone()),
        line: first.as_ref().map(|place| place.line),
        column: first.as_ref().map(|place| place.column),
        places: if places.len() > 1 { places } else { Vec::new() },
    }
}
