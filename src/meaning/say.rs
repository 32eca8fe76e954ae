//! An answer in words, by the sentences of the grammar files: `say yes "Да."`

use super::answer::{Answer, Found};
use super::grammar::Grammar;
use super::read::Map;
use super::term::Form;
use crate::language::names::named;
use crate::language::{Case, Language, enumerate};
use crate::semantics::Subject;

/// The sentences that a language must have, and the parts that they may name.
pub(crate) const SENTENCES: [&str; 9] =
    ["things", "no_things", "yes", "no", "number", "length", "place", "values", "unknown"];
/// Things that are named one by one.
const MOST_NAMED: usize = 20;

impl Grammar {
    /// What was found, in a language; none where that has no sentence for it.
    #[must_use]
    pub fn say(&self, map: &Map<'_>, answer: &Answer, language: Language) -> Option<String> {
        let says = |name: &str| self.tongue(language)?.says.get(name).map(String::as_str);
        let name = |symbol: &String| map.name_of(symbol, language);
        Some(match answer.found.as_ref().ok()? {
            Found::Things(all) if all.is_empty() => says("no_things")?.to_owned(),
            Found::Things(all) => {
                let mut names: Vec<String> = all.iter().take(MOST_NAMED).map(name).collect();
                if all.len() > MOST_NAMED {
                    names.push(format!("+{}", all.len() - MOST_NAMED));
                }
                says("things")?.replace("{things}", &enumerate(&names, language))
            }
            Found::Truth(yes) => says(if *yes { "yes" } else { "no" })?.to_owned(),
            Found::Number(number) => says("number")?.replace("{number}", &number.to_string()),
            Found::Length(tenths) => says("length")?.replace("{cm}", &(tenths / 100).to_string()),
            Found::Places(all) => {
                let mut sentences = Vec::new();
                for place in all {
                    let at: Vec<String> =
                        place.support.iter().chain(&place.room).map(name).collect();
                    let sentence = says("place")?.replace("{thing}", &name(&place.thing));
                    sentences.push(sentence.replace("{place}", &at.join(", ")));
                }
                sentences.join(" ")
            }
            // A choice is told by its place among what was offered.
            Found::Values(_) if matches!(answer.reading.form, Form::Choice(..)) => return None,
            Found::Values(all) => {
                says("values")?.replace("{values}", &enumerate(&all[..], language).to_lowercase())
            }
            Found::Unknown => says("unknown")?.to_owned(),
        })
    }
}

impl Map<'_> {
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
