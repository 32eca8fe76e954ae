//! An answer in words, by the sentences of the grammar files: `say yes "Да."`

use super::grammar::{Grammar, Tongue};
use super::outcome::{Answer, Found};
use super::term::Form;
use super::words::Map;
use crate::language::names::named;
use crate::language::{Case, Language};
use crate::semantics::Subject;

/// Things that are named one by one.
const MOST_NAMED: usize = 20;

impl Grammar {
    /// What was found, in the language in which it was asked; none where that has no sentence for it. Names are said in
    /// the one of the map's two that is given.
    #[must_use]
    pub fn say(&self, map: &Map<'_>, answer: &Answer, language: Language) -> Option<String> {
        let tongue = self.tongue_of(&answer.reading.tongue)?;
        let says = |name: &str| tongue.says.get(name).map(String::as_str);
        let name = |symbol: &String| map.name_of(symbol, language);
        Some(match answer.found.as_ref().ok()? {
            Found::Things(all) if all.is_empty() => says("no_things")?.to_owned(),
            Found::Things(all) => {
                let mut names: Vec<String> = all.iter().take(MOST_NAMED).map(name).collect();
                if all.len() > MOST_NAMED {
                    names.push(format!("+{}", all.len() - MOST_NAMED));
                }
                says("things")?.replace("{things}", &listed(&names, says("and")?))
            }
            Found::Truth(yes) => says(if *yes { "yes" } else { "no" })?.to_owned(),
            Found::Number(number) => says("number")?.replace("{number}", &number.to_string()),
            Found::Length(tenths) => {
                let of_two = matches!(answer.reading.form, Form::Distance(..));
                let sentence = says("distance").filter(|_| of_two).or_else(|| says("length"))?;
                sentence.replace("{cm}", &(tenths / 100).to_string())
            }
            Found::Area(square) => {
                // As they are written of floors: «12,5».
                let (whole, tenth) = (square / 10_000, square % 10_000 / 1000);
                let metres = format!("{whole}{}{tenth}", language.pick(",", "."));
                says("area")?.replace("{m2}", &metres)
            }
            Found::Places(all) => {
                let mut sentences = Vec::new();
                for place in all {
                    let at: Vec<String> = place.at.iter().map(name).collect();
                    let sentence = says("place")?.replace("{thing}", &name(&place.thing));
                    sentences.push(sentence.replace("{place}", &at.join(", ")));
                }
                sentences.join(" ")
            }
            // A choice is told by its place among what was offered.
            Found::Values(_) if matches!(answer.reading.form, Form::Choice(..)) => return None,
            Found::Values(all) => {
                let word = |value: &String| map.value_in_words(value, tongue, language);
                let words: Vec<String> = all.iter().map(word).collect();
                says("values")?.replace("{values}", &listed(&words, says("and")?))
            }
            Found::Unknown => says("unknown")?.to_owned(),
        })
    }
}

/// «A, B и C».
fn listed(items: &[String], and: &str) -> String {
    match items {
        [] => String::new(),
        [only] => only.clone(),
        [first @ .., last] => format!("{} {and} {last}", first.join(", ")),
    }
}

impl Map<'_> {
    /// A value as a language says it: by its own words, else by those that the program knows.
    fn value_in_words(&self, value: &str, tongue: &Tongue, language: Language) -> String {
        let values = &self.lexicon.values;
        let Some(id) = values.meaning(value) else { return value.to_lowercase() };
        let own = tongue.qualities.iter().find(|(known, _)| values.meaning(known) == Some(id));
        let entry = values.entry(id);
        let word = language.pick(entry.russian.as_str(), entry.english.as_str());
        own.map_or(word, |(_, own)| own.as_str()).to_lowercase()
    }

    /// What a thing of the facts is called in a language.
    fn name_of(&self, symbol: &str, language: Language) -> String {
        match self.relations.symbols().subject(symbol) {
            Some(Subject::Entity(entity)) => {
                named(self.world, entity).form(Case::Nominative, language)
            }
            _ => symbol.to_owned(),
        }
    }
}
