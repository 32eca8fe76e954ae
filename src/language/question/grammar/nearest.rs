//! What the nearest is nearest to: «ближайшая к кровати тумбочка», «чашка, ближайшая к окну», "the cup nearest to the
//! window", «ложка, которая ближе к тостеру».
//!
//! Invariant: a superlative that is not read to the end of its «к окну» leaves the noun and the tokens as they were.

use nom::Parser;
use nom::multi::many0;

use super::{Item, Phrase, Sentence, Tok, Token, Tokens};
use crate::question::mark::Mark;
use crate::question::query::{Best, Closeness, Extreme, Head, Noun, Rel, Restriction};
use crate::words::{Case, Language};

impl Sentence<'_> {
    /// A noun with the superlative of distance behind it: behind a comma, a relative pronoun, or in English at once.
    pub(super) fn nearest_after<'a>(
        &self,
        input: Tokens<'a>,
        phrase: &Phrase,
    ) -> Option<(Tokens<'a>, Best)> {
        let first = input.0.first()?;
        let comma = self.comma_between(phrase.words.end, first.from as usize);
        let related = self.is_pronoun(first) || self.keys[first.from as usize] == "что";
        if phrase.noun.best.is_some() || (self.language == Language::Russian && !comma) {
            return None;
        }
        let rest = if related { self.without_verbs(Tokens(&input.0[1..])) } else { input };
        let (extreme, rest) = match rest.0 {
            [Token { kind: Tok::Mark(Mark::BestTo(extreme)), .. }, after @ ..] => {
                let (rest, anchor) = self.phrase(Tokens(after)).ok()?;
                let (rest, anchor) = self.in_room(rest, anchor);
                return Some((rest, best(*extreme, &anchor)?));
            }
            [Token { kind: Tok::Mark(Mark::Best(extreme)), .. }, after @ ..] => (*extreme, after),
            // «которая ближе к тостеру»: than the others are.
            [Token { kind: Tok::Mark(Mark::Nearer(closeness)), .. }, after @ ..] if related => {
                match closeness {
                    Closeness::Nearer => (Extreme::Nearest, after),
                    Closeness::Farther => (Extreme::Farthest, after),
                }
            }
            _ => return None,
        };
        let (rest, anchor) = self.phrase(self.measured_from(extreme, Tokens(rest))?).ok()?;
        let (rest, anchor) = self.in_room(rest, anchor);
        Some((rest, best(extreme, &anchor)?))
    }

    /// «к кровати» between the superlative and the noun: one noun with its adjectives.
    pub(super) fn nearest_to<'a>(
        &self,
        extreme: Extreme,
        input: Tokens<'a>,
    ) -> Option<(Tokens<'a>, Noun)> {
        let (rest, parts) =
            many0(|i| self.modifier(i)).parse(self.measured_from(extreme, input)?).ok()?;
        let [Token { kind: Tok::Noun(n), from, to }, after @ ..] = rest.0 else { return None };
        let next = after.first().map(|t| t.kind);
        // «к окну Комнаты-Z стул»: whose the first is, is left to what reads the whole sentence.
        let owned = matches!(
            after,
            [Token { kind: Tok::Noun(_), .. }, Token { kind: Tok::Noun(_), .. }, ..]
        );
        if owned || !parts.is_empty() || !matches!(next, Some(Tok::Noun(_) | Tok::Value(_))) {
            return None;
        }
        let found = &self.nouns[*n as usize];
        let head =
            Head { named: found.named.clone(), kinds: found.kinds.clone(), ..Head::default() };
        let text = self.said(&(*from as usize..*to as usize)).to_owned();
        Some((Tokens(after), Noun { head, text, ..Noun::default() }))
    }

    /// "The window in the living room": the room right behind a thing tells which one is meant; a room that something is
    /// to go to does not, by its case.
    fn in_room<'a>(&self, input: Tokens<'a>, mut anchor: Phrase) -> (Tokens<'a>, Phrase) {
        let Some(first) = input.0.first() else { return (input, anchor) };
        let room = input.0.iter().find_map(|t| match t.kind {
            Tok::Noun(n) => Some(&self.nouns[n as usize]),
            _ => None,
        });
        let told = room.is_some_and(|found| {
            let has = |case| found.readings.iter().any(|r| r.has_case(case));
            let rests = has(Case::Locative) || has(Case::Prepositional);
            found.is_area
                && (self.language == Language::English || (rests && !has(Case::Accusative)))
        });
        if !told || self.comma_between(anchor.words.end, first.from as usize) {
            return (input, anchor);
        }
        match self.place(input) {
            Ok((rest, Item::Place { rel: rel @ (Rel::In | Rel::On), nouns, .. }))
                if nouns.len() == 1 && nouns[0].person.is_none() && nouns[0].pronoun.is_none() =>
            {
                let anchors = nouns.into_iter().map(|phrase| phrase.noun).collect();
                anchor.noun.restrictions.push(Restriction { rel, anchors, negated: false });
                (rest, anchor)
            }
            _ => (input, anchor),
        }
    }

    /// Behind the preposition of what a distance is measured from.
    fn measured_from<'a>(&self, extreme: Extreme, input: Tokens<'a>) -> Option<Tokens<'a>> {
        let wanted = match extreme {
            Extreme::Nearest => Rel::To,
            Extreme::Farthest => Rel::From,
            _ => return None,
        };
        let (rest, _) = self.mark(input, |m| m == Mark::Link(wanted)).ok()?;
        Some(rest)
    }
}

/// None where the distance is to the robot or the person, or to what was spoken of.
fn best(extreme: Extreme, anchor: &Phrase) -> Option<Best> {
    let named = anchor.person.is_none() && anchor.pronoun.is_none();
    named.then(|| Best { extreme, anchor: Some(Box::new(anchor.noun.clone())) })
}
