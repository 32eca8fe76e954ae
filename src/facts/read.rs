//! Reading words with nom: the words still to come, the failure that got furthest, lists and single words.

use std::cell::RefCell;

use nom::error::{ErrorKind, ParseError};
use nom::{Err, IResult, Parser};

use super::decimal::Decimal;
use super::fault::{RuleError, Told};
use super::lex::{Token, Word};
use super::syntax::{Expr, Name, Span};
use crate::units::{Bilingual, Language, said, told, word};

/// Failed attempts allowed for one item; brackets within brackets could otherwise be tried without end.
const MAX_ATTEMPTS: usize = 1_000_000;
const ATTEMPTS_PER_WORD: usize = 100;

/// What would have been read; put into words only where nothing else was read.
#[derive(Clone, Copy, PartialEq)]
pub(super) enum Due {
    Said(Told),
    Sign(&'static str),
}

impl From<Told> for Due {
    fn from(said: Told) -> Self {
        Self::Said(said)
    }
}

impl Due {
    fn say(self, language: Language) -> String {
        match self {
            Self::Said(said) => said.say(language).into_owned(),
            Self::Sign(sign) => Bilingual::quoted(sign).say(language).to_owned(),
        }
    }
}

/// The failure that got furthest into the text; what stopped a reader is named there.
#[derive(Default)]
pub(super) struct Furthest {
    /// Words left to read where it happened; none before the first failure.
    pub(super) left: Option<usize>,
    expected: Vec<Due>,
    fault: Option<RuleError>,
    attempts: usize,
}

impl Furthest {
    pub(super) fn describe(&self, words: &[Token], file: u32, end: usize) -> RuleError {
        if let Some(fault) = &self.fault {
            return fault.clone();
        }
        let end = Span { file, start: end as u32, end: end as u32 };
        let token = self.left.and_then(|left| words.get(words.len() - left));
        let found = token.map_or(said!("the-end-of-the-text"), |token| match &token.word {
            Word::Name(name) => Bilingual::quoted(name),
            Word::Number(number) | Word::Unsigned(number) => {
                said!("the-number", number)
            }
            Word::Line(line) => Bilingual::quoted(&format!("#{}", line.trim_end())),
            Word::Decimal(number) => {
                said!("the-number", number = Decimal::from_millionths(*number).to_string())
            }
            Word::Text(_) => said!("a-text-in-quotation-marks"),
            Word::Directive(word) => Bilingual::quoted(&format!(".{word}")),
            Word::Sign(sign) => Bilingual::quoted(sign),
        });
        let expected = match self.expected.as_slice() {
            [] => said!("a-rule-a-fact-or-a-declaration"),
            all => {
                let told = |language| {
                    let all: Vec<_> = all.iter().map(|due| due.say(language)).collect();
                    all.join(&told!(language, "or"))
                };
                Bilingual::both(told)
            }
        };
        RuleError::Syntax { expected, found, at: token.map_or(end, |token| token.at).into() }
    }
}

/// The words still to be read.
#[derive(Clone, Copy)]
pub(super) struct Input<'a> {
    pub(super) rest: &'a [Token],
    /// Of the whole text, in words.
    pub(super) length: usize,
    pub(super) furthest: &'a RefCell<Furthest>,
}

impl Input<'_> {
    pub(super) fn fail<T>(self, expected: impl Into<Due>) -> Result<T, Err<Failure>> {
        let expected = expected.into();
        let mut furthest = self.furthest.borrow_mut();
        let left = self.rest.len();
        furthest.attempts += 1;
        if furthest.left.is_none_or(|best| left < best) {
            furthest.left = Some(left);
            furthest.expected.clear();
            furthest.fault = None;
        }
        if furthest.left == Some(left) && !furthest.expected.contains(&expected) {
            furthest.expected.push(expected);
        }
        let limit = MAX_ATTEMPTS + self.length * ATTEMPTS_PER_WORD;
        if furthest.attempts > limit {
            drop(furthest);
            let (what, at) = (word!("attempts-to-read-one-rule"), self.at().into());
            return self.refuse(RuleError::TooLarge { what, limit, at });
        }
        Err(Err::Error(Failure))
    }

    /// A fault, unless another reading gets further.
    pub(super) fn doubt<T>(self, fault: RuleError) -> Result<T, Err<Failure>> {
        let failure = self.fail(word!("a-value"));
        let mut furthest = self.furthest.borrow_mut();
        if furthest.left == Some(self.rest.len()) {
            furthest.fault = Some(fault);
        }
        failure
    }

    /// A fault that no other reading can mend.
    pub(super) fn refuse<T>(self, fault: RuleError) -> Result<T, Err<Failure>> {
        let mut furthest = self.furthest.borrow_mut();
        furthest.left = Some(self.rest.len());
        furthest.fault = Some(fault);
        Err(Err::Failure(Failure))
    }

    pub(super) fn at(self) -> Span {
        self.rest.first().map(|token| token.at).unwrap_or_default()
    }
}

/// What went wrong stands in [`Furthest`].
#[derive(Debug)]
pub(super) struct Failure;

impl ParseError<Input<'_>> for Failure {
    fn from_error_kind(_: Input<'_>, _: ErrorKind) -> Self {
        Self
    }
    fn append(_: Input<'_>, _: ErrorKind, other: Self) -> Self {
        other
    }
}

pub(super) type Read<'a, T> = IResult<Input<'a>, T, Failure>;

pub(super) fn name(input: Input<'_>) -> Read<'_, Name> {
    match input.rest {
        [Token { word: Word::Name(text), at }, rest @ ..] => {
            Ok((Input { rest, ..input }, Name { text: text.clone(), at: *at }))
        }
        _ => input.fail(word!("a-name")),
    }
}

pub(super) fn number(input: Input<'_>) -> Read<'_, (i64, Span)> {
    match input.rest {
        [Token { word: Word::Number(value), at }, rest @ ..] => {
            Ok((Input { rest, ..input }, (*value, *at)))
        }
        _ => input.fail(word!("a-number")),
    }
}

pub(super) fn unsigned(input: Input<'_>) -> Read<'_, (i64, Span)> {
    match input.rest {
        [Token { word: Word::Unsigned(value), at }, rest @ ..] => {
            Ok((Input { rest, ..input }, (*value, *at)))
        }
        _ => input.fail(word!("a-number")),
    }
}

/// A name of one or more parts: `London.train.edge`.
pub(super) fn long_name(input: Input<'_>) -> Read<'_, Name> {
    let (mut input, mut whole) = name(input)?;
    while let [dot, Token { word: Word::Name(part), at }, rest @ ..] = input.rest {
        if dot.word != Word::Sign(".") || dot.at.start != whole.at.end || at.start != dot.at.end {
            break;
        }
        whole = Name { text: format!("{}.{part}", whole.text), at: whole.at.to(*at) };
        input = Input { rest, ..input };
    }
    Ok((input, whole))
}

/// In millionths.
pub(super) fn decimal(input: Input<'_>) -> Read<'_, (i64, Span)> {
    match input.rest {
        [Token { word: Word::Decimal(value), at }, rest @ ..] => {
            Ok((Input { rest, ..input }, (*value, *at)))
        }
        _ => input.fail(word!("a-number")),
    }
}

pub(super) fn text(input: Input<'_>) -> Read<'_, Expr> {
    let at = input.at();
    text_word.map(|value| Expr::Text(value, at)).parse(input)
}

pub(super) fn text_word(input: Input<'_>) -> Read<'_, String> {
    match input.rest {
        [Token { word: Word::Text(text), .. }, rest @ ..] => {
            Ok((Input { rest, ..input }, text.clone()))
        }
        _ => input.fail(word!("a-text-in-quotation-marks")),
    }
}

pub(super) fn sign<'a>(
    wanted: &'static str,
) -> impl Fn(Input<'a>) -> Read<'a, &'static str> + Copy {
    move |input| match input.rest {
        [Token { word: Word::Sign(found), .. }, rest @ ..] if *found == wanted => {
            Ok((Input { rest, ..input }, wanted))
        }
        _ => input.fail(quoted_sign(wanted)),
    }
}

/// The sign as a message names it.
fn quoted_sign(sign: &'static str) -> Due {
    match sign {
        "=" | "!=" | "<" | "<=" | ">" | ">=" => word!("a-comparison").into(),
        "+" | "-" | "*" | "/" | "%" | "^" => word!("an-operation").into(),
        other => Due::Sign(other),
    }
}

/// One or more, with the separator between them.
pub(super) fn list<'a, T, S>(
    element: impl Parser<Input<'a>, Output = T, Error = Failure>,
    separator: impl Parser<Input<'a>, Output = S, Error = Failure>,
) -> impl Parser<Input<'a>, Output = Vec<T>, Error = Failure> {
    let mut element = element;
    let mut separator = separator;
    move |input: Input<'a>| {
        let (mut input, first) = element.parse(input)?;
        let mut all = vec![first];
        loop {
            match separator.parse(input) {
                Ok((rest, _)) => {
                    let (rest, next) = element.parse(rest)?;
                    all.push(next);
                    input = rest;
                }
                Err(Err::Error(_)) => return Ok((input, all)),
                Err(failure) => return Err(failure),
            }
        }
    }
}

/// As many as there are.
pub(super) fn many<'a, T>(
    element: impl Fn(Input<'a>) -> Read<'a, T>,
) -> impl Fn(Input<'a>) -> Read<'a, Vec<T>> {
    move |mut input| {
        let mut all = Vec::new();
        loop {
            match element(input) {
                Ok((rest, next)) => {
                    all.push(next);
                    input = rest;
                }
                Err(Err::Error(_)) => return Ok((input, all)),
                Err(failure) => return Err(failure),
            }
        }
    }
}
