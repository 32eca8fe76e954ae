//! «А вторая горит?», "How wide are the other two?": a number or "other" without its noun, in a sentence that asks more of it.
//!
//! Invariant: it is one of those that were told, never what bears the number in its name; where those that were told and
//! those that orders took of them are counted differently, it is asked which is meant.

use std::ops::Range;

use super::grammar::{Item, Sentence, number_of};
use super::mark::{Mark, Pronoun};
use super::resolution::case_of;
use super::{Asker, Doubt, Memory, Noun, Query, Thing, Unanswered, vocabulary};
use crate::command::Sort;
use crate::sets::{Set, set};
use crate::words::{Case, enumerate, phrase_at, word_keys, word_ranges};

/// Marks that end a clause.
const MARKS: [char; 8] = [',', ';', '.', '!', '?', '–', '—', ':'];

/// Words that stand for one of those that were told, or for several.
#[derive(Default)]
struct Said {
    words: Range<usize>,
    /// The number in the order, of the last one none; "other" has no number.
    rank: Option<Nth>,
    /// How many there are.
    many: Option<u64>,
    is_plural: bool,
    /// "… of them": of what was told, or of nothing.
    of_them: bool,
}

impl Said {
    /// "The other one"
    fn is_one_other(&self) -> bool {
        self.rank.is_none() && !self.is_plural
    }
}

#[derive(Clone, Copy)]
enum Nth {
    /// From nought.
    Rank(usize),
    Last,
}

/// What an order does with its object, and what was spoken of where nothing was told in an order.
pub(super) struct Done<'s> {
    pub(super) sort: Sort,
    pub(super) spoken: &'s [Thing],
}

impl Asker<'_> {
    /// A question with the names of what numbers or "other" mean in it, where these stand without their noun.
    ///
    /// # Errors
    /// Several of those that were told are meant alike.
    pub(super) fn with_told(&self, text: &str, memory: &Memory) -> Result<Option<String>, Doubt> {
        // "And the other one?" alone asks the last question anew, and "the second biggest" ranks by size.
        let taken = memory.has_taken() && counts(&word_keys(text));
        let last = memory.query.as_ref().filter(|_| !taken);
        let key = crate::units::name_key(text);
        let anew = last.is_some_and(|last| self.another_asked(&key, last, memory).is_some());
        if anew || !taken && self.counted_of_listed(text, memory).is_some() {
            return Ok(None);
        }
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let items = sentence.items();
        let most = items.iter().any(|item| match item {
            Item::Mark(mark) => matches!(mark, Mark::Best(_) | Mark::BestTo(_)),
            Item::Noun(phrase) => phrase.noun.best.is_some(),
            _ => false,
        });
        let named = self.with_names(text, memory, None).map_err(|(doubt, _)| doubt)?;
        // "Is the second one on the table?" asks where it is, "the second one on the table" says which it is.
        let placed = |text: &str| {
            let items = Sentence::new(text, &self.mind.lexicon).items();
            items.iter().any(|item| matches!(item, Item::Place { .. }))
        };
        // And so do ends between which is measured.
        let asks = |text: &str| {
            matches!(self.read(text, memory), Ok(Query::Holds { .. } | Query::Distance { .. }))
        };
        Ok(named.filter(|named| !most && (!placed(named) || asks(named))))
    }

    /// A sentence, an order where it does something, with the names of what numbers or "other" mean in it.
    ///
    /// # Errors
    /// Several of those that were told are meant alike by the words at these bytes.
    pub(super) fn with_names(
        &self,
        text: &str,
        memory: &Memory,
        done: Option<&Done<'_>>,
    ) -> Result<Option<String>, (Doubt, Range<usize>)> {
        let (words, keys) = (word_ranges(text), word_keys(text));
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let knowledge = self.knowledge(sentence.language, memory);
        let mut all: Vec<Said> = Vec::new();
        // «в той, первой»: what points before it tells otherwise which.
        let points = |n: usize| set!("PointingToNoun").contains(&keys[n].as_str());
        for n in 0..keys.len() {
            let free = all.last().is_none_or(|before| before.words.end <= n);
            let free = free && !n.checked_sub(1).is_some_and(points);
            if let Some(said) =
                said(&keys, n).filter(|said| free && sentence.ends_noun(said.words.end))
            {
                all.push(said);
            }
        }
        // "From one to the other": of two.
        let pair = || [&memory.last, &memory.listed].into_iter().find(|told| told.len() == 2);
        let one = all.first().filter(|said| all.len() == 1 && said.is_one_other());
        let one = one.and_then(|other| {
            let is_one = |n: &usize| {
                set!("OneOfTwo").contains(&keys[*n].as_str()) && sentence.ends_noun(n + 1)
            };
            (0..other.words.start.saturating_sub(1)).rfind(is_one)
        });
        let two = one.filter(|_| done.is_none()).and_then(|n| Some((n, pair()?)));
        if let Some((n, _)) = two {
            all.insert(0, Said { words: n..n + 1, rank: Some(Nth::Rank(0)), ..Said::default() });
        }
        let small = |n: usize| {
            [set!("AroundAnother"), set!("No")].iter().any(|set| set.contains(&keys[n].as_str()))
        };
        let is_said = |n: &usize| all.iter().any(|said| said.words.contains(n));
        // Alone they ask of nothing.
        if done.is_none() && (0..keys.len()).all(|n| is_said(&n) || small(n)) {
            return Ok(None);
        }
        // "And the second one, is it open?" asks by itself.
        static GOES_ON: Set = Set::named("GoesOnFrom");
        let begins = || GOES_ON.iter().filter_map(|begin| phrase_at(&keys, 0, begin)).max();
        let from = begins().filter(|_| done.is_none()).unwrap_or(0);
        let mut whole = text.to_owned();
        for said in all.iter().rev() {
            let link = said.words.start.checked_sub(1).and_then(|n| {
                match vocabulary::longest(&keys[n..said.words.start]) {
                    Some((_, Mark::Link(rel))) => Some(rel),
                    _ => None,
                }
            });
            // "What is on the other one?", and another one of an order, are told elsewhere.
            let elsewhere = link.is_some() || done.is_some() || memory.pending.is_some();
            if said.rank.is_none() && two.is_none() && elsewhere {
                return Ok(None);
            }
            let genders = genders(&keys[said.words.clone()]);
            let fits = |thing: &Thing| {
                let agrees =
                    genders.is_empty() || genders.iter().any(|g| knowledge.agrees(*g, *thing));
                let able = match (link, done) {
                    (Some(rel), _) => knowledge.may_be_anchor(rel, *thing),
                    (None, Some(done)) => knowledge.can(done.sort, *thing),
                    (None, None) => true,
                };
                agrees && able
            };
            let at = words[said.words.start].start..words[said.words.end - 1].end;
            let of_two =
                two.and_then(|(_, pair)| Some(vec![*pair.get(usize::from(said.rank.is_none()))?]));
            let Some(meant) = of_two.or_else(|| self.told_by(said, memory, done, &fits)) else {
                // "The first of them", where there is no such thing, is none of all of them either.
                let word = text[at.clone()].to_owned();
                return if said.of_them { Err((Doubt::NoReferent { word }, at)) } else { Ok(None) };
            };
            if meant.len() > 1 && !said.is_plural {
                let reference = text[at.clone()].to_owned();
                return Err((Doubt::Ambiguous { reference, candidates: meant }, at));
            }
            let case = match (link, done) {
                (Some(rel), _) => case_of(rel, done.is_some()),
                (None, Some(_)) => Case::Accusative,
                (None, None) => Case::Nominative,
            };
            whole.replace_range(at, &knowledge.listed(&meant, case));
        }
        let start = words.get(from).map_or(0, |word| word.start);
        Ok((!all.is_empty()).then(|| whole.split_off(if from == 0 { 0 } else { start })))
    }

    /// «Тот, что на полке, принеси сюда»: an order with the names of what a pointing word and its clause mean of those that were
    /// told; none where it has no such words.
    ///
    /// # Errors
    /// None of those that were told is there, or several are.
    pub fn with_pointed(
        &self,
        text: &str,
        memory: &Memory,
    ) -> Result<Option<String>, Box<Unanswered>> {
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let (words, keys) = (&sentence.words, &sentence.keys);
        // «Закрой другую, которая ведёт в спальню»
        let is_other = |n: &usize| {
            set!("AnotherOne").contains(&keys[*n].as_str()) && sentence.is_told_by_clause(*n)
        };
        let pointing = (0..keys.len()).find(|n| sentence.points_ahead(*n) || is_other(n));
        let Some(from) = pointing else {
            return Ok(None);
        };
        let parted = |n: &usize| text[words[n - 1].end..words[*n].start].contains(MARKS);
        let until = (from + 3..words.len()).find(parted).unwrap_or(words.len());
        let Some(place) = words.get(from + 2) else { return Ok(None) };
        let place = self.bare_place(&text[place.start..words[until - 1].end], memory);
        let is_plural = set!("SeveralOnes").contains(&keys[from].as_str());
        let Some(restrictions) = place.filter(|_| memory.listed.len() > 1) else {
            // «Закрой дверь в ванную. – Закрой и ту, что ведёт в спальню»: a door too.
            let last = memory.last_things().pop().filter(|_| !is_plural);
            let kind = last.and_then(|thing| self.kind_word(thing, sentence.language));
            // "… that one too" is another than the last.
            let too = from > 0 && set!("AndWord").contains(&keys[from - 1].as_str());
            let other = match is_other(&from) {
                true => keys[from].as_str(),
                false => set!("OtherOne").first().filter(|_| too).map_or("", |other| other),
            };
            let whole = |kind| {
                let (before, behind) = (&text[..words[from].start], &text[words[from].end..]);
                format!("{before}{other} {kind}{behind}")
            };
            return Ok(kind.map(whole));
        };
        let knowledge = self.knowledge(sentence.language, memory);
        let told = Noun { plural: true, restrictions, ..Noun::of(memory.listed.clone()) };
        let reference = text[words[from].start..words[until - 1].end].to_owned();
        let found = knowledge.find(&told, true).unwrap_or_default();
        let doubt = match found.len() {
            0 => Doubt::not_understood(&reference),
            2.. if !is_plural => Doubt::Ambiguous { reference, candidates: found },
            _ => {
                let names: Vec<String> =
                    found.iter().map(|t| knowledge.form(*t, Case::Accusative)).collect();
                let names = enumerate(&names, sentence.language);
                let behind = text[words[until - 1].end..].trim_start_matches([',', ' ']);
                return Ok(Some(format!("{}{names} {behind}", &text[..words[from].start])));
            }
        };
        Err(Box::new(knowledge.unanswered(doubt)))
    }

    /// What such words mean of those that were told, and of what was spoken of one after the other since.
    fn told_by(
        &self,
        said: &Said,
        memory: &Memory,
        done: Option<&Done<'_>>,
        fits: &dyn Fn(&Thing) -> bool,
    ) -> Option<Vec<Thing>> {
        let others = || self.others_of_last(memory)?.head.things;
        let listed = &memory.listed;
        let mut meant = match said.rank {
            Some(nth) => {
                let spoken = done.map_or(&[][..], |done| done.spoken);
                let all = if listed.is_empty() { spoken } else { listed };
                let at = match nth {
                    Nth::Rank(at) => at,
                    Nth::Last => all.len().checked_sub(1)?,
                };
                let mut meant: Vec<Thing> = match listed.is_empty() {
                    true => {
                        spoken.get(at).filter(|_| spoken.len() > 1).into_iter().copied().collect()
                    }
                    false => memory.numbered(at),
                };
                let in_turn = memory.in_turn(|thing| done.is_some() && fits(thing));
                let other =
                    in_turn.get(at).filter(|other| in_turn.len() > 1 && !meant.contains(other));
                meant.extend(other);
                meant
            }
            None if said.is_plural => {
                let knowledge = self.knowledge(memory.language, memory);
                let rest = self.rest_of_kind(memory);
                let rest = rest.and_then(|noun| knowledge.find(&noun, true).ok());
                rest.or_else(others)?
            }
            None => others()?,
        };
        if said.rank.is_some() {
            meant.retain(fits);
        }
        let many = said.many.is_none_or(|many| meant.len() as u64 == many);
        // Of a kind that was spoken of since the last list there are others than in that.
        let since = !memory.last.iter().any(|thing| listed.contains(thing));
        let told = said.rank.is_some() || said.is_plural || since;
        let told = told || meant.iter().all(|thing| listed.contains(thing));
        (!meant.is_empty() && many && told && meant.iter().all(fits)).then_some(meant)
    }
}

/// Pronouns of the genders that a Russian adjective or pointing word may have; none for a plural and in English.
pub(super) fn genders(words: &[String]) -> Vec<Pronoun> {
    const ENDINGS: [(&str, &[Pronoun]); 20] = [
        ("ая", &[Pronoun::She]),
        ("ую", &[Pronoun::She]),
        ("ья", &[Pronoun::She]),
        ("ью", &[Pronoun::She]),
        ("ой", &[Pronoun::He, Pronoun::She]),
        ("ей", &[Pronoun::She]),
        ("ый", &[Pronoun::He]),
        ("ий", &[Pronoun::He]),
        ("ое", &[Pronoun::It]),
        ("ее", &[Pronoun::It]),
        ("го", &[Pronoun::He, Pronoun::It]),
        ("му", &[Pronoun::He, Pronoun::It]),
        ("от", &[Pronoun::He]),
        ("та", &[Pronoun::She]),
        ("ту", &[Pronoun::She]),
        ("то", &[Pronoun::It]),
        ("ин", &[Pronoun::He]),
        ("на", &[Pronoun::She]),
        ("ну", &[Pronoun::She]),
        ("но", &[Pronoun::It]),
    ];
    let ends = |ending: &str| words.iter().any(|word| word.ends_with(ending) && !word.is_ascii());
    let found = ENDINGS.iter().find(|(ending, _)| ends(ending));
    found.map_or_else(Vec::new, |(_, genders)| genders.to_vec())
}

/// The words from one on that stand for what was told.
fn said(keys: &[String], from: usize) -> Option<Said> {
    let is = |n: usize, all: &[&str]| keys.get(n).is_some_and(|key| all.contains(&key.as_str()));
    let number = |n: usize| keys.get(n).and_then(|key| number_of(key)).filter(|many| *many > 1);
    let mut at = from;
    let has_article = is(at, set!("TheOrA"));
    at += usize::from(has_article);
    let mut many = number(at);
    at += usize::from(many.is_some());
    let rank = match vocabulary::longest(keys.get(at..)?) {
        _ if is(at, set!("LastOfList")) => Some(Nth::Last),
        Some((1, Mark::Rank(rank))) => Some(Nth::Rank(usize::try_from(rank).ok()?.checked_sub(1)?)),
        _ => None,
    };
    let other = is(at, set!("Another"));
    let several = is(at, set!("OtherSeveral"));
    if rank.is_none() && !other || rank.is_some() && many.is_some() {
        return None;
    }
    at += 1;
    // English says "one" for the noun, or nothing behind "the others".
    let stands = is(at, set!("PointingToNoun"));
    let ones = is(at, set!("SeveralOnes"));
    if many.is_none() && rank.is_none() && !stands {
        many = number(at);
        at += usize::from(many.is_some());
    }
    let english = keys[from..at].iter().all(|key| key.is_ascii());
    at += usize::from(english && stands);
    // "the first of them"
    let of_them = is(at, set!("Of")) && is(at + 1, set!("OfThem"));
    at += if of_them { 2 } else { 0 };
    if english && !has_article {
        return None;
    }
    let is_plural = ones || several || many.is_some();
    Some(Said { words: from..at, rank, many, is_plural, of_them })
}

/// Whether one of these words is a number in an order: «вторую», "the second one".
pub(super) fn counts(keys: &[String]) -> bool {
    (0..keys.len()).any(|n| matches!(vocabulary::longest(&keys[n..]), Some((_, Mark::Rank(_)))))
}
