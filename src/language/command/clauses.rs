//! One verb and what belongs to it: a sentence cut into clauses.

use std::ops::Range;

use super::grammar::{Argument, Item, Reference, Sentence};
use super::vocabulary::{Haunt, Verb};
use crate::words::Language;

/// One verb and what belongs to it.
pub(super) struct Clause<'i, 's, T> {
    pub(super) verb: Option<(Verb, &'i Range<usize>)>,
    pub(super) before: Vec<&'i Argument<'s, T>>,
    pub(super) after: Vec<&'i Argument<'s, T>>,
    pub(super) dangling: Option<&'i Range<usize>>,
    pub(super) with_key: bool,
    pub(super) on_floor: bool,
    pub(super) to_wall: bool,
    pub(super) haunt: Option<Haunt>,
    /// Whether each argument without a preposition stands behind «и» or a comma, or is the first of nothing else.
    pub(super) listed: bool,
    /// Who speaks, where the clause names that; and whether behind «и».
    pub(super) me: Option<&'i Range<usize>>,
    pub(super) me_joined: bool,
}

impl<T> Clause<'_, '_, T> {
    /// Whether it says that something is for who speaks: "get me the cup".
    pub(super) fn is_for_me(&self) -> bool {
        let mut arguments = self.before.iter().chain(&self.after);
        arguments.any(|argument| matches!(argument.reference, Reference::Me))
    }
}

/// Cuts the items before a second verb: at the «и» between the two, if the objects stand before their verbs. They do not
/// where a mark parts them from the verb («Возьми чашку и тарелку, поставь их на стол»), nor ever in English.
pub(super) fn clauses<'i, 's, T>(
    sentence: &Sentence<'_>,
    items: &'i [Item<'s, T>],
) -> Vec<Clause<'i, 's, T>> {
    let is_verb = |item: &Item<'_, T>| matches!(item, Item::Verb(verb, _) if *verb != Verb::Need);
    let mut starts = vec![0];
    let mut seen_verb = false;
    let mut conjunction = None;
    let mut named: Option<&Range<usize>> = None;
    for (at, item) in items.iter().enumerate() {
        match item {
            Item::And if seen_verb => (conjunction, named) = (Some(at), None),
            Item::Argument(argument) => named = Some(&argument.words),
            Item::Verb(_, words) if is_verb(item) => {
                if seen_verb {
                    let begins = conjunction.take();
                    let ends_before = |named| !sentence.leads_to(named, words);
                    let begins = begins.filter(|_| !named.is_some_and(ends_before));
                    starts.push(begins.unwrap_or(at));
                }
                seen_verb = true;
            }
            _ => {}
        }
    }
    starts.push(items.len());
    starts.windows(2).map(|bounds| clause(sentence, &items[bounds[0]..bounds[1]])).collect()
}

impl Sentence<'_> {
    /// Whether a comma, and nothing else, parts some words from those before them.
    fn is_parted(&self, before: &Range<usize>, words: &Range<usize>) -> bool {
        let between = &self.text[self.span(before).end..self.span(words).start];
        between.trim_start_matches(['»', '"', '”', ' ']).starts_with(',')
    }

    /// Whether words may be what the verb behind them is done to.
    fn leads_to(&self, named: &Range<usize>, verb: &Range<usize>) -> bool {
        let verb = self.span(verb);
        let between = &self.text[self.span(named).end..verb.start];
        Language::of(&self.text[verb]) == Language::Russian
            && !between.contains([',', ';', '.', '!', ':'])
    }
}

fn is_linked<T>(item: &Item<'_, T>) -> bool {
    matches!(item, Item::Argument(Argument { link: Some(_), .. }))
}

fn clause<'i, 's, T>(sentence: &Sentence<'_>, items: &'i [Item<'s, T>]) -> Clause<'i, 's, T> {
    let mut clause = Clause {
        verb: None,
        before: vec![],
        after: vec![],
        dangling: None,
        with_key: false,
        on_floor: false,
        to_wall: false,
        haunt: None,
        listed: true,
        me: None,
        me_joined: false,
    };
    for (at, item) in items.iter().enumerate() {
        // "the sofa and the bed"
        let mut before = items[..at].iter().rev().skip_while(|item| matches!(item, Item::Filler));
        let mut joined = || matches!(before.next(), Some(Item::And));
        if let Item::Argument(Argument { link: None, words, .. }) = item {
            let first = clause.before.is_empty() && clause.after.is_empty();
            clause.listed &= match clause.after.last().filter(|_| !first) {
                Some(last) if sentence.is_parted(&last.words, words) => true,
                // "Go Room 1 to Room 2" is no list.
                _ if first => !items[at + 1..].iter().any(is_linked),
                _ => joined(),
            };
        }
        if let Item::Argument(Argument { reference: Reference::Me, words, .. }) = item {
            (clause.me, clause.me_joined) = (Some(words), joined());
        }
        match item {
            // «мне нужно принести»: the real verb wins.
            Item::Verb(verb, words) if clause.verb.is_none_or(|(other, _)| other == Verb::Need) => {
                clause.verb = Some((*verb, words));
            }
            Item::Argument(argument) if clause.verb.is_some() => clause.after.push(argument),
            Item::Argument(argument) => clause.before.push(argument),
            Item::Dangling(words) => clause.dangling = Some(words),
            Item::WithKey => clause.with_key = true,
            Item::OnFloor => clause.on_floor = true,
            Item::FacingWall => clause.to_wall = true,
            Item::Haunt(haunt) => clause.haunt = Some(*haunt),
            Item::Verb(..) | Item::And | Item::Not(_) | Item::Filler => {}
        }
    }
    clause
}
