//! Two claims that «и», «а» or "and" joins, each of a thing of its own: «Плита выключена, а радио включено?», "Is there an apple
//! in the kitchen and a book on the sofa?" And one of two places: "Is there a mug in the kitchen and in the bedroom?"
//!
//! **Invariant**: a claim has its own thing, and its own place or value; what shares one of them is one claim.

use super::super::grammar::{Item, Sentence};
use super::super::lexicon::Lexicon;
use super::super::mark::Mark;
use super::super::query::Query;
use super::{Frame, Referent};

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
    if items.iter().any(asks) {
        return None;
    }
    let joint = items.iter().position(|item| *item == Item::Mark(Mark::And))?;
    let (one, other) = (&items[..joint], &items[joint + 1..]);
    let things = |claim: &[Item]| claim.iter().filter(|item| matches!(item, Item::Noun(_))).count();
    let is_whole = |claim: &[Item]| {
        let told = |item: &Item| matches!(item, Item::Place { .. } | Item::Value(_));
        things(claim) == 1 && claim.iter().any(told) && !claim.contains(&Item::Mark(Mark::And))
    };
    let other: Vec<Item> = match (one, other) {
        ([rest @ .., Item::Place { .. }], [Item::Place { .. }]) if things(rest) == 1 => {
            rest.iter().chain(other).cloned().collect()
        }
        _ if is_whole(one) && is_whole(other) => {
            // "Is there an apple here and a book there": what asks is said once.
            let asking = |item: &&Item| matches!(item, Item::Mark(Mark::Exists | Mark::Be));
            one.iter().filter(asking).chain(other).cloned().collect()
        }
        _ => return None,
    };
    let read = |claim: &[Item]| {
        let frame = Frame::of(sentence, lexicon, claim, referent).ok()?;
        let mut query = frame.read()?;
        let is_claim = matches!(query, Query::Holds { .. } | Query::Exists { .. });
        (is_claim && !frame.asks_more_than(&mut query)).then_some(query)
    };
    Some(Query::Several(vec![read(one)?, read(&other)?]))
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
            Item::Noun(phrase) if goes_on => {
                let start = phrase.words.start;
                let is_later = all.iter().any(|item| matches!(item, Item::Noun(_)));
                // «а» stands between the comma and the noun.
                let anew = sentence.comma_between(start, start)
                    || start > 1 && sentence.comma_between(start - 1, start - 1);
                if is_later && anew && all.last() != Some(&Item::Mark(Mark::And)) {
                    all.push(Item::Mark(Mark::And));
                }
            }
            _ => {}
        }
        all.push(item.clone());
    }
    all
}
