//! Places, values and superlatives handed to the nouns that they belong to.
//!
//! Invariant: a place belongs to one noun, and to what narrows that noun.

use super::Frame;
use super::Spot;
use crate::map::Entity;
use crate::question::lexicon::Extension;
use crate::question::mark::Mark;
use crate::question::query::{Best, Closeness, Extreme, Filter, Head, Noun, Rel, Restriction};
use crate::question::values::ValueId;
use crate::sets::set;

/// How that is told to which something is near: "nearest to the table", or as a place, «к столу».
enum Nearness {
    Named,
    Placed,
}

impl Frame<'_, '_> {
    /// A noun with all places, values and superlatives of the sentence, but for the places left out.
    pub(super) fn with_rest(&self, mut noun: Noun, without: &[usize]) -> Noun {
        for spot in self.spots.iter().filter(|s| !without.contains(&s.at)) {
            match self.tells_of_nearness(spot) {
                None => self.attach(&mut noun, spot),
                Some(Nearness::Named) => {}
                Some(Nearness::Placed) => {
                    let anchors = noun.restrictions.last_mut().into_iter();
                    for anchor in anchors.flat_map(|place| &mut place.anchors) {
                        self.attach(anchor, spot);
                    }
                }
            }
        }
        noun.filters.extend(self.filters());
        noun.sizes.extend(self.sizes.iter().copied());
        for except in self.except.iter().cloned() {
            // "How many plants are there, not counting the bathroom?": those that are elsewhere.
            let elsewhere = self.is_area(&except)
                && !noun.head.anything
                && !self.is_area(&noun)
                && !self.is_doors(&noun);
            match elsewhere {
                true => noun.restrictions.push(Restriction {
                    rel: Rel::In,
                    anchors: vec![except],
                    negated: true,
                }),
                false => noun.except.push(except),
            }
        }
        // «Что ещё на нём стоит?»
        noun.other |= noun.head.anything && self.has(Mark::Other);
        if noun.other {
            // "What else is in the room with the bed?": the bed is not asked for.
            let places = noun.restrictions.iter().flat_map(|r| &r.anchors);
            let having = places.flat_map(|place| &place.restrictions);
            let named = having.filter(|r| matches!(r.rel, Rel::Has | Rel::Bears));
            let named: Vec<Noun> = named.flat_map(|r| r.anchors.clone()).collect();
            noun.except.extend(named);
        }
        if let Some(there) = &self.there {
            let anchors = vec![there.clone()];
            // «Какая не там?»
            let denies = |two: &[String]| {
                set!("NotWord").contains(&&*two[0]) && set!("ThereWord").contains(&&*two[1])
            };
            let negated = self.has(Mark::Which) && self.sentence.keys.windows(2).any(denies);
            noun.restrictions.push(Restriction { rel: Rel::There, anchors, negated });
        }
        self.with_best(noun)
    }

    /// "Through which door do I get into consult room 4 on L1?": a storey beside a name that several rooms bear tells which.
    pub(super) fn rooms_of_storeys(&mut self) {
        let several = |noun: &Noun| {
            let named = &noun.head.named;
            named.len() > 1 && named.iter().all(|e| matches!(e, Entity::Area(_)))
        };
        for n in (0..self.spots.len()).rev() {
            let Spot { at, rel, nouns, negated, .. } = self.spots[n].clone();
            let ([storey], Rel::In | Rel::On, false) = (&nouns[..], rel, negated) else { continue };
            let is_one = storey.rank.is_some() || storey.head.named.len() == 1;
            if !is_one || !self.is_storey(storey) {
                continue;
            }
            let told = self.spots[n].restrictions();
            let spots = self.spots.iter_mut().flat_map(|s| {
                let at = s.at;
                s.nouns.iter_mut().map(move |noun| (at, noun))
            });
            let nouns = self.nouns.iter_mut().map(|s| (s.at, &mut s.noun));
            let mut rooms =
                spots.chain(nouns).filter(|(room, noun)| room.abs_diff(at) == 1 && several(noun));
            if let Some((_, room)) = rooms.next() {
                room.restrictions.extend(told);
                self.spots.remove(n);
            }
        }
    }

    /// "Nearest to the table in the kitchen", «ближе всего к столу на кухне»: a room behind that to which something is near
    /// is of that alone.
    fn tells_of_nearness(&self, spot: &Spot) -> Option<Nearness> {
        let near = |mark: &Mark| {
            matches!(
                mark,
                Mark::Nearer(_)
                    | Mark::Best(Extreme::Nearest | Extreme::Farthest)
                    | Mark::BestTo(_)
            )
        };
        let near = self.marks.iter().find(|(mark, _)| near(mark)).map(|(_, at)| *at)?;
        let room = matches!(spot.rel, Rel::In | Rel::On) && self.is_area(&spot.nouns[0]);
        let before = spot.at.checked_sub(1).filter(|before| room && *before > near)?;
        let named = self.nouns.iter().any(|s| s.at == before && !self.is_area(&s.noun));
        let placed = self
            .spots
            .iter()
            .any(|s| s.at == before && s.rel == Rel::To && !self.is_area(&s.nouns[0]));
        match (named, placed) {
            (true, _) => Some(Nearness::Named),
            (_, true) => Some(Nearness::Placed),
            _ => None,
        }
    }

    /// Whether a noun is of rooms, or of what belongs to one as a way out of it does: "the key from the lab".
    fn is_led_through(&self, noun: &Noun) -> bool {
        let windows = self.is_kind(noun, |e| *e == Extension::Windows);
        self.is_area(noun)
            || self.is_doors(noun)
            || self.is_exits(noun)
            || self.is_key(noun)
            || windows
    }

    /// "A door from the kitchen to the bedroom" joins the two.
    pub(super) fn joining(&self, noun: &mut Noun) {
        if let Some(between) = self.joined_by(noun, &noun.restrictions) {
            noun.restrictions = vec![between];
        }
    }

    /// What is said of a door by all that it leads from and to, where these are two rooms.
    pub(super) fn joined_by(&self, door: &Noun, ends: &[Restriction]) -> Option<Restriction> {
        let room = |end: &Restriction| {
            let leads = matches!(end.rel, Rel::From | Rel::Of | Rel::To | Rel::In | Rel::On);
            let one = matches!(&end.anchors[..], [room] if self.is_area(room) && !room.all);
            leads && one && !end.negated
        };
        let [from, to] = ends else { return None };
        let joins = self.is_doors(door) && ends.iter().all(room) && from.anchors != to.anchors;
        let anchors = [&from.anchors[..], &to.anchors[..]].concat();
        joins.then_some(Restriction { rel: Rel::Between, anchors, negated: false })
    }

    /// A place after another place belongs to the latter («на столе в кухне»); a room narrows both.
    pub(super) fn attach(&self, noun: &mut Noun, spot: &Spot) {
        if self.is_building(&spot.nouns[0]) && matches!(spot.rel, Rel::In | Rel::On) {
            return;
        }
        // "A thing from the kitchen" is in it; a door leads from it.
        let rooms = spot.nouns.iter().all(|room| self.is_area(room));
        let told = noun.head != Head::default();
        if spot.rel == Rel::From && rooms && told && !self.is_led_through(noun) {
            return self.attach(noun, &Spot { rel: Rel::In, ..spot.clone() });
        }
        // «что-нибудь из еды»: what is of a class.
        let class = |class: &Noun| {
            let sorts = |e: &Extension| {
                matches!(e, Extension::Sort(_) | Extension::Furniture | Extension::Trait("device"))
            };
            class.head.named.is_empty() && class.head.things.is_none() && self.is_kind(class, sorts)
        };
        if let ([of], Rel::From, false) = (&spot.nouns[..], spot.rel, spot.negated)
            && noun.head.anything
            && class(of)
        {
            noun.head.anything = false;
            noun.head.kinds.clone_from(&of.head.kinds);
            noun.text.clone_from(&of.text);
            noun.other |= self.has(Mark::Other);
            return;
        }
        // «выход из кухни на улицу»
        if let ([out], Rel::To | Rel::In | Rel::On, false) =
            (&spot.nouns[..], spot.rel, spot.negated)
            && self.is_kind(out, |e| *e == Extension::OuterDoors)
            && self.is_exits(noun)
        {
            noun.head.kinds = self.lexicon.kind_of(&Extension::OuterDoors).into_iter().collect();
            return;
        }
        // «двери у кухни»: its own.
        let windows = self.is_kind(noun, |e| *e == Extension::Windows);
        if spot.rel == Rel::NextTo
            && self.is_area(&spot.nouns[0])
            && (self.is_doors(noun) || self.is_exits(noun) || windows)
        {
            let own = Spot { rel: Rel::In, ..spot.clone() };
            noun.restrictions.extend(own.restrictions());
            return;
        }
        // «ключ от лаборатории»
        let nearest = |mark: &Mark| {
            matches!(mark, Mark::Nearer(_) | Mark::Best(Extreme::Nearest | Extreme::Farthest))
        };
        // "How many of them are keys?"
        let of_several = spot.nouns.iter().any(|noun| {
            let told = noun.head.things.as_deref().unwrap_or_default();
            told.len() > 1 && told.iter().all(|thing| thing.replica().is_some())
        });
        if matches!(spot.rel, Rel::From | Rel::To | Rel::Of)
            && !of_several
            && self.is_key(noun)
            && !self.marks.iter().any(|(mark, _)| nearest(mark))
        {
            let opens = Spot { rel: Rel::Opens, ..spot.clone() };
            noun.restrictions.extend(opens.restrictions());
            return;
        }
        // «бутылки с вином», where wine is a word for such a bottle.
        let same_sort = |with: &Noun| {
            !with.head.kinds.is_empty()
                && with.head.kinds.iter().all(|kind| noun.head.kinds.contains(kind))
                && with.filters.is_empty()
                && with.count.is_none()
        };
        if spot.rel == Rel::Has && !spot.negated && spot.nouns.iter().all(same_sort) {
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
                // "on the table with the vase"
                Some(anchor)
                    if !anchor.head.kinds.is_empty()
                        && self.spots.iter().any(|s| s.at + 1 == spot.at) =>
                {
                    let spot = Spot { rel: Rel::Bears, ..spot.clone() };
                    anchor.restrictions.extend(spot.restrictions());
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
        // «в ванной на комоде»: the room that stands before tells which one as well.
        let own_room = |r: &&Restriction| {
            !r.negated
                && matches!(r.rel, Rel::In | Rel::On | Rel::Of)
                && self.is_area(&r.anchors[0])
        };
        let room = noun.restrictions.iter().find(own_room).cloned();
        let general = spot.nouns.iter().all(|n| {
            n.head.named.is_empty() && n.head.things.is_none() && !n.head.kinds.is_empty()
        });
        if let (Some(room), Rel::On | Rel::Under | Rel::Above, true) = (room, spot.rel, general)
            && !self.is_area(&spot.nouns[0])
            && !self.is_area(noun)
            && !self.is_kind(&spot.nouns[0], |e| matches!(e, Extension::Floor | Extension::Walls))
            && noun.restrictions.len() == 1
        {
            let mut there = spot.clone();
            there.nouns.iter_mut().for_each(|n| n.restrictions.push(room.clone()));
            noun.restrictions.extend(there.restrictions());
            return;
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

    /// The values of the sentence that stand by themselves; of those joined by "or" one will do.
    pub(super) fn filters(&self) -> Vec<Filter> {
        let mut filters: Vec<Filter> = Vec::new();
        let mut last = None;
        for (value, at, negated) in &self.values {
            let property = |value: ValueId| &self.lexicon.values.entry(value).property;
            let joined = at.checked_sub(1).is_some_and(|joint| {
                // «красная и синяя»: no thing is both.
                let alike = filters.last().is_some_and(|f| property(f.value) == property(*value));
                last == joint.checked_sub(1)
                    && (self.marks.contains(&(Mark::Or, joint))
                        || (alike && self.marks.contains(&(Mark::And, joint))))
            });
            match filters.last_mut() {
                Some(before) if joined => before.or.push(*value),
                _ => filters.push(Filter::new(*value, *negated)),
            }
            last = Some(*at);
        }
        filters
    }

    /// A comparative that nothing is compared with asks for the most: "Which of the windows is bigger?"
    fn more_of_several(&self) -> Option<Extreme> {
        let one = self.nouns.len() + self.spots.iter().filter(|s| s.rel == Rel::From).count() == 1;
        let more = self.marks.iter().find_map(|(mark, _)| match mark {
            Mark::More(extreme) => Some(*extreme),
            _ => None,
        });
        more.filter(|_| one && self.has(Mark::Which) && !self.has(Mark::Than))
    }

    /// «какой из двух шкафов», "which of the two chairs": the number tells how many there are to choose from.
    fn chooses_of(&self) -> bool {
        let of = |key: &String| set!("Of").contains(&key.as_str());
        self.has(Mark::Which) && self.sentence.keys.iter().any(of)
    }

    /// Hands a superlative that stands by itself to the noun, and its «к столу» to the superlative.
    fn with_best(&self, mut noun: Noun) -> Noun {
        let alone = self.marks.iter().find_map(|(mark, _)| match mark {
            Mark::Best(extreme) | Mark::BestTo(extreme) => Some(*extreme),
            Mark::Nearer(Closeness::Nearer) => Some(Extreme::Nearest),
            Mark::Nearer(Closeness::Farther) => Some(Extreme::Farthest),
            _ => None,
        });
        // «Которое из окон больше?»: of several the most.
        let alone = alone.or_else(|| self.more_of_several());
        if noun.best.is_none() {
            if alone.is_some() && self.chooses_of() {
                noun.count = None;
            }
            // «Какая комната больше всего?» compares rooms; what is counted stands after it.
            let alone = alone.map(|extreme| match extreme {
                Extreme::Most => Extreme::Biggest,
                Extreme::Fewest => Extreme::Smallest,
                other => other,
            });
            noun.best = alone.map(|extreme| Best { extreme, anchor: None });
        }
        if noun.rank.is_none() {
            noun.rank = self.marks.iter().find_map(|(mark, _)| match mark {
                Mark::Rank(rank) => Some(*rank),
                _ => None,
            });
        }
        // "the nearest lift", though one of them is called just that
        if noun.best.is_some() && !noun.head.kinds.is_empty() {
            noun.head.named.clear();
        }
        let Some(best) = &mut noun.best else { return noun };
        if matches!(best.extreme, Extreme::Nearest | Extreme::Farthest) && best.anchor.is_none() {
            // "Which nurse desk is closest to you?" tells what desk it is, and then from where.
            let whence = |r: &Restriction| matches!(r.rel, Rel::To | Rel::From);
            let beside = |r: &Restriction| {
                matches!(r.rel, Rel::At | Rel::NextTo | Rel::Near)
                    && !r.anchors.iter().any(|anchor| anchor.modifies)
            };
            let place = |is_anchor: &dyn Fn(&Restriction) -> bool| {
                noun.restrictions.iter().position(is_anchor)
            };
            let found = place(&whence).or_else(|| place(&beside));
            if let Some(at) = found {
                let anchor = noun.restrictions.remove(at).anchors.into_iter().next();
                // «ближайший ко мне»: to the robot, as when nothing is said.
                best.anchor = anchor.map(Box::new);
            } else if let Some(best_at) =
                self.marks.iter().find_map(|(m, at)| matches!(m, Mark::BestTo(_)).then_some(*at))
                && let Some(second) = self.nouns.iter().find(|s| s.at > best_at)
            {
                // "nearest to the window of the lab"
                let mut anchor = second.noun.clone();
                for spot in self.spots.iter().filter(|spot| spot.at > second.at) {
                    self.attach(&mut anchor, spot);
                }
                best.anchor = Some(Box::new(anchor));
            }
        }
        noun
    }
}
