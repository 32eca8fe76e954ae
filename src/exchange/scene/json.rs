//! Lenient reading of JSON records: a field that is missing or of another type is simply not there.

use serde_json::Value;

use crate::units::{Bilingual, Cm, Point, Source, said};
use crate::{ReadError, Remark};

/// Metres to centimetres.
pub(super) const METRE: f64 = 100.0;

/// The whole text as one value.
///
/// # Errors
/// [`ReadError::Syntax`] with the place; nesting deeper than 128 is refused by the parser.
pub(super) fn parse(format: &'static str, text: &Source) -> Result<Value, ReadError> {
    serde_json::from_str(text.text().trim_start_matches('\u{FEFF}')).map_err(|e| {
        let at = offset(text.text(), e.line(), e.column());
        ReadError::syntax(format, words(&e), text, at)
    })
}

fn words(e: &serde_json::Error) -> Bilingual {
    match e.classify() {
        serde_json::error::Category::Eof => {
            said!("the-file-breaks-off-before")
        }
        _ if e.to_string().contains("recursion limit") => {
            said!("nested-deeper-than-128-levels")
        }
        _ if e.to_string().contains("number out of range") => {
            said!("a-number-larger-than-can")
        }
        _ => said!("this-is-no-json"),
    }
}

/// Byte offset of a line and column, both from 1, the column in bytes.
fn offset(text: &str, line: usize, column: usize) -> usize {
    let start: usize = text.split_inclusive('\n').take(line.saturating_sub(1)).map(str::len).sum();
    (start + column.saturating_sub(1)).min(text.len())
}

pub(super) fn list<'v>(value: &'v Value, field: &str) -> &'v [Value] {
    value.get(field).and_then(Value::as_array).map_or(&[], Vec::as_slice)
}

pub(super) fn text<'v>(value: &'v Value, field: &str) -> Option<&'v str> {
    value.get(field).and_then(Value::as_str).filter(|s| !s.is_empty())
}

/// A length in metres as centimetres; none beyond what a [`Cm`] holds.
pub(super) fn length(value: &Value) -> Option<f64> {
    value.as_f64().map(|m| m * METRE).filter(|&cm| Cm::new(cm).is_ok())
}

/// `{x, y, z}` in metres.
pub(super) fn triple(value: Option<&Value>) -> Option<[f64; 3]> {
    let value = value?;
    Some([length(value.get("x")?)?, length(value.get("y")?)?, length(value.get("z")?)?])
}

/// `{x, y, z}` in degrees; a missing axis is 0.
pub(super) fn angles(value: Option<&Value>) -> [f64; 3] {
    let axis = |name: &str| {
        value
            .and_then(|v| v.get(name))
            .and_then(Value::as_f64)
            .filter(|d| d.abs() < 1e9)
            .unwrap_or(0.0)
    };
    [axis("x"), axis("y"), axis("z")]
}

/// Unity's frame from above: x to the right, z up the page.
pub(super) fn plan([x, _, z]: [f64; 3]) -> Point {
    Point::new(x, z)
}

pub(super) fn remark(source: impl Into<String>, text: impl Into<Bilingual>) -> Remark {
    Remark { source: source.into(), text: text.into() }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn fault(text: &str) -> String {
        let source = Source::new("файл", text);
        match parse("ProcTHOR", &source) {
            Err(ReadError::Syntax { what, at, .. }) => {
                let (line, column) = source.position(at.offset());
                format!("{line}:{column} {what}")
            }
            other => format!("{other:?}"),
        }
    }

    #[test]
    fn a_fault_has_its_place() {
        assert_eq!(fault("{\n \"rooms\": [,]}"), "2:12 это не JSON");
        assert_eq!(fault("{\"rooms\": ["), "1:11 файл обрывается, не закончившись");
        assert_eq!(fault("[1e400]"), "1:6 число больше, чем может быть");
        assert_eq!(fault(&"[".repeat(1000)), "1:128 вложенность глубже 128 уровней");
    }

    #[test]
    fn lengths_beyond_a_hundred_kilometres_are_not_there() {
        assert_eq!(length(&serde_json::json!(1e300)), None);
        assert_eq!(length(&serde_json::json!(2.5)), Some(250.0));
        assert_eq!(triple(Some(&serde_json::json!({"x": 1, "y": 2}))), None);
    }
}
