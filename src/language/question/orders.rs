//! A text that orders and asks: «Скажи, где ваза, и принеси её», "Go to the bedroom and tell me what you see".

use std::ops::Range;

use super::conditions::{self, Another, IF, NOT_SO, SO, WHEN};
use super::query::Thing;
use super::several::sentences;
use super::{Asker, Memory, Unanswered, cut_off, opening};
use crate::command::{self, is_command, is_order, is_order_by};
use crate::paraphrase::Paraphrases;
use crate::sets::{Set, set};
use crate::words::{Case, Language, is_first_person, phrase_at, word_keys, word_ranges};

/// What parts the halves of a sentence.
const MARKS: [char; 8] = [',', ';', '.', '!', ':', '–', '—', '?'];

impl Asker<'_> {
    /// What is to be heard one after the other: «Скажи, где ваза, и принеси её» is a question and an order, "Go to the
    /// bedroom and tell me what you see" an order and a question. None where the text is one or the other.
    #[must_use]
    pub fn orders_and_questions(&self, text: &str, memory: &Memory) -> Option<Vec<String>> {
        // "Turn" begins questions as well as orders: an order before what is to be told stays one.
        let orders_first = || {
            self.orders(text)
                && order_and_question(text).is_some_and(|(order, _)| self.orders(order))
        };
        if !self.begins_as_question(text) || orders_first() {
            let (order, question) = order_and_question(text)?;
            let question = whether(&question).unwrap_or(question);
            // «Съезди на кухню, посмотри, включена ли плита, и вернись»
            let (question, later) =
                match self.question_and_order(question.trim_end_matches(['?', '.', ' '])) {
                    Some((asked, later)) => (format!("{asked}?"), Some(later.to_owned())),
                    None => (question, None),
                };
            if !self.begins_as_question(&question) && !question.ends_with('?') {
                return None;
            }
            // "Please go and see …": whither is not said; to what is asked of, where that is one thing.
            let polite = |key: &String| set!("PleaseOrJust").contains(&key.as_str());
            let bare = word_keys(order).iter().filter(|key| !polite(key)).count() < 2;
            let order = match bare {
                true if is_order(order) => self.way_to_what_is_asked(&question, memory),
                true => None,
                false => Some(order.to_owned()),
            };
            let behind = order.as_ref().filter(|_| !bare);
            let behind = behind.and_then(|_| self.orders_and_questions(&question, memory));
            let behind = behind.unwrap_or_else(|| vec![question]);
            return Some(order.into_iter().chain(behind).chain(later).collect());
        }
        let (question, order) = self.question_and_order(text)?;
        Some(vec![question.to_owned(), order.to_owned()])
    }

    /// The order to go to the first of what a question names by itself, else to what its answer is about.
    fn way_to_what_is_asked(&self, question: &str, memory: &Memory) -> Option<String> {
        let language = Language::of(question);
        let knowledge = self.knowledge(language, memory);
        let mut goal = None;
        self.read(question, memory).ok()?.each_noun(&mut |noun| {
            if let (None, Ok([only @ Thing::Entity(_)])) =
                (goal, knowledge.find(noun, true).as_deref())
            {
                goal = Some(*only);
            }
        });
        // Where there are several such things: to what the answer speaks of.
        let told = || {
            let answer = self.ask(question, &mut memory.clone()).ok()?;
            let all = answer.things.iter().chain(&answer.topic);
            all.copied().find(|thing| matches!(thing, Thing::Entity(_)))
        };
        let go = language.pick("подъедь к", "go to");
        Some(format!("{go} {}", knowledge.form(goal.or_else(told)?, Case::Dative)))
    }

    /// A question and the order behind it, whatever joins them: a word, a mark, or both.
    fn question_and_order<'t>(&self, text: &'t str) -> Option<(&'t str, &'t str)> {
        static JOINTS: Set = Set::named("JoinsOrders");
        /// "Which doors are locked, open or closed" is one question.
        static OR: Set = Set::named("Or");
        let (words, keys) = (word_ranges(text), word_keys(text));
        (2..keys.len()).find_map(|at| {
            let is_marked = text[words[at - 1].end..words[at].start].contains(MARKS);
            let is_joined = JOINTS.contains(&keys[at - 1].as_str());
            let order = &text[words[at].start..];
            let is_choice = keys.get(at + 1).is_some_and(|key| OR.contains(&key.as_str()));
            if !(is_marked || is_joined) || is_choice || !self.orders(order) {
                return None;
            }
            let joints = keys[..at].iter().rev().take_while(|key| JOINTS.contains(&key.as_str()));
            let end = words[at.checked_sub(joints.count() + 1)?].end;
            let question = &text[..end];
            (self.begins_as_question(question) && !self.orders(question))
                .then_some((question, order))
        })
    }

    /// "I need the battery, where is it?": whether a text asks behind what the person tells of itself, and orders nothing.
    #[must_use]
    pub fn asks_behind_what_is_told(&self, text: &str) -> bool {
        let Some((told, asked)) = text.trim_end().rsplit_once([',', ';', '–', '—']) else {
            return false;
        };
        let of_me = told.split([',', ';', '.', '!']).any(is_told_of_me);
        asked.ends_with('?')
            && of_me
            && word_keys(asked).len() > 2
            && !is_command(asked, &self.mind.paraphrases)
            && !self.orders(asked.trim_end_matches('?'))
            && !self.orders(told)
    }

    /// «Где взять нож», "I'm at the fridge, where can I grab a knife": whether a word asks at the beginning of a text, or behind
    /// what the person tells of itself. Such a text orders nothing, whatever its verbs and its last mark.
    #[must_use]
    pub fn asks_by_a_word(&self, text: &str) -> bool {
        let asks = |text: &str| opening::asks_by_a_word(&word_keys(text));
        let behind = text.rsplit_once([',', ';', '–', '—']).is_some_and(|(told, asked)| {
            let tells = told.split([',', ';', '.', '!']).any(is_told_of_me);
            tells && !self.orders(told) && asks(asked)
        });
        behind || asks(text)
    }

    /// Whether a text begins with a verb that orders, and not to be told something.
    fn orders(&self, text: &str) -> bool {
        is_order_by(text, &self.mind.paraphrases) && !self.asks_to_tell(text)
    }

    /// The sentences of a text that orders in one and asks in another, orders that follow each other as one; what
    /// neither orders nor asks stays with what follows it. None where all are of one sort.
    #[must_use]
    pub fn sentences_that_order_and_ask(&self, text: &str) -> Option<Vec<String>> {
        let asks = |part: &str| !self.orders(part) && part.trim_end().ends_with('?');
        let said = sentences(text);
        if !said.iter().any(|part| self.orders(part))
            || !said.iter().any(|part| asks(part) && !is_command(part, &self.mind.paraphrases))
        {
            return None;
        }
        let mut parts: Vec<(String, bool)> = Vec::new();
        let mut open = false;
        for part in said {
            let question = asks(part) && !is_command(part, &self.mind.paraphrases);
            match parts.last_mut() {
                Some((before, was)) if open || (!*was && !question) => {
                    *before = format!("{before} {part}");
                    *was = question;
                }
                _ => parts.push((part.to_owned(), question)),
            }
            open = !question && !self.orders(part);
        }
        Some(parts.into_iter().map(|(part, _)| part).collect())
    }
}

/// Whether a part of a line begins with the person who speaks: "I am …", «стою у окна».
fn is_told_of_me(part: &str) -> bool {
    let first = word_keys(part).into_iter().next();
    first.is_some_and(|key| opening::is_me(&key) || is_first_person(&key))
}

/// What is told to be found out, as a question: «скажи, выключена ли лампа», "tell me whether the fridge is on".
fn whether(text: &str) -> Option<String> {
    let (words, keys) = (word_ranges(text), word_keys(text));
    if keys.iter().any(|key| key == "ли") {
        return Some(format!("{}?", &text[words.get(1)?.start..words.last()?.end]));
    }
    let at = keys.iter().position(|key| key == "whether" || key == "if")?;
    asked(&text[words.get(at + 1)?.start..])
}

/// A claim in English as a question: "the fridge is on" is "is the fridge on?".
fn asked(claim: &str) -> Option<String> {
    let (words, keys) = (word_ranges(claim), word_keys(claim));
    let said = |range: Range<usize>| match range.is_empty() {
        true => "",
        false => &claim[words[range.start].start..words[range.end - 1].end],
    };
    let Some(is) = keys.iter().position(|key| set!("IsOrIsNot").contains(&key.as_str())) else {
        // "the kitchen has a fridge"
        let has = keys.iter().position(|key| key == "has").filter(|has| *has > 0)?;
        return Some(format!("does {} have {}?", said(0..has), said(has + 1..words.len())));
    };
    let denies = set!("IsNot").contains(&keys[is].as_str()) && keys.get(is + 1)? == "t";
    let (what, state) = (said(0..is), said(is + 1 + usize::from(denies)..words.len()));
    let be = match keys[is].as_str() {
        "are" | "aren" => "are",
        _ => "is",
    };
    let not = if denies { " not" } else { "" };
    Some(format!("{be} {what}{not} {state}?"))
}

/// Whether words only refer to a condition that was asked: "if so", «иначе».
pub(super) fn hinges(keys: &[String]) -> bool {
    let words = keys.join(" ");
    SO.iter().chain(NOT_SO.iter()).any(|phrase| *phrase == words)
}

/// What is to be done where the answer before was yes, and where it was no.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Hinged<'t> {
    pub if_so: Option<&'t str>,
    pub otherwise: Option<&'t str>,
}

impl<'t> Hinged<'t> {
    /// What is to be done by that answer.
    #[must_use]
    pub fn given(&self, so: bool) -> Option<&'t str> {
        if so { self.if_so } else { self.otherwise }
    }
}

/// Orders that hinge on the answer before them: "If so, close it. Otherwise …", «Иначе принеси вилку».
#[must_use]
pub fn hinged(text: &str) -> Option<Hinged<'_>> {
    static JOINTS: Set = Set::named("JoinsCondition");
    let (words, keys) = (word_ranges(text), word_keys(text));
    let joint = |n: &usize| keys.get(*n).is_some_and(|key| JOINTS.contains(&key.as_str()));
    let behind = |from: usize| (from..=keys.len()).find(|n| !joint(n)).unwrap_or(keys.len());
    let hinge = |n: usize| {
        let longest = |all: &[&str]| all.iter().filter_map(|p| phrase_at(&keys, n, p)).max();
        let (so, not) = (longest(&SO).map(|l| (l, true)), longest(&NOT_SO).map(|l| (l, false)));
        let (taken, wanted) = so.max(not)?;
        let order = words.get(behind(n + taken))?.start;
        is_order(&text[order..]).then_some((order, wanted))
    };
    let first = behind(0);
    let (from, wanted) = hinge(first)?;
    let parted = |n: &usize| text[words[n - 1].end..words[*n].start].contains([',', ';', '.', '!']);
    let second = (first + 1..words.len())
        .filter(|n| words[*n].start > from && parted(n))
        .find_map(|n| Some((words[n].start, hinge(behind(n))?)));
    match second {
        Some((end, (next, other))) if other != wanted => {
            let (first, second) = (Some(text[from..end].trim_end()), Some(&text[next..]));
            let (if_so, otherwise) = if wanted { (first, second) } else { (second, first) };
            Some(Hinged { if_so, otherwise })
        }
        // Twice under the same condition, or once.
        Some(_) => None,
        None => {
            let order = Some(&text[from..]);
            let (if_so, otherwise) = if wanted { (order, None) } else { (None, order) };
            Some(Hinged { if_so, otherwise })
        }
    }
}

/// An order that depends on what is found: «Если дверь закрыта, открой её», "Bring the apple if it is on the shelf".
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Conditional {
    /// What is to be done before.
    pub first: Option<String>,
    /// What the condition speaks of, where that is said before it.
    pub about: Option<String>,
    pub question: String,
    /// What is to be done if so.
    pub then: Option<String>,
    pub otherwise: Option<String>,
    /// What is ordered under another condition, whatever comes of this one: «…, и если …».
    pub also: Option<String>,
    /// «когда», "as soon as": it was to be waited for.
    pub waits: bool,
}

/// Whether a text begins with the condition under which it orders.
pub(super) fn is_under_condition(text: &str) -> bool {
    let begins = word_keys(text).first().is_some_and(|key| IF.contains(&key.as_str()));
    begins && !text.trim_end().ends_with('?') && conditional(text).is_some()
}

/// An order under a condition; none where the text has none, or orders nothing under it.
#[must_use]
pub fn conditional(text: &str) -> Option<Conditional> {
    static PERSONS: Set = Set::named("Person");
    /// Behind these "if" asks.
    static ASKS: Set = Set::named("AsksToLook");
    static TELLS: Set = Set::named("TellWhenSo");
    static SMALL: Set = Set::named("BeforeOrder");
    static NOTHING: Set = Set::named("DoNothing");
    if command::is_too_long(text) {
        return None;
    }
    if let Some(whole) = cut_off::mended(text) {
        return conditional(&whole);
    }
    // «Если дверь открыта, закрой её, а если закрыта, …»
    if let Some(Another { before, text: another, instead }) = conditions::another(text)
        && let Some(mut first) = conditional(before)
    {
        let other = if instead { &mut first.otherwise } else { &mut first.also };
        if other.is_none() {
            *other = Some(another.to_owned());
            return Some(first);
        }
    }
    let (words, keys) = (word_ranges(text), word_keys(text));
    let phrase = |at: usize, all: &[&str]| all.iter().filter_map(|p| phrase_at(&keys, at, p)).max();
    let said = |range: Range<usize>| {
        let mut range = range;
        let small = |n: usize| SMALL.contains(&keys[n].as_str());
        while !range.is_empty() && small(range.start) {
            range.start += 1;
        }
        while !range.is_empty() && small(range.end - 1) {
            range.end -= 1;
        }
        (!range.is_empty())
            .then(|| text[words[range.start].start..words[range.end - 1].end].to_owned())
    };
    let order = |range: Range<usize>| {
        said(range).filter(|said| !NOTHING.contains(&word_keys(said).join(" ").as_str()))
    };
    let parted =
        |n: usize| text[words[n - 1].end..words[n].start].contains([',', ';', '.', '–', '—']);
    // "If it is, turn it off", but "if it is on the shelf".
    let ends = |n: usize| {
        n >= keys.len()
            || parted(n)
            || SMALL.contains(&keys[n].as_str())
            || is_order(&text[words[n].start..])
    };
    let whole = |n: usize, all: &[&str]| phrase(n, all).filter(|taken| ends(n + taken));
    // «…, и если закрыта, открой»: the word of the question once more.
    let again = |n: usize| {
        let said = keys.get(n + 1).is_some_and(|key| keys[..n].contains(key));
        (phrase(n, &IF).is_some() && said && ends(n + 2)).then_some(2)
    };
    let polite = |n: usize| command::small_words(&keys[n..]) > 1;
    let begins = |n: usize| n == 0 || parted(n) || is_order(&text[..words[n].start]);
    let event = |n: usize| {
        let claim = n + phrase(n, &WHEN)?;
        let person = keys.get(claim).is_some_and(|key| PERSONS.contains(&key.as_str()));
        let another = keys.get(claim).is_some_and(|key| command::is_of_another(key));
        let told =
            claim < keys.len() && !person && (another || !is_order(&text[words[claim].start..]));
        (told && begins(n) && !polite(n)).then_some(claim)
    };
    let condition = (0..keys.len()).find(|&n| {
        let asks = n.checked_sub(1).is_some_and(|b| ASKS.contains(&keys[b].as_str()));
        phrase(n, &IF).is_some()
            && whole(n, &SO).is_none()
            && again(n).is_none()
            && !asks
            && !polite(n)
    });
    let so = (1..keys.len()).find_map(|n| Some((n, whole(n, &SO).or_else(|| again(n))?)));
    let not_so = |from: usize| {
        // "If it is not on the shelf" goes on.
        let found = (from..keys.len()).find_map(|n| {
            let taken = phrase(n, &NOT_SO)?;
            let goes_on = phrase(n, &IF).is_some() && whole(n, &NOT_SO).is_none();
            let nothing = phrase(n + taken, &NOTHING).is_some();
            (!goes_on || nothing).then_some((n, taken))
        });
        found.unwrap_or((keys.len(), 0))
    };
    // «Проверь, включена ли лампа; если да, выключи её»
    if let Some((at, taken)) = so
        && let Some(asked) = said(0..at)
        && let Some((first, question)) = order_and_question(&asked)
    {
        let question = whether(&question).unwrap_or(question);
        let (end, length) = not_so(at + taken);
        let then = order(at + taken..end);
        let first = Some(first).filter(|first| word_ranges(first).len() > 1).map(str::to_owned);
        let otherwise = order((end + length).min(keys.len())..keys.len());
        let waits = false;
        let about = None;
        return Some(Conditional { first, about, question, then, otherwise, also: None, waits });
    }
    // "Wait until the door is open, then go in"
    if let Some((at, from)) = command::awaited(&keys) {
        let next = (from + 1..keys.len())
            .find(|&n| (parted(n) || keys[n - 1] == "then") && is_order(&text[words[n].start..]));
        let first = said(0..at).filter(|first| word_ranges(first).len() > 1);
        let claim: Vec<&str> = (from..next.unwrap_or(keys.len()))
            .filter(|&n| !set!("AndOrNot").contains(&keys[n].as_str()))
            .map(|n| &text[words[n].clone()])
            .collect();
        let claim = claim.join(" ");
        let question = asked(&claim).unwrap_or_else(|| format!("{claim}?"));
        let then = next.and_then(|next| order(next..keys.len()));
        let waits = true;
        let (about, otherwise, also) = (None, None, None);
        return Some(Conditional { first, about, question, then, otherwise, also, waits });
    }
    let gathered = command::in_time(text, &Paraphrases::built_in());
    let awaited = || (0..keys.len()).filter(|_| gathered.is_none()).find(|&n| event(n).is_some());
    let waits = condition.is_none();
    let at = condition.or_else(awaited)?;
    let from = if waits { event(at)? } else { at + phrase(at, &IF)? };
    // What is told when it happens is an order as well.
    let orders =
        |n: usize| is_order(&text[words[n].start..]) || waits && phrase(n, &TELLS).is_some();
    let leads = said(0..at).is_none_or(|before| !is_order(&before));
    let (claim, then, end, length) = if leads {
        // Up to what orders, behind a mark or «то», "then"; else up to the verb that follows. What is waited for may be
        // one word: «когда стемнеет».
        let least = from + if waits { 1 } else { 2 };
        let marked = |n: &usize| parted(*n) || set!("Then").contains(&keys[n - 1].as_str());
        let next = (least..keys.len())
            .filter(marked)
            .find(|&n| orders(n) || phrase(n, &NOTHING).is_some());
        let next = next.or_else(|| (from + 2..keys.len()).find(|&n| orders(n)))?;
        let (end, length) = not_so(next);
        (from..next, next..end, end, length)
    } else {
        let (end, length) = not_so(from);
        (from..end, 0..at, end, length)
    };
    let unless = keys[at] == "unless";
    let claim = said(claim)?;
    let question = match Language::of(&claim) {
        Language::Russian => format!("{claim}?"),
        Language::English => match asked(&claim) {
            Some(question) => question,
            // "when the door opens"; "if you have time, …, otherwise …" is for who is asked to tell.
            None if waits || length > 0 => format!("{claim}?"),
            None => return None,
        },
    };
    let then = order(then);
    let otherwise = order((end + length).min(keys.len())..keys.len());
    let (then, otherwise) = if unless { (otherwise, then) } else { (then, otherwise) };
    let about = then.clone().or(otherwise.clone()).filter(|_| !leads);
    let orders = then.is_some() || otherwise.is_some();
    let (first, also) = (None, None);
    orders.then_some(Conditional { first, about, question, then, otherwise, also, waits })
}

impl Conditional {
    /// What is told where the condition does not hold, and nothing else is to be done.
    #[must_use]
    pub fn undone(&self) -> &'static str {
        let language = Language::of(&self.question);
        match self.waits {
            true => language.pick(
                "Пока это не так, а ждать событий я не умею: скажите ещё раз, когда так будет.",
                "It is not so yet, and I do not wait for events: tell me again when it is.",
            ),
            false => Self::nothing_to_do(language),
        }
    }

    /// That a condition does not hold under which something was to be done.
    #[must_use]
    pub fn nothing_to_do(language: Language) -> &'static str {
        language.pick(
            "Тогда делать нечего: проверено сейчас, следить за этим я не буду.",
            "Then there is nothing to do: I looked now, and do not keep watching.",
        )
    }

    /// "If there is no banana": whether it is asked for what is not so.
    #[must_use]
    pub fn denies(&self) -> bool {
        word_keys(&self.question).iter().any(|key| set!("DeniesCondition").contains(&key.as_str()))
    }

    /// What is told where it is not known whether the condition holds: of an event, mostly.
    #[must_use]
    pub fn unknown(&self, mut unanswered: Unanswered) -> Unanswered {
        let language = Language::of(&self.question);
        let event = language.pick(
            "Ждать событий я не умею: скажите, когда это случится.",
            "I do not wait for events: tell me when it has happened.",
        );
        if self.waits {
            event.clone_into(&mut unanswered.text);
        } else if unanswered.doubt.kind() == "not_understood" {
            let head = language.pick(
                "Так ли это, мне не узнать; скажите, что делать.",
                "I cannot find out whether that is so; say what is to be done.",
            );
            unanswered.text = format!("{head} {}", unanswered.text);
        }
        unanswered
    }
}

/// An order and the question after it, or the question that is to be reported: «доложи, что ты видишь».
fn order_and_question(text: &str) -> Option<(&str, String)> {
    static TELL: Set = Set::named("TellOrLook");
    /// Behind these stands what is to be so, and no question.
    static THAT: Set = Set::named("That");
    static ROUND: Set = Set::named("LookAround");
    let (words, keys) = (word_ranges(text), word_keys(text));
    if ROUND.contains(&keys.join(" ").as_str()) {
        let question = Language::of(text).pick("Что ты видишь?", "What do you see?");
        return Some(("", question.to_owned()));
    }
    for at in 0..keys.len() {
        let Some(taken) = TELL.iter().filter_map(|tell| phrase_at(&keys, at, tell)).max() else {
            continue;
        };
        let asked = at + taken;
        // "Check every room" sends the robot round.
        let told = command::gathered(&text[words[at].start..]);
        if matches!(command::clauses(&told).first(), Some((0, command::Sort::Go))) {
            continue;
        }
        // "Look in the fridge" goes there.
        let goes = matches!(keys[at].as_str(), "look") && command::link_at(&keys, asked);
        if goes || asked >= words.len() || THAT.iter().any(|w| phrase_at(&keys, asked, w).is_some())
        {
            continue;
        }
        let order = text[..words[at].start].trim_end();
        let mut order = order.trim_end_matches([',', ';', '.']);
        for joint in set!("BeforeTelling") {
            let before = order.strip_suffix(joint).filter(|before| before.ends_with(' '));
            order = before.unwrap_or(order).trim_end().trim_end_matches(',');
        }
        if at == 0 || is_order(order) {
            let tell = Language::of(text).pick("скажи, ", "tell me ");
            let order = if at == 0 { "" } else { order };
            return Some((order, format!("{tell}{}", &text[words[asked].start..])));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    fn check(text: &str, expected: Option<(&str, Option<&str>, Option<&str>)>) {
        let found = conditional(text);
        let found = found
            .as_ref()
            .map(|c| (c.question.as_str(), c.then.as_deref(), c.otherwise.as_deref()));
        assert_eq!(found, expected, "{text}");
    }

    #[test]
    fn an_order_is_parted_from_its_condition() {
        check(
            "Если дверь в ванную закрыта, открой её, иначе ничего не делай",
            Some(("дверь в ванную закрыта?", Some("открой её"), None)),
        );
        check(
            "If the TV in the living room is off, turn it on",
            Some(("is the TV in the living room off?", Some("turn it on"), None)),
        );
        check(
            "Bring the apple if it is on the shelf, otherwise bring the potato",
            Some(("is it on the shelf?", Some("Bring the apple"), Some("bring the potato"))),
        );
        check(
            "Check whether the TV in the bedroom is on; if it is, turn it off",
            Some(("is the TV in the bedroom on?", Some("turn it off"), None)),
        );
        check(
            "Сходи глянь, есть ли на кухне яблоко, и если есть, принеси его",
            Some(("есть ли на кухне яблоко?", Some("принеси его"), None)),
        );
        check(
            "Bring the battery unless the office is locked",
            Some(("is the office locked?", None, Some("Bring the battery"))),
        );
        check(
            "Проверь, закрыта ли дверь, и если закрыта, открой",
            Some(("закрыта ли дверь?", Some("открой"), None)),
        );
        check(
            "If there's an egg on the counter, put it in the fridge",
            Some(("is there an egg on the counter?", Some("put it in the fridge"), None)),
        );
        check("Go and see if the door is locked", None);
        check("Принеси, если не трудно, чашку", None);
        check("Bring the cup", None);
    }
}
