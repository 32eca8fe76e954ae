//! Names of predicates that were mistyped.

use expect_test::{Expect, expect};
use orthoframe_strips::Scenario;
use orthoframe_units::Source;

fn check(precondition: &str, effect: &str, expected: &Expect) {
    let text = format!(
        "Действие: Ехать (Параметры: место ?a, место ?b)
             (Предусловие: РОБОТ-НАХОДИТСЯ-В_(?a) ДОРОГА_ИЗ_В_(?a, ?b)) (Эффект+: РОБОТ-НАХОДИТСЯ-В_(?b)) (Эффект-: РОБОТ-НАХОДИТСЯ-В_(?a))
             Действие: Взять (Параметры: место ?a, вещь ?t) (Предусловие: {precondition}) (Эффект+: {effect})
             Факты: РОБОТ-НАХОДИТСЯ-В_(Кухня) ДОРОГА_ИЗ_В_(Кухня, Зал) ВЕЩЬ_НАХОДИТСЯ-В_(Чашка, Зал)"
    );
    let told = match Scenario::parse(&Source::new("правила", text)) {
        Ok(scenario) => scenario.warnings,
        Err(faults) => faults.0,
    };
    let told: Vec<String> = told
        .iter()
        .map(|fault| {
            let help = miette::Diagnostic::help(fault).map(|help| help.to_string());
            format!("{fault} – {}", help.unwrap_or_default())
        })
        .collect();
    expected.assert_eq(&told.join("\n"));
}

#[test]
fn a_slip_is_told_with_the_name_that_was_meant() {
    check(
        "РОБОТ-НАХОДТСЯ-В_(?a) ВЕЩЬ_НАХОДИТСЯ-В_(?t, ?a)",
        "РОБОТ-ДЕРЖИТ_(?t)",
        &expect![
            "правила:3:75: предикат «РОБОТ-НАХОДТСЯ-В» встречается только в действии «Взять» – не описка ли это? – может быть, «РОБОТ-НАХОДИТСЯ-В»? если нет, объявите предикаты в разделе «Предикаты»"
        ],
    );
    check(
        "РОБОТ-НАХОДИТСЯ-В_(?a) ВЕЩЬ-НАХОДИТСЯ-В_(?t, ?a)",
        "РОБОТ-ДЕРЖИТ_(?t)",
        &expect![[r#"
                правила:3:98: неизвестный предикат «ВЕЩЬ-НАХОДИТСЯ-В» – может быть, «ВЕЩЬ_НАХОДИТСЯ-В»?
                правила:4:72: неизвестный предикат «ВЕЩЬ_НАХОДИТСЯ-В» – может быть, «ВЕЩЬ-НАХОДИТСЯ-В»?"#]],
    );
    check(
        "РОБОТ-НАХОДИТСЯ-В_(?a)",
        "РОБОТ-НАХОДИТСЯ-B_(?a)",
        &expect![[r#"
            правила:3:109: неизвестный предикат «РОБОТ-НАХОДИТСЯ-B» – может быть, «РОБОТ-НАХОДИТСЯ-В»? буквы выглядят одинаково, но взяты из разных алфавитов
            правила:4:72: неизвестный предикат «ВЕЩЬ_НАХОДИТСЯ-В» – может быть, «РОБОТ-НАХОДИТСЯ-В»?"#]],
    );
}

#[test]
fn another_word_is_another_predicate() {
    check(
        "РОБОТ-НАХОДИТСЯ-У_(?a) ВЕЩЬ_НАХОДИТСЯ-В_(?t, ?a)",
        "РОБОТ-ДЕРЖИТ_(?t)",
        &expect![[r#""#]],
    );
}
