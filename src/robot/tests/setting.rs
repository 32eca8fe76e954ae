//! A building as a mission finds it: its map, the rules, and what follows from both.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};
use std::sync::Arc;

use orthoframe_geometry::{DoorStates, FloorPlan};
use orthoframe_graphplan::Limits;
use orthoframe_map::World;
use orthoframe_robot::*;
use orthoframe_semantics::{Followed, RelationRules, Relations, derive};
use orthoframe_strips::Domain;
use orthoframe_units::{MapId, Pose};

pub(super) fn file(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").join(name)
}

/// An example map by its name.
pub(super) fn example(name: &str) -> World {
    World::load(file(&format!("maps/{name}.toml"))).expect("the example maps are sound")
}

pub(super) fn floors(world: &World) -> BTreeMap<MapId, FloorPlan> {
    let plan = |&map: &MapId| (map, FloorPlan::build(world, map, &world.robot, &DoorStates::new()));
    world.maps.keys().map(plan).collect()
}

pub(super) fn fact(predicate: &str, name: &str) -> GoalFact {
    GoalFact { predicate: predicate.to_owned(), args: vec![name.to_owned()] }
}

pub(super) struct Setting {
    pub(super) world: World,
    pub(super) floors: BTreeMap<MapId, FloorPlan>,
    pub(super) map: MapId,
    pub(super) pose: Pose,
    domain: Domain,
    rules: RelationRules,
    relations: Arc<Relations>,
}

impl Setting {
    pub(super) fn of(world: World) -> Self {
        let (domain, _) = Domain::read(&file("rules/service-robot.strips")).expect("it is sound");
        let rules = RelationRules::standard();
        let relations = derive(&world, &rules, world.domain.profile).expect("they are derived");
        let (map, pose) = starting_pose(&world).expect("the map says where the robot starts");
        let floors = floors(&world);
        Self { world, floors, map, pose, domain, rules, relations: Arc::new(relations) }
    }

    /// What a robot believes that takes the map for the truth; none where the start is in no Area.
    pub(super) fn belief(&self) -> Option<Belief> {
        Belief::new(self.world.clone(), self.floors.clone(), self.map, self.pose)
    }

    pub(super) fn mission(&self, belief: Belief) -> Mission<'_> {
        let followed = Followed::new(Arc::new(self.world.clone()), Arc::clone(&self.relations));
        let limits = Limits { effort: Some(Limits::TO_START), ..Limits::default() };
        Mission::new(belief, &self.domain, followed, &self.rules, limits)
    }
}
