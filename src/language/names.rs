//! The names of a world, as the languages need them: ready to be declined, and in English.

use super::report::Named;
use super::words::{Animacy, Case, Gender, Language, NounPhrase, Number, WordHints};
use crate::map::{self, Entity, Forms, TypeEntry, World};
use crate::sets::set;
use crate::units::{Gather as _, name_key};

/// The name of an entity, ready to be declined.
#[must_use]
pub fn named(world: &World, entity: Entity) -> Named {
    let english = english_name(world, entity);
    let english = Some(english).filter(|n| !n.is_empty());
    let named = Named::new(world.name(entity), &hints(world, entity), english);
    if is_called(world, entity) { named.proper() } else { named }
}

/// Whether a name is that of a person, and not of the kind.
fn is_called(world: &World, entity: Entity) -> bool {
    let Entity::Replica(id) = entity else { return false };
    let kind = || {
        let object = world.objects.get(&world.replicas.get(&id)?.object)?;
        world.types.object.get(object.object_type)
    };
    let is_kind = |kind: &TypeEntry| {
        let own = [world.name(entity), english_name(world, entity)].map(name_key);
        let words = [&kind.name, &kind.name_en].map(|word| name_key(word));
        words.iter().any(|word| !word.is_empty() && own.contains(word))
    };
    world.has_trait(id, "person") && kind().is_none_or(|kind| !is_kind(kind))
}

/// The places and things that are for charging, by their names or their types.
pub fn chargers(world: &World) -> impl Iterator<Item = Entity> + '_ {
    let charges = |name: &str| {
        let key = format!(" {}", name_key(name).replace('_', " "));
        set!("ChargerStem").iter().any(|stem| key.contains(&format!(" {stem}")))
    };
    let places = world.places.values();
    let places = places.filter(move |p| charges(&p.name) || charges(&p.name_en));
    let things = world.replicas.values().filter(move |replica| {
        let kind = world.objects.get(&replica.object).and_then(|object| object.object_type);
        let kind = world.types.object.get(kind);
        kind.is_some_and(|kind| charges(&kind.name) || charges(&kind.name_en))
    });
    places.map(|p| Entity::Place(p.id)).chain(things.map(|r| Entity::Replica(r.id)))
}

/// What the map says of the forms of a name.
pub fn hints(world: &World, entity: Entity) -> WordHints {
    let none = Forms::new();
    let forms = match entity {
        Entity::Area(id) => &world.areas[&id].forms,
        Entity::Door(id) => &world.doors[&id].forms,
        Entity::Replica(id) => &world.replicas[&id].forms,
        Entity::Place(id) => &world.places[&id].forms,
        Entity::Zone(id) => &world.zones[&id].forms,
        Entity::Map(_) => &none,
    };
    WordHints {
        forms: spelled(forms),
        gender: gender_of_foreign(world, entity),
        ..WordHints::default()
    }
}

/// A name in foreign letters is of the gender of what bears it: «Office door закрыта», a door.
fn gender_of_foreign(world: &World, entity: Entity) -> Option<Gender> {
    if Language::of(world.name(entity)) == Language::Russian {
        return None;
    }
    let kind = match entity {
        Entity::Door(_) => return Some(Gender::Feminine),
        Entity::Area(id) => world.types.area.get(world.areas[&id].area_type),
        Entity::Replica(id) => {
            let object = world.objects.get(&world.replicas[&id].object)?;
            world.types.object.get(object.object_type)
        }
        // «зона» is feminine.
        Entity::Zone(_) => return Some(Gender::Feminine),
        Entity::Place(_) | Entity::Map(_) => None,
    }?;
    let hints = hints_of_type(kind);
    let is_russian = Language::of(&kind.name) == Language::Russian;
    hints.gender.or(is_russian.then(|| NounPhrase::parse(&kind.name, &hints).gender()))
}

pub fn hints_of_type(kind: &TypeEntry) -> WordHints {
    WordHints {
        gender: kind.gender.map(|g| match g {
            map::Gender::Masculine => Gender::Masculine,
            map::Gender::Feminine => Gender::Feminine,
            map::Gender::Neuter => Gender::Neuter,
        }),
        animacy: kind.animate.then_some(Animacy::Animate),
        forms: spelled(&kind.forms),
        ..WordHints::default()
    }
}

fn spelled(forms: &Forms) -> std::collections::BTreeMap<(Number, Case), String> {
    forms
        .iter()
        .map(|(case, form)| {
            let case = match case {
                map::Case::Nominative => Case::Nominative,
                map::Case::Genitive => Case::Genitive,
                map::Case::Dative => Case::Dative,
                map::Case::Accusative => Case::Accusative,
                map::Case::Instrumental => Case::Instrumental,
                map::Case::Prepositional => Case::Prepositional,
            };
            ((Number::Singular, case), form.clone())
        })
        .gather()
}

/// The English name of an entity, empty where the map gives none.
pub fn english_name(world: &World, entity: Entity) -> &str {
    match entity {
        Entity::Map(id) => &world.maps[&id].name_en,
        Entity::Area(id) => &world.areas[&id].name_en,
        Entity::Door(id) => &world.doors[&id].name_en,
        Entity::Replica(id) => &world.replicas[&id].name_en,
        Entity::Place(id) => &world.places[&id].name_en,
        Entity::Zone(id) => &world.zones[&id].name_en,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_foreign_name_is_of_the_gender_of_its_kind() {
        let world =
            World::load(concat!(env!("CARGO_MANIFEST_DIR"), "/../../maps/lab.toml")).unwrap();
        let gender = |name| named(&world, world.find(name)[0]).phrase().gender();
        assert_eq!(gender("Office door"), Gender::Feminine);
    }
}
