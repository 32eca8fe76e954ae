//! Thresholds and meanings stand in the rule text: what is changed there changes the relation and what is answered.

use std::collections::BTreeSet;

use orthoframe::engine::{Engine, Rules};
use orthoframe_facts::{Value, WhyNot};
use orthoframe_language::question::Memory;
use orthoframe_map::{Entity, Format, Profile, World};
use orthoframe_semantics::{
    Around, MEASURED, Made, RelationError, RelationRules, Relations, STANDARD, Spot, THRESHOLDS,
    derive, measured_table,
};
use orthoframe_units::{Deg, Frame, Point, Pose, Source};

use crate::files::project;

/// ```text
/// 400 +--П-----------------------+      П Картина-1, 1,50 m above the floor
///     | К2                       |
///     |          C1     С1       +      К1 20 cm from the south wall, К2 40 cm from two walls,
///     |    к                     = Д    C1 Стол-1, its edge 40 cm from the middle, С1 Стул-1 70 cm from the door
///     |          К1              +      and from the table, к Коробка-1, 10 cm above the floor
///   0 +--------------------------+
///     0                         600
/// ```
pub(crate) const HOME: &str = r#"
format = 1
[type]
object = [
  { name = "Стол", traits = ["support"] }, { name = "Стул", traits = ["seat"] }, { name = "Шкаф", traits = ["container"] },
  { name = "Картина" }, { name = "Коробка", traits = ["portable"] },
]
[orthoframe]
floor-a = { name = "Пол А", height = 270, points = [[0, 0], [600, 0], [600, 150], [600, 250], [600, 400], [0, 400]], side.C = { permeability = "conditional" } }
floor-b = { name = "Пол Б", height = 270, points = [[0, 0], [600, 0], [600, 400], [0, 400], [0, 250], [0, 150]], side.E = { permeability = "conditional" } }
cube = { name = "Куб", rect = [60, 60], height = 90 }
top = { name = "Плита", rect = [80, 60], height = 75 }
seat = { name = "Сиденье", rect = [40, 40], height = 45 }
canvas = { name = "Холст", rect = [50, 3], height = 40 }
small = { name = "Ящичек", rect = [20, 20], height = 15 }
[object]
chest = { name = "Комод", type = "Шкаф", items = [{ id = "A", orthoframe = "cube" }] }
table = { name = "Стол", type = "Стол", items = [{ id = "A", orthoframe = "top" }] }
chair = { name = "Стул", type = "Стул", items = [{ id = "A", orthoframe = "seat" }] }
picture = { name = "Картина", type = "Картина", items = [{ id = "A", orthoframe = "canvas" }] }
box = { name = "Коробка", type = "Коробка", items = [{ id = "A", orthoframe = "small" }] }
[door.ab]
name = "Дверь-1"
kind = "hinged"
width = 100
height = 200
leaves = [{ hinge = "left", share = 1, thickness = 4, max_open = 90 }]
state = "open"
[area.a]
name = "Кухня"
items = [{ id = "A", orthoframe = "floor-a" }]
doors = [{ side = "C", door = "ab", opens = "inside" }]
replicas = [
  { name = "Комод-1", object = "chest", at = [300, 20] },
  { name = "Комод-2", object = "chest", at = [40, 300] },
  { name = "Картина-1", object = "picture", at = [200, 395, 150] },
  { name = "Стул-1", object = "chair", at = [490, 180] },
  { name = "Стол-1", object = "table", at = [340, 170] },
  { name = "Коробка-1", object = "box", at = [150, 200, 10] },
]
[area.b]
name = "Спальня"
items = [{ id = "A", orthoframe = "floor-b" }]
doors = [{ side = "E", door = "ab", opens = "outside" }]
[map.flat]
name = "Квартира"
items = [{ area = "a" }, { area = "b", at = [600, 0] }]
links = [{ from = "a.C", to = "b.E" }]
"#;

fn home() -> World {
    parsed(HOME)
}

/// The standard text with one piece replaced, which must stand in it once.
fn changed(from: &str, to: &str) -> String {
    assert_eq!(STANDARD.matches(from).count(), 1, "{from}");
    STANDARD.replace(from, to)
}

/// A rules directory with a text of its own and another beside it.
pub(crate) fn rules_dir(text: &str, own: &str) -> tempfile::TempDir {
    let dir = tempfile::tempdir().unwrap();
    std::fs::write(dir.path().join("relations.dl"), text).unwrap();
    if !own.is_empty() {
        std::fs::write(dir.path().join("свои.dl"), own).unwrap();
    }
    dir
}

fn engine(text: &str, own: &str) -> Engine {
    let dir = rules_dir(text, own);
    Engine::in_memory(home(), Some(dir.path()))
        .unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)))
}

fn told(relations: &Relations, name: &str) -> Vec<String> {
    let tuples = relations.tuples(name).unwrap();
    let text =
        |tuple: &Vec<Value>| tuple.iter().map(ToString::to_string).collect::<Vec<_>>().join(", ");
    tuples.iter().map(text).collect()
}

fn answer(engine: &Engine, question: &str) -> String {
    match engine.ask(question, &mut Memory::default()).unwrap() {
        Ok(answer) => answer.text,
        Err(doubt) => format!("{doubt:?}"),
    }
}

/// A threshold or a rule, what it is changed to, the relation that changes, a question about it, and one of its tuples
/// that the change takes away or brings.
const CASES: [(&str, &str, &str, &str, &[&str]); 9] = [
    (
        r#"limit("common",   "wall gap",          3000)"#,
        r#"limit("common",   "wall gap",          1000)"#,
        "AT_WALL",
        "Что стоит у стены на кухне?",
        &["Комод-1", "Кухня"],
    ),
    (
        r#"limit("common",   "corner gap",        5000)"#,
        r#"limit("common",   "corner gap",        3900)"#,
        "IN_CORNER",
        "Что стоит в углу кухни?",
        &["Комод-2", "Кухня"],
    ),
    (
        r#"limit("common",   "corner turn",       3000)"#,
        r#"limit("common",   "corner turn",       9000)"#,
        "IN_CORNER",
        "Что стоит в углу кухни?",
        &["Комод-2", "Кухня"],
    ),
    (
        r#"limit("common",   "hanging gap",        800)"#,
        r#"limit("common",   "hanging gap",        100)"#,
        "ON_WALL",
        "Что висит на стене на кухне?",
        &["Картина-1", "Кухня"],
    ),
    (
        r#"limit("common",   "door gap",         10000)"#,
        r#"limit("common",   "door gap",          6900)"#,
        "AT_DOOR",
        "Что стоит рядом с Дверью-1?",
        &["Стул-1", "Дверь-1"],
    ),
    (
        r#"limit("common",   "middle share",       250)"#,
        r#"limit("common",   "middle share",        90)"#,
        "IN_MIDDLE_OF",
        "Что стоит посередине кухни?",
        &["Стол-1", "Кухня"],
    ),
    (
        r#"limit("common",   "floor gap",          800)"#,
        r#"limit("common",   "floor gap",         1000)"#,
        "STANDS_ON_FLOOR",
        "Что лежит на полу на кухне?",
        &["Коробка-1", "Кухня"],
    ),
    // Farther than measuring looks of itself.
    (
        r#"limit("common",   "furniture gap",     6000)"#,
        r#"limit("common",   "furniture gap",    14000)"#,
        "STANDS_AT",
        "Какие стулья стоят у стола?",
        &["Стул-1", "Стол-1"],
    ),
    (
        r#"furnishes(K) :- kind_trait(K, "seat")."#,
        "",
        "IS_FURNITURE",
        "Сколько мебели на кухне?",
        &["Стул-1"],
    ),
];

#[test]
fn a_changed_threshold_changes_the_relation_and_the_answer() {
    let standard = engine(&STANDARD, "");
    for (from, to, relation, question, tuple) in CASES {
        let other = engine(&changed(from, to), "");
        let (before, after) = (standard.relations().unwrap(), other.relations().unwrap());
        assert_ne!(told(before, relation), told(after, relation), "{to}");
        assert_ne!(answer(&standard, question), answer(&other, question), "{to}");
        // What came or went is explained on either side.
        let (with, without) = match before.holds(relation, tuple) {
            true => (before, after),
            false => (after, before),
        };
        assert!(with.holds(relation, tuple) && !without.holds(relation, tuple), "{to}");
        let around = Around::new(standard.world().unwrap());
        assert!(with.why(&around, relation, tuple).unwrap().is_some(), "{to}");
        let why_not = without.why_not(&around, relation, tuple).unwrap();
        assert!(matches!(why_not, WhyNot::Nearest(_)), "{to}: {why_not:?}");
    }
}

#[test]
fn a_reach_grows_with_the_threshold_that_needs_it() {
    for (from, to, relation, tuple) in [
        (
            r#"limit("common",   "wall gap",          3000)"#,
            r#"limit("common",   "wall gap",         20000)"#,
            "AT_WALL",
            ["Стол-1", "Кухня"],
        ),
        (
            r#"limit("common",   "door gap",         10000)"#,
            r#"limit("common",   "door gap",         30000)"#,
            "AT_DOOR",
            ["Комод-1", "Дверь-1"],
        ),
        (
            r#"limit("common",   "close distance",   13000)"#,
            r#"limit("common",   "close distance",   30000)"#,
            "CLOSE_TO",
            ["Комод-1", "Комод-2"],
        ),
    ] {
        let rules = RelationRules::parse(&[Source::new("мои.dl", changed(from, to))]).unwrap();
        let relations = derive(&home(), &rules, Profile::Surveyed).unwrap();
        assert!(relations.holds(relation, &tuple), "{to}");
    }
}

fn at(engine: &Engine, x: f64, y: f64) -> Spot {
    let map = *engine.world().unwrap().maps.keys().next().unwrap();
    let pose = Pose { at: Point::new(x, y), heading: Deg::ZERO };
    engine.locate(map, pose, false).unwrap().terms.spot
}

#[test]
fn a_report_takes_its_thresholds_from_the_rules() {
    let standard = engine(&STANDARD, "");
    type Is = fn(&Spot) -> bool;
    let cases: [(&str, &str, (f64, f64), Is); 5] = [
        ("robot door\",       13000", "robot door\",       3000", (550.0, 120.0), |spot| {
            matches!(spot, Spot::AtDoor { .. })
        }),
        ("robot doorway\",     1500", "robot doorway\",     500", (590.0, 200.0), |spot| {
            matches!(spot, Spot::InDoorway(_))
        }),
        ("robot thing\",       7000", "robot thing\",       100", (440.0, 140.0), |spot| {
            matches!(spot, Spot::NextTo { .. })
        }),
        ("robot wall\",        7000", "robot wall\",       1000", (60.0, 150.0), |spot| {
            *spot == Spot::AlongWall
        }),
        ("robot middle\",       400", "robot middle\",       10", (240.0, 200.0), |spot| {
            *spot == Spot::InMiddle
        }),
    ];
    for (from, to, (x, y), is) in cases {
        let other = engine(&changed(from, to), "");
        assert!(is(&at(&standard, x, y)), "{from}: {:?}", at(&standard, x, y));
        assert!(!is(&at(&other, x, y)), "{to}: {:?}", at(&other, x, y));
    }
}

#[test]
fn a_text_that_lacks_thresholds_and_sections_gets_those_of_the_program() {
    let (before, rest) = STANDARD.split_once("// ═══ У стены, у двери, посередине").unwrap();
    let (_, after) = rest.split_once("// ═══").unwrap();
    // As it stood before it told of walls.
    let older: String = format!(
        "{before}// ═══{after}.decl stands_on_floor(x: Thing, r: Area)\n\
         stands_on_floor(X, R) :- standing_in(X, R, H, _), threshold(\"floor gap\", T), H <= T, H >= -T.\n"
    )
    .replace("СТОИТ_НА_ПОЛУ", "stands_on_floor")
    .lines()
    .filter(|line| {
        let names = ["\"wall gap\"", "\"door gap\"", "\"close distance\""];
        !line.starts_with("limit(") || names.iter().all(|name| !line.contains(name))
    })
    .map(|line| format!("{line}\n"))
    .collect();
    assert!(!older.contains("= AT_WALL") && !older.contains("limit(\"common\",   \"wall gap\""));
    let (older, standard) = (engine(&older, ""), engine(&STANDARD, ""));
    let names = standard.relations().unwrap().counts();
    for name in names {
        let [one, other] = [&older, &standard].map(|e| told(e.relations().unwrap(), &name.name_en));
        assert_eq!(one, other, "{}", name.name_en);
    }
    for (_, _, _, question, _) in CASES {
        assert_eq!(answer(&older, question), answer(&standard, question));
    }
}

#[test]
fn a_threshold_that_cannot_be_is_refused_with_its_place() {
    let dir = rules_dir(
        &STANDARD,
        "limit(\"detected\", \"wall gap\", 900).\nlimit(\"surveyed\", \"close distance\", -100).\n  limit(\"common\", \"wall gap\", 2000).\n",
    );
    let Err(orthoframe::engine::Error::Relations(RelationError::Thresholds { faults, .. })) =
        Rules::read(Some(dir.path()))
    else {
        panic!("two of the three thresholds cannot be meant")
    };
    let told: Vec<String> = faults
        .iter()
        .map(|fault| {
            let (line, column) = fault.position();
            format!("{line}:{column} {fault}")
        })
        .collect();
    assert_eq!(
        told,
        [
            "2:1 порог «close distance» не может быть -100",
            "3:3 порог «wall gap» назван дважды: 3000 и 2000"
        ]
    );
}

#[test]
fn a_rule_of_the_users_own_gets_pairs_in_both_orders() {
    let own = |body: &str| {
        format!(".decl МОЁ(x: Thing) = MINE\n.output МОЁ\nМОЁ(X) :- {body}, D < 12000.\n")
    };
    let standard = engine(&STANDARD, "");
    for (one, other) in [
        ("distance(X, \"Стол-1\", D)", "distance(\"Стол-1\", X, D)"),
        ("beside(X, \"Стол-1\", D, _, _)", "beside(\"Стол-1\", X, D, _, _)"),
    ] {
        // Far enough to find something on both sides of the table's id.
        let text = changed("reach(\"beside\",    6000)", "reach(\"beside\",   13000)");
        let engines = [one, other].map(|body| engine(&text, &own(body)));
        let [a, b] = engines.each_ref().map(|engine| engine.relations().unwrap());
        assert_eq!(told(a, "MINE"), told(b, "MINE"), "{one}");
        assert!(told(a, "MINE").len() > 1, "{one}: {:?}", told(a, "MINE"));
        // The program's own relations stay what they are.
        for name in standard.relations().unwrap().counts() {
            let name = name.name_en;
            assert_eq!(told(a, &name), told(standard.relations().unwrap(), &name), "{name}");
        }
    }
}

#[test]
fn a_rule_uses_what_is_measured_on_demand_without_declaring_it() {
    let own = ".decl ГДЕ(x: Thing, r: Area, across: number, angle: number) = WHERE\n.output ГДЕ\nГДЕ(X, R, A, T) :- at(X, R, A, _, _, T).\n";
    let rules = RelationRules::with(&Source::new("свои.dl", own)).unwrap();
    let mut world = home();
    let mut relations = derive(&world, &rules, Profile::Surveyed).unwrap();
    assert!(told(&relations, "WHERE").contains(&"Комод-1, Кухня, 30000, 0".to_owned()));
    // A move is followed to the same facts as measuring anew gives.
    let Entity::Replica(chair) = world.find("Стул-1")[0] else { panic!("it is a thing") };
    world.replicas.get_mut(&chair).unwrap().frame = Frame::new(10.0, 30.0, 0.0, Deg::of(90.0));
    assert!(relations.update(&world, chair).unwrap());
    let anew = derive(&world, &rules, Profile::Surveyed).unwrap();
    assert!(told(&relations, "WHERE").contains(&"Стул-1, Кухня, 1000, 9000".to_owned()));
    let of_walls = ["at", "edge_distance", "opening_distance", "middle_distance"];
    for name in anew.counts().iter().map(|c| c.name_en.as_str()).chain(of_walls) {
        assert_eq!(told(&relations, name), told(&anew, name), "{name}");
    }
}

#[test]
fn the_table_of_measured_relations_is_that_of_the_rules_and_of_the_guide() {
    let rules = RelationRules::standard();
    let program = rules.program();
    let declared: Vec<String> = program
        .relations()
        .filter(|(_, info)| !info.inputs.is_empty())
        .map(|(_, info)| {
            let columns: Vec<String> =
                info.columns.iter().map(|c| format!("{}: {}", c.name, c.type_name)).collect();
            format!(".decl {0}({1})\n.input {0}\n", info.name, columns.join(", "))
        })
        .collect();
    let always = MEASURED.iter().filter(|measured| measured.made != Made::OnDemand);
    let mut table: Vec<String> = always.map(|measured| measured.declaration()).collect();
    let mut declared = declared;
    declared.sort();
    table.sort();
    assert_eq!(declared, table);

    let guide = project("docs/relations.md");
    let text = std::fs::read_to_string(&guide).unwrap();
    let (before, rest) = text.split_once("<!-- measured -->\n").expect("the table has its place");
    let (_, after) = rest.split_once("<!-- /measured -->").expect("the table has an end");
    let right = format!("{before}<!-- measured -->\n{}<!-- /measured -->{after}", measured_table());
    if std::env::var_os("UPDATE_EXPECT").is_some() {
        std::fs::write(&guide, &right).unwrap();
    } else {
        assert_eq!(text, right, "UPDATE_EXPECT=1 writes the table anew");
    }
}

/// Storeys, touching and room on a table: what is said of them changes with its threshold.
#[test]
fn what_is_said_changes_with_its_threshold() {
    let of = |map: &str, rules: &str| {
        engine_of(&World::load(project(&format!("maps/{map}.toml"))).unwrap(), rules)
    };
    for (map, from, to, question) in [
        (
            "two-storeys",
            "\"storey share\",        50",
            "\"storey share\", 1000",
            "Какие комнаты находятся над Холлом-1?",
        ),
        (
            "two-storeys",
            "\"level equal\",        100",
            "\"level equal\", 100000",
            "Какие комнаты находятся над Холлом-1?",
        ),
        ("rb2", "\"touch gap\",          100", "\"touch gap\", 3000", "Где Стул-1?"),
        ("rb2", "\"top free\",            50", "\"top free\", 1000", "Свободен ли Стол-1?"),
    ] {
        let [before, after] =
            [*STANDARD, &changed(from, to)].map(|rules| answer(&of(map, rules), question));
        assert_ne!(before, after, "{to}");
    }
}

/// What is doubted of a map is doubted by the thresholds of the rules: within them a thing stands, hangs or bars a door.
#[test]
fn a_map_is_doubted_by_the_thresholds_of_the_rules() {
    // The chair 12 cm from the door, two tables in one another by 4 cm.
    let text = HOME
        .replace("at = [490, 180]", "at = [548, 180]")
        .replace("name = \"Стол-1\", object = \"table\", at = [340, 170] },", "name = \"Стол-1\", object = \"table\", at = [340, 170] },\n  { name = \"Стол-2\", object = \"table\", at = [416, 170] },");
    let doubted = |rules: &str| -> BTreeSet<String> {
        let dir = rules_dir(rules, "");
        let file = dir.path().join("дом.toml");
        std::fs::write(&file, &text).unwrap();
        let (_, told) = Engine::check_map(&file, Some(dir.path())).unwrap();
        told.faults.iter().map(ToString::to_string).collect()
    };
    let standard = doubted(&STANDARD);
    for (from, to, thing, is_doubted) in [
        ("\"floor gap\",          800", "\"floor gap\", 1000", "Коробка-1", false),
        ("\"hanging gap\",        800", "\"hanging gap\", 100", "Картина-1", true),
        ("\"overlap depth\",      100", "\"overlap depth\", 500", "Стол-2", false),
        ("\"doorway depth\",     1000", "\"doorway depth\", 1500", "Стул-1", true),
    ] {
        let other = doubted(&changed(from, to));
        let differ: Vec<&String> = standard.symmetric_difference(&other).collect();
        assert!(!differ.is_empty() && differ.iter().all(|told| told.contains(thing)), "{differ:?}");
        assert_eq!(differ.iter().all(|told| other.contains(*told)), is_doubted, "{differ:?}");
    }
}

/// The sources under a folder but the table of thresholds itself, each with its place under `src`.
pub(crate) fn sources(folder: &str) -> Vec<(String, String)> {
    let (src, mut found) = (project("src"), Vec::new());
    let mut folders = vec![project(folder)];
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() && !path.ends_with("tests") {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == "rs")
                && !path.ends_with("semantics/thresholds.rs")
            {
                let place = path.strip_prefix(&src).unwrap().to_string_lossy().replace('\\', "/");
                found.push((place, std::fs::read_to_string(&path).unwrap()));
            }
        }
    }
    found
}

/// A number in the rule text that nothing reads promises a change that does not come; one that rules read and the text
/// does not name never holds.
#[test]
fn every_threshold_is_read_and_told_of() {
    let code: String = sources("src").into_iter().map(|(_, text)| text).collect();
    let guide = std::fs::read_to_string(project("docs/relations.md")).unwrap();
    let fields: BTreeSet<&str> = code
        .split('.')
        .filter_map(|rest| rest.split(|c: char| c != '_' && !c.is_alphanumeric()).next())
        .collect();
    let mut wrong = Vec::new();
    for known in THRESHOLDS {
        let is_read = STANDARD.contains(&format!("threshold(\"{}\"", known.name))
            || fields.contains(known.name.replace(' ', "_").as_str());
        if !is_read {
            wrong.push(format!("{}: neither rules nor code read it", known.name));
        }
        if !guide.contains(&format!("`{}`", known.name)) {
            wrong.push(format!("{}: docs/relations.md does not tell of it", known.name));
        }
    }
    for rest in STANDARD.split("threshold(\"").skip(1) {
        let name = rest.split('"').next().unwrap_or_default();
        if THRESHOLDS.iter().all(|known| known.name != name) {
            wrong.push(format!("{name}: rules read it, and no limit names it"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("\n"));
}

fn parsed(text: &str) -> World {
    World::parse(&Source::new("дом.toml", text), Format::Toml)
        .unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)))
}

fn engine_of(world: &World, rules: &str) -> Engine {
    let dir = rules_dir(rules, "");
    Engine::in_memory(world.clone(), Some(dir.path()))
        .unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)))
}

/// «Встань перед столом»: so far from it as the rules say.
#[test]
fn the_robot_stands_before_a_thing_as_the_rules_say() {
    let home = HOME.replace(
        "[area.a]\nname = \"Кухня\"\n",
        "[robot]\nstart = \"Точка-1\"\n[area.a]\nname = \"Кухня\"\nplaces = [{ name = \"Точка-1\", at = [480, 330] }]\n",
    );
    let world = parsed(&home);
    let [Entity::Replica(table)] = world.find("Стол-1")[..] else { panic!("it is on the map") };
    let away = |rules: &str| {
        let engine = engine_of(&world, rules);
        let answer = engine.perform("Встань перед Столом-1", &mut |_| {}).unwrap();
        assert!(answer.ending.is_done(), "{:?}", answer.ending);
        let bounds = engine.floors().unwrap()[&answer.end_map].scene().replicas[&table].bounds;
        let nearest = Point::new(
            answer.end.at.x.clamp(bounds.min.x, bounds.max.x),
            answer.end.at.y.clamp(bounds.min.y, bounds.max.y),
        );
        (answer.end.at - nearest).norm()
    };
    let other = changed("\"robot aside\",       3000", "\"robot aside\", 9000");
    let (near, far) = (away(&STANDARD), away(&other));
    assert!(far > near + 30.0, "{near} {far}");
}

/// A text that knows nothing of what is asked gets the section about it, and keeps its own thresholds.
#[test]
fn a_text_from_before_what_is_asked_answers_it() {
    let (before, rest) = STANDARD.split_once("// ═══ Когда спрашивают").unwrap();
    let (_, after) = rest.split_once("// ═══ Часть").unwrap();
    let older = format!("{before}// ═══ Часть{after}");
    assert!(!older.contains("BETWEEN"));
    let narrow = older.replace("\"robot door\",       13000", "\"robot door\",        3000");
    let (older, narrow, standard) =
        (engine(&older, ""), engine(&narrow, ""), engine(&STANDARD, ""));
    for (x, y) in [(550.0, 120.0), (590.0, 200.0), (300.0, 200.0), (20.0, 20.0)] {
        assert_eq!(at(&older, x, y), at(&standard, x, y));
    }
    assert_ne!(at(&narrow, 550.0, 120.0), at(&standard, 550.0, 120.0));
}
