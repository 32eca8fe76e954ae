//! What is told, what is asked and what is done agree: one state of the world for all of them, things that go with what
//! carries them, doors behind which nothing is taken, and no plan begun that the floor is known to refuse.

use std::collections::BTreeSet;
use std::path::Path;
use std::time::SystemTime;

use orthoframe::Engine;
use orthoframe::engine::{
    Memory, Method, Progress, TaskAnswer, TaskEnding, TaskEvents, Timestamp, change_now, json,
};
use orthoframe_language::Language;
use orthoframe_language::question::Said;
use orthoframe_map::{Entity, World};
use orthoframe_semantics::{Profile, RelationRules, Relations, derive};
use orthoframe_units::{Deg, Frame, ReplicaId};

use crate::files::{project, shared};

fn now() -> Timestamp {
    SystemTime::now().into()
}

/// A kitchen and a hall with a closed door between them, and a closet off the hall in which the robot cannot get out of
/// the way of the door's leaf.
const HOME: &str = r#"
format = 1
[domain]
key = "home"
name = "Home"
[robot]
radius = 22
height = 110
clearance = 3
speed = 50
start = "Post"
[type]
object = [
  { name = "table", traits = ["support"] },
  { name = "tray", traits = ["portable", "support"] },
  { name = "mat", traits = ["portable"] },
  { name = "cup", traits = ["portable"] },
  { name = "box", traits = ["portable", "container"] },
  { name = "ball", traits = ["portable"] },
  { name = "cabinet", traits = ["container"] },
  { name = "egg", traits = ["portable"] },
]
[orthoframe]
kitchen = { name = "Kitchen floor", height = 270, points = [[0, 0], [500, 0], [500, 150], [500, 250], [500, 400], [0, 400]], side.C = { permeability = "conditional" } }
hall = { name = "Hall floor", height = 270, points = [[0, 0], [300, 0], [300, 150], [300, 250], [300, 400], [0, 400], [0, 250], [0, 150]], side.C = { permeability = "conditional" }, side.G = { permeability = "conditional" } }
closet = { name = "Closet floor", height = 270, points = [[0, 0], [105, 0], [105, 126], [0, 126], [0, 113], [0, 13]], side.E = { permeability = "conditional" } }
board = { name = "Board", rect = [120, 70], height = 75 }
small-board = { name = "Small board", rect = [40, 40], height = 75 }
tray = { name = "Tray body", rect = [50, 30], height = 2 }
mat = { name = "Mat body", rect = [40, 40], height = 0.5 }
cup = { name = "Cup body", regular = { corners = 12, radius = 4 }, height = 9 }
box = { name = "Box body", rect = [30, 30], height = 20, roof = "permeable" }
ball = { name = "Ball body", regular = { corners = 12, radius = 5 }, height = 10 }
cabinet = { name = "Cabinet body", rect = [60, 50], height = 90 }
[object]
table = { name = "Table", type = "table", items = [{ id = "A", orthoframe = "board" }] }
stand = { name = "Stand", type = "table", items = [{ id = "A", orthoframe = "small-board" }] }
tray = { name = "Tray", type = "tray", items = [{ id = "A", orthoframe = "tray" }] }
mat = { name = "Mat", type = "mat", items = [{ id = "A", orthoframe = "mat" }] }
cup = { name = "Cup", type = "cup", items = [{ id = "A", orthoframe = "cup" }] }
box = { name = "Box", type = "box", items = [{ id = "A", orthoframe = "box" }] }
ball = { name = "Ball", type = "ball", items = [{ id = "A", orthoframe = "ball" }] }
cabinet = { name = "Cabinet", type = "cabinet", items = [{ id = "A", orthoframe = "cabinet" }] }
egg = { name = "Egg", type = "egg", items = [{ id = "A", orthoframe = "ball" }] }
[door.kitchen]
name = "Kitchen door"
kind = "hinged"
width = 100
height = 210
leaves = [{ hinge = "left", share = 1, thickness = 4, max_open = 90 }]
state = "closed"
[door.closet]
name = "Closet door"
kind = "hinged"
width = 100
height = 210
leaves = [{ hinge = "left", share = 1, thickness = 4, max_open = 90 }]
state = "open"
[area.kitchen]
name = "Kitchen"
items = [{ id = "A", orthoframe = "kitchen" }]
doors = [{ side = "C", door = "kitchen", opens = "outside" }]
places = [{ name = "Post", at = [300, 200] }]
replicas = [
  { name = "Kitchen table", object = "table", at = [20, 320] },
  { name = "Tray 1", object = "tray", at = [40, 330, 75], move_prob = 90 },
  { name = "Cup 1", object = "cup", at = [50, 340, 77], move_prob = 90 },
  { name = "Cup 2", object = "cup", at = [75, 345, 77], move_prob = 90 },
  { name = "Box 1", object = "box", at = [105, 345, 75], move_prob = 90 },
  { name = "Ball 1", object = "ball", at = [120, 360, 75], move_prob = 90 },
  { name = "Cabinet 1", object = "cabinet", at = [200, 350], properties = { state = "closed" } },
  { name = "Egg 1", object = "egg", at = [230, 375, 20], move_prob = 90 },
]
[area.hall]
name = "Hall"
items = [{ id = "A", orthoframe = "hall" }]
doors = [{ side = "G", door = "kitchen", opens = "inside" }, { side = "C", door = "closet", opens = "outside" }]
replicas = [
  { name = "Hall table", object = "table", at = [150, 20] },
  { name = "Stand 1", object = "stand", at = [20, 350] },
  { name = "Mat 1", object = "mat", at = [20, 350, 75], move_prob = 90 },
]
[area.closet]
name = "Closet"
items = [{ id = "A", orthoframe = "closet" }]
doors = [{ side = "E", door = "closet", opens = "inside" }]
[map.home]
name = "Home"
items = [{ area = "kitchen" }, { area = "hall", at = [500, 0] }, { area = "closet", at = [800, 137] }]
links = [{ from = "kitchen.C", to = "hall.G" }, { from = "hall.C", to = "closet.E" }]
"#;

/// A map in a store of its own, so that one task goes on from another.
fn stored(dir: &tempfile::TempDir, map: &Path) -> Engine {
    let mut engine = Engine::open(&dir.path().join("store"), None).unwrap();
    engine.import(map, &change_now("test", "survey")).unwrap_or_else(|e| panic!("{e:?}"));
    engine
}

fn home(dir: &tempfile::TempDir, text: &str) -> Engine {
    let file = dir.path().join("home.toml");
    std::fs::write(&file, text).unwrap();
    stored(dir, &file)
}

fn relations(world: &World) -> Relations {
    derive(world, &RelationRules::standard(), Profile::Surveyed).unwrap()
}

/// What went otherwise than believed.
fn explanation(world: &World, progress: &Progress<'_>) -> String {
    let event = TaskEvents::default().of(world, progress).expect("an event");
    event["explanation_en"].as_str().expect("a surprise").to_owned()
}

/// Why a task could not go on.
fn stuck(engine: &Engine, answer: &TaskAnswer) -> String {
    assert!(matches!(answer.ending, TaskEnding::Stuck(_)), "{:?}", answer.ending);
    let view = json::task(engine.world().unwrap(), answer);
    view["explanation_en"].as_str().expect("a surprise").to_owned()
}

/// Carries out an order in a world that is as believed, where nothing may surprise the robot, and remembers it.
fn order(engine: &mut Engine, order: &str) -> Result<TaskAnswer, orthoframe::engine::Error> {
    let world = engine.world_now().unwrap().clone();
    let answer = engine.perform(order, &mut |progress| {
        if let Progress::Surprised { directive, .. } = progress {
            let why = explanation(&world, progress);
            panic!("{order}: {directive} was begun and known to fail: {why}");
        }
    })?;
    engine.remember(&answer, now()).unwrap();
    Ok(answer)
}

fn done(engine: &mut Engine, text: &str) -> TaskAnswer {
    let answer = order(engine, text).unwrap_or_else(|e| panic!("{text}: {e}"));
    assert!(matches!(answer.ending, TaskEnding::Done), "{text}: {:?}", answer.ending);
    answer
}

fn ask(engine: &Engine, question: &str) -> (Said, String) {
    let answer = engine.ask(question, &mut Memory::default()).unwrap();
    let answer = answer.unwrap_or_else(|e| panic!("{question}: {}", e.text));
    (answer.said, answer.text)
}

fn told(engine: &Engine, question: &str) -> String {
    ask(engine, question).1
}

#[test]
fn what_lies_on_the_tray_is_on_the_table() {
    let dir = tempfile::tempdir().unwrap();
    let engine = home(&dir, HOME);
    assert_eq!(
        told(&engine, "What is on the kitchen table?"),
        "Tray 1, Cup 1 (on Tray 1), Cup 2 (on Tray 1), Box 1 and Ball 1 (in Box 1) are on the kitchen table."
    );
    assert!(told(&engine, "Что на Kitchen table?").contains("Cup 1 (на Tray 1)"));
    assert_eq!(told(&engine, "On which table is Cup 1?"), "Cup 1 is on the kitchen table.");
    assert_eq!(told(&engine, "What is Cup 1 on?"), "Cup 1 is on Tray 1.");
}

/// What stands on another thing and is not made to bear is no place to put things, even where there is no other.
#[test]
fn nothing_is_put_onto_what_stands_on_another_thing() {
    let dir = tempfile::tempdir().unwrap();
    let toaster = "{ name = \"Toaster 1\", object = \"toaster\", at = [21, 351, 75] },";
    let text = HOME
        .replace("  { name = \"Hall table\", object = \"table\", at = [150, 20] },\n", "")
        .replace("{ name = \"Mat 1\", object = \"mat\", at = [20, 350, 75], move_prob = 90 },", toaster)
        .replace("{ name = \"egg\",", "{ name = \"toaster\", traits = [\"device\"] },\n  { name = \"egg\",")
        .replace("[object]\n", "toaster = { name = \"Toaster body\", rect = [38, 38], height = 20 }\n[object]\ntoaster = { name = \"Toaster\", type = \"toaster\", items = [{ id = \"A\", orthoframe = \"toaster\" }] }\n");
    let mut engine = home(&dir, &text);
    let refused = order(&mut engine, "Put Cup 1 in the hall").unwrap_err().to_string();
    assert!(refused.contains("некуда положить"), "{refused}");
    done(&mut engine, "Put Cup 1 on Cabinet 1");
}

/// The cups travel with the tray and the ball with the box: in the hand, in the world, in relations and in answers.
#[test]
fn what_lies_on_the_tray_goes_with_it() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = home(&dir, HOME);
    done(&mut engine, "Take Tray 1");
    assert_eq!(told(&engine, "Where is Cup 1?"), "Cup 1 is on Tray 1 in my hands.");
    assert!(told(&engine, "What is on Tray 1?").contains("Cup 2"));
    assert!(!told(&engine, "What is on the kitchen table?").contains("Cup"));
    done(&mut engine, "Put Tray 1 on the hall table");
    let world = engine.uncarried().unwrap().clone();
    let found = relations(&world);
    for (upper, lower) in [("Cup 1", "Tray 1"), ("Cup 2", "Tray 1"), ("Tray 1", "Hall table")] {
        assert!(found.holds("RESTS_ON", &[upper, lower]), "{upper} is not on {lower}");
    }
    assert!(told(&engine, "What is on the hall table?").contains("Cup 1 (on Tray 1)"));
    done(&mut engine, "Take Cup 1");
    done(&mut engine, "Put Cup 1 on the kitchen table");
    done(&mut engine, "Put Box 1 on the hall table");
    let world = engine.uncarried().unwrap().clone();
    let found = relations(&world);
    assert!(
        found.holds("INSIDE", &["Ball 1", "Box 1"]) && found.holds("INSIDE", &["Ball 1", "Hall"])
    );
    // What a person was given comes back as it went.
    done(&mut engine, "Bring Tray 1");
    assert!(told(&engine, "Where is Cup 2?").starts_with("Cup 2 is on Tray 1"));
    done(&mut engine, "Put Tray 1 on the kitchen table");
    let found = relations(engine.uncarried().unwrap());
    assert!(found.holds("RESTS_ON", &["Cup 2", "Tray 1"]));
}

#[test]
fn nothing_is_taken_through_shut_doors() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = home(&dir, HOME);
    let refused = order(&mut engine, "Bring Egg 1").unwrap_err();
    let said = refused.say(Language::English);
    assert_eq!(
        said,
        "Egg 1 is in Cabinet 1, which is shut, and the robot does not open doors of furniture."
    );
    drop(engine);
    let dir = tempfile::tempdir().unwrap();
    let mut open = home(&dir, &HOME.replace(r#"state = "closed" } }"#, r#"state = "open" } }"#));
    done(&mut open, "Bring Egg 1");
}

/// In the closet the leaf has no way past the robot: it goes out and shuts the door from there.
#[test]
fn a_door_is_shut_from_where_it_can_be_opened_again() {
    let dir = tempfile::tempdir().unwrap();
    let closet = HOME.replace(r#"places = [{ name = "Post", at = [300, 200] }]"#, "").replace(
        r#"doors = [{ side = "E", door = "closet", opens = "inside" }]"#,
        r#"doors = [{ side = "E", door = "closet", opens = "inside" }]
places = [{ name = "Post", at = [70, 63] }]"#,
    );
    let mut engine = home(&dir, &closet);
    let answer = done(&mut engine, "Close the closet door");
    let floor = &engine.floors().unwrap()[&answer.end_map];
    let (area, _) = floor.locate(answer.end.at).expect("it stands on the floor");
    assert_eq!(engine.world().unwrap().areas[&area].name, "Hall");
}

/// A cupboard stands before the closet: the rules know of no obstacle, and the floor does.
#[test]
fn a_plan_that_the_floor_refuses_is_not_begun() {
    let dir = tempfile::tempdir().unwrap();
    let text = HOME.replace(
        r#"  { name = "Hall table", object = "table", at = [150, 20] },"#,
        r#"  { name = "Hall table", object = "table", at = [150, 20] },
  { name = "Cabinet 2", object = "cabinet", at = [240, 140] },
  { name = "Cabinet 3", object = "cabinet", at = [240, 195] },"#,
    );
    let mut engine = home(&dir, &text);
    let answer = order(&mut engine, "Go to the closet").unwrap();
    let why = stuck(&engine, &answer);
    assert!(why.contains("the closet door"), "{why}");
    assert_eq!(answer.start, answer.end, "it set out");
    assert!(answer.reports.is_empty());
}

#[test]
fn a_mat_takes_no_room() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = home(&dir, HOME);
    done(&mut engine, "Put Cup 1 on Stand 1");
    let found = relations(engine.uncarried().unwrap());
    assert!(found.holds("RESTS_ON", &["Cup 1", "Mat 1"]));
    assert!(found.holds("BORNE_BY", &["Cup 1", "Stand 1"]));
    // Where something else stands there is none.
    let answer = order(&mut engine, "Put Box 1 on Stand 1").unwrap();
    assert!(matches!(answer.ending, TaskEnding::Stuck(_)), "{:?}", answer.ending);
}

/// What is believed with one percent is neither told nor acted upon as a fact.
#[test]
fn what_is_hardly_believed_is_no_fact() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = home(&dir, HOME);
    assert_eq!(ask(&engine, "Where is Cup 1?").0, Said::Found);
    engine.observe("Cup 1", None, 0.99, "test", now()).unwrap();
    let (said, text) = ask(&engine, "Where is Cup 1?");
    assert_eq!(said, Said::Unknown, "{text}");
    assert!(text.starts_with("I am not sure where Cup 1 (1%) is: "), "{text}");
    assert!(told(&engine, "Где Cup 1?").starts_with("Я не уверен, где Cup 1 (1 %): "));
    assert_eq!(ask(&engine, "Is Cup 1 on the kitchen table?").0, Said::Unknown);
    // Of several, the others are told all the same.
    let (said, text) = ask(&engine, "What is on the kitchen table?");
    assert!(said == Said::Found && text.starts_with("I am not sure where Cup 1 (1%)"), "{text}");
    assert_eq!(ask(&engine, "Where is Cup 2?").0, Said::Found);
    assert_eq!(ask(&engine, "How big is Cup 1?").0, Said::Found, "its size is not in doubt");
    let answer = done(&mut engine, "Bring Cup 1");
    assert_eq!(answer.unsure.len(), 1);
    let actions: Vec<&str> = answer.reports.iter().map(|r| r.directive.action.as_ref()).collect();
    assert!(answer.goal[0].predicate.contains("НАЙДЕН"), "{actions:?}");
    // What it has just had in its hand it is sure of.
    assert_eq!(ask(&engine, "Where is Cup 1?").0, Said::Found);
}

/// A shut door that the robot opens is no "no way", and the way goes on to be told as doors are left.
#[test]
fn ways_are_told_in_the_world_as_it_is() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = home(&dir, HOME);
    let way = engine.journey("Kitchen", "Hall", Method::Shortest).unwrap();
    assert!(way.legs.iter().all(|leg| leg.route.is_ok()));
    let world = engine.world_now().unwrap();
    assert_eq!(
        way.opens_in_words(world, Language::English),
        "On the way the kitchen door must be opened (closed, not locked)."
    );
    let (said, text) = ask(&engine, "Can you get to the hall?");
    assert!(said == Said::Yes && text.contains("the kitchen door must be opened"), "{text}");
    done(&mut engine, "Go to the hall");
    let way = engine.journey("Kitchen", "Hall", Method::Shortest).unwrap();
    assert!(way.opens.is_empty(), "the robot left it open");
    done(&mut engine, "Close the kitchen door");
    let way = engine.journey("Kitchen", "Hall", Method::Shortest).unwrap();
    assert_eq!(way.opens.len(), 1);
    drop(engine);
    let dir = tempfile::tempdir().unwrap();
    let locked = home(&dir, &HOME.replacen(r#"state = "closed""#, r#"state = "locked""#, 1));
    let way = locked.journey("Kitchen", "Hall", Method::Shortest).unwrap();
    assert!(way.opens.is_empty() && way.legs[0].route.is_err());
    assert_eq!(ask(&locked, "Can you get to the hall?").0, Said::No);
}

/// So it is where a lift lies between, whose cabin the way leaves by a door that opens by itself.
#[test]
fn a_shut_door_on_another_storey_is_no_lack_of_a_way() {
    let Some(path) = shared("cases/office-two-storeys.toml") else { return };
    let dir = tempfile::tempdir().unwrap();
    let engine = home(&dir, &std::fs::read_to_string(path).unwrap());
    let world = engine.world_now().unwrap();
    let rooms: Vec<String> = world.areas.values().map(|area| area.name.clone()).collect();
    let mut through = 0;
    for (from, to) in rooms.iter().flat_map(|from| rooms.iter().map(move |to| (from, to))) {
        let is_locked = |room: &str| room == "Storeroom";
        let way = engine.journey(from, to, Method::Shortest).unwrap();
        let is_way = way.legs.iter().all(|leg| leg.route.is_ok());
        let wanted = from == to || !is_locked(from) && !is_locked(to);
        assert_eq!(is_way, wanted, "{from} – {to}");
        through += usize::from(!way.rides.is_empty() && !way.opens.is_empty());
    }
    assert!(through > 3, "{through}");
    let (said, text) = ask(&engine, "How do I get from the lobby to Office A?");
    assert!(said == Said::Found && text.contains("Office A door must be opened"), "{text}");
}

/// A sequence of numbers that repeats itself.
struct Dice(u64);

impl Dice {
    fn below(&mut self, n: usize) -> usize {
        self.0 =
            self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 33) as usize % n.max(1)
    }

    fn one<'a>(&mut self, of: &'a [String]) -> &'a str {
        &of[self.below(of.len())]
    }
}

fn english(name: &str, name_en: &str) -> String {
    if name_en.is_empty() { name.to_owned() } else { name_en.to_owned() }
}

/// Where a thing lies in the frame of another, on the Map.
fn within(world: &World, thing: ReplicaId, other: ReplicaId) -> Option<Frame> {
    let placed = |id: ReplicaId| {
        let replica = world.replicas.get(&id)?;
        let (_, home) = world.placement(replica.area)?;
        Some(home.compose(&replica.frame))
    };
    let (own, frame) = (placed(thing)?, placed(other)?);
    let at = frame.invert(own.origin());
    Some(Frame::new(at.x, at.y, own.z.get() - frame.z.get(), own.angle - frame.angle))
}

fn is_near(a: &Frame, b: &Frame) -> bool {
    let turned = (a.angle - b.angle).signed().abs();
    (a.origin() - b.origin()).norm() < 1e-3 && (a.z.get() - b.z.get()).abs() < 1e-3 && turned < 1e-3
}

/// After any orders: what is told of ways is what is driven, contents rest where their container is, nothing is taken out
/// of what is shut, and no plan that was begun fails for what was known ([`order`] sees to that).
fn check_orders(map: &Path, seed: u64, rounds: usize) {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = stored(&dir, map);
    let world = engine.world().unwrap().clone();
    let rooms: Vec<String> = world.areas.values().map(|a| english(&a.name, &a.name_en)).collect();
    let doors: Vec<String> = world
        .doors
        .values()
        .filter(|d| !d.leaves.is_empty())
        .map(|d| english(&d.name, &d.name_en))
        .collect();
    let of_trait = |wanted: &str| -> Vec<String> {
        let all = world.replicas.values().filter(|r| world.has_trait(r.id, wanted));
        all.map(|r| english(&r.name, &r.name_en)).collect()
    };
    let (things, supports) = (of_trait("portable"), of_trait("support"));
    let mut dice = Dice(seed);
    for _ in 0..rounds {
        let text = match dice.below(6) {
            0 if !doors.is_empty() => format!("Open {}", dice.one(&doors)),
            1 if !doors.is_empty() => format!("Close {}", dice.one(&doors)),
            2 | 3 if !things.is_empty() && !supports.is_empty() => {
                format!("Put {} on {}", dice.one(&things), dice.one(&supports))
            }
            4 if !things.is_empty() => format!("Take {}", dice.one(&things)),
            _ => format!("Go to {}", dice.one(&rooms)),
        };
        let before = engine.uncarried().unwrap().clone();
        let known = relations(&before);
        let shut: BTreeSet<ReplicaId> = known.all_shut_in();
        // Refused, or not understood for a name that several things bear.
        let Ok(answer) = order(&mut engine, &text) else { continue };
        let after = engine.uncarried().unwrap();
        let gone = before.replicas.keys().filter(|id| !after.replicas.contains_key(id));
        assert!(gone.into_iter().all(|id| !shut.contains(id)), "{text}: out of what is shut");
        for &carrier in before.replicas.keys() {
            for &content in &known.goes_with(carrier) {
                let was = within(&before, content, carrier);
                let is = within(after, content, carrier);
                let taken =
                    answer.goal.iter().any(|g| g.args.contains(&before.replicas[&content].name));
                if let (Some(was), Some(is), false) = (was, is, taken) {
                    assert!(is_near(&was, &is), "{text}: {was:?} {is:?}");
                }
            }
        }
        // Asked, measured and driven: the same.
        let room = dice.one(&rooms).to_owned();
        let (_, here) = engine.robot().unwrap();
        let from = format!("{},{}", here.at.x, here.at.y);
        let question = format!("Can you get to {room}?");
        let asked = engine.ask(&question, &mut Memory::default()).unwrap();
        // A name that several rooms bear.
        let Ok(answer) = asked else { continue };
        let (said, words) = (answer.said, answer.text);
        let one_map = world.maps.len() == 1;
        if let (true, Ok(way)) = (one_map, engine.journey(&from, &room, Method::Shortest)) {
            let leads = way.legs.iter().all(|leg| leg.route.is_ok());
            assert_eq!(leads, said == Said::Yes, "after {text}, {room}: {words}");
        }
        if said == Said::Yes {
            let go = format!("Go to {room}");
            let answer = order(&mut engine, &go).unwrap_or_else(|e| panic!("{go}: {e}"));
            let came = matches!(answer.ending, TaskEnding::Done | TaskEnding::AlreadyTrue);
            assert!(came, "after {text}, {go}: {words} {:?}", answer.ending);
        }
    }
}

#[test]
fn after_any_orders_all_that_is_told_agrees_in_the_flat() {
    check_orders(&project("maps/rb2.toml"), 7, 6);
}

#[test]
fn after_any_orders_all_that_is_told_agrees_at_home() {
    let dir = tempfile::tempdir().unwrap();
    let file = dir.path().join("home.toml");
    std::fs::write(&file, HOME).unwrap();
    for seed in 0..3 {
        check_orders(&file, seed, 8);
    }
}

#[test]
fn after_any_orders_all_that_is_told_agrees_in_other_buildings() {
    /// How many orders in each; more by the environment.
    const ROUNDS: usize = 1;
    let rounds = std::env::var("ORTHO_ORDERS").ok().and_then(|n| n.parse().ok()).unwrap_or(ROUNDS);
    for map in ["cases/office-two-storeys.toml", "procthor/house_6.json"] {
        if let Some(file) = shared(map) {
            check_orders(&file, 11, rounds);
        }
    }
    if let Some(scene) = shared("virtualhome/TestScene1_graph.json").filter(|_| rounds > ROUNDS) {
        check_orders(&scene, 5, rounds);
    }
}

/// What was missed by a careless look is doubted by as much, and what nobody missed is not.
#[test]
fn doubt_is_told_as_large_as_it_is() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = home(&dir, HOME);
    engine.observe("Cup 2", None, 0.6, "test", now()).unwrap();
    let (said, text) = ask(&engine, "Where is Cup 2?");
    assert!(said == Said::Unknown && text.contains("40%"), "{text}");
    assert_eq!(ask(&engine, "Where is the kitchen table?").0, Said::Found);
}

/// Milk in a shut fridge: fetched by a robot that opens furniture, and the fridge is shut again; else refused at once.
#[test]
fn what_is_in_shut_furniture_is_fetched_by_who_opens_it() {
    let mut world = World::load(project("maps/rb2.toml")).unwrap();
    let find = |world: &World, name: &str| {
        let found = world.find(name).into_iter();
        found
            .filter_map(|e| if let Entity::Replica(id) = e { Some(id) } else { None })
            .next()
            .unwrap()
    };
    let (wardrobe, medicine) = (find(&world, "Шкаф-1"), find(&world, "Лекарство"));
    let around = world.replicas[&wardrobe].clone();
    let inside = around.frame.compose(&Frame::new(50.0, 25.0, 8.0, Deg::ZERO));
    let thing = world.replicas.get_mut(&medicine).unwrap();
    (thing.area, thing.frame) = (around.area, inside);
    let object = world.objects[&around.object].clone();
    orthoframe_map::set_open(world.replicas.get_mut(&wardrobe).unwrap(), &object, false);
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let refused = engine.perform("Принеси лекарство", &mut |_| {}).unwrap_err();
    assert!(refused.to_string().contains("дверцы мебели робот не открывает"), "{refused}");
    world.robot.opens = true;
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let mut truth = world.clone();
    let commands = engine.understand("Принеси лекарство").unwrap();
    let answer = engine.carry_out_in(&commands, &mut truth, &mut |_| {}).unwrap();
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    let actions: Vec<&str> = answer.reports.iter().map(|r| &*r.directive.action).collect();
    for action in ["Открыть-объект", "Достать", "Закрыть-объект"] {
        assert!(actions.contains(&action), "{actions:?}");
    }
    let shut = orthoframe_map::stands(&truth, &truth.replicas[&wardrobe]);
    assert_eq!(shut, Some(orthoframe_map::DoorStatus::Closed));
}

/// A tray is for things to be put on, wherever it stands itself.
#[test]
fn what_lies_on_the_tray_is_on_it_for_a_plan_too() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = home(&dir, HOME);
    let answer = order(&mut engine, "Put Cup 1 on Tray 1").unwrap();
    assert!(matches!(answer.ending, TaskEnding::AlreadyTrue), "{:?}", answer.ending);
    let room = HOME.replace("at = [75, 345, 77]", "at = [95, 330, 75]");
    let dir = tempfile::tempdir().unwrap();
    let mut engine = home(&dir, &room);
    done(&mut engine, "Put Cup 2 on Tray 1");
    assert_eq!(told(&engine, "What is Cup 2 on?"), "Cup 2 is on Tray 1.");
    done(&mut engine, "Put Cup 1 on the hall table");
    assert_eq!(told(&engine, "What is Cup 1 on?"), "Cup 1 is on the hall table.");
}

/// Rooms in a row, each behind the door of the one before.
pub(crate) fn row_of_rooms(count: usize) -> String {
    const POINTS: &str =
        "[[0, 0], [400, 0], [400, 100], [400, 200], [400, 300], [0, 300], [0, 200], [0, 100]]";
    const LEAF: &str = "{ hinge = \"left\", share = 1, thickness = 4, max_open = 90 }";
    let mut floors = String::from("[orthoframe]\n");
    let (mut doors, mut rooms) = (String::new(), String::new());
    let (mut items, mut links) = (Vec::new(), Vec::new());
    for n in 0..count {
        let (mut sides, mut hung) = (Vec::new(), Vec::new());
        if n + 1 < count {
            sides.push("side.C = { permeability = \"conditional\" }".to_owned());
            hung.push(format!("{{ side = \"C\", door = \"d{n}\", opens = \"outside\" }}"));
            links.push(format!("{{ from = \"r{n}.C\", to = \"r{}.G\" }}", n + 1));
            doors += &format!("[door.d{n}]\nname = \"Door {n}\"\nkind = \"hinged\"\nwidth = 100\n");
            doors += &format!("height = 210\nleaves = [{LEAF}]\nstate = \"open\"\n");
        }
        if let Some(before) = n.checked_sub(1) {
            sides.push("side.G = { permeability = \"conditional\" }".to_owned());
            hung.push(format!("{{ side = \"G\", door = \"d{before}\", opens = \"inside\" }}"));
        }
        let (sides, hung) = (sides.join(", "), hung.join(", "));
        floors += &format!("f{n} = {{ name = \"Floor {n}\", height = 270, points = {POINTS}, ");
        floors += &format!("{sides} }}\n");
        rooms += &format!("[area.r{n}]\nname = \"Room {n}\"\ndoors = [{hung}]\n");
        rooms += &format!("items = [{{ id = \"A\", orthoframe = \"f{n}\" }}]\n");
        rooms += if n == 0 { "places = [{ name = \"Post\", at = [100, 150] }]\n" } else { "" };
        items.push(format!("{{ area = \"r{n}\", at = [{}, 0] }}", n * 400));
    }
    let (items, links) = (items.join(", "), links.join(", "));
    let head = "format = 1\n[domain]\nkey = \"row\"\nname = \"Row\"\n[robot]\nradius = 20\n\
                height = 110\nclearance = 3\nspeed = 50\nstart = \"Post\"\n";
    let map = format!("[map.row]\nname = \"Row map\"\nitems = [{items}]\nlinks = [{links}]\n");
    [head, &floors, &doors, &rooms, &map].concat()
}

/// The last doors are behind the first ones, which must be opened again on the way.
#[test]
fn of_many_doors_that_are_closed_none_is_left_open() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = home(&dir, &row_of_rooms(6));
    let answer = done(&mut engine, "Close all doors");
    assert_eq!(answer.goal.len(), 10, "each door is told of once, from both sides");
    let world = engine.world_now().unwrap();
    for door in world.doors.values() {
        assert_eq!(door.state, orthoframe_map::DoorState::CLOSED, "{}", door.name);
    }
}

/// Carries out an order in a truth; what surprised the robot, and what it did.
fn in_truth(engine: &mut Engine, text: &str, truth: &mut World) -> (TaskAnswer, Vec<String>) {
    let world = engine.world_now().unwrap().clone();
    let commands = engine.understand(text).unwrap();
    let mut told = Vec::new();
    let answer = engine.carry_out_in(&commands, truth, &mut |progress| {
        if let Progress::Surprised { .. } = progress {
            told.push(explanation(&world, progress));
        }
    });
    let answer = answer.unwrap_or_else(|e| panic!("{text}: {e}"));
    engine.remember(&answer, now()).unwrap();
    (answer, told)
}

/// Nobody tells the robot where a thing is that it does not see: it looks for it, and remembers what it found out.
#[test]
fn what_is_not_in_its_place_is_sought_and_what_is_nowhere_is_remembered_to_be_gone() {
    for is_gone in [false, true] {
        let dir = tempfile::tempdir().unwrap();
        let mut engine = home(&dir, HOME);
        let mut truth = engine.world().unwrap().clone();
        let ball = truth.find("Ball 1")[0];
        let Entity::Replica(ball) = ball else { panic!("{ball:?}") };
        let table = truth.replicas.values().find(|r| r.name == "Hall table").unwrap().clone();
        if is_gone {
            truth.replicas.remove(&ball);
        } else {
            let moved = truth.replicas.get_mut(&ball).unwrap();
            moved.area = table.area;
            moved.frame = Frame::new(210.0, 40.0, 75.0, Deg::ZERO);
        }
        let (answer, told) = in_truth(&mut engine, "Bring Ball 1", &mut truth);
        assert_eq!(
            told.first().map(String::as_str),
            Some("Ball 1 is not in its place"),
            "{told:?}"
        );
        if is_gone {
            let why = stuck(&engine, &answer);
            assert_eq!(why, "Ball 1 is not in its place");
            let (said, text) = ask(&engine, "Where is Ball 1?");
            assert_eq!(said, Said::Unknown, "{text}");
        } else {
            assert!(matches!(answer.ending, TaskEnding::Done), "{:?} {told:?}", answer.ending);
            let looked =
                |r: &orthoframe::engine::Report| r.directive.brings_about("ПРЕДМЕТ-НАЙДЕН");
            assert!(answer.reports.iter().any(looked), "it went to where it had not looked");
        }
    }
}
