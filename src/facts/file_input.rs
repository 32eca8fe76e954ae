//! Tuples from a file: a line for each, values parted by a delimiter, or in quotes (RFC 4180).

use std::borrow::Cow;
use std::io::Read as _;
use std::path::{Path, PathBuf};

use super::database::{Database, Known, Loader};
use super::decimal::Decimal;
use super::files_error::{FilesError, file_error};
use super::layout::{delimiter, file_columns, file_name, has_headers, is_quoted, parameter};
use super::program::Kind;
use super::relations::{Column, Parameters, RelationId, RelationInfo};
use super::value::whole;
use crate::units::{FileFault, read_text};

/// Facts of one relation.
const MAX_FACTS_BYTES: u64 = 256 << 20;

pub(super) fn read(
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
