//! Wrong arguments of every tool of `ortho mcp`, made of the schemas that it lists: each is told what is wrong with it, and
//! nothing is done.

use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Child, ChildStdin, ChildStdout, Stdio};

use serde_json::{Map, Value, json};

/// A client over the standard streams.
struct Client {
    child: Child,
    to: ChildStdin,
    from: BufReader<ChildStdout>,
    number: u64,
}

impl Drop for Client {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Client {
    fn start() -> Self {
        let mut command = super::ortho();
        command.args(["mcp", "--demo", "--trust-client"]);
        command.stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
        let mut child = command.spawn().unwrap();
        let (to, from) = (child.stdin.take().unwrap(), child.stdout.take().unwrap());
        let mut client = Self { child, to, from: BufReader::new(from), number: 0 };
        let me = json!({ "name": "test", "version": "1" });
        client.ask(
            "initialize",
            &json!({ "protocolVersion": "2025-06-18", "capabilities": {}, "clientInfo": me }),
        );
        let ready = json!({ "jsonrpc": "2.0", "method": "notifications/initialized" });
        writeln!(client.to, "{ready}").unwrap();
        client
    }

    fn ask(&mut self, method: &str, params: &Value) -> Value {
        self.number += 1;
        let id = self.number;
        let asked = json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params });
        writeln!(self.to, "{asked}").unwrap();
        loop {
            let mut line = String::new();
            assert!(self.from.read_line(&mut line).unwrap() > 0, "it has left after {asked}");
            let told: Value = serde_json::from_str(&line).unwrap();
            if told["id"] == id {
                return told;
            }
        }
    }

    fn call(&mut self, tool: &str, arguments: &Value) -> Value {
        let told = self.ask("tools/call", &json!({ "name": tool, "arguments": arguments }));
        assert!(told["result"].is_object(), "{tool} {arguments}: {told}");
        told["result"].clone()
    }
}

/// A value that fits.
fn right(kind: &Value) -> Value {
    match kind["type"].as_str() {
        _ if kind["enum"].is_array() => kind["enum"][0].clone(),
        Some("string") => json!("Стол-1"),
        Some("number") => json!(0.5),
        Some("integer") => json!(1),
        Some("boolean") => json!(false),
        Some("array") => json!([right(&kind["items"])]),
        _ => json!({}),
    }
}

/// Values of every other kind, and those of its own that are beyond its bounds.
fn wrong(kind: &Value) -> Vec<Value> {
    let of_all = [
        json!(null),
        json!(true),
        json!(7),
        json!(0.25),
        json!("семь"),
        json!([null]),
        json!({ "a": 1 }),
    ];
    let is_own = |value: &Value| match kind["type"].as_str() {
        Some("string") => value.is_string(),
        Some("number") => value.is_number(),
        Some("integer") => value.is_u64(),
        Some("boolean") => value.is_boolean(),
        Some("object") => value.is_object(),
        _ => false,
    };
    let mut all: Vec<Value> = of_all.into_iter().filter(|value| !is_own(value)).collect();
    match kind["type"].as_str() {
        Some("string") => all.push(json!("я".repeat(100_000))),
        Some("number") => all.extend([json!(1e300), json!(-1e300)]),
        Some("integer") => all.extend([json!(-1), json!(1e30), json!(u64::MAX)]),
        Some("array") => all.push(Value::Array(vec![right(&kind["items"]); 10_000])),
        _ => {}
    }
    all
}

fn with(arguments: &Value, name: &str, value: Value) -> Value {
    let mut all = arguments.clone();
    all[name] = value;
    all
}

/// What is refused says which tool and which arguments, in both languages and in sentences of ours.
fn refused(client: &mut Client, tool: &str, arguments: &Value, named: &[&str]) {
    let told = client.call(tool, arguments);
    let shown = told.to_string();
    assert!(told["isError"] == true, "{tool}: {}", &shown[..shown.floor_char_boundary(400)]);
    let body = &told["structuredContent"];
    assert_eq!(body["code"], "assist::arguments", "{tool}: {body}");
    assert_eq!(body["faults"].as_array().map(Vec::len), Some(named.len()), "{tool}: {body}");
    for field in ["message", "message_en"] {
        let text = body[field].as_str().unwrap();
        assert!(text.contains(tool) && text.ends_with('.') && text.len() < 1000, "{tool}: {text}");
        for name in named {
            assert!(text.contains(name), "{tool}: {name} is not named in {text}");
        }
        for foreign in ["missing field", "invalid type", "unknown field", "at line", "expected"] {
            assert!(!text.contains(foreign), "{tool}: {text}");
        }
    }
    let is_russian = |text: &Value| text.as_str().unwrap().starts_with("Вызов");
    assert!(is_russian(&body["message"]) && !is_russian(&body["message_en"]), "{body}");
    assert_eq!(told["content"][0]["text"], body["message_en"]);
}

#[test]
fn wrong_arguments_of_any_tool_are_told_and_nothing_is_done() {
    let mut client = Client::start();
    let tools = client.ask("tools/list", &json!({}))["result"]["tools"].clone();
    let state = |client: &mut Client| {
        ["tasks", "proposals", "history"]
            .map(|tool| client.call(tool, &json!({}))["structuredContent"].clone())
    };
    let before = state(&mut client);
    let mut count = 0;
    for tool in tools.as_array().unwrap() {
        let (name, takes) = (tool["name"].as_str().unwrap(), &tool["inputSchema"]);
        let known: Map<String, Value> =
            takes["properties"].as_object().cloned().unwrap_or_default();
        let required: Vec<&str> =
            takes["required"].as_array().into_iter().flatten().filter_map(Value::as_str).collect();
        let least: Value =
            required.iter().map(|of| ((*of).to_owned(), right(&known[*of]))).collect();
        if !required.is_empty() {
            refused(&mut client, name, &json!({}), &required);
        }
        refused(&mut client, name, &with(&least, "nonsense", json!(1)), &["nonsense"]);
        for (of, kind) in &known {
            for value in wrong(kind) {
                refused(&mut client, name, &with(&least, of, value), &[of]);
                count += 1;
            }
        }
        // All faults at once.
        let all: Value = known.keys().map(|of| (of.clone(), Value::Null)).collect();
        let mut named: Vec<&str> = known.keys().map(String::as_str).collect();
        named.push("nonsense");
        refused(&mut client, name, &with(&all, "nonsense", json!(1)), &named);
        // What fits is read, whatever comes of it.
        let all: Value = known.iter().map(|(of, kind)| (of.clone(), right(kind))).collect();
        if !["plan", "run", "observe", "propose_edit", "stop"].contains(&name) {
            let told = client.call(name, &all);
            assert_ne!(told["structuredContent"]["code"], "assist::arguments", "{told}");
        }
    }
    assert!(count > 100, "{count}");
    assert_eq!(state(&mut client), before);
}

/// What the protocol's library makes no call of has wrong parameters; the method is there.
#[test]
fn parameters_that_are_no_call_are_wrong_and_the_method_is_known() {
    let mut client = Client::start();
    for (method, params, named) in [
        ("tools/call", json!({ "name": "ask", "arguments": ["a"] }), "arguments"),
        ("tools/call", json!({ "name": "ask", "arguments": "a" }), "arguments"),
        ("tools/call", json!({ "name": 7, "arguments": {} }), "name"),
        ("tools/call", json!({}), "name"),
        ("tasks/get", json!({ "taskId": 7 }), "tasks/get"),
    ] {
        let error = client.ask(method, &params)["error"].clone();
        assert_eq!(error["code"], -32602, "{method} {params}: {error}");
        assert!(error["message"].as_str().unwrap().contains(named), "{error}");
        assert!(error["data"]["message"].as_str().unwrap().contains(named), "{error}");
    }
    for method in ["tools/dance", "dance"] {
        assert_eq!(client.ask(method, &json!({}))["error"]["code"], -32601, "{method}");
    }
    let error = client.ask("tools/call", &json!({ "name": "dance", "arguments": {} }));
    assert_eq!(error["error"]["code"], -32602, "{error}");
}
