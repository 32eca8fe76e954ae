//! Words that point: "that" without a noun, «те, что на комоде», "the one on the left".
//!
//! Invariant: what points means what was spoken of, never all that there is.

use super::{Parsed, Phrase, Sentence, Tok, Token, Tokens, begins_noun};
use crate::question::mark::{Mark, Pronoun};
use crate::question::query::{Noun, Rel};
use crate::question::vocabulary;
use crate::sets::{Set, set};
use crate::words::word_keys;

/// Words that stand for a noun and point at one of those that were spoken of.
static POINTING: Set = Set::named("PointingToNoun");

/// Whether a description is of what a pointing word means: "the one on the left", «те, что на комоде».
pub(in super::super) fn points(noun: &Noun) -> bool {
    let said = |word: &String| POINTING.contains(&word.as_str());
    let keys = word_keys(&noun.text);
    let alone = match &keys[..] {
        [only] => noun.rank.is_some() || stands_for_one(only),
        [the, only] => the == "the" && stands_for_one(only),
        _ => false,
    };
    noun.head.anything && (alone || keys.last().is_some_and(said))
}

/// Whether a description shows several of those that were told: "these books", «перечисленные книги».
pub(in super::super) fn are_shown(noun: &Noun) -> bool {
    let keys = word_keys(&noun.text);
    let mut words = &keys[..];
    // "One of these books", «все эти книги»
    while let Some((taken, Mark::A | Mark::All | Mark::Each | Mark::Link(Rel::Of | Rel::From))) =
        vocabulary::longest(words)
    {
        words = &words[taken..];
    }
    vocabulary::taken_by(Mark::These, words).is_some_and(|taken| taken < words.len())
}

/// "Other", a form of «другой»: «ещё» is other, and stands for no noun.
pub(super) fn stands_for_one(word: &str) -> bool {
    let russian = set!("OtherStem").iter().any(|stem| word.starts_with(stem)) && word != "друг";
    russian || word == "other"
}

impl Sentence<'_> {
    /// What follows "these things", where such words stand: they are "they", whatever they are.
    pub(super) fn after_these_things<'a>(&self, input: Tokens<'a>) -> Option<Tokens<'a>> {
        let [shown, thing, after @ ..] = input.0 else { return None };
        let words = self.keys.get(shown.from as usize..shown.to as usize)?;
        let shows = shown.kind == Tok::Mark(Mark::The)
            && vocabulary::taken_by(Mark::These, words) == Some(words.len());
        let is_thing = match thing.kind {
            Tok::Noun(n) => self.nouns[n as usize].is_thing,
            Tok::Mark(Mark::One) => true,
            _ => false,
        };
        // "Those things on the table", «те вещи, что на столе» are told by the place.
        let placed = matches!(
            after,
            [Token { kind: Tok::Mark(Mark::Link(_) | Mark::What | Mark::Which), .. }, ..]
        );
        (shows && is_thing && !placed).then_some(Tokens(after))
    }

    /// What follows a "these" that is said of no noun, and whom it means: they; a "this" behind "is" or "on": it. So is a
    /// "that" which lies or stands somewhere; of others the exchange tells what they mean.
    fn after_bare<'a>(&self, input: Tokens<'a>) -> Option<(Tokens<'a>, Mark)> {
        let [shown, after @ ..] = input.0 else { return None };
        let words = self.keys.get(shown.from as usize..shown.to as usize)?;
        // "Is this open?", but "this open door"
        let values = after.iter().take_while(|t| matches!(t.kind, Tok::Value(_))).count();
        if shown.kind != Tok::Mark(Mark::The) || begins_noun(Tokens(&after[values..])) {
            return None;
        }
        if vocabulary::taken_by(Mark::These, words) == Some(words.len()) {
            return Some((Tokens(after), Mark::Pronoun(Pronoun::They)));
        }
        let is_a = |token: Option<&Token>, mark: fn(&Mark) -> bool| match token.map(|t| &t.kind) {
            Some(Tok::Mark(said)) => mark(said),
            _ => false,
        };
        let before = self.tokens.iter().take_while(|token| token.from < shown.from).last();
        let [word] = words else { return None };
        let means_it = is_a(before, |m| matches!(m, Mark::Be | Mark::Link(_)))
            && (word == "this" || word == "that" && is_a(after.first(), |m| *m == Mark::Be));
        means_it.then_some((Tokens(after), Mark::Pronoun(Pronoun::Any)))
    }

    /// Whether no noun stands behind the words before this one, nor a value that is said of it.
    pub(in super::super) fn ends_noun(&self, at: usize) -> bool {
        let from = self.tokens.iter().position(|token| token.from as usize >= at);
        let after = from.map_or(&[][..], |from| &self.tokens[from..]);
        let values = after.iter().take_while(|t| matches!(t.kind, Tok::Value(_))).count();
        !begins_noun(Tokens(&after[values..]))
    }

    /// Whether a "this" or "those" stands without a noun: it points at what was spoken of.
    pub(in super::super) fn points(&self) -> bool {
        static THESE: Set = Set::named("These");
        self.tokens.iter().enumerate().any(|(at, token)| {
            let said = &self.keys[token.from as usize..token.to as usize];
            let pointed = matches!(said, [word] if THESE.contains(&word.as_str()));
            let next = self.tokens.get(at + 1).map(|next| next.kind);
            // "everything that is red"
            let before = at.checked_sub(1).map(|before| self.tokens[before].kind);
            let tells = matches!(
                before,
                Some(Tok::Noun(_) | Tok::Mark(Mark::All | Mark::Each | Mark::Anything | Mark::One))
            );
            // "Which room did that end up in?", but "that table", "is it true that the …"
            let ends = !matches!(
                next,
                Some(
                    Tok::Noun(_)
                        | Tok::Value(_)
                        | Tok::Property(_)
                        | Tok::Number(_)
                        | Tok::Unknown
                        | Tok::Size(_)
                        | Tok::Mark(
                            Mark::One
                                | Mark::Other
                                | Mark::The
                                | Mark::A
                                | Mark::All
                                | Mark::Each
                                | Mark::Same
                                | Mark::Best(_)
                                | Mark::More(_)
                                | Mark::Rank(_)
                                | Mark::You
                                | Mark::Me
                                | Mark::Can
                                | Mark::Not
                                | Mark::Exists
                                | Mark::Have
                        )
                )
            );
            pointed && !tells && token.kind == Tok::Mark(Mark::The) && ends
        })
    }

    /// A pronoun, the robot or who asks; "these things" are "they".
    pub(super) fn person<'a>(&self, input: Tokens<'a>) -> Parsed<'a, Phrase> {
        let is_person = |m| matches!(m, Mark::Pronoun(_) | Mark::You | Mark::Me | Mark::There);
        // "Any of these things"
        let any = || {
            let (after, _) = self.mark(input, |m| m == Mark::A).ok()?;
            self.after_these_things(after)
        };
        let (rest, mark) = match self.mark(input, |m| matches!(m, Mark::All | Mark::Each)) {
            Err(_) => match self.after_these_things(input).or_else(any) {
                Some(rest) => (rest, Mark::Pronoun(Pronoun::They)),
                None => match self.after_bare(input) {
                    Some(found) => found,
                    None => self.mark(input, is_person)?,
                },
            },
            // "all of them"; "Are there pillows on both?"
            Ok((after, _)) if let Some(rest) = self.after_these_things(after) => {
                (rest, Mark::Pronoun(Pronoun::They))
            }
            Ok((after, _)) => match self.mark(after, |m| matches!(m, Mark::Pronoun(_))) {
                Err(_)
                    if self.is_both(input.0[0].from)
                        && !begins_noun(after)
                        && !self.joins_rooms(after) =>
                {
                    (after, Mark::Pronoun(Pronoun::They))
                }
                found => found?,
            },
        };
        let last = input.0[input.0.len() - rest.0.len() - 1];
        let words = input.0[0].from as usize..last.to as usize;
        let indefinite = any().is_some();
        let text = self.said(&words).to_owned();
        let noun = Noun { text, indefinite, ..Noun::default() };
        let pronoun = match mark {
            Mark::Pronoun(pronoun) => Some(pronoun),
            _ => None,
        };
        let person = pronoun.is_none().then_some(mark);
        let only_plural_nominative = false;
        Ok((
            rest,
            Phrase {
                noun,
                words,
                pronoun,
                person,
                nominative: true,
                cases: Vec::new(),
                only_plural_nominative,
            },
        ))
    }

    fn is_both(&self, word: u32) -> bool {
        static EACH: Set = Set::named("EachOrBoth");
        EACH.contains(&self.keys[word as usize].as_str())
    }

    /// "Both in the kitchen and in the hall": of rooms, and not of those that were told.
    fn joins_rooms(&self, after: Tokens<'_>) -> bool {
        let and = |t: &Token| t.kind == Tok::Mark(Mark::And);
        match after.0 {
            [Token { kind: Tok::Mark(Mark::Link(_)), .. }, rest @ ..] => {
                self.begins_with_area(rest) && rest.iter().any(and)
            }
            _ => false,
        }
    }

    /// «те, что на комоде», «та, которая у окна»: a pointing word in the place of a noun, told by a clause.
    pub(in super::super) fn points_ahead(&self, at: usize) -> bool {
        POINTING.contains(&self.keys[at].as_str()) && self.is_told_by_clause(at)
    }

    /// Whether a relative clause stands right behind a word.
    pub(in super::super) fn is_told_by_clause(&self, at: usize) -> bool {
        let next = self.keys.get(at + 1).map_or("", String::as_str);
        let clause = next == "что" || next.starts_with("котор");
        clause && self.comma_between(at + 1, at + 1)
    }
}
