//! `ortho mcp` by its own lines, and what `ortho history --calls` tells of them afterwards.

use std::io::{BufRead as _, BufReader, Write as _};
use std::process::{Child, ChildStdout, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::Place;
use crate::generated_worlds::Dice;

/// A client that speaks the protocol line by line.
struct Client {
    server: Child,
    told: BufReader<ChildStdout>,
    id: u64,
}

impl Client {
    fn of(place: &Place, name: &str) -> Self {
        let mut command = place.command(&["mcp", "--trust-client"]);
        let mut server =
            command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("it starts");
        let told = BufReader::new(server.stdout.take().expect("it is piped"));
        let mut client = Self { server, told, id: 0 };
        let id = client.ask(
            "initialize",
            &json!({
                "protocolVersion": "2025-06-18", "capabilities": {},
                "clientInfo": { "name": name, "version": "1" },
            }),
        );
        client.answer(id);
        client.tell("notifications/initialized", &json!({}));
        client
    }

    fn send(&mut self, line: &Value) {
        writeln!(self.server.stdin.as_mut().expect("it is piped"), "{line}").expect("it listens");
    }

    fn tell(&mut self, method: &str, params: &Value) {
        self.send(&json!({ "jsonrpc": "2.0", "method": method, "params": params }));
    }

    fn ask(&mut self, method: &str, params: &Value) -> u64 {
        self.id += 1;
        self.send(&json!({ "jsonrpc": "2.0", "id": self.id, "method": method, "params": params }));
        self.id
    }

    fn answer(&mut self, id: u64) -> Value {
        loop {
            let mut line = String::new();
            assert!(self.told.read_line(&mut line).expect("it speaks") > 0, "it left");
            let told: Value = serde_json::from_str(&line).expect("one JSON value a line");
            if told["id"] == id {
                return told["result"].clone();
            }
        }
    }

    fn call(&mut self, tool: &str, arguments: &Value) -> Value {
        let id = self.ask("tools/call", &json!({ "name": tool, "arguments": arguments }));
        self.answer(id)["structuredContent"].clone()
    }

    fn leave(mut self) {
        drop(self.server.stdin.take());
        self.server.wait().expect("it ends");
    }
}

/// Pairs of numbers without end, of which none is asked for.
const ENDLESS: &str = ".decl a(x: number, y: number) a(0, 0). a(X + 1, Y) :- a(X, Y). a(X, Y + 1) :- a(X, Y). ?- a(-5, _)";

#[test]
fn every_call_of_an_assistant_is_in_the_history_at_its_time() {
    let place = Place::with_rb2();
    let mut client = Client::of(&place, "Маша");
    assert!(client.call("ask", &json!({ "text": "Где Чашка-1?" }))["text"].is_string());
    assert!(client.call("query", &json!({ "query": "?- nothing(" }))["code"].is_string());
    // Taken back, it ends; whoever asks next is answered.
    let endless = json!({ "name": "query", "arguments": { "query": ENDLESS } });
    let id = client.ask("tools/call", &endless);
    client.tell("notifications/cancelled", &json!({ "requestId": id, "reason": "enough" }));
    let edit = json!({ "edit": [{ "move": "Стул-1", "by": [10, 0] }] });
    assert_eq!(client.call("propose_edit", &json!({ "edit": edit }))["outcome"], "edited");
    let history = client.call("history", &json!({ "calls": true }));
    let outcomes = |calls: &Value| -> Vec<(String, String)> {
        let word = |call: &Value, key: &str| call[key].as_str().expect("a text").to_owned();
        let calls = calls.as_array().expect("a list").iter();
        calls.map(|call| (word(call, "tool"), word(call, "outcome"))).collect()
    };
    let expected = [
        ("ask", "answered"),
        ("query", "refused"),
        ("query", "cancelled"),
        ("propose_edit", "answered"),
    ]
    .map(|(tool, outcome)| (tool.to_owned(), outcome.to_owned()));
    assert_eq!(outcomes(&history["calls"]), expected);
    assert!(client.call("history", &json!({}))["calls"].is_null());
    client.leave();

    // A machine that stopped leaves half a line.
    let noted = place.path("ortho-store.calls.jsonl");
    let whole = std::fs::read_to_string(&noted).unwrap();
    std::fs::write(&noted, format!("{whole}{{\"at\": \"20")).unwrap();
    let told = place.json(&["history", "--calls"], 0);
    assert_eq!(outcomes(&told["calls"])[..4], expected);
    assert!(told["calls"].as_array().unwrap().iter().all(|call| call["client"] == "Маша"));
    assert_eq!(told["revisions"].as_array().unwrap().len(), 2);
    assert!(place.json(&["history"], 0)["calls"].is_null());

    let run = place.run(&["history", "--calls", "--lang", "en"]).is(0);
    assert!(run.err.contains("lines of calls do not read: 1"), "{}", run.err);
    let lines: Vec<&str> = run.out.lines().collect();
    for (line, parts) in lines.iter().zip([
        &["   1 ", "import"][..],
        &["Маша", "ask {", "– answered"],
        &["Маша", "query {", "– refused"],
        &["Маша", "query {", "– cancelled"],
        &["Маша", "propose_edit {", "– answered"],
        &["   2 ", "Маша", "edit"],
        &["Маша", "history {", "– answered"],
        &["Маша", "history", "– answered"],
    ]) {
        assert!(parts.iter().all(|part| line.contains(part)), "{parts:?}: {line}");
    }
    assert_eq!(lines.len(), 8, "{lines:#?}");
    let last = place.run(&["history", "--calls", "--last", "3", "--lang", "ru"]).is(0).out;
    assert!(last.lines().count() == 3 && last.contains("– дан ответ"), "{last}");
    assert!(!place.run(&["history"]).is(0).out.contains("ask"));
}

/// What other programs write between two calls is known to the next, and no plan outlives it.
#[test]
fn an_assistant_and_the_command_line_write_in_turn() {
    let place = Place::with_rb2();
    let mut client = Client::of(&place, "Маша");
    let planned = client.call("plan", &json!({ "text": "Принеси лекарство" }));
    let id = planned["task"]["task"].clone();
    assert!(id.is_u64(), "{planned}");
    place.run(&["edit", "rename", "Лекарство", "Таблетки"]).is(0);
    let expired = client.call("run", &json!({ "id": id }));
    assert_eq!(expired["code"], "serve::expired", "{expired}");
    let told = client.call("ask", &json!({ "text": "Где Таблетки?" }));
    assert!(told["text"].as_str().is_some_and(|text| text.contains("Комнат")), "{told}");
    let edit = json!([{ "rename": "Таблетки", "to": "Пилюли" }]);
    let edited = client.call("propose_edit", &json!({ "edit": { "edit": edit }, "reason": "так" }));
    assert_eq!(edited["revision"], 3, "{edited}");
    let seen = client.call("observe", &json!({ "thing": "Пилюли", "absent": true }));
    assert_eq!(seen["outcome"], "noted", "{seen}");
    place.run(&["edit", "rename", "Пилюли", "Лекарство"]).is(0);
    let history = client.call("history", &json!({}));
    assert_eq!(history["revisions"].as_array().map(Vec::len), Some(4), "{history}");
    let planned = client.call("plan", &json!({ "text": "Поезжай к Точке-К" }));
    let done = client.call("run", &json!({ "id": planned["task"]["task"] }));
    assert_eq!(done["state"], "done", "{done}");
    // Killed on its way or not, it leaves a store that opens.
    client.server.kill().expect("it is killed");
    client.server.wait().expect("it ends");
    place.run(&["fsck"]).is(0);
    assert_eq!(place.store().expect("a store").0, 4);
}

/// A dialogue has the store for the length of a line.
#[test]
fn a_dialogue_and_the_command_line_write_in_turn() {
    let place = Place::with_rb2();
    let mut command = place.command(&["talk"]);
    let mut talk = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().expect("starts");
    let mut told = BufReader::new(talk.stdout.take().expect("it is piped"));
    let mut said = |line: &str| {
        writeln!(talk.stdin.as_mut().expect("it is piped"), "{line}").expect("it listens");
        let mut answer = String::new();
        told.read_line(&mut answer).expect("it speaks");
        answer
    };
    assert!(said("Где Лекарство?").contains("Комнат"));
    place.run(&["edit", "rename", "Лекарство", "Таблетки"]).is(0);
    let answer = said("Где Таблетки?");
    assert!(answer.contains("Комнат"), "{answer}");
    // Another program's drive leaves it its questions.
    let (mut held, _) = orthoframe_store::Store::open(place.path("ortho-store")).unwrap();
    held.set_out().unwrap();
    assert!(said("Где Таблетки?").contains("Комнат"));
    let answer = said("Поезжай к Точке-К");
    assert!(answer.contains("ведёт робота"), "{answer}");
    drop(held);
    assert!(said("Поезжай к Точке-К").len() > 3);
    drop(talk.stdin.take());
    assert!(talk.wait().expect("it ends").success());
}

/// Whoever takes a plan back at any moment is not answered, and the next who asks for one has it as if nothing had been.
#[test]
fn a_plan_taken_back_at_any_moment_leaves_no_trace() {
    let place = Place::with_rb2();
    let mut client = Client::of(&place, "Маша");
    let steps = |planned: &Value| {
        let plan = &planned["task"]["plan"];
        (plan["outcome"].clone(), plan["events"].clone(), planned["text"].clone())
    };
    let short = json!({ "text": "Поезжай к Точке-К" });
    let expected = steps(&client.call("plan", &short));
    assert_eq!(expected.0, "done");
    // As many orders, one behind the other, as one line may hold.
    let places = ["Стол-1", "Обеденный стол"].into_iter().cycle().take(6);
    let long: Vec<String> = places.map(|place| format!("отнеси все книги на {place}")).collect();
    let long = json!({ "text": long.join(", потом ") });
    let began = Instant::now();
    assert_eq!(steps(&client.call("plan", &long)).0, "done");
    let lasts = usize::try_from(began.elapsed().as_micros()).expect("no age");
    let mut dice = Dice::new(7);
    const ROUNDS: usize = 12;
    for round in 0..ROUNDS {
        let id = client.ask("tools/call", &json!({ "name": "plan", "arguments": long }));
        std::thread::sleep(Duration::from_micros(dice.below(lasts / 2) as u64));
        client.tell("notifications/cancelled", &json!({ "requestId": id }));
        assert_eq!(steps(&client.call("plan", &short)), expected, "round {round}");
    }
    let calls = client.call("history", &json!({ "calls": true }))["calls"].clone();
    let calls = calls.as_array().expect("a list");
    let cancelled = calls.iter().filter(|call| call["outcome"] == "cancelled").count();
    assert!((1..=ROUNDS).contains(&cancelled), "{cancelled} of {ROUNDS}");
    client.leave();
}
