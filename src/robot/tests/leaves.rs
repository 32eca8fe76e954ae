//! The robot never stands where the leaf of a door sweeps that it opens: over doors of every kind, by the leaves as they
//! stand at each opening, not by what geometry calls their sweep.

#![allow(clippy::print_stdout, reason = "figures for benches/README.md")]

use std::collections::BTreeMap;

use orthoframe_geometry::{Openings, STEP_REACH};
use orthoframe_map::{
    DoorKind, DoorLeaf, DoorState, DoorStatus, Entity, HingeSide, OpensTo, World,
};
use orthoframe_robot::*;
use orthoframe_units::{AreaId, Cm, DoorId, Point, Stop};

use super::setting::{Setting, example, fact};

/// All doors shut, each of another kind, with other leaves, hung otherwise; the robot of another size.
fn varied(world: &World, dice: &mut fastrand::Rng) -> World {
    let mut world = world.clone();
    world.robot.footprint.clear();
    world.robot.radius = Cm::of(15.0 + 12.0 * dice.f64());
    for door in world.doors.values_mut().filter(|door| !door.leaves.is_empty()) {
        door.kind = if dice.usize(..4) == 0 { DoorKind::Sliding } else { DoorKind::Hinged };
        let most = match door.kind {
            DoorKind::Sliding => 100.0,
            _ => 60.0 + 75.0 * dice.f64(),
        };
        let leaf = |hinge, share| DoorLeaf { hinge, share, thickness: Cm::of(4.0), max_open: most };
        let share = 0.3 + 0.4 * dice.f64();
        door.leaves = match dice.usize(..3) {
            0 => vec![leaf(HingeSide::Right, 1.0)],
            1 => vec![leaf(HingeSide::Left, 1.0)],
            _ => vec![leaf(HingeSide::Right, share), leaf(HingeSide::Left, 1.0 - share)],
        };
        door.state = DoorState::CLOSED;
    }
    let mut seen: BTreeMap<DoorId, OpensTo> = BTreeMap::new();
    for mount in world.areas.values_mut().flat_map(|area| &mut area.doors) {
        let other = match seen.get(&mount.door) {
            Some(OpensTo::Inside) => OpensTo::Outside,
            Some(OpensTo::Outside) => OpensTo::Inside,
            None if dice.bool() => OpensTo::Inside,
            None => OpensTo::Outside,
        };
        mount.opens = other;
        seen.insert(mount.door, other);
    }
    world
}

/// The least distance from a point to any leaf of a door on its way from one opening to wide open, cm.
fn nearest_leaf(world: &World, door: DoorId, from: f64, at: Point) -> f64 {
    let model = &world.doors[&door];
    let openings = Openings::of(world, STEP_REACH);
    let ways = openings.iter().filter(|opening| opening.door == Some(door) && opening.is_through());
    let mut nearest = f64::INFINITY;
    for way in ways {
        let leaves = way.leaves(model);
        for step in 0..=200 {
            let opening = from + (100.0 - from) * f64::from(step) / 200.0;
            let status = if opening > 0.0 { DoorStatus::Open } else { DoorStatus::Closed };
            for leaf in leaves.obstacles(DoorState { status, opening }) {
                let far = if leaf.contains(at, 0.0) { 0.0 } else { leaf.border_distance(at) };
                nearest = nearest.min(far);
            }
        }
    }
    nearest
}

#[test]
fn the_robot_never_stands_where_a_leaf_sweeps_that_it_opens() {
    let count = if std::env::var_os("ORTHOFRAME_LONG").is_some() { 600 } else { 60 };
    let (mut opened, mut ended) = (0, 0);
    for seed in 0..count {
        let mut dice = fastrand::Rng::with_seed(seed);
        let map = ["rb2", "rb2", "two-storeys"][seed as usize % 3];
        let setting = Setting::of(varied(&example(map), &mut dice));
        let (world, map, pose) = (&setting.world, setting.map, setting.pose);
        let Some(belief) = setting.belief() else { continue };
        let areas: Vec<AreaId> = world.areas.keys().copied().collect();
        let to = world.name(Entity::Area(areas[dice.usize(..areas.len())])).to_owned();
        let goal = [fact("РОБОТ-НАХОДИТСЯ-В", &to)];
        let mut mission = setting.mission(belief);
        let mut robot = Simulator::new(world.clone(), map, pose);
        let mut tell = |event: &Event<'_>| match event {
            Event::Finished { directive, belief, .. } => {
                for primitive in directive.primitives() {
                    let Primitive::SetDoor { door, status: DoorStatus::Open } = primitive else {
                        continue;
                    };
                    let id = world.find(&door).into_iter().find_map(|entity| match entity {
                        Entity::Door(id) => Some(id),
                        _ => None,
                    });
                    let id = id.expect("a door of the map");
                    let far = nearest_leaf(world, id, 0.0, belief.pose.at);
                    let radius = world.robot.radius.get();
                    assert!(
                        far >= radius - 0.2,
                        "seed {seed} to {to}: {far:.1} cm from the leaf of {door}, radius {radius:.1}"
                    );
                    opened += 1;
                }
            }
            // What bars the only way and is out of sight may be gone: it is gone to, and seen to be there after all.
            Event::Surprised { belief, .. } if belief.lost().next().is_some() => {}
            // It was rehearsed: in a world that is as believed nothing else surprises it.
            Event::Surprised { surprise, .. } => panic!("seed {seed} to {to}: {surprise:?}"),
            _ => {}
        };
        let ending = mission.run(&goal, &mut robot, &Stop::new(), &mut tell).unwrap();
        match ending {
            Ending::Done | Ending::AlreadyTrue => {}
            Ending::NoPlan(_) | Ending::Stuck(_) => ended += 1,
            other => panic!("seed {seed} to {to}: {other:?}"),
        }
    }
    println!("{count} missions, {opened} doors opened, {ended} without a way");
    assert!(opened * 3 >= count, "{opened} doors opened in {count} missions");
}
