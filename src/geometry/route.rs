//! Routes (W3-W5; paper 1, section 8): from where the robot stands to a point, a place, a thing, a door, a room.
//!
//! Two methods. The paper's searches the network of Passframes depth-first, with backtracking and a check for
//! cycles, and drives through the middles of the borders. The default is the shortest way that the robot's
//! centre can take, pulled taut round every corner.
//!
//! **Invariant**: every point of a route lies in the centre space, so that the robot keeps its clearance on all of it.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashSet};

use crate::map::DoorKind;
use crate::map::World;
use crate::units::{AreaId, Deg, DoorId, PlaceId, Point, Pose, ReplicaId, Vector};

use super::blocked::{Barrier, NoRoute, explain, single};
use super::doors::Doorway;
use super::network::{Marks, Walkable};
use super::obstacle::Blocker;
use super::passframe::{Beyond, PassframeId};
use super::plan::FloorPlan;
use super::scene::Scene;
use super::search::{CellKey, shortest};
use super::strait;

/// Where to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Target {
    Point(Point),
    Place(PlaceId),
    /// In front of a thing, else on any side of it, facing it.
    Replica(ReplicaId),
    /// Before a door, inside one of its Areas, out of the way of its leaves, facing it.
    Door {
        door: DoorId,
        area: AreaId,
    },
    /// Just inside an Area.
    Area(AreaId),
}

/// How a way is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// The shortest way for the robot's centre.
    #[default]
    Shortest,
    /// Depth-first over Passframes, through the middles of their borders.
    Paper,
}

/// A start or goal where the robot does not fit, and the nearest place where it does.
#[derive(Debug, Clone, PartialEq)]
pub struct Moved {
    pub from: Point,
    pub to: Point,
    /// What takes the place, if anything does; else it is a dead zone or too near to a wall.
    pub blocker: Option<Blocker>,
}

thread_local! {
    /// One search after another marks the same list.
    static MARKS: RefCell<Marks> = RefCell::default();
}

/// A way for the robot's centre; what it passes, see [`FloorPlan::passed`].
#[derive(Debug, Clone, PartialEq)]
pub struct Route {
    /// From the start to the goal; two at least.
    pub points: Vec<Point>,
    /// Which way to face at the goal.
    pub heading: Option<Deg>,
    /// In cm.
    pub length: f64,
    pub moved_start: Option<Moved>,
    pub moved_goal: Option<Moved>,
}

/// A place where the robot's centre may be.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Anchor {
    pub(super) at: Point,
    pub(super) cell: CellKey,
    moved: Option<Moved>,
}

impl Anchor {
    pub(super) fn at(at: Point, cell: CellKey) -> Self {
        Self { at, cell, moved: None }
    }
}

/// A goal with the way to face there.
#[derive(Debug, Clone, PartialEq)]
struct Goal {
    anchor: Anchor,
    heading: Option<Deg>,
}

impl FloorPlan {
    /// A route over the whole Map.
    ///
    /// # Errors
    /// [`NoRoute`] with what stands in the way.
    pub fn route(
        &self,
        world: &World,
        from: Point,
        target: Target,
        method: Method,
    ) -> Result<Route, NoRoute> {
        self.route_within(world, from, target, method, None)
    }

    /// Whether the robot can drive from one place to another: what [`Self::route`] would answer, without a way.
    #[must_use]
    pub fn are_joined(&self, from: Point, to: Point) -> bool {
        let region = |p: Point| Some(self.region(self.anchor(p, None, None)?.cell));
        region(from).is_some_and(|r| region(to) == Some(r))
    }

    /// Whether [`Self::route`] would find a way; what stands in it if not is not asked.
    pub(super) fn leads(&self, world: &World, from: Point, target: Target) -> bool {
        let Some(start) = self.anchor(from, None, None) else { return false };
        let goals = self.goals(world, &start, target).unwrap_or_default();
        let region = self.region(start.cell);
        goals.iter().any(|goal| self.region(goal.anchor.cell) == region)
    }

    /// What stands between two places with nothing else before or behind it, what lacks least first.
    pub(super) fn between(&self, world: &World, from: Point, target: Target) -> Vec<Barrier> {
        let Some(start) = self.anchor(from, None, None) else { return Vec::new() };
        let goals = self.goals(world, &start, target).unwrap_or_default();
        let ends: Vec<CellKey> = goals.iter().map(|goal| goal.anchor.cell).collect();
        single(self, world, start.cell, &ends)
    }

    /// A route that stays in the Fragments named.
    ///
    /// # Errors
    /// [`NoRoute`] with what stands in the way.
    pub fn route_within(
        &self,
        world: &World,
        from: Point,
        target: Target,
        method: Method,
        areas: Option<&[AreaId]>,
    ) -> Result<Route, NoRoute> {
        let within: Option<Vec<u32>> = areas.map(|list| {
            let numbers: BTreeSet<u32> =
                list.iter().filter_map(|&a| self.number(a)).map(|n| n as u32).collect();
            numbers.into_iter().collect()
        });
        let start = self.anchor(from, None, within.as_deref()).ok_or(NoRoute::NoFloor)?;
        let goals = self.goals(world, &start, target)?;
        let mut best: Option<Route> = None;
        for goal in &goals {
            if self.region(goal.anchor.cell) != self.region(start.cell) {
                continue;
            }
            let useful = self.network.between(start.cell.0, goal.anchor.cell.0);
            let admitted = |n: &u32| within.as_ref().is_none_or(|w| w.contains(n));
            let useful: Vec<u32> = useful.into_iter().filter(&admitted).collect();
            let leg = |from: &Anchor, to: &Anchor, useful: &[u32]| match method {
                Method::Shortest => self.shortest_points(useful, from, to),
                Method::Paper => self.paper_points(useful, from, to),
            };
            let points = if self.network.straits.is_empty() {
                leg(&start, &goal.anchor, &useful)
            } else {
                strait::way(self, &start, &goal.anchor, |from, to| {
                    let mut useful = self.network.between(from.cell.0, to.cell.0);
                    useful.retain(admitted);
                    leg(from, to, &useful)
                })
            };
            let Some(points) = points else { continue };
            let length = points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
            if best.as_ref().is_none_or(|b| length < b.length) {
                best = Some(Route {
                    heading: goal.heading,
                    length,
                    moved_start: start.moved.clone(),
                    moved_goal: goal.anchor.moved.clone(),
                    points,
                });
            }
        }
        best.ok_or_else(|| {
            let ends: Vec<CellKey> = goals.iter().map(|g| g.anchor.cell).collect();
            explain(self, world, start.cell, &ends)
        })
    }

    /// The least distance from a way to anything solid, in cm; the robot's radius and clearance at least.
    #[must_use]
    pub fn clearance(&self, points: &[Point]) -> f64 {
        let mut least = f64::INFINITY;
        let reach = super::Bounds::of(points.iter().copied()).grown(3.0 * self.reach() + 100.0);
        for fragment in self.fragments_near(&reach) {
            let solid = fragment
                .walls
                .iter()
                .copied()
                .chain(fragment.obstacles().iter().flat_map(|o| o.polygon.edges()));
            for (a, b) in solid.filter(|&(a, b)| super::Bounds::of([a, b]).meets(&reach)) {
                for leg in points.windows(2) {
                    least = least.min(super::doors::segment_distance(leg[0], leg[1], a, b));
                }
            }
        }
        least
    }

    /// Where to stand before a door inside an Area: out of the way of its leaves, facing it.
    #[must_use]
    pub fn stand_before(&self, world: &World, door: DoorId, area: AreaId) -> Option<Pose> {
        let stands = self.door_goals(world, None, door, area);
        stands.first().map(|g| Pose { at: g.anchor.at, heading: g.heading.unwrap_or_default() })
    }

    /// The Area and the Passframe at a point of the floor.
    #[must_use]
    pub fn locate(&self, p: Point) -> Option<(AreaId, Option<PassframeId>)> {
        let holds = |n: &&u32| self.floor(**n).passframe_id_at(p).is_some();
        let on_line = || self.fragments_at(p).iter().find(holds).map(|&n| self.floor(n).area);
        let area = self.area_at(p).or_else(on_line)?;
        let frame = self.fragment(area).and_then(|f| f.passframe_id_at(p));
        Some((area, frame))
    }

    /// Where the robot's centre is when it stands at `p`, or as near as it fits.
    #[must_use]
    pub fn standing_at(&self, p: Point) -> Option<Point> {
        self.anchor(p, None, None).map(|anchor| anchor.at)
    }

    /// Where the robot's centre is when it stands in an Area as near to `p` as it fits, in the largest piece of floor
    /// there: a pocket between things is no place to be sent to.
    #[must_use]
    pub fn standing_in(&self, area: AreaId, p: Point) -> Option<Point> {
        let cells = &self.fragment(area)?.cells;
        let mut pieces: BTreeMap<u32, f64> = BTreeMap::new();
        for cell in cells.cells() {
            *pieces.entry(cells.component(cell)).or_default() += cells.polygon(cell).signed_area();
        }
        let (largest, _) = pieces.into_iter().max_by(|a, b| a.1.total_cmp(&b.1))?;
        let inside = |cell: u32| cells.component(cell) == largest;
        cells.nearest(p, inside).map(|(at, _)| at)
    }

    /// The robot's centre at `p`, or as near as it fits; in a region of the floor if one is named.
    pub(super) fn anchor(
        &self,
        p: Point,
        region: Option<u32>,
        within: Option<&[u32]>,
    ) -> Option<Anchor> {
        let admits = |number: u32| within.is_none_or(|w| w.contains(&number));
        let in_region = |key: CellKey| region.is_none_or(|r| self.region(key) == r);
        let numbers = || (0..self.fragments().len() as u32).filter(|&n| admits(n));
        for number in self.fragments_at(p).iter().copied().filter(|&n| admits(n)) {
            let cell = self.floor(number).cells.locate(p, 1e-6);
            if let Some(cell) = cell.filter(|&c| in_region((number, c))) {
                return Some(Anchor { at: p, cell: (number, cell), moved: None });
            }
        }
        // Prefer the Area that holds the point, even if another one's floor is nearer through a wall.
        let home = self.area_at(p).and_then(|a| self.number(a)).map(|n| n as u32);
        let nearest = |numbers: &mut dyn Iterator<Item = u32>| {
            numbers
                .filter_map(|n| {
                    let (at, cell) = self.floor(n).cells.nearest(p, |c| in_region((n, c)))?;
                    Some(((at - p).norm(), at, (n, cell)))
                })
                .min_by(|a, b| a.0.total_cmp(&b.0))
        };
        let (_, at, cell) = match home {
            Some(n) => nearest(&mut std::iter::once(n).filter(|&n| admits(n)))?,
            None => nearest(&mut numbers())?,
        };
        let blocker = self.floor(cell.0).obstacle_at(p).map(|o| o.blocker);
        Some(Anchor { at, cell, moved: Some(Moved { from: p, to: at, blocker }) })
    }

    /// The goals that serve a target, all as good as each other.
    fn goals(&self, world: &World, start: &Anchor, target: Target) -> Result<Vec<Goal>, NoRoute> {
        let region = Some(self.region(start.cell));
        let found = match target {
            Target::Point(p) => self.point_goals(region, p, None),
            Target::Place(id) => {
                let place = world.places.get(&id).ok_or(NoRoute::NoFloor)?;
                let frame = self
                    .scene()
                    .areas
                    .get(&place.area)
                    .ok_or(NoRoute::OtherMap { area: place.area })?
                    .frame;
                self.point_goals(
                    region,
                    frame.apply(place.at),
                    place.heading.map(|h| h + frame.angle),
                )
            }
            Target::Replica(id) => self.replica_goals(world, start, id)?,
            Target::Door { door, area } => self.door_goals(world, region, door, area),
            Target::Area(area) => self.area_goals(world, start, area)?,
        };
        if found.is_empty() { Err(NoRoute::NoFloor) } else { Ok(found) }
    }

    fn point_goals(&self, region: Option<u32>, p: Point, heading: Option<Deg>) -> Vec<Goal> {
        // Near a place that does not admit the robot, take one that it can reach.
        let exact = self.anchor(p, None, None);
        let anchor = match exact {
            Some(a) if a.moved.is_none() => Some(a),
            other => self.anchor(p, region, None).or(other),
        };
        anchor.map(|anchor| Goal { anchor, heading }).into_iter().collect()
    }

    fn door_goals(
        &self,
        world: &World,
        region: Option<u32>,
        door: DoorId,
        area: AreaId,
    ) -> Vec<Goal> {
        let goals: Vec<Goal> = self
            .doorways_of(door)
            .filter_map(|d| Some((d, d.index_of(area)?)))
            .filter_map(|(doorway, side)| self.stand(world, region, doorway, side))
            .collect();
        if !goals.is_empty() {
            return goals;
        }
        // A door that leads outside joins no two Areas.
        let placed = self.scene().areas.get(&area);
        let outer = placed.and_then(|placed| Doorway::outer(world, placed, door));
        outer.and_then(|d| self.stand(world, region, &d, 0)).into_iter().collect()
    }

    /// A place before a doorway: straight before its middle, clear of the leaves' way.
    fn stand(
        &self,
        world: &World,
        region: Option<u32>,
        doorway: &Doorway,
        side: usize,
    ) -> Option<Goal> {
        let number = self.number(doorway.areas[side])? as u32;
        let cells = &self.floor(number).cells;
        let reach = self.reach();
        let door = doorway.door.and_then(|d| world.doors.get(&d));
        let swings_here =
            door.is_some_and(|d| d.kind == DoorKind::Hinged) && doorway.opens_to == side;
        let swept = door
            .filter(|_| swings_here)
            .map_or_else(Vec::new, |d| doorway.leaves(d).swept((0.0, 100.0)));
        let is_clear = |p: Point| {
            swept.iter().all(|s| !s.contains(p, 0.0) && s.border_distance(p) >= reach - 1e-6)
        };
        let admits = |cell: u32| region.is_none_or(|r| self.region((number, cell)) == r);
        let try_at = |p: Point| {
            let cell = cells.locate(p, 1e-6).filter(|&c| admits(c))?;
            is_clear(p).then_some((p, cell))
        };
        let along = (doorway.line().1 - doorway.line().0) / doorway.width().max(1e-9);
        let steps = (0..=40).map(|k| reach + 5.0 + 5.0 * f64::from(k));
        let shifts: [f64; 9] = [0.0, 15.0, -15.0, 30.0, -30.0, 50.0, -50.0, 75.0, -75.0];
        let spot = steps
            .flat_map(|d| shifts.map(|s| (d, s)))
            .filter(|(d, s)| s.abs() <= 2.0 * d)
            .collect::<Vec<_>>();
        let mut spots = spot;
        // The nearer the better; a step aside costs a little more than one back.
        spots.sort_by(|a, b| (a.0 + 1.2 * a.1.abs()).total_cmp(&(b.0 + 1.2 * b.1.abs())));
        let (at, cell) = spots
            .into_iter()
            .find_map(|(d, s)| try_at(doorway.before(side, d) + along * s))
            .or_else(|| cells.nearest(doorway.before(side, reach + 5.0), admits))?;
        let heading = facing(at, doorway.middle());
        Some(Goal { anchor: Anchor { at, cell: (number, cell), moved: None }, heading })
    }

    fn area_goals(
        &self,
        world: &World,
        start: &Anchor,
        area: AreaId,
    ) -> Result<Vec<Goal>, NoRoute> {
        let number = self.number(area).ok_or(NoRoute::OtherMap { area })? as u32;
        if start.cell.0 == number {
            return Ok(vec![Goal {
                anchor: Anchor { moved: None, ..start.clone() },
                heading: None,
            }]);
        }
        let region = self.region(start.cell);
        let mut goals: Vec<Goal> = self
            .doorways()
            .iter()
            .filter_map(|d| Some((d, d.index_of(area)?)))
            .filter_map(|(d, side)| {
                let mut goal = self.stand(world, Some(region), d, side)?;
                // One enters looking ahead.
                goal.heading = goal.heading.map(|h| h + Deg::of(180.0));
                Some(goal)
            })
            .collect();
        if goals.is_empty() {
            let middle = self.scene().areas[&area].prisms.first().map(|p| p.polygon.centroid());
            goals = middle.map_or_else(Vec::new, |p| self.point_goals(None, p, None));
        }
        Ok(goals)
    }

    /// Before the front of a thing; else before any of its sides; else as near as can be.
    fn replica_goals(
        &self,
        world: &World,
        start: &Anchor,
        id: ReplicaId,
    ) -> Result<Vec<Goal>, NoRoute> {
        let Some(placed) = self.scene().replicas.get(&id) else {
            let area = world.replicas.get(&id).map(|r| r.area).ok_or(NoRoute::NoFloor)?;
            return Err(NoRoute::OtherMap { area });
        };
        let region = self.region(start.cell);
        let object = &world.objects[&world.replicas[&id].object];
        let front = object.front.as_ref().and_then(|f| {
            let item = object.items.iter().position(|i| i.id == f.item)?;
            let (side, _) = world.orthoframe_of(&object.items[item]).side(&f.side)?;
            placed.prisms.get(item)?.polygon.edges().nth(side)
        });
        let before = |(a, b): (Point, Point)| self.before_face(region, a, b);
        if let Some(goals) = front.map(before).filter(|g| !g.is_empty()) {
            return Ok(goals);
        }
        let sides: Vec<Goal> = placed
            .prisms
            .iter()
            .flat_map(|p| p.polygon.edges().collect::<Vec<_>>())
            .flat_map(before)
            .collect();
        if !sides.is_empty() {
            return Ok(sides);
        }
        let middle = nalgebra::center(&placed.bounds.min, &placed.bounds.max);
        let anchor = self.anchor(middle, Some(region), None).filter(|a| {
            self.floor(a.cell.0).area == placed.area
                && (a.at - middle).norm() < 150.0 + self.reach()
        });
        let anchor = anchor.or_else(|| self.anchor(middle, None, None));
        Ok(anchor
            .map(|a| Goal { heading: facing(a.at, middle), anchor: Anchor { moved: None, ..a } })
            .into_iter()
            .collect())
    }

    /// The best place to stand before a face, facing it: at its middle, close.
    fn before_face(&self, region: u32, a: Point, b: Point) -> Vec<Goal> {
        let Some(along) = (b - a).try_normalize(1e-6) else { return Vec::new() };
        let out = Vector::new(along.y, -along.x);
        let length = (b - a).norm();
        for back in [3.0, 8.0, 15.0, 25.0, 40.0] {
            for share in [0.5, 0.35, 0.65, 0.2, 0.8, 0.05, 0.95] {
                let face = a + along * (length * share);
                let at = face + out * (self.reach() + back);
                for &number in self.fragments_at(at) {
                    let Some(cell) = self.floor(number).cells.locate(at, 1e-6) else { continue };
                    if self.region((number, cell)) == region && self.is_open_between(at, face) {
                        let anchor = Anchor { at, cell: (number, cell), moved: None };
                        return vec![Goal {
                            anchor,
                            heading: Some(Deg::from_radians((-out.y).atan2(-out.x))),
                        }];
                    }
                }
            }
        }
        Vec::new()
    }

    /// No wall stands between two points.
    fn is_open_between(&self, a: Point, b: Point) -> bool {
        let reach = super::Bounds::of([a, b]);
        let stop = b + (a - b) * 0.02;
        self.fragments_near(&reach)
            .flat_map(|f| f.walls.iter().copied())
            .filter(|&(u, v)| super::Bounds::of([u, v]).meets(&reach))
            .all(|(u, v)| super::doors::segment_distance(a, stop, u, v) > 0.0)
    }

    fn shortest_points(&self, within: &[u32], start: &Anchor, goal: &Anchor) -> Option<Vec<Point>> {
        MARKS.with_borrow_mut(|marks| {
            let walkable = Walkable::toward(self, within, goal.cell, marks);
            shortest(&walkable, start.at, start.cell, goal.at, goal.cell).map(|way| way.points)
        })
    }

    /// The paper's way: a chain found depth-first, then the middles of the borders crossed. Where the straight
    /// line between two of them would bring the robot too near to something, it is bent round that.
    fn paper_points(&self, within: &[u32], start: &Anchor, goal: &Anchor) -> Option<Vec<Point>> {
        let frame = |a: &Anchor| {
            let floor = self.floor(a.cell.0);
            let cell = floor.frames.locate(a.at, 1e-3);
            cell.or_else(|| floor.frames.nearest(a.at, |_| true).map(|n| n.1))
                .map(|c| (a.cell.0, c))
        };
        let (from, to) = (frame(start)?, frame(goal)?);
        let mut visited = HashSet::from([from]);
        let mut chain: Vec<(CellKey, Vec<(Point, CellKey)>)> =
            vec![(from, self.next_frames(within, from, goal.at))];
        let mut middles: Vec<Point> = Vec::new();
        while let Some((frame, untried)) = chain.last_mut() {
            if *frame == to {
                break;
            }
            // Neighbours are kept with the most promising last.
            match untried.pop() {
                Some((middle, next)) if visited.insert(next) => {
                    middles.push(middle);
                    let further = self.next_frames(within, next, goal.at);
                    chain.push((next, further));
                }
                Some(_) => {}
                None => {
                    chain.pop();
                    middles.pop();
                }
            }
        }
        chain.last()?;
        let mut points = vec![start.at];
        for &next in middles.iter().chain([&goal.at]) {
            let from = *points.last().expect("the start is there");
            if (next - from).norm() < 1e-9 {
                continue;
            }
            let here = self.fragments_at(from).iter().map(|&n| self.floor(n));
            let straight = here.into_iter().any(|f| f.cells.sees(from, next));
            if straight {
                points.push(next);
            } else {
                let (a, b) = (self.anchor(from, None, None)?, self.anchor(next, None, None)?);
                let way = self.shortest_points(within, &a, &b)?;
                points.extend(way.into_iter().skip(1));
            }
        }
        if points.len() == 1 {
            points.push(goal.at);
        }
        Some(points)
    }

    /// The Passframes that can be entered from one, each over the middle of the border, the nearest to the goal last.
    fn next_frames(&self, within: &[u32], key: CellKey, goal: Point) -> Vec<(Point, CellKey)> {
        let floor = self.floor(key.0);
        let mut next = Vec::new();
        for border in &floor.passframes()[key.1 as usize].borders {
            let Some((a, b)) = border.crossing else { continue };
            let middle = nalgebra::center(&a, &b);
            match border.beyond {
                Beyond::Passframe(_) => next.push((middle, (key.0, border.across))),
                Beyond::Doorway { area, .. } => {
                    let Some(number) = self.number(area).map(|n| n as u32) else { continue };
                    let admitted = within.binary_search(&number).is_ok();
                    let cell = self.floor(number).frames.locate(middle, 0.01);
                    let crosses = self.floor(number).cells.locate(middle, 0.01).is_some();
                    if let (true, true, Some(cell)) = (admitted, crosses, cell) {
                        next.push((middle, (number, cell)));
                    }
                }
                _ => {}
            }
        }
        next.sort_by(|a, b| (b.0 - goal).norm().total_cmp(&(a.0 - goal).norm()));
        next
    }
}

fn facing(from: Point, to: Point) -> Option<Deg> {
    let v = to - from;
    (v.norm() > 1e-9).then(|| Deg::from_radians(v.y.atan2(v.x)))
}

/// The distinct things among blockers, each with its part that is in the way: of several the lowest.
pub(super) fn things(scene: &Scene, blockers: &[Blocker]) -> Vec<Blocker> {
    let bottom = |b: &Blocker| match *b {
        Blocker::Replica { replica, item } => {
            let prisms = scene.replicas.get(&replica).map_or(&[][..], |r| &r.prisms);
            prisms.iter().find(|p| p.item == item).map_or(0.0, |p| p.bottom)
        }
        _ => 0.0,
    };
    let whole = |b: &Blocker| match *b {
        Blocker::Replica { replica, .. } => Blocker::Replica { replica, item: 0 },
        Blocker::DoorLeaf { door, .. } => Blocker::DoorLeaf { door, leaf: 0 },
        other => other,
    };
    let mut parts: BTreeMap<Blocker, Blocker> = BTreeMap::new();
    for part in blockers {
        let kept = parts.entry(whole(part)).or_insert(*part);
        if bottom(part) < bottom(kept) {
            *kept = *part;
        }
    }
    parts.into_iter().map(|(whole, part)| if bottom(&part) > 0.0 { part } else { whole }).collect()
}
