//! Where a thing is: on what, in which room, beside what; where a door stands and what a room lies next to.
//!
//! Invariant: every place that is said rests on a fact that is handed out with it.

use super::{Draft, grouped};
use crate::map::Entity;
use crate::question::knowledge::{Held, Knowledge};
use crate::question::query::{Extreme, Filter, Head, Noun, Rel, Restriction, Thing};
use crate::question::{Doubt, Fact, Said};
use crate::report::{Detail, Named};
use crate::units::{AreaId, InOrder as _};
use crate::words::length;
use crate::words::{Case, enumerate, russian};

impl Knowledge<'_> {
    pub(in crate::question) fn say_where(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let mut found = self.few(noun)?;
        self.one_of_each_lift(noun, &mut found);
        let mut facts = Vec::new();
        if let [only] = found[..] {
            let mut text = self.where_one(only, &mut facts);
            // «Где ближайший лифт?»
            let near = noun.best.as_ref().filter(|best| best.anchor.is_none());
            let near = near.filter(|b| matches!(b.extreme, Extreme::Nearest | Extreme::Farthest));
            if let Some(away) = near.and_then(|_| self.distance(only, Thing::Robot)) {
                let away = length(away, self.language);
                let away = match self.is_russian() {
                    true => format!(", в {away} от меня"),
                    false => format!(", {away} from me"),
                };
                text.insert_str(text.find(';').unwrap_or(text.len()), &away);
            }
            let support = only.replica().and_then(|id| self.relations.support_of(id));
            let support = support.map(|id| Thing::Entity(Entity::Replica(id)));
            let area = self.area_of(only).map(|id| Thing::Entity(Entity::Area(id)));
            let places: Vec<Thing> = support.into_iter().chain(area).collect();
            return Ok(Draft { facts, ..Draft::new(Said::Found, text).with(found) }.about(&places));
        }
        // Several: by place, those in one place together.
        let groups = grouped(&found, |thing| self.short_place(thing, &mut facts));
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

    /// As [`Knowledge::definite`], but of a few things that are meant alike, all: where each of them is, is soon told.
    fn few(&self, noun: &Noun) -> Result<Vec<Thing>, Doubt> {
        const MOST: usize = 5;
        // "The mug on the desk", of two desks: the desks are not what is asked of.
        let own = |t: &Thing| t.replica().is_some() && self.base(&noun.head).contains(t);
        match self.definite(noun) {
            Err(Doubt::Ambiguous { candidates, .. })
                if candidates.len() <= MOST && candidates.iter().all(own) && noun.means_one() =>
            {
                Ok(candidates)
            }
            other => other,
        }
    }

    /// «Пульт на комоде?» where it is in it; "Is there a playground here?" where the robot's room has none and another has.
    pub(super) fn existing_instead(&self, noun: &Noun) -> Option<String> {
        let [place] = &noun.restrictions[..] else { return None };
        let here = self.area_of(Thing::Robot).map(|area| Thing::Entity(Entity::Area(area)));
        let is_here = here.is_some_and(|here| self.anchor_things(noun) == [here])
            && matches!(place.rel, Rel::In | Rel::On)
            && !(place.negated || noun.head.anything || noun.other || noun.denies());
        let within = Restriction { rel: Rel::In, ..place.clone() };
        let others = [(place.rel == Rel::On, vec![within]), (is_here, Vec::new())];
        others.into_iter().filter(|(is_meant, _)| *is_meant).find_map(|(_, restrictions)| {
            let noun = Noun { restrictions, ..noun.clone() };
            let found = self.find(&noun, true).ok().filter(|found| !found.is_empty())?;
            Some(self.existing(&noun, &found))
        })
    }

    /// «на Столе-1 в Комнате-В»
    pub(in crate::question) fn short_place(&self, thing: Thing, facts: &mut Vec<Fact>) -> String {
        if let Some(holder) = thing.replica().and_then(|id| self.senses.holder(id)) {
            let hand = self.in_hand(&holder);
            let carrier = thing.replica().and_then(|id| self.senses.carrier(id));
            let Some(carrier) = carrier.map(|id| Thing::Entity(Entity::Replica(id))) else {
                return hand;
            };
            return format!("{} {hand}", self.place(self.on_or_in(thing, carrier), &[carrier]));
        }
        if let Thing::Entity(Entity::Area(id)) = thing {
            return self.storeys_of(id);
        }
        let mut parts: Vec<String> = Vec::new();
        if let Some(id) = thing.replica()
            && let Some(support) = self.relations.support_of(id)
        {
            let support = Thing::Entity(Entity::Replica(support));
            let rel = self.on_or_in(thing, support);
            parts.push(self.place(rel, &[support]));
            facts.extend(self.fact(rel, thing, support));
        }
        // A picture on its wall, a ball on the floor; that furniture stands there goes without saying.
        parts.extend(match self.held_by_room(thing) {
            Some(Held::OnWall) => Some(self.pick("на стене", "on the wall").to_owned()),
            Some(_) if self.is_portable(thing) => {
                Some(self.pick("на полу", "on the floor").to_owned())
            }
            _ => None,
        });
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

    /// Whether a thing lies in or on what bears it. What sinks into a sofa lies on it all the same.
    pub(in crate::question) fn on_or_in(&self, thing: Thing, support: Thing) -> Rel {
        let holds = |rel: Rel| self.tuple(rel, thing, support).map(|(relation, _, _)| relation);
        let carried = thing.replica().is_some_and(|id| self.senses.holder(id).is_some());
        let has = |wanted| support.replica().is_some_and(|id| self.world.has_trait(id, wanted));
        let upon =
            !has("container") && (holds(Rel::On) == Some("ON_TOP_OF") || has("seat") || has("bed"));
        // What is carried stands in no facts any more.
        let within = holds(Rel::In).is_some() || (carried && has("container"));
        if within && !upon { Rel::In } else { Rel::On }
    }

    /// «на L1 и L2»: the storey of a room, the storeys of a lift.
    fn storeys_of(&self, area: AreaId) -> String {
        let lifts = self.world.domain.lifts.iter().map(|(_, stops)| stops);
        let lift = lifts.into_iter().find(|stops| stops.iter().any(|s| s.area == area));
        let stops = lift.map(|stops| stops.iter().map(|s| s.area).collect());
        let stops: Vec<AreaId> = stops.unwrap_or_else(|| vec![area]);
        let maps = stops.into_iter().filter_map(|stop| self.world.placement(stop));
        let maps: Vec<Thing> = maps.map(|(map, _)| Thing::Entity(Entity::Map(map))).collect();
        match maps.is_empty() {
            true => self.pick("неизвестно где", "at an unknown place").to_owned(),
            false => self.place(Rel::In, &maps),
        }
    }

    /// «у меня в руках», «у Оператора»
    fn in_hand(&self, holder: &str) -> String {
        if holder.is_empty() {
            return self.pick("у меня в руках", "in my hands").to_owned();
        }
        let holder = Named::plain(holder);
        match self.is_russian() {
            true => russian::with(russian::Preposition::U, Case::Genitive, holder.phrase()),
            false => format!("with {}", holder.english()),
        }
    }

    pub(super) fn where_one(&self, thing: Thing, facts: &mut Vec<Fact>) -> String {
        let name = self.name(thing);
        match thing {
            Thing::Entity(Entity::Area(id)) => self.where_area(id),
            Thing::Entity(Entity::Door(_)) | Thing::Opening(_) => self.where_gate(thing),
            Thing::Entity(Entity::Map(_)) => {
                let domain = &self.world.domain;
                match self.is_russian() {
                    true => format!("{name} – этаж здания «{}»", domain.name),
                    false => {
                        let title =
                            if domain.name_en.is_empty() { &domain.name } else { &domain.name_en };
                        format!("{name} is a floor of \"{title}\"")
                    }
                }
            }
            Thing::Robot => self.senses.position(self.language, Detail::Spot).unwrap_or_default(),
            _ => {
                let place = self.short_place(thing, facts);
                let near = self.beside(thing, facts);
                format!("{name} {} {place}{near}", self.is(&[thing]))
            }
        }
    }

    fn is_portable(&self, thing: Thing) -> bool {
        thing.replica().is_some_and(|id| self.world.has_trait(id, "portable"))
    }

    /// «, в 12 см перед Письменным столом»: where a thing stands on the floor, told by what is nearest.
    pub(super) fn beside(&self, thing: Thing, facts: &mut Vec<Fact>) -> String {
        let Some(id) = thing.replica() else { return String::new() };
        let russian = self.is_russian();
        let over = self.related_of(Rel::Under, thing);
        if self.relations.support_of(id).is_some() {
            return String::new();
        }
        let held = self.held_by_room(thing);
        if held == Some(Held::OnWall) {
            return String::new();
        }
        if let Some(&above) = over
            .iter()
            .find(|t| self.tuple(Rel::Under, thing, **t).is_some_and(|(r, _, _)| r == "UNDER"))
        {
            facts.extend(self.fact(Rel::Under, thing, above));
            return format!(", {}", self.place(Rel::Under, &[above]));
        }
        // By what is no smaller: nobody tells of a table that it is before a chair.
        let base = |t: Thing| self.relations.extent(t.replica()?).map(|extent| extent.base);
        let mut near: Vec<(f64, Thing)> = self
            .related(Rel::NextTo, thing)
            .into_iter()
            .filter(|t| {
                !self.is_portable(*t) && base(*t).zip(base(thing)).is_some_and(|(a, b)| a >= b)
            })
            .filter_map(|t| Some((self.distance(thing, t)?, t)))
            .collect();
        near.order_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        let Some(&(distance, anchor)) = near.first() else {
            return match held.filter(|_| self.is_portable(thing)) {
                Some(Held::InCorner) => self.pick(", в углу", ", in the corner").to_owned(),
                Some(Held::AtWall) => self.pick(", у стены", ", by the wall").to_owned(),
                _ => String::new(),
            };
        };
        facts.extend(self.fact(Rel::NextTo, thing, anchor));
        let side = [Rel::LeftOf, Rel::RightOf, Rel::InFrontOf, Rel::Behind]
            .into_iter()
            .find(|rel| self.tuple(*rel, thing, anchor).is_some());
        if let Some(side) = side {
            facts.extend(self.fact(side, thing, anchor));
        }
        let place = self.place(side.unwrap_or(Rel::NextTo), &[anchor]);
        let is_apart = distance >= self.relations.thresholds().touch_gap;
        let exact = match (is_apart, russian) {
            (true, true) => format!("в {} ", length(distance, self.language)),
            (true, false) => format!("{} ", length(distance, self.language)),
            (false, true) if side.is_some() => "вплотную ".to_owned(),
            _ => String::new(),
        };
        let frame = side.filter(|s| matches!(s, Rel::LeftOf | Rel::RightOf));
        let frame = frame.map(|s| self.frame_words(s, anchor)).unwrap_or_default();
        match (side.is_some(), is_apart, russian) {
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
                found.order();
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

    fn where_area(&self, id: AreaId) -> String {
        let thing = Thing::Entity(Entity::Area(id));
        let name = self.name(thing);
        let gates = self.openings().iter().filter(|g| g.areas.contains(&id)).map(|g| g.thing);
        let gates: Vec<Thing> = gates.collect();
        let groups =
            self.by_destination(&gates, thing).into_iter().filter(|(to, _)| !to.is_empty());
        let next: Vec<String> = groups
            .map(|(to, through)| format!("{} ({})", self.place(Rel::To, &to), self.list(&through)))
            .collect();
        let mut text = format!("{name} {} {}", self.is(&[thing]), self.storeys_of(id));
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
        let Some(gate) = self.opening(thing) else {
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
                    "{name} {} {} и ведёт наружу",
                    self.find_is(thing),
                    self.place(Rel::In, &[*only])
                )
            }
            ([only], false) => {
                format!("{name} is {} and leads outside", self.place(Rel::In, &[*only]))
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

    pub(super) fn room_of(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let mut found = self.few(noun)?;
        // "Which room is it in?" of a thing and a room that were named asks of the thing.
        if found.iter().any(|thing| thing.area().is_none()) {
            found.retain(|thing| thing.area().is_none());
        }
        if let Some(stops) = self.stops_of_lifts(noun, found.clone()) {
            return Ok(stops);
        }
        let mut rooms: Vec<Thing> = Vec::new();
        let mut parts: Vec<String> = Vec::new();
        let mut placed: Vec<Thing> = Vec::new();
        let mut facts = Vec::new();
        let several = self.world.maps.len() > 1;
        for &thing in &found {
            let areas: Vec<Thing> = match self.opening(thing) {
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
            if self.opening(thing).is_none() && thing.area().is_none() {
                placed.push(thing);
                rooms.extend(Some(first).filter(|room| !rooms.contains(room)));
                continue;
            }
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
        for (room, things) in grouped(&placed, |thing| self.area_of(thing)) {
            let Some(room) = room else { continue };
            let place = self.place(Rel::In, &[Thing::Entity(Entity::Area(room))]);
            let storey = self.world.placement(room).filter(|_| several);
            let storey = storey.map(|(map, _)| self.name(Thing::Entity(Entity::Map(map))));
            let storey = storey.map(|name| format!(" ({name})")).unwrap_or_default();
            parts.push(format!("{} {} {place}{storey}", self.list(&things), self.is(&things)));
        }
        let text = parts.join("; ");
        let said = if rooms.is_empty() { Said::Unknown } else { Said::Found };
        Ok(Draft { facts, ..Draft::new(said, text).with(rooms) }.about(&found))
    }

    /// What a thing stands on, lies in, is beside: the other end of a relation.
    pub(super) fn anchor(&self, rel: Rel, of: &Noun, what: Option<&Noun>) -> Result<Draft, Doubt> {
        // «На каких стульях лежат вещи?»: those that are not empty.
        if let (Some(what), Some(taken)) = (what, self.lexicon().values.meaning("занятый"))
            && matches!(rel, Rel::On | Rel::In)
            && self.is_anything(&of.head)
            && of.restrictions.is_empty()
            && of.filters.is_empty()
        {
            let mut bearing = Noun { plural: true, indefinite: true, ..what.clone() };
            bearing.filters.push(Filter::new(taken, false));
            return self.say_found(&bearing);
        }
        // «На каком столе ваза?»: of several vases, each by itself.
        const EACH: usize = 6;
        let all = match self.definite(of) {
            Err(Doubt::Ambiguous { candidates, .. })
                if matches!(rel, Rel::On | Rel::In)
                    && candidates.len() <= EACH
                    && !of.counts_several() =>
            {
                candidates
            }
            found => found?,
        };
        if let (Rel::NextTo | Rel::Near | Rel::At | Rel::Leaning, Some(walls)) = (rel, what)
            && self.is_walls(walls)
        {
            return Ok(self.say_walls(&all));
        }
        let mut drafts: Vec<Draft> = Vec::new();
        for &thing in &all {
            drafts.push(self.anchor_of(rel, thing, what)?);
        }
        if all.len() > 1 {
            drafts.retain(|draft| draft.said == Some(Said::Found));
            if drafts.is_empty() {
                let plain = self.say_where(of)?;
                return Ok(Draft { said: Some(Said::Nothing), ..plain });
            }
        }
        let mut drafts = drafts.into_iter();
        let Some(mut whole) = drafts.next() else { return Err(self.none_such(of)) };
        for draft in drafts {
            whole.text = format!("{}; {}", whole.text, draft.text);
            whole.facts.extend(draft.facts);
            whole.topic.extend(draft.topic);
            whole.things.extend(draft.things);
        }
        whole.things.order();
        whole.things.dedup();
        Ok(whole)
    }

    fn anchor_of(&self, rel: Rel, thing: Thing, what: Option<&Noun>) -> Result<Draft, Doubt> {
        if let (Rel::On | Rel::In, Some(part)) = (rel, what.filter(|w| self.has_part_kinds(w)))
            && let Some(level) = self.level_under(thing, part)
        {
            let place = self.place_on(&level, part, rel);
            let text = format!("{} {} {place}", self.name(thing), self.is(&[thing]));
            let facts = self.fact(rel, thing, level.owner).into_iter().collect();
            return Ok(Draft { facts, ..Draft::new(Said::Found, text).with(vec![level.owner]) }
                .about(&[thing]));
        }
        let mut found = match rel {
            Rel::On => self.borne_by(thing),
            Rel::In if what.is_some_and(|w| self.is_of_storeys(w)) => {
                let area = self.area_of(thing);
                let map = area.and_then(|a| self.world.placement(a)).map(|(m, _)| m);
                map.map(|m| Thing::Entity(Entity::Map(m))).into_iter().collect()
            }
            // «В какой спальне компьютер?» passes over the desk under which it stands.
            Rel::In if what.is_some_and(|w| !w.head.kinds.is_empty()) => {
                self.related(Rel::Has, thing)
            }
            Rel::In => self.holder(thing),
            Rel::Between => self.ends_around(thing),
            Rel::Opens => self.opened_by(thing).into_iter().collect(),
            Rel::From | Rel::Of | Rel::To => self.related(Rel::Near, thing),
            rel => self.related_of(rel, thing),
        };
        let unborne = rel == Rel::On && found.is_empty();
        let floor = unborne && self.stands_so("STANDS_ON_FLOOR", thing);
        let hangs = unborne && self.stands_so("ON_WALL", thing);
        if let Some(what) = what.filter(|w| !w.head.kinds.is_empty() && !self.is_floor(w)) {
            // «В какой спальне …?», where one of the bedrooms is called «Спальня»: in which of all.
            let head = Head { named: Vec::new(), ..what.head.clone() };
            let any = Noun { head, plural: true, indefinite: true, ..what.clone() };
            let kinds = self.find(&any, true)?;
            found.retain(|t| kinds.contains(t));
        }
        // Of a tray and the table under it, what it lies on itself.
        if rel == Rel::On {
            found.truncate(1);
        }
        let facts: Vec<Fact> = found.iter().filter_map(|y| self.fact(rel, thing, *y)).collect();
        if thing == Thing::Robot && !found.is_empty() {
            let place = self.place(rel, &found);
            let text = match self.is_russian() {
                true => format!("я нахожусь {place}"),
                false => format!("I am {place}"),
            };
            return Ok(Draft::new(Said::Found, text).with(found));
        }
        let name = self.name(thing);
        let verb = self.is(&[thing]);
        if rel == Rel::Opens {
            let text = match (found.first(), self.is_russian()) {
                (Some(door), true) => {
                    format!("{name} – от {}", self.form(*door, Case::Genitive))
                }
                (Some(door), false) => format!("{name} opens {}", self.name(*door)),
                (None, true) => format!("на карте не указано, от какой двери {name}"),
                (None, false) => format!("the map does not say what {name} opens"),
            };
            let said = if found.is_empty() { Said::Unknown } else { Said::Found };
            return Ok(Draft::new(said, text).with(found).about(&[thing]));
        }
        if found.is_empty() && hangs {
            let mut facts = Vec::new();
            let text = self.where_one(thing, &mut facts);
            return Ok(Draft { facts, ..Draft::new(Said::Found, text) }.about(&[thing]));
        }
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
                    format!("{}: {}", self.nothing_so(rel), self.where_one(thing, &mut Vec::new()))
                }
                (false, false) => {
                    format!(
                        "there is nothing that it is {}: {}",
                        self.place(rel, &[Thing::Robot]).replace(" me", ""),
                        self.where_one(thing, &mut Vec::new())
                    )
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

    /// «Диван-1 находится у стены, в которой Окно-1»: walls have no names of their own.
    fn say_walls(&self, things: &[Thing]) -> Draft {
        let tell = |&thing: &Thing| {
            let (name, verb) = (self.name(thing), self.is(&[thing]));
            match (self.own_walls(thing), self.is_russian()) {
                (None, true) => format!("{name} {verb} не у стены"),
                (None, false) => format!("{name} {verb} not at a wall"),
                (Some(openings), true) if openings.is_empty() => {
                    format!("{name} {verb} у глухой стены: в ней нет ни окон, ни дверей")
                }
                (Some(openings), false) if openings.is_empty() => {
                    format!("{name} {verb} at a wall without windows or doors")
                }
                (Some(openings), true) => {
                    let has = self.names(&openings, Case::Nominative);
                    format!("{name} {verb} у стены, в которой {has}")
                }
                (Some(openings), false) => {
                    format!("{name} {verb} at the wall with {}", self.list(&openings))
                }
            }
        };
        let parts: Vec<String> = things.iter().map(tell).collect();
        Draft::new(Said::Found, parts.join("; ")).with(things.to_vec())
    }

    /// «ни за чем»: of a thing that stands so to nothing.
    fn nothing_so(&self, rel: Rel) -> &'static str {
        match rel {
            Rel::In => "ни в чём",
            Rel::On => "ни на чём",
            Rel::Under => "ни под чем",
            Rel::Above => "ни над чем",
            Rel::Behind => "ни за чем",
            Rel::InFrontOf => "ни перед чем",
            Rel::Between => "ни между чем",
            Rel::NextTo | Rel::Near | Rel::At => "рядом ничего нет",
            Rel::LeftOf => "ни слева от чего",
            Rel::RightOf => "ни справа от чего",
            Rel::Leaning => "ни к чему не прислонено",
            _ => "такого на карте нет",
        }
    }

    fn is_of_storeys(&self, noun: &Noun) -> bool {
        let storeys = crate::question::lexicon::Extension::Storeys;
        noun.head.kinds.iter().any(|k| self.lexicon().kind(*k).extension == storeys)
    }

    /// The two nearest things between which a thing stands.
    fn ends_around(&self, thing: Thing) -> Vec<Thing> {
        let Some(id) = thing.replica() else { return Vec::new() };
        let mut near: Vec<(f64, Thing)> = self
            .related(Rel::Near, thing)
            .into_iter()
            .filter(|t| t.replica().is_some_and(|r| !self.world.has_trait(r, "portable")))
            .filter_map(|t| Some((self.distance(thing, t)?, t)))
            .collect();
        near.order_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        near.truncate(12);
        for (n, (_, b)) in near.iter().enumerate() {
            for (_, a) in &near[..n] {
                let (Some(x), Some(y)) = (a.replica(), b.replica()) else { continue };
                if self.relations.standing_between(&self.around(), x, y).contains(&id) {
                    return vec![*a, *b];
                }
            }
        }
        Vec::new()
    }

    /// The nearest thing that holds another, else its room.
    fn holder(&self, thing: Thing) -> Vec<Thing> {
        let all = self.related(Rel::Has, thing);
        let things: Vec<Thing> = all.iter().copied().filter(|t| t.replica().is_some()).collect();
        if things.is_empty() { all } else { things }
    }
}
