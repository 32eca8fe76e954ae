//! What the names in directives mean on a floor: whence and whither each drives.

use std::collections::HashMap;

use crate::geometry::{FloorPlan, Target};
use crate::map::World;
use crate::semantics::planning::{PlaceSource, PlanPlace};
use crate::semantics::{Join, Relations, predicate};
use crate::units::{AreaId, Point, name_key};

use super::belief::Spot;
use super::directive::{Directive, Effect, Primitive};
use super::mission::before_passage;

/// Where the robot may stand.
#[derive(Debug, Clone, PartialEq, Eq, Hash)]
pub(super) enum At {
    Place(String),
    Door(String, AreaId),
}

/// A name that nobody knows.
#[derive(Debug)]
pub(super) struct Unknown(pub(super) String);

/// The places, doors and rooms that directives speak of, by the keys of their names.
#[derive(Debug)]
pub(super) struct Atlas {
    areas: HashMap<String, AreaId>,
    places: HashMap<String, (AreaId, PlaceSource)>,
    points: HashMap<String, Point>,
    pub(super) places_named: Vec<PlanPlace>,
    pub(super) joins: Vec<Join>,
}

impl Atlas {
    pub(super) fn of(world: &World, relations: &Relations, places_named: Vec<PlanPlace>) -> Self {
        let symbol = |id: AreaId| (name_key(relations.symbols().area(id)), id);
        Self {
            areas: world.areas.keys().copied().map(symbol).collect(),
            places: places_named.iter().map(|p| (name_key(&p.name), (p.area, p.source))).collect(),
            points: HashMap::new(),
            places_named,
            joins: relations.joins(),
        }
    }

    /// Points that have names for the time of a mission are places as well.
    pub(super) fn learn(&mut self, spots: &[Spot]) {
        for spot in spots {
            let key = name_key(&spot.name);
            let place =
                PlanPlace { name: spot.name.clone(), area: spot.area, source: PlaceSource::Robot };
            self.places.insert(key.clone(), (place.area, place.source));
            self.points.insert(key, spot.pose.at);
            self.places_named.push(place);
        }
    }

    pub(super) fn area_named(&self, name: &str) -> Option<AreaId> {
        self.areas.get(&name_key(name)).copied()
    }

    pub(super) fn area(&self, name: &str) -> Result<AreaId, Unknown> {
        self.area_named(name).ok_or_else(|| Unknown(name.to_owned()))
    }

    /// Where the robot may stand in an Area, each with its name.
    pub(super) fn spots_in(&self, area: AreaId) -> impl Iterator<Item = (&str, At)> {
        let places = self.places_named.iter().filter(move |place| place.area == area);
        let places = places.map(|place| (&*place.name, At::Place(name_key(&place.name))));
        let joins = self.joins.iter().filter(move |join| join.from == area);
        let doors =
            joins.map(move |join| (&*join.opening, At::Door(name_key(&join.opening), area)));
        places.chain(doors)
    }

    /// The passages and doors of a name.
    pub(super) fn joins_named<'a>(&'a self, key: &'a str) -> impl Iterator<Item = &'a Join> {
        self.joins.iter().filter(move |join| name_key(&join.opening) == key)
    }

    pub(super) fn area_of(&self, spot: &At) -> Result<AreaId, Unknown> {
        match spot {
            At::Door(_, area) => Ok(*area),
            At::Place(name) => {
                let known = self.places.get(name).map(|(area, _)| *area);
                known.ok_or_else(|| Unknown(name.clone()))
            }
        }
    }

    /// Where that is on a floor; none for a door in a room to which it does not lead.
    pub(super) fn target_of(
        &self,
        world: &World,
        floor: &FloorPlan,
        spot: &At,
    ) -> Result<Option<Target>, Unknown> {
        let unknown = |name: &str| Unknown(name.to_owned());
        let area = self.area_of(spot)?;
        Ok(Some(match spot {
            At::Place(name) => match self.places[name].1 {
                PlaceSource::Named(id) => Target::Place(id),
                PlaceSource::Before(id) => Target::Replica(id),
                PlaceSource::Robot => match self.points.get(name) {
                    Some(at) => Target::Point(*at),
                    None => return Err(unknown(name)),
                },
            },
            At::Door(name, _) => {
                let mut named = self.joins_named(name).peekable();
                named.peek().ok_or_else(|| unknown(name))?;
                // A rule may speak of the robot at a door in a room that the door does not lead to.
                let Some(join) = named.find(|join| join.from == area) else { return Ok(None) };
                match join.door {
                    Some(door) => Target::Door { door, area },
                    None => {
                        before_passage(world, floor, join, area).ok_or_else(|| unknown(name))?
                    }
                }
            }
        }))
    }

    /// Whence and whither a primitive drives that does.
    pub(super) fn drive_of(
        &self,
        directive: &Directive,
        primitive: &Primitive,
    ) -> Result<(At, At), Unknown> {
        let from = self.begins(directive)?;
        let to = match primitive {
            Primitive::GoToPlace(place) => At::Place(name_key(place)),
            Primitive::Cross { door, into } => At::Door(name_key(door), self.area(into)?),
            Primitive::GoToDoor(door) => At::Door(name_key(door), self.area_of(&from)?),
            _ => return Err(Unknown(directive.to_string())),
        };
        Ok((from, to))
    }

    /// Where the robot stands before a directive, by what that needs.
    fn begins(&self, directive: &Directive) -> Result<At, Unknown> {
        let needed = |predicate: &str| -> Option<&Effect> {
            let key = name_key(predicate);
            directive.needs.iter().find(|need| need.predicate == key)
        };
        if let Some(Effect { args, .. }) = needed(predicate::ROBOT_AT_PLACE)
            && let [place] = args.as_slice()
        {
            let key = name_key(place);
            let is_known = self.places.contains_key(&key);
            return if is_known { Ok(At::Place(key)) } else { Err(Unknown(place.clone())) };
        }
        if let (Some(door), Some(room)) =
            (needed(predicate::ROBOT_AT_DOOR), needed(predicate::ROBOT_IN))
            && let ([door], [room, ..]) = (door.args.as_slice(), room.args.as_slice())
        {
            return Ok(At::Door(name_key(door), self.area(room)?));
        }
        // The rule asks for no place to begin from.
        Err(Unknown(directive.to_string()))
    }
}
