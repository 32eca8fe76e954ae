//! From a query to its answer: what was found, the facts it rests on, and the sentence.

use crate::language::words::{Case, Language, Number, enumerate, russian};
use crate::map::{DoorStatus, Entity};

use super::knowledge::Knowledge;
use super::lexicon::Extension;
use super::query::{
    Claim, Closeness, Dimension, Extreme, Noun, Query, Rel, Restriction, Thing, Use,
};
use super::speech::{area, length, sentence};
use super::values::Property;
use super::{Answer, Doubt, Fact, Said};

/// An answer on its way: what is known of it beside its words.
#[derive(Debug, Default)]
pub(super) struct Draft {
    said: Option<Said>,
    text: String,
    things: Vec<Thing>,
    facts: Vec<Fact>,
    /// What pronouns mean from now on, beside the things.
    topic: Vec<Thing>,
    number: Option<f64>,
}

impl Draft {
    fn new(said: Said, text: String) -> Self {
        Self { said: Some(said), text, ..Self::default() }
    }

    pub(super) fn plain(said: Said, text: String) -> Self {
        Self::new(said, text)
    }

    pub(super) fn rest_on(&mut self, fact: Fact) {
        self.facts.push(fact);
    }

    fn with(mut self, things: Vec<Thing>) -> Self {
        self.things = things;
        self
    }

    fn about(mut self, topic: &[Thing]) -> Self {
        self.topic.extend_from_slice(topic);
        self
    }

    fn number(mut self, number: f64) -> Self {
        self.number = Some(number);
        self
    }
}

impl Knowledge<'_> {
    /// # Errors
    /// A description that fits several things where one is meant, or none.
    pub(super) fn answer(&self, query: &Query) -> Result<Answer, Doubt> {
        let draft = match query {
            Query::Where(noun) => self.say_where(noun)?,
            Query::RoomOf(noun) => self.room_of(noun)?,
            Query::Find(noun) => self.say_found(noun)?,
            Query::Count(noun) => self.count(noun)?,
            Query::Exists { what, either, negated } => self.exists(what, *either, *negated)?,
            Query::Holds { subject, claims, negated } => {
                self.say_holds(subject, claims, *negated)?
            }
            Query::Choice { subject, claims } => self.choose(subject, claims)?,
            Query::Anchor { rel, of, what } => self.anchor(*rel, of, what.as_ref())?,
            Query::Property { property, of } => self.property(property, of)?,
            Query::Size { dimension, of } => self.size(*dimension, of)?,
            Query::Parts(noun) => self.parts(noun)?,
            Query::Leads(noun) => self.leads(noun)?,
            Query::Way { from, to } => self.way(from.as_ref(), to, false)?,
            Query::CanReach { from, to } => self.way(from.as_ref(), to, true)?,
            Query::Distance { from, to } => self.say_distance(from.as_ref(), to)?,
            Query::Closer { what, near, than, closeness } => {
                self.closer(what, near, than, *closeness)?
            }
            Query::WhichMore { of, extreme, to } => self.which_more(of, *extreme, to.as_ref())?,
            Query::Larger { what, than, extreme, to } => {
                self.larger(what, than, *extreme, to.as_ref())?
            }
            Query::Same { property, of } => self.same(property, of)?,
            Query::Free(noun) => self.free(noun)?,
            Query::Place { use_for, what, within } => {
                self.usable(*use_for, what.as_ref(), within)?
            }
            Query::LastSeen(noun) => self.last_seen(noun)?,
            Query::Before(noun) => self.before(noun)?,
            Query::WhereAreYou => self.where_are_you(),
            Query::WhatDoYouSee => self.what_do_you_see(),
            Query::WhatDoYouHold => Draft::new(
                Said::Nothing,
                self.pick("В руках у меня ничего нет", "I am holding nothing").to_owned(),
            ),
            Query::Describe(noun) => self.describe(noun)?,
            Query::Why { negated, about } => self.why(*negated, about.as_deref())?,
        };
        let mut topic = draft.things.clone();
        topic.extend(draft.topic);
        Ok(Answer {
            query: query.clone(),
            language: self.language,
            said: draft.said.unwrap_or(Said::Found),
            text: sentence(&draft.text),
            symbols: draft.things.iter().map(|t| self.symbol(*t)).collect(),
            things: draft.things,
            facts: draft.facts,
            number: draft.number,
            topic,
        })
    }

    fn fact(&self, rel: Rel, x: Thing, y: Thing) -> Option<Fact> {
        let (relation, a, b) = self.tuple(rel, x, y)?;
        Some(Fact::holding(relation, vec![self.symbol(a), self.symbol(b)]))
    }

    /// The fact that would have to hold.
    fn missing(&self, rel: Rel, x: Thing, y: Thing) -> Option<Fact> {
        let basis = super::knowledge::bases(rel).first()?;
        let (a, b) = if basis.swapped { (y, x) } else { (x, y) };
        let args = vec![self.symbol(a), self.symbol(b)];
        Some(Fact { relation: basis.relation.to_owned(), args, holds: false })
    }

    fn facts_of(&self, noun: &Noun, found: &[Thing]) -> Vec<Fact> {
        let mut facts = Vec::new();
        for restriction in &noun.restrictions {
            let Some(anchor) = restriction.anchors.first() else { continue };
            let Ok(anchors) = self.find(anchor, true) else { continue };
            for thing in found.iter().take(50) {
                facts.extend(anchors.iter().find_map(|a| self.fact(restriction.rel, *thing, *a)));
            }
        }
        facts
    }

    // ── where ────────────────────────────────────────────────────────────────────────────────────

    fn say_where(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let found = self.definite(noun)?;
        let mut facts = Vec::new();
        if let [only] = found[..] {
            let text = self.where_one(only, &mut facts);
            return Ok(Draft { facts, ..Draft::new(Said::Found, text).with(found) });
        }
        // Several: by place, those in one place together.
        let mut groups: Vec<(String, Vec<Thing>)> = Vec::new();
        for &thing in &found {
            let place = self.short_place(thing, &mut facts);
            match groups.iter_mut().find(|(p, _)| *p == place) {
                Some((_, things)) => things.push(thing),
                None => groups.push((place, vec![thing])),
            }
        }
        let parts: Vec<String> = groups
            .iter()
            .map(|(place, things)| match self.is_russian() {
                true => format!("{place} – {}", self.list(things)),
                false => format!("{} {} {place}", self.list(things), self.is(things)),
            })
            .collect();
        let text =
            if self.is_russian() { parts.join("; ") } else { enumerate(&parts, self.language) };
        Ok(Draft { facts, ..Draft::new(Said::Found, text).with(found) })
    }

    /// «на Столе-1 в Комнате-В»
    pub(super) fn short_place(&self, thing: Thing, facts: &mut Vec<Fact>) -> String {
        let mut parts: Vec<String> = Vec::new();
        if let Some(id) = thing.replica()
            && let Some(support) = self.relations.support_of(id)
        {
            let support = Thing::Entity(Entity::Replica(support));
            let inside = self.tuple(Rel::In, thing, support).is_some();
            let rel = if inside { Rel::In } else { Rel::On };
            parts.push(self.place(rel, &[support]));
            facts.extend(self.fact(rel, thing, support));
        }
        if let Some(area) = self.area_of(thing) {
            let area = Thing::Entity(Entity::Area(area));
            parts.push(self.place(Rel::In, &[area]));
            facts.extend(self.fact(Rel::In, thing, area));
        }
        if parts.is_empty() {
            return self.pick("неизвестно где", "at an unknown place").to_owned();
        }
        parts.join(" ")
    }

    fn where_one(&self, thing: Thing, facts: &mut Vec<Fact>) -> String {
        let name = self.name(thing);
        match thing {
            Thing::Entity(Entity::Area(id)) => self.where_area(id),
            Thing::Entity(Entity::Door(_)) | Thing::Opening(_) => self.where_gate(thing),
            Thing::Entity(Entity::Map(_)) => {
                let domain = &self.world.domain;
                match self.is_russian() {
                    true => format!("{name} – карта домейна «{}»", domain.name),
                    false => {
                        let title =
                            if domain.name_en.is_empty() { &domain.name } else { &domain.name_en };
                        format!("{name} is a map of \"{title}\"")
                    }
                }
            }
            Thing::Robot => self.senses.position(self.language).unwrap_or_default(),
            _ => {
                let place = self.short_place(thing, facts);
                let near = self.beside(thing, facts);
                format!("{name} {} {place}{near}", self.is(&[thing]))
            }
        }
    }

    /// «, в 12 см перед Письменным столом»: where a thing stands on the floor, told by what is nearest.
    fn beside(&self, thing: Thing, facts: &mut Vec<Fact>) -> String {
        let Some(id) = thing.replica() else { return String::new() };
        let russian = self.is_russian();
        let over = self.related_of(Rel::Under, thing);
        if self.relations.support_of(id).is_some() {
            return String::new();
        }
        if let Some(&above) = over
            .iter()
            .find(|t| self.tuple(Rel::Under, thing, **t).is_some_and(|(r, _, _)| r == "UNDER"))
        {
            facts.extend(self.fact(Rel::Under, thing, above));
            return format!(", {}", self.place(Rel::Under, &[above]));
        }
        let mut near: Vec<(f64, Thing)> = self
            .related(Rel::NextTo, thing)
            .into_iter()
            .filter(|t| t.replica().is_some_and(|r| !self.has_trait(r, "portable")))
            .filter_map(|t| Some((self.distance(thing, t)?, t)))
            .collect();
        near.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let Some(&(distance, anchor)) = near.first() else { return String::new() };
        facts.extend(self.fact(Rel::NextTo, thing, anchor));
        let side = [Rel::LeftOf, Rel::RightOf, Rel::InFrontOf, Rel::Behind]
            .into_iter()
            .find(|rel| self.tuple(*rel, thing, anchor).is_some());
        if let Some(side) = side {
            facts.extend(self.fact(side, thing, anchor));
        }
        let place = self.place(side.unwrap_or(Rel::NextTo), &[anchor]);
        let exact = match (distance >= 1.0, russian) {
            (true, true) => format!("в {} ", length(distance, self.language)),
            (true, false) => format!("{} ", length(distance, self.language)),
            (false, true) if side.is_some() => "вплотную ".to_owned(),
            _ => String::new(),
        };
        let frame = side.filter(|s| matches!(s, Rel::LeftOf | Rel::RightOf));
        let frame = frame.map(|s| self.frame_words(s, anchor)).unwrap_or_default();
        match (side.is_some(), distance >= 1.0, russian) {
            (false, true, true) => {
                let form = self.form(anchor, Case::Genitive);
                let from = russian::preposition(russian::Preposition::Ot, &form);
                format!(", в {} {from} {form}", length(distance, self.language))
            }
            (false, true, false) => {
                format!(", {} from {}", length(distance, self.language), self.name(anchor))
            }
            _ => format!(", {exact}{place}{frame}"),
        }
    }

    /// Things to which a thing lies so: the other end of a relation.
    fn related_of(&self, rel: Rel, thing: Thing) -> Vec<Thing> {
        match rel {
            Rel::In if thing.replica().is_some() => {
                let mut found = self.related(Rel::Has, thing);
                found.sort_unstable();
                found
            }
            Rel::On => self
                .related(Rel::Bears, thing)
                .into_iter()
                .filter(|t| self.tuple(Rel::On, thing, *t).is_some())
                .collect(),
            Rel::Under => {
                let mut found = self.related(Rel::Above, thing);
                found.extend(self.related(Rel::On, thing));
                found.retain(|t| self.tuple(Rel::Under, thing, *t).is_some());
                found
            }
            Rel::Above => {
                let mut found = self.related(Rel::Under, thing);
                found.retain(|t| self.tuple(Rel::Above, thing, *t).is_some());
                found
            }
            Rel::NextTo | Rel::Near | Rel::At => self.related(rel, thing),
            _ => self.others_with(rel, thing),
        }
    }

    /// Anchors of relations that are looked up one way only, among the things of the room.
    fn others_with(&self, rel: Rel, thing: Thing) -> Vec<Thing> {
        let Some(area) = self.area_of(thing) else { return Vec::new() };
        let here = self.related(Rel::In, Thing::Entity(Entity::Area(area)));
        here.into_iter().filter(|t| *t != thing && self.tuple(rel, thing, *t).is_some()).collect()
    }

    fn where_area(&self, id: crate::units::AreaId) -> String {
        let thing = Thing::Entity(Entity::Area(id));
        let name = self.name(thing);
        let map = self.world.placement(id).map(|(map, _)| Thing::Entity(Entity::Map(map)));
        let several = self.world.maps.len() > 1;
        let gates: Vec<_> = self.gates().iter().filter(|g| g.areas.contains(&id)).collect();
        let next: Vec<String> = gates
            .iter()
            .filter_map(|g| {
                let other = g.areas.iter().find(|a| **a != id)?;
                let other = self.place(Rel::To, &[Thing::Entity(Entity::Area(*other))]);
                Some(format!("{other} ({})", self.name(g.thing)))
            })
            .collect();
        let mut text = match (map, self.is_russian()) {
            (Some(map), true) => {
                let floor = self.form(map, Case::Genitive);
                let _ = several;
                format!("{name} – помещение {floor}")
            }
            (Some(map), false) => format!("{name} is a room of {}", self.name(map)),
            (None, true) => format!("{name} – помещение"),
            (None, false) => format!("{name} is a room"),
        };
        if !next.is_empty() {
            let list = enumerate(&next, self.language);
            text = match self.is_russian() {
                true => format!("{text}; оттуда можно попасть {list}"),
                false => format!("{text}; from there one gets {list}"),
            };
        }
        text
    }

    fn where_gate(&self, thing: Thing) -> String {
        let name = self.name(thing);
        let Some(gate) = self.gate(thing) else {
            return self.where_object_door(thing);
        };
        let areas: Vec<Thing> =
            gate.areas.iter().map(|a| Thing::Entity(Entity::Area(*a))).collect();
        match (&areas[..], self.is_russian()) {
            ([_, _, ..], true) => {
                format!("{name} {} {}", self.find_is(thing), self.place(Rel::Between, &areas))
            }
            ([_, _, ..], false) => format!("{name} is {}", self.place(Rel::Between, &areas)),
            ([only], true) => {
                format!(
                    "{name} {} {} и ведёт за пределы карты",
                    self.find_is(thing),
                    self.place(Rel::In, &[*only])
                )
            }
            ([only], false) => {
                format!("{name} is {} and leads out of the map", self.place(Rel::In, &[*only]))
            }
            ([], true) => format!("{name}: помещение неизвестно"),
            ([], false) => format!("{name}: its room is unknown"),
        }
    }

    fn find_is(&self, thing: Thing) -> &'static str {
        self.is(&[thing])
    }

    /// A door of a wardrobe is where its wardrobes are.
    fn where_object_door(&self, thing: Thing) -> String {
        let Thing::Entity(Entity::Door(door)) = thing else { return self.name(thing) };
        let has = |r: &&crate::map::Replica| {
            let object = self.world.objects.get(&r.object);
            object.is_some_and(|o| o.doors.iter().any(|m| m.door == door))
        };
        let owners: Vec<Thing> = self
            .world
            .replicas
            .values()
            .filter(has)
            .map(|r| Thing::Entity(Entity::Replica(r.id)))
            .collect();
        let name = self.name(thing);
        match (owners.is_empty(), self.is_russian()) {
            (true, true) => format!("{name}: место неизвестно"),
            (true, false) => format!("{name}: its place is unknown"),
            (false, true) => {
                let own = self.names(&owners, Case::Genitive);
                format!("{name} – часть {own}")
            }
            (false, false) => format!("{name} is part of {}", self.list(&owners)),
        }
    }

    fn room_of(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let found = self.definite(noun)?;
        let mut rooms: Vec<Thing> = Vec::new();
        let mut parts: Vec<String> = Vec::new();
        let mut facts = Vec::new();
        let several = self.world.maps.len() > 1;
        for &thing in &found {
            let areas: Vec<Thing> = match self.gate(thing) {
                Some(gate) => gate.areas.iter().map(|a| Thing::Entity(Entity::Area(*a))).collect(),
                None => match thing {
                    Thing::Entity(Entity::Area(id)) => {
                        let map =
                            self.world.placement(id).map(|(m, _)| Thing::Entity(Entity::Map(m)));
                        map.into_iter().collect()
                    }
                    _ => self
                        .area_of(thing)
                        .map(|a| Thing::Entity(Entity::Area(a)))
                        .into_iter()
                        .collect(),
                },
            };
            let name = self.name(thing);
            let Some(&first) = areas.first() else {
                parts.push(match self.is_russian() {
                    true => format!("{name}: помещение неизвестно"),
                    false => format!("the room of {name} is unknown"),
                });
                continue;
            };
            facts.extend(self.fact(Rel::In, thing, first));
            let place = if areas.len() > 1 {
                self.place(Rel::Between, &areas)
            } else {
                self.place(Rel::In, &areas)
            };
            let mut part = format!("{name} {} {place}", self.is(&[thing]));
            if several && let Some((map, _)) = first.area().and_then(|a| self.world.placement(a)) {
                let map = Thing::Entity(Entity::Map(map));
                part = match self.is_russian() {
                    true => format!("{part} ({})", self.name(map)),
                    false => format!("{part} ({})", self.name(map)),
                };
            }
            parts.push(part);
            for area in areas {
                if !rooms.contains(&area) {
                    rooms.push(area);
                }
            }
        }
        let text = parts.join("; ");
        let said = if rooms.is_empty() { Said::Unknown } else { Said::Found };
        Ok(Draft { facts, ..Draft::new(said, text).with(rooms) }.about(&found))
    }

    // ── lists and numbers ────────────────────────────────────────────────────────────────────────

    fn say_found(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let found = self.find(noun, false)?;
        let facts = self.facts_of(noun, &found);
        if noun.best.is_some() {
            return Ok(Draft { facts, ..self.say_best(noun, found) });
        }
        if let Some(text) = self.neighbours(noun, &found) {
            return Ok(Draft { facts, ..Draft::new(Said::Found, text).with(found) });
        }
        let place = self.restrictions(noun);
        let anchors = self.anchor_things(noun);
        let frame = self.frame_of(noun);
        let text = if found.is_empty() {
            self.nothing_found(noun, &place)
        } else {
            let list = self.with_details(noun, &found);
            let general = noun.head.anything || noun.head.kinds.is_empty();
            match (self.is_russian(), place.is_empty()) {
                (true, true) => {
                    let counted = self.counted(noun, found.len());
                    if general { list } else { format!("{counted}: {list}") }
                }
                (true, false) if self.is_having(noun) => {
                    format!("{}: {list}", self.capital_count(noun, found.len()))
                }
                (true, false) if self.is_leading(noun) => {
                    let leads = if found.len() > 1 { "ведут" } else { "ведёт" };
                    let list = if self.leads_both(noun) { self.list(&found) } else { list };
                    format!("{place} {leads} {list}")
                }
                (false, false) if self.is_leading(noun) => {
                    let leads = if found.len() > 1 { "lead" } else { "leads" };
                    match self.leads_both(noun) {
                        true => format!(
                            "{} {leads} {}",
                            self.list(&found),
                            place.replace("out of", "from")
                        ),
                        false => format!("{list} {leads} {place}"),
                    }
                }
                (true, false) => format!("{place}{frame} {} {list}", self.is(&found)),
                (false, true) => {
                    if general {
                        list
                    } else {
                        format!("{}: {list}", self.counted(noun, found.len()))
                    }
                }
                (false, false) if self.is_having(noun) => {
                    format!("{}: {list}", self.counted(noun, found.len()))
                }
                (false, false) => format!("{list} {} {place}{frame}", self.is(&found)),
            }
        };
        let said = if found.is_empty() { Said::Nothing } else { Said::Found };
        let text = format!("{text}{}", self.also(noun, &found));
        Ok(Draft { facts, ..Draft::new(said, text).with(found) }.about(&anchors))
    }

    /// «Из Коридора можно попасть в Комнату-В и в Комнату-Y.»
    fn neighbours(&self, noun: &Noun, found: &[Thing]) -> Option<String> {
        let near = noun.restrictions.iter().find(|r| r.rel == Rel::Near)?;
        let from = self.find(near.anchors.first()?, true).ok()?;
        let rooms = !found.is_empty() && found.iter().chain(&from).all(|t| t.area().is_some());
        let list: Vec<String> = found.iter().map(|t| self.place(Rel::To, &[*t])).collect();
        let list = enumerate(&list, self.language);
        rooms.then(|| match self.is_russian() {
            true => format!("{} можно попасть {list}", self.place(Rel::From, &from)),
            false => format!("from {} one can get {list}", self.list(&from)),
        })
    }

    fn is_leading(&self, noun: &Noun) -> bool {
        noun.restrictions.iter().any(|r| matches!(r.rel, Rel::From | Rel::To))
    }

    /// From one room to another.
    fn leads_both(&self, noun: &Noun) -> bool {
        let has = |rel| noun.restrictions.iter().any(|r| r.rel == rel);
        has(Rel::From) && has(Rel::To)
    }

    fn is_having(&self, noun: &Noun) -> bool {
        noun.restrictions.iter().any(|r| {
            matches!(r.rel, Rel::Has | Rel::Bears)
                || (r.rel == Rel::Near
                    && noun.head.kinds.iter().any(|k| self.lexicon().is_area(*k)))
        })
    }

    /// «2 помещения, где есть стулья»
    fn capital_count(&self, noun: &Noun, number: usize) -> String {
        let counted = self.counted(noun, number);
        let place = self.restrictions(noun);
        format!("{counted} {place}")
    }

    /// Passages beside doors, and what lies inside beside what stands on top.
    fn also(&self, noun: &Noun, found: &[Thing]) -> String {
        let doors =
            noun.head.kinds.iter().any(|k| self.lexicon().kind(*k).extension == Extension::Doors);
        let of_area =
            noun.restrictions.iter().find(|r| matches!(r.rel, Rel::From | Rel::To | Rel::Of));
        let Some(restriction) =
            of_area.filter(|_| doors && noun.filters.is_empty() && !self.leads_both(noun))
        else {
            return String::new();
        };
        let Some(anchor) = restriction.anchors.first() else { return String::new() };
        let Ok(areas) = self.find(anchor, true) else { return String::new() };
        let passages: Vec<Thing> = self
            .gates()
            .iter()
            .filter(|g| g.is_passage && !found.contains(&g.thing))
            .filter(|g| areas.iter().filter_map(|a| a.area()).any(|a| g.areas.contains(&a)))
            .map(|g| g.thing)
            .collect();
        match (passages.is_empty(), self.is_russian()) {
            (true, _) => String::new(),
            (false, true) => format!("; кроме того, есть {}", self.list(&passages)),
            (false, false) => format!("; besides, there is {}", self.list(&passages)),
        }
    }

    /// Names; of doors with where they lead, of left and right with how far they are.
    fn with_details(&self, noun: &Noun, found: &[Thing]) -> String {
        let measured = noun.restrictions.iter().find(|r| {
            matches!(
                r.rel,
                Rel::LeftOf | Rel::RightOf | Rel::Behind | Rel::InFrontOf | Rel::NextTo | Rel::Near
            )
        });
        let anchor =
            measured.and_then(|r| self.find(r.anchors.first()?, true).ok()?.first().copied());
        let from = noun.restrictions.iter().find(|r| matches!(r.rel, Rel::From | Rel::Of));
        let from = from.and_then(|r| self.find(r.anchors.first()?, true).ok()?.first().copied());
        let mut found = found.to_vec();
        if let Some(anchor) = anchor {
            found.sort_by(|a, b| {
                let away = |t: &Thing| self.distance(*t, anchor).unwrap_or(f64::INFINITY);
                away(a).total_cmp(&away(b)).then(a.cmp(b))
            });
        }
        let detail = |thing: &Thing| -> String {
            let name = self.name(*thing);
            if let (Some(gate), Some(Thing::Entity(Entity::Area(here)))) = (self.gate(*thing), from)
            {
                let others: Vec<Thing> = gate
                    .areas
                    .iter()
                    .filter(|a| **a != here)
                    .map(|a| Thing::Entity(Entity::Area(*a)))
                    .collect();
                return match (others.is_empty(), self.is_russian()) {
                    (false, _) => format!("{name} ({})", self.place(Rel::To, &others)),
                    (true, true) => format!("{name} (наружу)"),
                    (true, false) => format!("{name} (outside)"),
                };
            }
            let away = anchor.and_then(|a| self.distance(*thing, a)).filter(|d| *d >= 1.0);
            match away {
                Some(d) if thing.replica().is_some() => {
                    format!("{name} ({})", length(d, self.language))
                }
                _ => name,
            }
        };
        if (anchor.is_none() && from.is_none()) || found.len() > 12 {
            return self.list(&found);
        }
        let parts: Vec<String> = found.iter().map(detail).collect();
        enumerate(&parts, self.language)
    }

    /// The things that places of a description name.
    fn anchor_things(&self, noun: &Noun) -> Vec<Thing> {
        let anchors = noun.restrictions.iter().flat_map(|r| &r.anchors);
        anchors.filter_map(|a| self.find(a, true).ok()).filter(|f| f.len() == 1).flatten().collect()
    }

    fn frame_of(&self, noun: &Noun) -> String {
        let side = noun.restrictions.iter().find_map(|r| {
            let anchor = self.find(r.anchors.first()?, true).ok()?;
            let words = self.frame_words(r.rel, *anchor.first()?);
            (!words.is_empty()).then_some(words)
        });
        side.unwrap_or_default()
    }

    fn nothing_found(&self, noun: &Noun, place: &str) -> String {
        let frame = self.frame_of(noun);
        let general = noun.head.anything;
        match (self.is_russian(), general) {
            (true, true) => format!("{place}{frame} ничего нет"),
            (false, true) => format!("there is nothing {place}{frame}"),
            (true, false) if place.is_empty() => format!("на карте нет {}", self.none_of(noun)),
            (true, false) if self.is_having(noun) => format!("{} {place} нет", self.none_of(noun)),
            (true, false) => format!("{place}{frame} нет {}", self.none_of(noun)),
            (false, false) if place.is_empty() => {
                format!("there are no {} on the map", self.none_of(noun))
            }
            (false, false) => format!("there are no {} {place}{frame}", self.none_of(noun)),
        }
    }

    fn say_best(&self, noun: &Noun, found: Vec<Thing>) -> Draft {
        let Some(best) = &noun.best else { return Draft::default() };
        let Some(&first) = found.first() else {
            let text = self.nothing_found(noun, &self.restrictions(noun));
            return Draft::new(Said::Nothing, text);
        };
        let anchor = best.anchor.as_ref().and_then(|a| self.find(a, true).ok());
        let anchor = anchor.and_then(|a| a.first().copied()).unwrap_or(Thing::Robot);
        let list = self.list(&found);
        let how = match best.extreme {
            Extreme::Nearest | Extreme::Farthest => {
                let away = self.distance(first, anchor).map(|d| length(d, self.language));
                let away = away.unwrap_or_default();
                let form = self.form(anchor, Case::Genitive);
                match self.is_russian() {
                    true => format!(
                        "{away} {} {form}",
                        russian::preposition(russian::Preposition::Ot, &form)
                    ),
                    false => format!("{away} from {form}"),
                }
            }
            extreme => self.measure_words(extreme, first),
        };
        let place = self.in_room(first).filter(|_| first.area().is_none());
        let place = place.map(|p| format!(" {p}")).unwrap_or_default();
        let text = match (found.len(), self.is_russian()) {
            (1, true) => {
                let how = if how.is_empty() { String::new() } else { format!(" ({how})") };
                format!("это {list}{place}{how}")
            }
            (1, false) => {
                let how = if how.is_empty() { String::new() } else { format!(" ({how})") };
                format!("it is {list}{place}{how}")
            }
            (_, true) => format!("это {list}"),
            (_, false) => format!("these are {list}"),
        };
        Draft::new(Said::Found, text).with(found)
    }

    fn measure_words(&self, extreme: Extreme, thing: Thing) -> String {
        let Some(measure) = self.measure(extreme, thing) else { return String::new() };
        let is_area = thing.area().is_some();
        match extreme {
            Extreme::Biggest | Extreme::Smallest if is_area => area(measure, self.language),
            Extreme::Biggest | Extreme::Smallest if thing.replica().is_some() => {
                self.sizes(thing).unwrap_or_default()
            }
            Extreme::Tallest | Extreme::Lowest => match self.is_russian() {
                true => format!("высота {}", length(measure, self.language)),
                false => format!("{} high", length(measure, self.language)),
            },
            Extreme::LeftMost | Extreme::RightMost | Extreme::Most => String::new(),
            _ => match self.is_russian() {
                true => format!("ширина {}", length(measure, self.language)),
                false => format!("{} wide", length(measure, self.language)),
            },
        }
    }

    /// «90×30×190 см»
    fn sizes(&self, thing: Thing) -> Option<String> {
        let extent = match thing {
            Thing::Entity(Entity::Replica(id)) => self.relations.extent(id)?,
            Thing::Entity(Entity::Area(id)) => self.relations.area_extent(id)?,
            _ => return None,
        };
        let unit = self.pick("см", "cm");
        Some(format!("{:.0}×{:.0}×{:.0} {unit}", extent.width, extent.depth, extent.height))
    }

    fn count(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let found = self.find(noun, false)?;
        let facts = self.facts_of(noun, &found);
        let place = self.restrictions(noun);
        let anchors = self.anchor_things(noun);
        let number = found.len();
        let text = if number == 0 {
            self.nothing_found(noun, &place)
        } else {
            let counted = match noun.head.anything {
                true => {
                    let (phrase, english) = self.kind_phrase(noun);
                    match self.language {
                        Language::Russian => russian::count(number as u64, &phrase),
                        Language::English => {
                            crate::language::words::english::count(number as u64, &english)
                        }
                    }
                }
                false => self.counted(noun, number),
            };
            let list =
                if number <= 12 { format!(": {}", self.list(&found)) } else { String::new() };
            match (self.is_russian(), place.is_empty()) {
                (true, true) => format!("на карте {counted}{list}"),
                (true, false) if self.is_having(noun) => format!("{counted} {place}{list}"),
                (true, false) => format!("{place} {counted}{list}"),
                (false, true) => {
                    format!("there {} {counted}{list}", if number == 1 { "is" } else { "are" })
                }
                (false, false) => {
                    format!(
                        "there {} {counted} {place}{list}",
                        if number == 1 { "is" } else { "are" }
                    )
                }
            }
        };
        let said = if number == 0 { Said::Nothing } else { Said::Found };
        Ok(Draft { facts, ..Draft::new(said, text).with(found) }
            .about(&anchors)
            .number(number as f64))
    }

    fn exists(&self, what: &[Noun], either: bool, negated: bool) -> Result<Draft, Doubt> {
        let mut found: Vec<Vec<Thing>> = Vec::new();
        for noun in what {
            found.push(self.find(noun, true)?);
        }
        let have = |n: usize| !found[n].is_empty();
        let any = (0..what.len()).any(have);
        let all = (0..what.len()).all(have);
        let holds = if either { any } else { all };
        let mut parts: Vec<String> = Vec::new();
        for (noun, things) in what.iter().zip(&found) {
            parts.push(self.existing(noun, things));
        }
        let join = self.pick(", но ", ", but ");
        let join = if all || !any { self.pick(", и ", " and ") } else { join };
        let text = parts.join(join);
        // «В комнате нет стула?» is answered by «Да, нет» only in words that cannot mislead.
        let yes = holds != negated;
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let facts = what.iter().zip(&found).flat_map(|(n, f)| self.facts_of(n, f)).collect();
        let things: Vec<Thing> = found.concat();
        let anchors = self.anchor_things(&what[0]);
        let said = if holds { Said::Yes } else { Said::No };
        Ok(Draft { facts, ..Draft::new(said, format!("{head}{text}")).with(things) }
            .about(&anchors))
    }

    /// «в Комнате-В есть 2 стула: Стул-1 и Стул-2», «в Комнате-В нет стульев»
    fn existing(&self, noun: &Noun, things: &[Thing]) -> String {
        let place = self.restrictions(noun);
        let blank = if place.is_empty() { String::new() } else { format!("{place} ") };
        if things.is_empty() {
            let none = self.none_of(noun);
            return match (self.is_russian(), noun.head.anything) {
                (true, true) => format!("{blank}ничего нет"),
                (false, true) => format!("there is nothing {place}"),
                (true, false) if place.is_empty() => format!("на карте нет {none}"),
                (true, false) => format!("{blank}нет {none}"),
                (false, false) if place.is_empty() => format!("there are no {none} on the map"),
                (false, false) => format!("there are no {none} {place}"),
            };
        }
        let list = self.list(things);
        let general = noun.head.anything || noun.head.kinds.is_empty();
        let unplaced = place.is_empty() && things.len() == 1;
        let room = things.first().filter(|_| unplaced).and_then(|t| self.in_room(*t));
        let room = room
            .filter(|_| things[0].area().is_none())
            .map(|r| format!(" {r}"))
            .unwrap_or_default();
        match (self.is_russian(), general || things.len() == 1) {
            (true, true) => format!("{blank}есть {list}{room}"),
            (true, false) => format!("{blank}есть {}: {list}", self.counted(noun, things.len())),
            (false, true) => {
                let verb = if things.len() == 1 { "is" } else { "are" };
                format!("there {verb} {list}{room} {place}")
            }
            (false, false) => {
                format!("there are {} {place}: {list}", self.counted(noun, things.len()))
            }
        }
        .trim_end()
        .replace(" :", ":")
    }

    // ── is it so ─────────────────────────────────────────────────────────────────────────────────

    /// Whether a claim holds of a thing, with the fact that says so or would have to.
    fn judge(&self, thing: Thing, claim: &Claim) -> Result<(bool, Vec<Fact>, Vec<Thing>), Doubt> {
        match claim {
            Claim::Related(restriction) => self.judge_related(thing, restriction),
            Claim::Value(filter) => {
                let holds = self.has_value(thing, filter.value) != filter.negated;
                let entry = self.lexicon().values.entry(filter.value);
                let own = self.values(thing).into_iter().find(|(p, _, _)| *p == entry.property);
                let fact = match (self.statuses(thing).first(), thing) {
                    (Some((status, _)), Thing::Entity(Entity::Door(_)))
                        if entry.property == Property::State =>
                    {
                        Some(Fact::holding(
                            "DOOR_IS",
                            vec![self.symbol(thing), status_word(*status).to_owned()],
                        ))
                    }
                    _ => own.map(|(_, _, text)| {
                        let property = self.property_name(thing, &entry.property);
                        Fact::holding("HAS", vec![self.symbol(thing), property, text])
                    }),
                };
                Ok((holds, fact.into_iter().collect(), Vec::new()))
            }
            Claim::Kind(noun) => {
                let of_kind = self.find(noun, true)?;
                Ok((of_kind.contains(&thing), Vec::new(), Vec::new()))
            }
        }
    }

    /// The map's own name of a property.
    fn property_name(&self, thing: Thing, property: &Property) -> String {
        let find = |properties: &crate::map::Properties| {
            properties.keys().find(|name| Property::of(name) == *property).cloned()
        };
        let found = match thing {
            Thing::Entity(Entity::Replica(id)) => self.world.replicas.get(&id).and_then(|r| {
                find(&r.properties)
                    .or_else(|| self.world.objects.get(&r.object).and_then(|o| find(&o.properties)))
            }),
            Thing::Entity(Entity::Door(id)) => {
                self.world.doors.get(&id).and_then(|d| find(&d.properties))
            }
            Thing::Entity(Entity::Area(id)) => {
                self.world.areas.get(&id).and_then(|a| find(&a.properties))
            }
            _ => None,
        };
        found.unwrap_or_else(|| property.noun(Language::Russian).to_uppercase())
    }

    fn judge_related(
        &self,
        thing: Thing,
        restriction: &Restriction,
    ) -> Result<(bool, Vec<Fact>, Vec<Thing>), Doubt> {
        if restriction.rel == Rel::Between || restriction.anchors.iter().any(|a| self.is_floor(a)) {
            let mut noun = Noun::default();
            noun.head.things = Some(vec![thing]);
            noun.restrictions.push(restriction.clone());
            let holds = !self.find(&noun, false)?.is_empty();
            let mut anchors = Vec::new();
            for anchor in restriction.anchors.iter().filter(|a| !self.is_floor(a)) {
                anchors.extend(self.definite(anchor)?);
            }
            return Ok((holds, Vec::new(), anchors));
        }
        let Some(noun) = restriction.anchors.first() else {
            return Ok((false, Vec::new(), Vec::new()));
        };
        let mut anchors = Vec::new();
        for noun in &restriction.anchors {
            anchors.extend(self.find(noun, true)?);
        }
        if anchors.is_empty() {
            return Err(self.none_such(noun));
        }
        if restriction.rel == Rel::To || restriction.rel == Rel::Of {
            let joins = |a: &Thing| {
                let area = a.area();
                self.gate(thing).is_some_and(|g| area.is_some_and(|id| g.areas.contains(&id)))
                    || self.related(restriction.rel, *a).contains(&thing)
            };
            let holds = anchors.iter().copied().find(joins);
            return Ok((holds.is_some(), Vec::new(), holds.map_or(anchors, |a| vec![a])));
        }
        if let Some(&hit) = anchors.iter().find(|a| self.holds(restriction.rel, thing, **a)) {
            let fact = self.fact(restriction.rel, thing, hit);
            return Ok((true, fact.into_iter().collect(), vec![hit]));
        }
        let fact = anchors.first().and_then(|a| self.missing(restriction.rel, thing, *a));
        Ok((false, fact.into_iter().collect(), anchors))
    }

    fn say_holds(&self, subject: &Noun, claims: &[Claim], negated: bool) -> Result<Draft, Doubt> {
        let found = self.subject(subject)?;
        if let (&[thing], [Claim::Value(filter)]) = (&found[..], claims)
            && self.own_value(thing, filter.value).is_none()
        {
            let property = self.lexicon().values.entry(filter.value).property.clone();
            let text = self.no_property(&property, thing);
            return Ok(Draft::new(Said::Unknown, text).with(found));
        }
        let mut facts = Vec::new();
        let mut topic = Vec::new();
        let mut failed: Vec<Thing> = Vec::new();
        let mut spoken: Option<(usize, Vec<Thing>)> = None;
        for &thing in &found {
            for (n, claim) in claims.iter().enumerate() {
                let (holds, why, anchors) = self.judge(thing, claim)?;
                facts.extend(why);
                if spoken.is_none() || !holds {
                    spoken = Some((n, anchors.clone()));
                }
                topic.extend(anchors);
                if !holds && !failed.contains(&thing) {
                    failed.push(thing);
                }
            }
        }
        let all = failed.is_empty();
        let yes = all != negated;
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let text = if found.len() > 1 {
            self.several_hold(&found, &failed, claims)
        } else {
            let thing = found[0];
            let parts: Vec<String> =
                claims.iter().map(|c| self.claim_words(thing, c)).collect::<Result<_, _>>()?;
            format!("{} {}", self.name(thing), enumerate(&parts, self.language))
        };
        let said = if all { Said::Yes } else { Said::No };
        topic.truncate(4);
        facts.sort_by_key(|f| f.holds == all);
        facts.reverse();
        Ok(Draft { facts, ..Draft::new(said, format!("{head}{text}")).with(found) }.about(&topic))
    }

    /// The subject of a claim: one thing, or all of several.
    fn subject(&self, noun: &Noun) -> Result<Vec<Thing>, Doubt> {
        match self.definite(noun) {
            Ok(found) => Ok(found),
            Err(doubt) => Err(doubt),
        }
    }

    fn several_hold(&self, found: &[Thing], failed: &[Thing], claims: &[Claim]) -> String {
        let fit: Vec<Thing> = found.iter().copied().filter(|t| !failed.contains(t)).collect();
        let words = |things: &[Thing]| -> String {
            let parts: Vec<String> = claims
                .iter()
                .map(|c| match c {
                    Claim::Value(filter) => {
                        let entry = self.lexicon().values.entry(filter.value);
                        match self.is_russian() {
                            true => self.lexicon().values.predicate(
                                filter.value,
                                crate::language::Gender::Masculine,
                                if things.len() > 1 { Number::Plural } else { Number::Singular },
                            ),
                            false => format!("{} {}", self.is(things), entry.english),
                        }
                    }
                    Claim::Related(r) => {
                        let mut noun = Noun::default();
                        noun.restrictions.push(r.clone());
                        format!("{} {}", self.is(things), self.restrictions(&noun))
                    }
                    Claim::Kind(noun) => self.none_of(noun),
                })
                .collect();
            enumerate(&parts, self.language)
        };
        match (fit.is_empty(), failed.is_empty(), self.is_russian()) {
            (_, true, true) => format!("все {}: {}", words(found), self.list(found)),
            (_, true, false) => format!("all of them: {}", self.list(found)),
            (true, _, true) => format!("ни одно из них: {}", self.list(found)),
            (true, _, false) => format!("none of them: {}", self.list(found)),
            (false, false, true) => {
                format!(
                    "не все: {} {}, а {} – нет",
                    words(&fit),
                    self.list(&fit),
                    self.list(failed)
                )
            }
            (false, false, false) => {
                format!(
                    "not all: {} {}, but not {}",
                    self.list(&fit),
                    words(&fit),
                    self.list(failed)
                )
            }
        }
    }

    /// «находится на Столе-1», «не находится на Столе-1: он находится в Комнате-В», «открыта»
    fn claim_words(&self, thing: Thing, claim: &Claim) -> Result<String, Doubt> {
        let (holds, _, anchors) = self.judge(thing, claim)?;
        Ok(match claim {
            Claim::Related(restriction) => {
                let place = match anchors.len() {
                    0 | 1 => self.place(restriction.rel, &anchors),
                    _ if holds || restriction.rel == Rel::Between => {
                        self.place(restriction.rel, &anchors)
                    }
                    _ => {
                        let mut noun = Noun::default();
                        noun.restrictions.push(restriction.clone());
                        self.restrictions(&noun)
                    }
                };
                let place = match restriction.anchors.first() {
                    Some(anchor) if self.is_floor(anchor) => {
                        self.pick("на полу", "on the floor").to_owned()
                    }
                    _ => place,
                };
                let verb = match (restriction.rel, self.is_russian()) {
                    (Rel::To, true) => "ведёт",
                    (Rel::To, false) => "leads",
                    _ => self.is(&[thing]),
                };
                let frame = anchors
                    .first()
                    .map(|a| self.frame_words(restriction.rel, *a))
                    .unwrap_or_default();
                match (holds, self.is_russian()) {
                    (true, _) => format!("{verb} {place}{frame}"),
                    (false, true) => match self.instead(thing, restriction.rel) {
                        instead if instead.is_empty() => format!("не {verb} {place}{frame}"),
                        instead => format!("{verb} не {place}{instead}"),
                    },
                    (false, false) if restriction.rel == Rel::To => {
                        format!("does not lead {place}")
                    }
                    (false, false) => {
                        format!("{verb} not {place}{frame}{}", self.instead(thing, restriction.rel))
                    }
                }
            }
            Claim::Value(filter) => {
                let own = self.own_value(thing, filter.value);
                let asked = self.value(filter.value, thing);
                match (holds, own, self.is_russian()) {
                    (true, own, true) => own.unwrap_or(asked),
                    (true, own, false) => format!("{} {}", self.is(&[thing]), own.unwrap_or(asked)),
                    (false, Some(own), true) => own,
                    (false, Some(own), false) => format!("{} {own}", self.is(&[thing])),
                    (false, None, true) => format!("не {asked}: на карте такого свойства нет"),
                    (false, None, false) => {
                        format!("{} not {asked}, as far as the map says", self.is(&[thing]))
                    }
                }
            }
            Claim::Kind(noun) => {
                let (phrase, english) = self.kind_phrase(noun);
                let name = super::lexicon::lower_first(&phrase.case(Case::Nominative));
                match (holds, self.is_russian()) {
                    (true, true) => format!("– это {name}"),
                    (false, true) => format!("– не {name}"),
                    (true, false) => format!("is {}", crate::language::english::a(&english)),
                    (false, false) => format!("is not {}", crate::language::english::a(&english)),
                }
            }
        })
    }

    /// The value that a thing has of the property asked about.
    fn own_value(&self, thing: Thing, asked: super::values::ValueId) -> Option<String> {
        let values = &self.lexicon().values;
        let property = &values.entry(asked).property;
        let all = self.values(thing);
        let same = all.iter().find(|(_, v, _)| v.is_some_and(|v| values.is(v, asked)));
        let same = same.or_else(|| all.iter().find(|(p, _, _)| p == property));
        same.map(|(_, value, text)| match value {
            Some(value) => self.value(*value, thing),
            None => text.to_lowercase(),
        })
    }

    /// «: она на Столе-1 в Комнате-В»
    fn instead(&self, thing: Thing, rel: Rel) -> String {
        if !matches!(rel, Rel::On | Rel::In | Rel::Under) || thing.replica().is_none() {
            return String::new();
        }
        let place = self.short_place(thing, &mut Vec::new());
        match self.is_russian() {
            true => format!(", а {place}"),
            false => format!(" but {place}"),
        }
    }

    fn choose(&self, subject: &Noun, claims: &[Claim]) -> Result<Draft, Doubt> {
        let found = self.subject(subject)?;
        let mut facts = Vec::new();
        let mut parts = Vec::new();
        let mut any = false;
        for &thing in &found {
            let mut fits = Vec::new();
            for claim in claims {
                let (holds, why, _) = self.judge(thing, claim)?;
                if holds {
                    facts.extend(why);
                    fits.push(self.claim_words(thing, claim)?);
                }
            }
            any |= !fits.is_empty();
            parts.push(match (fits.is_empty(), self.is_russian()) {
                (false, _) => format!("{} {}", self.name(thing), enumerate(&fits, self.language)),
                (true, true) => {
                    let own = self.claim_words(thing, &claims[0])?;
                    format!("{} – ни то, ни другое: {own}", self.name(thing))
                }
                (true, false) => {
                    let own = self.claim_words(thing, &claims[0])?;
                    format!("neither: {} {own}", self.name(thing))
                }
            });
        }
        let said = if any { Said::Found } else { Said::Nothing };
        let text = parts.join(self.pick("; ", "; "));
        Ok(Draft { facts, ..Draft::new(said, text).with(found) })
    }

    /// What a thing stands on, lies in, is beside: the other end of a relation.
    fn anchor(&self, rel: Rel, of: &Noun, what: Option<&Noun>) -> Result<Draft, Doubt> {
        let thing = self.one(of)?;
        let mut found = match rel {
            Rel::On => {
                let id = thing.replica();
                let support = id.and_then(|id| self.relations.support_of(id));
                support.map(|s| Thing::Entity(Entity::Replica(s))).into_iter().collect()
            }
            Rel::In => self.holder(thing),
            Rel::From | Rel::Of | Rel::To => self.related(Rel::Near, thing),
            rel => self.related_of(rel, thing),
        };
        let floor = rel == Rel::On && found.is_empty();
        if let Some(what) = what.filter(|w| !w.head.kinds.is_empty() && !self.is_floor(w)) {
            let kinds =
                self.find(&Noun { plural: true, indefinite: true, ..what.clone() }, true)?;
            found.retain(|t| kinds.contains(t));
        }
        let facts: Vec<Fact> = found.iter().filter_map(|y| self.fact(rel, thing, *y)).collect();
        let name = self.name(thing);
        let verb = self.is(&[thing]);
        if found.is_empty() {
            let text = match (floor, self.is_russian()) {
                (true, true) => {
                    let room = self.in_room(thing).map(|r| format!(" {r}")).unwrap_or_default();
                    format!("{name} {verb} на полу{room}")
                }
                (true, false) => {
                    let room = self.in_room(thing).map(|r| format!(" {r}")).unwrap_or_default();
                    format!("{name} {verb} on the floor{room}")
                }
                (false, true) => {
                    format!("такого на карте нет: {}", self.where_one(thing, &mut Vec::new()))
                }
                (false, false) => {
                    format!("there is no such thing: {}", self.where_one(thing, &mut Vec::new()))
                }
            };
            let said = if floor { Said::Found } else { Said::Nothing };
            return Ok(Draft::new(said, text).about(&[thing]));
        }
        // In a container is not on it, though people ask so.
        let shown = match rel {
            Rel::On if self.tuple(Rel::In, thing, found[0]).is_some() => Rel::In,
            rel => rel,
        };
        let frame = self.frame_words(rel, found[0]);
        let text = format!("{name} {verb} {}{frame}", self.place(shown, &found));
        Ok(Draft { facts, ..Draft::new(Said::Found, text).with(found) }.about(&[thing]))
    }

    /// The nearest thing that holds another, else its room.
    fn holder(&self, thing: Thing) -> Vec<Thing> {
        let all = self.related(Rel::Has, thing);
        let things: Vec<Thing> = all.iter().copied().filter(|t| t.replica().is_some()).collect();
        if things.is_empty() { all } else { things }
    }

    // ── properties and sizes ─────────────────────────────────────────────────────────────────────

    fn property(&self, property: &Property, of: &Noun) -> Result<Draft, Doubt> {
        let found = self.definite(of)?;
        let mut parts: Vec<String> = Vec::new();
        let mut facts = Vec::new();
        let mut known = false;
        for &thing in &found {
            let name = self.name(thing);
            let own: Vec<_> =
                self.values(thing).into_iter().filter(|(p, _, _)| p == property).collect();
            if own.is_empty() {
                parts.push(self.no_property(property, thing));
                continue;
            }
            known = true;
            let words: Vec<String> = own
                .iter()
                .map(|(_, value, text)| match value {
                    Some(value) => self.value_of(property, *value, thing),
                    None => text.to_lowercase(),
                })
                .collect();
            for (_, _, text) in &own {
                facts.push(match (thing, self.statuses(thing).first(), property) {
                    (Thing::Entity(Entity::Door(_)), Some((status, _)), Property::State) => {
                        Fact::holding(
                            "DOOR_IS",
                            vec![self.symbol(thing), status_word(*status).to_owned()],
                        )
                    }
                    _ => {
                        let name = self.property_name(thing, property);
                        Fact::holding("HAS", vec![self.symbol(thing), name, text.clone()])
                    }
                });
            }
            let words = enumerate(&words, self.language);
            parts.push(match (self.is_russian(), property) {
                (
                    true,
                    Property::Colour | Property::State | Property::Surface | Property::Orientation,
                ) => {
                    let dash =
                        if words.ends_with(['н', 'т', 'а', 'о', 'ы']) { "" } else { "– " };
                    let _ = dash;
                    format!("{name} {words}")
                }
                (true, Property::Material) => format!("{name} {words}"),
                (true, other) => format!("{name}: {} – {words}", other.noun(Language::Russian)),
                (false, Property::Material) => format!("{name} is made of {}", material(&words)),
                (false, Property::Other(key)) => format!("{key} of {name}: {words}"),
                (false, _) => format!("{name} is {words}"),
            });
        }
        let said = if known { Said::Found } else { Said::Unknown };
        let text = parts.join("; ");
        Ok(Draft { facts, ..Draft::new(said, text).with(found) })
    }

    fn no_property(&self, property: &Property, thing: Thing) -> String {
        let noun = property.noun(self.language);
        match self.is_russian() {
            true => format!(
                "{} {} на карте не {}",
                noun,
                self.form(thing, Case::Genitive),
                match property {
                    Property::State => "указано",
                    Property::Surface | Property::Shape | Property::Orientation => "указана",
                    _ => "указан",
                }
            ),
            false => format!("the map does not give the {noun} of {}", self.name(thing)),
        }
    }

    fn size(&self, dimension: Dimension, of: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(of)?;
        let name = self.name(thing);
        let lang = self.language;
        let extent = match thing {
            Thing::Entity(Entity::Replica(id)) => self.relations.extent(id),
            Thing::Entity(Entity::Area(id)) => self.relations.area_extent(id),
            _ => None,
        };
        let door = match thing {
            Thing::Entity(Entity::Door(id)) => self.world.doors.get(&id),
            _ => None,
        };
        let is_area = thing.area().is_some();
        let (text, number) = match (extent, door) {
            (Some(e), _) => {
                let sizes = self.sizes(thing).unwrap_or_default();
                match (dimension, self.is_russian()) {
                    (Dimension::All, true) if is_area => (
                        format!(
                            "{name}: площадь {}, высота {}",
                            area(e.base, lang),
                            length(e.height, lang)
                        ),
                        e.base,
                    ),
                    (Dimension::All, false) if is_area => (
                        format!(
                            "{name} has a floor area of {} and is {} high",
                            area(e.base, lang),
                            length(e.height, lang)
                        ),
                        e.base,
                    ),
                    (Dimension::All, true) => (
                        format!(
                            "размеры {}: {sizes} (ширина, глубина, высота)",
                            self.form(thing, Case::Genitive)
                        ),
                        e.height,
                    ),
                    (Dimension::All, false) => {
                        (format!("{name} measures {sizes} (width, depth, height)"), e.height)
                    }
                    (Dimension::Height, true) => (
                        format!(
                            "высота {} – {}",
                            self.form(thing, Case::Genitive),
                            length(e.height, lang)
                        ),
                        e.height,
                    ),
                    (Dimension::Height, false) => {
                        (format!("{name} is {} high", length(e.height, lang)), e.height)
                    }
                    (Dimension::Width, true) => (
                        format!(
                            "ширина {} – {}",
                            self.form(thing, Case::Genitive),
                            length(e.width, lang)
                        ),
                        e.width,
                    ),
                    (Dimension::Width, false) => {
                        (format!("{name} is {} wide", length(e.width, lang)), e.width)
                    }
                    (Dimension::Length, true) => {
                        let long = e.width.max(e.depth);
                        (
                            format!(
                                "длина {} – {}",
                                self.form(thing, Case::Genitive),
                                length(long, lang)
                            ),
                            long,
                        )
                    }
                    (Dimension::Length, false) => {
                        let long = e.width.max(e.depth);
                        (format!("{name} is {} long", length(long, lang)), long)
                    }
                    (Dimension::Area, true) => (
                        format!(
                            "площадь {} – {}",
                            self.form(thing, Case::Genitive),
                            area(e.base, lang)
                        ),
                        e.base,
                    ),
                    (Dimension::Area, false) => {
                        (format!("{name} has an area of {}", area(e.base, lang)), e.base)
                    }
                }
            }
            (None, Some(door)) => {
                let (width, height) = (door.width.get(), door.height.get());
                let text = match (dimension, self.is_russian()) {
                    (Dimension::Height, true) => format!(
                        "высота {} – {}",
                        self.form(thing, Case::Genitive),
                        length(height, lang)
                    ),
                    (Dimension::Height, false) => {
                        format!("{name} is {} high", length(height, lang))
                    }
                    (Dimension::Width, true) => format!(
                        "ширина {} – {}",
                        self.form(thing, Case::Genitive),
                        length(width, lang)
                    ),
                    (Dimension::Width, false) => format!("{name} is {} wide", length(width, lang)),
                    (_, true) => format!(
                        "{name}: ширина {}, высота {}",
                        length(width, lang),
                        length(height, lang)
                    ),
                    (_, false) => format!(
                        "{name} is {} wide and {} high",
                        length(width, lang),
                        length(height, lang)
                    ),
                };
                (text, if dimension == Dimension::Height { height } else { width })
            }
            (None, None) => {
                let text = match self.is_russian() {
                    true => {
                        format!("размеры {} на карте не указаны", self.form(thing, Case::Genitive))
                    }
                    false => format!("the map does not give the size of {name}"),
                };
                return Ok(Draft::new(Said::Unknown, text).with(vec![thing]));
            }
        };
        Ok(Draft::new(Said::Found, text).with(vec![thing]).number(number))
    }

    fn parts(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let items = match thing {
            Thing::Entity(Entity::Replica(id)) => {
                let object =
                    self.world.replicas.get(&id).and_then(|r| self.world.objects.get(&r.object));
                object.map(|o| &o.items)
            }
            Thing::Entity(Entity::Area(id)) => self.world.areas.get(&id).map(|a| &a.items),
            _ => None,
        };
        let name = self.name(thing);
        let Some(items) = items.filter(|i| !i.is_empty()) else {
            let text = match self.is_russian() {
                true => format!("части {} на карте не описаны", self.form(thing, Case::Genitive)),
                false => format!("the map does not tell the parts of {name}"),
            };
            return Ok(Draft::new(Said::Unknown, text).with(vec![thing]));
        };
        let mut counted: Vec<(crate::units::OrFrId, usize)> = Vec::new();
        for item in items {
            match counted.iter_mut().find(|(id, _)| *id == item.orthoframe) {
                Some((_, n)) => *n += 1,
                None => counted.push((item.orthoframe, 1)),
            }
        }
        let mut facts = Vec::new();
        let parts: Vec<String> = counted
            .iter()
            .filter_map(|(id, n)| {
                let part = self.world.orthoframes.get(id)?;
                let symbol = self.relations.symbols().symbol(crate::semantics::Subject::Part(*id));
                let whole = match thing {
                    Thing::Entity(Entity::Replica(r)) => {
                        let object = self.world.replicas.get(&r)?.object;
                        self.relations
                            .symbols()
                            .symbol(crate::semantics::Subject::Object(object))
                            .to_string()
                    }
                    other => self.symbol(other),
                };
                facts.push(Fact::holding("PART_OF", vec![symbol.to_string(), whole]));
                let kind = self.world.types.orthoframe.get(part.frame_type);
                let title = match (part.name.is_empty(), kind) {
                    (false, _) => part.name.clone(),
                    (true, Some(kind)) => kind.name.clone(),
                    (true, None) => part.key.clone(),
                };
                let english = match (part.name_en.is_empty(), kind) {
                    (false, _) => part.name_en.clone(),
                    (true, Some(kind)) if !kind.name_en.is_empty() => kind.name_en.clone(),
                    _ => crate::language::english::name_of(&title).unwrap_or_else(|| title.clone()),
                };
                let phrase = crate::language::NounPhrase::parse(
                    &title,
                    &crate::language::WordHints::default(),
                );
                Some(match (self.is_russian(), *n) {
                    (true, 1) => super::lexicon::lower_first(&phrase.case(Case::Genitive)),
                    (true, n) => genitive_count(n, &phrase),
                    (false, 1) => crate::language::english::with_article(&english.to_lowercase()),
                    (false, n) => {
                        crate::language::english::count(n as u64, &english.to_lowercase())
                    }
                })
            })
            .collect();
        let list = enumerate(&parts, self.language);
        let number = items.len() as f64;
        let text = match self.is_russian() {
            true => format!("{name} состоит из {list}"),
            false => format!("{name} consists of {list}"),
        };
        Ok(Draft { facts, ..Draft::new(Said::Found, text).with(vec![thing]) }.number(number))
    }

    // ── doors and ways ───────────────────────────────────────────────────────────────────────────

    fn leads(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let name = self.name(thing);
        let areas: Vec<Thing> = self
            .gate(thing)
            .map(|g| g.areas.iter().map(|a| Thing::Entity(Entity::Area(*a))).collect())
            .unwrap_or_default();
        let text = match (&areas[..], self.is_russian()) {
            ([a, b, ..], true) => format!(
                "{name} соединяет {} и {}",
                self.form(*a, Case::Accusative),
                self.form(*b, Case::Accusative)
            ),
            ([a, b, ..], false) => format!("{name} joins {} and {}", self.name(*a), self.name(*b)),
            ([a], true) => {
                format!("{name} ведёт {} за пределы карты", self.place(Rel::From, &[*a]))
            }
            ([a], false) => format!("{name} leads from {} out of the map", self.name(*a)),
            ([], true) => format!("{name}: куда ведёт, на карте не указано"),
            ([], false) => format!("the map does not tell where {name} leads"),
        };
        let facts = match &areas[..] {
            [a, b, ..] => vec![Fact::holding(
                "JOINS",
                vec![self.symbol(thing), self.symbol(*a), self.symbol(*b)],
            )],
            _ => Vec::new(),
        };
        let said = if areas.is_empty() { Said::Unknown } else { Said::Found };
        Ok(Draft { facts, ..Draft::new(said, text).with(areas) }.about(&[thing]))
    }

    fn way(&self, from: Option<&Noun>, to: &Noun, yes_or_no: bool) -> Result<Draft, Doubt> {
        let from = from.map(|noun| self.one(noun)).transpose()?;
        let to = self.one(to)?;
        let way = self.senses.way(from, to, self.language);
        let topic = [to];
        Ok(match way {
            Ok(way) => {
                let far = length(way.length, self.language);
                let steps = way.sentences.join(" ");
                let text = match (yes_or_no, self.is_russian()) {
                    (true, true) => format!("да, путь есть, его длина {far}. {steps}"),
                    (true, false) => format!("yes, there is a way of {far}. {steps}"),
                    (false, true) => format!("{steps} Длина пути {far}"),
                    (false, false) => format!("{steps} The way is {far} long"),
                };
                let said = if yes_or_no { Said::Yes } else { Said::Found };
                Draft::new(said, text).about(&topic).number(way.length)
            }
            Err(why) => {
                let text = match self.is_russian() {
                    true => format!(
                        "{}проехать туда нельзя: {why}",
                        if yes_or_no { "нет, " } else { "" }
                    ),
                    false => {
                        format!("{}there is no way: {why}", if yes_or_no { "no, " } else { "" })
                    }
                };
                Draft::new(Said::No, text).about(&topic)
            }
        })
    }

    fn say_distance(&self, from: Option<&Noun>, to: &Noun) -> Result<Draft, Doubt> {
        let from = from.map(|noun| self.one(noun)).transpose()?;
        let to = self.one(to)?;
        let start = from.unwrap_or(Thing::Robot);
        let straight = self.distance(start, to);
        let areas = |t: Thing| match self.gate(t) {
            Some(gate) => gate.areas.clone(),
            None => self.area_of(t).into_iter().collect(),
        };
        let own = areas(start);
        let same_room = areas(to).iter().any(|a| own.contains(a));
        let things = start.area().is_none() && to.area().is_none() && start != Thing::Robot;
        let way = match same_room && things {
            true => None,
            false => self.senses.way(from, to, self.language).ok().map(|w| w.length),
        };
        let (a, b) = (self.form(start, Case::Genitive), self.form(to, Case::Genitive));
        let until = russian::preposition(russian::Preposition::Do, &b);
        let of = russian::preposition(russian::Preposition::Ot, &a);
        let lang = self.language;
        let name = |t: Thing| self.name(t);
        let text = match (way, straight, self.is_russian()) {
            (Some(way), Some(d), true) => format!(
                "{of} {a} {until} {b} {} пути, по прямой {}",
                length(way, lang),
                length(d, lang)
            ),
            (Some(way), None, true) => format!("{of} {a} {until} {b} {} пути", length(way, lang)),
            (None, Some(d), true) => format!("{of} {a} {until} {b} {}", length(d, lang)),
            (Some(way), Some(d), false) => format!(
                "from {} to {} it is {} by way, {} in a straight line",
                name(start),
                name(to),
                length(way, lang),
                length(d, lang)
            ),
            (Some(way), None, false) => format!(
                "from {} to {} the way is {} long",
                name(start),
                name(to),
                length(way, lang)
            ),
            (None, Some(d), false) => {
                format!("from {} to {} it is {}", name(start), name(to), length(d, lang))
            }
            (None, None, true) => {
                format!("расстояние {of} {a} {until} {b} неизвестно: они на разных картах")
            }
            (None, None, false) => format!(
                "the distance from {} to {} is unknown: they are on different maps",
                name(start),
                name(to)
            ),
        };
        let number = way.or(straight);
        let said = if number.is_some() { Said::Found } else { Said::Unknown };
        let mut draft = Draft::new(said, text).about(&[to]);
        draft.number = number;
        Ok(draft)
    }

    // ── comparing ────────────────────────────────────────────────────────────────────────────────

    fn closer(
        &self,
        what: &Noun,
        near: &Noun,
        than: &Noun,
        closeness: Closeness,
    ) -> Result<Draft, Doubt> {
        let (what, near, than) = (self.one(what)?, self.one(near)?, self.one(than)?);
        let (Some(a), Some(b)) = (self.distance(what, near), self.distance(what, than)) else {
            return Ok(self.apart(&[what, near, than]));
        };
        let nearer = a < b;
        let yes = nearer == (closeness == Closeness::Nearer) && (a - b).abs() > 1e-9;
        let lang = self.language;
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let text = match self.is_russian() {
            true => {
                let to = |t: Thing| self.form(t, Case::Genitive);
                format!(
                    "{head}{} {} {} {}, а {} {} {}",
                    russian::preposition(russian::Preposition::Ot, &to(what)),
                    to(what),
                    format_args!("до {}", to(near)),
                    length(a, lang),
                    "до",
                    to(than),
                    length(b, lang)
                )
            }
            false => format!(
                "{head}it is {} from {} to {} and {} to {}",
                length(a, lang),
                self.name(what),
                self.name(near),
                length(b, lang),
                self.name(than)
            ),
        };
        let said = if yes { Said::Yes } else { Said::No };
        Ok(Draft::new(said, text).with(vec![what]).about(&[near, than]))
    }

    fn apart(&self, things: &[Thing]) -> Draft {
        let list = self.list(things);
        let text = match self.is_russian() {
            true => format!("сравнить нельзя: {list} – на разных картах или не имеют размеров"),
            false => {
                format!("they cannot be compared: {list} are on different maps or have no size")
            }
        };
        Draft::new(Said::Unknown, text)
    }

    fn compared(&self, thing: Thing, extreme: Extreme, to: Option<Thing>) -> Option<f64> {
        match extreme {
            Extreme::Nearest | Extreme::Farthest => {
                self.distance(thing, to.unwrap_or(Thing::Robot))
            }
            other => self.measure(other, thing),
        }
    }

    fn compared_words(&self, thing: Thing, extreme: Extreme, value: f64) -> String {
        match extreme {
            Extreme::Nearest | Extreme::Farthest => length(value, self.language),
            other => self.measure_words(other, thing),
        }
    }

    fn which_more(
        &self,
        of: &[Noun; 2],
        extreme: Extreme,
        to: Option<&Noun>,
    ) -> Result<Draft, Doubt> {
        let (a, b) = (self.one(&of[0])?, self.one(&of[1])?);
        let to = to.map(|noun| self.one(noun)).transpose()?;
        let (Some(x), Some(y)) = (self.compared(a, extreme, to), self.compared(b, extreme, to))
        else {
            return Ok(self.apart(&[a, b]));
        };
        let less = matches!(
            extreme,
            Extreme::Nearest | Extreme::Smallest | Extreme::Lowest | Extreme::Narrowest
        );
        let first = (x < y) == less;
        let (winner, best, other, rest) = if first { (a, x, b, y) } else { (b, y, a, x) };
        if (x - y).abs() < 1e-6 {
            let text = self.pick("они одинаковы", "they are equal").to_owned();
            return Ok(Draft::new(Said::Nothing, text).with(vec![a, b]));
        }
        let (best, rest) =
            (self.compared_words(winner, extreme, best), self.compared_words(other, extreme, rest));
        let (name, other_name) = (self.name(winner), self.name(other));
        let comparative = self.comparative(extreme);
        let text = match self.is_russian() {
            true => format!("{comparative} {name} ({best}; {other_name} – {rest})"),
            false => format!("{name} is {comparative} ({best}; {other_name}: {rest})"),
        };
        Ok(Draft::new(Said::Found, text).with(vec![winner]).about(&[other]))
    }

    fn comparative(&self, extreme: Extreme) -> &'static str {
        match extreme {
            Extreme::Nearest => self.pick("ближе", "closer"),
            Extreme::Farthest => self.pick("дальше", "farther"),
            Extreme::Smallest => self.pick("меньше", "smaller"),
            Extreme::Tallest => self.pick("выше", "taller"),
            Extreme::Lowest => self.pick("ниже", "lower"),
            Extreme::Widest => self.pick("шире", "wider"),
            Extreme::Narrowest => self.pick("уже", "narrower"),
            Extreme::Longest => self.pick("длиннее", "longer"),
            _ => self.pick("больше", "bigger"),
        }
    }

    fn larger(
        &self,
        what: &Noun,
        than: &Noun,
        extreme: Extreme,
        to: Option<&Noun>,
    ) -> Result<Draft, Doubt> {
        let (a, b) = (self.one(what)?, self.one(than)?);
        let to = to.map(|noun| self.one(noun)).transpose()?;
        let (Some(x), Some(y)) = (self.compared(a, extreme, to), self.compared(b, extreme, to))
        else {
            return Ok(self.apart(&[a, b]));
        };
        let less = matches!(
            extreme,
            Extreme::Nearest | Extreme::Smallest | Extreme::Lowest | Extreme::Narrowest
        );
        let yes = (x - y).abs() > 1e-9 && (x < y) == less;
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let words = |t, v| self.compared_words(t, extreme, v);
        let text =
            format!("{head}{} – {}, {} – {}", self.name(a), words(a, x), self.name(b), words(b, y));
        let said = if yes { Said::Yes } else { Said::No };
        Ok(Draft::new(said, text).with(vec![a]).about(&[b]))
    }

    fn same(&self, property: &Property, of: &[Noun; 2]) -> Result<Draft, Doubt> {
        let (a, b) = (self.one(&of[0])?, self.one(&of[1])?);
        let own = |t: Thing| self.values(t).into_iter().find(|(p, _, _)| p == property);
        let (Some((_, x, first)), Some((_, y, second))) = (own(a), own(b)) else {
            let missing = if own(a).is_none() { a } else { b };
            return Ok(
                Draft::new(Said::Unknown, self.no_property(property, missing)).with(vec![a, b])
            );
        };
        let yes = if x.is_some() { x == y } else { first == second };
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let words = |t: Thing, v: Option<super::values::ValueId>, text: &str| match v {
            Some(v) => self.value_of(property, v, t),
            None => text.to_lowercase(),
        };
        let dash = self.pick("", "is ");
        let text = format!(
            "{head}{} {dash}{}, {} {dash}{}",
            self.name(a),
            words(a, x, &first),
            self.name(b),
            words(b, y, &second)
        );
        let said = if yes { Said::Yes } else { Said::No };
        Ok(Draft::new(said, text).with(vec![a, b]))
    }

    // ── what is free, where one can sit ──────────────────────────────────────────────────────────

    fn free(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let top = thing.replica().and_then(|id| self.relations.free_top(id));
        let Some((whole, free)) = top.filter(|(whole, _)| *whole > 0.0) else {
            let text = match self.is_russian() {
                true => format!(
                    "{} {} ничего положить нельзя",
                    "на",
                    self.form(thing, Case::Accusative)
                ),
                false => format!("nothing can be put on {}", self.name(thing)),
            };
            return Ok(Draft::new(Said::No, text).with(vec![thing]));
        };
        let share = (free / whole * 100.0).round();
        let on_it = self.related(Rel::On, thing);
        let (free_words, place) = (area(free, self.language), self.place(Rel::On, &[thing]));
        let mut text = match (share >= 5.0, self.is_russian()) {
            (true, true) => format!("{place} свободно {share:.0} % поверхности ({free_words})"),
            (true, false) => format!("{share:.0} % of the surface {place} is free ({free_words})"),
            (false, true) => format!("нет, {place} почти нет свободного места"),
            (false, false) => format!("no, there is hardly any free space {place}"),
        };
        if !on_it.is_empty() {
            let list = self.list(&on_it);
            text = match self.is_russian() {
                true => format!("{text}; там {} {list}", self.is(&on_it)),
                false => format!("{text}; {list} {} there", self.is(&on_it)),
            };
        }
        let said = if share >= 5.0 { Said::Yes } else { Said::No };
        Ok(Draft::new(said, text).with(vec![thing]).about(&on_it).number(share))
    }

    fn usable(
        &self,
        use_for: Use,
        what: Option<&Noun>,
        within: &[Restriction],
    ) -> Result<Draft, Doubt> {
        let mut noun = Noun { plural: true, indefinite: true, ..Noun::default() };
        noun.head.anything = true;
        noun.restrictions = within.to_vec();
        let all = self.find(&noun, false)?;
        let thing = match what {
            Some(what) if use_for == Use::Put => {
                let mut found = self.find(what, true)?;
                found.truncate(1);
                found.pop()
            }
            _ => None,
        };
        let needed = thing
            .and_then(Thing::replica)
            .and_then(|id| self.relations.extent(id))
            .map_or(400.0, |e| e.base);
        let fits = |t: &Thing| {
            let Some(id) = t.replica() else { return false };
            match use_for {
                Use::Sit => self.has_trait(id, "seat"),
                Use::Lie => self.has_trait(id, "bed"),
                Use::Put => {
                    self.has_trait(id, "support")
                        && !self.has_trait(id, "portable")
                        && Some(*t) != thing
                        && self.relations.free_top(id).is_some_and(|(_, free)| free >= needed)
                }
            }
        };
        let found: Vec<Thing> = all.into_iter().filter(fits).collect();
        // What something stands on is no seat now.
        let found: Vec<Thing> = match use_for {
            Use::Put => found,
            _ => {
                let empty =
                    |t: &Thing| t.replica().is_none_or(|id| !self.relations.bears_something(id));
                found.into_iter().filter(empty).collect()
            }
        };
        let place = self.restrictions(&noun);
        let text = match (use_for, found.is_empty(), self.is_russian()) {
            (_, true, true) => format!("{place} такого места на карте нет"),
            (_, true, false) => format!("the map has no such place {place}"),
            (Use::Sit, _, true) => format!("сесть можно {}", self.seats(&found)),
            (Use::Sit, _, false) => format!("one can sit on {}", self.list(&found)),
            (Use::Lie, _, true) => format!("лечь можно {}", self.seats(&found)),
            (Use::Lie, _, false) => format!("one can lie down on {}", self.list(&found)),
            (Use::Put, _, true) => format!("свободное место есть {}", self.place(Rel::On, &found)),
            (Use::Put, _, false) => format!("there is free space {}", self.place(Rel::On, &found)),
        };
        let facts = found.iter().take(20).map(|t| {
            let wanted = match use_for {
                Use::Sit => "seat",
                Use::Lie => "bed",
                Use::Put => "support",
            };
            Fact::holding("HAS_TRAIT", vec![self.symbol(*t), wanted.to_owned()])
        });
        let facts = facts.collect();
        let said = if found.is_empty() { Said::Nothing } else { Said::Found };
        Ok(Draft { facts, ..Draft::new(said, text).with(found) })
    }

    /// «на Диван-1, на Кресло-1 или на Стул-2»
    fn seats(&self, found: &[Thing]) -> String {
        format!("на {}", self.names(found, Case::Accusative))
    }

    // ── history ──────────────────────────────────────────────────────────────────────────────────

    fn last_seen(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let sightings = thing.replica().map(|id| self.senses.sightings(id)).unwrap_or_default();
        let name = self.name(thing);
        let Some(last) = sightings.iter().rev().find(|s| s.place.is_some()) else {
            let place = self.short_place(thing, &mut Vec::new());
            let text = match self.is_russian() {
                true => {
                    let seen = self.form(thing, Case::Genitive);
                    format!("сам я {seen} не видел; по карте {name} {} {place}", self.is(&[thing]))
                }
                false => format!("I have not seen {name} myself; by the map it is {place}"),
            };
            return Ok(Draft::new(Said::Unknown, text).with(vec![thing]));
        };
        let place = last.place.map(|a| self.place(Rel::In, &[Thing::Entity(Entity::Area(a))]));
        let place = place.unwrap_or_default();
        let text = match self.is_russian() {
            true => {
                let seen = self.form(thing, Case::Accusative);
                format!("последний раз я видел {seen} {} {place}", last.at)
            }
            false => format!("I last saw {name} {} {place}", last.at),
        };
        Ok(Draft::new(Said::Found, text).with(vec![thing]))
    }

    fn before(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let past = thing.replica().map(|id| self.senses.past(id)).unwrap_or_default();
        let name = self.name(thing);
        let Some(last) = past.last() else {
            let text = match self.is_russian() {
                true => format!(
                    "других мест {} в истории нет: {}",
                    self.form(thing, Case::Genitive),
                    self.where_one(thing, &mut Vec::new())
                ),
                false => format!(
                    "the history knows no other place: {}",
                    self.where_one(thing, &mut Vec::new())
                ),
            };
            return Ok(Draft::new(Said::Nothing, text).with(vec![thing]));
        };
        let mut parts = Vec::new();
        if let Some(support) = last.support {
            let support = Thing::Entity(Entity::Replica(support));
            parts.push(self.place(Rel::On, &[support]));
        }
        if let Some(area) = last.area {
            parts.push(self.place(Rel::In, &[Thing::Entity(Entity::Area(area))]));
        }
        let place = parts.join(" ");
        let until = &last.until;
        let (gender, number) = self.gender(thing);
        let text = match self.is_russian() {
            true => {
                let verb = match (number, gender) {
                    (Number::Plural, _) => "находились",
                    (_, crate::language::Gender::Feminine) => "находилась",
                    (_, crate::language::Gender::Neuter) => "находилось",
                    _ => "находился",
                };
                format!("до {until} {name} {verb} {place}")
            }
            false => format!("until {until} {name} was {place}"),
        };
        Ok(Draft::new(Said::Found, text).with(vec![thing]))
    }

    // ── the robot itself ─────────────────────────────────────────────────────────────────────────

    fn where_are_you(&self) -> Draft {
        let unknown =
            || self.pick("я не знаю, где нахожусь", "I do not know where I am").to_owned();
        let text = self.senses.position(self.language);
        let said = if text.is_some() { Said::Found } else { Said::Unknown };
        let room = self.area_of(Thing::Robot).map(|a| Thing::Entity(Entity::Area(a)));
        Draft::new(said, text.unwrap_or_else(unknown)).with(room.into_iter().collect())
    }

    fn what_do_you_see(&self) -> Draft {
        let seen: Vec<Thing> = self
            .senses
            .visible()
            .into_iter()
            .map(|id| Thing::Entity(Entity::Replica(id)))
            .collect();
        let text = match (seen.is_empty(), self.is_russian()) {
            (true, true) => "передо мной ничего нет".to_owned(),
            (true, false) => "I see nothing before me".to_owned(),
            (false, true) => format!("я вижу {}", self.names(&seen, Case::Accusative)),
            (false, false) => format!("I see {}", self.list(&seen)),
        };
        let said = if seen.is_empty() { Said::Nothing } else { Said::Found };
        Draft::new(said, text).with(seen)
    }

    fn describe(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let name = self.name(thing);
        let mut facts = Vec::new();
        let mut parts: Vec<String> = Vec::new();
        let kind = self.kind_name(thing);
        parts.push(match (kind, self.is_russian()) {
            (Some(kind), true) => format!("{name} – {kind}"),
            (Some(kind), false) => format!("{name} is {}", crate::language::english::a(&kind)),
            (None, _) => name,
        });
        parts.push(self.where_one(thing, &mut facts));
        let values: Vec<String> = self
            .values(thing)
            .iter()
            // The id that a foreign file gave is nothing to tell.
            .filter(|(_, value, text)| value.is_some() && !text.contains('|'))
            .map(|(property, value, text)| match value {
                Some(value) => self.value_of(property, *value, thing),
                None => format!("{} – {text}", property.noun(self.language)),
            })
            .collect();
        if !values.is_empty() {
            parts.push(match self.is_russian() {
                true => format!("свойства: {}", enumerate(&values, self.language)),
                false => format!("properties: {}", enumerate(&values, self.language)),
            });
        }
        if let Some(sizes) = self.sizes(thing) {
            parts.push(match self.is_russian() {
                true => format!("размеры {sizes}"),
                false => format!("size {sizes}"),
            });
        }
        if thing.area().is_some() {
            let here: Vec<Thing> = self
                .related(Rel::In, thing)
                .into_iter()
                .filter(|t| t.replica().is_some())
                .collect();
            if !here.is_empty() {
                parts.push(match self.is_russian() {
                    true => format!("здесь {} {}", self.is(&here), self.list(&here)),
                    false => format!("here {} {}", self.is(&here), self.list(&here)),
                });
            }
        }
        Ok(Draft {
            facts,
            ..Draft::new(
                Said::Found,
                parts.iter().map(|p| sentence(p)).collect::<Vec<_>>().join(" "),
            )
            .with(vec![thing])
        })
    }

    /// «стул», "chair": the type of a thing.
    pub(super) fn kind_name(&self, thing: Thing) -> Option<String> {
        let entry = match thing {
            Thing::Entity(Entity::Replica(id)) => {
                let object = self.world.objects.get(&self.world.replicas.get(&id)?.object)?;
                self.world.types.object.get(object.object_type)
            }
            Thing::Entity(Entity::Area(id)) => {
                self.world.types.area.get(self.world.areas.get(&id)?.area_type)
            }
            Thing::Entity(Entity::Door(id)) => {
                let door = self.world.doors.get(&id)?;
                return Some(match (door.kind, self.is_russian()) {
                    (crate::map::DoorKind::Passage, true) => "проход".to_owned(),
                    (crate::map::DoorKind::Passage, false) => "passage".to_owned(),
                    (_, true) => "дверь".to_owned(),
                    (_, false) => "door".to_owned(),
                });
            }
            _ => None,
        }?;
        Some(match self.is_russian() || entry.name_en.is_empty() {
            true => super::lexicon::lower_first(&entry.name),
            false => entry.name_en.clone(),
        })
    }
}

/// «двух полок», as after «состоит из».
fn genitive_count(n: usize, phrase: &crate::language::NounPhrase) -> String {
    const WORDS: [&str; 11] =
        ["", "", "двух", "трёх", "четырёх", "пяти", "шести", "семи", "восьми", "девяти", "десяти"];
    let plural = super::lexicon::lower_first(&phrase.form(Case::Genitive, Number::Plural));
    match WORDS.get(n) {
        Some(word) => format!("{word} {plural}"),
        None => format!("{n} {plural}"),
    }
}

/// "wood" for "wooden".
fn material(words: &str) -> String {
    match words {
        "wooden" => "wood".to_owned(),
        other => other.to_owned(),
    }
}

fn status_word(status: DoorStatus) -> &'static str {
    match status {
        DoorStatus::Open => "open",
        DoorStatus::Closed => "closed",
        DoorStatus::Locked => "locked",
    }
}
