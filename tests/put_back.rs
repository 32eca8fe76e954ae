//! What is said of all that lies somewhere: put back, taken off, cleared away, in as many orders as there are things; and
//! where it then is.

use orthoframe::Engine;
use orthoframe::engine::{Change, Dialogue, Memory, Outcome, Timestamp};
use orthoframe_language::Language;

use crate::files::shared;

const HOUSES: [&str; 2] = ["procthor/house_9.json", "procthor/house_1.json"];

/// A house in a store, which keeps what orders have moved; none where the file is not there.
pub(crate) fn engine(house: &str) -> Option<(tempfile::TempDir, Engine)> {
    let path = shared(house)?;
    let dir = tempfile::tempdir().unwrap();
    let mut engine = Engine::open(dir.path(), None).expect("a new store");
    let change = Change::new("Мастер", Timestamp(1_790_000_000_000), "");
    engine.import(&path, &change).expect("the house reads");
    Some((dir, engine))
}

fn where_is(engine: &Engine, thing: &str) -> String {
    let asked = engine.ask(&format!("Where is {thing}?"), &mut Memory::default());
    let told = asked.expect("there is a map").expect("it is known").text;
    // "I am not sure where …: …"
    told.rsplit(": ").next().unwrap_or_default().to_owned()
}

fn hear(engine: &mut Engine, dialogue: &mut Dialogue, line: &str) -> bool {
    let heard = dialogue.hear(engine, line, &mut |_, _| {}).expect("there is a map");
    heard.tasks().next().is_some() && !heard.replies.iter().any(|r| r.outcome.has_failed())
}

/// A thing that bears several others, their names, and another thing on which all of them find room.
fn laden(engine: &Engine) -> Vec<(String, Vec<String>)> {
    let world = engine.world().unwrap();
    let called = |name: &str| {
        world.replicas.values().find(|r| r.name == name).map(|r| r.name_en.clone()).unwrap()
    };
    let supports = world.replicas.values().filter(|thing| !world.has_trait(thing.id, "portable"));
    let mut laden: Vec<(String, Vec<String>)> = supports
        .filter_map(|support| {
            let question = format!("What is on {}?", support.name_en);
            let told = engine.ask(&question, &mut Memory::default()).ok()?.ok()?;
            let on: Vec<String> = told.symbols.iter().map(|name| called(name)).collect();
            (on.len() > 1).then(|| (support.name_en.clone(), on))
        })
        .collect();
    laden.sort();
    laden
}

/// «Верни всё на место» puts back each thing that the dialogue has moved, not the last alone.
#[test]
fn all_that_was_moved_is_put_back() {
    let mut put_back = 0;
    for (house, line) in HOUSES.into_iter().zip(["Верни всё на место", "Put everything back"])
    {
        let Some((_dir, mut engine)) = engine(house) else { return };
        let mut dialogue = Dialogue::new(Language::English);
        let mut moved = Vec::new();
        for (_, things) in laden(&engine).into_iter().take(2) {
            for thing in things.into_iter().take(2) {
                let before = where_is(&engine, &thing);
                if hear(&mut engine, &mut dialogue, &format!("Put {thing} on Bed 1")) {
                    moved.push((thing, before));
                }
            }
        }
        let told = dialogue.hear(&mut engine, line, &mut |_, _| {}).unwrap().text();
        for (thing, before) in &moved {
            let is_back = where_is(&engine, thing) == *before;
            // What is out of reach, say, is told to be so.
            assert!(is_back || told.contains(thing), "{line}: {thing}: {told}");
            put_back += usize::from(is_back);
        }
    }
    assert!(put_back > 4, "{put_back}");
}

/// What has no place, and was moved, is named: not everything is in its place.
#[test]
fn what_has_no_place_is_not_passed_over() {
    let Some((_dir, mut engine)) = engine(HOUSES[0]) else { return };
    let mut dialogue = Dialogue::new(Language::English);
    assert!(hear(&mut engine, &mut dialogue, "Put Ball 1 on Bed 1"));
    for line in ["Put everything back", "Tidy up", "Tidy the bedroom"] {
        let told = dialogue.hear(&mut engine, line, &mut |_, _| {}).unwrap().text();
        assert!(told.contains("Ball 1") && !told.contains("Everything is in"), "{line}: {told}");
    }
}

/// "Take everything off the sofa": onto what? The next line says it, and all of it goes there.
#[test]
fn what_is_taken_off_goes_where_the_next_line_says() {
    let orders = [
        ("Take everything off {}", "on Bed 1"),
        ("Take everything off {}", "Put it on Bed 1"),
        ("Take everything off {}", "Put them on Bed 1, please"),
        ("Clear {}", "Onto Bed 1"),
        ("Сними всё с {}", "На Кровать-1"),
        ("Take everything off {} and put it on Bed 1", ""),
        ("Clear {} onto Bed 1", ""),
    ];
    let mut moved = 0;
    for (order, reply) in orders {
        let Some((_dir, mut engine)) = engine(HOUSES[0]) else { return };
        let support = laden(&engine).into_iter().find(|(name, _)| name == "Sofa 1");
        let (support, things) = support.expect("it bears several");
        let russian = Language::of(order) == Language::Russian;
        let called = if russian { "Дивана-1" } else { &support };
        let mut dialogue = Dialogue::new(Language::English);
        let order = order.replace("{}", called);
        let done = hear(&mut engine, &mut dialogue, &order);
        assert_eq!(done, reply.is_empty(), "{order}");
        if !reply.is_empty() {
            for thing in &things {
                assert!(where_is(&engine, thing).contains(&support), "{order}: {thing} was moved");
            }
            assert!(hear(&mut engine, &mut dialogue, reply), "{order} {reply}");
        }
        for thing in &things {
            let at = where_is(&engine, thing);
            assert!(at.contains("on Bed 1"), "{order} {reply}: {at}");
            moved += 1;
        }
    }
    assert!(moved > 14, "{moved}");
}

/// A place alone completes only the order just before it; else it is what it always was.
#[test]
fn a_place_completes_only_the_order_before_it() {
    let Some((_dir, mut engine)) = engine(HOUSES[0]) else { return };
    let mut dialogue = Dialogue::new(Language::English);
    let at = where_is(&engine, "Bowl 2");
    hear(&mut engine, &mut dialogue, "Положи Миску-2");
    hear(&mut engine, &mut dialogue, "Где Телефон-1?");
    hear(&mut engine, &mut dialogue, "На диван");
    assert_eq!(where_is(&engine, "Bowl 2"), at);
    hear(&mut engine, &mut dialogue, "Положи Миску-2");
    let heard = dialogue.hear(&mut engine, "На диван", &mut |_, _| {}).unwrap();
    assert!(heard.replies.iter().any(|reply| matches!(&reply.outcome, Outcome::Task(_))));
    assert!(where_is(&engine, "Bowl 2").contains("Sofa 1"));
}

/// "How many are there now?" is of the place that was counted, not of what the robot has taken from it since; and what a full
/// hand hinders is told.
#[test]
fn what_was_counted_is_counted_anew_and_a_full_hand_takes_nothing() {
    let lines = [
        ("How many things are on Sofa 1?", "Take Book 2", "How many are there now?"),
        ("Сколько вещей на Диване-1?", "Возьми Книгу-2", "Сколько их там теперь?"),
    ];
    for (counted, order, anew) in lines {
        let Some((_dir, mut engine)) = engine(HOUSES[0]) else { return };
        let mut dialogue = Dialogue::new(Language::English);
        let number = |engine: &mut Engine, dialogue: &mut Dialogue, line: &str| {
            let reply = dialogue.ask(engine, line).expect("there is a map");
            match reply.outcome {
                Outcome::Answered(answer) => answer.number,
                _ => None,
            }
        };
        let before = number(&mut engine, &mut dialogue, counted);
        assert!(hear(&mut engine, &mut dialogue, order), "{order}");
        let after = number(&mut engine, &mut dialogue, anew);
        assert_eq!(before.map(|n| n - 1.0), after, "{anew}");
        for why in ["Why can't you take Apple 1?", "Почему ты не можешь взять Яблоко-1?"]
        {
            let told = dialogue.ask(&engine, why).expect("there is a map").text;
            assert!(told.contains("Book 2") || told.contains("Книга-2"), "{told}");
        }
    }
}
