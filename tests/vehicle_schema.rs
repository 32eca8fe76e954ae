//! What a mission and a vehicle write to each other, held against docs/vehicle.schema.json by a validator of another make: what
//! was said in sessions is allowed, and of what is spoilt the schema refuses what our reader refuses, and nothing else.

use std::collections::BTreeSet;
use std::fs;
use std::io::{BufRead, BufReader, PipeReader, PipeWriter, Read, Write, pipe};
use std::process::{Command, Stdio};
use std::sync::{Arc, Mutex};
use std::thread;

use orthoframe::engine::TaskEnding;
use orthoframe_map::{DoorState, Entity};
use orthoframe_robot::protocol::{
    Message, No, Order, Place, Saying, Scan, Sight, Stand, Status, Thing, Wish,
};
use orthoframe_robot::{Patience, RemoteVehicle, protocol, starting_pose};
use orthoframe_units::Stop;
use serde_json::{Value, json};

use crate::files::project;
use crate::judged::judged;
use crate::vehicle::{HOUSE, RB2, TASK, Treat, drive, engine, peer, world};

/// Who wrote a line.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
enum Side {
    Mission,
    Vehicle,
}

/// What was said, in the order of each side.
type Tape = Arc<Mutex<Vec<(Side, String)>>>;

/// Copies lines, and keeps them.
fn copy(
    tape: &Tape,
    side: Side,
    from: impl Read + Send + 'static,
    mut to: impl Write + Send + 'static,
) {
    let tape = Arc::clone(tape);
    thread::spawn(move || {
        for line in BufReader::new(from).lines() {
            let Ok(line) = line else { return };
            tape.lock().unwrap().push((side, line.clone()));
            if to.write_all((line + "\n").as_bytes()).and_then(|()| to.flush()).is_err() {
                return;
            }
        }
    });
}

/// Both ends of a vehicle, with all that is said over them kept.
fn tapped(
    tape: &Tape,
    said: impl Read + Send + 'static,
    orders: impl Write + Send + 'static,
) -> (PipeReader, PipeWriter) {
    let (heard, to_mission) = pipe().unwrap();
    let (from_mission, order) = pipe().unwrap();
    copy(tape, Side::Vehicle, said, to_mission);
    copy(tape, Side::Mission, from_mission, orders);
    (heard, order)
}

/// A mission that a vehicle behind pipes drives.
fn mission(map: &str, task: &str, (from, to): (PipeReader, PipeWriter)) {
    let (_dir, engine) = engine(map);
    let mut remote =
        RemoteVehicle::over(from, to, engine.world().unwrap(), Patience::default()).unwrap();
    let answer = drive(&engine, task, &mut remote, &Stop::new(), &mut |_| {});
    assert!(!matches!(answer.ending, TaskEnding::Failed(_)), "{task}: {:?}", answer.ending);
}

/// A mission that a program drives.
fn mission_of(tape: &Tape, program: &str, arguments: &[&str]) {
    let mut command = Command::new(program);
    command.args(arguments).stdin(Stdio::piped()).stdout(Stdio::piped()).stderr(Stdio::null());
    let mut child = command.spawn().unwrap();
    let (said, orders) = (child.stdout.take().unwrap(), child.stdin.take().unwrap());
    mission(RB2, TASK, tapped(tape, said, orders));
    child.wait().unwrap();
}

/// What was said in sessions with the simulator within the process, with the program, by senses alone, and with the example
/// in Python.
fn sessions() -> Vec<(Side, String)> {
    let tape = Tape::default();
    for (map, task) in [
        (RB2, TASK),
        (RB2, "Закрой Дверь-ВZ"),
        (RB2, "Включи торшер"),
        (RB2, "Найди красную чашку"),
        (HOUSE, "Bring the book"),
    ] {
        let (said, orders) = peer(world(map), None, |_, _| Treat::Pass);
        mission(map, task, tapped(&tape, said, orders));
    }
    // A door is locked that is believed open.
    let mut truth = world(RB2);
    let door = truth.doors.values_mut().find(|door| door.name == "Дверь-ВZ").unwrap();
    door.state = DoorState::LOCKED;
    let (said, orders) = peer(truth, None, |_, _| Treat::Pass);
    mission(RB2, TASK, tapped(&tape, said, orders));

    let (ortho, map) = (env!("CARGO_BIN_EXE_ortho"), project(RB2).display().to_string());
    mission_of(&tape, ortho, &["simulate", &map, "--stdio"]);
    mission_of(&tape, ortho, &["simulate", &map, "--stdio", "--senses", "7"]);
    let world = world(RB2);
    let (on, pose) = starting_pose(&world).unwrap();
    let at = format!("{},{},{}", pose.at.x, pose.at.y, pose.heading.get());
    let example = project("examples/vehicle.py").display().to_string();
    mission_of(&tape, "python3", &[&example, "--map", world.name(Entity::Map(on)), "--at", &at]);
    tape.lock().unwrap().clone()
}

/// Every order and every message, as they are written here.
fn of_every_kind() -> Vec<(Side, String)> {
    let name = || "Стол-1".to_owned();
    let stand = || Stand { map: name(), x: 1.0, y: 2.5, heading: 90.0 };
    let place = || Place { area: name(), x: 1.0, y: 2.5, z: 0.0, angle: 90.0 };
    let (door, lift, thing) = (name, name, name);
    let door_seen = Sight::Door { door: door(), status: Status::Open, opening: 50.0 };
    let wishes = [
        Wish::Hello { protocol: protocol::VERSION, domain: name() },
        Wish::Follow { path: vec![[0.0, 1.5], [2.0, 3.0]], heading: Some(90.0), speed: Some(20.0) },
        Wish::SetDoor { door: door(), status: Status::Locked, opening: 0.0 },
        Wish::CallLift { door: Some(door()) },
        Wish::Ride {
            lift: lift(),
            from: name(),
            to: name(),
            rise: -300.0,
            door: Some(door()),
            arrival: stand(),
        },
        Wish::SetOpen { thing: thing(), open: true },
        Wish::Push { thing: thing(), place: place() },
        Wish::Take { thing: thing() },
        Wish::Put { thing: thing(), place: place() },
        Wish::HandOver { thing: thing() },
        Wish::TakeBack { thing: thing() },
        Wish::Switch { device: name(), on: true },
        Wish::Call { person: name() },
        Wish::LookRound,
        Wish::Sees { thing: thing() },
        Wish::LookAt { what: Thing::Wall(name()) },
        Wish::LookAt { what: Thing::Unknown },
        Wish::Report,
        Wish::Cancel { order: 1 },
    ];
    let refusals = [
        No::Locked { door: door() },
        No::Jammed { door: door(), by: Some(Thing::Thing(thing())), opening: 40 },
        No::OutOfReach { thing: thing() },
        No::NotThere { thing: thing() },
        No::HandFull { thing: thing() },
        No::NotHeld { thing: thing() },
        No::NoRoom { thing: thing() },
        No::Shut { thing: thing() },
        No::Stays { thing: thing() },
    ];
    let sayings = [
        Saying::Ready { protocol: protocol::VERSION, name: name(), odometry: true },
        Saying::Going,
        Saying::Saw { sighting: Sight::Thing { thing: thing(), place: place() } },
        Saying::Scan(Scan { height: 20.0, from: -90.0, step: 1.5, ranges: vec![Some(10.5), None] }),
        Saying::Done,
        Saying::Bumped { against: Thing::Door(door()) },
        Saying::Stopped,
        Saying::Seen { sighting: Some(door_seen) },
        Saying::Failed { text: name() },
    ];
    let orders = wishes
        .into_iter()
        .map(|what| (Side::Mission, serde_json::to_string(&Order { id: 7, what }).unwrap()));
    let refused = refusals.into_iter().map(|why| Saying::Refused { why });
    let messages = sayings.into_iter().chain(refused).map(|what| {
        let message = Message { id: 7, time: 1.5, at: stand(), what };
        (Side::Vehicle, serde_json::to_string(&message).unwrap())
    });
    orders.chain(messages).collect()
}

/// Of what kind a line is: its `do` or its `say`.
fn kind(line: &Value) -> String {
    line["do"].as_str().or(line["say"].as_str()).unwrap().to_owned()
}

/// The places of a value: itself, and all that it holds.
fn places(value: &Value, at: &str, into: &mut Vec<String>) {
    into.push(at.to_owned());
    match value {
        Value::Object(fields) => {
            fields.iter().for_each(|(name, inner)| places(inner, &format!("{at}/{name}"), into));
        }
        Value::Array(all) => {
            all.iter().enumerate().for_each(|(n, inner)| places(inner, &format!("{at}/{n}"), into));
        }
        _ => {}
    }
}

/// A line spoilt at every place: left out, of another kind, a word that there is none, a number out of its range; and with a
/// field that nobody knows, which is passed over where fields may be added.
fn spoilt(line: &Value) -> Vec<Value> {
    let others = [
        json!(null),
        json!(true),
        json!(-1),
        json!(0.5),
        json!(1_u64 << 40),
        json!("dance"),
        json!([]),
        json!({}),
        json!({ "dance": 1 }),
    ];
    let mut all = Vec::new();
    let mut at = Vec::new();
    places(line, "", &mut at);
    for place in at {
        for other in &others {
            let mut changed = line.clone();
            *changed.pointer_mut(&place).unwrap() = other.clone();
            all.push(changed);
        }
        let mut changed = line.clone();
        if let Some(Value::Object(fields)) = changed.pointer_mut(&place) {
            fields.insert("nobody_knows".to_owned(), json!(1));
            all.push(changed);
        }
        let Some((parent, name)) = place.rsplit_once('/') else { continue };
        let mut changed = line.clone();
        match changed.pointer_mut(parent) {
            Some(Value::Object(fields)) => drop(fields.remove(name)),
            Some(Value::Array(all)) => drop(all.remove(name.parse().unwrap())),
            _ => continue,
        }
        all.push(changed);
    }
    all
}

fn is_read(side: Side, line: &str) -> bool {
    match side {
        Side::Mission => serde_json::from_str::<Order>(line).is_ok(),
        Side::Vehicle => serde_json::from_str::<Message>(line).is_ok(),
    }
}

#[test]
fn the_schema_allows_what_is_read_and_nothing_else() {
    let schema: Value = serde_json::from_str(&protocol::json_schema()).unwrap();
    let (said, made) = (sessions(), of_every_kind());
    let kinds = |of: &str, word: &str| -> BTreeSet<String> {
        let all = schema["$defs"][of]["oneOf"].as_array().unwrap().iter();
        all.map(|one| one["properties"][word]["const"].as_str().unwrap().to_owned()).collect()
    };
    let here = |side: Side| -> BTreeSet<String> {
        let lines = made.iter().filter(|(of, _)| *of == side);
        lines.map(|(_, line)| kind(&serde_json::from_str(line).unwrap())).collect()
    };
    assert_eq!(here(Side::Mission), kinds("Order", "do"));
    assert_eq!(here(Side::Vehicle), kinds("Message", "say"));

    let mut lines = Vec::new();
    let mut tell = |side: Side, line: &str, is_whole: bool| {
        let of = if side == Side::Mission { "Order" } else { "Message" };
        let is_read = is_read(side, line);
        assert!(is_read || !is_whole, "not read: {line}");
        let line: Value = serde_json::from_str(line).unwrap();
        let told = json!({ "of": of, "line": line, "is_read": is_read, "is_whole": is_whole });
        lines.push(told.to_string());
    };
    // Of each kind of what was said the first is spoilt, and all that is made.
    let mut seen = BTreeSet::new();
    for (is_made, (side, line)) in
        said.iter().map(|one| (false, one)).chain(made.iter().map(|one| (true, one)))
    {
        tell(*side, line, true);
        let mut value: Value = serde_json::from_str(line).unwrap();
        if let Some(ranges) = value["ranges"].as_array_mut() {
            ranges.truncate(2);
        }
        if seen.insert((*side, kind(&value))) || is_made {
            spoilt(&value).iter().for_each(|one| tell(*side, &one.to_string(), false));
        }
    }
    let sides: BTreeSet<Side> = said.iter().map(|(side, _)| *side).collect();
    assert!(sides.len() == 2 && said.len() > 500 && seen.len() > 15, "{} {seen:?}", said.len());

    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("lines.jsonl");
    fs::write(&file, lines.join("\n")).unwrap();
    judged("python3", &["src/robot/judges/protocol.py".to_owned(), file.display().to_string()]);
}
