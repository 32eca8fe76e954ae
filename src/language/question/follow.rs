//! Going on from the question before: «А чайник?», "And the other one?", «Красная» where it was asked back which.

use super::another_place::{another_placed, near_another};
use super::bare::{
    by_how_much, compared_otherwise, room_alone, where_alone, where_such, which_alone, which_of_all,
};
use super::focus::without_article;
use super::grammar::{Item, Phrase, Sentence};
use super::mark::{Mark, Pronoun};
use super::query::Denial;
use super::{
    Asker, Best, Claim, Extreme, Head, Memory, Noun, Query, Rel, Restriction, Thing, assemble,
    several, vocabulary,
};
use crate::map::{Entity, World};
use crate::names::english_name;
use crate::sets::{Set, set};
use crate::words::{Language, phrase_at, word_keys, word_ranges};

/// What begins a question that goes on from the one before.
static GOING_ON: Set = Set::named("GoesOnFrom");

/// Whether such words begin a text, of which this is the key.
fn goes_on(key: &str) -> bool {
    GOING_ON.iter().any(|b| key.strip_prefix(b).is_some_and(|rest| rest.starts_with(' ')))
}

impl Asker<'_> {
    /// «На сколько?»: by how much what was told is more than the other, whichever was named first.
    fn by_how_much(&self, key: &str, last: &Query, memory: &Memory) -> Option<Query> {
        let mut query = by_how_much(key, last, &memory.last)?;
        if let (Query::WhichMore { .. }, Query::Larger { what, than, .. }) = (last, &mut query) {
            let found = self.knowledge(memory.language, memory).find(than, false);
            if found.is_ok_and(|found| found == memory.last) {
                std::mem::swap(what, than);
            }
        }
        Some(query)
    }

    /// «А чайник?» after a question about something else: the same question about the kettle.
    pub(super) fn continued(&self, text: &str, memory: &Memory) -> Option<Query> {
        if let Some(query) = self.more_of_ordered(text, memory) {
            return Some(query);
        }
        let waiting = memory.pending.as_ref().map(|pending| &pending.query);
        let last = waiting.or(memory.query.as_ref())?;
        let key = crate::units::name_key(text);
        if asks_anew(&key) {
            return Some(last.clone());
        }
        // "No, I meant the bed": the same is asked of that.
        if let Some(meant) = corrected(text) {
            let and = Language::of(text).pick("а", "and");
            return self.continued(&format!("{and} {meant}"), memory);
        }
        // "Only those on the table": the same is asked of those.
        let words = word_ranges(text);
        let only = set!("OnlyWord").contains(&word_keys(text).first().map_or("", String::as_str));
        if let (true, Some(rest)) = (only, words.get(1)) {
            let and = Language::of(text).pick("а", "and");
            return self.continued(&format!("{and} {}", &text[rest.start..]), memory);
        }
        // «А на том, что в гостиной?» points.
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        if let Some(query) = self
            .another_pointed(&sentence, last, memory)
            .or_else(|| counted_anew(&sentence, last, memory))
        {
            return Some(query);
        }
        if sentence.language == Language::Russian
            && (0..sentence.keys.len()).any(|at| sentence.points_ahead(at))
        {
            return None;
        }
        if let Some(query) = self.one_of_asked(&sentence, last, memory) {
            return Some(query);
        }
        if let Some(query) = where_such(&sentence, last) {
            return Some(query);
        }
        if let Some(query) =
            self.of_the_way(text, last).or_else(|| self.by_how_much(&key, last, memory))
        {
            return Some(query);
        }
        if let Some(query) = self.of_the_rest(text, memory) {
            return Some(query);
        }
        if let Some(query) = self.other_side(text, memory) {
            return Some(query);
        }
        if let Some(query) = self.more_than_there(text, memory) {
            return Some(query);
        }
        if let Some(query) = self.more_of_those(text, memory) {
            return Some(query);
        }
        if let Some(query) = self.more_of_counted(text, memory) {
            return Some(query);
        }
        if let Some(query) = self.altogether(&plain, last, memory) {
            return Some(query);
        }
        if let Some(query) = self.how_many_told(text, memory) {
            return Some(query);
        }
        if let Some(query) = self.but_for(&sentence, last, memory) {
            return Some(query);
        }
        if let Some(query) =
            which_of_all(&sentence, last).or_else(|| compared_otherwise(&sentence, last))
        {
            return Some(query);
        }
        if let Some(query) = self.another_pair(&sentence, last) {
            return Some(query);
        }
        if let Some(query) = self.most_had(&sentence, last) {
            return Some(query);
        }
        if let Some(query) = self.count_of_kind(&sentence, memory) {
            return Some(query);
        }
        if let Some(query) = self.another_asked(&key, last, memory) {
            return Some(query);
        }
        // «Где лежат часы? А в гостиной есть?»: others of the kind, there.
        if let (Query::Where(of), Some(placed)) =
            (last, text.trim_end_matches(['?', ' ']).strip_suffix(" есть"))
            && goes_on(&key)
            && let Some(place) = self.bare_place(placed, memory)
        {
            let things = of.head.things.clone().unwrap_or_default();
            let kind = self.knowledge(sentence.language, memory).alike(&things);
            let kinds = kind.map_or_else(|| of.head.kinds.clone(), |kind| vec![kind]);
            if kinds.is_empty() {
                return None;
            }
            let head = Head { kinds, ..Head::default() };
            let what = vec![Noun { head, restrictions: place, plural: true, ..Noun::default() }];
            return Some(Query::Exists { what, either: false, denial: Denial::None });
        }
        // «Сколько телевизоров? А на кухне есть?»
        if let Some(placed) = text.trim_end_matches(['?', ' ']).strip_suffix(" есть")
            && goes_on(&key)
            && let Some(query) = self.continued(placed, memory)
            && last
                .sought()
                .is_some_and(|old| query.sought().is_some_and(|noun| noun.head == old.head))
            && last.sought().is_some_and(|old| !old.head.anything)
        {
            return Some(match query {
                Query::Count(noun) | Query::Find(noun) if !noun.head.anything => {
                    Query::Exists { what: vec![noun], either: false, denial: Denial::None }
                }
                query => query,
            });
        }
        if let Some(query) = self.counted_of_listed(text, memory) {
            return Some(query);
        }
        if let Some(query) =
            which_alone(&key, last).or_else(|| where_alone(&sentence, last, memory))
        {
            return Some(query);
        }
        if let Some(query) = room_alone(text, memory) {
            return Some(query);
        }
        if let Some(query) = self.one_more(text, last, memory) {
            return Some(query);
        }
        if let Some(query) = self.more_elsewhere(&sentence, last, memory) {
            return Some(query);
        }
        if let Some(query) = self.placed_too(text, last, memory) {
            return Some(query);
        }
        if let Some(query) = self.placed_there(text, last, memory) {
            return Some(query);
        }
        if let Some(query) = self.another_activity(&sentence, last, memory) {
            return Some(query);
        }
        if let Some(query) = self.anything_such(text, last, memory) {
            return Some(query);
        }
        let of_those = self.asks_of_those(text);
        if !goes_on(&key) && !of_those {
            return None;
        }
        // «А дверь открыта?» asks of itself, «А красная дверь?» as before.
        if let Ok(query @ Query::Holds { .. }) = self.read(text, memory)
            && let Query::Holds { subject, claims, .. } = &query
            && claims.iter().all(|claim| matches!(claim, Claim::Value(_)))
            && subject.filters.is_empty()
            && (!subject.head.kinds.is_empty() || !subject.head.named.is_empty())
        {
            return Some(query);
        }
        let said = word_keys(text).len();
        let text = &self.plain(text);
        let sentence = Sentence::new(text, &self.mind.lexicon);
        // "And how many cups?" goes on as "And cups?" does; "how many in all?" does not.
        let counted =
            counted_alone(&sentence, said).filter(|_| !of_those && matches!(last, Query::Count(_)));
        let counts = counted.is_none() && sentence.items().contains(&Item::Mark(Mark::HowMany));
        let mut noun = match counted {
            Some(noun) => noun,
            None => self.fragment(&sentence, memory)?,
        };
        // «А мыло там?» tells its place itself.
        let placed = matches!(last, Query::Where(_) | Query::RoomOf(_) | Query::Holds { .. });
        let names = noun.head != Head::default();
        if names && !placed && noun.restrictions.iter().any(|r| r.rel == Rel::There) {
            return None;
        }
        // «А сколько из них белых?» tells by itself of what.
        let of_told = |r: &super::Restriction| matches!(r.rel, Rel::From | Rel::Of);
        if counts && noun.restrictions.iter().any(of_told) {
            return None;
        }
        // «Какая картина висит ниже всех? А выше всех?» goes on about where they hang.
        let level = |best: &Best| matches!(best.extreme, Extreme::Topmost | Extreme::Bottommost);
        let mut hangs = false;
        query_nouns(last, &mut |old| hangs |= old.best.as_ref().is_some_and(level));
        if let Some(best) = noun.best.as_mut().filter(|_| hangs && keys_compare(&sentence.keys)) {
            best.extreme = match best.extreme {
                Extreme::Tallest => Extreme::Topmost,
                Extreme::Lowest => Extreme::Bottommost,
                other => other,
            };
        }
        // "Which chair is nearest to the table? And the second nearest?": to the table.
        let near = |best: &Best| matches!(best.extreme, Extreme::Nearest | Extreme::Farthest);
        if let Some(best) = noun.best.as_mut().filter(|b| b.anchor.is_none() && near(b)) {
            query_nouns(last, &mut |old| {
                let before = old.best.as_ref().filter(|before| near(before));
                if let Some(before) = before.filter(|_| best.anchor.is_none()) {
                    best.anchor.clone_from(&before.anchor);
                }
            });
        }
        // «В какой комнате больше всего картин? А меньше всего?» goes on about how many.
        let mut counted = None;
        query_nouns(last, &mut |old| {
            let many = |best: &&Best| matches!(best.extreme, Extreme::Most | Extreme::Fewest);
            counted = counted.take().or_else(|| old.best.as_ref().filter(many).cloned());
        });
        if let (Some(best), Some(counted)) =
            (noun.best.as_mut().filter(|b| b.anchor.is_none()), counted)
        {
            let extreme = match best.extreme {
                Extreme::Biggest | Extreme::Most => Some(Extreme::Most),
                Extreme::Smallest | Extreme::Fewest => Some(Extreme::Fewest),
                _ => None,
            };
            if let Some(extreme) = extreme {
                *best = Best { extreme, anchor: counted.anchor };
            }
        }
        // "Which one is the smallest?"
        if noun.head.anything && noun.best.is_some() && noun.restrictions.is_empty() {
            noun.head = Head::default();
        }
        let mut query = last.clone();
        if let (true, false, Query::Count(old) | Query::Find(old)) =
            (of_those, noun.restrictions.is_empty(), last)
        {
            // "Which chairs are in the kitchen? Which ones are in the hall?": none is in both.
            let bare = Noun { head: Head::default(), text: String::new(), ..noun.clone() };
            if let Some(query) = self.in_another_room(last, &bare) {
                return Some(query);
            }
            let mut asked = old.clone();
            asked.restrictions.extend(noun.restrictions);
            asked.filters.extend(noun.filters);
            return Some(Query::Find(asked));
        }
        // "And the one in the living room?": another of what was asked of.
        let told = !noun.restrictions.is_empty() || !noun.filters.is_empty();
        let another = noun.head.anything && told && noun.best.is_none();
        if another && let Some(query) = another_placed(last, &noun) {
            return Some(query);
        }
        if let Some(query) = self.in_another_room(last, &noun).filter(|_| !counts) {
            return Some(query);
        }
        if let Some(query) = self.of_another_owner(last, &noun).filter(|_| !counts) {
            return Some(query);
        }
        if let Some(query) = near_another(last, &noun).filter(|_| !counts) {
            return Some(query);
        }
        if noun.head == Head::default() {
            let query = self.elsewhere(query, noun)?;
            return match (counts, query.sought()) {
                (false, _) if of_those => match query {
                    Query::Count(noun) => Some(Query::Find(noun)),
                    query => Some(query),
                },
                (false, _) => Some(query),
                // «А на кухне сколько?», and of what a room has most.
                (true, sought) => {
                    let sought = sought?;
                    Some(Query::Count(match sought.best.as_ref().map(|best| &best.anchor) {
                        Some(Some(had)) => {
                            let place = sought.restrictions.clone();
                            Noun { restrictions: place, plural: true, ..(**had).clone() }
                        }
                        _ => sought.clone(),
                    }))
                }
            };
        }
        if counts {
            return None;
        }
        if let Some(query) = self.another_had(last, &noun) {
            return Some(query);
        }
        // "How far is it from the charger? And the toolbox?": from there.
        if let Query::Way { to, .. }
        | Query::CanReach { to, .. }
        | Query::Duration { to, .. }
        | Query::Distance { to, .. } = &mut query
        {
            *to = noun;
            return Some(query);
        }
        // «Сколько стульев в кухне? А спальня?»: a room takes the place of a room.
        let is_room = self.is_room(&noun);
        if let Some(query) = self.around_another(last, &noun).filter(|_| is_room) {
            return Some(query);
        }
        let mut rooms = false;
        query.each_noun(&mut |old| {
            rooms |= self.is_room(old);
            // … or of several.
            let of_rooms = |r: &&mut Restriction| {
                matches!(r.rel, Rel::In | Rel::On) && r.anchors.iter().all(|a| self.is_room(a))
            };
            let places = old.restrictions.iter_mut().filter(of_rooms).filter(|_| is_room);
            places.for_each(|place| place.anchors.truncate(1));
        });
        // "Which of them hangs highest? What about the kitchen?": there.
        if is_room && !rooms && query.sought().is_some() {
            let anchors = vec![Noun { text: noun.text.clone(), ..noun }];
            let restrictions = vec![Restriction { rel: Rel::In, anchors, negated: false }];
            let mut kind = false;
            query.first_noun(|old| kind = self.has_kind(old));
            let place = Noun { restrictions, ..Noun::default() };
            return self.elsewhere(query, place).filter(|_| kind);
        }
        // "How many phones are in the bedroom? Where are they? What about the living room?": where the phones there are.
        if let (Query::Where(old), true, false) = (last, is_room, rooms)
            && old.plural
            && old.head.things.is_some()
        {
            let within = Restriction { rel: Rel::In, anchors: vec![noun], negated: false };
            return self.of_their_kind(old, vec![within]);
        }
        // A room may narrow several nouns of the question: all that mean what is replaced.
        let mut replaced: Option<Noun> = None;
        // "What colour is the floor in the kitchen? And the walls?": those of the kitchen.
        let surface = |noun: &Noun| {
            let knowledge = self.knowledge(sentence.language, memory);
            knowledge.is_floor(noun) || knowledge.is_walls(noun)
        };
        let of_room = |old: &Noun| surface(&noun) && surface(old);
        let sought = query.sought().is_some();
        let keeps = |old: &Noun| (sought || of_room(old)) && noun.restrictions.is_empty();
        // "How many of them are books? And plates?": of them.
        let told = |old: &Noun| {
            let knowledge = self.knowledge(sentence.language, memory);
            let list = knowledge.list_with(old.head.things.as_deref()?)?;
            let anchors = vec![Noun::of(list)];
            Some(Restriction { rel: Rel::From, anchors, negated: false })
        };
        let selects = matches!(last, Query::Count(_) | Query::Find(_));
        query.each_noun(&mut |old| {
            let fits = match &replaced {
                Some(first) => is_room && rooms && old == first,
                None if old.head.anything && !old.restrictions.is_empty() => false,
                None => !(is_room && rooms) || self.is_room(old),
            };
            if fits {
                replaced.get_or_insert_with(|| old.clone());
                // «Сколько на кухне лопаток? А вилок?» stays in the kitchen, «Сколько в ней окон? А картин?» in it.
                let (stays, own) = (keeps(old), of_room(old));
                let placed = |r: &&Restriction| stays && (is_place(r) || own && r.rel == Rel::Of);
                let place: Vec<Restriction> =
                    old.restrictions.iter().filter(placed).cloned().collect();
                let list = told(old).filter(|_| selects && !noun.head.kinds.is_empty());
                *old = Noun { plural: noun.plural || old.plural, ..noun.clone() };
                old.restrictions.extend(place);
                old.restrictions.extend(list);
            }
        });
        replaced.map(|_| query)
    }

    /// "…, and how many cups?": where it was counted before.
    pub(super) fn counted_too(&self, part: &str, memory: &Memory) -> Option<Query> {
        let sentence = Sentence::new(part, &self.mind.lexicon);
        counted_alone(&sentence, 1 + word_keys(part).len())?;
        let and = sentence.language.pick("а", "and");
        self.continued(&format!("{and} {part}"), memory)
    }

    /// "Where is the spoon? – There is no such thing. – And the fork?", "No, I mean the fork": the same is asked of that.
    pub(super) fn of_another_word(&self, text: &str, memory: &Memory) -> Option<String> {
        let (asked, unknown) = memory.unheard.as_ref()?;
        let named = corrected(text).or_else(|| {
            let keys = word_keys(text);
            let begins = GOING_ON.iter().filter_map(|b| phrase_at(&keys, 0, b));
            let begin = begins.max()?;
            word_ranges(text).get(begin).map(|word| &text[word.start..])
        })?;
        let named = named.trim_end_matches(['?', '.', '!', ' ']);
        let sentence = Sentence::new(named, &self.mind.lexicon);
        let noun = self.fragment(&sentence, &Memory::default())?;
        let is_named = !noun.head.kinds.is_empty() || !noun.head.named.is_empty();
        let is_known = is_named && noun.restrictions.is_empty();
        let at = asked.find(unknown.as_str()).filter(|_| is_known)?;
        let named = match without_article(unknown) == unknown {
            true => without_article(named),
            false => named,
        };
        Some(format!("{}{named}{}", &asked[..at], &asked[at + unknown.len()..]))
    }

    /// A description by itself: "the spoons in the kitchen".
    pub(super) fn fragment(&self, sentence: &Sentence<'_>, memory: &Memory) -> Option<Noun> {
        let knowledge = self.knowledge(sentence.language, memory);
        let referent = |pronoun: Pronoun, rel: Option<Rel>| knowledge.referent(pronoun, rel);
        let mut noun = assemble::fragment(sentence, &self.mind.lexicon, &referent)?;
        let waiting = memory.pending.as_ref().map(|pending| &pending.query);
        if let Some(last) = waiting.or(memory.query.as_ref()) {
            repeat_with(sentence, last, &mut noun);
            let sisters = self.sisters(knowledge.world, &noun, last);
            noun.head.named.extend(sisters);
        }
        Some(noun)
    }

    /// "Room 4" after "left consult room 3": the next of its row as well as the room that is called so.
    fn sisters(&self, world: &World, noun: &Noun, last: &Query) -> Vec<Entity> {
        let keys = word_keys(without_article(&noun.text));
        let Some((number, words)) = keys.split_last() else { return Vec::new() };
        let is_number = |key: &str| key.chars().all(|c| c.is_ascii_digit());
        if words.is_empty() || !is_number(number) {
            return Vec::new();
        }
        let mut sisters = Vec::new();
        query_nouns(last, &mut |old| {
            let told = old.head.things.iter().flatten().filter_map(|thing| match thing {
                Thing::Entity(entity) => Some(english_name(world, *entity)),
                _ => None,
            });
            for old in std::iter::once(old.text.as_str()).chain(told) {
                let old = word_keys(without_article(old));
                let Some((of_old, row)) = old.split_last() else { continue };
                if row.len() <= words.len() || !row.ends_with(words) || !is_number(of_old) {
                    continue;
                }
                let name = format!("{} {number}", row.join(" "));
                let sentence = Sentence::new(&name, &self.mind.lexicon);
                let none = |_, _| Vec::new();
                let sister = assemble::fragment(&sentence, &self.mind.lexicon, &none);
                sisters.extend(sister.into_iter().flat_map(|sister| sister.head.named));
            }
        });
        sisters.retain(|sister| !noun.head.named.contains(sister));
        sisters
    }

    /// «Гостиная и кухня смежные? А кухня и спальня?»: the same of two other rooms.
    fn another_pair(&self, sentence: &Sentence<'_>, last: &Query) -> Option<Query> {
        let Query::Holds { subject, claims, denial } = last else { return None };
        let [Claim::Related(place)] = &claims[..] else { return None };
        let items = sentence.items();
        let own = match &items[..] {
            [Item::Mark(Mark::And), own @ ..] => own,
            own => own,
        };
        let [Item::Noun(one), Item::Mark(Mark::And), Item::Noun(other)] = own else { return None };
        let rooms = [subject, &one.noun, &other.noun].into_iter().all(|noun| self.is_room(noun));
        let anchor = matches!(&place.anchors[..], [anchor] if self.is_room(anchor));
        let place = Restriction { anchors: vec![other.noun.clone()], ..place.clone() };
        (rooms && anchor).then(|| Query::Holds {
            subject: one.noun.clone(),
            claims: vec![Claim::Related(place)],
            denial: *denial,
        })
    }

    /// «В какой комнате нет окон? А в какой больше всего?»: of what rooms were asked to have.
    fn most_had(&self, sentence: &Sentence<'_>, last: &Query) -> Option<Query> {
        let Query::Find(rooms) = last else { return None };
        let [Restriction { rel: Rel::Has, anchors, .. }] = &rooms.restrictions[..] else {
            return None;
        };
        let [had] = &anchors[..] else { return None };
        let (mut extreme, mut asks) = (None, false);
        for item in sentence.items() {
            match item {
                Item::Mark(Mark::Best(of)) if extreme.is_none() => extreme = Some(of),
                Item::Mark(Mark::Which | Mark::Where) => asks = true,
                Item::Mark(Mark::And | Mark::Be | Mark::The | Mark::Have | Mark::Exists) => {}
                Item::Link(Rel::In | Rel::On) => {}
                Item::Noun(phrase) if phrase.pronoun == Some(Pronoun::They) => {}
                Item::Noun(phrase)
                    if self.is_room(&phrase.noun) && phrase.noun.head.named.is_empty() => {}
                _ => return None,
            }
        }
        let extreme = match extreme.filter(|_| asks && self.is_room(rooms))? {
            Extreme::Biggest | Extreme::Most => Extreme::Most,
            Extreme::Smallest | Extreme::Fewest => Extreme::Fewest,
            _ => return None,
        };
        let had = Noun { indefinite: true, plural: true, count: None, ..had.clone() };
        let best = Some(Best { extreme, anchor: Some(Box::new(had)) });
        Some(Query::Find(Noun { best, restrictions: Vec::new(), plural: false, ..rooms.clone() }))
    }

    /// Makes a description one of a kind, whichever of the kind it was; false where it is of none.
    pub(super) fn has_kind(&self, noun: &mut Noun) -> bool {
        if noun.head.kinds.is_empty()
            && let Some(things) = noun.head.things.as_deref()
            && let Some(kind) = self.knowledge(Language::English, &Memory::default()).alike(things)
        {
            noun.head = Head { kinds: vec![kind], ..Head::default() };
        }
        let has = !noun.head.kinds.is_empty();
        if has {
            noun.head.named.clear();
        }
        has
    }

    pub(super) fn is_room(&self, noun: &Noun) -> bool {
        let named = |e: &Entity| matches!(e, Entity::Area(_));
        (!noun.head.named.is_empty() && noun.head.named.iter().all(named))
            || noun.head.kinds.iter().any(|k| self.mind.lexicon.is_area(*k))
    }

    /// «Красная» after «Какая чашка – белая или красная?»: the question that waited, with the thing that is meant.
    pub(super) fn clarified(&self, text: &str, memory: &Memory) -> Option<Query> {
        let pending = memory.pending.as_ref()?;
        // "Which is the biggest of the rooms?" asks anew.
        let sentence = Sentence::new(text, &self.mind.lexicon);
        // «А та, что на кухне?» asks with no «что».
        let points = (0..sentence.keys.len().min(2)).any(|at| sentence.points_ahead(at));
        if text.trim_end().ends_with('?') && several::asks_in(text) && !points {
            return None;
        }
        let noun = assemble::fragment(&sentence, &self.mind.lexicon, &|_, _| Vec::new())?;
        let knowledge = self.knowledge(pending.language, memory);
        let mut noun = noun;
        let bare = noun.head.named.is_empty() && noun.head.kinds.is_empty();
        if bare {
            // "The second one": of those that were asked back.
            noun.head = Head { things: Some(pending.candidates.clone()), ..Head::default() };
        }
        noun.plural = true;
        let found = knowledge.find(&noun, true).ok()?;
        let meant: Vec<Thing> =
            found.into_iter().filter(|t| pending.candidates.contains(t)).collect();
        let [only] = meant[..] else { return None };
        let mut query = pending.query.clone();
        query.each_noun(&mut |noun| {
            if noun.text == pending.reference {
                // «верхняя полка», asked back of which thing: a part of the one that is meant.
                let level = noun.best.as_ref().is_some_and(|best| best.extreme.is_level());
                let kinds = if level { std::mem::take(&mut noun.head.kinds) } else { Vec::new() };
                noun.head = Head { things: Some(vec![only]), kinds, ..Head::default() };
                noun.filters.clear();
                noun.restrictions.clear();
                noun.best = noun.best.take().filter(|_| level);
            }
        });
        Some(query)
    }
}

/// «Что рядом с диваном? – … – А с кроватью?»: «с» repeats the «рядом с» before, and has nothing.
fn repeat_with(sentence: &Sentence<'_>, last: &Query, noun: &mut Noun) {
    let mut keys =
        sentence.keys.iter().map(String::as_str).skip_while(|key| ["а", "и"].contains(key));
    let with = matches!(keys.next(), Some("с" | "со"));
    let [place] = &mut noun.restrictions[..] else { return };
    if !with || !matches!(place.rel, Rel::Has | Rel::Bears) {
        return;
    }
    let beside = |rel: Rel| matches!(rel, Rel::NextTo | Rel::Near).then_some(rel);
    let mut before = None;
    if let Query::Holds { claims, .. } = last {
        before = claims.iter().find_map(|claim| match claim {
            Claim::Related(place) => beside(place.rel),
            _ => None,
        });
    }
    query_nouns(last, &mut |old| {
        before = before.or_else(|| old.restrictions.iter().find_map(|r| beside(r.rel)));
    });
    place.rel = before.unwrap_or(place.rel);
}

fn query_nouns(query: &Query, act: &mut dyn FnMut(&Noun)) {
    query.clone().each_noun(&mut |noun| act(noun));
}

/// «выше», «ниже», by place as well as by size.
fn keys_compare(keys: &[String]) -> bool {
    keys.iter().any(|key| set!("HigherOrLower").contains(&key.as_str()))
}

/// Whether a relation says where things are, and not what they have or whose they are.
pub(super) fn is_place(place: &Restriction) -> bool {
    let other = [Rel::Has, Rel::Bears, Rel::Of, Rel::From, Rel::Opens, Rel::Through, Rel::To];
    !other.contains(&place.rel)
}

/// «А теперь?», "And now?": the last question, of the map as it has become.
fn asks_anew(key: &str) -> bool {
    let rest = GOING_ON.iter().find_map(|begin| key.strip_prefix(begin)).unwrap_or(key);
    let words = word_keys(rest);
    vocabulary::taken_by(Mark::Now, &words).is_some_and(|taken| taken == words.len())
}

/// «Сколько их там теперь?», "How many are there now?": what was asked for, counted as it has become. Whither something
/// was taken since may be "there" as well.
fn counted_anew(sentence: &Sentence<'_>, last: &Query, memory: &Memory) -> Option<Query> {
    let keys = &sentence.keys;
    let now = (0..keys.len()).any(|n| vocabulary::taken_by(Mark::Now, &keys[n..]).is_some());
    let they = |phrase: &Phrase| phrase.pronoun == Some(Pronoun::They);
    let mut counts = false;
    let small = sentence.items().iter().all(|item| match item {
        Item::Mark(mark) => {
            counts |= *mark == Mark::HowMany;
            let idle =
                [Mark::HowMany, Mark::And, Mark::Be, Mark::Exists, Mark::Filler, Mark::There];
            idle.contains(mark)
        }
        Item::Noun(phrase) => they(phrase) || phrase.person == Some(Mark::There),
        Item::Place { rel: Rel::From | Rel::Of, nouns, .. } => nouns.iter().all(they),
        _ => false,
    });
    let (Query::Count(noun) | Query::Find(noun)) = last else { return None };
    let asked = now && counts && small && memory.told_place.is_none();
    let places = &noun.restrictions;
    let placed = noun.best.is_none() && !places.is_empty() && places.iter().all(is_place);
    (asked && placed).then(|| Query::Count(Noun { plural: true, ..noun.clone() }))
}

/// What was meant in place of what was heard: "No, I meant the bed", «Нет, я имел в виду кровать».
fn corrected(text: &str) -> Option<&str> {
    static MEANT: Set = Set::named("IMeant");
    static NO: Set = Set::named("NoOrSorry");
    let keys = word_keys(text);
    let denied = usize::from(keys.first().is_some_and(|key| NO.contains(&key.as_str())));
    let meant = MEANT.iter().find_map(|meant| phrase_at(&keys, denied, meant))?;
    word_ranges(text).get(denied + meant).map(|word| &text[word.start..])
}

/// «А сколько чашек?»: what is counted, where of so many words none says anything else.
fn counted_alone(sentence: &Sentence<'_>, said: usize) -> Option<Noun> {
    let items = sentence.items();
    let small = |item: &Item| {
        matches!(item, Item::Noun(_) | Item::Mark(Mark::And | Mark::HowMany | Mark::The | Mark::A))
    };
    let mut nouns = items.iter().filter_map(|item| match item {
        Item::Noun(phrase) => Some(phrase),
        _ => None,
    });
    let counts = items.contains(&Item::Mark(Mark::HowMany)) && items.iter().all(small);
    let phrase = nouns.next().filter(|_| counts && nouns.next().is_none())?;
    // "And", and «сколько» or "how many".
    let others = 1 + sentence.language.pick(1, 2);
    (said <= others + phrase.words.len()).then(|| phrase.noun.clone())
}
