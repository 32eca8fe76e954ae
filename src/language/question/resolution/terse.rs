//! Orders without a verb, «К холодильнику!», "The medicine, please", and orders that only amend the one before:
//! «Нет, в спальню», "not that one, the red one", «а теперь на кухню».

use std::ops::Range;

use super::Resolver;
use crate::command::{self, Sort};
use crate::map::Entity;
use crate::question::grammar::{Item, Sentence};
use crate::question::mark::{Mark, Pronoun};
use crate::question::memory::{Exchange, Ordered};
use crate::question::numbered::genders;
use crate::question::vocabulary;
use crate::question::{Asker, Doubt, Memory, Rel, Thing};
use crate::sets::{Set, of_kind, set};
use crate::words::{
    Case, Language, NounPhrase, Number, WordHints, english, phrase_at, word_keys, word_ranges,
};

/// What is said before an amendment.
static BEFORE: Set = Set::named("BeforeTerse");

/// What was done wrong: "not that one", «не эту».
static WRONG: Set = Set::named("WrongOne");

/// What was meant, or should have been done.
static MEANT: Set = Set::named("ShouldHaveBeen");

/// To do with another what was done.
static SAME: Set = Set::named("SameWith");

/// Whither the last order went, once more.
static THERE: Set = Set::named("ThereToo");

static BACK: Set = Set::named("Back");

/// Whether an order puts something back as it was: «выключи обратно».
pub(super) fn says_back(text: &str) -> bool {
    word_keys(text).iter().any(|key| BACK.contains(&key.as_str()))
}

/// «И обратно», "and back again": to where the robot was.
fn is_back(text: &str) -> bool {
    static SMALL: Set = Set::named("AroundBack");
    let keys = word_keys(text);
    let back = |key: &String| BACK.contains(&key.as_str());
    keys.iter().any(back) && keys.iter().all(|key| back(key) || SMALL.contains(&key.as_str()))
}

/// What a line says anew of an order, behind the words that only say that it does.
pub(super) struct Anew<'t> {
    pub(super) said: &'t str,
    pub(super) amends: bool,
    /// "No, …": what was said before is not meant.
    pub(super) denies: bool,
    /// "Not the red one", and no word of what is meant.
    pub(super) is_only_wrong: bool,
}

impl<'t> Anew<'t> {
    /// None where nothing is said but such words. `has_goal`, whether the order says whither, so that "there too" may be said.
    pub(super) fn of(text: &'t str, has_goal: bool) -> Option<Self> {
        let (words, keys) = (word_ranges(text), word_keys(text));
        let mut at = 0;
        let (mut amends, mut denies, mut is_only_wrong) = (false, false, false);
        while let Some(key) = keys.get(at) {
            // «Надо было на диван», "it should have been the sofa": what was done is not meant; "the same with": what is done is.
            let whole = |set: &Set| set.iter().filter_map(|said| phrase_at(&keys, at, said)).max();
            if let Some(taken) = whole(&MEANT) {
                (amends, denies, at) = (true, true, at + taken);
                continue;
            }
            if let Some(taken) = whole(&SAME) {
                (amends, at) = (true, at + taken);
                break;
            }
            let small = BEFORE.contains(&key.as_str());
            let wrong = amends && at > 0 && WRONG.contains(&key.as_str());
            // «тот, что на столе» is what is meant instead.
            let points = keys.get(at + 1).is_some_and(|k| k == "что" || k.starts_with("котор"));
            if !small && (!wrong || points) {
                break;
            }
            // "not the red one, the white one": up to the mark all is what was wrong.
            amends |= small;
            denies |= set!("No").contains(&key.as_str());
            at += 1;
            if set!("Not").contains(&key.as_str()) {
                let mark = (at + 1..words.len()).find(|&n| {
                    text[words[n - 1].end..words[n].start].contains([',', ';', '.', '–', '—'])
                });
                is_only_wrong = mark.is_none();
                at = mark.unwrap_or(at);
            }
        }
        // "the red one, please"
        let mut until = words.len();
        while until > at + 1 && BEFORE.contains(&keys[until - 1].as_str()) {
            amends |= has_goal && THERE.contains(&keys[until - 1].as_str());
            until -= 1;
        }
        // «И зелёную книгу туда же», "the plate there too"
        while has_goal && until > at + 1 && THERE.contains(&keys[until - 1].as_str()) {
            amends = true;
            until -= 1;
        }
        let said = &text[words.get(at)?.start..words.get(until.checked_sub(1)?)?.end];
        Some(Self { said, amends, denies, is_only_wrong })
    }
}

/// Whether a text is a verb alone that moves things, as an order before does.
fn only_moves(text: &str, order: &str) -> bool {
    let verb = text.trim();
    let moves = |text: &str| {
        let sort = command::clauses(text).first().map(|(_, sort)| *sort);
        matches!(sort, Some(Sort::Put | Sort::Carry))
    };
    matches!(&command::verbs_of(verb)[..], [said] if *said == (0..verb.len()))
        && moves(verb)
        && moves(order)
}

fn has_clauses(text: &str) -> bool {
    !command::clauses(text).is_empty()
}

impl Asker<'_> {
    /// A text without a verb as an order, where it names whither to go or something to be brought.
    pub(super) fn with_verb(&self, text: String, memory: &Memory) -> String {
        if text.trim_end().ends_with('?') || !command::clauses(&text).is_empty() {
            return text;
        }
        // "No, to the bedroom" corrects; where there is nothing to correct, it sends nobody.
        if Anew::of(&text, false).is_some_and(|anew| anew.denies) {
            return text;
        }
        if is_back(&text) {
            return Language::of(&text).pick("вернись", "come back").to_owned();
        }
        // «А теперь на зарядку»
        if let Some(haunt) = Anew::of(&text, false).filter(|anew| command::is_haunt(anew.said)) {
            return format!("{} {}", Language::of(&text).pick("поезжай", "go"), haunt.said);
        }
        if command::has_haunt(&text) {
            return format!("{} {text}", Language::of(&text).pick("поезжай", "go"));
        }
        let sentence = Sentence::new(&text, &self.mind.lexicon);
        let language = sentence.language;
        let knowledge = self.knowledge(language, memory);
        let resolver = Resolver::reading(&knowledge, &sentence);
        let is_room =
            |things: &[Thing]| !things.is_empty() && things.iter().all(|t| t.area().is_some());
        let verb = sentence.items().into_iter().find_map(|item| match item {
            Item::Place { rel, nouns, .. } => {
                let phrase = nouns.first()?;
                let whither = resolver.is_whither(rel, phrase) == Some(true);
                whither.then(|| language.pick("поезжай", "go"))
            }
            Item::Noun(phrase) if phrase.person.is_none() && phrase.pronoun.is_none() => {
                let base = knowledge.base(&phrase.noun.head);
                let portable =
                    |t: &Thing| t.replica().is_some_and(|id| self.world.has_trait(id, "portable"));
                if base.iter().any(portable) {
                    Some(language.pick("принеси", "bring"))
                } else {
                    is_room(&base).then(|| language.pick("поезжай", "go"))
                }
            }
            _ => None,
        });
        match verb {
            Some(verb) => format!("{verb} {text}"),
            None => text,
        }
    }

    /// Whether a text without a verb orders: it says whither, or asks kindly or shortly for what it names.
    #[must_use]
    pub fn orders_tersely(&self, text: &str) -> bool {
        static URGES: Set = Set::named("Urges");
        let keys = word_keys(text);
        // «Да где же эти ключи!» asks, however loud.
        let asks = |n: usize| {
            let said = vocabulary::longest(&keys[n..]).map(|(_, mark)| mark);
            matches!(said, Some(Mark::Where | Mark::HowMany | Mark::HowFar | Mark::When))
        };
        if (0..keys.len()).any(asks) {
            return false;
        }
        let urges = text.contains('!') || keys.iter().any(|key| URGES.contains(&key.as_str()));
        let plain = self.plain(text);
        let with = self.with_verb(plain.clone(), &Memory::default());
        if command::clauses(&plain).is_empty() && !command::clauses(&with).is_empty() {
            let goes = with.starts_with("поезжай") || with.starts_with("go ");
            return urges
                || is_back(&plain)
                || (goes && keys.first().is_some_and(|key| command::says_whither(key)));
        }
        false
    }

    /// The last command with what these words put in the place of what it was done to, of where that is, or of whither
    /// it went. One that asked back, and so `is_open`, needs no "no" before them.
    pub(super) fn amended(
        &self,
        text: &str,
        ordered: &Ordered,
        memory: &Memory,
        is_open: bool,
    ) -> Option<String> {
        let anew = Anew::of(text, ordered.goal.is_some())?;
        if anew.is_only_wrong || text.trim_end().ends_with('?') {
            return None;
        }
        // «Надо было на диван – переложи»
        let said = match anew.said.rsplit_once([',', ';', '–', '—']) {
            Some((said, verb))
                if anew.denies && !has_clauses(said) && only_moves(verb, &ordered.text) =>
            {
                said
            }
            _ => anew.said,
        };
        let anew = Anew { said, ..anew };
        if has_clauses(anew.said) {
            return ordered.with_verb(anew.said).filter(|_| is_open);
        }
        // To a place of its own it goes itself, whatever it carried and whithersoever.
        let goes_itself = ordered.object.is_none() || !anew.denies && !is_open;
        if anew.amends && goes_itself && command::is_haunt(anew.said) {
            let goes = Language::of(anew.said).pick("поезжай", "go");
            return Some(format!("{goes} {}", anew.said));
        }
        let plain = self.plain(anew.said);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let knowledge = self.knowledge(sentence.language, memory);
        let resolver = Resolver::reading(&knowledge, &sentence);
        let items = sentence.items();
        // "The one on the side table": what it is done to, told by its place.
        let lone = match &items[..] {
            [Item::Noun(phrase), places @ ..] => {
                let is_placed = |item: &Item| matches!(item, Item::Place { .. });
                phrase.noun.head.anything
                    && phrase.pronoun.is_none()
                    && places.iter().all(is_placed)
            }
            _ => false,
        };
        let tells = |item: &Item| match item {
            Item::Place { .. } | Item::Value(_) => true,
            Item::Noun(phrase) => phrase.noun.head.anything && phrase.pronoun.is_none(),
            _ => false,
        };
        if !(anew.amends || lone || is_open && items.iter().all(tells)) {
            return None;
        }
        // What is said anew: of what it is done to, of whither.
        let goal = items.iter().enumerate().position(|(n, item)| match item {
            Item::Place { rel, nouns, .. } => nouns.first().is_some_and(|p| {
                let open = || !(lone && n == 1) && ordered.goes_where_it_says(*rel);
                resolver.is_whither(*rel, p).unwrap_or_else(open)
            }),
            _ => false,
        });
        let (object, goal) = items.split_at(goal.unwrap_or(items.len()));
        // "On a chair in the kitchen": whither may be told by where that is.
        let tells_where = |item: &Item| match item {
            Item::Place { rel: Rel::From | Rel::Through | Rel::To, .. } => false,
            Item::Place { rel, nouns, .. } => {
                nouns.first().is_some_and(|p| resolver.is_whither(*rel, p) != Some(true))
            }
            _ => false,
        };
        if items.is_empty() || !goal.iter().skip(1).all(tells_where) {
            return None;
        }
        let starts = match goal.first() {
            Some(Item::Place { nouns, .. }) => {
                let link = command::link_before(&sentence.keys, nouns.first()?.words.start);
                sentence.words.get(nouns.first()?.words.start - link)?.start
            }
            _ => plain.len(),
        };
        let (of_object, whither) = (plain[..starts].trim(), plain[starts..].trim());
        let are_places =
            |items: &[Item]| items.iter().all(|item| matches!(item, Item::Place { .. }));
        let mut is_placed = false;
        let said = match object {
            [] => None,
            // "Go to the kitchen. – No, the bedroom"
            [Item::Noun(phrase), places @ ..]
                if goal.is_empty()
                    && are_places(places)
                    && ordered.is_done_to_none_of(&knowledge, phrase) =>
            {
                return ordered.with_goal_noun(of_object);
            }
            [Item::Noun(phrase), places @ ..]
                if phrase.person.is_none() && phrase.pronoun.is_none() && are_places(places) =>
            {
                let kindless = phrase.noun.head.anything;
                // "The other ones" are not where the first was, either.
                is_placed =
                    !places.is_empty() || !phrase.noun.restrictions.is_empty() || phrase.noun.other;
                Some(self.amending(of_object, kindless, ordered, sentence.language)?)
            }
            [Item::Value(_)] => Some(self.amending(of_object, true, ordered, sentence.language)?),
            // "No, from the kitchen"
            places if are_places(places) && goal.is_empty() => {
                return ordered.with_place(of_object);
            }
            _ => return None,
        };
        if let (Some(said), Some((at, _)), true) = (&said, &ordered.object, whither.is_empty()) {
            // "Take the phone from the sofa. – No, the one on the table": no longer from the sofa.
            if is_placed {
                return Some(ordered.retold(&[(at, said)]));
            }
            let mut whole = ordered.without_there(at.end);
            whole.replace_range(at.clone(), said);
            return Some(whole);
        }
        // What was carried elsewhere in vain is what it was, wherever it is now.
        if let (None, Some((at, things)), Some(goal)) = (&said, &ordered.object, &ordered.goal)
            && ordered.is_resolved
            && !whither.is_empty()
        {
            let names = self.knowledge(ordered.language, memory).listed(things, Case::Accusative);
            return Some(ordered.retold(&[(at, &names), (goal, whither)]));
        }
        let mut whole = ordered.text.clone();
        // From the end, so that the places before stay where they are.
        match (&ordered.goal, whither.is_empty()) {
            (_, true) => {}
            (Some(goal), false) => whole.replace_range(goal.clone(), whither),
            (None, false) => {
                let (object, _) = ordered.object.as_ref()?;
                whole = format!("{} {whither}", &whole[..object.end]);
            }
        }
        if let Some(said) = said {
            let (at, _) = ordered.object.clone()?;
            if ordered.goal.as_ref().is_some_and(|goal| goal.start < at.start)
                && !whither.is_empty()
            {
                return None;
            }
            whole.replace_range(at, &said);
        }
        Some(whole)
    }

    /// What a command is done to instead: «красную» is of the kind of what was meant.
    fn amending(
        &self,
        said: &str,
        kindless: bool,
        ordered: &Ordered,
        language: Language,
    ) -> Option<String> {
        if !kindless {
            return Some(said.to_owned());
        }
        let (_, things) = ordered.object.as_ref()?;
        // "One" of whatever there is, is of no kind.
        self.knowledge(language, &Memory::default()).alike(things)?;
        let kind = things.last().and_then(|t| self.kind_of(*t, language))?;
        // «тот, что на полке»
        if let Some((_, place)) = said.split_once(" что ").or(said.split_once(" который "))
        {
            return Some(format!("{kind} {place}"));
        }
        // "the one from the shelf"
        if let Some((before, behind)) = said.split_once("one ") {
            return Some(format!("{before}{kind} {behind}"));
        }
        Some(match said.strip_suffix(" ones") {
            Some(bare) => format!("{bare} {}", english::plural(&kind)),
            None => format!("{} {kind}", said.strip_suffix(" one").unwrap_or(said)),
        })
    }

    /// The same of a door as well.
    pub(in crate::question) fn kind_word(
        &self,
        thing: Thing,
        language: Language,
    ) -> Option<String> {
        match thing {
            Thing::Entity(Entity::Door(_)) => {
                let mut words = of_kind("Concept.");
                let (_, noun) = words
                    .find(|&(name, word)| name == "Doors" && Language::of(word) == language)?;
                Some(NounPhrase::parse(noun, &WordHints::default()).case(Case::Accusative))
            }
            thing => self.kind_of(thing, language),
        }
    }

    /// What a thing is called by its type; in Russian as an object of a verb.
    fn kind_of(&self, thing: Thing, language: Language) -> Option<String> {
        let object = self.world.replicas.get(&thing.replica()?)?.object;
        let kind = self.world.types.object.get(self.world.objects.get(&object)?.object_type)?;
        Some(match language {
            Language::English if !kind.name_en.is_empty() => kind.name_en.to_lowercase(),
            _ => {
                let hints = crate::names::hints_of_type(kind);
                let noun = NounPhrase::parse(&kind.name.to_lowercase(), &hints);
                noun.case(Case::Accusative)
            }
        })
    }

    /// «Есть ли яблоки в спальне? – Яблоко-1 и Яблоко-2. – Принеси одно», "put one of them on the sofa": the nearest of those
    /// that were told.
    ///
    /// # Errors
    /// "One of them" of several kinds, or where nothing was told that this can be done to.
    pub(super) fn with_one_of_those(
        &self,
        mut text: String,
        memory: &Memory,
    ) -> Result<String, (Doubt, Range<usize>)> {
        static ONE: Set = Set::named("OneOfThem");
        static THEM: Set = Set::named("OfThem");
        static SMALL: Set = Set::named("AroundOne");
        let (words, keys) = (word_ranges(&text), word_keys(&text));
        let is = |n: usize, all: &[&str]| keys.get(n).is_some_and(|key| all.contains(&&**key));
        let of_them = |n: &usize| {
            // "One of those cups" names them.
            let ends = is(n + 2, &["them", "них"])
                || keys.len() == n + 3
                || text[words[n + 2].end..words[n + 3].start].contains([',', '.', '!']);
            is(*n, &ONE) && is(n + 1, set!("Of")) && is(n + 2, &THEM) && ends
        };
        let said = (0..keys.len().saturating_sub(2)).find(of_them).map(|n| (n, n + 2));
        // "Put one in the fridge": the place says whither, and the one is of those that were told.
        let whither = |at: usize| {
            let verbs = command::clauses(&text);
            let puts = matches!(verbs[..], [(_, Sort::Put)]);
            let described = command::without_verbs(&text);
            let first = word_ranges(&described).into_iter().next();
            let is_first = first.is_some_and(|first| first.start == words[at].start);
            let placed = matches!(
                keys.get(at + 1..).and_then(vocabulary::longest),
                Some((_, Mark::Link(Rel::In | Rel::On)))
            );
            puts && is_first && placed
        };
        let bare = || {
            let described = word_keys(&command::without_verbs(&text));
            let is_one = |key: &&String| ONE.contains(&key.as_str());
            let all = described.iter().all(|key| is_one(&key) || SMALL.contains(&key.as_str()));
            let once = all && described.iter().filter(is_one).count() == 1;
            let at = keys.iter().position(|key| ONE.contains(&key.as_str()))?;
            (once || whither(at)).then_some((at, at))
        };
        let language = Language::of(&text);
        let knowledge = self.knowledge(language, memory);
        let alike = memory.last.len() > 1 && knowledge.alike(&memory.last).is_some();
        let Some((first, last)) = said.or_else(|| bare().filter(|_| alike)) else {
            return Ok(text);
        };
        let at = words[first].start..words[last].end;
        let sort = command::clauses(&text).first().map_or(Sort::Other, |(_, sort)| *sort);
        let genders = genders(&keys[first..=first]);
        let agrees = |t: &Thing| {
            genders.is_empty() || genders.iter().any(|gender| knowledge.agrees(*gender, *t))
        };
        let can = |t: &Thing| knowledge.can(sort, *t) && agrees(t);
        let fit: Vec<Thing> = memory.last.iter().copied().filter(can).collect();
        let away = |t: &Thing| knowledge.distance(*t, Thing::Robot).unwrap_or(f64::INFINITY);
        let nearest = fit.iter().min_by(|a, b| away(a).total_cmp(&away(b)).then(a.cmp(b)));
        match nearest {
            Some(nearest) if memory.last.len() > 1 && knowledge.alike(&fit).is_some() => {
                text.replace_range(at, &knowledge.form(*nearest, Case::Accusative));
                Ok(text)
            }
            _ if said.is_none() => Ok(text),
            Some(_) if fit.len() > 1 => {
                let reference = text[at.clone()].to_owned();
                Err((Doubt::Ambiguous { reference, candidates: fit }, at))
            }
            _ => Err((Doubt::not_understood(&text[at.clone()]), at)),
        }
    }

    /// An adjective without its noun: «красную» is of the kind of what was spoken of.
    pub(super) fn with_noun(&self, mut text: String, memory: &Memory) -> String {
        const ENDINGS: [&str; 7] = ["ую", "юю", "ый", "ий", "ой", "ое", "ее"];
        let (words, keys) = (word_ranges(&text), word_keys(&text));
        let ends = |n: usize| match words.get(n) {
            Some(next) => {
                let gap = !text[words[n - 1].end..next.start].trim().is_empty();
                gap || set!("AroundMine").contains(&keys[n].as_str())
            }
            None => true,
        };
        let adjective = |n: &usize| ENDINGS.iter().any(|ending| keys[*n].ends_with(ending));
        let lone = (1..words.len()).filter(|n| ends(n + 1)).find(adjective);
        let Some(n) = lone.filter(|_| !memory.last.is_empty()) else { return text };
        let value = self.mind.lexicon.values.longest(&keys[n..]);
        let other = set!("OtherOne").contains(&keys[n].as_str());
        let told = other || value.is_some_and(|(taken, _)| taken == 1);
        let last = memory.last_things().into_iter().rev().find(|t| t.replica().is_some());
        let noun = last.filter(|_| told).and_then(|t| self.kind_of(t, Language::of(&text)));
        if let Some(noun) = noun {
            text.insert_str(words[n].end, &format!(" {noun}"));
        }
        text
    }

    /// What a pronoun means in a command: what was spoken of last, and of that only what its verb can be done to.
    pub(super) fn spoken_of(&self, text: &str, memory: &Memory) -> Vec<Thing> {
        static BOTH: Set = Set::named("BothWord");
        let mut last = memory.last_things();
        // «Верни обе на место»: the one before too, of the same kind.
        if let [only] = last[..]
            && word_keys(text).iter().any(|key| BOTH.contains(&key.as_str()))
        {
            let kind = |t: &Thing| self.kind_of(*t, Language::of(text));
            let other = memory.spoken.iter().find(|t| **t != only && kind(t) == kind(&only));
            last.splice(0..0, other.copied());
        }
        let sort = command::clauses(text).first().map_or(Sort::Other, |(_, sort)| *sort);
        let knowledge = self.knowledge(Language::of(text), memory);
        // «Поставь её сюда» is no kettle, which is «он».
        let pronouns = self.pronouns(text);
        let agrees = |t: &Thing| pronouns.iter().all(|p| knowledge.agrees(*p, *t));
        let free = matches!(sort, Sort::Go | Sort::Find | Sort::Leave | Sort::Other);
        let fits = |t: &Thing| (free || knowledge.can(sort, *t)) && agrees(t);
        let several = |p: &Pronoun| matches!(p, Pronoun::They | Pronoun::There);
        // «Есть ли яблоки? – Одно. – А яйцо? – … – Принеси их»: both.
        if pronouns.contains(&Pronoun::They)
            && last.len() == 1
            && let Some(pair) = knowledge.last_pair().filter(|pair| pair.iter().all(fits))
        {
            return pair;
        }
        // "Where are the chairs? – … – Bring the pillow. Go to them": one thing is no "them", where several were told before.
        if let ([only], true) = (&last[..], free && pronouns.contains(&Pronoun::They))
            && !memory.is_plural
            && knowledge.gender(*only).1 != Number::Plural
        {
            let mut told = memory.exchanges.iter().map(|e| {
                let told = e.topics().iter().chain(e.members()).copied();
                told.filter(fits).collect::<Vec<_>>()
            });
            if let Some(several) = told.find(|all| all.len() > 1) {
                return several;
            }
        }
        // «На складе стол и чашка. – Принеси её»: what can be carried, and is «она».
        if !pronouns.is_empty()
            && !pronouns.iter().any(several)
            && let [only] = last.iter().filter(|t| fits(t)).collect::<Vec<_>>()[..]
        {
            return vec![*only];
        }
        // «В каких комнатах есть лампы? – … – Выключи их»: no rooms, but what they have; and of several exchanges the latest
        // in which there are several such things.
        if pronouns.contains(&Pronoun::They) && !free && !last.iter().any(fits) {
            let of = |all: Vec<Thing>| -> Vec<Thing> { all.into_iter().filter(fits).collect() };
            let told = memory.exchanges.iter().map(|e| of(e.things().copied().collect()));
            let all = knowledge.had_by_rooms().into_iter().map(of).chain(told);
            if let Some(several) = all.into_iter().find(|all| all.len() > 1) {
                return several;
            }
        }
        if last.iter().any(fits) || free && pronouns.is_empty() {
            return last;
        }
        // «Где яблоко? Где тостер? Принеси его»: what was asked of last, and not what was left for it.
        let newest = memory.exchanges.first().and_then(Exchange::topic).filter(agrees);
        if let Some(newest) = newest.filter(|t| !free && knowledge.is_akin(sort, *t)) {
            return vec![newest];
        }
        match memory.spoken.iter().find(|t| fits(t)) {
            Some(earlier) => vec![*earlier],
            None => last.into_iter().filter(agrees).collect(),
        }
    }

    /// «И в гостиной тоже включи», «выключи обратно»: what was switched last, where this says, or as it was before.
    ///
    /// # Errors
    /// The order before switched nothing that it could undo.
    pub(super) fn with_object(
        &self,
        text: String,
        is_back: bool,
        memory: &Memory,
    ) -> Result<String, Doubt> {
        let [(_, sort @ (Sort::Switch | Sort::Door))] = command::clauses(&text)[..] else {
            return Ok(text);
        };
        let described = command::without_verbs(&text);
        let sentence = Sentence::new(&described, &self.mind.lexicon);
        let items = sentence.items();
        let places = items.iter().any(|item| matches!(item, Item::Place { .. }));
        let nouns = items.iter().any(|item| matches!(item, Item::Noun(_)));
        if nouns || !is_back && (!places || sort == Sort::Door) {
            return Ok(text);
        }
        let alike = |ordered: &&Ordered| {
            !is_back
                || matches!(command::clauses(&ordered.text)[..], [(_, before)] if before == sort)
        };
        let ordered = memory.ordered.as_ref().filter(alike);
        let ordered = ordered.and_then(|ordered| Some((ordered.object.as_ref()?, ordered)));
        let bare = text.trim_end_matches(['.', '!']);
        Ok(match ordered {
            Some(((_, things), ordered)) if is_back && ordered.is_resolved => {
                let knowledge = self.knowledge(ordered.language, memory);
                format!("{bare} {}", knowledge.listed(things, Case::Accusative))
            }
            Some(((at, _), ordered)) if !is_back => format!("{bare} {}", &ordered.text[at.clone()]),
            _ if is_back => return Err(Doubt::not_understood(&text)),
            _ => text,
        })
    }
}
