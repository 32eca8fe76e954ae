//! Tuples into a file, or printed: a line for each, in order.

use std::fmt::Write as _;
use std::path::Path;

use super::derived::Derived;
use super::layout::{delimiter, has_headers, is_quoted};
use super::program::Kind;
use super::relations::{Parameters, RelationId, RelationInfo};
use crate::units::write_file_with;

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

pub(super) fn write(
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

pub(super) fn print(
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
