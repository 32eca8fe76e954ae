//! Questions of a word or two, whose rest is the question before: "Which room?", «На сколько?», «А где чёрная?»

use super::grammar::{Item, Sentence};
use super::mark::Mark;
use super::{
    Best, Claim, Closeness, Extreme, Filter, Head, Memory, Noun, Query, Restriction, Thing,
};
use crate::sets::{Set, set};
use crate::words::word_keys;

/// «Какие книги в гостиной? А где чёрная?»: where such a one of what was asked for is.
pub(super) fn where_such(sentence: &Sentence<'_>, last: &Query) -> Option<Query> {
    let (mut filters, mut asks) = (Vec::new(), false);
    for item in sentence.items() {
        match item {
            Item::Mark(Mark::Where) => asks = true,
            Item::Mark(Mark::And | Mark::Be | Mark::The) => {}
            Item::Value(value) => filters.push(Filter::new(value, false)),
            _ => return None,
        }
    }
    let sought = last.sought().filter(|noun| asks && !noun.head.kinds.is_empty())?;
    let head = Head { kinds: sought.head.kinds.clone(), ..Head::default() };
    (!filters.is_empty()).then(|| Query::Where(Noun { head, filters, ..Noun::default() }))
}

/// "Is there an apple? – Yes. – Where exactly?": where those are that were told.
pub(super) fn where_alone(sentence: &Sentence<'_>, last: &Query, memory: &Memory) -> Option<Query> {
    let items = sentence.items();
    let asks = items.contains(&Item::Mark(Mark::Where));
    let small =
        |item: &Item| matches!(item, Item::Mark(Mark::Where | Mark::And | Mark::Be | Mark::The));
    let sought = last.sought().filter(|_| asks && items.iter().all(small)).is_some();
    let told = memory.last.iter().all(|thing| thing.replica().is_some());
    (sought && told && !memory.last.is_empty()).then(|| {
        Query::Where(Noun { plural: memory.last.len() > 1, ..Noun::of(memory.last.clone()) })
    })
}

/// «Есть ли в спальне часы? – Да. – Какие?»: those that were asked for.
pub(super) fn which_alone(key: &str, last: &Query) -> Option<Query> {
    static WHICH: Set = Set::named("WhichOnes");
    let asks = WHICH.contains(&key.trim_end_matches(['?', '.', '!', ' ']));
    let sought = last.sought().filter(|noun| asks && !noun.head.anything)?;
    Some(Query::Find(Noun { plural: true, indefinite: true, count: None, ..sought.clone() }))
}

/// "Are all the chairs in the hall? – No, not all. – Which one isn't?": those of which it is not so, or is.
pub(super) fn which_of_all(sentence: &Sentence<'_>, last: &Query) -> Option<Query> {
    let Query::Holds { subject, claims: claimed, .. } = last else { return None };
    let [claim] = &claimed[..] else { return None };
    let mut asks = false;
    for item in sentence.items() {
        match item {
            Item::Mark(Mark::Which) => asks = true,
            Item::Mark(Mark::And | Mark::Be | Mark::The | Mark::One | Mark::Not) => {}
            Item::Noun(phrase) if phrase.noun.head.anything && phrase.noun.best.is_none() => {}
            _ => return None,
        }
    }
    let denied = sentence.keys.iter().any(|key| set!("DeniesWord").contains(&key.as_str()));
    let several = subject.all || subject.plural;
    if !asks || !several || subject.head.anything {
        return None;
    }
    let mut noun = Noun { all: false, plural: true, indefinite: true, ..subject.clone() };
    match claim {
        Claim::Related(place) => {
            noun.restrictions
                .push(Restriction { negated: place.negated != denied, ..place.clone() });
        }
        Claim::Value(filter) => {
            noun.filters.push(Filter { negated: filter.negated != denied, ..filter.clone() });
        }
        Claim::Size(_) | Claim::Kind(_) => return None,
    }
    Some(Query::Find(noun))
}

/// "Which is closer to the door, the bed or the desk? And farther?": the other way round.
pub(super) fn compared_otherwise(sentence: &Sentence<'_>, last: &Query) -> Option<Query> {
    let Query::WhichMore { of, to, .. } = last else { return None };
    let items = sentence.items();
    let told = match &items[..] {
        [Item::Mark(Mark::And), Item::Mark(told)] | [Item::Mark(told)] => *told,
        _ => return None,
    };
    let extreme = match told {
        Mark::More(extreme) if to.is_none() => extreme,
        Mark::Nearer(Closeness::Nearer) if to.is_some() => Extreme::Nearest,
        Mark::Nearer(Closeness::Farther) if to.is_some() => Extreme::Farthest,
        _ => return None,
    };
    Some(Query::WhichMore { of: of.clone(), extreme, to: to.clone() })
}

/// "There's a bag somewhere. Which room?", «Сколько кружек? – Две. – В каких комнатах?»: where the things are that were
/// spoken of.
pub(super) fn room_alone(text: &str, memory: &Memory) -> Option<Query> {
    static ROOMS: Set = Set::named("InWhichRooms");
    static ROOM: Set = Set::named("InWhichRoom");
    let said = word_keys(text).join(" ");
    let told = &memory.last;
    if ROOMS.contains(&said.as_str())
        && !told.is_empty()
        && told.iter().all(|t| t.replica().is_some())
    {
        return Some(Query::RoomOf(Noun { plural: true, ..Noun::of(told.clone()) }));
    }
    let thing = memory.exchanges.first()?.topic().filter(|t| t.replica().is_some())?;
    ROOM.contains(&said.as_str()).then(|| Query::RoomOf(Noun::of(vec![thing])))
}

/// «На сколько?», "By how much?": the difference of what was compared.
pub(super) fn by_how_much(key: &str, last: &Query, told: &[Thing]) -> Option<Query> {
    static BY: Set = Set::named("ByHowMuch");
    let key = key.trim_end_matches(['?', '.', '!', ' ']);
    if !BY.contains(&key) {
        return None;
    }
    let mut query = last.clone();
    match &mut query {
        Query::Larger { by, .. } | Query::MoreOf { by, .. } => *by = true,
        Query::WhichMore { of, extreme, to } => {
            let [what, than] = &of[..] else { return None };
            let (what, than) = (what.clone(), than.clone());
            let (extreme, to) = (*extreme, to.clone());
            return Some(Query::Larger { what, than, extreme, to, by: true });
        }
        // "Which of the two is bigger? By how much?": the one that was told, than the other.
        Query::Find(Noun {
            head: Head { things: Some(pair), .. },
            best: Some(Best { extreme, anchor: None }),
            ..
        }) => {
            let [what] = told else { return None };
            let [than] = pair.iter().filter(|thing| *thing != what).collect::<Vec<_>>()[..] else {
                return None;
            };
            let (what, than) = (Noun::of(vec![*what]), Noun::of(vec![*than]));
            return Some(Query::Larger { what, than, extreme: *extreme, to: None, by: true });
        }
        _ => return None,
    }
    Some(query)
}
