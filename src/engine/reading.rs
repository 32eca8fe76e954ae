//! A position report read back: from a sentence to the region of poses of which it is true (SPEC T5).

use std::collections::BTreeSet;

use crate::geometry::Bounds;
use crate::language::FormIndex;
use crate::language::names::hints;
use crate::language::report::read::{
    SaidFacing, SaidMark, SaidOpening, SaidPosition, SaidSpot, read,
};
use crate::language::report::{Beside, OpeningKind};
use crate::map::{Entity, World};
use crate::semantics::{Claim, Faced, Relations, Way, claim_bounds, claim_holds, faced};
use crate::units::{AreaId, Bilingual, Deg, MapId, OpeningId, Point, Pose, ReplicaId, said, word};

use super::error::{both, in_both};
use super::lexicon::named;
use super::{Error, RequestError, State};

/// Where a report says that the robot is: the poses of which it is true.
///
/// It may be wider than the poses that would be reported so, never narrower: who stands in the doorway is also at the
/// door. Of a corner or a wall told by a thing, the thing is not measured.
#[derive(Debug, Clone)]
pub struct Region {
    pub map: MapId,
    /// The Area; in a doorway, one of the two.
    pub area: AreaId,
    pub claim: Claim,
    /// None: any heading.
    facing: Option<SaidFacing<Entity>>,
    /// A box that holds all of it, on the Map.
    pub bounds: Bounds,
}

impl State {
    /// Reads a position report, in Russian or English, and finds the region that it tells. Nothing is guessed: a text
    /// that fits two regions is refused.
    ///
    /// # Errors
    /// It is no report; it tells of what the map does not have, or of several regions.
    pub fn read_position(&self, text: &str) -> Result<Region, Error> {
        let world = self.world()?;
        let said = read(text, &index_of(world)).map_err(|unread| {
            let shown = |text: &str| text.chars().take(80).collect::<String>();
            RequestError::NoReport { text: shown(text), word: shown(&text[unread.at]) }
        })?;
        if said.is_off_the_map() {
            let reason = said!("it-is-said-that-the");
            return Err(RequestError::NoSuchPlace { reason }.into());
        }
        let mut regions = regions(self.relations()?, &said)?;
        match (regions.pop(), regions.is_empty()) {
            (Some(only), true) => Ok(only),
            (None, _) => {
                let reason = word!("place-not-found").into();
                Err(RequestError::NoSuchPlace { reason }.into())
            }
            (Some(last), false) => {
                regions.push(last);
                let both = |region: &Region| {
                    let area = both(world, Entity::Area(region.area));
                    let map = in_both(world, &world.maps[&region.map].name);
                    Bilingual::both(|lang| format!("{} ({})", area.say(lang), map.say(lang)))
                };
                let candidates = Bilingual::list(&regions.iter().map(both).collect::<Vec<_>>());
                let name = text.chars().take(80).collect();
                Err(RequestError::AmbiguousName { name, candidates }.into())
            }
        }
    }

    /// Whether a report is true of a pose.
    ///
    /// # Errors
    /// There is no map.
    pub fn region_contains(&self, region: &Region, pose: Pose) -> Result<bool, Error> {
        let (world, relations) = (self.world()?, self.relations()?);
        Ok(!region.held_at(world, relations, &[pose.at]).is_empty()
            && region.has_heading(world, relations, &[pose]))
    }

    /// The points of a square grid over the region where some heading makes the report true, if any does; `step` in cm.
    /// Headings are tried every 15°.
    ///
    /// # Errors
    /// There is no map.
    pub fn region_points(&self, region: &Region, step: f64) -> Result<Vec<Point>, Error> {
        let (world, relations) = (self.world()?, self.relations()?);
        let Bounds { min, max } = region.bounds;
        let count = |length: f64| (length / step).floor().clamp(0.0, 2000.0) as u32;
        let mut points = Vec::new();
        for row in 0..=count(max.y - min.y) {
            let of_row = (0..=count(max.x - min.x)).map(|column| {
                min + crate::units::Vector::new(f64::from(column), f64::from(row)) * step
            });
            let of_row: Vec<Point> = of_row.collect();
            for at in region.held_at(world, relations, &of_row).into_iter().map(|n| of_row[n]) {
                let turned = |k: u32| Pose { at, heading: Deg::of(f64::from(k) * 15.0) };
                let turned: Vec<Pose> = (0..24).map(turned).collect();
                if region.has_heading(world, relations, &turned) {
                    points.push(at);
                }
            }
        }
        Ok(points)
    }
}

impl Region {
    /// The places of those of some points at which the claim holds.
    fn held_at(&self, world: &World, relations: &Relations, at: &[Point]) -> BTreeSet<usize> {
        claim_holds(world, relations, (self.map, self.area), &self.claim, at)
    }

    /// Whether in some of the poses the robot faces what is said.
    fn has_heading(&self, world: &World, relations: &Relations, poses: &[Pose]) -> bool {
        let Some(facing) = &self.facing else { return true };
        let is_so = |faced: Faced| match (facing, faced) {
            (SaidFacing::Door(said), Faced::Door(way)) => is_meant(said, way),
            (SaidFacing::Object(said), Faced::Object(thing)) => {
                said.contains(&Entity::Replica(thing))
            }
            (SaidFacing::Leaf(said), Faced::Leaf(way)) => is_meant(said, way),
            (SaidFacing::Wall, Faced::Wall { .. }) | (SaidFacing::Inward, Faced::Inward) => true,
            (SaidFacing::OwnWall, Faced::Wall { own }) => own,
            (SaidFacing::OtherWall, Faced::Wall { own }) => !own,
            _ => false,
        };
        faced(world, relations, self.map, poses).into_iter().any(is_so)
    }
}

/// Whether a doorway of the map is the one that was said.
fn is_meant(said: &SaidOpening<Entity>, way: Way) -> bool {
    let is_area = |names: &[Entity], area: AreaId| names.contains(&Entity::Area(area));
    let opening = if way.is_passage { OpeningKind::Passage } else { OpeningKind::Door };
    let to = match (&said.to, way.to) {
        (Some(names), Some(area)) => is_area(names, area),
        (None, None) => true,
        _ => false,
    };
    let by_name = said
        .name
        .as_ref()
        .is_none_or(|names| way.door.is_some_and(|door| names.contains(&Entity::Door(door))));
    is_area(&said.from, way.from)
        && to
        && by_name
        && said.opening.is_none_or(|said| said == opening)
}

/// The regions that a report may mean, one for each Area that it may speak of.
pub(super) fn regions(
    relations: &Relations,
    said: &SaidPosition<Entity>,
) -> Result<Vec<Region>, Error> {
    let areas = match (&said.spot, said.area.is_empty()) {
        (Some(SaidSpot::InDoorway(door)), true) => &door.from,
        _ => &said.area,
    };
    let mut found = Vec::new();
    for area in areas {
        let Entity::Area(area) = *area else { continue };
        let Some((map, bounds)) = claim_bounds(relations, area) else { continue };
        let on_map = |names: &Vec<Entity>| names.contains(&Entity::Map(map));
        let is_marked = said.mark.as_ref().is_none_or(|mark| bears(relations, area, mark));
        if !said.within.iter().all(on_map) || !is_marked {
            continue;
        }
        for claim in claims(relations, area, said.spot.as_ref())? {
            let facing = said.facing.clone();
            // A doorway between namesakes is one place, from whichever side it is told.
            let told = |other: &Region| {
                other.claim == claim && matches!(claim, Claim::InDoorway(_)) && other.map == map
            };
            if found.iter().any(told) {
                continue;
            }
            found.push(Region { map, area, claim, facing, bounds });
        }
    }
    Ok(found)
}

/// Whether an Area has what a report says to tell it from its namesakes.
fn bears(relations: &Relations, area: AreaId, mark: &SaidMark<Entity>) -> bool {
    let mut openings = relations.openings().of_area(area);
    match mark {
        SaidMark::Adjoining(names) => openings.any(|o| {
            let others = o.all_areas().into_iter().filter(|other| *other != area);
            others.into_iter().any(|other| names.contains(&Entity::Area(other)))
        }),
        SaidMark::With(names) => {
            let has = |name: &Entity| match name {
                Entity::Replica(id) => relations.area_of(*id) == Some(area),
                _ => false,
            };
            names.iter().any(has)
                || openings.any(|o| o.door.is_some_and(|d| names.contains(&Entity::Door(d))))
        }
    }
}

/// What a spot claims of an Area: nothing where the map has no such doorway or thing there.
fn claims(
    relations: &Relations,
    area: AreaId,
    spot: Option<&SaidSpot<Entity>>,
) -> Result<Vec<Claim>, Error> {
    let ways = |door: &SaidOpening<Entity>| -> Vec<OpeningId> {
        let openings = relations.openings().of_area(area);
        openings.filter(|o| is_meant(door, Way::through(o, area))).map(|o| o.id).collect()
    };
    let claim = match spot {
        None => Claim::InArea,
        Some(SaidSpot::InDoorway(door)) => Claim::InDoorway(ways(door)),
        Some(SaidSpot::AtDoor(door)) => Claim::AtDoor(ways(door)),
        Some(SaidSpot::Object(beside @ (Beside::NextTo | Beside::On), names)) => {
            let is_here = |id: &ReplicaId| relations.stands_on_floor(*id, area);
            let things = names.iter().filter_map(|name| match name {
                Entity::Replica(id) => Some(*id).filter(is_here),
                _ => None,
            });
            let claim = if *beside == Beside::On { Claim::On } else { Claim::NextTo };
            return Ok(things.map(claim).collect());
        }
        Some(SaidSpot::Object(..)) => {
            let reason = word!("sides-unknown").into();
            return Err(RequestError::NoSuchPlace { reason }.into());
        }
        Some(SaidSpot::InCorner(_)) => Claim::InCorner,
        Some(SaidSpot::AlongWall(_)) => Claim::AlongWall,
        Some(SaidSpot::InMiddle) => Claim::InMiddle,
    };
    let is_empty =
        matches!(&claim, Claim::InDoorway(ways) | Claim::AtDoor(ways) if ways.is_empty());
    Ok(if is_empty { Vec::new() } else { vec![claim] })
}

/// The names that reports are made of: Maps, Areas, doors and things by their own names, as reports say them.
fn index_of(world: &World) -> FormIndex<Entity> {
    let mut index = FormIndex::default();
    let mut entities: Vec<Entity> = world.names().map(|(entity, _)| entity).collect();
    entities.dedup();
    for entity in
        entities.into_iter().filter(|entity| !matches!(entity, Entity::Place(_) | Entity::Zone(_)))
    {
        index.insert_name(world.name(entity), &hints(world, entity), entity);
        index.insert_english(named(world, entity).english_name(), entity);
    }
    index
}
