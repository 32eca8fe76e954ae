//! Relations of SPEC R on small worlds made by hand, each world straight and turned, and on random ones.

use std::collections::BTreeSet;
use std::fmt::Write as _;
use std::sync::LazyLock;

use expect_test::{Expect, expect};
use orthoframe::facts::WhyNot;
use orthoframe::map::{Format, World};
use orthoframe::semantics::{Measurements, Pair, Profile, Reach, RelationRules, Relations, derive};
use orthoframe::units::{Deg, Frame, Point, ReplicaId, Source};
use proptest::prelude::*;

static RULES: LazyLock<RelationRules> = LazyLock::new(RelationRules::standard);

/// Things of every shape that the cases need. Sizes are in the names' comments: width × depth × height.
const PRELUDE: &str = r#"
format = 1

[type]
object = [
  { name = "Вещь" },
  { name = "Ёмкость", traits = ["container"] },
  { name = "Ноша", traits = ["portable"] },
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

/// One room of 8 × 6 m, turned by `angle` within its Map, with the given replicas.
fn room(angle: f64, replicas: &str) -> World {
    let text = format!(
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
    );
    let mut world = world(&text);
    for map in world.maps.values_mut() {
        map.items[0].frame = Frame::new(37.0, -12.0, 0.0, Deg::of(angle));
    }
    world
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

const STACK: &str = "ON_TOP_OF ABOVE UNDER INSIDE";

#[test]
fn a_cup_on_a_saucer_on_a_tray_on_a_table() {
    check(
        r#"
{ name = "стол", object = "table", at = [200, 200] },
{ name = "поднос", object = "tray", at = [220, 210, 75], angle = 10 },
{ name = "блюдце", object = "saucer", at = [240, 225, 77] },
{ name = "чашка", object = "cup", at = [242, 228, 79] },
"#,
        STACK,
        &expect![[r#"
            ON_TOP_OF: блюдце, поднос
            ON_TOP_OF: поднос, стол
            ON_TOP_OF: чашка, блюдце
        "#]],
    );
}

#[test]
fn a_table_has_a_floor_below_and_room_above() {
    // A cat between the legs, a lamp above the top, a carpet beneath the legs: the lamp is not above the carpet.
    check(
        r#"
{ name = "ковёр", object = "carpet", at = [150, 150] },
{ name = "стол", object = "table", at = [200, 200, 1] },
{ name = "кот", object = "cat", at = [230, 225, 1] },
{ name = "люстра", object = "lamp", at = [240, 220, 200] },
"#,
        STACK,
        &expect![[r#"
            ON_TOP_OF: кот, ковёр
            ON_TOP_OF: стол, ковёр
            ABOVE: люстра, стол
            UNDER: кот, стол
        "#]],
    );
}

#[test]
fn books_in_a_bookcase_and_on_it() {
    check(
        r#"
{ name = "стеллаж", object = "bookcase", at = [100, 100] },
{ name = "том-1", object = "book", at = [110, 108, 60] },
{ name = "том-2", object = "book", at = [115, 108, 60] },
{ name = "том-3", object = "book", at = [110, 108, 110] },
{ name = "том-4", object = "book", at = [110, 108, 190] },
{ name = "том-5", object = "book", at = [110, 60, 0] },
"#,
        "RESTS_ON ON_TOP_OF ABOVE UNDER INSIDE NEXT_TO",
        &expect![[r#"
            RESTS_ON: том-1, стеллаж
            RESTS_ON: том-2, стеллаж
            RESTS_ON: том-3, стеллаж
            RESTS_ON: том-4, стеллаж
            ON_TOP_OF: том-4, стеллаж
            INSIDE: том-1, стеллаж
            INSIDE: том-2, стеллаж
            INSIDE: том-3, стеллаж
            NEXT_TO: том-1, том-2
            NEXT_TO: том-2, том-1
        "#]],
    );
}

#[test]
fn boxes_within_boxes() {
    // The stick reaches out of the open box; the cube on the chest is not in it; the book is in the box in the corner table.
    check(
        r#"
{ name = "ящик", object = "box", at = [100, 100] },
{ name = "швабра", object = "stick", at = [110, 110] },
{ name = "сундук", object = "drawer", at = [300, 100] },
{ name = "том", object = "book", at = [310, 110, 5] },
{ name = "куб", object = "cube", at = [300, 100, 40] },
{ name = "большой", object = "ell", at = [400, 300] },
{ name = "малый", object = "box", at = [410, 310, 20] },
{ name = "вложенный", object = "book", at = [420, 320, 21] },
{ name = "в углу", object = "cat", at = [480, 420] },
"#,
        STACK,
        &expect![[r#"
            ON_TOP_OF: куб, сундук
            INSIDE: вложенный, большой
            INSIDE: вложенный, малый
            INSIDE: малый, большой
            INSIDE: том, сундук
            INSIDE: швабра, ящик
        "#]],
    );
}

#[test]
fn one_direct_support_the_highest_then_the_smallest() {
    check(
        r#"
{ name = "куб-1", object = "cube", at = [100, 100] },
{ name = "куб-2", object = "cube", at = [140, 100] },
{ name = "поднос", object = "tray", at = [115, 105, 40] },
{ name = "ковёр", object = "carpet", at = [300, 100] },
{ name = "подстилка", object = "tray", at = [310, 110, 1] },
{ name = "чашка", object = "cup", at = [320, 120, 3] },
"#,
        "RESTS_ON ON_TOP_OF",
        &expect![[r#"
            RESTS_ON: поднос, куб-1
            RESTS_ON: подстилка, ковёр
            RESTS_ON: чашка, подстилка
            ON_TOP_OF: поднос, куб-1
            ON_TOP_OF: подстилка, ковёр
            ON_TOP_OF: чашка, подстилка
        "#]],
    );
}

#[test]
fn tolerance_follows_the_profile() {
    let lifted = room(
        0.0,
        r#"
{ name = "куб", object = "cube", at = [100, 100] },
{ name = "чашка", object = "cup", at = [115, 115, 45] },
"#,
    );
    let on = |profile| {
        let relations = derive(&lifted, &RULES, profile).expect("rules end");
        list(&relations, "ON_TOP_OF ABOVE")
    };
    expect![[r#"
        ABOVE: чашка, куб
    "#]]
    .assert_eq(&on(Profile::Surveyed));
    expect![[r#"
        ON_TOP_OF: чашка, куб
    "#]]
    .assert_eq(&on(Profile::Detected));
}

#[test]
fn next_to_and_beside_and_what_stands_between() {
    // cube-3 stands at the other end of the wardrobe; cube-4 diagonally; cube-5 too far.
    check(
        r#"
{ name = "куб-1", object = "cube", at = [100, 100] },
{ name = "куб-2", object = "cube", at = [150, 105] },
{ name = "шкаф", object = "wardrobe", at = [300, 100] },
{ name = "куб-3", object = "cube", at = [410, 110] },
{ name = "куб-4", object = "cube", at = [195, 150] },
{ name = "куб-5", object = "cube", at = [100, 300] },
"#,
        "NEXT_TO BESIDE",
        &expect![[r#"
            NEXT_TO: куб-1, куб-2
            NEXT_TO: куб-2, куб-1
            NEXT_TO: куб-2, куб-4
            NEXT_TO: куб-3, шкаф
            NEXT_TO: куб-4, куб-2
            NEXT_TO: шкаф, куб-3
            BESIDE: куб-1, куб-2
            BESIDE: куб-2, куб-1
            BESIDE: куб-3, шкаф
            BESIDE: шкаф, куб-3
        "#]],
    );
    check(
        r#"
{ name = "куб-1", object = "cube", at = [100, 100] },
{ name = "доска", object = "stick", at = [143, 118] },
{ name = "куб-2", object = "cube", at = [150, 100] },
"#,
        "NEXT_TO",
        &expect![[r#"
            NEXT_TO: доска, куб-1
            NEXT_TO: доска, куб-2
            NEXT_TO: куб-1, доска
            NEXT_TO: куб-2, доска
        "#]],
    );
}

#[test]
fn close_to_counts_surfaces_not_centres() {
    check(
        r#"
{ name = "шкаф", object = "wardrobe", at = [100, 100] },
{ name = "куб-1", object = "cube", at = [325, 100] },
{ name = "куб-2", object = "cube", at = [100, 295] },
"#,
        "CLOSE_TO",
        &expect![[r#"
            CLOSE_TO: куб-1, шкаф
            CLOSE_TO: шкаф, куб-1
        "#]],
    );
}

#[test]
fn a_broom_leans_a_bookcase_does_not() {
    check(
        r#"
{ name = "шкаф", object = "wardrobe", at = [100, 100] },
{ name = "стеллаж", object = "bookcase", at = [203, 100] },
{ name = "швабра", object = "stick", at = [97, 120], move_prob = 90 },
{ name = "палка", object = "stick", at = [140, 155], move_prob = 90 },
{ name = "веха", object = "stick", at = [500, 400], move_prob = 90 },
"#,
        "LEANING_AGAINST NEXT_TO",
        &expect![[r#"
            LEANING_AGAINST: палка, шкаф
            LEANING_AGAINST: швабра, шкаф
            NEXT_TO: стеллаж, шкаф
            NEXT_TO: шкаф, стеллаж
        "#]],
    );
}

#[test]
fn left_and_right_are_the_anchors_own() {
    // The wardrobe faces -y of its frame; the second stands turned by 180°.
    check(
        r#"
{ name = "шкаф", object = "wardrobe", at = [300, 300] },
{ name = "лево", object = "cube", at = [430, 310] },
{ name = "право", object = "cube", at = [230, 310] },
{ name = "перед", object = "cube", at = [330, 200] },
{ name = "зад", object = "cube", at = [330, 400] },
{ name = "круг", object = "round", at = [600, 100] },
"#,
        "LEFT_OF RIGHT_OF IN_FRONT_OF BEHIND",
        &expect![[r#"
            LEFT_OF: круг, шкаф
            LEFT_OF: лево, шкаф
            RIGHT_OF: право, шкаф
            IN_FRONT_OF: перед, шкаф
            BEHIND: зад, шкаф
        "#]],
    );
    check(
        r#"
{ name = "шкаф", object = "wardrobe", at = [400, 360], angle = 180 },
{ name = "лево", object = "cube", at = [230, 310] },
"#,
        "LEFT_OF RIGHT_OF IN_FRONT_OF BEHIND",
        &expect![[r#"
            LEFT_OF: лево, шкаф
        "#]],
    );
}

#[test]
fn a_frustum_bears_on_its_roof_alone() {
    // The pouf's roof has a fifth of its base's size: a tray is centred on it, a cup over its slope is not.
    check(
        r#"
{ name = "пуф", object = "cone", at = [200, 200] },
{ name = "поднос", object = "tray", at = [183, 215, 60] },
{ name = "пуф-2", object = "cone", at = [400, 200] },
{ name = "чашка", object = "cup", at = [440, 220, 60] },
"#,
        "ON_TOP_OF",
        &expect![[r#"
            ON_TOP_OF: поднос, пуф
        "#]],
    );
}

#[test]
fn parts_of_a_stool_and_their_properties() {
    let relations = derived(&room(
        0.0,
        r#"
{ name = "табурет", object = "stool", at = [200, 200], properties = { "ЦВЕТ" = "Синий" } },
"#,
    ));
    let about = |name: &str| -> String {
        relations
            .of(name)
            .iter()
            .map(|(relation, t)| {
                let words: Vec<String> = t.iter().map(ToString::to_string).collect();
                format!("{relation}: {}\n", words.join(", "))
            })
            .collect()
    };
    expect![[r#"
        НАХОДИТСЯ_ВНУТРИ: табурет, Комната
        СОДЕРЖИТ: Комната, табурет
        ЯВЛЯЕТСЯ_ЧАСТЬЮ: Опора, Стул
        ЯВЛЯЕТСЯ_ЧАСТЬЮ: Сиденье, Стул
        ЯВЛЯЕТСЯ_ЧАСТЬЮ: Спинка, Стул
        СОСТОИТ_ИЗ: Стул, Опора
        СОСТОИТ_ИЗ: Стул, Сиденье
        СОСТОИТ_ИЗ: Стул, Спинка
        ЯВЛЯЕТСЯ_НИЖНЕЙ_ЧАСТЬЮ: Опора, Стул
        ЯВЛЯЕТСЯ_ВЕРХНЕЙ_ЧАСТЬЮ: Спинка, Стул
        ЯВЛЯЕТСЯ_ЗАДНЕЙ_ЧАСТЬЮ: Спинка, Стул
        ЯВЛЯЕТСЯ_ЭКЗЕМПЛЯРОМ: табурет, Стул
        ИМЕЕТ: табурет, МАТЕРИАЛ, Дерево
        ИМЕЕТ: табурет, ЦВЕТ, Синий
    "#]]
    .assert_eq(&about("табурет"));
    expect![[r#"
        ЯВЛЯЕТСЯ_ЧАСТЬЮ: Опора, Стул
        СОСТОИТ_ИЗ: Стул, Опора
        ЯВЛЯЕТСЯ_НИЖНЕЙ_ЧАСТЬЮ: Опора, Стул
        ИМЕЕТ: Опора, ЦВЕТ, Чёрный
    "#]]
    .assert_eq(&about("Опора"));
    expect![[r#"
        НАХОДИТСЯ_ВНУТРИ: табурет, Комната
        СОДЕРЖИТ: Комната, табурет
        ЯВЛЯЕТСЯ_ЧАСТЬЮ: Пол, Комната
        СОСТОИТ_ИЗ: Комната, Пол
    "#]]
    .assert_eq(&about("комната"));
}

/// Two rooms of 3 × 4 m and a lobby: joined by a link, by a wall of 20 cm with a door on each side, at a corner, by a passage.
const ROOMS: &str = r#"
format = 1
[orthoframe.a]
name = "Пол А"
height = 270
points = [[0, 0], [300, 0], [300, 100], [300, 190], [300, 400], [200, 400], [110, 400], [0, 400]]
side.C = { permeability = "conditional" }
side.F = { permeability = "permeable" }
[orthoframe.b]
name = "Пол Б"
height = 270
points = [[0, 0], [300, 0], [300, 400], [0, 400], [0, 190], [0, 100]]
side.E = { permeability = "conditional" }
[orthoframe.c]
name = "Пол В"
height = 270
points = [[0, 0], [110, 0], [200, 0], [300, 0], [300, 200], [0, 200]]
side.B = { permeability = "permeable" }
[door.ab]
name = "Дверь-АБ"
kind = "hinged"
width = 90
height = 200
leaves = [{ hinge = "left", share = 1, thickness = 4, max_open = 90 }]
state = "STATE"
[area.a]
name = "А"
items = [{ id = "A", orthoframe = "a" }]
doors = [{ side = "C", door = "ab", opens = "inside" }]
[area.b]
name = "Б"
items = [{ id = "A", orthoframe = "b" }]
doors = [{ side = "E", door = "ab", opens = "outside" }]
[area.c]
name = "В"
items = [{ id = "A", orthoframe = "c" }]
[map.flat]
name = "Карта"
items = [{ area = "a" }, { area = "b", at = [300, 0] }, { area = "c", at = [0, 400] }]
links = [{ from = "a.C", to = "b.E" }, { from = "a.F", to = "c.B" }]
"#;

/// The rooms as a survey without links, or an importer, would leave them: checks ask for links, relations do without.
fn rooms_apart(state: &str, second: bool, wall: f64, links: bool) -> World {
    let mut world = world(&ROOMS.replace("STATE", state));
    let b = world.areas.values().find(|a| a.name == "Б").expect("the second room").id;
    if !second {
        world.areas.get_mut(&b).expect("just found").doors.clear();
    }
    for map in world.maps.values_mut() {
        if !links {
            map.links.clear();
        }
        let item = map.items.iter_mut().find(|i| i.area == b).expect("it is on the map");
        item.frame = Frame::new(300.0 + wall, 0.0, 0.0, Deg::ZERO);
    }
    world
}

fn rooms(state: &str, second: bool, wall: f64, links: bool) -> String {
    let world = rooms_apart(state, second, wall, links);
    list(&derived(&world), "HAS_DOOR_TO HAS_PASSAGE_TO CAN_DRIVE_TO DOOR_IS")
}

#[test]
fn doors_by_link_by_both_mounts_and_by_stepping_through() {
    let all = expect![[r#"
        HAS_DOOR_TO: А, Б
        HAS_DOOR_TO: Б, А
        HAS_PASSAGE_TO: А, В
        HAS_PASSAGE_TO: В, А
        CAN_DRIVE_TO: А, Б
        CAN_DRIVE_TO: А, В
        CAN_DRIVE_TO: Б, А
        CAN_DRIVE_TO: В, А
        DOOR_IS: Дверь-АБ, open
    "#]];
    let linked = rooms("open", true, 0.0, true);
    all.assert_eq(&linked);
    assert_eq!(rooms("open", true, 20.0, false), linked);
    assert_eq!(rooms("open", false, 20.0, false), linked);
    assert_eq!(rooms("open", false, 0.0, false), linked);
}

#[test]
fn a_closed_door_is_a_door_that_cannot_be_driven_through() {
    expect![[r#"
        HAS_DOOR_TO: А, Б
        HAS_DOOR_TO: Б, А
        HAS_PASSAGE_TO: А, В
        HAS_PASSAGE_TO: В, А
        CAN_DRIVE_TO: А, В
        CAN_DRIVE_TO: В, А
        DOOR_IS: Дверь-АБ, locked
    "#]]
    .assert_eq(&rooms("locked", false, 20.0, false));
    // A hole in the wall of 90 cm leads nowhere.
    expect![[r#"
        HAS_PASSAGE_TO: А, В
        HAS_PASSAGE_TO: В, А
        CAN_DRIVE_TO: А, В
        CAN_DRIVE_TO: В, А
        DOOR_IS: Дверь-АБ, open
    "#]]
    .assert_eq(&rooms("open", false, 90.0, false));
}

#[test]
fn everything_is_inside_its_room_and_outside_the_others() {
    let things = r#"
[orthoframe.cube]
name = "Куб"
rect = [40, 40]
height = 40
[orthoframe.shelf]
name = "Доска"
rect = [60, 20]
height = 3
[object.cube]
name = "Куб"
items = [{ id = "A", orthoframe = "cube" }]
[object.shelf]
name = "Доска"
items = [{ id = "A", orthoframe = "shelf" }]
[map.flat]"#;
    let replicas = r#"items = [{ id = "A", orthoframe = "c" }]
replicas = [
  { name = "куб", object = "cube", at = [10, 10] },
  { name = "полка в стене", object = "shelf", at = [100, 100, 120] },
  { name = "куб на полке", object = "cube", at = [110, 100, 123] },
  { name = "за окном", object = "cube", at = [100, 100] },
]"#;
    let text = ROOMS
        .replace("STATE", "open")
        .replace("[map.flat]", things)
        .replace(r#"items = [{ id = "A", orthoframe = "c" }]"#, replicas);
    let mut world = world(&text);
    // Room В is two metres deep: the shelf hangs in its wall, the last cube lies in the yard.
    for (name, y) in [("полка в стене", 205.0), ("куб на полке", 203.0), ("за окном", 300.0)]
    {
        let replica = world.replicas.values_mut().find(|r| r.name == name).expect("it is named so");
        let Frame { x, z, .. } = replica.frame;
        replica.frame = Frame::new(x.get(), y, z.get(), Deg::ZERO);
    }
    expect![[r#"
        INSIDE: куб, В
        INSIDE: куб на полке, В
        INSIDE: полка в стене, В
        CONTAINS: В, куб
        CONTAINS: В, куб на полке
        CONTAINS: В, полка в стене
        OUTSIDE: за окном, А
        OUTSIDE: за окном, Б
        OUTSIDE: за окном, В
        OUTSIDE: куб, А
        OUTSIDE: куб, Б
        OUTSIDE: куб на полке, А
        OUTSIDE: куб на полке, Б
        OUTSIDE: полка в стене, А
        OUTSIDE: полка в стене, Б
    "#]]
    .assert_eq(&list(&derived(&world), "INSIDE CONTAINS OUTSIDE"));
}

#[test]
fn a_user_adds_a_relation_by_a_text() {
    let own = Source::new(
        "свои.dl",
        r#"
.decl ПРЕПЯТСТВУЕТ(x: Thing, y: Thing) = OBSTRUCTS
.output ПРЕПЯТСТВУЕТ
ПРЕПЯТСТВУЕТ(X, Y) :- НАХОДИТСЯ_ПЕРЕД(X, Y), НАХОДИТСЯ_РЯДОМ_С(X, Y).
limit("surveyed", "close distance", 1000).
"#,
    );
    let rules = RelationRules::with(&own).expect("the text is sound");
    let world = room(
        0.0,
        r#"
{ name = "шкаф", object = "wardrobe", at = [100, 100] },
{ name = "куб", object = "cube", at = [120, 50] },
{ name = "куб-2", object = "cube", at = [120, 0] },
"#,
    );
    let relations = derive(&world, &rules, Profile::Surveyed).expect("rules end");
    expect![[r#"
        OBSTRUCTS: куб, шкаф
        CLOSE_TO: куб, куб-2
        CLOSE_TO: куб, шкаф
        CLOSE_TO: куб-2, куб
        CLOSE_TO: шкаф, куб
    "#]]
    .assert_eq(&list(&relations, "OBSTRUCTS CLOSE_TO"));
}

#[test]
fn a_rule_text_that_changes_a_measurement_is_refused() {
    let text = orthoframe::semantics::STANDARD
        .replace(
            ".decl distance(a: Thing, b: Thing, d: number)",
            ".decl distance(a: Thing, b: Thing)",
        )
        .replace(
            "distance(A, B, D), threshold(\"close distance\", Most), D <= Most",
            "distance(A, B)",
        );
    let rules =
        RelationRules::parse(&[Source::new("мои.dl", text)]).expect("it is sound by itself");
    let world = room(
        0.0,
        r#"
{ name = "куб", object = "cube", at = [120, 50] },
{ name = "куб-2", object = "cube", at = [120, 0] },
"#,
    );
    let error = derive(&world, &rules, Profile::Surveyed).expect_err("the columns differ");
    expect!["у «distance» столбцов 2, а дано значений 3"].assert_eq(&error.to_string());
}

// ─── Random worlds ──────────────────────────────────────────────────────────────────────────────

/// Kind, x, y, z and angle of a thing.
type Placed = (usize, i32, i32, i32, i32);

fn placed() -> impl Strategy<Value = Placed> {
    let heights = prop::sample::select(vec![0, 0, 1, 2, 10, 40, 41, 60, 75, 76, 77, 110, 190, 200]);
    let angles = prop::sample::select(vec![0, 0, 90, 180, 270, 30, 77]);
    (0usize..16, 0..420, 0..320, heights, angles)
}

const KINDS: [&str; 16] = [
    "table", "tray", "saucer", "cup", "bookcase", "book", "cube", "box", "drawer", "stick",
    "carpet", "cat", "lamp", "ell", "stool", "cone",
];

/// Things in places that a checked map would refuse too: within each other, and through the walls.
fn furnished(things: &[Placed]) -> World {
    let mut lines = String::new();
    for (n, (kind, ..)) in things.iter().enumerate() {
        let object = KINDS[*kind];
        let line = format!(
            r#"{{ name = "вещь-{n}", object = "{object}", at = [300, 300], move_prob = 50 }},"#
        );
        lines.push_str(&line);
        lines.push('\n');
    }
    let mut world = room(0.0, &lines);
    for (replica, to) in world.replicas.values_mut().zip(things) {
        replica.frame = frame(to);
    }
    world
}

fn frame(to: &Placed) -> Frame {
    Frame::new(f64::from(to.1), f64::from(to.2), f64::from(to.3), Deg::of(f64::from(to.4)))
}

fn moved(world: &World, n: usize, to: Placed) -> (World, ReplicaId) {
    let mut world = world.clone();
    let id = *world.replicas.keys().nth(n).expect("the world has so many");
    let replica = world.replicas.get_mut(&id).expect("its own key");
    replica.frame = frame(&to);
    (world, id)
}

type Edges = BTreeSet<(String, String)>;

fn edges(relations: &Relations, name: &str) -> Edges {
    let tuples = relations.tuples(name).expect("a standard relation");
    tuples
        .iter()
        .map(|t| (t[0].to_string(), t[1].to_string()))
        .filter(|e| e.1 != "Комната" && e.0 != "Комната")
        .collect()
}

fn is_acyclic(edges: &Edges) -> bool {
    // Whoever stands under nothing that is left goes first.
    let mut left = edges.clone();
    loop {
        let held: BTreeSet<String> = left.iter().map(|e| e.0.clone()).collect();
        let before = left.len();
        left.retain(|e| held.contains(&e.1));
        if left.is_empty() {
            return true;
        }
        if left.len() == before {
            return false;
        }
    }
}

fn check_invariants(relations: &Relations) {
    let four = ["INSIDE", "ON_TOP_OF", "ABOVE", "UNDER"].map(|n| edges(relations, n));
    for (i, a) in four.iter().enumerate() {
        for (x, y) in a {
            assert_ne!(x, y);
            for b in &four[i..] {
                let other = (y.clone(), x.clone());
                assert!(!b.contains(&other), "{x} {y} both ways");
            }
            for b in &four[i + 1..] {
                assert!(!b.contains(&(x.clone(), y.clone())), "{x} {y} twice");
            }
        }
    }
    let supports = edges(relations, "RESTS_ON");
    let supported: BTreeSet<&String> = supports.iter().map(|e| &e.0).collect();
    assert_eq!(supported.len(), supports.len(), "one direct support");
    for acyclic in [&supports, &four[0], &four[1]] {
        assert!(is_acyclic(acyclic), "{acyclic:?}");
    }
    for symmetric in ["NEXT_TO", "BESIDE", "CLOSE_TO"].map(|n| edges(relations, n)) {
        assert!(
            symmetric.iter().all(|(x, y)| x != y && symmetric.contains(&(y.clone(), x.clone())))
        );
    }
    assert!(edges(relations, "BESIDE").is_subset(&edges(relations, "NEXT_TO")));
    for stronger in &four {
        assert!(stronger.is_disjoint(&edges(relations, "NEXT_TO")));
    }
    let sectors = ["LEFT_OF", "RIGHT_OF", "IN_FRONT_OF", "BEHIND"].map(|n| edges(relations, n));
    for (i, a) in sectors.iter().enumerate() {
        assert!(sectors[i + 1..].iter().all(|b| a.is_disjoint(b)));
    }
    let inside = relations.tuples("CONTAINS").expect("standard").len();
    let outside = relations.tuples("OUTSIDE").expect("standard").len();
    assert_eq!(inside + outside, relations.tuples("INSTANCE_OF").expect("standard").len());
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn precedence_order_and_symmetry_hold_in_any_room(things in prop::collection::vec(placed(), 1..30)) {
        let world = furnished(&things);
        for profile in [Profile::Surveyed, Profile::Detected] {
            check_invariants(&derive(&world, &RULES, profile).expect("rules end"));
        }
    }

    #[test]
    fn near_pairs_are_all_that_pairs_alone_would_give(things in prop::collection::vec(placed(), 2..12)) {
        // The obvious slow way: every pair in a world of its own.
        let world = furnished(&things);
        let measured = Measurements::of(&world, Reach::default());
        let ids: Vec<ReplicaId> = world.replicas.keys().copied().collect();
        for (i, &a) in ids.iter().enumerate() {
            for &b in &ids[i + 1..] {
                let mut two = world.clone();
                two.replicas.retain(|&id, _| id == a || id == b);
                let alone = Measurements::of(&two, Reach::default()).of_pair(a, b).cloned();
                let here = measured.of_pair(a, b).cloned();
                let strip = |p: Option<Pair>| p.map(|mut p| {
                    p.beside.iter_mut().for_each(|b| b.between.clear());
                    p
                });
                prop_assert_eq!(strip(here), strip(alone));
            }
        }
    }

    #[test]
    fn a_move_gives_what_measuring_anew_gives(
        things in prop::collection::vec(placed(), 2..20),
        moves in prop::collection::vec((0usize..20, placed()), 1..6),
    ) {
        let mut world = furnished(&things);
        let mut measured = Measurements::of(&world, Reach::default());
        let mut relations = derived(&world);
        for (n, to) in moves {
            let (after, id) = moved(&world, n % things.len(), to);
            let change = measured.update(&after, id);
            let anew = Measurements::of(&after, Reach::default());
            prop_assert!(measured == anew);
            // What is said to have changed is what has changed.
            prop_assert!(change.removed.keys().all(|k| k.0 == id || k.1 == id || change.added.contains(k)));
            prop_assert!(relations.update(&after, id).expect("rules end"));
            let fresh = derived(&after);
            for count in fresh.counts() {
                prop_assert_eq!(
                    relations.tuples(&count.name).expect("same rules"),
                    fresh.tuples(&count.name).expect("same rules")
                );
            }
            for &id in after.replicas.keys() {
                prop_assert_eq!(relations.area_of(id), fresh.area_of(id));
                prop_assert_eq!(relations.support_of(id), fresh.support_of(id));
                prop_assert_eq!(relations.bears_something(id), fresh.bears_something(id));
            }
            // What was kept is taken up again, pairs not yet measured.
            if n % 2 == 0 {
                let bytes = relations.save().expect("no edit waits");
                let rules = RelationRules::standard();
                relations = Relations::restore(&after, &rules, Profile::Surveyed, &bytes)
                    .expect("the same rules");
                prop_assert!(
                    Relations::restore(&after, &rules, Profile::Detected, &bytes).is_none()
                );
            }
            world = after;
        }
    }
}

// ─── Why, why not, and how it looks from here ───────────────────────────────────────────────────

const LIFTED: &str = r#"
{ name = "Куб", object = "cube", at = [100, 100] },
{ name = "Чашка-1", object = "cup", at = [115, 115, 40] },
{ name = "Чашка-2", object = "cup", at = [125, 115, 45] },
"#;

#[test]
fn a_proof_goes_down_to_the_measurements() {
    let relations = derived(&room(0.0, LIFTED));
    let proof = relations.why("ON_TOP_OF", &["чашка-1", "куб"]).expect("it is asked rightly");
    let told: Vec<String> = proof
        .expect("it holds")
        .steps
        .iter()
        .filter(|s| s.height == 0)
        .map(|s| {
            let values: Vec<String> = s.fact.values.iter().map(ToString::to_string).collect();
            format!("{}: {}\n", s.fact.name, values.join(", "))
        })
        .collect();
    expect![[r#"
        over: Чашка-1, Куб, Куб #10, solid, 0, 1000, 1, 2000
        body: Куб, 0, 4000, 4000, 4000, 1600
        replica: Куб, 1, Куб (cube), Комната, 0
        profile: surveyed
        limit: surveyed, support gap up, 200
        limit: surveyed, support gap down, 200
        limit: common, support share, 500
    "#]]
    .assert_eq(&told.concat());
    assert_eq!(relations.why("ON_TOP_OF", &["чашка-2", "куб"]).expect("it is asked rightly"), None);
}

#[test]
fn why_not_names_the_premise_that_failed_with_its_numbers() {
    let relations = derived(&room(
        0.0,
        r#"
{ name = "Шкаф", object = "wardrobe", at = [300, 300] },
{ name = "Куб", object = "cube", at = [430, 310] },
"#,
    ));
    let question = relations.why_not("НАХОДИТСЯ_ПЕРЕД", &["куб", "шкаф"]);
    let WhyNot::Nearest(rule) = question.expect("asked rightly") else {
        panic!("it does not hold, and rules derive it");
    };
    // Ninety degrees to the left, where forty-five are in front.
    expect![[r#"
        [
            Compared {
                text: "Angle <= H",
                left: Number(
                    9000,
                ),
                op: LessOrEqual,
                right: Number(
                    4500,
                ),
            },
        ]
    "#]]
    .assert_debug_eq(&rule.failed().collect::<Vec<_>>());
}

#[test]
fn an_unknown_relation_is_answered_with_the_nearest_name() {
    let relations = derived(&room(0.0, LIFTED));
    let error = relations.tuples("НАХОДИТСЯ_СВЕРХУ").expect_err("no such relation");
    expect!["нет отношения «НАХОДИТСЯ_СВЕРХУ»; может быть, «НАХОДИТСЯ_СВЕРХУ_НА»?"].assert_eq(
        &format!("{error}; {}", miette::Diagnostic::help(&error).expect("it has a remedy")),
    );
}

#[test]
fn left_for_the_viewer_is_not_left_of_the_thing() {
    // The wardrobe faces down; the viewer stands above it and looks down: his left is its left no more.
    let world = room(
        0.0,
        r#"
{ name = "шкаф", object = "wardrobe", at = [300, 300] },
{ name = "куб", object = "cube", at = [430, 310] },
"#,
    );
    let relations = derived(&world);
    let map = *world.maps.keys().next().expect("one map");
    let seen = |y: f64| -> String {
        relations
            .seen_from(map, Point::new(390.0, y))
            .expect("standard rules")
            .iter()
            .map(|s| format!("{}: {}, {}\n", s.relation_en, s.thing, s.anchor))
            .collect()
    };
    expect![[r#"
        LEFT_FOR_VIEWER: шкаф, куб
        RIGHT_FOR_VIEWER: куб, шкаф
    "#]]
    .assert_eq(&seen(50.0));
    expect![[r#"
        LEFT_FOR_VIEWER: куб, шкаф
        RIGHT_FOR_VIEWER: шкаф, куб
    "#]]
    .assert_eq(&seen(550.0));
    assert!(relations.holds("LEFT_OF", &["куб", "шкаф"]));
}
