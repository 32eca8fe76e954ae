//! What lies behind shut doors of furniture: a robot that opens them opens, takes out and shuts; one that does not is told so
//! before it moves.

use orthoframe_geometry::Scene;
use orthoframe_map::{DoorState, DoorStatus, Entity, World, stands};
use orthoframe_robot::*;
use orthoframe_units::{Deg, Frame, ReplicaId, Stop};

use super::setting::{Setting, example, fact};

fn thing(world: &World, name: &str) -> ReplicaId {
    let found = world.find(name).into_iter();
    found.filter_map(|e| if let Entity::Replica(id) = e { Some(id) } else { None }).next().unwrap()
}

/// The flat with the medicine in a shut wardrobe.
fn flat(wardrobe: &str, opens: bool) -> World {
    let mut world = example("rb2");
    world.robot.opens = opens;
    let (around, medicine) = (thing(&world, wardrobe), thing(&world, "Лекарство"));
    let wardrobe = world.replicas[&around].clone();
    let within = Frame::new(50.0, 25.0, 8.0, Deg::ZERO);
    let medicine = world.replicas.get_mut(&medicine).unwrap();
    (medicine.area, medicine.frame) = (wardrobe.area, wardrobe.frame.compose(&within));
    let wardrobe = world.replicas.get_mut(&around).unwrap();
    let object = world.objects[&wardrobe.object].clone();
    orthoframe_map::set_open(wardrobe, &object, false);
    world
}

/// Holds the medicine, and the wardrobe is shut: how it ended, what was done, and how the truth then is.
fn fetch(
    world: &World,
    truth: World,
    wardrobe: &str,
    by_senses: bool,
) -> (Result<Ending, MissionError>, Vec<String>, World) {
    let setting = Setting::of(world.clone());
    let (map, pose, floors) = (setting.map, setting.pose, &setting.floors);
    let mut mission = setting.mission(setting.belief().unwrap());
    let goal = [fact("РОБОТ-ДЕРЖИТ", "Лекарство"), fact("ОБЪЕКТ-ЗАКРЫТ", wardrobe)];
    let mut done = Vec::new();
    let mut tell = |event: &Event<'_>| {
        if let Event::Finished { directive, .. } = event {
            done.push(directive.action.to_string());
        }
    };
    let robot = Simulator::new(truth, map, pose);
    let (stop, tell) = (Stop::new(), &mut tell);
    if by_senses {
        let mut robot = SensingRobot::new(robot, Senses::of_seed(5));
        let ground = Ground::of(world, floors, 20.0);
        let finders = ground.finders();
        let mut pilot = Pilot::new(&ground, &finders, &mut robot, (map, pose)).unwrap();
        mission.belief.pose = pilot.pose().1;
        let ending = mission.run(&goal, &mut pilot, &stop, tell);
        drop(pilot);
        (ending, done, robot.into_truth())
    } else {
        let mut robot = robot;
        let ending = mission.run(&goal, &mut robot, &stop, tell);
        (ending, done, robot.into_truth())
    }
}

#[test]
fn what_is_behind_shut_doors_is_taken_out_and_they_are_shut_again() {
    for wardrobe in ["Шкаф-1", "Шкаф-2"] {
        for by_senses in [false, true] {
            let world = flat(wardrobe, true);
            let (ending, done, truth) = fetch(&world, world.clone(), wardrobe, by_senses);
            assert!(matches!(ending, Ok(Ending::Done)), "{wardrobe}: {done:?} {ending:?}");
            let at = |action: &str| done.iter().position(|one| one == action);
            let steps = ["Открыть-объект", "Достать", "Закрыть-объект"].map(at);
            assert!(steps.iter().all(Option::is_some) && steps.is_sorted(), "{done:?}");
            assert!(!truth.replicas.contains_key(&thing(&world, "Лекарство")));
            let shut = &truth.replicas[&thing(&world, wardrobe)];
            assert_eq!(stands(&truth, shut), Some(DoorStatus::Closed));
        }
    }
}

#[test]
fn what_the_robot_cannot_open_is_told_before_it_moves() {
    let world = flat("Шкаф-1", false);
    let (ending, done, _) = fetch(&world, world.clone(), "Шкаф-1", false);
    // Nothing that can be taken is of that name.
    assert!(
        matches!(ending, Err(MissionError::Rules(_))) && done.is_empty(),
        "{done:?} {ending:?}"
    );
    // Known to be locked.
    let lock = |world: &mut World| {
        let id = thing(world, "Шкаф-1");
        let object = world.objects[&world.replicas[&id].object].clone();
        for mount in &object.doors {
            world.replicas.get_mut(&id).unwrap().door_states.insert(mount.door, DoorState::LOCKED);
        }
    };
    let mut locked = flat("Шкаф-1", true);
    lock(&mut locked);
    let (ending, done, _) = fetch(&locked, locked.clone(), "Шкаф-1", false);
    assert!(matches!(ending, Ok(Ending::NoPlan(_))) && done.is_empty(), "{done:?} {ending:?}");
    // Locked in truth: that is found out there, and told.
    let world = flat("Шкаф-1", true);
    let (ending, _, truth) = fetch(&world, locked, "Шкаф-1", false);
    let is_shut = matches!(
        ending,
        Ok(Ending::Stuck(Surprise::Refused { refusal: Refusal::Shut(id), .. })) if id == thing(&world, "Шкаф-1")
    );
    assert!(is_shut, "{ending:?}");
    let (map, _) = starting_pose(&world).unwrap();
    assert!(Scene::of(&truth, map).replicas.contains_key(&thing(&world, "Лекарство")));
}

/// No hand gets into what is shut, whatever who sends it there believes.
#[test]
fn nothing_is_put_through_a_shut_door() {
    for wardrobe in ["Шкаф-1", "Шкаф-2"] {
        let world = flat(wardrobe, true);
        let (around, medicine) = (thing(&world, wardrobe), thing(&world, "Лекарство"));
        let (map, pose) = starting_pose(&world).unwrap();
        let mut truth = world.clone();
        let held = truth.replicas.remove(&medicine).unwrap();
        let (area, frame) = (held.area, held.frame);
        for open in [false, true] {
            let stands = truth.replicas.get_mut(&around).unwrap();
            let object = world.objects[&stands.object].clone();
            orthoframe_map::set_open(stands, &object, open);
            let robot = Simulator::new(truth.clone(), map, pose);
            let mut robot = robot.laden(Some(held.clone()), &[], &[]);
            let put = robot.put(medicine, area, frame, &mut Watch::of(&Stop::new()));
            let is_shut = matches!(put, Err(Unfinished::Met(Refusal::Shut(id))) if id == around);
            assert!(is_shut != open && put.is_ok() == open, "{put:?}");
        }
    }
}
