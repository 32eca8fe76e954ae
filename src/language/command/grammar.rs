//! The grammar of commands: tokens to items, items to clauses. It knows words, not yet what they refer to.
//!
//! ```text
//! sentence = item*
//! item     = verb | "на ключ" | "и" | "не" | filler | argument
//! argument = link? filler* (name | pronoun | me | unknown+ name?)
//! ```
//! A name is the longest run of words that the index knows in any form; it wins over a vocabulary word only where it
//! is longer, so that «Кресло у окна» is one name and «у окна» a link and a name.

use std::hash::Hash;
use std::iter::Enumerate;
use std::ops::Range;

use nom::branch::alt;
use nom::combinator::{map, opt, verify};
use nom::error::ErrorKind;
use nom::multi::{many0, many1};
use nom::{IResult, Input, Needed, Parser};

use super::vocabulary::{Haunt, Link, Meaning, Verb, longest};
use crate::units::name_key;
use crate::words::{FormIndex, Hit, is_hyphen, word_ranges};

/// A sentence cut into words: their places in the text and their keys.
pub(super) struct Sentence<'t> {
    pub(super) text: &'t str,
    pub(super) words: Vec<Range<usize>>,
    keys: Vec<String>,
}

impl<'t> Sentence<'t> {
    pub(super) fn new(text: &'t str) -> Self {
        let words = word_ranges(text);
        let keys = words.iter().map(|range| name_key(&text[range.clone()])).collect();
        Self { text, words, keys }
    }

    /// The text from one word to another.
    pub(super) fn span(&self, words: &Range<usize>) -> Range<usize> {
        match (
            self.words.get(words.start),
            words.end.checked_sub(1).and_then(|last| self.words.get(last)),
        ) {
            (Some(first), Some(last)) => first.start..last.end,
            _ => self.text.len()..self.text.len(),
        }
    }
}

/// The words of a sentence that are still to be read; the input of the parsers.
#[derive(Debug)]
pub(super) struct Words<'s, 't, T> {
    sentence: &'s Sentence<'t>,
    index: &'s FormIndex<T>,
    at: usize,
    end: usize,
}

impl std::fmt::Debug for Sentence<'_> {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(self.text)
    }
}

impl<T> Clone for Words<'_, '_, T> {
    fn clone(&self) -> Self {
        Self { ..*self }
    }
}

impl<T> Words<'_, '_, T> {
    fn between(&self, at: usize, end: usize) -> Self {
        Self { at, end, ..*self }
    }
}

impl<'s, T> Input for Words<'s, '_, T> {
    type Item = &'s str;
    type Iter = std::iter::Map<std::slice::Iter<'s, String>, fn(&'s String) -> &'s str>;
    type IterIndices = Enumerate<Self::Iter>;

    fn input_len(&self) -> usize {
        self.end - self.at
    }

    fn take(&self, index: usize) -> Self {
        self.between(self.at, self.at + index)
    }

    fn take_from(&self, index: usize) -> Self {
        self.between(self.at + index, self.end)
    }

    fn take_split(&self, index: usize) -> (Self, Self) {
        (self.take_from(index), self.take(index))
    }

    fn position<P: Fn(Self::Item) -> bool>(&self, predicate: P) -> Option<usize> {
        self.iter_elements().position(predicate)
    }

    fn iter_elements(&self) -> Self::Iter {
        self.sentence.keys[self.at..self.end]
            .iter()
            .map(String::as_str as fn(&'s String) -> &'s str)
    }

    fn iter_indices(&self) -> Self::IterIndices {
        self.iter_elements().enumerate()
    }

    fn slice_index(&self, count: usize) -> Result<usize, Needed> {
        if count <= self.input_len() {
            Ok(count)
        } else {
            Err(Needed::new(count - self.input_len()))
        }
    }
}

/// What an argument refers to, as far as words tell. Ranges count words.
#[derive(Debug, Clone)]
pub(super) enum Reference<'s, T> {
    Known(Vec<Hit<'s, T>>),
    /// Words that no name has; with the name after them, if there is one: «красную» before «чашку».
    Unknown,
    Me,
    Pronoun,
    Them,
    /// «всё», without a name.
    Everything,
}

#[derive(Debug, Clone)]
pub(super) struct Argument<'s, T> {
    pub(super) link: Option<Link>,
    pub(super) reference: Reference<'s, T>,
    /// The words of the reference, without the link.
    pub(super) words: Range<usize>,
    /// «все»: all that the name may mean.
    pub(super) all: bool,
}

#[derive(Debug, Clone)]
pub(super) enum Item<'s, T> {
    Verb(Verb, Range<usize>),
    Argument(Argument<'s, T>),
    /// A link with nothing after it.
    Dangling(Range<usize>),
    WithKey,
    OnFloor,
    FacingWall,
    Haunt(Haunt),
    And,
    Not(Range<usize>),
    Filler,
}

type Parsed<'s, 't, T, O> = IResult<Words<'s, 't, T>, O>;

/// Reads the whole sentence. Every word is read as something, so nothing is left over.
pub(super) fn items<'s, 't, T: Clone + Eq + Hash>(
    sentence: &'s Sentence<'t>,
    index: &'s FormIndex<T>,
) -> Vec<Item<'s, T>> {
    let words = Words { sentence, index, at: 0, end: sentence.words.len() };
    many0(item).parse(words).map_or_else(|_| Vec::new(), |(_, items)| items)
}

fn item<'s, 't, T: Clone + Eq + Hash>(input: Words<'s, 't, T>) -> Parsed<'s, 't, T, Item<'s, T>> {
    alt((control, argument, dangling)).parse(input)
}

/// A word of the vocabulary and the words it takes, unless a longer name begins here.
fn meaning<'s, 't, T: Clone + Eq + Hash>(
    input: Words<'s, 't, T>,
) -> Parsed<'s, 't, T, (Meaning, Range<usize>)> {
    let named = name_length(&input);
    let mut found = longest(&input.iter_elements());
    // «к Зарядке robot2_charger» is one of the chargers by its name, and only its preposition a word of the vocabulary.
    if let Some((taken, Meaning::Haunt(_))) = found
        && (1..taken).any(|n| name_length(&input.take_from(n)) > taken - n)
    {
        found = longest(&input.iter_elements().take(1));
    }
    match found {
        Some((taken, meaning)) if taken >= named => {
            let words = input.at..input.at + taken;
            Ok((input.take_from(taken), (meaning, words)))
        }
        _ => Err(nom::Err::Error(nom::error::Error::new(input, ErrorKind::Tag))),
    }
}

fn name_length<T: Clone + Eq + Hash>(input: &Words<'_, '_, T>) -> usize {
    input.index.length_at(input.sentence.text, &input.sentence.words[..input.end], input.at)
}

fn control<'s, 't, T: Clone + Eq + Hash>(
    input: Words<'s, 't, T>,
) -> Parsed<'s, 't, T, Item<'s, T>> {
    let (rest, (meaning, words)) = meaning(input.clone())?;
    let item = match meaning {
        Meaning::Verb(verb) => Item::Verb(verb, words),
        Meaning::WithKey => Item::WithKey,
        Meaning::OnFloor => Item::OnFloor,
        Meaning::FacingWall => Item::FacingWall,
        Meaning::Haunt(haunt) => Item::Haunt(haunt),
        Meaning::And => Item::And,
        Meaning::Not => Item::Not(words),
        Meaning::Filler => Item::Filler,
        Meaning::All | Meaning::Link(_) | Meaning::Me | Meaning::Pronoun | Meaning::Them => {
            return Err(nom::Err::Error(nom::error::Error::new(input, ErrorKind::Alt)));
        }
    };
    Ok((rest, item))
}

/// What may stand between a link and its name: articles, «этот», «все».
fn determiner<'s, 't, T: Clone + Eq + Hash>(input: Words<'s, 't, T>) -> Parsed<'s, 't, T, Meaning> {
    let is_determiner =
        |(meaning, _): &(Meaning, Range<usize>)| matches!(meaning, Meaning::Filler | Meaning::All);
    map(verify(meaning, is_determiner), |(meaning, _)| meaning).parse(input)
}

fn link<'s, 't, T: Clone + Eq + Hash>(
    input: Words<'s, 't, T>,
) -> Parsed<'s, 't, T, (Link, Range<usize>)> {
    let (rest, (meaning, words)) = meaning(input.clone())?;
    match meaning {
        Meaning::Link(link) => Ok((rest, (link, words))),
        _ => Err(nom::Err::Error(nom::error::Error::new(input, ErrorKind::Tag))),
    }
}

fn argument<'s, 't, T: Clone + Eq + Hash>(
    input: Words<'s, 't, T>,
) -> Parsed<'s, 't, T, Item<'s, T>> {
    let (rest, link) = opt(link).parse(input)?;
    let (rest, determiners) = many0(determiner).parse(rest)?;
    let from = rest.at;
    let all = determiners.contains(&Meaning::All);
    let named = alt((personal, mistagged, postposed, known, unknown)).parse(rest.clone());
    let (rest, reference) = match named {
        Err(_) if all => (rest, Reference::Everything),
        named => named?,
    };
    let from = from.min(rest.at.saturating_sub(1));
    let (link, words) = (link.map(|(link, _)| link), from..rest.at);
    Ok((rest, Item::Argument(Argument { link, reference, words, all })))
}

fn dangling<'s, 't, T: Clone + Eq + Hash>(
    input: Words<'s, 't, T>,
) -> Parsed<'s, 't, T, Item<'s, T>> {
    map(link, |(_, words)| Item::Dangling(words)).parse(input)
}

fn personal<'s, 't, T: Clone + Eq + Hash>(
    input: Words<'s, 't, T>,
) -> Parsed<'s, 't, T, Reference<'s, T>> {
    let (rest, (meaning, _)) = meaning(input.clone())?;
    match meaning {
        Meaning::Me => Ok((rest, Reference::Me)),
        Meaning::Pronoun => Ok((rest, Reference::Pronoun)),
        Meaning::Them => Ok((rest, Reference::Them)),
        _ => Err(nom::Err::Error(nom::error::Error::new(input, ErrorKind::Tag))),
    }
}

fn known<'s, 't, T: Clone + Eq + Hash>(
    input: Words<'s, 't, T>,
) -> Parsed<'s, 't, T, Reference<'s, T>> {
    let words = &input.sentence.words[..input.end];
    match input.index.longest_at(input.sentence.text, words, input.at) {
        Some((taken, hits)) => Ok((input.take_from(taken), Reference::Known(hits))),
        None => Err(nom::Err::Error(nom::error::Error::new(input, ErrorKind::Tag))),
    }
}

/// A name with a tag that no name has: «Комнату-X» is none of the rooms, though «комнату» would be some.
fn mistagged<'s, 't, T: Clone + Eq + Hash>(
    input: Words<'s, 't, T>,
) -> Parsed<'s, 't, T, Reference<'s, T>> {
    let sentence = input.sentence;
    let (rest, _) = known(input.clone())?;
    let (rest, tags) = many1(unknown_word).parse(rest)?;
    let first = rest.at - tags.len();
    let between = &sentence.text[sentence.words[first - 1].end..sentence.words[first].start];
    let word = &sentence.text[sentence.words[first].clone()];
    let tag = word.chars().count() < 4 && word.chars().all(|c| c.is_uppercase() || c.is_numeric());
    if tag || word.chars().count() < 3 || between.chars().all(is_hyphen) {
        Ok((input.take_from(first + 1 - input.at), Reference::Unknown))
    } else {
        Err(nom::Err::Error(nom::error::Error::new(input, ErrorKind::Verify)))
    }
}

/// An adjective after its noun: «чашку красную» is «красную чашку».
fn postposed<'s, 't, T: Clone + Eq + Hash>(
    input: Words<'s, 't, T>,
) -> Parsed<'s, 't, T, Reference<'s, T>> {
    let (rest, _) = known(input.clone())?;
    let noun = input.sentence.span(&(input.at..rest.at));
    let (rest, adjectives) = many1(unknown_word).parse(rest)?;
    let adjective = input.sentence.span(&(rest.at - adjectives.len()..rest.at));
    let text = input.sentence.text;
    let hits = input.index.find(&format!("{} {}", &text[adjective], &text[noun]));
    match hits.is_empty() {
        false => Ok((rest, Reference::Known(hits))),
        true => Err(nom::Err::Error(nom::error::Error::new(input, ErrorKind::Verify))),
    }
}

/// Words that are neither in the vocabulary nor the beginning of a name, and the name that they stand before.
fn unknown<'s, 't, T: Clone + Eq + Hash>(
    input: Words<'s, 't, T>,
) -> Parsed<'s, 't, T, Reference<'s, T>> {
    let (rest, _) = many1(unknown_word).parse(input)?;
    let (rest, _) = opt(known).parse(rest)?;
    Ok((rest, Reference::Unknown))
}

fn unknown_word<'s, 't, T: Clone + Eq + Hash>(input: Words<'s, 't, T>) -> Parsed<'s, 't, T, ()> {
    if input.input_len() == 0
        || longest(&input.iter_elements()).is_some()
        || name_length(&input) > 0
    {
        return Err(nom::Err::Error(nom::error::Error::new(input, ErrorKind::Tag)));
    }
    Ok((input.take_from(1), ()))
}
