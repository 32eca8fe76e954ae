//! A way in words: rooms, doors and turns, and through corridors the instructions of the road graph (SPEC C4).

use crate::corridor::{CorridorSystem, Shape, Variant, directions};
use crate::language::Language;
use crate::language::report::Detail;
use crate::semantics::Thresholds;
use crate::units::{AreaId, Deg, MapId};

use super::known::Known;
use super::route::RouteAnswer;
use super::{Error, State};

impl State {
    /// A way over the map as sentences. Where it runs through corridors from one entrance to another, the sentences are
    /// those of the corridor's road graph, which need no coordinates. `heading` is how one stands at the beginning,
    /// where that is known.
    ///
    /// # Errors
    /// There is no map.
    pub fn route_in_words(
        &self,
        answer: &RouteAnswer,
        heading: Option<Deg>,
        language: Language,
        detail: Detail,
    ) -> Result<Vec<String>, Error> {
        self.around()?.route_in_words(answer, heading, language, detail)
    }

    /// The corridors of a Map, without one of all: what makes one is told by the rules.
    ///
    /// # Errors
    /// There is no map, or none of its floors is a corridor's.
    pub fn corridors(&self, map: Option<MapId>) -> Result<CorridorSystem, Error> {
        self.surveyed()?.corridors(map)
    }
}

/// What makes a corridor.
fn corridor_shape(told: &Thresholds) -> Shape {
    Shape {
        parallel: told.corridor_parallel,
        shortest: told.corridor_shortest,
        slender: told.corridor_slender,
        covered: told.corridor_covered,
        stub: told.corridor_stub,
        bend: told.corridor_bend,
        arm: told.corridor_arm,
        ahead: told.corridor_ahead,
        aside: told.corridor_aside,
        askew: told.corridor_askew,
    }
}

impl Known {
    /// As [`State::corridors`].
    fn corridors(&self, map: Option<MapId>) -> Result<CorridorSystem, Error> {
        let (world, relations) = (self.world(), self.relations()?);
        let (openings, shape) = (relations.openings(), corridor_shape(relations.thresholds()));
        Ok(match map {
            Some(map) => CorridorSystem::from_map(world, openings, map, &shape)?,
            None => CorridorSystem::from_world(world, openings, &shape)?,
        })
    }

    /// As [`State::route_in_words`].
    pub(super) fn route_in_words(
        &self,
        answer: &RouteAnswer,
        heading: Option<Deg>,
        language: Language,
        detail: Detail,
    ) -> Result<Vec<String>, Error> {
        let world = self.world();
        let Some(way) = self.directions(answer, heading)? else { return Ok(Vec::new()) };
        if detail == Detail::Region || answer.stages.len() < 2 {
            return Ok(way.say_in(language, detail));
        }
        // A map without corridors, or with ones that the road graph cannot read, is told room by room.
        let corridors = self.corridors(Some(answer.map)).ok();
        let is_corridor = |area: AreaId| world.area_has_trait(area, "corridor");
        let mut sentences = Vec::new();
        let mut at = 0;
        while at < answer.stages.len() {
            let end = answer.stages[at..]
                .iter()
                .position(|s| !is_corridor(s.area))
                .map_or(answer.stages.len(), |n| at + n);
            if let (true, Some(system), true, Some(room_behind)) =
                (end > at, &corridors, at > 0, answer.stages.get(end))
            {
                let name = |area: AreaId| world.areas[&area].name.as_str();
                let (before, behind) = (name(answer.stages[at - 1].area), name(room_behind.area));
                if let Ok(way) = directions(system, before, None, behind, Variant::Single) {
                    sentences.extend(if language == Language::Russian { way.ru } else { way.en });
                    at = end;
                    continue;
                }
            }
            sentences.extend(way.say_passage(at, language, detail));
            at += 1;
        }
        Ok(sentences)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_no_rules_say_it_a_corridor_is_what_the_standard_text_says() {
        assert_eq!(corridor_shape(&Thresholds::default()), Shape::default());
    }
}
