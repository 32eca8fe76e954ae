//! Doors and passages with where they lead.
//!
//! Invariant: a passage is told beside doors, never as one.

use super::grouped;
use crate::map::{Entity, stands};
use crate::question::knowledge::Knowledge;
use crate::question::lexicon::Extension;
use crate::question::query::{Noun, Rel, Restriction, Thing};
use crate::units::AreaId;
use crate::words::enumerate;

impl Knowledge<'_> {
    /// «В Коридор можно попасть из Комнаты-В и из Комнаты-Y.»
    pub(super) fn led_from(&self, noun: &Noun, found: &[Thing]) -> Option<String> {
        let to = noun.restrictions.iter().find(|r| r.rel == Rel::To && !r.negated)?;
        let rooms = !found.is_empty() && found.iter().all(|t| t.area().is_some());
        let to = self.find(to.anchors.first()?, true).ok().filter(|_| rooms)?;
        let from: Vec<String> = found.iter().map(|t| self.place(Rel::From, &[*t])).collect();
        Some(match self.is_russian() {
            true => {
                let from = enumerate(&from, self.language);
                format!("{} можно попасть {from}", self.place(Rel::To, &to))
            }
            false => format!("one can get {} from {}", self.place(Rel::To, &to), self.list(found)),
        })
    }

    pub(super) fn is_leading(&self, noun: &Noun) -> bool {
        noun.restrictions.iter().any(|r| matches!(r.rel, Rel::From | Rel::To))
    }

    /// From one room to another.
    pub(super) fn leads_both(&self, noun: &Noun) -> bool {
        let has = |rel| noun.restrictions.iter().any(|r| r.rel == rel);
        has(Rel::From) && has(Rel::To)
    }

    /// «Что стоит на раковине?»: what lies within a thing that nothing shuts, where that is asked for which is on it.
    pub(super) fn within_as_well(&self, noun: &Noun, found: &[Thing]) -> String {
        let on = |place: &Restriction| place.rel == Rel::On && !place.negated;
        let Some(at) = noun.restrictions.iter().position(on) else { return String::new() };
        if noun.best.is_some() || noun.rank.is_some() || noun.other {
            return String::new();
        }
        let holders = self.find(&noun.restrictions[at].anchors[0], true).unwrap_or_default();
        let mut within = noun.clone();
        within.restrictions[at].rel = Rel::In;
        let within = self.find(&within, true).unwrap_or_default();
        let within: Vec<Thing> = within.into_iter().filter(|t| !found.contains(t)).collect();
        let holder = |thing: Thing| {
            let id = self.relations.support_of(thing.replica()?)?;
            let open = stands(self.world, self.world.replicas.get(&id)?).is_none();
            // On what bears things as well, as a chest of drawers, is not in it.
            let has = |wanted| self.world.has_trait(id, wanted);
            let holder = Thing::Entity(Entity::Replica(id));
            let holds = open && has("container") && !has("support");
            (holds && holders.contains(&holder)).then_some(holder)
        };
        let told = grouped(&within, holder).into_iter().filter_map(|(holder, things)| {
            let (place, list) = (self.place(Rel::In, &[holder?]), self.list(&things));
            Some(match self.is_russian() {
                true => format!("; {place} {} {list}", self.is(&things)),
                false => format!("; {list} {} {place}", self.is(&things)),
            })
        });
        told.collect()
    }

    /// Passages beside doors, and what lies inside beside what stands on top.
    pub(super) fn also(&self, noun: &Noun, found: &[Thing]) -> String {
        let is_of = |wanted: Extension| {
            noun.head.kinds.iter().any(|k| self.lexicon().kind(*k).extension == wanted)
        };
        let doors = is_of(Extension::Doors);
        if doors && found.is_empty() && noun.filters.is_empty() {
            let joined = self.joined_by_passage(noun);
            if !joined.is_empty() {
                return joined;
            }
        }
        let of_area = noun.restrictions.iter().find(|r| {
            matches!(r.rel, Rel::From | Rel::To | Rel::Of | Rel::In | Rel::At) && !r.negated
        });
        let Some(restriction) =
            of_area.filter(|_| doors && noun.filters.is_empty() && !self.leads_both(noun))
        else {
            return self.within_as_well(noun, found);
        };
        let Some(anchor) = restriction.anchors.first() else { return String::new() };
        let Ok(areas) = self.find(anchor, true) else { return String::new() };
        let passages: Vec<Thing> = self
            .openings()
            .iter()
            .filter(|g| g.is_passage && !found.contains(&g.thing))
            .filter(|g| areas.iter().filter_map(|a| a.area()).any(|a| g.areas.contains(&a)))
            .map(|g| g.thing)
            .collect();
        let is_area = |t: &Thing| t.area().is_some();
        let parts = match areas[..] {
            [here] if is_area(&here) => self.with_destinations(&passages, here),
            _ => vec![self.list(&passages)],
        };
        let list = enumerate(&parts, self.language);
        match (passages.len(), self.is_russian()) {
            (0, _) => String::new(),
            (_, true) => format!("; кроме того, есть {list}"),
            (1, false) => format!("; besides, there is {list}"),
            (_, false) => format!("; besides, there are {list}"),
        }
    }

    /// Ways out of one room, with where each leads.
    pub(super) fn ways_out_told(&self, noun: &Noun, found: &[Thing]) -> Option<String> {
        if !self.is_of_rooms(noun) {
            return None;
        }
        let [room] = self.anchor_things(noun)[..] else { return None };
        room.area()?;
        Some(enumerate(&self.with_destinations(found, room), self.language))
    }

    /// «Какая дверь соединяет кухню и гостиную?» where there is none, but an open passage.
    fn joined_by_passage(&self, noun: &Noun) -> String {
        let places = noun
            .restrictions
            .iter()
            .filter(|r| matches!(r.rel, Rel::Between | Rel::From | Rel::To) && !r.negated);
        let ends: Vec<AreaId> = places
            .flat_map(|place| &place.anchors)
            .filter_map(|anchor| match self.find(anchor, true).ok()?[..] {
                [only] => only.area(),
                _ => None,
            })
            .collect();
        let [a, b] = ends[..] else { return String::new() };
        let open = self.openings_between(a, b).filter(|gate| gate.is_passage);
        let passages: Vec<Thing> = open.map(|gate| gate.thing).collect();
        match (passages.len(), self.is_russian()) {
            (0, _) => String::new(),
            (_, true) => format!(", но есть {}", self.list(&passages)),
            (1, false) => format!(", but there is {}", self.list(&passages)),
            (_, false) => format!(", but there are {}", self.list(&passages)),
        }
    }

    /// Openings of a room by where they lead: out of the map, or to rooms.
    pub(super) fn by_destination(
        &self,
        openings: &[Thing],
        here: Thing,
    ) -> Vec<(Vec<Thing>, Vec<Thing>)> {
        grouped(openings, |opening| {
            let areas = self.opening(opening).into_iter().flat_map(|g| &g.areas);
            areas.map(|a| Thing::Entity(Entity::Area(*a))).filter(|t| *t != here).collect()
        })
    }

    /// Openings of a room with where they lead, those to the same place together.
    pub(super) fn with_destinations(&self, openings: &[Thing], here: Thing) -> Vec<String> {
        let groups = self.by_destination(openings, here);
        let told = |(to, openings): &(Vec<Thing>, Vec<Thing>)| {
            let names = self.list(openings);
            match (to.is_empty(), self.is_russian()) {
                (false, _) => format!("{names} ({})", self.place(Rel::To, to)),
                (true, true) => format!("{names} (наружу)"),
                (true, false) => format!("{names} (outside)"),
            }
        };
        groups.iter().map(told).collect()
    }
}
