//! Every part of an order counts: no word, number, name, half or exception of one is passed over.

use std::fmt::Write as _;

use orthoframe::Engine;
use orthoframe::engine::Memory;
use orthoframe_language::Language;
use orthoframe_language::command::preamble;
use orthoframe_map::{Entity, World};

use crate::orders::lab;

/// Numbers from a seed, one after the other.
fn dice(mut seed: u64) -> impl FnMut(usize) -> usize {
    move |below| {
        seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        usize::try_from(seed >> 33).unwrap() % below
    }
}

/// What an order comes to; none where it is refused or asked back.
pub(crate) fn heard(engine: &Engine, order: &str) -> Option<String> {
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
