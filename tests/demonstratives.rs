//! What points with a noun or a clause, "that stand", "the one that leads to the bedroom", "one of them": what was spoken of last,
//! over all things of a map, with what is meant told by the map alone; or it is asked back.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::question::{Answer, Thing};
use orthoframe_language::{Case, Gender, NounPhrase, Number, WordHints, english, names};
use orthoframe_map::{Entity, Replica, World};
use orthoframe_semantics::{RelationRules, derive};
use orthoframe_units::ReplicaId;

use crate::files::long;
use crate::talk::engine;

/// Maps of ours and of others.
fn maps() -> impl Iterator<Item = Engine> {
    const MAPS: [&str; 4] = [
        "../shared/data/procthor/house_3.json",
        "../shared/data/virtualhome/TestScene3_graph.json",
        "maps/rb2.toml",
        "../shared/data/rmf/office.building.yaml",
    ];
    MAPS.into_iter().take(if long() { 4 } else { 2 }).filter_map(engine)
}

fn ask(engine: &Engine, line: &str, memory: &mut Memory) -> Option<Answer> {
    engine.ask(line, memory).expect("there is a map").ok()
}

/// What the last of these lines comes to.
fn last(engine: &Engine, lines: &[&str]) -> Option<Answer> {
    let mut memory = Memory::default();
    lines.iter().map(|line| ask(engine, line, &mut memory)).last().flatten()
}

fn found(answer: &Answer) -> BTreeSet<Thing> {
    answer.things.iter().copied().collect()
}

/// A kind of which there are several, by its name in both languages.
fn kind_of(world: &World, id: ReplicaId) -> Option<(String, String)> {
    let kind = |replica: &Replica| world.objects[&replica.object].object_type;
    let own = kind(&world.replicas[&id])?;
    let several = world.replicas.values().filter(|other| kind(other) == Some(own)).count() > 1;
    let entry = world.types.object.get(Some(own)).filter(|_| several)?;
    // «ТВ-тумба» keeps its capitals.
    let is_short = entry.name.contains('-');
    let russian = if is_short { entry.name.clone() } else { entry.name.to_lowercase() };
    Some((russian, entry.name_en.to_lowercase()))
}

/// «этой тумбе»
fn this(kind: &str, case: Case) -> String {
    let phrase = NounPhrase::parse(kind, &WordHints::default());
    let word = match (phrase.gender(), case) {
        (Gender::Feminine, _) => "этой",
        (_, Case::Prepositional) => "этом",
        (_, _) => "этому",
    };
    format!("{word} {}", phrase.form(case, Number::Singular))
}

/// A thing that can be carried, and one of several alike on which or in which it lies.
fn borne(engine: &Engine) -> Vec<(ReplicaId, ReplicaId)> {
    let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
    let portable = world.replicas.keys().filter(|id| world.has_trait(**id, "portable"));
    let all: BTreeMap<ReplicaId, ReplicaId> = portable
        .filter_map(|id| Some((relations.support_of(*id)?, *id)))
        .filter(|(on, _)| kind_of(world, *on).is_some() && !world.has_trait(*on, "portable"))
        .collect();
    all.into_iter().map(|(on, thing)| (thing, on)).collect()
}

/// "What is on Stand 1? Take Watch 3. What is on that stand?": on that from which the watch is taken, whatever was spoken of
/// before; and so it is where its place was told.
#[test]
fn that_stand_is_the_one_on_which_the_thing_was() {
    let mut told = 0;
    for engine in maps() {
        let world = engine.world().unwrap();
        let pairs = borne(&engine);
        for (n, (thing, on)) in pairs.iter().enumerate() {
            let Some((russian, english)) = kind_of(world, *on) else { continue };
            let others = pairs.iter().map(|(_, other)| *other);
            let mut others = others.filter(|other| {
                other != on && kind_of(world, *other).is_some_and(|(name, _)| name == russian)
            });
            let other = others.next().unwrap_or(pairs[(n + 1) % pairs.len()].1);
            let name = |id: &ReplicaId| world.replicas[id].name_en.clone();
            let hints = names::hints(world, Entity::Replica(*thing));
            let accusative =
                NounPhrase::parse(&world.replicas[thing].name, &hints).case(Case::Accusative);
            for rel in ["on", "in"] {
                let Some(plain) = last(&engine, &[&format!("What is {rel} {}?", name(on))]) else {
                    continue;
                };
                let prep = if rel == "on" { "на" } else { "в" };
                for (order, line) in [
                    (format!("Take {}", name(thing)), format!("What is {rel} that {english}?")),
                    (
                        format!("Возьми {accusative}"),
                        format!("Что {prep} {}?", this(&russian, Case::Prepositional)),
                    ),
                ] {
                    let mut memory = Memory::default();
                    let before = format!("What is {rel} {}?", name(&other));
                    ask(&engine, &before, &mut memory);
                    if engine.understand_in(&order, &mut memory).is_err() {
                        continue;
                    }
                    let Some(answer) = ask(&engine, &line, &mut memory) else { continue };
                    assert_eq!(
                        found(&answer),
                        found(&plain),
                        "{before} {order} {line} {}",
                        answer.text
                    );
                    told += 1;
                }
                let lines = [
                    format!("Where is {}?", name(thing)),
                    format!("What is {rel} that {english}?"),
                ];
                let Some(answer) = last(&engine, &[&lines[0], &lines[1]]) else { continue };
                assert_eq!(found(&answer), found(&plain), "{lines:?} {}", answer.text);
                told += 1;
            }
        }
    }
    assert!(told > 10, "{told}");
}

/// "Is there a bowl in that cabinet?", where none of several was spoken of: in none, and in all of them least of all.
#[test]
fn that_one_of_several_is_asked_back_where_none_was_spoken_of() {
    let mut asked = 0;
    for engine in maps() {
        let world = engine.world().unwrap();
        let kinds: BTreeSet<_> =
            borne(&engine).iter().filter_map(|(_, on)| kind_of(world, *on)).collect();
        for (russian, english) in kinds {
            let (at, to) = (this(&russian, Case::Prepositional), this(&russian, Case::Dative));
            for line in [
                format!("What is on that {english}?"),
                format!("What else is in this {english}?"),
                format!("Is there anything on that {english}?"),
                format!("How many things are on that {english}?"),
                format!("Where is that {english}?"),
                format!("Is that {english} white?"),
                format!("Что ещё есть в {at}?"),
                format!("Есть ли что-нибудь на {at}?"),
                format!("Сколько вещей на {at}?"),
            ] {
                let answer = last(&engine, &[&line]);
                assert!(answer.is_none(), "{line} {answer:?}");
                asked += 1;
            }
            for order in [format!("Go to that {english}"), format!("Подъедь к {to}")] {
                let heard = engine.understand_in(&order, &mut Memory::default());
                assert!(heard.is_err(), "{order} {heard:?}");
            }
        }
    }
    assert!(asked > 20, "{asked}");
}

/// "Go to the living room. Go to that stand.": to the one there; "go to the stand" asks which.
#[test]
fn that_stand_in_an_order_is_the_one_in_the_room_that_was_spoken_of() {
    let mut heard = 0;
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        let kind = |id: ReplicaId| kind_of(world, id);
        for room in world.areas.values() {
            let first = format!("Go to {}", room.name_en);
            let here = |id: &&ReplicaId| relations.area_of(**id) == Some(room.id);
            let inside: Vec<&ReplicaId> = world.replicas.keys().filter(here).collect();
            let names: BTreeSet<_> = inside.iter().filter_map(|id| kind(**id)).collect();
            for (russian, english) in names {
                let own: Vec<_> = inside
                    .iter()
                    .filter(|id| kind(***id).is_some_and(|(name, _)| name == russian))
                    .collect();
                let order = |second: &str, first: Option<&str>| {
                    let mut memory = Memory::default();
                    if let Some(first) = first {
                        engine.understand_in(first, &mut memory).ok()?;
                    }
                    Some(format!("{:?}", engine.understand_in(second, &mut memory).ok()?))
                };
                let bare = format!("Go to the {english}");
                // A kind may have a thing that is called so.
                if order(&bare, None).is_some() {
                    continue;
                }
                assert_eq!(order(&bare, Some(&first)), None, "{first}. {bare}");
                let to = this(&russian, Case::Dative);
                for line in [
                    format!("Go to that {english}"),
                    format!("Go to the {english} there"),
                    format!("Подъедь к {to}"),
                ] {
                    let Some(told) = order(&line, Some(&first)) else { continue };
                    let [only] = own[..] else { panic!("{first}. {line} {told}") };
                    let plain = order(&format!("Go to {}", world.replicas[*only].name_en), None);
                    assert_eq!(Some(told), plain, "{first}. {line}");
                    heard += 1;
                }
            }
        }
    }
    assert!(heard > 5, "{heard}");
}

/// "Is Door 1 open? And the one that leads to the bedroom?": a door that leads there, and no room; "the other one" is not Door 1.
#[test]
fn what_leads_somewhere_is_a_door_that_leads_there() {
    let mut told = 0;
    for engine in maps() {
        let world = engine.world().unwrap();
        let relations = derive(world, &RelationRules::standard(), world.domain.profile).unwrap();
        for (id, door) in &world.doors {
            let spoken = Thing::Entity(Entity::Door(*id));
            for room in world.areas.values() {
                let symbol = names::named(world, Entity::Area(room.id));
                let joins = relations.joins();
                // What leads out of the map joins no two rooms.
                let apart = joins.iter().filter(|join| join.from != room.id && join.to != room.id);
                let apart: BTreeSet<Thing> = apart
                    .filter_map(|join| Some(Thing::Entity(Entity::Door(join.door?))))
                    .collect();
                let whither = symbol.phrase().case(Case::Accusative);
                for lines in [
                    [
                        format!("Is {} open?", door.name_en),
                        format!("And the one that leads to {}?", room.name_en),
                    ],
                    [
                        format!("Is {} open?", door.name_en),
                        format!("Is the other one that leads to {} open?", room.name_en),
                    ],
                    [format!("{} открыта?", door.name), format!("А та, что ведёт в {whither}?")],
                ] {
                    let Some(answer) = last(&engine, &[&lines[0], &lines[1]]) else { continue };
                    let doors = found(&answer);
                    let leads = !doors.is_empty() && doors.is_disjoint(&apart);
                    assert!(leads, "{lines:?} {}", answer.text);
                    let other = lines[1].contains("other");
                    assert!(
                        !other || !answer.things.contains(&spoken),
                        "{lines:?} {}",
                        answer.text
                    );
                    told += 1;
                }
            }
        }
    }
    assert!(told > 5, "{told}");
}

/// "Which rooms does the bedroom connect to? And the kitchen?": those to which the kitchen does.
#[test]
fn another_room_has_its_own_neighbours() {
    let mut told = 0;
    for engine in maps() {
        let rooms: Vec<_> = engine.world().unwrap().areas.values().collect();
        for (one, other) in rooms.iter().flat_map(|a| rooms.iter().map(move |b| (a, b))) {
            let asks = |name: &str| format!("Which rooms does {name} connect to?");
            let Some(plain) = last(&engine, &[&asks(&other.name_en)]) else { continue };
            let lines = [asks(&one.name_en), format!("And {}?", other.name_en)];
            let Some(answer) = last(&engine, &[&lines[0], &lines[1]]) else { continue };
            assert_eq!(found(&answer), found(&plain), "{lines:?} {}", answer.text);
            told += 1;
        }
    }
    assert!(told > 10, "{told}");
}

/// "Where are the tables? Is one of them in the kitchen? Is one of them in the hall?": one of all of them, each time.
#[test]
fn one_of_them_is_one_of_all_that_were_told() {
    let mut told = 0;
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        let kinds: BTreeSet<_> =
            world.replicas.keys().filter_map(|id| kind_of(world, *id)).collect();
        let rooms: Vec<_> = world.areas.values().collect();
        for (n, (_, kind)) in kinds.iter().enumerate().step_by(if long() { 1 } else { 3 }) {
            let first = format!("Where are the {}?", english::plural(kind));
            let Some(all) = last(&engine, &[&first]).filter(|all| all.things.len() > 1) else {
                continue;
            };
            let (here, there) = (rooms[n % rooms.len()], rooms[(n + 1) % rooms.len()]);
            let own = |thing: &Thing| thing.replica().and_then(|id| relations.area_of(id));
            let is_there = all.things.iter().any(|thing| own(thing) == Some(there.id));
            let lines = [here, there].map(|room| format!("Is one of them in {}?", room.name_en));
            let Some(answer) = last(&engine, &[&first, &lines[0], &lines[1]]) else { continue };
            assert_eq!(answer.is_so(), Some(is_there), "{first} {lines:?} {}", answer.text);
            told += 1;
        }
    }
    assert!(told > 5, "{told}");
}

/// "What is next to the stand in the hall? The one in the bedroom – what is on it?": on the one that is named last.
#[test]
fn what_is_named_before_a_question_is_what_it_asks_of() {
    let mut told = 0;
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        for (_, on) in borne(&engine) {
            let Some((_, english)) = kind_of(world, on) else { continue };
            let Some(room) = relations.area_of(on) else { continue };
            let room = &world.areas[&room].name_en;
            let alike = |id: &&ReplicaId| {
                **id != on && kind_of(world, **id).is_some_and(|(_, name)| name == english)
            };
            let Some(other) = world.replicas.keys().find(alike) else { continue };
            let [name, other] = [&on, other].map(|id| &world.replicas[id].name_en);
            let Some(plain) = last(&engine, &[&format!("What is on {name}?")]) else { continue };
            for lines in [
                [
                    format!("Where are the {}?", english::plural(&english)),
                    format!("What is next to {other}?"),
                    format!("The one in {room} – what is on it?"),
                ],
                [
                    format!("Where is {other}?"),
                    format!("What is next to {other}?"),
                    format!("The {english} in {room} – what is on it?"),
                ],
            ] {
                let answer = last(&engine, &[&lines[0], &lines[1], &lines[2]]);
                let Some(answer) = answer else { continue };
                assert_eq!(found(&answer), found(&plain), "{lines:?} {}", answer.text);
                told += 1;
            }
        }
    }
    assert!(told > 3, "{told}");
}
