//! `ortho words`: all forms of a name, Russian and English, and where they come from.

use serde_json::{Value, json};

use crate::engine::{Engine, RequestError};
use crate::language::report::Named;
use crate::language::russian::{self, Preposition};
use crate::language::{Animacy, Case, Evidence, Gender, NounPhrase, Number, PlaceSense, english};

use super::args::{Common, Lang};
use super::fault::Failure;
use super::opened::{open, store_dir};
use super::{Answer, say};

/// A store is not needed; where there is one with a map, its forms of the name come first.
pub(super) fn run(common: &Common, name: &str) -> Result<Answer, Failure> {
    if !name.contains(char::is_alphanumeric) {
        let help = Some(
            (
                "нужно имя или слово: ortho words \"Письменный стол\"",
                "a name or a word is needed: ortho words \"Desk\"",
            )
                .into(),
        );
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
        return say(&view(&named).to_string());
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
        let from = source(evidence).1;
        lines.push(format!("  {word}: {}", lang.pick(from.0, from.1)));
    }
    if !phrase.is_certain() {
        lines.push(format!("  {}", lang.pick(
            "Формы не наверное верны; карта может задать их: forms = { gen = \"…\", dat = \"…\", acc = \"…\", ins = \"…\", loc = \"…\" }",
            "The forms are uncertain; the map can give them: forms = { gen = \"…\", dat = \"…\", acc = \"…\", ins = \"…\", loc = \"…\" }",
        )));
    }
    lines.join("\n")
}

fn view(named: &Named) -> Value {
    let phrase = named.phrase();
    let forms: Vec<Value> = numbers(phrase)
        .iter()
        .flat_map(|&number| Case::SIX.map(|case| (number, case)))
        .map(|(number, case)| {
            json!({
                "case": case.names().1,
                "number": number_name(number).1,
                "form": phrase.form(case, number),
                "source": source(phrase.evidence_of(case, number)).0,
            })
        })
        .collect();
    let said: serde_json::Map<String, Value> =
        prepositions(phrase).into_iter().map(|(key, said)| (key.to_owned(), said.into())).collect();
    let sources: Vec<Value> = phrase
        .sources()
        .into_iter()
        .map(|(word, evidence)| json!({ "word": word, "source": source(evidence).0 }))
        .collect();
    let (one, many) = english_forms(named);
    json!({
        "name": phrase.name(),
        "gender": gender_name(phrase.gender()).1,
        "animate": phrase.animacy() == Animacy::Animate,
        "number": number_name(phrase.number()).1,
        "place": if phrase.place() == PlaceSense::Upon { "на" } else { "в" },
        "forms": forms,
        "prepositions": said,
        "english": { "name": named.english_name(), "in_sentence": one, "plural": many },
        "sources": sources,
        "certain": phrase.is_certain(),
    })
}

/// A name that stands in the plural has no other number.
fn numbers(phrase: &NounPhrase) -> &'static [Number] {
    if phrase.number() == Number::Plural { &[Number::Plural] } else { &Number::BOTH }
}

/// Where, where to, where from, towards and about.
fn prepositions(phrase: &NounPhrase) -> [(&'static str, String); 5] {
    [
        ("where", russian::where_at(phrase)),
        ("whither", russian::whither(phrase)),
        ("whence", russian::whence(phrase)),
        ("towards", russian::with(Preposition::K, Case::Dative, phrase)),
        ("about", russian::with(Preposition::O, Case::Prepositional, phrase)),
    ]
}

fn english_forms(named: &Named) -> (String, String) {
    (named.english(), english::plural(named.english_name()))
}

fn nature(phrase: &NounPhrase, lang: Lang) -> String {
    let (gender, number) = (gender_name(phrase.gender()), number_name(phrase.number()));
    let mut nature = match phrase.number() {
        Number::Plural => lang.pick(number.0, number.1).to_owned(),
        Number::Singular => lang.pick(gender.0, gender.1).to_owned(),
    };
    if phrase.animacy() == Animacy::Animate {
        nature.push_str(lang.pick(", одушевлённое", ", animate"));
    }
    nature
}

fn gender_name(gender: Gender) -> (&'static str, &'static str) {
    match gender {
        Gender::Masculine => ("мужской род", "masculine"),
        Gender::Feminine => ("женский род", "feminine"),
        Gender::Neuter => ("средний род", "neuter"),
    }
}

fn number_name(number: Number) -> (&'static str, &'static str) {
    match number {
        Number::Singular => ("единственное число", "singular"),
        Number::Plural => ("множественное число", "plural"),
    }
}

/// Its word for programs, and in Russian and English.
fn source(evidence: Evidence) -> (&'static str, (&'static str, &'static str)) {
    match evidence {
        Evidence::Given => ("map", ("по карте", "from the map")),
        Evidence::Lexicon => ("list", ("по списку слов", "from the word list")),
        Evidence::Dictionary => ("dictionary", ("по словарю", "from the dictionary")),
        Evidence::Rule => ("rule", ("по окончанию, наверное", "by its ending, surely")),
        Evidence::Guess => ("guess", ("по окончанию, догадка", "by its ending, a guess")),
    }
}
