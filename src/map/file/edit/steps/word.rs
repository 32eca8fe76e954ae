//! One step of an edit file as it stands: its verb, its fields, and what is wrong with them.

use crate::fault::MapError;
use crate::file::decode::{
    LIST, NOTHING, NUMBER, TABLE, TEXT, TWO_OR_THREE, a_number, a_text, likely, shortened,
};
use crate::file::node::{Entry, Misprint, Node, Span, Value};
use crate::units::Bilingual;

/// A step's work, or its fault.
pub(super) type Outcome<T> = Result<T, Box<Misprint>>;
pub(super) type Done = Outcome<()>;

/// One step: its verb with what it is done to, and its other fields.
pub(super) struct Step<'n> {
    pub(super) node: &'n Node,
    pub(super) verb: &'n Entry,
}

impl<'n> Step<'n> {
    /// What the verb is done to.
    pub(super) fn what(&self) -> Outcome<&'n str> {
        text_of(&self.verb.node)
    }

    pub(super) fn field(&self, name: &str) -> Option<&'n Node> {
        self.node.entry(name).map(|e| &e.node)
    }

    pub(super) fn required(&self, name: &'static str) -> Outcome<&'n Node> {
        self.field(name)
            .ok_or_else(|| misprint(MapError::MissingField { field: name }, &self.verb.key_span))
    }

    /// The fields of these names, as they are.
    pub(super) fn copies(&self, names: &[&str]) -> Vec<Entry> {
        self.node.entries().iter().filter(|e| names.contains(&e.key.as_str())).cloned().collect()
    }

    pub(super) fn span(&self) -> &'n Span {
        &self.verb.node.span
    }
}

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

pub(super) fn wrong_kind(node: &Node, expected: (&'static str, &'static str)) -> Box<Misprint> {
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

pub(super) fn number(node: &Node) -> Outcome<f64> {
    match node.value {
        Value::Integer(n) => Ok(n as f64),
        Value::Float(x) => Ok(x),
        _ => Err(wrong_kind(node, NUMBER)),
    }
}

pub(super) fn numbers(node: &Node) -> Outcome<Vec<f64>> {
    let list: Vec<f64> = node.elements().iter().map(number).collect::<Result<_, _>>()?;
    if (2..=3).contains(&list.len()) { Ok(list) } else { Err(wrong_kind(node, TWO_OR_THREE)) }
}

/// A number as a person would have written it.
pub(super) fn written(x: f64) -> Value {
    if x.fract() == 0.0 && x.abs() < 1e9 { Value::Integer(x as i64) } else { Value::Float(x) }
}

pub(super) fn table(span: &Span, entries: Vec<Entry>) -> Node {
    Node { span: span.clone(), value: Value::Table(entries) }
}
