//! "On any of them", «у каждого из них», "both", "which of them has more …": what is asked of several that were told is what the
//! same question comes to of each of them by its name, over the things of whole maps; or it is not understood.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Memory};
use orthoframe_language::question::{Answer, Said, Thing};
use orthoframe_language::{Case, Gender, NounPhrase, Number, WordHints, english, names};
use orthoframe_map::{Entity, World};
use orthoframe_units::{ReplicaId, TypeId};

use crate::files::long;
use crate::talk::engine;

fn maps() -> impl Iterator<Item = Engine> {
    const MAPS: [&str; 4] = [
        "../shared/data/procthor/house_3.json",
        "../shared/data/virtualhome/TestScene1_graph.json",
        "../shared/data/procthor/house_6.json",
        "maps/rb2.toml",
    ];
    MAPS.into_iter().take(if long() { 4 } else { 2 }).filter_map(engine)
}

fn ask(engine: &Engine, line: &str, memory: &mut Memory) -> Option<Answer> {
    engine.ask(line, memory).expect("there is a map").ok()
}

fn plainly(engine: &Engine, line: &str) -> Option<Answer> {
    ask(engine, line, &mut Memory::default())
}

fn replica(id: ReplicaId) -> Thing {
    Thing::Entity(Entity::Replica(id))
}

fn form(world: &World, id: ReplicaId, case: Case) -> String {
    let entity = Entity::Replica(id);
    NounPhrase::parse(world.name(entity), &names::hints(world, entity)).case(case)
}

/// The things of each type, by its names in both languages.
fn by_kind(world: &World) -> BTreeMap<(String, String), Vec<ReplicaId>> {
    let mut types: BTreeMap<TypeId, Vec<ReplicaId>> = BTreeMap::new();
    for thing in world.replicas.values() {
        if let Some(kind) = world.objects[&thing.object].object_type {
            types.entry(kind).or_default().push(thing.id);
        }
    }
    let named = types.into_iter().filter_map(|(kind, all)| {
        let entry = world.types.object.get(Some(kind))?;
        // «ТВ-тумба» keeps its capitals.
        let russian =
            if entry.name.contains('-') { entry.name.clone() } else { entry.name.to_lowercase() };
        (!entry.name_en.is_empty()).then(|| ((russian, entry.name_en.to_lowercase()), all))
    });
    named.collect()
}

fn many(russian: &str, case: Case) -> String {
    NounPhrase::parse(russian, &WordHints::default()).form(case, Number::Plural)
}

/// What is asked of several, for each way to say so: the words before, the words behind and what they share.
const ENGLISH: [(&str, &str); 6] = [
    ("any of them", "any"),
    ("one of them", "any"),
    ("at least one of them", "any"),
    ("each of them", "each"),
    ("both of them", "both"),
    ("either of them", "either"),
];

/// Ways to say so, each with what it shares.
type Ways = &'static [(&'static str, &'static str)];

/// The same as the Russian prepositions take them.
const RUSSIAN: [(Case, &str, Ways); 3] = [
    (
        Case::Prepositional,
        "на",
        &[
            ("на каком-нибудь из них", "any"),
            ("хоть на одном из них", "any"),
            ("на каждом из них", "each"),
            ("на обоих", "both"),
        ],
    ),
    (
        Case::Instrumental,
        "рядом с",
        &[("хотя бы рядом с одним из них", "any"), ("рядом с каждым из них", "each")],
    ),
    (
        Case::Genitive,
        "у",
        &[
            ("у какого-нибудь из них", "any"),
            ("хоть у одного из них", "any"),
            ("у каждого из них", "each"),
        ],
    ),
];

/// «на каждой из них» of what is feminine.
fn agreeing(words: &str, gender: Gender) -> String {
    if gender != Gender::Feminine {
        return words.to_owned();
    }
    let forms = [
        ("каком-", "какой-"),
        ("какого-", "какой-"),
        ("одном ", "одной "),
        ("одним ", "одной "),
        ("одного ", "одной "),
        ("каждом ", "каждой "),
        ("каждым ", "каждой "),
        ("каждого ", "каждой "),
        ("обоих", "обеих"),
    ];
    forms.iter().fold(words.to_owned(), |said, (one, other)| said.replace(one, other))
}

/// What all of the plain questions come to, where each is answered by yes or no.
fn of_all(engine: &Engine, questions: &[String], share: &str) -> Option<bool> {
    let each: Option<Vec<bool>> = questions
        .iter()
        .map(|question| match plainly(engine, question)?.said {
            Said::Yes => Some(true),
            Said::No => Some(false),
            _ => None,
        })
        .collect();
    let each = each?;
    Some(match share {
        "any" | "either" => each.iter().any(|so| *so),
        _ => each.iter().all(|so| *so),
    })
}

#[test]
fn some_or_each_of_them_are_those_that_were_told() {
    let (mut heard, mut yes, mut refused) = (0, 0, 0);
    for engine in maps() {
        let world = engine.world().unwrap();
        let kinds = by_kind(world);
        let told = kinds.iter().filter(|(_, all)| (2..6).contains(&all.len()));
        for (n, ((russian, name), all)) in told.enumerate().take(if long() { 30 } else { 5 }) {
            let sought = kinds.keys().skip(n % 3).step_by(if long() { 3 } else { 7 });
            for (other_russian, other) in sought.filter(|(_, other)| other != name) {
                let list = format!("How many {} are there?", english::plural(name));
                for link in ["on", "next to", "near", "in front of"] {
                    let each = |id: &ReplicaId| {
                        format!("Is there a {other} {link} {}?", world.replicas[id].name_en)
                    };
                    let questions: Vec<String> = all.iter().map(each).collect();
                    for (words, share) in ENGLISH {
                        let mut lines = vec![format!("Is there a {other} {link} {words}?")];
                        if matches!(share, "any" | "either") && link == "on" {
                            lines.push(format!("Does {words} have a {other} {link} it?"));
                        }
                        for line in lines {
                            compare(
                                &engine,
                                [&list, &line],
                                all,
                                &questions,
                                share,
                                [&mut heard, &mut yes, &mut refused],
                            );
                        }
                    }
                }
                let list = format!("Сколько {}?", many(russian, Case::Genitive));
                for (case, link, ways) in RUSSIAN {
                    let each = |id: &ReplicaId| {
                        format!("Есть ли {other_russian} {link} {}?", form(world, *id, case))
                    };
                    let questions: Vec<String> = all.iter().map(each).collect();
                    let gender = NounPhrase::parse(russian, &WordHints::default()).gender();
                    for (words, share) in ways {
                        let line = format!("Есть ли {other_russian} {}?", agreeing(words, gender));
                        compare(
                            &engine,
                            [&list, &line],
                            all,
                            &questions,
                            share,
                            [&mut heard, &mut yes, &mut refused],
                        );
                    }
                }
            }
        }
    }
    assert!(heard > 9 * refused && yes > 10, "{heard} heard, {yes} yes, {refused} refused");
}

/// What is asked after a list is so where it is so of those that it told.
fn compare(
    engine: &Engine,
    [list, line]: [&String; 2],
    all: &[ReplicaId],
    questions: &[String],
    share: &str,
    [heard, yes, refused]: [&mut usize; 3],
) {
    let of_two = matches!(share, "both" | "either");
    let mut memory = Memory::default();
    let Some(answer) = ask(engine, list, &mut memory) else { return };
    let told: BTreeSet<Thing> = answer.things.into_iter().collect();
    if told != all.iter().copied().map(replica).collect() || of_two && told.len() != 2 {
        return;
    }
    let Some(plain) = of_all(engine, questions, share) else { return };
    match ask(engine, line, &mut memory) {
        Some(answer) if answer.said != Said::Unknown => {
            let said = if plain { Said::Yes } else { Said::No };
            assert_eq!(answer.said, said, "{list} {line} {}", answer.text);
            *heard += 1;
            *yes += usize::from(plain);
            if plain && share == "any" {
                let so = |question: &String| {
                    plainly(engine, question).is_some_and(|answer| answer.said == Said::Yes)
                };
                let meant = all.iter().zip(questions).filter(|(_, question)| so(question));
                let meant: BTreeSet<Thing> = meant.map(|(id, _)| replica(*id)).collect();
                let which = if line.starts_with("Есть") {
                    "Какой из них?"
                } else {
                    "Which one?"
                };
                let told = ask(engine, which, &mut memory).map(|answer| answer.things);
                let told: BTreeSet<Thing> = told.into_iter().flatten().collect();
                assert_eq!(told, meant, "{list} {line} {which}");
            }
        }
        _ => *refused += 1,
    }
}

#[test]
fn which_of_them_has_more_is_told_by_how_many_each_has() {
    let (mut heard, mut refused) = (0, 0);
    for engine in maps() {
        let world = engine.world().unwrap();
        let kinds = by_kind(world);
        let told = kinds.iter().filter(|(_, all)| (2..5).contains(&all.len()));
        for ((russian, name), all) in told.take(if long() { 30 } else { 10 }) {
            for (other_russian, other) in kinds.keys().step_by(if long() { 3 } else { 6 }) {
                let (others, genitive) =
                    (english::plural(other), many(other_russian, Case::Genitive));
                let list = format!("Where are the {}?", english::plural(name));
                let russian_list = format!("Где {}?", many(russian, Case::Nominative));
                for (list, question, line) in [
                    (
                        &list,
                        format!("How many {others} are there on %?"),
                        format!("Which of them has more {others} on it?"),
                    ),
                    (
                        &list,
                        format!("How many {others} are there next to %?"),
                        format!("Next to which of them are there the fewest {others}?"),
                    ),
                    (
                        &russian_list,
                        format!("Сколько {genitive} на %?"),
                        format!("На каком из них больше {genitive}?"),
                    ),
                ] {
                    let is_russian = list == &russian_list;
                    let count = |id: &ReplicaId| {
                        let name = match is_russian {
                            true => form(world, *id, Case::Prepositional),
                            false => world.replicas[id].name_en.clone(),
                        };
                        plainly(&engine, &question.replace('%', &name))?.number
                    };
                    let counts: Option<Vec<f64>> = all.iter().map(count).collect();
                    let mut memory = Memory::default();
                    let Some(told) = ask(&engine, list, &mut memory) else { continue };
                    let told: BTreeSet<Thing> = told.things.into_iter().collect();
                    if told != all.iter().copied().map(replica).collect() {
                        continue;
                    }
                    let (Some(counts), Some(answer)) = (counts, ask(&engine, &line, &mut memory))
                    else {
                        refused += 1;
                        continue;
                    };
                    let best = match line.contains("fewest") {
                        true => counts.iter().copied().fold(f64::INFINITY, f64::min),
                        false => counts.iter().copied().fold(0.0, f64::max),
                    };
                    let most =
                        all.iter().zip(&counts).filter(|(_, n)| (**n).total_cmp(&best).is_eq());
                    let most: BTreeSet<Thing> = most.map(|(id, _)| replica(*id)).collect();
                    let found: BTreeSet<Thing> = answer.things.iter().copied().collect();
                    assert_eq!(found, most, "{list} {line} {}", answer.text);
                    heard += 1;
                }
            }
        }
    }
    assert!(heard > 4 * refused && heard > 20, "{heard} heard, {refused} refused");
}

/// Two are told, one is singled out and carried off: «второй» is the other of the two, however the order was parted.
#[test]
fn the_second_of_two_is_the_one_that_was_not_dealt_with() {
    let mut told = 0;
    for mut engine in maps() {
        let world = engine.world().unwrap().clone();
        let rooms: Vec<String> = world
            .areas
            .values()
            .map(|area| area.name_en.clone())
            .filter(|n| !n.is_empty())
            .collect();
        let Some(to) = rooms.last() else { continue };
        let tables = world
            .replicas
            .keys()
            .filter(|id| world.has_trait(**id, "support") && !world.has_trait(**id, "portable"));
        let tables: Vec<&String> = tables.map(|id| &world.replicas[id].name_en).take(2).collect();
        let Some(table) = tables.first() else { continue };
        for ((_, name), all) in by_kind(&world) {
            let [one, other] = all[..] else { continue };
            if !all.iter().all(|id| world.has_trait(*id, "portable")) {
                continue;
            }
            let orders = [
                format!("Take it to {to} and put it on {table}."),
                format!("Put it on {table}."),
                format!("Take it to {to}."),
            ];
            let lines = ["And where is the second one lying?", "Where is the other one?"];
            for (order, line) in orders.iter().flat_map(|o| lines.map(|line| (o, line))) {
                let mut dialogue = Dialogue::default().keeping_nothing();
                let mut hear = |line: &str| {
                    dialogue.hear(&mut engine, line, &mut |_, _| {}).expect("there is a map")
                };
                hear(&format!("Where are the {}?", english::plural(&name)));
                hear(&format!("Where is {}?", world.replicas[&one].name_en));
                if hear(order).tasks().next().is_none() {
                    continue;
                }
                let heard = hear(line).text();
                let own = &world.replicas[&one].name_en;
                assert!(!heard.starts_with(own.as_str()), "{name} {order} {line} {heard}");
                told += usize::from(heard.starts_with(world.replicas[&other].name_en.as_str()));
            }
            if !long() && told > 6 {
                break;
            }
        }
    }
    assert!(told > 3, "{told}");
}
