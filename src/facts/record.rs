//! Records and values of branched types: what their types hold, and their text as Soufflé writes it.
//!
//! A record is a row of words that is kept once, and its word is the place where it is kept; `nil` is word 0. A branch
//! is a record whose first word is the branch's number. Lists are records within records, as long as memory allows:
//! nothing here walks them by recursion.

use std::fmt::Write as _;

use super::decimal::Decimal;
use super::program::Kind;
use super::word::{NIL, Word, Words, small_number};

/// The first word of a branch's records: its number.
pub(super) fn tag(branch: usize) -> Word {
    small_number(branch as i64).expect("a type has fewer branches than numbers have place")
}

/// What is still to be written.
enum Piece {
    Value(Word, Kind),
    Text(&'static str),
}

/// Which texts within a record stand in quotes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Texts {
    /// None, as Soufflé writes them.
    Plain,
    /// Those that could be misread.
    Told,
    /// All, as in Soufflé's files of quoted values.
    Quoted,
}

/// Appends a value's text.
pub(super) fn write(words: &Words, word: Word, kind: Kind, texts: Texts, out: &mut String) {
    let is_inside = matches!(kind, Kind::Record(_));
    let mut open = vec![Piece::Value(word, kind)];
    while let Some(piece) = open.pop() {
        let (word, kind) = match piece {
            Piece::Text(text) => {
                out.push_str(text);
                continue;
            }
            Piece::Value(word, kind) => (word, kind),
        };
        match kind {
            Kind::Symbol => {
                let text = words.text(word);
                let is_quoted = match texts {
                    Texts::Plain => false,
                    Texts::Told => needs_quotes(text),
                    Texts::Quoted => true,
                };
                let _ = match is_inside && is_quoted {
                    true => write!(out, "{text:?}"),
                    false => write!(out, "{text}"),
                };
            }
            Kind::Number | Kind::Unsigned => {
                let _ = write!(out, "{}", words.to_number(word));
            }
            Kind::Float => {
                let _ = write!(out, "{}", Decimal::from_millionths(words.to_number(word)));
            }
            Kind::Record(_) if word == NIL => out.push_str("nil"),
            Kind::Record(shape) => {
                let (shape, row) = (&words.shapes()[shape as usize], words.record_of(word));
                let (fields, close) = match (shape.is_record, row.split_first()) {
                    (false, Some((tag, row))) => {
                        let (name, kinds) = &shape.branches[words.to_number(*tag) as usize];
                        let _ = write!(out, "${name}");
                        if row.is_empty() {
                            continue;
                        }
                        out.push('(');
                        (row.iter().zip(kinds), ")")
                    }
                    _ => {
                        out.push('[');
                        (row.iter().zip(&shape.branches[0].1), "]")
                    }
                };
                open.push(Piece::Text(close));
                for (n, (word, kind)) in fields.enumerate().collect::<Vec<_>>().into_iter().rev() {
                    open.push(Piece::Value(*word, *kind));
                    if n > 0 {
                        open.push(Piece::Text(", "));
                    }
                }
            }
        }
    }
}

fn needs_quotes(text: &str) -> bool {
    text.is_empty()
        || text.trim() != text
        || text.contains(['[', ']', '(', ')', ',', '"', '\\', '\n', '\t'])
}

/// Gives words to what is read: those that are there, or new ones too.
pub(super) trait Naming {
    fn symbol(&mut self, text: &str) -> Option<Word>;
    fn number(&mut self, number: i64) -> Option<Word>;
    fn record(&mut self, row: &[Word]) -> Option<Word>;
    fn words(&self) -> &Words;
}

/// Names new values too.
pub(super) struct Making<'a>(pub(super) &'a mut Words);

impl Naming for Making<'_> {
    fn symbol(&mut self, text: &str) -> Option<Word> {
        Some(self.0.symbol(text))
    }
    fn number(&mut self, number: i64) -> Option<Word> {
        Some(self.0.number(number))
    }
    fn record(&mut self, row: &[Word]) -> Option<Word> {
        Some(self.0.record(row))
    }
    fn words(&self) -> &Words {
        self.0
    }
}

/// Names what is known already.
pub(super) struct Finding<'a>(pub(super) &'a Words);

impl Naming for Finding<'_> {
    fn symbol(&mut self, text: &str) -> Option<Word> {
        self.0.find_symbol(text)
    }
    fn number(&mut self, number: i64) -> Option<Word> {
        self.0.find_number(number)
    }
    fn record(&mut self, row: &[Word]) -> Option<Word> {
        self.0.find_record(row)
    }
    fn words(&self) -> &Words {
        self.0
    }
}

/// A record of which some fields are still to be read.
struct Open {
    shape: usize,
    branch: usize,
    row: Vec<Word>,
    /// None for a branch without brackets.
    close: Option<char>,
}

/// The word of a record's text, as [`write`] or Soufflé writes it; none where the text is not of the kind.
pub(super) fn read(text: &str, kind: Kind, naming: &mut dyn Naming) -> Option<Word> {
    let mut rest = text.trim();
    let mut open: Vec<Open> = Vec::new();
    let mut wanted = kind;
    loop {
        rest = rest.trim_start();
        let mut done = match wanted {
            Kind::Record(_) if is_nil(rest) => {
                rest = &rest["nil".len()..];
                Some(NIL)
            }
            Kind::Record(shape) => {
                open.push(begin(naming.words(), shape as usize, &mut rest)?);
                None
            }
            plain => Some(plain_value(plain, open.last()?.close, &mut rest, naming)?),
        };
        // A value may be the last of its record, and that of another.
        loop {
            if let Some(word) = done.take() {
                match open.last_mut() {
                    Some(top) => top.row.push(word),
                    None => return rest.trim().is_empty().then_some(word),
                }
            }
            let top = open.last()?;
            let shape = &naming.words().shapes()[top.shape];
            let kinds = &shape.branches[top.branch].1;
            let known = top.row.len() - usize::from(!shape.is_record);
            if let Some(kind) = kinds.get(known) {
                if known > 0 {
                    rest = rest.trim_start().strip_prefix(',')?;
                }
                wanted = *kind;
                break;
            }
            if let Some(close) = top.close {
                rest = rest.trim_start().strip_prefix(close)?;
            }
            done = Some(naming.record(&open.pop()?.row)?);
        }
    }
}

fn is_nil(rest: &str) -> bool {
    rest.strip_prefix("nil").is_some_and(|behind| !behind.starts_with(char::is_alphanumeric))
}

/// Reads `[`, `$Name` or `$Name(`.
fn begin(words: &Words, number: usize, rest: &mut &str) -> Option<Open> {
    let shape = words.shapes().get(number)?;
    if shape.is_record {
        *rest = rest.strip_prefix('[')?;
        return Some(Open { shape: number, branch: 0, row: Vec::new(), close: Some(']') });
    }
    let behind = rest.strip_prefix('$')?;
    let is_name = |c: char| c.is_alphanumeric() || matches!(c, '_' | '?' | '.');
    let end = behind.find(|c| !is_name(c)).unwrap_or(behind.len());
    let branch = shape.branches.iter().position(|(name, _)| *name == behind[..end])?;
    *rest = behind[end..].trim_start();
    let close = rest.strip_prefix('(').map(|inside| {
        *rest = inside;
        ')'
    });
    Some(Open { shape: number, branch, row: vec![tag(branch)], close })
}

/// A value that is no record, up to the next comma or closing bracket.
fn plain_value(
    kind: Kind,
    close: Option<char>,
    rest: &mut &str,
    naming: &mut dyn Naming,
) -> Option<Word> {
    if let (Kind::Symbol, Some(inside)) = (kind, rest.strip_prefix('"')) {
        let mut value = String::new();
        let mut letters = inside.char_indices();
        while let Some((at, letter)) = letters.next() {
            match letter {
                '"' => {
                    *rest = &inside[at + 1..];
                    return naming.symbol(&value);
                }
                '\\' => value.push(match letters.next()?.1 {
                    'n' => '\n',
                    't' => '\t',
                    'r' => '\r',
                    other => other,
                }),
                other => value.push(other),
            }
        }
        return None;
    }
    let end = rest.find(|c| c == ',' || Some(c) == close).unwrap_or(rest.len());
    let text = rest[..end].trim();
    *rest = &rest[end..];
    match kind {
        Kind::Symbol => naming.symbol(text),
        Kind::Number => naming.number(text.parse().ok()?),
        Kind::Unsigned => naming.number(i64::from(text.parse::<u32>().ok()?)),
        Kind::Float => naming.number(text.parse::<Decimal>().ok()?.millionths()),
        Kind::Record(_) => None,
    }
}
