//! Ways over several floors, in legs and rides, and what would open a way where there is none.

use std::collections::BTreeMap;

use crate::geometry::{FloorPlan, Leg, Method, Opening, Remedy, Ride, Target, across};
use crate::language::Language;
use crate::language::question::{Crossing, RoomPath, Thing};
use crate::language::report::{Detail, Named};
use crate::map::{Entity, Extent, Forms, World, Zone, ZoneKind};
use crate::semantics::Thresholds;
use crate::units::{AreaId, Deg, DoorId, Gather as _, MapId, Point, ZoneId, told};

use super::advice::Advice;
use super::known::Known;
use super::lexicon::named;
use super::located::{End, Located};
use super::memory::ROBOT;
use super::route::RouteAnswer;
use super::{Error, State};

/// A way from one place to another, over as many maps as it takes.
#[derive(Debug, Clone)]
pub struct Journey {
    /// One for each map passed; a single one without a route when there is no way.
    pub legs: Vec<RouteAnswer>,
    /// The rides between them, one fewer.
    pub rides: Vec<Ride>,
    /// Doors that are shut, not locked, and to be opened on the way, in its order; none where there is a way without.
    pub opens: Vec<DoorId>,
    /// The smallest change that would open a way where there is none.
    pub advice: Option<Advice>,
}

impl State {
    /// A way between two places given by name or as `X,Y`, in the world as it is believed to be now; lifts are ridden
    /// where they lie on different maps, and doors opened that are only shut.
    ///
    /// # Errors
    /// A name that means nothing. No way at all is an answer, not an error.
    pub fn journey(&self, from: &str, to: &str, method: Method) -> Result<Journey, Error> {
        let (start, goal) = (self.locate_name(from)?, self.locate_name(to)?);
        self.around()?.journey_between((from, start), (to, goal), method)
    }

    /// The robot's own way to a place given by name or as `X,Y`, from where it is now.
    ///
    /// # Errors
    /// As [`State::journey`]; or the map does not say where the robot is.
    pub(crate) fn journey_of_robot(&self, to: &str) -> Result<Journey, Error> {
        let (map, pose) = self.robot()?;
        let (start, goal) = (self.locate_point(map, pose.at)?, self.locate_name(to)?);
        let mut journey =
            self.around()?.journey_between(("", start), (to, goal), Method::Shortest)?;
        if let [only] = &mut journey.legs[..] {
            ROBOT.clone_into(&mut only.from);
        }
        Ok(journey)
    }

    /// A journey as sentences: those of its legs, and of the rides between them. `heading` is how one
    /// stands at its beginning, where that is known.
    ///
    /// # Errors
    /// There is no map.
    pub fn journey_in_words(
        &self,
        journey: &Journey,
        heading: Option<Deg>,
        language: Language,
        detail: Detail,
    ) -> Result<Vec<String>, Error> {
        self.around()?.journey_in_words(journey, heading, language, detail)
    }

    /// «Поднимитесь на лифте «Лифт-1» на Второй этаж.»
    ///
    /// # Errors
    /// There is no map.
    pub fn ride_in_words(&self, ride: &Ride, language: Language) -> Result<String, Error> {
        self.around()?.ride_in_words(ride, language)
    }
}

impl Known {
    /// A way between two places that were found, with what they are called.
    ///
    /// # Errors
    /// There is no map. No way at all is an answer, not an error.
    pub(super) fn journey_between(
        &self,
        (from, start): (&str, Located),
        (to, goal): (&str, Located),
        method: Method,
    ) -> Result<Journey, Error> {
        let world = self.world();
        let floors = self.floors()?;
        let ends = ((start.map, start.at), (goal.map, goal.target));
        // A door is reached on whichever side is nearer.
        let sides = match goal.target {
            Target::Door { door, .. } => world.door_areas(door),
            _ => Vec::new(),
        };
        let others = sides.into_iter().filter_map(|area| match goal.target {
            Target::Door { door, area: own } if own != area => Some(Target::Door { door, area }),
            _ => None,
        });
        let others: Vec<Target> = others.collect();
        let length = |legs: &Vec<Leg>| legs.iter().map(|leg| leg.route.length).sum::<f64>();
        let find = |world: &World, floors: &BTreeMap<MapId, FloorPlan>| {
            let first = across(world, floors, ends.0, ends.1, method);
            others.iter().fold(first, |best, target| {
                let side = across(world, floors, ends.0, (goal.map, *target), method);
                match (&best, &side) {
                    (Ok(a), Ok(b)) if length(b) < length(a) => side,
                    (Err(_), Ok(_)) => side,
                    _ => best,
                }
            })
        };
        let (found, opens) = match find(world, floors) {
            Ok(found) => (Ok(found), Vec::new()),
            Err(no) => match self.by_opening(find)? {
                Some((found, opens)) => (Ok(found), opens),
                None => (Err(no), Vec::new()),
            },
        };
        match found {
            Ok(found) => {
                let rides: Vec<Ride> = found.iter().filter_map(|leg| leg.ride.clone()).collect();
                let lift = |k: usize| rides.get(k).map(|r| world.domain.lifts[r.lift].0.as_str());
                let leg = |(k, leg): (usize, Leg)| {
                    let from = k.checked_sub(1).and_then(lift).unwrap_or(from);
                    let to = lift(k).map_or((to, goal.end), |lift| (lift, End::Lift));
                    RouteAnswer::new(leg.map, from, to, Ok((leg.passed, leg.route)))
                };
                let legs = found.into_iter().enumerate().map(leg).collect();
                Ok(Journey { legs, rides, opens, advice: None })
            }
            Err(no) => {
                let advice = floors.get(&no.map).and_then(|floor| {
                    let alone = start.map == goal.map;
                    let floor = &*floor.with_lifts_open(world);
                    let near = self
                        .relations()
                        .map_or_else(|_| Thresholds::default(), |r| *r.thresholds());
                    let remedy =
                        floor.remedy(world, no.from, no.target, &no.why, near.push_farthest)?;
                    let opens = || self.opens(&remedy, no.map, ends).is_some_and(|opens| opens);
                    (alone || opens())
                        .then(|| Advice::of(world, floor, || self.relations().ok(), remedy))
                });
                let leg = RouteAnswer::new(no.map, from, (to, goal.end), Err(no.why));
                Ok(Journey { legs: vec![leg], rides: vec![], opens, advice })
            }
        }
    }

    /// The rooms and openings that a journey leads through, and the lifts that it rides; none where there is no way.
    ///
    /// # Errors
    /// There is no map.
    pub(super) fn rooms_of(&self, journey: &Journey) -> Result<Option<RoomPath>, Error> {
        let mut path: Option<RoomPath> = None;
        for (k, leg) in journey.legs.iter().enumerate() {
            let Ok(route) = &leg.route else { return Ok(None) };
            let floor = self.floor(leg.map)?;
            let begins = || Some(floor.locate(*route.points.first()?)?.0);
            let Some(start) = leg.stages.first().map(|stage| stage.area).or_else(begins) else {
                return Ok(None);
            };
            let path = path.get_or_insert(RoomPath { start, crossings: Vec::new() });
            for two in leg.stages.windows(2) {
                let Some(doorway) = two[0].leaves_by.map(|d| &floor.doorways()[d]) else {
                    continue;
                };
                let by = match doorway.door {
                    Some(door) => Thing::Entity(Entity::Door(door)),
                    None => Thing::Opening(doorway.id),
                };
                path.crossings.push(Crossing { by, into: two[1].area });
            }
            if let Some(ride) = journey.rides.get(k) {
                let by = Thing::Entity(Entity::Area(ride.from));
                path.crossings.push(Crossing { by, into: ride.to });
            }
        }
        Ok(path)
    }

    /// The same with rooms that are not entered and openings that are not passed; the room that is wanted is entered.
    ///
    /// # Errors
    /// There is no map.
    pub(super) fn without(&self, avoided: &[Thing], wanted: Option<AreaId>) -> Result<Self, Error> {
        let mut world = self.world().clone();
        let mut rooms: Vec<AreaId> = Vec::new();
        let mut extents: Vec<Extent> = Vec::new();
        for thing in avoided {
            match *thing {
                Thing::Entity(Entity::Area(area)) if Some(area) != wanted => rooms.push(area),
                // A door that is shut for now may be opened; who keeps out of its doorway does not pass.
                Thing::Entity(Entity::Door(door)) => {
                    let floors = self.floors()?.values();
                    let own = floors.flat_map(|floor| floor.doorways_of(door));
                    extents.extend(own.map(across_doorway));
                }
                Thing::Opening(id) => {
                    let floors = self.floors()?.values();
                    let ways = floors.flat_map(|floor| floor.doorways().iter());
                    extents.extend(ways.filter(|way| way.id == id).map(|way| across_doorway(way)));
                }
                _ => {}
            }
        }
        if !rooms.is_empty() {
            extents.push(Extent::Areas(rooms));
        }
        let first = world.zones.keys().map(|id| id.0).max().unwrap_or(0) + 1;
        for (number, extent) in (first..).zip(extents) {
            let id = ZoneId(number);
            let zone = Zone {
                id,
                key: String::new(),
                name: String::new(),
                name_en: String::new(),
                kind: ZoneKind::KeepOut,
                extent,
                reason: String::new(),
                reason_en: String::new(),
                from: None,
                until: None,
                forms: Forms::new(),
            };
            world.zones.insert(id, zone);
        }
        let is_wanted = |zone: &Zone| zone.id.0 >= first || self.is_in_force(zone);
        let floors =
            self.floors()?.iter().map(|(map, floor)| (*map, floor.with_zones(&world, is_wanted)));
        let floors: BTreeMap<MapId, FloorPlan> = floors.gather();
        Ok(self.driven_otherwise(world, floors))
    }

    /// Whether a change that opens one leg opens the whole way, which other things may bar as well.
    fn opens(
        &self,
        remedy: &Remedy,
        map: MapId,
        ends: ((MapId, Point), (MapId, Target)),
    ) -> Option<bool> {
        let mut world = self.world().clone();
        let mut floors = self.floors().ok()?.clone();
        let floor = floors.get_mut(&map)?;
        *floor = floor.remedied(&mut world, remedy);
        Some(across(&world, &floors, ends.0, ends.1, Method::Shortest).is_ok())
    }

    /// A journey as sentences: those of its legs, and of the rides between them. `heading` is how one stands at its
    /// beginning, where that is known.
    ///
    /// # Errors
    /// There is no map.
    pub(super) fn journey_in_words(
        &self,
        journey: &Journey,
        heading: Option<Deg>,
        language: Language,
        detail: Detail,
    ) -> Result<Vec<String>, Error> {
        let world = self.world();
        let mut sentences = Vec::new();
        for (k, leg) in journey.legs.iter().enumerate() {
            let heading = heading.filter(|_| k == 0);
            let told = self.route_in_words(leg, heading, language, detail)?;
            // Who stands before the lift already need not be told so, nor who has come where the ride ends.
            let stays = leg.end == End::Lift && leg.stages.len() < 2
                || k > 0 && self.directions(leg, None)?.is_some_and(|way| way.is_there());
            sentences.extend(told.into_iter().filter(|_| !stays));
            if let Some(ride) = journey.rides.get(k) {
                sentences.push(self.ride_in_words(ride, language)?);
            }
        }
        sentences
            .extend(Some(journey.opens_in_words(world, language)).filter(|told| !told.is_empty()));
        Ok(sentences)
    }

    fn ride_in_words(&self, ride: &Ride, language: Language) -> Result<String, Error> {
        let (world, level) = (self.world(), self.relations()?.thresholds().level_equal);
        let lift = Named::plain(&world.domain.lifts[ride.lift].0);
        let floor = world.placement(ride.to).map(|(map, _)| named(world, Entity::Map(map)));
        let whither = floor.map(|floor| floor.whither_storey(language)).unwrap_or_default();
        let way = if ride.rise > level {
            "up"
        } else if ride.rise < -level {
            "down"
        } else {
            "level"
        };
        let lift = language.pick(lift.phrase().name(), lift.english_name());
        Ok(told!(language, "take-the-lift", way, lift, to = whither))
    }
}

/// The floor within a doorway, from wall to wall.
fn across_doorway(doorway: &Opening) -> Extent {
    let (a, b) = doorway.line();
    let aside = doorway.out() * (doorway.gap / 2.0).max(1.0);
    let corners = vec![a - aside, b - aside, b + aside, a + aside];
    Extent::Polygon { map: doorway.map, corners }
}
