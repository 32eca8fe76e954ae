//! Rule text to words of the language, with nom. Letters are those of any alphabet.

use nom::branch::alt;
use nom::bytes::complete::{tag, take_until, take_while, take_while1};
use nom::character::complete::{char, satisfy};
use nom::combinator::{opt, recognize};
use nom::multi::many0_count;
use nom::sequence::{pair, preceded};
use nom::{IResult, Parser};

use super::decimal::Decimal;
use super::fault::RuleError;
use super::syntax::Span;
use crate::units::{said, word};

/// Deeper brackets are refused, so that reading them needs bounded stack.
const MAX_DEPTH: usize = 64;

#[derive(Debug, Clone, PartialEq)]
pub(super) enum Word {
    Name(String),
    Number(i64),
    /// `5u`
    Unsigned(i64),
    /// In millionths.
    Decimal(i64),
    Text(String),
    /// `.decl` and its like, without the dot.
    Directive(&'static str),
    Sign(&'static str),
    /// A line for the preprocessor, without its `#`.
    Line(String),
}

#[derive(Debug, Clone, PartialEq)]
pub(super) struct Token {
    pub(super) word: Word,
    pub(super) at: Span,
}

const DIRECTIVES: &[&str] = &[
    "decl",
    "type",
    "input",
    "output",
    "printsize",
    "limitsize",
    "plan",
    "pragma",
    "comp",
    "init",
    "functor",
    "include",
    "once",
    "lattice",
    "debug_delta",
    "override",
    "symbol_type",
    "number_type",
];

/// Longest first, since the first that fits is taken.
const SIGNS: &[&str] = &[
    ":-", "<:", "<=", ">=", "!=", "||", "&&", "##", "#", ":", "<", ">", "=", "!", ",", ";", ".",
    "(", ")", "{", "}", "[", "]", "+", "-", "*", "/", "%", "^", "|", "$", "@",
];

/// What one word turned out to be, before its value is known.
enum Raw<'a> {
    Name(&'a str),
    Number(&'a str),
    Text,
    Directive(&'static str),
    Sign(&'static str),
}

/// All words of a text, and what is no word.
pub(super) fn words(text: &str, file: u32, faults: &mut Vec<RuleError>) -> Vec<Token> {
    let mut tokens = Vec::new();
    let mut depth = 0usize;
    let mut rest = text;
    let place = |from: &str, to: &str| Span {
        file,
        start: (text.len() - from.len()) as u32,
        end: (text.len() - to.len()) as u32,
    };
    loop {
        rest = match blank(rest) {
            Ok((after, _)) => after,
            Err(_) => {
                let (what, closing) = (word!("the-comment"), word!("end-of-comment"));
                faults.push(RuleError::Unclosed { what, closing, at: place(rest, rest).into() });
                return tokens;
            }
        };
        let Some(first) = rest.chars().next() else { return tokens };
        let before = &text[..text.len() - rest.len()];
        let starts_line = before[before.rfind('\n').map_or(0, |at| at + 1)..].trim().is_empty();
        if first == '#' && starts_line {
            let mut end = rest.find('\n').unwrap_or(rest.len());
            // A line goes on behind a backslash.
            while rest[..end].trim_end_matches('\r').ends_with('\\') && end < rest.len() {
                end = rest[end + 1..].find('\n').map_or(rest.len(), |more| end + 1 + more);
            }
            let at = place(rest, &rest[end..]);
            tokens.push(Token { word: Word::Line(rest[1..end].replace(['\\', '\r'], " ")), at });
            rest = &rest[end..];
            continue;
        }
        let Ok((after, raw)) = raw_word(rest) else {
            let after = &rest[first.len_utf8()..];
            faults.push(RuleError::Character { character: first, at: place(rest, after).into() });
            rest = after;
            continue;
        };
        let at = place(rest, after);
        rest = after;
        let word = match raw {
            Raw::Name(name) => Word::Name(normal(name)),
            Raw::Directive(name) => Word::Directive(name),
            Raw::Number(digits) if digits.matches('.').count() == 3 => {
                Word::Number(address(digits, at, faults))
            }
            Raw::Number(digits) if digits.contains('.') => {
                Word::Decimal(decimal(digits, at, faults))
            }
            Raw::Number(digits) if digits.ends_with('u') => {
                Word::Unsigned(number(digits, at, faults))
            }
            Raw::Number(digits) => Word::Number(number(digits, at, faults)),
            Raw::Text => match quoted(rest) {
                Some((value, after, unknown)) => {
                    let at = Span { end: place(rest, after).end, ..at };
                    if let Some(letter) = unknown {
                        let what = said!("means-nothing-in-a-text", letter);
                        let help = word!("escapes-of-a-text");
                        faults.push(RuleError::Misuse { what, help, at: at.into() });
                    }
                    rest = after;
                    tokens.push(Token { word: Word::Text(value), at });
                    continue;
                }
                None => {
                    let (what, closing) = (
                        word!("a-text-in-quotation-marks"),
                        word!("the-closing-quotation-mark-on-the-same"),
                    );
                    faults.push(RuleError::Unclosed { what, closing, at: at.into() });
                    rest = &rest[rest.find('\n').unwrap_or(rest.len())..];
                    Word::Text(String::new())
                }
            },
            Raw::Sign(sign) => {
                match sign {
                    "(" | "{" | "[" => depth += 1,
                    ")" | "}" | "]" => depth = depth.saturating_sub(1),
                    _ => {}
                }
                if depth > MAX_DEPTH {
                    let (what, limit) = (word!("levels-of-brackets"), MAX_DEPTH);
                    faults.push(RuleError::TooLarge { what, limit, at: at.into() });
                    return tokens;
                }
                Word::Sign(sign)
            }
        };
        tokens.push(Token { word, at });
    }
}

/// White space and comments; an error only for a comment that never ends.
fn blank(text: &str) -> IResult<&str, ()> {
    let mut rest = text.trim_start_matches(|c: char| c.is_whitespace() || c == '\u{feff}');
    while let Some(comment) = rest.strip_prefix('/') {
        if comment.starts_with('/') {
            rest = &rest[rest.find('\n').unwrap_or(rest.len())..];
        } else if comment.starts_with('*') {
            (rest, _) = (tag("/*"), take_until("*/"), tag("*/")).parse(rest)?;
        } else {
            break;
        }
        rest = rest.trim_start();
    }
    Ok((rest, ()))
}

fn raw_word(text: &str) -> IResult<&str, Raw<'_>> {
    alt((
        // Before names, which may start with «?» too.
        tag("?-").map(|_| Raw::Sign("?-")),
        name.map(Raw::Name),
        digits.map(Raw::Number),
        char('"').map(|_| Raw::Text),
        directive,
        sign,
    ))
    .parse(text)
}

fn name(text: &str) -> IResult<&str, &str> {
    let first = satisfy(|c| c.is_alphabetic() || c == '_' || c == '?');
    // A combining mark belongs to the letter before it (й may be written as two characters).
    let later = |c: char| c.is_alphanumeric() || matches!(c, '_' | '?' | '\u{300}'..='\u{36f}');
    recognize(pair(first, take_while(later))).parse(text)
}

/// Digits of a number with its prefix, suffix and, for a better message, its fraction.
fn digits(text: &str) -> IResult<&str, &str> {
    let prefixed =
        preceded(alt((tag("0x"), tag("0b"))), take_while1(|c: char| c.is_ascii_alphanumeric()));
    let plain = take_while1(|c: char| c.is_ascii_digit());
    let fraction = pair(char('.'), take_while1(|c: char| c.is_ascii_digit()));
    let part = || preceded(char('.'), take_while1(|c: char| c.is_ascii_digit()));
    let digits = take_while1(|c: char| c.is_ascii_digit());
    let address = recognize((digits, part(), part(), part()));
    alt((recognize(prefixed), address, recognize((plain, opt(fraction), opt(char('u'))))))
        .parse(text)
}

fn decimal(text: &str, at: Span, faults: &mut Vec<RuleError>) -> i64 {
    if let Ok(exact) = text.parse::<Decimal>() {
        return exact.millionths();
    }
    let Some(rounded) = Decimal::rounded(text) else {
        faults.push(RuleError::Number { text: text.into(), at: at.into() });
        return 0;
    };
    faults.push(RuleError::Rounded { number: rounded.to_string(), at: at.into() });
    rounded.millionths()
}

/// An address of four parts, `10.0.0.1`, is one number of 32 bits with a sign, as Soufflé reads it.
fn address(text: &str, at: Span, faults: &mut Vec<RuleError>) -> i64 {
    text.parse::<std::net::Ipv4Addr>().map_or_else(
        |_| {
            faults.push(RuleError::Number { text: text.into(), at: at.into() });
            0
        },
        |address| i64::from(address.to_bits() as i32),
    )
}

fn number(text: &str, at: Span, faults: &mut Vec<RuleError>) -> i64 {
    let parsed = match (text.strip_prefix("0x"), text.strip_prefix("0b")) {
        (Some(hex), _) => i64::from_str_radix(hex.trim_end_matches('u'), 16),
        (_, Some(binary)) => i64::from_str_radix(binary.trim_end_matches('u'), 2),
        _ => text.trim_end_matches('u').parse(),
    };
    parsed.unwrap_or_else(|_| {
        faults.push(RuleError::Number { text: text.into(), at: at.into() });
        0
    })
}

fn directive(text: &str) -> IResult<&str, Raw<'_>> {
    let (rest, word) = preceded(char('.'), name).parse(text)?;
    match DIRECTIVES.iter().find(|known| **known == word) {
        Some(known) => Ok((rest, Raw::Directive(known))),
        None => sign(text),
    }
}

fn sign(text: &str) -> IResult<&str, Raw<'_>> {
    let known = SIGNS.iter().find(|sign| text.starts_with(**sign));
    let known =
        known.ok_or(nom::Err::Error(nom::error::make_error(text, nom::error::ErrorKind::Tag)))?;
    Ok((&text[known.len()..], Raw::Sign(known)))
}

/// The value of a quoted text whose opening quote is read, what follows its closing quote, and a letter behind a
/// backslash that means nothing there.
fn quoted(text: &str) -> Option<(String, &str, Option<char>)> {
    let mut value = String::new();
    let mut unknown = None;
    let mut rest = text;
    loop {
        let plain: IResult<&str, usize> =
            many0_count(take_while1(|c| !matches!(c, '"' | '\\' | '\n'))).parse(rest);
        let after = plain.map_or(rest, |(after, _)| after);
        value.push_str(&rest[..rest.len() - after.len()]);
        let mut next = after.chars();
        match next.next()? {
            '"' => return Some((value, next.as_str(), unknown)),
            '\\' => value.push(match next.next()? {
                'n' => '\n',
                't' => '\t',
                'r' => '\r',
                'a' => '\u{7}',
                'b' => '\u{8}',
                'f' => '\u{c}',
                'v' => '\u{b}',
                plain @ ('"' | '\'' | '\\') => plain,
                other => {
                    unknown.get_or_insert(other);
                    other
                }
            }),
            _ => return None,
        }
        rest = next.as_str();
    }
}

/// One spelling for letters that can be written as one character or two.
fn normal(name: &str) -> String {
    use unicode_normalization::UnicodeNormalization;
    name.nfc().collect()
}
