//! Words to items: the grammar of Soufflé's dialect, with nom over the words that [`super::lex`] finds.
//!
//! One departure from Soufflé: a declaration may give the relation a name in a second language,
//! `.decl НАХОДИТСЯ_СВЕРХУ_НА(a: symbol, b: symbol) = ON_TOP_OF`; both names then mean the relation.
//! A fault ends its item only; reading goes on behind the next full stop or at the next directive.

use std::cell::RefCell;

use nom::Parser;
use nom::branch::alt;
use nom::combinator::opt;
use nom::sequence::{delimited, preceded, separated_pair};

use super::expression::{aggregation, expression, functor};
use super::fault::RuleError;
use super::lex::{self, Token, Word};
use super::read::{Failure, Furthest, Input, Read, list, many, name, number, sign, text_word};
use super::syntax::{Atom, Body, Comparison, Item, Name, Role, Rule};

const COMPONENTS: &str =
    "компонентов, своих функций и решёток здесь нет; напишите правила прямо в этом файле";

/// All items of a text; what could not be read is in `faults`.
pub(super) fn items(text: &str, file: u32, faults: &mut Vec<RuleError>) -> Vec<Item> {
    let words = lex::words(text, file, faults);
    items_of(&words, text.len(), file, faults)
}

/// All items of these words of a text that ends there.
pub(super) fn items_of(
    words: &[Token],
    end: usize,
    file: u32,
    faults: &mut Vec<RuleError>,
) -> Vec<Item> {
    let furthest = RefCell::new(Furthest::default());
    let mut input = Input { rest: words, length: words.len(), furthest: &furthest };
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
                faults.push(failure.describe(words, file, end));
                input.rest = match input.rest.first().map(|token| &token.word) {
                    Some(Word::Directive("comp")) => behind_braces(input.rest),
                    _ => None,
                }
                .unwrap_or_else(|| behind(input.rest, failure.left.unwrap_or(input.rest.len())));
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

/// The words behind the directive's braces; none where it has no braces, or they are not closed.
fn behind_braces(rest: &[Token]) -> Option<&[Token]> {
    let mut depth = 0;
    for (n, token) in rest.iter().enumerate().skip(1) {
        match token.word {
            Word::Sign("{") => depth += 1,
            Word::Sign("}") if depth <= 1 => return Some(&rest[n + 1..]),
            Word::Sign("}") => depth -= 1,
            Word::Sign(".") | Word::Directive(_) if depth == 0 => return None,
            _ => {}
        }
    }
    None
}

fn item(input: Input<'_>) -> Read<'_, Item> {
    let Some(token) = input.rest.first() else { return input.fail("правило") };
    let behind = Input { rest: &input.rest[1..], ..input };
    match token.word {
        Word::Directive("decl") => relation(behind),
        Word::Directive("type") => type_item(behind),
        Word::Directive("symbol_type") => old_type("symbol", behind),
        Word::Directive("number_type") => old_type("number", behind),
        Word::Directive("include") => {
            text_word.map(|path| Item::Include { path, at: token.at }).parse(behind)
        }
        Word::Directive("input") => directive(Role::Input, behind),
        Word::Directive("output") => directive(Role::Output, behind),
        Word::Directive("printsize") => directive(Role::PrintSize, behind),
        Word::Directive("limitsize") => directive(Role::LimitSize, behind),
        // A hint to Soufflé's scheduler or options; the meaning of the program is the same without.
        Word::Directive("plan") => plan(behind),
        Word::Directive("pragma") => {
            (text_word, opt(text_word)).map(|_| Item::Nothing).parse(behind)
        }
        Word::Directive(word) => input.refuse(RuleError::Unsupported {
            what: format!(".{word}"),
            help: COMPONENTS,
            at: token.at.into(),
        }),
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
    if name.text == "choice" && matches!(rest.rest, [Token { word: Word::Sign("-"), .. }, ..]) {
        let help = "выберите по порядку: правилом с min или с отрицанием";
        let what = "choice-domain".into();
        return input.refuse(RuleError::Unsupported { what, help, at: name.at.into() });
    }
    // A qualifier is a bare word; a word with a bracket is the next fact.
    if matches!(rest.rest.first(), Some(Token { word: Word::Sign(_), .. })) {
        return input.fail("объявление или правило");
    }
    match name.text.as_str() {
        "input" => Ok((rest, Some(Role::Input))),
        "output" => Ok((rest, Some(Role::Output))),
        "printsize" => Ok((rest, Some(Role::PrintSize))),
        "eqrel" => Ok((rest, Some(Role::Equivalence))),
        "inline" => Ok((rest, Some(Role::Inline))),
        "btree" | "btree_delete" | "brie" | "no_inline" | "magic" | "no_magic" | "overridable" => {
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
    let is_bare = !matches!(
        input.rest.first().map(|token| &token.word),
        Some(Word::Sign("<:" | "=")) | Some(Word::Name(_))
    );
    if is_bare {
        // As Soufflé read it once: a type of its own among the symbols.
        let bases = vec![Name { text: "symbol".into(), at: type_name.at }];
        return Ok((input, Item::Type { name: type_name, bases, is_union: false }));
    }
    let (rest, sign_word) = alt((sign("<:"), sign("="))).parse(input)?;
    let record = match rest.rest {
        [Token { word: Word::Sign("["), at }, ..] => Some(("записи", at)),
        [Token { word: Word::Name(_), at }, Token { word: Word::Sign("{"), .. }, ..] => {
            Some(("типы из вариантов", at))
        }
        _ => None,
    };
    if let Some((what, at)) = record {
        let help = "разложите значение на столбцы отношения";
        let what = what.to_owned();
        return rest.refuse(RuleError::Unsupported { what, help, at: (*at).into() });
    }
    let (rest, bases) = list(name, sign("|")).parse(rest)?;
    if bases.len() > 1 && sign_word == "<:" {
        return rest.fail("«=»");
    }
    Ok((rest, Item::Type { name: type_name, bases, is_union: sign_word == "=" }))
}

// .symbol_type Place
fn old_type<'a>(base: &str, input: Input<'a>) -> Read<'a, Item> {
    let (input, name) = name(input)?;
    let bases = vec![Name { text: base.to_owned(), at: name.at }];
    Ok((input, Item::Type { name, bases, is_union: false }))
}

// .output above, under(IO=file, filename="above.csv")
fn directive(role: Role, input: Input<'_>) -> Read<'_, Item> {
    let (input, relations) = list(name, sign(",")).parse(input)?;
    if let Some(last) = relations.last() {
        refuse_dotted(last, input)?;
    }
    let value = alt((text_word, name.map(|name| name.text), number.map(|n| n.0.to_string())));
    let parameter = separated_pair(name.map(|name| name.text), sign("="), value);
    // No rule starts with a bracket, so one that stands here must be read to its end.
    let (input, parameters) = match input.rest.first() {
        Some(Token { word: Word::Sign("("), .. }) => {
            delimited(sign("("), opt(list(parameter, sign(","))), sign(")")).parse(input)?
        }
        _ => (input, None),
    };
    let parameters = parameters.unwrap_or_default();
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
    if let Some(Token { word: Word::Sign("<="), at }) = input.rest.first() {
        let help = "отберите наименьшие правилом с min или с отрицанием";
        let what = "поглощение (A <= B)".into();
        return input.refuse(RuleError::Unsupported { what, help, at: (*at).into() });
    }
    let (input, body) = opt(preceded(sign(":-"), disjunction)).parse(input)?;
    let end = input.at();
    let (input, _) = sign(".")(input)?;
    let body = body.unwrap_or(Body::All(Vec::new()));
    Ok((input, Item::Rule(Rule { heads, body, at: start.to(end) })))
}

pub(super) fn disjunction(input: Input<'_>) -> Read<'_, Body> {
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

/// `g.edge` is a relation of a component.
fn refuse_dotted(relation: &Name, behind: Input<'_>) -> Result<(), nom::Err<Failure>> {
    let [dot, Token { word: Word::Name(part), at }, ..] = behind.rest else { return Ok(()) };
    if dot.word != Word::Sign(".") || dot.at.start != relation.at.end || at.start != dot.at.end {
        return Ok(());
    }
    let what = format!("имя из компонента: {}.{part}", relation.text);
    // Reading goes on behind the rule's full stop, not behind this dot.
    let after = Input { rest: &behind.rest[2..], ..behind };
    after.refuse(RuleError::Unsupported { what, help: COMPONENTS, at: relation.at.to(*at).into() })
}

pub(super) fn atom(input: Input<'_>) -> Read<'_, Atom> {
    let (rest, relation) = name(input)?;
    refuse_dotted(&relation, rest)?;
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
