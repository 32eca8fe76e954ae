//! An order that asks back, and whatever line follows it: the order goes on, is corrected, or is left with a word; nothing
//! else is ever done. And a line that corrects itself: what it takes back is not done.

use std::fmt::Write as _;

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Heard, Memory};
use orthoframe_language::names::{hints, hints_of_type};
use orthoframe_language::{Case, Language, NounPhrase};
use orthoframe_map::{Entity, World};
use orthoframe_units::AreaId;

use crate::files::long;
use crate::talk::engine;

const MAPS: [&str; 3] = [
    "maps/rb2.toml",
    "../shared/data/procthor/house_7.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
];

/// A kind of which there are several things to carry, as it is asked for, and their names.
struct Kind {
    said: String,
    things: Vec<Named>,
}

/// How a thing is called, in the nominative and as what is carried, and by the map.
#[derive(Clone)]
struct Named {
    name: String,
    carried: String,
    symbol: String,
}

fn named(world: &World, entity: Entity, language: Language) -> Named {
    let symbol = world.name(entity).to_owned();
    match language {
        Language::English => {
            let name = orthoframe_language::names::english_name(world, entity).to_owned();
            Named { carried: name.clone(), name, symbol }
        }
        Language::Russian => {
            let phrase = NounPhrase::parse(&symbol, &hints(world, entity));
            Named { carried: phrase.case(Case::Accusative), name: symbol.clone(), symbol }
        }
    }
}

/// The kinds of what can be carried, and how many things of each there are.
fn kinds(world: &World, language: Language) -> Vec<Kind> {
    let mut all: Vec<Kind> = Vec::new();
    for replica in world.replicas.values().filter(|r| world.has_trait(r.id, "portable")) {
        let Some(kind) = world.types.object.get(world.objects[&replica.object].object_type) else {
            continue;
        };
        let said = match language {
            Language::English => format!("the {}", kind.name_en.to_lowercase()),
            Language::Russian => NounPhrase::parse(&kind.name.to_lowercase(), &hints_of_type(kind))
                .case(Case::Accusative),
        };
        let thing = named(world, Entity::Replica(replica.id), language);
        match all.iter_mut().find(|kind| kind.said == said) {
            Some(kind) => kind.things.push(thing),
            None => all.push(Kind { said, things: vec![thing] }),
        }
    }
    all
}

/// What a dialogue came to: the words of its outcomes, and what the last task was done to and whither.
fn came_of(engine: &mut Engine, lines: &[&str]) -> (Vec<Vec<&'static str>>, Vec<String>) {
    let mut dialogue = Dialogue::default().keeping_nothing();
    let mut heard: Vec<Heard> = Vec::new();
    for line in lines {
        heard.push(dialogue.hear(engine, line, &mut |_, _| {}).unwrap());
    }
    let words = |heard: &Heard| heard.replies.iter().map(|reply| reply.outcome.word()).collect();
    let done = heard.iter().flat_map(Heard::tasks);
    let args = done.flat_map(|task| task.goal.iter().flat_map(|goal| goal.args.clone()));
    (heard.iter().map(words).collect(), args.collect())
}

/// Whether a name is that of a room, or of something in it.
fn is_in(world: &World, name: &str, room: AreaId) -> bool {
    world.find(name).iter().any(|entity| match entity {
        Entity::Area(id) => *id == room,
        Entity::Replica(id) => world.replicas[id].area == room,
        _ => false,
    })
}

/// What is to come of a line behind an order that asked back.
enum Wanted<'w> {
    /// The order is carried out with this thing.
    Done(&'w Named),
    /// It is asked again, and a name that follows is carried out in this room.
    AskedAgain(AreaId),
    /// Nothing is done, then or by a name that follows.
    Left,
    /// Nothing is done by it, and a name that follows is carried out.
    StillOpen,
    /// Another order is carried out, and the order that was open is not begun.
    Other,
}

#[test]
fn whatever_follows_an_order_that_asks_back_does_that_order_or_leaves_it() {
    let (mut wrong, mut tried) = (String::new(), 0);
    for map in MAPS {
        let Some(mut engine) = engine(map) else { return };
        let world = engine.world().unwrap().clone();
        let mut rooms = world.areas.values().filter(|area| !area.name_en.is_empty());
        let (room, other_room) = (rooms.next().unwrap(), rooms.next().unwrap());
        for language in [Language::English, Language::Russian] {
            let all = kinds(&world, language);
            let several = all.iter().filter(|kind| (2..4).contains(&kind.things.len()));
            let alone = all.iter().find(|kind| kind.things.len() == 1).expect("there are such");
            let kinds = several.take(if long() { 20 } else { 1 });
            for kind in kinds {
                let [first, second, ..] = &kind.things[..] else { unreachable!() };
                let whither = |room: Entity| match language {
                    Language::English => {
                        format!("to {}", orthoframe_language::names::english_name(&world, room))
                    }
                    Language::Russian => {
                        let phrase = NounPhrase::parse(world.name(room), &hints(&world, room));
                        format!("в {}", phrase.case(Case::Accusative))
                    }
                };
                let here = whither(Entity::Area(room.id));
                let there = whither(Entity::Area(other_room.id));
                let orders = match language {
                    Language::English => {
                        [format!("Bring {}", kind.said), format!("Take {} {here}", kind.said)]
                    }
                    Language::Russian => {
                        [format!("Принеси {}", kind.said), format!("Отнеси {} {here}", kind.said)]
                    }
                };
                let pick =
                    |russian: &'static str, english: &'static str| language.pick(russian, english);
                let lines: Vec<(String, Wanted<'_>)> = vec![
                    (second.name.clone(), Wanted::Done(second)),
                    (format!("{} {}", pick("Нет,", "No,"), second.carried), Wanted::Done(second)),
                    (pick("вторую", "the second one").to_owned(), Wanted::Done(second)),
                    (
                        pick("первое, пожалуйста", "the first one, please").to_owned(),
                        Wanted::Done(first),
                    ),
                    (
                        format!("{} {}", pick("Принеси", "Bring"), first.carried),
                        Wanted::Done(first),
                    ),
                    (format!("{} {there}", pick("Нет,", "No,")), Wanted::AskedAgain(other_room.id)),
                    (there.clone(), Wanted::AskedAgain(other_room.id)),
                    (
                        format!("{} {there}", pick("Лучше", "Actually,")),
                        Wanted::AskedAgain(other_room.id),
                    ),
                    (
                        format!("{} {}", pick("Нет,", "No,"), alone.said),
                        Wanted::Done(&alone.things[0]),
                    ),
                    (
                        pick("Положи на кровать зюзюблю", "Put the zorble on the bed").to_owned(),
                        Wanted::Left,
                    ),
                    (pick("Не надо", "Never mind").to_owned(), Wanted::Left),
                    (pick("Нет", "No").to_owned(), Wanted::Left),
                    // A name that was not asked about, and orders nothing.
                    (alone.things[0].name.clone(), Wanted::StillOpen),
                    (pick("зюзюбля", "zorble").to_owned(), Wanted::StillOpen),
                    (pick("Где ты?", "Where are you?").to_owned(), Wanted::StillOpen),
                    (format!("{} {there}", pick("Поезжай", "Go")), Wanted::Other),
                    (format!("{} {}", pick("Найди", "Find"), alone.said), Wanted::Other),
                ];
                for (order, (line, wanted)) in
                    orders.iter().flat_map(|order| lines.iter().map(move |line| (order, line)))
                {
                    // What waits for no answer is answered by nothing.
                    let reply = match wanted {
                        Wanted::Left => Some(pick("вторую", "the second one")),
                        Wanted::AskedAgain(_) | Wanted::StillOpen => Some(&*first.name),
                        Wanted::Done(_) | Wanted::Other => None,
                    };
                    let said: Vec<&str> = [&**order, line].into_iter().chain(reply).collect();
                    tried += 1;
                    let (words, goal) = came_of(&mut engine, &said);
                    let has = |thing: &Named| goal.contains(&thing.symbol);
                    let others = |but: Option<&Named>| {
                        kind.things.iter().any(|thing| {
                            but.is_none_or(|but| but.symbol != thing.symbol) && has(thing)
                        })
                    };
                    let asked = |words: &[&str]| words.contains(&"misheard");
                    let fits = asked(&words[0])
                        && match wanted {
                            Wanted::Done(thing) => has(thing) && !others(Some(thing)),
                            Wanted::AskedAgain(room) => {
                                asked(&words[1])
                                    && has(first)
                                    && !others(Some(first))
                                    && goal.iter().any(|arg| is_in(&world, arg, *room))
                            }
                            Wanted::Left => !others(None),
                            Wanted::StillOpen => has(first) && !others(Some(first)),
                            Wanted::Other => {
                                words[1].contains(&"not_begun") && !others(None) && !goal.is_empty()
                            }
                        };
                    if !fits {
                        writeln!(wrong, "{said:?}\n    {words:?} {goal:?}").unwrap();
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "of {tried}:\n{wrong}");
}

/// A line that takes back its order: only what it puts instead is done, or nothing.
#[test]
fn what_a_line_takes_back_is_not_done() {
    const ENGLISH: [&str; 9] = [
        "{o}. No, {x}",
        "{o}, no, {x}",
        "{o}. Actually, {x}.",
        "{o}, sorry, {x}",
        "{o}. No, wait, {x}",
        "{o}, I mean {x}",
        "{o} – or rather {x}",
        "{o}. Oh no, {x}!",
        "{o}, actually no, {x}",
    ];
    const RUSSIAN: [&str; 9] = [
        "{o}. Нет, {x}",
        "{o}, нет, {x}",
        "{o}. Лучше {x}.",
        "{o}, ой, {x}",
        "{o}. Стоп, нет, {x}",
        "{o}, точнее {x}",
        "{o}, то есть {x}",
        "{o}. Хотя нет, лучше {x}!",
        "{o}, извини, {x}",
    ];
    const NEVER: [&str; 6] = [
        "{o}, never mind",
        "{o}. No, don't.",
        "{o}. Cancel that.",
        "{o} – actually, don't",
        "{o}. No.",
        "{o}. Forget it",
    ];
    const NE_NADO: [&str; 6] = [
        "{o}, не надо",
        "{o}. Нет, не надо.",
        "{o}. Отмена.",
        "{o}! Хотя нет, не нужно.",
        "{o}. Стоп.",
        "{o}, передумал",
    ];
    let (mut wrong, mut tried) = (String::new(), 0);
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let heard = |line: &str| {
            let commands = engine.understand_in(line, &mut Memory::default()).ok()?;
            Some(format!("{commands:?}"))
        };
        let rooms: Vec<Entity> = world.areas.keys().map(|id| Entity::Area(*id)).collect();
        for language in [Language::English, Language::Russian] {
            let things: Vec<Named> =
                kinds(world, language).into_iter().flat_map(|kind| kind.things).collect();
            let to = |room: &Entity| named(world, *room, language).carried;
            let orders: Vec<(String, String, String)> = match language {
                Language::English => vec![
                    (
                        format!("Bring {}", things[0].name),
                        things[1].name.clone(),
                        format!("Bring {}", things[1].name),
                    ),
                    (
                        format!("Take {} to {}", things[0].name, to(&rooms[0])),
                        format!("to {}", to(&rooms[1])),
                        format!("Take {} to {}", things[0].name, to(&rooms[1])),
                    ),
                    (
                        format!("Take {} to {}", things[0].name, to(&rooms[0])),
                        to(&rooms[1]),
                        format!("Take {} to {}", things[0].name, to(&rooms[1])),
                    ),
                    (
                        format!("Go to {}", to(&rooms[0])),
                        format!("to {}", to(&rooms[1])),
                        format!("Go to {}", to(&rooms[1])),
                    ),
                    (
                        format!("Go to {}", to(&rooms[0])),
                        format!("bring {}", things[1].name),
                        format!("bring {}", things[1].name),
                    ),
                    (format!("Go to {}", to(&rooms[0])), "zorble".to_owned(), String::new()),
                ],
                Language::Russian => vec![
                    (
                        format!("Принеси {}", things[0].carried),
                        things[1].carried.clone(),
                        format!("Принеси {}", things[1].carried),
                    ),
                    (
                        format!("Отнеси {} в {}", things[0].carried, to(&rooms[0])),
                        format!("в {}", to(&rooms[1])),
                        format!("Отнеси {} в {}", things[0].carried, to(&rooms[1])),
                    ),
                    (
                        format!("Поезжай в {}", to(&rooms[0])),
                        format!("в {}", to(&rooms[1])),
                        format!("Поезжай в {}", to(&rooms[1])),
                    ),
                    (
                        format!("Поезжай в {}", to(&rooms[0])),
                        format!("принеси {}", things[1].carried),
                        format!("принеси {}", things[1].carried),
                    ),
                    (format!("Поезжай в {}", to(&rooms[0])), "зюзюблю".to_owned(), String::new()),
                ],
            };
            for (order, instead, meant) in &orders {
                for template in language.pick(RUSSIAN, ENGLISH) {
                    let line = template.replace("{o}", order).replace("{x}", instead);
                    tried += 1;
                    let (found, wanted) = (heard(&line), heard(meant));
                    if found != wanted.clone().filter(|_| !meant.is_empty()) {
                        writeln!(wrong, "{line}\n    {found:?}\n    {wanted:?}").unwrap();
                    }
                }
                for template in language.pick(NE_NADO, NEVER) {
                    let line = template.replace("{o}", order);
                    tried += 1;
                    let found = heard(&line);
                    if found.as_deref() != Some("[Stop]") {
                        writeln!(wrong, "{line}\n    {found:?}").unwrap();
                    }
                }
            }
        }
    }
    assert!(wrong.is_empty(), "of {tried}:\n{wrong}");
}

/// "Take it to the bath. And the plate too": the plate to the bath, whatever stood for what was carried.
#[test]
fn what_is_done_to_it_is_done_to_another_too() {
    let mut told = 0;
    for map in MAPS {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let things: Vec<Named> = kinds(world, Language::English)
            .into_iter()
            .filter(|kind| kind.things.len() == 1)
            .flat_map(|kind| kind.things)
            .take(6)
            .collect();
        let rooms: Vec<Named> = world
            .areas
            .keys()
            .map(|id| named(world, Entity::Area(*id), Language::English))
            .collect();
        for pair in things.windows(2) {
            for room in rooms.iter().take(3) {
                let mut memory = Memory::default();
                let mut hear = |line: &str| {
                    let whole = engine.resumed(line, &memory).unwrap();
                    engine.understand_in(whole.as_deref().unwrap_or(line), &mut memory)
                };
                if hear(&format!("Where is {}?", pair[0].name)).is_ok() {
                    continue;
                }
                hear(&format!("Take {}", pair[0].name)).unwrap();
                let first = hear(&format!("Take it to {}", room.name)).unwrap();
                let next = hear(&format!("And {} too", pair[1].name)).unwrap();
                assert_eq!(first[0].place(), next[0].place(), "{}", pair[1].name);
                let id = next[0].what().unwrap().id;
                assert_eq!(world.name(id), pair[1].symbol);
                told += 1;
            }
        }
    }
    assert!(told > 10, "{told}");
}
