//! Names of the map with all their forms, and those whose forms are no more than a guess.

use crate::language::names::{hints, hints_of_type};
use crate::language::report::Named;
use crate::language::russian::{self, Preposition};
use crate::language::{Case, NounPhrase, Number, WordHints, english};
use crate::map::{Entity, World};

use super::lexicon::named;
use super::{Error, State};

impl State {
    /// A name with what the map knows of its forms: that of an entity, else that of a kind of thing, else as any word.
    ///
    /// # Errors
    /// There is no map.
    pub fn declined(&self, name: &str) -> Result<Named, Error> {
        let world = self.world()?;
        if let Some(entity) = world.find(name).first() {
            return Ok(named(world, *entity));
        }
        let key = crate::units::name_key(name);
        let kind = world
            .types
            .object
            .entries
            .values()
            .find(|kind| crate::units::name_key(&kind.name) == key);
        Ok(match kind {
            Some(kind) => {
                let english = Some(kind.name_en.as_str()).filter(|name| !name.is_empty());
                Named::new(&kind.name, &hints_of_type(kind), english)
            }
            None => Named::plain(name),
        })
    }
}

/// The names of a world that were declined by a mere guess from an ending, once each, in the order of the entities.
#[must_use]
pub(crate) fn uncertain_names(world: &World) -> Vec<NounPhrase> {
    let mut entities: Vec<Entity> = world.names().map(|(entity, _)| entity).collect();
    entities.dedup();
    let mut found: Vec<NounPhrase> = Vec::new();
    let mut seen = std::collections::HashSet::new();
    for entity in entities {
        let (name, hints) = (world.name(entity), hints(world, entity));
        // Of names that the map gives no forms of, the same name is declined once.
        if hints == WordHints::default() && !seen.insert(name) {
            continue;
        }
        let phrase = NounPhrase::parse(name, &hints);
        if !phrase.is_certain() {
            found.push(phrase);
        }
    }
    found
}

/// A name that stands in the plural has no other number.
pub(crate) fn numbers(phrase: &NounPhrase) -> &'static [Number] {
    if phrase.number() == Number::Plural { &[Number::Plural] } else { &Number::BOTH }
}

/// Where, where to, where from, towards and about.
pub(crate) fn prepositions(phrase: &NounPhrase) -> [(&'static str, String); 5] {
    [
        ("where", russian::where_at(phrase)),
        ("whither", russian::whither(phrase)),
        ("whence", russian::whence(phrase)),
        ("towards", russian::with(Preposition::K, Case::Dative, phrase)),
        ("about", russian::with(Preposition::O, Case::Prepositional, phrase)),
    ]
}

/// In a sentence, and of several.
pub(crate) fn english_forms(named: &Named) -> (String, String) {
    (named.english(), english::plural(named.english_name()))
}
