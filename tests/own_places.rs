//! «Где зарядка?»: a place of the robot's own is called by its kind though its name is half an identifier; to be charged it
//! goes to the nearest, and to one by its name where that is said.

use orthoframe::engine::Memory;
use orthoframe_language::command::Command;
use orthoframe_language::names::named;
use orthoframe_language::question::Doubt;
use orthoframe_language::{Case, Language};
use orthoframe_map::Entity;

use crate::talk::engine;

#[test]
fn a_charger_is_called_by_its_kind_and_by_its_name() {
    let Some(engine) = engine("../shared/data/rmf/office.building.yaml") else { return };
    let world = engine.world().unwrap();
    let chargers: Vec<Entity> = world.places.values().map(|p| Entity::Place(p.id)).collect();
    let is_charger = |e: &Entity| world.name(*e).starts_with("Зарядка");
    let chargers: Vec<Entity> = chargers.into_iter().filter(is_charger).collect();
    assert!(chargers.len() > 1);
    for question in ["Где зарядка?", "Что рядом с зарядкой?", "Where is the charger?"]
    {
        let doubt = engine.ask(question, &mut Memory::default()).unwrap().expect_err(question);
        assert!(matches!(doubt.doubt, Doubt::Ambiguous { .. }), "{question}: {}", doubt.text);
    }
    for order in
        ["Поезжай на зарядку", "Вернись к зарядке", "Go to the charger", "Go back to your charger"]
    {
        let commands = engine.understand_in(order, &mut Memory::default());
        let commands = commands.unwrap_or_else(|error| panic!("{order}: {error}"));
        assert_eq!(commands, [Command::Charge], "{order}");
    }
    for charger in chargers {
        let called = named(world, charger);
        for order in [
            format!("Поезжай к {}", called.phrase().case(Case::Dative)),
            format!("Подъезжай к {}", called.phrase().case(Case::Dative).to_lowercase()),
            format!("Go to {}", called.english()),
        ] {
            let commands = engine.understand_in(&order, &mut Memory::default());
            let commands = commands.unwrap_or_else(|error| panic!("{order}: {error}"));
            assert!(
                matches!(&commands[..], [Command::GoTo { to, .. }] if to.anchor == charger),
                "{order}: {commands:?}"
            );
        }
        let question = format!("Где {}?", called.phrase().name());
        let answer = engine.ask(&question, &mut Memory::default()).unwrap().expect(&question);
        assert_eq!(answer.language, Language::Russian, "{}", answer.text);
    }
}

/// A place whose name no case changes is whither a thing is brought, with its kind before it and without.
#[test]
fn a_thing_is_brought_to_a_place_that_no_case_changes() {
    let Some(engine) = engine("../shared/data/rmf/office.building.yaml") else { return };
    let world = engine.world().unwrap();
    let mut asked = 0;
    for place in world.places.values() {
        let Some((kind, own)) = place.name.split_once(' ') else { continue };
        if !own.is_ascii() || own.contains('_') || own.ends_with(|c: char| c.is_ascii_digit()) {
            continue;
        }
        for place_name in [own.to_owned(), format!("{} {own}", kind.replace("чка", "чку"))] {
            let order = format!("Принеси колу в {place_name}");
            let commands = engine.understand_in(&order, &mut Memory::default());
            let commands = commands.unwrap_or_else(|error| panic!("{order}: {error}"));
            let [command] = &commands[..] else { panic!("{order}: {commands:?}") };
            let to = command.place().map(|to| to.anchor);
            assert_eq!(to, Some(Entity::Place(place.id)), "{order}: {command:?}");
            asked += 1;
        }
    }
    assert!(asked > 5, "{asked}");
}
