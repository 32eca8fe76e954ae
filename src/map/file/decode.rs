//! From a tree of values to the types of the file, with every fault in its place.
//!
//! serde gives up at the first fault. Here the entry or list element in which a fault lies is noted and left out, and
//! the table is read again without it, until nothing is left to complain of.

use std::collections::HashSet;
use std::fmt;

use serde::Deserialize;
use serde::de::value::StrDeserializer;
use serde::de::{
    self, DeserializeSeed, Deserializer, Expected, IntoDeserializer, Unexpected, Visitor,
};

use super::node::{Entry, Misprint, Node, Span, Value};
use crate::fault::MapError;
use crate::units::{Bilingual, Piece, nearest_name, said, word};

/// Faults of one table after which its reading ends.
const MOST_FAULTS: usize = 50;

/// Reads one table; notes its faults and gives what could be read. Adds to `left_out` the places of what could not.
pub(super) fn decode<'n, T: Deserialize<'n>>(
    node: &'n Node,
    name_span: &Span,
    left_out: &mut HashSet<Span>,
    faults: &mut Vec<Misprint>,
) -> Option<T> {
    let most_left_out = left_out.len() + MOST_FAULTS;
    loop {
        let mut fault = match T::deserialize(Reader { node, left_out }) {
            Ok(value) => return Some(value),
            Err(fault) => fault,
        };
        // A table under a header has no place of its own that a person would look at: its name has.
        if fault.span.as_ref().is_none_or(|span| *span == node.span) {
            fault.span = Some(name_span.clone());
        }
        let culprit = fault.culprit.take();
        if !fault.follows {
            faults.push(Misprint { error: *fault.error, span: fault.span });
        }
        if !culprit.is_some_and(|span| left_out.insert(span)) || left_out.len() > most_left_out {
            return None;
        }
    }
}

/// The value for which a word stands.
pub(super) fn word<T: for<'de> Deserialize<'de>>(word: &str) -> Result<T, Box<MapError>> {
    let reader: StrDeserializer<'_, DecodeError> = word.into_deserializer();
    T::deserialize(reader).map_err(|fault| fault.error)
}

/// A fault on its way up; the innermost value sets the place.
#[derive(Debug)]
pub(super) struct DecodeError {
    error: Box<MapError>,
    span: Option<Span>,
    /// The smallest entry or element without which the reading may go on.
    culprit: Option<Span>,
    /// Only a field is missed that was left out for its own fault.
    follows: bool,
}

impl DecodeError {
    fn new(error: MapError) -> Self {
        Self { error: Box::new(error), span: None, culprit: None, follows: false }
    }

    fn without(mut self, culprit: &Span) -> Self {
        self.culprit.get_or_insert_with(|| culprit.clone());
        self
    }

    fn at(mut self, span: &Span) -> Self {
        self.span.get_or_insert_with(|| span.clone());
        self
    }
}

impl fmt::Display for DecodeError {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        self.error.fmt(f)
    }
}

impl std::error::Error for DecodeError {}

impl de::Error for DecodeError {
    fn custom<T: fmt::Display>(message: T) -> Self {
        let message = message.to_string();
        Self::new(MapError::BadValue { message: Bilingual::new(message.clone(), message) })
    }

    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::new(MapError::WrongKind {
            found: found_words(found),
            expected: expected_words(&expected.to_string()),
        })
    }

    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::invalid_type(found, expected)
    }

    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        Self::new(MapError::WrongKind {
            found: list_of(length),
            expected: expected_words(&expected.to_string()),
        })
    }

    fn unknown_variant(word: &str, expected: &'static [&'static str]) -> Self {
        Self::new(MapError::UnknownWord {
            word: shortened(word),
            nearest: likely(word, expected),
            expected: expected.join(", "),
        })
    }

    fn unknown_field(field: &str, expected: &'static [&'static str]) -> Self {
        Self::new(MapError::UnknownField {
            field: shortened(field),
            nearest: likely(field, expected),
            expected: expected.join(", "),
        })
    }

    fn missing_field(field: &'static str) -> Self {
        Self::new(MapError::MissingField { field })
    }

    fn duplicate_field(field: &'static str) -> Self {
        Self::new(MapError::BadValue { message: said!("the-field-is-given-twice", field) })
    }
}

fn found_words(found: Unexpected<'_>) -> Bilingual {
    match found {
        Unexpected::Bool(b) => Bilingual::quoted(&b.to_string()),
        Unexpected::Unsigned(n) => a_number(n),
        Unexpected::Signed(n) => a_number(n),
        Unexpected::Float(x) => a_number(x),
        Unexpected::Str(text) => a_text(text),
        Unexpected::Seq => LIST.into(),
        Unexpected::Map => TABLE.into(),
        Unexpected::Unit | Unexpected::Option => NOTHING.into(),
        other => Bilingual::new(other.to_string(), other.to_string()),
    }
}

pub(super) fn a_number(number: impl fmt::Display) -> Bilingual {
    said!("the-number", number = number.to_string())
}

pub(super) fn a_text(text: &str) -> Bilingual {
    Bilingual::named(word!("the-text"), &shortened(text))
}

pub(super) fn list_of(length: usize) -> Bilingual {
    said!("a-list-of-values", length)
}

/// What a number that is not finite, or larger than any building ([`Cm::LIMIT`](crate::units::Cm::LIMIT)), should be.
pub(super) const MODEST_NUMBER: &str = "a number of modest size";
/// What [`Coordinates`](super::schema::Coordinates) are.
pub(super) const COORDINATES: &str = "coordinates";
pub(super) const TEXT: Piece = word!("a-text");
pub(super) const NUMBER: Piece = word!("a-number");
pub(super) const BOOLEAN: Piece = word!("true-or-false");
pub(super) const LIST: Piece = word!("a-list");
pub(super) const TABLE: Piece = word!("a-table");
pub(super) const NOTHING: Piece = word!("an-empty-value");
pub(super) const TWO_OR_THREE: Piece = word!("two-or-three-numbers-x-y-z");

/// What serde wants, in people's words.
pub(super) fn expected_words(expected: &str) -> Bilingual {
    let words = match expected {
        "a string" | "a borrowed string" => TEXT,
        "f64" => NUMBER,
        MODEST_NUMBER => word!("a-number-from-10000000-to-10000000"),
        COORDINATES => TWO_OR_THREE,
        "u32" | "u8" | "u64" | "i64" => word!("a-whole-number-from-0-up"),
        "a boolean" => BOOLEAN,
        "a sequence" => LIST,
        "a map" => TABLE,
        "an array of length 2" => word!("two-numbers-x-y"),
        _ if expected.starts_with("struct ") => TABLE,
        _ if expected.contains("enum ") => word!("a-word"),
        _ => return Bilingual::new(expected.to_owned(), expected.to_owned()),
    };
    words.into()
}

/// Longer words are nobody's slip of the pen, and comparing them takes long.
pub(super) const LONGEST_WORD: usize = 80;

/// A text fit for a message.
pub(super) fn shortened(text: &str) -> String {
    match text.char_indices().nth(LONGEST_WORD) {
        None => text.to_owned(),
        Some((end, _)) => format!("{}…", &text[..end]),
    }
}

/// What was meant, if anything was.
pub(super) fn likely(word: &str, known: &[&str]) -> Option<String> {
    let is_word = word.len() <= 2 * LONGEST_WORD;
    is_word.then(|| nearest_name(word, known.iter().copied()).map(str::to_owned)).flatten()
}

/// A value, and what is left out of it.
#[derive(Clone, Copy)]
struct Reader<'n, 'o> {
    node: &'n Node,
    left_out: &'o HashSet<Span>,
}

impl<'n, 'o> Reader<'n, 'o> {
    fn inner(&self, node: &'n Node) -> Self {
        Self { node, left_out: self.left_out }
    }

    fn elements(self) -> Elements<'n, 'o> {
        Elements { reader: self, rest: self.node.elements().iter() }
    }

    fn fields(self) -> Fields<'n, 'o> {
        Fields { reader: self, rest: self.node.entries().iter(), current: None }
    }

    /// Gives a fault its place, unless a value within has done so.
    fn placed(self, mut fault: DecodeError) -> DecodeError {
        if let (MapError::MissingField { field }, None) = (&*fault.error, &fault.span) {
            fault.follows = self.node.entry(field).is_some();
        }
        fault.at(&self.node.span)
    }
}

impl<'de> Deserializer<'de> for Reader<'de, '_> {
    type Error = DecodeError;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DecodeError> {
        match &self.node.value {
            Value::Nothing => visitor.visit_unit(),
            Value::Bool(b) => visitor.visit_bool(*b),
            Value::Integer(n) => visitor.visit_i64(*n),
            Value::Float(x) => visitor.visit_f64(*x),
            Value::Text(text) => visitor.visit_borrowed_str(text),
            Value::List(_) => visitor.visit_seq(self.elements()),
            Value::Table(_) => visitor.visit_map(self.fields()),
        }
        .map_err(|fault| self.placed(fault))
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, DecodeError> {
        match self.node.value {
            Value::Nothing => visitor.visit_none(),
            _ => visitor.visit_some(self),
        }
    }

    /// A list of fixed length: none may be left over.
    fn deserialize_tuple<V: Visitor<'de>>(
        self,
        length: usize,
        visitor: V,
    ) -> Result<V::Value, DecodeError> {
        match &self.node.value {
            Value::List(elements) if elements.len() != length => {
                let fault: DecodeError = de::Error::invalid_length(elements.len(), &visitor);
                Err(self.placed(fault))
            }
            _ => self.deserialize_any(visitor),
        }
    }

    /// By names only; serde would take a list for a struct too, by position.
    fn deserialize_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DecodeError> {
        match &self.node.value {
            Value::List(_) => {
                let fault: DecodeError = de::Error::invalid_type(Unexpected::Seq, &visitor);
                Err(self.placed(fault))
            }
            _ => self.deserialize_any(visitor),
        }
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, DecodeError> {
        visitor.visit_newtype_struct(self).map_err(|fault| self.placed(fault))
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        _variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, DecodeError> {
        match &self.node.value {
            Value::Text(word) => {
                let word: StrDeserializer<'_, DecodeError> = word.as_str().into_deserializer();
                visitor.visit_enum(word).map_err(|fault| self.placed(fault))
            }
            _ => self.deserialize_any(visitor),
        }
    }

    serde::forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf
        unit unit_struct seq tuple_struct map identifier ignored_any
    }
}

/// Elements of a list.
struct Elements<'n, 'o> {
    reader: Reader<'n, 'o>,
    rest: std::slice::Iter<'n, Node>,
}

impl<'n> de::SeqAccess<'n> for Elements<'n, '_> {
    type Error = DecodeError;

    fn next_element_seed<T: DeserializeSeed<'n>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, DecodeError> {
        let left_out = self.reader.left_out;
        let Some(node) = self.rest.find(|node| !left_out.contains(&node.span)) else {
            return Ok(None);
        };
        // A coordinate cannot be left out of a point, a line can be left out of a list.
        let is_line = matches!(node.value, Value::Table(_));
        let read = seed.deserialize(self.reader.inner(node)).map(Some);
        read.map_err(|fault| {
            let fault = fault.at(&node.span);
            if is_line { fault.without(&node.span) } else { fault }
        })
    }
}

/// Entries of a table.
struct Fields<'n, 'o> {
    reader: Reader<'n, 'o>,
    rest: std::slice::Iter<'n, Entry>,
    current: Option<&'n Entry>,
}

impl<'n> de::MapAccess<'n> for Fields<'n, '_> {
    type Error = DecodeError;

    fn next_key_seed<K: DeserializeSeed<'n>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, DecodeError> {
        let left_out = self.reader.left_out;
        self.current = self.rest.find(|entry| !left_out.contains(&entry.key_span));
        let Some(entry) = self.current else { return Ok(None) };
        let key: StrDeserializer<'_, DecodeError> = entry.key.as_str().into_deserializer();
        let key = seed.deserialize(key).map(Some);
        key.map_err(|fault| fault.at(&entry.key_span).without(&entry.key_span))
    }

    fn next_value_seed<V: DeserializeSeed<'n>>(
        &mut self,
        seed: V,
    ) -> Result<V::Value, DecodeError> {
        let entry = self.current.take().expect("serde asks for a value after its key");
        let value = seed.deserialize(self.reader.inner(&entry.node));
        value.map_err(|fault| fault.at(&entry.node.span).without(&entry.key_span))
    }
}
