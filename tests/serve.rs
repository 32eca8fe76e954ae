//! The operator's console over HTTP: what it answers, and who is kept out.

use std::io::{BufRead as _, BufReader, Read as _, Write as _};
use std::net::TcpStream;
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use serde_json::{Value, json};

#[path = "serve/arguments.rs"]
mod arguments;
#[path = "serve/barred.rs"]
mod barred;
#[path = "serve/described.rs"]
mod described;
#[path = "serve/in_turn.rs"]
mod in_turn;
mod judged;

use judged::judged;

/// A console of its own on a free port.
struct Console {
    child: Child,
    /// `127.0.0.1:PORT`
    at: String,
    token: String,
}

impl Drop for Console {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

/// What came back.
#[derive(Debug)]
struct Answer {
    status: u16,
    head: String,
    body: String,
}

impl Answer {
    fn json(&self) -> Value {
        serde_json::from_str(&self.body).unwrap_or_else(|e| panic!("{e}: {self:?}"))
    }

    fn header(&self, name: &str) -> Option<&str> {
        let lines = self.head.lines().filter_map(|line| line.split_once(':'));
        lines.filter(|(n, _)| n.eq_ignore_ascii_case(name)).map(|(_, v)| v.trim()).next()
    }
}

/// The program, in Russian unless its arguments say otherwise.
fn ortho() -> Command {
    let mut command = Command::new(env!("CARGO_BIN_EXE_ortho"));
    command.env("ORTHO_LANG", "ru");
    command
}

impl Console {
    fn start(more: &[&str]) -> Self {
        let mut command = ortho();
        let port = if more.contains(&"--port") { &[][..] } else { &["--port", "0"] };
        command.arg("serve").args(port).args(more).env_remove("ORTHO_STORE");
        let mut child = command.stdout(Stdio::piped()).spawn().expect("the program starts");
        let mut line = String::new();
        let out = child.stdout.take().expect("it is piped");
        BufReader::new(out).read_line(&mut line).expect("it tells its address");
        let address = line.split_whitespace().last().expect("an address");
        let (at, token) = address
            .strip_prefix("http://")
            .and_then(|rest| rest.split_once("/?token="))
            .unwrap_or_else(|| panic!("no address: {line}"));
        Self { child, at: at.to_owned(), token: token.to_owned() }
    }

    fn demo() -> Self {
        Self::start(&["--demo", "--pace", "20"])
    }

    fn connect(&self) -> TcpStream {
        let stream = TcpStream::connect(&self.at).expect("it listens");
        stream.set_read_timeout(Some(Duration::from_secs(30))).expect("a time-out");
        stream
    }

    /// Sends these bytes and reads the one answer.
    fn raw(&self, request: &[u8]) -> Answer {
        let mut stream = self.connect();
        // Whoever is refused may be cut off while still talking.
        let _ = stream.write_all(request);
        read_answer(&mut BufReader::new(stream))
    }

    fn get(&self, path: &str, more: &str) -> Answer {
        let host = &self.at;
        self.raw(
            format!("GET {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n{more}\r\n")
                .as_bytes(),
        )
    }

    fn post_with(&self, path: &str, more: &str, body: &str) -> Answer {
        let (host, length) = (&self.at, body.len());
        self.raw(
            format!(
                "POST {path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\nContent-Type: application/json\r\nContent-Length: {length}\r\n{more}\r\n{body}"
            )
            .as_bytes(),
        )
    }

    /// The cookie for this token, as a header; none where it is worth nothing.
    fn enter(&self, token: &str) -> Option<String> {
        let answer = self.get(&format!("/?token={token}"), "");
        assert_eq!((answer.status, answer.header("location")), (303, Some("/")), "{answer:?}");
        let cookie = answer.header("set-cookie")?;
        for word in ["HttpOnly", "SameSite=Strict"] {
            assert!(cookie.contains(word), "{cookie}");
        }
        Some(format!("Cookie: {}\r\n", cookie.split(';').next().expect("a pair")))
    }

    fn operator(&self) -> Operator<'_> {
        Operator { console: self, cookie: self.enter(&self.token).expect("it is the token") }
    }

    fn own(&self) -> String {
        format!("Origin: http://{}\r\nSec-Fetch-Site: same-origin\r\n", self.at)
    }
}

/// Somebody with a session.
struct Operator<'c> {
    console: &'c Console,
    cookie: String,
}

impl Operator<'_> {
    fn get(&self, path: &str) -> Value {
        let answer = self.console.get(path, &self.cookie);
        assert_eq!(answer.status, 200, "{path}: {answer:?}");
        described::holds("get", path, &answer.json());
        answer.json()
    }

    fn post(&self, path: &str, body: &Value) -> Answer {
        let head = format!("{}{}", self.cookie, self.console.own());
        self.console.post_with(path, &head, &body.to_string())
    }

    fn done(&self, path: &str, body: &Value) -> Value {
        let answer = self.post(path, body);
        assert_eq!(answer.status, 200, "{path}: {answer:?}");
        described::holds("post", path, &answer.json());
        answer.json()
    }

    /// Somebody else, invited.
    fn invites(&self, role: &str, name: &str) -> Operator<'_> {
        let token = self.done("/api/invite", &json!({ "role": role, "name": name }));
        let token = token["token"].as_str().expect("a token").to_owned();
        let cookie = self.console.enter(&token).expect("it is good once");
        Operator { console: self.console, cookie }
    }

    /// Waits until no task is driven and none is to begin, and gives the last that ended.
    fn waits(&self) -> Value {
        let patience = Instant::now() + Duration::from_secs(60);
        while Instant::now() < patience {
            let tasks = self.get("/api/tasks");
            let mut queue = tasks["queue"].as_array().into_iter().flatten();
            let holds =
                tasks["paused"].is_string() || queue.all(|task| task["is_released"] == false);
            let idle = tasks["task"].is_null() && holds;
            if let (true, Some(last)) = (idle, tasks["ended"].as_array().and_then(|e| e.last())) {
                return last.clone();
            }
            std::thread::sleep(Duration::from_millis(30));
        }
        panic!("it drives for ever");
    }
}

fn read_answer(stream: &mut impl std::io::BufRead) -> Answer {
    let (mut head, mut line) = (String::new(), String::new());
    while stream.read_line(&mut line).is_ok_and(|n| n > 0) && line.trim() != "" {
        head.push_str(&line);
        line.clear();
    }
    let status = head.split(' ').nth(1).and_then(|s| s.parse().ok()).unwrap_or(0);
    let mut answer = Answer { status, head, body: String::new() };
    let mut body = Vec::new();
    match answer.header("content-length").and_then(|n| n.parse().ok()) {
        Some(length) => {
            body.resize(length, 0);
            stream.read_exact(&mut body).expect("the whole body");
        }
        None => {
            let _ = stream.read_to_end(&mut body);
        }
    }
    answer.body = String::from_utf8_lossy(&body).into_owned();
    answer
}

#[test]
fn a_question_is_answered_and_an_order_is_driven_after_a_yes() {
    let console = Console::demo();
    let operator = console.operator();
    let state = operator.get("/api/state");
    assert_eq!((&state["revision"], &state["role"]), (&json!(1), &json!("edit")), "{state}");
    let said = operator.done("/api/say", &json!({ "text": "Где лекарство?", "lang": "ru" }));
    let text = said["replies"][0]["text"].as_str().expect("an answer");
    assert!(text.contains("Тумбочк"), "{said}");
    assert!(said["task"].is_null());

    let before = state["robot"]["place"]["pose"].clone();
    let said = operator.done("/api/say", &json!({ "text": "Поезжай к Точке-К", "lang": "ru" }));
    let task = &said["task"];
    assert_eq!(task["state"], "planned", "{said}");
    assert!(task["plan"]["directives"].as_array().is_some_and(|d| d.len() > 2), "{said}");
    // A plan moves nothing.
    assert_eq!(operator.get("/api/state")["robot"]["place"]["pose"], before);
    operator.done(&format!("/api/tasks/{}/confirm", task["task"]), &json!({}));
    let ended = operator.waits();
    assert_eq!((&ended["task"], &ended["state"]), (&task["task"], &json!("done")), "{ended}");
    let after = operator.get("/api/state");
    assert_eq!(after["robot"]["place"]["pose"], task["plan"]["end"], "where the plan said");
    // What was confirmed once is not there to be confirmed again.
    let again = operator.post(&format!("/api/tasks/{}/confirm", task["task"]), &json!({}));
    assert_eq!(again.status, 404);
}

#[test]
fn who_only_looks_may_stop_and_nothing_else() {
    let console = Console::start(&["--demo", "--pace", "1"]);
    let operator = console.operator();
    let looker = operator.invites("look", "Анна");
    let said = operator.done("/api/say", &json!({ "text": "Принеси лекарство" }));
    let confirm = format!("/api/tasks/{}/confirm", said["task"]["task"]);
    assert_eq!(looker.post(&confirm, &json!({})).status, 403);
    assert_eq!(looker.post("/api/edits", &json!({ "on": 1, "edit": [] })).status, 403);
    operator.done(&confirm, &json!({}));
    let queued = operator.done("/api/say", &json!({ "text": "Поезжай к Точке-К" }));
    operator.done(&format!("/api/tasks/{}/confirm", queued["task"]["task"]), &json!({}));
    std::thread::sleep(Duration::from_millis(700));
    looker.done("/api/stop", &json!({}));
    operator.waits();
    let tasks = operator.get("/api/tasks");
    let stopped = &tasks["ended"][0];
    assert_eq!(
        (&stopped["state"], &stopped["stopped_by"], &stopped["waits"]),
        (&json!("stopped"), &json!("Анна"), &json!(true)),
        "{tasks}"
    );
    // What was broken off and what stood behind it wait, and begin when one who drives says so.
    let waiting = |tasks: &Value| -> Vec<(String, bool)> {
        let queue = tasks["queue"].as_array().into_iter().flatten();
        let one =
            |t: &Value| (t["text"].as_str().unwrap_or_default().to_owned(), t["is_begun"] == true);
        queue.map(one).collect()
    };
    let (medicine, place) = ("Принеси лекарство".to_owned(), "Поезжай к Точке-К".to_owned());
    assert_eq!(waiting(&tasks), [(medicine.clone(), true), (place.clone(), false)], "{tasks}");
    assert_eq!(looker.post("/api/resume", &json!({})).status, 403);
    assert_eq!(looker.post("/api/later", &json!({ "text": "Поезжай к Точке-А" })).status, 403);
    let last = &tasks["queue"][1]["task"];
    operator
        .done(&format!("/api/tasks/{last}/move"), &json!({ "before": tasks["queue"][0]["task"] }));
    let moved = operator.get("/api/tasks");
    assert_eq!(waiting(&moved), [(place, false), (medicine, true)], "{moved}");
    let said = operator.done("/api/say", &json!({ "text": "Отмени всё" }));
    assert_eq!(said["replies"][0]["outcome"], "cancelled", "{said}");
    assert_eq!(operator.get("/api/tasks")["queue"], json!([]));
}

#[test]
fn what_waits_outlives_a_kill_and_is_gone_on_with() {
    let folder = tempfile::tempdir().expect("a folder");
    let store = folder.path().join("store");
    let store = store.to_str().expect("a path in UTF-8");
    let console = Console::start(&["--demo", "--pace", "2", "--store", store]);
    let operator = console.operator();
    let confirmed = |operator: &Operator<'_>, text: &str| {
        let said = operator.done("/api/say", &json!({ "text": text, "lang": "ru" }));
        assert_eq!(said["task"]["state"], "planned", "{said}");
        operator.done(&format!("/api/tasks/{}/confirm", said["task"]["task"]), &json!({}));
    };
    confirmed(&operator, "Принеси лекарство");
    let said = operator.done("/api/say", &json!({ "text": "Позже: поезжай к Точке-К" }));
    assert_eq!(said["replies"][0]["outcome"], "queued", "{said}");
    // Until the medicine is in the hand.
    let patience = Instant::now() + Duration::from_secs(60);
    while operator.get("/api/state")["robot"]["carries"].is_null() {
        assert!(Instant::now() < patience, "it takes nothing");
        std::thread::sleep(Duration::from_millis(20));
    }
    let Operator { cookie, .. } = operator;
    drop(console);

    let console = Console::start(&["--demo", "--pace", "20", "--store", store]);
    // A cookie is named after its port.
    let (_, port) = console.at.rsplit_once(':').expect("a port");
    let (_, secret) = cookie.split_once('=').expect("a pair");
    let operator = Operator { console: &console, cookie: format!("Cookie: ortho-{port}={secret}") };
    std::thread::sleep(Duration::from_millis(300));
    let tasks = operator.get("/api/tasks");
    let left: Vec<&Value> =
        tasks["queue"].as_array().into_iter().flatten().map(|task| &task["is_begun"]).collect();
    assert_eq!(left, [&json!(true), &json!(false)], "{tasks}");
    assert!(tasks["task"].is_null(), "nothing begins by itself: {tasks}");
    let state = operator.get("/api/state");
    assert!(state["robot"]["carries"].is_array(), "it still holds what it took: {state}");
    let said = operator.done("/api/say", &json!({ "text": "Что в очереди?" }));
    assert_eq!(said["replies"][0]["outcome"], "queue", "{said}");
    let said = operator.done("/api/say", &json!({ "text": "Продолжай" }));
    assert_eq!(said["replies"][0]["outcome"], "resumed", "{said}");
    operator.waits();
    let tasks = operator.get("/api/tasks");
    let ended: Vec<&Value> = tasks["ended"].as_array().into_iter().flatten().collect();
    assert!(ended.iter().all(|task| task["state"] == "done") && ended.len() == 2, "{tasks}");
    assert_eq!(operator.get("/api/state")["robot"]["carries"], Value::Null);
}

#[test]
fn a_pause_holds_the_robot_and_new_orders_until_it_ends() {
    let console = Console::start(&["--demo", "--pace", "3"]);
    let operator = console.operator();
    let confirmed = |text: &str| {
        let said = operator.done("/api/say", &json!({ "text": text, "lang": "ru" }));
        let task = said["task"]["task"].clone();
        operator.done(&format!("/api/tasks/{task}/confirm"), &json!({}));
    };
    confirmed("Поезжай к Точке-К");
    std::thread::sleep(Duration::from_millis(500));
    let said = operator.done("/api/say", &json!({ "text": "Пауза" }));
    assert_eq!(said["replies"][0]["outcome"], "paused", "{said}");
    operator.waits();
    confirmed("Поезжай в Коридор");
    std::thread::sleep(Duration::from_millis(300));
    let tasks = operator.get("/api/tasks");
    assert!(tasks["task"].is_null() && tasks["paused"].is_string(), "{tasks}");
    assert_eq!(tasks["queue"].as_array().map(Vec::len), Some(2), "{tasks}");
    // One of them alone, then the rest.
    operator.done("/api/resume", &json!({ "task": tasks["queue"][1]["task"] }));
    operator.waits();
    let tasks = operator.get("/api/tasks");
    assert_eq!(tasks["queue"].as_array().map(Vec::len), Some(1), "{tasks}");
    operator.done("/api/shortest", &json!({}));
    operator.done("/api/resume", &json!({}));
    assert_eq!(operator.waits()["state"], "done");
    assert_eq!(operator.get("/api/tasks")["queue"], json!([]));
    assert_eq!(operator.post("/api/resume", &json!({ "task": 4711 })).status, 404);
    assert_eq!(operator.post("/api/later", &json!({ "text": "принеси его" })).status, 422);
}

#[test]
fn a_robot_of_another_program_drives_for_the_console() {
    let simulated = format!("cmd:{} simulate maps/rb2.toml --stdio", env!("CARGO_BIN_EXE_ortho"));
    let console = Console::start(&["--demo", "--vehicle", &simulated]);
    let operator = console.operator();
    let said = operator.done("/api/say", &json!({ "text": "Поезжай к Точке-К", "lang": "ru" }));
    let task = &said["task"];
    operator.done(&format!("/api/tasks/{}/confirm", task["task"]), &json!({}));
    let ended = operator.waits();
    assert_eq!(ended["state"], "done", "{ended}");
    assert_eq!(operator.get("/api/state")["robot"]["place"]["pose"], task["plan"]["end"]);

    // One that is not there is told, and the order is not lost.
    let console = Console::start(&["--demo", "--vehicle", "tcp:127.0.0.1:1"]);
    let operator = console.operator();
    let said = operator.done("/api/say", &json!({ "text": "Поезжай к Точке-К", "lang": "ru" }));
    operator.done(&format!("/api/tasks/{}/confirm", said["task"]["task"]), &json!({}));
    let ended = operator.waits();
    assert_eq!((&ended["state"], &ended["waits"]), (&json!("failed"), &json!(true)), "{ended}");
    assert!(ended["text_end"].as_str().is_some_and(|told| told.contains("127.0.0.1:1")), "{ended}");
}

#[test]
fn a_recording_is_played_on_its_own_map_and_nothing_else_is_driven() {
    let dir = tempfile::tempdir().expect("a folder");
    let (store, file) = (dir.path().join("store"), dir.path().join("mission.mcap"));
    let done = |arguments: &[&str]| {
        let mut command = ortho();
        command.current_dir(env!("CARGO_MANIFEST_DIR")).arg("--store").arg(&store);
        let told = command.args(arguments).arg("--json").output().expect("the program starts");
        assert!(told.status.success(), "{told:?}");
        String::from_utf8(told.stdout).expect("text")
    };
    done(&["import", "maps/rb2.toml"]);
    let path = file.to_str().expect("text");
    let told = done(&["do", "Поезжай к Точке-К", "--record", path]);
    let lines: Vec<Value> =
        told.lines().map(|line| serde_json::from_str(line).expect("JSON")).collect();
    let (task, directives) = lines.split_last().expect("the task");

    let console = Console::start(&["--replay", path, "--pace", "20"]);
    let operator = console.operator();
    let played = events(&console, &operator.cookie, is_done);
    let of = |kind: &str| -> Vec<Value> {
        let mut lines = played.lines();
        let mut found = Vec::new();
        while let Some(line) = lines.next() {
            if line == format!("event: {kind}") {
                let data = lines.by_ref().find_map(|line| line.strip_prefix("data: "));
                found.push(serde_json::from_str(data.expect("data")).expect("JSON"));
            }
        }
        found
    };
    let again: Vec<Value> = of("directive")
        .into_iter()
        .map(|mut event| {
            event.as_object_mut().expect("an event").remove("task");
            event
        })
        .collect();
    assert_eq!(again, directives, "{played}");
    let tasks = of("task");
    assert_eq!((tasks.len(), &tasks[0]["text"]), (2, &json!("Поезжай к Точке-К")), "{played}");
    assert_eq!(tasks[0]["plan"]["directives"], task["directives"], "how long each took is known");
    assert!(of("robot").len() > 3, "{played}");
    let state = operator.get("/api/state");
    assert_eq!(state["robot"]["place"]["pose"], task["end"], "{state}");
    assert_eq!((&state["revision"], &state["task"]), (&json!(1), &Value::Null), "{state}");
}

#[test]
fn what_the_console_drives_is_recorded_a_file_a_task() {
    let dir = tempfile::tempdir().expect("a folder");
    let folder = dir.path().join("missions");
    let drive = |folder: &std::path::Path| {
        let folder = folder.to_str().expect("text");
        let console = Console::start(&["--demo", "--pace", "100", "--record", folder]);
        let operator = console.operator();
        let begun = operator.get("/api/state")["event"].as_str().expect("an id").to_owned();
        let said = operator.done("/api/say", &json!({ "text": "Поезжай к Точке-К" }));
        operator.done(&format!("/api/tasks/{}/confirm", said["task"]["task"]), &json!({}));
        let head = format!("{}Last-Event-ID: {begun}\r\n", operator.cookie);
        let told = events(&console, &head, is_done);
        let mut data = told.lines().filter_map(|line| line.strip_prefix("data: "));
        let ended = data.rfind(|line| line.contains(r#""state":"done""#));
        serde_json::from_str::<Value>(ended.expect("an end")).expect("JSON")
    };
    let ended = drive(&folder);
    let file = ended["recorded"].as_str().expect("a file");
    let replayed = ortho().args(["replay", file]).output().expect("the program starts");
    let words = String::from_utf8_lossy(&replayed.stdout).into_owned();
    assert!(replayed.status.success() && words.contains("Поезжай к Точке-К"), "{words}");
    assert_eq!(std::fs::read_dir(&folder).expect("a folder").count(), 1);

    // A disk that refuses stops no robot.
    std::fs::write(dir.path().join("file"), "").expect("it can be written");
    let ended = drive(&dir.path().join("file"));
    assert!(ended["not_recorded"].as_str().is_some_and(|told| told.contains("file")), "{ended}");
    assert_eq!(ended["state"], "done", "{ended}");
}

#[test]
fn an_edit_that_an_assistant_proposed_is_written_when_the_operator_says_so() {
    let folder = tempfile::tempdir().expect("a folder");
    let store = folder.path().join("store");
    let proposed = folder.path().join("store.proposed");
    std::fs::create_dir(&proposed).expect("a folder");
    let edit = |name: &str| {
        json!({ "reason": "claude: ближе к окну", "edit": [{ "move": name, "to": [400, 320] }] })
            .to_string()
    };
    std::fs::write(proposed.join("1-7.json"), edit("Кресло-1")).expect("a file");
    std::fs::write(proposed.join("1-8.json"), edit("Никто")).expect("a file");
    let console = Console::start(&["--demo", "--store", store.to_str().expect("a path in UTF-8")]);
    let operator = console.operator();
    let looker = operator.invites("look", "Анна");
    let edits = looker.get("/api/edits");
    assert_eq!(edits["edits"][0]["reason"], "claude: ближе к окну", "{edits}");
    assert!(edits["edits"][0]["differences"].as_array().is_some_and(|d| !d.is_empty()), "{edits}");
    assert!(edits["edits"][1]["fault"]["message"].is_string(), "{edits}");
    let yes = |on: u64| json!({ "on": on, "verdict": "confirm" });
    assert_eq!(looker.post("/api/edits/1-7", &yes(1)).status, 403);
    assert_eq!(operator.post("/api/edits/1-8", &yes(1)).status, 422);
    assert_eq!(operator.done("/api/edits/1-7", &yes(1))["revision"], 2);
    let history = operator.get("/api/history");
    let last = history["revisions"].as_array().and_then(|all| all.last()).expect("a revision");
    assert_eq!(
        (&last["user"], &last["reason"]),
        (&json!("operator"), &json!("claude: ближе к окну"))
    );
    assert_eq!(operator.post("/api/edits/1-7", &yes(2)).status, 404);
    operator.done("/api/edits/1-8", &json!({ "on": 2, "verdict": "reject" }));
    assert_eq!(operator.get("/api/edits")["edits"], json!([]));
    assert_eq!(std::fs::read_dir(&proposed).expect("it is there").count(), 0);
}

#[test]
fn a_room_with_a_door_is_drawn_in_steps_and_driven_into() {
    let console = Console::demo();
    let operator = console.operator();
    let about = operator.get("/api/thing?name=%D0%9A%D0%BE%D0%BC%D0%BD%D0%B0%D1%82%D0%B0-Z");
    let parts = about["parts"].as_array().expect("parts");
    // The longest wall without a door.
    let length = |side: &Value| {
        let at = |end: &str, axis: usize| side[end][axis].as_f64().expect("a number");
        (at("to", 0) - at("from", 0)).hypot(at("to", 1) - at("from", 1))
    };
    let sides = parts.iter().flat_map(|part| {
        part["sides"].as_array().into_iter().flatten().map(move |side| (part, side))
    });
    let free = sides.filter(|(_, side)| side["doors"] == json!([]) && side["permeability"] == 0);
    let longest = free.max_by(|a, b| length(a.1).total_cmp(&length(b.1)));
    let (part, side) = longest.expect("a free wall");
    let name = |id: &Value| id.as_str().expect("a name").to_owned();
    let of = format!("{}.{}", name(&part["id"]), name(&side["id"]));
    let edit = json!({
        "on": 1,
        "door": { "new": { "name": "Дверь-новая", "kind": "hinged", "width": 90, "height": 210, "leaves": [{ "hinge": "left" }] } },
        "edit": [
            { "cut": "Комната-Z", "side": of, "from": 20, "to": 110, "as": "D1", "permeability": "conditional" },
            { "bind": "new", "to": "Комната-Z", "side": format!("{}.D1", name(&part["id"])), "opens": "inside" },
        ],
    });
    let edited = operator.done("/api/edits", &edit);
    assert_eq!(edited["revision"], 2, "{edited}");
    let drawing = operator.get("/api/drawing");
    let doors = drawing["doors"].as_array().into_iter().flatten();
    let door = doors.into_iter().find(|door| door["name"] == "Дверь-новая");
    assert_eq!(door.expect("it is drawn")["state"], "open");
    operator.done("/api/undo", &json!({ "on": 2 }));
}

#[test]
fn only_one_drives_at_a_time() {
    let console = Console::demo();
    let operator = console.operator();
    let other = operator.invites("drive", "Борис");
    other.done("/api/lease", &json!({ "do": "take" }));
    let said = operator.done("/api/say", &json!({ "text": "Поезжай к Точке-К" }));
    let confirm = format!("/api/tasks/{}/confirm", said["task"]["task"]);
    let refused = operator.post(&confirm, &json!({}));
    assert_eq!((refused.status, &refused.json()["holder"]), (409, &json!("Борис")));
    other.done("/api/lease", &json!({ "do": "give" }));
    operator.done(&confirm, &json!({}));
    assert_eq!(operator.waits()["state"], "done");
}

#[test]
fn of_two_editors_neither_loses_anything() {
    let console = Console::demo();
    let (first, name) = (console.operator(), "Кресло-1");
    let second = first.invites("edit", "Борис");
    let moved = |to: [f64; 2]| json!({ "on": 1, "edit": [{ "move": name, "to": to }] });
    let mut tried = moved([380.0, 330.0]);
    tried["try"] = json!(true);
    assert_eq!(first.done("/api/edits", &tried)["outcome"], "tried");
    let edited = second.done("/api/edits", &moved([400.0, 320.0]));
    assert_eq!(edited["revision"], 2, "{edited}");
    let stale = first.post("/api/edits", &moved([380.0, 330.0]));
    let told = stale.json();
    assert_eq!((stale.status, &told["code"]), (409, &json!("serve::stale")), "{told}");
    assert_eq!(told["theirs"][0]["user"], "Борис");
    let subject = told["theirs"][0]["differences"][0]["subject"].as_str().unwrap_or_default();
    assert!(subject.contains(name), "{told}");
    assert_eq!(first.get("/api/state")["revision"], 2, "nothing was written");
    assert_eq!(first.post("/api/undo", &json!({ "on": 1 })).status, 409);

    first.done("/api/undo", &json!({ "on": 2 }));
    first.done("/api/redo", &json!({ "on": 3 }));
    let history = first.get("/api/history");
    let users: Vec<&str> = history["revisions"]
        .as_array()
        .expect("revisions")
        .iter()
        .filter_map(|r| r["user"].as_str())
        .collect();
    assert_eq!(users, ["operator", "Борис", "operator", "operator"]);
    let then = first.get("/api/drawing?as_of=1");
    let at = |drawing: &Value| -> Value {
        let things = drawing["things"].as_array().expect("things").iter();
        things.clone().find(|t| t["name"] == name).expect("it stands there")["at"].clone()
    };
    assert_ne!(at(&then), at(&first.get("/api/drawing")));
    // What cannot be is refused with its reason, in both languages.
    let wrong =
        first.post("/api/edits", &json!({ "on": 4, "edit": [{ "move": "Никто", "to": [0, 0] }] }));
    let told = wrong.json();
    assert_eq!(wrong.status, 422, "{told}");
    assert!(told["message"].is_string() && told["message_en"].is_string(), "{told}");
}

#[test]
fn a_plan_is_made_anew_where_the_map_has_changed() {
    let console = Console::demo();
    let operator = console.operator();
    let said = operator.done("/api/say", &json!({ "text": "Поезжай к Точке-К" }));
    let confirm = |task: &Value| format!("/api/tasks/{}/confirm", task["task"]);
    operator.done(
        "/api/edits",
        &json!({ "on": 1, "edit": [{ "move": "Кресло-1", "to": [400, 320] }] }),
    );
    let expired = operator.post(&confirm(&said["task"]), &json!({}));
    let told = expired.json();
    assert_eq!((expired.status, &told["code"]), (409, &json!("serve::expired")), "{told}");
    operator.done(&confirm(&told["task"]), &json!({}));
    assert_eq!(operator.waits()["state"], "done");
}

/// Events of a stream, as far as they come within a time.
fn events(console: &Console, head: &str, until: impl Fn(&str) -> bool) -> String {
    let mut stream = console.connect();
    let request = format!("GET /api/events HTTP/1.1\r\nHost: {}\r\n{head}\r\n", console.at);
    stream.write_all(request.as_bytes()).expect("it listens");
    stream.set_read_timeout(Some(Duration::from_secs(10))).expect("a time-out");
    let (mut text, mut piece) = (String::new(), [0_u8; 4096]);
    while !until(&text) {
        match stream.read(&mut piece) {
            Ok(n) if n > 0 => text.push_str(&String::from_utf8_lossy(&piece[..n])),
            _ => break,
        }
    }
    text
}

/// A task is done, and all of it was told.
fn is_done(text: &str) -> bool {
    text.rsplit_once(r#""state":"done""#).is_some_and(|(_, rest)| rest.contains("\n\n"))
}

#[test]
fn events_go_on_after_a_break_where_they_stopped() {
    let console = Console::demo();
    let operator = console.operator();
    let begun = operator.get("/api/state")["event"].as_str().expect("an id").to_owned();
    for on in 1..4 {
        let to = json!([400 + on, 320]);
        operator
            .done("/api/edits", &json!({ "on": on, "edit": [{ "move": "Кресло-1", "to": to }] }));
    }
    let head = |id: &str| format!("{}Last-Event-ID: {id}\r\n", operator.cookie);
    let all = events(&console, &head(&begun), |text| text.matches("event: revision").count() == 3);
    let ids: Vec<&str> = all.lines().filter_map(|line| line.strip_prefix("id: ")).collect();
    assert_eq!(ids.len(), 3, "{all}");
    let rest = events(&console, &head(ids[0]), |text| text.matches("event: revision").count() == 2);
    let after: Vec<&str> = rest.lines().filter_map(|line| line.strip_prefix("id: ")).collect();
    assert_eq!(after, ids[1..], "{rest}");
    // One of another run of the program says nothing of this one.
    let foreign = events(&console, &head("0badc0de-1"), |text| text.contains("event: gap"));
    assert!(foreign.contains("event: gap"), "{foreign}");
}

#[test]
fn a_foreign_host_is_refused_before_anything_else() {
    let console = Console::demo();
    let ask = |request: String| console.raw(request.as_bytes()).status;
    for host in ["evil.example", "localhost", "127.0.0.1:1", "evil.example:8430", ""] {
        assert_eq!(ask(format!("GET / HTTP/1.1\r\nHost: {host}\r\n\r\n")), 421, "{host}");
    }
    let (at, port) = (&console.at, console.at.rsplit(':').next().expect("a port"));
    assert_eq!(ask(format!("GET / HTTP/1.1\r\nHost: localhost:{port}\r\n\r\n")), 200);
    assert_eq!(ask("GET / HTTP/1.0\r\n\r\n".to_owned()), 421);
    assert_eq!(ask(format!("GET / HTTP/1.1\r\nHost: {at}\r\nHost: evil.example\r\n\r\n")), 421);
    assert_eq!(ask(format!("GET http://evil.example/ HTTP/1.1\r\nHost: {at}\r\n\r\n")), 421);
    // A token is not spent by whoever may not come in.
    let token = &console.token;
    assert_eq!(ask(format!("GET /?token={token} HTTP/1.1\r\nHost: evil.example\r\n\r\n")), 421);
    assert!(console.enter(token).is_some());
}

#[test]
fn what_changes_something_comes_from_the_page_or_not_at_all() {
    let console = Console::demo();
    let operator = console.operator();
    let (cookie, own) = (&operator.cookie, format!("Origin: http://{}\r\n", console.at));
    let stop = |head: String| console.post_with("/api/stop", &head, "{}").status;
    assert_eq!(stop(format!("{cookie}{own}Sec-Fetch-Site: same-origin\r\n")), 200);
    for head in [
        String::new(),
        "Sec-Fetch-Site: same-origin\r\n".to_owned(),
        own.clone(),
        format!("{own}Sec-Fetch-Site: cross-site\r\n"),
        format!("{own}Sec-Fetch-Site: same-site\r\n"),
        "Origin: null\r\nSec-Fetch-Site: same-origin\r\n".to_owned(),
        "Origin: http://evil.example\r\nSec-Fetch-Site: same-origin\r\n".to_owned(),
        format!("{own}{own}Sec-Fetch-Site: same-origin\r\n"),
    ] {
        assert_eq!(stop(format!("{cookie}{head}")), 403, "{head}");
    }
    // Another site's picture or script asks for nothing here.
    let foreign = console.get("/api/state", &format!("{cookie}Sec-Fetch-Site: cross-site\r\n"));
    assert_eq!(foreign.status, 403);
}

#[test]
fn a_token_is_good_once_and_a_cookie_until_its_session_is_left() {
    let console = Console::demo();
    let operator = console.operator();
    assert_eq!(console.enter(&console.token), None, "replayed");
    assert_eq!(console.get("/api/state", "").status, 401);
    assert_eq!(console.get("/api/state", "Cookie: ortho=1; x\r\n").status, 401);
    let mut other = operator.cookie.clone();
    let last = other.trim_end().chars().last().expect("a digit");
    let changed = if last == '0' { '1' } else { '0' };
    other = format!("{}{changed}\r\n", &other.trim_end()[..other.trim_end().len() - 1]);
    assert_eq!(console.get("/api/state", &other).status, 401);
    operator.done("/api/leave", &json!({}));
    assert_eq!(console.get("/api/state", &operator.cookie).status, 401, "replayed");
}

#[test]
fn no_path_leads_out_of_the_page() {
    let console = Console::demo();
    for path in [
        "/../Cargo.toml",
        "/%2e%2e/%2e%2e/etc/passwd",
        "/..%2f..%2fetc%2fpasswd",
        "//etc/passwd",
        "/fonts/../../mod.rs",
        "/page/index.html",
        "/api/../style.css",
        "/style.css%00",
        "/openapi.json",
    ] {
        let status = console.get(path, "").status;
        assert!([400, 404].contains(&status), "{path}: {status}");
    }
    let page = console.get("/", "");
    let policy = page.header("content-security-policy").expect("a policy");
    assert!(policy.starts_with("default-src 'self';") && !policy.contains("unsafe"), "{policy}");
    assert_eq!(page.header("x-content-type-options"), Some("nosniff"));
}

#[test]
fn whoever_says_nothing_keeps_nobody_out() {
    let console = Console::demo();
    let operator = console.operator();
    // Half of a request each, of more than there are places for.
    let half = format!("GET / HTTP/1.1\r\nHost: {}\r\n", console.at);
    let mut silent = Vec::new();
    for _ in 0..900 {
        let mut stream = console.connect();
        let _ = stream.write_all(half.as_bytes());
        silent.push(stream);
    }
    let begun = Instant::now();
    assert_eq!(operator.get("/api/state")["revision"], 1);
    assert!(begun.elapsed() < Duration::from_secs(8), "{:?}", begun.elapsed());
    // And they do not stay: the head of a request must be told in time.
    let last = silent.last_mut().expect("there are some");
    last.set_read_timeout(Some(Duration::from_secs(20))).expect("a time-out");
    let mut rest = Vec::new();
    assert!(last.read_to_end(&mut rest).is_ok(), "it is closed");
}

#[test]
fn what_is_too_large_is_not_read() {
    let console = Console::demo();
    let operator = console.operator();
    let head = format!(
        "POST /api/say HTTP/1.1\r\nHost: {}\r\n{}{}Content-Type: application/json\r\n",
        console.at,
        operator.cookie,
        console.own()
    );
    let whole = format!("{head}Content-Length: 1073741824\r\n\r\n{{\"text\":\"");
    assert_eq!(console.raw(whole.as_bytes()).status, 413);
    // A gigabyte in pieces, as far as it is taken.
    let mut stream = console.connect();
    stream.set_write_timeout(Some(Duration::from_secs(5))).expect("a time-out");
    let begin = format!("{head}Transfer-Encoding: chunked\r\n\r\n");
    stream.write_all(begin.as_bytes()).expect("it listens");
    let piece = format!("10000\r\n{}\r\n", "a".repeat(0x10000));
    let taken = (0..16_384).take_while(|_| stream.write_all(piece.as_bytes()).is_ok()).count();
    assert!(taken < 2_000, "{taken} pieces of 64 KiB were taken");
    let huge =
        format!("GET / HTTP/1.1\r\nHost: {}\r\nX: {}\r\n\r\n", console.at, "a".repeat(1 << 20));
    assert_eq!(console.raw(huge.as_bytes()).status, 431);
    assert_eq!(operator.get("/api/state")["revision"], 1, "it goes on");
}

#[test]
fn a_console_for_others_needs_a_token() {
    for more in [&["--listen", "0.0.0.0"][..], &["--listen", "0.0.0.0", "--token", "short"]] {
        let mut command = ortho();
        command.args(["serve", "--demo", "--port", "0"]).args(more).env_remove("ORTHO_TOKEN");
        let done = command.output().expect("it runs");
        assert!(!done.status.success(), "{more:?}");
    }
}

#[test]
fn sessions_outlive_a_kill() {
    let dir = tempfile::tempdir().expect("a directory");
    let store = dir.path().join("store");
    let store = store.to_str().expect("a path in UTF-8");
    let console = Console::start(&["--demo", "--store", store]);
    let operator = console.operator();
    operator.done(
        "/api/edits",
        &json!({ "on": 1, "edit": [{ "move": "Кресло-1", "to": [400, 320] }] }),
    );
    let (cookie, port) =
        (operator.cookie, console.at.rsplit(':').next().expect("a port").to_owned());
    // Not asked to end: killed.
    drop(console);
    let mut console = Console::start(&["--demo", "--store", store, "--port", &port]);
    console.token.clear();
    let operator = Operator { console: &console, cookie };
    assert_eq!(operator.get("/api/state")["revision"], 2);
}

/// Assistants bear a token, and are kept out by the same gate as all others.
#[test]
fn an_assistant_without_the_token_is_kept_out() {
    let token = "0123456789abcdef";
    let console = Console::start(&["--demo", "--token", token]);
    let hello =
        json!({ "jsonrpc": "2.0", "id": 1, "method": "tools/list", "params": {} }).to_string();
    let post = |host: &str, more: &str| {
        let request = format!(
            "POST /mcp HTTP/1.1\r\nHost: {host}\r\nContent-Type: application/json\r\nAccept: application/json, text/event-stream\r\n\
             Content-Length: {}\r\nConnection: close\r\n{more}\r\n{hello}",
            hello.len()
        );
        console.raw(request.as_bytes()).status
    };
    let bearer = format!("Authorization: Bearer {token}\r\n");
    assert_eq!(post(&console.at, ""), 401);
    assert_eq!(post(&console.at, "Authorization: Bearer 0123456789abcdee\r\n"), 401);
    assert_eq!(post(&console.at, &format!("Authorization: Bearer {}\r\n", console.token)), 401);
    assert_eq!(post(&console.at, &format!("{bearer}Origin: http://evil.example\r\n")), 403);
    assert_eq!(post("evil.example", &bearer), 421);
    // A cookie is the browser's, and drives no tools.
    let cookie = console.operator().cookie;
    assert_eq!(post(&console.at, &format!("Cookie: {cookie}\r\n")), 401);
    assert!(![401, 403, 421].contains(&post(&console.at, &bearer)));
}

/// The centre's map of docs/fleet.md: let in by the token that lies beside the store, on the revision that it was compared with,
/// and not from under a robot that drives.
#[test]
fn a_map_of_a_centre_is_taken_and_by_nobody_else() {
    use orthoframe_store::shipping::pack_rows;
    let dir = tempfile::tempdir().expect("a directory");
    let store = dir.path().join("store");
    let started = ["--demo", "--pace", "1", "--store", store.to_str().expect("a path in UTF-8")];
    let mut console = Console::start(&started);
    let note = dir.path().join("store.held");
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt as _;
        let mode = std::fs::metadata(&note).expect("it is there").permissions().mode();
        assert_eq!(mode & 0o777, 0o600);
    }
    let held: Value =
        serde_json::from_slice(&std::fs::read(&note).expect("reads")).expect("it is JSON");
    assert_eq!(held["address"], json!(format!("http://{}", console.at)));
    let bearer = format!("Authorization: Bearer {}\r\n", held["token"].as_str().expect("a token"));
    let mut world = orthoframe_store::Store::open_read_only(&store)
        .expect("opens")
        .0
        .world()
        .expect("reads")
        .expect("a map");
    let thing = world.replicas.values_mut().find(|r| r.name == "Кресло-1").expect("it is there");
    thing.frame.x = orthoframe_units::Cm::of(thing.frame.x.get() + 1.0);
    let sheet = orthoframe_store::Sheet::of(&world).expect("records");
    let rows = pack_rows(sheet.iter().map(|(table, _, row)| (table, row)));
    let post = |more: &str, on: u64, rows: &[u8]| {
        let told = json!({ "on": on, "author": "Диспетчер", "reason": "центр" }).to_string();
        let body = [told.as_bytes(), b"\n", rows].concat();
        let head = format!(
            "POST /centre/map HTTP/1.1\r\nHost: {}\r\nConnection: close\r\nContent-Length: {}\r\n{more}\r\n",
            console.at,
            body.len()
        );
        console.raw(&[head.as_bytes(), &body].concat())
    };
    let operator = console.operator();
    for stranger in ["", "Authorization: Bearer 0123456789abcdef\r\n", &operator.cookie] {
        assert_eq!(post(stranger, 1, &rows).status, 401, "{stranger}");
    }
    assert_eq!(post(&format!("{bearer}Origin: http://evil.example\r\n"), 1, &rows).status, 403);
    // Bytes that are no map change nothing, and neither does a map that was compared with another.
    for (rows, on, status) in [(&rows[..7], 1, 422), (&[255][..], 1, 422), (&rows, 7, 409)] {
        let answer = post(&bearer, on, rows);
        assert_eq!(answer.status, status, "{answer:?}");
    }
    let said = operator.done("/api/say", &json!({ "text": "Поезжай к Точке-К" }));
    operator.done(&format!("/api/tasks/{}/confirm", said["task"]["task"]), &json!({}));
    let driving = post(&bearer, 1, &rows);
    assert_eq!((driving.status, &driving.json()["code"]), (409, &json!("serve::driving")));
    operator.done("/api/stop", &json!({}));
    let begin = Instant::now();
    let taken = loop {
        let answer = post(&bearer, 1, &rows);
        if answer.status == 200 || begin.elapsed() > Duration::from_secs(20) {
            break answer;
        }
        std::thread::sleep(Duration::from_millis(50));
    };
    assert_eq!((taken.status, &taken.json()["revision"]), (200, &json!(2)), "{taken:?}");
    assert_eq!(operator.get("/api/state")["revision"], 2);
    // Asked to end, it takes its note away.
    let id = console.child.id().to_string();
    drop(operator);
    Command::new("kill").args(["-TERM", &id]).status().expect("it is told");
    console.child.wait().expect("it ended");
    assert!(!note.exists());
}

/// Programs of another make that speak to assistants' tools; `.ci/run` says how they are installed.
#[test]
fn an_assistant_works() {
    judged(
        "python3",
        &["src/serve/judges/assistant.py".into(), env!("CARGO_BIN_EXE_ortho").into()],
    );
}

#[test]
#[expect(clippy::print_stdout, reason = "a test that was not made should say so")]
fn the_protocol_of_assistants_is_kept() {
    let judges =
        std::path::Path::new(env!("CARGO_MANIFEST_DIR")).join("target/judges/node_modules");
    let node = judges.join(".bin/node");
    let suite = judges.join("@modelcontextprotocol/conformance/dist/index.js");
    if !node.exists() || !suite.exists() {
        assert!(std::env::var_os("CI").is_none(), "the conformance suite is missing");
        return println!("skipped: there is no conformance suite");
    }
    let text = |path: std::path::PathBuf| path.to_str().expect("a path in UTF-8").to_owned();
    let ortho = env!("CARGO_BIN_EXE_ortho").to_owned();
    let script = "src/serve/judges/conformance.py".to_owned();
    judged("python3", &[script, ortho, text(node), text(suite)]);
}

/// All that may be asked is answered as it is described; the other tests look at what they ask for too.
#[test]
fn whatever_may_be_asked_is_answered_as_described() {
    let console = Console::demo();
    let operator = console.operator();
    for path in [
        "/api/state",
        "/api/drawing",
        "/api/drawing?most=1",
        "/api/drawing?as_of=1",
        "/api/drawing?box=0,0,300,300",
        "/api/floor",
        "/api/kinds",
        "/api/complete?text=%D0%B3%D0%B4%D0%B5",
        "/api/history",
        "/api/diff?from=0",
        "/api/diff?from=0&to=1",
        "/api/proposals",
        "/api/tasks",
        "/api/edits",
    ] {
        operator.get(path);
    }
    let percent = |text: &str| text.bytes().map(|b| format!("%{b:02X}")).collect::<String>();
    let drawing = operator.get("/api/drawing");
    for sort in ["things", "rooms", "doors", "places"] {
        for one in drawing[sort].as_array().into_iter().flatten().take(12) {
            let Some(name) = one["name"].as_str().map(percent) else { continue };
            let about = operator.get(&format!("/api/thing?name={name}&lang=en"));
            operator.get(&format!("/api/route?to={name}&lang=en"));
            for relation in about["relations"].as_array().into_iter().flatten().take(6) {
                let args = relation["args"].as_array().into_iter().flatten();
                let args: Option<Vec<&str>> = args.map(Value::as_str).collect();
                let Some(of) = args.map(|args| percent(&args.join(","))) else { continue };
                let relation = relation["relation"].as_str().map(percent).unwrap_or_default();
                let why = operator.get(&format!("/api/why?relation={relation}&of={of}&lang=en"));
                assert_eq!(why["holds"], true, "{why}");
            }
        }
    }
    let why = |relation: &str, of: &str| {
        operator.get(&format!("/api/why?relation={}&of={}&lang=ru", percent(relation), percent(of)))
    };
    let far = why("НАХОДИТСЯ_РЯДОМ_С", "Стул-1,Кресло-1");
    assert_eq!(far["holds"], false, "{far}");
    assert!(far["about"].as_array().is_some_and(|about| about.contains(&json!("Кресло-1"))));
    let near = why("НАХОДИТСЯ_СВЕРХУ_НА", "Книга-4,Стол-1");
    let over = near["measures"].as_array().into_iter().flatten();
    let mut over = over.filter(|m| m["of"] == json!(["Книга-4", "Стол-1"]));
    let over = over.next().unwrap_or_else(|| panic!("it is measured: {near}"));
    assert_eq!(over["ends"][0], over["ends"][1], "one lies over the other: {over}");
    for role in ["take", "keep", "give"] {
        operator.done("/api/lease", &json!({ "do": role }));
    }
    operator.done("/api/later", &json!({ "text": "Поезжай к Точке-К" }));
    operator.done("/api/shortest", &json!({}));
    operator.done("/api/pause", &json!({}));
    operator.done("/api/stop", &json!({}));
    operator.done("/api/reset", &json!({}));
}

/// A point of the floor is driven to, and what cannot be one is refused.
#[test]
fn a_point_of_the_floor_is_driven_to() {
    let console = Console::demo();
    let operator = console.operator();
    let rooms = operator.get("/api/drawing")["rooms"].clone();
    for (number, room) in rooms.as_array().into_iter().flatten().enumerate() {
        let [x, y] = [0, 1].map(|axis| room["middle"][axis].as_f64().expect("a number").round());
        let (text, lang) = match number % 2 {
            0 => (format!("Поезжай в точку ({x}; {y})"), "ru"),
            _ => (format!("Go to the point ({x}, {y})"), "en"),
        };
        let said = operator.done("/api/say", &json!({ "text": text, "lang": lang }));
        let task = said["task"]["task"].as_u64().unwrap_or_else(|| panic!("{text}: {said}"));
        operator.done(&format!("/api/tasks/{task}/confirm"), &json!({}));
        assert_eq!(operator.waits()["state"], "done", "{text}");
        let pose = operator.get("/api/state")["robot"]["place"]["pose"].clone();
        let [at_x, at_y] = ["x", "y"].map(|axis| pose[axis].as_f64().expect("a number"));
        // Where a thing stands there, as near to it as the robot fits.
        assert!((at_x - x).hypot(at_y - y) < 75.0, "{text}: {pose}");
    }
    for text in [
        "Поезжай в точку (-90000; 0)",
        "Положи лекарство в точку (330; 265)",
        "Go to the point (0, 90000)",
    ] {
        let said = operator.post("/api/say", &json!({ "text": text, "lang": "ru" })).json();
        assert!(said["task"].is_null(), "{text}: {said}");
    }
}

/// What an operator does, done in a real Chromium.
#[test]
fn an_operator_works_in_a_browser() {
    judged("python3", &["src/serve/judges/operator.py".into(), env!("CARGO_BIN_EXE_ortho").into()]);
}

/// What an editor draws, and what waits to be done.
#[test]
fn an_editor_draws_in_a_browser() {
    judged("python3", &["src/serve/judges/editor.py".into(), env!("CARGO_BIN_EXE_ortho").into()]);
}

/// Reasons on the map, what was seen elsewhere, points of the floor, any two revisions.
#[test]
fn a_person_looks_into_things_in_a_browser() {
    judged("python3", &["src/serve/judges/reasons.py".into(), env!("CARGO_BIN_EXE_ortho").into()]);
}

/// By keys alone, and as axe sees it.
#[test]
fn the_console_is_used_without_a_pointer() {
    judged("python3", &["src/serve/judges/access.py".into(), env!("CARGO_BIN_EXE_ortho").into()]);
}

/// The house of docs/start.md, in the console: an order is driven, a thing is moved, and both stand in the store.
#[test]
fn the_house_of_the_guide_is_driven_and_edited_in_the_console() {
    let folder = tempfile::tempdir().expect("a folder");
    let root = std::path::Path::new(env!("CARGO_MANIFEST_DIR"));
    let store = folder.path().join("store").display().to_string();
    let plan = root.join("docs/start/plan.png").display().to_string();
    let run = |arguments: &[&str]| {
        let mut command = ortho();
        let told = command.args(["--lang", "en", "--store", &store]).args(arguments).output();
        let told = told.expect("the program starts");
        assert!(told.status.success(), "{}", String::from_utf8_lossy(&told.stderr));
        String::from_utf8_lossy(&told.stdout).into_owned()
    };
    run(&["import", &plan, "--pixel", "2"]);
    let guide = std::fs::read_to_string(root.join("docs/start.md")).expect("the guide");
    for name in ["names.toml", "furniture.toml"] {
        let (_, after) = guide.split_once(&format!("```toml {name}\n")).expect("it is shown");
        let file = folder.path().join(name);
        std::fs::write(&file, after.split("```").next().expect("a piece")).expect("room");
        run(&["edit", "--file", &file.display().to_string()]);
    }
    let console = Console::start(&["--store", &store, "--pace", "50"]);
    let operator = console.operator();
    let said = operator.done("/api/say", &json!({ "text": "Bring the cup", "lang": "en" }));
    let task = &said["task"];
    assert_eq!(task["state"], "planned", "{said}");
    operator.done(&format!("/api/tasks/{}/confirm", task["task"]), &json!({}));
    assert_eq!(operator.waits()["state"], "done");
    let revision = operator.get("/api/state")["revision"].clone();
    let moved = json!({
        "on": revision, "reason": "closer to the wall", "edit": [{ "move": "Couch", "by": [5, 0] }],
    });
    assert_eq!(operator.done("/api/edits", &moved)["outcome"], "edited");
    drop(console);
    assert!(run(&["history"]).contains("closer to the wall"));
    assert!(run(&["ask", "Where is the cup?"]).contains("cup"));
}
