//! Ways through doors that are shut and no more: the robot opens them on its way, as it does when it is sent.
//!
//! Invariant: of a door that is told to be opened it is known that the robot gets to the place before it while it is
//! still shut, that its leaves strike nothing on their way, and that the robot comes out on its other side.

use std::collections::{BTreeMap, BTreeSet};

use crate::geometry::{DoorStates, FloorPlan, Leg, Method, NoWay, Target};
use crate::language::{Case, Language, enumerate};
use crate::map::{DoorKind, DoorState, DoorStatus, Entity, World};
use crate::semantics::lifts;
use crate::units::{AreaId, DoorId, Gather as _, MapId, Point, told};

use super::known::Known;
use super::lexicon::named;
use super::route::stages;
use super::{Error, Journey};

type Floors = BTreeMap<MapId, FloorPlan>;

/// A way and the doors to be opened on it, in their order.
type WayThroughDoors = (Vec<Leg>, Vec<DoorId>);

/// A shut door on a way: where the leg on which it lies begins, and the Areas on its two sides as they are passed.
struct Shut {
    door: DoorId,
    map: MapId,
    from: Point,
    sides: [AreaId; 2],
}

impl Known {
    /// The way that `find` finds once the doors are open that must be opened for it, and these doors in their order; none
    /// where opening doors does not help.
    ///
    /// # Errors
    /// There is no map.
    pub(super) fn by_opening(
        &self,
        find: impl Fn(&World, &Floors) -> Result<Vec<Leg>, Box<NoWay>>,
    ) -> Result<Option<WayThroughDoors>, Error> {
        let (world, floors) = (self.world(), self.floors()?);
        let mut shut = self.openable()?;
        while !shut.is_empty() {
            let Ok(legs) = find(world, &opened(world, floors, &shut)) else { return Ok(None) };
            let needed = shut_doors(floors, &legs, &shut).map(|shut| shut.door).collect();
            // What need not be opened stays shut.
            let only = opened(world, floors, &needed);
            let Ok(legs) = find(world, &only) else { return Ok(None) };
            let passed: Vec<Shut> = shut_doors(floors, &legs, &needed).collect();
            match cannot_open(world, called(world, floors), &passed) {
                Some(door) => shut.remove(&door),
                None => return Ok(Some((legs, passed.iter().map(|shut| shut.door).collect()))),
            };
        }
        Ok(None)
    }

    /// The doors between rooms that are shut and not locked; those of lifts open by themselves.
    fn openable(&self) -> Result<BTreeSet<DoorId>, Error> {
        let world = self.world();
        let of_lifts: BTreeSet<DoorId> = lifts(world, self.relations()?)
            .iter()
            .flat_map(|lift| lift.doors.iter().filter_map(|join| join.door))
            .gather();
        let floors = self.floors()?;
        let between_rooms =
            |door: DoorId| floors.values().any(|floor| floor.doorways_of(door).next().is_some());
        let doors = world.doors.values().filter(|door| {
            door.kind != DoorKind::Passage
                && !door.leaves.is_empty()
                && door.state.status == DoorStatus::Closed
                && !of_lifts.contains(&door.id)
                && between_rooms(door.id)
        });
        Ok(doors.map(|door| door.id).collect())
    }
}

/// The floors with some doors open.
fn opened(world: &World, floors: &Floors, doors: &BTreeSet<DoorId>) -> Floors {
    let open = |floor: &FloorPlan| {
        let own = doors.iter().filter(|door| floor.doorways_of(**door).next().is_some());
        let states: DoorStates = own.map(|door| (*door, DoorState::OPEN)).gather();
        if states.is_empty() { floor.clone() } else { floor.with_doors(world, &states) }
    };
    floors.iter().map(|(map, floor)| (*map, open(floor))).gather()
}

/// The floors as a way over them meets them: lifts open their doors where they are called, and the cabin in which a leg
/// begins is shut otherwise.
fn called(world: &World, floors: &Floors) -> Floors {
    floors.iter().map(|(map, floor)| (*map, floor.with_lifts_open(world).into_owned())).gather()
}

/// Those of some doors that a way passes, in its order.
fn shut_doors<'a>(
    floors: &'a Floors,
    legs: &'a [Leg],
    doors: &'a BTreeSet<DoorId>,
) -> impl Iterator<Item = Shut> + 'a {
    legs.iter().flat_map(move |leg| {
        let passed = stages(&leg.passed);
        let from = leg.route.points.first().copied().unwrap_or_else(Point::origin);
        let crossings: Vec<_> =
            passed.windows(2).map(|two| (two[0].clone(), two[1].area)).collect();
        crossings.into_iter().filter_map(move |(stage, into)| {
            let doorway = floors.get(&leg.map)?.doorways().get(stage.leaves_by?)?;
            let door = doorway.door.filter(|door| doors.contains(door))?;
            Some(Shut { door, map: leg.map, from, sides: [stage.area, into] })
        })
    })
}

/// The first of the doors on a way that the robot cannot open when it has come to it.
fn cannot_open(world: &World, mut floors: Floors, doors: &[Shut]) -> Option<DoorId> {
    for Shut { door, map, from, sides: [near, far] } in doors {
        let floor = floors.get_mut(map)?;
        let before = |area| Target::Door { door: *door, area };
        let way = floor.route(world, *from, before(*near), Method::Shortest).ok();
        let stand = way.and_then(|way| way.points.last().copied());
        let Some(stand) = stand.filter(|at| floor.opens_from(world, *door, *at)) else {
            return Some(*door);
        };
        let state = DoorStates::from([(*door, DoorState::OPEN)]);
        *floor = floor.with_doors(world, &state);
        let sides = Some(&[*near, *far][..]);
        if floor.route_within(world, stand, before(*far), Method::Shortest, sides).is_err() {
            return Some(*door);
        }
    }
    None
}

impl Journey {
    /// «По пути нужно открыть Дверь-ВZ (закрыто не на замок).»; empty where nothing is to be opened.
    #[must_use]
    pub fn opens_in_words(&self, world: &World, language: Language) -> String {
        if self.opens.is_empty() {
            return String::new();
        }
        let name =
            |door: &DoorId| named(world, Entity::Door(*door)).form(Case::Accusative, language);
        let doors = enumerate(&self.opens.iter().map(name).collect::<Vec<_>>(), language);
        told!(language, "opens-on-the-way", doors)
    }
}
