//! The arguments of a call held against what its tool takes, as the tool is listed.
//!
//! **Invariant.** What fits is read by the tool; what does not is refused before anything is done, all faults at once.

use serde_json::{Map, Value};

use crate::units::{Bilingual, Language, said, told, word};

use super::super::fault::Fault;

/// Of a text that is shown so many characters.
const SHOWN: usize = 40;

/// Looks at all arguments of a call; `takes` is the schema of the tool.
///
/// # Errors
/// One is missing, unknown, or not what it should be.
pub(super) fn check(tool: &str, takes: &Value, given: &Map<String, Value>) -> Result<(), Fault> {
    let known = &takes["properties"];
    let required = takes["required"].as_array().into_iter().flatten().filter_map(Value::as_str);
    let missing = required.filter(|name| !given.contains_key(*name)).map(|name| {
        Bilingual::both(|language| {
            let wanted = wanted(&known[name], language);
            told!(language, "argument-missing", name, wanted)
        })
    });
    let wrong = given.iter().filter_map(|(name, value)| match known.get(name) {
        None => Some(unknown(name, known)),
        Some(kind) if fits(kind, value) => None,
        Some(kind) => Some(mistaken(name, value, |language| wanted(kind, language))),
    });
    let faults: Vec<Bilingual> = missing.chain(wrong).collect();
    if faults.is_empty() { Ok(()) } else { Err(Fault::of_arguments(tool, &faults)) }
}

/// What is wrong with what was to be a call: it names no tool, or gives its arguments otherwise than by name.
pub(super) fn of_no_call(params: &Value) -> Fault {
    let mut faults = Vec::new();
    if !params["name"].is_string() {
        let wanted = word!("the-name-of-a-tool");
        let wanted = |language| wanted.say(language).into_owned();
        faults.push(mistaken("name", &params["name"], wanted));
    }
    if !params["arguments"].is_object() && !params["arguments"].is_null() {
        let wanted = word!("a-json-object");
        let wanted = |language| wanted.say(language).into_owned();
        faults.push(mistaken("arguments", &params["arguments"], wanted));
    }
    if faults.is_empty() {
        of_no_request("tools/call")
    } else {
        Fault::of_arguments("tools/call", &faults)
    }
}

/// Parameters that are not those of a method.
pub(super) fn of_no_request(method: &str) -> Fault {
    let told = word!("no-parameters-of-method");
    Fault::of_arguments(method, &[told.into()])
}

fn mistaken(name: &str, value: &Value, wanted: impl Fn(Language) -> String) -> Bilingual {
    Bilingual::both(|language| {
        let (found, wanted) = (found(value, language), wanted(language));
        told!(language, "argument-wrong", name, found, wanted)
    })
}

fn unknown(name: &str, known: &Value) -> Bilingual {
    let name = shown(name);
    let known: Vec<&str> =
        known.as_object().into_iter().flatten().map(|(name, _)| name.as_str()).collect();
    let known = known.join(", ");
    match known.is_empty() {
        true => said!("no-arguments", name),
        false => said!("no-argument", name, known),
    }
}

/// Of JSON Schema what the tools use.
fn fits(kind: &Value, value: &Value) -> bool {
    if let Some(words) = kind["enum"].as_array() {
        return words.contains(value);
    }
    let is_short =
        |limit: &str, length: usize| kind[limit].as_u64().is_none_or(|most| length as u64 <= most);
    let is_within = |number: f64| {
        let least = kind["minimum"].as_f64().unwrap_or(f64::NEG_INFINITY);
        let most = kind["maximum"].as_f64().unwrap_or(f64::INFINITY);
        (least..=most).contains(&number)
    };
    match (kind["type"].as_str(), value) {
        (Some("string"), Value::String(text)) => is_short("maxLength", text.chars().count()),
        (Some("number"), Value::Number(number)) => number.as_f64().is_some_and(is_within),
        (Some("integer"), Value::Number(number)) => {
            (number.is_u64() || number.is_i64()) && number.as_f64().is_some_and(is_within)
        }
        (Some("array"), Value::Array(all)) => {
            is_short("maxItems", all.len()) && all.iter().all(|one| fits(&kind["items"], one))
        }
        (Some("boolean"), Value::Bool(_)) | (Some("object"), Value::Object(_)) => true,
        _ => false,
    }
}

/// What would be right.
fn wanted(kind: &Value, language: Language) -> String {
    if let Some(words) = kind["enum"].as_array() {
        let words: Vec<&str> = words.iter().filter_map(Value::as_str).collect();
        return format!("{} {}", told!(language, "one-of"), words.join(", "));
    }
    let what = match kind["type"].as_str() {
        Some("number" | "integer") => {
            let is_whole = kind["type"] == "integer";
            let mut what = match is_whole {
                true => told!(language, "a-whole-number"),
                false => told!(language, "a-number"),
            };
            for (limit, word) in
                [("minimum", told!(language, "from")), ("maximum", told!(language, "to"))]
            {
                if !kind[limit].is_null() {
                    what = format!("{what} {word} {}", kind[limit]);
                }
            }
            return what;
        }
        Some("boolean") => told!(language, "true-or-false"),
        Some("object") => told!(language, "a-json-object"),
        Some("array") => {
            return told!(
                language,
                "list-of-at-most",
                most = kind["maxItems"].to_string(),
                wanted = wanted(&kind["items"], language)
            );
        }
        _ => told!(language, "text"),
    };
    match kind["maxLength"].as_u64() {
        Some(most) => told!(language, "of-at-most", what, most),
        None => what,
    }
}

fn found(value: &Value, language: Language) -> String {
    match value {
        Value::Null => "null".to_owned(),
        Value::Bool(_) | Value::Number(_) => value.to_string(),
        Value::String(text) => match text.chars().count() {
            ..=SHOWN => told!(language, "the-text", text),
            count => told!(language, "the-long-text", text = shown(text), count),
        },
        Value::Array(all) => told!(language, "list-of-length", all = all.len()),
        Value::Object(_) => told!(language, "an-object"),
    }
}

fn shown(text: &str) -> String {
    text.chars().take(SHOWN).collect()
}
