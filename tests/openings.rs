//! One opening each: what geometry measures, rules decide, and floor, plan, answers and corridors use.

use std::collections::BTreeSet;

use orthoframe::engine::Engine;
use orthoframe_geometry::{Method, Openings, STEP_REACH};
use orthoframe_language::question::Memory;
use orthoframe_map::{Entity, Format, World};
use orthoframe_semantics::STANDARD;
use orthoframe_semantics::planning::{RobotAt, RobotState, initial};
use orthoframe_units::{AreaId, Deg, Frame, Source};

use crate::worlds::{rb2, variants};

/// ```text
/// 400 +-----------+ +-----------+
///     |   Кухня   = =  Спальня  |   two passages, not linked, through a wall of 20 cm
///   0 +-----------+ +-----------+
///     0         600 620       1220
/// ```
const HOME: &str = r#"
format = 1
[orthoframe]
floor-a = { name = "Пол А", height = 270, points = [[0, 0], [600, 0], [600, 150], [600, 250], [600, 400], [0, 400]], side.C = { permeability = "permeable" } }
floor-b = { name = "Пол Б", height = 270, points = [[0, 0], [600, 0], [600, 400], [0, 400], [0, 250], [0, 150]], side.E = { permeability = "permeable" } }
[area.a]
name = "Кухня"
items = [{ id = "A", orthoframe = "floor-a" }]
[area.b]
name = "Спальня"
items = [{ id = "A", orthoframe = "floor-b" }]
[map.flat]
name = "Квартира"
items = [{ area = "a" }, { area = "b", at = [600, 0] }]
links = [{ from = "a.C", to = "b.E" }]
"#;

fn home() -> World {
    let mut world = World::parse(&Source::new("дом.toml", HOME), Format::Toml)
        .unwrap_or_else(|e| panic!("{:?}", miette::Report::new(e)));
    for map in world.maps.values_mut() {
        // Nobody says that they belong together; the wall comes between them.
        map.links.clear();
        map.items[1].frame = Frame::new(620.0, 0.0, 0.0, Deg::ZERO);
    }
    world
}

/// What is said of the way from the kitchen to the bedroom: by the floor, by the plan's facts, by an answer, by a position.
fn said(engine: &Engine) -> [bool; 4] {
    let world = engine.world().unwrap();
    let area = |name: &str| match world.find(name)[..] {
        [Entity::Area(id)] => id,
        _ => panic!("{name}"),
    };
    let way = engine.route("Кухня", "Спальня", Method::Shortest).unwrap();
    let state = RobotState { area: area("Кухня"), at: RobotAt::Elsewhere, holds: None };
    let facts = initial(world, engine.relations().unwrap(), &state).facts;
    let leads = |argument: &orthoframe_semantics::planning::Argument| argument.name == "Спальня";
    let planned = facts.iter().any(|fact| {
        fact.arguments.len() == 3 && fact.arguments[1].name == "Кухня" && leads(&fact.arguments[2])
    });
    let answer = engine.ask("Есть проход из кухни в спальню?", &mut Memory::default()).unwrap();
    let answered = answer.unwrap().text.starts_with("Да");
    let opening = engine.openings().unwrap().iter().next().unwrap();
    [
        way.route.is_ok(),
        planned,
        answered,
        opening.joined_to(area("Кухня")) == Some(area("Спальня")),
    ]
}

#[test]
fn a_changed_threshold_changes_floor_plan_and_answer_alike() {
    let standard = Engine::in_memory(home(), None).unwrap();
    assert_eq!(said(&standard), [true; 4]);
    let dir = tempfile::tempdir().unwrap();
    let from = r#"limit("common",   "step distance",     6000)."#;
    assert_eq!(STANDARD.matches(from).count(), 1);
    for (limit, joins) in [(2100, true), (2000, true), (1900, false), (0, false)] {
        let to = format!(r#"limit("common",   "step distance",   {limit})."#);
        std::fs::write(dir.path().join("relations.dl"), STANDARD.replace(from, &to)).unwrap();
        let engine = Engine::in_memory(home(), Some(dir.path())).unwrap();
        assert_eq!(said(&engine), [joins; 4], "{limit}");
    }
}

#[test]
fn a_rule_of_the_users_own_shuts_a_way() {
    let dir = tempfile::tempdir().unwrap();
    let from = "СОЕДИНЯЕТ(O, X, Y), СОЕДИНЯЕТ(O, Y, X) :- links(O, X, Y).";
    assert_eq!(STANDARD.matches(from).count(), 1);
    let to = "СОЕДИНЯЕТ(O, X, Y), СОЕДИНЯЕТ(O, Y, X) :- links(O, X, Y), O != \"Дверь-ZY\".";
    std::fs::write(dir.path().join("relations.dl"), STANDARD.replace(from, to)).unwrap();
    let engine = Engine::in_memory(rb2(), Some(dir.path())).unwrap();
    let shut = engine.openings().unwrap().iter().find(|o| o.name == "Дверь-ZY").unwrap();
    assert!(shut.is_through() && !shut.is_way());
    let floor = &engine.floors().unwrap()[&shut.map];
    assert!(floor.doorways().iter().all(|doorway| doorway.id != shut.id));
    let all = Engine::in_memory(rb2(), None).unwrap();
    let same = all.openings().unwrap().opening(shut.id).unwrap();
    assert_eq!((same.door, same.areas), (shut.door, shut.areas));
    assert!(all.floors().unwrap()[&shut.map].doorways().iter().any(|d| d.id == shut.id));
}

/// The floor's doorways, the facts JOINS and the openings say the same, under the same ids.
#[test]
fn floor_facts_and_openings_are_one() {
    for (_, world) in [("home", home())].into_iter().chain(variants()) {
        let engine = Engine::in_memory(world, None).unwrap();
        let (world, relations) = (engine.world().unwrap(), engine.relations().unwrap());
        let openings = engine.openings().unwrap();
        // The standard rules let join what measuring finds joined.
        let measured = Openings::of(world, STEP_REACH);
        assert_eq!(measured.iter().len(), openings.iter().len());
        for (measured, decided) in measured.iter().zip(openings.iter()) {
            assert_eq!(measured.id, decided.id);
            assert!(!measured.is_through() || measured.joins == decided.joins, "{}", decided.name);
        }
        let facts: BTreeSet<_> = relations
            .joins()
            .iter()
            .map(|j| (j.id.unwrap(), [j.from.min(j.to), j.from.max(j.to)]))
            .collect();
        let told: BTreeSet<_> =
            openings.iter().flat_map(|o| o.joins.iter().map(|pair| (o.id, *pair))).collect();
        assert_eq!(facts, told);
        for floor in engine.floors().unwrap().values() {
            let ways = openings.iter().filter(|o| o.map == floor.map() && o.is_way());
            let ways: BTreeSet<_> = ways.map(|o| (o.id, o.name.clone())).collect();
            let doorways = floor.doorways().iter().map(|o| (o.id, o.name.clone()));
            assert_eq!(doorways.collect::<BTreeSet<_>>(), ways);
        }
        let mounted: BTreeSet<_> =
            world.areas.values().flat_map(|a| a.doors.iter().map(|m| m.door)).collect();
        let hung: BTreeSet<_> = openings.iter().filter_map(|o| o.door).collect();
        assert_eq!(mounted, hung);
        let sides: Vec<(AreaId, _)> = openings
            .iter()
            .flat_map(|o| o.sides.iter().map(|s| (s.area, s.side.clone())))
            .collect();
        assert_eq!(sides.iter().collect::<BTreeSet<_>>().len(), sides.len(), "each side once");
    }
}
