//! What `things.txt` says: words for one sort of thing, sorts of things, and what people do with them.
//!
//! Invariant: every line reads (a test parses all of them); sorts and activities keep the order of the file, which tells what
//! goes before.

use std::sync::OnceLock;

use super::list::Language;
use crate::units::{Carried, carried};

static TEXT: Carried = carried!("things.txt");

/// What part things of a sort have in what is done, after the thematic roles of verbs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Role {
    /// What it is done to: what is eaten or read.
    Patient,
    /// What is moved or switched by it.
    Theme,
    /// With what: what cuts, writes, wipes.
    Instrument,
    /// Out of what: what one drinks from.
    Source,
    /// Where, in or on what.
    Location,
}

/// A sort of things: the words for it, its part in what is done, and the kinds that belong to it.
#[derive(Debug)]
pub(crate) struct Sort {
    /// The first is what such things are counted by.
    pub(crate) russian: Vec<String>,
    pub(crate) english: Vec<String>,
    pub(crate) role: Role,
    /// Names of kinds, in either language, or of sorts listed before.
    pub(crate) members: Vec<String>,
}

impl Sort {
    /// Whether people call such things so: tools and places are told by what is done with them.
    pub(crate) fn is_spoken(&self) -> bool {
        matches!(self.role, Role::Patient | Role::Theme)
    }
}

/// Phrases of something that is done, «…» for what it is done to, and the English names of the sorts that serve for it.
#[derive(Debug)]
pub(crate) struct Activity {
    pub(crate) said: Vec<String>,
    pub(crate) sorts: Vec<String>,
}

#[derive(Debug, Default)]
pub(crate) struct Things {
    /// Names of one sort of thing each.
    pub(crate) same: Vec<Vec<String>>,
    /// The number of a sort is its place here.
    pub(crate) sorts: Vec<Sort>,
    /// Words that may stand before what an activity is done to.
    pub(crate) between: Vec<String>,
    /// Forms that stand for one another, the first for all.
    pub(crate) forms: Vec<Vec<String>>,
    pub(crate) activities: Vec<Activity>,
    /// Names of properties: what the program calls one, and the words for it.
    pub(crate) properties: Vec<(String, Vec<String>)>,
    /// Names of properties that nobody asks for by a word of their own, as imports and maps give them, in both languages.
    pub(crate) called: Vec<(String, String)>,
    pub(crate) values: Vec<Quality>,
    /// Words of names that programs give, with their Russian: a noun, or the masculine of an adjective.
    pub(crate) identifiers: Vec<(String, String)>,
}

/// A value with the property that it belongs to.
#[derive(Debug)]
pub(crate) struct Quality {
    /// As [`Things::properties`] call it.
    pub(crate) property: String,
    /// The Russian adjective in the masculine.
    pub(crate) adjective: String,
    /// Other Russian forms; of a material its noun first.
    pub(crate) others: Vec<String>,
    pub(crate) english: Vec<String>,
}

/// What the file says.
pub(crate) fn things() -> &'static Things {
    static THINGS: OnceLock<Things> = OnceLock::new();
    THINGS.get_or_init(|| {
        let mut things = Things::default();
        for entry in entries(&TEXT) {
            // A test reads every one.
            let _ = things.add(&entry);
        }
        things
    })
}

/// Lines of such a file with those that go on with them.
pub(crate) fn entries(text: &str) -> Vec<String> {
    let mut found: Vec<String> = Vec::new();
    for line in text.lines().filter(|line| !line.trim().is_empty() && !line.starts_with('#')) {
        match found.last_mut() {
            Some(last) if line.starts_with(' ') => {
                last.push(' ');
                last.push_str(line.trim());
            }
            _ => found.push(line.trim().to_owned()),
        }
    }
    found
}

/// What stands between «|».
pub(crate) fn words(text: &str) -> Vec<String> {
    text.split('|').map(|word| word.trim().to_owned()).filter(|w| !w.is_empty()).collect()
}

impl Things {
    fn add(&mut self, entry: &str) -> Option<()> {
        let (what, rest) = entry.split_once(' ')?;
        match what {
            "same" => self.same.push(words(rest)),
            "forms" => self.forms.push(words(rest)),
            "between" => self.between.extend(words(rest)),
            "activity" => {
                let (said, sorts) = rest.split_once(" : ")?;
                self.activities.push(Activity { said: words(said), sorts: words(sorts) });
            }
            "sort" => {
                let mut parts = rest.split(" : ");
                let (names, role) = (words(parts.next()?), parts.next()?);
                let members = words(parts.next()?);
                let (russian, english) =
                    names.into_iter().partition(|name| Language::of(name) == Language::Russian);
                let role = match role.trim() {
                    "patient" => Role::Patient,
                    "theme" => Role::Theme,
                    "instrument" => Role::Instrument,
                    "source" => Role::Source,
                    "location" => Role::Location,
                    _ => return None,
                };
                self.sorts.push(Sort { russian, english, role, members });
            }
            "property" => {
                let (name, said) = rest.split_once(" : ")?;
                self.properties.push((name.to_owned(), words(said)));
            }
            "called" => {
                let (russian, english) = rest.split_once(" : ")?;
                self.called.push((russian.to_owned(), english.to_owned()));
            }
            "identifier" => {
                let (english, russian) = rest.split_once(" : ")?;
                self.identifiers.push((english.to_owned(), russian.to_owned()));
            }
            "value" => {
                let parts: Vec<&str> = rest.split(" : ").collect();
                let [property, adjective, others, english] = parts[..] else { return None };
                let (others, english) = (words(others), words(english));
                let (property, adjective) = (property.to_owned(), adjective.to_owned());
                self.values.push(Quality { property, adjective, others, english });
            }
            _ => return None,
        }
        Some(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_reads_and_every_sort_has_words_in_both_languages() {
        for entry in entries(&TEXT) {
            assert!(Things::default().add(&entry).is_some(), "{entry}");
        }
        for sort in &things().sorts {
            assert!(!sort.russian.is_empty() && !sort.english.is_empty(), "{sort:?}");
        }
        let Things { properties, values, .. } = things();
        for value in values {
            assert!(properties.iter().any(|(name, _)| *name == value.property), "{value:?}");
            assert!(!value.english.is_empty(), "{value:?}");
        }
        for activity in &things().activities {
            assert!(!activity.said.is_empty() && !activity.sorts.is_empty(), "{activity:?}");
        }
    }
}
