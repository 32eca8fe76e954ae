//! Orders as people put them together: conditions, what is left out, where to stand and what to look at; and what the
//! map says of light and keys, in the plans that come of them.

use std::fmt::Write as _;

use orthoframe::Engine;
use orthoframe::engine::{Memory, TaskAnswer, TaskEnding};
use orthoframe_language::Language;
use orthoframe_language::command::preamble;
use orthoframe_map::{DoorState, Entity, World};
use orthoframe_robot::GoalFact;
use orthoframe_units::Deg;

fn lab() -> World {
    World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/maps/lab.toml")).unwrap()
}

fn perform(world: &World, order: &str) -> TaskAnswer {
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    engine.perform(order, &mut |_| {}).unwrap_or_else(|e| panic!("{order}: {e}"))
}

fn actions(answer: &TaskAnswer) -> Vec<&str> {
    let carried = answer.reports.iter().map(|r| r.directive.action.as_ref());
    carried.filter(|action: &&str| !action.starts_with("Движение")).collect()
}

fn golden(world: &World, text: &str, path: &str) {
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let goals = |order: &str| match engine.perform(order, &mut |_| {}) {
        Ok(answer) => {
            let said = |g: &GoalFact| format!("{}({})", g.predicate, g.args.join(", "));
            answer.goal.iter().map(said).collect::<Vec<_>>().join("; ")
        }
        Err(error) => error.say(Language::of(order)),
    };
    let said: String = text
        .lines()
        .filter(|line| !line.starts_with("    ") && !line.is_empty())
        .map(|line| format!("{line}\n    {}\n", goals(line)))
        .collect();
    expect_test::expect_file![path].assert_eq(&said);
}

#[test]
fn orders_put_together_mean_what_they_say() {
    let folder = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/commands");
    let lab_orders = include_str!("golden/commands/orders-lab.txt");
    golden(&lab(), lab_orders, &format!("{folder}/orders-lab.txt"));
    let flat = include_str!("golden/commands/orders-rb2.txt");
    golden(&crate::worlds::rb2(), flat, &format!("{folder}/orders-rb2.txt"));
}

#[test]
fn orders_in_an_imported_house_mean_what_they_say() {
    let Some(house) = crate::talk::engine("../shared/data/procthor/house_6.json") else { return };
    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/tests/golden/commands/orders-house6.txt");
    golden(house.world().unwrap(), include_str!("golden/commands/orders-house6.txt"), path);
}

/// A room that the map says is dark is looked over by the light of its lamp.
#[test]
fn a_dark_room_is_lit_before_it_is_looked_over() {
    let mut world = lab();
    let office = world.find("Office")[0];
    let Entity::Area(office) = office else { panic!("{office:?}") };
    let order = "Find the battery";
    let sought = ["Открыть-дверь", "Осмотреть", "Искать"];
    assert_eq!(actions(&perform(&world, order)), sought);
    let properties = &mut world.areas.get_mut(&office).unwrap().properties;
    properties.insert("light".to_owned(), "off".to_owned());
    let answer = perform(&world, order);
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    assert_eq!(actions(&answer), ["Открыть-дверь", "Включить-свет", "Осмотреть", "Искать"]);
    // Without a lamp there is no plan.
    let lamp = world.find("Lamp 1")[0];
    let Entity::Replica(lamp) = lamp else { panic!("{lamp:?}") };
    world.replicas.remove(&lamp);
    assert!(matches!(perform(&world, order).ending, TaskEnding::NoPlan(_)));
}

/// Who has the key of a door is asked to unlock it; nobody else is.
#[test]
fn whoever_has_the_key_is_asked_to_unlock() {
    let mut world = lab();
    let door = world.find("Office door")[0];
    let Entity::Door(door) = door else { panic!("{door:?}") };
    let locked = world.doors.get_mut(&door).unwrap();
    locked.state = DoorState::LOCKED;
    assert!(matches!(perform(&world, "Bring the battery").ending, TaskEnding::NoPlan(_)));
    for holder in ["operator", "Оператор"] {
        let properties = &mut world.doors.get_mut(&door).unwrap().properties;
        properties.insert("key_with".to_owned(), holder.to_owned());
        let answer = perform(&world, "Bring the battery");
        assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
        assert_eq!(actions(&answer)[..2], ["Позвать-оператора", "Открыть-дверь"]);
        let told = answer.reports.iter();
        let told = told.flat_map(|r| r.actions_in_words(&world, Language::English));
        assert!(
            told.into_iter().any(|said| said == "Please come to me and unlock the office door.")
        );
    }
}

/// Where the robot is told to look it looks, and in the middle it stands in the middle.
#[test]
fn it_stands_and_looks_as_it_is_told() {
    let world = lab();
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let bench = engine.locate_entity(world.find("Workbench 1")[0]).unwrap();
    let answer = perform(&world, "Drive into the middle of the lab, facing the workbench");
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    let away = bench.at - answer.end.at;
    assert!(away.norm() > 60.0, "it stays in the middle: {away}");
    let off = (Deg::from_radians(away.y.atan2(away.x)) - answer.end.heading).signed().abs();
    assert!(off < 30.0, "{off}° aside of the place before the bench");
    let answer = perform(&world, "Stand in the corridor between the two doors");
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
}

/// A condition is looked up in the world as it is, and decides.
#[test]
fn a_condition_decides_what_is_done() {
    let mut world = lab();
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    let heard = |engine: &Engine, order: &str| {
        let commands = engine.understand_in(order, &mut Memory::default()).unwrap();
        format!("{commands:?}").chars().take_while(|c| *c != '(' && *c != ' ').collect::<String>()
    };
    let order = "If the office door is closed, open it, otherwise close the lab door";
    assert_eq!(heard(&engine, order), "[Open");
    let unless = "Bring the battery unless the office door is closed";
    assert_eq!(heard(&engine, unless), "[Wait]");
    let door = world.find("Office door")[0];
    let Entity::Door(door) = door else { panic!("{door:?}") };
    world.doors.get_mut(&door).unwrap().state = DoorState::OPEN;
    let engine = Engine::in_memory(world, None).unwrap();
    assert_eq!(heard(&engine, order), "[Close");
    assert_eq!(heard(&engine, unless), "[Bring");
}

/// What cannot be put away is told, and the others are put away all the same.
#[test]
fn what_cannot_be_put_away_lets_the_rest_be_tidied() {
    let mut world = crate::worlds::rb2();
    for door in ["Дверь-ZY", "Дверь-КY"] {
        let Entity::Door(id) = world.find(door)[0] else { panic!("{door}") };
        world.doors.get_mut(&id).unwrap().state = DoorState::LOCKED;
    }
    // By their names the book comes first; the bedroom, where it is kept, is locked.
    for (thing, on) in [("Книга-4", "Комод-1"), ("Чашка-1", "Письменный стол")]
    {
        let Entity::Replica(id) = world.find(thing)[0] else { panic!("{thing}") };
        let properties = &mut world.replicas.get_mut(&id).unwrap().properties;
        properties.insert("ХРАНИТСЯ_НА".to_owned(), on.to_owned());
    }
    let answer = perform(&world, "Приберись в гостиной");
    assert!(matches!(answer.ending, TaskEnding::Done), "{:?}", answer.ending);
    let left: Vec<&str> = answer.left.iter().map(|(goal, _)| goal.args[0].as_str()).collect();
    assert_eq!(left, ["Книга-4"]);
    assert_eq!(actions(&answer).last(), Some(&"Вернуть-на-место"));
}

/// Whither it is told to look the robot looks: a window and a wall have no names of their own.
#[test]
fn it_turns_to_windows_and_walls() {
    let world = crate::worlds::rb2();
    let engine = Engine::in_memory(world.clone(), None).unwrap();
    for (order, facing) in [
        ("Повернись к окну", "лицом к окну"),
        ("Встань в спальне лицом к окну", "лицом к окну"),
        ("Face the wall", "лицом к стене"),
    ] {
        let answer = perform(&world, order);
        assert!(matches!(answer.ending, TaskEnding::Done), "{order}: {:?}", answer.ending);
        let place = &answer.goal[0].args[0];
        assert!(place.contains(&facing.replace(' ', "-")), "{order}: {place}");
        let found = engine.locate(answer.end_map, answer.end, true).unwrap();
        let told = found.position.say(Language::Russian);
        assert!(told.contains("лицом к ") && !told.contains("лицом внутрь"), "{order}: {told}");
    }
}

/// Numbers from a seed, one after the other.
fn dice(mut seed: u64) -> impl FnMut(usize) -> usize {
    move |below| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(seed >> 33).unwrap() % below
    }
}

/// What an order comes to; none where it is refused or asked back.
fn heard(engine: &Engine, order: &str) -> Option<String> {
    let commands = engine.understand(order).ok()?;
    Some(commands.iter().map(|command| format!("{command:?};")).collect())
}

/// Of every order of the golden texts: with a number, a word that nobody knows, a value or a name more, it is not
/// carried out as if that had not been said. What is said not to be meant, and what depends on the world, is left aside.
/// `ORTHOFRAME_LONG` tries every order and every place of a sentence instead of some.
#[test]
fn no_word_of_an_order_is_passed_over() {
    const NOT_MEANT: [&str; 18] = [
        "не",
        "not",
        "don't",
        "instead",
        "вместо",
        "rather",
        "no",
        "нет",
        "точнее",
        "если",
        "if",
        "until",
        "пока",
        "когда",
        "when",
        "unless",
        "leave",
        "как",
    ];
    let flat = crate::worlds::rb2();
    let golden = [
        (flat.clone(), include_str!("golden/commands/orders-rb2.txt"), "Стеллаж-1"),
        (flat, include_str!("golden/commands/spoken-rb2.txt"), "Стеллаж-1"),
        (lab(), include_str!("golden/commands/orders-lab.txt"), "Shelf 1"),
    ];
    let all = crate::files::long();
    let mut roll = dice(24);
    let (mut tried, mut passed_over) = (0, String::new());
    for (world, text, name) in golden {
        let engine = Engine::in_memory(world, None).unwrap();
        let orders = text.lines().filter(|line| !line.starts_with("    ") && !line.is_empty());
        for order in orders {
            let words: Vec<&str> = order.split(' ').collect();
            let key =
                |word: &&str| word.trim_matches(|c: char| !c.is_alphanumeric()).to_lowercase();
            let words_of = words.iter().map(key).collect::<Vec<_>>();
            let not_meant = words_of.iter().any(|word| NOT_MEANT.contains(&word.as_str()));
            if not_meant || order.contains(name) || preamble(order).is_some() {
                continue;
            }
            // In the ordinary run one order of three.
            if !all && roll(3) > 0 {
                continue;
            }
            let Some(meant) = heard(&engine, order) else { continue };
            let russian = Language::of(order) == Language::Russian;
            let more = match russian {
                true => ["77", "зюзюблую", "фиолетовую", name],
                false => ["77", "zorblax", "purple", name],
            };
            let places = match all {
                true => (1..=words.len()).collect::<Vec<_>>(),
                false => vec![1 + roll(words.len()), words.len()],
            };
            for at in places {
                let own = if all { &more[..] } else { &more[roll(more.len())..][..1] };
                for said in own {
                    let mut longer = words.clone();
                    let last = longer[at - 1].trim_end_matches(['.', '!', ',']).to_owned();
                    let mark = &longer[at - 1][last.len()..];
                    let put = format!("{last} {said}{mark}");
                    longer[at - 1] = &put;
                    let longer = longer.join(" ");
                    tried += 1;
                    if heard(&engine, &longer).as_ref() == Some(&meant) {
                        writeln!(passed_over, "{longer}").unwrap();
                    }
                }
            }
        }
    }
    assert!(tried > if all { 1000 } else { 50 }, "{tried}");
    assert!(passed_over.is_empty(), "of {tried}:\n{passed_over}");
}

/// The cases by which the fault was found, and others of its kind.
#[test]
fn a_number_or_value_that_nothing_has_is_no_small_word() {
    let (lab, flat) = (lab(), crate::worlds::rb2());
    let (lab, flat) =
        (Engine::in_memory(lab, None).unwrap(), Engine::in_memory(flat, None).unwrap());
    for order in [
        "Go to Office 7",
        "Bring battery 5",
        "Bring the empty battery",
        "Put the battery on desk 2",
        "Bring the battery from desk 7",
        "Bring the battery home",
        "Charge the battery",
        "Go office lab",
        "Open the lab door 3",
        "Bring a battery of acid",
        "Put the battery on the 2 desks",
        "Bring all batteries except the purple one",
        "Bring Battery 1 except the blue one",
        "Go to the office, not entering the lab",
        "Go to the office, not opening the office door",
    ] {
        assert!(lab.understand(order).is_err(), "{order}: {:?}", lab.understand(order));
    }
    for order in [
        "Поезжай в спальню 3",
        "Принеси красную чашку 7",
        "Принеси белую чашку 2",
        "Принеси белую чашку чая",
        "Принеси зонт Марии",
        "Положи зонт на кровать 2",
        "Включи торшер 8",
        "Принеси все чашки 2",
        "Принеси каждую книгу 4",
        "Принеси 4 книгу",
        "Включи 2 лампу",
        "Принеси обе книги",
        "Закрой обе двери",
        "Закрой все 2 двери",
        "Принеси все три чашки",
        "Принеси все чашки, кроме фиолетовой",
        "Поезжай в Комнату-Y, не заезжая в Комнату-Z",
        "Поезжай в Комнату-Y, не открывая Дверь-ZY",
    ] {
        assert!(flat.understand(order).is_err(), "{order}: {:?}", flat.understand(order));
    }
    // What its name says is no number too many.
    for order in [
        "Принеси красную чашку 2",
        "Принеси книгу 4",
        "Подъедь к шкафу 2",
        "Принеси обе чашки",
        "Принеси 4 книги",
        "Принеси чашки 1 и 2",
        "Закрой все три двери",
        "Поезжай в Комнату-Y, не в Комнату-Z",
    ] {
        assert!(flat.understand(order).is_ok(), "{order}: {:?}", flat.understand(order).err());
    }
}

/// Whatever two things an order names, it does something to both, or is refused: the map's own names in every pair and in
/// every manner of bidding.
#[test]
fn of_two_things_that_are_named_none_is_passed_over() {
    const ENGLISH: [&str; 8] = [
        "Bring {a} {b}",
        "Bring me {a} {b}",
        "Bring us the {a} the {b}",
        "Give me {a}, {b}",
        "Fetch me please {a} {b}",
        "Take {a} and {b}",
        "Find {a} {b} for me",
        "Bring me {a} and {b}",
    ];
    const RUSSIAN: [&str; 6] = [
        "Принеси {a} {b}",
        "Принеси мне {a} {b}",
        "Дай нам, пожалуйста, {a}, {b}",
        "Возьми {a} и {b}",
        "{a} {b} принеси мне",
        "Найди мне {a} {b}",
    ];
    let (mut both, mut passed_over) = (0, String::new());
    for (world, bids) in [(lab(), &ENGLISH[..]), (crate::worlds::rb2(), &RUSSIAN[..])] {
        let engine = Engine::in_memory(world.clone(), None).unwrap();
        let portable: Vec<_> =
            world.replicas.values().filter(|r| world.has_trait(r.id, "portable")).collect();
        let mut roll = dice(7);
        for _ in 0..12 {
            let (a, b) = (portable[roll(portable.len())], portable[roll(portable.len())]);
            if a.id == b.id {
                continue;
            }
            for bid in bids {
                let order = bid.replace("{a}", &a.name).replace("{b}", &b.name);
                let Ok(commands) = engine.understand(&order) else { continue };
                let said = format!("{commands:?}");
                let done = |id| said.contains(&format!("{:?}", Entity::Replica(id)));
                match done(a.id) && done(b.id) {
                    true => both += 1,
                    false => writeln!(passed_over, "{order}\n    {said}").unwrap(),
                }
            }
        }
    }
    assert!(passed_over.is_empty(), "{passed_over}");
    assert!(both > 20, "{both}");
}

/// What is cleared and stays is cleared of what is on it; what can be carried is put away itself.
#[test]
fn a_table_is_cleared_and_a_cup_is_put_away() {
    let engine = Engine::in_memory(lab(), None).unwrap();
    for (order, wanted) in [
        ("Clear the desk", "Clear { from: Replica"),
        ("Clear up the lab", "Clear { from: Area"),
        ("Clear away Battery 1", "PutAway("),
    ] {
        let said = format!("{:?}", engine.understand(order).unwrap());
        assert!(said.contains(wanted), "{order}: {said}");
    }
    // What is on it is kept there: nobody said where it should go instead.
    let engine = Engine::in_memory(lab(), None).unwrap();
    let refused = engine.perform("Clear the desk", &mut |_| {}).unwrap_err();
    let said = refused.say(Language::English);
    assert!(said.contains("kept there: Battery 1"), "{said}");
}

/// Whether an utterance can be followed in all its parts, as `do` and `talk` read it before anything is begun; else what
/// is said against it.
fn read(engine: &Engine, text: &str) -> Result<(), String> {
    let error = match engine.parts_of(text, &Memory::default()).unwrap() {
        Some(parts) => engine.read_ahead(&parts, &Memory::default()).err(),
        None => engine.understand(text).err(),
    };
    error.map_or(Ok(()), |e| Err(e.say(Language::of(text))))
}

/// Two orders in one sentence are both done, or the sentence is refused; where one half cannot be followed, nothing is
/// begun, and what is said names that half. `ORTHOFRAME_LONG` tries all pairs instead of some.
#[test]
fn neither_half_of_an_order_is_passed_over() {
    const BAD_RUSSIAN: &[&str] = &[
        "выключи Лампу-77",
        "выключи зюзюблю",
        "поезжай в Комнату-77",
        "открой Дверь-77",
        "принеси зюзюблю",
        "зюзюкни 77",
        "скажи, где зюзюбля",
    ];
    const BAD_ENGLISH: &[&str] = &[
        "turn off Lamp 77",
        "switch off the frobnicator",
        "go to Room 77",
        "open Door 77",
        "bring the frobnicator",
        "zorble the frobnicator",
        "tell me where the frobnicator is",
    ];
    /// Of these words one is said where a half is refused.
    const NAMED: [&str; 4] = ["77", "зюзю", "frobnicator", "zorble"];
    let all = crate::files::long();
    let orders: [(World, &[&str], &[&str]); 3] = [
        (
            lab(),
            &[
                "turn on Lamp 1",
                "turn off Lamp 1",
                "open the office door",
                "close the lab door",
                "lock the lab door",
                "unlock the office door",
                "bring Battery 1",
                "put Toolbox 1 on Desk 1",
                "go to the office",
                "go to Workbench 1",
                "find Toolbox 1",
                "call the operator",
                "tidy the lab",
                "take Battery 1",
            ],
            &[" and ", ", then ", ". ", ", ", "; ", " and then "],
        ),
        (
            crate::worlds::rb2(),
            &[
                "включи Торшер-1",
                "выключи Лампу-1",
                "открой Дверь-КY",
                "закрой Дверь-ВZ",
                "запри Дверь-ZY",
                "принеси Чашку-2",
                "положи Книгу-4 на Комод-1",
                "поезжай в Комнату-Z",
                "подъедь к Шкафу-2",
                "найди Зонт-1",
                "позови оператора",
                "верни Вазу-1 на место",
                "возьми Зонт-1",
            ],
            &[" и ", ", потом ", ". ", ", ", "; ", ", а "],
        ),
        (
            crate::worlds::rb2(),
            &[
                "switch on Lamp 1",
                "switch off Lamp 2",
                "bring Cup 1",
                "go to Room Z",
                "open Door KY",
            ],
            &[" and ", ", but ", ". "],
        ),
    ];
    let mut roll = dice(12);
    let (mut tried, mut both, mut passed_over) = (0, 0, String::new());
    for (world, orders, joints) in orders {
        let engine = Engine::in_memory(world, None).unwrap();
        let alone: Vec<String> =
            orders.iter().map(|order| heard(&engine, order).expect("understood alone")).collect();
        for (n, first) in orders.iter().enumerate() {
            for (m, second) in orders.iter().enumerate().filter(|(m, _)| *m != n) {
                if !all && roll(4) > 0 {
                    continue;
                }
                let joint = joints[roll(joints.len())];
                let sentence = format!("{first}{joint}{second}");
                tried += 1;
                let Some(heard_both) = heard(&engine, &sentence) else { continue };
                let wanted = format!("{}{}", alone[n], alone[m]);
                both += usize::from(heard_both == wanted);
                if heard_both != wanted {
                    writeln!(passed_over, "{sentence}\n    {heard_both}\n    {wanted}").unwrap();
                }
                // No order is taken for a question.
                if let Some(parts) = engine.parts_of(&sentence, &Memory::default()).unwrap() {
                    writeln!(passed_over, "{sentence}\n    {parts:?}").unwrap();
                }
            }
        }
        let bad = match Language::of(orders[0]) {
            Language::Russian => BAD_RUSSIAN,
            Language::English => BAD_ENGLISH,
        };
        for sound in orders {
            for bad in bad {
                let joint = joints[roll(joints.len())];
                // What stands before a mark and is no order may tell something: "It is dark, switch on the lamp".
                let tells = ["zorble", "зюзюкни"].iter().any(|w| bad.starts_with(w));
                let before = if tells { joints[0] } else { joint };
                for sentence in [format!("{sound}{joint}{bad}"), format!("{bad}{before}{sound}")] {
                    if !all && roll(4) > 0 {
                        continue;
                    }
                    let told = read(&engine, &sentence);
                    // Of a half that stands first it may be asked which of several is meant.
                    let first = sentence.starts_with(*bad);
                    let named = told.as_ref().is_err_and(|why| {
                        first || NAMED.iter().any(|word| bad.contains(word) && why.contains(word))
                    });
                    if !named {
                        writeln!(passed_over, "{sentence}\n    {told:?}").unwrap();
                    }
                }
            }
        }
    }
    assert!(passed_over.is_empty(), "{passed_over}");
    assert!(both * 10 > tried * 7, "{both} of {tried}: a refusal is cheap, but no answer to all");
}

/// The cases by which the fault was found, and what is asked behind an order.
#[test]
fn all_parts_are_read_before_the_first_is_begun() {
    let engine = Engine::in_memory(crate::worlds::rb2(), None).unwrap();
    for (text, named) in [
        ("Turn on Lamp 1 and turn off Lamp 77", "Lamp 77"),
        ("Turn on Lamp 1. Where is Cup 77?", "Cup 77"),
        ("Turn on Lamp 1 and tell me where Cup 77 is", "Cup 77"),
        ("Включи Лампу-1 и выключи Лампу-77", "77"),
        ("Включи Лампу-1. Где Чашка-77?", "77"),
        ("Включи Лампу-1 и скажи, где Чашка-77", "77"),
        ("Скажи, где Чашка-77, и включи Лампу-1", "77"),
    ] {
        let told = read(&engine, text).expect_err(text);
        assert!(told.contains(named), "{text}: {told}");
    }
    for (text, parts) in [
        ("Go to the bedroom and tell me what you see", 2),
        ("Поезжай в спальню и скажи, что ты видишь", 2),
        ("Turn on Lamp 1 and tell me where Cup 1 is", 2),
        ("Turn on Lamp 1. Where is Cup 1?", 2),
        ("Скажи, где Чашка-1, и принеси её", 2),
    ] {
        let found = engine.parts_of(text, &Memory::default()).unwrap().expect(text);
        assert_eq!(found.len(), parts, "{text}: {found:?}");
        assert_eq!(read(&engine, text), Ok(()), "{text}: {found:?}");
    }
}

/// To close is no more than that: what is locked stays so, and what is so already does not take its neighbour's goal
/// along.
#[test]
fn closing_never_unlocks() {
    let mut world = lab();
    let Entity::Door(office) = world.find("Office door")[0] else { panic!() };
    world.doors.get_mut(&office).unwrap().state = DoorState::LOCKED;
    assert!(perform(&world, "Close the office door").goal.is_empty());
    let closed: Vec<String> = perform(&world, "Close the office door and close the lab door")
        .goal
        .iter()
        .map(|g| format!("{} {}", g.predicate, g.args[0]))
        .collect();
    assert!(!closed.is_empty() && closed.iter().all(|g| g.ends_with(" Lab door")), "{closed:?}");
    let every = perform(&world, "Close all doors").goal;
    assert!(!every.is_empty() && every.iter().all(|g| g.args[0] == "Lab door"), "{every:?}");
    // Locked by the same sentence, it stays locked.
    let engine = Engine::in_memory(lab(), None).unwrap();
    let both = engine.perform("Lock the lab door and close it", &mut |_| {}).unwrap();
    assert!(both.goal.iter().all(|g| g.predicate.contains("ЗАПЕРТА")), "{:?}", both.goal);
    // What needs no unlocking drops no other goal.
    let unlocked = perform(&lab(), "Unlock the lab door and turn on Lamp 1").goal;
    assert_eq!(unlocked.len(), 1, "{unlocked:?}");
}

/// «Закрой все двери» means those that a hand shuts; a lift sees to its own.
#[test]
fn all_doors_are_no_lift_doors() {
    let map = concat!(env!("CARGO_MANIFEST_DIR"), "/maps/two-storeys.toml");
    let engine = Engine::in_memory(World::load(map).unwrap(), None).unwrap();
    let relations = engine.relations().unwrap();
    let lifts = orthoframe_semantics::lifts(engine.world().unwrap(), relations);
    let of_lift: Vec<_> = lifts.iter().flat_map(|l| &l.doors).filter_map(|j| j.door).collect();
    assert!(!of_lift.is_empty());
    for order in ["Закрой все двери", "Close all doors", "Shut every door"] {
        let commands = engine.understand(order).unwrap();
        let doors = commands.iter().filter_map(|c| c.what()).map(|what| what.id);
        assert!(!commands.is_empty());
        for door in doors {
            let Entity::Door(id) = door else { panic!("{door:?}") };
            assert!(!of_lift.contains(&id), "{order}: {id:?}");
        }
    }
}

/// Where a thing is said to be, there it must be.
#[test]
fn a_thing_is_not_taken_from_where_it_is_not() {
    let engine = Engine::in_memory(crate::worlds::rb2(), None).unwrap();
    for order in ["Принеси Чашку-2 из Комнаты-Y", "Bring Cup 2 from Room Y"] {
        assert!(engine.understand(order).is_err(), "{order}");
    }
    assert!(engine.understand("Принеси Чашку-2 из Комнаты-Z").is_ok());
}

/// "Stop" is an order in all its words; what is ordered behind it is done.
#[test]
fn stop_stops() {
    let engine = Engine::in_memory(crate::worlds::rb2(), None).unwrap();
    for order in ["Стоп", "Стой!", "Остановись", "Stop", "Halt!", "Stop, don't go there", "Отмена"]
    {
        assert_eq!(heard(&engine, order).as_deref(), Some("Stop;"), "{order}");
        let answer = engine.perform(order, &mut |_| {}).unwrap();
        assert!(answer.stops && answer.reports.is_empty(), "{order}");
    }
    let both = heard(&engine, "Стоп! Принеси Чашку-2").unwrap();
    assert!(both.starts_with("Stop;Bring"), "{both}");
    assert!(heard(&engine, "Принеси Чашку-2, нет, отмена").is_none_or(|h| h == "Stop;"));
}

/// What is told to be left where it is, is no part of what is done with all of its kind: the order is the one with the
/// exception, or is not understood.
#[test]
fn what_is_to_be_left_alone_is_not_done() {
    let engine = Engine::in_memory(crate::worlds::rb2(), None).unwrap();
    let orders = [
        (
            "Bring all the books to the sofa",
            "Отнеси все книги на диван",
            ["Book 4", "Книгу-4", "Книги-4"],
        ),
        (
            "Put all the books on the bed",
            "Положи все книги на кровать",
            ["Book 2", "Книгу-2", "Книги-2"],
        ),
        ("Close all the doors", "Закрой все двери", ["Door VZ", "Дверь-ВZ", "Двери-ВZ"]),
        (
            "Bring everything from Table 1 to the sofa",
            "Отнеси всё со Стола-1 на диван",
            ["Cup 1", "Чашку-1", "Чашки-1"],
        ),
    ];
    let mut understood = 0;
    for (english, russian, [name, accusative, genitive]) in orders {
        let without = [
            heard(&engine, &format!("{english} except {name}")).expect("a plain order"),
            heard(&engine, &format!("{russian}, кроме {genitive}")).expect("a plain order"),
        ];
        let lines = [
            format!("{english} but leave {name} where it is."),
            format!("{english}, but leave {name} where it is."),
            format!("{english} and leave {name} alone."),
            format!("{english}. Leave {name} alone."),
            format!("{english}. Leave {name} as it is."),
            format!("{english}, but don't touch {name}."),
            format!("{english}, but not {name}."),
            format!("Leave {name} where it is and {}.", english.to_lowercase().replace("vz", "VZ")),
            format!("{russian}, но {accusative} не трогай."),
            format!("{russian}, а {accusative} не трогай."),
            format!("{russian}, но не трогай {accusative}."),
            format!("{russian}, а {accusative} оставь на месте."),
            format!("{russian}, а {accusative} оставь."),
            format!("{russian}, но {accusative} оставь как есть."),
            format!("{russian}. {accusative} не трогай."),
            format!("{russian}, {accusative} пусть остаётся."),
            format!("{russian}, кроме {genitive}."),
        ];
        for line in lines {
            let Some(commands) = heard(&engine, &line) else { continue };
            assert!(without.contains(&commands), "{line}: {commands}");
            understood += 1;
        }
    }
    assert!(understood > 20, "{understood}");
}
