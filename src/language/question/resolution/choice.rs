//! Which things of the map fit a description, and which one is taken of several.

use std::ops::Range;

use super::Resolver;
use crate::command::Sort;
use crate::question::Doubt;
use crate::question::focus::is_shown;
use crate::question::grammar::{Item, Phrase, points};
use crate::question::memory::Exchange;
use crate::question::query::{Filter, Head, Noun, Rel, Restriction, Thing};
use crate::sets::set;
use crate::units::{AreaId, InOrder as _};

impl Resolver<'_, '_> {
    pub(super) fn candidates(
        &self,
        noun: &Noun,
        within: &[Restriction],
    ) -> Result<Vec<Thing>, Doubt> {
        let knowledge = self.knowledge;
        // «те, что на комоде», "the one in the hall": of those that were spoken of.
        if points(noun) {
            let memory = knowledge.memory;
            // "The smaller one" is one of several that were compared, or told together, last.
            let compared = || {
                let told = memory.exchanges.iter().flat_map(|e| [e.compared(), e.members()]);
                told.into_iter().find(|all| all.len() > 1).unwrap_or_default().to_vec()
            };
            // "Is the bathroom door shut? – Yes. – Open the bedroom one": of its kind.
            let like = memory.exchanges.iter().map(|exchange| {
                exchange.things().flat_map(|thing| knowledge.all_like(*thing)).collect()
            });
            let lists: Vec<Vec<Thing>> = match noun.best.is_some() {
                true => vec![compared()],
                false => std::iter::once(memory.listed.clone()).chain(like).collect(),
            };
            for spoken in lists.into_iter().filter(|all| !all.is_empty()) {
                let head = Head { things: Some(spoken), ..Head::default() };
                let found = self.candidates(&Noun { head, ..noun.clone() }, within)?;
                if !found.is_empty() {
                    return Ok(found);
                }
            }
            // What of those that were told is nowhere there is not denied: something else was meant.
            return Err(Doubt::NoReferent { word: noun.text.clone() });
        }
        if let Some(at) = within.iter().position(|r| r.rel == Rel::Has) {
            return self.bearing(noun, within, at);
        }
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
        // «дверь между кухней и спальней», where the one that is called so has none: another of the kind is meant.
        if found.is_empty() && !(noun.plural || noun.all) {
            found = self.at_others_of_the_kind(noun, within)?;
        }
        let are_any = !found.is_empty();
        found.retain(|t| matches!(t, Thing::Entity(_)));
        // What is there and has no name of its own, a window, cannot be a goal; it is not denied.
        if are_any && found.is_empty() {
            return Err(Doubt::not_understood(&noun.text));
        }
        Ok(found)
    }

    /// What a description fits where each place that is told by a name which is a kind's as well may be any of the kind.
    fn at_others_of_the_kind(
        &self,
        noun: &Noun,
        within: &[Restriction],
    ) -> Result<Vec<Thing>, Doubt> {
        let mut found = Vec::new();
        for (n, place) in within.iter().enumerate() {
            for (m, anchor) in place.anchors.iter().enumerate() {
                let Some(of_kind) = anchor.of_kind() else { continue };
                for thing in self.knowledge.find(&of_kind, true)? {
                    let mut places = within.to_vec();
                    places[n].anchors[m] =
                        Noun { text: anchor.text.clone(), ..Noun::of(vec![thing]) };
                    found.extend(self.candidates(noun, &places)?);
                }
            }
        }
        found.order();
        found.dedup();
        Ok(found)
    }

    /// «стол с вазой»: what bears or holds one of the things that it is said to be with.
    fn bearing(&self, noun: &Noun, within: &[Restriction], at: usize) -> Result<Vec<Thing>, Doubt> {
        let mut others = within.to_vec();
        let with = others.remove(at);
        let mut found = self.candidates(noun, &others)?;
        let relations = self.knowledge.relations;
        let bears = |t: &Thing, b: &Thing| match (b.replica(), t.area()) {
            (None, _) => false,
            (Some(b), Some(area)) => relations.area_of(b) == Some(area),
            (Some(b), None) => t.replica().is_some() && relations.support_of(b) == t.replica(),
        };
        let mut borne = Vec::new();
        for anchor in &with.anchors {
            let any = Noun { count: None, ..anchor.clone() };
            borne.push((self.knowledge.find(&any, true)?, anchor));
        }
        let has = |t: &Thing, of: &dyn Fn(&Thing, &Thing) -> bool| {
            borne.iter().any(|(all, anchor)| {
                let count = all.iter().filter(|b| of(t, b)).count() as u64;
                // "The table with two cups" bears so many and no other number.
                match anchor.count.filter(|_| anchor.best.is_none()) {
                    Some(asked) => count > 0 && anchor.quantity.admits(count, asked),
                    None => count > 0,
                }
            })
        };
        let of_none = !found.iter().any(|t| has(t, &bears));
        // "The desk with the computer" under it, or beside it, where none bears one.
        let stands = [Rel::Under, Rel::NextTo].into_iter().find_map(|rel| {
            let by = |t: &Thing, b: &Thing| {
                t.replica().is_some()
                    && b.replica().is_some()
                    && self.knowledge.related(rel, *t).contains(b)
            };
            let with: Vec<Thing> = found.iter().copied().filter(|t| has(t, &by)).collect();
            (of_none && !with.is_empty()).then_some(with)
        });
        match stands {
            Some(with) => found = with,
            None => found.retain(|t| has(t, &bears)),
        }
        match (found.is_empty(), noun.of_kind()) {
            (true, Some(of_kind)) => self.bearing(&of_kind, within, at),
            _ => Ok(found),
        }
    }

    /// «комнату 2»: what is named with a number behind it is the one whose name ends so, and no other.
    ///
    /// # Errors
    /// No name ends so: the number is a part of what was said, and is not passed over.
    pub(super) fn numbered(&self, items: Vec<Item>) -> Result<Vec<Item>, (Doubt, Range<usize>)> {
        let mut numbered: Vec<Item> = Vec::with_capacity(items.len());
        for item in items {
            let phrase = match (&item, numbered.last_mut()) {
                (Item::Number(_), Some(Item::Noun(phrase))) => Some(phrase),
                (Item::Number(_), Some(Item::Place { nouns, .. })) => nouns.last_mut(),
                _ => None,
            };
            let Some(phrase) = phrase else {
                numbered.push(item);
                continue;
            };
            let named = phrase.pronoun.is_none() && phrase.person.is_none();
            match self.number_after(&phrase.words).filter(|_| named) {
                Some(number) => {
                    phrase.words.end += 1;
                    self.tag(phrase, number)?;
                }
                None => numbered.push(item),
            }
        }
        Ok(numbered)
    }

    /// Leaves of what a noun may mean what is called by a number.
    fn tag(&self, phrase: &mut Phrase, number: &str) -> Result<(), (Doubt, Range<usize>)> {
        let ends = |t: &Thing| {
            let name = crate::units::name_key(&self.knowledge.name(*t));
            name.rsplit([' ', '-']).next() == Some(number)
        };
        let head = &mut phrase.noun.head;
        let mut tagged = self.knowledge.base(head);
        tagged.retain(ends);
        if tagged.is_empty() {
            let reference = self.sentence.said(&phrase.words).to_owned();
            let unknown = Doubt::Unknown { reference, near: Vec::new() };
            return Err((unknown, self.bytes(&phrase.words)));
        }
        *head = Head { things: Some(tagged), ..Head::default() };
        Ok(())
    }

    pub(super) fn one(
        &self,
        noun: &Noun,
        within: &[Restriction],
        found: &[Thing],
        at: Range<usize>,
    ) -> Result<Option<Thing>, (Doubt, Range<usize>)> {
        // Of several one is none: «между 77 диваном и столом».
        if noun.counts_several() {
            return Err((Doubt::not_understood(&noun.text), at));
        }
        match found {
            [only] => Ok(Some(*only)),
            // "The lightest thing from the dresser", whose weights the map does not give: there are things.
            [] if noun.best.is_some() => {
                let plain = Noun { best: None, ..noun.clone() };
                let all = self.candidates(&plain, within).map_err(|doubt| (doubt, at.clone()))?;
                match all.is_empty() {
                    true => self.one(&plain, within, &all, at),
                    false => Err((self.knowledge.ambiguous(noun, &all), at)),
                }
            }
            [] if is_described(noun, within) && !self.knowledge.base(&noun.head).is_empty() => {
                Err((self.knowledge.none_such(&with(noun, &self.resting(within))), at))
            }
            [] => Ok(None),
            // "Put it on that table"
            _ if is_shown(noun)
                && let Some(shown) = self.knowledge.in_focus(found) =>
            {
                Ok(Some(shown))
            }
            _ => match (self.strict)(&noun.text).map(Thing::Entity) {
                Some(thing) if found.contains(&thing) && !is_described(noun, within) => {
                    Ok(Some(thing))
                }
                _ => Err((self.knowledge.ambiguous(noun, found), at)),
            },
        }
    }

    /// Places from which something is taken, as those where it was looked for.
    pub(super) fn resting(&self, within: &[Restriction]) -> Vec<Restriction> {
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

    pub(super) fn nearest(&self, found: &[Thing]) -> Option<Thing> {
        match found {
            [] => None,
            [only] => Some(*only),
            _ => self.nearest_of(found, 1).first().copied().or_else(|| found.first().copied()),
        }
    }

    /// "One pen from each room": so many for each of the places where there are any; none where nothing is told of each.
    ///
    /// # Errors
    /// In one of the places there are some, but not so many.
    pub(super) fn of_each(
        &self,
        noun: &Noun,
        within: &[Restriction],
        found: &[Thing],
    ) -> Result<Option<Vec<Thing>>, Doubt> {
        let of_all = |place: &Restriction| {
            !place.negated && matches!(&place.anchors[..], [anchor] if anchor.all)
        };
        let counted = noun.count.filter(|_| noun.best.is_none());
        let wanted = match counted {
            Some(wanted) => usize::try_from(wanted).unwrap_or(usize::MAX),
            None if noun.all => return Ok(None),
            None if noun.plural && !self.has_no_singular(noun) => return Ok(None),
            None => 1,
        };
        let Some(at) = within.iter().position(of_all) else { return Ok(None) };
        let places = self.knowledge.find(&within[at].anchors[0], true)?;
        if noun.best.is_some() || places.len() < 2 {
            return Ok(None);
        }
        let mut chosen: Vec<Thing> = Vec::new();
        for place in places {
            let mut there = within.to_vec();
            there[at].anchors = vec![Noun::of(vec![place])];
            let mut own = self.candidates(noun, &there)?;
            own.retain(|thing| found.contains(thing) && !chosen.contains(thing));
            if !own.is_empty() && own.len() < wanted {
                return Err(Doubt::TooFew { found: own });
            }
            chosen.extend(self.nearest_of(&own, wanted));
        }
        Ok((!chosen.is_empty()).then_some(chosen))
    }

    /// Of several things that fit, the only one in a room.
    pub(super) fn only_one_in(
        &self,
        room: AreaId,
        noun: &Noun,
        within: &[Restriction],
    ) -> Option<Thing> {
        let found = self.candidates(noun, within).ok().filter(|found| found.len() > 1)?;
        let mut there = found
            .into_iter()
            .filter(|t| t.replica().is_some() && self.knowledge.area_of(*t) == Some(room));
        there.next().filter(|_| there.next().is_none() && !noun.counts_several())
    }

    /// "Go to the living room. – Go to the TV stand there": the room of which was spoken last, where the words point at it; "that
    /// stand" is the one there, where none was spoken of.
    pub(super) fn room_pointed_at(&self, sort: Sort, phrase: &Phrase) -> Option<AreaId> {
        let there = |key: &String| set!("ThereWord").contains(&key.as_str());
        let points = sort == Sort::Go && self.sentence.keys.iter().any(there);
        let found = || self.knowledge.find(&phrase.noun, true).unwrap_or_default();
        let is_shown = is_shown(&phrase.noun) && self.knowledge.in_focus(&found()).is_none();
        let topic = self.knowledge.memory.exchanges.first().and_then(Exchange::topic);
        topic.filter(|_| points || is_shown).and_then(Thing::area)
    }

    /// The room in which the robot is.
    pub(super) fn here(&self) -> Option<AreaId> {
        let (map, pose) = self.knowledge.senses.robot()?;
        self.knowledge.relations.measurements().area_at(map, pose.at)
    }

    /// So many of some things, those in the robot's own room first, and then by their distance.
    pub(super) fn nearest_of(&self, found: &[Thing], wanted: usize) -> Vec<Thing> {
        let knowledge = self.knowledge;
        let here = self.here();

        let mut ranked: Vec<(bool, f64, Thing)> = found
            .iter()
            .map(|t| {
                let away = knowledge.area_of(*t) != here;
                (away, knowledge.distance(*t, Thing::Robot).unwrap_or(f64::INFINITY), *t)
            })
            .collect();
        ranked.order_by(|a, b| a.0.cmp(&b.0).then(a.1.total_cmp(&b.1)).then(a.2.cmp(&b.2)));
        ranked.into_iter().take(wanted).map(|(_, _, t)| t).collect()
    }
}

/// A description with places that belong to it.
pub(super) fn with(noun: &Noun, within: &[Restriction]) -> Noun {
    let mut noun = noun.clone();
    noun.restrictions.extend(within.iter().cloned());
    noun
}

/// Whether more than the noun itself tells what is meant.
pub(super) fn is_described(noun: &Noun, within: &[Restriction]) -> bool {
    let filters: &[Filter] = &noun.filters;
    !filters.is_empty()
        || !noun.restrictions.is_empty()
        || noun.best.is_some()
        || noun.rank.is_some()
        || !noun.except.is_empty()
        || !within.is_empty()
}
