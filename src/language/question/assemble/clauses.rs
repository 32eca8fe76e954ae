//! Two claims that «и», «а» or "and" joins, each of a thing of its own: «Плита выключена, а радио включено?», "Is there an apple
//! in the kitchen and a book on the sofa?" And one of two places: "Is there a mug in the kitchen and in the bedroom?"
//!
//! **Invariant**: a claim has its own thing, and its own place or value; what shares one of them is one claim.

use super::super::grammar::{Item, Phrase, Sentence};
use super::super::lexicon::Lexicon;
use super::super::mark::Mark;
use super::super::query::Query;
use super::{Frame, Referent};
use crate::sets::Set;

/// The claims of a sentence that has two.
pub(super) fn clauses_of(
    sentence: &Sentence<'_>,
    lexicon: &Lexicon,
    items: &[Item],
    whole: &Frame<'_, '_>,
    referent: &Referent<'_>,
) -> Option<Query> {
    let items = &parted(sentence, items, whole)[..];
    let asks = |item: &Item| {
        let Item::Mark(mark) = item else { return false };
        !matches!(mark, Mark::Exists | Mark::Be | Mark::A | Mark::The | Mark::And)
    };
    let claims = match items.iter().any(asks) {
        true => with_one_verb(items, whole),
        false => in_both_places(sentence, items).or_else(|| of_two_things(items)),
    };
    let (one, other) = claims?;
    let read = |claim: &[Item]| {
        let frame = Frame::of(sentence, lexicon, claim, referent).ok()?;
        let mut query = frame.read()?;
        let is_claim = matches!(query, Query::Holds { .. } | Query::Exists { .. });
        (is_claim && !frame.asks_more_than(&mut query)).then_some(query)
    };
    Some(Query::Several(vec![read(&one)?, read(&other)?]))
}

fn things(claim: &[Item]) -> usize {
    claim.iter().filter(|item| matches!(item, Item::Noun(_))).count()
}

/// The items of each of two claims that a word joins.
fn of_two_things(items: &[Item]) -> Option<(Vec<Item>, Vec<Item>)> {
    let joint = items.iter().position(|item| *item == Item::Mark(Mark::And))?;
    let (one, other) = (&items[..joint], &items[joint + 1..]);
    let is_whole = |claim: &[Item]| {
        let told = |item: &Item| matches!(item, Item::Place { .. } | Item::Value(_));
        things(claim) == 1 && claim.iter().any(told) && !claim.contains(&Item::Mark(Mark::And))
    };
    // "Is there an apple here and a book there": what asks is said once.
    let asking = |item: &&Item| matches!(item, Item::Mark(Mark::Exists | Mark::Be));
    (is_whole(one) && is_whole(other))
        .then(|| (one.to_vec(), one.iter().filter(asking).chain(other).cloned().collect()))
}

/// The same of one thing in two places, each with its own preposition.
fn in_both_places(sentence: &Sentence<'_>, items: &[Item]) -> Option<(Vec<Item>, Vec<Item>)> {
    static BETWEEN: Set = Set::named("BetweenClauses");
    let at = items.iter().position(|item| matches!(item, Item::Place { .. }))?;
    let Item::Place { rel, nouns, either: false } = &items[at] else { return None };
    let [one, other] = &nouns[..] else { return None };
    let between = sentence.keys.get(one.words.end..other.words.start)?;
    let again = between.iter().any(|key| !BETWEEN.contains(&key.as_str()));
    let rest = items.iter().enumerate().filter(|(n, _)| *n != at);
    let is_alone = rest.clone().all(|(_, item)| matches!(item, Item::Noun(_) | Item::Mark(_)));
    let claim = |noun: &Phrase| {
        let mut claim = items.to_vec();
        claim[at] = Item::Place { rel: *rel, nouns: vec![noun.clone()], either: false };
        claim
    };
    (again && is_alone && things(items) == 1).then(|| (claim(one), claim(other)))
}

/// "Does the kitchen have a fridge and the bathroom a toilet?": the verb of the first claim is that of the second as well.
fn with_one_verb(items: &[Item], whole: &Frame<'_, '_>) -> Option<(Vec<Item>, Vec<Item>)> {
    let joint = items.iter().position(|item| *item == Item::Mark(Mark::And))?;
    let (one, other) = (&items[..joint], &items[joint + 1..]);
    let pair = |claim: &[Item]| {
        let nouns = claim.iter().filter(|item| matches!(item, Item::Noun(_)));
        let [owner, had] = <[&Item; 2]>::try_from(nouns.collect::<Vec<_>>()).ok()?;
        let is_room = |item: &Item| matches!(item, Item::Noun(p) if whole.is_area(&p.noun));
        (is_room(owner) && !is_room(had)).then(|| [owner.clone(), had.clone()])
    };
    let small =
        |item: &Item| matches!(item, Item::Noun(_) | Item::Mark(Mark::A | Mark::The | Mark::And));
    let is_had = one.contains(&Item::Mark(Mark::Have)) && other.iter().all(small);
    let mut nouns = pair(other).filter(|_| is_had && pair(one).is_some())?.into_iter();
    let put = |item: &Item| match item {
        Item::Noun(_) => nouns.next().expect("both claims have two nouns"),
        item => item.clone(),
    };
    Some((one.to_vec(), one.iter().map(put).collect()))
}

/// The items with a joint between two claims: "in the kitchen and a toilet in the bathroom" is no place of both, and «…, а радио
/// включено» begins anew behind its comma.
fn parted(sentence: &Sentence<'_>, items: &[Item], whole: &Frame<'_, '_>) -> Vec<Item> {
    let mut all = Vec::new();
    for (at, item) in items.iter().enumerate() {
        let goes_on = matches!(items.get(at + 1), Some(Item::Place { .. } | Item::Value(_)));
        match item {
            Item::Place { rel, nouns, either: false }
                if goes_on
                    && let [room, thing] = &nouns[..]
                    && whole.is_area(&room.noun)
                    && !whole.is_area(&thing.noun) =>
            {
                all.push(Item::Place { rel: *rel, nouns: vec![room.clone()], either: false });
                all.extend([Item::Mark(Mark::And), Item::Noun(thing.clone())]);
                continue;
            }
            Item::Noun(phrase) if goes_on && begins_anew(sentence, &all, phrase.words.start, 1) => {
                all.push(Item::Mark(Mark::And));
            }
            // «Есть ли в спальне кровать, а на кухне холодильник?»: the preposition stands before the room.
            Item::Place { nouns, .. }
                if matches!(items.get(at + 1), Some(Item::Noun(_)))
                    && begins_anew(sentence, &all, nouns[0].words.start, 2) =>
            {
                all.push(Item::Mark(Mark::And));
            }
            _ => {}
        }
        all.push(item.clone());
    }
    all
}

/// Whether a claim begins behind another one with a comma, and at most so many words between it and what it names first: «а».
fn begins_anew(sentence: &Sentence<'_>, before: &[Item], start: usize, words: usize) -> bool {
    let is_later = before.iter().any(|item| matches!(item, Item::Noun(_)));
    let from = start.saturating_sub(words).max(1);
    is_later
        && before.last() != Some(&Item::Mark(Mark::And))
        && (from..=start).any(|n| sentence.comma_between(n, n))
}
