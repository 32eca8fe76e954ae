//! A parsed map file before it means anything: values with their places in the text, whatever the format.

use std::fmt;
use std::ops::Range;

use serde::de::{MapAccess, SeqAccess, Visitor};
use serde::{Deserialize, Deserializer};
use serde_saphyr::{Location, Spanned};
use toml::de::{DeTable, DeValue};

use super::Format;
use super::misprint::in_both;
use crate::fault::MapError;
use crate::units::{Bilingual, InOrder as _};

/// Bytes of the text.
pub(super) type Span = Range<usize>;

/// A value and its place.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Node {
    pub(super) span: Span,
    pub(super) value: Value,
}

/// A value; the entries of a table in the order of the text.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Value {
    Nothing,
    Bool(bool),
    Integer(i64),
    Float(f64),
    Text(String),
    List(Vec<Node>),
    Table(Vec<Entry>),
}

/// A key with its value.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Entry {
    pub(super) key: String,
    pub(super) key_span: Span,
    pub(super) node: Node,
}

impl Node {
    pub(super) fn entries(&self) -> &[Entry] {
        if let Value::Table(entries) = &self.value { entries } else { &[] }
    }

    pub(super) fn entry(&self, key: &str) -> Option<&Entry> {
        self.entries().iter().find(|entry| entry.key == key)
    }

    pub(super) fn entry_mut(&mut self, key: &str) -> Option<&mut Entry> {
        let Value::Table(entries) = &mut self.value else { return None };
        entries.iter_mut().find(|entry| entry.key == key)
    }

    pub(super) fn elements(&self) -> &[Self] {
        if let Value::List(elements) = &self.value { elements } else { &[] }
    }

    pub(super) fn text(&self) -> Option<&str> {
        if let Value::Text(text) = &self.value { Some(text) } else { None }
    }
}

/// A fault of the notation itself.
#[derive(Debug, Clone)]
pub(super) struct Misprint {
    pub(super) error: MapError,
    pub(super) span: Option<Span>,
}

/// Parses a text into its tree.
///
/// # Errors
/// Every fault of the notation that the parser finds.
pub(super) fn parse(text: &str, format: Format) -> Result<Node, Vec<Misprint>> {
    match format {
        Format::Toml => parse_toml(text),
        Format::Yaml | Format::Json => parse_yaml(text, format),
    }
}

fn parse_toml(text: &str) -> Result<Node, Vec<Misprint>> {
    let (table, errors) = DeTable::parse_recoverable(text);
    if !errors.is_empty() {
        return Err(toml_faults(text));
    }
    let span = table.span();
    Ok(Node { span, value: toml_table(table.into_inner()) })
}

/// Bytes that are parsed in search of further faults, at the most.
const PARSED_AGAIN: usize = 8 << 20;

/// The first fault of a text, and of what stands behind it the first again: of a bracket that is never closed the
/// parser would tell with every line that follows.
fn toml_faults(text: &str) -> Vec<Misprint> {
    let mut faults = Vec::new();
    let mut start = 0;
    let mut parsed = 0;
    // What a person wrote is read again behind each fault; of a text of megabytes the first faults are enough.
    while faults.len() < MOST_FAULTS && parsed <= PARSED_AGAIN {
        parsed += text.len() - start;
        let (_, errors) = DeTable::parse_recoverable(&text[start..]);
        let begins = |e: &toml::de::Error| e.span().map_or(0, |span| span.start);
        let Some(first) = errors.into_iter().min_by_key(begins) else { break };
        let span = first.span().map(|span| span.start + start..span.end + start);
        let behind = span.as_ref().map_or(text.len(), |span| span.start.max(start));
        faults.push(Misprint {
            error: MapError::Syntax { format: "TOML", message: in_both(first.message()) },
            span,
        });
        let Some(next) = next_statement(text, behind) else { break };
        start = next;
    }
    faults
}

/// Where the next line begins that looks like a header, or a key with its value, and is not indented.
fn next_statement(text: &str, behind: usize) -> Option<usize> {
    let is_key = |key: &str| {
        let is_sign = |c: char| c.is_alphanumeric() || "_-.\"' ".contains(c);
        !key.trim().is_empty() && key.chars().all(is_sign)
    };
    let is_statement = |line: &str| {
        let code = line.split('#').next().unwrap_or(line).trim_end();
        let inner = code.trim_start_matches('[').trim_end_matches(']');
        let is_header = code.starts_with('[') && code.ends_with(']') && is_key(inner);
        is_header
            || !line.starts_with(char::is_whitespace)
                && code.split_once('=').is_some_and(|(key, _)| is_key(key))
    };
    let mut at = behind + text[behind..].find('\n')? + 1;
    for line in text[at..].split_inclusive('\n') {
        if is_statement(line) {
            return Some(at);
        }
        at += line.len();
    }
    None
}

fn toml_table(table: DeTable<'_>) -> Value {
    let mut entries: Vec<_> = table
        .into_iter()
        .map(|(key, value)| {
            let span = value.span();
            Entry {
                key_span: key.span(),
                key: key.into_inner().into_owned(),
                node: Node { span, value: toml_value(value.into_inner()) },
            }
        })
        .collect();
    // The parser sorts keys by their letters; ids follow the order of the text.
    entries.order_by_key(|entry| entry.key_span.start);
    Value::Table(entries)
}

fn toml_value(value: DeValue<'_>) -> Value {
    match value {
        DeValue::String(text) => Value::Text(text.into_owned()),
        DeValue::Integer(n) => match i64::from_str_radix(n.as_str(), n.radix()) {
            Ok(n) => Value::Integer(n),
            Err(_) => Value::Float(f64::INFINITY), // refused where a number is wanted, as too large
        },
        DeValue::Float(x) => Value::Float(x.as_str().parse().unwrap_or(f64::NAN)),
        DeValue::Boolean(b) => Value::Bool(b),
        DeValue::Datetime(time) => Value::Text(time.to_string()),
        DeValue::Array(elements) => Value::List(
            elements
                .into_iter()
                .map(|e| Node { span: e.span(), value: toml_value(e.into_inner()) })
                .collect(),
        ),
        DeValue::Table(table) => toml_table(table),
    }
}

/// Faults of one text after which no more are looked for.
const MOST_FAULTS: usize = 50;

/// How deep tables may lie within tables: twice what the format needs. The reader's recursion takes much of the stack.
const MOST_DEPTH: usize = 16;

/// YAML, and JSON as its subset.
fn parse_yaml(text: &str, format: Format) -> Result<Node, Vec<Misprint>> {
    let name = if format == Format::Json { "JSON" } else { "YAML" };
    let options = serde_saphyr::options! {
        // A room may be named «Y» or «No»: only true and false are truth values.
        strict_booleans: true,
        budget: serde_saphyr::budget! {
            max_depth: MOST_DEPTH,
            flow_nesting_limit: MOST_DEPTH,
            // Forty thousand replicas, two dozen values each.
            max_nodes: 2_000_000,
            max_events: 4_000_000,
            max_aliases: 1_000,
        },
        // Anchors spare a person repetitions; they need not multiply a text.
        alias_limits: serde_saphyr::alias_limits! { max_total_replayed_events: 10_000 },
    };
    let root: Spanned<Tree> = serde_saphyr::from_str_with_options(text, options).map_err(|e| {
        let e = e.without_snippet();
        vec![Misprint {
            error: MapError::Syntax {
                format: name,
                message: Bilingual::new(e.to_string(), e.to_string()),
            },
            span: e.location().map(|at| span_in(text, at)),
        }]
    })?;
    Ok(root.into())
}

/// The place of a fault, which the reader may know by line and column only.
fn span_in(text: &str, at: Location) -> Span {
    if at.span().byte_offset().is_some() && at.span().byte_len().is_some() {
        return span(at);
    }
    let line_start: usize =
        text.split_inclusive('\n').take((at.line() as usize).saturating_sub(1)).map(str::len).sum();
    let line = &text[line_start..];
    let column = (at.column() as usize).saturating_sub(1);
    let start = line_start + line.char_indices().nth(column).map_or(line.len(), |(i, _)| i);
    start..start
}

fn span(at: Location) -> Span {
    let start = at.span().byte_offset().unwrap_or(0) as usize;
    start..start + at.span().byte_len().unwrap_or(0) as usize
}

/// What the YAML reader finds, whatever it is.
struct Tree(Value);

impl From<Spanned<Tree>> for Node {
    fn from(tree: Spanned<Tree>) -> Self {
        Self { span: span(tree.referenced), value: tree.value.0 }
    }
}

impl<'de> Deserialize<'de> for Tree {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        deserializer.deserialize_any(AnyValue).map(Tree)
    }
}

struct AnyValue;

impl<'de> Visitor<'de> for AnyValue {
    type Value = Value;

    fn expecting(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("a value")
    }
    fn visit_unit<E>(self) -> Result<Value, E> {
        Ok(Value::Nothing)
    }
    fn visit_none<E>(self) -> Result<Value, E> {
        Ok(Value::Nothing)
    }
    fn visit_bool<E>(self, b: bool) -> Result<Value, E> {
        Ok(Value::Bool(b))
    }
    fn visit_i64<E>(self, n: i64) -> Result<Value, E> {
        Ok(Value::Integer(n))
    }
    fn visit_u64<E>(self, n: u64) -> Result<Value, E> {
        Ok(i64::try_from(n).map_or(Value::Float(n as f64), Value::Integer))
    }
    fn visit_f64<E>(self, x: f64) -> Result<Value, E> {
        Ok(Value::Float(x))
    }
    fn visit_str<E>(self, text: &str) -> Result<Value, E> {
        Ok(Value::Text(text.to_owned()))
    }
    fn visit_string<E>(self, text: String) -> Result<Value, E> {
        Ok(Value::Text(text))
    }
    fn visit_seq<A: SeqAccess<'de>>(self, mut seq: A) -> Result<Value, A::Error> {
        let mut elements = Vec::new();
        while let Some(element) = seq.next_element::<Spanned<Tree>>()? {
            elements.push(element.into());
        }
        Ok(Value::List(elements))
    }
    fn visit_map<A: MapAccess<'de>>(self, mut map: A) -> Result<Value, A::Error> {
        let mut entries = Vec::new();
        while let Some((key, node)) = map.next_entry::<Spanned<String>, Spanned<Tree>>()? {
            entries.push(Entry {
                key_span: span(key.referenced),
                key: key.value,
                node: node.into(),
            });
        }
        Ok(Value::Table(entries))
    }
}
