//! Words of a map that nothing understands: values of properties, and traits.

use std::collections::BTreeSet;

use super::{Doubter, Spot};
use crate::fault::{MapError, Record};
use crate::units::{Piece, name_key, nearest_name, word};
use crate::{Mark, Properties, TypeKind, is_dark, is_on, is_open};

/// What the program and its own rules know of a kind of thing or room.
const TRAITS: [&str; 14] = [
    "bed",
    "container",
    "corridor",
    "device",
    "lift",
    "light",
    "movable",
    "person",
    "portable",
    "room",
    "seat",
    "shelves",
    "stairs",
    "support",
];
/// The person whom the operator's tasks speak of, in either language.
const OPERATOR: [&str; 2] = ["оператор", "operator"];

impl Doubter<'_> {
    /// Properties that the program understands, with values that it does not.
    pub(super) fn marks(&mut self) {
        let world = self.world;
        let doors = Known::of(world.doors.values().flat_map(|d| [&d.name, &d.name_en]));
        let things = Known::of(world.replicas.values().flat_map(|r| [&r.name, &r.name_en]));
        let is_operator = |name: &str| OPERATOR.contains(&name_key(name).as_str());
        for replica in world.replicas.values() {
            let record = Record::Replica(replica.id);
            let own = &replica.properties;
            self.named(record, own, Mark::KeyOf, word!("door-2"), &doors);
            self.named(record, own, Mark::KeptOn, word!("thing"), &things);
            self.switched(record, own, world.has_trait(replica.id, "device"));
        }
        for object in world.objects.values() {
            let is_device = world.types.object.has_trait(object.object_type, "device");
            self.switched(Record::Object(object.id), &object.properties, is_device);
        }
        for door in world.doors.values() {
            let holder = Mark::KeyWith.of(&door.properties).filter(|(_, who)| !is_operator(who));
            if holder.is_some() {
                let record = Record::Door(door.id);
                self.named(record, &door.properties, Mark::KeyWith, word!("person"), &things);
            }
        }
        for area in world.areas.values() {
            // Whether a room is dark is asked in one way only; what is lit is no less known for it.
            if let Some((name, value)) = Mark::Light.of(&area.properties)
                && !is_dark(&area.properties)
                && is_on(&Properties::from([(Mark::Power.names()[1].to_owned(), value.to_owned())]))
                    .is_none()
            {
                self.value(Record::Area(area.id), name, value, ON_OFF);
            }
        }
    }

    /// A property that names something of the map.
    fn named(
        &mut self,
        record: Record,
        properties: &Properties,
        mark: Mark,
        what: Piece,
        known: &Known<'_>,
    ) {
        let Some((property, value)) = mark.of(properties) else { return };
        if known.keys.contains(&name_key(value)) {
            return;
        }
        let error = MapError::NamesNothing {
            property: property.to_owned(),
            what: what.into(),
            name: value.to_owned(),
            nearest: nearest_name(value, known.names.iter().copied()).map(str::to_owned),
        };
        self.doubt(error, vec![Spot::of(record).field("properties").key(property)]);
    }

    /// Power is on or off; so is, or open or shut, the state of a device whose power is not told apart.
    fn switched(&mut self, record: Record, properties: &Properties, is_device: bool) {
        let alone =
            |value: &str| Properties::from([(Mark::State.names()[1].to_owned(), value.to_owned())]);
        if let Some((name, value)) = Mark::Power.of(properties) {
            if is_on(&alone(value)).is_none() {
                self.value(record, name, value, ON_OFF);
            }
        } else if let Some((name, value)) = Mark::State.of(properties)
            && is_device
            && is_on(&alone(value)).is_none()
            && is_open(&alone(value)).is_none()
        {
            self.value(record, name, value, STATES);
        }
    }

    fn value(&mut self, record: Record, property: &str, value: &str, wanted: Piece) {
        let error = MapError::UnknownState {
            property: property.to_owned(),
            value: value.to_owned(),
            wanted: wanted.into(),
        };
        self.doubt(error, vec![Spot::of(record).field("properties").key(property)]);
    }

    /// Traits that no rule knows.
    pub(super) fn traits(&mut self, rule_words: &BTreeSet<String>) {
        for kind in TypeKind::ALL {
            for entry in self.world.types.list(kind).entries.values() {
                for (no, word) in entry.traits.iter().enumerate() {
                    if TRAITS.contains(&word.as_str()) || rule_words.contains(word) {
                        continue;
                    }
                    let known = TRAITS.into_iter().chain(rule_words.iter().map(String::as_str));
                    let error = MapError::UnknownTrait {
                        owner: entry.name.clone(),
                        word: word.clone(),
                        nearest: nearest_name(word, known).map(str::to_owned),
                        known: TRAITS.join(", "),
                    };
                    let spot = Spot::of(Record::Type(kind, entry.id)).field("traits").index(no);
                    self.doubt(error, vec![spot]);
                }
            }
        }
    }
}

const ON_OFF: Piece = word!("on-or-off");
const STATES: Piece = word!("on-off-open-or-closed");

/// The names of all things of a sort.
struct Known<'n> {
    names: Vec<&'n str>,
    keys: BTreeSet<String>,
}

impl<'n> Known<'n> {
    fn of(names: impl Iterator<Item = &'n String>) -> Self {
        let names: Vec<&str> = names.map(String::as_str).filter(|name| !name.is_empty()).collect();
        let keys = names.iter().map(|name| name_key(name)).collect();
        Self { names, keys }
    }
}
