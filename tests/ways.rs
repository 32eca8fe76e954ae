//! Ways between all rooms, on the maps of `../shared/data`: that the search ends, that there and back agree, that a smaller robot
//! goes wherever a larger one does, and that "no way" is what a fill of the floor says, which knows the map file alone.
//!
//! The ordinary run takes small maps and a sample of pairs by seed; with `ORTHOFRAME_LONG` all maps and all pairs are tried.
//! A map that is not there is passed over and said so.

use std::collections::{BTreeMap, BTreeSet};

use orthoframe_exchange::{Options, read};
use orthoframe_geometry::{Barrier, DoorStates, FloorPlan, Method, NoRoute, Route, Target};
use orthoframe_map::{DoorKind, DoorState, Permeability, World};
use orthoframe_units::{AreaId, Cm, DoorId, Frame, MapId, Point, Vector};

use crate::files::{long, shared};
use crate::floor_properties::Random;

const SMALL: [&str; 7] = [
    "cases/mini4.json",
    "cases/mini6.json",
    "cases/ell.json",
    "cases/office-two-storeys.toml",
    "procthor/house_0.json",
    "rmf/office.building.yaml",
    "osmag/SIST_1.osm",
];
const OTHERS: [&str; 14] = [
    "rmf/clinic.building.yaml",
    "rmf/triple_H.building.yaml",
    "procthor/house_1.json",
    "procthor/house_2.json",
    "procthor/house_3.json",
    "procthor/house_4.json",
    "procthor/house_5.json",
    "procthor/house_6.json",
    "procthor/house_7.json",
    "procthor/house_8.json",
    "procthor/house_9.json",
    "virtualhome/TestScene1_graph.json",
    "virtualhome/TestScene2_graph.json",
    "virtualhome/TestScene3_graph.json",
];

fn names() -> Vec<&'static str> {
    let others = OTHERS.iter().filter(|_| long());
    SMALL.iter().chain(others).copied().collect()
}

fn world(name: &str) -> Option<World> {
    let path = shared(name)?;
    let imported = read(&path, &Options::default()).unwrap_or_else(|e| panic!("{name}: {e}"));
    Some(imported.world)
}

fn worlds() -> impl Iterator<Item = (&'static str, World)> {
    names().into_iter().filter_map(|name| Some((name, world(name)?)))
}

/// A plan for a robot of some radius, with all doors open.
fn plan(world: &World, map: MapId, radius: f64) -> FloorPlan {
    let robot = orthoframe_map::RobotProfile {
        radius: Cm::of(radius),
        footprint: Vec::new(),
        ..world.robot.clone()
    };
    let open: DoorStates = world.doors.keys().map(|&door| (door, DoorState::OPEN)).collect();
    FloorPlan::build(world, map, &robot, &open)
}

/// A place to stand in each room where the robot fits.
fn stands(plan: &FloorPlan) -> Vec<(AreaId, Point)> {
    let areas = plan.fragments().map(|f| f.area);
    areas.filter_map(|area| Some((area, plan.rest_in(area)?))).collect()
}

fn go(plan: &FloorPlan, world: &World, from: Point, to: Point) -> Result<Route, NoRoute> {
    plan.route(world, from, Target::Point(to), Method::Shortest)
}

#[test]
fn there_and_back_are_one_way() {
    let mut random = Random(24);
    for (name, world) in worlds() {
        for &map in world.maps.keys() {
            let plan = plan(&world, map, world.robot.radius.get());
            let stands = stands(&plan);
            let pairs = (0..stands.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
            let pairs: Vec<(usize, usize)> = pairs.collect();
            let share = if long() { 1.0 } else { 40.0 / pairs.len().max(1) as f64 };
            for (i, j) in pairs.into_iter().filter(|_| random.unit() < share) {
                let ((one, p), (other, q)) = (stands[i], stands[j]);
                let told =
                    || format!("{name}: {} – {}", world.areas[&one].name, world.areas[&other].name);
                match (go(&plan, &world, p, q), go(&plan, &world, q, p)) {
                    (Ok(there), Ok(back)) => {
                        let differ = (there.length - back.length).abs();
                        assert!(differ < 0.01, "{}: {} {}", told(), there.length, back.length);
                        assert!(plan.are_joined(p, q), "{}", told());
                    }
                    (Err(_), Err(_)) => assert!(!plan.are_joined(p, q), "{}", told()),
                    (there, back) => panic!("{}: {there:?} {back:?}", told()),
                }
            }
        }
    }
}

/// The named pairs that once took all memory, in both directions.
#[test]
fn a_search_that_turned_round_a_corner_for_ever_ends() {
    let Some(world) = world("osmag/SIST_1.osm") else {
        return;
    };
    let area = |name: &str| {
        let mut areas = world.areas.values().filter(|a| a.name == name);
        areas.next().unwrap_or_else(|| panic!("{name}")).id
    };
    let (from, to) = (area("E1d-F2-07"), area("E1b-F2-WR"));
    let (map, _) = world.placement(from).expect("on a map");
    let plan = plan(&world, map, 25.0);
    let rest = |area| plan.rest_in(area).expect("the robot fits");
    let there = plan.route(&world, rest(from), Target::Area(to), Method::Shortest).expect("a way");
    let back = plan.route(&world, rest(to), Target::Area(from), Method::Shortest).expect("a way");
    assert!((there.length - 8900.0).abs() < 100.0 && (back.length - 9040.0).abs() < 100.0);
}

/// Past the end of a doorway's line a way once was not seen from one side, or was a detour of many metres.
#[test]
fn a_way_past_the_end_of_a_doorways_line_is_found_from_both_sides() {
    let Some(world) = world("osmag/SIST_1.osm") else {
        return;
    };
    let area = |name: &str| {
        let mut areas = world.areas.values().filter(|a| a.name == name);
        areas.next().unwrap_or_else(|| panic!("{name}")).id
    };
    for pairs in [
        &[("E1d-F1-WR", "E1d-F1-04"), ("E1-ST-03", "E1c-F1-01."), ("E1-ST-02", "E1c-F1-SE")][..],
        &[("E1c-F2-17", "E1c-F2-09"), ("E1c-F2-17", "E1d-F2-14"), ("E1d-F2-03", "E1d-F2-07")],
    ] {
        let (map, _) = world.placement(area(pairs[0].0)).expect("on a map");
        let plan = plan(&world, map, world.robot.radius.get());
        for &(one, other) in pairs {
            let [p, q] = [one, other].map(|n| plan.rest_in(area(n)).expect("the robot fits"));
            let length = |from, to| go(&plan, &world, from, to).expect("a way").length;
            let (there, back) = (length(p, q), length(q, p));
            assert!((there - back).abs() < 0.01, "{one} – {other}: {there} {back}");
        }
    }
}

#[test]
fn where_a_robot_goes_a_smaller_one_goes() {
    let mut random = Random(25);
    for (name, world) in worlds().filter(|w| long() || w.0 != "osmag/SIST_1.osm") {
        for &map in world.maps.keys() {
            let mut radii = vec![25.0, 24.9, 24.8];
            let more = if long() { 6 } else { 1 };
            radii.extend((0..more).map(|_| random.between(12.0, 40.0)));
            radii.sort_by(|a, b| b.total_cmp(a));
            let plans: Vec<FloorPlan> = radii.iter().map(|&r| plan(&world, map, r)).collect();
            for pair in plans.windows(2) {
                let stands = stands(&pair[0]);
                for (i, &(one, p)) in stands.iter().enumerate() {
                    let joined = |q: &&(AreaId, Point)| pair[0].are_joined(p, q.1);
                    for &(other, q) in stands[..i].iter().filter(joined) {
                        assert!(
                            pair[1].are_joined(p, q),
                            "{name}: {} – {} at {}, not at {}",
                            world.areas[&one].name,
                            world.areas[&other].name,
                            pair[0].robot().radius.get(),
                            pair[1].robot().radius.get()
                        );
                    }
                }
            }
        }
    }
}

/// What keeps the floor apart, found from the map file's own words: sides, doors by their widths, things by their boxes.
struct Ground {
    floors: Vec<(Option<AreaId>, Vec<Point>)>,
    walls: Vec<(Point, Point)>,
    things: Vec<Vec<Point>>,
}

struct Rim {
    area: AreaId,
    item: usize,
    ends: (Point, Point),
    permeability: Permeability,
    door: Option<DoorId>,
    level: f64,
}

fn place_of(p: Point, (a, b): (Point, Point)) -> f64 {
    (p - a).dot(&(b - a)) / (b - a).norm_squared()
}

fn apart(p: Point, (a, b): (Point, Point)) -> f64 {
    let t = place_of(p, (a, b)).clamp(0.0, 1.0);
    (p - (a + (b - a) * t)).norm()
}

fn inside(p: Point, ring: &[Point]) -> bool {
    let mut odd = false;
    for (k, a) in ring.iter().enumerate() {
        let b = ring[(k + 1) % ring.len()];
        if (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x) {
            odd = !odd;
        }
    }
    odd
}

impl Ground {
    /// All doors are taken as openings without leaves.
    fn of(world: &World, map: MapId) -> Self {
        let mut ground = Self { floors: vec![], walls: vec![], things: vec![] };
        let mut rims: Vec<Rim> = Vec::new();
        let mut names: BTreeMap<(AreaId, String, String), usize> = BTreeMap::new();
        for item in &world.maps[&map].items {
            let area = &world.areas[&item.area];
            for (number, part) in area.items.iter().enumerate() {
                let frame = item.frame.compose(&part.frame);
                let base = &world.orthoframes[&part.orthoframe].base;
                let ring = base.iter().map(|v| frame.apply(v.start)).collect();
                ground.floors.push((Some(area.id), ring));
                for side in base {
                    let mounted =
                        |m: &&orthoframe_map::DoorMount| m.item == part.id && m.side == side.id;
                    names.insert((area.id, part.id.clone(), side.id.clone()), rims.len());
                    rims.push(Rim {
                        area: area.id,
                        item: number,
                        ends: (frame.apply(side.start), frame.apply(side.end)),
                        permeability: side.permeability,
                        door: area.doors.iter().find(mounted).map(|m| m.door),
                        level: frame.z.get(),
                    });
                }
            }
            for replica in world.replicas_in(area.id) {
                ground.put(world, &item.frame, item.frame.z.get(), replica);
            }
        }
        let mut openings: Vec<(usize, usize)> = Vec::new();
        for link in &world.maps[&map].links {
            let of = |area, s: &orthoframe_map::SideRef| {
                names.get(&(area, s.item.clone(), s.side.clone()))
            };
            if let (Some(&a), Some(&b)) =
                (of(link.area, &link.side), of(link.to_area, &link.to_side))
            {
                openings.push((a, b));
            }
        }
        for (a, one) in rims.iter().enumerate() {
            let same = |&b: &usize| rims[b].door == one.door && rims[b].area != one.area;
            let other = one.door.and_then(|_| (a + 1..rims.len()).find(same));
            openings.extend(other.map(|b| (a, b)));
        }
        let mut is_open = BTreeSet::new();
        for (a, b) in openings {
            let passes = |rim: &Rim| rim.permeability != Permeability::Impermeable;
            let rise = (rims[a].level - rims[b].level).abs();
            if passes(&rims[a])
                && passes(&rims[b])
                && rise <= world.robot.step.get()
                && is_open.insert(a)
                && is_open.insert(b)
            {
                ground.open(world, &rims[a], &rims[b]);
            }
        }
        for (k, rim) in rims.iter().enumerate().filter(|(k, _)| !is_open.contains(k)) {
            let middle = nalgebra::center(&rim.ends.0, &rim.ends.1);
            let is_inner = rim.permeability == Permeability::Permeable
                && rims.iter().enumerate().any(|(l, o)| {
                    l != k
                        && o.area == rim.area
                        && o.item != rim.item
                        && apart(middle, o.ends) < 0.05
                });
            if !is_inner {
                ground.walls.push(rim.ends);
            }
        }
        ground
    }

    /// A doorway: where two sides overlap, as wide as its door in the middle of that.
    fn open(&mut self, world: &World, one: &Rim, other: &Rim) {
        let along = one.ends.1 - one.ends.0;
        let (near, far) = (place_of(other.ends.0, one.ends), place_of(other.ends.1, one.ends));
        let (low, high) = (near.min(far).max(0.0), near.max(far).min(1.0));
        let door = one.door.or(other.door).map_or(0.0, |door| world.doors[&door].width.get());
        let width = (high - low) * along.norm();
        let margin = if door > 0.0 { (width - door).max(0.0) / 2.0 / along.norm() } else { 0.0 };
        let jambs = [low + margin, high - margin].map(|t| one.ends.0 + along * t);
        if width <= 1e-3 {
            self.walls.extend([one.ends, other.ends]);
            return;
        }
        let onto = |p: Point| {
            let t = place_of(p, other.ends);
            other.ends.0 + (other.ends.1 - other.ends.0) * t
        };
        let across = jambs.map(onto);
        self.floors.push((None, vec![jambs[0], across[0], across[1], jambs[1]]));
        for k in 0..2 {
            self.walls.push((jambs[k], across[k]));
        }
        self.walls.extend([(one.ends.0, jambs[0]), (jambs[1], one.ends.1)]);
        self.walls.extend([(other.ends.1, across[0]), (across[1], other.ends.0)]);
    }

    /// A thing, as far as the robot meets it.
    fn put(&mut self, world: &World, home: &Frame, level: f64, replica: &orthoframe_map::Replica) {
        let place = home.compose(&replica.frame);
        for item in &world.objects[&replica.object].items {
            let shape = &world.orthoframes[&item.orthoframe];
            let frame = place.compose(&item.frame);
            let (bottom, top) = (frame.z.get() - level, frame.z.get() - level + shape.height.get());
            let meets = if top <= bottom { bottom } else { top } > world.robot.step.get();
            if !meets || bottom >= world.robot.height.get() {
                continue;
            }
            let middle: Vector =
                shape.base.iter().map(|v| v.start.coords).sum::<Vector>() / shape.base.len() as f64;
            let widest = shape.roof_scale.max(1.0);
            let corner = |p: Point| frame.apply(Point::from(middle + (p.coords - middle) * widest));
            self.things.push(shape.base.iter().map(|v| corner(v.start)).collect());
        }
    }
}

/// A raster of the floor: what each cell belongs to, and how far its middle is from everything solid.
struct Raster {
    low: Point,
    columns: usize,
    rows: usize,
    area: Vec<Option<Option<AreaId>>>,
    room: Vec<f64>,
}

/// Side of a cell, cm.
const CELL: f64 = 3.0;

impl Raster {
    /// Distances are exact up to `most`.
    fn of(ground: &Ground, most: f64) -> Self {
        let corners = || ground.floors.iter().flat_map(|f| &f.1);
        let low = corners().fold(Point::new(f64::MAX, f64::MAX), |l, c| l.inf(c));
        let high = corners().fold(Point::new(f64::MIN, f64::MIN), |h, c| h.sup(c));
        let [columns, rows] = [high.x - low.x, high.y - low.y].map(|l| (l / CELL) as usize + 2);
        let mut raster = Self {
            low,
            columns,
            rows,
            area: vec![None; columns * rows],
            room: vec![most; columns * rows],
        };
        for (area, ring) in &ground.floors {
            for cell in raster.around(ring, 1.0) {
                if raster.area[cell].is_none_or(|a| a.is_none())
                    && inside(raster.middle(cell), ring)
                {
                    raster.area[cell] = Some(*area);
                }
            }
        }
        let edges = ground
            .things
            .iter()
            .flat_map(|t| (0..t.len()).map(move |k| (t[k], t[(k + 1) % t.len()])));
        for solid in ground.walls.iter().copied().chain(edges) {
            for cell in raster.around(&[solid.0, solid.1], most) {
                let far = apart(raster.middle(cell), solid);
                raster.room[cell] = raster.room[cell].min(far);
            }
        }
        for thing in &ground.things {
            for cell in raster.around(thing, 0.0) {
                if inside(raster.middle(cell), thing) {
                    raster.room[cell] = 0.0;
                }
            }
        }
        raster
    }

    fn around(&self, points: &[Point], by: f64) -> Vec<usize> {
        let low = points.iter().fold(points[0], |l, c| l.inf(c)) - Vector::new(by, by);
        let high = points.iter().fold(points[0], |h, c| h.sup(c)) + Vector::new(by, by);
        let cell = |v: f64, most: usize| ((v / CELL).max(0.0) as usize).min(most - 1);
        let (x, y) = (cell(low.x - self.low.x, self.columns), cell(low.y - self.low.y, self.rows));
        let (to_x, to_y) =
            (cell(high.x - self.low.x, self.columns), cell(high.y - self.low.y, self.rows));
        (y..=to_y)
            .flat_map(|y| (x..=to_x).map(move |x| (x, y)))
            .map(|(x, y)| y * self.columns + x)
            .collect()
    }

    fn middle(&self, cell: usize) -> Point {
        let (x, y) = ((cell % self.columns) as f64, (cell / self.columns) as f64);
        self.low + Vector::new(x + 0.5, y + 0.5) * CELL
    }

    /// Which cells hang together whose middles have so much room; 0 for the others.
    fn flood(&self, least: f64, over_corners: bool) -> Vec<u32> {
        let mut label = vec![0; self.area.len()];
        for seed in 0..label.len() {
            let mut open = vec![seed];
            while let Some(at) = open.pop() {
                if label[at] != 0 || self.area[at].is_none() || self.room[at] < least {
                    continue;
                }
                label[at] = seed as u32 + 1;
                let (x, y) = ((at % self.columns) as i64, (at / self.columns) as i64);
                for (dx, dy) in (-1..=1).flat_map(|dx| (-1..=1).map(move |dy| (dx, dy))) {
                    let (x, y) = (x + dx, y + dy);
                    let within =
                        (0..self.columns as i64).contains(&x) && (0..self.rows as i64).contains(&y);
                    if within && (over_corners || dx == 0 || dy == 0) {
                        open.push(y as usize * self.columns + x as usize);
                    }
                }
            }
        }
        label
    }
}

#[test]
fn no_way_is_where_a_fill_of_the_floor_finds_none() {
    let (mut random, mut turn) = (Random(26), 0);
    // A raster of a university is of 20 million cells.
    for (name, mut world) in worlds().filter(|w| long() || w.0 != "osmag/SIST_1.osm") {
        // Leaves are another test's; here doors are openings.
        for door in world.doors.values_mut() {
            (door.kind, door.state) = (DoorKind::Passage, DoorState::OPEN);
            door.leaves.clear();
        }
        world.replicas.values_mut().for_each(|r| r.door_states.clear());
        for &map in world.maps.keys() {
            let ground = Ground::of(&world, map);
            let mut radii = vec![25.0];
            radii.extend((0..if long() { 5 } else { 1 }).map(|_| random.between(14.0, 45.0)));
            if !long() {
                // One of the two, by turns.
                radii.remove(turn % 2);
                turn += 1;
            }
            let raster = Raster::of(&ground, 60.0);
            for radius in radii {
                let plan = plan(&world, map, radius);
                let reach = plan.reach();
                // A tangent keeps away by 1.3 % more; half a cell's side or diagonal lies between two middles.
                let surely = raster.flood(reach * 1.014 + CELL * 0.51, false);
                let perhaps = raster.flood(reach - CELL * 0.72 - 0.1, true);
                // In each piece of each room the place with the most room.
                let mut best: BTreeMap<(AreaId, u32), usize> = BTreeMap::new();
                for (cell, &piece) in surely.iter().enumerate().filter(|c| *c.1 != 0) {
                    let Some(Some(area)) = raster.area[cell] else {
                        continue;
                    };
                    let known = best.entry((area, piece)).or_insert(cell);
                    if raster.room[cell] > raster.room[*known] {
                        *known = cell;
                    }
                }
                let places: Vec<((AreaId, u32), usize)> = best.into_iter().collect();
                for (i, &((one, piece), p)) in places.iter().enumerate() {
                    for &((other, next), q) in &places[..i] {
                        let (from, to) = (raster.middle(p), raster.middle(q));
                        let joined = plan.are_joined(from, to);
                        let told = || {
                            let (a, b) = (&world.areas[&one].name, &world.areas[&other].name);
                            format!("{name}, {radius}: {a} {from} – {b} {to}")
                        };
                        assert!(joined || piece != next, "there is a way: {}", told());
                        assert!(!joined || perhaps[p] == perhaps[q], "there is none: {}", told());
                    }
                }
            }
        }
    }
}

#[test]
fn walls_beside_a_doorway_stay_where_the_corridor_goes_round_the_room() {
    for (file, room, corridor) in [
        ("cases/mini4.json", "Кабинет-4", "Помещение-2"),
        ("cases/mini6.json", "Помещение-6", "Помещение-20"),
    ] {
        let Some(world) = world(file) else { return };
        let map = *world.maps.keys().next().expect("a map");
        let area = |name: &str| world.areas.values().find(|a| a.name == name).expect("a room").id;
        for radius in [25.0, 24.9, 24.8, 20.0, 10.0] {
            let plan = plan(&world, map, radius);
            let from = plan.rest_in(area(room)).expect("the robot fits");
            let way = plan.route(&world, from, Target::Area(area(corridor)), Method::Shortest);
            let way = way.unwrap_or_else(|no| panic!("{file} at {radius}: {no:?}"));
            assert!(plan.clearance(&way.points) > radius - 0.006, "{file} at {radius}");
        }
    }
}

#[test]
fn a_way_to_a_room_ends_in_the_room() {
    let mut random = Random(27);
    for (name, world) in worlds() {
        for &map in world.maps.keys() {
            let plan = plan(&world, map, world.robot.radius.get());
            let stands = stands(&plan);
            let share =
                if long() { 1.0 } else { 60.0 / (stands.len() * stands.len()).max(1) as f64 };
            for &(from, p) in &stands {
                for &(to, _) in stands.iter().filter(|_| random.unit() < share) {
                    let told = || {
                        format!("{name}: {} → {}", world.areas[&from].name, world.areas[&to].name)
                    };
                    match plan.route(&world, p, Target::Area(to), Method::Shortest) {
                        Ok(way) => {
                            let end = *way.points.last().expect("two points");
                            let floor = plan.fragment(to).expect("the room");
                            assert!(floor.fits(end), "{} ends elsewhere", told());
                        }
                        Err(no) => assert!(!no.barriers().is_empty(), "{}: {no:?}", told()),
                    }
                }
            }
        }
    }
}

#[test]
fn a_room_without_a_door_is_told_so() {
    let Some(world) = world("cases/ell.json") else {
        return;
    };
    let map = *world.maps.keys().next().expect("a map");
    let archive = world.areas.values().find(|a| a.name == "Archive").expect("a room").id;
    let plan = plan(&world, map, 25.0);
    let no = plan.route(&world, Point::new(900.0, 900.0), Target::Area(archive), Method::Shortest);
    assert_eq!(no.unwrap_err().barriers(), [Barrier::Doorless { area: archive }]);
}
