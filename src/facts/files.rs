//! Programs run over Soufflé's files: a line for each tuple, a tab between values.

use std::borrow::Cow;
use std::collections::HashSet;
use std::fmt::Write as _;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use miette::Diagnostic;
use thiserror::Error;

use super::computed::AskError;
use super::database::{Database, FactError, Known, Loader};
use super::decimal::Decimal;
use super::derived::Derived;
use super::evaluate::EvaluateError;
use super::fault::{Faults, FileFaults};
use super::limits::Limits;
use super::program::{Column, Kind, Parameters, Program, RelationId, RelationInfo};
use super::texts::includes;
use super::trace::{self, RuleTrace};
use super::value::whole;
use crate::units::{FileFault, Source, read_text, write_file_with};

/// Why a program over files has no result.
#[derive(Debug, Error, Diagnostic)]
#[non_exhaustive]
pub enum FilesError {
    #[error(transparent)]
    #[diagnostic(transparent)]
    Program(#[from] Faults),
    /// A file or folder that cannot be read or written.
    #[error("{path}: {cause}", path = path.display())]
    #[diagnostic(
        code(facts::file),
        help(
            "проверьте имя и права: факты отношения r читаются из r.facts, папка для вывода должна уже быть"
        )
    )]
    File { path: PathBuf, cause: std::io::Error },
    /// A line of facts that does not fit its relation.
    #[error("{path}:{line}: {cause}", path = path.display())]
    #[diagnostic(code(facts::line), help("значения разделяются табуляцией, по одному на столбец"))]
    Line { path: PathBuf, line: usize, cause: Box<FactError> },
    /// A parameter of `.input` or `.output` that asks for what is not done here.
    #[error("«{relation}»: не поддерживается {name}={value}")]
    #[diagnostic(
        code(facts::parameter),
        help(
            "есть IO=file, для .input IO=stdin, для .output IO=stdout, filename, delimiter, headers, rfc4180, для .input columns=\"1:0\""
        )
    )]
    Parameter { relation: String, name: String, value: String },
    #[error(transparent)]
    #[diagnostic(transparent)]
    Evaluate(#[from] EvaluateError),
    /// What comes of `.pragma "magic-transform"`.
    #[error(transparent)]
    #[diagnostic(transparent)]
    Ask(AskError),
}

impl From<AskError> for FilesError {
    fn from(error: AskError) -> Self {
        match error {
            AskError::Evaluate(error) => Self::Evaluate(error),
            other => Self::Ask(other),
        }
    }
}

/// What a run over files did.
#[derive(Debug, Clone, Default)]
pub struct FilesReport {
    pub warnings: Vec<FileFaults>,
    /// `.printsize`: relation and number of tuples, in the order of the declarations.
    pub sizes: Vec<(String, usize)>,
    /// `.output`: the files written.
    pub written: Vec<PathBuf>,
    /// `.output` with `IO=stdout`: what is to be printed, as Soufflé prints it.
    pub printed: String,
    /// What each rule did, the longest first; only where it was asked for.
    pub traced: Vec<RuleTrace>,
}

/// Runs a program: `.input` relations from `facts_dir`, `.output` relations into `out_dir`.
///
/// A relation `r` is read from `r.facts` and written to `r.csv` unless its directive says `filename="…"`;
/// `delimiter="…"` replaces the tab, `headers=true` stands for a first line with the columns' names, `rfc4180=true`
/// for values in quotes, `columns="1:0"` for the file's columns to read; `IO=stdin` reads the standard input, and
/// `IO=stdout` prints instead of writing a file.
///
/// # Errors
/// [`FilesError`] with the place in the program or in the file of facts.
pub fn run_files(
    program: &Path,
    facts_dir: &Path,
    out_dir: &Path,
    limits: Limits,
) -> Result<FilesReport, FilesError> {
    run(program, facts_dir, out_dir, limits, false)
}

/// As [`run_files`], with what each rule did in [`FilesReport::traced`].
///
/// # Errors
/// As [`run_files`].
pub fn run_files_traced(
    program: &Path,
    facts_dir: &Path,
    out_dir: &Path,
    limits: Limits,
) -> Result<FilesReport, FilesError> {
    run(program, facts_dir, out_dir, limits, true)
}

fn run(
    program: &Path,
    facts_dir: &Path,
    out_dir: &Path,
    limits: Limits,
    is_traced: bool,
) -> Result<FilesReport, FilesError> {
    let program = Program::parse_included(&with_included(program)?)?;
    for (_, info) in program.relations() {
        info.inputs.iter().try_for_each(|known| check(info, known, false))?;
        info.outputs.iter().try_for_each(|known| check(info, known, true))?;
    }
    let mut database = program.database();
    for (relation, info) in program.relations() {
        for parameters in &info.inputs {
            read(&mut database, relation, info, parameters, facts_dir)?;
        }
    }
    let mut traced = Vec::new();
    let derived = if program.asks_for_demand() && !is_traced {
        let is_shown = |info: &RelationInfo| info.print_size || !info.outputs.is_empty();
        let shown: Vec<RelationId> = program
            .relations()
            .filter(|(_, info)| is_shown(info))
            .map(|(relation, _)| relation)
            .collect();
        program.evaluate_on_demand(&database, &shown, limits)?
    } else {
        let derived;
        (derived, traced) = program.run(&database, limits, is_traced)?;
        derived
    };
    let mut warnings = program.warnings().to_vec();
    warnings.extend(derived.notes());
    let mut report =
        FilesReport { warnings, traced: trace::sorted(traced), ..FilesReport::default() };
    for (relation, info) in program.relations() {
        if info.print_size {
            let size = derived.len(relation).expect("the relation is the program's own");
            report.sizes.push((info.name.clone(), size));
        }
        for parameters in &info.outputs {
            if parameter(parameters, "IO") == Some("stdoutprintsize") {
                let size = derived.len(relation).expect("the relation is the program's own");
                report.sizes.push((info.name.clone(), size));
                continue;
            }
            if is_printed(parameters) {
                print(&derived, relation, info, parameters, &mut report.printed);
                continue;
            }
            let path = out_dir.join(file_name(info, parameters, "csv"));
            write(&derived, relation, info, parameters, &path)
                .map_err(|cause| file_error(&path, cause))?;
            report.written.push(path);
        }
    }
    Ok(report)
}

impl Program {
    /// Reads a program's text that stands, or will stand, at this path, with all that it includes.
    ///
    /// # Errors
    /// [`FilesError`]: faults of the texts, or an included file that cannot be read.
    pub fn parse_at(source: &Source, path: &Path) -> Result<Self, FilesError> {
        let folder = path.parent().unwrap_or(Path::new(""));
        let mut sources = vec![source.clone()];
        for name in includes(source) {
            for more in with_included(&folder.join(name))? {
                if sources.iter().all(|known| known.name() != more.name()) {
                    sources.push(more);
                }
            }
        }
        Ok(Self::parse_included(&sources)?)
    }
}

/// A program that is longer was not written by a person.
const MAX_PROGRAM_BYTES: u64 = 16 << 20;
/// Facts of one relation.
const MAX_FACTS_BYTES: u64 = 256 << 20;

/// The program's text and all that it includes, each once; paths are looked for beside the text that names them.
fn with_included(program: &Path) -> Result<Vec<Source>, FilesError> {
    let mut sources = Vec::new();
    let mut read = HashSet::new();
    let mut open = vec![program.to_owned()];
    while let Some(path) = open.pop() {
        let known = path.canonicalize().map_err(|cause| file_error(&path, cause))?;
        if !read.insert(known) {
            continue;
        }
        let source = Source::read_within(&path, MAX_PROGRAM_BYTES)
            .map_err(|fault| file_error(&path, fault.into_io()))?;
        let folder = path.parent().unwrap_or(Path::new(""));
        open.extend(includes(&source).into_iter().rev().map(|name| folder.join(name)));
        sources.push(source);
    }
    Ok(sources)
}

fn file_error(path: &Path, cause: std::io::Error) -> FilesError {
    FilesError::File { path: path.to_owned(), cause }
}

fn parameter<'a>(parameters: &'a Parameters, name: &str) -> Option<&'a str> {
    parameters.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
}

/// Refuses what Soufflé may do and this program does not.
fn check(info: &RelationInfo, parameters: &Parameters, may_print: bool) -> Result<(), FilesError> {
    for (name, value) in parameters {
        let is_known = match name.as_str() {
            "IO" => match may_print {
                true => matches!(value.as_str(), "file" | "stdout" | "stdoutprintsize"),
                false => matches!(value.as_str(), "file" | "stdin"),
            },
            "headers" | "rfc4180" => matches!(value.as_str(), "true" | "false"),
            "filename" | "delimiter" => true,
            "columns" => !may_print && file_columns(value, info.columns.len()).is_some(),
            "format" | "compress" => false,
            // Was told to have no effect.
            _ => true,
        };
        if !is_known {
            let (relation, name, value) = (info.name.clone(), name.clone(), value.clone());
            return Err(FilesError::Parameter { relation, name, value });
        }
    }
    Ok(())
}

fn is_printed(parameters: &Parameters) -> bool {
    parameter(parameters, "IO") == Some("stdout")
}

fn has_headers(parameters: &Parameters) -> bool {
    parameter(parameters, "headers") == Some("true")
}

/// Values in quotes where they hold a delimiter, a quote or a line's end.
fn is_quoted(parameters: &Parameters) -> bool {
    parameter(parameters, "rfc4180") == Some("true")
}

/// `1:0`: which of the file's columns, from 0, each column of the relation is read from.
fn file_columns(value: &str, columns: usize) -> Option<Vec<usize>> {
    let places: Option<Vec<usize>> = value.split(':').map(|place| place.parse().ok()).collect();
    places.filter(|places| places.len() == columns)
}

fn file_name(info: &RelationInfo, parameters: &Parameters, extension: &str) -> String {
    parameter(parameters, "filename")
        .map_or_else(|| format!("{}.{extension}", info.name), str::to_owned)
}

fn delimiter(parameters: &Parameters) -> &str {
    let usual = if is_quoted(parameters) { "," } else { "\t" };
    parameter(parameters, "delimiter").filter(|text| !text.is_empty()).unwrap_or(usual)
}

fn read(
    database: &mut Database,
    relation: RelationId,
    info: &RelationInfo,
    parameters: &Parameters,
    facts_dir: &Path,
) -> Result<(), FilesError> {
    let is_stdin = parameter(parameters, "IO") == Some("stdin");
    let path = match is_stdin {
        true => PathBuf::from("stdin"),
        false => facts_dir.join(file_name(info, parameters, "facts")),
    };
    let text = match is_stdin {
        true => standard_input(),
        false => read_text(&path, MAX_FACTS_BYTES).map_err(|fault| fault.into_io()),
    };
    let text = text.map_err(|cause| file_error(&path, cause))?;
    let mut loader = database.load();
    let mut tuple = Vec::new();
    let places =
        parameter(parameters, "columns").and_then(|of| file_columns(of, info.columns.len()));
    let has_records = info.columns.iter().any(|column| matches!(column.kind, Kind::Record(_)));
    let mut records = Records { rest: &text, line: 0, parameters, has_records };
    let mut values = Vec::new();
    let mut is_header = has_headers(parameters);
    while let Some(line) = records.next(&mut values) {
        if std::mem::take(&mut is_header) {
            continue;
        }
        tuple.clear();
        let is_flag =
            info.columns.is_empty() && matches!(&*values, [one] if one.is_empty() || one == "()");
        // Short lines keep their length, so that the fault names it.
        let has_all = |places: &&Vec<usize>| places.iter().all(|place| *place < values.len());
        match places.as_ref().filter(has_all) {
            _ if is_flag => {}
            Some(places) => tuple.extend(
                places
                    .iter()
                    .zip(&info.columns)
                    .map(|(place, column)| known(Some(column), &values[*place], &mut loader)),
            ),
            None => tuple.extend(
                values
                    .iter()
                    .enumerate()
                    .map(|(n, text)| known(info.columns.get(n), text, &mut loader)),
            ),
        }
        loader.push(relation, &tuple).map_err(|cause| FilesError::Line {
            path: path.clone(),
            line,
            cause: cause.into(),
        })?;
    }
    loader.finish();
    Ok(())
}

/// All that stands on the standard input, within the limit of a file of facts.
fn standard_input() -> std::io::Result<String> {
    let mut text = String::new();
    std::io::stdin().lock().take(MAX_FACTS_BYTES + 1).read_to_string(&mut text)?;
    match text.len() as u64 > MAX_FACTS_BYTES {
        true => {
            Err(FileFault::TooLarge { bytes: text.len() as u64, limit: MAX_FACTS_BYTES }.into_io())
        }
        false => Ok(text),
    }
}

/// The records of a text: one a line, but that a value in quotes may go over several.
struct Records<'a> {
    rest: &'a str,
    line: usize,
    parameters: &'a Parameters,
    /// Some column holds records, whose commas part no columns.
    has_records: bool,
}

impl<'a> Records<'a> {
    /// The next record's values, and its first line from 1.
    fn next(&mut self, values: &mut Vec<Cow<'a, str>>) -> Option<usize> {
        values.clear();
        if self.rest.is_empty() {
            return None;
        }
        let first = self.line + 1;
        let delimiter = delimiter(self.parameters);
        loop {
            let (value, behind) = match self.rest.strip_prefix('"') {
                Some(inside) if is_quoted(self.parameters) => unquoted(inside),
                _ => {
                    let line = self.rest.find('\n').unwrap_or(self.rest.len());
                    let line = &self.rest[..line];
                    let whole = self.has_records.then(|| behind_record(line, delimiter)).flatten();
                    let end = whole.or_else(|| line.find(delimiter)).unwrap_or(line.len());
                    (Cow::Borrowed(&self.rest[..end]), &self.rest[end..])
                }
            };
            self.line += value.matches('\n').count();
            if let Some(more) = behind.strip_prefix(delimiter) {
                values.push(value);
                self.rest = more;
                continue;
            }
            // Behind a closing quote nothing else may stand; what does is left to the next column's fault.
            let end = behind.find('\n').unwrap_or(behind.len());
            let value = match value {
                Cow::Borrowed(text) => Cow::Borrowed(text.strip_suffix('\r').unwrap_or(text)),
                owned => owned,
            };
            values.push(value);
            self.line += 1;
            self.rest = behind.get(end + 1..).unwrap_or_default();
            return Some(first);
        }
    }
}

/// Where a record that a line begins with ends: at the delimiter behind its brackets, or with the line. None for what is
/// no record, or is left open.
fn behind_record(line: &str, delimiter: &str) -> Option<usize> {
    if !line.trim_start().starts_with(['[', '$']) {
        return None;
    }
    let (mut depth, mut is_text) = (0_usize, false);
    let mut letters = line.char_indices();
    while let Some((at, letter)) = letters.next() {
        if depth == 0 && line[at..].starts_with(delimiter) {
            return Some(at);
        }
        match letter {
            '\\' if is_text => {
                letters.next();
            }
            '"' => is_text = !is_text,
            _ if is_text => {}
            '[' | '(' => depth += 1,
            ']' | ')' => depth = depth.checked_sub(1)?,
            _ => {}
        }
    }
    (depth == 0 && !is_text).then_some(line.len())
}

/// The value up to the closing quote, two quotes standing for one, and what follows.
fn unquoted(inside: &str) -> (Cow<'_, str>, &str) {
    let mut value = String::new();
    let mut rest = inside;
    while let Some(at) = rest.find('"') {
        value.push_str(&rest[..at]);
        rest = &rest[at + 1..];
        match rest.strip_prefix('"') {
            Some(more) => {
                value.push('"');
                rest = more;
            }
            None => return (Cow::Owned(value), rest),
        }
    }
    value.push_str(rest);
    (Cow::Owned(value), "")
}

/// What stands for no number stays a symbol, and is refused with its column.
fn known(column: Option<&Column>, text: &str, loader: &mut Loader<'_>) -> Known {
    let value = match column.map(|column| column.kind) {
        Some(Kind::Number) => text.trim().parse().ok().map(|number| loader.number(number)),
        // Soufflé reads 0x and 0b in files for these alone.
        Some(Kind::Unsigned) => whole(text).map(|number| loader.number(number)),
        Some(Kind::Float) => {
            let text = text.trim();
            let decimal = text.parse().ok().or_else(|| Decimal::of_powers(text));
            decimal.map(|decimal| loader.decimal(decimal))
        }
        Some(kind @ Kind::Record(_)) => loader.record(text, kind),
        _ => None,
    };
    value.unwrap_or_else(|| loader.symbol(text))
}

/// The columns' names.
fn header(info: &RelationInfo, parameters: &Parameters) -> String {
    let names: Vec<&str> = info.columns.iter().map(|column| column.name.as_str()).collect();
    names.join(delimiter(parameters))
}

/// The relation's lines: its tuples in order.
fn lines(
    derived: &Derived,
    relation: RelationId,
    info: &RelationInfo,
    parameters: &Parameters,
    line: &mut dyn FnMut(&str) -> std::io::Result<()>,
) -> std::io::Result<()> {
    let delimiter = delimiter(parameters);
    if info.columns.is_empty() {
        // Soufflé writes the tuple of no columns so.
        let holds = derived.len(relation).is_ok_and(|len| len > 0);
        return if holds { line("()") } else { Ok(()) };
    }
    let mut text = String::new();
    derived.each_sorted(relation, &mut |tuple| {
        text.clear();
        for n in 0..tuple.arity() {
            text.push_str(if n == 0 { "" } else { delimiter });
            let start = text.len();
            let is_quoted = is_quoted(parameters);
            tuple.write(n, is_quoted, &mut text);
            // As Soufflé does, numbers alone stand without quotes.
            if is_quoted && matches!(info.columns[n].kind, Kind::Symbol | Kind::Record(_)) {
                let value = text.split_off(start).replace('"', "\"\"");
                let _ = write!(text, "\"{value}\"");
            }
        }
        line(&text)
    })
}

fn write(
    derived: &Derived,
    relation: RelationId,
    info: &RelationInfo,
    parameters: &Parameters,
    path: &Path,
) -> std::io::Result<()> {
    write_file_with(path, |file| {
        if has_headers(parameters) {
            file.write_all(header(info, parameters).as_bytes())?;
            file.write_all(b"\n")?;
        }
        lines(derived, relation, info, parameters, &mut |line| {
            file.write_all(line.as_bytes())?;
            file.write_all(b"\n")
        })
    })
}

fn print(
    derived: &Derived,
    relation: RelationId,
    info: &RelationInfo,
    parameters: &Parameters,
    out: &mut String,
) {
    let _ = writeln!(out, "---------------\n{}", info.name);
    if has_headers(parameters) {
        let _ = writeln!(out, "{}", header(info, parameters));
    }
    let _ = writeln!(out, "===============");
    let done = lines(derived, relation, info, parameters, &mut |line| {
        out.push_str(line);
        out.push('\n');
        Ok(())
    });
    done.expect("text grows without error");
    let _ = writeln!(out, "===============");
}

#[cfg(test)]
mod tests {
    use super::*;

    const PROGRAM: &str = r#"
.decl дверь(a: symbol, b: symbol, см: number)
.input дверь(filename="двери.tsv")
.decl путь(a: symbol, b: symbol) = way
.output путь
.printsize путь
путь(A, B) :- дверь(A, B, W), W >= 60.
путь(A, C) :- путь(A, B), дверь(B, C, W), W >= 60.
"#;

    fn run(facts: &str) -> (Result<FilesReport, FilesError>, String) {
        let folder = tempfile::tempdir().unwrap();
        let program = folder.path().join("программа.dl");
        std::fs::write(&program, PROGRAM).unwrap();
        std::fs::write(folder.path().join("двери.tsv"), facts).unwrap();
        let report = run_files(&program, folder.path(), folder.path(), Limits::default());
        let written = std::fs::read_to_string(folder.path().join("путь.csv")).unwrap_or_default();
        (report, written)
    }

    /// A record's commas are its own, also where commas part the columns.
    #[test]
    fn records_stand_whole_in_files_parted_by_commas() {
        let folder = tempfile::tempdir().unwrap();
        let program = folder.path().join("program.dl");
        let text = r#"
            .type P = [n: number, t: symbol]
            .type T = Leaf {} | Node {l: T, n: number}
            .decl a(s: symbol, p: P, t: T, q: P)
            .input a(delimiter=",") .input a(delimiter=", ", filename="b.facts")
            .decl out(s: symbol, p: P, t: T, q: P) .output out
            out(S, P, T, Q) :- a(S, P, T, Q)."#;
        std::fs::write(&program, text).unwrap();
        let one = "x[,[1, a], $Node($Node($Leaf, 2),3) ,nil\n";
        std::fs::write(folder.path().join("a.facts"), one).unwrap();
        std::fs::write(folder.path().join("b.facts"), "y, [2, b], $Leaf, [3, \"c], d\"]\n")
            .unwrap();
        run_files(&program, folder.path(), folder.path(), Limits::default()).unwrap();
        let written = std::fs::read_to_string(folder.path().join("out.csv")).unwrap();
        let all = "x[\t[1, a]\t$Node($Node($Leaf, 2), 3)\tnil\ny\t[2, b]\t$Leaf\t[3, c], d]\n";
        assert_eq!(written, all);
        std::fs::write(folder.path().join("a.facts"), "x,[1, a,$Leaf,nil\n").unwrap();
        let fault = run_files(&program, folder.path(), folder.path(), Limits::default());
        assert!(matches!(fault, Err(FilesError::Line { line: 1, .. })));
    }

    /// What is written in quotes is read again as it was: texts with any sign, alone and within records.
    #[test]
    fn quoted_files_are_read_as_they_were_written() {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        let text = r#"
            .type P = [n: number, t: symbol, rest: P]
            .type T = Leaf {} | Node {t: symbol, n: number}
            .decl a(s: symbol, n: number, p: P, t: T, f: float)
            .input a(rfc4180=true)
            .output a(rfc4180=true, filename="out.facts")"#;
        std::fs::write(at("program.dl"), text).unwrap();
        let given = r#"x,1,nil,$Leaf,1.5
"a,""b
c",-2,"[1, ""]\""\\"", [2, , nil]]","$Node( """" ,3)",0
"#;
        std::fs::write(at("a.facts"), given).unwrap();
        run_files(&at("program.dl"), folder.path(), folder.path(), Limits::default()).unwrap();
        let written = std::fs::read_to_string(at("out.facts")).unwrap();
        let all = r#""a,""b
c",-2,"[1, ""]\""\\"", [2, """", nil]]","$Node("""", 3)",0
"x",1,"nil","$Leaf",1.5
"#;
        assert_eq!(written, all);
        std::fs::rename(at("out.facts"), at("a.facts")).unwrap();
        run_files(&at("program.dl"), folder.path(), folder.path(), Limits::default()).unwrap();
        assert_eq!(std::fs::read_to_string(at("out.facts")).unwrap(), written);
    }

    #[test]
    fn facts_are_read_and_results_written() {
        let (report, written) = run("А\tБ\t80\nБ\tВ\t90\nВ\tГ\t50\n");
        assert_eq!(report.unwrap().sizes, [("путь".to_owned(), 3)]);
        assert_eq!(written, "А\tБ\nА\tВ\nБ\tВ\n");
    }

    #[test]
    fn a_bad_line_is_named() {
        let (report, _) = run("А\tБ\t80\nБ\tВ\tшироко\n");
        let message = report.unwrap_err().to_string();
        assert!(
            message
                .ends_with("двери.tsv:2: «дверь», столбец «см»: нужен тип number, а дано «широко»"),
            "{message}"
        );
        let (report, _) = run("А\n");
        let Err(FilesError::Line { line, cause, .. }) = report else {
            panic!("a short line is refused")
        };
        assert!(line == 1 && matches!(*cause, FactError::Arity { .. }));
    }
}
