//! Where "there" is, and "this room": every place that was told, else the latest one that was spoken of.
//!
//! Invariant: a door is no place, and what stands on the floor is not where small things lie, but in the rooms of these.

use std::collections::BTreeSet;

use super::Doubt;
use super::focus::is_one;
use super::knowledge::Knowledge;
use super::memory::Exchange;
use super::query::{Claim, Noun, Query, Rel, Restriction, Thing};
use crate::map::{Entity, stands};
use crate::sets::set;
use crate::words::word_keys;

impl Knowledge<'_> {
    /// What "there" means: where each of several things is that were asked after, else the latest place.
    pub(super) fn places_spoken_of(&self) -> Vec<Thing> {
        // «Где вилки? Сколько там ложек? А сколько ножей там?»: there as before.
        let mut there = Vec::new();
        if let Some(mut query) = self.memory.query.clone() {
            query.each_noun(&mut |noun| {
                let places = noun.restrictions.iter().filter(|place| place.rel == Rel::There);
                let things = places.flat_map(|place| &place.anchors);
                there.extend(things.filter_map(|anchor| anchor.head.things.clone()).flatten());
            });
        }
        if !there.is_empty() && self.memory.told_place.is_none() {
            return there;
        }
        let last = &self.memory.last;
        let each = last.len() > 1 && self.memory.told_place.is_none() && self.asked_where();
        let places: BTreeSet<Thing> = match each {
            true => last.iter().filter_map(|thing| self.place_of(*thing)).collect(),
            false => self.place_spoken_of().into_iter().collect(),
        };
        places.into_iter().collect()
    }

    /// Whether the last question was where something is.
    pub(super) fn asked_where(&self) -> bool {
        matches!(self.memory.query, Some(Query::Where(_)))
    }

    /// Whether the last question was what is beside something.
    pub(super) fn asked_beside(&self) -> bool {
        matches!(&self.memory.query, Some(Query::Find(noun))
            if noun.restrictions.iter().any(|place| place.rel.is_side()))
    }

    /// What bears or holds a thing, else its room.
    fn place_of(&self, thing: Thing) -> Option<Thing> {
        let support = thing.replica().and_then(|id| self.relations.support_of(id));
        let support = support.map(|id| Thing::Entity(Entity::Replica(id)));
        support.or_else(|| self.area_of(thing).map(|id| Thing::Entity(Entity::Area(id))))
    }

    /// «Где тостер? Отнеси туда яблоко»: whither something is taken "there"; what bears nothing stands where it stands.
    pub(super) fn bearer_there(&self, thing: Thing) -> Thing {
        let bears = self.opening(thing).is_some()
            || [Rel::On, Rel::In].iter().any(|rel| self.may_be_anchor(*rel, thing));
        self.place_of(thing).filter(|_| !bears).unwrap_or(thing)
    }

    /// Whether what goes "there" goes into what may hold things, or onto it: as what was spoken of lies to it, and as was
    /// asked. None of what holds nothing.
    ///
    /// # Errors
    /// Both may be meant.
    pub(super) fn in_or_on_there(&self, place: Thing) -> Result<Option<Rel>, Doubt> {
        let has = |wanted| place.replica().is_some_and(|id| self.world.has_trait(id, wanted));
        if !has("container") {
            return Ok(None);
        }
        let lying = self.memory.last.iter().filter(|thing| self.place_of(**thing) == Some(place));
        let mut said: Vec<Rel> = lying.map(|thing| self.on_or_in(*thing, place)).collect();
        // What was asked before an order is no longer spoken of.
        if self.memory.told_place.is_none()
            && let Some(mut query) = self.memory.query.clone()
        {
            let tells = |told: &&Restriction| {
                let is_it = |anchor| self.find(anchor, true).is_ok_and(|found| found == [place]);
                matches!(told.rel, Rel::In | Rel::On) && told.anchors.iter().any(is_it)
            };
            if let Query::Holds { claims, .. } | Query::Choice { claims, .. } = &query {
                let claimed = claims.iter().filter_map(|claim| match claim {
                    Claim::Related(told) => Some(told),
                    _ => None,
                });
                said.extend(claimed.filter(tells).map(|told| told.rel));
            }
            query.each_noun(&mut |noun| {
                said.extend(noun.restrictions.iter().filter(tells).map(|told| told.rel));
            });
        }
        let bears = ["support", "seat", "bed"].into_iter().any(has);
        // Where a mug is, is not in it.
        let carried = has("portable") && self.asked_where();
        match said.first() {
            Some(rel) if said.iter().all(|other| other == rel) => Ok(Some(*rel)),
            None if !bears && !carried => Ok(Some(Rel::In)),
            _ => Err(Doubt::InOrOn { place }),
        }
    }

    /// Whether a thing is there to hold others behind its doors, and not to bear any.
    pub(super) fn shuts_things_in(&self, thing: Thing) -> bool {
        let Some(id) = thing.replica() else { return false };
        let has = |wanted: &&str| self.world.has_trait(id, wanted);
        let has_doors =
            self.world.replicas.get(&id).is_some_and(|it| stands(self.world, it).is_some());
        has(&"container") && has_doors && !["support", "seat", "bed", "portable"].iter().any(has)
    }

    /// The latest place that was spoken of: a room or what bears things; else where the latest thing is.
    fn place_spoken_of(&self) -> Option<Thing> {
        // "I put the bottle in the bathroom, is it there?"
        if self.memory.told_place.is_some() {
            return self.memory.told_place;
        }
        // "Is there a door from the kitchen to the corridor? How do I get there then?": to what was named last.
        let between = self
            .memory
            .query
            .as_ref()
            .and_then(Query::sought)
            .and_then(|noun| noun.restrictions.iter().find(|place| place.rel == Rel::Between));
        if let Some(ends) = between.and_then(|between| self.ends_between(between).ok())
            && let Some(room) = ends.last().filter(|end| end.area().is_some())
        {
            return Some(*room);
        }
        let opens = |thing: &Thing| self.opening(*thing).is_some();
        let bears = |thing: Thing| {
            !opens(&thing)
                && thing.replica().is_none_or(|id| {
                    ["support", "container"].iter().any(|wanted| self.world.has_trait(id, wanted))
                })
        };
        // "Which floor is the storeroom on? What is in there?": in the storeroom.
        let asked = matches!(self.memory.query, Some(Query::RoomOf(_)));
        let topic = || self.memory.exchanges.first().and_then(Exchange::topic);
        if let Some(room) = asked.then(topic).flatten().filter(|t| t.area().is_some()) {
            return Some(room);
        }
        // «Что рядом с ней? Сколько там фруктов?»: where it is, not in it.
        if self.asked_beside()
            && let Some(beside) = topic().filter(|thing| thing.replica().is_some())
        {
            return self.place_of(beside);
        }
        // «Что на кухне?» lists things there; the kitchen is the place.
        let latest = self.memory.exchanges.first().filter(|e| !e.members().is_empty());
        let places = |e: &Exchange| e.topics().iter().chain(e.aside()).copied().find(|t| bears(*t));
        if let Some(place) = latest.and_then(places) {
            return Some(place);
        }
        // «Что горит в спальне? – Лампа-1. – А какие ещё светильники там горят?»: in the bedroom, where one was told as well.
        let told = |place: &Thing| {
            self.memory.exchanges.first().is_some_and(|e| e.topics().contains(place))
        };
        if let Some(room) = self.place_asked_of().filter(|p| p.area().is_some() && told(p)) {
            return Some(room);
        }
        let latest = *self.memory.spoken.iter().find(|thing| !opens(thing))?;
        // Of several that were named, "there" is where they all are, or nowhere.
        let together = self.memory.exchanges.first().map_or(&[][..], Exchange::members);
        if together.len() > 1 && together.contains(&latest) {
            let places: BTreeSet<Option<Thing>> =
                together.iter().map(|thing| self.place_of(*thing)).collect();
            return places.first().copied().flatten().filter(|_| places.len() == 1);
        }
        // «Где кружка и что ещё там лежит?»: where the cup is, not in it.
        let placed = matches!(self.memory.query, Some(Query::Where(_) | Query::RoomOf(_)));
        let told = placed && self.memory.last.contains(&latest) || !bears(latest);
        let Some(id) = latest.replica().filter(|_| told) else { return Some(latest) };
        // «Возьми книгу. Сколько их там?»: nothing is in what is carried itself.
        self.place_of(Thing::Entity(Entity::Replica(id))).or(Some(latest).filter(|_| bears(latest)))
    }

    /// «Где тарелки? Сколько там стульев?», «Что на кровати? Сколько там картин?»: what stands on the floor or hangs on walls is
    /// not where they lie, but in the rooms of that.
    pub(super) fn rooms_there(&self, noun: &mut Noun) {
        let sought = self.base(&noun.head);
        let carried = |t: &Thing| t.replica().is_none_or(|id| self.world.has_trait(id, "portable"));
        let there = noun.restrictions.iter_mut().filter(|place| place.rel == Rel::There);
        for anchor in there.flat_map(|place| &mut place.anchors) {
            let Some(places) = anchor.head.things.as_deref() else { continue };
            let lies = |place: &Thing| self.related(Rel::There, *place);
            let fits = places.iter().flat_map(lies).any(|thing| sought.contains(&thing));
            // «А на кухне? – Ваза-1. – Сколько их там?»: no vase is in itself.
            let itself = places.iter().all(|place| sought.contains(place));
            if itself && let Some(place) = self.place_asked_of() {
                anchor.head.things = Some(vec![place]);
                continue;
            }
            if fits || sought.is_empty() || !itself && sought.iter().any(carried) {
                continue;
            }
            let rooms: BTreeSet<Thing> = places
                .iter()
                .map(|place| match self.area_of(*place) {
                    Some(room) => Thing::Entity(Entity::Area(room)),
                    None => *place,
                })
                .collect();
            anchor.head.things = Some(rooms.into_iter().collect());
        }
    }

    /// "How many chairs are in the room next to the kitchen?": the room is beside it, and not the chairs.
    pub(super) fn room_beside_room(&self, noun: &mut Noun) {
        let are_rooms = |anchor: &Noun| {
            let base = self.base(&anchor.head);
            !base.is_empty() && base.iter().all(|thing| thing.area().is_some())
        };
        let [place, beside] = &mut noun.restrictions[..] else { return };
        let told = |r: &Restriction| !r.negated && r.anchors.iter().all(are_rooms);
        let any = |anchor: &Noun| is_one(anchor) && anchor.head.named.is_empty();
        if let [room] = &mut place.anchors[..]
            && any(room)
            && are_rooms(room)
            && matches!(place.rel, Rel::In | Rel::On)
            && matches!(beside.rel, Rel::NextTo | Rel::Near)
            && told(beside)
        {
            room.restrictions.push(beside.clone());
            noun.restrictions.pop();
        }
    }

    /// "How many pillows are on the bed there?": the bed that is there.
    pub(super) fn places_there_alone(&self, noun: &mut Noun) {
        let there = noun.restrictions.iter().filter(|place| place.rel == Rel::There);
        let there: Vec<Thing> = there
            .flat_map(|place| &place.anchors)
            .flat_map(|anchor| anchor.head.things.iter().flatten().copied())
            .collect();
        let places = noun.restrictions.iter_mut().filter(|place| place.rel != Rel::There);
        for anchor in places.flat_map(|place| &mut place.anchors).filter(|anchor| is_one(anchor)) {
            let found = self.find(anchor, false).unwrap_or_default();
            let within = |thing: &&Thing| {
                let is_in = |place: &Thing| self.related(Rel::There, *place).contains(*thing);
                there.iter().any(is_in)
            };
            let mut within = found.iter().filter(within);
            if let (true, Some(only), None) = (found.len() > 1, within.next(), within.next()) {
                let text = std::mem::take(&mut anchor.text);
                *anchor = Noun { text, ..Noun::of(vec![*only]) };
            }
        }
    }

    /// The one place in which the last question sought something.
    fn place_asked_of(&self) -> Option<Thing> {
        let sought = self.memory.query.as_ref()?.sought()?;
        let [place] = &sought.restrictions[..] else { return None };
        let [anchor] = &place.anchors[..] else { return None };
        match self.find(anchor, true).ok()?[..] {
            [only] if matches!(place.rel, Rel::In | Rel::On) && !place.negated => Some(only),
            _ => None,
        }
    }

    /// «Что на столе? – Коврик, тарелка и чашка. – Положи туда яблоко»: on the table, whatever of these may bear it.
    pub(super) fn place_of_list(&self) -> Option<Thing> {
        let sought =
            self.memory.query.as_ref()?.sought().filter(|noun| self.is_anything(&noun.head));
        let [Restriction { rel: Rel::In | Rel::On, negated: false, .. }] =
            &sought?.restrictions[..]
        else {
            return None;
        };
        let latest = self.memory.exchanges.first()?;
        let bearing: Vec<&Thing> =
            latest.topics().iter().filter(|thing| thing.replica().is_some()).collect();
        match (&bearing[..], latest.topics()) {
            ([place], _) if latest.members().len() > 1 => Some(**place),
            ([], [place, ..]) if latest.members().len() > 1 => Some(*place),
            _ => self.place_asked_of().filter(|place| latest.things().any(|told| told == place)),
        }
    }

    /// "How many things are there?" after an order: where that went, and not in the whole house.
    pub(super) fn things_there(&self, query: &mut Query, text: &str) {
        let (Some(place), Query::Count(noun) | Query::Find(noun)) = (self.memory.told_place, query)
        else {
            return;
        };
        let ends = word_keys(text).last().is_some_and(|key| set!("ThereWord").contains(&&**key));
        let bare = noun.restrictions.is_empty() && noun.filters.is_empty() && noun.best.is_none();
        if ends && bare && self.is_anything(&noun.head) {
            let anchors = vec![Noun::of(vec![place])];
            noun.restrictions.push(Restriction { rel: Rel::There, anchors, negated: false });
        }
    }

    /// In which rooms the things are that were spoken of last.
    pub(super) fn rooms_spoken_of(&self) -> Vec<Thing> {
        let last = self.memory.exchanges.first().into_iter().flat_map(Exchange::things);
        let rooms = last.filter_map(|thing| self.area_of(*thing));
        rooms.map(|room| Thing::Entity(Entity::Area(room))).collect()
    }

    /// "In this room", where no room was spoken of: the robot's.
    pub(super) fn this_room(&self, restrictions: &mut [Restriction]) {
        let Some(own) = self.area_of(Thing::Robot) else { return };
        let own = Thing::Entity(Entity::Area(own));
        for anchor in restrictions.iter_mut().flat_map(|r| &mut r.anchors) {
            let this = word_keys(&anchor.text)
                .first()
                .is_some_and(|word| set!("ThisOne").contains(&word.as_str()));
            if this && is_one(anchor) && self.base(&anchor.head).contains(&own) {
                *anchor = Noun { text: std::mem::take(&mut anchor.text), ..Noun::of(vec![own]) };
            }
        }
    }

    /// Keeps a place of a surface in the room that was spoken of: «Что на полу? А на стенах?»
    pub(super) fn keep_room(&self, query: &mut Query) {
        let (Query::Find(noun) | Query::Count(noun)) = query else {
            if let Query::Exists { what, .. } = query
                && let [noun] = &mut what[..]
            {
                self.keep_room_of(noun);
            }
            return;
        };
        self.keep_room_of(noun);
    }

    fn keep_room_of(&self, noun: &mut Noun) {
        let surface = |a: &Noun| {
            (self.is_floor(a) || self.is_walls(a)) && a.restrictions.is_empty() && !a.all
        };
        let [place] = &noun.restrictions[..] else { return };
        if place.negated || !place.anchors.iter().all(surface) {
            return;
        }
        let Some(last) = &self.memory.query else { return };
        let mut rooms: Vec<Thing> = Vec::new();
        last.clone().each_noun(&mut |noun| {
            for anchor in noun.restrictions.iter().flat_map(|place| &place.anchors) {
                let found = self.find(anchor, true).unwrap_or_default();
                rooms.extend(found.into_iter().filter(|t| t.area().is_some()));
            }
        });
        rooms.dedup();
        if let [room] = rooms[..] {
            let anchors = vec![Noun::of(vec![room])];
            noun.restrictions.push(Restriction { rel: Rel::In, anchors, negated: false });
        }
    }
}
