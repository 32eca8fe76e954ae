//! Edits of the map (M11): every step of the paper's list, refusals with their places, undo, and that what is derived
//! from the map follows.

use std::path::Path;

use expect_test::expect_file;
use orthoframe::engine::{Change, Engine, Error, Format, Mode, Timestamp, When};
use orthoframe_map::{Edit, Edits, NameIndex, Naming, NextIds, World, check, edit};
use orthoframe_semantics::{Profile, derive};
use orthoframe_units::{Frame, ReplicaId, Source};

use crate::files::project;

fn change(reason: &str) -> Change {
    Change::new("Мастер", Timestamp(1_790_000_000_000), reason)
}

/// A store with the rb2 map.
fn rb2(dir: &Path) -> Engine {
    let mut engine = Engine::open(dir, None).expect("a new store");
    engine.import(&project("maps/rb2.toml"), &change("съёмка")).expect("rb2 is sound");
    engine
}

fn toml(text: &str) -> Edits {
    Edits::read(&Source::new("edits.toml", text), Format::Toml)
}

fn told(outcome: Result<orthoframe::engine::Edited, Error>) -> String {
    match outcome {
        Ok(edited) => {
            let warnings = edited.warnings.faults.iter().map(|f| format!("warning: {f}\n"));
            edited.differences.iter().map(|d| format!("{d}\n")).chain(warnings).collect()
        }
        Err(Error::Map(faults)) => {
            let one = |f: &orthoframe_map::Fault| match faults.position(f) {
                Some((line, column)) => format!("{line}:{column}: {f}\n"),
                None => format!("-: {f}\n"),
            };
            faults.faults.iter().map(one).collect()
        }
        Err(other) => format!("{other}\n"),
    }
}

/// Each folder of tests/golden/edit is an edit file for the rb2 map («from-nothing»: for no map) and what comes of it.
#[test]
fn edit_files_do_what_they_say_or_are_refused_with_places() {
    let folder = project("tests/golden/edit");
    let mut cases = 0;
    for case in std::fs::read_dir(folder).unwrap() {
        let case = case.unwrap().path();
        let name = case.file_name().unwrap().to_string_lossy().into_owned();
        let file =
            ["edits.toml", "edits.yaml"].map(|f| case.join(f)).into_iter().find(|f| f.exists());
        let file = file.expect("every case has its edits");
        let scratch = tempfile::tempdir().unwrap();
        let mut engine = if name == "from-nothing" {
            Engine::open(scratch.path(), None).unwrap()
        } else {
            rb2(scratch.path())
        };
        let source = Source::new(
            file.file_name().unwrap().to_string_lossy(),
            std::fs::read_to_string(&file).unwrap(),
        );
        let edits = Edits::read(&source, Format::of(&file));
        let before = engine.world().ok().cloned();
        let tried = told(engine.edit(&edits, &change(""), Mode::DryRun));
        assert_eq!(engine.world().ok(), before.as_ref(), "{name}: a dry run changes nothing");
        let outcome = engine.edit(&edits, &change(""), Mode::Commit);
        let done = outcome.is_ok();
        let told = told(outcome);
        assert_eq!(tried, told, "{name}: a dry run says what the run says");
        expect_file![case.join("expected.txt")].assert_eq(&told);
        if done {
            let world = engine.world().unwrap().clone();
            assert!(check(&world).iter().all(|f| f.is_warning()), "{name}");
            assert_eq!(engine.store().unwrap().world().unwrap().as_ref(), Some(&world), "{name}");
            engine.undo(None, &change("назад")).unwrap();
            assert_eq!(engine.world().ok(), before.as_ref(), "{name}: undone");
            engine.redo(&change("вперёд")).unwrap();
            assert_eq!(engine.world().unwrap(), &world, "{name}: redone");
        } else {
            assert_eq!(engine.world().ok(), before.as_ref(), "{name}: refused as a whole");
        }
        cases += 1;
    }
    assert!(cases >= 10);
}

/// What an engine holds after an edit against everything made anew from the same map.
fn check_in_step(engine: &Engine, what: &str) {
    let world = engine.world().unwrap();
    let fresh = derive(world, &engine.rules().relations, Profile::Surveyed).unwrap();
    let kept = engine.relations().unwrap();
    for count in fresh.counts() {
        let sorted = |r: &orthoframe_semantics::Relations| {
            let mut tuples = r.tuples(&count.name).unwrap();
            tuples.sort();
            tuples
        };
        assert_eq!(sorted(kept), sorted(&fresh), "{what}: {}", count.name);
    }
    for (map, floor) in engine.floors().unwrap() {
        let anew =
            orthoframe_geometry::FloorPlan::build(world, *map, &world.robot, &Default::default());
        for fragment in anew.fragments() {
            let area = fragment.area;
            assert_eq!(floor.passframes(area), anew.passframes(area), "{what}: {area:?}");
        }
    }
}

#[test]
fn relations_and_free_floor_follow_every_edit() {
    let scratch = tempfile::tempdir().unwrap();
    let mut engine = rb2(scratch.path());
    check_in_step(&engine, "survey");
    for text in [
        "[[edit]]\nmove = \"Стул-1\"\nby = [5, 3]\n",
        "[[edit]]\nmove = \"Стул-1\"\narea = \"Комната-Z\"\nto = [100, 100]\n",
        "[[edit]]\nplace = \"Коробка-9\"\nobject = \"box\"\narea = \"Комната-Z\"\nat = [100, 200]\n",
        "[[edit]]\nstate = \"Дверь-ВZ\"\nis = \"locked\"\n",
        "[[edit]]\nset = \"Стул-3\"\nproperty = \"ЦВЕТ\"\nvalue = \"Чёрный\"\n",
        "[[edit]]\nrename = \"Стул-3\"\nto = \"Стул хозяина\"\n",
    ] {
        engine.edit(&toml(text), &change("правка"), Mode::Commit).unwrap();
        check_in_step(&engine, text);
    }
    for _ in 0..2 {
        engine.undo(None, &change("назад")).unwrap();
        check_in_step(&engine, "undo");
    }
}

/// What bears what, by the relations.
fn supports(engine: &Engine) -> Vec<String> {
    let mut all = Vec::new();
    for name in ["ON_TOP_OF", "INSIDE"] {
        for tuple in engine.relations().unwrap().tuples(name).unwrap() {
            all.push(format!("{name}{tuple:?}"));
        }
    }
    all.sort();
    all
}

#[test]
fn a_load_goes_with_what_bears_it_or_is_told_to_stay() {
    let scratch = tempfile::tempdir().unwrap();
    let mut engine = rb2(scratch.path());
    let surveyed = supports(&engine);
    let bearer = {
        let relations = engine.relations().unwrap();
        let replicas = &engine.world().unwrap().replicas;
        let loads = |of: ReplicaId| {
            replicas.keys().filter(|id| relations.support_of(**id) == Some(of)).count()
        };
        let bearer =
            replicas.values().filter(|r| r.name.starts_with("Стол")).max_by_key(|r| loads(r.id));
        let bearer = bearer.expect("rb2 has tables");
        assert!(loads(bearer.id) > 0, "{}", bearer.name);
        bearer.name.clone()
    };
    let edit = |engine: &mut Engine, step: &str, mode| {
        let text = format!("[[edit]]\n{step}\n");
        engine.edit(&toml(&text), &change("переставил"), mode).unwrap()
    };

    let left = edit(&mut engine, &format!("move = \"{bearer}\"\nby = [-3, 2]"), Mode::DryRun);
    assert_eq!(left.differences.len(), 1);
    assert!(!left.left_behind.is_empty());

    for step in ["move = \"T\"\nby = [-3, 2]\ncarry = true", "turn = \"T\"\nby = 2\ncarry = true"] {
        let done = edit(&mut engine, &step.replace('T', &bearer), Mode::Commit);
        assert!(done.differences.len() > 1 && done.left_behind.is_empty(), "{done:?}");
        assert_eq!(supports(&engine), surveyed, "{step}");
        check_in_step(&engine, step);
    }

    // What the edit moves itself goes where the edit puts it.
    let load = a_load_of(&engine, &bearer);
    let both = format!(
        "move = \"{load}\"\nby = [1, 0]\n[[edit]]\nmove = \"{bearer}\"\nby = [1, 0]\ncarry = true"
    );
    let x = |engine: &Engine| {
        engine.world().unwrap().replicas.values().find(|r| r.name == load).unwrap().frame.x.get()
    };
    let before = x(&engine);
    edit(&mut engine, &both, Mode::Commit);
    assert!((x(&engine) - before - 1.0).abs() < 1e-9);

    let point = engine.world().unwrap().places.values().next().unwrap().name.clone();
    let text = format!("[[edit]]\nmove = \"{point}\"\nby = [1, 0]\ncarry = true\n");
    let refused = engine.edit(&toml(&text), &change(""), Mode::DryRun);
    assert!(told(refused).contains("на точке ничего не стоит"));
}

/// Something that stands on a thing itself.
fn a_load_of(engine: &Engine, bearer: &str) -> String {
    let (relations, world) = (engine.relations().unwrap(), engine.world().unwrap());
    let on_it = |id: ReplicaId| {
        relations.support_of(id).is_some_and(|support| world.replicas[&support].name == bearer)
    };
    world.replicas.values().find(|r| on_it(r.id)).expect("it bears something").name.clone()
}

#[test]
fn an_edit_is_a_value_of_the_library_too() {
    let scratch = tempfile::tempdir().unwrap();
    let mut engine = rb2(scratch.path());
    let id = engine.world().unwrap().replicas.values().find(|r| r.name == "Стул-1").unwrap().id;
    let done = engine.edit_world(&change("подвинул"), Mode::Commit, |world| {
        let chair = world.replicas.get_mut(&id).unwrap();
        chair.frame = Frame { x: chair.frame.x + orthoframe_units::Cm::of(5.0), ..chair.frame };
    });
    assert_eq!(told(done), "экземпляр «Стул-1»: передвинут на 5 см\n");
    let refused = engine.edit_world(&change("вынес"), Mode::Commit, |world| {
        let chair = world.replicas.get_mut(&id).unwrap();
        chair.frame = Frame::new(9000.0, 0.0, 0.0, chair.frame.angle);
    });
    assert!(told(refused).starts_with("-: «Стул-1» стоит вне своего помещения «Комната-В»"));
    check_in_step(&engine, "library");

    // The steps of a file are values as well, and are refused in the words of one.
    let moved = |by: &str| Edit::Move {
        name: "Стул-1".to_owned(),
        to: None,
        by: Some(by.parse().unwrap()),
        area: None,
        carry: false,
    };
    let turned = |by: f64| {
        let (name, by) = ("Стул-1".to_owned(), by.try_into().ok());
        Edit::Turn { name, to: None, by, carry: false }
    };
    let edits = Edits::from(vec![moved("0,5"), turned(90.0)]);
    let done = told(engine.edit(&edits, &change("повернул"), Mode::Commit));
    assert_eq!(
        done,
        "экземпляр «Стул-1»: передвинут на 5 см, повёрнут на 90° против часовой стрелки\n"
    );
    let refused =
        engine.edit(&vec![turned(90.0), moved("9000,0")].into(), &change(""), Mode::Commit);
    assert!(told(refused).starts_with("6:6: «Стул-1» стоит вне своего помещения «Комната-В»"));
    check_in_step(&engine, "values");
}

#[test]
fn the_history_says_who_and_why_and_the_past_can_be_asked() {
    let scratch = tempfile::tempdir().unwrap();
    let mut engine = rb2(scratch.path());
    let text = "reason = \"к обеду\"\n[[edit]]\nmove = \"Стул-1\"\nby = [5, 0]\n";
    engine.edit(&toml(text), &change(""), Mode::Commit).unwrap();
    let last = engine.revisions().unwrap().pop().unwrap();
    assert_eq!((last.user.as_str(), last.reason.as_str()), ("Мастер", "к обеду"));
    let diff = engine.diff(When::Revision(1), When::Revision(2)).unwrap();
    assert_eq!(diff[0].to_string(), "экземпляр «Стул-1»: передвинут на 5 см");
    let x = |e: &Engine| {
        e.world().unwrap().replicas.values().find(|r| r.name == "Стул-1").unwrap().frame.x.get()
    };
    let now = x(&engine);
    assert!((x(&engine.as_of(When::Revision(1)).unwrap()) - (now - 5.0)).abs() < 1e-9);
}

#[test]
fn what_others_stand_on_cannot_be_undone_from_under_them() {
    let scratch = tempfile::tempdir().unwrap();
    let mut engine = rb2(scratch.path());
    let new = "[orthoframe.slab]\nrect = [20, 20]\nheight = 5\n[object.slab]\nitems = [{ id = \"A\", orthoframe = \"slab\" }]\n";
    engine.edit(&toml(new), &change("новый вид"), Mode::Commit).unwrap();
    let placed =
        "[[edit]]\nplace = \"Плита-9\"\nobject = \"slab\"\narea = \"Комната-Z\"\nat = [100, 200]\n";
    engine.edit(&toml(placed), &change("поставил"), Mode::Commit).unwrap();
    let refused = engine.undo(Some(2), &change("назад")).unwrap_err();
    assert!(
        refused.to_string().starts_with("правку 2 нельзя отменить: карта стала бы неверной"),
        "{refused}"
    );
    engine.undo(Some(3), &change("назад")).unwrap();
    engine.undo(Some(2), &change("и это")).unwrap();
}

/// Ids are never given twice: not that of a thing that was removed, nor one between two others.
#[test]
fn ids_of_what_is_gone_are_not_given_to_what_is_new() {
    let scratch = tempfile::tempdir().unwrap();
    let mut engine = rb2(scratch.path());
    let place = |name: &str| {
        format!(
            "[[edit]]\nplace = \"{name}\"\nobject = \"box\"\narea = \"Комната-Z\"\nat = [100, 200]\n"
        )
    };
    let id = |e: &Engine, name: &str| {
        e.world().unwrap().replicas.values().find(|r| r.name == name).unwrap().id
    };
    engine.edit(&toml(&place("Первая")), &change("1"), Mode::Commit).unwrap();
    let first = id(&engine, "Первая");
    let text = "[[edit]]\nremove = \"Первая\"\n[[edit]]\nremove = \"Стул-2\"\n";
    engine.edit(&toml(text), &change("2"), Mode::Commit).unwrap();
    let chair = id(&engine, "Стул-3");
    engine.edit(&toml(&place("Вторая")), &change("3"), Mode::Commit).unwrap();
    assert!(id(&engine, "Вторая") > first);
    assert_eq!(id(&engine, "Стул-3"), chair);
}

/// Whatever is written as edits, the answer is a world or faults, never a panic; and what is given is checked.
#[test]
fn no_edit_text_makes_the_reader_panic() {
    let world = World::load(project("maps/rb2.toml")).unwrap();
    let words = [
        "move",
        "to",
        "by",
        "area",
        "place",
        "object",
        "at",
        "\"Стул-1\"",
        "\"Комната-В\"",
        "[1, 2]",
        "90",
        "=",
        "\n",
        "[[edit]]",
        "\"A.roof\"",
        "link",
        "of",
        "bind",
        "side",
        "remove",
        "\"room-v\"",
        "[area.x]",
        "items",
        "[]",
        "{}",
        "{ id = \"A\", orthoframe = \"room-v\" }",
        "set",
        "property",
        "value",
        "lift",
        "stops",
        "is",
        "state",
        "\"Дверь-ВZ\"",
        "\"open\"",
        "[map.m]",
        "include",
        "stand",
        "rename",
        "\"\"",
    ];
    let mut dice = crate::store_world::Dice::new(5);
    let names = NameIndex::of(&world);
    for _ in 0..400 {
        let mut text = String::new();
        for _ in 0..dice.roll(5) {
            text.push_str("\n[[edit]]\n");
            for _ in 0..dice.roll(4) + 1 {
                let word =
                    |d: &mut crate::store_world::Dice| words[d.roll(words.len() as u64) as usize];
                text.push_str(&format!("{} = {}\n", word(&mut dice), word(&mut dice)));
            }
        }
        let naming = Naming { exact: &names, in_other_words: &|_| Vec::new() };
        let done = edit(&world, &toml(&text), &NextIds::after(&world), naming);
        if let Some(edited) = done.world {
            assert!(check(&edited).iter().all(|f| f.is_warning()), "{text}");
        } else {
            assert!(done.faults.has_errors(), "{text}");
        }
    }
}

/// `pose` is told in the frame of the Map, however its room is turned and wherever it lies.
#[test]
fn what_is_placed_in_the_frame_of_the_map_stands_there() {
    for turn in [0.0, 90.0, 180.0, 37.0] {
        let dir = tempfile::tempdir().unwrap();
        let mut engine = Engine::open(dir.path(), None).unwrap();
        let room = format!(
            r#"
            [orthoframe.floor]
            rect = [400, 300]
            height = 250
            [orthoframe.box]
            rect = [40, 30]
            height = 20
            [object.box]
            name = "Box"
            items = [{{ id = "A", orthoframe = "box" }}]
            [area.room]
            name = "Room"
            items = [{{ id = "A", orthoframe = "floor" }}]
            [map.ground]
            name = "Ground"
            frame = "of a plan"
            items = [{{ area = "room", at = [100, 50], angle = {turn} }}]
            "#
        );
        let mut edit = |text: &str| engine.edit(&toml(text), &change(""), Mode::Commit).map(|_| ());
        edit(&room).unwrap();
        let frame = Frame::new(100.0, 50.0, 0.0, orthoframe_units::Deg::of(turn));
        let (box_at, spot) = (
            frame.apply(orthoframe_units::Point::new(200.0, 150.0)),
            frame.apply(orthoframe_units::Point::new(60.0, 60.0)),
        );
        edit(&format!(
            "[[edit]]\nplace = 'Box 1'\nobject = 'box'\narea = 'Room'\npose = [{}, {}, 20]\nangle = 10\n\
             [[edit]]\nplace = 'Box 2'\nobject = 'box'\narea = 'Room'\npose = [{}, {}]\n\
             [[edit]]\npoint = 'Spot'\narea = 'Room'\npose = [{}, {}]\nheading = 30\n",
            box_at.x, box_at.y, box_at.x, box_at.y, spot.x, spot.y
        ))
        .unwrap();
        for wrong in ["at = [1, 1]\npose = [1, 1]", "pose = 3"] {
            let text =
                format!("[[edit]]\nplace = 'Box 3'\nobject = 'box'\narea = 'Room'\n{wrong}\n");
            assert!(edit(&text).is_err(), "{wrong}");
        }
        let world = engine.world().unwrap();
        let on_map = |name: &str| {
            let replica = world.replicas.values().find(|r| r.name == name).unwrap();
            frame.compose(&replica.frame)
        };
        let near = |a: f64, b: f64| (a - b).abs() < 0.02;
        let first = on_map("Box 1");
        assert!(near(first.x.get(), box_at.x) && near(first.y.get(), box_at.y), "{first:?}");
        assert!(near(first.z.get(), 20.0) && near(first.angle.get(), 10.0), "{first:?}");
        assert!(near(on_map("Box 2").angle.get().rem_euclid(360.0), 0.0), "{turn}");
        let place = world.places.values().find(|p| p.name == "Spot").unwrap();
        let at = frame.apply(place.at);
        assert!(near(at.x, spot.x) && near(at.y, spot.y), "{at:?}");
        let heading = place.heading.unwrap().get() + turn;
        assert!(near(heading.rem_euclid(360.0), 30.0), "{heading}");
    }
}

/// The robot is told of in an edit as in a map file; what is not told stays. A thing that is renamed by its English name has
/// the new one in both languages.
#[test]
fn the_robot_is_edited_and_names_change_in_the_language_in_which_they_are_called() {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = rb2(dir.path());
    let before = engine.world().unwrap().robot.clone();
    let mut edit = |text: &str| engine.edit(&toml(text), &change(""), Mode::Commit).map(|_| ());
    edit("[robot]\nspeed = 33\nstart = 'Точка-К'\n").unwrap();
    let refused = edit("[robot]\nspeed = 'fast'\n").unwrap_err();
    assert!(matches!(refused, Error::Map(_)), "{refused}");
    assert!(edit("[robot]\nstart = 'nowhere'\n").is_err());
    assert!(edit("robot = 3\n").is_err());
    edit("[[edit]]\nrename = 'Sofa 1'\nto = 'Green sofa'\n").unwrap();
    edit("[[edit]]\nrename = 'Стул-2'\nto = 'Стул у окна'\n").unwrap();
    edit("[[edit]]\nrename = 'Room Z'\nto = 'Комната Z'\nen = 'Zed'\n").unwrap();
    let world = engine.world().unwrap();
    assert!((world.robot.speed - 33.0).abs() < 1e-9);
    assert_eq!((world.robot.radius, world.robot.height), (before.radius, before.height));
    let english = |name: &str| {
        let replicas = world.replicas.values().map(|r| (&r.name, &r.name_en));
        let areas = world.areas.values().map(|a| (&a.name, &a.name_en));
        replicas.chain(areas).find(|(n, _)| *n == name).map(|(_, en)| en.as_str())
    };
    assert_eq!(english("Green sofa"), Some(""));
    assert_eq!(english("Стул у окна"), Some("Chair 2"));
    assert_eq!(english("Комната Z"), Some("Zed"));
}
