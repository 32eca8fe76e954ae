//! Of two who say different things, the one is right whose claim the map has.

use orthoframe::engine::Memory;

use crate::talk::engine;

/// Each thing in each pair of rooms: the first claim, the second or neither is so, whoever makes it.
#[test]
fn who_is_right_is_told_by_the_map() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let places = [("Комнате-В", "Room V"), ("Комнате-Y", "Room Y"), ("Комнате-Z", "Room Z")];
    let things = [("Книга-1", "Book 1"), ("Кровать-1", "Bed 1")];
    let ask = |line: &str| {
        let answer = rb2.ask(line, &mut Memory::default()).expect("there is a map");
        answer.unwrap_or_else(|unanswered| panic!("{line}: {}", unanswered.text)).text
    };
    for (thing, english) in things {
        let own = |place: &str| ask(&format!("{thing} в {place}?")).starts_with("Да");
        for (first, first_english) in places {
            for (second, second_english) in places.into_iter().filter(|(other, _)| *other != first)
            {
                let (russian, in_english) = match (own(first), own(second)) {
                    (true, _) => ("Верно первое", "The first is right"),
                    (_, true) => ("Верно второе", "The second is right"),
                    _ => ("Ни то ни другое не верно", "Neither is right"),
                };
                let line = format!(
                    "Жена говорит, что {thing} в {first}, а я думаю, что в {second}. Кто прав?"
                );
                assert!(ask(&line).starts_with(russian), "{line}: {}", ask(&line));
                let line = format!(
                    "My wife says {english} is in {first_english}, but I think it's in {second_english}. Who's right?"
                );
                assert!(ask(&line).starts_with(in_english), "{line}: {}", ask(&line));
            }
        }
    }
}

/// What was asked of a thing after where it is, is no place.
#[test]
fn a_word_of_its_own_asks_no_place_again() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    for (first, then) in [
        ("Где Кровать-1?", "А почём она?"),
        ("Где Кровать-1?", "А сколько стоит она?"),
        ("Where is Bed 1?", "And how heavy is it?"),
        ("Where is Bed 1?", "When was it last used?"),
    ] {
        let mut memory = Memory::default();
        let place = rb2.ask(first, &mut memory).expect("there is a map").expect(first).text;
        let again = rb2.ask(then, &mut memory).expect("there is a map");
        let again = again.map_or_else(|unanswered| unanswered.text, |answer| answer.text);
        assert_ne!(place, again, "{then}");
        assert!(!again.contains("Комнат") && !again.contains("Room"), "{then}: {again}");
    }
}

/// Why something is not so that is so: that is told first.
#[test]
fn a_false_premise_of_a_why_is_told() {
    let rb2 = engine("maps/rb2.toml").expect("part of the crate");
    let ask = |line: &str| {
        let answer = rb2.ask(line, &mut Memory::default()).expect("there is a map");
        answer.map_or_else(|unanswered| unanswered.text, |answer| answer.text)
    };
    let mut open = 0;
    for door in ["Дверь-ZY", "Дверь-КY"] {
        if ask(&format!("{door} открыта?")).starts_with("Да") {
            let why = ask(&format!("Почему ты не можешь пройти через {door}?"));
            assert!(why.starts_with("По карте это не так"), "{why}");
            open += 1;
        }
    }
    assert!(open > 0);
}
