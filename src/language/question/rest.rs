//! Asking of the rest: whether what was told is all there is, and whether there is more of it elsewhere.

use super::grammar::Sentence;
use super::lexicon::KindId;
use super::mark::Pronoun;
use super::query::Rel;
use super::{Asker, Head, Memory, Noun, Query, Thing, assemble};
use crate::language::words::word_keys;

/// «Это все?», which a noun may follow.
const ALL: [&str; 9] = [
    "is that all",
    "is this all",
    "are those all",
    "are these all",
    "are they all",
    "это все",
    "и это все",
    "это вообще все",
    "and is that all",
];

const ELSEWHERE: [&str; 12] = [
    "elsewhere",
    "anywhere else",
    "somewhere else",
    "in other rooms",
    "in any other room",
    "in another room",
    "где нибудь еще",
    "еще где нибудь",
    "еще где то",
    "где то еще",
    "в других местах",
    "в других комнатах",
];

impl Asker<'_> {
    /// «И это все ложки на кухне?», "Are there any more of those elsewhere?": of the kind that was told, what is left.
    pub(super) fn of_the_rest(&self, text: &str, memory: &Memory) -> Option<Query> {
        let words = word_keys(text);
        let key = words.join(" ");
        let starts = |start: &&&str| key == **start || key.starts_with(&format!("{start} "));
        let told = &memory.last;
        if let Some(start) = ALL.iter().find(starts) {
            let named = key[start.len()..].trim();
            let noun = match named.is_empty() {
                true => self.as_asked(memory)?,
                false => self.described(named, memory)?,
            };
            let what = vec![self.but(noun, told)];
            return Some(Query::Exists { what, either: false, negated: true });
        }
        // What names something itself is a question of its own.
        let asks = ELSEWHERE.iter().find(|place| key.contains(**place))?;
        let rest = key.replace(asks, " ");
        const SMALL: [&str; 22] = [
            "are", "is", "there", "any", "more", "of", "those", "these", "them", "it", "some",
            "one", "and", "do", "you", "have", "another", "а", "и", "есть", "они", "ли",
        ];
        if rest.split_whitespace().any(|word| !SMALL.contains(&word)) {
            return None;
        }
        let kind = self.kind_told(memory)?;
        let noun = Noun { head: Head { kinds: vec![kind], ..Head::default() }, ..Noun::default() };
        let what = vec![self.but(Noun { plural: true, ..noun }, told)];
        Some(Query::Exists { what, either: false, negated: false })
    }

    /// The one kind of what was told last.
    fn kind_told(&self, memory: &Memory) -> Option<KindId> {
        let told: Vec<Thing> =
            memory.last.iter().copied().filter(|t| t.replica().is_some()).collect();
        self.knowledge(memory.language, memory).alike(&told)
    }

    /// What there is of that kind besides what was told.
    pub(super) fn rest_of_kind(&self, memory: &Memory) -> Option<Noun> {
        let kind = self.kind_told(memory).filter(|_| memory.last.len() > 1)?;
        let noun = Noun { head: Head { kinds: vec![kind], ..Head::default() }, ..Noun::default() };
        let rest = self.but(noun, &memory.last);
        let left = self.knowledge(memory.language, memory).find(&rest, true).ok()?;
        (!left.is_empty()).then_some(rest)
    }

    /// What the last question sought, in its own words.
    fn as_asked(&self, memory: &Memory) -> Option<Noun> {
        let sought = memory.query.as_ref()?.sought().filter(|noun| !noun.head.anything)?;
        Some(sought.clone())
    }

    /// A description by itself: "the spoons in the kitchen".
    fn described(&self, text: &str, memory: &Memory) -> Option<Noun> {
        let text = self.plain(text);
        let sentence = Sentence::new(&text, &self.mind.lexicon);
        let knowledge = self.knowledge(memory.language, memory);
        let referent = |pronoun: Pronoun, rel: Option<Rel>| knowledge.referent(pronoun, rel);
        assemble::fragment(&sentence, &self.mind.lexicon, &referent)
    }

    fn but(&self, noun: Noun, told: &[Thing]) -> Noun {
        let told = Noun { plural: told.len() > 1, ..Noun::of(told.to_vec()) };
        Noun { plural: true, except: vec![told], ..noun }
    }
}
