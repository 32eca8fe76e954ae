//! Missions by senses alone in worlds that are not as believed: doors that are shut or locked, things that were moved,
//! that came, that are gone, people who walk about. Each ends: done, and it is so; or told impossible, and it is so by a
//! judge who goes over the truth cell by cell and knows nothing of the robot's floor, rules or routes.

#![allow(clippy::print_stdout, reason = "figures for benches/README.md")]

use std::collections::{BTreeSet, VecDeque};

use orthoframe_geometry::{
    Bounds, Openings, Polygon, Prism, STEP_REACH, Scene, nearest_on_segment,
};
use orthoframe_map::{DoorKind, DoorState, DoorStatus, Entity, Permeability, Replica, World};
use orthoframe_robot::*;
use orthoframe_units::{AreaId, Frame, MapId, Point, ReplicaId, Stop};

use super::setting::{Setting, file};

/// What the robot is to bring about.
#[derive(Debug, Clone)]
enum Task {
    BeIn(AreaId),
    Hold(ReplicaId),
}

impl Task {
    fn goal(&self, world: &World) -> GoalFact {
        let (predicate, what) = match *self {
            Self::BeIn(area) => ("РОБОТ-НАХОДИТСЯ-В", Entity::Area(area)),
            Self::Hold(thing) => ("РОБОТ-ДЕРЖИТ", Entity::Replica(thing)),
        };
        GoalFact { predicate: predicate.to_owned(), args: vec![world.name(what).to_owned()] }
    }
}

/// A truth that differs from the Map, by a seed.
struct Differing {
    truth: World,
    told: Vec<String>,
}

fn outline(world: &World, map: MapId, thing: ReplicaId) -> Vec<Prism> {
    Scene::of(world, map).replicas.get(&thing).map(|r| r.prisms.clone()).unwrap_or_default()
}

/// Whether bodies within the robot's height overlap on the floor.
fn overlap(a: &[Prism], b: &[Prism]) -> bool {
    a.iter().any(|a| {
        b.iter().any(|b| {
            a.bounds.meets(&b.bounds)
                && (a.polygon.corners.iter().any(|p| b.polygon.contains(*p, -0.1))
                    || b.polygon.corners.iter().any(|p| a.polygon.contains(*p, -0.1))
                    || a.polygon.contains(b.polygon.centroid(), 0.0)
                    || b.polygon.contains(a.polygon.centroid(), 0.0)
                    || edges_cross(&a.polygon, &b.polygon))
        })
    })
}

fn edges_cross(a: &Polygon, b: &Polygon) -> bool {
    let side = |p: Point, q: Point, r: Point| (q - p).perp(&(r - p));
    a.edges().any(|(p, q)| {
        b.edges().any(|(r, s)| {
            side(p, q, r) * side(p, q, s) < 0.0 && side(r, s, p) * side(r, s, q) < 0.0
        })
    })
}

/// Whether a thing stands within its room, in nothing else, and not where the robot begins.
fn stands(world: &World, map: MapId, thing: ReplicaId, robot: Point) -> bool {
    let scene = Scene::of(world, map);
    let own = outline(world, map, thing);
    let Some(replica) = world.replicas.get(&thing) else { return false };
    let Some(room) = scene.areas.get(&replica.area).and_then(|area| area.prisms.first()) else {
        return false;
    };
    let is_inside = own.iter().all(|prism| {
        prism.polygon.corners.iter().all(|p| room.polygon.contains(*p, 0.0))
            && !edges_cross(&prism.polygon, &room.polygon)
    });
    let is_clear =
        scene.replicas.values().all(|other| other.id == thing || !overlap(&own, &other.prisms));
    let keeps_off = own.iter().all(|prism| {
        !prism.polygon.contains(robot, 0.0) && prism.polygon.border_distance(robot) > 60.0
    });
    is_inside && is_clear && keeps_off
}

/// The doors of a map that have leaves.
fn leafed(world: &World) -> Vec<orthoframe_units::DoorId> {
    let doors =
        world.doors.values().filter(|d| d.kind != DoorKind::Passage && !d.leaves.is_empty());
    let in_rooms: BTreeSet<_> =
        Openings::of(world, STEP_REACH).iter().filter_map(|opening| opening.door).collect();
    doors.map(|door| door.id).filter(|id| in_rooms.contains(id)).collect()
}

fn differ(world: &World, map: MapId, robot: Point, dice: &mut fastrand::Rng) -> Differing {
    let (mut truth, mut told) = (world.clone(), Vec::new());
    for id in leafed(world) {
        let state = match dice.usize(..6) {
            0 => DoorState::LOCKED,
            1 | 2 => DoorState::CLOSED,
            _ => continue,
        };
        truth.doors.get_mut(&id).unwrap().state = state;
        told.push(format!("{} {:?}", world.name(Entity::Door(id)), state.status));
    }
    // What stands on the floor, and bears nothing.
    let scene = Scene::of(world, map);
    let movable: Vec<ReplicaId> = scene
        .replicas
        .values()
        .filter(|thing| world.replicas[&thing.id].move_prob >= 30)
        .filter(|thing| thing.prisms.iter().all(|p| p.bottom < 60.0 && p.top > 30.0))
        .map(|thing| thing.id)
        .collect();
    for _ in 0..dice.usize(..3) {
        let Some(&id) = dice.choice(&movable) else { continue };
        let before = truth.replicas[&id].clone();
        let by = |dice: &mut fastrand::Rng| dice.f64() * 240.0 - 120.0;
        let (x, y) = (before.frame.x.get() + by(dice), before.frame.y.get() + by(dice));
        let frame = Frame::new(x, y, before.frame.z.get(), before.frame.angle);
        truth.replicas.get_mut(&id).unwrap().frame = frame;
        match stands(&truth, map, id, robot) {
            true => told.push(format!("{} moved to {x:.0};{y:.0}", before.name)),
            false => {
                truth.replicas.insert(id, before);
            }
        }
    }
    // A chair that nobody knows of, half the time before a door.
    if let Some(&like) = dice.choice(&movable)
        && dice.bool()
    {
        let openings = Openings::of(world, STEP_REACH);
        let doors: Vec<_> =
            openings.iter().filter(|opening| opening.map == map && opening.is_through()).collect();
        let id = ReplicaId(truth.replicas.keys().map(|id| id.0).max().unwrap_or(0) + 1);
        for _ in 0..20 {
            let opening = doors[dice.usize(..doors.len())];
            let side = dice.usize(..2);
            let at = opening.before(side, 20.0 + dice.f64() * 130.0);
            let (Some(area), turn) = (scene.area_at(at), dice.usize(..4)) else { continue };
            let (_, placed) = world.placement(area).unwrap();
            let own = placed.invert(at);
            let angle = orthoframe_units::Deg::of(90.0 * turn as f64);
            let frame = Frame::new(own.x, own.y, 0.0, angle);
            let name = "Чужое".to_owned();
            let like = truth.replicas[&like].clone();
            truth.replicas.insert(
                id,
                Replica { id, area, frame, name, name_en: "Strange".to_owned(), ..like },
            );
            if stands(&truth, map, id, robot) {
                told.push(format!("a strange thing before {} at {at:.0?}", opening.name));
                break;
            }
            truth.replicas.remove(&id);
        }
    }
    if dice.usize(..4) == 0 && !movable.is_empty() {
        let gone = movable[dice.usize(..movable.len())];
        truth.replicas.remove(&gone);
        told.push(format!("{} gone", world.name(Entity::Replica(gone))));
    }
    Differing { truth, told }
}

/// Goes over the floor of the truth cell by cell. `spare` is kept between the robot and all else, cm.
struct Judge {
    reached: BTreeSet<(i32, i32)>,
}

const CELL: f64 = 5.0;

impl Judge {
    fn cell(p: Point) -> (i32, i32) {
        ((p.x / CELL).round() as i32, (p.y / CELL).round() as i32)
    }

    fn point((x, y): (i32, i32)) -> Point {
        Point::new(f64::from(x) * CELL, f64::from(y) * CELL)
    }

    /// All that a robot reaches that opens every door that is not locked where nothing stops its leaf.
    fn of(truth: &World, map: MapId, from: Point, spare: f64) -> Self {
        let robot = &truth.robot;
        let reach = robot.radius.get() + spare;
        let scene = Scene::of(truth, map);
        let mut solids: Vec<(Point, Point)> = Vec::new();
        for prism in scene.areas.values().flat_map(|area| &area.prisms) {
            let sides = prism.polygon.edges().zip(prism.sides.iter());
            solids.extend(
                sides.filter(|(_, s)| s.permeability == Permeability::Impermeable).map(|(e, _)| e),
            );
        }
        let bodies: Vec<&Prism> = scene
            .replicas
            .values()
            .flat_map(|thing| &thing.prisms)
            .filter(|p| p.bottom < robot.height.get() && p.top > robot.step.get())
            .collect();
        solids.extend(bodies.iter().flat_map(|body| body.polygon.edges()));
        let openings = Openings::of(truth, STEP_REACH);
        let mut shut: Vec<(Point, Point)> = Vec::new();
        for opening in openings.iter().filter(|o| o.map == map && o.is_through()) {
            let Some(door) = opening.door.and_then(|id| truth.doors.get(&id)) else { continue };
            if door.leaves.is_empty() {
                continue;
            }
            let leaves = opening.leaves(door);
            let at = |opening: f64| {
                let status = if opening > 0.0 { DoorStatus::Open } else { DoorStatus::Closed };
                leaves.obstacles(DoorState { status, opening })
            };
            let is_stopped = || {
                (0..=40).any(|step| {
                    at(f64::from(step) * 2.5).iter().any(|leaf| {
                        bodies.iter().any(|body| {
                            let tall =
                                if door.height.get() > 0.0 { door.height.get() } else { 200.0 };
                            body.bottom < tall
                                && (leaf.corners.iter().any(|p| body.polygon.contains(*p, 0.0))
                                    || body.polygon.corners.iter().any(|p| leaf.contains(*p, 0.0))
                                    || edges_cross(leaf, &body.polygon))
                        })
                    })
                })
            };
            let stays_shut = match door.state.status {
                DoorStatus::Open => {
                    solids.extend(
                        leaves
                            .obstacles(door.state)
                            .iter()
                            .flat_map(|l| l.edges().collect::<Vec<_>>()),
                    );
                    false
                }
                DoorStatus::Locked => true,
                DoorStatus::Closed => is_stopped(),
            };
            if stays_shut {
                shut.push(opening.line());
            } else if door.state.status == DoorStatus::Closed {
                solids.extend(at(100.0).iter().flat_map(|l| l.edges().collect::<Vec<_>>()));
            }
        }
        let walls: Vec<(Bounds, (Point, Point))> = solids
            .iter()
            .chain(&shut)
            .map(|&(a, b)| (Bounds::of([a, b]).grown(reach), (a, b)))
            .collect();
        let is_free = |p: Point| {
            scene.area_at(p).is_some()
                && walls
                    .iter()
                    .filter(|(near, _)| near.contains(p))
                    .all(|(_, (a, b))| (nearest_on_segment(p, *a, *b) - p).norm() >= reach)
                && !bodies.iter().any(|body| body.polygon.contains(p, 0.0))
        };
        // Between the rooms' floors lies the threshold, which is in no room.
        let lies_between = |p: Point| {
            openings.iter().filter(|o| o.map == map && o.is_through()).any(|o| {
                (o.middle() - p).norm() <= o.gap / 2.0 + o.width() / 2.0
                    && (p - o.at(0.0, 0.0)).dot(&o.out()) >= -1.0
                    && (p - o.at(0.0, 0.0)).dot(&o.out()) <= o.gap + 1.0
            })
        };
        let is_way = |p: Point| {
            is_free(p)
                || (lies_between(p)
                    && walls
                        .iter()
                        .filter(|(near, _)| near.contains(p))
                        .all(|(_, (a, b))| (nearest_on_segment(p, *a, *b) - p).norm() >= reach))
        };
        let mut reached = BTreeSet::new();
        // Where it stands it stands, however near to something.
        let start = Self::cell(from);
        let mut queue = VecDeque::from([start]);
        reached.insert(start);
        while let Some((x, y)) = queue.pop_front() {
            for (dx, dy) in [(1, 0), (-1, 0), (0, 1), (0, -1)] {
                let next = (x + dx, y + dy);
                if !reached.contains(&next) && is_way(Self::point(next)) {
                    reached.insert(next);
                    queue.push_back(next);
                }
            }
        }
        Self { reached }
    }

    /// Whether the task can be done from somewhere.
    fn allows(&self, truth: &World, map: MapId, task: &Task) -> bool {
        let scene = Scene::of(truth, map);
        match *task {
            // Well within the room: at a door one stands in either of two.
            Task::BeIn(area) => self.reached.iter().any(|cell| {
                let p = Self::point(*cell);
                scene.area_at(p) == Some(area)
            }),
            Task::Hold(thing) => {
                let Some(placed) = scene.replicas.get(&thing) else { return false };
                let at = nalgebra::center(&placed.bounds.min, &placed.bounds.max);
                // Nearer than the arm is long: the robot takes it from the places that serve what bears it.
                let arm = truth.robot.radius.get() + 60.0;
                self.reached.iter().any(|cell| (Self::point(*cell) - at).norm() <= arm)
            }
        }
    }
}

/// Of one seed alone all is told.
fn short(told: &str) -> String {
    let most = if std::env::var_os("ORTHOFRAME_SEED").is_some() { usize::MAX } else { 300 };
    told.chars().take(most).collect()
}

struct Counts {
    done: usize,
    truly_impossible: usize,
    wrongly_impossible: Vec<String>,
    lost: Vec<String>,
    /// Contacts with what its laser sees, and how many there were with what that passes over or under.
    contacts: Vec<String>,
    unseen: usize,
    replans: usize,
}

/// A mission by senses alone in a truth.
fn run(
    world: &World,
    differing: &Differing,
    task: &Task,
    senses: Senses,
    how: &str,
    counts: &mut Counts,
) {
    let setting = Setting::of(world.clone());
    let (map, pose, floors) = (setting.map, setting.pose, &setting.floors);
    let body = Simulator::new(differing.truth.clone(), map, pose);
    let mut body = SensingRobot::new(body, senses);
    let mut mission = setting.mission(setting.belief().unwrap());
    let ground = Ground::of(world, floors, senses.height);
    let finders = ground.finders();
    let mut log = Vec::new();
    let ending = match Pilot::new(&ground, &finders, &mut body, (map, pose)) {
        Ok(mut pilot) => {
            mission.belief.pose = pilot.pose().1;
            let mut tell = |event: &Event<'_>| match event {
                Event::Planned(_) => log.push("plan".to_owned()),
                Event::Started { directive, .. } => log.push(directive.to_string()),
                Event::Surprised { surprise, .. } => log.push(short(&format!("{surprise:?}"))),
                _ => {}
            };
            let goal = [task.goal(world)];
            mission.run(&goal, &mut pilot, &Stop::new(), &mut tell).unwrap()
        }
        Err(failure) => Ending::Failed(failure),
    };
    let scene = Scene::of(body.body().truth(), map);
    let is_seen = |touch: &&Touch| match touch.what {
        Some(Obstruction::Replica(thing)) => scene.replicas.get(&thing).is_some_and(|thing| {
            let at_laser = thing.prisms.iter();
            let mut at_laser =
                at_laser.filter(|p| p.bottom <= senses.height && senses.height < p.top);
            at_laser
                .any(|p| p.polygon.border_distance(touch.at.at) < world.robot.radius.get() + 3.0)
        }),
        _ => true,
    };
    let (seen, unseen): (Vec<&Touch>, Vec<&Touch>) = body.touched().iter().partition(is_seen);
    counts.contacts.extend(seen.iter().map(|touch| format!("{how}: {touch:?}")));
    counts.unseen += unseen.len();
    counts.replans += log.iter().filter(|line| *line == "plan").count().saturating_sub(1);
    let (_, truly) = body.body().pose();
    let told = || {
        format!(
            "{how}: {:?}\n  {}\n  {}\n  at {truly:?} believed {:?}",
            differing.told,
            log.join("\n  "),
            match &ending {
                Ending::NoPlan(_) => "no plan".to_owned(),
                other => short(&format!("{other:?}")),
            },
            (mission.belief.pose, body.people())
        )
    };
    match &ending {
        Ending::Done | Ending::AlreadyTrue => {
            let scene = Scene::of(body.body().truth(), map);
            let holds = match *task {
                Task::BeIn(area) => {
                    scene.area_at(truly.at) == Some(area)
                    // On the threshold it is in both.
                    || scene.areas[&area].prisms[0].polygon.border_distance(truly.at) < 10.0
                }
                Task::Hold(thing) => !body.body().truth().replicas.contains_key(&thing),
            };
            assert!(holds, "told done, and is not so: {}", told());
            counts.done += 1;
        }
        Ending::NoPlan(_) | Ending::Stuck(_) => {
            // With what it keeps from everything by its profile, and a cell more for what the judge's raster leaves out.
            let spare = world.robot.clearance.get() + 2.0 + CELL / 2.0;
            let judge = Judge::of(&differing.truth, map, pose.at, spare);
            match judge.allows(&differing.truth, map, task) {
                true => counts.wrongly_impossible.push(told()),
                false => counts.truly_impossible += 1,
            }
        }
        Ending::Failed(Failure::Nowhere { .. }) => counts.lost.push(told()),
        Ending::Failed(_) | Ending::Stopped => panic!("{}", told()),
    }
}

/// Fifteen missions; with ORTHOFRAME_LONG set, a hundred; from the seed ORTHOFRAME_FROM, or ORTHOFRAME_SEED alone.
#[test]
fn missions_in_worlds_that_differ_end_done_or_truly_impossible() {
    let count = if std::env::var_os("ORTHOFRAME_LONG").is_some() { 100 } else { 15 };
    let told = |name| std::env::var(name).ok().and_then(|seed| seed.parse::<u64>().ok());
    let (from, one) = (told("ORTHOFRAME_FROM").unwrap_or(0), told("ORTHOFRAME_SEED"));
    let (from, count) = one.map_or((from, count), |one| (one, 1));
    let world = World::load(file("maps/rb2.toml")).unwrap();
    let (map, pose) = starting_pose(&world).unwrap();
    let medicine = world.find("Лекарство").into_iter().find_map(|entity| match entity {
        Entity::Replica(id) => Some(id),
        _ => None,
    });
    let mut counts = Counts {
        done: 0,
        truly_impossible: 0,
        wrongly_impossible: Vec::new(),
        lost: Vec::new(),
        contacts: Vec::new(),
        unseen: 0,
        replans: 0,
    };
    for seed in from..from + count {
        let mut dice = fastrand::Rng::with_seed(seed);
        let differing = differ(&world, map, pose.at, &mut dice);
        let areas: Vec<AreaId> = world.areas.keys().copied().collect();
        let task = match dice.bool() {
            true => Task::BeIn(areas[dice.usize(..areas.len())]),
            false => Task::Hold(medicine.expect("the flat has medicine")),
        };
        let senses = Senses { people: dice.usize(..3), ..Senses::of_seed(seed) };
        let begun = std::time::Instant::now();
        run(&world, &differing, &task, senses, &format!("seed {seed} {task:?}"), &mut counts);
        if one.is_some() || begun.elapsed().as_secs() > 20 {
            println!("seed {seed}: {:?}", begun.elapsed());
        }
    }
    let Counts { done, truly_impossible, wrongly_impossible, lost, contacts, unseen, replans } =
        &counts;
    println!(
        "{count} missions: {done} done, {truly_impossible} truly impossible, {} wrongly, {} lost; {replans} replans, {} contacts with what the laser sees, {unseen} with what it does not",
        wrongly_impossible.len(),
        lost.len(),
        contacts.len()
    );
    for told in wrongly_impossible.iter().chain(lost).chain(contacts) {
        println!("{told}");
    }
    let right = done + truly_impossible;
    let all = right + wrongly_impossible.len() + lost.len();
    assert!(right as f64 >= 0.98 * all as f64, "{right} of {all}");
    assert!(contacts.len() * 100 <= all, "{contacts:?}");
}
