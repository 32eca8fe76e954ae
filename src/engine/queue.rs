//! The tasks that wait: noted in the store before they are begun, so that they outlive the process, and done in the order of
//! the shortest way.
//!
//! **Invariants**: a task that was begun stays noted until it has ended. What two tasks both speak of keeps the order in
//! which they were given.

use std::collections::BTreeSet;

use crate::geometry::Method;
use crate::language::command::Command;
use crate::language::question::Memory;
use crate::map::Entity;
use crate::store::{Queue, QueuedTask, Reader};

use super::located::Located;
use super::task::thing_of;
use super::{Engine, Error, RequestError, State};

/// Of so many the best order is found by trying all; of more the nearest follows each.
const TRIED: usize = 7;

/// Where a task leads the robot, and what it speaks of.
struct Errand {
    stops: Vec<Located>,
    about: BTreeSet<Entity>,
}

impl Engine {
    /// The tasks that wait, the one that was begun first.
    ///
    /// # Errors
    /// The store is broken.
    pub fn queue(&self) -> Result<Queue, Error> {
        match &self.store {
            Some(store) => Ok(store.reader().queue()?),
            None => Ok(self.waiting.clone()),
        }
    }

    /// Puts tasks in the place of those that waited.
    ///
    /// # Errors
    /// The disk refused.
    pub fn put_queue(&mut self, queue: Queue, user: &str) -> Result<(), Error> {
        match &mut self.store {
            Some(store) => {
                Ok(store.put_queue(&queue, user, std::time::SystemTime::now().into())?)
            }
            None => {
                self.waiting = queue;
                Ok(())
            }
        }
    }

    /// Has a task wait. What is to be brought is brought to where the robot stands now.
    ///
    /// # Errors
    /// It is not understood by itself, or the disk refused.
    pub fn enqueue(&mut self, text: &str, user: &str) -> Result<QueuedTask, Error> {
        // Nobody is there to be asked back when it is begun.
        self.understand_in(text, &mut Memory::default())?;
        let mut queue = self.queue()?;
        let task = self.queued(text, user, &queue)?;
        queue.tasks.push(task.clone());
        self.put_queue(queue, user)?;
        Ok(task)
    }

    /// A task as it is noted, with a number of its own.
    pub(super) fn queued(
        &self,
        text: &str,
        user: &str,
        queue: &Queue,
    ) -> Result<QueuedTask, Error> {
        let at = std::time::SystemTime::now().into();
        let id = queue.tasks.iter().map(|task| task.id).max().unwrap_or(0).saturating_add(1);
        let (text, by) = (text.to_owned(), user.to_owned());
        let (map, pose) = self.robot()?;
        let from = Some((map, pose.at));
        Ok(QueuedTask { id, text, by, at, from, is_begun: false })
    }

    /// Takes a task out of those that wait; whether there was one of this number.
    ///
    /// # Errors
    /// The disk refused.
    pub fn drop_queued(&mut self, id: u32, user: &str) -> Result<bool, Error> {
        let mut queue = self.queue()?;
        let before = queue.tasks.len();
        queue.tasks.retain(|task| task.id != id);
        let dropped = queue.tasks.len() < before;
        if dropped {
            self.put_queue(queue, user)?;
        }
        Ok(dropped)
    }

    /// Has what waits go on waiting, or no longer.
    ///
    /// # Errors
    /// The disk refused.
    pub fn pause_queue(&mut self, pauses: bool, user: &str) -> Result<(), Error> {
        let mut queue = self.queue()?;
        if queue.paused.is_some() != pauses {
            queue.paused = pauses.then(|| std::time::SystemTime::now().into());
            self.put_queue(queue, user)?;
        }
        Ok(())
    }
}

impl State {
    /// The tasks that wait, as the store has them now.
    ///
    /// # Errors
    /// The store is broken.
    pub fn waiting(&self) -> Result<Queue, Error> {
        Ok(self.reader.as_ref().map_or_else(|| Ok(Queue::default()), Reader::queue)?)
    }

    /// Tasks in the order in which they are to be done: what was begun first, then so that the robot's way is the shortest.
    /// Tasks that speak of the same stay in their order, and so do all where one leads nowhere that is known.
    ///
    /// # Errors
    /// There is no map.
    pub fn in_order(&self, tasks: &[QueuedTask]) -> Result<Vec<QueuedTask>, Error> {
        let (begun, waiting): (Vec<_>, Vec<_>) = tasks.iter().cloned().partition(|t| t.is_begun);
        let errands: Option<Vec<Errand>> = waiting.iter().map(|task| self.errand(task)).collect();
        let (map, pose) = self.robot()?;
        let start = self.locate_point(map, pose.at).ok();
        let order = match (errands, start) {
            (Some(errands), Some(start)) if errands.len() > 1 => {
                let after = begun.iter().filter_map(|task| self.errand(task)?.stops.pop()).last();
                self.shortest(&errands, after.unwrap_or(start))?
            }
            _ => (0..waiting.len()).collect(),
        };
        Ok(begun.into_iter().chain(order.into_iter().map(|at| waiting[at].clone())).collect())
    }

    /// The places of a task, in their order; none where one is not known.
    fn errand(&self, task: &QueuedTask) -> Option<Errand> {
        let commands = self.understand(&task.text).ok()?;
        let mut stops = Vec::new();
        let mut about = BTreeSet::new();
        for command in &commands {
            let thing = thing_of(command);
            let place = command.place().map(|place| place.anchor);
            let place = place.filter(|place| Some(*place) != thing);
            about.extend(thing.into_iter().chain(place));
            for entity in thing.into_iter().chain(place) {
                stops.push(self.locate_entity(entity).ok()?);
            }
            if let Command::Bring { to: None, .. } = command {
                let (map, at) = task.from?;
                stops.push(self.locate_point(map, at).ok()?);
            }
        }
        (!stops.is_empty()).then_some(Errand { stops, about })
    }

    /// The order in which the way from a start through all errands is the shortest.
    fn shortest(&self, errands: &[Errand], start: Located) -> Result<Vec<usize>, Error> {
        let count = errands.len();
        let ends = |errand: &Errand| {
            let first = errand.stops.first().copied().expect("an errand has a stop");
            (first, errand.stops.last().copied().unwrap_or(first))
        };
        // From the start (the last row) and from the end of each to the beginning of each.
        let mut far = vec![vec![0.0; count]; count + 1];
        for (from, row) in far.iter_mut().enumerate() {
            let begin = errands.get(from).map_or(start, |errand| ends(errand).1);
            for (to, length) in row.iter_mut().enumerate().filter(|(to, _)| *to != from) {
                *length = self.way_between(begin, ends(&errands[to]).0)?;
            }
        }
        let waits_for = |to: usize| {
            let shares = move |from: &usize| !errands[*from].about.is_disjoint(&errands[to].about);
            (0..to).filter(shares).collect::<Vec<usize>>()
        };
        let before: Vec<Vec<usize>> = (0..count).map(waits_for).collect();
        Ok(if count <= TRIED { best(&far, &before) } else { nearest(&far, &before) })
    }

    /// Length of a way, doors opened and lifts ridden, cm; endless where there is none.
    fn way_between(&self, from: Located, to: Located) -> Result<f64, Error> {
        let journey = self.around()?.journey_between(("", from), ("", to), Method::Shortest)?;
        let legs = journey.legs.iter().map(|leg| leg.route.as_ref().map(|route| route.length).ok());
        let length = legs.sum::<Option<f64>>();
        let rides: f64 = journey.rides.iter().map(|ride| ride.rise.abs()).sum();
        Ok(length.map_or(f64::INFINITY, |length| length + rides))
    }
}

/// Those that may be next: not done, and what they wait for is.
fn ready<'a>(done: &'a [usize], before: &'a [Vec<usize>]) -> impl Iterator<Item = usize> + 'a {
    (0..before.len())
        .filter(|at| !done.contains(at) && before[*at].iter().all(|earlier| done.contains(earlier)))
}

/// The shortest of all orders; of several the one nearest to that in which they were given.
fn best(far: &[Vec<f64>], before: &[Vec<usize>]) -> Vec<usize> {
    fn go(
        far: &[Vec<f64>],
        before: &[Vec<usize>],
        done: &mut Vec<usize>,
        length: f64,
        least: &mut (f64, Vec<usize>),
    ) {
        /// Lengths that differ by less are the same, cm.
        const SAME: f64 = 1e-6;
        if done.len() == before.len() {
            if least.1.is_empty() || length < least.0 - SAME {
                *least = (length, done.clone());
            }
            return;
        }
        let from = done.last().copied().unwrap_or(before.len());
        for next in ready(&done.clone(), before) {
            done.push(next);
            go(far, before, done, length + far[from][next], least);
            done.pop();
        }
    }
    let mut least = (f64::INFINITY, Vec::new());
    go(far, before, &mut Vec::new(), 0.0, &mut least);
    least.1
}

/// The nearest next, again and again.
fn nearest(far: &[Vec<f64>], before: &[Vec<usize>]) -> Vec<usize> {
    let mut done: Vec<usize> = Vec::new();
    loop {
        let from = done.last().copied().unwrap_or(before.len());
        let next = ready(&done, before).min_by(|a, b| far[from][*a].total_cmp(&far[from][*b]));
        let Some(next) = next else { return done };
        done.push(next);
    }
}

/// The number of a task in the list that is told, from 1.
///
/// # Errors
/// There is none of this number, or several and none was named.
pub(super) fn numbered(queue: &Queue, number: Option<usize>) -> Result<u32, RequestError> {
    let waiting = queue.tasks.len();
    let at = match number {
        Some(number) => number.checked_sub(1),
        None => (waiting == 1).then_some(0),
    };
    let task = at.and_then(|at| queue.tasks.get(at));
    task.map(|task| task.id).ok_or(RequestError::WhichQueued { waiting })
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Points of a line, each task from one to another.
    fn lengths(start: f64, tasks: &[(f64, f64)]) -> Vec<Vec<f64>> {
        let ends = tasks.iter().map(|task| task.1).chain([start]);
        ends.map(|end| tasks.iter().map(|task| (task.0 - end).abs()).collect()).collect()
    }

    fn length(far: &[Vec<f64>], order: &[usize]) -> f64 {
        let from = std::iter::once(far.len() - 1).chain(order.iter().copied());
        from.zip(order).map(|(from, to)| far[from][*to]).sum()
    }

    #[test]
    fn no_order_that_keeps_what_belongs_together_is_shorter() {
        let mut seed = 7_u64;
        let mut below = |bound: u64| {
            seed = seed.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
            (seed >> 33) % bound
        };
        for _ in 0..200 {
            let count = 2 + below(4) as usize;
            let tasks: Vec<(f64, f64)> =
                (0..count).map(|_| (below(100) as f64, below(100) as f64)).collect();
            let before: Vec<Vec<usize>> =
                (0..count).map(|at| (0..at).filter(|_| below(4) == 0).collect()).collect();
            let far = lengths(below(100) as f64, &tasks);
            let found = best(&far, &before);
            // All orders, by counting up in the base of their number.
            let mut least = f64::INFINITY;
            for code in 0..count.pow(count as u32) {
                let order: Vec<usize> =
                    (0..count).map(|at| code / count.pow(at as u32) % count).collect();
                let place = |task: usize| order.iter().position(|other| *other == task);
                let keeps = (0..count)
                    .all(|task| before[task].iter().all(|earlier| place(*earlier) < place(task)));
                let is_whole = (0..count).all(|task| place(task).is_some());
                if is_whole && keeps {
                    least = least.min(length(&far, &order));
                }
            }
            assert!((length(&far, &found) - least).abs() < 1e-9, "{found:?} {far:?} {before:?}");
            let quick = nearest(&far, &before);
            assert_eq!(quick.len(), count);
        }
    }
}
