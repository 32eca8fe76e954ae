//! Plans of missions before the judge that shares no code with the planner: what is believed and what is wanted, as a rule
//! file would say it, and the robot's own rules.

use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use orthoframe_geometry::{DoorStates, FloorPlan};
use orthoframe_graphplan::Limits;
use orthoframe_map::{Entity, World};
use orthoframe_robot::{Belief, GoalFact, Mission, starting_pose};
use orthoframe_semantics::planning::InitialFact;
use orthoframe_semantics::{Followed, RelationRules, derive, predicate};
use orthoframe_strips::Domain;
use orthoframe_units::MapId;

use crate::files::project;
use crate::planning_judge::{Texts, stands, whole};

/// The rules, what is believed and what is wanted.
fn in_rules(rules: &str, facts: &[InitialFact], goal: &[GoalFact]) -> Texts {
    let called = |predicate: &str, args: Vec<&str>| {
        let args: Vec<String> = args.into_iter().map(|name| format!("«{name}»")).collect();
        format!("{predicate}_({})\n", args.join(", "))
    };
    let arguments = facts.iter().flat_map(|fact| &fact.arguments);
    let objects: BTreeSet<String> =
        arguments.map(|object| format!("«{}» — {}\n", object.name, object.kind)).collect();
    let objects: String = objects.into_iter().collect();
    let stated = |fact: &InitialFact| {
        called(fact.predicate, fact.arguments.iter().map(|arg| arg.name.as_str()).collect())
    };
    let facts: String = facts.iter().map(stated).collect();
    let wanted =
        |fact: &GoalFact| called(&fact.predicate, fact.args.iter().map(String::as_str).collect());
    let goal: String = goal.iter().map(wanted).collect();
    Texts::Rules(format!(
        "{rules}\nОбъекты:\n{objects}\nИсходная позиция:\n{facts}\nЦелевая позиция:\n{goal}"
    ))
}

/// To be in a room, to hold a thing, to have it lie on another: of each of the map's some, over all of it.
fn goals(world: &World) -> Vec<Vec<GoalFact>> {
    let name = |entity: Entity| world.name(entity).to_owned();
    let fact = |predicate: &str, args: Vec<String>| GoalFact { predicate: predicate.into(), args };
    let things: Vec<String> = world.replicas.keys().map(|&id| name(Entity::Replica(id))).collect();
    let rooms =
        world.areas.keys().map(|&id| vec![fact(predicate::ROBOT_IN, vec![name(Entity::Area(id))])]);
    let held = things.iter().map(|thing| vec![fact(predicate::ROBOT_HOLDS, vec![thing.clone()])]);
    let laid = (1..things.len().min(12)).flat_map(|apart| {
        let pairs = things.iter().zip(things.iter().cycle().skip(apart));
        pairs.map(|(thing, on)| vec![fact(predicate::THING_ON, vec![thing.clone(), on.clone()])])
    });
    let two = things.windows(2).map(|pair| {
        let first = fact(predicate::IN_ITS_PLACE, vec![pair[0].clone()]);
        vec![first, fact(predicate::ROBOT_HOLDS, vec![pair[1].clone()])]
    });
    rooms.chain(held).chain(laid).chain(two).collect()
}

#[test]
fn plans_of_missions_stand_before_the_judge() {
    let path = project("rules/service-robot.strips");
    let (domain, _) = Domain::read(&path).expect("the rules are sound");
    let (text, rules) = (whole(&path), RelationRules::standard());
    let mut judged = 0;
    for map in ["rb2", "lab", "two-storeys"] {
        let world = World::load(project(&format!("maps/{map}.toml"))).expect("an example map");
        let relations =
            Arc::new(derive(&world, &rules, world.domain.profile).expect("they are derived"));
        let plan =
            |&map: &MapId| (map, FloorPlan::build(&world, map, &world.robot, &DoorStates::new()));
        let floors: BTreeMap<MapId, FloorPlan> = world.maps.keys().map(plan).collect();
        let (at, pose) = starting_pose(&world).expect("the map says where the robot starts");
        let all = goals(&world);
        for goal in all.iter().step_by(1 + all.len() / 300) {
            let belief =
                Belief::new(world.clone(), floors.clone(), at, pose).expect("it is in a room");
            let facts = belief.facts(&relations);
            let followed = Followed::new(Arc::new(world.clone()), Arc::clone(&relations));
            let limits = Limits { effort: Some(Limits::TO_START), ..Limits::default() };
            let mut mission = Mission::new(belief, &domain, followed, &rules, limits);
            // What the rules do not know, as a table that lies on a cup, is no goal.
            let Ok(planned) = mission.plan(goal) else { continue };
            let Some(plan) = planned.solved.outcome.plan() else { continue };
            assert!(
                stands(&in_rules(&text, &facts, goal), &planned.solved.task, plan),
                "{map}: {goal:?}"
            );
            judged += usize::from(!plan.steps.is_empty());
        }
    }
    assert!(judged > 25, "{judged} plans stood before the judge");
}
