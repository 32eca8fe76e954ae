//! What is told beside a question and bears upon its answer: "The lift is out of order. How do I get upstairs?"
//!
//! Invariant: an answer that what was told may make false is not given. A way leads past what is said to be out of use; of
//! what else is said of a door, a lift or a room, nothing here knows how it bears upon a way.

use super::grammar::{Item, Phrase, Sentence};
use super::knowledge::Knowledge;
use super::mark::Mark;
use super::query::{Best, Extreme, Passing, Rel};
use super::{Answer, Asker, Doubt, Memory, Noun, Query, Thing};
use crate::map::Entity;
use crate::sets::set;
use crate::units::AreaId;
use crate::words::{Case, Language, phrase_at, word_keys};

impl Asker<'_> {
    /// An answer that heeds what was told beside its question.
    ///
    /// # Errors
    /// What was told bears upon the answer, and how is not known.
    pub(super) fn heeding(
        &self,
        told: &[&str],
        answer: Answer,
        memory: &Memory,
    ) -> Result<Answer, Doubt> {
        // «Нас десять, хватит ли стульев?»: for how many it is to be enough.
        let suffices = word_keys(&answer.words).iter().any(|key| set!("Enough").contains(&&**key));
        let counts = |part: &&&str| {
            let plain = self.plain(part);
            let items = Sentence::new(&plain, &self.mind.lexicon).items();
            items.iter().any(|item| matches!(item, Item::Number(_)))
        };
        if let Some(part) = told.iter().find(counts).filter(|_| suffices) {
            return Err(Doubt::unheeded(part));
        }
        let mut avoided = Vec::new();
        for part in told.iter().filter(|part| self.bears_upon(part, &answer, memory)) {
            match self.out_of_use(part).or_else(|| self.shunned(part)) {
                Some(noun) => avoided.push(noun),
                None => return Err(Doubt::unheeded(part)),
            }
        }
        if avoided.is_empty() {
            return Ok(answer);
        }
        let knowledge = self.knowledge(answer.language, memory);
        let Some(query) = answer.query.clone().avoiding(avoided.clone()) else {
            return Err(Doubt::unheeded(&told.join(" ")));
        };
        let mut things = Vec::new();
        for noun in &avoided {
            things.extend(knowledge.definite(noun)?);
        }
        let around = knowledge.list(&things);
        let around = match answer.language {
            Language::Russian => format!("В обход: {around}."),
            Language::English => format!("Avoiding {around}."),
        };
        let heeded = knowledge.answer(&query)?;
        Ok(Answer { text: format!("{around} {}", heeded.text), words: answer.words, ..heeded })
    }

    /// Whether a part tells something of a door, a lift or a room that a way may lead through, or of what would be nearest.
    fn bears_upon(&self, part: &str, answer: &Answer, memory: &Memory) -> bool {
        let knowledge = self.knowledge(answer.language, memory);
        let (mut ends, mut nearest) = (Vec::new(), false);
        answer.query.clone().each_noun(&mut |noun| {
            let near = |best: &Best| matches!(best.extreme, Extreme::Nearest | Extreme::Farthest);
            nearest |= noun.best.as_ref().is_some_and(near);
            ends.extend(knowledge.find(noun, true).unwrap_or_default());
        });
        let goes = matches!(
            answer.query,
            Query::Way { .. }
                | Query::CanReach { .. }
                | Query::Passing { .. }
                | Query::Duration { .. }
                | Query::WhichWay { .. }
        );
        let leads = |thing: &Thing| {
            let opens = matches!(
                thing,
                Thing::Opening(_) | Thing::Entity(Entity::Door(_) | Entity::Map(_))
            );
            let lift = thing.area().is_some_and(|area| self.is_lift(area));
            opens || lift || thing.area().is_some() && !ends.contains(thing)
        };
        let bears = |thing: &Thing| match goes {
            true => leads(thing),
            false => answer.things.contains(thing),
        };
        // "Guests sleep on the sofa. Where else can I sit?"
        let else_ = word_keys(&answer.words).iter().any(|key| set!("Else").contains(&&**key));
        if !(goes || nearest || else_) {
            return false;
        }
        let plain = self.plain(part);
        let subjects = Sentence::new(&plain, &self.mind.lexicon).items();
        subjects.iter().any(|item| match item {
            Item::Noun(phrase) if phrase.person.is_none() && phrase.pronoun.is_none() => {
                let noun = Noun { plural: true, ..phrase.noun.clone() };
                match knowledge.find(&noun, true) {
                    Ok(found) if !found.is_empty() => found.iter().any(bears),
                    // Which of them is meant is not known.
                    _ => goes && (self.is_room(&noun) || !noun.head.named.is_empty()),
                }
            }
            // "Somebody sits on the chair", which would be the nearest; "there is a flood in the kitchen", where the way leads
            // through it.
            Item::Place { rel, nouns, .. } => {
                let found = nouns.iter().filter(|phrase| phrase.person.is_none()).flat_map(|p| {
                    let noun = Noun { plural: true, ..p.noun.clone() };
                    knowledge.find(&noun, true).unwrap_or_default()
                });
                let through = *rel == Rel::Through;
                let on_the_way = |thing: Thing| {
                    leads(&thing) && (through || knowledge.mentions(&answer.text, thing))
                };
                found.into_iter().any(|thing| match goes {
                    true => on_the_way(thing),
                    false => thing.replica().is_some() && bears(&thing),
                })
            }
            _ => false,
        })
    }

    /// Whether a sentence that asks nothing says of what alone, or of what not, the next one asks: "I only care about the
    /// kitchen.", "Not counting the bathroom.", "In the kitchen."
    pub(super) fn narrows(&self, text: &str, asked: &str) -> bool {
        if text.trim_end().ends_with('?') {
            return false;
        }
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let items = sentence.items();
        let person = |phrase: &Phrase| phrase.person.is_some();
        let names = |item: &Item| match item {
            Item::Noun(phrase) => !person(phrase) && phrase.pronoun.is_none(),
            Item::Place { nouns, .. } => !nouns.iter().any(person),
            Item::Value(_) => true,
            _ => false,
        };
        if !items.iter().any(names) {
            return false;
        }
        let keys = word_keys(text);
        let says = |phrase: &&str| (0..keys.len()).any(|n| phrase_at(&keys, n, phrase).is_some());
        // A place by itself, and "just the red ones".
        let place = |item: &Item| match item {
            Item::Place { rel, .. } => matches!(rel, Rel::In | Rel::On | Rel::At | Rel::From),
            Item::Noun(phrase) => phrase.noun.head.anything,
            _ => false,
        };
        let small = |item: &Item| match item {
            Item::Mark(mark) => matches!(
                mark,
                Mark::The | Mark::A | Mark::And | Mark::But | Mark::Filler | Mark::Number(_)
            ),
            item => names(item),
        };
        let alone = items.iter().any(place) && items.iter().all(small);
        // "The one in the bedroom: what is it standing on?", «Я про спальню: сколько там картин?»
        let taken_up = !self.pronouns(asked).is_empty() || self.says_there(asked);
        self.limits(text) || !taken_up && (set!("Narrowing").iter().any(says) || alone)
    }

    fn is_lift(&self, area: AreaId) -> bool {
        let lifts = &self.world.domain.lifts;
        lifts.iter().any(|(_, stops)| stops.iter().any(|stop| stop.area == area))
    }

    fn says_there(&self, text: &str) -> bool {
        let plain = self.plain(text);
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        items.iter().any(|item| match item {
            Item::Noun(phrase) => phrase.person == Some(Mark::There),
            item => *item == Item::Mark(Mark::There),
        })
    }

    /// "I don't want to go through the kitchen."
    fn shunned(&self, part: &str) -> Option<Noun> {
        let plain = self.plain(part);
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        let denies = |item: &Item| matches!(item, Item::Mark(Mark::Not | Mark::Cannot));
        let mut through = items.iter().filter_map(|item| match item {
            Item::Place { rel: Rel::Through, nouns, either: false } => Some(nouns),
            _ => None,
        });
        let (only, more) = (through.next()?, through.next());
        let [phrase] = &only[..] else { return None };
        let named = phrase.pronoun.is_none() && phrase.person.is_none();
        (items.iter().any(denies) && more.is_none() && named).then(|| phrase.noun.clone())
    }

    /// The one thing of which a part tells only that it is out of use.
    fn out_of_use(&self, part: &str) -> Option<Noun> {
        let keys = word_keys(part);
        let said = |n: usize| {
            let taken = set!("OutOfUse").iter().filter_map(|phrase| phrase_at(&keys, n, phrase));
            Some((n, taken.max()?))
        };
        let (at, taken) = (0..keys.len()).filter_map(said).max_by_key(|(_, taken)| *taken)?;
        let rest = self.plain(&[&keys[..at], &keys[at + taken..]].concat().join(" "));
        let mut only = None;
        for item in Sentence::new(&rest, &self.mind.lexicon).items() {
            match item {
                Item::Noun(phrase) if phrase.person.is_some() || phrase.pronoun.is_some() => {}
                Item::Noun(phrase) if only.is_none() => only = Some(phrase.noun),
                Item::Mark(Mark::Be | Mark::The | Mark::Filler | Mark::And | Mark::But) => {}
                Item::Unknown(_) => {}
                _ => return None,
            }
        }
        only
    }
}

impl Knowledge<'_> {
    /// Whether a text has the name of a thing, in whichever case.
    fn mentions(&self, text: &str, thing: Thing) -> bool {
        let said = format!(" {} ", word_keys(text).join(" "));
        let has = |name: String| said.contains(&format!(" {} ", word_keys(&name).join(" ")));
        match self.language {
            Language::English => has(self.name(thing)),
            Language::Russian => Case::ALL.iter().any(|case| has(self.form(thing, *case))),
        }
    }
}

impl Query {
    /// The same way past some things; none where no way is asked for.
    fn avoiding(self, past: Vec<Noun>) -> Option<Self> {
        let through = Vec::new();
        Some(match self {
            Self::Way { from, to, .. } => {
                Self::Passing { from, to, through, avoiding: past, asks: Passing::How }
            }
            Self::CanReach { from, to } => {
                Self::Passing { from, to, through, avoiding: past, asks: Passing::Whether }
            }
            Self::Passing { from, to, through, mut avoiding, asks } => {
                avoiding.extend(past);
                Self::Passing { from, to, through, avoiding, asks }
            }
            _ => return None,
        })
    }
}
