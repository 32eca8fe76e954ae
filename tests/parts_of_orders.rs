//! Orders of several parts: each condition decides of its own part, and what is left out of a part is that of the one before.

use orthoframe::Engine;
use orthoframe::engine::Dialogue;
use orthoframe_language::command::Command;
use orthoframe_language::{Case, NounPhrase, names};
use orthoframe_map::{DoorStatus, Entity, World};

use crate::generated_worlds::Dice;
use crate::talk::engine;

const HOUSES: [&str; 3] = [
    "../shared/data/procthor/house_4.json",
    "../shared/data/procthor/house_8.json",
    "../shared/data/virtualhome/TestScene2_graph.json",
];

fn accusative(world: &World, entity: Entity) -> String {
    NounPhrase::parse(world.name(entity), &names::hints(world, entity)).case(Case::Accusative)
}

/// What is put, and onto what; none where the order is refused.
fn puts(engine: &Engine, order: &str) -> Option<Vec<(Entity, Entity)>> {
    let commands = engine.understand(order).ok()?;
    let put = |command: &Command<Entity>| match command {
        Command::Put { what, to } | Command::Bring { what, to: Some(to) } => {
            Some((what.id, to.anchor))
        }
        _ => None,
    };
    commands.iter().map(put).collect()
}

#[test]
fn what_is_listed_goes_where_it_is_said_and_the_rest_elsewhere() {
    let (mut heard, mut refused) = (0, Vec::new());
    for map in HOUSES {
        let Some(engine) = engine(map) else { return };
        let world = engine.world().unwrap();
        let (small, big): (Vec<Entity>, Vec<Entity>) =
            world.replicas.keys().map(|id| Entity::Replica(*id)).partition(
                |e| matches!(e, Entity::Replica(id) if world.has_trait(*id, "portable")),
            );
        let bears =
            |e: &Entity| matches!(e, Entity::Replica(id) if world.has_trait(*id, "support"));
        let big: Vec<Entity> = big.into_iter().filter(bears).collect();
        let mut dice = Dice::new(3);
        for _ in 0..6 {
            let mut pick = |of: &[Entity]| of[dice.below(of.len())];
            let (a, b, c) = (pick(&small), pick(&small), pick(&small));
            let (x, y) = (pick(&big), pick(&big));
            if a == b || b == c || a == c || x == y {
                continue;
            }
            let english = |e| match e {
                Entity::Replica(id) => world.replicas[&id].name_en.clone(),
                _ => unreachable!("only things are taken"),
            };
            let [ea, eb, ec, ex, ey] = [a, b, c, x, y].map(english);
            let [ra, rb, rc, rx, ry] = [a, b, c, x, y].map(|e| accusative(world, e));
            for order in [
                format!("Put {ea} and {eb} on {ex} and {ec} on {ey}"),
                format!("Put {ea} and {eb} on {ex}, and {ec} on {ey}"),
                format!("Положи {ra} и {rb} на {rx}, а {rc} на {ry}"),
            ] {
                match puts(&engine, &order) {
                    Some(all) => {
                        assert_eq!(all, [(a, x), (b, x), (c, y)], "{map}: {order}");
                        heard += 1;
                    }
                    None => refused.push(order),
                }
            }
        }
    }
    assert!(heard > 4 * refused.len(), "{heard}; {refused:#?}");
}

/// Doors as they are and as they are not, in every pair.
#[test]
fn each_condition_decides_of_its_own_part() {
    let mut world = crate::worlds::rb2();
    let doors: Vec<_> = world.doors.keys().copied().take(2).collect();
    for (one, other) in [(true, true), (true, false), (false, true), (false, false)] {
        for (door, open) in doors.iter().zip([one, other]) {
            world.doors.get_mut(door).unwrap().state.status =
                if open { DoorStatus::Open } else { DoorStatus::Closed };
        }
        let engine = Engine::in_memory(world.clone(), None).unwrap();
        let [d1, d2] = [0, 1].map(|n| world.name(Entity::Door(doors[n])).to_owned());
        let heard = |order: &str| {
            let commands = engine.understand(order).unwrap_or_else(|e| panic!("{order}: {e}"));
            commands.iter().map(|c| format!("{c:?}")).collect::<Vec<_>>().join("; ")
        };
        let part = |holds: bool, order: &str| holds.then(|| heard(order));
        let first = part(one, "Принеси зонт");
        let second = part(other, "Найди лекарство");
        let join = |parts: [Option<String>; 2]| {
            let all: Vec<String> = parts.into_iter().flatten().collect();
            if all.is_empty() { "Wait".to_owned() } else { all.join("; ") }
        };
        let both = format!("Если {d1} открыта, принеси зонт, и если {d2} открыта, найди лекарство");
        let without_waiting = heard(&both).replace("Wait; ", "").replace("; Wait", "");
        assert_eq!(without_waiting, join([first.clone(), second.clone()]), "{both}");
        for instead in ["а если", "но если", "если"] {
            let order =
                format!("Если {d1} открыта, принеси зонт; {instead} {d2} открыта, найди лекарство");
            let second = second.clone().filter(|_| !one);
            assert_eq!(heard(&order), join([first.clone(), second]), "{order}");
        }
    }
}

/// A quantifier before what is named begins questions as well, and these order.
#[test]
fn an_order_may_begin_with_all_that_it_is_done_to() {
    let Some(mut house) = engine(HOUSES[0]) else { return };
    for (order, plain) in [
        ("Все подушки с кровати положи на диван", "Положи все подушки с кровати на диван"),
        ("Обе подушки с кровати отнеси на диван", "Отнеси обе подушки с кровати на диван"),
        ("Все карандаши отнеси на кровать", "Отнеси все карандаши на кровать"),
    ] {
        let mut goals = |said: &str| {
            let mut dialogue = Dialogue::default();
            let heard = dialogue.order(&mut house, said, &mut |_, _| {}).unwrap();
            heard.tasks().flat_map(|task| task.goal.clone()).collect::<Vec<_>>()
        };
        let (said, meant) = (goals(order), goals(plain));
        assert!(!meant.is_empty() && said == meant, "{order}: {said:?}");
    }
}
