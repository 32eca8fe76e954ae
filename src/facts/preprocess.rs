//! The part of C's preprocessor that rule files use: `#define`, `#undef`, `#ifdef`, `#ifndef`, `#if`, `#elif`, `#else`,
//! `#endif`, `#include`, `#line`, within what a name stands for `#x` and `x ## y`; and Soufflé's `__FILE__` and
//! `__LINE__`. It works on words, so that a fault within what a name stands for is shown where the name stands.

use std::collections::HashMap;

use super::condition;
use super::decimal::Decimal;
use super::fault::RuleError;
use super::lex::{self, Token, Word};
use super::syntax::Span;
use crate::units::{Source, said, word};

/// What names stand for may name others; deeper or longer is taken for an endless definition.
const MAX_DEPTH: usize = 32;
const MAX_WORDS: usize = 1 << 20;

/// What a name stands for.
#[derive(Debug, Clone)]
struct Macro {
    /// None where no brackets follow the name.
    parameters: Option<Vec<String>>,
    body: Vec<Token>,
}

/// An open `#if`.
#[derive(Debug, Clone, Copy)]
struct Choice {
    /// What stands here is left out.
    skips: bool,
    /// One of its parts was taken already, or none may be.
    is_made: bool,
}

impl Choice {
    fn of(holds: bool) -> Self {
        Self { skips: !holds, is_made: holds }
    }
}

/// Soufflé's name for the bits of a number.
const WIDTH: &str = "RAM_DOMAIN_SIZE";

struct Macros<'a> {
    source: &'a Source,
    known: HashMap<String, Macro>,
    open: Vec<Choice>,
    words: usize,
    /// What `__FILE__` says, and what is added to a line's number for `__LINE__`: both as the last `#line` has it.
    name: String,
    shift: i64,
}

/// The words with the lines for the preprocessor followed.
pub(super) fn expand(
    tokens: Vec<Token>,
    source: &Source,
    file: u32,
    faults: &mut Vec<RuleError>,
) -> Vec<Token> {
    let is_touched = |token: &Token| match &token.word {
        Word::Line(_) => true,
        Word::Name(name) => name.starts_with("__") || name == WIDTH,
        _ => false,
    };
    if !tokens.iter().any(is_touched) {
        return tokens;
    }
    let at = tokens.first().map(|token| token.at).unwrap_or_default();
    let width = Macro { parameters: None, body: vec![Token { word: Word::Number(64), at }] };
    let mut macros = Macros {
        source,
        known: HashMap::from([(WIDTH.to_owned(), width)]),
        open: Vec::new(),
        words: 0,
        name: source.name().to_owned(),
        shift: 0,
    };
    let mut out = Vec::with_capacity(tokens.len());
    let mut rest = tokens.as_slice();
    while let Some((first, behind)) = rest.split_first() {
        rest = behind;
        match &first.word {
            Word::Line(line) => macros.line(line, first.at, file, &mut out, faults),
            _ if macros.skips() => {}
            _ => rest = macros.put(first, rest, 0, &mut out, faults),
        }
    }
    if !macros.open.is_empty() {
        let at = tokens.last().map(|token| token.at).unwrap_or_default().into();
        faults.push(RuleError::Unclosed {
            what: word!("directive-if"),
            closing: word!("directive-endif"),
            at,
        });
    }
    out
}

impl Macros<'_> {
    fn skips(&self) -> bool {
        self.open.iter().any(|choice| choice.skips)
    }

    fn line(
        &mut self,
        line: &str,
        at: Span,
        file: u32,
        out: &mut Vec<Token>,
        faults: &mut Vec<RuleError>,
    ) {
        let line = line.trim();
        let (word, rest) =
            line.split_at(line.find(|c: char| !c.is_alphabetic()).unwrap_or(line.len()));
        let is_skipped = self.skips();
        match word {
            // Within what is left out conditions are not even read.
            "ifdef" | "ifndef" | "if" if is_skipped => {
                self.open.push(Choice { skips: true, is_made: true });
            }
            "ifdef" => self.open.push(Choice::of(self.known.contains_key(rest.trim()))),
            "ifndef" => self.open.push(Choice::of(!self.known.contains_key(rest.trim()))),
            "if" => {
                let holds = self.holds(rest, at, file, faults);
                self.open.push(Choice::of(holds));
            }
            "elif" | "else" if !self.open.is_empty() => {
                let last = self.open.pop().unwrap_or(Choice::of(true));
                let outer_skips = self.skips();
                let holds = !last.is_made
                    && !outer_skips
                    && (word == "else" || self.holds(rest, at, file, faults));
                self.open.push(Choice { skips: !holds, is_made: last.is_made || holds });
            }
            "endif" if !self.open.is_empty() => {
                self.open.pop();
            }
            _ if is_skipped => {}
            "line" => self.renumber(rest, at),
            // `# 1 "file.dl"`: where a preprocessor took the lines from.
            "" if rest.trim_start().starts_with(|c: char| c.is_ascii_digit()) => {
                self.renumber(rest, at);
            }
            "undef" => {
                self.known.remove(rest.trim());
            }
            "define" => self.define(rest, at, file, faults),
            "include" => {
                let path = rest.trim().trim_matches(['"', '<', '>']).to_owned();
                out.push(Token { word: Word::Directive("include"), at });
                out.push(Token { word: Word::Text(path), at });
            }
            _ => {
                let what = said!("cs-preprocessor", line);
                let help = word!("there-are-define-undef-ifdef-ifndef-if");
                faults.push(RuleError::Unsupported { what, help, at: at.into() });
            }
        }
    }

    /// Whether a condition holds; false, with a fault, where it is none.
    fn holds(&mut self, text: &str, at: Span, file: u32, faults: &mut Vec<RuleError>) -> bool {
        let mut found = Vec::new();
        let words = lex::words(text, file, &mut found);
        // What `defined` asks of is not put in.
        let mut plain = Vec::with_capacity(words.len());
        let mut rest = words.as_slice();
        while let Some((first, behind)) = rest.split_first() {
            rest = behind;
            let is_defined = matches!(&first.word, Word::Name(name) if name == "defined");
            if !is_defined {
                rest = self.put(first, rest, 0, &mut plain, &mut found);
                continue;
            }
            let ([
                Token { word: Word::Sign("("), .. },
                Token { word: Word::Name(name), .. },
                Token { word: Word::Sign(")"), .. },
                behind @ ..,
            ]
            | [Token { word: Word::Name(name), .. }, behind @ ..]) = rest
            else {
                break;
            };
            rest = behind;
            let word = Word::Number(i64::from(self.known.contains_key(name)));
            plain.push(Token { word, at });
        }
        let value = condition::value(&plain).filter(|_| found.is_empty() && rest.is_empty());
        value.map_or_else(
            || {
                let what = said!("the-preprocessors-condition", trim = text.trim());
                let help = word!("there-are-numbers-names-defined-and-brackets");
                faults.push(RuleError::Unsupported { what, help, at: at.into() });
                false
            },
            |value| value != 0,
        )
    }

    /// `#line 7 "other.dl"`: the next line is the seventh of that text.
    fn renumber(&mut self, rest: &str, at: Span) {
        let mut parts = rest.trim().splitn(2, char::is_whitespace);
        let Some(line) = parts.next().and_then(|number| number.parse::<i64>().ok()) else { return };
        self.shift = line - 1 - self.line_of(at);
        if let Some(name) = parts.next().and_then(|name| name.trim().split('"').nth(1)) {
            self.name = name.to_owned();
        }
    }

    fn line_of(&self, at: Span) -> i64 {
        i64::try_from(self.source.position(at.start as usize).0).unwrap_or(i64::MAX)
    }

    fn define(&mut self, rest: &str, at: Span, file: u32, faults: &mut Vec<RuleError>) {
        let mut found = Vec::new();
        // A bracket right behind the name opens its parameters.
        let takes = rest.trim_start().find(|c: char| !c.is_alphanumeric() && c != '_');
        let takes = takes.is_some_and(|end| rest.trim_start()[end..].starts_with('('));
        let words = lex::words(rest, file, &mut found);
        // Places within the definition are those of its line.
        if !found.is_empty() {
            let what = word!("a-definition-in-which-not-all-is").into();
            faults.push(RuleError::Unsupported {
                what,
                help: word!("check-the-text-after-the-name"),
                at: at.into(),
            });
            return;
        }
        let Some((Token { word: Word::Name(name), .. }, mut body)) =
            words.split_first().map(|(first, rest)| (first.clone(), rest))
        else {
            let (expected, found) = (said!("a-name"), said!("define-without-a-name"));
            faults.push(RuleError::Syntax { expected, found, at: at.into() });
            return;
        };
        let mut parameters = None;
        if takes {
            let end = body.iter().position(|token| token.word == Word::Sign(")"));
            let (inside, behind) = body.split_at(end.unwrap_or(body.len()));
            let names = inside.iter().filter_map(|token| match &token.word {
                Word::Name(name) => Some(name.clone()),
                _ => None,
            });
            parameters = Some(names.collect());
            body = behind.get(1..).unwrap_or_default();
        }
        self.known.insert(name, Macro { parameters, body: body.to_vec() });
    }

    /// Puts a word, or what it stands for; gives what is left of the words behind it.
    fn put<'a>(
        &mut self,
        token: &Token,
        rest: &'a [Token],
        depth: usize,
        out: &mut Vec<Token>,
        faults: &mut Vec<RuleError>,
    ) -> &'a [Token] {
        let known = match &token.word {
            Word::Name(name) => match name.as_str() {
                "__FILE__" => {
                    out.push(Token { word: Word::Text(self.name.clone()), at: token.at });
                    return rest;
                }
                "__LINE__" => {
                    let line = self.line_of(token.at).saturating_add(self.shift);
                    out.push(Token { word: Word::Number(line), at: token.at });
                    return rest;
                }
                name => self.known.get(name).cloned(),
            },
            _ => None,
        };
        let Some(known) = known else {
            out.push(token.clone());
            return rest;
        };
        self.words += known.body.len() + 1;
        if depth > MAX_DEPTH || self.words > MAX_WORDS {
            if self.words <= 2 * MAX_WORDS {
                let (what, limit, at) =
                    (word!("substitutions-of-define"), MAX_DEPTH, token.at.into());
                faults.push(RuleError::TooLarge { what, limit, at });
                self.words = 4 * MAX_WORDS;
            }
            return rest;
        }
        let (args, rest): (Args, _) = match &known.parameters {
            None => (HashMap::new(), rest),
            Some(parameters) => match arguments(rest) {
                Some((args, rest)) => (parameters.iter().cloned().zip(args).collect(), rest),
                None => {
                    out.push(token.clone());
                    return rest;
                }
            },
        };
        let body = filled(&known.body, &args, token.at);
        self.words += body.len();
        let mut left = body.as_slice();
        while let Some((first, behind)) = left.split_first() {
            left = self.put(first, behind, depth + 1, out, faults);
        }
        rest
    }
}

/// The words that stand for each parameter.
type Args = HashMap<String, Vec<Token>>;

/// What a name stands for, with the arguments for its parameters.
fn filled(of: &[Token], args: &Args, at: Span) -> Vec<Token> {
    let argument = |word: &Word| match word {
        Word::Name(name) => args.get(name),
        _ => None,
    };
    let mut body: Vec<Token> = Vec::new();
    let mut rest = of;
    while let Some((one, behind)) = rest.split_first() {
        rest = behind;
        match (&one.word, rest) {
            (Word::Sign("#"), [next, behind @ ..]) if argument(&next.word).is_some() => {
                let text = argument(&next.word).map(|words| spelt(words)).unwrap_or_default();
                body.push(Token { word: Word::Text(text), at });
                rest = behind;
            }
            (Word::Sign("##"), [next, behind @ ..]) => {
                rest = behind;
                let next = std::slice::from_ref(next);
                let right = argument(&next[0].word).map_or(next, Vec::as_slice);
                let left = body.pop();
                let joined =
                    left.as_ref().map(|word| spelt(std::slice::from_ref(word))).unwrap_or_default()
                        + &right
                            .first()
                            .map(|word| spelt(std::slice::from_ref(word)))
                            .unwrap_or_default();
                let words = lex::words(&joined, at.file, &mut Vec::new());
                body.extend(words.into_iter().map(|word| Token { word: word.word, at }));
                body.extend(right.iter().skip(1).cloned());
            }
            (word, _) => match argument(word) {
                Some(words) => body.extend(words.iter().cloned()),
                None => body.push(Token { word: word.clone(), at }),
            },
        }
    }
    body
}

/// Words as they are written, with one space where some stood between them.
fn spelt(words: &[Token]) -> String {
    let mut text = String::new();
    let mut end = None;
    for token in words {
        if end.is_some_and(|end| token.at.start > end) {
            text.push(' ');
        }
        end = Some(token.at.end);
        match &token.word {
            Word::Name(name) => text.push_str(name),
            Word::Number(number) => text += &number.to_string(),
            Word::Unsigned(number) => text += &format!("{number}u"),
            Word::Decimal(number) => text += &Decimal::from_millionths(*number).to_string(),
            Word::Text(value) => text += &format!("\"{value}\""),
            Word::Directive(word) => text += &format!(".{word}"),
            Word::Sign(sign) => text.push_str(sign),
            Word::Line(line) => text += &format!("#{line}"),
        }
    }
    text
}

/// The words between brackets, at each comma of their own level a new argument; and what is behind.
fn arguments(rest: &[Token]) -> Option<(Vec<Vec<Token>>, &[Token])> {
    let (first, inside) = rest.split_first()?;
    if first.word != Word::Sign("(") {
        return None;
    }
    let mut args = vec![Vec::new()];
    let mut depth = 0_usize;
    for (n, token) in inside.iter().enumerate() {
        match token.word {
            Word::Sign(",") if depth == 0 => {
                args.push(Vec::new());
                continue;
            }
            Word::Sign(")") if depth == 0 => return Some((args, &inside[n + 1..])),
            Word::Sign("(" | "[" | "{") => depth += 1,
            Word::Sign(")" | "]" | "}") => depth = depth.saturating_sub(1),
            _ => {}
        }
        args.last_mut()?.push(token.clone());
    }
    None
}
