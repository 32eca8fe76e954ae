//! What asks within a line that is not understood as a whole: "hmm, no idea what time it is, is there a clock?"
//!
//! Invariant: what is left aside limits nothing, asks nothing, and tells no number, no value and no place but the person's;
//! a thing that it names is spoken of; and what was understood is said with the answer.

use super::grammar::{Item, Sentence};
use super::mark::{Mark, Pronoun};
use super::{
    Asker, Doubt, Memory, Noun, Outcome, Query, Said, Thing, opening, premise, several, vocabulary,
};
use crate::command::is_order;
use crate::words::{Language, is_first_person, word_keys, word_ranges};

/// What the parts of a line tell that do not ask.
#[derive(Default)]
struct Told {
    /// Where the person says to be.
    place: Option<Noun>,
    /// What they name.
    named: Named,
}

/// What a part of a line names that asks nothing.
#[derive(Default)]
pub(super) struct Named {
    pub(super) things: Vec<Thing>,
    /// What is named as a place.
    places: Vec<Thing>,
    /// Whether a thing was called by a plural: «таблетки» may be one.
    plural: bool,
    /// The words that named all the things.
    reference: Option<String>,
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
        let parted = self.without_interjection(text);
        let tailless = self.without_idle_tail(parted.as_deref().unwrap_or(text));
        let shortened = tailless.or(parted);
        let (text, whole) = (shortened.as_deref().unwrap_or(text), shortened.is_some());
        let parts = parts(text);
        if parts.len() > MOST_PARTS {
            return None;
        }
        let spans = (0..parts.len()).flat_map(|from| (from..parts.len()).map(move |to| (from, to)));
        let mut spans: Vec<(usize, usize)> = spans.collect();
        spans.sort_by_key(|(from, to)| (parts.len() - (to - from), *from));
        // Where a part ends as questions do, that is what asks; but for one by which a person is polite or begs.
        let marked = |n: usize| {
            let part = &text[parts[n].0..parts[n].1];
            let keys = word_keys(part);
            part.ends_with('?') && !only_begs(&keys) && !is_polite(&keys)
        };
        let any_marked = (0..parts.len()).any(marked);
        let mut doubted = None;
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
                // «Собираюсь заваривать чай, а где чайник?»: a deed by itself does not ask, and "what's" is one word.
                let deed = matches!(vocabulary::longest(&keys[n..]), Some((_, Mark::Deed(_))));
                let cuts = span[..words[n].start].ends_with(['\'', '’']);
                let asks = keys[n] != "ли" && !deed && opening::asks_at_once(&keys[n..]);
                !joint && !cuts && (n == 0 || reported || asks)
            };
            let begins = (0..words.len().min(MOST_WORDS)).filter(|n| at_once(*n));
            for begin in begins.map(|n| words[n].start) {
                let asked = &span[begin..];
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
                if asked.len() == text.trim().len() && !whole || !(self.asks(asked) || claimed) {
                    continue;
                }
                let Some(told) = self.told_aside(&aside, memory) else { break };
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
                if let Some(place) = &told.place {
                    self.hear_of_place(place, &mut heard);
                }
                match self.answer_at(told.place.as_ref(), asked, language, &heard) {
                    // What was never seen is no doubt of the words.
                    Ok(answer)
                        if answer.said == Said::Unknown
                            && !matches!(answer.query, Query::LastSeen(_)) => {}
                    // A claim that somebody makes is true or not.
                    Ok(answer)
                        if claimed
                            && !self.asks(asked)
                            && !matches!(answer.said, Said::Yes | Said::No) => {}
                    Ok(answer) => return Some(Ok(answer.understood_as(asked, language))),
                    Err(unanswered) if self.is_understood(&unanswered.0) => {
                        doubted.get_or_insert(unanswered);
                    }
                    // "… which bins do we have, and where are they?"
                    Err(_) => match self.each_part(asked, language, &mut heard) {
                        Some(Ok(answer)) if told.place.is_none() => {
                            return Some(Ok(answer.understood_as(asked, language)));
                        }
                        _ => {}
                    },
                }
            }
        }
        doubted.map(Err)
    }

    /// Whether a doubt is none of the words: they are understood, and the map has several such things, or none.
    fn is_understood(&self, doubt: &Doubt) -> bool {
        match doubt {
            Doubt::Ambiguous { .. } => true,
            Doubt::Unknown { reference, .. } => self.is_word(reference),
            _ => false,
        }
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
                    None => told.named.add(self.names_only(part, memory)?),
                }
            }
        }
        Some(told)
    }

    /// A question without what is thrown in behind its question word: «Какого, блин, цвета …?», "Where, pray tell, is …?"
    fn without_interjection(&self, text: &str) -> Option<String> {
        const MOST: usize = 3;
        let parts = parts(text);
        let [(from, first), (thrown, last), (rest, _), ..] = parts[..] else { return None };
        let items = |part: &str| {
            let plain = self.plain(part);
            Sentence::new(&plain, &self.mind.lexicon).items()
        };
        let asks = items(&text[from..first]).iter().all(|item| matches!(item, Item::Mark(_)))
            && opening::begins_question(&word_keys(&text[from..first]));
        let thrown = &text[thrown..last];
        let says_nothing = |item: &Item| match item {
            Item::Unknown(_) => true,
            Item::Mark(mark) => matches!(mark, Mark::Filler | Mark::You | Mark::Me),
            _ => false,
        };
        let idle = word_keys(thrown).len() <= MOST
            && !thrown.ends_with('?')
            && !self.is_word(thrown)
            && items(thrown).iter().all(says_nothing);
        (asks && idle).then(|| format!("{} {}", &text[from..first], &text[rest..]))
    }

    /// A line without an "or" at its end that puts nothing of the map for choice: "…, or shall I get up?", «… или всё
    /// съели?»
    fn without_idle_tail(&self, text: &str) -> Option<String> {
        let (words, keys) = (word_ranges(text), word_keys(text));
        let or = keys.iter().rposition(|key| matches!(key.as_str(), "или" | "or" | "либо"))?;
        let tail = text.get(words.get(or + 1)?.start..)?;
        // «или нет» belongs to what is asked.
        let is_idle = |word: &String| matches!(word.as_str(), "what" | "что" | "как" | "чего");
        let or_what = matches!(&word_keys(tail)[..], [only] if is_idle(only));
        if or < 2 || word_keys(tail).len() < 2 && !or_what {
            return None;
        }
        let plain = self.plain(tail);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let idle = |item: &Item| match item {
            Item::Unknown(_) => true,
            Item::Noun(phrase) => phrase.person.is_some() && phrase.person != Some(Mark::There),
            Item::Mark(mark) => matches!(
                mark,
                Mark::Filler
                    | Mark::The
                    | Mark::And
                    | Mark::Me
                    | Mark::You
                    | Mark::Be
                    | Mark::Can
                    | Mark::Cannot
                    | Mark::Must
                    | Mark::All
                    | Mark::Move
                    | Mark::What
                    | Mark::Who
                    | Mark::Have
            ),
            _ => false,
        };
        let items = sentence.items();
        let says = items.iter().any(|item| !matches!(item, Item::Mark(Mark::Filler | Mark::The)));
        (says && items.iter().all(idle)).then(|| {
            let kept = text[..words[or].start].trim_end_matches([' ', ',', '–', '—', '.', '…']);
            format!("{kept}?")
        })
    }

    fn asks(&self, text: &str) -> bool {
        let words = word_keys(text);
        let whether =
            |last: &[String]| ["или нет", "или не", "or not"].contains(&last.join(" ").as_str());
        opening::begins_question(&words)
            || tells_me(&words)
            || several::asks_in(text)
            || text.trim().ends_with('?')
            || words.last_chunk::<2>().is_some_and(|last| whether(last))
    }

    /// Whether a question names what it is about beside the noun of its question word, or what is done.
    fn asks_of_something(&self, text: &str) -> bool {
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
                Item::Noun(phrase) if phrase.person.is_none() => {
                    !matches!(n.checked_sub(1).map(|n| &items[n]), Some(Item::Mark(Mark::Which)))
                }
                Item::Place { .. } => n > 0,
                Item::Unknown(words) => self.is_word(sentence.said(words)),
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
        // "Somebody told me …"
        let nobody = !several::asks_outright(text);
        // "They claim that …" means nobody who was spoken of.
        let says = is_reported(&word_keys(text));
        let small = |item: &Item| {
            small(item)
                || nobody && *item == Item::Mark(Mark::Who)
                || says && matches!(item, Item::Noun(phrase) if phrase.pronoun.is_some())
        };
        let governs = matches!(items.last(), Some(Item::Link(_)));
        governs || !items.iter().all(|item| small(item) || matches!(item, Item::Link(_)))
    }

    /// Whether a part of a line is no clause of the person's, and denies, excepts, compares or counts: «не открывая дверей»,
    /// "apart from the kitchen", «тяжелее килограмма». What is asked beside it is asked within those bounds.
    pub(super) fn limits(&self, text: &str) -> bool {
        let keys = word_keys(text);
        let says = |key: &String| is_first_person(key);
        if keys.is_empty() || opening::is_of_me(&keys) || keys.iter().any(says) || is_polite(&keys)
        {
            return false;
        }
        let plain = self.plain(text);
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        let of_person = |item: &Item| match item {
            Item::Mark(mark) => matches!(mark, Mark::Me | Mark::You | Mark::Be | Mark::Can),
            Item::Noun(phrase) => phrase.person.is_some(),
            _ => false,
        };
        // «короче» alone only hesitates.
        let compares = items.len() > 1;
        let bounds = |item: &Item| match item {
            Item::Mark(
                Mark::Except | Mark::Avoiding | Mark::Unopened | Mark::Without | Mark::Directly,
            ) => true,
            Item::Mark(Mark::Number(_) | Mark::OnlyOne | Mark::More(_) | Mark::Nearer(_)) => {
                compares
            }
            _ => false,
        };
        // «Не открывая дверей», but «нет» and «не утюг, а чайник».
        let denies = matches!(items.first(), Some(Item::Mark(Mark::Not)))
            && items.len() > 1
            && withdrawn(&items).is_none();
        !items.iter().any(of_person) && (denies || items.iter().any(bounds))
    }

    /// What a part of a line names which supposes nothing, excepts nothing and asks nothing; none of one that does.
    pub(super) fn names_only(&self, text: &str, memory: &Memory) -> Option<Named> {
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
            None => return Some(Named::default()),
            Some((last, before)) => (last, before),
        };
        if self.limits(text) {
            return None;
        }
        // "Sorry to bother you, but …" limits nothing; "all but …" does.
        let joint = |key: &String| matches!(key.as_str(), "but") && before.len() > 2;
        let limits = |key: &String| LIMITS.contains(&key.as_str()) && !joint(key);
        if !is_polite(&keys) && before.iter().chain([last]).any(limits) {
            return None;
        }
        // «Почитать бы чего» wishes; who begs to be told asks nothing more: «не подскажешь?»
        let wishes = keys.iter().any(|key| key == "бы" || key == "б");
        let begs = only_begs(&keys);
        let seeks = several::seeks(text);
        let tells = tells_there_is(text, &keys) || is_own_clause(&keys) || seeks;
        if several::asks_outright(text) && !wishes && !begs && !tells {
            return None;
        }
        // «Ту, что в комоде, достань» orders.
        if is_order(text) && !begs && !seeks {
            return None;
        }
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let knowledge = self.knowledge(sentence.language, memory);
        let mut named = Named::default();
        let items = sentence.items();
        // «Я всё перепутал», "I forgot it all": of the person, and of no thing.
        let names = items.iter().any(|item| match item {
            Item::Noun(phrase) => phrase.person.is_none() && phrase.pronoun.is_none(),
            Item::Place { .. } => true,
            _ => false,
        });
        let of_me = !names && opening::is_of_me(&keys);
        // "Not the armchair, the sofa": what is withdrawn is not spoken of.
        if withdrawn(&items).is_some() {
            return Some(named);
        }
        for item in items {
            let (phrases, is_place) = match item {
                Item::Mark(Mark::All) if of_me => (Vec::new(), false),
                Item::Mark(Mark::Other | Mark::All | Mark::Detail(_)) => return None,
                Item::Noun(phrase) => (vec![phrase], false),
                Item::Place { nouns, .. } => (nouns, true),
                _ => (Vec::new(), false),
            };
            for phrase in phrases.iter().filter(|p| p.person.is_none() && p.pronoun.is_none()) {
                // "The one in the hall" is among what was spoken of.
                if phrase.noun.head.anything {
                    return None;
                }
                let noun = Noun { plural: true, ..phrase.noun.clone() };
                let found = knowledge.find(&noun, true).unwrap_or_default();
                if is_place {
                    named.places.extend(found);
                } else {
                    let first = named.things.is_empty() && found.len() > 1;
                    named.reference = first.then(|| phrase.noun.text.clone());
                    named.things.extend(found);
                    // "I fancy an apple, where are they?"
                    named.plural |= phrase.noun.plural || phrase.noun.indefinite;
                }
            }
        }
        Some(named)
    }
}

impl Named {
    fn add(&mut self, other: Self) {
        self.reference = match (self.things.is_empty(), other.things.is_empty()) {
            (true, _) => other.reference,
            (_, true) => self.reference.take(),
            _ => None,
        };
        self.things.extend(other.things);
        self.places.extend(other.places);
        self.plural |= other.plural;
    }

    /// What a pronoun but "there" may mean.
    fn spoken(&self) -> &[Thing] {
        if self.things.is_empty() { &self.places } else { &self.things }
    }

    /// Whether pronouns may mean what was named and not understood: "it" is none of several, "there" is one place.
    fn may_be_meant(&self, pronouns: &[Pronoun]) -> bool {
        match self.spoken().len() {
            0 => pronouns.is_empty(),
            1 => true,
            _ => pronouns.iter().all(|p| matches!(p, Pronoun::They | Pronoun::There)),
        }
    }

    /// The doubt which of several is meant that one word in the singular named.
    fn several_of_one(&self) -> Option<Doubt> {
        let reference = self.reference.clone().filter(|_| !self.plural)?;
        Some(Doubt::Ambiguous { reference, candidates: self.things.clone() })
    }

    /// Notes what was named.
    fn heard(&self, memory: &mut Memory) {
        memory.list(self.spoken());
        memory.is_plural |= self.plural;
        if let [place] = self.places[..] {
            memory.told_place = Some(place);
        }
    }
}

/// What a part of a line takes back: «нет, не утюг», "not the armchair".
fn withdrawn(items: &[Item]) -> Option<&Item> {
    let mut rest = items.iter().skip_while(|item| {
        matches!(item, Item::Mark(Mark::Not | Mark::The | Mark::A | Mark::And | Mark::Filler))
    });
    let denies = items.iter().any(|item| *item == Item::Mark(Mark::Not));
    let only = rest.next().filter(|_| denies && rest.next().is_none())?;
    matches!(only, Item::Noun(_) | Item::Unknown(_)).then_some(only)
}

/// "If you don't mind", «если не секрет», "while you're at it": who says so is polite, and supposes nothing.
fn is_polite(keys: &[String]) -> bool {
    const POLITE: [&str; 23] = [
        "remember",
        "recall",
        "wrong",
        "mistaken",
        "ошибаюсь",
        "помню",
        "mind",
        "please",
        "possible",
        "ok",
        "okay",
        "alright",
        "trouble",
        "bother",
        "может",
        "можете",
        "секрет",
        "можно",
        "трудно",
        "сложно",
        "против",
        "затруднит",
        "сложности",
    ];
    let said = keys.join(" ");
    match keys.first().map(String::as_str) {
        Some("if" | "если") => keys.iter().any(|key| POLITE.contains(&key.as_str())),
        Some("while" | "since") => {
            said.contains(" you re at it") || said.contains(" you are at it")
        }
        _ => false,
    }
}

/// Words between who says something and what is said.
const JOINTS: [&str; 9] = ["that", "me", "us", "что", "будто", "мне", "нам", "if", "whether"];

/// A text without the words at its end that only join what is said: «Жена говорит, что».
fn without_joint(text: &str) -> &str {
    let (words, keys) = (word_ranges(text), word_keys(text));
    let joints = keys.iter().rev().take_while(|key| JOINTS.contains(&key.as_str())).count();
    let kept = words.len().checked_sub(joints + 1).and_then(|last| words.get(last));
    kept.map_or("", |last| &text[..last.end])
}

/// Whether words end by telling that somebody says or thinks what follows: «муж говорит, что», "my wife reckons".
pub(super) fn is_reported(keys: &[String]) -> bool {
    const SAYING: [&str; 33] = [
        "says",
        "said",
        "say",
        "thinks",
        "think",
        "thought",
        "reckons",
        "reckon",
        "claim",
        "claims",
        "claimed",
        "insists",
        "insisted",
        "swears",
        "swear",
        "sworn",
        "told",
        "heard",
        "believes",
        "believe",
        "guess",
        "bet",
        "мол",
        "кажется",
        "похоже",
        "слышал",
        "слышала",
        "говорят",
        "утверждают",
        "уверяют",
        "клянется",
        "божится",
        "якобы",
    ];
    const STEMS: [&str; 8] =
        ["говор", "сказал", "утвержда", "уверя", "считае", "думае", "твердит", "спорит"];
    const KNOWING: [&str; 6] = ["know", "ask", "asks", "wonders", "wondering", "check"];
    let joints = keys.iter().rev().take_while(|key| JOINTS.contains(&key.as_str())).count();
    let (before, joined) = keys.split_at(keys.len() - joints);
    let Some(last) = before.last() else { return false };
    let whether = joined.iter().any(|key| key == "if" || key == "whether");
    let says = SAYING.contains(&last.as_str()) || STEMS.iter().any(|stem| last.starts_with(stem));
    match whether {
        true => says || KNOWING.contains(&last.as_str()),
        false => says,
    }
}

/// "Tell me the door is locked", «скажи, дверь заперта»: who begs so asks whether.
fn tells_me(keys: &[String]) -> bool {
    match keys {
        [first, second, _, _, ..] => {
            first == "tell" && (second == "me" || second == "us")
                || ["скажи", "подскажи", "глянь", "посмотри", "проверь"]
                    .iter()
                    .any(|verb| first.starts_with(verb))
        }
        _ => false,
    }
}

/// Whether a part of a line is a clause of what stands before it: «ту, что на кухне», "bigger, than …".
pub(super) fn goes_on(before: &str, part: &str) -> bool {
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

/// "Someone told me there's a cart in the hall": that there is something is told, where "there" stands before "is".
fn tells_there_is(text: &str, keys: &[String]) -> bool {
    let there = |pair: &[String]| pair[0] == "there" && ["is", "s", "are"].contains(&&*pair[1]);
    let Some(at) = keys.windows(2).position(there).filter(|_| !text.ends_with('?')) else {
        return false;
    };
    let asks = |words: &[String]| several::asks_outright(&words.join(" "));
    !asks(&keys[..at]) && !asks(&keys[at + 2..])
}

/// «которую я вчера не дочитал», "that I bought yesterday": what the person did with a thing.
fn is_own_clause(keys: &[String]) -> bool {
    let Some((first, rest)) = keys.split_first() else { return false };
    let joins = first.starts_with("котор") || first == "which" || first == "that";
    let own = |key: &String| matches!(key.as_str(), "я" | "мы" | "i" | "we");
    joins && rest.first().is_some_and(own) && !several::asks_outright(&rest.join(" "))
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

/// The same by their text.
fn parts_of(text: &str) -> impl Iterator<Item = &str> {
    parts(text).into_iter().map(move |(from, to)| &text[from..to])
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
