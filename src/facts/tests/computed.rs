//! Every functor and aggregate over every kind of value, against an evaluation of its own: exact in 128 bits, in
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

/// A value as a program writes it.
type Written = String;

fn numbers(kind: Kind, values: &[i128]) -> Vec<Written> {
    values.iter().map(|value| kind.text(*value)).collect()
}

fn texts(values: &[&str]) -> Vec<Written> {
    values.iter().map(|text| format!("\"{text}\"")).collect()
}

/// That a call of a functor has the values expected, whatever way they go: into the head, by an equation, by two, tested.
fn check(
    call: &str,
    result: &str,
    args: &[(&str, &[Written])],
    expected: &dyn Fn(&[usize]) -> Option<String>,
) {
    let mut text = String::new();
    let (mut numbers, mut body, mut called) = (String::new(), String::new(), call.to_owned());
    for (n, (kind, values)) in args.iter().enumerate() {
        let _ = writeln!(text, ".decl v{n}(i: number, x: {kind})");
        for (i, value) in values.iter().enumerate() {
            let _ = writeln!(text, "v{n}({i}, {}).", value);
        }
        let _ = write!(numbers, "i{n}, ");
        let _ = write!(body, "v{n}(i{n}, x{n}), ");
        called = called.replace(&format!("${n}"), &format!("x{n}"));
    }
    let columns: Vec<String> = (0..args.len()).map(|n| format!("i{n}: number")).collect();
    let columns = columns.join(", ");
    let _ = writeln!(text, ".decl r(way: number, {columns}, c: {result}) .output r");
    let open = body.trim_end_matches(", ");
    let _ = writeln!(text, "r(0, {numbers}{called}) :- {open}.");
    let _ = writeln!(text, "r(1, {numbers}c) :- {body}c = {called}.");
    let _ = writeln!(text, "r(2, {numbers}c) :- {called} = d, {body}d = c.");
    let _ = writeln!(text, "r(3, {numbers}c) :- r(0, {numbers}c), {body}{called} = c.");
    let mut wanted = Vec::new();
    let mut at = vec![0; args.len()];
    loop {
        if let Some(value) = expected(&at) {
            for way in 0..4 {
                let mut row = vec![way.to_string()];
                row.extend(at.iter().map(usize::to_string));
                row.push(value.clone());
                wanted.push(row);
            }
        }
        let Some(next) = (0..at.len()).find(|n| at[*n] + 1 < args[*n].1.len()) else { break };
        at[next] += 1;
        at[..next].fill(0);
    }
    let mut found = rows(&text, "r");
    found.sort();
    wanted.sort();
    assert_eq!(found, wanted, "{call}: {result}\n{text}");
}

const WORD: i128 = 1 << 32;
const WIDE: i128 = 1 << 64;

/// The 64 bits of a number as one with a sign.
fn signed(value: i128) -> i128 {
    let value = value.rem_euclid(WIDE);
    if value >= WIDE / 2 { value - WIDE } else { value }
}

#[test]
fn every_functor_of_one_number_and_every_shift() {
    for kind in KINDS {
        let (name, values) = (kind.name(), kind.values());
        let given = numbers(kind, values);
        let one = |call: &str, value: &dyn Fn(i128) -> i128| {
            check(call, name, &[(name, &given)], &|at| {
                kind.fit(value(values[at[0]])).map(|value| kind.text(value))
            });
        };
        one("-$0", &|a| -a);
        if kind != Kind::Float {
            one("bnot $0", &|a| -1 - a);
            one("lnot $0", &|a| i128::from(a == 0));
        }
    }
    let values = [1 - WIDE / 2, -7, -1, 0, 1, 40, i128::from(i64::MAX)];
    let places = [0, 1, 5, 31, 32, 63, 64, 65];
    let given = numbers(Kind::Number, &values);
    let by = numbers(Kind::Number, &places);
    let args: [(&str, &[Written]); 2] = [("number", &given), ("number", &by)];
    let shift = |call: &str, value: &dyn Fn(i128, i128) -> i128| {
        check(call, "number", &args, &|at| {
            Some(signed(value(values[at[0]], 1 << (places[at[1]] % 64))).to_string())
        });
    };
    shift("$0 bshl $1", &|a, by| a.wrapping_mul(by));
    shift("$0 bshr $1", &i128::div_euclid);
    shift("$0 bshru $1", &|a, by| a.rem_euclid(WIDE) / by);
    let (values, places) = ([0, 1, 40, WORD - 1], [0, 1, 31, 32, 33]);
    let given = numbers(Kind::Unsigned, &values);
    let by = numbers(Kind::Unsigned, &places);
    for (call, is_left) in [("$0 bshl $1", true), ("$0 bshr $1", false), ("$0 bshru $1", false)] {
        check(call, "unsigned", &[("unsigned", &given), ("unsigned", &by)], &|at| {
            let (a, by) = (values[at[0]], 1 << (places[at[1]] % 32));
            Some(if is_left { a * by % WORD } else { a / by }.to_string())
        });
    }
    let (bases, exponents) = ([-2_500_000, -ONE, 0, 500_000, ONE, 3 * ONE], [0, 1, 2, 3, 5]);
    let given = numbers(Kind::Float, &bases);
    let by = numbers(Kind::Float, &exponents.map(|n| n * ONE));
    check("$0 ^ $1", "float", &[("float", &given), ("float", &by)], &|at| {
        // All of these are exact.
        let value = (0..exponents[at[1]]).fold(ONE, |value, _| value * bases[at[0]] / ONE);
        Some(Kind::Float.text(value))
    });
}

/// From each kind to each other: towards zero, modulo 2^32 from whole numbers to unsigned ones and back as the same bits;
/// none where a value has no place.
#[test]
fn every_conversion() {
    let wide = [1 - WIDE / 2, -WORD, -3, 0, 7, WORD - 1, WORD + 5, i128::from(i64::MAX)];
    let parts = [-5_000_000_000 * ONE, -2_750_000, -1, 0, 999_999, 3 * ONE, 5_000_000_000 * ONE];
    let short = [0, 1, WORD / 2 - 1, WORD / 2, WORD - 1];
    let fits = |kind: Kind, value: i128| kind.fit(value).map(|value| kind.text(value));
    let of = |kind, values: &[i128], to: &str, value: &dyn Fn(i128) -> Option<String>| {
        let given = numbers(kind, values);
        let result = match to {
            "string" => "symbol",
            to => to,
        };
        let call = format!("to_{to}($0)");
        check(&call, result, &[(kind.name(), &given)], &|at| value(values[at[0]]));
    };
    let (number, unsigned, float) = (Kind::Number, Kind::Unsigned, Kind::Float);
    of(number, &wide, "number", &|a| Some(a.to_string()));
    of(number, &wide, "unsigned", &|a| Some(a.rem_euclid(WORD).to_string()));
    of(number, &wide, "float", &|a| fits(float, a * ONE));
    of(number, &wide, "string", &|a| Some(a.to_string()));
    of(unsigned, &short, "number", &|a| Some(if a >= WORD / 2 { a - WORD } else { a }.to_string()));
    of(unsigned, &short, "unsigned", &|a| Some(a.to_string()));
    of(unsigned, &short, "float", &|a| fits(float, a * ONE));
    of(unsigned, &short, "string", &|a| Some(a.to_string()));
    of(float, &parts, "number", &|a| Some((a / ONE).to_string()));
    of(float, &parts, "unsigned", &|a| {
        Some(a / ONE).filter(|a| (0..WORD).contains(a)).map(|a| a.to_string())
    });
    of(float, &parts, "float", &|a| fits(float, a));
    of(float, &parts, "string", &|a| {
        let sign = if a < 0 { "-" } else { "" };
        Some(format!("{sign}{}.{:06}", a.abs() / ONE, a.abs() % ONE))
    });
    let said = ["12", "-7", " 5 ", "1.5", "0x1F", "-0b11", "4294967296", "", "seven", "1e3", "--1"];
    let given = texts(&said);
    let args: [(&str, &[Written]); 1] = [("symbol", &given)];
    let whole = [Some(12), Some(-7), Some(5), None, Some(31), Some(-3), Some(WORD)];
    let whole = |at: usize| whole.get(at).copied().flatten();
    check("to_number($0)", "number", &args, &|at| whole(at[0]).map(|a| a.to_string()));
    check("to_unsigned($0)", "unsigned", &args, &|at| {
        whole(at[0]).filter(|a| (0..WORD).contains(a)).map(|a| a.to_string())
    });
    let decimals = [Some("12"), Some("-7"), Some("5"), Some("1.5"), None, None, Some("4294967296")];
    check("to_float($0)", "float", &args, &|at| {
        decimals.get(at[0]).copied().flatten().map(str::to_owned)
    });
    check("to_string($0)", "symbol", &args, &|at| Some(said[at[0]].to_owned()));
}

#[test]
fn every_functor_of_texts() {
    let said = ["", "a", "стол", "abc", "b", "ол"];
    let given = texts(&said);
    let one: [(&str, &[Written]); 1] = [("symbol", &given)];
    let two: [(&str, &[Written]); 2] = [("symbol", &given), ("symbol", &given)];
    let three: [(&str, &[Written]); 3] = [two[0], two[1], ("symbol", &given[..3])];
    check("strlen($0)", "number", &one, &|at| {
        Some(said[at[0]].char_indices().map(|_| 1).sum::<usize>().to_string())
    });
    for call in ["cat($0, $1)", "$0 + $1"] {
        check(call, "symbol", &two, &|at| Some([said[at[0]], said[at[1]]].concat()));
    }
    check("cat($0, $1, $2)", "symbol", &three, &|at| Some(at.iter().map(|at| said[*at]).collect()));
    let chosen = |at: &[usize], is_least: bool| {
        let mut sorted: Vec<&str> = at.iter().map(|at| said[*at]).collect();
        sorted.sort_by(|a, b| a.bytes().cmp(b.bytes()));
        let at = if is_least { 0 } else { sorted.len() - 1 };
        Some(sorted[at].to_owned())
    };
    check("min($0, $1)", "symbol", &two, &|at| chosen(at, true));
    check("max($0, $1, $2)", "symbol", &three, &|at| chosen(at, false));
    let places = [-1, 0, 1, 3, 9];
    let places_given = numbers(Kind::Number, &places);
    let args: [(&str, &[Written]); 3] =
        [one[0], ("number", &places_given), ("number", &places_given)];
    check("substr($0, $1, $2)", "symbol", &args, &|at| {
        let (from, length) = (places[at[1]], places[at[2]]);
        let letters = said[at[0]].chars().enumerate();
        let inside = |n: usize| {
            let n = n as i128;
            from >= 0 && n >= from && (length < 0 || n < from + length)
        };
        Some(letters.filter(|(n, _)| inside(*n)).map(|(_, letter)| letter).collect())
    });
    // Each text has its own number.
    let mut text = String::from(".decl v(x: symbol) .decl r(x: symbol, y: symbol) .output r\n");
    for value in &given {
        let _ = writeln!(text, "v({value}).");
    }
    text += "r(x, y) :- v(x), v(y), ord(x) = ord(y).\n";
    assert!(rows(&text, "r").iter().all(|row| row[0] == row[1]));
    assert_eq!(rows(&text, "r").len(), said.len());
    // Patterns fit whole texts.
    let patterns = ["", ".*", "a.*", "[a-b]", "ст?ол|b", "x*"];
    let fits: [&dyn Fn(&str) -> bool; 6] = [
        &str::is_empty,
        &|_| true,
        &|text| text.starts_with('a'),
        &|text| matches!(text, "a" | "b"),
        &|text| matches!(text, "сол" | "стол" | "b"),
        &|text| text.chars().all(|letter| letter == 'x'),
    ];
    let given_patterns = texts(&patterns);
    let both = |premise: &str, first: &[Written], holds: &dyn Fn(usize, usize) -> bool| {
        for (sign, wanted) in [("", true), ("!", false)] {
            let mut text = String::from(
                ".decl p(i: number, x: symbol) .decl v(i: number, x: symbol)\n.decl r(i: number, j: number) .output r\n",
            );
            for (name, values) in [("p", first), ("v", given.as_slice())] {
                for (i, value) in values.iter().enumerate() {
                    let _ = writeln!(text, "{name}({i}, {}).", value);
                }
            }
            let _ = writeln!(text, "r(i, j) :- p(i, x), v(j, y), {sign}{premise}(x, y).");
            let pairs = (0..first.len()).flat_map(|i| (0..given.len()).map(move |j| (i, j)));
            let expected: Vec<Vec<String>> = pairs
                .filter(|(i, j)| holds(*i, *j) == wanted)
                .map(|(i, j)| vec![i.to_string(), j.to_string()])
                .collect();
            assert_eq!(rows(&text, "r"), expected, "{sign}{premise}");
        }
    };
    both("match", &given_patterns, &|pattern, text| fits[pattern](said[text]));
    both("contains", &given, &|part, whole| {
        let (part, whole) = (said[part].as_bytes(), said[whole].as_bytes());
        part.is_empty() || whole.windows(part.len()).any(|window| window == part)
    });
}

/// Ranges over every kind of number, with and without a step, up and down: counted one by one.
#[test]
fn every_range() {
    for kind in KINDS {
        let unit = if kind == Kind::Float { ONE } else { 1 };
        let bounds: Vec<i128> = match kind {
            Kind::Unsigned => vec![0, 1, 4, 5],
            Kind::Number => vec![-3, 0, 1, 4],
            Kind::Float => vec![-500_000, 0, 250_000, 2 * ONE],
        };
        let steps: Vec<i128> = match kind {
            Kind::Unsigned => vec![0, 1, 2],
            Kind::Number => vec![-2, -1, 0, 1, 3],
            Kind::Float => vec![-750_000, 0, 250_000, ONE],
        };
        let name = kind.name();
        for step in steps.iter().map(|step| Some(*step)).chain([None]) {
            let mut text = format!(
                ".decl b(x: {name})\n.decl r(from: {name}, to: {name}, x: {name}) .output r\n"
            );
            for bound in numbers(kind, &bounds) {
                let _ = writeln!(text, "b({bound}).");
            }
            let call = match step {
                Some(step) => format!("range(a, b, {})", kind.text(step)),
                None => "range(a, b)".to_owned(),
            };
            let _ = writeln!(text, "r(a, b, x) :- b(a), b(b), x = {call}.");
            let mut expected = Vec::new();
            for from in &bounds {
                for to in &bounds {
                    let step = step.unwrap_or(if from <= to { unit } else { -unit });
                    let mut at = *from;
                    while if step < 0 { at > *to } else { at < *to } {
                        expected.push([*from, *to, at].map(|value| kind.text(value)).to_vec());
                        if step == 0 {
                            break;
                        }
                        at += step;
                    }
                    // A step of none gives the first number wherever the range is not empty, down too.
                    if step == 0 && from > to {
                        expected.push([*from, *to, *from].map(|value| kind.text(value)).to_vec());
                    }
                }
            }
            let mut found = rows(&text, "r");
            expected.sort();
            found.sort();
            assert_eq!(found, expected, "{name} {call}");
        }
    }
}
