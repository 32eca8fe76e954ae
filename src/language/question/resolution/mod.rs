//! Reference resolution: every description of a command is replaced by the name of the thing that it means.
//!
//! «Принеси красную чашку со стола в кухне» becomes «Принеси Чашку-2», «Закрой все двери» the names of all doors. Where
//! a thing is said to be narrows what it may be; whither it is to go does not. What the verb can be done to comes
//! before what it cannot: of a book and a lamp, only the lamp is switched on.
//!
//! Invariant: of several things that are left none is chosen, unless any was asked for («какую-нибудь», "a cup",
//! «найди чашку»): then it is the nearest.

mod choice;
mod contested;
mod object;
mod open;
mod place;
mod reply;
mod shown;
mod terse;
mod used;
mod words;

use std::ops::Range;

pub use open::Corrected;
pub use reply::rank_alone;

use object::More;
use place::Spot;
pub(super) use place::case_of;
use used::Used;

use super::grammar::{Item, Phrase, Sentence};
use super::knowledge::Knowledge;
use super::mark::{Mark, Pronoun};
use super::memory::{Ordered, Waiting};
use super::numbered::{Done, counts};
use super::query::{Head, Rel, Restriction, Thing};
use super::{Asker, Doubt, Memory, Misread};
use crate::command::{self, Sort};
use crate::map::Entity;
use crate::paraphrase::lost;
use crate::sets::set;
use crate::units::{AreaId, InOrder as _};
use crate::words::{Case, NounPhrase, enumerate, word_keys, word_ranges};

/// What a bare noun means by itself, where that is one thing: «стол» the one table that is no desk.
pub type Strict<'a> = dyn Fn(&str) -> Option<Entity> + 'a;

/// A change of the text, and the things whose names it puts there.
struct Edit {
    at: Range<usize>,
    name: String,
    things: Vec<Thing>,
    /// What the command is done to, not a place.
    object: bool,
    /// Of the place that says whither: its bytes with the preposition.
    goal: Option<Range<usize>>,
}

impl Edit {
    fn deletion(at: &Range<usize>) -> Self {
        Self { at: at.clone(), name: String::new(), things: Vec::new(), object: false, goal: None }
    }
}

/// A command with names for descriptions, and what the names mean, in the order of the text.
#[derive(Debug, Clone)]
pub struct Resolved {
    pub text: String,
    pub meant: Vec<Thing>,
    /// What "them" means in it, the one that "it" means at the end.
    pub last: Vec<Thing>,
}

impl Asker<'_> {
    /// A command with its descriptions replaced by names. Words that nothing knows stay as they are.
    ///
    /// # Errors
    /// A description that several things fit, or none; then the memory waits for an answer.
    pub fn resolve(
        &self,
        text: &str,
        memory: &mut Memory,
        strict: &Strict<'_>,
    ) -> Result<Resolved, Misread> {
        let resolved = self.resolved(text, memory, strict);
        if resolved.is_err() {
            let waiting = memory.waiting.as_ref().map(|waiting| waiting.text.clone());
            let text = waiting.unwrap_or_else(|| {
                self.plain(&command::gathered_of(text, &self.mind.paraphrases).0)
            });
            self.leave_open(&text, memory);
        }
        resolved
    }

    fn resolved(
        &self,
        text: &str,
        memory: &mut Memory,
        strict: &Strict<'_>,
    ) -> Result<Resolved, Misread> {
        let waiting = memory.waiting.take();
        if command::is_too_long(text) {
            return Ok(Resolved { text: text.to_owned(), meant: Vec::new(), last: Vec::new() });
        }
        let is_back = terse::says_back(text);
        let (gathered, not_meant) = command::gathered_of(text, &self.mind.paraphrases);
        let language = crate::words::Language::of(text);
        let misread = |doubt: Doubt| {
            Misread(Box::new(self.knowledge(language, &Memory::default()).unanswered(doubt)))
        };
        // What only forbids is refused as it was said.
        if command::forbids(&gathered) {
            let text = gathered.into_owned();
            return Ok(Resolved { text, meant: Vec::new(), last: Vec::new() });
        }
        if let Some(above) = self.lacks_storey(&gathered) {
            return Err(misread(Doubt::NoStorey { above }));
        }
        if let Some(words) = self.dropped(text, &gathered, &not_meant) {
            return Err(misread(Doubt::not_understood(&words)));
        }
        // «Унеси те, что на комоде»: several of those that were spoken of, never the last one alone.
        let several = |pair: &[String]| {
            set!("Those").contains(&pair[0].as_str())
                && (pair[1] == "что" || pair[1].starts_with("котор"))
        };
        if let Some(pair) = word_keys(&gathered).windows(2).find(|pair| several(pair)) {
            return Err(misread(Doubt::not_understood(&pair.join(" "))));
        }
        let said = word_keys(&gathered);
        let text = self.with_shown(self.plain(&gathered), memory).map_err(misread)?;
        let text = self.with_kind(text, memory);
        let before = text;
        let text = match self.with_one_of_those(before.clone(), memory) {
            Ok(text) => text,
            Err((doubt, at)) => return Err(self.asked_back(doubt, before, at, language, memory)),
        };
        let (is_any, by_number) = (text != before, counts(&said));
        let spoken = waiting.map_or_else(|| memory.last.clone(), |waiting| waiting.candidates);
        let sort = command::clauses(&text).first().map_or(Sort::Other, |(_, sort)| *sort);
        let text = match self.with_names(&text, memory, Some(&Done { sort, spoken: &spoken })) {
            Ok(named) => named.unwrap_or(text),
            Err((doubt, at)) => return Err(self.asked_back(doubt, text, at, language, memory)),
        };
        let text = self.with_verb(self.with_noun(self.on_storey(text), memory), memory);
        let text = self.with_object(text, is_back, memory).map_err(misread)?;
        let Used { text, at: used, heads } = self.with_use(text, language).map_err(misread)?;
        let numbers = lost(&said, &word_keys(&text)).into_iter();
        if let Some(number) = numbers.into_iter().find(|key| key.chars().all(char::is_numeric)) {
            return Err(misread(Doubt::not_understood(&number)));
        }
        // "Open the lab door" orders; it does not speak of the open one.
        let described = command::without_verbs(&text);
        let sentence = Sentence::new(&described, &self.mind.lexicon);
        let language = sentence.language;
        let resolved = {
            let knowledge = self.knowledge(language, memory);
            let mut resolver =
                Resolver { knowledge: &knowledge, sentence: &sentence, strict, spoken, used: None };
            // The best sort of what serves, of which there is one where the order says.
            let mut of_use = heads.into_iter().map(|head| {
                resolver.used = Some((used.clone(), head));
                resolver.resolve(&text)
            });
            match of_use.next() {
                Some(Err(missed)) => of_use.find(Result::is_ok).unwrap_or(Err(missed)),
                Some(found) => found,
                None => {
                    drop(of_use);
                    resolver.resolve(&text)
                }
            }
        };
        match resolved {
            Ok(mut edits) => {
                edits.order_by_key(|edit| edit.at.start);
                let listed = match edits.iter().any(|edit| edit.object) {
                    true => None,
                    false => self.one_of_listed(&text, &sentence, memory),
                };
                if let Some((at, reference, candidates)) =
                    listed.or_else(|| self.either_several(&text, &sentence, memory))
                {
                    let told = candidates.clone();
                    memory.waiting = Some(Waiting { text, at, candidates: told, language });
                    return Err(misread(Doubt::Ambiguous { reference, candidates }));
                }
                let object = edits.iter().find(|edit| edit.object);
                let goal = edits.iter().rev().find_map(|edit| edit.goal.clone());
                let object = object.map(|edit| (edit.at.clone(), edit.things.clone()));
                let object = object.or_else(|| self.done_to_it(&text, &sentence, memory));
                if let (Some((_, taken)), false) = (&object, by_number)
                    && let [taken] = taken[..]
                {
                    memory.take(taken, is_any);
                }
                // «А теперь выключи» names nothing: the command before is what may be amended.
                let amendable = (object.is_some() || goal.is_some()).then(|| Ordered {
                    text: text.clone(),
                    object,
                    told: edits
                        .iter()
                        .filter(|e| e.name.is_empty())
                        .map(|e| e.at.clone())
                        .collect(),
                    goal,
                    is_resolved: true,
                    language,
                });
                memory.ordered = amendable.or(memory.ordered.take());
                let meant = edits.iter().flat_map(|edit| edit.things.clone()).collect();
                let mut resolved = text;
                let mut until = usize::MAX;
                // From the end, so that the places before stay where they are.
                for edit in edits.into_iter().rev().filter(|edit| !edit.at.is_empty()) {
                    if edit.at.end <= until {
                        until = edit.at.start;
                        resolved.replace_range(edit.at, &edit.name);
                    }
                }
                let last = self.spoken_of(&resolved, memory);
                Ok(Resolved { text: resolved, meant, last })
            }
            Err((doubt, at)) => Err(self.asked_back(doubt, text, at, language, memory)),
        }
    }

    /// What is said where an order is not understood; one that means several things waits for the reply.
    fn asked_back(
        &self,
        doubt: Doubt,
        text: String,
        at: Range<usize>,
        language: crate::words::Language,
        memory: &mut Memory,
    ) -> Misread {
        if let Doubt::Ambiguous { candidates, .. } = &doubt {
            let candidates = candidates.clone();
            memory.waiting = Some(Waiting { text, at, candidates, language });
        }
        Misread(Box::new(self.knowledge(language, memory).unanswered(doubt)))
    }

    /// A name, number or description of a text that its rewriting has lost, and not because it is not meant. What a state
    /// is called may have become a verb: "make sure that it is closed".
    fn dropped(&self, text: &str, gathered: &str, not_meant: &[String]) -> Option<String> {
        let said = word_keys(text);
        let gone = lost(&said, &word_keys(gathered));
        let lost = lost(&gone, not_meant);
        if lost.is_empty() {
            return None;
        }
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let told = sentence.content(&self.mind.lexicon);
        told.into_iter()
            .find(|words| words.clone().any(|n| lost.contains(&sentence.keys[n])))
            .map(|words| sentence.said(&words).to_owned())
    }

    /// «Принеси ещё одну»: with the noun of what was spoken of last.
    fn with_kind(&self, mut text: String, memory: &Memory) -> String {
        let (words, keys) = (word_ranges(&text), word_keys(&text));
        let is = |n: usize, all: &[&str]| keys.get(n).is_some_and(|key| all.contains(&&**key));
        let said = (0..words.len()).find(|&n| is(n, &["еще"]) && is(n + 1, set!("OneMore")));
        let ends = |n: usize| {
            let rest = words.get(n).map_or("", |next| &text[words[n - 1].end..next.start]);
            n == words.len() || !rest.trim().is_empty() || is(n, set!("AroundMine"))
        };
        let spoken = memory.last_things().into_iter().rev().find_map(|t| t.replica());
        let object = spoken.and_then(|id| self.world.replicas.get(&id)).map(|r| r.object);
        let object = object.and_then(|object| self.world.objects.get(&object));
        let kind = object.and_then(|object| self.world.types.object.get(object.object_type));
        if let (Some(said), Some(kind)) = (said.filter(|said| ends(said + 2)), kind) {
            let hints = crate::names::hints_of_type(kind);
            let noun = NounPhrase::parse(&kind.name.to_lowercase(), &hints).case(Case::Accusative);
            text.insert_str(words[said + 1].end, &format!(" {noun}"));
        }
        text
    }
}

impl Knowledge<'_> {
    /// Several names as one argument of a command.
    pub(super) fn listed(&self, things: &[Thing], case: Case) -> String {
        let names: Vec<String> = things.iter().map(|t| self.form(*t, case)).collect();
        enumerate(&names, self.language)
    }
}

struct Resolver<'s, 'k> {
    knowledge: &'s Knowledge<'k>,
    sentence: &'s Sentence<'s>,
    strict: &'s Strict<'s>,
    /// What "the red one" may be: what was asked about, or the last answer.
    spoken: Vec<Thing>,
    /// The name at these bytes stands for any of such things.
    used: Option<(Range<usize>, Head)>,
}

impl<'s, 'k> Resolver<'s, 'k> {
    /// One that reads a sentence, and resolves nothing.
    fn reading(knowledge: &'s Knowledge<'k>, sentence: &'s Sentence<'s>) -> Self {
        Self { knowledge, sentence, strict: &|_| None, spoken: Vec::new(), used: None }
    }
}

impl Resolver<'_, '_> {
    fn bytes(&self, words: &Range<usize>) -> Range<usize> {
        match (
            self.sentence.words.get(words.start),
            self.sentence.words.get(words.end.saturating_sub(1)),
        ) {
            (Some(first), Some(last)) => first.start..last.end,
            _ => 0..0,
        }
    }

    /// What the place that says whither means, by name; places in which that one is go with it. `room`, where the sentence
    /// has sent what goes there.
    fn whither<'i>(
        &self,
        spot: &Spot<'i>,
        others: &mut Vec<&Spot<'i>>,
        sort: Sort,
        room: Option<AreaId>,
        edits: &mut Vec<Edit>,
    ) -> Result<Option<Thing>, (Doubt, Range<usize>)> {
        let mut within = spot.within.clone();
        let mut aside = Vec::new();
        others.retain(|other| {
            // «в спальню на кровать»: whither too, and where that is.
            let whither = self.is_whither(other.rel, other.phrase) == Some(true);
            let rooms = self.knowledge.base(&other.phrase.noun.head);
            // "The cups on the ground floor to the desk": of what is carried, where it stands before the place.
            let of_place = sort == Sort::Go || other.item > spot.item;
            let storey = self.means_storey(other.phrase) && !self.means_storey(spot.phrase);
            let storey = storey && of_place;
            let whither = whither && rooms.iter().all(|t| t.area().is_some()) || storey;
            if whither && matches!(sort, Sort::Put | Sort::Carry | Sort::Go) {
                let anchors = vec![other.phrase.noun.clone()];
                within.push(Restriction { rel: Rel::In, anchors, negated: false });
                aside.push(other.at.clone());
            }
            !whither
        });
        if spot.rel == Rel::Between {
            return self.between(spot, &within, edits);
        }
        // «Отнеси кружку на кухню и поставь на стол»: on the one that is there.
        let there = room.and_then(|room| self.only_one_in(room, &spot.phrase.noun, &within));
        let thing = there.map_or_else(|| self.place(spot, &within), |there| Ok(Some(there)))?;
        let Some(thing) = thing else { return Ok(None) };
        // «Отнеси молоко к холодильнику»: things are put in it, and only boxes on top of it.
        let carries = matches!(sort, Sort::Put | Sort::Carry);
        let link = self.sentence.words.iter().position(|word| word.start == spot.at.start);
        let open = link.is_some_and(|n| command::link_is_open(&self.sentence.keys, n));
        if carries && open && self.knowledge.shuts_things_in(thing) {
            return Err((Doubt::InOrOn { place: thing }, self.bytes(&spot.phrase.words)));
        }
        edits.extend(aside.iter().map(Edit::deletion));
        let name = self.knowledge.form(self.told_by(thing), case_of(spot.rel, true));
        let at = self.bytes(&spot.phrase.words);
        edits.push(Edit {
            at,
            name,
            things: vec![thing],
            object: false,
            goal: Some(spot.at.start..self.bytes(&spot.phrase.words).end),
        });
        edits.extend(spot.attached.iter().map(Edit::deletion));
        Ok(Some(thing))
    }

    /// «Между столом и диваном», "between the two doors": both by name.
    fn between(
        &self,
        spot: &Spot<'_>,
        within: &[Restriction],
        edits: &mut Vec<Edit>,
    ) -> Result<Option<Thing>, (Doubt, Range<usize>)> {
        let mut last = None;
        for phrase in spot.nouns {
            let at = self.bytes(&phrase.words);
            let found = self.candidates(&phrase.noun, within).map_err(|d| (d, at.clone()))?;
            let two = phrase.noun.count.is_none_or(|n| n == 2);
            let pair = spot.nouns.len() == 1 && found.len() == 2 && two;
            let things = match self.one(&phrase.noun, within, &found, at.clone()) {
                _ if pair => found,
                one => one?.into_iter().collect(),
            };
            let Some(thing) = things.last().copied() else { return Ok(None) };
            let name = self.knowledge.listed(&things, Case::Instrumental);
            edits.push(Edit { at, name, things, object: false, goal: None });
            last = Some(thing);
        }
        edits.extend(spot.attached.iter().map(Edit::deletion));
        Ok(last)
    }

    fn resolve(&self, text: &str) -> Result<Vec<Edit>, (Doubt, Range<usize>)> {
        let clauses = command::clauses(text);
        let clause_at =
            |byte: usize| clauses.iter().rposition(|(start, _)| *start <= byte).unwrap_or(0);
        let sort = |clause: usize| clauses.get(clause).map_or(Sort::Other, |(_, sort)| *sort);
        let items = self.numbered(self.sentence.items())?;
        let items = self.of_use(self.freed(items, |byte| sort(clause_at(byte))));
        let (items, links) = self.rounds(items, |byte| sort(clause_at(byte)));
        let spots = self.spots(&items, clause_at, &sort);
        let mut edits: Vec<Edit> = links.iter().map(Edit::deletion).collect();
        // «Отнеси чашку на стол. Положи туда книгу»: whither the last order went.
        let memory = self.knowledge.memory;
        let listed = || self.knowledge.place_of_list();
        let place = memory.told_place.or_else(listed).or_else(|| memory.last_thing());
        let mut told = Told { place, ..Told::default() };
        for clause in 0..clauses.len().max(1) {
            let own = spots.iter().filter(|s| s.clause == clause).collect();
            let objects = items.iter().enumerate().filter_map(|(n, item)| match item {
                Item::Noun(phrase) if clause_at(self.bytes(&phrase.words).start) == clause => {
                    Some((n, phrase))
                }
                _ => None,
            });
            let opens =
                clauses.get(clause).is_some_and(|(start, _)| command::opens(&text[*start..]));
            let objects = objects.collect();
            let clause = Clause { sort: sort(clause), opens, items: &items, objects };
            self.resolve_clause(&clause, own, &mut told, &mut edits)?;
        }
        if let [_] = clauses[..] {
            edits.extend(self.borne_by_pronoun(sort(0), &items));
        }
        Ok(edits)
    }

    /// What one verb is done to, and whither.
    fn resolve_clause<'i>(
        &self,
        clause: &Clause<'i>,
        mut own: Vec<&Spot<'i>>,
        told: &mut Told,
        edits: &mut Vec<Edit>,
    ) -> Result<(), (Doubt, Range<usize>)> {
        let Clause { sort, ref objects, .. } = *clause;
        // «лицом к столу» says nowhere to go.
        let (facing, others): (Vec<&Spot<'i>>, Vec<&Spot<'i>>) =
            own.into_iter().partition(|spot| sort == Sort::Go && self.is_faced(spot.phrase));
        own = others;
        let goal = self.destination(sort, &own, !objects.is_empty());
        let goal = goal.filter(|goal| !self.tells_of_fixed(sort, own[*goal], objects));
        let upon = goal.map(|goal| own[goal].rel);
        let whither = match goal {
            Some(goal) => {
                let spot = own.remove(goal);
                let room = told.carried_to.or(told.gone_to);
                let room = room.or_else(|| self.room_pointed_at(sort, spot.phrase));
                match self.whither(spot, &mut own, sort, room, edits) {
                    // «На зарядку», where there are several: the robot goes to the nearest.
                    Err((Doubt::Ambiguous { .. }, _))
                        if objects.is_empty() && self.is_haunt(spot) =>
                    {
                        None
                    }
                    found => found?,
                }
            }
            None => None,
        };
        let stands = whither.and_then(|thing| self.knowledge.area_of(thing)).or(told.gone_to);
        for spot in facing {
            self.face(spot, stands, edits)?;
        }
        let there = self.places_there(clause, told)?;
        if let (Some(_), Some(words)) = (&there, self.words_for_there(clause)) {
            edits.push(Edit::deletion(&self.bytes(&words)));
        }
        // "Put the book there": not to the book.
        let spoken_of = told.place;
        let mut until_word = 0;
        for (n, (at, phrase)) in objects.iter().enumerate() {
            if phrase.words.start < until_word {
                continue;
            }
            if let Some((thing, last)) = self.either(sort, &objects[n..], clause.items)? {
                let at = self.bytes(&(phrase.words.start..last.end));
                let name = self.knowledge.form(thing, Case::Accusative);
                told.things.push(thing);
                told.place = Some(thing);
                edits.push(Edit { at, name, things: vec![thing], object: true, goal: None });
                until_word = last.end;
                continue;
            }
            if let Some(Mark::There) = phrase.person {
                if there.is_some() {
                    edits.push(Edit::deletion(&self.bytes(&phrase.words)));
                } else if goal.is_none()
                    && matches!(sort, Sort::Go | Sort::Put | Sort::Carry)
                    && let Some(thing) = spoken_of
                {
                    let thing = self.no_place_of_its_own(thing, objects, told, phrase)?;
                    edits.extend(self.to_there(thing, sort, phrase, clause.items, told.upon)?);
                }
                continue;
            }
            // «Отопри кабинет, возьми батарею, запри его»: what can be locked, though it was not named last.
            if let Some(pronoun) = phrase.pronoun
                && let Some(thing) = self.meant_by_pronoun(sort, pronoun, told)
            {
                let name = self.knowledge.form(thing, Case::Accusative);
                let at = self.bytes(&phrase.words);
                edits.push(Edit { at, name, things: vec![thing], object: true, goal: None });
                continue;
            }
            let until = objects.get(n + 1).map_or(usize::MAX, |(next, _)| *next);
            let mine: Vec<&&Spot<'_>> = own
                .iter()
                .filter(|s| s.item < until && (s.item > *at || n == 0))
                .filter(|s| !self.is_cut_off(clause.items, *at, s.item))
                .collect();
            // What cannot be done is not asked about either.
            let is_idle = matches!(sort, Sort::Other | Sort::Leave)
                && self.object(sort, phrase, &mine, More::default()).is_err();
            if phrase.pronoun.is_some() || phrase.person.is_some() || is_idle {
                continue;
            }
            // «дверь coe_door»: a kind, and the name that tells which.
            let is_apposed = objects.get(n + 1).is_some_and(|(_, next)| {
                next.words.start == phrase.words.end
                    && !self.is_parted(next.words.start)
                    && self.names_one_of(next, phrase)
            });
            if is_apposed {
                edits.push(Edit::deletion(&self.bytes(&phrase.words)));
                continue;
            }
            let except = self.except_after(clause.items, *at, &objects[n + 1..]);
            // «кроме двери в ванную»
            let last = except.as_ref().and_then(|(except, _)| except.last());
            let from =
                last.and_then(|last| objects.iter().position(|(_, p)| p.words == last.words));
            let next = |n: usize| objects.get(n).map_or(usize::MAX, |(item, _)| *item);
            let of_except: Vec<&&Spot<'_>> = from.map_or_else(Vec::new, |from| {
                own.iter().filter(|s| (next(from)..next(from + 1)).contains(&s.item)).collect()
            });
            let value = self.value_after(clause.items, *at, phrase);
            let more = More {
                value: value.as_ref().map(|(value, _)| *value),
                except: except
                    .iter()
                    .flat_map(|e| &e.0)
                    .map(|p| self.left_out(sort, p, &of_except))
                    .collect(),
                place: told.place,
                there: there.clone(),
                gone_to: told.gone_to,
                opened: told.opened.filter(|_| sort == Sort::Carry),
                like: objects[..n]
                    .iter()
                    .rev()
                    .map(|(_, before)| before.noun.head.clone())
                    .find(|head| !head.kinds.is_empty() && head.named.is_empty())
                    .or_else(|| told.like.clone()),
                told: told.things.clone(),
            };
            let Some(things) = self.object(sort, phrase, &mine, more)? else {
                self.left_standing(&mine, edits);
                continue;
            };
            let things = match sort == Sort::Go && phrase.noun.all {
                true => self.knowledge.senses.round(&things),
                false => things,
            };
            let name = self.knowledge.listed(&things, Case::Accusative);
            let mut said = self.bytes(&phrase.words);
            if let Some((_, words)) = value {
                said.end = self.bytes(&words).end;
            }
            let end = said.end;
            told.place = things.last().copied().or(told.place);
            told.things.extend(&things);
            let opened = things.last().copied().filter(|_| clause.opens);
            told.opened = opened.filter(|thing| self.is_container(*thing));
            let head = &phrase.noun.head;
            if !head.kinds.is_empty() && head.named.is_empty() {
                told.like = Some(head.clone());
            }
            edits.push(Edit { at: said, name, things, object: true, goal: None });
            for spot in mine {
                edits.push(Edit::deletion(&spot.at));
                edits.extend(spot.attached.iter().map(Edit::deletion));
            }
            if let Some((except, from)) = except {
                // Behind the value that the noun has taken, if there is one.
                let from = self.sentence.words[from - 1].end.max(end);
                let last = except.last().map_or(from, |last| self.bytes(&last.words).end);
                let last = of_except.iter().map(|s| s.at.end).max().unwrap_or(last);
                edits.push(Edit::deletion(&(from..last)));
                until_word = except.last().map_or(until_word, |last| last.words.end);
            }
        }
        if objects.is_empty() {
            let own: Vec<&&Spot<'_>> = own.iter().collect();
            self.left_standing(&own, edits);
        }
        told.place = whither.or(told.place);
        told.has_named |= whither.is_some() || !told.things.is_empty();
        told.upon = upon.filter(|rel| whither.is_some() && matches!(rel, Rel::In | Rel::On));
        if matches!(sort, Sort::Carry | Sort::Put) {
            told.carried_to =
                whither.and_then(|place| self.knowledge.area_of(place)).or(told.carried_to);
        }
        if sort == Sort::Go {
            told.gone_to = whither.and_then(Thing::area).or(told.gone_to);
        }
        Ok(())
    }

    /// "Clear the table in the living room": a place tells which, of what cannot be carried to it.
    fn tells_of_fixed(&self, sort: Sort, spot: &Spot<'_>, objects: &[(usize, &Phrase)]) -> bool {
        let [(item, phrase)] = objects else { return false };
        let told =
            Restriction { rel: spot.rel, anchors: vec![spot.phrase.noun.clone()], negated: false };
        let whither = self.is_whither(spot.rel, spot.phrase) == Some(true);
        let fixed = |found: Vec<Thing>| {
            !found.is_empty() && !found.iter().any(|t| self.knowledge.can(sort, *t))
        };
        let names = phrase.pronoun.is_none() && phrase.person.is_none();
        sort == Sort::Put
            && !whither
            && names
            && spot.item > *item
            && self.candidates(&phrase.noun, &[told]).is_ok_and(fixed)
    }

    /// "Put the book on it", «положи в неё»: of what was spoken of before the sentence, what may bear or hold things.
    fn borne_by_pronoun(&self, sort: Sort, items: &[Item]) -> Option<Edit> {
        let named = items.iter().any(|item| matches!(item, Item::Noun(_)));
        let mut places = items.iter().filter_map(|item| match item {
            Item::Place { rel, nouns, .. } => Some((*rel, nouns)),
            _ => None,
        });
        let (rel, nouns) = places.next().filter(|_| named && places.next().is_none())?;
        let ([phrase], Rel::On | Rel::In) = (&nouns[..], rel) else { return None };
        let carried = matches!(sort, Sort::Put | Sort::Carry);
        let mut meant = self.knowledge.referent(phrase.pronoun.filter(|_| carried)?, Some(rel));
        meant.retain(|thing| self.knowledge.may_be_anchor(rel, *thing));
        let [thing] = meant[..] else { return None };
        let name = self.knowledge.form(self.told_by(thing), case_of(rel, true));
        let at = self.bytes(&phrase.words);
        Some(Edit { at, name, things: vec![thing], object: false, goal: None })
    }

    /// What of what the sentence has named a verb can be done to, of the pronoun's gender; none where that was named
    /// last.
    fn meant_by_pronoun(&self, sort: Sort, pronoun: Pronoun, told: &Told) -> Option<Thing> {
        let able = |t: &Thing| match sort {
            Sort::Door => {
                t.area().is_some() || self.knowledge.can(sort, *t) || self.is_container(*t)
            }
            Sort::Switch => self.knowledge.can(sort, *t),
            _ => false,
        };
        let agrees = |t: &Thing| self.knowledge.agrees(pronoun, *t);
        let last = told.things.last()?;
        // "Put the plate in the microwave and switch it on"
        let named = || told.things.iter().rev().chain(&told.place);
        let fits = |t: &&Thing| able(t) && agrees(t);
        let other = named().find(fits).or_else(|| named().find(|t| able(t)));
        // «Поставь чашку на стол и закрой его»
        let other = other.or_else(|| named().find(|t| agrees(t)).filter(|_| !agrees(last)));
        other.filter(|other| *other != last && !fits(&last)).copied()
    }
}

/// A verb with the nouns that stand in its clause, each with its place among the items.
struct Clause<'i> {
    sort: Sort,
    opens: bool,
    items: &'i [Item],
    objects: Vec<(usize, &'i Phrase)>,
}

/// What the clauses before have told.
#[derive(Default)]
struct Told {
    /// What they were done to, and the kind that was named last.
    things: Vec<Thing>,
    like: Option<Head>,
    place: Option<Thing>,
    /// Whether the sentence itself has named that, and not what was said before it.
    has_named: bool,
    /// Whether an earlier clause has something put in or on that place.
    upon: Option<Rel>,
    /// The room into which an earlier clause sends the robot.
    gone_to: Option<AreaId>,
    /// What the clause before opens, and may hold things.
    opened: Option<Thing>,
    /// The room in which what was carried is then.
    carried_to: Option<AreaId>,
}
