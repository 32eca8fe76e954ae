//! What a robot knows beside its map, as facts of the user's own rules: pose, view, beliefs, what is carried.

use orthoframe::Engine;
use orthoframe::engine::{Lens, Value, change_now};
use orthoframe_map::{Entity, World};
use orthoframe_units::{Deg, Frame};

use crate::files::project;

const OWN: &str = r#"
.decl ЗДЕСЬ(map: symbol, r: Area, x_at: number, y_at: number, angle: number) = HERE
.output ЗДЕСЬ
ЗДЕСЬ(M, R, X, Y, A) :- robot_at(M, R, X, Y, A).
.decl НА_ВИДУ(x: Thing) = IN_SIGHT
.output НА_ВИДУ
НА_ВИДУ(X) :- sees(X).
// Не на виду, хотя в той же комнате.
.decl СКРЫТО(x: Thing) = OUT_OF_SIGHT
.output СКРЫТО
СКРЫТО(X) :- robot_at(_, R, _, _, _), CONTAINS(R, X), !sees(X).
.decl ДУМАЕТ(x: Thing, r: Area, sure: number) = BELIEVES
.output ДУМАЕТ
ДУМАЕТ(X, R, S) :- believed(X, R, S).
.decl УНЕСЕНО(x: Thing, who: symbol) = CARRIED
.output УНЕСЕНО
УНЕСЕНО(X, W) :- carried_by(X, W).
.decl СТОИТ(x: Thing, r: Area, x_at: number, y_at: number, z_at: number, angle: number) = STANDS
.output СТОИТ
СТОИТ(T, R, X, Y, Z, A) :- at(T, R, X, Y, Z, A).
"#;

fn rb2() -> World {
    World::load(project("maps/rb2.toml")).expect("the example maps are sound")
}

fn rows(engine: &Engine, question: &str) -> Vec<Vec<Value>> {
    engine.query(question, false).unwrap_or_else(|e| panic!("{question}: {e}")).rows
}

fn names(rows: &[Vec<Value>]) -> Vec<String> {
    rows.iter().map(|row| row[0].to_string()).collect()
}

/// All that the rules derive of what the robot knows, and the same of an engine that begins with what the store holds.
fn check(engine: &Engine, dir: &std::path::Path, rules: &std::path::Path) {
    let anew = Engine::open_read_only(dir, Some(rules)).unwrap();
    // Under rules that do not read it, a question may itself.
    let standard = Engine::open_read_only(dir, None).unwrap();
    let all = [
        ("?- HERE(M, R, X, Y, A)", "?- robot_at(M, R, X, Y, A)"),
        ("?- IN_SIGHT(X)", "?- sees(X)"),
        (
            "?- OUT_OF_SIGHT(X)",
            ".decl HIDDEN(x: Thing)\nHIDDEN(X) :- robot_at(_, R, _, _, _), CONTAINS(R, X), !sees(X).\n?- HIDDEN(X)",
        ),
        ("?- BELIEVES(X, R, S)", "?- believed(X, R, S)"),
        ("?- CARRIED(X, W)", "?- carried_by(X, W)"),
        ("?- STANDS(T, R, X, Y, Z, A)", "?- at(T, R, X, Y, Z, A)"),
        (
            "?- HERE(M, R, X, Y, A), STANDS(T, R, X1, Y1, Z, A1)",
            ".decl HERE(m: symbol, r: Area)\nHERE(M, R) :- robot_at(M, R, X, Y, A).\n?- HERE(M, R), robot_at(M, R, X, Y, A), at(T, R, X1, Y1, Z, A1)",
        ),
    ];
    for (question, alone) in all {
        let told = rows(engine, question);
        assert_eq!(told, rows(&anew, question), "{question}");
        let sorted = |mut rows: Vec<Vec<Value>>| {
            rows.sort();
            rows
        };
        assert_eq!(sorted(told), sorted(rows(&standard, alone)), "{alone}");
    }
    // What stands elsewhere says the same.
    let world = engine.world_now().unwrap();
    let (map, pose) = engine.robot().unwrap();
    let here = rows(engine, "?- HERE(M, R, X, Y, A)");
    let number = |cm: f64| Value::Number((cm * 100.0).round() as i64);
    assert_eq!(here.len(), 1);
    assert_eq!(here[0][0].to_string(), world.name(Entity::Map(map)));
    assert_eq!(here[0][2..4], [number(pose.at.x), number(pose.at.y)]);
    let lens = Lens { pose, height: world.robot.height.get(), field: 120.0, range: 400.0 };
    let in_view = rows(engine, "?- IN_SIGHT(X)");
    let faces = engine.faces_in_view(map, lens).unwrap();
    assert!(in_view.len() <= faces.len() && in_view.is_empty() == faces.is_empty());
    let room = here[0][1].to_string();
    let inside = names(&rows(engine, &format!("?- CONTAINS(\"{room}\", X)")));
    let told: Vec<String> = names(&in_view)
        .into_iter()
        .filter(|x| inside.contains(x))
        .chain(names(&rows(engine, "?- OUT_OF_SIGHT(X)")))
        .collect();
    assert_eq!(told.len(), inside.len(), "in sight or not: {told:?} of {inside:?}");
}

#[test]
fn rules_use_where_the_robot_is_what_it_sees_believes_and_holds() {
    let (dir, rules) = (tempfile::tempdir().unwrap(), tempfile::tempdir().unwrap());
    std::fs::write(rules.path().join("свои.dl"), OWN).unwrap();
    let file = project("maps/rb2.toml");
    let mut engine = Engine::open(dir.path(), Some(rules.path())).unwrap();
    engine.import(&file, &change_now("тест", "")).unwrap();
    check(&engine, dir.path(), rules.path());
    assert!(rows(&engine, "?- BELIEVES(X, R, S)").is_empty());

    // Taken somewhere else.
    let world = rb2();
    for room in world.areas.values().map(|a| a.name.clone()).collect::<Vec<_>>() {
        if engine.place_robot(&room, &change_now("тест", "")).is_ok() {
            check(&engine, dir.path(), rules.path());
            assert_eq!(rows(&engine, "?- HERE(M, R, X, Y, A)")[0][1].to_string(), room);
        }
    }

    // Seen elsewhere, and missed.
    let at = change_now("тест", "").at;
    let thing = world.replicas.values().find(|r| r.name.starts_with("Лекарство")).unwrap();
    let beside = Frame::new(thing.frame.x.get() + 30.0, thing.frame.y.get(), 0.0, Deg::ZERO);
    engine.observe(&thing.name, Some((None, beside)), 0.9, "тест", at).unwrap();
    let believed = rows(&engine, "?- BELIEVES(X, R, S)");
    assert_eq!(believed.len(), 1);
    assert_eq!(believed[0][0].to_string(), thing.name);
    assert_eq!(believed[0][1].to_string(), world.name(Entity::Area(thing.area)));
    assert!(matches!(believed[0][2], Value::Number(500..=1000)), "{believed:?}");
    check(&engine, dir.path(), rules.path());

    // A task, after which something is in a hand, and the robot elsewhere.
    let answer = engine.perform("Принеси лекарство", &mut |_| {}).unwrap();
    assert!(answer.ending.is_done());
    engine.remember(&answer, at).unwrap();
    let carried = rows(&engine, "?- CARRIED(X, W)");
    assert_eq!(names(&carried), [&*thing.name]);
    check(&engine, dir.path(), rules.path());
}

#[test]
fn a_task_under_rules_that_ask_the_robot_is_the_same_task() {
    let rules = tempfile::tempdir().unwrap();
    std::fs::write(rules.path().join("свои.dl"), OWN).unwrap();
    let plain = Engine::in_memory(rb2(), None).unwrap();
    let own = Engine::in_memory(rb2(), Some(rules.path())).unwrap();
    assert_eq!(rows(&own, "?- HERE(M, R, X, Y, A)").len(), 1, "also without a store");
    let task = "Принеси лекарство";
    let [one, other] = [&plain, &own].map(|engine| engine.perform(task, &mut |_| {}).unwrap());
    assert_eq!(one.end, other.end);
    assert_eq!(one.reports.len(), other.reports.len());
}

#[test]
fn a_relation_of_ones_own_that_bears_the_name_is_another() {
    let rules = tempfile::tempdir().unwrap();
    let text = ".decl sees(a: Thing, b: Thing)\n.output sees\nsees(A, B) :- CLOSE_TO(A, B).\n";
    std::fs::write(rules.path().join("свои.dl"), text).unwrap();
    let engine = Engine::in_memory(rb2(), Some(rules.path())).unwrap();
    let near = engine.query("?- CLOSE_TO(A, B)", false).unwrap().rows;
    assert_eq!(engine.query("?- sees(A, B)", false).unwrap().rows, near);
    // Or one of the question's own.
    let standard = Engine::in_memory(rb2(), None).unwrap();
    let own = ".decl sees(a: Thing, b: Thing)\nsees(A, B) :- CLOSE_TO(A, B).\n?- sees(A, B)";
    assert_eq!(standard.query(own, false).unwrap().rows, near);
}
