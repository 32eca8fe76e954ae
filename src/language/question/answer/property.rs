//! Colour, material, state and all other properties; what a thing is as a whole.
//!
//! Invariant: a property that the map does not give is said to be missing, never guessed.

use super::Draft;
use crate::map::{DoorStatus, Entity, Mark};
use crate::question::knowledge::{Kept, Knowledge};
use crate::question::lexicon::{Extension, KindId};
use crate::question::query::{Claim, Head, Noun, Rel, Thing};
use crate::question::speech::sentence;
use crate::question::values::{Property, ValueId};
use crate::question::{Doubt, Fact, Said};
use crate::units::name_key;
use crate::words::{Case, Language, enumerate};

/// A room, and what the map keeps of its floor or walls.
type Surface = (Thing, Option<Kept>);

impl Knowledge<'_> {
    /// The map's own name of a property that has such a text.
    pub(in crate::question) fn property_name(
        &self,
        thing: Thing,
        property: &Property,
        text: &str,
    ) -> String {
        let find = |properties: &crate::map::Properties| {
            let mut own = properties.iter().filter(|(name, _)| Property::of(name) == *property);
            own.find(|(_, value)| *value == text).map(|(name, _)| name.clone())
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

    pub(super) fn property(&self, property: &Property, of: &Noun) -> Result<Draft, Doubt> {
        if let Some(draft) = self.property_of_part(property, of)? {
            return Ok(draft);
        }
        if self.is_floor(of) || self.is_walls(of) {
            return self.property_of_surface(property, of);
        }
        let found = self.definite(of)?;
        let mut parts: Vec<String> = Vec::new();
        let mut facts = Vec::new();
        let mut known = false;
        let mut lacking: Vec<Thing> = Vec::new();
        for &thing in &found {
            let name = self.name(thing);
            let own: Vec<_> =
                self.values(thing).into_iter().filter(|(p, _, _)| p == property).collect();
            if let (Property::Kind, true, Some(kind)) =
                (property, own.is_empty(), self.sort_name(thing))
            {
                known = true;
                parts.push(match self.is_russian() {
                    true => format!("{name}: тип – {kind}"),
                    false => format!("the type of {name} is {kind}"),
                });
                continue;
            }
            if own.is_empty() {
                lacking.push(thing);
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
                        let name = self.property_name(thing, property, text);
                        Fact::holding("HAS", vec![self.symbol(thing), name, text.clone()])
                    }
                });
            }
            parts.push(self.property_words(thing, property, &enumerate(&words, self.language)));
        }
        parts.extend(self.unsaid(property, &lacking));
        let said = if known { Said::Found } else { Said::Unknown };
        let text = parts.join("; ");
        Ok(Draft { facts, ..Draft::new(said, text).with(found) })
    }

    /// "Is the bathroom floor orange?": by the value that the map keeps of it, told with the answer.
    pub(super) fn surface_is(
        &self,
        of: &Noun,
        claims: &[Claim],
        negated: bool,
    ) -> Result<Draft, Doubt> {
        let [Claim::Value(filter)] = claims else {
            return Err(Doubt::NotUnderstood { words: of.text.clone() });
        };
        let values = &self.lexicon().values;
        let property = &values.entry(filter.value).property;
        let own: Vec<Option<ValueId>> = self
            .surfaces(property, of)?
            .into_iter()
            .map(|(_, value)| value.and_then(|(value, _)| value))
            .collect();
        let told = self.property_of_surface(property, of)?;
        // What the map does not say of one of them is not known of all.
        let Some(own) = own.into_iter().collect::<Option<Vec<ValueId>>>() else {
            return Ok(told);
        };
        let wanted: Vec<ValueId> = [filter.value].into_iter().chain(filter.or.clone()).collect();
        let is_so = |own: &ValueId| wanted.iter().any(|wanted| values.is(*own, *wanted));
        let is = own.iter().all(|own| is_so(own) != filter.negated);
        let (said, word) = match is != negated {
            true => (Said::Yes, self.pick("да", "yes")),
            false => (Said::No, self.pick("нет", "no")),
        };
        Ok(Draft { said: Some(said), text: format!("{word}, {}", told.text), ..told })
    }

    /// What the map keeps of the floors or walls that a description means, by their rooms: the value, if it is one that is
    /// known, and its words.
    fn surfaces(&self, property: &Property, of: &Noun) -> Result<Vec<Surface>, Doubt> {
        let mut rooms: Vec<Thing> = Vec::new();
        for anchor in of.restrictions.iter().flat_map(|place| &place.anchors) {
            rooms.extend(self.definite(anchor)?.into_iter().filter(|t| t.area().is_some()));
        }
        if of.restrictions.is_empty() && of.plural && self.is_floor(of) {
            rooms = self.members(&Extension::Rooms);
        } else if of.restrictions.is_empty() {
            rooms.extend(self.area_of(Thing::Robot).map(|id| Thing::Entity(Entity::Area(id))));
        }
        if rooms.is_empty() {
            return Err(Doubt::NotUnderstood { words: of.text.clone() });
        }
        let kept = |room| (room, self.kept_of_surface(room, property, of));
        Ok(rooms.into_iter().map(kept).collect())
    }

    /// «Какого цвета стены на кухне?»: of floors and walls, which have no names, the map keeps it with their room.
    fn property_of_surface(&self, property: &Property, of: &Noun) -> Result<Draft, Doubt> {
        let surfaces = self.surfaces(property, of)?;
        let rooms: Vec<Thing> = surfaces.iter().map(|(room, _)| *room).collect();
        let (russian, english) =
            if self.is_floor(of) { ("пола", "the floor") } else { ("стен", "the walls") };
        let own = property.noun(self.language);
        let known = surfaces.iter().any(|(_, value)| value.is_some());
        let mut parts = Vec::new();
        for (room, value) in surfaces {
            let place = self.place(Rel::In, &[room]);
            let told = value.map(|(value, text)| match value {
                Some(value) if !self.is_russian() => {
                    self.lexicon().values.entry(value).english.clone()
                }
                _ => text.to_lowercase(),
            });
            parts.push(match (told, self.is_russian()) {
                (Some(told), true) => format!("{own} {russian} {place} – {told}"),
                (Some(told), false) => format!("the {own} of {english} {place} is {told}"),
                (None, true) => format!("{own} {russian} {place}: на карте не указано"),
                (None, false) => format!("the map does not give the {own} of {english} {place}"),
            });
        }
        let said = if known { Said::Found } else { Said::Unknown };
        Ok(Draft::new(said, enumerate(&parts, self.language)).about(&rooms))
    }

    /// «Чашка-1 белая», "Cup 1 is made of glass": what a thing has of a property, of which the words are given.
    fn property_words(&self, thing: Thing, property: &Property, words: &str) -> String {
        let name = self.name(thing);
        match (self.is_russian(), property) {
            (
                true,
                Property::Colour
                | Property::State
                | Property::Surface
                | Property::Orientation
                | Property::Material,
            ) => format!("{name} {words}"),
            (true, other) => format!("{name}: {} – {words}", other.noun(Language::Russian)),
            (false, Property::Material) => format!("{name} is made of {}", material(words)),
            (false, Property::Other(key)) => format!("{key} of {name}: {words}"),
            (false, _) => format!("{name} is {words}"),
        }
    }

    /// That a thing has a value, as a clause; none of properties that have no words of their own.
    pub(in crate::question) fn value_words(
        &self,
        thing: Thing,
        property: &Property,
        value: ValueId,
    ) -> Option<String> {
        let told = !matches!(property, Property::Other(_));
        told.then(|| self.property_words(thing, property, &self.value_of(property, value, thing)))
    }

    /// «Какого цвета сиденье у кресла?»: the map gives properties of whole things.
    fn property_of_part(&self, property: &Property, of: &Noun) -> Result<Option<Draft>, Doubt> {
        let is_part = |k: &KindId| {
            let extension = self.lexicon().kind(*k).extension;
            matches!(extension, Extension::Part(_) | Extension::Trait("seat"))
        };
        if !of.head.named.is_empty() || !of.head.kinds.iter().any(is_part) {
            return Ok(None);
        }
        let owner = self.owner_of_parts(of)?.or_else(|| self.seat_of(of));
        let Some(owner) = owner else { return Ok(None) };
        let head = Head { things: Some(vec![owner]), ..Head::default() };
        let whole = self.property(property, &Noun { head, ..Noun::default() })?;
        let text = match self.is_russian() {
            true => format!(
                "отдельно о частях {} карта этого не говорит; {}",
                self.form(owner, Case::Genitive),
                whole.text
            ),
            false => format!(
                "the map does not tell this of the parts of {} by themselves; {}",
                self.name(owner),
                whole.text
            ),
        };
        Ok(Some(Draft { said: Some(Said::Unknown), text, ..whole }))
    }

    /// «сиденье у кресла»: the seat that is part of a seat.
    fn seat_of(&self, of: &Noun) -> Option<Thing> {
        let [place] = &of.restrictions[..] else { return None };
        let belongs = matches!(place.rel, Rel::NextTo | Rel::Of) && !place.negated;
        let owner = place.anchors.first().filter(|_| belongs)?;
        let seat = |t: &Thing| t.replica().is_some_and(|id| self.world.has_trait(id, "seat"));
        self.one(owner).ok().filter(seat)
    }

    pub(super) fn no_property(&self, property: &Property, thing: Thing) -> String {
        let noun = property.noun(self.language);
        match self.is_russian() {
            true => format!(
                "{} {} на карте не {}",
                noun,
                self.form(thing, Case::Genitive),
                match property {
                    Property::State => "указано",
                    Property::Surface
                    | Property::Shape
                    | Property::Orientation
                    | Property::Price
                    | Property::Temperature
                    | Property::Brand => "указана",
                    _ => "указан",
                }
            ),
            false => format!("the map does not give the {noun} of {}", self.name(thing)),
        }
    }

    /// The values of a thing without the id that a foreign file gave it, which is nothing to tell.
    pub(super) fn told_values(&self, thing: Thing) -> Vec<(Property, Option<ValueId>, String)> {
        let is_id = |text: &str| text.contains('|') || text.chars().all(|c| c.is_ascii_digit());
        let mut values = self.values(thing);
        let untold = [Mark::UsualSize, Mark::Source].map(|mark| mark.names().map(Property::of));
        values.retain(|(property, _, _)| !untold.as_flattened().contains(property));
        values.retain(|(_, _, text)| !is_id(text));
        values
    }

    pub(super) fn describe(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let name = self.name(thing);
        let mut facts = Vec::new();
        let mut parts: Vec<String> = Vec::new();
        // «Кухня – кухня» tells nothing.
        let same = |kind: &String| name_key(kind) != name_key(&name);
        let kind = self.kind_name(thing).filter(same);
        parts.push(match (kind, self.is_russian()) {
            (Some(kind), true) => format!("{name} – {kind}"),
            (Some(kind), false) => format!("{name} is {}", crate::english::a(&kind)),
            (None, _) => String::new(),
        });
        parts.retain(|part| !part.is_empty());
        parts.push(self.where_one(thing, &mut facts));
        let values: Vec<String> = self
            .told_values(thing)
            .iter()
            .filter(|(_, value, _)| value.is_some())
            // The colour of its floor is none of the room.
            .filter(|(property, _, _)| {
                !matches!(property, Property::Other(name) if is_of_surface(name))
            })
            .map(|(property, value, text)| {
                let of_language = |value: &ValueId| {
                    let sort = &self.lexicon().values.entry(*value).property;
                    (!matches!(sort, Property::Other(_))).then(|| (sort.clone(), *value))
                };
                let name = property.noun(self.language);
                let key = name_key(text);
                let is = |words: [&str; 3]| words.contains(&&*key);
                match value.as_ref().and_then(of_language) {
                    // A yes or no is nothing without what it is said of.
                    _ if is(["да", "yes", "true"]) => name,
                    _ if is(["нет", "no", "false"]) => {
                        format!("{name} – {}", self.value_told(text))
                    }
                    // «ЧИСТОТА = Чистое»: what the language calls a state is told as one.
                    Some((sort, value)) => self.value_of(&sort, value, thing),
                    None => format!("{name} – {}", self.value_told(text)),
                }
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

    /// The text of a property: a name of the map, «нет», or what the map writes.
    pub(super) fn value_told(&self, text: &str) -> String {
        match (&*name_key(text), &self.world.find(text)[..]) {
            ("да" | "yes" | "true", _) => self.pick("да", "yes").to_owned(),
            ("нет" | "no" | "false", _) => self.pick("нет", "no").to_owned(),
            (_, [named]) => self.name(Thing::Entity(*named)),
            _ => text.to_owned(),
        }
    }

    /// The type of a thing; of a door the sort of door that it is.
    fn sort_name(&self, thing: Thing) -> Option<String> {
        let Thing::Entity(Entity::Door(id)) = thing else { return self.kind_name(thing) };
        let entry = self.world.types.door.get(self.world.doors.get(&id)?.door_type)?;
        Some(match self.is_russian() || entry.name_en.is_empty() {
            true => crate::question::lexicon::lower_first(&entry.name),
            false => entry.name_en.clone(),
        })
    }

    /// «стул», "chair": the type of a thing.
    pub(in crate::question) fn kind_name(&self, thing: Thing) -> Option<String> {
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
            true => crate::question::lexicon::lower_first(&entry.name),
            false => entry.name_en.clone(),
        })
    }
}

/// "wood" for "wooden".
fn material(words: &str) -> String {
    match words {
        "wooden" => "wood".to_owned(),
        other => other.to_owned(),
    }
}

pub(super) fn status_word(status: DoorStatus) -> &'static str {
    match status {
        DoorStatus::Open => "open",
        DoorStatus::Closed => "closed",
        DoorStatus::Locked => "locked",
    }
}

/// «цвет пола», "colour of the walls": what a map keeps of a room's surfaces.
fn is_of_surface(name: &str) -> bool {
    name.ends_with(" пола") || name.ends_with(" стен")
}
