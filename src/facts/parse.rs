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
use super::fault::{RuleError, Told};
use super::lex::{self, Token, Word};
use super::preprocess;
use super::read::{Furthest, Input, Read, list, long_name, many, name, number, sign, text_word};
use super::syntax::{
    Atom, Body, Branch, Comparison, Component, Expr, Item, Name, Role, Rule, Span, Type,
};
use crate::units::{Source, said, word};

const FOREIGN: Told = word!("foreign-code-is-not-run-here-compute-2");

/// Components within components.
const MAX_NESTED: usize = 16;

/// All items of a text; what could not be read is in `faults`.
pub(super) fn items(source: &Source, file: u32, faults: &mut Vec<RuleError>) -> Vec<Item> {
    let words = lex::words(source.text(), file, faults);
    let words = without_annotations(preprocess::expand(words, source, file, faults));
    items_of(&words, source.text().len(), file, faults)
}

/// The words without `@[…]` and `@![…]`, which say something to other tools.
fn without_annotations(words: Vec<Token>) -> Vec<Token> {
    if words.iter().all(|token| token.word != Word::Sign("@")) {
        return words;
    }
    let mut kept = Vec::with_capacity(words.len());
    let mut rest = words.as_slice();
    while let [first, behind @ ..] = rest {
        let is = |token: &Token, sign| token.word == Word::Sign(sign);
        let inside = match rest {
            [at, open, inside @ ..] if is(at, "@") && is(open, "[") => Some(inside),
            [at, not, open, inside @ ..] if is(at, "@") && is(not, "!") && is(open, "[") => {
                Some(inside)
            }
            _ => None,
        };
        rest = match inside.and_then(behind_bracket) {
            Some(after) => after,
            None => {
                kept.push(first.clone());
                behind
            }
        };
    }
    kept
}

/// The words behind the bracket that closes an open one.
fn behind_bracket(inside: &[Token]) -> Option<&[Token]> {
    let mut depth = 0_usize;
    for (n, token) in inside.iter().enumerate() {
        match token.word {
            Word::Sign("[" | "(" | "{") => depth += 1,
            Word::Sign("]") if depth == 0 => return Some(&inside[n + 1..]),
            Word::Sign("]" | ")" | "}") => depth = depth.checked_sub(1)?,
            _ => {}
        }
    }
    None
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
    let Some(token) = input.rest.first() else { return input.fail(word!("a-rule")) };
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
        // A hint to Soufflé's scheduler; the meaning of the program is the same without.
        Word::Directive("plan") => plan(token.at, behind),
        Word::Directive("pragma") => (text_word, opt(text_word))
            .map(|(name, value)| Item::Pragma {
                name,
                value: value.unwrap_or_default(),
                at: token.at,
            })
            .parse(behind),
        // Each file is read once anyway.
        Word::Directive("once") => {
            Ok((behind, Item::Pragma { name: "once".into(), value: String::new(), at: token.at }))
        }
        Word::Directive("functor") => foreign(behind),
        Word::Directive("comp") => component(behind, 0),
        Word::Directive("init") => instance(behind),
        Word::Directive("override") => input.refuse(RuleError::Unsupported {
            what: said!("override-outside-of-a-component"),
            help: word!("replace-rules-within-a-comp-that-inherits"),
            at: token.at.into(),
        }),
        Word::Directive(word) => input.refuse(RuleError::Unsupported {
            what: format!(".{word}").into(),
            help: match word {
                "debug_delta" => word!("the-rounds-of-evaluation-are-not-kept"),
                _ => FOREIGN,
            },
            at: token.at.into(),
        }),
        _ => rule(input),
    }
}

// .functor f(x: number, symbol): number stateful
fn foreign(input: Input<'_>) -> Read<'_, Item> {
    let (input, of) = name(input)?;
    let column = alt((separated_pair(name, sign(":"), long_name).map(|(_, of)| of), long_name));
    let columns = delimited(sign("("), opt(list(column, sign(","))), sign(")"));
    let (input, (columns, result)) = separated_pair(columns, sign(":"), long_name).parse(input)?;
    let rest = match input.rest {
        [Token { word: Word::Name(word), .. }, rest @ ..] if word == "stateful" => rest,
        rest => rest,
    };
    let types = columns.into_iter().flatten().chain([result]).collect();
    Ok((Input { rest, ..input }, Item::Foreign { name: of, types }))
}

// .decl above, under(a: symbol, b: symbol) = НАД output
fn relation(input: Input<'_>) -> Read<'_, Item> {
    let (input, names) = list(name, sign(",")).parse(input)?;
    let column = separated_pair(name, sign(":"), long_name);
    let (input, columns) =
        delimited(sign("("), opt(list(column, sign(","))), sign(")")).parse(input)?;
    let (input, second) = opt(preceded(sign("="), name)).parse(input)?;
    let (input, words) = many(qualifier)(input)?;
    let columns = columns.unwrap_or_default();
    let (mut roles, mut domains) = (Vec::new(), Vec::new());
    let mut said: Vec<String> = Vec::new();
    for (word, qualifier) in words {
        let is_storage = |word: &str| matches!(word, "btree" | "btree_delete" | "brie" | "eqrel");
        let at = word.at.into();
        if said
            .iter()
            .any(|known| *known == word.text || is_storage(known) && is_storage(&word.text))
        {
            let what = said!("the-property-beside-what-is-said-already", text = word.text);
            return input.refuse(RuleError::Misuse {
                what,
                help: word!("one-word-of-btree-brie-eqrel-btree"),
                at,
            });
        }
        if word.text == "btree_delete" && columns.is_empty() {
            let what = word!("btree-delete-of-a-relation-without-columns").into();
            let help = word!("it-has-no-two-rows-of-which");
            return input.refuse(RuleError::Misuse { what, help, at });
        }
        said.push(word.text);
        match qualifier {
            Qualifier::Role(role) => roles.push(role),
            Qualifier::Domains(more) => domains.extend(more),
            Qualifier::Storage => {}
        }
    }
    Ok((input, Item::Relation { names, columns, second, roles, domains }))
}

/// What stands behind a relation's columns.
#[derive(Debug, Clone)]
enum Qualifier {
    Role(Role),
    Domains(Vec<Vec<Name>>),
    /// How Soufflé should keep the rows; here they are kept alike.
    Storage,
}

// choice-domain x, (y, z)
fn domains(input: Input<'_>) -> Read<'_, Vec<Vec<Name>>> {
    let several = delimited(sign("("), list(name, sign(",")), sign(")"));
    list(alt((several, name.map(|one| vec![one]))), sign(",")).parse(input)
}

// .comp Graph<N, M> : Base<N>, Other { … }
fn component(input: Input<'_>, depth: usize) -> Read<'_, Item> {
    if depth > MAX_NESTED {
        let (what, limit, at) =
            (word!("components-within-one-another"), MAX_NESTED, input.at().into());
        return input.refuse(RuleError::TooLarge { what, limit, at });
    }
    let (input, head) = component_type(input)?;
    let (input, bases) = match sign(":")(input) {
        Ok((input, _)) => list(component_type, sign(",")).parse(input)?,
        Err(_) => (input, Vec::new()),
    };
    let (mut input, _) = sign("{")(input)?;
    let mut items = Vec::new();
    loop {
        let Some(token) = input.rest.first() else { return input.fail(word!("closing-brace")) };
        let behind = Input { rest: &input.rest[1..], ..input };
        let next;
        (input, next) = match token.word {
            Word::Sign("}") => {
                return Ok((behind, Item::Component(Component { head, bases, items })));
            }
            Word::Directive("comp") => component(behind, depth + 1)?,
            Word::Directive("override") => name.map(Item::Override).parse(behind)?,
            _ => item(input)?,
        };
        items.push(next);
    }
}

// Graph<Place, Thing>
fn component_type(input: Input<'_>) -> Read<'_, Type> {
    let (input, name) = long_name(input)?;
    let [Token { word: Word::Sign("<"), .. }, rest @ ..] = input.rest else {
        return Ok((input, Type { name, args: Vec::new() }));
    };
    let input = Input { rest, ..input };
    let (input, args) = list(long_name, sign(",")).parse(input)?;
    let (input, _) = sign(">")(input)?;
    Ok((input, Type { name, args }))
}

// .init g = Graph<Place>
fn instance(input: Input<'_>) -> Read<'_, Item> {
    let at = input.at();
    let (input, name) = name(input)?;
    let (input, _) = sign("=")(input)?;
    let (input, of) = component_type(input)?;
    let at = at.to(of.name.at);
    Ok((input, Item::Instance { name, of, at }))
}

fn qualifier(input: Input<'_>) -> Read<'_, (Name, Qualifier)> {
    let (rest, name) = name(input)?;
    if let [
        Token { word: Word::Sign("-"), .. },
        Token { word: Word::Name(domain), .. },
        behind @ ..,
    ] = rest.rest
        && name.text == "choice"
        && domain == "domain"
    {
        let (rest, found) = domains(Input { rest: behind, ..rest })?;
        return Ok((rest, (name, Qualifier::Domains(found))));
    }
    // A qualifier is a bare word; a word with a bracket is the next fact.
    if matches!(rest.rest.first(), Some(Token { word: Word::Sign(_), .. })) {
        return input.fail(word!("a-declaration-or-a-rule"));
    }
    let qualifier = match name.text.as_str() {
        "input" => Qualifier::Role(Role::Input),
        "output" => Qualifier::Role(Role::Output),
        "printsize" => Qualifier::Role(Role::PrintSize),
        "eqrel" => Qualifier::Role(Role::Equivalence),
        "inline" => Qualifier::Role(Role::Inline),
        "overridable" => Qualifier::Role(Role::Overridable),
        "btree" | "btree_delete" | "brie" | "no_inline" | "magic" | "no_magic" => {
            Qualifier::Storage
        }
        word => {
            let help = match word {
                "btree_max" | "btree_min" | "btree_sum" | "btree_lattice" | "lattice" => {
                    word!("the-greatest-can-be-kept-by-subsumption")
                }
                _ => word!("remove-this-word-relations-are-all-kept"),
            };
            return input.refuse(RuleError::Unsupported {
                what: said!("the-property", word),
                help,
                at: name.at.into(),
            });
        }
    };
    Ok((rest, (name, qualifier)))
}

// .type Place <: symbol        .type Thing = Place | Tool
fn type_item(input: Input<'_>) -> Read<'_, Item> {
    let (input, type_name) = name(input)?;
    let mut behind = input.rest.iter().map(|token| &token.word);
    let is_bare = match (behind.next(), behind.next()) {
        (Some(Word::Sign("<:" | "=")), _) => false,
        // The next fact or rule.
        (Some(Word::Name(_)), next) => matches!(next, Some(Word::Sign("(" | "."))),
        _ => true,
    };
    if is_bare {
        // As Soufflé read it once: a type of its own among the symbols.
        let bases = vec![Name { text: "symbol".into(), at: type_name.at }];
        return Ok((input, Item::Type { name: type_name, bases, is_union: false }));
    }
    let (rest, sign_word) = alt((sign("<:"), sign("="))).parse(input)?;
    let fields = |open, close| {
        let field = separated_pair(name, sign(":"), long_name);
        delimited(sign(open), opt(list(field, sign(","))), sign(close))
            .map(Option::unwrap_or_default)
    };
    match rest.rest {
        [Token { word: Word::Sign("["), .. }, ..] => {
            let (rest, fields) = fields("[", "]").parse(rest)?;
            let branches = vec![Branch { name: type_name.clone(), fields }];
            return Ok((rest, Item::Structure { name: type_name, branches, is_record: true }));
        }
        [Token { word: Word::Name(_), .. }, Token { word: Word::Sign("{"), .. }, ..] => {
            let branch = (name, fields("{", "}")).map(|(name, fields)| Branch { name, fields });
            let (rest, branches) = list(branch, sign("|")).parse(rest)?;
            return Ok((rest, Item::Structure { name: type_name, branches, is_record: false }));
        }
        _ => {}
    }
    let (rest, bases) = list(long_name, sign("|")).parse(rest)?;
    if bases.len() > 1 && sign_word == "<:" {
        return rest.fail(word!("sign-of-equality"));
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
    let (input, relations) = list(long_name, sign(",")).parse(input)?;
    let minus = preceded(sign("-"), number).map(|n| format!("-{}", n.0));
    let value =
        alt((text_word, name.map(|name| name.text), number.map(|n| n.0.to_string()), minus));
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
fn plan(at: Span, input: Input<'_>) -> Read<'_, Item> {
    let number = |input| number.map(|(number, _)| number).parse(input);
    let order = delimited(sign("("), opt(list(number, sign(","))), sign(")"));
    list(separated_pair(number, sign(":"), order.map(Option::unwrap_or_default)), sign(","))
        .map(|orders| Item::Plan { orders, at })
        .parse(input)
}

// above(A, B), over(A, B) :- body.
fn rule(input: Input<'_>) -> Read<'_, Item> {
    let start = input.at();
    let (input, heads) = list(atom, sign(",")).parse(input)?;
    if let ([dominated], [Token { word: Word::Sign("<="), .. }, rest @ ..]) =
        (heads.as_slice(), input.rest)
    {
        let input = Input { rest, ..input };
        let (input, dominating) = atom(input)?;
        let (input, body) = opt(preceded(sign(":-"), disjunction)).parse(input)?;
        let end = input.at();
        let (input, _) = sign(".")(input)?;
        let body = body.unwrap_or(Body::All(Vec::new()));
        let (dominated, at) = (dominated.clone(), start.to(end));
        return Ok((input, Item::Subsumption { dominated, dominating, body, at }));
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
            input.fail(word!("a-premise"))
        }
        ("true", _) => Ok((rest, Body::All(Vec::new()))),
        ("false", _) => Ok((rest, Body::Any(Vec::new()))),
        _ => input.fail(word!("a-premise")),
    }
}

// contains("дверь", Name)
fn matching(input: Input<'_>) -> Read<'_, Body> {
    let (rest, name) = name(input)?;
    let op = match name.text.as_str() {
        "match" => Comparison::Matches,
        "contains" => Comparison::Contains,
        _ => return input.fail(word!("a-premise")),
    };
    let (rest, _) = sign("(")(rest)?;
    let (rest, (left, right)) = separated_pair(expression, sign(","), expression).parse(rest)?;
    let at = name.at.to(rest.at());
    let (rest, _) = sign(")")(rest)?;
    Ok((rest, Body::Compare { op, left, right, at }))
}

pub(super) fn atom(input: Input<'_>) -> Read<'_, Atom> {
    let (rest, relation) = long_name(input)?;
    if functor(&relation.text).is_some() || aggregation(&relation.text).is_some() {
        return input.fail(word!("a-relation"));
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
    let (left, right) = match (op, &left, &right) {
        (Comparison::Equal, Expr::Any(at), Expr::Aggregate { .. }) => (unnamed(*at), right),
        (Comparison::Equal, Expr::Aggregate { .. }, Expr::Any(at)) => (left, unnamed(*at)),
        _ => (left, right),
    };
    Ok((input, Body::Compare { op, left, right, at }))
}

/// What takes an aggregate's value in `_ = min X : { … }`: a variable that nothing else names.
fn unnamed(at: Span) -> Expr {
    Expr::Variable(Name { text: format!("_′{}", at.start), at })
}
