//! Orders of a dialogue that speak of a place told before, of them, of every room, of what the map cannot judge; and what
//! of an order is not done, told part by part.

use orthoframe::engine::Dialogue;
use orthoframe_language::Language;

use crate::put_back::engine;

/// What the last of some lines comes to in a house: whether a task was done, its goals, and what was told.
fn heard(lines: &[&str]) -> Option<(bool, String, String)> {
    let (_dir, mut engine) = engine("procthor/house_9.json")?;
    let mut dialogue = Dialogue::new(Language::of(lines[0]));
    let mut last = None;
    for line in lines {
        last = Some(dialogue.hear(&mut engine, line, &mut |_, _| {}).expect("there is a map"));
    }
    let heard = last?;
    let done = heard.tasks().next().is_some() && heard.tasks().all(|task| task.ending.is_done());
    let goals = heard.tasks().flat_map(|task| &task.goal).map(|goal| goal.args.join(" "));
    let goals = goals.collect::<Vec<_>>().join("; ");
    Some((done, goals, heard.text()))
}

/// Each talk with what its last line is done to; with none it is not begun, and tells this.
fn check(talks: &[(&[&str], Option<&str>, &str)]) {
    for (lines, goal, said) in talks {
        let Some((done, goals, told)) = heard(lines) else { return };
        assert_eq!(done, goal.is_some(), "{lines:?}: {goals}: {told}");
        assert!(goal.is_none_or(|goal| goals.contains(goal)), "{lines:?}: {goals}: {told}");
        assert!(told.contains(said), "{lines:?}: {told}");
    }
}

#[test]
fn from_there_is_from_the_place_spoken_of() {
    check(&[
        (&["What is on the sofa?", "Bring a pillow from there"], None, "no pillows"),
        (&["Что на диване?", "Принеси оттуда подушку"], None, "нет подушек"),
        (&["What is on the bed?", "Bring a pillow from there"], Some("Подушка-1"), ""),
        (&["Что на кровати?", "Принеси оттуда подушку"], Some("Подушка-1"), ""),
        (&["Подъедь к кровати и принеси оттуда подушку"], Some("Подушка-1"), ""),
        (&["Go to the bedroom and bring the bowl from there"], Some("Миска-1"), ""),
        (&["Поезжай в спальню", "Принеси оттуда миску"], Some("Миска-1"), ""),
    ]);
}

#[test]
fn the_one_at_a_place_amends_what_was_done() {
    check(&[
        (&["Bring Bowl 1", "The one on the dining table."], Some("Миска-2"), ""),
        (&["Bring the bowl", "The one on the dining table."], Some("Миска-2"), ""),
        (&["Put Bowl 1 on the bed", "The one on the dining table"], Some("Миска-2 Кровать-1"), ""),
        (&["Принеси Миску-1", "Ту, что на обеденном столе"], Some("Миска-2"), ""),
    ]);
}

#[test]
fn them_are_all_that_were_told() {
    for lines in [
        &["Where are the chairs?", "Go to them"][..],
        &["Where are the chairs?", "Bring the pillow", "Go to them"],
    ] {
        let Some((_, goals, told)) = heard(lines) else { return };
        assert!(goals.contains("Стул-1") && goals.contains("Стул-2"), "{lines:?}: {goals}: {told}");
    }
}

#[test]
fn who_is_told_to_check_the_rooms_goes_round_them() {
    for line in [
        "Check every room except the kitchen",
        "Inspect all the rooms except the kitchen",
        "Проверь все комнаты, кроме кухни",
        "Осмотри каждую комнату, кроме кухни",
    ] {
        let Some((done, goals, told)) = heard(&[line]) else { return };
        assert!(
            done && goals.contains("Ванная") && !goals.contains("Кухня"),
            "{line}: {goals}: {told}"
        );
    }
}

/// A condition that the map cannot judge is said to be one; what the map lacks may be there all the same, and it is asked
/// what is to be done.
#[test]
fn an_order_under_a_condition_that_nobody_can_judge_is_not_begun() {
    check(&[
        (&["If you have time, bring Bowl 1, otherwise go to the kitchen"], None, "time"),
        (&["Если есть время, принеси Миску-1, иначе поезжай на кухню"], None, "врем"),
        (&["If you have time, go to the kitchen"], Some("Кухня"), ""),
        (&["If the kitchen has a fridge, go to the kitchen"], Some("Кухня"), ""),
        (&["If there is a banana, bring it, otherwise bring Bowl 1"], None, "bring Bowl 1"),
        (&["If there is a banana, bring it, otherwise bring Bowl 1", "Yes"], Some("Миска-1"), ""),
        (&["Если есть банан, принеси его, иначе принеси Миску-1"], None, "принеси Миску-1"),
        (&["Если есть банан, принеси его, иначе принеси Миску-1", "Да"], Some("Миска-1"), ""),
        (
            &["If the fridge is open, close it, and if you have time, go to the kitchen"],
            Some("Кухня"),
            "No, ",
        ),
        (
            &["Если холодильник открыт, закрой его, и если есть время, поезжай на кухню"],
            Some("Кухня"),
            "Нет, ",
        ),
    ]);
}

#[test]
fn what_stays_where_it_is_is_named() {
    check(&[
        (
            &["Put Ball 1 on the bed", "Put Bowl 2 on the bed", "Put all the things back"],
            Some("Миска-2"),
            "Ball 1",
        ),
        (&["Положи Мяч-1 на кровать", "Верни все вещи на место"], Some(""), "Мяч-1"),
        (&["Put Ball 1 on the bed", "Clear the bed"], None, "Ball 1, Pillow 1"),
        (&["Убери всё с дивана"], None, "«Газета-1» лежит там"),
    ]);
}

#[test]
fn orders_follow_in_time_and_find_the_free_floor() {
    check(&[
        (
            &["After you have put Bowl 1 on the bed, go to the kitchen"],
            Some("Миска-1 Кровать-1; Кухня"),
            "",
        ),
        (
            &["После того как ты положишь Миску-1 на кровать, поезжай на кухню"],
            Some("Миска-1 Кровать-1; Кухня"),
            "",
        ),
        (
            &["Положи Миску-1 на кровать, только сначала по дороге заедь на кухню"],
            Some("Кухня; Миска-1 Кровать-1"),
            "",
        ),
        (&["Move Bowl 1 to where the floor is free"], Some("Миска-1 Место-на-полу"), ""),
        (&["Поставь Миску-1 туда, где пол свободен"], Some("Миска-1 Место-на-полу"), ""),
    ]);
}
