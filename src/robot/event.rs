//! What happens on a mission, and how it ends.

use std::cell::Cell;

use crate::geometry::{NoRoute, Remedy, Route};
use crate::semantics::planning::PlanPlace;
use crate::semantics::{Join, Lift};
use crate::units::{AreaId, DoorId, MapId, Point};

use super::barred::{Answer, Barred};
use super::belief::Belief;
use super::directive::Directive;
use super::solve::Solved;
use super::vehicle::protocol::Scan;
use super::vehicle::{Bump, Failure, Moment, Obstruction, Outlines, Refusal, Sighting};

/// A goal turned into a task and solved.
#[derive(Debug, Clone)]
pub struct Planned {
    pub solved: Solved,
    /// Parallel steps; empty unless there is a plan.
    pub steps: Vec<Vec<Directive>>,
    /// The places that the plan may name.
    pub places: Vec<PlanPlace>,
    /// The doors and passages that it may name, and the lifts.
    pub joins: Vec<Join>,
    pub lifts: Vec<Lift>,
    /// Whether what the plan before had taught went into this one.
    pub learned_before: bool,
}

/// What happened on the way.
#[derive(Debug)]
pub enum Event<'a> {
    Planned(&'a Planned),
    /// The first number counts from 1 over all directives of the plan in force.
    Started {
        number: usize,
        of: usize,
        directive: &'a Directive,
    },
    /// The vehicle is sent along a way, which begins where it stands.
    Sent {
        map: MapId,
        way: &'a [Point],
    },
    /// The vehicle is on its way.
    Moved(&'a Moment),
    /// Its range finder turned once.
    Scanned(&'a Scan),
    /// A directive is done.
    Finished {
        number: usize,
        directive: &'a Directive,
        belief: &'a Belief,
        leg: &'a Leg,
    },
    /// The world is not as believed; a new plan follows.
    Surprised {
        directive: &'a Directive,
        surprise: &'a Surprise,
        belief: &'a Belief,
    },
    /// Something bars the only way, and nothing of it may be pushed: who is told may have it cleared, and say so.
    Barred {
        barred: &'a Barred,
        answer: &'a Cell<Answer>,
    },
}

/// The way driven for one directive. `seconds` are the drive's.
#[derive(Debug, Clone, Default)]
pub struct Leg {
    pub route: Option<Route>,
    pub seconds: f64,
}

/// Why a directive could not be carried out.
#[derive(Debug, Clone)]
pub enum Surprise {
    /// Something stood in the way, and this is what was seen of it; where nobody knows it, of all that nobody knows there.
    Blocked { bump: Bump, seen: Option<Sighting>, outlines: Box<Outlines> },
    /// The robot found itself elsewhere than it was held to be.
    Displaced,
    /// On its way the vehicle saw what was not believed.
    Noticed { seen: Sighting },
    /// The vehicle would not.
    Refused { refusal: Refusal, seen: Option<Sighting> },
    /// There is no way on the floor that is believed.
    /// With what would open one, where the mission ends for it.
    NoWay { to: String, why: NoRoute, remedy: Option<Box<Remedy>> },
    /// The directive names what the Map does not know.
    Unknown { name: String },
    /// A thing that is sought is in view of no place of this Area; where it is looked for next, and whether for things of its
    /// kind that lie there.
    NotSeen { thing: String, area: AreaId, next: Vec<AreaId>, for_kin: bool },
    /// Once it is shut, the robot could not open the door again from this Area: something stops its leaves, or there is no
    /// place to stand.
    NoReturn { door: DoorId, area: AreaId, by: Option<Obstruction> },
}

/// How a mission ended.
#[derive(Debug)]
pub enum Ending {
    /// Every goal holds.
    Done,
    /// Every goal held before the first directive.
    AlreadyTrue,
    /// There is no plan, or none was found within the limits: see the outcome.
    NoPlan(Box<Planned>),
    /// The last surprise taught nothing new, so that the next plan would fail in the same way, or it took away the
    /// last way there was.
    Stuck(Surprise),
    /// It was told to stop, and the vehicle stands. What is believed is so.
    Stopped,
    /// The vehicle is of no more use; what is believed is what was known before.
    Failed(Failure),
}

impl Surprise {
    /// Whether a way is given up for it, that the rules then know nothing of.
    pub(super) fn bars_a_way(&self) -> bool {
        let is_jammed =
            |refusal: &Refusal| matches!(refusal, Refusal::DoorJammed { by: Some(_), .. });
        match self {
            Self::NoWay { .. } | Self::NoReturn { .. } => true,
            Self::Refused { refusal, .. } => is_jammed(refusal),
            _ => false,
        }
    }
}
