//! Relations of SPEC R on small worlds made by hand, each world straight and turned, and on random ones.

mod asked;
mod doors;
mod follow;
mod holders;
mod parts;
mod random;
mod sides;
mod slow;
mod stacks;
mod why;

use std::fmt::Write as _;
use std::sync::LazyLock;

use expect_test::Expect;
use orthoframe_map::{Format, World};
use orthoframe_semantics::{Profile, RelationRules, Relations, derive};
use orthoframe_units::{Deg, Frame, Source};

static RULES: LazyLock<RelationRules> = LazyLock::new(RelationRules::standard);

/// Things of every shape that the cases need. Sizes are in the names' comments: width × depth × height.
const PRELUDE: &str = r#"
format = 1

[type]
object = [
  { name = "Вещь" },
  { name = "Ёмкость", traits = ["container"] },
  { name = "Ноша", traits = ["portable"] },
  { name = "Мебель для сидения", traits = ["seat"] },
]

[orthoframe]
top = { name = "Столешница", rect = [120, 80], height = 3 }
leg = { name = "Ножка", rect = [6, 6], height = 72 }
tray = { name = "Поднос", rect = [50, 30], height = 2 }
saucer = { name = "Блюдце", regular = { corners = 12, radius = 7 }, height = 2 }
cup = { name = "Чашка", regular = { corners = 12, radius = 4 }, height = 9, roof = "permeable" }
plinth = { name = "Основание", rect = [80, 30], height = 10 }
case = { name = "Корпус", rect = [80, 30], height = 180, side = { A = { permeability = "permeable" } } }
shelf = { name = "Плоская полка", rect = [78, 28], height = 0 }
book = { name = "Том", rect = [4, 18], height = 24 }
cube = { name = "Куб", rect = [40, 40], height = 40 }
open-box = { name = "Стенки", rect = [40, 40], height = 40, roof = "permeable" }
stick = { name = "Палка", rect = [4, 4], height = 120 }
carpet = { name = "Полотно", rect = [300, 200], height = 1 }
cloth = { name = "Ткань", rect = [90, 70], height = 0.5 }
cat = { name = "Туловище", rect = [40, 15], height = 25 }
lamp = { name = "Абажур", regular = { corners = 12, radius = 20 }, height = 20 }
tall = { name = "Шкафчик", rect = [100, 60], height = 200 }
round = { name = "Круг", regular = { corners = 24, radius = 60 }, height = 75 }
ell = { name = "Угол", points = [[0, 0], [200, 0], [200, 60], [60, 60], [60, 200], [0, 200]], height = 90 }
seat = { name = "Сиденье", rect = [40, 40], height = 5 }
stool-leg = { name = "Опора", rect = [30, 30], height = 40, properties = { "ЦВЕТ" = "Чёрный" } }
back = { name = "Спинка", rect = [40, 4], height = 50 }
cone = { name = "Конус", regular = { corners = 24, radius = 30 }, height = 60, roof_scale = 0.2 }

[object]
table = { name = "Стол", type = "Вещь", items = [
  { id = "A", orthoframe = "leg" }, { id = "T", orthoframe = "top", at = [0, 0, 72] }, { id = "B", orthoframe = "leg", at = [114, 0] },
  { id = "C", orthoframe = "leg", at = [114, 74] }, { id = "D", orthoframe = "leg", at = [0, 74] },
], front = "T.A", back = "T.C" }
tray = { name = "Поднос", type = "Ноша", items = [{ id = "A", orthoframe = "tray" }] }
saucer = { name = "Блюдце", type = "Ноша", items = [{ id = "A", orthoframe = "saucer" }] }
cup = { name = "Чашка", type = "Ноша", items = [{ id = "A", orthoframe = "cup" }] }
bookcase = { name = "Стеллаж", type = "Вещь", items = [
  { id = "A", orthoframe = "plinth" }, { id = "B", orthoframe = "case", at = [0, 0, 10] },
  { id = "C", orthoframe = "shelf", at = [1, 1, 60] }, { id = "D", orthoframe = "shelf", at = [1, 1, 110] },
], front = "A.A", back = "A.C" }
book = { name = "Книга", type = "Ноша", items = [{ id = "A", orthoframe = "book" }] }
cube = { name = "Куб", type = "Вещь", items = [{ id = "A", orthoframe = "cube" }] }
box = { name = "Ящик", type = "Ёмкость", items = [{ id = "A", orthoframe = "open-box" }] }
drawer = { name = "Сундук", type = "Ёмкость", items = [{ id = "A", orthoframe = "cube" }] }
stick = { name = "Швабра", type = "Вещь", items = [{ id = "A", orthoframe = "stick" }] }
carpet = { name = "Ковёр", type = "Вещь", items = [{ id = "A", orthoframe = "carpet" }] }
cloth = { name = "Скатерть", type = "Вещь", items = [{ id = "A", orthoframe = "cloth" }] }
cat = { name = "Кот", type = "Вещь", items = [{ id = "A", orthoframe = "cat" }] }
lamp = { name = "Люстра", type = "Вещь", items = [{ id = "A", orthoframe = "lamp" }] }
wardrobe = { name = "Шкаф", type = "Вещь", items = [{ id = "A", orthoframe = "tall" }], front = "A", back = "C" }
round = { name = "Круглый стол", type = "Вещь", items = [{ id = "A", orthoframe = "round" }] }
ell = { name = "Угловой стол", type = "Ёмкость", items = [{ id = "A", orthoframe = "ell" }] }
stool = { name = "Стул", type = "Вещь", properties = { "ЦВЕТ" = "Красный", "МАТЕРИАЛ" = "Дерево" }, items = [
  { id = "A", orthoframe = "stool-leg" }, { id = "B", orthoframe = "seat", at = [-5, -5, 40] },
  { id = "C", orthoframe = "back", at = [-5, 31, 45] },
], front = "B.A", back = "B.C" }
cone = { name = "Пуф", type = "Вещь", items = [{ id = "A", orthoframe = "cone" }] }
"#;

/// One room of 8 × 6 m with the given replicas.
fn room_text(replicas: &str) -> String {
    format!(
        r#"{PRELUDE}
[orthoframe.floor]
name = "Пол"
rect = [800, 600]
height = 270
[area.room]
name = "Комната"
items = [{{ id = "A", orthoframe = "floor" }}]
replicas = [
{replicas}
]
[map.flat]
name = "Карта"
items = [{{ area = "room" }}]
"#
    )
}

/// The world of a text, its first Area turned by `angle` within its Map.
fn turned(text: &str, angle: f64) -> World {
    let mut world = world(text);
    for map in world.maps.values_mut() {
        map.items[0].frame = Frame::new(37.0, -12.0, 0.0, Deg::of(angle));
    }
    world
}

fn room(angle: f64, replicas: &str) -> World {
    turned(&room_text(replicas), angle)
}

fn world(text: &str) -> World {
    World::parse(&Source::new("мир.toml", text), Format::Toml)
        .unwrap_or_else(|faults| panic!("{:?}", miette::Report::new(faults)))
}

fn derived(world: &World) -> Relations {
    derive(world, &RULES, Profile::Surveyed).expect("standard rules end")
}

/// The tuples of some relations, one a line; those with the room itself left out.
fn list(relations: &Relations, names: &str) -> String {
    let mut text = String::new();
    for name in names.split_whitespace() {
        let tuples = relations.tuples(name).unwrap_or_else(|e| panic!("{e}"));
        for tuple in tuples {
            let words: Vec<String> = tuple.iter().map(ToString::to_string).collect();
            if !words.iter().any(|w| w == "Комната") {
                writeln!(text, "{name}: {}", words.join(", ")).expect("a string takes all");
            }
        }
    }
    text
}

/// The same relations must hold however the room stands in its Map.
fn check(replicas: &str, names: &str, expected: &Expect) {
    let found = [0.0, 90.0, 33.7, 180.0].map(|angle| list(&derived(&room(angle, replicas)), names));
    assert!(found.iter().all(|f| *f == found[0]), "{found:#?}");
    expected.assert_eq(&found[0]);
}
