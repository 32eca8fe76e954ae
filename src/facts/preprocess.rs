//! The part of C's preprocessor that rule files use: `#define`, `#undef`, `#ifdef`, `#ifndef`, `#else`, `#endif`,
//! `#include`. It works on words, so that a fault within what a name stands for is shown where the name stands.

use std::collections::HashMap;

use super::fault::RuleError;
use super::lex::{self, Token, Word};
use super::syntax::Span;

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

#[derive(Debug, Default)]
struct Macros {
    known: HashMap<String, Macro>,
    /// For each open `#ifdef` whether what stands there is left out.
    skipping: Vec<bool>,
    words: usize,
}

/// The words with the lines for the preprocessor followed.
pub(super) fn expand(tokens: Vec<Token>, file: u32, faults: &mut Vec<RuleError>) -> Vec<Token> {
    if !tokens.iter().any(|token| matches!(token.word, Word::Line(_))) {
        return tokens;
    }
    let mut macros = Macros::default();
    let mut out = Vec::with_capacity(tokens.len());
    let mut rest = tokens.as_slice();
    while let Some((first, behind)) = rest.split_first() {
        rest = behind;
        match &first.word {
            Word::Line(line) => macros.line(line, first.at, file, &mut out, faults),
            _ if macros.skipping.contains(&true) => {}
            _ => rest = macros.put(first, rest, 0, &mut out, faults),
        }
    }
    if !macros.skipping.is_empty() {
        let at = tokens.last().map(|token| token.at).unwrap_or_default().into();
        faults.push(RuleError::Unclosed { what: "#ifdef", closing: "#endif", at });
    }
    out
}

impl Macros {
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
        let is_skipped = self.skipping.contains(&true);
        match word {
            "ifdef" => self.skipping.push(!self.known.contains_key(rest.trim())),
            "ifndef" => self.skipping.push(self.known.contains_key(rest.trim())),
            "if" if matches!(rest.trim(), "0" | "1") => self.skipping.push(rest.trim() == "0"),
            "else" if !self.skipping.is_empty() => {
                let last = self.skipping.pop();
                self.skipping.push(!last.unwrap_or_default());
            }
            "endif" if !self.skipping.is_empty() => {
                self.skipping.pop();
            }
            _ if is_skipped => {}
            // `# 1 "file.dl"`: where a preprocessor took the lines from.
            "line" => {}
            "" if rest.trim_start().starts_with(|c: char| c.is_ascii_digit()) => {}
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
                let what = format!("препроцессор C: «#{line}»");
                let help = "есть #define, #undef, #ifdef, #ifndef, #else, #endif и #include";
                faults.push(RuleError::Unsupported { what, help, at: at.into() });
            }
        }
    }

    fn define(&mut self, rest: &str, at: Span, file: u32, faults: &mut Vec<RuleError>) {
        let mut found = Vec::new();
        // A bracket right behind the name opens its parameters.
        let takes = rest.trim_start().find(|c: char| !c.is_alphanumeric() && c != '_');
        let takes = takes.is_some_and(|end| rest.trim_start()[end..].starts_with('('));
        let words = lex::words(rest, file, &mut found);
        // Places within the definition are those of its line.
        if !found.is_empty() {
            let what = "определение, в котором не всё – слова языка".to_owned();
            faults.push(RuleError::Unsupported {
                what,
                help: "проверьте текст за именем",
                at: at.into(),
            });
            return;
        }
        let Some((Token { word: Word::Name(name), .. }, mut body)) =
            words.split_first().map(|(first, rest)| (first.clone(), rest))
        else {
            let (expected, found) = ("имя".to_owned(), "#define без имени".to_owned());
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
            Word::Name(name) => self.known.get(name).cloned(),
            _ => None,
        };
        let Some(known) = known else {
            out.push(token.clone());
            return rest;
        };
        self.words += known.body.len() + 1;
        if depth > MAX_DEPTH || self.words > MAX_WORDS {
            if self.words <= 2 * MAX_WORDS {
                let (what, limit, at) = ("подстановок #define", MAX_DEPTH, token.at.into());
                faults.push(RuleError::TooLarge { what, limit, at });
                self.words = 4 * MAX_WORDS;
            }
            return rest;
        }
        let (args, rest) = match &known.parameters {
            None => (HashMap::new(), rest),
            Some(parameters) => match arguments(rest) {
                Some((args, rest)) => (parameters.iter().cloned().zip(args).collect(), rest),
                None => {
                    out.push(token.clone());
                    return rest;
                }
            },
        };
        let mut body: Vec<Token> = Vec::new();
        for one in &known.body {
            match &one.word {
                Word::Name(name) if args.contains_key(name) => {
                    body.extend(args[name].iter().cloned())
                }
                word => body.push(Token { word: word.clone(), at: token.at }),
            }
        }
        self.words += body.len();
        let mut left = body.as_slice();
        while let Some((first, behind)) = left.split_first() {
            left = self.put(first, behind, depth + 1, out, faults);
        }
        rest
    }
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
