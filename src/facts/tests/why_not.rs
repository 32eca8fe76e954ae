//! Why something holds, and what is missing where it does not.

use expect_test::{Expect, expect};
use orthoframe_facts::{Explainer, Program, Value, WhyNot};
use orthoframe_units::Source;

const RULES: &str = r#"
.decl зазор(а: symbol, б: symbol, мм: number) .input зазор
.decl сплошной(б: symbol) .input сплошной
.decl внутри(а: symbol, б: symbol) .input внутри
.decl сверху(а: symbol, б: symbol) = ON_TOP_OF
.decl опора(а: symbol, б: symbol)
.decl занят(б: symbol, n: number)
.output опора .output занят
сверху(A, B) :- зазор(A, B, G), G >= -60, G <= 60, сплошной(B), !внутри(A, B).
опора(A, B) :- сверху(A, B).
опора(A, C) :- опора(A, B), сверху(B, C).
занят(B, N) :- сплошной(B), N = count : { сверху(_, B) }, N > 0.
"#;

fn explainer() -> Explainer {
    let program = Program::parse(&Source::new("опора.dl", RULES.trim_start())).unwrap();
    let mut facts = program.database();
    for (a, b, gap) in [
        ("чашка", "блюдце", 0),
        ("блюдце", "стол", 5),
        ("лампа", "стол", 140),
        ("кот", "шкаф", -20),
    ] {
        facts.insert("зазор", &[a.into(), b.into(), gap.into()]).unwrap();
    }
    for b in ["блюдце", "стол", "шкаф"] {
        facts.insert("сплошной", &[b.into()]).unwrap();
    }
    facts.insert("внутри", &["кот".into(), "шкаф".into()]).unwrap();
    program.evaluate(&facts).unwrap().explain()
}

fn check_why(relation: &str, tuple: &[Value], expected: &Expect) {
    let proof = explainer().why(relation, tuple).unwrap();
    expected.assert_eq(&proof.map_or("не выполняется\n".into(), |proof| proof.to_string()));
}

fn check_why_not(relation: &str, tuple: &[Value], expected: &Expect) {
    let shown = match explainer().why_not(relation, tuple).unwrap() {
        WhyNot::Nearest(rule) => {
            let mut shown = format!("{}:{}\n", rule.rule.source, rule.rule.line);
            for (premise, holds) in &rule.premises {
                let mark = match holds {
                    Some(true) => '+',
                    Some(false) => '-',
                    None => '?',
                };
                shown += &format!("{mark} {premise}\n");
            }
            shown
        }
        other => format!("{other:?}\n"),
    };
    expected.assert_eq(&shown);
}

#[test]
fn a_proof_goes_down_to_the_measurements() {
    check_why(
        "опора",
        &["чашка".into(), "стол".into()],
        &expect![[r#"
            опора("чашка", "стол")  ← опора.dl:10
              опора("чашка", "блюдце")  ← опора.dl:9
                сверху("чашка", "блюдце")  ← опора.dl:8
                  зазор("чашка", "блюдце", 0)
                  G >= -60: 0 >= -60
                  G <= 60: 0 <= 60
                  сплошной("блюдце")
                  !внутри("чашка", "блюдце")
              сверху("блюдце", "стол")  ← опора.dl:8
                зазор("блюдце", "стол", 5)
                G >= -60: 5 >= -60
                G <= 60: 5 <= 60
                сплошной("стол")
                !внутри("блюдце", "стол")
        "#]],
    );
}

#[test]
fn a_proof_shows_counts() {
    check_why(
        "занят",
        &["стол".into(), 1.into()],
        &expect![[r#"
                занят("стол", 1)  ← опора.dl:11
                  сплошной("стол")
                  count : { сверху(_, B) } = 1
                  N = count : { сверху(_, B) }: 1 = 1
                  N > 0: 1 > 0
            "#]],
    );
    check_why(
        "занят",
        &["стол".into(), 2.into()],
        &expect![[r#"
            не выполняется
        "#]],
    );
}

#[test]
fn a_number_beyond_its_threshold_is_named() {
    check_why_not(
        "ON_TOP_OF",
        &["лампа".into(), "стол".into()],
        &expect![[r#"
            опора.dl:8
            + зазор("лампа", "стол", 140)
            + G >= -60: 140 >= -60
            - G <= 60: 140 <= 60
            + сплошной("стол")
            + !внутри("лампа", "стол")
        "#]],
    );
}

#[test]
fn what_stands_against_it_is_named() {
    check_why_not(
        "сверху",
        &["кот".into(), "шкаф".into()],
        &expect![[r#"
            опора.dl:8
            + зазор("кот", "шкаф", -20)
            + G >= -60: -20 >= -60
            + G <= 60: -20 <= 60
            + сплошной("шкаф")
            - !внутри("кот", "шкаф")
        "#]],
    );
}

#[test]
fn a_missing_tuple_is_named_and_what_hangs_on_it_left_open() {
    check_why_not(
        "сверху",
        &["чашка".into(), "шкаф".into()],
        &expect![[r#"
            опора.dl:8
            - зазор("чашка", "шкаф", _)
            ? G >= -60
            ? G <= 60
            + сплошной("шкаф")
            + !внутри("чашка", "шкаф")
        "#]],
    );
    check_why_not(
        "зазор",
        &["чашка".into(), "шкаф".into(), 3.into()],
        &expect![[r#"
            NotTold
        "#]],
    );
    check_why_not(
        "опора",
        &["чашка".into(), "никто".into()],
        &expect![[r#"
            опора.dl:9
            - сверху("чашка", "никто")
        "#]],
    );
    check_why_not(
        "занят",
        &["шкаф".into(), 4.into()],
        &expect![[r#"
                опора.dl:11
                + сплошной("шкаф")
                + count : { сверху(_, B) } = 0
                - N = count : { сверху(_, B) }: 4 = 0
                + N > 0: 4 > 0
            "#]],
    );
}
