//! A chair in the way: the robot goes round it, else pushes it where it may, else says what would open the way. Judged by
//! where the chair and the robot are in truth then.

use orthoframe_geometry::Remedy;
use orthoframe_map::{Entity, Format, World};
use orthoframe_robot::*;
use orthoframe_units::{AreaId, Frame, ReplicaId, Source, Stop};

use super::setting::{Setting, fact};

/// Two rooms with a narrow doorway between them, a chair before it, and a way round by a third room or not.
const HOME: &str = r#"
format = 1
[domain]
key = "home"
name = "Home"
[robot]
radius = 22
height = 110
clearance = 3
speed = 50
start = "Post"
[type]
object = [{ name = "chair", traits = [TRAITS] }]
[orthoframe]
one = { name = "One", height = 270, points = [[0, 0], [400, 0], [400, 110], [400, 190], [400, 300], [240, 300], [160, 300], [0, 300]], side.C = { permeability = "permeable" }, side.F = { permeability = "permeable" } }
two = { name = "Two", height = 270, points = [[0, 0], [400, 0], [400, 300], [240, 300], [160, 300], [0, 300], [0, 190], [0, 110]], side.D = { permeability = "permeable" }, side.G = { permeability = "permeable" } }
three = { name = "Three", height = 270, points = [[0, 0], [160, 0], [240, 0], [560, 0], [640, 0], [800, 0], [800, 150], [0, 150]], side.B = { permeability = "permeable" }, side.D = { permeability = "permeable" } }
seat = { name = "Seat", rect = [50, 50], height = 90 }
[object]
chair = { name = "Chair", type = "chair", items = [{ id = "A", orthoframe = "seat" }] }
[area.one]
name = "One"
items = [{ id = "A", orthoframe = "one" }]
places = [{ name = "Post", at = [100, 150] }]
replicas = [{ name = "Chair 1", object = "chair", at = CHAIR, move_prob = 80 }]
[area.two]
name = "Two"
items = [{ id = "A", orthoframe = "two" }]
AREA[map.home]
name = "Home"
items = [{ area = "one" }, { area = "two", at = [400, 0] }THREE]
links = [{ from = "one.C", to = "two.G" }ROUND]
"#;

const THIRD: &str =
    "[area.three]\nname = \"Three\"\nitems = [{ id = \"A\", orthoframe = \"three\" }]\n";
const ROUND: &str =
    ", { from = \"one.F\", to = \"three.B\" }, { from = \"two.D\", to = \"three.D\" }";

const IN_THE_WAY: [f64; 2] = [345.0, 125.0];
const ASIDE: [f64; 2] = [20.0, 20.0];

fn home(movable: bool, round: bool, chair: [f64; 2]) -> World {
    let text = HOME
        .replace("TRAITS", if movable { "\"seat\", \"movable\"" } else { "\"seat\"" })
        .replace("CHAIR", &format!("{chair:?}"))
        .replace("THREE", if round { ", { area = \"three\", at = [0, 300] }" } else { "" })
        .replace("AREA", if round { THIRD } else { "" })
        .replace("ROUND", if round { ROUND } else { "" });
    World::parse(&Source::new("home.toml", &text), Format::Toml).unwrap_or_else(|e| panic!("{e:?}"))
}

fn id(world: &World, name: &str) -> (Option<AreaId>, Option<ReplicaId>) {
    let mut found = (None, None);
    for entity in world.find(name) {
        match entity {
            Entity::Area(area) => found.0 = Some(area),
            Entity::Replica(replica) => found.1 = Some(replica),
            _ => {}
        }
    }
    found
}

struct Came {
    ending: Ending,
    done: Vec<String>,
    bumps: usize,
    area: AreaId,
    chair: Frame,
    asked: Vec<Barred>,
}

/// Sends the robot into the other room of a house that it takes for `believed`.
fn send(believed: World, truth: World) -> Came {
    send_asking(believed, truth, &[])
}

/// The same where somebody gives these answers, one after another, when asked to clear a way.
fn send_asking(believed: World, truth: World, answers: &[Answer]) -> Came {
    let setting = Setting::of(believed);
    let mut mission = setting.mission(setting.belief().unwrap());
    let mut robot = Simulator::new(truth, setting.map, setting.pose);
    let (mut done, mut bumps, mut asked) = (Vec::new(), 0, Vec::new());
    let mut tell = |event: &Event<'_>| match event {
        Event::Finished { directive, .. } => done.push(directive.action.to_string()),
        Event::Surprised { surprise: Surprise::Blocked { .. }, .. } => bumps += 1,
        Event::Barred { barred, answer } => {
            answer.set(answers.get(asked.len()).copied().unwrap_or_default());
            asked.push((*barred).clone());
        }
        _ => {}
    };
    let goal = [fact("РОБОТ-НАХОДИТСЯ-В", "Two")];
    let ending = mission.run(&goal, &mut robot, &Stop::new(), &mut tell).unwrap();
    let (_, pose) = robot.pose();
    let truth = robot.into_truth();
    let floor = super::setting::floors(&truth).remove(&setting.map).unwrap();
    let area = floor.locate(pose.at).expect("it stands in a room").0;
    let chair = id(&truth, "Chair 1").1.unwrap();
    Came { ending, done, bumps, area, chair: truth.replicas[&chair].frame, asked }
}

#[test]
fn a_chair_in_the_only_doorway_is_pushed_aside() {
    let world = home(true, false, IN_THE_WAY);
    let two = id(&world, "Two").0.unwrap();
    // Known to be there, and met there.
    for (believed, most) in [(world.clone(), 0), (home(true, false, ASIDE), 2)] {
        let came = send(believed, world.clone());
        assert!(matches!(came.ending, Ending::Done), "{:?} {:?}", came.done, came.ending);
        assert_eq!(came.done.iter().filter(|one| *one == "Сдвинуть").count(), 1, "{:?}", came.done);
        assert!(came.bumps <= most, "{} {:?}", came.bumps, came.done);
        assert_eq!(came.area, two);
        let before = world.replicas[&id(&world, "Chair 1").1.unwrap()].frame;
        let off = (came.chair.x.get() - before.x.get()).hypot(came.chair.y.get() - before.y.get());
        assert!(off > 5.0 && off < 125.0, "{off}");
    }
}

#[test]
fn a_chair_is_gone_round_where_there_is_another_way() {
    for movable in [true, false] {
        let world = home(movable, true, IN_THE_WAY);
        let came = send(world.clone(), world.clone());
        assert!(matches!(came.ending, Ending::Done), "{:?} {:?}", came.done, came.ending);
        assert!(!came.done.iter().any(|one| one == "Сдвинуть"), "{:?}", came.done);
        let before = world.replicas[&id(&world, "Chair 1").1.unwrap()].frame;
        assert_eq!(came.chair, before);
    }
}

#[test]
fn what_may_not_be_pushed_stays_and_what_would_help_is_told() {
    let world = home(false, false, IN_THE_WAY);
    let came = send(world.clone(), world.clone());
    let chair = id(&world, "Chair 1").1.unwrap();
    let is_told = matches!(
        &came.ending,
        Ending::Stuck(Surprise::NoWay { remedy: Some(remedy), .. })
            if matches!(**remedy, Remedy::Move { replica, .. } if replica == chair)
    );
    assert!(is_told, "{:?}", came.ending);
    assert!(came.done.is_empty(), "{:?}", came.done);
    assert_eq!(came.chair, world.replicas[&chair].frame);
}

/// What bars the way and where is told, and who says that it is clear is taken at their word as far as the eye goes.
#[test]
fn who_is_asked_to_clear_the_way_may_do_so_or_give_up() {
    let world = home(false, false, IN_THE_WAY);
    let chair = id(&world, "Chair 1").1.unwrap();
    let (one, two) = (id(&world, "One").0.unwrap(), id(&world, "Two").0.unwrap());
    let cleared = home(false, false, ASIDE);
    // It was taken away meanwhile, and the eye sees that: nobody is asked.
    let came = send_asking(world.clone(), cleared, &[]);
    assert!(matches!(came.ending, Ending::Done), "{:?} {:?}", came.done, came.ending);
    assert_eq!((came.area, came.asked.len()), (two, 0));
    // It stands there still, whatever is said; nobody answers; it is given up.
    for (answers, questions) in
        [(&[Answer::Clear; 9][..], 3), (&[][..], 1), (&[Answer::GiveUp][..], 1)]
    {
        let came = send_asking(world.clone(), world.clone(), answers);
        assert!(matches!(came.ending, Ending::Stuck(_)), "{:?} {:?}", came.done, came.ending);
        assert_eq!((came.asked.len(), came.area, came.bumps), (questions, one, 0));
        let asked = &came.asked[0];
        assert_eq!((&asked.things[..], asked.area), (&[chair][..], one));
        assert!((asked.at.x - 370.0).abs() < 1.0 && (asked.at.y - 150.0).abs() < 1.0, "{asked:?}");
    }
    // Met on the way, and not known to be there.
    let came = send_asking(home(false, false, ASIDE), world, &[Answer::GiveUp]);
    assert!(matches!(came.ending, Ending::Stuck(_)), "{:?} {:?}", came.done, came.ending);
    assert_eq!((&came.asked[0].things[..], came.area), (&[chair][..], one));
}

/// A board parts the other room: into its one half leads the passage from here, into its other the way by the third room.
#[test]
fn what_lies_in_the_other_half_of_a_room_is_gone_to_round_about() {
    let text = r#"
[orthoframe.board]
name = "Board"
rect = [20, 300]
height = 200
[object.board]
name = "Board"
items = [{ id = "A", orthoframe = "board" }]
[[edit]]
place = "Board 1"
object = "board"
area = "Two"
at = [90, 0]
[[edit]]
point = "Goal"
area = "Two"
pose = [700, 100]
"#;
    let world = home(false, true, ASIDE);
    let edits = orthoframe_map::Edits::read(&Source::new("board.toml", text), Format::Toml);
    let names = orthoframe_map::NameIndex::of(&world);
    let naming = orthoframe_map::Naming { exact: &names, in_other_words: &|_| Vec::new() };
    let ids = orthoframe_map::NextIds::after(&world);
    let parted = orthoframe_map::edit(&world, &edits, &ids, naming);
    let parted = parted.world.unwrap_or_else(|| panic!("{:?}", parted.faults));
    let setting = Setting::of(parted.clone());
    let mut mission = setting.mission(setting.belief().unwrap());
    let mut robot = Simulator::new(parted, setting.map, setting.pose);
    let goal = [fact("РОБОТ-НАХОДИТСЯ-В-ПОЗИЦИИ", "Goal")];
    let ending = mission.run(&goal, &mut robot, &Stop::new(), &mut |_| {}).unwrap();
    assert!(matches!(ending, Ending::Done), "{ending:?}");
    let (_, pose) = robot.pose();
    assert!((pose.at - orthoframe_units::Point::new(700.0, 100.0)).norm() < 20.0, "{pose:?}");
}
