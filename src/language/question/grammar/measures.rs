//! Lengths and areas that a question gives: «выше полутора метров», "within 50 cm of the door", «больше 20 м²».
//!
//! Invariant: a number without a unit measures nothing.

use super::tokens::number_of;
use super::{Sentence, Tok, Token};
use crate::question::mark::Mark;
use crate::question::query::{Extreme, Rel, Sized};
use crate::question::vocabulary;
use crate::sets::{Set, set};
use crate::words::phrase_at;

/// Units of length in cm.
static UNITS: [(Set, f64); 4] = [
    (Set::named("Metres"), 100.0),
    (Set::named("Centimetres"), 1.0),
    (Set::named("HalfMetres"), 50.0),
    (Set::named("Millimetres"), 0.1),
];

/// Words before a length that bound how far something is; with it a relation.
static BOUNDS: Set = Set::named("Bounds");

impl Sentence<'_> {
    /// A measure with the words before it, as a relation or a size; the words that it takes.
    pub(super) fn measured(&mut self, at: usize) -> Option<usize> {
        let (taken, kind) = self.bounded(at).or_else(|| self.compared(at))?;
        let (from, to) = (at as u32, (at + taken) as u32);
        self.tokens.push(Token { from, to, kind });
        Some(taken)
    }

    /// «в пределах метра от», "less than 2 m from"
    fn bounded(&self, at: usize) -> Option<(usize, Tok)> {
        let longest = BOUNDS.iter().filter_map(|phrase| phrase_at(&self.keys, at, phrase));
        let before = longest.max().unwrap_or(0);
        let (measure, cm, square) = self.measure(at + before)?;
        let next = self.keys.get(at + before + measure)?;
        let anchored = set!("FromOrTo").contains(&next.as_str());
        (anchored && !square)
            .then(|| (before + measure + 1, Tok::Mark(Mark::Link(Rel::Within(cm.round() as u32)))))
    }

    /// «выше двух метров», "wider than 80 cm"
    fn compared(&self, at: usize) -> Option<(usize, Tok)> {
        let not = usize::from(set!("Not").contains(&self.keys[at].as_str()));
        let said = vocabulary::longest(self.keys.get(at + not..)?)?;
        let (word, Mark::More(extreme)) = said else { return None };
        let extreme = match extreme {
            Extreme::Most => Extreme::Biggest,
            Extreme::Fewest => Extreme::Smallest,
            other => other.of_size(),
        };
        // «Какие картины висят ниже метра?» asks how high they hang, not how high they are.
        let hangs = |key: &String| set!("HangStem").iter().any(|stem| key.starts_with(stem));
        let extreme = match extreme {
            Extreme::Tallest if self.keys.iter().any(hangs) => Extreme::Topmost,
            Extreme::Lowest if self.keys.iter().any(hangs) => Extreme::Bottommost,
            other => other,
        };
        let than = self
            .keys
            .get(at + not + word)
            .map_or(0, |key| usize::from(set!("Than").contains(&key.as_str())));
        let (measure, cm, square) = self.measure(at + not + word + than)?;
        let area = matches!(extreme, Extreme::Biggest | Extreme::Smallest);
        (area == square).then(|| {
            let size = Sized { extreme, than: cm.round() as u64, negated: not > 0 };
            (not + word + than + measure, Tok::Size(size))
        })
    }

    /// A number with its unit: the words it takes, how much in cm or cm², and whether it is an area.
    fn measure(&self, at: usize) -> Option<(usize, f64, bool)> {
        let key = |n: usize| self.keys.get(n).map(String::as_str);
        let (taken, number) = match key(at)? {
            "полутора" | "полтора" => (1, 1.5),
            "a" | "an" | "one" | "один" | "одного" | "одном" => (1, 1.0),
            first => match (number_of(first), key(at + 1).and_then(|k| k.parse::<u32>().ok())) {
                // «1,5 м» is two words with a mark between.
                (Some(whole), Some(_)) if self.is_decimal(at) => {
                    let tail = key(at + 1).unwrap_or_default();
                    (2, format!("{whole}.{tail}").parse().ok()?)
                }
                (Some(whole), _) => (1, whole as f64),
                (None, _) => (0, 1.0),
            },
        };
        let square = key(at + taken)
            .is_some_and(|k| k.starts_with("квадратн") || k == "кв" || k.starts_with("square"));
        let unit_at = at + taken + usize::from(square);
        let unit = key(unit_at)?;
        let powered = set!("SquareMetre").contains(&unit);
        let plain = if powered { "m" } else { unit };
        let (_, cm) = UNITS.iter().find(|(names, _)| names.has(plain))?;
        // «м» by itself may be a letter of a name.
        if taken == 0 && plain.chars().count() < 3 {
            return None;
        }
        let square = square || powered;
        let value = if square { number * cm * cm } else { number * cm };
        Some((unit_at + 1 - at, value, square))
    }

    fn is_decimal(&self, at: usize) -> bool {
        let gap = &self.text[self.words[at].end..self.words[at + 1].start];
        gap == "," || gap == "."
    }
}
