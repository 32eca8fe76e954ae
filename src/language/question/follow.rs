//! Going on from the question before: «А чайник?», "And the other one?", «Красная» where it was asked back which.

use super::grammar::{Item, Sentence};
use super::mark::{Mark, Pronoun};
use super::{Asker, Claim, Extension, Head, Memory, Noun, Query, Thing, assemble};
use crate::language::words::word_keys;
use crate::map::Entity;

impl Asker<'_> {
    /// «А чайник?» after a question about something else: the same question about the kettle.
    pub(super) fn continued(&self, text: &str, memory: &Memory) -> Option<Query> {
        let waiting = memory.pending.as_ref().map(|pending| &pending.query);
        let last = waiting.or(memory.query.as_ref())?;
        let key = crate::units::name_key(text);
        let begins = ["а ", "и ", "and ", "what about ", "how about ", "а как же "];
        let of_those = self.asks_of_those(text);
        if !begins.iter().any(|b| key.starts_with(b)) && !of_those {
            return None;
        }
        if let Some(query) = self.another_asked(&key, last, memory) {
            return Some(query);
        }
        let text = &self.plain(text);
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let knowledge = self.knowledge(sentence.language, memory);
        let referent = |pronoun: Pronoun| knowledge.referent(pronoun);
        let noun = assemble::fragment(&sentence, &self.mind.lexicon, &referent)?;
        let mut query = last.clone();
        if noun.head == Head::default() {
            return Some(match self.elsewhere(query, noun)? {
                Query::Count(noun) if of_those => Query::Find(noun),
                query => query,
            });
        }
        // «Сколько стульев в кухне? А спальня?»: a room takes the place of a room.
        let is_room = self.is_room(&noun);
        let mut rooms = false;
        query.each_noun(&mut |old| rooms |= self.is_room(old));
        // A room may narrow several nouns of the question: all that mean what is replaced.
        let mut replaced: Option<Noun> = None;
        query.each_noun(&mut |old| {
            let fits = match &replaced {
                Some(first) => is_room && rooms && old == first,
                None => !(is_room && rooms) || self.is_room(old),
            };
            if fits {
                replaced.get_or_insert_with(|| old.clone());
                *old = Noun { plural: noun.plural || old.plural, ..noun.clone() };
            }
        });
        replaced.map(|_| query)
    }

    /// «Какая самая маленькая?», "Which is the biggest?", "Which are open?": a superlative or a value, and no noun.
    fn asks_of_those(&self, text: &str) -> bool {
        let text = self.plain(text);
        // "Which is" alone is a small word, as in "the book which is on the table".
        let which = word_keys(&text).first().is_some_and(|word| word == "which");
        let items = Sentence::new(&text, &self.mind.lexicon).items();
        let small = |item: &Item| match item {
            Item::Mark(mark) => matches!(
                mark,
                Mark::Which | Mark::What | Mark::Be | Mark::The | Mark::Best(_) | Mark::One
            ),
            Item::Noun(phrase) => phrase.noun.head.anything && phrase.noun.best.is_some(),
            Item::Value(_) => true,
            _ => false,
        };
        let asks = matches!(items.first(), Some(Item::Mark(Mark::Which)));
        let least = if asks { 2 } else { 1 };
        (asks || which) && items.len() >= least && items.iter().all(small)
    }

    /// «А где вторая?», "And the other one?": the last question about what else there is of that kind.
    fn another_asked(&self, key: &str, last: &Query, memory: &Memory) -> Option<Query> {
        const SMALL: [&str; 11] =
            ["а", "и", "and", "what", "about", "how", "the", "one", "is", "ones", "же"];
        const OTHER: [&str; 14] = [
            "другая",
            "другой",
            "другое",
            "другие",
            "вторая",
            "второй",
            "второе",
            "остальные",
            "other",
            "others",
            "second",
            "rest",
            "another",
            "остальное",
        ];
        let words: Vec<&str> = key
            .split(|c: char| !c.is_alphanumeric())
            .filter(|word| !word.is_empty() && !SMALL.contains(word))
            .collect();
        let asks_where = words.iter().any(|word| ["где", "where"].contains(word));
        let rest: Vec<&&str> = words.iter().filter(|w| !["где", "where"].contains(w)).collect();
        let [only] = rest[..] else { return None };
        if !OTHER.contains(only) {
            return None;
        }
        let spoken = memory.spoken.iter().find_map(|t| t.replica())?;
        let object = self.world.objects.get(&self.world.replicas.get(&spoken)?.object)?;
        let kind = self.mind.lexicon.kind_of(&Extension::ObjectType(object.object_type?))?;
        let head = Head { kinds: vec![kind], ..Head::default() };
        let noun = Noun { head, plural: true, other: true, ..Noun::default() };
        if asks_where {
            return Some(Query::Where(noun));
        }
        let mut query = last.clone();
        let mut first = true;
        query.each_noun(&mut |old| {
            if std::mem::take(&mut first) {
                *old = noun.clone();
            }
        });
        Some(query)
    }

    /// «А на полу?», «А красные?»: the last question about another place, or with other properties.
    fn elsewhere(&self, mut query: Query, noun: Noun) -> Option<Query> {
        let asked = match &mut query {
            Query::Find(asked) | Query::Count(asked) | Query::Where(asked) => asked,
            Query::Exists { what, .. } => what.first_mut()?,
            Query::Place { within, .. } if !noun.restrictions.is_empty() => {
                *within = noun.restrictions;
                return Some(query);
            }
            // «Книга на столе? А на полу?»
            Query::Holds { claims, .. } if !noun.restrictions.is_empty() => {
                *claims = noun.restrictions.into_iter().map(Claim::Related).collect();
                return Some(query);
            }
            // «На чём стоит лампа? А на полу?» asks what is there.
            _ if !noun.restrictions.is_empty() => {
                let head = Head { anything: true, ..Head::default() };
                return Some(Query::Find(Noun { head, plural: true, ..noun }));
            }
            _ => return None,
        };
        // "Where is the nearest chair? And the farthest?", «Сколько комнат? Какая самая большая?»
        if noun.best.is_some() {
            asked.best = noun.best;
            asked.rank = noun.rank;
            asked.plural = false;
            asked.count = None;
            asked.indefinite = true;
            let asked = asked.clone();
            return Some(match query {
                Query::Where(_) => Query::Where(asked),
                _ => Query::Find(asked),
            });
        }
        if noun.restrictions.is_empty() && noun.filters.is_empty() {
            return None;
        }
        if !noun.restrictions.is_empty() {
            // «Что на столе в кухне? А на полу?» stays in the kitchen.
            let names_room =
                noun.restrictions.iter().any(|r| r.anchors.iter().any(|a| self.is_room(a)));
            let room =
                asked.restrictions.iter().find(|r| r.anchors.iter().any(|a| self.is_room(a)));
            let room = room.filter(|_| !names_room).cloned();
            asked.restrictions = noun.restrictions;
            asked.restrictions.extend(room);
        } else {
            asked.filters = noun.filters;
        }
        Some(query)
    }

    fn is_room(&self, noun: &Noun) -> bool {
        let named = |e: &Entity| matches!(e, Entity::Area(_));
        (!noun.head.named.is_empty() && noun.head.named.iter().all(named))
            || noun.head.kinds.iter().any(|k| self.mind.lexicon.is_area(*k))
    }

    /// «Красная» after «Какая чашка – белая или красная?»: the question that waited, with the thing that is meant.
    pub(super) fn clarified(&self, text: &str, memory: &Memory) -> Option<Query> {
        let pending = memory.pending.as_ref()?;
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let noun = assemble::fragment(&sentence, &self.mind.lexicon, &|_| Vec::new())?;
        let knowledge = self.knowledge(pending.language, memory);
        let mut noun = noun;
        let bare = noun.head.named.is_empty() && noun.head.kinds.is_empty();
        if bare {
            noun.head.things = Some(pending.candidates.clone());
        }
        noun.plural = true;
        let found = knowledge.find(&noun, true).ok()?;
        let meant: Vec<Thing> =
            found.into_iter().filter(|t| pending.candidates.contains(t)).collect();
        let [only] = meant[..] else { return None };
        let mut query = pending.query.clone();
        query.each_noun(&mut |noun| {
            if noun.text == pending.reference {
                noun.head = Head { things: Some(vec![only]), ..Head::default() };
                noun.filters.clear();
                noun.restrictions.clear();
                noun.best = None;
            }
        });
        Some(query)
    }
}
