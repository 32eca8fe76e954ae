//! The last question about another place: «А на полу?», «В спальне тоже?», "And to the window?", "Anything made of metal?"

use super::grammar::{Item, Sentence};
use super::mark::Mark;
use super::query::Denial;
use super::{Asker, Claim, Extreme, Head, Memory, Noun, Query, Rel, Restriction};
use crate::sets::set;
use crate::words::{Language, word_keys};

impl Asker<'_> {
    /// «Сколько ламп в гостиной? – … – В спальне?», «Шторы в спальне закрыты? – … – В гостиной тоже?»: the same there.
    pub(super) fn placed_too(&self, text: &str, last: &Query, memory: &Memory) -> Option<Query> {
        if !text.trim_end().ends_with('?') {
            return None;
        }
        let keys = word_keys(text);
        let too = keys.iter().any(|key| set!("TooWord").contains(&key.as_str()));
        let asked = match last {
            Query::Count(_) | Query::Exists { .. } | Query::Find(_) => true,
            Query::Holds { .. } => too,
            _ => false,
        };
        let restrictions = self.bare_place(text, memory).filter(|_| asked)?;
        let noun = Noun { restrictions, ..Noun::default() };
        let another = self.in_another_room(last, &noun);
        another.or_else(|| near_another(last, &noun)).or_else(|| match last {
            Query::Holds { .. } => None,
            _ => self.elsewhere(last.clone(), noun),
        })
    }

    /// A place and no more: «в спальне».
    pub(super) fn bare_place(&self, text: &str, memory: &Memory) -> Option<Vec<Restriction>> {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let place = |item: &Item| match item {
            Item::Place { nouns, .. } => {
                nouns.iter().all(|phrase| phrase.pronoun.is_none() && phrase.person.is_none())
            }
            _ => false,
        };
        if !matches!(&sentence.items()[..], [item] if place(item)) {
            return None;
        }
        Some(self.fragment(&sentence, memory)?.restrictions).filter(|all| !all.is_empty())
    }

    /// «Где бита? – … – Рядом с подушкой?»: whether it is at a place that is named alone.
    pub(super) fn placed_there(&self, text: &str, last: &Query, memory: &Memory) -> Option<Query> {
        let asked = matches!(
            last,
            Query::Where(_) | Query::RoomOf(_) | Query::Anchor { .. } | Query::Holds { .. }
        );
        let only = memory.exchanges.first().filter(|_| asked)?.topic()?;
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let place = |item: &Item| match item {
            Item::Place { nouns, .. } => nouns.iter().all(|phrase| phrase.pronoun.is_none()),
            _ => false,
        };
        // «На чём стоит лампа? А на полу?» asks what is there.
        let goes_on = set!("AndWord").contains(&word_keys(text).first()?.as_str());
        if goes_on
            || !text.trim_end().ends_with('?')
            || !matches!(&sentence.items()[..], [item] if place(item))
        {
            return None;
        }
        let noun = self.fragment(&sentence, memory)?;
        let claims = noun.restrictions.into_iter().map(Claim::Related).collect::<Vec<_>>();
        let subject = Noun::of(vec![only]);
        (!claims.is_empty()).then_some(Query::Holds { subject, claims, denial: Denial::None })
    }

    /// «Что ещё на столе? – … – Кроме карандашей?»: the same without those.
    pub(super) fn but_for(
        &self,
        sentence: &Sentence<'_>,
        last: &Query,
        memory: &Memory,
    ) -> Option<Query> {
        let items = sentence.items();
        let mut rest = items.iter().filter(|item| !matches!(item, Item::Mark(Mark::And)));
        if rest.next() != Some(&Item::Mark(Mark::Except)) {
            return None;
        }
        let mut except = Vec::new();
        for item in rest {
            match item {
                Item::Noun(phrase) if phrase.person.is_none() && phrase.pronoun.is_none() => {
                    except.push(Noun { plural: true, ..phrase.noun.clone() });
                }
                _ => return None,
            }
        }
        let known =
            |noun: &Noun| self.knowledge(sentence.language, memory).find(noun, true).is_ok();
        let mut query = last.clone();
        let (Query::Find(asked) | Query::Count(asked)) = &mut query else { return None };
        if except.is_empty() || !except.iter().all(known) {
            return None;
        }
        // What "else" there was is what was told.
        if !memory.last.is_empty() {
            asked.head = Head { things: Some(memory.last.clone()), ..Head::default() };
            asked.restrictions.clear();
            asked.other = false;
        }
        asked.except.extend(except);
        Some(query)
    }

    /// "What is on the counter? – … – Anything made of metal?": of what is there.
    pub(super) fn anything_such(&self, text: &str, last: &Query, memory: &Memory) -> Option<Query> {
        let plain = self.plain(text);
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        let small = |item: &Item| {
            matches!(
                item,
                Item::Mark(Mark::Anything | Mark::MadeOf | Mark::And | Mark::Filler)
                    | Item::Value(_)
                    | Item::Property(_)
            )
        };
        let asked = last.sought().filter(|noun| noun.head.anything)?;
        let terse = items.contains(&Item::Mark(Mark::Anything)) && items.iter().all(small);
        let read = self.read(text, memory).ok().filter(|_| terse)?;
        let filters = read.sought().map(|noun| noun.filters.clone())?;
        if filters.is_empty() || asked.restrictions.is_empty() {
            return None;
        }
        let what = vec![Noun { filters, other: false, ..asked.clone() }];
        Some(Query::Exists { what, either: false, denial: Denial::None })
    }

    /// «Какая площадь у кухни? А у ванной?», "And of the bathroom?": the same of another room or thing.
    pub(super) fn of_another_owner(&self, last: &Query, noun: &Noun) -> Option<Query> {
        let (Query::Size { of, .. } | Query::Property { of, .. }) = last else { return None };
        let [place] = &noun.restrictions[..] else { return None };
        let [owner] = &place.anchors[..] else { return None };
        let bare = noun.head == Head::default() && noun.filters.is_empty() && noun.best.is_none();
        let owns = matches!(place.rel, Rel::Of | Rel::NextTo | Rel::At) && !place.negated;
        (bare && owns && of.restrictions.is_empty()).then(|| last.clone().of_another(owner))
    }

    /// «Есть что поесть на кухне? А попить?», "And to drink?": the same with another activity.
    pub(super) fn another_activity(
        &self,
        sentence: &Sentence<'_>,
        last: &Query,
        memory: &Memory,
    ) -> Option<Query> {
        let Query::Serving { of: before, asked, .. } = last else { return None };
        let items = sentence.items();
        let mut rest = items
            .iter()
            .skip_while(|item| matches!(item, Item::Mark(Mark::And) | Item::Link(Rel::To)));
        let (Some(Item::Mark(Mark::Activity(_))), None) = (rest.next(), rest.next()) else {
            return None;
        };
        let activity = sentence.text.trim_end_matches(['?', '.', ' ']);
        let first = sentence.keys.iter().position(|key| !set!("AndTo").contains(&&**key))?;
        let activity = &activity[sentence.words.get(first)?.start..];
        let lead = sentence.language.pick("Что можно", "What can I");
        let Ok(Query::Serving { sort, of, .. }) = self.read(&format!("{lead} {activity}?"), memory)
        else {
            return None;
        };
        let of = Noun { restrictions: before.restrictions.clone(), ..of };
        Some(Query::Serving { sort, of, asked: *asked })
    }

    /// «Что на столе в гостиной? А в спальне?»: on the table there, where only the table's room was told.
    pub(super) fn in_another_room(&self, last: &Query, noun: &Noun) -> Option<Query> {
        let [there] = &noun.restrictions[..] else { return None };
        let is_bare =
            noun.head == Head::default() && noun.filters.is_empty() && noun.best.is_none();
        let within = |r: &Restriction, are: &dyn Fn(&Noun) -> bool| {
            matches!(r.rel, Rel::In | Rel::On) && !r.negated && r.anchors.iter().all(are)
        };
        let is_room = |noun: &Noun| self.is_room(noun);
        let is_storey = |noun: &Noun| noun.is_storey(&self.mind.lexicon);
        let goes_up = within(there, &is_storey);
        if !is_bare || !within(there, &is_room) && !goes_up {
            return None;
        }
        let mut query = last.clone();
        // "How many doors has the first floor? And upstairs?": another storey takes the place of a storey.
        let mut of_storey = false;
        query.each_noun(&mut |old| {
            let of_room = old.restrictions.iter().any(|r| within(r, &is_room));
            // A room is on its own storey.
            if of_room && !goes_up {
                old.restrictions.retain(|r| !within(r, &is_storey));
            }
            of_storey |= old.restrictions.iter().any(|r| within(r, &is_storey));
        });
        let within = |r: &Restriction| match goes_up && of_storey {
            true => within(r, &is_storey),
            false => within(r, &is_room) || of_storey && within(r, &is_storey),
        };
        // The room may narrow the table as well as what is on it.
        let mut replaced: Option<Vec<Noun>> = None;
        query.each_noun(&mut |old| {
            for room in old.restrictions.iter_mut().filter(|r| within(r)) {
                if replaced.as_ref().is_none_or(|first| *first == room.anchors) {
                    replaced.get_or_insert_with(|| room.anchors.clone());
                    room.clone_from(there);
                }
            }
        });
        replaced.map(|_| query)
    }

    /// "Which rooms does the bedroom connect to? And the kitchen?": rooms are asked for by another, and that is no answer itself.
    pub(super) fn around_another(&self, last: &Query, room: &Noun) -> Option<Query> {
        let mut query = last.clone();
        let (Query::Find(rooms) | Query::Count(rooms)) = &mut query else { return None };
        let any = self.is_room(rooms) && rooms.head.named.is_empty() && rooms.best.is_none();
        let [place] = &mut rooms.restrictions[..] else { return None };
        let [by] = &place.anchors[..] else { return None };
        let is_one = !room.head.named.is_empty() && room.restrictions.is_empty();
        if !any || !is_one || !self.is_room(by) {
            return None;
        }
        place.anchors = vec![room.clone()];
        Some(query)
    }

    /// «Где они? А в гостиной?»: where others of the kind are, there.
    pub(super) fn of_their_kind(&self, told: &Noun, places: Vec<Restriction>) -> Option<Query> {
        let things = told.head.things.as_deref().filter(|_| !places.is_empty())?;
        let kind = self.knowledge(Language::English, &Memory::default()).alike(things)?;
        let head = Head { kinds: vec![kind], ..Head::default() };
        Some(Query::Where(Noun { head, restrictions: places, plural: true, ..Noun::default() }))
    }

    /// «А на полу?», «А красные?»: the last question about another place, or with other properties.
    pub(super) fn elsewhere(&self, mut query: Query, noun: Noun) -> Option<Query> {
        // «Горит ли лампа в спальне? А на столе?»: the lamp there.
        if let Query::Holds { subject, claims, .. } = &mut query
            && !noun.restrictions.is_empty()
            && noun.filters.is_empty()
            && claims.iter().all(|claim| matches!(claim, Claim::Value(_)))
            && self.has_kind(subject)
        {
            subject.restrictions = noun.restrictions;
            return Some(query);
        }
        let asks_where = matches!(query, Query::Where(_));
        let asked = match &mut query {
            Query::Find(asked)
            | Query::Count(asked)
            | Query::Where(asked)
            | Query::Serving { of: asked, .. } => asked,
            Query::Exists { what, .. } => what.first_mut()?,
            Query::Place { within, .. } if !noun.restrictions.is_empty() => {
                *within = noun.restrictions;
                return Some(query);
            }
            // «Книга на столе? А на полу?»
            // «Ноутбук включён? А открыт?»
            Query::Holds { claims, denial, .. } if !noun.filters.is_empty() => {
                *claims = noun.filters.into_iter().map(Claim::Value).collect();
                *denial = Denial::None;
                return Some(query);
            }
            Query::Choice { subject, .. } if !noun.filters.is_empty() => {
                let claims = noun.filters.into_iter().map(Claim::Value).collect();
                return Some(Query::Holds {
                    subject: subject.clone(),
                    claims,
                    denial: Denial::None,
                });
            }
            Query::Holds { claims, .. } if !noun.restrictions.is_empty() => {
                *claims = noun.restrictions.into_iter().map(Claim::Related).collect();
                return Some(query);
            }
            // "What colour is it? And in the living room?": of what there, is not said.
            Query::Property { .. } | Query::Size { .. }
                if noun.restrictions.iter().any(|r| r.anchors.iter().any(|a| self.is_room(a))) =>
            {
                return None;
            }
            // «На чём стоит лампа? А на полу?» asks what is there.
            _ if !noun.restrictions.is_empty() => {
                let head = Head { anything: true, ..Head::default() };
                return Some(Query::Find(Noun { head, plural: true, ..noun }));
            }
            // "Which room has the biggest area? And the smallest?"
            _ if noun.best.is_some() => {
                let mut replaced = false;
                query.each_noun(&mut |old| {
                    if old.best.is_some() && !replaced {
                        (old.best, old.rank) = (noun.best.clone(), noun.rank);
                        replaced = true;
                    }
                });
                return replaced.then_some(query);
            }
            _ => return None,
        };
        // "Which rooms have chairs? How many? And upstairs?": those that were told are nowhere else.
        let told = asked.head.things.is_some() && asked.restrictions.is_empty();
        if told && asks_where && asked.plural {
            return self.of_their_kind(asked, noun.restrictions);
        }
        if told && noun.restrictions.iter().any(|r| r.anchors.iter().any(|a| self.is_room(a))) {
            return None;
        }
        // "Where is the nearest chair? And the farthest?", «Сколько комнат? Какая самая большая?»
        if noun.best.is_some() {
            if !noun.restrictions.is_empty() {
                asked.restrictions = noun.restrictions;
            }
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
            let is_part =
                |anchor: &Noun| self.is_room(anchor) || anchor.is_storey(&self.mind.lexicon);
            let names_room = noun.restrictions.iter().any(|r| r.anchors.iter().any(is_part));
            let room =
                asked.restrictions.iter().find(|r| r.anchors.iter().any(|a| self.is_room(a)));
            // "And on the other side table?" may be in another room.
            let other = noun.restrictions.iter().any(|r| r.anchors.iter().any(|a| a.other));
            let room = room.filter(|_| !names_room && !other).cloned();
            asked.restrictions = noun.restrictions;
            asked.restrictions.extend(room);
        } else {
            asked.filters = noun.filters;
        }
        Some(query)
    }
}

/// "Which chair is nearest to the fridge? And to the window?": the same, by that.
pub(super) fn near_another(last: &Query, noun: &Noun) -> Option<Query> {
    let [place] = &noun.restrictions[..] else { return None };
    let [anchor] = &place.anchors[..] else { return None };
    let bare = noun.head == Head::default() && noun.filters.is_empty() && noun.best.is_none();
    if !bare || place.negated || !matches!(place.rel, Rel::To | Rel::From) {
        return None;
    }
    let mut query = last.clone();
    if let Query::WhichMore { to: Some(to), .. } = &mut query {
        to.clone_from(anchor);
        return Some(query);
    }
    let mut replaced = false;
    query.each_noun(&mut |old| {
        if let Some(best) = &mut old.best
            && matches!(best.extreme, Extreme::Nearest | Extreme::Farthest)
            && let Some(near) = &mut best.anchor
            && !std::mem::replace(&mut replaced, true)
        {
            **near = anchor.clone();
        }
    });
    replaced.then_some(query)
}

/// A question about one thing, put of another of its kind that is elsewhere.
pub(super) fn another_placed(last: &Query, noun: &Noun) -> Option<Query> {
    let mut query = last.clone();
    let mut placed = false;
    // "What is on the table in the kitchen? And the one in the hall?": on the table there, and no more in the kitchen.
    if let Query::Find(sought) = &mut query
        && sought.head.anything
        && let Some(Restriction { anchors, negated: false, .. }) = sought.restrictions.first_mut()
        && let [anchor] = &mut anchors[..]
        && anchor.head.things.is_none()
        && !anchor.head.kinds.is_empty()
        && !noun.restrictions.is_empty()
    {
        anchor.head.named.clear();
        anchor.restrictions.clone_from(&noun.restrictions);
        anchor.filters.clone_from(&noun.filters);
        sought.restrictions.truncate(1);
        return Some(query);
    }
    query.first_noun(|old| {
        if !old.head.anything && old.head.things.is_none() {
            if !noun.restrictions.is_empty() {
                old.restrictions.clone_from(&noun.restrictions);
            }
            // "Where is the red book? And the blue one?"
            if !noun.filters.is_empty() {
                old.filters.clone_from(&noun.filters);
            }
            if !old.head.kinds.is_empty() {
                old.head.named.clear();
            }
            placed = true;
        }
    });
    placed.then_some(query)
}
