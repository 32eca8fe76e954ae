//! The names of a world, as the languages need them.

use crate::language::report::Named;
use crate::language::{Animacy, Case, FormIndex, Gender, Language, NounPhrase, Number, WordHints};
use crate::map::{self, Entity, Forms, TypeEntry, World};

/// Every name that people may use, in every form, of everything on the map.
///
/// A thing answers to its own name and to the words for its kind, so that «книга» may mean several.
#[must_use]
pub(super) fn form_index(world: &World) -> FormIndex<Entity> {
    let mut index = FormIndex::default();
    for (entity, _) in world.names() {
        index.insert(&phrase(world, entity), entity);
    }
    for (entity, name) in english_names(world) {
        index.insert_english(name, entity);
    }
    for replica in world.replicas.values() {
        let object = &world.objects[&replica.object];
        let Some(kind) = world.types.object.get(object.object_type) else { continue };
        let entity = Entity::Replica(replica.id);
        index.insert(&NounPhrase::parse(&kind.name, &hints_of_type(kind)), entity);
        if !kind.name_en.is_empty() {
            index.insert_english(&kind.name_en, entity);
        }
        for synonym in &kind.synonyms {
            match Language::of(synonym) {
                Language::Russian => {
                    index.insert(&NounPhrase::parse(synonym, &WordHints::default()), entity)
                }
                Language::English => index.insert_english(synonym, entity),
            }
        }
    }
    index
}

/// The name of an entity, ready to be declined.
#[must_use]
pub(super) fn named(world: &World, entity: Entity) -> Named {
    let english = english_name(world, entity);
    Named::new(world.name(entity), &hints(world, entity), Some(english).filter(|n| !n.is_empty()))
}

fn phrase(world: &World, entity: Entity) -> NounPhrase {
    NounPhrase::parse(world.name(entity), &hints(world, entity))
}

fn hints(world: &World, entity: Entity) -> WordHints {
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

fn hints_of_type(kind: &TypeEntry) -> WordHints {
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

fn english_name(world: &World, entity: Entity) -> &str {
    match entity {
        Entity::Map(id) => &world.maps[&id].name_en,
        Entity::Area(id) => &world.areas[&id].name_en,
        Entity::Door(id) => &world.doors[&id].name_en,
        Entity::Replica(id) => &world.replicas[&id].name_en,
        Entity::Place(id) => &world.places[&id].name_en,
    }
}

fn english_names(world: &World) -> impl Iterator<Item = (Entity, &str)> {
    let mut entities: Vec<Entity> = world.names().map(|(entity, _)| entity).collect();
    entities.dedup();
    entities.into_iter().map(|e| (e, english_name(world, e))).filter(|(_, name)| !name.is_empty())
}
