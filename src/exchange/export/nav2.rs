//! A floor as a route graph for Nav2's route server, in the GeoJSON that its GeoJsonGraphFileLoader reads: nodes are
//! points with `id`, edges are lines with `id`, `startid`, `endid`; ids are unique over both.
//!
//! Every leg of the graph is a leg of a route of this program, so that a robot that follows it straight keeps its
//! clearance. Within a room the doorways and named places are joined pair by pair where they are few, else over the
//! room's own middle. Doors count as open; an edge through one bears its name and how it stands.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use crate::geometry::{DoorStates, FloorPlan, Method, Ride, Target};
use crate::map::{DoorState, DoorStatus, World};
use crate::units::{AreaId, DoorId, Gather as _, MapId, Point};

use super::{metre, metres};

/// In a room with more ends than this they are joined over the middle.
const MOST_PAIRED: usize = 6;
/// A named place farther than this from where the robot can stand, in cm, is not in the graph.
const NEAR: f64 = 150.0;

/// A node's place in tenths of a millimetre: two ways that touch there meet.
type Corner = (i64, i64);

#[derive(Default)]
struct Graph {
    nodes: Vec<(Point, Value)>,
    known: BTreeMap<Corner, usize>,
    edges: BTreeMap<(usize, usize), Option<DoorId>>,
    /// Nodes where lifts are boarded, by lift and cabin.
    stops: BTreeMap<(usize, AreaId), usize>,
}

impl Graph {
    fn node(&mut self, at: Point) -> usize {
        let corner = ((at.x * 100.0).round() as i64, (at.y * 100.0).round() as i64);
        *self.known.entry(corner).or_insert_with(|| {
            self.nodes.push((at, json!({})));
            self.nodes.len() - 1
        })
    }

    fn join(&mut self, points: &[Point], door: Option<DoorId>) {
        for leg in points.windows(2) {
            let (a, b) = (self.node(leg[0]), self.node(leg[1]));
            if a != b {
                self.edges.entry((a.min(b), a.max(b))).or_insert(door);
            }
        }
    }
}

/// The route graph of a floor in its Map's own frame, in metres.
///
/// # Panics
/// When the plan is not of this world.
#[must_use]
pub fn to_route_graph(world: &World, plan: &FloorPlan) -> String {
    let graph = graph_of(world, plan, &[]);
    written(world, &world.maps[&plan.map()].key, &[Storey { frame: "map".to_owned(), graph }])
}

/// The route graphs of all floors in one file: each node in the frame of its storey, which is called by the Map's key, and
/// between storeys an edge for every ride of a lift, as long as the robot could have driven meanwhile.
///
/// # Panics
/// When a plan is not of this world.
#[must_use]
pub fn to_route_graph_of_all(world: &World, plans: &BTreeMap<MapId, FloorPlan>) -> String {
    let stops = lift_stops(world, plans);
    let storeys: Vec<Storey> = plans
        .values()
        .map(|plan| {
            let stops: Vec<&LiftEnd> = stops.iter().filter(|stop| stop.map == plan.map()).collect();
            let graph = graph_of(world, plan, &stops);
            Storey { frame: world.maps[&plan.map()].key.clone(), graph }
        })
        .collect();
    written(world, &world.domain.name, &storeys)
}

/// A storey's graph, in the frame of this name.
struct Storey {
    frame: String,
    graph: Graph,
}

fn graph_of(world: &World, plan: &FloorPlan, stops: &[&LiftEnd]) -> Graph {
    let doors = plan.doorways().iter().filter_map(|d| d.door);
    let open: DoorStates = doors.map(|d| (d, DoorState::OPEN)).gather();
    let plan = plan.with_doors(world, &open);
    let passable = plan.open_doorways();
    let mut graph = Graph::default();
    let mut ends: BTreeMap<AreaId, Vec<Point>> = BTreeMap::new();
    for (no, doorway) in plan.doorways().iter().enumerate().filter(|(no, _)| passable.contains(no))
    {
        // Straight over the threshold, from where the robot is wholly in one room to where it is in the other.
        let stands = [0, 1].map(|side| doorway.before(side, plan.reach()));
        let target = Target::Point(stands[1]);
        let Ok(route) =
            plan.route_within(world, stands[0], target, Method::Shortest, Some(&doorway.areas))
        else {
            continue;
        };
        if !plan.passed(&route).doorways.contains(&no) {
            continue;
        }
        graph.join(&route.points, doorway.door);
        for (area, end) in
            doorway.areas.iter().zip([route.points[0], route.points[route.points.len() - 1]])
        {
            ends.entry(*area).or_default().push(end);
        }
    }
    let placements = world.placements();
    for place in world.places.values() {
        let Some((_, frame)) = placements.get(&place.area).filter(|(on, _)| *on == plan.map())
        else {
            continue;
        };
        let at = frame.apply(place.at);
        let Some(stand) = stand(world, &plan, at, place.area).filter(|s| (s - at).norm() <= NEAR)
        else {
            continue;
        };
        let node = graph.node(stand);
        graph.nodes[node].1["name"] = json!(place.name);
        ends.entry(place.area).or_default().push(stand);
    }
    for stop in stops {
        let node = graph.node(stop.at);
        graph.nodes[node].1["lift"] = json!(world.domain.lifts[stop.lift].0);
        graph.stops.insert((stop.lift, stop.area), node);
        ends.entry(stop.area).or_default().push(stop.at);
    }
    for fragment in plan.fragments() {
        let area = fragment.area;
        let mut own = ends.remove(&area).unwrap_or_default();
        let middle = stand(
            world,
            &plan,
            fragment.bounds.min + (fragment.bounds.max - fragment.bounds.min) / 2.0,
            area,
        );
        if let Some(middle) = middle {
            let node = graph.node(middle);
            graph.nodes[node].1["room"] = json!(world.areas[&area].name);
            if own.len() > MOST_PAIRED {
                own.iter().for_each(|end| lead(&mut graph, world, &plan, area, *end, middle));
                continue;
            }
            own.push(middle);
        }
        for (no, a) in own.iter().enumerate() {
            own[no + 1..].iter().for_each(|b| lead(&mut graph, world, &plan, area, *a, *b));
        }
    }
    graph
}

/// Where the robot can stand in a room nearest to a point.
fn stand(world: &World, plan: &FloorPlan, at: Point, area: AreaId) -> Option<Point> {
    let route =
        plan.route_within(world, at, Target::Point(at), Method::Shortest, Some(&[area])).ok()?;
    route.points.first().copied()
}

fn lead(graph: &mut Graph, world: &World, plan: &FloorPlan, area: AreaId, a: Point, b: Point) {
    let route = plan.route_within(world, a, Target::Point(b), Method::Shortest, Some(&[area]));
    if let Ok(route) = route {
        graph.join(&route.points, None);
    }
}

fn written(world: &World, name: &str, storeys: &[Storey]) -> String {
    let (mut features, mut id) = (Vec::new(), 0);
    let mut numbers: Vec<BTreeMap<usize, usize>> = Vec::new();
    for Storey { frame, graph } in storeys {
        let joined = graph.edges.keys().flat_map(|(a, b)| [*a, *b]);
        let used: BTreeSet<usize> = joined.chain(graph.stops.values().copied()).gather();
        let mut number = BTreeMap::new();
        for node in used {
            id += 1;
            number.insert(node, id);
            let (at, metadata) = &graph.nodes[node];
            let mut properties = json!({ "id": id, "frame": frame });
            if metadata.as_object().is_some_and(|m| !m.is_empty()) {
                properties["metadata"] = metadata.clone();
            }
            let geometry = json!({ "type": "Point", "coordinates": metres(*at) });
            features.push(feature(&properties, &geometry));
        }
        numbers.push(number);
    }
    let mut edge =
        |from: (usize, Point), to: (usize, Point), cost: f64, metadata: Option<Value>| {
            id += 1;
            let mut properties = json!({
                "id": id, "startid": from.0, "endid": to.0, "cost": cost, "overridable": true,
            });
            if let Some(metadata) = metadata {
                properties["metadata"] = metadata;
            }
            let line = [metres(from.1), metres(to.1)];
            let geometry = json!({ "type": "MultiLineString", "coordinates": [line] });
            features.push(feature(&properties, &geometry));
        };
    for (Storey { graph, .. }, number) in storeys.iter().zip(&numbers) {
        for ((a, b), door) in &graph.edges {
            for (from, to) in [(a, b), (b, a)] {
                let (start, end) = (graph.nodes[*from].0, graph.nodes[*to].0);
                let metadata = door.map(|door| &world.doors[&door]).map(|door| {
                    let stands = match door.state.status {
                        DoorStatus::Open => "open",
                        DoorStatus::Closed => "closed",
                        DoorStatus::Locked => "locked",
                    };
                    json!({ "door": door.name, "door_state": stands })
                });
                let cost = metre((end - start).norm());
                edge((number[from], start), (number[to], end), cost, metadata);
            }
        }
    }
    let stops = storeys.iter().zip(&numbers).flat_map(|(storey, number)| {
        let graph = &storey.graph;
        graph.stops.iter().map(|(stop, node)| (*stop, number[node], graph.nodes[*node].0))
    });
    let stops: Vec<((usize, AreaId), usize, Point)> = stops.collect();
    for ((lift, from), start, at) in &stops {
        for ((_, to), end, there) in
            stops.iter().filter(|(stop, ..)| stop.0 == *lift && stop.1 != *from)
        {
            let height = |area: AreaId| height_of(world, area);
            let ride =
                Ride { lift: *lift, from: *from, to: *to, rise: height(*to) - height(*from) };
            let metadata = json!({
                "lift": world.domain.lifts[*lift].0, "from": world.areas[from].name,
                "to": world.areas[to].name, "rise": metre(ride.rise), "seconds": ride.seconds(),
            });
            let cost = metre(ride.seconds() * world.robot.speed);
            edge((*start, *at), (*end, *there), cost, Some(metadata));
        }
    }
    let file = json!({ "type": "FeatureCollection", "name": name, "features": features });
    serde_json::to_string_pretty(&file).expect("JSON can say it")
}

fn feature(properties: &Value, geometry: &Value) -> Value {
    json!({ "type": "Feature", "properties": properties, "geometry": geometry })
}

/// Where a lift is boarded on a floor.
struct LiftEnd {
    lift: usize,
    area: AreaId,
    map: MapId,
    at: Point,
}

/// The stops of lifts at which the robot can stand; stairs are none.
fn lift_stops(world: &World, plans: &BTreeMap<MapId, FloorPlan>) -> Vec<LiftEnd> {
    let mut found = Vec::new();
    for (lift, (_, stops)) in world.domain.lifts.iter().enumerate() {
        if stops.iter().any(|stop| world.area_has_trait(stop.area, "stairs")) {
            continue;
        }
        for stop in stops {
            let area = stop.area;
            let Some((map, _)) = world.placement(area) else { continue };
            let Some(plan) = plans.get(&map) else { continue };
            let Some(prism) = plan.scene().areas.get(&area).and_then(|a| a.prisms.first()) else {
                continue;
            };
            if let Some(at) = stand(world, plan, prism.polygon.centroid(), area) {
                found.push(LiftEnd { lift, area, map, at });
            }
        }
    }
    found
}

/// Of an Area in the building, cm.
fn height_of(world: &World, area: AreaId) -> f64 {
    let Some((map, frame)) = world.placement(area) else { return 0.0 };
    let floor = world.domain.maps.iter().find(|placed| placed.map == map);
    floor.map_or(0.0, |placed| placed.frame.z.get()) + frame.z.get()
}
