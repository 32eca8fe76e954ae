//! Lifts by the senses alone: from storey to storey and back, with the wait for the cabin, the robot where it believes.

#![allow(clippy::print_stdout, reason = "figures")]

use orthoframe_robot::*;
use orthoframe_units::Stop;

use super::setting::{Setting, example, fact};

#[test]
fn a_robot_rides_lifts_by_its_senses_alone() {
    let setting = Setting::of(example("two-storeys"));
    let Setting { world, floors, map, pose, .. } = &setting;
    let seeds = if std::env::var_os("ORTHOFRAME_LONG").is_some() { 40 } else { 3 };
    let (mut worst, mut done, mut rides, mut waits): (f64, usize, usize, usize) = (0.0, 0, 0, 0);
    for seed in 0..seeds {
        let robot = Simulator::new(world.clone(), *map, *pose);
        let mut robot = SensingRobot::new(robot, Senses::of_seed(seed));
        let ground = Ground::of(world, floors, 20.0);
        let finders = ground.finders();
        let mut mission = setting.mission(setting.belief().unwrap());
        for to in ["Окно", "Стойка охраны"] {
            let mut pilot = Pilot::new(
                &ground,
                &finders,
                &mut robot,
                (mission.belief.map, mission.belief.pose),
            )
            .unwrap();
            let mut tell = |event: &Event<'_>| {
                if let Event::Finished { directive, leg, .. } = event {
                    rides += usize::from(&*directive.action == "Проехать-на-лифте");
                    // The cabin is on the other storey: one waits for it.
                    let called = &*directive.action == "Вызвать-лифт";
                    waits += usize::from(called && leg.seconds >= 5.0);
                }
            };
            let goal = [fact("РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ", to)];
            let ending = mission.run(&goal, &mut pilot, &Stop::new(), &mut tell).unwrap();
            drop(pilot);
            let arrived = matches!(ending, Ending::Done);
            assert!(arrived, "seed {seed}, {to}: {ending:?}");
            done += usize::from(arrived);
            let (truly_on, truly_at) = robot.body().pose();
            assert_eq!(mission.belief.map, truly_on, "seed {seed}, {to}");
            worst = worst.max((mission.belief.pose.at - truly_at.at).norm());
        }
    }
    println!("{done} missions of {} done, {rides} rides, off by at most {worst:.1} cm", 2 * seeds);
    assert_eq!(rides, 2 * seeds as usize);
    // On the way back the cabin is where it was left.
    assert!(waits >= seeds as usize, "{waits}");
    assert!(worst <= 5.0, "{worst}");
}
