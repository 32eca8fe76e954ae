//! The names of a world in one index, for commands.

use std::collections::BTreeMap;

use crate::language::names::{english_name, hints, hints_of_type};
use crate::language::{FormIndex, Language, NounPhrase, WordHints};
use crate::map::{Entity, World};

pub(super) use crate::language::names::named;

/// Every name that people may use, in every form, of everything on the map.
///
/// A thing answers to its own name and to the words for its kind, so that «книга» may mean several.
#[must_use]
pub(super) fn form_index(world: &World) -> FormIndex<Entity> {
    let mut index = FormIndex::default();
    let mut entities: Vec<Entity> = world.names().map(|(entity, _)| entity).collect();
    entities.dedup();
    for &entity in &entities {
        let name = world.name(entity);
        let english = english_name(world, entity);
        if !name.is_empty() {
            index.insert_name(name, &hints(world, entity), entity);
        }
        if !english.is_empty() {
            index.insert_english(english, entity);
        }
    }
    let mut of_type: BTreeMap<_, Vec<Entity>> = BTreeMap::new();
    for replica in world.replicas.values() {
        let kind = world.objects[&replica.object].object_type;
        of_type.entry(kind).or_default().push(Entity::Replica(replica.id));
    }
    let mut rooms_of_type: BTreeMap<_, Vec<Entity>> = BTreeMap::new();
    for area in world.areas.values() {
        rooms_of_type.entry(area.area_type).or_default().push(Entity::Area(area.id));
    }
    let things = of_type.into_iter().map(|(kind, all)| (world.types.object.get(kind), all));
    let rooms = rooms_of_type.into_iter().map(|(kind, all)| (world.types.area.get(kind), all));
    for (kind, things) in things.chain(rooms) {
        let Some(kind) = kind else { continue };
        index.insert_kind(&NounPhrase::parse(&kind.name, &hints_of_type(kind)), &things);
        if !kind.name_en.is_empty() {
            index.insert_english_kind(&kind.name_en, &things);
        }
        for synonym in &kind.synonyms {
            match Language::of(synonym) {
                Language::Russian => {
                    index.insert_kind(&NounPhrase::parse(synonym, &WordHints::default()), &things);
                }
                Language::English => index.insert_english_kind(synonym, &things),
            }
        }
    }
    index
}
