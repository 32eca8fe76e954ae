//! From a description to the things that fit it: kinds, places, values, superlatives.
//!
//! Invariant: several where one is meant, and none at all, are doubts, never a choice.

use super::Knowledge;
use crate::map::Entity;
use crate::question::Doubt;
use crate::question::grammar::points;
use crate::question::lexicon::Extension;
use crate::question::query::{Best, Extreme, Head, Noun, Reach, Rel, Restriction, Thing};
use crate::units::{AreaId, InOrder as _};
use std::collections::{HashMap, HashSet};

/// To more things than this ways are not looked for at once.
const MOST_DRIVEN: usize = 200;

impl Knowledge<'_> {
    /// What the head alone may mean.
    pub(in crate::question) fn base(&self, head: &Head) -> Vec<Thing> {
        if let Some(things) = &head.things {
            return things.clone();
        }
        if !head.named.is_empty() {
            return head.named.iter().map(|e| Thing::Entity(*e)).collect();
        }
        if head.anything {
            return self.members(&Extension::Things);
        }
        let kinds = head.kinds.iter().map(|kind| self.lexicon().kind(*kind).extension);
        let mut found: Vec<Thing> = kinds.flat_map(|kind| self.members(&kind)).collect();
        if !found.is_sorted() {
            found.order();
        }
        found.dedup();
        found
    }

    /// "Things" in general.
    pub(in crate::question) fn is_anything(&self, head: &Head) -> bool {
        head.anything
            || head.kinds.iter().any(|k| self.lexicon().kind(*k).extension == Extension::Things)
    }

    pub(in crate::question) fn is_floor(&self, noun: &Noun) -> bool {
        let kinds = &noun.head.kinds;
        kinds.iter().any(|k| self.lexicon().kind(*k).extension == Extension::Floor)
            && noun.head.named.is_empty()
    }

    /// Everything that a description fits. `loose` lets an anchor be any of several things.
    ///
    /// # Errors
    /// An anchor that may be several things, or none.
    pub(in crate::question) fn find(&self, noun: &Noun, loose: bool) -> Result<Vec<Thing>, Doubt> {
        // "A bedroom" is any, «спальня с компьютером», «вторая спальня» and "the biggest bedroom" are those that they are said
        // to be.
        let Some(of_kind) = noun.of_kind() else { return self.fitting(noun, loose) };
        if noun.indefinite || noun.rank.is_some() || noun.best.is_some() {
            return self.fitting(&of_kind, loose);
        }
        match self.fitting(noun, loose) {
            Ok(found) if found.is_empty() => self.fitting(&of_kind, loose),
            Err(Doubt::TooFew { .. }) => self.fitting(&of_kind, loose),
            found => found,
        }
    }

    fn fitting(&self, noun: &Noun, loose: bool) -> Result<Vec<Thing>, Doubt> {
        if self.is_walls(noun) {
            // The map has walls, but no list of them: «нет стен» would be untrue.
            return Err(Doubt::NotUnderstood { words: noun.text.clone() });
        }
        // "Got one?": one of what was not said.
        let is_bare = noun.filters.is_empty() && noun.restrictions.is_empty();
        if points(noun) && is_bare && noun.best.is_none() && noun.sizes.is_empty() {
            return Err(Doubt::NoReferent { word: noun.text.clone() });
        }
        let opened = self.is_of_rooms(noun).then(|| self.opening_on_rooms(noun));
        let noun = opened.as_ref().unwrap_or(noun);
        let mut found = self.base(&noun.head);
        // "Is anything made of steel?" asks of doors as well.
        if noun.head.anything && !noun.filters.is_empty() {
            found.extend(self.members(&Extension::Doors));
        }
        let known = match noun.other && !noun.head.anything {
            true => self.in_focus(&found).or_else(|| self.asked_by(&found)),
            false => None,
        };
        // "The other lamp" after an order to one of those that were told is one of those.
        let told = self.of_listed(&found);
        if let Some(known) = known.filter(|known| told.contains(known) && told.len() > 1)
            && !noun.plural
        {
            found = told;
            found.retain(|t| *t != known);
        } else if let Some(known) = known {
            found.retain(|t| *t != known);
        } else if noun.other {
            // What was spoken of long ago is no part of "what else".
            const RECENT: usize = 12;
            let recent = &self.memory.spoken[..self.memory.spoken.len().min(RECENT)];
            let before = found.len();
            found.retain(|t| !recent.contains(t));
            // "The other rooms" after what was spoken of in one of them.
            if found.len() == before && !noun.head.anything {
                let rooms: Vec<Thing> = self.rooms_spoken_of();
                found.retain(|t| !rooms.contains(t));
            }
            // "Where is the other TV?", where each of them was spoken of.
            if found.is_empty() && before > 0 && !noun.head.anything {
                return Err(Doubt::NoReferent { word: noun.text.clone() });
            }
        }
        for sort in &noun.also {
            let own: HashSet<Thing> = self.base(sort).into_iter().collect();
            found.retain(|t| own.contains(t));
        }
        if let Some((extreme, other)) = &noun.beyond {
            let other = self.one(other)?;
            let limit = self.measure(*extreme, other);
            let beyond = |t: Thing| {
                let pair = self.measure(*extreme, t).zip(limit);
                pair.is_some_and(|(own, limit)| match extreme.is_less() {
                    true => own < limit,
                    false => own > limit,
                })
            };
            found.retain(|t| *t != other && beyond(*t));
        }
        if let Some((property, other)) = &noun.like {
            let other = self.one(other)?;
            let own = |t: Thing| self.values(t).into_iter().find(|(p, _, _)| p == property);
            let same = |t: Thing| match (own(t), own(other)) {
                (Some((_, Some(x), _)), Some((_, Some(y), _))) => x == y,
                (Some((_, _, x)), Some((_, _, y))) => x == y,
                _ => false,
            };
            found.retain(|t| *t != other && same(*t));
        }
        for restriction in &noun.restrictions {
            // "And to the kitchen?": only doors and rooms lead anywhere.
            let leads = |t: &Thing| t.area().is_some() || self.opening(*t).is_some();
            if matches!(restriction.rel, Rel::To | Rel::Through)
                && !found.is_empty()
                && !found.iter().any(leads)
            {
                let words = restriction.anchors.first().unwrap_or(noun).text.clone();
                return Err(Doubt::NotUnderstood { words });
            }
            // "exits to the outside of the kitchen": no place tells which doors are meant.
            if restriction.rel == Rel::Outside
                && !found.is_empty()
                && found.iter().all(|t| self.opening(*t).is_some())
            {
                return Err(Doubt::NotUnderstood { words: noun.text.clone() });
            }
            // «А оттуда на улицу?»: nothing lies on a door, in it or under it.
            if matches!(restriction.rel, Rel::On | Rel::In | Rel::Under | Rel::Above)
                && let Some(anchor) = restriction.anchors.first()
                && let base = self.base(&anchor.head)
                && !base.is_empty()
                && base.iter().all(|t| self.opening(*t).is_some())
            {
                return Err(Doubt::NotUnderstood { words: anchor.text.clone() });
            }
            // «щётка с пастой»: what holds and bears nothing has nothing.
            let bears = |t: &Thing| leads(t) || t.is_storey() || self.may_bear(*t);
            if matches!(restriction.rel, Rel::Has | Rel::Bears)
                && !found.is_empty()
                && !found.iter().any(bears)
            {
                let words = restriction.anchors.first().unwrap_or(noun).text.clone();
                return Err(Doubt::NotUnderstood { words });
            }
            // «автоматы с напитками»: what a thing holds that nobody looked into is not told by a map that knows no drinks.
            let holds = |id| self.world.has_trait(id, "container");
            if let (Rel::Has | Rel::Bears, [held], false) =
                (restriction.rel, &restriction.anchors[..], restriction.negated)
                && !found.is_empty()
                && found.iter().all(|t| t.replica().is_some_and(holds))
                && self.base(&held.head).is_empty()
            {
                return Err(self.none_such(held));
            }
            // "Which rooms are on the floor?": on the storey.
            if let ([floor], false) = (&restriction.anchors[..], restriction.negated)
                && self.is_floor(floor)
                && restriction.rel == Rel::On
                && !found.is_empty()
                && found.iter().all(|t| t.area().is_some())
            {
                let maps = self.members(&Extension::Storeys);
                if maps.len() > 1 {
                    return Err(self.ambiguous(floor, &maps));
                }
                continue;
            }
            if let Some(fitting) = self.with_surface(restriction, &found)? {
                found = fitting;
                continue;
            }
            let of_rooms = self.ways_out_had(restriction, &found);
            let restriction = of_rooms.as_ref().unwrap_or(restriction);
            let related = match self.related_to(restriction, loose) {
                Err(doubt) => self.told_together(noun, restriction, &found).ok_or(doubt)?,
                Ok(related) => related,
            };
            // "Which floor has the lamp?"
            let mut related = related;
            if restriction.rel == Rel::Has
                && !found.is_empty()
                && found.iter().all(Thing::is_storey)
            {
                let areas: Vec<AreaId> = related.iter().filter_map(|t| t.area()).collect();
                let maps = areas.into_iter().filter_map(|area| self.world.placement(area));
                related.extend(maps.map(|(map, _)| Thing::Entity(Entity::Map(map))));
            }
            // "What is in the kitchen" asks for things, "what is next to the kitchen" may ask for rooms.
            if noun.head.anything
                && !restriction.negated
                && found.iter().all(|t| !related.contains(t))
            {
                let rooms = related.iter().filter(|t| t.area().is_some()).copied();
                let storeys = related.iter().filter(|t| t.is_storey()).copied();
                if let Rel::NextTo | Rel::Near | Rel::Above | Rel::Under = restriction.rel {
                    let mut told: Vec<Thing> = storeys.collect();
                    if told.is_empty() {
                        told = rooms.collect();
                    }
                    told.order();
                    found = told;
                    continue;
                }
            }
            // "What is between the kitchen and the bedroom?" asks for doors.
            if noun.head.anything && restriction.rel == Rel::Between && !restriction.negated {
                found.extend(related.iter().filter(|t| self.opening(**t).is_some()));
            }
            let before = found.clone();
            // «стулья у стола»: whatever its kind is at furniture that stands no farther than a step.
            let at: Vec<Thing> = match restriction.rel {
                Rel::NextTo if !noun.head.kinds.is_empty() => {
                    self.standing_at(restriction, &found, loose)?
                }
                // «Что стоит рядом со столом?»: chairs too that are pushed under it.
                Rel::NextTo if noun.head.anything && self.is_at_a_table(restriction) => {
                    let seat =
                        |t: &Thing| t.replica().is_some_and(|id| self.world.has_trait(id, "seat"));
                    let seats: Vec<Thing> = found.iter().copied().filter(seat).collect();
                    self.standing_at(restriction, &seats, loose)?
                }
                _ => Vec::new(),
            };
            found.retain(|t| (related.contains(t) || at.contains(t)) != restriction.negated);
            // «стул у стола»: where none is right beside it, the one near it is meant.
            if found.is_empty()
                && restriction.rel == Rel::NextTo
                && !restriction.negated
                && !noun.head.kinds.is_empty()
                && !noun.plural
            {
                let near = Restriction { rel: Rel::Near, ..restriction.clone() };
                let related = self.related_to(&near, loose)?;
                found = before.into_iter().filter(|t| related.contains(t)).collect();
            }
        }
        for filter in &noun.filters {
            found.retain(|t| self.fits(*t, filter));
        }
        for size in &noun.sizes {
            let fits = |t: &Thing| self.measure(size.extreme, *t).is_some_and(|m| size.admits(m));
            found.retain(fits);
        }
        if let Some(reach) = &noun.reached {
            self.retain_reached(&mut found, reach)?;
        }
        for except in &noun.except {
            let without = self.find(except, true)?;
            found.retain(|t| !without.contains(t));
        }
        // "What is farthest from the toilet?" asks of its room, where no kind is named.
        if let Some(Best { extreme: Extreme::Farthest, anchor: Some(anchor) }) = &noun.best
            && noun.head.anything
            && let Ok([anchor]) = self.find(anchor, loose).as_deref()
        {
            found = self.this_side(found, *anchor, 1);
        }
        match (&noun.best, noun.rank) {
            (Some(best), rank) => {
                let places = (rank.unwrap_or(1), noun.count.unwrap_or(1));
                self.best(best, found, self.is_anything(&noun.head), places, loose)
            }
            (None, Some(rank)) if !found.is_empty() && found.iter().all(Thing::is_storey) => {
                Ok(self.storey(found, rank))
            }
            // «вторая чашка» of several that were just told.
            (None, Some(rank)) if self.of_listed(&found).len() > 1 => {
                let at = usize::try_from(rank).unwrap_or(usize::MAX).saturating_sub(1);
                let listed = self.of_listed(&found);
                let whole = listed == self.memory.listed;
                let meant = || self.memory.numbered(at);
                match whole.then(meant).filter(|meant| meant.len() > 1) {
                    Some(several) => Err(self.ambiguous(noun, &several)),
                    None if whole => Ok(meant()),
                    None => Ok(listed.get(at).copied().into_iter().collect()),
                }
            }
            // «А вторая ваза?» of two, one of which was spoken of.
            (None, Some(2)) if found.len() == 2 && self.in_focus(&found).is_some() => {
                let known = self.in_focus(&found);
                Ok(found.into_iter().filter(|t| Some(*t) != known).collect())
            }
            // «вторая спальня»: the one that the map calls «Спальня-2».
            (None, Some(rank)) if self.room_called(&found, rank).is_some() => {
                Ok(self.room_called(&found, rank).into_iter().collect())
            }
            // «второй стул»: nothing says in which order.
            (None, Some(rank)) => Err(match (found.len() as u64) < rank {
                true if !found.is_empty() => Doubt::TooFew { found },
                true => self.none_such(noun),
                false => self.ambiguous(noun, &found),
            }),
            (None, None) => Ok(found),
        }
    }

    /// Of rooms that are called alike but for a number, the one with this number; what has none is the first.
    fn room_called(&self, found: &[Thing], rank: u64) -> Option<Thing> {
        let parted = |thing: &Thing| {
            let name = &self.world.areas[&thing.area()?].name;
            let stem = name.trim_end_matches(|c: char| c.is_ascii_digit());
            let number = name[stem.len()..].parse().unwrap_or(1);
            Some((stem.trim_end_matches(['-', ' ']).to_owned(), number))
        };
        let rooms: Vec<(String, u64)> = found.iter().map(parted).collect::<Option<_>>()?;
        let alike = rooms.len() > 1 && rooms.iter().all(|(stem, _)| *stem == rooms[0].0);
        let mut called = rooms.iter().zip(found).filter(|((_, number), _)| *number == rank);
        match (called.next().filter(|_| alike), called.next()) {
            (Some((_, room)), None) => Some(*room),
            _ => None,
        }
    }

    /// Whether a place is told by a table: what bears things and holds none, and stands on the floor.
    fn is_at_a_table(&self, restriction: &Restriction) -> bool {
        let table = |t: &Thing| {
            t.replica().is_some_and(|id| {
                self.world.has_trait(id, "support")
                    && ["container", "seat", "device"].iter().all(|t| !self.world.has_trait(id, t))
                    && self.relations.support_of(id).is_none()
            })
        };
        restriction.anchors.iter().any(|noun| {
            self.find(noun, true).is_ok_and(|all| !all.is_empty() && all.iter().all(table))
        })
    }

    /// «Стул у окна»: of several windows the one is meant that has a chair, where only one chair is at any. None
    /// where that tells nothing.
    fn told_together(
        &self,
        noun: &Noun,
        restriction: &Restriction,
        found: &[Thing],
    ) -> Option<HashSet<Thing>> {
        let one = !noun.plural && !noun.all && !noun.head.kinds.is_empty();
        if !one || restriction.negated || noun.head.things.is_some() {
            return None;
        }
        let related = self.related_to(restriction, true).ok()?;
        let fitting: Vec<Thing> = found.iter().filter(|t| related.contains(t)).copied().collect();
        // "The box on the side table" is no tissue box there.
        let fitting = self.exactly(noun, &fitting).unwrap_or(fitting);
        (fitting.len() == 1).then_some(related)
    }

    /// Those of some things that stand at the furniture that a restriction names.
    fn standing_at(
        &self,
        restriction: &Restriction,
        found: &[Thing],
        loose: bool,
    ) -> Result<Vec<Thing>, Doubt> {
        let mut at = Vec::new();
        for noun in restriction.anchors.iter().filter(|n| !self.is_walls(n) && !self.is_floor(n)) {
            let Ok(anchors) = self.anchors(restriction, noun, loose) else { continue };
            for anchor in anchors.into_iter().filter(|a| a.replica().is_some()) {
                at.extend(found.iter().copied().filter(|t| self.stands_at(*t, anchor)));
            }
        }
        Ok(at)
    }

    /// The storey of this number, counted from the lowest that is not under the ground.
    fn storey(&self, mut found: Vec<Thing>, rank: u64) -> Vec<Thing> {
        let height = |t: &Thing| match t {
            Thing::Entity(Entity::Map(id)) => {
                let placed = self.world.domain.maps.iter().find(|m| m.map == *id);
                placed.map_or(0.0, |m| m.frame.z.get())
            }
            _ => 0.0,
        };
        // A cellar has no number of its own, unless there is nothing else.
        let ground = -self.relations.thresholds().cellar_depth;
        if found.iter().any(|t| height(t) >= ground) {
            found.retain(|t| height(t) >= ground);
        }
        found.order_by(|a, b| height(a).total_cmp(&height(b)).then(a.cmp(b)));
        let at = usize::try_from(rank.max(1) - 1).unwrap_or(usize::MAX);
        found.get(at).copied().into_iter().collect()
    }

    /// The one thing, or the several where several are spoken of.
    ///
    /// # Errors
    /// Several where one is meant; none at all.
    pub(in crate::question) fn definite(&self, noun: &Noun) -> Result<Vec<Thing>, Doubt> {
        let found = self.find(noun, false)?;
        if found.is_empty() {
            return Err(self.none_such(noun));
        }
        // "Where are the five cups?", of which there are three, or twenty.
        if let (Some(n), None) = (noun.count.filter(|n| *n > 1), &noun.best)
            && !noun.quantity.admits(found.len() as u64, n)
        {
            let many = u64::try_from(found.len()).is_ok_and(|found| found > n);
            return Err(if many { self.ambiguous(noun, &found) } else { Doubt::TooFew { found } });
        }
        // Of equally big windows all are the biggest.
        let equal = noun.best.is_some();
        let several = noun.plural || noun.all || noun.count.is_some() || noun.indefinite || equal;
        if found.len() > 1 && !several && noun.head.things.is_none() {
            return Ok(vec![self.meant(noun, &found)?]);
        }
        Ok(found)
    }

    /// Keeps what there is a way to, or what there is none to.
    fn retain_reached(&self, found: &mut Vec<Thing>, reach: &Reach) -> Result<(), Doubt> {
        // A way is looked for to each.
        if found.len() > MOST_DRIVEN {
            return Err(Doubt::TooMany { many: found.len(), most: MOST_DRIVEN });
        }
        let from = reach.from.as_deref().map_or(Ok(Thing::Robot), |from| self.one(from))?;
        let mut avoided = Vec::new();
        for noun in &reach.avoiding {
            avoided.extend(self.find(noun, false)?);
        }
        let own = self.area_of(from);
        let start = Some(from).filter(|from| *from != Thing::Robot);
        let is_reached = |t: &Thing| match (t.area().is_some() && t.area() == own, &avoided[..]) {
            (true, _) => true,
            (false, []) => self.driven(from, *t).is_some(),
            (false, avoided) => self.senses.way_without(start, *t, avoided, self.language).is_ok(),
        };
        found.retain(|t| !avoided.contains(t) && is_reached(t) == reach.able);
        Ok(())
    }

    /// # Errors
    /// As [`Self::definite`]; several things are always one too many.
    pub(in crate::question) fn one(&self, noun: &Noun) -> Result<Thing, Doubt> {
        let found = self.find(noun, false)?;
        match found[..] {
            [only] => Ok(only),
            [] => Err(self.none_such(noun)),
            _ => self.meant(noun, &found),
        }
    }

    pub(in crate::question) fn ambiguous(&self, noun: &Noun, found: &[Thing]) -> Doubt {
        Doubt::Ambiguous { reference: noun.text.clone(), candidates: found.to_vec() }
    }

    pub(in crate::question) fn none_such(&self, noun: &Noun) -> Doubt {
        Doubt::NoneSuch { noun: Box::new(noun.clone()) }
    }

    /// What lies to some anchor as a restriction says.
    fn related_to(&self, restriction: &Restriction, loose: bool) -> Result<HashSet<Thing>, Doubt> {
        if restriction.rel == Rel::Between {
            return self.between(restriction);
        }
        let Some(noun) = restriction.anchors.first() else { return Ok(HashSet::new()) };
        if self.is_floor(noun) {
            let on_floor = self.on_floor().iter().map(|id| Thing::Entity(Entity::Replica(*id)));
            let mut found: HashSet<Thing> = on_floor.collect();
            for inner in &noun.restrictions {
                let within = self.related_to(inner, loose)?;
                found.retain(|t| within.contains(t));
            }
            return Ok(found);
        }
        if let Some(found) = self.at_walls(restriction.rel, noun)? {
            return Ok(found);
        }
        if let Some(level) = self.level_of(restriction)? {
            return Ok(self.on_level(&level));
        }
        if let (Rel::ToTheEye(side), [.., faced]) = (restriction.rel, &restriction.anchors[..]) {
            return self.seen_aside(side, noun, faced);
        }
        let mut found = HashSet::new();
        if let (Rel::Has | Rel::Bears, [noun]) = (restriction.rel, &restriction.anchors[..])
            && let Some(asked) = noun.count
        {
            // "rooms with more than five chairs"
            let mut bearers: HashMap<Thing, u64> = HashMap::new();
            for anchor in self.anchors(restriction, &Noun { count: None, ..noun.clone() }, loose)? {
                for bearer in self.related(restriction.rel, anchor) {
                    *bearers.entry(bearer).or_default() += 1;
                }
            }
            let fits = |n: &u64| noun.quantity.admits(*n, asked);
            return Ok(bearers.into_iter().filter(|(_, n)| fits(n)).map(|(t, _)| t).collect());
        }
        for noun in &restriction.anchors {
            let noun = &self.shelves(restriction.rel, noun);
            for anchor in self.anchors(restriction, noun, loose)? {
                found.extend(self.related(restriction.rel, anchor));
            }
        }
        Ok(found)
    }

    /// # Errors
    /// Several where one is meant; none at all.
    pub(in crate::question) fn anchors(
        &self,
        restriction: &Restriction,
        noun: &Noun,
        loose: bool,
    ) -> Result<Vec<Thing>, Doubt> {
        let any = loose || noun.indefinite || matches!(restriction.rel, Rel::Has | Rel::Bears);
        let anchors = self.find(noun, any)?;
        if anchors.is_empty() && !any {
            return Err(self.none_such(noun));
        }
        // "Next to two sofas", of which there is one.
        let wanted = noun.count.filter(|_| noun.best.is_none());
        if wanted.is_some_and(|n| !noun.quantity.admits(anchors.len() as u64, n)) {
            return Err(Doubt::TooFew { found: anchors });
        }
        let several = any || noun.plural || noun.all || noun.head.things.is_some();
        if anchors.len() > 1 && !several {
            return Ok(vec![self.meant(noun, &anchors)?]);
        }
        Ok(anchors)
    }

    pub(super) fn between(&self, restriction: &Restriction) -> Result<HashSet<Thing>, Doubt> {
        // «между кроватью и стеной»
        if let [one, other] = &restriction.anchors[..]
            && self.is_walls(one) != self.is_walls(other)
        {
            let thing = self.one(if self.is_walls(one) { other } else { one })?;
            return Ok(self.between_walls(thing));
        }
        let ends = self.ends_between(restriction)?;
        let [a, b] = ends[..] else {
            return Err(match (&ends[..], &restriction.anchors[..]) {
                ([], [noun, ..]) => self.none_such(noun),
                (_, [noun, ..]) => self.ambiguous(noun, &ends),
                _ => Doubt::Empty,
            });
        };
        if let (Some(a), Some(b)) = (a.area(), b.area()) {
            let gates: Vec<Thing> = self.openings_between(a, b).map(|g| g.thing).collect();
            // Between two rooms are their doors, and the rooms that both lead to; where no door joins them, the rooms
            // through which one leads to the other.
            let next = |area: AreaId| -> HashSet<Thing> {
                let room = Thing::Entity(Entity::Area(area));
                self.related(Rel::Near, room).into_iter().collect()
            };
            let mut rooms = &next(a) & &next(b);
            if gates.is_empty() && rooms.is_empty() {
                let way = self.passage(&[a], &[b]);
                let between = way.map(|way| way.between()).unwrap_or_default();
                rooms.extend(between.into_iter().map(|id| Thing::Entity(Entity::Area(id))));
            }
            return Ok(gates.into_iter().chain(rooms).collect());
        }
        let (Some(a), Some(b)) = (a.replica(), b.replica()) else { return Ok(HashSet::new()) };
        let between = self.relations.standing_between(&self.around(), a, b);
        Ok(between.into_iter().map(|id| Thing::Entity(Entity::Replica(id))).collect())
    }

    /// The two things between which something is: of several that fit, the one in the room of the other.
    pub(in crate::question) fn ends_between(
        &self,
        restriction: &Restriction,
    ) -> Result<Vec<Thing>, Doubt> {
        let mut ends: Vec<Thing> = Vec::new();
        for (n, noun) in restriction.anchors.iter().enumerate() {
            let beside = |other: &Noun| self.find(other, false).ok().filter(|all| all.len() == 1);
            let others = restriction.anchors.iter().enumerate().filter(|(m, _)| *m != n);
            let other = others.filter_map(|(_, other)| beside(other)).flatten().next();
            ends.extend(match (self.definite(noun), other) {
                // «между кроватью и шкафом»: the wardrobe that is in the bed's room.
                (Err(Doubt::Ambiguous { candidates, .. }), Some(other)) => {
                    let here = |t: &Thing| self.area_of(*t) == self.area_of(other);
                    let near: Vec<Thing> = candidates.iter().copied().filter(here).collect();
                    if near.len() == 1 { near } else { self.definite(noun)? }
                }
                (found, _) => found?,
            });
        }
        Ok(ends)
    }

    /// How many of some things a room holds, or a thing bears.
    pub(in crate::question) fn having(&self, counted: &HashSet<Thing>, thing: Thing) -> usize {
        let rel = if self.is_place(thing) { Rel::In } else { Rel::On };
        self.related(rel, thing).iter().filter(|t| counted.contains(t)).count()
    }

    fn is_place(&self, thing: Thing) -> bool {
        matches!(thing, Thing::Entity(Entity::Area(_) | Entity::Map(_)))
    }
}
