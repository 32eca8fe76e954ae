//! The world as a robot left it: followed from the survey, and derived anew.

use std::collections::BTreeSet;

use orthoframe::map::World;
use orthoframe::semantics::Relations;

use super::derived;

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
    for (n, after) in worlds.iter().enumerate() {
        let mut followed = surveyed.clone();
        assert!(followed.follow_world(&before, after).expect("the rules end"), "world {n}");
        let anew = derived(after);
        let names: Vec<String> =
            anew.derived().relations().map(|(_, info)| info.name.to_string()).collect();
        for name in names {
            let rows = |relations: &Relations| -> BTreeSet<String> {
                let tuples = relations.derived().tuples(name.as_str());
                tuples.into_iter().flatten().map(|t| format!("{:?}", t.values())).collect()
            };
            assert_eq!(rows(&followed), rows(&anew), "world {n}, {name}");
        }
        for &thing in after.replicas.keys() {
            assert_eq!(followed.area_of(thing), anew.area_of(thing), "world {n}");
            assert_eq!(followed.support_of(thing), anew.support_of(thing), "world {n}");
        }
        assert_eq!(followed.openings(), anew.openings(), "world {n}");
    }
    // Another Object is another thing: that is derived anew.
    let mut other = before.clone();
    let object = before.replicas[&id("Ваза-1")].object;
    other.replicas.get_mut(&id("Чашка-1")).expect("it is there").object = object;
    let mut surveyed = surveyed;
    assert!(!surveyed.follow_world(&before, &other).expect("the rules end"));
}
