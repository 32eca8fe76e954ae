//! The forms of a name, as data.

use serde_json::{Map, Value, json};

use crate::engine::forms::{english_forms, numbers, prepositions};
use crate::language::report::Named;
use crate::language::{Animacy, Case, Evidence, PlaceSense};

/// All forms of a name, Russian and English, and where they come from.
#[must_use]
pub(crate) fn declined(named: &Named) -> Value {
    let phrase = named.phrase();
    let forms: Vec<Value> = numbers(phrase)
        .iter()
        .flat_map(|&number| Case::SIX.map(|case| (number, case)))
        .map(|(number, case)| {
            json!({
                "case": case.names().1,
                "number": number.names().1,
                "form": phrase.form(case, number),
                "source": source(phrase.evidence_of(case, number)),
            })
        })
        .collect();
    let said: Map<String, Value> =
        prepositions(phrase).into_iter().map(|(key, said)| (key.to_owned(), said.into())).collect();
    let sources: Vec<Value> = phrase
        .sources()
        .into_iter()
        .map(|(word, evidence)| json!({ "word": word, "source": source(evidence) }))
        .collect();
    let (one, many) = english_forms(named);
    json!({
        "name": phrase.name(),
        "gender": phrase.gender().names().1,
        "animate": phrase.animacy() == Animacy::Animate,
        "number": phrase.number().names().1,
        "place": if phrase.place() == PlaceSense::Upon { "на" } else { "в" },
        "forms": forms,
        "prepositions": said,
        "english": { "name": named.english_name(), "in_sentence": one, "plural": many },
        "sources": sources,
        "certain": phrase.is_certain(),
    })
}

const fn source(evidence: Evidence) -> &'static str {
    match evidence {
        Evidence::Given => "map",
        Evidence::Lexicon => "list",
        Evidence::Dictionary => "dictionary",
        Evidence::Rule => "rule",
        Evidence::Guess => "guess",
    }
}
