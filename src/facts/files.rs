//! Programs run over Soufflé's files: a line for each tuple, a tab between values.

use std::fmt::Write as _;
use std::io::{BufWriter, Write as _};
use std::path::{Path, PathBuf};

use miette::Diagnostic;
use thiserror::Error;

use super::database::{Database, FactError};
use super::derived::Derived;
use super::evaluate::EvaluateError;
use super::fault::{Faults, FileFaults};
use super::program::{Parameters, Program, RelationId, RelationInfo};
use super::word::Value;
use crate::units::Source;

/// Why a program over files has no result.
#[derive(Debug, Error, Diagnostic)]
pub enum FilesError {
    #[error(transparent)]
    #[diagnostic(transparent)]
    Program(#[from] Faults),
    /// A file or folder that cannot be read or written.
    #[error("{path}: {cause}", path = path.display())]
    #[diagnostic(
        code(facts::file),
        help("проверьте имя и права: факты отношения r лежат в файле r.facts")
    )]
    File {
        path: PathBuf,
        #[source]
        cause: std::io::Error,
    },
    /// A line of facts that does not fit its relation.
    #[error("{path}:{line}: {cause}", path = path.display())]
    #[diagnostic(code(facts::line), help("значения разделяются табуляцией, по одному на столбец"))]
    Line {
        path: PathBuf,
        line: usize,
        #[source]
        cause: Box<FactError>,
    },
    /// A parameter of `.input` or `.output` that asks for what is not done here.
    #[error("«{relation}»: не поддерживается {name}={value}")]
    #[diagnostic(
        code(facts::parameter),
        help("есть IO=file и для .output IO=stdout, filename, delimiter, headers")
    )]
    Parameter { relation: String, name: String, value: String },
    #[error(transparent)]
    #[diagnostic(transparent)]
    Evaluate(#[from] EvaluateError),
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
}

/// Runs a program: `.input` relations from `facts_dir`, `.output` relations into `out_dir`.
///
/// A relation `r` is read from `r.facts` and written to `r.csv` unless its directive says `filename="…"`;
/// `delimiter="…"` replaces the tab, `headers=true` stands for a first line with the columns' names, and
/// `IO=stdout` prints instead of writing a file.
///
/// # Errors
/// [`FilesError`] with the place in the program or in the file of facts.
pub fn run_files(
    program: &Path,
    facts_dir: &Path,
    out_dir: &Path,
) -> Result<FilesReport, FilesError> {
    let source = Source::read(program).map_err(|cause| file_error(program, cause))?;
    let program = Program::parse(&source)?;
    for (_, info) in program.relations() {
        for (parameters, may_print) in [(&info.input, false), (&info.output, true)] {
            parameters.iter().try_for_each(|known| check(info, known, may_print))?;
        }
    }
    let mut database = program.database();
    for (relation, info) in program.relations() {
        if let Some(parameters) = &info.input {
            read(&mut database, relation, info, parameters, facts_dir)?;
        }
    }
    let derived = program.evaluate(&database)?;
    let mut report =
        FilesReport { warnings: program.warnings().to_vec(), ..FilesReport::default() };
    for (relation, info) in program.relations() {
        if info.print_size {
            let size = derived.len(relation).expect("the relation is the program's own");
            report.sizes.push((info.name.clone(), size));
        }
        if let Some(parameters) = &info.output {
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
            "IO" => value == "file" || may_print && value == "stdout",
            "headers" => matches!(value.as_str(), "true" | "false"),
            "filename" | "delimiter" => true,
            _ => false,
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

fn file_name(info: &RelationInfo, parameters: &Parameters, extension: &str) -> String {
    parameter(parameters, "filename")
        .map_or_else(|| format!("{}.{extension}", info.name), str::to_owned)
}

fn delimiter(parameters: &Parameters) -> &str {
    parameter(parameters, "delimiter").filter(|text| !text.is_empty()).unwrap_or("\t")
}

fn read(
    database: &mut Database,
    relation: RelationId,
    info: &RelationInfo,
    parameters: &Parameters,
    facts_dir: &Path,
) -> Result<(), FilesError> {
    let path = facts_dir.join(file_name(info, parameters, "facts"));
    let text = std::fs::read_to_string(&path).map_err(|cause| file_error(&path, cause))?;
    for (n, line) in text.lines().enumerate().skip(usize::from(has_headers(parameters))) {
        let tuple = tuple_of(line, info, delimiter(parameters));
        let inserted = database.insert(relation, &tuple);
        inserted.map_err(|cause| FilesError::Line {
            path: path.clone(),
            line: n + 1,
            cause: cause.into(),
        })?;
    }
    Ok(())
}

/// What stands for no number stays a symbol, and is refused with its column by the database.
fn tuple_of(line: &str, info: &RelationInfo, delimiter: &str) -> Vec<Value> {
    if info.columns.is_empty() && (line.is_empty() || line == "()") {
        return Vec::new();
    }
    let values = line.split(delimiter).enumerate().map(|(n, text)| {
        let is_number = info.columns.get(n).is_some_and(|column| column.kind.is_number());
        match text.trim().parse() {
            Ok(number) if is_number => Value::Number(number),
            _ => Value::from(text),
        }
    });
    values.collect()
}

/// The relation's lines: the columns' names where they are asked for, then the tuples in order.
fn lines<'a>(
    derived: &'a Derived,
    relation: RelationId,
    info: &'a RelationInfo,
    parameters: &'a Parameters,
) -> impl Iterator<Item = String> + 'a {
    let delimiter = delimiter(parameters);
    let names: Vec<&str> = info.columns.iter().map(|column| column.name.as_str()).collect();
    let header = has_headers(parameters).then(|| names.join(delimiter));
    let tuples = derived.sorted(relation).expect("the relation is the program's own");
    let line = move |tuple: Vec<Value>| {
        let mut line = String::new();
        for (n, value) in tuple.iter().enumerate() {
            let before = if n == 0 { "" } else { delimiter };
            let _ = write!(line, "{before}{value}");
        }
        // Soufflé writes the tuple of no columns so.
        if tuple.is_empty() { "()".to_owned() } else { line }
    };
    header.into_iter().chain(tuples.into_iter().map(line))
}

fn write(
    derived: &Derived,
    relation: RelationId,
    info: &RelationInfo,
    parameters: &Parameters,
    path: &Path,
) -> std::io::Result<()> {
    let mut file = BufWriter::new(std::fs::File::create(path)?);
    for line in lines(derived, relation, info, parameters) {
        writeln!(file, "{line}")?;
    }
    file.flush()
}

fn print(
    derived: &Derived,
    relation: RelationId,
    info: &RelationInfo,
    parameters: &Parameters,
    out: &mut String,
) {
    let _ = writeln!(out, "---------------\n{}\n===============", info.name);
    for line in lines(derived, relation, info, parameters) {
        let _ = writeln!(out, "{line}");
    }
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
        let report = run_files(&program, folder.path(), folder.path());
        let written = std::fs::read_to_string(folder.path().join("путь.csv")).unwrap_or_default();
        (report, written)
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
