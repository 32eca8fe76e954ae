//! Words and signs of a rule file.
//!
//! A word may hold letters of any alphabet, digits, hyphens and underscores, as the paper writes them
//! (`Движение-в_от-двери_до-места`); a name with other signs stands in quotes. White space and line
//! ends only separate. Comments run from `;`, `#` or `//` to the end of the line.

use std::borrow::Cow;

use miette::SourceSpan;
use nom::branch::alt;
use nom::bytes::complete::{tag, take_till, take_while, take_while1};
use nom::character::complete::anychar;
use nom::combinator::{recognize, value};
use nom::multi::many0_count;
use nom::sequence::{delimited, pair, preceded};
use nom::{IResult, Parser};

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum TokenKind<'a> {
    Word(&'a str),
    /// With its question mark.
    Variable(&'a str),
    Open,
    Close,
    Comma,
    Colon,
    Dash,
    Equal,
    NotEqual,
    Not,
    /// A run of signs that mean nothing here.
    Strange(&'a str),
}

#[derive(Debug, Clone, Copy)]
pub(super) struct Token<'a> {
    pub(super) kind: TokenKind<'a>,
    pub(super) start: usize,
    pub(super) end: usize,
}

impl Token<'_> {
    pub(super) fn span(&self) -> SourceSpan {
        (self.start, self.end - self.start).into()
    }
}

/// All tokens of a text. Every text has tokens: what is not understood becomes [`TokenKind::Strange`].
pub(super) fn tokens(text: &str) -> Vec<Token<'_>> {
    let mut tokens: Vec<Token<'_>> = Vec::new();
    let mut rest = skip_blank(text);
    while !rest.is_empty() {
        let start = text.len() - rest.len();
        let (after, kind) = token(rest).expect("any character is a token");
        let end = text.len() - after.len();
        match (tokens.last_mut(), kind) {
            // Rubbish is one fault, not one a byte.
            (Some(last), TokenKind::Strange(_))
                if last.end == start && matches!(last.kind, TokenKind::Strange(_)) =>
            {
                *last = Token {
                    kind: TokenKind::Strange(&text[last.start..end]),
                    start: last.start,
                    end,
                };
            }
            _ => tokens.push(Token { kind, start, end }),
        }
        rest = skip_blank(after);
    }
    tokens
}

fn token(input: &str) -> IResult<&str, TokenKind<'_>> {
    alt((
        word.map(TokenKind::Word),
        recognize(pair(tag("?"), word)).map(TokenKind::Variable),
        quoted.map(TokenKind::Word),
        value(TokenKind::Open, tag("(")),
        value(TokenKind::Close, tag(")")),
        value(TokenKind::Comma, tag(",")),
        value(TokenKind::Colon, tag(":")),
        value(TokenKind::NotEqual, alt((tag("≠"), tag("!="), tag("<>")))),
        value(TokenKind::Equal, tag("=")),
        value(TokenKind::Not, alt((tag("¬"), tag("!")))),
        value(TokenKind::Dash, alt((tag("—"), tag("–"), tag("-")))),
        recognize(anychar).map(TokenKind::Strange),
    ))
    .parse(input)
}

fn word(input: &str) -> IResult<&str, &str> {
    recognize(pair(
        take_while1(|c: char| c.is_alphanumeric() || c == '_'),
        take_while(|c: char| c.is_alphanumeric() || "_-+.'№\u{301}\u{306}\u{308}".contains(c)),
    ))
    .parse(input)
}

fn quoted(input: &str) -> IResult<&str, &str> {
    alt((
        delimited(tag("«"), take_while1(|c| c != '»' && c != '\n'), tag("»")),
        delimited(tag("\""), take_while1(|c| c != '"' && c != '\n'), tag("\"")),
    ))
    .parse(input)
}

/// A name as it stands in a rule file: in quotes, where it is not one word. One that has line ends or the quotation marks
/// of both kinds cannot be told; of these it is left without.
#[must_use]
pub fn in_quotes(name: &str) -> Cow<'_, str> {
    let is_word = word(name).is_ok_and(|(rest, _)| rest.is_empty());
    let fits = |mark: char| !name.contains([mark, '\n']);
    if is_word {
        return name.into();
    }
    if !name.is_empty() && fits('»') {
        return format!("«{name}»").into();
    }
    if !name.is_empty() && fits('"') {
        return format!("\"{name}\"").into();
    }
    let told: String = name.chars().filter(|c| !"»\"\n".contains(*c)).collect();
    format!("«{}»", if told.is_empty() { "?" } else { &told }).into()
}

fn skip_blank(input: &str) -> &str {
    let comment = preceded(alt((tag(";"), tag("#"), tag("//"))), take_till(|c| c == '\n'));
    let blank = take_while1(|c: char| c.is_whitespace() || c == '\u{feff}');
    let skipped: IResult<&str, usize> = many0_count(alt((blank, comment))).parse(input);
    skipped.map_or(input, |(rest, _)| rest)
}

#[cfg(test)]
mod tests {
    use expect_test::{Expect, expect};

    use super::*;

    fn check(text: &str, expected: &Expect) {
        let kinds: Vec<String> = tokens(text)
            .iter()
            .map(|t| format!("{:?} {:?}", t.kind, &text[t.start..t.end]))
            .collect();
        expected.assert_eq(&kinds.join("\n"));
    }

    #[test]
    fn words_keep_hyphens_and_quotes_keep_blanks() {
        check(
            "ДВЕРЬ_ИЗ_В(дверь ?y, «Стол у окна») ; дальше\n?x ≠ Z — $$%",
            &expect![[r#"
                Word("ДВЕРЬ_ИЗ_В") "ДВЕРЬ_ИЗ_В"
                Open "("
                Word("дверь") "дверь"
                Variable("?y") "?y"
                Comma ","
                Word("Стол у окна") "«Стол у окна»"
                Close ")"
                Variable("?x") "?x"
                NotEqual "≠"
                Word("Z") "Z"
                Dash "—"
                Strange("$$%") "$$%""#]],
        );
    }

    #[test]
    fn rubbish_is_one_token() {
        let text = "$".repeat(100_000);
        assert_eq!(tokens(&text).len(), 1);
    }
}
