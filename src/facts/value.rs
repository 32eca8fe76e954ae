//! Computing and comparing values.
//!
//! A computation may have no result: division by zero, overflow, `to_number` of no number. The premise
//! in which it stands then does not hold; evaluation goes on.

use std::cmp::Ordering;

use super::decimal::{self, Decimal};
use super::limits::MAX_TEXT;
use super::program::{Bounds, Expr, Kind, VariableId};
use super::syntax::{Comparison, Functor};
use super::word::{NO_WORD, Note, Word, Words, is_in_place};

/// The word of an expression's value; none where there is no value.
pub(super) fn compute(
    expr: &Expr,
    variable: &impl Fn(VariableId) -> Word,
    words: &mut Words,
) -> Option<Word> {
    match expr {
        Expr::Variable(v) => Some(variable(*v)),
        Expr::Constant(word) => Some(*word),
        Expr::Call(functor, _) if functor.result().is_number() => {
            let number = number(expr, variable, words)?;
            Some(words.number(number))
        }
        Expr::Call(functor, args) => no_number(*functor, args, expr, variable, words),
    }
}

/// The word of a column, or of what is computed from a row; [`NO_WORD`] where there is no value.
pub(super) fn column_word(expr: &Expr, row: &[Word], words: &mut Words) -> Word {
    match expr {
        Expr::Variable(column) => row[*column as usize],
        _ => compute(expr, &|c| row[c as usize], words).unwrap_or(NO_WORD),
    }
}

/// Records, their fields and texts; apart from the numbers, which most rules compute most often.
#[inline(never)]
fn no_number(
    functor: Functor,
    args: &[Expr],
    expr: &Expr,
    variable: &impl Fn(VariableId) -> Word,
    words: &mut Words,
) -> Option<Word> {
    match functor {
        Functor::Record => {
            let mut row = Vec::with_capacity(args.len());
            for field in args {
                row.push(compute(field, variable, words)?);
            }
            Some(words.record(&row))
        }
        Functor::Field => field(args, variable, words),
        _ => {
            let text = text(expr, variable, words)?;
            Some(words.symbol(&text))
        }
    }
}

/// The word of a record's field: of the record, the first word that it must have (a branch's number) or [`NO_WORD`], and
/// the place. None for `nil` and for another branch.
fn field(
    parts: &[Expr],
    variable: &impl Fn(VariableId) -> Word,
    words: &mut Words,
) -> Option<Word> {
    let [of, Expr::Constant(tag), Expr::Constant(place)] = parts else { return None };
    let record = compute(of, variable, words)?;
    if record == NO_WORD {
        return None;
    }
    let row = words.record_of(record);
    if *tag != NO_WORD && row.first() != Some(tag) {
        return None;
    }
    row.get(*place as usize).copied()
}

/// The whole number that a text is, in tens, as `0x1F` or as `0b101`.
pub(super) fn whole(text: &str) -> Option<i64> {
    let text = text.trim();
    let (sign, digits) = text.strip_prefix('-').map_or(("", text), |digits| ("-", digits));
    let (base, digits) = match (digits.strip_prefix("0x"), digits.strip_prefix("0b")) {
        (Some(digits), _) => (16, digits),
        (_, Some(digits)) => (2, digits),
        _ => return text.parse().ok(),
    };
    // A sign behind the mark is none.
    let is_plain = digits.starts_with(|first: char| first.is_digit(base));
    i64::from_str_radix(&format!("{sign}{digits}"), base).ok().filter(|_| is_plain)
}

/// The number that an expression of a number kind stands for.
pub(super) fn number(
    expr: &Expr,
    variable: &impl Fn(VariableId) -> Word,
    words: &mut Words,
) -> Option<i64> {
    let (functor, args) = match expr {
        Expr::Variable(v) => return Some(words.to_number(variable(*v))),
        Expr::Constant(word) => return Some(words.to_number(*word)),
        Expr::Call(functor, args) => (*functor, args.as_slice()),
    };
    match (functor, args) {
        (Functor::Length, [a]) => text(a, variable, words).map(|text| text.chars().count() as i64),
        (Functor::ToNumber, [a]) => whole(&text(a, variable, words)?),
        (Functor::ToUnsigned, [a]) => {
            whole(&text(a, variable, words)?).filter(|number| u32::try_from(*number).is_ok())
        }
        (Functor::ToDecimal, [a]) => {
            text(a, variable, words)?.trim().parse().ok().map(Decimal::millionths)
        }
        // Towards zero, as Soufflé does.
        (Functor::DecimalToNumber, [a]) => Some(number(a, variable, words)? / decimal::ONE),
        (Functor::DecimalToUnsigned, [a]) => {
            let whole = number(a, variable, words)? / decimal::ONE;
            u32::try_from(whole).ok().map(i64::from)
        }
        (Functor::UnsignedToNumber, [a]) => {
            // The same 32 bits.
            number(a, variable, words).map(|number| i64::from(number as u32 as i32))
        }
        (
            Functor::NumberToNumber | Functor::DecimalToDecimal | Functor::UnsignedToUnsigned,
            [a],
        ) => number(a, variable, words),
        (Functor::NumberToUnsigned, [a]) => number(a, variable, words).map(round),
        (Functor::NegateUnsigned, [a]) => {
            number(a, variable, words).map(|number| round(number.wrapping_neg()))
        }
        (Functor::BitNotUnsigned, [a]) => number(a, variable, words).map(|number| round(!number)),
        (Functor::LogicalNotUnsigned, [a]) => Some(i64::from(number(a, variable, words)? == 0)),
        (Functor::NumberToDecimal | Functor::UnsignedToDecimal, [a]) => {
            number(a, variable, words)?.checked_mul(decimal::ONE)
        }
        (Functor::Ordinal, [a]) => compute(a, variable, words).map(i64::from),
        (Functor::Negate | Functor::NegateDecimals, [a]) => {
            number(a, variable, words)?.checked_neg()
        }
        (Functor::LogicalNot, [a]) => Some(i64::from(number(a, variable, words)? == 0)),
        (Functor::BitNot, [a]) => Some(!number(a, variable, words)?),
        (_, [a, b]) => {
            let a = number(a, variable, words)?;
            let b = number(b, variable, words)?;
            let result = arithmetic(functor, a, b)?;
            if is_noted(functor, result) {
                note(functor, a, b, result, words);
            }
            Some(result)
        }
        (Functor::Field, parts) => {
            let word = field(parts, variable, words)?;
            Some(words.to_number(word))
        }
        (Functor::Counter, _) => {
            let word = words.next_number();
            Some(words.to_number(word))
        }
        _ => None,
    }
}

/// As Soufflé's unsigned numbers go round: the lowest 32 bits.
fn round(number: i64) -> i64 {
    i64::from(number as u32)
}

/// Whether Soufflé may have come to another number: quickly no for most.
#[inline]
fn is_noted(functor: Functor, result: i64) -> bool {
    use Functor::{DivideDecimals, MultiplyDecimals, PowerOfDecimals};
    i32::try_from(result).is_err()
        || matches!(functor, MultiplyDecimals | DivideDecimals | PowerOfDecimals)
}

/// Says so where Soufflé would have come to another number: it counts with 32 bits, and in binary fractions.
#[cold]
fn note(functor: Functor, a: i64, b: i64, result: i64, words: &mut Words) {
    match functor {
        Functor::MultiplyDecimals | Functor::DivideDecimals | Functor::PowerOfDecimals => {
            let is_exact = match functor {
                Functor::MultiplyDecimals => {
                    i128::from(a) * i128::from(b) % i128::from(decimal::ONE) == 0
                }
                Functor::DivideDecimals => {
                    b != 0 && i128::from(a) * i128::from(decimal::ONE) % i128::from(b) == 0
                }
                _ => false,
            };
            if !is_exact && result % decimal::ONE != 0 {
                words.note(Note::Rounded(Decimal::from_millionths(result)));
            }
        }
        _ if functor.result() == Kind::Number && i32::try_from(result).is_err() => {
            words.note(Note::Wide(result));
        }
        _ => {}
    }
}

fn arithmetic(functor: Functor, a: i64, b: i64) -> Option<i64> {
    match functor {
        Functor::Add | Functor::AddDecimals => a.checked_add(b),
        Functor::Subtract | Functor::SubtractDecimals => a.checked_sub(b),
        Functor::MultiplyDecimals => decimal::product(a, b),
        Functor::DivideDecimals => decimal::quotient(a, b),
        Functor::PowerOfDecimals => decimal::power(a, b),
        Functor::Multiply => a.checked_mul(b),
        Functor::Divide => a.checked_div(b),
        Functor::Remainder => a.checked_rem(b),
        // What is less than one is none, as Soufflé's whole numbers are cut.
        Functor::Power if b < 0 => match a {
            0 => None,
            1 => Some(1),
            -1 => Some(if b % 2 == 0 { 1 } else { -1 }),
            _ => Some(0),
        },
        Functor::Power => a.checked_pow(u32::try_from(b).ok()?),
        Functor::Smaller | Functor::SmallerOfDecimals => Some(a.min(b)),
        Functor::Larger | Functor::LargerOfDecimals => Some(a.max(b)),
        Functor::BitAnd => Some(a & b),
        Functor::BitOr => Some(a | b),
        Functor::BitXor => Some(a ^ b),
        // The places to shift go round, as a processor's do.
        Functor::ShiftLeft => Some(a.wrapping_shl(b as u32)),
        Functor::ShiftRight => Some(a.wrapping_shr(b as u32)),
        Functor::ShiftRightUnsigned => Some((a as u64).wrapping_shr(b as u32) as i64),
        Functor::LogicalAnd | Functor::LogicalAndUnsigned => Some(i64::from(a != 0 && b != 0)),
        Functor::LogicalOr | Functor::LogicalOrUnsigned => Some(i64::from(a != 0 || b != 0)),
        Functor::LogicalXor | Functor::LogicalXorUnsigned => Some(i64::from((a != 0) != (b != 0))),
        Functor::AddUnsigned => Some(round(a.wrapping_add(b))),
        Functor::SubtractUnsigned => Some(round(a.wrapping_sub(b))),
        Functor::MultiplyUnsigned => Some(round(a.wrapping_mul(b))),
        Functor::DivideUnsigned => a.checked_div(b),
        Functor::RemainderUnsigned => a.checked_rem(b),
        Functor::PowerUnsigned => Some(i64::from((a as u32).wrapping_pow(b as u32))),
        Functor::SmallerUnsigned => Some(a.min(b)),
        Functor::LargerUnsigned => Some(a.max(b)),
        Functor::BitAndUnsigned => Some(a & b),
        Functor::BitOrUnsigned => Some(a | b),
        Functor::BitXorUnsigned => Some(a ^ b),
        Functor::ShiftLeftUnsigned => Some(round(a << (b & 31))),
        Functor::ShiftRightOfUnsigned | Functor::ShiftRightUnsignedOfUnsigned => {
            Some(round(a >> (b & 31)))
        }
        _ => None,
    }
}

fn text(expr: &Expr, variable: &impl Fn(VariableId) -> Word, words: &mut Words) -> Option<String> {
    let (functor, args) = match expr {
        Expr::Variable(v) => return Some(words.text(variable(*v)).to_string()),
        Expr::Constant(word) => return Some(words.text(*word).to_string()),
        Expr::Call(functor, args) => (*functor, args.as_slice()),
    };
    match (functor, args) {
        (Functor::Concatenate | Functor::AddTexts, [a, b]) => {
            let joined = text(a, variable, words)? + &text(b, variable, words)?;
            if joined.len() > MAX_TEXT {
                words.note(Note::LongText);
                return None;
            }
            Some(joined)
        }
        (Functor::Part, [whole, from, length]) => {
            let whole = text(whole, variable, words)?;
            let (from, length) = (number(from, variable, words)?, number(length, variable, words)?);
            // Outside of the text there is nothing, and a negative length is all there is, as in Soufflé.
            let Ok(from) = usize::try_from(from) else { return Some(String::new()) };
            let length = usize::try_from(length).unwrap_or(usize::MAX);
            Some(whole.chars().skip(from).take(length).collect())
        }
        (Functor::Field, _) => {
            let word = compute(expr, variable, words)?;
            Some(words.text(word).to_string())
        }
        (Functor::SmallerText, [a, b]) => {
            Some(text(a, variable, words)?.min(text(b, variable, words)?))
        }
        (Functor::LargerText, [a, b]) => {
            Some(text(a, variable, words)?.max(text(b, variable, words)?))
        }
        (Functor::ToText | Functor::UnsignedToText, [a]) => {
            number(a, variable, words).map(|number| number.to_string())
        }
        (Functor::TextToText, [a]) => text(a, variable, words),
        (Functor::DecimalToText, [a]) => {
            // With all six digits, as Soufflé's to_string gives them.
            number(a, variable, words).map(|number| Decimal::from_millionths(number).six_digits())
        }
        _ => None,
    }
}

/// The numbers of a range, as Soufflé counts them: a step of none gives the first number alone.
#[derive(Debug, Clone, Copy)]
pub(super) struct Numbers {
    from: i64,
    step: i64,
    count: u64,
}

impl Numbers {
    pub(super) fn contains(self, number: i64) -> bool {
        let far = i128::from(number) - i128::from(self.from);
        let step = i128::from(self.step);
        match step {
            0 => self.count > 0 && far == 0,
            _ => far % step == 0 && (0..i128::from(self.count)).contains(&(far / step)),
        }
    }

    pub(super) fn iter(self) -> impl Iterator<Item = i64> {
        // The last is within the bounds, so what wraps on the way comes back.
        (0..self.count).map(move |n| self.from.wrapping_add((n as i64).wrapping_mul(self.step)))
    }
}

/// None where a bound has no value.
pub(super) fn numbers(
    bounds: &Bounds,
    variable: &impl Fn(VariableId) -> Word,
    words: &mut Words,
) -> Option<Numbers> {
    let from = number(&bounds.from, variable, words)?;
    let to = number(&bounds.to, variable, words)?;
    let step = match &bounds.step {
        Some(step) => number(step, variable, words)?,
        None if from <= to => bounds.unit,
        None => -bounds.unit,
    };
    let far = i128::from(to) - i128::from(from);
    let count = match i128::from(step) {
        0 => i128::from(far != 0),
        step if far.signum() != step.signum() => 0,
        step => (far.abs() + step.abs() - 1) / step.abs(),
    };
    let count = u64::try_from(count).expect("two numbers of 64 bits are less than 2^64 apart");
    Some(Numbers { from, step, count })
}

/// Whether two words of one kind compare so.
pub(super) fn holds(op: Comparison, is_number: bool, a: Word, b: Word, words: &Words) -> bool {
    match op {
        Comparison::Equal => a == b,
        Comparison::NotEqual => a != b,
        Comparison::Contains => words.text(b).contains(words.text(a).as_ref()),
        Comparison::Matches => is_match(a, b, words) == Some(true),
        Comparison::NotMatches => is_match(a, b, words) == Some(false),
        Comparison::NotContains => !words.text(b).contains(words.text(a).as_ref()),
        _ => is_ordered(op, order(is_number, a, b, words)),
    }
}

#[cold]
fn is_match(pattern: Word, text: Word, words: &Words) -> Option<bool> {
    super::regular::matches(words.text(pattern), words.text(text))
}

fn order(is_number: bool, a: Word, b: Word, words: &Words) -> Ordering {
    if !is_number {
        words.text(a).cmp(words.text(b))
    } else if is_in_place(a) && is_in_place(b) {
        a.cmp(&b)
    } else {
        words.to_number(a).cmp(&words.to_number(b))
    }
}

pub(super) fn is_ordered(op: Comparison, order: Ordering) -> bool {
    match op {
        Comparison::Less => order.is_lt(),
        Comparison::LessOrEqual => order.is_le(),
        Comparison::Greater => order.is_gt(),
        Comparison::GreaterOrEqual => order.is_ge(),
        Comparison::Equal => order.is_eq(),
        Comparison::NotEqual => order.is_ne(),
        Comparison::Contains
        | Comparison::NotContains
        | Comparison::Matches
        | Comparison::NotMatches => false,
    }
}
