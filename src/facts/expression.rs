//! Words to expressions: arithmetic, functors, aggregates.

use nom::Parser;
use nom::branch::alt;
use nom::combinator::opt;
use nom::sequence::{delimited, separated_pair};

use super::fault::RuleError;
use super::lex::{Token, Word};
use super::parse::{atom, disjunction};
use super::read::{Input, Read, decimal, list, long_name, name, number, sign, text, unsigned};
use super::syntax::{Aggregation, Body, Expr, Functor, Span};
use crate::units::{said, word};

/// Longer chains of operators are refused: their trees are walked by recursion.
const MAX_CHAIN: usize = 128;

pub(super) fn expression(input: Input<'_>) -> Read<'_, Expr> {
    let (mut rest, mut value) = sum(input)?;
    if bit_word(rest).is_some() {
        (rest, value) = bits(rest, value)?;
    }
    if depth(&value) > MAX_CHAIN {
        let at = value.at().into();
        return input.refuse(RuleError::TooLarge {
            what: word!("levels-of-an-expression"),
            limit: MAX_CHAIN,
            at,
        });
    }
    Ok((rest, value))
}

/// Levels of an expression; bounded, since what it is made of was measured before.
fn depth(expr: &Expr) -> usize {
    match expr {
        Expr::Call { args, .. } | Expr::Record { args, .. } => {
            1 + args.iter().map(depth).max().unwrap_or(0)
        }
        _ => 1,
    }
}

/// Soufflé's words between operands, the loosest first; the shifts bind equally.
const BITS: [(&str, Functor, u8); 9] = [
    ("lor", Functor::LogicalOr, 0),
    ("lxor", Functor::LogicalXor, 1),
    ("land", Functor::LogicalAnd, 2),
    ("bor", Functor::BitOr, 3),
    ("bxor", Functor::BitXor, 4),
    ("band", Functor::BitAnd, 5),
    ("bshl", Functor::ShiftLeft, 6),
    ("bshr", Functor::ShiftRight, 6),
    ("bshru", Functor::ShiftRightUnsigned, 6),
];

fn bit_word(input: Input<'_>) -> Option<(Input<'_>, Functor, u8)> {
    BITS.iter().find_map(|(word, functor, binds)| Some((operator(word, input)?, *functor, *binds)))
}

/// What stands behind the first operand of a word. One level for all words: brackets within brackets are deep enough.
fn bits(input: Input<'_>, first: Expr) -> Read<'_, Expr> {
    let (mut rest, mut value) = (input, first);
    let mut waiting: Vec<(Expr, Functor, u8)> = Vec::new();
    while let Some((behind, functor, binds)) = bit_word(rest) {
        if waiting.len() > MAX_CHAIN {
            let at = rest.at().into();
            return rest.refuse(RuleError::TooLarge {
                what: word!("operations-in-a-row"),
                limit: MAX_CHAIN,
                at,
            });
        }
        while let Some((left, before, _)) = waiting.pop_if(|(_, _, before)| *before >= binds) {
            value = joined(left, before, value);
        }
        waiting.push((value, functor, binds));
        (rest, value) = sum(behind)?;
    }
    while let Some((left, functor, _)) = waiting.pop() {
        value = joined(left, functor, value);
    }
    Ok((rest, value))
}

#[inline]
fn sum(input: Input<'_>) -> Read<'_, Expr> {
    chain(product, &[("+", Functor::Add), ("-", Functor::Subtract)], input)
}

fn joined(left: Expr, functor: Functor, right: Expr) -> Expr {
    let at = left.at().to(right.at());
    Expr::Call { functor, args: vec![left, right], at }
}

fn product(input: Input<'_>) -> Read<'_, Expr> {
    chain(
        power,
        &[("*", Functor::Multiply), ("/", Functor::Divide), ("%", Functor::Remainder)],
        input,
    )
}

/// Operands joined from the left by any of the operators.
fn chain<'a>(
    operand: impl Fn(Input<'a>) -> Read<'a, Expr>,
    operators: &[(&'static str, Functor)],
    input: Input<'a>,
) -> Read<'a, Expr> {
    let (mut input, mut left) = operand(input)?;
    for _ in 0..MAX_CHAIN {
        let next =
            operators.iter().find_map(|(word, functor)| Some((operator(word, input)?, *functor)));
        let Some((rest, functor)) = next else { return Ok((input, left)) };
        let (rest, right) = operand(rest)?;
        let at = left.at().to(right.at());
        left = Expr::Call { functor, args: vec![left, right], at };
        input = rest;
    }
    let at = input.at().into();
    input.refuse(RuleError::TooLarge { what: word!("operations-in-a-row"), limit: MAX_CHAIN, at })
}

/// What stands behind an operator: a sign, or a word between two operands.
fn operator<'a>(word: &'static str, input: Input<'a>) -> Option<Input<'a>> {
    if !word.starts_with(char::is_alphabetic) {
        return sign(word)(input).ok().map(|(rest, _)| rest);
    }
    match input.rest {
        [Token { word: Word::Name(name), .. }, rest @ ..] if name == word => {
            Some(Input { rest, ..input })
        }
        _ => None,
    }
}

/// What may stand before an operand: `-`, and Soufflé's words `bnot` and `lnot`. Two minuses are none.
fn prefixes(input: Input<'_>) -> Read<'_, Vec<(Functor, Span)>> {
    let mut input = input;
    let mut all: Vec<(Functor, Span)> = Vec::new();
    loop {
        let functor = match input.rest {
            [Token { word: Word::Sign("-"), .. }, ..] => Functor::Negate,
            [_, Token { word: Word::Sign("("), .. }, ..] => break,
            [Token { word: Word::Name(name), .. }, ..] if name == "bnot" => Functor::BitNot,
            [Token { word: Word::Name(name), .. }, ..] if name == "lnot" => Functor::LogicalNot,
            _ => break,
        };
        let at = input.at();
        let is_second = functor == Functor::Negate
            && all.last().is_some_and(|(before, _)| *before == Functor::Negate);
        if is_second {
            all.pop();
        } else if all.len() == MAX_CHAIN {
            let (what, limit, at) = (word!("operations-in-a-row"), MAX_CHAIN, at.into());
            return input.refuse(RuleError::TooLarge { what, limit, at });
        } else {
            all.push((functor, at));
        }
        input = Input { rest: &input.rest[1..], ..input };
    }
    Ok((input, all))
}

// a ^ b ^ c is a ^ (b ^ c), and -a ^ b is -(a ^ b), as in Soufflé.
fn power(input: Input<'_>) -> Read<'_, Expr> {
    let (mut input, prefixes) = prefixes(input)?;
    let mut operands = Vec::new();
    loop {
        // a ^ -b
        let (rest, operand) = match (operands.is_empty(), input.rest) {
            (false, [Token { word: Word::Sign("-"), at }, rest @ ..]) => {
                let (rest, value) = primary(Input { rest, ..input })?;
                (rest, negated(value, *at))
            }
            _ => primary(input)?,
        };
        operands.push(operand);
        if operands.len() > MAX_CHAIN {
            let at = input.at().into();
            return input.refuse(RuleError::TooLarge {
                what: word!("operations-in-a-row"),
                limit: MAX_CHAIN,
                at,
            });
        }
        input = rest;
        match sign("^")(input) {
            Ok((rest, _)) => input = rest,
            Err(_) => break,
        }
    }
    let mut value = operands.pop().expect("the loop reads an operand before it ends");
    while let Some(base) = operands.pop() {
        let at = base.at().to(value.at());
        value = Expr::Call { functor: Functor::Power, args: vec![base, value], at };
    }
    for (functor, start) in prefixes.into_iter().rev() {
        let at = start.to(value.at());
        value = match functor {
            Functor::Negate => negated(value, start),
            _ => Expr::Call { functor, args: vec![value], at },
        };
    }
    Ok((input, value))
}

/// The value with a minus before it; `-5u` is computed, so that it goes round as Soufflé's does.
fn negated(value: Expr, minus: Span) -> Expr {
    let at = minus.to(value.at());
    match value {
        Expr::Number(number, _) => Expr::Number(number.wrapping_neg(), at),
        Expr::Decimal(number, _) => Expr::Decimal(-number, at),
        value => Expr::Call { functor: Functor::Negate, args: vec![value], at },
    }
}

fn primary(input: Input<'_>) -> Read<'_, Expr> {
    if let Some(refused) = foreign(input) {
        return input.refuse(refused);
    }
    // By the first word, so that brackets within brackets take little of the stack.
    match input.rest.first().map(|token| &token.word) {
        Some(Word::Sign("(")) => brackets(input),
        Some(Word::Sign("[")) => record(input),
        Some(Word::Sign("$")) => branch(input),
        Some(Word::Name(name)) if aggregation(name).is_some() => match aggregate(input) {
            Err(nom::Err::Error(_)) => alt((call, variable)).parse(input),
            read => read,
        },
        Some(Word::Name(_)) => alt((cast, call, variable)).parse(input),
        _ => alt((
            variable,
            number.map(|(value, at)| Expr::Number(value, at)),
            unsigned.map(|(value, at)| Expr::Unsigned(value, at)),
            decimal.map(|(value, at)| Expr::Decimal(value, at)),
            text,
            brackets,
        ))
        .parse(input),
    }
}

fn brackets(input: Input<'_>) -> Read<'_, Expr> {
    let (input, _) = sign("(")(input)?;
    let (input, value) = expression(input)?;
    let (input, _) = sign(")")(input)?;
    Ok((input, value))
}

// [X, Y]   []
fn record(input: Input<'_>) -> Read<'_, Expr> {
    let at = input.at();
    let (rest, _) = sign("[")(input)?;
    let (rest, args) = opt(list(expression, sign(","))).parse(rest)?;
    let at = at.to(rest.at());
    let (rest, _) = sign("]")(rest)?;
    Ok((rest, Expr::Record { branch: None, args: args.unwrap_or_default(), at }))
}

// $Node(L, R)   $Leaf   and $ alone, the counter's old name
fn branch(input: Input<'_>) -> Read<'_, Expr> {
    let start = input.at();
    let (rest, _) = sign("$")(input)?;
    let Ok((rest, name)) = long_name(rest) else {
        return Ok((rest, Expr::Call { functor: Functor::Counter, args: Vec::new(), at: start }));
    };
    let at = start.to(name.at);
    let branch = Some(Box::new(name));
    let Ok((rest, _)) = sign("(")(rest) else {
        return Ok((rest, Expr::Record { branch, args: Vec::new(), at }));
    };
    let (rest, args) = opt(list(expression, sign(","))).parse(rest)?;
    let at = at.to(rest.at());
    let (rest, _) = sign(")")(rest)?;
    Ok((rest, Expr::Record { branch, args: args.unwrap_or_default(), at }))
}

/// The parts of Soufflé's expressions that are not known here.
fn foreign(input: Input<'_>) -> Option<RuleError> {
    let token = input.rest.first()?;
    let (what, help) = match &token.word {
        Word::Sign("@") => {
            (word!("a-function-of-functor"), word!("foreign-code-is-not-run-here-compute"))
        }
        _ => return None,
    };
    Some(RuleError::Unsupported { what: what.into(), help, at: token.at.into() })
}

// as(X, Place)
fn cast(input: Input<'_>) -> Read<'_, Expr> {
    let (rest, word) = name(input)?;
    if word.text != "as" {
        return input.fail(word!("a-value"));
    }
    let both = separated_pair(expression, sign(","), long_name);
    let (rest, (value, type_name)) = delimited(sign("("), both, sign(")")).parse(rest)?;
    let at = word.at.to(type_name.at);
    Ok((rest, Expr::As { value: Box::new(value), type_name: Box::new(type_name), at }))
}

fn variable(input: Input<'_>) -> Read<'_, Expr> {
    let (rest, name) = name(input)?;
    match rest.rest.first() {
        Some(Token { word: Word::Sign("("), at }) => {
            let what = said!("the-function", text = name.text);
            let help = word!("there-are-arithmetic-autoinc-cat-strlen-substr");
            rest.doubt(RuleError::Unsupported { what, help, at: name.at.to(*at).into() })
        }
        _ if name.text == "__ITERATION__" => input.refuse(RuleError::Unsupported {
            what: "__ITERATION__".into(),
            help: word!("make-a-column-that-counts-steps"),
            at: name.at.into(),
        }),
        _ if name.text == "_" => Ok((rest, Expr::Any(name.at))),
        _ if name.text == "nil" => Ok((rest, Expr::Nil(name.at))),
        _ => Ok((rest, Expr::Variable(name))),
    }
}

// strlen(X), cat(X, Y, Z), range(0, N)
fn call(input: Input<'_>) -> Read<'_, Expr> {
    let (rest, name) = name(input)?;
    let Some(functor) = functor(&name.text) else {
        return input.fail(word!("a-value"));
    };
    let (rest, args) =
        delimited(sign("("), opt(list(expression, sign(","))), sign(")")).parse(rest)?;
    let args = args.unwrap_or_default();
    let at = name.at.to(args.last().map_or(name.at, Expr::at));
    let wanted = functor.takes().len();
    let folds = matches!(functor, Functor::Concatenate | Functor::Smaller | Functor::Larger);
    let empty = |at| Expr::Text(String::new(), at);
    if functor == Functor::Concatenate && args.len() < wanted {
        // What is joined must be texts, also where nothing is joined to them.
        let left = args.into_iter().next().unwrap_or_else(|| empty(at));
        return Ok((rest, Expr::Call { functor, args: vec![left, empty(at)], at }));
    }
    if folds && args.len() > wanted && args.len() <= MAX_CHAIN {
        let joined = args.into_iter().reduce(|left, right| Expr::Call {
            functor,
            args: vec![left, right],
            at,
        });
        return Ok((rest, joined.expect("a list has at least one element")));
    }
    let may_lack = usize::from(functor == Functor::Range);
    if args.len() > wanted || args.len() + may_lack < wanted {
        let (name, found, at) = (name.text, args.len(), at.into());
        return input.refuse(RuleError::Arity { name, expected: wanted, found, at });
    }
    Ok((rest, Expr::Call { functor, args, at }))
}

// count : { body }     sum X : { body }     min X : above(X, _)
fn aggregate(input: Input<'_>) -> Read<'_, Expr> {
    let (rest, name) = name(input)?;
    let Some(function) = aggregation(&name.text) else {
        return input.fail(word!("a-value"));
    };
    if matches!(rest.rest.first(), Some(Token { word: Word::Sign("("), .. }))
        && functor(&name.text).is_some()
        && !is_counted(rest)
    {
        return input.fail(word!("a-value"));
    }
    let (rest, value) = match function {
        Aggregation::Count => (rest, None),
        _ => expression.map(|value| Some(Box::new(value))).parse(rest)?,
    };
    let (rest, _) = sign(":")(rest)?;
    let (rest, body) =
        alt((delimited(sign("{"), disjunction, sign("}")), atom.map(Body::Atom))).parse(rest)?;
    let last = input.rest[input.rest.len() - rest.rest.len() - 1].at;
    Ok((rest, Expr::Aggregate { function, value, body: Box::new(body), at: name.at.to(last) }))
}

/// Whether what stands in brackets behind `max` or `min` is a value to be counted, `max (x * 2) : { … }`, and no list of
/// arguments.
fn is_counted(input: Input<'_>) -> bool {
    let (mut depth, mut is_behind) = (0_usize, false);
    for token in input.rest {
        match &token.word {
            Word::Sign("(" | "[" | "{") => depth += 1,
            Word::Sign(")" | "]" | "}") => {
                let Some(less) = depth.checked_sub(1) else { return false };
                depth = less;
                is_behind |= depth == 0;
            }
            Word::Sign(",") if depth == 1 && !is_behind => return false,
            Word::Sign(":") if depth == 0 => return true,
            Word::Sign("+" | "-" | "*" | "/" | "%" | "^") => {}
            Word::Sign(_) | Word::Directive(_) if depth == 0 => return false,
            _ => {}
        }
    }
    false
}

pub(super) fn functor(word: &str) -> Option<Functor> {
    // As Soufflé called them once.
    let word = match word {
        "itof" | "utof" => "to_float",
        "ftoi" | "utoi" => "to_number",
        "ftou" | "itou" => "to_unsigned",
        word => word,
    };
    let known = Functor::ALL.iter().copied().find(|functor| functor.word() == word);
    // The signs are functors too, but no names.
    known.filter(|_| word.starts_with(char::is_alphabetic) && word != "neg")
}

pub(super) fn aggregation(word: &str) -> Option<Aggregation> {
    use Aggregation::{Count, Max, Mean, Min, Sum};
    [Count, Sum, Min, Max, Mean].into_iter().find(|function| function.word() == word)
}
