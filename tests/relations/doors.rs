//! Doors and passages between Areas, and what is in which Area.

use expect_test::expect;
use orthoframe_map::World;
use orthoframe_units::{Deg, Frame};

use super::{derived, list, world};

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

/// Areas on one Map without links, as a survey would leave them: a Map that is read must have links, so each Area is
/// read on a Map of its own.
fn without_links(text: &str, areas: &[&str], frame: impl Fn(usize) -> Frame) -> World {
    let map = |area: &&str| {
        format!("[map.m-{area}]\nname = \"Карта {area}\"\nitems = [{{ area = \"{area}\" }}]\n")
    };
    let maps: String = areas.iter().map(map).collect();
    let listed: String = areas.iter().map(|area| format!("{{ map = \"m-{area}\" }}, ")).collect();
    let mut world = world(&format!("{text}{maps}[domain]\nmaps = [{listed}]\n"));
    let mut items: Vec<_> = world.maps.values().flat_map(|map| map.items.iter().cloned()).collect();
    items.iter_mut().enumerate().for_each(|(n, item)| item.frame = frame(n));
    let first = *world.maps.keys().next().expect("there is an Area");
    world.maps.retain(|id, _| *id == first);
    world.maps.get_mut(&first).expect("just kept").items = items;
    world
}

/// Four rooms round a point, walls of `wall` cm between them, a door from each into the next right by the corner;
/// the whole turned by `angle`. Only one side of each pair has the door.
fn round_a_corner(wall: f64, angle: f64) -> String {
    let room = |name: &str, side: &str| {
        format!(
            r#"
[orthoframe.{name}]
name = "Пол {name}"
height = 270
points = [[0, 0], [300, 0], [300, 100], [300, 190], [300, 200], [0, 200]]
side.{side} = {{ permeability = "conditional" }}
[door.{name}]
name = "Дверь {name}"
kind = "hinged"
width = 90
height = 200
leaves = [{{ hinge = "left", share = 1, thickness = 4, max_open = 90 }}]
state = "closed"
[area.{name}]
name = "{name}"
items = [{{ id = "A", orthoframe = "{name}" }}]
doors = [{{ side = "{side}", door = "{name}", opens = "inside" }}]
"#
        )
    };
    // Each room has its own corner at (300, 200), beside which the door is; a turn by 90° brings the next.
    let names = ["south-west", "south-east", "north-east", "north-west"];
    let mut text = String::from("format = 1\n");
    names.iter().for_each(|name| text += &room(name, "C"));
    let whole = Frame::new(11.0, 7.0, 0.0, Deg::of(angle));
    let frame = |n: usize| {
        let quarter = Frame::new(0.0, 0.0, 0.0, Deg::of(90.0 * n as f64));
        let from_corner = Frame::new(-300.0 - wall / 2.0, -200.0 - wall / 2.0, 0.0, Deg::ZERO);
        whole.compose(&quarter.compose(&from_corner))
    };
    let world = without_links(&text, &names, frame);
    list(&derived(&world), "HAS_DOOR_TO")
}

#[test]
fn doors_that_meet_at_a_corner_lead_straight_on() {
    let all = expect![[r#"
        HAS_DOOR_TO: north-east, north-west
        HAS_DOOR_TO: north-east, south-east
        HAS_DOOR_TO: north-west, north-east
        HAS_DOOR_TO: north-west, south-west
        HAS_DOOR_TO: south-east, north-east
        HAS_DOOR_TO: south-east, south-west
        HAS_DOOR_TO: south-west, north-west
        HAS_DOOR_TO: south-west, south-east
    "#]];
    let straight = round_a_corner(0.0, 0.0);
    all.assert_eq(&straight);
    for wall in [0.0, 5.0, 20.0] {
        for angle in [0.0, 45.0, 17.3] {
            assert_eq!(round_a_corner(wall, angle), straight, "{wall} cm, {angle}°");
        }
    }
}

/// A room of three Orthoframes round a yard, with another room in the notch.
const HORSESHOE: &str = r#"
format = 1
[type]
object = [{ name = "Вещь" }]
[orthoframe.arm]
name = "Крыло"
height = 270
points = [[0, 0], [200, 0], [200, 400], [0, 400]]
side.C = { permeability = "permeable" }
[orthoframe.other-arm]
name = "Другое крыло"
height = 270
points = [[0, 0], [200, 0], [200, 400], [0, 400]]
side.C = { permeability = "permeable" }
[orthoframe.span]
name = "Перекладина"
height = 270
points = [[0, 0], [200, 0], [400, 0], [600, 0], [600, 200], [0, 200]]
side.A = { permeability = "permeable" }
side.C = { permeability = "permeable" }
[orthoframe.notch]
name = "Пол ниши"
height = 270
points = [[0, 0], [190, 0], [190, 150], [190, 240], [190, 390], [0, 390]]
side.C = { permeability = "conditional" }
[orthoframe.cube]
name = "Куб"
rect = [40, 40]
height = 40
[object.cube]
name = "Куб"
type = "Вещь"
items = [{ id = "A", orthoframe = "cube" }]
[door.d]
name = "Дверь ниши"
kind = "hinged"
width = 90
height = 200
leaves = [{ hinge = "left", share = 1, thickness = 4, max_open = 90 }]
state = "open"
[area.shoe]
name = "Подкова"
items = [
  { id = "A", orthoframe = "arm" }, { id = "B", orthoframe = "other-arm", at = [400, 0] },
  { id = "C", orthoframe = "span", at = [0, 400] },
]
links = [{ from = "A.C", to = "C.A" }, { from = "B.C", to = "C.C" }]
replicas = [
  { name = "до шва", object = "cube", at = [80, 350] },
  { name = "за швом", object = "cube", at = [80, 401] },
  { name = "на шве", object = "cube", at = [500, 380] },
  { name = "в левом крыле", object = "cube", at = [160, 100] },
  { name = "в правом крыле", object = "cube", at = [400, 100] },
]
[area.notch]
name = "Ниша"
items = [{ id = "A", orthoframe = "notch" }]
doors = [{ side = "C", door = "d", opens = "inside" }]
replicas = [{ name = "в нише", object = "cube", at = [0, 100] }]
"#;

#[test]
fn an_area_of_several_orthoframes_is_one_room() {
    let told = |whole: Frame| {
        let places = [Frame::new(0.0, 0.0, 0.0, Deg::ZERO), Frame::new(205.0, 5.0, 0.0, Deg::ZERO)];
        let world = without_links(HORSESHOE, &["shoe", "notch"], |n| whole.compose(&places[n]));
        list(&derived(&world), "INSIDE OUTSIDE NEXT_TO HAS_DOOR_TO HAS_PASSAGE_TO CAN_DRIVE_TO")
    };
    let straight = told(Frame::new(0.0, 0.0, 0.0, Deg::ZERO));
    expect![[r#"
        INSIDE: в левом крыле, Подкова
        INSIDE: в нише, Ниша
        INSIDE: в правом крыле, Подкова
        INSIDE: до шва, Подкова
        INSIDE: за швом, Подкова
        INSIDE: на шве, Подкова
        OUTSIDE: в левом крыле, Ниша
        OUTSIDE: в нише, Подкова
        OUTSIDE: в правом крыле, Ниша
        OUTSIDE: до шва, Ниша
        OUTSIDE: за швом, Ниша
        OUTSIDE: на шве, Ниша
        NEXT_TO: до шва, за швом
        NEXT_TO: за швом, до шва
        HAS_DOOR_TO: Ниша, Подкова
        HAS_DOOR_TO: Подкова, Ниша
        CAN_DRIVE_TO: Ниша, Подкова
        CAN_DRIVE_TO: Подкова, Ниша
    "#]]
    .assert_eq(&straight);
    assert_eq!(told(Frame::new(-120.0, 45.0, 0.0, Deg::of(123.4))), straight);
}
