//! The types of the file as lines of TOML: a line per field, and in a list of tables a line per element.
//!
//! The `toml` package gives nested tables headers of their own; a map is easier to read with one line per replica.

use std::collections::BTreeMap;

use serde::Serialize;
use toml::ser::ValueSerializer;

use super::table::Table;
use super::values::{At, Coordinates, Number};
use super::words::{
    DoorKindFile, HingeFile, OpensFile, PermeabilityFile, ProfileFile, StatusFile, ZoneWord,
};
use crate::Gender;

/// A record whose fields can be printed line by line.
pub(super) trait Lines {
    /// `name = value` for every field that says something.
    fn lines(&self) -> String;
}

/// A value of a field.
pub(super) trait Printed: Serialize {
    /// Whether it is a table, worth a line of its own in a list.
    const IS_TABLE: bool = false;

    fn print(&self) -> String {
        inline(self)
    }

    /// The field with this value.
    fn field(&self, name: &str) -> String {
        format!("{name} = {}\n", self.print())
    }
}

/// A key, quoted where TOML wants it.
pub(super) fn key(key: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || c == '-' || c == '_';
    if !key.is_empty() && key.chars().all(is_plain) { key.to_owned() } else { quoted(key) }
}

/// A basic string on one line, whatever it holds.
fn quoted(text: &str) -> String {
    let mut quoted = String::from('"');
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => quoted.push_str(&format!("\\u{:04X}", u32::from(c))),
            c => quoted.push(c),
        }
    }
    quoted.push('"');
    quoted
}

/// A line of a record, or several where the value is made of lines.
pub(super) fn line(name: &str, value: &impl Printed) -> String {
    value.field(name.trim_start_matches("r#"))
}

fn inline<T: Serialize + ?Sized>(value: &T) -> String {
    let mut text = String::new();
    value
        .serialize(ValueSerializer::new(&mut text))
        .expect("the types of the file are all of TOML's kinds");
    text
}

impl<T: Printed> Printed for Vec<T> {
    fn print(&self) -> String {
        if T::IS_TABLE {
            let lines: String = self.iter().map(|e| format!("  {},\n", e.print())).collect();
            format!("[\n{lines}]")
        } else {
            inline(self)
        }
    }
}

impl Printed for String {
    fn print(&self) -> String {
        quoted(self)
    }
}

impl<T: Printed> Printed for Option<T> {
    fn print(&self) -> String {
        self.as_ref().map(Printed::print).unwrap_or_default()
    }
}

/// `side.A = {…}`, one line per key.
impl<T: Serialize> Printed for Table<T> {
    fn field(&self, name: &str) -> String {
        self.0.iter().map(|(k, v)| format!("{name}.{} = {}\n", key(k), inline(v))).collect()
    }
}

impl<K: Serialize, V: Serialize> Printed for BTreeMap<K, V> {}
impl<T: Serialize> Printed for [T; 2] {}

macro_rules! printed {
    ($($plain:ty),+) => {$( impl Printed for $plain {} )+};
}
printed!(
    u32,
    bool,
    Number,
    At,
    Coordinates,
    Gender,
    PermeabilityFile,
    ZoneWord,
    DoorKindFile,
    StatusFile,
    HingeFile,
    OpensFile,
    ProfileFile
);
