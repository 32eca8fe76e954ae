//! What can be said of where the robot is.

use expect_test::{Expect, expect};
use orthoframe_map::{Entity, Format, World};
use orthoframe_semantics::{Profile, RelationRules, Spot, Way, derive, whereabouts};
use orthoframe_units::{AreaId, Deg, Frame, Point, Pose, Source};

/// ```text
/// 400 +-----------+ +-----------+
///     |     А     |=|     Б     |   a door through a wall of 20 cm
///   0 +-----------+ +-----------+
///     0         600 620       1220
/// ```
const HOME: &str = r#"
format = 1
[orthoframe]
floor-a = { name = "Пол А", height = 270, points = [[0, 0], [600, 0], [600, 150], [600, 250], [600, 400], [0, 400]], side.C = { permeability = "conditional" } }
floor-b = { name = "Пол Б", height = 270, points = [[0, 0], [600, 0], [600, 400], [0, 400], [0, 250], [0, 150]], side.E = { permeability = "conditional" } }
cube = { name = "Куб", rect = [60, 60], height = 50 }
[object]
stand = { name = "Тумба", items = [{ id = "A", orthoframe = "cube" }] }
[door.ab]
name = "Дверь-АБ"
kind = "hinged"
width = 100
height = 200
leaves = [{ hinge = "left", share = 1, thickness = 4, max_open = 90 }]
state = "open"
[area.a]
name = "А"
items = [{ id = "A", orthoframe = "floor-a" }]
doors = [{ side = "C", door = "ab", opens = "inside" }]
replicas = [{ name = "Тумба-1", object = "stand", at = [0, 170] }]
[area.b]
name = "Б"
items = [{ id = "A", orthoframe = "floor-b" }]
doors = [{ side = "E", door = "ab", opens = "outside" }]
replicas = [{ name = "Тумба-2", object = "stand", at = [540, 0] }, { name = "Тумба-3", object = "stand", at = [540, 340] }]
[map.flat]
name = "Карта"
items = [{ area = "a" }, { area = "b", at = [600, 0] }]
links = [{ from = "a.C", to = "b.E" }]
"#;

fn check(at: &[(f64, f64)], expected: &Expect) {
    let mut world = World::parse(&Source::new("дом.toml", HOME), Format::Toml)
        .unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)));
    for map in world.maps.values_mut() {
        // The wall's thickness comes between the rooms.
        map.links.clear();
        map.items[1].frame = Frame::new(620.0, 0.0, 0.0, Deg::ZERO);
    }
    let relations =
        derive(&world, &RelationRules::standard(), Profile::Surveyed).expect("rules end");
    let map = *world.maps.keys().next().expect("one map");
    let area = |id: Option<AreaId>| id.map_or("?", |id| world.name(Entity::Area(id)));
    let lines: Vec<String> = at
        .iter()
        .map(|&(x, y)| {
            let pose = Pose { at: Point::new(x, y), heading: Deg::ZERO };
            let Some(found) = whereabouts(&world, &relations, map, &pose) else {
                return format!("{x},{y}: nowhere\n");
            };
            let through = |w: &Way| format!("{} > {}", area(Some(w.from)), area(w.to));
            let spot = match &found.spot {
                Spot::InDoorway(way) => format!("in the doorway {}", through(way)),
                Spot::AtDoor { way, .. } => format!("at the door {}", through(way)),
                Spot::NextTo { replica, .. } => {
                    format!("next to {}", world.name(Entity::Replica(*replica)))
                }
                other => format!("{other:?}"),
            };
            format!("{x},{y}: {}, {spot}\n", area(Some(found.area)))
        })
        .collect();
    expected.assert_eq(&lines.concat());
}

#[test]
fn the_strongest_of_what_can_be_said() {
    check(
        &[
            (540.0, 200.0),
            (595.0, 180.0),
            (610.0, 200.0),
            (640.0, 240.0),
            (690.0, 200.0),
            (610.0, 20.0),
            (100.0, 200.0),
            (40.0, 360.0),
            (300.0, 40.0),
            (300.0, 200.0),
            (1120.0, 60.0),
            (-50.0, 0.0),
        ],
        &expect![[r#"
                540,200: А, at the door А > Б
                595,180: А, in the doorway А > Б
                610,200: А, in the doorway А > Б
                640,240: Б, at the door Б > А
                690,200: Б, at the door Б > А
                610,20: nowhere
                100,200: А, next to Тумба-1
                40,360: А, InCorner
                300,40: А, AlongWall
                300,200: А, InMiddle
                1120,60: Б, AlongWall
                -50,0: nowhere
            "#]],
    );
}
