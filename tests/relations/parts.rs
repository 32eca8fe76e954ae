//! Parts, properties, and what a user writes in a rule file of his own.

use expect_test::expect;
use orthoframe_semantics::{Profile, RelationRules, derive};
use orthoframe_units::Source;

use super::{derived, list, room};

#[test]
fn parts_of_a_stool_and_their_properties() {
    let relations = derived(&room(
        0.0,
        r#"
{ name = "табурет", object = "stool", at = [200, 200], properties = { "ЦВЕТ" = "Синий" } },
"#,
    ));
    let about = |name: &str| -> String {
        relations
            .of(name)
            .iter()
            .map(|(relation, t)| {
                let words: Vec<String> = t.iter().map(ToString::to_string).collect();
                format!("{relation}: {}\n", words.join(", "))
            })
            .collect()
    };
    expect![[r#"
        НАХОДИТСЯ_ВНУТРИ: табурет, Комната
        СОДЕРЖИТ: Комната, табурет
        СТОИТ_НА_ПОЛУ: табурет, Комната
        ЯВЛЯЕТСЯ_ЧАСТЬЮ: Опора, Стул
        ЯВЛЯЕТСЯ_ЧАСТЬЮ: Сиденье, Стул
        ЯВЛЯЕТСЯ_ЧАСТЬЮ: Спинка, Стул
        СОСТОИТ_ИЗ: Стул, Опора
        СОСТОИТ_ИЗ: Стул, Сиденье
        СОСТОИТ_ИЗ: Стул, Спинка
        ЯВЛЯЕТСЯ_НИЖНЕЙ_ЧАСТЬЮ: Опора, Стул
        ЯВЛЯЕТСЯ_ВЕРХНЕЙ_ЧАСТЬЮ: Спинка, Стул
        ЯВЛЯЕТСЯ_ЗАДНЕЙ_ЧАСТЬЮ: Спинка, Стул
        ЯВЛЯЕТСЯ_ЭКЗЕМПЛЯРОМ: табурет, Стул
        ИМЕЕТ: табурет, МАТЕРИАЛ, Дерево
        ИМЕЕТ: табурет, ЦВЕТ, Синий
    "#]]
    .assert_eq(&about("табурет"));
    expect![[r#"
        ЯВЛЯЕТСЯ_ЧАСТЬЮ: Опора, Стул
        СОСТОИТ_ИЗ: Стул, Опора
        ЯВЛЯЕТСЯ_НИЖНЕЙ_ЧАСТЬЮ: Опора, Стул
        ИМЕЕТ: Опора, ЦВЕТ, Чёрный
    "#]]
    .assert_eq(&about("Опора"));
    expect![[r#"
        НАХОДИТСЯ_ВНУТРИ: табурет, Комната
        СОДЕРЖИТ: Комната, табурет
        СТОИТ_НА_ПОЛУ: табурет, Комната
        ЯВЛЯЕТСЯ_ЧАСТЬЮ: Пол, Комната
        СОСТОИТ_ИЗ: Комната, Пол
    "#]]
    .assert_eq(&about("комната"));
}

#[test]
fn a_user_adds_a_relation_by_a_text() {
    let own = Source::new(
        "свои.dl",
        r#"
.decl ПРЕПЯТСТВУЕТ(x: Thing, y: Thing) = OBSTRUCTS
.output ПРЕПЯТСТВУЕТ
ПРЕПЯТСТВУЕТ(X, Y) :- НАХОДИТСЯ_ПЕРЕД(X, Y), НАХОДИТСЯ_РЯДОМ_С(X, Y).
limit("surveyed", "close distance", 1000).
"#,
    );
    let rules = RelationRules::with(&own).expect("the text is sound");
    let world = room(
        0.0,
        r#"
{ name = "шкаф", object = "wardrobe", at = [100, 100] },
{ name = "куб", object = "cube", at = [120, 50] },
{ name = "куб-2", object = "cube", at = [120, 0] },
"#,
    );
    let relations = derive(&world, &rules, Profile::Surveyed).expect("rules end");
    expect![[r#"
        OBSTRUCTS: куб, шкаф
        CLOSE_TO: куб, куб-2
        CLOSE_TO: куб, шкаф
        CLOSE_TO: куб-2, куб
        CLOSE_TO: шкаф, куб
    "#]]
    .assert_eq(&list(&relations, "OBSTRUCTS CLOSE_TO"));
}

#[test]
fn a_rule_text_that_changes_a_measurement_is_refused() {
    let text = orthoframe_semantics::STANDARD
        .replace(
            ".decl distance(a: Thing, b: Thing, d: number)",
            ".decl distance(a: Thing, b: Thing)",
        )
        .replace(
            "distance(A, B, D), threshold(\"close distance\", Most), D <= Most",
            "distance(A, B)",
        )
        .replace(
            "distance(A, B, D), threshold(\"furniture gap\", Most), D <= Most",
            "distance(A, B)",
        );
    let rules =
        RelationRules::parse(&[Source::new("мои.dl", text)]).expect("it is sound by itself");
    let world = room(
        0.0,
        r#"
{ name = "куб", object = "cube", at = [120, 50] },
{ name = "куб-2", object = "cube", at = [120, 0] },
"#,
    );
    let error = derive(&world, &rules, Profile::Surveyed).expect_err("the columns differ");
    expect!["у «distance» столбцов 2, а дано значений 3"].assert_eq(&error.to_string());
}
