//! What bars the only way where nothing of it may be pushed: it is told, with its place, to whoever can clear it.
//!
//! **Invariant**: what somebody says is gone is looked for; what is seen to stand there stands there, whatever was said.

use std::cell::Cell;
use std::collections::BTreeSet;

use crate::barred::{Answer, Barred};
use crate::geometry::{Method, NoRoute, Remedy};
use crate::obstacle::is_obstacle;
use crate::reins::Reins;
use crate::units::{AreaId, ReplicaId};
use crate::vehicle::{Obstruction, Refusal, Unfinished};

use super::{Ending, Event, GoalFact, Mission, Surprise};

impl Mission<'_> {
    /// Has whoever is told clear what a mission ends for; whether it may be tried again.
    ///
    /// # Errors
    /// The robot was told to stop, or failed.
    pub(super) fn had_cleared(
        &mut self,
        goal: &[GoalFact],
        ending: &Ending,
        reins: &mut Reins<'_>,
    ) -> Result<bool, Ending> {
        let Some(barred) = self.barred(ending) else { return Ok(false) };
        // Whoever is about hears it, too; whether they do is another matter.
        let person = self.belief.people.first().map(|person| person.name.clone());
        let called = person.map(|person| reins.act(|vehicle, watch| vehicle.call(&person, watch)));
        match called {
            Some(Err(Unfinished::Stopped)) => return Err(Ending::Stopped),
            Some(Err(Unfinished::Failed(failure))) => return Err(Ending::Failed(failure)),
            Some(Ok(()) | Err(Unfinished::Met(_))) | None => {}
        }
        let answer = Cell::default();
        (reins.tell)(&Event::Barred { barred: &barred, answer: &answer });
        if reins.stop.is_raised() {
            return Err(Ending::Stopped);
        }
        if answer.get() != Answer::Clear {
            return Ok(false);
        }
        for &thing in &barred.things {
            self.look_for(thing, goal, reins)?;
        }
        for thing in barred.unknown {
            self.belief.lose(thing);
        }
        self.belief.pose = reins.pose().1;
        self.take_notice(reins);
        self.belief.forget_unknown();
        Ok(true)
    }

    /// What is believed to bar the only way, and has not been seen there by this mission, may be gone: whether it is
    /// elsewhere, or out of view, so that the robot goes and sees. Each thing is `doubted` once.
    ///
    /// # Errors
    /// The robot failed.
    pub(super) fn may_be_gone(
        &mut self,
        goal: &[GoalFact],
        ending: &Ending,
        doubted: &mut BTreeSet<ReplicaId>,
        reins: &mut Reins<'_>,
    ) -> Result<bool, Ending> {
        // What it ran into is there.
        if matches!(ending, Ending::Stuck(Surprise::Blocked { .. })) {
            return Ok(false);
        }
        let Some(barred) = self.barred(ending) else { return Ok(false) };
        let mut is_news = false;
        for thing in barred.things.into_iter().filter(|thing| doubted.insert(*thing)) {
            is_news |= self.look_for(thing, goal, reins)?;
        }
        // What an earlier mission met and nobody knows may have gone since.
        for thing in barred.unknown {
            if !self.belief.has_met(thing) && doubted.insert(thing) {
                self.belief.lose(thing);
                is_news = true;
            }
        }
        if is_news {
            self.belief.reopen_ways();
        }
        Ok(is_news)
    }

    /// Looks for a thing where it is believed to be; out of view, it may be gone. Whether anything is believed otherwise now.
    fn look_for(
        &mut self,
        thing: ReplicaId,
        goal: &[GoalFact],
        reins: &mut Reins<'_>,
    ) -> Result<bool, Ending> {
        Ok(match reins.look_at(Obstruction::Replica(thing)).map_err(Ending::Failed)? {
            Some(seen) => self.belief.learn(seen),
            None if self.is_wanted(goal, thing) => false,
            None => {
                self.belief.lose(thing);
                true
            }
        })
    }

    /// Whether a goal speaks of a thing, which therefore must be somewhere.
    fn is_wanted(&self, goal: &[GoalFact], thing: ReplicaId) -> bool {
        let called = self.belief.world.replicas.get(&thing).map(|thing| &thing.name);
        called.is_some_and(|name| goal.iter().any(|fact| fact.args.contains(name)))
    }

    /// What a mission ends for that somebody could take away; none where it ends for something else.
    fn barred(&self, ending: &Ending) -> Option<Barred> {
        let surprise = match ending {
            Ending::Stuck(surprise) => Some(surprise),
            Ending::NoPlan(_) => None,
            _ => return None,
        };
        match surprise {
            Some(Surprise::Blocked { bump, .. }) => self.barred_by(bump.against, None),
            Some(Surprise::Refused { refusal, .. }) => {
                let Refusal::DoorJammed { by: Some(by), door, .. } = *refusal else { return None };
                let door = self.belief.world.doors.get(&door).map(|door| door.name.clone());
                self.barred_by(by, door)
            }
            Some(Surprise::NoWay { to, .. }) => {
                let here = (self.belief.area, to.clone());
                self.given_up().chain([here]).find_map(|(area, to)| self.barred_way(area, to))
            }
            None => self.given_up().find_map(|(area, to)| self.barred_way(area, to)),
            Some(_) => None,
        }
    }

    /// Ways that were given up, the last first: it is what the mission ends for.
    pub(super) fn given_up(&self) -> impl Iterator<Item = (AreaId, String)> {
        self.belief.unreachable.iter().rev().cloned()
    }

    fn barred_way(&self, from: AreaId, to: String) -> Option<Barred> {
        let things = taken_away(&self.remedy_for(&to, from)?)?;
        let barred = self.barred_by(Obstruction::Replica(*things.first()?), Some(to))?;
        let (unknown, things) = things.into_iter().partition(|thing| is_obstacle(*thing));
        Some(Barred { things, unknown, ..barred })
    }

    /// Something in the way, where it is believed to stand, or else where the robot met it; none for walls and doors.
    fn barred_by(&self, what: Obstruction, to: Option<String>) -> Option<Barred> {
        let belief = &self.belief;
        let thing = match what {
            Obstruction::Replica(thing) => Some(thing),
            Obstruction::Something => None,
            Obstruction::Wall(_) | Obstruction::Door(_) => return None,
        };
        let placed = thing.and_then(|thing| belief.scene().replicas.get(&thing));
        let at = placed.map_or(belief.pose.at, |placed| {
            nalgebra::center(&placed.bounds.min, &placed.bounds.max)
        });
        let area = belief.scene().area_at(at).unwrap_or(belief.area);
        let (unknown, things) = thing.into_iter().partition(|thing| is_obstacle(*thing));
        Some(Barred { things, unknown, map: belief.map, area, at, to })
    }

    /// What would open the way to a door or place that is out of reach from within an Area.
    pub(super) fn remedy_for(&self, to: &str, from: AreaId) -> Option<Remedy> {
        let (floor, world) = (self.belief.floor(), &self.belief.world);
        let start =
            if from == self.belief.area { self.belief.pose.at } else { floor.rest_in(from)? };
        match self.place_target(to) {
            Ok(target) => {
                let no: Option<NoRoute> = floor.route(world, start, target, Method::Shortest).err();
                no.and_then(|no| floor.remedy(world, start, target, &no, self.pushed_at_most()))
            }
            Err(_) => self.opened_by(to, from).map(|(_, remedy)| remedy),
        }
    }
}

/// The things that a remedy has taken away or changed; none where it is doors alone that bar the way.
fn taken_away(remedy: &Remedy) -> Option<Vec<ReplicaId>> {
    match remedy {
        Remedy::Move { replica, .. } => Some(vec![*replica]),
        Remedy::Remove { replicas, .. } => Some(replicas.clone()),
        Remedy::Shut { of: Some(replica), .. } => Some(vec![*replica]),
        Remedy::Shut { of: None, .. } | Remedy::Open(_) => None,
    }
}
