//! The language server, by a scripted client: faults, hover in both languages, definitions, names, the usual form.

use std::io::{BufRead, BufReader, Read, Write};
use std::process::{Child, ChildStdout, Stdio};

use serde_json::{Value, json};

use super::{Place, project};

struct Client {
    server: Child,
    output: BufReader<ChildStdout>,
    next: u64,
}

impl Client {
    fn start() -> Self {
        let place = Place::empty();
        let mut command = place.command(&["language-server"]);
        command.stdin(Stdio::piped()).stdout(Stdio::piped());
        let mut server = command.spawn().unwrap();
        let output = BufReader::new(server.stdout.take().unwrap());
        let mut client = Self { server, output, next: 0 };
        let capabilities =
            client.ask("initialize", json!({ "capabilities": {} }))["capabilities"].clone();
        assert_eq!(capabilities["hoverProvider"], true, "{capabilities}");
        client.tell("initialized", json!({}));
        client
    }

    fn send(&mut self, message: &Value) {
        let text = message.to_string();
        let input = self.server.stdin.as_mut().unwrap();
        write!(input, "Content-Length: {}\r\n\r\n{text}", text.len()).unwrap();
        input.flush().unwrap();
    }

    fn receive(&mut self) -> Value {
        let mut length = 0;
        loop {
            let mut line = String::new();
            assert!(self.output.read_line(&mut line).unwrap() > 0, "the server is gone");
            match line.trim().strip_prefix("Content-Length: ") {
                Some(value) => length = value.parse().unwrap(),
                None if line.trim().is_empty() => break,
                None => {}
            }
        }
        let mut bytes = vec![0; length];
        self.output.read_exact(&mut bytes).unwrap();
        serde_json::from_slice(&bytes).unwrap()
    }

    #[expect(clippy::needless_pass_by_value, reason = "messages are written where they are sent")]
    fn tell(&mut self, method: &str, params: Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    #[expect(clippy::needless_pass_by_value, reason = "messages are written where they are sent")]
    fn ask(&mut self, method: &str, params: Value) -> Value {
        self.next += 1;
        let id = self.next;
        self.send(&json!({ "jsonrpc": "2.0", "id": id, "method": method, "params": params }));
        let answer = self.receive();
        assert_eq!(answer["id"], id, "{answer}");
        answer["result"].clone()
    }

    /// The faults that come of a text: line, severity, code.
    fn open(&mut self, uri: &str, text: &str) -> Vec<(u64, u64, String)> {
        let document = json!({ "uri": uri, "languageId": "rules", "version": 1, "text": text });
        self.tell("textDocument/didOpen", json!({ "textDocument": document }));
        self.faults(uri)
    }

    fn change(&mut self, uri: &str, text: &str) -> Vec<(u64, u64, String)> {
        let params = json!({
            "textDocument": { "uri": uri, "version": 2 }, "contentChanges": [{ "text": text }],
        });
        self.tell("textDocument/didChange", params);
        self.faults(uri)
    }

    fn faults(&mut self, uri: &str) -> Vec<(u64, u64, String)> {
        let told = self.receive();
        assert_eq!(told["method"], "textDocument/publishDiagnostics");
        assert_eq!(told["params"]["uri"], uri);
        let fault = |fault: &Value| {
            (
                fault["range"]["start"]["line"].as_u64().unwrap(),
                fault["severity"].as_u64().unwrap(),
                fault["code"].as_str().unwrap_or_default().to_owned(),
            )
        };
        told["params"]["diagnostics"].as_array().unwrap().iter().map(fault).collect()
    }

    fn at(&mut self, method: &str, uri: &str, line: u64, character: u64) -> Value {
        let position = json!({ "line": line, "character": character });
        self.ask(method, json!({ "textDocument": { "uri": uri }, "position": position }))
    }

    fn end(mut self) {
        assert_eq!(self.ask("shutdown", Value::Null), Value::Null);
        self.tell("exit", Value::Null);
        assert!(self.server.wait().unwrap().success());
    }
}

#[test]
fn relations_under_an_editor() {
    let mut client = Client::start();
    let uri = "file:///tmp/%D0%BC%D0%BE%D0%B8.dl";
    let text = "// лежит где попало\n.decl ЛЕЖИТ(a: symbol, b: symbol) = LIES output\n.decl 𝒙_y(a: symbol) input\nЛЕЖИТ(X, Y) :- ON_TOP_OF(X, Y), 𝒙_y(X).\nЛЕЖИТ(X, X) :- лежыт(X, _).\n";
    let faults = client.open(uri, text);
    assert_eq!(faults, [(4, 1, "facts::unknown_relation".to_owned())]);
    let sound = text.replace("лежыт", "ЛЕЖИТ");
    assert_eq!(client.change(uri, &sound), []);

    // A name that this file declares, in the rule behind it, with its other name and its comment.
    let hover = client.at("textDocument/hover", uri, 3, 2);
    let value = hover["contents"]["value"].as_str().unwrap();
    assert!(value.contains("= LIES") && value.contains("лежит где попало"), "{value}");
    let place = client.at("textDocument/definition", uri, 3, 2);
    assert_eq!((&place["uri"], &place["range"]["start"]["line"]), (&json!(uri), &json!(1)));
    // One that the program declares.
    let hover = client.at("textDocument/hover", uri, 3, 17);
    let value = hover["contents"]["value"].as_str().unwrap();
    assert!(value.contains("НАХОДИТСЯ_СВЕРХУ_НА") && value.contains("ON_TOP_OF"), "{value}");
    // Columns count UTF-16 units, of which 𝒙 has two.
    let hover = client.at("textDocument/hover", uri, 3, 33);
    assert_eq!(hover["range"]["start"]["character"], 32, "{hover}");
    assert_eq!(hover["range"]["end"]["character"], 36, "{hover}");

    let document = json!({ "textDocument": { "uri": uri } });
    let symbols = client.ask("textDocument/documentSymbol", document.clone());
    let names: Vec<&str> =
        symbols.as_array().unwrap().iter().map(|of| of["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["ЛЕЖИТ", "LIES", "𝒙_y"]);
    let edits = client.ask("textDocument/formatting", document);
    assert_eq!(edits, json!([]));
    let more = client.at("textDocument/completion", uri, 3, 0);
    let has = |name: &str| more.as_array().unwrap().iter().any(|item| item["label"] == name);
    assert!(has("ЛЕЖИТ") && has("ON_TOP_OF"), "{more}");
    client.end();
}

#[test]
fn components_are_found_from_their_instances_and_other_files() {
    let mut client = Client::start();
    let (one, other) = ("file:///tmp/one.dl", "file:///tmp/other.dl");
    client.open(one, ".comp Graph {\n    .decl edge(a: number, b: number) = РЕБРО\n}\n");
    client.open(other, ".init g = Graph\ng.edge(1,2).\n");
    let place = client.at("textDocument/definition", other, 0, 11);
    assert_eq!(place["uri"], one);
    let place = client.at("textDocument/definition", other, 1, 3);
    assert_eq!((&place["uri"], &place["range"]["start"]["line"]), (&json!(one), &json!(1)));
    let edits = client.ask("textDocument/formatting", json!({ "textDocument": { "uri": other } }));
    assert_eq!(edits[0]["newText"], ".init g = Graph\ng.edge(1, 2).\n");
    client.end();
}

#[test]
fn robot_rules_under_an_editor() {
    let mut client = Client::start();
    let path = project("rules/service-robot.strips");
    let uri = format!("file://{}", path.display());
    let text = std::fs::read_to_string(&path).unwrap();
    let faults = client.open(&uri, &text);
    assert!(faults.iter().all(|(_, severity, _)| *severity == 2), "{faults:?}");

    // A predicate where an action names it: what it is called in English, and where it is first named.
    let needle = "РОБОТ-НАХОДИТСЯ-В_(";
    let (line, column) = text
        .lines()
        .enumerate()
        .filter(|(_, line)| !line.trim_start().starts_with(';'))
        .filter_map(|(n, line)| Some((n, line[..line.find(needle)?].chars().count())))
        .last()
        .unwrap();
    let place = client.at("textDocument/definition", &uri, line as u64, column as u64 + 1);
    assert!(place["range"]["start"]["line"].as_u64().unwrap() <= line as u64, "{place}");
    let hover = client.at("textDocument/hover", &uri, line as u64, column as u64 + 1);
    let value = hover["contents"]["value"].as_str().unwrap();
    assert!(value.contains("РОБОТ-НАХОДИТСЯ-В") && value.contains("the robot is in"), "{value}");

    let broken = text.replacen("Типы:", "Типыы:", 1);
    let faults = client.change(&uri, &broken);
    assert!(faults.iter().any(|(_, severity, _)| *severity == 1), "{faults:?}");
    client.end();
}

/// What no editor has opened is found where it lies: in an included file, in one that this includes, in another of the
/// folder.
#[test]
fn declarations_are_found_in_files_that_are_not_open() {
    let folder = tempfile::tempdir().unwrap();
    let write = |name: &str, text: &str| {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(&path, text).unwrap();
    };
    let uri = |name: &str| format!("file://{}", folder.path().join(name).display());
    write("parts/deep.dl", "\n// под всем\n.decl НИЖЕ(a: symbol) = BELOW\n");
    write("parts/part.dl", ".include \"deep.dl\"\n.decl part(a: symbol)\n");
    write("rules/own.dl", ".decl СОСЕД(a: symbol, b: symbol) = NEIGHBOUR\n");
    let text = ".include \"../parts/part.dl\"\n.decl r(a: symbol) .output r\nr(X) :- part(X), BELOW(X), NEIGHBOUR(X, _).\n";
    let mut client = Client::start();
    let open = uri("rules/open.dl");
    client.open(&open, text);
    for (column, place, line) in
        [(9, "parts/part.dl", 1), (18, "parts/deep.dl", 2), (28, "rules/own.dl", 0)]
    {
        let found = client.at("textDocument/definition", &open, 2, column);
        assert_eq!(found["uri"], uri(place), "{found}");
        assert_eq!(found["range"]["start"]["line"], line, "{found}");
    }
    let hover = client.at("textDocument/hover", &open, 2, 18);
    let value = hover["contents"]["value"].as_str().unwrap();
    assert!(value.contains("НИЖЕ") && value.contains("под всем"), "{value}");
    client.end();
}

/// A scenario names what the robot's rules declare: every name of every scenario leads there, and tells what is said there.
#[test]
fn a_scenario_leads_to_the_rules_that_it_includes() {
    let mut client = Client::start();
    let rules = format!("file://{}", project("rules/service-robot.strips").display());
    let mut asked = 0;
    for entry in std::fs::read_dir(project("rules/scenarios")).unwrap() {
        let path = entry.unwrap().path();
        let text = std::fs::read_to_string(&path).unwrap();
        let uri = format!("file://{}", path.display());
        client.open(&uri, &text);
        for (n, line) in text.lines().enumerate() {
            let code = line.split(';').next().unwrap_or_default();
            let Some((name, _)) = code.split_once('(').filter(|(name, _)| !name.contains(':'))
            else {
                continue;
            };
            let name = name.trim().trim_start_matches("НЕ ").trim_end_matches('_');
            let column = code[..code.find(name).unwrap()].chars().count() as u64;
            let place = client.at("textDocument/definition", &uri, n as u64, column + 1);
            assert_eq!(place["uri"], rules, "{uri}: {line}");
            let hover = client.at("textDocument/hover", &uri, n as u64, column + 1);
            let value = hover["contents"]["value"].as_str().unwrap();
            assert!(value.contains(name), "{line}: {value}");
            asked += 1;
        }
    }
    assert!(asked > 20, "{asked}");

    // Types too; what the scenario declares itself stays there. The rules may be open and changed.
    let scenario = format!("file://{}", project("rules/scenarios/unwritten.strips").display());
    let text = "Включить: ../service-robot.strips\nПредикаты:\nСВОЁ_(место)\nИсходная позиция:\nСВОЁ_(место Точка-А)\n";
    client.open(&scenario, text);
    let place = client.at("textDocument/definition", &scenario, 2, 6);
    assert_eq!(place["uri"], rules, "{place}");
    let place = client.at("textDocument/definition", &scenario, 4, 7);
    assert_eq!(place["uri"], rules, "{place}");
    let own = client.at("textDocument/definition", &scenario, 4, 1);
    assert_eq!((&own["uri"], &own["range"]["start"]["line"]), (&json!(scenario), &json!(2)));
    let line = place["range"]["start"]["line"].as_u64().unwrap();
    let text = std::fs::read_to_string(project("rules/service-robot.strips")).unwrap();
    client.open(&rules, &format!("\n\n{text}"));
    let moved = client.at("textDocument/definition", &scenario, 4, 7);
    assert_eq!(moved["range"]["start"]["line"], line + 2, "{moved}");
    client.end();
}
