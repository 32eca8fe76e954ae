//! What people do with things, in the words of a question: «чем моют посуду», "where can I wash my hands?"
//!
//! Which things serve is told by the sorts of `purposes`. Invariant: of the sorts of an activity each has another role
//! or other words; an activity that has a sort of things is never told of another sort's.

use std::collections::{BTreeSet, HashMap};
use std::ops::Range;
use std::sync::OnceLock;

use super::purposes;
use crate::sets::{Set, set};
use crate::units::Gather as _;
use crate::words::phrase_at;
use crate::words::things::{Activity, Role, things};
use Role::{Instrument, Location, Patient, Source, Theme};

type Phrases = HashMap<String, Vec<(Vec<String>, u16)>>;

/// The phrases in all forms, by their first words.
fn phrases() -> &'static Phrases {
    static PHRASES: OnceLock<Phrases> = OnceLock::new();
    PHRASES.get_or_init(|| {
        let mut all = Phrases::new();
        for (n, Activity { said, .. }) in things().activities.iter().enumerate() {
            let activity = u16::try_from(n).unwrap_or(u16::MAX);
            for words in said.iter().flat_map(|phrase| in_all_forms(bare(phrase))) {
                all.entry(words[0].clone()).or_default().push((words, activity));
            }
        }
        all
    })
}

/// A phrase without the place of what the activity is done to.
fn bare(phrase: &str) -> &str {
    phrase.trim_end_matches(" …")
}

/// A phrase with each word in all its forms; in Russian what the activity is done to may stand first.
fn in_all_forms(phrase: &str) -> Vec<Vec<String>> {
    let keys = |text: &str| text.split_whitespace().map(crate::units::name_key).collect::<Vec<_>>();
    let forms = |part: &str| things().forms.iter().find(|group| group[0] == part);
    let words: Vec<&str> = phrase.split_whitespace().collect();
    let mut all: Vec<Vec<String>> = vec![Vec::new()];
    let mut at = 0;
    while at < words.len() {
        // "throw away", "listen to" are one verb.
        let taken =
            (1..=words.len() - at).rev().find(|n| forms(&words[at..at + n].join(" ")).is_some());
        let part = words[at..at + taken.unwrap_or(1)].join(" ");
        let own: Vec<Vec<String>> = match forms(&part) {
            None => vec![keys(&part)],
            Some(own) => own.iter().map(|form| keys(form)).collect(),
        };
        all = all
            .iter()
            .flat_map(|head| own.iter().map(move |tail| [head.clone(), tail.clone()].concat()))
            .collect();
        at += taken.unwrap_or(1);
    }
    let inverted = words.len() == 2 && forms(words[0]).is_some() && !phrase.is_ascii();
    if inverted {
        let behind: Vec<Vec<String>> =
            all.iter().map(|two| two.iter().rev().cloned().collect()).collect();
        all.extend(behind);
    }
    all
}

/// The activity that these words, in [`name_key`](crate::units::name_key) form, begin with, and how many they are.
pub(super) fn longest(words: &[String]) -> Option<(usize, u16)> {
    let fitting = phrases()
        .get(words.first()?)?
        .iter()
        .filter_map(|(phrase, activity)| Some((fits(phrase, words)?, *activity)));
    // Of equally long ones the first: what is listed before stands for more.
    fitting.fold(None, |best, next| match best {
        Some((taken, _)) if taken >= next.0 => best,
        _ => Some(next),
    })
}

/// How many words a phrase takes at the beginning of others, determiners between them counted.
fn fits(phrase: &[String], words: &[String]) -> Option<usize> {
    let mut at = 0;
    for (n, word) in phrase.iter().enumerate() {
        while n > 0 && words.get(at) != Some(word) && things().between.contains(words.get(at)?) {
            at += 1;
        }
        if words.get(at)? != word {
            return None;
        }
        at += 1;
    }
    Some(at)
}

/// The sorts of things that serve for an activity.
pub(super) fn sorts(activity: u16) -> impl Iterator<Item = u16> {
    let named =
        things().activities.get(usize::from(activity)).map_or(&[][..], |activity| &activity.sorts);
    named.iter().filter_map(|name| purposes::sort_called(name))
}

/// The sorts that serve for some activity, what is merely moved or switched left out.
pub(super) fn all_sorts() -> impl Iterator<Item = u16> {
    let activities = 0..u16::try_from(things().activities.len()).unwrap_or(u16::MAX);
    let all: BTreeSet<u16> = activities.flat_map(sorts).gather();
    all.into_iter().filter(|sort| !matches!(purposes::role(*sort), Theme))
}

/// Whether an activity is to move or switch something: then nothing serves for it.
pub(super) fn moves(activity: u16) -> bool {
    sorts(activity).any(|sort| purposes::role(sort) == Theme)
}

/// Whether an activity is done to something that its phrase does not name: «чем порезать хлеб».
pub(super) fn takes_object(activity: u16) -> bool {
    let activity = things().activities.get(usize::from(activity));
    activity.is_some_and(|activity| activity.said.iter().any(|phrase| phrase.contains('…')))
}

/// A thing that an order names by its use: the words, and the sorts that will do, the likeliest first.
pub(super) struct Wanted {
    pub(super) words: Range<usize>,
    pub(super) sorts: Vec<u16>,
}

/// «что-нибудь попить», "something to cut an apple with" among words in [`name_key`](crate::units::name_key) form.
pub(super) fn wanted(keys: &[String]) -> Option<Wanted> {
    static ANY: Set = Set::named("SomethingToUse");
    static JOINTS: Set = Set::named("JoinsUse");
    static ENDS: Set = Set::named("EndsUse");
    let is =
        |n: usize, words: &[&str]| keys.get(n).is_some_and(|key| words.contains(&key.as_str()));
    let (start, mut next) = (0..keys.len()).find_map(|at| {
        let taken = ANY.iter().find_map(|any| phrase_at(keys, at, any))?;
        Some((at, at + taken))
    })?;
    let mut joints = Vec::new();
    while is(next, &JOINTS) {
        joints.push(keys[next].as_str());
        next += 1;
    }
    let (taken, activity) = longest(&keys[next..])?;
    let mut end = next + taken;
    // What it is done to, and a preposition whose noun is what is wanted.
    let object = |n: &usize| !is(*n, set!("AfterUse"));
    let stranded = (end..keys.len().min(end + 4)).find(|n| is(*n, &["with"]));
    match stranded {
        Some(with) => end = with + 1,
        None if takes_object(activity) => {
            let between = &things().between;
            end += usize::from(keys.get(end).is_some_and(|key| between.contains(key)));
            end += usize::from(end < keys.len() && object(&end));
        }
        None => {}
    }
    while is(end, &ENDS) && (end + 1..keys.len()).all(|n| is(n, &ENDS)) {
        end += 1;
    }
    let said =
        |word: &str| joints.contains(&word) || keys[next + taken..end].iter().any(|k| k == word);
    let roles = match () {
        () if said("with") || said("чем") => &[Instrument, Location][..],
        () if said("from") || said("out") || said("чего") => &[Source, Instrument],
        () if sorts(activity).any(|sort| matches!(purposes::role(sort), Patient | Theme)) => {
            &[Patient, Theme]
        }
        () => &[Instrument, Source, Location],
    };
    let of_role = |role: Role| sorts(activity).filter(move |sort| purposes::role(*sort) == role);
    Some(Wanted { words: start..end, sorts: roles.iter().copied().flat_map(of_role).collect() })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_sort_of_an_activity_is_there_and_every_form_leads_to_its_activity() {
        for (n, Activity { said, sorts: named }) in things().activities.iter().enumerate() {
            let activity = u16::try_from(n).unwrap();
            assert_eq!(sorts(activity).count(), named.len(), "{named:?}");
            for phrase in said {
                let words: Vec<String> =
                    bare(phrase).split_whitespace().map(crate::units::name_key).collect();
                assert_eq!(longest(&words), Some((words.len(), activity)), "{phrase}");
            }
        }
    }

    #[test]
    fn determiners_and_the_other_order_change_nothing() {
        let check = |text: &str, expected: Option<&str>| {
            let words: Vec<String> = text.split_whitespace().map(crate::units::name_key).collect();
            let sort = longest(&words).and_then(|(_, activity)| sorts(activity).next());
            assert_eq!(
                sort.map(|s| &*things().sorts[usize::from(s)].english[0]),
                expected,
                "{text}"
            );
        };
        check("washing my hands", Some("place to wash hands"));
        check("посуду моют", Some("place to wash dishes"));
        check("cut an apple", Some("thing to cut with"));
        check("the apple", None);
    }
}
