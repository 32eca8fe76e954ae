//! The words of questions in both languages, and what each does in a sentence.

use std::collections::{BTreeSet, HashMap};
use std::sync::OnceLock;

use super::mark::{Mark, Pronoun};
use super::query::{Closeness, Courtesy, Dimension, Extreme, Rel};
use super::uses;
use crate::report::Detail;
use crate::units::{Carried, InOrder as _, carried, name_key};
use crate::words::things;

static TEXT: Carried = carried!("marks.txt");

macro_rules! marks {
    ($($plain:ident)+; Rank: $($rank:literal)+; $($mark:ident($of:ident): $($one:ident)+;)+) => {
        &[
            $(Mark::$plain,)+
            $(Mark::Rank($rank),)+
            $($(Mark::$mark($of::$one),)+)+
        ]
    };
}

/// Every mark that words may have; in the file they go by their names here.
const MARKS: &[Mark] = marks![
    Where What Anything Kinds Hang Opens Whither Whence How Move As Which HowMany Count Side HowFar
    HowLong HowGet When Why WhyNot Who Exists Be Have Lead Parts MadeOf Describe List See LastSeen
    Last Before Free Sit LieDown PutDown Can Hold Take You Me Not Avoiding Unopened MustOpen Must
    Cannot Differ Alike Without Directly OccupiedBy Took Moved OnlyOne And Or ThanTo Than All Each
    Except Other FacingIt Help Did Changed Unseen Sureness Heading Same There One A The These Listed
    Total Now Everywhere BesidePolite Sound Interjection Limits WhoIsRight Called Hesitates Particle
    Corrects But Filler;
    Rank: 1 2 3 4 5;
    HowBig(Dimension): All Elevation Height Width Length Area Sides;
    Link(Rel): In On Under Above NextTo Near LeftOf RightOf Behind InFrontOf Between Facing Middle
        Leaning Has Outside From To Through At Of;
    Nearer(Closeness): Nearer Farther;
    Best(Extreme): Nearest Farthest Biggest Smallest Tallest Lowest Topmost Bottommost Midmost
        Thickest Thinnest Widest Narrowest Longest Shortest LeftMost RightMost Most Fewest Heaviest
        Lightest;
    BestTo(Extreme): Nearest Farthest;
    CountedFrom(Extreme): Topmost Bottommost LeftMost RightMost;
    More(Extreme): Thickest Thinnest Most Fewest LeftMost RightMost Heaviest Lightest Biggest
        Smallest Tallest Lowest Topmost Bottommost Shortest Widest Narrowest Longest;
    Grade(Extreme): Biggest Smallest Tallest Lowest Longest Shortest;
    Detail(Detail): Region Heading;
    Pronoun(Pronoun): He HimOrIt She Her It They Any;
    Polite(Courtesy): Greeting Thanks Farewell HowAreYou Assent;
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

/// The words of the vocabulary's phrases that are a slip of the pen away from a word, in order.
pub(super) fn near(key: &str) -> Vec<&'static str> {
    let length = key.chars().count();
    let is_slip = |word: &&str| {
        word.chars().count().abs_diff(length) < 2 && strsim::damerau_levenshtein(key, word) == 1
    };
    let words = table().values().flatten().flat_map(|(phrase, _)| phrase);
    let near: BTreeSet<&str> = words.map(String::as_str).filter(is_slip).collect();
    // Letters that changed places are the likeliest slip: "mnay" is "many" rather than "may".
    let letters = |word: &str| {
        let mut letters: Vec<char> = word.chars().collect();
        letters.sort_unstable();
        letters
    };
    let typed = letters(key);
    let exchanged: Vec<&str> = near.iter().copied().filter(|word| letters(word) == typed).collect();
    if exchanged.is_empty() { near.into_iter().collect() } else { exchanged }
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
