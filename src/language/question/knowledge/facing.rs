//! Left and right as they are for someone who faces a thing: «слева, если смотреть на окно».
//!
//! Invariant: where that person stands is said in the answer, and is the robot's place or the middle of the room.

use super::{Frame, Knowledge};
use crate::facts::Value;
use crate::map::Entity;
use crate::question::Doubt;
use crate::question::query::{Noun, Rel, Side, Thing};
use crate::semantics::{Listed, length};
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
        let away = at - from;
        let (left, before) = (ahead.perp(&away), seen * ahead.dot(&away));
        let row = self.faced(thing, of, "side", (before, left), 0.0)?;
        let found = self.as_faced("RATHER_AT_SIDE(_, _, S)", vec![row]);
        let is_so = |rel: &Rel| {
            let side = match rel {
                Rel::LeftOf => "left",
                Rel::RightOf => "right",
                Rel::InFrontOf => "front",
                Rel::Behind => "behind",
                _ => return false,
            };
            found.contains(side)
        };
        sides.into_iter().find(is_so)
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
        let in_room = self.related(Rel::In, Thing::Entity(Entity::Area(area)));
        let others = in_room.into_iter().filter(|t| *t != of && *t != faced);
        let row = |thing: Thing| {
            let (_, p) = self.point(thing).filter(|_| thing.replica().is_some())?;
            let away = p - around;
            let offset = (ahead.dot(&away), ahead.perp(&away));
            match side.of_all() {
                true => self.faced(thing, Thing::Entity(Entity::Area(area)), "area", offset, 0.0),
                false => self.faced(thing, of, "thing", offset, self.distance(thing, of)?),
            }
        };
        let relation = if side.is_left() { "LEFT_AS_FACED" } else { "RIGHT_AS_FACED" };
        let found = self.as_faced(&format!("{relation}(X, _)"), others.filter_map(row).collect());
        Ok(found.iter().filter_map(|symbol| self.thing(symbol)).collect())
    }

    /// A row of `faced`: how far before and to the left of something a thing is, and how far from it, cm.
    fn faced(
        &self,
        thing: Thing,
        of: Thing,
        kind: &str,
        (ahead, left): (f64, f64),
        away: f64,
    ) -> Option<Vec<Value>> {
        let names = [self.symbol(thing), self.symbol(of), kind.to_owned()].map(Value::from);
        let bearing = Value::Number((left.atan2(ahead).to_degrees() * 100.0).round() as i64);
        let lengths = [length(ahead)?, length(left)?, bearing, length(away)?];
        Some(names.into_iter().chain(lengths).collect())
    }

    /// The words that the rules give for how things lie to one who faces something.
    fn as_faced(&self, premise: &str, rows: Vec<Vec<Value>>) -> HashSet<String> {
        let Some(faced) = Listed::of("faced", rows) else { return HashSet::new() };
        // Rules that go without the relation say it of nothing.
        let found = self.relations.ask_of(&[&faced], &format!("?- {premise}")).unwrap_or_default();
        found.iter().filter_map(|row| row.first()).map(ToString::to_string).collect()
    }
}
