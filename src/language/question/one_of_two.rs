//! Of two things that are joined the map knows one: it is told of that one, and that it lacks the other.

use super::grammar::{Item, Sentence};
use super::mark::Mark;
use super::{Answer, Asker, Doubt, Memory, Said, several, vocabulary};
use crate::words::Language;

impl Asker<'_> {
    /// "Is there a microwave or a toaster?" where the map has no word for the one: that is said, and the other looked for.
    pub(super) fn without_unknown(
        &self,
        text: &str,
        language: Language,
        memory: &Memory,
        doubt: &Doubt,
    ) -> Option<Answer> {
        let Doubt::Unknown { reference, .. } = doubt else { return None };
        let (rest, either) = several::without(text, reference)?;
        if !self.is_joined(text, reference) {
            return None;
        }
        let answer = self.answer(&rest, language, memory).ok()?;
        // Of two that are joined by "and" both are asked after, and of a comparison both are needed.
        if either != matches!(answer.said, Said::Yes | Said::No) {
            return None;
        }
        let unknown = Doubt::Unknown { reference: reference.clone(), near: Vec::new() };
        let unknown = self.knowledge(language, memory).unanswered(unknown).text;
        let text = format!("{unknown} {}", answer.text);
        Some(Answer { text, ..answer })
    }

    /// Whether an unknown name is one of two things that a text joins: "do me a favor and tell me …" joins none.
    fn is_joined(&self, text: &str, unknown: &str) -> bool {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let items = sentence.items();
        let joint = |item: Option<&Item>| matches!(item, Some(Item::Mark(Mark::And | Mark::Or)));
        let names = |item: Option<&Item>| {
            let small = |mark: &Mark| matches!(mark, Mark::The | Mark::A);
            match item {
                Some(Item::Mark(mark)) => small(mark),
                Some(Item::Noun(phrase)) => phrase.person.is_none(),
                Some(item) => matches!(item, Item::Place { .. } | Item::Value(_)),
                None => false,
            }
        };
        // "a favor and check if …": what asks is no second thing.
        let begs = |end: usize| {
            let behind = vocabulary::longest(sentence.keys.get(end + 1..).unwrap_or_default());
            matches!(behind, Some((_, Mark::Filler)))
        };
        let is_it = |item: &Item| match item {
            Item::Unknown(words) => unknown.contains(sentence.said(words)) && !begs(words.end),
            _ => false,
        };
        items.iter().enumerate().any(|(n, item)| {
            let before = |by: usize| n.checked_sub(by).and_then(|n| items.get(n));
            let articles =
                1 + usize::from(matches!(before(1), Some(Item::Mark(Mark::The | Mark::A))));
            is_it(item)
                && (joint(items.get(n + 1)) && names(items.get(n + 2))
                    || joint(before(articles)) && names(before(articles + 1)))
        })
    }
}
