//! How the file of a relation is laid out, by the parameters of `.input` and `.output`.

use super::relations::{Parameters, RelationInfo};

pub(super) fn parameter<'a>(parameters: &'a Parameters, name: &str) -> Option<&'a str> {
    parameters.iter().find(|(known, _)| known == name).map(|(_, value)| value.as_str())
}

pub(super) fn has_headers(parameters: &Parameters) -> bool {
    parameter(parameters, "headers") == Some("true")
}

/// Values in quotes where they hold a delimiter, a quote or a line's end.
pub(super) fn is_quoted(parameters: &Parameters) -> bool {
    parameter(parameters, "rfc4180") == Some("true")
}

/// `1:0`: which of the file's columns, from 0, each column of the relation is read from.
pub(super) fn file_columns(value: &str, columns: usize) -> Option<Vec<usize>> {
    let places: Option<Vec<usize>> = value.split(':').map(|place| place.parse().ok()).collect();
    places.filter(|places| places.len() == columns)
}

pub(super) fn file_name(info: &RelationInfo, parameters: &Parameters, extension: &str) -> String {
    parameter(parameters, "filename")
        .map_or_else(|| format!("{}.{extension}", info.name), str::to_owned)
}

pub(super) fn delimiter(parameters: &Parameters) -> &str {
    let usual = if is_quoted(parameters) { "," } else { "\t" };
    parameter(parameters, "delimiter").filter(|text| !text.is_empty()).unwrap_or(usual)
}
