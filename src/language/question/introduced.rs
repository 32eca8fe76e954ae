//! What a text speaks of, whether the map has it or not: names that mean something, words for anything at all, pronouns.
//!
//! Invariant: whether the map has such a thing is asked elsewhere.

use super::doubt::Doubt;
use super::grammar::{Item, Phrase, Sentence};
use super::mark::{Mark, Pronoun};
use super::{Asker, purposes};
use crate::sets::set;
use crate::words::{everyday as everyday_words, word_keys, word_ranges};

impl Asker<'_> {
    /// "The left consult room 3", of which "the left consult" is not understood: whether the words that are not stand right
    /// before a name that has a number, so that another is meant than the one that is called so.
    pub(super) fn cuts_name(&self, text: &str, doubt: &Doubt) -> bool {
        let (Doubt::NotUnderstood { words } | Doubt::Unknown { reference: words, .. }) = doubt
        else {
            return false;
        };
        let Some(at) = text.find(words.as_str()).filter(|_| words.len() < text.trim().len()) else {
            return false;
        };
        let end = at + words.len();
        let next = word_ranges(text).iter().position(|word| word.start > end);
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let follows = |phrase: &Phrase| {
            let numbered = phrase.words.clone().any(|n| sentence.keys[n].parse::<u32>().is_ok());
            Some(phrase.words.start) == next && (numbered || !phrase.noun.head.named.is_empty())
        };
        let joined = text[end..].starts_with(' ');
        joined
            && sentence.items().iter().any(|item| match item {
                Item::Noun(phrase) => follows(phrase),
                Item::Place { nouns, .. } => nouns.iter().any(follows),
                _ => false,
            })
    }

    /// Whether something here knows what a name means, whatever the map has: a sort of things, the word list, or the map
    /// itself for a name with a number of its own ("cup 5").
    pub(super) fn is_word(&self, name: &str) -> bool {
        let keys = word_keys(name);
        let small = |key: &&String| set!("AnyArticle").contains(&key.as_str());
        let keys: Vec<String> = keys.iter().skip_while(small).cloned().collect();
        let numbered = keys.split_last().filter(|(last, _)| last.chars().all(char::is_numeric));
        if let Some((_, rest)) = numbered {
            return !rest.is_empty() && !self.mind.lexicon.nouns.find(&rest.join(" ")).is_empty();
        }
        let key = keys.join(" ");
        everyday_words::is_a_thing(&key)
            || everyday_words::is_in_list(&key)
            || purposes::is_a_word(&key)
    }

    /// Whether a text has words for anything at all, known or not, that it may speak of: «А что внутри?» has none.
    pub(super) fn introduces(&self, text: &str) -> bool {
        let text = self.plain(text);
        let idle = |item: &Item| match item {
            // «второй», "the other one" may be what was not understood.
            Item::Mark(mark) => {
                !matches!(mark, Mark::Rank(_) | Mark::One | Mark::Other | Mark::Best(_))
            }
            Item::Link(_) | Item::Property(_) => true,
            _ => false,
        };
        let items = Sentence::new(&text, &self.mind.lexicon).items();
        items.is_empty() || !items.iter().all(idle)
    }

    pub(super) fn pronouns(&self, text: &str) -> Vec<Pronoun> {
        let text = self.plain(text);
        let items = Sentence::new(&text, &self.mind.lexicon).items();
        let phrases = items.iter().flat_map(|item| match item {
            Item::Noun(phrase) => std::slice::from_ref(phrase),
            Item::Place { nouns, .. } => &nouns[..],
            _ => &[],
        });
        phrases.filter_map(|phrase| phrase.pronoun).collect()
    }
}
