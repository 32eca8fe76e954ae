//! What a map says to a plan.

use expect_test::{Expect, expect};
use orthoframe_map::{Format, World};
use orthoframe_semantics::planning::{RobotAt, RobotState, initial};
use orthoframe_semantics::{Profile, RelationRules, derive};
use orthoframe_units::Source;

const HOME: &str = r#"
format = 1
[type]
object = [{ name = "Мебель" }, { name = "Вещь", traits = ["portable"] }]
[orthoframe]
floor-a = { name = "Пол А", height = 270, points = [[0, 0], [300, 0], [300, 100], [300, 200], [300, 400], [200, 400], [100, 400], [0, 400]], side.C = { permeability = "conditional" }, side.F = { permeability = "permeable" } }
floor-b = { name = "Пол Б", height = 270, points = [[0, 0], [300, 0], [300, 400], [0, 400], [0, 200], [0, 100]], side.E = { permeability = "conditional" } }
floor-c = { name = "Пол В", height = 270, points = [[0, 0], [100, 0], [200, 0], [300, 0], [300, 200], [0, 200]], side.B = { permeability = "permeable" } }
cube = { name = "Куб", rect = [60, 40], height = 50 }
small = { name = "Кубик", rect = [8, 8], height = 5 }
[object]
stand = { name = "Тумба", type = "Мебель", items = [{ id = "A", orthoframe = "cube" }] }
thing = { name = "Вещь", type = "Вещь", items = [{ id = "A", orthoframe = "small" }] }
[door.ab]
name = "Дверь-АБ"
kind = "hinged"
width = 100
height = 200
leaves = [{ hinge = "left", share = 1, thickness = 4, max_open = 90 }]
state = "closed"
[area.a]
name = "А"
items = [{ id = "A", orthoframe = "floor-a" }]
doors = [{ side = "C", door = "ab", opens = "inside" }]
places = [{ name = "Точка", at = [150, 150] }]
replicas = [
  { name = "Ключ", object = "thing", at = [200, 300], properties = { "КЛЮЧ_ОТ" = "Дверь-АБ" } },
]
[area.b]
name = "Б"
items = [{ id = "A", orthoframe = "floor-b" }]
doors = [{ side = "E", door = "ab", opens = "outside" }]
places = [{ name = "У тумбы", at = [150, 150], serves = "Тумба-1" }]
replicas = [
  { name = "Тумба-1", object = "stand", at = [100, 300] },
  { name = "Тумба-2", object = "stand", at = [200, 300] },
  { name = "Лекарство", object = "thing", at = [110, 310, 50] },
  { name = "Поднос", object = "thing", at = [210, 310, 50] },
  { name = "Пилюля", object = "thing", at = [210, 310, 55] },
]
[area.c]
name = "В"
items = [{ id = "A", orthoframe = "floor-c" }]
[map.flat]
name = "Карта"
items = [{ area = "a" }, { area = "b", at = [300, 0] }, { area = "c", at = [0, 400] }]
links = [{ from = "a.C", to = "b.E" }, { from = "a.F", to = "c.B" }]
"#;

fn check(state: impl Fn(&World) -> RobotState, expected: &Expect) {
    let world = World::parse(&Source::new("дом.toml", HOME), Format::Toml)
        .unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)));
    let relations =
        derive(&world, &RelationRules::standard(), Profile::Surveyed).expect("rules end");
    let lines: Vec<String> = initial(&world, &relations, &state(&world))
        .facts
        .iter()
        .map(|f| {
            let arguments: Vec<String> =
                f.arguments.iter().map(|a| format!("{} {}", a.kind, a.name)).collect();
            let mark = if f.assumed { "?" } else { "" };
            format!("{}({}){mark}\n", f.predicate, arguments.join(", "))
        })
        .collect();
    expected.assert_eq(&lines.concat());
}

fn at_point(world: &World) -> RobotState {
    let place = world.places.values().next().expect("the first place is in А");
    RobotState { area: place.area, at: RobotAt::Place(place.id), holds: None }
}

#[test]
fn the_map_says_what_a_plan_needs() {
    check(
        at_point,
        &expect![[r#"
                ДВЕРЬ_ИЗ_В_ЗАКРЫТА(дверь Дверь-АБ, помещение А, помещение Б)?
                ДВЕРЬ_ИЗ_В_ЗАКРЫТА(дверь Дверь-АБ, помещение Б, помещение А)?
                ДВЕРЬ_ИЗ_В_ОТКРЫТА(дверь Проход-А-В, помещение А, помещение В)?
                ДВЕРЬ_ИЗ_В_ОТКРЫТА(дверь Проход-А-В, помещение В, помещение А)?
                ДВЕРЬ_ИМЕЕТ-СТВОРКУ(дверь Дверь-АБ)
                ДВЕРЬ_НАХОДИТСЯ-В(дверь Дверь-АБ, помещение А)
                ДВЕРЬ_НАХОДИТСЯ-В(дверь Дверь-АБ, помещение Б)
                ДВЕРЬ_НАХОДИТСЯ-В(дверь Проход-А-В, помещение А)
                ДВЕРЬ_НАХОДИТСЯ-В(дверь Проход-А-В, помещение В)
                КЛЮЧ_ПОДХОДИТ-К(предмет Ключ, дверь Дверь-АБ)
                ПОЗИЦИЯ_НАХОДИТСЯ-В(место Место-у-Ключ, помещение А)
                ПОЗИЦИЯ_НАХОДИТСЯ-В(место Точка, помещение А)
                ПОЗИЦИЯ_НАХОДИТСЯ-В(место Тумба-2, помещение Б)
                ПОЗИЦИЯ_НАХОДИТСЯ-В(место У тумбы, помещение Б)
                ПОЗИЦИЯ_НАХОДИТСЯ-У(место Тумба-2, объект Тумба-2)
                ПОЗИЦИЯ_НАХОДИТСЯ-У(место У тумбы, объект Тумба-1)
                ПОМЕЩЕНИЕ-ОСВЕЩЕНО(помещение А)?
                ПОМЕЩЕНИЕ-ОСВЕЩЕНО(помещение Б)?
                ПОМЕЩЕНИЕ-ОСВЕЩЕНО(помещение В)?
                ПРЕДМЕТ_НАХОДИТСЯ-В-ПОЗИЦИИ(предмет Ключ, место Место-у-Ключ)
                ПРЕДМЕТ_НАХОДИТСЯ-НА(предмет Лекарство, объект Тумба-1)
                ПРЕДМЕТ_НАХОДИТСЯ-НА(предмет Пилюля, объект Тумба-2)
                ПРЕДМЕТ_НАХОДИТСЯ-НА(предмет Поднос, объект Тумба-2)
                РОБОТ-НАХОДИТСЯ-В(помещение А)
                РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ(место Точка)
                РУКА-СВОБОДНА()
            "#]],
    );
}
