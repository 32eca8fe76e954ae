//! Commands made plain: every description is replaced by the name of the thing that it means.
//!
//! «Принеси красную чашку со стола в кухне» becomes «Принеси Чашку-2», «Закрой все двери» the names of all doors. Where
//! a thing is said to be narrows what it may be; whither it is to go does not. What the verb can be done to comes
//! before what it cannot: of a book and a lamp, only the lamp is switched on.
//!
//! Invariant: of several things that are left none is chosen, unless any was asked for («какую-нибудь», "a cup",
//! «найди чашку»): then it is the nearest.

use std::ops::Range;

use super::grammar::{Item, Phrase, Sentence};
use super::knowledge::Knowledge;
use super::lexicon::Extension;
use super::query::{Best, Extreme, Filter, Head, Noun, Rel, Restriction, Thing};
use super::values::ValueId;
use super::vocabulary::Mark;
use super::{Asker, Doubt, Memory, Misread, Unanswered};
use crate::language::command::{self, Sort};
use crate::language::words::{Case, Language, NounPhrase, enumerate};
use crate::map::Entity;
use crate::units::AreaId;

/// What a bare noun means by itself, where that is one thing: «стол» the one table that is no desk.
pub type Strict<'a> = dyn Fn(&str) -> Option<Entity> + 'a;

/// A command that waits for the person to say which thing was meant.
#[derive(Debug, Clone)]
pub(super) struct Waiting {
    text: String,
    /// Bytes of the description.
    at: Range<usize>,
    candidates: Vec<Thing>,
    language: Language,
}

impl Memory {
    /// Notes a command that can go on once a name in it is known to mean one of some things.
    pub fn wait(
        &mut self,
        text: &str,
        at: Range<usize>,
        candidates: Vec<Thing>,
        language: Language,
    ) {
        self.waiting = Some(Waiting { text: text.to_owned(), at, candidates, language });
    }
}

/// A place that was said: the preposition, what follows it, and the places that tell where that is.
struct Spot<'i> {
    rel: Rel,
    phrase: &'i Phrase,
    within: Vec<Restriction>,
    /// Bytes, with the preposition.
    at: Range<usize>,
    /// Of the places that tell where this one is.
    attached: Vec<Range<usize>>,
    clause: usize,
    /// The item at which it stands.
    item: usize,
}

/// A change of the text, and the things whose names it puts there.
struct Edit {
    at: Range<usize>,
    name: String,
    things: Vec<Thing>,
}

impl Edit {
    fn deletion(at: &Range<usize>) -> Self {
        Self { at: at.clone(), name: String::new(), things: Vec::new() }
    }
}

/// A command with names for descriptions, and what the names mean, in the order of the text.
#[derive(Debug, Clone)]
pub struct Settled {
    pub text: String,
    pub meant: Vec<Thing>,
}

impl Asker<'_> {
    /// A command with its descriptions replaced by names. Words that nothing knows stay as they are.
    ///
    /// # Errors
    /// A description that several things fit, or none; then the memory waits for an answer.
    pub fn settle(
        &self,
        text: &str,
        memory: &mut Memory,
        strict: &Strict<'_>,
    ) -> Result<Settled, Misread> {
        let waiting = memory.waiting.take();
        if text.chars().take(Self::LONGEST + 1).count() > Self::LONGEST {
            return Ok(Settled { text: text.to_owned(), meant: Vec::new() });
        }
        let gathered = command::gathered(text);
        let text = self.with_kind(self.plain(&gathered).into_owned(), memory);
        // "Open the lab door" orders; it does not speak of the open one.
        let described = command::without_verbs(&text);
        let sentence = Sentence::new(&described, &self.mind.lexicon);
        let language = sentence.language;
        let settled = {
            let knowledge = self.knowledge(language, memory);
            let spoken = match waiting {
                Some(waiting) => waiting.candidates,
                None => memory.last.clone(),
            };
            let settler = Settler { knowledge: &knowledge, sentence: &sentence, strict, spoken };
            settler.settle(&text)
        };
        match settled {
            Ok(mut edits) => {
                edits.sort_by_key(|edit| edit.at.start);
                let meant = edits.iter().flat_map(|edit| edit.things.clone()).collect();
                let mut settled = text;
                let mut until = usize::MAX;
                // From the end, so that the places before stay where they are.
                for edit in edits.into_iter().rev().filter(|edit| !edit.at.is_empty()) {
                    if edit.at.end <= until {
                        until = edit.at.start;
                        settled.replace_range(edit.at, &edit.name);
                    }
                }
                Ok(Settled { text: settled, meant })
            }
            Err((doubt, at)) => {
                if let Doubt::Ambiguous { candidates, .. } = &doubt {
                    let candidates = candidates.clone();
                    memory.waiting = Some(Waiting { text, at, candidates, language });
                }
                let unanswered: Unanswered = self.knowledge(language, memory).unanswered(doubt);
                Err(Misread(Box::new(unanswered)))
            }
        }
    }

    /// «Принеси ещё одну»: with the noun of what was spoken of last.
    fn with_kind(&self, mut text: String, memory: &Memory) -> String {
        let words = crate::language::words::word_ranges(&text);
        let key = |n: usize| words.get(n).map(|w| crate::units::name_key(&text[w.clone()]));
        let is = |n: usize, all: &[&str]| key(n).is_some_and(|key| all.contains(&key.as_str()));
        let said = (0..words.len())
            .find(|&n| is(n, &["еще"]) && is(n + 1, &["одну", "один", "одно", "одного"]));
        let ends = |n: usize| {
            let rest = words.get(n).map_or("", |next| &text[words[n - 1].end..next.start]);
            n == words.len() || !rest.trim().is_empty() || is(n, &["и", "пожалуйста", "мне"])
        };
        let spoken = memory.last_things().into_iter().rev().find_map(|t| t.replica());
        let object = spoken.and_then(|id| self.world.replicas.get(&id)).map(|r| r.object);
        let object = object.and_then(|object| self.world.objects.get(&object));
        let kind = object.and_then(|object| self.world.types.object.get(object.object_type));
        if let (Some(said), Some(kind)) = (said.filter(|said| ends(said + 2)), kind) {
            let hints = crate::language::names::hints_of_type(kind);
            let noun = NounPhrase::parse(&kind.name.to_lowercase(), &hints).case(Case::Accusative);
            text.insert_str(words[said + 1].end, &format!(" {noun}"));
        }
        text
    }

    /// A command that waited to be told which thing was meant, with the thing that these words choose.
    #[must_use]
    pub fn resumed(&self, text: &str, memory: &Memory) -> Option<String> {
        let waiting = memory.waiting.as_ref()?;
        let knowledge = self.knowledge(waiting.language, memory);
        let chosen = self.chosen(text, waiting, &knowledge)?;
        let mut resumed = waiting.text.clone();
        resumed.replace_range(waiting.at.clone(), &knowledge.listed(&chosen, Case::Accusative));
        Some(resumed)
    }

    fn chosen(
        &self,
        text: &str,
        waiting: &Waiting,
        knowledge: &Knowledge<'_>,
    ) -> Option<Vec<Thing>> {
        const ANY: [&str; 9] = [
            "любую",
            "любой",
            "любое",
            "все равно",
            "any",
            "any one",
            "whichever",
            "either",
            "ближайшую",
        ];
        const ALL: [&str; 6] = ["все", "обе", "оба", "all", "both", "all of them"];
        const YES: [&str; 6] = ["да", "ага", "верно", "yes", "yeah", "right"];
        let candidates = &waiting.candidates;
        let key = crate::units::name_key(text.trim_matches(|c: char| !c.is_alphanumeric()));
        let nearest = Best { extreme: Extreme::Nearest, anchor: None };
        let among = |noun: Noun| Noun {
            head: Head { things: Some(candidates.clone()), ..noun.head.clone() },
            ..noun
        };
        if ALL.contains(&key.as_str()) {
            return Some(candidates.clone());
        }
        if ANY.contains(&key.as_str()) {
            let noun = among(Noun { best: Some(nearest), ..Noun::default() });
            return knowledge.find(&noun, true).ok()?.first().map(|t| vec![*t]);
        }
        if YES.contains(&key.as_str()) && candidates.len() == 1 {
            return Some(candidates.clone());
        }
        let text = &self.plain(without_pointing(text));
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let mut noun = super::assemble::fragment(&sentence, &self.mind.lexicon, &|_| Vec::new())?;
        if noun.head.named.is_empty() && noun.head.kinds.is_empty() {
            noun.head = Head { things: Some(candidates.clone()), ..Head::default() };
        }
        // «вторую»: in the order in which they were told.
        if let (Some(rank), None) = (noun.rank, &noun.best) {
            let at = usize::try_from(rank).ok()?.checked_sub(1)?;
            return candidates.get(at).map(|t| vec![*t]);
        }
        noun.plural = true;
        let found = knowledge.find(&noun, true).ok()?;
        let meant: Vec<Thing> = found.into_iter().filter(|t| candidates.contains(t)).collect();
        (meant.len() == 1).then_some(meant)
    }
}

/// «ту, что на комоде», "the one that is on the dresser": what follows the pointing words tells which.
fn without_pointing(text: &str) -> &str {
    const POINTING: [&str; 22] = [
        "тот",
        "та",
        "то",
        "те",
        "ту",
        "той",
        "что",
        "который",
        "которая",
        "которое",
        "которую",
        "стоит",
        "лежит",
        "находится",
        "это",
        "я",
        "имел",
        "имела",
        "виду",
        "that",
        "which",
        "is",
    ];
    let words = crate::language::words::word_ranges(text);
    let points = |range: &&Range<usize>| {
        POINTING.contains(&crate::units::name_key(&text[(*range).clone()]).as_str())
    };
    let skipped = words.iter().take_while(points).count();
    words.get(skipped).map_or(text, |first| &text[first.start..])
}

impl Knowledge<'_> {
    /// Several names as one argument of a command.
    fn listed(&self, things: &[Thing], case: Case) -> String {
        let names: Vec<String> = things.iter().map(|t| self.form(*t, case)).collect();
        enumerate(&names, self.language)
    }
}

/// What follows a noun and tells more of it.
#[derive(Default)]
struct More {
    value: Option<ValueId>,
    except: Option<Noun>,
    /// The room of which it is said to be there.
    there: Option<AreaId>,
    /// The room into which the sentence sends the robot before.
    gone_to: Option<AreaId>,
}

struct Settler<'s, 'k> {
    knowledge: &'s Knowledge<'k>,
    sentence: &'s Sentence<'s>,
    strict: &'s Strict<'s>,
    /// What "the red one" may be: what was asked about, or the last answer.
    spoken: Vec<Thing>,
}

impl Settler<'_, '_> {
    fn bytes(&self, words: &Range<usize>) -> Range<usize> {
        match (
            self.sentence.words.get(words.start),
            self.sentence.words.get(words.end.saturating_sub(1)),
        ) {
            (Some(first), Some(last)) => first.start..last.end,
            _ => 0..0,
        }
    }

    fn settle(&self, text: &str) -> Result<Vec<Edit>, (Doubt, Range<usize>)> {
        let items = self.sentence.items();
        let clauses = command::clauses(text);
        let clause_at =
            |byte: usize| clauses.iter().rposition(|(start, _)| *start <= byte).unwrap_or(0);
        let sort = |clause: usize| clauses.get(clause).map_or(Sort::Other, |(_, sort)| *sort);
        let spots = self.spots(&items, clause_at, &sort);
        let mut edits = Vec::new();
        let mut told_place: Option<Thing> = self.knowledge.memory.last_thing();
        // The room into which an earlier clause sends the robot.
        let mut gone_to: Option<AreaId> = None;
        let count = clauses.len().max(1);
        for clause in 0..count {
            let sort = sort(clause);
            let mut own: Vec<&Spot<'_>> = spots.iter().filter(|s| s.clause == clause).collect();
            let objects: Vec<(usize, &Phrase)> = items
                .iter()
                .enumerate()
                .filter_map(|(n, item)| match item {
                    Item::Noun(phrase) if clause_at(self.bytes(&phrase.words).start) == clause => {
                        Some((n, phrase))
                    }
                    _ => None,
                })
                .collect();
            let goal = self.destination(sort, &own, !objects.is_empty());
            let mut whither = None;
            if let Some(goal) = goal {
                let spot = own.remove(goal);
                let mut within = spot.within.clone();
                let mut aside = Vec::new();
                own.retain(|other| {
                    // «в спальню на кровать»: whither too, and where that is.
                    let whither = self.is_whither(other.rel, other.phrase) == Some(true);
                    let rooms = self.knowledge.base(&other.phrase.noun.head);
                    let whither = whither && rooms.iter().all(|t| t.area().is_some());
                    if whither && matches!(sort, Sort::Put | Sort::Carry | Sort::Go) {
                        let anchors = vec![other.phrase.noun.clone()];
                        within.push(Restriction { rel: Rel::In, anchors, negated: false });
                        aside.push(other.at.clone());
                    }
                    !whither
                });
                let placed = self.place(spot, &within)?;
                if placed.is_some() {
                    edits.extend(aside.iter().map(Edit::deletion));
                }
                if let Some(thing) = placed {
                    whither = Some(thing);
                    let case = case_of(spot.rel, true);
                    let mut said = self.bytes(&spot.phrase.words);
                    if self.number_after(&spot.phrase.words).is_some() {
                        said.end = self.sentence.words[spot.phrase.words.end].end;
                    }
                    let name = self.knowledge.form(thing, case);
                    edits.push(Edit { at: said, name, things: vec![thing] });
                    edits.extend(spot.attached.iter().map(Edit::deletion));
                }
            }
            let says_there = objects.iter().any(|(_, p)| matches!(p.person, Some(Mark::There)));
            // «Принеси оттуда» tells where it is, «принеси туда» whither.
            let whence = |phrase: &Phrase| self.sentence.keys[phrase.words.start] == "оттуда";
            let is_where = !matches!(sort, Sort::Go | Sort::Put | Sort::Carry)
                || objects.iter().any(|(_, p)| p.person.is_some() && whence(p));
            let there = told_place.filter(|_| says_there && is_where);
            let there = there.and_then(|t| self.knowledge.area_of(t));
            let mut skipped = None;
            for (n, (at, phrase)) in objects.iter().enumerate() {
                if skipped == Some(phrase.words.start) {
                    continue;
                }
                if let Some(Mark::There) = phrase.person {
                    if there.is_some() {
                        edits.push(Edit::deletion(&self.bytes(&phrase.words)));
                    } else if let (Some(thing), None, Sort::Go | Sort::Put | Sort::Carry) =
                        (told_place, goal, sort)
                    {
                        let to = self.knowledge.pick("к ", "to ");
                        let name = self.knowledge.form(thing, Case::Dative);
                        let at = self.bytes(&phrase.words);
                        edits.push(Edit { at, name: format!("{to}{name}"), things: vec![thing] });
                    }
                    continue;
                }
                if phrase.pronoun.is_some() || phrase.person.is_some() {
                    continue;
                }
                // What cannot be done is not asked about either.
                if matches!(sort, Sort::Other | Sort::Leave)
                    && self.object(sort, phrase, &[], More::default()).is_err()
                {
                    continue;
                }
                let until = objects.get(n + 1).map_or(usize::MAX, |(next, _)| *next);
                let mine: Vec<&&Spot<'_>> = own
                    .iter()
                    .filter(|s| s.item < until && (s.item > *at || n == 0))
                    .filter(|s| !self.is_cut_off(&items, *at, s.item))
                    .collect();
                // «дверь coe_door»: a kind, and the name that tells which.
                let apposed = objects.get(n + 1).filter(|(_, next)| {
                    next.words.start == phrase.words.end
                        && !self.is_parted(next.words.start)
                        && self.names_one_of(next, phrase)
                });
                if apposed.is_some() {
                    edits.push(Edit::deletion(&self.bytes(&phrase.words)));
                    continue;
                }
                let more = More {
                    value: self.value_after(&items, *at, phrase).map(|(value, _)| value),
                    except: self.except_after(&items, *at).map(|except| except.noun.clone()),
                    there,
                    gone_to,
                };
                if let Some(things) = self.object(sort, phrase, &mine, more)? {
                    let name = self.knowledge.listed(&things, Case::Accusative);
                    let mut said = self.bytes(&phrase.words);
                    if self.number_after(&phrase.words).is_some() {
                        said.end = self.sentence.words[phrase.words.end].end;
                    }
                    if let Some((_, words)) = self.value_after(&items, *at, phrase) {
                        said.end = self.bytes(&words).end;
                    }
                    let end = said.end;
                    edits.push(Edit { at: said, name, things: things.clone() });
                    for spot in mine {
                        edits.push(Edit::deletion(&spot.at));
                        edits.extend(spot.attached.iter().map(Edit::deletion));
                    }
                    if let Some(except) = self.except_after(&items, *at) {
                        edits.push(Edit::deletion(&(end..self.bytes(&except.words).end)));
                        skipped = Some(except.words.start);
                    }
                    told_place = things.last().copied().or(told_place);
                } else {
                    self.left_standing(&mine, &mut edits);
                }
            }
            if objects.is_empty() {
                let own: Vec<&&Spot<'_>> = own.iter().collect();
                self.left_standing(&own, &mut edits);
            }
            told_place = whither.or(told_place);
            if sort == Sort::Go {
                gone_to = whither.and_then(Thing::area).or(gone_to);
            }
        }
        Ok(edits)
    }

    fn names_one_of(&self, name: &Phrase, kind: &Phrase) -> bool {
        let named = self.knowledge.base(&name.noun.head);
        let all = self.knowledge.base(&kind.noun.head);
        matches!(&named[..], [only] if all.len() > 1 && all.contains(only))
    }

    /// Places whose thing was not found out keep their words; those that mean one thing become its name.
    fn left_standing(&self, spots: &[&&Spot<'_>], edits: &mut Vec<Edit>) {
        for spot in spots {
            if let Ok(found) = self.candidates(&spot.phrase.noun, &spot.within)
                && let [only] = found[..]
                && is_described(&spot.phrase.noun, &spot.within)
            {
                let case = case_of(spot.rel, false);
                let at = self.bytes(&spot.phrase.words);
                edits.push(Edit { at, name: self.knowledge.form(only, case), things: vec![only] });
                edits.extend(spot.attached.iter().map(Edit::deletion));
            }
        }
    }

    /// The places of a sentence, each with those that tell where it is.
    fn spots<'i>(
        &self,
        items: &'i [Item],
        clause_at: impl Fn(usize) -> usize,
        sort: &impl Fn(usize) -> Sort,
    ) -> Vec<Spot<'i>> {
        let mut spots: Vec<Spot<'i>> = Vec::new();
        for (n, item) in items.iter().enumerate() {
            let Item::Place { rel, nouns, .. } = item else { continue };
            let Some(phrase) = nouns.first() else { continue };
            if phrase.pronoun.is_some() || phrase.person.is_some() {
                continue;
            }
            let last = nouns.last().map_or(phrase.words.end, |p| p.words.end);
            let before = match n.checked_sub(1).map(|n| &items[n]) {
                Some(Item::Noun(p)) => Some(p.words.end),
                Some(Item::Place { nouns, .. }) => nouns.last().map(|p| p.words.end),
                _ => None,
            };
            let link = command::link_before(&self.sentence.keys, phrase.words.start);
            let from = before.unwrap_or(phrase.words.start - link).min(phrase.words.start);
            let at = self.bytes(&(from..last));
            let clause = clause_at(at.start);
            let anchors: Vec<Noun> = nouns.iter().map(|p| p.noun.clone()).collect();
            let restriction = Restriction { rel: *rel, anchors, negated: false };
            let adjacent = matches!(n.checked_sub(1).map(|n| &items[n]), Some(Item::Place { .. }));
            if let Some(last) = spots.last_mut()
                && adjacent
                && last.clause == clause
                && self.tells_where(last, *rel, phrase, sort(clause))
            {
                last.within.push(restriction);
                last.attached.push(at);
                continue;
            }
            spots.push(Spot {
                rel: *rel,
                phrase,
                within: Vec::new(),
                at,
                attached: Vec::new(),
                clause,
                item: n,
            });
        }
        spots
    }

    /// Whether a place that follows another tells where that one is: «на столе в кухне», "the chair next to the bed".
    fn tells_where(&self, last: &Spot<'_>, rel: Rel, phrase: &Phrase, sort: Sort) -> bool {
        let area = |phrase: &Phrase| {
            let base = self.knowledge.base(&phrase.noun.head);
            !base.is_empty() && base.iter().all(|t| t.area().is_some())
        };
        if sort == Sort::Door || self.is_whither(rel, phrase) == Some(true) {
            return false;
        }
        match rel {
            Rel::In | Rel::On | Rel::At | Rel::From => area(phrase) && !area(last.phrase),
            Rel::To | Rel::Through => false,
            // A room is not told by what it is beside.
            _ => !area(last.phrase),
        }
    }

    /// Whether a place says whither, by its preposition or its case; none where that depends on the verb.
    fn is_whither(&self, rel: Rel, phrase: &Phrase) -> Option<bool> {
        match (rel, self.sentence.language) {
            (Rel::To, _) => Some(true),
            (Rel::From | Rel::Through, _) => Some(false),
            (Rel::In | Rel::On | Rel::Under | Rel::Behind, Language::Russian) => {
                let accusative = phrase.cases.iter().any(|r| r.has_case(Case::Accusative));
                let place = match rel {
                    Rel::In | Rel::On => Case::Locative,
                    _ => Case::Instrumental,
                };
                let place = phrase.cases.iter().any(|r| {
                    r.has_case(place)
                        || (place == Case::Locative && r.has_case(Case::Prepositional))
                });
                (accusative != place).then_some(accusative)
            }
            // "into", "onto" are "in" and "on" to a question.
            (Rel::In | Rel::On, Language::English) => {
                let word =
                    phrase.words.start.checked_sub(1).and_then(|n| self.sentence.keys.get(n));
                matches!(word.map(String::as_str), Some("into" | "onto")).then_some(true)
            }
            _ => None,
        }
    }

    /// Which of a clause's places is where the robot or the thing is to go.
    fn destination(&self, sort: Sort, spots: &[&Spot<'_>], has_object: bool) -> Option<usize> {
        let told = |whither: bool| {
            let fits = |s: &&Spot<'_>| self.is_whither(s.rel, s.phrase) == Some(whither);
            spots.iter().rposition(fits)
        };
        let open = || spots.iter().rposition(|s| self.is_whither(s.rel, s.phrase).is_none());
        match sort {
            Sort::Go => told(true)
                .or_else(open)
                .or_else(|| spots.iter().rposition(|s| !matches!(s.rel, Rel::From | Rel::Through))),
            Sort::Put => told(true).or_else(open).or_else(|| {
                // «Положи книгу на столе»: no other place is told.
                let one = spots.len() == 1 && !matches!(spots[0].rel, Rel::From);
                (one && has_object).then_some(0)
            }),
            Sort::Carry => told(true),
            Sort::Door | Sort::Switch | Sort::Find | Sort::Leave | Sort::Other => None,
        }
    }

    /// The one thing that a place means, none where the words are left to be read as they are.
    fn place(
        &self,
        spot: &Spot<'_>,
        within: &[Restriction],
    ) -> Result<Option<Thing>, (Doubt, Range<usize>)> {
        let noun = &spot.phrase.noun;
        let at = self.bytes(&spot.phrase.words);
        if self.is_strange(&spot.phrase.words) {
            return Ok(None);
        }
        let mut found = self.candidates(noun, within).map_err(|doubt| (doubt, at.clone()))?;
        if noun.other {
            let here = self.here();
            found.retain(|t| t.area().is_none() || t.area() != here);
        }
        if (noun.indefinite || self.is_any(&spot.phrase.words))
            && let Some(nearest) = self.nearest(&found)
        {
            return Ok(Some(nearest));
        }
        let found = self.tagged(&spot.phrase.words, found);
        self.one(noun, within, &found, at)
    }

    /// Whether a word that nothing knows belongs to a noun: "a cup of tea" is no cup.
    fn is_strange(&self, words: &Range<usize>) -> bool {
        let items = self.sentence.items();
        items.iter().any(|item| match item {
            Item::Unknown(unknown) => {
                let beside = unknown.start == words.end || unknown.end == words.start;
                let gap = unknown.start.max(words.start);
                let known = command::is_known(&self.sentence.keys, unknown.start);
                beside && !known && !self.is_parted(gap)
            }
            _ => false,
        })
    }

    /// Whether a mark stands before a word.
    fn is_parted(&self, word: usize) -> bool {
        let (Some(before), Some(after)) = (
            word.checked_sub(1).and_then(|n| self.sentence.words.get(n)),
            self.sentence.words.get(word),
        ) else {
            return true;
        };
        before.end > after.start
            || self.sentence.text[before.end..after.start].contains([',', ';', '.', ':'])
    }

    /// «комнату 2»: of several, the one whose name ends so.
    fn tagged(&self, words: &Range<usize>, found: Vec<Thing>) -> Vec<Thing> {
        let Some(number) = self.number_after(words) else { return found };
        let ends = |t: &Thing| {
            let name = crate::units::name_key(&self.knowledge.name(*t));
            name.rsplit([' ', '-']).next() == Some(number)
        };
        let tagged: Vec<Thing> = found.iter().copied().filter(ends).collect();
        if tagged.is_empty() { found } else { tagged }
    }

    fn number_after(&self, words: &Range<usize>) -> Option<&str> {
        let key = self.sentence.keys.get(words.end)?;
        let is_number = !key.is_empty() && key.chars().all(char::is_numeric);
        (is_number && !self.is_parted(words.end)).then_some(key)
    }

    fn one(
        &self,
        noun: &Noun,
        within: &[Restriction],
        found: &[Thing],
        at: Range<usize>,
    ) -> Result<Option<Thing>, (Doubt, Range<usize>)> {
        match found {
            [only] => Ok(Some(*only)),
            [] if is_described(noun, within) && !self.knowledge.base(&noun.head).is_empty() => {
                Err((self.knowledge.none_such(&with(noun, &self.resting(within))), at))
            }
            [] => Ok(None),
            _ => match (self.strict)(&noun.text).map(Thing::Entity) {
                Some(thing) if found.contains(&thing) && !is_described(noun, within) => {
                    Ok(Some(thing))
                }
                _ => Err((self.knowledge.ambiguous(noun, found), at)),
            },
        }
    }

    /// Places from which something is taken, as those where it was looked for.
    fn resting(&self, within: &[Restriction]) -> Vec<Restriction> {
        let rests = |r: &Restriction| {
            let mut anchors = r.anchors.iter().flat_map(|a| self.knowledge.base(&a.head));
            let are_rooms = anchors.all(|t| t.area().is_some());
            let rel = match r.rel {
                Rel::From | Rel::At if are_rooms => Rel::In,
                Rel::From | Rel::At => Rel::On,
                rel => rel,
            };
            Restriction { rel, ..r.clone() }
        };
        within.iter().map(rests).collect()
    }

    /// What a clause speaks of.
    fn object(
        &self,
        sort: Sort,
        phrase: &Phrase,
        spots: &[&&Spot<'_>],
        more: More,
    ) -> Result<Option<Vec<Thing>>, (Doubt, Range<usize>)> {
        let at = self.bytes(&phrase.words);
        let mut noun = phrase.noun.clone();
        noun.filters.extend(more.value.map(|value| Filter::new(value, false)));
        noun.except.extend(more.except);
        noun.indefinite |= self.is_any(&phrase.words);
        noun.other |= self.is_one_more(&phrase.words);
        if noun.head.anything && (noun.all || noun.text.to_lowercase().contains("everything")) {
            // "Turn off everything in the kitchen"
            noun.plural = true;
        } else if noun.head.anything && noun.other {
            noun.head = Head { things: Some(self.like_spoken()), ..Head::default() };
        } else if noun.head.anything && !self.spoken.is_empty() {
            noun.head = Head { things: Some(self.spoken.clone()), ..Head::default() };
            // "the second one", in the order in which they were told
            if let (Some(rank), None) = (noun.rank, &noun.best) {
                let at = usize::try_from(rank).unwrap_or(usize::MAX).saturating_sub(1);
                return Ok(self.spoken.get(at).map(|t| vec![*t]));
            }
        }
        let noun = &noun;
        let mut within: Vec<Restriction> = Vec::new();
        for spot in spots {
            let anchors = vec![with(&spot.phrase.noun, &spot.within)];
            let rel = match (sort, spot.rel) {
                // «дверь из кухни в коридор»
                (Sort::Door, Rel::To | Rel::In | Rel::On | Rel::From | Rel::Through | Rel::Of) => {
                    Rel::Of
                }
                (_, rel) => rel,
            };
            let anchors = match spot.rel {
                Rel::Between => self.both_ends(spot).unwrap_or(anchors),
                _ => anchors,
            };
            within.push(Restriction { rel, anchors, negated: false });
        }
        if self.is_strange(&phrase.words) {
            return Ok(None);
        }
        let found = self.candidates(noun, &within).map_err(|doubt| (doubt, at.clone()))?;
        let mut found = self.tagged(&phrase.words, found);
        if let Some(there) = more.there {
            found.retain(|t| self.knowledge.area_of(*t) == Some(there));
        }
        if noun.other {
            let given = |t: &Thing| {
                t.replica().is_some_and(|id| self.knowledge.senses.holder(id).is_some())
            };
            found.retain(|t| !given(t));
        }
        let able: Vec<Thing> = found.iter().copied().filter(|t| self.can(sort, *t)).collect();
        if !able.is_empty() {
            found = able;
        } else if matches!(sort, Sort::Switch | Sort::Door | Sort::Carry | Sort::Put) {
            // None of them can be: that is said of one, and not asked which.
            found.truncate(1);
        }
        let lights = |kind| self.knowledge.lexicon().kind(kind).extension == Extension::Lighting;
        let of_light = noun.head.named.is_empty() && noun.head.kinds.iter().any(|k| lights(*k));
        if let Some(wanted) = noun.count.filter(|_| noun.best.is_none()) {
            let wanted = usize::try_from(wanted).unwrap_or(usize::MAX);
            let chosen = match found.len() <= wanted {
                true => found,
                false => self.nearest_of(&found, wanted),
            };
            return Ok((!chosen.is_empty()).then_some(chosen));
        }
        let several = noun.plural || noun.all || (sort == Sort::Switch && of_light);
        if several && !found.is_empty() {
            return Ok(Some(found));
        }
        // «Поезжай на кухню и возьми чашку»: the one that is there.
        let near = |t: &&Thing| self.knowledge.area_of(**t) == more.gone_to;
        if let (Some(_), true, [only]) = (
            more.gone_to,
            found.len() > 1,
            &found.iter().filter(near).copied().collect::<Vec<_>>()[..],
        ) {
            found = vec![*only];
        }
        if (noun.indefinite || sort == Sort::Find || noun.other && self.is_one_more(&phrase.words))
            && let Some(nearest) = self.nearest(&found)
        {
            return Ok(Some(vec![nearest]));
        }
        if sort == Sort::Put && found.len() > 1 {
            // What is put down is what the robot has in its hands.
            let held = self.knowledge.senses.held();
            let in_hand = |t: &&Thing| t.replica().is_some_and(|id| held.contains(&id));
            let held: Vec<Thing> = found.iter().filter(in_hand).copied().collect();
            if held.len() == 1 {
                return Ok(Some(held));
            }
        }
        Ok(self.one(noun, &within, &found, at)?.map(|thing| vec![thing]))
    }

    /// Whatever is of the kind of what was spoken of last: «ещё одну», "another one".
    fn like_spoken(&self) -> Vec<Thing> {
        let world = self.knowledge.world;
        let kind = |object| world.objects.get(&object).and_then(|object| object.object_type);
        let spoken = self.spoken.iter().rev().filter_map(|t| t.replica());
        let mut kinds = spoken.filter_map(|id| kind(world.replicas.get(&id)?.object));
        let Some(wanted) = kinds.next() else { return Vec::new() };
        let alike = world.replicas.values().filter(|r| kind(r.object) == Some(wanted));
        alike.map(|r| Thing::Entity(Entity::Replica(r.id))).collect()
    }

    /// «ещё одну книгу», "another book": any that was not spoken of, where «другую» is the one that is left.
    fn is_one_more(&self, words: &Range<usize>) -> bool {
        let keys = &self.sentence.keys[words.start.saturating_sub(2)..words.end];
        keys.iter().any(|key| matches!(key.as_str(), "еще" | "another"))
    }

    /// «любую книгу»: a question would ask about all of them.
    fn is_any(&self, words: &Range<usize>) -> bool {
        const ANY: [&str; 8] = [
            "любую",
            "любой",
            "любое",
            "any",
            "какую нибудь",
            "some",
            "какой нибудь",
            "какое нибудь",
        ];
        let said =
            |n: usize| self.sentence.keys.get(n).is_some_and(|key| ANY.contains(&key.as_str()));
        said(words.start) || words.start.checked_sub(1).is_some_and(said)
    }

    /// «чашку белую»: the value behind its noun.
    fn value_after(
        &self,
        items: &[Item],
        at: usize,
        phrase: &Phrase,
    ) -> Option<(ValueId, Range<usize>)> {
        let Some(Item::Value(value)) = items.get(at + 1) else { return None };
        let words = phrase.words.end..phrase.words.end + 1;
        (!self.is_parted(words.start)).then_some((*value, words))
    }

    /// «все лампы, кроме торшера»
    fn except_after<'i>(&self, items: &'i [Item], at: usize) -> Option<&'i Phrase> {
        match items.get(at + 1..)? {
            [Item::Mark(Mark::Except), Item::Noun(except), ..] => Some(except),
            _ => None,
        }
    }

    /// Whether words that nothing knows stand between a thing and a place: "to the person in the kitchen".
    fn is_cut_off(&self, items: &[Item], object: usize, place: usize) -> bool {
        let between = items.get(object.min(place)..object.max(place)).unwrap_or_default();
        between.iter().any(|item| match item {
            Item::Unknown(words) => !command::is_known(&self.sentence.keys, words.start),
            _ => false,
        })
    }

    /// «между кухней и коридором»
    fn both_ends(&self, spot: &Spot<'_>) -> Option<Vec<Noun>> {
        match &self.sentence.items()[spot.item] {
            Item::Place { nouns, .. } => Some(nouns.iter().map(|p| p.noun.clone()).collect()),
            _ => None,
        }
    }

    fn candidates(&self, noun: &Noun, within: &[Restriction]) -> Result<Vec<Thing>, Doubt> {
        let knowledge = self.knowledge;
        let either = |rel: Rel| {
            let within: Vec<Restriction> = within
                .iter()
                .map(|r| {
                    let from = matches!(r.rel, Rel::From | Rel::At);
                    Restriction { rel: if from { rel } else { r.rel }, ..r.clone() }
                })
                .collect();
            knowledge.find(&with(noun, &within), true)
        };
        // «со стола», «из шкафа», "from the shelf": on it or in it.
        let mut found = either(Rel::On)?;
        if found.is_empty() && within.iter().any(|r| matches!(r.rel, Rel::From | Rel::At)) {
            found = either(Rel::In)?;
        }
        // "the bedroom door", «дверь спальни» where the map says "in".
        if found.is_empty() && within.iter().any(|r| r.rel == Rel::On) {
            let inside = within.iter().map(|r| match r.rel {
                Rel::On => Restriction { rel: Rel::In, ..r.clone() },
                _ => r.clone(),
            });
            found = knowledge.find(&with(noun, &inside.collect::<Vec<_>>()), true)?;
        }
        found.retain(|t| matches!(t, Thing::Entity(_)));
        Ok(found)
    }

    /// Whether a verb of this sort can be done to a thing at all.
    fn can(&self, sort: Sort, thing: Thing) -> bool {
        let world = self.knowledge.world;
        let has = |wanted: &str| thing.replica().is_some_and(|id| world.has_trait(id, wanted));
        match (sort, thing) {
            (Sort::Carry | Sort::Put, _) => has("portable"),
            (Sort::Switch, _) => has("device"),
            (Sort::Door, Thing::Entity(Entity::Door(door))) => {
                self.knowledge.relations.joins().iter().any(|j| j.door == Some(door))
                    && world.doors.get(&door).is_some_and(|d| !d.leaves.is_empty())
            }
            (Sort::Door, _) => false,
            (Sort::Go | Sort::Find | Sort::Leave | Sort::Other, _) => true,
        }
    }

    fn nearest(&self, found: &[Thing]) -> Option<Thing> {
        match found {
            [] => None,
            [only] => Some(*only),
            _ => self.nearest_of(found, 1).first().copied().or_else(|| found.first().copied()),
        }
    }

    /// The room in which the robot is.
    fn here(&self) -> Option<AreaId> {
        let (map, pose) = self.knowledge.senses.robot()?;
        self.knowledge.relations.measurements().area_at(map, pose.at)
    }

    /// So many of some things, those in the robot's own room first, and then by their distance.
    fn nearest_of(&self, found: &[Thing], wanted: usize) -> Vec<Thing> {
        let knowledge = self.knowledge;
        let here = self.here();

        let mut ranked: Vec<(bool, f64, Thing)> = found
            .iter()
            .map(|t| {
                let away = knowledge.area_of(*t) != here;
                (away, knowledge.distance(*t, Thing::Robot).unwrap_or(f64::INFINITY), *t)
            })
            .collect();
        ranked.sort_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        ranked.into_iter().take(wanted).map(|(_, _, t)| t).collect()
    }
}

/// A description with places that belong to it.
fn with(noun: &Noun, within: &[Restriction]) -> Noun {
    let mut noun = noun.clone();
    noun.restrictions.extend(within.iter().cloned());
    noun
}

/// Whether more than the noun itself tells what is meant.
fn is_described(noun: &Noun, within: &[Restriction]) -> bool {
    let filters: &[Filter] = &noun.filters;
    !filters.is_empty()
        || !noun.restrictions.is_empty()
        || noun.best.is_some()
        || noun.rank.is_some()
        || !within.is_empty()
}

/// The case of a name after a preposition.
fn case_of(rel: Rel, whither: bool) -> Case {
    match rel {
        Rel::To => Case::Dative,
        Rel::In | Rel::On if whither => Case::Accusative,
        Rel::In | Rel::On => Case::Prepositional,
        Rel::Under | Rel::Behind if whither => Case::Accusative,
        Rel::Under | Rel::Behind | Rel::InFrontOf | Rel::Above | Rel::Between => Case::Instrumental,
        Rel::Through => Case::Accusative,
        _ => Case::Genitive,
    }
}
