//! The clauses of a line, and which of them bound what it asks: "Once I close the door, …", «Летом …», "…, except the red ones".
//!
//! Invariant: a line is not answered as if what bounds its question had not been said.

use std::ops::Range;

use super::grammar::{Item, Phrase, Sentence};
use super::mark::Mark;
use super::orders::hinges;
use super::told_aside::{is_marked, is_polite};
use super::{Answer, Asker, Memory, Query, opening, premise, several, vocabulary};
use crate::sets::{Set, set};
use crate::words::{Language, may_be_predicate, phrase_at, word_keys, word_ranges};

/// Where a part of a line begins and ends, in bytes.
pub(super) type Part = (usize, usize);

/// What begins a condition, a time, or what is left out.
static BOUNDS: Set = Set::named("BoundsClause");

/// What joins a clause to another.
static JOINS: Set = Set::named("JoinsClause");

impl Asker<'_> {
    /// What bounds the question of a line, where the line is read as it is without that.
    pub(super) fn passed_over<'t>(
        &self,
        text: &'t str,
        answer: &Answer,
        before: &Memory,
    ) -> Option<&'t str> {
        let is_unheeded = |at: &Range<usize>| {
            let rest = without(text, at);
            // Most lines are one clause, of which nothing is left without it.
            !word_keys(&rest).is_empty()
                && self.bounds(&text[at.clone()])
                && self
                    .heard(&rest, &mut before.clone())
                    .is_ok_and(|plain| plain.query == answer.query)
        };
        candidates(text).into_iter().find(is_unheeded).map(|at| &text[at])
    }

    /// Whether a clause tells under which condition, when, or of what alone it is asked.
    pub(super) fn bounds(&self, clause: &str) -> bool {
        let keys = word_keys(clause);
        let small =
            keys.iter().take_while(|key| set!("BeforeOrder").contains(&key.as_str())).count();
        // "If so, where?"
        let asks_back = hinges(&keys[small..]) || several::is_tag(&keys.join(" "));
        if is_polite(&keys) || asks_back || self.premise(clause).is_some() {
            return false;
        }
        let taken = BOUNDS.iter().filter_map(|phrase| phrase_at(&keys, small, phrase)).max();
        taken.is_some_and(|taken| keys.len() > small + taken)
            || self.limits(clause)
            || self.is_adverbial(clause)
    }

    /// The runs of parts of a line beside which nothing stands that bounds them, the longest first, each with the rest.
    #[must_use]
    pub fn cores<'t>(&self, text: &'t str) -> Vec<(&'t str, String)> {
        const MOST: usize = 8;
        let Some((parts, bounds)) = self.bounding_parts(text, MOST) else { return Vec::new() };
        let count = parts.len();
        let runs = (1..count).rev().flat_map(|n| (0..=count - n).map(move |from| from..from + n));
        let is_free = |run: &Range<usize>| (0..count).all(|n| run.contains(&n) || !bounds[n]);
        let core = |run: Range<usize>| {
            let run = parts[run.start].0..parts[run.end - 1].1;
            (&text[run.clone()], without(text, &run))
        };
        runs.filter(is_free).map(core).collect()
    }

    /// The runs of a line that ask, as they begin or end, and beside which nothing bounds them, the longest first; each behind
    /// what stands before it. Within a part a run begins behind a joint, or with a word that asks: "gotta know which …".
    #[must_use]
    pub fn asked_within<'t>(&self, text: &'t str) -> Vec<(&'t str, &'t str)> {
        const MOST: usize = 16;
        let Some((parts, bounds)) = self.bounding_parts(text, MOST) else { return Vec::new() };
        let mut found = Vec::new();
        for (n, (from, to)) in parts.iter().enumerate() {
            let part = &text[*from..*to];
            let (words, keys) = (word_ranges(part), word_keys(part));
            let marked = |at: usize| {
                vocabulary::longest(&keys[at..=at]).is_some_and(|(_, mark)| mark.asks())
            };
            let begins = |at: usize| {
                let behind_joint = || (1..=at).any(|taken| joined(&keys[at - taken..at]) == taken);
                let (before, behind) = part.split_at(words[at].start);
                at == 0 || behind_joint() || marked(at) && !goes_on(before, behind)
            };
            for at in (0..keys.len()).filter(|at| begins(*at)) {
                let begin = from + words[at].start;
                if at > 0 && self.bounds(&text[*from..begin]) {
                    continue;
                }
                let is_free =
                    |last: usize| (0..parts.len()).all(|k| (n..=last).contains(&k) || !bounds[k]);
                let runs = (n..parts.len()).filter(|last| is_free(*last));
                let runs = runs.map(|last| (&text[..begin], &text[begin..parts[last].1]));
                let asks = |run: &str| self.asks(run) || self.begins_as_question(&self.plain(run));
                found.extend(runs.filter(|(_, run)| *run != text && asks(run)));
            }
        }
        found.sort_by_key(|(_, run)| std::cmp::Reverse(run.len()));
        found
    }

    /// The parts of a line and which of them bound it; none of a line of more.
    fn bounding_parts(&self, text: &str, most: usize) -> Option<(Vec<Part>, Vec<bool>)> {
        let parts = Some(parts(text)).filter(|parts| parts.len() <= most)?;
        let bounds = parts.iter().map(|(from, to)| self.bounds(&text[*from..*to])).collect();
        Some((parts, bounds))
    }

    /// «После ремонта», "last week", «летом»: no clause of its own, but a time or a place of what is asked.
    fn is_adverbial(&self, clause: &str) -> bool {
        let keys = word_keys(clause);
        let begins = set!("Adverbial").iter().any(|phrase| phrase_at(&keys, 0, phrase).is_some());
        let plain = self.plain(clause);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let items = sentence.items();
        // «У меня вопрос» is a clause.
        let governed = match items.first() {
            Some(Item::Link(_)) => true,
            Some(Item::Place { nouns, .. }) => !nouns.iter().all(is_person),
            _ => false,
        };
        let says = |item: &Item| match item {
            Item::Mark(mark) => matches!(
                mark,
                Mark::Be | Mark::Have | Mark::Can | Mark::Cannot | Mark::Must | Mark::Me
            ),
            Item::Noun(phrase) => phrase.person.is_some() || phrase.pronoun.is_some(),
            Item::Unknown(words) => {
                sentence.keys[words.clone()].iter().any(|key| may_be_predicate(key))
            }
            _ => false,
        };
        let unknown = items.iter().any(|item| matches!(item, Item::Unknown(_)));
        (begins || governed && unknown) && !items.iter().any(says)
    }

    /// The answer to a line without its idle clauses; else to what stands behind a mark of it and asks by itself, where nothing
    /// before that bounds or narrows it: «Слушай, я бегом, где чашки?»
    pub(super) fn beside_asides(
        &self,
        text: &str,
        language: Language,
        memory: &mut Memory,
    ) -> Option<Answer> {
        let mut after = memory.clone();
        if let Some(rest) = self.without_idle(text)
            && let Ok(answer) = self.ask(&rest, &mut after)
        {
            *memory = after;
            return Some(answer.understood_as(&rest, language));
        }
        parts(text).into_iter().skip(1).find_map(|(from, _)| {
            let (told, asked) = (&text[..from], &text[from..]);
            let keys = word_keys(asked);
            let stands = keys.len() > 1
                && opening::begins_question(&keys)
                && !set!("Than").contains(&keys[0].as_str())
                && !several::asks_in(told)
                && !is_reported(&word_keys(told))
                && !parts_of(told).any(|part| self.bounds(part) || self.tells_how_much(part))
                && !parts_of(told).any(|part| self.premise(part).is_some())
                && !parts_of(told).any(is_marked)
                && !self.narrows(told, asked)
                && !goes_on(told, asked)
                && self.asks_of_something(asked)
                && !(premise::says_here(asked) && self.tells_of_place(told));
            let mut after = memory.clone();
            if !stands {
                return None;
            }
            self.hear_of(told, &mut after);
            if self.is_astray(told) {
                Self::lose_person(told, &mut after);
            }
            // "Still in bed, how do I get to the kitchen?"
            if self.asks_the_way(asked) {
                let places = parts_of(told).filter_map(|part| self.place_alone(part));
                places.for_each(|place| self.hear_of_place(&place, &mut after));
            }
            let answer = self.ask(asked, &mut after).ok()?;
            // Whither was told, and came to nothing.
            let is_way = matches!(answer.query, Query::Way { .. });
            if !is_way && self.tells_of_place(told) && self.asks_the_way(asked) {
                return None;
            }
            let answer = self.heeding(&[told], answer, &after).ok()?;
            after.learn(&answer);
            *memory = after;
            Some(answer.understood_as(asked, language))
        })
    }

    /// «Расскажи кратко, …»: how much is asked for.
    fn tells_how_much(&self, text: &str) -> bool {
        let plain = self.plain(text);
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        items.iter().any(|item| matches!(item, Item::Mark(Mark::Detail(_))))
    }

    /// A line without its clauses that name nothing of the map and bound nothing: «Муж уехал в командировку, где …?», "Where,
    /// pray tell, is …?", "…, or shall I get up?" None where there is none such, or nothing else.
    pub(super) fn without_idle(&self, text: &str) -> Option<String> {
        let clauses = clauses(text);
        let (mut kept, mut last, mut reports) = (String::new(), 0, true);
        for (n, clause) in clauses.iter().enumerate() {
            let said = &text[clause.clone()];
            let asks = self.asks_by_marks(&kept);
            let leads = kept.is_empty() || asks && n + 1 < clauses.len();
            // «Извини, что отвлекаю»: what goes on from an idle clause.
            let told = if reports && !self.bounds(said) { behind_joint(said) } else { said };
            // The mark behind the last clause is that of the question.
            let ends = n + 1 == clauses.len() && self.asks(&kept);
            // «Жена говорит, что дверь заперта»: of what somebody says it is asked whether it is so; "I guess, but where …?"
            let next = clauses.get(n + 1).map(|next| word_keys(&text[next.clone()]));
            let reported =
                |keys: &[String]| keys.first().is_some_and(|key| JOINTS.contains(&key.as_str()));
            let anew = |keys: &Vec<String>| {
                joined(keys) > 0 || opening::begins_question(keys) && !reported(keys)
            };
            let claims = is_reported(&word_keys(told)) && !next.as_ref().is_some_and(anew);
            reports = !claims
                && self.is_idle(told.trim_end_matches(['?', ' ']), leads)
                && (ends || !said.ends_with('?'));
            if reports {
                continue;
            }
            // "So where is it?"
            let behind = (n > 0 && kept.is_empty())
                .then(|| word_ranges(said))
                .and_then(|words| Some(clause.start + words.get(joined(&word_keys(said)))?.start));
            let clause = behind.unwrap_or(clause.start)..clause.end;
            let said = &text[clause.clone()];
            let between = &text[last..clause.start];
            let joined = match (kept.is_empty(), n > 0 && clauses[n - 1].end > last) {
                (true, _) => "",
                (false, false) => between,
                (false, true) if asks => " ",
                (false, true) if between.contains(['.', '!', '?', '…']) => ". ",
                (false, true) => ", ",
            };
            kept = format!("{kept}{joined}{said}");
            last = clause.end;
        }
        let some = !kept.is_empty() && word_keys(&kept).len() < word_keys(text).len();
        let asks = text.contains('?') && !kept.ends_with('?');
        some.then(|| if asks { format!("{kept}?") } else { kept })
    }

    /// Whether a beginning only asks, and of nothing yet: «Какого», "Where".
    fn asks_by_marks(&self, begun: &str) -> bool {
        let plain = self.plain(begun);
        let items = Sentence::new(&plain, &self.mind.lexicon).items();
        items.iter().all(|item| matches!(item, Item::Mark(_)))
            && opening::begins_question(&word_keys(begun))
    }

    /// Whether a clause names nothing of the map and bounds nothing. Of a few words before the question ("blimey") none need
    /// be known; behind it, or more of them, they say something of the person, of others, or of the day.
    fn is_idle(&self, clause: &str, leads: bool) -> bool {
        const MOST: usize = 4;
        let (words, keys) = (word_ranges(clause), word_keys(clause));
        let taken = joined(&keys);
        let or = keys.first().is_some_and(|key| set!("Or").contains(&key.as_str()));
        let Some(first) = words.get(taken) else { return false };
        let said = &clause[first.start..];
        let keys = &keys[taken..];
        let idle_question = matches!(keys, [only] if set!("IdleQuestion").contains(&only.as_str()));
        if or && keys.len() < 2 {
            return idle_question;
        }
        let asks = !or && (opening::asks_at_once(keys) || several::asks_outright(said));
        if asks || self.bounds(said) || self.is_astray(said) || self.premise(said).is_some() {
            return false;
        }
        let plain = self.plain(said);
        let sentence = Sentence::new(&plain, &self.mind.lexicon);
        let items = sentence.items();
        let memory = Memory::default();
        let knowledge = self.knowledge(sentence.language, &memory);
        let of_person = |item: &Item| match item {
            Item::Mark(mark) => matches!(mark, Mark::Me | Mark::You),
            Item::Noun(phrase) => is_person(phrase),
            // «У меня посылка»
            Item::Place { nouns, .. } => nouns.iter().all(is_person),
            _ => false,
        };
        let says = |item: &Item| match item {
            Item::Mark(Mark::Be | Mark::Have | Mark::Can | Mark::Cannot | Mark::Must) => true,
            Item::Unknown(words) => {
                sentence.keys[words.clone()].iter().any(|key| may_be_predicate(key))
            }
            Item::Noun(phrase) => is_person(phrase) || phrase.pronoun.is_some(),
            item => of_person(item),
        };
        let is_clause = items.iter().any(says)
            && items.iter().any(|item| match item {
                Item::Unknown(_) => true,
                Item::Noun(phrase) => is_person(phrase) || phrase.pronoun.is_some(),
                item => of_person(item),
            });
        let idle = |item: &Item| match item {
            Item::Unknown(words) => is_clause || !self.is_word(sentence.said(words)),
            Item::Noun(phrase) => {
                let bare = phrase.noun.restrictions.is_empty() && phrase.noun.filters.is_empty();
                let thing = bare && knowledge.is_anything(&phrase.noun.head);
                is_person(phrase) || is_clause && (thing || phrase.pronoun.is_some() && leads)
            }
            Item::Place { nouns, .. } => nouns.iter().all(is_person),
            Item::Value(_) => leads && is_clause,
            Item::Link(_) => is_clause,
            Item::Mark(Mark::What | Mark::Who) => or,
            Item::Mark(mark) => {
                is_clause && !mark.asks() || matches!(mark, Mark::Filler | Mark::But | Mark::And)
            }
            _ => false,
        };
        (is_clause || leads && keys.len() <= MOST) && items.iter().all(idle)
    }
}

/// "I", «вас»
fn is_person(phrase: &Phrase) -> bool {
    phrase.person.is_some_and(|mark| mark != Mark::There)
}

/// How many of the words of a clause, at its beginning, join it to another.
fn joined(keys: &[String]) -> usize {
    JOINS.iter().filter_map(|phrase| phrase_at(keys, 0, phrase)).max().unwrap_or_default()
}

/// The clauses of a line: parted by marks, and by joints within.
fn clauses(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    for (from, to) in parts(text) {
        let part = &text[from..to];
        let (words, keys) = (word_ranges(part), word_keys(part));
        let joint = |n: &usize| JOINS.iter().any(|phrase| phrase_at(&keys, *n, phrase).is_some());
        let mut begin = from;
        for n in (1..keys.len()).filter(joint) {
            if begin < from + words[n].start && !joint(&(n - 1)) {
                found.push(begin..from + words[n - 1].end);
                begin = from + words[n].start;
            }
        }
        found.push(begin..to);
    }
    found
}

/// The clauses of a line that may bound it: what marks part, and within that what stands before the word that asks, or
/// behind one that begins a bound.
fn candidates(text: &str) -> Vec<Range<usize>> {
    let mut found = Vec::new();
    let parts = parts(text);
    for (n, (from, to)) in parts.iter().copied().enumerate() {
        let part = &text[from..to];
        let (words, keys) = (word_ranges(part), word_keys(part));
        found.push(from..to);
        // "Suppose, …"
        let alone = BOUNDS.contains(&keys.join(" ").as_str());
        found.extend(parts.get(n + 1).filter(|_| alone).map(|(_, next)| from..*next));
        let asks =
            |n: &usize| vocabulary::longest(&keys[*n..]).is_some_and(|(_, mark)| mark.asks());
        let asks = (2..keys.len()).find(asks);
        found.extend(asks.map(|n| from..from + words[n - 1].end));
        let begins = |n: &usize| BOUNDS.iter().any(|phrase| phrase_at(&keys, *n, phrase).is_some());
        found.extend((1..keys.len()).filter(begins).map(|n| from + words[n].start..to));
    }
    found
}

/// A line without one of its clauses; the mark of a question stays.
fn without(text: &str, clause: &Range<usize>) -> String {
    const MARKS: [char; 9] = [',', ';', ':', '.', '!', '…', '–', '—', ' '];
    let before = text[..clause.start].trim_end_matches([',', ';', ':', '–', '—', ' ']);
    let behind = text[clause.end..].trim_start_matches(MARKS);
    let asks = text[clause.clone()].ends_with('?') && behind.is_empty();
    let joined = if before.is_empty() || behind.is_empty() { "" } else { " " };
    format!("{before}{joined}{behind}{}", if asks { "?" } else { "" })
}

/// The same by their text.
pub(super) fn parts_of(text: &str) -> impl Iterator<Item = &str> {
    parts(text).into_iter().map(move |(from, to)| &text[from..to])
}

/// The parts of a line between its marks, by their bytes.
pub(super) fn parts(text: &str) -> Vec<Part> {
    let mut parts = Vec::new();
    let mut from = 0;
    let ends = text.char_indices().filter(|(at, c)| {
        // "Quick one: …", but "10:30"
        let ends = *c == ':' && text[at + 1..].starts_with(' ');
        ends || matches!(c, ',' | ';' | '.' | '!' | '?' | '…' | '–' | '—')
    });
    let ends = ends.map(|(at, mark)| (at, at + mark.len_utf8())).chain([(text.len(), text.len())]);
    for (end, next) in ends {
        let part = &text[from..end];
        let lead = part.len() - part.trim_start().len();
        if !part.trim().is_empty() {
            let closes = text[end..next].trim().starts_with('?');
            parts.push((from + lead, if closes { next } else { from + part.trim_end().len() }));
        }
        from = next;
    }
    parts
}

/// Words between who says something and what is said.
pub(super) static JOINTS: Set = Set::named("JoinsReport");

/// A part without the joint that begins it.
pub(super) fn behind_joint(part: &str) -> &str {
    let keys = word_keys(part);
    match (keys.first(), word_ranges(part).get(1)) {
        (Some(first), Some(second)) if JOINTS.contains(&first.as_str()) => &part[second.start..],
        _ => part,
    }
}

/// Whether words end by telling that somebody says or thinks what follows: «муж говорит, что», "my wife reckons".
pub(super) fn is_reported(keys: &[String]) -> bool {
    static SAYING: Set = Set::named("Saying");
    static STEMS: Set = Set::named("SayingStem");
    static KNOWING: Set = Set::named("Knowing");
    let joints = keys.iter().rev().take_while(|key| JOINTS.contains(&key.as_str())).count();
    let (before, joined) = keys.split_at(keys.len() - joints);
    let Some(last) = before.last() else { return false };
    let whether = joined.iter().any(|key| key == "if" || key == "whether");
    let says = SAYING.contains(&last.as_str()) || STEMS.iter().any(|stem| last.starts_with(stem));
    let confirms = set!("Confirm").contains(&last.as_str());
    match whether {
        true => says || KNOWING.contains(&last.as_str()),
        false => says || confirms && !joined.is_empty(),
    }
}

/// Whether a part of a line is a clause of what stands before it: «ту, что на кухне», "bigger, than …".
pub(super) fn goes_on(before: &str, part: &str) -> bool {
    static POINTING: Set = Set::named("PointingOne");
    let (keys, told) = (word_keys(part), word_keys(before));
    // «… но не те, что на столах», "… just not the ones on the desk": what is left out of what stands before.
    let leads = |key: &str| set!("But").contains(&key) || set!("OnlyWord").contains(&key);
    let mut words = keys.iter().skip_while(|key| leads(key.as_str()));
    let denied = words.next().is_some_and(|key| set!("Not").contains(&key.as_str()));
    let mut words = words.skip_while(|key| key.as_str() == "the");
    if denied && words.next().is_some_and(|key| POINTING.contains(&key.as_str())) {
        return true;
    }
    match keys.first().map(String::as_str) {
        Some("чем" | "than") => (0..told.len()).any(|n| {
            matches!(vocabulary::longest(&told[n..]), Some((_, Mark::More(_) | Mark::Nearer(_))))
        }),
        // "which" and «где» behind a word that points tell which one is meant.
        Some("что" | "which" | "that" | "где" | "where") => {
            // «Устал я что-то, где …?»: a particle points at nothing.
            let particle = before.trim_end_matches([',', ' ']).ends_with("-то");
            !particle && told.last().is_some_and(|last| POINTING.contains(&last.as_str()))
        }
        Some(first) => first.starts_with("котор") && !told.is_empty(),
        None => false,
    }
}
