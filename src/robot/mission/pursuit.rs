//! A goal pursued past what bars the way for now: it is waited for, and then somebody is asked to clear it.
//!
//! **Invariant**: of looks and of calls there are only so many, so the pursuit ends as its attempts do.

use std::collections::BTreeSet;

use crate::geometry::{Method, Target};
use crate::reins::Reins;
use crate::units::Point;
use crate::vehicle::Unfinished;

use super::{Ending, Event, GoalFact, Leg, Mission, MissionError, look_round};

/// So often a mission looks again before it says that unknown things bar its way, and so many times round each time.
const MOST_LOOKS: usize = 5;
/// So often where what bars the way is elsewhere each time.
const MOST_FOR_WHO_MOVES: usize = 8;
const LOOKS_OF_A_WAIT: usize = 8;
/// So often in one mission somebody is asked to clear a way.
const MOST_CALLS: usize = 3;

impl Mission<'_> {
    /// Where unknown things alone bar the way it looks again after a while: they may have been people. What still bars it
    /// somebody is asked to clear.
    pub(super) fn pursue(
        &mut self,
        goal: &[GoalFact],
        reins: &mut Reins<'_>,
    ) -> Result<Ending, MissionError> {
        let (mut looks, mut calls, mut tries) = (0, 0, 0);
        let (mut doubted, mut entered) = (BTreeSet::new(), BTreeSet::new());
        let mut places: Vec<Point> = Vec::new();
        loop {
            let ending = self.attempt(goal, reins)?;
            match ending {
                Ending::NoPlan(_) | Ending::Stuck(_) => {
                    match self.may_be_gone(goal, &ending, &mut doubted, reins) {
                        Ok(true) => {
                            tries += 1;
                            continue;
                        }
                        Ok(false) => {}
                        Err(ended) => return Ok(ended),
                    }
                    match self.goes_round(&ending, &mut entered, reins)? {
                        Ok(true) => {
                            tries += 1;
                            continue;
                        }
                        Ok(false) => {}
                        Err(ended) => return Ok(ended),
                    }
                    let before = std::mem::replace(&mut places, self.belief.unknown_places());
                    let still = self.relations.relations().thresholds().robot_still;
                    let is_where_it_was =
                        |at: &Point| before.iter().any(|one| (one - at).norm() <= still);
                    let moves = !places.iter().all(is_where_it_was);
                    if looks < MOST_LOOKS || moves && looks < MOST_FOR_WHO_MOVES {
                        looks += 1;
                        match self.looked_again(looks > 1, reins) {
                            Ok(true) => continue,
                            Ok(false) => {}
                            Err(ended) => return Ok(ended),
                        }
                    }
                    if calls < MOST_CALLS {
                        calls += 1;
                        match self.had_cleared(goal, &ending, reins) {
                            Ok(true) => continue,
                            Ok(false) => {}
                            Err(ended) => return Ok(ended),
                        }
                    }
                }
                Ending::AlreadyTrue if looks + calls + tries > 0 => return Ok(Ending::Done),
                _ => {}
            }
            return Ok(match ending {
                Ending::NoPlan(planned) => {
                    (reins.tell)(&Event::Planned(&planned));
                    // Who is told may stop: another way that the task has is not tried then.
                    if reins.stop.is_raised() { Ending::Stopped } else { Ending::NoPlan(planned) }
                }
                Ending::Stuck(surprise) => Ending::Stuck(self.with_remedy(surprise)),
                other => other,
            });
        }
    }

    /// Waits, where it stands or out of the way, and forgets the unknown things that it met; whether there were any.
    ///
    /// # Errors
    /// The robot was told to stop, or failed.
    fn looked_again(&mut self, gives_way: bool, reins: &mut Reins<'_>) -> Result<bool, Ending> {
        if !self.belief.has_met_unknown() {
            return Ok(false);
        }
        if gives_way {
            self.give_way(reins)?;
        }
        for _ in 0..LOOKS_OF_A_WAIT {
            match look_round(reins) {
                Ok(()) | Err(Unfinished::Met(_)) => {}
                Err(Unfinished::Stopped) => return Err(Ending::Stopped),
                Err(Unfinished::Failed(failure)) => return Err(Ending::Failed(failure)),
            }
        }
        self.belief.pose = reins.pose().1;
        self.take_notice(reins);
        self.belief.forget_unknown();
        Ok(true)
    }

    /// Goes out of the way of who may be waiting for it to pass: two that wait for one another wait for ever. Where the room
    /// has no such place it stays.
    fn give_way(&mut self, reins: &mut Reins<'_>) -> Result<(), Ending> {
        let (belief, floor) = (&self.belief, self.belief.floor());
        let (here, area) = (belief.pose.at, belief.area);
        // Of all that it met it is the nearest that it is face to face with.
        let met = belief.unknown_places().into_iter();
        let met = met.min_by(|a, b| (a - here).norm().total_cmp(&(b - here).norm()));
        let met = met.unwrap_or(here);
        let room = self.relations.relations().thresholds().robot_room;
        let is_clear = |at: &Point| (met - at).norm() >= room;
        let middles = floor.passframes(area).iter().map(|cell| cell.polygon.centroid());
        let far = |at: Point| {
            let (world, target) = (&belief.world, Target::Point(at));
            let way = floor.route_within(world, here, target, Method::Shortest, Some(&[area]));
            Some((way.ok()?.length, at))
        };
        let nearest = middles.filter(is_clear).filter_map(far).min_by(|a, b| a.0.total_cmp(&b.0));
        let Some((_, at)) = nearest else { return Ok(()) };
        match self.go("", Target::Point(at), &[area], reins, &mut Leg::default()) {
            Ok(()) | Err(Unfinished::Met(_)) => {}
            Err(Unfinished::Stopped) => return Err(Ending::Stopped),
            Err(Unfinished::Failed(failure)) => return Err(Ending::Failed(failure)),
        }
        self.name_this_point();
        Ok(())
    }
}
