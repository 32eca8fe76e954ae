//! What asks within a line that is not understood as a whole: "hmm, no idea what time it is, is there a clock?"
//!
//! Invariant: what is left aside limits nothing, asks nothing, and tells no number, no value and no place but the person's;
//! a thing that it names is spoken of; and what was understood is said with the answer.

use super::grammar::{Item, Sentence};
use super::mark::{Mark, Pronoun};
use super::{Answer, Asker, Memory, Noun, Said, Thing, opening, several, vocabulary};
use crate::words::{Language, word_keys, word_ranges};

/// What the parts of a line tell that do not ask.
#[derive(Default)]
struct Told {
    /// Where the person says to be.
    place: Option<Noun>,
    /// What they name.
    things: Vec<Thing>,
}

/// A line of more parts than this is not chatter.
const MOST_PARTS: usize = 8;
/// Nor one with more words before what asks.
const MOST_WORDS: usize = 12;

impl Asker<'_> {
    /// The answer to the one part of a line that asks, with what was understood before it.
    pub(super) fn salvaged(
        &self,
        text: &str,
        language: Language,
        memory: &Memory,
    ) -> Option<Answer> {
        let parts = parts(text);
        if parts.len() > MOST_PARTS {
            return None;
        }
        let spans = (0..parts.len()).flat_map(|from| (from..parts.len()).map(move |to| (from, to)));
        let mut spans: Vec<(usize, usize)> = spans.collect();
        spans.sort_by_key(|(from, to)| (parts.len() - (to - from), *from));
        // Where a part ends as questions do, that is what asks.
        let marked = |n: usize| {
            let part = &text[parts[n].0..parts[n].1];
            part.ends_with('?') && !only_begs(&word_keys(part))
        };
        let any_marked = (0..parts.len()).any(marked);
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
            let at_once = |n: usize| n == 0 || keys[n] != "ли" && opening::asks_at_once(&keys[n..]);
            let begins = (0..words.len().min(MOST_WORDS)).filter(|n| at_once(*n));
            for begin in begins.map(|n| words[n].start) {
                let asked = &span[begin..];
                let aside = [&text[..start + begin], &text[end..]];
                if asked.len() == text.trim().len() || !self.asks(asked) {
                    continue;
                }
                let Some(told) = self.told_aside(&aside, memory) else { break };
                // "Is there a mug anywhere else?" without its "is" is another question.
                if self.says_something(&span[..begin]) || !self.asks_of_something(asked) {
                    continue;
                }
                // A pronoun may mean what was not understood; "it" is none of several.
                let means = |pronouns: &[Pronoun]| match told.things.len() {
                    0 => pronouns.is_empty(),
                    1 => true,
                    _ => pronouns.iter().all(|p| matches!(p, Pronoun::They | Pronoun::There)),
                };
                if !means(&self.pronouns(asked)) {
                    continue;
                }
                let mut heard = memory.clone();
                heard.list(&told.things);
                if let Some(place) = &told.place {
                    self.hear_of_place(place, &mut heard);
                }
                let answer = self.answer_at(told.place.as_ref(), asked, language, &heard);
                let Ok(answer) = answer else { continue };
                if answer.said == Said::Unknown {
                    continue;
                }
                return Some(answer.understood_as(asked, language));
            }
        }
        None
    }

    /// What is told in what is left aside; none where it does more than tell.
    fn told_aside(&self, aside: &[&str], memory: &Memory) -> Option<Told> {
        let mut told = Told::default();
        for text in aside {
            for (from, to) in parts(text) {
                let part = &text[from..to];
                match self.premise(part) {
                    Some(place) if told.place.is_none() => told.place = Some(place),
                    Some(_) => return None,
                    None => told.things.extend(self.names_only(part, memory)?),
                }
            }
        }
        Some(told)
    }

    fn asks(&self, text: &str) -> bool {
        let words = word_keys(text);
        let whether =
            |last: &[String]| ["или нет", "или не", "or not"].contains(&last.join(" ").as_str());
        opening::begins_question(&words)
            || several::asks_in(text)
            || text.trim().ends_with('?')
            || words.last_chunk::<2>().is_some_and(|last| whether(last))
    }

    /// Whether a question names what it is about beside the noun of its question word, or what is done.
    fn asks_of_something(&self, text: &str) -> bool {
        let plain = self.plain(text);
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        (0..items.len()).any(|n| match &items[n] {
            Item::Noun(phrase) if phrase.person.is_none() => {
                !matches!(n.checked_sub(1).map(|n| &items[n]), Some(Item::Mark(Mark::Which)))
            }
            Item::Place { .. } => n > 0,
            Item::Mark(mark) => {
                matches!(mark, Mark::Deed(_) | Mark::Sit | Mark::LieDown | Mark::PutDown)
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
                        Mark::Filler | Mark::The | Mark::A | Mark::You | Mark::Me | Mark::And
                    )
            ) || matches!(item, Item::Noun(phrase) if phrase.person.is_some())
                || begs && matches!(item, Item::Mark(Mark::Can | Mark::See | Mark::Be | Mark::Have))
        };
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        // "Sorry to bother you, …", but «С чем граничит …?»
        let governs = matches!(items.last(), Some(Item::Link(_)));
        governs || !items.iter().all(|item| small(item) || matches!(item, Item::Link(_)))
    }

    /// The things that a part of a line names which supposes nothing, excepts nothing and asks nothing; none of one that
    /// does.
    pub(super) fn names_only(&self, text: &str, memory: &Memory) -> Option<Vec<Thing>> {
        const LIMITS: [&str; 18] = [
            "если",
            "когда",
            "пока",
            "кроме",
            "без",
            "допустим",
            "представь",
            "пусть",
            "if",
            "when",
            "while",
            "except",
            "but",
            "without",
            "unless",
            "suppose",
            "assuming",
            "imagine",
        ];
        let keys = word_keys(text);
        let (last, before) = match keys.split_last() {
            None => return Some(Vec::new()),
            Some((last, before)) => (last, before),
        };
        // "Sorry to bother you, but …" limits nothing; "all but …" does.
        let joint = |key: &String| matches!(key.as_str(), "but") && before.len() > 2;
        // "If you don't mind" supposes nothing.
        const POLITE: [&str; 13] = [
            "mind",
            "please",
            "possible",
            "ok",
            "okay",
            "alright",
            "может",
            "можете",
            "секрет",
            "можно",
            "трудно",
            "сложно",
            "против",
        ];
        let polite = matches!(keys[0].as_str(), "if" | "если")
            && keys.iter().any(|key| POLITE.contains(&key.as_str()));
        let limits = |key: &String| LIMITS.contains(&key.as_str()) && !joint(key);
        if !polite && before.iter().chain([last]).any(limits) {
            return None;
        }
        // «Почитать бы чего» wishes; who begs to be told asks nothing more: «не подскажешь?»
        let wishes = keys.iter().any(|key| key == "бы" || key == "б");
        let begs = only_begs(&keys);
        if several::asks_in(text) && !wishes && !begs {
            return None;
        }
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let knowledge = self.knowledge(sentence.language, memory);
        let mut things = Vec::new();
        for item in sentence.items() {
            let named = match item {
                Item::Mark(Mark::Other | Mark::All) => return None,
                Item::Noun(phrase) => vec![phrase],
                Item::Place { nouns, .. } => nouns,
                _ => Vec::new(),
            };
            for phrase in named.iter().filter(|p| p.person.is_none() && p.pronoun.is_none()) {
                // "The one in the hall" is among what was spoken of.
                if phrase.noun.head.anything {
                    return None;
                }
                let noun = Noun { plural: true, ..phrase.noun.clone() };
                things.extend(knowledge.find(&noun, true).unwrap_or_default());
            }
        }
        Some(things)
    }
}

/// Whether a part of a line is a clause of what stands before it: «ту, что на кухне», "bigger, than …".
fn goes_on(before: &str, part: &str) -> bool {
    const POINTING: [&str; 15] = [
        "то",
        "тот",
        "та",
        "те",
        "ту",
        "того",
        "той",
        "тех",
        "тем",
        "тому",
        "том",
        "one",
        "ones",
        "those",
        "everything",
    ];
    let (keys, told) = (word_keys(part), word_keys(before));
    match keys.first().map(String::as_str) {
        Some("чем" | "than") => (0..told.len()).any(|n| {
            matches!(vocabulary::longest(&told[n..]), Some((_, Mark::More(_) | Mark::Nearer(_))))
        }),
        Some("что" | "which" | "that") => {
            told.last().is_some_and(|last| POINTING.contains(&last.as_str()))
        }
        Some(first) => first.starts_with("котор") && !told.is_empty(),
        None => false,
    }
}

/// «не подскажешь?», "do you know?": a part that asks for nothing of its own.
fn only_begs(keys: &[String]) -> bool {
    keys.len() < 5 && keys.iter().any(|key| tells(key))
}

/// Whether a word is one of telling or knowing, by which a question is led in: "could you maybe tell me …".
fn tells(key: &str) -> bool {
    const VERBS: [&str; 20] = [
        "tell",
        "say",
        "show",
        "remind",
        "know",
        "knows",
        "check",
        "see",
        "explain",
        "wondering",
        "wonder",
        "idea",
        "ask",
        "remember",
        "guess",
        "знаешь",
        "знаете",
        "знать",
        "asked",
        "reckon",
    ];
    const STEMS: [&str; 12] = [
        "скаж",
        "подскаж",
        "напомн",
        "покаж",
        "глян",
        "посмотр",
        "провер",
        "сообщ",
        "узна",
        "спрос",
        "объясн",
        "помн",
    ];
    VERBS.contains(&key) || STEMS.iter().any(|stem| key.starts_with(stem))
}

/// The parts of a line between its marks, by their bytes.
fn parts(text: &str) -> Vec<(usize, usize)> {
    let mut parts = Vec::new();
    let mut from = 0;
    let ends = text.char_indices().filter(|(at, c)| {
        // "Quick one: …", but "10:30"
        let ends = *c == ':' && text[at + 1..].starts_with(' ');
        ends || matches!(c, ',' | ';' | '.' | '!' | '?' | '…' | '–' | '—')
    });
    let ends = ends.map(|(at, mark)| (at, at + mark.len_utf8())).chain([(text.len(), text.len())]);
    for (end, next) in ends {
        let part = &text[from..end];
        let lead = part.len() - part.trim_start().len();
        if !part.trim().is_empty() {
            let closes = text[end..next].trim().starts_with('?');
            parts.push((from + lead, if closes { next } else { from + part.trim_end().len() }));
        }
        from = next;
    }
    parts
}
