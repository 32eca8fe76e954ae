//! Word forms of whole names: golden paradigms, and the index that finds each of them again.

use std::fmt::Write as _;
use std::path::Path;

use orthoframe_language::command::{Listener, Misheard, in_time, is_order};
use orthoframe_language::paraphrase::Paraphrases;
use orthoframe_language::question::conditional;
use orthoframe_language::{
    Animacy, Case, FormIndex, Gender, Language, NounPhrase, Number, WordHints,
};
use proptest::prelude::{prop_assert, prop_assert_eq, proptest};

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
    let mut text =
        format!("{name}: {:?} {:?} {:?}\n", phrase.gender(), phrase.animacy(), phrase.place());
    if phrase.number() == Number::Singular {
        writeln!(
            text,
            "    {} | {}",
            row(Number::Singular),
            phrase.form(Case::Locative, Number::Singular)
        )
        .unwrap();
    }
    writeln!(text, "    {}", row(Number::Plural)).unwrap();
    text
}

#[test]
fn the_index_finds_every_form_of_every_name() {
    let names = golden_names();
    let mut index = FormIndex::default();
    for name in &names {
        index.insert(&NounPhrase::parse(name, &WordHints::default()), name.clone());
    }
    let (mut forms, mut ambiguous) = (0, 0);
    for name in &names {
        let phrase = NounPhrase::parse(name, &WordHints::default());
        assert_eq!(&phrase.case(Case::Nominative), name, "the nominative is the name");
        for (number, case, form) in phrase.all_forms() {
            for typed in [
                form.clone(),
                form.to_uppercase(),
                form.replace(['-', ' '], " "),
                form.replace('ё', "е"),
                latin(&form),
            ] {
                let hits = index.find(&typed);
                let hit = hits
                    .iter()
                    .find(|hit| hit.id == name)
                    .unwrap_or_else(|| panic!("{name}: {typed}"));
                assert!(hit.readings.has(number, case), "{name}: {typed} as {case:?}");
            }
            forms += 1;
            ambiguous += usize::from(index.find(&form).len() > 1);
        }
    }
    assert!(forms > 1000 && ambiguous * 20 < forms, "{ambiguous} of {forms} forms are ambiguous");
}

/// All golden names, without those that are one name spelled twice.
fn golden_names() -> Vec<String> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/words");
    let cases = std::fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    let texts: Vec<String> =
        cases.map(|case| std::fs::read_to_string(case.join("names.txt")).unwrap()).collect();
    let twins = ["Комнатa-B", "ковер", "КОМНАТА-В"];
    texts
        .iter()
        .flat_map(|text| text.lines())
        .filter(|name| !twins.contains(name))
        .map(Into::into)
        .collect()
}

/// The same text with Latin letters where they look the same.
fn latin(text: &str) -> String {
    let twins = ['а', 'е', 'о', 'с', 'р', 'х', 'В', 'А', 'К'].into_iter().zip("aeocpxBAK".chars());
    let twins: Vec<_> = twins.collect();
    text.chars()
        .map(|c| twins.iter().find(|(cyrillic, _)| *cyrillic == c).map_or(c, |(_, latin)| *latin))
        .collect()
}

proptest! {
    /// Whatever a map calls a thing: no panic, the nominative is the name, and each form finds it.
    #[test]
    fn any_text_is_a_name(name in "[А-Яа-яёЁA-Za-z0-9 «»\"(),./№'–-]{0,24}|\\PC{0,12}") {
        let phrase = NounPhrase::parse(&name, &WordHints::default());
        prop_assert_eq!(phrase.case(Case::Nominative), phrase.name());
        let mut index = FormIndex::default();
        index.insert(&phrase, ());
        for (_, _, form) in phrase.all_forms() {
            prop_assert!(!form.chars().any(char::is_alphanumeric) || !index.find(&form).is_empty(), "{}", form);
        }
        prop_assert!(index.near(&name, 2).len() <= 1);
    }

    /// Whatever a person says: an answer, never a panic, in either language.
    #[test]
    fn any_text_may_be_said(text in "([а-яa-z]{1,4} ){0,4}|\\PC{0,40}|(принеси |в |на |книгу |и |мне |Комнату-|В |not |go |to |дверь |, |её ){0,9}") {
        let mut index = FormIndex::default();
        for name in ["Книга", "Комната-В", "Дверь-ВZ"] {
            index.insert(&NounPhrase::parse(name, &WordHints::default()), name);
        }
        match Listener::new(&index).hear(&text) {
            Ok(commands) => prop_assert!(!commands.is_empty()),
            Err(misheard) => prop_assert!(!misheard.say(Language::Russian).is_empty() && !misheard.say(Language::English).is_empty()),
        }
    }
}

#[test]
fn a_very_long_name_is_only_slow() {
    let name = "Комната-В у окна ".repeat(6_000);
    let phrase = NounPhrase::parse(&name, &WordHints::default());
    assert!(phrase.case(Case::Genitive).starts_with("Комнаты-В у окна"));
}

/// Readers look at each word beside the others: what no one says in one breath is refused before.
#[test]
fn a_very_long_order_is_refused_at_once() {
    let mut index = FormIndex::default();
    index.insert(&NounPhrase::parse("Чашка", &WordHints::default()), 1);
    for text in ["if ".repeat(500), ",".repeat(10_000), "если чашка на столе, то ".repeat(200)]
    {
        let heard = Listener::new(&index).hear(&text);
        assert!(matches!(heard, Err(Misheard::TooLong { .. })), "{heard:?}");
        assert!(
            conditional(&text).is_none()
                && !is_order(&text)
                && in_time(&text, &Paraphrases::built_in()).is_none()
        );
    }
}

#[test]
fn what_the_map_says_comes_first() {
    let mut hints = WordHints {
        gender: Some(Gender::Masculine),
        animacy: Some(Animacy::Animate),
        ..WordHints::default()
    };
    let robot = NounPhrase::parse("РБ-2", &hints);
    assert_eq!((robot.gender(), robot.case(Case::Genitive)), (Gender::Masculine, "РБ-2".into()));
    hints.forms.insert((Number::Singular, Case::Genitive), "Эр-Бэ".into());
    let robot = NounPhrase::parse("РБ-2", &hints);
    assert_eq!(
        robot.case(Case::Accusative),
        "Эр-Бэ",
        "a living thing is in the accusative as in the genitive"
    );
    let kettle = NounPhrase::parse(
        "Самогрей",
        &WordHints { number: Some(Number::Singular), ..WordHints::default() },
    );
    assert!(!kettle.is_certain() && kettle.case(Case::Instrumental) == "Самогреем");
}

#[cfg(feature = "rumorph")]
#[test]
fn the_dictionary_knows_living_beings() {
    let of = |name| NounPhrase::parse(name, &WordHints::default()).case(Case::Accusative);
    assert_eq!((of("Иван Петрович"), of("Актёр")), ("Ивана Петровича".into(), "Актёра".into()));
}
