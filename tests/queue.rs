//! Tasks that wait: kept in the store, done in the order of the shortest way, paused, dropped, and gone on with after the
//! process that did them was killed. What was done is judged by the store and by the simulated robot's way.

use std::io::{BufRead as _, BufReader};
use std::process::{Command, Stdio};

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Heard, Outcome, change_now};
use orthoframe_language::Language;
use orthoframe_store::Queue;

use crate::files::project;

fn engine(dir: &tempfile::TempDir) -> Engine {
    let mut engine = Engine::open(&dir.path().join("store"), None).unwrap();
    engine.import(&project("maps/rb2.toml"), &change_now("test", "survey")).unwrap();
    engine
}

fn hear(dialogue: &mut Dialogue, engine: &mut Engine, line: &str) -> Heard {
    dialogue.hear(engine, line, &mut |_, _| {}).unwrap_or_else(|e| panic!("{line}: {e}"))
}

fn words(heard: &Heard) -> Vec<&'static str> {
    heard.replies.iter().map(|reply| reply.outcome.word()).collect()
}

fn waiting(engine: &Engine) -> Vec<String> {
    engine.queue().unwrap().tasks.into_iter().map(|task| task.text).collect()
}

#[test]
fn tasks_wait_and_are_told_dropped_and_done_in_both_languages() {
    for (language, lines) in [
        (
            Language::Russian,
            [
                "Пауза",
                "Поезжай в Комнату-Y",
                "В очередь: открой Дверь-КY",
                "Что в очереди?",
                "Отмени 2",
                "Отмени",
                "Продолжай",
            ],
        ),
        (
            Language::English,
            [
                "Pause",
                "Go to Room Y",
                "Later: open Door KY",
                "What is queued?",
                "Cancel 2",
                "cancel",
                "Resume",
            ],
        ),
    ] {
        let dir = tempfile::tempdir().unwrap();
        let mut engine = engine(&dir);
        let mut dialogue = Dialogue::new(language);
        let [pause, go, later, list, drop, drop_last, go_on] = lines;
        assert_eq!(words(&hear(&mut dialogue, &mut engine, pause)), ["paused"]);
        assert_eq!(words(&hear(&mut dialogue, &mut engine, go)), ["queued"]);
        assert_eq!(words(&hear(&mut dialogue, &mut engine, later)), ["queued"]);
        let told = hear(&mut dialogue, &mut engine, list);
        assert!(told.text().contains(go) && told.text().contains("2."), "{}", told.text());
        assert_eq!(waiting(&engine).len(), 2);
        // Of two it is not said which.
        assert_eq!(words(&hear(&mut dialogue, &mut engine, drop_last)), ["refused"]);
        assert_eq!(words(&hear(&mut dialogue, &mut engine, drop)), ["cancelled"]);
        assert_eq!(waiting(&engine), [go]);
        assert_eq!(words(&hear(&mut dialogue, &mut engine, go_on)), ["begun", "done"]);
        assert_eq!(engine.queue().unwrap(), Queue::default());
        assert_eq!(words(&hear(&mut dialogue, &mut engine, go_on)), ["queue"]);
        // What is not understood by itself does not wait for a moment at which nobody is there to be asked.
        let it = language.pick("В очередь: принеси его", "Later: bring it");
        assert_eq!(words(&hear(&mut dialogue, &mut engine, it)), ["misheard"]);
        assert!(waiting(&engine).is_empty());
    }
}

#[test]
fn what_waits_outlives_the_engine() {
    let dir = tempfile::tempdir().unwrap();
    let mut first = engine(&dir);
    first.enqueue("Поезжай в Комнату-Y", "op").unwrap();
    first.enqueue("Go to Room Z", "op").unwrap();
    first.pause_queue(true, "op").unwrap();
    let before = first.queue().unwrap();
    drop(first);
    let mut second = Engine::open(&dir.path().join("store"), None).unwrap();
    assert_eq!(second.queue().unwrap(), before);
    let mut dialogue = Dialogue::default();
    let heard = dialogue.go_on(&mut second, &mut |_, _| {}).unwrap();
    assert_eq!(heard.tasks().filter(|task| task.ending.is_done()).count(), 2);
    assert_eq!(second.queue().unwrap(), Queue::default());
}

/// Of three errands no other order is driven in less way: each order is driven, one by one.
#[test]
fn no_order_of_the_tasks_is_shorter_when_driven() {
    let tasks = ["Поезжай в Комнату-Y", "Подъедь к Столу-1", "Поезжай в Комнату-Z"];
    let driven = |order: &[usize]| {
        let dir = tempfile::tempdir().unwrap();
        let mut engine = engine(&dir);
        let mut dialogue = Dialogue::default();
        let length = |heard: &Heard| -> f64 {
            let reports = heard.tasks().flat_map(|task| &task.reports);
            reports.map(|report| report.length).sum()
        };
        order.iter().map(|at| length(&hear(&mut dialogue, &mut engine, tasks[*at]))).sum::<f64>()
    };
    let orders = [[0, 1, 2], [0, 2, 1], [1, 0, 2], [1, 2, 0], [2, 0, 1], [2, 1, 0]];
    let all: Vec<f64> = orders.iter().map(|order| driven(order)).collect();
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    for given in orders {
        let dir = tempfile::tempdir().unwrap();
        let mut engine = engine(&dir);
        for at in given {
            engine.enqueue(tasks[at], "op").unwrap();
        }
        let mut dialogue = Dialogue::default();
        let heard = dialogue.go_on(&mut engine, &mut |_, _| {}).unwrap();
        let reports = heard.tasks().flat_map(|task| &task.reports);
        let length: f64 = reports.map(|report| report.length).sum();
        // It stands before a door or before a table a little otherwise than it measures beforehand.
        assert!(length <= least + 30.0, "{given:?}: {length} {all:?}");
    }
}

/// What two tasks both speak of keeps its order, however long the way.
#[test]
fn what_belongs_together_keeps_its_order() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = engine(&dir);
    engine.enqueue("Закрой Дверь-ZY", "op").unwrap();
    engine.enqueue("Открой Дверь-ZY", "op").unwrap();
    let tasks = engine.queue().unwrap().tasks;
    let order: Vec<u32> = engine.in_order(&tasks).unwrap().iter().map(|task| task.id).collect();
    assert_eq!(order, tasks.iter().map(|task| task.id).collect::<Vec<_>>());
}

/// Killed in the middle of a mission, by a signal that cannot be caught, the robot goes on with the rest.
#[test]
fn a_killed_process_is_gone_on_with() {
    let orders = "Принеси Книгу-4 и Чашку-1";
    let dir = tempfile::tempdir().unwrap();
    let store = dir.path().join("store");
    drop(engine(&dir));
    let ortho = |args: &[&str]| {
        let mut command = Command::new(env!("CARGO_BIN_EXE_ortho"));
        command.arg("--store").arg(&store).args(args);
        command
    };
    // The robot is another process, and at the pace of a clock: it outlives who drove it.
    let map = project("maps/rb2.toml").display().to_string();
    let mut robot =
        ortho(&["simulate", &map, "--listen", "127.0.0.1:0", "--pace", "8", "--lang", "en"]);
    let mut robot = robot.stderr(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(robot.stderr.take().unwrap()).read_line(&mut line).unwrap();
    let address = format!("tcp:{}", line.trim().rsplit(' ').next().unwrap());
    let mut child = ortho(&["do", "--json", orders, "--vehicle", &address]);
    let mut child = child.stdout(Stdio::piped()).spawn().unwrap();
    // The first thing was handed over: its directive is told, and then it is killed.
    let lines = BufReader::new(child.stdout.take().unwrap()).lines();
    let mut handed = false;
    for line in lines {
        let event: serde_json::Value = serde_json::from_str(&line.unwrap()).unwrap();
        handed |= event["event"] == "done" && event["action"] == "Передать";
        if handed {
            break;
        }
    }
    assert!(handed);
    child.kill().unwrap();
    child.wait().unwrap();
    let left = Engine::open(&store, None).unwrap();
    let queue = left.queue().unwrap();
    assert!(queue.tasks[0].is_begun && queue.tasks[0].text == orders, "{queue:?}");
    drop(left);
    let out = ortho(&["do", "--json", "--resume", "--vehicle", &address]).output().unwrap();
    robot.kill().unwrap();
    robot.wait().unwrap();
    let text = String::from_utf8(out.stdout).unwrap();
    assert!(out.status.success(), "{text}");
    let after = Engine::open(&store, None).unwrap();
    assert_eq!(after.queue().unwrap(), Queue::default());
    let carried: Vec<String> =
        after.handed_over().unwrap().iter().map(|(thing, _)| thing.name.clone()).collect();
    assert_eq!(carried.len(), 2, "{carried:?}\n{text}");
    // The first was not fetched twice.
    let events = text.lines().map(|line| serde_json::from_str(line).unwrap());
    let taken = events
        .filter(|event: &serde_json::Value| event["event"] == "done" && event["action"] == "Взять");
    assert_eq!(taken.count(), 1, "{text}");
    let word = |heard: &Heard| heard.replies.iter().any(|r| matches!(r.outcome, Outcome::Waits(_)));
    let mut dialogue = Dialogue::default();
    let mut engine = after;
    assert!(word(&hear(&mut dialogue, &mut engine, "Что в очереди?")));
}
