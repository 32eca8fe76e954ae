//! Left and right as they are for someone who faces a thing: «слева, если смотреть на окно».
//!
//! Invariant: where that person stands is said in the answer, and is the robot's place or the middle of the room.

use super::{Frame, Knowledge};
use crate::map::Entity;
use crate::question::Doubt;
use crate::question::query::{Noun, Rel, Side, Thing};
use crate::units::Point;
use std::collections::HashSet;

impl Knowledge<'_> {
    /// Where one stands who faces a thing, and whether that is the robot's own place.
    pub(in crate::question) fn standpoint(&self, faced: Thing) -> Option<(Point, bool)> {
        let area = self.area_of(faced)?;
        let (map, _) = self.point(faced)?;
        let robot = self.senses.robot().filter(|(own, _)| *own == map);
        let here = self.area_of(Thing::Robot) == Some(area);
        match robot.filter(|_| here) {
            Some((_, pose)) => Some((pose.at, true)),
            None => Some((self.point(Thing::Entity(Entity::Area(area)))?.1, false)),
        }
    }

    /// On which of two opposite sides of another a thing is rather than on the other, though it is mostly before or beside
    /// it: of the other's own front, else as the robot sees it.
    pub(in crate::question) fn rather(
        &self,
        sides: [Rel; 2],
        thing: Thing,
        of: Thing,
    ) -> Option<Rel> {
        let aside = self.relations.thresholds().view_aside;
        if self.area_of(thing) != self.area_of(of) {
            return None;
        }
        let ((_, at), (map, from)) = (self.point(thing)?, self.point(of)?);
        let (ahead, seen) = match self.frame(of) {
            Frame::Own => (self.relations.front(of.replica()?)?, 1.0),
            Frame::Viewer => {
                let (own, pose) = self.senses.robot()?;
                ((own == map).then_some(from - pose.at)?.try_normalize(1.0)?, -1.0)
            }
        };
        let (left, before) = (ahead.perp(&(at - from)), seen * ahead.dot(&(at - from)));
        let of_side = |rel: Rel| match rel {
            Rel::LeftOf => left > aside,
            Rel::RightOf => left < -aside,
            Rel::InFrontOf => before > aside,
            Rel::Behind => before < -aside,
            _ => false,
        };
        sides.into_iter().find(|rel| of_side(*rel))
    }

    /// What is to the left or right of a thing, or in the whole room, for one who faces another, or the same thing.
    pub(super) fn seen_aside(
        &self,
        side: Side,
        of: &Noun,
        faced: &Noun,
    ) -> Result<HashSet<Thing>, Doubt> {
        let (of, faced) = (self.one(of)?, self.one(faced)?);
        let seen = self.standpoint(faced).zip(self.point(faced)).zip(self.area_of(faced));
        let Some((((from, _), (_, at)), area)) = seen else { return Ok(HashSet::new()) };
        let Some(ahead) = (at - from).try_normalize(1.0) else { return Ok(HashSet::new()) };
        let around = if side.of_all() { from } else { self.point(of).map_or(from, |(_, p)| p) };
        let near = self.relations.thresholds();
        let sideways = near.sector_half..=180.0 - near.sector_half;
        let in_room = self.related(Rel::In, Thing::Entity(Entity::Area(area)));
        let aside = |thing: &Thing| {
            let Some((_, p)) = self.point(*thing).filter(|_| thing.replica().is_some()) else {
                return false;
            };
            let away = p - around;
            let angle = ahead.perp(&away).atan2(ahead.dot(&away)).to_degrees();
            let angle = if side.is_left() { angle } else { -angle };
            match side.of_all() {
                true => (near.view_ahead..near.view_behind).contains(&angle),
                false => {
                    sideways.contains(&angle)
                        && self.distance(*thing, of).is_some_and(|d| d <= near.sector_distance)
                }
            }
        };
        Ok(in_room.into_iter().filter(|t| *t != of && *t != faced && aside(t)).collect())
    }
}
