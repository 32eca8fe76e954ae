//! Another of the kind: "the other one", «остальные», "the one to the kitchen", «а тот, что в гостиной», one more.
//!
//! Invariant: what else there is of a kind is told beside what was told of it; where nothing was, it means nothing.

use super::grammar::{Item, Phrase, Sentence, number_of};
use super::mark::{Mark, Pronoun};
use super::numbered::genders;
use super::query::Denial;
use super::{Asker, Claim, Head, Memory, Noun, Query, Restriction, Thing, vocabulary};
use crate::sets::{Set, set};
use crate::words::{word_keys, word_ranges};

impl Asker<'_> {
    /// «На чём он стоит? А тот, что в гостиной?»: the same of another of its kind.
    pub(super) fn another_pointed(
        &self,
        sentence: &Sentence<'_>,
        last: &Query,
        memory: &Memory,
    ) -> Option<Query> {
        let items = sentence.items();
        let mut own = items.iter().skip_while(|item| matches!(item, Item::Mark(Mark::And)));
        let Some(Item::Noun(phrase)) = own.next() else { return None };
        let at = phrase.words.start;
        let leads = items.contains(&Item::Mark(Mark::Lead));
        if leads && stands_for_noun(phrase) {
            return self.another_leading(phrase, own, last, memory);
        }
        if !own.all(|item| matches!(item, Item::Place { .. })) || !sentence.points_ahead(at) {
            return None;
        }
        let noun = self.fragment(sentence, memory)?;
        let knowledge = self.knowledge(sentence.language, memory);
        let genders = genders(&sentence.keys[at..=at]);
        let fits = |thing: &Thing| {
            genders.is_empty() || genders.iter().any(|gender| knowledge.agrees(*gender, *thing))
        };
        let mut query = last.clone();
        let mut placed = false;
        query.first_noun(|old| {
            if !old.head.anything && self.has_kind(old) {
                old.restrictions.clone_from(&noun.restrictions);
                old.filters.clone_from(&noun.filters);
                let found = knowledge.find(old, true).unwrap_or_default();
                placed =
                    !noun.restrictions.is_empty() && !found.is_empty() && found.iter().all(fits);
            }
        });
        placed.then_some(query)
    }

    /// "Is Door 1 open? And the one that leads to the bedroom?": the same of the door that leads there.
    fn another_leading<'i>(
        &self,
        phrase: &Phrase,
        clause: impl Iterator<Item = &'i Item>,
        last: &Query,
        memory: &Memory,
    ) -> Option<Query> {
        let knowledge = self.knowledge(memory.language, memory);
        let mut places: Vec<Restriction> = Vec::new();
        for item in clause {
            match item {
                Item::Mark(Mark::The | Mark::Which | Mark::What | Mark::Lead) => {}
                Item::Place { rel, nouns, either: false } => {
                    let anchors = nouns.iter().map(|phrase| phrase.noun.clone()).collect();
                    let place = Restriction { rel: *rel, anchors, negated: false };
                    // "… to the bedroom with the desk": the bedroom has it.
                    match places.last_mut().and_then(|place| place.anchors.last_mut()) {
                        Some(room) => room.restrictions.push(place),
                        None => places.push(place),
                    }
                }
                _ => return None,
            }
        }
        let mut query = last.clone();
        let mut is_of_door = false;
        query.first_noun(|old| {
            let base = knowledge.base(&old.head);
            is_of_door = !base.is_empty() && base.iter().all(|t| knowledge.opening(*t).is_some());
            *old = Noun { restrictions: places, ..phrase.noun.clone() };
        });
        is_of_door.then_some(query)
    }

    /// "Is the bedroom door shut? – No, neither Door 1 nor Door 2. – The one to the kitchen?": the same of that one of
    /// those that were told.
    pub(super) fn one_of_asked(
        &self,
        sentence: &Sentence<'_>,
        last: &Query,
        memory: &Memory,
    ) -> Option<Query> {
        let items = sentence.items();
        let small = |item: &Item| matches!(item, Item::Mark(Mark::And | Mark::The));
        let mut own = items.iter().skip_while(|item| small(item));
        let Some(Item::Noun(phrase)) = own.next() else { return None };
        let places = own.all(|item| matches!(item, Item::Place { .. }));
        let points = phrase.noun.head.anything && word_keys(&phrase.noun.text).last()? == "one";
        if !places || !points || memory.listed.len() < 2 || memory.pending.is_some() {
            return None;
        }
        let noun = self.fragment(sentence, memory).filter(|noun| !noun.restrictions.is_empty())?;
        let asks = matches!(
            last,
            Query::Holds { .. }
                | Query::Choice { .. }
                | Query::Property { .. }
                | Query::Size { .. }
        );
        let told = |noun: &Noun| {
            let knowledge = self.knowledge(sentence.language, memory);
            let found = knowledge.find(noun, true).unwrap_or_default();
            !found.is_empty() && found.iter().all(|t| memory.listed.contains(t))
        };
        let mut subject = false;
        last.clone().first_noun(|old| subject = told(old));
        let head = Head { things: Some(memory.listed.clone()), ..Head::default() };
        let narrowed = Noun { head, plural: true, ..noun };
        let knowledge = self.knowledge(sentence.language, memory);
        let found = knowledge.find(&narrowed, true).ok().filter(|_| asks && subject)?;
        let [only] = found[..] else { return None };
        Some(last.clone().of_another(&Noun::of(vec![only])))
    }

    /// "Is there a sink in the bathroom? One in the kitchen too?": whether there is another of the kind.
    pub(super) fn one_more(&self, text: &str, last: &Query, memory: &Memory) -> Option<Query> {
        let keys = word_keys(text);
        let (first, _) = keys.split_first()?;
        let asks = set!("OneOrSome").contains(&first.as_str()) && text.trim_end().ends_with('?');
        let sought = last.sought().filter(|noun| asks && !noun.head.kinds.is_empty())?;
        let place = self.bare_place(&text[word_ranges(text).first()?.end..], memory)?;
        let head = Head { kinds: sought.head.kinds.clone(), ..Head::default() };
        let what = vec![Noun { head, restrictions: place, plural: true, ..Noun::default() }];
        Some(Query::Exists { what, either: false, denial: Denial::None })
    }

    /// «Сколько стульев на кухне? А в спальне есть ещё?», "Is there another in the bedroom?": of the kind, in a place of which
    /// none of it was told.
    pub(super) fn more_elsewhere(
        &self,
        sentence: &Sentence<'_>,
        last: &Query,
        memory: &Memory,
    ) -> Option<Query> {
        let another = |key: &String| set!("AnotherWord").contains(&key.as_str());
        let noun = last.sought().filter(|_| sentence.keys.iter().any(another))?;
        let (mut restrictions, mut exists) = (Vec::new(), false);
        for item in sentence.items() {
            match item {
                Item::Mark(Mark::Exists) => exists = true,
                Item::Mark(Mark::And | Mark::Be | Mark::Other | Mark::Filler | Mark::A) => {}
                Item::Noun(phrase) if phrase.noun.head.anything => {}
                Item::Place { rel, nouns, either: false } => {
                    let anchors = nouns.into_iter().map(|phrase| phrase.noun).collect();
                    restrictions.push(Restriction { rel, anchors, negated: false });
                }
                _ => return None,
            }
        }
        let named = exists && !restrictions.is_empty() && !noun.head.kinds.is_empty();
        let head = Head { kinds: noun.head.kinds.clone(), ..Head::default() };
        let sought = Noun { head, restrictions, plural: true, indefinite: true, ..Noun::default() };
        let found = self.knowledge(sentence.language, memory).find(&sought, true);
        let told = |thing: &Thing| memory.last.contains(thing) || memory.listed.contains(thing);
        let are_new = found.is_ok_and(|found| !found.iter().any(told));
        let what = vec![sought];
        (named && are_new).then_some(Query::Exists { what, either: false, denial: Denial::None })
    }

    /// "Take the pen to the hall. – … – And are there any in the kitchen?", «А на кухне сколько?»: of the kind of what an order
    /// was done to, as it now is.
    pub(super) fn more_of_ordered(&self, text: &str, memory: &Memory) -> Option<Query> {
        if !memory.is_ordered || memory.pending.is_some() {
            return None;
        }
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let kind = self.knowledge(sentence.language, memory).alike(&memory.last)?;
        let (mut restrictions, mut counts, mut exists) = (Vec::new(), false, false);
        for item in sentence.items() {
            match item {
                Item::Mark(Mark::Exists) => exists = true,
                Item::Mark(Mark::HowMany) => counts = true,
                Item::Mark(Mark::And | Mark::Be | Mark::Filler | Mark::A | Mark::One) => {}
                Item::Mark(Mark::Anything) if sentence.keys.iter().any(|key| is_some(key)) => {}
                Item::Noun(phrase)
                    if phrase.pronoun == Some(Pronoun::They)
                        || phrase.noun.head.anything
                            && sentence.keys.iter().any(|key| is_some(key)) => {}
                Item::Place { rel, nouns, either: false }
                    if nouns.iter().all(|p| p.pronoun.is_none() && p.person.is_none()) =>
                {
                    let anchors = nouns.into_iter().map(|phrase| phrase.noun).collect();
                    restrictions.push(Restriction { rel, anchors, negated: false });
                }
                _ => return None,
            }
        }
        if restrictions.is_empty() {
            return None;
        }
        let head = Head { kinds: vec![kind], ..Head::default() };
        let noun = Noun { head, restrictions, plural: true, ..Noun::default() };
        match (counts, exists) {
            (true, _) => Some(Query::Count(noun)),
            (false, true) => {
                Some(Query::Exists { what: vec![noun], either: false, denial: Denial::None })
            }
            _ => None,
        }
    }

    /// «А где вторая?», "And the other one?": the last question about what else there is of that kind.
    pub(super) fn another_asked(&self, key: &str, last: &Query, memory: &Memory) -> Option<Query> {
        static SMALL: Set = Set::named("AroundAnother");
        static OTHER: Set = Set::named("Another");
        let words: Vec<&str> = key
            .split(|c: char| !c.is_alphanumeric())
            .filter(|word| {
                !word.is_empty() && !SMALL.contains(word) && (OTHER.contains(word) || !stands(word))
            })
            .collect();
        let asks_where = words.iter().any(|word| set!("Where").contains(word));
        let rest: Vec<&&str> = words.iter().filter(|w| !set!("Where").contains(w)).collect();
        let (only, many) = match rest[..] {
            [only] => (only, None),
            // «А другие два?», «А две другие?», "The other three?": just so many.
            [only, many] if OTHER.contains(only) => (only, Some(number_of(many)?)),
            [many, only] => (only, Some(number_of(many)?)),
            _ => return None,
        };
        if !OTHER.contains(only) {
            return None;
        }
        // «Где первый? А второй?» of three counts on.
        let others = || self.others_of_last(memory).filter(|noun| !ranks(only) || is_one(noun));
        let noun = match set!("OtherSeveral").contains(only) {
            true => self.rest_of_kind(memory).or_else(others)?,
            false if many.is_some() => self.rest_of_kind(memory).or_else(others)?,
            false => others()?,
        };
        // "Which lamps are on? – These three. – And the others?": those that were told are no others.
        let found = self.knowledge(memory.language, memory).find(&noun, true).unwrap_or_default();
        let told = memory.last.len() > 1 && found.len() == memory.last.len();
        if told && found.iter().all(|t| memory.last.contains(t)) {
            return None;
        }
        let so_many = |many: u64| {
            let found = self.knowledge(memory.language, memory).find(&noun, true);
            let others = |found: &Vec<Thing>| found.iter().all(|t| !memory.last.contains(t));
            found.is_ok_and(|found| found.len() as u64 == many && others(&found))
        };
        if many.is_some_and(|many| !so_many(many)) {
            return None;
        }
        // Of several others none is the one that is meant.
        let one = many.is_none() && !set!("OtherSeveral").contains(only);
        let noun = match one && !is_one(&noun) {
            true => Noun { text: (*only).to_owned(), plural: false, ..noun },
            false => noun,
        };
        if asks_where {
            return Some(Query::Where(noun));
        }
        let knowledge = self.knowledge(memory.language, memory);
        Some(match last {
            // "How many books are on this shelf? And the other ones?": on the other shelves.
            Query::Count(counted)
                if let [place] = &counted.restrictions[..]
                    && noun.head.things.as_deref().is_some_and(|others| {
                        let own = knowledge.base(&counted.head);
                        others.iter().all(|other| !own.contains(other))
                    }) =>
            {
                let anchors = vec![Noun { plural: true, ..noun }];
                let restrictions = vec![Restriction { anchors, ..place.clone() }];
                Query::Count(Noun { restrictions, ..counted.clone() })
            }
            Query::Count(_) => Query::Where(noun),
            // "Which of them is open? And the other one?"
            Query::Find(asked) if !asked.filters.is_empty() => {
                let claims = asked.filters.iter().cloned().map(Claim::Value).collect();
                Query::Holds { subject: noun, claims, denial: Denial::None }
            }
            last => last.clone().of_another(&noun),
        })
    }

    /// The other things of the kind of the last one: of several that were just listed, those that were not spoken of
    /// before. While it is asked back which is meant there is no one beside which others are.
    pub(super) fn others_of_last(&self, memory: &Memory) -> Option<Noun> {
        if memory.pending.is_some() {
            return None;
        }
        let known = memory.topic_among(&memory.last);
        if known.is_some() {
            let others = memory.last.iter().filter(|t| Some(**t) != known).copied();
            return Some(Noun { plural: true, ..Noun::of(others.collect()) });
        }
        let rest = self.knowledge(memory.language, memory).complement()?;
        Some(Noun { plural: rest.len() > 1, ..Noun::of(rest) })
    }
}

/// Whether a door is only pointed at: "the other one that leads to the bedroom".
fn stands_for_noun(phrase: &Phrase) -> bool {
    let keys = word_keys(&phrase.noun.text);
    let points = |word: &String| {
        set!("PointingToNoun").contains(&word.as_str()) || set!("Another").contains(&word.as_str())
    };
    !phrase.noun.head.anything && keys.last().is_some_and(points)
}

/// "The second", which of more than two counts them, and of two is the other one.
fn ranks(word: &str) -> bool {
    let said = vocabulary::longest(&[word.to_owned()]);
    matches!(said, Some((_, Mark::Rank(_))))
}

/// "Any", "some", "one": of what, was said before.
fn is_some(key: &str) -> bool {
    set!("OneOrSome").contains(&key)
}

fn is_one(noun: &Noun) -> bool {
    noun.head.things.as_ref().is_some_and(|things| things.len() == 1)
}

/// Whether a word says of a thing only that it is somewhere: «стоят», "lying".
fn stands(word: &str) -> bool {
    let said = vocabulary::longest(&[word.to_owned()]);
    matches!(said, Some((_, Mark::Be | Mark::Hang | Mark::Filler)))
}
