//! The word of a value, and the value of a word.

use std::sync::Arc;

use super::decimal::Decimal;
use super::program::Kind;
use super::record::{self, Finding, Making};
use super::word::{Value, Word, Words};

impl Words {
    /// The word of a value in a column of a kind, made where there is none yet; none for a text that is no record.
    pub(super) fn of(&mut self, value: &Value, kind: Kind) -> Option<Word> {
        Some(match value {
            Value::Number(number) => self.number(*number),
            Value::Decimal(decimal) => self.number(decimal.millionths()),
            Value::Symbol(text) => self.symbol(text),
            Value::Record(text) => return record::read(text, kind, &mut Making(self)),
        })
    }

    /// The word of a value that is known already.
    pub(super) fn find(&self, value: &Value, kind: Kind) -> Option<Word> {
        match value {
            Value::Number(number) => self.find_number(*number),
            Value::Decimal(decimal) => self.find_number(decimal.millionths()),
            Value::Symbol(text) => self.find_symbol(text),
            Value::Record(text) => record::read(text, kind, &mut Finding(self)),
        }
    }

    pub(super) fn value(&self, word: Word, kind: Kind) -> Value {
        match kind {
            Kind::Symbol => Value::Symbol(Arc::clone(self.text(word))),
            Kind::Number | Kind::Unsigned => Value::Number(self.to_number(word)),
            Kind::Float => Value::Decimal(Decimal::from_millionths(self.to_number(word))),
            Kind::Record(_) => {
                let mut text = String::new();
                record::write(self, word, kind, record::Texts::Told, &mut text);
                Value::Record(text.into())
            }
        }
    }
}
