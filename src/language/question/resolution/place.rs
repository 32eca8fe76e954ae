//! The places of a command: which of them say whither, and which tell where another one is.

use std::collections::BTreeSet;
use std::ops::Range;

use super::choice::{is_described, with};
use super::{Clause, Edit, Resolver, Told};
use crate::command::{self, Sort};
use crate::map::Entity;
use crate::question::Doubt;
use crate::question::grammar::{Item, Phrase};
use crate::question::mark::{Mark, Pronoun};
use crate::question::memory::Exchange;
use crate::question::query::{Head, Noun, Rel, Restriction, Thing};
use crate::units::AreaId;
use crate::words::{Case, Language};

/// A place that was said: the preposition, what follows it, and the places that tell where that is.
pub(super) struct Spot<'i> {
    pub(super) rel: Rel,
    pub(super) phrase: &'i Phrase,
    /// With those that a joint adds to it: the two between which something is.
    pub(super) nouns: &'i [Phrase],
    pub(super) within: Vec<Restriction>,
    /// Bytes, with the preposition.
    pub(super) at: Range<usize>,
    /// Of the places that tell where this one is.
    pub(super) attached: Vec<Range<usize>>,
    pub(super) clause: usize,
    /// The item at which it stands.
    pub(super) item: usize,
}

impl Resolver<'_, '_> {
    /// Whether a place is said as the robot's own: "to the charger".
    pub(super) fn is_haunt(&self, spot: &Spot<'_>) -> bool {
        let words = &spot.phrase.words;
        let said = self.bytes(&(words.start.saturating_sub(1)..words.end));
        self.sentence.text.get(said).is_some_and(command::is_haunt)
    }

    /// Places whose thing was not found out keep their words; those that mean one thing become its name.
    pub(super) fn left_standing(&self, spots: &[&&Spot<'_>], edits: &mut Vec<Edit>) {
        for spot in spots {
            if let Ok(found) = self.candidates(&spot.phrase.noun, &spot.within)
                && let [only] = found[..]
                && is_described(&spot.phrase.noun, &spot.within)
                && !spot.phrase.noun.counts_several()
            {
                let case = case_of(spot.rel, false);
                let at = self.bytes(&spot.phrase.words);
                edits.push(Edit {
                    at,
                    name: self.knowledge.form(only, case),
                    things: vec![only],
                    object: false,
                    goal: None,
                });
                edits.extend(spot.attached.iter().map(Edit::deletion));
            }
        }
    }

    /// The places of a sentence, each with those that tell where it is.
    pub(super) fn spots<'i>(
        &self,
        items: &'i [Item],
        clause_at: impl Fn(usize) -> usize,
        sort: &impl Fn(usize) -> Sort,
    ) -> Vec<Spot<'i>> {
        let mut spots: Vec<Spot<'i>> = Vec::new();
        for (n, item) in items.iter().enumerate() {
            let Item::Place { rel, nouns, either } = item else { continue };
            let Some(phrase) = nouns.first() else { continue };
            let rel = &self.having(*rel, phrase);
            // "The lamps in them": in each of the rooms that were told.
            let in_each = |pronoun| {
                let sort = sort(clause_at(self.bytes(&phrase.words).start));
                matches!(sort, Sort::Switch | Sort::Door)
                    && self.knowledge.places_meant(pronoun, *rel).is_some()
            };
            let idle = phrase.pronoun.is_some_and(|p| *rel != Rel::From && !in_each(p));
            if phrase.person.is_some() || idle {
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
            // "With the bed and the computer" has both.
            let told: Vec<Vec<Noun>> = match *rel == Rel::Has && !either {
                true => anchors.into_iter().map(|anchor| vec![anchor]).collect(),
                false => vec![anchors],
            };
            let told =
                told.into_iter().map(|anchors| Restriction { rel: *rel, anchors, negated: false });
            let adjacent = matches!(n.checked_sub(1).map(|n| &items[n]), Some(Item::Place { .. }));
            if let Some(last) = spots.last_mut()
                && adjacent
                && !self.is_faced(phrase)
                && last.clause == clause
                && phrase.pronoun.is_none()
                && !(sort(clause) == Sort::Put
                    && self.is_put_beside(last, *rel, phrase, &items[n + 1..]))
                && self.tells_where(last, *rel, phrase, sort(clause))
            {
                // "On the nightstand in the bedroom with the computer": the room has it.
                let room = last.within.last_mut().and_then(|place| place.anchors.last_mut());
                match room.filter(|room| *rel == Rel::Has && self.is_room(room)) {
                    Some(room) => room.restrictions.extend(told),
                    None => last.within.extend(told),
                }
                last.attached.push(at);
                continue;
            }
            spots.push(Spot {
                rel: *rel,
                phrase,
                nouns,
                within: Vec::new(),
                at,
                attached: Vec::new(),
                clause,
                item: n,
            });
        }
        spots
    }

    /// Whether a noun is of rooms, and of nothing else.
    fn is_room(&self, noun: &Noun) -> bool {
        let base = self.knowledge.base(&noun.head);
        !base.is_empty() && base.iter().all(|thing| thing.area().is_some())
    }

    /// «стол с вазой» is not «со стола»: its case tells.
    fn having(&self, rel: Rel, phrase: &Phrase) -> Rel {
        let has = |case: Case| phrase.cases.iter().any(|r| r.has_case(case));
        match rel {
            Rel::From if has(Case::Instrumental) && !has(Case::Genitive) => Rel::Has,
            rel => rel,
        }
    }

    /// Whether a place that follows another tells where that one is: «на столе в кухне», "the chair next to the bed".
    fn tells_where(&self, last: &Spot<'_>, rel: Rel, phrase: &Phrase, sort: Sort) -> bool {
        let area = |phrase: &Phrase| {
            let base = self.knowledge.base(&phrase.noun.head);
            !base.is_empty() && base.iter().all(|t| t.area().is_some() || t.is_storey())
        };
        // "The door to the bedroom with the bed"
        if sort == Sort::Door && rel == Rel::Has && self.is_room(&last.phrase.noun) {
            return true;
        }
        if sort == Sort::Door || self.is_whither(rel, phrase) == Some(true) {
            return false;
        }
        match rel {
            // "the toilet on the second floor"
            Rel::In | Rel::On if self.means_storey(phrase) => !self.means_storey(last.phrase),
            // «в холле на втором этаже»
            Rel::On if !last.within.is_empty() => area(phrase),
            Rel::In | Rel::On | Rel::At | Rel::From if area(phrase) => !area(last.phrase),
            // «рядом с чайником на тумбе»: what can be carried lies on something.
            Rel::In | Rel::On => self.is_beside(last),
            Rel::At | Rel::From | Rel::To | Rel::Through => false,
            // «комната с диваном»
            Rel::Has => true,
            // A room that has a name is not told by what it is beside: "the room next to the kitchen" is.
            _ => !area(last.phrase) || last.phrase.noun.head.named.is_empty(),
        }
    }

    /// "Put the statue from the table next to the vase": it goes there, and no table is told by it; "from the chair next to
    /// the bed onto the table" says another whither.
    fn is_put_beside(&self, last: &Spot<'_>, rel: Rel, phrase: &Phrase, after: &[Item]) -> bool {
        let can_be_carried = |phrase: &Phrase| {
            let base = self.knowledge.base(&phrase.noun.head);
            base.iter().any(|t| self.knowledge.can(Sort::Carry, *t))
        };
        let ends = !after.iter().any(|item| matches!(item, Item::Place { .. }));
        last.rel == Rel::From && rel.is_side() && (ends || can_be_carried(phrase))
    }

    /// Whether a place is beside what can be carried.
    fn is_beside(&self, spot: &Spot<'_>) -> bool {
        let base = self.knowledge.base(&spot.phrase.noun.head);
        spot.rel.is_side() && base.iter().any(|t| self.knowledge.can(Sort::Carry, *t))
    }

    /// Whether what is named is a storey, whichever.
    pub(super) fn means_storey(&self, phrase: &Phrase) -> bool {
        let base = self.knowledge.base(&phrase.noun.head);
        !base.is_empty() && base.iter().all(Thing::is_storey)
    }

    /// Whether a place says whither, by its preposition or its case; none where that depends on the verb.
    pub(super) fn is_whither(&self, rel: Rel, phrase: &Phrase) -> Option<bool> {
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
    pub(super) fn destination(
        &self,
        sort: Sort,
        spots: &[&Spot<'_>],
        has_object: bool,
    ) -> Option<usize> {
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
            // «Принеси колу в lounge»: what is there would be brought «из lounge».
            Sort::Carry => told(true).or_else(|| {
                let bare = |n: &usize| has_object && matches!(spots[*n].rel, Rel::On | Rel::In);
                let russian = self.sentence.language == Language::Russian;
                open().filter(bare).filter(|_| russian)
            }),
            // "Go out to the hallway"; "leave the book on the bed"
            Sort::Leave => told(true).or_else(|| {
                let on = |n: &usize| has_object && matches!(spots[*n].rel, Rel::On | Rel::In);
                open().filter(on)
            }),
            Sort::Door | Sort::Switch | Sort::Find | Sort::Other => None,
        }
    }

    /// The window that is meant where windows are: of several in one room the nearest, the robot's own room first.
    fn window(&self, noun: &Noun) -> Option<Thing> {
        let mut found = self.knowledge.find(noun, true).ok()?;
        if found.is_empty() || !found.iter().all(|t| matches!(t, Thing::Window(_))) {
            return None;
        }
        let here = self.here();
        let own = |t: &Thing| self.knowledge.area_of(*t) == here;
        if found.iter().any(own) {
            found.retain(own);
        }
        self.nearest(&found)
    }

    /// What the robot is to look at, in the room where it stands if it is there. A wall is named by no name.
    pub(super) fn face(
        &self,
        spot: &Spot<'_>,
        stands: Option<AreaId>,
        edits: &mut Vec<Edit>,
    ) -> Result<(), (Doubt, Range<usize>)> {
        if self.knowledge.is_walls(&spot.phrase.noun) {
            return Ok(());
        }
        let room = stands.map(|area| {
            let things = Some(vec![Thing::Entity(Entity::Area(area))]);
            let anchors =
                vec![Noun { head: Head { things, ..Head::default() }, ..Noun::default() }];
            Restriction { rel: Rel::In, anchors, negated: false }
        });
        let within: Vec<Restriction> = spot.within.iter().cloned().chain(room).collect();
        let there = self.place(spot, &within).unwrap_or_default();
        let seen = there.map_or_else(|| self.place(spot, &spot.within), |there| Ok(Some(there)))?;
        if let (Some(thing @ Thing::Window(_)), Some(stands)) = (seen, stands)
            && self.knowledge.area_of(thing) != Some(stands)
        {
            let noun = with(&spot.phrase.noun, &within);
            return Err((self.knowledge.none_such(&noun), self.bytes(&spot.phrase.words)));
        }
        if let Some(thing) = seen {
            let at = self.bytes(&spot.phrase.words);
            let name = self.knowledge.form(self.told_by(thing), Case::Dative);
            edits.push(Edit { at, name, things: vec![thing], object: false, goal: None });
            edits.extend(spot.attached.iter().map(Edit::deletion));
        }
        Ok(())
    }

    /// What a thing is named by: a window has no name, and is told by its room.
    pub(super) fn told_by(&self, thing: Thing) -> Thing {
        match (thing, self.knowledge.area_of(thing)) {
            (Thing::Window(_), Some(room)) => Thing::Entity(Entity::Area(room)),
            _ => thing,
        }
    }

    /// The one thing that a place means, none where the words are left to be read as they are.
    pub(super) fn place(
        &self,
        spot: &Spot<'_>,
        within: &[Restriction],
    ) -> Result<Option<Thing>, (Doubt, Range<usize>)> {
        let noun = &spot.phrase.noun;
        let at = self.bytes(&spot.phrase.words);
        if self.is_strange(&spot.phrase.words) {
            return Ok(None);
        }
        self.counts_nothing(spot)?;
        let described = with(noun, within);
        if let Some(window) = self.window(&described) {
            return Ok(Some(window));
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
        self.one(noun, within, &found, at)
    }

    /// One place is meant by a place: «на два стола» is none, and of two that are joined each would be needed.
    pub(super) fn counts_nothing(&self, spot: &Spot<'_>) -> Result<(), (Doubt, Range<usize>)> {
        let anchors = spot.nouns.iter().map(|p| p.noun.clone()).collect();
        let place = Restriction { rel: spot.rel, anchors, negated: false };
        let restrictions = std::iter::once(place).chain(spot.within.iter().cloned()).collect();
        self.without_idle_count(&Noun { restrictions, ..Noun::default() }, &spot.phrase.words)
    }

    /// # Errors
    /// A number of the description counts nothing: «ближайший к 5 кроватям».
    pub(super) fn without_idle_count(
        &self,
        noun: &Noun,
        words: &Range<usize>,
    ) -> Result<(), (Doubt, Range<usize>)> {
        match noun.idle_count() {
            Some(idle) => Err((Doubt::not_understood(&idle.text), self.bytes(words))),
            None => Ok(()),
        }
    }

    /// The places of which «там» says that a thing is there: «принеси оттуда» tells where it is, «принеси туда» whither.
    ///
    /// # Errors
    /// Of several places none was spoken of more than the others.
    pub(super) fn places_there(
        &self,
        clause: &Clause<'_>,
        told: &Told,
    ) -> Result<Option<Vec<Thing>>, (Doubt, Range<usize>)> {
        let says = |(_, p): &(usize, &Phrase)| matches!(p.person, Some(Mark::There));
        // «Возьми там тарелку», "bring the plate there"
        let tells_where = |phrase: &Phrase| {
            let key = self.sentence.keys[phrase.words.start].as_str();
            key == "оттуда" || (key == "там" && clause.sort == Sort::Carry)
        };
        let is_where = !matches!(clause.sort, Sort::Go | Sort::Put | Sort::Carry)
            || clause.objects.iter().any(|(_, p)| p.person.is_some() && tells_where(p));
        let said = clause.objects.iter().find(|object| says(object) && is_where);
        let words = said.map(|(_, phrase)| phrase.words.clone());
        let (Some(words), Some(place)) =
            (words.or_else(|| self.words_for_there(clause)), told.place)
        else {
            return Ok(None);
        };
        let places = match told.has_named {
            true => vec![self.knowledge.bearer_there(place)],
            false => self.knowledge.places_spoken_of(),
        };
        match places.is_empty() {
            true => {
                let word = self.sentence.said(&words).to_owned();
                Err((Doubt::NoReferent { word }, self.bytes(&words)))
            }
            false => Ok(Some(places)),
        }
    }

    /// «Положи газету на диван и выключи там свет»: in the room, where nothing of the kind is on the sofa.
    pub(super) fn in_rooms_there(
        &self,
        noun: &Noun,
        places: &[Thing],
    ) -> Result<Vec<Thing>, Doubt> {
        let rooms = places.iter().filter(|place| place.replica().is_some());
        let rooms = rooms.filter_map(|place| self.knowledge.area_of(*place));
        let rooms: BTreeSet<AreaId> = rooms.collect();
        let rooms: Vec<Thing> =
            rooms.into_iter().map(|id| Thing::Entity(Entity::Area(id))).collect();
        if rooms.is_empty() {
            return Ok(Vec::new());
        }
        let place = Noun { plural: rooms.len() > 1, ..Noun::of(rooms) };
        let within = Restriction { rel: Rel::In, anchors: vec![place], negated: false };
        self.candidates(noun, &[within])
    }

    /// «Положи книгу на кровать. Где газета? Отнеси её туда же»: "there" is whither the last order went, never where what is
    /// carried is itself.
    pub(super) fn no_place_of_its_own(
        &self,
        thing: Thing,
        objects: &[(usize, &Phrase)],
        told: &Told,
        there: &Phrase,
    ) -> Result<Thing, (Doubt, Range<usize>)> {
        let memory = self.knowledge.memory;
        let spoken = memory.last_things();
        let carries = |(_, phrase): &(usize, &Phrase)| match phrase.pronoun {
            Some(Pronoun::They) => spoken.contains(&thing),
            Some(_) => memory.last_thing() == Some(thing),
            None => false,
        };
        let itself = told.things.contains(&thing) || objects.iter().any(carries);
        if told.has_named || memory.told_place.is_some() || !itself {
            return Ok(thing);
        }
        let before = memory.exchanges.iter().find_map(Exchange::whither);
        before.filter(|place| *place != thing && !told.things.contains(place)).ok_or_else(|| {
            let word = there.noun.text.clone();
            (Doubt::NoReferent { word }, self.bytes(&there.words))
        })
    }

    /// «туда»: to what was spoken of; what is brought goes onto it, or into what holds things. None where "on it" says whither.
    pub(super) fn to_there(
        &self,
        thing: Thing,
        sort: Sort,
        phrase: &Phrase,
        items: &[Item],
        upon: Option<Rel>,
    ) -> Result<Option<Edit>, (Doubt, Range<usize>)> {
        let at = self.bytes(&phrase.words);
        let by_pronoun = |item: &Item| match item {
            Item::Place { nouns, .. } => nouns.iter().any(|place| place.pronoun.is_some()),
            _ => false,
        };
        let inside = self.sentence.keys[phrase.words.start] == "in";
        let (thing, rel) = match sort {
            Sort::Go => (thing, None),
            _ if items.iter().any(by_pronoun) => return Ok(None),
            _ => match self.knowledge.bearer_there(thing) {
                place if inside && place.replica().is_some() => (place, Some(Rel::In)),
                place if upon.is_some() && place == thing => (place, upon),
                place => {
                    let rel = self.knowledge.in_or_on_there(place);
                    (place, rel.map_err(|doubt| (doubt, at.clone()))?)
                }
            },
        };
        let (to, case) = match rel {
            Some(Rel::In) => (self.knowledge.pick("в", "into"), Case::Accusative),
            Some(_) => (self.knowledge.pick("на", "onto"), Case::Accusative),
            None => (self.knowledge.pick("к", "to"), Case::Dative),
        };
        let name = format!("{to} {}", self.knowledge.form(thing, case));
        Ok(Some(Edit { at, name, things: vec![thing], object: false, goal: None }))
    }

    /// "Bring the mug from there": the words, with the preposition.
    pub(super) fn words_for_there(&self, clause: &Clause<'_>) -> Option<Range<usize>> {
        let first = clause.objects.first()?.0;
        let own = clause.items.get(first..)?;
        own.iter().find_map(|item| match item {
            Item::Place { rel: Rel::From, nouns, .. } => {
                let phrase = nouns.first().filter(|p| matches!(p.person, Some(Mark::There)))?;
                let link = command::link_before(&self.sentence.keys, phrase.words.start);
                Some(phrase.words.start - link..phrase.words.end)
            }
            _ => None,
        })
    }
}

/// The case of a name after a preposition.
pub(in crate::question) fn case_of(rel: Rel, whither: bool) -> Case {
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
