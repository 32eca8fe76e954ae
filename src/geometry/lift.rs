//! Ways between Maps (M6): over the floors by routes, from floor to floor by lift.
//!
//! The uppermost level of the network: start, goal and the lifts' stops are nodes; a route over one Map is an edge
//! as long as it is, a ride one as long as the robot could have driven meanwhile. A lift opens its doors where it is
//! called, so that closed ones bar no way from Map to Map, nor into a cabin. Stairs, whose stops are Areas
//! of a type with the trait `stairs`, are no way for a robot on wheels.
//!
//! **Invariant**: legs and rides alternate; a leg begins where the ride before it ends, in the middle of the stop.

use std::borrow::Cow;
use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use petgraph::graph::{DiGraph, NodeIndex};

use crate::map::{DoorState, LiftStop, World};
use crate::units::{AreaId, DoorId, Gather as _, MapId, Point};

use super::blocked::NoRoute;
use super::chain::Passed;
use super::opening::Opening;
use super::plan::FloorPlan;
use super::route::{Method, Route, Target};
use super::site::DoorStates;

/// Seconds until a lift comes when it is called.
pub const LIFT_WAIT: f64 = 20.0;
/// Seconds that a lift takes to shut its doors, start and stop.
const LIFT_STOP: f64 = 10.0;
/// How fast a lift rides, in cm a second.
const LIFT_SPEED: f64 = 100.0;

/// A ride from one stop to another.
#[derive(Debug, Clone, PartialEq)]
pub struct Ride {
    /// Index in [`crate::map::Domain::lifts`].
    pub lift: usize,
    pub from: AreaId,
    pub to: AreaId,
    /// In cm; negative downwards.
    pub rise: f64,
}

impl Ride {
    /// How long it takes, from the call on, in seconds.
    #[must_use]
    pub fn seconds(&self) -> f64 {
        LIFT_WAIT + LIFT_STOP + self.rise.abs() / LIFT_SPEED
    }
}

/// A way over one Map, and the ride that follows it; none after the last.
#[derive(Debug, Clone, PartialEq)]
pub struct Leg {
    pub map: MapId,
    pub route: Route,
    /// By the doors as they were on the way.
    pub passed: Passed,
    pub ride: Option<Ride>,
}

/// A place where a lift can be boarded and left.
struct Stop {
    lift: usize,
    area: AreaId,
    map: MapId,
    at: Point,
    height: f64,
}

/// Where a way over several Maps fails: a leg that would be needed, and why it is barred.
#[derive(Debug, Clone, PartialEq)]
pub struct NoWay {
    pub map: MapId,
    pub from: Point,
    pub target: Target,
    pub why: NoRoute,
}

enum Edge {
    Drive(Box<Route>),
    Ride(Ride),
}

/// The shortest way between places of any Maps, by as many lifts as it takes.
///
/// # Errors
/// The leg that fails: [`NoRoute::OtherMap`] when no lift links the Maps; else what bars the way to the lift where it
/// is the start that is cut off, from the lift where it is the goal, or between lifts; of several the least barred.
pub fn across(
    world: &World,
    plans: &BTreeMap<MapId, FloorPlan>,
    (map, from): (MapId, Point),
    (goal_map, target): (MapId, Target),
    method: Method,
) -> Result<Vec<Leg>, Box<NoWay>> {
    let route_on = |plan: &FloorPlan, map: MapId, from: Point, target: Target| {
        plan.route(world, from, target, method)
            .map_err(|why| Box::new(NoWay { map, from, target, why }))
    };
    if map == goal_map {
        let no_floor = || Box::new(NoWay { map, from, target, why: NoRoute::NoFloor });
        let plan = plans.get(&map).ok_or_else(no_floor)?;
        // Into a cabin and out of it.
        let leg_on = |plan: &FloorPlan| -> Result<Leg, Box<NoWay>> {
            let route = route_on(plan, map, from, target)?;
            Ok(Leg { map, passed: plan.passed(&route), route, ride: None })
        };
        let leg = leg_on(plan).or_else(|no| match plan.with_lifts_open(world) {
            Cow::Owned(called) => leg_on(&called).or(Err(no)),
            Cow::Borrowed(_) => Err(no),
        })?;
        return Ok(vec![leg]);
    }
    let plans: BTreeMap<MapId, Cow<'_, FloorPlan>> =
        plans.iter().map(|(&map, plan)| (map, plan.with_lifts_open(world))).gather();
    let drive_on = |map: MapId, from: Point, target: Target| match plans.get(&map) {
        Some(plan) => route_on(plan, map, from, target),
        None => Err(Box::new(NoWay { map, from, target, why: NoRoute::NoFloor })),
    };
    let stops = stops(world, &plans);
    let mut graph = DiGraph::<MapId, (f64, Edge)>::new();
    let nodes: Vec<NodeIndex> = stops.iter().map(|s| graph.add_node(s.map)).collect();
    let (start, goal) = (graph.add_node(map), graph.add_node(goal_map));
    let mut barred: Vec<(NodeIndex, NodeIndex, Box<NoWay>)> = Vec::new();
    let mut drive = |graph: &mut DiGraph<MapId, (f64, Edge)>, a, b, from, target| match drive_on(
        graph[a], from, target,
    ) {
        Ok(route) => {
            graph.add_edge(a, b, (route.length, Edge::Drive(Box::new(route))));
        }
        Err(no) => barred.push((a, b, no)),
    };
    for (i, one) in stops.iter().enumerate() {
        if one.map == map {
            drive(&mut graph, start, nodes[i], from, Target::Point(one.at));
        }
        if one.map == goal_map {
            drive(&mut graph, nodes[i], goal, one.at, target);
        }
        for (j, other) in stops.iter().enumerate().filter(|(j, _)| *j != i) {
            if one.lift == other.lift {
                let rise = other.height - one.height;
                let ride = Ride { lift: one.lift, from: one.area, to: other.area, rise };
                let meanwhile = ride.seconds() * world.robot.speed;
                graph.add_edge(nodes[i], nodes[j], (meanwhile, Edge::Ride(ride)));
            } else if one.map == other.map {
                drive(&mut graph, nodes[i], nodes[j], one.at, Target::Point(other.at));
            }
        }
    }
    let cost = |e: petgraph::graph::EdgeReference<'_, (f64, Edge)>| e.weight().0;
    let Some((_, way)) = petgraph::algo::astar(&graph, start, |n| n == goal, cost, |_| 0.0) else {
        let linked = stops.iter().any(|s| s.map == map) && stops.iter().any(|s| s.map == goal_map);
        let place = |(a, b, no): &(NodeIndex, NodeIndex, Box<NoWay>)| {
            let cut_off = |n: NodeIndex| graph.neighbors_undirected(n).next().is_none();
            let at = if *a == start && cut_off(start) {
                0
            } else if *b == goal && cut_off(goal) {
                1
            } else {
                2
            };
            (at, no.why.barriers().len())
        };
        return Err(barred.into_iter().filter(|_| linked).min_by_key(place).map_or_else(
            || {
                let area = area_of(world, target, goal_map);
                let why = NoRoute::OtherMap { area };
                Box::new(NoWay { map: goal_map, from, target, why })
            },
            |(_, _, no)| no,
        ));
    };
    let mut legs = Vec::new();
    for step in way.windows(2) {
        let on = graph[step[0]];
        // Of parallel edges the cheapest was taken.
        let edge = graph
            .edges_connecting(step[0], step[1])
            .min_by(|a, b| a.weight().0.total_cmp(&b.weight().0))
            .map(|e| &e.weight().1);
        match edge {
            Some(Edge::Drive(route)) => {
                let (route, passed) = (Route::clone(route), plans[&on].passed(route));
                legs.push(Leg { map: on, route, passed, ride: None });
            }
            Some(Edge::Ride(ride)) => {
                if let Some(leg) = legs.last_mut() {
                    leg.ride = Some(ride.clone());
                }
            }
            None => {}
        }
    }
    Ok(legs)
}

/// The Areas where lifts stop, with the lift's index.
fn cabins(world: &World) -> impl Iterator<Item = (usize, AreaId)> + '_ {
    let lifts = world.domain.lifts.iter().map(|(_, stops)| stops).enumerate();
    let is_lift = move |stops: &[LiftStop]| {
        !stops.iter().any(|stop| world.area_has_trait(stop.area, "stairs"))
    };
    lifts
        .filter(move |(_, stops)| is_lift(stops))
        .flat_map(|(lift, stops)| stops.iter().map(move |stop| (lift, stop.area)))
}

fn stops(world: &World, plans: &BTreeMap<MapId, Cow<'_, FloorPlan>>) -> Vec<Stop> {
    let mut found = Vec::new();
    for (lift, area) in cabins(world) {
        let Some((map, frame)) = world.placement(area) else { continue };
        let floor = world.domain.maps.iter().find(|m| m.map == map);
        let height = floor.map_or(0.0, |m| m.frame.z.get()) + frame.z.get();
        // A cabin in which the robot does not fit is no stop.
        let Some(at) = plans.get(&map).and_then(|p| p.rest_in(area)) else { continue };
        found.push(Stop { lift, area, map, at, height });
    }
    found
}

/// The Area that a target lies in; that of the Map's base for a point.
fn area_of(world: &World, target: Target, map: MapId) -> AreaId {
    let base = || world.maps[&map].items.first().map_or(AreaId(0), |i| i.area);
    match target {
        Target::Area(area) | Target::Door { area, .. } => area,
        Target::Place(id) => world.places.get(&id).map_or_else(base, |p| p.area),
        Target::Replica(id) => world.replicas.get(&id).map_or_else(base, |r| r.area),
        Target::Point(_) => base(),
    }
}

impl FloorPlan {
    /// The same floor with the closed doors of lifts open, as they are where a lift was called; locked ones stay.
    #[must_use]
    pub fn with_lifts_open(&self, world: &World) -> Cow<'_, Self> {
        let cabins: BTreeSet<AreaId> = cabins(world).map(|(_, area)| area).gather();
        let leads_in = |d: &&Arc<Opening>| d.areas.iter().any(|area| cabins.contains(area));
        let closed = |door: &DoorId| self.door_state(world, *door) == DoorState::CLOSED;
        let doors = self.doorways().iter().filter(leads_in).filter_map(|d| d.door);
        let open: DoorStates = doors.filter(closed).map(|door| (door, DoorState::OPEN)).gather();
        if open.is_empty() {
            Cow::Borrowed(self)
        } else {
            Cow::Owned(self.with_doors(world, &open))
        }
    }

    /// The place nearest to an Area's middle where the robot fits.
    #[must_use]
    pub fn rest_in(&self, area: AreaId) -> Option<Point> {
        let middle = self.scene().areas.get(&area)?.prisms.first()?.polygon.centroid();
        self.standing_in(area, middle)
    }

    /// A place in each piece of an Area's floor, which nothing within the Area joins to the others: the nearest to the
    /// Area's middle in each, the largest piece first.
    #[must_use]
    pub fn rests_in(&self, area: AreaId) -> Vec<Point> {
        let middle = self.scene().areas.get(&area).and_then(|placed| placed.prisms.first());
        let (Some(middle), Some(number)) = (middle, self.number(area)) else { return Vec::new() };
        self.rests(number as u32, middle.polygon.centroid())
    }
}
