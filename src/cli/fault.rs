//! Faults as a person or a program sees them.

use std::fmt;
use std::process::ExitCode;

use miette::{Diagnostic, GraphicalReportHandler, GraphicalTheme, SourceCode};
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

    pub(super) fn file(path: &std::path::Path, error: &std::io::Error) -> Self {
        RequestError::File {
            path: path.display().to_string(),
            reason: error.to_string(),
            is_input: crate::units::is_input(error.kind()),
        }
        .into()
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
                let english = Some(error).filter(|_| lang == Lang::En).and_then(|e| e.in_english());
                let shown: &dyn Diagnostic = english.as_deref().unwrap_or(error.as_ref());
                let told = error.english().filter(|_| lang == Lang::En);
                if as_json {
                    let mut leaves = Vec::new();
                    gather(shown, None, &mut leaves);
                    let mut faults: Vec<FaultView> = leaves.iter().map(view).collect();
                    // What is told in one piece holds its remedy.
                    if let (Some(text), [only]) = (told, &mut faults[..]) {
                        (only.message, only.help) = (text, None);
                    }
                    let view = serde_json::json!({ "outcome": "error", "errors": faults });
                    println!("{view}");
                } else {
                    match told {
                        Some(text) => eprintln!("  × {text}"),
                        None => eprint!("{}", drawn(shown)),
                    }
                }
                ExitCode::from(if error.is_input() { 2 } else { 3 })
            }
        }
    }
}

/// Faults with the lines that they stand in; plain signs when the output is no terminal.
///
/// Of a tree of faults the root is told in a line, where it holds several, and then each leaf.
pub(super) fn drawn(error: &dyn Diagnostic) -> String {
    let colored = std::io::IsTerminal::is_terminal(&std::io::stderr());
    let theme = if colored { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme).with_context_lines(1).with_links(false);
    let mut leaves = Vec::new();
    gather(error, None, &mut leaves);
    let mut text = String::new();
    if leaves.len() > 1 {
        text.push_str(&format!("  × {error}\n\n"));
    }
    for (n, leaf) in leaves.iter().enumerate() {
        if n > 0 {
            text.push('\n');
        }
        // Writing to a String cannot fail.
        let _ = handler.render_report(&mut text, leaf);
    }
    text
}

/// A fault with the text that it stands in, which the fault around it may hold.
struct Leaf<'e> {
    fault: &'e dyn Diagnostic,
    source: Option<&'e dyn SourceCode>,
}

impl fmt::Display for Leaf<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Display::fmt(self.fault, f)
    }
}

impl fmt::Debug for Leaf<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        fmt::Debug::fmt(self.fault, f)
    }
}

impl std::error::Error for Leaf<'_> {}

impl Diagnostic for Leaf<'_> {
    fn code<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.fault.code()
    }

    fn severity(&self) -> Option<miette::Severity> {
        self.fault.severity()
    }

    fn help<'a>(&'a self) -> Option<Box<dyn fmt::Display + 'a>> {
        self.fault.help()
    }

    fn source_code(&self) -> Option<&dyn SourceCode> {
        self.source
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = miette::LabeledSpan> + '_>> {
        self.fault.labels()
    }
}

/// The leaves of the tree of faults, in order.
fn gather<'e>(
    error: &'e dyn Diagnostic,
    source: Option<&'e dyn SourceCode>,
    into: &mut Vec<Leaf<'e>>,
) {
    let source = error.source_code().or(source);
    let before = into.len();
    for inner in error.related().into_iter().flatten() {
        gather(inner, source, into);
    }
    if into.len() == before {
        into.push(Leaf { fault: error, source });
    }
}

/// A leaf with its first place, for programs.
fn view(leaf: &Leaf<'_>) -> FaultView {
    let place = leaf.labels().and_then(|mut labels| labels.next()).and_then(|label| {
        let contents = leaf.source?.read_span(label.inner(), 0, 0).ok()?;
        Some((contents.name().map(str::to_owned), contents.line() + 1, contents.column() + 1))
    });
    FaultView {
        code: leaf.code().map(|c| c.to_string()),
        message: leaf.to_string(),
        help: leaf.help().map(|h| h.to_string()),
        file: place.as_ref().and_then(|p| p.0.clone()),
        line: place.as_ref().map(|p| p.1),
        column: place.as_ref().map(|p| p.2),
    }
}
