//! What is told of rooms, ways and people is what the map has and what the robot drives.

use std::collections::BTreeSet;

use orthoframe::engine::{Change, Dialogue, Engine, Format, Method, Mode, Timestamp};
use orthoframe_language::Language;
use orthoframe_language::question::{Answer, Memory, Said};
use orthoframe_map::{Edits, Entity};
use orthoframe_units::Source;

use crate::files::{project, shared};

fn change() -> Change {
    Change::new("Мастер", Timestamp(1_790_000_000_000), "")
}

/// A map file, changed, in a store of its own.
fn engine(file: &std::path::Path, with: impl Fn(String) -> String) -> (tempfile::TempDir, Engine) {
    let dir = tempfile::tempdir().unwrap();
    let path = dir.path().join("map.toml");
    std::fs::write(&path, with(std::fs::read_to_string(file).unwrap())).unwrap();
    let mut engine = Engine::open(&dir.path().join("store"), None).expect("a new store");
    engine.import(&path, &change()).expect("the map is sound");
    (dir, engine)
}

fn map(name: &str, with: impl Fn(String) -> String) -> (tempfile::TempDir, Engine) {
    engine(&project(&format!("maps/{name}.toml")), with)
}

fn lay(engine: &mut Engine, edits: &str) {
    let edits = Edits::read(&Source::new("edits.toml", edits), Format::Toml);
    engine.edit(&edits, &change(), Mode::Commit).expect("good edits");
}

fn ask(engine: &Engine, question: &str) -> Answer {
    let answer = engine.ask(question, &mut Memory::default()).expect("there is a map");
    answer.unwrap_or_else(|doubt| panic!("{question}: {doubt:?}"))
}

fn names(engine: &Engine, question: &str) -> BTreeSet<String> {
    ask(engine, question).symbols.into_iter().collect()
}

/// What is said while an order is carried out, and in the end.
fn drive(engine: &mut Engine, order: &str) -> String {
    let mut told = Vec::new();
    let mut dialogue = Dialogue::default();
    let heard = dialogue.hear(engine, order, &mut |_, event| told.extend(event.in_words()));
    match heard {
        Ok(replies) => told.push(replies.text()),
        Err(error) => told.push(error.to_string()),
    }
    told.join("\n")
}

/// Which rooms a way leads through was told by the fewest doors, and driven was another.
#[test]
fn a_way_that_is_told_by_its_rooms_is_the_way_that_is_driven() {
    let (_dir, mut engine) = map("rb2", |text| text);
    for zone in ["", "room-z", "corridor"] {
        if !zone.is_empty() {
            let laid = "[[edit]]\nremove = \"Зона\"\n";
            if engine.world().unwrap().find("Зона").len() == 1 {
                lay(&mut engine, laid);
            }
            let rooms = format!("rooms = [\"{zone}\"]");
            lay(&mut engine, &format!("[zone.z]\nname = \"Зона\"\nkind = \"keep-out\"\n{rooms}\n"));
        }
        let driven = engine.journey("Комната-В", "Комната-Y", Method::Shortest).unwrap();
        let driven = &driven.legs[0];
        let passed = driven.stages.len() - 2;
        let between = driven.stages[1].area;
        let world = engine.world().unwrap();
        let room = world.name(Entity::Area(between)).to_owned();
        let told = ask(&engine, "Сколько комнат на пути из Комнаты-В в Комнату-Y?");
        assert_eq!(told.number, Some(passed as f64), "{zone}: {}", told.text);
        assert_eq!(told.symbols, [room], "{zone}: {}", told.text);
    }
}

/// A thing called as the end of a short form is called ("m", "s") is not meant where that form is said.
#[test]
fn no_name_begins_behind_an_apostrophe() {
    let (_dir, mut engine) = map("rb2", |text| text);
    let asked = [
        "What's in Room Z?",
        "I'm in Room Z. What's here?",
        "Where's the medicine?",
        "Isn't Door VZ closed?",
        "I’m at Table 1. How far is it to Room V?",
    ];
    let told = |engine: &Engine| asked.map(|line| ask(engine, line).text);
    let mut before = None;
    for name in ["zone", "m", "s", "t"] {
        if before.is_some() {
            lay(&mut engine, "[[edit]]\nremove = \"Зона\"\n");
        }
        lay(
            &mut engine,
            &format!(
                "[zone.z]\nname = \"Зона\"\nname_en = \"{name}\"\nkind = \"slow\"\nspeed = 0.3\nrooms = [\"room-y\"]\n"
            ),
        );
        assert_eq!(told(&engine), *before.get_or_insert_with(|| told(&engine)), "{name}");
    }
}

/// Rooms that were told are rooms behind "of them", too: "which of them has none?" is answered as "which rooms have none?".
#[test]
fn of_rooms_that_were_told_those_without_something_are_the_rooms_without_it() {
    const KINDS: [(&str, &str); 6] = [
        ("windows", "окон"),
        ("beds", "кроватей"),
        ("tables", "столов"),
        ("pictures", "картин"),
        ("chairs", "стульев"),
        ("sinks", "раковин"),
    ];
    let mut compared = 0;
    for name in ["procthor/house_3.json", "procthor/house_7.json", "procthor/house_8.json"] {
        let Some((_dir, engine)) = house(name) else { return };
        for (english, russian) in KINDS {
            let pairs = [
                (
                    "Which rooms are there?",
                    format!("Which of them has no {english}?"),
                    format!("Which rooms have no {english}?"),
                ),
                (
                    "Какие комнаты есть?",
                    format!("В какой из них нет {russian}?"),
                    format!("В какой из комнат нет {russian}?"),
                ),
                (
                    "Какие комнаты есть?",
                    format!("А в каких из них нет {russian}?"),
                    format!("В каких комнатах нет {russian}?"),
                ),
            ];
            for (first, of_them, of_rooms) in pairs {
                let mut memory = Memory::default();
                engine.ask(first, &mut memory).unwrap().expect("there are rooms");
                let Ok(told) = engine.ask(&of_them, &mut memory).unwrap() else { continue };
                let Ok(asked) = engine.ask(&of_rooms, &mut Memory::default()).unwrap() else {
                    continue;
                };
                assert_eq!(told.symbols, asked.symbols, "{name}: {of_them}: {}", told.text);
                compared += 1;
            }
        }
    }
    assert!(compared > 20, "{compared}");
}

/// How far it is without entering a room: as far as without a word of it where the way does not lead there, else farther or
/// not at all.
#[test]
fn a_way_round_a_room_is_no_shorter_than_the_way() {
    let (_dir, engine) = map("rb2", |text| text);
    let rooms = ["Комнаты-В", "Комнаты-Y", "Комнаты-Z", "Коридора"];
    let names = ["Комнату-В", "Комнату-Y", "Комнату-Z", "Коридор"];
    let (mut round, mut as_far) = (0, 0);
    for (from, to) in (0..4).flat_map(|a| (0..4).map(move |b| (a, b))).filter(|(a, b)| a != b) {
        let plain = ask(&engine, &format!("Сколько метров от {} до {}?", rooms[from], rooms[to]));
        let plain = plain.number.expect("there is a way");
        let way = ask(&engine, &format!("Как дойти от {} до {}?", rooms[from], rooms[to])).text;
        for avoided in (0..4).filter(|n| *n != from && *n != to) {
            let ends = format!("от {} до {}", rooms[from], rooms[to]);
            let told = ask(&engine, &format!("Сколько метров {ends}, минуя {}?", names[avoided]));
            let Some(length) = told.number else {
                assert_eq!(told.said, Said::No, "{}", told.text);
                continue;
            };
            // A way that must be opened is taken only where none is open.
            let opens = told.text.contains("закрыта");
            assert!(opens || length > plain - 1.0, "{}: {plain}", told.text);
            match (length - plain).abs() < 1.0 {
                true => as_far += 1,
                false => round += 1,
            }
            let says = told.text.contains(names[avoided]) || told.text.contains(rooms[avoided]);
            assert!(!says, "{}; {way}", told.text);
        }
    }
    assert!(round > 2 && as_far > 2, "{round} {as_far}");
}

fn house(name: &str) -> Option<(tempfile::TempDir, Engine)> {
    let house = shared(name)?;
    let dir = tempfile::tempdir().unwrap();
    let mut engine = Engine::open(&dir.path().join("store"), None).expect("a new store");
    engine.import(&house, &change()).expect("the house reads");
    Some((dir, engine))
}

/// What hangs on a wall is not on the floor, and on the floor is what stands there.
#[test]
fn what_nothing_bears_is_on_the_floor_or_on_a_wall() {
    let Some((_dir, engine)) = house("procthor/house_7.json") else { return };
    let relations = engine.relations().unwrap();
    let mut held = 0;
    for (relation, said) in [("ON_WALL", "на стене"), ("STANDS_ON_FLOOR", "на полу")] {
        for tuple in relations.tuples(relation).unwrap() {
            let name = tuple[0].to_string();
            let borne = relations.tuples("RESTS_ON").unwrap();
            if borne.iter().any(|pair| pair[0].to_string() == name) {
                continue;
            }
            let told = ask(&engine, &format!("На чём находится {name}?"));
            held += 1;
            assert!(told.text.contains(said), "{relation}: {}", told.text);
        }
    }
    assert!(held > 10, "{held}");
}

/// So many there are in a room and not in it as there are.
#[test]
fn what_is_not_counted_is_left_out() {
    let Some((_dir, engine)) = house("procthor/house_7.json") else { return };
    let number = |question: &str| ask(&engine, question).number.unwrap_or(0.0);
    for kind in ["plants", "paintings", "phones", "spoons", "mugs"] {
        let all = number(&format!("How many {kind} are there?"));
        for room in ["the bathroom", "the bedroom", "the kitchen", "the living room"] {
            let there = number(&format!("How many {kind} are in {room}?"));
            for but in ["not counting", "except", "excluding"] {
                let asked = format!("How many {kind} are there, {but} {room}?");
                let told = ask(&engine, &asked);
                assert!((number(&asked) - (all - there)).abs() < 0.5, "{asked} {}", told.text);
            }
        }
    }
}

/// «В гостиной, то есть на кухне» is no place: nothing is told of what would be in both.
#[test]
fn what_is_said_to_be_in_two_rooms_is_not_understood() {
    let Some((_dir, engine)) = house("procthor/house_6.json") else { return };
    let rooms = ["в гостиной", "на кухне", "в спальне", "в ванной"];
    for (one, other) in rooms.iter().flat_map(|one| rooms.map(|other| (*one, other))) {
        for between in [", ну то есть", ", то есть", ", вернее", ", ой,"] {
            let asked = format!("Сколько стульев {one}{between} {other}?");
            if one == other {
                continue;
            }
            let corrected = format!("Сколько стульев {other}?");
            let meant = ask(&engine, &corrected).number;
            if let Ok(told) = engine.ask(&asked, &mut Memory::default()).unwrap() {
                assert_eq!(told.number, meant, "{asked} {}", told.text);
            }
        }
    }
}

#[test]
fn rooms_above_and_below_are_those_of_other_storeys_that_lie_there() {
    let (_dir, house) = map("two-storeys", |text| text);
    let set = |names: &[&str]| names.iter().map(|name| (*name).to_owned()).collect();
    let above: BTreeSet<String> = names(&house, "Какие комнаты находятся над Холлом-1?");
    assert_eq!(above, set(&["Холл-2"]));
    let below: BTreeSet<String> = names(&house, "Какие комнаты находятся под Холлом-2?");
    assert_eq!(below, set(&["Холл-1"]));
    assert!(ask(&house, "Находится ли Холл-2 над Холлом-1?").text.starts_with("Да"));
    assert!(ask(&house, "Находится ли Холл-1 над Холлом-2?").text.starts_with("Нет"));
    let Some(office) = shared("cases/office-two-storeys.toml") else { return };
    let (_dir, office) = engine(&office, |text| text);
    assert_eq!(names(&office, "Which rooms are above the kitchen?"), set(&["Office A"]));
    assert_eq!(names(&office, "Which rooms are below Office A?"), set(&["Kitchen"]));
    assert_eq!(ask(&office, "Which rooms lie above the ground floor?").things.len(), 5);
}

#[test]
fn the_nearest_room_is_that_to_which_the_way_is_the_shortest_and_not_the_robots_own() {
    for (name, nearest, farthest) in [
        ("rb2", "Какая комната ближайшая?", "Какая комната самая дальняя?"),
        ("lab", "Which room is nearest?", "Which room is the farthest?"),
    ] {
        let (_dir, engine) = map(name, |text| text);
        let world = engine.world().unwrap();
        let start = world.name(Entity::Place(world.robot.start.unwrap())).to_owned();
        let own = world.places[&world.robot.start.unwrap()].area;
        let mut ways: Vec<(f64, String)> = Vec::new();
        for area in world.areas.keys().filter(|area| **area != own) {
            let room = world.name(Entity::Area(*area)).to_owned();
            let way = engine.journey(&start, &room, Method::Shortest).unwrap();
            let length: Option<f64> =
                way.legs.iter().map(|leg| leg.route.as_ref().ok().map(|r| r.length)).sum();
            ways.extend(length.map(|length| (length, room)));
        }
        ways.sort_by(|a, b| a.0.total_cmp(&b.0));
        let told = |question: &str| ask(&engine, question).symbols;
        assert_eq!(told(nearest), [ways[0].1.clone()], "{name}: {ways:?}");
        assert_eq!(told(farthest), [ways[ways.len() - 1].1.clone()], "{name}: {ways:?}");
    }
}

#[test]
fn how_far_places_are_is_told_by_way_or_said_to_be_straight() {
    let (_dir, lab) = map("lab", |text| text.replace("state = \"closed\"", "state = \"locked\""));
    let told = ask(&lab, "How far is the desk?").text;
    assert!(
        told.contains("in a straight line, and there is no way: the office door is locked"),
        "{told}"
    );
    let told = ask(&lab, "How far is the lab?").text;
    assert!(told.contains("the way is"), "{told}");
}

#[test]
fn what_a_zone_shuts_is_not_reached_and_no_plan_leads_there() {
    let (_dir, mut engine) = map("rb2", |text| text);
    let zone = "[zone.z]\nname = \"Краска\"\nkind = \"keep-out\"\nrooms = [\"room-y\"]\n";
    lay(&mut engine, zone);
    let reached = names(&engine, "Which rooms can you reach?");
    assert!(reached.contains("Комната-В") && !reached.contains("Комната-Y"), "{reached:?}");
    for order in ["Принеси лекарство", "Поезжай в Комнату-Y"] {
        let told = drive(&mut engine, order);
        assert!(told.contains("Краск"), "{told}");
        assert!(!told.contains("План:"), "{told}");
    }
}

#[test]
fn who_goes_through_a_room_turns_round_only_where_nothing_leads_on() {
    let (_dir, engine) = map("rb2", |text| text);
    let told = ask(&engine, "How do I get to Room Y through the corridor?").text;
    assert!(told.contains("Door KY to Room Y; Door KY is closed"), "{told}");
}

/// Ways out without a leaf were told only where doors were.
#[test]
fn passages_are_told_where_one_asks_how_a_room_is_left() {
    let (_dir, engine) = map("rb2", |text| text);
    for question in ["What doors does Room V have?", "How do I leave Room V?"] {
        let told = ask(&engine, question).text;
        assert!(told.contains("Door VZ") && told.to_lowercase().contains("passage"), "{told}");
    }
    let told = ask(&engine, "What exits does the corridor have?").text;
    assert!(told.contains("entrance door") && told.contains("Door KY"), "{told}");
}

const BOB: &str = "  { name = \"Bob\", object = \"human\", at = [420, 200] },\n";

fn with_bob(text: &str) -> String {
    let kind = "object = [\n  { name = \"human\", traits = [\"person\"] },\n";
    let body = "[orthoframe.body]\nname = \"Body\"\ntype = \"part\"\nrect = [40, 40]\nheight = 170\n\n\
                [object.human]\nname = \"Human\"\ntype = \"human\"\n\
                items = [{ id = \"A\", orthoframe = \"body\" }]\n\n[object.workbench]";
    let stool = "  { name = \"Stool 1\"";
    text.replacen("object = [\n", kind, 1).replacen("[object.workbench]", body, 1).replacen(
        stool,
        &format!("{BOB}{stool}"),
        1,
    )
}

#[test]
fn a_person_on_the_map_is_found_called_by_name_and_given_things() {
    let (_dir, mut engine) = map("lab", |text| with_bob(&text));
    assert_eq!(names(&engine, "Who is in the lab?"), BTreeSet::from(["Bob".to_owned()]));
    assert!(names(&engine, "Who is in the office?").is_empty());
    assert_eq!(ask(&engine, "How many people are there?").number, Some(1.0));
    assert_eq!(ask(&engine, "Where is Bob?").text, "Bob is in the lab.");
    assert!(ask(&engine, "Who is Bob?").text.starts_with("Bob is a human"));
    let told = drive(&mut engine, "Bring the toolbox to Bob");
    assert!(told.contains("give Toolbox 1 to Bob"), "{told}");
    assert!(told.contains("Done"), "{told}");
    assert!(drive(&mut engine, "Go to Bob").contains("Done"));
}

#[test]
fn on_the_floor_is_on_the_ground_whatever_a_storey_is_called() {
    let floor = |name: &'static str| {
        map("lab", move |text| text.replace("\"Ground floor\"", &format!("\"{name}\"")))
    };
    let (_dir, plain) = floor("Ground floor");
    let expected = names(&plain, "What is on the floor?");
    for name in ["Floor", "Этаж", "Ground"] {
        let (_dir, engine) = floor(name);
        assert_eq!(names(&engine, "What is on the floor?"), expected, "{name}");
        assert_eq!(ask(&engine, "Which rooms are on the floor?").things.len(), 3, "{name}");
    }
}

#[test]
fn an_area_is_moved_by_its_name_and_what_cannot_be_moved_is_called_what_it_is() {
    let (_dir, mut engine) = map("lab", |text| text);
    let edit = |engine: &mut Engine, text: &str| {
        let edits = Edits::read(&Source::new("edits.toml", text), Format::Toml);
        engine
            .edit(&edits, &change(), Mode::DryRun)
            .map(|edited| edited.differences.iter().map(|d| format!("{d}\n")).collect::<String>())
    };
    let told = edit(&mut engine, "[[edit]]\nmove = \"Office\"\nby = [0, 0, 5]\n");
    let told = told.unwrap_or_else(|e| panic!("{e:?}"));
    assert!(told.contains("Ground floor"), "{told}");
    let no = edit(&mut engine, "[[edit]]\nmove = \"Office door\"\nby = [1, 0]\n").unwrap_err();
    let no = format!("{no:?}");
    assert!(no.contains("дверь «Office door»"), "{no}");
}

/// "Are all the lamps on?" is affirmed where it is affirmed of each: of what the map says nothing, nothing is known.
#[test]
fn what_is_said_of_all_is_so_of_each() {
    let mut affirmed = 0;
    for scene in ["virtualhome/TestScene3_graph.json", "procthor/house_5.json"] {
        let path = format!("../shared/data/{scene}");
        let Some(engine) = crate::talk::engine(&path) else { return };
        let world = engine.world().unwrap();
        let mut kinds: BTreeSet<String> = BTreeSet::new();
        for replica in world.replicas.values() {
            let kind = world.types.object.get(world.objects[&replica.object].object_type);
            kinds.extend(kind.map(|kind| kind.name_en.to_lowercase()));
        }
        kinds.insert("lamp".to_owned());
        for kind in kinds {
            let kinds = orthoframe_language::english::plural(&kind);
            for state in ["on", "off", "open", "closed"] {
                let holds = |line: String| {
                    let answer = engine.ask(&line, &mut Memory::default()).expect("there is a map");
                    answer.ok().is_some_and(|answer| answer.said == Said::Yes)
                };
                if !holds(format!("Are all the {kinds} {state}?")) {
                    continue;
                }
                let all = engine.ask(&format!("Which {kinds} are there?"), &mut Memory::default());
                for name in all.expect("there is a map").expect("they were spoken of").symbols {
                    let id = world.find(&name)[0];
                    let Entity::Replica(id) = id else { continue };
                    let name = &world.replicas[&id].name_en;
                    assert!(holds(format!("Is {name} {state}?")), "{kinds} {state}: {name}");
                }
                affirmed += 1;
            }
        }
    }
    assert!(affirmed > 2, "{affirmed}");
}

/// What is put onto a thing that holds others is not said to be put into it, nor the reverse.
#[test]
fn a_step_says_where_a_thing_is_put_as_it_was_ordered() {
    let path = "../shared/data/virtualhome/TestScene3_graph.json";
    let Some(engine) = crate::talk::engine(path) else { return };
    let mut opens = engine.world().unwrap().clone();
    opens.robot.opens = true;
    let engine = Engine::in_memory(opens, None).unwrap();
    let world = engine.world().unwrap();
    for (order, said) in [
        ("Put the mug on the microwave", "put Mug 1 on Microwave 1"),
        ("Put the mug in the microwave", "put Mug 1 in Microwave 1"),
        ("Поставь кружку на стиральную машину", "put Mug 1 on Washing machine 1"),
        ("Положи кружку в стиральную машину", "put Mug 1 in Washing machine 1"),
    ] {
        let done = engine.perform(order, &mut |_| {}).unwrap_or_else(|e| panic!("{order}: {e}"));
        let steps = done.reports.iter().map(|r| r.directive_in_words(world, Language::English));
        let puts: Vec<String> =
            steps.filter(|step| step.starts_with("put") && !step.ends_with("down")).collect();
        assert_eq!(puts, [said], "{order}");
    }
}

/// "Is it in the fridge?" of what stands on the fridge: where it is told to be, there it is, and nowhere else.
#[test]
fn what_stands_on_a_container_is_not_in_it() {
    let mut told = [0; 2];
    for map in ["procthor/house_5.json", "virtualhome/TestScene3_graph.json"] {
        let Some(file) = shared(map) else { return };
        let dir = tempfile::tempdir().unwrap();
        let mut engine = Engine::open(&dir.path().join("store"), None).expect("a new store");
        engine.import(&file, &change()).expect("the map is sound");
        if map.starts_with("procthor") {
            drive(&mut engine, "Put the apple on the fridge");
            drive(&mut engine, "Put the plate in the fridge");
        }
        let world = engine.world().unwrap();
        for thing in world.replicas.values().filter(|r| world.has_trait(r.id, "portable")) {
            let thing = &thing.name_en;
            let place = format!("{} ", ask(&engine, &format!("Where is {thing}?")).text);
            let place = place.replace('.', " ");
            let lies =
                |rel: &str, id| place.contains(&format!(" {rel} {} ", world.replicas[&id].name_en));
            let container =
                |id: &_| world.has_trait(*id, "container") && !world.has_trait(*id, "shelves");
            let borne = world.replicas.keys().filter(|id| container(id));
            let Some(&support) = borne.clone().find(|id| lies("in", **id) || lies("on", **id))
            else {
                continue;
            };
            let (is_in, support) = (lies("in", support), &world.replicas[&support].name_en);
            for (rel, holds) in [("in", is_in), ("on", !is_in)] {
                let answer = ask(&engine, &format!("Is {thing} {rel} {support}?"));
                // What was not seen where it should be is not told as a fact.
                let said = if holds { Said::Yes } else { Said::No };
                let told = answer.said == said || answer.said == Said::Unknown;
                assert!(told, "{place} {rel} {support}: {}", answer.text);
            }
            told[usize::from(is_in)] += 1;
        }
    }
    assert!(told.iter().all(|told| *told > 0), "{told:?}");
}

/// Books in a bookcase are on its shelves.
#[test]
fn what_is_in_a_bookcase_is_on_shelves() {
    let Some(engine) = crate::talk::engine("../shared/data/virtualhome/TestScene3_graph.json")
    else {
        return;
    };
    for (on, off) in [
        ("Which books are on shelves?", "Which books are not on shelves?"),
        ("Какие книги на полках?", "Какие книги не на полках?"),
    ] {
        let (on, off) = (names(&engine, on), names(&engine, off));
        assert!(on.is_disjoint(&off), "{on:?} {off:?}");
        assert_eq!(on.len() + off.len(), names(&engine, "Where are the books?").len());
        assert!(on.len() > 10, "{on:?}");
    }
    assert_eq!(ask(&engine, "Is Book 1 on a shelf?").said, Said::Yes);
}
