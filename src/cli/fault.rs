//! Faults as a person or a program sees them.

use std::fmt;
use std::io::Write as _;
use std::process::ExitCode;
use std::sync::OnceLock;

use miette::{
    Diagnostic, GraphicalReportHandler, GraphicalTheme, LabeledSpan, MietteError,
    MietteSpanContents, SourceCode, SourceSpan, SpanContents,
};

use crate::engine::{Error, RequestError, json};

use crate::units::{English, OwnText, told};

use super::args::{Color, Lang};
use super::config_error::ConfigError;

/// What was said of colours.
static COLOUR: OnceLock<Color> = OnceLock::new();

/// Says for the whole run how faults are coloured.
pub(super) fn colour(when: Color) {
    // It is said once, before anything is told.
    let _ = COLOUR.set(when);
}

/// Whether what goes to a terminal, or elsewhere, is coloured; <https://no-color.org> is heeded.
pub(super) fn is_coloured(is_terminal: bool) -> bool {
    match COLOUR.get() {
        Some(Color::Always) => true,
        Some(Color::Never) => false,
        Some(Color::Auto) | None => {
            is_terminal && std::env::var_os("NO_COLOR").is_none_or(|set| set.is_empty())
        }
    }
}

/// Why a command ended without an answer.
#[derive(Debug)]
pub(super) enum Failure {
    /// The settings cannot be used.
    Config(Box<ConfigError>),
    Engine(Box<Error>),
    /// Standard output is gone.
    Output(String),
}

impl<E: Into<Error>> From<E> for Failure {
    fn from(error: E) -> Self {
        Self::Engine(Box::new(error.into()))
    }
}

impl Failure {
    pub(super) fn output(error: &std::io::Error) -> Self {
        Self::Output(error.to_string())
    }

    pub(super) fn file(path: &std::path::Path, error: &std::io::Error) -> Self {
        RequestError::File {
            path: path.display().to_string(),
            reason: error.to_string().into(),
            is_input: crate::units::is_input(error.kind()),
        }
        .into()
    }

    /// Prints the faults and says with which code to end.
    #[expect(clippy::print_stderr, reason = "this is where faults are printed")]
    pub(super) fn show(&self, as_json: bool, lang: Lang) -> ExitCode {
        super::waiting::over();
        match self {
            Self::Output(reason) => {
                eprintln!("ortho: {}: {reason}", told!(lang.language(), "output-broke-off"));
                ExitCode::from(3)
            }
            Self::Config(error) => match lang {
                Lang::Ru => told(&**error, as_json, 2, lang),
                Lang::En => told(&English(&**error), as_json, 2, lang),
            },
            Self::Engine(error) => {
                let english = (lang == Lang::En).then(|| error.in_english());
                let shown: &dyn Diagnostic = english.as_deref().unwrap_or(error.as_ref());
                told(shown, as_json, if error.is_input() { 2 } else { 3 }, lang)
            }
        }
    }
}

/// Tells faults, and with which code to end.
#[expect(clippy::print_stderr, reason = "this is where faults are printed")]
fn told(shown: &dyn Diagnostic, as_json: bool, code: u8, lang: Lang) -> ExitCode {
    if as_json {
        let view = json::failed(shown);
        // Who reads no further has read enough.
        let _ = writeln!(std::io::stdout(), "{view}");
    } else {
        eprint!("{}", drawn(shown, lang));
    }
    ExitCode::from(code)
}

/// Faults with the lines that they stand in; plain signs when the output is no terminal.
///
/// Of a tree of faults the root is told in a line, where it holds several, and then each leaf.
pub(super) fn drawn(error: &dyn Diagnostic, lang: Lang) -> String {
    let colored = is_coloured(std::io::IsTerminal::is_terminal(&std::io::stderr()));
    let theme = if colored { GraphicalTheme::unicode() } else { GraphicalTheme::unicode_nocolor() };
    let handler = GraphicalReportHandler::new_themed(theme).with_context_lines(1).with_links(false);
    let mut leaves = Vec::new();
    gather(error, None, lang, &mut leaves);
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
    source: Option<Excerpts<'e>>,
}

/// A text of which no more is shown than stands beside each place. Places near each other share an excerpt; what lies
/// between two that are far apart helps nobody.
#[derive(Clone, Copy)]
struct Excerpts<'e>(&'e dyn SourceCode, Lang);

/// A place that takes more lines, or bytes, is shown by its first line, or its beginning.
const MOST_LINES: usize = 6;
const MOST_BYTES: usize = 400;

impl fmt::Debug for Excerpts<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Excerpts")
    }
}

impl SourceCode for Excerpts<'_> {
    /// Refuses an excerpt that would span two places far apart; they are then shown one by one.
    fn read_span<'a>(
        &'a self,
        span: &SourceSpan,
        lines_before: usize,
        lines_after: usize,
    ) -> Result<Box<dyn SpanContents<'a> + 'a>, MietteError> {
        if span.len() > 2 * MOST_BYTES {
            return Err(MietteError::OutOfBounds);
        }
        let contents = self.0.read_span(span, lines_before, lines_after)?;
        // What is no file is called by a word, which each language has its own of.
        let Some(own) = contents.name().and_then(OwnText::named) else { return Ok(contents) };
        let (data, at, lines) = (contents.data(), *contents.span(), contents.line_count());
        let name = own.name(self.1.language());
        let (line, column) = (contents.line(), contents.column());
        Ok(Box::new(MietteSpanContents::new_named(
            name.into_owned(),
            data,
            at,
            line,
            column,
            lines,
        )))
    }
}

impl Excerpts<'_> {
    /// As much of a place as is shown of it.
    fn beginning(&self, place: &LabeledSpan) -> LabeledSpan {
        let shown = |len: usize| {
            let (label, span) = (place.label().map(str::to_owned), (place.offset(), len));
            match place.primary() {
                true => LabeledSpan::new_primary_with_span(label, span),
                false => LabeledSpan::new_with_span(label, span),
            }
        };
        let Ok(contents) = self.0.read_span(place.inner(), 0, 0) else { return place.clone() };
        let start = place.offset().saturating_sub(contents.span().offset());
        let text = contents.data().get(start..).unwrap_or_default();
        let text = &text[..text.len().min(place.len())];
        let lines = text.iter().filter(|&&byte| byte == b'\n').count();
        let first = text.iter().position(|&byte| byte == b'\n').unwrap_or(text.len());
        let len = if lines >= MOST_LINES { first } else { text.len() };
        if len.min(MOST_BYTES) == place.len() {
            return place.clone();
        }
        // To where a character begins.
        let ends = (0..=len.min(MOST_BYTES)).rev();
        let mut ends = ends.filter(|&end| text.get(end).is_none_or(|byte| byte & 0xC0 != 0x80));
        shown(ends.next().unwrap_or(0))
    }
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
        self.source.as_ref().map(|source| source as &dyn SourceCode)
    }

    fn labels(&self) -> Option<Box<dyn Iterator<Item = LabeledSpan> + '_>> {
        let places = self.fault.labels()?;
        Some(match &self.source {
            Some(source) => Box::new(places.map(|place| source.beginning(&place))),
            None => places,
        })
    }
}

/// The leaves of the tree of faults, in order.
fn gather<'e>(
    error: &'e dyn Diagnostic,
    source: Option<&'e dyn SourceCode>,
    lang: Lang,
    into: &mut Vec<Leaf<'e>>,
) {
    let source = error.source_code().or(source);
    let before = into.len();
    for inner in error.related().into_iter().flatten() {
        gather(inner, source, lang, into);
    }
    if into.len() == before {
        into.push(Leaf { fault: error, source: source.map(|text| Excerpts(text, lang)) });
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::strips::Scenario;
    use crate::units::Source;

    /// A rule file that declares a predicate twice, with so many others in between, on as many lines or on one.
    fn declared_twice(others: usize, line_end: &str) -> String {
        let others: String =
            (0..others).map(|n| format!("ДРУГОЙ-{n}_(объект){line_end}")).collect();
        let text = format!(
            "Предикаты:{line_end}ТОТ-ЖЕ_(объект){line_end}{others}ТОТ-ЖЕ_(объект){line_end}Факты: ТОТ-ЖЕ_(Стол) Цель: ТОТ-ЖЕ_(Стол)"
        );
        let faults = Scenario::parse(&Source::new("правила", text)).unwrap_err();
        drawn(&faults, Lang::Ru)
    }

    #[test]
    fn both_places_of_a_fault_are_shown_and_not_what_lies_between() {
        for line_end in ["\n", " "] {
            for others in (0..12).chain([20, 50, 150, 400, 3000]) {
                let told = declared_twice(others, line_end);
                for label in ["первый раз – здесь", "второй раз – здесь"]
                {
                    assert!(told.contains(label), "{others}: {told}");
                }
                assert!(told.lines().count() < 30, "{others}: {}", told.lines().count());
                // Two excerpts of a long line, and the signs under them.
                assert!(told.len() < 20_000, "{others}: {} bytes", told.len());
            }
        }
    }

    #[test]
    fn a_place_of_many_lines_is_shown_by_its_first() {
        let goal: String = (0..500).map(|n| format!("    (p o{n})\n")).collect();
        let domain = "(define (domain d) (:predicates (p ?x)) (:action a :parameters (?x) :precondition (and) :effect (p ?x)))";
        let problem =
            format!("(define (problem q) (:domain d) (:objects o)\n (:goal (preference\n{goal})))");
        let faults = Scenario::parse_pddl(&Source::new("d", domain), &Source::new("p", problem))
            .unwrap_err();
        let told = drawn(&faults, Lang::Ru);
        assert!(told.contains("(preference") && told.lines().count() < 20, "{told}");
    }

    #[test]
    fn programs_get_every_place() {
        let text = "Предикаты:\n ТОТ-ЖЕ_(объект)\n ТОТ-ЖЕ_(объект)\nЦель: ТОТ-ЖЕ_(Стол)";
        let faults = Scenario::parse(&Source::new("правила", text)).unwrap_err();
        let views = json::faults(&faults);
        let lines = |fault: &serde_json::Value| {
            let places = fault["places"].as_array().cloned().unwrap_or_default();
            places.iter().map(|place| place["line"].clone()).collect::<Vec<_>>()
        };
        assert!(views.iter().any(|fault| lines(fault) == [3, 2]), "{views:?}");
    }
}
