//! From items to a query: which question is asked, and what part each noun and place plays in it.
//!
//! Word order decides only where nothing else does. The rules stand in the order in which they are tried: the more
//! telling a word is («ближе», "how far"), the earlier its rule.

use super::Doubt;
use super::grammar::{Item, Phrase, Sentence};
use super::lexicon::{Extension, Lexicon};
use super::query::{
    Best, Claim, Closeness, Extreme, Filter, Head, Noun, Query, Rel, Restriction, Thing, Use,
};
use super::values::{Property, ValueId};
use super::vocabulary::{Mark, Pronoun};

/// What a pronoun of the sentence means.
pub(super) type Referent<'a> = dyn Fn(Pronoun) -> Vec<Thing> + 'a;

/// Reads a query out of the items of a sentence.
pub(super) fn query(
    sentence: &Sentence<'_>,
    lexicon: &Lexicon,
    referent: &Referent<'_>,
) -> Result<Query, Doubt> {
    let items = sentence.items();
    if items.is_empty() {
        return Err(Doubt::Empty);
    }
    let frame = Frame::of(sentence, lexicon, &items, referent)?;
    if let Some(query) = frame.read() {
        return Ok(query);
    }
    Err(frame.not_understood(&items))
}

/// A sentence that is a description and nothing more: «красная», «та, что на столе».
pub(super) fn fragment(sentence: &Sentence<'_>, lexicon: &Lexicon) -> Option<Noun> {
    let items = sentence.items();
    let frame = Frame::of(sentence, lexicon, &items, &|_| Vec::new()).ok()?;
    let small = |mark: &Mark| {
        matches!(mark, Mark::The | Mark::A | Mark::Be | Mark::One | Mark::Best(_) | Mark::And)
    };
    if items.is_empty() || frame.nouns.len() > 1 || !frame.marks.iter().all(|(mark, _)| small(mark))
    {
        return None;
    }
    Some(frame.with_rest(frame.first().unwrap_or_default(), &[]))
}

/// A noun of the question.
#[derive(Debug, Clone)]
struct Subject {
    noun: Noun,
    at: usize,
    negated: bool,
    nominative: bool,
}

/// A preposition with its nouns.
#[derive(Debug, Clone)]
struct Spot {
    rel: Rel,
    nouns: Vec<Noun>,
    either: bool,
    at: usize,
    negated: bool,
}

impl Spot {
    fn restrictions(&self) -> Vec<Restriction> {
        if self.rel == Rel::Between {
            return vec![Restriction {
                rel: self.rel,
                anchors: self.nouns.clone(),
                negated: self.negated,
            }];
        }
        // «в спальне и коридоре»: in either of them.
        vec![Restriction { rel: self.rel, anchors: self.nouns.clone(), negated: self.negated }]
    }

    fn each(&self) -> impl Iterator<Item = Restriction> + '_ {
        self.nouns.iter().map(|noun| Restriction {
            rel: self.rel,
            anchors: vec![noun.clone()],
            negated: self.negated,
        })
    }
}

/// The items of a sentence by what they are.
struct Frame<'s, 't> {
    sentence: &'s Sentence<'t>,
    lexicon: &'s Lexicon,
    marks: Vec<(Mark, usize)>,
    nouns: Vec<Subject>,
    spots: Vec<Spot>,
    links: Vec<(Rel, usize)>,
    values: Vec<(ValueId, usize, bool)>,
    property: Option<(Property, usize)>,
    /// The robot is spoken to.
    you: bool,
    /// «там», "there"
    there: Option<Noun>,
    negated: bool,
    /// «кроме лампы»
    except: Vec<Noun>,
}

fn things(things: Vec<Thing>, text: &str) -> Noun {
    let plural = things.len() > 1;
    let head = Head { things: Some(things), ..Head::default() };
    Noun { head, text: text.to_owned(), plural, all: plural, ..Noun::default() }
}

impl<'s, 't> Frame<'s, 't> {
    fn of(
        sentence: &'s Sentence<'t>,
        lexicon: &'s Lexicon,
        items: &[Item],
        referent: &Referent<'_>,
    ) -> Result<Self, Doubt> {
        let mut frame = Self {
            sentence,
            lexicon,
            marks: Vec::new(),
            nouns: Vec::new(),
            spots: Vec::new(),
            links: Vec::new(),
            values: Vec::new(),
            property: None,
            you: false,
            there: None,
            negated: false,
            except: Vec::new(),
        };
        let mut not = false;
        let mut without = false;
        for (at, item) in items.iter().enumerate() {
            match item {
                Item::Mark(Mark::Not) => {
                    not = true;
                    frame.negated = true;
                    frame.marks.push((Mark::Not, at));
                }
                Item::Mark(Mark::Except) => without = true,
                Item::Mark(mark) => frame.marks.push((*mark, at)),
                Item::Noun(phrase) => {
                    let Some(noun) = frame.noun(phrase, referent)? else { continue };
                    if std::mem::take(&mut without) {
                        frame.except.push(noun);
                        continue;
                    }
                    let first = frame.nouns.is_empty();
                    let negated = not && !first && std::mem::take(&mut not);
                    let nominative = phrase.nominative;
                    frame.nouns.push(Subject { noun, at, negated, nominative });
                }
                Item::Place { rel, nouns, either } => {
                    let mut anchors = Vec::new();
                    for phrase in nouns {
                        anchors.extend(frame.noun(phrase, referent)?);
                        if phrase.person == Some(Mark::You) {
                            anchors.push(things(vec![Thing::Robot], "you"));
                        }
                    }
                    if anchors.is_empty() {
                        let words = nouns[0].words.clone();
                        let me = nouns[0].person == Some(Mark::Me);
                        // «у меня есть …», "for me" say nothing of a place.
                        if me && matches!(rel, Rel::NextTo | Rel::To | Rel::Of) {
                            continue;
                        }
                        return Err(Doubt::not_understood(sentence.said(&words)));
                    }
                    let (rel, either) = (*rel, *either);
                    let negated = std::mem::take(&mut not);
                    frame.spots.push(Spot { rel, nouns: anchors, either, at, negated });
                }
                Item::Link(rel) => frame.links.push((*rel, at)),
                Item::Value(value) => {
                    frame.values.push((*value, at, std::mem::take(&mut not)));
                }
                Item::Property(property) => {
                    frame.property.get_or_insert((property.clone(), at));
                }
                Item::Number(number) => {
                    frame.marks.push((if *number == 1 { Mark::A } else { Mark::Filler }, at))
                }
                Item::Unknown(words) => return Err(frame.unknown(words, items.get(at + 1))),
            }
        }
        Ok(frame)
    }

    /// Words that nothing knows: a name that the map lacks, or no word at all.
    fn unknown(&self, words: &std::ops::Range<usize>, next: Option<&Item>) -> Doubt {
        // «Комната-X»: the noun before the hyphen belongs to the name that is not there.
        let mut words = words.clone();
        while words.start > 0 {
            let gap =
                self.sentence.words[words.start - 1].end..self.sentence.words[words.start].start;
            if !self.sentence.text[gap].chars().all(crate::language::words::is_hyphen) {
                break;
            }
            words.start -= 1;
        }
        let said = self.sentence.said(&words);
        let near: Vec<String> =
            self.lexicon.nouns.near(said, 3).into_iter().map(str::to_owned).collect();
        let near: Vec<String> = near.into_iter().fold(Vec::new(), |mut kept, name| {
            if !kept.contains(&name) {
                kept.push(name);
            }
            kept
        });
        let before_noun = matches!(next, Some(Item::Noun(_)));
        if near.is_empty() && (before_noun || !super::may_be_noun(said)) {
            return Doubt::not_understood(said);
        }
        if before_noun && near.is_empty() {
            return Doubt::not_understood(said);
        }
        Doubt::Unknown { reference: said.to_owned(), near }
    }

    fn noun(&mut self, phrase: &Phrase, referent: &Referent<'_>) -> Result<Option<Noun>, Doubt> {
        match (phrase.pronoun, phrase.person) {
            (Some(pronoun), _) => {
                let meant = referent(pronoun);
                if meant.is_empty() {
                    return Err(Doubt::NoReferent { word: phrase.noun.text.clone() });
                }
                Ok(Some(things(meant, &phrase.noun.text)))
            }
            (_, Some(Mark::You)) => {
                self.you = true;
                Ok(None)
            }
            (_, Some(Mark::There)) => {
                let meant = referent(Pronoun::Any);
                let noun = (!meant.is_empty()).then(|| things(meant, &phrase.noun.text));
                self.there = noun;
                Ok(None)
            }
            (_, Some(_)) => Ok(None),
            _ => Ok(Some(phrase.noun.clone())),
        }
    }

    fn has(&self, wanted: Mark) -> bool {
        self.marks.iter().any(|(mark, _)| *mark == wanted)
    }

    fn place_of(&self, wanted: Mark) -> Option<usize> {
        self.marks.iter().find(|(mark, _)| *mark == wanted).map(|(_, at)| *at)
    }

    fn asks(&self) -> bool {
        self.has(Mark::What) || self.has(Mark::Which)
    }

    fn is_kind(&self, noun: &Noun, wanted: impl Fn(&Extension) -> bool) -> bool {
        noun.head.kinds.iter().any(|k| wanted(&self.lexicon.kind(*k).extension))
    }

    /// Rooms and storeys, named or not.
    fn is_area(&self, noun: &Noun) -> bool {
        let named = |e: &crate::map::Entity| {
            matches!(e, crate::map::Entity::Area(_) | crate::map::Entity::Map(_))
        };
        let meant = |things: &Vec<Thing>| things.iter().any(|t| t.area().is_some());
        (!noun.head.named.is_empty() && noun.head.named.iter().all(named))
            || noun.head.things.as_ref().is_some_and(meant)
            || noun.head.kinds.iter().any(|k| self.lexicon.is_area(*k))
    }

    fn is_rooms(&self, noun: &Noun) -> bool {
        noun.head.named.is_empty()
            && self.is_kind(noun, |e| {
                matches!(e, Extension::Rooms | Extension::AreaType(_) | Extension::Storeys)
            })
    }

    fn is_storeys(&self, noun: &Noun) -> bool {
        self.is_kind(noun, |e| matches!(e, Extension::Storeys))
    }

    fn is_building(&self, noun: &Noun) -> bool {
        self.is_kind(noun, |e| matches!(e, Extension::Building))
    }

    fn is_doors(&self, noun: &Noun) -> bool {
        let named = |e: &crate::map::Entity| matches!(e, crate::map::Entity::Door(_));
        let meant = |things: &Vec<Thing>| {
            things.iter().any(|t| {
                matches!(t, Thing::Opening(_) | Thing::Entity(crate::map::Entity::Door(_)))
            })
        };
        noun.head.named.iter().any(named)
            || noun.head.things.as_ref().is_some_and(meant)
            || self.is_kind(noun, |e| {
                matches!(e, Extension::Doors | Extension::Passages | Extension::DoorType(_))
            })
    }

    fn spot(&self, wanted: &[Rel]) -> Option<&Spot> {
        self.spots.iter().find(|s| wanted.contains(&s.rel))
    }

    fn spot_noun(&self, wanted: &[Rel]) -> Option<Noun> {
        self.spot(wanted).and_then(|s| s.nouns.first()).cloned()
    }

    /// The noun of the question, with «там» as its place.
    fn first(&self) -> Option<Noun> {
        self.nouns.first().map(|s| s.noun.clone())
    }

    /// A noun with all places, values and superlatives of the sentence, but for the places left out.
    fn with_rest(&self, mut noun: Noun, without: &[usize]) -> Noun {
        for spot in self.spots.iter().filter(|s| !without.contains(&s.at)) {
            self.attach(&mut noun, spot);
        }
        for (value, _, negated) in &self.values {
            noun.filters.push(Filter { value: *value, negated: *negated });
        }
        noun.except.extend(self.except.iter().cloned());
        if let Some(there) = &self.there {
            noun.restrictions.push(Restriction {
                rel: Rel::In,
                anchors: vec![there.clone()],
                negated: false,
            });
        }
        self.with_best(noun)
    }

    /// A place after another place belongs to the latter («на столе в кухне»); a room narrows both.
    fn attach(&self, noun: &mut Noun, spot: &Spot) {
        if self.is_building(&spot.nouns[0]) && spot.rel == Rel::In {
            return;
        }
        // «в комнате с диваном», «стол с лампой»
        if spot.rel == Rel::Has {
            let area = self.is_area(noun);
            let last = noun.restrictions.last_mut().and_then(|r| r.anchors.last_mut());
            match last {
                Some(anchor) if self.is_area(anchor) => {
                    anchor.restrictions.extend(spot.restrictions())
                }
                _ if area => noun.restrictions.extend(spot.restrictions()),
                _ => {
                    let spot = Spot { rel: Rel::Bears, ..spot.clone() };
                    noun.restrictions.extend(spot.restrictions());
                }
            }
            return;
        }
        let is_room =
            matches!(spot.rel, Rel::In | Rel::On | Rel::Of) && self.is_area(&spot.nouns[0]);
        if is_room && !self.is_area(noun) {
            for restriction in &mut noun.restrictions {
                for anchor in &mut restriction.anchors {
                    if !self.is_area(anchor) && anchor.head.things.is_none() && !spot.negated {
                        anchor.restrictions.extend(spot.restrictions());
                    }
                }
            }
        }
        // «рядом со столом у окна»: the window tells which table.
        let last = noun.restrictions.last_mut().and_then(|r| r.anchors.last_mut());
        match last {
            Some(anchor)
                if !is_room
                    && !self.is_area(anchor)
                    && !self.is_kind(anchor, |e| *e == Extension::Floor)
                    && anchor.head.things.is_none()
                    && spot.at > 0
                    && self.spots.iter().any(|s| s.at + 1 == spot.at)
                    && spot.rel != Rel::To =>
            {
                anchor.restrictions.extend(spot.restrictions());
            }
            _ => noun.restrictions.extend(spot.restrictions()),
        }
    }

    /// Hands a superlative that stands by itself to the noun, and its «к столу» to the superlative.
    fn with_best(&self, mut noun: Noun) -> Noun {
        let alone = self.marks.iter().find_map(|(mark, _)| match mark {
            Mark::Best(extreme) | Mark::BestTo(extreme) => Some(*extreme),
            Mark::Nearer(Closeness::Nearer) => Some(Extreme::Nearest),
            Mark::Nearer(Closeness::Farther) => Some(Extreme::Farthest),
            _ => None,
        });
        if noun.best.is_none() {
            noun.best = alone.map(|extreme| Best { extreme, anchor: None });
        }
        let Some(best) = &mut noun.best else { return noun };
        if matches!(best.extreme, Extreme::Nearest | Extreme::Farthest) && best.anchor.is_none() {
            let is_anchor = |r: &Restriction| {
                matches!(r.rel, Rel::To | Rel::From | Rel::At | Rel::NextTo | Rel::Near)
            };
            let found = noun.restrictions.iter().position(is_anchor);
            if let Some(at) = found {
                let anchor = noun.restrictions.remove(at).anchors.into_iter().next();
                // «ближайший ко мне»: to the robot, as when nothing is said.
                best.anchor = anchor.map(Box::new);
            } else if self.marks.iter().any(|(m, _)| matches!(m, Mark::BestTo(_)))
                && let Some(second) = self.nouns.get(1)
            {
                best.anchor = Some(Box::new(second.noun.clone()));
            }
        }
        noun
    }

    fn read(&self) -> Option<Query> {
        if self.has(Mark::Why) || self.has(Mark::WhyNot) {
            return Some(self.why());
        }
        self.of_robot()
            .or_else(|| self.way())
            .or_else(|| self.compared())
            .or_else(|| self.size())
            .or_else(|| self.use_of_place())
            .or_else(|| self.history())
            .or_else(|| self.counted())
            .or_else(|| self.made_of())
            .or_else(|| self.property())
            .or_else(|| self.leads())
            .or_else(|| self.where_is())
            .or_else(|| self.which())
            .or_else(|| self.listed())
            .or_else(|| self.exists())
            .or_else(|| self.superlative())
            .or_else(|| self.holds())
    }

    fn why(&self) -> Query {
        let negated = self.has(Mark::WhyNot) || self.negated;
        let about = match self.nouns.is_empty() {
            true => None,
            false => self.exists_or_holds(),
        };
        Query::Why { negated, about: about.map(Box::new) }
    }

    fn exists_or_holds(&self) -> Option<Query> {
        self.holds().or_else(|| self.exists())
    }

    fn of_robot(&self) -> Option<Query> {
        if self.has(Mark::Hold) && self.nouns.is_empty() {
            return Some(Query::WhatDoYouHold);
        }
        let rooms_only = self.nouns.iter().all(|s| self.is_rooms(&s.noun));
        let others = !rooms_only || !self.spots.is_empty();
        if self.has(Mark::See) && self.nouns.is_empty() && self.spots.is_empty() {
            return Some(Query::WhatDoYouSee);
        }
        let asks = self.has(Mark::Where) || (self.asks() && !self.nouns.is_empty());
        let moves = self.has(Mark::Can) || self.has(Mark::HowGet) || self.has(Mark::Sit);
        if self.you && asks && !others && !moves && !self.has(Mark::Before) {
            return Some(Query::WhereAreYou);
        }
        None
    }

    fn way(&self) -> Option<Query> {
        let far = self.has(Mark::HowFar);
        if self.asks() && self.has(Mark::Can) && !far && !self.has(Mark::HowGet) {
            return None;
        }
        let how = self.has(Mark::HowGet)
            || (self.has(Mark::How) && (self.has(Mark::Move) || self.has(Mark::Lead)));
        let can = self.has(Mark::Can) && (self.has(Mark::Move) || self.has(Mark::Lead));
        if !(far || how || can) {
            return None;
        }
        let pair = self.spot(&[Rel::Between]).filter(|s| s.nouns.len() == 2);
        if let Some(pair) = pair {
            let (from, to) = (Some(pair.nouns[0].clone()), pair.nouns[1].clone());
            return Some(if far { Query::Distance { from, to } } else { Query::Way { from, to } });
        }
        let from = self.spot(&[Rel::From, Rel::Of]).map(|s| s.nouns[0].clone());
        const TO: [Rel; 12] = [
            Rel::To,
            Rel::In,
            Rel::On,
            Rel::At,
            Rel::NextTo,
            Rel::Near,
            Rel::Under,
            Rel::Behind,
            Rel::InFrontOf,
            Rel::Outside,
            Rel::LeftOf,
            Rel::RightOf,
        ];
        let robot = |noun: &Noun| noun.head.things.as_deref() == Some(&[Thing::Robot][..]);
        let mut ends: Vec<Noun> = self.nouns.iter().map(|s| s.noun.clone()).collect();
        ends.extend(self.there.clone());
        let room = self.spot_noun(&TO);
        let (from, to) = match (from, room, ends.len()) {
            // "How far is the table from the bed?"
            (from, None, 1..) => {
                let second = ends.get(1).cloned();
                (
                    from.or_else(|| second.clone().map(|_| ends[0].clone())),
                    second.unwrap_or_else(|| ends[0].clone()),
                )
            }
            (Some(from), Some(mut to), 1..) if far => {
                // "How far is the chair in the kitchen from the table?"
                if self.is_area(&to) && !self.is_area(&ends[0]) {
                    let place = Restriction { rel: Rel::In, anchors: vec![to], negated: false };
                    to = ends[0].clone();
                    to.restrictions.push(place);
                }
                (Some(from), to)
            }
            (None, Some(to), 1..) if far => (Some(ends[0].clone()), to),
            (from, Some(to), _) => (from, to),
            (Some(from), None, 0) if far => (None, from),
            _ => return None,
        };
        let from = from.filter(|noun| !robot(noun));
        Some(match () {
            () if far => Query::Distance { from, to },
            () if can && !how => Query::CanReach { from, to },
            () => Query::Way { from, to },
        })
    }

    fn compared(&self) -> Option<Query> {
        let nearer = self.marks.iter().find_map(|(mark, _)| match mark {
            Mark::Nearer(closeness) => Some(*closeness),
            _ => None,
        });
        let more = self.marks.iter().find_map(|(mark, _)| match mark {
            Mark::More(extreme) => Some(*extreme),
            _ => None,
        });
        let than = self.place_of(Mark::Than);
        let than_to = self.place_of(Mark::ThanTo);
        if let Some(closeness) = nearer {
            let extreme = match closeness {
                Closeness::Nearer => Extreme::Nearest,
                Closeness::Farther => Extreme::Farthest,
            };
            let anchors: Vec<&Spot> = self
                .spots
                .iter()
                .filter(|s| matches!(s.rel, Rel::To | Rel::From | Rel::NextTo | Rel::Near))
                .collect();
            let within: Vec<Restriction> = self
                .spots
                .iter()
                .filter(|s| matches!(s.rel, Rel::In | Rel::On) && self.is_area(&s.nouns[0]))
                .flat_map(Spot::restrictions)
                .collect();
            let placed = |mut noun: Noun| {
                if !self.is_area(&noun) && noun.head.things.is_none() {
                    noun.restrictions.extend(within.iter().cloned());
                }
                noun
            };
            if let (Some(cut), Some(near)) = (than_to.or(than), anchors.first()) {
                let before: Vec<&Subject> = self.nouns.iter().filter(|s| s.at < cut).collect();
                let after: Vec<&Subject> = self.nouns.iter().filter(|s| s.at > cut).collect();
                let what = before.first()?.noun.clone();
                let other_anchor = anchors.iter().find(|s| s.at > cut).map(|s| s.nouns[0].clone());
                let near = near.nouns[0].clone();
                if let Some(than) =
                    other_anchor.or_else(|| than_to.and(after.first().map(|s| s.noun.clone())))
                {
                    return Some(Query::Closer {
                        what: placed(what),
                        near: placed(near),
                        than: placed(than),
                        closeness,
                    });
                }
                let than = placed(after.first()?.noun.clone());
                return Some(Query::Larger {
                    what: placed(what),
                    than,
                    extreme,
                    to: Some(placed(near)),
                });
            }
            let [.., first, second] = &self.nouns[..] else { return None };
            let to = anchors.first().map(|s| placed(s.nouns[0].clone()));
            return Some(Query::WhichMore {
                of: [placed(first.noun.clone()), placed(second.noun.clone())],
                extreme,
                to,
            });
        }
        if self.has(Mark::Same)
            && let Some((property, _)) = &self.property
        {
            let mut of: Vec<Noun> = self.nouns.iter().map(|s| s.noun.clone()).collect();
            of.extend(self.spots.iter().flat_map(|s| s.nouns.clone()));
            let [first, second] = <[Noun; 2]>::try_from(of).ok()?;
            return Some(Query::Same { property: property.clone(), of: [first, second] });
        }
        let extreme = more?;
        let [.., first, second] = &self.nouns[..] else { return None };
        let (what, other) = (first.noun.clone(), second.noun.clone());
        if self.asks() || (self.has(Mark::Or) && than.is_none()) {
            return Some(Query::WhichMore { of: [what, other], extreme, to: None });
        }
        Some(Query::Larger { what, than: other, extreme, to: None })
    }

    fn size(&self) -> Option<Query> {
        let dimension = self.marks.iter().find_map(|(mark, _)| match mark {
            Mark::HowBig(dimension) => Some(*dimension),
            _ => None,
        })?;
        let of = self.first().or_else(|| self.spot_noun(&[Rel::NextTo, Rel::Of, Rel::In]))?;
        let without: Vec<usize> = match self.nouns.is_empty() {
            true => self.spots.iter().take(1).map(|s| s.at).collect(),
            false => Vec::new(),
        };
        Some(Query::Size { dimension, of: self.with_rest(of, &without) })
    }

    fn use_of_place(&self) -> Option<Query> {
        let within = || -> Vec<Restriction> {
            self.spots
                .iter()
                .filter(|s| !self.is_building(&s.nouns[0]))
                .flat_map(Spot::restrictions)
                .collect()
        };
        let asks = self.has(Mark::Where)
            || self.asks()
            || self.has(Mark::Can)
            || self.has(Mark::Whither)
            || self.has(Mark::Exists);
        let use_for = match () {
            () if self.has(Mark::Sit) => Some(Use::Sit),
            () if self.has(Mark::LieDown) => Some(Use::Lie),
            () if self.has(Mark::PutDown)
                && (self.has(Mark::Where) || self.has(Mark::Whither) || self.has(Mark::Can)) =>
            {
                Some(Use::Put)
            }
            () => None,
        };
        if let (Some(use_for), true) = (use_for, asks) {
            return Some(Query::Place { use_for, what: self.first(), within: within() });
        }
        if !self.has(Mark::Free) {
            return None;
        }
        let place = self.spots.first().map(|s| s.nouns[0].clone()).or_else(|| self.first())?;
        if self.is_area(&place) && self.spots.len() < 2 {
            // "free chairs in the kitchen", «свободно ли в комнате» are no questions about a top.
            let at = self.spots.first().map(|s| s.at);
            let noun = self.first()?;
            return self
                .has(Mark::HowMany)
                .then(|| Query::Free(self.with_rest(noun, &at.into_iter().collect::<Vec<_>>())));
        }
        let mut place = place;
        for spot in self.spots.iter().skip(1) {
            self.attach(&mut place, spot);
        }
        Some(Query::Free(place))
    }

    fn history(&self) -> Option<Query> {
        let noun = || self.first().map(|n| self.with_rest(n, &[]));
        if self.has(Mark::When) || self.has(Mark::LastSeen) {
            return noun().map(Query::LastSeen);
        }
        if self.has(Mark::Before) && (self.has(Mark::Where) || self.asks()) {
            return noun().map(Query::Before);
        }
        None
    }

    fn counted(&self) -> Option<Query> {
        let at = self.place_of(Mark::HowMany).or_else(|| self.place_of(Mark::Count));
        let at = at?;
        if self.has(Mark::Parts) {
            return self.made_of();
        }
        // The noun right after «сколько» is counted, wherever it stands; else the first.
        let counted = self.nouns.iter().find(|s| s.at > at).or_else(|| self.nouns.first());
        let Some(counted) = counted else {
            // «Сколько в комнате чёрных?», "how many are on the table"
            let mut noun = Noun { plural: true, ..Noun::default() };
            let of = self.spot(&[Rel::Of]).filter(|s| !self.is_area(&s.nouns[0]));
            if let Some(of) = of {
                return Some(Query::Count(self.with_rest(of.nouns[0].clone(), &[of.at])));
            }
            if self.spots.is_empty() && self.links.iter().any(|(rel, _)| *rel == Rel::In) {
                return None;
            }
            noun.head.anything = true;
            return (!self.spots.is_empty()).then(|| Query::Count(self.with_rest(noun, &[])));
        };
        let mut noun = counted.noun.clone();
        noun.plural = true;
        if let Some(kinds_first) = Some(&mut noun.head).filter(|h| !h.kinds.is_empty()) {
            kinds_first.named.clear();
        }
        for other in self.nouns.iter().filter(|s| s.at != counted.at) {
            self.relate(&mut noun, other);
        }
        Some(Query::Count(self.with_rest(noun, &[])))
    }

    /// A second noun: what rooms have, or the room that has them.
    fn relate(&self, noun: &mut Noun, other: &Subject) {
        if self.is_building(&other.noun) {
            return;
        }
        if self.marks.iter().any(|(m, _)| matches!(m, Mark::BestTo(_))) {
            return;
        }
        let (rel, anchor) = match (self.is_area(noun), self.is_area(&other.noun)) {
            (true, false) if self.is_doors(&other.noun) && self.has(Mark::Lead) => {
                (Rel::Of, &other.noun)
            }
            (true, _) => (Rel::Has, &other.noun),
            (false, true) => (Rel::In, &other.noun),
            (false, false) => (Rel::Bears, &other.noun),
        };
        let mut anchor = anchor.clone();
        anchor.indefinite |= rel == Rel::Has || rel == Rel::Bears;
        noun.restrictions.push(Restriction {
            rel,
            anchors: vec![anchor],
            negated: other.negated || (rel == Rel::Has && self.negated),
        });
    }

    fn made_of(&self) -> Option<Query> {
        let of = || {
            let noun = self.first().map(|n| (n, Vec::new()));
            let spot = self.spots.first();
            let (noun, without) =
                noun.or_else(|| spot.map(|s| (s.nouns[0].clone(), vec![s.at])))?;
            Some(self.with_rest(noun, &without))
        };
        if self.has(Mark::Parts) {
            return of().map(Query::Parts);
        }
        let made = self.has(Mark::MadeOf);
        if made
            && self.values.is_empty()
            && (self.asks()
                || self.has(Mark::How)
                || self.place_of(Mark::MadeOf) == Some(0)
                || !self.links.is_empty())
        {
            return of().map(|of| Query::Property { property: Property::Material, of });
        }
        None
    }

    fn property(&self) -> Option<Query> {
        let (property, at) = self.property.clone()?;
        if !self.values.is_empty() && !self.has(Mark::Or) {
            return None;
        }
        let noun = self.nouns.first().map(|s| (s.noun.clone(), Vec::new()));
        let owner = self.spot(&[Rel::NextTo, Rel::Of]).map(|s| (s.nouns[0].clone(), vec![s.at]));
        let spot = self.spots.iter().find(|s| s.at > at).map(|s| (s.nouns[0].clone(), vec![s.at]));
        let (noun, without) = noun.or(owner).or(spot)?;
        Some(Query::Property { property, of: self.with_rest(noun, &without) })
    }

    fn leads(&self) -> Option<Query> {
        let door = self.nouns.iter().find(|s| self.is_doors(&s.noun) && !s.noun.plural);
        let asks_where = self.has(Mark::Where) || self.has(Mark::Whither);
        let rooms = self.nouns.iter().any(|s| self.is_rooms(&s.noun) || self.is_area(&s.noun));
        let leads = self.has(Mark::Lead) || (self.has(Mark::Move) && self.asks());
        if !leads {
            return None;
        }
        if let Some(door) = door
            && (asks_where || (self.asks() && (rooms || self.has(Mark::What))))
        {
            let which = self.nouns.iter().any(|s| {
                self.is_doors(&s.noun) && s.noun.head.named.is_empty() && self.follows_which(s.at)
            });
            if !which {
                return Some(Query::Leads(self.with_rest(door.noun.clone(), &[])));
            }
        }
        // «Какие двери ведут из Комнаты-В», "which doors lead to the kitchen"
        let doors = self.nouns.iter().find(|s| self.is_doors(&s.noun));
        if let (Some(doors), true) = (doors, self.asks() || self.has(Mark::List)) {
            let mut noun = doors.noun.clone();
            noun.plural = true;
            noun.head.named.clear();
            let rooms: Vec<Noun> = self
                .nouns
                .iter()
                .filter(|s| s.at != doors.at && self.is_area(&s.noun))
                .map(|s| s.noun.clone())
                .collect();
            if rooms.len() == 2 {
                noun.restrictions.push(Restriction {
                    rel: Rel::Between,
                    anchors: rooms,
                    negated: false,
                });
                return Some(Query::Find(noun));
            }
            for other in self.nouns.iter().filter(|s| s.at != doors.at && self.is_area(&s.noun)) {
                let anchors = vec![other.noun.clone()];
                noun.restrictions.push(Restriction { rel: Rel::Of, anchors, negated: false });
            }
            let to_or_from = |spot: &Spot| match spot.rel {
                Rel::In | Rel::On | Rel::To | Rel::At => Rel::To,
                rel => rel,
            };
            for spot in &self.spots {
                let spot = Spot { rel: to_or_from(spot), ..spot.clone() };
                noun.restrictions.extend(spot.restrictions());
            }
            for (value, _, negated) in &self.values {
                noun.filters.push(Filter { value: *value, negated: *negated });
            }
            return Some(Query::Find(noun));
        }
        // «С какими комнатами соединена Комната-В?», «Куда можно выйти из Комнаты-В?»
        if self.asks() || asks_where {
            let room =
                self.nouns.iter().rev().find(|s| self.is_area(&s.noun) && !self.is_rooms(&s.noun));
            let anchor = room.map(|s| s.noun.clone()).or_else(|| {
                self.spots.iter().find(|s| self.is_area(&s.nouns[0])).map(|s| s.nouns[0].clone())
            })?;
            return Some(Query::Find(self.rooms_near(anchor)));
        }
        None
    }

    fn rooms_near(&self, anchor: Noun) -> Noun {
        let kinds = self.lexicon.kind_of(&Extension::Rooms).into_iter().collect();
        let restriction = Restriction { rel: Rel::Near, anchors: vec![anchor], negated: false };
        Noun {
            head: Head { kinds, ..Head::default() },
            plural: true,
            restrictions: vec![restriction],
            ..Noun::default()
        }
    }

    fn where_is(&self) -> Option<Query> {
        if self.has(Mark::Whither) && self.nouns.is_empty() {
            let room = self.spots.iter().find(|s| self.is_area(&s.nouns[0]))?;
            return Some(Query::Find(self.rooms_near(room.nouns[0].clone())));
        }
        if !self.has(Mark::Where) && !self.has(Mark::Whither) {
            return None;
        }
        let mut nouns = self.nouns.iter();
        let Some(first) = nouns.next() else {
            // "Where is it" has a noun; «Где находится то, что на столе?» has not.
            let mut noun = Noun { plural: true, ..Noun::default() };
            noun.head.anything = true;
            return (!self.spots.is_empty()).then(|| Query::Where(self.with_rest(noun, &[])));
        };
        let mut noun = first.noun.clone();
        for other in nouns {
            if !(self.has(Mark::And) || self.has(Mark::Or)) {
                break;
            }
            noun.head.named.extend(other.noun.head.named.iter().copied());
            noun.head.kinds.extend(other.noun.head.kinds.iter().copied());
            noun.plural = true;
        }
        if self.has(Mark::Exists) || self.has(Mark::Can) {
            noun.indefinite = true;
        }
        Some(Query::Where(self.with_rest(noun, &[])))
    }

    /// Whether the noun at an item stands right after «какой» or "which", but for small words.
    fn follows_which(&self, at: usize) -> bool {
        let asked = self.marks.iter().filter(|(m, _)| matches!(m, Mark::Which | Mark::What));
        let mut asked = asked.filter(|(_, mark_at)| *mark_at < at);
        asked.any(|(_, mark_at)| {
            (mark_at + 1..at).all(|between| {
                self.marks.iter().any(|(m, a)| {
                    *a == between
                        && matches!(m, Mark::Be | Mark::Exists | Mark::Best(_) | Mark::The)
                }) || self.values.iter().any(|(_, a, _)| *a == between)
            })
        })
    }

    fn which(&self) -> Option<Query> {
        if !self.asks() {
            return None;
        }
        let question = self.place_of(Mark::Which).or_else(|| self.place_of(Mark::What))?;
        // «на чём», «в какой комнате»: a preposition right before the word that asks; or stranded at the end.
        let before = self.links.iter().find(|(_, at)| at + 1 == question);
        let stranded = self.links.iter().rev().find(|(_, at)| *at > question);
        let link = before.or(stranded).map(|(rel, _)| *rel);
        let asked = self.nouns.iter().find(|s| {
            s.at > question && self.follows_which(s.at) && !self.nominal_subject(s, link)
        });
        let other = self.nouns.iter().find(|s| asked.is_none_or(|a| a.at != s.at));
        if let (Some(rel), Some(of)) = (link, other) {
            let of_noun = self.with_rest(of.noun.clone(), &[]);
            if let Some(asked) = asked {
                let rooms = self.is_rooms(&asked.noun);
                if rooms && matches!(rel, Rel::In | Rel::On) {
                    let general = asked.noun.plural
                        || self.has(Mark::Exists)
                        || self.has(Mark::Have)
                        || of.noun.plural
                        || of.noun.indefinite;
                    if general && !self.is_storeys(&asked.noun) {
                        return Some(self.rooms_with(&asked.noun));
                    }
                    return Some(Query::RoomOf(of_noun));
                }
                return Some(Query::Anchor { rel, of: of_noun, what: Some(asked.noun.clone()) });
            }
            return Some(Query::Anchor { rel, of: of_noun, what: None });
        }
        if let Some(asked) = asked.or(other) {
            let others: Vec<&Subject> = self.nouns.iter().filter(|s| s.at != asked.at).collect();
            let rooms = self.is_rooms(&asked.noun);
            if rooms && !others.is_empty() && asked.at < others[0].at {
                let having = self.has(Mark::Have) || self.has(Mark::Exists);
                if !having
                    && !self.marks.iter().any(|(m, _)| matches!(m, Mark::BestTo(_)))
                    && !self.has(Mark::And)
                {
                    return Some(Query::RoomOf(self.with_rest(others[0].noun.clone(), &[])));
                }
                if having {
                    return Some(self.rooms_with(&asked.noun));
                }
            }
            let best = asked.noun.best.is_some()
                || self.marks.iter().any(|(m, _)| matches!(m, Mark::Best(_) | Mark::BestTo(_)));
            let mut noun = asked.noun.clone();
            if self.has(Mark::Have) || (self.has(Mark::Exists) && others.len() == 1) {
                for other in &others {
                    self.relate(&mut noun, other);
                }
            }
            let described = self.has(Mark::What)
                && !self.has(Mark::Which)
                && !best
                && !noun.plural
                && !self.follows_what_directly(asked.at)
                && self.spots.is_empty()
                && self.values.is_empty()
                && !self.has(Mark::Exists)
                && !self.has(Mark::Have);
            let named =
                !noun.head.named.is_empty() && noun.head.kinds.is_empty() && others.is_empty();
            if described
                || (named && self.spots.is_empty() && self.values.is_empty() && link.is_none())
            {
                return Some(Query::Describe(self.with_rest(noun, &[])));
            }
            if !noun.head.kinds.is_empty() && self.follows_which(asked.at) {
                noun.head.named.clear();
            }
            let noun = self.with_rest(noun, &[]);
            return Some(Query::Find(Noun { indefinite: true, ..noun }));
        }
        let mut noun = Noun { plural: true, ..Noun::default() };
        noun.head.anything = true;
        let something = !self.spots.is_empty() || !self.values.is_empty() || self.there.is_some();
        let best = self.marks.iter().any(|(m, _)| matches!(m, Mark::Best(_) | Mark::Nearer(_)));
        (something || best).then(|| Query::Find(self.with_rest(noun, &[])))
    }

    /// "What is the table on?": the noun after "what is" is the subject, not what is asked for.
    fn nominal_subject(&self, subject: &Subject, link: Option<Rel>) -> bool {
        let what = self.has(Mark::What) && !self.has(Mark::Which);
        link.is_some() && what && (self.nouns.len() == 1 || !self.follows_what_directly(subject.at))
    }

    /// "What objects …": no verb between.
    fn follows_what_directly(&self, at: usize) -> bool {
        at > 0
            && self.marks.iter().any(|(m, a)| matches!(m, Mark::What | Mark::Which) && *a + 1 == at)
    }

    /// "Which rooms have a chair?"
    fn rooms_with(&self, rooms: &Noun) -> Query {
        let mut noun = rooms.clone();
        noun.plural = true;
        let others: Vec<&Subject> = self.nouns.iter().filter(|s| s.noun != *rooms).collect();
        for other in others {
            let mut anchor = self.narrowed(other.noun.clone());
            anchor.indefinite = true;
            let negated = other.negated || self.negated;
            noun.restrictions.push(Restriction { rel: Rel::Has, anchors: vec![anchor], negated });
        }
        Query::Find(noun)
    }

    /// A noun with the values and places of the sentence.
    fn narrowed(&self, mut noun: Noun) -> Noun {
        for (value, _, negated) in &self.values {
            noun.filters.push(Filter { value: *value, negated: *negated });
        }
        for spot in &self.spots {
            self.attach(&mut noun, spot);
        }
        noun
    }

    fn listed(&self) -> Option<Query> {
        if self.has(Mark::Describe) {
            let spot = self.spots.first();
            let noun = self.first().map(|n| (n, Vec::new()));
            let (noun, without) =
                noun.or_else(|| spot.map(|s| (s.nouns[0].clone(), vec![s.at])))?;
            return Some(Query::Describe(self.with_rest(noun, &without)));
        }
        if !self.has(Mark::List) {
            return None;
        }
        let mut noun = self.first().unwrap_or_default();
        if self.nouns.is_empty() {
            noun.head.anything = true;
        } else if !noun.head.kinds.is_empty() {
            noun.head.named.clear();
        }
        noun.plural = true;
        Some(Query::Find(Noun { indefinite: true, ..self.with_rest(noun, &[]) }))
    }

    fn exists(&self) -> Option<Query> {
        let none = self.has(Mark::Not)
            && self.values.is_empty()
            && self.nouns.iter().any(|s| !s.nominative);
        let seen = self.has(Mark::See) && !self.nouns.is_empty();
        let exists = self.has(Mark::Exists) || self.has(Mark::Have) || seen || none;
        if !exists {
            return None;
        }
        let mut subjects: Vec<&Subject> = self.nouns.iter().collect();
        let mut within = Vec::new();
        // "Does the kitchen have a fridge?"
        if self.has(Mark::Have) && subjects.len() > 1 {
            let owner = subjects.remove(0);
            if !self.is_building(&owner.noun) {
                let rel = if self.is_area(&owner.noun) { Rel::In } else { Rel::On };
                within.push(Restriction { rel, anchors: vec![owner.noun.clone()], negated: false });
            }
        }
        let mut what: Vec<Noun> = Vec::new();
        for subject in &subjects {
            // «Есть ли в доме комната с диваном?» has its sofa in a place already.
            let mut noun = subject.noun.clone();
            noun.indefinite = true;
            noun.restrictions.extend(within.iter().cloned());
            if !noun.head.kinds.is_empty() {
                noun.head.named.retain(|_| noun.head.kinds.is_empty());
            }
            what.push(self.with_rest(noun, &[]));
        }
        if what.is_empty() {
            let mut noun = Noun { plural: true, indefinite: true, ..Noun::default() };
            noun.head.anything = true;
            noun.restrictions = within;
            if self.spots.is_empty() && self.there.is_none() && self.values.is_empty() {
                return None;
            }
            what.push(self.with_rest(noun, &[]));
        }
        let either = self.has(Mark::Or);
        Some(Query::Exists { what, either, negated: none && !self.has(Mark::Exists) })
    }

    /// «Самая большая комната?»
    fn superlative(&self) -> Option<Query> {
        let [only] = &self.nouns[..] else { return None };
        let alone = self.marks.iter().any(|(m, _)| matches!(m, Mark::Best(_)));
        if only.noun.best.is_none() && !alone {
            return None;
        }
        let mut noun = only.noun.clone();
        noun.head.named.clear();
        Some(Query::Find(Noun { indefinite: true, ..self.with_rest(noun, &[]) }))
    }

    fn holds(&self) -> Option<Query> {
        if self.has(Mark::Anything) && self.nouns.is_empty() && !self.spots.is_empty() {
            let mut noun = Noun { plural: true, indefinite: true, ..Noun::default() };
            noun.head.anything = true;
            let what = vec![self.with_rest(noun, &[])];
            return Some(Query::Exists { what, either: false, negated: self.negated });
        }
        let at = self.nouns.iter().position(|s| s.nominative).unwrap_or(0);
        let first = self.nouns.get(at)?;
        let mut subject = first.noun.clone();
        let mut claims: Vec<Claim> = Vec::new();
        // A room said before another place or a value tells which thing is meant.
        let mut spots: Vec<&Spot> = self.spots.iter().collect();
        let has_more = !self.values.is_empty() || spots.len() > 1;
        if has_more {
            let values = !self.values.is_empty();
            spots.retain(|spot| {
                let room = spot.rel == Rel::In && self.is_area(&spot.nouns[0]);
                let tells = values || room;
                if tells && !spot.negated && !spot.either {
                    self.attach(&mut subject, spot);
                    return false;
                }
                true
            });
            if spots.is_empty() && !values {
                spots = self.spots.iter().collect();
                subject = first.noun.clone();
            }
        }
        let mut chained: Vec<Restriction> = Vec::new();
        let mut holder = Noun::default();
        for spot in &spots {
            if spot.either {
                chained.extend(spot.each());
            } else {
                self.attach(&mut holder, spot);
            }
        }
        chained.extend(holder.restrictions);
        let lead = self.has(Mark::Lead) || self.is_doors(&subject);
        for mut restriction in chained {
            if self.is_building(&restriction.anchors[0]) {
                continue;
            }
            if lead
                && self.has(Mark::Lead)
                && matches!(restriction.rel, Rel::In | Rel::On | Rel::At)
            {
                restriction.rel = Rel::To;
            }
            restriction.negated = false;
            claims.push(Claim::Related(restriction));
        }
        for (value, _, _) in &self.values {
            claims.push(Claim::Value(Filter { value: *value, negated: false }));
        }
        for (n, other) in self.nouns.iter().enumerate().filter(|(n, _)| *n != at) {
            let _ = n;
            // "Does Door VZ join Room V and Room Z?"
            if self.has(Mark::Lead) && self.is_area(&other.noun) {
                let anchors = vec![other.noun.clone()];
                claims.push(Claim::Related(Restriction { rel: Rel::Of, anchors, negated: false }));
            } else {
                claims.push(Claim::Kind(other.noun.clone()));
            }
        }
        if claims.is_empty() {
            return None;
        }
        // «Лежит ли на комоде книга?» asks for any book; «Книга на комоде?» for the one.
        let places = claims.iter().all(|c| matches!(c, Claim::Related(_)));
        let later = self.spots.iter().all(|s| s.at < first.at) && !self.spots.is_empty();
        let general = subject.head.named.is_empty() && subject.head.things.is_none();
        if self.sentence.language == crate::language::Language::Russian
            && places
            && later
            && general
            && !self.negated
        {
            let mut noun = first.noun.clone();
            noun.indefinite = true;
            let what = vec![self.with_rest(noun, &[])];
            return Some(Query::Exists { what, either: false, negated: false });
        }
        let either = self.has(Mark::Or) || self.spots.iter().any(|s| s.either);
        let values = self.values.len() > 1 || (self.values.len() == 1 && claims.len() > 1);
        if either && (values || claims.len() > 1) {
            return Some(Query::Choice { subject, claims });
        }
        if let (true, [Claim::Value(only)]) = (either, &claims[..]) {
            let filter = only.clone();
            return Some(Query::Holds {
                subject,
                claims: vec![Claim::Value(filter)],
                negated: self.negated,
            });
        }
        Some(Query::Holds { subject, claims, negated: self.negated })
    }

    /// What to say when no rule fits: the words that were understood, or nothing of it.
    fn not_understood(&self, items: &[Item]) -> Doubt {
        let about = self.first().map(|n| n.text);
        match about {
            Some(text) if items.len() <= 3 => Doubt::Incomplete { about: text },
            _ => {
                let all = 0..self.sentence.words.len();
                Doubt::not_understood(self.sentence.said(&all))
            }
        }
    }
}
