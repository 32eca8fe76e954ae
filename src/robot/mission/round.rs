//! A room that something cuts in two: what its one part does not lead to, its other may, through another door.
//!
//! The rules know rooms, not their parts: that no way leads to a place holds from where the robot came in.
//!
//! **Invariant**: each door of a room is gone round to once, so that the pursuit ends.

use std::collections::BTreeSet;

use crate::geometry::{Method, Target};
use crate::map::Entity;
use crate::reins::Reins;
use crate::semantics::predicate;
use crate::units::{AreaId, Point};

use super::{Ending, GoalFact, Mission, MissionError, Surprise, before_passage};

/// A door by which a room is entered, and what it is entered from.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Entrance {
    into: AreaId,
    door: String,
    from: AreaId,
}

impl Mission<'_> {
    /// Goes to the other side of a door from which there is a way to what a mission ends for; whether it is there, and the
    /// mission may be tried again.
    ///
    /// # Errors
    /// As [`Mission::run`]; the robot was told to stop, or failed.
    pub(super) fn goes_round(
        &mut self,
        ending: &Ending,
        tried: &mut BTreeSet<Entrance>,
        reins: &mut Reins<'_>,
    ) -> Result<Result<bool, Ending>, MissionError> {
        let now = match ending {
            Ending::Stuck(Surprise::NoWay { to, .. }) => Some((self.belief.area, to.clone())),
            Ending::Stuck(_) | Ending::NoPlan(_) => None,
            _ => return Ok(Ok(false)),
        };
        let ways = now.into_iter().chain(self.given_up());
        let Some(entrance) = ways
            .collect::<Vec<_>>()
            .into_iter()
            .find_map(|(area, to)| self.entrance(area, &to, tried))
        else {
            return Ok(Ok(false));
        };
        tried.insert(entrance.clone());
        let Entrance { into, door, from } = entrance;
        let fact = |predicate: &str, name: String| GoalFact {
            predicate: predicate.to_owned(),
            args: vec![name],
        };
        let from = self.belief.world.name(Entity::Area(from)).to_owned();
        let goal = [fact(predicate::ROBOT_IN, from), fact(predicate::ROBOT_AT_DOOR, door)];
        Ok(match self.attempt(&goal, reins)? {
            Ending::Done | Ending::AlreadyTrue => {
                self.belief.unreachable.retain(|(area, _)| *area != into);
                Ok(true)
            }
            ended @ (Ending::Stopped | Ending::Failed(_)) => Err(ended),
            Ending::NoPlan(_) | Ending::Stuck(_) => Ok(false),
        })
    }

    /// A door of an Area on the robot's Map from which a way leads to a place of it, and to which none leads
    /// within it from where the robot came.
    fn entrance(&self, area: AreaId, to: &str, tried: &BTreeSet<Entrance>) -> Option<Entrance> {
        let (belief, floor) = (&self.belief, self.belief.floor());
        let leads = |from: Point, to: Target| {
            let way = floor.route_within(&belief.world, from, to, Method::Shortest, Some(&[area]));
            way.is_ok()
        };
        let inside = |join: &&crate::semantics::Join| match before_passage(
            &belief.world,
            floor,
            join,
            area,
        )? {
            Target::Point(at) => Some(at),
            _ => None,
        };
        let target = self.place_target(to).ok()?;
        self.joins.iter().filter(|join| join.to == area).find_map(|join| {
            let (into, door, from) = (area, join.opening.clone(), join.from);
            let entrance = Entrance { into, door, from };
            let at = inside(&join).filter(|_| !tried.contains(&entrance))?;
            let is_here = belief.area == area && leads(belief.pose.at, Target::Point(at));
            (!is_here && leads(at, target)).then_some(entrance)
        })
    }
}
