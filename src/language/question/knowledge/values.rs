//! Values of properties and states of doors, as the map has them.
//!
//! Invariant: what a thing itself says goes before what its object says.

use super::{Knowledge, KnownOpening};
use crate::map::{DoorKind, DoorStatus, Entity, Properties};
use crate::question::query::{Filter, Rel, Thing};
use crate::question::values::{Property, ValueId};
use crate::sets::set;
use crate::units::{DoorId, Gather as _, InOrder as _, name_key};
use std::collections::BTreeSet;

impl Knowledge<'_> {
    /// All values of a thing, with the map's own words for them.
    pub(in crate::question) fn values(
        &self,
        thing: Thing,
    ) -> Vec<(Property, Option<ValueId>, String)> {
        let values = &self.lexicon().values;
        let mut found: Vec<(Property, Option<ValueId>, String)> = Vec::new();
        let mut add = |properties: &crate::map::Properties| {
            for (name, value) in properties {
                let (property, meant) = (Property::of(name), values.meaning(value));
                let apart = |own: Option<ValueId>| {
                    own.zip(meant)
                        .is_some_and(|(own, other)| !values.answer_one_question(own, other))
                };
                if found.iter().all(|(other, own, _)| *other != property || apart(*own)) {
                    found.push((property, meant, value.clone()));
                }
            }
        };
        match thing {
            Thing::Entity(Entity::Replica(id)) => {
                if let Some(replica) = self.world.replicas.get(&id) {
                    add(&replica.properties);
                    if let Some(object) = self.world.objects.get(&replica.object) {
                        add(&object.properties);
                    }
                }
            }
            Thing::Entity(Entity::Area(id)) => {
                self.world.areas.get(&id).iter().for_each(|a| add(&a.properties));
            }
            Thing::Entity(Entity::Door(id)) => {
                self.world.doors.get(&id).iter().for_each(|d| add(&d.properties));
            }
            _ => {}
        }
        for (status, _) in self.statuses(thing) {
            let value = values.of_door(status);
            let word = value.map(|v| values.entry(v).russian.clone()).unwrap_or_default();
            found.insert(0, (Property::State, value, word));
        }
        found
    }

    /// What a thing has that answers whether it has a value.
    pub(in crate::question) fn valued(
        &self,
        thing: Thing,
        asked: ValueId,
    ) -> Option<(Property, Option<ValueId>, String)> {
        let values = &self.lexicon().values;
        let asked = self.asked_of(thing, asked);
        let property = &values.entry(asked).property;
        let mut all = self.values(thing);
        let same = all.iter().position(|(_, v, _)| v.is_some_and(|v| values.is(v, asked)));
        let same = same.or_else(|| {
            all.iter().position(|(p, v, _)| match v {
                Some(v) => values.answer_one_question(*v, asked),
                None => p == property,
            })
        });
        same.map(|at| all.swap_remove(at))
    }

    /// States of a door, or of the doors of a thing.
    pub(in crate::question) fn statuses(&self, thing: Thing) -> Vec<(DoorStatus, DoorId)> {
        match thing {
            Thing::Entity(Entity::Door(id)) => match self.world.doors.get(&id) {
                Some(door) if door.kind != DoorKind::Passage => vec![(door.state.status, id)],
                _ => Vec::new(),
            },
            Thing::Entity(Entity::Replica(id)) => {
                let Some(replica) = self.world.replicas.get(&id) else { return Vec::new() };
                let Some(object) = self.world.objects.get(&replica.object) else {
                    return Vec::new();
                };
                let state = |door: DoorId| {
                    let own = replica.door_states.get(&door).copied();
                    own.or_else(|| self.world.doors.get(&door).map(|d| d.state))
                };
                let doors = object.doors.iter();
                doors.filter_map(|m| Some((state(m.door)?.status, m.door))).collect()
            }
            _ => Vec::new(),
        }
    }

    /// What is asked of a thing by a value: a tap that is closed is off, as the map says of it.
    pub(in crate::question) fn asked_of(&self, thing: Thing, wanted: ValueId) -> ValueId {
        let values = &self.lexicon().values;
        let meant = match values.entry(wanted).russian.as_str() {
            "открытый" => values.meaning("включённый"),
            "закрытый" => values.meaning("выключенный"),
            _ => None,
        };
        let is_tap = || {
            let kind = self.kind_name(thing).unwrap_or_default();
            set!("Tap").contains(&name_key(&kind).as_str())
        };
        let says = |value: ValueId| {
            let own = self.values(thing);
            own.iter().any(|(_, own, _)| own.is_some_and(|v| values.answer_one_question(v, value)))
        };
        meant.filter(|meant| is_tap() && says(*meant) && !says(wanted)).unwrap_or(wanted)
    }

    pub(in crate::question) fn has_value(&self, thing: Thing, wanted: ValueId) -> bool {
        let values = &self.lexicon().values;
        let wanted = self.asked_of(thing, wanted);
        let own = self.values(thing);
        if own.iter().any(|(_, value, _)| value.is_some_and(|v| values.is(v, wanted))) {
            return true;
        }
        if let Thing::Entity(Entity::Area(_)) = thing {
            let holds = || self.by_relation(Rel::In, thing).iter().any(|t| t.replica().is_some());
            return match values.entry(wanted).russian.as_str() {
                "пустой" => !holds(),
                "занятый" => holds(),
                // A room is locked where all its doors are.
                _ => {
                    let open = values.of_door(DoorStatus::Open);
                    let own = |gate: &KnownOpening| match gate.is_passage {
                        true => open.is_some_and(|open| values.is(open, wanted)),
                        false => self.has_value(gate.thing, wanted),
                    };
                    let area = thing.area();
                    let mut gates = self
                        .openings()
                        .iter()
                        .filter(|g| area.is_some_and(|a| g.areas.contains(&a)));
                    let stated = values.entry(wanted).property == Property::State;
                    stated && gates.clone().next().is_some() && gates.all(own)
                }
            };
        }
        let told = own.iter().any(|(_, v, _)| v.is_some_and(|v| values.entry(v).is_emptiness()));
        match values.entry(wanted).russian.as_str() {
            _ if told || !self.may_bear(thing) => false,
            "пустой" => !self.bears_anything(thing),
            "занятый" => self.bears_anything(thing),
            _ => false,
        }
    }

    /// Whether the map tells of a thing what a filter asks.
    pub(in crate::question) fn tells(&self, thing: Thing, filter: &Filter) -> bool {
        let values = &self.lexicon().values;
        let asked = self.asked_of(thing, filter.value);
        let entry = values.entry(asked);
        if entry.is_emptiness() || thing.replica().is_none() {
            return true;
        }
        let same = |own: ValueId| values.answer_one_question(own, asked);
        // Cleanliness stands under a name of its own and is a state all the same.
        let told = |(property, own, _): &(Property, Option<ValueId>, String)| {
            own.map_or(*property == entry.property, same)
        };
        self.values(thing).iter().any(told)
    }

    /// Whether a thing has one of a filter's values, or by what the map tells none where that is asked.
    pub(in crate::question) fn fits(&self, thing: Thing, filter: &Filter) -> bool {
        if filter.negated && !self.tells(thing, filter) {
            return false;
        }
        filter.values().any(|value| self.has_value(thing, value)) != filter.negated
    }

    /// Whether things of its kind take others: of a battery, that nothing lies on it does not say that it is empty.
    pub(super) fn may_bear(&self, thing: Thing) -> bool {
        const TAKE: [&str; 4] = ["support", "container", "shelves", "seat"];
        let takes = |id| TAKE.iter().any(|wanted| self.world.has_trait(id, wanted));
        thing.replica().is_some_and(takes) || self.bears_anything(thing)
    }

    /// Whether something is on or in a thing.
    fn bears_anything(&self, thing: Thing) -> bool {
        [Rel::On, Rel::In].iter().any(|rel| !self.related(*rel, thing).is_empty())
    }
}

impl Knowledge<'_> {
    /// How the map calls a property.
    pub(in crate::question) fn property_names(&self, property: &Property) -> Vec<String> {
        let named = |p: &Properties| -> Vec<String> {
            p.keys().filter(|name| Property::of(name) == *property).cloned().collect()
        };
        let replicas = self.world.replicas.values().flat_map(|r| named(&r.properties));
        let objects = self.world.objects.values().flat_map(|o| named(&o.properties));
        let names: BTreeSet<String> = replicas.chain(objects).gather();
        names.into_iter().collect()
    }

    /// How the map spells a value.
    pub(in crate::question) fn spellings(&self, value: ValueId) -> Vec<String> {
        let replicas = self.world.replicas.values().map(|r| &r.properties);
        let objects = self.world.objects.values().map(|o| &o.properties);
        let doors = self.world.doors.values().map(|d| &d.properties);
        let areas = self.world.areas.values().map(|a| &a.properties);
        let all = replicas.chain(objects).chain(doors).chain(areas);
        let values = &self.lexicon().values;
        let mut found: Vec<String> = all
            .flat_map(|p| p.values())
            .filter(|v| values.meaning(v).is_some_and(|own| values.is(own, value)))
            .cloned()
            .collect();
        found.order();
        found.dedup();
        found
    }
}
