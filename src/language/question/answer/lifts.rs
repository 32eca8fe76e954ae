//! Lifts: at which storeys they stop.
//!
//! Invariant: a lift has an Area on every storey where it stops, and is asked of by any of them.

use super::Draft;
use crate::map::Entity;
use crate::question::knowledge::Knowledge;
use crate::question::lexicon::{Extension, KindId};
use crate::question::query::{Claim, Noun, Rel, Thing};
use crate::question::{Doubt, Said};

impl Knowledge<'_> {
    /// "Is there a lift? Which floors does it go to?": where it stops.
    pub(super) fn storeys_of_lift(&self, noun: &Noun) -> Option<Draft> {
        let storeys = |k: &KindId| self.lexicon().kind(*k).extension == Extension::Storeys;
        let [place] = &noun.restrictions[..] else { return None };
        if place.negated || !noun.head.kinds.iter().any(storeys) {
            return None;
        }
        let lifts = place.anchors.first()?;
        self.stops_of_lifts(lifts, self.find(lifts, true).ok()?)
    }

    /// «На какие этажи ходят лифты?»: where each stops, as nothing tells where a cabin is; none of what is no lift.
    pub(super) fn stops_of_lifts(&self, noun: &Noun, mut cabins: Vec<Thing>) -> Option<Draft> {
        self.one_of_each_lift(noun, &mut cabins);
        let stops: Option<Vec<Vec<Thing>>> = cabins.iter().map(|t| self.stops_of(*t)).collect();
        let stops = stops.filter(|stops| !stops.is_empty())?;
        let mut maps: Vec<Thing> = Vec::new();
        for map in stops.iter().flatten() {
            if !maps.contains(map) {
                maps.push(*map);
            }
        }
        let together = stops.iter().all(|own| *own == stops[0]);
        let text = match together {
            true => self.stops_at(&cabins, &maps),
            false => {
                let each =
                    cabins.iter().zip(&stops).map(|(cabin, own)| self.stops_at(&[*cabin], own));
                each.collect::<Vec<_>>().join("; ")
            }
        };
        Some(Draft::new(Said::Found, text).with(maps).about(&cabins))
    }

    /// "Does the lift go to the second floor?", «Останавливается ли лифт на обоих этажах?»: whether it stops there.
    pub(super) fn lift_goes(
        &self,
        subject: &Noun,
        claims: &[Claim],
        negated: bool,
    ) -> Result<Option<Draft>, Doubt> {
        let [Claim::Related(place)] = claims else { return Ok(None) };
        let whither = matches!(place.rel, Rel::To | Rel::Near | Rel::NextTo | Rel::At | Rel::On);
        let [anchor] = &place.anchors[..] else { return Ok(None) };
        let storeys = self.find(anchor, true).unwrap_or_default();
        if !whither || storeys.is_empty() || !storeys.iter().all(Thing::is_storey) {
            return Ok(None);
        }
        let all = self.find(subject, true).unwrap_or_default();
        if all.is_empty() || !all.iter().all(|thing| self.stops_of(*thing).is_some()) {
            return Ok(None);
        }
        let mut found = self.definite(subject)?;
        self.one_of_each_lift(subject, &mut found);
        let [cabin] = found[..] else { return Ok(None) };
        // "The second floor" is one of them; "both floors" are all.
        let storeys = match anchor.plural || anchor.all {
            true => storeys,
            false => vec![self.one(anchor)?],
        };
        let maps = self.stops_of(cabin).unwrap_or_default();
        let yes = storeys.iter().all(|storey| maps.contains(storey)) != (place.negated ^ negated);
        let head = if yes { self.pick("да, ", "yes, ") } else { self.pick("нет, ", "no, ") };
        let text = format!("{head}{}", self.stops_at(&[cabin], &maps));
        let said = if yes { Said::Yes } else { Said::No };
        Ok(Some(Draft::new(said, text).with(vec![cabin]).about(&maps)))
    }

    /// The storeys where a lift stops.
    fn stops_of(&self, cabin: Thing) -> Option<Vec<Thing>> {
        let area = cabin.area()?;
        let lifts = &self.world.domain.lifts;
        let (_, stops) = lifts.iter().find(|(_, stops)| stops.iter().any(|s| s.area == area))?;
        let on = |area| self.world.placement(area).map(|(map, _)| Thing::Entity(Entity::Map(map)));
        let mut maps: Vec<Thing> = stops.iter().filter_map(|stop| on(stop.area)).collect();
        maps.dedup();
        Some(maps)
    }

    fn stops_at(&self, cabins: &[Thing], maps: &[Thing]) -> String {
        let (names, list) = (self.list(cabins), self.list(maps));
        match (self.is_russian(), cabins) {
            (true, [_]) => format!("{names} останавливается здесь: {list}"),
            (true, _) => format!("{names} останавливаются здесь: {list}"),
            (false, [_]) => format!("{names} stops at {list}"),
            (false, _) => format!("{names} stop at {list}"),
        }
    }
}
