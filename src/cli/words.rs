//! `ortho words`: all forms of a name, Russian and English, and where they come from.

use crate::engine::forms::{english_forms, numbers, prepositions};
use crate::engine::{Engine, RequestError, json};
use crate::language::report::Named;
use crate::language::{Animacy, Case, Evidence, NounPhrase, Number, russian};
use crate::units::{Piece, said, told, word};

use super::args::{Common, Lang};
use super::fault::Failure;
use super::opened::{open, store_dir};
use super::{Answer, say};

/// A store is not needed; where there is one with a map, its forms of the name come first.
pub(super) fn run(common: &Common, name: &str) -> Result<Answer, Failure> {
    if !name.contains(char::is_alphanumeric) {
        let help = Some(said!("name-wanted"));
        let name = name.chars().take(40).collect();
        return Err(RequestError::UnknownName { name, help }.into());
    }
    let wanted = common.store.is_some() || store_dir(common).is_dir();
    let engine: Option<Engine> = wanted.then(|| open(common)).transpose()?;
    let named = match engine {
        Some(engine) if common.store.is_some() || engine.world().is_ok() => {
            engine.declined(name)?
        }
        _ => Named::plain(name),
    };
    if common.json {
        return say(&json::declined(&named).to_string());
    }
    say(&table(&named, common.lang))
}

fn table(named: &Named, lang: Lang) -> String {
    let phrase = named.phrase();
    let mut lines = vec![format!("{}: {}", phrase.name(), nature(phrase, lang))];
    let numbers = numbers(phrase);
    let width = |number: Number| {
        let forms = Case::SIX.map(|case| phrase.form(case, number).chars().count());
        forms.into_iter().max().unwrap_or(0)
    };
    for case in Case::SIX {
        let (russian, english) = case.names();
        let mut line = format!("  {:<14}", lang.pick(russian, english));
        for &number in numbers {
            let form = phrase.form(case, number);
            let pad = width(number) - form.chars().count() + 2;
            line.push_str(&form);
            line.push_str(&" ".repeat(pad));
        }
        lines.push(line.trim_end().to_owned());
    }
    let said = prepositions(phrase).map(|(_, said)| said);
    lines.push(format!("  {}", said.join(", ")));
    let counted: Vec<String> = [1, 2, 5].iter().map(|n| russian::count(*n, phrase)).collect();
    lines.push(format!("  {}", counted.join(", ")));
    let (one, many) = english_forms(named);
    lines.push(format!("  English: {one}, {many}"));
    for (word, evidence) in phrase.sources() {
        lines.push(format!("  {word}: {}", source(evidence).say(lang.language())));
    }
    if !phrase.is_certain() {
        let example = r#"{ gen = "…", dat = "…", acc = "…", ins = "…", loc = "…" }"#;
        lines.push(format!("  {}", told!(lang.language(), "forms-uncertain", example)));
    }
    lines.join("\n")
}

fn nature(phrase: &NounPhrase, lang: Lang) -> String {
    let (gender, number) = (phrase.gender().names(), phrase.number().names());
    let mut nature = match phrase.number() {
        Number::Plural => told!(lang.language(), "plural", number),
        Number::Singular => told!(lang.language(), "gender", gender),
    };
    if phrase.animacy() == Animacy::Animate {
        nature.push_str(&told!(lang.language(), "animate"));
    }
    nature
}

fn source(evidence: Evidence) -> Piece {
    match evidence {
        Evidence::Given => word!("from-the-map"),
        Evidence::Lexicon => word!("from-the-word-list"),
        Evidence::Dictionary => word!("from-the-dictionary"),
        Evidence::Rule => word!("by-its-ending-surely"),
        Evidence::Guess => word!("by-its-ending-a-guess"),
    }
}
