//! `ortho do --attended`: what bars the only way is told, and whoever sits there says whether it is clear.

use std::io::Write as _;
use std::process::Stdio;

use serde_json::Value;

use super::Place;

/// Two rooms with a narrow passage between them, and a cupboard before it that is not to be pushed.
const FLAT: &str = include_str!("barred.toml");

/// Somebody took it away, and nobody told the robot.
const AWAY: &str = "[[edit]]\nmove = \"Шкаф-1\"\nto = [20, 20]\n";

fn told(place: &Place, args: &[&str], said: &str, code: i32) -> (Vec<Value>, Value) {
    let args = [&["do", "Поезжай в Кабинет", "--reset", "--json"], args].concat();
    let mut command = place.command(&args);
    let mut child = command.stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    child.stdin.take().unwrap().write_all(said.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    assert_eq!(output.status.code(), Some(code), "{}", String::from_utf8_lossy(&output.stdout));
    let text = String::from_utf8(output.stdout).unwrap();
    let mut lines: Vec<Value> =
        text.lines().map(|line| serde_json::from_str(line).unwrap()).collect();
    let last = lines.pop().unwrap();
    (lines.into_iter().filter(|event| event["event"] == "barred").collect(), last)
}

#[test]
fn who_is_asked_says_that_the_way_is_clear_or_gives_up() {
    let place = Place::empty();
    place.write("flat.toml", FLAT);
    place.write("away.toml", AWAY);
    place.run(&["import", "flat.toml"]).is(0);
    // What the eye sees to be gone nobody is asked about.
    let (asked, end) = told(&place, &["--truth", "away.toml", "--attended"], "", 0);
    assert_eq!((asked.len(), &end["outcome"]), (0, &"done".into()));
    // It is not so, and asked no more than thrice; it is given up; nobody is there.
    for (args, said, questions) in [
        (&["--attended"][..], "yes\nда\nyes\nда\n", 3),
        (&["--attended"][..], "нет\n", 1),
        (&["--attended"][..], "", 1),
        (&[][..], "да\n", 1),
    ] {
        let (asked, end) = told(&place, args, said, 1);
        assert_eq!((asked.len(), &end["outcome"]), (questions, &"stuck".into()), "{args:?} {said}");
        assert!(end["explanation"].as_str().unwrap().contains("Шкаф-1"), "{end}");
        let told_of = &asked[0];
        assert_eq!(told_of["things"], serde_json::json!(["Шкаф-1"]));
        assert_eq!((&told_of["area"], &told_of["x"]), (&"Прихожая".into(), &370.0.into()));
        let words = |field: &str| told_of[field].as_str().unwrap().to_owned();
        assert!(words("explanation").contains("Шкаф-1"), "{told_of}");
        assert!(words("explanation_en").contains("Cupboard 1"), "{told_of}");
    }
    let words = place.run(&["do", "Поезжай в Кабинет", "--reset"]).is(1).out;
    assert!(words.contains("преграждает Шкаф-1") && words.contains("зову оператора"), "{words}");
}
