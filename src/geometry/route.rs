//! Routes (W3-W5; paper 1, section 8): from where the robot stands to a point, a place, a thing, a door, a room.
//!
//! Two methods. The paper's searches the network of Passframes depth-first, with backtracking and a check for
//! cycles, and drives through the middles of the borders. The default is the shortest way that the robot's
//! centre can take, pulled taut round every corner.
//!
//! **Invariant**: every point of a route lies in the centre space, so that the robot keeps its clearance on all of it.

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet, HashSet};

use crate::map::{DoorState, World, Zone, ZoneKind};
use crate::units::{
    AreaId, Deg, DoorId, Gather as _, InOrder as _, PlaceId, Point, ReplicaId, ZoneId,
};

use super::anchor::{Anchor, Moved};
use super::blocked::{Barrier, NoRoute, explain, single};
use super::cells::CellKey;
use super::lawful::{Ground, Rules, paces};
use super::passframe::{Beyond, PassframeId};
use super::plan::FloorPlan;
use super::search::shortest;
use super::strait;
use super::walkable::{Marks, Walkable};
use super::zone::PlacedZone;

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

/// Of so many zones on a way it is asked whether one alone bars it.
const MOST_ASKED: usize = 8;

/// How a way is looked for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
pub enum Method {
    /// The shortest way for the robot's centre.
    #[default]
    Shortest,
    /// Depth-first over Passframes, through the middles of their borders.
    Paper,
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
        let goals = self.goals(world, &start, target, None).unwrap_or_default();
        let region = self.region(start.cell);
        goals.iter().any(|goal| self.region(goal.anchor.cell) == region)
    }

    /// What stands between two places with nothing else before or behind it, what lacks least first.
    pub(super) fn between(&self, world: &World, from: Point, target: Target) -> Vec<Barrier> {
        let Some(start) = self.anchor(from, None, None) else { return Vec::new() };
        let goals = self.goals(world, &start, target, None).unwrap_or_default();
        let ends: Vec<CellKey> = goals.iter().map(|goal| goal.anchor.cell).collect();
        single(self, world, start.cell, &ends)
    }

    /// A route that stays in the Fragments named.
    ///
    /// From within a zone that is to be kept out of, or so near that the robot stands in it, it first leads out of that, by
    /// the shortest way.
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
                list.iter().filter_map(|&a| self.number(a)).map(|n| n as u32).gather();
            numbers.into_iter().collect()
        });
        let (reach, has_shut) = (self.reach(), self.zones.iter().any(|z| z.kind.is_shut()));
        let is_in = |zone: &&PlacedZone| zone.kind.is_shut() && zone.contains(from, reach);
        let found = match self.zones.iter().any(|zone| is_in(&zone)) && self.fitting(from).is_none()
        {
            true => self.route_out(world, from, target, method, within.as_deref()),
            false => self.anchor(from, None, within.as_deref()).ok_or(NoRoute::NoFloor).and_then(
                |start| self.route_from(world, &start, target, method, within.as_deref()),
            ),
        };
        found.map_err(|no| if has_shut { self.zones_between(world, from, target, no) } else { no })
    }

    /// A route out of the zones that the robot stands in, and on.
    fn route_out(
        &self,
        world: &World,
        from: Point,
        target: Target,
        method: Method,
        within: Option<&[u32]>,
    ) -> Result<Route, NoRoute> {
        let (mut points, moved, exit) =
            self.way_out(world, from, within).ok_or(NoRoute::NoFloor)?;
        let on = self.route_from(world, &exit, target, method, within)?;
        points.extend(on.points.into_iter().skip(1));
        let length = super::search::length(&points);
        Ok(Route { points, length, moved_start: moved, ..on })
    }

    /// The shortest way out of the zones that a place lies in.
    fn way_out(
        &self,
        world: &World,
        from: Point,
        within: Option<&[u32]>,
    ) -> Option<(Vec<Point>, Option<Moved>, Anchor)> {
        let open = self.opened(world);
        let start = open.anchor(from, None, within)?;
        let reach = self.reach();
        let shut: Vec<&PlacedZone> = self.zones.iter().filter(|z| z.kind.is_shut()).collect();
        let near = shut.iter().fold(super::Bounds::EMPTY, |b, z| b.union(&z.bounds()));
        let mut exits: Vec<(f64, Anchor)> = Vec::new();
        let admits = |n: &u32| within.is_none_or(|w| w.contains(n));
        for number in (0..self.fragments().len() as u32).filter(admits) {
            let floor = self.floor(number);
            if !floor.bounds.meets(&near.grown(reach + 1.0)) {
                continue;
            }
            for cell in floor.cells.cells() {
                for (edge, across) in floor.cells.across(cell).iter().enumerate() {
                    let (a, b) = floor.cells.edge(cell, edge);
                    let at = super::nearest_on_segment(start.at, a, b);
                    let is_rim = across == super::mesh::NONE
                        && shut.iter().any(|zone| zone.contains(at, reach + 1.0));
                    if is_rim {
                        exits.push(((at - start.at).norm(), Anchor::at(at, (number, cell))));
                    }
                }
            }
        }
        exits.order_by(|a, b| a.0.total_cmp(&b.0));
        let mut best: Option<(f64, Vec<Point>, Anchor)> = None;
        for (least, exit) in exits {
            if best.as_ref().is_some_and(|known| known.0 <= least) {
                break;
            }
            let Some(end) = open.anchor(exit.at, Some(open.region(start.cell)), within) else {
                continue;
            };
            let useful = open.network.between(start.cell.0, end.cell.0);
            let Some(mut points) = open.shortest_points(&useful, &start, &end) else { continue };
            // The two floors are cut on grids of their own.
            if let Some(last) = points.last_mut() {
                *last = exit.at;
            }
            let length = super::search::length(&points);
            if best.as_ref().is_none_or(|known| length < known.0) {
                best = Some((length, points, exit));
            }
        }
        best.map(|(_, points, exit)| (points, start.moved, exit))
    }

    /// The floor as the search for lawful ways wants it.
    fn ground(&self) -> Ground<'_> {
        let portals = self.network.portals.iter().flatten();
        let line = |p: &super::network::Portal| (p.from.0, p.to.0, (p.right, p.left));
        Ground {
            floors: &self.fragments,
            doorways: portals.map(line).collect(),
            reach: self.reach(),
        }
    }

    /// A way in pieces, each with the speed in cm/s that slow zones allow on it; none where they say nothing.
    #[must_use]
    pub fn paces(&self, points: &[Point]) -> Vec<(Vec<Point>, Option<f64>)> {
        paces(&self.zones, points)
    }

    /// Whether the robot's centre may be at a place.
    #[must_use]
    pub fn fits(&self, p: Point) -> bool {
        self.fitting(p).is_some()
    }

    /// The robot's centre in the cell that holds it, if it fits there.
    pub(super) fn fitting(&self, p: Point) -> Option<CellKey> {
        let holds = |&n: &u32| Some((n, self.floor(n).cells.locate(p, 1e-6)?));
        self.fragments_at(p).iter().find_map(holds)
    }

    /// The zones of these kinds to which a way comes nearer than the robot keeps from things, in the order of their ids.
    pub(super) fn touched(
        &self,
        points: &[Point],
        is_wanted: impl Fn(ZoneKind) -> bool,
    ) -> Vec<ZoneId> {
        let reach = self.reach();
        let touches = |zone: &&PlacedZone| {
            zone.polygons.iter().any(|polygon| {
                points.windows(2).any(|leg| {
                    polygon.contains(leg[0], 0.0)
                        || polygon.edges().any(|(a, b)| {
                            super::apart::segment_distance(leg[0], leg[1], a, b) < reach
                        })
                })
            })
        };
        let zones = self.zones.iter().filter(|zone| is_wanted(zone.kind)).filter(touches);
        zones.map(|zone| zone.id).collect()
    }

    /// The same floor as if nothing were shut by a zone.
    fn opened(&self, world: &World) -> Self {
        let is_kept =
            |zone: &Zone| !zone.kind.is_shut() && self.zones.iter().any(|own| own.id == zone.id);
        self.with_zones(world, is_kept)
    }

    /// Why there is no way, where that may be because of zones: those that a way without them would enter.
    fn zones_between(&self, world: &World, from: Point, target: Target, no: NoRoute) -> NoRoute {
        let open = self.opened(world);
        let (mut barriers, way) = match open.route(world, from, target, Method::Shortest) {
            Ok(way) => (Vec::new(), way),
            Err(NoRoute::Blocked { barriers }) => {
                // Beyond the doors that are shut there may be zones.
                let doors = barriers.iter().filter_map(|b| match b {
                    Barrier::Door { door, .. } => Some((*door, DoorState::OPEN)),
                    _ => None,
                });
                let opened = open.with_doors(world, &doors.collect());
                match opened.route(world, from, target, Method::Shortest) {
                    Ok(way) => (barriers, way),
                    Err(_) => return NoRoute::Blocked { barriers },
                }
            }
            Err(_) => return no,
        };
        let mut ends = way.points;
        ends.extend(self.point_of(world, target));
        let mut zones = self.touched(&ends, ZoneKind::is_shut);
        // A way may come near to others than the one that bars it.
        if zones.len() > 1 && barriers.is_empty() {
            let alone = |gone: &ZoneId| {
                let is_kept = |zone: &Zone| {
                    zone.id != *gone && self.zones.iter().any(|own| own.id == zone.id)
                };
                self.with_zones(world, is_kept).leads(world, from, target)
            };
            if let Some(only) = zones.iter().copied().take(MOST_ASKED).find(alone) {
                zones = vec![only];
            }
        }
        if zones.is_empty() {
            return if barriers.is_empty() { no } else { NoRoute::Blocked { barriers } };
        }
        barriers.extend(zones.into_iter().map(|zone| Barrier::Zone { zone }));
        NoRoute::Blocked { barriers }
    }

    /// The point that a target is, where it is one.
    pub(super) fn point_of(&self, world: &World, target: Target) -> Option<Point> {
        match target {
            Target::Point(p) => Some(p),
            Target::Place(id) => {
                let place = world.places.get(&id)?;
                Some(self.scene().areas.get(&place.area)?.frame.apply(place.at))
            }
            Target::Replica(id) => {
                let bounds = self.scene().replicas.get(&id)?.bounds;
                Some(nalgebra::center(&bounds.min, &bounds.max))
            }
            Target::Door { .. } | Target::Area(_) => None,
        }
    }

    /// A route from where the robot fits.
    fn route_from(
        &self,
        world: &World,
        start: &Anchor,
        target: Target,
        method: Method,
        within: Option<&[u32]>,
    ) -> Result<Route, NoRoute> {
        let goals = self.goals(world, start, target, within)?;
        let rules = Rules::of(&self.zones, self.robot().speed);
        let mut best: Option<(f64, Route)> = None;
        let mut against: Option<Vec<Point>> = None;
        for goal in &goals {
            if self.region(goal.anchor.cell) != self.region(start.cell) {
                continue;
            }
            let admitted = |n: &u32| within.is_none_or(|w| w.contains(n));
            let leg = |from: &Anchor, to: &Anchor| {
                let mut useful = self.network.between(from.cell.0, to.cell.0);
                useful.retain(admitted);
                match method {
                    Method::Shortest => self.shortest_points(&useful, from, to),
                    Method::Paper => self.paper_points(&useful, from, to),
                }
            };
            // Straits are single legs, which keep to the rules or are none.
            let way = |leg: &dyn Fn(&Anchor, &Anchor) -> Option<Vec<Point>>| {
                if self.network.straits.is_empty() {
                    leg(start, &goal.anchor)
                } else {
                    strait::way(self, start, &goal.anchor, leg)
                }
            };
            let points = match &rules {
                None => way(&leg),
                Some(rules) => {
                    let lawful = |from: &Anchor, to: &Anchor| {
                        // A way round what a zone forbids or slows down may lead into a room and out again.
                        let all = 0..self.fragments().len() as u32;
                        let all: Vec<u32> = all.filter(admitted).collect();
                        let ends = ((from.at, from.cell.0), (to.at, to.cell.0));
                        self.ground().lawful(rules, &all, ends, &leg(from, to)?)
                    };
                    let kept = way(&lawful).filter(|points| rules.cost_of(points).is_some());
                    if kept.is_none() && against.is_none() {
                        against = way(&leg);
                    }
                    kept
                }
            };
            let Some(points) = points else { continue };
            let length = points.windows(2).map(|p| (p[1] - p[0]).norm()).sum();
            let cost = rules.as_ref().and_then(|rules| rules.cost_of(&points)).unwrap_or(length);
            if best.as_ref().is_none_or(|(least, _)| cost < *least) {
                let route = Route {
                    heading: goal.heading,
                    length,
                    moved_start: start.moved.clone(),
                    moved_goal: goal.anchor.moved.clone(),
                    points,
                };
                best = Some((cost, route));
            }
        }
        best.map(|(_, route)| route).ok_or_else(|| {
            if let Some(points) = against {
                let is_one_way = |kind| matches!(kind, ZoneKind::OneWay { .. });
                let zones = self.touched(&points, is_one_way).into_iter();
                return NoRoute::Blocked {
                    barriers: zones.map(|zone| Barrier::Zone { zone }).collect(),
                };
            }
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
                    least = least.min(super::apart::segment_distance(leg[0], leg[1], a, b));
                }
            }
        }
        least
    }

    /// The Area and the Passframe at a point of the floor.
    #[must_use]
    pub fn locate(&self, p: Point) -> Option<(AreaId, Option<PassframeId>)> {
        let holds = |n: &&u32| self.covered(**n).passframe_id_at(p).is_some();
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
        self.rest(self.number(area)? as u32, p).map(|(at, _)| at)
    }

    /// As [`Self::standing_in`], with the cell.
    pub(super) fn rest(&self, number: u32, p: Point) -> Option<(Point, u32)> {
        let cells = &self.floor(number).cells;
        let largest = *self.pieces(number).first()?;
        cells.nearest(p, |cell| cells.component(cell) == largest)
    }

    /// The same in every piece of floor of a Fragment, the largest first.
    pub(super) fn rests(&self, number: u32, p: Point) -> Vec<Point> {
        let cells = &self.floor(number).cells;
        let in_piece = |piece| cells.nearest(p, |cell| cells.component(cell) == piece);
        self.pieces(number).into_iter().filter_map(in_piece).map(|(at, _)| at).collect()
    }

    /// The pieces of floor of a Fragment, the largest first.
    fn pieces(&self, number: u32) -> Vec<u32> {
        let cells = &self.floor(number).cells;
        let mut areas: BTreeMap<u32, f64> = BTreeMap::new();
        for cell in cells.cells() {
            *areas.entry(cells.component(cell)).or_default() += cells.polygon(cell).signed_area();
        }
        let mut pieces: Vec<(u32, f64)> = areas.into_iter().collect();
        // Of equals the later one comes first.
        pieces.reverse();
        pieces.order_by(|a, b| b.1.total_cmp(&a.1));
        pieces.into_iter().map(|(piece, _)| piece).collect()
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
        next.order_by(|a, b| (b.0 - goal).norm().total_cmp(&(a.0 - goal).norm()));
        next
    }
}
