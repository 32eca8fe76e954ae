//! Whether something is so: claims of a thing judged one by one, and said with what is so instead.
//!
//! Invariant: a claim that fails names the fact that would have to hold.

use super::Draft;
use super::property::status_word;
use crate::map::{DoorStatus, Entity};
use crate::question::knowledge::Knowledge;
use crate::question::lexicon::Extension;
use crate::question::query::{Claim, Denial, Extreme, Noun, Rel, Restriction, Thing};
use crate::question::values::{Property, ValueId};
use crate::question::{Doubt, Fact, Said};
use crate::units::InOrder as _;
use crate::words::{Case, Number, enumerate};

impl Knowledge<'_> {
    /// Whether a claim holds of a thing, with the fact that says so or would have to.
    fn judge(&self, thing: Thing, claim: &Claim) -> Result<(bool, Vec<Fact>, Vec<Thing>), Doubt> {
        match claim {
            Claim::Related(restriction) => self.judge_related(thing, restriction),
            Claim::Value(filter) => {
                let holds = self.fits(thing, filter);
                let entry = self.lexicon().values.entry(filter.value);
                let own = self.valued(thing, filter.value);
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
                        let property = self.property_name(thing, &entry.property, &text);
                        Fact::holding("HAS", vec![self.symbol(thing), property, text])
                    }),
                };
                Ok((holds, fact.into_iter().collect(), Vec::new()))
            }
            Claim::Size(size) => {
                let measure = self.measure(size.extreme, thing);
                Ok((measure.is_some_and(|m| size.admits(m)), Vec::new(), Vec::new()))
            }
            Claim::Kind(noun) => {
                let of_kind = self.find(noun, true)?;
                Ok((of_kind.contains(&thing), Vec::new(), Vec::new()))
            }
        }
    }

    fn judge_related(
        &self,
        thing: Thing,
        restriction: &Restriction,
    ) -> Result<(bool, Vec<Fact>, Vec<Thing>), Doubt> {
        if let Some(level) = self.level_of(restriction)? {
            let mut noun = Noun::default();
            noun.head.things = Some(vec![thing]);
            noun.restrictions.push(restriction.clone());
            return Ok((!self.find(&noun, false)?.is_empty(), Vec::new(), vec![level.owner]));
        }
        if restriction.rel == Rel::Between
            || restriction.anchors.iter().any(|a| self.is_floor(a) || self.is_walls(a))
        {
            let mut noun = Noun::default();
            noun.head.things = Some(vec![thing]);
            noun.restrictions.push(restriction.clone());
            let holds = !self.find(&noun, false)?.is_empty();
            let mut anchors = Vec::new();
            for anchor in
                restriction.anchors.iter().filter(|a| !self.is_floor(a) && !self.is_walls(a))
            {
                anchors.extend(self.definite(anchor)?);
            }
            return Ok((holds, Vec::new(), anchors));
        }
        let Some(noun) = restriction.anchors.first() else {
            return Ok((false, Vec::new(), Vec::new()));
        };
        let mut anchors = Vec::new();
        for noun in &restriction.anchors {
            anchors.extend(self.find(&self.shelves(restriction.rel, noun), true)?);
        }
        if anchors.is_empty() {
            return Err(self.none_such(noun));
        }
        if restriction.rel == Rel::To || restriction.rel == Rel::Of {
            let joins = |a: &Thing| {
                let area = a.area();
                self.opening(thing).is_some_and(|g| area.is_some_and(|id| g.areas.contains(&id)))
                    || self.related(restriction.rel, *a).contains(&thing)
            };
            let holds = anchors.iter().copied().find(joins);
            return Ok((holds.is_some(), Vec::new(), holds.map_or(anchors, |a| vec![a])));
        }
        if restriction.negated {
            let hit = anchors.iter().find(|a| self.holds(restriction.rel, thing, **a));
            let none = hit.is_none();
            return Ok((none, Vec::new(), hit.map_or(anchors.clone(), |a| vec![*a])));
        }
        if let Some(&hit) = anchors.iter().find(|a| self.holds(restriction.rel, thing, **a)) {
            let fact = self.fact(restriction.rel, thing, hit);
            return Ok((true, fact.into_iter().collect(), vec![hit]));
        }
        if restriction.rel == Rel::NextTo
            && let Some(&hit) = anchors.iter().find(|a| self.stands_at(thing, **a))
        {
            let fact = Fact::holding("STANDS_AT", vec![self.symbol(thing), self.symbol(hit)]);
            return Ok((true, vec![fact], vec![hit]));
        }
        let fact = anchors.first().and_then(|a| self.missing(restriction.rel, thing, *a));
        Ok((false, fact.into_iter().collect(), anchors))
    }

    pub(super) fn say_holds(
        &self,
        subject: &Noun,
        claims: &[Claim],
        negated: bool,
    ) -> Result<Draft, Doubt> {
        if let [Claim::Value(filter)] = claims {
            let lit = |k: &super::super::lexicon::KindId| {
                self.lexicon().kind(*k).extension == Extension::Lighting
            };
            if subject.head.kinds.iter().any(lit) {
                return self.say_lighting(subject, filter.value, negated);
            }
        }
        if let Some((subject, claims)) = self.room_of_claims(subject, claims) {
            return self.say_holds(&subject, &claims, negated);
        }
        // «Комод в ванной?» where there are several: whether one of them is.
        let places = claims.iter().all(|c| matches!(c, Claim::Related(r) if !r.negated));
        let bare = subject.head.named.is_empty() && subject.head.things.is_none();
        // «Лампа на тумбочке включена?» of two bedside tables: neither is the lamp.
        let kind = self.base(&subject.head);
        let are_own = |all: &[Thing]| all.iter().all(|thing| kind.contains(thing));
        let mut found = match self.subject(subject) {
            Err(Doubt::Ambiguous { candidates, reference }) if !are_own(&candidates) => {
                return Err(Doubt::Ambiguous { candidates, reference });
            }
            Err(Doubt::Ambiguous { candidates, .. })
                if bare && places && !negated && self.is_any(subject, &candidates, claims)? =>
            {
                let mut any = Noun { indefinite: true, plural: true, ..subject.clone() };
                any.restrictions.extend(claims.iter().filter_map(|claim| match claim {
                    Claim::Related(restriction) => Some(restriction.clone()),
                    _ => None,
                }));
                return self.exists(&[any], false, Denial::None);
            }
            // "Is the remote not on the TV stand?": none of them is, whichever is meant.
            Err(Doubt::Ambiguous { candidates, reference }) => {
                let each = candidates.iter().flat_map(|t| claims.iter().map(|c| (*t, c)));
                let verdicts: Vec<bool> = each
                    .map(|(thing, claim)| Ok(self.judge(thing, claim)?.0))
                    .collect::<Result<_, Doubt>>()?;
                if verdicts.windows(2).any(|pair| pair[0] != pair[1]) {
                    return Err(Doubt::Ambiguous { candidates, reference });
                }
                candidates
            }
            found => found?,
        };
        // «Заперта ли лаборатория?»: its door, where it has only one.
        if let (&[room], [Claim::Value(filter)]) = (&found[..], claims)
            && let Some(area) = room.area()
            && self.own_value(room, filter.value).is_none()
            && self.lexicon().values.entry(filter.value).property == Property::State
        {
            let mut doors =
                self.openings().iter().filter(|g| !g.is_passage && g.areas.contains(&area));
            if let (Some(only), None) = (doors.next(), doors.next()) {
                found = vec![only.thing];
            }
        }
        if let (&[thing], [Claim::Value(filter)]) = (&found[..], claims)
            && self.lexicon().values.entry(filter.value).russian == "пустой"
            && self.own_value(thing, filter.value).is_none()
            && thing.replica().is_some()
        {
            return Ok(self.say_empty(thing, negated));
        }
        // Of what the map says nothing, nothing is claimed.
        let told_of = found.len();
        if let [Claim::Value(filter)] = claims
            && found.iter().any(|t| self.own_value(*t, filter.value).is_some())
        {
            found.retain(|t| self.own_value(*t, filter.value).is_some());
        }
        let untold = told_of - found.len();
        if let (&[thing], [Claim::Value(filter)]) = (&found[..], claims)
            && self.own_value(thing, filter.value).is_none()
        {
            let property = self.lexicon().values.entry(filter.value).property.clone();
            let text = self.no_property(&property, thing);
            return Ok(Draft::new(Said::Unknown, text).with(found));
        }
        if let (&[thing, _, ..], [Claim::Value(filter)]) = (&found[..], claims)
            && found.iter().all(|t| t.replica().is_some())
            && found.iter().all(|t| self.own_value(*t, filter.value).is_none())
            && !found.iter().any(|t| self.fits(*t, filter))
            && self.lexicon().values.entry(filter.value).russian != "пустой"
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
            let mut parts: Vec<String> =
                claims.iter().map(|c| self.claim_words(thing, c)).collect::<Result<_, _>>()?;
            // «Телевизор работает, включён?» asks one thing.
            parts.dedup();
            format!("{} {}", self.name(thing), enumerate(&parts, self.language))
        };
        // That all are so is known where it is known of all.
        let (text, said) = match (all && untold > 0, yes) {
            (true, _) => (self.as_far_as_told(&format!("{head}{text}"), untold), Said::Unknown),
            (false, true) => (format!("{head}{text}"), Said::Yes),
            (false, false) => (format!("{head}{text}"), Said::No),
        };
        topic.truncate(4);
        facts.order_by_key(|f| f.holds == all);
        facts.reverse();
        Ok(Draft { facts, ..Draft::new(said, text).with(found) }.about(&topic))
    }

    /// What is so of all of which the map tells, beside so many of which it does not.
    pub(super) fn as_far_as_told(&self, text: &str, untold: usize) -> String {
        match self.is_russian() {
            true => format!("насколько говорит карта, {text}; о других ({untold}) она не говорит"),
            false => format!("as far as the map tells, {text}; of {untold} more it does not tell"),
        }
    }

    /// The subject of a claim: one thing, or all of several.
    pub(super) fn subject(&self, noun: &Noun) -> Result<Vec<Thing>, Doubt> {
        match self.definite(noun) {
            Ok(found) => Ok(found),
            Err(doubt) => Err(doubt),
        }
    }

    /// Whether a claim of place is about any of several things: in Russian, and where one of them fits.
    fn is_any(
        &self,
        subject: &Noun,
        candidates: &[Thing],
        claims: &[Claim],
    ) -> Result<bool, Doubt> {
        if self.is_russian() {
            return Ok(true);
        }
        let kind = self.base(&subject.head);
        let mut fits = false;
        for thing in candidates.iter().filter(|t| kind.contains(t)) {
            let judged: Result<Vec<bool>, Doubt> =
                claims.iter().map(|claim| Ok(self.judge(*thing, claim)?.0)).collect();
            fits |= judged?.into_iter().all(|holds| holds);
        }
        Ok(fits)
    }

    /// "Is the watch on the dresser in the bedroom?" where no watch is in the bedroom: the room tells of the dresser.
    fn room_of_claims(&self, subject: &Noun, claims: &[Claim]) -> Option<(Noun, Vec<Claim>)> {
        let rooms = |r: &Restriction| {
            let area = |t: &Thing| t.area().is_some();
            let named = |a: &Noun| self.find(a, true).is_ok_and(|all| all.iter().all(area));
            r.rel == Rel::In && !r.negated && r.anchors.iter().all(named)
        };
        let told = !subject.restrictions.is_empty() && subject.restrictions.iter().all(rooms);
        let none = told && self.find(subject, true).is_ok_and(|found| found.is_empty());
        if !none || claims.is_empty() {
            return None;
        }
        let anywhere = Noun { restrictions: Vec::new(), ..subject.clone() };
        let mut placed = claims.to_vec();
        for claim in &mut placed {
            let Claim::Related(restriction) = claim else { return None };
            for anchor in &mut restriction.anchors {
                anchor.restrictions.retain(|r| !subject.restrictions.contains(r));
                anchor.restrictions.extend(subject.restrictions.iter().cloned());
            }
        }
        self.find(&anywhere, true)
            .is_ok_and(|found| !found.is_empty())
            .then_some((anywhere, placed))
    }

    /// «закрыта (заперта)»: where the map says more than was asked.
    fn as_asked(&self, thing: Thing, value: ValueId) -> Option<String> {
        let values = &self.lexicon().values;
        let locked = self.value(values.meaning("запертый")?, thing);
        let stronger = values.entry(value).russian == "закрытый"
            && self.own_value(thing, value).is_some_and(|own| own == locked);
        let is = if self.is_russian() { "" } else { "is " };
        stronger.then(|| format!("{is}{} ({locked})", self.value(value, thing)))
    }

    /// «ни Пульт-1, ни Пульт-2»
    fn none_of_these(&self, found: &[Thing]) -> String {
        match (found, self.is_russian()) {
            ([a, b], true) => format!("ни {}, ни {}", self.name(*a), self.name(*b)),
            ([a, b], false) => format!("neither {} nor {}", self.name(*a), self.name(*b)),
            (_, true) => format!("ни одно из них ({})", self.list(found)),
            (_, false) => format!("none of them ({})", self.list(found)),
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
                        match (self.is_russian(), things) {
                            (true, [only]) => self.value(filter.value, *only),
                            (true, _) => self.lexicon().values.predicate(
                                filter.value,
                                crate::Gender::Masculine,
                                Number::Plural,
                            ),
                            (false, _) => format!("{} {}", self.is(things), entry.english),
                        }
                    }
                    Claim::Related(r) => {
                        let mut noun = Noun::default();
                        noun.restrictions.push(r.clone());
                        format!("{} {}", self.is(things), self.restrictions(&noun))
                    }
                    Claim::Size(size) => self.size_words(*size),
                    Claim::Kind(noun) => {
                        let (phrase, english) = self.kind_phrase(noun);
                        match (self.is_russian(), things) {
                            (true, _) => crate::question::lexicon::lower_first(
                                &phrase.form(Case::Nominative, Number::Plural),
                            ),
                            (false, [_]) => format!("is {}", crate::english::a(&english)),
                            (false, _) => format!("are {}", crate::english::plural(&english)),
                        }
                    }
                })
                .collect();
            enumerate(&parts, self.language)
        };
        match (fit.is_empty(), failed.is_empty(), self.is_russian()) {
            (_, true, true) => format!("все {}: {}", words(found), self.list(found)),
            (_, true, false) => format!("all of them: {}", self.list(found)),
            (true, _, _) => self.none_of_these(found),
            (false, false, true) => {
                let are_kinds = claims.iter().all(|claim| matches!(claim, Claim::Kind(_)));
                let are = if are_kinds { " –" } else { "" };
                format!(
                    "не все: {}{are} {}, а {} – нет",
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
            Claim::Related(restriction)
                if matches!(restriction.rel, Rel::NextTo | Rel::Near)
                    && thing.area().is_some()
                    && anchors.len() == 1
                    && anchors[0].area().is_some() =>
            {
                self.joined_words(thing, anchors[0], holds)
            }
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
                    Some(anchor) if let Ok(Some(level)) = self.level_of(restriction) => {
                        self.place_on(&level, anchor, restriction.rel)
                    }
                    // Walls and corners have no names: «в углах», "next to the walls".
                    Some(anchor) if self.is_walls(anchor) => {
                        let mut noun = Noun::default();
                        noun.restrictions.push(restriction.clone());
                        self.restrictions(&noun)
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
                // «не на верхней полке, а на нижней»
                let level = restriction.anchors.first().filter(|_| {
                    !holds && self.level_of(restriction).is_ok_and(|level| level.is_some())
                });
                let level = level.and_then(|part| Some((self.level_under(thing, part)?, part)));
                if let Some((level, part)) = level {
                    let own = self.place_on(&level, part, restriction.rel);
                    return Ok(match self.is_russian() {
                        true => format!("{verb} не {place}, а {own}"),
                        false => format!("{verb} not {place} but {own}"),
                    });
                }
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
            Claim::Size(size) => {
                let own = self.measure_words(size.extreme, thing);
                match self.is_russian() {
                    _ if own.is_empty() => self.pick("– без размера", "has no size").to_owned(),
                    true => format!("– {own}"),
                    false => format!("is {own}"),
                }
            }
            // "Is the kitchen the biggest room?": which is.
            Claim::Kind(noun) if noun.best.is_some() => {
                let best = self.find(noun, true)?;
                let first = best.first().copied().unwrap_or(thing);
                let extreme = noun.best.as_ref().map_or(Extreme::Biggest, |b| b.extreme);
                let measure = self.measure_words(extreme, if holds { thing } else { first });
                let told = if measure.is_empty() { measure } else { format!(" ({measure})") };
                match (holds, self.is_russian()) {
                    (true, true) => told.trim_start().to_owned(),
                    (true, false) => format!("{}{told}", self.is(&[thing])),
                    (false, true) => format!("уступает: это {}{told}", self.list(&best)),
                    (false, false) => {
                        format!("{} not: it is {}{told}", self.is(&[thing]), self.list(&best))
                    }
                }
            }
            Claim::Kind(noun) => {
                let (phrase, english) = self.kind_phrase(noun);
                let name = crate::question::lexicon::lower_first(&phrase.case(Case::Nominative));
                match (holds, self.is_russian()) {
                    (true, true) => format!("– это {name}"),
                    (false, true) => format!("– не {name}"),
                    (true, false) => format!("is {}", crate::english::a(&english)),
                    (false, false) => format!("is not {}", crate::english::a(&english)),
                }
            }
        })
    }

    /// «соединена с Комнатой-Z (Дверь-ZY)», "is not connected to the hall"
    fn joined_words(&self, room: Thing, other: Thing, holds: bool) -> String {
        let joins = room.area().zip(other.area()).into_iter();
        let joins = joins.flat_map(|(a, b)| self.openings_between(a, b));
        let gates: Vec<Thing> = joins.map(|g| g.thing).collect();
        // «(Дверь-КY, закрыта)»: through a closed door no one goes at once.
        let told = |gate: &Thing| {
            let shut = self.statuses(*gate).into_iter().find(|(s, _)| *s != DoorStatus::Open);
            let value = shut.and_then(|(status, _)| self.lexicon().values.of_door(status));
            match value {
                Some(value) => format!("{}, {}", self.name(*gate), self.value(value, *gate)),
                None => self.name(*gate),
            }
        };
        let gates: Vec<String> = gates.iter().map(told).collect();
        let by = if gates.is_empty() { String::new() } else { format!(" ({})", gates.join("; ")) };
        if !self.is_russian() {
            let not = if holds { "" } else { " not directly" };
            return format!("is{not} connected to {}{by}", self.name(other));
        }
        let ending = match self.gender(room) {
            (_, Number::Plural) => "ы",
            (crate::Gender::Feminine, _) => "а",
            (crate::Gender::Neuter, _) => "о",
            _ => "",
        };
        let not = if holds { "" } else { "не " };
        let form = self.form(other, Case::Instrumental);
        let with = crate::words::russian::preposition(crate::words::russian::Preposition::S, &form);
        let directly = if holds { "" } else { " напрямую" };
        let stem = match ending {
            "" => "соединён",
            _ => "соединен",
        };
        format!("{not}{stem}{ending}{directly} {with} {form}{by}")
    }

    /// The value that a thing has of the property asked about.
    pub(in crate::question) fn own_value(&self, thing: Thing, asked: ValueId) -> Option<String> {
        self.valued(thing, asked).map(|(_, value, text)| match value {
            Some(value) => self.value(value, thing),
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

    pub(super) fn choose(&self, subject: &Noun, claims: &[Claim]) -> Result<Draft, Doubt> {
        let found = self.subject(subject)?;
        let mut facts = Vec::new();
        let mut parts = Vec::new();
        let (mut any, mut unknown) = (false, false);
        for &thing in &found {
            let (mut fits, mut own) = (Vec::new(), Vec::new());
            // «на комоде или в нём»: what makes it in the thing does not make it on the thing as well.
            let inside = |claim: &&Claim| matches!(claim, Claim::Related(r) if r.rel == Rel::In);
            let others = claims.iter().filter(|claim| !inside(claim));
            for claim in claims.iter().filter(inside).chain(others) {
                let (holds, why, _) = self.judge(thing, claim)?;
                let why: Vec<Fact> = why.into_iter().collect();
                if holds && (why.is_empty() || why.iter().any(|fact| !own.contains(fact))) {
                    own.extend(why);
                    let words = self.claim_words(thing, claim)?;
                    // What is locked is closed too: once is enough, in the word that was asked with.
                    let words = match claim {
                        Claim::Value(filter) if !filter.negated => {
                            self.as_asked(thing, filter.value)
                        }
                        _ => None,
                    }
                    .unwrap_or(words);
                    if !fits.contains(&words) {
                        fits.push(words);
                    }
                }
            }
            facts.extend(own);
            any |= !fits.is_empty();
            if !fits.is_empty() {
                parts.push(format!("{} {}", self.name(thing), enumerate(&fits, self.language)));
                continue;
            }
            // Of one property that the map does not give of it, neither value is denied.
            let told = |claim: &Claim| match claim {
                Claim::Value(filter) => {
                    let property = &self.lexicon().values.entry(filter.value).property;
                    let own = self.values(thing);
                    let known = own.iter().any(|(p, _, _)| p == property)
                        || self.lexicon().values.entry(filter.value).is_emptiness();
                    (!known).then(|| property.clone())
                }
                _ => None,
            };
            if let Some(property) = told(&claims[0])
                && claims.iter().all(|claim| told(claim).as_ref() == Some(&property))
            {
                unknown = true;
                parts.push(self.no_property(&property, thing));
                continue;
            }
            // «Ваза слева или справа от телевизора?» of one that stands before it and to a side.
            if let [Claim::Related(one), Claim::Related(other)] = claims
                && let [anchor] = self.anchors(one, &one.anchors[0], true)?[..]
                && let Some(rel) = self.rather([one.rel, other.rel], thing, anchor)
            {
                any = true;
                let place = self.place(rel, &[anchor]);
                let (is, frame) = (self.is(&[thing]), self.frame_words(rel, anchor));
                parts.push(format!("{} {is} {place}{frame}", self.name(thing)));
                continue;
            }
            // Of two values what it is instead; of several sides none.
            let own = self.claim_words(thing, &claims[0])?;
            parts.push(match (self.is_russian(), claims.len() > 2) {
                (true, false) => format!("{} – ни то, ни другое: {own}", self.name(thing)),
                (false, false) => format!("neither: {} {own}", self.name(thing)),
                (true, true) => format!("{} – ни с одной из сторон", self.name(thing)),
                (false, true) => format!("{} is on none of its sides", self.name(thing)),
            });
        }
        let said = match any {
            true => Said::Found,
            false if unknown => Said::Unknown,
            false => Said::Nothing,
        };
        let text = parts.join(self.pick("; ", "; "));
        Ok(Draft { facts, ..Draft::new(said, text).with(found) })
    }
}
