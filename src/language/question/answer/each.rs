//! Room by room, and whether there are so many.
//!
//! Invariant: what is asked of each room is answered of each, not of all together.

use super::Draft;
use crate::question::knowledge::Knowledge;
use crate::question::query::{Head, Noun, Rel, Restriction, Thing};
use crate::question::{Doubt, Said};
use crate::words::enumerate;

impl Knowledge<'_> {
    /// The description without its «на каждом столе», how things lie to these, and the tables.
    pub(super) fn at_each(&self, noun: &Noun) -> Result<Option<(Noun, Rel, Vec<Thing>)>, Doubt> {
        let Some(at) = noun.restrictions.iter().position(|r| {
            !r.negated && matches!(&r.anchors[..], [only] if only.all && only.head.named.is_empty())
        }) else {
            return Ok(None);
        };
        let rel = noun.restrictions[at].rel;
        let each = self.find(&noun.restrictions[at].anchors[0], true)?;
        if each.len() < 2 || !each.iter().all(|t| t.replica().is_some()) {
            return Ok(None);
        }
        let mut noun = noun.clone();
        noun.restrictions.remove(at);
        Ok(Some((noun, rel, each)))
    }

    /// The description without its «в каждой комнате», and the rooms or storeys that this means.
    pub(super) fn in_each(&self, noun: &Noun) -> Result<Option<(Noun, Vec<Thing>)>, Doubt> {
        let each = noun.restrictions.iter().position(|r| {
            matches!(r.rel, Rel::In | Rel::On)
                && !r.negated
                && matches!(&r.anchors[..], [only] if only.all && only.head.named.is_empty())
        });
        let Some(at) = each else { return Ok(None) };
        let rooms = self.find(&noun.restrictions[at].anchors[0], true)?;
        let places = |t: &Thing| {
            t.area().is_some() || matches!(t, Thing::Entity(crate::map::Entity::Map(_)))
        };
        if rooms.len() < 2 || !rooms.iter().all(places) {
            return Ok(None);
        }
        let mut noun = noun.clone();
        noun.restrictions.remove(at);
        Ok(Some((noun, rooms)))
    }

    /// "What is on each nightstand?", "Name one thing in each room": of every one by itself.
    pub(super) fn found_by_each(&self, noun: &Noun) -> Result<Option<Draft>, Doubt> {
        const SHOWN: usize = 12;
        const SHOWN_OF_SO_MANY: usize = 30;
        let asked = noun.count.map(|count| usize::try_from(count).unwrap_or(usize::MAX));
        let Some(at) = noun.restrictions.iter().position(|r| {
            !r.negated && matches!(&r.anchors[..], [only] if only.all && only.head.named.is_empty())
        }) else {
            return Ok(None);
        };
        let restriction = &noun.restrictions[at];
        let each = self.find(&restriction.anchors[0], true)?;
        if each.len() < 2 || asked.is_none() && each.len() > SHOWN {
            return Ok(None);
        }
        let (mut parts, mut all) = (Vec::new(), Vec::new());
        let more = each.len().saturating_sub(SHOWN_OF_SO_MANY);
        for place in each.into_iter().take(SHOWN_OF_SO_MANY) {
            let mut own = noun.clone();
            own.restrictions[at].anchors[0] = Noun {
                head: Head { things: Some(vec![place]), ..Head::default() },
                ..Noun::default()
            };
            let mut found = self.find(&own, true)?;
            found.truncate(asked.unwrap_or(usize::MAX));
            all.extend(found.iter().copied().filter(|t| !all.contains(t)).collect::<Vec<_>>());
            let here = self.place(restriction.rel, &[place]);
            parts.push(match (found.is_empty(), self.is_russian()) {
                (false, true) => format!("{here} {} {}", self.is(&found), self.list(&found)),
                (false, false) => format!("{} {} {here}", self.list(&found), self.is(&found)),
                (true, true) if own.head.anything => format!("{here} ничего нет"),
                (true, true) => format!("{here} нет {}", self.none_of(&own)),
                (true, false) if own.head.anything => format!("there is nothing {here}"),
                (true, false) => self.there_is_no(&own, &here),
            });
        }
        if more > 0 {
            parts.push(
                self.pick("и ещё", "and").to_owned() + &format!(" {more}") + self.pick("", " more"),
            );
        }
        let said = if all.is_empty() { Said::Nothing } else { Said::Found };
        Ok(Some(Draft::new(said, parts.join("; ")).with(all)))
    }

    /// "What is the biggest thing in each room?": of every place by itself.
    pub(super) fn best_by_each(&self, noun: &Noun) -> Result<Option<Draft>, Doubt> {
        let each =
            |place: &Restriction| matches!(&place.anchors[..], [only] if only.all && !only.plural);
        if noun.best.is_none() || noun.count.is_some() || !noun.restrictions.iter().any(each) {
            return Ok(None);
        }
        let Some((own, rooms)) = self.in_each(noun)? else { return Ok(None) };
        let (mut parts, mut all) = (Vec::new(), Vec::new());
        for room in rooms {
            let head = Head { things: Some(vec![room]), ..Head::default() };
            let anchors = vec![Noun { head, ..Noun::default() }];
            let mut here = own.clone();
            here.restrictions.push(Restriction { rel: Rel::In, anchors, negated: false });
            let found = self.find(&here, false)?;
            let place = self.place(Rel::In, &[room]);
            parts.push(match (found.is_empty(), self.is_russian()) {
                (false, _) => format!("{place} – {}", self.list(&found)),
                (true, true) => format!("{place} нет {}", self.none_of(&own)),
                (true, false) => self.there_is_no(&own, &place),
            });
            all.extend(found);
        }
        let said = if all.is_empty() { Said::Nothing } else { Said::Found };
        Ok(Some(Draft::new(said, parts.join("; ")).with(all)))
    }

    /// What fits a description, by room.
    fn by_room(&self, noun: &Noun, rel: Rel, rooms: &[Thing]) -> Vec<(Thing, Vec<Thing>)> {
        let found = self.counted_at(noun, rooms).unwrap_or_default();
        let here = |room: &Thing| {
            let inside = self.related(rel, *room);
            inside.into_iter().filter(|t| found.contains(t)).collect()
        };
        rooms.iter().map(|room| (*room, here(room))).collect()
    }

    pub(super) fn count_in_each(&self, noun: &Noun, rooms: &[Thing]) -> Draft {
        const SHOWN: usize = 20;
        let by_room = self.by_room(noun, Rel::In, rooms);
        let counted = by_room.iter().filter(|(_, found)| !found.is_empty());
        let parts: Vec<String> = counted
            .take(SHOWN)
            .map(|(room, found)| {
                let place = self.place(Rel::In, &[*room]);
                let counted = self.counted(noun, found.len());
                match self.is_russian() {
                    true => format!("{place} {counted}"),
                    false => format!("{counted} {place}"),
                }
            })
            .collect();
        let without: Vec<Thing> =
            by_room.iter().filter(|(_, found)| found.is_empty()).map(|(room, _)| *room).collect();
        let mut text = enumerate(&parts, self.language);
        let more = by_room.len() - without.len() - parts.len();
        if more > 0 {
            text = match self.is_russian() {
                true => format!("{text} и ещё в {more} помещениях"),
                false => format!("{text} and in {more} rooms more"),
            };
        }
        if !without.is_empty() {
            let place = self.place(Rel::In, &without);
            let none = self.none_of(noun);
            let lacking = match self.is_russian() {
                true => format!("{place} {none} нет"),
                false => self.there_is_no(noun, &place),
            };
            text = if text.is_empty() { lacking } else { format!("{text}; {lacking}") };
        }
        let found: Vec<Thing> = by_room.into_iter().flat_map(|(_, found)| found).collect();
        let number = found.len() as f64;
        Draft::new(Said::Found, text).with(found).number(number)
    }

    pub(super) fn exists_in_each(&self, noun: &Noun, rel: Rel, rooms: &[Thing]) -> Draft {
        let by_room = self.by_room(noun, rel, rooms);
        let (with, without): (Vec<_>, Vec<_>) =
            by_room.into_iter().partition(|(_, found)| !found.is_empty());
        let rooms = |all: &[(Thing, Vec<Thing>)]| all.iter().map(|(r, _)| *r).collect::<Vec<_>>();
        let none = self.none_of(noun);
        let lacking = self.place(rel, &rooms(&without));
        let text = match (with.is_empty(), without.is_empty(), self.is_russian()) {
            (_, true, true) => format!("да, {}", self.place(rel, &rooms(&with))),
            (_, true, false) => format!("yes, {}", self.place(rel, &rooms(&with))),
            (_, false, true) => format!("нет, не везде: {lacking} {none} нет"),
            (_, false, false) => {
                format!("no, not everywhere: {}", self.there_is_no(noun, &lacking))
            }
        };
        let said = if without.is_empty() { Said::Yes } else { Said::No };
        let things = with.into_iter().flat_map(|(_, found)| found).collect();
        Draft::new(said, text).with(things)
    }

    /// "Are there at least four chairs in the kitchen?"
    pub(super) fn exist_so_many(&self, noun: &Noun, asked: u64) -> Result<Draft, Doubt> {
        let plain = Noun { count: None, plural: true, ..noun.clone() };
        let found = self.find(&plain, true)?;
        let facts = self.facts_of(&plain, &found);
        let yes = noun.quantity.admits(found.len() as u64, asked);
        let counted = self.count(&plain)?;
        let text = format!(
            "{}{}",
            if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") },
            counted.text
        );
        let said = if yes { Said::Yes } else { Said::No };
        let number = found.len() as f64;
        Ok(Draft { facts, ..Draft::new(said, text).with(found) }.number(number))
    }
}
