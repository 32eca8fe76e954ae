//! Maps that read well and cannot be: each sort of doubt in its place, and none about maps that are sound.

use std::collections::BTreeSet;

use miette::Diagnostic;
use orthoframe_map::{
    Fault, Format, MapError, Object, Replica, World, check, doubts, locate, read,
};
use orthoframe_semantics::RelationRules;
use orthoframe_units::{Frame, InEnglish, ReplicaId, Source};

use crate::files::{project, shared};

/// What is doubted of a world by the program's own thresholds.
fn told_of(world: &World, rule_words: &BTreeSet<String>) -> Vec<Fault> {
    let near = RelationRules::standard().tolerances(world.domain.profile);
    doubts(world, &near, rule_words)
}

fn none() -> BTreeSet<String> {
    BTreeSet::new()
}

const ROOM: &str = r#"format = 1
[robot]
radius = 25
height = 120
speed = 60
[type]
object = [
  { name = "Стол", traits = ["support"] },
  { name = "Ваза", traits = ["portable"] },
  { name = "Прибор", traits = ["device"] },
]
area = [{ name = "Комната", traits = ["room"] }]
[orthoframe.floor]
points = [[0, 0], [100, 0], [200, 0], [500, 0], [500, 400], [0, 400]]
height = 270
side.B = { permeability = "conditional" }
[orthoframe.block]
rect = [60, 60]
height = 75
[orthoframe.small]
rect = [10, 10]
height = 20
[object.table]
type = "Стол"
items = [{ id = "A", orthoframe = "block" }]
[object.vase]
type = "Ваза"
items = [{ id = "A", orthoframe = "small" }]
[object.radio]
type = "Прибор"
items = [{ id = "A", orthoframe = "small" }]
[door.entry]
name = "Вход"
kind = "hinged"
width = 100
height = 210
leaves = [{ hinge = "left", share = 1, thickness = 4, max_open = 90 }]
properties = { "КЛЮЧ_У" = "Оператор" }
[area.room]
name = "Комната"
type = "Комната"
items = [{ id = "A", orthoframe = "floor" }]
doors = [{ side = "B", door = "entry", opens = "inside" }]
places = [{ name = "Точка", at = [400, 100] }]
properties = { "СВЕТ" = "Выключено" }
replicas = [
  { name = "Стол-1", object = "table", at = [200, 250] },
  { name = "Стол-2", object = "table", at = [300, 250] },
  { name = "Ваза-1", object = "vase", at = [220, 270, 75], properties = { "КЛЮЧ_ОТ" = "Вход", "ХРАНИТСЯ_НА" = "Стол-2" } },
  { name = "Радио-1", object = "radio", at = [330, 270, 75], properties = { "СОСТОЯНИЕ" = "Включено" } },
]
[map.flat]
items = [{ area = "room" }]
"#;

/// Every doubt about a text as `line code`, with the words; each has a remedy, in English too.
fn told(text: &str) -> Vec<String> {
    let source = Source::new("room.toml", text);
    let reading = read(&source, Format::Toml);
    let world = reading.world.unwrap_or_else(|| panic!("{:#?}", reading.faults));
    let mut found = told_of(&world, &none());
    locate(&source, Format::Toml, &mut found);
    found.iter().map(|fault| line(&source, fault)).collect()
}

fn line(source: &Source, fault: &Fault) -> String {
    assert!(fault.is_warning(), "{fault}");
    assert!(fault.help().is_some());
    let help = fault.help().map(|help| help.to_string());
    assert!(fault.english() != fault.to_string() && fault.english_help() != help, "{fault}");
    let (line, _) = source.position(fault.spans.first().expect("a place in the text").offset());
    format!("{line} {}", fault.code().expect("a code"))
}

#[test]
fn each_sort_of_doubt_is_told_in_its_place() {
    assert_eq!(told(ROOM), Vec::<String>::new());
    let number = |part: &str| {
        let at = ROOM.find(part).unwrap_or_else(|| panic!("{part}"));
        ROOM[..at].lines().count() + usize::from(ROOM[..at].ends_with('\n'))
    };
    let cases = [
        // Tables in one another; a vase within a table.
        ("at = [300, 250]", "at = [230, 260]", "Стол-2", "things_overlap"),
        ("at = [220, 270, 75]", "at = [220, 270, 30]", "Ваза-1", "things_overlap"),
        // Above the table, and amid the room above the floor.
        ("at = [220, 270, 75]", "at = [220, 270, 95]", "Ваза-1", "thing_hovers"),
        ("at = [220, 270, 75]", "at = [120, 200, 40]", "Ваза-1", "thing_hovers"),
        // Wholly and mostly across the doorway.
        ("at = [200, 250] ", "at = [120, 5] ", "Стол-1", "doorway_barred"),
        ("at = [200, 250] ", "at = [90, 0] ", "Стол-1", "doorway_barred"),
        ("at = [400, 100]", "at = [330, 300]", "Точка", "place_under"),
        ("\"КЛЮЧ_ОТ\" = \"Вход\"", "\"КЛЮЧ_ОТ\" = \"Выход\"", "Ваза-1", "names_nothing"),
        ("\"ХРАНИТСЯ_НА\" = \"Стол-2\"", "\"ХРАНИТСЯ_НА\" = \"Стол-7\"", "Ваза-1", "names_nothing"),
        ("\"КЛЮЧ_У\" = \"Оператор\"", "\"КЛЮЧ_У\" = \"Василий\"", "\"КЛЮЧ_У\"", "names_nothing"),
        ("\"СОСТОЯНИЕ\" = \"Включено\"", "\"СОСТОЯНИЕ\" = \"Пашет\"", "Радио-1", "unknown_state"),
        ("\"СОСТОЯНИЕ\" = \"Включено\"", "\"ПИТАНИЕ\" = \"есть\"", "Радио-1", "unknown_state"),
        ("\"СВЕТ\" = \"Выключено\"", "\"СВЕТ\" = \"полумрак\"", "\"СВЕТ\"", "unknown_state"),
        ("[\"portable\"]", "[\"portabel\"]", "\"portable\"", "unknown_trait"),
        ("radius = 25", "radius = 0.25", "radius", "metres"),
        ("speed = 60", "speed = 0.6", "speed", "metres"),
    ];
    for (from, to, place, code) in cases {
        assert!(ROOM.contains(from), "{from}");
        let mut found = told(&ROOM.replacen(from, to, 1));
        // What lay on a table that was moved away hovers now.
        let what_fell = ["[230, 260]", "[120, 5]", "[90, 0]"].iter().any(|at| to.contains(at));
        found.retain(|line| !what_fell || !line.contains("thing_hovers"));
        assert_eq!(found, [format!("{} map::{code}", number(place))], "{from} -> {to}");
    }
}

/// A vessel that is open above holds what came in over its rim; what pierces its walls below that is in its place.
#[test]
fn an_open_vessel_is_pierced_by_no_board() {
    let map = ROOM.replace(
        "[orthoframe.small]\nrect = [10, 10]\nheight = 20",
        "[orthoframe.small]\nrect = [10, 10]\nheight = 20\nroof = \"permeable\"\n[orthoframe.board]\nrect = [60, 60]\nheight = 3",
    );
    let map = map
        .replace("orthoframe = \"block\"", "orthoframe = \"board\"")
        .replace("at = [200, 250]", "at = [200, 250, 72]");
    let stick = |map: &str| {
        map.replace("[object.radio]\ntype = \"Прибор\"\nitems = [{ id = \"A\", orthoframe = \"small\" }]",
            "[object.radio]\ntype = \"Прибор\"\nitems = [{ id = \"A\", orthoframe = \"stick\" }]\n[orthoframe.stick]\nrect = [12, 2]\nheight = 40")
    };
    let overlaps =
        |map: &str| told(map).into_iter().filter(|line| line.contains("things_overlap")).count();
    assert_eq!(overlaps(&map), 0);
    for (height, count) in [(75, 0), (74, 0), (70, 1), (60, 1), (52, 0)] {
        let lowered = map.replace("at = [220, 270, 75]", &format!("at = [220, 270, {height}]"));
        assert_eq!(overlaps(&lowered), count, "the vase stands at {height}");
    }
    // A stick wider than the vessel stands out above its rim.
    let map = stick(&map).replace("at = [330, 270, 75]", "at = [219, 274, 76]");
    assert_eq!(overlaps(&map), 0);
}

#[test]
fn metres_are_told_of_rooms_doors_and_furniture() {
    let text = ROOM.replace("side.B = { permeability = \"conditional\" }\n", "");
    let text = text.replace(
        "points = [[0, 0], [100, 0], [200, 0], [500, 0], [500, 400], [0, 400]]",
        "rect = [5, 4]",
    );
    let at = text.find("doors = [{").expect("a door");
    let end = at + text[at..].find('\n').expect("a line");
    let mut text = text[..at].to_owned() + &text[end + 1..];
    for (from, to) in [
        ("at = [400, 100]", "at = [4, 1]"),
        ("rect = [60, 60]\nheight = 75", "rect = [0.6, 0.6]\nheight = 0.75"),
        ("rect = [10, 10]\nheight = 20", "rect = [0.1, 0.1]\nheight = 0.2"),
        ("height = 270", "height = 2.7"),
        ("width = 100\nheight = 210", "width = 1\nheight = 2.1"),
        ("[200, 250]", "[2, 2.5]"),
        ("[300, 250]", "[3, 2.5]"),
        ("[220, 270, 75]", "[2.2, 2.7, 0.75]"),
        ("[330, 270, 75]", "[3.3, 2.7, 0.75]"),
    ] {
        text = text.replace(from, to);
    }
    let world = World::parse(&Source::new("metres.toml", &text), Format::Toml);
    let world = world.unwrap_or_else(|e| panic!("{e:#?}"));
    let found = told_of(&world, &none());
    let metres: Vec<String> = found
        .iter()
        .filter(|f| matches!(f.error, MapError::Metres { .. }))
        .map(ToString::to_string)
        .collect();
    assert_eq!(metres.len(), 3, "{metres:#?}");
    assert!(metres[0].contains("Комната") && metres[0].contains("5 × 4 × 2.7"), "{metres:#?}");
}

#[test]
fn of_sound_maps_nothing_is_told() {
    let office = shared("cases/office-two-storeys.toml");
    let own = ["rb2", "lab", "room", "box", "two-storeys"];
    let own = own.map(|name| project(&format!("maps/{name}.toml")));
    for path in own.into_iter().chain(office) {
        let world = World::load(&path).unwrap_or_else(|e| panic!("{}: {e:#?}", path.display()));
        let found = told_of(&world, &none());
        assert!(found.is_empty(), "{}: {found:#?}", path.display());
    }
}

/// A replica of an Object, as it comes from no file.
fn replica(world: &World, object: &Object, frame: Frame) -> Replica {
    let model = world.replicas.values().next().expect("a thing");
    Replica {
        id: ReplicaId(9_000),
        object: object.id,
        name: "Проба".to_owned(),
        name_en: String::new(),
        frame,
        properties: Default::default(),
        door_states: Default::default(),
        ..model.clone()
    }
}

/// Whatever stands twice in one place is told, whatever it is made of, unless it lets things through.
#[test]
fn a_thing_in_its_own_twin_is_told() {
    let world = World::load(project("maps/rb2.toml")).expect("a good map");
    let (mut solid, mut told) = (0, 0);
    for thing in world.replicas.values() {
        let mut doubled = world.clone();
        let id = ReplicaId(9_000);
        let twin =
            Replica {
                id, name: "Двойник".to_owned(), name_en: String::new(), ..thing.clone()
            };
        doubled.replicas.insert(id, twin);
        let is_told = told_of(&doubled, &none()).iter().any(|f| {
            matches!(&f.error, MapError::ThingsOverlap { thing: one, other, .. }
                if *one == "Двойник" && *other == thing.name)
        });
        let object = &world.objects[&thing.object];
        // Flat things are in no place twice, and what contains may contain its like.
        let parts = object.items.iter().map(|item| world.orthoframe_of(item));
        let is_solid = parts.clone().any(|o| {
            let faces = o.base.iter().map(|v| v.permeability).chain([o.base_permeability]);
            let (x, y) = o.size();
            o.height.get() > 1.0
                && x.get().min(y.get()) > 2.5
                && faces.chain([o.roof_permeability]).all(|p| p.code() == 0)
        });
        let holds = ["container", "shelves", "person"];
        if is_solid && !holds.iter().any(|t| world.has_trait(thing.id, t)) {
            solid += 1;
            told += usize::from(is_told);
        }
    }
    assert!(solid > 15, "{solid}");
    assert_eq!(told, solid);
}

/// Of every kind of thing: amid a bare room it stands on the floor, and half a metre above it, it hovers.
#[test]
fn a_thing_in_mid_air_is_told_and_one_on_the_floor_is_not() {
    let full = World::load(project("maps/rb2.toml")).expect("a good map");
    let room = full.replicas.values().next().expect("a thing").area;
    let polygons = full.area_polygons(room);
    let middle = polygons[0].iter().fold(nalgebra::Vector2::zeros(), |sum, p| sum + p.coords)
        / polygons[0].len() as f64;
    for object in full.objects.values() {
        for (z, hovers) in [(0.0, false), (50.0, true)] {
            let mut world = full.clone();
            world.replicas.clear();
            world.places.clear();
            world.robot.start = None;
            // Its own middle in the middle of the room, away from the walls.
            let corners = object.items.iter().flat_map(|item| {
                full.orthoframe_of(item).corners().map(|p| item.frame.apply(p)).collect::<Vec<_>>()
            });
            let corners: Vec<_> = corners.collect();
            let own = corners.iter().fold(nalgebra::Vector2::zeros(), |sum, p| sum + p.coords)
                / corners.len() as f64;
            let at = middle - own;
            let frame = Frame::new(at.x, at.y, z, orthoframe_units::Deg::ZERO);
            let thing = Replica { area: room, ..replica(&full, object, frame) };
            world.replicas.insert(thing.id, thing);
            let has = |wanted| world.types.object.has_trait(object.object_type, wanted);
            let top = |item: &orthoframe_map::Item| {
                item.frame.z.get() + world.orthoframe_of(item).height.get()
            };
            let top = object.items.iter().map(top).fold(0.0, f64::max);
            // What reaches up to the ceiling may hang from it, and a lamp on a cord that nobody drew.
            let ceiling = world.orthoframe_of(&world.areas[&room].items[0]).height.get();
            let is_held = has("light") || has("person") || ceiling - top - z <= 16.0;
            let found = told_of(&world, &none());
            let is_told = found.iter().any(|f| matches!(f.error, MapError::ThingHovers { .. }));
            assert_eq!(is_told, hovers && !is_held, "{} at {z}: {found:?}", object.name);
        }
    }
}

#[test]
fn many_of_one_sort_are_summed_up() {
    let row: String = (0..30)
        .map(|i| {
            format!(
                "  {{ name = \"Ряд-{i}\", object = \"vase\", at = [{}, 200, 40] }},\n",
                40 + 15 * i
            )
        })
        .collect();
    let found = told(&ROOM.replace("replicas = [\n", &format!("replicas = [\n{row}")));
    let of = |code: &str| found.iter().filter(|line| line.ends_with(code)).count();
    assert_eq!((of("thing_hovers"), of("more_alike"), found.len()), (5, 1, 6), "{found:?}");
}

/// What the user's own rules read is known.
#[test]
fn a_trait_of_a_rule_is_no_slip() {
    let text = ROOM.replace("[\"portable\"]", "[\"portable\", \"fragile\"]");
    let world = World::parse(&Source::new("room.toml", &text), Format::Toml).expect("a good map");
    assert_eq!(told_of(&world, &none()).len(), 1);
    assert!(told_of(&world, &BTreeSet::from(["fragile".to_owned()])).is_empty());
    assert!(check(&world).is_empty());
}
