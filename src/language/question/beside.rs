//! A side and no thing: «А что внутри?», "What's inside that?", "What else is on top?" of what was spoken of last.
//!
//! Invariant: it means what the last exchange was about, or of what else that named the things that may have something on
//! that side; of several it is asked back.

use super::grammar::{Item, Sentence};
use super::mark::Mark;
use super::{Asker, Head, Memory, Noun, Query, Rel, Restriction, Thing, vocabulary};

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
        let keys = &sentence.keys;
        let anew = (0..keys.len()).any(|n| vocabulary::taken_by(Mark::Now, &keys[n..]).is_some());
        let rel = side.filter(|_| asks && !memory.is_lost)?;
        let exchange = memory.exchanges.first()?;
        let knowledge = self.knowledge(sentence.language, memory);
        let fits = |t: &Thing| t.replica().is_some() && knowledge.may_be_anchor(rel, *t);
        // "What is in the fridge? And in the box? What's inside now?": in the box once more, and not in what was found before.
        let sought = memory.query.as_ref().and_then(Query::sought);
        let before = sought.and_then(|noun| match &noun.restrictions[..] {
            [place] if place.rel == rel && !place.negated => place.anchors.first(),
            _ => None,
        });
        let before =
            before.and_then(|anchor| knowledge.find(anchor, true).ok()).unwrap_or_default();
        let topic = exchange.topic().filter(fits);
        let meant: Vec<Thing> = match topic {
            _ if !before.is_empty() && (memory.last.is_empty() || anew) => before,
            Some(topic) if before.contains(&topic) => vec![topic],
            Some(topic) => before.into_iter().chain([topic]).collect(),
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
