//! Cardinal numbers before a noun: «Два стула», «Пять полок», «21 дверь».

use super::grammar::{Case, Number};

/// A number in words with its forms.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Cardinal {
    /// Nominative, genitive, dative, instrumental, prepositional; the accusative of things is the nominative.
    forms: [&'static str; 5],
    /// The number in which the noun stands in the genitive after it: «два стула», «пять стульев».
    pub(crate) governs: Number,
}

/// What a numeral asks of the noun after it.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Counted {
    /// 1, 21, 101
    One,
    /// 2-4, 22-24
    Few,
    /// 0, 5-20, 25-30
    Many,
}

impl Counted {
    pub(crate) fn of(number: u64) -> Self {
        match (number % 10, number % 100) {
            (_, 11..=14) => Self::Many,
            (1, _) => Self::One,
            (2..=4, _) => Self::Few,
            _ => Self::Many,
        }
    }
}

const FEW: Number = Number::Singular;
const MANY: Number = Number::Plural;

const CARDINALS: [Cardinal; 15] = [
    of(["два", "двух", "двум", "двумя", "двух"], FEW),
    of(["две", "двух", "двум", "двумя", "двух"], FEW),
    of(["три", "трёх", "трём", "тремя", "трёх"], FEW),
    of(["четыре", "четырёх", "четырём", "четырьмя", "четырёх"], FEW),
    of(["оба", "обоих", "обоим", "обоими", "обоих"], FEW),
    of(["обе", "обеих", "обеим", "обеими", "обеих"], FEW),
    of(["полтора", "полутора", "полутора", "полутора", "полутора"], FEW),
    of(["полторы", "полутора", "полутора", "полутора", "полутора"], FEW),
    of(["пять", "пяти", "пяти", "пятью", "пяти"], MANY),
    of(["шесть", "шести", "шести", "шестью", "шести"], MANY),
    of(["семь", "семи", "семи", "семью", "семи"], MANY),
    of(["восемь", "восьми", "восьми", "восемью", "восьми"], MANY),
    of(["девять", "девяти", "девяти", "девятью", "девяти"], MANY),
    of(["десять", "десяти", "десяти", "десятью", "десяти"], MANY),
    of(["несколько", "нескольких", "нескольким", "несколькими", "нескольких"], MANY),
];

const fn of(forms: [&'static str; 5], governs: Number) -> Cardinal {
    Cardinal { forms, governs }
}

impl Cardinal {
    /// A number in the nominative, in lower case.
    pub(crate) fn read(word: &str) -> Option<Self> {
        CARDINALS.into_iter().find(|cardinal| cardinal.forms[0] == word)
    }

    pub(crate) fn form(&self, case: Case) -> &'static str {
        self.forms[match case {
            Case::Nominative | Case::Accusative => 0,
            Case::Genitive => 1,
            Case::Dative => 2,
            Case::Instrumental => 3,
            Case::Prepositional | Case::Locative => 4,
        }]
    }
}
