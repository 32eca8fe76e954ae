//! What is said beside an order between commas: politeness costs nothing, and a condition of the world is never passed over.

use orthoframe::Engine;
use orthoframe_map::World;

fn heard(engine: &Engine, order: &str) -> String {
    match engine.understand(order) {
        Ok(commands) => format!("{commands:?}"),
        Err(error) => format!("refused: {}", error),
    }
}

fn lab() -> Engine {
    let world = World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/maps/lab.toml")).unwrap();
    Engine::in_memory(world, None).unwrap()
}

fn flat() -> Engine {
    Engine::in_memory(crate::worlds::rb2(), None).unwrap()
}

/// Orders as a head and a rest, between which something may be said.
const ENGLISH: [(&str, &str); 5] = [
    ("Bring", "the battery"),
    ("Could you", "bring the battery"),
    ("Put", "the battery on the desk"),
    ("Go", "to the office"),
    ("Open", "the office door"),
];
const RUSSIAN: [(&str, &str); 5] = [
    ("Принеси", "зонт"),
    ("Ты не мог бы", "принести зонт"),
    ("Положи", "зонт на кровать"),
    ("Поезжай", "в спальню"),
    ("Закрой", "Дверь-ZY"),
];

#[test]
fn politeness_between_commas_costs_nothing() {
    let english = [
        "please",
        "if you can",
        "when you have a moment",
        "if it's not too much trouble",
        "whenever you get a chance",
        "if you don't mind",
        "for example",
        "as agreed",
        "once you have time",
    ];
    let russian = [
        "пожалуйста",
        "если не трудно",
        "если тебе не сложно",
        "когда будет минутка",
        "если у тебя есть время",
        "будь добр",
        "например",
        "как договаривались",
        "если вас не затруднит",
    ];
    let mut dear = Vec::new();
    let mut said = |engine: &Engine, orders: &[(&str, &str)], asides: &[&str]| {
        for (head, rest) in orders {
            let plain = heard(engine, &format!("{head} {rest}"));
            assert!(!plain.starts_with("refused"), "{head} {rest}: {plain}");
            for aside in asides {
                for order in [
                    format!("{head}, {aside}, {rest}"),
                    format!("{head} {rest}, {aside}"),
                    format!("{head} {rest}, {aside}, now").replace(", now", ""),
                    format!("{aside}, {} {rest}", head.to_lowercase()),
                ] {
                    let told = heard(engine, &order);
                    if told != plain {
                        dear.push(format!("{order}: {told}"));
                    }
                }
            }
        }
    };
    said(&lab(), &ENGLISH, &english);
    said(&flat(), &RUSSIAN, &russian);
    assert!(dear.is_empty(), "{dear:#?}");
}

/// Wherever a condition stands, what it bounds is done where it holds, and not where it does not.
#[test]
fn a_condition_between_commas_is_kept() {
    let lab = lab();
    let flat = flat();
    let of = |engine: &Engine, conditions: [(&str, bool); 3], orders: &[(&str, &str)]| {
        for (condition, holds) in conditions {
            for (head, rest) in orders {
                let plain = heard(engine, &format!("{head} {rest}"));
                let told = heard(engine, &format!("{head}, {condition}, {rest}"));
                let wanted = if holds { &plain } else { "[Wait]" };
                // To have looked for the condition may have changed what is known, but never what is done.
                assert!(
                    told == *wanted || told.starts_with("refused"),
                    "{head}, {condition}, {rest}: {told}"
                );
                if *head != "Could you"
                    && *head != "Ты не мог бы"
                    && *head != "Go"
                    && *head != "Поезжай"
                {
                    assert_eq!(told, *wanted, "{head}, {condition}, {rest}");
                }
            }
        }
    };
    let english = [
        ("if the office door is closed", true),
        ("if the office door is open", false),
        ("when the lab door is locked", false),
    ];
    of(&lab, english, &ENGLISH);
    let russian = [
        ("если Дверь-ВZ закрыта", false),
        ("если Дверь-ВZ открыта", true),
        ("если Дверь-ВZ заперта", false),
    ];
    of(&flat, russian, &RUSSIAN);
}
