//! Somebody lifts the robot up on its way and sets it down elsewhere: it finds itself again, tells so and does its task from
//! there, or says that it does not know where it is.

use orthoframe_geometry::Ride;
use orthoframe_map::{DoorState, Entity};
use orthoframe_robot::*;
use orthoframe_units::{AreaId, Deg, DoorId, Frame, MapId, Point, Pose, ReplicaId, Stop};

use super::setting::{Setting, example, fact};

/// A robot that is carried off once, after so many pieces of its way.
struct CarriedOff {
    robot: SensingRobot,
    pieces: usize,
    after: usize,
    to: Pose,
}

impl Vehicle for CarriedOff {
    fn pose(&self) -> (MapId, Pose) {
        self.robot.pose()
    }

    fn time(&self) -> f64 {
        self.robot.time()
    }

    fn tells_odometry(&self) -> bool {
        true
    }

    fn follow(
        &mut self,
        path: &[Point],
        heading: Option<Deg>,
        watch: &mut Watch<'_>,
    ) -> Result<(), Unfinished<Bump>> {
        self.pieces += 1;
        if self.pieces == self.after {
            self.robot.carry_off(self.to);
        }
        self.robot.follow(path, heading, watch)
    }

    fn set_door(&mut self, door: DoorId, state: DoorState, watch: &mut Watch<'_>) -> Done {
        self.robot.set_door(door, state, watch)
    }

    fn call_lift(&mut self, door: Option<DoorId>, watch: &mut Watch<'_>) -> Done {
        self.robot.call_lift(door, watch)
    }

    fn ride(
        &mut self,
        ride: &Ride,
        door: Option<DoorId>,
        arrival: (MapId, Pose),
        watch: &mut Watch<'_>,
    ) -> Done {
        self.robot.ride(ride, door, arrival, watch)
    }

    fn take(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        self.robot.take(thing, watch)
    }

    fn put(&mut self, thing: ReplicaId, area: AreaId, frame: Frame, watch: &mut Watch<'_>) -> Done {
        self.robot.put(thing, area, frame, watch)
    }

    fn hand_over(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        self.robot.hand_over(thing, watch)
    }

    fn take_back(&mut self, thing: ReplicaId, watch: &mut Watch<'_>) -> Done {
        self.robot.take_back(thing, watch)
    }

    fn switch(&mut self, device: ReplicaId, on: bool, watch: &mut Watch<'_>) -> Done {
        self.robot.switch(device, on, watch)
    }

    fn call(&mut self, person: &str, watch: &mut Watch<'_>) -> Done {
        self.robot.call(person, watch)
    }

    fn look_round(&mut self, watch: &mut Watch<'_>) -> Done {
        self.robot.look_round(watch)
    }

    fn sees(&mut self, thing: ReplicaId) -> Result<Option<Sighting>, Failure> {
        self.robot.sees(thing)
    }

    fn look_at(&mut self, what: Obstruction) -> Result<Option<Sighting>, Failure> {
        self.robot.look_at(what)
    }
}

#[test]
fn who_is_carried_off_on_its_way_finds_itself_and_goes_on() {
    let setting = Setting::of(example("rb2"));
    let Setting { world, floors, map, pose, .. } = &setting;
    let (map, pose) = (*map, *pose);
    let area = world.find("Комната-Y").into_iter().find_map(|entity| match entity {
        Entity::Area(id) => Some(id),
        _ => None,
    });
    let area = area.unwrap();
    let goal = [fact("РОБОТ-НАХОДИТСЯ-В", world.name(Entity::Area(area)))];
    let (mut found, mut lost) = (0, 0);
    for (number, place) in world.places.values().enumerate() {
        for after in [2, 3, 5, 7, 11] {
            let (_, frame) = world.placement(place.area).unwrap();
            let to =
                Pose { at: frame.apply(place.at), heading: Deg::of(20.0 + 70.0 * number as f64) };
            let robot = Simulator::new(world.clone(), map, pose);
            let robot = SensingRobot::new(robot, Senses::of_seed(number as u64));
            let mut body = CarriedOff { robot, pieces: 0, after, to };
            let ground = Ground::of(world, floors, 20.0);
            let finders = ground.finders();
            let mut mission = setting.mission(setting.belief().unwrap());
            let mut displaced = 0;
            let ending = {
                let mut pilot = Pilot::new(&ground, &finders, &mut body, (map, pose)).unwrap();
                mission.belief.pose = pilot.pose().1;
                let mut tell = |event: &Event<'_>| {
                    if let Event::Surprised { surprise: Surprise::Displaced, .. } = event {
                        displaced += 1;
                    }
                };
                mission.run(&goal, &mut pilot, &Stop::new(), &mut tell).unwrap()
            };
            let how = format!("{} after {after}: {ending:?}", place.name);
            let (_, truly) = body.robot.body().pose();
            match ending {
                Ending::Done | Ending::AlreadyTrue => {
                    let off = (mission.belief.pose.at - truly.at).norm();
                    assert!(off < 10.0, "{how}: {off:.0} cm off");
                    assert!(
                        body.pieces < after || displaced > 0 || (to.at - pose.at).norm() < 60.0,
                        "{how}"
                    );
                    found += 1;
                }
                Ending::Failed(Failure::Nowhere { .. }) => lost += 1,
                other => panic!("{how}: {other:?}"),
            }
        }
    }
    assert!(found > lost, "{found} found, {lost} lost");
}
