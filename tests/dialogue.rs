//! The dialogue of the library: the same as on the command line, true to the map as it changes, and able to say what it
//! can be told.

use std::collections::BTreeSet;
use std::io::Write as _;
use std::process::Stdio;

use orthoframe::Engine;
use orthoframe::engine::{Dialogue, Event, Heard, Mode, Outcome, change_now, json};
use orthoframe_language::Language;
use orthoframe_map::{Entity, World};
use orthoframe_units::{Deg, ReplicaId};

use crate::planning_properties::random::Random;
use crate::worlds::rb2;

fn flat() -> Engine {
    Engine::in_memory(rb2(), None).unwrap()
}

fn hear(dialogue: &mut Dialogue, engine: &mut Engine, line: &str) -> Heard {
    dialogue.hear(engine, line, &mut |_, _| {}).unwrap_or_else(|e| panic!("{line}: {e}"))
}

fn words(heard: &Heard) -> Vec<&'static str> {
    heard.replies.iter().map(|reply| reply.outcome.word()).collect()
}

/// Lines of every sort that a dialogue knows, and what comes of them on the flat.
const LINES: [(&str, &[&str]); 30] = [
    ("Где лекарство?", &["found"]),
    ("Почему?", &["found"]),
    ("Закрой Дверь-ZZ", &["misheard"]),
    ("Почему?", &["found"]),
    ("пренеси зонт", &["not_understood"]),
    ("нет", &["stopped"]),
    ("пренеси зонт", &["not_understood"]),
    ("да", &["done"]),
    ("да", &["not_understood"]),
    ("Принеси чашку", &["misheard"]),
    ("стоп", &["stopped"]),
    ("Стоп", &["stopped"]),
    ("Принеси чашку", &["misheard"]),
    ("красную", &["done"]),
    ("Если Дверь-ZY открыта, закрой её", &["found", "done"]),
    ("Если Дверь-ZY открыта, закрой её", &["found", "waiting"]),
    ("Если Дверь-ZY блямкает, закрой её", &["unknown"]),
    ("Где стол в Комнате-Z? Поезжай к нему.", &["found", "done"]),
    ("Поезжай в Комнату-Y и скажи, где ты", &["done", "found"]),
    ("Принеси блям, и скажи, где ты", &["misheard"]),
    ("Возьми Шкаф-1. Открой Дверь-КY.", &["refused", "not_begun"]),
    ("Жди", &["waiting"]),
    ("Доложи, где ты", &["found"]),
    ("Что ты умеешь?", &["found"]),
    ("commands", &["found"]),
    ("Two books to Table 1, please", &["done"]),
    ("What did you do?", &["found"]),
    ("Спасибо", &["found"]),
    ("…", &["not_understood"]),
    ("Выход", &["ended"]),
];

/// Each sort of line comes to what it should; what is told as it happens is what is returned at the end; and the command
/// line and the library are one dialogue.
#[test]
fn every_sort_of_line_is_heard_alike_everywhere() {
    let dir = tempfile::tempdir().unwrap();
    let store = |name: &str| {
        let mut engine = Engine::open(&dir.path().join(name), None).unwrap();
        let map = crate::files::project("maps/rb2.toml");
        engine.import(&map, &change_now("test", "")).unwrap();
        engine
    };
    let (mut engine, mut dialogue) = (store("library"), Dialogue::default());
    let mut expected = Vec::new();
    for (line, outcomes) in LINES {
        let (mut told, mut steps) = (Vec::new(), 0);
        let heard = dialogue.hear(&mut engine, line, &mut |engine, event| match event {
            Event::Replied(reply) => {
                told.push(reply.text.clone());
                // What is replied is written as it is replied: proofs are of that moment.
                if !matches!(reply.outcome, Outcome::Ended) {
                    expected.push(json::reply(engine, reply).unwrap().to_string());
                }
            }
            Event::Progress { .. } => steps += event.in_words().len(),
            Event::Ordered(_) => {}
        });
        let heard = heard.unwrap();
        assert_eq!(words(&heard), outcomes, "{line}: {}", heard.text());
        let replies: Vec<&str> = heard.replies.iter().map(|reply| &*reply.text).collect();
        assert_eq!(told, replies, "{line}");
        let driven = heard.tasks().any(|task| !task.reports.is_empty());
        assert_eq!(driven, steps > 0, "{line}");
        assert_eq!((heard.ended(), heard.text().is_empty()), (line == "Выход", line == "Выход"));
    }
    drop(store("terminal"));
    let mut talk = crate::ortho()
        .args(["talk", "--json", "--store"])
        .arg(dir.path().join("terminal"))
        .env_remove("ORTHO_RULES")
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .spawn()
        .unwrap();
    let lines: String = LINES.map(|(line, _)| format!("{line}\n")).concat();
    talk.stdin.take().unwrap().write_all(lines.as_bytes()).unwrap();
    let output = talk.wait_with_output().unwrap();
    assert!(output.status.success());
    let told = String::from_utf8(output.stdout).unwrap();
    assert_eq!(told.lines().collect::<Vec<_>>(), expected);
}

/// What is offered as an example can be asked and ordered.
#[test]
fn help_offers_what_is_understood() {
    let spoken = [
        ("maps/rb2.toml", "Помощь"),
        ("maps/lab.toml", "help"),
        ("maps/two-storeys.toml", "Команды"),
    ];
    for (map, question) in spoken {
        let world = World::load(crate::files::project(map)).unwrap();
        let mut engine = Engine::in_memory(world, None).unwrap();
        let heard = hear(&mut Dialogue::default(), &mut engine, question);
        let text = heard.text();
        let quoted = |part: &'_ str| part.split_once('»').map(|(example, _)| example.to_owned());
        let examples: Vec<String> = match question {
            "help" => text.split('"').skip(1).step_by(2).map(str::to_owned).collect(),
            _ => text.split('«').skip(1).filter_map(quoted).collect(),
        };
        assert!(examples.len() >= 4, "{map}: {text}");
        for example in &examples {
            let heard = hear(&mut Dialogue::default(), &mut engine, example);
            let [reply] = &heard.replies[..] else { panic!("{map}: {example}") };
            let orders = !example.ends_with('?');
            let fits = match &reply.outcome {
                Outcome::Answered(_) => !orders,
                Outcome::Task(_) => orders,
                _ => false,
            };
            assert!(fits, "{map}: {example}: {}", reply.text);
        }
    }
}

fn replica(engine: &Engine, name: &str) -> ReplicaId {
    match engine.world().unwrap().find(name)[..] {
        [Entity::Replica(id)] => id,
        ref other => panic!("{name}: {other:?}"),
    }
}

fn edit(engine: &mut Engine, alter: impl FnOnce(&mut World)) {
    engine.edit_world(&change_now("test", "edit"), Mode::Commit, alter).unwrap();
}

fn remove(engine: &mut Engine, name: &str) {
    let id = replica(engine, name);
    edit(engine, |world| {
        world.replicas.remove(&id);
    });
}

/// A pronoun for what left the map is answered so, in questions and orders of both languages.
#[test]
fn a_pronoun_for_what_left_the_map_is_answered() {
    for (before, gone, after, expected) in [
        ("Где Чашка-1?", "Чашка-1", "Какого она цвета?", "Чашки-1 больше нет на карте."),
        ("Где Чашка-1?", "Чашка-1", "Принеси её", "Чашки-1 больше нет на карте."),
        ("Where is Cup 1?", "Чашка-1", "What colour is it?", "Cup 1 is no longer on the map."),
        ("Where is Cup 1?", "Чашка-1", "Bring it", "Cup 1 is no longer on the map."),
        ("Подъедь к Стулу-6", "Стул-6", "Какого он цвета?", "Стула-6 больше нет на карте."),
    ] {
        let (mut engine, mut dialogue) = (flat(), Dialogue::default());
        // Something older of the same gender is not taken for it.
        hear(&mut dialogue, &mut engine, "Где Книга-4?");
        hear(&mut dialogue, &mut engine, "Где Диван-1?");
        hear(&mut dialogue, &mut engine, before);
        remove(&mut engine, gone);
        let heard = hear(&mut dialogue, &mut engine, after);
        assert_eq!(heard.text(), expected, "{after}");
        assert_eq!(words(&heard).len(), 1);
    }
}

/// «Все» without a noun are those that were spoken of, and nobody's where nothing was; «всё» is everything there is.
#[test]
fn all_without_a_noun_are_those_that_were_spoken_of() {
    const DEVICES: [&str; 3] = ["Телевизор-1", "Лампа-1", "Лампа-2"];
    let dir = tempfile::tempdir().unwrap();
    let mut engine = Engine::open(&dir.path().join("store"), None).unwrap();
    engine.import(&crate::files::project("maps/rb2.toml"), &change_now("test", "")).unwrap();
    let said =
        |engine: &mut Engine, line: &str| hear(&mut Dialogue::default(), engine, line).text();
    let on = |engine: &mut Engine| {
        let is_on = |d: &&str| said(engine, &format!("{d} включён?")).starts_with("Да");
        DEVICES.into_iter().filter(is_on).collect::<Vec<_>>()
    };
    for (spoken, order, left) in [
        (None, "Выключи все", vec!["Телевизор-1", "Лампа-1"]),
        (Some("Где Лампа-1?"), "Выключи все", vec!["Телевизор-1"]),
        (Some("Лампа-1 включена?"), "Пожалуйста, выключи все", vec!["Телевизор-1"]),
        (Some("Где Лампа-1?"), "Выключи всё", vec![]),
        (Some("Where is Lamp 1?"), "Turn everything off", vec![]),
    ] {
        said(&mut engine, "Включи Телевизор-1");
        said(&mut engine, "Включи Лампу-1");
        assert_eq!(on(&mut engine), ["Телевизор-1", "Лампа-1"]);
        let mut dialogue = Dialogue::default();
        if let Some(line) = spoken {
            assert!(hear(&mut dialogue, &mut engine, line).text().contains("1"), "{line}");
        }
        let heard = hear(&mut dialogue, &mut engine, order).text();
        assert_eq!(on(&mut engine), left, "{order}: {heard}");
    }
}

/// Another thing that later bears the id of one that left is not it; one that was renamed is the same.
#[test]
fn an_id_is_no_thing() {
    let (mut engine, mut dialogue) = (flat(), Dialogue::default());
    let id = replica(&engine, "Чашка-1");
    hear(&mut dialogue, &mut engine, "Где Чашка-1?");
    let other = engine.world().unwrap().replicas[&replica(&engine, "Книга-5")].clone();
    remove(&mut engine, "Чашка-1");
    edit(&mut engine, |world| {
        let other = orthoframe_map::Replica {
            id,
            name: "Сумка-7".to_owned(),
            name_en: String::new(),
            ..other
        };
        world.replicas.insert(id, other);
    });
    let told = hear(&mut dialogue, &mut engine, "Где она?").text();
    assert_eq!(told, "Чашки-1 больше нет на карте.");
    hear(&mut dialogue, &mut engine, "Где Книга-4?");
    let id = replica(&engine, "Книга-4");
    edit(&mut engine, |world| {
        world.replicas.get_mut(&id).unwrap().name = "Азбука".to_owned();
    });
    let told = hear(&mut dialogue, &mut engine, "Где она?").text();
    assert!(told.contains("Азбука") || told.contains("Она"), "{told}");
    assert_eq!(hear(&mut dialogue, &mut engine, "Где Диван-1?").replies.len(), 1);
    edit(&mut engine, |world| {
        world.replicas.get_mut(&id).unwrap().name = "Букварь".to_owned();
    });
    let told = hear(&mut dialogue, &mut engine, "Почему?").text();
    assert_eq!(told, "С тех пор на карте что-то изменилось: спросите ещё раз.");
}

/// A map that is replaced leaves nothing of what was said about the one before.
#[test]
fn another_map_is_another_talk() {
    let dir = tempfile::tempdir().unwrap();
    for kept in [true, false] {
        let mut engine = match kept {
            true => Engine::open(&dir.path().join("store"), None).unwrap(),
            false => flat(),
        };
        let import = |engine: &mut Engine, map: &str| {
            engine.import(&crate::files::project(map), &change_now("test", "")).unwrap();
        };
        import(&mut engine, "maps/rb2.toml");
        let mut dialogue = Dialogue::default();
        hear(&mut dialogue, &mut engine, "Где Чашка-1?");
        import(&mut engine, "maps/lab.toml");
        for line in ["Где она?", "Принеси её", "Почему?", "А стул?", "Вернись"]
        {
            let heard = hear(&mut dialogue, &mut engine, line);
            assert!(heard.tasks().next().is_none(), "{kept}: {line}: {}", heard.text());
        }
    }
}

/// Edits at random between the lines of a dialogue: nothing breaks, and no answer is about what was removed.
#[test]
fn a_dialogue_outlives_edits() {
    const SPOKEN: [&str; 24] = [
        "Где {}?",
        "Какого цвета {}?",
        "Что стоит рядом с {}?",
        "Что на столе в Комнате-В?",
        "Какие стулья в Комнате-Z?",
        "Сколько книг в доме?",
        "А чашка?",
        "А в Комнате-Y?",
        "Где она?",
        "Где он?",
        "Какого они цвета?",
        "Что там ещё?",
        "Почему?",
        "Почему нет?",
        "Где вторая?",
        "вторую",
        "Какая чашка ближе к окну?",
        "Принеси чашку",
        "Подъедь к нему",
        "Подъедь к ней",
        "А теперь к другой",
        "Какие двери ведут из Комнаты-В?",
        "Куда ведёт вторая?",
        "What is next to it?",
    ];
    let mut heard_before: Vec<Heard> = Vec::new();
    let seeds = if crate::files::long() { 60 } else { 3 };
    let (mut told_gone, mut answered) = (0, 0);
    for seed in 0..seeds {
        let mut random = Random::new(seed);
        let (mut engine, mut dialogue) = (flat(), Dialogue::new(Language::Russian));
        let mut removed: BTreeSet<String> = BTreeSet::new();
        for _ in 0..24 {
            let things: Vec<ReplicaId> = engine.world().unwrap().replicas.keys().copied().collect();
            let some = things[random.below(things.len())];
            let name = engine.world().unwrap().replicas[&some].name.clone();
            let line = SPOKEN[random.below(SPOKEN.len())].replace("{}", &name);
            let heard = hear(&mut dialogue, &mut engine, &line);
            for reply in &heard.replies {
                let about = match &reply.outcome {
                    Outcome::Answered(answer) => {
                        answered += 1;
                        [&answer.symbols[..], std::slice::from_ref(&reply.text)].concat()
                    }
                    Outcome::Task(task) => task.goal.iter().flat_map(|g| g.args.clone()).collect(),
                    Outcome::Unanswered(_) | Outcome::Misheard(_) => {
                        told_gone += usize::from(reply.text.contains("больше нет на карте"));
                        continue;
                    }
                    _ => continue,
                };
                for gone in &removed {
                    let names = |text: &String| {
                        text == gone || text.split([' ', ',', '.', '?']).any(|word| word == gone)
                    };
                    assert!(!about.iter().any(names), "{seed}: {line}: {}: {gone}", reply.text);
                }
                json::reply(&engine, reply).unwrap();
            }
            // What was kept from before an edit is still told without harm.
            for old in heard_before.iter().rev().take(3) {
                json::heard(&engine, old).unwrap();
            }
            heard_before.push(heard);
            // What was just spoken of is edited as often as anything else.
            let spoken = dialogue.memory().last_thing().and_then(|thing| thing.replica());
            let id =
                spoken.filter(|id| random.below(2) == 0 && things.contains(id)).unwrap_or(some);
            let name = engine.world().unwrap().replicas[&id].name.clone();
            let after = match random.below(4) {
                0 => {
                    let done = engine.edit_world(&change_now("t", ""), Mode::Commit, |world| {
                        world.replicas.remove(&id);
                    });
                    // What the map still needs stays.
                    if done.is_ok() {
                        removed.insert(name);
                    }
                    done
                }
                1 => {
                    let new = format!("Вещица-{}", random.below(1000));
                    removed.remove(&new);
                    let done = engine.edit_world(&change_now("t", ""), Mode::Commit, |world| {
                        world.replicas.get_mut(&id).unwrap().name = new.clone();
                    });
                    if done.is_ok() {
                        removed.insert(name);
                    }
                    done
                }
                2 => engine.edit_world(&change_now("t", ""), Mode::Commit, |world| {
                    world.replicas.get_mut(&id).unwrap().frame.angle = Deg::new(90.0).unwrap();
                }),
                _ => continue,
            };
            drop(after);
        }
    }
    assert!(answered > 5 && told_gone > 2, "{answered} answered, {told_gone} told to be gone");
}

/// An order for which there is no plan changes nothing: what was told of it is the reason.
#[test]
fn after_an_order_that_has_no_plan_why_tells_the_reason() {
    let mut engine = flat();
    let mut dialogue = Dialogue::default();
    let told = hear(&mut dialogue, &mut engine, "Запри Дверь-ZY");
    assert!(told.replies[0].outcome.has_failed(), "{:?}", words(&told));
    let why = hear(&mut dialogue, &mut engine, "Почему?");
    let text = &why.replies[0].text;
    assert!(text.starts_with("Вот причина: ") && text.contains("КЛЮЧ"), "{text}");
}

/// "Never mind the chairs, where are the books?": what stops a line is no answer to what it asks.
#[test]
fn a_question_behind_what_stops_is_answered() {
    let mut told = 0;
    for question in
        ["Where are the books?", "What is on Table 1?", "Где книги?", "Сколько стульев в кухне?"]
    {
        let (mut engine, mut dialogue) = (flat(), Dialogue::new(Language::Russian));
        let plain = hear(&mut dialogue, &mut engine, question).text();
        let lower = question.chars().next().unwrap().to_lowercase().collect::<String>()
            + &question.chars().skip(1).collect::<String>();
        for before in ["Never mind the plates, ", "Stop, ", "Стоп, ", "Неважно, "] {
            let (mut engine, mut dialogue) = (flat(), Dialogue::new(Language::Russian));
            let heard = hear(&mut dialogue, &mut engine, &format!("{before}{lower}"));
            assert_ne!(words(&heard), ["stopped"], "{before}{lower}");
            told += usize::from(heard.text().ends_with(&plain));
        }
    }
    assert!(told >= 12, "{told}");
    // Alone it stops.
    let (mut engine, mut dialogue) = (flat(), Dialogue::new(Language::English));
    assert_eq!(words(&hear(&mut dialogue, &mut engine, "Never mind the plates.")), ["stopped"]);
}
