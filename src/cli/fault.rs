//! Faults as a person or a program sees them.

use std::process::ExitCode;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme};
use serde::Serialize;

use crate::engine::{Error, RequestError};

use super::args::Lang;

/// Why a command ended without an answer.
#[derive(Debug)]
pub(super) enum Failure {
    Engine(Box<Error>),
    /// Standard output is gone.
    Output(String),
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Engine(Box::new(error.into()))
    }
}

/// One fault for programs.
#[derive(Debug, Serialize)]
struct FaultView {
    code: Option<String>,
    message: String,
    help: Option<String>,
    file: Option<String>,
    line: Option<usize>,
    column: Option<usize>,
}

impl Failure {
    pub(super) fn output(error: &std::io::Error) -> Self {
        Self::Output(error.to_string())
    }

    /// The fault in a sentence; none where there is nobody left to tell.
    pub(super) fn message(&self, lang: Lang) -> Option<String> {
        match self {
            Self::Engine(error) => Some(match lang {
                Lang::Ru => error.to_string(),
                Lang::En => error.english().unwrap_or_else(|| error.to_string()),
            }),
            Self::Output(_) => None,
        }
    }

    pub(super) fn file(path: &std::path::Path, error: &std::io::Error) -> Self {
        RequestError::File { path: path.display().to_string(), reason: error.to_string() }.into()
    }

    /// Prints the faults and says with which code to end.
    #[expect(
        clippy::print_stderr,
        clippy::print_stdout,
        reason = "this is where faults are printed"
    )]
    pub(super) fn show(&self, as_json: bool, lang: Lang) -> ExitCode {
        match self {
            Self::Output(reason) => {
                eprintln!("ortho: вывод прерван: {reason}");
                ExitCode::from(3)
            }
            Self::Engine(error) => {
                if as_json {
                    let mut faults = Vec::new();
                    collect(error.as_ref(), None, &mut faults);
                    let view = serde_json::json!({ "outcome": "error", "errors": faults });
                    println!("{view}");
                } else {
                    match error.english().filter(|_| lang == Lang::En) {
                        Some(text) => eprintln!("  × {text}"),
                        None => eprint!("{}", drawn(error.as_ref())),
                    }
                }
                ExitCode::from(if error.is_input() { 2 } else { 3 })
            }
        }
    }
}

/// Faults with the lines that they stand in; plain signs when the output is no terminal.
pub(super) fn drawn(error: &dyn Diagnostic) -> String {
    let colored = std::io::IsTerminal::is_terminal(&std::io::stderr());
    let theme = if colored { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme).with_context_lines(1).with_links(false);
    let mut text = String::new();
    // Writing to a String cannot fail.
    let _ = handler.render_report(&mut text, error);
    text
}

/// Leaves of the tree of faults, each with its first place.
fn collect(
    error: &dyn Diagnostic,
    source: Option<&dyn miette::SourceCode>,
    into: &mut Vec<FaultView>,
) {
    let source = error.source_code().or(source);
    if let Some(related) = error.related() {
        let mut any = false;
        for inner in related {
            any = true;
            collect(inner, source, into);
        }
        if any {
            return;
        }
    }
    let place = error.labels().and_then(|mut labels| labels.next()).and_then(|label| {
        let contents = source?.read_span(label.inner(), 0, 0).ok()?;
        Some((contents.name().map(str::to_owned), contents.line() + 1, contents.column() + 1))
    });
    into.push(FaultView {
        code: error.code().map(|c| c.to_string()),
        message: error.to_string(),
        help: error.help().map(|h| h.to_string()),
        file: place.as_ref().and_then(|p| p.0.clone()),
        line: place.as_ref().map(|p| p.1),
        column: place.as_ref().map(|p| p.2),
    });
}
