//! A command that waits for the person to say which thing was meant, and the reply that lets it go on.

use std::ops::Range;

use super::Resolver;
use super::open::without;
use super::terse::Anew;
use crate::command::{self, Sort};
use crate::map::Entity;
use crate::question::assemble;
use crate::question::grammar::{Item, Phrase, Sentence};
use crate::question::knowledge::Knowledge;
use crate::question::mark::Mark;
use crate::question::memory::{Ordered, Waiting};
use crate::question::query::{Best, Extreme, Head, Noun, Rel, Thing};
use crate::question::{Aside, Asker, Memory, aside, vocabulary};
use crate::sets::Set;
use crate::units::{InOrder as _, name_key};
use crate::words::{Case, word_keys, word_ranges};

impl Ordered {
    /// The command without what told, behind a byte, where its things were; what is before stays where it is.
    fn without_places(&self, from: usize) -> String {
        let mut text = self.text.clone();
        for told in self.told.iter().rev().filter(|told| told.start >= from) {
            text.replace_range(told.clone(), "");
        }
        text
    }

    /// The command with some of its parts in other words, and nothing that told where its things were.
    pub(super) fn retold(&self, parts: &[(&Range<usize>, &str)]) -> String {
        let free = |told: &&Range<usize>| {
            parts.iter().all(|(at, _)| told.end <= at.start || told.start >= at.end)
        };
        let told = self.told.iter().filter(free).map(|told| (told, ""));
        let mut edits: Vec<(&Range<usize>, &str)> = parts.iter().copied().chain(told).collect();
        edits.order_by_key(|(at, _)| std::cmp::Reverse(at.start));
        let mut text = self.text.clone();
        let mut until = text.len();
        for (at, said) in edits {
            if at.end <= until {
                until = at.start;
                text.replace_range(at.clone(), said);
            }
        }
        text
    }

    /// The command without "from there", which meant something where that was said.
    pub(super) fn without_there(&self, from: usize) -> String {
        static THERE: Set = Set::named("There");
        let points = |told: &&Range<usize>| {
            word_keys(&self.text[(*told).clone()]).iter().any(|key| THERE.contains(&key.as_str()))
        };
        let mut text = self.text.clone();
        if let Some(told) = self.told.iter().filter(|told| told.start >= from).find(points) {
            text.replace_range(told.clone(), "");
        }
        text
    }

    /// Whether a place of this sort, which alone does not tell where from whither, is whither the command goes: "put it on
    /// the table. – No, in the cupboard".
    pub(super) fn goes_where_it_says(&self, rel: Rel) -> bool {
        let Some(goal) = &self.goal else { return false };
        let clauses = command::clauses(&self.text);
        let own = clauses.iter().rev().find(|(start, _)| *start <= goal.start);
        matches!(rel, Rel::In | Rel::On | Rel::Under | Rel::At)
            && own.is_some_and(|(_, sort)| matches!(sort, Sort::Put | Sort::Go))
    }

    /// Whether nothing that words name can be what the command is done to, so that they can only say whither.
    pub(super) fn is_done_to_none_of(&self, knowledge: &Knowledge<'_>, phrase: &Phrase) -> bool {
        let clauses = command::clauses(&self.text);
        let object = self.object.as_ref().map(|(at, _)| at).or(self.goal.as_ref());
        let own =
            clauses.iter().rev().find(|(start, _)| object.is_some_and(|at| *start <= at.start));
        let sort = own.map_or(Sort::Other, |(_, sort)| *sort);
        let named = knowledge.base(&phrase.noun.head);
        let bare =
            phrase.pronoun.is_none() && phrase.person.is_none() && !phrase.noun.head.anything;
        // What is gone to is itself what is named.
        if sort == Sort::Go {
            return bare && self.object.is_none();
        }
        bare && !named.is_empty() && !named.iter().any(|thing| knowledge.can(sort, *thing))
    }

    /// The command with another noun behind the preposition that says whither.
    pub(super) fn with_goal_noun(&self, noun: &str) -> Option<String> {
        let goal = self.goal.clone()?;
        let said = &self.text[goal.clone()];
        let (words, keys) = (word_ranges(said), word_keys(said));
        let link = (1..keys.len()).rev().find(|&n| command::link_before(&keys, n) == n)?;
        let mut whole = self.text.clone();
        whole.replace_range(goal.start + words[link].start..goal.end, noun);
        Some(whole)
    }

    /// The command with a verb alone for its own: «Включи лампу. – Нет, выключи».
    pub(super) fn with_verb(&self, verb: &str) -> Option<String> {
        let verb = verb.trim_end_matches(['.', '!']);
        let ([said], [own]) = (&command::verbs_of(verb)[..], &command::verbs_of(&self.text)[..])
        else {
            return None;
        };
        let alone = *said == (0..verb.len());
        let sort = |text| command::clauses(text).first().map(|(_, sort)| *sort);
        let alike = || sort(verb) == sort(&self.text);
        let mut whole = self.text.clone();
        whole.replace_range(own.clone(), verb);
        (alone && alike()).then_some(whole)
    }

    /// The command with this for where what it is done to is.
    pub(super) fn with_place(&self, place: &str) -> Option<String> {
        let (object, _) = self.object.as_ref()?;
        let mut whole = self.text.clone();
        match &self.told[..] {
            [] => whole.insert_str(object.end, &format!(" {place}")),
            [told] => whole.replace_range(told.clone(), &format!(" {place} ")),
            _ => return None,
        }
        Some(whole)
    }
}

impl Asker<'_> {
    /// A command that waited to be told which thing was meant, with the thing that these words choose.
    #[must_use]
    pub fn resumed(&self, text: &str, memory: &Memory) -> Option<String> {
        let Some(waiting) = memory.waiting.as_ref() else {
            let ordered = memory.ordered.as_ref()?;
            let another = self.another(text, ordered, memory);
            let another = another.or_else(|| self.there_too(text, ordered, memory));
            return another.or_else(|| self.amended(text, ordered, memory, false));
        };
        if let Some(narrowed) = self.narrowed(text, waiting) {
            return Some(narrowed);
        }
        let amended = || self.amended(text, memory.ordered.as_ref()?, memory, true);
        if self.goes_elsewhere(text, waiting, memory)
            && let Some(amended) = amended()
        {
            return Some(amended);
        }
        let knowledge = self.knowledge(waiting.language, memory);
        let Some(chosen) = self.answered(text, waiting, &knowledge) else { return amended() };
        let mut resumed = waiting.text.clone();
        let case = self.case_at(&resumed, &waiting.at, memory);
        resumed.replace_range(waiting.at.clone(), &knowledge.listed(&chosen, case));
        Some(resumed)
    }

    /// What of that which was asked about a reply means: "No, the second one", "not the red one" of two.
    fn answered(
        &self,
        text: &str,
        waiting: &Waiting,
        knowledge: &Knowledge<'_>,
    ) -> Option<Vec<Thing>> {
        if let Some(chosen) = self.chosen(text, waiting, knowledge) {
            return Some(chosen);
        }
        let anew = Anew::of(text, false).filter(|anew| anew.amends)?;
        let chosen = self.chosen(anew.said, waiting, knowledge)?;
        if !anew.is_only_wrong {
            return Some(chosen);
        }
        let left = without(&waiting.candidates, &chosen);
        (left.len() == 1).then_some(left)
    }

    /// «В гостиную», "no, to the living room": whither an order goes, where none of what was asked about is such a place.
    fn goes_elsewhere(&self, text: &str, waiting: &Waiting, memory: &Memory) -> bool {
        let Some(ordered) = &memory.ordered else { return false };
        let Some(anew) = Anew::of(text, ordered.goal.is_some()) else { return false };
        let plain = self.plain(anew.said);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let knowledge = self.knowledge(sentence.language, memory);
        let resolver = Resolver::reading(&knowledge, &sentence);
        let items = sentence.items();
        let [Item::Place { rel, nouns, .. }] = &items[..] else { return false };
        let [phrase] = &nouns[..] else { return false };
        let open = || anew.denies && ordered.goes_where_it_says(*rel);
        let meant = knowledge.base(&phrase.noun.head);
        resolver.is_whither(*rel, phrase).unwrap_or_else(open)
            && !meant.iter().any(|thing| waiting.candidates.contains(thing))
    }

    /// «А теперь другую», "now the other one": the last command, done to the nearest other thing of that kind.
    fn another(&self, text: &str, ordered: &Ordered, memory: &Memory) -> Option<String> {
        static SMALL: Set = Set::named("AroundReply");
        static OTHER: Set = Set::named("TheOther");
        if text.trim_end().ends_with('?') {
            return None;
        }
        let (at, candidates) = ordered.object.clone()?;
        let is_small = |key: &String| SMALL.contains(&key.as_str());
        let mut keys: Vec<String> = word_keys(text).into_iter().skip_while(is_small).collect();
        while keys.last().is_some_and(is_small) {
            keys.pop();
        }
        let knowledge = self.knowledge(ordered.language, memory);
        let done = |next: Thing| {
            let mut whole = ordered.without_places(at.end);
            whole.replace_range(at.clone(), &knowledge.listed(&[next], Case::Accusative));
            whole
        };
        // "Bring the third one. Now the second one": of the list that was told.
        let listed = &memory.listed;
        if let Some(rank) = lone_rank(&keys)
            && listed.len() > 2
            && candidates.iter().all(|thing| listed.contains(thing))
        {
            let at = usize::try_from(rank).ok()?.checked_sub(1)?;
            return match memory.numbered(at)[..] {
                [next] => Some(done(next)),
                _ => None,
            };
        }
        if !OTHER.contains(&keys.join(" ").as_str()) {
            return None;
        }
        let kind = |t: &Thing| {
            let object = self.world.replicas.get(&t.replica()?)?.object;
            self.world.objects.get(&object)?.object_type
        };
        let wanted = candidates.last().and_then(kind)?;
        let given = |t: &Thing| t.replica().is_some_and(|id| self.senses.holder(id).is_some());
        let all = self.world.replicas.keys().map(|id| Thing::Entity(Entity::Replica(*id)));
        let mut others: Vec<Thing> = all
            .filter(|t| kind(t) == Some(wanted) && !candidates.contains(t) && !given(t))
            .collect();
        // Of several that were told, one of those that are left.
        if candidates.iter().all(|thing| listed.contains(thing))
            && others.iter().any(|thing| listed.contains(thing))
        {
            others.retain(|thing| listed.contains(thing));
        }
        let away = |t: &Thing| knowledge.distance(*t, Thing::Robot).unwrap_or(f64::INFINITY);
        let nearest = others.into_iter().min_by(|a, b| away(a).total_cmp(&away(b)).then(a.cmp(b)));
        nearest.map(done)
    }

    /// «И на кухне тоже», "and in the kitchen too": the last command, done to what is there.
    fn there_too(&self, text: &str, ordered: &Ordered, memory: &Memory) -> Option<String> {
        static TOO: Set = Set::named("Too");
        let keys = word_keys(text);
        let too = (0..keys.len())
            .find_map(|n| TOO.iter().find_map(|too| crate::words::phrase_at(&keys, n, too)));
        let (object, _) = ordered.object.as_ref()?;
        if too.is_none() || ordered.goal.is_some() || text.contains('?') {
            return None;
        }
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let items = sentence.items();
        let mut places = items.iter().filter(|item| matches!(item, Item::Place { .. }));
        let (Some(Item::Place { nouns, .. }), None) = (places.next(), places.next()) else {
            return None;
        };
        if items.iter().any(|item| matches!(item, Item::Noun(_))) {
            return None;
        }
        let words = &nouns.first()?.words;
        let link = command::link_before(&sentence.keys, words.start);
        let place =
            &plain[sentence.words[words.start - link].start..sentence.words[words.end - 1].end];
        let knowledge = self.knowledge(ordered.language, memory);
        let resolver = Resolver::reading(&knowledge, &sentence);
        let Item::Place { rel, .. } = items.iter().find(|i| matches!(i, Item::Place { .. }))?
        else {
            return None;
        };
        if resolver.is_whither(*rel, nouns.first()?) == Some(true) {
            return None;
        }
        let there = format!("{} {place}", &ordered.text[object.clone()]);
        Some(ordered.retold(&[(object, &there)]))
    }

    /// A reply whose misspelt words, of which there is one likely reading, are put right: «в кухнюу».
    fn spelled(&self, text: &str) -> String {
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let mut spelled = text.to_owned();
        for item in sentence.items().iter().rev() {
            let Item::Unknown(words) = item else { continue };
            let said = sentence.words[words.start].start..sentence.words[words.end - 1].end;
            let key = name_key(&text[said.clone()]);
            let name = self.mind.lexicon.nouns.near(&text[said.clone()], 1).first().copied();
            let same = |name: &&str| {
                let letters = name_key(name);
                let same = letters.chars().zip(key.chars()).take_while(|(a, b)| a == b).count();
                2 * same > key.chars().count()
            };
            if let Some(name) = name.filter(same) {
                spelled.replace_range(said, name);
            }
        }
        spelled
    }

    /// «Какую дверь?» – «В спальню»: the room to which it leads, said of what was asked about.
    fn narrowed(&self, text: &str, waiting: &Waiting) -> Option<String> {
        let doors = |t: &Thing| matches!(t, Thing::Entity(Entity::Door(_)));
        let plain = self.spelled(&self.plain(without_pointing(text)));
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let one_place =
            matches!(&sentence.items()[..], [Item::Place { nouns, .. }] if nouns.len() == 1);
        if !one_place || !waiting.candidates.iter().all(doors) {
            return None;
        }
        let mut narrowed = waiting.text.clone();
        narrowed.insert_str(waiting.at.end, &format!(" {}", plain.trim_end_matches(['.', '!'])));
        Some(narrowed)
    }

    fn chosen(
        &self,
        text: &str,
        waiting: &Waiting,
        knowledge: &Knowledge<'_>,
    ) -> Option<Vec<Thing>> {
        static ANY: Set = Set::named("AnyOfChoice");
        static ALL: Set = Set::named("AllOfChoice");
        let candidates = &waiting.candidates;
        let key = name_key(text.trim_matches(|c: char| !c.is_alphanumeric()));
        let nearest = Best { extreme: Extreme::Nearest, anchor: None };
        let among = |noun: Noun| Noun {
            head: Head { things: Some(candidates.clone()), ..noun.head.clone() },
            ..noun
        };
        if ALL.contains(&key.as_str()) {
            return Some(candidates.clone());
        }
        if ANY.contains(&key.as_str()) {
            let noun = among(Noun { best: Some(nearest), ..Noun::default() });
            return knowledge.find(&noun, true).ok()?.first().map(|t| vec![*t]);
        }
        if aside(text) == Some(Aside::Yes) && candidates.len() == 1 {
            return Some(candidates.clone());
        }
        let text = &self.plain(without_pointing(text));
        let sentence = Sentence::new(text, &self.mind.lexicon);
        let mut noun = assemble::fragment(&sentence, &self.mind.lexicon, &|_, _| Vec::new())?;
        if noun.head.named.is_empty() && noun.head.kinds.is_empty() {
            noun.head = Head { things: Some(candidates.clone()), ..Head::default() };
        }
        // «вторую»: in the order in which they were told.
        if let (Some(rank), None) = (noun.rank, &noun.best) {
            let at = usize::try_from(rank).ok()?.checked_sub(1)?;
            return candidates.get(at).map(|t| vec![*t]);
        }
        let several = std::mem::replace(&mut noun.plural, true);
        let found = knowledge.find(&noun, true).ok()?;
        let meant: Vec<Thing> = found.into_iter().filter(|t| candidates.contains(t)).collect();
        (meant.len() == 1 || several && !meant.is_empty()).then_some(meant)
    }
}

/// The number in an order that a line says, and nothing else: «вторую», "the second one".
#[must_use]
pub fn rank_alone(text: &str) -> Option<usize> {
    lone_rank(&word_keys(text)).and_then(|rank| usize::try_from(rank).ok())
}

/// «вторую», "the second one": a number in an order, and nothing else.
fn lone_rank(keys: &[String]) -> Option<u64> {
    let from = usize::from(keys.first().is_some_and(|key| key == "the"));
    match vocabulary::longest(keys.get(from..)?) {
        Some((taken, Mark::Rank(rank))) => match &keys[from + taken..] {
            [] => Some(rank),
            [one] if one == "one" => Some(rank),
            _ => None,
        },
        _ => None,
    }
}

/// «ту, что на комоде», "the one that is on the dresser": what follows the pointing words tells which.
fn without_pointing(text: &str) -> &str {
    static POINTING: Set = Set::named("AroundChoice");
    let words = word_ranges(text);
    let points =
        |range: &&Range<usize>| POINTING.contains(&name_key(&text[(*range).clone()]).as_str());
    let skipped = words.iter().take_while(points).count();
    words.get(skipped).map_or(text, |first| &text[first.start..])
}
