//! What is wrong with the words of an edit.

use std::collections::HashSet;

use super::super::decode::{LIST, NOTHING, TABLE, TEXT, a_number, a_text, likely, shortened};
use super::super::node::{Entry, Misprint, Node, Span, Value};
use crate::fault::MapError;
use crate::units::{Bilingual, Piece};

/// What is found while a text is read.
pub(super) struct Slips<'e> {
    pub(super) misprints: &'e mut Vec<Misprint>,
    /// Entries and lines that could not be read.
    pub(super) left_out: &'e mut HashSet<Span>,
}

/// A piece of work, or its fault.
pub(super) type Outcome<T> = Result<T, Box<Misprint>>;
pub(super) type Done = Outcome<()>;

pub(super) fn misprint(error: MapError, span: &Span) -> Box<Misprint> {
    Box::new(Misprint { error, span: Some(span.clone()) })
}

pub(super) fn unknown_field(entry: &Entry, known: &[&str]) -> Box<Misprint> {
    let error = MapError::UnknownField {
        field: shortened(&entry.key),
        nearest: likely(&entry.key, known),
        expected: known.join(", "),
    };
    misprint(error, &entry.key_span)
}

pub(super) fn text_of(node: &Node) -> Outcome<&str> {
    node.text().ok_or_else(|| wrong_kind(node, TEXT))
}

pub(super) fn wrong_kind(node: &Node, expected: Piece) -> Box<Misprint> {
    let found = match &node.value {
        Value::Nothing => NOTHING.into(),
        Value::Bool(b) => Bilingual::quoted(&b.to_string()),
        Value::Integer(n) => a_number(n),
        Value::Float(x) => a_number(x),
        Value::Text(text) => a_text(text),
        Value::List(_) => LIST.into(),
        Value::Table(_) => TABLE.into(),
    };
    misprint(MapError::WrongKind { found, expected: expected.into() }, &node.span)
}
