//! From a goal to a driven way: mission, directives, the drive and what it observes (SPEC X; paper 1 §8).
//!
//! A mission plans, turns each directive into a motion and gives it to a [`Vehicle`]. The simulator is one;
//! whatever speaks the protocol is another (X3). What a drive meets that the Map did not tell comes back as an
//! [`Obstruction`], changes what the mission believes, and leads to a new plan (X2).
//!
//! # Invariants
//!
//! What a directive asks of the vehicle is read from its effects, never from its name. Every surprise must teach
//! something, or the mission ends. It ends at once when it is told to stop, and what is believed is so. A vehicle is
//! believed to be only where it can be (`robot/reins`); one that fails ends the mission, and of the order under way
//! nothing is assumed. What the floor refuses for good is no part of a proof (`robot/ahead`), and a plan is begun only after
//! it was carried out in a simulated world that is the belief itself (`robot/mission/rehearsal`); what that finds out is
//! told to the next plan. What lies on or in a thing goes with it, in the hand and after (`semantics/cargo`). The
//! simulator's collision test knows nothing of the free floor that the route was made from. What is random is drawn from
//! one seed, so a run repeats itself; behind its senses (`simulator/senses`) the simulated robot tells nothing else of its
//! world, and a [`Pilot`] finds where it is.

use orthoframe_geometry as geometry;
use orthoframe_graphplan as graphplan;
use orthoframe_map as map;
use orthoframe_semantics as semantics;
use orthoframe_sensing as sensing;
use orthoframe_strips as strips;
use orthoframe_units as units;

units::messages!("../../rules/messages", "robot", Failure);
use orthoframe_vectors as vectors;

mod ahead;
mod atlas;
mod barred;
mod belief;
mod directive;
mod event;
mod eye;
mod goal;
mod grounding;
mod helping;
mod idle;
mod mission;
mod obstacle;
mod passable;
mod pilot;
mod placing;
mod reins;
mod seek;
mod shortness;
mod simulator;
mod solve;
mod soon;
mod terrain;
mod timing;
mod vehicle;
mod wishes;

pub use barred::{Answer, Barred};
pub use belief::{Belief, IN_MIDDLE, Person, STARTING_POINT, Spot, Station, facts_of_map};
pub use directive::{Directive, Effect, Primitive};
pub use event::{Ending, Event, Leg, Planned, Surprise};
pub use goal::{GoalFact, state};
pub use mission::{Mission, MissionError, starting_pose};
pub use obstacle::{is_obstacle, outline_of, stand_obstacle};
pub use passable::Refused;
pub use pilot::{Ground, Pilot, height_of_laser};
pub use placing::{Hollow, hollow, spot_in, spot_on};
pub use shortness::Shortness;
pub use simulator::senses::{Senses, SensingRobot, Touch};
pub use simulator::{Simulator, beyond_arm};
pub use solve::{DrivenTime, Reason, Replanned, Solved, Wanted, solve};
pub use terrain::{Terrain, solve_on, solve_quickest, solve_without};
pub use vehicle::{
    Address, Bump, Done, Failure, Gathered, Moment, Notice, Obstruction, Outlines, Patience,
    Refusal, RemoteVehicle, Served, Sighting, Unfinished, Vehicle, Watch, protocol, serve,
};
pub use wishes::Wishes;
