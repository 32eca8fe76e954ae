//! Every functor and aggregate over every kind of number, against an evaluation of its own: exact in 128 bits, in
//! millionths for decimals, modulo 2^32 for unsigned numbers; with equations between, before and after, and within
//! aggregates. A value must come out the same however the equations carry it.

use std::fmt::Write;

use orthoframe_facts::{Decimal, Program, Value};
use orthoframe_units::Source;

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Kind {
    Number,
    Unsigned,
    Float,
}

const KINDS: [Kind; 3] = [Kind::Number, Kind::Unsigned, Kind::Float];
const ONE: i128 = 1_000_000;

impl Kind {
    fn name(self) -> &'static str {
        match self {
            Self::Number => "number",
            Self::Unsigned => "unsigned",
            Self::Float => "float",
        }
    }

    /// Small values of the kind; of decimals in millionths.
    fn values(self) -> &'static [i128] {
        match self {
            Self::Number => &[-7, -2, -1, 0, 1, 2, 3, 40, 2_147_483_647],
            Self::Unsigned => &[0, 1, 2, 3, 7, 40, 4_294_967_295],
            Self::Float => &[-2_500_000, -1_000_000, 0, 500_000, 1_000_000, 2_000_000, 3_250_000],
        }
    }

    fn text(self, value: i128) -> String {
        match self {
            Self::Float => Decimal::from_millionths(value as i64).to_string(),
            _ => value.to_string(),
        }
    }

    /// What fits the kind; none for an overflow.
    fn fit(self, value: i128) -> Option<i128> {
        match self {
            Self::Unsigned => Some(value.rem_euclid(1 << 32)),
            _ => i64::try_from(value).ok().map(i128::from),
        }
    }
}

/// The nearest whole number, halves away from zero.
fn nearest(dividend: i128, divisor: i128) -> i128 {
    let (quotient, rest) = (dividend / divisor, dividend % divisor);
    let away = if (dividend < 0) == (divisor < 0) { 1 } else { -1 };
    if rest.abs() * 2 >= divisor.abs() { quotient + away } else { quotient }
}

fn power(kind: Kind, base: i128, exponent: i128) -> Option<i128> {
    let (exponent, one) = match kind {
        Kind::Float if exponent % ONE != 0 => return None,
        Kind::Float => (exponent / ONE, ONE),
        _ => (exponent, 1),
    };
    if kind == Kind::Unsigned {
        let modulus = 1_i128 << 32;
        let (mut result, mut square, mut left) = (1, base, exponent);
        while left > 0 {
            if left % 2 == 1 {
                result = result * square % modulus;
            }
            square = square * square % modulus;
            left /= 2;
        }
        return Some(result);
    }
    if exponent < 0 {
        return match kind {
            Kind::Float => None,
            _ if base == 0 => None,
            _ if base.abs() == 1 => Some(if exponent % 2 == 0 { 1 } else { base }),
            _ => Some(0),
        };
    }
    let mut result = one;
    if base.abs() > one || one > 1 {
        for _ in 0..exponent {
            result =
                if one > 1 { nearest(result * base, ONE) } else { result.checked_mul(base)? };
            kind.fit(result)?;
        }
        return Some(result);
    }
    // 0, 1 or -1.
    let is_one = exponent == 0 || base == -1 && exponent % 2 == 0;
    Some(if is_one { 1 } else { base })
}

/// The value of `a op b`; none where there is none.
fn binary(kind: Kind, op: &str, a: i128, b: i128) -> Option<i128> {
    let whole = kind != Kind::Float;
    let value = match op {
        "+" => a + b,
        "-" => a - b,
        "*" if whole => a * b,
        "*" => nearest(a * b, ONE),
        "/" if b == 0 => return None,
        "/" if whole => a / b,
        "/" => nearest(a * ONE, b),
        "%" if b == 0 => return None,
        "%" => a % b,
        "^" => return power(kind, a, b).and_then(|value| kind.fit(value)),
        "min" => a.min(b),
        "max" => a.max(b),
        "band" => a & b,
        "bor" => a | b,
        "bxor" => a ^ b,
        "land" => i128::from(a != 0 && b != 0),
        "lor" => i128::from(a != 0 || b != 0),
        "lxor" => i128::from((a != 0) != (b != 0)),
        "bshl" if kind == Kind::Unsigned => a << (b & 31),
        "bshr" | "bshru" if kind == Kind::Unsigned => a >> (b & 31),
        other => unreachable!("{other}"),
    };
    kind.fit(value)
}

const INFIX: [&str; 14] =
    ["+", "-", "*", "/", "%", "^", "band", "bor", "bxor", "land", "lor", "lxor", "bshl", "bshr"];

fn is_of(kind: Kind, op: &str) -> bool {
    match op {
        "+" | "-" | "*" | "/" | "min" | "max" => true,
        // Decimals are raised by rounding at each step of another order.
        "^" => kind != Kind::Float,
        "bshl" | "bshr" => kind == Kind::Unsigned,
        _ => kind != Kind::Float,
    }
}

/// The rows of a relation, sorted, as texts.
fn rows(text: &str, relation: &str) -> Vec<Vec<String>> {
    let program = Program::parse(&Source::new("t.dl", text))
        .unwrap_or_else(|faults| panic!("{faults}\n{text}"));
    let derived = program.evaluate(&program.database()).unwrap();
    let rows = derived.sorted(relation).unwrap();
    rows.iter().map(|row| row.iter().map(Value::to_string).collect()).collect()
}

#[test]
fn every_functor_over_every_kind_of_number() {
    for kind in KINDS {
        let name = kind.name();
        for op in INFIX.into_iter().chain(["min", "max"]).filter(|op| is_of(kind, op)) {
            let call = |a: &str, b: &str| match op {
                "min" | "max" => format!("{op}({a}, {b})"),
                _ => format!("{a} {op} {b}"),
            };
            let mut text = format!(
                ".decl v(x: {name})\n.decl r(way: number, a: {name}, b: {name}, c: {name}) .output r\n"
            );
            for value in kind.values() {
                let _ = writeln!(text, "v({}).", kind.text(*value));
            }
            // The value in the head, by an equation, by two of them either way round, tested, and taken apart.
            let _ = writeln!(text, "r(0, a, b, {}) :- v(a), v(b).", call("a", "b"));
            let _ = writeln!(text, "r(1, a, b, c) :- v(a), v(b), c = {}.", call("a", "b"));
            let _ = writeln!(
                text,
                "r(2, a, b, c) :- {} = d, d = c, x = a, y = b, v(x), v(y).",
                call("x", "y")
            );
            let _ = writeln!(
                text,
                "r(3, a, b, c) :- r(0, a, b, c), v(a), v(b), c = {}.",
                call("a", "b")
            );
            let _ = writeln!(
                text,
                "r(4, a, b, c) :- v(a), v(b), c = max z : {{ z = y, y = {}, u = a, v(u) }}.",
                call("u", "b")
            );
            let mut expected = Vec::new();
            for a in kind.values() {
                for b in kind.values() {
                    if let Some(c) = binary(kind, op, *a, *b) {
                        for way in 0..5 {
                            let texts = [*a, *b, c].map(|value| kind.text(value));
                            expected.push([vec![way.to_string()], texts.to_vec()].concat());
                        }
                    }
                }
            }
            let mut found = rows(&text, "r");
            expected.sort();
            found.sort();
            assert_eq!(found, expected, "{name} {op}");
        }
    }
}

#[test]
fn every_aggregate_over_every_kind_of_number_with_equations_within() {
    for kind in KINDS {
        let name = kind.name();
        let one = kind.text(if kind == Kind::Float { ONE } else { 1 });
        // Small enough that no sum goes round.
        let values: Vec<i128> = kind.values().iter().copied().filter(|v| *v < 1 << 30).collect();
        let mut text = format!(".decl v(x: {name})\n");
        for value in &values {
            let _ = writeln!(text, "v({}).", kind.text(*value));
        }
        let shift = if kind == Kind::Float { ONE } else { 1 };
        let sum: i128 = values.iter().map(|value| value + shift).sum();
        let count = values.len() as i128;
        let mean = match kind {
            Kind::Float => nearest(sum, count),
            _ => sum / count,
        };
        let shifted = values.iter().map(|value| value + shift);
        for (function, value) in [
            ("sum", sum),
            ("mean", mean),
            ("min", shifted.clone().min().unwrap()),
            ("max", shifted.clone().max().unwrap()),
        ] {
            let bodies = [
                format!("y = {function} x : {{ x = z + {one}, v(z) }}"),
                format!("y = {function} x : {{ v(z), z + 1 = w, w = x }}"),
                format!("{function} z + {one} : {{ v(z) }} = u, u = y"),
                format!("y = {function} x : {{ v(z), x = max w : {{ w = z + 1 }} }}"),
                format!("y = {function} x : {{ v(z), a = 1, x = z + a }}"),
            ];
            for body in bodies {
                let text = format!("{text}.decl r(y: {name}) .output r\nr(y) :- {body}.\n");
                assert_eq!(rows(&text, "r"), [[kind.text(value)]], "{name}: {body}");
            }
            let body = format!("c = count : {{ v(z), z >= {} }}", kind.text(values[0]));
            let text = format!("{text}.decl r(y: number) .output r\nr(c) :- {body}.\n");
            assert_eq!(rows(&text, "r"), [[count.to_string()]], "{name}: {body}");
        }
    }
}
