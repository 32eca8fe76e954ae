//! What things are used for: «чем моют посуду», "where can I wash my hands?", "something to cut an apple with".
//!
//! Invariant: what an activity is done to limits nothing; every other noun narrows what serves for it, or the question
//! is not understood.

use super::{Frame, Subject};
use crate::question::lexicon::Extension;
use crate::question::mark::Mark;
use crate::question::purposes::{self, Role};
use crate::question::query::{Asked, Head, Noun, Query, Rel, Restriction};
use crate::question::uses;
use crate::sets::{Set, set};
use crate::words::Language;

impl Frame<'_, '_> {
    /// The activity that a sentence speaks of, and its place there.
    pub(super) fn activity_said(&self) -> Option<(u16, usize)> {
        let said = || {
            self.marks.iter().filter_map(|(mark, at)| match mark {
                Mark::Activity(activity) => Some((*activity, *at)),
                _ => None,
            })
        };
        // "Bring me something to write with": it is to be brought because one writes with it.
        said().find(|(activity, _)| !uses::moves(*activity)).or_else(|| said().next())
    }

    /// What the activity is done to, which need not be on the map: «порезать хлеб».
    pub(super) fn object_of_activity(&self) -> Option<&Subject> {
        let (activity, at) = self.activity_said()?;
        let beside = |place: usize| {
            let free =
                |s: &&Subject| s.at == place && !self.is_area(&s.noun) && !self.is_things(&s.noun);
            self.nouns.iter().find(free).filter(|_| uses::takes_object(activity))
        };
        // «хлеб порезать»; in English what stands before is no object.
        let russian = self.sentence.language == Language::Russian;
        let before = || at.checked_sub(1).filter(|_| russian && self.undone.is_none());
        beside(at + 1).or_else(|| beside(before()?))
    }

    /// «Что можно почитать?», "Where can I wash my hands?": the things of a sort, or where they are.
    pub(super) fn activity(&self) -> Option<Query> {
        let (activity, _) = self.activity_said()?;
        if let Some(query) = self.activity_with(activity) {
            return Some(query);
        }
        let sort = self.sort_for(activity)?;
        let role = purposes::role(sort);
        let asks = self.has(Mark::Where)
            || self.has(Mark::Whither)
            || self.asks()
            || self.has(Mark::Anything)
            || self.has(Mark::Help)
            || self.has(Mark::How)
            || self.has(Mark::MadeOf)
            || self.has(Mark::Than)
            || self.has(Mark::Can)
            || self.has(Mark::HowMany)
            || self.has(Mark::Exists);
        let own = self.lexicon.kinds_of_sort(sort);
        let head = || Head { kinds: own.clone(), ..Head::default() };
        if let Some(rooms) = self.rooms_asked() {
            return Some(self.rooms_having(&rooms, head()));
        }
        // «Что из мебели можно передвинуть?», "Which chairs can be moved?": what belongs to both.
        let of =
            |s: &&super::Spot| matches!(s.rel, Rel::From | Rel::Of) && !self.is_area(&s.nouns[0]);
        let of = self.spots.iter().find(of).filter(|_| matches!(role, Role::Patient | Role::Theme));
        let of = of.map(|s| (s.nouns[0].clone(), s.at));
        let which = |s: &&Subject| s.noun.head.named.is_empty() && self.follows_which(s.at);
        let both = of.or_else(|| match &self.nouns[..] {
            [only] if which(&only) && !self.is_things(&only.noun) => {
                Some((only.noun.clone(), usize::MAX))
            }
            _ => None,
        });
        if let (Some((mut noun, at)), true) = (both, asks) {
            noun.also.push(head());
            let noun = self.with_rest(noun, &[at]);
            return Some(Query::Find(Noun { plural: true, indefinite: true, ..noun }));
        }
        let object =
            self.object_of_activity().filter(|_| !matches!(role, Role::Patient | Role::Theme));
        let others: Vec<&Subject> =
            self.nouns.iter().filter(|s| object.is_none_or(|object| object.at != s.at)).collect();
        let noun = match others[..] {
            [] => Noun { head: head(), ..Noun::default() },
            [only] if self.covers(sort, &only.noun) => only.noun.clone(),
            [only] if only.noun.head.anything || self.is_things(&only.noun) => {
                Noun { head: head(), ..only.noun.clone() }
            }
            _ => return None,
        };
        // «вытереть пыль с полки»: what it is done to as well.
        let apart: Vec<usize> = self.beside_activity().map(|s| s.at).collect();
        let noun = Noun { plural: true, indefinite: true, ..self.with_rest(noun, &apart) };
        // "What else is there to eat?"
        let noun = Noun { other: noun.other || self.has(Mark::Other), ..noun };
        let where_asked = self.has(Mark::Where) || self.has(Mark::Whither);
        let plain = role == Role::Theme || noun.best.is_some();
        let asked = match () {
            () if self.has(Mark::HowMany) => Asked::HowMany,
            () if where_asked => Asked::Where,
            () if self.asks_whether() => Asked::Whether,
            () => Asked::What,
        };
        asks.then_some(match (plain, asked) {
            (true, Asked::Where) => Query::Where(noun),
            (true, Asked::HowMany) => Query::Count(noun),
            (true, _) => Query::Find(noun),
            (false, asked) => Query::Serving { sort, of: noun, asked },
        })
    }

    /// "Can I drink from the mug?": whether such things serve for it.
    fn activity_with(&self, activity: u16) -> Option<Query> {
        let [spot] = &self.spots[..] else { return None };
        let role = match spot.rel {
            Rel::From => Role::Source,
            Rel::Has => Role::Instrument,
            Rel::On | Rel::In => Role::Location,
            _ => return None,
        };
        let noun = &spot.nouns[0];
        let fits = |sort: &u16| purposes::role(*sort) == role && self.covers(*sort, noun);
        let sort = uses::sorts(activity).find(fits)?;
        let others =
            self.nouns.iter().any(|s| self.object_of_activity().is_none_or(|o| o.at != s.at));
        let of = Noun { plural: true, indefinite: true, ..noun.clone() };
        let whether = self.asks_whether() && !others && spot.nouns.len() == 1;
        whether.then_some(Query::Serving { sort, of, asked: Asked::Suits })
    }

    /// "Why can I drink from the mug?": of what is used, where a sentence names it; none where nothing is done.
    pub(super) fn activity_done_with(&self) -> Option<Option<Query>> {
        let (activity, _) = self.activity_said()?;
        if uses::moves(activity) {
            return None;
        }
        let sorts: Vec<u16> = uses::sorts(activity).collect();
        let nouns = self.nouns.iter().map(|s| &s.noun);
        let nouns = nouns.chain(self.spots.iter().flat_map(|s| &s.nouns));
        let about = nouns.into_iter().find_map(|noun| {
            let sort = sorts.iter().copied().find(|sort| self.covers(*sort, noun))?;
            let of = Noun { plural: true, indefinite: true, ..noun.clone() };
            Some(Query::Serving { sort, of, asked: Asked::Suits })
        });
        let negated = self.negated;
        Some(about.map(|about| Query::Why { negated, about: Some(Box::new(about)) }))
    }

    /// «Для чего нужен вантуз?», "What is a plunger used for?"
    pub(super) fn purpose(&self) -> Option<Query> {
        let keys = &self.sentence.keys;
        let english = keys.first().is_some_and(|key| key == "what")
            && keys.last().is_some_and(|key| key == "for");
        let russian =
            matches!(&keys[..], [first, second, ..] if first == "для" && second == "чего");
        let [only] = &self.nouns[..] else { return None };
        let asked = (english || russian) && self.spots.is_empty() && !self.is_area(&only.noun);
        let of = Noun { plural: true, indefinite: true, ..only.noun.clone() };
        asked.then(|| Query::Purpose(self.with_rest(of, &[])))
    }

    /// Places that tell of the activity and not of what serves for it: «с полки», «в тарелку».
    pub(super) fn beside_activity(&self) -> impl Iterator<Item = &super::Spot> {
        let takes = self.activity_said().is_some_and(|(activity, _)| uses::takes_object(activity));
        self.spots.iter().filter(move |s| {
            takes && matches!(s.rel, Rel::From | Rel::To | Rel::Of) && !self.is_area(&s.nouns[0])
        })
    }

    /// "Is there …?", "Can I … here?"
    fn asks_whether(&self) -> bool {
        // «Есть ли чем порезать хлеб?»
        let whether = self.sentence.keys.iter().any(|key| key == "ли");
        let exists = self.has(Mark::Exists) && (whether || !self.asks());
        let named = self.asks()
            || self.has(Mark::How)
            || self.has(Mark::Than)
            || self.has(Mark::MadeOf)
            || self.has(Mark::Anything)
            || !self.links.is_empty();
        exists || (self.has(Mark::Can) && !named)
    }

    /// Whether a noun means nothing but things of a sort.
    fn covers(&self, sort: u16, noun: &Noun) -> bool {
        let own = self.lexicon.kinds_of_sort(sort);
        let kinds = &noun.head.kinds;
        !kinds.is_empty() && kinds.iter().all(|kind| own.contains(kind))
    }

    /// Of the sorts of an activity the one whose role is asked for.
    fn sort_for(&self, activity: u16) -> Option<u16> {
        let sorts: Vec<u16> = uses::sorts(activity).collect();
        // «Где почитать книгу?» asks for the book.
        let patient = |sort: &&u16| {
            purposes::role(**sort) == Role::Patient
                && !self.nouns.is_empty()
                && self.nouns.iter().all(|s| self.covers(**sort, &s.noun))
        };
        if let Some(sort) = sorts.iter().find(patient) {
            return Some(*sort);
        }
        let of_role = |role| sorts.iter().copied().find(|sort| purposes::role(*sort) == role);
        self.roles_asked().into_iter().find_map(of_role)
    }

    /// The role of what the activity of the sentence asks for.
    pub(super) fn role_said(&self) -> Option<Role> {
        Some(purposes::role(self.sort_for(self.activity_said()?.0)?))
    }

    /// Which part in the activity is asked for, the likeliest first.
    fn roles_asked(&self) -> Vec<Role> {
        use Role::{Instrument, Location, Patient, Source, Theme};
        static TO_USE: Set = Set::named("ToUse");
        static PLACES: Set = Set::named("EndsPlaced");
        let keys = &self.sentence.keys;
        let said = |words: &[&str]| keys.iter().any(|key| words.contains(&key.as_str()));
        let pair = |first: &[&str], second: &str| {
            keys.windows(2).any(|two| first.contains(&two[0].as_str()) && two[1] == second)
        };
        // «на чём», "on what"
        let placed = keys.last().is_some_and(|key| PLACES.contains(&key.as_str()))
            || pair(set!("InOrOn"), "чем")
            || pair(&["во", "на"], "что")
            || pair(&PLACES, "what");
        let with = said(&["with"]) || (said(&["чем"]) && !placed) || pair(&["с"], "чего");
        let source =
            (self.has(Mark::MadeOf) || said(&["from", "out"])) && self.spot(&[Rel::From]).is_none();
        match () {
            () if with => vec![Instrument, Location, Source, Patient],
            () if source => vec![Source, Instrument, Location],
            () if placed || self.asks_where() => {
                vec![Location, Instrument, Source, Patient, Theme]
            }
            () if self.has(Mark::Anything) => vec![Patient, Theme, Instrument, Location, Source],
            () if said(&TO_USE) || self.has(Mark::How) => vec![Instrument, Location, Source],
            // «Что можно порезать?» asks what is cut, not with what.
            () if self.asks() => vec![Patient, Theme],
            () => vec![Patient, Theme, Location, Instrument, Source],
        }
    }

    /// «где», «куда», «в какой комнате»
    fn asks_where(&self) -> bool {
        self.has(Mark::Where) || self.has(Mark::Whither) || self.rooms_asked().is_some()
    }

    /// «в каких комнатах», "how many rooms": rooms that are asked for.
    pub(super) fn rooms_asked(&self) -> Option<Noun> {
        let asked = self.nouns.iter().find(|s| {
            let counted = self.place_of(Mark::HowMany).is_some_and(|at| at < s.at);
            self.is_rooms(&s.noun)
                && !self.is_storeys(&s.noun)
                && (self.follows_which(s.at) || counted)
        })?;
        let others = self.nouns.iter().all(|s| s.at == asked.at);
        others.then(|| asked.noun.clone())
    }

    /// The rooms that have something of a sort, or how many these are.
    pub(super) fn rooms_having(&self, rooms: &Noun, head: Head) -> Query {
        let mut rooms = Noun { plural: true, indefinite: true, ..rooms.clone() };
        rooms.head.named.clear();
        let anchors = vec![Noun { head, indefinite: true, plural: true, ..Noun::default() }];
        rooms.restrictions.push(Restriction { rel: Rel::Has, anchors, negated: self.negated });
        let rooms = self.with_rest(rooms, &[]);
        if self.has(Mark::HowMany) { Query::Count(rooms) } else { Query::Find(rooms) }
    }

    /// "things", «предметы»: anything at all.
    pub(super) fn is_things(&self, noun: &Noun) -> bool {
        let things = |k: &_| self.lexicon.kind(*k).extension == Extension::Things;
        noun.head.named.is_empty()
            && !noun.head.kinds.is_empty()
            && noun.head.kinds.iter().all(things)
    }
}
