//! What stands before a noun and belongs to it: articles, numbers, values, superlatives.
//!
//! Invariant: a word that says something of the noun, and does not tell which one is meant, is no modifier.

use super::{Parsed, Sentence, Tok, Token, Tokens, fail};
use crate::question::mark::Mark;
use crate::question::query::{Best, Extreme, Quantity, Rel};
use crate::question::values::ValueId;
use crate::sets::set;

#[derive(Debug, Clone)]
pub(super) enum Modifier {
    The,
    A,
    All,
    Each,
    Other,
    Same,
    Number(u64),
    Value(ValueId, bool),
    /// «… или белые»: another value that will do.
    OrValue(ValueId),
    Best(Best),
    Grade(Extreme),
    Rank(u64),
    Quantity(Quantity),
}

impl Sentence<'_> {
    /// One word before a noun, or a value with what joins it to another.
    pub(super) fn modifier<'a>(&self, input: Tokens<'a>) -> Parsed<'a, Modifier> {
        let Some((first, rest)) = input.split_first() else { return fail(input) };
        let modifier = match first.kind {
            Tok::Mark(Mark::The) => Modifier::The,
            Tok::Mark(Mark::A) => Modifier::A,
            // "one cup"; "the red one" ends so.
            Tok::Mark(Mark::One)
                if matches!(rest.split_first(), Some((Token { kind: Tok::Noun(_), .. }, _))) =>
            {
                Modifier::A
            }
            Tok::Mark(Mark::All) => Modifier::All,
            Tok::Mark(Mark::Each) => Modifier::Each,
            Tok::Mark(Mark::Other) => Modifier::Other,
            Tok::Mark(Mark::Same) => Modifier::Same,
            Tok::Mark(Mark::Best(extreme)) => match self.nearest_to(extreme, rest) {
                Some((rest, anchor)) => {
                    let anchor = Some(Box::new(anchor));
                    return Ok((rest, Modifier::Best(Best { extreme, anchor })));
                }
                None => Modifier::Best(Best { extreme, anchor: None }),
            },
            Tok::Mark(Mark::Grade(extreme)) => Modifier::Grade(extreme),
            Tok::Mark(Mark::Rank(rank)) => Modifier::Rank(rank),
            Tok::Mark(Mark::Link(_) | Mark::CountedFrom(_))
                if matches!(
                    self.tokens.iter().rev().find(|t| t.to <= first.from).map(|t| t.kind),
                    Some(Tok::Mark(Mark::Rank(_)))
                ) =>
            {
                let Some((extreme, rest)) = self.counted_from(input) else { return fail(input) };
                return Ok((rest, Modifier::Best(Best { extreme, anchor: None })));
            }
            Tok::Mark(Mark::Number(quantity)) => Modifier::Quantity(quantity),
            // "the smaller wardrobe": of two the one that is so.
            Tok::Mark(Mark::More(extreme)) if self.is_the_more(first, rest) => {
                Modifier::Best(Best { extreme, anchor: None })
            }
            Tok::Number(count) => Modifier::Number(count),
            // «Закрыта дверь?» says it of the door; it does not tell which.
            Tok::Value(_) if self.is_predicate(first) => return fail(input),
            // "clean the bathroom": no value stands before an article.
            Tok::Value(_)
                if matches!(
                    rest.split_first(),
                    Some((Token { kind: Tok::Mark(Mark::The | Mark::A), .. }, _))
                ) =>
            {
                return fail(input);
            }
            Tok::Value(value) => Modifier::Value(value, false),
            // «красные или белые чашки», "black and white chairs": either will do.
            Tok::Mark(Mark::Or | Mark::And) => {
                let before = self.tokens.iter().rev().find(|t| t.to <= first.from);
                let (Some(Tok::Value(one)), [Token { kind: Tok::Value(other), .. }, after @ ..]) =
                    (before.map(|t| t.kind), rest.0)
                else {
                    return fail(input);
                };
                let either = first.kind == Tok::Mark(Mark::Or) || self.are_alike(one, *other);
                return match either {
                    true => Ok((Tokens(after), Modifier::OrValue(*other))),
                    false => Ok((Tokens(after), Modifier::Value(*other, false))),
                };
            }
            // «нет чёрных стульев», "no black chairs": there is none of them.
            Tok::Mark(Mark::Not) if set!("NoneOf").contains(&&*self.keys[first.from as usize]) => {
                return fail(input);
            }
            Tok::Mark(Mark::Not) => {
                // «не чёрные стулья»
                return match rest.0 {
                    [Token { kind: Tok::Value(value), .. }, after @ ..]
                        if matches!(
                            after.first().map(|t| t.kind),
                            Some(Tok::Noun(_) | Tok::Mark(Mark::One))
                        ) =>
                    {
                        Ok((Tokens(after), Modifier::Value(*value, true)))
                    }
                    _ => fail(input),
                };
            }
            _ => return fail(input),
        };
        Ok((rest, modifier))
    }

    /// «снизу» behind an ordinal, "from the bottom" behind its noun: from where it counts, and what follows.
    pub(super) fn counted_from<'a>(&self, input: Tokens<'a>) -> Option<(Extreme, Tokens<'a>)> {
        let (first, rest) = input.split_first()?;
        let extreme = match (first.kind, self.keys[first.from as usize].as_str()) {
            (Tok::Mark(Mark::CountedFrom(extreme)), _) => extreme,
            (Tok::Mark(Mark::Link(Rel::On)), "сверху") => Extreme::Topmost,
            (Tok::Mark(Mark::Link(Rel::Under)), "снизу") => Extreme::Bottommost,
            (Tok::Mark(Mark::Link(Rel::LeftOf)), "слева") => Extreme::LeftMost,
            (Tok::Mark(Mark::Link(Rel::RightOf)), "справа") => Extreme::RightMost,
            _ => return None,
        };
        Some((extreme, rest))
    }
}
