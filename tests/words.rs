//! Word forms of whole names: golden paradigms, and the index that finds each of them again.

use std::fmt::Write as _;
use std::path::Path;

use orthoframe::language::{Case, NounPhrase, Number, WordHints};

#[test]
fn names_decline_as_the_golden_tables_say() {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/words");
    for case in std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path()) {
        let names = std::fs::read_to_string(case.join("names.txt")).unwrap();
        let table: String = names.lines().map(paradigm).collect();
        expect_test::expect_file![case.join("forms.txt")].assert_eq(&table);
    }
}

/// The paradigm of a name; what the word list and the rules say, so that the table holds without a dictionary.
fn paradigm(name: &str) -> String {
    let phrase = NounPhrase::parse(name, &WordHints::default());
    let row = |number| Case::SIX.map(|case| phrase.form(case, number)).join(" | ");
    let mut text = format!("{name}: {:?} {:?} {:?}\n", phrase.gender(), phrase.animacy(), phrase.place());
    if phrase.number() == Number::Singular {
        writeln!(text, "    {} | {}", row(Number::Singular), phrase.form(Case::Locative, Number::Singular)).unwrap();
    }
    writeln!(text, "    {}", row(Number::Plural)).unwrap();
    text
}
