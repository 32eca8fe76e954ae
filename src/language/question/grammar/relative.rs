//! Relative clauses: «стол, на котором стоит чашка», "the room where the bed is", «стул, который стоит у окна».
//!
//! Invariant: a clause that is not read to its end leaves the noun and the tokens as they were.

use super::{Item, Phrase, Sentence, Tok, Token, Tokens};
use crate::question::mark::Mark;
use crate::question::query::{Filter, Head, Noun, Rel, Restriction};
use crate::words::Language;

impl Sentence<'_> {
    /// A noun with the relative clause behind it, where there is one.
    pub(super) fn relative<'a>(&self, input: Tokens<'a>, phrase: Phrase) -> (Tokens<'a>, Phrase) {
        if let Some((rest, best)) = self.nearest_after(input, &phrase) {
            let (mut phrase, taken) = (phrase, input.0.len() - rest.0.len());
            phrase.words.end = input.0[taken - 1].to as usize;
            phrase.noun.best = Some(best);
            return (rest, phrase);
        }
        let read = self.borne(input, &phrase).or_else(|| self.standing(input, &phrase));
        let Some((rest, restrictions, filters)) = read else { return (input, phrase) };
        let mut phrase = phrase;
        let taken = input.0.len() - rest.0.len();
        phrase.words.end = input.0[taken - 1].to as usize;
        phrase.noun.restrictions.extend(restrictions);
        phrase.noun.filters.extend(filters);
        (rest, phrase)
    }

    pub(super) fn is_pronoun(&self, token: &Token) -> bool {
        let key = self.keys[token.from as usize].as_str();
        // "that" points, unless it stands behind a noun and before a verb: see `standing`.
        (token.kind == Tok::Mark(Mark::Which) && (key.starts_with("котор") || key == "which"))
            || (token.kind == Tok::Mark(Mark::The) && key == "that")
    }

    /// «на котором стоит чашка», "on which the cup stands", «где стоит чашка»: what the noun has on it or in it.
    fn borne<'a>(
        &self,
        input: Tokens<'a>,
        phrase: &Phrase,
    ) -> Option<(Tokens<'a>, Vec<Restriction>, Vec<Filter>)> {
        let first = input.0.first()?;
        let comma = self.comma_between(phrase.words.end, first.from as usize);
        let (rel, rest) = match input.0 {
            [Token { kind: Tok::Mark(Mark::Link(rel)), .. }, which, after @ ..]
                // "On that table" points.
                if self.is_pronoun(which) && which.kind == Tok::Mark(Mark::Which) =>
            {
                (inverse(*rel)?, Tokens(after))
            }
            [Token { kind: Tok::Mark(Mark::Where), .. }, after @ ..] => {
                let told = match self.language {
                    Language::Russian => comma,
                    // "the room where the bed is", but "in the kitchen where is the bed?"
                    Language::English => {
                        !matches!(after.first().map(|t| t.kind), Some(Tok::Mark(Mark::Be)))
                    }
                };
                if !told {
                    return None;
                }
                // «кровать, где ракетка» has it on itself, «комната, где кровать» in itself.
                let head = self.tokens.iter().find(|t| t.to as usize == phrase.words.end);
                let thing = matches!(head.map(|t| t.kind), Some(Tok::Noun(n)) if !self.nouns[n as usize].is_area);
                (if thing { Rel::Bears } else { Rel::Has }, Tokens(after))
            }
            _ => return None,
        };
        let rest = self.without_verbs(rest);
        // «стул, на котором что-то лежит»
        if let [Token { kind: Tok::Mark(Mark::Anything), .. }, after @ ..] = rest.0 {
            let head = Head { anything: true, ..Head::default() };
            let anchors = vec![Noun { head, indefinite: true, plural: true, ..Noun::default() }];
            let rest = self.without_verbs(Tokens(after));
            return Some((rest, vec![Restriction { rel, anchors, negated: false }], Vec::new()));
        }
        let (rest, borne) = self.phrase(rest).ok()?;
        if borne.person.is_some() || borne.pronoun.is_some() {
            return None;
        }
        let rest = self.without_verbs(rest);
        let anchors = vec![Noun { indefinite: true, ..borne.noun }];
        Some((rest, vec![Restriction { rel, anchors, negated: false }], Vec::new()))
    }

    /// «который стоит у окна», «которая не белая»: where the noun is, or what it is like.
    fn standing<'a>(
        &self,
        input: Tokens<'a>,
        phrase: &Phrase,
    ) -> Option<(Tokens<'a>, Vec<Restriction>, Vec<Filter>)> {
        let (which, after) = input.split_first()?;
        let comma = self.comma_between(phrase.words.end, which.from as usize);
        // «Чашка, что на столе, белая?»
        let before = self.tokens.iter().rev().find(|t| t.to as usize <= phrase.words.start);
        let placed = matches!(before.map(|t| t.kind), Some(Tok::Mark(Mark::Link(_))));
        let that = which.kind == Tok::Mark(Mark::What)
            && self.keys[which.from as usize] == "что"
            && !placed
            && matches!(after.0.first().map(|t| t.kind), Some(Tok::Mark(Mark::Link(_))));
        if !(self.is_pronoun(which) || that) || (self.language == Language::Russian && !comma) {
            return None;
        }
        let mut rest = self.without_verbs(after);
        let negated = matches!(rest.0.first().map(|t| t.kind), Some(Tok::Mark(Mark::Not)));
        if negated {
            rest = self.without_verbs(Tokens(&rest.0[1..]));
        }
        // "the rooms that have a table"
        if let [Token { kind: Tok::Mark(Mark::Have), .. }, after @ ..] = rest.0
            && let Ok((rest, had)) = self.phrase(Tokens(after))
            && had.person.is_none()
            && had.pronoun.is_none()
        {
            let anchors = vec![Noun { indefinite: true, ..had.noun }];
            return Some((rest, vec![Restriction { rel: Rel::Has, anchors, negated }], Vec::new()));
        }
        if let [Token { kind: Tok::Value(value), .. }, after @ ..] = rest.0 {
            return Some((Tokens(after), Vec::new(), vec![Filter::new(*value, negated)]));
        }
        let mut restrictions: Vec<Restriction> = Vec::new();
        // "The bowl that is in the kitchen on the bed": no place narrows a room.
        let mut in_room = false;
        while let Some((after, place)) = self.place(rest).ok().filter(|_| !in_room) {
            let Item::Place { rel, nouns, .. } = place else { return None };
            in_room = self.begins_with_area(&rest.0[1..]);
            rest = after;
            if nouns.iter().any(|n| n.person.is_some() || n.pronoun.is_some()) {
                return None;
            }
            let anchors: Vec<Noun> = nouns.into_iter().map(|n| n.noun).collect();
            let restriction = Restriction { rel, anchors, negated };
            // «на столе у окна»: the later place tells where the former is.
            match restrictions.last_mut().and_then(|r| r.anchors.last_mut()) {
                Some(anchor) => {
                    anchor.restrictions.push(Restriction { negated: false, ..restriction })
                }
                None => restrictions.push(restriction),
            }
        }
        (!restrictions.is_empty()).then_some((rest, restrictions, Vec::new()))
    }

    pub(super) fn without_verbs<'a>(&self, mut input: Tokens<'a>) -> Tokens<'a> {
        while let [Token { kind: Tok::Mark(Mark::Be | Mark::Exists | Mark::Hang), .. }, rest @ ..] =
            input.0
        {
            input = Tokens(rest);
        }
        input
    }
}

/// How the noun lies to what its clause names: a table on which a cup is bears it.
fn inverse(rel: Rel) -> Option<Rel> {
    Some(match rel {
        Rel::On => Rel::Bears,
        Rel::In => Rel::Has,
        Rel::Under => Rel::Above,
        Rel::Above => Rel::Under,
        Rel::NextTo | Rel::Near => rel,
        _ => return None,
    })
}
