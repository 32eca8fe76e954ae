//! Type lists of the world that is being made: an entry for each meaning that was used.

use std::collections::HashMap;

use crate::map::{Forms, Gender, TypeEntry, TypeKind, TypeLists};
use crate::synonyms::Meaning;
use crate::units::TypeId;

/// The type lists, and which meanings they hold.
#[derive(Debug, Default)]
pub(super) struct Types {
    pub(super) lists: TypeLists,
    by_name: HashMap<(TypeKind, String), TypeId>,
}

impl Types {
    pub(super) fn of(&mut self, kind: TypeKind, meaning: &Meaning) -> TypeId {
        if let Some(&id) = self.by_name.get(&(kind, meaning.name.clone())) {
            return id;
        }
        let entry = TypeEntry {
            id: TypeId(0),
            name: meaning.name.clone(),
            name_en: meaning.name_en.clone(),
            description: String::new(),
            gender: meaning.gender,
            animate: false,
            synonyms: meaning.synonyms.clone(),
            forms: Forms::new(),
            traits: meaning.traits.clone(),
        };
        self.add(kind, entry)
    }

    /// A type that the program itself names: wall, window, door.
    pub(super) fn plain(
        &mut self,
        kind: TypeKind,
        name: &str,
        name_en: &str,
        gender: Gender,
    ) -> TypeId {
        let meaning = Meaning {
            name: name.to_owned(),
            name_en: name_en.to_owned(),
            gender: Some(gender),
            ..Meaning::default()
        };
        self.of(kind, &meaning)
    }

    fn add(&mut self, kind: TypeKind, mut entry: TypeEntry) -> TypeId {
        let list = self.lists.list_mut(kind);
        let id = TypeId(list.entries.len() as u32 + 1);
        entry.id = id;
        self.by_name.insert((kind, entry.name.clone()), id);
        list.entries.insert(id, entry);
        id
    }
}
