//! A storey as data: outlines in the Map's frame, cm, with the names of what they are of.
//!
//! Drawn is the map as surveyed, with its doors as they now stand; what is believed to stand elsewhere is told beside it.

use serde_json::{Value, json};

use super::values::{point, round};
use crate::engine::{Error, State};
use crate::geometry::{FloorPlan, Opening, PlacedZone, Polygon, Region, Scene};
use crate::map::{
    BaseVector, Door, DoorStatus, Entity, Extent, Item, Permeability, Replica, World, ZoneKind,
};
use crate::units::{AreaId, InOrder as _, Language, MapId, Point};

/// How much of a storey is wanted.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Part {
    /// All of it, but for its things and doors where there are more than so many.
    Whole { most: usize },
    /// The things, doors and places that meet a box, on the Map: left, bottom, right, top.
    Box([f64; 4]),
}

/// Rooms, walls, things, doors and places of a Map.
///
/// # Errors
/// There is no map.
pub(crate) fn storey(state: &State, map: MapId, part: Part) -> Result<Value, Error> {
    let world = state.world()?;
    let floor = state.floors()?.get(&map).expect("every map of the world has a floor");
    let now = state.world_now()?;
    let scene = floor.scene();
    let meets = |view: &Value| match part {
        Part::Whole { .. } => true,
        Part::Box(within) => meets(view, within),
    };
    let count = scene.replicas.len() + floor.doorways().len() + floor.blind_openings().len();
    let is_part = matches!(part, Part::Whole { most } if count > most);
    let (mut some_things, mut some_doors) = (Vec::new(), Vec::new());
    if !is_part {
        (some_things, some_doors) = (things(world, scene), doors(world, now, floor));
        some_things.retain(meets);
        some_doors.retain(meets);
    }
    let mut some_places = places(world, map);
    some_places.retain(meets);
    let mut view = json!({
        "revision": state.revision(),
        "map": world.maps[&map].name,
        "map_en": world.maps[&map].name_en,
        "things": some_things,
        "doors": some_doors,
        "places": some_places,
        "is_part": is_part,
    });
    if let Part::Box(within) = part {
        view["box"] = json!(within);
        return Ok(view);
    }
    view["rooms"] = json!(rooms(world, scene));
    view["walls"] = json!(sides(world, scene, false));
    view["windows"] = json!(sides(world, scene, true));
    view["zones"] = json!(zones(state, world, floor)?);
    view["carried"] = json!(carried(state));
    let elsewhere =
        if std::ptr::eq(world, now) { Vec::new() } else { moved(world, now, map, scene) };
    view["elsewhere"] = json!(elsewhere);
    Ok(view)
}

/// Whether what is drawn lies in a box, or reaches into it.
fn meets(view: &Value, [left, bottom, right, top]: [f64; 4]) -> bool {
    fn stretch(value: &Value, reach: &mut [f64; 4]) {
        let Some(list) = value.as_array() else { return };
        match (list.first().and_then(Value::as_f64), list.get(1).and_then(Value::as_f64)) {
            (Some(x), Some(y)) => {
                let [l, b, r, t] = *reach;
                *reach = [l.min(x), b.min(y), r.max(x), t.max(y)];
            }
            _ => list.iter().for_each(|inner| stretch(inner, reach)),
        }
    }
    let mut reach = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
    for field in ["polygons", "gap"] {
        stretch(&view[field], &mut reach);
    }
    if view["at"].is_array() {
        stretch(&json!([view["at"]]), &mut reach);
    }
    reach[0] <= right && reach[2] >= left && reach[1] <= top && reach[3] >= bottom
}

/// Where something of the map is to be seen: the storey, and the box that it fills there.
pub(super) fn seen(state: &State, entity: Entity) -> Option<Value> {
    let (world, floors) = (state.world().ok()?, state.floors().ok()?);
    let around = |points: &mut dyn Iterator<Item = Point>| {
        let nothing = [f64::INFINITY, f64::INFINITY, f64::NEG_INFINITY, f64::NEG_INFINITY];
        let reach = points
            .fold(nothing, |[l, b, r, t], p| [l.min(p.x), b.min(p.y), r.max(p.x), t.max(p.y)]);
        (reach[0] <= reach[2]).then(|| reach.map(round))
    };
    let on = |map: &MapId, reach: [f64; 4]| json!({ "map": world.maps[map].name, "box": reach });
    floors.iter().find_map(|(map, floor)| {
        let scene = floor.scene();
        let mut corners: Box<dyn Iterator<Item = Point>> = match entity {
            Entity::Replica(id) => {
                let placed = scene.replicas.get(&id)?;
                Box::new(placed.prisms.iter().flat_map(|p| p.polygon.corners.iter().copied()))
            }
            Entity::Area(id) => {
                let placed = scene.areas.get(&id)?;
                Box::new(placed.prisms.iter().flat_map(|p| p.polygon.corners.iter().copied()))
            }
            Entity::Door(id) => {
                let mut openings = floor.doorways().iter().chain(floor.blind_openings());
                let opening = openings.find(|opening| opening.door == Some(id))?;
                let (t0, t1) = opening.span();
                Box::new([opening.at(t0, 0.0), opening.at(t1, opening.gap)].into_iter())
            }
            Entity::Place(id) => {
                let place = world.places.get(&id)?;
                let (of, frame) = world.placement(place.area)?;
                if of != *map {
                    return None;
                }
                Box::new(std::iter::once(frame.apply(place.at)))
            }
            Entity::Zone(id) => {
                let all = floor.with_zones(world, |_| true);
                let placed = all.zones().iter().find(|zone| zone.id == id)?;
                let corners: Vec<Point> =
                    placed.polygons.iter().flat_map(|p| p.corners.clone()).collect();
                Box::new(corners.into_iter())
            }
            Entity::Map(_) => return None,
        };
        around(&mut *corners).map(|reach| on(map, reach))
    })
}

/// The zones of a Map, those for a time among them, with what they say in both languages.
fn zones(state: &State, world: &World, floor: &FloorPlan) -> Result<Vec<Value>, Error> {
    let [russian, english] = [Language::Russian, Language::English];
    let (rules, rules_en) = (state.zones_in_words(russian)?, state.zones_in_words(english)?);
    let all = floor.with_zones(world, |_| true);
    let now = std::time::SystemTime::now().into();
    let zone = |placed: &PlacedZone| {
        let zone = &world.zones[&placed.id];
        json!({
            "id": zone.id.0,
            "name": zone.name,
            "name_en": zone.name_en,
            "from": zone.from.map(|at| at.to_string()),
            "until": zone.until.map(|at| at.to_string()),
            "in_force": zone.is_in_force(now),
            "reason": zone.reason,
            "reason_en": zone.reason_en,
            "speed": match zone.kind {
                ZoneKind::Slow { speed } => Some(speed),
                _ => None,
            },
            "heading_deg": match zone.kind {
                ZoneKind::OneWay { heading } => Some(heading.get()),
                _ => None,
            },
            "rooms": match &zone.extent {
                Extent::Areas(areas) => {
                    areas.iter().map(|area| &world.areas[area].name).collect()
                }
                Extent::Polygon { .. } => Vec::new(),
            },
            "kind": match zone.kind {
                ZoneKind::KeepOut => "keep-out",
                ZoneKind::Closed => "closed",
                ZoneKind::Slow { .. } => "slow",
                ZoneKind::OneWay { .. } => "one-way",
            },
            "rule": rules[&zone.id],
            "rule_en": rules_en[&zone.id],
            "polygons": placed.polygons.iter().map(outline).collect::<Vec<_>>(),
        })
    };
    Ok(all.zones().iter().map(zone).collect())
}

/// What is in the robot's hand, lies on what is, or was handed over: with who has it.
fn carried(state: &State) -> Vec<Value> {
    let carried = (state.held(), state.aboard(), state.handed_over());
    let (Ok(held), Ok(aboard), Ok(handed_over)) = carried else { return Vec::new() };
    let one = |thing: &Replica, by: &str| json!({ "id": thing.id.0, "name": thing.name, "name_en": thing.name_en, "by": by });
    let held = held.into_iter().map(|thing| one(thing, ""));
    let aboard = aboard.iter().map(|(thing, _)| one(thing, ""));
    let handed_over = handed_over.iter().map(|(thing, by)| one(thing, by));
    held.chain(aboard).chain(handed_over).collect()
}

/// The parts of a room with their sides, on the Map: what a wall is called, what it lets through, and its doors.
pub(super) fn walls(world: &World, area: AreaId) -> Vec<Value> {
    let Some((_, placed)) = world.placement(area) else { return Vec::new() };
    let room = &world.areas[&area];
    let part = |item: &Item| {
        let side = |vector: &BaseVector| {
            let [from, to] = [vector.start, vector.end].map(|p| placed.apply(item.frame.apply(p)));
            let mounts = room.doors.iter();
            let mounts = mounts.filter(|m| m.item == item.id && m.side == vector.id);
            let doors: Vec<&String> = mounts.map(|m| &world.doors[&m.door].name).collect();
            json!({
                "id": vector.id, "from": point(from), "to": point(to), "doors": doors,
                "permeability": vector.permeability.code(),
                "is_window": world.is_window(vector),
            })
        };
        let base = &world.orthoframe_of(item).base;
        json!({ "id": item.id, "sides": base.iter().map(side).collect::<Vec<_>>() })
    };
    room.items.iter().map(part).collect()
}

/// Kinds of things: what one of them would look like, put down with its origin at that of a room.
pub(super) fn objects(world: &World) -> Vec<Value> {
    let object = |object: &crate::map::Object| {
        let part = |item: &Item| {
            let corners = world.orthoframe_of(item).corners();
            corners.map(|p| point(item.frame.apply(p))).collect::<Vec<_>>()
        };
        json!({
            "object": object.key, "name": object.name, "name_en": object.name_en,
            "polygons": object.items.iter().map(part).collect::<Vec<_>>(),
        })
    };
    world.objects.values().map(object).collect()
}

/// The free floor of a Map: its Passframes, dead zones, and the network over them.
///
/// # Errors
/// There is no map.
pub(crate) fn floor(state: &State, map: MapId) -> Result<Value, Error> {
    let floor = state.floors()?.get(&map).expect("every map of the world has a floor");
    let (mut frames, mut dead) = (Vec::new(), Vec::new());
    for fragment in floor.fragments() {
        frames.extend(
            fragment.passframes().iter().map(
                |frame| json!({ "id": frame.id.to_string(), "points": outline(&frame.polygon) }),
            ),
        );
        dead.extend(fragment.dead_zones().iter().map(region));
    }
    let network = crate::draw::NetworkLayer::of(floor, None);
    let line = |points: &[Point; 3]| points.map(point);
    Ok(json!({
        "revision": state.revision(),
        "passframes": frames,
        "dead": dead,
        "network": network.edges.iter().chain(&network.doors).map(line).collect::<Vec<_>>(),
    }))
}

fn rooms(world: &World, scene: &Scene) -> Vec<Value> {
    let room = |placed: &crate::geometry::PlacedArea| {
        let area = &world.areas[&placed.id];
        let polygons: Vec<_> = placed.prisms.iter().map(|prism| outline(&prism.polygon)).collect();
        let whole: f64 = placed.prisms.iter().map(|p| p.polygon.signed_area().abs()).sum();
        // Where a name may stand: in the largest piece.
        let size = |p: &&crate::geometry::Prism| p.polygon.signed_area().abs();
        let largest = placed.prisms.iter().max_by(|a, b| size(a).total_cmp(&size(b)));
        json!({
            "id": area.id.0, "name": area.name, "name_en": area.name_en, "polygons": polygons,
            "m2": round(whole / 10_000.0), "middle": largest.map(|p| point(p.polygon.centroid())),
            "frame": frame(&placed.frame),
        })
    };
    scene.areas.values().map(room).collect()
}

/// Walls, or the windows in them; what only parts two pieces of one room is none.
fn sides(world: &World, scene: &Scene, windows: bool) -> Vec<[[f64; 2]; 2]> {
    let mut found = Vec::new();
    for prism in scene.areas.values().flat_map(|area| &area.prisms) {
        let orthoframe = &world.orthoframes[&prism.orthoframe];
        let edges = prism.polygon.edges().zip(prism.sides.iter()).zip(&orthoframe.base);
        for (((a, b), side), vector) in edges {
            let is_wall = side.permeability == Permeability::Impermeable;
            if is_wall && (!windows || world.is_window(vector)) {
                found.push([point(a), point(b)]);
            }
        }
    }
    found
}

fn things(world: &World, scene: &Scene) -> Vec<Value> {
    let thing = |placed: &crate::geometry::PlacedReplica| {
        let replica = &world.replicas[&placed.id];
        let object = &world.objects[&replica.object];
        json!({
            "id": replica.id.0, "name": replica.name, "name_en": replica.name_en,
            "kind": object.name, "kind_en": object.name_en, "object": object.key,
            "room": world.areas[&replica.area].name,
            "polygons": placed.prisms.iter().map(|p| outline(&p.polygon)).collect::<Vec<_>>(),
            "z": [round(placed.bottom), round(placed.top)],
            "at": frame(&replica.frame), "on_map": frame(&placed.frame),
            "movable": replica.move_prob > 0,
        })
    };
    // The lowest first: what stands on it is drawn over it.
    let mut all: Vec<_> = scene.replicas.values().collect();
    all.order_by(|a, b| a.bottom.total_cmp(&b.bottom).then(a.top.total_cmp(&b.top)));
    all.into_iter().map(thing).collect()
}

fn doors(world: &World, now: &World, floor: &FloorPlan) -> Vec<Value> {
    let mut seen = std::collections::BTreeSet::new();
    let openings = floor.doorways().iter().chain(floor.blind_openings());
    let opening = |opening: &Opening| {
        let door = opening.door.and_then(|id| now.doors.get(&id));
        // A door out of the map is an opening of its own.
        if door.is_some_and(|door| !seen.insert(door.id)) || (door.is_none() && !opening.is_way()) {
            return None;
        }
        let (t0, t1) = opening.span();
        let jamb = |t: f64| [opening.at(t, 0.0), opening.at(t, opening.gap)].map(point);
        let names: Vec<&str> = opening
            .all_areas()
            .iter()
            .map(|area: &AreaId| world.areas[area].name.as_str())
            .collect();
        let mut view = json!({
            "gap": [jamb(t0), jamb(t1)], "rooms": names, "name": door.map(|door| &door.name),
            "name_en": door.map(|door| &door.name_en), "id": door.map(|door| door.id.0),
        });
        if let Some(door) = door {
            leaves(&mut view, opening, door);
        }
        Some(view)
    };
    openings.map(|shared| &**shared).filter_map(opening).collect()
}

pub(super) const fn door_state(door: &Door) -> &'static str {
    match door.state.status {
        DoorStatus::Open => "open",
        DoorStatus::Closed => "closed",
        DoorStatus::Locked => "locked",
    }
}

fn leaves(view: &mut Value, opening: &Opening, door: &Door) {
    let leaves = opening.leaves(door);
    view["state"] = json!(door_state(door));
    view["opening"] = json!(round(door.state.opening));
    view["leaves"] = json!(leaves.at(door.state).iter().map(outline).collect::<Vec<_>>());
    let arc = |points: &Vec<Point>| points.iter().map(|p| point(*p)).collect::<Vec<_>>();
    view["arcs"] = json!(leaves.arcs().iter().map(arc).collect::<Vec<_>>());
}

fn places(world: &World, map: MapId) -> Vec<Value> {
    let placements = world.placements();
    let place = |place: &crate::map::Place| {
        let (on, frame) = placements.get(&place.area)?;
        (*on == map).then(|| {
            json!({
                "id": place.id.0, "name": place.name, "name_en": place.name_en,
                "at": point(frame.apply(place.at)), "room": world.areas[&place.area].name,
            })
        })
    };
    world.places.values().filter_map(place).collect()
}

/// Things that are believed to stand elsewhere than the map has them, or on nobody's floor.
fn moved(world: &World, now: &World, map: MapId, surveyed: &Scene) -> Vec<Value> {
    let differs = |id: &&crate::units::ReplicaId| {
        let (was, is) = (world.replicas.get(id), now.replicas.get(id));
        was.zip(is).is_some_and(|(was, is)| (was.area, was.frame) != (is.area, is.frame))
    };
    let ids: Vec<_> = now.replicas.keys().filter(differs).collect();
    if ids.is_empty() {
        return Vec::new();
    }
    let scene = Scene::of(now, map);
    let one = |id: &&crate::units::ReplicaId| {
        let placed = scene.replicas.get(id);
        let was = surveyed.replicas.get(id);
        if placed.is_none() && was.is_none() {
            return None;
        }
        let polygons = placed.map(|p| p.prisms.iter().map(|p| outline(&p.polygon)));
        Some(json!({
            "name": now.replicas[id].name, "name_en": now.replicas[id].name_en,
            "polygons": polygons.map(Iterator::collect::<Vec<_>>),
        }))
    };
    ids.iter().filter_map(one).collect()
}

fn region(region: &Region) -> Value {
    let holes: Vec<_> = region.holes.iter().map(outline).collect();
    json!({ "outer": outline(&region.outer), "holes": holes })
}

fn frame(frame: &crate::units::Frame) -> Value {
    json!({
        "x": round(frame.x.get()), "y": round(frame.y.get()), "z": round(frame.z.get()),
        "angle_deg": round(frame.angle.get()),
    })
}

fn outline(polygon: &Polygon) -> Vec<[f64; 2]> {
    polygon.corners.iter().map(|corner| point(*corner)).collect()
}
