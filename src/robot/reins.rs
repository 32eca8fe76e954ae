//! [`Reins`]: a vehicle at work for a mission, and what of its word is believed.
//!
//! **Invariant**: a pose is taken over only when the vehicle can be there: on the way on which it was sent, or where it stood
//! when it was given something else to do. One that tells otherwise is of no more use.

use std::ops::ControlFlow;

use crate::geometry::{Polygon, nearest_on_segment};
use crate::units::{Deg, MapId, Point, Pose, Stop};

use super::belief::AT_PLACE;
use super::event::Event;
use super::vehicle::{
    Bump, Done, Failure, Gathered, Moment, Notice, Obstruction, Outlines, Sighting, Unfinished,
    Vehicle, Watch,
};
use crate::units::ReplicaId;

/// So far from the way on which it was sent a vehicle may be, cm: a promise of the protocol (see docs/vehicle.md), not a
/// meaning that rules may change.
const OFF_THE_WAY: f64 = AT_PLACE;
/// So far from the heading that was asked for it may face in the end, degrees; likewise.
const OFF_COURSE: f64 = 10.0;
/// Sightings that are kept of one order; a vehicle that tells more of them has told enough.
const MOST_SEEN: usize = 1000;

/// A vehicle, who may stop it, and who is told.
pub(super) struct Reins<'v> {
    vehicle: &'v mut dyn Vehicle,
    pub(super) stop: Stop,
    pub(super) tell: &'v mut dyn FnMut(&Event<'_>),
    /// What is believed of where it is, and of its clock.
    at: (MapId, Pose),
    time: f64,
    /// What it saw on its way, and was not yet thought of.
    pub(super) seen: Vec<Sighting>,
    /// It found itself elsewhere than it was held to be.
    is_displaced: bool,
}

impl<'v> Reins<'v> {
    /// # Errors
    /// The vehicle is not where it is believed to be.
    pub(super) fn new(
        vehicle: &'v mut dyn Vehicle,
        believed: (MapId, Pose),
        stop: &Stop,
        tell: &'v mut dyn FnMut(&Event<'_>),
    ) -> Result<Self, Failure> {
        let time = vehicle.time();
        let (stop, seen) = (stop.clone(), vehicle.news());
        let mut reins = Self { vehicle, stop, tell, at: believed, time, seen, is_displaced: false };
        reins.take_over(&[believed.1.at])?;
        Ok(reins)
    }

    /// The last pose that was believed.
    pub(super) fn pose(&self) -> (MapId, Pose) {
        self.at
    }

    pub(super) fn time(&self) -> f64 {
        self.time
    }

    /// What it sees about it that nobody knows.
    pub(super) fn outlines(&self) -> Outlines {
        self.vehicle.outlines()
    }

    /// All that its senses have found to differ.
    pub(super) fn gathered(&self) -> Gathered {
        self.vehicle.gathered()
    }

    pub(super) fn sees_through(&self, pieces: &[Polygon]) -> bool {
        self.vehicle.sees_through(pieces)
    }

    /// Whether it found itself elsewhere since this was asked last.
    pub(super) fn was_displaced(&mut self) -> bool {
        std::mem::take(&mut self.is_displaced)
    }

    pub(super) fn look_at(&mut self, what: Obstruction) -> Result<Option<Sighting>, Failure> {
        self.vehicle.look_at(what)
    }

    pub(super) fn sees(&mut self, thing: ReplicaId) -> Result<Option<Sighting>, Failure> {
        self.vehicle.sees(thing)
    }

    /// Believes where the vehicle now is, if it can be there.
    fn take_over(&mut self, way: &[Point]) -> Result<(), Failure> {
        let (map, pose) = self.vehicle.pose();
        let moment = Moment { time: self.vehicle.time(), map, pose };
        check(&moment, self.at.0, self.time, way)?;
        (self.at, self.time) = ((map, pose), moment.time);
        Ok(())
    }

    /// A way piece by piece, each at the pace that its zones ask for.
    pub(super) fn follow_paced(
        &mut self,
        pieces: &[(Vec<Point>, Option<f64>)],
        heading: Option<Deg>,
    ) -> Result<(), Unfinished<Bump>> {
        // Who was told to stop is sent nowhere.
        self.check_stop()?;
        let here = std::iter::once(&self.at.1.at);
        let way: Vec<Point> =
            here.chain(pieces.iter().flat_map(|(path, _)| path)).copied().collect();
        (self.tell)(&Event::Sent { map: self.at.0, way: &way });
        let last = pieces.len().saturating_sub(1);
        for (number, (path, pace)) in pieces.iter().enumerate() {
            self.vehicle.keep_to(*pace);
            let driven = self.follow(path, heading.filter(|_| number == last));
            self.vehicle.keep_to(None);
            driven?;
        }
        Ok(())
    }

    pub(super) fn follow(
        &mut self,
        path: &[Point],
        heading: Option<Deg>,
    ) -> Result<(), Unfinished<Bump>> {
        let way: Vec<Point> = std::iter::once(self.at.1.at).chain(path.iter().copied()).collect();
        let driven = self.watched(&way, |vehicle, watch| vehicle.follow(path, heading, watch));
        if let Err(Unfinished::Failed(_)) = driven {
            return driven;
        }
        if self.is_displaced {
            self.at = self.vehicle.pose();
            return driven;
        }
        self.take_over(&way).map_err(Unfinished::Failed)?;
        if driven.is_ok() {
            let (pose, goal) = (self.at.1, way[way.len() - 1]);
            let off = (pose.at - goal).norm();
            if off > OFF_THE_WAY {
                return Err(Unfinished::Failed(Failure::OffTheWay { pose, off }));
            }
            let off = heading.map_or(0.0, |heading| (heading - pose.heading).signed().abs());
            if off > OFF_COURSE {
                return Err(Unfinished::Failed(Failure::WrongHeading { pose, off }));
            }
        }
        driven
    }

    /// Something that leaves the vehicle where it stands.
    pub(super) fn act(
        &mut self,
        order: impl FnOnce(&mut dyn Vehicle, &mut Watch<'_>) -> Done,
    ) -> Done {
        let here = [self.at.1.at];
        let done = self.watched(&here, order);
        if !matches!(done, Err(Unfinished::Failed(_))) {
            self.take_over(&here).map_err(Unfinished::Failed)?;
        }
        done
    }

    /// Something that brings it elsewhere, unless it is stopped before it is begun.
    pub(super) fn ride(
        &mut self,
        to: (MapId, Pose),
        order: impl FnOnce(&mut dyn Vehicle, &mut Watch<'_>) -> Done,
    ) -> Done {
        self.check_stop()?;
        let watch = &mut Watch::of(&self.stop);
        let done = order(&mut *self.vehicle, watch);
        match &done {
            Err(Unfinished::Failed(_)) => {}
            Err(Unfinished::Stopped) if self.vehicle.pose().0 == self.at.0 => {
                self.take_over(&[self.at.1.at]).map_err(Unfinished::Failed)?;
            }
            _ => {
                let before = std::mem::replace(&mut self.at, to);
                if let Err(failure) = self.take_over(&[to.1.at]) {
                    self.at = before;
                    return Err(Unfinished::Failed(failure));
                }
            }
        }
        done
    }

    fn check_stop<Why>(&self) -> Result<(), Unfinished<Why>> {
        if self.stop.is_raised() { Err(Unfinished::Stopped) } else { Ok(()) }
    }

    /// Has the vehicle do something, believes what it tells on its way, and breaks it off where that cannot be.
    fn watched<Why>(
        &mut self,
        way: &[Point],
        order: impl FnOnce(&mut dyn Vehicle, &mut Watch<'_>) -> Result<(), Unfinished<Why>>,
    ) -> Result<(), Unfinished<Why>> {
        self.check_stop()?;
        let Self { vehicle, stop, tell, at, time, seen, is_displaced } = self;
        let mut lie = None;
        let mut hear = |notice: &Notice| {
            match notice {
                Notice::Moved(moment) => {
                    if let Err(failure) = check(moment, at.0, *time, way) {
                        lie.get_or_insert(failure);
                        return ControlFlow::Break(());
                    }
                    (*at, *time) = ((moment.map, moment.pose), moment.time);
                    tell(&Event::Moved(moment));
                }
                Notice::Saw(sighting) if seen.len() < MOST_SEEN => seen.push(*sighting),
                Notice::Saw(_) => {}
                Notice::Scanned(scan) => tell(&Event::Scanned(scan)),
                Notice::Found(moment) => {
                    (*at, *time) = ((moment.map, moment.pose), moment.time);
                    *is_displaced = true;
                    tell(&Event::Moved(moment));
                }
            }
            ControlFlow::Continue(())
        };
        let done = order(&mut **vehicle, &mut Watch::new(stop.clone(), &mut hear));
        match lie {
            Some(failure) => Err(Unfinished::Failed(failure)),
            None => done,
        }
    }
}

/// Whether a vehicle can be there then: on its Map, on the way, or near enough.
fn check(moment: &Moment, map: MapId, since: f64, way: &[Point]) -> Result<(), Failure> {
    let pose = moment.pose;
    let numbers = [pose.at.x, pose.at.y, pose.heading.get(), moment.time];
    if numbers.iter().any(|number| !number.is_finite()) || moment.time < since {
        return Err(Failure::NoNumber);
    }
    if moment.map != map {
        return Err(Failure::WrongMap);
    }
    let from_piece = |piece: &[Point]| {
        let nearest = nearest_on_segment(pose.at, piece[0], piece[piece.len() - 1]);
        (nearest - pose.at).norm()
    };
    let off = way.windows(2).map(from_piece).fold(from_piece(&way[..1]), f64::min);
    if off > OFF_THE_WAY { Err(Failure::OffTheWay { pose, off }) } else { Ok(()) }
}

#[cfg(test)]
mod tests {
    use super::{OFF_THE_WAY, check};
    use crate::units::{Deg, MapId, Point, Pose};
    use crate::vehicle::{Failure, Moment};

    #[test]
    fn a_pose_is_believed_on_the_way_alone() {
        let way = [Point::new(0.0, 0.0), Point::new(100.0, 0.0), Point::new(100.0, 100.0)];
        let told = |x: f64, y: f64, time: f64, map: u32| {
            let pose = Pose { at: Point::new(x, y), heading: Deg::ZERO };
            check(&Moment { time, map: MapId(map), pose }, MapId(1), 5.0, &way)
        };
        for (x, y) in [(0.0, 0.0), (50.0, OFF_THE_WAY), (100.0 + OFF_THE_WAY, 50.0), (100.0, 100.0)]
        {
            assert_eq!(told(x, y, 5.0, 1), Ok(()), "({x}; {y})");
        }
        for (x, y) in [(-20.0, 0.0), (50.0, 50.0), (1e300, 0.0)] {
            assert!(matches!(told(x, y, 5.0, 1), Err(Failure::OffTheWay { .. })), "({x}; {y})");
        }
        for (x, y, time) in [(f64::NAN, 0.0, 5.0), (0.0, f64::INFINITY, 5.0), (0.0, 0.0, 4.0)] {
            assert_eq!(told(x, y, time, 1), Err(Failure::NoNumber), "({x}; {y}) at {time}");
        }
        assert_eq!(told(0.0, 0.0, f64::NAN, 1), Err(Failure::NoNumber));
        assert_eq!(told(0.0, 0.0, 5.0, 2), Err(Failure::WrongMap));
    }
}
