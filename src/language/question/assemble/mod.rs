//! From items to a query: which question is asked, and what part each noun and place plays in it.
//!
//! Word order decides only where nothing else does. The rules stand in the order in which they are tried: the more
//! telling a word is («ближе», "how far"), the earlier its rule.

mod about;
mod account;
mod activity;
mod all_told;
mod alternatives;
mod attach;
mod claim;
mod clauses;
mod compare;
mod elided;
mod frame;
mod passing;
mod taken_up;
mod together;
mod used;
mod way;
mod which;

use super::Doubt;
use super::grammar::{Item, Sentence};
use super::lexicon::Lexicon;
use super::mark::{Mark, Pronoun};
use super::query::{Head, Noun, Query, Rel, Restriction, Sized, Thing};
use super::told_together::Elided;
use super::values::{Property, ValueId};
use crate::sets::Set;

/// What a pronoun means, in the relation of which it is the anchor.
pub(super) type Referent<'a> = dyn Fn(Pronoun, Option<Rel>) -> Vec<Thing> + 'a;

/// Reads a query out of the items of a sentence.
pub(super) fn query(
    sentence: &Sentence<'_>,
    lexicon: &Lexicon,
    referent: &Referent<'_>,
    elided: Option<Elided>,
) -> Result<Query, Doubt> {
    let items = sentence.items();
    if items.is_empty() {
        // «Привет» greets; it asks nothing.
        return if sentence.words.is_empty() { Err(Doubt::Empty) } else { Ok(Query::Help) };
    }
    let frame = Frame::of(sentence, lexicon, &items, referent)?;
    if frame.tells_need() {
        return Err(Doubt::not_understood(sentence.text));
    }
    if let Some(queries) = each_of(sentence, lexicon, &items, &frame, referent) {
        return Ok(Query::Several(queries));
    }
    if let Some(claims) = clauses::clauses_of(sentence, lexicon, &items, &frame, referent) {
        return Ok(claims);
    }
    let read = match frame.read() {
        None => return Err(frame.not_understood(&items)),
        read => read.and_then(|query| frame.filled(frame.in_both(query), elided)),
    };
    match read {
        Some(mut query) => match frame.left_out(&mut query) {
            Some(words) => Err(Doubt::not_understood(&words)),
            None if frame.asks_more_than(&mut query) || tells_before(sentence, &items, &query) => {
                Err(Doubt::not_understood(sentence.text))
            }
            None => Ok(query),
        },
        None => Err(Doubt::not_understood(sentence.text)),
    }
}

/// "I need a plate, is there a cup?": what is told before a comma and what asks whether there is something is not asked for.
fn tells_before(sentence: &Sentence<'_>, items: &[Item], query: &Query) -> bool {
    let Query::Exists { what, .. } = query else { return false };
    let is_noun = |item: &Item| matches!(item, Item::Noun(phrase) if phrase.person.is_none());
    let Some(asks) = items.iter().position(|item| *item == Item::Mark(Mark::Exists)) else {
        return false;
    };
    let before = items[..asks].iter().rposition(is_noun);
    let behind = items[asks..].iter().position(is_noun).map(|n| asks + n);
    let Some((before, behind)) = before.zip(behind).filter(|_| what.len() > 1) else {
        return false;
    };
    let between = &items[before..behind];
    let joined = between.iter().any(|item| matches!(item, Item::Mark(Mark::And | Mark::Or)));
    let (Item::Noun(told), Item::Noun(asked)) = (&items[before], &items[behind]) else {
        return false;
    };
    !joined && (told.words.end..=asked.words.start).any(|at| sentence.comma_between(at, at))
}

/// "What colour are the sofa and the armchair?" asks of each by itself.
fn each_of(
    sentence: &Sentence<'_>,
    lexicon: &Lexicon,
    items: &[Item],
    frame: &Frame<'_, '_>,
    referent: &Referent<'_>,
) -> Option<Vec<Query>> {
    // What compares or joins two things needs both.
    let together = |mark: &Mark| {
        matches!(
            mark,
            Mark::Lead
                | Mark::Nearer(_)
                | Mark::More(_)
                | Mark::Same
                | Mark::HowFar
                | Mark::HowGet
                | Mark::Exists
                | Mark::Have
                | Mark::Best(_)
                | Mark::BestTo(_)
                | Mark::Why
                | Mark::WhyNot
                | Mark::Differ
                | Mark::Alike
        )
    };
    // "How many pots and kettles are there?" counts each.
    let counts = frame.has(Mark::HowMany) && frame.property.is_none();
    let shared = frame.spots.iter().any(|s| s.nouns[0].same)
        || frame.links.iter().any(|(rel, _)| matches!(rel, Rel::NextTo | Rel::Near));
    let together = |mark: &Mark| together(mark) && !(counts && *mark == Mark::Exists);
    if shared || frame.marks.iter().any(|(mark, _)| together(mark)) {
        return None;
    }
    let joined = items.windows(3).position(|window| {
        matches!(window, [Item::Noun(a), Item::Mark(Mark::And), Item::Noun(b)]
            if a.person.is_none() && b.person.is_none())
    });
    // Lists: «стол, стул и диван», «где: стол, стул?»
    let parted = |n: usize| match (&items[n], items.get(n + 1)) {
        (Item::Noun(a), Some(Item::Noun(b))) => {
            a.person.is_none() && sentence.comma_between(a.words.end, b.words.start)
        }
        _ => false,
    };
    let after_colon = |n: &usize| match &items[*n] {
        Item::Noun(phrase) => sentence.colon_before(phrase.words.start),
        _ => false,
    };
    let mut nouns = match joined {
        Some(at) => vec![at, at + 2],
        None => {
            let first = (0..items.len()).find(after_colon).filter(|n| parted(*n))?;
            let others = (first..items.len()).take_while(|n| parted(*n)).map(|n| n + 1);
            std::iter::once(first).chain(others).collect()
        }
    };
    while nouns[0] > 0 && parted(nouns[0] - 1) {
        nouns.insert(0, nouns[0] - 1);
    }
    // "How many chairs besides Chair 1 and Chair 2": what is left out is left out at once.
    if nouns[0].checked_sub(1).is_some_and(|n| items[n] == Item::Mark(Mark::Except)) {
        return None;
    }
    // «Стулья 3» is one chair by its name.
    let plural = |n: &usize| matches!(&items[*n], Item::Noun(p) if p.noun.plural && p.noun.head.named.len() != 1);
    if nouns.iter().all(plural) && !counts {
        return None;
    }
    let mut queries = Vec::new();
    for own in &nouns {
        let list = nouns[0]..=nouns[nouns.len() - 1];
        let kept = items.iter().enumerate().filter(|(n, _)| n == own || !list.contains(n));
        let kept: Vec<Item> = kept.map(|(_, item)| item.clone()).collect();
        let own = Frame::of(sentence, lexicon, &kept, referent).ok()?;
        let mut query = own.read()?;
        if own.asks_more_than(&mut query) {
            return None;
        }
        let single = matches!(
            query,
            Query::Where(_)
                | Query::RoomOf(_)
                | Query::Property { .. }
                | Query::Size { .. }
                | Query::Count(_)
                | Query::Describe(_)
                | Query::LastSeen(_)
                | Query::Before(_)
                | Query::Parts(_)
                | Query::Holds { .. }
                | Query::Choice { .. }
                | Query::Anchor { .. }
                | Query::Free(_)
        );
        if !single {
            return None;
        }
        queries.push(query);
    }
    Some(queries)
}

/// A sentence that is a description and nothing more: «красная», «та, что на столе».
pub(super) fn fragment(
    sentence: &Sentence<'_>,
    lexicon: &Lexicon,
    referent: &Referent<'_>,
) -> Option<Noun> {
    let items = sentence.items();
    let frame = Frame::of(sentence, lexicon, &items, referent).ok()?;
    let of_those = frame.marks.iter().any(|(m, _)| matches!(m, Mark::Best(_)))
        || items.iter().any(|item| match item {
            Item::Value(_) => true,
            // "which one is in the kitchen"
            Item::Noun(phrase) => phrase.noun.head.anything,
            _ => false,
        });
    // «А не белых?»
    let denials = frame.marks.iter().filter(|(mark, _)| *mark == Mark::Not).count();
    let denies_values = denials == frame.values.iter().filter(|(_, _, negated)| *negated).count();
    let small = |mark: &Mark| {
        matches!(
            mark,
            Mark::The
                | Mark::A
                | Mark::Be
                | Mark::Hang
                | Mark::One
                | Mark::Best(_)
                | Mark::Rank(_)
                | Mark::And
        ) || (*mark == Mark::Not && denies_values)
            || (*mark == Mark::HowMany && frame.nouns.is_empty())
            || (*mark == Mark::Exists && of_those)
            || (*mark == Mark::Which && of_those)
    };
    // «А дверь открыта?» says it of the door.
    let says = !frame.nouns.is_empty() && !frame.values.is_empty();
    // «А сколько она стоит?» asks of itself.
    if items.is_empty()
        || says
        || frame.property.is_some()
        || frame.nouns.len() > 1
        || !frame.marks.iter().all(|(mark, _)| small(mark))
    {
        return None;
    }
    Some(frame.with_rest(frame.first().unwrap_or_default(), &[]))
}

/// A noun of the question.
#[derive(Debug, Clone)]
struct Subject {
    noun: Noun,
    at: usize,
    negated: bool,
    nominative: bool,
}

/// A preposition with its nouns.
#[derive(Debug, Clone)]
struct Spot {
    rel: Rel,
    nouns: Vec<Noun>,
    either: bool,
    at: usize,
    negated: bool,
}

impl Spot {
    fn restrictions(&self) -> Vec<Restriction> {
        // "With a sink and a window" has both; "without a sink and a window" has neither.
        if matches!(self.rel, Rel::Has | Rel::Bears) && !self.either && !self.negated {
            return self.each().collect();
        }
        // «в спальне и коридоре»: in either of them.
        vec![Restriction { rel: self.rel, anchors: self.nouns.clone(), negated: self.negated }]
    }

    fn each(&self) -> impl Iterator<Item = Restriction> + '_ {
        self.nouns.iter().map(|noun| Restriction {
            rel: self.rel,
            anchors: vec![noun.clone()],
            negated: self.negated,
        })
    }
}

/// The items of a sentence by what they are.
struct Frame<'s, 't> {
    sentence: &'s Sentence<'t>,
    lexicon: &'s Lexicon,
    marks: Vec<(Mark, usize)>,
    nouns: Vec<Subject>,
    spots: Vec<Spot>,
    links: Vec<(Rel, usize)>,
    values: Vec<(ValueId, usize, bool)>,
    sizes: Vec<Sized>,
    property: Option<(Property, usize)>,
    /// The robot is spoken to.
    you: bool,
    /// The person who asks is spoken of.
    me: bool,
    /// «там», "there"
    there: Option<Noun>,
    /// The same word, where nothing was spoken of that it could mean.
    nowhere: Option<String>,
    negated: bool,
    /// «кроме лампы»
    except: Vec<Noun>,
    /// All that is excepted, whatever of.
    excepted: Vec<Noun>,
    /// What an activity is done to, where nothing knows the word.
    undone: Option<String>,
    /// A number that counts nothing was said.
    idle: bool,
}

fn things(things: Vec<Thing>, text: &str) -> Noun {
    let plural = things.len() > 1;
    let head = Head { things: Some(things), ..Head::default() };
    Noun { head, text: text.to_owned(), plural, all: plural, ..Noun::default() }
}

impl Frame<'_, '_> {
    fn read(&self) -> Option<Query> {
        if self.has(Mark::Why) || self.has(Mark::WhyNot) {
            return match self.activity_done_with() {
                Some(query) => query,
                None => Some(self.why()),
            };
        }
        // «Какой стул посередине?»: of what is not said.
        if self.links.iter().any(|(rel, _)| *rel == Rel::Middle) {
            return None;
        }
        // "between here and the bedroom": one end is missing.
        if self.links.iter().any(|(rel, _)| *rel == Rel::Between) {
            return None;
        }
        // "What is behind when facing the TV?": left and right alone are told so.
        let facing = self.spot(&[Rel::Facing]).is_some() || self.has(Mark::FacingIt);
        if facing
            && self
                .links
                .iter()
                .any(|(rel, _)| matches!(rel, Rel::LeftOf | Rel::RightOf | Rel::Behind))
        {
            return None;
        }
        // «Влезет ли коробка под кровать?»: the room under things is not known.
        // "What can be opened in the bedroom?" does not ask what is open.
        let state = |value: ValueId| self.lexicon.values.entry(value).property == Property::State;
        let done = self.asks() && self.has(Mark::Can) && !self.has(Mark::Move);
        if done && self.values.iter().any(|(value, _, _)| state(*value)) {
            return self.openable();
        }
        if let Some(query) = self.said_of_a_place() {
            return Some(query);
        }
        let fits = self.has(Mark::PutDown) || self.has(Mark::Free);
        if fits && self.spot(&[Rel::Under]).is_some() {
            return None;
        }
        // "Could a bed fit in the corridor?": how things would stand on a floor is not known.
        static FIT: Set = Set::named("Fits");
        let fit = self.sentence.keys.iter().any(|key| FIT.contains(&key.as_str()));
        // Nor how much room a shelf within a thing has.
        let level = |s: &Spot| s.nouns[0].best.as_ref().is_some_and(|b| b.extreme.is_level());
        if (fit || fits) && self.spots.iter().any(level) {
            return None;
        }
        if fit && self.spot(&[Rel::In]).is_some_and(|s| self.is_area(&s.nouns[0])) {
            return None;
        }
        self.purpose()
            .or_else(|| self.reached())
            .or_else(|| self.of_robot())
            .or_else(|| self.people())
            .or_else(|| self.kinds())
            .or_else(|| self.keys())
            .or_else(|| self.together())
            .or_else(|| self.difference())
            .or_else(|| self.side_by_side())
            .or_else(|| self.passing())
            .or_else(|| self.way())
            .or_else(|| self.more_of())
            .or_else(|| self.most())
            .or_else(|| self.compared())
            .or_else(|| self.size())
            .or_else(|| self.use_of_place())
            .or_else(|| self.history())
            .or_else(|| self.counted())
            .or_else(|| self.made_of())
            .or_else(|| self.property())
            .or_else(|| self.leads())
            .or_else(|| self.joined())
            .or_else(|| self.side())
            .or_else(|| self.where_is())
            .or_else(|| self.occupied())
            .or_else(|| self.which_of_named())
            .or_else(|| self.which())
            .or_else(|| self.listed())
            .or_else(|| self.exists())
            .or_else(|| self.superlative())
            .or_else(|| self.everything())
            .or_else(|| self.holds())
    }

    /// What to say when no rule fits: the words that were understood, or nothing of it.
    fn not_understood(&self, items: &[Item]) -> Doubt {
        let about = self.first().map(|n| n.text);
        match about {
            Some(text) if items.len() <= 3 => Doubt::Incomplete { about: text },
            _ => {
                let all = 0..self.sentence.words.len();
                Doubt::not_understood(self.sentence.said(&all))
            }
        }
    }
}
