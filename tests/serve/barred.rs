//! A robot that finds its only way barred: the page is told what bars it, and answers.

use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::{Console, Operator};

/// What the robot's world has in the way, and the map elsewhere.
const TRUTH: &str = include_str!("../cli/barred.toml");

/// The question before which the robot waits.
fn asked(operator: &Operator<'_>) -> Value {
    let patience = Instant::now() + Duration::from_secs(60);
    loop {
        let barred = operator.get("/api/tasks")["task"]["barred"].clone();
        if !barred.is_null() {
            return barred;
        }
        assert!(Instant::now() < patience, "nobody was asked: {}", operator.get("/api/tasks"));
        std::thread::sleep(Duration::from_millis(50));
    }
}

#[test]
fn who_drives_is_asked_to_clear_the_only_way() {
    let dir = tempfile::tempdir().expect("a folder");
    let file = |name: &str, text: &str| {
        let path = dir.path().join(name);
        std::fs::write(&path, text).expect("it is written");
        path.to_str().expect("text").to_owned()
    };
    let truth = file("truth.toml", TRUTH);
    let map = file("map.toml", &TRUTH.replace("at = [345, 125]", "at = [20, 20]"));
    let simulated = format!("cmd:{} simulate {truth} --stdio", env!("CARGO_BIN_EXE_ortho"));
    let console = Console::start(&["--map", &map, "--vehicle", &simulated]);
    let operator = console.operator();
    let said = operator.done("/api/say", &json!({ "text": "Поезжай в Кабинет", "lang": "ru" }));
    let task = said["task"]["task"].clone();
    let cleared = format!("/api/tasks/{task}/cleared");
    assert_eq!(operator.post(&cleared, &json!({ "is_clear": true })).status, 404);
    operator.done(&format!("/api/tasks/{task}/confirm"), &json!({}));
    let barred = asked(&operator);
    assert_eq!((&barred["things"], &barred["area"]), (&json!(["Шкаф-1"]), &json!("Прихожая")));
    assert_eq!(console.invites_and_answers(&operator, &cleared), 403);
    // It is there still, and asked once more; then it is given up.
    operator.done(&cleared, &json!({ "is_clear": true }));
    asked(&operator);
    operator.done(&cleared, &json!({ "is_clear": false }));
    let ended = operator.waits();
    assert_eq!(ended["state"], "stuck", "{ended}");
    assert!(ended["text_end"].as_str().is_some_and(|told| told.contains("Шкаф-1")), "{ended}");
}

impl Console {
    /// What somebody is told who may only look and says that a way is clear.
    fn invites_and_answers(&self, operator: &Operator<'_>, path: &str) -> u16 {
        let visitor = operator.invites("look", "гость");
        visitor.post(path, &json!({ "is_clear": true })).status
    }
}
