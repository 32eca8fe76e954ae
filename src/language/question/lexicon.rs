//! The nouns of a map: names of things, kinds of things, and the words for things in general.
//!
//! Built once a map. Names and kinds stand in one [`FormIndex`]; a kind with an adjective before it («Письменный стол»)
//! is one of its head's kinds too, so that a desk is among «столы».

use std::collections::{BTreeSet, HashMap};

use crate::map::{Entity, Object, TypeEntry, World};
use crate::names::{chargers, english_name, hints, hints_of_type};
use crate::sets::{Set, named, of_kind, set};
use crate::units::{Gather as _, InOrder as _, ObjectId, TypeId, name_key};
use crate::words::things::things;
use crate::words::{
    FormIndex, Hit, Language, NounPhrase, Number, WordHints, english, everyday, word_keys,
};

use super::memo::Memo;
use super::purposes;
use super::values::Values;
pub use super::windows::Window;
use super::windows::windows;

/// A kind by its place in the lexicon.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub struct KindId(pub u16);

/// What belongs to a kind.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Extension {
    ObjectType(TypeId),
    Object(ObjectId),
    AreaType(TypeId),
    DoorType(TypeId),
    /// Replicas whose type has this trait.
    Trait(&'static str),
    Things,
    /// Things that are not portable.
    Furniture,
    Rooms,
    Doors,
    Passages,
    Windows,
    Places,
    Storeys,
    Building,
    Floor,
    Walls,
    /// Where two walls of a room meet.
    Corners,
    /// Ways out of what is spoken of: of a room, whatever opens on it; of the building, what leads out of the map.
    Exits,
    /// Doors and passages that lead out of the map, whatever room they are of.
    OuterDoors,
    /// Parts of objects of this type, which are no things by themselves: legs, armrests.
    Part(TypeId),
    Robot,
    /// What gives light, and the switches for it.
    Lighting,
    /// A sort above the map's types, by its place among the sorts that people name.
    Sort(u16),
    /// Cabins that go from storey to storey.
    Lifts,
    /// Places and things that robots charge at.
    Chargers,
}

/// A kind with its words.
#[derive(Debug, Clone)]
pub struct Kind {
    pub extension: Extension,
    pub phrase: NounPhrase,
    pub english: String,
}

/// What a noun may mean.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum Meaning {
    Entity(Entity),
    Kind(KindId),
}

named!(Extension: Things Furniture Rooms Doors Passages Windows Places Storeys Building Floor Walls Corners Exits OuterDoors
    Lighting Chargers);

/// General nouns of the language files: what each means, and the words for it. A name in small letters is a trait's.
fn concepts() -> Vec<(Extension, Vec<&'static str>)> {
    let mut found: Vec<(Extension, Vec<&str>)> = Vec::new();
    for (name, word) in of_kind("Concept.") {
        let extension = Extension::named(name).unwrap_or(Extension::Trait(name));
        match found.iter_mut().find(|(own, _)| *own == extension) {
            Some((_, words)) => words.push(word),
            None => found.push((extension, vec![word])),
        }
    }
    found
}

/// Nouns of what is not counted, so that answers count by another noun of the same sort.
static MASS: Set = Set::named("MassKind");

/// All nouns of a map.
#[derive(Debug)]
pub struct Lexicon {
    pub(super) nouns: FormIndex<Meaning>,
    pub(super) kinds: Vec<Kind>,
    /// Kinds that a head word covers beside its own: «стол» – «Письменный стол».
    narrower: HashMap<(bool, String), Vec<KindId>>,
    /// English words that the map itself gives to its types, as keys.
    own_english: BTreeSet<String>,
    /// The kinds of each sort, the sort itself first.
    sorts: Vec<Vec<KindId>>,
    pub values: Values,
    pub windows: Vec<Window>,
    /// What is like a word that nothing knows, by the word.
    alike: Memo<Vec<String>>,
}

impl Lexicon {
    /// Names and values that a word is like which nothing knows, the likest first.
    pub(super) fn alike(&self, said: &str) -> Vec<String> {
        self.alike.of(said, || {
            // A word within a word is not like it: "table" in "comfortable".
            let key = name_key(said);
            let like = |name: &&str| {
                let name = name_key(name);
                name.split([' ', '-', '_'])
                    .chain([name.as_str()])
                    .any(|word| strsim::normalized_damerau_levenshtein(word, &key) >= 0.65)
            };
            // Letters that look alike make «тен» of "teh": a word is like those of its own alphabet.
            let latin = |text: &str| text.starts_with(|c: char| c.is_ascii());
            let mut near: Vec<String> = Vec::new();
            let alike = self.nouns.near(said, 3).into_iter().filter(like);
            for name in alike.filter(|name| latin(name) == latin(said)) {
                if !near.iter().any(|n| n == name) {
                    near.push(name.to_owned());
                }
            }
            if near.is_empty() {
                near.extend(self.values.near(said));
            }
            near
        })
    }

    /// The nouns of a world.
    #[must_use]
    pub fn of(world: &World) -> Self {
        let mut lexicon = Self {
            nouns: FormIndex::default(),
            kinds: Vec::new(),
            narrower: HashMap::new(),
            own_english: BTreeSet::new(),
            sorts: Vec::new(),
            values: Values::of(world),
            windows: windows(world),
            alike: Memo::default(),
        };
        for entity in world.names().map(|(entity, _)| entity).gather::<BTreeSet<_>>() {
            let name = world.name(entity);
            let meaning = Meaning::Entity(entity);
            // On the floor is on the ground, whatever a storey is called.
            if name.is_empty() || (matches!(entity, Entity::Map(_)) && is_of_floor(name)) {
                continue;
            }
            if Language::of(name) == Language::English {
                lexicon.nouns.insert_english(name, meaning);
            } else {
                lexicon.nouns.insert_name(name, &hints(world, entity), meaning);
            }
            let english = english_name(world, entity);
            if matches!(entity, Entity::Map(_)) && is_of_floor(english) {
                continue;
            }
            if english.is_empty() {
                if let Some(english) = english::name_of(name)
                    && !(matches!(entity, Entity::Map(_)) && is_of_floor(&english))
                {
                    lexicon.nouns.insert_english(&english, meaning);
                }
            } else {
                lexicon.nouns.insert_english(english, meaning);
            }
        }
        let used = used_types(world);
        let entries = [&world.types.object, &world.types.area];
        let entries = entries.into_iter().flat_map(|list| list.entries.values());
        let words = entries.flat_map(|e| e.synonyms.iter().chain([&e.name_en]));
        lexicon.own_english = words.map(|word| name_key(word)).collect();
        for (list, make) in [
            (&world.types.object, Extension::ObjectType as fn(TypeId) -> Extension),
            (&world.types.area, Extension::AreaType),
            (&world.types.door, Extension::DoorType),
        ] {
            for entry in list.entries.values().filter(|e| used.contains(&make(e.id).into_key())) {
                lexicon.add_type(make(entry.id), entry);
            }
        }
        let of_type: HashMap<&str, ()> =
            world.types.object.entries.values().map(|e| (e.name.as_str(), ())).collect();
        for object in world.objects.values() {
            if of_type.contains_key(object.name.as_str()) {
                lexicon.add_sort_of_type(world, object);
            } else if !object.name.is_empty() {
                let phrase = NounPhrase::parse(&object.name, &WordHints::default());
                lexicon.add(Extension::Object(object.id), &phrase, &object.name_en, false);
            }
        }
        lexicon.add_heads();
        lexicon.add_concepts(world);
        lexicon.add_building(world);
        lexicon.add_lifts(world);
        lexicon.add_sorts();
        lexicon.add_parts(world);
        lexicon
    }

    /// A "nurse desk" is a sort of desk, which Russian has no word of its own for; a "metal cabinet" is any that is of metal.
    fn add_sort_of_type(&mut self, world: &World, object: &Object) {
        let kind = world.types.object.get(object.object_type);
        let own = name_key(&object.name_en);
        let is_own = kind.is_some_and(|kind| name_key(&kind.name_en) != own);
        let is_valued = self.values.longest(&word_keys(&object.name_en)).is_some();
        if is_own && !own.is_empty() && !is_valued && !self.own_english.contains(&own) {
            let phrase = NounPhrase::parse(&object.name, &WordHints::default());
            let id = self.push(Extension::Object(object.id), phrase, &object.name_en);
            self.nouns.insert_english(&object.name_en, Meaning::Kind(id));
        }
    }

    /// Types of the Orthoframes that objects consist of.
    fn add_parts(&mut self, world: &World) {
        let items = world.objects.values().flat_map(|o| &o.items);
        let types: BTreeSet<TypeId> =
            items.filter_map(|item| world.orthoframes.get(&item.orthoframe)?.frame_type).gather();
        for id in types {
            let Some(entry) = world.types.orthoframe.get(Some(id)) else { continue };
            // «предмет» is any thing, not a part.
            let general = self.nouns.find(&entry.name).iter().any(|hit| match hit.id {
                Meaning::Kind(kind) => {
                    !matches!(self.kind(*kind).extension, Extension::ObjectType(_))
                }
                Meaning::Entity(_) => false,
            });
            if general {
                continue;
            }
            self.add_type(Extension::Part(id), entry);
        }
    }

    fn add_type(&mut self, extension: Extension, entry: &TypeEntry) {
        let phrase = NounPhrase::parse(&entry.name, &hints_of_type(entry));
        self.add(extension, &phrase, &entry.name_en, true);
        if matches!(extension, Extension::DoorType(_)) {
            self.add_doors_of(extension, entry);
        }
        for synonym in &entry.synonyms {
            match Language::of(synonym) {
                Language::Russian => {
                    let phrase = NounPhrase::parse(synonym, &WordHints::default());
                    self.add(extension, &phrase, "", false);
                }
                Language::English => {
                    let own = NounPhrase::parse(&entry.name, &hints_of_type(entry));
                    let id = self.push(extension, own, synonym);
                    self.nouns.insert_english(synonym, Meaning::Kind(id));
                }
            }
        }
    }

    /// «раздвижная дверь», "sliding door": sorts of doors are called by adjectives, with the noun or without it.
    fn add_doors_of(&mut self, extension: Extension, entry: &TypeEntry) {
        let doors = of_kind("Concept.").filter(|(name, _)| *name == "Doors");
        for (_, door) in doors {
            let language = Language::of(door);
            let name = language.pick(&entry.name, &entry.name_en);
            let whole = format!("{} {door}", name.to_lowercase());
            if name.is_empty() || Language::of(name) != language || name_key(name).contains(door) {
                continue;
            }
            match language {
                Language::Russian => {
                    let phrase = NounPhrase::parse(&whole, &WordHints::default());
                    let id = self.push(extension, phrase.clone(), &entry.name_en);
                    self.nouns.insert(&phrase, Meaning::Kind(id));
                }
                Language::English => {
                    let own = NounPhrase::parse(&entry.name, &hints_of_type(entry));
                    let id = self.push(extension, own, &whole);
                    self.nouns.insert_english(&whole, Meaning::Kind(id));
                }
            }
        }
    }

    pub(super) fn push(
        &mut self,
        extension: Extension,
        phrase: NounPhrase,
        english: &str,
    ) -> KindId {
        let id = KindId(u16::try_from(self.kinds.len()).unwrap_or(u16::MAX));
        let english = match english {
            "" => english::name_of(phrase.name()).unwrap_or_else(|| phrase.name().to_owned()),
            _ => english.to_owned(),
        };
        self.kinds.push(Kind { extension, phrase, english: lower_words(&english) });
        id
    }

    /// Adds a kind; `own` for the name of a type, whose head then covers it.
    fn add(&mut self, extension: Extension, phrase: &NounPhrase, english_name: &str, own: bool) {
        if self.kinds.len() >= usize::from(u16::MAX) {
            return;
        }
        let id = self.push(extension, phrase.clone(), english_name);
        if Language::of(phrase.name()) == Language::English {
            self.nouns.insert_english(phrase.name(), Meaning::Kind(id));
            // A map of others knows no Russian: the language's own words for the thing serve.
            for word in english::russian_of(phrase.name()) {
                let russian = NounPhrase::parse(word, &WordHints::default());
                let id = self.push(extension, russian.clone(), phrase.name());
                self.nouns.insert(&russian, Meaning::Kind(id));
                // «стол» for a desk, which the map calls by one word.
                if let Some(head) = russian.head().filter(|head| own && *head != word) {
                    let general = NounPhrase::parse(head, &WordHints::default());
                    let id = self.push(extension, general.clone(), phrase.name());
                    self.nouns.insert(&general, Meaning::Kind(id));
                }
            }
        } else {
            self.nouns.insert(phrase, Meaning::Kind(id));
        }
        let english_name = match english_name {
            // What a dictionary makes of «зал» is not this hall, where the map calls another so.
            "" if self.own_english.contains(&name_key(&self.kinds[usize::from(id.0)].english)) => {
                String::new()
            }
            "" => self.kinds[usize::from(id.0)].english.clone(),
            name => name.to_owned(),
        };
        let is_english = Language::of(&english_name) == Language::English;
        if is_english {
            self.nouns.insert_english(&english_name, Meaning::Kind(id));
        }
        if own {
            if let Some(head) = phrase.head()
                && name_key(head) != name_key(phrase.name())
            {
                // «журнальный столик» is a table; a word of its own, as «тумбочка» is, is of another thing.
                let whole = everyday::undiminished(&name_key(head));
                for head in std::iter::once(name_key(head)).chain(whole) {
                    self.narrower.entry((true, head)).or_default().push(id);
                }
            }
            if is_english
                && let Some(head) = english::kind(&english_name)
                && !is_no_real_one(&english_name)
            {
                self.narrower.entry((false, name_key(head))).or_default().push(id);
            }
        }
    }

    fn add_concepts(&mut self, world: &World) {
        let has_chargers = chargers(world).next().is_some();
        for (extension, words) in concepts() {
            if extension == Extension::Chargers && !has_chargers {
                continue;
            }
            let (russian, english): (Vec<&str>, Vec<&str>) =
                words.into_iter().partition(|word| Language::of(word) == Language::Russian);
            let (Some(own), Some(first)) = (russian.first(), english.first()) else { continue };
            for word in &russian {
                let phrase = NounPhrase::parse(word, &WordHints::default());
                let id = self.push(extension, phrase.clone(), first);
                self.nouns.insert(&phrase, Meaning::Kind(id));
            }
            let own = NounPhrase::parse(own, &WordHints::default());
            for word in &english {
                let id = self.push(extension, own.clone(), word);
                self.nouns.insert_english(word, Meaning::Kind(id));
            }
        }
    }

    /// The name of the whole is one for the building, where nothing else is called so.
    fn add_building(&mut self, world: &World) {
        let Some(first) = self.kind_of(&Extension::Building).map(|id| self.kind(id).clone()) else {
            return;
        };
        let own = [world.domain.name.as_str(), world.domain.name_en.as_str()];
        // «Сколько в офисе столов?», where no room is called so.
        for name in own.into_iter().chain(set!("PerhapsBuilding").iter().copied()) {
            if name.is_empty() || !self.nouns.find(name).is_empty() {
                continue;
            }
            let id = self.push(Extension::Building, first.phrase.clone(), &first.english);
            match Language::of(name) {
                Language::English => self.nouns.insert_english(name, Meaning::Kind(id)),
                Language::Russian => {
                    self.nouns
                        .insert(&NounPhrase::parse(name, &WordHints::default()), Meaning::Kind(id));
                }
            }
        }
    }

    /// Lifts, which people speak of whether the map calls a room so or not: a map without one has none.
    fn add_lifts(&mut self, world: &World) {
        let first = |stops: &[crate::map::LiftStop]| stops.first().map(|stop| stop.area);
        for (name, stops) in &world.domain.lifts {
            let Some(area) = first(stops).filter(|_| self.nouns.find(name).is_empty()) else {
                continue;
            };
            let meaning = Meaning::Entity(Entity::Area(area));
            match Language::of(name) {
                Language::English => self.nouns.insert_english(name, meaning),
                Language::Russian => {
                    self.nouns.insert(&NounPhrase::parse(name, &WordHints::default()), meaning);
                }
            }
        }
        let phrase = NounPhrase::parse("лифт", &WordHints::default());
        for word in ["лифт", "lift", "elevator"] {
            let is_kind = |hit: &crate::words::Hit<'_, Meaning>| matches!(hit.id, Meaning::Kind(_));
            if self.nouns.find(word).iter().any(is_kind) {
                continue;
            }
            let id = self.push(Extension::Lifts, phrase.clone(), "lift");
            match Language::of(word) {
                Language::Russian => self.nouns.insert(&phrase, Meaning::Kind(id)),
                Language::English => self.nouns.insert_english(word, Meaning::Kind(id)),
            }
        }
    }

    /// Sorts above the types, with the kinds of the map that belong to each.
    fn add_sorts(&mut self) {
        for (n, sort) in things().sorts.iter().enumerate() {
            let extension = Extension::Sort(u16::try_from(n).unwrap_or(u16::MAX));
            let mut members: Vec<KindId> = Vec::new();
            for word in &sort.members {
                members.extend(self.kinds_called(word));
            }
            let english = &sort.english;
            let russian: Vec<NounPhrase> = sort
                .russian
                .iter()
                .map(|word| NounPhrase::parse(word, &WordHints::default()))
                .collect();
            let own = self.push(extension, russian[0].clone(), &english[0]);
            // "thing to tell the time by" is what such things are counted by, and makes no word of it known.
            let spoken = sort.is_spoken();
            // A kind of the map that is called as its sort is covers it: «картины» are photographs, too.
            let words = (sort.russian.iter().map(|word| (true, word)))
                .chain(sort.english.iter().map(|word| (false, word)));
            for (is_russian, word) in words.filter(|(_, word)| sort.members.contains(word)) {
                let covered = self.narrower.entry((is_russian, name_key(word))).or_default();
                covered.extend(members.iter().copied());
            }
            for phrase in russian.into_iter().filter(|_| spoken) {
                if self.nouns.find(phrase.name()).is_empty() {
                    let id = self.push(extension, phrase.clone(), &english[0]);
                    self.nouns.insert(&phrase, Meaning::Kind(id));
                }
            }
            for word in english.iter().filter(|_| spoken) {
                if self.nouns.find(word).is_empty() {
                    let first = self.kind(own).phrase.clone();
                    let id = self.push(extension, first, word);
                    self.nouns.insert_english(word, Meaning::Kind(id));
                }
            }
            members.order();
            members.dedup();
            members.insert(0, own);
            self.sorts.push(members);
        }
    }

    /// The kinds of things that a word means, narrower ones and those of a sort too.
    fn kinds_called(&self, word: &str) -> Vec<KindId> {
        let called = self.nouns.find(word).into_iter().filter_map(|hit| match hit.id {
            Meaning::Kind(kind) => Some(*kind),
            Meaning::Entity(_) => None,
        });
        let language = Language::of(word);
        let things = |id: &KindId| {
            matches!(
                self.kind(*id).extension,
                Extension::ObjectType(_) | Extension::Object(_) | Extension::Trait(_)
            )
        };
        called.flat_map(|id| self.with_narrower(id, language)).filter(things).collect()
    }

    /// The kinds of a sort, the sort's own first: by its words such things are counted.
    pub(super) fn kinds_of_sort(&self, sort: u16) -> Vec<KindId> {
        self.sorts.get(usize::from(sort)).cloned().unwrap_or_default()
    }

    /// The kinds of what people throw things into.
    #[must_use]
    pub fn bins(&self) -> Vec<Extension> {
        let sort = purposes::sort_called("place for rubbish");
        let kinds = sort.map(|sort| self.kinds_of_sort(sort)).unwrap_or_default();
        kinds.into_iter().map(|id| self.kind(id).extension).collect()
    }

    /// # Panics
    /// When the id is not of this lexicon.
    #[must_use]
    pub fn kind(&self, id: KindId) -> &Kind {
        &self.kinds[usize::from(id.0)]
    }

    /// The kind itself and those that its word covers too.
    #[must_use]
    pub fn with_narrower(&self, id: KindId, language: Language) -> Vec<KindId> {
        let kind = self.kind(id);
        if let Extension::Sort(sort) = kind.extension {
            return self.kinds_of_sort(sort);
        }
        if !matches!(kind.extension, Extension::ObjectType(_) | Extension::Object(_)) {
            return vec![id];
        }
        let key = match language {
            Language::Russian => (true, name_key(kind.phrase.name())),
            Language::English => (false, name_key(&kind.english)),
        };
        let mut kinds = vec![id];
        let narrower = self.narrower.get(&key).into_iter().flatten();
        kinds.extend(narrower.filter(|other| **other != id));
        kinds
    }

    /// Of the kinds that a word may mean those that it names properly. An English compound is one of its head's kind
    /// only where Russian calls it by the same noun: a dining table is «стол» as a table is, a tissue box is no
    /// «коробка», a bedside table no «стол».
    pub(super) fn proper(&self, kinds: &[KindId], language: Language) -> Vec<KindId> {
        if language == Language::Russian {
            return kinds.to_vec();
        }
        let narrower = |id: &KindId| self.with_narrower(*id, language).into_iter().skip(1);
        let covered: BTreeSet<KindId> = kinds.iter().flat_map(narrower).gather();
        let noun = |id: &KindId| {
            let phrase = &self.kind(*id).phrase;
            name_key(phrase.head().unwrap_or(phrase.name()))
        };
        let (narrow, broad): (Vec<KindId>, Vec<KindId>) =
            kinds.iter().partition(|kind| covered.contains(kind));
        let same = |id: &KindId| broad.iter().any(|other| noun(other) == noun(id));
        let same: Vec<KindId> = narrow.into_iter().filter(same).collect();
        broad.into_iter().chain(same).collect()
    }

    /// Whether things of this kind are rooms, storeys or buildings.
    pub(super) fn is_area(&self, id: KindId) -> bool {
        matches!(
            self.kind(id).extension,
            Extension::AreaType(_) | Extension::Rooms | Extension::Storeys | Extension::Building
        )
    }

    /// The kind by whose words things are counted: «предмет мебели» for «мебель».
    pub(super) fn counted(&self, id: KindId) -> &Kind {
        let kind = self.kind(id);
        let is_mass = |word: &str| MASS.contains(&&*name_key(word));
        if !is_mass(kind.phrase.name()) && !is_mass(&kind.english) {
            return kind;
        }
        let extension = match kind.extension {
            Extension::Lighting => Extension::Trait("light"),
            other => other,
        };
        self.kind_of(&extension).map_or(kind, |id| self.kind(id))
    }

    /// Whether a kind's word is of what is not counted: «мебель».
    pub(super) fn is_mass(&self, id: KindId) -> bool {
        MASS.contains(&&*name_key(self.kind(id).phrase.name()))
    }

    /// Whether something is a switch, by the name of its type.
    #[must_use]
    pub fn is_switch(entry: &TypeEntry) -> bool {
        name_key(&entry.name) == "выключатель" || name_key(&entry.name_en) == "light switch"
    }

    /// The first kind of this extension, for words about it.
    #[must_use]
    pub fn kind_of(&self, extension: &Extension) -> Option<KindId> {
        let at = self.kinds.iter().position(|k| k.extension == *extension)?;
        u16::try_from(at).ok().map(KindId)
    }

    /// What a text as a whole may mean, the most faithful spellings alone.
    #[must_use]
    pub fn find(&self, text: &str) -> Vec<Hit<'_, Meaning>> {
        self.nouns.find(text)
    }

    /// Names that may be typed, for completion.
    pub fn names(&self) -> impl Iterator<Item = &str> {
        self.nouns.titles()
    }

    /// How many names and forms are known.
    #[must_use]
    pub fn size(&self) -> (usize, usize) {
        self.nouns.size()
    }

    /// The noun in the form that a number of things asks for, or its plural.
    #[must_use]
    pub fn plural(&self, id: KindId, language: Language) -> String {
        let kind = self.kind(id);
        match language {
            Language::Russian => {
                lower_first(&kind.phrase.form(crate::Case::Nominative, Number::Plural))
            }
            Language::English => english::plural(&kind.english),
        }
    }
}

/// Whether a name is a word for what one stands on.
fn is_of_floor(name: &str) -> bool {
    let key = name_key(name);
    of_kind("Concept.").any(|(name, word)| name == "Floor" && word == key)
}

/// "Dog bed", "toy car": named like a thing for people, and no such thing.
fn is_no_real_one(english_name: &str) -> bool {
    let first = english_name.split_whitespace().next().map(str::to_lowercase);
    first.is_some_and(|word| set!("NoRealOne").contains(&word.as_str()))
}

/// «Стул» within a sentence is «стул»; «МФУ» stays.
#[must_use]
pub(super) fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    let Some(first) = letters.next() else { return String::new() };
    let rest = letters.as_str();
    if rest.chars().next().is_none_or(char::is_uppercase) {
        return text.to_owned();
    }
    first.to_lowercase().chain(rest.chars()).collect()
}

/// "dining table", but "TV"
fn lower_words(name: &str) -> String {
    let is_acronym = |w: &str| w.len() > 1 && w.chars().all(|c| c.is_ascii_uppercase());
    let lower = |w: &str| if is_acronym(w) { w.to_owned() } else { w.to_lowercase() };
    name.split(' ').map(lower).collect::<Vec<_>>().join(" ")
}

/// A type as a key that both lists share.
#[derive(PartialEq, Eq, PartialOrd, Ord)]
struct TypeKey(u8, TypeId);

impl Extension {
    fn into_key(self) -> TypeKey {
        match self {
            Self::ObjectType(id) => TypeKey(0, id),
            Self::AreaType(id) => TypeKey(1, id),
            Self::DoorType(id) => TypeKey(2, id),
            _ => TypeKey(3, TypeId(0)),
        }
    }
}

/// Types that something on the map has: what only the type list knows is missing from the map.
fn used_types(world: &World) -> BTreeSet<TypeKey> {
    let objects: BTreeSet<ObjectId> = world.replicas.values().map(|r| r.object).gather();
    let object_types =
        objects.iter().filter_map(|o| world.objects.get(o)?.object_type).map(|t| TypeKey(0, t));
    let areas = world.areas.values().filter_map(|a| a.area_type).map(|t| TypeKey(1, t));
    let doors = world.doors.values().filter_map(|d| d.door_type).map(|t| TypeKey(2, t));
    object_types.chain(areas).chain(doors).gather()
}
