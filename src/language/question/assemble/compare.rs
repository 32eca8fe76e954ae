//! Questions that compare: nearer, bigger, the same; how big, and the biggest.
//!
//! Invariant: two things are compared by one measure only.

use super::Frame;
use super::Spot;
use super::Subject;
use crate::question::lexicon::Extension;
use crate::question::mark::Mark;
use crate::question::query::{
    Best, Closeness, Dimension, Extreme, Filter, Head, Noun, Query, Rel, Restriction,
};
use crate::words::Language;

impl Frame<'_, '_> {
    /// «В какой комнате больше всего стульев?», "Which table has the most books?"
    pub(super) fn most(&self) -> Option<Query> {
        let counts = |noun: &Noun| {
            let best = noun.best.as_ref();
            best.is_some_and(|b| matches!(b.extreme, Extreme::Most | Extreme::Fewest))
        };
        let alone = self.marks.iter().find_map(|(mark, _)| match mark {
            Mark::Best(extreme @ (Extreme::Most | Extreme::Fewest)) => Some(*extreme),
            // «На каком этаже больше столов?»: of all of them, where no two are named.
            Mark::More(Extreme::Biggest | Extreme::Most) if self.asks_of_rooms() => {
                Some(Extreme::Most)
            }
            Mark::More(Extreme::Smallest | Extreme::Fewest) if self.asks_of_rooms() => {
                Some(Extreme::Fewest)
            }
            _ => None,
        });
        let counted = self.nouns.iter().find(|s| counts(&s.noun)).or_else(|| {
            // «Где стульев больше всего?»
            let storeys = |s: &&Subject| self.is_storeys(&s.noun);
            let on_storeys = self.nouns.iter().any(|s| storeys(&s) && self.follows_which(s.at));
            alone.and_then(|_| {
                self.nouns.iter().find(|s| {
                    s.noun.plural && (!self.is_area(&s.noun) || (on_storeys && !storeys(s)))
                })
            })
        });
        // "Where are most of them?"
        let of_them = self.spots.iter().find(|s| {
            let told = s.nouns[0].head.things.as_ref();
            matches!(s.rel, Rel::Of | Rel::From) && told.is_some_and(|told| told.len() > 1)
        });
        let (counted, at) = match (counted, of_them.filter(|_| alone.is_some())) {
            (Some(counted), _) => (&counted.noun, counted.at),
            (None, Some(of_them)) => (&of_them.nouns[0], of_them.at),
            (None, None) => return None,
        };
        let extreme = counted.best.as_ref().map(|b| b.extreme).or(alone)?;
        let mut what = Noun { best: None, plural: true, indefinite: true, ..counted.clone() };
        what.filters.extend(self.filters());
        let asked = self.nouns.iter().find(|s| s.at != at);
        let mut asked = match asked {
            Some(subject) => subject.noun.clone(),
            None if self.has(Mark::Where) => {
                Noun { head: Head::of_kind(self.lexicon, &Extension::Rooms), ..Noun::default() }
            }
            None => return None,
        };
        if !asked.head.kinds.is_empty() {
            asked.head.named.clear();
        }
        // "Which room has the most pictures on the walls?": on them is what a room has, and not the room.
        let rooms = self.is_area(&asked);
        for spot in self.spots.iter().filter(|spot| spot.at != at) {
            let had = rooms && spot.at > at && !self.is_area(&spot.nouns[0]);
            self.attach(if had { &mut what } else { &mut asked }, spot);
        }
        asked.rank = asked.rank.or(what.rank.take());
        asked.best = Some(Best { extreme, anchor: Some(Box::new(what)) });
        Some(Query::Find(Noun { indefinite: true, ..asked }))
    }

    fn asks_of_rooms(&self) -> bool {
        let asked = self.nouns.iter().any(|s| self.is_rooms(&s.noun) && self.follows_which(s.at));
        asked && self.nouns.len() == 2 && self.spots.is_empty() && !self.has(Mark::Than)
    }

    /// «Где больше стульев, в кухне или в спальне?», "Are there more chairs than tables in the kitchen?"
    pub(super) fn more_of(&self) -> Option<Query> {
        let (extreme, at) = self.marks.iter().find_map(|(mark, at)| match mark {
            Mark::More(Extreme::Biggest | Extreme::Most) => Some((Extreme::Most, *at)),
            Mark::More(Extreme::Smallest | Extreme::Fewest) => Some((Extreme::Fewest, *at)),
            _ => None,
        })?;
        let mass = |noun: &Noun| noun.head.kinds.iter().any(|k| self.lexicon.is_mass(*k));
        let is_counted = |s: &&Subject| (s.noun.plural || mass(&s.noun)) && !self.is_area(&s.noun);
        let counted: Vec<&Subject> = self.nouns.iter().filter(is_counted).collect();
        // Places that are compared, or rooms that stand without a preposition.
        let in_places = self.spots.iter().filter(|s| matches!(s.rel, Rel::In | Rel::On));
        let places: Vec<(Rel, &Noun)> =
            in_places.flat_map(|s| s.nouns.iter().map(move |n| (s.rel, n))).collect();
        let rooms = self.nouns.iter().filter(|s| self.is_area(&s.noun) && !self.is_rooms(&s.noun));
        let rooms: Vec<(Rel, &Noun)> = rooms.map(|s| (Rel::In, &s.noun)).collect();
        let either = self.spots.iter().any(|s| s.either);
        // «Стульев больше, чем столов?» asks nothing with its «чем».
        let than = self.sentence.keys.iter().any(|key| key == "чем");
        let asked = self
            .marks
            .iter()
            .any(|(mark, n)| matches!(mark, Mark::What | Mark::Which) && !(than && *n > at));
        let asks = self.has(Mark::Where)
            || asked
            || self.has(Mark::Or)
            || self.has(Mark::HowMany)
            || either;
        let within = |noun: &Noun, place: Option<&(Rel, &Noun)>| {
            let mut noun = Noun { plural: true, indefinite: true, ..noun.clone() };
            noun.filters.extend(self.filters());
            if !noun.head.kinds.is_empty() {
                noun.head.named.clear();
            }
            let place = place.map(|(rel, place)| Restriction {
                rel: *rel,
                anchors: vec![(*place).clone()],
                negated: false,
            });
            noun.restrictions.extend(place);
            noun
        };
        // «Каких стульев больше, чёрных или белых?»
        if let ([what], [(one, _, _), (other, _, _)], true) =
            (&counted[..], &self.values[..], places.len() < 2)
        {
            let of = [one, other].map(|value| {
                let mut noun = within(&what.noun, places.first());
                noun.filters.clone_from(&what.noun.filters);
                noun.filters.push(Filter::new(*value, false));
                noun
            });
            return Some(Query::MoreOf { of, extreme, asks, by: self.has(Mark::HowMany) });
        }
        if let Some([first, second]) = self.here_and_there(at) {
            let of = [within(&first, None), within(&second, None)];
            return Some(Query::MoreOf { of, extreme, asks, by: self.has(Mark::HowMany) });
        }
        let of = match (&counted[..], &places[..], &rooms[..]) {
            ([what], [first, second], _) | ([what], [], [first, second]) => {
                [within(&what.noun, Some(first)), within(&what.noun, Some(second))]
            }
            // "more books in the bedroom than pens in the kitchen"
            ([first, second], [one, other], _) if self.nouns.len() == 2 => {
                [within(&first.noun, Some(one)), within(&second.noun, Some(other))]
            }
            // «Стулья больше, чем столы?» compares sizes: what is counted follows its word.
            ([first, second], place @ ([] | [_]), []) if first.at > at || self.has(Mark::What) => {
                [within(&first.noun, place.first()), within(&second.noun, place.first())]
            }
            _ => return None,
        };
        Some(Query::MoreOf { of, extreme, asks, by: self.has(Mark::HowMany) })
    }

    /// "Are there more pictures on the walls of the bathroom than of the kitchen?": what is counted, with the places on either
    /// side of the "than". A place behind it takes the place of its like before it, and of all that narrows that one.
    fn here_and_there(&self, more: usize) -> Option<[Noun; 2]> {
        let than = self.than_behind(more)?;
        let (before, behind): (Vec<&Spot>, Vec<&Spot>) =
            self.spots.iter().partition(|spot| spot.at < than);
        let (named, bare): (Vec<&Subject>, Vec<&Subject>) =
            self.nouns.iter().partition(|subject| subject.at < than);
        let [what] = &named[..] else { return None };
        if self.is_area(&what.noun) || before.is_empty() || self.spots.iter().any(|s| s.either) {
            return None;
        }
        let like = |area: bool| before.iter().rposition(|s| self.is_area(&s.nouns[0]) == area);
        // "… on the dresser than the sofa": on the sofa.
        let bare = match (&bare[..], &behind[..]) {
            ([], [_, ..]) => None,
            ([only], []) if !only.noun.plural => {
                let rel = before[like(self.is_area(&only.noun))?].rel;
                let nouns = vec![only.noun.clone()];
                Some(Spot { rel, nouns, either: false, at: only.at, negated: only.negated })
            }
            _ => return None,
        };
        let behind: Vec<&Spot> = bare.iter().chain(behind).collect();
        let area = self.is_area(&behind[0].nouns[0]);
        let at = like(area)?;
        // A room leaves where in a room; another thing is in a room of its own.
        let kept = before[at + 1..].iter().filter(|s| area && !self.is_area(&s.nouns[0]));
        let there = before[..at].iter().chain(&behind).chain(kept);
        let placed = |spots: Vec<&Spot>| {
            let mut noun = what.noun.clone();
            spots.into_iter().for_each(|spot| self.attach(&mut noun, spot));
            noun
        };
        Some([placed(before.clone()), placed(there.copied().collect())])
    }

    /// Where a comparative's "than" stands.
    fn than_behind(&self, more: usize) -> Option<usize> {
        let russian = self.sentence.keys.iter().any(|key| key == "чем");
        let than = |mark: &Mark| match mark {
            Mark::Than => true,
            Mark::What => russian,
            _ => false,
        };
        self.marks.iter().find(|(mark, at)| *at > more && than(mark)).map(|(_, at)| *at)
    }

    pub(super) fn compared(&self) -> Option<Query> {
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
            let anchors: Vec<Spot> = self
                .spots
                .iter()
                .filter(|s| matches!(s.rel, Rel::To | Rel::From | Rel::NextTo | Rel::Near))
                .map(|s| Spot { nouns: self.with_next_places(s), ..s.clone() })
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
                    by: self.asks_by_how_much(),
                });
            }
            // "Is the sofa nearer to the TV or to the desk?"
            if let ([what], [ends]) = (&self.nouns[..], &anchors[..])
                && ends.either
                && let [a, b] = &ends.nouns[..]
            {
                return Some(Query::WhichMore {
                    of: vec![placed(a.clone()), placed(b.clone())],
                    extreme,
                    to: Some(placed(what.noun.clone())),
                });
            }
            let [.., first, second] = &self.nouns[..] else { return None };
            let to = anchors.first().map(|s| placed(s.nouns[0].clone()));
            return Some(Query::WhichMore {
                of: vec![placed(first.noun.clone()), placed(second.noun.clone())],
                extreme,
                to,
            });
        }
        if self.has(Mark::Same)
            && let Some((property, _)) = &self.property
        {
            let mut of: Vec<Noun> = self.nouns.iter().map(|s| self.with_own_places(s)).collect();
            // «Какие стулья того же цвета, что и стол?», "What is the same colour as the sofa?"
            let asked = self.nouns.first().filter(|s| self.follows_which(s.at));
            if let (true, [.., other]) = (self.asks(), &of[..])
                && (of.len() == 2) == asked.is_some()
                && of.len() < 3
            {
                let like = Some((property.clone(), Box::new(other.clone())));
                let anything = Head { anything: true, ..Head::default() };
                let noun = match asked {
                    Some(_) => of[0].clone(),
                    None => Noun { head: anything, ..Noun::default() },
                };
                return Some(Query::Find(Noun { like, plural: true, indefinite: true, ..noun }));
            }
            if let [all] = &self.nouns[..]
                && let all = &all.noun
                && all.plural
            {
                let of = self.with_rest(all.clone(), &[]);
                return Some(Query::SameAll { property: property.clone(), of });
            }
            if of.len() < 2 {
                of.extend(self.spots.iter().flat_map(|s| s.nouns.clone()));
            }
            let [first, second] = <[Noun; 2]>::try_from(of).ok()?;
            return Some(Query::Same { property: property.clone(), of: [first, second] });
        }
        let best = self.marks.iter().find_map(|(mark, at)| match mark {
            Mark::Best(extreme) => Some((*extreme, *at)),
            _ => None,
        });
        if let Some(query) = self.best_of_those(more, best) {
            return Some(query);
        }
        let extreme = more?;
        if let Some(query) = self.beyond(extreme).or_else(|| self.than_each()) {
            return Some(query);
        }
        // Of two comparatives one would be forgotten.
        let more_than_one = self.comparatives().any(|(other, _)| other != extreme);
        let [.., first, second] = &self.nouns[..] else { return None };
        if more_than_one {
            return None;
        }
        let (mut what, mut other) = (first.noun.clone(), second.noun.clone());
        // "… the fridge or the wardrobe in Room V": a place belongs to the noun before it; «Что на столе левее: …?» to all.
        for spot in &self.spots {
            let own = [(&mut what, first.at..second.at), (&mut other, second.at..usize::MAX)];
            for (noun, own) in own {
                if (spot.at < first.at || own.contains(&spot.at)) && !self.is_area(noun) {
                    self.attach(noun, spot);
                }
            }
        }
        if self.asks() || (self.has(Mark::Or) && than.is_none()) {
            return Some(Query::WhichMore { of: vec![what, other], extreme, to: None });
        }
        let by = self.asks_by_how_much();
        Some(Query::Larger { what, than: other, extreme, to: None, by })
    }

    fn comparatives(&self) -> impl Iterator<Item = (Extreme, usize)> + '_ {
        self.marks.iter().filter_map(|(mark, at)| match mark {
            Mark::More(extreme) => Some((*extreme, *at)),
            _ => None,
        })
    }

    /// "Which is the tallest: the desk, the dresser or the bed?"
    fn best_of_those(
        &self,
        more: Option<Extreme>,
        best: Option<(Extreme, usize)>,
    ) -> Option<Query> {
        // "… the tallest: the desk, …": the superlative stands before the first of them.
        let first = self.nouns.iter().find_map(|s| s.noun.best.as_ref().zip(Some(s.at)));
        let best = best.or(first.map(|(best, at)| (best.extreme, at.saturating_sub(1))));
        let extreme = more.or(best.map(|(extreme, _)| extreme))?;
        let from = best.map_or(0, |(_, at)| at);
        let (asked, those): (Vec<&Subject>, Vec<&Subject>) =
            self.nouns.iter().partition(|s| match more {
                Some(_) => self.follows_which(s.at),
                None => s.at <= from,
            });
        let enough = those.len() > usize::from(more.is_some()) + 1;
        let sided = matches!(extreme, Extreme::LeftMost | Extreme::RightMost);
        let compares = !sided && !matches!(extreme, Extreme::Most | Extreme::Fewest);
        let plain = self.spots.is_empty() && self.values.is_empty() && !self.has(Mark::Than);
        let all = asked.iter().all(|s| self.follows_which(s.at));
        let of = those.iter().map(|s| Noun { best: None, ..s.noun.clone() }).collect();
        (enough && compares && plain && self.asks() && all && self.has(Mark::Or))
            .then_some(Query::WhichMore { of, extreme, to: None })
    }

    /// "Is the dresser taller than the fridge and the wardrobe?", "… taller than the fridge and wider than the wardrobe?":
    /// than each of them, by the comparative that stands before it.
    fn than_each(&self) -> Option<Query> {
        let by: Vec<(Extreme, usize)> = self.comparatives().collect();
        let (_, first) = *by.first()?;
        let (before, after): (Vec<&Subject>, Vec<&Subject>) =
            self.nouns.iter().partition(|s| s.at < first);
        let joined = after.len() > 1 && self.has(Mark::And) && !self.has(Mark::Or);
        let ([what], true, true) = (&before[..], joined, self.spots.is_empty()) else {
            return None;
        };
        let before = |at: usize| by.iter().rfind(|(_, by)| *by < at);
        let each = after.iter().filter_map(|other| Some((other, before(other.at)?.0)));
        let each = each.map(|(other, extreme)| Query::Larger {
            what: what.noun.clone(),
            than: other.noun.clone(),
            extreme,
            to: None,
            by: self.asks_by_how_much(),
        });
        Some(Query::Several(each.collect()))
    }

    /// "Which room is bigger than the kitchen?", «Что выше холодильника?»: all that are so; how many are, or whether any.
    fn beyond(&self, extreme: Extreme) -> Option<Query> {
        let side = matches!(extreme, Extreme::LeftMost | Extreme::RightMost);
        if self.has(Mark::Or) || side {
            return None;
        }
        let more =
            self.marks.iter().find_map(|(m, at)| matches!(m, Mark::More(_)).then_some(*at))?;
        let (asked, other) = match &self.nouns[..] {
            [asked, other] if other.at > more => (Some(asked), other),
            [other] if other.at > more && !self.follows_which(other.at) => (None, other),
            _ => return None,
        };
        let general = |asked: &&Subject| {
            asked.noun.head.named.is_empty()
                && asked.noun.head.things.is_none()
                && self.is_area(&asked.noun) == self.is_area(&other.noun)
        };
        let anything = Head { anything: true, ..Head::default() };
        let noun = match asked {
            Some(asked) => asked.noun.clone(),
            None => Noun { head: anything, ..Noun::default() },
        };
        let mut noun = Noun { plural: true, indefinite: true, ..noun };
        for spot in self.spots.iter().filter(|s| s.at < more) {
            self.attach(&mut noun, spot);
        }
        noun.beyond = Some((extreme, Box::new(self.with_own_places(other))));
        // "How many rooms are bigger than …?", not "How much bigger is …?" nor «На сколько столы выше …?».
        let counts = |at: usize| {
            asked.is_some_and(|asked| asked.noun.plural && asked.at == at + 1)
                && !self.links.iter().any(|(_, link)| link + 1 == at)
        };
        if let Some(at) = self.place_of(Mark::HowMany) {
            return asked.filter(general).filter(|_| counts(at)).map(|_| Query::Count(noun));
        }
        if self.asks_by_how_much() {
            return None;
        }
        if self.asks() {
            let which = asked.is_none_or(|asked| self.follows_which(asked.at) && general(&asked));
            return which.then_some(Query::Find(noun));
        }
        // "Is there anything taller than …?", "Is any chair …?"
        let any = match asked {
            Some(asked) => general(&asked) && (self.has(Mark::Exists) || asked.noun.indefinite),
            None => self.has(Mark::Anything) || self.has(Mark::Exists),
        };
        any.then(|| Query::Exists {
            what: vec![noun],
            either: false,
            denial: self.denied(self.negated),
        })
    }

    /// A noun with the places that stand behind it, before the next.
    fn with_own_places(&self, subject: &Subject) -> Noun {
        let next = self.nouns.iter().map(|s| s.at).find(|at| *at > subject.at);
        let own = |s: &&Spot| s.at > subject.at && next.is_none_or(|next| s.at < next);
        let mut noun = subject.noun.clone();
        for spot in self.spots.iter().filter(own) {
            self.attach(&mut noun, spot);
        }
        noun
    }

    /// The last noun of a place with the places that follow at once: "to the book on the dresser".
    fn with_next_places(&self, spot: &Spot) -> Vec<Noun> {
        let mut nouns = spot.nouns.clone();
        let mut at = spot.at;
        while let Some(next) = self
            .spots
            .iter()
            .find(|s| s.at == at + 1 && matches!(s.rel, Rel::In | Rel::On | Rel::Of | Rel::Under))
        {
            if let Some(last) = nouns.last_mut() {
                self.attach(last, next);
            }
            at = next.at;
        }
        nouns
    }

    /// «На сколько сантиметров шкаф выше комода?», "How much taller …"
    fn asks_by_how_much(&self) -> bool {
        self.has(Mark::HowMany) || self.has(Mark::HowFar)
    }

    pub(super) fn size(&self) -> Option<Query> {
        let dimension = self.marks.iter().find_map(|(mark, _)| match mark {
            Mark::HowBig(dimension) => Some(*dimension),
            _ => None,
        })?;
        let building = || {
            // "What is the total floor area?"
            let head = Head::of_kind(self.lexicon, &Extension::Building);
            matches!(dimension, Dimension::Area | Dimension::Height)
                .then(|| Noun { head, ..Noun::default() })
        };
        let of = self.first().or_else(|| self.spot_noun(&[Rel::NextTo, Rel::Of, Rel::In]));
        let of = of.or_else(building)?;
        let without: Vec<usize> = match self.nouns.is_empty() {
            true => self.spots.iter().take(1).map(|s| s.at).collect(),
            false => Vec::new(),
        };
        Some(Query::Size { dimension, of: self.with_rest(of, &without) })
    }

    /// «Самая большая комната?»
    pub(super) fn superlative(&self) -> Option<Query> {
        let [only] = &self.nouns[..] else { return None };
        let alone = self.marks.iter().any(|(m, _)| matches!(m, Mark::Best(_)));
        // «Левая тумбочка пустая?» claims it of the one.
        let valued = self.values.iter().any(|(_, at, _)| *at > only.at);
        // "Is the biggest bed in the bedroom?"
        let begins = self.marks.first() == Some(&(Mark::Be, 0));
        let placed = begins && self.spots.iter().any(|s| s.at > only.at);
        let claimed = valued || (placed && self.sentence.language == Language::English);
        if (only.noun.best.is_none() && !alone) || claimed {
            return None;
        }
        let mut noun = only.noun.clone();
        noun.head.named.clear();
        Some(Query::Find(Noun { indefinite: true, ..self.with_rest(noun, &[]) }))
    }
}
