//! A console that is served while other programs write the same store.

use std::process::Output;
use std::time::{Duration, Instant};

use serde_json::{Value, json};

use super::{Console, Operator, events, ortho};

/// A program beside the console.
fn beside(store: &str, args: &[&str]) -> Output {
    ortho().args(["--store", store]).args(args).output().expect("the program starts")
}

#[track_caller]
fn done(store: &str, args: &[&str]) -> String {
    let Output { status, stdout, stderr } = beside(store, args);
    let text = |bytes: &[u8]| String::from_utf8_lossy(bytes).into_owned();
    assert!(status.success(), "{args:?}: {}{}", text(&stdout), text(&stderr));
    text(&stdout)
}

fn where_is(operator: &Operator<'_>, name: &str) -> Value {
    let said = operator.done("/api/say", &json!({ "text": format!("Где {name}?"), "lang": "ru" }));
    said["replies"][0]["text"].clone()
}

#[test]
fn what_other_programs_write_is_known_at_once_and_kept() {
    let folder = tempfile::tempdir().expect("a folder");
    let store = folder.path().join("store");
    let store = store.to_str().expect("a path in UTF-8");
    let console = Console::start(&["--demo", "--store", store]);
    let operator = console.operator();
    let begun = operator.get("/api/state")["event"].as_str().expect("an id").to_owned();
    let mut on = 1;
    for round in 0..3 {
        // Theirs, which the next answer knows, though it is a question and no edit.
        let chair = format!("Трон-{round}");
        let before = if round == 0 {
            "Кресло-1".to_owned()
        } else {
            format!("Трон-{}", round - 1)
        };
        done(store, &["edit", "rename", &before, &chair]);
        let told = where_is(&operator, &chair);
        assert!(told.as_str().is_some_and(|text| text.contains("Комнат")), "{told}");
        assert_eq!(operator.get("/api/state")["revision"], on + 1);
        // An edit on what it was is told what they did.
        let text = json!([{ "move": chair, "to": [400 + round, 320] }]);
        let late = operator.post("/api/edits", &json!({ "on": on, "edit": text }));
        assert_eq!((late.status, &late.json()["code"]), (409, &json!("serve::stale")), "{late:?}");
        operator.done("/api/edits", &json!({ "on": on + 1, "edit": text }));
        on += 2;
        // And they know ours, at once.
        assert!(done(store, &["find", &chair]).contains(&chair));
        assert_eq!(done(store, &["history"]).lines().count(), on as usize);
    }
    for (place, sure) in [("300,300", "0.8"), ("310,300", "0.9")] {
        done(store, &["observe", "Стул-1", "--at", place, "--sure", sure]);
    }
    let proposed = operator.get("/api/proposals").to_string();
    assert!(proposed.contains("Стул-1"), "{proposed}");
    // Nobody asks, and the page is told all the same.
    let told = operator.get("/api/state")["event"].as_str().expect("an id").to_owned();
    done(store, &["edit", "rename", "Лекарство", "Таблетки"]);
    let head = |id: &str| format!("{}Last-Event-ID: {id}\r\n", operator.cookie);
    let news = events(&console, &head(&told), |text| text.contains("event: revision"));
    assert!(news.contains("event: known"), "{news}");
    let all = events(&console, &head(&begun), |text| text.matches("event: revision").count() == 7);
    assert_eq!(all.matches("event: revision").count(), 7, "{all}");
    // Killed, it leaves a store that is whole.
    drop(console);
    done(store, &["fsck"]);
    done(store, &["edit", "rename", "Таблетки", "Лекарство"]);
    assert_eq!(done(store, &["history"]).lines().count(), 9);
}

#[test]
fn while_the_robot_drives_the_store_is_the_consoles() {
    let folder = tempfile::tempdir().expect("a folder");
    let store = folder.path().join("store");
    let store = store.to_str().expect("a path in UTF-8");
    let console = Console::start(&["--demo", "--pace", "1", "--store", store]);
    let operator = console.operator();
    // A task that another program has wait stands here, too.
    done(store, &["do", "--later", "Поезжай к Точке-К"]);
    let tasks = operator.get("/api/tasks");
    assert_eq!(tasks["queue"][0]["text"], "Поезжай к Точке-К", "{tasks}");
    let said = operator.done("/api/say", &json!({ "text": "Принеси лекарство", "lang": "ru" }));
    operator.done(&format!("/api/tasks/{}/confirm", said["task"]["task"]), &json!({}));
    let patience = Instant::now() + Duration::from_secs(30);
    while operator.get("/api/tasks")["task"].is_null() {
        assert!(Instant::now() < patience, "it does not set out");
        std::thread::sleep(Duration::from_millis(20));
    }
    std::thread::sleep(Duration::from_millis(200));
    let refused = beside(store, &["edit", "rename", "Кресло-1", "Трон"]);
    let told = String::from_utf8_lossy(&refused.stderr);
    assert_eq!(refused.status.code(), Some(2), "{told}");
    assert!(told.contains("ведёт робота"), "{told}");
    // What only asks is answered.
    assert!(done(store, &["ask", "Где Кресло-1?"]).contains("Кресло"));
    operator.done("/api/stop", &json!({}));
    operator.waits();
    done(store, &["edit", "rename", "Кресло-1", "Трон"]);
    assert!(operator.get("/api/tasks")["queue"].to_string().contains("Поезжай к Точке-К"));
    assert!(where_is(&operator, "Трон").as_str().is_some_and(|text| text.contains("Комнат")));
    // Another program's drive is waited for by nobody, and what is only asked is answered.
    let mut held = orthoframe_store::Store::open(store).expect("it is free").0;
    held.set_out().expect("it is its own");
    let begun = Instant::now();
    let taken = operator
        .post("/api/edits", &json!({ "on": 2, "edit": [{ "rename": "Трон", "to": "Кресло-1" }] }));
    assert_eq!(taken.json()["code"], "store::locked", "{taken:?}");
    assert!(where_is(&operator, "Трон").is_string());
    assert!(begun.elapsed() < Duration::from_secs(2), "nobody waits");
    let said = operator.done("/api/say", &json!({ "text": "Поезжай к Точке-К", "lang": "ru" }));
    operator.done(&format!("/api/tasks/{}/confirm", said["task"]["task"]), &json!({}));
    let ended = operator.waits();
    assert_eq!(ended["state"], "failed", "{ended}");
    assert!(
        ended["text_end"].as_str().is_some_and(|text| text.contains("ведёт робота")),
        "{ended}"
    );
}
