//! Bracketed lists of words, in which PDDL and plans are written.

use miette::SourceSpan;
use nom::branch::alt;
use nom::bytes::complete::{tag, take_till, take_while1};
use nom::character::complete::multispace1;
use nom::combinator::recognize;
use nom::multi::many0_count;
use nom::sequence::preceded;
use nom::{IResult, Parser};

use super::error::RuleError;
use super::fault::RuleFault;
use crate::units::{Bilingual, Source};

/// No file of a person nests deeper.
const MAX_DEPTH: usize = 200;

/// A word or a bracketed list.
#[derive(Debug)]
pub(super) enum Expression<'a> {
    Word(&'a str, SourceSpan),
    List(Vec<Self>, SourceSpan),
}

impl<'a> Expression<'a> {
    pub(super) fn span(&self) -> SourceSpan {
        match self {
            Self::Word(_, span) | Self::List(_, span) => *span,
        }
    }

    /// The first word of a list, in lower case.
    pub(super) fn head(&self) -> Option<String> {
        match self {
            Self::List(items, _) => match items.first() {
                Some(Self::Word(word, _)) => Some(word.to_lowercase()),
                _ => None,
            },
            Self::Word(..) => None,
        }
    }

    /// From the bracket to the end of the first word: a list may go over many lines.
    pub(super) fn head_span(&self) -> SourceSpan {
        let span = self.span();
        match self.items().first() {
            Some(Self::Word(_, word)) => {
                (span.offset(), word.offset() + word.len() - span.offset()).into()
            }
            _ => span,
        }
    }

    pub(super) fn is_section(&self) -> bool {
        self.head().is_some_and(|head| is_section_word(&head))
    }

    pub(super) fn items(&self) -> &[Self] {
        match self {
            Self::List(items, _) => items,
            Self::Word(..) => &[],
        }
    }
}

/// `:action` and its like.
fn is_section_word(word: &str) -> bool {
    word.starts_with(':')
}

/// The bracketed lists of a text, with the faults of its brackets. A section begun within another shows that the other
/// was not closed; it is closed then, and reading goes on.
pub(super) fn expressions(source: &Source) -> (Vec<Expression<'_>>, Vec<RuleFault>) {
    let text = source.text();
    let mut faults = Vec::new();
    let mut open: Vec<(usize, Vec<Expression<'_>>)> = Vec::new();
    let mut top = Vec::new();
    let mut rest = skip_blank(text);
    while !rest.is_empty() {
        let start = text.len() - rest.len();
        let found: IResult<&str, &str> = alt((tag("("), tag(")"), quoted, word)).parse(rest);
        let (after, token) = found.expect("any other character is a word's");
        let end = text.len() - after.len();
        let done = match token {
            "(" => {
                if open.len() > 1 && word(after).is_ok_and(|(_, word)| is_section_word(word)) {
                    let at = (open[1].0, 1).into();
                    faults.push(RuleFault::new(source, RuleError::MissingParenthesis { at }));
                    close(&mut open, 1, start, &mut top);
                }
                if open.len() >= MAX_DEPTH {
                    let at = (start, 1).into();
                    let error = RuleError::TooDeep { limit: MAX_DEPTH, at };
                    faults.push(RuleFault::new(source, error));
                    return (top, faults);
                }
                open.push((start, Vec::new()));
                None
            }
            ")" => match open.pop() {
                Some((from, items)) => Some(Expression::List(items, (from, end - from).into())),
                None => {
                    let error = RuleError::Syntax {
                        expected: Bilingual::quoted("("),
                        found: Bilingual::quoted(")"),
                        at: (start, 1).into(),
                    };
                    faults.push(RuleFault::new(source, error));
                    None
                }
            },
            word => Some(Expression::Word(unquoted(word), (start, end - start).into())),
        };
        if let Some(done) = done {
            open.last_mut().map_or(&mut top, |(_, items)| items).push(done);
        }
        rest = skip_blank(after);
    }
    if let Some(&(from, _)) = open.get(1).or(open.first()) {
        let at = (from, 1).into();
        faults.push(RuleFault::new(source, RuleError::MissingParenthesis { at }));
        close(&mut open, 0, text.len(), &mut top);
    }
    faults.truncate(MOST_BRACKETS);
    (top, faults)
}

/// Of brackets that do not match, so many are told.
const MOST_BRACKETS: usize = 10;

/// Closes all open lists but so many.
fn close<'a>(
    open: &mut Vec<(usize, Vec<Expression<'a>>)>,
    but: usize,
    end: usize,
    top: &mut Vec<Expression<'a>>,
) {
    while open.len() > but {
        let Some((from, items)) = open.pop() else { return };
        let list = Expression::List(items, (from, end - from).into());
        open.last_mut().map_or(&mut *top, |(_, items)| items).push(list);
    }
}

fn unquoted(word: &str) -> &str {
    match word.strip_prefix('«').and_then(|word| word.strip_suffix('»')) {
        Some(inside) => inside,
        None => word.trim_matches('"'),
    }
}

fn word(input: &str) -> IResult<&str, &str> {
    take_while1(|c: char| !c.is_whitespace() && !"();".contains(c)).parse(input)
}

/// A name with blanks, as plans over Russian maps have them.
fn quoted(input: &str) -> IResult<&str, &str> {
    alt((
        recognize((tag("\""), take_while1(|c| c != '"' && c != '\n'), tag("\""))),
        recognize((tag("«"), take_while1(|c| c != '»' && c != '\n'), tag("»"))),
    ))
    .parse(input)
}

fn skip_blank(input: &str) -> &str {
    let comment = preceded(tag(";"), take_till(|c| c == '\n'));
    let skipped: IResult<&str, usize> =
        many0_count(alt((multispace1, comment, tag("\u{feff}")))).parse(input);
    let rest = skipped.map_or(input, |(rest, _)| rest);
    // White space that only Unicode knows would else be a word of no letters.
    rest.trim_start()
}
