//! Where the person is, told before a question or behind it: "I'm in the kitchen. Where is the nearest bin?"
//!
//! Invariant: a place that was told takes the robot's where a question counts from here, and nothing else.

use super::grammar::{Item, Sentence};
use super::mark::Mark;
use super::query::Extreme;
use super::{
    Answer, Asker, Courtesy, Head, Memory, Noun, Query, Rel, Restriction, Said, Thing, Unanswered,
    opening, several,
};
use crate::command::has_verb;
use crate::sets::{Set, set};
use crate::units::InOrder as _;
use crate::words::{Case, Language, is_first_person, word_keys, word_ranges};

/// What may stand beside.
static SMALL: Set = Set::named("BesidePremise");

impl Asker<'_> {
    /// The place of «я на кухне», «сижу в гостиной», "if I'm on the sofa", "I'm off to the bathroom", where a part of a line
    /// says that and no more.
    pub(super) fn premise(&self, text: &str) -> Option<Noun> {
        // "I'm in the kitchen and my legs hurt": what else is told narrows nothing, unless it tells where something is.
        let rest_tells =
            |rest: &str| !several::asks_in(rest) && !has_verb(rest) && !self.tells_of_place(rest);
        self.stay(text).or_else(|| {
            let joints = word_ranges(text).into_iter().filter(|word| is_joint(&text[word.clone()]));
            let mut clauses = joints.map(|joint| (&text[..joint.start], &text[joint.end..]));
            let (first, rest) = clauses.next()?;
            self.stay(first).filter(|_| rest_tells(rest))
        })
    }

    /// The place that the first clause of a line tells, and what follows it.
    fn stay_and_rest<'t>(&self, text: &'t str) -> Option<(Noun, &'t str)> {
        const MOST: usize = 4;
        let words = word_ranges(text);
        let parted = |n: &usize| {
            let between = &text[words[n - 1].end..words[*n].start];
            between.contains([',', ';', '–', '—', ':']) || is_joint(&text[words[*n].clone()])
        };
        let clauses = (1..words.len()).filter(parted).take(MOST);
        let mut clauses = clauses.map(|n| {
            let from = n + usize::from(is_joint(&text[words[n].clone()]));
            let rest = words.get(from).map_or("", |word| &text[word.start..]);
            (&text[..words[n - 1].end], rest)
        });
        clauses.find_map(|(first, rest)| {
            let tells = !opening::begins_question(&word_keys(first));
            Some((self.stay(first).filter(|_| tells)?, rest)).filter(|(_, rest)| !rest.is_empty())
        })
    }

    /// The answer to what follows where the person says to be: «Я на кухне, а телефон на диване остался, проверь». The place
    /// is no part of what is asked; where the rest is not understood, nothing is.
    pub(super) fn asked_there(
        &self,
        text: &str,
        language: Language,
        memory: &mut Memory,
    ) -> Option<Result<Answer, Unanswered>> {
        let (place, rest) = self.stay_and_rest(text)?;
        let mut after = memory.clone();
        self.hear_of_place(&place, &mut after);
        let answered = self.ask(rest, &mut after);
        if answered.is_err()
            && let Some(Ok(answer)) = self.salvaged(text, language, memory)
        {
            memory.learn(&answer);
            return Some(Ok(answer));
        }
        *memory = after;
        Some(answered)
    }

    /// Whether a clause only tells how the person is, or how it is there: "my legs hurt", «тут темно».
    fn only_complains(&self, text: &str) -> bool {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let items = sentence.items();
        let of_person = |item: &Item| match item {
            Item::Noun(phrase) => phrase.person == Some(Mark::Me),
            Item::Mark(mark) => *mark == Mark::Me,
            _ => false,
        };
        let tells = |item: &Item| {
            of_person(item)
                || matches!(item, Item::Mark(Mark::And | Mark::Filler | Mark::Be | Mark::Not))
                || matches!(item, Item::Unknown(_))
        };
        let begins = items.first().is_some_and(of_person) || says_here(text);
        begins && items.iter().all(tells) && !several::asks_in(text) && !has_verb(text)
    }

    fn stay(&self, text: &str) -> Option<Noun> {
        self.place_of_stay(text).filter(|(_, me)| *me).map(|(place, _)| place)
    }

    /// The place of a part that tells a place and nobody who is there: "still in bed".
    pub(super) fn place_alone(&self, text: &str) -> Option<Noun> {
        self.place_of_stay(text).map(|(place, _)| place)
    }

    /// Where somebody is by a part of a line that says that and no more, and whether that is the person.
    fn place_of_stay(&self, text: &str) -> Option<(Noun, bool)> {
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let (mut me, mut places) = (false, Vec::new());
        for item in sentence.items() {
            match item {
                Item::Noun(phrase) if phrase.person == Some(Mark::Me) => me = true,
                Item::Mark(Mark::Me) => me = true,
                Item::Mark(
                    Mark::Be | Mark::And | Mark::Filler | Mark::The | Mark::Sit | Mark::LieDown,
                ) => {}
                // Whatever the person does there.
                Item::Unknown(words) => {
                    let keys = &sentence.keys[words.clone()];
                    me |= keys.iter().any(|key| is_first_person(key));
                    let stays = |key: &String| is_first_person(key) || SMALL.contains(&&**key);
                    let does = |key: &String| key.ends_with("ing") || stays(key);
                    if !keys.iter().all(does) {
                        return None;
                    }
                }
                Item::Place { rel, nouns, either: false } => {
                    let here = matches!(rel, Rel::In | Rel::On | Rel::At | Rel::NextTo | Rel::Near);
                    let [phrase] = &nouns[..] else { return None };
                    let goes = rel == Rel::To && self.is_room(&phrase.noun);
                    // «Мне бы в ванную» says whither.
                    let has = |case: Case| phrase.cases.iter().any(|r| r.has_case(case));
                    let whither = sentence.language == Language::Russian
                        && has(Case::Accusative)
                        && !has(Case::Prepositional)
                        && !has(Case::Locative);
                    if whither
                        || !(here || goes)
                        || phrase.pronoun.is_some()
                        || phrase.person.is_some()
                    {
                        return None;
                    }
                    places.push((rel, phrase.noun.clone()));
                }
                _ => return None,
            }
        }
        Some((self.one_place(places)?, me))
    }

    /// One place of all that a person tells of where it is: "at the counter upstairs", "in the kitchen by the sink". A thing
    /// stands in the room, and the room on the storey, whichever is told first; of two rooms neither is meant.
    fn one_place(&self, mut places: Vec<(Rel, Noun)>) -> Option<Noun> {
        let rank = |noun: &Noun| match (noun.is_storey(&self.mind.lexicon), self.is_room(noun)) {
            (true, _) => 2,
            (_, true) => 1,
            _ => 0,
        };
        places.order_by_key(|(_, noun)| rank(noun));
        let alike = places.windows(2).any(|two| rank(&two[0].1) == rank(&two[1].1));
        let (_, mut place) = places.first().cloned().filter(|_| !alike)?;
        for (_, within) in places.into_iter().skip(1) {
            let anchors = vec![within];
            place.restrictions.push(Restriction { rel: Rel::In, anchors, negated: false });
        }
        Some(place)
    }

    /// Whether a part of a line tells where the person is, in words that come to no place: "I'm next to the blorb". What counts
    /// from the person is then counted from nowhere.
    pub(super) fn is_astray(&self, text: &str) -> bool {
        if text.trim_end().ends_with('?') || several::asks_outright(text) {
            return false;
        }
        let plain = self.plain(text);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let items = sentence.items();
        let me = |item: &Item| match item {
            Item::Noun(phrase) => phrase.person == Some(Mark::Me),
            Item::Mark(mark) => *mark == Mark::Me,
            Item::Unknown(words) => {
                sentence.keys[words.clone()].iter().any(|key| is_first_person(key))
            }
            _ => false,
        };
        let Some(first) = items.iter().position(me) else { return false };
        // What the person does or has there tells nothing of where it is: "I left it in the kitchen".
        let stays = |item: &Item| match item {
            Item::Mark(
                Mark::Be | Mark::And | Mark::Filler | Mark::Sit | Mark::LieDown | Mark::The,
            ) => true,
            Item::Unknown(words) => sentence.keys[words.clone()]
                .iter()
                .all(|key| key.ends_with("ing") || SMALL.contains(&&**key) || is_first_person(key)),
            item => me(item),
        };
        let rest = &items[first..];
        let behind = rest.iter().skip_while(|item| stays(item)).collect::<Vec<_>>();
        let here = |rel: &Rel| matches!(rel, Rel::In | Rel::On | Rel::At | Rel::NextTo | Rel::Near);
        match behind[..] {
            [Item::Place { rel, nouns, .. }, ..] => {
                here(rel) && nouns.iter().all(|p| p.pronoun.is_none() && p.person.is_none())
            }
            // "I'm in a hurry" is no place, "I'm by the blorb" is one that nothing knows.
            [Item::Link(rel), Item::Mark(Mark::The), Item::Unknown(_), ..] => here(rel),
            [Item::Link(rel), Item::Unknown(_), ..] => {
                here(rel) && sentence.language == Language::Russian
            }
            _ => false,
        }
    }

    /// Notes where the person is, for "there" and "here", and for what is asked next.
    pub(super) fn hear_of_place(&self, place: &Noun, memory: &mut Memory) {
        let found = self.knowledge(memory.language, memory).find(place, true).unwrap_or_default();
        if let [only] = found[..] {
            memory.mention(&[only]);
            if let Thing::Entity(place) = only {
                memory.person = Some(place);
                memory.astray = None;
            }
        }
    }

    /// Notes that the person told in these words where it is, and that nothing knows where that is.
    pub(super) fn lose_person(text: &str, memory: &mut Memory) {
        memory.person = None;
        memory.astray = Some(text.trim_end_matches(['.', '!', ',', ' ']).to_owned());
    }

    /// «Я сейчас на кухне.»: a line of no more than where the person is.
    pub(super) fn told_where(
        &self,
        text: &str,
        language: Language,
        memory: &mut Memory,
    ) -> Option<Answer> {
        if text.contains('?') {
            return None;
        }
        let beside = || {
            let (place, rest) = self.stay_and_rest(text)?;
            self.only_complains(rest).then_some(place)
        };
        let place = self.stay(text).or_else(beside)?;
        let found = self.knowledge(language, memory).find(&place, true).ok()?;
        let [only] = found[..] else { return None };
        self.hear_of_place(&place, memory);
        let name = self.knowledge(language, memory).name(only);
        let told = language.pick("Понял, где вы:", "I see where you are:");
        let query = Query::Courtesy(Courtesy::Assent);
        Some(Answer::ran(query, language, Said::Found, text, format!("{told} {name}.")))
    }

    /// Where the person was last said to be, where a question may count from there: what is asked of the robot counts from
    /// the robot.
    pub(super) fn person_at(&self, text: &str, memory: &Memory) -> Option<Noun> {
        let place = memory.person?;
        let plain = self.plain(text);
        let to_robot = |item: &Item| match item {
            Item::Mark(Mark::You) => true,
            Item::Noun(phrase) => phrase.person == Some(Mark::You),
            Item::Place { nouns, .. } => nouns.iter().any(|p| p.person == Some(Mark::You)),
            _ => false,
        };
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        let head = Head { named: vec![place], ..Head::default() };
        (!items.iter().any(to_robot)).then(|| Noun { head, ..Noun::default() })
    }
}

fn is_joint(word: &str) -> bool {
    set!("AndOrBut").contains(&word)
}

/// Whether a question asks of where the person is.
pub(super) fn says_here(text: &str) -> bool {
    word_keys(text).iter().any(|key| set!("HereWord").contains(&key.as_str()))
}

/// The same question without the word for "here".
pub(super) fn without_here(text: &str) -> String {
    let (words, keys) = (word_ranges(text), word_keys(text));
    let here = |key: &String| set!("HereWord").contains(&key.as_str());
    let Some(at) = keys.iter().position(here) else { return text.to_owned() };
    let from = match at.checked_sub(1) {
        Some(before) if keys[before] == "in" => before,
        _ => at,
    };
    let mut rest = text.to_owned();
    rest.replace_range(words[from].start..words[at].end, "");
    rest
}

impl Query {
    /// Asks of what is in a place alone; false where that cannot be put to the question.
    pub(super) fn narrow(&mut self, place: &Noun) -> bool {
        let sought = match self {
            Self::Find(noun)
            | Self::Count(noun)
            | Self::Where(noun)
            | Self::Serving { of: noun, .. } => noun,
            Self::Exists { what, .. } => match &mut what[..] {
                [noun] => noun,
                _ => return false,
            },
            Self::Holds { subject, .. } => subject,
            // A way from here.
            Self::Way { .. }
            | Self::CanReach { .. }
            | Self::Duration { .. }
            | Self::Distance { .. }
            | Self::Passing { .. } => return true,
            _ => return false,
        };
        // A room that was told is another.
        let within = |r: &Restriction| r.rel == Rel::In;
        if !sought.restrictions.iter().any(within) && sought.best.is_none() {
            let restriction =
                Restriction { rel: Rel::In, anchors: vec![place.clone()], negated: false };
            sought.restrictions.push(restriction);
        }
        true
    }

    /// Whether a question counts from where the person is.
    pub(super) fn counts_from_here(&self) -> bool {
        let here = Noun::of(vec![Thing::Robot]);
        self.clone().asked_at(&here) != *self
    }

    /// The same question asked from a place.
    pub(super) fn asked_at(mut self, place: &Noun) -> Self {
        match &mut self {
            Self::Way { from, .. }
            | Self::CanReach { from, .. }
            | Self::Duration { from, .. }
            | Self::Distance { from, .. }
            | Self::Passing { from, .. }
                if from.is_none() =>
            {
                *from = Some(place.clone());
            }
            _ => self.each_noun(&mut |noun| {
                if let Some(reach) = noun.reached.as_mut().filter(|reach| reach.from.is_none()) {
                    reach.from = Some(Box::new(place.clone()));
                }
                if let Some(best) = &mut noun.best
                    && matches!(best.extreme, Extreme::Nearest | Extreme::Farthest)
                    && best.anchor.is_none()
                {
                    best.anchor = Some(Box::new(place.clone()));
                }
            }),
        }
        self
    }
}
