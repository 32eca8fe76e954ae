//! Dialogues of several turns over whole maps, with what each turn means told by the map alone: whatever cannot be bound by its
//! number, gender and sort is not answered, and least of all of another thing.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::question::{Answer, Said, Thing};
use orthoframe_language::{Case, Gender, NounPhrase, Number, WordHints, english, russian};
use orthoframe_map::{Entity, Replica, World};
use orthoframe_units::ReplicaId;

use crate::files::long;
use crate::talk::engine;

/// Maps of ours and of others.
fn maps() -> Vec<Engine> {
    const MAPS: [&str; 4] = [
        "maps/rb2.toml",
        "../shared/data/procthor/house_3.json",
        "../shared/data/procthor/house_5.json",
        "../shared/data/virtualhome/TestScene3_graph.json",
    ];
    MAPS.into_iter().take(if long() { 4 } else { 2 }).filter_map(engine).collect()
}

/// What the last of these lines comes to.
fn last(engine: &Engine, lines: &[&str]) -> Option<Answer> {
    let mut memory = Memory::default();
    let ask = |line: &&str| engine.ask(line, &mut memory).expect("there is a map").ok();
    lines.iter().map(ask).last().flatten()
}

fn found(answer: &Answer) -> BTreeSet<Thing> {
    answer.things.iter().copied().collect()
}

fn phrase(name: &str) -> NounPhrase {
    NounPhrase::parse(name, &WordHints::default())
}

/// A kind by its names, with its things.
struct Kind {
    english: String,
    many: String,
    /// «картин»
    of_many: String,
    /// «картины»
    all: String,
    things: Vec<ReplicaId>,
}

fn kinds(world: &World) -> Vec<Kind> {
    let mut kinds: BTreeMap<(String, String), Vec<ReplicaId>> = BTreeMap::new();
    for replica in world.replicas.values() {
        let kind = world.objects[&replica.object].object_type;
        let Some(kind) = world.types.object.get(kind) else { continue };
        let key = (kind.name.to_lowercase(), kind.name_en.clone());
        kinds.entry(key).or_default().push(replica.id);
    }
    // «ТВ-тумба» has no plural that a person would write, and a «письменный стол» is a «стол» too.
    let names: Vec<String> = kinds.keys().map(|(name, _)| name.clone()).collect();
    let is_one = |name: &String| {
        let wider = |other: &String| other != name && other.ends_with(name.as_str());
        !name.contains('-') && !names.iter().any(wider)
    };
    let told = kinds.into_iter().filter(|((name, _), _)| is_one(name));
    told.map(|((name, english), things)| {
        let own = phrase(&name);
        let of_many = own.form(Case::Genitive, Number::Plural).to_lowercase();
        let all = own.form(Case::Nominative, Number::Plural).to_lowercase();
        Kind { many: english::plural(&english), english, of_many, all, things }
    })
    .collect()
}

/// Of the things every third, in the long run all.
fn some<T>(all: Vec<T>) -> impl Iterator<Item = T> {
    all.into_iter().step_by(if long() { 1 } else { 3 })
}

/// «Что на кровати? Сколько там картин?»: no picture hangs on the bed, but in its room.
#[test]
fn what_hangs_is_where_the_bed_is_and_not_on_it() {
    let mut told = 0;
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        let kinds = kinds(world);
        let supports: BTreeSet<ReplicaId> =
            world.replicas.keys().filter_map(|id| relations.support_of(*id)).collect();
        for (n, place) in supports.iter().enumerate() {
            let room = relations.area_of(*place);
            let name = &world.replicas[place].name;
            let on = phrase(name).form(Case::Prepositional, Number::Singular);
            for kind in kinds.iter().skip(n % 3).step_by(3) {
                // What lies on anything may be there as well.
                let lies = |id: &ReplicaId| {
                    world.has_trait(*id, "portable") || relations.support_of(*id).is_some()
                };
                if kind.things.iter().any(lies) || kind.things.contains(place) {
                    continue;
                }
                // «Картины» are photographs, too.
                let all = last(&engine, &[&format!("Сколько всего {}?", kind.of_many)]);
                let all = all.and_then(|all| all.number).unwrap_or_default() as usize;
                if all != kind.things.len() {
                    continue;
                }
                let there = kind.things.iter().filter(|id| relations.area_of(**id) == room);
                let there = there.count();
                let lines = [format!("Что на {on}?"), format!("Сколько там {}?", kind.of_many)];
                let Some(answer) = last(&engine, &[&lines[0], &lines[1]]) else { continue };
                let number = answer.number.unwrap_or_default() as usize;
                assert_eq!(number, there, "{lines:?} {}", answer.text);
                told += 1;
            }
        }
    }
    assert!(told > 20, "{told}");
}

/// "Which one is in the kitchen?", where nothing was spoken of.
#[test]
fn one_of_nothing_is_no_list_of_a_room() {
    for engine in maps() {
        let world = engine.world().unwrap();
        for room in world.areas.values() {
            let name = &room.name_en;
            for line in [
                format!("Which one is in {name}?"),
                format!("Which ones are in {name}?"),
                format!("Which of them are in {name}?"),
                format!("How many of them are in {name}?"),
            ] {
                assert!(last(&engine, &[&line]).is_none(), "{line}");
            }
        }
    }
}

/// "I'm in the garage. Which chair is nearest to me?", where there is no garage: from nowhere nothing is counted.
#[test]
fn from_a_place_that_is_not_known_nothing_is_counted() {
    const PLACES: [(&str, &str); 4] = [
        ("I'm in the garage.", "Я в гараже."),
        ("I am standing by the swimming pool.", "Я стою у бассейна."),
        ("I'm at the reception desk.", "Я сейчас в подвале."),
        ("I'm in the hangar on the left.", "Я сижу у пруда в гараже."),
    ];
    let mut answered = 0;
    for engine in maps() {
        let world = engine.world().unwrap();
        let room = world.areas.values().next().expect("a room");
        let to = phrase(&room.name).form(Case::Genitive, Number::Singular);
        for kind in some(kinds(world)) {
            let english = [
                format!("Which {} is nearest to me?", kind.english),
                format!("Where is the nearest {}?", kind.english),
                format!("How far is it to {}?", room.name_en),
            ];
            let russian = [format!("Далеко ли до {to}?"), format!("Сколько метров до {to}?")];
            for (told, told_russian) in PLACES {
                for line in &english {
                    assert!(last(&engine, &[told, line]).is_none(), "{told} {line}");
                    let whole = format!("{told} {line}");
                    assert!(last(&engine, &[&whole]).is_none(), "{whole}");
                }
                for line in &russian {
                    let answer = last(&engine, &[told_russian, line]);
                    assert!(answer.is_none(), "{told_russian} {line} {answer:?}");
                }
                // What does not count from there is answered.
                let plain = format!("How many {} are there?", kind.many);
                answered += usize::from(last(&engine, &[told, &plain]).is_some());
            }
        }
    }
    assert!(answered > 10, "{answered}");
}

/// «Где ручка? А вантуз? – В ванной. – В какой комнате она?»: the pen's room, and not where the bathroom is.
#[test]
fn a_pronoun_goes_back_to_what_was_asked_of_before_a_place_that_was_told() {
    let mut told = 0;
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        let room = |replica: &Replica| relations.area_of(replica.id);
        let gender = |replica: &Replica| {
            let name = phrase(&replica.name);
            (name.number() == Number::Singular).then(|| name.gender())
        };
        let all: Vec<&Replica> = world.replicas.values().collect();
        for (n, first) in all.iter().enumerate() {
            let second = all[(n + all.len() / 2) % all.len()];
            let (Some(one), Some(other)) = (gender(first), gender(second)) else { continue };
            if one == other || room(first) == room(second) || room(first).is_none() {
                continue;
            }
            let pronoun = match one {
                Gender::Masculine => "он",
                Gender::Feminine => "она",
                Gender::Neuter => "оно",
            };
            let lines = [
                format!("Где {}?", first.name),
                format!("А {}?", second.name),
                format!("В какой комнате {pronoun}?"),
            ];
            let Some(answer) = last(&engine, &[&lines[0], &lines[1], &lines[2]]) else { continue };
            assert!(answer.text.contains(&first.name), "{lines:?} {}", answer.text);
            told += 1;
        }
    }
    assert!(told > 10, "{told}");
}

/// «Где стулья? Сколько их на кухне? Сколько осталось в гостиной?»: chairs, and not those that were counted last.
#[test]
fn what_is_left_is_of_the_kind_that_was_counted() {
    let mut told = 0;
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        let rooms: Vec<_> = world.areas.values().collect();
        for kind in some(kinds(world)).filter(|kind| kind.things.len() > 1) {
            for (n, here) in rooms.iter().enumerate() {
                let there = rooms[(n + 1) % rooms.len()];
                let in_room = |id: &&ReplicaId| relations.area_of(**id) == Some(there.id);
                let expected = kind.things.iter().filter(in_room).count();
                let [at, other] = [here, there].map(|room| russian::where_at(&phrase(&room.name)));
                for lines in [
                    [
                        format!("Где {}?", kind.all),
                        format!("Сколько их {at}?"),
                        format!("Сколько осталось {other}?"),
                    ],
                    [
                        format!("How many {} are there?", kind.many),
                        format!("How many of them are in {}?", here.name_en),
                        format!("How many are left in {}?", there.name_en),
                    ],
                ] {
                    let answer = last(&engine, &[&lines[0], &lines[1], &lines[2]]);
                    let Some(answer) = answer else { continue };
                    let number = answer.number.unwrap_or_default() as usize;
                    assert_eq!(number, expected, "{lines:?} {}", answer.text);
                    told += 1;
                }
            }
        }
    }
    assert!(told > 20, "{told}");
}

/// "Where are the cups? And the other one?": of several that were told at once none is the other one; of two of which one was
/// told, the other is.
#[test]
fn several_are_no_other_one() {
    let mut told = 0;
    for engine in maps() {
        let world = engine.world().unwrap();
        for kind in kinds(world) {
            if kind.things.len() < 2 {
                continue;
            }
            let opening = format!("Where are the {}?", kind.many);
            if last(&engine, &[&opening]).is_none_or(|a| a.things.len() < 2) {
                continue;
            }
            for line in
                ["And the other one?", "Where is the other one?", "Which room is the other one in?"]
            {
                let answer = last(&engine, &[&opening, line]);
                assert!(answer.is_none(), "{opening} {line} {answer:?}");
            }
            let [one, other] = kind.things[..] else { continue };
            let name = &world.replicas[&one].name_en;
            let other = Thing::Entity(Entity::Replica(other));
            for (first, line) in [
                (format!("Where is {name}?"), "And the other one?"),
                (format!("Where is {name}?"), "Where is the other one?"),
            ] {
                let Some(answer) = last(&engine, &[&first, line]) else { continue };
                assert_eq!(
                    found(&answer),
                    BTreeSet::from([other]),
                    "{first} {line} {}",
                    answer.text
                );
                told += 1;
            }
        }
    }
    assert!(told > 2, "{told}");
}

/// "Where are the chairs? Which of them is nearest to the fridge?": nearest to it, and no chair that is a fridge.
#[test]
fn the_nearest_of_them_is_the_nearest_of_the_kind() {
    let mut told = 0;
    for engine in maps() {
        let world = engine.world().unwrap();
        let kinds = kinds(world);
        let lone: Vec<&Kind> = kinds.iter().filter(|kind| kind.things.len() == 1).collect();
        for (n, kind) in kinds.iter().filter(|kind| kind.things.len() > 1).enumerate() {
            for anchor in lone.iter().skip(n % 4).step_by(4) {
                let anchor = &anchor.english;
                for (far, to) in [("nearest", "to"), ("farthest", "from")] {
                    let whole = format!("Which {} is {far} {to} the {anchor}?", kind.english);
                    let Some(plain) = last(&engine, &[&whole]) else { continue };
                    let opening = format!("Where are the {}?", kind.many);
                    let line = format!("Which of them is {far} {to} the {anchor}?");
                    let Some(answer) = last(&engine, &[&opening, &line]) else { continue };
                    assert_eq!(found(&answer), found(&plain), "{opening} {line} {}", answer.text);
                    told += 1;
                }
            }
        }
    }
    assert!(told > 10, "{told}");
}

/// «Положи книгу на кровать. Где газета? Отнеси её туда же»: to the bed, and not to where the newspaper is.
#[test]
fn nothing_is_put_where_it_is_itself() {
    let mut understood = 0;
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        let order = |text: &str, memory: &mut Memory| {
            let commands = engine.understand_in(text, memory).ok()?;
            Some(format!("{commands:?}"))
        };
        let carried: Vec<&Replica> = world
            .replicas
            .values()
            .filter(|r| world.has_trait(r.id, "portable") && relations.support_of(r.id).is_some())
            .collect();
        let places: BTreeSet<ReplicaId> =
            carried.iter().filter_map(|r| relations.support_of(r.id)).collect();
        for (n, thing) in carried.iter().enumerate() {
            let other = carried[(n + 1) % carried.len()];
            let own = relations.support_of(other.id);
            let Some(place) = places.iter().cycle().skip(n).find(|id| Some(**id) != own) else {
                continue;
            };
            let (name, place) = (&other.name_en, &world.replicas[place].name_en);
            let first = format!("Put {} on {place}", thing.name_en);
            let plain = ["on", "to", "in"]
                .map(|rel| order(&format!("Put {name} {rel} {place}"), &mut Memory::default()));
            for line in ["Put it there too.", "Put it there."] {
                let mut memory = Memory::default();
                if order(&first, &mut memory).is_none() {
                    continue;
                }
                let asked = engine.ask(&format!("Where is {name}?"), &mut memory);
                asked.expect("there is a map").ok();
                let Some(told) = order(line, &mut memory) else { continue };
                assert!(plain.contains(&Some(told)), "{first}. Where is {name}? {line} {plain:?}");
                understood += 1;
            }
            // Where nothing was ordered before, it is put nowhere.
            let mut memory = Memory::default();
            let asked = engine.ask(&format!("Where is {name}?"), &mut memory);
            asked.expect("there is a map").ok();
            assert_eq!(order("Put it there.", &mut memory), None, "{name}");
        }
    }
    assert!(understood > 10, "{understood}");
}

/// "How many phones are in the bedroom? Where are they? What about the hall?": the phones there, and not where the hall is.
#[test]
fn another_room_after_where_they_are_has_others_of_them() {
    let mut told = 0;
    for engine in maps() {
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        let rooms: Vec<_> = world.areas.values().collect();
        for kind in kinds(world) {
            let pairs = rooms.iter().flat_map(|here| rooms.iter().map(move |there| (here, there)));
            for (here, there) in pairs.filter(|(here, there)| here.id != there.id) {
                let within = |room: orthoframe_units::AreaId| {
                    let own = kind.things.iter().filter(|id| relations.area_of(**id) == Some(room));
                    own.map(|id| Thing::Entity(Entity::Replica(*id))).collect::<BTreeSet<_>>()
                };
                if within(here.id).len() < 2 {
                    continue;
                }
                let [at, other] = [here, there].map(|room| russian::where_at(&phrase(&room.name)));
                for lines in [
                    [
                        format!("How many {} are in {}?", kind.many, here.name_en),
                        "Where are they?".to_owned(),
                        format!("What about {}?", there.name_en),
                    ],
                    [
                        format!("Сколько {} {at}?", kind.of_many),
                        "Где они?".to_owned(),
                        format!("А {other}?"),
                    ],
                ] {
                    let answer = last(&engine, &[&lines[0], &lines[1], &lines[2]]);
                    let Some(answer) = answer.filter(|answer| answer.said != Said::Nothing) else {
                        continue;
                    };
                    assert_eq!(found(&answer), within(there.id), "{lines:?} {}", answer.text);
                    told += 1;
                }
            }
        }
    }
    assert!(told > 0, "{told}");
}
