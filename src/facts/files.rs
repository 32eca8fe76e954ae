//! Programs run over Soufflé's files: a line for each tuple, a tab between values.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use super::fault::FileFaults;
use super::file_input::read;
use super::file_output::{print, write};
use super::files_error::{FilesError, file_error};
use super::layout::{file_columns, file_name, parameter};
use super::limits::Limits;
use super::program::Program;
use super::relations::{Parameters, RelationId, RelationInfo};
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
