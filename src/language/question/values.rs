//! Values of properties as people say them: «чёрный», "wooden", «включена» – one value under all its words.

use std::collections::HashMap;
use std::sync::OnceLock;

use crate::map::{DoorStatus, Mark, World};
use crate::sets::Set;
use crate::units::{InOrder as _, name_key};
use crate::words::things::things;
use crate::words::{Case, Gender, Language, NounPhrase, Number, WordHints, russian};

/// What a property says of a thing.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Property {
    Colour,
    Material,
    State,
    Surface,
    Shape,
    Orientation,
    Weight,
    Price,
    Age,
    Temperature,
    Owner,
    Brand,
    /// What kind of thing it is, by its type.
    Kind,
    /// Any other, under the key of its name on the map.
    Other(String),
}

impl Property {
    /// By the name that `things.txt` gives it.
    fn called(name: &str) -> Option<Self> {
        Some(match name {
            "colour" => Self::Colour,
            "material" => Self::Material,
            "state" => Self::State,
            "surface" => Self::Surface,
            "shape" => Self::Shape,
            "orientation" => Self::Orientation,
            "weight" => Self::Weight,
            "price" => Self::Price,
            "age" => Self::Age,
            "temperature" => Self::Temperature,
            "owner" => Self::Owner,
            "brand" => Self::Brand,
            "kind" => Self::Kind,
            _ => return None,
        })
    }

    /// By the name that a map gives it, in either language.
    #[must_use]
    pub fn of(name: &str) -> Self {
        static KNOWN: OnceLock<HashMap<String, Property>> = OnceLock::new();
        let known = KNOWN.get_or_init(|| {
            let mut known = HashMap::new();
            for (property, name) in property_names() {
                known.entry(name_key(name)).or_insert(property);
            }
            // What is both open and on has two states, each under a name of its own.
            known.extend(Mark::Power.names().map(|name| (name_key(name), Self::State)));
            known
        });
        let key = name_key(name);
        known.get(&key).cloned().unwrap_or(Self::Other(key))
    }

    /// «цвет», "colour"
    #[must_use]
    pub fn noun(&self, language: Language) -> String {
        if let Self::Other(name) = self {
            let own = things().called.iter().find(|(ru, en)| ru == name || en == name);
            return own.map_or(name, |(ru, en)| language.pick(ru, en)).clone();
        }
        let mut own = property_names().filter(|(property, _)| property == self);
        let name = own.find(|(_, name)| Language::of(name) == language);
        name.map(|(_, name)| name.to_owned()).unwrap_or_default()
    }
}

/// Every name of a property that the program knows.
fn property_names() -> impl Iterator<Item = (Property, &'static str)> {
    things().properties.iter().flat_map(|(called, names)| {
        let property = Property::called(called);
        names.iter().filter_map(move |name| Some((property.clone()?, name.as_str())))
    })
}

/// A value under all its words.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ValueEntry {
    pub property: Property,
    /// The Russian adjective in the masculine, or the value as the map writes it.
    pub russian: String,
    /// What the value is called by itself: «дерево», «кожа»; empty where that is the adjective.
    pub noun: String,
    pub english: String,
}

impl ValueEntry {
    /// Empty, full, occupied: what can be seen from what is in or on a thing.
    #[must_use]
    pub fn is_emptiness(&self) -> bool {
        matches!(self.russian.as_str(), "пустой" | "полный" | "занятый")
    }
}

/// A value by its place in [`Values`].
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct ValueId(pub u16);

/// All values that the map or the language knows, and the words for them.
#[derive(Debug, Clone, Default)]
pub struct Values {
    entries: Vec<ValueEntry>,
    words: HashMap<String, ValueId>,
    /// Property names of the map and of the language, by key.
    properties: HashMap<String, Property>,
    longest: usize,
    /// Words of the longest way to ask for a property: «сколько весит».
    longest_property: usize,
}

impl Values {
    /// The language's values and those of the map.
    #[must_use]
    pub fn of(world: &World) -> Self {
        let mut values = Self::default();
        for (property, name) in property_names() {
            let key = name_key(name);
            values.longest_property = values.longest_property.max(key.split(' ').count());
            values.properties.insert(key, property);
        }
        for quality in &things().values {
            // A test reads every line.
            let Some(property) = Property::called(&quality.property) else { continue };
            let (others, english) = (&quality.others, &quality.english);
            let noun = match property {
                Property::Material => others.first().cloned().unwrap_or_default(),
                _ => String::new(),
            };
            let entry = ValueEntry {
                property,
                russian: quality.adjective.clone(),
                noun,
                english: english.first().cloned().unwrap_or_default(),
            };
            let id = values.add(entry);
            for form in adjective_forms(&quality.adjective) {
                values.name(&form, id);
            }
            for word in others.iter().chain(english) {
                values.name(word, id);
            }
        }
        for properties in all_properties(world) {
            for (name, value) in properties {
                values.learn(name, value);
            }
        }
        values
    }

    fn add(&mut self, entry: ValueEntry) -> ValueId {
        self.entries.push(entry);
        ValueId(u16::try_from(self.entries.len() - 1).unwrap_or(u16::MAX))
    }

    fn name(&mut self, word: &str, id: ValueId) {
        let key = name_key(word);
        self.longest = self.longest.max(key.split(' ').count());
        self.words.entry(key).or_insert(id);
    }

    /// A value of the map that the language does not list keeps the map's own word for it.
    fn learn(&mut self, name: &str, value: &str) {
        let property = Property::of(name);
        self.properties.entry(name_key(name)).or_insert_with(|| property.clone());
        if self.meaning(value).is_some()
            || self.entries.len() >= usize::from(u16::MAX)
            || value.trim().is_empty()
        {
            return;
        }
        let lower = value.to_lowercase();
        let english =
            if Language::of(value) == Language::English { lower.clone() } else { String::new() };
        let entry = ValueEntry { property, russian: lower.clone(), noun: lower.clone(), english };
        let id = self.add(entry);
        let forms = adjective_forms(&lower);
        if forms.is_empty() && Language::of(value) == Language::Russian {
            let phrase = NounPhrase::parse(&lower, &WordHints::default());
            for (_, _, form) in phrase.all_forms() {
                self.name(&form, id);
            }
        }
        for form in forms {
            self.name(&form, id);
        }
        self.name(value, id);
    }

    /// The value that a map's text stands for.
    #[must_use]
    pub fn meaning(&self, text: &str) -> Option<ValueId> {
        let key = name_key(text);
        // No words of their own: in a sentence "on" and "off" are mostly something else.
        let word = match &*key {
            "on" => "switched on",
            "off" => "switched off",
            word => word,
        };
        self.words.get(word).copied()
    }

    /// The word for a value that is most like a mistyped one.
    pub(super) fn near(&self, word: &str) -> Option<String> {
        let key = name_key(word);
        let likeness = |other: &str| strsim::normalized_damerau_levenshtein(&key, other);
        let all = self.words.keys().map(|other| (likeness(other), other));
        let best = all.max_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(a.1)));
        best.filter(|(likeness, _)| *likeness >= 0.75).map(|(_, word)| word.clone())
    }

    /// The longest value at the beginning of these words, with the number of words it takes.
    pub(super) fn longest(&self, words: &[String]) -> Option<(usize, ValueId)> {
        let most = self.longest.min(words.len());
        (1..=most).rev().find_map(|n| self.words.get(&words[..n].join(" ")).map(|id| (n, *id)))
    }

    /// The property whose name is the longest at the beginning of these words, with the number of words it takes.
    pub(super) fn property(&self, words: &[String]) -> Option<(usize, &Property)> {
        let most = self.longest_property.max(1).min(words.len());
        (1..=most).rev().find_map(|n| Some((n, self.properties.get(&words[..n].join(" "))?)))
    }

    /// # Panics
    /// When the id is not of these values.
    #[must_use]
    pub fn entry(&self, id: ValueId) -> &ValueEntry {
        &self.entries[usize::from(id.0)]
    }

    /// Every word for a value, in every form that is known of it.
    pub fn words(&self) -> impl Iterator<Item = (&str, ValueId)> {
        self.words.iter().map(|(word, id)| (word.as_str(), *id))
    }

    /// Every name of a property.
    pub fn properties(&self) -> impl Iterator<Item = (&str, &Property)> {
        self.properties.iter().map(|(name, property)| (name.as_str(), property))
    }

    /// The value of a door's state.
    #[must_use]
    pub fn of_door(&self, status: DoorStatus) -> Option<ValueId> {
        self.meaning(match status {
            DoorStatus::Open => "открыта",
            DoorStatus::Closed => "закрыта",
            DoorStatus::Locked => "заперта",
        })
    }

    /// Whether a thing of value `own` counts as `asked`: what is locked is closed, what is not locked may be open.
    #[must_use]
    pub fn is(&self, own: ValueId, asked: ValueId) -> bool {
        let adjective = |id: ValueId| self.entry(id).russian.as_str();
        own == asked
            || matches!(
                (adjective(own), adjective(asked)),
                ("запертый", "закрытый")
                    | ("открытый" | "закрытый", "отпертый")
                    | ("стальной", "металлический")
            )
    }

    /// Whether two values answer one question: red and blue do, open and dirty do not.
    #[must_use]
    pub fn answer_one_question(&self, a: ValueId, b: ValueId) -> bool {
        const STATES: [&[&str]; 6] = [
            &["включённый", "выключенный"],
            &["открытый", "закрытый", "запертый", "отпертый"],
            &["грязный", "чистый"],
            &["полный", "пустой"],
            &["сломанный"],
            &["занятый"],
        ];
        let (x, y) = (self.entry(a), self.entry(b));
        let sort = |v: &ValueEntry| STATES.iter().position(|all| all.contains(&&*v.russian));
        x.property == y.property && (x.property != Property::State || sort(x) == sort(y))
    }

    /// «чёрный», «чёрная», «чёрные»: the predicate about a noun of this gender and number.
    #[must_use]
    pub fn predicate(&self, id: ValueId, gender: Gender, number: Number) -> String {
        let entry = self.entry(id);
        let short = SHORT.meant().iter().find(|(adjective, _)| *adjective == entry.russian);
        match short {
            Some((_, stem)) => {
                let ending = match (number, gender) {
                    (Number::Plural, _) => "ы",
                    (_, Gender::Feminine) => "а",
                    (_, Gender::Neuter) => "о",
                    (_, Gender::Masculine) => "",
                };
                format!("{stem}{ending}")
            }
            None => russian::agreeing(&entry.russian, Case::Nominative, number, gender),
        }
    }
}

/// Participles that stand in their short form as predicates: «дверь открыта».
static SHORT: Set = Set::named("ShortParticiple");

fn all_properties(world: &World) -> impl Iterator<Item = &crate::map::Properties> {
    let objects = world.objects.values().map(|o| &o.properties);
    let replicas = world.replicas.values().map(|r| &r.properties);
    let areas = world.areas.values().map(|a| &a.properties);
    let doors = world.doors.values().map(|d| &d.properties);
    objects.chain(replicas).chain(areas).chain(doors).filter(|p| !p.is_empty())
}

/// All forms of an adjective given in any nominative; none when it is no adjective.
fn adjective_forms(adjective: &str) -> Vec<String> {
    let lower = adjective.to_lowercase();
    let masculine =
        russian::agreeing(&lower, Case::Nominative, Number::Singular, Gender::Masculine);
    let feminine = russian::agreeing(&lower, Case::Nominative, Number::Singular, Gender::Feminine);
    if masculine == feminine {
        return Vec::new();
    }
    let mut forms = Vec::new();
    for case in Case::SIX {
        for gender in [Gender::Masculine, Gender::Feminine, Gender::Neuter] {
            forms.push(russian::agreeing(&lower, case, Number::Singular, gender));
        }
        forms.push(russian::agreeing(&lower, case, Number::Plural, Gender::Masculine));
    }
    forms.order();
    forms.dedup();
    forms
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_property_of_the_file_is_one_that_the_program_knows() {
        for name in things().properties.iter().map(|(name, _)| name) {
            assert!(Property::called(name).is_some(), "{name}");
        }
        assert_eq!(Property::of("Цвет").noun(Language::English), "colour");
    }
}
