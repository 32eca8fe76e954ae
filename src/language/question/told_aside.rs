//! What a line tells beside what it asks: whether that bounds the question, and what it names.
//!
//! Invariant: what bounds a question is never left aside; what is taken back is not spoken of.

use super::focus::is_foremost_of_one;
use super::grammar::{Item, Sentence};
use super::mark::{Mark, Pronoun};
use super::{Asker, Doubt, Memory, Noun, Thing, opening, several};
use crate::command::is_order;
use crate::sets::{Set, set};
use crate::words::{is_first_person, word_keys};

/// What a part of a line names that asks nothing.
#[derive(Default)]
pub(super) struct Named {
    pub(super) things: Vec<Thing>,
    /// What is named as a place.
    pub(super) places: Vec<Thing>,
    /// Whether a thing was called by a plural: «таблетки» may be one.
    plural: bool,
    /// The words that named all the things.
    reference: Option<String>,
}

impl Asker<'_> {
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
        // «Сил моих больше нет»
        let no_more = matches!(items[..], [.., Item::Mark(Mark::More(_)), Item::Mark(Mark::Not)]);
        let compares = items.len() > 1 && !no_more;
        let numbered = items.iter().all(|item| matches!(item, Item::Mark(_) | Item::Number(_)));
        let bounds = |item: &Item| match item {
            Item::Number(_) => numbered,
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
        let keys = word_keys(text);
        if keys.is_empty() {
            return Some(Named::default());
        }
        if self.bounds(text) {
            return None;
        }
        // «Почитать бы чего» wishes; who begs to be told asks nothing more: «не подскажешь?»
        let wishes = is_wish(&keys);
        let begs = only_begs(&keys);
        let seeks = several::seeks(text);
        let tells = tells_there_is(text, &keys) || is_own_clause(&keys) || seeks;
        if several::asks_outright(text) && !wishes && !begs && !tells {
            return None;
        }
        // "Is the stove on or off, and …" asks of what it names.
        let asks_whether = !begs && !tells && !wishes && opening::asks_at_once(&keys);
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
                Item::Mark(Mark::All | Mark::Each) if of_me => (Vec::new(), false),
                Item::Mark(Mark::Other | Mark::All | Mark::Each | Mark::Detail(_)) => return None,
                Item::Noun(phrase) => (vec![phrase], false),
                Item::Place { nouns, .. } => (nouns, true),
                _ => (Vec::new(), false),
            };
            for phrase in phrases.iter().filter(|p| p.person.is_none() && p.pronoun.is_none()) {
                // "The one in the hall" is among what was spoken of; «левый кабинет 5» is no cabinet of the map.
                if phrase.noun.head.anything || is_foremost_of_one(&phrase.noun) {
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
        let names_nothing = named.things.is_empty() && named.places.is_empty();
        (names_nothing || !asks_whether).then_some(named)
    }
}

impl Named {
    pub(super) fn add(&mut self, other: Self) {
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
    pub(super) fn spoken(&self) -> &[Thing] {
        if self.things.is_empty() { &self.places } else { &self.things }
    }

    /// Whether pronouns may mean what was named and not understood: "it" is none of several, "there" is one place.
    pub(super) fn may_be_meant(&self, pronouns: &[Pronoun]) -> bool {
        match self.spoken().len() {
            0 => pronouns.is_empty(),
            1 => true,
            _ => pronouns.iter().all(|p| matches!(p, Pronoun::They | Pronoun::There)),
        }
    }

    /// The doubt which of several is meant that one word in the singular named.
    pub(super) fn several_of_one(&self) -> Option<Doubt> {
        let reference = self.reference.clone().filter(|_| !self.plural)?;
        Some(Doubt::Ambiguous { reference, candidates: self.things.clone() })
    }

    /// Notes what was named.
    pub(super) fn heard(&self, memory: &mut Memory) {
        memory.list(self.spoken());
        memory.is_plural |= self.plural;
        if let [place] = self.places[..] {
            memory.told_place = Some(place);
        }
    }
}

/// What a part of a line takes back: «нет, не утюг», "not the armchair".
pub(super) fn withdrawn(items: &[Item]) -> Option<&Item> {
    let mut rest = items.iter().skip_while(|item| {
        matches!(item, Item::Mark(Mark::Not | Mark::The | Mark::A | Mark::And | Mark::Filler))
    });
    let denies = items.contains(&Item::Mark(Mark::Not));
    let first = rest.next().filter(|_| denies)?;
    let is_all = match (first, rest.next(), rest.next()) {
        (Item::Noun(_) | Item::Unknown(_), None, _) => true,
        // "Not the pencil, the pen."
        (Item::Noun(_), Some(Item::Noun(_)), None) => true,
        _ => false,
    };
    is_all.then_some(first)
}

/// "If you don't mind", «если не секрет», "while you're at it": who says so is polite, and supposes nothing.
pub(super) fn is_polite(keys: &[String]) -> bool {
    static POLITE: Set = Set::named("PoliteIf");
    let said = keys.join(" ");
    match keys.first().map(String::as_str) {
        Some("if" | "если") => keys.iter().any(|key| POLITE.contains(&key.as_str())),
        Some("while" | "since") => {
            said.contains(" you re at it") || said.contains(" you are at it")
        }
        _ => false,
    }
}

/// Whether a part ends as questions do, and neither is polite nor begs by that, nor hangs on what was said: "don't we?"
pub(super) fn is_marked(part: &str) -> bool {
    let keys = word_keys(part);
    let wishes = is_wish(&keys) && !several::asks_outright(part);
    let is_tag = several::is_tag(&keys.join(" "));
    part.ends_with('?') && !only_begs(&keys) && !is_polite(&keys) && !wishes && !is_tag
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
    let own = |key: &String| set!("FirstPerson").contains(&key.as_str());
    joins && rest.first().is_some_and(own) && !several::asks_outright(&rest.join(" "))
}

/// «не подскажешь?», "do you know?": a part that asks for nothing of its own.
pub(super) fn only_begs(keys: &[String]) -> bool {
    keys.len() < 5 && keys.iter().any(|key| tells(key))
}

/// «Присесть бы», but «хотя бы три»
pub(super) fn is_wish(keys: &[String]) -> bool {
    let least = |at: usize| at > 0 && keys[at - 1] == "хотя";
    (0..keys.len()).any(|at| (keys[at] == "бы" || keys[at] == "б") && !least(at))
}

/// Whether a word is one of telling or knowing, by which a question is led in: "could you maybe tell me …".
pub(super) fn tells(key: &str) -> bool {
    static VERBS: Set = Set::named("AsideVerb");
    static STEMS: Set = Set::named("AsideStem");
    VERBS.contains(&key) || STEMS.iter().any(|stem| key.starts_with(stem))
}
