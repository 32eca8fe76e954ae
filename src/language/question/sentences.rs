//! A text of several sentences or questions: each is answered, and what only tells is what the others speak of.

use super::focus::is_shown;
use super::grammar::{Item, Sentence, points};
use super::mark::{Mark, Pronoun};
use super::query::Denial;
use super::{
    Answer, Asker, Doubt, Memory, Noun, Outcome, Query, Rel, Restriction, Thing, Unanswered,
    opening, premise, several, vocabulary,
};
use crate::command::is_too_long;
use crate::sets::set;
use crate::words::{Language, word_keys, word_ranges};

/// Whether a question was understood, and means several things or one that the map has not.
fn lacks_a_thing(doubt: &Doubt) -> bool {
    matches!(doubt, Doubt::Ambiguous { .. } | Doubt::NoneSuch { .. })
}

impl Asker<'_> {
    /// «Где ваза и какого она цвета?»: two questions in one sentence, the second knowing the first. None where the
    /// sentence is one question, or one of its parts has no answer.
    pub(super) fn each_part(
        &self,
        text: &str,
        language: Language,
        memory: &mut Memory,
    ) -> Option<Outcome> {
        if is_too_long(text) {
            return None;
        }
        let parts = several::parts(text)?;
        // "I parked by the gate. Is there a car, and where?": what is told before is no part of what is asked.
        if parts.iter().any(|part| several::sentences(part).len() > 1) || self.limits(parts[0]) {
            return None;
        }
        let mut after = memory.clone();
        let mut answers = Vec::new();
        let last = parts.last().copied().unwrap_or_default();
        for (n, part) in parts.iter().enumerate() {
            let goes_on = n > 0 && word_keys(part).first().is_some_and(|key| key == "а");
            if n > 0 && self.asks_of_posture(part, &after) {
                let words = (*part).to_owned();
                return Some(Err(Box::new((Doubt::NotUnderstood { words }, None))));
            }
            let further =
                || self.other_side(part, &after).or_else(|| self.counted_too(part, &after));
            if let Some(query) = (n > 0).then(further).flatten() {
                let answer = self.knowledge(language, &after).answer(&query).ok()?;
                after.learn(&answer);
                answers.push(answer);
                continue;
            }
            let answer = match n > 0 && self.lacks_subject(part) {
                // «…, и в какой они комнате?»
                true => {
                    let pronoun = if language == Language::Russian { "они" } else { "they" };
                    after.is_plural = true;
                    let whole = format!("{} {pronoun}", part.trim_end_matches(['?', '.', ' ']));
                    self.answer(&whole, language, &after).ok()?
                }
                false => match self.answer(part, language, &after) {
                    Ok(answer) => answer,
                    // «Сколько чёрных и сколько белых стульев?»: the noun stands once, at the end.
                    Err(unanswered) => {
                        // Where it is only asked back which one is meant, the part lacks no noun.
                        let lacks = !matches!(unanswered.0, Doubt::Ambiguous { .. });
                        let head = lacks.then(|| self.last_head(last)).flatten();
                        let whole = head.map(|head| format!("{part} {head}"));
                        let whole =
                            whole.and_then(|whole| self.answer(&whole, language, &after).ok());
                        match whole {
                            Some(answer) => answer,
                            // «В какой комнате шкаф и закрыт ли он?»: which one is asked back first.
                            None if n == 0 && matches!(unanswered.0, Doubt::Ambiguous { .. }) => {
                                return Some(Err(unanswered));
                            }
                            None if goes_on => return Some(Err(unanswered)),
                            // "How many chairs are there and where is the cup?" of several cups: the first is answered all
                            // the same, and what the second lacks is told.
                            None if n > 0
                                && n + 1 == parts.len()
                                && lacks_a_thing(&unanswered.0) =>
                            {
                                let knowledge = self.knowledge(language, &after);
                                let doubt = knowledge.unanswered(unanswered.0).text;
                                let mut answer = Answer::joined(answers, language);
                                answer.text = format!("{} {doubt}", answer.text);
                                *memory = after;
                                return Some(Ok(answer));
                            }
                            None => return None,
                        }
                    }
                },
            };
            // A part of small words asks nothing by itself.
            if matches!(answer.query, Query::Help) {
                return None;
            }
            after.learn(&answer);
            answers.push(answer);
        }
        *memory = after;
        Some(Ok(Answer::joined(answers, language)))
    }

    /// «Что справа от тебя и что слева?», «А внутри?», "How many are in it and how many outside?": another side of what the
    /// question before was about.
    pub(super) fn other_side(&self, part: &str, memory: &Memory) -> Option<Query> {
        let text = self.plain(part);
        let sentence = Sentence::new(&text, &self.mind.lexicon);
        let sided = |rel: Rel| {
            matches!(
                rel,
                Rel::LeftOf
                    | Rel::RightOf
                    | Rel::InFrontOf
                    | Rel::Behind
                    | Rel::In
                    | Rel::Outside
                    | Rel::On
                    | Rel::Under
                    | Rel::Above
                    | Rel::NextTo
            )
        };
        let (mut side, mut pronoun) = (None, None);
        let (mut counts, mut which, mut what_or_which) = (false, false, false);
        for item in sentence.items() {
            match item {
                Item::Link(rel) if sided(rel) && side.is_none() => side = Some(rel),
                // "And to the right of it?"
                Item::Place { rel, nouns, .. }
                    if sided(rel)
                        && side.is_none()
                        && matches!(&nouns[..], [only] if only.pronoun.is_some()) =>
                {
                    (side, pronoun) = (Some(rel), nouns[0].pronoun);
                }
                Item::Mark(Mark::HowMany) => counts = true,
                Item::Mark(Mark::Which) => (which, what_or_which) = (true, true),
                Item::Mark(Mark::What) => what_or_which = true,
                Item::Mark(Mark::Be | Mark::Exists | Mark::And) => {}
                // "Is there one outside?"
                Item::Noun(phrase) if phrase.noun.head.anything && phrase.words.len() == 1 => {}
                _ => return None,
            }
        }
        counts |= matches!(memory.query, Some(Query::Count(_))) && !what_or_which;
        let before = match &memory.query {
            Some(Query::Find(before)) if !(counts || which && before.head.anything) => before,
            Some(Query::Count(before)) if counts => before,
            // "Is there an egg in the fridge, and is there one outside?"
            Some(Query::Exists { what, either: false, denial: Denial::None })
                if let ([before], false) = (&what[..], counts || what_or_which) =>
            {
                before
            }
            _ => return None,
        };
        // «Какая книга на комоде? Что рядом с ней?»: with the book, of which it was asked; «с ним» is with the dresser.
        let knowledge = self.knowledge(sentence.language, memory);
        let means = |pronoun: Pronoun, thing: &Thing| knowledge.agrees(pronoun, *thing);
        let anchors = before.restrictions.iter().flat_map(|place| &place.anchors);
        let anchors = anchors.filter_map(|anchor| knowledge.find(anchor, true).ok()).flatten();
        let mut anchors = anchors.peekable();
        let taken_up = |pronoun| match (before.head.anything, memory.last.first()) {
            (false, Some(found)) if means(pronoun, found) => false,
            _ => anchors.peek().is_none() || anchors.any(|anchor| means(pronoun, &anchor)),
        };
        if !pronoun.is_none_or(taken_up) {
            return None;
        }
        let mut noun = before.clone();
        let [place] = &mut noun.restrictions[..] else { return None };
        // The same side once more is a question about something else.
        place.rel = side.filter(|side| sided(place.rel) && *side != place.rel)?;
        // Nothing is on a room or under it.
        let of_room = place.anchors.iter().any(|anchor| self.is_room(anchor));
        if of_room && !matches!(place.rel, Rel::In | Rel::Outside) {
            return None;
        }
        Some(match &memory.query {
            Some(Query::Count(_)) => Query::Count(noun),
            Some(Query::Exists { either, denial, .. }) => {
                Query::Exists { what: vec![noun], either: *either, denial: *denial }
            }
            _ => Query::Find(noun),
        })
    }

    /// «Сколько картин висит? А сколько лежит?»: what hangs is told apart from what stands and lies, and how many of what was
    /// asked of do not hang, nothing measures.
    pub(super) fn asks_of_posture(&self, text: &str, memory: &Memory) -> bool {
        let Some(last) = memory.query.as_ref().and_then(Query::sought) else { return false };
        let knowledge = self.knowledge(Language::of(text), memory);
        let hangs = last.restrictions.iter().any(|restriction| {
            restriction.rel == Rel::On && restriction.anchors.iter().any(|a| knowledge.is_walls(a))
        });
        if !hangs {
            return false;
        }
        let text = self.plain(text);
        let items = Sentence::new(&text, &self.mind.lexicon).items();
        let small = |item: &Item| {
            matches!(item, Item::Mark(Mark::And | Mark::HowMany | Mark::Which | Mark::Be))
        };
        items.contains(&Item::Mark(Mark::Be)) && items.iter().all(small)
    }

    /// Whether a question names nothing that it is about: "in which room", «какого цвета».
    pub(super) fn lacks_subject(&self, part: &str) -> bool {
        let text = self.plain(part);
        let sentence = Sentence::new(&text, &self.mind.lexicon);
        let items = sentence.items();
        let asks_of = |n: usize| {
            n > 0
                && matches!(items[n - 1], Item::Mark(Mark::Which | Mark::What))
                && matches!(&items[n], Item::Noun(p) if p.noun.head.kinds.iter().any(|k| self.mind.lexicon.is_area(*k)))
        };
        let small = |n: usize| match &items[n] {
            Item::Mark(mark) => {
                matches!(
                    mark,
                    Mark::Where
                        | Mark::Which
                        | Mark::What
                        | Mark::Be
                        | Mark::HowBig(_)
                        | Mark::MadeOf
                        | Mark::HowFar
                        | Mark::HowMany
                        | Mark::Exists
                        | Mark::There
                ) || (*mark == Mark::The && sentence.points())
            }
            Item::Link(_) | Item::Property(_) => true,
            Item::Noun(_) => asks_of(n),
            _ => false,
        };
        !items.is_empty() && (0..items.len()).all(small)
    }

    /// The head of the last noun of a question and what follows, as it was said: «книг на стеллаже».
    fn last_head(&self, part: &str) -> Option<String> {
        let text = self.plain(part);
        let sentence = Sentence::new(&text, &self.mind.lexicon);
        let mut nouns = sentence.items().into_iter().filter_map(|item| match item {
            Item::Noun(phrase) if phrase.person.is_none() && phrase.pronoun.is_none() => {
                Some(phrase.words)
            }
            _ => None,
        });
        let words = nouns.next_back()?;
        Some(sentence.said(&(words.end.checked_sub(1)?..sentence.words.len())).to_owned())
    }

    /// "I lost my cup. Where is it?": the last sentence asks; those before it are questions too, or tell what it is
    /// about.
    pub(super) fn each_sentence(
        &self,
        text: &str,
        language: Language,
        memory: &mut Memory,
    ) -> Option<Result<Answer, Unanswered>> {
        let mut parts = several::sentences(text.get(..Self::LONGEST * 2).unwrap_or(text));
        let mut is_topic = false;
        // "I'm on the sofa, what's the nearest bin?"
        if let [only] = parts[..]
            && let Some((told, asked)) = only.split_once([',', ';', '–', '—'])
        {
            is_topic = self.is_topic(told, asked);
            if is_topic || self.premise(told).is_some() {
                parts = vec![told.trim(), asked.trim()];
            }
        }
        // "Is the machine on? I can't see it from here.": what is only told stands behind.
        let whole = parts.len();
        let mut behind = None;
        while parts.len() > 1
            && parts.last().is_some_and(|last| !last.ends_with('?'))
            && parts[..parts.len() - 1].iter().any(|part| part.ends_with('?'))
        {
            let told = parts.pop()?;
            // "How do I get there? I'm in the bedroom."
            if behind.is_none() && self.premise(told).is_some() {
                behind = Some(told);
                continue;
            }
            // «Где ты? Подробно»: a word or two belong to what is asked, but "It leaks" is a clause.
            if word_keys(told).len() < 3 && self.pronouns(told).is_empty() {
                return None;
            }
            self.names_only(told, memory)?;
        }
        if let Some(told) = behind {
            parts.insert(0, told);
        }
        if let ([only], true) = (&parts[..], whole > 1) {
            let mut after = memory.clone();
            let answer = self.ask(only, &mut after).ok()?;
            *memory = after;
            return Some(Ok(answer));
        }
        let (last, before) = parts.split_last().filter(|(_, before)| !before.is_empty())?;
        // «Говорят, дверь заперта. Верно?» asks of what stands before.
        if several::is_tag(&word_keys(last).join(" ")) {
            return None;
        }
        let mut after = memory.clone();
        let mut answers = Vec::new();
        let (mut place, mut told) = (None, Vec::new());
        for part in before {
            if let Some(stay) = self.premise(part) {
                place = Some(stay);
                continue;
            }
            match self.answer(part, language, &after) {
                Ok(answer) if part.ends_with('?') => {
                    after.learn(&answer);
                    answers.push(answer);
                }
                // "I only care about the kitchen. How many windows are there?"
                _ if self.narrows(part, last) => {
                    let doubt = Doubt::unheeded(part);
                    return Some(Err(self.knowledge(language, memory).unanswered(doubt)));
                }
                _ => {
                    self.hear_of(part, &mut after);
                    // "What is next to Table 2? The table in the hall – what is on it?" goes on from no question.
                    after.query = after.query.take().filter(|_| !is_topic);
                    if self.is_astray(part) {
                        Self::lose_person(part, &mut after);
                    }
                    told.push(*part);
                }
            }
        }
        if let Some(place) = &place
            && let Ok(answer) = self.answer_at(Some(place), last, language, &after)
        {
            self.hear_of_place(place, &mut after);
            after.learn(&answer);
            *memory = after;
            answers.push(answer);
            return Some(Ok(match answers.len() {
                1 => answers.remove(0),
                _ => Answer::joined(answers, language),
            }));
        }
        if let Some(place) = &place {
            // "Here" is where the person is, or nowhere.
            if premise::says_here(last) {
                return None;
            }
            self.hear_of_place(place, &mut after);
            // Which of several it is was not said.
            if after.person.is_none() {
                Self::lose_person(&place.text, &mut after);
            }
        }
        let meant = self.with_one(last, &told);
        match self.ask(meant.as_deref().unwrap_or(last), &mut after) {
            Ok(answer) => {
                let answer = match self.heeding(&told, answer, &after) {
                    Ok(answer) => answer,
                    Err(doubt) => {
                        return Some(Err(self.knowledge(language, memory).unanswered(doubt)));
                    }
                };
                after.learn(&answer);
                answers.push(answer);
                *memory = after;
                Some(Ok(match answers.len() {
                    1 => answers.remove(0),
                    _ => Answer::joined(answers, language),
                }))
            }
            // Where the person is was told, and is not known; or what is named means nothing that was told.
            Err(unanswered) if after.astray.is_some() || is_topic && after.is_lost => {
                *memory = after;
                Some(Err(unanswered))
            }
            Err(unanswered) if unanswered.doubt.kind() == "ambiguous" && answers.is_empty() => {
                *memory = after;
                Some(Err(unanswered))
            }
            Err(_) => None,
        }
    }

    /// "I can't find a pencil, and the crossword is due. Where is one?": with the one thing that was told of as one of its kind.
    fn with_one(&self, asked: &str, told: &[&str]) -> Option<String> {
        let (words, keys) = (word_ranges(asked), word_keys(asked));
        let ones = (0..keys.len()).filter(|n| keys[*n] == "one").collect::<Vec<_>>();
        let [at] = ones[..] else { return None };
        // "Which one …?", "the red one", "one of them"
        let plain = at > 0 && keys.get(at + 1).is_none_or(|key| key != "of");
        let verb = |key: &str| {
            let said = vocabulary::longest(&[key.to_owned()]);
            matches!(said, Some((_, Mark::Be | Mark::Where | Mark::Exists | Mark::Me | Mark::You)))
                || set!("FindWord").contains(&key)
        };
        if !plain || !verb(&keys[at - 1]) {
            return None;
        }
        let mut kinds = Vec::new();
        for part in told {
            let text = self.plain(part);
            let sentence = Sentence::new(&text, &self.mind.lexicon);
            for item in sentence.items() {
                if let Item::Noun(phrase) = item
                    && phrase.person.is_none()
                    && phrase.pronoun.is_none()
                    && phrase.noun.indefinite
                    && !phrase.noun.plural
                {
                    kinds.push(sentence.said(&phrase.words).to_owned());
                }
            }
        }
        let [kind] = &kinds[..] else { return None };
        let article = word_keys(kind).first().is_some_and(|key| set!("Article").contains(&&**key));
        let kind = if article { kind.clone() } else { format!("a {kind}") };
        Some(format!("{}{kind}{}", &asked[..words[at].start], &asked[words[at].end..]))
    }

    /// "The one in the bedroom — what's it standing on?": what is named is what the pronoun means.
    fn is_topic(&self, named: &str, asked: &str) -> bool {
        let plain = self.plain(named);
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        let names = |item: &Item| match item {
            Item::Noun(phrase) => phrase.person.is_none() && phrase.pronoun.is_none(),
            item => matches!(item, Item::Place { .. }),
        };
        // "And the plates – how many of them are in the bedroom?": plates, and not those of which it was asked before.
        let own = match &items[..] {
            [Item::Mark(Mark::And), own @ ..] => own,
            own => own,
        };
        matches!(own, [first @ Item::Noun(_), rest @ ..] if names(first) && rest.iter().all(names))
            && !self.pronouns(asked).is_empty()
            && opening::begins_question(&word_keys(asked))
    }

    /// Whether what is told is where something is, or may be where the person is.
    pub(super) fn tells_of_place(&self, told: &str) -> bool {
        let plain = self.plain(told);
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        items.iter().any(|item| matches!(item, Item::Place { .. }))
    }

    /// Notes what a sentence names that asks nothing.
    pub fn hear_of(&self, text: &str, memory: &mut Memory) {
        let text = self.plain(text);
        let sentence = Sentence::new(&text, &self.mind.lexicon);
        let (mut nouns, mut places) = (Vec::<Noun>::new(), Vec::new());
        let (mut behind_noun, mut is_lost, mut pointing) = (false, false, Vec::new());
        for item in sentence.items() {
            // "The television in the bedroom broke": that one, where there is one there.
            if let (true, Item::Place { rel: rel @ (Rel::In | Rel::On), nouns: anchors, .. }) =
                (behind_noun, &item)
                && let Some(noun) = nouns.last_mut()
                && anchors.iter().all(|anchor| anchor.person.is_none() && anchor.pronoun.is_none())
            {
                let anchors = anchors.iter().map(|anchor| anchor.noun.clone()).collect();
                let mut placed = noun.clone();
                placed.restrictions.push(Restriction { rel: *rel, anchors, negated: false });
                let knowledge = self.knowledge(sentence.language, memory);
                if knowledge.find(&placed, true).is_ok_and(|found| !found.is_empty()) {
                    *noun = placed;
                }
            }
            behind_noun = matches!(&item, Item::Noun(phrase) if phrase.person.is_none());
            match item {
                // "The one in the living room – what is next to it?": of those that were told, or nothing.
                Item::Noun(phrase) if points(&phrase.noun) && !is_shown(&phrase.noun) => {
                    let told = match phrase.noun.other {
                        true => self.others_of_last(memory),
                        false => Some(Noun::of(memory.told_of())),
                    };
                    let told = told
                        .filter(|told| told.head.things.as_ref().is_some_and(|t| !t.is_empty()));
                    behind_noun = told.is_some();
                    is_lost |= told.is_none();
                    pointing.extend(told.as_ref().map(|_| nouns.len()));
                    nouns.extend(told.map(|told| Noun {
                        other: false,
                        head: told.head,
                        ..phrase.noun
                    }));
                }
                Item::Noun(phrase) if phrase.person.is_none() => nouns.push(phrase.noun),
                Item::Place { rel: Rel::In | Rel::On | Rel::At | Rel::To, nouns, .. } => {
                    places.extend(nouns.into_iter().filter(|p| p.person.is_none()).map(|p| p.noun));
                }
                _ => {}
            }
        }
        let (named, placed, several) = {
            let knowledge = self.knowledge(sentence.language, memory);
            let found = |noun: &Noun| knowledge.find(noun, true).ok();
            let one = |noun: &Noun| found(noun).filter(|found| found.len() == 1);
            let named: Vec<Thing> = nouns.iter().filter_map(one).flatten().collect();
            let placed: Vec<Thing> = places.iter().filter_map(one).flatten().collect();
            let of_kind = |noun: &&Noun| !noun.head.anything && noun.head.things.is_none();
            // "The other one – what is on it?", where nothing tells which: "it" is none of what was spoken of.
            is_lost |= pointing.iter().any(|at| one(&nouns[*at]).is_none());
            let several = match &nouns[..] {
                [only] => Some(only).filter(of_kind).and_then(found).unwrap_or_default(),
                _ => Vec::new(),
            };
            (named, placed, several)
        };
        if is_lost {
            memory.is_lost = true;
        } else if !named.is_empty() {
            // Of two that were named neither is "it".
            memory.list(&named);
            let is_plural = nouns.iter().any(|noun| noun.plural);
            memory.is_plural = memory.last.len() > 1 || is_plural;
            memory.is_whole = memory.last.len() == 1 && is_plural;
        } else if several.len() > 1 {
            // None of them is "it", and of one that was meant there are no others; several may be "they".
            match nouns.iter().any(|noun| noun.plural) {
                true => {
                    memory.list(&several);
                    memory.is_plural = true;
                }
                false => memory.waver(&several),
            }
        }
        if let [place] = placed[..] {
            // "Is any of that in the fridge? What is in it?"
            if named.is_empty() && several.is_empty() && place.replica().is_some() {
                memory.mention(&[place]);
            }
            memory.told_place = Some(place);
        }
    }
}
