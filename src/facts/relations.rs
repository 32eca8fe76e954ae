//! Relations as declared: their numbers, columns, names and what is asked of them.

use std::collections::HashMap;

use super::syntax::Kind;
use crate::units::name_key;

/// A relation of a program, by position.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct RelationId(pub(super) u32);

impl RelationId {
    pub(super) fn index(self) -> usize {
        self.0 as usize
    }
}

/// A column of a relation, as declared.
#[derive(Debug, Clone)]
pub struct Column {
    pub name: String,
    pub kind: Kind,
    /// The declared type: `symbol`, `number`, `unsigned`, `float` or one that `.type` introduced.
    pub type_name: String,
}

/// A relation, as declared.
#[derive(Debug, Clone, Default)]
pub struct RelationInfo {
    pub name: String,
    /// The name in a second language, where the declaration gives one.
    pub second_name: Option<String>,
    pub columns: Vec<Column>,
    /// `.input`, each time that it is said, with its parameters.
    pub inputs: Vec<Parameters>,
    /// `.output`, each time that it is said, with its parameters.
    pub outputs: Vec<Parameters>,
    pub print_size: bool,
    /// `.limitsize`: evaluation of the relation stops at so many tuples.
    pub limit_size: Option<usize>,
    /// `choice-domain`: of the tuples that agree in all columns of one of these, the first that is found stays.
    pub choices: Vec<Vec<usize>>,
}

/// `filename="…"`, `delimiter="…"` and the like.
pub type Parameters = Vec<(String, String)>;

/// Relations by both names.
#[derive(Debug, Clone, Default)]
pub(super) struct Names {
    exact: HashMap<String, RelationId>,
    /// By [`name_key`]; none where several relations share the key.
    keys: HashMap<String, Option<RelationId>>,
}

impl Names {
    pub(super) fn find(&self, name: &str) -> Option<RelationId> {
        let exact = self.exact.get(name).copied();
        exact.or_else(|| self.keys.get(&name_key(name)).copied().flatten())
    }

    /// False when the very name is taken.
    pub(super) fn insert(&mut self, name: &str, relation: RelationId) -> bool {
        if self.exact.contains_key(name) {
            return false;
        }
        self.exact.insert(name.to_owned(), relation);
        let key = self.keys.entry(name_key(name)).or_insert(Some(relation));
        if *key != Some(relation) {
            *key = None;
        }
        true
    }

    pub(super) fn all(&self) -> impl Iterator<Item = &str> {
        self.exact.keys().map(String::as_str)
    }
}
