//! Exact decimals with six digits after the point: what `float` columns hold.
//!
//! Soufflé's `float` is binary, so that 0.1 + 0.2 is not 0.3 there; here equal decimals are equal, and a tuple
//! stays comparable word by word. Sums, differences, negations and comparisons are exact; a product, a quotient
//! or a mean is rounded to the nearest millionth, halves away from zero.

use std::fmt;
use std::str::FromStr;

use crate::units::Fault;

/// A decimal in millionths.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct Decimal(i64);

/// Millionths in one.
pub(super) const ONE: i64 = 1_000_000;
const DIGITS: usize = 6;

impl Decimal {
    #[must_use]
    pub fn from_millionths(millionths: i64) -> Self {
        Self(millionths)
    }

    /// The decimal that a number with a power of ten stands for, `1.5e3`, where six digits after the point are enough.
    pub(super) fn of_powers(text: &str) -> Option<Self> {
        let (digits, power) = text.split_once(['e', 'E'])?;
        let power: i32 = power.parse().ok()?;
        let (minus, digits) = match digits.strip_prefix('-') {
            Some(rest) => ("-", rest),
            None => ("", digits.strip_prefix('+').unwrap_or(digits)),
        };
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        const MOST: usize = 32;
        if whole.is_empty()
            || whole.len() + fraction.len() > MOST
            || power.unsigned_abs() as usize > MOST
        {
            return None;
        }
        // The point moves over digits, and over zeros where there are none.
        let zeros = "0".repeat(MOST);
        let all = format!("{zeros}{whole}{fraction}{zeros}");
        let point = usize::try_from(i32::try_from(MOST + whole.len()).ok()? + power).ok()?;
        let (whole, fraction) = all.split_at_checked(point)?;
        let whole = whole.trim_start_matches('0');
        format!("{minus}{}.{fraction}", if whole.is_empty() { "0" } else { whole }).parse().ok()
    }

    /// The nearest decimal to a text of digits, a point and more than six digits, halves away from zero.
    pub(super) fn rounded(text: &str) -> Option<Self> {
        let (whole, fraction) = text.split_once('.')?;
        let (near, far) = fraction.split_at_checked(DIGITS)?;
        let Self(below) = format!("{whole}.{near}").parse().ok()?;
        let is_up = far.bytes().all(|byte| byte.is_ascii_digit()) && far >= "5";
        below.checked_add(i64::from(is_up)).map(Self)
    }

    #[must_use]
    pub fn millionths(self) -> i64 {
        self.0
    }
}

/// What is no decimal number of at most six digits after the point within ±9.2 · 10^12.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Fault)]
#[fault(code = "facts::no_decimal")]
pub struct NoDecimal;

impl FromStr for Decimal {
    type Err = NoDecimal;

    fn from_str(text: &str) -> Result<Self, NoDecimal> {
        let (minus, digits) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text.strip_prefix('+').unwrap_or(text)),
        };
        let (whole, fraction) = digits.split_once('.').unwrap_or((digits, ""));
        let fraction = fraction.trim_end_matches('0');
        let all_digits = |text: &str| text.bytes().all(|byte| byte.is_ascii_digit());
        if whole.is_empty()
            || !all_digits(whole)
            || !all_digits(fraction)
            || fraction.len() > DIGITS
        {
            return Err(NoDecimal);
        }
        let number = format!("{}{whole}{fraction:0<DIGITS$}", if minus { "-" } else { "" });
        number.parse().ok().map(Self).ok_or(NoDecimal)
    }
}

impl Decimal {
    /// With all six digits behind the point.
    pub(super) fn six_digits(self) -> String {
        let (minus, all) = (if self.0 < 0 { "-" } else { "" }, self.0.unsigned_abs());
        format!("{minus}{}.{:0DIGITS$}", all / ONE as u64, all % ONE as u64)
    }
}

/// Without zeros at the end, and without a point where nothing follows it, as Soufflé writes them.
impl fmt::Display for Decimal {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let (minus, all) = (if self.0 < 0 { "-" } else { "" }, self.0.unsigned_abs());
        let (whole, rest) = (all / ONE as u64, all % ONE as u64);
        if rest == 0 {
            return write!(f, "{minus}{whole}");
        }
        write!(f, "{minus}{whole}.{}", format!("{rest:0DIGITS$}").trim_end_matches('0'))
    }
}

/// The quotient rounded to the nearest whole, halves away from zero; none beyond `i64` and for division by zero.
pub(super) fn rounded(dividend: i128, divisor: i128) -> Option<i64> {
    let quotient = dividend.checked_div(divisor)?;
    let rest = dividend % divisor;
    let away = if (dividend < 0) == (divisor < 0) { 1 } else { -1 };
    let is_far = rest.unsigned_abs() * 2 >= divisor.unsigned_abs();
    i64::try_from(if is_far { quotient + away } else { quotient }).ok()
}

pub(super) fn product(a: i64, b: i64) -> Option<i64> {
    rounded(i128::from(a) * i128::from(b), ONE.into())
}

pub(super) fn quotient(a: i64, b: i64) -> Option<i64> {
    rounded(i128::from(a) * i128::from(ONE), b.into())
}

/// A power, rounded to the nearest millionth: a whole one by repeated squaring, any other as a binary fraction has it.
/// None where there is none, as of a negative base.
pub(super) fn power(base: i64, exponent: i64) -> Option<i64> {
    if exponent % ONE != 0 {
        let of = |millionths: i64| millionths as f64 / ONE as f64;
        let millionths = (of(base).powf(of(exponent)) * ONE as f64).round();
        // Past 2^53 a binary fraction no longer tells millionths apart.
        return (millionths.abs() < (1_i64 << 53) as f64).then_some(millionths as i64);
    }
    let (mut left, mut square, mut result) = ((exponent / ONE).unsigned_abs(), base, ONE);
    while left > 0 {
        if left & 1 == 1 {
            result = product(result, square)?;
        }
        left >>= 1;
        if left > 0 {
            square = product(square, square)?;
        }
    }
    if exponent < 0 { quotient(ONE, result) } else { Some(result) }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_return_as_they_went() {
        for text in ["0", "1.5", "-2.25", "0.000001", "-0.5", "1000000.1"] {
            assert_eq!(text.parse::<Decimal>().unwrap().to_string(), text);
        }
        assert_eq!("+3.50".parse::<Decimal>().unwrap().to_string(), "3.5");
        for text in ["", ".", "1.2.3", "1e3", "0.0000001", "9999999999999", "-", "--1", "1.-5"] {
            assert_eq!(text.parse::<Decimal>(), Err(NoDecimal), "{text}");
        }
    }

    #[test]
    fn longer_texts_are_rounded() {
        let of = |text: &str| Decimal::rounded(text).map(|decimal| decimal.to_string());
        assert_eq!(of("3.14159265").as_deref(), Some("3.141593"));
        assert_eq!(of("0.9999995").as_deref(), Some("1"));
        assert_eq!(of("0.00000049").as_deref(), Some("0"));
        assert_eq!((of("99999999999999.1234567"), of("1.5")), (None, None));
        let of = |text: &str| Decimal::of_powers(text).map(|decimal| decimal.to_string());
        assert_eq!(of("1.5e3").as_deref(), Some("1500"));
        assert_eq!(of("-25E-3").as_deref(), Some("-0.025"));
        assert_eq!(of("0.5e+01").as_deref(), Some("5"));
        assert_eq!(
            (of("1e-7"), of("1e20"), of("e3"), of("1.2.3e1"), of("1e99999")),
            (None, None, None, None, None)
        );
    }

    #[test]
    fn results_are_rounded_to_the_nearest_millionth() {
        let of = |text: &str| text.parse::<Decimal>().unwrap().millionths();
        assert_eq!(product(of("1.5"), of("-0.5")), Some(of("-0.75")));
        assert_eq!(quotient(of("1"), of("3")), Some(333_333));
        assert_eq!(quotient(of("-2"), of("3")), Some(-666_667));
        assert_eq!(quotient(of("1"), 0), None);
        assert_eq!(power(of("2.5"), of("3")), Some(of("15.625")));
        assert_eq!(power(of("2"), of("-2")), Some(of("0.25")));
        assert_eq!(power(of("2"), of("0.5")), Some(of("1.414214")));
        assert_eq!(power(of("4"), of("-0.5")), Some(of("0.5")));
        assert_eq!((power(of("-2"), of("0.5")), power(of("1000"), of("9"))), (None, None));
        assert_eq!(power(0, of("-0.5")), None);
    }
}
