//! Questions for ways by their rooms and doors: through which, without which, how many.
//!
//! Invariant: every room and door that is named is an end of the way, on it, or not on it.

use super::Frame;
use crate::question::lexicon::Extension;
use crate::question::mark::Mark;
use crate::question::query::{Best, Extreme, Head, Noun, Passing, Query, Rel};

impl Frame<'_, '_> {
    /// «Можно ли попасть из кухни в спальню, минуя коридор?», "How many doors are there on the way to the bedroom?"
    pub(super) fn passing(&self) -> Option<Query> {
        let nouns = |negated: bool| -> Vec<Noun> {
            // «без лифта», "without the lift"
            let spots = self.spots.iter().filter(|s| {
                s.rel == Rel::Through
                    || (negated && s.rel == Rel::Has && s.nouns.iter().all(|n| self.is_lifts(n)))
            });
            let named = spots.filter(|s| s.negated == negated).flat_map(|s| s.nouns.iter());
            // Which of the lifts is all the same to who uses none.
            let each = |noun: &Noun| {
                let mut noun = noun.clone();
                if self.is_lifts(&noun) {
                    noun.plural = true;
                    noun.head.named.clear();
                }
                noun
            };
            named.map(each).collect()
        };
        let (through, avoiding) = (nouns(false), nouns(true));
        let goes = self.has(Mark::Move) || self.has(Mark::Lead);
        let asked = self.nouns.first();
        let counted = asked.filter(|s| {
            let general = s.noun.head.named.is_empty() && s.noun.head.things.is_none();
            general && (self.is_doors(&s.noun) || self.is_rooms(&s.noun))
        });
        let counts = self.has(Mark::HowMany) && self.nouns.len() == 1;
        let between = self.spot(&[Rel::Between]).filter(|s| {
            s.nouns.len() == 2 && s.nouns.iter().all(|n| self.is_area(n) && !self.is_building(n))
        });
        let told = goes || self.has(Mark::HowGet);
        let asks = match counted.filter(|_| counts) {
            // Rooms that are "connected to the kitchen" are on no way.
            Some(rooms)
                if self.is_rooms(&rooms.noun)
                    && (between.is_some() || self.has(Mark::Move) || self.has(Mark::HowGet)) =>
            {
                Passing::Rooms
            }
            Some(doors) if self.is_doors(&doors.noun) && told => Passing::Doors,
            // How far it is through something is asked of two ways.
            _ if self.has(Mark::HowFar) && through.is_empty() && !avoiding.is_empty() => {
                Passing::Far
            }
            _ if self.has(Mark::HowLong) && through.is_empty() && !avoiding.is_empty() => {
                Passing::Long
            }
            _ if self.asks() => return None,
            _ if self.has(Mark::Unopened) => Passing::Unopened,
            _ if self.has(Mark::MustOpen) => Passing::Opens,
            _ if self.has(Mark::Directly) && self.has(Mark::Can) && goes => Passing::Directly,
            _ if through.is_empty() && avoiding.is_empty() => return None,
            _ if self.has(Mark::Must) && goes => Passing::Must,
            _ if (self.has(Mark::Can) && goes && !self.has(Mark::How))
                || (self.has(Mark::HowGet) && self.has(Mark::Exists)) =>
            {
                Passing::Whether
            }
            _ if self.has(Mark::HowGet) || (self.has(Mark::How) && goes) => Passing::How,
            _ => return None,
        };
        const TO: [Rel; 6] = [Rel::To, Rel::In, Rel::On, Rel::At, Rel::NextTo, Rel::Near];
        let (from, to) = match between {
            Some(pair) => (Some(pair.nouns[0].clone()), Some(pair.nouns[1].clone())),
            None => (self.spot_noun(&[Rel::From]), self.spot_noun(&TO)),
        };
        // "Can I reach the bedroom without opening a door?"
        let reached = self.nouns.iter().find(|s| counted.is_none_or(|c| c.at != s.at));
        let to = to.or_else(|| reached.map(|s| s.noun.clone()))?;
        let to = match self.is_building(&to) || self.is_exits(&to) {
            true => self.nearest_exit(),
            false => to,
        };
        Some(Query::Passing { from, to, through, avoiding, asks })
    }

    fn is_lifts(&self, noun: &Noun) -> bool {
        noun.head.kinds.iter().any(|kind| {
            let kind = self.lexicon.kind(*kind);
            kind.extension == Extension::Lifts || kind.english == "lift"
        })
    }

    /// The nearest way out.
    pub(super) fn nearest_exit(&self) -> Noun {
        let best = Some(Best { extreme: Extreme::Nearest, anchor: None });
        Noun { head: Head::of_kind(self.lexicon, &Extension::Exits), best, ..Noun::default() }
    }
}
