//! Where a door is, seen from either room.

use orthoframe_map::{Entity, World};
use orthoframe_units::Cm;

#[test]
fn a_door_is_at_the_same_place_from_both_rooms() {
    let world = World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/rb2.toml"))
        .expect("a good map");
    for (name, joins) in [
        ("Дверь-ВZ", &["Комната-В", "Комната-Z"][..]),
        ("Дверь-ZY", &["Комната-Z", "Комната-Y"]),
        ("Проход-ВК", &["Комната-В", "Коридор"]),
        ("Входная дверь", &["Коридор"]),
        ("Дверцы шкафа", &[]),
    ] {
        let [Entity::Door(door)] = world.find(name)[..] else { panic!("{name}") };
        let areas = world.door_areas(door);
        assert_eq!(areas.iter().map(|a| &world.areas[a].name).collect::<Vec<_>>(), joins);
        let seen = areas.iter().map(|&area| {
            let (_, frame) = world.placement(area).expect("every room stands on the map");
            let (right, left) = world.threshold(area, door).expect("mounted there");
            (frame.apply(right), frame.apply(left))
        });
        if let [one, other] = seen.collect::<Vec<_>>()[..] {
            assert_eq!(one, (other.1, other.0), "{name}");
            assert_eq!(Cm::of((one.0 - one.1).norm()), world.doors[&door].width);
        }
    }
}
