//! "Bring these cups", «Отнеси эти вещи на кухню»: an order about several of those that were told.
//!
//! Invariant: where nothing was told nothing is meant, least of all every thing on the map.

use super::super::grammar::{Item, Phrase, Sentence, are_shown};
use super::super::{Asker, Doubt, Memory, Noun};
use crate::command;
use crate::words::Case;

impl Asker<'_> {
    /// An order with the names of those that it shows.
    ///
    /// # Errors
    /// Nothing was told that it could mean, or it shows places.
    pub(super) fn with_shown(&self, mut text: String, memory: &Memory) -> Result<String, Doubt> {
        let described = command::without_verbs(&text);
        let sentence = Sentence::new(&described, &self.mind.lexicon);
        let knowledge = self.knowledge(sentence.language, memory);
        let shows = |phrase: &Phrase| are_shown(&phrase.noun);
        let mut shown = Vec::new();
        for item in sentence.items() {
            match item {
                Item::Noun(phrase) if shows(&phrase) => shown.push(phrase),
                Item::Place { nouns, .. } if nouns.iter().any(shows) => {
                    let words = nouns.into_iter().find(shows).map(|phrase| phrase.noun.text);
                    return Err(Doubt::not_understood(&words.unwrap_or_default()));
                }
                _ => {}
            }
        }
        // From the end, so that the places before stay where they are.
        for phrase in shown.into_iter().rev() {
            let mut noun = Noun { text: phrase.noun.text.clone(), ..phrase.noun.clone() };
            let meant = match phrase.pronoun {
                Some(pronoun) => knowledge.referent(pronoun, None),
                None => {
                    knowledge.of_those_shown(&mut noun);
                    noun.count = None;
                    let told = noun.head.things.is_some();
                    if told { knowledge.find(&noun, true)? } else { Vec::new() }
                }
            };
            // "One of these cups", "two of these": which, nothing says.
            let some = phrase.noun.indefinite && meant.len() > 1;
            let so_many = phrase.noun.count.map_or(meant.len() as u64, |count| count);
            if some || so_many != meant.len() as u64 && !meant.is_empty() {
                let (reference, candidates) = (phrase.noun.text, meant);
                return Err(Doubt::Ambiguous { reference, candidates });
            }
            let at = sentence.words.get(phrase.words.start).map(|word| word.start);
            let end = phrase.words.end.checked_sub(1).and_then(|last| sentence.words.get(last));
            let (Some(from), Some(to), false) = (at, end.map(|word| word.end), meant.is_empty())
            else {
                return Err(Doubt::NoReferent { word: phrase.noun.text });
            };
            text.replace_range(from..to, &knowledge.listed(&meant, Case::Accusative));
        }
        Ok(text)
    }
}
