//! "Go to all rooms": in the order of the shortest way, and each of them.

use std::collections::BTreeSet;

use orthoframe::Engine;
use orthoframe_language::command::Command;
use orthoframe_map::Entity;

use crate::generated_worlds::Dice;
use crate::talk::engine;

fn rooms(engine: &Engine, order: &str) -> Option<Vec<Entity>> {
    let commands = engine.understand(order).ok()?;
    let place = |command: &Command<Entity>| match command {
        Command::GoTo { to, .. } => Some(to.anchor),
        _ => None,
    };
    commands.iter().map(place).collect()
}

fn length(engine: &Engine, order: &str) -> f64 {
    let done = engine.perform(order, &mut |_| {}).unwrap();
    assert!(done.ending.is_done(), "{order}: {:?}", done.ending);
    done.reports.iter().map(|report| report.length).sum()
}

#[test]
fn a_round_of_all_rooms_is_no_longer_than_in_any_other_order() {
    /// To a room is to its door, and how a room is entered decides how it is left, cm.
    const NEAR: f64 = 150.0;
    for map in ["../shared/data/procthor/house_4.json", "maps/lab.toml", "maps/rb2.toml"] {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let all = rooms(&engine, "Go to all rooms").unwrap();
        assert_eq!(rooms(&engine, "Поезжай во все комнаты").as_ref(), Some(&all), "{map}");
        let each: BTreeSet<Entity> = all.iter().copied().collect();
        assert_eq!(each.len(), world.areas.len(), "{map}");
        let round = length(&engine, "Go to all rooms");
        let mut dice = Dice::new(5);
        for _ in 0..4 {
            let mut order = all.clone();
            for n in (1..order.len()).rev() {
                order.swap(n, dice.below(n + 1));
            }
            let names: Vec<&str> = order.iter().map(|room| world.name(*room)).collect();
            let said = format!("Поезжай в «{}»", names.join("», потом в «"));
            if rooms(&engine, &said) != Some(order) {
                continue;
            }
            let other = length(&engine, &said);
            assert!(round <= other + NEAR, "{map}: {round} for {all:?}, {other} for {said}");
        }
    }
}
