//! Questions of several things, and what goes on from a count or a list that was told: "the other two", "are there more of
//! them than in the hall?"

use std::collections::{BTreeMap, BTreeSet};

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::english;
use orthoframe_language::question::{Answer, Said, Thing};
use orthoframe_language::{Case, NounPhrase, Number, WordHints, russian};
use orthoframe_map::Entity;
use orthoframe_units::ReplicaId;

use crate::files::long;
use crate::talk::engine;

/// Maps of ours and of others.
fn maps() -> Vec<Engine> {
    const MAPS: [&str; 4] = [
        "maps/rb2.toml",
        "../shared/data/procthor/house_2.json",
        "../shared/data/procthor/house_5.json",
        "../shared/data/virtualhome/TestScene2_graph.json",
    ];
    MAPS.into_iter().take(if long() { 4 } else { 2 }).filter_map(engine).collect()
}

fn ask(engine: &Engine, line: &str, memory: &mut Memory) -> Option<Answer> {
    engine.ask(line, memory).expect("there is a map").ok()
}

/// The kinds of things of a map by their names in both languages, with those of the kind.
fn kinds(engine: &Engine) -> BTreeMap<(String, String), Vec<ReplicaId>> {
    let world = engine.world().unwrap();
    let mut kinds: BTreeMap<_, Vec<ReplicaId>> = BTreeMap::new();
    for replica in world.replicas.values() {
        let kind = world.objects[&replica.object].object_type;
        let Some(kind) = world.types.object.get(kind) else { continue };
        kinds.entry((kind.name.clone(), kind.name_en.clone())).or_default().push(replica.id);
    }
    kinds
}

/// "Where is Cup 1? And the other two?": where there are just two others these, and else nobody.
#[test]
fn the_other_two_are_just_two() {
    const NUMBERS: [(&str, &str); 3] = [("два", "two"), ("три", "three"), ("четыре", "four")];
    let mut told = 0;
    for engine in maps() {
        let world = engine.world().unwrap();
        for things in kinds(&engine).values() {
            let first = &world.replicas[&things[0]];
            let (russian, english) =
                (format!("Где {}?", first.name), format!("Where is {}?", first.name_en));
            for (n, (two, english_two)) in NUMBERS.iter().enumerate() {
                for (opening, line) in [
                    (&russian, format!("А другие {two}?")),
                    (&russian, format!("А остальные {two} где?")),
                    (&english, format!("And the other {english_two}?")),
                    (&english, format!("Where are the other {english_two}?")),
                ] {
                    let mut memory = Memory::default();
                    if ask(&engine, opening, &mut memory).is_none_or(|a| a.things.len() != 1) {
                        continue;
                    }
                    let Some(answer) = ask(&engine, &line, &mut memory) else { continue };
                    let others = things.iter().filter(|id| **id != first.id);
                    let others: Vec<Thing> =
                        others.map(|id| Thing::Entity(Entity::Replica(*id))).collect();
                    assert_eq!(others.len(), n + 2, "{opening} {line} {}", answer.text);
                    let all = others.iter().all(|other| answer.text.contains(&name(world, other)));
                    assert!(
                        all || answer.text.contains("more"),
                        "{opening} {line} {}",
                        answer.text
                    );
                    told += 1;
                }
            }
        }
    }
    assert!(told > 10, "{told}");
}

/// The number of a thing's name, which every text has that names it.
fn name(world: &orthoframe_map::World, thing: &Thing) -> String {
    let Thing::Entity(entity) = thing else { return String::new() };
    world.name(*entity).rsplit('-').next().unwrap_or_default().to_owned()
}

/// «Сколько стульев на кухне? Их больше, чем в гостиной?» is answered as the whole question is, or not at all.
#[test]
#[expect(clippy::print_stdout, reason = "how many are understood is worth seeing")]
fn a_count_is_compared_with_another_place() {
    let (mut asked, mut same) = (0, 0);
    for engine in maps() {
        let world = engine.world().unwrap();
        let rooms: Vec<_> = world.areas.values().take(6).collect();
        for (n, (name, name_en)) in kinds(&engine).into_keys().enumerate() {
            let (here, there) = (rooms[n % rooms.len()], rooms[(n + 1) % rooms.len()]);
            let places = [here, there].map(|room| {
                russian::where_at(&NounPhrase::parse(&room.name, &WordHints::default()))
            });
            let kind = NounPhrase::parse(&name, &WordHints::default());
            let kind = kind.form(Case::Genitive, Number::Plural).to_lowercase();
            let kinds = english::plural(&name_en).to_lowercase();
            let (a, b) = (&here.name_en, &there.name_en);
            let (at_a, at_b) = (&places[0], &places[1]);
            let russian = format!("Сколько {kind} {at_a}?");
            let english = format!("How many {kinds} are in {a}?");
            let (more, fewer) = ("more", "fewer");
            let whole = |word: &str| format!("Are there {word} {kinds} in {a} than in {b}?");
            let in_russian =
                |word: &str, at: &str, other: &str| format!("{kind} {word} {at}, чем {other}?");
            let back = |word: &str| format!("Are there {word} {kinds} in {b} than in {a}?");
            for (opening, line, plain) in [
                (&english, format!("Are there more of them than in {b}?"), whole(more)),
                (&english, format!("Is that more than in {b}?"), whole(more)),
                (&english, format!("Are there fewer of them in {b}?"), back(fewer)),
                (&english, format!("Are there fewer than in {b}?"), whole(fewer)),
                (&russian, format!("Их больше, чем {at_b}?"), in_russian("больше", at_a, at_b)),
                (&russian, format!("Это больше, чем {at_b}?"), in_russian("больше", at_a, at_b)),
                (&russian, format!("А {at_b} их больше?"), in_russian("больше", at_b, at_a)),
                (&russian, format!("Там их меньше, чем {at_b}?"), in_russian("меньше", at_a, at_b)),
            ] {
                let mut memory = Memory::default();
                if ask(&engine, opening, &mut memory).is_none_or(|a| a.number.is_none()) {
                    continue;
                }
                let Some(plain) = ask(&engine, &plain, &mut Memory::default()) else { continue };
                asked += 1;
                let Some(told) = ask(&engine, &line, &mut memory) else { continue };
                assert_eq!(
                    told.said, plain.said,
                    "{opening} {line}\n  {}\n  {}",
                    told.text, plain.text
                );
                assert!(matches!(told.said, Said::Yes | Said::No), "{}", told.text);
                same += 1;
            }
        }
    }
    println!("{same} of {asked}");
    assert!(same * 100 >= asked * 95 && asked > 50, "{same} of {asked}");
}

/// «В какой комнате полотенца?» asks of all of them, as «В каких комнатах есть полотенца?» does.
#[test]
fn the_room_of_several_is_that_of_each() {
    let mut asked = 0;
    for engine in maps() {
        for ((name, name_en), things) in kinds(&engine) {
            let kind = NounPhrase::parse(&name, &WordHints::default());
            let kinds = kind.form(Case::Nominative, Number::Plural).to_lowercase();
            let many = english::plural(&name_en).to_lowercase();
            for (line, plain) in [
                (format!("В какой комнате {kinds}?"), format!("В каких комнатах есть {kinds}?")),
                (format!("Which room are the {many} in?"), format!("Which rooms have {many}?")),
            ] {
                let rooms = |line: &str| {
                    let answer = ask(&engine, line, &mut Memory::default())?;
                    Some(answer.things.into_iter().collect::<BTreeSet<_>>())
                };
                let Some(plain) = rooms(&plain) else { continue };
                let told = rooms(&line);
                assert!(
                    told.is_none() || told.as_ref() == Some(&plain),
                    "{line} {told:?} {plain:?}"
                );
                asked += usize::from(told.is_some() && things.len() > 1);
            }
        }
    }
    assert!(asked > 10, "{asked}");
}

/// "How many benches are there? What are they next to? Which of them is nearest to the fridge?": one of them, or nothing.
#[test]
fn which_of_them_is_one_of_those_that_were_asked_after() {
    let mut asked = 0;
    for engine in maps() {
        let world = engine.world().unwrap();
        let Some(anchor) = world.replicas.values().find(|r| !r.name_en.is_empty()) else {
            continue;
        };
        for ((_, name_en), things) in kinds(&engine) {
            if things.len() < 2 {
                continue;
            }
            let kinds = english::plural(&name_en).to_lowercase();
            for between in
                ["What are they on?", "What are they next to?", "Which rooms are they in?"]
            {
                let mut memory = Memory::default();
                let all = ask(&engine, &format!("How many {kinds} are there?"), &mut memory);
                let all = all.map_or_else(Vec::new, |all| all.things);
                ask(&engine, between, &mut memory);
                let line = format!("Which of them is the nearest to {}?", anchor.name_en);
                let Some(answer) = ask(&engine, &line, &mut memory) else { continue };
                let of_them = |thing: &Thing| all.contains(thing);
                assert!(
                    answer.things.iter().all(of_them),
                    "{kinds}: {between} {line} {}",
                    answer.text
                );
                asked += 1;
            }
        }
    }
    assert!(asked > 5, "{asked}");
}

/// "How many cups are there? Is there one in the hall as well?": one of the kind, and not anything at all.
#[test]
fn one_is_of_the_kind_that_was_asked_after() {
    let mut asked = 0;
    for engine in maps() {
        let world = engine.world().unwrap();
        let rooms: Vec<_> = world.areas.values().take(6).collect();
        for (n, (_, name_en)) in kinds(&engine).into_keys().enumerate() {
            let room = &rooms[n % rooms.len()].name_en;
            let kinds = english::plural(&name_en).to_lowercase();
            for line in [
                format!("Is there one in {room}?"),
                format!("Is there one in {room} as well?"),
                format!("And is there one in {room}?"),
            ] {
                let mut memory = Memory::default();
                ask(&engine, &format!("How many {kinds} are there?"), &mut memory);
                let Some(told) = ask(&engine, &line, &mut memory) else { continue };
                let plain = format!("Are there any {kinds} in {room}?");
                let Some(plain) = ask(&engine, &plain, &mut Memory::default()) else { continue };
                // «And …» goes on to count.
                let none = |said: Said| matches!(said, Said::No | Said::Nothing);
                let same = none(told.said) == none(plain.said);
                assert!(same, "{kinds}: {line} {} {}", told.text, plain.text);
                asked += 1;
            }
            let anew = ask(&engine, &format!("Is there one in {room}?"), &mut Memory::default());
            assert!(anew.is_none(), "{room}: of nothing there is none");
        }
    }
    assert!(asked > 20, "{asked}");
}

/// The ways out of a room are its doors and its passages, and those of the building are what leads outside: "How many exits
/// does the dining room have?" was answered with none, for there was no outer door.
#[test]
fn whatever_opens_on_a_room_is_a_way_out_of_it() {
    let mut asked = 0;
    for engine in maps() {
        let number = |line: &str| {
            let answer = ask(&engine, line, &mut Memory::default());
            let number = answer.and_then(|answer| answer.number);
            number.unwrap_or_else(|| panic!("{line}")) as usize
        };
        let mut outside = 0;
        for room in engine.world().unwrap().areas.values() {
            let noun = NounPhrase::parse(&room.name, &WordHints::default());
            let of = noun.form(Case::Genitive, Number::Singular);
            let name = &room.name_en;
            let doors = number(&format!("How many doors does {name} have?"));
            let passages = number(&format!("How many passages does {name} have?"));
            let out = number(&format!("Сколько выходов на улицу у {of}?"));
            for line in [
                format!("How many exits does {name} have?"),
                format!("How many ways out of {name} are there?"),
                format!("How many entrances does {name} have?"),
                format!("Сколько выходов у {of}?"),
            ] {
                let answer = ask(&engine, &line, &mut Memory::default());
                let answer = answer.unwrap_or_else(|| panic!("{line}"));
                let told = answer.number.map(|number| number as usize);
                assert_eq!(told, Some(doors + passages), "{line} {}", answer.text);
                let tells = answer.text.contains("outside") || answer.text.contains("наружу");
                assert_eq!(tells, out > 0, "{line} {}", answer.text);
                asked += 1;
            }
            let mut memory = Memory::default();
            ask(&engine, &format!("Сколько выходов у {of}?"), &mut memory);
            let led = ask(&engine, "Какие из них ведут наружу?", &mut memory).expect("understood");
            assert_eq!(led.things.len(), out, "{of} {}", led.text);
            outside += out;
        }
        assert_eq!(number("Сколько выходов на карте?"), outside);
    }
    assert!(asked > 30, "{asked}");
}
