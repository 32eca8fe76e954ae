//! Plans that were spoilt at random, judged as the plain steps of `planning_properties` judge them.

use std::collections::BTreeMap;
use std::fmt::Write;

use orthoframe_graphplan::{Limits, Outcome, solve};
use orthoframe_strips::{Directive, PlanText};
use orthoframe_units::Source;

use crate::planning_properties::random::Random;
use crate::planning_properties::{Drawn, Ground, World};

/// A step's number, an action and its objects, as written.
type Line = (u32, String, Vec<String>);

fn spoil(lines: &mut Vec<Line>, random: &mut Random) {
    let at = random.below(lines.len());
    let other = random.below(lines.len());
    match random.below(6) {
        0 => (lines[at].0, lines[other].0) = (lines[other].0, lines[at].0),
        1 => drop(lines.remove(at)),
        2 => {
            let (step, action, args) = lines[at].clone();
            lines.push((step + random.below(3) as u32, action, args));
        }
        3 => {
            let names: Vec<String> = lines.iter().flat_map(|line| line.2.clone()).collect();
            if let (Some(place), false) = (lines[at].2.first_mut(), names.is_empty()) {
                place.clone_from(&names[random.below(names.len())]);
            }
        }
        4 => {
            let least = at.min(other) as u32;
            lines.iter_mut().filter(|line| line.0 > least).for_each(|line| line.0 -= 1);
        }
        _ => lines[at].2.reverse(),
    }
}

/// Whether the plan reaches the goal, by the plain steps.
fn works(drawn: &Drawn, world: &World, lines: &[Line]) -> bool {
    let mut steps: BTreeMap<u32, Vec<&Ground>> = BTreeMap::new();
    for (step, action, args) in lines {
        let name = (drawn.number(action), args.iter().map(|arg| drawn.number(arg)).collect());
        let Some(ground) = world.actions.iter().find(|ground| ground.name == name) else {
            return false;
        };
        steps.entry(*step).or_default().push(ground);
    }
    let state = steps.values().try_fold(world.init, |state, actions| world.step(state, actions));
    state.is_some_and(|state| world.is_goal(state))
}

#[test]
fn spoilt_plans_are_judged_as_plain_steps_judge_them() {
    let (mut good, mut bad) = (0, 0);
    for seed in 1..=2500 {
        let drawn = Drawn::new(seed);
        let Some(world) = World::of(&drawn).filter(|_| !drawn.goal.is_empty()) else { continue };
        let scenario = drawn.scenario();
        let task = scenario.ground().unwrap();
        let Outcome::Plan(plan) = solve(&task, &Limits::default()) else { continue };
        let text = PlanText::write(&task, &plan.steps);
        let plan = PlanText::parse(&Source::new("план", &text)).unwrap();
        let line = |d: &Directive| (d.step, d.action.clone(), d.args.clone());
        let lines: Vec<Line> = plan.directives.iter().map(line).collect();
        let mut random = Random::new(seed);
        for _ in 0..8 {
            let mut lines = lines.clone();
            for _ in 0..=random.below(2) {
                if !lines.is_empty() {
                    spoil(&mut lines, &mut random);
                }
            }
            let mut text = String::new();
            for (step, action, args) in &lines {
                writeln!(text, "{step}: ({action} {})", args.join(" ")).unwrap();
            }
            let replayed = PlanText::parse(&Source::new("план", &text))
                .and_then(|text| text.replay(&scenario.domain, &scenario.problem))
                .unwrap_or_else(|faults| panic!("seed {seed}: {faults}\n{text}"));
            let expected = works(&drawn, &world, &lines);
            assert_eq!(replayed.broken.is_none(), expected, "seed {seed}:\n{text}{replayed:?}");
            *(if expected { &mut good } else { &mut bad }) += 1;
        }
    }
    assert!(good > 300 && bad > 300, "{good} good, {bad} bad");
}
