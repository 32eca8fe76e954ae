//! A plan tried out before its first motion, in the world as it is believed to be.
//!
//! The rules know rooms and doors, and nothing of the floor: that a cupboard stands before the door, that a leaf strikes a
//! chair, that the table has no room left. What the mission would find out on its way is found out here, by the same code,
//! in a simulated world that is the belief itself; so that a plan that is begun fails for what was not known alone.
//!
//! **Invariant**: neither the mission nor the vehicle is changed by it.

use crate::map::{DoorState, DoorStatus, Entity};
use crate::units::{AreaId, ReplicaId, Stop};

use super::Mission;
use crate::belief::Belief;
use crate::directive::{Directive, Primitive};
use crate::event::{Event, Surprise};
use crate::reins::Reins;
use crate::simulator::Simulator;
use crate::vehicle::{Refusal, Unfinished};

/// What is to be held against a plan that the rules allow.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) enum Known {
    /// From within an Area no way leads to a place or through a door.
    NoWay(AreaId, String),
    /// From within an Area a door could not be opened again.
    NoReturn(AreaId, String),
    /// A thing has no place on another.
    NoRoom(Box<(String, String)>),
    /// What was to be pushed aside is not to be.
    Stays(ReplicaId),
    /// Nothing that the rules could be told.
    Nothing,
}

/// Tries directives in order; those from the first look for a thing on depend on what is seen, and are not tried.
///
/// # Errors
/// Why one of them cannot be carried out, and what the next plan must know of it.
pub(super) fn rehearse(
    mission: &Mission<'_>,
    directives: &[&Directive],
    stop: &Stop,
) -> Result<(), (Known, Surprise)> {
    let seeks = |d: &&&Directive| {
        d.primitives().iter().any(|primitive| matches!(primitive, Primitive::Seek(_)))
    };
    let known = directives.iter().position(|d| seeks(&d)).unwrap_or(directives.len());
    if known == 0 {
        return Ok(());
    }
    let mut trial = mission.clone();
    let belief = &trial.belief;
    let at = (belief.map, belief.pose);
    let mut vehicle = Simulator::new(belief.world.clone(), at.0, at.1)
        .through_walls(mission.rules.step_reach())
        .laden(belief.held.clone(), &belief.handed_over, &belief.aboard);
    let nobody = &mut |_: &Event<'_>| {};
    let mut reins =
        Reins::new(&mut vehicle, at, stop, nobody).expect("the robot is put where it is believed");
    let tried = trial.carry_out(&directives[..known], &mut reins);
    // One that was told to stop is not asked what it found.
    let Err((_, Unfinished::Met(surprise))) = tried else { return Ok(()) };
    let area = trial.belief.area;
    let name = |door| trial.belief.world.name(Entity::Door(door)).to_owned();
    let known = match &surprise {
        Surprise::NoWay { to, .. } => Known::NoWay(area, to.clone()),
        Surprise::Refused { refusal: Refusal::NoRoom(support), .. } => match &trial.belief.held {
            Some(held) if held.id != *support => {
                let on = trial.belief.world.name(Entity::Replica(*support)).to_owned();
                Known::NoRoom(Box::new((held.name.clone(), on)))
            }
            _ => Known::Nothing,
        },
        Surprise::Refused { refusal: Refusal::Stays(thing), .. } => Known::Stays(*thing),
        Surprise::NoReturn { door, area, .. } => Known::NoReturn(*area, name(*door)),
        Surprise::Refused { refusal: Refusal::DoorJammed { door, .. }, .. } => {
            let state = trial.belief.world.doors.get(door).map(|d| d.state.status);
            // What stands open and cannot be shut from here may be from its other side, and is a way all the same.
            match state {
                Some(DoorStatus::Open) => Known::NoReturn(area, name(*door)),
                _ => Known::NoWay(area, name(*door)),
            }
        }
        _ => Known::Nothing,
    };
    Err((known, surprise))
}

/// Tries a plan for a scenario: the first directive that the floor refuses, and why. What fails for another reason the
/// scenario may know better, and it is taken to be done.
pub(crate) fn refused_on_floor(
    mission: &Mission<'_>,
    directives: &[Directive],
    stop: &Stop,
) -> Option<(usize, Surprise)> {
    let mut trial = mission.clone();
    let put_down = |belief: &Belief| {
        let vehicle = Simulator::new(belief.world.clone(), belief.map, belief.pose);
        vehicle.laden(belief.held.clone(), &belief.handed_over, &belief.aboard)
    };
    let mut vehicle = put_down(&trial.belief);
    for (at, directive) in directives.iter().enumerate() {
        let (here, nobody) = ((trial.belief.map, trial.belief.pose), &mut |_: &Event<'_>| {});
        let mut reins = Reins::new(&mut vehicle, here, stop, nobody).ok()?;
        let surprise = match trial.carry_out(&[directive], &mut reins) {
            Ok(()) => continue,
            Err((_, Unfinished::Met(surprise))) => surprise,
            Err(_) => return None,
        };
        match surprise {
            Surprise::NoWay { .. }
            | Surprise::NoReturn { .. }
            | Surprise::Refused { refusal: Refusal::DoorJammed { .. }, .. } => {
                return Some((at, trial.with_remedy(surprise)));
            }
            _ => {}
        }
        for primitive in directive.primitives() {
            match primitive {
                // Who unlocked it is not known.
                Primitive::SetDoor { door, status } => {
                    let state = DoorState { status, ..DoorState::CLOSED };
                    let state = if status == DoorStatus::Open { DoorState::OPEN } else { state };
                    trial.belief.set_door(trial.door(&door).ok()?, state);
                    vehicle = put_down(&trial.belief);
                }
                // From here on it is not known where the robot is.
                Primitive::GoToPlace(_)
                | Primitive::GoToDoor(_)
                | Primitive::Cross { .. }
                | Primitive::Ride { .. } => {
                    return None;
                }
                _ => {}
            }
        }
    }
    None
}
