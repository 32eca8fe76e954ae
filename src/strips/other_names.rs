//! What objects are called beside their names, as a map does in another language.

use std::collections::HashMap;

use crate::units::name_key;

/// Other names of objects, by their keys.
#[derive(Debug, Clone, Default)]
pub(super) struct OtherNames(HashMap<String, OtherName>);

#[derive(Debug, Clone)]
struct OtherName {
    spelt: String,
    of: String,
}

impl OtherNames {
    /// Of pairs of a name and another. For blanks hyphens do as well. What several objects are called, and what is the name
    /// of one, means none by its other name.
    pub(super) fn of<'n>(pairs: impl IntoIterator<Item = (&'n str, &'n str)>) -> Self {
        let mut all: HashMap<String, Option<OtherName>> = HashMap::new();
        for (name, other) in pairs {
            all.insert(name_key(name), None);
            for spelt in [other.to_owned(), other.replace(' ', "-")] {
                let new = || Some(OtherName { spelt: spelt.clone(), of: name.to_owned() });
                let means = all.entry(name_key(&spelt)).or_insert_with(new);
                *means = means.take().filter(|known| known.of == name);
            }
        }
        Self(all.into_iter().filter_map(|(key, means)| Some((key, means?))).collect())
    }

    /// The name of what is called so.
    pub(super) fn first(&self, other: &str) -> Option<&str> {
        self.0.get(&name_key(other)).map(|known| known.of.as_str())
    }

    /// Each other name's key with the name.
    pub(super) fn keys(&self) -> impl Iterator<Item = (&str, &str)> {
        self.0.iter().map(|(key, known)| (key.as_str(), known.of.as_str()))
    }

    /// All as they are spelt, for hints.
    pub(super) fn spelt(&self) -> impl Iterator<Item = &str> {
        self.0.values().map(|known| known.spelt.as_str())
    }
}
