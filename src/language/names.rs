//! The names of a world, as the languages need them: ready to be declined, and in English.

use super::report::Named;
use super::words::{Animacy, Case, Gender, Number, WordHints};
use crate::map::{self, Entity, Forms, TypeEntry, World};

/// The name of an entity, ready to be declined.
#[must_use]
pub(crate) fn named(world: &World, entity: Entity) -> Named {
    let english = english_name(world, entity);
    Named::new(world.name(entity), &hints(world, entity), Some(english).filter(|n| !n.is_empty()))
}

/// What the map says of the forms of a name.
pub(crate) fn hints(world: &World, entity: Entity) -> WordHints {
    let none = Forms::new();
    let forms = match entity {
        Entity::Area(id) => &world.areas[&id].forms,
        Entity::Door(id) => &world.doors[&id].forms,
        Entity::Replica(id) => &world.replicas[&id].forms,
        Entity::Place(id) => &world.places[&id].forms,
        Entity::Map(_) => &none,
    };
    WordHints { forms: spelled(forms), ..WordHints::default() }
}

pub(crate) fn hints_of_type(kind: &TypeEntry) -> WordHints {
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
        .collect()
}

/// The English name of an entity, empty where the map gives none.
pub(crate) fn english_name(world: &World, entity: Entity) -> &str {
    match entity {
        Entity::Map(id) => &world.maps[&id].name_en,
        Entity::Area(id) => &world.areas[&id].name_en,
        Entity::Door(id) => &world.doors[&id].name_en,
        Entity::Replica(id) => &world.replicas[&id].name_en,
        Entity::Place(id) => &world.places[&id].name_en,
    }
}
