//! What `#if` asks: numbers, with C's signs between them.

use super::lex::{Token, Word};

/// Brackets and signs within each other.
const MAX_DEPTH: usize = 64;

/// The value of a condition; none where it is none. A name that stands for nothing is 0.
pub(super) fn value(words: &[Token]) -> Option<i64> {
    let mut reader = Reader { rest: words, depth: 0 };
    let value = reader.joined(0)?;
    reader.rest.is_empty().then_some(value)
}

struct Reader<'a> {
    rest: &'a [Token],
    depth: usize,
}

/// Signs from the loosest; some are two words here.
const SIGNS: [(&[&str], u8); 13] = [
    (&["||"], 0),
    (&["&&"], 1),
    (&["=", "="], 2),
    (&["!="], 2),
    (&["<="], 3),
    (&[">="], 3),
    (&["<"], 3),
    (&[">"], 3),
    (&["+"], 4),
    (&["-"], 4),
    (&["*"], 5),
    (&["/"], 5),
    (&["%"], 5),
];

impl Reader<'_> {
    /// Operands with signs between them that bind at least so.
    fn joined(&mut self, least: u8) -> Option<i64> {
        self.depth += 1;
        if self.depth > MAX_DEPTH {
            return None;
        }
        let mut left = self.operand()?;
        while let Some((sign, binds)) = self.sign().filter(|(_, binds)| *binds >= least) {
            self.rest = &self.rest[sign.len()..];
            let right = self.joined(binds + 1)?;
            left = match sign.concat().as_str() {
                "||" => i64::from(left != 0 || right != 0),
                "&&" => i64::from(left != 0 && right != 0),
                "==" => i64::from(left == right),
                "!=" => i64::from(left != right),
                "<=" => i64::from(left <= right),
                ">=" => i64::from(left >= right),
                "<" => i64::from(left < right),
                ">" => i64::from(left > right),
                "+" => left.checked_add(right)?,
                "-" => left.checked_sub(right)?,
                "*" => left.checked_mul(right)?,
                "/" => left.checked_div(right)?,
                _ => left.checked_rem(right)?,
            };
        }
        self.depth -= 1;
        Some(left)
    }

    fn sign(&self) -> Option<(&'static [&'static str], u8)> {
        SIGNS.iter().copied().find(|(sign, _)| {
            let here = self.rest.iter().map(|token| &token.word);
            self.rest.len() >= sign.len()
                && here.zip(*sign).all(|(word, sign)| *word == Word::Sign(sign))
        })
    }

    fn operand(&mut self) -> Option<i64> {
        let (first, behind) = self.rest.split_first()?;
        self.rest = behind;
        Some(match &first.word {
            Word::Number(number) | Word::Unsigned(number) => *number,
            Word::Name(_) => 0,
            Word::Sign(sign @ ("!" | "-" | "+")) => {
                self.depth += 1;
                if self.depth > MAX_DEPTH {
                    return None;
                }
                let value = self.operand()?;
                self.depth -= 1;
                match *sign {
                    "!" => i64::from(value == 0),
                    "-" => value.checked_neg()?,
                    _ => value,
                }
            }
            Word::Sign("(") => {
                let value = self.joined(0)?;
                let (close, behind) = self.rest.split_first()?;
                self.rest = behind;
                return (close.word == Word::Sign(")")).then_some(value);
            }
            _ => return None,
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::lex::words;
    use super::*;

    #[test]
    fn signs_bind_as_in_c() {
        let of = |text: &str| value(&words(text, 0, &mut Vec::new()));
        for (text, wanted) in [
            ("1 + 2 * 3 == 7", Some(1)),
            ("!0 && 2 > 1 || 1 / 0", None),
            ("!(1 - 1)", Some(1)),
            ("10 - 2 - 3", Some(5)),
            ("-2 * -3 % 4", Some(2)),
            ("UNKNOWN", Some(0)),
            ("1 < 2 != 0", Some(1)),
            ("(1", None),
            ("1 1", None),
            ("", None),
        ] {
            assert_eq!(of(text), wanted, "{text}");
        }
        assert_eq!(of(&"(".repeat(100_000)), None);
        assert_eq!(of(&"!".repeat(100_000)), None);
    }
}
