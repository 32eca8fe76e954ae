//! The words of a sentence, each with what it may be: a name or kind of the map, a value, a number, a word of a category.

use std::collections::HashMap;
use std::ops::Range;

use super::features::Features;
use super::grammar::{NOUN, NUMBER, PARTS, PROPERTY, SERVING, Tongue, VALUE};
use super::sense::{Meaning as Meant, Sense, Signatures};
use super::term::{Desc, Head, Mod, Quant, Sorts};
use crate::language::names::hints;
use crate::language::question::{Doing, Extension, KindId, Lexicon, Meaning, ValueId};
use crate::language::{Gender, Language, NounPhrase, Spelling, word_ranges};
use crate::map::{Entity, World};
use crate::semantics::Relations;
use crate::units::name_key;

/// A word or a comma.
#[derive(Debug, Clone)]
pub(crate) struct Token {
    pub(crate) key: String,
    pub(crate) at: Range<usize>,
}

impl Token {
    pub(crate) fn is_mark(&self) -> bool {
        self.key == "," || self.key == ":"
    }
}

/// A stretch of a sentence as one thing: of a category, with its agreement, its price and what it means.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Edge {
    pub(crate) category: u16,
    pub(crate) from: usize,
    pub(crate) to: usize,
    pub(crate) features: Features,
    pub(crate) cost: u32,
    pub(crate) sense: Sense,
}

/// Words of the longest name that is looked for.
const LONGEST_NAME: usize = 7;
/// Words of the longest activity, with what it is done to.
const LONGEST_ACTIVITY: usize = 8;
/// Marks at which a sentence ends.
const ENDS: [char; 5] = ['.', ';', '?', '!', '\n'];
/// Of more names alike the gender of each does not matter.
const FEW_NAMES: usize = 8;

/// A map as sentences speak of it.
#[derive(Debug, Clone, Copy)]
pub struct Map<'a> {
    pub world: &'a World,
    pub relations: &'a Relations,
    pub lexicon: &'a Lexicon,
    pub words: &'a MapWords,
}

/// Values of a map by their words, with what each form may be. Built once a map.
#[derive(Debug, Clone, Default)]
pub struct MapWords {
    values: HashMap<String, (ValueId, Features)>,
    longest: usize,
}

impl MapWords {
    /// The words of a map's values.
    #[must_use]
    pub fn of(lexicon: &Lexicon) -> Self {
        let mut forms: HashMap<ValueId, Vec<(String, Features)>> = HashMap::new();
        let mut words = Self::default();
        for (word, id) in lexicon.values.words() {
            let own = forms.entry(id).or_insert_with(|| {
                let all = Features::of_adjective(&lexicon.values.entry(id).russian).into_iter();
                all.map(|(form, features)| (name_key(&form), features)).collect()
            });
            let features = own.iter().find(|(form, _)| form == word).map(|(_, f)| *f);
            let features = features.unwrap_or(Features::ALL);
            words.longest = words.longest.max(word.split(' ').count());
            words.values.insert(word.to_owned(), (id, features));
        }
        words
    }
}

/// The tokens of one sentence; none where a mark within it says that it is several.
pub(crate) fn tokens(text: &str) -> Option<Vec<Token>> {
    let ends = |words: &[Range<usize>]| text[words[0].end..words[1].start].contains(ENDS);
    (!word_ranges(text).windows(2).any(ends)).then(|| tokens_across(text))
}

/// The tokens of a text, with a mark between its sentences as between its clauses.
pub(crate) fn tokens_across(text: &str) -> Vec<Token> {
    let mut found: Vec<Token> = Vec::new();
    let mut end = 0;
    for at in word_ranges(text) {
        let gap = &text[end..at.start];
        let key = name_key(&text[at.clone()]);
        if !found.is_empty() {
            if gap == "'" || gap == "’" {
                let last = found.last_mut().expect("it is not empty");
                // "What's", "isn't": the one is two words, the other one.
                if key == "t" {
                    last.key.push_str("'t");
                    last.at.end = at.end;
                    end = at.end;
                    continue;
                }
                found.push(Token { key: format!("'{key}"), at: at.clone() });
                end = at.end;
                continue;
            }
            if let Some(mark) = gap.find([',', ':']) {
                let place = end + mark..end + mark + 1;
                found.push(Token { key: text[place.clone()].to_owned(), at: place });
            } else if let Some(mark) = gap.find(ENDS) {
                found.push(Token { key: ",".to_owned(), at: end + mark..end + mark + 1 });
            }
        }
        found.push(Token { key, at: at.clone() });
        end = at.end;
    }
    found
}

/// What a kind of the lexicon is of; nothing for what no role takes.
pub(crate) fn sorts_of(extension: &Extension) -> Sorts {
    match extension {
        Extension::ObjectType(_)
        | Extension::Object(_)
        | Extension::Trait(_)
        | Extension::Things
        | Extension::Furniture
        | Extension::Lighting
        | Extension::Sort(_) => Sorts::THING,
        Extension::AreaType(_) | Extension::Rooms => Sorts::AREA,
        Extension::DoorType(_) | Extension::Doors => Sorts::OPENING,
        Extension::Places => Sorts::POINT,
        Extension::Storeys => Sorts::STOREY,
        Extension::Passages
        | Extension::Windows
        | Extension::Building
        | Extension::Floor
        | Extension::Walls
        | Extension::Corners
        | Extension::Exits
        | Extension::OuterDoors
        | Extension::Part(_)
        | Extension::Robot
        | Extension::Lifts
        | Extension::Chargers => Sorts::NONE,
    }
}

fn sorts_of_entity(entity: Entity) -> Sorts {
    match entity {
        Entity::Area(_) => Sorts::AREA,
        Entity::Door(_) => Sorts::OPENING,
        Entity::Replica(_) => Sorts::THING,
        Entity::Place(_) => Sorts::POINT,
        Entity::Map(_) => Sorts::STOREY,
        Entity::Zone(_) => Sorts::NONE,
    }
}

/// Where a sentence's words are looked up.
pub(crate) struct Sentence<'a> {
    pub(crate) text: &'a str,
    pub(crate) tokens: &'a [Token],
    pub(crate) language: Language,
    pub(crate) world: &'a World,
    pub(crate) lexicon: &'a Lexicon,
    pub(crate) words: &'a MapWords,
}

impl Sentence<'_> {
    /// All that single words and names may be.
    pub(crate) fn edges(&self, tongue: &Tongue, roles: &Signatures) -> Vec<Edge> {
        let mut edges = Vec::new();
        for from in 0..self.tokens.len() {
            let marks = self.tokens[from..].iter().position(Token::is_mark);
            let most = marks.unwrap_or(self.tokens.len() - from);
            self.nouns(from, most.min(LONGEST_NAME), &mut edges);
            self.activities(from, most, tongue, &mut edges);
            let mut key = String::new();
            let longest = tongue.longest.max(self.words.longest);
            for (n, token) in self.tokens[from..].iter().take(longest.max(1)).enumerate() {
                if !key.is_empty() {
                    key.push(' ');
                }
                key.push_str(&token.key);
                let mut add = |category, features, cost, sense| {
                    edges.push(Edge { category, from, to: from + n + 1, features, cost, sense });
                };
                for entry in tongue.words.get(&key).into_iter().flatten() {
                    match &entry.meaning {
                        Meant::Kind(name) => {
                            for (_, desc) in self.descriptions(name) {
                                let plural = entry.features.is_plural();
                                let sense = Sense::Desc(Desc { plural, ..desc });
                                add(entry.category, entry.features, entry.cost, sense);
                            }
                        }
                        Meant::Known(name) => {
                            if let Some(id) = self.lexicon.values.meaning(name) {
                                let sense = Sense::Mods(vec![Mod::Value(id)]);
                                add(entry.category, entry.features, entry.cost, sense);
                            }
                        }
                        meaning => {
                            if let Some(sense) = meaning.value(&[], roles) {
                                add(entry.category, entry.features, entry.cost, sense);
                            }
                        }
                    }
                }
                if let Some((id, features)) = self.words.values.get(&key) {
                    add(VALUE, *features, 0, Sense::Mods(vec![Mod::Value(*id)]));
                }
                if let Ok(number) = key.parse() {
                    add(NUMBER, Features::ALL, 0, Sense::Number(number));
                }
                let property = self.lexicon.values.properties().find(|(name, _)| *name == key);
                if let Some((_, property)) = property {
                    add(PROPERTY, Features::ALL, 0, Sense::Property(property.clone()));
                }
            }
        }
        edges
    }

    /// What serves for an activity that begins at a word. What it is done to need not be on the map, but is no word of
    /// the grammar: «порезать хлеб».
    fn activities(&self, from: usize, most: usize, tongue: &Tongue, edges: &mut Vec<Edge>) {
        let keys: Vec<String> = self.tokens[from..from + most]
            .iter()
            .take(LONGEST_ACTIVITY)
            .map(|t| t.key.clone())
            .collect();
        let Some(doing) = Doing::of(&keys) else { return };
        let mut ends = vec![from + doing.words];
        let object =
            doing.words + keys[doing.words..].iter().take_while(|key| Doing::passes(key)).count();
        if doing.takes_object && keys.get(object).is_some_and(|key| !tongue.words.contains_key(key))
        {
            ends.push(from + object + 1);
        }
        for (n, part) in PARTS.into_iter().enumerate() {
            let Some(kinds) = self.lexicon.serving(doing, part) else { continue };
            let desc = Desc {
                head: Head::Kinds(kinds),
                sorts: Sorts::THING,
                quant: Quant::Bare,
                plural: true,
                mods: Vec::new(),
            };
            for to in &ends {
                let category = SERVING + n as u16;
                let (features, sense) = (Features::ALL, Sense::Desc(desc.clone()));
                edges.push(Edge { category, from, to: *to, features, cost: 0, sense });
            }
        }
    }

    /// Names and kinds that begin at a word. A shorter one, where a longer begins too, has its price.
    fn nouns(&self, from: usize, most: usize, edges: &mut Vec<Edge>) {
        let mut longest = 0;
        for length in (1..=most).rev() {
            let to = from + length;
            let text = &self.text[self.tokens[from].at.start..self.tokens[to - 1].at.end];
            // A number alone names nothing.
            if text.chars().all(|c| c.is_ascii_digit()) {
                continue;
            }
            // «На какой столешнице 3 молока?»: what the number counts follows it.
            let ends_in_number = |(_, last): (&str, &str)| last.chars().all(char::is_numeric);
            if text.rsplit_once(' ').is_some_and(ends_in_number)
                && let Some(next) = self.tokens.get(to)
                && !self.descriptions(&self.text[next.at.clone()]).is_empty()
            {
                continue;
            }
            let found = self.descriptions(text);
            if found.is_empty() {
                continue;
            }
            let cost = u32::try_from(longest.max(length) - length).unwrap_or(u32::MAX);
            longest = longest.max(length);
            for (features, desc) in found {
                let sense = Sense::Desc(desc);
                edges.push(Edge { category: NOUN, from, to, features, cost, sense });
            }
        }
    }

    /// What a text may name, by what its form may be.
    fn descriptions(&self, text: &str) -> Vec<(Features, Desc)> {
        let hits = self.lexicon.find(text);
        let is_part = hits.iter().all(|hit| hit.spelling == Spelling::Part);
        let is_kind = hits.iter().any(|hit| matches!(hit.id, Meaning::Kind(_)));
        let is_named = hits.iter().any(|hit| matches!(hit.id, Meaning::Entity(_)));
        // What one of its meanings is not told by any relation is not told by the others alone; one name is.
        let is_beyond = hits.iter().any(|hit| match hit.id {
            Meaning::Kind(kind) => sorts_of(&self.lexicon.kind(*kind).extension).is_empty(),
            Meaning::Entity(_) => false,
        });
        // A kind wins over names of which its word is a part; else a word may be both.
        let of_names = is_named && !(is_kind && is_part);
        let is_few = hits.len() <= FEW_NAMES;
        let mut found: Vec<(Features, Sorts, Head)> = Vec::new();
        for hit in hits {
            let (gender, sorts, own) = match hit.id {
                Meaning::Entity(entity) if of_names => {
                    let gender = is_few.then(|| self.gender(*entity)).flatten();
                    (gender, sorts_of_entity(*entity), Head::Entities(vec![*entity]))
                }
                Meaning::Kind(kind) if !is_beyond => {
                    let own = self.lexicon.kind(*kind);
                    let gender = (self.language == Language::Russian).then(|| own.phrase.gender());
                    let sorts = sorts_of(&own.extension);
                    (gender, sorts, Head::Kinds(self.lexicon.with_narrower(*kind, self.language)))
                }
                _ => continue,
            };
            if sorts.is_empty() {
                continue;
            }
            let features = Features::of_noun(hit.readings, gender);
            if is_beyond && features.is_plural() {
                continue;
            }
            let same = found.iter_mut().find(|(f, s, _)| *f == features && *s == sorts);
            match (same, own) {
                (Some((_, _, Head::Entities(all))), Head::Entities(own)) => all.extend(own),
                (Some((_, _, Head::Kinds(all))), Head::Kinds(own)) => {
                    let new: Vec<KindId> = own.into_iter().filter(|k| !all.contains(k)).collect();
                    all.extend(new);
                }
                (_, own) => found.push((features, sorts, own)),
            }
        }
        let desc = |sorts, head, features: Features| Desc {
            head,
            sorts,
            quant: Quant::Bare,
            plural: features.is_plural(),
            mods: Vec::new(),
        };
        found.into_iter().map(|(f, sorts, head)| (f, desc(sorts, head, f))).collect()
    }

    fn gender(&self, entity: Entity) -> Option<Gender> {
        if self.language == Language::English {
            return None;
        }
        let phrase = NounPhrase::parse(self.world.name(entity), &hints(self.world, entity));
        Some(phrase.gender())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_sentence_is_cut_into_words_and_commas() {
        let keys =
            |text: &str| tokens(text).map(|all| all.into_iter().map(|t| t.key).collect::<Vec<_>>());
        let of = |all: &[&str]| Some(all.iter().map(|key| (*key).to_owned()).collect::<Vec<_>>());
        assert_eq!(
            keys("What's on it, isn't it?"),
            of(&["what", "'s", "on", "it", ",", "isn't", "it"])
        );
        assert_eq!(keys("Где Стол-1?"), of(&["где", "стол", "1"]));
        assert_eq!(keys("Где? Там."), None);
    }
}
