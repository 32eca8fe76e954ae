//! The world as a robot left it: followed from the survey, and derived anew.

use std::collections::BTreeSet;
use std::sync::Arc;

use orthoframe_map::{DoorState, DoorStatus, Replica, World};
use orthoframe_semantics::{Followed, Relations};

use super::derived;
use crate::planning_properties::random::Random;

/// What a robot does to its world – it carries things, opens doors, switches lamps – is followed, with the result of
/// deriving anew.
#[test]
fn the_world_that_a_robot_left_is_followed() {
    let before = crate::worlds::rb2();
    let surveyed = derived(&before);
    let id = |name: &str| {
        let found = before.replicas.values().find(|r| r.name == name);
        found.unwrap_or_else(|| panic!("rb2 has {name}")).id
    };
    let door = |name: &str| {
        let found = before.doors.values().find(|d| d.name == name);
        found.unwrap_or_else(|| panic!("rb2 has {name}")).id
    };
    let moved = |world: &mut World, what: &str, to: &str| {
        let place = world.replicas[&id(to)].clone();
        let replica = world.replicas.get_mut(&id(what)).expect("it is there");
        (replica.area, replica.frame) = (place.area, place.frame);
    };
    let mut worlds = vec![before.clone(); 6];
    moved(&mut worlds[1], "Чашка-1", "Книга-5");
    // (A thing that is called as its Object is would leave its name to that.)
    worlds[2].replicas.remove(&id("Чайник-1"));
    worlds[2].replicas.remove(&id("Стол-1"));
    moved(&mut worlds[2], "Чашка-1", "Ваза-1");
    for name in ["Дверь-КY", "Дверь-ВZ"] {
        let state = before.doors[&door("Входная дверь")].state;
        worlds[3].doors.get_mut(&door(name)).expect("it is there").state = state;
    }
    let lamp = worlds[3].replicas.get_mut(&id("Лампа-2")).expect("it is there");
    lamp.properties.insert("СОСТОЯНИЕ".to_owned(), "Включено".to_owned());
    moved(&mut worlds[4], "Стул-3", "Стул-4");
    moved(&mut worlds[4], "Стул-4", "Диван-1");
    worlds[4].replicas.remove(&id("Диван-1"));
    // Of things that stand between one another each goes before or after the other.
    let numbered = |name: &str| name.ends_with(|c: char| c.is_ascii_digit());
    worlds[5].replicas.retain(|id, r| !before.has_trait(*id, "portable") || !numbered(&r.name));
    let mut chain = Followed::new(Arc::new(before.clone()), Arc::new(surveyed.clone()));
    for (n, after) in worlds.iter().enumerate() {
        let mut followed = surveyed.clone();
        assert!(followed.follow_world(&before, after).expect("the rules end"), "world {n}");
        let anew = derived(after);
        same(&followed, &anew, after, &format!("world {n}"));
        // From one to the next things are put back too.
        same(chain.of(after).expect("the rules end"), &anew, after, &format!("up to world {n}"));
    }
    // Another Object is another thing: that is derived anew.
    let mut other = before.clone();
    let object = before.replicas[&id("Ваза-1")].object;
    other.replicas.get_mut(&id("Чашка-1")).expect("it is there").object = object;
    let mut surveyed = surveyed;
    assert!(!surveyed.follow_world(&before, &other).expect("the rules end"));
    same(chain.of(&other).expect("the rules end"), &derived(&other), &other, "another Object");
}

/// The same relations of one world, in whatever way they came about.
fn same(followed: &Relations, anew: &Relations, world: &World, how: &str) {
    let names: Vec<String> =
        anew.derived().relations().map(|(_, info)| info.name.to_string()).collect();
    for name in names {
        let rows = |relations: &Relations| -> BTreeSet<String> {
            let tuples = relations.derived().tuples(name.as_str());
            tuples.into_iter().flatten().map(|t| format!("{:?}", t.values())).collect()
        };
        assert_eq!(rows(followed), rows(anew), "{how}, {name}");
    }
    for &thing in world.replicas.keys() {
        assert_eq!(followed.area_of(thing), anew.area_of(thing), "{how}");
        assert_eq!(followed.support_of(thing), anew.support_of(thing), "{how}");
    }
    assert_eq!(followed.openings(), anew.openings(), "{how}");
}

/// Whatever a robot does, also from storey to storey: what it takes, carries elsewhere and puts back is followed.
#[test]
fn many_changes_one_after_another_are_followed() {
    let file = crate::files::project("maps/two-storeys.toml");
    let surveyed = World::load(file).expect("the map is sound");
    for seed in 0..3 {
        let mut random = Random::new(seed);
        let relations = Arc::new(derived(&surveyed));
        let mut followed = Followed::new(Arc::new(surveyed.clone()), relations);
        let mut now = surveyed.clone();
        for step in 0..8 {
            for _ in 0..=random.below(3) {
                let things: Vec<_> = surveyed.replicas.values().collect();
                let (thing, place) =
                    (things[random.below(things.len())], things[random.below(things.len())]);
                match random.below(4) {
                    0 => drop(now.replicas.remove(&thing.id)),
                    1 => drop(now.replicas.insert(thing.id, thing.clone())),
                    2 => {
                        let (area, frame) = (place.area, place.frame);
                        now.replicas.insert(thing.id, Replica { area, frame, ..thing.clone() });
                    }
                    _ => {
                        let n = random.below(now.doors.len());
                        let door = now.doors.values_mut().nth(n).expect("there are so many");
                        let open = door.state.status != DoorStatus::Open;
                        door.state = if open { DoorState::OPEN } else { DoorState::CLOSED };
                    }
                }
            }
            let relations = followed.of(&now).expect("the rules end");
            same(relations, &derived(&now), &now, &format!("seed {seed}, step {step}"));
        }
    }
}
