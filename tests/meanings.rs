//! The class of what stands in the rule text: every threshold changes what is said, and code has no such numbers of its own.

use std::fmt::Write as _;
use std::sync::LazyLock;

use orthoframe::engine::Engine;
use orthoframe_language::Language;
use orthoframe_language::question::Memory;
use orthoframe_language::report::Detail;
use orthoframe_map::{Format, Profile, World, doubts};
use orthoframe_semantics::{RelationRules, STANDARD, THRESHOLDS, Threshold, Unit, derive};
use orthoframe_units::{Deg, Point, Pose, Source};

use crate::files::project;
use crate::thresholds::{HOME, rules_dir};

/// The home of [`crate::thresholds`] with more in it, seen by a robot; a lamp 10 cm under the ceiling, one table in another,
/// a cupboard before the door, things that are small, on and in others, and between others.
fn home() -> World {
    let text = HOME
        .replace("[door.ab]", r#"lamp = { name = "Лампа", items = [{ id = "A", orthoframe = "small" }] }
tray = { name = "Поднос", type = "Коробка", items = [{ id = "A", orthoframe = "plate" }] }
broom = { name = "Метла", items = [{ id = "A", orthoframe = "stick" }] }
rack = { name = "Стеллаж", type = "Шкаф", items = [{ id = "A", orthoframe = "board" }, { id = "B", orthoframe = "board", at = [0, 0, 1] }, { id = "C", orthoframe = "post", at = [0, 0, 2] }] }
armchair = { name = "Кресло", type = "Стол", items = [{ id = "A", orthoframe = "seat" }, { id = "B", orthoframe = "back", at = [0, 35, 45] }] }
plank = { name = "Доска", type = "Коробка", items = [{ id = "A", orthoframe = "board" }] }
crate = { name = "Ящик", type = "Шкаф", items = [{ id = "A", orthoframe = "hollow" }] }
[door.ab]"#)
        .replace("small = {", r#"plate = { name = "Пластина", rect = [30, 20], height = 2 }
stick = { name = "Палка", rect = [5, 5], height = 150 }
post = { name = "Стойка", rect = [20, 30], height = 58 }
board = { name = "Доска", rect = [80, 30], height = 1 }
back = { name = "Спинка", rect = [40, 5], height = 40 }
hollow = { name = "Короб", rect = [40, 40], height = 30, roof = "permeable" }
small = {"#)
        .replace("[area.a]\n", "[robot]\nstart = \"Точка-1\"\n[area.a]\nplaces = [{ name = \"Точка-1\", at = [450, 330] }]\n")
        .replace("  { name = \"Коробка-1\"", r#"  { name = "Лампа-1", object = "lamp", at = [150, 120, 245] },
  { name = "Стол-2", object = "table", at = [250, 174] },
  { name = "Комод-3", object = "chest", at = [530, 250] },
  { name = "Поднос-1", object = "tray", at = [350, 180, 75] },
  { name = "Коробка-2", object = "box", at = [380, 190, 77] },
  { name = "Метла-1", object = "broom", at = [102, 320, 5], move_prob = 50 },
  { name = "Коробка-5", object = "box", at = [412, 180, 75] },
  { name = "Лампа-2", object = "lamp", at = [408, 205, 200] },
  { name = "Коробка-6", object = "box", at = [343, 30, 10] },
  { name = "Комод-4", object = "chest", at = [100, 20] },
  { name = "Комод-5", object = "chest", at = [190, 20] },
  { name = "Коробка-7", object = "box", at = [165, 40] },
  { name = "Коробка-8", object = "box", at = [445, 190], move_prob = 70 },
  { name = "Кресло-1", object = "armchair", at = [540, 60] },
  { name = "Поднос-2", object = "tray", at = [545, 70, 45] },
  { name = "Стеллаж-1", object = "rack", at = [440, 20] },
  { name = "Коробка-3", object = "box", at = [465, 20, 3] },
  { name = "Ящик-1", object = "crate", at = [150, 300] },
  { name = "Коробка-4", object = "box", at = [150, 300, 3] },
  { name = "Метла-2", object = "broom", at = [155, 300, 2] },
  { name = "Коробка-1""#);
    // A board over most of a tray whose edge is beyond that of its table.
    let bedroom = "name = \"Спальня\"\n";
    let board = r#"replicas = [
  { name = "Стол-4", object = "table", at = [300, 200] },
  { name = "Поднос-3", object = "tray", at = [325, 250, 75] },
  { name = "Доска-1", object = "plank", at = [300, 236, 77] },
]
"#;
    parsed(&text.replace(bedroom, &format!("{bedroom}{board}")))
}

/// ```text
///           +--+       A branch that widens, a bend, and an end that is narrower.
///           |  |
/// +---------+  +---------+___
/// |                          |
/// +----------------------+___+
/// ```
const HALL: &str = r#"
format = 1
[type]
area = [{ name = "Коридор", traits = ["corridor"] }]
[orthoframe]
hall = { name = "Пол", height = 270, points = [[0, 0], [1000, 0], [1400, 120], [1345, 310], [970, 195], [550, 195], [560, 600], [400, 600], [400, 200], [0, 190]], side.A = { permeability = "permeable" }, side.G = { permeability = "permeable" } }
[area.hall]
name = "Коридор-1"
type = "Коридор"
items = [{ id = "A", orthoframe = "hall" }]
[map.floor]
name = "Этаж"
items = [{ area = "hall" }]
"#;

fn parsed(text: &str) -> World {
    World::parse(&Source::new("дом.toml", text), Format::Toml)
        .unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)))
}

fn loaded(map: &str) -> World {
    World::load(project(&format!("maps/{map}.toml"))).unwrap()
}

static WORLD: LazyLock<World> = LazyLock::new(home);

fn engine(world: &World, rules: &str) -> Engine {
    let dir = rules_dir(rules, "");
    Engine::in_memory(world.clone(), Some(dir.path()))
        .unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)))
}

/// The standard text with one threshold changed, for every profile.
fn with(known: &Threshold, value: i64) -> String {
    let own = format!("\"{}\",", known.name);
    let is_own = |line: &&str| line.starts_with("limit(") && line.contains(&own);
    let lines = STANDARD.lines().filter(|line| !is_own(line));
    let rest = lines.fold(String::new(), |text, line| text + line + "\n");
    rest + &format!("limit(\"common\", \"{}\", {value}).\n", known.name)
}

/// The least and the most that a threshold may be.
fn extremes(known: &Threshold) -> [i64; 2] {
    match known.unit {
        Unit::Length => [0, 1_000_000],
        // Beyond a right angle lines run together again.
        Unit::Angle => [0, 9_000],
        Unit::Share => [0, 1_000],
        Unit::Times => [1, 1_000],
        Unit::Solid => [0, 12_566_370],
    }
}

/// What all relations hold.
fn relations(rules: &str) -> String {
    relations_of(&WORLD, rules)
}

fn relations_of(world: &World, rules: &str) -> String {
    let rules = RelationRules::parse(&[Source::new("правила.dl", rules)]).unwrap();
    let relations = derive(world, &rules, Profile::Surveyed).unwrap();
    let mut told = String::new();
    for name in relations.counts() {
        let _ = writeln!(told, "{}: {:?}", name.name_en, relations.tuples(&name.name_en).unwrap());
    }
    told
}

/// What they hold in a flat that is drawn by other hands.
fn relations_elsewhere(rules: &str) -> String {
    relations_of(&loaded("rb2"), rules)
}

/// What is said of storeys.
fn storeys(rules: &str) -> String {
    let engine = engine(&loaded("two-storeys"), rules);
    let answer = engine.ask("Какие комнаты находятся над Холлом-1?", &mut Memory::default());
    format!("{:?}", answer.unwrap().map(|answer| answer.text))
}

/// What is doubted of the map.
fn doubted(rules: &str) -> String {
    let rules = RelationRules::parse(&[Source::new("правила.dl", rules)]).unwrap();
    let near = rules.tolerances(Profile::Surveyed);
    let told = doubts(&WORLD, &near, &Default::default());
    told.iter().map(|fault| format!("{fault}\n")).collect()
}

/// What is said of poses all over the floor.
fn places(rules: &str) -> String {
    let engine = engine(&WORLD, rules);
    let map = *WORLD.maps.keys().next().unwrap();
    let mut told = String::new();
    for n in 0..96_u32 {
        let at = Point::new(f64::from(n % 12) * 55.0 + 4.0, f64::from(n / 12) * 50.0 + 20.0);
        let pose = Pose { at, heading: Deg::of(f64::from(n) * 37.0) };
        let said = engine.locate(map, pose, true);
        let said = said.map(|found| found.position.say_in(Language::English, Detail::Heading));
        let _ = writeln!(told, "{n}: {}", said.unwrap_or_else(|e| e.to_string()));
    }
    told
}

const QUESTIONS: [&str; 22] = [
    "Что впереди тебя?",
    "Что слева от тебя?",
    "Что ты видишь?",
    "Что находится между Столом-1 и Стулом-1?",
    "Что находится между Столом-1 и Комодом-1?",
    "Что находится между Комодом-2 и стеной?",
    "Что стоит у той же стены, что и дверь?",
    "Что стоит слева, если смотреть на Стол-1?",
    "Что слева от Стола-1, если смотреть на него?",
    "С какой стороны от Стола-1 стоит Стул-1?",
    "Свободен ли Стол-1?",
    "Свободно ли Кресло-1?",
    "На какой полке Стеллажа-1 Коробка-3?",
    "Что выше: Стол-1 или Стол-2?",
    "Где Стул-1?",
    "Где Поднос-1?",
    "На каком этаже кухня?",
    "Как пройти в спальню?",
    "Как пройти к Комоду-1?",
    "Далеко ли до Комода-1?",
    "Что ближе: Стул-1 или Стол-1?",
    "Что стоит у двери?",
];

/// What is answered.
fn answers(rules: &str) -> String {
    let engine = engine(&WORLD, rules);
    let mut told = String::new();
    for question in QUESTIONS {
        let answer = engine.ask(question, &mut Memory::default()).unwrap();
        let _ = writeln!(told, "{question} {:?}", answer.map(|answer| answer.text));
    }
    told
}

/// The corridors of two buildings.
fn corridors(rules: &str) -> String {
    let of = |world: &World| format!("{:?}", engine(world, rules).corridors(None));
    of(&loaded("lab")) + &of(&loaded("rb2")) + &of(&parsed(HALL))
}

/// Ways in words.
fn ways(rules: &str) -> String {
    let engine = engine(&WORLD, rules);
    let mut told = String::new();
    for (from, to) in [("Комод-2", "Спальня"), ("Стеллаж-1", "Комод-2"), ("Стул-1", "Комод-1")]
    {
        let way = engine.route(from, to, orthoframe::engine::Method::Shortest);
        let way = way.and_then(|way| engine.directions(&way, None));
        let said = way.map(|way| way.map(|way| way.say_in(Language::English, Detail::Heading)));
        let _ = writeln!(told, "{from} – {to}: {:?}", said.map_err(|e| e.to_string()));
    }
    told
}

type Probe = fn(&str) -> String;
/// The cheap ones first; of what begins so, the one that is meant.
const PROBES: [(&str, Probe); 9] = [
    ("", doubted),
    ("", relations),
    ("corridor", corridors),
    ("robot", places),
    ("", answers),
    ("", ways),
    ("storey", storeys),
    ("level equal", storeys),
    ("part", relations_elsewhere),
];

/// Thresholds that only show in what none of the probes does, with what they show in. No new one belongs here that a probe
/// could tell.
const ELSEWHERE: &[(&str, &str)] = &[
    ("belief own", "what a task leaves in the store"),
    ("belief reckoned", "what a robot drives round"),
    ("belief told", "what was observed a while ago"),
    ("between way", "what crosses a way by less than a hand"),
    ("cellar depth", "a house on a slope"),
    ("corridor askew", "a corridor of many doors"),
    ("corridor slender", "a corridor of many doors"),
    ("corridor stub", "a corridor of many doors"),
    ("level sunk", "which shelf a thing is on"),
    ("push farthest", "a way that a thing bars"),
    ("push toward", "a way that a thing bars"),
    ("robot aside", "thresholds::the_robot_stands_before_a_thing_as_the_rules_say"),
    ("robot lost", "a task with a thing that is not there"),
    ("robot place", "an order that names a place"),
    ("robot room", "a task among people"),
    ("robot same", "a log of a laser"),
    ("robot spot", "an order that names a point"),
    ("robot still", "a task among people"),
    ("robot through", "position_reports::nothing_is_faced_through_a_wall"),
    ("step distance", "rooms that no link joins"),
    ("turn about", "a scan that fits several poses: engine/news.rs"),
    ("covering thick", "a cloth between a thing and the table: tests/relations/stacks.rs"),
    ("view ahead", "what is aside of who faces a thing"),
    ("view aside", "what is aside of who faces a thing"),
    ("view behind", "what is aside of who faces a thing"),
    ("wall line", "a wall told by its door"),
    ("wall reach", "a shelf in the thickness of a wall"),
    ("way equal", "two ways that are compared"),
    ("way landmark", "a way past things that are moved"),
    ("way through", "a way through a door at a slant"),
    ("zone patch", "a zone that lies on a corner of a room"),
];

/// A threshold whose change changes nothing is none.
#[test]
fn every_threshold_changes_what_is_said() {
    let before = PROBES.map(|(_, probe)| LazyLock::new(move || probe(*STANDARD)));
    let mut wrong = Vec::new();
    for (name, _) in ELSEWHERE {
        assert!(THRESHOLDS.iter().any(|known| known.name == *name), "{name} is no threshold");
    }
    for known in THRESHOLDS {
        let is_elsewhere = ELSEWHERE.iter().any(|(name, _)| *name == known.name);
        if is_elsewhere {
            continue;
        }
        let probes =
            || PROBES.iter().zip(&before).filter(|((of, _), _)| known.name.starts_with(of));
        let texts = extremes(known).into_iter().filter(|value| *value != known.standard);
        let texts: Vec<String> = texts.map(|value| with(known, value)).collect();
        let tells =
            probes().any(|((_, probe), before)| texts.iter().any(|text| probe(text) != **before));
        if !tells {
            wrong.push(known.name);
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

/// Numbers of a length, an angle or a share that stand in code where meanings are told, each with why it is no meaning that
/// rules may change.
const NO_MEANINGS: &[(&str, &str, &str)] = &[
    ("engine/differences.rs", "TOLD_OFF", "how far the poses of a log err"),
    ("engine/drawing.rs", "THIN", "drawing"),
    ("engine/drawing.rs", "USUAL", "drawing"),
    ("engine/measured.rs", "IN_CM", "a unit"),
    ("engine/queue.rs", "SAME", "rounding"),
    ("engine/round.rs", "UNREACHED", "a length beyond any way"),
    ("engine/seeing.rs", "CONFIDENCE", "statistics"),
    ("engine/seeing.rs", "LASER_HEIGHT", "a property of a device where none is told"),
    ("language/command/blame.rs", "ALIKE", "likeness of letters"),
    ("language/command/spot.rs", "FARTHEST", "the largest coordinate"),
    ("map/check/doors.rs", "SHARE_TOLERANCE", "rounding of what is written"),
    ("map/check/group.rs", "THICKEST_WALL", "the format: which sides a map may link"),
    ("map/check/mod.rs", "ANGLE_TOLERANCE", "rounding of what is written"),
    ("map/check/mod.rs", "OVERLAP", "rounding of what is written"),
    ("map/check/mod.rs", "TOLERANCE", "rounding of what is written"),
    (
        "map/check/placed.rs",
        "DEPTH",
        "rounding of what is written, and the map is read before any rules",
    ),
    ("map/check/zones.rs", "LEAST_AREA", "rounding of what is written"),
    ("robot/mission/aside.rs", "NEAR", "a manoeuvre"),
    ("robot/mission/aside.rs", "OFF", "a manoeuvre"),
    ("robot/mission/names.rs", "BEFORE", "a manoeuvre"),
    ("semantics/asked/between.rs", "SHORTEST", "rounding"),
    ("semantics/asked/between.rs", "TOUCHED", "rounding"),
    ("semantics/body.rs", "FOOT_SLACK", "rounding of how a foot is drawn"),
    ("semantics/grid.rs", "CELL", "effort"),
    ("semantics/grid.rs", "MOST_CELLS", "effort"),
    ("semantics/measure/borders.rs", "APART", "rounding of a grid"),
    ("semantics/measure/borders.rs", "FOOTHOLD", "rounding"),
    ("semantics/measure/borders.rs", "THREAD", "rounding"),
];
/// Where what measurements mean is told to people or planned by.
const OF_MEANING: [&str; 7] =
    ["map/check", "semantics", "engine", "language", "meaning", "robot/mission", "serve"];

/// Whoever writes a number that decides what something means writes it into `rules/relations.dl`; whoever needs another says
/// here why it is none.
#[test]
fn code_has_no_meanings_of_its_own() {
    let mut found: Vec<(String, String)> = Vec::new();
    for folder in OF_MEANING {
        for (path, text) in crate::thresholds::sources(&format!("src/{folder}")) {
            let names = text.lines().filter_map(|line| {
                let (_, rest) = line.split_once("const ")?;
                let (name, kind) = rest.split_once(": ")?;
                kind.starts_with("f64").then(|| name.to_owned())
            });
            found.extend(names.map(|name| (path.clone(), name)));
        }
    }
    found.sort();
    let known: Vec<(String, String)> =
        NO_MEANINGS.iter().map(|(path, name, _)| ((*path).into(), (*name).into())).collect();
    assert_eq!(found, known, "left: constants of the sources; right: those that have a reason");
}
