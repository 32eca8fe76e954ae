//! A floor as a route graph for Nav2's route server, in the GeoJSON that its GeoJsonGraphFileLoader reads: nodes are
//! points with `id`, edges are lines with `id`, `startid`, `endid`; ids are unique over both.
//!
//! Every leg of the graph is a leg of a route of this program, so that a robot that follows it straight keeps its
//! clearance. Within a room the doorways and named places are joined pair by pair where they are few, else over the
//! room's own middle. Doors count as open; an edge through one bears its name and how it stands.

use std::collections::{BTreeMap, BTreeSet};

use serde_json::{Value, json};

use crate::geometry::{DoorStates, FloorPlan, Method, Target};
use crate::map::{DoorState, DoorStatus, World};
use crate::units::{AreaId, DoorId, Point};

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
    let doors = plan.doorways().iter().filter_map(|d| d.door);
    let open: DoorStates = doors.map(|d| (d, DoorState::OPEN)).collect();
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
    written(world, &plan, &graph)
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

fn written(world: &World, plan: &FloorPlan, graph: &Graph) -> String {
    let used: BTreeSet<usize> = graph.edges.keys().flat_map(|(a, b)| [*a, *b]).collect();
    let number: BTreeMap<usize, usize> =
        used.iter().enumerate().map(|(no, node)| (*node, no + 1)).collect();
    let mut features = Vec::new();
    for node in &used {
        let (at, metadata) = &graph.nodes[*node];
        let mut properties = json!({ "id": number[node], "frame": "map" });
        if metadata.as_object().is_some_and(|m| !m.is_empty()) {
            properties["metadata"] = metadata.clone();
        }
        let geometry = json!({ "type": "Point", "coordinates": metres(*at) });
        features.push(json!({ "type": "Feature", "properties": properties, "geometry": geometry }));
    }
    let mut id = used.len();
    for ((a, b), door) in &graph.edges {
        for (from, to) in [(a, b), (b, a)] {
            id += 1;
            let (start, end) = (graph.nodes[*from].0, graph.nodes[*to].0);
            let length = metre((end - start).norm());
            let mut properties = json!({
                "id": id, "startid": number[from], "endid": number[to], "cost": length, "overridable": true,
            });
            if let Some(door) = door.map(|d| &world.doors[&d]) {
                let stands = match door.state.status {
                    DoorStatus::Open => "open",
                    DoorStatus::Closed => "closed",
                    DoorStatus::Locked => "locked",
                };
                properties["metadata"] = json!({ "door": door.name, "door_state": stands });
            }
            let line = [metres(start), metres(end)];
            let geometry = json!({ "type": "MultiLineString", "coordinates": [line] });
            features
                .push(json!({ "type": "Feature", "properties": properties, "geometry": geometry }));
        }
    }
    let name = &world.maps[&plan.map()].key;
    let file = json!({ "type": "FeatureCollection", "name": name, "features": features });
    serde_json::to_string_pretty(&file).expect("JSON can say it")
}
