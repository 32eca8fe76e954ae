//! A round through several places of which nobody said the order: the shortest way through all of them.
//!
//! Invariant: a way begins where the one before it ended, at the door by which a room was entered, and not in its middle;
//! what cannot be reached comes last.

use std::collections::BTreeMap;

use crate::geometry::{Method, Target};
use crate::map::Entity;
use crate::units::MapId;

use super::State;
use super::located::{End, Located};

/// Of so many the best order is found by trying all; of more the nearest follows each.
const TRIED: usize = 7;

/// Length of a way that there is not, longer than any, cm.
const UNREACHED: f64 = 1e9;

impl State {
    /// The order in which the robot's way through all of some things is the shortest; none where it is not known where one
    /// of them is.
    pub(super) fn round(&self, things: &[Entity]) -> Option<Vec<usize>> {
        let (map, pose) = self.robot().ok()?;
        let start = self.locate_point(map, pose.at).ok()?;
        let stops = things.iter().map(|thing| self.locate_entity(*thing).ok());
        let stops = stops.collect::<Option<Vec<Located>>>()?;
        let mut round = Round { state: self, stops, legs: BTreeMap::new() };
        if round.stops.len() > TRIED {
            return Some(round.nearest(start));
        }
        let mut least = (f64::INFINITY, Vec::new());
        round.best(start, 0.0, &mut Vec::new(), &mut least);
        Some(least.1)
    }
}

struct Round<'s> {
    state: &'s State,
    stops: Vec<Located>,
    /// From a point of a map to a stop: how far, and where the way ends.
    legs: BTreeMap<(MapId, [u64; 2], usize), (f64, Located)>,
}

impl Round<'_> {
    fn leg(&mut self, from: Located, to: usize) -> (f64, Located) {
        let key = (from.map, [from.at.x.to_bits(), from.at.y.to_bits()], to);
        if let Some(known) = self.legs.get(&key) {
            return *known;
        }
        let leg = self.way(from, self.stops[to]).unwrap_or((UNREACHED, from));
        self.legs.insert(key, leg);
        leg
    }

    fn way(&self, from: Located, to: Located) -> Option<(f64, Located)> {
        let around = self.state.around().ok()?;
        let journey = around.journey_between(("", from), ("", to), Method::Shortest).ok()?;
        let mut length: f64 = journey.rides.iter().map(|ride| ride.rise.abs()).sum();
        let mut end = from.at;
        for leg in &journey.legs {
            let route = leg.route.as_ref().ok()?;
            length += route.length;
            end = route.points.last().copied().unwrap_or(end);
        }
        let end = Located { map: to.map, at: end, target: Target::Point(end), end: End::Point };
        Some((length, end))
    }

    fn best(
        &mut self,
        from: Located,
        length: f64,
        done: &mut Vec<usize>,
        least: &mut (f64, Vec<usize>),
    ) {
        if length >= least.0 {
            return;
        }
        if done.len() == self.stops.len() {
            *least = (length, done.clone());
        }
        for next in (0..self.stops.len()).filter(|at| !done.contains(at)).collect::<Vec<_>>() {
            let (far, end) = self.leg(from, next);
            done.push(next);
            self.best(end, length + far, done, least);
            done.pop();
        }
    }

    fn nearest(&mut self, start: Located) -> Vec<usize> {
        let (mut done, mut from) = (Vec::new(), start);
        loop {
            let left = (0..self.stops.len()).filter(|at| !done.contains(at)).collect::<Vec<_>>();
            let legs = left.into_iter().map(|next| (next, self.leg(from, next)));
            let next = legs.min_by(|(_, a), (_, b)| a.0.total_cmp(&b.0));
            let Some((next, (_, end))) = next else { return done };
            done.push(next);
            from = end;
        }
    }
}
