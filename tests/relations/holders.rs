//! Things in drawers, boxes and shelves, that are Objects of several Orthoframes.

use expect_test::{Expect, expect};

use super::{derived, list};

/// A chest of three drawers, a shelf of boards, a box open at one side, a stand for umbrellas.
const MORE: &str = r#"
[orthoframe.chest-side]
name = "Боковина"
rect = [2, 45]
height = 90
[orthoframe.chest-back]
name = "Задник"
rect = [76, 2]
height = 90
[orthoframe.chest-top]
name = "Крышка комода"
rect = [80, 45]
height = 2
[orthoframe.drawer]
name = "Выдвижной ящик"
rect = [76, 41]
height = 24
roof = "permeable"
[orthoframe.board]
name = "Доска"
rect = [96, 30]
height = 2
[orthoframe.upright]
name = "Стойка"
rect = [2, 30]
height = 100
[orthoframe.lidded]
name = "Короб"
rect = [50, 40]
height = 30
side = { A = { permeability = "permeable" } }
[orthoframe.stand]
name = "Подставка"
rect = [20, 20]
height = 45
roof = "permeable"
[orthoframe.cushion]
name = "Сиденье дивана"
rect = [48, 38]
height = 2
[orthoframe.sock]
name = "Носок"
rect = [20, 8]
height = 3
[object.chest]
name = "Комод"
type = "Вещь"
items = [
  { id = "L", orthoframe = "chest-side" }, { id = "R", orthoframe = "chest-side", at = [78, 0] },
  { id = "B", orthoframe = "chest-back", at = [2, 43] }, { id = "T", orthoframe = "chest-top", at = [0, 0, 90] },
  { id = "X", orthoframe = "drawer", at = [2, 2, 2] }, { id = "Y", orthoframe = "drawer", at = [2, 2, 30] },
  { id = "Z", orthoframe = "drawer", at = [2, 2, 58] },
]
front = "X.A"
[object.pulled]
name = "Комод с выдвинутым ящиком"
type = "Вещь"
items = [
  { id = "L", orthoframe = "chest-side" }, { id = "R", orthoframe = "chest-side", at = [78, 0] },
  { id = "B", orthoframe = "chest-back", at = [2, 43] }, { id = "T", orthoframe = "chest-top", at = [0, 0, 90] },
  { id = "X", orthoframe = "drawer", at = [2, 2, 2] }, { id = "Y", orthoframe = "drawer", at = [2, 2, 30] },
  { id = "Z", orthoframe = "drawer", at = [2, -35, 58] },
]
[object.boards]
name = "Полки"
type = "Вещь"
items = [
  { id = "L", orthoframe = "upright" }, { id = "R", orthoframe = "upright", at = [98, 0] },
  { id = "A", orthoframe = "board", at = [2, 0, 10] }, { id = "B", orthoframe = "board", at = [2, 0, 50] },
  { id = "C", orthoframe = "board", at = [2, 0, 98] },
]
[object.holding-boards]
name = "Шкафчик без дверей"
type = "Ёмкость"
items = [
  { id = "L", orthoframe = "upright" }, { id = "R", orthoframe = "upright", at = [98, 0] },
  { id = "A", orthoframe = "board", at = [2, 0, 10] }, { id = "B", orthoframe = "board", at = [2, 0, 50] },
  { id = "C", orthoframe = "board", at = [2, 0, 98] },
]
[object.lidded]
name = "Короб"
type = "Вещь"
items = [{ id = "A", orthoframe = "lidded" }]
[object.sofa]
name = "Диван"
type = "Мебель для сидения"
items = [{ id = "A", orthoframe = "lidded" }, { id = "B", orthoframe = "cushion", at = [1, 1, 10] }]
[object.stand]
name = "Подставка"
type = "Вещь"
items = [{ id = "A", orthoframe = "stand" }]
[object.sock]
name = "Носок"
type = "Ноша"
items = [{ id = "A", orthoframe = "sock" }]
"#;

const STACK: &str = "RESTS_ON LIES_ON_OR_IN ON_TOP_OF ABOVE UNDER INSIDE NEXT_TO";

/// However the room stands in its Map.
fn check(replicas: &str, names: &str, expected: &Expect) {
    let found = [0.0, 90.0, 33.7, 211.0].map(|angle| {
        let text = super::room_text(replicas).replacen(
            "[orthoframe.floor]",
            &format!("{MORE}[orthoframe.floor]"),
            1,
        );
        list(&derived(&super::turned(&text, angle)), names)
    });
    assert!(found.iter().all(|f| *f == found[0]), "{found:#?}");
    expected.assert_eq(&found[0]);
}

#[test]
fn what_lies_in_a_drawer_is_in_the_chest_and_under_nothing_of_it() {
    check(
        r#"
{ name = "комод", object = "chest", at = [200, 200] },
{ name = "носок-внизу", object = "sock", at = [210, 210, 3] },
{ name = "носок-посередине", object = "sock", at = [210, 210, 31], angle = 20 },
{ name = "носок-на-носке", object = "sock", at = [211, 211, 34], angle = 20 },
{ name = "носок-наверху", object = "sock", at = [210, 210, 59] },
{ name = "ваза", object = "cup", at = [240, 220, 92] },
{ name = "кот", object = "cat", at = [220, 150] },
"#,
        STACK,
        &expect![[r#"
            RESTS_ON: ваза, комод
            RESTS_ON: носок-внизу, комод
            RESTS_ON: носок-на-носке, носок-посередине
            RESTS_ON: носок-наверху, комод
            RESTS_ON: носок-посередине, комод
            LIES_ON_OR_IN: ваза, комод
            LIES_ON_OR_IN: носок-внизу, комод
            LIES_ON_OR_IN: носок-на-носке, носок-посередине
            LIES_ON_OR_IN: носок-наверху, комод
            LIES_ON_OR_IN: носок-посередине, комод
            ON_TOP_OF: ваза, комод
            ON_TOP_OF: носок-на-носке, носок-посередине
            INSIDE: носок-внизу, комод
            INSIDE: носок-на-носке, комод
            INSIDE: носок-наверху, комод
            INSIDE: носок-посередине, комод
        "#]],
    );
}

#[test]
fn a_pulled_out_drawer_holds_and_hangs_over() {
    check(
        r#"
{ name = "комод", object = "pulled", at = [200, 200] },
{ name = "носок", object = "sock", at = [220, 168, 59] },
{ name = "кот", object = "cat", at = [220, 175] },
{ name = "люстра", object = "lamp", at = [240, 185, 150] },
"#,
        STACK,
        &expect![[r#"
            RESTS_ON: носок, комод
            LIES_ON_OR_IN: носок, комод
            ABOVE: люстра, комод
            UNDER: кот, комод
            INSIDE: носок, комод
        "#]],
    );
}

#[test]
fn boards_bear_and_only_a_container_holds_between_them() {
    check(
        r#"
{ name = "полки", object = "boards", at = [100, 100] },
{ name = "книга", object = "book", at = [110, 105, 52] },
{ name = "книга-вторая", object = "book", at = [116, 105, 52] },
{ name = "книга-нижняя", object = "book", at = [110, 105, 12] },
{ name = "чашка", object = "cup", at = [150, 115, 100] },
{ name = "шкафчик", object = "holding-boards", at = [400, 100] },
{ name = "том", object = "book", at = [410, 105, 52] },
{ name = "блюдце", object = "saucer", at = [450, 115, 100] },
"#,
        STACK,
        &expect![[r#"
            RESTS_ON: блюдце, шкафчик
            RESTS_ON: книга, полки
            RESTS_ON: книга-вторая, полки
            RESTS_ON: книга-нижняя, полки
            RESTS_ON: том, шкафчик
            RESTS_ON: чашка, полки
            LIES_ON_OR_IN: блюдце, шкафчик
            LIES_ON_OR_IN: книга, полки
            LIES_ON_OR_IN: книга-вторая, полки
            LIES_ON_OR_IN: книга-нижняя, полки
            LIES_ON_OR_IN: том, шкафчик
            LIES_ON_OR_IN: чашка, полки
            ON_TOP_OF: блюдце, шкафчик
            ON_TOP_OF: книга, полки
            ON_TOP_OF: книга-вторая, полки
            ON_TOP_OF: книга-нижняя, полки
            ON_TOP_OF: чашка, полки
            INSIDE: том, шкафчик
            NEXT_TO: книга, книга-вторая
            NEXT_TO: книга-вторая, книга
        "#]],
    );
}

#[test]
fn boxes_that_are_open_lidded_and_stacked() {
    check(
        r#"
{ name = "стол", object = "table", at = [200, 200] },
{ name = "ящик", object = "box", at = [210, 210, 75] },
{ name = "поднос в ящике", object = "saucer", at = [230, 230, 75] },
{ name = "чашка в ящике", object = "cup", at = [230, 230, 77] },
{ name = "короб", object = "lidded", at = [260, 215, 75] },
{ name = "носок", object = "sock", at = [265, 220, 76] },
{ name = "куб на коробе", object = "cube", at = [262, 216, 105] },
{ name = "подставка", object = "stand", at = [500, 300] },
{ name = "зонт", object = "stick", at = [508, 308, 1] },
"#,
        STACK,
        &expect![[r#"
            RESTS_ON: зонт, подставка
            RESTS_ON: короб, стол
            RESTS_ON: куб на коробе, короб
            RESTS_ON: носок, короб
            RESTS_ON: поднос в ящике, ящик
            RESTS_ON: чашка в ящике, поднос в ящике
            RESTS_ON: ящик, стол
            LIES_ON_OR_IN: зонт, подставка
            LIES_ON_OR_IN: короб, стол
            LIES_ON_OR_IN: куб на коробе, короб
            LIES_ON_OR_IN: носок, короб
            LIES_ON_OR_IN: поднос в ящике, ящик
            LIES_ON_OR_IN: чашка в ящике, поднос в ящике
            LIES_ON_OR_IN: ящик, стол
            ON_TOP_OF: короб, стол
            ON_TOP_OF: куб на коробе, короб
            ON_TOP_OF: чашка в ящике, поднос в ящике
            ON_TOP_OF: ящик, стол
            INSIDE: зонт, подставка
            INSIDE: носок, короб
            INSIDE: поднос в ящике, ящик
            INSIDE: чашка в ящике, ящик
            NEXT_TO: короб, ящик
            NEXT_TO: ящик, короб
        "#]],
    );
}

#[test]
fn what_lies_on_a_seat_is_not_in_it() {
    check(
        r#"
{ name = "диван", object = "sofa", at = [200, 200] },
{ name = "носок", object = "sock", at = [210, 210, 12] },
"#,
        STACK,
        &expect![[r#"
            RESTS_ON: носок, диван
            LIES_ON_OR_IN: носок, диван
            ON_TOP_OF: носок, диван
        "#]],
    );
}

#[test]
fn what_is_in_a_box_rests_on_nothing_outside_of_it() {
    // The box is sunk into the table by a centimetre: its bottom is lower than the table's top.
    check(
        r#"
{ name = "стол", object = "table", at = [200, 200] },
{ name = "ящик", object = "box", at = [210, 210, 74] },
{ name = "носок", object = "sock", at = [220, 220, 74.2] },
"#,
        STACK,
        &expect![[r#"
            RESTS_ON: носок, ящик
            RESTS_ON: ящик, стол
            LIES_ON_OR_IN: носок, ящик
            LIES_ON_OR_IN: ящик, стол
            ON_TOP_OF: ящик, стол
            INSIDE: носок, ящик
        "#]],
    );
}
