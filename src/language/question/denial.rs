//! What a question denies, and whether what was said is so.
//!
//! Languages answer denials each in its own way: «Телевизор не включён?» – «Да, он выключен», "Isn't the TV on?" – "No, it is
//! off". So the word that an answer begins with does not tell whether what was said is so; an order under a condition
//! asks just that.
//!
//! **Invariant**: where a denial is not accounted for, nothing is told to be so.

use super::grammar::{Item, Sentence};
use super::mark::Mark;
use super::query::{Claim, Denial, Query, Rel};
use super::{Answer, Said, truth as said_to_be};
use crate::sets::{Set, set};
use crate::words::{Language, phrase_at};

/// Of what these deny nothing is left; in Russian «не» and «нет» go with them.
static NOTHING: Set = Set::named("NothingOrNobody");

/// How often a sentence denies.
fn denials(sentence: &Sentence<'_>) -> usize {
    let items = sentence.items();
    let denies = |(at, item): (usize, &Item)| {
        // «комната без окон», «минуя кухню» deny nothing of the question.
        let is_without =
            matches!(items.get(at + 1), Some(Item::Place { rel: Rel::Has | Rel::Through, .. }));
        *item == Item::Mark(Mark::Not) && !is_without
    };
    let denied = items.iter().enumerate().filter(|item| denies(*item)).count();
    let nothing = sentence.keys.iter().filter(|key| NOTHING.contains(&key.as_str())).count();
    match sentence.language {
        Language::Russian => denied.max(usize::from(nothing > 0)),
        Language::English => denied + nothing,
    }
}

/// How often a query denies something of what it is about: «чашка не на столе», "the cup that is not clean".
fn denied_within(query: &Query) -> usize {
    let mut count = 0;
    if let Query::Holds { claims, .. } | Query::Choice { claims, .. } = query {
        let denies = |claim: &&Claim| match claim {
            Claim::Value(filter) => filter.negated,
            Claim::Related(place) => place.negated,
            _ => false,
        };
        count += claims.iter().filter(denies).count();
    }
    query.clone().each_noun(&mut |noun| {
        count += noun.filters.iter().filter(|filter| filter.negated).count();
        count += noun.restrictions.iter().filter(|place| place.negated).count();
        count += noun.sizes.iter().filter(|size| size.negated).count();
    });
    count
}

/// Of what the yes and no of a question are said.
pub(super) fn settle(sentence: &Sentence<'_>, query: &mut Query) {
    let has = |words: &str| {
        (0..sentence.keys.len()).any(|at| phrase_at(&sentence.keys, at, words).is_some())
    };
    let is_english = sentence.language == Language::English;
    // The truth of a denial is asked, and "Is there nothing on it?" denies all the same.
    let is_of_truth = set!("TrueThat").iter().any(|words| has(words));
    let is_idle = is_english && !is_of_truth && !has("nothing");
    let is_unaccounted = denials(sentence) == 1 && denied_within(query) == 0;
    if let Query::Holds { denial, .. } | Query::Exists { denial, .. } = query {
        *denial = match *denial {
            Denial::Taken if is_idle => Denial::Idle,
            Denial::None | Denial::Idle if is_unaccounted && is_of_truth => Denial::Taken,
            Denial::None if is_unaccounted => Denial::Idle,
            told => told,
        };
    }
}

/// Whether what a sentence says is so, by the answer to it.
pub(super) fn truth(sentence: &Sentence<'_>, answer: &Answer) -> Option<bool> {
    let yes = said_to_be(answer.said)?;
    match (&answer.query, denials(sentence)) {
        // How big something is is neither so nor not.
        (Query::Size { .. }, _) => None,
        (Query::Several(_), 0) => answer.so,
        (_, 0) => Some(yes),
        (Query::Holds { denial, .. } | Query::Exists { denial, .. }, 1) => match denial {
            Denial::Taken => Some(yes),
            Denial::Unasked => None,
            Denial::Idle => Some(!yes),
            Denial::None => (denied_within(&answer.query) == 1).then_some(yes),
        },
        // The grammar files read the denial, too.
        (Query::Ran { .. }, 1) if matches!(answer.said, Said::Yes | Said::No) => Some(yes),
        _ => None,
    }
}
