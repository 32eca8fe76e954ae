//! What was derived is saved and gone on with.

use orthoframe_facts::{Live, Program, Value};
use orthoframe_units::Source;

const RULES: &str = r#"
        .decl at(thing: symbol, far: number) .input at
        .decl near(thing: symbol, text: symbol) .output near
        .decl any() .output any
        at("стол", 5). near("дверь", "рядом").
        near(T, cat(T, "!")) :- at(T, F), F < 9000000000000.
        any() :- near(_, _)."#;

fn live() -> Live {
    let program = Program::parse(&Source::new("t.dl", RULES)).unwrap();
    let mut live = Live::new(program.clone(), program.database()).unwrap();
    live.insert("at", &["шкаф".into(), 8_000_000_000_000.into()]).unwrap();
    assert!(live.save().is_none(), "an edit waits");
    live.update().unwrap();
    live
}

#[test]
fn what_was_saved_goes_on_as_if_nothing_had_happened() {
    let saved = live();
    let bytes = saved.save().unwrap();
    let mut restored = Live::restore(saved.program(), &bytes).unwrap();
    assert_eq!(restored.derived().sorted("near"), saved.derived().sorted("near"));
    assert_eq!(restored.derived().len("any"), Ok(1));
    let cupboard: [Value; 2] = ["шкаф".into(), 8_000_000_000_000.into()];
    assert_eq!(restored.remove("at", &cupboard), Ok(true));
    assert_eq!(restored.remove("at", &["стол".into(), 5.into()]), Ok(false), "the text says so");
    restored.update().unwrap();
    let fresh = restored.program().evaluate(restored.database()).unwrap();
    assert_eq!(restored.derived().sorted("near"), fresh.sorted("near"));
    assert_eq!(restored.derived().len("near"), Ok(2));
}

#[test]
fn broken_bytes_and_other_rules_are_refused() {
    let saved = live();
    let bytes = saved.save().unwrap();
    let other = Program::parse(&Source::new("t.dl", format!("{RULES} "))).unwrap();
    assert!(Live::restore(&other, &bytes).is_none());
    for length in 0..bytes.len() {
        assert!(Live::restore(saved.program(), &bytes[..length]).is_none());
    }
    // A flipped bit either is refused or gives a result that can be read.
    for at in 0..bytes.len() {
        let mut broken = bytes.clone();
        broken[at] ^= 0x40;
        if let Some(live) = Live::restore(saved.program(), &broken) {
            let _ = live.derived().sorted("near").unwrap();
        }
    }
}
