//! What a word before a noun makes of it: «с» with the instrumental, «сколько» with a genitive behind a place, a
//! comparative between article and noun, a value that stands for the noun said before.
//!
//! Invariant: the words that are read are those that the caller takes.

use super::{Found, Parsed, Phrase, Sentence, Tok, Token, Tokens, fail};
use crate::question::mark::Mark;
use crate::question::query::{Filter, Head, Noun, Rel};
use crate::question::values::ValueId;
use crate::sets::{Set, set};
use crate::words::{Case, Language, Number};

impl Sentence<'_> {
    /// «рядом с красной»: a value for the noun that has been said.
    pub(super) fn valued<'a>(&self, input: Tokens<'a>) -> Parsed<'a, Phrase> {
        let [first @ Token { kind: Tok::Value(value), .. }, rest @ ..] = input.0 else {
            return fail(input);
        };
        let words = first.from as usize..first.to as usize;
        let said = self.nouns.iter().any(|n| !n.kinds.is_empty());
        let one = words.len() == 1 && self.language == Language::Russian && said;
        if !one || self.is_predicate(first) {
            return fail(input);
        }
        let noun = Noun {
            head: Head { anything: true, ..Head::default() },
            text: self.said(&words).to_owned(),
            filters: vec![Filter::new(*value, false)],
            ..Noun::default()
        };
        let phrase = Phrase {
            noun,
            words,
            pronoun: None,
            person: None,
            nominative: false,
            cases: Vec::new(),
            only_plural_nominative: false,
        };
        Ok((Tokens(rest), phrase))
    }

    /// A further noun behind a preposition, in a case of the first: «картина в ванной или телевизор» joins no places.
    /// Something is always between two.
    pub(super) fn governed_alike<'a>(
        &self,
        input: Tokens<'a>,
        rel: Rel,
        first: &Phrase,
    ) -> Parsed<'a, Phrase> {
        let (rest, next) = self.phrase(input)?;
        let told = !first.cases.is_empty() && !next.cases.is_empty();
        let case = |case: Case| {
            let has = |phrase: &Phrase| phrase.cases.iter().any(|r| r.has_case(case));
            has(first) && has(&next)
        };
        let alike = [
            Case::Genitive,
            Case::Dative,
            Case::Accusative,
            Case::Instrumental,
            Case::Prepositional,
        ];
        let asked = self.language == Language::Russian && told && rel != Rel::Between;
        match asked && !alike.into_iter().any(case) {
            true => fail(input),
            false => Ok((rest, next)),
        }
    }

    /// "Is there a cup in the kitchen and a plate?": what is any one of its kind, behind a place that is a certain one, is
    /// sought as the cup is. Russian has cases for it.
    pub(super) fn is_sought_too(&self, link: &Token, place: &Noun, next: &Noun) -> bool {
        let is_any = |noun: &Noun| noun.head.things.is_none() && (noun.indefinite || noun.plural);
        let before = || self.tokens.iter().take_while(|token| token.to <= link.from);
        self.language == Language::English
            && is_any(next)
            && !is_any(place)
            && before().any(|token| token.kind == Tok::Mark(Mark::Exists))
            && before().any(|token| matches!(token.kind, Tok::Noun(_)))
    }

    /// «К чему прислонён зонт?»: what leans follows in the nominative; what it leans against would stand in the dative.
    pub(super) fn is_leaning(&self, link: &Token, rel: Rel, next: &Phrase) -> bool {
        let bare = self.keys[link.to as usize - 1] != "к";
        let dative = next.cases.iter().any(|r| r.has_case(Case::Dative));
        bare && matches!(rel, Rel::Leaning | Rel::Facing)
            && self.language == Language::Russian
            && !dative
            && !next.cases.is_empty()
    }

    /// Whether two values are of one property, so that no thing has both.
    pub(super) fn are_alike(&self, one: ValueId, other: ValueId) -> bool {
        let property =
            |id: ValueId| self.value_sorts.iter().find(|(v, _)| *v == id).map(|(_, p)| p);
        property(one).is_some() && property(one) == property(other)
    }

    /// «комната с телевизором»: with the instrumental «с» tells what something has.
    pub(super) fn having(&self, link: &Token, phrase: &Phrase) -> Option<Rel> {
        let with = set!("With").contains(&self.keys[link.from as usize].as_str());
        let joins = self.tokens.iter().any(|t| t.kind == Tok::Mark(Mark::Lead));
        let is = |case: Case| phrase.cases.iter().any(|r| r.has_case(case));
        let having = link.to - link.from == 1 && with && !joins;
        (having && is(Case::Instrumental) && !is(Case::Genitive)).then_some(Rel::Has)
    }

    /// Whether a genitive plural behind a place belongs to the «сколько» before it, which has no noun of its own.
    pub(super) fn is_counted(&self, place: u32, next: &Found) -> bool {
        let before: Vec<&Token> = self.tokens.iter().filter(|t| t.to <= place).collect();
        // «На стеллаже книг больше, чем на столе?» counts them as well.
        let compares = |t: &Token| matches!(t.kind, Tok::Mark(Mark::More(_)));
        let counts = before.iter().rposition(|t| t.kind == Tok::Mark(Mark::HowMany));
        let more = self.tokens.iter().any(compares).then_some(0);
        let Some(asks) = counts.or(more) else { return false };
        matches!(before.last().map(|t| t.kind), Some(Tok::Mark(Mark::Link(_))))
            && before[asks..].iter().all(|t| !matches!(t.kind, Tok::Noun(_)))
            && next.readings.iter().any(|r| r.has(Number::Plural, Case::Genitive))
    }

    /// «Есть ли в холодильнике яйца?»: behind a place the only other noun of a yes-or-no question is what it asks of.
    pub(super) fn is_subject(&self, place: u32, next: &Found) -> bool {
        let before = self.tokens.iter().rev().find(|t| t.to <= place).map(|t| t.kind);
        let asks = |t: &Token| {
            matches!(
                t.kind,
                Tok::Property(_)
                    | Tok::Mark(
                        Mark::What
                            | Mark::Which
                            | Mark::Where
                            | Mark::Whither
                            | Mark::HowMany
                            | Mark::HowFar
                            | Mark::HowGet
                            | Mark::HowBig(_)
                            | Mark::Describe
                            | Mark::List
                            | Mark::Anything
                    )
            )
        };
        let nouns = self.tokens.iter().filter(|t| matches!(t.kind, Tok::Noun(_))).count();
        let is_verb = |t: &Token| matches!(t.kind, Tok::Mark(Mark::Exists | Mark::Be));
        matches!(before, Some(Tok::Mark(Mark::Link(_))))
            && nouns == 2
            && self.tokens.iter().any(is_verb)
            && !self.tokens.iter().any(asks)
            && next.readings.iter().any(|r| r.has(Number::Plural, Case::Nominative))
    }

    /// «На каком столе помидор?»: the form is a genitive of several too, but what is asked for has no owner, and of
    /// what it is asked nothing else says.
    pub(super) fn is_asked_of(&self, place: u32, next: &Found, after: &[Token]) -> bool {
        let mut before = self.tokens.iter().rev().filter(|t| t.to <= place).map(|t| t.kind);
        let asked = before.next() == Some(Tok::Mark(Mark::Which))
            && matches!(before.next(), Some(Tok::Mark(Mark::Link(_))));
        let nouns = self.tokens.iter().filter(|t| matches!(t.kind, Tok::Noun(_))).count();
        let verb = |t: &Token| matches!(t.kind, Tok::Mark(Mark::Exists | Mark::Be | Mark::Hang));
        let nominative = |number| next.readings.iter().any(|r| r.has(number, Case::Nominative));
        asked
            && nouns == 2
            && !next.is_area
            && after.iter().all(verb)
            && (nominative(Number::Singular) || nominative(Number::Plural))
    }

    /// «Что за комната Комната-Z?»: with a nominative «за» puts nothing behind anything.
    pub(super) fn is_what_sort(&self, link: &Token, phrase: &Phrase) -> bool {
        let what = self.tokens.iter().rev().find(|t| t.to <= link.from).map(|t| t.kind);
        self.keys[link.from as usize] == "за"
            && what == Some(Tok::Mark(Mark::What))
            && !phrase.cases.is_empty()
            && phrase.cases.iter().all(|r| !r.has_case(Case::Instrumental))
            && phrase.nominative
    }

    /// A short form of a participle, which no Russian noun takes.
    pub(super) fn is_predicate(&self, token: &Token) -> bool {
        static STEMS: Set = Set::named("StateStem");
        let key = &self.keys[token.from as usize];
        STEMS.iter().any(|stem| {
            key.strip_prefix(stem).is_some_and(|end| ["", "а", "о", "ы"].contains(&end))
        })
    }

    /// Whether the word before says who does it: "I" or "you", and not "me" in "bring me the milk".
    pub(super) fn follows_person(&self, at: u32) -> bool {
        let Some(before) = self.tokens.iter().rev().find(|t| t.to <= at) else { return false };
        let key = self.keys[before.from as usize].as_str();
        matches!(before.kind, Tok::Mark(Mark::Me | Mark::You)) && !["me", "us"].contains(&key)
    }

    /// "the smaller wardrobe": a comparative right before its noun.
    pub(super) fn is_the_more(&self, more: &Token, rest: Tokens<'_>) -> bool {
        let before = self.tokens.iter().rev().find(|t| t.to <= more.from);
        let noun =
            matches!(rest.0.first().map(|t| t.kind), Some(Tok::Noun(_) | Tok::Mark(Mark::One)));
        noun && self.language == Language::English
            && before.is_some_and(|t| t.kind == Tok::Mark(Mark::The))
    }
}
