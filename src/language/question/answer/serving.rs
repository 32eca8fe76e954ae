//! What serves for an activity: which things and where they are, "Knife 1 (on Counter 1 in the kitchen) will do."
//!
//! Invariant: who asks for something to use is told where it is: a few things by their places, more by their rooms.

use std::collections::BTreeSet;

use super::{Draft, grouped};
use crate::map::Entity;
use crate::question::knowledge::Knowledge;
use crate::question::lexicon::lower_first;
use crate::question::purposes::{self, Role};
use crate::question::query::{Asked, Head, Noun, Query, Thing};
use crate::question::uses;
use crate::question::{Doubt, Said};
use crate::units::Gather as _;
use crate::words::things::things;
use crate::words::{Case, NounPhrase, Number, WordHints, alternatives, english, enumerate};

/// So many things are told each with its own place.
const FEW: usize = 4;
/// So many where only their places are asked for.
const SEVERAL: usize = 12;

impl Knowledge<'_> {
    pub(super) fn serving(&self, sort: u16, of: &Noun, asked: Asked) -> Result<Draft, Doubt> {
        let found = self.find(of, false)?;
        if found.is_empty() {
            return Ok(self.nothing_serves(sort, of));
        }
        let mut facts = self.facts_of(of, &found);
        if asked == Asked::Suits {
            let text =
                format!("{}{}", self.pick("да, ", "yes, "), self.told_of_kinds(&found, &[sort]));
            return Ok(Draft::new(Said::Yes, text).with(found));
        }
        if asked == Asked::Where {
            return match found.len() <= SEVERAL {
                true => self.say_where(of),
                false => {
                    let text = self.told_by_room(&found);
                    Ok(Draft { facts, ..Draft::new(Said::Found, text).with(found) })
                }
            };
        }
        let place = self.restrictions(of);
        let blank = if place.is_empty() { "" } else { " " };
        let few = found.len() <= FEW || (place.is_empty() && self.in_each_room(&found).len() == 1);
        let listed = |either: bool| match (few, place.is_empty()) {
            (true, _) if found.len() > FEW => {
                let room = self.in_room(found[0]).unwrap_or_default();
                format!("{} ({room})", self.list(&found))
            }
            (true, _) => self.told_with_places(of, &found, either),
            (false, true) => self.told_by_room(&found),
            (false, false) => self.list(&found),
        };
        let patient = purposes::role(sort) == Role::Patient;
        let colon = if few || !place.is_empty() { "" } else { ":" };
        let comma = if place.is_empty() { "" } else { ", " };
        let text = match (asked, self.is_russian()) {
            (Asked::HowMany, true) => {
                format!("{place}{blank}{}: {}", self.counted(of, found.len()), listed(false))
            }
            (Asked::HowMany, false) => {
                let counted = self.counted(of, found.len());
                format!("{counted}{blank}{place}: {}", listed(false))
            }
            (Asked::Whether, true) => format!("да, {place}{blank}есть{colon} {}", listed(false)),
            (Asked::Whether, false) => match few {
                true => format!("yes, there {} {}{blank}{place}", self.is(&found), listed(false)),
                false => format!("yes{comma}{place}: {}", listed(false)),
            },
            (_, true) if patient => format!("{place}{blank}есть{colon} {}", listed(false)),
            (_, true) => format!("{place}{blank}для этого есть{colon} {}", listed(false)),
            (_, false) if patient => {
                format!("{place}{comma}there {}{colon} {}", self.is(&found), listed(false))
            }
            (_, false) if few => format!("{place}{comma}{} will do", listed(true)),
            (_, false) => format!("{place}{comma}any of these will do: {}", listed(false)),
        };
        for thing in found.iter().take(FEW) {
            self.short_place(*thing, &mut facts);
        }
        let said = if asked == Asked::Whether { Said::Yes } else { Said::Found };
        let draft = Draft { facts, ..Draft::new(said, text).with(found) };
        let number = draft.things.len() as f64;
        Ok(if asked == Asked::HowMany { draft.number(number) } else { draft })
    }

    /// «Нож-1 и Нож-2 (на Столе-1 на Кухне)»; where the room was said, without it.
    fn told_with_places(&self, of: &Noun, found: &[Thing], either: bool) -> String {
        let room = of.restrictions.is_empty();
        // "on the counter": nothing is left to be told.
        let whole = |anchor: &Noun| {
            let found = self.find(anchor, true).unwrap_or_default();
            found.iter().all(|t| t.area().is_some())
        };
        let in_room = of.restrictions.iter().flat_map(|r| &r.anchors).all(whole);
        let joined = |names: &[String]| match either {
            true => alternatives(names, self.language),
            false => enumerate(names, self.language),
        };
        let places = grouped(found, |thing| {
            let support = thing.replica().and_then(|id| self.relations.support_of(id));
            let support = support.map(|id| Thing::Entity(Entity::Replica(id)));
            match (room, support) {
                (true, _) => self.short_place(thing, &mut Vec::new()),
                (false, Some(on)) if in_room => self.place(self.on_or_in(thing, on), &[on]),
                (false, _) => String::new(),
            }
        });
        let several = places.len() > 1;
        let told = |(place, things): &(String, Vec<Thing>)| {
            let names: Vec<String> = things.iter().map(|thing| self.name(*thing)).collect();
            let names = if several { enumerate(&names, self.language) } else { joined(&names) };
            if place.is_empty() { names } else { format!("{names} ({place})") }
        };
        joined(&places.iter().map(told).collect::<Vec<_>>())
    }

    /// «в Спальне – Книга-1 и Книга-2; на Кухне – Газета-1»
    fn told_by_room(&self, found: &[Thing]) -> String {
        let told = |(room, things): &(String, Vec<Thing>)| match self.is_russian() {
            true => format!("{room} – {}", self.list(things)),
            false => format!("{} {room}", self.list(things)),
        };
        self.in_each_room(found).iter().map(told).collect::<Vec<_>>().join("; ")
    }

    /// The rooms that things are in, in words, each with its things.
    pub(super) fn in_each_room(&self, found: &[Thing]) -> Vec<(String, Vec<Thing>)> {
        grouped(found, |thing| {
            let room = self.in_room(thing);
            room.unwrap_or_else(|| self.short_place(thing, &mut Vec::new()))
        })
    }

    /// «на Кухне нет ничего для резки»; what there is elsewhere is told beside.
    fn nothing_serves(&self, sort: u16, of: &Noun) -> Draft {
        let place = match self.restrictions(of) {
            none if none.is_empty() => self.pick("на карте", "on the map").to_owned(),
            place => place,
        };
        let names = things().sorts.get(usize::from(sort));
        let russian = names.map_or("", |sort| &*sort.russian[0]);
        let english = names.map_or("", |sort| &*sort.english[0]);
        let plain = of.filters.is_empty() && of.head.named.is_empty();
        let but = of.other || !of.except.is_empty();
        let text = match (self.is_russian(), plain) {
            (true, _) if but => format!("{place} больше ничего для этого нет"),
            (false, _) if but => format!("there is nothing else for that {place}"),
            (true, true) if let Some(rest) = russian.strip_prefix("вещь ") => {
                format!("{place} нет ничего {rest}")
            }
            (true, true) if let Some(rest) = russian.strip_prefix("место ") => {
                format!("{place} нет места {rest}")
            }
            (false, true) if let Some(rest) = english.strip_prefix("thing ") => {
                format!("there is nothing {rest} {place}")
            }
            (false, true) if english.starts_with("place ") => {
                format!("there is no {english} {place}")
            }
            (true, _) => format!("{place} нет {}", self.none_of(of)),
            (false, _) => self.there_is_no(of, &place),
        };
        let anywhere = Noun { restrictions: Vec::new(), ..of.clone() };
        let elsewhere = self.find(&anywhere, true).unwrap_or_default();
        if of.restrictions.is_empty() || elsewhere.is_empty() || elsewhere.len() > FEW {
            return Draft::new(Said::Nothing, text);
        }
        let told = self.told_with_places(&anywhere, &elsewhere, false);
        let text = match self.is_russian() {
            true => format!("{text}, но есть {told}"),
            false => format!("{text}, but there {} {told}", self.is(&elsewhere)),
        };
        Draft::new(Said::Nothing, text).about(&elsewhere)
    }

    /// «чашки и кружки – вещи для питья»: why what was found serves.
    pub(in crate::question) fn why_serving(&self, query: &Query) -> Option<Draft> {
        let Query::Serving { sort, of, .. } = query else { return None };
        let found = self.find(of, true).ok().filter(|found| !found.is_empty())?;
        let text = self.told_of_kinds(&found, &[*sort]);
        let text = format!("{}{text}", self.pick("потому что ", "because "));
        Some(Draft::plain(Said::Found, text).with(found))
    }

    /// «вантузы – вещи для прочистки»: what such things are used for.
    pub(super) fn purpose(&self, of: &Noun) -> Result<Draft, Doubt> {
        let found = self.find(of, false)?;
        if found.is_empty() {
            return Ok(Draft::new(Said::Nothing, self.nothing_found(of, &self.restrictions(of))));
        }
        let serves = |sort: &u16| {
            let kinds = self.lexicon().kinds_of_sort(*sort);
            let things = self.base(&Head { kinds, ..Head::default() });
            found.iter().all(|t| things.contains(t))
        };
        let sorts: Vec<u16> = uses::all_sorts().filter(serves).collect();
        if sorts.is_empty() {
            let text = self
                .pick("на карте не указано, для чего это", "the map does not say what it is for");
            return Ok(Draft::new(Said::Unknown, text.to_owned()).about(&found));
        }
        let text = self.told_of_kinds(&found, &sorts);
        Ok(Draft::new(Said::Found, text).with(found))
    }

    /// «чашки и кружки – вещи для питья», "cups and mugs are things to drink from"
    fn told_of_kinds(&self, found: &[Thing], sorts: &[u16]) -> String {
        let russian = |name: &str| {
            let phrase = NounPhrase::parse(name, &WordHints::default());
            lower_first(&phrase.form(Case::Nominative, Number::Plural))
        };
        let plural = |kind: &String| match self.is_russian() {
            true => russian(kind),
            false if english::is_plural(kind) => kind.clone(),
            false => english::plural(kind),
        };
        let kind = |t: &Thing| self.kind_name(*t).unwrap_or_else(|| self.name(*t)).to_lowercase();
        let kinds: BTreeSet<String> = found.iter().map(kind).gather();
        let kinds: Vec<String> = kinds.iter().map(plural).collect();
        let own =
            sorts.iter().filter_map(|sort| self.lexicon().kinds_of_sort(*sort).first().copied());
        let own: Vec<String> = own
            .map(|id| self.lexicon().kind(id))
            .map(|sort| match self.is_russian() {
                true => russian(sort.phrase.name()),
                false => english::plural(&sort.english),
            })
            .collect();
        let (kinds, own) = (enumerate(&kinds, self.language), enumerate(&own, self.language));
        match self.is_russian() {
            true => format!("{kinds} – {own}"),
            false => format!("{kinds} are {own}"),
        }
    }
}
