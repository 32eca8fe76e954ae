//! What became of a store and what stands in it, as data.

use std::path::Path;

use serde_json::{Value, json};

use super::known::{differences, revision};
use crate::engine::calls::Call;
use crate::engine::{Difference, Revision, Severity};
use crate::language::Language;
use crate::store::{Finding, Forgotten, FsckReport};

/// What looking through a store found.
#[must_use]
pub(crate) fn store_check(report: &FsckReport, language: Language) -> Value {
    let finding = |finding: &Finding| {
        let severity = match finding.severity {
            Severity::Note => "note",
            Severity::Mendable => "mendable",
            Severity::Broken => "broken",
        };
        json!({"severity": severity, "text": finding.text.say(language)})
    };
    json!({
        "outcome": if report.is_sound() { "sound" } else { "faulty" },
        "transactions": report.lsn,
        "revision": report.revision,
        "records": report.records,
        "snapshots": report.snapshots,
        "findings": report.findings.iter().map(finding).collect::<Vec<_>>(),
    })
}

/// A copy of a store that is written and read back.
#[must_use]
pub(crate) fn backup(file: &Path) -> Value {
    json!({"outcome": "written", "file": file})
}

/// A store that a copy was made into again.
#[must_use]
pub(crate) fn restored(store: &Path, revision: u64) -> Value {
    json!({"outcome": "restored", "store": store, "revision": revision})
}

/// What of the past is forgotten.
#[must_use]
pub(crate) fn forgotten(forgotten: &Forgotten) -> Value {
    json!({
        "outcome": "done", "versions": forgotten.versions, "not_freed": forgotten.not_freed,
    })
}

/// The history, the oldest first.
#[must_use]
pub(crate) fn revisions<'a>(all: impl IntoIterator<Item = &'a Revision>) -> Value {
    json!({ "revisions": all.into_iter().map(revision).collect::<Vec<_>>() })
}

/// A history with the calls of assistants.
#[must_use]
pub(crate) fn with_calls<'a>(mut view: Value, calls: impl IntoIterator<Item = &'a Call>) -> Value {
    view["calls"] = calls.into_iter().map(|call| json!(call)).collect();
    view
}

/// What differs between two revisions.
#[must_use]
pub(crate) fn diff(from: u64, to: u64, all: &[Difference], language: Language) -> Value {
    json!({"from": from, "to": to, "differences": differences(all, language)})
}

/// A map as the text of its file.
#[must_use]
pub(crate) fn map_text(text: &str) -> Value {
    json!({ "map": text })
}
