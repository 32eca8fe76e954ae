//! Names, places, numbers and lists inside an answer, in both languages.

use crate::map::Entity;
use crate::names::named;
use crate::report::Named;
use crate::sets::{Set, set};
use crate::units::capitalized;
use crate::words::length;
use crate::words::russian::{self, Preposition};
use crate::words::{
    Case, Gender, Language, NounPhrase, Number, WordHints, alternatives, english, enumerate,
};

use super::focus::without_article;
use super::knowledge::{Frame, Knowledge};
use super::lexicon::{Extension, KindId, lower_first};
use super::query::{Filter, Noun, Rel, Restriction, Thing};
use super::values::{Property, ValueId};

/// More than this is not listed one by one.
const LISTED: usize = 20;

impl Knowledge<'_> {
    pub(super) fn is_russian(&self) -> bool {
        self.language == Language::Russian
    }

    /// One of two texts, by the language of the question.
    pub(super) fn pick<'a>(&self, russian: &'a str, english: &'a str) -> &'a str {
        if self.is_russian() { russian } else { english }
    }

    pub(super) fn named(&self, thing: Thing) -> Named {
        match thing {
            Thing::Entity(entity) => named(self.world, entity),
            Thing::Opening(n) => Named::plain(&self.symbol(Thing::Opening(n))),
            Thing::Window(n) => {
                let window = &self.lexicon().windows[n as usize];
                let area = self.named(Thing::Entity(Entity::Area(window.area)));
                if window.name.is_empty() {
                    let russian = format!("окно {}", area.phrase().case(Case::Genitive));
                    let english = window_of(&area.english());
                    return Named::new(&russian, &WordHints::default(), Some(&english));
                }
                let tag = window.name.trim_start_matches(|c: char| !c.is_ascii_digit());
                let english = match tag.is_empty() {
                    true => window_of(&area.english()),
                    false => format!("Window {tag}"),
                };
                let english =
                    Some(english).filter(|_| Language::of(&window.name) == Language::Russian);
                Named::new(&window.name, &WordHints::default(), english.as_deref())
            }
            Thing::Robot => Named::new("робот", &WordHints::default(), Some("robot")),
        }
    }

    /// The name in a case; in English, with its article.
    pub(super) fn form(&self, thing: Thing, case: Case) -> String {
        match (thing, self.is_russian()) {
            (Thing::Robot, true) => match case {
                Case::Nominative => "я",
                Case::Dative => "мне",
                Case::Instrumental => "мной",
                _ => "меня",
            }
            .to_owned(),
            (Thing::Robot, false) => "me".to_owned(),
            (_, true) => self.named(thing).phrase().case(case),
            (_, false) => self.named(thing).english(),
        }
    }

    /// The name as the subject of a sentence.
    pub(super) fn name(&self, thing: Thing) -> String {
        self.form(thing, Case::Nominative)
    }

    pub(super) fn names(&self, things: &[Thing], case: Case) -> String {
        let shown: Vec<String> = things.iter().take(LISTED).map(|t| self.form(*t, case)).collect();
        let more = things.len().saturating_sub(LISTED);
        if more == 0 {
            return enumerate(&shown, self.language);
        }
        match self.language {
            Language::Russian => format!("{} и ещё {more}", shown.join(", ")),
            Language::English => format!("{} and {more} more", shown.join(", ")),
        }
    }

    /// «Стул-1, Стул-2 и Стул-3»
    pub(super) fn list(&self, things: &[Thing]) -> String {
        self.names(things, Case::Nominative)
    }

    pub(super) fn gender(&self, thing: Thing) -> (Gender, Number) {
        let named = self.named(thing);
        let name = named.phrase();
        if Language::of(name.name()) == Language::Russian {
            return (name.gender(), name.number());
        }
        // A foreign name goes by what it names: «Office door закрыта».
        let gender = match thing {
            Thing::Entity(Entity::Door(_)) | Thing::Opening(_) => Gender::Feminine,
            Thing::Entity(Entity::Area(_)) => Gender::Neuter,
            _ => {
                let kind = self.kind_name(thing).unwrap_or_default();
                let kind = english::russian_of(&kind).first().copied().unwrap_or("предмет");
                NounPhrase::parse(kind, &WordHints::default()).gender()
            }
        };
        (gender, Number::Singular)
    }

    /// «находится», "is"
    pub(super) fn is(&self, things: &[Thing]) -> &'static str {
        let is_plural = |t: &Thing| match self.is_russian() {
            true => self.gender(*t).1 == Number::Plural,
            false => english::is_plural(&self.name(*t)),
        };
        let many = things.len() > 1 || things.iter().any(is_plural);
        match (self.is_russian(), many) {
            (true, false) => "находится",
            (true, true) => "находятся",
            (false, false) => "is",
            (false, true) => "are",
        }
    }

    /// A preposition with names: «на Столе-1», "between Bed 1 and Wardrobe 2".
    pub(super) fn place(&self, rel: Rel, anchors: &[Thing]) -> String {
        let Some(&anchor) = anchors.first() else { return String::new() };
        let has = |rel| anchor.replica().is_some() && !self.related(rel, anchor).is_empty();
        // On it and in it.
        if rel == Rel::There && has(Rel::On) && has(Rel::In) {
            return self.pick("там", "there").to_owned();
        }
        let rel = if rel == Rel::There { self.there(anchor) } else { rel };
        let is_area = matches!(anchor, Thing::Entity(Entity::Area(_) | Entity::Map(_)));
        let storeys: Option<Vec<String>> = anchors.iter().map(|a| self.bare_storey(*a)).collect();
        if let Some(storeys) = storeys {
            let several = storeys.len() > 1;
            let storey = enumerate(&storeys, self.language);
            return match (rel, self.is_russian()) {
                (Rel::In | Rel::On | Rel::Of | Rel::At, true) if several => {
                    format!("на этажах {storey}")
                }
                (Rel::In | Rel::On | Rel::Of | Rel::At, false) if several => {
                    format!("on floors {storey}")
                }
                (Rel::In | Rel::On | Rel::Of | Rel::At, true) => format!("на этаже {storey}"),
                (Rel::From, true) => format!("с этажа {storey}"),
                (Rel::To, true) => format!("на этаж {storey}"),
                (Rel::In | Rel::On | Rel::Of | Rel::At, false) => format!("on floor {storey}"),
                (Rel::From, false) => format!("from floor {storey}"),
                (_, true) => format!("этаж {storey}"),
                (_, false) => format!("to floor {storey}"),
            };
        }
        if !self.is_russian() {
            let name = self.names(anchors, Case::Nominative);
            let before = match rel {
                Rel::In | Rel::Of | Rel::On if self.is_floor_name(anchor) => "on",
                Rel::In | Rel::Of if is_area => "in",
                Rel::In => "in",
                Rel::On if is_area => "in",
                Rel::On => "on",
                Rel::Under => "under",
                Rel::Above => "above",
                Rel::NextTo => "next to",
                Rel::Near => "near",
                Rel::LeftOf => "to the left of",
                Rel::RightOf => "to the right of",
                Rel::Behind => "behind",
                Rel::InFrontOf => "in front of",
                Rel::Between => "between",
                Rel::Middle => "in the middle of",
                Rel::ToTheEye(side) => return self.place_aside(side, anchors),
                Rel::Facing => "facing",
                Rel::There => "at",
                Rel::Leaning => "leaning against",
                Rel::Outside => "outside",
                Rel::From => "out of",
                Rel::To => "to",
                Rel::Through => "through",
                Rel::At => "at",
                Rel::Of => "of",
                Rel::Has | Rel::Bears => "with",
                Rel::Opens => "for",
                Rel::Within(reach) => {
                    return format!("within {} of {name}", length(f64::from(reach), self.language));
                }
            };
            return format!("{before} {name}");
        }
        let in_case = |case: Case| self.names(anchors, case);
        let with = |before: Preposition, case: Case| {
            let form = in_case(case);
            format!("{} {form}", russian::preposition(before, &form))
        };
        match rel {
            // Each room with its own preposition: «в Гостиной и на Кухне».
            Rel::In | Rel::On | Rel::Of if anchors.iter().all(|t| t.area().is_some()) => {
                let each = anchors.iter().map(|t| russian::where_at(self.named(*t).phrase()));
                enumerate(&each.collect::<Vec<_>>(), self.language)
            }
            Rel::In | Rel::On | Rel::Of if is_area && anchors.len() == 1 => {
                russian::where_at(self.named(anchor).phrase())
            }
            Rel::In | Rel::Of | Rel::There => with(Preposition::V, Case::Locative),
            Rel::On => with(Preposition::Na, Case::Locative),
            Rel::Under => with(Preposition::Pod, Case::Instrumental),
            Rel::Above => with(Preposition::Nad, Case::Instrumental),
            Rel::NextTo => format!("рядом {}", with(Preposition::S, Case::Instrumental)),
            Rel::Near => format!("недалеко {}", with(Preposition::Ot, Case::Genitive)),
            Rel::LeftOf => format!("слева {}", with(Preposition::Ot, Case::Genitive)),
            Rel::RightOf => format!("справа {}", with(Preposition::Ot, Case::Genitive)),
            Rel::Behind => with(Preposition::Za, Case::Instrumental),
            Rel::InFrontOf => with(Preposition::Pered, Case::Instrumental),
            Rel::Between => format!("между {}", in_case(Case::Instrumental)),
            Rel::Middle => format!("посередине {}", in_case(Case::Genitive)),
            Rel::ToTheEye(side) => self.place_aside(side, anchors),
            Rel::Facing => format!("лицом {}", with(Preposition::K, Case::Dative)),
            Rel::Leaning => format!("вплотную {}", with(Preposition::K, Case::Dative)),
            Rel::Outside => format!("вне {}", in_case(Case::Genitive)),
            Rel::From => match (is_area, anchors.len()) {
                (true, 1) => russian::whence(self.named(anchor).phrase()),
                _ => with(Preposition::Ot, Case::Genitive),
            },
            Rel::To => match (is_area, anchors.len()) {
                (true, 1) => russian::whither(self.named(anchor).phrase()),
                _ => with(Preposition::K, Case::Dative),
            },
            Rel::Through => with(Preposition::Cherez, Case::Accusative),
            Rel::At => with(Preposition::U, Case::Genitive),
            Rel::Has | Rel::Bears => with(Preposition::S, Case::Instrumental),
            Rel::Opens => with(Preposition::Ot, Case::Genitive),
            Rel::Within(reach) => {
                let far = length(f64::from(reach), self.language);
                format!("не дальше {far} {}", with(Preposition::Ot, Case::Genitive))
            }
        }
    }

    /// A storey that is called one: "Floor 1".
    fn is_floor_name(&self, thing: Thing) -> bool {
        let name = || self.name(thing).to_lowercase();
        thing.is_storey() && set!("StoreyNoun").iter().any(|word| name().contains(word))
    }

    /// The name of one storey of several where that is no more than a code: «L2».
    fn bare_storey(&self, thing: Thing) -> Option<String> {
        if !thing.is_storey() || self.world.maps.len() < 2 {
            return None;
        }
        let name = self.name(thing);
        let is_code = name.chars().count() <= 4 && name.chars().any(|c| c.is_ascii_digit());
        is_code.then_some(name)
    }

    /// «в Комнате-В», "in Room V"
    pub(super) fn in_room(&self, thing: Thing) -> Option<String> {
        let area = self.area_of(thing)?;
        Some(self.place(Rel::In, &[Thing::Entity(Entity::Area(area))]))
    }

    /// A Russian form of what a description means; of values joined by «или» each has its own: «красных или белых
    /// чашек».
    fn declined(&self, noun: &Noun, form: &dyn Fn(&NounPhrase) -> String) -> String {
        let Some(at) = noun.filters.iter().position(|filter| !filter.or.is_empty()) else {
            return form(&self.kind_phrase(noun).0);
        };
        let alone = |value| {
            let mut noun = noun.clone();
            noun.filters[at] = Filter::new(value, noun.filters[at].negated);
            self.declined(&noun, form)
        };
        let forms: Vec<String> = noun.filters[at].values().map(alone).collect();
        let words: Vec<Vec<&str>> = forms.iter().map(|f| f.split_whitespace().collect()).collect();
        let [first, rest @ ..] = &words[..] else { return String::new() };
        let shared =
            |n: &usize| rest.iter().all(|w| w.len() > *n && w.ends_with(&first[first.len() - n..]));
        let shared = (0..first.len()).rev().find(shared).unwrap_or(0);
        let own: Vec<String> = words.iter().map(|w| w[..w.len() - shared].join(" ")).collect();
        let tail = first[first.len() - shared..].join(" ");
        format!("{} {tail}", alternatives(&own, self.language))
    }

    /// The words for what a description means, as a phrase that declines: «чёрный стул».
    pub(super) fn kind_phrase(&self, noun: &Noun) -> (NounPhrase, String) {
        let alike = noun.head.things.as_deref().and_then(|told| self.alike(told));
        let kind = noun.head.kinds.first().copied().or(alike).map(|k| self.lexicon().counted(k));
        let (base, english_base) = match kind {
            Some(kind) => match self.shared_head(noun) {
                Some(head) if self.is_russian() => (head, kind.english.clone()),
                Some(head) => (kind.phrase.clone(), head.name().to_owned()),
                None => (kind.phrase.clone(), kind.english.clone()),
            },
            None => {
                let named = noun.head.named.iter().map(|entity| Thing::Entity(*entity));
                let told: Vec<Thing> =
                    named.chain(noun.head.things.iter().flatten().copied()).collect();
                let are = |of: fn(&Thing) -> bool| !told.is_empty() && told.iter().all(of);
                let of = match are(|thing| matches!(thing, Thing::Entity(Entity::Door(_)))) {
                    true => Extension::Doors,
                    false if are(|thing| thing.area().is_some()) => Extension::Rooms,
                    false => Extension::Things,
                };
                let kind = self.lexicon().kind_of(&of).map(|id| self.lexicon().kind(id));
                let things =
                    || (NounPhrase::parse("вещь", &WordHints::default()), "thing".to_owned());
                kind.map_or_else(things, |kind| (kind.phrase.clone(), kind.english.clone()))
            }
        };
        let (mut russian_name, mut english_name) = (lower_first(base.name()), english_base);
        for filter in noun.filters.iter().rev() {
            let entries = filter.values().map(|v| self.lexicon().values.entry(v));
            let not = if filter.negated { self.pick("не", "non-") } else { "" };
            let (mut russian_values, mut english_values) = (Vec::new(), Vec::new());
            for entry in entries {
                let (number, gender) = (base.number(), base.gender());
                let own = russian::agreeing(&entry.russian, Case::Nominative, number, gender);
                russian_values.push(format!("{not}{own}"));
                english_values.push(format!("{not}{}", entry.english));
            }
            russian_name = format!("{} {russian_name}", russian_values.join(" или "));
            english_name = format!("{} {english_name}", english_values.join(" or "));
        }
        let phrase = match noun.filters.is_empty() {
            true => base,
            false => {
                let hints = WordHints { gender: Some(base.gender()), ..WordHints::default() };
                NounPhrase::parse(&russian_name, &hints)
            }
        };
        (phrase, english_name)
    }

    /// «лампа» for ceiling lamps and table lamps together: the head that all kinds of a description share.
    fn shared_head(&self, noun: &Noun) -> Option<NounPhrase> {
        let head = |id: &super::lexicon::KindId| -> Option<String> {
            let kind = self.lexicon().counted(*id);
            Some(match self.is_russian() {
                true => kind.phrase.head().unwrap_or(kind.phrase.name()).to_lowercase(),
                false => english::kind(&kind.english).unwrap_or(&kind.english).to_lowercase(),
            })
        };
        let mut heads = noun.head.kinds.iter().map(head);
        let first = heads.next()??;
        let several = noun.head.kinds.len() > 1;
        (several && heads.all(|h| h.as_ref() == Some(&first)))
            .then(|| NounPhrase::parse(&first, &WordHints::default()))
    }

    /// «2 чёрных стула», "2 black chairs"
    pub(super) fn counted(&self, noun: &Noun, number: usize) -> String {
        match self.language {
            Language::Russian => {
                let words = self.declined(noun, &|phrase| phrase.counted(number as u64));
                format!("{number} {}", lower_first(&words))
            }
            Language::English => english::count(number as u64, &self.kind_phrase(noun).1),
        }
    }

    /// «чёрных стульев», "black chairs", «мыла»: of which there are none.
    pub(super) fn none_of(&self, noun: &Noun) -> String {
        if noun.head.named.is_empty() && noun.head.things.is_some() {
            return self.names(&self.base(&noun.head), Case::Genitive);
        }
        if let (false, [only]) = (noun.head.named.is_empty(), &noun.head.named[..]) {
            return self.form(Thing::Entity(*only), Case::Genitive);
        }
        if noun.head.anything && noun.filters.is_empty() {
            return self.pick("ничего", "nothing").to_owned();
        }
        // «На карте нет этажей» is no answer of a second one, where there is a first.
        let unranked = Noun { rank: None, ..noun.clone() };
        let is_ranked = noun.rank.is_some() && !noun.text.is_empty();
        if is_ranked && self.find(&unranked, true).is_ok_and(|all| !all.is_empty()) {
            let said = without_article(&noun.text);
            return match self.language {
                Language::Russian => format!("такого: «{said}»"),
                Language::English => {
                    let (_, name) = self.kind_phrase(noun);
                    format!("{} that would be “{said}”", english::plural(&name))
                }
            };
        }
        match self.language {
            Language::Russian => {
                let number = |phrase: &NounPhrase| match is_mass(phrase) {
                    true => Number::Singular,
                    false => Number::Plural,
                };
                let form = |phrase: &NounPhrase| phrase.form(Case::Genitive, number(phrase));
                lower_first(&self.declined(noun, &form))
            }
            Language::English => {
                let (_, name) = self.kind_phrase(noun);
                if is_mass_in_english(&name) { name } else { english::plural(&name) }
            }
        }
    }

    /// "there are no cups on the table", "there is no bread in it"; of what has a name of its own, that it is not there.
    pub(super) fn there_is_no(&self, noun: &Noun, place: &str) -> String {
        let named = match (&noun.head.named[..], &noun.head.things) {
            ([only], _) => vec![Thing::Entity(*only)],
            ([], Some(things)) => things.clone(),
            _ => Vec::new(),
        };
        if !named.is_empty() {
            return format!("{} {} not {place}", self.list(&named), self.is(&named));
        }
        if noun.head.anything && noun.filters.is_empty() {
            return format!("there is nothing {place}");
        }
        let none = self.none_of(noun);
        // "there are no scissors"
        let is_mass = none == self.kind_phrase(noun).1 && !none.ends_with('s');
        let is = if is_mass { "is" } else { "are" };
        let but = noun.other || !noun.except.is_empty();
        let other = if but { "other " } else { "" };
        format!("there {is} no {other}{none} {place}")
    }

    /// Where a description says its things are: «в Комнате-В на столах».
    pub(super) fn restrictions(&self, noun: &Noun) -> String {
        let mut parts: Vec<String> = noun.sizes.iter().map(|size| self.size_words(*size)).collect();
        parts
            .extend(noun.beyond.as_ref().and_then(|(extreme, other)| self.beyond(*extreme, other)));
        // "in every room except the kitchen"
        let rooms = |a: &Noun| {
            let is_room = |k: &KindId| self.lexicon().kind(*k).extension == Extension::Rooms;
            a.restrictions.is_empty() && a.head.kinds.iter().any(is_room)
        };
        let of_rooms = |r: &&Restriction| r.rel == Rel::In && r.anchors.iter().all(rooms);
        let every = noun.restrictions.iter().any(|r| !r.negated && of_rooms(&r));
        let except = noun.restrictions.iter().find_map(|r| {
            let area = self.find(r.anchors.first()?, true).ok()?.into_iter().next()?;
            (every && r.negated && r.rel == Rel::In && area.area().is_some()).then_some(area)
        });
        for restriction in &noun.restrictions {
            if except.is_some() && !restriction.negated && of_rooms(&restriction) {
                continue;
            }
            if let Some(area) = except.filter(|_| restriction.negated) {
                parts.push(match self.is_russian() {
                    true => format!("вне {}", self.form(area, Case::Genitive)),
                    false => format!("outside {}", self.name(area)),
                });
                continue;
            }
            let mut anchors: Vec<Thing> = Vec::new();
            let mut text = String::new();
            let walls = restriction.anchors.iter().any(|anchor| self.is_walls(anchor));
            if restriction.rel == Rel::Between
                && walls
                && let Some(Ok(thing)) =
                    restriction.anchors.iter().find(|a| !self.is_walls(a)).map(|a| self.one(a))
            {
                text = match self.is_russian() {
                    true => format!("между {} и стеной", self.form(thing, Case::Instrumental)),
                    false => format!("between {} and the wall", self.name(thing)),
                };
            } else if restriction.rel == Rel::Between
                && let Ok(ends) = self.ends_between(restriction)
            {
                text = self.place(Rel::Between, &ends);
            }
            if let Ok(Some(level)) = self.level_of(restriction) {
                text = self.place_on(&level, &restriction.anchors[0], restriction.rel);
            }
            for anchor in &restriction.anchors {
                if !text.is_empty() {
                    break;
                }
                if self.is_floor(anchor) && restriction.rel != Rel::Has {
                    text = self.pick("на полу", "on the floor").to_owned();
                    continue;
                }
                match self.find(anchor, true) {
                    Ok(found) if found.len() == 1 || anchor.head.things.is_some() => {
                        anchors.extend(found)
                    }
                    _ => {
                        text = self.general_place(restriction.rel, anchor);
                        // "in the rooms with windows"
                        let has = anchor.restrictions.iter().filter(|r| r.rel == Rel::Has).cloned();
                        let had = Noun { restrictions: has.collect(), ..Noun::default() };
                        let like = self.restrictions(&had);
                        if !like.is_empty() {
                            text = format!("{text} {like}");
                        }
                    }
                }
            }
            if text.is_empty() {
                text = self.place(restriction.rel, &anchors);
            }
            let having = matches!(restriction.rel, Rel::Has | Rel::Bears);
            if having && !restriction.negated && restriction.anchors.len() > 1 {
                // "with a bed or a fridge"
                let each = restriction.anchors.iter().map(|anchor| match self.find(anchor, true) {
                    Ok(found) if found.len() == 1 => self.place(restriction.rel, &found),
                    _ => self.general_place(restriction.rel, anchor),
                });
                parts.push(alternatives(&each.collect::<Vec<_>>(), self.language));
                continue;
            }
            if having
                && let [anchor] = &restriction.anchors[..]
                && let Some(count) = anchor.count
            {
                text = self.with_so_many(anchor, count);
            }
            if having && restriction.negated {
                let lacked: Vec<String> =
                    restriction.anchors.iter().map(|a| self.none_of(a)).collect();
                let lacked = enumerate(&lacked, self.language);
                parts.push(format!("{} {lacked}", self.pick("без", "without")));
                continue;
            }
            // «со столами и со стульями»
            if having && !parts.is_empty() {
                text = format!("{} {text}", self.pick("и", "and"));
            }
            if restriction.negated {
                let not = self.pick("не", "not");
                let joint = match parts.last() {
                    None => "",
                    Some(before) if before.starts_with(not) => self.pick("и ", "and "),
                    Some(_) => self.pick(", но ", ", but "),
                };
                text = format!("{joint}{not} {text}");
            }
            parts.push(text);
        }
        parts.join(" ").replace(" ,", ",")
    }

    /// «более чем с 5 стульями», "with more than 5 chairs"
    fn with_so_many(&self, anchor: &Noun, count: u64) -> String {
        let quantity = self.quantity_words(anchor.quantity);
        let noun = Noun { count: None, ..anchor.clone() };
        let (phrase, english_name) = self.kind_phrase(&noun);
        match self.language {
            Language::Russian => {
                let number = if count % 10 == 1 && count % 100 != 11 {
                    Number::Singular
                } else {
                    Number::Plural
                };
                let form = lower_first(&phrase.form(Case::Instrumental, number));
                format!("{quantity}с {count} {form}")
            }
            Language::English => {
                format!("with {quantity}{}", english::count(count, &english_name))
            }
        }
    }

    /// «не менее чем », "at least "; nothing for an exact number.
    pub(super) fn quantity_words(&self, quantity: super::query::Quantity) -> &'static str {
        use super::query::Quantity;
        match quantity {
            Quantity::Exactly => "",
            Quantity::AtLeast => self.pick("не менее чем ", "at least "),
            Quantity::AtMost => self.pick("не более чем ", "at most "),
            Quantity::MoreThan => self.pick("более чем ", "more than "),
            Quantity::FewerThan => self.pick("менее чем ", "fewer than "),
        }
    }

    /// A place told by its kind: «на столах», "on the tables".
    fn general_place(&self, rel: Rel, anchor: &Noun) -> String {
        // «ни на чём» is on no other thing.
        let whatever = anchor.head.anything && anchor.filters.is_empty();
        let (phrase, english_name) = match whatever {
            true => {
                let other = NounPhrase::parse("другая вещь", &WordHints::default());
                (other, "other thing".to_owned())
            }
            false => self.kind_phrase(anchor),
        };
        // «в углу», "next to the wall": of these people speak as of one.
        let walls = self.is_walls(anchor);
        let number = if walls { Number::Singular } else { Number::Plural };
        let plural = |case: Case| lower_first(&phrase.form(case, number));
        if !self.is_russian() {
            if matches!(rel, Rel::Has | Rel::Bears) {
                return format!("with {}", english::plural(&english_name));
            }
            let name = match walls {
                true => format!("the {english_name}"),
                false if whatever => english::plural(&english_name),
                false => format!("the {}", english::plural(&english_name)),
            };
            let named = self.place(rel, &[Thing::Robot]);
            return named.replace("me", &name);
        }
        let with = |before: Preposition, case: Case| {
            let form = plural(case);
            format!("{} {form}", russian::preposition(before, &form))
        };
        match rel {
            Rel::On => with(Preposition::Na, Case::Prepositional),
            Rel::Under => with(Preposition::Pod, Case::Instrumental),
            Rel::Above => with(Preposition::Nad, Case::Instrumental),
            Rel::NextTo => format!("рядом {}", with(Preposition::S, Case::Instrumental)),
            Rel::Behind => with(Preposition::Za, Case::Instrumental),
            Rel::InFrontOf => with(Preposition::Pered, Case::Instrumental),
            Rel::LeftOf => format!("слева {}", with(Preposition::Ot, Case::Genitive)),
            Rel::RightOf => format!("справа {}", with(Preposition::Ot, Case::Genitive)),
            Rel::Near => format!("недалеко {}", with(Preposition::Ot, Case::Genitive)),
            Rel::Within(reach) => {
                let far = length(f64::from(reach), self.language);
                format!("не дальше {far} {}", with(Preposition::Ot, Case::Genitive))
            }
            Rel::Has | Rel::Bears => with(Preposition::S, Case::Instrumental),
            Rel::Facing => format!("лицом {}", with(Preposition::K, Case::Dative)),
            _ => with(Preposition::V, if walls { Case::Locative } else { Case::Prepositional }),
        }
    }

    /// «чёрный», "black": a value said of a thing.
    pub(super) fn value(&self, value: ValueId, thing: Thing) -> String {
        let values = &self.lexicon().values;
        let entry = values.entry(value);
        if !self.is_russian() {
            return match entry.english.as_str() {
                "" => entry.russian.clone(),
                english => english.to_owned(),
            };
        }
        let (gender, number) = self.gender(thing);
        values.predicate(value, gender, number)
    }

    /// A material as a noun in the genitive: «из дерева»; other values as adjectives.
    pub(super) fn value_of(&self, property: &Property, value: ValueId, thing: Thing) -> String {
        let entry = self.lexicon().values.entry(value);
        if *property == Property::Material && self.is_russian() && !entry.noun.is_empty() {
            let phrase = NounPhrase::parse(&entry.noun, &WordHints::default());
            return format!("из {}", phrase.case(Case::Genitive));
        }
        self.value(value, thing)
    }

    /// The frame of reference of left and right, in words; empty where it does not matter.
    pub(super) fn frame_words(&self, rel: Rel, anchor: Thing) -> String {
        if !matches!(rel, Rel::LeftOf | Rel::RightOf | Rel::Behind | Rel::InFrontOf) {
            return String::new();
        }
        if anchor == Thing::Robot {
            return String::new();
        }
        match (self.frame(anchor), self.is_russian()) {
            (Frame::Own, true) => {
                let form = self.form(anchor, Case::Genitive);
                format!(" (с собственной точки зрения {form})")
            }
            (Frame::Own, false) => {
                let name = self.form(anchor, Case::Nominative);
                format!(" (from {} own point of view)", english::possessive(&name))
            }
            (Frame::Viewer, true) => " (если смотреть с моего места)".to_owned(),
            (Frame::Viewer, false) => " (as seen from where I stand)".to_owned(),
        }
    }
}

/// "the window of Room V"; without its article where one is put before a common name.
fn window_of(area: &str) -> String {
    let article = if area.starts_with("the ") { "" } else { "the " };
    format!("{article}window of {area}")
}

/// A text with a capital at its beginning and a stop at its end.
pub(super) fn sentence(text: &str) -> String {
    let text = text.trim();
    let stop = if text.is_empty() || text.ends_with(['.', '?', '!', '…']) { "" } else { "." };
    format!("{}{stop}", capitalized(text))
}

/// Whether people do not count what a Russian phrase names: «нет мыла».
fn is_mass(phrase: &NounPhrase) -> bool {
    static MASS: Set = Set::named("MassNoun");
    let head = phrase.head().unwrap_or(phrase.name()).to_lowercase();
    MASS.contains(&head.as_str())
}

/// "no bread"
fn is_mass_in_english(name: &str) -> bool {
    static MASS: Set = Set::named("MassNoun");
    name.rsplit(' ').next().is_some_and(|head| MASS.contains(&head))
}
