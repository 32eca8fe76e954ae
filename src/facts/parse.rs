//! Words to items: the grammar of Soufflé's dialect, with nom over the words that [`super::lex`] finds.
//!
//! One departure from Soufflé: a declaration may give the relation a name in a second language,
//! `.decl НАХОДИТСЯ_СВЕРХУ_НА(a: symbol, b: symbol) = ON_TOP_OF`; both names then mean the relation.
//! A fault ends its item only; reading goes on behind the next full stop or at the next directive.

use std::cell::RefCell;

use nom::branch::alt;
use nom::combinator::opt;
use nom::error::{ErrorKind, ParseError};
use nom::sequence::{delimited, preceded, separated_pair};
use nom::{Err, IResult, Parser};

use super::fault::RuleError;
use super::lex::{self, Token, Word};
use super::syntax::{
    Aggregation, Atom, Body, Comparison, Expr, Functor, Item, Name, Role, Rule, Span,
};

/// Longer chains of operators are refused: their trees are walked by recursion.
const MAX_CHAIN: usize = 128;

/// Failed attempts allowed for one item; brackets within brackets could otherwise be tried without end.
const MAX_ATTEMPTS: usize = 1_000_000;
const ATTEMPTS_PER_WORD: usize = 100;

/// All items of a text; what could not be read is in `faults`.
pub(super) fn items(text: &str, file: u32, faults: &mut Vec<RuleError>) -> Vec<Item> {
    let words = lex::words(text, file, faults);
    let furthest = RefCell::new(Furthest::default());
    let mut input = Input { rest: &words, length: words.len(), furthest: &furthest };
    let mut items = Vec::new();
    while !input.rest.is_empty() {
        *furthest.borrow_mut() = Furthest::default();
        match item(input) {
            Ok((rest, item)) => {
                items.push(item);
                input = rest;
            }
            Err(_) => {
                let failure = furthest.borrow();
                faults.push(failure.describe(&words, file, text.len()));
                input.rest = behind(input.rest, failure.left.unwrap_or(input.rest.len()));
            }
        }
    }
    items
}

/// The words behind the faulty item: after the next full stop, or from the next directive on.
fn behind(rest: &[Token], left: usize) -> &[Token] {
    let fault = rest.len().saturating_sub(left.min(rest.len())).max(1);
    for (n, token) in rest.iter().enumerate().skip(fault.min(rest.len())) {
        match token.word {
            Word::Sign(".") => return &rest[n + 1..],
            Word::Directive(_) => return &rest[n..],
            _ => {}
        }
    }
    if fault <= rest.len() && matches!(rest[fault - 1].word, Word::Sign(".")) {
        &rest[fault..]
    } else {
        &[]
    }
}

/// The failure that got furthest into the text; what stopped a reader is named there.
#[derive(Default)]
struct Furthest {
    /// Words left to read where it happened; none before the first failure.
    left: Option<usize>,
    expected: Vec<&'static str>,
    fault: Option<RuleError>,
    attempts: usize,
}

impl Furthest {
    fn describe(&self, words: &[Token], file: u32, end: usize) -> RuleError {
        if let Some(fault) = &self.fault {
            return fault.clone();
        }
        let end = Span { file, start: end as u32, end: end as u32 };
        let token = self.left.and_then(|left| words.get(words.len() - left));
        let found = token.map_or("конец текста".into(), |token| match &token.word {
            Word::Name(name) => format!("«{name}»"),
            Word::Number(number) => format!("число {number}"),
            Word::Text(_) => "текст в кавычках".into(),
            Word::Directive(word) => format!("«.{word}»"),
            Word::Sign(sign) => format!("«{sign}»"),
        });
        let expected = match self.expected.as_slice() {
            [] => "правило, факт или объявление".into(),
            all => all.join(" или "),
        };
        RuleError::Syntax { expected, found, at: token.map_or(end, |token| token.at).into() }
    }
}

/// The words still to be read.
#[derive(Clone, Copy)]
struct Input<'a> {
    rest: &'a [Token],
    /// Of the whole text, in words.
    length: usize,
    furthest: &'a RefCell<Furthest>,
}

impl Input<'_> {
    fn fail<T>(self, expected: &'static str) -> Result<T, Err<Failure>> {
        let mut furthest = self.furthest.borrow_mut();
        let left = self.rest.len();
        furthest.attempts += 1;
        if furthest.left.is_none_or(|best| left < best) {
            furthest.left = Some(left);
            furthest.expected.clear();
            furthest.fault = None;
        }
        if furthest.left == Some(left) && !furthest.expected.contains(&expected) {
            furthest.expected.push(expected);
        }
        let limit = MAX_ATTEMPTS + self.length * ATTEMPTS_PER_WORD;
        if furthest.attempts > limit {
            drop(furthest);
            let (what, at) = ("попыток прочесть одно правило", self.at().into());
            return self.refuse(RuleError::TooLarge { what, limit, at });
        }
        Err(Err::Error(Failure))
    }

    /// A fault, unless another reading gets further.
    fn doubt<T>(self, fault: RuleError) -> Result<T, Err<Failure>> {
        let failure = self.fail("значение");
        let mut furthest = self.furthest.borrow_mut();
        if furthest.left == Some(self.rest.len()) {
            furthest.fault = Some(fault);
        }
        failure
    }

    /// A fault that no other reading can mend.
    fn refuse<T>(self, fault: RuleError) -> Result<T, Err<Failure>> {
        let mut furthest = self.furthest.borrow_mut();
        furthest.left = Some(self.rest.len());
        furthest.fault = Some(fault);
        Err(Err::Failure(Failure))
    }

    fn at(self) -> Span {
        self.rest.first().map(|token| token.at).unwrap_or_default()
    }
}

/// What went wrong stands in [`Furthest`].
#[derive(Debug)]
struct Failure;

impl ParseError<Input<'_>> for Failure {
    fn from_error_kind(_: Input<'_>, _: ErrorKind) -> Self {
        Self
    }
    fn append(_: Input<'_>, _: ErrorKind, other: Self) -> Self {
        other
    }
}

type Read<'a, T> = IResult<Input<'a>, T, Failure>;

fn item(input: Input<'_>) -> Read<'_, Item> {
    let Some(token) = input.rest.first() else { return input.fail("правило") };
    let behind = Input { rest: &input.rest[1..], ..input };
    match token.word {
        Word::Directive("decl") => relation(behind),
        Word::Directive("type") => type_item(behind),
        Word::Directive("input") => directive(Role::Input, behind),
        Word::Directive("output") => directive(Role::Output, behind),
        Word::Directive("printsize") => directive(Role::PrintSize, behind),
        Word::Directive("limitsize") => directive(Role::LimitSize, behind),
        // A hint to Soufflé's scheduler or options; the meaning of the program is the same without.
        Word::Directive("plan") => plan(behind),
        Word::Directive("pragma") => {
            (text_word, opt(text_word)).map(|_| Item::Nothing).parse(behind)
        }
        Word::Directive(word) => {
            let help = "напишите объявления и правила прямо в этом файле";
            input.refuse(RuleError::Unsupported {
                what: format!(".{word}"),
                help,
                at: token.at.into(),
            })
        }
        _ => rule(input),
    }
}

// .decl above, under(a: symbol, b: symbol) = НАД output
fn relation(input: Input<'_>) -> Read<'_, Item> {
    let (input, names) = list(name, sign(",")).parse(input)?;
    let column = separated_pair(name, sign(":"), name);
    let (input, columns) =
        delimited(sign("("), opt(list(column, sign(","))), sign(")")).parse(input)?;
    let (input, second) = opt(preceded(sign("="), name)).parse(input)?;
    let (input, words) = many(qualifier)(input)?;
    let roles = words.into_iter().flatten().collect();
    Ok((input, Item::Relation { names, columns: columns.unwrap_or_default(), second, roles }))
}

fn qualifier(input: Input<'_>) -> Read<'_, Option<Role>> {
    let (rest, name) = name(input)?;
    // A qualifier is a bare word; a word with a bracket is the next fact.
    if matches!(rest.rest.first(), Some(Token { word: Word::Sign(_), .. })) {
        return input.fail("объявление или правило");
    }
    match name.text.as_str() {
        "input" => Ok((rest, Some(Role::Input))),
        "output" => Ok((rest, Some(Role::Output))),
        "printsize" => Ok((rest, Some(Role::PrintSize))),
        "btree" | "brie" | "inline" | "no_inline" | "magic" | "no_magic" | "overridable" => {
            Ok((rest, None))
        }
        word => {
            let help = "уберите это слово: отношения хранятся одинаково";
            input.refuse(RuleError::Unsupported {
                what: format!("свойство {word}"),
                help,
                at: name.at.into(),
            })
        }
    }
}

// .type Place <: symbol        .type Thing = Place | Tool
fn type_item(input: Input<'_>) -> Read<'_, Item> {
    let (input, type_name) = name(input)?;
    let (rest, sign_word) = alt((sign("<:"), sign("="))).parse(input)?;
    if let Some(Token { word: Word::Sign("[" | "{"), at }) = rest.rest.first() {
        let help = "разложите запись на столбцы отношения";
        return rest.refuse(RuleError::Unsupported {
            what: "записи".into(),
            help,
            at: (*at).into(),
        });
    }
    let (rest, bases) = list(name, sign("|")).parse(rest)?;
    if bases.len() > 1 && sign_word == "<:" {
        return rest.fail("«=»");
    }
    Ok((rest, Item::Type { name: type_name, bases }))
}

// .output above, under(IO=file, filename="above.csv")
fn directive(role: Role, input: Input<'_>) -> Read<'_, Item> {
    let (input, relations) = list(name, sign(",")).parse(input)?;
    let value = alt((text_word, name.map(|name| name.text), number.map(|n| n.0.to_string())));
    let parameter = separated_pair(name.map(|name| name.text), sign("="), value);
    let (input, parameters) =
        opt(delimited(sign("("), opt(list(parameter, sign(","))), sign(")"))).parse(input)?;
    let parameters = parameters.flatten().unwrap_or_default();
    Ok((input, Item::Directive { role, relations, parameters }))
}

// .plan 0:(2,1), 1:(1,2)
fn plan(input: Input<'_>) -> Read<'_, Item> {
    let order = delimited(sign("("), list(number, sign(",")), sign(")"));
    list(separated_pair(number, sign(":"), order), sign(",")).map(|_| Item::Nothing).parse(input)
}

// above(A, B), over(A, B) :- body.
fn rule(input: Input<'_>) -> Read<'_, Item> {
    let start = input.at();
    let (input, heads) = list(atom, sign(",")).parse(input)?;
    let (input, body) = opt(preceded(sign(":-"), disjunction)).parse(input)?;
    let end = input.at();
    let (input, _) = sign(".")(input)?;
    let body = body.unwrap_or(Body::All(Vec::new()));
    Ok((input, Item::Rule(Rule { heads, body, at: start.to(end) })))
}

fn disjunction(input: Input<'_>) -> Read<'_, Body> {
    list(conjunction, sign(";")).map(|parts| single_or(parts, Body::Any)).parse(input)
}

fn conjunction(input: Input<'_>) -> Read<'_, Body> {
    list(literal, sign(",")).map(|parts| single_or(parts, Body::All)).parse(input)
}

fn single_or(mut parts: Vec<Body>, many: impl Fn(Vec<Body>) -> Body) -> Body {
    if parts.len() == 1 { parts.swap_remove(0) } else { many(parts) }
}

fn literal(input: Input<'_>) -> Read<'_, Body> {
    let (input, negations) = many(sign("!"))(input)?;
    let (input, body) = alt((
        truth,
        matching,
        atom.map(Body::Atom),
        comparison,
        delimited(sign("("), disjunction, sign(")")),
    ))
    .parse(input)?;
    Ok((input, if negations.len() % 2 == 1 { Body::Not(Box::new(body)) } else { body }))
}

// true   false
fn truth(input: Input<'_>) -> Read<'_, Body> {
    let (rest, name) = name(input)?;
    match (name.text.as_str(), rest.rest.first().map(|token| &token.word)) {
        ("true" | "false", Some(Word::Sign("(" | "=" | "!=" | "<" | ">" | "<=" | ">="))) => {
            input.fail("посылка")
        }
        ("true", _) => Ok((rest, Body::All(Vec::new()))),
        ("false", _) => Ok((rest, Body::Any(Vec::new()))),
        _ => input.fail("посылка"),
    }
}

// contains("дверь", Name)
fn matching(input: Input<'_>) -> Read<'_, Body> {
    let (rest, name) = name(input)?;
    if name.text == "match"
        && matches!(rest.rest.first(), Some(Token { word: Word::Sign("("), .. }))
    {
        let help = "есть contains(часть, целое)";
        return input.refuse(RuleError::Unsupported {
            what: "match".into(),
            help,
            at: name.at.into(),
        });
    }
    if name.text != "contains" {
        return input.fail("посылка");
    }
    let (rest, _) = sign("(")(rest)?;
    let (rest, (left, right)) = separated_pair(expression, sign(","), expression).parse(rest)?;
    let at = name.at.to(rest.at());
    let (rest, _) = sign(")")(rest)?;
    Ok((rest, Body::Compare { op: Comparison::Contains, left, right, at }))
}

fn atom(input: Input<'_>) -> Read<'_, Atom> {
    let (rest, relation) = name(input)?;
    if functor(&relation.text).is_some() || aggregation(&relation.text).is_some() {
        return input.fail("отношение");
    }
    let (rest, _) = sign("(")(rest)?;
    let (rest, args) = opt(list(expression, sign(","))).parse(rest)?;
    let at = relation.at.to(rest.at());
    let (rest, _) = sign(")")(rest)?;
    Ok((rest, Atom { relation, args: args.unwrap_or_default(), at }))
}

fn comparison(input: Input<'_>) -> Read<'_, Body> {
    let (input, left) = expression(input)?;
    let (input, op) = alt((
        sign("=").map(|_| Comparison::Equal),
        sign("!=").map(|_| Comparison::NotEqual),
        sign("<=").map(|_| Comparison::LessOrEqual),
        sign("<").map(|_| Comparison::Less),
        sign(">=").map(|_| Comparison::GreaterOrEqual),
        sign(">").map(|_| Comparison::Greater),
    ))
    .parse(input)?;
    let (input, right) = expression(input)?;
    let at = left.at().to(right.at());
    Ok((input, Body::Compare { op, left, right, at }))
}

fn expression(input: Input<'_>) -> Read<'_, Expr> {
    let (mut rest, mut value) = sum(input)?;
    if bit_word(rest).is_some() {
        (rest, value) = bits(rest, value)?;
    }
    if depth(&value) > MAX_CHAIN {
        let at = value.at().into();
        return input.refuse(RuleError::TooLarge {
            what: "глубина выражения",
            limit: MAX_CHAIN,
            at,
        });
    }
    Ok((rest, value))
}

/// Levels of an expression; bounded, since what it is made of was measured before.
fn depth(expr: &Expr) -> usize {
    match expr {
        Expr::Call { args, .. } => 1 + args.iter().map(depth).max().unwrap_or(0),
        _ => 1,
    }
}

/// Soufflé's words between operands, the loosest first; the two shifts bind equally.
const BITS: [(&str, Functor, u8); 5] = [
    ("bor", Functor::BitOr, 0),
    ("bxor", Functor::BitXor, 1),
    ("band", Functor::BitAnd, 2),
    ("bshl", Functor::ShiftLeft, 3),
    ("bshr", Functor::ShiftRight, 3),
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
                what: "действий подряд",
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
    input
        .refuse(RuleError::TooLarge { what: "действий подряд", limit: MAX_CHAIN, at })
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

// a ^ b ^ c is a ^ (b ^ c), and -a ^ b is -(a ^ b), as in Soufflé.
fn power(input: Input<'_>) -> Read<'_, Expr> {
    let start = input.at();
    let (mut input, minuses) = many(sign("-"))(input)?;
    let mut operands = Vec::new();
    loop {
        let (rest, operand) = primary(input)?;
        operands.push(operand);
        if operands.len() > MAX_CHAIN {
            let at = input.at().into();
            return input.refuse(RuleError::TooLarge {
                what: "действий подряд",
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
    if minuses.len() % 2 == 1 {
        let at = start.to(value.at());
        value = match value {
            Expr::Number(number, _) => Expr::Number(number.wrapping_neg(), at),
            other => Expr::Call { functor: Functor::Negate, args: vec![other], at },
        };
    }
    Ok((input, value))
}

fn primary(input: Input<'_>) -> Read<'_, Expr> {
    alt((
        aggregate,
        call,
        number.map(|(value, at)| Expr::Number(value, at)),
        text,
        variable,
        delimited(sign("("), expression, sign(")")),
    ))
    .parse(input)
}

fn variable(input: Input<'_>) -> Read<'_, Expr> {
    let (rest, name) = name(input)?;
    match rest.rest.first() {
        Some(Token { word: Word::Sign("("), at }) => {
            let what = format!("функция «{}»", name.text);
            let help = "есть арифметика, cat, strlen, substr, to_string, to_number, ord, min, max и битовые действия";
            rest.doubt(RuleError::Unsupported { what, help, at: name.at.to(*at).into() })
        }
        _ if name.text == "_" => Ok((rest, Expr::Any(name.at))),
        _ => Ok((rest, Expr::Variable(name))),
    }
}

// strlen(X), cat(X, Y, Z)
fn call(input: Input<'_>) -> Read<'_, Expr> {
    let (rest, name) = name(input)?;
    let Some(functor) = functor(&name.text) else { return input.fail("значение") };
    let (rest, args) = delimited(sign("("), list(expression, sign(",")), sign(")")).parse(rest)?;
    let at = name.at.to(args.last().map_or(name.at, Expr::at));
    let wanted = functor.takes_numbers().len();
    let folds = matches!(functor, Functor::Concatenate | Functor::Smaller | Functor::Larger);
    if folds && args.len() > wanted && args.len() <= MAX_CHAIN {
        let joined = args.into_iter().reduce(|left, right| Expr::Call {
            functor,
            args: vec![left, right],
            at,
        });
        return Ok((rest, joined.expect("a list has at least one element")));
    }
    if args.len() != wanted {
        let (name, found, at) = (name.text, args.len(), at.into());
        return input.refuse(RuleError::Arity { name, expected: wanted, found, at });
    }
    Ok((rest, Expr::Call { functor, args, at }))
}

// count : { body }     sum X : { body }     min X : above(X, _)
fn aggregate(input: Input<'_>) -> Read<'_, Expr> {
    let (rest, name) = name(input)?;
    let Some(function) = aggregation(&name.text) else { return input.fail("значение") };
    if matches!(rest.rest.first(), Some(Token { word: Word::Sign("("), .. }))
        && functor(&name.text).is_some()
    {
        return input.fail("значение");
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

fn functor(word: &str) -> Option<Functor> {
    let known = Functor::ALL.iter().copied().find(|functor| functor.word() == word);
    // The signs are functors too, but no names.
    known.filter(|_| word.starts_with(char::is_alphabetic) && word != "neg")
}

fn aggregation(word: &str) -> Option<Aggregation> {
    use Aggregation::{Count, Max, Mean, Min, Sum};
    [Count, Sum, Min, Max, Mean].into_iter().find(|function| function.word() == word)
}

fn name(input: Input<'_>) -> Read<'_, Name> {
    match input.rest {
        [Token { word: Word::Name(text), at }, rest @ ..] => {
            Ok((Input { rest, ..input }, Name { text: text.clone(), at: *at }))
        }
        _ => input.fail("имя"),
    }
}

fn number(input: Input<'_>) -> Read<'_, (i64, Span)> {
    match input.rest {
        [Token { word: Word::Number(value), at }, rest @ ..] => {
            Ok((Input { rest, ..input }, (*value, *at)))
        }
        _ => input.fail("число"),
    }
}

fn text(input: Input<'_>) -> Read<'_, Expr> {
    let at = input.at();
    text_word.map(|value| Expr::Text(value, at)).parse(input)
}

fn text_word(input: Input<'_>) -> Read<'_, String> {
    match input.rest {
        [Token { word: Word::Text(text), .. }, rest @ ..] => {
            Ok((Input { rest, ..input }, text.clone()))
        }
        _ => input.fail("текст в кавычках"),
    }
}

fn sign<'a>(wanted: &'static str) -> impl Fn(Input<'a>) -> Read<'a, &'static str> + Copy {
    move |input| match input.rest {
        [Token { word: Word::Sign(found), .. }, rest @ ..] if *found == wanted => {
            Ok((Input { rest, ..input }, wanted))
        }
        _ => input.fail(quoted_sign(wanted)),
    }
}

/// The sign as a message names it.
fn quoted_sign(sign: &'static str) -> &'static str {
    match sign {
        "(" => "«(»",
        ")" => "«)»",
        "," => "«,»",
        "." => "«.»",
        ":" => "«:»",
        ":-" => "«:-»",
        ";" => "«;»",
        "=" | "!=" | "<" | "<=" | ">" | ">=" => "сравнение",
        "+" | "-" | "*" | "/" | "%" | "^" => "действие",
        "{" => "«{»",
        "}" => "«}»",
        "!" => "«!»",
        other => other,
    }
}

/// One or more, with the separator between them.
fn list<'a, T, S>(
    element: impl Parser<Input<'a>, Output = T, Error = Failure>,
    separator: impl Parser<Input<'a>, Output = S, Error = Failure>,
) -> impl Parser<Input<'a>, Output = Vec<T>, Error = Failure> {
    let mut element = element;
    let mut separator = separator;
    move |input: Input<'a>| {
        let (mut input, first) = element.parse(input)?;
        let mut all = vec![first];
        loop {
            match separator.parse(input) {
                Ok((rest, _)) => {
                    let (rest, next) = element.parse(rest)?;
                    all.push(next);
                    input = rest;
                }
                Err(Err::Error(_)) => return Ok((input, all)),
                Err(failure) => return Err(failure),
            }
        }
    }
}

/// As many as there are.
fn many<'a, T>(
    element: impl Fn(Input<'a>) -> Read<'a, T>,
) -> impl Fn(Input<'a>) -> Read<'a, Vec<T>> {
    move |mut input| {
        let mut all = Vec::new();
        loop {
            match element(input) {
                Ok((rest, next)) => {
                    all.push(next);
                    input = rest;
                }
                Err(Err::Error(_)) => return Ok((input, all)),
                Err(failure) => return Err(failure),
            }
        }
    }
}
