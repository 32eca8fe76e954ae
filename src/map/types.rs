//! Type lists (the paper's …TypeList tables) and what the languages need to know of a word.

use std::collections::BTreeMap;

use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::units::{TypeId, name_key};

#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, Serialize, Deserialize, JsonSchema)]
pub enum Gender {
    #[serde(rename = "m", alias = "м")]
    Masculine,
    #[serde(rename = "f", alias = "ж")]
    Feminine,
    #[serde(rename = "n", alias = "с")]
    Neuter,
}

/// The six cases of Russian, in the order in which schools teach them.
#[derive(
    Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize, JsonSchema,
)]
pub enum Case {
    #[serde(rename = "nom", alias = "и")]
    Nominative,
    #[serde(rename = "gen", alias = "р")]
    Genitive,
    #[serde(rename = "dat", alias = "д")]
    Dative,
    #[serde(rename = "acc", alias = "в")]
    Accusative,
    #[serde(rename = "ins", alias = "т")]
    Instrumental,
    #[serde(rename = "loc", alias = "п")]
    Prepositional,
}

/// Singular forms given by hand, for names that the rules of the language would decline wrongly.
pub type Forms = BTreeMap<Case, String>;

/// One type: «Стул» among the kinds of Objects, «Коридор» among those of Areas.
#[derive(Debug, Clone, PartialEq)]
pub struct TypeEntry {
    pub id: TypeId,
    pub name: String,
    pub name_en: String,
    pub description: String,
    pub gender: Option<Gender>,
    pub animate: bool,
    /// Other words for it, in either language: «табуретка», "stool".
    pub synonyms: Vec<String>,
    pub forms: Forms,
    /// What the rules may know of it, e.g. `container`, `portable`, `seat`, `corridor`.
    pub traits: Vec<String>,
}

impl TypeEntry {
    /// Whether one of its names, in either language, has one of these words.
    #[must_use]
    pub fn is_called(&self, words: &[&str]) -> bool {
        let names = [&self.name, &self.name_en].into_iter().chain(&self.synonyms);
        names
            .map(|n| n.to_lowercase())
            .any(|name| words.iter().any(|w| name.split(' ').any(|part| part == *w)))
    }
}

/// The entries of one …TypeList table.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TypeList {
    pub entries: BTreeMap<TypeId, TypeEntry>,
}

impl TypeList {
    #[must_use]
    pub fn get(&self, id: Option<TypeId>) -> Option<&TypeEntry> {
        self.entries.get(&id?)
    }

    /// The type that bears this name, in either language.
    #[must_use]
    pub fn named(&self, name: &str) -> Option<&TypeEntry> {
        let key = name_key(name);
        self.entries.values().find(|e| name_key(&e.name) == key || name_key(&e.name_en) == key)
    }

    #[must_use]
    pub fn has_trait(&self, id: Option<TypeId>, wanted: &str) -> bool {
        self.get(id).is_some_and(|e| e.traits.iter().any(|t| t == wanted))
    }
}

/// All type lists of a world.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct TypeLists {
    /// OrtFrmTypeList
    pub orthoframe: TypeList,
    /// OrtFrmShapeList
    pub shape: TypeList,
    /// OrtFrmSideTypeList
    pub side: TypeList,
    /// ObjectTypeList
    pub object: TypeList,
    /// AreaTypeList
    pub area: TypeList,
    /// MapTypeList
    pub map: TypeList,
    /// DoorTypeList
    pub door: TypeList,
}

/// Which of the type lists.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum TypeKind {
    Orthoframe,
    Shape,
    Side,
    Object,
    Area,
    Map,
    Door,
}

impl TypeKind {
    pub const ALL: [Self; 7] = [
        Self::Orthoframe,
        Self::Shape,
        Self::Side,
        Self::Object,
        Self::Area,
        Self::Map,
        Self::Door,
    ];

    /// The list's name in a map file, under `type`.
    #[must_use]
    pub fn field(self) -> &'static str {
        match self {
            Self::Orthoframe => "orthoframe",
            Self::Shape => "shape",
            Self::Side => "side",
            Self::Object => "object",
            Self::Area => "area",
            Self::Map => "map",
            Self::Door => "door",
        }
    }
}

impl TypeLists {
    #[must_use]
    pub fn list(&self, kind: TypeKind) -> &TypeList {
        match kind {
            TypeKind::Orthoframe => &self.orthoframe,
            TypeKind::Shape => &self.shape,
            TypeKind::Side => &self.side,
            TypeKind::Object => &self.object,
            TypeKind::Area => &self.area,
            TypeKind::Map => &self.map,
            TypeKind::Door => &self.door,
        }
    }

    pub fn list_mut(&mut self, kind: TypeKind) -> &mut TypeList {
        match kind {
            TypeKind::Orthoframe => &mut self.orthoframe,
            TypeKind::Shape => &mut self.shape,
            TypeKind::Side => &mut self.side,
            TypeKind::Object => &mut self.object,
            TypeKind::Area => &mut self.area,
            TypeKind::Map => &mut self.map,
            TypeKind::Door => &mut self.door,
        }
    }
}
