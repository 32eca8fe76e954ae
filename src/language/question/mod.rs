//! Questions: from a sentence in Russian or English to a query, from the query to an answer, and to a sentence again.
//!
//! After SPEC T1 and T2. The path is tokens → items (`grammar`) → [`Query`] (`assemble`) → what is found on the map
//! (`knowledge`) → [`Answer`]: data first, with the facts that it rests on, and a sentence in the question's language.
//! The query can be shown as a rule of the Datalog that the relations are written in (`ortho ask --explain`).
//!
//! Invariant: never a guess. What was not understood, what may mean several things, and what the map lacks are
//! three different [`Doubt`]s. No text makes it panic.

mod address;
mod altogether;
mod another_had;
mod another_one;
mod another_place;
mod answer;
mod asides;
mod assemble;
mod bare;
mod beside;
mod clauses;
mod compared;
mod conditions;
mod convenience;
mod courtesy;
mod cut_off;
mod datalog;
mod denial;
mod departed;
mod discourse;
mod disputed;
mod doubt;
mod doubts;
mod each_told;
mod everyday;
mod focus;
mod follow;
mod grammar;
mod heads;
mod heeded;
mod here;
mod introduced;
mod knowledge;
mod left_over;
mod level_words;
mod lexicon;
mod mark;
mod memo;
mod memory;
mod nearest;
mod notation;
mod noun;
mod numbered;
mod of_those;
mod one_of_two;
mod opening;
mod orders;
mod outlive;
mod past;
mod points;
mod premise;
mod pronouns;
mod purposes;
mod query;
mod repaired;
mod rephrase;
mod resolution;
mod respelt;
mod rest;
mod salvage;
mod senses;
mod sentences;
mod serving;
mod several;
mod shuts;
mod small_words;
mod speech;
mod storeys;
mod there;
mod told_aside;
mod told_together;
mod uses;
mod values;
mod vocabulary;
mod which_told;
mod whole;
mod why;
mod windows;

pub use address::{dashed, unaddressed, unbegged};
pub use asides::{Aside, another_and_order, aside, asks_whether, begs, behind_no};
pub use compared::{Closeness, Dimension, Extreme, Quantity};
pub use departed::{Departed, Stamp};
pub use doubt::{Doubt, Unanswered};
pub use knowledge::{Frame, Mind};
pub use lexicon::{Extension, KindId, Lexicon, Meaning, Window};
pub use memory::Memory;
pub use orders::{Conditional, Hinged, conditional, hinged};
pub use query::{
    Best, Claim, Courtesy, Filter, Head, Noun, Passing, Query, Reach, Rel, Restriction, Thing, Use,
};
pub use resolution::{Corrected, Resolved, Strict, rank_alone};
pub use senses::{Crossing, News, Past, RoomPath, Senses, Sighting, Way};
pub use serving::{Doing, Part};
pub use several::sentences;
pub use values::{Property, ValueEntry, ValueId, Values};

use crate::command::is_too_long;
use crate::map::World;
use crate::semantics::Relations;
use crate::words::{Language, word_keys};

use grammar::{Item, Sentence};
use knowledge::Knowledge;
use mark::{Mark, Pronoun};
use memory::Pending;

/// A fact that an answer rests on, or that would have to hold.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Fact {
    /// Its name in the rule text, the English one.
    pub relation: String,
    pub args: Vec<String>,
    pub holds: bool,
}

impl Fact {
    fn holding(relation: &str, args: Vec<String>) -> Self {
        Self { relation: relation.to_owned(), args, holds: true }
    }
}

/// What an answer comes to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Said {
    Yes,
    No,
    Found,
    /// Looked for and not there.
    Nothing,
    /// The map does not tell.
    Unknown,
}

impl Said {
    /// A stable word for programs.
    #[must_use]
    pub fn word(self) -> &'static str {
        match self {
            Self::Yes => "yes",
            Self::No => "no",
            Self::Found => "found",
            Self::Nothing => "nothing",
            Self::Unknown => "not_on_the_map",
        }
    }
}

/// An answer: data first, and its words.
#[derive(Debug, Clone)]
pub struct Answer {
    pub query: Query,
    pub language: Language,
    pub said: Said,
    pub text: String,
    /// What the question asked for.
    pub things: Vec<Thing>,
    /// The same by their names in the facts.
    pub symbols: Vec<String>,
    pub facts: Vec<Fact>,
    /// A count, or a measure in cm or cm².
    pub number: Option<f64>,
    topic: Vec<Thing>,
    /// The two or more things that the question measured against each other.
    compared: Vec<Thing>,
    /// The words of the question.
    words: String,
    /// Whether what was asked is so as it was said, its denial included: "Isn't it on?" is so where it is off.
    so: Option<bool>,
    /// Of which its query speaks by places in lists.
    stamp: Option<Stamp>,
}

impl Answer {
    /// An answer that the rules gave to what the grammar files read.
    #[must_use]
    pub fn ran(query: Query, language: Language, said: Said, words: &str, text: String) -> Self {
        Self {
            query,
            language,
            said,
            text,
            things: Vec::new(),
            symbols: Vec::new(),
            facts: Vec::new(),
            number: None,
            topic: Vec::new(),
            compared: Vec::new(),
            words: words.to_owned(),
            so: truth(said),
            stamp: None,
        }
    }

    /// Whether what was asked is so as it was said, its denial included: "there is no milk" is so where the answer is "No, there
    /// is none". None where nothing was asked to be so, or that is not known.
    #[must_use]
    pub fn is_so(&self) -> Option<bool> {
        self.so
    }

    /// The same with what it found, which is then spoken of, and how many or how much.
    #[must_use]
    pub fn of_things(self, things: Vec<Thing>, symbols: Vec<String>, number: Option<f64>) -> Self {
        Self { topic: things.clone(), things, symbols, number, ..self }
    }

    /// The same, with what was understood said before it.
    fn understood_as(self, asked: &str, language: Language) -> Self {
        // What a part of it was understood as is said of that part.
        if ["Понял так: «", "Understood as “"].iter().any(|said| self.text.starts_with(said))
        {
            return self;
        }
        let asked = asked.trim_end_matches(['?', '.', '!', ',', ' ']);
        let understood =
            language.pick(format!("Понял так: «{asked}?»"), format!("Understood as “{asked}?”"));
        Self { text: format!("{understood} {}", self.text), ..self }
    }

    /// One answer of several: their sentences in order, all that they found and rest on.
    fn joined(answers: Vec<Self>, language: Language) -> Self {
        let said = answers.first().map_or(Said::Unknown, |first| first.said);
        let same = answers.iter().all(|a| a.said == said);
        // What was just told is not told again: "There are 2 phones: Phone 1 and Phone 2."
        let mut texts: Vec<&str> = answers.iter().map(|answer| &*answer.text).collect();
        texts.dedup_by(|next, told| {
            told.len() > next.len() && told.to_lowercase().ends_with(&next.to_lowercase())
        });
        let mut whole = Self {
            query: Query::Several(Vec::new()),
            language,
            said: if same { said } else { Said::Found },
            text: texts.join(" "),
            things: Vec::new(),
            symbols: Vec::new(),
            facts: Vec::new(),
            number: None,
            topic: Vec::new(),
            compared: Vec::new(),
            words: String::new(),
            so: answers.iter().try_fold(true, |so, answer| Some(so & answer.so?)),
            stamp: None,
        };
        let mut queries = Vec::new();
        for answer in answers {
            queries.push(answer.query);
            let found = answer.things.into_iter();
            whole.things.extend(found.filter(|t| !whole.things.contains(t)).collect::<Vec<_>>());
            whole.symbols.extend(answer.symbols);
            whole.facts.extend(answer.facts);
            whole.topic.extend(answer.topic);
            whole.words = answer.words;
        }
        whole.query = Query::Several(queries);
        whole
    }
}

/// Whether an answer says yes.
fn truth(said: Said) -> Option<bool> {
    match said {
        Said::Yes | Said::Found => Some(true),
        Said::No | Said::Nothing => Some(false),
        Said::Unknown => None,
    }
}

/// An answer, or why there is none, with the query where the text was understood.
type Outcome = Result<Answer, Box<(Doubt, Option<Query>)>>;

/// Why the things of a command are not known.
#[derive(Debug, Clone)]
pub struct Misread(pub Box<Unanswered>);

/// Answers questions about one state of a map.
#[derive(Clone, Copy)]
pub struct Asker<'a> {
    pub world: &'a World,
    pub relations: &'a Relations,
    pub mind: &'a Mind,
    pub senses: &'a dyn Senses,
}

impl Asker<'_> {
    /// Characters of the longest question that is read.
    pub const LONGEST: usize = 2_000;

    /// Answers a question and remembers what it was about.
    ///
    /// # Errors
    /// [`Unanswered`]: not understood, ambiguous, or unknown to the map.
    pub fn ask(&self, text: &str, memory: &mut Memory) -> Result<Answer, Unanswered> {
        let before = memory.clone();
        let answer = self.heard(text, memory)?;
        if let Some(told) = self.passed_over(text, &answer, &before) {
            *memory = before;
            let doubt = Doubt::unheeded(told);
            memory.miss(&doubt, false);
            return Err(self.knowledge(answer.language, memory).unanswered(doubt));
        }
        Ok(answer)
    }

    /// The same, whatever bounds it.
    fn heard(&self, text: &str, memory: &mut Memory) -> Result<Answer, Unanswered> {
        let text = dashed(&unaddressed(text));
        if text.chars().any(char::is_alphabetic) {
            memory.language = Language::of(&text);
        }
        let language = memory.language;
        // What is too long is not even read.
        if is_too_long(&text) {
            let length = text.chars().take(1_000_000).count();
            memory.miss(&Doubt::TooLong { length }, false);
            return Err(self.knowledge(language, memory).unanswered(Doubt::TooLong { length }));
        }
        if let Some(outcome) = self.answer_as_meant(&text, language, memory) {
            return outcome;
        }
        let text = &*address::untagged(&text);
        let text = self.without_self_doubt(text).unwrap_or(text);
        if self.is_astray(text) {
            Self::lose_person(text, memory);
        }
        let told = self.told_where(text, language, memory);
        if let Some(answer) = told.or_else(|| self.who_is_right(text, language, memory)) {
            return Ok(answer);
        }
        // A fact in the notation of the rules is one, whatever its commas.
        let is_noted = self.noted(text).is_some();
        let parts = match is_noted {
            true => None,
            false => self.each_part(text, language, memory),
        };
        if let Some(Ok(answer)) = parts {
            return Ok(answer);
        }
        if !is_noted && parts.is_none() {
            let sentences = self.each_sentence(text, language, memory);
            if let Some(answered) = sentences.or_else(|| self.asked_there(text, language, memory)) {
                return answered;
            }
        }
        let outcome = parts.unwrap_or_else(|| self.answer(text, language, memory));
        if let Err(unanswered) = &outcome
            && matches!(
                unanswered.0,
                Doubt::NotUnderstood { .. } | Doubt::Unknown { .. } | Doubt::NoReferent { .. }
            )
            && !is_noted
            && let Some(answer) = self.beside_asides(text, language, memory)
        {
            return Ok(answer);
        }
        let outcome = outcome.or_else(|unanswered| {
            if is_noted {
                return Err(unanswered);
            }
            let is_unheard = matches!(
                unanswered.0,
                Doubt::NotUnderstood { .. } | Doubt::Unknown { .. } | Doubt::NoReferent { .. }
            );
            let known = self.without_unknown(text, language, memory, &unanswered.0);
            if let Some(answer) = known {
                return Ok(answer);
            }
            if !is_unheard {
                return Err(unanswered);
            }
            match self.salvaged(text, language, memory) {
                Some(Ok(answer)) => Ok(answer),
                salvaged => match self.answer_respelt(text, language, memory) {
                    Some(answer) => Ok(answer),
                    None => Err(salvaged.and_then(Result::err).unwrap_or(unanswered)),
                },
            }
        });
        match outcome {
            Ok(answer) => {
                memory.learn(&answer);
                Ok(answer)
            }
            Err(unanswered) => {
                let (doubt, query) = *unanswered;
                let doubt = memory.why_nothing(doubt).quoted_from(text);
                let before = memory.exchanges.clone();
                // What else the question named is spoken of all the same.
                let is_cut = self.cuts_name(text, &doubt);
                if doubt.is_unread() && !is_cut {
                    self.hear_of(text, memory);
                }
                let is_deaf = memory.exchanges == before && self.pronouns(text).is_empty();
                let names_nothing = is_cut || is_deaf && self.introduces(text);
                let asked = memory.query.take_if(|_| doubt.is_only_named(text));
                let place = memory.told_place.filter(|_| matches!(doubt, Doubt::Unknown { .. }));
                memory.miss(&doubt, names_nothing);
                memory.told_place = place;
                // «А полотенце? – Такого нет. – А мыло?»: the same is asked of each.
                memory.query = memory.query.take().or(asked);
                memory.unheard = match &doubt {
                    Doubt::Unknown { reference, .. } if memory.query.is_none() => {
                        Some((text.to_owned(), reference.clone()))
                    }
                    _ => None,
                };
                // «Это Часы-1 или Часы-2? – Где вторые?»
                if let Doubt::Ambiguous { candidates, .. } = &doubt {
                    memory.listed.clone_from(candidates);
                }
                memory.pending = match (&doubt, query) {
                    (Doubt::Ambiguous { reference, candidates }, Some(query)) => Some(Pending {
                        query,
                        language,
                        reference: reference.clone(),
                        candidates: candidates.clone(),
                    }),
                    _ => None,
                };
                let unanswered = self.knowledge(language, memory).unanswered(doubt);
                Err(match self.asks_whether_there_is(text) {
                    true => unanswered.not_denied(|word| self.is_word(word)),
                    false => unanswered,
                })
            }
        }
    }

    /// "Is there a bathtub?", which no answers too.
    fn asks_whether_there_is(&self, text: &str) -> bool {
        let text = self.plain(text);
        let items = Sentence::new(&text, &self.mind.lexicon).items();
        let other = [Mark::What, Mark::Which, Mark::HowMany, Mark::Where, Mark::Not];
        let compares = |item: &Item| matches!(item, Item::Mark(Mark::More(_) | Mark::Than));
        items.contains(&Item::Mark(Mark::Exists))
            && !items.iter().any(compares)
            && !other.into_iter().any(|mark| items.contains(&Item::Mark(mark)))
    }

    /// The query that a text asks, without answering it.
    ///
    /// # Errors
    /// What was not understood.
    pub fn read(&self, text: &str, memory: &Memory) -> Result<Query, Doubt> {
        if is_too_long(text) {
            let length = text.chars().take(1_000_000).count();
            return Err(Doubt::TooLong { length });
        }
        if let Some(query) = courtesy::query(text).or_else(|| self.noted(text)) {
            return Ok(query);
        }
        let text = several::without_tag(text);
        if let Some(above) = self.lacks_storey(text) {
            return Err(Doubt::NoStorey { above });
        }
        let text = &self.plain(text);
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let knowledge = self.knowledge(sentence.language, memory);
        // «В каких комнатах есть книги? В какой их больше всего?»: the books, where rooms are asked for.
        let rooms = sentence.asks_of_rooms(&self.mind.lexicon) || sentence.asks_where_most();
        let list = knowledge.list_asked_of(&sentence.items());
        let referent = |pronoun: Pronoun, rel: Option<Rel>| {
            let had = || knowledge.had_by_rooms().filter(|_| rooms);
            let several = || had().or_else(|| list.clone());
            let several = (pronoun == Pronoun::They).then(several).flatten();
            several.unwrap_or_else(|| knowledge.referent(pronoun, rel))
        };
        let mut query =
            assemble::query(&sentence, &self.mind.lexicon, &referent, knowledge.elided())?;
        denial::settle(&sentence, &mut query);
        Ok(query)
    }

    /// «Где это лежит?»: what points and names nothing is asked of what was spoken of.
    fn read_pointing(&self, text: &str, memory: &Memory) -> Option<Query> {
        let pronoun = Language::of(text).pick("они", "they");
        let plain = self.plain(text);
        let points = Sentence::new(&plain, &self.mind.lexicon).points();
        let whole = format!("{} {pronoun}", text.trim_end_matches(['?', '.', ' ']));
        let whole = (points && self.lacks_subject(text)).then_some(whole)?;
        // "That" may be one thing.
        let told = Memory { is_plural: true, ..memory.clone() };
        self.read(&whole, &told).ok()
    }

    /// The query as a rule of the relations' Datalog.
    #[must_use]
    pub fn rule(&self, query: &Query, language: Language) -> String {
        self.knowledge(language, &Memory::default()).rule(query)
    }

    /// How a fact is proved, down to what was measured, or what it lacks; one premise a line.
    #[must_use]
    pub fn proof(&self, fact: &Fact, language: Language) -> Vec<String> {
        self.knowledge(language, &Memory::default()).proof_lines(fact)
    }

    /// A fact, or that it is none, with its reasons in a sentence.
    #[must_use]
    pub fn because(&self, fact: &Fact, language: Language) -> String {
        let text = self.knowledge(language, &Memory::default()).because(fact);
        crate::units::capitalized(&text)
    }

    /// A measured fact in words; none for what says nothing to a person.
    #[must_use]
    pub fn measurement(
        &self,
        name: &str,
        values: &[crate::facts::Value],
        language: Language,
    ) -> Option<String> {
        self.knowledge(language, &Memory::default()).measurement(name, values)
    }

    /// A text in words that the map knows: "upstairs" is a storey, «столик» a table, «закрыта на ключ» locked.
    fn plain(&self, text: &str) -> String {
        let here = self.senses.robot().map(|(map, _)| map);
        let text = rephrase::plain(text);
        let text = self.mind.paraphrases.plain(&text);
        let text = points::without_rooms(&text, self.world, &self.mind.lexicon);
        let named = storeys::named(&text, self.world, self.relations, here);
        let named = here::named(&named, || self.own_room(&named));
        self.mind.plain.of(&named, || everyday::plain(&named, &self.mind.lexicon).into_owned())
    }

    /// «в Гостиной», in the language of a text: the room where the robot is.
    fn own_room(&self, text: &str) -> Option<String> {
        let memory = Memory::default();
        self.knowledge(Language::of(text), &memory).in_room(Thing::Robot)
    }

    /// Whether a text speaks of a storey that is not there, the one above (true) or below.
    fn lacks_storey(&self, text: &str) -> Option<bool> {
        let here = self.senses.robot().map(|(map, _)| map);
        storeys::lacking(text, self.world, self.relations, here)
    }

    /// Whether a text begins as a question of this grammar does, whatever follows.
    #[must_use]
    pub fn begins_as_question(&self, text: &str) -> bool {
        // "If there is an egg on the counter, bring it"
        if orders::is_under_condition(text) {
            return false;
        }
        // «Я хочу спать, где можно лечь?»
        let told = text.split_once(',').filter(|(told, _)| opening::is_of_me(&word_keys(told)));
        opening::begins_question(&word_keys(text))
            || opening::begs_to_tell(text)
            || told.is_some_and(|(_, asked)| opening::begins_question(&word_keys(asked)))
    }

    /// Whether a text asks to be told something, in the words of an order: "Give me directions …".
    #[must_use]
    pub fn asks_to_tell(&self, text: &str) -> bool {
        opening::asks_to_tell(&word_keys(text))
    }

    fn knowledge<'k>(&'k self, language: Language, memory: &'k Memory) -> Knowledge<'k> {
        Knowledge {
            world: self.world,
            relations: self.relations,
            mind: self.mind,
            senses: self.senses,
            memory,
            language,
        }
    }

    /// The answer to a question, none of whose words stands for some of those that were told.
    fn answer_whole(&self, text: &str, language: Language, memory: &Memory) -> Outcome {
        if let Some(asked) = self.of_another_word(text, memory) {
            let heard = Memory { unheard: None, ..memory.clone() };
            return self.answer(&asked, language, &heard);
        }
        let place = self.person_at(text, memory);
        let storey = self.with_storey(text, memory);
        let text = storey.as_deref().unwrap_or(text);
        let told = self.with_told(text, memory).map_err(|doubt| Box::new((doubt, None)))?;
        self.answer_at(place.as_ref(), told.as_deref().unwrap_or(text), language, memory)
    }

    /// The answer to a question that is asked at a place, the robot's where none was told.
    fn answer_at(
        &self,
        place: Option<&Noun>,
        text: &str,
        language: Language,
        memory: &Memory,
    ) -> Outcome {
        // «Я в спальне, что тут можно включить?» asks nothing of where the robot is.
        let elsewhere = place.filter(|place| premise::says_here(text) && self.is_room(place));
        let unsaid = elsewhere.map(|_| premise::without_here(text));
        let text = unsaid.as_deref().unwrap_or(text);
        if let Some(query) = self.clarified(text, memory) {
            let language = memory.pending.as_ref().map_or(language, |p| p.language);
            let knowledge = self.knowledge(language, memory);
            return knowledge.answer(&query).map_err(|doubt| Box::new((doubt, Some(query))));
        }
        if self.asks_of_posture(text, memory) {
            return Err(Box::new((Doubt::not_understood(text), None)));
        }
        let left = self.how_many_left(text, memory);
        if let Some(None) = left {
            return Err(Box::new((Doubt::not_understood(text), None)));
        }
        let continued = || self.continued(text, memory).or_else(|| self.on_a_side(text, memory));
        let is_left = left.is_some();
        let mut query = match self.noted(text).or(left.flatten()).or_else(continued) {
            Some(query) => query,
            None => match self.read(text, memory) {
                Ok(query) => query,
                Err(doubt) => {
                    self.read_pointing(text, memory).ok_or_else(|| Box::new((doubt, None)))?
                }
            },
        };
        // "If I sit on the sofa, can I see the TV?" asks of no robot where it stands.
        let of_robot = matches!(query, Query::Sees(_) | Query::WhatDoYouSee);
        if of_robot && place.is_some() && word_keys(text).iter().any(opening::is_me) {
            let words = text.to_owned();
            return Err(Box::new((Doubt::NotUnderstood { words }, Some(query))));
        }
        if let Some(place) = place {
            query = query.asked_at(place);
            if elsewhere.is_some() && !query.narrow(place) {
                let words = text.to_owned();
                return Err(Box::new((Doubt::NotUnderstood { words }, Some(query))));
            }
        }
        if let Err(doubt) = self.widen(&mut query, text, memory) {
            return Err(Box::new((doubt, Some(query))));
        }
        self.as_it_was(&mut query, text, memory);
        let knowledge = self.knowledge(language, memory);
        knowledge.things_there(&mut query, text);
        knowledge.focus(&mut query);
        // "Is there one in the office as well?", where nothing tells of what, or things of several kinds were told.
        let unlike = |noun: &Noun| {
            let things = noun.head.things.as_deref().unwrap_or_default();
            let all = things.iter().all(|thing| thing.replica().is_some());
            things.len() > 1 && all && knowledge.alike(things).is_none()
        };
        let bare = |noun: &Noun| noun.head.anything && noun.filters.is_empty() || unlike(noun);
        if let Query::Exists { what, .. } = &query
            && what.iter().all(bare)
            && word_keys(text).iter().any(|key| key == "one")
        {
            return Err(Box::new((Doubt::not_understood(text), None)));
        }
        let none = knowledge.points_at_nothing(&query).or_else(|| knowledge.is_at_itself(&query));
        if let Some(word) = none {
            return Err(Box::new((Doubt::NoReferent { word }, None)));
        }
        let unknown = knowledge.unknown_compound(&query);
        if let Some(reference) = unknown.or_else(|| knowledge.foremost_of_one(&query)) {
            return Err(Box::new((Doubt::Unknown { reference, near: Vec::new() }, Some(query))));
        }
        if let Some(doubt) = knowledge.contested(&query) {
            return Err(Box::new((doubt, Some(query))));
        }
        if knowledge.tells_nothing(&query) {
            return Err(Box::new((Doubt::not_understood(text), None)));
        }
        let answer = knowledge.answer(&query);
        let answer = answer.map(|answer| Answer {
            words: text.to_owned(),
            so: denial::truth(&Sentence::new(text, &self.mind.lexicon), &answer),
            ..answer
        });
        let answer = answer.map(|answer| self.with_whole(text, memory, answer));
        // What is left is so now.
        if let Ok(answer) = &answer
            && !is_left
            && let Some(doubt) = self.is_otherwise_now(answer, text, memory)
        {
            return Err(Box::new((doubt, Some(query))));
        }
        answer.map_err(|doubt| Box::new((doubt, Some(query))))
    }
}
