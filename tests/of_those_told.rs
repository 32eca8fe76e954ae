//! Orders and questions about one of those that were told: a number counts them or what orders took of them, a pointing word
//! with a clause is one of them, and "there" is where they all are. What may be meant otherwise is asked back.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Mode, change_now};
use orthoframe_language::command::{Command, Relation};
use orthoframe_language::question::{Answer, Thing};
use orthoframe_language::{Case, Gender, NounPhrase, WordHints, english, names};
use orthoframe_language::{Number, question::Memory};
use orthoframe_map::{Entity, World};
use orthoframe_units::ReplicaId;

use crate::files::{long, shared};
use crate::talk::engine;

fn maps() -> Vec<Engine> {
    const MAPS: [&str; 4] = [
        "maps/rb2.toml",
        "../shared/data/procthor/house_3.json",
        "../shared/data/procthor/house_6.json",
        "../shared/data/virtualhome/TestScene3_graph.json",
    ];
    MAPS.into_iter().take(if long() { 4 } else { 3 }).filter_map(engine).collect()
}

/// Things that can be carried, by the names of their kinds.
fn carried(engine: &Engine) -> BTreeMap<(String, String), Vec<ReplicaId>> {
    let world = engine.world().unwrap();
    let mut kinds: BTreeMap<(String, String), Vec<ReplicaId>> = BTreeMap::new();
    for replica in world.replicas.values().filter(|r| world.has_trait(r.id, "portable")) {
        let kind = world.objects[&replica.object].object_type;
        let Some(kind) = world.types.object.get(kind) else { continue };
        let name = (kind.name.to_lowercase(), kind.name_en.clone());
        kinds.entry(name).or_default().push(replica.id);
    }
    kinds
}

/// What the one command of an order is done to; none where it is not understood, or asked back.
fn done_to(engine: &Engine, order: &str, memory: &mut Memory) -> Option<Entity> {
    match &engine.understand_in(order, memory).ok()?[..] {
        [command] => command.what().map(|thing| thing.id),
        _ => None,
    }
}

/// A list is told, one of it is taken: «второй» of two is the other, "the first one" that which was taken; of more, or
/// where it was taken by its name, none is chosen of those that may be meant.
#[test]
fn a_number_after_an_order_counts_what_was_taken() {
    let (mut meant, mut asked) = (0, 0);
    for engine in maps() {
        for ((russian, name), things) in carried(&engine) {
            let phrase = NounPhrase::parse(&russian, &WordHints::default());
            let all = phrase.form(Case::Nominative, Number::Plural);
            let ordinals = match phrase.gender() {
                Gender::Masculine => ["один", "первый", "второй"],
                Gender::Feminine => ["одну", "первую", "вторую"],
                Gender::Neuter => ["одно", "первое", "второе"],
            };
            let lines = [
                [format!("Where are the {}?", english::plural(&name)), "Take one of them".into()]
                    .map(|line| line)
                    .to_vec(),
                vec![format!("Где {all}?"), format!("Возьми {} из них", ordinals[0])],
            ];
            let numbers = [
                ["Take the first one".to_owned(), "Take the second one".to_owned()],
                [1, 2].map(|n| format!("Возьми {}", ordinals[n])),
            ];
            for (lines, numbers) in lines.iter().zip(&numbers) {
                let mut memory = Memory::default();
                let told = engine.ask(&lines[0], &mut memory).unwrap();
                let Ok(told) = told else { continue };
                let told: BTreeSet<Thing> = told.things.into_iter().collect();
                let own: BTreeSet<Thing> =
                    things.iter().map(|id| Thing::Entity(Entity::Replica(*id))).collect();
                let Some(taken) = done_to(&engine, &lines[1], &mut memory) else { continue };
                if told != own || told.len() < 2 {
                    continue;
                }
                for (n, number) in numbers.iter().enumerate() {
                    let found = done_to(&engine, number, &mut memory.clone());
                    let said = format!("{lines:?} {number}: {taken:?}, {found:?}");
                    match (found, told.len(), n) {
                        (None, ..) => asked += 1,
                        (Some(found), 2, 0) => assert_eq!(found, taken, "{said}"),
                        (Some(found), ..) => assert_ne!((found, n), (taken, 1), "{said}"),
                    }
                    meant += usize::from(found.is_some());
                }
            }
        }
    }
    assert!(meant > 10, "{meant} meant, {asked} asked");
}

/// "Take Pen 2. Take the first one": the first of the list, or the first that was taken?
#[test]
fn what_was_taken_by_its_name_makes_a_number_unclear() {
    let mut asked = 0;
    for engine in maps() {
        let world = engine.world().unwrap().clone();
        for ((_, name), _) in carried(&engine) {
            let mut memory = Memory::default();
            let list = format!("Where are the {}?", english::plural(&name));
            let Ok(told) = engine.ask(&list, &mut memory).unwrap() else { continue };
            let [Thing::Entity(_), Thing::Entity(second), ..] = told.things[..] else { continue };
            let order = format!("Take {}", english_name(&world, second));
            if done_to(&engine, &order, &mut memory) != Some(second) {
                continue;
            }
            let found = done_to(&engine, "Take the first one", &mut memory);
            assert_eq!(found, None, "{list} {order}");
            asked += 1;
        }
    }
    assert!(asked > 5, "{asked}");
}

fn english_name(world: &World, entity: Entity) -> String {
    match entity {
        Entity::Replica(id) => world.replicas[&id].name_en.clone(),
        other => world.name(other).to_owned(),
    }
}

fn in_case(world: &World, entity: Entity, case: Case) -> String {
    NounPhrase::parse(world.name(entity), &names::hints(world, entity)).case(case)
}

/// «Где телефоны? Положи тот, что на столе, на диван»: the one that is there, or it is asked back; never said that there is
/// none.
#[test]
fn a_pointing_word_with_a_clause_is_one_of_those_that_were_told() {
    let mut meant = 0;
    for mut engine in maps() {
        let (world, relations) = (engine.world().unwrap().clone(), engine.relations().unwrap());
        let support: BTreeMap<ReplicaId, ReplicaId> = world
            .replicas
            .keys()
            .filter_map(|id| Some((*id, relations.support_of(*id)?)))
            .collect();
        let inside: BTreeSet<ReplicaId> = support
            .iter()
            .filter(|(id, on)| relations.is_inside(**id, **on))
            .map(|(id, _)| *id)
            .collect();
        for ((russian, _), things) in carried(&engine).into_iter().filter(|(_, all)| all.len() > 1)
        {
            let phrase = NounPhrase::parse(&russian, &WordHints::default());
            let all = phrase.form(Case::Nominative, Number::Plural);
            let that = match phrase.gender() {
                Gender::Masculine => "тот",
                Gender::Feminine => "ту",
                Gender::Neuter => "то",
            };
            for thing in things.iter().filter(|id| !inside.contains(id)) {
                let Some(on) = support.get(thing) else { continue };
                let alike =
                    things.iter().filter(|id| support.get(id) == Some(on) && !inside.contains(id));
                let alike = alike.count();
                let on = in_case(&world, Entity::Replica(*on), Case::Prepositional);
                for line in [
                    format!("Возьми {that}, что на {on}."),
                    format!("Возьми {that}, которая на {on}."),
                ] {
                    let mut dialogue = Dialogue::default().keeping_nothing();
                    dialogue.hear(&mut engine, &format!("Где {all}?"), &mut |_, _| {}).unwrap();
                    let heard = dialogue.hear(&mut engine, &line, &mut |_, _| {}).unwrap();
                    let own = world.name(Entity::Replica(*thing));
                    assert!(!heard.text().contains("ничего нет"), "{line} {}", heard.text());
                    for task in heard.tasks().filter(|task| task.ending.is_done()) {
                        let taken = task.goal.iter().flat_map(|goal| &goal.args);
                        let taken: Vec<&String> = taken.collect();
                        assert!(alike == 1 && taken == [own], "{line} {taken:?}, {own}");
                        meant += 1;
                    }
                }
                if !long() && meant > 12 {
                    return;
                }
            }
        }
    }
    assert!(meant > 4, "{meant}");
}

/// «Что на столе? – Коврик и тарелка. – Положи туда яблоко»: where those lie that were told, and on none of them.
#[test]
fn there_is_where_those_lie_that_were_told() {
    let mut understood = 0;
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        let mut borne: BTreeMap<ReplicaId, Vec<ReplicaId>> = BTreeMap::new();
        for id in world.replicas.keys() {
            if let Some(on) = relations.support_of(*id) {
                borne.entry(on).or_default().push(*id);
            }
        }
        for (on, all) in borne.iter().filter(|(_, all)| all.len() > 1) {
            let other = |id: &&ReplicaId| world.has_trait(**id, "portable") && !all.contains(id);
            let Some(thing) = world.replicas.keys().find(other) else { continue };
            let (on, thing) = (Entity::Replica(*on), Entity::Replica(*thing));
            let prepositional = in_case(world, on, Case::Prepositional);
            let accusative = in_case(world, thing, Case::Accusative);
            for [asks, order] in [
                [
                    format!("What is on {}?", english_name(world, on)),
                    format!("Put {} there", english_name(world, thing)),
                ],
                [format!("Что на {prepositional}?"), format!("Положи туда {accusative}")],
                [format!("Что в {prepositional}?"), format!("Положи туда {accusative}")],
            ] {
                let mut memory = Memory::default();
                if !engine.ask(&asks, &mut memory).unwrap().is_ok_and(|told| told.things.len() > 1)
                {
                    continue;
                }
                let Ok(commands) = engine.understand_in(&order, &mut memory) else { continue };
                let [Command::Put { what, to }] = &commands[..] else {
                    panic!("{asks} {order}: {commands:?}");
                };
                assert_eq!((what.id, to.anchor), (thing, on), "{asks} {order}");
                let inside = asks.starts_with("Что в");
                assert!(!inside || to.relation == Relation::In, "{asks} {order}: {to:?}");
                understood += 1;
            }
        }
    }
    assert!(understood > 10, "{understood}");
}

/// "Put Book 1 on the desk. It should have been the dresser", «надо было на комод»; "Do the same with Plate 1".
#[test]
fn what_should_have_been_done_is_done_instead_and_the_same_with_another() {
    let engine = engine("maps/rb2.toml").expect("part of the crate");
    let order = |text: &str, memory: &mut Memory| {
        engine.understand_in(text, memory).ok().map(|commands| format!("{commands:?}"))
    };
    let mut counts = [0, 0];
    let places = ["the desk", "the dresser", "Table 1", "Bedside table 1"];
    let things = ["Book 1", "Plate 1", "the vase", "the kettle"];
    for (n, place) in places.iter().enumerate() {
        for (m, thing) in things.iter().enumerate() {
            let (other, another) = (places[(n + 1) % 4], things[(m + 1) % 4]);
            let first = format!("Put {thing} on {place}");
            let lines = [
                (format!("It should have been {other}."), format!("Put {thing} on {other}")),
                (
                    format!("Sorry, it should have been on {other}."),
                    format!("Put {thing} on {other}"),
                ),
                (format!("I got it wrong, on {other}."), format!("Put {thing} on {other}")),
                (format!("Do the same with {another}."), format!("Put {another} on {place}")),
                (
                    format!("Now the same with {another}, please."),
                    format!("Put {another} on {place}"),
                ),
            ];
            for (line, plain) in lines {
                let mut memory = Memory::default();
                order(&first, &mut memory).expect("a plain order");
                counts[0] += 1;
                let Some(whole) = engine.resumed(&line, &memory).unwrap() else { continue };
                let told = order(&whole, &mut memory);
                let meant = order(&plain, &mut Memory::default());
                assert!(told.is_none() || told == meant, "{first}. {line} {told:?}");
                counts[1] += usize::from(told.is_some());
            }
        }
    }
    assert!(counts[1] * 4 >= counts[0] * 3, "{counts:?}");
}

/// "What is in the coe room?", where coe is a point alone in its room: as "in coe".
#[test]
fn a_room_is_called_after_the_one_point_in_it() {
    let Some(path) = shared("rmf/office.building.yaml") else { return };
    let engine = engine(path.to_str().unwrap()).expect("it is there");
    let world = engine.world().unwrap();
    let mut asked = 0;
    for place in world.places.values() {
        let alone = world.places.values().filter(|other| other.area == place.area).count() == 1;
        let name = place.name_en.clone();
        for (lines, plain) in [
            (["What is in the {} room?", "What is in {} room?"], "What is in {}?"),
            (
                ["How many chairs are in the {} room?", "How many chairs are in {} room?"],
                "How many chairs are in {}?",
            ),
            (["Что в комнате {}?", "Что находится в помещении {}?"], "Что в {}?"),
        ] {
            let whole = engine.ask(&plain.replace("{}", &name), &mut Memory::default()).unwrap();
            for line in lines {
                let line = line.replace("{}", &name);
                let told = engine.ask(&line, &mut Memory::default()).unwrap();
                let Ok(told) = told else { continue };
                let whole = whole.as_ref().unwrap_or_else(|_| panic!("{line} {}", told.text));
                assert_eq!(told.things, whole.things, "{line} {}", told.text);
                asked += usize::from(alone);
            }
        }
    }
    assert!(asked > 3, "{asked}");
}

/// "Put all the pencils on the dresser": each that lies on it or in it already is told of, and the others lie there then.
#[test]
fn what_lies_there_already_is_told_of() {
    let Some(path) = shared("procthor/house_7.json") else { return };
    let dir = tempfile::tempdir().unwrap();
    let mut engine = Engine::open(dir.path(), None).unwrap();
    let change = change_now("test", "");
    engine.import(&path, &change).unwrap();
    engine.edit_world(&change, Mode::Commit, |_| ()).unwrap();
    let world = engine.world().unwrap().clone();
    let mut done = 0;
    for ((_, name), things) in carried(&engine) {
        let relations = engine.relations().unwrap();
        let at = |id: &ReplicaId| relations.support_of(*id);
        let Some(on) = things.iter().find_map(at).filter(|_| things.len() > 1) else { continue };
        let there: Vec<&ReplicaId> = things.iter().filter(|id| at(id) == Some(on)).collect();
        if there.len() == things.len() || !long() && done > 1 {
            continue;
        }
        let line =
            format!("Put all the {} on {}.", english::plural(&name), world.replicas[&on].name_en);
        let mut dialogue = Dialogue::default().keeping_nothing();
        let heard = dialogue.hear(&mut engine, &line, &mut |_, _| {}).unwrap();
        if !heard.tasks().any(|task| task.ending.is_done()) {
            continue;
        }
        for id in there {
            let name = &world.replicas[id].name_en;
            assert!(heard.text().contains(name.as_str()), "{line} {name}: {}", heard.text());
        }
        done += 1;
    }
    assert!(done > 0);
}

/// A question or two, and what the last comes to.
fn told(engine: &Engine, lines: &[&str], memory: &mut Memory) -> Option<Answer> {
    let answers = lines.iter().map(|line| engine.ask(line, memory).expect("there is a map").ok());
    answers.last().flatten()
}

/// «Где тарелки? А вторая на чём?», "Where is the second of them?": as of the second by its name, and «второй» is no plate.
#[test]
fn a_number_stands_for_a_name_and_has_its_gender() {
    let (mut meant, mut refused) = (0, 0);
    for engine in maps() {
        let world = engine.world().unwrap();
        for (russian, name) in carried(&engine).into_keys() {
            let phrase = NounPhrase::parse(&russian, &WordHints::default());
            let plural = phrase.form(Case::Nominative, Number::Plural);
            let where_all =
                [format!("Where are the {}?", english::plural(&name)), format!("Где {plural}?")];
            let mut memory = Memory::default();
            let Some(all) = told(&engine, &[&where_all[0]], &mut memory) else { continue };
            let [_, Thing::Entity(second), ..] = all.things[..] else { continue };
            let (english, russian) = (english_name(world, second), world.name(second));
            for (said, named) in [
                ("Where is the second of them?", format!("Where is {english}?")),
                ("What is the second one on?", format!("What is {english} on?")),
                ("How wide is the second of those?", format!("How wide is {english}?")),
            ] {
                let of_number = told(&engine, &[&where_all[0], said], &mut Memory::default());
                let of_name = told(&engine, &[&named], &mut Memory::default());
                let text = |answer: Option<Answer>| answer.map(|answer| answer.text);
                let (of_number, of_name) = (text(of_number), text(of_name));
                assert_eq!(of_number, of_name, "{} {said}", where_all[0]);
                meant += usize::from(of_number.is_some());
            }
            let mut memory = Memory::default();
            let all = told(&engine, &[&where_all[1]], &mut memory);
            // A watch is «вторые».
            if phrase.number() == Number::Plural
                || all.is_none_or(|all| all.things.get(1) != Some(&Thing::Entity(second)))
            {
                continue;
            }
            let own = phrase.gender();
            for (ordinal, object, gender) in [
                ("второй", None, Gender::Masculine),
                ("вторая", Some("вторую"), Gender::Feminine),
                ("второе", Some("второе"), Gender::Neuter),
            ] {
                let line = format!("А {ordinal} на чём лежит?");
                let of_number = told(&engine, &[&line], &mut memory.clone());
                let named = format!("А {russian} на чём лежит?");
                let of_name = told(&engine, &[&named], &mut memory.clone());
                match (gender == own, of_number) {
                    (true, of_number) => {
                        let text = |answer: Option<Answer>| answer.map(|answer| answer.text);
                        assert_eq!(text(of_number), text(of_name), "{} {line}", where_all[1]);
                        meant += 1;
                    }
                    // «второй» may be said of her as well: «у второй».
                    (false, Some(answer)) => {
                        assert_eq!(ordinal, "второй", "{} {line} {}", where_all[1], answer.text);
                    }
                    (false, None) => refused += 1,
                }
                let Some(object) = object else { continue };
                let taken = done_to(&engine, &format!("Возьми {object}"), &mut memory.clone());
                let right = (gender == own).then_some(second);
                assert_eq!(taken, right, "{} Возьми {object}", where_all[1]);
            }
        }
    }
    assert!(meant > 20 && refused > 10, "{meant} meant, {refused} refused");
}

/// "Where are the plates? How many of them are on Table 1? And where are the others?": the others of those that were told.
#[test]
fn the_others_are_the_rest_of_those_of_which_it_was_asked() {
    let mut met = 0;
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        for ((russian, name), things) in carried(&engine) {
            let phrase = NounPhrase::parse(&russian, &WordHints::default());
            let plural = phrase.form(Case::Nominative, Number::Plural);
            let Some(on) = things.iter().find_map(|id| relations.support_of(*id)) else { continue };
            let on = Entity::Replica(on);
            let place = in_case(world, on, Case::Prepositional);
            for lines in [
                [
                    format!("Where are the {}?", english::plural(&name)),
                    format!("How many of them are on {}?", english_name(world, on)),
                    "And where are the others?".to_owned(),
                ],
                [
                    format!("Где {plural}?"),
                    format!("Сколько из них на {place}?"),
                    "А остальные где?".to_owned(),
                ],
            ] {
                let mut memory = Memory::default();
                let found = lines.each_ref().map(|line| {
                    let answer = told(&engine, &[line], &mut memory);
                    answer.map(|a| a.things.into_iter().collect::<BTreeSet<Thing>>())
                });
                let [Some(all), Some(some), rest] = found else { continue };
                let left: BTreeSet<Thing> = all.difference(&some).copied().collect();
                if some.is_empty() || left.is_empty() || !some.is_subset(&all) {
                    continue;
                }
                assert!(rest.as_ref().is_none_or(|rest| *rest == left), "{lines:?} {rest:?}");
                met += usize::from(rest.is_some());
            }
        }
    }
    assert!(met > 5, "{met}");
}

/// «Включи телевизор. Где лампа? Выключи обратно»: the television; after an order of another sort nothing is.
#[test]
fn back_is_what_the_order_before_has_done() {
    let mut met = 0;
    for engine in maps() {
        let world = engine.world().unwrap();
        let devices = world.replicas.keys().copied().filter(|id| world.has_trait(*id, "device"));
        let devices: Vec<Entity> = devices.map(Entity::Replica).collect();
        let carried = world.replicas.keys().copied().find(|id| world.has_trait(*id, "portable"));
        let Some(carried) = carried.map(Entity::Replica) else { continue };
        for (n, one) in devices.iter().enumerate() {
            let other = devices[(n + 1) % devices.len()];
            if other == *one {
                continue;
            }
            let mut memory = Memory::default();
            let switched = format!("Включи {}", in_case(world, *one, Case::Accusative));
            if done_to(&engine, &switched, &mut memory) != Some(*one) {
                continue;
            }
            let asked = format!("Где {}?", world.name(other));
            told(&engine, &[&asked], &mut memory);
            for line in ["Выключи обратно", "Ладно, выключай обратно."]
            {
                let back = done_to(&engine, line, &mut memory.clone());
                assert_eq!(back, Some(*one), "{switched} {asked} {line}");
            }
            let taken = format!("Возьми {}", in_case(world, carried, Case::Accusative));
            done_to(&engine, &taken, &mut memory);
            let back = done_to(&engine, "Выключи обратно", &mut memory);
            assert_eq!(back, None, "{switched} {taken}");
            met += 1;
        }
    }
    assert!(met > 4, "{met}");
}

/// «Где тарелки? А та, что на столе?»: the plate there, and no plate is «тот». "Where are the plates? Only those on the table."
#[test]
fn what_points_with_a_clause_asks_the_same_of_what_is_there() {
    let (mut met, mut refused) = (0, 0);
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        for ((russian, name), things) in carried(&engine) {
            let phrase = NounPhrase::parse(&russian, &WordHints::default());
            let plural = phrase.form(Case::Nominative, Number::Plural);
            let on = |id: &ReplicaId| {
                relations.support_of(*id).filter(|on| !relations.is_inside(*id, *on))
            };
            let Some(place) = things.iter().find_map(on).filter(|_| things.len() > 1) else {
                continue;
            };
            let there = things.iter().filter(|id| on(id) == Some(place));
            let there: BTreeSet<Thing> =
                there.map(|id| Thing::Entity(Entity::Replica(*id))).collect();
            let place = Entity::Replica(place);
            let prepositional = in_case(world, place, Case::Prepositional);
            let opening = format!("Где {plural}?");
            for (that, gender) in
                [("тот", Gender::Masculine), ("та", Gender::Feminine), ("то", Gender::Neuter)]
            {
                let line = format!("А {that}, что на {prepositional}?");
                let answer = told(&engine, &[&opening, &line], &mut Memory::default());
                let Some(answer) = answer else {
                    refused += usize::from(gender != phrase.gender());
                    continue;
                };
                let found: BTreeSet<Thing> = answer.things.into_iter().collect();
                assert_eq!((gender, &found), (phrase.gender(), &there), "{opening} {line}");
                met += 1;
            }
            let opening = format!("Where are the {}?", english::plural(&name));
            let line = format!("Only those on {}.", english_name(world, place));
            let answer = told(&engine, &[&opening, &line], &mut Memory::default());
            if let Some(answer) = answer {
                let found: BTreeSet<Thing> = answer.things.into_iter().collect();
                assert_eq!(found, there, "{opening} {line}");
                met += 1;
            }
        }
    }
    assert!(met > 5 && refused > 10, "{met} {refused}");
}

/// "How far is it from one to the other?" of two that were told is how far the two are apart, or is not understood.
#[test]
fn from_one_to_the_other_is_between_the_two() {
    let mut measured = 0;
    for engine in maps() {
        let world = engine.world().unwrap();
        for (russian, name) in carried(&engine).into_keys() {
            let plural = NounPhrase::parse(&russian, &WordHints::default())
                .form(Case::Nominative, Number::Plural);
            let english = format!("Where are the {}?", english::plural(&name));
            let lines = [
                (english, "How far is it from one to the other?"),
                (format!("Где {plural}?"), "Сколько от одной до другой?"),
            ];
            for (opening, line) in lines {
                let mut memory = Memory::default();
                let Some(all) = told(&engine, &[&opening], &mut memory) else { continue };
                let [Thing::Entity(one), Thing::Entity(other)] = all.things[..] else { continue };
                let Some(apart) = told(&engine, &[line], &mut memory) else { continue };
                let named = match opening.is_ascii() {
                    true => format!(
                        "How far is it from {} to {}?",
                        english_name(world, one),
                        english_name(world, other)
                    ),
                    false => {
                        format!("Расстояние между {} и {}", world.name(one), world.name(other))
                    }
                };
                let plain = told(&engine, &[&named], &mut Memory::default());
                assert!(apart.number.is_some_and(|cm| cm > 0.0), "{opening} {line} {}", apart.text);
                if let Some(plain) = plain.filter(|_| opening.is_ascii()) {
                    assert_eq!(apart.number, plain.number, "{opening} {line} {}", apart.text);
                    measured += 1;
                }
            }
        }
    }
    assert!(measured > 0, "nothing was measured");
}
