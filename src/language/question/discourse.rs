//! Discourse: going on from a question for a way: the way back, how long it is, what lies on it.
//!
//! Invariant: a question that names anything else than the way, its rooms and doors goes on from nothing here.

use super::grammar::{Item, Phrase, Sentence};
use super::lexicon::Extension;
use super::mark::{Mark, Pronoun};
use super::{Asker, Dimension, Noun, Passing, Query, Rel, Thing};
use crate::report::Detail;
use crate::sets::Set;
use crate::words::{Case, Number, word_keys};

/// What is asked of a way that was told.
#[derive(Default)]
struct Asked {
    counts: bool,
    asks: bool,
    /// «по пути», "pass", "through"
    passes: bool,
    /// How long it is, in time or in metres.
    in_time: Option<bool>,
    /// «придётся открывать двери»
    opens: bool,
    /// Doors or rooms.
    of: Option<Passing>,
    /// Rooms and doors that it is to lead through.
    through: Vec<Noun>,
    may: bool,
    not: bool,
    /// Whether there are such at all, or "there".
    exist: bool,
}

impl Asker<'_> {
    /// «А обратно?», «Далеко это?», "How many doors do I pass on the way?": of the way that was asked for last.
    pub(super) fn of_the_way(&self, text: &str, last: &Query) -> Option<Query> {
        let (Query::Way { from, to, .. }
        | Query::CanReach { from, to }
        | Query::Duration { from, to }
        | Query::Distance { from, to }
        | Query::Passing { from, to, .. }) = last
        else {
            return None;
        };
        if is_back(text) {
            return turned_round(last.clone());
        }
        if let Some(query) = self.other_ends(text, last) {
            return Some(query);
        }
        let asked = self.asked_of_way(text)?;
        let (from, to) = (from.clone(), to.clone());
        if asked.opens {
            let asks = Passing::Opens;
            return Some(Query::Passing {
                from,
                to,
                through: Vec::new(),
                avoiding: Vec::new(),
                asks,
            });
        }
        if !asked.through.is_empty() {
            // "And not through the hall?" asks for another way, "Why not through the hall?" for this one.
            let (named, none, asks) = (asked.through, Vec::new(), Passing::Whether);
            let (through, avoiding) =
                if asked.not && !asked.may { (none, named) } else { (named, none) };
            return Some(Query::Passing { from, to, through, avoiding, asks });
        }
        if asked.may || asked.not {
            return None;
        }
        let asks = match (asked.in_time, asked.counts, asked.passes) {
            (Some(true), false, _) => return Some(Query::Duration { from, to }),
            (Some(false), false, _) => return Some(Query::Distance { from, to }),
            (None, true, true) => asked.of?,
            // "How many doors?" of the way, where they are not asked to be anywhere.
            (None, true, false) if asked.of == Some(Passing::Doors) && !asked.exist => {
                Passing::Doors
            }
            // By its rooms and doors alone there may be a shorter one, which is shut.
            (None, false, true) if asked.asks => {
                return Some(Query::Way { from, to, detail: Detail::default() });
            }
            _ => return None,
        };
        Some(Query::Passing { from, to, through: Vec::new(), avoiding: Vec::new(), asks })
    }

    /// «А в кухню?», "And from the hall?", "What about from here to the kitchen?": the same way with other ends.
    fn other_ends(&self, text: &str, last: &Query) -> Option<Query> {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let keys: Vec<&str> = sentence.keys.iter().map(String::as_str).collect();
        let goes_on = matches!(keys[..], ["and" | "а" | "и", ..] | ["what" | "how", "about", ..]);
        if !goes_on {
            return None;
        }
        let (mut starts, mut ends) = (None, None);
        for item in sentence.items() {
            match item {
                Item::Mark(Mark::And | Mark::What | Mark::How | Mark::The | Mark::Filler) => {}
                Item::Place { rel, nouns, either: false } => {
                    let [phrase] = &nouns[..] else { return None };
                    if phrase.pronoun.is_some() || phrase.person.is_some() {
                        return None;
                    }
                    let end = match rel {
                        Rel::From => &mut starts,
                        Rel::To => &mut ends,
                        // «в кухню», «на кухню» say whither, «в кухне» where.
                        Rel::In | Rel::On if is_whither(phrase) => &mut ends,
                        _ => return None,
                    };
                    if end.replace(phrase.noun.clone()).is_some() {
                        return None;
                    }
                }
                _ => return None,
            }
        }
        if starts.is_none() && ends.is_none() {
            return None;
        }
        let mut query = last.clone();
        let (Query::Way { from, to, .. }
        | Query::CanReach { from, to }
        | Query::Duration { from, to }
        | Query::Distance { from, to }
        | Query::Passing { from, to, .. }) = &mut query
        else {
            return None;
        };
        if let Some(start) = starts {
            *from = Some(start);
        }
        if let Some(end) = ends {
            *to = end;
        }
        Some(query)
    }

    fn asked_of_way(&self, text: &str) -> Option<Asked> {
        let text = self.plain(text);
        let mut asked = Asked::default();
        let sentence = Sentence::new(&text, &self.mind.lexicon);
        for item in sentence.items() {
            match item {
                Item::Mark(Mark::HowLong) => asked.in_time = Some(true),
                Item::Mark(Mark::HowFar | Mark::HowBig(Dimension::Length)) => {
                    asked.in_time = asked.in_time.or(Some(false));
                }
                // "Why can't I go through the kitchen?"
                Item::Place { rel: Rel::Through, nouns, .. }
                    if nouns.iter().all(|phrase| phrase.pronoun.is_none()) =>
                {
                    asked.through = nouns.into_iter().map(|phrase| phrase.noun).collect();
                }
                Item::Mark(Mark::Why | Mark::WhyNot | Mark::Can | Mark::Cannot) => asked.may = true,
                Item::Mark(Mark::Not) => asked.not = true,
                Item::Mark(Mark::MustOpen) => asked.opens = true,
                Item::Mark(Mark::HowMany) => asked.counts = true,
                Item::Mark(Mark::What | Mark::Which) => asked.asks = true,
                Item::Mark(Mark::HowGet | Mark::Move) | Item::Link(Rel::Through) => {
                    asked.passes = true;
                }
                Item::Mark(
                    Mark::Be | Mark::The | Mark::And | Mark::Have | Mark::Lead | Mark::Must,
                )
                | Item::Link(Rel::On | Rel::In | Rel::NextTo) => {}
                Item::Mark(Mark::Exists) => asked.exist = true,
                Item::Noun(phrase) if phrase.person == Some(Mark::There) => asked.exist = true,
                Item::Noun(phrase)
                    if phrase.pronoun == Some(Pronoun::Any) || phrase.person.is_some() => {}
                Item::Noun(phrase) if asked.of.is_none() => {
                    asked.of = Some(self.passed(&phrase.noun)?);
                }
                _ => return None,
            }
        }
        asked.passes |= sentence.points();
        Some(asked)
    }

    /// Doors or rooms in general, which a way leads through.
    fn passed(&self, noun: &Noun) -> Option<Passing> {
        let plain = noun.filters.is_empty() && noun.best.is_none() && noun.restrictions.is_empty();
        noun.head.kinds.iter().filter(|_| plain).find_map(|kind| {
            match self.mind.lexicon.kind(*kind).extension {
                Extension::Doors => Some(Passing::Doors),
                Extension::Rooms => Some(Passing::Rooms),
                _ => None,
            }
        })
    }
}

/// Whether a noun behind a Russian preposition stands in the accusative, and not in the prepositional: «на кухню».
fn is_whither(phrase: &Phrase) -> bool {
    let has = |case| {
        phrase.cases.iter().any(|r| r.has(Number::Singular, case) || r.has(Number::Plural, case))
    };
    has(Case::Accusative) && !has(Case::Prepositional)
}

fn is_back(text: &str) -> bool {
    static BACK: Set = Set::named("AndBack");
    BACK.contains(&word_keys(text).join(" ").as_str())
}

fn turned_round(mut query: Query) -> Option<Query> {
    if let Query::Way { from, to, .. }
    | Query::CanReach { from, to }
    | Query::Duration { from, to }
    | Query::Distance { from, to }
    | Query::Passing { from, to, .. } = &mut query
    {
        let start = from.take().unwrap_or_else(|| Noun::of(vec![Thing::Robot]));
        *from = Some(std::mem::replace(to, start));
        return Some(query);
    }
    None
}
