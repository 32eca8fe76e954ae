//! Tasks from storey to storey: planned, driven by lift, told step by step.

use orthoframe::Engine;
use orthoframe::engine::{TaskAnswer, TaskEnding, change_now};
use orthoframe_language::Language;
use orthoframe_map::{DoorState, Entity, Format, World};
use orthoframe_units::{DoorId, Source};

const HOUSE: &str = include_str!("../maps/two-storeys.toml");

fn house(text: &str) -> World {
    World::parse(&Source::new("дом.toml", text), Format::Toml)
        .unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)))
}

fn engine(text: &str) -> Engine {
    Engine::in_memory(house(text), None).expect("built-in rules")
}

fn door(world: &World, name: &str) -> DoorId {
    let door = |e| if let Entity::Door(id) = e { Some(id) } else { None };
    world.find(name).into_iter().find_map(door).unwrap_or_else(|| panic!("no {name}"))
}

fn perform(engine: &Engine, command: &str) -> TaskAnswer {
    engine.perform(command, &mut |_| {}).unwrap_or_else(|e| panic!("{command}: {e}"))
}

fn words(engine: &Engine, answer: &TaskAnswer, language: Language) -> Vec<String> {
    let world = engine.world().unwrap();
    answer.reports.iter().map(|r| r.directive_in_words(world, language)).collect()
}

#[test]
fn a_thing_is_brought_from_another_storey() {
    let engine = engine(HOUSE);
    let answer = perform(&engine, "Bring the book");
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    assert_eq!((answer.end_map, answer.replans), (answer.map, 0));
    let told = words(&engine, &answer, Language::English);
    for step in [
        "take Key 1",
        "drive to Lift door 1",
        "call the lift “Lift A”",
        "go through Lift door 1 into Cabin 1",
        "ride the lift “Lift A” to the second floor",
        "unlock the laboratory door",
        "take Book 1",
        "ride the lift “Lift A” to the first floor",
        "give Book 1 to the operator",
    ] {
        assert!(told.iter().any(|t| t == step), "{step}: {told:#?}");
    }
    // Every leg lies on the storey that its report names.
    for report in &answer.reports {
        let floor = &engine.floors().unwrap()[&report.map];
        for &point in &report.points {
            assert!(floor.locate(point).is_some(), "{}: {point}", report.directive);
        }
        assert!(floor.locate(report.pose.at).is_some(), "{}", report.directive);
    }
}

#[test]
fn a_storey_is_a_goal() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = Engine::open(&dir.path().join("store"), None).unwrap();
    let map = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/two-storeys.toml");
    engine.import(map.as_ref(), &change_now("проверка", "карта")).unwrap();
    let storey = |engine: &Engine, answer: &TaskAnswer| {
        engine.world().unwrap().maps[&answer.end_map].name.clone()
    };
    for (command, done, name) in [
        ("Поезжай на первый этаж", false, "Первый этаж"),
        ("Поезжай на второй этаж", true, "Второй этаж"),
        ("Поезжай на второй этаж", false, "Второй этаж"),
        ("Go to the first floor", true, "Первый этаж"),
        ("Поезжай в Кабину-2", true, "Второй этаж"),
        // In a cabin one is on no storey yet.
        ("Поезжай на второй этаж", true, "Второй этаж"),
    ] {
        let answer = perform(&engine, command);
        match done {
            true => assert!(matches!(answer.ending, TaskEnding::Done), "{command}"),
            false => assert!(matches!(answer.ending, TaskEnding::AlreadyTrue), "{command}"),
        }
        assert_eq!(storey(&engine, &answer), name, "{command}");
        engine.remember(&answer, std::time::SystemTime::now().into()).unwrap();
    }
}

#[test]
fn a_cabin_may_lie_elsewhere_on_the_next_map() {
    // The second storey is drawn a quarter turned, in coordinates of its own.
    let turned = HOUSE.replace("at = [0, 0, 320]", "at = [5000, -300, 320], angle = 90");
    assert_ne!(turned, HOUSE);
    let engine = engine(&turned);
    for command in ["Включи лампу", "Отнеси чашку в Холл-2", "Принеси книгу"]
    {
        let answer = perform(&engine, command);
        assert!(matches!(answer.ending, TaskEnding::Done), "{command}: {:?}", answer.ending);
    }
}

#[test]
fn a_lift_whose_door_stays_locked_is_no_way() {
    let engine = engine(HOUSE);
    for name in ["Дверь лифта-1", "Дверь лифта-2"] {
        let mut truth = engine.world().unwrap().clone();
        truth.doors.get_mut(&door(&truth, name)).unwrap().state = DoorState::LOCKED;
        let answer = engine.perform_in("Поезжай в Холл-2", truth, &mut |_| {}).unwrap();
        assert!(matches!(answer.ending, TaskEnding::NoPlan(_)), "{name}: {:?}", answer.ending);
    }
}

#[test]
fn stairs_are_no_way_and_it_is_said() {
    let stairs = HOUSE.replace(
        r#"{ name = "кабина", name_en = "cabin" }"#,
        r#"{ name = "кабина", name_en = "cabin", traits = ["stairs"] }"#,
    );
    assert_ne!(stairs, HOUSE);
    let engine = engine(&stairs);
    for (command, russian, english) in [
        (
            "Поезжай на второй этаж",
            "На Второй этаж ведёт только лестница, а по ней роботу не проехать.",
            "Only stairs lead to the second floor, and the robot cannot climb them.",
        ),
        (
            "Включи лампу",
            "В Холл-2 ведёт только лестница, а по ней роботу не проехать.",
            "Only stairs lead to Hall 2, and the robot cannot climb them.",
        ),
    ] {
        let answer = perform(&engine, command);
        assert!(matches!(answer.ending, TaskEnding::NoPlan(_)), "{command}");
        assert_eq!(engine.unconnected_in_words(&answer, Language::Russian), [russian]);
        assert_eq!(engine.unconnected_in_words(&answer, Language::English), [english]);
    }
}

/// An opening to which the map gives no name is passed like any other.
#[test]
fn a_passage_without_a_name_is_driven_through() {
    let open = HOUSE
        .replace(
            r#"side.D = { permeability = "conditional" }, side.F"#,
            r#"side.D = { permeability = "permeable" }, side.F"#,
        )
        .replace(
            r#"[160, 160], [0, 160]], side.B = { permeability = "conditional" }"#,
            r#"[160, 160], [0, 160]], side.B = { permeability = "permeable" }"#,
        )
        .replace(r#", { side = "D", door = "lift-1", opens = "outside" }"#, "")
        .replace(r#", { side = "D", door = "lift-2", opens = "outside" }"#, "")
        .replace(r#"doors = [{ side = "B", door = "lift-1", opens = "inside" }]"#, "")
        .replace(r#"doors = [{ side = "B", door = "lift-2", opens = "inside" }]"#, "")
        .lines()
        .filter(|line| !line.starts_with("lift-1 =") && !line.starts_with("lift-2 ="))
        .collect::<Vec<_>>()
        .join("\n")
        .replace(
            "[map.second]",
            "links = [{ from = \"hall-1.D\", to = \"cabin-1.B\" }]\n[map.second]",
        )
        + "\nlinks = [{ from = \"hall-2.D\", to = \"cabin-2.B\" }]\n";
    let by_lift = engine(&open);
    let answer = perform(&by_lift, "Включи лампу");
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    // The same without a lift: a niche that one drives into and out of.
    let niche =
        open.replace(r#"lifts = [{ name = "Лифт А", stops = ["cabin-1", "cabin-2"] }]"#, "");
    let engine = engine(&niche);
    let answer = perform(&engine, "Поезжай в Кабину-1");
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    assert_eq!(answer.reports.last().unwrap().position.as_ref().map(|_| ()), Some(()));
}
