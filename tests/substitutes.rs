//! A goal that cannot be met as said is answered with the nearest that can, and carried out only when that is agreed to.

use orthoframe::engine::{Change, Dialogue, Engine, Format, Mode, Outcome, Timestamp};
use orthoframe_map::{Edits, Entity, World};
use orthoframe_units::{ReplicaId, Source};

use crate::files::project;

/// The flat with a clean glass beside two cups that are not clean.
fn flat(dir: &std::path::Path) -> Engine {
    let change = Change::new("Мастер", Timestamp(1_790_000_000_000), "");
    let mut engine = Engine::open(dir, None).expect("a new store");
    engine.import(&project("maps/rb2.toml"), &change).expect("rb2 is sound");
    let edits = r#"
[[type.object]]
name = "Стакан"
name_en = "glass"
gender = "m"
traits = ["portable", "container"]

[object.glass]
name = "Стакан"
name_en = "glass"
type = "Стакан"
items = [{ id = "A", orthoframe = "cup-body" }]

[[edit]]
place = "Стакан-2"
name_en = "Glass 2"
object = "glass"
area = "Комната-В"
at = [190, 200, 45]
move_prob = 90
properties = { "СОСТОЯНИЕ" = "Чистый" }

[[edit]]
set = "Чашка-1"
property = "СОСТОЯНИЕ"
value = "Грязный"

[[edit]]
set = "Чашка-2"
property = "СОСТОЯНИЕ"
value = "Грязный"
"#;
    engine
        .edit(&Edits::read(&Source::new("glass.toml", edits), Format::Toml), &change, Mode::Commit)
        .expect("the glass stands on the table");
    engine
}

fn replica(world: &World, name: &str) -> ReplicaId {
    let [Entity::Replica(id)] = world.find(name)[..] else { panic!("{name}") };
    id
}

/// What is said to some lines, one after the other; and whether the thing was moved by then.
fn said(lines: &[&str], thing: &str) -> (Vec<String>, bool) {
    let dir = tempfile::tempdir().unwrap();
    let mut engine = flat(dir.path());
    let id = replica(engine.world().unwrap(), thing);
    let before = engine.world_now().unwrap().replicas[&id].frame;
    let mut dialogue = Dialogue::default();
    let told = lines
        .iter()
        .map(|line| dialogue.hear(&mut engine, line, &mut |_, _| {}).unwrap().text())
        .collect();
    let now = engine.world_now().unwrap();
    let is_moved = now.replicas.get(&id).is_none_or(|replica| replica.frame != before)
        || engine.ask(&format!("Где {thing}?"), &mut Default::default()).is_err();
    (told, is_moved)
}

#[test]
fn a_clean_glass_serves_where_no_cup_is_clean() {
    let (told, moved) = said(&["Принеси чистую чашку"], "Стакан-2");
    assert_eq!(
        told,
        ["На карте нет чистых чашек; подойдёт Стакан-2. Выполнить: «Принеси Стакан-2»?"]
    );
    assert!(!moved, "nothing is done unasked");
    let (told, _) = said(&["Принеси чистую чашку", "да"], "Стакан-2");
    assert!(told[1].contains("Сделано") || told[1].contains("Стакан-2"), "{told:?}");
    let (told, moved) = said(&["Принеси чистую чашку", "нет"], "Стакан-2");
    assert_eq!((told[1].as_str(), moved), ("Хорошо, отменено.", false));
    let (told, _) = said(&["Bring me a clean cup"], "Стакан-2");
    assert!(
        told[0].ends_with("Glass 2 would serve. Shall I do this: \"Bring me Glass 2\"?"),
        "{told:?}"
    );
    let (told, _) = said(&["Bring me a clean cup", "yes"], "Стакан-2");
    assert!(!told[1].is_empty(), "{told:?}");
}

#[test]
fn of_a_colour_the_value_gives_way_and_what_has_no_substitute_says_so() {
    // No book of the flat is clean, and nothing else is read from.
    let dir = tempfile::tempdir().unwrap();
    let mut engine = flat(dir.path());
    for order in ["Принеси чистую вазу", "Bring a clean umbrella"] {
        let heard = Dialogue::default().hear(&mut engine, order, &mut |_, _| {}).unwrap();
        let is_offer = |r: &orthoframe::engine::Reply| matches!(r.outcome, Outcome::Offered { .. });
        assert!(!heard.text().is_empty() && heard.replies.len() == 1, "{}", heard.text());
        let told = heard.text();
        assert_eq!(
            heard.replies.iter().any(is_offer),
            told.contains("подойдёт") || told.contains("would serve"),
            "{told}"
        );
    }
}
