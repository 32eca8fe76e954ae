//! Properties that the program itself understands, by their names in either language, whatever the case.

use super::Properties;

/// What a property says to the program. All others are words for people.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// Whether a device is on, where its state says something else already.
    Power,
    /// On or off, open or shut.
    State,
    /// The door that a thing unlocks.
    KeyOf,
    /// The person who has the key of a door.
    KeyWith,
    /// The thing on or in which a thing belongs.
    KeptOn,
    /// Whether there is light in a room by itself.
    Light,
    /// Where in an imported file something stands: for programs, and not told.
    Source,
    /// That the size of an Object is the usual one of its kind, which nobody measured.
    UsualSize,
}

impl Mark {
    /// The Russian name, then the English one.
    #[must_use]
    pub const fn names(self) -> [&'static str; 2] {
        match self {
            Self::Power => ["ПИТАНИЕ", "power"],
            Self::State => ["СОСТОЯНИЕ", "state"],
            Self::KeyOf => ["КЛЮЧ_ОТ", "key_of"],
            Self::KeyWith => ["КЛЮЧ_У", "key_with"],
            Self::KeptOn => ["ХРАНИТСЯ_НА", "kept_on"],
            Self::Light => ["СВЕТ", "light"],
            Self::Source => ["ИСТОЧНИК", "source"],
            Self::UsualSize => ["ОБЫЧНЫЙ_РАЗМЕР", "usual_size"],
        }
    }

    /// The property as it is written, name and value.
    #[must_use]
    pub fn of(self, properties: &Properties) -> Option<(&str, &str)> {
        // Of each name mostly one letter is looked at: this is asked of every thing of a hospital.
        let lower = |text: &'static str| text.chars().flat_map(char::to_lowercase);
        let is_it = |name: &str| {
            let own = || name.chars().flat_map(char::to_lowercase);
            self.names().iter().any(|known| own().eq(lower(known)))
        };
        properties.iter().find(|(name, _)| is_it(name)).map(|(name, value)| (&**name, &**value))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_mark_is_known_in_both_languages_and_any_case() {
        for name in ["КЛЮЧ_ОТ", "Ключ_от", "key_of", "KEY_OF"] {
            let properties = Properties::from([(name.to_owned(), "Дверь-1".to_owned())]);
            assert_eq!(Mark::KeyOf.of(&properties), Some((name, "Дверь-1")));
            assert_eq!(Mark::KeptOn.of(&properties), None);
        }
    }
}
