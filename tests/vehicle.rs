//! A vehicle of the caller's: stopped at any moment, elsewhere behind the protocol, and one that misbehaves (SPEC X3, X5, I4).

use std::io::{BufRead, BufReader, PipeReader, PipeWriter, Read, Write, pipe};
use std::process::{Command, Stdio};
use std::thread;
use std::time::{Duration, Instant};

use orthoframe::Engine;
use orthoframe::engine::{Progress, TaskAnswer, TaskEnding, change_now};
use orthoframe_map::{Entity, World};
use orthoframe_robot::{
    Address, Failure, Moment, Patience, RemoteVehicle, Simulator, Vehicle, protocol, serve,
    starting_pose,
};
use orthoframe_units::{Language, Stop};
use serde_json::{Value, json};
use tempfile::TempDir;

use crate::files::project;

pub(crate) const TASK: &str = "Принеси лекарство";
pub(crate) const RB2: &str = "maps/rb2.toml";
pub(crate) const HOUSE: &str = "maps/two-storeys.toml";

/// An engine with a store, whose map is this file.
pub(crate) fn engine(map: &str) -> (TempDir, Engine) {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = Engine::open(&dir.path().join("store"), None).unwrap();
    engine.import(&project(map), &change_now("test", "survey")).unwrap();
    (dir, engine)
}

pub(crate) fn world(map: &str) -> World {
    World::load(project(map)).unwrap()
}

fn robot(world: &World) -> Simulator {
    let (map, pose) = starting_pose(world).unwrap();
    Simulator::new(world.clone(), map, pose)
}

pub(crate) fn drive(
    engine: &Engine,
    task: &str,
    vehicle: &mut dyn Vehicle,
    stop: &Stop,
    tell: &mut dyn FnMut(&Progress<'_>),
) -> TaskAnswer {
    let commands = engine.understand(task).unwrap();
    engine.carry_out_with(&commands, vehicle, tell, stop).unwrap()
}

fn remember(engine: &mut Engine, answer: &TaskAnswer) {
    engine.remember(answer, std::time::SystemTime::now().into()).unwrap();
}

/// What is believed is what is so.
fn check_belief(how: &str, engine: &Engine, robot: &Simulator) {
    let now = engine.uncarried().unwrap();
    let truth = robot.truth();
    assert_eq!(engine.robot().unwrap(), robot.pose(), "{how}");
    for (id, door) in &truth.doors {
        assert_eq!(now.doors[id].state, door.state, "{how}: {}", door.name);
    }
    let things = |world: &World| -> Vec<_> {
        world.replicas.values().map(|r| (r.id, r.area, r.frame)).collect()
    };
    assert_eq!(things(now), things(truth), "{how}");
}

/// All that a task came to, but the clock of the machine.
fn told(answer: &TaskAnswer) -> String {
    let after = answer.after.as_ref().map(|after| (&after.memory, &after.moved));
    let ending = match &answer.ending {
        TaskEnding::NoPlan(_) => "no plan".to_owned(),
        ending => format!("{ending:?}"),
    };
    format!(
        "{ending}\n{:?}\n{:?} {:?} {:?}\n{:#?}\n{after:?}",
        answer.goal, answer.end, answer.seconds, answer.replans, answer.reports
    )
}

/// How a proxy treats a line from the vehicle to the mission.
pub(crate) enum Treat {
    Pass,
    Say(String),
    Hang,
    Die,
}

/// Offers our simulator through pipes; each line that it says, counted from 1, is treated first.
pub(crate) fn peer(
    truth: World,
    pace: Option<f64>,
    mut treat: impl FnMut(usize, &str) -> Treat + Send + 'static,
) -> (PipeReader, PipeWriter) {
    let (orders, to_vehicle) = pipe().unwrap();
    let (said, says) = pipe().unwrap();
    let (heard, mut to_mission) = pipe().unwrap();
    thread::spawn(move || {
        let mut robot = robot(&truth);
        let mut last = 0.0;
        let mut wait = |moment: &Moment| {
            if let Some(pace) = pace {
                thread::sleep(Duration::from_secs_f64((moment.time - last).max(0.0) / pace));
            }
            last = moment.time;
        };
        serve(&mut robot, "test", &truth, orders, says, &mut wait);
    });
    thread::spawn(move || {
        for (n, line) in BufReader::new(said).lines().enumerate() {
            let Ok(line) = line else { return };
            let line = match treat(n + 1, &line) {
                Treat::Pass => line,
                Treat::Say(other) => other,
                Treat::Die => return,
                Treat::Hang => loop {
                    thread::park();
                },
            };
            if to_mission.write_all((line + "\n").as_bytes()).is_err() {
                return;
            }
        }
    });
    (heard, to_vehicle)
}

const IMPATIENT: Patience =
    Patience { silence: Duration::from_millis(600), order: Duration::from_secs(60) };

fn connect(
    engine: &Engine,
    (from, to): (PipeReader, PipeWriter),
) -> Result<RemoteVehicle, Failure> {
    RemoteVehicle::over(from, to, engine.world().unwrap(), IMPATIENT)
}

#[test]
fn a_task_through_the_protocol_comes_to_what_it_does_within_the_process() {
    let tasks = [
        (RB2, TASK),
        (RB2, "Закрой Дверь-ВZ"),
        (RB2, "Включи торшер"),
        (RB2, "Найди красную чашку"),
        (HOUSE, "Bring the book"),
    ];
    for (map, task) in tasks {
        let (_dir, engine) = engine(map);
        let within = engine.perform(task, &mut |_| {}).unwrap();
        let mut remote = connect(&engine, peer(world(map), None, |_, _| Treat::Pass)).unwrap();
        let through = drive(&engine, task, &mut remote, &Stop::new(), &mut |_| {});
        assert!(within.ending.is_done(), "{task}: {:?}", within.ending);
        assert_eq!(told(&within), told(&through), "{task}");
    }
}

/// The truth has what the map has not: a door that is locked, seen and told through the protocol.
#[test]
fn a_surprise_is_told_through_the_protocol() {
    let (_dir, engine) = engine(RB2);
    let mut truth = world(RB2);
    let name = "Дверь-ВZ";
    let door = truth.doors.values_mut().find(|door| door.name == name).unwrap();
    door.state = orthoframe_map::DoorState::LOCKED;
    let within = engine.perform_in(TASK, truth.clone(), &mut |_| {}).unwrap();
    let mut remote = connect(&engine, peer(truth, None, |_, _| Treat::Pass)).unwrap();
    let through = drive(&engine, TASK, &mut remote, &Stop::new(), &mut |_| {});
    assert!(within.replans > 0 && !matches!(within.ending, TaskEnding::Failed(_)));
    assert_eq!(told(&within), told(&through));
}

/// Raised at each event of a task in turn, a stop leaves what is so, and the next task comes to its end. Events of the way
/// are many: each so-many-th is taken, all with `ORTHOFRAME_LONG` set.
#[test]
fn a_task_stopped_at_any_event_leaves_what_the_next_begins_from() {
    let tasks = [(RB2, TASK, TASK, 29), (HOUSE, "Bring the book", "Bring the book", 97)];
    let all = crate::files::long();
    for (map, task, next, sampled) in tasks {
        let (_dir, mut engine) = engine(map);
        // Numbers of the events at which to stop.
        let (mut events, mut ways, mut at) = (0, 0, Vec::new());
        let whole = drive(&engine, task, &mut robot(&world(map)), &Stop::new(), &mut |progress| {
            events += 1;
            let is_way = matches!(progress, Progress::Moved(_));
            ways += usize::from(is_way);
            if all
                || (is_way && ways % sampled == 0)
                || (!is_way && (map == RB2 || events % 3 == 0))
            {
                at.push(events);
            }
        });
        assert!(matches!(whole.ending, TaskEnding::Done), "{:?}", whole.ending);
        let (mut stopped, mut on_the_way, mut laden) = (0, 0, 0);
        for &n in &at {
            let how = format!("{map}, event {n} of {events}");
            let (stop, mut heard) = (Stop::new(), 0);
            let mut robot = robot(&world(map));
            let answer = drive(&engine, task, &mut robot, &stop, &mut |progress| {
                assert!(heard < n || matches!(progress, Progress::Finished(_)), "{how}: goes on");
                heard += 1;
                if heard == n {
                    stop.raise();
                    on_the_way += usize::from(matches!(progress, Progress::Moved(_)));
                }
            });
            let is_stopped = matches!(answer.ending, TaskEnding::Stopped);
            // What was the last thing to do was done.
            assert!(is_stopped || n + 2 >= events, "{how}: {:?}", answer.ending);
            stopped += usize::from(is_stopped);
            remember(&mut engine, &answer);
            check_belief(&how, &engine, &robot);
            laden += usize::from(engine.held().unwrap().is_some());
            let after = drive(&engine, next, &mut robot, &Stop::new(), &mut |_| {});
            assert!(after.ending.is_done(), "{how}: then {:?}", after.ending);
            remember(&mut engine, &after);
            check_belief(&format!("{how}, the task after it"), &engine, &robot);
            engine.reset_robot(&change_now("test", "again")).unwrap();
        }
        assert!(stopped > 10 && on_the_way > 2 && laden > 2, "{stopped} {on_the_way} {laden}");
    }
}

#[test]
fn a_task_that_is_stopped_before_it_begins_does_nothing() {
    let (_dir, engine) = engine(RB2);
    let stop = Stop::new();
    stop.raise();
    let mut robot = robot(&world(RB2));
    let answer = drive(&engine, TASK, &mut robot, &stop, &mut |p| panic!("{p:?}"));
    assert!(matches!(answer.ending, TaskEnding::Stopped));
    assert!(answer.reported.is_some());
    check_belief("not begun", &engine, &robot);
}

/// The robot drives by the clock, and another thread stops it.
#[test]
fn another_thread_stops_a_drive_through_the_protocol() {
    let (_dir, mut engine) = engine(RB2);
    let mut remote = connect(&engine, peer(world(RB2), Some(1.0), |_, _| Treat::Pass)).unwrap();
    let stop = Stop::new();
    let elsewhere = stop.clone();
    let mut hand = Some(thread::spawn(move || {
        thread::sleep(Duration::from_millis(700));
        elsewhere.raise();
        Instant::now()
    }));
    let mut moved = 0;
    let answer = drive(&engine, TASK, &mut remote, &stop, &mut |progress| {
        moved += usize::from(matches!(progress, Progress::Moved(_)));
    });
    let raised = hand.take().unwrap().join().unwrap();
    assert!(raised.elapsed() < Duration::from_secs(5), "it stands soon");
    assert!(matches!(answer.ending, TaskEnding::Stopped), "{:?}", answer.ending);
    assert_eq!(remote.pose(), (answer.end_map, answer.end));
    remember(&mut engine, &answer);
    let next = engine.perform(TASK, &mut |_| {}).unwrap();
    assert!(next.ending.is_done(), "{:?}", next.ending);
}

/// A kind of misbehaviour, and how it is told: the end of its code.
type Fault = (&'static str, fn(&str) -> Treat, &'static [&'static str]);

/// A line of the vehicle with one value put otherwise.
fn with(line: &str, at: &str, value: Value) -> Treat {
    let mut message: Value = serde_json::from_str(line).unwrap();
    *message.pointer_mut(at).unwrap() = value;
    Treat::Say(message.to_string())
}

fn raw(line: &str, number: &str) -> Treat {
    let x: Value = serde_json::from_str(line).unwrap();
    let shown = format!("\"x\":{}", x["at"]["x"]);
    assert!(line.contains(&shown), "{line}");
    Treat::Say(line.replace(&shown, &format!("\"x\":{number}")))
}

const FAULTS: [Fault; 16] = [
    ("hangs", |_| Treat::Hang, &["timed_out"]),
    ("dies", |_| Treat::Die, &["lost"]),
    ("says what is no JSON", |_| Treat::Say("Здравствуйте!".to_owned()), &["rubbish"]),
    ("says another JSON", |_| Treat::Say("[1, 2]".to_owned()), &["rubbish"]),
    ("says bytes that move the cursor", |_| Treat::Say("\u{1b}[2J\u{7}".to_owned()), &["rubbish"]),
    ("says a line without end", |_| Treat::Say("9".repeat(3 << 20)), &["rubbish"]),
    ("says a word that there is none", |line| with(line, "/say", json!("dance")), &["rubbish"]),
    ("answers another order", |line| with(line, "/id", json!(100_000)), &["rubbish"]),
    ("is on a map that there is none", |line| with(line, "/at/map", json!("Луна")), &["rubbish"]),
    ("is at no number", |line| raw(line, "NaN"), &["rubbish"]),
    ("is at infinity", |line| raw(line, "1e999"), &["rubbish"]),
    ("is beyond all buildings", |line| raw(line, "1e300"), &["no_number"]),
    ("is off the way", |line| raw(line, "-700.5"), &["off_the_way", "off_the_map"]),
    ("has a clock that goes back", |line| with(line, "/time", json!(-1.0)), &["no_number"]),
    ("fails by itself", |line| with(line, "/say", json!("failed")), &["rubbish"]),
    (
        "gives up",
        |line| {
            let mut message: Value = serde_json::from_str(line).unwrap();
            (message["say"], message["text"]) = (json!("failed"), json!("колесо отвалилось"));
            Treat::Say(message.to_string())
        },
        &["own_fault"],
    ),
];

/// Whatever a vehicle does, and when: the mission ends with a report, the store keeps what was known, and the next task is
/// carried out.
#[test]
fn a_vehicle_that_misbehaves_at_any_moment_ends_the_mission_and_nothing_else() {
    let (_dir, mut engine) = engine(RB2);
    let lines = {
        let (count, counted) = std::sync::mpsc::channel();
        let through = peer(world(RB2), None, move |n, _| {
            let _gone = count.send(n);
            Treat::Pass
        });
        let mut remote = connect(&engine, through).unwrap();
        drive(&engine, TASK, &mut remote, &Stop::new(), &mut |_| {});
        drop(remote);
        counted.iter().max().unwrap()
    };
    assert!(lines > 100);
    for (kind, (what, treat, codes)) in FAULTS.into_iter().enumerate() {
        // At its greeting, and at a moment that differs from kind to kind.
        for at in [1, 2 + (kind * 37) % (lines - 10)] {
            let how = format!("it {what} in line {at} of {lines}");
            let begun = Instant::now();
            let through = peer(
                world(RB2),
                None,
                move |n, line| {
                    if n >= at { treat(line) } else { Treat::Pass }
                },
            );
            let failure = match connect(&engine, through) {
                Err(failure) => {
                    assert_eq!(at, 1, "{how}: {failure}");
                    failure
                }
                Ok(mut remote) => {
                    let mut last = remote.pose();
                    let answer = drive(&engine, TASK, &mut remote, &Stop::new(), &mut |progress| {
                        if let Progress::Moved(moment) = progress {
                            last = (moment.map, moment.pose);
                        }
                    });
                    remember(&mut engine, &answer);
                    let TaskEnding::Failed(failure) = answer.ending else {
                        panic!("{how}: {:?}", answer.ending)
                    };
                    if answer.after.is_some() {
                        let off = (answer.end.at - last.1.at).norm();
                        assert!(off < 20.0, "{how}: {off} cm from where it was last believed");
                    }
                    failure
                }
            };
            assert!(begun.elapsed() < Duration::from_secs(20), "{how}: {:?}", begun.elapsed());
            let code = miette::Diagnostic::code(&failure).unwrap().to_string();
            // What is told of the greeting alone is the pose: there is no way yet.
            assert!(codes.iter().any(|c| code.ends_with(c)), "{how}: {code}");
            for language in [Language::Russian, Language::English] {
                let said = failure.say(language);
                assert!(!said.contains(char::is_control) && said.chars().count() < 400, "{said}");
            }
            let next = engine.perform(TASK, &mut |_| {}).unwrap();
            assert!(next.ending.is_done(), "{how}: then {:?}", next.ending);
            engine.reset_robot(&change_now("test", "again")).unwrap();
        }
    }
}

#[test]
fn another_version_of_the_protocol_is_refused() {
    let (_dir, engine) = engine(RB2);
    let newer = peer(world(RB2), None, |_, line| with(line, "/protocol", json!(2)));
    assert_eq!(connect(&engine, newer).unwrap_err(), Failure::Version { theirs: 2, ours: 1 });
}

/// It says that it is going, for ever, and goes nowhere; or goes on when it is told to stop.
#[test]
fn a_vehicle_that_only_says_that_it_goes_is_given_up() {
    let (_dir, engine) = engine(RB2);
    for stops in [false, true] {
        let (mut orders, to) = pipe().unwrap();
        let (from, mut says) = pipe().unwrap();
        let (map, pose) = starting_pose(engine.world().unwrap()).unwrap();
        let at = json!({
            "map": engine.world().unwrap().maps[&map].name,
            "x": pose.at.x, "y": pose.at.y, "heading": pose.heading.get(),
        });
        thread::spawn(move || {
            let ready =
                json!({"id": 1, "time": 0, "at": at, "say": "ready", "protocol": 1, "name": "x"});
            writeln!(says, "{ready}").unwrap();
            let mut byte = [0];
            let mut lines = 0;
            while lines < 2 && orders.read(&mut byte).unwrap() > 0 {
                lines += usize::from(byte[0] == b'\n');
            }
            let going = json!({"id": 2, "time": 1, "at": at, "say": "going"});
            while writeln!(says, "{going}").is_ok() {
                thread::sleep(Duration::from_millis(5));
            }
        });
        let patience =
            Patience { silence: Duration::from_millis(400), order: Duration::from_millis(900) };
        let mut remote = RemoteVehicle::over(from, to, engine.world().unwrap(), patience).unwrap();
        let (stop, begun) = (Stop::new(), Instant::now());
        let mut events = 0;
        let answer = drive(&engine, TASK, &mut remote, &stop, &mut |_| {
            events += 1;
            if stops && events == 10 {
                stop.raise();
            }
        });
        let TaskEnding::Failed(failure) = &answer.ending else { panic!("{:?}", answer.ending) };
        let seconds = if stops { 0.4 } else { 0.9 };
        assert_eq!(*failure, Failure::TimedOut { asked: "follow", seconds });
        assert!(begun.elapsed() < Duration::from_secs(10));
    }
}

/// What it sees on its way is believed and planned with; one that sees a door open and shut without end is given up.
#[test]
fn what_a_vehicle_sees_on_its_way_changes_the_plan() {
    let (_dir, engine) = engine(RB2);
    let saw = |line: &str, status: &str, opening: u8| {
        let mut message: Value = serde_json::from_str(line).unwrap();
        message["say"] = json!("saw");
        message["sighting"] =
            json!({"door": {"door": "Дверь-ZY", "status": status, "opening": opening}});
        message.to_string() + "\n" + line
    };
    let mut once = true;
    let seen = peer(world(RB2), None, move |_, line| {
        let first = line.contains("\"going\"") && std::mem::take(&mut once);
        if first { Treat::Say(saw(line, "closed", 0)) } else { Treat::Pass }
    });
    let mut remote = connect(&engine, seen).unwrap();
    let answer = drive(&engine, TASK, &mut remote, &Stop::new(), &mut |_| {});
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    assert_eq!(answer.replans, 1);
    // It bumps into the door wherever it goes, which is open and shut by turns.
    let (mut times, mut drives) = (0, false);
    let restless = peer(world(RB2), None, move |_, line| {
        let drove = std::mem::replace(&mut drives, line.contains("\"going\""));
        let mut message: Value = serde_json::from_str(line).unwrap();
        if drove && message["say"] == "done" {
            message["say"] = json!("bumped");
            message["against"] = json!({"door": "Дверь-ZY"});
        } else if message["say"] == "seen" {
            times += 1;
            let (status, opening) = if times % 2 == 1 { ("closed", 0) } else { ("open", 100) };
            message["sighting"] =
                json!({"door": {"door": "Дверь-ZY", "status": status, "opening": opening}});
        }
        Treat::Say(message.to_string())
    });
    let mut remote = connect(&engine, restless).unwrap();
    let answer = drive(&engine, TASK, &mut remote, &Stop::new(), &mut |_| {});
    assert!(
        matches!(&answer.ending, TaskEnding::Failed(Failure::Restless { times: 21 })),
        "{:?}",
        answer.ending
    );
}

#[test]
fn nobody_at_the_address_is_told() {
    let (_dir, engine) = engine(RB2);
    for address in ["cmd:/no/such/robot", "tcp:127.0.0.1:1"] {
        let address: Address = address.parse().unwrap();
        let failure = address.connect(engine.world().unwrap(), IMPATIENT).unwrap_err();
        assert!(matches!(failure, Failure::NoConnection { .. }), "{failure}");
    }
}

/// The order in which a person meets them in docs/vehicle.md.
#[test]
fn the_guide_tells_of_every_message_and_the_schema_stands_beside_it() {
    let schema = protocol::json_schema() + "\n";
    expect_test::expect_file![project("docs/vehicle.schema.json")].assert_eq(&schema);
    let guide = std::fs::read_to_string(project("docs/vehicle.md")).unwrap();
    let schema: Value = serde_json::from_str(&schema).unwrap();
    let mut words = Vec::new();
    gather(&schema, &mut words);
    assert!(words.len() > 30, "{words:?}");
    for word in words {
        assert!(
            guide.contains(&format!("`{word}`")) || guide.contains(&format!("\"{word}\"")),
            "{word}"
        );
    }
}

/// The words that a schema allows for a message, and the names of its fields.
fn gather(schema: &Value, words: &mut Vec<String>) {
    if let Value::Object(fields) = schema {
        words.extend(fields.get("const").and_then(Value::as_str).map(str::to_owned));
        if let Some(Value::Object(properties)) = fields.get("properties") {
            words.extend(
                properties
                    .keys()
                    .filter(|name| !["order", "message"].contains(&name.as_str()))
                    .cloned(),
            );
        }
        fields.values().for_each(|inner| gather(inner, words));
    }
    if let Value::Array(all) = schema {
        all.iter().for_each(|inner| gather(inner, words));
    }
}

/// Python, unless it is missing; where `CI` is set that is a failure.
#[expect(clippy::print_stdout, reason = "a test that was not made should say so")]
fn has_python() -> bool {
    let found = Command::new("python3").arg("--version").output().is_ok_and(|o| o.status.success());
    assert!(found || std::env::var_os("CI").is_none(), "python3 is missing");
    if !found {
        println!("skipped: there is no python3");
    }
    found
}

#[test]
fn the_python_vehicle_carries_out_the_demo() {
    if !has_python() {
        return;
    }
    let (_dir, engine) = engine(RB2);
    let within = engine.perform(TASK, &mut |_| {}).unwrap();
    let world = engine.world().unwrap();
    let (map, pose) = starting_pose(world).unwrap();
    let at = format!("{},{},{}", pose.at.x, pose.at.y, pose.heading.get());
    let program = project("examples/vehicle.py").display().to_string();
    let words = ["python3", &program, "--map", world.name(Entity::Map(map)), "--at", &at];
    let address = Address::Program(words.map(str::to_owned).to_vec());
    let patience = Patience::default();
    let mut robot = address.connect(world, patience).unwrap();
    assert_eq!(robot.name(), "disc of examples/vehicle.py");
    let answer = drive(&engine, TASK, &mut robot, &Stop::new(), &mut |_| {});
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    let directives = |answer: &TaskAnswer| -> Vec<String> {
        answer.reports.iter().map(|r| r.directive.to_string()).collect()
    };
    assert_eq!(directives(&answer), directives(&within));
    assert!((answer.end.at - within.end.at).norm() < 1.0);
    // It stops when it is told to.
    let (stop, mut events) = (Stop::new(), 0);
    let answer =
        drive(&engine, "Поезжай в Комнату-Y", &mut robot, &stop, &mut |_| {
            events += 1;
            if events == 12 {
                stop.raise();
            }
        });
    assert!(matches!(answer.ending, TaskEnding::Stopped), "{:?}", answer.ending);
}

fn ortho(dir: &TempDir, args: &[&str]) -> Command {
    let mut command = crate::ortho();
    command.current_dir(dir.path()).args(args).stdin(Stdio::null());
    for name in ["ORTHO_STORE", "ORTHO_RULES", "ORTHO_USER"] {
        command.env_remove(name);
    }
    command
}

fn simulate(how: &str) -> String {
    let map = project(RB2);
    format!("'{}' simulate '{}' {how}", env!("CARGO_BIN_EXE_ortho"), map.display())
}

fn ran(mut command: Command, code: i32) -> String {
    let output = command.output().unwrap();
    let (out, err) =
        (String::from_utf8(output.stdout).unwrap(), String::from_utf8(output.stderr).unwrap());
    assert_eq!(output.status.code(), Some(code), "{out}{err}");
    assert!(!err.contains("panicked"), "{err}");
    out + &err
}

#[test]
fn ortho_do_drives_what_ortho_simulate_offers() {
    let dir = tempfile::tempdir().unwrap();
    let map = project(RB2).display().to_string();
    ran(ortho(&dir, &["import", &map]), 0);
    let reset = ["do", TASK, "--reset", "--json"];
    let within = ran(ortho(&dir, &reset), 0);
    let child = format!("cmd:{}", simulate("--stdio"));
    let through = ran(ortho(&dir, &[&reset[..], &["--vehicle", &child]].concat()), 0);
    assert_eq!(within, through);
    // By TCP; the robot stays as it was left from one mission to the next.
    let mut server = ortho(&dir, &["simulate", &map, "--listen", "127.0.0.1:0", "--lang", "en"]);
    let mut server = server.stderr(Stdio::piped()).spawn().unwrap();
    let mut line = String::new();
    BufReader::new(server.stderr.take().unwrap()).read_line(&mut line).unwrap();
    let address = format!("tcp:{}", line.trim().rsplit(' ').next().unwrap());
    let by_tcp = ran(ortho(&dir, &[&reset[..], &["--vehicle", &address]].concat()), 0);
    assert_eq!(within, by_tcp);
    let again = ran(ortho(&dir, &["do", "Поезжай в Комнату-Y", "--vehicle", &address]), 0);
    assert!(again.contains("Сделано"), "{again}");
    server.kill().unwrap();
    server.wait().unwrap();
    let gone = ran(ortho(&dir, &["do", TASK, "--vehicle", &address, "--lang", "en"]), 3);
    assert!(gone.contains("there is no connection to the robot"), "{gone}");
}

/// Ctrl-C is for the mission, not for the robot: it is told to stop, and where it stands is kept.
#[cfg(unix)]
#[test]
fn ctrl_c_stops_the_robot_and_the_next_task_goes_on() {
    let dir = tempfile::tempdir().unwrap();
    ran(ortho(&dir, &["import", &project(RB2).display().to_string()]), 0);
    let child = format!("cmd:{}", simulate("--stdio --pace 1"));
    let mut running = ortho(&dir, &["do", TASK, "--vehicle", &child]);
    let mut running = running.stdout(Stdio::piped()).spawn().unwrap();
    let mut lines = BufReader::new(running.stdout.take().unwrap()).lines();
    // The first directive is done: it drives.
    let told = lines
        .by_ref()
        .map(Result::unwrap)
        .find(|line| line.starts_with("  1.") && line.contains(" – "));
    assert!(told.is_some());
    thread::sleep(Duration::from_millis(300));
    let kill = Command::new("kill").args(["-INT", &running.id().to_string()]).status().unwrap();
    assert!(kill.success());
    let rest: Vec<String> = lines.map(Result::unwrap).collect();
    assert_eq!(running.wait().unwrap().code(), Some(130), "{rest:?}");
    assert!(rest.iter().any(|line| line.starts_with("Остановлено. Я нахожусь")), "{rest:?}");
    let here = ran(ortho(&dir, &["where"]), 0);
    // It also says which way it faces.
    let place =
        |line: &str| line.trim_start_matches("Остановлено. ").trim_end_matches('.').to_owned();
    assert!(rest.iter().any(|line| here.contains(&place(line))), "{here}\n{rest:?}");
    let next = ran(ortho(&dir, &["do", TASK]), 0);
    assert!(next.contains("Сделано"), "{next}");
}

#[test]
fn a_robot_that_dies_is_reported_by_the_command_line() {
    let dir = tempfile::tempdir().unwrap();
    ran(ortho(&dir, &["import", &project(RB2).display().to_string()]), 0);
    let dead = ran(ortho(&dir, &["do", TASK, "--vehicle", "cmd:true"]), 3);
    assert!(dead.contains("связь с роботом прервалась"), "{dead}");
    let silent = ["do", TASK, "--vehicle", "cmd:sleep 60", "--silence", "0.3", "--lang", "en"];
    let silent = ran(ortho(&dir, &silent), 3);
    assert!(silent.contains("did not answer \"hello\" within 0.3 s"), "{silent}");
    let wrong = ran(ortho(&dir, &["do", TASK, "--vehicle", "robot"]), 2);
    assert!(wrong.contains("cmd:COMMAND or tcp:HOST:PORT is wanted"), "{wrong}");
}
