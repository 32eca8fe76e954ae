//! What a command did, as data: files that it wrote, a Datalog program that it ran, a recording that it told again.

use miette::Diagnostic;
use serde_json::{Value, json};

use super::faults::faults;
use crate::facts::{FilesReport, RuleTrace};
use crate::language::Language;

/// What does not succeed.
#[must_use]
pub(crate) fn failed(error: &dyn Diagnostic) -> Value {
    json!({ "outcome": "error", "errors": faults(error) })
}

/// Files that were written.
#[must_use]
pub(crate) fn written(files: &[String]) -> Value {
    json!({"outcome": "done", "written": files})
}

/// Rule files that were put into the usual form, those alone that were not in it.
#[must_use]
pub(crate) fn formatted(changed: &[String]) -> Value {
    json!({"outcome": "done", "changed": changed})
}

/// Files of foreign formats that were written.
#[must_use]
pub(crate) fn exported(files: &[String]) -> Value {
    json!({ "outcome": "exported", "files": files })
}

/// A Datalog program that ran on files of facts; with its trace, how each rule was derived.
#[must_use]
pub(crate) fn program_run(report: &FilesReport, with_trace: bool, language: Language) -> Value {
    let sizes: Vec<_> =
        report.sizes.iter().map(|(name, n)| json!({"relation": name, "tuples": n})).collect();
    let mut view = json!({
        "outcome": "done", "sizes": sizes, "written": report.written, "printed": report.printed,
    });
    if with_trace {
        let rule = |line: &RuleTrace| {
            let joins: Vec<_> = line.joins.iter().map(|join| join.say(language)).collect();
            json!({
                "place": line.place, "relation": line.relation, "joins": joins,
                "runs": line.runs, "found": line.found, "ms": line.time.as_secs_f64() * 1000.0,
            })
        };
        view["rules"] = report.traced.iter().map(rule).collect();
    }
    view
}

/// An event of a recording, with when it happened.
#[must_use]
pub(crate) fn told_again(event: &Value, at_seconds: f64) -> Value {
    let mut view = event.clone();
    view["at_seconds"] = json!(at_seconds);
    view
}

/// A recording that is told to its end, and why it was cut off, where it was.
#[must_use]
pub(crate) fn told_to_its_end(seconds: f64, cut: Option<&str>) -> Value {
    json!({ "outcome": "replayed", "seconds": seconds, "cut": cut })
}
