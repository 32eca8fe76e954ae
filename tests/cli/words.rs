//! What is said: names, poses, questions, dialogues.

use std::process::Stdio;

use serde_json::Value;

use super::{AT_THE_DOOR, Place, rb2};

#[test]
fn a_name_is_declined_and_its_sources_are_told() {
    let place = Place::empty();
    let form = |view: &Value, case: &str, number: &str| {
        let forms = view["forms"].as_array().unwrap();
        let found = forms.iter().find(|f| f["case"] == case && f["number"] == number).unwrap();
        (found["form"].as_str().unwrap().to_owned(), found["source"].as_str().unwrap().to_owned())
    };
    let room = place.json(&["words", "Комната-В"], 0);
    assert_eq!(form(&room, "genitive", "singular"), ("Комнаты-В".into(), "list".into()));
    assert_eq!(form(&room, "instrumental", "plural").0, "Комнатами-В");
    assert_eq!((&room["gender"], &room["certain"]), (&"feminine".into(), &true.into()));
    assert_eq!(room["prepositions"]["where"], "в Комнате-В");
    assert_eq!(room["prepositions"]["about"], "о Комнате-В");
    let gate = place.json(&["words", "ворота"], 0);
    assert_eq!((&gate["number"], gate["forms"].as_array().unwrap().len()), (&"plural".into(), 6));
    let closet = place.json(&["words", "шкаф"], 0);
    assert_eq!(closet["prepositions"]["where"], "в шкафу");
    assert_eq!(closet["prepositions"]["about"], "о шкафе");
    let made_up = place.json(&["words", "шмурдяга"], 0);
    assert_eq!(
        (&made_up["certain"], &made_up["sources"][0]["source"]),
        (&false.into(), &"guess".into())
    );
    assert!(place.run(&["words", "шмурдяга"]).is(0).out.contains("шмурдягой"));
    for bad in ["", " ", "—", "\u{1f916}"] {
        assert_eq!(place.json(&["words", bad], 2)["errors"][0]["code"], "engine::unknown_name");
    }
    place.run(&["words", &"Ё-".repeat(10_000)]).is(0);
    // With a store the forms of its map come first.
    let place = Place::with_rb2();
    let door = place.json(&["words", "Входная дверь"], 0);
    assert_eq!(form(&door, "instrumental", "singular"), ("Входной дверью".into(), "map".into()));
}

#[test]
fn names_with_guessed_forms_are_listed() {
    let place = Place::empty();
    let map = std::fs::read_to_string(rb2()).unwrap();
    let before = place.json(&["check", &rb2()], 0)["uncertain_names"].as_array().unwrap().len();
    let named = map.replacen("name = \"Комната-В\"", "name = \"Шмурдяга\"", 1);
    assert_ne!(named, map);
    let file = place.write("odd.toml", &named);
    let after = place.json(&["check", &file], 0);
    let names = after["uncertain_names"].as_array().unwrap();
    assert_eq!(names.len(), before + 1);
    assert!(names.iter().any(|n| n["name"] == "Шмурдяга" && n["genitive"] == "Шмурдяги"));
    assert!(place.run(&["check", &file]).is(0).out.contains("Шмурдяга (нет Шмурдяги)"));
}

#[test]
fn a_pose_is_told_in_words() {
    let place = Place::with_rb2();
    let says = |args: &[&str]| place.run(args).is(0).out.trim().to_owned();
    assert_eq!(says(&["where", "--map", "Квартира РБ-2", "--at", "225,395"]), AT_THE_DOOR);
    assert_eq!(
        says(&["where", "--at", "225,395", "--lang", "en"]),
        "I am in Room V at the door leading from Room V to Room Z."
    );
    let read = place.json(&["where", "--read", AT_THE_DOOR, "--at", "225,395"], 0);
    assert_eq!((&read["claim"], &read["area"]), (&"at_door".into(), &"Комната-В".into()));
    assert_eq!(read["contains"], true);
    assert!(read["square_m2"].as_f64().unwrap() > 0.5);
    place.run(&["where", "--read", AT_THE_DOOR, "--at", "60,60"]).is(1);
    for (text, code) in [
        ("", "engine::no_report"),
        ("Я нахожусь на Луне.", "engine::no_report"),
        ("Я нахожусь вне карты.", "engine::no_such_place"),
        ("Я в Комнате-Z рядом с Лекарством", "engine::no_such_place"),
    ] {
        let fault = place.json(&["where", "--read", text], 2);
        assert_eq!(fault["errors"][0]["code"], code, "{text}");
    }
    let whereabout = place.json(&["where", "--at", "225,395,90"], 0);
    assert_eq!(whereabout["area"], "Комната-В");
    assert_eq!(whereabout["spot"]["kind"], "at_door");
    assert_eq!(whereabout["spot"]["way"]["door"], "Дверь-ВZ");
    for (at, code) in [
        ("", "engine::bad_pose"),
        ("1", "engine::bad_pose"),
        ("1,2,3,4", "engine::bad_pose"),
        ("NaN,1", "engine::bad_pose"),
        ("1e999,1", "engine::bad_pose"),
        ("-100000,1", "engine::nowhere"),
    ] {
        let fault = place.json(&["where", "--at", at], 2);
        assert_eq!(fault["errors"][0]["code"], code, "{at}");
        assert!(fault["errors"][0]["help"].is_string(), "{at}");
    }
}

#[test]
fn a_question_is_answered_with_its_rule_and_proof() {
    let place = Place::with_rb2();
    let run = place.run(&["ask", "Что на Столе-1?", "--explain"]);
    assert_eq!(run.code, 0, "{}", run.err);
    assert!(run.out.starts_with("На Столе-1 находятся Книга-4 и Чашка-1.\n"), "{}", run.out);
    assert!(
        run.out.contains("ответ(X) :- ") && run.out.contains("НАХОДИТСЯ_СВЕРХУ_НА"),
        "{}",
        run.out
    );
    let run = place.run(&["--json", "ask", "How many chairs are in Room Z?"]);
    let view: Value = serde_json::from_str(&run.out).unwrap();
    assert_eq!((&view["outcome"], &view["number"]), (&Value::from("found"), &Value::from(4.0)));
    assert_eq!(view["bindings"].as_array().unwrap().len(), 4);
    let codes =
        ["Стул-1 белый?", "Далеко ли до чашки?"].map(|question| place.run(&["ask", question]).code);
    assert_eq!(codes, [1, 2]);
}

#[test]
fn a_dialogue_from_a_pipe_keeps_what_was_said() {
    use std::io::Write as _;
    let place = Place::with_rb2();
    let mut child =
        place.command(&["talk"]).stdin(Stdio::piped()).stdout(Stdio::piped()).spawn().unwrap();
    let lines = "Где чашка?\nкрасная\nКакого она цвета?\nОткрой Дверь-ВZ\nвыход\n";
    child.stdin.take().unwrap().write_all(lines.as_bytes()).unwrap();
    let output = child.wait_with_output().unwrap();
    let text = String::from_utf8(output.stdout).unwrap();
    assert!(output.status.success(), "{text}");
    for said in [
        "На Столе-1 в Комнате-В – Чашка-1; на Тумбе-3 в Комнате-Z – Чашка-2.",
        "Чашка-2 находится на Тумбе-3 в Комнате-Z.",
        "Чашка-2 красная.",
    ] {
        assert!(text.contains(said), "{text}");
    }
    assert!(text.lines().count() > 3, "the command was answered too: {text}");
}
