//! Commands beyond bringing: switch, find, tidy, call, each from the sentence to the world that it leaves.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe::engine::{Memory, Progress, TaskAnswer, TaskEnding, change_now};
use orthoframe_geometry::Scene;
use orthoframe_language::Language;
use orthoframe_language::command::Command;
use orthoframe_map::{DoorState, Entity, Format, World, is_on, switch};
use orthoframe_robot::{Primitive, Surprise};
use orthoframe_semantics::{Profile, RelationRules, derive};
use orthoframe_units::{AreaId, ReplicaId, Source};

use crate::worlds::{mirrored, rb2};

fn thing(world: &World, name: &str) -> ReplicaId {
    let replica = |e| if let Entity::Replica(id) = e { Some(id) } else { None };
    world.find(name).into_iter().find_map(replica).unwrap_or_else(|| panic!("no {name}"))
}

fn area(world: &World, name: &str) -> AreaId {
    let area = |e| if let Entity::Area(id) = e { Some(id) } else { None };
    world.find(name).into_iter().find_map(area).unwrap_or_else(|| panic!("no {name}"))
}

fn perform(engine: &Engine, command: &str) -> TaskAnswer {
    engine.perform(command, &mut |_| {}).unwrap_or_else(|e| panic!("{command}: {e}"))
}

fn said(world: &World, answer: &TaskAnswer, language: Language) -> Vec<String> {
    answer.reports.iter().flat_map(|r| r.actions_in_words(world, language)).collect()
}

/// The flat in a store of its own, so that one task goes on from another.
fn stored(dir: &tempfile::TempDir) -> Engine {
    let mut engine = Engine::open(&dir.path().join("store"), None).unwrap();
    let map = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/rb2.toml");
    engine.import(map.as_ref(), &change_now("проверка", "карта")).unwrap();
    engine
}

fn perform_and_remember(engine: &mut Engine, command: &str) -> TaskAnswer {
    let answer = perform(engine, command);
    engine.remember(&answer, std::time::SystemTime::now().into()).unwrap();
    answer
}

fn world_now(engine: &Engine) -> World {
    engine.uncarried().unwrap().clone()
}

/// What a thing lies on or in, by the relations of that world.
fn support(world: &World, name: &str) -> Option<String> {
    let relations = derive(world, &RelationRules::standard(), Profile::Surveyed).unwrap();
    let on = relations.support_of(thing(world, name))?;
    Some(world.replicas[&on].name.clone())
}

#[test]
fn a_device_is_switched_by_one_who_stands_by_it() {
    for (how, world) in [("as it is", rb2()), ("mirrored", mirrored(&rb2()))] {
        let cases = [
            ("Включи торшер", "Торшер-1", true, "Я включил Торшер-1.", "on"),
            ("Turn off the lamp 1", "Лампа-1", false, "Я выключил Лампу-1.", "off"),
            ("Выключи чайник", "Чайник-1", false, "Я выключил Чайник-1.", "off"),
        ];
        let engine = Engine::in_memory(world.clone(), None).unwrap();
        for (command, device, on, russian, english) in cases {
            let id = thing(&world, device);
            let answer = perform(&engine, command);
            assert!(matches!(answer.ending, TaskEnding::Done), "{how}, {command}");
            let after = answer.after.as_ref().unwrap();
            assert_eq!(after.memory.devices, [(id, on)].into(), "{how}, {command}");
            let bounds = Scene::of(&world, answer.map).replicas[&id].bounds;
            let at = answer.end.at;
            let (dx, dy) = (
                (bounds.min.x - at.x).max(at.x - bounds.max.x).max(0.0),
                (bounds.min.y - at.y).max(at.y - bounds.max.y).max(0.0),
            );
            let arm = world.robot.radius.get() + 90.0;
            assert!(dx.hypot(dy) <= arm, "{how}, {command}: {dx} {dy}");
            assert_eq!(said(&world, &answer, Language::Russian), [russian], "{how}");
            let words = &said(&world, &answer, Language::English)[0];
            assert!(words.starts_with(&format!("I switched {english} ")), "{how}: {words}");

            let mut so_already = world.clone();
            switch(&mut so_already.replicas.get_mut(&id).unwrap().properties, on);
            let answer = perform(&Engine::in_memory(so_already, None).unwrap(), command);
            assert!(matches!(answer.ending, TaskEnding::AlreadyTrue), "{how}, {command}");
            assert!(answer.reports.is_empty());
        }
        let refused = engine.perform("Включи диван", &mut |_| {}).unwrap_err();
        assert_eq!(refused.to_string(), "«Диван-1» нельзя ни включить, ни выключить", "{how}");
    }
}

#[test]
fn a_device_stays_as_the_last_task_left_it() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = stored(&dir);
    let lamp = thing(&rb2(), "Торшер-1");
    let state = |engine: &Engine| is_on(&world_now(engine).replicas[&lamp].properties);
    assert_eq!(state(&engine), Some(false));
    perform_and_remember(&mut engine, "Включи торшер");
    drop(engine);
    let mut engine = Engine::open_existing(&dir.path().join("store"), None).unwrap();
    assert_eq!(state(&engine), Some(true));
    assert_eq!(engine.world().unwrap(), &rb2(), "the map itself is as it was surveyed");
    let again = perform_and_remember(&mut engine, "Switch on the floor lamp");
    assert!(matches!(again.ending, TaskEnding::AlreadyTrue));
    let off = perform_and_remember(&mut engine, "Выключи торшер");
    assert!(matches!(off.ending, TaskEnding::Done));
    assert_eq!(state(&engine), Some(false));
    assert!(off.after.unwrap().memory.devices.is_empty(), "it is as the map says again");
}

/// Questions are asked of the world as the last task left it, while the map stays as surveyed.
#[test]
fn questions_are_answered_as_the_robot_left_the_world() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = stored(&dir);
    let said = |engine: &Engine, question: &str| {
        engine.ask(question, &mut Memory::default()).unwrap().unwrap().text
    };
    assert_eq!(said(&engine, "Дверь-КY открыта?"), "Нет, Дверь-КY закрыта.");
    assert_eq!(said(&engine, "Лампа-1 включена?"), "Да, Лампа-1 включена.");
    for task in ["Открой Дверь-КY", "Выключи Лампу-1", "Возьми Книгу-5"]
    {
        perform_and_remember(&mut engine, task);
    }
    drop(engine);
    let engine = Engine::open_existing(&dir.path().join("store"), None).unwrap();
    for (question, answer) in [
        ("Дверь-КY открыта?", "Да, Дверь-КY открыта."),
        ("Is Door KY closed?", "No, Door KY is open."),
        ("Лампа-1 включена?", "Нет, Лампа-1 выключена."),
        ("Горит ли свет в Комнате-В?", "Нет, Торшер-1 выключен и Лампа-1 выключена."),
        ("Где Книга-5?", "Книга-5 находится у меня в руках."),
        ("What are you holding?", "I am holding Book 5."),
        ("Сколько книг в Комнате-Y?", "В Комнате-Y нет книг."),
        ("Книга-5 на комоде?", "Нет, Книга-5 находится не на Комоде-1, а у меня в руках."),
    ] {
        assert_eq!(said(&engine, question), answer, "{question}");
    }
    assert_eq!(engine.world().unwrap(), &rb2());
}

/// «Найди чашку» is done with any of them, the nearest; «Принеси чашку» is asked back.
#[test]
fn any_will_do_to_be_found_but_not_to_be_brought() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    let found = engine.understand("Найди чашку").unwrap();
    let [Command::Find(cup)] = &found[..] else { panic!("{found:?}") };
    assert!(engine.world().unwrap().name(cup.id).starts_with("Чашка"));
    assert!(engine.understand("Принеси чашку").is_err());
    assert!(engine.understand("Find a cup").is_ok());
}

/// Searches for the red cup in a truth of its own: the answer, the Areas where it was not seen, and how many plans
/// were helped by the one before.
fn search(truth: World) -> (TaskAnswer, Vec<AreaId>, usize) {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    let (mut missed, mut helped) = (Vec::new(), 0);
    let answer = engine.perform_in("Найди красную чашку", truth, &mut |progress| {
        match progress {
            Progress::Surprised { surprise: Surprise::NotSeen { thing, area, .. }, .. } => {
                assert_eq!(thing, "Чашка-2");
                missed.push(*area);
            }
            Progress::Planned(planned) => helped += usize::from(planned.learned_before),
            _ => {}
        }
    });
    (answer.unwrap(), missed, helped)
}

#[test]
fn a_thing_is_sought_from_room_to_room() {
    let world = rb2();
    let cup = thing(&world, "Чашка-2");

    let (answer, missed, helped) = search(world.clone());
    assert_eq!(helped, 0, "there is one plan");
    assert!(matches!(answer.ending, TaskEnding::Done));
    assert!(missed.is_empty());
    assert_eq!(said(&world, &answer, Language::Russian), ["Я вижу Чашку-2."]);

    // It stands where the umbrella should be.
    let mut moved = world.clone();
    let umbrella = world.replicas[&thing(&world, "Зонт-1")].clone();
    let replica = moved.replicas.get_mut(&cup).unwrap();
    (replica.area, replica.frame) = (umbrella.area, umbrella.frame);
    moved.replicas.remove(&umbrella.id);
    let (answer, missed, _) = search(moved.clone());
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    assert_eq!(missed[0], area(&world, "Комната-Z"), "first where it is believed to be");
    let seen = answer.after.as_ref().unwrap().moved[&cup].unwrap();
    assert_eq!((seen.area, seen.frame), (umbrella.area, umbrella.frame));
    let last = answer.reports.last().unwrap();
    assert!(
        matches!(&last.directive.primitives()[..], [Primitive::Seek(name)] if name == "Чашка-2")
    );

    // It is nowhere: every room is looked into once, and then it is said.
    let mut gone = world.clone();
    gone.replicas.remove(&cup);
    let (answer, missed, helped) = search(gone);
    assert!(helped > 0, "that a thing is not here takes possibilities away and gives none");
    assert!(matches!(answer.ending, TaskEnding::NoPlan(_)), "{:?}", answer.ending);
    let rooms: BTreeSet<AreaId> = world.areas.keys().copied().collect();
    assert_eq!(missed.len(), rooms.len());
    assert_eq!(missed.into_iter().collect::<BTreeSet<_>>(), rooms);
}

#[test]
fn what_stands_in_view_is_found_already() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    let answer = perform(&engine, "Найди диван");
    assert!(matches!(answer.ending, TaskEnding::AlreadyTrue));
    let behind_walls = perform(&engine, "Найди кровать");
    assert!(matches!(behind_walls.ending, TaskEnding::Done));
}

#[test]
fn things_are_put_back_where_they_were_surveyed() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = stored(&dir);
    assert!(matches!(perform(&engine, "Наведи порядок").ending, TaskEnding::AlreadyTrue));
    for (command, name, on) in [
        ("Положи белую чашку на письменный стол", "Чашка-1", "Письменный стол"),
        ("Положи красную чашку на обеденный стол", "Чашка-2", "Обеденный стол"),
    ] {
        let put = perform_and_remember(&mut engine, command);
        assert!(matches!(put.ending, TaskEnding::Done), "{command}: {:?}", put.ending);
        assert_eq!(support(&world_now(&engine), name).as_deref(), Some(on));
    }
    let elsewhere = perform_and_remember(&mut engine, "Tidy the bedroom");
    assert!(matches!(elsewhere.ending, TaskEnding::AlreadyTrue), "nothing there is misplaced");
    let one = perform_and_remember(&mut engine, "Tidy the living room");
    assert!(matches!(one.ending, TaskEnding::Done), "{:?}", one.ending);
    let sentences = said(&rb2(), &one, Language::Russian);
    assert_eq!(sentences, ["Я вернул Чашку-1 на место."]);
    let rest = perform_and_remember(&mut engine, "Tidy up");
    assert!(matches!(rest.ending, TaskEnding::Done), "{:?}", rest.ending);
    assert_eq!(said(&rb2(), &rest, Language::Russian), ["Я вернул Чашку-2 на место."]);
    for name in ["Чашка-1", "Чашка-2"] {
        assert_eq!(support(&world_now(&engine), name), support(&rb2(), name), "{name}");
    }
    assert!(matches!(perform(&engine, "Наведи порядок").ending, TaskEnding::AlreadyTrue));
}

#[test]
fn a_home_may_be_a_property() {
    let mut world = rb2();
    let book = thing(&world, "Книга-4");
    let properties = &mut world.replicas.get_mut(&book).unwrap().properties;
    properties.insert("ХРАНИТСЯ_НА".to_owned(), "письменный стол".to_owned());
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let answer = perform(&engine, "Наведи порядок");
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    let seen = answer.after.as_ref().unwrap().moved[&book].unwrap();
    let mut after = world.clone();
    let replica = after.replicas.get_mut(&book).unwrap();
    (replica.area, replica.frame) = (seen.area, seen.frame);
    assert_eq!(support(&after, "Книга-4").as_deref(), Some("Письменный стол"));

    let properties = &mut world.replicas.get_mut(&book).unwrap().properties;
    properties.insert("ХРАНИТСЯ_НА".to_owned(), "Рояль".to_owned());
    let engine = Engine::in_memory(world, None).unwrap();
    let error = engine.perform("Наведи порядок", &mut |_| {}).unwrap_err();
    assert_eq!(error.to_string(), "«Книга-4» хранится на «Рояль», а такой вещи на карте нет");
}

#[test]
fn the_operator_is_called_with_the_place_said() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    for command in ["Позови оператора", "Call the operator"] {
        let answer = perform(&engine, command);
        assert!(matches!(answer.ending, TaskEnding::Done), "{command}");
        let ru = said(&rb2(), &answer, Language::Russian);
        assert_eq!(ru, ["Оператор, подойдите, пожалуйста, ко мне."]);
        let en = said(&rb2(), &answer, Language::English);
        assert_eq!(en, ["Operator, please come to me."]);
        let place = answer.reports[0].position.as_ref().unwrap().say(Language::Russian);
        assert!(place.contains("Комнаты-В"), "{place}");
        assert_eq!(answer.start, answer.end);
    }
}

/// A small lab that knows no Russian.
fn lab() -> Engine {
    let map = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/lab.toml");
    Engine::in_memory(World::load(map).expect("the lab is sound"), None).unwrap()
}

#[test]
fn what_is_brought_into_a_room_lies_there_afterwards() {
    for (command, name, room) in [
        ("Отнеси лекарство в Комнату-В", "Лекарство", "Комната-В"),
        ("Принеси чашку-1 в Комнату-Z", "Чашка-1", "Комната-Z"),
        ("Перенеси зонт в Комнату-Y", "Зонт-1", "Комната-Y"),
    ] {
        let dir = tempfile::tempdir().unwrap();
        let mut engine = stored(&dir);
        let answer = perform_and_remember(&mut engine, command);
        assert!(matches!(answer.ending, TaskEnding::Done), "{command}: {:?}", answer.ending);
        let world = world_now(&engine);
        assert_eq!(world.replicas[&thing(&world, name)].area, area(&world, room), "{command}");
        // A table takes it, not a chair.
        let on = support(&world, name).unwrap_or_else(|| panic!("{command}: on the floor"));
        assert!(!on.starts_with("Стул"), "{command}: on {on}");
        let again = perform(&engine, command);
        assert!(matches!(again.ending, TaskEnding::AlreadyTrue), "{command}: {:?}", again.ending);
    }
}

#[test]
fn what_cannot_be_carried_is_refused_and_not_left_behind() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    for command in ["Принеси Стол-1", "Возьми Диван-1", "Перенеси Кресло-1 в Комнату-Z"]
    {
        let refused = engine.perform(command, &mut |_| {}).unwrap_err().to_string();
        assert!(refused.contains("не носит"), "{command}: {refused}");
    }
    let lab = lab();
    let refused = lab.perform("Move the stool to the office", &mut |_| {}).unwrap_err();
    assert_eq!(refused.in_english().to_string(), "the robot does not carry Stool 1");
    // "Go" takes nothing along, and what was said of a thing is not passed over.
    assert!(lab.understand("Go the toolbox to the office").is_err());
}

#[test]
fn a_verb_that_is_also_a_state_orders() {
    let mut world = World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/maps/lab.toml")).unwrap();
    for open in [true, false] {
        for door in world.doors.values_mut() {
            door.state = if open { DoorState::OPEN } else { DoorState::CLOSED };
        }
        let lab = Engine::in_memory(world.clone(), None).unwrap();
        for command in [
            "Open the lab door",
            "Please open the lab door",
            "Go to the lab, then open the lab door",
            "Go to the lab and open the lab door",
        ] {
            let heard = lab.understand(command).unwrap_or_else(|e| panic!("{command}: {e}"));
            let Some(Command::Open(door)) = heard.last() else { panic!("{command}: {heard:?}") };
            assert_eq!(lab.world().unwrap().name(door.id), "Lab door", "{command}");
        }
    }
}

/// Every directive of a plan can be told in both languages, and the English has no Russian word left in it.
#[test]
fn directives_are_told_in_words() {
    let lab = lab();
    let answer = perform(&lab, "Take the battery to the lab");
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    let told: Vec<String> = answer
        .reports
        .iter()
        .map(|r| r.directive_in_words(lab.world().unwrap(), Language::English))
        .collect();
    assert_eq!(
        told,
        [
            "drive to the office door",
            "open the office door",
            "go through the office door into the office",
            "drive to Desk 1",
            "take Battery 1",
            "drive to the office door",
            "go through the office door into the corridor",
            "drive to the lab door",
            "go through the lab door into the lab",
            "drive to Workbench 1",
            "put Battery 1 on Workbench 1",
        ]
    );
    let flat = Engine::in_memory(rb2(), None).unwrap();
    let answer = perform(&flat, "Открой Дверь-КY и включи торшер-1");
    let told: Vec<String> = answer
        .reports
        .iter()
        .map(|r| r.directive_in_words(flat.world().unwrap(), Language::Russian))
        .collect();
    for words in ["подъехать к Двери-КY", "открыть Дверь-КY", "включить Торшер-1"]
    {
        assert!(told.iter().any(|t| t == words), "{words}: {told:?}");
    }
}

#[test]
fn what_the_program_understands_of_a_map_may_be_english() {
    let text = include_str!("../maps/lab.toml")
        .replace("properties = { colour = \"red\" }", "properties = { KEPT_ON = \"Workbench 1\" }");
    let map = tempfile::Builder::new().suffix(".toml").tempfile().unwrap();
    std::fs::write(map.path(), text).unwrap();
    let lab = Engine::in_memory(World::load(map.path()).unwrap(), None).unwrap();
    let lamp = |world: &World| is_on(&world.replicas[&thing(world, "Lamp 1")].properties);
    assert_eq!(lamp(lab.world().unwrap()), Some(false));
    let answer = lab.ask("Is the lamp on?", &mut Memory::default()).unwrap().unwrap();
    assert_eq!(answer.text, "No, Lamp 1 is switched off.");
    let lit = perform(&lab, "Switch on the lamp");
    assert!(matches!(lit.ending, TaskEnding::Done), "{:?}", lit.ending);
    let tidied = perform(&lab, "Tidy the lab");
    let words: Vec<String> = tidied
        .reports
        .iter()
        .map(|r| r.directive_in_words(lab.world().unwrap(), Language::English))
        .collect();
    assert!(words.iter().any(|w| w.contains("Toolbox 1 on Workbench 1")), "{words:?}");
}

/// «в» is not «на»: a shelf takes a thing between its boards, a table has no inside, a shut door keeps things out.
#[test]
fn what_is_put_into_a_thing_is_inside_of_it() {
    let mut world = rb2();
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    for (command, why) in [
        ("Положи чашку-1 в Обеденный стол", "места внутри карта не знает"),
        ("Положи чашку-1 в Холодильник-1", "дверцы закрыты"),
    ] {
        let refused = engine.perform(command, &mut |_| {}).unwrap_err().to_string();
        assert!(refused.contains(why), "{command}: {refused}");
    }
    for door in world.doors.values_mut() {
        if door.name == "Дверца холодильника" {
            door.state = DoorState::OPEN;
        }
    }
    for (command, into) in [
        ("Положи чашку-1 в Стеллаж-1", "Стеллаж-1"),
        ("Поставь чашку-1 в Холодильник-1", "Холодильник-1"),
    ] {
        let engine = Engine::in_memory(world.clone(), None).unwrap();
        let answer = perform(&engine, command);
        assert!(matches!(answer.ending, TaskEnding::Done), "{command}: {:?}", answer.ending);
        let after = answer.after.expect("something was done");
        let (&replica, seen) = after.moved.iter().next().expect("the cup is elsewhere");
        let seen = seen.as_ref().expect("the cup is somewhere");
        let mut now = world.clone();
        let cup = now.replicas.get_mut(&replica).expect("a thing of the map");
        (cup.area, cup.frame) = (seen.area, seen.frame);
        let relations = derive(&now, &RelationRules::standard(), Profile::Surveyed).unwrap();
        let inside = relations.derived().tuples("INSIDE").unwrap();
        let held: Vec<Option<&str>> =
            inside.filter(|t| t.symbol(0) == Some("Чашка-1")).map(|t| t.symbol(1)).collect();
        assert!(held.contains(&Some(into)), "{command}: {held:?}");
    }
}

#[test]
fn a_room_to_which_nothing_leads_is_named() {
    let text = include_str!("../maps/lab.toml");
    let between = |text: &str, from: &str, to: &str| {
        let start = text.find(from).unwrap();
        start..start + text[start..].find(to).unwrap()
    };
    // The door of the office walled up on both sides.
    let mut text = text.to_owned();
    text.replace_range(between(&text, "[door.office]", "# Furniture"), "");
    for (room, side) in [("office", "side.B"), ("corridor", "side.D")] {
        let head = text.find(&format!("[orthoframe.{room}]")).unwrap();
        let at = head + text[head..].find(side).unwrap();
        let end = at + text[at..].find('\n').unwrap();
        text.replace_range(at..end, &format!("{side} = {{ type = \"wall\" }}"));
    }
    let walled = text
        .replace("  { side = \"D\", door = \"office\", opens = \"outside\" },\n", "")
        .replace("doors = [{ side = \"B\", door = \"office\", opens = \"inside\" }]\n", "");
    let walled = format!(
        "{walled}links = [\n  {{ from = \"lab.B\", to = \"corridor.F\" }},\n  \
         {{ from = \"office.F\", to = \"lab.D\" }},\n]\n"
    );
    let world = World::parse(&Source::new("walled", walled), Format::Toml).unwrap();
    let lab = Engine::in_memory(world, None).unwrap();
    for (command, told) in [
        ("Bring the battery", vec!["Neither door nor passage leads to the office."]),
        ("Go to the desk", vec!["Neither door nor passage leads to the office."]),
        ("Bring the toolbox", vec![]),
    ] {
        let answer = perform(&lab, command);
        let has_plan = matches!(answer.ending, TaskEnding::Done);
        assert_eq!(has_plan, told.is_empty(), "{command}: {:?}", answer.ending);
        assert_eq!(lab.unconnected_in_words(&answer, Language::English), told, "{command}");
    }
}

/// «Принеси чашку.» – «А теперь поставь её на стол.»: the person gives back what was handed over.
#[test]
fn what_was_handed_over_is_taken_back() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = stored(&dir);
    perform_and_remember(&mut engine, "Принеси красную чашку");
    let put = perform_and_remember(&mut engine, "Поставь красную чашку на обеденный стол");
    assert!(matches!(put.ending, TaskEnding::Done), "{:?}", put.ending);
    assert_eq!(support(&world_now(&engine), "Чашка-2").as_deref(), Some("Обеденный стол"));
    perform_and_remember(&mut engine, "Bring me the red cup");
    let back = perform_and_remember(&mut engine, "Верни красную чашку на место");
    assert!(matches!(back.ending, TaskEnding::Done), "{:?}", back.ending);
    assert_eq!(support(&world_now(&engine), "Чашка-2"), support(&rb2(), "Чашка-2"));
}

/// The place beside what lay on the floor goes with it, and the robot goes on from there.
#[test]
fn what_was_picked_up_from_the_floor_is_carried_on() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    let done = perform(&engine, "Возьми зонт и положи его на кровать, а потом вернись сюда");
    assert!(matches!(done.ending, TaskEnding::Done), "{:?}", done.ending);
}

/// A box can be carried, and things can be put into it; then it is not carried.
#[test]
fn things_are_put_into_a_box() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = stored(&dir);
    let put = perform_and_remember(&mut engine, "Положи Книгу-4 в коробку");
    assert!(matches!(put.ending, TaskEnding::Done), "{:?}", put.ending);
    assert_eq!(support(&world_now(&engine), "Книга-4").as_deref(), Some("Коробка-1"));
    let again = perform(&engine, "Положи Книгу-4 в коробку");
    assert!(matches!(again.ending, TaskEnding::AlreadyTrue), "{:?}", again.ending);
}

/// «Ещё одну» is another of what was spoken of, «там» where the robot is sent.
#[test]
fn another_one_and_there() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    let mut memory = Memory::default();
    let mut names = |text: &str| {
        let commands = engine.understand_in(text, &mut memory).unwrap();
        let world = engine.world().unwrap();
        let name = |command: &Command<Entity>| match command {
            Command::Bring { what, .. } | Command::SwitchOff(what) | Command::Take { what } => {
                Some(world.name(what.id).to_owned())
            }
            _ => None,
        };
        commands.iter().filter_map(name).collect::<Vec<_>>()
    };
    let first = names("Принеси любую книгу со стеллажа");
    let second = names("Принеси ещё одну");
    assert!(second[0].starts_with("Книга") && second != first, "{first:?} {second:?}");
    assert_eq!(names("Поезжай в спальню и погаси там лампу"), ["Лампа-2"]);
    assert_eq!(names("Поезжай в Комнату-В и возьми чашку"), ["Чашка-1"]);
}

/// Forms of verbs that no list has, politeness inside a phrase, and what is not to be done.
#[test]
fn verbs_are_known_in_all_their_forms() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    for text in
        ["Не мог бы ты сгонять на кухню?", "Позови, пожалуйста, оператора", "Собери все чашки"]
    {
        assert!(engine.is_command(text).unwrap(), "{text}");
        assert!(engine.understand(text).is_ok(), "{text}: {:?}", engine.understand(text));
    }
    for (text, said) in [
        ("Не открывай Дверь-КY", "запретов я не запоминаю"),
        ("Please do not open Door KY", "запретов я не запоминаю"),
    ] {
        assert!(engine.is_command(text).unwrap(), "{text}");
        assert_eq!(engine.understand(text).unwrap_err().to_string(), said, "{text}");
    }
}

/// A window has no name of its own: the robot goes as near to it as it can stand, in the piece of floor that is no pocket.
#[test]
fn to_a_window_the_robot_goes_as_near_as_it_can() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    for (command, room) in [
        ("Встань у окна в Комнате-В", "Комната-В"),
        ("Go to the window in the bedroom", "Комната-Y"),
        ("Подъезжай к окну", "Комната-В"),
    ] {
        let done = perform(&engine, command);
        assert!(matches!(done.ending, TaskEnding::Done), "{command}: {:?}", done.ending);
        let found = engine.locate(done.end_map, done.end, false).unwrap();
        assert_eq!(engine.world().unwrap().name(Entity::Area(found.terms.area)), room, "{command}");
        let last = done.reports.last().expect("it drove");
        let told = last.directive_in_words(engine.world().unwrap(), Language::Russian);
        assert!(told.starts_with("подъехать к окну в Комнате-"), "{told}");
    }
}

/// «Зарядись», "go home": the places that the robot knows without their names; where there is none, that is said.
#[test]
fn the_robot_knows_its_own_places() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    for command in ["Езжай заряжаться", "Go charge yourself", "Поезжай на зарядку", "Recharge"]
    {
        let [Command::Charge] = engine.understand(command).unwrap()[..] else {
            panic!("{command}")
        };
        let done = perform(&engine, command);
        let at = done.goal.iter().map(|g| g.args.join(" ")).collect::<Vec<_>>();
        assert_eq!(at, ["Зарядка"], "{command}");
    }
    for command in ["Вернись на базу", "Go home", "Back to base"] {
        let home = perform(&engine, command);
        assert!(matches!(home.ending, TaskEnding::AlreadyTrue), "{command}: {:?}", home.ending);
    }
    let mut without = rb2();
    without.places.retain(|_, place| place.name != "Зарядка");
    let engine = Engine::in_memory(without, None).unwrap();
    let refused = engine.perform("Зарядись", &mut |_| {}).unwrap_err();
    assert_eq!(refused.to_string(), "на карте нет места для зарядки");
}

/// What is set down on the floor lies beside the robot, which can drive on.
#[test]
fn what_is_set_down_is_not_in_the_way() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = stored(&dir);
    for command in ["Поставь вазу на пол", "Теперь поставь вазу на комод"]
    {
        let done = perform_and_remember(&mut engine, command);
        assert!(matches!(done.ending, TaskEnding::Done), "{command}: {:?}", done.ending);
    }
    assert_eq!(support(&world_now(&engine), "Ваза-1").as_deref(), Some("Комод-1"));
}

/// «Рядом с вазой» is on what the vase stands on, beside it.
#[test]
fn a_thing_is_put_beside_another() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = stored(&dir);
    let done = perform_and_remember(&mut engine, "Положи красную чашку рядом с вазой");
    assert!(matches!(done.ending, TaskEnding::Done), "{:?}", done.ending);
    let world = world_now(&engine);
    assert_eq!(support(&world, "Чашка-2"), support(&world, "Ваза-1"));
    let relations = derive(&world, &RelationRules::standard(), Profile::Surveyed).unwrap();
    let near = relations.derived().tuples("NEXT_TO").unwrap();
    let beside = |t: &[&str; 2]| {
        near.clone().any(|n| n.symbol(0) == Some(t[0]) && n.symbol(1) == Some(t[1]))
    };
    assert!(beside(&["Чашка-2", "Ваза-1"]) || beside(&["Ваза-1", "Чашка-2"]));
}

/// A key in the hand opens its door as one on a table does.
#[test]
fn a_key_that_was_taken_still_fits() {
    let map = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/two-storeys.toml");
    let engine = Engine::in_memory(World::load(map).unwrap(), None).unwrap();
    let done = perform(&engine, "Возьми ключ, открой лабораторию и принеси оттуда книгу");
    assert!(matches!(done.ending, TaskEnding::Done), "{:?}", done.ending);
}

/// Each sentence, and what it comes to on the golden map: how people speak, not how lists are written.
#[test]
fn spoken_orders_are_understood_as_meant() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    let goals = |sentence: &str| match engine.perform(sentence, &mut |_| {}) {
        Ok(answer) => {
            let said =
                |g: &orthoframe_robot::GoalFact| format!("{}({})", g.predicate, g.args.join(", "));
            answer.goal.iter().map(said).collect::<Vec<_>>().join("; ")
        }
        Err(error) => error.to_string(),
    };
    let text: String = include_str!("golden/commands/spoken-rb2.txt")
        .lines()
        .filter(|line| !line.starts_with("    ") && !line.is_empty())
        .map(|line| format!("{line}\n    {}\n", goals(line)))
        .collect();
    expect_test::expect_file!["golden/commands/spoken-rb2.txt"].assert_eq(&text);
}

/// Several things are gathered one after the other: there is one hand.
#[test]
fn gathered_things_are_brought_one_by_one() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = stored(&dir);
    let put = perform_and_remember(&mut engine, "Собери все чашки и поставь их на обеденный стол");
    assert!(matches!(put.ending, TaskEnding::Done), "{:?}", put.ending);
    for cup in ["Чашка-1", "Чашка-2"] {
        assert_eq!(support(&world_now(&engine), cup).as_deref(), Some("Обеденный стол"));
    }
}

#[test]
fn told_to_report_the_robot_says_where_it_stands() {
    let engine = Engine::in_memory(rb2(), None).unwrap();
    for command in ["Доложи, где ты", "Report your position."] {
        let answer = perform(&engine, command);
        assert!(matches!(answer.ending, TaskEnding::AlreadyTrue), "{command}");
        let said = answer.reported.expect(command).say(Language::Russian);
        assert!(said.contains("в середине Комнаты-В"), "{command}: {said}");
    }
    assert!(perform(&engine, "Открой Дверь-ВZ").reported.is_none());
}
