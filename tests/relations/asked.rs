//! What is measured when asked: between two things and before walls, about the robot, at points of the floor.

use orthoframe_facts::WhyNot;
use orthoframe_semantics::Around;
use orthoframe_units::{Deg, Point, Pose};

use super::{derived, room};

const ROW: &str = r#"
{ name = "Первый", object = "cube", at = [100, 300] },
{ name = "Средний", object = "cube", at = [200, 300] },
{ name = "Последний", object = "cube", at = [300, 300] },
{ name = "В стороне", object = "cube", at = [200, 500] },
"#;

/// A relation that is derived when asked is answered, proven and denied like any other, and refused where the question
/// leaves open between what.
#[test]
fn what_is_asked_is_answered_with_its_reason() {
    let world = room(0.0, ROW);
    let (relations, around) = (derived(&world), Around::new(&world));
    let ask = |question: &str| {
        let rows = relations.ask(&around, question);
        rows.map(|rows| rows.iter().map(|row| row[0].to_string()).collect::<Vec<_>>())
    };
    let between = ask(r#"?- BETWEEN(X, "Первый", "Последний")"#);
    assert_eq!(between.unwrap_or_else(|e| panic!("{e:?}")), ["Средний"]);
    assert!(ask("?- BETWEEN(X, A, B)").is_err(), "between all there is");
    let of = |x| [x, "Первый", "Последний"];
    let proof = relations.why(&around, "BETWEEN", &of("Средний")).unwrap().expect("it holds");
    assert!(proof.steps.iter().any(|step| step.fact.name == "amid"), "{proof}");
    assert_eq!(relations.why(&around, "BETWEEN", &of("В стороне")).unwrap(), None);
    let why_not = relations.why_not(&around, "BETWEEN", &of("В стороне")).unwrap();
    assert!(matches!(why_not, WhyNot::Nearest(_)), "{why_not:?}");
}

/// For the robot's own place the same relations hold under its name.
#[test]
fn the_robots_place_is_asked_of_by_its_name() {
    let world = room(0.0, ROW);
    let relations = derived(&world);
    let map = *world.maps.keys().next().expect("one map");
    let pose = Pose { at: Point::new(170.0, 320.0), heading: Deg::ZERO };
    let around = Around::new(&world).with_robot(Some((map, pose)));
    let near = relations.ask(&around, r#"?- SPOT_NEXT_TO("робот", X)"#).unwrap();
    let near: Vec<String> = near.iter().map(|row| row[0].to_string()).collect();
    assert_eq!(near, ["Первый", "Средний"]);
    let ahead = relations.ask(&around, "?- AHEAD_OF_ROBOT(X)").unwrap();
    let ahead: Vec<String> = ahead.iter().map(|row| row[0].to_string()).collect();
    assert_eq!(ahead, ["Последний", "Средний"]);
    let why = relations.why(&around, "SPOT_NEXT_TO", &["робот", "Первый"]).unwrap();
    assert!(why.expect("it holds").steps.iter().any(|step| step.fact.name == "spot_thing"));
    let away = relations.why_not(&around, "SPOT_NEXT_TO", &["робот", "Последний"]).unwrap();
    assert!(matches!(away, WhyNot::Nearest(_)), "{away:?}");
}

/// What the robot faces is the first that counts of all that is ahead of it, and what is not faced is so for a reason.
#[test]
fn what_the_robot_faces_has_its_reason() {
    let world = room(0.0, ROW);
    let relations = derived(&world);
    let map = *world.maps.keys().next().expect("one map");
    let pose = |x, y, heading| Pose { at: Point::new(x, y), heading: Deg::of(heading) };
    let facing = |pose| {
        let around = Around::new(&world).with_robot(Some((map, pose)));
        let names = ["FACES", "FACES_WALL", "FACES_OWN_WALL"];
        let asked = |name: &str| {
            let rows = relations.ask(&around, &format!(r#"?- {name}("робот", X)"#)).unwrap();
            rows.into_iter().map(|row| format!("{name} {}", row[0])).collect::<Vec<_>>()
        };
        names.iter().flat_map(|name| asked(name)).collect::<Vec<_>>().join(", ")
    };
    assert_eq!(facing(pose(217.0, 320.0, 0.0)), "FACES Средний");
    assert_eq!(facing(pose(217.0, 320.0, 180.0)), "FACES Первый");
    assert_eq!(facing(pose(700.0, 320.0, 0.0)), "FACES_WALL Комната");
    assert_eq!(facing(pose(800.0, 320.0, 0.0)), "FACES_WALL Комната, FACES_OWN_WALL Комната");
    assert_eq!(facing(pose(400.0, 100.0, 0.0)), "", "the wall is too far off");

    let around = Around::new(&world).with_robot(Some((map, pose(217.0, 320.0, 0.0))));
    let why = relations.why(&around, "FACES", &["робот", "Средний"]).unwrap();
    assert!(why.expect("it holds").steps.iter().any(|step| step.fact.name == "gaze"));
    for (other, what) in [("Последний", "met_later"), ("В стороне", "Turn <= Off")]
    {
        let Ok(WhyNot::Nearest(rule)) = relations.why_not(&around, "FACES", &["робот", other])
        else {
            panic!("{other} has a reason")
        };
        let told = format!("{rule:?}") + &rule.to_string();
        assert!(told.contains(what), "{other}: {told}");
    }
}
