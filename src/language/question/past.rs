//! Questions in the past tense: «Где он был?», "What was on the table?"
//!
//! Invariant: where something of a question was moved since, how it is now is not told as how it was.

use super::mark::Mark;
use super::vocabulary::longest;
use super::{Answer, Asker, Doubt, Memory, News, Query, Thing};
use crate::map::Entity;
use crate::sets::set;
use crate::words::{Language, word_keys};

impl Asker<'_> {
    /// A question where something was, of what was moved since, as one of its former place.
    pub(super) fn as_it_was(&self, query: &mut Query, text: &str, memory: &Memory) {
        let (Query::Where(noun) | Query::RoomOf(noun)) = &*query else { return };
        if !is_past(text) {
            return;
        }
        let found = self.knowledge(Language::of(text), memory).find(noun, true);
        let moved = |thing: &Thing| {
            thing.replica().is_some_and(|thing| !self.senses.past(thing).is_empty())
        };
        if let Ok([only]) = found.as_deref()
            && moved(only)
        {
            *query = Query::Before(noun.clone());
        }
    }

    /// Why how it is now does not tell how it was: what the question names or found, or was where it asks, has been moved.
    pub(super) fn is_otherwise_now(
        &self,
        answer: &Answer,
        text: &str,
        memory: &Memory,
    ) -> Option<Doubt> {
        if matches!(answer.query, Query::Before(_) | Query::LastSeen(_)) || !is_past(text) {
            return None;
        }
        let knowledge = self.knowledge(answer.language, memory);
        let mut named: Vec<Thing> = answer.things.clone();
        answer.query.clone().each_noun(&mut |noun| {
            named.extend(knowledge.find(noun, true).unwrap_or_default());
        });
        let was_there = |thing: Thing| {
            let past = thing.replica().map(|id| self.senses.past(id)).unwrap_or_default();
            past.iter().any(|past| {
                let support = past.support.map(Entity::Replica);
                let places = [support, past.area.map(Entity::Area)].into_iter().flatten();
                places.map(Thing::Entity).any(|place| named.contains(&place))
            })
        };
        let news = self.senses.changed();
        let moved = news.iter().filter_map(|news| match news {
            News::Moved(id, _) | News::Missed(id) | News::Taken(id) => {
                Some(Thing::Entity(Entity::Replica(*id)))
            }
            _ => None,
        });
        let moved: Vec<Thing> =
            moved.filter(|thing| named.contains(thing) || was_there(*thing)).collect();
        (!moved.is_empty()).then_some(Doubt::Past { moved })
    }
}

/// Whether a text tells of what was: «лежал», "was". What was asked and is asked "again" is so now.
fn is_past(text: &str) -> bool {
    let keys = word_keys(text);
    let mut at = 0;
    while at < keys.len() {
        let (taken, mark) = longest(&keys[at..]).unwrap_or((1, Mark::Filler));
        let said = &keys[at..at + taken];
        if matches!(mark, Mark::Be | Mark::Hang | Mark::Exists)
            && said.iter().any(|key| tells_what_was(key))
        {
            return true;
        }
        at += taken;
    }
    false
}

/// Whether a form of a word for being tells of the past: in Russian by its ending.
fn tells_what_was(key: &str) -> bool {
    let active = key.strip_suffix("ся").or(key.strip_suffix("сь")).unwrap_or(key);
    set!("Was").contains(&key)
        || active.chars().count() > 2
            && ["л", "ла", "ло", "ли"].iter().any(|end| active.ends_with(end))
}
