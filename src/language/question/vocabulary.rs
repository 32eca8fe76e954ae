//! The words of questions in both languages, and what each does in a sentence.

use std::collections::HashMap;
use std::sync::OnceLock;

use super::mark::{Mark, Pronoun};
use super::query::{Closeness, Courtesy, Dimension, Extreme, Rel};
use super::uses;
use crate::report::Detail;
use crate::units::{Carried, InOrder as _, carried, name_key};
use crate::words::things;

static TEXT: Carried = carried!("marks.txt");

/// Every mark that words may have; in the file they go by their names here.
const MARKS: &[Mark] = &[
    Mark::Where,
    Mark::What,
    Mark::Anything,
    Mark::Kinds,
    Mark::Hang,
    Mark::Opens,
    Mark::Whither,
    Mark::How,
    Mark::Move,
    Mark::As,
    Mark::Which,
    Mark::HowMany,
    Mark::Count,
    Mark::Side,
    Mark::HowFar,
    Mark::HowLong,
    Mark::HowGet,
    Mark::When,
    Mark::Why,
    Mark::WhyNot,
    Mark::Who,
    Mark::HowBig(Dimension::All),
    Mark::HowBig(Dimension::Elevation),
    Mark::HowBig(Dimension::Height),
    Mark::HowBig(Dimension::Width),
    Mark::HowBig(Dimension::Length),
    Mark::HowBig(Dimension::Area),
    Mark::HowBig(Dimension::Sides),
    Mark::Exists,
    Mark::Be,
    Mark::Have,
    Mark::Lead,
    Mark::Parts,
    Mark::MadeOf,
    Mark::Describe,
    Mark::List,
    Mark::See,
    Mark::LastSeen,
    Mark::Last,
    Mark::Before,
    Mark::Free,
    Mark::Sit,
    Mark::LieDown,
    Mark::PutDown,
    Mark::Can,
    Mark::Hold,
    Mark::Take,
    Mark::You,
    Mark::Me,
    Mark::Not,
    Mark::Avoiding,
    Mark::Unopened,
    Mark::MustOpen,
    Mark::Must,
    Mark::Cannot,
    Mark::Differ,
    Mark::Alike,
    Mark::Without,
    Mark::Directly,
    Mark::OccupiedBy,
    Mark::Took,
    Mark::Moved,
    Mark::OnlyOne,
    Mark::And,
    Mark::Or,
    Mark::ThanTo,
    Mark::Than,
    Mark::All,
    Mark::Each,
    Mark::Except,
    Mark::Other,
    Mark::Link(Rel::In),
    Mark::Link(Rel::On),
    Mark::Link(Rel::Under),
    Mark::Link(Rel::Above),
    Mark::Link(Rel::NextTo),
    Mark::Link(Rel::Near),
    Mark::Link(Rel::LeftOf),
    Mark::Link(Rel::RightOf),
    Mark::Link(Rel::Behind),
    Mark::Link(Rel::InFrontOf),
    Mark::Link(Rel::Between),
    Mark::Link(Rel::Facing),
    Mark::Link(Rel::Middle),
    Mark::Link(Rel::Leaning),
    Mark::FacingIt,
    Mark::Link(Rel::Has),
    Mark::Link(Rel::Outside),
    Mark::Link(Rel::From),
    Mark::Link(Rel::To),
    Mark::Link(Rel::Through),
    Mark::Link(Rel::At),
    Mark::Link(Rel::Of),
    Mark::Nearer(Closeness::Nearer),
    Mark::Nearer(Closeness::Farther),
    Mark::Best(Extreme::Nearest),
    Mark::Best(Extreme::Farthest),
    Mark::BestTo(Extreme::Nearest),
    Mark::BestTo(Extreme::Farthest),
    Mark::Best(Extreme::Biggest),
    Mark::Best(Extreme::Smallest),
    Mark::Best(Extreme::Tallest),
    Mark::Best(Extreme::Lowest),
    Mark::Best(Extreme::Topmost),
    Mark::Best(Extreme::Bottommost),
    Mark::Best(Extreme::Midmost),
    Mark::CountedFrom(Extreme::Topmost),
    Mark::CountedFrom(Extreme::Bottommost),
    Mark::CountedFrom(Extreme::LeftMost),
    Mark::CountedFrom(Extreme::RightMost),
    Mark::Best(Extreme::Thickest),
    Mark::Best(Extreme::Thinnest),
    Mark::More(Extreme::Thickest),
    Mark::More(Extreme::Thinnest),
    Mark::Best(Extreme::Widest),
    Mark::Best(Extreme::Narrowest),
    Mark::Best(Extreme::Longest),
    Mark::Best(Extreme::Shortest),
    Mark::Best(Extreme::LeftMost),
    Mark::Best(Extreme::RightMost),
    Mark::Best(Extreme::Most),
    Mark::Best(Extreme::Fewest),
    Mark::More(Extreme::Most),
    Mark::More(Extreme::Fewest),
    Mark::Grade(Extreme::Biggest),
    Mark::Grade(Extreme::Smallest),
    Mark::Grade(Extreme::Tallest),
    Mark::Grade(Extreme::Lowest),
    Mark::Grade(Extreme::Longest),
    Mark::Grade(Extreme::Shortest),
    Mark::Rank(1),
    Mark::Rank(2),
    Mark::Rank(3),
    Mark::Rank(4),
    Mark::Rank(5),
    Mark::Help,
    Mark::Did,
    Mark::Changed,
    Mark::Unseen,
    Mark::Sureness,
    Mark::Heading,
    Mark::Detail(Detail::Region),
    Mark::Detail(Detail::Heading),
    Mark::More(Extreme::LeftMost),
    Mark::More(Extreme::RightMost),
    Mark::More(Extreme::Heaviest),
    Mark::More(Extreme::Lightest),
    Mark::Best(Extreme::Heaviest),
    Mark::Best(Extreme::Lightest),
    Mark::More(Extreme::Biggest),
    Mark::More(Extreme::Smallest),
    Mark::More(Extreme::Tallest),
    Mark::More(Extreme::Lowest),
    Mark::More(Extreme::Topmost),
    Mark::More(Extreme::Bottommost),
    Mark::More(Extreme::Shortest),
    Mark::More(Extreme::Widest),
    Mark::More(Extreme::Narrowest),
    Mark::More(Extreme::Longest),
    Mark::Same,
    Mark::Pronoun(Pronoun::He),
    Mark::Pronoun(Pronoun::HimOrIt),
    Mark::Pronoun(Pronoun::She),
    Mark::Pronoun(Pronoun::Her),
    Mark::Pronoun(Pronoun::It),
    Mark::Pronoun(Pronoun::They),
    Mark::Pronoun(Pronoun::Any),
    Mark::There,
    Mark::One,
    Mark::A,
    Mark::The,
    Mark::These,
    Mark::Listed,
    Mark::Total,
    Mark::Now,
    Mark::Everywhere,
    Mark::Polite(Courtesy::Greeting),
    Mark::Polite(Courtesy::Thanks),
    Mark::Polite(Courtesy::Farewell),
    Mark::Polite(Courtesy::HowAreYou),
    Mark::Polite(Courtesy::Assent),
    Mark::BesidePolite,
    Mark::Sound,
    Mark::Interjection,
    Mark::Limits,
    Mark::WhoIsRight,
    Mark::Called,
    Mark::Hesitates,
    Mark::Particle,
    Mark::Corrects,
    Mark::But,
    Mark::Filler,
];

type Phrases = Vec<(Vec<String>, Mark)>;

fn table() -> &'static HashMap<String, Phrases> {
    static TABLE: OnceLock<HashMap<String, Phrases>> = OnceLock::new();
    TABLE.get_or_init(|| {
        let mut table = by_first_word(|mark| !is_apart(mark));
        for phrases in table.values_mut() {
            phrases.order_by_key(|(words, _)| std::cmp::Reverse(words.len()));
        }
        table
    })
}

/// The phrases of such marks, by their first words.
fn by_first_word(of: impl Fn(Mark) -> bool) -> HashMap<String, Phrases> {
    let mut table: HashMap<String, Phrases> = HashMap::new();
    for (mark, phrase) in phrases().into_iter().filter(|(mark, _)| of(*mark)) {
        let words: Vec<String> = phrase.split_whitespace().map(name_key).collect();
        table.entry(words[0].clone()).or_default().push((words, mark));
    }
    table
}

/// The phrases of the file, each with its mark.
fn phrases() -> Vec<(Mark, String)> {
    let names: HashMap<String, Mark> = MARKS.iter().map(|m| (format!("{m:?}"), *m)).collect();
    let mut found = Vec::new();
    for entry in things::entries(&TEXT) {
        // A test reads every line.
        let Some((name, words)) = entry.split_once(" : ") else { continue };
        let Some(mark) = names.get(name) else { continue };
        found.extend(things::words(words).into_iter().map(|phrase| (*mark, phrase)));
    }
    found
}

/// The mark of the longest phrase at the beginning of these words (in [`name_key`] form), with the number of words it
/// takes. Where a phrase is listed twice, the first list wins, and all go before an activity's.
pub(super) fn longest(words: &[String]) -> Option<(usize, Mark)> {
    let fits = |phrase: &[String]| words.get(..phrase.len()) == Some(phrase);
    let listed = table().get(words.first()?).and_then(|phrases| {
        let phrase = phrases.iter().find(|(phrase, _)| fits(phrase));
        phrase.map(|(phrase, mark)| (phrase.len(), *mark))
    });
    let activity = uses::longest(words).map(|(taken, activity)| (taken, Mark::Activity(activity)));
    match (listed, activity) {
        (Some(listed), Some(activity)) if activity.0 > listed.0 => Some(activity),
        (listed, activity) => listed.or(activity),
    }
}

/// What words that commas part from a line do in it: how somebody is spoken to ("my dear"), that one is about to ask ("ok
/// wait"), or nothing («ну короче»). Small words may stand before, and particles one after the other.
pub(super) fn parted(words: &[String]) -> Option<Mark> {
    static PARTED: OnceLock<HashMap<String, Mark>> = OnceLock::new();
    let parted = PARTED.get_or_init(|| {
        let own = phrases().into_iter().filter(|(mark, _)| is_parted(*mark));
        own.map(|(mark, phrase)| (name_key(&phrase), mark)).collect()
    });
    let small = |word: &&String| {
        let said = longest(std::slice::from_ref(*word));
        matches!(said, Some((1, Mark::The | Mark::You | Mark::Filler)))
    };
    let before = words.iter().take_while(small).count();
    let keys = |from: usize| words.get(from..).unwrap_or_default().join(" ");
    (0..=before).find_map(|from| parted.get(&keys(from)).copied()).or_else(|| {
        let particle = |said: &[String]| {
            let mark = parted.get(&said.join(" ")).copied();
            mark.filter(|mark| matches!(mark, Mark::Particle | Mark::Corrects))
        };
        let (mut at, mut all) = (0, None);
        while at < words.len() {
            let own =
                (at + 1..=words.len()).rev().find_map(|to| Some((to, particle(&words[at..to])?)));
            let (to, mark) = own.or_else(|| {
                let (taken, mark) = longest(&words[at..])?;
                (mark == Mark::Filler).then_some((at + taken, mark))
            })?;
            if mark != Mark::Filler && all != Some(Mark::Corrects) {
                all = Some(mark);
            }
            at = to;
        }
        all
    })
}

/// How many of these words, at their beginning, are a phrase of a mark whose words are looked for by themselves.
pub(super) fn taken_by(mark: Mark, words: &[String]) -> Option<usize> {
    begun(words, |own| own == mark).map(|(taken, _)| taken)
}

/// The longest phrase of such marks at the beginning of these words.
pub(super) fn begun(words: &[String], of: impl Fn(Mark) -> bool) -> Option<(usize, Mark)> {
    static BOUNDS: OnceLock<HashMap<String, Phrases>> = OnceLock::new();
    let bounds = BOUNDS.get_or_init(|| by_first_word(is_bound));
    let own = bounds.get(words.first()?)?.iter().filter(|(_, own)| of(*own));
    let begin = own.filter(|(phrase, _)| words.starts_with(phrase));
    begin.map(|(phrase, mark)| (phrase.len(), *mark)).max_by_key(|(taken, _)| *taken)
}

/// Other marks have the same words where a sentence is read word by word.
fn is_bound(mark: Mark) -> bool {
    matches!(
        mark,
        Mark::These
            | Mark::Listed
            | Mark::Total
            | Mark::Now
            | Mark::Everywhere
            | Mark::Polite(_)
            | Mark::BesidePolite
            | Mark::Sound
            | Mark::Interjection
            | Mark::Limits
            | Mark::WhoIsRight
    )
}

fn is_apart(mark: Mark) -> bool {
    is_parted(mark) || is_bound(mark)
}

/// Within a sentence "honey" is a thing, "wait" an order, and «короче» compares.
fn is_parted(mark: Mark) -> bool {
    matches!(mark, Mark::Called | Mark::Hesitates | Mark::Particle | Mark::Corrects)
}

/// Whether a word is in any phrase of the vocabulary: it is a word, whatever it does there.
pub(super) fn is_in_a_phrase(key: &str) -> bool {
    table().values().flatten().any(|(phrase, _)| phrase.iter().any(|word| word == key))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_line_is_of_a_mark_and_every_mark_has_words() {
        let phrases = phrases();
        for mark in MARKS {
            assert!(phrases.iter().any(|(own, _)| own == mark), "{mark:?}");
        }
        for entry in things::entries(&TEXT) {
            let name = entry.split(" : ").next().unwrap_or_default();
            assert!(MARKS.iter().any(|mark| format!("{mark:?}") == name), "{entry}");
        }
    }

    #[test]
    fn the_longest_phrase_wins() {
        let check = |text: &str, expected: Option<(usize, Mark)>| {
            let words: Vec<String> = text.split_whitespace().map(name_key).collect();
            assert_eq!(longest(&words), expected, "{text}");
        };
        check("на каком расстоянии", Some((3, Mark::HowFar)));
        check("to the left of the table", Some((4, Mark::Link(Rel::LeftOf))));
        check("почему нет", Some((2, Mark::WhyNot)));
        check("ёлка", None);
    }
}
