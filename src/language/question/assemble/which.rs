//! Questions for things: where, which, how many, and commands to list or describe them.
//!
//! Invariant: every noun of the sentence is asked for or restricts what is.

use super::Frame;
use super::Subject;
use crate::question::lexicon::{Extension, KindId};
use crate::question::mark::Mark;
use crate::question::query::{
    Best, Denial, Extreme, Filter, Head, Noun, Quantity, Query, Rel, Restriction, Thing,
};
use crate::question::values::Property;
use crate::sets::set;
use crate::words::Language;

impl Frame<'_, '_> {
    pub(super) fn counted(&self) -> Option<Query> {
        let at = self.place_of(Mark::HowMany).or_else(|| self.place_of(Mark::Count));
        let at = at?;
        if self.has(Mark::Parts) {
            return self.made_of();
        }
        // "How much does the sofa cost?"
        if self.property.is_some() && self.nouns.len() == 1 {
            return None;
        }
        // The noun right after «сколько» is counted, wherever it stands; else the first.
        let counted = self.nouns.iter().find(|s| s.at > at).or_else(|| self.nouns.first());
        // «Через сколько комнат?»: on which way is not said.
        if self.links.iter().any(|(rel, _)| *rel == Rel::Through) {
            return None;
        }
        let of = self.spot(&[Rel::Of, Rel::From]);
        let told = of.filter(|s| s.nouns[0].head.things.is_some());
        // «Какие есть комнаты? – У скольких из них есть окно?»: of the rooms that were told, those that have it.
        if let (Some(of), Some(had)) = (told, counted)
            && self.is_area(&of.nouns[0])
            && !self.is_area(&had.noun)
        {
            let mut rooms = of.nouns[0].clone();
            self.relate(&mut rooms, had, had.negated || self.negated);
            return Some(Query::Count(self.with_rest(rooms, &[of.at])));
        }
        let Some(counted) = counted else {
            // «Сколько в комнате чёрных?», "how many are on the table"
            let mut noun = Noun { plural: true, ..Noun::default() };
            let of = of.filter(|s| told.is_some() || !self.is_area(&s.nouns[0]));
            if let Some(of) = of {
                return Some(Query::Count(self.with_rest(of.nouns[0].clone(), &[of.at])));
            }
            if self.spots.is_empty() && self.links.iter().any(|(rel, _)| *rel == Rel::In) {
                return None;
            }
            noun.head.anything = true;
            return (!self.spots.is_empty()).then(|| Query::Count(self.with_rest(noun, &[])));
        };
        // "How many rooms are connected to the kitchen?"
        if self.has(Mark::Lead)
            && self.is_rooms(&counted.noun)
            && counted.noun.head.things.is_none()
            && !self.negated
            && let Some(anchor) = self.joined_room()
        {
            return Some(Query::Count(self.rooms_near(anchor)));
        }
        let mut noun = counted.noun.clone();
        noun.plural = true;
        // "How many of the things on the counter are knives?": of the former those that are the latter too.
        let general =
            |noun: &Noun| noun.head.anything || self.is_kind(noun, |e| *e == Extension::Things);
        if let Some(of) = of.filter(|s| told.is_none() && s.at < counted.at && !s.negated)
            && let [whole] = &of.nouns[..]
            && !self.is_area(whole)
            && self.nouns.len() == 1
        {
            if !general(whole) {
                noun.also.push(whole.head.clone());
            }
            noun.filters.extend(whole.filters.iter().cloned());
            noun.restrictions.extend(whole.restrictions.iter().cloned());
            return Some(Query::Count(self.with_rest(noun, &[of.at])));
        }
        // "How many things in the kitchen are chairs?"
        if let [things, sort] = &self.nouns[..]
            && things.at == counted.at
            && general(&things.noun)
            && !self.is_area(&sort.noun)
            && self.place_of(Mark::Be).is_some_and(|be| things.at < be && be < sort.at)
        {
            let mut noun = Noun { plural: true, ..sort.noun.clone() };
            noun.filters.extend(things.noun.filters.iter().cloned());
            noun.restrictions.extend(things.noun.restrictions.iter().cloned());
            return Some(Query::Count(self.with_rest(noun, &[])));
        }
        if let Some(kinds_first) = Some(&mut noun.head).filter(|h| !h.kinds.is_empty()) {
            kinds_first.named.clear();
        }
        let others: Vec<&Subject> = self.nouns.iter().filter(|s| s.at != counted.at).collect();
        for (other, denied) in others.iter().zip(self.denied_of(&others)) {
            self.relate(&mut noun, other, denied);
        }
        Some(Query::Count(self.with_rest(noun, &[])))
    }

    /// A second noun: what rooms have, or the room that has them.
    pub(super) fn relate(&self, noun: &mut Noun, other: &Subject, denied: bool) {
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
            (true, true) => (Rel::In, &other.noun),
            (true, false) => (Rel::Has, &other.noun),
            (false, true) => (Rel::In, &other.noun),
            (false, false) => (Rel::Bears, &other.noun),
        };
        let mut anchor = anchor.clone();
        anchor.indefinite |= rel == Rel::Has || rel == Rel::Bears;
        noun.restrictions.push(Restriction {
            rel,
            anchors: vec![anchor],
            negated: other.negated || (rel == Rel::Has && denied),
        });
    }

    pub(super) fn where_is(&self) -> Option<Query> {
        if self.has(Mark::Whither) && self.nouns.is_empty() {
            let room = self.spots.iter().find(|s| self.is_area(&s.nouns[0]))?;
            return Some(Query::Find(self.rooms_near(room.nouns[0].clone())));
        }
        let taken = self.has(Mark::Took) || (self.has(Mark::Who) && self.has(Mark::Have));
        if !self.has(Mark::Where) && !self.has(Mark::Whither) && !taken {
            return None;
        }
        // «Где газета, в гостиной или на кухне?»
        if let Some(choice) = self.either_place() {
            return Some(choice);
        }
        // «Где чашка, которая не белая?» denies the value, «Где ключи не на столах?» the place.
        let value = self.values.iter().any(|(_, _, negated)| *negated);
        let place = self.spots.iter().any(|spot| spot.negated);
        let denies = self.negated && !taken && !value && !place;
        if let (true, Some(lacked)) = (denies, self.nouns.first())
            && !self.is_area(&lacked.noun)
        {
            // «Где нет стульев?»
            let head = Head::of_kind(self.lexicon, &Extension::Rooms);
            return Some(self.rooms_with(&Noun { head, ..Noun::default() }));
        }
        let mut nouns = self.nouns.iter();
        let Some(first) = nouns.next() else {
            // "Where is it" has a noun; «Где находится то, что на столе?» has not.
            let mut noun = Noun { plural: true, ..Noun::default() };
            noun.head.anything = true;
            // "Where is everything that is red?"
            let valued = self.has(Mark::All) && !self.values.is_empty();
            let told = !self.spots.is_empty() || valued;
            return told.then(|| Query::Where(self.with_rest(noun, &[])));
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
    pub(super) fn follows_which(&self, at: usize) -> bool {
        let asked = self.marks.iter().filter(|(m, _)| matches!(m, Mark::Which | Mark::What));
        let mut asked = asked.filter(|(_, mark_at)| *mark_at < at);
        asked.any(|(_, mark_at)| {
            (mark_at + 1..at).all(|between| {
                self.marks.iter().any(|(m, a)| {
                    *a == between
                        && matches!(
                            m,
                            Mark::Be | Mark::Hang | Mark::Exists | Mark::Best(_) | Mark::The
                        )
                }) || self.values.iter().any(|(_, a, _)| *a == between)
                    // «в каких они комнатах»
                    || self.nouns.iter().any(|s| s.at == between && s.noun.head.things.is_some())
            })
        })
    }

    /// «на каком из них», "which of them": of what was spoken of one is asked for.
    fn is_one_of(&self, at: usize) -> bool {
        let words = self.sentence.keys.windows(2);
        let of = words.into_iter().any(|pair| {
            matches!(pair, [of, them] if set!("Of").contains(&of.as_str())
                && set!("ThemOrBoth").contains(&them.as_str()))
        });
        of && self.follows_which(at)
    }

    /// «Чем занят стол?»
    pub(super) fn occupied(&self) -> Option<Query> {
        if !self.has(Mark::OccupiedBy) {
            return None;
        }
        let place = self.with_rest(self.first()?, &[]);
        let mut noun = Noun { plural: true, ..Noun::default() };
        noun.head.anything = true;
        let anchors = vec![place];
        noun.restrictions.push(Restriction { rel: Rel::On, anchors, negated: false });
        Some(Query::Find(noun))
    }

    /// "Which table is the dining table?": those of the first sort that are what stands behind "is".
    fn which_is(&self, asked: &Subject, named: &Subject) -> Option<Query> {
        let is = |mark: &Mark| matches!(mark, Mark::Be | Mark::The | Mark::A);
        let between: Vec<&Mark> = self.between(asked.at, named.at).collect();
        let measured =
            |(mark, _): &(Mark, usize)| matches!(mark, Mark::BestTo(_) | Mark::Nearer(_));
        let more = self.marks.iter().any(measured) || self.has(Mark::Or) || self.has(Mark::All);
        let bare =
            |noun: &Noun| noun.best.is_none() && noun.head.things.is_none() && !noun.head.anything;
        if !between.contains(&&Mark::Be)
            || !between.into_iter().all(is)
            || more
            || self.negated
            || named.negated
            || ![&asked.noun, &named.noun].into_iter().all(bare)
            || self.sort(&asked.noun) != self.sort(&named.noun)
        {
            return None;
        }
        let mut those = Noun { plural: true, ..named.noun.clone() };
        those.also.push(asked.noun.head.clone());
        those.filters.extend(asked.noun.filters.iter().cloned());
        those.restrictions.extend(asked.noun.restrictions.iter().cloned());
        Some(Query::Find(self.with_rest(those, &[])))
    }

    /// Whether a noun is of rooms and whether of doors; neither is of things.
    fn sort(&self, noun: &Noun) -> (bool, bool) {
        (self.is_area(noun), self.is_doors(noun) || self.is_exits(noun))
    }

    /// The marks between two places of the sentence.
    fn between(&self, from: usize, to: usize) -> impl Iterator<Item = &Mark> {
        self.marks.iter().filter(move |(_, at)| (from + 1..to).contains(at)).map(|(mark, _)| mark)
    }

    pub(super) fn which(&self) -> Option<Query> {
        if !self.asks() {
            return None;
        }
        let question = self.place_of(Mark::Which).or_else(|| self.place_of(Mark::What))?;
        // "What kind of door is Door 1?": of Door 1, which is one.
        let of_kind = self.sentence.keys.iter().any(|key| set!("KindWord").contains(&&**key));
        if let ([kind, named], true) = (&self.nouns[..], of_kind)
            && self.follows_which(kind.at)
            && kind.noun.head.named.is_empty()
            && self.between(kind.at, named.at).any(|mark| *mark == Mark::Be)
            && !self.spots.iter().any(|spot| spot.at < named.at)
            && (!named.noun.head.named.is_empty()
                || self.sort(&kind.noun) == self.sort(&named.noun))
        {
            let mut of = self.with_rest(named.noun.clone(), &[]);
            of.also.push(kind.noun.head.clone());
            return Some(Query::Property { property: Property::Kind, of });
        }
        if let Some(nearest) = self.nearest_to(question) {
            return Some(nearest);
        }
        if let Some(empty) = self.empty_rooms() {
            return Some(empty);
        }
        // «на чём», «в какой комнате»: a preposition right before the word that asks; or stranded at the end.
        let before = self.links.iter().find(|(_, at)| at + 1 == question);
        let stranded = self.links.iter().rev().find(|(_, at)| *at > question);
        let link = before.or(stranded).map(|(rel, _)| *rel);
        // «К чему прислонён зонт?»: the participle tells more than «к».
        let turned = |rel: &Rel| matches!(rel, Rel::Leaning | Rel::Facing);
        let told = self.links.iter().map(|(rel, _)| *rel).find(turned);
        let link = told.filter(|_| link == Some(Rel::To)).or(link);
        let asked = self.nouns.iter().find(|s| {
            s.at > question
                && self.follows_which(s.at)
                && !self.nominal_subject(s, link)
                && (s.noun.head.things.is_none() || link.is_none() || self.is_one_of(s.at))
        });
        let other = self.nouns.iter().find(|s| asked.is_none_or(|a| a.at != s.at));
        if let (Some(rel), Some(of)) = (link, other) {
            let of_noun = self.with_rest(of.noun.clone(), &[]);
            let counted = of.noun.best.is_none()
                && (of.noun.count.is_some() || of.noun.quantity != Quantity::Exactly);
            if let Some(asked) = asked {
                let rooms = self.is_rooms(&asked.noun);
                if rooms && matches!(rel, Rel::In | Rel::On) {
                    let ands = self.marks.iter().filter(|(m, _)| *m == Mark::And).count();
                    let general = asked.noun.plural
                        || (ands > 1 && self.nouns.len() > 2)
                        || self.negated
                        || self.has(Mark::Exists)
                        || self.has(Mark::Have)
                        || of.noun.plural
                        || of.noun.indefinite
                        || counted;
                    let spoken = of.noun.head.things.is_some();
                    if general && !spoken && !self.is_storeys(&asked.noun) {
                        return Some(self.rooms_with(&asked.noun));
                    }
                    return Some(Query::RoomOf(of_noun));
                }
                // «За какой дверью ванная?»: which leads there.
                if rel == Rel::Behind && self.is_doors(&asked.noun) && self.is_area(&of_noun) {
                    let mut doors = Noun { indefinite: true, ..asked.noun.clone() };
                    let (anchors, negated) = (vec![of_noun], self.negated);
                    doors.restrictions.push(Restriction { rel: Rel::To, anchors, negated });
                    return Some(Query::Find(doors));
                }
                // «На каком столе пять тарелок?», «На каком столе нет тарелки?»: which of them bears so many, or none.
                let part = |k: &_| matches!(self.lexicon.kind(*k).extension, Extension::Part(_));
                let parts = asked.noun.head.kinds.iter().any(part);
                let negated = self.negated || of.negated;
                if (counted || negated) && !parts && matches!(rel, Rel::In | Rel::On) {
                    let mut noun = Noun { indefinite: true, ..asked.noun.clone() };
                    noun.plural |= negated;
                    let anchors = vec![Noun { indefinite: true, ..of_noun }];
                    noun.restrictions.push(Restriction { rel: Rel::Bears, anchors, negated });
                    return Some(Query::Find(noun));
                }
                return Some(Query::Anchor { rel, of: of_noun, what: Some(asked.noun.clone()) });
            }
            return Some(Query::Anchor { rel, of: of_noun, what: None });
        }
        // «В каких комнатах?»: of what, no word says.
        let small = |(mark, _): &(Mark, usize)| {
            matches!(mark, Mark::Which | Mark::What | Mark::Be | Mark::And | Mark::The | Mark::A)
        };
        let says_no_more = self.spots.is_empty() && self.values.is_empty() && !self.you;
        if before.is_some() && other.is_none() && says_no_more && self.marks.iter().all(small) {
            return None;
        }
        // "What are you standing next to?"
        if let (Some(rel), None, true, true) = (link, other, self.you, self.spots.is_empty()) {
            let of = super::things(vec![Thing::Robot], "you");
            return Some(Query::Anchor { rel, of, what: asked.map(|s| s.noun.clone()) });
        }
        if let Some(asked) = asked.or(other) {
            let others: Vec<&Subject> = self.nouns.iter().filter(|s| s.at != asked.at).collect();
            let rooms = self.is_rooms(&asked.noun);
            // "Which rooms are toilets?", "Which doors are sliding?": those that are.
            let sort = |kind: &KindId| match self.lexicon.kind(*kind).extension {
                Extension::DoorType(_) => self.is_doors(&asked.noun),
                Extension::AreaType(_) => rooms,
                _ => false,
            };
            let has = [Mark::Have, Mark::Exists, Mark::And].iter().any(|mark| self.has(*mark));
            if let ([only], false, None) = (&others[..], has, link)
                && asked.at < only.at
                && asked.noun.head.things.is_none()
                && !(self.negated || only.negated)
                && only.noun.head.kinds.iter().any(sort)
                && (only.noun.plural || !rooms)
            {
                let mut those = Noun { plural: true, ..only.noun.clone() };
                those.head.named.clear();
                those.head.kinds.retain(sort);
                return Some(Query::Find(self.with_rest(those, &[])));
            }
            if let ([only], false, None) = (&others[..], has, link)
                && let Some(query) = self.which_is(asked, only)
            {
                return Some(query);
            }
            if rooms && !others.is_empty() && asked.at < others[0].at {
                // «В какой комнате и кровать, и лампа?»
                let ands = self.marks.iter().filter(|(m, _)| *m == Mark::And).count();
                let both = others.len() > 1 && (ands > 1 || self.has(Mark::All));
                let having = self.has(Mark::Have) || self.has(Mark::Exists) || both;
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
            // «Какие картины или фотографии висят на кухне?»: of each sort those that are there.
            let sorts =
                |noun: &Noun| noun.plural && noun.head.named.is_empty() && !self.is_area(noun);
            if let [other] = others[..]
                && other.at == asked.at + 2
                && self.marks.contains(&(Mark::Or, asked.at + 1))
                && [&noun, &other.noun].into_iter().all(sorts)
                && !self.spots.is_empty()
            {
                let each = [&noun, &other.noun]
                    .map(|noun| self.with_rest(Noun { indefinite: true, ..noun.clone() }, &[]));
                return Some(Query::Exists {
                    what: each.to_vec(),
                    either: true,
                    denial: Denial::Unasked,
                });
            }
            // "Which cup is the red one?"
            for other in others.iter().filter(|s| s.noun.head.anything) {
                noun.filters.extend(other.noun.filters.iter().cloned());
                noun.best = noun.best.take().or_else(|| other.noun.best.clone());
            }
            // "Which of them are plates?", but "which of them is nearest to the plate?"
            let measured = |at: usize| {
                let to = |m: &Mark| matches!(m, Mark::BestTo(_) | Mark::Nearer(_) | Mark::ThanTo);
                self.marks.iter().any(|(mark, before)| to(mark) && *before < at)
            };
            let sorts = |s: &&&Subject| {
                let bare = s.noun.filters.is_empty() && s.noun.restrictions.is_empty();
                s.at > asked.at && bare && !s.noun.head.kinds.is_empty() && !measured(s.at)
            };
            let of_them = noun.head.things.is_some() && self.is_one_of(asked.at);
            if of_them && link.is_none() && !self.has(Mark::Have) {
                noun.also.extend(
                    others
                        .iter()
                        .filter(sorts)
                        .map(|s| Head { named: Vec::new(), ..s.noun.head.clone() }),
                );
            }
            if self.has(Mark::Have) || (self.has(Mark::Exists) && others.len() == 1) {
                for (other, denied) in others.iter().zip(self.denied_of(&others)) {
                    self.relate(&mut noun, other, denied);
                }
            }
            // "What does the kitchen have?"
            let does = self.sentence.keys.iter().any(|key| key == "does");
            let owns = self.has(Mark::What)
                && self.has(Mark::Have)
                && !self.has(Mark::Which)
                && others.is_empty()
                && (does || !self.follows_what_directly(asked.at))
                && !self.you
                && !noun.plural
                && (!noun.indefinite || self.is_area(&noun));
            if owns {
                let had = Head { anything: true, ..Head::default() };
                let place = Restriction { rel: Rel::In, anchors: vec![noun], negated: false };
                let head = Noun { head: had, plural: true, ..Noun::default() };
                let had = Noun { restrictions: vec![place], ..head };
                return self.spots.is_empty().then_some(Query::Find(had));
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
        let best = self.marks.iter().any(|(m, _)| {
            matches!(m, Mark::Best(e) if !matches!(e, Extreme::Nearest | Extreme::Farthest))
        });
        // «Что из мебели деревянное?», "Which is the biggest of the rooms?"
        let of = self
            .spot(&[Rel::From, Rel::Of])
            .filter(|s| (best && s.nouns[0].plural) || !self.is_area(&s.nouns[0]))
            .filter(|s| !s.nouns[0].head.kinds.is_empty())
            // "What is on the shelf of the bookcase?" asks of what is on the shelf.
            .filter(|s| !self.spots.iter().any(|before| before.at + 1 == s.at));
        if let Some(of) = of.filter(|_| best || !self.values.is_empty() || self.spots.len() > 1) {
            let noun = Noun { plural: true, indefinite: true, ..of.nouns[0].clone() };
            return Some(Query::Find(self.with_rest(noun, &[of.at])));
        }
        let mut noun = Noun { plural: true, ..Noun::default() };
        noun.head.anything = true;
        let something = !self.spots.is_empty()
            || !self.values.is_empty()
            || !self.sizes.is_empty()
            || self.there.is_some();
        let best = self.marks.iter().any(|(m, _)| matches!(m, Mark::Best(_) | Mark::Nearer(_)));
        (something || best).then(|| Query::Find(self.with_rest(noun, &[])))
    }

    /// «В какой комнате ничего нет?», "Which room has nothing in it?"
    fn empty_rooms(&self) -> Option<Query> {
        let [only] = &self.nouns[..] else { return None };
        let said = |key: &String| set!("Nothing").contains(&key.as_str());
        let nothing = self.has(Mark::Anything) && self.sentence.keys.iter().any(said);
        let rooms = self.is_rooms(&only.noun) && self.follows_which(only.at);
        let value = self.lexicon.values.meaning("пустой")?;
        (nothing && rooms && self.spots.is_empty()).then(|| {
            let mut noun = Noun { plural: true, indefinite: true, ..only.noun.clone() };
            noun.head.named.clear();
            noun.filters.push(Filter::new(value, false));
            Query::Find(noun)
        })
    }

    /// "What is nearest to the sofa?": the only noun is what it is near to.
    fn nearest_to(&self, question: usize) -> Option<Query> {
        let (extreme, best_at) = self.marks.iter().find_map(|(mark, at)| match mark {
            Mark::BestTo(extreme) if *at > question => Some((*extreme, *at)),
            _ => None,
        })?;
        let anchor = self.nouns.first().filter(|first| first.at > best_at)?;
        let mut near = anchor.noun.clone();
        let own = self.spots.iter().filter(|spot| spot.at > anchor.at);
        let own: Vec<usize> =
            own.inspect(|spot| self.attach(&mut near, spot)).map(|s| s.at).collect();
        let mut noun = Noun { indefinite: true, ..Noun::default() };
        noun.head.anything = true;
        noun.best = Some(Best { extreme, anchor: Some(Box::new(near)) });
        Some(Query::Find(self.with_rest(noun, &own)))
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

    /// Which of several that rooms have or lack are denied: "have a bed and no sofa", «нет кровати, но есть диван», "have no
    /// beds and chairs". A denial goes no further than the next "but" or what is named as being there.
    fn denied_of(&self, others: &[&Subject]) -> Vec<bool> {
        let own = others.iter().any(|other| other.negated);
        let mut denies = self.negated && !own;
        let mut from = 0;
        let mut denied = Vec::new();
        for other in others {
            // «но», "but"; «есть», "have" once more; "… and a sofa".
            let bounds = |mark: &Mark| matches!(mark, Mark::But | Mark::Exists | Mark::Have);
            let bounded =
                self.marks.iter().any(|(mark, at)| bounds(mark) && (from..other.at).contains(at));
            let is_there = bounded
                || (self.sentence.language == Language::English
                    && other.noun.indefinite
                    && !other.noun.plural);
            denies = match own {
                true => other.negated || (denies && !is_there),
                false => denies,
            };
            denied.push(denies);
            from = other.at;
        }
        denied
    }

    /// "Which rooms have a chair?"
    fn rooms_with(&self, rooms: &Noun) -> Query {
        let mut noun = rooms.clone();
        noun.plural = true;
        let others = self.nouns.iter().filter(|s| s.noun != *rooms && !self.is_building(&s.noun));
        let others: Vec<&Subject> = others.collect();
        // "Which rooms on the first floor have no chairs?": the storey is of the rooms.
        for spot in self.spots.iter().filter(|s| self.is_of_storey(s)) {
            noun.restrictions.extend(spot.restrictions());
        }
        // "Which rooms have a bed or a fridge?": either will do.
        if self.has(Mark::Or) && others.len() > 1 {
            let anchors = others
                .iter()
                .map(|other| Noun { indefinite: true, ..self.narrowed(other.noun.clone()) });
            let anchors = anchors.collect();
            noun.restrictions.push(Restriction { rel: Rel::Has, anchors, negated: self.negated });
            return Query::Find(noun);
        }
        let denied = self.denied_of(&others);
        for (other, negated) in others.into_iter().zip(denied) {
            let mut anchor = self.narrowed(other.noun.clone());
            anchor.indefinite = true;
            // «В каких комнатах пол не деревянный?»: there is a floor, which is not so.
            let negated = negated && !anchor.filters.iter().any(|filter| filter.negated);
            noun.restrictions.push(Restriction { rel: Rel::Has, anchors: vec![anchor], negated });
        }
        Query::Find(noun)
    }

    /// A noun with the values and places of the sentence.
    fn narrowed(&self, mut noun: Noun) -> Noun {
        noun.filters.extend(self.filters());
        for spot in self.spots.iter().filter(|s| !self.is_of_storey(s)) {
            self.attach(&mut noun, spot);
        }
        noun
    }

    fn is_of_storey(&self, spot: &super::Spot) -> bool {
        let named = |e: &crate::map::Entity| matches!(e, crate::map::Entity::Map(_));
        let noun = &spot.nouns[0];
        matches!(spot.rel, Rel::In | Rel::On)
            && (self.is_storeys(noun)
                || (!noun.head.named.is_empty() && noun.head.named.iter().all(named)))
    }

    /// "Everything in Room V except the chairs": a list, where no verb makes it a claim.
    pub(super) fn everything(&self) -> Option<Query> {
        let whole = self.has(Mark::All) && self.nouns.is_empty() && !self.spots.is_empty();
        // "Tell me everything that is made of glass"
        let listed = self.sentence.keys.iter().any(|key| set!("TellAll").contains(&key.as_str()))
            && self.has(Mark::All)
            && self.nouns.is_empty()
            && !self.values.is_empty();
        if !listed && (!whole || self.has(Mark::Be) || !self.values.is_empty()) {
            return None;
        }
        let mut noun = Noun { plural: true, indefinite: true, ..Noun::default() };
        noun.head.anything = true;
        Some(Query::Find(self.with_rest(noun, &[])))
    }

    pub(super) fn listed(&self) -> Option<Query> {
        if self.has(Mark::Describe) {
            let spot = self.spots.first();
            let noun = self.first().map(|n| (n, Vec::new()));
            let (noun, without) =
                noun.or_else(|| spot.map(|s| (s.nouns[0].clone(), vec![s.at])))?;
            return Some(Query::Describe(self.with_rest(noun, &without)));
        }
        let shown = self.sentence.keys.iter().any(|key| set!("ShowAll").contains(&key.as_str()))
            && self.first().is_some_and(|noun| noun.plural);
        if !self.has(Mark::List) && !shown {
            return None;
        }
        let mut noun = self.first().unwrap_or_default();
        if self.nouns.is_empty() {
            noun.head.anything = true;
        } else if !noun.head.kinds.is_empty() {
            noun.head.named.clear();
        }
        noun.plural = true;
        let mut noun = self.with_rest(noun, &[]);
        // «Перечисли комнаты по размеру»: all of them, in that order.
        let listed = self.nouns.first().map_or(usize::MAX, |s| s.at);
        let ordered = self.marks.iter().any(|(m, at)| matches!(m, Mark::Best(_)) && *at > listed);
        if ordered && noun.count.is_none() {
            noun.count = Some(u64::MAX);
        }
        Some(Query::Find(Noun { indefinite: true, ..noun }))
    }
}
