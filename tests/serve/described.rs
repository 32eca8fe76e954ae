//! Answers held against their description: `src/serve/openapi.json`.

use serde_json::{Value, json};

const DESCRIPTION: &str = include_str!("../../src/serve/openapi.json");

/// Fails where an answer is not what the description says of its address.
pub(crate) fn holds(method: &str, path: &str, answer: &Value) {
    let description: Value = serde_json::from_str(DESCRIPTION).expect("it is JSON");
    let path = path.split('?').next().unwrap_or(path);
    let paths = description["paths"].as_object().expect("it has paths");
    let (template, methods) = paths
        .iter()
        // «/api/edits/{id}» is not meant where «/api/edits» is asked for.
        .find(|(template, _)| is_of(template, path))
        .unwrap_or_else(|| panic!("{path} is not described"));
    let schema = &methods[method]["responses"]["200"]["content"]["application/json"]["schema"];
    assert!(!schema.is_null(), "{method} {template}: its answer is not described");
    if let Err(why) = fits(&description, schema, answer) {
        panic!("{method} {template}: {why}\n{answer:#}");
    }
}

fn is_of(template: &str, path: &str) -> bool {
    let (mut wanted, mut parts) = (template.split('/'), path.split('/'));
    loop {
        match (wanted.next(), parts.next()) {
            (None, None) => return true,
            (Some(part), Some(is)) if part == is || part.starts_with('{') => {}
            _ => return false,
        }
    }
}

/// Of JSON Schema what the description uses.
fn fits(description: &Value, schema: &Value, value: &Value) -> Result<(), String> {
    if let Some(name) = schema["$ref"].as_str() {
        let name = name.trim_start_matches('#');
        let schema = description.pointer(name).ok_or_else(|| format!("there is no {name}"))?;
        return fits(description, schema, value);
    }
    if let Some(any) = schema["anyOf"].as_array() {
        let fitting = |one: &Value| fits(description, one, value).is_ok();
        return if any.iter().any(fitting) { Ok(()) } else { Err(format!("none fits: {value}")) };
    }
    let is_of_type = |kind: &str| match kind {
        "integer" => value.is_i64() || value.is_u64(),
        "number" => value.is_number(),
        "string" => value.is_string(),
        "boolean" => value.is_boolean(),
        "array" => value.is_array(),
        "object" => value.is_object(),
        "null" => value.is_null(),
        other => panic!("no type: {other}"),
    };
    let kinds: Vec<&str> = match &schema["type"] {
        Value::String(kind) => vec![kind],
        Value::Array(kinds) => kinds.iter().filter_map(Value::as_str).collect(),
        _ => Vec::new(),
    };
    if !kinds.is_empty() && !kinds.iter().any(|kind| is_of_type(kind)) {
        return Err(format!("no {}: {value}", kinds.join(" or ")));
    }
    if let Some(allowed) = schema["enum"].as_array()
        && !allowed.contains(value)
    {
        return Err(format!("none of {allowed:?}: {value}"));
    }
    if let Some(elements) = value.as_array()
        && !schema["items"].is_null()
    {
        for (n, element) in elements.iter().enumerate() {
            fits(description, &schema["items"], element).map_err(|why| format!("[{n}] {why}"))?;
        }
    }
    let Some(fields) = value.as_object() else { return Ok(()) };
    let told = schema["properties"].as_object();
    for name in schema["required"].as_array().into_iter().flatten().filter_map(Value::as_str) {
        if !fields.contains_key(name) {
            return Err(format!("{name} is missing"));
        }
    }
    for (name, field) in fields {
        match told.and_then(|told| told.get(name)) {
            Some(schema) => {
                fits(description, schema, field).map_err(|why| format!("{name}: {why}"))?;
            }
            None if schema["additionalProperties"] == json!(false) => {
                return Err(format!("{name} is not described"));
            }
            None => {}
        }
    }
    Ok(())
}

#[test]
fn what_does_not_fit_its_description_is_found() {
    let description: Value = serde_json::from_str(DESCRIPTION).expect("it is JSON");
    let lease = json!({ "$ref": "#/components/schemas/LeaseOrNone" });
    let check = |value: Value| fits(&description, &lease, &value).is_ok();
    assert!(check(Value::Null));
    assert!(check(json!({ "holder": "Вера", "session": 3, "seconds": 7 })));
    assert!(!check(json!({ "holder": "Вера", "session": 3 })));
    assert!(!check(json!({ "holder": "Вера", "session": 3, "seconds": "7" })));
    assert!(!check(json!({ "holder": "Вера", "session": 3, "seconds": 7, "more": 1 })));
    assert!(is_of("/api/edits/{id}", "/api/edits/7") && !is_of("/api/edits", "/api/edits/7"));
}
