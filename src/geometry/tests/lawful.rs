//! Ways over floor with zones against a judge that samples them densely, and against a search over a grid.

use std::cmp::Reverse;
use std::collections::{BTreeMap, BinaryHeap};

use orthoframe_geometry::{Bounds, DoorStates, FloorPlan, Method, NoRoute, Target};
use orthoframe_map::{Extent, Forms, World, Zone, ZoneKind};
use orthoframe_units::{Deg, MapId, Point, Vector, ZoneId};

/// A row of numbers that looks like chance.
fn dice(mut state: u64) -> impl FnMut(u64) -> f64 {
    move |below| {
        state =
            state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        ((state >> 33) % below) as f64
    }
}

/// What the judge knows of a zone: its kind and its corners, as the map has them.
type Region<'a> = (ZoneKind, &'a [Point]);

fn is_inside(corners: &[Point], p: Point) -> bool {
    let sides = (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]));
    let crossed = sides.filter(|(a, b)| {
        (a.y > p.y) != (b.y > p.y) && p.x < a.x + (p.y - a.y) / (b.y - a.y) * (b.x - a.x)
    });
    crossed.count() % 2 == 1
}

fn distance(corners: &[Point], p: Point) -> f64 {
    if is_inside(corners, p) {
        return 0.0;
    }
    from_rim(corners, p)
}

fn from_rim(corners: &[Point], p: Point) -> f64 {
    let sides = (0..corners.len()).map(|i| (corners[i], corners[(i + 1) % corners.len()]));
    let to_side = |(a, b): (Point, Point)| {
        let along: Vector = b - a;
        let t = ((p - a).dot(&along) / along.norm_squared()).clamp(0.0, 1.0);
        (a + along * t - p).norm()
    };
    sides.map(to_side).fold(f64::INFINITY, f64::min)
}

/// Places along a way, a centimetre from each other at the most.
fn samples(points: &[Point]) -> Vec<Point> {
    let mut all = vec![points[0]];
    for leg in points.windows(2) {
        let count = (leg[1] - leg[0]).norm().ceil().max(1.0) as u32;
        let at = |k: u32| leg[0] + (leg[1] - leg[0]) * (f64::from(k) / f64::from(count));
        all.extend((1..=count).map(at));
    }
    all
}

/// What a way costs in cm at full speed; none where it runs against a one-way zone, or so near to it.
fn cost(points: &[Point], zones: &[Region<'_>], speed: f64, margin: f64) -> Option<f64> {
    let mut sum = 0.0;
    for step in samples(points).windows(2) {
        let (way, middle) = (step[1] - step[0], nalgebra::center(&step[0], &step[1]));
        let mut times = 1.0_f64;
        for (kind, corners) in zones {
            match kind {
                ZoneKind::OneWay { heading } => {
                    let angle = heading.get().to_radians();
                    let is_in = |p: &Point| match margin > 0.0 {
                        true => distance(corners, *p) <= margin,
                        false => is_inside(corners, *p) && from_rim(corners, *p) > 1e-4,
                    };
                    let is_in = [step[0], middle, step[1]].iter().any(is_in);
                    if is_in && way.dot(&Vector::new(angle.cos(), angle.sin())) < -1e-6 {
                        return None;
                    }
                }
                ZoneKind::Slow { speed: slow }
                    if is_inside(corners, middle) && from_rim(corners, middle) > 1e-4 =>
                {
                    times = times.max(speed / slow);
                }
                _ => {}
            }
        }
        sum += way.norm() * times;
    }
    Some(sum)
}

/// A grid over the floor as if there were no zones: places where the robot fits, and steps between them on which it does.
struct Raster {
    places: Vec<Point>,
    steps: Vec<Vec<usize>>,
}

impl Raster {
    fn of(plan: &FloorPlan, spacing: f64) -> Self {
        let bounds =
            plan.fragments().fold(Bounds::EMPTY, |bounds, fragment| bounds.union(&fragment.bounds));
        let size = bounds.max - bounds.min;
        let (width, height) = ((size.x / spacing) as i64, (size.y / spacing) as i64);
        let mut numbers = BTreeMap::new();
        let mut places = Vec::new();
        for y in 0..=height {
            for x in 0..=width {
                let at = bounds.min + Vector::new(x as f64, y as f64) * spacing;
                if plan.fits(at) {
                    numbers.insert((x, y), places.len());
                    places.push(at);
                }
            }
        }
        let mut steps = vec![Vec::new(); places.len()];
        for (&(x, y), &from) in &numbers {
            for (dx, dy) in (-2..=2).flat_map(|dx| (-2..=2).map(move |dy| (dx, dy))) {
                let Some(&to) = numbers.get(&(x + dx, y + dy)).filter(|to| **to != from) else {
                    continue;
                };
                let way = samples(&[places[from], places[to]]);
                // Two pieces of floor may lie nearer to each other than the samples.
                let is_one = plan.are_joined(places[from], places[to]);
                if is_one && way.iter().all(|p| plan.fits(*p)) {
                    steps[from].push(to);
                }
            }
        }
        Self { places, steps }
    }

    /// The least cost from a place to all others, for a robot that keeps `reach` from all that is shut.
    fn costs(&self, from: usize, zones: &[Region<'_>], reach: f64, speed: f64) -> Vec<f64> {
        let is_free = |p: Point| {
            zones.iter().all(|(kind, c)| !kind.is_shut() || distance(c, p) >= reach + 0.01)
        };
        let mut costs = vec![f64::INFINITY; self.places.len()];
        let mut open = BinaryHeap::from([Reverse((0.0_f64.to_bits(), from))]);
        costs[from] = 0.0;
        while let Some(Reverse((spent, here))) = open.pop() {
            if f64::from_bits(spent) > costs[here] {
                continue;
            }
            for &next in &self.steps[here] {
                let leg = [self.places[here], self.places[next]];
                if !samples(&leg).iter().all(|p| is_free(*p)) {
                    continue;
                }
                let Some(step) = cost(&leg, zones, speed, 0.6) else { continue };
                let sum = costs[here] + step;
                if sum < costs[next] {
                    costs[next] = sum;
                    open.push(Reverse((sum.to_bits(), next)));
                }
            }
        }
        costs
    }
}

/// A zone with the corners of a turned rectangle, or of an L.
fn thrown(id: u32, map: MapId, within: &Bounds, throw: &mut impl FnMut(u64) -> f64) -> Zone {
    let size = within.max - within.min;
    let at = within.min + Vector::new(size.x * throw(1000) / 1000.0, size.y * throw(1000) / 1000.0);
    let (w, h) = (40.0 + throw(200), 40.0 + throw(200));
    let shape = match throw(3) as u32 {
        0 => vec![(0.0, 0.0), (w, 0.0), (w, h / 3.0), (w / 3.0, h / 3.0), (w / 3.0, h), (0.0, h)],
        _ => vec![(0.0, 0.0), (w, 0.0), (w, h), (0.0, h)],
    };
    let turn = nalgebra::Rotation2::new((throw(8) * 45.0_f64 + throw(2) * 17.0).to_radians());
    let corners = shape.into_iter().map(|(x, y)| at + turn * Vector::new(x, y)).collect();
    let kind = match throw(5) as u32 {
        0 => ZoneKind::KeepOut,
        1 => ZoneKind::Closed,
        2 => ZoneKind::Slow { speed: 6.0 + throw(60) },
        _ => ZoneKind::OneWay { heading: Deg::of(throw(24) * 15.0) },
    };
    Zone {
        id: ZoneId(id),
        key: format!("zone-{id}"),
        name: format!("Зона-{id}"),
        name_en: String::new(),
        kind,
        extent: Extent::Polygon { map, corners },
        reason: String::new(),
        reason_en: String::new(),
        from: None,
        until: None,
        forms: Forms::new(),
    }
}

fn regions(world: &World) -> Vec<Region<'_>> {
    world
        .zones
        .values()
        .map(|zone| match &zone.extent {
            Extent::Polygon { corners, .. } => (zone.kind, corners.as_slice()),
            Extent::Areas(_) => (zone.kind, &[][..]),
        })
        .collect()
}

/// A way never enters what is shut, never runs against a one-way zone, and is as quick as any over the grid; where there is
/// none, the grid has none either. From within what is shut the robot gets out, and stays out.
#[test]
fn ways_keep_to_zones_and_there_is_one_where_a_grid_has_one() {
    let seeds = if std::env::var_os("ORTHOFRAME_LONG").is_some() { 40 } else { 20 };
    let (mut found, mut none, mut out, mut slowed) = (0, 0, 0, 0);
    for (number, file) in ["rb2", "lab"].into_iter().enumerate() {
        let path = format!("{}/../../maps/{file}.toml", env!("CARGO_MANIFEST_DIR"));
        let mut world = World::load(path).expect("a map of the project");
        let map = *world.maps.keys().next().expect("it has one");
        let plain = FloorPlan::build(&world, map, &world.robot, &DoorStates::new());
        let raster = Raster::of(&plain, 10.0);
        let bounds = plain
            .fragments()
            .fold(Bounds::EMPTY, |bounds, fragment| bounds.union(&fragment.bounds));
        let (reach, speed) = (plain.reach(), world.robot.speed);
        for seed in 0..seeds {
            let mut throw = dice(seed * 2 + number as u64 + 5);
            world.zones.clear();
            for id in 1..=1 + throw(4) as u32 {
                let zone = thrown(id, map, &bounds, &mut throw);
                world.zones.insert(zone.id, zone);
            }
            let plan = plain.with_zones(&world, |_| true);
            // Laid out and taken away, they leave the floor as it is built.
            let built = FloorPlan::build(&world, map, &world.robot, &DoorStates::new());
            assert!(built.fragments().eq(plan.fragments()), "{file}, seed {seed}");
            let bare = plan.with_zones(&world, |_| false);
            assert!(bare.fragments().eq(plain.fragments()), "{file}, seed {seed}");
            let zones = regions(&world);
            let is_shut_near = |p: Point| {
                zones.iter().any(|(kind, c)| kind.is_shut() && distance(c, p) < reach + 0.01)
            };
            let from = throw(raster.places.len() as u64) as usize;
            let start = raster.places[from];
            let costs = raster.costs(from, &zones, reach, speed);
            for _ in 0..6 {
                let to = throw(raster.places.len() as u64) as usize;
                let goal = raster.places[to];
                let route = plan.route(&world, start, Target::Point(goal), Method::Shortest);
                let case = || format!("{file}, seed {seed}: {start} to {goal}, {zones:?}");
                if is_shut_near(goal) {
                    continue;
                }
                let is_out = is_shut_near(start);
                match route {
                    Err(no) => {
                        none += 1;
                        assert!(is_out || costs[to].is_infinite(), "{no:?} {}", case());
                        assert!(!matches!(no, NoRoute::NoFloor), "{no:?} {reach} {}", case());
                    }
                    Ok(route) => {
                        found += 1;
                        let way = samples(&route.points);
                        // A robot with a footprint passes a strait along its own heading.
                        let radius =
                            world.robot.passing_width() / 2.0 - world.robot.clearance.get();
                        let touches = |p: &Point| {
                            zones.iter().any(|(k, c)| k.is_shut() && distance(c, *p) < radius - 0.1)
                        };
                        let left = way.iter().position(|p| !touches(p)).unwrap_or(0);
                        assert!(is_out || left == 0, "{}", case());
                        out += u64::from(left > 0);
                        assert!(!way[left..].iter().any(touches), "{}", case());
                        assert!(
                            way.iter().all(|p| plain.fits(*p)
                                || plain.standing_at(*p).is_some_and(|q| (q - p).norm() < 0.01)),
                            "{}",
                            case()
                        );
                        if is_out {
                            continue;
                        }
                        let own = cost(&route.points, &zones, speed, 0.0);
                        let own = own.unwrap_or_else(|| panic!("against a zone: {}", case()));
                        assert!(
                            own <= costs[to] * 1.001 + 1.0,
                            "{own} > {} {} {:?}",
                            costs[to],
                            case(),
                            route.points
                        );
                        slowed += u64::from(own > route.length + 1.0);
                    }
                }
            }
        }
    }
    let least = [200, 50, 5, 5].map(|of_all| of_all * seeds / 40);
    let counts = [found, none, out, slowed];
    assert!(counts.iter().zip(least).all(|(count, least)| *count > least), "{counts:?}");
}
