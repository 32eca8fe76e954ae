//! Why, and why not.

use expect_test::expect;
use orthoframe_facts::WhyNot;
use orthoframe_semantics::Around;

use super::{derived, room};

const LIFTED: &str = r#"
{ name = "Куб", object = "cube", at = [100, 100] },
{ name = "Чашка-1", object = "cup", at = [115, 115, 40] },
{ name = "Чашка-2", object = "cup", at = [125, 115, 45] },
"#;

#[test]
fn a_proof_goes_down_to_the_measurements() {
    let world = room(0.0, LIFTED);
    let (relations, around) = (derived(&world), Around::new(&world));
    let proof =
        relations.why(&around, "ON_TOP_OF", &["чашка-1", "куб"]).expect("it is asked rightly");
    let told: Vec<String> = proof
        .expect("it holds")
        .steps
        .iter()
        .filter(|s| s.height == 0)
        .map(|s| {
            let values: Vec<String> = s.fact.values.iter().map(ToString::to_string).collect();
            format!("{}: {}\n", s.fact.name, values.join(", "))
        })
        .collect();
    expect![[r#"
        over: Чашка-1, Куб, Куб #10, solid, 0, 1000, 1, 2000
        body: Куб, 0, 4000, 4000, 4000, 1600
        replica: Куб, 1, Куб (cube), Комната, 0
        profile: surveyed
        limit: surveyed, support gap up, 200
        limit: surveyed, support gap down, 200
        limit: common, support share, 500
    "#]]
    .assert_eq(&told.concat());
    assert_eq!(
        relations.why(&around, "ON_TOP_OF", &["чашка-2", "куб"]).expect("it is asked rightly"),
        None
    );
}

#[test]
fn why_not_names_the_premise_that_failed_with_its_numbers() {
    let world = room(
        0.0,
        r#"
{ name = "Шкаф", object = "wardrobe", at = [300, 300] },
{ name = "Куб", object = "cube", at = [430, 310] },
"#,
    );
    let question =
        derived(&world).why_not(&Around::new(&world), "НАХОДИТСЯ_ПЕРЕД", &["куб", "шкаф"]);
    let WhyNot::Nearest(rule) = question.expect("asked rightly") else {
        panic!("it does not hold, and rules derive it");
    };
    // Ninety degrees to the left, where forty-five are in front.
    expect![[r#"
        [
            Compared {
                text: "Angle <= H",
                left: Number(
                    9000,
                ),
                op: LessOrEqual,
                right: Number(
                    4500,
                ),
            },
        ]
    "#]]
    .assert_debug_eq(&rule.failed().collect::<Vec<_>>());
}

#[test]
fn an_unknown_relation_is_answered_with_the_nearest_name() {
    let relations = derived(&room(0.0, LIFTED));
    let error = relations.tuples("НАХОДИТСЯ_СВЕРХУ").expect_err("no such relation");
    expect!["нет отношения «НАХОДИТСЯ_СВЕРХУ»; может быть, «НАХОДИТСЯ_СВЕРХУ_НА»?"].assert_eq(
        &format!("{error}; {}", miette::Diagnostic::help(&error).expect("it has a remedy")),
    );
}
