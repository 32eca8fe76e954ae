//! Where the robot is to stand: at what is named, at a window, in the middle of a room, between two things, and what it
//! is to look at there.

use super::located::spot_in_words;
use crate::geometry::nearest_on_segment;
use crate::language::command::{Facing, Placement, Relation};
use crate::map::{Entity, Permeability};
use crate::robot::{Belief, GoalFact};
use crate::semantics::{Relations, predicate};
use crate::units::{AreaId, Deg, MapId, Point, Vector};

use super::directive_words::{
    between_places, facing_place, facing_wall, facing_window, middle_place, side_of, side_place,
    spot_place, window_place,
};
use super::error::{both, in_both};
use super::{Error, Method, RequestError, State};

/// A point of the floor that has no name on the Map.
struct Stance {
    area: AreaId,
    at: Point,
    name: String,
}

impl State {
    /// What holds when the robot stands where it is sent, and looks where it is told to.
    ///
    /// # Errors
    /// The robot cannot stand there.
    pub(super) fn standing(
        &self,
        to: &Placement<Entity>,
        facing: Option<&Facing<Entity>>,
        relations: &Relations,
        belief: &mut Belief,
    ) -> Result<GoalFact, Error> {
        let stance = match (to.relation, to.and, facing) {
            (Relation::AtWindow(window), ..) => self.at_window(window)?,
            (Relation::Spot(x, y), ..) => self.at_spot(to.anchor, x, y, relations)?,
            (Relation::Between, Some(other), _) => self.between(to.anchor, other)?,
            (side, ..) if side_of(side).is_some() && matches!(to.anchor, Entity::Replica(_)) => {
                self.on_side(side, to.anchor, relations)?
            }
            (Relation::Middle, ..) => self.in_the_middle(to.anchor)?,
            (.., None) => return self.being_at(to.anchor, relations),
            (.., Some(_)) => self.at_named(to.anchor)?,
        };
        let place = match facing {
            None => belief.name_point(stance.name, stance.area, stance.at),
            Some(facing) => self.turned(&stance, facing, belief)?,
        };
        Ok(GoalFact { predicate: predicate::ROBOT_AT_PLACE.to_owned(), args: vec![place] })
    }

    /// What holds when the robot has turned where it stands.
    ///
    /// # Errors
    /// What it is to look at is on another storey, or where it stands itself.
    pub(super) fn turned_here(
        &self,
        facing: &Facing<Entity>,
        belief: &mut Belief,
    ) -> Result<GoalFact, Error> {
        let area = self.robot_area()?.ok_or(RequestError::RobotNowhere)?;
        let stance = Stance { area, at: self.robot()?.1.at, name: String::new() };
        let place = self.turned(&stance, facing, belief)?;
        Ok(GoalFact { predicate: predicate::ROBOT_AT_PLACE.to_owned(), args: vec![place] })
    }

    /// The name of the pose at a stance from which something is looked at.
    fn turned(
        &self,
        stance: &Stance,
        facing: &Facing<Entity>,
        belief: &mut Belief,
    ) -> Result<String, Error> {
        let world = self.world()?;
        let room = world.name(Entity::Area(stance.area));
        let here = world.placement(stance.area).map(|(map, _)| map);
        let unseen =
            |name: &str| Error::from(RequestError::NotAPlace { name: in_both(world, name) });
        let (name, map, seen) = match facing {
            Facing::Thing(thing) => {
                let (map, middle) = self.middle_of(*thing)?;
                (facing_place(world.name(*thing)), Some(map), middle)
            }
            Facing::Window(window) => {
                let window = &self.mind()?.lexicon.windows[*window as usize];
                // Through a wall no window is seen.
                let map = here.filter(|_| window.area == stance.area);
                let room = world.name(Entity::Area(window.area));
                (facing_window(room), map, nalgebra::center(&window.ends.0, &window.ends.1))
            }
            Facing::Wall => {
                let wall =
                    here.and_then(|map| self.wall_near(map, stance)).ok_or_else(|| unseen(room))?;
                (facing_wall(room), here, wall)
            }
        };
        let away = seen - stance.at;
        if map.is_none() || here != map || away.norm() < 1.0 {
            return Err(match facing {
                Facing::Thing(thing) => self.not_a_place(*thing),
                Facing::Window(_) | Facing::Wall => unseen(room),
            });
        }
        let heading = Deg::from_radians(away.y.atan2(away.x));
        Ok(belief.name_view(name, stance.area, stance.at, heading))
    }

    /// The point of the room's walls that is nearest to a stance.
    fn wall_near(&self, map: MapId, stance: &Stance) -> Option<Point> {
        let around = self.around().ok()?;
        let room = around.floor(map).ok()?.scene().areas.get(&stance.area)?;
        let sides = room.prisms.iter().flat_map(|p| p.polygon.edges().zip(p.sides.iter()));
        let walls = sides.filter(|(_, side)| side.permeability == Permeability::Impermeable);
        let points = walls.map(|((a, b), _)| nearest_on_segment(stance.at, a, b));
        points.min_by(|p, q| (p - stance.at).norm().total_cmp(&(q - stance.at).norm()))
    }

    fn not_a_place(&self, entity: Entity) -> Error {
        let name = self.world().map_or("".into(), |world| both(world, entity));
        RequestError::NotAPlace { name }.into()
    }

    /// As near to the middle of a window as the robot can stand.
    fn at_window(&self, window: u32) -> Result<Stance, Error> {
        let world = self.world()?;
        let window = &self.mind()?.lexicon.windows[window as usize];
        let room = world.name(Entity::Area(window.area));
        let unreached =
            || Error::from(RequestError::NotAPlace { name: in_both(world, &window.name) });
        let (map, _) = world.placement(window.area).ok_or_else(unreached)?;
        let at = nalgebra::center(&window.ends.0, &window.ends.1);
        let at = self.around()?.floor(map)?.standing_in(window.area, at).ok_or_else(unreached)?;
        Ok(Stance { area: window.area, at, name: window_place(room) })
    }

    /// As near to a point of a room as the robot can stand, if that is near.
    fn at_spot(
        &self,
        room: Entity,
        x: i32,
        y: i32,
        relations: &Relations,
    ) -> Result<Stance, Error> {
        let name = spot_place(x, y);
        let told = || spot_in_words(f64::from(x), f64::from(y), "; ");
        let none_there = || Error::from(RequestError::NoFloorAt { at: told() });
        let Entity::Area(area) = room else { return Err(self.not_a_place(room)) };
        let (map, _) = self.world()?.placement(area).ok_or_else(none_there)?;
        let wanted = Point::new(f64::from(x), f64::from(y));
        let at = self.around()?.floor(map)?.standing_in(area, wanted).ok_or_else(none_there)?;
        if (at - wanted).norm() > relations.thresholds().robot_spot {
            return Err(none_there());
        }
        Ok(Stance { area, at, name })
    }

    fn between(&self, one: Entity, other: Entity) -> Result<Stance, Error> {
        let world = self.world()?;
        let ((map, a), (there, b)) = (self.middle_of(one)?, self.middle_of(other)?);
        let floor = self.around()?.floor(map)?;
        let middle = nalgebra::center(&a, &b);
        let area = floor.scene().area_at(middle).filter(|_| map == there);
        let area = area.ok_or_else(|| self.not_a_place(other))?;
        let at = floor.standing_in(area, middle).ok_or_else(|| self.not_a_place(other))?;
        Ok(Stance { area, at, name: between_places(world.name(one), world.name(other)) })
    }

    /// On one side of a thing, as near as the robot can stand: of its own front, else as the robot sees it now.
    fn on_side(
        &self,
        side: Relation,
        anchor: Entity,
        relations: &Relations,
    ) -> Result<Stance, Error> {
        let Entity::Replica(id) = anchor else { return Err(self.not_a_place(anchor)) };
        let world = self.world()?;
        let name = world.name(anchor);
        let none_there = || Error::from(RequestError::NoFloorThere { name: in_both(world, name) });
        let (map, middle) = self.middle_of(anchor)?;
        let floor = self.around()?.floor(map)?;
        let (storey, pose) = self.robot()?;
        let seen = (map == storey).then(|| pose.at - middle);
        let front = relations.front(id).or(seen).and_then(|front| front.try_normalize(1e-6));
        let front = front.ok_or_else(none_there)?;
        // The left hand of who sits in it, or of who looks at it.
        let left = match relations.has_front(id) {
            true => Vector::new(-front.y, front.x),
            false => Vector::new(front.y, -front.x),
        };
        let toward = match side {
            Relation::InFrontOf => front,
            Relation::Behind => -front,
            Relation::LeftOf => left,
            _ => -left,
        };
        let placed = floor.scene().replicas.get(&id).ok_or_else(none_there)?;
        let bounds = placed.bounds;
        let half = (bounds.max - bounds.min) / 2.0;
        let reach = half.x * toward.x.abs() + half.y * toward.y.abs();
        let reach = reach + relations.thresholds().robot_aside;
        let area = world.replicas.get(&id).map(|replica| replica.area).ok_or_else(none_there)?;
        let at = floor.standing_in(area, middle + toward * reach).ok_or_else(none_there)?;
        // A wall may leave it only another side.
        let (ahead, aside) = ((at - middle).dot(&toward), (at - middle).perp(&toward).abs());
        if ahead <= aside.min(half.norm()) {
            return Err(none_there());
        }
        let side = side_of(side).unwrap_or_default();
        Ok(Stance { area, at, name: side_place(side, name) })
    }

    /// Of a room; the middle of a thing is not to be stood in.
    fn in_the_middle(&self, entity: Entity) -> Result<Stance, Error> {
        let unreached = || self.not_a_place(entity);
        let Entity::Area(area) = entity else { return Err(unreached()) };
        let world = self.world()?;
        let (map, _) = world.placement(area).ok_or_else(unreached)?;
        let at = self.around()?.floor(map)?.rest_in(area).ok_or_else(unreached)?;
        Ok(Stance { area, at, name: middle_place(world.name(entity)) })
    }

    /// Where the way to it ends, if it is on this storey.
    fn at_named(&self, entity: Entity) -> Result<Stance, Error> {
        if let Entity::Area(_) = entity {
            return self.in_the_middle(entity);
        }
        let around = self.around()?;
        let located = around.locate_entity(entity)?;
        let floor = around.floor(located.map)?;
        let (storey, pose) = self.robot()?;
        let way = || {
            let on_storey = located.map == storey;
            let target = Some(located.target).filter(|_| on_storey)?;
            floor.route(around.uncarried(), pose.at, target, Method::Shortest).ok()?.points.pop()
        };
        let at = way().unwrap_or(located.at);
        let (area, _) = floor.locate(at).ok_or_else(|| self.not_a_place(entity))?;
        Ok(Stance { area, at, name: String::new() })
    }

    /// The middle of a thing; where another place is to be stood at or in.
    fn middle_of(&self, entity: Entity) -> Result<(MapId, Point), Error> {
        let around = self.around()?;
        let Entity::Replica(id) = entity else {
            let located = around.locate_entity(entity)?;
            return Ok((located.map, located.at));
        };
        let world = self.world()?;
        let placed = world.replicas.get(&id).and_then(|replica| world.placement(replica.area));
        let (map, _) = placed.ok_or_else(|| self.not_a_place(entity))?;
        let placed = around.floor(map)?.scene().replicas.get(&id);
        let bounds = placed.ok_or_else(|| self.not_a_place(entity))?.bounds;
        Ok((map, nalgebra::center(&bounds.min, &bounds.max)))
    }
}
