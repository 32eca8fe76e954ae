//! Programs run over Soufflé's files: a line for each tuple, a tab between values.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::fault::FileFaults;
use super::file_input::read;
use super::file_output::{print, write};
use super::files_error::{FilesError, file_error};
use super::layout::{file_columns, file_name, parameter};
use super::limits::Limits;
use super::program::{Parameters, Program, RelationId, RelationInfo};
use super::texts::includes;
use super::trace::{self, RuleTrace};
use crate::units::Source;

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

#[cfg(test)]
mod tests {
    use super::*;
    use crate::FactError;

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
