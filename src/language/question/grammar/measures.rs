//! Lengths and areas that a question gives: «выше полутора метров», "within 50 cm of the door", «больше 20 м²».
//!
//! Invariant: a number without a unit measures nothing.

use super::tokens::number_of;
use super::{Sentence, Tok, Token};
use crate::question::mark::Mark;
use crate::question::query::{Extreme, Rel, Sized};
use crate::question::vocabulary;
use crate::words::phrase_at;

/// Units of length in cm.
const UNITS: [(&str, f64); 4] = [
    ("метр|метра|метре|метров|метрах|м|metre|metres|meter|meters|m", 100.0),
    (
        "сантиметр|сантиметра|сантиметров|сантиметрах|см|centimetre|centimetres|centimeter|centimeters|cm",
        1.0,
    ),
    ("полметра|полуметра|полуметре", 50.0),
    ("миллиметр|миллиметра|миллиметров|мм|millimetre|millimetres|millimeter|millimeters|mm", 0.1),
];

/// Words before a length that bound how far something is; with it a relation.
const BOUNDS: &[&str] = &[
    "в пределах",
    "не дальше",
    "не дальше чем в",
    "не далее",
    "не далее чем в",
    "на расстоянии",
    "на расстоянии до",
    "на расстоянии не более",
    "на расстоянии меньше",
    "на расстоянии менее",
    "в радиусе",
    "ближе",
    "ближе чем в",
    "ближе чем на",
    "менее чем в",
    "меньше чем в",
    "в",
    "within",
    "within a radius of",
    "less than",
    "no more than",
    "not more than",
    "no farther than",
    "no further than",
    "closer than",
    "nearer than",
    "in",
    "at most",
];

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
        let anchored = ["от", "к", "from", "of", "to"].contains(&next.as_str());
        (anchored && !square)
            .then(|| (before + measure + 1, Tok::Mark(Mark::Link(Rel::Within(cm.round() as u32)))))
    }

    /// «выше двух метров», "wider than 80 cm"
    fn compared(&self, at: usize) -> Option<(usize, Tok)> {
        let not = usize::from(["не", "not"].contains(&self.keys[at].as_str()));
        let said = vocabulary::longest(self.keys.get(at + not..)?)?;
        let (word, Mark::More(extreme)) = said else { return None };
        let extreme = match extreme {
            Extreme::Most => Extreme::Biggest,
            Extreme::Fewest => Extreme::Smallest,
            other => other.of_size(),
        };
        // «Какие картины висят ниже метра?» asks how high they hang, not how high they are.
        let hangs = |key: &String| ["вис", "hang", "hung"].iter().any(|stem| key.starts_with(stem));
        let extreme = match extreme {
            Extreme::Tallest if self.keys.iter().any(hangs) => Extreme::Topmost,
            Extreme::Lowest if self.keys.iter().any(hangs) => Extreme::Bottommost,
            other => other,
        };
        let than = self
            .keys
            .get(at + not + word)
            .map_or(0, |key| usize::from(["чем", "than"].contains(&key.as_str())));
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
        let powered = ["м2", "м²", "m2", "m²"].contains(&unit);
        let plain = if powered { "m" } else { unit };
        let (_, cm) = UNITS.iter().find(|(names, _)| names.split('|').any(|name| name == plain))?;
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
