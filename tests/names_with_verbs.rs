//! Names of the map that have words of orders in them – verbs, joints, prepositions, numbers – are names: what is ordered of
//! them is understood of just those places, or refused.

use orthoframe::Engine;
use orthoframe_language::command::Command;
use orthoframe_language::{Case, NounPhrase, names};
use orthoframe_map::{Entity, World};

use crate::generated_worlds::Dice;

const ENGLISH: [&str; 14] = [
    "patrol", "drop", "charge", "open", "and", "bring", "take", "by", "off", "point", "space",
    "clean", "stop", "room",
];
const RUSSIAN: [&str; 12] = [
    "принеси",
    "открой",
    "и",
    "поставь",
    "стой",
    "у",
    "на",
    "положи",
    "верни",
    "обойди",
    "найди",
    "запри",
];

/// The flat with its rooms under names of such words.
fn flat(dice: &mut Dice) -> World {
    let mut world = crate::worlds::rb2();
    let words = |dice: &mut Dice, of: &[&'static str]| {
        let many = 1 + dice.below(3);
        (0..many).map(|_| of[dice.below(of.len())]).collect::<Vec<_>>()
    };
    for (n, area) in world.areas.values_mut().enumerate() {
        // The noun that a name is declined by, and what is said of it.
        let nouns = ["Склад", "Уголок", "Зал", "Отсек", "Ангар", "Бокс"];
        let told = words(dice, &RUSSIAN).join(" ");
        area.name = format!("{} {told} {}", nouns[n % nouns.len()], n + 2);
        let joint = ["_", " "][dice.below(2)];
        area.name_en = format!("{}{joint}{}", words(dice, &ENGLISH).join(joint), n + 2);
        area.forms.clear();
    }
    world
}

#[test]
fn names_are_one_word_before_verbs_are_looked_for() {
    let (mut heard, mut refused) = (0, Vec::new());
    for seed in 0..12 {
        let mut dice = Dice::new(seed);
        let world = flat(&mut dice);
        let Ok(engine) = Engine::in_memory(world.clone(), None) else { continue };
        let areas: Vec<Entity> = world.areas.keys().map(|id| Entity::Area(*id)).collect();
        let (one, other) = (areas[dice.below(areas.len())], areas[dice.below(areas.len())]);
        if one == other {
            continue;
        }
        let english = |area| match area {
            Entity::Area(id) => world.areas[&id].name_en.clone(),
            _ => unreachable!("only areas are taken"),
        };
        let russian = |area| {
            NounPhrase::parse(world.name(area), &names::hints(&world, area)).case(Case::Accusative)
        };
        for (order, goals) in [
            (format!("Go to {}", english(one)), vec![one]),
            (format!("Go to {}, then to {}", english(one), english(other)), vec![one, other]),
            (format!("Drive to {} and then to {}", english(one), english(other)), vec![one, other]),
            (format!("Поезжай в {}", russian(one)), vec![one]),
            (format!("Поезжай в {}, потом в {}", russian(one), russian(other)), vec![one, other]),
        ] {
            let Ok(commands) = engine.understand(&order) else {
                refused.push(order);
                continue;
            };
            let went: Option<Vec<Entity>> = commands
                .iter()
                .map(|command| match command {
                    Command::GoTo { to, via: None, facing: None } => Some(to.anchor),
                    _ => None,
                })
                .collect();
            assert_eq!(went, Some(goals), "{order}: {commands:?}");
            heard += 1;
        }
    }
    assert!(heard > 4 * refused.len(), "{heard} heard; {refused:#?}");
}

/// A name says nothing where it is a verb that is meant.
#[test]
fn a_verb_before_a_name_stays_a_verb() {
    let mut world = crate::worlds::rb2();
    world.areas.values_mut().next().unwrap().name_en = "Open kitchen".to_owned();
    let engine = Engine::in_memory(world, None).unwrap();
    let heard = |order: &str| format!("{:?}", engine.understand(order));
    assert!(heard("Go to the open kitchen").contains("GoTo"));
    assert!(!heard("Open kitchen door").contains("GoTo"), "{}", heard("Open kitchen door"));
}
