//! What stands in a way where there is no other: what is pushed aside, and what is told to be done about it.
//!
//! Invariant: a push is tried only of what the map says is movable, and only where it opens the way.

use crate::belief::InTheWay;
use crate::geometry::{Method, NoRoute, Remedy, Target};
use crate::map::Entity;
use crate::reins::Reins;
use crate::semantics::{cargo, predicate};
use crate::units::{AreaId, Point, ReplicaId, Vector};
use crate::vehicle::Unfinished;

use super::{Leg, Mission, Surprise};

impl Mission<'_> {
    /// Of the ways that were given up, one that a push opens: it is a way again for the next plan, once the push is done.
    /// Whether there is one.
    pub(super) fn push_aside(&mut self) -> bool {
        if self.domain.predicate(predicate::BLOCKS_DOOR).is_none() {
            return false;
        }
        for way in self.belief.unreachable.clone() {
            let Some((area, remedy)) = self.opened_by(&way.1, way.0) else { continue };
            let Remedy::Move { replica, by, .. } = remedy else { continue };
            let known = self.belief.pushes.iter().any(|one| one.thing == replica);
            let belief = &self.belief;
            let home = belief.world.replicas.get(&replica).map(|thing| thing.area);
            if known
                || belief.stays.contains(&replica)
                || !belief.world.has_trait(replica, "movable")
                || home.is_none()
            {
                continue;
            }
            self.belief.unreachable.retain(|other| *other != way);
            let door = way.1.clone();
            self.belief.pushes.push(InTheWay { thing: replica, by, door, area, way });
            return true;
        }
        false
    }

    /// So far a thing is pushed out of the way, cm.
    pub(super) fn pushed_at_most(&self) -> f64 {
        self.relations.relations().thresholds().push_farthest
    }

    /// What opens the way through a door from an Area, and in which of the Areas at it the way is barred.
    pub(super) fn opened_by(&self, door: &str, from: AreaId) -> Option<(AreaId, Remedy)> {
        let belief = &self.belief;
        let (floor, world) = (belief.floor(), &belief.world);
        let start = if belief.area == from { belief.pose.at } else { floor.rest_in(from)? };
        let join = self.joins.iter().find(|join| join.opening == door && join.from == from)?;
        [from, join.to].into_iter().find_map(|area| {
            let target = self.door_target(door, from, area).ok()?;
            let no = floor.route(world, start, target, Method::Shortest).err()?;
            let remedy = floor.remedy(world, start, target, &no, self.pushed_at_most())?;
            let of = match &remedy {
                Remedy::Move { replica, .. } => world.replicas.get(replica)?.area,
                _ => area,
            };
            // What stands on the other side bars that side.
            Some((if of == join.to { of } else { from }, remedy))
        })
    }

    /// Pushes a thing out of the way, from where the robot reaches it.
    pub(super) fn push(
        &mut self,
        thing: ReplicaId,
        reins: &mut Reins<'_>,
        leg: &mut Leg,
    ) -> Result<(), Unfinished<Surprise>> {
        let called = self.belief.world.name(Entity::Replica(thing)).to_owned();
        let name = || Surprise::Unknown { name: called.clone() };
        let by = self.belief.pushes.iter().find(|one| one.thing == thing).map(|one| one.by);
        let remedy = Remedy::Move { replica: thing, by: by.ok_or_else(name)?, open: Vec::new() };
        let mut after = self.belief.world.clone();
        let _floor = self.belief.floor().remedied(&mut after, &remedy);
        let moved = after.replicas.get(&thing).ok_or_else(name)?;
        let (area, frame) = (moved.area, moved.frame);
        // From behind, where the robot gets there.
        if let Some(behind) = by.and_then(|by| self.behind(thing, by)) {
            let area = self.belief.area;
            match self.go(&called, Target::Point(behind), &[area], reins, leg) {
                Ok(()) | Err(Unfinished::Met(Surprise::NoWay { .. })) => {}
                Err(other) => return Err(other),
            }
        }
        let with = cargo(&self.belief.world, self.rules, self.belief.scene(), thing);
        self.within_reach(thing, reins, leg, |v, watch| v.push(thing, area, frame, watch))?;
        self.belief.pushed(thing, frame, &with.unwrap_or_default());
        self.belief.pose = reins.pose().1;
        self.name_this_point();
        Ok(())
    }

    /// Where the robot stands behind a thing, seen the way in which it is to be pushed; none off the free floor.
    fn behind(&self, thing: ReplicaId, by: Vector) -> Option<Point> {
        /// Off the thing by so much beside what the robot keeps clear, and so near to where it would best stand, cm.
        const OFF: f64 = 3.0;
        const NEAR: f64 = 25.0;
        let belief = &self.belief;
        let placed = belief.scene().replicas.get(&thing)?;
        let middle = nalgebra::center(&placed.bounds.min, &placed.bounds.max);
        let half = (placed.bounds.max - placed.bounds.min) / 2.0;
        let way = by.try_normalize(1e-9)?;
        let robot = &belief.world.robot;
        let off = half.x * way.x.abs() + half.y * way.y.abs();
        let best = middle - way * (off + robot.radius.get() + robot.clearance.get() + OFF);
        let near = belief.floor().standing_at(best)?;
        ((near - best).norm() <= NEAR).then_some(near)
    }

    /// The surprise for which a mission ends, with what would open the way.
    pub(crate) fn with_remedy(&self, surprise: Surprise) -> Surprise {
        let Surprise::NoWay { to, why, remedy: None } = surprise else { return surprise };
        let remedy = self.remedy_for(&to, self.belief.area);
        if let (NoRoute::NoFloor, None) = (&why, &remedy)
            && let Some((why, remedy)) = self.barred_behind(&to)
        {
            return Surprise::NoWay { to, why, remedy: remedy.map(Box::new) };
        }
        Surprise::NoWay { to, why, remedy: remedy.map(Box::new) }
    }

    /// Where there is no room to stand before a door: what bars the way into the room behind it, and what would open that.
    fn barred_behind(&self, door: &str) -> Option<(NoRoute, Option<Remedy>)> {
        let (floor, world) = (self.belief.floor(), &self.belief.world);
        let here = self.belief.area;
        let join = self.joins.iter().find(|join| join.opening == door && join.from == here)?;
        let (start, behind) = (self.belief.pose.at, Target::Area(join.to));
        let no = floor.route(world, start, behind, Method::Shortest).err()?;
        let remedy = floor.remedy(world, start, behind, &no, self.pushed_at_most());
        (!no.barriers().is_empty()).then_some((no, remedy))
    }
}
