//! A side and no thing: «А что внутри?», "What's inside that?", "What else is on top?" of what was spoken of last.
//!
//! Invariant: it means what the last exchange was about, or of what else that named the things that may have something on
//! that side; of several it is asked back.

use super::grammar::{Item, Sentence};
use super::mark::Mark;
use super::{Asker, Head, Memory, Noun, Query, Rel, Restriction, Thing};

impl Asker<'_> {
    pub(super) fn on_a_side(&self, text: &str, memory: &Memory) -> Option<Query> {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let points = sentence.points();
        let (mut side, mut asks, mut other) = (None, false, false);
        for item in sentence.items() {
            match item {
                Item::Link(rel) if has_things(rel) && side.is_none() => side = Some(rel),
                Item::Mark(Mark::What | Mark::And) => asks = true,
                Item::Mark(Mark::Other) => other = true,
                Item::Mark(Mark::Be | Mark::Exists | Mark::Filler) => {}
                Item::Mark(Mark::The) if points => {}
                _ => return None,
            }
        }
        let rel = side.filter(|_| asks && !memory.is_lost)?;
        let exchange = memory.exchanges.first()?;
        let knowledge = self.knowledge(sentence.language, memory);
        let fits = |t: &Thing| t.replica().is_some() && knowledge.may_be_anchor(rel, *t);
        let meant: Vec<Thing> = match exchange.topic().filter(fits) {
            Some(topic) => vec![topic],
            None => exchange.things().copied().filter(fits).collect(),
        };
        if meant.is_empty() {
            return None;
        }
        let it = sentence.language.pick("нём", "it");
        let anchor = Noun { text: it.to_owned(), ..Noun::of(meant) };
        let restrictions = vec![Restriction { rel, anchors: vec![anchor], negated: false }];
        let head = Head { anything: true, ..Head::default() };
        Some(Query::Find(Noun { head, other, plural: true, restrictions, ..Noun::default() }))
    }
}

/// Whether a relation tells on which side of a thing something is.
fn has_things(rel: Rel) -> bool {
    matches!(rel, Rel::In | Rel::On | Rel::Under | Rel::Above | Rel::Behind | Rel::InFrontOf)
}
