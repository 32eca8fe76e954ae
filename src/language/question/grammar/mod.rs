//! The grammar of questions: words to tokens, tokens to items.
//!
//! ```text
//! sentence = item*
//! item     = link noun (("and" | ",") noun)*  |  noun  |  link  |  value  |  property  |  mark  |  unknown
//! noun     = (article | number | value | superlative | "не" value)* head (owner)?  |  pronoun
//! head     = a name or kind of the map, in any form; or "one", where an English adjective needs one
//! owner    = a noun in the genitive («окно комнаты»), or before the head ("the kitchen table")
//! ```
//! A name is the longest run of words that the lexicon knows; it wins over the vocabulary where it is longer.

mod governed;
mod leading;
mod measures;
mod modifier;
mod nearest;
mod pointing;
mod relative;
mod tokens;

use std::iter::{Copied, Enumerate};
use std::ops::Range;
use std::slice::Iter;

use nom::branch::alt;
use nom::combinator::{map, opt, verify};
use nom::error::{Error, ErrorKind};
use nom::multi::{many0, many1};
use nom::sequence::pair;
use nom::{IResult, Input, Needed, Parser};

use modifier::Modifier;

use super::lexicon::{KindId, Lexicon};
use super::mark::{Mark, Pronoun};
use super::query::{Best, Filter, Head, Noun, Rel, Restriction, Sized};
use super::values::{Property, ValueId};
use crate::map::Entity;
use crate::sets::Set;
use crate::units::name_key;
use crate::words::{Case, Language, Number, Readings};

pub(super) use pointing::{are_shown, points};
pub(super) use tokens::number_of;

/// A word or phrase with what it is. `words` counts words of the sentence.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Token {
    pub(super) from: u32,
    pub(super) to: u32,
    kind: Tok,
}

#[derive(Debug, Clone, Copy, PartialEq)]
enum Tok {
    Mark(Mark),
    Noun(u32),
    Value(ValueId),
    Property(u32),
    Number(u64),
    Size(Sized),
    Unknown,
}

/// What a noun of the sentence may mean, before its number and place in the question decide.
#[derive(Debug, Clone, Default)]
struct Found {
    named: Vec<Entity>,
    kinds: Vec<KindId>,
    readings: Vec<Readings>,
    is_area: bool,
    /// A storey, which people number: «второй этаж», "floor 2".
    is_storey: bool,
    /// A kind whose name may stand before a thing's own: «помещение Туалет», «этаж L2».
    is_general: bool,
    /// Doors: what is called so behind the word is one, and neither a point nor a thing.
    is_doors: bool,
    /// Any thing at all, and nothing else.
    is_thing: bool,
}

/// A sentence cut into tokens.
pub(super) struct Sentence<'t> {
    pub(super) text: &'t str,
    pub(super) language: Language,
    pub(super) words: Vec<Range<usize>>,
    pub(super) keys: Vec<String>,
    tokens: Vec<Token>,
    nouns: Vec<Found>,
    properties: Vec<Property>,
    /// The property of each value that was said.
    value_sorts: Vec<(ValueId, Property)>,
}

/// One part of a question.
#[expect(clippy::large_enum_variant, reason = "a sentence has a dozen of them, read once")]
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Item {
    Mark(Mark),
    Noun(Phrase),
    /// A preposition and what follows it.
    Place {
        rel: Rel,
        nouns: Vec<Phrase>,
        either: bool,
    },
    /// A preposition with nothing after it.
    Link(Rel),
    Value(ValueId),
    Property(Property),
    Number(u64),
    Size(Sized),
    /// Words that nothing knows.
    Unknown(Range<usize>),
}

/// A noun of the sentence with the words that it takes.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Phrase {
    pub(super) noun: Noun,
    pub(super) words: Range<usize>,
    pub(super) pronoun: Option<Pronoun>,
    /// The robot, or the person who asks.
    pub(super) person: Option<Mark>,
    /// May it be the subject of a Russian sentence.
    pub(super) nominative: bool,
    /// What the form of its head may be.
    pub(super) cases: Vec<Readings>,
    /// As a nominative it can only be a plural: «лампы».
    only_plural_nominative: bool,
}

/// Tokens that are still to be read; the input of the parsers.
#[derive(Debug, Clone, Copy)]
struct Tokens<'a>(&'a [Token]);

impl<'a> Tokens<'a> {
    fn split_first(self) -> Option<(&'a Token, Self)> {
        self.0.split_first().map(|(first, rest)| (first, Self(rest)))
    }
}

impl<'a> Input for Tokens<'a> {
    type Item = Token;
    type Iter = Copied<Iter<'a, Token>>;
    type IterIndices = Enumerate<Self::Iter>;

    fn input_len(&self) -> usize {
        self.0.len()
    }

    fn take(&self, index: usize) -> Self {
        Self(&self.0[..index])
    }

    fn take_from(&self, index: usize) -> Self {
        Self(&self.0[index..])
    }

    fn take_split(&self, index: usize) -> (Self, Self) {
        (self.take_from(index), self.take(index))
    }

    fn position<P: Fn(Self::Item) -> bool>(&self, predicate: P) -> Option<usize> {
        self.0.iter().position(|token| predicate(*token))
    }

    fn iter_elements(&self) -> Self::Iter {
        self.0.iter().copied()
    }

    fn iter_indices(&self) -> Self::IterIndices {
        self.iter_elements().enumerate()
    }

    fn slice_index(&self, count: usize) -> Result<usize, Needed> {
        if count <= self.0.len() { Ok(count) } else { Err(Needed::new(count - self.0.len())) }
    }
}

/// What a noun's head was, with its owner and how it belongs to that.
type HeadParsed<'a, 's> =
    Result<(Tokens<'a>, Option<&'s Found>, Option<(Rel, Noun)>), nom::Err<Error<Tokens<'a>>>>;

type Parsed<'a, O> = IResult<Tokens<'a>, O>;

impl<'t> Sentence<'t> {
    /// The text from one word to another.
    pub(super) fn said(&self, words: &Range<usize>) -> &'t str {
        match (
            self.words.get(words.start),
            words.end.checked_sub(1).and_then(|l| self.words.get(l)),
        ) {
            (Some(first), Some(last)) => &self.text[first.start..last.end],
            _ => "",
        }
    }

    /// Whether a comma or a colon stands between two words.
    pub(super) fn comma_between(&self, end: usize, start: usize) -> bool {
        match (end.checked_sub(1).and_then(|n| self.words.get(n)), self.words.get(start)) {
            (Some(before), Some(after)) if before.end <= after.start => {
                self.text[before.end..after.start].contains([',', ':'])
            }
            _ => false,
        }
    }

    /// Whether a colon stands before a word.
    pub(super) fn colon_before(&self, at: usize) -> bool {
        let before = at.checked_sub(1).and_then(|n| self.words.get(n));
        let between = before.zip(self.words.get(at)).map(|(a, b)| a.end..b.start);
        between.and_then(|gap| self.text.get(gap)).is_some_and(|gap| gap.contains(':'))
    }

    /// The words that tell one thing from another: names, numbers, values other than states, each in the place where it
    /// was said. No reading may do without them.
    pub(super) fn content(&self, lexicon: &Lexicon) -> Vec<Range<usize>> {
        let tells = |token: &&Token| match token.kind {
            Tok::Noun(_) | Tok::Number(_) | Tok::Size(_) => true,
            Tok::Value(value) => lexicon.values.entry(value).property != Property::State,
            Tok::Mark(_) | Tok::Property(_) | Tok::Unknown => false,
        };
        let words = |token: &Token| token.from as usize..token.to as usize;
        self.tokens.iter().filter(tells).map(words).collect()
    }

    /// All items of the sentence.
    pub(super) fn items(&self) -> Vec<Item> {
        let item = |input| self.item(input);
        many0(item).parse(Tokens(&self.tokens)).map_or_else(|_| Vec::new(), |(_, items)| items)
    }

    fn item<'a>(&self, input: Tokens<'a>) -> Parsed<'a, Item> {
        alt((
            |i| self.place(i),
            map(|i| self.free_phrase(i), Item::Noun),
            |i| self.single(i),
            |i| self.unknown(i),
        ))
        .parse(input)
    }

    fn mark<'a>(&self, input: Tokens<'a>, wanted: impl Fn(Mark) -> bool) -> Parsed<'a, Mark> {
        match input.split_first() {
            Some((Token { kind: Tok::Mark(mark), .. }, rest)) if wanted(*mark) => Ok((rest, *mark)),
            _ => fail(input),
        }
    }

    /// A comma before what follows.
    fn comma<'a>(&self, input: Tokens<'a>) -> Parsed<'a, ()> {
        match input.0.first().map(|token| token.from as usize) {
            Some(next) if self.comma_between(next, next) => Ok((input, ())),
            _ => fail(input),
        }
    }

    /// Whether the first noun among tokens is that of a room.
    pub(super) fn begins_with_area(&self, tokens: &[Token]) -> bool {
        let noun = tokens.iter().find_map(|token| match token.kind {
            Tok::Noun(n) => Some(n as usize),
            _ => None,
        });
        noun.is_some_and(|n| self.nouns[n].is_area)
    }

    /// A preposition with one noun or several.
    fn place<'a>(&self, input: Tokens<'a>) -> Parsed<'a, Item> {
        let (rest, mark) = self.mark(input, |m| matches!(m, Mark::Link(_)))?;
        let Mark::Link(rel) = mark else { return fail(input) };
        let Ok((rest, first)) = self.phrase(rest).or_else(|_| self.valued(rest)) else {
            return Ok((rest, Item::Link(rel)));
        };
        if self.is_what_sort(&input.0[0], &first) {
            return Ok((rest, Item::Noun(first)));
        }
        if self.is_leaning(&input.0[0], rel, &first) {
            return Ok((Tokens(&input.0[1..]), Item::Link(rel)));
        }
        let rel = self.having(&input.0[0], &first).unwrap_or(rel);
        let joint = |i| self.mark(i, |m| matches!(m, Mark::And | Mark::Or));
        // «на столе и в шкафу» names the preposition anew; «между столом и шкафом» does not.
        // «в гостиной и на кухне»: in both rooms, whichever preposition each takes.
        let of_rooms = matches!(rel, Rel::In | Rel::On) && self.begins_with_area(&input.0[1..]);
        let in_room =
            |i: Tokens<'a>| of_rooms && i.0.get(1..).is_some_and(|i| self.begins_with_area(i));
        let again = |i: Tokens<'a>| {
            let same = |m| match m {
                Mark::Link(Rel::In | Rel::On) if in_room(i) => true,
                mark => mark == Mark::Link(rel),
            };
            opt(|i| self.mark(i, same)).parse(i)
        };
        let next = |i| self.governed_alike(i, rel, &first);
        // "In the hall, the kitchen and the bathroom"; "nearer to the hall, the kitchen or the bathroom" compares the latter.
        let listed = |i: Tokens<'a>| {
            let (rest, again) = again(self.comma(i)?.0)?;
            match of_rooms && self.begins_with_area(rest.0) {
                true => next(rest).map(|(rest, noun)| (rest, ((Mark::And, again), noun))),
                false => fail(i),
            }
        };
        let further = |((_, again), noun): &((Mark, Option<Mark>), Phrase)| {
            let is_bare = again.is_none() && rel != Rel::Between;
            !(is_bare && self.is_sought_too(&input.0[0], &first.noun, &noun.noun))
        };
        // "Which is bigger, the table in the kitchen or the one in the hall?": no place, but another table.
        let of_place = |i: Tokens<'a>| {
            let (rest, found) = pair(pair(joint, again), next).parse(i)?;
            let placed = matches!(rest.0.first().map(|t| t.kind), Some(Tok::Mark(Mark::Link(_))))
                || !found.1.noun.restrictions.is_empty();
            let compared = placed && found.0.1.is_none() && pointing::points(&found.1.noun);
            if compared { fail(i) } else { Ok((rest, found)) }
        };
        let joined = |i| many0(verify(of_place, further)).parse(i);
        let list = many1(listed).parse(rest).and_then(|(after, listed)| {
            let (after, joined) = joined(after)?;
            Ok((after, listed.into_iter().chain(joined).collect::<Vec<_>>()))
        });
        let ends = |list: &[((Mark, Option<Mark>), Phrase)]| match list {
            [.., before, last] => before.0.0 == Mark::And && last.0.0 == Mark::And,
            _ => false,
        };
        let (rest, more) = match list {
            Ok((after, list)) if ends(&list) => (after, list),
            _ => joined(rest)?,
        };
        let either = more.iter().any(|((joint, _), _)| *joint == Mark::Or);
        let nouns = std::iter::once(first).chain(more.into_iter().map(|(_, noun)| noun)).collect();
        Ok((rest, Item::Place { rel, nouns, either }))
    }

    /// A noun that no preposition governs. Then «лампы» are several: as a genitive it would follow a noun or «нет».
    fn free_phrase<'a>(&self, input: Tokens<'a>) -> Parsed<'a, Phrase> {
        let (rest, mut phrase) = self.phrase(input)?;
        let before =
            self.tokens.iter().rev().find(|t| input.0.first().is_some_and(|f| t.to <= f.from));
        // «какого цвета чашки»: the property stands in the genitive itself, and governs nothing.
        let of_what = matches!(before.map(|t| t.kind), Some(Tok::Property(n)) if {
            let said = before.map(|t| self.keys[t.from as usize].as_str());
            let own = self.properties[n as usize].noun(Language::Russian);
            said.is_none_or(|said| said != name_key(&own))
        });
        // «В какой комнате полотенца?»: what is asked for has no owner.
        let asked = matches!(before.map(|t| t.kind), Some(Tok::Noun(_)))
            && before.is_some_and(|noun| {
                let which = self.tokens.iter().rev().find(|t| t.to <= noun.from);
                which.is_some_and(|t| t.kind == Tok::Mark(Mark::Which))
            });
        let governed = !of_what
            && !asked
            && matches!(
                before.map(|t| t.kind),
                Some(
                    Tok::Property(_)
                        | Tok::Noun(_)
                        | Tok::Mark(
                            Mark::HowBig(_)
                                | Mark::Parts
                                | Mark::Describe
                                | Mark::Not
                                | Mark::HowFar
                                | Mark::HowGet
                                | Mark::Except
                                | Mark::Than
                                | Mark::More(_)
                        )
                )
            );
        if self.language == Language::Russian && phrase.only_plural_nominative && !governed {
            phrase.noun.plural = true;
        }
        Ok((rest, phrase))
    }

    /// A noun with what belongs to it.
    fn phrase<'a>(&self, input: Tokens<'a>) -> Parsed<'a, Phrase> {
        let (rest, phrase) = alt((|i| self.person(i), |i| self.described(i))).parse(input)?;
        if phrase.person.is_some() || phrase.pronoun.is_some() {
            return Ok((rest, phrase));
        }
        Ok(self.relative(rest, phrase))
    }

    fn described<'a>(&self, input: Tokens<'a>) -> Parsed<'a, Phrase> {
        let (rest, parts) = many0(|i| self.modifier(i)).parse(input)?;
        let before = input.0.len() - rest.0.len();
        // «Лампа горит, холодильник закрыт»: what stands before a comma tells nothing of the noun behind it.
        if let (Some(Modifier::Value(..)), Some(noun)) = (parts.last(), rest.0.first())
            && self.comma_between(input.0[before - 1].to as usize, noun.from as usize)
        {
            return fail(input);
        }
        let (rest, head, owner) = self.head(rest)?;
        let taken = input.0.len() - rest.0.len();
        let words = input.0[0].from as usize..input.0[taken - 1].to as usize;
        let mut noun = Noun { text: self.said(&words).to_owned(), ..Noun::default() };
        let mut nominative = true;
        let mut only_plural_nominative = false;
        match head {
            Some(found) => {
                noun.head = Head {
                    named: found.named.clone(),
                    kinds: found.kinds.clone(),
                    ..Head::default()
                };
                noun.plural =
                    !found.readings.is_empty() && found.readings.iter().all(|r| !r.is_singular());
                nominative = found.readings.iter().any(|r| {
                    r.has(Number::Singular, Case::Nominative)
                        || r.has(Number::Plural, Case::Nominative)
                });
                only_plural_nominative = found
                    .readings
                    .iter()
                    .any(|r| r.has(Number::Plural, Case::Nominative))
                    && found.readings.iter().all(|r| !r.has(Number::Singular, Case::Nominative));
                if noun.plural && !noun.head.kinds.is_empty() {
                    noun.head.named.clear();
                }
            }
            None => {
                noun.head.anything = true;
                // «те, что на комоде», "the ones on the dresser"
                static SEVERAL: Set = Set::named("SeveralOnes");
                noun.plural = SEVERAL.contains(&self.keys[words.end - 1].as_str());
            }
        }
        // «этаж 2», "floor 2", «2 этаж»
        let (mut rest, mut storey) = (rest, None);
        if head.is_some_and(|found| found.is_storey) && !noun.plural {
            if let Some((Token { kind: Tok::Number(n), .. }, after)) = rest.split_first() {
                (rest, storey) = (after, Some(*n));
            }
            storey = storey.or_else(|| {
                parts.iter().find_map(|part| match part {
                    Modifier::Number(n) => Some(*n),
                    _ => None,
                })
            });
        }
        for part in parts {
            match part {
                Modifier::Number(_) if storey.is_some() => {}
                Modifier::Quantity(quantity) => noun.quantity = quantity,
                Modifier::The => {}
                Modifier::A => noun.indefinite = true,
                Modifier::All => noun.all = true,
                // "Every bedroom": all of the kind, though one room is called so.
                Modifier::Each => {
                    noun.all = true;
                    if !noun.head.kinds.is_empty() {
                        noun.head.named.clear();
                    }
                }
                // "The other bedroom": of the kind, though one room is called so.
                Modifier::Other => {
                    noun.other = true;
                    if !noun.head.kinds.is_empty() {
                        noun.head.named.clear();
                    }
                }
                Modifier::Same => noun.same = true,
                // Of two numbers, or two orders, one would be forgotten.
                Modifier::Number(_) if noun.count.is_some() => return fail(input),
                Modifier::Rank(_) if noun.rank.is_some() => return fail(input),
                Modifier::Best(_) if noun.best.is_some() => return fail(input),
                Modifier::Number(count) => noun.count = Some(count),
                Modifier::Value(value, negated) => {
                    noun.filters.push(Filter::new(value, negated));
                }
                Modifier::OrValue(value) => match noun.filters.last_mut() {
                    Some(filter) => filter.or.push(value),
                    None => noun.filters.push(Filter::new(value, false)),
                },
                Modifier::Best(best) => noun.best = Some(best),
                Modifier::Grade(extreme) if self.tells_one(&noun) => {
                    noun.best = Some(Best { extreme, anchor: None });
                }
                Modifier::Grade(_) => return fail(input),
                Modifier::Rank(rank) => noun.rank = Some(rank),
            }
        }
        noun.rank = storey.or(noun.rank);
        // "Name one thing in the kitchen": one will do.
        let before = self.tokens.iter().rev().find(|t| t.to <= input.0[0].from);
        let is_listed = matches!(before.map(|t| t.kind), Some(Tok::Mark(Mark::List)));
        if is_listed && noun.indefinite && !noun.plural {
            noun.count = noun.count.or(Some(1));
            only_plural_nominative = false;
        }
        // «вторая полка снизу»
        if let (Some(_), None, Some((extreme, after))) =
            (noun.rank.filter(|_| storey.is_none()), &noun.best, self.counted_from(rest))
        {
            noun.best = Some(Best { extreme, anchor: None });
            rest = after;
        }
        if let Some((rel, owner)) = owner {
            noun.restrictions.push(Restriction { rel, anchors: vec![owner], negated: false });
        }
        let (pronoun, person) = (None, None);
        let cases = head.map(|found| found.readings.clone()).unwrap_or_default();
        let phrase =
            Phrase { noun, words, pronoun, person, nominative, cases, only_plural_nominative };
        Ok((rest, phrase))
    }

    /// Whether a description tells which one is meant: «большой стол», not «большие столы» and not "a big table". How
    /// big a thing is that is called big, nothing says.
    fn tells_one(&self, noun: &Noun) -> bool {
        let asks = |t: &Token| matches!(t.kind, Tok::Mark(Mark::Exists | Mark::HowMany));
        !noun.plural
            && !noun.indefinite
            && !noun.all
            && noun.count.is_none()
            && !self.tokens.iter().any(asks)
    }

    /// The head, and its owner with the relation to it.
    fn head<'a>(&self, input: Tokens<'a>) -> HeadParsed<'a, '_> {
        let (rest, found) = match input.split_first() {
            Some((Token { kind: Tok::Noun(n), .. }, rest)) => (rest, &self.nouns[*n as usize]),
            Some((Token { kind: Tok::Mark(Mark::One), .. }, rest)) => {
                return Ok((rest, None, None));
            }
            _ => return Err(nom::Err::Error(Error::new(input, ErrorKind::Tag))),
        };
        // "the kitchen ones"
        if let ([Token { kind: Tok::Mark(Mark::One), .. }, after @ ..], true) =
            (rest.0, found.is_area && self.language == Language::English)
        {
            let words = input.0[0].from as usize..input.0[0].to as usize;
            let head =
                Head { named: found.named.clone(), kinds: found.kinds.clone(), ..Head::default() };
            let text = self.said(&words).to_owned();
            return Ok((
                Tokens(after),
                None,
                Some((Rel::In, Noun { head, text, ..Noun::default() })),
            ));
        }
        let Some((Token { kind: Tok::Noun(n), from, to }, after)) = rest.split_first() else {
            return Ok((rest, Some(found), None));
        };
        let next = &self.nouns[*n as usize];
        // «помещение Туалет», «этаж L2»: the name tells which.
        let asked = self.tokens.iter().rev().find(|t| t.to <= input.0[0].from);
        let asked = asked.map(|t| t.kind);
        // "How many sofa pillows …", "Which sofa pillow …", but "Which shelf are books on?"
        let is_singular = |found: &Found| found.readings.iter().any(|r| r.is_singular());
        let compounds = is_singular(found)
            && match asked {
                Some(Tok::Mark(Mark::HowMany)) => !is_singular(next),
                Some(Tok::Mark(Mark::Which | Mark::What)) => is_singular(next),
                _ => true,
            };
        let asked = matches!(asked, Some(Tok::Mark(Mark::Which | Mark::What | Mark::HowMany)));
        let names = found.is_general
            && found.named.is_empty()
            && !asked
            && next.named.iter().any(|entity| match entity {
                Entity::Map(_) => found.is_storey,
                Entity::Area(_) => found.is_area && !found.is_storey,
                Entity::Door(_) => !found.is_area,
                _ => !found.is_area && !found.is_doors,
            });
        let (end, start) = (input.0[0].to as usize, *from as usize);
        let gap = &self.text[self.words[end - 1].end..self.words[start].start];
        if gap.contains([',', ':', ';', '.', '–', '—', '?']) {
            return Ok((rest, Some(found), None));
        }
        let noun_of = |found: &Found, words: Range<usize>| Noun {
            head: Head {
                named: found.named.clone(),
                kinds: found.kinds.clone(),
                ..Head::default()
            },
            text: self.said(&words).to_owned(),
            ..Noun::default()
        };
        // «лифт lift_24»: a name in other letters is in no case, and so governed by nothing.
        let russian = self.language == Language::Russian;
        let apposed = russian
            && found.is_area
            && !found.is_storey
            && self.text[self.words[start].start..self.words[*to as usize - 1].end].is_ascii()
            && next.named.iter().all(|entity| matches!(entity, Entity::Area(_)))
            && !next.named.is_empty();
        // "The door L1_wc_2": a name that is no word for anything else tells which, in either language.
        let told = russian || found.is_storey || next.kinds.is_empty() && is_singular(found);
        if names && told || apposed {
            return Ok((after, Some(next), None));
        }
        match self.language {
            // «Сколько на столе книг?», «Сколько в доме этажей?»: the genitive is of what is counted.
            Language::Russian if self.is_counted(input.0[0].from, next) => {
                Ok((rest, Some(found), None))
            }
            // «в Комнате-В книг»: a room is not owned by things.
            // «Нет ли на столе чашки?»: the genitive is of what is not there.
            Language::Russian
                if self.keys.iter().any(|key| key == "нет" || key == "нету")
                    && matches!(
                        self.tokens.iter().rev().find(|t| t.to <= input.0[0].from).map(|t| t.kind),
                        Some(Tok::Mark(Mark::Link(_)))
                    ) =>
            {
                Ok((rest, Some(found), None))
            }
            Language::Russian
                if (!found.is_area || next.is_area)
                    && !self.is_subject(input.0[0].from, next)
                    && !self.is_asked_of(input.0[0].from, next, after.0)
                    && next.readings.iter().any(|r| r.has_case(Case::Genitive)) =>
            {
                let mut owner = noun_of(next, *from as usize..*to as usize);
                // «двери туалетов», where one of them is called «Туалет».
                let genitive = next.readings.iter().filter(|r| r.has_case(Case::Genitive));
                owner.plural = genitive.clone().all(|r| !r.is_singular());
                if owner.plural && !owner.head.kinds.is_empty() {
                    owner.head.named.clear();
                }
                Ok((after, Some(found), Some((Rel::Of, owner))))
            }
            // "Where can I watch TV?": after who does it stands what is done.
            Language::English if self.follows_person(input.0[0].from) => {
                Ok((after, Some(next), None))
            }
            // "the kitchen table"
            Language::English if found.is_area && !next.is_area => {
                let words = input.0[0].from as usize..input.0[0].to as usize;
                Ok((after, Some(next), Some((Rel::In, noun_of(found, words)))))
            }
            // "the desk lamp" is a lamp at the desk, not the desk; "are lamps devices" joins nothing.
            Language::English
                if !found.is_area
                    && compounds
                    && !found.kinds.is_empty()
                    && !next.kinds.is_empty() =>
            {
                let words = input.0[0].from as usize..input.0[0].to as usize;
                let owner = Noun { indefinite: true, modifies: true, ..noun_of(found, words) };
                Ok((after, Some(next), Some((Rel::Near, owner))))
            }
            _ => Ok((rest, Some(found), None)),
        }
    }

    fn single<'a>(&self, input: Tokens<'a>) -> Parsed<'a, Item> {
        let Some((first, rest)) = input.split_first() else { return fail(input) };
        let item = match first.kind {
            Tok::Mark(Mark::Grade(_)) => return fail(input),
            Tok::Mark(mark) => Item::Mark(mark),
            Tok::Value(value) => Item::Value(value),
            Tok::Property(n) => Item::Property(self.properties[n as usize].clone()),
            Tok::Number(number) => Item::Number(number),
            Tok::Size(size) => Item::Size(size),
            Tok::Noun(_) | Tok::Unknown => return fail(input),
        };
        Ok((rest, item))
    }

    fn unknown<'a>(&self, input: Tokens<'a>) -> Parsed<'a, Item> {
        let one = |i: Tokens<'a>| match i.split_first() {
            Some((token, rest))
                if matches!(token.kind, Tok::Unknown | Tok::Mark(Mark::Grade(_))) =>
            {
                Ok((rest, *token))
            }
            _ => fail(i),
        };
        let (rest, words) = many1(one).parse(input)?;
        let (first, last) = (words[0], words[words.len() - 1]);
        Ok((rest, Item::Unknown(first.from as usize..last.to as usize)))
    }
}

/// Whether a noun, or what may stand before one, comes next.
fn begins_noun(input: Tokens<'_>) -> bool {
    matches!(
        input.0.first().map(|t| t.kind),
        Some(
            Tok::Noun(_)
                | Tok::Value(_)
                | Tok::Number(_)
                | Tok::Mark(Mark::The | Mark::Best(_) | Mark::Grade(_) | Mark::Rank(_) | Mark::One)
        )
    )
}

fn fail<O>(input: Tokens<'_>) -> Parsed<'_, O> {
    Err(nom::Err::Error(Error::new(input, ErrorKind::Tag)))
}
