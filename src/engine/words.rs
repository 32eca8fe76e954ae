//! A way in words: rooms and doors, and through corridors the instructions of the road graph (SPEC C4).

use crate::corridor::{CorridorSystem, Variant, directions};
use crate::language::Language;
use crate::language::russian;
use crate::map::{Entity, World};
use crate::units::AreaId;

use super::lexicon::named;
use super::route::RouteAnswer;
use super::{Engine, Error};

impl Engine {
    /// A way as sentences, one a stage. Where it runs through corridors from one entrance to another, the
    /// sentences are those of the corridor's road graph, which need no coordinates.
    ///
    /// # Errors
    /// There is no map.
    pub fn route_in_words(
        &self,
        answer: &RouteAnswer,
        language: Language,
    ) -> Result<Vec<String>, Error> {
        let world = self.world()?;
        let floor = self.floor(answer.map)?;
        // A map without corridors, or with ones that the road graph cannot read, is told room by room.
        let corridors = CorridorSystem::from_map(world, answer.map).ok();
        let is_corridor =
            |area: AreaId| world.types.area.has_trait(world.areas[&area].area_type, "corridor");
        let mut sentences = Vec::new();
        let mut at = 0;
        while at < answer.stages.len() {
            let stage = &answer.stages[at];
            let end = answer.stages[at..]
                .iter()
                .position(|s| !is_corridor(s.area))
                .map_or(answer.stages.len(), |n| at + n);
            if let (true, Some(system), true, Some(room_behind)) =
                (end > at, &corridors, at > 0, answer.stages.get(end))
            {
                let room_before = answer.stages[at - 1].area;
                let name = |area: AreaId| world.areas[&area].name.as_str();
                let way = directions(
                    system,
                    name(room_before),
                    None,
                    name(room_behind.area),
                    Variant::Single,
                );
                if let Ok(way) = way {
                    sentences.extend(if language == Language::Russian { way.ru } else { way.en });
                    at = end;
                    continue;
                }
            }
            if let (Some(doorway), Some(next)) = (stage.leaves_by, answer.stages.get(at + 1)) {
                let door = floor.doorways()[doorway].door.map(Entity::Door);
                sentences.push(leave(world, stage.area, door, next.area, language));
            }
            at += 1;
        }
        sentences.push(arrive(&answer.to, language));
        Ok(sentences)
    }
}

fn leave(
    world: &World,
    from: AreaId,
    door: Option<Entity>,
    into: AreaId,
    language: Language,
) -> String {
    let (from, into) = (named(world, Entity::Area(from)), named(world, Entity::Area(into)));
    let door = door.map(|d| named(world, d));
    match language {
        Language::Russian => {
            let through = door.map(|d| {
                let form = d.phrase().case(crate::language::Case::Accusative);
                format!(" через {form}")
            });
            format!(
                "Выезжайте {}{} {}.",
                russian::whence(from.phrase()),
                through.unwrap_or_default(),
                russian::whither(into.phrase())
            )
        }
        Language::English => {
            let through = door.map(|d| format!(" through {}", d.english())).unwrap_or_default();
            format!("Leave {}{through} into {}.", from.english(), into.english())
        }
    }
}

fn arrive(to: &str, language: Language) -> String {
    match language {
        Language::Russian => format!("Цель: {to}."),
        Language::English => format!("The goal: {to}."),
    }
}
