//! Questions that correct themselves while they are asked, over the things of whole maps: they mean what was put instead, or
//! they are not understood; what was taken back is neither asked nor denied.

use std::collections::BTreeMap;

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Memory, Outcome};
use orthoframe_language::{Case, NounPhrase, names};
use orthoframe_map::{Entity, World};
use orthoframe_units::ReplicaId;

use crate::files::long;
use crate::talk::engine;

const MAPS: [&str; 3] = [
    "../shared/data/procthor/house_2.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
    "../shared/data/procthor/house_7.json",
];

fn answer(engine: &Engine, line: &str) -> Option<String> {
    let answered = engine.ask(line, &mut Memory::default()).expect("there is a map");
    Some(plainly(&answered.ok()?.text).to_owned())
}

/// What is answered, without what was understood before it.
fn plainly(text: &str) -> &str {
    let understood = ["Understood as “", "Понял так: «"].iter().any(|lead| text.starts_with(lead));
    let rest = text.split_once(['”', '»']).map(|(_, rest)| rest.trim());
    rest.filter(|_| understood).unwrap_or(text)
}

fn form(world: &World, id: ReplicaId, case: Case) -> String {
    let entity = Entity::Replica(id);
    NounPhrase::parse(world.name(entity), &names::hints(world, entity)).case(case)
}

/// What each thing of a map bears, of as many as a run tries.
fn bearers(engine: &Engine) -> Vec<ReplicaId> {
    let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
    let mut borne: BTreeMap<ReplicaId, usize> = BTreeMap::new();
    for id in world.replicas.keys() {
        if let Some(on) = relations.support_of(*id) {
            *borne.entry(on).or_default() += 1;
        }
    }
    let named = borne.into_keys().filter(|id| !world.replicas[id].name_en.is_empty());
    named.take(if long() { 12 } else { 5 }).collect()
}

const ENGLISH: [&str; 7] =
    [", no, ", ", no wait, ", ", sorry, ", ", I mean ", ", or rather ", "... oops, ", " – no, "];
const RUSSIAN: [&str; 7] =
    [", нет, ", ", ой, ", ", тьфу, ", ", то есть ", ", вернее, ", "... ой, нет, ", " – точнее, "];

/// Counts the lines that were answered; each of them as the plain question is.
fn compare(engine: &Engine, line: &str, plain: Option<&String>, heard: &mut [usize; 2]) {
    match answer(engine, line) {
        Some(said) => {
            assert_eq!(Some(&said), plain, "{line}");
            heard[0] += 1;
        }
        None => heard[1] += 1,
    }
}

#[test]
fn a_place_put_right_is_the_place_that_is_meant() {
    for engine in MAPS.into_iter().take(if long() { 3 } else { 2 }).filter_map(engine) {
        let world = engine.world().unwrap();
        let mut heard = [0, 0];
        for pair in bearers(&engine).windows(2) {
            let &[first, second] = pair else { continue };
            let (one, other) = (&world.replicas[&first].name_en, &world.replicas[&second].name_en);
            let plain = answer(&engine, &format!("What is on {other}?"));
            for term in ENGLISH {
                let line = format!("What is on {one}{term}on {other}?");
                compare(&engine, &line, plain.as_ref(), &mut heard);
            }
            let case = |id| form(world, id, Case::Prepositional);
            let plain = answer(&engine, &format!("Что лежит на {}?", case(second)));
            for term in RUSSIAN {
                let line = format!("Что лежит на {}{term}на {}?", case(first), case(second));
                compare(&engine, &line, plain.as_ref(), &mut heard);
            }
        }
        assert!(heard[0] > 9 * heard[1] && heard[0] > 20, "{heard:?}");
    }
}

#[test]
fn a_thing_put_right_is_the_thing_that_is_meant() {
    for engine in MAPS.into_iter().take(if long() { 3 } else { 2 }).filter_map(engine) {
        let world = engine.world().unwrap();
        let mut heard = [0, 0];
        let portable = world.replicas.values().filter(|r| world.has_trait(r.id, "portable"));
        let all: Vec<_> = portable.step_by(7).take(if long() { 20 } else { 6 }).collect();
        for pair in all.windows(2) {
            let [one, other] = pair else { continue };
            let plain = answer(&engine, &format!("Where is {}?", other.name_en));
            for term in ENGLISH {
                let line = format!("Where is {}{term}{}?", one.name_en, other.name_en);
                compare(&engine, &line, plain.as_ref(), &mut heard);
            }
            let plain = answer(&engine, &format!("Где {}?", other.name));
            for term in RUSSIAN {
                let line = format!("Где {}{term}{}?", one.name, other.name);
                compare(&engine, &line, plain.as_ref(), &mut heard);
            }
        }
        assert!(heard[0] > 4 * heard[1] && heard[0] > 20, "{heard:?}");
    }
}

/// Which of two things is taken back, or what is asked of the second, nothing says.
#[test]
fn what_may_stand_for_several_stands_for_none() {
    let Some(engine) = engine(MAPS[0]) else { return };
    let world = engine.world().unwrap();
    let all = bearers(&engine);
    let [one, other, third] = [0, 1, 2].map(|n| &world.replicas[&all[n]].name_en);
    for line in [
        format!("Is {one} next to {other}, sorry, {third}?"),
        format!("What is between {one} and {other}, no, {third}?"),
        format!("How many things are on {one}, no wait, how many chairs?"),
    ] {
        assert_eq!(answer(&engine, &line), None, "{line}");
    }
}

/// An order with a part that is not understood waits for a yes, and is then done as it was said.
#[test]
fn an_order_beside_what_is_not_understood_waits_for_a_yes() {
    let pairs = [
        ("Go to Room-Y", "I'm starving"),
        ("Bring the umbrella", "I am exhausted"),
        ("Поезжай в Комнату-Y", "я забыла"),
        ("Принеси зонт", "кино начинается"),
    ];
    let yes = |russian: bool| if russian { "да" } else { "yes" };
    for (order, beside) in pairs {
        for line in [format!("{order}, {beside}"), format!("{order}. {beside}")] {
            let mut engine = Engine::in_memory(crate::worlds::rb2(), None).unwrap();
            let mut dialogue = Dialogue::default();
            let mut hear =
                |said: &str| dialogue.hear(&mut engine, said, &mut |_, _| {}).expect("a map");
            let heard = hear(&line);
            assert_eq!(heard.tasks().count(), 0, "{line}: {}", heard.text());
            let [reply] = &heard.replies[..] else { panic!("{line}: {}", heard.text()) };
            assert!(matches!(reply.outcome, Outcome::Offered { .. }), "{line}: {}", heard.text());
            assert!(reply.text.contains(beside) && reply.text.contains(order), "{}", reply.text);
            let done = hear(yes(order.starts_with(|c: char| !c.is_ascii())));
            assert!(done.tasks().all(|task| task.ending.is_done()), "{line}: {}", done.text());
            assert_eq!(done.tasks().count(), 1, "{line}: {}", done.text());
        }
    }
}

/// A question behind what is not understood is answered or waits for a yes, and means then what it does alone.
#[test]
fn a_question_beside_what_is_not_understood_waits_for_a_yes() {
    let Some(mut engine) = engine(MAPS[0]) else { return };
    let before_en = [
        "My cousin vexingly mislaid her flugel and is coming so I gotta know",
        "Sorry to bug you but the snarp wants it,",
        "Rent's due and the agent's here.",
    ];
    let before_ru = [
        "Хозяйка звонила, ей нужно знать",
        "Начальник велел хурмить, прикинь.",
        "Сестра приедет с хорьком, так что надо понять:",
    ];
    let mut lines = Vec::new();
    for id in bearers(&engine) {
        let world = engine.world().unwrap();
        let (english, russian) = (&world.replicas[&id].name_en, form(world, id, Case::Nominative));
        lines.extend(before_en.map(|told| (told, format!("where is {english}?"), "yes")));
        lines.extend(before_ru.map(|told| (told, format!("где {russian}?"), "да")));
    }
    let mut asked = 0;
    for (told, question, yes) in lines {
        let Some(plain) = answer(&engine, &question) else { continue };
        let mut dialogue = Dialogue::default();
        let mut hear =
            |said: &str| dialogue.hear(&mut engine, said, &mut |_, _| {}).expect("a map").text();
        let line = format!("{told} {question}");
        let said = hear(&line);
        asked += 1;
        if plainly(&said) != plain {
            let (_, offered) = question.trim_end_matches('?').split_once(' ').unwrap();
            assert!(said.contains(offered), "{line}: {said}");
            assert_eq!(plainly(&hear(yes)), plain, "{line}: {said}");
        }
    }
    assert!(asked > 10, "{asked}");
}

/// A slip of the pen in every word of a question is mended, or the question as it may be meant waits for a yes.
#[test]
fn slips_in_several_words_wait_for_a_yes() {
    let Some(mut engine) = engine("../shared/data/procthor/house_3.json") else { return };
    for (typed, meant) in [
        (
            "how mnay chiars are round the dining tabel in the living room?",
            "How many chairs are round the dining table in the living room",
        ),
        ("which room is teh bigest?", "which room is the biggest"),
    ] {
        let plain = answer(&engine, meant).expect(meant);
        let mut dialogue = Dialogue::default();
        let mut hear =
            |said: &str| dialogue.hear(&mut engine, said, &mut |_, _| {}).expect("a map").text();
        let said = hear(typed);
        let told = if plainly(&said) == plain { said } else { hear("yes") };
        assert_eq!(plainly(&told), plain, "{typed}");
    }
}
