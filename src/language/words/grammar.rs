//! The grammatical categories that a word form is asked for by.

use std::collections::BTreeMap;

/// The six cases of the school, and the form after «в» or «на» where a word keeps one («в шкафу»).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Case {
    Nominative,
    Genitive,
    Dative,
    Accusative,
    Instrumental,
    Prepositional,
    /// As the prepositional, except for the words with a form of place: «о шкафе», but «в шкафу».
    Locative,
}

impl Case {
    /// The six cases of the school, in its order.
    pub const SIX: [Self; 6] = [
        Self::Nominative,
        Self::Genitive,
        Self::Dative,
        Self::Accusative,
        Self::Instrumental,
        Self::Prepositional,
    ];
    /// All that a form may be asked for.
    pub const ALL: [Self; 7] = [
        Self::Nominative,
        Self::Genitive,
        Self::Dative,
        Self::Accusative,
        Self::Instrumental,
        Self::Prepositional,
        Self::Locative,
    ];

    /// The case by its Russian or English name, whole or by the first letters that the map file may use.
    ///
    /// ```
    /// use orthoframe_language::Case;
    /// assert_eq!(Case::named("родительный"), Some(Case::Genitive));
    /// assert_eq!(Case::named("gen"), Some(Case::Genitive));
    /// assert_eq!(Case::named("звательный"), None);
    /// ```
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|case| {
            let (russian, english) = case.names();
            [russian, english].into_iter().any(|whole| abbreviates(name, whole))
        })
    }

    /// Its Russian and English name.
    #[must_use]
    pub fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::Nominative => ("именительный", "nominative"),
            Self::Genitive => ("родительный", "genitive"),
            Self::Dative => ("дательный", "dative"),
            Self::Accusative => ("винительный", "accusative"),
            Self::Instrumental => ("творительный", "instrumental"),
            Self::Prepositional => ("предложный", "prepositional"),
            Self::Locative => ("местный", "locative"),
        }
    }

    pub(crate) fn index(self) -> usize {
        self as usize
    }
}

/// One or many.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Number {
    #[default]
    Singular,
    Plural,
}

impl Number {
    pub const BOTH: [Self; 2] = [Self::Singular, Self::Plural];

    /// «единственное», «множественное», or in English, or their first letters.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        one_of(
            name,
            [
                (["единственное", "singular"], Self::Singular),
                (["множественное", "plural"], Self::Plural),
            ],
        )
    }

    /// Its Russian and English name.
    #[must_use]
    pub fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::Singular => ("единственное", "singular"),
            Self::Plural => ("множественное", "plural"),
        }
    }

    pub(crate) fn index(self) -> usize {
        self as usize
    }
}

/// Grammatical gender.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Gender {
    Masculine,
    Feminine,
    Neuter,
}

impl Gender {
    /// «мужской», «женский», «средний», or in English, or their first letters.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        one_of(
            name,
            [
                (["мужской", "masculine"], Self::Masculine),
                (["женский", "feminine"], Self::Feminine),
                (["средний", "neuter"], Self::Neuter),
            ],
        )
    }

    /// Its Russian and English name.
    #[must_use]
    pub fn names(self) -> (&'static str, &'static str) {
        match self {
            Self::Masculine => ("мужской", "masculine"),
            Self::Feminine => ("женский", "feminine"),
            Self::Neuter => ("средний", "neuter"),
        }
    }
}

/// Whether the accusative is that of a living being («вижу робота») or of a thing («вижу стол»).
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum Animacy {
    #[default]
    Inanimate,
    Animate,
}

impl Animacy {
    /// «одушевлённое», «неодушевлённое», or in English, or their first letters.
    #[must_use]
    pub fn named(name: &str) -> Option<Self> {
        one_of(
            name,
            [
                (["одушевлённое", "animate"], Self::Animate),
                (["неодушевлённое", "inanimate"], Self::Inanimate),
            ],
        )
    }
}

/// The preposition that goes with a place: «в коридоре», but «на кухне».
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub enum PlaceSense {
    /// в – в – из
    #[default]
    Inside,
    /// на – на – с
    Upon,
}

/// Where a form comes from, from the most to the least reliable.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Evidence {
    /// The map gives it.
    Given,
    /// The word list of this folder knows the word.
    Lexicon,
    /// The dictionary knows it.
    Dictionary,
    /// The ending leaves no doubt: «-ция», Latin letters, digits.
    Rule,
    /// The ending suggests it.
    Guess,
}

/// What the map says of a name, so that nothing need be guessed. All of it is optional.
#[derive(Debug, Clone, PartialEq, Eq, Default)]
pub struct WordHints {
    pub gender: Option<Gender>,
    pub animacy: Option<Animacy>,
    /// The number that the name itself stands in: plural for «Полки».
    pub number: Option<Number>,
    pub place: Option<PlaceSense>,
    /// Whole forms of the whole name, taken as they are.
    pub forms: BTreeMap<(Number, Case), String>,
}

/// The first of these whose Russian or English name a text is, or begins.
fn one_of<T, const N: usize>(text: &str, named: [([&str; 2], T); N]) -> Option<T> {
    let fits = |(names, _): &([&str; 2], T)| names.iter().any(|whole| abbreviates(text, whole));
    named.into_iter().find(fits).map(|(_, value)| value)
}

/// Whether `short` is `whole` or begins it; case and ё do not matter.
fn abbreviates(short: &str, whole: &str) -> bool {
    let short = crate::units::name_key(short);
    let short = short.trim_end_matches('.');
    !short.is_empty() && crate::units::name_key(whole).starts_with(short)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn categories_are_known_by_their_first_letters() {
        assert_eq!(Case::named("р"), Some(Case::Genitive));
        assert_eq!(Case::named("Тв."), Some(Case::Instrumental));
        assert_eq!(Gender::named("ж"), Some(Gender::Feminine));
        assert_eq!(Gender::named("neuter"), Some(Gender::Neuter));
        assert_eq!(Number::named("мн"), Some(Number::Plural));
        assert_eq!(Animacy::named("одуш"), Some(Animacy::Animate));
        assert_eq!(
            (Gender::named(""), Case::named("."), Number::named("двойственное")),
            (None, None, None)
        );
    }
}
