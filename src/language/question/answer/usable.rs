//! What is free on a thing, and where one can sit, lie or put something down.
//!
//! Invariant: a seat on which something stands is none, and nothing is put where its base does not fit.

use super::Draft;
use crate::question::knowledge::Knowledge;
use crate::question::purposes;
use crate::question::query::{Head, Noun, Rel, Restriction, Thing, Use};
use crate::question::{Doubt, Fact, Said};
use crate::words::Case;
use crate::words::area;

impl Knowledge<'_> {
    pub(super) fn free(&self, noun: &Noun) -> Result<Draft, Doubt> {
        let thing = self.one(noun)?;
        let top = thing.replica().and_then(|id| self.relations.free_top(id));
        let Some((whole, free)) = top.filter(|(whole, _)| *whole > 0.0) else {
            let text = match self.is_russian() {
                true => format!(
                    "{} {} ничего положить нельзя",
                    "на",
                    self.form(thing, Case::Accusative)
                ),
                false => format!("nothing can be put on {}", self.name(thing)),
            };
            return Ok(Draft::new(Said::No, text).with(vec![thing]));
        };
        let share = (free / whole * 100.0).round();
        let has_room = share >= self.relations.thresholds().top_free * 100.0;
        let on_it = self.related(Rel::On, thing);
        let (free_words, place) = (area(free, self.language), self.place(Rel::On, &[thing]));
        let mut text = match (has_room, self.is_russian()) {
            (true, true) => format!("{place} свободно {share:.0} % поверхности ({free_words})"),
            (true, false) => format!("{share:.0} % of the surface {place} is free ({free_words})"),
            (false, true) => format!("нет, {place} почти нет свободного места"),
            (false, false) => format!("no, there is hardly any free space {place}"),
        };
        if !on_it.is_empty() {
            let list = self.list(&on_it);
            text = match self.is_russian() {
                true => format!("{text}; там {} {list}", self.is(&on_it)),
                false => format!("{text}; {list} {} there", self.is(&on_it)),
            };
        }
        let said = if has_room { Said::Yes } else { Said::No };
        Ok(Draft::new(said, text).with(vec![thing]).about(&on_it).number(share))
    }

    pub(super) fn usable(
        &self,
        use_for: Use,
        what: Option<&Noun>,
        within: &[Restriction],
    ) -> Result<Draft, Doubt> {
        if let Some(own) = self.seat_itself(use_for, within)? {
            return Ok(own);
        }
        let mut noun = Noun { plural: true, indefinite: true, ..Noun::default() };
        noun.head.anything = true;
        // «положить на стол»: among the tables, not what lies on them.
        let (on, within): (Vec<&Restriction>, Vec<&Restriction>) = within.iter().partition(|r| {
            use_for == Use::Put
                && r.rel == Rel::On
                && r.anchors.iter().all(|a| {
                    self.find(a, true).is_ok_and(|f| f.iter().all(|t| t.replica().is_some()))
                })
        });
        if let [Restriction { anchors, .. }] = &on[..]
            && let [anchor] = &anchors[..]
        {
            noun = Noun { plural: true, indefinite: true, ..anchor.clone() };
        }
        noun.restrictions.extend(within.into_iter().cloned());
        let all = self.find(&noun, false)?;
        let thing = match what {
            Some(what) if use_for == Use::Put => {
                let mut found = self.find(what, true)?;
                found.truncate(1);
                found.pop()
            }
            _ => None,
        };
        let needed = thing
            .and_then(Thing::replica)
            .and_then(|id| self.relations.extent(id))
            .map_or(400.0, |e| e.base);
        let fits = |t: &Thing| {
            let Some(id) = t.replica() else { return false };
            match use_for {
                Use::Sit => self.world.has_trait(id, "seat"),
                Use::Lie => self.world.has_trait(id, "bed"),
                Use::Put => {
                    self.world.has_trait(id, "support")
                        && !self.world.has_trait(id, "portable")
                        && Some(*t) != thing
                        && self.relations.free_top(id).is_some_and(|(_, free)| free >= needed)
                }
            }
        };
        let mut found: Vec<Thing> = all.into_iter().filter(fits).collect();
        if use_for == Use::Sit {
            self.leave_toilets(&mut found);
        }
        let all = found.clone();
        // What something stands on is no seat now.
        let found: Vec<Thing> = match use_for {
            Use::Put => found,
            _ => found.into_iter().filter(|t| self.has_room_for_one(use_for, *t)).collect(),
        };
        let place = self.restrictions(&noun).trim().to_owned();
        let text = match (use_for, found.is_empty(), self.is_russian()) {
            (Use::Put, true, true) if !on.is_empty() => {
                format!("нет, {} для этого не хватает места", self.general_on(&noun))
            }
            (Use::Put, true, false) if !on.is_empty() => {
                format!("no, there is not enough room {}", self.general_on(&noun))
            }
            (_, true, true) if !all.is_empty() => {
                format!("{place} всё занято: {}", self.list(&all))
            }
            (_, true, false) if !all.is_empty() => {
                let all = self.list(&all);
                match place.is_empty() {
                    true => format!("all such places are occupied: {all}"),
                    false => format!("all such places {place} are occupied: {all}"),
                }
            }
            (_, true, true) => format!("{place} такого места на карте нет"),
            (_, true, false) => format!("the map has no such place {place}"),
            (Use::Sit, _, true) => format!("сесть можно {}", self.seats(&found, &place)),
            (Use::Sit, _, false) => format!("one can sit on {}", self.seats(&found, &place)),
            (Use::Lie, _, true) => format!("лечь можно {}", self.seats(&found, &place)),
            (Use::Lie, _, false) => format!("one can lie down on {}", self.seats(&found, &place)),
            (Use::Put, _, true) => format!("свободное место есть {}", self.place(Rel::On, &found)),
            (Use::Put, _, false) => format!("there is free space {}", self.place(Rel::On, &found)),
        };
        let facts = found.iter().take(20).map(|t| {
            let wanted = match use_for {
                Use::Sit => "seat",
                Use::Lie => "bed",
                Use::Put => "support",
            };
            Fact::holding("HAS_TRAIT", vec![self.symbol(*t), wanted.to_owned()])
        });
        let facts = facts.collect();
        let said = match found.is_empty() {
            true if !on.is_empty() && use_for == Use::Put => Said::No,
            true => Said::Nothing,
            false => Said::Found,
        };
        Ok(Draft { facts, ..Draft::new(said, text).with(found) })
    }

    /// Whether nothing is on a seat or a bed, or so little that one sits or lies beside it.
    fn has_room_for_one(&self, use_for: Use, thing: Thing) -> bool {
        /// So much has to be free, cm² and of 1: of a seat a square of 40 cm, of a bed two metres by half a metre.
        const SITTING: (f64, f64) = (1600.0, 0.6);
        const LYING: (f64, f64) = (10_000.0, 0.8);
        let (least, share) = if use_for == Use::Lie { LYING } else { SITTING };
        let roomy = |(area, free): (f64, f64)| free >= least && free >= share * area;
        thing.replica().is_none_or(|id| {
            !self.relations.bears_something(id) || self.relations.free_top(id).is_some_and(roomy)
        })
    }

    /// «на Столе-1», "on the tables"
    fn general_on(&self, noun: &Noun) -> String {
        let anchors = vec![noun.clone()];
        let place = Restriction { rel: Rel::On, anchors, negated: false };
        self.restrictions(&Noun { restrictions: vec![place], ..Noun::default() })
    }

    /// «Можно ли сесть на кровать?» asks of the bed itself.
    fn seat_itself(&self, use_for: Use, within: &[Restriction]) -> Result<Option<Draft>, Doubt> {
        let (wanted, russian, english) = match use_for {
            Use::Sit => ("seat", "сесть", "sit on"),
            Use::Lie => ("bed", "лечь", "lie down on"),
            Use::Put => return Ok(None),
        };
        let [Restriction { rel: Rel::On | Rel::In, anchors, negated: false }] = within else {
            return Ok(None);
        };
        let [anchor] = &anchors[..] else { return Ok(None) };
        let found = self.find(anchor, true)?;
        if found.is_empty() || found.iter().any(|t| t.replica().is_none()) {
            return Ok(None);
        }
        let found = match found.len() {
            1 => found,
            _ => self.definite(anchor)?,
        };
        let fits = |t: &Thing| t.replica().is_some_and(|id| self.world.has_trait(id, wanted));
        let (good, bad): (Vec<Thing>, Vec<Thing>) =
            found.iter().copied().partition(|t| fits(t) && self.has_room_for_one(use_for, *t));
        let text = match (good.is_empty(), self.is_russian()) {
            (false, true) => format!("да, {russian} можно {}", self.onto(&good)),
            (false, false) => format!("yes, one can {english} {}", self.list(&good)),
            (true, is_russian) if bad.iter().all(fits) => {
                let on_it = self.related(Rel::On, bad[0]);
                match is_russian {
                    true => format!(
                        "нет, {} {} {}",
                        self.place(Rel::On, &bad[..1]),
                        self.is(&on_it),
                        self.list(&on_it)
                    ),
                    false => format!(
                        "no, {} {} {}",
                        self.list(&on_it),
                        self.is(&on_it),
                        self.place(Rel::On, &bad[..1])
                    ),
                }
            }
            (true, true) => format!("нет, {} – не место для этого", self.list(&bad)),
            (true, false) => format!("no, {} is not made for that", self.list(&bad)),
        };
        let facts = good
            .iter()
            .map(|t| Fact::holding("HAS_TRAIT", vec![self.symbol(*t), wanted.to_owned()]));
        let facts = facts.collect();
        let said = if good.is_empty() { Said::No } else { Said::Yes };
        Ok(Some(Draft { facts, ..Draft::new(said, text).with(found) }))
    }

    /// «в Гостиной – на Диван-1 и Кресло-1; в Спальне – на Кровать-1»; where the place was said, without the rooms.
    fn seats(&self, found: &[Thing], place: &str) -> String {
        if !place.is_empty() {
            return self.onto(found);
        }
        let told = |(room, things): &(String, Vec<Thing>)| match self.is_russian() {
            true => format!("{room} – {}", self.onto(things)),
            false => format!("{} {room}", self.onto(things)),
        };
        self.in_each_room(found).iter().map(told).collect::<Vec<_>>().join("; ")
    }

    /// «на Диван-1 и Кресло-1»; in English the verb says "on".
    fn onto(&self, things: &[Thing]) -> String {
        match self.is_russian() {
            true => format!("на {}", self.names(things, Case::Accusative)),
            false => self.list(things),
        }
    }

    /// A toilet is a seat only where there is no other.
    fn leave_toilets(&self, seats: &mut Vec<Thing>) {
        let sort = purposes::sort_called("place to relieve yourself");
        let kinds = sort.map(|sort| self.lexicon().kinds_of_sort(sort)).unwrap_or_default();
        let toilets = self.base(&Head { kinds, ..Head::default() });
        if seats.iter().any(|seat| !toilets.contains(seat)) {
            seats.retain(|seat| !toilets.contains(seat));
        }
    }

    /// «да, …», "no, …" before what there is or is not.
    pub(super) fn as_yes_or_no(&self, draft: Draft) -> Draft {
        if matches!(draft.said, Some(Said::Yes | Said::No)) {
            return draft;
        }
        let found = !draft.things.is_empty();
        let (said, russian, english) = match found {
            true => (Said::Yes, "да, ", "yes, "),
            false => (Said::No, "нет, ", "no, "),
        };
        let text = format!("{}{}", self.pick(russian, english), draft.text.trim_start());
        Draft { said: Some(said), text, ..draft }
    }
}
