//! What asks within a line that is not understood as a whole: "hmm, no idea what time it is, is there a clock?"
//!
//! Invariant: what is left aside limits nothing, asks nothing, and tells no number, no value and no place but the person's;
//! a thing that it names is spoken of; and what was understood is said with the answer.

use super::clauses::{JOINTS, behind_joint, goes_on, is_reported, parts, parts_of};
use super::grammar::{Item, Sentence};
use super::mark::{Mark, Pronoun};
use super::told_aside::{Named, is_marked, only_begs, tells};
use super::{
    Asker, Doubt, Memory, Noun, Outcome, Query, Said, opening, premise, several, vocabulary,
};
use crate::sets::set;
use crate::units::InOrder as _;
use crate::words::{Language, word_keys, word_ranges};

/// What the parts of a line tell that do not ask.
#[derive(Default)]
struct Told {
    /// Where the person says to be.
    place: Option<Noun>,
    /// The words in which it is told where the person is, where these come to no place.
    astray: Option<String>,
    /// What they name.
    named: Named,
}

/// A line of more parts than this is not chatter.
const MOST_PARTS: usize = 8;
/// Nor one with more words before what asks.
const MOST_WORDS: usize = 12;

impl Asker<'_> {
    /// The answer to the one part of a line that asks, with what was understood before it; else the doubt of a part that
    /// was understood but for which of several is meant, or for a thing that the map lacks.
    pub(super) fn salvaged(
        &self,
        text: &str,
        language: Language,
        memory: &Memory,
    ) -> Option<Outcome> {
        let parts = parts(text);
        if parts.len() > MOST_PARTS {
            return None;
        }
        let spans = (0..parts.len()).flat_map(|from| (from..parts.len()).map(move |to| (from, to)));
        let mut spans: Vec<(usize, usize)> = spans.collect();
        spans.order_by_key(|(from, to)| (parts.len() - (to - from), *from));
        // Where a part ends as questions do, that is what asks; but for one by which a person is polite or begs.
        let marked = |n: usize| is_marked(&text[parts[n].0..parts[n].1]);
        let any_marked = (0..parts.len()).any(marked);
        let (mut doubted, mut untold) = (None, None);
        for (from, to) in spans {
            if any_marked && !(from..=to).any(marked) {
                continue;
            }
            let (start, end) = (parts[from].0, parts[to].1);
            let span = &text[start..end];
            // «ту, что на кухне», «больше, чем на кухне»: a clause of what stands before.
            if goes_on(&text[..start], span) {
                continue;
            }
            // What asks begins with the span, or at a word of it that asks.
            let (words, keys) = (word_ranges(span), word_keys(span));
            let led = is_reported(&word_keys(&text[..start]));
            let at_once = |n: usize| {
                let reported = is_reported(&keys[..n]) || n == 0 && led;
                let joint = reported && JOINTS.contains(&keys[n].as_str());
                // "I was told by the nurse …": who tells is no place of what is told.
                let is_agent = reported && n > 0 && keys[n] == "by";
                // «Собираюсь заваривать чай, а где чайник?»: an activity alone does not ask, and "what's" is one word.
                let activity =
                    matches!(vocabulary::longest(&keys[n..]), Some((_, Mark::Activity(_))));
                let cuts = span[..words[n].start].ends_with(['\'', '’']);
                let asks = keys[n] != "ли" && !activity && opening::asks_at_once(&keys[n..]);
                // "And in the other one?" asks of no other one by itself.
                let is_link = |n: usize| {
                    matches!(vocabulary::longest(&keys[n..=n]), Some((_, Mark::Link(_))))
                };
                let article = n > 0 && set!("TheOrA").contains(&keys[n - 1].as_str());
                let before = n.checked_sub(1 + usize::from(article));
                let governs = !reported && before.is_some_and(is_link);
                let cuts = cuts || governs;
                !joint && !is_agent && !cuts && (n == 0 || reported || asks)
            };
            let begins = (0..words.len().min(MOST_WORDS)).filter(|n| at_once(*n));
            for begin in begins.map(|n| words[n].start) {
                let asked = &span[begin..];
                // "Is there a coke left? I'm dying of thirst, anything to drink": what is marked is asked.
                let marks = |n: usize| marked(n) && parts[n].1 > start + begin;
                if any_marked && !(from..=to).any(marks) {
                    continue;
                }
                if begin > 0 && goes_on(&text[..start + begin], asked) {
                    continue;
                }
                let before = word_keys(&text[..start + begin]);
                let reported = is_reported(&before);
                let lead = &text[..start + begin];
                let (lead, within) = match reported {
                    true => (without_joint(lead), without_joint(&span[..begin])),
                    false => (lead, &span[..begin]),
                };
                let aside = [lead, &text[end..]];
                // Whether a claim is true is asked where somebody makes it, or where it is begged to be told.
                let begs = |text: &&str| parts_of(text).any(|part| only_begs(&word_keys(part)));
                let whether = matches!(before.last().map(String::as_str), Some("if" | "whether"));
                let claimed = reported && (whether || self.asks(text)) || aside.iter().any(begs);
                if asked.len() == text.trim().len() || !(self.asks(asked) || claimed) {
                    continue;
                }
                let Some(told) = self.told_aside(&aside, asked, memory) else { break };
                // "Is there a mug anywhere else?" without its "is" is another question.
                if self.says_something(within) || !self.asks_of_something(asked) {
                    continue;
                }
                // «Сижу в гостиной, скучно, что тут …?»: "here" is where the person is, or nowhere.
                let placed = told.place.is_some() || told.named.places.is_empty();
                if premise::says_here(asked) && !placed {
                    continue;
                }
                let asks_it = several::without_tag(asked);
                let mut pronouns = self.pronouns(asks_it);
                // "it is" is read as nothing by itself.
                if pronouns.is_empty() && word_keys(asks_it).iter().any(|key| key == "it") {
                    pronouns.push(Pronoun::Any);
                }
                if !told.named.may_be_meant(&pronouns) {
                    // «Телефон потерялся, где он?» of two: which one is asked back.
                    if doubted.is_none()
                        && let Some(doubt) = told.named.several_of_one()
                    {
                        doubted = Some(Box::new((doubt, None)));
                    }
                    continue;
                }
                let mut heard = memory.clone();
                told.named.heard(&mut heard);
                if let Some(words) = &told.astray {
                    Self::lose_person(words, &mut heard);
                }
                if let Some(place) = &told.place {
                    self.hear_of_place(place, &mut heard);
                }
                // "… which bins do we have, and where are they?"
                let placed = told.place.is_some();
                let parts = || self.each_part(asked, language, &mut heard.clone());
                let answered = match (!placed).then(parts).flatten() {
                    Some(Ok(answer)) => Ok(answer),
                    _ => self.answer_at(told.place.as_ref(), asked, language, &heard),
                };
                match answered {
                    // What was never seen is no doubt of the words.
                    Ok(answer)
                        if answer.said == Said::Unknown
                            && !matches!(answer.query, Query::LastSeen(_)) =>
                    {
                        if matches!(answer.query, Query::Property { .. }) {
                            untold.get_or_insert(answer.understood_as(asked, language));
                        }
                    }
                    // A claim that somebody makes is true or not.
                    Ok(answer)
                        if claimed
                            && !self.asks(asked)
                            && !matches!(answer.said, Said::Yes | Said::No) => {}
                    // «Мне срочно надо в туалет, как пройти из кухни?»: whither was told, and came to nothing.
                    Ok(answer)
                        if !told.named.places.is_empty()
                            && !placed
                            && !matches!(answer.query, Query::Way { .. })
                            && self.asks_the_way(asked) => {}
                    Ok(answer) => match self.heeding(&aside, answer, &heard) {
                        Ok(answer) => return Some(Ok(answer.understood_as(asked, language))),
                        Err(doubt) => doubted = doubted.or(Some(Box::new((doubt, None)))),
                    },
                    Err(unanswered) if self.is_understood(&unanswered.0) => {
                        doubted.get_or_insert(unanswered);
                    }
                    Err(_) => {}
                }
            }
        }
        doubted.map(Err).or(untold.map(Ok))
    }

    /// Whether a doubt is none of the words: they are understood, and the map has several such things, or none.
    fn is_understood(&self, doubt: &Doubt) -> bool {
        match doubt {
            Doubt::Ambiguous { .. } | Doubt::NoneSuch { .. } => true,
            Doubt::Unknown { reference, .. } => self.is_word(reference),
            _ => false,
        }
    }

    /// What is told in what is left aside; none where it does more than tell.
    fn told_aside(&self, aside: &[&str], asked: &str, memory: &Memory) -> Option<Told> {
        let mut told = Told::default();
        for text in aside {
            for (from, to) in parts(text) {
                // "Which is closer to the pantry, …?": no clause stands before it that it could go on from.
                let begins = std::ptr::eq(*text, aside[0]) && from == 0;
                let asks = |key: &String| set!("AskingWord").contains(&key.as_str());
                if begins && word_keys(&text[..to]).first().is_some_and(asks) {
                    return None;
                }
                // «Мне сказали, что тостер сломался, где он?»: what somebody says is told, and asks for nothing.
                let part = match is_reported(&word_keys(&text[..from])) {
                    true => behind_joint(&text[from..to]),
                    false => &text[from..to],
                };
                match self.premise(part) {
                    Some(place) if told.place.is_none() => told.place = Some(place),
                    Some(_) => return None,
                    None if self.narrows(part, asked) => return None,
                    None => {
                        told.named.add(self.names_only(part, memory)?);
                        if self.is_astray(part) {
                            told.astray = Some(part.to_owned());
                        }
                    }
                }
            }
        }
        Some(told)
    }

    /// A line without an "or" before or behind which a person only doubts of itself: "Is it me or …?", «Мне кажется или …?»,
    /// "… or am I seeing things?"
    pub(super) fn without_self_doubt<'t>(&self, text: &'t str) -> Option<&'t str> {
        let (words, keys) = (word_ranges(text), word_keys(text));
        let or = |key: &String| set!("OrWord").contains(&key.as_str());
        let (first, last) = (keys.iter().position(or)?, keys.iter().rposition(or)?);
        let behind = |at: usize| words.get(at + 1).map_or("", |word| &text[word.start..]);
        let tail = behind(first);
        let asks = match Language::of(text) {
            Language::English => opening::begins_question(&word_keys(tail)),
            Language::Russian => word_keys(tail).len() > 1,
        };
        if asks && self.doubts_of_me(&text[..words[first].start]) {
            return Some(tail);
        }
        let head = text[..words[last].start].trim_end_matches([' ', ',', '–', '—']);
        (last > 1 && self.doubts_of_me(behind(last))).then_some(head)
    }

    /// «мне кажется», "am I seeing things": of the person and of nothing that the map may have.
    fn doubts_of_me(&self, text: &str) -> bool {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let of_me = |item: &Item| match item {
            Item::Mark(mark) => *mark == Mark::Me,
            Item::Noun(phrase) => phrase.person == Some(Mark::Me),
            _ => false,
        };
        let memory = Memory::default();
        let knowledge = self.knowledge(sentence.language, &memory);
        let idle = |item: &Item| match item {
            Item::Unknown(words) => !self.is_word(sentence.said(words)),
            Item::Noun(phrase) => {
                let bare = phrase.noun.restrictions.is_empty() && phrase.noun.filters.is_empty();
                phrase.pronoun == Some(Pronoun::Any)
                    || bare && knowledge.is_anything(&phrase.noun.head)
            }
            Item::Mark(mark) => matches!(
                mark,
                Mark::Filler | Mark::The | Mark::Be | Mark::Lead | Mark::See | Mark::Not
            ),
            _ => false,
        };
        let items = sentence.items();
        items.iter().any(of_me) && items.iter().all(|item| of_me(item) || idle(item))
    }

    pub(super) fn asks(&self, text: &str) -> bool {
        let words = word_keys(text);
        let whether = |last: &[String]| set!("OrNot").contains(&last.join(" ").as_str());
        opening::begins_question(&words)
            || tells_me(&words)
            || several::asks_in(text)
            || text.trim().ends_with('?')
            || words.last_chunk::<2>().is_some_and(|last| whether(last))
    }

    /// Whether a text asks how to get somewhere.
    pub(super) fn asks_the_way(&self, text: &str) -> bool {
        let plain = self.plain(text);
        Sentence::new(&plain, &self.mind.lexicon).items().contains(&Item::Mark(Mark::HowGet))
    }

    /// Whether a question names what it is about beside the noun of its question word, or what is done.
    #[must_use]
    pub fn asks_of_something(&self, text: &str) -> bool {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let items = sentence.items();
        // "… any idea where it is?"
        let is_it = |n: usize| {
            let said = vocabulary::longest(&sentence.keys[n..=n]);
            matches!(said, Some((_, Mark::Pronoun(_))))
        };
        let points = !items.is_empty() && (0..sentence.keys.len()).any(is_it);
        points
            || (0..items.len()).any(|n| match &items[n] {
                Item::Noun(phrase) if phrase.person.is_none_or(|who| who == Mark::There) => {
                    !matches!(n.checked_sub(1).map(|n| &items[n]), Some(Item::Mark(Mark::Which)))
                }
                Item::Place { .. } => n > 0,
                Item::Unknown(words) => self.is_word(sentence.said(words)),
                Item::Mark(mark) => {
                    matches!(mark, Mark::Activity(_) | Mark::Sit | Mark::LieDown | Mark::PutDown)
                }
                _ => false,
            })
    }

    /// Whether words before a question belong to it: anything but small and unknown ones, and those that beg to be told.
    fn says_something(&self, text: &str) -> bool {
        let plain = self.plain(text);
        let begs = word_keys(text).iter().any(|key| tells(key));
        let small = |item: &Item| {
            matches!(
                item,
                Item::Unknown(_)
                    | Item::Mark(
                        Mark::Filler
                            | Mark::But
                            | Mark::The
                            | Mark::A
                            | Mark::You
                            | Mark::Me
                            | Mark::And
                    )
            ) || matches!(item, Item::Noun(phrase) if phrase.person.is_some())
                || begs && matches!(item, Item::Mark(Mark::Can | Mark::See | Mark::Be | Mark::Have))
        };
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        // "Sorry to bother you, …", but «С чем граничит …?»
        // "Somebody told me …"
        let nobody = !several::asks_outright(text);
        // "They claim that …" means nobody who was spoken of.
        let says = is_reported(&word_keys(text));
        let small = |item: &Item| {
            small(item)
                || nobody && *item == Item::Mark(Mark::Who)
                || says && matches!(item, Item::Noun(phrase) if phrase.pronoun.is_some())
                // "I was told that …", "I have heard that …", "I could swear that …"
                || says && matches!(item, Item::Mark(Mark::Be | Mark::Have | Mark::See | Mark::Can))
        };
        let governs = matches!(items.last(), Some(Item::Link(_)));
        governs || !items.iter().all(|item| small(item) || matches!(item, Item::Link(_)))
    }
}

/// A text without the words at its end that only join what is said: «Жена говорит, что».
fn without_joint(text: &str) -> &str {
    let (words, keys) = (word_ranges(text), word_keys(text));
    let joints = keys.iter().rev().take_while(|key| JOINTS.contains(&key.as_str())).count();
    let kept = words.len().checked_sub(joints + 1).and_then(|last| words.get(last));
    kept.map_or("", |last| &text[..last.end])
}

/// "Tell me the door is locked", «скажи, дверь заперта»: who begs so asks whether.
fn tells_me(keys: &[String]) -> bool {
    match keys {
        [first, second, _, _, ..] => {
            first == "tell" && (second == "me" || second == "us")
                || set!("TellStemOrLook").iter().any(|verb| first.starts_with(verb))
        }
        _ => false,
    }
}
