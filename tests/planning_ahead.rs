//! What the floor is asked before an order's plan is proven, and what of a plan is tried before it is proposed: in furnished
//! buildings drawn at random.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use orthoframe_geometry::{DoorStates, FloorPlan, LastingFloor, Method, Target};
use orthoframe_graphplan::Limits;
use orthoframe_map::*;
use orthoframe_robot::{Belief, Ending, Event, GoalFact, Mission, Simulator, starting_pose};
use orthoframe_semantics::{Followed, RelationRules, derive, predicate};
use orthoframe_strips::Domain;
use orthoframe_units::*;

use crate::files::project;
use crate::generated_worlds::Dice;
use crate::planning_floor::{Judge, begun, furnished};
use crate::planning_time::building_of;

/// So many buildings, or ten times as many where there is time.
fn seeds(few: u64) -> u64 {
    if std::env::var_os("ORTHOFRAME_LONG").is_some() { 10 * few } else { few }
}

fn floor_of(world: &World) -> FloorPlan {
    FloorPlan::build(world, MapId(1), &world.robot, &DoorStates::new())
}

fn doors_of(world: &World, area: AreaId) -> impl Iterator<Item = DoorId> {
    world.areas[&area].doors.iter().map(|mount| mount.door)
}

fn is_through(from: &Target, to: &Target) -> bool {
    matches!((from, to), (Target::Door { door, .. }, Target::Door { door: same, .. }) if door == same)
}

/// The same building with some of what may go gone or moved, and doors open or shut.
fn varied(world: &World, dice: &mut Dice) -> World {
    let mut world = world.clone();
    let loose = world.replicas.iter().filter(|(_, thing)| thing.move_prob > 0);
    for id in loose.map(|(id, _)| *id).collect::<Vec<_>>() {
        match dice.below(3) {
            0 => drop(world.replicas.remove(&id)),
            1 => {
                let frame = &mut world.replicas.get_mut(&id).unwrap().frame;
                let by = [0, 0].map(|_| dice.below(80) as f64 - 40.0);
                *frame = Frame::new(by[0], by[1], 0.0, Deg::ZERO).compose(frame);
            }
            _ => {}
        }
    }
    for door in world.doors.values_mut() {
        door.state = [DoorState::OPEN, DoorState::CLOSED][dice.below(2)];
    }
    world
}

/// The floor asked before a proof refuses nothing that some setting of the doors and some place of what may go allows.
#[test]
fn what_is_refused_for_good_has_no_way_however_things_stand() {
    let (mut ways, mut refused) = (0, 0);
    for seed in 0..seeds(60) {
        let mut dice = Dice::new(seed);
        let kind = [DoorKind::Sliding, DoorKind::Hinged][dice.below(2)];
        let mut world = furnished(&mut dice, kind);
        for thing in world.replicas.values_mut() {
            thing.move_prob = [0, 0, 50][dice.below(3)];
        }
        let floor = floor_of(&world);
        let mut lasting =
            LastingFloor::of(&floor, &world, |thing| world.replicas[&thing].move_prob == 0);
        let mut allowed = BTreeSet::new();
        let spots = |area: AreaId| -> Vec<Target> {
            let places = world.places.values().filter(|place| place.area == area);
            let things = world.replicas.values().filter(|thing| thing.area == area);
            let doors = doors_of(&world, area).map(|door| Target::Door { door, area });
            let places = places.map(|place| Target::Place(place.id));
            places.chain(things.map(|thing| Target::Replica(thing.id))).chain(doors).collect()
        };
        let all: Vec<(AreaId, Vec<Target>)> =
            world.areas.keys().map(|&area| (area, spots(area))).collect();
        for _ in 0..6 {
            let now = varied(&world, &mut dice);
            let plan = floor_of(&now);
            let way = |from: Point, to: Target, areas: &[AreaId]| {
                let way = plan.route_within(&now, from, to, Method::Shortest, Some(areas)).ok()?;
                way.points.last().copied()
            };
            for (area, spots) in &all {
                let rests = plan.rests_in(*area);
                for (from, spot) in spots.iter().enumerate() {
                    for at in rests.iter().filter_map(|&rest| way(rest, *spot, &[*area])) {
                        for (other, targets) in &all {
                            for (to, target) in targets.iter().enumerate() {
                                let is_asked = match area == other {
                                    true => from != to,
                                    false => is_through(spot, target),
                                };
                                if is_asked && way(at, *target, &[*area, *other]).is_some() {
                                    allowed.insert((*area, from, *other, to));
                                }
                            }
                        }
                    }
                }
            }
        }
        for (area, spots) in &all {
            for (from, spot) in spots.iter().enumerate() {
                let start = lasting.foothold(&floor, &world, *area, Some(*spot));
                for (other, targets) in &all {
                    for (to, target) in targets.iter().enumerate() {
                        let end = lasting.foothold(&floor, &world, *other, Some(*target));
                        let may = lasting.may_lead(&floor, &start, &end);
                        let is_driven = allowed.contains(&(*area, from, *other, to));
                        assert!(
                            may || !is_driven,
                            "{seed}: {area:?} {spot:?} {other:?} {target:?}"
                        );
                        ways += usize::from(is_driven);
                        let is_room = area == other && from != to;
                        refused += usize::from(!may && (is_room || is_through(spot, target)));
                    }
                }
            }
        }
    }
    assert!(ways > 500 && refused > 50, "{ways} ways, {refused} refused");
}

/// How an order goes.
struct Driven {
    ending: Ending,
    /// The plans told, by how many steps they have.
    plans: Vec<usize>,
    surprises: Vec<String>,
    /// Whether a plan was proven that the floor then refused.
    was_refused: bool,
}

/// Has a goal driven in a world that is as it is believed to be.
fn driven(world: &World, goal: &[GoalFact]) -> Driven {
    let (domain, _) = Domain::read(&project("rules/service-robot.strips")).unwrap();
    let rules = RelationRules::standard();
    let relations = Arc::new(derive(world, &rules, world.domain.profile).unwrap());
    let floors = BTreeMap::from([(MapId(1), floor_of(world))]);
    let (map, pose) = starting_pose(world).unwrap();
    let belief = Belief::new(world.clone(), floors, map, pose).unwrap();
    let followed = Followed::new(Arc::new(world.clone()), relations);
    let limits = Limits { effort: Some(Limits::TO_START), ..Limits::default() };
    let mut mission = Mission::new(belief, &domain, followed, &rules, limits);
    let robot = Simulator::new(world.clone(), map, pose);
    let mut robot = robot.through_walls(rules.step_reach());
    let (mut plans, mut surprises) = (Vec::new(), Vec::new());
    let mut tell = |event: &Event<'_>| match event {
        Event::Planned(planned) if planned.solved.outcome.plan().is_some() => {
            plans.push(planned.steps.len());
        }
        // What bars the only way and is out of sight may be gone: it is gone to, and seen to be there after all.
        Event::Surprised { belief, .. } if belief.lost().next().is_some() => {}
        Event::Surprised { surprise, .. } => surprises.push(format!("{surprise:?}")),
        _ => {}
    };
    let ending = mission.run(goal, &mut robot, &Stop::new(), &mut tell).unwrap();
    let refused = (&mission.belief.unreachable, &mission.belief.no_return);
    let was_refused = !refused.0.is_empty() || !refused.1.is_empty();
    Driven { ending, plans, surprises, was_refused }
}

fn at_place(room: usize) -> GoalFact {
    let args = vec![format!("Место-{room}")];
    GoalFact { predicate: predicate::ROBOT_AT_PLACE.to_owned(), args }
}

/// With things that stay in doorways: the plan proposed is the shortest that the floor has, and it is driven to its end; but
/// where one comes to a door on both sides of a thing, it is the first that was proven.
#[test]
fn the_first_plan_proven_is_the_shortest_that_the_floor_has() {
    let (mut plans, mut none, mut refused) = (0, 0, 0);
    for seed in 100..100 + seeds(80) {
        let mut dice = Dice::new(seed);
        let mut world = furnished(&mut dice, DoorKind::Sliding);
        let (from, to) = (dice.below(4), dice.below(4));
        let place = |room: usize| world.places.values().nth(room).unwrap().clone();
        let (from, goal) = (place(from), place(to));
        world.robot.start = Some(from.id);
        let mut judge = Judge::of(&world);
        let Some(start) = begun(&mut judge, &from) else { continue };
        let way = judge.way(&start, Target::Place(goal.id));
        let order = driven(&world, &[at_place(to)]);
        let told = (&order.ending, &order.plans, &order.surprises);
        match way {
            Some(way) if way.len() == 1 => assert!(matches!(order.ending, Ending::AlreadyTrue)),
            Some(way) => {
                assert!(matches!(order.ending, Ending::Done), "{seed}: {told:?}");
                assert_eq!(order.plans.iter().sum::<usize>(), way.len() - 1, "{seed}: {told:?}");
                refused += usize::from(order.was_refused || order.plans.len() > 1);
                plans += 1;
            }
            None => {
                let is_told = matches!(order.ending, Ending::Stuck(_) | Ending::NoPlan(_));
                assert!(is_told && order.surprises.is_empty(), "{seed}: {told:?}");
                none += 1;
            }
        }
    }
    assert!(plans >= 20 && none >= 8, "{plans} plans, {none} without");
    assert!(20 * refused <= plans, "{refused} of {plans} plans were refused when they were tried");
}

/// Leaves swing over what little floor there is, and the robot is to shut doors behind it and go on: what is proposed is
/// driven to its end, and no leaf bars what comes after.
#[test]
fn no_leaf_that_a_plan_sets_bars_its_way_later() {
    let (mut plans, mut none, mut shut, mut parts) = (0, 0, 0, 0);
    for seed in 0..seeds(60) {
        let mut dice = Dice::new(seed);
        let widths = [[120.0, 150.0, 180.0][dice.below(3)], 260.0];
        let (mut b, areas) = building_of(DoorKind::Hinged, &widths, |_, _| {
            [Some(DoorState::OPEN), Some(DoorState::CLOSED), None][dice.below(7).saturating_sub(4)]
        });
        for (room, &area) in areas.iter().enumerate() {
            for _ in 0..dice.below(3) {
                let (w, d) = (20.0 + dice.below(50) as f64, 20.0 + dice.below(50) as f64);
                let x = dice.below((widths[room % 2] - w) as usize) as f64;
                b.put(area, x, 110.0 + dice.below((190.0 - d) as usize) as f64, w, d, 0.0, 100.0);
            }
        }
        let mut world = b.world;
        world.robot.radius = Cm::of([18.0, 22.0, 26.0, 30.0][dice.below(4)]);
        let (mut first, ways) = (BTreeSet::new(), [OpensTo::Inside, OpensTo::Outside]);
        for mount in world.areas.values_mut().flat_map(|area| &mut area.doors) {
            let turned = usize::from(first.insert(mount.door));
            mount.opens = ways[(mount.door.0 as usize + turned) % 2];
        }
        world.robot.start = world.places.values().nth(dice.below(4)).map(|place| place.id);
        let mut goal = vec![at_place(dice.below(4))];
        for (id, door) in &world.doors {
            let sides = areas.iter().filter(|&&area| doors_of(&world, area).any(|own| own == *id));
            let sides = sides.map(|&area| world.name(Entity::Area(area)).to_owned());
            if dice.below(2) == 0 {
                let args = std::iter::once(door.name.clone()).chain(sides).collect();
                goal.push(GoalFact { predicate: predicate::DOOR_CLOSED.to_owned(), args });
            }
        }
        let order = driven(&world, &goal);
        let told = (&order.ending, &order.plans, &order.surprises);
        assert!(order.surprises.is_empty(), "{seed}: {told:?}");
        match order.ending {
            Ending::Done => {
                plans += 1;
                parts += usize::from(order.plans.len() > 1);
                shut += usize::from(goal.len() > 1);
            }
            Ending::AlreadyTrue => {}
            Ending::NoPlan(_) | Ending::Stuck(_) => none += 1,
            _ => panic!("{seed}: {told:?}"),
        }
    }
    assert!(plans >= 20 && shut >= 15, "{plans} plans, {shut} with doors to shut, {none} without");
    // A room that something cuts in two is gone round.
    assert!(20 * parts <= plans, "{parts} of {plans} plans were driven in parts");
}
