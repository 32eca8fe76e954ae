//! What a mission met and nobody knew stands in what it believes afterwards: the next one goes round it without meeting it,
//! and once beams go through it, it is gone.

use orthoframe_geometry::{Method, Scene, Target};
use orthoframe_map::{Entity, Replica, World};
use orthoframe_robot::*;
use orthoframe_units::{Frame, MapId, Point, ReplicaId, Stop};

use super::setting::{Setting, example, fact};

/// The flat with a wardrobe that nobody knows of, or none where it does not fit.
fn with_stranger(world: &World, map: MapId, at: Point, keep: Point) -> Option<(World, ReplicaId)> {
    let scene = Scene::of(world, map);
    let area = scene.area_at(at)?;
    let (_, placed) = world.placement(area)?;
    let like = world.replicas.values().find(|thing| thing.name == "Тумбочка-1")?;
    let own = placed.invert(at);
    let id = ReplicaId(world.replicas.keys().map(|id| id.0).max()? + 1);
    let frame = Frame::new(own.x, own.y, 0.0, like.frame.angle);
    let name = "Чужое".to_owned();
    let mut truth = world.clone();
    truth.replicas.insert(id, Replica { id, area, frame, name, ..like.clone() });
    let scene = Scene::of(&truth, map);
    let bounds = scene.replicas[&id].bounds;
    let is_free = scene.replicas.values().all(|o| o.id == id || !o.bounds.meets(&bounds));
    (is_free && !bounds.grown(60.0).contains(keep)).then_some((truth, id))
}

/// What is believed after a mission, and how often something stood in its way.
fn driven(world: &World, truth: &World, seed: u64, to: &str) -> (Ending, World, usize) {
    let setting = Setting::of(world.clone());
    let (map, pose, floors) = (setting.map, setting.pose, &setting.floors);
    let body = Simulator::new(truth.clone(), map, pose);
    let mut body = SensingRobot::new(body, Senses::of_seed(seed));
    let mut mission = setting.mission(setting.belief().unwrap());
    let ground = Ground::of(world, floors, 20.0);
    let finders = ground.finders();
    let mut pilot = Pilot::new(&ground, &finders, &mut body, (map, pose)).unwrap();
    mission.belief.pose = pilot.pose().1;
    let mut blocked = 0;
    let mut tell = |event: &Event<'_>| {
        let met = matches!(event, Event::Surprised { surprise: Surprise::Blocked { .. }, .. });
        blocked += usize::from(met);
    };
    let goal = [fact("РОБОТ-НАХОДИТСЯ-В", to)];
    let ending = mission.run(&goal, &mut pilot, &Stop::new(), &mut tell).unwrap();
    (ending, mission.belief.world, blocked)
}

fn obstacles(world: &World) -> Vec<ReplicaId> {
    world.replicas.keys().copied().filter(|id| is_obstacle(*id)).collect()
}

#[test]
fn what_nobody_knew_is_known_to_the_next_mission_until_it_is_seen_to_be_gone() {
    let world = example("rb2");
    let setting = Setting::of(world.clone());
    let (map, pose) = (setting.map, setting.pose);
    let (mut met, mut known, mut gone) = (0, 0, 0);
    for (room, seed) in [("Комната-Y", 1), ("Комната-Z", 2), ("Коридор", 3)] {
        let Some(Entity::Area(area)) = world.find(room).into_iter().next() else { panic!() };
        let way = setting.floors[&map].route(&world, pose.at, Target::Area(area), Method::Shortest);
        for leg in way.unwrap().points.windows(2) {
            let Some((truth, id)) =
                with_stranger(&world, map, nalgebra::center(&leg[0], &leg[1]), pose.at)
            else {
                continue;
            };
            let (ending, believed, blocked) = driven(&world, &truth, seed, room);
            if blocked == 0 || !matches!(ending, Ending::Done) {
                continue;
            }
            met += 1;
            let stranger = Scene::of(&truth, map).replicas[&id].bounds.grown(15.0);
            let scene = Scene::of(&believed, map);
            let all = obstacles(&believed);
            assert!(!all.is_empty(), "{room}: forgotten");
            for one in &all {
                assert!(stranger.meets(&scene.replicas[one].bounds), "{room}: {believed:?}");
            }
            let (ending, _, blocked) = driven(&believed, &truth, seed + 10, room);
            known += usize::from(matches!(ending, Ending::Done) && blocked == 0);
            let (ending, after, _) = driven(&believed, &world, seed + 20, room);
            gone += usize::from(matches!(ending, Ending::Done) && obstacles(&after).is_empty());
        }
    }
    assert!(met >= 3 && known * 5 >= met * 4 && gone * 5 >= met * 4, "{met} {known} {gone}");
}
